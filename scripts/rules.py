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
from collections.abc import Iterator, Mapping
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
NAMES = {each: each for each in ("urdfdom", "yourdfpy", "pinocchio", "libsdformat")}
NAMES |= {"mujoco": "MuJoCo", "drake": "Drake"}
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
    """Return what programs do with the faults of a chapter: its codes, how severe, who refuses.

    If no program was tried on robots with these faults, these are the codes alone.
    """
    of_chapter = [rule for rule in rules().values() if rule.chapter == chapter]
    if not of_chapter:
        sys.exit(f"docs/checks.md has a table of '{chapter}', which is a chapter of no rules.md")
    verdicts = verdicts_by_code()
    if not any(rule.code in verdicts for rule in of_chapter):
        return ",\n".join(map(link_to, of_chapter)) + ".\n"
    lines = [["code", "severity", "fault", "refused by", "reported by"], ["---"] * 5]
    for rule in of_chapter:
        by_program = verdicts.get(rule.code, {})
        severity = rule.severity.replace(" that can be allowed", "") or "error"
        refused = names_of(by_program, {"refuses", "crashes"})
        reported = names_of(by_program, {"reports"})
        lines.append([link_to(rule), severity, rule.summary, refused, reported])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def link_to(rule: Rule) -> str:
    """Return a code that leads to its description."""
    return f"[`{rule.code}`](diagnostics.md#{rule.anchor})"


def verdicts_by_code() -> dict[str, dict[str, list[str]]]:
    """Return what each program that reads URDF does with the robots of each fault."""
    lines = READERS.read_text(encoding="utf-8").splitlines()
    recorded = {name: words.split() for name, _, words in (line.partition(": ") for line in lines)}
    programs = recorded.pop("robot")
    verdicts: defaultdict[str, defaultdict[str, list[str]]]
    verdicts = defaultdict(lambda: defaultdict(list))
    for page in sorted(BAD_ROBOTS.glob("*.txt")):
        for line in page.read_text(encoding="utf-8").splitlines():
            name, _, codes = line.removeprefix("### ").partition(" | ")
            if line.startswith("### ") and name in recorded and ", " not in codes:
                for program, verdict in zip(programs, recorded[name], strict=True):
                    verdicts[codes][program].append(verdict)
    return {code: dict(by_program) for code, by_program in verdicts.items()}


def names_of(verdicts: Mapping[str, list[str]], wanted: set[str]) -> str:
    """Return which programs do so with all robots of a fault; with a star, with some of them."""
    always = [NAMES[each] for each, found in verdicts.items() if wanted.issuperset(found)]
    at_times = [
        f"{NAMES[each]}*"
        for each, found in verdicts.items()
        if not wanted.issuperset(found) and not wanted.isdisjoint(found)
    ]
    others = [NAMES[each] for each in verdicts if NAMES[each] not in always]
    if verdicts and not others:
        return "all"
    if len(others) == 1 and not at_times:
        return f"all but {others[0]}"
    return ", ".join(always + at_times)


if __name__ == "__main__":
    sys.exit(update(written(), sys.argv[1:]))
