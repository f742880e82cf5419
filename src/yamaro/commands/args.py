"""`yamaro args FILE` and `yamaro FILE --help-args`: arguments and variables of a file."""

from __future__ import annotations

import json

from ..declared_arguments import ARGUMENTS, Declared, Listing
from ..streams import Streams
from ..syntax.argument_section import (
    BOOLEAN,
    INTEGER,
    LIST,
    MAPPING,
    NUMBER,
    NUMERIC,
    PATH,
    TEXT,
)
from .arguments import Arguments, make_policy, read_packages
from .conversion import end_process, read_pipe
from .reports import INPUT_ERROR, WrongUsage, deliver, show

Json = dict[str, object]


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the listing of the file to standard output; return the exit status."""
    from ..diagnostics import YamaroError
    from ..options import UsageError

    if arguments.assignments:
        raise WrongUsage("a list of arguments does not depend on 'name:=value'")
    policy = make_policy(arguments)
    if streams.owns_process:
        from ..sandbox.process import bound_memory

        bound_memory(policy.limits.memory)
        if policy.timeout is not None:
            end_process(arguments, streams, policy, policy.timeout)
    try:
        from ..declared_arguments import listing_of, listing_text
        from ..files.loader import FileLoader
        from ..request import finder_for, reach_of, read_main
        from ..runtime.files import Library

        path = arguments.words[0]
        packages = read_packages(arguments)
        reach = reach_of(path, policy, packages)
        loader = FileLoader(policy.limits, reach)
        source = read_main(path, read_pipe(path, policy), Library(loader))
        finder = finder_for(path, reach, packages)
        listing = listing_of(source, loader=loader, packages=finder, limits=policy.limits)
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    text = schema_text(listing) if arguments.has("json") else listing_text(listing)
    return deliver([text], arguments, streams)


# --- what may be passed to a file, as a JSON Schema (2020-12) ---------------------------------


DIALECT = "https://json-schema.org/draft/2020-12/schema"
_TYPES = {
    NUMBER: "number",
    INTEGER: "integer",
    TEXT: "string",
    BOOLEAN: "boolean",
    LIST: "array",
    MAPPING: "object",
    PATH: "string",
}


def schema_text(listing: Listing) -> str:
    """Return the schema of the values that a file takes, as JSON.

    Numbers are in the units of their arguments, which `x-unit` names; `x-step` and `x-log` are for
    sliders.
    """
    return json.dumps(schema_of(listing), indent=2, ensure_ascii=False, default=str) + "\n"


def schema_of(listing: Listing) -> Json:
    """Return the schema of the values that a file takes."""
    schema: Json = {
        "$schema": DIALECT,
        "type": "object",
        "properties": {each.name: _property(each) for each in listing.declared},
    }
    required = [each.name for each in listing.declared if each.is_required]
    if required:
        schema["required"] = required
    schema["additionalProperties"] = listing.kind != ARGUMENTS
    return schema


def _property(declared: Declared) -> Json:
    told: Json = {}
    if (entry := declared.entry) is not None:
        if entry.help:
            told["description"] = entry.help
        if entry.kind in _TYPES:
            kind = _TYPES[entry.kind]
            told["type"] = [kind, "null"] if entry.is_null_allowed else kind
        if entry.kind == PATH:
            told["format"] = "path"
        if entry.choices is not None:
            choices = [
                entry.in_unit(choice)
                if entry.kind in NUMERIC and isinstance(choice, (int, float))
                else choice
                for choice in entry.choices
            ]
            told["enum"] = [*choices, None] if entry.is_null_allowed else choices
        numbers = {"minimum": entry.low, "maximum": entry.high, "x-step": entry.step}
        for word, number in numbers.items():
            if number is not None:
                told[word] = entry.in_unit(number)
        if entry.is_log:
            told["x-log"] = True
        if entry.unit_text:
            told["x-unit"] = entry.unit_text
    if declared.has_value:
        told["default"] = declared.default
    elif declared.default_text is not None:
        told["x-default"] = declared.default_text
    return told
