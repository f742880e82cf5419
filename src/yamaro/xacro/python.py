"""Evaluates Python in xacro files: the only module that calls `eval` for them."""

from __future__ import annotations

from keyword import iskeyword

from ..syntax.powers import compile_bounded
from .faults import Fault

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import CodeType
    from typing import Any

    from ..policy import Limits
    from .substitutions import EvalNames


_TRUTHS = ("True", "False")  # words of Python and predefined names alike


class Python:
    """Evaluates expressions, each of which is compiled once."""

    __slots__ = ("_codes", "_limits")

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._codes: dict[str, str | CodeType] = {}

    def evaluate(self, text: str, names: dict[str, Any]) -> Any:
        """Return the value of an expression; `names` has no `__builtins__` but its own.

        Raises:
            Fault: the text uses names that begin with `__`.
            Exception: whatever Python raises.
        """
        code = self._codes.get(text)
        if code is None:
            code = self._codes[text] = self._compile(text)
        if type(code) is str:
            try:
                return names[code]
            except KeyError:
                raise NameError(f"name '{code}' is not defined", name=code) from None
        return eval(code, names)

    def evaluate_in(self, text: str, names: EvalNames) -> Any:
        """Return the value of what follows `$(eval`; raises what `evaluate` raises."""
        if "__" in text:
            at = text.find("__")
            raise Fault(
                "xacro-unsafe",
                "what follows $(eval must not have '__' in it",
                start=at,
                end=at + 2,
            )
        code = compile_bounded(text, "<expression>", "eval", self._limits)
        return eval(code, {"__builtins__": {}}, names)  # type: ignore[arg-type]

    def _compile(self, text: str) -> str | CodeType:
        """Return code, or the name that is all of the expression."""
        stripped = text.strip()
        if is_plain_name(stripped):
            return stripped
        code = compile_bounded(stripped, "<expression>", "eval", self._limits)
        for name in _names_in(code):
            if name.startswith("__"):
                start = max(text.find(name), 0)
                raise Fault(
                    "xacro-unsafe",
                    f"'{name}' begins with '__', which xacro does not allow",
                    start=start,
                    end=start + len(name),
                )
        return code


def is_plain_name(text: str) -> bool:
    """Return whether an expression is a name, and no word of Python."""
    if not text.isidentifier() or not text.isascii() or text.startswith("__"):
        return False
    return text in _TRUTHS or not iskeyword(text)


def _names_in(code: CodeType) -> Iterator[str]:
    """Return the names that code uses, with that of the functions in it."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, type(code)):
            yield from _names_in(constant)
