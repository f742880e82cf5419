"""Runs `attach`, `mirror`, `loop` and the sections of a robot: what they hold, for lowering.

Nothing is known here of what they mean, only where they are words: where a part may stand. In an
XML element, and in a root that is not a `<robot>`, they are XML elements themselves. The blocks for
one output format are words in a part, its joint and its link as well.
"""

from __future__ import annotations

from ..diagnostics import YamaroError
from ..syntax.names import RAW_BLOCKS
from ..syntax.nodes import Body, TextContent
from ..xml.tree import Element, PartElement, RawBlock, RobotWord, Text
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
        if item.body is None:
            continue
        if interpreter.target == TARGET:
            interpreter.run_body(item.body, scope, out)
        else:
            _run_for_format(interpreter, node, item.body, scope, out)


def _run_for_format(
    interpreter: Interpreter, node: RobotWordNode, body: Body, scope: Scope, out: list[Node]
) -> None:
    """Append a block of XML for a format other than URDF.

    In a model, parts and other words of a robot in it are the robot's.
    """
    block = RawBlock(node.key.text, node.span, trace=interpreter.trace(), verbatim=True)
    content: list[Node] = []
    depths = interpreter.part_depth, interpreter.element_depth
    if any(depths):
        interpreter.part_depth, interpreter.element_depth = 0, 2
    interpreter.run_body(body, scope, content)
    interpreter.part_depth, interpreter.element_depth = depths
    block.children = [each for each in content if not isinstance(each, PartElement)]
    if block.children:
        interpreter.has_blocks = True
        out.append(block)
    out += [each for each in content if isinstance(each, PartElement)]


def _is_in_part(interpreter: Interpreter) -> bool:
    """Return whether this is directly in a part, or in the joint or link of one."""
    if not interpreter.part_depth or interpreter.element_depth > 1:
        return False
    holder = interpreter.filled
    return interpreter.element_depth == 0 or (
        holder is not None and holder.name in ("joint", "link") and not holder.verbatim
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
