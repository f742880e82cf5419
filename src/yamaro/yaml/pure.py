"""PyYAML's parser in Python, made to agree with libyaml, for where that is not: in a browser.

The two differ in few places, and libyaml is right in each: tabs, a `?` or `:` in flow collections,
directives that do not exist, and escapes of what is not a character.
"""

from __future__ import annotations

import re

import yaml
from yaml.scanner import ScannerError
from yaml.tokens import ScalarToken

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_ESCAPE = re.compile(r"\\(?:u([0-9A-Fa-f]{4})|U([0-9A-Fa-f]{8})|.)", re.DOTALL)
_BREAKS = "\r\n\x85\u2028\u2029"
_LINE_ENDS = "\0" + _BREAKS
_BLANKS = " \t" + _LINE_ENDS


class PureParser(yaml.SafeLoader):
    """PyYAML's own parser."""

    def scan_to_next_token(self) -> None:
        """Skip spaces, comments and line breaks, and tabs where no key can begin."""
        if self.index == 0 and self.peek() == "\ufeff":
            self.forward()
        while True:
            while self.peek() == " " or (
                self.peek() == "\t" and (bool(self.flow_level) or not self.allow_simple_key)
            ):
                self.forward()
            if self.peek() == "#":
                while self.peek() not in _LINE_ENDS:
                    self.forward()
            if not self.scan_line_break():  # type: ignore[no-untyped-call]
                return
            if not self.flow_level:
                self.allow_simple_key = True

    def scan_plain(self) -> Any:
        """Return the token of a text without quotes."""
        start = end = self.get_mark()
        indent = self.indent + 1
        pieces: list[str] = []
        between = ""
        while self.peek() != "#" and (length := self._length_of_word(start)):
            self.allow_simple_key = False
            pieces += (between, self.prefix(length))
            self.forward(length)
            end = self.get_mark()
            between = self._skip_between_words(indent, start)
            if not between or (not self.flow_level and self.column < indent):
                break
        return ScalarToken("".join(pieces), True, start, end)

    def _length_of_word(self, start: Any) -> int:
        length = 0
        while (char := self.peek(length)) not in _BLANKS:
            after = self.peek(length + 1)
            if self.flow_level and char == ":" and after in ",?[]{}":
                self.forward(length)
                raise ScannerError(
                    "while scanning a plain scalar", start, "found unexpected ':'", self.get_mark()
                )
            if (char == ":" and after in _BLANKS) or (self.flow_level and char in ",[]{}"):
                break
            length += 1
        return length

    def _skip_between_words(self, indent: int, start: Any) -> str:
        """Skip blanks and line breaks, and return what they mean; "" where the text has ended."""
        blanks, breaks = "", []
        while self.peek() not in "\0" and self.peek() in _BLANKS:
            char = self.peek()
            if char in _BREAKS:
                breaks.append(self.scan_line_break())  # type: ignore[no-untyped-call]
                self.allow_simple_key = True
                if self.prefix(3) in ("---", "...") and self.peek(3) in _BLANKS:
                    return ""
                continue
            if breaks and char == "\t" and self.column < indent:
                raise ScannerError(
                    "while scanning a plain scalar",
                    start,
                    "found a tab character that violates indentation",
                    self.get_mark(),
                )
            blanks += char
            self.forward()
        if not breaks:
            return blanks
        if breaks[0] != "\n":
            return "".join(breaks)
        return "".join(breaks[1:]) or " "

    def scan_directive_name(self, start_mark: Any) -> str:
        """Return the name of a directive, of which there are two."""
        name: str = super().scan_directive_name(start_mark)  # type: ignore[no-untyped-call]
        if name not in ("YAML", "TAG"):
            raise ScannerError(
                "while scanning a directive",
                start_mark,
                "found unknown directive name",
                self.get_mark(),
            )
        return name

    def scan_flow_scalar_non_spaces(self, double: bool, start_mark: Any) -> list[str]:
        """Return the pieces of a quoted text up to the next space."""
        begin = self.pointer
        try:
            pieces: list[str] = super().scan_flow_scalar_non_spaces(double, start_mark)
            is_text = not any("\ud800" <= char <= "\udfff" for piece in pieces for char in piece)
        except (ValueError, OverflowError):
            is_text = False
        if is_text:
            return pieces
        mark = self.get_mark()
        for found in _ESCAPE.finditer(self.buffer, begin):
            code = int(found[1] or found[2] or "0", 16)
            if 0xD800 <= code <= 0xDFFF or code > 0x10FFFF:
                mark.index, mark.pointer = mark.index - self.pointer + found.start(), found.start()
                break
        raise ScannerError(
            "while parsing a quoted scalar",
            start_mark,
            "found invalid Unicode character escape code",
            mark,
        )
