"""Formats a text, and makes sure that it means the same afterwards."""

from __future__ import annotations

from ...diagnostics import Reporter, YamaroError
from ...yaml.libyaml import DeepParser
from ...yaml.nodes import ScalarNode
from ...yaml.reader import read_on
from .layout import Layout

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from ...policy import Limits
    from ...source import Source


class LayoutFault(Exception):
    """The text would mean something else afterwards: a fault of the formatter."""


def formatted(source: Source, limits: Limits | None = None) -> str:
    """Return the text of a source in Yamaro's style; only white space differs.

    Args:
        source: what to format. It must be YAML; what it means does not matter.
        limits: how deep it may be.

    Raises:
        YamaroError: it is not YAML as Yamaro reads it.
        LayoutFault: the formatter would change what the text means.
    """
    reading = read_on(source, reporter=Reporter(), limits=limits)
    if reading.errors:
        raise YamaroError(reading.errors)
    if isinstance(reading.root, ScalarNode):
        from ...syntax.parser import parse

        parse(source).require()
    text = reading.text  # without the tabs of blank lines
    new = Layout(text).run()
    if "".join(new.split()) != "".join(source.text.split()):
        raise LayoutFault("formatting would change more than white space")
    if list(_meaning(new)) != list(_meaning(text)):
        raise LayoutFault("formatting would change the meaning of the file")
    return new.replace("\n", "\r\n") if _ends_lines_with_crlf(source.text) else new


def _ends_lines_with_crlf(text: str) -> bool:
    end = text.find("\n")
    return end > 0 and text[end - 1] == "\r"


def _meaning(text: str) -> Iterator[tuple[Any, ...]]:
    """Give what libyaml reads in a text, without places."""
    parser = DeepParser(text)
    try:
        while (event := parser.get_event()) is not None:
            yield (
                type(event),
                getattr(event, "value", None),
                getattr(event, "style", None),
                bool(getattr(event, "flow_style", None)),
                getattr(event, "anchor", None),
                getattr(event, "tag", None),
            )
    finally:
        parser.dispose()
