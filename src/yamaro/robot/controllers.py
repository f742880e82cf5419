"""`controllers`: notes of the controllers that ros2_control runs, with their parameters.

A plain value beside the controllers is a parameter of the controller manager, as in the file that
ROS reads.
"""

from __future__ import annotations

from math import isfinite

from ..diagnostics import YamaroError, did_you_mean, failure, meant_word, unknown_word
from ..model.controllers import (
    BY_JOINT,
    DISTROS,
    INTEGER,
    LENGTHS,
    MANAGER,
    OF_ALL,
    OF_MANAGER,
    PARAMETER,
    SOLVER_KEYS,
    SOLVERS,
    TIMES,
    TYPES,
    ControllerType,
    known_type,
)
from ..model.schema import CONTROLLER
from ..xml.tree import Element, RobotNote, Text
from ..xml.values import LiteralList, format_value, plain_value
from .control import drivable_joints, matches
from .fields import read_value, word_of
from .notes import LIST_ITEM, entries_of, given_once, names_in, one_of, place_of
from .numbers import parse_number, read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

    from ..source import Span
    from ..xml.tree import Node, RobotWord
    from .control import Patterns
    from .lowering import Lowering

NOTE, MANAGER_NOTE = "robot-controller", "controller-manager"
_EXAMPLE = "arm_controller: {type: joint_trajectory}"
_TRUE, _FALSE = ("true", "True", "TRUE"), ("false", "False", "FALSE")
_SPECIAL = {".inf": "inf", "-.inf": "-inf", ".nan": "nan"}


class PendingController:
    """A controller whose joints are not chosen yet.

    Attributes:
        note: its note.
        known: what is known of its type, or None.
        joints: patterns for joints, or None for the default.
    """

    __slots__ = ("joints", "known", "note")

    def __init__(
        self, note: RobotNote, known: ControllerType | None, joints: Patterns | None
    ) -> None:
        self.note = note
        self.known = known
        self.joints = joints


def lower_controllers(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append the notes of a section `controllers`; record what is wrong, and go on."""
    manager = RobotNote(MANAGER_NOTE, word.span, {}, trace=lowering.trace)
    try:
        entries = entries_of(word, f"controllers: {{{_EXAMPLE}}}")
        given = given_once(word.with_children([*entries]))
    except YamaroError as error:
        lowering.absorb(error)
        return
    for entry in given.values():
        try:
            # Whether an entry of the section is a controller: a mapping that no parameter is.
            is_mapping = any(isinstance(child, Element) for child in entry.children) or any(
                isinstance(child, Text) and isinstance(child.value, dict)
                for child in entry.children
            )
            if is_mapping and entry.name not in MANAGER:
                out.append(_controller(lowering, entry))
            elif entry.name == "distro":
                manager.attributes["distro"] = one_of(entry, DISTROS)
            else:
                if entry.name not in MANAGER:
                    raise unknown_word(
                        "unknown-key",
                        f"'{entry.name}' is not a parameter of the controller manager",
                        entry.span,
                        entry.name,
                        (*MANAGER, "distro"),
                        hint=f"a controller has a type: {entry.name}: {{type: joint_trajectory}}",
                        trace=entry.trace,
                    )
                manager.children.append(_Reader(lowering, INTEGER, True).read(entry))
        except YamaroError as error:
            lowering.absorb(error)
    if manager.attributes or manager.children:
        out.append(manager)


def _controller(lowering: Lowering, entry: Element) -> RobotNote:
    body = entry.with_children([*entries_of(entry, _EXAMPLE)])
    keys = given_once(body)
    if "type" not in keys:
        near = did_you_mean("type", [name for name in keys if len(name) == len("type")])
        raise failure(
            "missing-key",
            f"the controller '{entry.name}' needs an entry `type`",
            entry.span,
            hint=near or "write type: joint_trajectory, or the class of a plugin",
            trace=entry.trace,
        )
    note = RobotNote(NOTE, entry.span, {"name": entry.name}, trace=lowering.trace)
    places: dict[str, Span] = {}
    value, place = read_value(keys["type"])
    kind = note.attributes["type"] = word_of("type", value, place, owner=entry)
    places["type"] = place
    known = _type_of(kind, place, entry)
    takes_joints = known is None or "joints" not in known.named
    for name, key in keys.items():
        if name == "group":
            group = word_of("group", *read_value(key), owner=entry)
            member = RobotNote("robot-group", key.span, {"name": group}, trace=lowering.trace)
            member.value_spans = {"name": read_value(key)[1]}
            note.children.append(member)
        elif name != "type" and not (name == "joints" and takes_joints):
            if known is not None:
                _warn_of_unknown(lowering, known, key)
            reader = _Reader(lowering, known.integers if known else (), known is not None)
            made = reader.read(key)
            if known is not None:
                _refuse_other_kind(known, key, made)
            note.children.append(made)
    note.value_spans = places  # type: ignore[assignment]
    if "group" in keys and "joints" in keys and takes_joints:
        raise failure(
            "given-twice",
            f"the controller '{entry.name}' has `joints` and a `group`",
            keys["group"].span,
            hint="keep one of the two: a group has its joints",
            trace=entry.trace,
        )
    joints = names_in(keys["joints"]) if "joints" in keys and takes_joints else None
    lowering.controls.append(PendingController(note, known, joints))
    return note


def _type_of(word: str, place: Span, entry: Element) -> ControllerType | None:
    """Return what is known of a type; an unknown word is an error, an unknown class is not."""
    known = known_type(word)
    if known is None and ("/" not in word or " " in word):
        raise unknown_word(
            "unknown-controller-type",
            f"'{word}' is not a type of controller",
            place,
            word,
            TYPES,
            hint=f"write one of {', '.join(TYPES)}, or a class: package/{word}",
            trace=entry.trace,
        )
    return known


def _warn_of_unknown(lowering: Lowering, known: ControllerType, key: Element) -> None:
    """Report a parameter that is probably misspelt: ROS 2 would ignore it."""
    first, dot, _ = key.name.partition(".")
    names = (*known.parameters, *CONTROLLER.fields, *OF_ALL, *OF_MANAGER)
    if first in names:
        return
    hint, fix = meant_word(first, names, key.span)
    if hint is not None:
        lowering.report(
            "unknown-parameter",
            f"{known.plugin.partition('/')[2]} has no parameter '{first}'; ROS ignores it",
            key.span,
            hint=hint,
            trace=key.trace_within(lowering.trace),
            fix=None if dot else fix,
        )


def read_kinematics(lowering: Lowering, key: Element) -> list[Element]:
    """Return the parameters of the solver that the entry `kinematics` of a group says.

    Raises:
        YamaroError: there is no such solver.
    """
    if any(isinstance(child, Element) for child in key.children):
        entries = given_once(key)
    else:
        entries = {"solver": key}
    found = []
    for name, entry in entries.items():
        renamed = Element(
            SOLVER_KEYS.get(name, name), entry.span, {}, entry.children, trace=entry.trace
        )
        if name == "solver":
            value, span = read_value(entry)
            word = word_of(name, value, span, owner=key)
            if word not in SOLVERS and "/" not in word:
                raise unknown_word(
                    "bad-choice",
                    f"'{word}' is not a solver of inverse kinematics",
                    span,
                    word,
                    SOLVERS,
                    hint=f"write one of {', '.join(SOLVERS)}, or the class of a plugin",
                    trace=key.trace,
                )
            found.append(_parameter(renamed, "text", SOLVERS.get(word, word)))
        else:
            known = name in SOLVER_KEYS
            found.append(_Reader(lowering, (), known).read(renamed))
    return found


def _refuse_other_kind(known: ControllerType, key: Element, made: Element) -> None:
    """Raise YamaroError if a parameter that names something is not a text, or a list of texts."""
    name = key.name
    kinds = {str(item.attributes["kind"]) for item in made.elements()}
    kind = made.attributes["kind"]
    is_text = name == "joint" or name.endswith(("_name", "frame_id"))
    is_list = name in ("command_interfaces", "state_interfaces") and known.joints != ""
    is_list = is_list or (name in known.named and not is_text)
    if (is_text and kind != "text") or (
        is_list and kind != "text" and (kind != "list" or kinds - {"text"})
    ):
        raise failure(
            "value-expected",
            f"'{name}' takes {'a name' if is_text else 'a list of names'}",
            place_of(key),
            hint="quote a name that looks like a number: '1'",
            trace=key.trace,
        )


# --- values -------------------------------------------------------------------------------------


class _Reader:
    """Reads parameters with the types that ROS reads: a plain scalar is typed as in YAML 1.2.

    The numbers of a known controller are doubles, except for those that are known to be integers,
    and may have units.
    """

    __slots__ = ("_integers", "_is_known", "_lowering")

    def __init__(self, lowering: Lowering, integers: Collection[str], is_known: bool) -> None:
        self._lowering = lowering
        self._integers = integers
        self._is_known = is_known

    def read(self, key: Element) -> Element:
        """Return the element of a parameter; see `model/controllers.py`."""
        texts = [child for child in key.children if isinstance(child, Text)]
        items = [child for child in key.elements() if child.name == LIST_ITEM]
        in_items = [child for item in items for child in item.elements()]
        if len(in_items) == len(items) and all(child.name != LIST_ITEM for child in in_items):
            items = []  # a mapping, of which each entry is an item
        if items:
            return self._list(key, [self.read(item) for item in items])
        if in_items:
            return self._map(key, [self.read(child) for child in in_items])
        if key.elements():
            return self._map(key, [self.read(child) for child in key.elements()])
        value: object = texts[0].value if texts else ""
        return self._value(key, value, texts[0].span if texts else key.span)

    def _value(self, key: Element, value: object, span: Span) -> Element:
        value = plain_value(value)
        if isinstance(value, dict):
            inner = [
                self._value(Element(format_value(name), span, {}, trace=key.trace), each, span)
                for name, each in value.items()
            ]
            return self._map(key, inner)
        if isinstance(value, (list, tuple)):
            is_written = isinstance(value, LiteralList)
            item = Element(key.name, key.span, {}, trace=key.trace)
            return self._list(
                key,
                [
                    self._scalar(item, each, span, is_quoted=is_written and _is_quoted(each, span))
                    if isinstance(each, (str, bool, int, float))
                    else self._value(item, each, span)
                    for each in value
                ],
            )
        is_quoted = span.source.text[span.start : span.start + 1] in ("'", '"', "|", ">")
        return self._scalar(key, value, span, is_quoted=is_quoted)

    def _scalar(self, key: Element, value: object, span: Span, *, is_quoted: bool) -> Element:
        """Return a scalar: what is written is typed as in YAML, one of an expression is kept."""
        kind, text = "text", value if isinstance(value, str) else format_value(value)
        if isinstance(value, bool):
            kind = "bool"
        elif isinstance(value, (int, float)):
            kind, text = "int" if isinstance(value, int) else "float", repr(value)
        elif not is_quoted and "$(" not in span.source.text[span.start : span.end]:
            kind, text = self._plain(key, text.strip(), span)
        if kind in ("int", "float") and self._is_known:
            if key.name in self._integers:
                kind, text = self._integer(key, text, span)
            else:
                kind, text = "float", repr(float(text))
        return _parameter(key, kind, text)

    def _plain(self, key: Element, text: str, span: Span) -> tuple[str, str]:
        """Return the kind of a plain scalar, and its text as Python reads it."""
        if text in _TRUE or text in _FALSE:
            return "bool", "true" if text in _TRUE else "false"
        if text.lower() in _SPECIAL:
            return "float", _SPECIAL[text.lower()]
        number = parse_number(text)
        if number is not None and not text[:1].isalpha():
            digits = text.lstrip("+-")
            return ("int", str(int(text))) if digits.isdigit() else ("float", repr(number))
        has_unit = text[-1:].isalpha() or "^" in text  # as in m/s^2
        if self._is_known and text[:1] in "+-.0123456789" and has_unit:
            return "float", repr(self._quantity(key, text, span))
        return "text", text

    def _quantity(self, key: Element, text: str, span: Span) -> float:
        """Return the number of a text with a unit, in SI."""
        name = key.name.rpartition(".")[2]
        kind = "length" if name in LENGTHS else "frequency"
        kind = "time" if name in TIMES or name in SOLVER_KEYS.values() else kind
        if kind == "frequency" and not name.endswith("_rate"):
            from ..units import UnknownUnit, parse_quantity

            try:
                return float(parse_quantity(text)[0])
            except (UnknownUnit, ValueError, OverflowError):
                pass
        numbers = read_numbers(
            self._lowering, text, span, count=1, name=name, trace=key.trace, kind=kind
        )
        return numbers.values[0]

    def _integer(self, key: Element, text: str, span: Span) -> tuple[str, str]:
        number = float(text)
        if not number.is_integer():
            raise failure(
                "bad-number",
                f"'{key.name}' is a whole number",
                span,
                hint=f"write {key.name}: {max(1, round(number)) if isfinite(number) else 1}",
                trace=key.trace,
            )
        return "int", str(int(number))

    def _list(self, key: Element, items: list[Element]) -> Element:
        """Return a list; ROS takes numbers of one kind in it."""
        kinds = {item.attributes["kind"] for item in items}
        if kinds & {"list", "map"}:
            raise failure(
                "value-expected",
                f"the list '{key.name}' has lists or mappings in it",
                key.span,
                hint="ROS takes lists of plain values; give a parameter for each",
                trace=key.trace,
            )
        if kinds == {"int", "float"}:
            for item in items:
                own = "sensor" if "sensor" in item.attributes else "reference"
                item.attributes["kind"] = "float"
                item.attributes[own] = repr(float(str(item.attributes[own])))
        elif len(kinds) > 1:
            raise failure(
                "value-expected",
                f"the list '{key.name}' has values of several types: "
                + ", ".join(sorted(map(str, kinds))),
                key.span,
                hint='ROS takes lists of one type; quote what is a text: "1"',
                trace=key.trace,
            )
        made = _parameter(key, "list", None)
        made.children += items
        return made

    def _map(self, key: Element, items: list[Element]) -> Element:
        made = _parameter(key, "map", None)
        made.children += items
        return made


def _is_quoted(item: object, span: Span) -> bool:
    """Return whether an item of a written list is in quotes, as far as its text says."""
    text = span.source.text[span.start : span.end]
    return isinstance(item, str) and (f'"{item}"' in text or f"'{item}'" in text)


def _parameter(key: Element, kind: str, text: str | None) -> Element:
    made = RobotNote(PARAMETER, key.span, {"refname": key.name, "kind": kind}, trace=key.trace)
    if text is not None:
        made.attributes["sensor" if key.name == "sensor_name" else "reference"] = text
    return made


# --- joints -------------------------------------------------------------------------------------


def choose_joints(
    lowering: Lowering, elements: Sequence[Element], controllers: Iterable[PendingController]
) -> None:
    """Put the joints of each controller into its note, before any prefix.

    Joints are named as themselves or by their parts, in `joints` by patterns as well; without
    `joints` and `group` a type that takes a list of joints has all that are driven.
    """
    parts = {joint: part for part, joint in lowering.part_joints.items()}
    known = drivable_joints(elements)
    names = {parts.get(joint, joint): joint for joint in known} | {joint: joint for joint in known}
    every = {
        **lowering.part_joints,
        **{format_value(e.attributes.get("name")): "" for e in elements if e.name == "joint"},
    }
    # The joints in blocks of ros2_control, whether from words or from files.
    in_blocks: set[str] = set()
    for each in elements:
        if each.name == "ros2_control":
            for child in each.elements():
                if child.name == "joint":
                    key = "joint" if "joint" in child.attributes else "name"
                    in_blocks.add(format_value(child.attributes.get(key)))
    driven = in_blocks or known
    for controller in controllers:
        note = controller.note
        has_group = any(child.name == "robot-group" for child in note.elements())
        chosen: list[str] = []
        if controller.joints is not None:
            for pattern, span in controller.joints:
                found = [
                    joint
                    for joint in known
                    if matches(joint, pattern) or matches(parts.get(joint, joint), pattern)
                ]
                if not found:
                    _refuse(lowering, note, pattern, span, names)
                chosen += [joint for joint in found if joint not in chosen]
        elif not has_group and controller.known is not None and controller.known.joints:
            chosen = [joint for joint in known if joint in driven]
        note.children += [RobotNote("joint", note.span, {"joint": name}) for name in chosen]
        for parameter in note.elements():
            if parameter.name == PARAMETER:
                _name_joints(lowering, controller, parameter, names, every)


def _name_joints(
    lowering: Lowering,
    controller: PendingController,
    parameter: Element,
    names: dict[str, str],
    every: dict[str, str],
) -> None:
    """Replace the names of parts in a parameter that names joints; record what is not a joint."""
    name = str(parameter.attributes["refname"])
    if name.partition(".")[0] in BY_JOINT:
        for inner in parameter.elements():
            key = str(inner.attributes["refname"])
            inner.attributes["refname"] = names.get(key, key)
        return
    if controller.known is None or name not in controller.known.named:
        return
    for text in [parameter, *parameter.elements()]:
        if text.attributes["kind"] == "text":
            word = str(text.attributes["reference"])
            if word in names or name == "extra_joints":
                text.attributes["reference"] = names.get(word, word)
            else:
                _refuse(lowering, controller.note, word, parameter.span, names, every=every)


def _refuse(
    lowering: Lowering,
    note: RobotNote,
    name: str,
    span: Span,
    names: dict[str, str],
    *,
    every: Collection[str] = (),
) -> None:
    message = f"no joint that can be driven is named as '{name}' says"
    if name in every:
        message = f"the joint '{name}' cannot be driven: it is fixed, or follows another one"
    known = ", ".join([*dict.fromkeys(names.values())][:6])
    hint = did_you_mean(name, names) or f"the joints are {known or 'none'}"
    lowering.absorb(failure("controller-joints", message, span, hint=hint, trace=note.trace))
