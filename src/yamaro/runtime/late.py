"""What is parsed only while a conversion runs, because only then it is known what it means.

The syntax tree stays as it is: other conversions may run it, and mean something else by the same.
"""

from __future__ import annotations

from ..diagnostics import Reporter, YamaroError
from ..syntax.context import ParseContext, Rules
from ..syntax.nodes import Argument, DynamicNode, ElementNode, RobotWordNode, Value
from ..syntax.parser import register
from ..syntax.python import PythonCode
from ..syntax.statements import parse_arguments, parse_element
from ..syntax.values import parse_value


class Late:
    """What one conversion has parsed late.

    Attributes:
        context: gathers what parsing finds.
        names_read: every name that an expression read late reads.
    """

    __slots__ = ("_calls", "_codes", "_elements", "_values", "context", "names_read")

    def __init__(self, reporter: Reporter, codes: dict[str, PythonCode], rules: Rules) -> None:
        """Report warnings to `reporter`; add Python code that defines functions to `codes`."""
        self.context = ParseContext(reporter, rules)
        self.names_read: set[str] = set()
        self._codes = codes
        self._values: dict[Argument, Value] = {}
        self._elements: dict[RobotWordNode, ElementNode] = {}
        self._calls: dict[DynamicNode, list[Argument]] = {}

    def value(self, argument: Argument) -> Value:
        """Return a capitalised argument as a value, once its parameter turned out to be no block.

        Raises:
            YamaroError: it is not a value.
        """
        value = self._values.get(argument)
        if value is None:
            assert argument.node is not None
            value = self._values[argument] = parse_value(argument.node, self.context)
            self._register()
        return value

    def call(self, dynamic: DynamicNode, name: str) -> list[Argument]:
        """Return what stands under a dynamic key as arguments, once it turned out to be a call.

        Raises:
            YamaroError: what stands there can be no arguments.
        """
        call = self._calls.get(dynamic)
        if call is None:
            call = self._calls[dynamic] = parse_arguments(name, dynamic.node, self.context)
            if self.context.errors:
                raise YamaroError(self.context.errors)
            self._register()
        return call

    def element(self, word: RobotWordNode) -> ElementNode:
        """Return a robot's word as an element, once it turned out to stand where no part may.

        Raises:
            YamaroError: what stands there can be no element.
        """
        element = self._elements.get(word)
        if element is None:
            element = self._elements[word] = parse_element(word.key, word.node, self.context)
            if self.context.errors:
                raise YamaroError(self.context.errors)
            self._register()
        return element

    def _register(self) -> None:
        for python in self.context.codes:
            register(python, codes=self._codes, names_read=self.names_read)
        self.context.codes.clear()
