"""What safe mode refuses, and how much it lets a file use: the error and the limits."""

from __future__ import annotations

from .expressions import InputFault

UNSAFE = "unsafe-code"
RUN_IT = "if you trust this file, leave out --safe; --jail confines all of Python"


class SafetyError(InputFault):
    """Code that safe mode refuses, or a limit that it reached.

    Attributes:
        code: "unsafe-code", or "limit-" and the name of a field of `SafeLimits`.
        construct: what is refused, in words: "the function `open`". Empty for a limit.
        position: line, column, end line and end column in the compiled text, as `ast` counts them
            (lines from 1, columns from 0 in UTF-8 bytes). None if it is all of the text, and for
            an error at run time, whose place the traceback tells.
    """

    def __init__(
        self,
        code: str,
        message: str,
        hint: str | None = None,
        *,
        construct: str = "",
        position: tuple[int, int, int, int] | None = None,
    ) -> None:
        """Hold what a diagnostic needs, and the place if it is known."""
        super().__init__(code, message, hint)
        self.construct = construct
        self.position = position


def refused(
    construct: str,
    why: str = "",
    hint: str = RUN_IT,
    *,
    position: tuple[int, int, int, int] | None = None,
) -> SafetyError:
    """Return the error for a construct, named in words that fit in front of "is not allowed"."""
    message = f"{construct} is not allowed in safe mode{': ' if why else ''}{why}"
    return SafetyError(UNSAFE, message, hint, construct=construct, position=position)


class SafeLimits:
    """How much the code of one conversion may use; each can be set."""

    __slots__ = (
        "brackets",
        "calls",
        "characters",
        "depth",
        "integer",
        "nodes",
        "sequence",
        "steps",
        "text",
        "width",
    )

    def __init__(
        self,
        *,
        characters: int = 20_000,
        brackets: int = 50,
        nodes: int = 20_000,
        depth: int = 100,
        integer: int = 4_096,
        text: int = 1_000_000,
        sequence: int = 1_000_000,
        steps: int = 50_000_000,
        calls: int = 200,
        width: int = 999,
    ) -> None:
        """Set limits.

        Args:
            characters: of one expression or process block.
            brackets: open at once.
            nodes: of one syntax tree.
            depth: of one syntax tree, and of lists in lists.
            integer: bits of a whole number.
            text: characters of a text.
            sequence: items of a list, tuple, set, dict or range.
            steps: of all code of a conversion; about the number of syntax tree nodes evaluated,
                and of items that are copied, compared or written.
            calls: of lambdas, one within the other.
            width: of a number or text in an f-string, and its digits.
        """
        self.characters = characters
        self.brackets = brackets
        self.nodes = nodes
        self.depth = depth
        self.integer = integer
        self.text = text
        self.sequence = sequence
        self.steps = steps
        self.calls = calls
        self.width = width

    def passed(
        self,
        name: str,
        message: str,
        hint: str = "",
        position: tuple[int, int, int, int] | None = None,
    ) -> SafetyError:
        """Return the error for a limit; `message` ends where "the limit is" goes on."""
        limit = f"{getattr(self, name):,}"
        way_out = f"--limit {name}=… sets another limit"
        return SafetyError(
            f"limit-{name}",
            f"{message}; the limit in safe mode is {limit}",
            f"{hint}; {way_out}" if hint else way_out,
            position=position,
        )
