"""The comments that say what a declaration is for."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Span
    from .texts import Text


def comment_on(text: Text, span: Span) -> str:
    """Return the comment on a declaration, as text, or "".

    It is in the lines right above, else at the end of the line, else in the lines right below, as
    in the body of a function.
    """
    comments = {each.location()[0]: each for each in text.parsed.comments}
    line, _ = span.location()
    above = line
    while above - 1 in comments and comments[above - 1].has_line:
        above -= 1
    if above < line:
        found = range(above, line)
    elif line in comments:
        found = range(line, line + 1)
    else:
        below = line + 1
        while below in comments and comments[below].has_line:
            below += 1
        found = range(line + 1, below)
    return "\n".join(comments[each].text.lstrip("# ") for each in found)
