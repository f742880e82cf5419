"""A parsed file: its sections, what is known of it as a whole, and what is wrong in it."""

from __future__ import annotations

from ..diagnostics import YamaroError
from ..source import Source, Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..diagnostics import Diagnostic
    from ..yaml.comments import Comment
    from ..yaml.nodes import ScalarNode, YamlNode
    from .argument_types import ArgumentEntry
    from .nodes import Body, ElementNode, FunctionNode, Statement, TextContent
    from .python import PythonCode


class ImportNode:
    """One module to import, or names of one."""

    __slots__ = ("alias", "hint", "module", "names", "span")

    def __init__(
        self, module: str, alias: str | None, names: list[tuple[str, str]] | None, span: Span
    ) -> None:
        """Describe an import.

        Args:
            module: its dotted name.
            alias: the name in `import module as alias`.
            names: for `from module import …`, each name and what it is called here.
            span: the place.
        """
        self.module = module
        self.alias = alias
        self.names = names
        self.span = span
        self.hint: str | None = None  # what was probably meant, if there is no such module


class Document:
    """A parsed file."""

    __slots__ = (
        "argument_spans",
        "arguments",
        "bare_keys",
        "codes",
        "declarations",
        "extents",
        "functions",
        "imports",
        "is_lone_section",
        "model",
        "model_span",
        "names_read",
        "robot_name",
        "root",
        "sections",
        "source",
    )

    def __init__(self, source: Source) -> None:
        """Start an empty document.

        Attributes:
            arguments: what may be passed to the file, or None if it does not say.
            argument_spans: where each of them is declared.
            bare_keys: the first element of each name without attributes: its key and content.
            functions: those that are defined in it, also inside others.
            imports: the modules, in order.
            sections: the other sections but the model, in order.
            model: the bodies of the `model:` sections, in order.
            model_span: where `model:` stands first, or None without one.
            root: the root element written in place of `model`, if there is one.
            is_lone_section: whether the root element is a section of a robot in an included file.
            robot_name: what follows `robot:`.
            codes: Python code by its file name, to find the place of an error in a function.
            declarations: every name declared, with the scope and place.
            extents: the place of each function or block with its body; inner ones come first.
            names_read: every name that some expression reads.
        """
        self.source = source
        self.arguments: list[ArgumentEntry] | None = None
        self.argument_spans: dict[str, Span] = {}
        self.imports: list[ImportNode] = []
        self.sections: list[Statement] = []
        self.model: list[Body] = []
        self.model_span: Span | None = None
        self.root: ElementNode | None = None
        self.is_lone_section = False
        self.robot_name: TextContent | None = None
        self.codes: dict[str, PythonCode] = {}
        self.declarations: list[tuple[str, str, Span]] = []
        self.extents: list[Span] = []
        self.functions: list[FunctionNode] = []
        self.bare_keys: dict[str, tuple[ScalarNode, YamlNode]] = {}
        self.names_read: set[str] = set()

    def extent_around(self, span: Span) -> Span | None:
        """Return all of the innermost function or block that a place is in, or None."""
        for extent in self.extents:
            if extent.start <= span.start < extent.end:
                return extent
        return None


class Parsed:
    """A file as far as it could be parsed, and all that is to be said of it unrun.

    Attributes:
        document: the syntax tree, without what is faulty.
        errors: what is not YAML comes first, since it hides other things; then in order of place.
        warnings: in order of place.
        hidden: the stretches that were not read because of errors; what is missing may be there.
    """

    __slots__ = ("_comments", "_text", "document", "errors", "hidden", "warnings")

    def __init__(
        self,
        document: Document,
        *,
        errors: Sequence[Diagnostic],
        warnings: Sequence[Diagnostic],
        hidden: Sequence[Span],
        text: str,
    ) -> None:
        """Hold the results; `text` is the file's, with blanks in place of what is hidden."""
        self.document = document
        self.errors = errors
        self.warnings = warnings
        self.hidden = hidden
        self._text = text
        self._comments: list[Comment] | None = None

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """Return errors and warnings in order of place."""
        return sorted([*self.errors, *self.warnings], key=lambda found: found.span.start)

    @property
    def comments(self) -> list[Comment]:
        """Return the comments in order; they are gathered when they are first asked for."""
        if self._comments is None:
            from ..yaml.comments import find_comments

            self._comments = find_comments(self.document.source, self._text)
        return self._comments

    def require(self) -> Document:
        """Return the document.

        Raises:
            YamaroError: the file has errors.
        """
        if self.errors:
            raise YamaroError(self.errors)
        return self.document
