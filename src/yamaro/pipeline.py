"""The pipeline: read → parse → evaluate → lower → check → emit, for every output format.

`request.py` has read the main file. It is parsed when evaluation begins, and each file it includes
when that is reached. A room is imported when a file needs it: a document without parts loads
nothing of `robot/`, and URDF without a word about what it cannot hold nothing of `targets/`.

The file is run once for all formats if the run does not depend on the format: if nothing reads
`target`, and no block for one format is reached. Otherwise it is run for each format, except for
those that belong to another one, as SRDF does to URDF.
"""

from __future__ import annotations

from .diagnostics import ERROR, Reporter, YamaroError, failure
from .files.mesh_files import NONE
from .result import Build
from .runtime.interpreter import Interpreter
from .runtime.predefined import TARGET as URDF
from .runtime.statements import HANDLERS
from .runtime.yaml_main import run_yaml_main, warn_of_unread, warn_of_unread_includes
from .xml.tree import Element
from .xml.writer import write_pieces

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .diagnostics import Diagnostic
    from .model.robot import Robot
    from .options import Options
    from .policy import Policy
    from .request import Request
    from .robot.lowering import Fitter
    from .runtime.files import Library
    from .runtime.interpreter import ReadSource
    from .source import Source, Span
    from .targets.losses import Loss
    from .targets.output import Output

    Say = Callable[[str], None]

TELLTALES = frozenset(("target", "eval", "exec", "globals", "locals", "vars"))
"""The names of which an expression reads one if what it gives may depend on the format."""


def run_pipeline(request: Request, library: Library, policy: Policy, say: Say) -> Build:
    """Return the build of the first format asked for, with those of all formats in its `outputs`.

    Args:
        request: the main file, and what was asked for with it.
        library: reads and parses files.
        policy: how far they are trusted.
        say: takes the lines that they print.

    Raises:
        YamaroError: the input has errors, or a format cannot be written; it holds the errors of
            all formats.
    """
    formats = request.options.target
    if formats is None:
        return Run(request, library, policy, say).build()
    from .targets.table import TARGETS

    said: set[str] = set()
    runs: dict[str, Run] = {}

    def run_for(format: str) -> Run:
        name = TARGETS[format].run
        run = runs.get(name) or next((r for r in runs.values() if not r.depends_on_format), None)
        if run is None:
            say_once = _unless_said_before(said, say)
            run = runs[name] = Run(request, library, policy, say_once, target=name, run_for=run_for)
        return run

    builds: dict[str, Build] = {}
    refused: dict[str, str] = {}
    errors = Reporter()
    has_failed = False
    for format in formats:
        run = run_for(format)
        try:
            builds[format] = run.build(format)
        except YamaroError as error:
            if request.options.partial and not run.is_faulty:
                refused[format] = next(
                    each.message for each in error.diagnostics if each.severity == ERROR
                )
                continue
            has_failed = True
            for diagnostic in error.diagnostics:
                errors.add(diagnostic)
    if has_failed:
        raise YamaroError(errors.diagnostics)
    first = next(iter(builds.values()))
    first.outputs, first.refused = builds, refused
    return first


def _unless_said_before(said: set[str], say: Say) -> Say:
    """Return what leaves out the lines of earlier runs; one that comes twice in a run is new."""
    earlier = frozenset(said)

    def say_new(line: str) -> None:
        said.add(line)
        if line not in earlier:
            say(line)

    return say_new


class Run:
    """A run of the main file: evaluated, lowered and checked, to be written in output formats.

    Attributes:
        root: the finished tree; if the run is faulty, the tree that was evaluated.
        notes: what the robot has that is not an element of it.
        diagnostics: what was found.
        is_faulty: whether there is nothing to write.
    """

    __slots__ = (
        "_has_files", "_interpreter", "_request", "_robot", "_run_for", "diagnostics", "is_faulty",
        "notes", "root",
    )  # fmt: skip

    def __init__(
        self,
        request: Request,
        library: Library,
        policy: Policy,
        say: Say,
        *,
        target: str = URDF,
        run_for: Callable[[str], Run] | None = None,
    ) -> None:
        """Run the main file for a format; for the arguments see `run_pipeline`.

        `run_for` gives the run for another format.

        Raises:
            YamaroError: evaluation ended with an error.
        """
        self._request = request
        self._run_for = run_for
        self._interpreter = interpreter = _interpreter(request, library, policy, say, target)
        self.root = evaluate(request, interpreter)
        self.notes: Sequence[Element] = ()
        self._robot: Robot | None = None
        self._has_files = False
        self.is_faulty = False
        reporter = Reporter()
        try:
            self.root, self.notes = lower(self.root, interpreter, request, reporter)
            self._robot, self._has_files = check(self.root, self.notes, request, reporter)
            self.diagnostics = reporter.diagnostics
        except YamaroError as error:
            self.is_faulty = True
            self.diagnostics = [*reporter.diagnostics, *error.diagnostics]

    @property
    def _has_loops(self) -> bool:
        return any(note.name == "robot-loop" for note in self.notes)

    @property
    def depends_on_format(self) -> bool:
        """Return whether the run may give something else for another format."""
        names = self._interpreter.files.names_read()
        if self._interpreter.has_raw_blocks or self._interpreter.depends_on_format:
            return True
        return not TELLTALES.isdisjoint(names)

    @property
    def _tells_losses(self) -> bool:
        """Return whether URDF that nobody asked for by name is written from another format.

        What is in files of such formats is then reported if it is lost. Who writes YAML or xacro
        writes URDF, and hears no more than what makes it wrong.
        """
        options = self._request.options
        is_written = (options.alone or options.output is not None) and not options.partial
        return is_written and bool(self._interpreter.foreign)

    def build(self, format: str | None = None) -> Build:
        """Return the build of one format, None for URDF or other XML that nobody asked for by name.

        Raises:
            YamaroError: the robot has errors, or the format cannot be written.
        """
        request, found = self._request, self.diagnostics
        if format is not None:
            from .targets.table import TARGETS, assumed_base, found_for

            found = found_for(format, found)
            if TARGETS[format].is_simulator and not request.options.partial and not self.is_faulty:
                found += assumed_base(self._read_robot(), request.options.base)
        if self.is_faulty:
            raise self._failure(found)
        if request.options.alone and format in (None, URDF) and self._has_loops:
            from .targets.urdf.loops import lost_loops

            found = [*found, *lost_loops(self._read_robot())]
        request.allow(found)
        if request.adjustment.deny(found):
            raise YamaroError(found)
        try:
            build, told = self._emit(format)
        except YamaroError as error:
            for each in error.diagnostics:
                if each.severity == ERROR and each.code in request.adjustment.allowed:
                    note = f"allowing '{each.code}' has no effect here: {{}} cannot hold this robot"
                    note = note.format("URDF" if format is None else TARGETS[format].title)
                    each.notes = (*each.notes, note)
            raise self._failure([*found, *error.diagnostics]) from None
        for diagnostic in (*found, *told):
            request.reporter.add(diagnostic)
        return build

    def _failure(self, errors: list[Diagnostic]) -> YamaroError:
        """Return what is raised, which notes where the values come from that are wrong."""
        from .runtime.python_errors import add_origins

        for diagnostic in errors:
            add_origins(diagnostic, self._interpreter.files, self._interpreter.places)
        return YamaroError(errors)

    def _read_robot(self) -> Robot:
        """Return the robot; raise YamaroError if the root is not a `<robot>`."""
        if self._robot is None:
            from .model.reading import read_robot

            self._robot = read_robot(self.root, notes=self.notes)
        return self._robot

    def _emit(self, format: str | None) -> tuple[Build, Sequence[Diagnostic]]:
        """Write the robot in a format; return the build, and what there is to say of it.

        Raises:
            YamaroError: it cannot be written.
        """
        request, interpreter = self._request, self._interpreter
        finder, is_urdf = request.finder, format in (None, URDF)
        file_name = request.file_name or ""
        if format is not None:
            from .targets.table import file_name_for

            name = "" if self._robot is None else self._robot.name
            if request.file_name is None:
                file_name = file_name_for(name, format, request.stem)
        output = self._written(format, file_name)
        finished = document = self.root
        text = None  # of formats that are not XML
        if output is not None:
            document = output.root or self.root
            finished = document if is_urdf else self.root
            text = output.text if output.text or output.root is None else None
        losses: Sequence[Loss] = () if output is None else output.losses
        if format is None and self._tells_losses:
            foreign = {id(source) for source in interpreter.foreign}
            losses = [each for each in losses if id(each.span.source) in foreign]
        if is_urdf and self._has_files:
            document = request.paths.applied_to(document)
        noted = interpreter.noted
        build = Build(
            lambda: finder.referred_to(finished),
            finder=finder,
            copies=request.copies,
            finished=finished,
            notes=self.notes,
            pieces=write_pieces(document, interpreter.limits) if text is None else [text],
            warnings=request.reporter.diagnostics,
            files=list(interpreter.files.read),
            noted=() if noted is None else noted.readings(),
            format=format or URDF,
            file_name=file_name,
            document=None if document is self.root or is_urdf else document,
            losses=losses if format is not None or self._tells_losses else (),
            assets=None if output is None else output.files,
        )
        if output is None:
            return build, ()
        from .targets.losses import diagnostics_of

        told = [] if request.options.partial else diagnostics_of(losses, build.format)
        return build, [*output.warnings, *told]

    def _output_in(self, format: str) -> Output:
        """Return the robot in another format, without meshes, from the run for that format."""
        assert self._run_for is not None, "each format that is asked for has the runs of all"
        run = self._run_for(format)
        if run.is_faulty:
            raise run._failure(run.diagnostics)
        output = run._written(format, "", has_meshes=False)
        assert output is not None, "a format was named"
        return output

    def _written(
        self, format: str | None, file_name: str, *, has_meshes: bool = True
    ) -> Output | None:
        """Return what the writer of a format gives, None for a tree that is written as it is."""
        request, options = self._request, self._request.options
        tells = format is not None or self._tells_losses
        if not tells and not (options.gazebo and self.notes) and not self._has_loops:
            return None
        if format == URDF and options.partial and self.root.name != "robot":
            return None
        from .model.joint import FIXED
        from .model.kinematics import base_of
        from .model.reading import read_robot
        from .targets.output import Wanted
        from .targets.table import TARGETS, write_target

        if format in (None, URDF):  # what is in elements of URDF stays as it is
            robot = read_robot(self.root, notes=self.notes, recognizes=False)
        else:
            robot = self._read_robot()
        version_option = TARGETS[format or URDF].version_option
        wanted = Wanted(
            format or URDF,
            name=request.stem,
            is_fixed=base_of(robot, options.base)[0] == FIXED,
            paths=request.paths,
            is_named=tells,
            has_meshes=has_meshes and options.meshes != NONE,
            has_gazebo=options.gazebo,
            repairs_inertia=options.repair_inertia,
            version=getattr(options, version_option) or "" if version_option else "",
            file_name=file_name,
            output_in=self._output_in,
            progress=options.on_progress,
        )
        return write_target(robot, wanted)


# --- the phases ---


def _interpreter(
    request: Request, library: Library, policy: Policy, say: Say, target: str
) -> Interpreter:
    handlers, records = HANDLERS, request.options.records
    if records:
        from .runtime.recording import RECORDING_HANDLERS, Noted

        handlers = RECORDING_HANDLERS
    interpreter = Interpreter(
        handlers,
        library=library,
        reporter=request.reporter,
        on_message=say,
        policy=policy,
        packages=request.packages,
        shares=not records,
        target=target,
        read_source=_source_reader(request),
    )
    if records:
        interpreter.noted = Noted(interpreter)
    return interpreter


def _source_reader(request: Request) -> ReadSource:
    """Return what reads robots in other formats than URDF, for which only it loads the readers."""

    def read(root: Element, read_text: Callable[[str, Span], Source]) -> Element | None:
        from .sources.host import Host
        from .sources.table import read_source

        host = Host(
            root.span.source,
            read=read_text,
            finder=request.finder,
            limits=request.options.policy.limits,
            reporter=request.reporter,
            model=request.options.model,
            is_part=request.is_part or root.span.source is not request.source,
        )
        return read_source(root, host)

    return read


def evaluate(request: Request, interpreter: Interpreter) -> Element:
    """Run the main file, which is parsed then, and each file it includes, when it is reached."""
    variables, places, reporter = request.variables, request.places, request.reporter
    is_xacro = False
    if _may_be_overlay(request.source):
        from .runtime.overlays import overlay_in

        overlay = overlay_in(request.source, interpreter.limits, reporter)
        if overlay is not None:
            _check_overlay(overlay, request)
            interpreter.files.note(request.source.path or request.source.name)
            return Element(overlay.name, overlay.span)
    if request.source.is_xml:
        from .runtime.xml_files import run_xml_main

        texts = {name: str(text) for name, text in variables.items()}  # they are texts already
        root, is_xacro = run_xml_main(request.source, interpreter, texts, places, reporter)
    else:
        root = run_yaml_main(
            interpreter, request.source, stem=request.stem, variables=variables, places=places
        )
    if not is_xacro and (places or interpreter.passed):  # xacro's own rules are another matter
        warn_of_unread(places, interpreter.files, reporter)
        if interpreter.passed:
            warn_of_unread_includes(interpreter.passed.values(), interpreter.files, reporter)
    documents = interpreter.files.documents
    if any(each.functions for each in documents):
        from .syntax.statements import warn_of_miscased_calls

        warn_of_miscased_calls(documents, reporter, is_known=_is_of_robots)
    return root


def _may_be_overlay(source: Source) -> bool:
    """Return whether a main file may be an overlay or a calibration, by its text."""
    text = source.text
    return not source.is_xml and (
        "homing_offset" in text
        or text.startswith(("overlay:", "kinematics:"))
        or "\noverlay:" in text
        or "\nkinematics:" in text
    )


def _check_overlay(overlay: Element, request: Request) -> None:
    """Check an overlay that is the main file, which only checking does; see `overlay-alone`.

    Raises:
        YamaroError: it has errors, or is to be built.
    """
    if not request.options.advice:
        name = request.source.name
        raise failure(
            "overlay-alone",
            "this file is an overlay, which changes a robot",
            overlay.span,
            hint=f"write yamaro ROBOT --overlay {name}; `yamaro check {name}` checks it alone",
        )
    from .robot.overlay import check_alone

    check_alone(overlay, request.reporter)


def _is_of_robots(word: str) -> bool:
    """Return whether a word is a key of parts, or an element of URDF or often in it."""
    from .model.schema import ELEMENTS
    from .robot.fields import PLACES

    return word in ELEMENTS or any(word in each.all_keys | each.elements for each in PLACES)


def lower(
    root: Element, interpreter: Interpreter, request: Request, reporter: Reporter
) -> tuple[Element, Sequence[Element]]:
    """Return the tree without parts, in which the names of materials do not clash, and its notes.

    A note is what a robot has that is not an element of URDF, such as a sensor. Overlays have
    changed the values.
    """
    notes: Sequence[Element] = ()
    overlays: Sequence[Element] = ()
    if request.options.overlay:
        from .runtime.overlays import given_overlays

        overlays = given_overlays(interpreter, request.options.overlay)
    if interpreter.has_parts or interpreter.has_notes or overlays:
        from .robot.part import lower as lower_parts

        finder = request.finder
        fitter = _fitter(interpreter, request)
        root, notes = lower_parts(
            root,
            reporter=reporter,
            resolve_mesh=finder.resolve,
            may_read=finder.allows,
            package_fault=finder.package_fault,
            fitter=fitter,
            overlays=overlays,
            wants_advice=request.options.wanted_advice(),
            has_parts=interpreter.has_parts or bool(overlays),
        )
        interpreter.depends_on_format = fitter.differs_in_urdf
    if interpreter.has_blocks:
        from .robot.notes import take_armatures, take_raw_blocks

        root, notes = take_armatures(root, notes)
        root, blocks = take_raw_blocks(root)
        notes = [*notes, *blocks]
    if interpreter.is_yaml and root.name == "robot":
        if any(
            isinstance(child, Element) and (child.name == "material" or child.body is not None)
            for child in root.children
        ):
            from .robot.material import settle_materials

            root = settle_materials(root)
    if request.options.refitting is not None:
        from .robot.part import lowering_of
        from .robot.refitting import refitted

        fitter = _fitter(interpreter, request)
        finder = request.finder
        lowering = lowering_of(
            root,
            reporter,
            finder.resolve,
            may_read=finder.allows,
            fitter=fitter,
            package_fault=finder.package_fault,
        )
        root, notes = refitted(
            lowering, root, notes, request.options.refitting, on_work=request.options.on_progress
        )
        interpreter.depends_on_format |= fitter.differs_in_urdf
    return root, notes


def _fitter(interpreter: Interpreter, request: Request) -> Fitter:
    """Return what shapes that are worked out from meshes need of the build."""
    from .robot.lowering import Fitter

    return Fitter(
        make_mesh=request.finder.make,
        is_cached=request.options.policy.is_trusted,
        is_for_urdf=interpreter.target == URDF,
        known=request.fits,
        on_work=request.options.on_progress,
    )


def check(
    root: Element, notes: Sequence[Element], request: Request, reporter: Reporter
) -> tuple[Robot | None, bool]:
    """Check a robot, with the advice asked for; return it, and whether it refers to files.

    Of other XML only the format is checked, and there is None in place of the robot.
    """
    if root.name != "robot":
        if root.span.source.is_xml:
            from .check.robot import check_format

            check_format(root, reporter)
        return None, False
    from .check.robot import check as check_robot
    from .model.reading import read_robot
    from .model.values import NumberReader

    finder, wants = request.finder, request.options.wanted_advice()
    numbers = NumberReader()
    robot = read_robot(root, notes=notes, numbers=numbers)
    advisor = None if wants is None else Reporter()
    has_files = check_robot(
        root,
        reporter=reporter,
        resolve_mesh=finder.resolve,
        package_fault=finder.package_fault,
        path_meant=finder.path_meant,
        may_read=finder.allows,
        looks_at_fits=_looks_at_fits(request.options),
        advice=advisor,
        robot=robot,
        numbers=numbers,
    )
    if clashes := finder.package_clashes():
        from .check.files import warn_of_clashes

        warn_of_clashes(clashes, root, reporter)
    for diagnostic in advisor.diagnostics if advisor else ():
        if wants is not None and wants(diagnostic.code):
            reporter.add(diagnostic)
    return robot, has_files


def _looks_at_fits(options: Options) -> bool:
    """Return whether `yamaro check` or `fit` runs, or an SRDF is written."""
    wants = options.wanted_advice()
    is_wanted = wants is not None and wants("fits-overlap")
    return is_wanted or options.refitting is not None or "srdf" in (options.target or ())
