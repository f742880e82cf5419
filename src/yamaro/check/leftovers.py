"""Advice on what a URDF holds that was meant for another program: xacro's expressions."""

from __future__ import annotations

from ..model.schema import ELEMENTS, TEXT
from ..model.values import attribute_text
from ..xml.tree import Element, Text
from .context import CheckContext

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

SUBSTITUTIONS = ("$(arg ", "$(find ", "$(env ", "$(optenv ", "$(eval ", "$(dirname", "$(anon ")


def advise_on_leftovers(root: Element, context: CheckContext) -> None:
    """Report, once, expressions of xacro that nothing has evaluated.

    Parsers take them for names and texts. In YAML they are reported where they are read.
    """
    found = list(_leftovers(root))
    for group in context.apart("leftover-expression", found, lambda each: each[:2]):
        element, attribute, text = group[0]
        more = len(group) - 1
        context.warn(
            "leftover-expression",
            f"'{text.strip()}' was not evaluated",
            element,
            attribute=attribute,
            hint="only xacro evaluates it: rename the file to .xacro, or write its value",
            notes=[f"{more} more {'are' if more > 1 else 'is'} in the file"] if more else (),
        )


def _leftovers(root: Element) -> Iterator[tuple[Element, str | None, str]]:
    for element in root.iter():
        if not element.span.source.is_xml:
            continue
        for name in element.attributes:
            text = attribute_text(element, name)
            if text is not None and _is_leftover(text) and not _is_number(element.name, name):
                yield element, name, text
        for child in element.children:
            if isinstance(child, Text) and _is_leftover(str(child.value)):
                yield element, None, str(child.value)


def _is_leftover(text: str) -> bool:
    if "$" not in text:
        return False
    return ("${" in text and "}" in text) or any(word in text for word in SUBSTITUTIONS)


def _is_number(element: str, attribute: str) -> bool:
    """Return whether URDF reads numbers there, so that the check reports it anyway."""
    rule = ELEMENTS[element].fields.get(attribute) if element in ELEMENTS else None
    return rule is not None and rule.count != TEXT
