"""Runs the cases of a test file: builds the robot, and compares it with what is expected."""

from __future__ import annotations

import os
from time import perf_counter

from ...diagnostics import ERROR, Diagnostic, YamaroError, failure
from ...options import UsageError
from ...program import Program
from ...runtime.files import rules_of
from ...sandbox.deep_stack import run_on_deep_stack
from ...source import KEYWORD_ARGUMENT
from .files import read_test_file
from .golden import compare_with_golden

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from ...policy import Policy
    from ...result import Build
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
        program = self._program(file)
        for case in file.cases:
            if self._wants(f"{path}: {case.name}"):
                result.cases.append(self._run_case(case, file, program))
        return result

    def _program(self, file: TestFile) -> Program:
        return Program(file.robot_path(), policy=self._policy, packages=self._packages)

    def _run_case(self, case: Case, file: TestFile, program: Program) -> CaseResult:
        result = CaseResult(case)
        started = perf_counter()
        try:
            result.failures = self._failures(result, file, program)
        except YamaroError as error:
            result.failures = _at_home(error.diagnostics, case)
        result.seconds = perf_counter() - started
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
            return _unexpected(case.errors, _at_home(error.diagnostics, case))
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


def _unexpected(expected: list[ExpectedError], found: list[Diagnostic]) -> list[Diagnostic]:
    """Return what is missing of the errors that were expected, and then those there are."""
    errors = [diagnostic for diagnostic in found if diagnostic.severity == ERROR]
    missing = []
    for each in expected:
        same = [error for error in errors if error.code == each.code]
        if not same:
            codes = ", ".join(dict.fromkeys(error.code for error in errors))
            missing.append(_missing(each, f"has other errors: {codes}"))
        elif each.at and not any(is_at(error, each.at) for error in same):
            places = ", ".join(dict.fromkeys(error.span.place() for error in same))
            missing.append(_missing(each, f"has it elsewhere: {places}"))
        elif each.message and not any(each.message in error.message for error in same):
            missing.append(_missing(each, f"has it with another message: {same[0].message}"))
    return [*missing, *errors] if missing else []


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
