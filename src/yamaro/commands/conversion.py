"""Builds one file once, reports on it, and writes the result of a command.

That file may be one that can be read only once: standard input or a named pipe.
"""

from __future__ import annotations

import os
import sys
import warnings

from ..source import STANDARD_INPUT, STANDARD_INPUT_NAME
from ..streams import XML
from .arguments import make_policy, options_of, read_adjustment, read_packages
from .reports import (
    DONE,
    INPUT_ERROR,
    WrongUsage,
    deliver,
    deliver_assets,
    display_name,
    quote,
    refuse_overwriting,
    sayer,
    show,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from ..diagnostics import Diagnostic
    from ..files.loader import Loader
    from ..policy import Policy
    from ..result import Build
    from ..streams import Streams
    from .arguments import Arguments


class ProgramEnded(Exception):
    """User code called sys.exit, which must not pass for success."""


def convert_file(
    arguments: Arguments,
    streams: Streams,
    take: Callable[[Build], Iterable[bytes | str]],
    *,
    form: str = XML,
    prepare: Callable[[], object] | None = None,
    conclude: Callable[[Build], object] | None = None,
    advice: bool = False,
    has_root: bool = False,
    records: bool = False,
) -> int:
    """Build the file and write what is taken of the result; return the exit status.

    Args:
        arguments: the command line.
        streams: where everything goes.
        take: gives what to write of a successful build. It is called while standard output is out
            of reach, since that may run code of the user's too.
        form: that of what is taken in bytes; see `Streams.write_result`.
        prepare: is called before the build; raises YamaroError for what shall not have to wait.
        conclude: is called when the result is written.
        advice: also warn of what is legal but seldom meant; any warning that is not allowed then
            makes the command fail.
        has_root: whether `take` needs the tree.
        records: whether it needs to know which variables were read; see `api.build`.
    """
    from ..diagnostics import YamaroError

    arguments.resolve_output()
    refuse_overwriting(arguments, lambda: arguments.words)
    if arguments.has("depfile"):
        from .dependencies import check_depfile

        check_depfile(arguments)
    policy = make_policy(arguments)
    if not policy.is_trusted:
        streams.silence_libraries()
    adjustment = read_adjustment(arguments)
    try:
        if prepare is not None:
            prepare()
        if streams.owns_process:
            _bound_process(arguments, streams, policy)
        build, chunks = _build(
            arguments, streams, policy, take, advice=advice, has_root=has_root, records=records
        )
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    streams.kept.append(build)
    show(build.warnings, arguments, streams)
    if advice and any(warning.code not in adjustment.allowed for warning in build.warnings):
        return INPUT_ERROR
    status = _deliver_build(build, chunks, arguments, streams, form)
    if conclude is not None and status == DONE:
        conclude(build)
    return status


def find_in_file(
    arguments: Arguments,
    streams: Streams,
    *,
    texts: Mapping[str, str] | None = None,
    look: Callable[[Build], Sequence[Diagnostic]] | None = None,
) -> tuple[list[Diagnostic], Sequence[Diagnostic]]:
    """Build the file and return all that is to be said of it, with the advice of `check`.

    What comments in the files accept is returned apart.

    Args:
        arguments: the command line, with one file.
        streams: where everything goes that the file prints.
        texts: what to read in place of some files, by absolute paths.
        look: finds more in the tree of what was built.
    """
    from ..diagnostics import YamaroError

    policy = make_policy(arguments)
    if not policy.is_trusted:
        streams.silence_libraries()
    cancel = None
    loader = None
    if texts is not None:
        from ..files.loader import FileLoader, OverlayLoader
        from ..request import reach_of

        reach = reach_of(arguments.words[0], policy, read_packages(arguments))
        loader = OverlayLoader(texts, FileLoader(policy.limits, reach))
    try:
        if streams.owns_process:
            cancel = _bound_process(arguments, streams, policy)
        build, _ = _build(
            arguments, streams, policy, lambda build: (), advice=True,
            has_root=look is not None, records=False, loader=loader,
        )  # fmt: skip
    except YamaroError as error:
        return error.diagnostics, error.accepted
    finally:
        if cancel is not None:
            cancel()
    if look is None:
        return build.warnings, build.accepted
    from ..allowances import accept, set_aside

    found = [*build.warnings, *look(build)]
    accept(found)
    accepted = set_aside(found)
    return found, [*build.accepted, *accepted]


def _deliver_build(
    build: Build, chunks: Iterable[bytes | str], arguments: Arguments, streams: Streams, form: str
) -> int:
    """Write what was taken of a build, and what belongs to it; return the exit status."""
    if arguments.has("depfile"):  # before the output, which is then never newer than that
        from ..diagnostics import YamaroError
        from .dependencies import write_depfile

        try:
            status = write_depfile(build, arguments, streams)
        except YamaroError as error:
            show(error.diagnostics, arguments, streams)
            return INPUT_ERROR
        if status != DONE:
            return status
    command = arguments.known_command
    has_own_format = command.writes_document and command.targets is not None and build.outputs
    is_named = arguments.has("to") and arguments.command == "build"
    if (is_named or has_own_format) and not arguments.has("deps"):
        from .formats import deliver_formats

        return deliver_formats(build, chunks, arguments, streams)
    refuse_overwriting(arguments, lambda: [*build.files, *build.meshes])
    is_document = arguments.known_command.writes_document  # others show something of the robot
    status = deliver_assets(build, arguments, streams) if is_document else DONE
    return deliver(chunks, arguments, streams, form) if status == DONE else status


def _bound_process(
    arguments: Arguments, streams: Streams, policy: Policy
) -> Callable[[], None] | None:
    """See to it that this process takes no more memory and time than it may.

    Returns:
        What calls the end of time off, if there is one.
    """
    from ..sandbox import process

    process.bound_memory(policy.limits.memory)
    if policy.timeout is None:
        return None
    from ..confined import has_jail

    if has_jail(policy, display_name(arguments)):
        return None
    return end_process(arguments, streams, policy, policy.timeout)


def end_process(
    arguments: Arguments, streams: Streams, policy: Policy, seconds: float
) -> Callable[[], None]:
    """End this process after `seconds`, with the reason; return a function that cancels that."""
    from ..confined import time_is_over
    from ..sandbox import process

    def say_why() -> None:
        show(time_is_over(display_name(arguments), policy).diagnostics, arguments, streams)

    return process.end_after(seconds, say_why)


def _build(
    arguments: Arguments,
    streams: Streams,
    policy: Policy,
    take: Callable[[Build], Iterable[bytes | str]],
    *,
    advice: bool,
    has_root: bool,
    records: bool,
    loader: Loader | None = None,
) -> tuple[Build, Iterable[bytes | str]]:
    """Build the file; return the build and what to write."""
    from ..options import UsageError
    from ..program import Program

    path = arguments.words[0]
    show_progress: Callable[[float], None] | None = None

    def on_progress(part: float) -> None:
        """Show how far the work is, which few builds say."""
        nonlocal show_progress
        if show_progress is None:
            from .progress import progress_on

            show_progress = progress_on(streams) or (lambda part: None)
        show_progress(part)

    options = options_of(
        arguments,
        policy=policy,
        text=read_pipe(path, policy),
        loader=loader,
        on_message=sayer(streams),
        on_progress=on_progress,
        advice=advice,
        has_root=has_root,
        records=records,
    )
    try:
        with warnings.catch_warnings():
            if not sys.warnoptions:  # user code's warnings, unless asked for with -W
                warnings.simplefilter("ignore")
            build = Program(path, options).build()
            return build, take(build)
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    except SystemExit as error:
        raise ProgramEnded(f"Python code of the file ended the program: {error!r}") from None


# --- what can be read only once -------------------------------------------------------------


def read_pipe(path: str, policy: Policy) -> str | None:
    """Return the text of standard input or of a named pipe, None for what can be read by name."""
    from ..files.loader import LoadError, check_size, decode

    limits = policy.limits
    try:
        data = read_bytes(path, limits.file + 1, policy.timeout)
    except TimeoutError:
        from ..confined import time_is_over

        name = STANDARD_INPUT_NAME if path == STANDARD_INPUT else path
        raise time_is_over(name, policy) from None
    if data is None:
        return None
    if path == STANDARD_INPUT:
        name, absolute = STANDARD_INPUT_NAME, ""
    else:
        name, absolute = path, os.path.abspath(path)
    try:
        check_size(len(data), limits)
    except LoadError as error:
        from ..request import refusal_of_main

        raise refusal_of_main(name, error) from None
    return decode(data, name=name, path=absolute).text


def read_bytes(path: str, most: int, seconds: float | None = None) -> bytes | None:
    """Return `most` bytes of standard input or a pipe, None for what can be read by name.

    Raises:
        TimeoutError: it takes more than `seconds`.
        WrongUsage: it cannot be read.
    """
    from ..files import regular

    if path == STANDARD_INPUT:
        if sys.stdin is None:
            raise WrongUsage("standard input is closed")
        buffer = getattr(sys.stdin, "buffer", None)
        try:
            descriptor: int | None = buffer.fileno()  # type: ignore[union-attr]
        except (AttributeError, OSError, ValueError):  # it is one of Python's own
            descriptor = None
        try:
            if seconds is not None and os.name != "nt" and descriptor is not None:
                return regular.read_within(descriptor, most, seconds)
            return sys.stdin.read(most).encode() if buffer is None else buffer.read(most)
        except TimeoutError:
            raise
        except OSError as error:
            raise WrongUsage(f"cannot read standard input: {error.strerror}") from None
    try:
        return regular.read_pipe(path, most, seconds)
    except TimeoutError:
        raise
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.errno == regular.UNOPENED:
            raise WrongUsage(f"cannot read {quote(path)}: {error.strerror}") from None
        return None  # the loader says why
