"""Tells what Newton finds in files of USD: run it with the Python of an environment that has it.

It reads paths on standard input, a line each, and answers each with a line of JSON.
"""

from __future__ import annotations

import json
import sys
import warnings
from importlib import import_module


def order(path: str, ordering: str) -> dict[str, object]:
    builder = import_module("newton").ModelBuilder()
    builder.add_usd(path, joint_ordering=ordering)
    model = builder.finalize(device="cpu")
    qs, vs = (list(map(int, each.numpy())) for each in (model.joint_q_start, model.joint_qd_start))
    parents, children = (
        list(map(int, each.numpy())) for each in (model.joint_parent, model.joint_child)
    )
    return {
        "positions": int(model.joint_coord_count),
        "velocities": int(model.joint_dof_count),
        "joints": [
            (label, qs[i], qs[i + 1] - qs[i], vs[i], vs[i + 1] - vs[i])
            for i, label in enumerate(model.joint_label)
        ],
        "bodies": list(model.body_label),
        "parents": parents,
        "children": children,
    }


def main() -> None:
    import_module("warp").config.quiet = True
    warnings.simplefilter("ignore")
    answers, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        try:
            answer: object = order(line.strip(), "dfs")
        except Exception as error:
            answer = {"error": f"{type(error).__name__}: {str(error).splitlines()[0][:200]}"}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
