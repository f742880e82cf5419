"""Writes the tables in the docs that follow from the schema, the units and the table of losses.

python scripts/schema_tables.py            writes them: what is between `<!-- schema: NAME -->`
                                           and `<!-- end of schema -->` in docs/
python scripts/schema_tables.py --check    only reports which pages are out of date
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import groupby
from pathlib import Path
from textwrap import fill

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "scripts")]

from derived import Tables, update  # noqa: E402

from yamaro.model.controllers import TYPES as KNOWN_CONTROLLERS  # noqa: E402
from yamaro.model.quantities import default_of, si_units_of  # noqa: E402
from yamaro.model.schema import (  # noqa: E402
    ELEMENTS,
    FITTING,
    JOINT_SENSORS,
    LINK_SENSORS,
    RECORDS,
    SENSOR,
    SENSORS,
    WORDS,
    Field,
    Thing,
)
from yamaro.motors import MOTORS  # noqa: E402
from yamaro.targets.holding import FORMATS, ROWS, Cell, Missing  # noqa: E402
from yamaro.targets.losses import LOST  # noqa: E402
from yamaro.targets.table import TARGETS  # noqa: E402
from yamaro.units import UNITS, name_of  # noqa: E402

OF_JOINT = [ELEMENTS[name] for name in RECORDS if len(ELEMENTS[name].fields) > 1]
"""The keys of a joint that have entries."""
OF_ROS_1 = ("safety_controller", "calibration")
"""Those that only controllers of ROS 1 read."""


def written() -> dict[Path, str]:
    """Return the pages that have such tables, with the texts that they have to have."""
    texts = {path: path.read_text(encoding="utf-8") for path in sorted(DOCS.glob("*.md"))}
    return {path: BLOCKS.fill(text) for path, text in texts.items() if BLOCKS.names(text)}


# --- cells ------------------------------------------------------------------------------------


def table(head: str, rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table in Markdown; `head` has its columns between bars."""
    lines = [f"| {head} |", "|" + "---|" * (head.count("|") + 1)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(re.sub("  +", " ", line) for line in lines) + "\n"


def coded(names: Iterable[str], separator: str = " ") -> str:
    """Return names as code."""
    return separator.join(f"`{name}`" for name in names)


def about(field: Field) -> str:
    """Return what a field is; the words that it may be as code."""
    if field.choices and field.help == listed(field.choices):
        return listed(coded(field.choices).split(" "))
    return field.help


def listed(words: Iterable[str]) -> str:
    """Return words as a sentence has them: "a, b or c"."""
    *first, last = words
    return f"{', '.join(first)} or {last}" if first else last


def default(field: Field) -> str:
    """Return the cell of a default."""
    text = default_of(field)
    return "required" if field.required else f"`{text}`" if text else ""


# --- tables -----------------------------------------------------------------------------------


def entries(thing: Thing) -> str:
    """Return the entries of a word, with their units if any has one, and their defaults."""
    fields = thing.fields.values()
    if not any(si_units_of(field.kind) for field in fields):
        rows = [(f"`{each.name}`", about(each), default(each)) for each in fields]
        return table("entry | meaning | default", rows)
    return table(
        "entry | meaning | unit | default",
        [
            (f"`{each.name}`", about(each), ", ".join(si_units_of(each.kind)), default(each))
            for each in fields
        ],
    )


def of_joints() -> str:
    """Return the entries of the keys of a joint; limits that are left out are assumed."""
    rows = []
    for thing in OF_JOINT:
        for number, field in enumerate(thing.fields.values()):
            is_assumed = thing.name == "limit" and (field.required or field.default is not None)
            rows.append(
                (
                    "" if number else f"`{thing.name}`",
                    f"`{field.name}`",
                    about(field),
                    ", ".join(si_units_of(field.kind)),
                    "[assumed](#limits)" if is_assumed else default(field),
                )
            )
    return table("key | entry | meaning | unit | default", rows)


def sensors() -> str:
    """Return the entries of each type of sensor."""
    rows: list[tuple[str, ...]] = []
    common = [field for field in SENSOR.fields.values() if field.name != "type"]
    for kinds, fields in [("all", common), *of_types()]:
        for number, field in enumerate(fields):
            unit = ", ".join(si_units_of(field.kind))
            first = "" if number else kinds
            rows.append((first, f"`{field.name}`", about(field), unit, default(field)))
        if not fields:
            rows.append((kinds, "none of its own", "", "", ""))
    return table("type | entry | meaning | unit | default", rows)


def of_types() -> Iterator[tuple[str, list[Field]]]:
    """Give the types of sensors that have the same entries, with these."""
    alike: dict[tuple[str, ...], list[str]] = {}
    for name, thing in LINK_SENSORS.items():
        alike.setdefault(tuple(thing.fields), []).append(name)
    for names in sorted(alike.values(), key=lambda each: not SENSORS[each[0]].fields):
        yield coded(names, ", "), list(SENSORS[names[0]].fields.values())
    for name, thing in JOINT_SENSORS.items():
        yield f"`{name}`, in a joint", list(thing.fields.values())


def units() -> str:
    """Return the units of each quantity."""
    rows = []
    for dimension, words in groupby(UNITS, key=lambda word: UNITS[word].dimension):
        quantity = name_of(dimension).removeprefix("an ").removeprefix("a ")
        rows.append((quantity, coded(words)))
    return table("quantity | units", rows)


def holding() -> str:
    """Return how each format holds each value; fields that fare alike are in one row."""
    things: dict[str, list[str]] = {}
    for thing in (*ELEMENTS.values(), *WORDS.values(), *SENSORS.values()):
        rows = []
        for _, names in groupby(thing.fields, key=lambda field: fates(thing, field)):
            fields = list(names)
            columns = []
            for cells in zip(*(ROWS[f"{thing.name}.{each}"] for each in fields), strict=True):
                text = " ".join(dict.fromkeys(map(held, cells)))
                columns.append("yes" if text == coded(fields) else text)
            rows.append(f"{coded(fields)} | {' | '.join(columns)}")
        things.setdefault("\n".join(rows), []).append(f"`{thing.name}`")
    return table(
        "of | value | " + " | ".join(TARGETS[format].title for format in FORMATS),
        [
            ("" if number else ", ".join(names), row)
            for rows, names in things.items()
            for number, row in enumerate(filter(None, rows.split("\n")))
        ],
    )


def fates(thing: Thing, field: str) -> list[str]:
    """Return what happens to a field in each format, without the names that it has there."""
    cells = ROWS[f"{thing.name}.{field}"]
    return [held(cell) if isinstance(cell, Missing) or not cell else "held" for cell in cells]


def held(cell: Cell) -> str:
    """Return the cell of a format: the name of the value there, or what happens to it."""
    if isinstance(cell, Missing):
        return "in part" if cell.is_conditional and cell.kind == LOST else cell.kind
    return f"`{cell.rpartition(':')[2]}`" if cell else "–"


def motors() -> str:
    """Return the names of the motors of the catalogue."""
    return fill(", ".join(f"`{name}`" for name in MOTORS) + ".", 120) + "\n"


def controller_types() -> str:
    """Return the words for types of controllers."""
    return (
        fill(", ".join(f"`{each.word}`" for each in KNOWN_CONTROLLERS.values()) + ".", 120) + "\n"
    )


# --- the cheat sheet --------------------------------------------------------------------------


def short_joints() -> str:
    """Return the entries of the keys of a joint that ROS 2 reads, in one row each."""
    rows = []
    for thing in [each for each in OF_JOINT if each.name not in OF_ROS_1]:
        alone = f"; or the {thing.scalar} alone" if thing.scalar else ""
        rows.append((f"`{thing.name}`", coded(thing.fields) + alone))
    return table("key of `joint` | entries", rows)


def short_words() -> str:
    """Return the entries of sensors, actuators and surfaces."""
    common = coded((name for name in SENSOR.fields if name != "type"), ", ")
    rows = [
        (
            "[`sensor`](language.md#sensors) in a link",
            f"`type`, {common}; a pose, or `frame`",
        )
    ]
    for kinds, fields in of_types():
        rows.append((f"– {kinds}", coded(field.name for field in fields) or "none of its own"))
    actuator, surface = WORDS["actuator"], WORDS["surface"]
    commands = coded(actuator.fields["command"].choices)
    others = coded(name for name in actuator.fields if name != "command")
    rows += [
        (
            "[`actuator`](language.md#actuators-and-control) in a joint",
            f"`command` ({commands}), {others}",
        ),
        ("[`surface`](language.md#surfaces) in a collision", coded(surface.fields)),
        ("[`control:`](language.md#ros2_control)", coded(WORDS["control"].fields)),
    ]
    return table("word | keys", rows)


def short_sections() -> str:
    """Return the entries of groups, controllers, collisions and loops."""
    words = {
        "a group in `groups`": "group",
        "[`controllers`](language.md#controllers)": "controllers",
        "a controller in it": "controller",
        "`collisions`": "collisions",
        "`loop`": "loop",
    }
    return table("of | keys", [(text, coded(WORDS[name].fields)) for text, name in words.items()])


def values(things: Iterable[Thing], head: str) -> str:
    """Return the values of things, for the API."""
    return table(head, [(f"`{thing.name}`", coded(thing.fields, ", ")) for thing in things])


TABLES: dict[str, Callable[[], str]] = {
    "joint": of_joints,
    "fitting": partial(entries, FITTING),
    "sensors": sensors,
    "units": units,
    "formats": holding,
    "motors": motors,
    "controller types": controller_types,
    "joint values": partial(values, OF_JOINT, "of a joint | values"),
    "word values": partial(values, [WORDS["actuator"], WORDS["surface"]], "each | values"),
    "short joints": short_joints,
    "short words": short_words,
    "short sections": short_sections,
    **{
        name: partial(entries, WORDS[name])
        for name in (
            *("actuator", "surface", "control", "controllers", "controller"),
            *("loop", "group", "collisions"),
        )
    },
}
"""What writes each table, by the name in its mark."""
BLOCKS = Tables("schema", lambda name: TABLES[name]())

if __name__ == "__main__":
    sys.exit(update(written(), sys.argv[1:]))
