"""Runs the cases of a test file: builds the robot, and compares it with what is expected."""

from __future__ import annotations

import os
from time import perf_counter

from ...commands.check_reports import JUnitCase, JUnitFailure, junit_text
from ...diagnostics import ERROR, Diagnostic, YamaroError, failure
from ...files.regular import open_regular
from ...options import UsageError
from ...output import is_input, leads_out, write_file
from ...program import Program
from ...rendering import render_all
from ...runtime.files import rules_of
from ...sandbox.deep_stack import run_on_deep_stack
from ...source import KEYWORD_ARGUMENT
from .files import read_test_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ...diagnostics import Diagnostic
    from ...policy import Policy
    from ...result import Build
    from ...source import Span
    from ...syntax.context import Rules
    from .files import Case, ExpectedError, TestFile


class CaseResult:
    """The result of a case, which passed if it has no failures.

    Attributes:
        case: what was run.
        failures: why it failed.
        seconds: how long it took.
        accepted: the golden file that was written, or "".
    """

    __slots__ = ("accepted", "case", "failures", "seconds")

    def __init__(self, case: Case) -> None:
        self.case = case
        self.failures: list[Diagnostic] = []
        self.seconds = 0.0
        self.accepted = ""


class FileResult:
    """The results of a test file.

    Attributes:
        path: the file.
        cases: the results of the cases that were run.
        errors: what is wrong with the file itself, in which case nothing was run.
    """

    __slots__ = ("cases", "errors", "path")

    def __init__(self, path: str) -> None:
        self.path = path
        self.cases: list[CaseResult] = []
        self.errors: list[Diagnostic] = []


class Runner:
    """Runs test files."""

    def __init__(
        self,
        policy: Policy,
        *,
        packages: Mapping[str, str],
        accepts: bool = False,
        wants: Callable[[str], bool] = bool,
    ) -> None:
        """Prepare.

        Args:
            policy: how far the robots are trusted; expectations only ever compute.
            packages: folders of ROS packages by name.
            accepts: whether golden files are written instead of compared.
            wants: whether a case is run, by `file: name`.
        """
        from ...policy import SAFE, Policy

        self._policy = policy
        self._packages = packages
        self._accepts = accepts
        self._wants = wants
        self._limits = policy.limits if policy.is_safe else Policy(SAFE).limits
        self._rules: Rules = rules_of(Policy(SAFE))

    def run(self, path: str) -> FileResult:
        """Run a test file."""
        result = FileResult(path)
        try:
            file = read_test_file(path, rules=self._rules, limits=self._policy.limits)
        except YamaroError as error:
            result.errors = error.diagnostics
            return result
        program = Program(file.robot_path(), policy=self._policy, packages=self._packages)
        for case in file.cases:
            if not self._wants(f"{path}: {case.name}"):
                continue
            run = CaseResult(case)
            result.cases.append(run)
            started = perf_counter()
            try:
                run.failures = self._failures(run, file, program)
            except YamaroError as error:
                run.failures = _at_home(error.diagnostics, case)
            run.seconds = perf_counter() - started
        return result

    def _failures(self, result: CaseResult, file: TestFile, program: Program) -> list[Diagnostic]:
        """Return why a case failed; raise YamaroError if the robot has errors."""
        case = result.case
        try:
            build = program.build(
                variables=case.variables,
                advice=case.warnings is not None,
                on_message=_ignore,
                has_root=True,
                meshes="keep",
            )
        except UsageError as error:
            span = file.robot[1]
            code = "missing-file" if not os.path.isfile(file.robot_path()) else "bad-test"
            raise failure(code, str(error), span) from None
        except YamaroError as error:
            if case.errors is None:
                raise
            # What is missing of the errors that were expected, and then those there are.
            found = _at_home(error.diagnostics, case)
            errors = [diagnostic for diagnostic in found if diagnostic.severity == ERROR]
            missing = []
            for each in case.errors:
                same = [error for error in errors if error.code == each.code]
                if not same:
                    codes = ", ".join(dict.fromkeys(error.code for error in errors))
                    missing.append(_missing(each, f"has other errors: {codes}"))
                elif each.at and not any(is_at(error, each.at) for error in same):
                    places = ", ".join(dict.fromkeys(error.span.place() for error in same))
                    missing.append(_missing(each, f"has it elsewhere: {places}"))
                elif each.message and not any(each.message in error.message for error in same):
                    missing.append(
                        _missing(each, f"has it with another message: {same[0].message}")
                    )
            return [*missing, *errors] if missing else []
        except SystemExit as error:
            message = f"Python code of the robot ended the program: {error!r}"
            raise failure("python-error", message, file.robot[1]) from None
        if case.errors:
            return [_missing(expected, "has no errors") for expected in case.errors]
        found = [*_other_warnings(case, build), *self._unmet(case, file, build)]
        golden = case.golden
        if golden is not None:
            differing, result.accepted = run_on_deep_stack(
                lambda: compare_with_golden(
                    build, golden, folder=os.path.dirname(file.source.path), accepts=self._accepts
                )
            )
            found += differing
        return found

    def _unmet(self, case: Case, file: TestFile, build: Build) -> list[Diagnostic]:
        """Return which expectations are not met; they are evaluated in a jail if there is one."""
        if not case.expectations:
            return []
        from ...sandbox.transfer import Outcome
        from .expectations import Expectations

        robot = build.robot if build.root_name == "robot" else None

        def evaluate(say: Callable[[str], None] = _ignore) -> Outcome:
            expectations = Expectations(file.source, robot, rules=self._rules, limits=self._limits)
            failures = [expectations.failure(python) for python in case.expectations]
            return Outcome(diagnostics=[each for found in failures for each in found])

        if self._policy.is_trusted:
            return evaluate().diagnostics
        from ...confined import run_confined

        outcome = run_confined(
            evaluate,
            policy=self._policy,
            reach=None,
            name=file.source.name,
            has_root=False,
            has_document=False,
        )
        return outcome.diagnostics


def _at_home(diagnostics: list[Diagnostic], case: Case) -> list[Diagnostic]:
    """Return diagnostics about what was passed at the places in the test file."""
    for diagnostic in diagnostics:
        if diagnostic.span.source.name == KEYWORD_ARGUMENT:
            name = diagnostic.span.source.text.partition("=")[0]
            diagnostic.span = case.places.get(name, diagnostic.span)
    return diagnostics


def _ignore(message: str) -> None:
    """Take a line that a robot prints."""


# --- errors and warnings ---


def _missing(expected: ExpectedError, why: str) -> Diagnostic:
    message = f"the error '{expected.code}' is expected, but the robot {why}"
    return Diagnostic("error-expected", message, expected.span)


def is_at(error: Diagnostic, place: str) -> bool:
    """Return whether an error is at a place such as `robot.yaml`, `robot.yaml:12` or `:12:5`."""
    line, column = error.span.location()
    name = error.span.source.name.replace(os.sep, "/")
    for full in (f"{name}:{line}:{column}", f"{name}:{line}", name):
        if full == place or full.endswith("/" + place):
            return True
    return place in (f":{line}:{column}", f":{line}")


def _other_warnings(case: Case, build: Build) -> list[Diagnostic]:
    """Return a failure if the robot has other warnings than expected."""
    if case.warnings is None:
        return []
    expected, span = case.warnings
    found = sorted({warning.code for warning in build.warnings})
    if found == sorted(set(expected)):
        return []
    message = f"the warnings are {', '.join(found) or 'none'}, not {', '.join(expected) or 'none'}"
    return [
        Diagnostic("error-expected", message, span),
        *(each for each in build.warnings if each.code not in expected),
    ]


# --- golden files -----------------------------------------------------------------------------


MOST_LINES = 12
"""Lines of differences to show."""


def compare_with_golden(
    build: Build, golden: tuple[str, Span], *, folder: str, accepts: bool
) -> tuple[list[Diagnostic], str]:
    """Return how the output differs from the golden file, and the file if it was written.

    Args:
        build: the robot.
        golden: the path of the file below the folder, and where that is written.
        folder: that of the test file.
        accepts: write the file if it differs or is missing.
    """
    name, span = golden
    path = os.path.join(folder, name)
    try:
        with open_regular(path) as file:
            old = file.read().decode("utf-8", "replace")
    except FileNotFoundError:
        old = None
    except OSError as error:
        reason = error.strerror or str(error)
        return [Diagnostic("output-differs", f"'{name}' cannot be read: {reason}", span)], ""
    lines = None if old is None else _differences(old, build, name)
    if lines is not None and not lines:
        return [], ""
    if accepts:
        _check_replaceable(path, old, build, golden, folder)
        try:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            write_file(path, build.encoded())
        except OSError as error:
            reason = error.strerror or str(error)
            raise failure("output-differs", f"'{name}' cannot be written: {reason}", span) from None
        return [], os.path.normpath(os.path.join(os.path.dirname(span.source.name), name))
    if lines is None:
        message, notes = f"the file '{name}' does not exist", []
    else:
        message, notes = f"the output differs from '{name}'", lines
    hint = "if the output is right, --accept writes the file"
    return failure("output-differs", message, span, hint=hint, notes=notes).diagnostics, ""


def _check_replaceable(
    path: str, old: str | None, build: Build, golden: tuple[str, Span], folder: str
) -> None:
    """Raise YamaroError unless a file that a test names may be written.

    That are files below the folder of the test, not hidden ones, and in the place of another file
    only where that holds what is compared with: XML with the same root, and nothing that was read.
    """
    name, span = golden
    reason = ""
    if leads_out(path, folder):
        reason = "links lead out of the folder of the test file there"
    elif any(part.startswith(".") for part in os.path.normpath(name).split(os.sep)):
        reason = "its path has a hidden part"
    elif is_input(path, [*build.files, *build.meshes, span.source.path]):
        reason = "it is one of the input files"
    elif old is not None and old.strip() and _root_of(old) != build.root_name:
        reason = f"it holds something else than a <{build.root_name}>"
    if reason:
        message = f"'{name}' cannot be written: {reason}"
        raise failure("output-differs", message, span, hint="remove it, or choose another name")


def _root_of(text: str) -> str:
    """Return the name of the root of XML, or "" for other text."""
    from ...source import Source
    from ...xml.reader import read_xml

    try:
        return read_xml(Source(text, name="")).root.name
    except YamaroError:
        return ""


def _differences(old: str, build: Build, name: str) -> list[str]:
    """Return in what the output differs by meaning, a line for each change."""
    from ...model.robot import Robot

    if build.root_name != "robot":
        from ...model.compare import compare
        from ...source import Source
        from ...xml.reader import read_xml

        try:
            old_root = read_xml(Source(old, name=name)).root
            new_root = read_xml(Source(build.xml(), name="output")).root
        except YamaroError as error:
            return [f"{name}: {error.diagnostics[0].message}"]
        return _first([str(difference) for difference in compare(old_root, new_root)])
    try:
        before = Robot.from_xml(old, name=name)
    except YamaroError as error:
        return [f"{name}: {error.diagnostics[0].message}"]
    changes = before.changes(build.robot, has_extras=False)
    if not changes:
        return []
    from ...model.changes.text import DiffText

    robots = (before, build.robot)
    mains = (name, "")
    text = DiffText(changes, robots, name=_name_of, mains=mains).render((name, "the output"))
    return _first(text.rstrip("\n").split("\n")[2:])


def _first(lines: list[str]) -> list[str]:
    if len(lines) <= MOST_LINES:
        return lines
    return [*lines[: MOST_LINES - 1], f"and {len(lines) - MOST_LINES + 1} more lines"]


def _name_of(span: Span) -> str:
    return span.source.name


# --- results as JSON and in the format of JUnit -----------------------------------------------


def results_data(results: Sequence[FileResult]) -> dict[str, object]:
    """Return the results as plain data; docs/test-a-robot.md describes it."""
    cases = [each for result in results for each in result.cases]
    return {
        "version": 1,
        "passed": sum(not each.failures for each in cases),
        "failed": sum(bool(each.failures) for each in cases),
        "files": [
            {
                "file": result.path,
                "errors": [_diagnostic(each) for each in result.errors],
                "cases": [
                    {
                        "name": each.case.name,
                        "line": each.case.span.location()[0],
                        "passed": not each.failures,
                        "seconds": round(each.seconds, 6),
                        "failures": [_diagnostic(failure) for failure in each.failures],
                    }
                    for each in result.cases
                ],
            }
            for result in results
        ],
    }


def _diagnostic(diagnostic: Diagnostic) -> dict[str, object]:
    line, column = diagnostic.span.location()
    return {
        "code": diagnostic.code,
        "message": diagnostic.message,
        "file": diagnostic.span.source.name,
        "line": line,
        "column": column,
        "hint": diagnostic.hint,
        "notes": list(diagnostic.notes),
    }


def junit_of(results: Sequence[FileResult]) -> str:
    """Return the results in the format of JUnit: a suite for each file."""
    suites = []
    for result in results:
        cases = [
            JUnitCase(
                each.case.name,
                group=result.path,
                failures=list(map(_failure, each.failures)),
                seconds=each.seconds,
                file=result.path,
                line=each.case.span.location()[0],
            )
            for each in result.cases
        ]
        if result.errors:
            failures = list(map(_failure, result.errors))
            cases.append(JUnitCase("the test file", group=result.path, failures=failures))
        suites.append((result.path, cases))
    return junit_text("yamaro test", suites)


def _failure(diagnostic: Diagnostic) -> JUnitFailure:
    text = "\n".join(render_all([diagnostic]))
    return JUnitFailure(diagnostic.code, diagnostic.message, text)
