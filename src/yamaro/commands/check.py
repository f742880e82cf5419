"""`yamaro check FILE...`: looks for errors, warnings and doubtful things, and fixes some."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence

from ..diagnostics import ERROR, Diagnostic, Reporter, YamaroError, failure_of_all
from ..model.robot import Robot
from ..model.schema import is_semantic
from ..model.values import attribute_text
from ..result import Build
from ..source import STANDARD_INPUT
from ..streams import Streams
from .arguments import Arguments, make_policy, read_adjustment, read_packages
from .check_reports import Checked
from .conversion import convert_file, find_in_file
from .reports import (
    DONE,
    INPUT_ERROR,
    WrongUsage,
    deliver,
    display_name,
    goes_to_standard_output,
    refuse_overwriting,
    show,
)


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
    from .. import __version__
    from .check_reports import github_report, json_report, junit_report, sarif_report

    if form == "sarif":
        report = sarif_report(files, __version__)
    else:
        reports = {"json": json_report, "github": github_report, "junit": junit_report}
        report = reports[form](files)
    return max(status, deliver([report.encode()], arguments, streams))


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
    from .check_reports import Checked

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
    from .check_reports import each_once

    once = {id(diagnostic) for _, diagnostic in each_once(files)}
    fine = []
    for each, own in zip(files, _each_file(arguments), strict=True):
        show([one for one in each.diagnostics if id(one) in once], own, streams)
        if not each.diagnostics and not streams.quiet:
            fine.append(f"{each.name}: ok\n")
    is_written = goes_to_standard_output(arguments)
    return deliver(fine, arguments, streams) if fine and is_written else DONE


# --- fixes --------------------------------------------------------------------------------------


def _fixed(arguments: Arguments, streams: Streams) -> list[Checked] | None:
    """Fix the files, and return what is found then; None if they are left as they are."""
    from ..output import write_files
    from .fixing import Fixing, FixingFailed

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
    try:
        write_files(fixing.data())
    except OSError as error:
        streams.say(f"yamaro: error: nothing was fixed: {error.strerror or error}")
        return None
    if not streams.quiet:
        for each in fixing.applied:
            streams.say(f"{each.place}: fixed: {each.title}")
    return files


# --- the robot that an SRDF is checked against: one that is given as well, or one beside it ---


MOST_NEIGHBOURS = 100
"""Files in the folder of an SRDF that are looked at."""


class Semantics:
    """Checks SRDF against robots.

    A robot beside an SRDF is read if it is plain URDF. Xacro and YAML are programs, which are run
    only if they are named.
    """

    def __init__(
        self, arguments: Arguments, streams: Streams, texts: Mapping[str, str] | None
    ) -> None:
        """Begin without robots; `texts` are read in place of some files."""
        self._arguments = arguments
        self._streams = streams
        self._texts = texts or {}
        self._robots: list[Robot] = []

    def keep(self, build: Build) -> Sequence[Diagnostic]:
        """Keep a robot that was given; find nothing."""
        if build.root_name == "robot" and build.robot.links:
            self._robots.append(build.robot)
        return ()

    def findings(self, build: Build) -> Sequence[Diagnostic]:
        """Return what is wrong with an SRDF as one of its robot."""
        if build.root_name != "robot" or not is_semantic(root := build.robot_tree()):
            return ()
        source = root.span.source
        name = attribute_text(root, "name") or ""
        given = [robot for robot in self._robots if robot.name == name] or self._robots[:1]
        robot = given[0] if given else self._beside(source.path, name)
        if robot is None:
            if not self._streams.quiet and not self._arguments.has("format"):
                self._streams.say(
                    f"{source.name}: checked without its robot; name that as well, as in "
                    f"`yamaro check robot.urdf {os.path.basename(source.name)}`"
                )
            return ()
        from ..check.semantics import findings_against

        reporter = Reporter()
        findings_against(root, robot, reporter)
        read_adjustment(self._arguments).deny(reporter.diagnostics)
        return reporter.diagnostics

    def _beside(self, path: str, name: str) -> Robot | None:
        """Return the URDF in a folder that is called as the SRDF is, or has its robot's name."""
        if not path:
            return None
        from ..files.loader import FileLoader, LoadError, decode
        from ..model.reading import read_robot
        from ..request import reach_of
        from ..xml.reader import read_xml

        folder, own = os.path.split(path)
        stem = own[: own.lower().index(".srdf")] if ".srdf" in own.lower() else own
        policy = make_policy(self._arguments)
        reach = reach_of(path, policy, read_packages(self._arguments))
        loader = FileLoader(policy.limits, reach)
        try:
            files = [each for each in os.listdir(folder) if each.lower().endswith(".urdf")]
        except OSError:
            return None
        files.sort(key=lambda each: (each[: -len(".urdf")] != stem, each))
        for each in files[:MOST_NEIGHBOURS]:
            whole = os.path.join(folder, each)
            try:
                text = self._texts.get(whole)
                data = loader.read(whole) if text is None else text.encode()
                source = decode(data, name=whole, path=whole)
                root = read_xml(source, policy.limits).root
            except (LoadError, YamaroError):
                continue
            is_called = each[: -len(".urdf")] == stem or attribute_text(root, "name") == name
            if root.name == "robot" and is_called and not is_semantic(root):
                return read_robot(root)
        return None
