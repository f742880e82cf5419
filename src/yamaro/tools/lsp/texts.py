"""A text of a file with what is known of it without running it, worked out when it is asked for."""

from __future__ import annotations

import os

from ...diagnostics import Reporter, YamaroError
from ...policy import Limits
from ...sandbox.deep_stack import run_on_deep_stack
from ...source import Source, holds_xml

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...diagnostics import Diagnostic
    from ...syntax.document import Parsed
    from ...xml.tree import Element
    from ...yaml.nodes import YamlNode
    from .names import Names
    from .parts import Parts

YAML_ENDINGS = (".yaml", ".yml")
XML_ENDINGS = (".xacro", ".urdf", ".xml", ".sdf")


class Text:
    """The text of a file at one moment.

    Attributes:
        path: where the file is, absolute.
        source: the text; `is_xml` says whether it is URDF or xacro.
    """

    __slots__ = ("_names", "_parsed", "_parts", "_root", "_xml", "path", "source")

    def __init__(self, path: str, text: str) -> None:
        """Take a text for the content of a file."""
        self.path = path
        self.source = Source(text.removeprefix("\ufeff"), name=path, path=path)
        self.source.is_xml = holds_xml(path, text)
        self._parsed: Parsed | None = None
        self._root: YamlNode | None = None
        self._names: Names | None = None
        self._parts: Parts | None = None
        self._xml: tuple[Element | None, list[Diagnostic]] | None = None

    @property
    def text(self) -> str:
        """Return the text itself, without a byte order mark."""
        return self.source.text

    @property
    def folder(self) -> str:
        """Return the folder in which relative paths start."""
        return os.path.dirname(self.path)

    @property
    def is_yaml(self) -> bool:
        """Return whether it is a file of the language, and no XML."""
        return not self.source.is_xml

    @property
    def parsed(self) -> Parsed:
        """Return the syntax tree; for files that are not XML."""
        if self._parsed is None:
            run_on_deep_stack(self._parse)
        assert self._parsed is not None
        return self._parsed

    @property
    def root(self) -> YamlNode | None:
        """Return the YAML nodes that could be read; for files that are not XML."""
        if self._parsed is None:
            run_on_deep_stack(self._parse)
        return self._root

    def _parse(self) -> None:
        from ...syntax.parser import parse_reading
        from ...yaml.reader import read_on

        reporter = Reporter()
        reading = read_on(self.source, reporter=reporter)
        self._root = reading.root
        self._parsed = parse_reading(self.source, reading, reporter=reporter)

    @property
    def names(self) -> Names:
        """Return the names that the file declares and uses."""
        if self._names is None:
            from .names import Names

            document = self.parsed.document
            self._names = run_on_deep_stack(lambda: Names(document, self.root))
        return self._names

    @property
    def parts(self) -> Parts:
        """Return the parts that the file names, and the places that refer to them."""
        if self._parts is None:
            from .parts import Parts

            root = self.root
            self._parts = run_on_deep_stack(lambda: Parts(root))
        return self._parts

    @property
    def xml(self) -> Element | None:
        """Return the root element of a file that holds XML, or None if it is not well-formed."""
        return self._read_xml()[0]

    @property
    def findings(self) -> list[Diagnostic]:
        """Return what is to be said of the file unrun."""
        if self.is_yaml:
            return self.parsed.diagnostics
        return self._read_xml()[1]

    def _read_xml(self) -> tuple[Element | None, list[Diagnostic]]:
        if self._xml is None:
            self._xml = run_on_deep_stack(lambda: _read_xml(self.source))
        return self._xml


def _read_xml(source: Source) -> tuple[Element | None, list[Diagnostic]]:
    from ...xml.reader import read_xml

    try:
        return read_xml(source, Limits()).root, []
    except YamaroError as error:
        return None, error.diagnostics


def may_be_of_robots(path: str) -> bool:
    """Return whether a file has an ending that the server reads."""
    return path.lower().endswith((*YAML_ENDINGS, *XML_ENDINGS))
