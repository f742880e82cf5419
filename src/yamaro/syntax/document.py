"""A parsed file: its sections, and what is known of it as a whole."""

from __future__ import annotations

from ..source import Source, Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .argument_types import ArgumentEntry
    from .nodes import Body, ElementNode, Statement, TextContent
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
        "arguments",
        "codes",
        "declarations",
        "extents",
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
        self.names_read: set[str] = set()

    def extent_around(self, span: Span) -> Span | None:
        """Return all of the innermost function or block that a place is in, or None."""
        for extent in self.extents:
            if extent.start <= span.start < extent.end:
                return extent
        return None
