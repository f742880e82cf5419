"""Includes of URDF, or other XML, as it is: reads it, and renames its links and joints."""

from __future__ import annotations

import re

from ..diagnostics import INHERITED, failure
from ..xmltree import Element, Text, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..diagnostics import Frame
    from ..syntax.nodes import IncludeNode
    from ..xmltree import Node

ENDINGS = (".urdf", ".xml", ".sdf")
"""Endings of the names of files that hold XML."""

_REFERS = re.compile("link|joint|frame|body|reference|parent|child|mimic", re.IGNORECASE)
"""Tags and attributes that name links and joints, in extensions of URDF that no schema tells of."""


def is_xml_file(path: str) -> bool:
    """Tell whether a file holds XML that is included as it is."""
    return path.lower().endswith(ENDINGS)


def prefix_of(node: IncludeNode, passed: dict[str, Any]) -> str:
    """Return the prefix that an include of XML gives to links and joints.

    Raises:
        YamaroError: it passes something else, or wants a namespace.
    """
    for argument in node.arguments:
        if argument.name != "prefix":
            raise failure(
                "unknown-argument",
                f"an XML file takes no variable '{argument.name}'",
                argument.span,
                hint="prefix: left_ renames its links and joints; nothing else can be set in it",
            )
    if node.namespace is not None:
        raise failure(
            "bad-namespace",
            "an XML file has no functions or variables to put into a namespace",
            node.path_span,
            hint="leave 'namespace' out",
        )
    return format_value(passed.get("prefix"))


def content_of(root: Element, prefix: str, frame: Frame | None) -> list[Node]:
    """Return what stands under the root of an XML document, reached by an include.

    Args:
        root: its root.
        prefix: put in front of the names of links and joints, wherever they are named.
        frame: the include.
    """
    if prefix:
        _rename(root, prefix)
    _tidy(root)
    for child in root.children:
        if isinstance(child, Element):
            child.trace = frame
    return root.children


def _tidy(root: Element) -> None:
    """Leave out the white space between elements, and let them inherit what led to the root."""
    pending = [root]
    while pending:
        element = pending.pop()
        element.trace = INHERITED
        inner = [child for child in element.children if isinstance(child, Element)]
        if inner or element is root:
            element.children = [child for child in element.children if not _is_space(child)]
        pending += inner


def _is_space(node: Node) -> bool:
    return isinstance(node, Text) and not format_value(node.value).strip()


def _rename(root: Element, prefix: str) -> None:
    names = {
        format_value(element.attributes.get("name"))
        for element in root.elements()
        if element.name in ("link", "joint")
    }

    def renamed(text: str) -> str:
        words = text.split()
        if not any(word in names for word in words):
            return text
        return " ".join([prefix + word if word in names else word for word in words])

    pending = root.elements()
    while pending:
        element = pending.pop()
        is_named = element.name in ("link", "joint")
        for name, value in element.attributes.items():
            if is_named if name == "name" else _REFERS.search(name):
                element.attributes[name] = renamed(format_value(value))
        if _REFERS.search(element.name):
            for child in element.children:
                if isinstance(child, Text):
                    child.value = renamed(format_value(child.value))
        pending += element.elements()
