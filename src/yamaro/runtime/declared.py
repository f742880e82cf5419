"""Finds where a name that is not visible at a place is declared, and why it is not visible."""

from __future__ import annotations

from ..source import Span

MAX_NOTES = 3


class Declaration:
    """One place that declares a name."""

    __slots__ = ("extent", "scope", "span")

    def __init__(self, scope: str, span: Span, extent: Span | None) -> None:
        """Describe a declaration.

        Args:
            scope: one of the five scopes, "import", or "passed" of what an include gives.
            span: its place.
            extent: all of the innermost function or block it is in, or None.
        """
        self.scope = scope
        self.span = span
        self.extent = extent

    def shares_context_with(self, span: Span) -> bool:
        """Return whether a place is in the file, and in the function or block, that this is in."""
        if self.span.source is not span.source:
            return False
        return self.extent is None or self.extent.start <= span.start < self.extent.end


def notes_on(subject: str, declarations: list[Declaration], span: Span) -> list[str]:
    """Return notes on where a name that is not known at `span` is declared.

    Args:
        subject: the name in quotes, and what it names if it is not a variable.
        declarations: all there are of that name.
        span: where it was looked up.
    """
    near_first = sorted(declarations, key=lambda one: not one.shares_context_with(span))
    return [_note(subject, declaration, span) for declaration in near_first[:MAX_NOTES]]


def _note(subject: str, declaration: Declaration, span: Span) -> str:
    place = declaration.span.place()
    if declaration.scope == "import":
        return f"{subject} is imported at {place}; each file has its own imports"
    if declaration.scope == "passed":
        return f"{subject} at {place} is passed to the file included there, and is local to it"
    if declaration.shares_context_with(span):
        if declaration.span.start > span.start:
            return f"{subject} is declared later, at {place}"
        return f"{subject} is declared at {place}, which has no effect here"
    if declaration.scope == "local":
        where = "function or block" if declaration.extent is not None else "file"
        return (
            f"{subject} at {place} is local to its {where}; "
            "declare it as parent, child or global to see it here"
        )
    return f"{subject} is declared at {place} with scope {declaration.scope}"
