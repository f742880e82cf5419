"""Explains text that is not YAML: where it went wrong and how to spell what was meant."""

from __future__ import annotations

from ..diagnostics import failure
from .characters import first_control_character
from .explanations import EXPLANATIONS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, NoReturn

    from .quotes import GivenText


def refuse_yaml(error: Any, given: GivenText) -> NoReturn:
    """Raise the YamaroError that explains an error of the YAML parser."""
    problem = str(getattr(error, "problem", None) or getattr(error, "reason", None) or error)
    mark = getattr(error, "problem_mark", None)
    if mark is None:
        at = first_control_character(given.text)
        raise failure(
            "control-character",
            f"the character U+{ord(given.text[at]):04X} is not allowed in a YAML file"
            if at < len(given.text)
            else f"the file cannot be read as YAML: {problem}",
            given.span(at, at + 1),
            hint="delete this invisible character",
        )
    context = str(getattr(error, "context", None) or "")
    context_mark = getattr(error, "context_mark", None)
    begin = context_mark.index if context_mark is not None else mark.index
    for explain in EXPLANATIONS:
        found = explain(given, problem, context, begin, mark.index)
        if found is not None:
            raise found
    raise failure(
        "yaml-syntax",
        f"this is not YAML: {problem}",
        given.span(mark.index, mark.index + 1),
        hint="compare the indentation with the lines above and below",
    )
