"""Suggestions: what a misspelt word was probably meant to be, as a hint and as a fix.

Imported only where there is something to report.
"""

from __future__ import annotations

from .diagnostics import suggest
from .fixes import respelling

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from .fixes import Fix
    from .source import Span


def meant(
    word: str, candidates: Iterable[str], span: Span, *, is_safe: bool = False
) -> tuple[str | None, Fix | None]:
    """Return the hint "did you mean 'x'?" and the fix that writes it; None when nothing is near.

    Args:
        word: what is written somewhere in the span.
        candidates: what it could mean.
        span: the place of the diagnostic.
        is_safe: whether the candidates are all words of the language, not names of the user's.
    """
    near = suggest(word, candidates)
    if near is None:
        return None, None
    return f"did you mean '{near}'?", respelling(span, word, near, is_safe=is_safe)


def meant_word(word: str, words: Iterable[str], span: Span) -> tuple[str | None, Fix | None]:
    """Return hint and fix as `meant` does, for a word of the language: the fix is safe."""
    return meant(word, words, span, is_safe=True)
