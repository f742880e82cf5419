"""What blocks for one format say that another one has as well.

Ball joints and springs are read from MJCF and SDF into blocks, since URDF has neither, and so is
from MJCF an equality of two joints that are both driven, which in the model none of them can be.
Such a block is made one for the other format, which its writer takes as if it had been read from
there. USD has no blocks: what it has too are values here.

A universal joint of SDF turns about its first axis, then about its second one: two hinges of MJCF.
A screw is a hinge and a slide that an equality holds together. In URDF they are chains of joints.
"""

from __future__ import annotations

from math import isfinite, pi
from typing import NamedTuple

from ..model.extras import RawXml
from ..model.joint import FIXED, PRISMATIC, SINGLE, UNLIMITED
from ..model.pose import rotate, rotation_from_rpy
from ..model.values import attribute_text, child_named, content, numbers_in, numbers_of
from ..xml.tree import Element, Text
from ..xml.values import Numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from ..model.pose import Vector
    from ..model.robot import Robot
    from ..source import Span

BALL, UNIVERSAL, SCREW = "ball", "universal", "screw"
PITCHES = {"screw_thread_pitch": 1.0, "thread_pitch": -2 * pi}
"""What says the pitch of a screw: in m for each turn; in turns of 1 rad for each m, backwards."""
DYNAMICS = {
    "damping": "damping",
    "friction": "frictionloss",
    "spring_stiffness": "stiffness",
    "spring_reference": "springref",
}
"""What the dynamics of an axis are in MJCF."""
TIGHT = {"solref": "0.004 1", "solimp": "0.99 0.999 0.001"}
"""How fast and how exactly equalities hold: as stiff as the time step of MuJoCo allows."""
SPRINGS = {"stiffness": "spring_stiffness", "springref": "spring_reference"}
"""The values of a spring in MJCF, and the elements of SDF that say them of an axis."""
SOFTNESS = ("solref", "solimp")
"""The values of an equality of MJCF that say how stiff it is."""
COUPLED = {"name", "joint1", "joint2", "polycoef", *SOFTNESS}
"""The values of an equality of two joints of MJCF that a coupling keeps."""


class Coupling(NamedTuple):
    """An equality of two joints: that of a position in rad or m, and a linear one of another."""

    joint: str
    leader: str
    multiplier: float
    offset: float
    element: Element


class Move(NamedTuple):
    """A degree of freedom of a universal joint or a screw.

    Attributes:
        suffix: what the name of a joint for it ends in.
        slides: whether it is along the axis.
        axis: a vector in the frame of the child.
        element: the axis of SDF.
    """

    suffix: str
    slides: bool
    axis: Vector
    element: Element


class Translation:
    """The blocks of a robot for a format, with those for another one that say what it has too.

    Attributes:
        blocks: the blocks.
        chains: for URDF, what is in place of a joint that it has not, by the name of the joint.
        couplings: for SDF and USD, the equalities of joints that the model has not.
        taken: the identities of elements in blocks for another format that nothing is lost of.
        screws: the blocks of screws, which the format has approximately.
    """

    __slots__ = ("_robot", "blocks", "chains", "couplings", "screws", "taken")

    def __init__(self, robot: Robot, format: str) -> None:
        self._robot = robot
        self.blocks = robot.raw(format)
        self.taken: set[int] = set()
        self.couplings: list[Coupling] = []
        self.screws: list[RawXml] = []
        self.chains: dict[str, list[Element]] = {}
        if format == "urdf":
            for raw in robot.raw("sdf"):
                self._add_chain(raw)
        if format not in ("mjcf", "sdf", "usd"):
            return
        for raw in robot.raw():
            if format == "sdf" and raw.format == "mjcf":
                self.blocks += self._ball_for_sdf(raw) if raw.link else self._spring_for_sdf(raw)
                self.couplings += self._couplings(raw)
            elif format == "usd" and raw.format == "mjcf":
                self.couplings += self._couplings(raw)
            elif format == "mjcf" and raw.format == "sdf" and raw.joint:
                self.blocks += self._joint_for_mjcf(raw, raw.joint)
        if format == "sdf":
            self._add_mimics()

    def _ball_for_sdf(self, raw: RawXml) -> list[RawXml]:
        """Return the ball joint that MJCF has in a body, as one of the fixed joint above this."""
        joints = [each for each in raw.elements if each.name == "joint"]
        above = self._robot.parent_joint(raw.link or "")
        if len(joints) != 1 or above is None or above.type != FIXED:
            return []
        ball = joints[0]
        if attribute_text(ball, "type") != BALL or self._is_in_chain(above.parent):
            return []
        if ball.attributes.keys() <= {"name", "type", "pos"}:
            self.taken.add(id(ball))
        found = [_leaf("type", BALL, ball.span)]
        where = numbers_of(ball, "pos")
        if any(where):
            pose = _leaf("pose", Numbers.of(*where, 0.0, 0.0, 0.0), ball.span)
            pose.attributes = {"relative_to": raw.link}
            found.append(pose)
        return [_block("sdf", ball.span, found, joint=above.name)]

    def _is_in_chain(self, link: str) -> bool:
        """Return whether a link is between two joints of one body of MJCF, which says so."""
        above = self._robot.parent_joint(link)
        return above is not None and any(
            each.name == "pos"
            for raw in self._robot.raw("mjcf")
            if raw.joint == above.name
            for each in raw.elements
        )

    def _spring_for_sdf(self, raw: RawXml) -> list[RawXml]:
        given = {each.name: each for each in raw.elements if each.name in SPRINGS}
        if raw.joint is None or any(len(numbers_in(content(each))) != 1 for each in given.values()):
            return []
        self.taken |= {id(each) for each in given.values()}
        if "stiffness" not in given:
            return []
        span = given["stiffness"].span
        values = [_leaf(SPRINGS[name], content(each), each.span) for name, each in given.items()]
        axis = Element("axis", span, children=[Element("dynamics", span, children=[*values])])
        return [_block("sdf", span, [axis], joint=raw.joint)]

    def _couplings(self, raw: RawXml) -> Iterator[Coupling]:
        """Yield the linear equalities of two joints that no `mimic` says."""
        robot = self._robot
        leaders = {each.name: each.mimic.joint for each in robot.joints.values() if each.mimic}
        for each in raw.elements if raw.link is None and raw.joint is None else ():
            for equality in each.elements() if each.name == "equality" else ():
                names = [attribute_text(equality, end) or "" for end in ("joint1", "joint2")]
                given = numbers_of(equality, "polycoef")
                row = (*given, *(0.0, 1.0, 0.0, 0.0, 0.0)[len(given) :])
                joints = [robot.joints.get(name) for name in names]
                kinds = {joint.type == PRISMATIC for joint in joints if joint is not None}
                if (
                    equality.name != "joint"
                    or not all(joint is not None and joint.type in SINGLE for joint in joints)
                    or len(kinds) > 1  # in USD a joint that turns cannot follow one that slides
                    or attribute_text(equality, "active") == "false"
                    or any(row[2:])
                    or names[0] in leaders
                    or leaders.get(names[1]) == names[0]
                    or any(self._has_reference(name) for name in names)
                ):
                    continue
                leaders[names[0]] = names[1]
                if equality.attributes.keys() <= COUPLED:
                    self.taken.add(id(equality))
                yield Coupling(names[0], names[1], row[1], row[0], equality)

    def _has_reference(self, name: str) -> bool:
        """Return whether the positions of a joint count from another one in MJCF."""
        return any(
            each.name == "ref" and any(numbers_in(content(each)))
            for raw in self._robot.raw("mjcf")
            if raw.joint == name
            for each in raw.elements
        )

    def _add_mimics(self) -> None:
        """Write the couplings as mimics of SDF, in the axis of a joint with its spring."""
        springs = {
            each.joint: each.elements[0]
            for each in self.blocks
            if each not in self._robot.raw("sdf") and each.elements[0].name == "axis"
        }
        for name, leader, multiplier, offset, element in self.couplings:
            span = element.span
            values = {"multiplier": multiplier, "offset": offset, "reference": 0.0}
            children = [_leaf(word, Numbers.of(value), span) for word, value in values.items()]
            mimic = Element("mimic", span, {"joint": leader}, [*children])
            if name in springs:
                springs[name].children.append(mimic)
            else:
                axis = Element("axis", span, children=[mimic])
                self.blocks.append(_block("sdf", span, [axis], joint=name))

    def _joint_for_mjcf(self, raw: RawXml, name: str) -> list[RawXml]:
        """Return the ball joint, or the spring, that a block for SDF gives a joint."""
        joint = self._robot.joints[name]
        kind = next((each for each in raw.elements if each.name == "type"), None)
        if kind is not None:
            if content(kind) in (UNIVERSAL, SCREW):
                return self._hinges(raw, name, kind)
            if content(kind) != BALL:
                return []
            pose = next((each for each in raw.elements if each.name == "pose"), None)
            self.taken |= {id(each) for each in (kind, pose) if each is not None}
            attributes: dict[str, object] = {"name": name, "type": BALL}
            where = numbers_in(content(pose))[:3]
            if any(where):
                attributes["pos"] = Numbers.of(*where)
            ball = Element("joint", kind.span, attributes)
            return [_block("mjcf", kind.span, [ball], link=joint.child)]
        axis = next((each for each in raw.elements if each.name == "axis"), None)
        dynamics = child_named(axis, "dynamics") if axis is not None else None
        if axis is None or dynamics is None:
            return []
        given = {each.name: each for each in dynamics.elements()}
        if len(axis.elements()) == 1 and given.keys() <= set(SPRINGS.values()):
            self.taken.add(id(axis))
        if not any(numbers_in(content(given.get("spring_stiffness")))):
            return []
        values = [
            _leaf(ours, content(given[theirs]), given[theirs].span)
            for ours, theirs in SPRINGS.items()
            if theirs in given
        ]
        return [_block("mjcf", axis.span, values, joint=name)]

    def _hinges(self, raw: RawXml, name: str, kind: Element) -> list[RawXml]:
        """Return the joints of a body that are a universal joint or a screw together."""
        said = {each.name: each for each in raw.elements}
        moves, where = _moves(said)
        joints = []
        for move in moves:
            attributes: dict[str, object] = {"name": f"{name}_{move.suffix}"}
            if move.slides:
                attributes["type"] = "slide"
            attributes["axis"] = Numbers.of(*move.axis)
            if any(where):
                attributes["pos"] = Numbers.of(*where)
            if not move.slides:
                values, is_whole = _of_axis(move.element)
                attributes |= values
                self.taken |= {id(move.element)} if is_whole else set()
            joints.append(Element("joint", move.element.span, attributes))
        if not joints:
            return []
        self.taken |= {id(kind), id(said.get("pose"))}
        blocks = [_block("mjcf", kind.span, joints, link=self._robot.joints[name].child)]
        if content(kind) == SCREW:
            blocks.append(_thread(kind, said, name))
            self._take_screw(raw, said)
        return blocks

    def _take_screw(self, raw: RawXml, said: dict[str, Element]) -> None:
        self.taken |= {id(said[each]) for each in PITCHES if each in said}
        self.screws.append(raw)

    def _add_chain(self, raw: RawXml) -> None:
        """Add the chain that is a universal joint or a screw in URDF."""
        said = {each.name: each for each in raw.elements}
        kind, joint = said.get("type"), self._robot.joints.get(raw.joint or "")
        if kind is None or joint is None or joint.type != FIXED:
            return
        moves, where = _moves(said)
        if not moves:
            return
        from .urdf.chains import chain, is_whole

        is_screw = content(kind) == SCREW
        factor = _pitch(said) / (2 * pi) if is_screw else None
        self.chains[joint.name] = chain(self._robot, joint.name, moves, where, factor)
        self.taken |= {id(kind), id(said.get("pose"))}
        self.taken |= {id(each.element) for each in moves if is_whole(each.element)}
        if is_screw:
            self._take_screw(raw, said)


def _moves(said: dict[str, Element]) -> tuple[list[Move], tuple[float, ...]]:
    """Return how a joint of SDF that the model has as a fixed one moves, and where in its child.

    Nothing is returned for joints other than universal ones and screws, and for one without axes.
    """
    kind = content(said.get("type"))
    pose = [*numbers_in(content(said.get("pose")))] or [0.0] * 6
    turn = rotation_from_rpy(pose[3], pose[4], pose[5])
    moves: list[Move] = []
    for own in {UNIVERSAL: ("axis", "axis2"), SCREW: ("axis", "axis")}.get(kind or "") or ():
        axis = said.get(own)
        xyz = numbers_in(content(child_named(axis, "xyz"))) if axis is not None else ()
        if axis is None or len(xyz) != 3:
            return [], ()
        x, y, z = xyz
        slides = kind == SCREW and bool(moves)
        suffix = "slide" if slides else own
        moves.append(Move(suffix, slides, rotate(turn, (x, y, z)), axis))
    return moves, tuple(pose[:3])


def _pitch(said: dict[str, Element]) -> float:
    """Return how far a screw moves in a turn, in metres."""
    for word, each in PITCHES.items():
        found = numbers_in(content(said.get(word)))
        if found and found[0]:
            return found[0] if each > 0 else each / found[0]
    return 1.0  # SDF's default


def _thread(kind: Element, said: dict[str, Element], name: str) -> RawXml:
    """Return what holds the slide of a screw at its angle times the pitch."""
    row = Numbers.of(0.0, _pitch(said) / (2 * pi), 0.0, 0.0, 0.0)
    ends: dict[str, object] = {"joint1": f"{name}_slide", "joint2": f"{name}_axis"}
    held = Element("joint", kind.span, {**ends, "polycoef": row, **TIGHT})
    return _block("mjcf", kind.span, [Element("equality", kind.span, children=[held])])


def _of_axis(axis: Element) -> tuple[dict[str, object], bool]:
    """Return what MJCF says of an axis of SDF, and whether that is all."""
    found: dict[str, object] = {}
    limit, dynamics = child_named(axis, "limit"), child_named(axis, "dynamics")
    known = {"xyz", "limit", "dynamics"}
    is_whole = known >= {each.name for each in axis.elements()}
    given = {each.name: numbers_in(content(each)) for each in limit.elements()} if limit else {}
    bounds = {name: row[0] for name, row in given.items() if len(row) == 1}
    ends = bounds.get("lower", -UNLIMITED), bounds.get("upper", UNLIMITED)
    bounded = [isfinite(end) and abs(end) < UNLIMITED for end in ends]
    if all(bounded):
        found["range"] = Numbers.of(*ends)
    effort, velocity = bounds.get("effort", -1.0), bounds.get("velocity", -1.0)
    if 0 < effort < UNLIMITED:
        found["actuatorfrcrange"] = Numbers.of(-effort, effort)
    is_whole &= any(bounded) == all(bounded) and not 0 <= velocity < UNLIMITED
    is_whole &= given.keys() <= {"lower", "upper", "effort", "velocity"}
    for each in dynamics.elements() if dynamics else ():
        is_whole &= each.name in DYNAMICS
        if each.name in DYNAMICS and any(numbers_in(content(each))):
            found[DYNAMICS[each.name]] = content(each)
    return found, is_whole


def _leaf(name: str, value: object, span: Span) -> Element:
    return Element(name, span, children=[Text(value, span)])


def _block(format: str, span: Span, elements: Iterable[Element], **home: str) -> RawXml:
    return RawXml(Element("raw", span, {"format": format, **home}, [*elements]))
