"""The macros and arguments of a robot in xacro."""

from __future__ import annotations

from ....xacro.statements import Parameter, parse_parameters
from ....xml.tree import Element
from ....xml.values import format_value
from .names import names_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ....source import Span


class Macro:
    """A macro and the function it becomes.

    Attributes:
        name, function: what they are called.
        parameters: of the macro.
        file: the path of the file it is defined in.
        element: its tag.
        from_caller: the names in defaults of its parameters that only its callers have.
    """

    def __init__(self, element: Element, file: str, function: str) -> None:
        """Read its name and parameters."""
        self.element = element
        self.name = format_value(element.attributes.get("name")).removeprefix("xacro:")
        self.parameters: list[Parameter] = [
            own
            for own in parse_parameters(format_value(element.attributes.get("params", "")))
            if not own.name[:1].isdigit()  # nothing can read it, and no call can give it
        ]
        self.file = file
        self.function = function
        self.from_caller: set[str] = set()

    def values(self) -> list[str]:
        """Return the names of the parameters that are values."""
        return [own.name for own in self.parameters if not own.is_block]

    def is_default_of_caller(self, own: Parameter) -> bool:
        """Return whether a default reads a property of the caller."""
        return bool(names_in(own.default or "") & {*self.values(), *self.from_caller})

    def blocks(self) -> list[str]:
        """Return the names of the parameters that are blocks, with their stars."""
        return [own.name for own in self.parameters if own.is_block]


class Argument:
    """An argument of a robot.

    Attributes:
        span: where it is declared first.
        remark: the comments above that.
        ending: those at the end of its line.
        defaults: what it is if it is not given; several, if it is not known which counts.
        made_of: the names that its defaults read.
    """

    __slots__ = ("defaults", "ending", "made_of", "remark", "span")

    def __init__(self, span: Span, remark: str) -> None:
        self.span = span
        self.remark = remark
        self.ending = ""
        self.defaults: list[str] = []
        self.made_of: set[str] = set()

    def add(self, default: str) -> None:
        """Note a default."""
        if default not in self.defaults:
            self.defaults.append(default)
            self.made_of |= names_in(default)

    def settle(self, default: object) -> None:
        """Say which default counts, if the first declaration has one."""
        if default is not None:
            self.defaults = [format_value(default)]
            self.made_of = names_in(self.defaults[0])

    @property
    def default(self) -> str:
        """Return the default, if there is one that counts."""
        return self.defaults[0] if self.defaults else ""
