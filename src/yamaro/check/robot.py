"""Structural check of a finished robot: what parsers of URDF would refuse, drop or misread.

Everything here is linear in the size of the robot and recurses no deeper than the schema.
"""

from __future__ import annotations

from ..model.reading import read_robot
from ..model.schema import OTHER_FORMATS, VERSIONS, is_semantic
from ..xml.tree import Element
from .context import FILES, MATERIALS, TREE, CheckContext
from .schema import check_elements
from .tree import check_spelling, check_tree

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..diagnostics import Reporter
    from ..model.robot import Robot
    from ..model.values import NumberReader
    from ..source import Span
    from .files import PackageFault


def check(
    root: Element,
    *,
    reporter: Reporter,
    resolve_mesh: Callable[[str, Span], str | None] | None = None,
    package_fault: PackageFault | None = None,
    path_meant: Callable[[str, Span], str | None] | None = None,
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
    _check_materials(robot, context)
    if context.has_extensions or any(joint.mimic is not None for joint in robot.all_joints):
        from .references import check_references

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
    context.flush()
    if advice is not None:
        if is_semantic(root):
            from .semantics import check_semantics

            told = CheckContext(root, advice)
            check_semantics(root, told)
            told.flush()
            return bool(context.file_owners)
        from .advice import check_advice

        check_advice(robot, tree, context, advice=advice, resolve_mesh=resolve_mesh)
    return bool(context.file_owners)


def _check_materials(robot: Robot, context: CheckContext) -> None:
    context.stage = MATERIALS
    if robot.own_materials or context.material_uses:
        from .material import check_materials

        check_materials(robot, context)


def check_format(root: Element, reporter: Reporter) -> None:
    """Report another format in a file that is called .urdf or .srdf, whose parsers refuse it."""
    path = root.span.source.path.lower()
    for format in ("URDF", "SRDF"):
        if path.endswith(f".{format.lower()}"):
            known = OTHER_FORMATS.get(root.name)
            what = f"this is not {format}" if known is None else f"this is {known}, not {format}"
            a = "a" if format == "URDF" else "an"
            reporter.warn(
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
        context.warn(
            "no-link",
            "the robot has no link, so parsers reject it",
            root,
            hint="add one, as in `link/name=base_link:`",
        )
    version = robot.version
    if version is None:
        return VERSIONS[0]
    if version not in VERSIONS:
        context.error(
            "bad-version",
            f"'{version}' is not a version of URDF",
            root,
            attribute="version",
            hint=f"the versions are {', '.join(VERSIONS)}",
        )
        return VERSIONS[-1]
    return version
