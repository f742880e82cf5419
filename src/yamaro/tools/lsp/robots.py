"""What the last build says of a part: mass, inertia, and where it is."""

from __future__ import annotations

from .parts import Named, Reference

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.link import Link
    from ...model.robot import Robot
    from .bindings import Program
    from .texts import Text
    from .workspace import Workspace

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


def part_lines(
    workspace: Workspace, program: Program, text: Text, part: Named | Reference
) -> list[str]:
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
        lines.append(_about(robot, link))
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


def _about(robot: Robot, link: Link) -> str:
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


def _number(value: float) -> str:
    return f"{value:.4g}" if abs(value) > 1e-12 else "0"
