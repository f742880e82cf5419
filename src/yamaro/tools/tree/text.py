"""Draws the kinematic tree of a finished robot as text, one line a link."""

from __future__ import annotations

from collections.abc import Iterator

from ...commands.summary import counted, mass_text
from ...model.joint import (
    CONTINUOUS,
    DEGREES_OF_FREEDOM,
    FLOATING,
    PRISMATIC,
    REVOLUTE,
    Joint,
    Limit,
)
from ...model.robot import Robot
from ...model.values import attribute_text, number_in, read_numbers
from ...terminal import BOLD, CYAN, DIM, RED, painted, printable, width

MAX_INDENTED_DEPTH = 24
MAX_ALIGNED_WIDTH = 64


class Row:
    """A joint in the tree.

    Attributes:
        name, kind: the joint's name and type as written.
        parent, child: the names of its links.
        facts: its axis, and its limits with the joint that it mimics.
    """

    __slots__ = ("child", "facts", "is_follower", "kind", "name", "parent")

    def __init__(self, joint: Joint, *, dots: str) -> None:
        """Take what is shown of a joint; `dots` is written between two limits."""
        self.name = _one_line(joint.name)
        self.kind = _one_line(joint.written("type") or "")
        self.parent = _one_line(joint.parent)
        self.child = _one_line(joint.child)
        limit = _limits(joint.limit, kind=self.kind, dots=dots)
        mimicked = _one_line(joint.mimic.joint) if joint.mimic is not None else ""
        self.is_follower = bool(mimicked)
        if mimicked:
            limit = f"{limit}  mimics {mimicked}".lstrip()
        moves = self.kind in DEGREES_OF_FREEDOM and self.kind != FLOATING
        self.facts = [_axis_name(joint) if moves else "", limit]


class Line:
    """One line of the tree: a link, and the joint that holds it."""

    __slots__ = ("branch", "joint", "link", "mass", "remark")

    def __init__(self, branch: str, link: str, *, joint: Row | None) -> None:
        """Start a line; `branch` is the lines drawn in front of the link."""
        self.branch = branch
        self.link = link
        self.joint = joint
        self.mass = ""
        self.remark = ""


def render_tree(robot: Robot, *, ascii: bool = False, color: bool = False) -> str:
    """Return the kinematic tree of a robot as text that ends in a line break.

    A line shows a link, its mass, and the joint that holds it: name, type, axis and limits. The
    last line counts links and joints, and sums degrees of freedom and mass. A fault, such
    as a loop or a second root, has a remark; nothing recurses, however long the chain.

    Args:
        robot: the robot.
        ascii: draw with `|` and `-` only, for terminals that have no box-drawing characters.
        color: use ANSI colours.
    """
    shape = _Structure(robot, dots=".." if ascii else "…")
    lines = list(_walk(shape, ascii=ascii))
    table = []
    for line in lines:
        facts = [""] * 4
        if line.joint is not None:
            facts = [line.joint.name, line.joint.kind, *line.joint.facts]
        remark = f"<- {line.remark}" if line.remark else ""
        table.append([line.branch + line.link, line.mass, *facts, remark])
    rows = _aligned(table)
    shown = [_painted(line, row) if color else row for line, row in zip(lines, rows, strict=True)]
    summary = shape.summary()
    problems = shape.problems()
    blank = [""] if shown else []
    return "\n".join([*shown, *blank, *problems, summary]) + "\n"


class _Structure:
    """The links and joints of a robot as they are written, whether or not they make a tree.

    Attributes:
        name: the robot's name.
        links: the mass of each link by name, None where it has none.
        joints: all joints.
        children: the links that are some joint's child.
        joints_from: the joints whose parent is each link.
    """

    __slots__ = ("children", "joints", "joints_from", "links", "name")

    def __init__(self, robot: Robot, *, dots: str) -> None:
        self.name = _one_line(robot.name)
        self.links: dict[str, float | None] = {}  # their masses in kg
        for name, link in robot.links.items():
            mass = link.inertial.inner("mass") if link.inertial is not None else None
            self.links[_one_line(name)] = number_in(mass, "value")
        self.joints = [Row(joint, dots=dots) for joint in robot.all_joints]
        self.children = {joint.child for joint in self.joints}
        self.joints_from: dict[str, list[Row]] = {}
        for joint in self.joints:
            if joint.parent and joint.child:
                self.joints_from.setdefault(joint.parent, []).append(joint)

    def starts(self) -> list[str]:
        """Return where to start: the roots, then each link, for what no root leads to."""
        names = list(dict.fromkeys([*self.joints_from, *self.links]))
        ordered = sorted(names, key=lambda name: name not in self.links)
        return [name for name in ordered if name not in self.children] + ordered

    def problems(self) -> list[str]:
        """Return a line for each joint that connects nothing."""
        return [
            f"joint '{joint.name}' connects nothing"
            for joint in self.joints
            if not (joint.parent and joint.child)
        ]

    def summary(self) -> str:
        """Return the counts and sums."""
        moving = [joint for joint in self.joints if joint.kind in DEGREES_OF_FREEDOM]
        free = sum(DEGREES_OF_FREEDOM[joint.kind] for joint in moving if not joint.is_follower)
        mimics = sum(joint.is_follower for joint in moving)
        joints = f"{counted(len(self.joints), 'joint')} ({len(moving)} movable"
        joints += f", {counted(mimics, 'mimic')})" if mimics else ")"
        masses = [mass for mass in self.links.values() if mass is not None]
        parts = [
            counted(len(self.links), "link"),
            joints,
            counted(free, "degree") + " of freedom",
            mass_text(sum(masses)) if masses else "no mass",
        ]
        return f"{self.name or 'robot'}: {', '.join(parts)}"


def _walk(structure: _Structure, *, ascii: bool) -> Iterator[Line]:
    """Yield the lines of the tree in the order of the joints, each link once."""
    seen: set[str] = set()
    roots = 0
    for start in structure.starts():
        if start in seen:
            continue
        roots += 1
        line = _line(structure, start, seen, branch="", joint=None)
        if roots > 1 and not line.remark:
            line.remark = "another root"
        yield line
        stack = _below(structure, start, depth=1, indent="")
        while stack:
            joint, depth, indent, is_last = stack.pop()
            is_new = joint.child not in seen
            branch, deeper = _branches(indent, depth=depth, is_last=is_last, ascii=ascii)
            yield _line(structure, joint.child, seen, branch=branch, joint=joint)
            if is_new:
                stack.extend(_below(structure, joint.child, depth=depth + 1, indent=deeper))


def _below(
    structure: _Structure, link: str, *, depth: int, indent: str
) -> list[tuple[Row, int, str, bool]]:
    """Return the steps to what is below a link, the first one last, as a stack wants them."""
    joints = structure.joints_from.get(link, [])
    last = len(joints) - 1
    steps = [(joint, depth, indent, number == last) for number, joint in enumerate(joints)]
    return steps[::-1]


def _branches(indent: str, *, depth: int, is_last: bool, ascii: bool) -> tuple[str, str]:
    """Return what is drawn before a link, and before those below it; very deep ones by number."""
    if depth > MAX_INDENTED_DEPTH:
        return f"{'..' if ascii else '⋯'} {depth:>4} ", indent
    if ascii:
        return indent + ("`- " if is_last else "|- "), indent + ("   " if is_last else "|  ")
    return indent + ("└─ " if is_last else "├─ "), indent + ("   " if is_last else "│  ")


def _line(
    structure: _Structure, link: str, seen: set[str], *, branch: str, joint: Row | None
) -> Line:
    """Return the line of a link, with a remark if something is wrong with it."""
    line = Line(branch, link, joint=joint)
    if link in seen:
        line.remark = "shown above: not a tree"
        return line
    seen.add(link)
    if link not in structure.links:
        line.remark = "no such link"
    elif joint is None and link in structure.children:
        line.remark = "part of a loop"
    mass = structure.links.get(link)
    line.mass = "" if mass is None else mass_text(mass)
    return line


# --- layout -----------------------------------------------------------------------------------


def _aligned(rows: list[list[str]]) -> list[str]:
    """Return each row as text, with columns of equal width; a very long cell sticks out."""
    if not rows:
        return []
    columns = zip(*rows, strict=True)
    widths = [min(max(map(width, column)), MAX_ALIGNED_WIDTH) for column in columns]
    aligned = []
    for row in rows:
        cells = []
        for number, (cell, room) in enumerate(zip(row, widths, strict=True)):
            if room:
                pad = " " * (room - width(cell))
                cells.append(pad + cell if number == 1 else cell + pad)  # masses to the right
        aligned.append("  ".join(cells).rstrip())
    return aligned


def _painted(line: Line, row: str) -> str:
    """Return the row with colours."""
    branch, rest = row[: len(line.branch)], row[len(line.branch) :]
    link, rest = rest[: len(line.link)], rest[len(line.link) :]
    if line.remark:
        head, arrow, remark = rest.rpartition("<- ")
        rest = head + painted(arrow + remark, RED)
    if line.joint is not None and line.joint.kind:
        head, kind, tail = rest.partition(f"  {line.joint.kind}")
        rest = head + painted(kind, CYAN) + tail
    return painted(branch, DIM) + painted(link, BOLD) + rest


# --- values -----------------------------------------------------------------------------------


def _one_line(text: str) -> str:
    return printable(text).replace("\t", " ")


def _limits(limit: Limit | None, *, kind: str, dots: str) -> str:
    """Return the range of a joint, in the unit of its type."""
    if limit is None or kind == CONTINUOUS:
        return ""
    given = [end for end in ("lower", "upper") if limit.written(end)]
    if not given or any(limit.number(end) is None for end in given):
        return ""
    unit = {REVOLUTE: " rad", PRISMATIC: " m"}.get(kind, "")
    return f"{limit.lower:.3g} {dots} {limit.upper:.3g}{unit}"


def _axis_name(joint: Joint) -> str:
    """Return a name such as `x` or `-z` for an axis along one direction, else the vector."""
    text = attribute_text(joint.inner("axis"), "xyz") or "1 0 0"
    numbers = read_numbers(text)
    if isinstance(numbers, tuple) and len(numbers) == 3:
        along = [(name, number) for name, number in zip("xyz", numbers, strict=True) if number]
        if len(along) == 1:
            name, number = along[0]
            return f"-{name}" if number < 0 else name
    return f"({' '.join(_one_line(text).split())})"
