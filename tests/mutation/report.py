"""Tells of a run of mutants: the table of README.md, and the survivors that no reason is given for.

python -m tests.mutation.report                 the table
python -m tests.mutation.report --survivors     each survivor, as a line of survivors.tsv
"""

from __future__ import annotations

import argparse
import json
import math
from collections import Counter
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
RESULTS = HERE.parents[1] / "build" / "mutation"
REASONS = {
    "equal": "the same for every input",
    "guard": "only what cannot happen here would show it",
    "speed": "only takes longer, or keeps less",
    "words": "a word of a message, or of what developers see",
    "elsewhere": "needs another system, another Python or a broken installation",
    "slow": "a test that is left out here kills it",
    "import": "is run by the import, before the change is made; made in the file, it is killed",
    "hole": "a test is missing",
    "unread": "nobody has read it",
}


class Survivor:
    """A mutant that no test noticed."""

    def __init__(self, module: str, function: str, line: int, change: str) -> None:
        self.module = module
        self.function = function
        self.line = line
        self.change = change

    @property
    def key(self) -> tuple[str, str, str]:
        return self.module, self.function, self.change


def read_reasons() -> dict[tuple[str, str, str], str]:
    """Return the reason for each survivor that somebody has read."""
    reasons = {}
    for line in (HERE / "survivors.tsv").read_text(encoding="utf-8").splitlines():
        reason, module, function, change = line.split("\t")
        assert reason in REASONS, line
        reasons[module, function, change] = reason
    return reasons


def survivors_of(result: dict[str, Any]) -> list[Survivor]:
    return [
        Survivor(result["module"], function, line, change)
        for function, line, change, killed_by, *_ in result["verdicts"]
        if not killed_by
    ]


def interval(killed: int, tried: int) -> tuple[float, float]:
    """Return Wilson's interval of 95 % for a share of which a sample is known."""
    z = 1.96
    share = killed / tried
    middle = share + z * z / (2 * tried)
    width = z * math.sqrt(share * (1 - share) / tried + z * z / (4 * tried * tried))
    scale = 1 + z * z / tried
    return (middle - width) / scale, (middle + width) / scale


def table(results: list[dict[str, Any]]) -> str:
    reasons = read_reasons()
    used = [name for name in REASONS if name != "unread"]
    rows = [
        "| module | mutants | tried | killed | " + " | ".join(used) + " |",
        "|---|--:|--:|--:|" + "--:|" * len(used),
    ]
    totals: Counter[str] = Counter()
    for result in results:
        alive = survivors_of(result)
        counts = Counter(reasons.get(survivor.key, "unread") for survivor in alive)
        totals.update(counts)
        tried = len(result["verdicts"])
        totals.update(mutants=result["mutants"], tried=tried, killed=tried - len(alive))
        rows.append(_row(result["module"], result["mutants"], tried, tried - len(alive), counts))
    rows.append(_row("**all**", totals["mutants"], totals["tried"], totals["killed"], totals))
    low, high = interval(totals["killed"], totals["tried"])
    rows += ["", f"Killed of all: between {100 * low:.1f} % and {100 * high:.1f} %."]
    if totals["unread"]:
        rows.append(f"Unread: {totals['unread']}; see --survivors.")
    return "\n".join(rows)


def _row(name: str, mutants: int, tried: int, killed: int, counts: Counter[str]) -> str:
    share = f"{100 * killed / max(tried, 1):.1f} %"
    cells = [str(counts[reason] or "") for reason in REASONS if reason != "unread"]
    return f"| {name} | {mutants} | {tried} | {share} | " + " | ".join(cells) + " |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--survivors", action="store_true")
    parser.add_argument("--results", type=Path, default=RESULTS)
    options = parser.parse_args()
    paths = sorted(options.results.glob("*.json"))
    results = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    if not options.survivors:
        print(table(results))
        return
    reasons = read_reasons()
    for result in results:
        for one in survivors_of(result):
            print(reasons.get(one.key, "unread"), *one.key, sep="\t")


if __name__ == "__main__":
    main()
