"""Lowers `states`, `groups`, `collisions`, `loop` and `base` to notes.

Names of parts in them are replaced by those of joints and links when all parts are known.
"""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..model.schema import COLLISIONS, GROUP, LOOP
from ..xml.tree import Element, RobotNote
from .fields import read_value, word_of
from .notes import TRUTHS, check_keys, entries_of, given_once, names_in, one_of
from .numbers import read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..xml.tree import Node, RobotWord
    from .lowering import Lowering

BASES = ("fixed", "free")


def lower_section(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append the notes that a section makes; record what is wrong, and go on."""
    make = {
        "states": _states,
        "groups": _groups,
        "collisions": _collisions,
        "loop": _loop,
        "base": _base,
    }[word.name]
    try:
        make(lowering, word, out)
    except YamaroError as error:
        lowering.absorb(error)


# --- states -----------------------------------------------------------------------------------


def _states(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    for state in entries_of(word, "home: {elbow: 0.5}"):
        note = _note(lowering, "state", state, {"name": state.name})
        for key in entries_of(state, f"{state.name}: {{elbow: 0.5}}"):
            try:
                value, span = read_value(key)
                numbers = read_numbers(
                    lowering,
                    value,
                    span,
                    count=1,
                    name=key.name,
                    trace=word.trace,
                    kind="position of a joint",
                )
            except YamaroError as error:
                lowering.absorb(error)
                continue
            joint = _note(lowering, "joint", key, {"joint": key.name, "value": numbers})
            if isinstance(value, str) and value.strip() != numbers.text:  # it may have a unit
                joint.attributes["written"] = value
            joint.value_spans = {"joint": key.span, "value": span}
            lowering.references.append((joint, "joint"))
            note.children.append(joint)
        out.append(note)


# --- groups and collisions --------------------------------------------------------------------


def _groups(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    for given in entries_of(word, "arm: {chain: [base_link, tool0]}"):
        group = given.with_children([*entries_of(given, "arm: {chain: [base_link, tool0]}")])
        check_keys(group, GROUP.fields)
        note = _note(lowering, "robot-group", group, {"name": group.name})
        for key in group.elements():
            if key.name == "end_effector":
                note.attributes["end_effector"] = one_of(key, TRUTHS)
            elif key.name == "kinematics":
                from .controllers import read_kinematics

                note.children += read_kinematics(lowering, key)
            elif key.name == "parent":
                value, span = read_value(key)
                note.attributes["parent_link"] = word_of(key.name, value, span, owner=key)
                note.value_spans = {**(note.value_spans or {}), "parent_link": span}  # type: ignore[dict-item]
                lowering.references.append((note, "parent_link"))
            else:
                _add_members(lowering, note, key)
        out.append(note)


def _add_members(lowering: Lowering, group: RobotNote, key: Element) -> None:
    names = names_in(key)
    if key.name == "chain":
        if len(names) != 2:
            raise failure(
                "wrong-count",
                f"'chain' takes the first and the last link, but {len(names)} are given",
                key.span,
                hint="write chain: [base_link, tool0]",
                trace=key.trace,
            )
        (base, base_span), (tip, tip_span) = names
        chain = _note(lowering, "chain", key, {"base_link": base, "tip_link": tip})
        chain.value_spans = {"base_link": base_span, "tip_link": tip_span}
        lowering.references += [(chain, "base_link"), (chain, "tip_link")]
        group.children.append(chain)
        return
    attribute = {"links": "link", "joints": "joint", "groups": "group"}[key.name]
    for name, span in names:
        kind = "robot-group" if attribute == "group" else attribute
        member = _note(lowering, kind, key, {"name" if attribute == "group" else attribute: name})
        member.value_spans = {attribute: span, "name": span}
        if attribute != "group":
            lowering.references.append((member, attribute))
        group.children.append(member)


def _collisions(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    note = _note(lowering, "collisions", word, {})
    entries = entries_of(word, "samples: 10000")
    for key in given_once(word.with_children([*entries]), COLLISIONS.fields).values():
        if key.name == "keep":
            for pair in _pairs(key):
                kept = _note(lowering, "keep", key, {"link_1": pair[0], "link_2": pair[1]})
                lowering.references += [(kept, "link_1"), (kept, "link_2")]
                note.children.append(kept)
            continue
        value, span = read_value(key)
        numbers = read_numbers(
            lowering, value, span, count=1, name=key.name, trace=word.trace, kind="number"
        )
        if numbers.values[0] != int(numbers.values[0]) or numbers.values[0] < 0:
            raise failure(
                "bad-number",
                f"'{key.name}' is a whole number from 0",
                span,
                hint=f"write {key.name}: {COLLISIONS.fields[key.name].example}",
                trace=word.trace,
            )
        note.attributes[key.name] = numbers
    out.append(note)


def _pairs(key: Element) -> list[tuple[str, str]]:
    rows = [[name for name, _ in names_in(item)] for item in key.elements()]
    flat = [name for name, _ in names_in(key)] if not rows else []
    if len(flat) == 2:
        return [(flat[0], flat[1])]
    if flat or any(len(row) != 2 for row in rows):
        raise failure(
            "wrong-count",
            "'keep' lists pairs of links",
            key.span,
            hint="write keep: [[left_hand, head], [right_hand, head]]",
            trace=key.trace,
        )
    return [(row[0], row[1]) for row in rows]


# --- loop and base ----------------------------------------------------------------------------


def _loop(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    keys = given_once(word, LOOP.fields)
    for name, example in (("name", "bar"), ("type", "revolute"), ("between", "[bar_end, pin]")):
        if name not in keys:
            raise failure(
                "missing-key",
                f"`loop` needs an entry `{name}`",
                word.span,
                hint=f"write {name}: {example}",
                trace=word.trace,
            )
    kind = one_of(keys["type"], LOOP.fields["type"].choices)
    ends = names_in(keys["between"])
    if len(ends) != 2:
        raise failure(
            "wrong-count",
            f"'between' takes two frames or links, but {len(ends)} are given",
            keys["between"].span,
            hint="write between: [bar_end, pin]",
            trace=word.trace,
        )
    name = word_of("name", *read_value(keys["name"]), owner=word)
    attributes = {"name": name, "type": kind, "frame_1": ends[0][0], "frame_2": ends[1][0]}
    note = _note(lowering, "robot-loop", word, attributes)
    note.value_spans = {"frame_1": ends[0][1], "frame_2": ends[1][1]}
    axis = keys.get("axis")
    if axis is not None:
        value, span = read_value(axis)
        row = read_numbers(lowering, value, span, count=3, name="axis", trace=word.trace)
        note.attributes["axis"] = row
    elif kind == "revolute":
        note.attributes["axis"] = "1 0 0"
    lowering.references += [(note, "frame_1"), (note, "frame_2")]
    out.append(note)


def _base(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    out.append(_note(lowering, "base", word, {"type": one_of(word, BASES)}))


# --- reading ----------------------------------------------------------------------------------


def _note(
    lowering: Lowering, kind: str, key: Element, attributes: Mapping[str, object]
) -> RobotNote:
    return RobotNote(kind, key.span, dict(attributes), trace=lowering.trace)
