"""Writes docs/scoreboard.md: a table for each pair of formats, then one for each robot."""

from __future__ import annotations

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
    pairs = {
        (source, makes): [
            row for row in rows if row.robot.read_as == source and row.route.makes == makes
        ]
        for source in ("urdf", "mjcf")
        for makes in ("mjcf", "sdf", "usd", "urdf")
    }
    pairs = {pair: found for pair, found in pairs.items() if found}
    names = [f"{_from(source)} to {TITLES[makes]}" for source, makes in pairs]
    contents = "\n".join(
        f"- [{name}](#{name.lower().replace(' ', '-').replace(',', '')})" for name in names
    )
    robots = list({row.robot.name: row.robot for row in rows}.values())
    parts = [HEAD.format(tools=len(TOOLS), robots=len(robots), contents=contents)]
    better: list[str] = []
    for name, found in zip(names, pairs.values(), strict=True):
        parts.append(f"## {name}\n\n{_summary(found)}")
        better += _better(name, found)
    parts.append(
        "## Where another tool keeps more than Yamaro\n\n"
        "Of the robots that both write, in percent of what is counted:\n\n"
        + ("\n".join(better) or "Nowhere, in these columns.")
        + "\n"
    )
    parts.append(_by_robot(robots, rows))
    parts.append(_tools())
    parts.append(_robots(robots))
    return "\n".join(parts)


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
    others = ", ".join(tool.name for tool in TOOLS if tool.name not in tools)
    table = _table(["tool", "loads", *COLUMNS], lines)
    return (
        "In percent of what the sources have, on average over the robots that load.\n\n"
        f"{table}\n– (do not convert between these): {others}.\n"
    )


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


def _cell(share: Share | None) -> str:
    if share is None:
        return "·"
    return "✓" if share.kept == share.of else f"{share.kept}/{share.of}"


def _by_robot(robots: Sequence[Robot], rows: Sequence[Row]) -> str:
    parts = ["## Robot by robot\n\n✓: all is kept; 3/7: three of seven; ·: the source has none.\n"]
    for robot in robots:
        own = [row for row in rows if row.robot == robot]
        has = [name for name in COLUMNS if any(name in row.shares for row in own)]
        lines, faults = [], []
        for row in own:
            title = f"{row.tool.name} → {TITLES[row.route.makes]}"
            if row.shares:
                lines.append([title, *(_cell(row.shares.get(name)) for name in has)])
            else:
                faults.append(f"- {title}: {_code(row.message)}")
        parts.append(
            f"### {robot.name}\n\n"
            f"{robot.kind}, in {TITLES.get(robot.format, robot.format)}\n\n"
            + _table(["tool", *has], lines)
            + ("\nFailed:\n\n" + "\n".join(faults) + "\n" if faults else "")
        )
    return "\n".join(parts)


def _code(text: str) -> str:
    return f"`{text.replace('`', chr(39))}`"


def _tools() -> str:
    lines = []
    for tool in TOOLS:
        commands = dict.fromkeys(route.command.format_map(_Shown()) for route in tool.routes)
        version = tool.version or "this version"
        link = f"[{tool.name}]({tool.url})" if tool.url else tool.name
        shown = "<br>".join(_code(each.replace("|", "\\|")) for each in commands)
        lines.append([link, version, shown, tool.note])
    others = "\n".join(f"- {name}: {why}" for name, why in NOT_TRIED.items())
    return (
        "## The tools\n\n"
        "Each has an environment of its own in `.venv-scoreboard`, with pinned versions. All get "
        "the same folder:\n`robot.urdf` with its meshes beside it, or the MJCF in its own folder. "
        "Yamaro and xacrodoc get xacro itself.\n\n"
        + _table(["tool", "version", "command", ""], lines, left=4)
        + f"\nNot measured:\n\n{others}\n"
    )


class _Shown(dict[str, str]):
    """What stands in a command for what differs between robots."""

    def __missing__(self, name: str) -> str:
        return {"file": "FILE", "root": "LINK"}.get(name, f"[{name}]")


def _robots(robots: Sequence[Robot]) -> str:
    lines = []
    for robot in robots:
        if robot.repository:
            url = f"https://github.com/{robot.repository}/tree/{robot.commit}"
            origin = f"[{robot.repository}]({url})"
        else:
            origin = f"[{PIP[0]} {PIP[1]}](https://pypi.org/project/{PIP[0]}/{PIP[1]}/)"
        given = " ".join(f"{name}:={value}" for name, value in robot.arguments.items())
        path = f"`{robot.path}`" + (f" `{given}`" if given else "")
        lines.append([robot.name, robot.kind, origin, path, robot.licence])
    return "## The robots\n\n" + _table(["robot", "kind", "from", "file", "license"], lines, left=5)
