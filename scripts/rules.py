"""Writes what follows from the words of the messages, the files `rules.md` in `src/yamaro`.

python scripts/rules.py            writes docs/diagnostics.md from its first mark on, the
                                   tables of docs/checks.md with what programs do, from
                                   tests/consumers/readers.txt, src/yamaro/severities.py
python scripts/rules.py --check    only reports which of them are out of date
"""

from __future__ import annotations

import os
import re
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "src" / "yamaro"
DOCS = ROOT / "docs"
sys.path.insert(0, str(ROOT / "src"))

from derived import Tables, update  # noqa: E402

from yamaro.codes import Rule, anchor_of, rules  # noqa: E402

ROOMS = "yaml syntax files xacro sources safe robot check targets picture".split()
"""Folders of src/yamaro in the order of docs/diagnostics.md; after them come the tools."""
MARK = "<!-- scripts/rules.py writes the rest, from the files rules.md in src/yamaro -->\n"
FENCED = re.compile(r"^(```.*?^```$)", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
BAD_ROBOTS = ROOT / "tests" / "check" / "bad_robots"
READERS = ROOT / "tests" / "consumers" / "readers.txt"
"""What programs do with the robots of BAD_ROBOTS; tests/consumers/readers.py writes it."""
SIGNS = {"refuses": "✗", "crashes": "crash", "reports": "(✗)", "reads": "–"}
SEVERITIES = '''\
"""The severity of each code that a document can be written with; scripts/rules.py writes this.

The file `rules.md` of the folder that reports a code says its severity, and what it means.
"""

SEVERITIES = {
%s}
'''


def written() -> dict[Path, str]:
    """Return the files with the texts that they have to have."""
    diagnostics, checks = DOCS / "diagnostics.md", DOCS / "checks.md"
    severities = {code: rule.severity for code, rule in rules().items() if rule.severity}
    rows = (f'    "{code}": "{re.split("[ ;]", severities[code])[0]}",\n' for code in severities)
    return {
        diagnostics: diagnostics.read_text(encoding="utf-8").partition(MARK)[0] + MARK + pages(),
        checks: Tables("rules", table).fill(checks.read_text(encoding="utf-8")),
        SOURCE / "severities.py": SEVERITIES % "".join(sorted(rows)),
    }


def pages() -> str:
    """Return the contents and the chapters of docs/diagnostics.md."""
    files = [SOURCE / room / "rules.md" for room in ROOMS]
    files += sorted(SOURCE.glob("tools/*/rules.md"))
    left_out = {rule.page for rule in rules().values()} - set(files)
    if left_out:
        sys.exit(f"ROOMS in scripts/rules.py has to name the folder of {left_out}")
    text = "\n".join("".join(moved(path)) for path in files)
    titles = re.findall(r"^## (.*)$", FENCED.sub("", text), re.MULTILINE)
    entries = (f"- [{title}](#{anchor_of(title)})\n" for title in titles)
    return "\n" + "".join(entries) + "\n" + text


def moved(page: Path) -> Iterator[str]:
    """Give the text of a page with the links that it has in docs/diagnostics.md."""

    def link(found: re.Match[str]) -> str:
        path, hash, anchor = found[1].partition("#")
        target = (page.parent / path).resolve() if path else page
        if "://" in path:
            return found[0]
        if target.name == page.name:
            return f"]({hash}{anchor})"
        return f"]({os.path.relpath(target, DOCS)}{hash}{anchor})"

    for part in FENCED.split(page.read_text(encoding="utf-8")):
        yield part if part.startswith("```") else LINK.sub(link, part)


def table(chapter: str) -> str:
    """Return the table of a chapter: its codes, how severe they are, and what they mean.

    With a column for each program of READERS, if it was tried on robots with these faults.
    """
    of_chapter = [rule for rule in rules().values() if rule.chapter == chapter]
    if not of_chapter:
        sys.exit(f"docs/checks.md has a table of '{chapter}', which is a chapter of no rules.md")
    programs, signs = signs_by_code()
    if not any(rule.code in signs for rule in of_chapter):
        programs, signs = [], {}
    heads = ["code", "severity", "fault", *programs]
    rows = [[*cells(rule), *signs.get(rule.code, [""] * len(programs))] for rule in of_chapter]
    rules_of_columns = ["---"] * 3 + [":-:"] * len(programs)
    return "".join(f"| {' | '.join(row)} |\n" for row in [heads, rules_of_columns, *rows])


def cells(rule: Rule) -> list[str]:
    """Return the cells of a code."""
    link = f"[`{rule.code}`](diagnostics.md#{rule.anchor})"
    severity = rule.severity.replace(" that can be allowed", "") or "error"
    return [link, severity, rule.summary]


def signs_by_code() -> tuple[list[str], dict[str, list[str]]]:
    """Return the programs that read URDF, and the signs of what they do with each fault."""
    lines = READERS.read_text(encoding="utf-8").splitlines()
    recorded = {name: words.split() for name, _, words in (line.partition(": ") for line in lines)}
    programs = recorded.pop("robot")
    verdicts: defaultdict[str, list[list[str]]] = defaultdict(list)
    for page in sorted(BAD_ROBOTS.glob("*.txt")):
        for line in page.read_text(encoding="utf-8").splitlines():
            name, _, codes = line.removeprefix("### ").partition(" | ")
            if line.startswith("### ") and name in recorded and ", " not in codes:
                verdicts[codes].append(recorded[name])
    return programs, {
        code: [sign(set(column)) for column in zip(*rows, strict=True)]
        for code, rows in verdicts.items()
    }


def sign(verdicts: set[str]) -> str:
    """Return the sign of what a program does with the robots that have one fault."""
    return SIGNS[verdicts.pop()] if len(verdicts) == 1 else "some"


if __name__ == "__main__":
    sys.exit(update(written(), sys.argv[1:]))
