"""Actuators: which of them drive a joint as the model says it, and what is left of each.

An actuator of MuJoCo gives the joint the torque g·F, where F = gain·u + bias, and the bias is
affine in g·q and g·q̇, with the gear g. In joint space these are the gains g²·kp and g²·kv of a
servo whose command is u/g. Source: MuJoCo's manual, "Actuation model".
"""

from __future__ import annotations

from ...model import making
from ...model.making import Place
from ...xml.tree import Element
from .blocks import kept, row
from .classes import unknown
from .compiler import SMALLEST, chosen, number, numbers
from .document import attributes_of, text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from .building import Builder
    from .classes import Given
    from .tree import Context, Thing

    Default = tuple[str, Given]
    """An element for actuators in a default class: its name and its attributes."""

POSITION, VELOCITY, EFFORT = "position", "velocity", "effort"
WORDS = {POSITION: "position", VELOCITY: "velocity", EFFORT: "motor"}
LAWFUL = ("general", "motor", "position", "velocity", "intvelocity", "damper")
"""The words for actuators whose law is a gain and an affine bias."""
OWN = frozenset(
    """gaintype biastype dyntype gainprm biasprm dynprm kp kv dampratio timeconst ki imax slewmax
    area diameter bias force scale lmin lmax vmax fpmax fvmax tausmooth gain motorconst resistance
    nominal saturation inductance cogging controller thermal lugre input posrange velrange ffrange
    range""".split()
)
"""The attributes that only some of the words have, or that mean something else in each."""
COUNTS = {"gainprm": 10, "biasprm": 10, "dynprm": 10}
LIMITS = ("true", "false", "auto")


def defaults(elements: Iterable[Default], word: str) -> Given:
    """Return what a class says of actuators of a word, beside how they act.

    MuJoCo has one default actuator in a class, whatever the words are that say it.
    """
    known = attributes_of("actuator", word) or ()
    return {
        name: value
        for kind, given in elements
        for name, value in given.items()
        if name in known and (name not in OWN or (kind == word and word not in LAWFUL))
    }


class Law:
    """How the force of an actuator follows from its control, position and speed.

    Attributes:
        types: its `gaintype`, `biastype` and `dyntype`.
        rows: its `gainprm`, `biasprm` and `dynprm`.
    """

    __slots__ = ("rows", "types")

    def __init__(self) -> None:
        self.types = {"gaintype": "fixed", "biastype": "none", "dyntype": "none"}
        self.rows = {
            "gainprm": [1.0] + [0.0] * 9, "biasprm": [0.0] * 10, "dynprm": [1.0] + [0.0] * 9
        }  # fmt: skip

    def apply(self, word: str, given: Given) -> None:
        """Change it as an element of a word does, in a class or as the actuator itself.

        Source: MuJoCo, xml_native_reader.cc: OneActuator; user_api.cc.
        """
        gain, bias, dynamic = self.rows["gainprm"], self.rows["biasprm"], self.rows["dynprm"]
        types = self.types
        if word == "general":
            for name in types:
                if name in given:
                    types[name] = given[name][0].strip()
            for name, count in COUNTS.items():
                found = numbers(given, name, 1, count)
                if found is not None:
                    self.rows[name][: len(found)] = found
        elif word == "motor":
            gain[0] = 1.0
            types.update(gaintype="fixed", biastype="none", dyntype="none")
        elif word in ("position", "intvelocity"):
            gain[0] = number(given, "kp", gain[0])
            bias[1] = -gain[0]
            if "kv" in given:
                bias[2] = -number(given, "kv", 0.0)
            if "dampratio" in given:
                bias[2] = number(given, "dampratio", 0.0)
            if "timeconst" in given:
                dynamic[0] = number(given, "timeconst", 0.0)
                types["dyntype"] = "filterexact" if dynamic[0] else "none"
            types.update(gaintype="fixed", biastype="affine")
            if word == "intvelocity":
                types["dyntype"] = "integrator"
        elif word == "velocity":
            gain[0] = number(given, "kv", gain[0])
            bias[:] = [0.0, 0.0, -gain[0], *[0.0] * 7]
            types.update(gaintype="fixed", biastype="affine", dyntype="none")
        elif word == "damper":
            before = -gain[2] if types["gaintype"] == "affine" else 0.0
            gain[:] = [0.0, 0.0, -number(given, "kv", before), *[0.0] * 7]
            types.update(gaintype="affine", biastype="none", dyntype="none")

    def command(self) -> str:
        """Return what the control commands, `position`, `velocity` or `effort`, or ""."""
        gain, bias = self.rows["gainprm"], self.rows["biasprm"]
        if self.types["gaintype"] != "fixed" or any(gain[1:]) or any(bias[3:]):
            return ""
        if self.types["biastype"] == "none":
            return EFFORT if self.types["dyntype"] == "none" else ""
        if self.types["biastype"] != "affine" or bias[0]:
            return ""
        if self.types["dyntype"] not in ("none", "filterexact"):
            return ""
        if bias[1] == -gain[0] and gain[0]:
            return POSITION
        is_plain = bias[1] == 0 and bias[2] == -gain[0] and self.types["dyntype"] == "none"
        return VELOCITY if is_plain else ""

    def attributes(self, word: str) -> dict[str, object]:
        """Return the attributes by which an element of a word has this law, without defaults."""
        gain, bias, dynamic = self.rows["gainprm"], self.rows["biasprm"], self.rows["dynprm"]
        found: dict[str, object] = {}
        if word in ("position", "intvelocity"):
            found["kp"] = row([gain[0]])
            if bias[2]:
                found["kv" if bias[2] < 0 else "dampratio"] = row([abs(bias[2])])
            if self.types["dyntype"] == "filterexact":
                found["timeconst"] = row([dynamic[0]])
        elif word == "velocity":
            found["kv"] = row([gain[0]])
        elif word == "damper":
            found["kv"] = row([-gain[2]])
        elif word == "general":
            usual = Law()
            found.update({k: v for k, v in self.types.items() if v != usual.types[k]})
            for name, values in self.rows.items():
                if values != usual.rows[name]:
                    last = max(i for i, v in enumerate(values) if v or i == 0)
                    found[name] = row(values[: last + 1])
        return found


class Drive:
    """An actuator of a joint.

    Attributes:
        thing: its element, with what its classes say of its transmission and limits.
        joint: the name of the joint.
        law: how it acts; None for a word that says it otherwise.
        command: what it commands, if the model has such actuators; else "".
        gear: how its position follows from that of the joint.
    """

    __slots__ = ("command", "gear", "is_noted", "joint", "law", "thing")

    def __init__(self, thing: Thing, law: Law | None, joint: str) -> None:
        self.thing = thing
        self.law = law
        self.joint = joint
        gears = numbers(thing.given, "gear", 1, 6) or [1.0]
        self.gear = gears[0]
        self.command = law.command() if law is not None and abs(self.gear) > SMALLEST else ""
        self.is_noted = False

    def force(self) -> float | None:
        """Return the greatest torque or force at the joint, or None if nothing bounds it."""
        ends = _range(self.thing, "forcerange", "forcelimited")
        if ends is not None:
            return max(map(abs, ends)) * abs(self.gear)
        ends = _range(self.thing, "ctrlrange", "ctrllimited")
        if self.command == EFFORT and ends is not None and self.law is not None:
            return max(map(abs, ends)) * abs(self.gear * self.law.rows["gainprm"][0])
        return None


class Drives:
    """The actuators of a model.

    Attributes:
        all: in the order of the document: each with the joint that it drives, or None.
    """

    __slots__ = ("_by_joint", "_joints", "all")

    def __init__(self, contexts: Iterable[Context], joints: Mapping[str, str]) -> None:
        """Read the actuators.

        Args:
            contexts: the documents.
            joints: the type of each joint of the model, by its name.
        """
        self.all: list[tuple[Thing, Drive | None]] = []
        self._by_joint: dict[str, list[Drive]] = {}
        self._joints = joints
        for context in contexts:
            for thing in context.things("actuator"):
                drive = self._drive(context, thing, joints)
                self.all.append((thing, drive))
                if drive is not None:
                    self._by_joint.setdefault(drive.joint, []).append(drive)
        for drives in self._by_joint.values():
            first = next((each for each in drives if each.command), None)
            if first is not None:
                first.is_noted = True

    @staticmethod
    def _drive(context: Context, thing: Thing, joints: Mapping[str, str]) -> Drive | None:
        named = thing.given.get("joint")
        law = None
        if thing.kind in LAWFUL:
            law = Law()
            name, span = text(thing.element, "class"), thing.span
            for word, given in context.classes.actuators(name, span):
                law.apply(word, given)
            law.apply(thing.kind, thing.given)
            for attribute in OWN & thing.given.keys():
                del thing.given[attribute]
            for attribute, value in law.attributes(thing.kind).items():
                thing.given[attribute] = (str(value), thing.where(attribute))
        if named is None:
            return None
        if named[0] not in joints:
            raise unknown("joint", named[0], joints, named[1])
        return Drive(thing, law, named[0]) if joints[named[0]] in ("hinge", "slide") else None

    def name_all(self) -> None:
        """Name the actuators without a name: like the joint, or the word, with a number."""
        taken = {thing.name for thing, _ in self.all}
        for thing, drive in self.all:
            if not thing.name:
                stem = drive.joint if drive is not None else thing.kind
                names = (f"{stem}_{number}" for number in range(2, len(taken) + 2))
                thing.name = next(each for each in (stem, *names) if each not in taken)
                taken.add(thing.name)

    def of(self, joint: str) -> list[Drive]:
        """Return the actuators of a joint."""
        return self._by_joint.get(joint, [])

    def noted(self, joint: str) -> Drive | None:
        """Return the actuator of a joint that the model has, or None."""
        return next((each for each in self.of(joint) if each.is_noted), None)

    def effort(self, joint: str) -> float | None:
        """Return the greatest effort that the actuators of a joint have together, or None."""
        forces = [each.force() for each in self.of(joint)]
        known = [each for each in forces if each is not None]
        return sum(known) if known and len(known) == len(forces) else None

    def elements(
        self, joint: str, room: tuple[float, float] | None, effort: float | None
    ) -> list[Element]:
        """Return what the block of a joint says of its actuators.

        Args:
            joint: the name of the joint.
            room: its limits, or None.
            effort: the greatest effort that its limit says, or None.
        """
        found: list[Element] = []
        drives = self.of(joint)
        for drive in drives:
            element = kept(drive.thing, without=("joint",))
            if drive.is_noted and not found:  # the first is that which the note makes
                _leave_out(element, drive, room, effort)
                if len(drives) == 1 and not element.attributes and not element.children:
                    continue
            found.append(element)
        return found

    def notes(self, builder: Builder) -> None:
        """Add the actuators that the model has, in the order of the document."""
        for thing, drive in self.all:
            if drive is None or not drive.is_noted or drive.law is None:
                continue
            values: dict[str, str | float | None] = {
                "joint": drive.joint,
                "command": drive.command,
            }
            places = {"command": thing.span, "joint": thing.where("joint")}
            square = drive.gear * drive.gear
            gain, bias = drive.law.rows["gainprm"], drive.law.rows["biasprm"]
            if drive.command == POSITION:
                values["kp"] = square * gain[0]
                if bias[2] <= 0:
                    values["kd"] = square * -bias[2]
            elif drive.command == VELOCITY:
                values["kd"] = square * gain[0]
            for name in ("kp", "kd"):
                written = "kv" if name == "kd" else "kp"
                places[name] = thing.where(written)
            delay = number(thing.given, "delay", 0.0)
            if delay > 0:
                values["delay"], places["delay"] = delay, thing.where("delay")
            builder.rest.append(making.note("actuator", Place(thing.span, places), values))

    def order(self) -> list[Element]:
        """Return what the block of the robot says: those of no joint, in the order of all."""
        drives = [drive for _, drive in self.all if drive is not None]
        places = {name: index for index, name in enumerate(self._joints)}
        notes = [drive.joint for drive in drives if drive.is_noted]
        ranks = {name: rank for rank, name in enumerate(notes)}
        # The writer of MJCF puts those with notes first, then those in the blocks of joints.
        ordered = sorted(drives, key=lambda d: (ranks.get(d.joint, len(notes)), places[d.joint]))
        rest = self.all
        is_first = all(drive is not None for _, drive in self.all[: len(drives)])
        if is_first and ordered == drives:
            rest = self.all[len(drives) :]
        found = []
        for thing, drive in rest:
            if drive is None:
                found.append(kept(thing))
                continue
            attributes: dict[str, object] = {"joint": drive.joint}
            if thing.name:
                attributes = {"name": thing.name, **attributes}
            found.append(Element(thing.kind, thing.span, attributes))
        return found


def _range(thing: Thing, name: str, flag: str) -> list[float] | None:
    """Return the limits that hold for an actuator, or None for none."""
    ends = numbers(thing.given, name, 2)
    limited = chosen(thing.given, flag, LIMITS, "auto")
    is_limited = limited == "true" or (
        limited == "auto" and thing.context.compiler.autolimits and ends is not None and any(ends)
    )
    return ends if is_limited else None


def _leave_out(
    element: Element, drive: Drive, room: tuple[float, float] | None, effort: float | None
) -> None:
    """Leave out what the writer of MJCF writes for the note of an actuator; say what it must not.

    It calls it like the joint, bounds its force by the effort of the joint, and its control by
    what it commands: the limits of the joint, or the effort.
    """
    assert drive.law is not None
    attributes, thing = element.attributes, drive.thing
    word = WORDS[drive.command]
    if element.name != word:
        return
    if thing.name == drive.joint:
        attributes.pop("name", None)
    bound = (-effort, effort) if effort is not None and effort < 1e15 else None
    control: tuple[float, float] | None = None
    if drive.command == EFFORT:
        control = bound
    elif drive.command == POSITION:
        control = room
    forces = bound if drive.command != EFFORT else None
    for name, flag, usual in (
        ("ctrlrange", "ctrllimited", control),
        ("forcerange", "forcelimited", forces),
    ):
        ends = _range(thing, name, flag)
        if name == "ctrlrange" and "inheritrange" in attributes and control is not None:
            middle, half = (control[0] + control[1]) / 2, (control[1] - control[0]) / 2
            half *= number(thing.given, "inheritrange", 0.0)
            ends = [middle - half, middle + half]
            attributes[name] = row(ends)
            del attributes["inheritrange"]
        attributes.pop(flag, None)
        if ends is None:
            if name in attributes or usual is not None:
                attributes[flag] = "false"
        elif usual is not None and row(ends).text == row(usual).text:
            attributes.pop(name, None)
    if drive.gear == 1.0:
        attributes.pop("gear", None)
        if drive.command == POSITION:
            attributes.pop("kp", None)
        if drive.law.rows["biasprm"][2] <= 0:
            attributes.pop("kv", None)
    attributes.pop("delay", None)
