"""The pipeline: read → parse → evaluate → lower → check → emit."""

from __future__ import annotations

from .diagnostics import Reporter, YamaroError
from .phases import add_gazebo, check, evaluate, lower
from .result import Build, Finished
from .runtime.interpreter import Interpreter
from .runtime.predefined import TARGET
from .runtime.statements import HANDLERS
from .xml.writer import write_pieces

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .diagnostics import Diagnostic
    from .policy import Policy
    from .request import Request
    from .runtime.interpreter import Handlers
    from .runtime.library import Library
    from .xml.tree import Element


def compile_request(
    request: Request, library: Library, policy: Policy, say: Callable[[str], None]
) -> Build:
    """Return what is built of a main file, which `main_file.py` has read.

    Args:
        request: the main file, and what was asked for with it.
        library: reads and parses files.
        policy: how far they are trusted.
        say: takes the lines that they print.

    Raises:
        YamaroError: the input has errors.
    """
    reporter, finder = request.reporter, request.paths.finder
    interpreter = interpreter_for(request, library, policy, say)
    evaluated = evaluate(request, interpreter)
    document = _lower_check_emit(evaluated, request, interpreter)
    finished = document.root
    if finished is not None:
        request.allow(document.diagnostics)
    else:
        explain(document.diagnostics, interpreter)
    if finished is None or request.adjustment.deny(document.diagnostics):
        raise YamaroError(document.diagnostics)
    for diagnostic in document.diagnostics:
        reporter.add(diagnostic)
    return Build(
        lambda: finder.referred_to(finished),
        finished=finished,
        notes=document.notes,
        paths=request.paths,
        pieces=document.pieces,
        warnings=reporter.diagnostics,
        files=list(interpreter.files.read),
        noted=interpreter.noted.readings() if interpreter.noted is not None else (),
    )


def interpreter_for(
    request: Request,
    library: Library,
    policy: Policy,
    say: Callable[[str], None],
    *,
    target: str = TARGET,
) -> Interpreter:
    """Return what runs the main file; for the other arguments see `compile_request`.

    Args:
        request: the main file, and what was asked for with it.
        library: reads and parses files.
        policy: how far they are trusted.
        say: takes the lines that they print.
        target: the output format that is written.
    """
    interpreter = Interpreter(
        _handlers(request),
        library=library,
        reporter=request.reporter,
        on_message=say,
        policy=policy,
        packages=request.packages,
        shares=not request.records,
        target=target,
    )
    if request.records:
        from .runtime.recording import Noted

        interpreter.noted = Noted(interpreter)
    return interpreter


def explain(errors: Iterable[Diagnostic], interpreter: Interpreter) -> None:
    """Note in errors that are raised where the values come from that are wrong."""
    from .runtime.origins import add_origins

    for diagnostic in errors:
        add_origins(diagnostic, interpreter.files, interpreter.places)


def _handlers(request: Request) -> Handlers:
    if not request.records:
        return HANDLERS
    from .runtime.recording import RECORDING_HANDLERS

    return RECORDING_HANDLERS


def _lower_check_emit(root: Element, request: Request, interpreter: Interpreter) -> Finished:
    reporter, paths = Reporter(), request.paths
    try:
        root, notes = lower(root, interpreter, paths.finder, reporter)
        if request.has_gazebo and notes:
            root = add_gazebo(root, notes, reporter)
        has_files = check(root, paths.finder, reporter, request.wanted_advice(), notes=notes)
        written = paths.applied_to(root) if has_files else root
        return Finished(
            root, write_pieces(written, interpreter.limits), reporter.diagnostics, notes
        )
    except YamaroError as error:
        return Finished(None, [], [*reporter.diagnostics, *error.diagnostics])
