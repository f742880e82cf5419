"""Elements, texts and comments in which nothing is evaluated, as they will be written."""

from __future__ import annotations

from ..diagnostics import INHERITED
from ..xml.tree import Comment, Element, Text
from ..xml.values import is_comment_text
from .forms import form_of
from .nodes import (
    Body,
    CommentNode,
    Content,
    ElementNode,
    PartNode,
    Statement,
    TextContent,
    TextNode,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node


def as_put_out(statement: Statement, body: Body) -> Statement:
    """Return an element, text or comment in which nothing is evaluated as it will be written.

    What is evaluated, or may fail when it is run, is returned as it is.
    """
    if isinstance(statement, ElementNode):
        return element_put_out(statement, body)
    if isinstance(statement, PartNode):
        statement.form = form_of(statement, body)
    if isinstance(statement, TextNode) and isinstance(statement.value, str):
        return Text(statement.value, statement.span)
    if isinstance(statement, CommentNode) and isinstance(statement.value, str):
        if is_comment_text(statement.value):
            return Comment(statement.value, statement.span)
    return statement


def element_put_out(node: ElementNode, body: Body) -> Element | ElementNode:
    """Return an element as it will be written, or as it is if something in it is evaluated."""
    form = form_of(node, body)
    children = static_children(node.content)
    if form is None or form.holes or children is None:
        node.form = form
        return node
    return Element(
        str(node.name),
        node.span,
        attributes={str(attribute.name): attribute.value for attribute in node.attributes},
        children=children,
        trace=INHERITED,
        value_spans={str(attribute.name): attribute.span for attribute in node.attributes},
        verbatim=node.verbatim,
        body=body,
    )


def static_children(content: Content) -> list[Node] | None:
    """Return what an element's content puts out, or None if it has to be run."""
    if content is None:
        return []
    if isinstance(content, Body) and content.is_static:
        return content.statements  # type: ignore[return-value]  # `is_static` says what they are
    if isinstance(content, TextContent) and isinstance(content.value, str):
        return [Text(content.value, content.span)]
    return None


NO_CHILDREN: list[Node] = []
"""What an element holds that is empty; nobody changes an element that the parser has made."""
