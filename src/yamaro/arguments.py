"""What a build is asked for with: variables, and codes to allow and deny."""

from __future__ import annotations

from functools import wraps

from .diagnostics import Adjustment, Reporter, YamaroError, did_you_mean
from .runtime.predefined import plain_data
from .source import COMMAND_LINE, KEYWORD_ARGUMENT, Source, Span
from .syntax.context import ParseContext
from .syntax.names import is_identifier, python_name
from .syntax.values import parse_inline
from .xml.values import format_value
from .yaml.nodes import PLAIN, ScalarNode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from typing import Any, TypeVar

    Function = TypeVar("Function", bound=Callable[..., Any])


class UsageError(Exception):
    """The command was used wrongly: the main file is missing, or an argument is malformed."""


def explains_variables(how: str) -> Callable[[Function], Function]:
    """Let a function that is called with variables among its arguments say how to pass them.

    Args:
        how: what to write, where `{name}` is a variable and `{value}` its value.
    """

    def decorate(function: Function) -> Function:
        known = list(function.__kwdefaults__ or ())
        count: int = function.__code__.co_argcount

        @wraps(function)
        def checked(*positional: Any, **named: Any) -> Any:
            for name, value in named.items():
                if name not in known and name not in function.__code__.co_varnames[:count]:
                    hint = did_you_mean(name, known)
                    remedy = how.format(name=name, value=repr(value))
                    raise TypeError(
                        f"{function.__name__}() has no argument '{name}'; "
                        + (f"{hint} " if hint else "")
                        + f"a variable of the file is passed by {remedy}"
                    )
            for value in positional[count:]:
                name, separator, text = str(value).partition(":=")
                remedy = how.format(name=name if separator else "name", value=text or "…")
                raise TypeError(
                    f"{function.__name__}() takes no argument {value!r} here; "
                    f"a variable of the file is passed by {remedy}"
                )
            return function(*positional, **named)

        return checked  # type: ignore[return-value]

    return decorate


def merged_variables(variables: object, named: Mapping[str, object]) -> dict[str, object]:
    """Return the variables of `variables=` and those that are arguments by name, which win."""
    try:
        given: Mapping[str, object] = dict(variables or {})  # type: ignore[call-overload]
    except (TypeError, ValueError):
        raise TypeError(
            "variables= takes a dict of variables; pass a variable that is called 'variables' in "
            "it: variables={'variables': …}"
        ) from None
    return {**given, **named}


def adjustment_of(
    allow: Iterable[str], deny: Iterable[str], *, is_strict: bool = False
) -> Adjustment:
    """Return which codes are allowed and denied; a lone text is one code.

    Raises:
        UsageError: a code is unknown, always an error, or both allowed and denied.
    """
    allowed = frozenset([allow] if isinstance(allow, str) else allow)
    denied = frozenset([deny] if isinstance(deny, str) else deny)
    for code in (*allowed, *denied):
        if not isinstance(code, str):
            raise UsageError(f"a code to allow or deny must be a text, not {code!r}")
    if allowed or denied:
        from .codes import fault_of_codes

        fault = fault_of_codes(allowed, denied)
        if fault is not None:
            raise UsageError(fault)
    return Adjustment(allowed, denied, is_strict=is_strict)


def read_arguments(
    command_line: Sequence[str], variables: Mapping[str, object], *, is_xml: bool
) -> tuple[dict[str, object], dict[str, Span]]:
    """Return the variables passed to the main file, and where each name is written.

    Args:
        command_line: variables as `name:=value`.
        variables: variables as Python objects; they replace those of the command line.
        is_xml: the main file is URDF or xacro, whose arguments are texts.

    Raises:
        UsageError: a `name:=value` is malformed.
    """
    if is_xml:
        values, places = _read_texts(command_line)
        values.update({name: format_value(value) for name, value in variables.items()})
    else:
        values, places = read_command_line(command_line)
        values.update(variables)
    for name in variables:
        places[name] = Span(Source(f"{name}=…", name=KEYWORD_ARGUMENT), 0, len(name))
    return values, places


def read_command_line(arguments: Sequence[str]) -> tuple[dict[str, object], dict[str, Span]]:
    """Return the variables given as `name:=value`, and where each name stands."""
    values: dict[str, object] = {}
    places: dict[str, Span] = {}
    for argument in arguments:
        name, separator, _ = argument.partition(":=")
        if not separator or not is_identifier(name):
            raise UsageError(f"'{argument}' is not of the form name:=value")
        source = Source(argument, name=COMMAND_LINE)
        node = ScalarNode(argument, PLAIN, source, 0, len(argument))
        reporter = Reporter()
        try:
            context = ParseContext(reporter)
            start = len(name) + 2
            value = parse_inline(node, start, len(argument), context, is_literal=True)
            values[python_name(name)] = plain_data(value)
        except YamaroError as error:
            raise UsageError(f"'{argument}': {error.diagnostics[0].message}") from None
        places[python_name(name)] = Span(source, 0, len(name))
    return values, places


def _read_texts(command_line: Sequence[str]) -> tuple[dict[str, object], dict[str, Span]]:
    """Return the arguments of a xacro file, as they are written, and where each name is."""
    values: dict[str, object] = {}
    places: dict[str, Span] = {}
    for argument in command_line:
        name, separator, value = argument.partition(":=")
        if not separator or not name:
            raise UsageError(f"'{argument}' is not of the form name:=value")
        values[name] = value
        places[name] = Span(Source(argument, name=COMMAND_LINE), 0, len(name))
    return values, places
