"""Checks whether a text is a document as Yamaro writes them, even if it comes from elsewhere."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

    from ..policy import Limits

BEGINNING = '<?xml version="1.0"?>\n<'


class NotWellFormed(ValueError):
    """A text is not a well-formed document; the text of the error says why."""


def check_document(text: str, limits: Limits) -> None:
    """Check a document with an XML parser, in time that grows with its length only.

    It has to be well-formed, its prefixes declared, and it keeps within the limits. Beyond that it
    holds elements, attributes, text and comments only: no document type with entities of its own,
    no processing instructions, no other encoding.

    Raises:
        NotWellFormed: it is not.
    """
    if len(text) > limits.output:
        raise NotWellFormed(f"the document has more than {limits.output:,} characters")
    if not text.startswith(BEGINNING) or text.startswith(BEGINNING + "!"):
        raise NotWellFormed("the document does not begin with its root element")
    try:
        data = text.encode()
    except UnicodeEncodeError:
        raise NotWellFormed("the document holds half a character") from None
    try:
        _Checker(limits).check(data)
    except NotWellFormed:
        # A document with other letters in place of those that expat does not know in names.
        # It knows the letters of the fourth edition of XML 1.0, and names are those of the fifth.
        # Each letter gets one of its own, so that what was equal or not stays so.
        from .values import bad_name_character

        known = range(0x4E00, 0x9FA6)  # ideographs, which both editions know
        present = {ord(char) for char in text if not char.isascii()}
        free = (code for code in known if code not in present)
        newer = (code for code in sorted(present) if code not in known)
        starts = (code for code in newer if bad_name_character(chr(code)) is None)
        older = text.translate(dict(zip(starts, free, strict=False)))
        if older == text:
            raise
        _Checker(limits).check(older.encode())


class _Checker:
    """Listens to expat."""

    def __init__(self, limits: Limits) -> None:
        self._most = limits.xml_depth
        self._depth = 0
        self._known = {"xml": 1}  # how many open elements declare each prefix
        self._declared: list[tuple[int, list[str]]] = []  # the depth, and what is declared there

    def check(self, data: bytes) -> None:
        from pyexpat import ExpatError, ParserCreate

        parser = ParserCreate("utf-8")
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.StartDoctypeDeclHandler = self._refuse
        parser.ProcessingInstructionHandler = self._refuse
        try:
            parser.Parse(data, True)
        except ExpatError as error:
            raise NotWellFormed(f"the document is not well-formed: {error}") from None

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        self._depth += 1
        if self._depth > self._most:
            raise NotWellFormed(f"the document is more than {self._most:,} elements deep")
        if ":" in name or ":" in "".join(attributes):
            self._check_prefixes([name, *attributes])

    def _check_prefixes(self, names: list[str]) -> None:
        new = [name[6:] for name in names[1:] if name.startswith("xmlns:")]
        if new:
            self._declared.append((self._depth, new))
            for prefix in new:
                self._known[prefix] = self._known.get(prefix, 0) + 1
        for name in names:
            prefix, colon, _ = name.partition(":")
            if colon and prefix != "xmlns" and not self._known.get(prefix):
                raise NotWellFormed(f"the document does not declare the prefix '{prefix}'")

    def _end(self, name: str) -> None:
        if self._declared and self._declared[-1][0] == self._depth:
            for prefix in self._declared.pop()[1]:
                self._known[prefix] -= 1
        self._depth -= 1

    def _refuse(self, *_: object) -> NoReturn:
        raise NotWellFormed("the document holds more than elements, text and comments")
