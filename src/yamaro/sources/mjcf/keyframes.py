"""Keyframes of the whole model: those of the document, and of the documents that it attaches.

MuJoCo puts the numbers of an attached keyframe where the joints and actuators of its document are;
the others rest where the model places them. A keyframe with too few numbers has the first ones.
"""

from __future__ import annotations

from ...diagnostics import failure
from ...model import making
from ...model.making import Place
from ...model.pose import UNTURNED, quaternion_from_rotation
from ...xml.tree import SAID, Element
from .actuators import POSITION, Drives
from .blocks import kept
from .compiler import fault, number, numbers
from .tree import Context, Reader, joint_kinds, type_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from .building import Builder
    from .tree import Body, Placed, Thing

    Spot = tuple[int, ...]
    """The identities of an element and of what attaches it: what is called so in the model."""

SECTION = "keyframe"
QPOS, QVEL, ACT, CTRL, MPOS, MQUAT = "qpos", "qvel", "act", "ctrl", "mpos", "mquat"
WIDTHS = {
    QPOS: {"free": 7, "ball": 4, "hinge": 1, "slide": 1},
    QVEL: {"free": 6, "ball": 3, "hinge": 1, "slide": 1},
}
"""How many numbers a joint has in the rows of a keyframe."""
MADE_BY_MUJOCO = frozenset(("flexcomp", "composite"))
"""What MuJoCo makes bodies with joints of."""
ACTIVE = frozenset(("intvelocity", "muscle", "cylinder"))
PASSIVE = frozenset(("motor", "velocity", "damper", "adhesion", "general", "position"))
"""Actuators that have a state, and those that have none unless they say so."""
ROUNDING = 1e-9
"""How far a keyframe may be outside of a limit, in radians or metres."""


class Row:
    """The numbers of one attribute of keyframes, such as `qpos`, and whose they are.

    Attributes:
        slots: the first number and how many there are, by what they are of.
        rest: the numbers where the model places all.
    """

    __slots__ = ("rest", "slots")

    def __init__(self) -> None:
        self.slots: dict[Spot, tuple[int, int]] = {}
        self.rest: list[float] = []

    def add(self, spot: Spot, rest: Iterable[float]) -> None:
        """Append the numbers of something."""
        start = len(self.rest)
        self.rest += rest
        self.slots[spot] = (start, len(self.rest) - start)


class Rows:
    """The rows of keyframes of a model.

    Attributes:
        by_name: the row of each attribute whose size is known.
        is_known: whether MuJoCo makes no further joints.
    """

    __slots__ = ("by_name", "is_known")

    def __init__(self, world: Body, drives: Drives) -> None:
        self.by_name = {name: Row() for name in (QPOS, QVEL, ACT, CTRL, MPOS, MQUAT)}
        self.is_known = True
        found = self.by_name
        for body in world.iter():
            self.is_known &= not any(each.kind in MADE_BY_MUJOCO for each in body.others)
            for joint in body.joints:
                kind, spot = type_of(joint), joint.spot
                found[QPOS].add(spot, _rest(body, joint, kind))
                found[QVEL].add(spot, [0.0] * WIDTHS[QVEL][kind])
            if body.thing.text("mocap") == "true":
                found[MPOS].add(body.thing.spot, body.pose.position)
                found[MQUAT].add(body.thing.spot, _turn(body))
        counts = [activations(thing) for thing, _ in drives.all]
        for (thing, _), count in zip(drives.all, counts, strict=True):
            found[CTRL].add(thing.spot, [0.0])
            found[ACT].add(thing.spot, [0.0] * (count or 0))
        if None in counts:
            del found[ACT]


def _rest(body: Body, joint: Placed, kind: str) -> list[float]:
    if kind == "free":
        return [*body.pose.position, *_turn(body)]
    if kind == "ball":
        return [1.0, 0.0, 0.0, 0.0]
    angle = joint.context.compiler.angle if kind == "hinge" else float
    return [angle(number(joint.given, "ref", 0.0))]


def _turn(body: Body) -> tuple[float, ...]:
    turn = body.pose.rotation
    return (1.0, 0.0, 0.0, 0.0) if turn == UNTURNED else quaternion_from_rotation(turn)


def activations(thing: Thing) -> int | None:
    """Return how many numbers the state of an actuator has; None if only MuJoCo knows."""
    has_state = thing.text("dyntype") not in (None, "none") or "timeconst" in thing.given
    if thing.kind in ACTIVE or (thing.kind in PASSIVE and has_state):
        return max(1, int(number(thing.given, "actdim", 1.0)))
    return 0 if thing.kind in PASSIVE else None


def keyframes(builder: Builder) -> Iterator[Element]:
    """Yield what is kept of the keyframes of all documents; note them as states.

    Raises:
        YamaroError: one has too many numbers, two have one name, or there are too many.
    """
    found = [(context, thing) for context in builder.contexts for thing in _of(context)]
    if not found:
        return
    whole = Rows(builder.world, builder.drives)
    size = sum(len(row.rest) for row in whole.by_name.values())
    parts: dict[int, Rows] = {}
    names: set[str] = set()
    copied: set[tuple[str, int]] = set()
    limits = builder.host.limits
    for count, (context, thing) in enumerate(found, start=1):
        if count * size > limits.statements:
            raise failure(
                "limit-statements",
                "the keyframes have more numbers than the limit allows",
                thing.span,
                hint=limits.hint("statements"),
            )
        if context.place:
            thing.name = thing.name or context.prefix
        if context.suffix:  # the first copy of what a `<replicate>` attaches has its keyframes
            thing.name = thing.name.removesuffix(context.suffix)
            if (thing.name, id(thing.element)) in copied:
                continue
            copied.add((thing.name, id(thing.element)))
        if thing.name in names:
            message = f"there are two keyframes named '{thing.name}'"
            raise fault(message, thing.span, "give each its own name")
        names |= {thing.name} - {""}
        if context.part is not None and id(context.document) not in parts:
            parts[id(context.document)] = _of_document(builder, context)
        own = parts[id(context.document)] if context.part is not None else whole
        if not (whole.is_known and own.is_known):
            if context.place:
                builder.lose("a keyframe of bodies that MuJoCo makes", thing.span)
                continue
        else:
            for name in whole.by_name.keys() & thing.given.keys():
                if name in own.by_name:
                    _spread(context, thing, name, whole.by_name[name], own.by_name[name])
        element = kept(thing)
        stated = add_state(builder, context, thing, element, whole)
        if builder.host.is_part and whole.is_known and own.is_known:
            _say_by_names(builder, thing, element, whole, stated)
        yield element


def _of(context: Context) -> list[Thing]:
    """Return the keyframes of a document, as far as they come with it."""
    return context.things(SECTION) if context.has_keyframes else []


def _of_document(builder: Builder, context: Context) -> Rows:
    """Return the rows of a document of which a part is attached."""
    reader = Reader(builder.host, builder.reader.documents)
    outer = Context(context.document, builder.host)
    world = reader.world(outer)
    kinds, _ = joint_kinds(world)
    return Rows(world, Drives([outer, *reader.attached], kinds))


def _spread(context: Context, thing: Thing, name: str, whole: Row, own: Row) -> None:
    """Give an attribute of a keyframe a number for each of the model."""
    span = thing.given[name][1]
    given = numbers(thing.given, name, 0, 1 << 20) or []
    outer = context.place
    if context.part is not None:
        slots = [((*outer, *spot), width) for spot, (_, width) in own.slots.items()]
    else:
        slots = [
            (spot, width) for spot, (_, width) in whole.slots.items() if spot[: len(outer)] == outer
        ]
    most = sum(width for _, width in slots)
    if len(given) > most:
        raise fault(
            f"'{name}' has {len(given)} numbers, and the model has {most}",
            span,
            f"write {most} or fewer",
        )
    if not outer and len(given) == most:
        return
    found, at = [*whole.rest], 0
    for spot, width in slots:
        values = given[at : at + width]
        at += width
        if spot in whole.slots:
            start = whole.slots[spot][0]
            found[start : start + len(values)] = values
    thing.given[name] = (" ".join(map(repr, found)), span)


def add_state(
    builder: Builder, context: Context, key: Thing, element: Element, rows: Rows
) -> dict[str, float]:
    """Note the positions of joints in a keyframe, as far as limits allow them; return them.

    Those of an attached document are the positions of its joints.

    Args:
        builder: the robot.
        context: the document that has the keyframe.
        key: the keyframe.
        element: what is kept of it.
        rows: the rows of the model.
    """
    row = numbers(key.given, QPOS, 0, 1 << 20)
    whole = rows.by_name[QPOS]
    if row is None or not key.name or len(row) != len(whole.rest):
        return {}
    place = Place(key.span, {"name": key.name_span})
    at = Place(key.span, {"value": key.given[QPOS][1], "joint": key.name_span})
    children: list[Element] = []
    outer, limits = context.place, builder.limits
    is_said = key.given.keys() == {QPOS}
    for body in builder.world.iter():
        for joint in body.joints:
            spot = joint.spot
            start, width = whole.slots[spot]
            name, value = builder.joint_names.get(id(joint), ""), row[start]
            lower, upper = limits.get(name, (value, value))
            is_held = lower - ROUNDING <= value <= upper + ROUNDING and name not in builder.mimics
            if spot[: len(outer)] != outer:
                is_said &= width == 1 and value == 0
            elif width == 1 and is_held:
                children.append(making.note("joint", at, {"joint": name, "value": f"{value!r}"}))
            else:
                is_said = False
    if children:
        builder.rest.append(making.note("state", place, {"name": key.name}, children))
        if is_said:
            element.body = SAID
    return {
        str(each.attributes["joint"]): float(str(each.attributes["value"])) for each in children
    }


def _say_by_names(
    builder: Builder, key: Thing, element: Element, rows: Rows, stated: Mapping[str, float]
) -> None:
    """Let a keyframe of what is a part of a robot say its numbers by the names of what has them.

    Positions that its state has are left out, and what rests.
    """
    found: dict[tuple[str, str], dict[str, str]] = {}
    given = {
        name: values
        for name in rows.by_name
        if (values := numbers(key.given, name, 0, 1 << 20)) is not None
    }

    has_controls = CTRL in given
    given.setdefault(CTRL, rows.by_name[CTRL].rest)

    def say(attribute: str, spot: Spot, home: tuple[str, str], rest: float = 0.0) -> None:
        start, width = rows.by_name[attribute].slots[spot]
        values = given[attribute][start : start + width]
        is_said = attribute == QPOS or bool(rest) or any(values)
        if len(values) == width and is_said:
            words = (repr(value).removesuffix(".0") for value in values)
            found.setdefault(home, {})[attribute] = " ".join(words)

    for body in builder.world.iter():
        for joint in body.joints:
            kind = type_of(joint)
            name = builder.joint_names.get(id(joint)) or joint.name
            by_body = kind == "free" or not name
            home = ("body", body.name) if by_body else ("joint", name)
            if QPOS in given and name not in stated:
                say(QPOS, joint.spot, home)
            if QVEL in given:
                say(QVEL, joint.spot, home)
        for attribute in (MPOS, MQUAT):
            if attribute in given and body.thing.spot in rows.by_name[attribute].slots:
                say(attribute, body.thing.spot, ("body", body.name))
    for thing, drive in builder.drives.all:
        is_target = drive is not None and drive.is_noted and drive.command == POSITION
        home = ("actuator", thing.name)
        target = stated.get(drive.joint, 1.0) if drive and is_target else 0.0
        say(CTRL, thing.spot, home, 1.0 if has_controls else target)  # zeros where a state has none
        if ACT in given:
            say(ACT, thing.spot, home)
    for name in given.keys() & element.attributes.keys():
        del element.attributes[name]
    for (kind, name), said in found.items():
        element.children.append(Element(kind, element.span, {"name": name, **said}))
