"""Runs `attach`, `mirror`, `loop` and the sections of a robot: what they hold, for lowering.

Nothing is known here of what they mean, only where they are words: where a part may stand. In an
XML element, and in a root that is not a `<robot>`, they are XML elements themselves. The blocks for
one output format are words in a part, its joint and its link as well.
"""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..syntax.keys import NAME_RULE, name_fault
from ..syntax.names import RAW_BLOCKS
from ..syntax.nodes import Body, TextContent
from ..xml.tree import Element, PartElement, RawBlock, RobotWord, Text
from ..xml.values import format_value
from .includes import run_include
from .markup import run_element
from .predefined import TARGET
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..syntax.nodes import RobotWordItem, RobotWordNode
    from ..xml.tree import Node
    from .interpreter import Interpreter


def run_robot_word(
    interpreter: Interpreter, node: RobotWordNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Append what a robot's word makes: a `RobotWord` for each item, or an XML element.

    Raises:
        YamaroError: it is faulty.
    """
    if node.key.text in RAW_BLOCKS:
        _run_raw_block(interpreter, node, scope, out, body)
        return
    if not node.is_section and not _may_hold_parts(interpreter):
        run_element(interpreter, interpreter.files.late.element(node), scope, out, body)
        return
    if node.faults:
        raise YamaroError(fault.copy() for fault in node.faults)
    interpreter.has_parts = True
    out.extend([_run_item(interpreter, node, item, scope) for item in node.items])


def _run_raw_block(
    interpreter: Interpreter, node: RobotWordNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run the content of a block in place, if it is for the format that is written."""
    if not _may_hold_parts(interpreter) and not _is_in_part(interpreter):
        run_element(interpreter, interpreter.files.late.element(node), scope, out, body)
        return
    interpreter.has_raw_blocks = True
    if node.key.text != interpreter.target:
        return
    if node.faults:
        raise YamaroError(fault.copy() for fault in node.faults)
    for item in node.items:
        if item.body is None and item.content is None:
            continue
        if interpreter.target != TARGET:
            _run_for_format(interpreter, node, item, scope, out)
        elif item.body is not None:
            interpreter.run_body(item.body, scope, out)
        else:
            out += _elements_of_dict(interpreter, node, item, scope)


def _run_for_format(
    interpreter: Interpreter,
    node: RobotWordNode,
    item: RobotWordItem,
    scope: Scope,
    out: list[Node],
) -> None:
    """Append a block of XML for a format other than URDF.

    In a model, parts and other words of a robot in it are the robot's.
    """
    block = RawBlock(node.key.text, node.span, trace=interpreter.trace(), verbatim=True)
    content: list[Node] = []
    if item.body is None:
        content += _elements_of_dict(interpreter, node, item, scope)
    else:
        depths = interpreter.part_depth, interpreter.element_depth
        if any(depths):
            interpreter.part_depth, interpreter.element_depth = 0, 2
        interpreter.run_body(item.body, scope, content)
        interpreter.part_depth, interpreter.element_depth = depths
    block.children = [each for each in content if not isinstance(each, PartElement)]
    if block.children:
        interpreter.has_blocks = True
        out.append(block)
    out += [each for each in content if isinstance(each, PartElement)]


def _elements_of_dict(
    interpreter: Interpreter, node: RobotWordNode, item: RobotWordItem, scope: Scope
) -> list[Node]:
    """Return the elements of a block whose content is a dict that an expression gives.

    Raises:
        YamaroError: it is something else.
    """
    assert isinstance(item.content, TextContent), "a block is a body or an expression"
    span = item.content.span
    value = interpreter.values.written(item.content.value, scope)
    if value is None:
        return []
    if not isinstance(value, dict):
        raise failure(
            "not-a-body",
            f"'{node.key.text}' holds entries such as `name: value`",
            span,
            hint=f"write {node.key.text}: {{armature: 0.01}}, or an expression that gives a dict",
        )
    found: list[Node] = []
    pending = [(value, found)]
    while pending:
        entries, out = pending.pop()
        for name, inner in entries.items():
            fault = name_fault(format_value(name), "element")
            if fault is not None:
                raise failure("bad-name", fault, span, hint=NAME_RULE)
            element = Element(format_value(name), span, {}, [], interpreter.trace())
            out.append(element)
            if isinstance(inner, dict):
                pending.append((inner, element.children))
            elif inner is not None:
                element.children.append(Text(inner, span))
    return found


HOMES = (("joint", "link"), ("visual", "collision", "frame"))
"""The elements that may hold a block: those in a part, and those in the link of one."""


def _is_in_part(interpreter: Interpreter) -> bool:
    """Return whether this is directly in a part, or in an element that may hold a block."""
    depth, holder = interpreter.element_depth, interpreter.filled
    if not interpreter.part_depth or depth > len(HOMES):
        return False
    return depth == 0 or (
        holder is not None and holder.name in HOMES[depth - 1] and not holder.verbatim
    )


def _may_hold_parts(interpreter: Interpreter) -> bool:
    depth = interpreter.element_depth + interpreter.part_depth
    return interpreter.is_robot and depth == 0


def _run_item(
    interpreter: Interpreter, node: RobotWordNode, item: RobotWordItem, scope: Scope
) -> RobotWord:
    word = RobotWord(node.key.text, item.span, trace=interpreter.trace())
    before = interpreter.is_inside, interpreter.holder
    interpreter.is_inside, interpreter.holder = True, interpreter.frame
    if isinstance(item.content, Body):
        interpreter.part_depth += 1
        interpreter.run_body(item.content, scope, word.children)
        interpreter.part_depth -= 1
    elif isinstance(item.content, TextContent):
        text = interpreter.values.written(item.content.value, scope)
        word.children.append(Text(text, item.content.span))
    if item.include is not None or item.body is not None:
        content = Element("body", node.span, trace=word.trace)
        word.children.append(content)
        if item.include is not None:
            run_include(interpreter, item.include, scope, content.children, None)
        elif item.body is not None:
            if node.key.text != "attach":
                interpreter.run_body(item.body, scope, content.children)
            else:  # in a context of its own, like a call
                callee = Scope(
                    scope.home, interpreter.shared_names, closure=scope, caller=scope.context
                )
                interpreter.run_body(item.body, callee, content.children)
                for key, value in callee.exported():
                    interpreter.receive(scope, key, value, node.span, callee.place_of(key))
    interpreter.is_inside, interpreter.holder = before
    return word
