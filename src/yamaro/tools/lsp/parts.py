"""Parts, links, joints and frames: where a file names them, and what builds made of them."""

from __future__ import annotations

import re

from ...source import Span
from ...yaml.nodes import ScalarNode, SequenceNode
from .contexts import pairs_of_mappings, span_inside, word_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.robot import Robot
    from ...yaml.nodes import YamlNode
    from .workspace import Text, Workspace

_ATTRIBUTES = re.compile(
    r"(?:[/,]\s*)(link|joint|reference|parent|child|joint1|joint2|link1|link2)\s*:?=\s*"
    r"['\"]?([^,'\"]*[^,'\"\s])"
)
_NAMES = re.compile(r"(?:[/,]\s*)name\s*:?=\s*['\"]?([^,'\"]*[^,'\"\s])")
_NAMED = ("link", "joint", "frame", "sensor")
_SCALARS = {
    "parent": "joint",
    "child": "joint",
    "to": "attach",
    "at": "attach",
    "of": "mirror",
    "frame": "sensor",
}
"""Keys whose value names a link, part or frame, by what they are in."""
_LISTS = frozenset(("between", "chain", "links", "joints", "keep", "end_effector"))


class Named:
    """Something with a name: a part, link, joint, frame or sensor.

    Attributes:
        kind: the word.
        name: as it is written; None if it is computed.
        span: where the name is written.
        key: the key of the whole.
        node: what is under it.
        link: the name of its link; None if it has none, or it is computed.
        joint: the name of its joint.
    """

    __slots__ = ("joint", "key", "kind", "link", "name", "node", "span")

    def __init__(self, kind: str, name: str, span: Span, key: ScalarNode, node: YamlNode) -> None:
        self.kind = kind
        self.name = None if "$" in name else name
        self.span = span
        self.key = key
        self.node = node
        self.link: str | None = None
        self.joint: str | None = None

    def answers_to(self, name: str) -> bool:
        """Return whether a name means it."""
        return name in (self.name, self.link, self.joint) and "$" not in name


class Reference:
    """A place where a file names a link, joint, part or frame."""

    __slots__ = ("is_computed", "name", "span")

    def __init__(self, name: str, span: Span) -> None:
        self.name = name
        self.span = span
        self.is_computed = "$" in name


class Parts:
    """What a file names, and where it refers to names.

    Attributes:
        named: in the order of the file.
        references: likewise.
    """

    def __init__(self, root: YamlNode | None) -> None:
        """Look through the nodes of a file."""
        self.named: list[Named] = []
        self.references: list[Reference] = []
        joint, link = "*_joint", "*_link"
        for key, value in pairs_of_mappings(root):
            if key.text == "naming":
                for own, pattern in pairs_of_mappings(value):
                    if isinstance(pattern, ScalarNode) and "*" in pattern.text:
                        joint = pattern.text if own.text == "joint" else joint
                        link = pattern.text if own.text == "link" else link
        self._patterns = joint, link
        self._seen: set[int] = set()
        self._walk(root, [])

    def at(self, offset: int) -> Named | Reference | None:
        """Return the name that an offset is in."""
        both: list[Named | Reference] = [*self.named, *self.references]
        for each in both:
            if each.span.start <= offset <= each.span.end:
                return each
        return None

    def _walk(self, node: YamlNode | None, path: list[str]) -> None:
        if node is None or isinstance(node, ScalarNode) or id(node) in self._seen:
            return
        self._seen.add(id(node))
        if isinstance(node, SequenceNode):
            for item in node.items:
                self._walk(item, path)
            return
        for key, value in node.pairs:
            word = word_of(key.text)
            self._take(key, word, value, path)
            self._walk(value, [*path, word])

    def _take(self, key: ScalarNode, word: str, value: YamlNode, path: Sequence[str]) -> None:
        if word == "part":
            for own, name in pairs_of_mappings(value):
                if own.text == "name" and isinstance(name, ScalarNode) and name.text:
                    named = Named("part", name.text, span_inside(name), key, value)
                    words = name.text.split() if named.name is not None else []
                    if len(words) == 2:
                        named.joint, named.link = words
                    elif len(words) == 1:
                        joint, link = self._patterns
                        named.joint = joint.replace("*", words[0]) if "$" not in joint else None
                        named.link = link.replace("*", words[0]) if "$" not in link else None
                    self.named.append(named)
        elif word in _NAMED and (given := _NAMES.search(key.text)) is not None:
            named = Named(word, given[1], key.span(given.start(1), given.end(1)), key, value)
            if word == "joint":
                named.joint = named.name
            else:
                named.link = named.name
            self.named.append(named)
        if "=" in key.text:
            for found in _ATTRIBUTES.finditer(key.text):
                self._refer(key, found.start(2), found.end(2))
        above = path[-1] if path else ""
        is_reference = (
            word == "mimic"
            or (word == "joint" and above == "mimic")
            or (word == "parent" and path[:1] == ["groups"])
            or (word == "joints" and path[:1] in (["control"], ["controllers"]))
            or _SCALARS.get(word) == above
        )
        if isinstance(value, ScalarNode) and is_reference:
            self._refer(value, 0, len(value.text))
        elif isinstance(value, SequenceNode) and word in _LISTS:
            for item in value.items:
                if isinstance(item, ScalarNode):
                    self._refer(item, 0, len(item.text))
        if path[:1] == ["states"] and len(path) == 2 and isinstance(value, ScalarNode):
            self._refer(key, 0, len(key.text))

    def _refer(self, node: ScalarNode, start: int, end: int) -> None:
        text = node.text[start:end]
        span = node.span(start, end) if (start, end) != (0, len(node.text)) else span_inside(node)
        if text and not any(each.span.start == span.start for each in self.references[-2:]):
            self.references.append(Reference(text, span))


# --- in the last builds -----------------------------------------------------------------------


MOST_LINKS = 3
"""Links that one part made which are shown."""


def links_of(workspace: Workspace, text: Text, part: Named) -> list[tuple[Robot, Link]]:
    """Return the links that a part made in the last builds: several, if it is in a loop."""
    found = []
    for result in workspace.results_of(text.path):
        robot = result.robot
        if robot is None:
            continue
        places = [
            result.offset_then(text, offset)
            for offset in (part.span.start - 1, part.span.start, part.key.start)
        ]
        for link in robot.links.values():
            name_span = getattr(link.element.span, "name_span", None)
            own = name_span if name_span is not None else link.element.span
            if own.source.path == text.path and own.start in places:
                found.append((robot, link))
    return found


def part_lines(workspace: Workspace, text: Text, part: Named | Reference) -> list[str]:
    """Return lines of Markdown about a part, as far as it is known."""
    if isinstance(part, Named):
        links = links_of(workspace, text, part)
        title = f"**{part.kind} {part.span.written()}**"
    else:
        links = _named(workspace, text, part.name)
        title = f"**{part.name}**"
        if not links:
            return []
    if not links:
        return [title] if isinstance(part, Named) else []
    lines = [title]
    for robot, link in links[:MOST_LINKS]:
        lines.append(about_link(robot, link))
    if len(links) > MOST_LINKS:
        lines.append(f"… and {len(links) - MOST_LINKS} more")
    return lines


def _named(workspace: Workspace, text: Text, name: str) -> list[tuple[Robot, Link]]:
    """Return the link that a name means: its own, that of a part, or the child of a joint."""
    for result in workspace.results_of(text.path):
        robot = result.robot
        if robot is None:
            continue
        joint = robot.joints.get(name) or robot.joints.get(f"{name}_joint")
        candidates = [name, f"{name}_link", joint.child if joint is not None else ""]
        for each in candidates:
            if each in robot.links:
                return [(robot, robot.links[each])]
    return []


def about_link(robot: Robot, link: Link) -> str:
    """Return what is known of a link, as a list in Markdown."""
    rows = [f"link `{link.name}`"]
    inertial = link.inertial
    if inertial is not None:
        rows.append(f"mass {_number(inertial.mass)} kg")
        numbers = " ".join(_number(value) for value in inertial.inertia)
        rows.append(f"inertia {numbers} kg·m² (ixx ixy ixz iyy iyz izz)")
    joint = robot.parent_joint(link.name)
    if joint is not None:
        rows.append(f"joint `{joint.name}`, {joint.type}, from `{joint.parent}`")
    try:
        pose = robot.pose(link.name)
    except ValueError:
        return "\n".join(f"- {row}" for row in rows)
    xyz = " ".join(map(_number, pose.position))
    rpy = " ".join(map(_number, pose.rpy))
    rows.append(f"at zero: xyz {xyz} m, rpy {rpy} rad from the root")
    return "\n".join(f"- {row}" for row in rows)


def about_joint(joint: Joint) -> str:
    """Return what is known of a joint, as a list in Markdown."""
    rows = [f"joint `{joint.name}`, {joint.type}", f"from `{joint.parent}` to `{joint.child}`"]
    is_linear = joint.type == "prismatic"
    limit, mimic = joint.limit, joint.mimic
    if joint.type not in ("fixed", "floating"):
        rows.append(f"axis {' '.join(map(_number, joint.axis))}")
    if limit is not None and joint.type in ("revolute", "prismatic"):
        unit = "m" if is_linear else "rad"
        rows.append(f"from {_number(limit.lower)} to {_number(limit.upper)} {unit}")
    if limit is not None and limit.effort is not None and joint.type != "fixed":
        rows.append(f"effort {_number(limit.effort)} {'N' if is_linear else 'N·m'}")
    if limit is not None and limit.velocity is not None and joint.type != "fixed":
        rows.append(f"velocity {_number(limit.velocity)} {'m/s' if is_linear else 'rad/s'}")
    if mimic is not None:
        factor, offset = _number(mimic.multiplier), _number(mimic.offset)
        rows.append(f"follows `{mimic.joint}`: {factor} · position + {offset}")
    return "\n".join(f"- {row}" for row in rows)


def _number(value: float) -> str:
    return f"{value:.4g}" if abs(value) > 1e-12 else "0"
