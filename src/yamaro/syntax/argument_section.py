"""Parses the section `arguments`; which values an argument takes, by type, range and choices."""

from __future__ import annotations

from ..diagnostics import InputFault, Reporter, YamaroError, did_you_mean, failure, suggest
from ..units import (
    UNITS,
    UnknownUnit,
    fits,
    name_of,
    parse_quantity,
    parse_unit,
    plural_of,
    units_of,
)
from ..xml.values import format_value, is_number, plain_value
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode, type_plain
from ..yaml.reader import read
from .context import ParseContext, Rules
from .names import bad_variable_name, is_identifier, name_hint, python_name
from .nodes import Constant, DictValue, Document, ListValue, Value, VariablesNode
from .python import Template
from .values import pairs_of, parse_value, refuse_twice

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..fixes import Fix
    from ..source import Source, Span
    from ..units import Dimension, Unit
    from ..yaml.nodes import YamlNode
    from .nodes import Document


# --- the types of arguments -------------------------------------------------------------------


NUMBER, INTEGER, TEXT, BOOLEAN = "number", "integer", "text", "boolean"
LIST, MAPPING, PATH = "list", "mapping", "path"
TYPES = (NUMBER, INTEGER, TEXT, BOOLEAN, LIST, MAPPING, PATH)
ANY = "any"
"""The type of an argument that takes whatever is passed; it cannot be written."""
NUMERIC = (NUMBER, INTEGER)

_WANTED = {
    NUMBER: "a number",
    INTEGER: "an integer",
    TEXT: "a text",
    BOOLEAN: "true or false",
    LIST: "a list",
    MAPPING: "a mapping",
    PATH: "a path",
}
_EXAMPLES = {
    LIST: "write [a, b], or one item per line after a dash",
    MAPPING: "write {name: value}",
    BOOLEAN: "write true or false",
}
LONGEST_SHOWN = 40
"""Characters of a value that a message shows."""
MOST_SHOWN = 8
"""Choices that a message lists."""


class ArgumentEntry:
    """An argument that a file declares.

    Attributes:
        name: as expressions know it.
        kind: one of `TYPES`, or `ANY`.
        default: the value without an argument; None if the argument is required.
        is_null_allowed: whether the argument may be null, because its default is.
        unit: the unit of numbers without one; None for SI.
        unit_text: the unit as it is written.
        choices: the values allowed, in SI, or None for any.
        low: the least number, in SI, or None.
        high: the greatest one.
        step: by how much a slider changes the number, in SI, or None.
        is_log: whether a slider is logarithmic.
        help: what the argument is for.
    """

    __slots__ = (
        "choices", "default", "help", "high", "is_log", "is_null_allowed", "kind", "low", "name",
        "span", "step", "unit", "unit_text",
    )  # fmt: skip

    def __init__(self, name: str, span: Span) -> None:
        """Declare a required argument of any value."""
        self.name = name
        self.span = span
        self.kind = ANY
        self.default: Value | None = None
        self.is_null_allowed = False
        self.unit: Unit | None = None
        self.unit_text = ""
        self.choices: list[object] | None = None
        self.low: float | None = None
        self.high: float | None = None
        self.step: float | None = None
        self.is_log = False
        self.help = ""

    def in_unit(self, number: float) -> float:
        """Return a number in SI as one in the argument's unit, to 15 digits."""
        if self.unit is None or self.unit.is_si:
            return number
        value = float(f"{self.unit.from_si(number):.15g}")
        return int(value) if value.is_integer() and abs(value) < 1e15 else value

    def range_text(self) -> str:
        """Return the range in words: "from 0.3 to 1.3 m"."""
        unit = f" {self.unit_text}" if self.unit_text else ""
        low = "" if self.low is None else format_value(self.in_unit(self.low))
        high = "" if self.high is None else format_value(self.in_unit(self.high))
        if not high:
            return f"of at least {low}{unit}" if low else ""
        return f"from {low} to {high}{unit}" if low else f"of at most {high}{unit}"

    def choice_texts(self) -> list[str]:
        """Return the choices as they are written on the command line."""
        return [self.value_text(choice) for choice in self.choices or ()]

    def value_text(self, value: object) -> str:
        """Return a plain value in SI as it is written on the command line, in the unit."""
        if value is None:
            return "null"
        if self.kind in NUMERIC and isinstance(value, (int, float)):
            return format_value(self.in_unit(value))
        if isinstance(value, (list, tuple)):
            return f"[{', '.join(map(self.value_text, value))}]"
        if isinstance(value, dict):
            pairs = (f"{format_value(key)}: {self.value_text(each)}" for key, each in value.items())
            return f"{{{', '.join(pairs)}}}"
        return format_value(value)


def checked(
    entry: ArgumentEntry, value: object, *, spelling: str | None = None, is_si: bool = False
) -> object:
    """Return a value as the argument has it, in SI.

    Args:
        entry: the argument.
        value: what is passed.
        spelling: how it is written, if it is a scalar that was written for this argument.
        is_si: a number without a unit is in SI, since an expression gave it.

    Raises:
        InputFault: the argument does not take it.
    """
    value = plain_value(value)
    if value is None and entry.is_null_allowed:
        return None
    read = _READERS.get(entry.kind)
    if read is not None:
        value = read(entry, value, spelling, is_si)
    if entry.low is not None or entry.high is not None:
        assert isinstance(value, (int, float)), "only numbers have a range"
        number = _rounded(value)
        is_below = entry.low is not None and number < _rounded(entry.low)
        is_above = entry.high is not None and number > _rounded(entry.high)
        if is_below or is_above:
            raise InputFault(
                "argument-range",
                f"'{entry.name}' takes {_wanted(entry)}, not {_in_words(entry, value)}",
            )
    if entry.choices is not None and not any(same_value(value, each) for each in entry.choices):
        texts = entry.choice_texts()
        takes = " or ".join([", ".join(texts[:-1]), texts[-1]] if len(texts) > 1 else texts)
        if len(texts) > MOST_SHOWN:
            takes = f"one of {', '.join(texts[:MOST_SHOWN])}, …"
        raise InputFault(
            "argument-choice",
            f"'{entry.name}' takes {takes}, not {_in_words(entry, value)}",
            did_you_mean(value, texts) if isinstance(value, str) else None,
        )
    return value


def quantity(entry: ArgumentEntry, value: object, *, is_si: bool = False) -> float:
    """Return a number, or a text that reads as one, in SI.

    Raises:
        InputFault: it is neither, or its unit does not fit the argument.
    """
    number, dimension = _number_of(entry, value)
    unit = entry.unit
    if dimension is not None:
        if unit is not None and not fits(dimension, unit.dimension):
            raise InputFault(
                "unit-dimension",
                f"'{_shown(value)}' is {name_of(dimension)}; '{entry.name}' takes "
                f"{plural_of(unit.dimension)}",
                f"write it in {entry.unit_text}",
            )
        return number
    if unit is None or is_si:
        return number
    try:
        return unit.to_si(number)
    except OverflowError:
        raise _wrong_type(entry, value) from None


def same_value(one: object, other: object) -> bool:
    """Return whether two values are the same choice; numbers are compared to 15 digits."""
    if isinstance(one, bool) or isinstance(other, bool):
        return one is other
    if is_number(one) and is_number(other):
        return _rounded(one) == _rounded(other)
    return type(one) is type(other) and one == other


def _rounded(number: object) -> float:
    """Return a number to 15 digits, as it is written; so 0.1 + 0.2 is 0.3."""
    if isinstance(number, float):
        return float(f"{number:.15g}")
    assert isinstance(number, int)
    return number


def _number_of(entry: ArgumentEntry, value: object) -> tuple[float, Dimension | None]:
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        if isinstance(value, float) and value - value != 0:
            raise _wrong_type(entry, value, "a finite number")
        return value, None
    if not isinstance(value, str):
        raise _wrong_type(entry, value)
    try:
        return parse_quantity(value)
    except UnknownUnit as fault:
        wanted = units_of(entry.unit.dimension) if entry.unit is not None else None
        raise unknown_unit(fault.unit, wanted) from None
    except (ValueError, OverflowError):
        raise _wrong_type(entry, value) from None


def unknown_unit(word: str, wanted: list[str] | None = None) -> InputFault:
    """Return the fault of a unit that is not known; `wanted` are those that would fit."""
    hint = did_you_mean(word, wanted or UNITS) or did_you_mean(word, UNITS)
    listed = ", ".join(wanted or UNITS)
    return InputFault("unknown-unit", f"'{word}' is not a unit", hint or f"units are {listed}")


# --- one reader for each type -----------------------------------------------------------------


def _read_number(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    return quantity(entry, value, is_si=is_si)


def _read_integer(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    try:
        number, dimension = _number_of(entry, value)
    except InputFault as fault:
        raise (_wrong_type(entry, value) if fault.code == "unknown-unit" else fault) from None
    if dimension is not None or number != int(number):
        raise _wrong_type(entry, value)
    return int(number)


def _read_text(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if isinstance(value, str):
        return value
    if spelling is not None:
        return spelling
    if not isinstance(value, (bool, int, float)):
        raise _wrong_type(entry, value)
    try:
        return format_value(value)
    except ValueError:  # an integer of thousands of digits
        raise _wrong_type(entry, value) from None


def _read_boolean(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if not isinstance(value, bool):
        raise _wrong_type(entry, value)
    return value


def _read_list(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if not isinstance(value, (list, tuple)):
        raise _wrong_type(entry, value)
    return value


def _read_mapping(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if not isinstance(value, dict):
        raise _wrong_type(entry, value)
    return value


_READERS = {
    NUMBER: _read_number,
    INTEGER: _read_integer,
    TEXT: _read_text,
    BOOLEAN: _read_boolean,
    LIST: _read_list,
    MAPPING: _read_mapping,
    PATH: _read_text,
}


# --- words ------------------------------------------------------------------------------------


def _wrong_type(entry: ArgumentEntry, value: object, wanted: str | None = None) -> InputFault:
    hint = _EXAMPLES.get(entry.kind)
    if entry.kind in NUMERIC and isinstance(value, str) and is_number(_typed(value)):
        hint = None
    if entry.kind == BOOLEAN and isinstance(value, str) and value.lower() in ("yes", "no"):
        hint = f"YAML 1.2 reads '{value}' as a text; write {str(value.lower() == 'yes').lower()}"
    return InputFault(
        "argument-type",
        f"'{entry.name}' takes {wanted or _wanted(entry)}, not {in_words(value)}",
        hint,
    )


def _typed(text: str) -> object:
    try:
        return type_plain(text)
    except OverflowError:
        return text


def _wanted(entry: ArgumentEntry) -> str:
    """Return what an argument takes, in words."""
    words = _WANTED.get(entry.kind, "a value")
    bounds = entry.range_text()
    if bounds:
        return f"{words} {bounds}"
    return f"{words} in {entry.unit_text}" if entry.unit_text else words


def _in_words(entry: ArgumentEntry, value: object) -> str:
    """Return a value that has been read, in the argument's unit, in words."""
    if entry.kind == NUMBER and isinstance(value, (int, float)):
        return in_words(entry.in_unit(value))
    return in_words(value)


def in_words(value: object) -> str:
    """Return a value, or what it is, in words for a message."""
    if value is None:
        return "null"
    if isinstance(value, (bool, int, float, str)):
        text = _shown(value)
        return f"'{text}'" if isinstance(value, str) else text
    if isinstance(value, (list, tuple)):
        return "a list"
    if isinstance(value, dict):
        return "a mapping"
    return f"a value of the type {type(value).__name__}"


def _shown(value: object) -> str:
    try:
        text = format_value(value)
    except ValueError:  # an integer of thousands of digits
        return "a huge integer"
    return text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 1] + "…"


# --- the section ------------------------------------------------------------------------------


ENTRIES = ("default", "type", "choices", "range", "unit", "help", "step", "log")
_OF_NUMBERS = ("range", "unit", "step", "log")
_OTHER_WORDS = {
    "description": "help", "doc": "help", "enum": "choices", "options": "choices",
    "values": "choices", "value": "default", "min": "range", "max": "range", "limits": "range",
    "units": "unit", "kind": "type", "required": "type",
}  # fmt: skip
_OTHER_TYPES = {
    "float": "number", "double": "number", "int": "integer", "str": "text", "string": "text",
    "bool": "boolean", "array": "list", "dict": "mapping", "object": "mapping", "file": "path",
}  # fmt: skip


def parse_arguments(node: YamlNode, document: Document, context: ParseContext) -> None:
    """Add the entries of an `arguments:` section to a document.

    What is wrong with one entry does not hide the others.

    Raises:
        YamaroError: the section is not a mapping.
    """
    if document.arguments is None:
        document.arguments = []
    for key, value in pairs_of(node, "`arguments`", context):
        entry = context.attempt(_parse_entry, key, value, document, context)
        if entry is not None:
            document.arguments.append(entry)
            document.argument_spans[entry.name] = entry.span


def refuse_variables_of_same_name(document: Document, context: ParseContext) -> None:
    """Keep an error for each name that is in `arguments` and in the root's `variables`."""
    places = {entry.name: entry.span for entry in document.arguments or ()}
    for section in document.sections:
        for variable in section.entries if isinstance(section, VariablesNode) else ():
            name = variable.name
            if isinstance(name, str) and name in places:
                fault = failure(
                    "given-twice",
                    f"'{name}' is an argument and a variable of this file",
                    variable.span,
                    hint="keep only the argument, and write its default there",
                    notes=[f"the argument is declared at {places[name].place()}"],
                )
                context.keep(fault)


def arguments_of(source: Source) -> list[ArgumentEntry] | None:
    """Return the arguments that a file declares, without parsing the rest of it.

    A file without the section gives None.

    Raises:
        YamaroError: the file is not YAML, or the section has errors.
    """
    context = ParseContext(Reporter(), Rules())
    document = Document(source)
    root = read(source, reporter=context.reporter)
    for item in root.items if isinstance(root, SequenceNode) else [root]:
        for key, node in item.pairs if isinstance(item, MappingNode) else ():
            if key.text == "arguments":
                context.attempt(parse_arguments, node, document, context)
    if context.errors:
        raise YamaroError(context.errors)
    return document.arguments


# --- one entry ----------------------------------------------------------------------------------


def _parse_entry(
    key: ScalarNode, node: YamlNode, document: Document, context: ParseContext
) -> ArgumentEntry:
    name = key.text.strip()
    if not is_identifier(name):
        hint: str | None = name_hint(name)
        if "$(" in name:
            hint = "arguments are read without running the file, so their names cannot be computed"
        before, slash, scope = name.partition("/")
        if slash and is_identifier(before):
            passed = f"`variables: {{NAME/{scope}: $({before})}}`"
            hint = f"an argument has no scope; pass it on with {passed}"
        raise failure("bad-variable-name", bad_variable_name(name), key.span(), hint=hint)
    name = python_name(name)
    earlier = document.argument_spans.get(name)
    if earlier is not None:
        raise failure(
            "given-twice",
            f"the argument '{name}' is declared twice",
            key.span(),
            hint="keep one of the two",
            notes=[f"first declared at {earlier.place()}"],
        )
    entry = ArgumentEntry(name, key.span())
    if isinstance(node, MappingNode) and any(own.text in ENTRIES for own, _ in node.pairs):
        _parse_long(entry, node, context)
    else:
        entry.default = parse_value(node, context)
        _settle_kind(entry, None)
    if entry.default is not None and is_literal(entry.default):
        _checked(entry, entry.default)
    return entry


def _parse_long(entry: ArgumentEntry, node: MappingNode, context: ParseContext) -> None:
    """Fill in an entry from a mapping of `ENTRIES`; collect the errors in it."""
    found = _entries_of(node)
    literal = {
        name: parse_value(value, context, is_literal=True)
        for name, (_, value) in found.items()
        if name != "default"
    }
    if "default" in found:
        entry.default = parse_value(found["default"][1], context)
    entry.help = _text_of(literal.get("help"))
    _parse_kind(entry, literal, found)
    for name in _OF_NUMBERS:
        allowed = (NUMBER,) if name == "unit" else NUMERIC
        if name in found and entry.kind not in allowed:
            needs = "a number" if name == "unit" else "a number or an integer"
            raise _bad(
                f"`{name}` is only for an argument that is {needs}, and '{entry.name}' is "
                f"{'of any type' if entry.kind == ANY else f'of the type {entry.kind}'}",
                found[name][0].span(),
                hint="write type: number, or remove it",
            )
    if "unit" in literal:
        entry.unit_text, span = _text_of(literal["unit"]).strip(), found["unit"][1].span()
        try:
            entry.unit = parse_unit(entry.unit_text)
        except UnknownUnit as fault:
            told = unknown_unit(fault.unit)
            raise failure(told.code, told.message, span, hint=told.hint) from None
        except ValueError:
            is_there = bool(entry.unit_text)
            raise _bad(
                f"'{entry.unit_text}' is not a unit" if is_there else "`unit` takes a unit",
                span,
                hint="write a unit such as mm, deg or N*m",
            ) from None
    if "range" in literal:
        _parse_range(entry, literal["range"], found["range"][1])
    if "step" in literal:
        entry.step = _number(entry, literal["step"])
        if entry.step <= 0:
            raise _bad("`step` needs a number greater than 0", found["step"][1].span())
    if "log" in literal:
        _parse_log(entry, literal["log"], found["log"][1])
    if "choices" in literal:
        _parse_choices(entry, literal["choices"], found["choices"][1])


def _entries_of(node: MappingNode) -> dict[str, tuple[ScalarNode, YamlNode]]:
    found: dict[str, tuple[ScalarNode, YamlNode]] = {}
    for key, value in node.pairs:
        word = key.text
        if word not in ENTRIES:
            from ..fixes import respelling

            near = _OTHER_WORDS.get(word.lower()) or suggest(word, ENTRIES)
            hint = f"did you mean '{near}'?" if near else None
            raise failure(
                "unknown-key",
                f"an argument has no entry '{word}'",
                key.span(),
                hint=hint
                or f"its entries are {', '.join(ENTRIES)}; a mapping as the default is written "
                "under `default:`",
                fix=respelling(key.span(), word, near, is_safe=True),
            )
        refuse_twice(found.get(word), key, "argument")
        if word != "help" and word != "default":
            _refuse_expressions(value, word)
        found[word] = (key, value)
    return found


def _refuse_expressions(node: YamlNode, word: str) -> None:
    """Raise YamaroError if a literal entry holds `$(`, which would stay as it is."""
    if isinstance(node, ScalarNode):
        if "$(" in node.text:
            at = node.text.index("$(")
            raise _bad(
                f"`{word}` is read without running the file, so '$(' is not evaluated here",
                node.span(at, at + 2),
                hint="write the value itself; only a `default` may be computed",
            )
    elif isinstance(node, SequenceNode):
        for item in node.items:
            _refuse_expressions(item, word)


def _bad(
    message: str, span: Span, *, hint: str | None = None, fix: Fix | None = None
) -> YamaroError:
    return failure("bad-argument", message, span, hint=hint, fix=fix)


def _text_of(value: Value | None) -> str:
    if isinstance(value, Constant):
        return value.value if isinstance(value.value, str) else value.node.text
    return ""


# --- the type -----------------------------------------------------------------------------------


def _parse_kind(
    entry: ArgumentEntry,
    literal: dict[str, Value],
    found: dict[str, tuple[ScalarNode, YamlNode]],
) -> None:
    if "type" not in literal:
        _settle_kind(entry, literal.get("choices"), any(name in found for name in _OF_NUMBERS))
        return
    kind = _text_of(literal["type"])
    if kind not in TYPES:
        from ..fixes import respelling

        near = _OTHER_TYPES.get(kind.lower()) or suggest(kind, TYPES)
        span = found["type"][1].span()
        raise _bad(
            f"'{kind}' is not a type of arguments",
            span,
            hint=f"did you mean '{near}'?" if near else f"the types are {', '.join(TYPES)}",
            fix=respelling(span, kind, near, is_safe=True),
        )
    entry.kind = kind
    entry.is_null_allowed = _is_null(entry.default)


def _settle_kind(entry: ArgumentEntry, choices: Value | None, is_number: bool = False) -> None:
    """Give an entry without `type:` the type of its default, or else of its choices."""
    default = entry.default
    entry.is_null_allowed = _is_null(default)
    if is_number:
        entry.kind = NUMBER
        return
    if default is not None and not entry.is_null_allowed:
        entry.kind = _kind_of(default)
    if entry.kind == ANY and isinstance(choices, ListValue):
        kinds = {_kind_of(item) for item in choices.items}
        if len(kinds) == 1:
            entry.kind = kinds.pop()


def _kind_of(value: Value) -> str:
    if isinstance(value, Template):
        return ANY if value.only is not None else TEXT
    if isinstance(value, ListValue):
        return LIST
    if isinstance(value, DictValue):
        return MAPPING
    if isinstance(value.value, bool):
        return BOOLEAN
    if isinstance(value.value, str):
        return TEXT
    return NUMBER if is_number(value.value) else ANY


def _is_null(value: Value | None) -> bool:
    return isinstance(value, Constant) and value.value is None


# --- entries of numbers ---------------------------------------------------------------------------


def _parse_range(entry: ArgumentEntry, value: Value, node: YamlNode) -> None:
    if not isinstance(value, ListValue) or len(value.items) != 2:
        raise _bad(
            "`range` needs a list of two numbers, the minimum and the maximum",
            node.span(),
            hint="write range: [0.3, 1.3]; write null for an open end",
        )
    ends = [None if _is_null(item) else _number(entry, item) for item in value.items]
    entry.low, entry.high = ends
    if entry.low is not None and entry.high is not None and entry.low > entry.high:
        raise _bad("the range ends below its start", node.span(), hint="swap the two numbers")


def _parse_log(entry: ArgumentEntry, value: Value, node: YamlNode) -> None:
    if not isinstance(value, Constant) or not isinstance(value.value, bool):
        raise _bad("`log` needs true or false", node.span())
    entry.is_log = value.value
    if entry.is_log and (entry.low is None or entry.high is None or entry.low <= 0):
        raise _bad(
            "`log` needs a `range` between two numbers greater than 0",
            node.span(),
            hint="write range: [0.01, 100]",
        )


def _number(entry: ArgumentEntry, value: Value) -> float:
    """Return a literal number of an entry in SI."""
    try:
        return quantity(entry, literal_value(value))
    except InputFault as fault:
        code = "bad-argument" if fault.code == "argument-type" else fault.code
        raise failure(code, fault.message, place_of(value), hint=fault.hint) from None


def _parse_choices(entry: ArgumentEntry, value: Value, node: YamlNode) -> None:
    if not isinstance(value, ListValue) or not value.items:
        raise _bad(
            "`choices` needs a list of values",
            node.span(),
            hint="write choices: [none, two_finger, vacuum]",
        )
    choices = [_checked(entry, item) for item in value.items]
    entry.choices = choices


def _checked(entry: ArgumentEntry, value: Value) -> object:
    """Return a literal value as the argument has it.

    Raises:
        YamaroError: the argument does not take it.
    """
    try:
        return checked(entry, literal_value(value), spelling=spelling_of(value))
    except InputFault as fault:
        raise failure(fault.code, fault.message, place_of(value), hint=fault.hint) from None


# --- literal values -------------------------------------------------------------------------------


def is_literal(value: Value) -> bool:
    """Return whether nothing in a value has to be evaluated."""
    if isinstance(value, ListValue):
        return all(map(is_literal, value.items))
    if isinstance(value, DictValue):
        return all(is_literal(key) and is_literal(item) for key, item in value.pairs)
    return isinstance(value, Constant)


def literal_value(value: Value) -> object:
    """Return the Python object of a value in which nothing has to be evaluated."""
    if isinstance(value, ListValue):
        return [literal_value(item) for item in value.items]
    if isinstance(value, DictValue):
        return {literal_value(key): literal_value(item) for key, item in value.pairs}
    assert isinstance(value, Constant)
    return value.value


def spelling_of(value: Value) -> str | None:
    """Return how a scalar is written that is not a text already, or None."""
    if isinstance(value, Constant) and not isinstance(value.value, str):
        return value.node.text
    return None


def place_of(value: Value) -> Span:
    """Return where a value is written."""
    if isinstance(value, Constant):
        return value.node.span()
    return value.span() if isinstance(value, Template) else value.span
