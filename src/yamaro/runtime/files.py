"""The files of one conversion, with what the expressions in them see."""

from __future__ import annotations

import os

from ..diagnostics import Frame, Reporter, YamaroError, failure
from ..files.loader import LoadError
from ..files.packages import MOST_PLACES, PackageFinder
from ..source import Source, Span
from ..syntax.nodes import Document, ImportNode
from ..syntax.python import PythonCode
from .expressions import Evaluator
from .predefined import CONSTANTS, TARGET, Helpers
from .scope import Home

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType
    from typing import Any

    from ..safe.runtime import SafeRuntime
    from .declared import Declaration
    from .late import Late
    from .library import Library
    from .modules import LocalModules

_SAFE_HELPERS = ("load_yaml", "find", "file_dir", "dirname", "target")
"""The helpers that are left in safe mode."""


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
            from .late import Late

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
        from .declared import Declaration

        return [
            Declaration(scope, span, document.extent_around(span))
            for document in self._documents.values()
            for declared, scope, span in document.declarations
            if declared == name
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
        names = {**CONSTANTS, **helpers, "print": self._print}
        names["__import__"] = self._import_hook(directory)
        return Home(source, directory, names, frame)

    def import_modules(self, document: Document, home: Home, evaluator: Evaluator) -> None:
        """Bind the names of a file's imports; raise YamaroError if one fails."""
        if not document.imports:
            return
        if self._safety is not None:
            self._import_safely(document, home, evaluator, self._safety)
            return
        from .modules import import_names

        modules = self._modules_in(home.directory)

        def load(node: ImportNode) -> dict[str, Any]:
            return import_names(node, modules)

        for node in document.imports:
            home.names.update(evaluator.guard(load, node, node.span))

    def _import_safely(
        self, document: Document, home: Home, evaluator: Evaluator, safety: SafeRuntime
    ) -> None:
        """Bind the substitutes for the modules a file imports, if it may import them."""
        from .modules import import_safe_names

        modules = self._modules_in(home.directory)

        def load(node: ImportNode) -> dict[str, Any]:
            return import_safe_names(node, modules, safety)

        for node in document.imports:
            home.names.update(evaluator.guard(load, node, node.span))

    def _import_hook(self, directory: str) -> Callable[..., ModuleType]:
        """Return what replaces `__import__`: few files import anything."""

        def import_hook(*asked: Any, **named: Any) -> ModuleType:
            return self._modules_in(directory).import_hook(*asked, **named)

        return import_hook

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
            name = _shown_name(path, absolute, home.source)
            source = self._library.source(absolute, name)
        except LoadError as error:
            neighbours = self._library.loader.neighbours(absolute)
            likely = [name for name in neighbours if name.endswith((".yaml", ".yml"))]
            from ..suggestions import meant

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


def _shown_name(path: str, absolute: str, includer: Source) -> str:
    """Return the name to show for an included file: relative as the includer's is."""
    if "://" in path or os.path.isabs(path) or path.startswith("~"):
        return absolute
    return os.path.normpath(os.path.join(os.path.dirname(includer.name), path))
