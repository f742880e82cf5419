"""Test files: which there are, and what they say.

A test file names a robot and lists cases; docs/test-a-robot.md describes it. It is read as YAML
without `$(…)`; only the expectations are Python.
"""

from __future__ import annotations

import os

from ...diagnostics import Diagnostic, Reporter, YamaroError, did_you_mean, failure
from ...files.loader import FileLoader, LoadError, decode
from ...files.regular import files_below
from ...policy import UNSAFE
from ...runtime.predefined import plain_data
from ...syntax.context import ParseContext
from ...syntax.python import compile_expression
from ...syntax.values import parse_value
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode, is_null, quoted
from ...yaml.reader import read

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...policy import Limits
    from ...source import Source, Span
    from ...syntax.context import Rules
    from ...syntax.python import PythonCode
    from ...yaml.nodes import YamlNode

ENDINGS = (".test.yaml", ".test.yml")
ROBOT, SET, CASES = "robot", "set", "cases"
CASE_KEYS = ("name", SET, "expect", "error", "warnings", "urdf", "xml")
ERROR_KEYS = ("code", "at", "message")


class ExpectedError:
    """An error that a robot is expected to have.

    Attributes:
        code: its code.
        at: where: `robot.yaml`, `robot.yaml:12` or `robot.yaml:12:5`; "" for anywhere.
        message: what its message holds; "" for anything.
        span: where that is written.
    """

    __slots__ = ("at", "code", "message", "span")

    def __init__(self, code: str, span: Span, *, at: str = "", message: str = "") -> None:
        self.code = code
        self.span = span
        self.at = at
        self.message = message


class Case:
    """One case.

    Attributes:
        name: its name.
        span: where it is written.
        variables: what is passed to the robot.
        places: where each of them is written.
        expectations: the Python that has to be true.
        errors: the errors that the robot has to have; None if it must have none.
        warnings: the codes of the warnings that it has to have; None for any.
        golden: the file that its output is compared with, below the folder of the test file, and
            where that is written; or None.
    """

    __slots__ = (
        "errors",
        "expectations",
        "golden",
        "name",
        "places",
        "span",
        "variables",
        "warnings",
    )

    def __init__(self, name: str, span: Span) -> None:
        self.name = name
        self.span = span
        self.variables: dict[str, object] = {}
        self.places: dict[str, Span] = {}
        self.expectations: list[PythonCode] = []
        self.errors: list[ExpectedError] | None = None
        self.warnings: tuple[list[str], Span] | None = None
        self.golden: tuple[str, Span] | None = None


class TestFile:
    """A test file.

    Attributes:
        source: its text.
        robot: the path of the robot as written, and where; relative to the test file.
        cases: the cases.
    """

    __slots__ = ("cases", "robot", "source")

    def __init__(self, source: Source, robot: tuple[str, Span], cases: list[Case]) -> None:
        self.source = source
        self.robot = robot
        self.cases = cases

    def robot_path(self) -> str:
        """Return the path of the robot as it is opened."""
        return os.path.normpath(os.path.join(os.path.dirname(self.source.name), self.robot[0]))


# --- which there are ---


def test_files(words: list[str]) -> Iterator[str]:
    """Yield the test files that paths mean: files as they are, and those below folders.

    Raises:
        OSError: a path does not exist.
    """
    seen: set[str] = set()
    for word in words:
        if os.path.isdir(word):
            found = list(files_below(word, ENDINGS))
        else:
            os.stat(word)
            found = [word]
        for path in found:
            real = os.path.realpath(path)
            if real not in seen:
                seen.add(real)
                yield path


# --- what they say ---


def read_test_file(path: str, *, rules: Rules, limits: Limits) -> TestFile:
    """Return what a test file says.

    Raises:
        YamaroError: it cannot be read or has errors.
    """
    try:
        data = FileLoader(limits).read(os.path.abspath(path))
    except LoadError as error:
        from ...diagnostics import failure_of_all

        message = f"the file cannot be read: {error}"
        raise failure_of_all(error.code, message, path, error.hint) from None
    source = decode(data, name=path, path=os.path.abspath(path))
    reporter = Reporter()
    root = read(source, reporter=reporter, limits=limits)
    parser = _Parser(source, rules)
    test_file = parser.file(root)
    if parser.errors or test_file is None:
        without_trust(parser.errors)
        raise YamaroError(sorted(parser.errors, key=lambda each: each.span.start))
    return test_file


def _quoted(node: YamlNode) -> str:
    """Return the first line of what is written, in quotes."""
    return quoted(node.span().written().strip().split("\n")[0].rstrip())


def without_trust(diagnostics: list[Diagnostic]) -> list[Diagnostic]:
    """Return diagnostics about expectations: no option lets these do more than compute."""
    for diagnostic in diagnostics:
        if diagnostic.code == UNSAFE and "--trust" in (diagnostic.hint or ""):
            diagnostic.hint = "an expectation can only compute"
    return diagnostics


class _Parser:
    """Takes one test file apart, and collects what is wrong with it."""

    def __init__(self, source: Source, rules: Rules) -> None:
        self._source = source
        self._rules = rules
        self.errors: list[Diagnostic] = []

    def file(self, root: YamlNode) -> TestFile | None:
        """Return the file, or None for one that does not name a robot."""
        keys = (ROBOT, CASES, *CASE_KEYS)
        found = self._entries(root, keys, "a test file")
        if found is None:
            return None
        robot = self._text(found.get(ROBOT), ROBOT)
        if ROBOT not in found:
            self._error(
                "missing-key",
                "a test file needs the key `robot`",
                root.span(),
                hint="robot: arm.yaml names the file to test",
            )
        if CASES in found:
            for key in CASE_KEYS:
                if key in found and key != SET:
                    message = f"`{key}` belongs to one of the `cases`"
                    self._error(
                        "bad-test", message, found[key].span(), hint="move it into the list"
                    )
            shared, places = self._variables(found.get(SET))
            cases = []
            for number, node in enumerate(self._items(found[CASES], CASES), 1):
                inner = self._entries(node, CASE_KEYS, "a case")
                if inner is not None:
                    case = self._case(inner, node.span(), name=f"case {number}")
                    case.variables = {**shared, **case.variables}
                    case.places = {**places, **case.places}
                    cases.append(case)
        else:
            name = os.path.basename(self._source.name)
            for ending in ENDINGS:
                name = name.removesuffix(ending)
            cases = [self._case(found, root.span(), name=name)]
        return TestFile(self._source, robot, cases) if robot is not None else None

    def _case(self, found: dict[str, YamlNode], span: Span, *, name: str) -> Case:
        given = self._text(found.get("name"), "name")
        case = Case(given[0] if given else name, given[1] if given else span)
        case.variables, case.places = self._variables(found.get(SET))
        expected = found.get("expect")
        if expected is not None:
            is_one = isinstance(expected, ScalarNode)
            for each in [expected] if is_one else self._items(expected, "expect"):
                if not isinstance(each, ScalarNode):
                    self._error(
                        "bad-test",
                        "an expectation is a Python expression",
                        each.span(),
                        hint=f"if it holds a colon and a space, quote it: {_quoted(each)}",
                    )
                    continue
                try:
                    python = compile_expression(each.text, each, 0, self._rules)
                    case.expectations.append(python)
                except YamaroError as error:
                    self.errors += error.diagnostics
        if "error" in found:
            case.errors = self._expected_errors(found["error"])
        if "warnings" in found:
            nodes = self._items(found["warnings"], "warnings")
            codes = [self._text(node, "warnings") for node in nodes]
            case.warnings = ([code[0] for code in codes if code], found["warnings"].span())
        case.golden = self._golden(found)
        if case.errors is not None and (case.golden or case.expectations):
            self._error(
                "bad-test",
                "a robot with errors has no output to expect anything of",
                found["error"].span(),
                hint="make two cases of it",
            )
        return case

    def _golden(self, found: dict[str, YamlNode]) -> tuple[str, Span] | None:
        for key in ("urdf", "xml"):
            golden = self._text(found.get(key), key)
            if golden is None:
                continue
            inner = os.path.normpath(golden[0])
            if os.path.isabs(inner) or inner.split(os.sep)[0] == os.pardir:
                self._error(
                    "bad-test",
                    f"the file '{golden[0]}' is not below the folder of the test file",
                    golden[1],
                )
            return golden
        return None

    # --- values ---

    def _expected_errors(self, node: YamlNode) -> list[ExpectedError]:
        nodes = node.items if isinstance(node, SequenceNode) else [node]
        found = []
        for each in nodes:
            if isinstance(each, ScalarNode):
                code = self._text(each, "error")
                if code is not None:
                    found.append(ExpectedError(*code))
                continue
            inner = self._entries(each, ERROR_KEYS, "an expected error")
            if inner is None:
                continue
            if "code" not in inner:
                self._error("missing-key", "an expected error needs a `code`", each.span())
                continue
            texts = {key: self._text(inner.get(key), key) for key in ERROR_KEYS}
            at, message = texts["at"], texts["message"]
            found.append(
                ExpectedError(
                    texts["code"][0] if texts["code"] else "",
                    each.span(),
                    at=at[0] if at else "",
                    message=message[0] if message else "",
                )
            )
        return found

    def _variables(self, node: YamlNode | None) -> tuple[dict[str, object], dict[str, Span]]:
        """Return the variables in `set`, and where each is written."""
        if node is None or (isinstance(node, ScalarNode) and is_null(node.text)):
            return {}, {}
        if not isinstance(node, MappingNode):
            self._error("bad-test", "`set` takes names with values: {reach: 0.8}", node.span())
            return {}, {}
        context = ParseContext(Reporter(), self._rules)
        try:
            data = plain_data(parse_value(node, context, is_literal=True))
        except YamaroError as error:
            self.errors += error.diagnostics
            return {}, {}
        places = {key.text: key.span() for key, _ in node.pairs if isinstance(key, ScalarNode)}
        return {str(name): value for name, value in data.items()}, places

    def _items(self, node: YamlNode, key: str) -> list[YamlNode]:
        if isinstance(node, SequenceNode):
            return node.items
        if isinstance(node, ScalarNode) and not is_null(node.text):
            return [node]
        if isinstance(node, MappingNode):
            self._error("bad-test", f"`{key}` takes a list", node.span(), hint="begin with '- '")
        return []

    def _text(self, node: YamlNode | None, key: str) -> tuple[str, Span] | None:
        """Return a text and its place; a list or mapping is an error."""
        if node is None:
            return None
        if isinstance(node, ScalarNode) and node.text.strip():
            return node.text, node.span()
        self._error("not-a-text", f"`{key}` takes a text", node.span())
        return None

    def _entries(
        self, node: YamlNode, keys: tuple[str, ...], what: str
    ) -> dict[str, YamlNode] | None:
        """Return the values of a mapping by their keys."""
        if not isinstance(node, MappingNode):
            example = ", ".join(f"`{key}`" for key in keys[:4])
            self._error("bad-test", f"{what} has keys such as {example}", node.span())
            return None
        found: dict[str, YamlNode] = {}
        for key, value in node.pairs:
            name = key.text if isinstance(key, ScalarNode) else ""
            if name not in keys:
                hint = did_you_mean(name, list(keys)) or f"the keys are {', '.join(keys)}"
                self._error("unknown-key", f"{what} has no key '{name}'", key.span(), hint=hint)
            elif name in found:
                self._error("bad-test", f"`{name}` is given twice", key.span())
            else:
                found[name] = value
        return found

    def _error(self, code: str, message: str, span: Span, *, hint: str | None = None) -> None:
        self.errors += failure(code, message, span, hint=hint).diagnostics
