"""Parses what declares and passes names: `variables`, `input`, the arguments of calls."""

from __future__ import annotations

from ..diagnostics import failure, given_twice, unknown_word
from ..source import Span
from ..yaml.nodes import MappingNode, ScalarNode
from .context import ParseContext
from .keys import find_outside, trim
from .names import bad_variable_name, is_function_name, is_identifier, name_hint, python_name
from .nodes import SCOPES, Argument, FunctionNode, Parameter, Value, VariableEntry, VariablesNode
from .python import parse_template
from .values import is_empty, pairs_of, parse_inline, parse_value, split_inline

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import NoReturn

    from ..yaml.nodes import YamlNode


# --- `variables`, and the scopes of declared names --------------------------------------------


def split_scope(key: ScalarNode, what: str) -> tuple[int, str]:
    """Return where the name in `name/scope` ends, and the scope.

    Raises:
        YamaroError: the scope does not exist.
    """
    text = key.text
    slash = find_outside(text, "/", 0, len(text))
    if slash < 0:
        return len(text), "local"
    scope = text[slash + 1 :].strip()
    if scope not in SCOPES:
        raise unknown_word(
            "unknown-scope",
            f"'{scope}' is not a scope of a {what}",
            key.span(slash + 1) if scope else key.span(),
            scope,
            SCOPES,
            hint=f"the scopes are {', '.join(SCOPES)}",
        )
    return slash, scope


def parse_variables(key: ScalarNode, node: YamlNode, context: ParseContext) -> VariablesNode:
    """Return a `variables:` statement; what is wrong with one entry does not hide the others."""
    entries: dict[str, VariableEntry] = {}
    every: list[VariableEntry] = []
    for own, value in pairs_of(node, "`variables`", context):
        entry = context.attempt(_parse_variable, own, value, context)
        if entry is None:
            continue
        if isinstance(entry.name, str):
            earlier = entries.get(entry.name)
            if earlier is not None:
                if earlier.scope == entry.scope:
                    earlier.values.extend(entry.values)
                    continue
                scopes = f"{earlier.scope} and {entry.scope}"
                fault = failure(
                    "given-twice",
                    f"'{entry.name}' is declared here with two scopes, {scopes}",
                    entry.span,
                    notes=[f"first declared at {earlier.span.place()}"],
                )
                context.keep(fault)
                continue
            entries[entry.name] = entry
        every.append(entry)
    return VariablesNode(every, is_root=False, span=key.span())


def _parse_variable(key: ScalarNode, node: YamlNode, context: ParseContext) -> VariableEntry:
    value = parse_value(node, context)
    end, scope = split_scope(key, "variable")
    while end > 0 and key.text[end - 1].isspace():
        end -= 1
    name = parse_template(key, 0, end, context=context)
    span = key.span(0, end) if end else key.span()
    if isinstance(name, str):
        name = variable_name(name, span)
    return VariableEntry(name, scope, [value], span)


def variable_name(name: str, span: Span) -> str:
    """Return a variable's name as Python spells it.

    Raises:
        YamaroError: it cannot name a variable.
    """
    if not is_identifier(name):
        raise failure("bad-variable-name", bad_variable_name(name), span, hint=name_hint(name))
    return python_name(name)


# --- `input`, and the arguments of calls ------------------------------------------------------


def parse_input(node: YamlNode, context: ParseContext) -> list[Parameter]:
    """Return the parameters that `input:` declares, as a text or a list.

    Raises:
        YamaroError: a parameter is misspelt or declared twice.
    """
    if is_empty(node):
        return []
    if isinstance(node, MappingNode):
        raise failure(
            "bad-input",
            "`input` needs a list of names, not a mapping",
            node.span(),
            hint="write input: side, length=1.0, **Block",
        )
    scalars = [node] if isinstance(node, ScalarNode) else node.items
    parameters: list[Parameter] = []
    seen: dict[str, Parameter] = {}
    for scalar in scalars:
        if not isinstance(scalar, ScalarNode):
            raise failure(
                "bad-input",
                "a parameter is a name, a name=default or a **Block",
                scalar.span(),
                hint="write a default after an equals sign: length=1.0"
                if isinstance(scalar, MappingNode)
                else "quote a parameter whose default contains brackets: 'sizes=[1, 2]'",
            )
        stretches = split_inline(scalar) if scalar is node else [(0, len(scalar.text))]
        for start, end in stretches:
            parameter = context.attempt(_parse_parameter, scalar, start, end, context)
            if parameter is None:
                continue
            earlier = seen.get(parameter.name)
            if earlier is not None:
                raise failure(
                    "given-twice",
                    f"the parameter '{parameter.name}' is declared twice",
                    parameter.span,
                    notes=[f"first declared at {earlier.span.place()}"],
                )
            seen[parameter.name] = parameter
            parameters.append(parameter)
    return parameters


def _parse_parameter(node: ScalarNode, start: int, end: int, context: ParseContext) -> Parameter:
    text = node.text
    start, end = trim(text, start, end)
    written = text[start:end]
    if not written:
        raise failure(
            "bad-input",
            "a parameter is missing here",
            node.span(max(start - 1, 0), max(start, 1)) if text else node.span(),
            hint="write commas only between parameters",
        )
    span = node.span(start, end)
    if written.startswith("*"):
        name = written.lstrip("*").strip()
        stars = len(written) - len(written.lstrip("*"))
        if stars != 2:
            raise failure(
                "bad-input",
                f"a block has two stars, not {stars}",
                span,
                hint=f"write **{name}",
            )
        if not is_identifier(name) or not name[0].isupper():
            raise failure(
                "bad-input",
                f"'{name}' cannot be the name of a block",
                span,
                hint=f"a block's name begins with a capital letter, and it has no default: "
                f"**{name[:1].upper()}{name[1:].partition('=')[0]}",
            )
        return Parameter(name, None, is_block=True, span=span, text=written)
    equals = find_outside(text, "=", start, end)
    name_end = equals if equals >= 0 else end
    name = text[start:name_end].rstrip().removesuffix(":").rstrip()
    if not is_identifier(name):
        raise failure(
            "bad-input",
            f"'{name}' cannot be the name of a parameter",
            node.span(start, max(name_end, start + 1)),
            hint=_parameter_hint(name),
        )
    default: Value | None = None
    if equals >= 0:
        default = parse_inline(node, equals + 1, end, context)
    return Parameter(python_name(name), default, is_block=False, span=span, text=written)


def _parameter_hint(name: str) -> str:
    """Return how to spell a parameter whose name is not valid, such as `length 0.5`."""
    first, space, rest = name.partition(" ")
    if not space or not is_identifier(first):
        return name_hint(name)
    if is_identifier(rest.strip()):
        rest = rest.strip()
        return f"write {first}_{rest} for one name, or {first}, {rest} for two parameters"
    return f"write a default after =: {first}={rest.strip()}"


def parse_short_arguments(node: ScalarNode, context: ParseContext) -> list[Argument]:
    """Return the arguments of a short call: `right, length=0.8`.

    Raises:
        YamaroError: one is missing between commas, or a positional one follows a named one.
    """
    arguments: list[Argument] = []
    text = node.text
    for start, end in split_inline(node):
        start, end = trim(text, start, end)
        if start == end:
            raise failure(
                "bad-argument",
                "an argument is missing here",
                node.span(max(start - 1, 0), max(start, 1)),
                hint="write commas only between arguments; an empty text is ''",
            )
        equals = find_outside(text, "=", start, end)
        word = text[start:equals].rstrip().removesuffix(":").rstrip() if equals >= 0 else ""
        is_named = is_identifier(word) and not text.startswith("==", equals)
        name = python_name(word) if is_named else None
        argument = Argument(name, None, node.span(start, end))
        argument.value = parse_inline(node, equals + 1 if is_named else start, end, context)
        if name is None and arguments and arguments[-1].name is not None:
            raise failure(
                "bad-argument",
                "an argument without a name follows one with a name",
                argument.span,
                hint="put the arguments without a name first",
            )
        arguments.append(argument)
    return arguments


def parse_argument_name(key: ScalarNode, context: ParseContext) -> str:
    """Return the name an argument is given under.

    Raises:
        YamaroError: it is not a name.
    """
    name = parse_template(key, context=context)
    if isinstance(name, str) and is_identifier(name.strip()):
        return python_name(name.strip())
    raise failure(
        "bad-argument",
        f"'{key.text}' cannot be the name of an argument",
        key.span(),
        hint="write arguments as name: value; write statements and elements under a block's name"
        if isinstance(name, str)
        else "the names of arguments are fixed; compute their values",
    )


def refuse_repeated(arguments: Iterable[Argument]) -> None:
    """Raise YamaroError if one of the named arguments of a call is given twice."""
    seen: dict[str, Argument] = {}
    for argument in arguments:
        assert argument.name is not None
        if argument.name in seen:
            raise given_twice(
                f"the argument '{argument.name}' is given twice",
                argument.span,
                seen[argument.name].span,
                hint="keep one of the two",
            )
        seen[argument.name] = argument


# --- functions --------------------------------------------------------------------------------


def parse_function_name(key: ScalarNode, *, has_signature: bool) -> tuple[str, str]:
    """Return the name and the scope in the key of a function, with its parameters or without.

    Raises:
        YamaroError: it cannot name a function.
    """
    if has_signature:
        from .heads import scope_behind

        name, scope = key.text.partition("(")[0].strip(), scope_behind(key)
    else:
        end, scope = split_scope(key, "function")
        name = key.text[:end].strip()
    if not is_function_name(name) or "." in name:
        raise failure(
            "bad-function-name",
            f"'{name}' cannot be the name of a function",
            key.span(),
            hint=f"a function's name begins with a capital letter: {name[:1].upper()}{name[1:]}"
            if is_identifier(name)
            else "a function's name is one word that begins with a capital letter",
        )
    return name, scope


def refuse_second_function(first: FunctionNode, second: FunctionNode) -> NoReturn:
    """Raise YamaroError for a function that is defined twice in one context."""
    raise failure(
        "defined-twice",
        f"the function '{second.name}' is defined twice",
        second.span,
        hint="give one of them another name",
        notes=[f"first defined at {first.span.place()}"],
    )
