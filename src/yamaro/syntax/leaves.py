"""Parses the statements that hold no others: texts, comments, `print`, `process`, `include`."""

from __future__ import annotations

from ..diagnostics import failure
from ..yaml.nodes import ScalarNode
from .context import ParseContext
from .includes import parse_include
from .nodes import CommentNode, PrintNode, ProcessNode, TextNode
from .python import compile_statements
from .template import parse_template
from .values import is_empty, parse_value, warn_of_hidden_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..yaml.nodes import YamlNode
    from .nodes import Statement


def parse_leaf(key: ScalarNode, node: YamlNode, context: ParseContext) -> Statement:
    """Return the statement that one pair of a body describes.

    Raises:
        YamaroError: the statement is faulty.
    """
    word = key.text
    if word == "include":
        return parse_include(key, node, context)
    if word == "print":
        return _parse_print(node, context)
    if word == "process":
        return _parse_process(key, node, context)
    return _parse_text_or_comment(word.strip("<>"), node, context)


def _parse_text_or_comment(
    word: str, node: YamlNode, context: ParseContext
) -> TextNode | CommentNode:
    """Return the text or comment that stands under `<#text>` or `<#comment>`."""
    if not isinstance(node, ScalarNode):
        raise failure(
            "not-a-text",
            f"<{word}> takes a text",
            node.span(),
            hint="use one such entry for each text",
        )
    text = "" if is_empty(node) else parse_template(node, context=context)
    make = TextNode if word == "#text" else CommentNode
    return make(text, node.span())


def _parse_print(node: YamlNode, context: ParseContext) -> PrintNode:
    """Return what a `print` says, a text or a value."""
    if isinstance(node, ScalarNode):
        warn_of_hidden_value(node, context)
        text = "" if is_empty(node) else parse_template(node, context=context)
        return PrintNode(text, node.span())
    return PrintNode(parse_value(node, context), node.span())


def _parse_process(key: ScalarNode, node: YamlNode, context: ParseContext) -> ProcessNode:
    """Return the Python statements of a `process`."""
    if not isinstance(node, ScalarNode):
        raise failure(
            "not-a-text",
            "`process` takes Python statements as a text",
            node.span(),
            hint="write process: | and the statements, indented, on the lines below",
        )
    if node.anchor is not None:
        context.warn(
            "anchored-expression",
            f"'&{node.anchor}' is a YAML anchor here, not a part of the statement",
            node.anchor_span(),
            hint="quote the statement, or delete the anchor",
        )
    code = compile_statements(node, context.rules)
    context.codes.append(code)
    return ProcessNode(code, key.span())
