"""Writes docs/scoreboard.md, a table for each pair of formats, and scoreboard.csv with all rows."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from statistics import fmean
from typing import NamedTuple

from . import judging
from .judging import Share
from .robots import PIP, Robot
from .tools import NOT_TRIED, TOOLS, Route, Tool

COLUMNS = ("names", *judging.COLUMNS)
TITLES = {"urdf": "URDF", "mjcf": "MJCF", "sdf": "SDF", "usd": "USD"}
OWN = "Yamaro"
HEAD = (Path(__file__).parent / "head.md").read_text(encoding="utf-8")


class Row(NamedTuple):
    """What a tool keeps of a robot: shares by column, or why there are none."""

    robot: Robot
    tool: Tool
    route: Route
    shares: Mapping[str, Share]
    message: str


def written(rows: Sequence[Row]) -> str:
    """Return the page."""
    robots = list({row.robot.name: row.robot for row in rows}.values())
    tables: list[str] = []
    better: list[str] = []
    for source in ("urdf", "mjcf"):
        for makes in ("mjcf", "sdf", "usd", "urdf"):
            found = [r for r in rows if (r.robot.read_as, r.route.makes) == (source, makes)]
            if found:
                name = f"{_from(source)} to {TITLES[makes]}"
                tables.append(f"### {name}\n\n{_summary(found)}")
                better += _better(name, found)
    return HEAD.format(
        tools=len(TOOLS),
        robots=len(robots),
        tables="\n".join(tables),
        better="\n".join(better) or "Nowhere, in these columns.",
        notes=_notes(),
        not_tried="\n".join(f"- {name}: {why}" for name, why in NOT_TRIED.items()),
        names=_names(robots),
    )


def listed(rows: Sequence[Row]) -> str:
    """Return all rows as CSV: of each robot and tool, what is kept of how much."""
    file = io.StringIO()
    out = csv.writer(file, lineterminator="\n")
    out.writerow(
        (
            "robot",
            "kind",
            "license",
            "source",
            "tool",
            "version",
            "to",
            *COLUMNS,
            "message",
            "command",
        )
    )
    for robot, tool, route, shares, message in rows:
        given = " ".join(f"{name}:={value}" for name, value in robot.arguments.items())
        out.writerow(
            (
                robot.name,
                robot.kind,
                robot.licence,
                f"{_origin(robot)} {robot.path} {given}".strip(),
                tool.name,
                tool.version,
                route.makes,
                *(f"{shares[each].kept} of {shares[each].of}" if each in shares else ""
                  for each in COLUMNS),
                message,
                route.command.format_map(_Shown()),
            )
        )  # fmt: skip
    return file.getvalue()


def details(rows: Sequence[Row]) -> str:
    """Return what `--only` prints: with the first value that is lost."""
    lines = []
    for row in rows:
        cells = [
            f"{name} {share.kept}/{share.of}" + (f" ({share.lost})" if share.lost else "")
            for name, share in row.shares.items()
        ]
        name = f"{row.robot.name} | {row.tool.name} → {row.route.makes}"
        lines.append(f"{name} | {row.message or '; '.join(cells)}")
    return "\n".join(lines)


def _from(source: str) -> str:
    return "URDF and xacro" if source == "urdf" else TITLES[source]


def _mean(rows: Iterable[Row], column: str) -> float | None:
    found = [row.shares[column] for row in rows if column in row.shares]
    return 100 * fmean(share.kept / share.of for share in found) if found else None


def _percent(value: float | None) -> str:
    """Return a percentage that is 100 only if nothing is lost."""
    if value is None:
        return "·"
    return f"{value:.0f}" if value in (0, 100) else f"{min(max(value, 1), 99):.0f}"


def _table(head: Sequence[str], lines: Iterable[Sequence[str]], left: int = 1) -> str:
    rule = ["---"] * left + ["--:"] * (len(head) - left)
    return "\n".join(f"| {' | '.join(line)} |" for line in (head, rule, *lines)) + "\n"


def _grouped(rows: Iterable[Row]) -> dict[str, list[Row]]:
    found: dict[str, list[Row]] = {}
    for row in rows:
        found.setdefault(row.tool.name, []).append(row)
    return found


def _summary(rows: Sequence[Row]) -> str:
    """Return the table of a pair of formats: the tools that can do it, the others below it."""
    tools = _grouped(rows)
    lines = []
    for name, own in tools.items():
        loaded = [row for row in own if row.shares]
        cells = [_percent(_mean(loaded, column)) for column in COLUMNS]
        lines.append([name, f"{len(loaded)} of {len(own)}", *cells])
    return _table(["tool", "loads", *COLUMNS], lines)


def _better(name: str, rows: Sequence[Row]) -> list[str]:
    tools = _grouped(rows)
    own = {row.robot.name: row for row in tools.get(OWN, ()) if row.shares}
    lines = []
    for tool, found in tools.items():
        both = [row for row in found if row.shares and row.robot.name in own]
        if tool == OWN:
            continue
        cells = []
        for column in COLUMNS:
            theirs = _mean(both, column)
            ours = _mean([own[row.robot.name] for row in both], column)
            if theirs is not None and ours is not None and theirs > ours + 1e-9:
                cells.append(f"{column} {_percent(theirs)} (Yamaro {_percent(ours)})")
        if cells:
            lines.append(f"- {name}, {tool}: {', '.join(cells)}")
    return lines


def _notes() -> str:
    """Return what is to be said of a tool, with links to those that have a page."""
    lines = []
    for tool in TOOLS:
        link = f"[{tool.name}]({tool.url})" if tool.url else tool.name
        lines.append(f"- {link} {tool.version}".rstrip() + (f": {tool.note}" if tool.note else ""))
    return "\n".join(lines)


class _Shown(dict[str, str]):
    """What stands in a command for what differs between robots."""

    def __missing__(self, name: str) -> str:
        return {"file": "FILE", "base": "LINK"}.get(name, f"[{name}]")


def _origin(robot: Robot) -> str:
    """Return where a robot is from, at one version."""
    if robot.repository:
        return f"https://github.com/{robot.repository}/tree/{robot.commit}"
    return f"https://pypi.org/project/{PIP[0]}/{PIP[1]}/"


def _names(robots: Sequence[Robot]) -> str:
    """Return the robots by the format that their authors write."""
    return "; ".join(
        f"in {TITLES.get(format, format)} "
        + ", ".join(robot.name for robot in robots if robot.format == format)
        for format in dict.fromkeys(robot.format for robot in robots)
    )
