"""Structural check of a finished robot: what parsers of URDF would refuse, drop or misread.

Everything here is linear in the size of the robot and recurses no deeper than the schema.
"""

from __future__ import annotations

from ..diagnostics import WARNING
from ..model.joint import FIXED
from ..model.reading import read_robot
from ..model.schema import OTHER_FORMATS, VERSIONS, is_semantic
from ..model.values import attribute_text
from ..xml.tree import Element, IncludedRobot
from .context import FILES, MATERIALS, TREE, CheckContext, listed
from .schema import check_elements

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import TypeVar

    from ..diagnostics import Reporter
    from ..fixes import Fix
    from ..model.joint import Joint
    from ..model.link import Link
    from ..model.robot import Robot
    from ..model.values import NumberReader
    from ..source import Span
    from .files import PackageFault

    Named = TypeVar("Named", Link, Joint)


def check(
    root: Element,
    *,
    reporter: Reporter,
    resolve_mesh: Callable[[str, Span], str | None] | None = None,
    package_fault: PackageFault | None = None,
    path_meant: Callable[[str, Span], str | None] | None = None,
    may_read: Callable[[str], bool] | None = None,
    looks_at_fits: bool = False,
    advice: Reporter | None = None,
    robot: Robot | None = None,
    numbers: NumberReader | None = None,
    notes: Sequence[Element] = (),
) -> bool:
    """Check the robot and report each fault as a warning at the value that is wrong.

    Args:
        root: the finished `<robot>` element, without parts.
        reporter: takes the faults.
        resolve_mesh: gives the file of a mesh or texture as referred to at a span, or None if it
            is not there. Without it no files are looked at.
        package_fault: gives, for a package that cannot be found, how to get it and the places
            looked at; None for a package that is known.
        path_meant: gives the path that the name of a file means, to report one that is not
            there.
        may_read: whether a file that a mesh names may be read; None allows all.
        looks_at_fits: whether to compare shapes that were worked out with their meshes, which
            takes a second or more.
        advice: takes what is legal but seldom meant, such as a density of 50,000 kg/m³. Without it
            this is not worked out.
        robot: what `read_robot` gives of the root, if that is there already.
        numbers: what it reads numbers with.
        notes: what the robot has that is not an element of URDF, such as states.

    Returns:
        Whether it has meshes or textures.
    """
    context = CheckContext(root, reporter, numbers=numbers)
    robot = robot or read_robot(root, numbers=context.numbers, notes=notes)
    context.version = _check_robot(robot, context)
    check_elements(root, context)
    context.stage = TREE
    tree = check_tree(robot, context)
    context.stage = MATERIALS
    if robot.own_materials or context.material_uses:
        from .material import check_materials

        check_materials(robot, context)
    if context.has_extensions or any(joint.mimic is not None for joint in robot.all_joints):
        from .outermost import check_references

        check_references(robot, tree, context)
    if resolve_mesh is not None and context.file_owners:
        from .files import check_files

        context.stage = FILES
        check_files(
            context,
            resolve_mesh=resolve_mesh,
            package_fault=package_fault,
            path_meant=path_meant,
        )
    if looks_at_fits and robot.fits and resolve_mesh is not None:
        try:
            from .fits import check_fits
        except ImportError:  # shapes are kept, so that numpy may be missing
            pass
        else:
            context.stage = FILES
            check_fits(robot, context, resolve_mesh=resolve_mesh, may_read=may_read)
    context.flush()
    if advice is not None:
        if is_semantic(root):
            from .semantics import check_semantics

            told = CheckContext(root, advice, is_advice=True)
            check_semantics(root, told)
            told.flush()
            return bool(context.file_owners)
        from .advice import check_advice

        check_advice(robot, tree, context, advice=advice, resolve_mesh=resolve_mesh)
    return bool(context.file_owners)


def check_format(root: Element, reporter: Reporter) -> None:
    """Report another format in a file that is called .urdf or .srdf, whose parsers refuse it."""
    path = root.span.source.path.lower()
    for format in ("URDF", "SRDF"):
        if path.endswith(f".{format.lower()}"):
            known = OTHER_FORMATS.get(root.name)
            what = f"this is not {format}" if known is None else f"this is {known}, not {format}"
            a = "a" if format == "URDF" else "an"
            reporter.report(
                "not-urdf",
                f"{what}: its root is '{root.name}'",
                root.span,
                hint=f"the root of {a} {format} is 'robot'; use the extension of the file's format",
            )


def _check_robot(robot: Robot, context: CheckContext) -> str:
    """Check the robot's own attributes, and that it has a link; return its URDF version."""
    root = robot.element
    name = robot.written("name")
    if name is not None:
        check_spelling(root, name, context)
    if not robot.all_links and not is_semantic(root):
        context.report(
            "no-link",
            "the robot has no link, so parsers reject it",
            root,
            hint="add one, as in `link/name=base_link:`",
        )
    version = robot.version
    if version is None:
        return VERSIONS[0]
    if version not in VERSIONS:
        context.report(
            "bad-version",
            f"'{version}' is not a version of URDF",
            root,
            attribute="version",
            hint=f"the versions are {', '.join(VERSIONS)}",
        )
        return VERSIONS[-1]
    return version


# --- links and joints -------------------------------------------------------------------------


LONG_CHAIN = 1000
"""Links on one path above which parsers that recurse run out of stack (pinocchio does at 5,000)."""
MAX_PATH_SHOWN = 8
NOWHERE = "\0"
"""Names a parent that does not exist; no link can have this name."""


class Tree:
    """The links and joints of a robot by name, the first of each name, in the order written.

    Those without a name are not among them.
    """

    __slots__ = ("_parts", "joints", "links")

    def __init__(self, links: Mapping[str, Link], joints: Mapping[str, Joint]) -> None:
        self.links = links
        self.joints = joints
        self._parts: dict[str, dict[str, str]] = {}

    def named(self, ending: str) -> Mapping[str, Link] | Mapping[str, Joint]:
        """Return what has names that end so in a part: "_link" or "_joint"."""
        return self.links if ending == "_link" else self.joints

    def parts(self, ending: str) -> dict[str, str]:
        """Return the names with the ending of a part's link or joint, by what stands before it.

        Worked out once; all names have to be known by then.
        """
        parts = self._parts.get(ending)
        if parts is None:
            known = self.named(ending)
            parts = {full.removesuffix(ending): full for full in known if full.endswith(ending)}
            self._parts[ending] = parts
        return parts


def check_tree(robot: Robot, context: CheckContext) -> Tree:
    """Check names, references and the shape of the tree; return what goes by which name."""
    tree = Tree(
        _check_names(robot.all_links, robot.links, context),
        _check_names(robot.all_joints, robot.joints, context),
    )
    hanging, is_complete = _check_references(robot, tree, context)
    circles = _circles(hanging.parents)
    if circles:
        order = {name: index for index, name in enumerate(hanging.parents)}
        for circle in circles:
            last = circle.index(max(circle, key=order.__getitem__))
            _report_circle(circle[last:] + circle[:last], hanging, context)
    elif is_complete:
        _check_roots(tree, hanging, context)
    if not circles:
        _check_depth(hanging, tree, context)
    _check_mimics(robot, tree, context)
    return tree


# --- names ------------------------------------------------------------------------------------


def _check_names(
    things: Sequence[Named], by_name: Mapping[str, Named], context: CheckContext
) -> Mapping[str, Named]:
    """Check the names of links or joints; return the first of each name, of those that have one."""
    if len(by_name) == len(things) and all(map(str.isidentifier, by_name)):
        return by_name  # as with nearly all robots, the names have no fault
    known: dict[str, Named] = {}
    for thing in things:
        _check_name(thing, known, context)
    return known


def _check_name(thing: Named, known: dict[str, Named], context: CheckContext) -> None:
    element, name = thing.element, thing.written("name")
    if name is None:
        return
    if not name.isidentifier():  # which has nothing odd in it
        check_spelling(element, name, context)
    first = known.get(name)
    if first is None:
        known[name] = thing
        return
    if not name:
        return
    context.report(
        f"duplicate-{element.name}",
        f"there are two {element.name}s named '{name}'",
        element,
        attribute="name",
        hint=_hint_for_names(element),
        notes=(_note_of_first(first.element, element),),
        among=(first.element, element),
    )


def _hint_for_names(element: Element) -> str:
    """Return what distinguishes the second of two elements of one name."""
    if isinstance(element.body, IncludedRobot):
        if element.body.prefix:
            return "give each robot a `prefix:` of its own"
        return "give the attached or included robot a prefix, such as prefix: left_"
    return "give each its own name; in a function, build it from an argument: `$(side)_arm`"


def _note_of_first(first: Element, second: Element) -> str:
    """Return where the first of two elements was made, and what led there if that differs."""
    place, trace = first.value_span("name"), first.trace_within(None)
    if trace is not second.trace and trace is not None:
        way = f"in {trace.name}, {trace.kind} at {trace.span.place()}"
        return f"first defined at {place.place()}, {way}"
    if place.key() == second.value_span("name").key():
        return "defined here in an earlier iteration of a loop"
    return f"first defined at {place.place()}"


def check_spelling(element: Element, name: str, context: CheckContext) -> None:
    """Check that a name is one that ROS and the parsers of URDF can all use."""
    if name.isprintable() and name.strip() and (" " not in name or element.name == "robot"):
        return
    if not name.strip():
        message = f"the name of {'the' if element.name == 'robot' else 'a'} {element.name} is empty"
    elif any(char.isspace() for char in name):
        message = f"the {element.name} name '{name}' contains white space"
    else:
        message = f"the {element.name} name '{name}' contains invisible characters"
    context.report(
        "bad-name",
        message,
        element,
        attribute="name",
        hint="use letters, digits and underscores, as in left_arm_link",
        severity=WARNING,
    )


# --- the tree ---------------------------------------------------------------------------------


class Hanging:
    """How links hang, by name: the joint above each, and the name of the parent link."""

    __slots__ = ("joints", "parents")

    def __init__(self) -> None:
        """Start without links and joints."""
        self.joints: dict[str, Joint] = {}
        self.parents: dict[str, str] = {}


def _check_references(robot: Robot, tree: Tree, context: CheckContext) -> tuple[Hanging, bool]:
    """Return how each link hangs, and whether every joint says so and its links exist."""
    hanging, links = Hanging(), tree.links
    above, parents = hanging.joints, hanging.parents
    is_complete = True
    for joint in robot.all_joints:
        parent: str | None = joint.parent
        if not parent or parent not in links:
            parent = _reference(joint, "parent", tree, context)
        child: str | None = joint.child
        if not child or child not in links:
            child = _reference(joint, "child", tree, context)
        if child is None:
            is_complete = False
        elif child in above:
            context.outermost = joint.element
            _report_two_parents(child, above[child], joint, context)
        else:
            above[child] = joint
            parents[child] = NOWHERE if parent is None else parent
    context.outermost = None
    return hanging, is_complete


def _reference(joint: Joint, role: str, tree: Tree, context: CheckContext) -> str | None:
    """Return the link that a parent or child names, if it exists, or None after a report."""
    element = joint.inner(role)
    name = attribute_text(element, "link")
    if element is None or name is None or name in tree.links:
        return name
    context.outermost = joint.element
    hint, fix = near_name(element.value_span("link"), name, tree, "_link", context)
    known = f": {listed(list(tree.links))}" if tree.links else ""
    context.report(
        f"unknown-{role}",
        f"the {role} '{name}' of joint '{joint.written('name')}' is not a link of the robot",
        element,
        attribute="link",
        hint=hint or f"add a link named '{name}', or refer to an existing link{known}",
        fix=fix,
    )
    return None


def near_name(
    span: Span, name: str, tree: Tree, ending: str, context: CheckContext
) -> tuple[str | None, Fix | None]:
    """Return hint and fix for a name, also where the name of a part is the near one."""
    from ..fixes import respelling

    parts = tree.parts(ending)
    near = parts.get(name) or context.near_word(name, tree.named(ending))
    if near is None:
        part = context.near_word(name, parts)
        near = None if part is None else parts[part]
    hint = f"did you mean '{near}'?" if near is not None else None
    return hint, respelling(span, name, near)


def _report_two_parents(child: str, first: Joint, second: Joint, context: CheckContext) -> None:
    names = [first.name, second.name]
    if names[0] == names[1]:
        return  # Joints of one name are reported; most often all of a part is there twice.
    context.report(
        "two-parents",
        f"link '{child}' is the child of two joints, {listed(names)}",
        second.inner("child") or second.element,
        attribute="link",
        hint="a link has one parent joint: URDF is a tree and cannot contain closed loops",
        notes=(f"the first joint is at {first.span.place()}",),
        among=(first.element, second.element),
    )


def _circles(above: dict[str, str]) -> list[list[str]]:
    """Return each circle once in what has at most one thing above it."""
    done: set[str] = set()
    circles = []
    for start, upper in above.items():
        if upper in done or (upper not in above and upper != start):
            done.add(start)  # as it is with most, since parents are mostly written first
            continue
        path: dict[str, None] = {}
        name = start
        while name in above and name not in done and name not in path:
            path[name] = None
            name = above[name]
        if name in path:
            names = list(path)
            circles.append(names[names.index(name) :])
        done.update(path)
    return circles


def _report_circle(circle: list[str], hanging: Hanging, context: CheckContext) -> None:
    """Report a circle, given from child to parent, at the joint that was written last."""
    joint = hanging.joints[circle[0]]
    context.outermost = joint.element
    way = [circle[0], *reversed(circle)]
    if len(way) > MAX_PATH_SHOWN:
        way = [*way[: MAX_PATH_SHOWN - 2], "…", way[-1]]
    name = joint.written("name")
    hint = "attach one of these links to a link outside the cycle, or make it the root"
    if len(circle) == 1:
        hint = "set the link to which it is attached as its parent"
        message = f"joint '{name}' has the link '{circle[0]}' both as parent and as child"
    else:
        message = f"the joints form a cycle: {' → '.join(way)}"
    context.report(
        "joint-cycle",
        message,
        joint.inner("parent") or joint.element,
        attribute="link",
        hint=hint,
        among=[hanging.joints[name].element for name in circle],
    )
    context.outermost = None


def _check_roots(tree: Tree, hanging: Hanging, context: CheckContext) -> None:
    roots = [name for name in tree.links if name not in hanging.parents]
    if len(roots) < 2:
        return
    context.report(
        "several-roots",
        f"the robot has {len(roots)} separate trees: {listed(roots)} are not the child of a joint",
        tree.links[roots[1]].element,
        attribute="name",
        hint=f"make '{roots[1]}' the child of a joint, for example a fixed one",
        notes=(f"the first root link is at {tree.links[roots[0]].span.place()}",),
        among=[tree.links[name].element for name in roots],
    )


def _check_depth(hanging: Hanging, tree: Tree, context: CheckContext) -> None:
    """Warn once if a path from the root is too long for parsers that recurse."""
    parents = hanging.parents
    if len(parents) < LONG_CHAIN:
        return
    depth: dict[str, int] = {}
    for start, parent in parents.items():
        if parent in depth or parent not in parents:
            depth[start] = depth.get(parent, 0) + 1
            continue
        path = []
        name = start
        while name in parents and name not in depth:
            path.append(name)
            name = parents[name]
        level = depth.get(name, 0)
        for name in reversed(path):
            level += 1
            depth[name] = level
    longest = max(depth.values())
    if longest <= LONG_CHAIN:
        return
    deepest = next(name for name, level in depth.items() if level == longest)
    context.report(
        "long-chain",
        f"link '{deepest}' has {longest} joints above it",
        tree.links[deepest].element,
        attribute="name",
        hint=f"keep chains under {LONG_CHAIN}: some parsers crash on longer ones (pinocchio)",
    )


def is_fixed(joint: Joint) -> bool:
    """Return whether a joint is written as fixed; one without a type is reported elsewhere."""
    return joint.written("type") == FIXED


# --- mimic ------------------------------------------------------------------------------------


def _check_mimics(robot: Robot, tree: Tree, context: CheckContext) -> None:
    masters: dict[str, str] = {}
    for joint in robot.all_joints:
        mimic = joint.mimic
        master = None if mimic is None else mimic.written("joint")
        if mimic is None or master is None:
            continue
        name = joint.name
        context.outermost = joint.element
        if master not in tree.joints:
            span = mimic.element.value_span("joint")
            hint, fix = near_name(span, master, tree, "_joint", context)
            context.report(
                "unknown-mimic",
                f"joint '{name}' mimics '{master}', which is not a joint of the robot",
                mimic.element,
                attribute="joint",
                hint=hint or "refer to an existing joint",
                fix=fix,
            )
        elif tree.joints.get(name) is joint:
            masters[name] = master
    for circle in _circles(masters):
        joint = tree.joints[circle[0]]
        context.outermost = joint.element
        hint = "remove the mimic from one of them"
        if len(circle) == 1:
            hint = "refer to another joint, or remove the mimic"
            message = f"joint '{circle[0]}' mimics itself"
        else:
            way = [*circle[:MAX_PATH_SHOWN], circle[0]]
            message = f"joints mimic one another in a cycle: {' → '.join(way)}"
        context.report(
            "mimic-cycle",
            message,
            joint.inner("mimic") or joint.element,
            attribute="joint",
            hint=hint,
        )
    context.outermost = None
