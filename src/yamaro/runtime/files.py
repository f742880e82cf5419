"""Files of a program, read and parsed once; files of one conversion, with the names they see."""

from __future__ import annotations

import os

from ..diagnostics import Frame, Reporter, YamaroError, failure
from ..files.loader import LoadError, decode
from ..files.packages import MOST_PLACES, PackageFinder
from ..source import Source, Span, holds_xml
from ..syntax.context import ParseContext, Rules
from ..syntax.nodes import (
    Argument,
    Document,
    DynamicNode,
    ElementNode,
    ImportNode,
    RobotWordNode,
    Value,
)
from ..syntax.parser import parse, register
from ..syntax.python import PythonCode
from ..syntax.statements import parse_arguments, parse_element
from ..syntax.values import parse_value
from .expressions import Evaluator
from .predefined import CONSTANTS, TARGET, Helpers
from .scope import Home

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType, ModuleType
    from typing import Any

    from ..files.loader import Loader
    from ..policy import Policy
    from ..safe.runtime import SafeRuntime
    from ..syntax.nodes import Parsed
    from ..syntax.symbol_table import Declaration
    from .modules import LocalModules

_SAFE_HELPERS = ("load_yaml", "find", "file_dir", "dirname", "target")
"""The helpers that are left in safe mode."""


# --- the files of a program -------------------------------------------------------------------


class Library:
    """Reads and parses files, and remembers the result.

    Nothing in it changes once it is there, so that conversions may run one after the other or at
    once, in several threads: at worst two of them parse the same file. What could not be read or
    has errors is not remembered.

    Attributes:
        loader: gives the text of files.
        rules: what holds for the files; by default that of trusted ones.
        modules: the code of Python modules by their paths.
    """

    __slots__ = ("_parsed", "_texts", "loader", "modules", "rules")

    def __init__(self, loader: Loader, rules: Rules | None = None) -> None:
        """Begin without files."""
        self.loader = loader
        self.rules = rules or Rules()
        self.modules: dict[str, CodeType] = {}
        self._texts: dict[str, str] = {}
        self._parsed: dict[tuple[str, str], Parsed] = {}

    def source(self, path: str, name: str, *, is_xml: bool = False) -> Source:
        """Return a file, which is marked if it holds XML, and so says itself how it is encoded.

        Args:
            path: where it is, absolute.
            name: what it is called in messages.
            is_xml: it holds XML, whatever it is called.

        Raises:
            LoadError: it cannot be read.
            YamaroError: it is not text in its encoding.
        """
        text = self._texts.get(path)
        if text is not None:
            source = Source(text, name=name, path=path)
            source.is_xml = is_xml or holds_xml(path, text)
            return source
        data = self.loader.read(path)
        if is_xml or holds_xml(path, data):
            from ..xml.reader import decode_xml

            source = decode_xml(data, name=name, path=path)
            source.is_xml = True
        else:
            source = decode(data, name=name, path=path)
        self._texts[path] = source.text
        return source

    def parse(self, source: Source, *, reporter: Reporter) -> Document:
        """Return the syntax tree of a file; every call reports its warnings.

        Raises:
            YamaroError: the file has errors.
        """
        key = (source.path, source.name)
        if key not in self._parsed:
            parsed = parse(source, rules=self.rules)
            if parsed.errors:
                for warning in parsed.warnings:
                    reporter.add(warning)
                raise YamaroError(parsed.errors)
            self._parsed[key] = parsed
        parsed = self._parsed[key]
        for warning in parsed.warnings:
            reporter.add(warning.copy())  # the caller's own: a strict build makes it an error
        return parsed.document


def rules_of(policy: Policy) -> Rules:
    """Return what holds for the files that are compiled under a policy."""
    if not policy.is_safe:
        return Rules(policy.limits)
    from ..safe.code import compile_safe
    from ..safe.limits import SafeLimits

    limits = SafeLimits.of(policy.limits)

    def compile(text: str, filename: str, mode: str) -> CodeType:
        return compile_safe(text, filename, mode, limits)

    return Rules(policy.limits, compile)


# --- what is parsed only while a conversion runs ----------------------------------------------


class Late:
    """Statements that one conversion parses late: only while it runs their meaning is known.

    The syntax tree stays as it is: other conversions may run it, and mean something else by the
    same.

    Attributes:
        context: gathers what parsing finds.
        names_read: every name that an expression read late reads.
    """

    __slots__ = ("_calls", "_codes", "_elements", "_values", "context", "names_read")

    def __init__(self, reporter: Reporter, codes: dict[str, PythonCode], rules: Rules) -> None:
        """Report warnings to `reporter`; add Python code that defines functions to `codes`."""
        self.context = ParseContext(reporter, rules)
        self.names_read: set[str] = set()
        self._codes = codes
        self._values: dict[Argument, Value] = {}
        self._elements: dict[RobotWordNode, ElementNode] = {}
        self._calls: dict[DynamicNode, list[Argument]] = {}

    def value(self, argument: Argument) -> Value:
        """Return a capitalised argument as a value, once its parameter turned out to be no block.

        Raises:
            YamaroError: it is not a value.
        """
        value = self._values.get(argument)
        if value is None:
            assert argument.node is not None
            value = self._values[argument] = parse_value(argument.node, self.context)
            self._register()
        return value

    def call(self, dynamic: DynamicNode, name: str) -> list[Argument]:
        """Return what stands under a dynamic key as arguments, once it turned out to be a call.

        Raises:
            YamaroError: what stands there can be no arguments.
        """
        call = self._calls.get(dynamic)
        if call is None:
            call = self._calls[dynamic] = parse_arguments(name, dynamic.node, self.context)
            if self.context.errors:
                raise YamaroError(self.context.errors)
            self._register()
        return call

    def element(self, word: RobotWordNode) -> ElementNode:
        """Return a robot's word as an element, once it turned out to stand where no part may.

        Raises:
            YamaroError: what stands there can be no element.
        """
        element = self._elements.get(word)
        if element is None:
            element = self._elements[word] = parse_element(word.key, word.node, self.context)
            if self.context.errors:
                raise YamaroError(self.context.errors)
            self._register()
        return element

    def _register(self) -> None:
        for python in self.context.codes:
            register(python, codes=self._codes, names_read=self.names_read)
        self.context.codes.clear()


# --- the files of one conversion --------------------------------------------------------------


class Files:
    """Loads files and gives them their imports and predefined names.

    Attributes:
        read: the absolute path of every file read, in order, as the keys of a dict.
        codes: the Python code in all files that defines functions, by its file name.
    """

    __slots__ = (
        "_documents",
        "_late",
        "_library",
        "_loads",
        "_modules",
        "_print",
        "_reporter",
        "_safety",
        "_target",
        "codes",
        "packages",
        "read",
    )

    def __init__(
        self,
        library: Library,
        *,
        reporter: Reporter,
        print_function: Callable[..., None],
        safety: SafeRuntime | None,
        packages: PackageFinder,
        target: str = TARGET,
    ) -> None:
        """Begin without files.

        Args:
            library: reads and parses files.
            reporter: takes the warnings of parsing.
            print_function: replaces Python's `print`.
            safety: runs the expressions if they are to be safe.
            packages: finds ROS packages.
            target: the output format that is written.
        """
        self._library = library
        self._reporter = reporter
        self._print = print_function
        self._safety = safety
        self._loads = 0
        self._target = target
        self._documents: dict[str, Document] = {}
        self._modules: dict[str, LocalModules] = {}
        self.packages = packages
        self.read: dict[str, None] = {}
        self.codes: dict[str, PythonCode] = {}
        self._late: Late | None = None

    @property
    def late(self) -> Late:
        """Return what parses what can be parsed only while the program runs."""
        if self._late is None:
            self._late = Late(self._reporter, self.codes, self._library.rules)
        return self._late

    @property
    def documents(self) -> list[Document]:
        """Return the files parsed so far."""
        return list(self._documents.values())

    def close(self) -> None:
        """Forget the Python modules that were loaded from beside the files."""
        for modules in self._modules.values():
            modules.close()

    def parse(self, source: Source) -> Document:
        """Return the syntax tree of a file; raise YamaroError if it has errors."""
        key = source.path or source.name
        document = self._documents.get(key)
        if document is None:
            self.note(key)
            document = self._library.parse(source, reporter=self._reporter)
            self._documents[key] = document
            self.codes.update(document.codes)
        return document

    def note(self, path: str) -> None:
        """Note that a file was read."""
        self.read.setdefault(path)

    def names_read(self) -> set[str]:
        """Return every name that an expression in the files reads."""
        late = self._late.names_read if self._late else set()
        return late.union(*(each.names_read for each in self.documents))

    def where_declared(self, name: str) -> list[Declaration]:
        """Return every declaration of a name, in any file."""
        return [
            each
            for document in self._documents.values()
            for each in document.symbols.where_declared(name)
        ]

    def begin(self, document: Document, frame: Frame | None) -> Home:
        """Return what expressions see in a run of a file, except for its imports."""
        source = document.source
        directory = os.path.dirname(source.path) if source.path else os.getcwd()
        helpers = Helpers(
            directory, self._library, self.packages, self.note, target=self._target
        ).names()
        if self._safety is not None:
            kept = {name: helpers[name] for name in _SAFE_HELPERS}
            return Home(source, directory, self._safety.names(kept), frame)

        def import_hook(*asked: Any, **named: Any) -> ModuleType:  # few files import anything
            return self._modules_in(directory).import_hook(*asked, **named)

        names = {**CONSTANTS, **helpers, "print": self._print, "__import__": import_hook}
        return Home(source, directory, names, frame)

    def import_modules(self, document: Document, home: Home, evaluator: Evaluator) -> None:
        """Bind the names of a file's imports, in safe mode those of substitutes for modules.

        Raises:
            YamaroError: one fails, or may not be imported.
        """
        if not document.imports:
            return
        from .modules import import_names, import_safe_names

        modules, safety = self._modules_in(home.directory), self._safety

        def load(node: ImportNode) -> dict[str, Any]:
            if safety is None:
                return import_names(node, modules)
            return import_safe_names(node, modules, safety)

        for node in document.imports:
            home.names.update(evaluator.guard(load, node, node.span))

    def _modules_in(self, directory: str) -> LocalModules:
        if directory not in self._modules:
            from .modules import LocalModules

            self._modules[directory] = LocalModules(directory, self._library.modules, self.note)
        return self._modules[directory]

    def load(self, path: str, span: Span, home: Home) -> Source:
        """Return the source of the file that `path` means in a file.

        Args:
            path: relative to that file, or with `~`, `package://` or `file://`.
            span: where the path is written.
            home: the file it is written in.

        Raises:
            YamaroError: the file does not exist or package, or it is not text in its encoding.
        """
        resolved = self.packages.resolve_uri(path, home.directory, span)
        if resolved is None:
            raise self._unknown_package(path, span, home)
        absolute = os.path.normpath(resolved)
        self._count(span)
        known = self._documents.get(absolute)
        if known is not None:
            return known.source
        try:
            name = absolute
            if "://" not in path and not os.path.isabs(path) and not path.startswith("~"):
                folder = os.path.dirname(home.source.name)  # relative, as the includer's name is
                name = os.path.normpath(os.path.join(folder, path))
            source = self._library.source(absolute, name)
        except LoadError as error:
            neighbours = self._library.loader.neighbours(absolute)
            likely = [name for name in neighbours if name.endswith((".yaml", ".yml"))]
            from ..diagnostics import meant

            hint, fix = meant(os.path.basename(absolute), likely or neighbours, span)
            raise failure(
                error.code,
                f"the file '{path}' cannot be included: {error}",
                span,
                hint=error.hint or hint,
                fix=None if error.hint else fix,
                notes=[f"searched for {absolute}"],
            ) from None
        self.note(absolute)
        return source

    def read_xml(self, path: str, name: str, span: Span) -> Source:
        """Return the source of an XML file that another one includes.

        Args:
            path: where it is, absolute.
            name: what it is called in messages.
            span: where it is included.

        Raises:
            LoadError: it cannot be read.
            YamaroError: it is not in the encoding that it says, or one file too many.
        """
        self._count(span)
        source = self._library.source(path, name, is_xml=True)
        self.note(path)
        return source

    def read_given(self, path: str, name: str) -> Source:
        """Return the source of a file that the build was asked for with.

        Raises:
            LoadError: it cannot be read.
            YamaroError: it is not text in its encoding.
        """
        source = self._library.source(path, name)
        self.note(path)
        return source

    def neighbours(self, path: str) -> list[str]:
        """Return the names of the files in the folder of `path`."""
        return self._library.loader.neighbours(path)

    def _count(self, span: Span) -> None:
        limits = self._library.rules.limits
        self._loads += 1
        if self._loads > limits.files:
            raise failure(
                "limit-files",
                f"more than {limits.files:,} files are included, which is the limit",
                span,
                hint=limits.hint("files"),
            )

    def _unknown_package(self, path: str, span: Span, home: Home) -> YamaroError:
        """Return the error for a URI that leads nowhere."""
        scheme = path.partition("://")[0]
        if scheme.lower() not in ("package", "model"):
            return failure(
                "missing-file",
                f"'{scheme}://' cannot be included: files are not downloaded",
                span,
                hint="save the file locally and include it with a path or package://",
            )
        return self.unknown_package(
            path.partition("://")[2].partition("/")[0], span, home.directory
        )

    def unknown_package(self, package: str, span: Span, start: str) -> YamaroError:
        """Return the error for a package that is nowhere around the folder `start`."""
        places = self.packages.looked_at(package, start)
        return failure(
            "unknown-package",
            f"the package '{package}' is not found",
            span,
            hint=self.packages.hint_for(package, start),
            notes=[f"searched in {place}" for place in places[:MOST_PLACES]],
        )
