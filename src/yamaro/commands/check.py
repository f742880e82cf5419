"""`yamaro check FILE...`: looks for errors, warnings and doubtful things, and fixes some."""

from __future__ import annotations

import os

from ..source import STANDARD_INPUT
from .conversion import convert_file, find_in_file
from .delivery import deliver, goes_to_standard_output, refuse_overwriting
from .reports import display_name, show
from .settings import make_policy, read_adjustment
from .usage import DONE, INPUT_ERROR, WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ..diagnostics import Diagnostic
    from ..result import Build
    from ..streams import Streams
    from ..tools.fixing import Fixing
    from ..tools.reports.findings import Checked
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Report all findings, or say that there is none; return the exit status."""
    form = arguments.options.get("format", "text")
    if form == "text" and arguments.has("output"):
        raise WrongUsage("'-o' needs '--format' with json, sarif, github or junit")
    is_one = len(arguments.words) == 1 and not is_srdf(arguments.words[0])
    if form == "text" and is_one and not arguments.has("fix"):
        fine = [] if streams.quiet else [f"{display_name(arguments)}: ok\n"]
        return convert_file(arguments, streams, lambda build: fine, advice=True)
    arguments.resolve_output()
    refuse_overwriting(arguments, lambda: arguments.words)
    if STANDARD_INPUT in arguments.words and len(arguments.words) > 1:
        raise WrongUsage("standard input cannot be checked together with files")
    if arguments.has("fix"):
        files = _fixed(arguments, streams)
        if files is None:
            return INPUT_ERROR
    else:
        files = _check_all(arguments, streams)
    status = DONE if all(each.is_fine for each in files) else INPUT_ERROR
    if form == "text":
        return max(status, _say(files, arguments, streams))
    if not goes_to_standard_output(arguments):
        _say(files, arguments, streams)
    return max(status, deliver([_report(files, form).encode()], arguments, streams))


def _each_file(arguments: Arguments) -> list[Arguments]:
    paths = dict.fromkeys(arguments.words)  # a file that is named twice is checked once
    return [arguments.for_file(path) for path in paths]


def _check_all(
    arguments: Arguments, streams: Streams, texts: Mapping[str, str] | None = None
) -> list[Checked]:
    """Check each file; those of robots first, for SRDF is checked against these."""
    every = _each_file(arguments)
    if not any(is_srdf(each.words[0]) for each in every):
        return [_checked(each, streams, texts) for each in every]
    from .semantics import Semantics

    semantics = Semantics(arguments, streams, texts)
    done: dict[str, Checked] = {}
    for each in sorted(every, key=lambda each: is_srdf(each.words[0])):
        path = each.words[0]
        look = semantics.findings if is_srdf(path) else semantics.keep
        done[path] = _checked(each, streams, texts, look)
    return [done[each.words[0]] for each in every]


def is_srdf(path: str) -> bool:
    """Return whether a file is called as those with MoveIt's semantic descriptions are."""
    return ".srdf" in os.path.basename(path).lower()


def _checked(
    arguments: Arguments,
    streams: Streams,
    texts: Mapping[str, str] | None = None,
    look: Callable[[Build], Sequence[Diagnostic]] | None = None,
) -> Checked:
    """Check one file; `look` finds more in what was built of it."""
    from ..diagnostics import ERROR
    from ..tools.reports.findings import Checked

    allowed = read_adjustment(arguments).allowed
    try:
        found, accepted = find_in_file(arguments, streams, texts=texts, look=look)
    except WrongUsage:
        found, accepted = [_unreadable(arguments)], ()
    is_fine = all(each.severity != ERROR and each.code in allowed for each in found)
    path = arguments.words[0]
    absolute = "" if path == STANDARD_INPUT else os.path.abspath(path)
    return Checked(display_name(arguments), absolute, found, is_fine=is_fine, accepted=accepted)


def _unreadable(arguments: Arguments) -> Diagnostic:
    """Return the finding that a file cannot be read; raise the current exception if it can.

    One file that is missing shall not keep the others from being checked.
    """
    from ..diagnostics import failure_of_all
    from ..files.loader import FileLoader, LoadError

    path = arguments.words[0]
    if not path or path == STANDARD_INPUT:
        raise
    try:
        FileLoader(make_policy(arguments).limits).read(os.path.abspath(path))
    except LoadError as error:
        message, name = f"the file cannot be read: {error}", display_name(arguments)
        return failure_of_all(error.code, message, name, error.hint).diagnostics[0]
    raise


def _say(files: Sequence[Checked], arguments: Arguments, streams: Streams) -> int:
    """Show findings as text, each once; return the exit status of writing."""
    from ..tools.reports.findings import each_once

    once = {id(diagnostic) for _, diagnostic in each_once(files)}
    fine = []
    for each, own in zip(files, _each_file(arguments), strict=True):
        show([one for one in each.diagnostics if id(one) in once], own, streams)
        if not each.diagnostics and not streams.quiet:
            fine.append(f"{each.name}: ok\n")
    is_written = goes_to_standard_output(arguments)
    return deliver(fine, arguments, streams) if fine and is_written else DONE


def _report(files: Sequence[Checked], form: str) -> str:
    if form == "json":
        from ..tools.reports.data import json_report

        return json_report(files)
    if form == "sarif":
        from .. import __version__
        from ..tools.reports.sarif import sarif_report

        return sarif_report(files, __version__)
    if form == "github":
        from ..tools.reports.github import github_report

        return github_report(files)
    assert form == "junit", form
    from ..tools.reports.junit import junit_report

    return junit_report(files)


# --- fixes --------------------------------------------------------------------------------------


def _fixed(arguments: Arguments, streams: Streams) -> list[Checked] | None:
    """Fix the files, and return what is found then; None if they are left as they are."""
    from ..tools.fixing import Fixing, FixingFailed

    if STANDARD_INPUT in arguments.words:
        raise WrongUsage("'--fix' changes files, and standard input is not one")
    files: list[Checked] = []

    def check(texts: Mapping[str, str]) -> list[Diagnostic]:
        files[:] = _check_all(arguments, streams, texts)
        return [one for each in files for one in each.diagnostics]

    paths = [os.path.abspath(path) for path in arguments.words]
    fixing = Fixing(paths, make_policy(arguments).limits)
    try:
        fixing.run(check)
    except FixingFailed as error:
        streams.say(f"yamaro: error: nothing was fixed: {error}")
        return None
    if not _write(fixing, streams):
        return None
    if not streams.quiet:
        for each in fixing.applied:
            streams.say(f"{each.place}: fixed: {each.title}")
    return files


def _write(fixing: Fixing, streams: Streams) -> bool:
    """Write the changed files, or none of them; return whether they are written."""
    from ..output import write_files

    try:
        write_files(fixing.data())
    except OSError as error:
        streams.say(f"yamaro: error: nothing was fixed: {error.strerror or error}")
        return False
    return True
