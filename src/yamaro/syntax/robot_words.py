"""Parses the words that a robot has beside `part`: `attach`, `mirror`, `loop`, and its sections.

What such a word holds is data: keys are names as they are written, never elements, calls or
statements. Only `body` holds statements. Where no part may stand the same key is an XML element,
which is known when it is run.
"""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .context import ParseContext
from .leaves import parse_include_of
from .names import ROBOT_SECTIONS
from .nodes import (
    Body,
    ElementNode,
    ListContent,
    ListValue,
    RobotWordItem,
    RobotWordNode,
    TextContent,
)
from .python import parse_template
from .statements import parse_body
from .values import is_empty, pairs_of, parse_value, refuse_twice

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..yaml.nodes import YamlNode
    from .nodes import Content
    from .python import Template
    from .values import Pairs

LIST_ITEM = "-"
"""The name of an item in a list that holds mappings or lists."""

_BODY_OWNERS = ("attach", "mirror")
_ATTACH_KEYS = frozenset(("to", "at", "xyz", "rpy", "quat", "pivot", "prefix", "joint"))


def parse_robot_word(key: ScalarNode, node: YamlNode, context: ParseContext) -> RobotWordNode:
    """Return a statement or section of a robot; a list under `control` or `loop` holds several.

    What is wrong in it is kept in the result, and is an error only if it is run as the word.
    """
    word = RobotWordNode(key, node, is_section=key.text in ROBOT_SECTIONS)
    inner = ParseContext(context.reporter, context.rules)
    inner.blocks, inner.codes = context.blocks, context.codes
    several = key.text in ("control", "loop") and isinstance(node, SequenceNode)
    for item in node.items if several and isinstance(node, SequenceNode) else [node]:
        parsed = inner.attempt(_parse_item, key, item, inner)
        if parsed is not None:
            if several:  # the place of one is that of its first key
                pairs = item.pairs if isinstance(item, MappingNode) else []
                parsed.span = pairs[0][0].span() if pairs else item.span()
            word.items.append(parsed)
    word.faults = inner.errors
    return word


def parse_raw_block(key: ScalarNode, node: YamlNode, context: ParseContext) -> RobotWordNode:
    """Return a block for one output format: `urdf`, `sdf` or `mjcf`.

    What is wrong in it is kept in the result, and is an error only if the block is run.
    """
    word = RobotWordNode(key, node, is_section=False)
    inner = ParseContext(context.reporter, context.rules)
    inner.blocks, inner.codes = context.blocks, context.codes
    item = RobotWordItem(key.span())
    if isinstance(node, ScalarNode):
        if not is_empty(node):
            value = inner.attempt(parse_template, node, context=inner)
            item.content = None if value is None else TextContent(value, node.span())
    else:
        item.body = inner.attempt(parse_body, node, f"`{key.text}`", inner)
    word.items.append(item)
    word.faults = inner.errors
    return word


def _parse_item(key: ScalarNode, node: YamlNode, context: ParseContext) -> RobotWordItem:
    item = RobotWordItem(key.span())
    if isinstance(node, ScalarNode):
        if not is_empty(node):
            item.content = TextContent(parse_template(node, context=context), node.span())
        return item
    word = key.text
    own: Pairs = []
    passed: Pairs = []
    body: tuple[ScalarNode, YamlNode] | None = None
    for name, value in pairs_of(node, f"`{word}`", context):
        if name.text == "body" and word in _BODY_OWNERS:
            refuse_twice(body, name, word)
            body = (name, value)
        elif word == "attach" and name.text not in _ATTACH_KEYS:
            passed.append((name, value))
        else:
            own.append((name, value))
    item.content = _data_of_pairs(own, context)
    if body is not None:
        item.body = context.attempt(parse_body, body[1], f"`{word}`", context)
    if word == "attach" and body is None:
        item.include = parse_include_of(key, passed, context)
        prefixes = [name.span() for name, _ in own if name.text == "prefix"]
        item.include.own_prefix = prefixes[0] if prefixes else None
    elif word == "attach" and passed:
        first = passed[0][0]
        raise failure(
            "unknown-key",
            f"'{first.text}' is for a file, and this `attach` has a body",
            first.span(),
            hint="keep `path` or `body`; a body sees the variables around it",
        )
    return item


# --- data -------------------------------------------------------------------------------------


def parse_data(node: YamlNode, context: ParseContext) -> Content:
    """Return a value as content whose elements are named by its keys, with every place kept.

    A list of plain values is one content; an item of another list is an element named `-`.

    Raises:
        YamaroError: an expression in it is faulty.
    """
    if isinstance(node, ScalarNode):
        if is_empty(node):
            return None
        return TextContent(parse_template(node, context=context), node.span())
    if isinstance(node, MappingNode):
        return _data_of_pairs(pairs_of(node, "a value", context), context)
    if all(isinstance(item, ScalarNode) for item in node.items):
        value = parse_value(node, context)
        assert isinstance(value, ListValue)
        return ListContent(value, node.span())
    body = Body()
    for item in node.items:
        body.add(_data_element(LIST_ITEM, item, item, context))
    return body


def _data_of_pairs(pairs: Pairs, context: ParseContext) -> Body:
    body = Body()
    for key, value in pairs:
        name = parse_template(key, context=context) if "$" in key.text else key.text
        body.add(_data_element(name, key, value, context))
    return body


def _data_element(
    name: str | Template, key: YamlNode, value: YamlNode, context: ParseContext
) -> ElementNode:
    content: Content = None
    try:
        content = parse_data(value, context)
    except YamaroError as error:
        context.keep(error)
    return ElementNode(name, [], content, span=key.span(), verbatim=False)
