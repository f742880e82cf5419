"""The files of a program: each read and parsed once, for all conversions of it."""

from __future__ import annotations

from ..diagnostics import YamaroError
from ..files.loader import decode
from ..source import Source, holds_xml
from ..syntax.context import Rules
from ..syntax.parser import parse

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import CodeType

    from ..diagnostics import Reporter
    from ..files.loader import Loader
    from ..policy import Policy
    from ..syntax.nodes import Document, Parsed


class Library:
    """Reads and parses files, and remembers the result.

    Nothing in it changes once it is there, so that conversions may run one after the other or at
    once, in several threads: at worst two of them parse the same file. What could not be read or
    has errors is not remembered.

    Attributes:
        loader: gives the text of files.
        rules: what holds for the files; by default that of trusted ones.
        modules: the code of Python modules by their paths.
    """

    __slots__ = ("_parsed", "_texts", "loader", "modules", "rules")

    def __init__(self, loader: Loader, rules: Rules | None = None) -> None:
        """Begin without files."""
        self.loader = loader
        self.rules = rules or Rules()
        self.modules: dict[str, CodeType] = {}
        self._texts: dict[str, str] = {}
        self._parsed: dict[tuple[str, str], Parsed] = {}

    def source(self, path: str, name: str, *, is_xml: bool = False) -> Source:
        """Return a file, which is marked if it holds XML, and so says itself how it is encoded.

        Args:
            path: where it is, absolute.
            name: what it is called in messages.
            is_xml: it holds XML, whatever it is called.

        Raises:
            LoadError: it cannot be read.
            YamaroError: it is not text in its encoding.
        """
        text = self._texts.get(path)
        if text is not None:
            source = Source(text, name=name, path=path)
            source.is_xml = is_xml or holds_xml(path, text)
            return source
        data = self.loader.read(path)
        if is_xml or holds_xml(path, data):
            from ..xml.reader import decode_xml

            source = decode_xml(data, name=name, path=path)
            source.is_xml = True
        else:
            source = decode(data, name=name, path=path)
        self._texts[path] = source.text
        return source

    def parse(self, source: Source, *, reporter: Reporter) -> Document:
        """Return the syntax tree of a file; every call reports its warnings.

        Raises:
            YamaroError: the file has errors.
        """
        key = (source.path, source.name)
        if key not in self._parsed:
            parsed = parse(source, rules=self.rules)
            if parsed.errors:
                for warning in parsed.warnings:
                    reporter.add(warning)
                raise YamaroError(parsed.errors)
            self._parsed[key] = parsed
        parsed = self._parsed[key]
        for warning in parsed.warnings:
            reporter.add(warning.copy())  # the caller's own: a strict build makes it an error
        return parsed.document


def rules_of(policy: Policy) -> Rules:
    """Return what holds for the files that are compiled under a policy."""
    if not policy.is_safe:
        return Rules(policy.limits)
    from ..safe.code import compile_safe
    from ..safe.limits import SafeLimits

    limits = SafeLimits.of(policy.limits)

    def compile(text: str, filename: str, mode: str) -> CodeType:
        return compile_safe(text, filename, mode, limits)

    return Rules(policy.limits, compile)
