"""The phases of the pipeline, each as a function that calls the room which does the work.

A room is imported when a file needs it: a document without parts loads nothing of `robot/`.
"""

from __future__ import annotations

from .diagnostics import Reporter
from .runtime.yaml_main import run_yaml_main
from .xml.tree import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from .files.mesh_files import MeshFinder
    from .model.robot import Robot
    from .model.values import NumberReader
    from .request import Request
    from .runtime.interpreter import Interpreter
    from .source import Span


def evaluate(request: Request, interpreter: Interpreter) -> Element:
    """Run the main file, which is parsed then, and each file it includes, when it is reached."""
    variables, places, reporter = request.variables, request.places, request.reporter
    if request.source.is_xml:
        from .runtime.xml_main import run_xml_main

        texts = {name: str(text) for name, text in variables.items()}  # they are texts already
        root, is_xacro = run_xml_main(request.source, interpreter, texts, places, reporter)
        if not is_xacro:
            _warn_of_unread(interpreter, places, reporter)
        return root
    root = run_yaml_main(
        interpreter, request.source, stem=request.stem, variables=variables, places=places
    )
    _warn_of_unread(interpreter, places, reporter)
    return root


def _warn_of_unread(
    interpreter: Interpreter, places: Mapping[str, Span], reporter: Reporter
) -> None:
    """Warn of variables that were passed to files which have no use for them."""
    if not places and not interpreter.passed:
        return
    from .runtime.unread import warn_of_unread, warn_of_unread_includes

    warn_of_unread(places, interpreter.files, reporter)
    if interpreter.passed:
        warn_of_unread_includes(interpreter.passed.values(), interpreter.files, reporter)


def lower(
    root: Element, interpreter: Interpreter, finder: MeshFinder, reporter: Reporter
) -> tuple[Element, Sequence[Element]]:
    """Return the tree without parts, in which the names of materials do not clash, and its notes.

    A note is what a robot has that is not an element of URDF, such as a sensor.
    """
    notes: Sequence[Element] = ()
    if interpreter.has_parts:
        from .robot.part import lower as lower_parts

        root, notes = lower_parts(
            root,
            reporter=reporter,
            resolve_mesh=finder.resolve,
            may_read=finder.allows,
        )
    if interpreter.has_blocks:
        from .robot.raw_blocks import take_raw_blocks

        root, blocks = take_raw_blocks(root)
        notes = [*notes, *blocks]
    return (_put_together(root) if interpreter.is_yaml else root), notes


def _put_together(root: Element) -> Element:
    """Return a robot of several files, in which the names of materials do not clash."""
    if root.name != "robot" or not any(
        isinstance(child, Element) and (child.name == "material" or child.body is not None)
        for child in root.children
    ):
        return root
    from .robot.material_names import settle_materials

    return settle_materials(root)


def add_gazebo(
    root: Element, notes: Sequence[Element], reporter: Reporter, *, reports_losses: bool = True
) -> Element:
    """Return a robot with the elements that Gazebo reads of its sensors and surfaces.

    Args:
        root: the robot.
        notes: what it holds besides URDF.
        reporter: takes warnings.
        reports_losses: whether what these elements cannot hold is reported.
    """
    from .model.reading import read_robot
    from .targets.gazebo import with_gazebo
    from .targets.losses import diagnostics_of
    from .targets.shared_losses import cones

    # What the robot says to Gazebo in elements of its own is written already.
    robot = read_robot(root, notes=notes, recognizes=False)
    for diagnostic in diagnostics_of(cones(robot), "urdf") if reports_losses else ():
        reporter.add(diagnostic)
    return with_gazebo(root, robot, reporter)


def check(
    root: Element,
    finder: MeshFinder,
    reporter: Reporter,
    wants: Callable[[str], bool] | None,
    *,
    robot: Robot | None = None,
    numbers: NumberReader | None = None,
    notes: Sequence[Element] = (),
) -> bool:
    """Check a robot, and report advice with the codes wanted; return whether it refers to files.

    `robot` is what was read of the root with `numbers`, if it was; `notes` are what it has besides.
    """
    if root.name != "robot":
        if root.span.source.is_xml:
            from .check.robot import check_format

            check_format(root, reporter)
        return False
    from .check.robot import check as check_robot

    advisor = None if wants is None else Reporter()
    has_files = check_robot(
        root,
        reporter=reporter,
        resolve_mesh=finder.resolve,
        package_fault=finder.package_fault,
        path_meant=finder.path_meant,
        advice=advisor,
        robot=robot,
        numbers=numbers,
        notes=notes,
    )
    if clashes := finder.package_clashes():
        from .check.packages import warn_of_clashes

        warn_of_clashes(clashes, root, reporter)
    for diagnostic in advisor.diagnostics if advisor else ():
        if wants is not None and wants(diagnostic.code):
            reporter.add(diagnostic)
    return has_files
