"""Prefixes of XML that a macro or file declares, for the element that takes its content."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xmltree import Element
    from .expansion import Expansion


def lift_prefixes(expansion: Expansion, inner: Element, outer: Element) -> None:
    """Declare in one element what another declares, unless the prefix has another meaning."""
    for name, value in inner.attributes.items():
        if not name.startswith("xmlns:"):
            continue
        old = outer.attributes.get(name)
        if old is None or old == value:
            outer.attributes[name] = value
            continue
        expansion.reporter.warn(
            "xacro-prefix",
            f"the prefix '{name[6:]}' means '{value}' here, and '{old}' around",
            inner.value_span(name),
            hint="declare it with the same address in all files",
            trace=expansion.frame,
        )
