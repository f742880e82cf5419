"""The names that the expressions and tags of xacro define and read."""

from __future__ import annotations

import os
import re

from ....xml.tree import Element
from ....xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast
    from collections.abc import Container, Iterator


def camel(name: str) -> str:
    """Return a name as that of a function: `wheel_macro` becomes `WheelMacro`."""
    words = [word for word in re.split(r"[^A-Za-z0-9]+", name) if word]
    joined = "".join(word[0].upper() + word[1:] for word in words)
    return joined if joined[:1].isalpha() else f"F{joined}"


def defined_in(root: Element, *, nested: bool = False) -> set[str]:
    """Return the properties defined in an element, those of macros in it only if `nested`."""
    names = set()
    pending = [root]
    while pending:
        element = pending.pop()
        if element.name == "xacro:property":
            names.add(format_value(element.attributes.get("name")))
        if element.name != "xacro:macro" or element is root or nested:
            pending += element.elements()
    return names


def texts_in(root: Element) -> Iterator[str]:
    """Return the values of attributes in an element, and its texts."""
    for element in root.iter():
        yield from map(format_value, element.attributes.values())
        yield element.text()


def outside_expressions(text: str) -> str:
    """Return what of a text is not Python: without `${…}`, but with the texts in it."""
    return re.sub(
        r"\$\{([^}]*)\}", lambda found: " ".join(re.findall(r"'[^']*'|\"[^\"]*\"", found[1])), text
    )


def used_in(root: Element, without: Container[int] = ()) -> set[str]:
    """Return the names in the expressions of an element, except elements of some identities."""
    names: set[str] = set()
    for element in root.iter(without):
        for text in (*map(format_value, element.attributes.values()), element.text()):
            names |= names_in(text)
    return names


def names_in(text: str) -> set[str]:
    """Return the names that the expressions of a text read."""
    import ast

    names: set[str] = set()
    for expression in re.findall(r"\$\{([^}]*)\}", text):
        try:
            tree = ast.parse(re.sub(r"\$\([^)]*\)", "0", expression).strip(), mode="eval")
        except (SyntaxError, ValueError):
            continue
        found = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
        bound = {node.id for node in found if isinstance(node.ctx, ast.Store)}
        bound |= {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
        names |= {node.id for node in found} - bound
    return names


def common_folder(paths: list[str]) -> str:
    """Return the deepest folder that holds all of the files."""
    return os.path.commonpath([os.path.dirname(path) for path in paths])


def computed_with(root: Element) -> set[str]:
    """Return the names that conditions are made of, or that expressions take for more than texts.

    A name that stands alone in an expression, or is compared with a text, is not.
    """
    import ast

    names: set[str] = set()
    for element in root.iter():
        is_condition = element.name in ("xacro:if", "xacro:unless")
        for text in (*map(format_value, element.attributes.values()), element.text()):
            if is_condition:
                names.update(re.findall(r"\$\(arg\s+([\w-]+)\s*\)", text))
            for expression in re.findall(r"\$\{([^}]*)\}", text):
                try:
                    tree = ast.parse(re.sub(r"\$\([^)]*\)", "0", expression).strip(), mode="eval")
                except (SyntaxError, ValueError):
                    continue
                if is_condition or not isinstance(tree.body, ast.Name):
                    names |= _names_computed_with(tree.body)
    return names


def _names_computed_with(node: ast.AST) -> set[str]:
    import ast

    if isinstance(node, ast.Name):
        return {node.id}
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        if any(isinstance(own, ast.Constant) and isinstance(own.value, str) for own in sides):
            return set()
    return set().union(*map(_names_computed_with, ast.iter_child_nodes(node)))
