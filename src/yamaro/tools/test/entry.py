"""`yamaro test [FILE|FOLDER ...]`: runs the cases of test files."""

from __future__ import annotations

from ...commands.arguments import make_policy, read_packages
from ...commands.command_table import Command
from ...commands.option_table import WORKING, Option
from ...commands.reports import DONE, INPUT_ERROR, WrongUsage, deliver, has_color, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...commands.arguments import Arguments
    from ...diagnostics import Diagnostic
    from ...streams import Streams
    from .runner import CaseResult, FileResult

COMMAND = Command(
    "test",
    ("[FILE|FOLDER ...]",),
    "test robots against what is expected of them",
    "Run the test files (*.test.yaml) that are named, and those in folders and below; by "
    "default in the working directory. Exit with 0 if all cases pass, 1 if any fails.",
    words=(("FILE, FOLDER", "test files, and folders with test files"),),
    looks=True,
    endings=("test.yaml", "test.yml"),
    examples=("yamaro test", "yamaro test robots --junit results.xml"),
    counts_words=False,
    place=10,
    options=(
        "json",
        Option("accept", "write the golden files that differ or are missing"),
        Option(
            "only",
            "run only the cases with that text in 'FILE: NAME'",
            short="k",
            value="TEXT",
            wants="a text",
        ),
        Option(
            "junit",
            "also write the results to FILE in the format of JUnit",
            value="FILE",
            wants="a file name",
            completes="files",
        ),
        *WORKING,
    ),
    help_of={"json": "write the results as JSON"},
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Report which cases pass and why others fail; return the exit status."""
    from .runner import Runner

    if arguments.assignments:
        raise WrongUsage("a test file sets variables itself, with `set`")
    policy = make_policy(arguments)
    if not policy.is_trusted:
        streams.silence_libraries()
    wanted = arguments.options.get("only", "")
    runner = Runner(
        policy,
        packages=read_packages(arguments),
        accepts=arguments.has("accept"),
        wants=lambda name: wanted in name,
    )
    from .files import test_files

    words = arguments.words or ["."]
    try:
        found = list(test_files(words))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        name = getattr(error, "filename", None) or ""
        raise WrongUsage(f"cannot read {quote(str(name))}: {reason}") from None
    if not found:
        where = ", ".join(map(quote, words))
        raise WrongUsage(f"there is no test file (*.test.yaml) in {where}")
    results: list[FileResult] = []
    for path in found:
        result = runner.run(path)
        results.append(result)
        if result.errors:
            _show(result.errors, arguments, streams)
        for case in result.cases:
            if case.failures:
                streams.say(f"FAILED {_title(result, case)}")
                _show(case.failures, arguments, streams)
            elif case.accepted and not streams.quiet:
                streams.say(f"wrote {case.accepted}")
    return _conclude(results, arguments, streams)


# --- while they run ---


def _title(result: FileResult, case: CaseResult) -> str:
    from ...terminal import printable

    return f"{printable(result.path)}: {printable(case.case.name)}"


def _show(diagnostics: Sequence[Diagnostic], arguments: Arguments, streams: Streams) -> None:
    from ...rendering import render_all

    color = has_color(arguments, is_terminal=streams.is_terminal())
    streams.say("\n\n".join(render_all(diagnostics, color=color)) + "\n", colored=color)


# --- in the end ---


def _conclude(results: list[FileResult], arguments: Arguments, streams: Streams) -> int:
    """Write the summary and the files asked for; return the exit status."""
    passed, failed, broken = _counts(results)
    if not passed + failed + broken:
        raise WrongUsage(f"no case has {quote(arguments.options.get('only', ''))} in its name")
    status = DONE
    if arguments.has("junit"):
        status = _write_junit(results, arguments, streams)
    if arguments.has("json"):
        import json

        from .runner import results_data

        text = json.dumps(results_data(results), indent=2) + "\n"
        status = max(status, deliver([text], arguments, streams))
    elif not streams.quiet:
        from ...terminal import printable

        lines = [
            f"{printable(result.path)}: {_counted(*_counts([result]))}"
            for result in results
            if result.cases or result.errors
        ]
        if len(lines) > 1:
            lines.append(_counted(*_counts(results)))
        status = max(status, deliver(["\n".join(lines) + "\n"], arguments, streams))
    return INPUT_ERROR if failed or broken else status


def _counts(results: list[FileResult]) -> tuple[int, int, int]:
    """Return how many cases passed, how many failed, and how many files have errors."""
    cases = [case for result in results for case in result.cases]
    failed = sum(bool(case.failures) for case in cases)
    return len(cases) - failed, failed, sum(bool(result.errors) for result in results)


def _counted(passed: int, failed: int, broken: int) -> str:
    files = f"{broken} test file{'s' if broken > 1 else ''} with errors"
    parts = [(failed, f"{failed} failed"), (broken, files), (passed, f"{passed} passed")]
    return ", ".join(text for count, text in parts if count)


def _write_junit(results: list[FileResult], arguments: Arguments, streams: Streams) -> int:
    from ...output import write_file
    from .runner import junit_of

    path = arguments.options["junit"]
    try:
        write_file(path, [junit_of(results).encode()])
    except OSError as error:
        streams.say(f"yamaro: error: cannot write {quote(path)}: {error.strerror or error}")
        return INPUT_ERROR
    return DONE
