"""Calls: finds the function that is meant, and matches arguments with parameters."""

from __future__ import annotations

from ..diagnostics import Frame, YamaroError, add_trace, failure
from ..namespace import MISSING, Namespace
from ..source import Span
from ..syntax.names import STATEMENTS
from ..syntax.nodes import (
    Argument,
    Body,
    CallNode,
    Constant,
    FunctionNode,
    InsertNode,
    Parameter,
    Value,
)
from ..syntax.python import PythonCode, Template
from ..syntax.statements import parse_body
from ..yaml.nodes import MappingNode, SequenceNode
from .expressions import Values, count
from .scope import BlockScope, Scope, function_key, function_names

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import Any

    from ..fixes import Fix
    from ..syntax.symbol_table import Declaration
    from ..xml.tree import Node
    from .files import Files
    from .interpreter import Interpreter


class Function:
    """A function as defined: what it says, and the context it was defined in."""

    __slots__ = ("closure", "node")

    def __init__(self, node: FunctionNode, closure: Scope) -> None:
        self.node = node
        self.closure = closure


class Block:
    """A block as given to a call: its body, and the context it was written in."""

    __slots__ = ("body", "written")

    def __init__(self, body: Body, written: Scope) -> None:
        self.body = body
        self.written = written


def find_function(
    name: str,
    span: Span,
    scope: Scope,
    where_declared: Callable[[str], list[Declaration]],
) -> Function | Block | None:
    """Return the function or block a call names; None for a block that was not given.

    Raises:
        YamaroError: there is none of that name.
    """
    namespace, _, last = name.rpartition(".") if "." in name else ("", "", name)
    key = function_key(last)
    if namespace:
        found = _namespace(namespace, scope)
        value = MISSING if found is None else found._get(key)
    else:
        value = scope.find(key)
    if value is not MISSING:
        assert value is None or isinstance(value, (Function, Block))
        return value
    from .python_errors import notes_on

    notes = notes_on(f"the function '{last}'", where_declared(last), span)
    from ..diagnostics import meant

    hint, fix = meant(name, function_names(scope), span)
    if hint is None and name.lower() in STATEMENTS:
        hint = f"the statement is written `{name.lower()}:`; the XML element <{name}>:"
    elif hint is None and not notes:
        hint = f"for an XML element of that name, write <{name}>:"
        if scope.context.closure is not None and not namespace:
            hint += f"; declare a block in the function's `input` as **{name}"
    message = f"function '{name}' is not defined"
    raise failure("undefined-function", message, span, hint=hint, notes=notes, fix=fix)


def _namespace(path: str, scope: Scope) -> Namespace | None:
    """Return the namespace of a function's name, which a block finds only where it was written."""
    first, *rest = path.split(".")
    while isinstance(scope, BlockScope) and first not in scope and scope.closure is not None:
        scope = scope.closure
    found = scope.find(first)
    for part in rest:
        found = found._get(part) if isinstance(found, Namespace) else None
    return found if isinstance(found, Namespace) else None


class Match:
    """The arguments of a call by the parameters they go to: known once the function is.

    Attributes:
        node: the function called.
        constants: the values that are known from the text, by the names of their parameters.
        values: each other value with the name of its parameter, in the order of the arguments; if
            it is a single expression, with that.
        blocks: each block with the key of its parameter.
        is_complete: whether every parameter is given something.
        places: where each argument stands, or the parameter that has a default for it.
        frame: the frame of the call when it was reached last, which is mostly that of the next.
    """

    __slots__ = ("blocks", "constants", "frame", "is_complete", "node", "places", "values")

    def __init__(self, node: FunctionNode) -> None:
        """Begin without arguments."""
        self.node = node
        self.constants: dict[str, Any] = {}
        self.values: list[tuple[str, Value, PythonCode | None]] = []
        self.blocks: list[tuple[str, Body]] = []
        self.is_complete = False
        self.places: dict[str, Span] = {}
        self.frame: Frame | None = None


def match_arguments(
    node: FunctionNode, arguments: list[Argument], span: Span, files: Files
) -> Match:
    """Return which argument goes to which parameter.

    Args:
        node: the function called.
        arguments: what the call gives.
        span: the place of the call.
        files: know what parses what can be parsed only now.

    Raises:
        YamaroError: an argument is missing, unknown, given twice or of the wrong kind.
    """
    match = Match(node)
    spans: dict[str, Span] = {}
    parameters = {parameter.name: parameter for parameter in node.parameters}
    positional = [parameter for parameter in node.parameters if not parameter.is_block]
    for index, argument in enumerate(arguments):
        parameter = _parameter_of(argument, index, node, positional, parameters)
        name = parameter.name
        if name in spans:
            raise _bad_call(
                "given-twice",
                f"the argument '{name}' is given twice",
                argument.span,
                node,
                notes=[f"first given at {spans[name].place()}"],
            )
        spans[name] = argument.span
        if parameter.is_block:
            match.blocks.append((function_key(name), _block(argument, node, files)))
        else:
            value = argument.value or files.late.value(argument)
            if isinstance(value, Constant):
                match.constants[name] = value.value
            else:
                only = value.only if isinstance(value, Template) else None
                match.values.append((name, value, only))
    missing = [
        f"'{parameter.name}'"
        for parameter in positional
        if parameter.name not in spans and parameter.default is None
    ]
    if missing:
        what = f"argument{'s' if len(missing) > 1 else ''} {' and '.join(missing)}"
        raise _bad_call("missing-argument", f"'{node.name}' needs the {what}", span, node)
    match.is_complete = len(spans) == len(parameters)
    match.places = {parameter.name: parameter.span for parameter in node.parameters} | spans
    return match


def _parameter_of(
    argument: Argument,
    index: int,
    node: FunctionNode,
    positional: Sequence[Parameter],
    parameters: Mapping[str, Parameter],
) -> Parameter:
    """Return the parameter that an argument is for.

    Raises:
        YamaroError: there is none.
    """
    if argument.name is None:
        if index < len(positional):
            return positional[index]

        raise _bad_call(
            "unknown-argument",
            f"'{node.name}' takes "
            f"{count(len(positional), 'argument')}, but this is number {index + 1}",
            argument.span,
            node,
        )
    parameter = parameters.get(argument.name)
    if parameter is None:
        from ..diagnostics import meant

        hint, fix = meant(argument.name, parameters, argument.span)
        raise _bad_call(
            "unknown-argument",
            f"'{node.name}' has no parameter '{argument.name}'",
            argument.span,
            node,
            hint=hint,
            fix=fix,
        )
    return parameter


def _block(argument: Argument, node: FunctionNode, files: Files) -> Body:
    if argument.block is None:
        if isinstance(argument.node, SequenceNode) and any(
            isinstance(item, MappingNode) for item in argument.node.items
        ):
            context = files.late.context
            parse_body(argument.node, f"the block {argument.name}", context)
            if context.errors:
                raise YamaroError(context.errors)
        raise _bad_call(
            "not-a-body",
            f"the block '{argument.name}' needs a body, not a value",
            argument.node.span() if argument.node is not None else argument.span,
            node,
            hint="write the statements of the block below its name, indented",
        )
    return argument.block


def evaluate_arguments(match: Match, scope: Scope, values: Values) -> dict[str, Any]:
    """Return what the parameters are given, evaluated where the call stands."""
    given = match.constants.copy()
    evaluate = values.evaluator.evaluate
    for name, value, only in match.values:
        if only is not None:
            given[name] = evaluate(only, scope)
        elif type(value) is Template:
            given[name] = values.joined(value, scope)
        else:
            given[name] = values.value(value, scope)
    for key, body in match.blocks:
        given[key] = Block(body, scope)
    return given


def bind(match: Match, given: dict[str, Any], callee: Scope, values: Values) -> None:
    """Give the parameters their values; defaults may use the parameters before them."""
    callee.given_at = match.places
    if match.is_complete:
        dict.update(callee, given)  # the names of a context that has just begun
        return
    for parameter in match.node.parameters:
        key = function_key(parameter.name) if parameter.is_block else parameter.name
        if key in given:
            value = given[key]
        else:
            value = None if parameter.default is None else values.value(parameter.default, callee)
        dict.__setitem__(callee, key, value)


def _bad_call(
    code: str,
    message: str,
    span: Span,
    node: FunctionNode,
    *,
    hint: str | None = None,
    notes: Sequence[str] = (),
    fix: Fix | None = None,
) -> YamaroError:
    note = f"it is defined as {node.signature()} at {node.span.place()}"
    return failure(code, message, span, hint=hint, notes=[*notes, note], fix=fix)


def run_call(
    interpreter: Interpreter, node: CallNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Call a function or block."""
    call(interpreter, node.name, node.arguments, node.span, scope, out)


def run_insert(
    interpreter: Interpreter, node: InsertNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Add what a block that was given contains, or the default."""
    block = scope.find(function_key(node.name))
    if isinstance(block, Block):
        interpreter.run_body(block.body, BlockScope(scope, block.written), out)
    elif node.default is not None:
        interpreter.run_body(node.default, scope, out)


def call(
    interpreter: Interpreter,
    name: str,
    arguments: list[Argument],
    span: Span,
    scope: Scope,
    out: list[Node],
) -> None:
    """Run the body of a function or block in a context of its own.

    Raises:
        YamaroError: it is not defined, its arguments do not match, or its body has errors.
    """
    function = find_function(name, span, scope, interpreter.files.where_declared)
    if isinstance(function, Block):
        interpreter.run_body(function.body, BlockScope(scope, function.written), out)
        return
    if function is None:  # an optional block that was not given
        return
    match = interpreter.matches.get(id(arguments))
    if match is None or match.node is not function.node:
        match = match_arguments(function.node, arguments, span, interpreter.files)
        interpreter.matches[id(arguments)] = match
    closure = function.closure
    callee = Scope(closure.home, interpreter.shared_names, closure=closure, caller=scope.context)
    given = evaluate_arguments(match, scope, interpreter.values)
    home, frame = closure.home.frame, match.frame
    around = interpreter.frame
    if frame is None or frame.parent is not around or frame.home is not home or frame.name != name:
        frame = match.frame = interpreter.step("called", name, span, home)
        frame.places = match.places
    interpreter.enter(frame, span)
    try:
        bind(match, given, callee, interpreter.values)
        if interpreter.noted is not None:
            interpreter.noted.take_parameters(callee, function.node)
        interpreter.run_body(function.node.body, callee, out)
        if callee.kinds:
            for key, value in callee.exported():
                interpreter.receive(scope, key, value, span, callee.place_of(key))
    except YamaroError as error:
        add_trace(error, frame)
        raise
    except RecursionError:
        raise interpreter.too_deep(span) from None
    finally:
        interpreter.leave(frame)
