"""Mutation testing of some modules: `python -m tests.mutation [MODULE …]`; see README.md here."""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.mutation.mutants import Mutant, modules_of, sample
from tests.mutation.runner import MutationRun, Verdict

ROOT = Path(__file__).parents[2]
EXAMPLES = {"YAMARO_SHARING_EXAMPLES": "15", "YAMARO_SCOPE_EXAMPLES": "60"}
"""How much the tests try that draw programs by chance."""
# What runs other programs, looks at other folders of the source, or takes long.
LEFT_OUT = """consumers check/bad_robots properties/test_same_bytes.py properties/test_inertia.py
    properties/test_xml.py properties/test_shared_trees.py properties/test_transforms.py
    test_architecture.py test_bench.py test_coming_from_xacro.py test_docs.py test_fuzz_corpus.py
    test_hostile_escapes.py test_hostile_robots.py sandbox/test_jail.py test_killed.py test_links.py
    test_output.py test_output_faults.py test_threads.py xml/test_tree.py""".split()
RESULTS = ROOT / "build" / "mutation"


def main() -> None:
    parser = argparse.ArgumentParser(prog="scripts/mutate", description=__doc__)
    parser.add_argument("modules", nargs="*", help="such as syntax/keys; all if none is named")
    parser.add_argument("--sample", type=int, default=10**9, help="so many mutants of each module")
    parser.add_argument("--seed", type=int, default=1, help="another one draws another sample")
    parser.add_argument("--again", action="store_true", help="those that survived the last time")
    parser.add_argument("--tests", nargs="+", default=["tests"], help="only these files, folders")
    parser.add_argument("--store", type=Path, help="keep which test runs which line in this file")
    options = parser.parse_args()
    RESULTS.mkdir(parents=True, exist_ok=True)

    def choose(mutants: list[Mutant]) -> list[Mutant]:
        if not mutants:
            return []
        path = result_of(mutants[0].module)
        if not options.again:
            path.unlink(missing_ok=True)
            return sample(mutants, options.sample, options.seed)
        verdicts = json.loads(path.read_text())["verdicts"]
        alive = {(function, change) for function, _, change, by, *_ in verdicts if not by}
        return [mutant for mutant in mutants if (mutant.function, mutant.change) in alive]

    os.chdir(ROOT)
    os.environ |= EXAMPLES
    signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background of a shell
    modules = options.modules or modules_of("syntax") + modules_of("runtime")
    run = MutationRun(modules, choose, write_result, options.store)
    left_out = [f"--ignore=tests/{name}" for name in LEFT_OUT]
    plain = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist"]
    sys.exit(pytest.main([*plain, *left_out, *options.tests], plugins=[run]))


def result_of(module: str) -> Path:
    return RESULTS / f"{module.replace('/', '.')}.json"


def write_result(module: str, count: int, verdicts: list[Verdict], seconds: float) -> None:
    """Keep what came of the mutants of a module; those tried before take their new verdicts."""
    told: dict[tuple[str, str], Any] = {}
    path = result_of(module)
    if path.exists():
        before = json.loads(path.read_text())
        told = {(verdict[0], verdict[2]): verdict for verdict in before["verdicts"]}
    for verdict in verdicts:
        mutant = verdict.mutant
        if verdict.by is None:
            print(f"cannot be tried: {mutant.function} {mutant.change}", file=sys.__stderr__)
            continue
        told[mutant.function, mutant.change] = [
            mutant.function,
            mutant.lines.start,
            mutant.change,
            verdict.by,
            verdict.tests,
            round(verdict.seconds, 2),
        ]
    result = {"module": module, "mutants": count, "verdicts": list(told.values())}
    path.write_text(json.dumps(result, indent=0))
    killed = sum(1 for verdict in verdicts if verdict.by)
    print(f"{module}: {killed} of {len(verdicts)} killed, {seconds:.0f} s", file=sys.__stderr__)


if __name__ == "__main__":
    main()
