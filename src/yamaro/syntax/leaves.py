"""Parses the statements that hold no others: texts, comments, `print` and `process`."""

from __future__ import annotations

from ..diagnostics import failure
from ..yaml.nodes import ScalarNode
from .context import ParseContext
from .nodes import CommentNode, PrintNode, ProcessNode, TextNode
from .python import compile_statements
from .template import parse_template
from .values import is_empty, parse_value, warn_of_hidden_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..yaml.nodes import YamlNode


def parse_text_or_comment(
    word: str, node: YamlNode, context: ParseContext
) -> TextNode | CommentNode:
    """Return the text or comment that stands under `<#text>` or `<#comment>`.

    Raises:
        YamaroError: it is not a text.
    """
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


def parse_print(key: ScalarNode, node: YamlNode, context: ParseContext) -> PrintNode:
    """Return what a `print` says, a text or a value."""
    if isinstance(node, ScalarNode):
        warn_of_hidden_value(node, context)
        text = "" if is_empty(node) else parse_template(node, context=context)
        return PrintNode(text, node.span())
    return PrintNode(parse_value(node, context), node.span())


def parse_process(key: ScalarNode, node: YamlNode, context: ParseContext) -> ProcessNode:
    """Return the Python statements of a `process`.

    Raises:
        YamaroError: it is not a text, or not Python.
    """
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
