"""Which expressions of xacro may give a truth value, where no run has shown it.

In a text, xacro writes such a value as Python does, `True`, and the language as XML does, `true`.
"""

from __future__ import annotations

import re

from ....xacro.statements import parse_parameters
from ....xacro.templates import guess_value
from ....xml.tree import Element
from ....xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast
    from collections.abc import Iterable, Iterator


_FLAG = re.compile(r"\$\(optenv\s+\w+\s+(?:0|1|true|false|True|False)\s*\)")


class Truths:
    """Knows the names that may have a truth value, anywhere in a robot.

    Attributes:
        names: those of properties and parameters.
        flags: those of them that the environment may set, where another number is usual.
    """

    def __init__(self, roots: Iterable[Element], arguments: Iterable[str]) -> None:
        """Look at all that gives a name a value; `arguments` are those that are true or false."""
        self._arguments = {f"$(arg {name})" for name in arguments}
        self.names: set[str] = set()
        self.flags: set[str] = set()
        given = [pair for root in roots for pair in _given_in(root)]
        count = -1
        while len(self.names) > count:
            count = len(self.names)
            given = [(name, text) for name, text in given if not self._note(name, text)]

    def _note(self, name: str, text: str) -> bool:
        text = text.strip()
        is_truth = isinstance(guess_value(text), bool) or text in self._arguments
        if not is_truth and text.startswith("${") and text.find("}") == len(text) - 1:
            is_truth = self.may_give(text[2:-1])
        if _FLAG.fullmatch(text) or (text[:2] == "${" and text[2:-1].strip() in self.flags):
            self.flags.add(name)
            is_truth = True
        if is_truth:
            self.names.add(name)
        return is_truth

    def may_give(self, expression: str) -> bool:
        """Return whether an expression may give a truth value."""
        import ast

        try:
            return self._may_be(ast.parse(expression.strip(), mode="eval").body)
        except (SyntaxError, ValueError):
            return False

    def _may_be(self, node: ast.expr) -> bool:
        import ast

        match node:
            case ast.Name(name):
                return name in self.names
            case ast.Constant(value):
                return isinstance(value, bool)
            case ast.Compare() | ast.UnaryOp(ast.Not()):
                return True
            case ast.BoolOp(_, values):
                return any(map(self._may_be, values))
            case ast.IfExp(_, first, second):
                return self._may_be(first) or self._may_be(second)
        return False


def _given_in(root: Element) -> Iterator[tuple[str, str]]:
    """Return the names that properties, calls and defaults give values, with their texts."""
    for element in root.iter():
        given = {name: format_value(value) for name, value in element.attributes.items()}
        if element.name == "xacro:property":
            yield given.get("name", ""), given.get("value", given.get("default", ""))
        elif element.name == "xacro:macro":
            for own in parse_parameters(given.get("params", "")):
                yield own.name, own.default or ""
        elif element.name.startswith("xacro:"):
            yield from given.items()
