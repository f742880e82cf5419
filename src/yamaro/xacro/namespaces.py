"""Prefixes of XML that a macro or file declares, for the element that takes its content."""

from __future__ import annotations

from ..xml.tree import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
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


def declare_lost(root: Element, lost: dict[str, object]) -> None:
    """Declare prefixes at the root that are used in it, and declared nowhere around their use.

    A file that is included in a condition leads to that: xacro forgets what it declares.
    """
    pending = [(root, frozenset(root.attributes))]
    while pending:
        element, declared = pending.pop()
        for name in (element.name, *element.attributes):
            declaration = f"xmlns:{name.partition(':')[0]}"
            if ":" in name and declaration in lost and declaration not in declared:
                root.attributes.setdefault(declaration, lost[declaration])
        pending += [(own, declared.union(own.attributes)) for own in element.elements()]
