"""What blocks for one format say that another one has as well: ball joints and springs.

Both are read from MJCF and SDF into blocks, since URDF has neither. Such a block is made one for
the other format, which its writer takes as if it had been read from there.
"""

from __future__ import annotations

from ..model.extras import RawXml
from ..model.joint import FIXED
from ..model.values import attribute_text, child_named, content, numbers_in, numbers_of
from ..xml.tree import Element, Text
from ..xml.values import Numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..model.robot import Robot
    from ..source import Span

BALL = "ball"
SPRINGS = {"stiffness": "spring_stiffness", "springref": "spring_reference"}
"""The values of a spring in MJCF, and the elements of SDF that say them of an axis."""


class Translation:
    """The blocks of a robot for a format, with those for another one that say what it has too.

    Attributes:
        blocks: the blocks.
        taken: the identities of elements in blocks for another format that nothing is lost of.
    """

    __slots__ = ("_robot", "blocks", "taken")

    def __init__(self, robot: Robot, format: str) -> None:
        self._robot = robot
        self.blocks = robot.raw(format)
        self.taken: set[int] = set()
        if format not in ("mjcf", "sdf"):
            return
        for raw in robot.raw():
            if format == "sdf" and raw.format == "mjcf":
                self.blocks += self._ball_for_sdf(raw) if raw.link else self._spring_for_sdf(raw)
            elif format == "mjcf" and raw.format == "sdf" and raw.joint:
                self.blocks += self._joint_for_mjcf(raw, raw.joint)

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

    def _joint_for_mjcf(self, raw: RawXml, name: str) -> list[RawXml]:
        """Return the ball joint, or the spring, that a block for SDF gives a joint."""
        joint = self._robot.joints[name]
        kind = next((each for each in raw.elements if each.name == "type"), None)
        if kind is not None:
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


def _leaf(name: str, value: object, span: Span) -> Element:
    return Element(name, span, children=[Text(value, span)])


def _block(format: str, span: Span, elements: Iterable[Element], **home: str) -> RawXml:
    return RawXml(Element("raw", span, {"format": format, **home}, [*elements]))
