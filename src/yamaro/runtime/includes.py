"""Evaluates what an `include` asks for: its path, its namespace, and what it passes."""

from __future__ import annotations

from ..diagnostics import failure
from ..syntax.names import is_identifier, name_hint
from ..syntax.nodes import IncludeNode
from ..xml.values import format_value
from .scope import Scope
from .values import Values

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


def path_of(node: IncludeNode, scope: Scope, values: Values) -> str:
    """Return the path of the file to include, as written.

    Raises:
        YamaroError: it is empty, or no path at all.
    """
    text = format_value(values.written(node.path, scope)).strip()
    if not text or "\x00" in text:
        raise failure(
            "missing-file",
            "the path of this include is empty"
            if not text
            else "the path of this include holds a NUL character",
            node.path_span,
            hint="write include: other.yaml",
        )
    return text


def namespace_of(node: IncludeNode, scope: Scope, values: Values) -> str | None:
    """Return the name of the namespace that takes what the file hands back, if there is one.

    Raises:
        YamaroError: it is no name.
    """
    if node.namespace is None or isinstance(node.namespace, str):
        return node.namespace
    name = values.joined(node.namespace, scope)
    if name and not is_identifier(name):
        raise failure(
            "bad-namespace",
            f"'{name}' cannot name a namespace",
            node.namespace.span(),
            hint=name_hint(name),
        )
    return name or None


def passed_by(node: IncludeNode, scope: Scope, values: Values) -> dict[str, Any]:
    """Return the variables that are passed to the file."""
    passed = {}
    for argument in node.arguments:
        assert argument.name is not None
        assert argument.value is not None
        passed[argument.name] = values.value(argument.value, scope)
    return passed
