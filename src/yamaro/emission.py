"""Builds a main file in the output formats asked for: runs it, and has each format written.

The file is run once for all formats if the run does not depend on the format: if nothing reads
`target`, and no block for one format is reached. Otherwise it is run for each format; SRDF, which
belongs to a URDF, uses the run of that.
"""

from __future__ import annotations

import os

from .arguments import UsageError
from .diagnostics import ERROR, WARNING, Diagnostic, Reporter, YamaroError, did_you_mean
from .model.joint import FIXED
from .model.kinematics import base_of
from .model.reading import read_robot
from .model.values import NumberReader
from .phases import add_gazebo, check, evaluate, lower
from .pipeline import explain, interpreter_for
from .request import Target
from .result import Build
from .targets.losses import diagnostics_of
from .targets.output import Wanted, is_file_stem
from .targets.writers import BASES, ENDINGS, SDF_VERSIONS, URDF_ONLY, write_target
from .terminal import shortened
from .xml.writer import write_pieces

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from .model.robot import Robot
    from .policy import Policy
    from .request import Request
    from .runtime.interpreter import Interpreter
    from .runtime.library import Library
    from .targets.mesh_paths import MeshPaths
    from .targets.output import Loss
    from .xml.tree import Element

    Say = Callable[[str], None]

BINARY_USD = (".usdc", ".usdz")
"""The endings of files of USD that are not text, by which OpenUSD knows how to read them."""
BINARY_USD = (".usdc", ".usdz")
"""The endings of files of USD that are not text, by which OpenUSD knows how to read them."""
SIMULATORS = ("mjcf", "sdf", "usd")
"""The formats that say whether the root is fixed in the world."""
TELLTALES = frozenset(("target", "eval", "exec", "globals", "locals", "vars"))
"""The names of which an expression reads one if what it gives may depend on the format."""


def targets_of(
    target: str | Sequence[str],
    paths: MeshPaths,
    *,
    has_meshes: bool,
    base: str | None,
    repairs_inertia: bool,
    sdf_version: str | None,
    output: str | None,
    progress: Callable[[float], None] | None = None,
) -> list[Target]:
    """Return the output formats asked for; see `yamaro.build`.

    Raises:
        UsageError: a format, the base or the version of SDF is unknown.
    """
    formats = [target] if isinstance(target, str) else list(dict.fromkeys(target))
    if not formats:
        raise UsageError("no output format is named")
    for format in formats:
        _check_choice("output format", format, list(ENDINGS))
    ending = os.path.splitext(output or "")[1].lower()
    if "usd" in formats and ending in BINARY_USD:
        stem = os.path.splitext(_file_name(output) or "")[0]
        raise UsageError(
            f"USD is written as text, which '{ending}' files are not: name it {stem}.usda or "
            f"{stem}.usd; OpenUSD converts it: Usd.Stage.Open('{stem}.usda').Export('{stem}.usdc')"
        )
    if base is not None:
        _check_choice("base", base, BASES)
    if sdf_version is not None:
        _check_choice("version of SDF", sdf_version, SDF_VERSIONS)
    return [
        Target(
            format,
            paths,
            has_meshes=has_meshes,
            base=base,
            repairs_inertia=repairs_inertia,
            version=sdf_version or "" if format == "sdf" else "",
            file_name=_file_name(output),
            progress=progress,
        )
        for format in formats
    ]


def _file_name(output: str | None) -> str | None:
    """Return what a file is called, "" for none, None if only its folder is known."""
    return "" if output is None else os.path.basename(output) or None


def _check_choice(what: str, value: str, known: Sequence[str]) -> None:
    if value not in known:
        hint = did_you_mean(value, known)
        listed = hint or "choose one of " + ", ".join(known)
        raise UsageError(f"'{shortened(value)}' is not a known {what}; {listed}")


def compile_targets(request: Request, library: Library, policy: Policy, say: Say) -> Build:
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
    runs = _Runs(request, library, policy, say)
    builds: dict[str, Build] = {}
    errors = Reporter()
    refused: dict[str, str] = {}
    has_failed = False
    for target in request.targets:
        run = runs.run_for(target.format)
        try:
            builds[target.format] = _build(run, target, request)
        except YamaroError as error:
            if request.is_partial and not run.is_faulty:
                refused[target.format] = _reason_of(error)
                continue
            has_failed = True
            for diagnostic in error.diagnostics:
                errors.add(diagnostic)
    if has_failed:
        raise YamaroError(errors.diagnostics)
    first = next(iter(builds.values()))
    first.outputs, first.refused = builds, refused
    return first


def _reason_of(error: YamaroError) -> str:
    """Return the message of the first error."""
    return next(each.message for each in error.diagnostics if each.severity == ERROR)


class _Run:
    """A run of the main file, with what lowering and checking made of it.

    Attributes:
        interpreter: what ran it.
        root: the finished tree.
        notes: what the robot has that is not an element of it.
        diagnostics: what was found.
        has_files: whether the tree refers to files of meshes.
        is_faulty: whether there is only the tree that was evaluated.
    """

    __slots__ = (
        "diagnostics", "has_files", "interpreter", "is_faulty", "notes", "robot", "root",
    )  # fmt: skip

    def __init__(self, request: Request, interpreter: Interpreter) -> None:
        self.interpreter = interpreter
        self.root = evaluate(request, interpreter)
        self.notes: Sequence[Element] = ()
        self.has_files = False
        self.is_faulty = False
        self.robot: Robot | None = None
        reporter, finder = Reporter(), request.paths.finder
        try:
            self.root, self.notes = lower(self.root, interpreter, finder, reporter)
            numbers = NumberReader()
            if self.root.name == "robot":
                self.robot = read_robot(self.root, notes=self.notes, numbers=numbers)
            self.has_files = check(
                self.root,
                finder,
                reporter,
                request.wanted_advice(),
                robot=self.robot,
                numbers=numbers,
            )
            self.diagnostics = reporter.diagnostics
        except YamaroError as error:
            self.is_faulty = True
            self.diagnostics = [*reporter.diagnostics, *error.diagnostics]

    @property
    def depends_on_format(self) -> bool:
        """Return whether the run may give something else for another format."""
        files = self.interpreter.files
        return self.interpreter.has_raw_blocks or not TELLTALES.isdisjoint(files.names_read())

    def told_robot(self) -> Robot:
        """Return the robot with what the file says of it in words, and not in elements of XML."""
        return read_robot(self.root, notes=self.notes, recognizes=False)

    def robot_of(self) -> Robot:
        """Return the robot; raise YamaroError if the root is not a `<robot>`."""
        if self.robot is None:
            self.robot = read_robot(self.root, notes=self.notes)
        return self.robot


class _Runs:
    """The runs of the main file, by the value of `target` in them."""

    __slots__ = ("_library", "_policy", "_request", "_runs", "_said", "_say")

    def __init__(self, request: Request, library: Library, policy: Policy, say: Say) -> None:
        self._request = request
        self._library = library
        self._policy = policy
        self._say = say
        self._said: set[str] = set()
        self._runs: dict[str, _Run] = {}

    def run_for(self, format: str) -> _Run:
        """Return the run for a format; raise YamaroError if it ends with an error."""
        name = "urdf" if format == "srdf" else format
        if name in self._runs:
            return self._runs[name]
        for run in self._runs.values():
            if not run.depends_on_format:
                return run
        said = set(self._said)  # a line that comes twice in one run is said twice

        def say(line: str) -> None:
            self._said.add(line)
            if line not in said:
                self._say(line)

        request, library, policy = self._request, self._library, self._policy
        interpreter = interpreter_for(request, library, policy, say, target=name)
        run = self._runs[name] = _Run(request, interpreter)
        return run


def _build(run: _Run, target: Target, request: Request) -> Build:
    """Return the build of one format.

    Raises:
        YamaroError: the robot has errors, or the format cannot be written.
    """
    found = _found_for(target.format, run.diagnostics)
    if run.is_faulty:
        explain(found, run.interpreter)
        raise YamaroError(found)
    if target.format in SIMULATORS and not request.is_partial:
        found += _assumed_base(run.robot_of(), target.base)
    request.allow(found)
    if request.adjustment.deny(found):
        raise YamaroError(found)
    try:
        build = _written(run, target, request)
    except YamaroError as error:
        raise YamaroError([*found, *error.diagnostics]) from None
    losses = [] if request.is_partial else diagnostics_of(build.losses, target.format)
    for diagnostic in (*found, *losses):
        request.reporter.add(diagnostic)
    return build


def _found_for(format: str, diagnostics: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return copies of what was found, except for what concerns URDF alone in another format."""
    left_out = frozenset() if format == "urdf" else URDF_ONLY
    return [each.copy() for each in diagnostics if each.code not in left_out]


def _written(run: _Run, target: Target, request: Request) -> Build:
    """Return the build of a format; raise YamaroError if it cannot be written."""
    finder, limits = request.paths.finder, run.interpreter.limits
    is_any_xml = request.is_partial and target.format == "urdf" and run.root.name != "robot"
    robot = None if is_any_xml else run.robot_of()
    root, document, text = run.root, None, ""
    file_name = target.file_name
    if file_name is None:
        file_name = file_name_for(robot, target.format, request.stem)
    losses: Sequence[Loss]
    assets: Mapping[str, bytes] | None = None
    if target.format == "urdf" or robot is None:
        from .targets.urdf import losses_of

        if request.has_gazebo and run.notes:
            root = add_gazebo(root, run.notes, request.reporter, reports_losses=False)
        losses = () if robot is None else losses_of(run.told_robot(), request.has_gazebo)
        written = target.paths.applied_to(root) if run.has_files else root
    else:
        output = write_target(robot, _wanted(robot, target, request.stem, file_name))
        losses, assets, text = output.losses, output.files, output.text
        written = document = output.root
    build = Build(
        lambda: finder.referred_to(root),
        finished=root,
        notes=run.notes,
        paths=target.paths,
        pieces=[text] if text else write_pieces(written, limits),
        warnings=request.reporter.diagnostics,
        files=list(run.interpreter.files.read),
        format=target.format,
        document=document,
        losses=losses,
        assets=assets,
    )
    build.file_name = file_name
    return build


def file_name_for(robot: Robot | None, format: str, stem: str) -> str:
    """Return what a robot's file in a folder is called: by its name, or else as its source is."""
    name = "" if robot is None else robot.name
    if not is_file_stem(name):
        name = stem if is_file_stem(stem) else "robot"
    if format == "mjcf" and name.casefold() == "scene":  # the file beside it has that name
        name += "_robot"
    return name + ENDINGS[format]


def _wanted(robot: Robot, target: Target, stem: str, file_name: str) -> Wanted:
    return Wanted(
        target.format,
        name=stem,
        is_fixed=base_of(robot, target.base)[0] == FIXED,
        paths=target.paths,
        has_meshes=target.has_meshes,
        repairs_inertia=target.repairs_inertia,
        version=target.version,
        file_name=file_name,
        progress=target.progress,
    )


def _assumed_base(robot: Robot, asked: str | None) -> list[Diagnostic]:
    """Return a warning if nothing says whether the root is fixed; else nothing."""
    base, reason = base_of(robot, asked)
    if not reason:
        return []
    return [
        Diagnostic(
            "base-assumed",
            f"the base is assumed to be {base}, since {reason}",
            robot.span,
            hint="write 'base: fixed' or 'base: free' in the main file, or pass --base",
            severity=WARNING,
        )
    ]
