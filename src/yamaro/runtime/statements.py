"""Runs loops, declarations, messages and Python; and the table of all statements."""

from __future__ import annotations

from ..source import Span
from ..syntax.nodes import (
    BRIDGE,
    GLOBAL,
    LOCAL,
    Body,
    CallNode,
    CommentNode,
    DynamicNode,
    ElementNode,
    ForNode,
    FunctionsNode,
    IfNode,
    IncludeNode,
    InsertNode,
    PartNode,
    PrintNode,
    ProcessNode,
    RobotWordNode,
    TextNode,
    VariablesNode,
)
from ..syntax.signatures import refuse_second_function, variable_name
from ..xml.tree import Comment, Element, Text
from .calls import (
    Function,
    run_call,
    run_insert,
)
from .interpreter import Interpreter
from .loops import iterate, too_many_turns, unpack
from .markup import run_comment, run_dynamic, run_element, run_part, run_ready, run_static, run_text
from .scope import Scope, function_key

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node
    from .interpreter import Handlers


def run_for(
    interpreter: Interpreter, node: ForNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run the body of a loop for each item.

    Raises:
        YamaroError: there are too many turns.
    """
    context = scope.context
    names = node.names
    single = names[0] if len(names) == 1 else None
    most, noted = interpreter.limits.turns, interpreter.noted
    for index, item in enumerate(iterate(node, scope, interpreter.values)):
        if index >= most:
            raise too_many_turns(node.span, interpreter.limits)
        interpreter.statements_left -= 1  # an empty body would count as none
        if interpreter.statements_left < 0:
            raise interpreter.too_many_statements(node.span)
        if single is not None:
            context.declare(single, item, place=node.span)
        else:
            values = unpack(item, index, node, interpreter.evaluator)
            for name, value in zip(names, values, strict=True):
                context.declare(name, value, place=node.span)
        if noted is not None:
            noted.take(context, names, node.span)
        interpreter.run_body(node.body, scope, out)


def run_variables(
    interpreter: Interpreter, node: VariablesNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Declare variables; what was passed in replaces what the file declares."""
    for entry in node.entries:
        name = entry.name
        if not isinstance(name, str):
            name = interpreter.values.joined(name, scope)
            if not name:
                continue
            name = variable_name(name, entry.span)
        place: Span | None = entry.span
        if node.is_root and scope.is_passed_in(name):
            if entry.scope == LOCAL and name in interpreter.shared_names.bridges:
                continue
            value, place = scope.find(name), scope.place_of(name)
        elif len(entry.values) == 1:
            value = interpreter.values.value(entry.values[0], scope)
        else:
            value = [interpreter.values.value(item, scope) for item in entry.values]
        scope.declare(name, value, entry.scope, place)


def run_functions(
    interpreter: Interpreter, node: FunctionsNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Define functions.

    Raises:
        YamaroError: there are two of one name.
    """
    for function in node.functions:
        key = function_key(function.name)
        earlier = scope.find(key)
        if (
            isinstance(earlier, Function)
            and earlier.closure is scope
            and earlier.node is not function
        ):
            refuse_second_function(earlier.node, function)
        defined = Function(function, scope)
        if function.scope in (GLOBAL, BRIDGE):
            interpreter.warn_of_replacement(
                interpreter.shared_names.find(key), defined, key, function.span
            )
        scope.declare(key, defined, function.scope)


def run_print(
    interpreter: Interpreter, node: PrintNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Pass on a message."""
    text = interpreter.values.message(node.value, scope, node.span)
    interpreter.evaluator.guard(interpreter.messages.say, text.removesuffix("\n") + "\n", node.span)


def run_process(
    interpreter: Interpreter, node: ProcessNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run Python."""
    interpreter.evaluator.execute(node.code, scope)


def _run_if_late(
    interpreter: Interpreter, node: IfNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    from .conditions import run_if

    run_if(interpreter, node, scope, out, body)


def _run_include_late(
    interpreter: Interpreter, node: IncludeNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    from .includes import run_include

    run_include(interpreter, node, scope, out, body)


def _run_robot_word_late(
    interpreter: Interpreter, node: RobotWordNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    from .robot_words import run_robot_word

    run_robot_word(interpreter, node, scope, out, body)


HANDLERS: Handlers = {
    ElementNode: run_element,
    Element: run_static,
    Text: run_ready,
    Comment: run_ready,
    TextNode: run_text,
    CommentNode: run_comment,
    PartNode: run_part,
    RobotWordNode: _run_robot_word_late,
    CallNode: run_call,
    InsertNode: run_insert,
    DynamicNode: run_dynamic,
    IfNode: _run_if_late,
    ForNode: run_for,
    IncludeNode: _run_include_late,
    VariablesNode: run_variables,
    FunctionsNode: run_functions,
    PrintNode: run_print,
    ProcessNode: run_process,
}
"""What runs each kind of statement: it is given the conversion, the statement, the scope, the list
that takes what is made, and the body around it."""
