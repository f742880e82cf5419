"""`Parsed`: what a parse gives, whether or not the file has errors."""

from __future__ import annotations

from ..diagnostics import YamaroError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..diagnostics import Diagnostic
    from ..source import Span
    from ..yaml.comments import Comment
    from .document import Document


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
