"""Evaluates values: those of variables, arguments and attributes, and those in texts."""

from __future__ import annotations

from ..source import Span
from ..syntax.nodes import Constant, DictValue, ListValue, Value
from ..syntax.python import Template
from ..xml.values import format_number, format_value, is_number, plain_value
from .expressions import Evaluator
from .predefined import gather_pairs
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, TypeGuard


ALWAYS_WRITABLE = frozenset((str, float, bool, type(None)))
SHORT = 10**15
"""Python refuses to write integers of thousands of digits; those below this it never does."""


def is_writable(value: Any) -> bool:
    """Return whether writing a value cannot fail."""
    kind = type(value)
    return kind in ALWAYS_WRITABLE or (kind is int and -SHORT < value < SHORT)


class Values:
    """Gives the Python objects that the syntax tree's values describe."""

    __slots__ = ("evaluator",)

    def __init__(self, evaluator: Evaluator) -> None:
        """Evaluate expressions with `evaluator`."""
        self.evaluator = evaluator

    def value(self, value: Value, scope: Scope) -> Any:
        """Return the object a value describes; lists and dicts are new each time."""
        kind = type(value)
        if kind is Constant:
            return value.value  # type: ignore[union-attr]
        if kind is Template:
            return self.text(value, scope)  # type: ignore[arg-type]
        if isinstance(value, ListValue):
            return self.list_of(value, scope)
        return self._dict_of(value, scope)  # type: ignore[arg-type]

    def list_of(self, value: ListValue, scope: Scope) -> list[Any]:
        """Return the objects in a list."""
        return [self.value(item, scope) for item in value.items]

    def spelled_list(self, value: ListValue, scope: Scope) -> list[Any]:
        """Return the objects in a list that is only passed on: its numbers keep their spelling."""
        return [
            item.node.text if _is_number(item) else self.value(item, scope) for item in value.items
        ]

    def _dict_of(self, value: DictValue, scope: Scope) -> dict[Any, Any]:
        pairs = []
        for key_value, item in value.pairs:
            key = self.value(key_value, scope)
            if isinstance(key_value, Template) and (key is None or key == ""):
                continue
            self.evaluator.guard(self.evaluator.hash, key, span_of(key_value))
            pairs.append((key, self.value(item, scope)))
        return gather_pairs(pairs)

    def text(self, value: str | Template, scope: Scope) -> Any:
        """Return a text as written, the typed value of a single `$(…)`, or the parts joined."""
        if isinstance(value, str):
            return value
        if value.only is not None:
            return self.evaluator.evaluate(value.only, scope)
        return self.joined(value, scope)

    def written(self, value: str | Template, scope: Scope) -> Any:
        """Return what `text` does, sure that it can be written: any `__str__` may fail."""
        if isinstance(value, str):
            return value
        if value.only is None:
            return self.joined(value, scope)
        result = self.evaluator.evaluate(value.only, scope)
        if type(result) is str:
            if len(result) > self.evaluator.limits.text:
                raise self.evaluator.too_long(result, value.only.span())
        elif type(result) not in ALWAYS_WRITABLE and not is_writable(result):
            self.evaluator.text(format_value, result, value.only.span())
        return result

    def joined(self, template: Template, scope: Scope) -> str:
        """Return the parts of a template as one text, as in a key."""
        evaluate = self.evaluator.evaluate
        pieces = []
        for part in template.parts:
            if type(part) is str:
                pieces.append(part)
                continue
            assert not isinstance(part, str)
            value = evaluate(part, scope)
            kind = type(value)
            if kind is str:
                pieces.append(value)
            elif kind is float:
                pieces.append(format_number(value))
            elif value is None and template.only is None:
                pieces.append("None")
            elif is_writable(value):
                pieces.append(format_value(value))
            else:
                pieces.append(self.evaluator.text(format_value, value, part.span()))
        text = "".join(pieces)
        if len(text) > self.evaluator.limits.text:
            raise self.evaluator.too_long(text, template.span())
        return text

    def message(self, value: str | Template | Value, scope: Scope, span: Span) -> str:
        """Return the text of a `print`."""
        if isinstance(value, str):
            return value
        if not isinstance(value, Template):
            return self.evaluator.text(print_text, self.value(value, scope), span)
        pieces = []
        for part in value.parts:
            if isinstance(part, str):
                pieces.append(part)
            else:
                result = self.evaluator.evaluate(part, scope)
                pieces.append(self.evaluator.text(print_text, result, part.span()))
        return "".join(pieces)


def print_text(value: Any) -> str:
    """Return the text of a value in `print`: floats as in XML, all else as Python shows it."""
    plain = plain_value(value)
    return format_value(plain) if type(plain) is float else str(plain)


def _is_number(value: Value) -> TypeGuard[Constant]:
    """Return whether a value is a number as the text has it."""
    return isinstance(value, Constant) and is_number(value.value)


def span_of(value: Value) -> Span:
    """Return where a value is written."""
    if isinstance(value, Constant):
        return value.node.span()
    return value.span() if isinstance(value, Template) else value.span
