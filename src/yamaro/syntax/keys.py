"""The grammar of keys: `name/attribute=value, …`, with `$(…)` and quotes opaque to it.

key        = name [ "/" attributes ]
attributes = attribute { "," attribute }
attribute  = name [ ":" ] "=" value
value      = "'" … "'" | '"' … '"' | text without commas
"""

from __future__ import annotations

from ..diagnostics import Reporter, YamaroError, failure
from ..source import Span
from ..xml.values import bad_name_character
from ..yaml.nodes import ScalarNode
from .context import ParseContext
from .names import STATEMENTS
from .nodes import Attribute
from .python import Template, parse_template, skip_expression

NAME_RULE = "a name begins with a letter or _ and contains letters, digits, - _ ."


def find_outside(text: str, characters: str, start: int, end: int) -> int:
    """Return the index of the first of `characters` that is not inside a `$(…)`, or -1."""
    found = start - 1
    while True:
        if found < start:
            found = _find_first(text, characters, start, end)
        dollar = text.find("$(", start, found) if found >= 0 else -1
        if dollar < 0:
            return found
        start = max(skip_expression(text, dollar), dollar + 1)


def _find_first(text: str, characters: str, start: int, end: int) -> int:
    first = -1
    for char in characters:
        at = text.find(char, start, end)
        if at >= 0:
            first = end = at
    return first


def parse_name(
    key: ScalarNode, start: int, end: int, *, what: str, context: ParseContext
) -> str | Template:
    """Return the element's or attribute's name in `key.text[start:end]`, checked if it is known.

    Raises:
        YamaroError: it is not an XML name.
    """
    name = parse_template(key, start, end, context=context)
    if isinstance(name, str):
        fault = name_fault(name, what)
        if fault is not None:
            raise failure(
                "bad-name",
                fault,
                key.span(start, max(end, start + 1)) if key.text else key.span(),
                hint=_name_hint(key, name),
            )
    return name


def name_fault(name: str, what: str) -> str | None:
    """Return what is wrong with a name of an element or attribute, or None."""
    char = bad_name_character(name)
    if char is None:
        return None
    if not name:
        return f"the {what} has no name"
    if char == " ":
        return f"'{name}' is not an XML name: it contains a space"
    if char == name[0]:
        return f"'{name}' is not an XML name: it begins with '{char}'"
    return f"'{name}' is not an XML name: it contains '{char}'"


def _name_hint(key: ScalarNode, name: str) -> str:
    word, space, rest = name.partition(" ")
    if word.lower() == "else" and rest.lstrip().lower().startswith("if"):
        return "write `elif:`, and `condition:` and `body:` below it"
    if space and word.lower() in STATEMENTS:
        return f"write `{word.lower()}:` with its entries below it"
    if "=" in name:
        if "/" not in key.text:
            return (
                "write attributes after a slash: name/attribute=value; inside { }, a comma ends "
                "the key, so quote such a key or put it on a separate line"
            )
        return "write attributes after a slash: name/attribute=value"
    if word.lower() == "foreach":
        return f"write for {rest.strip() or 'i in range(3)'}:"
    if word.replace(".", "", 1).lstrip("+-").isdecimal():
        return "the commas of { } and [ ] separate entries: write 1 2 3, or [1, 2, 3]"
    if ")" in name and "(" not in name:
        return "the commas of { } and [ ] split an expression: quote it, or use a separate line"
    if name.startswith("#"):
        return "write <#text>: for text between elements, <#comment>: for an XML comment"
    if name.startswith("<"):
        return f"close the bracket: <{key.text.lstrip('<').rstrip('/')}>:"
    invisible = [char for char in name if not char.isprintable()]
    if invisible:
        return (
            f"type it again: U+{ord(invisible[0]):04X} is "
            "invisible and often comes from pasted text"
        )
    if name.startswith("xacro:"):
        return "xacro tags are not supported here; see docs/coming-from-xacro.md"
    return NAME_RULE


def attribute_twice(name: str, span: Span) -> YamaroError:
    """Return the error for an attribute that is given a second time at `span`."""
    return failure(
        "attribute-twice",
        f"the attribute '{name}' is given twice",
        span,
        hint="keep one of the two",
    )


def parse_attributes(
    key: ScalarNode, start: int, end: int, *, context: ParseContext
) -> list[Attribute]:
    """Return the attributes in `key.text[start:end]`, what follows the slash.

    Raises:
        YamaroError: an attribute has no `=`, no name, an open quote, or stands twice.
    """
    attributes: list[Attribute] = []
    seen: dict[str, Attribute] = {}
    at = start
    while at <= end:
        attribute, at = _parse_attribute(key, at, end, context)
        name = attribute.name
        if isinstance(name, str):
            if name in seen:
                raise attribute_twice(name, attribute.name_span)
            seen[name] = attribute
        attributes.append(attribute)
        if at >= end:
            break
        at += 1
    return attributes


def _parse_attribute(
    key: ScalarNode, start: int, end: int, context: ParseContext
) -> tuple[Attribute, int]:
    """Return the attribute that begins at `start`, and the index of the comma behind it."""
    text = key.text
    equals = find_outside(text, "=,", start, end)
    if equals < 0 or text[equals] == ",":
        _refuse_bare(key, start, equals if equals >= 0 else end)
    first, last = trim(text, start, equals)
    if last > first and text[last - 1] == ":":
        first, last = trim(text, first, last - 1)
    name = parse_name(key, first, last, what="attribute", context=context)
    begin = equals + 1
    while begin < end and text[begin].isspace():
        begin += 1
    if begin < end and text[begin] in "'\"":
        value_start = begin + 1
        value_end, comma = _end_of_quoted(key, begin, end)
    else:
        comma = find_outside(text, ",", begin, end)
        comma = end if comma < 0 else comma
        value_start, value_end = trim(text, begin, comma)
    value = parse_template(key, value_start, value_end, context=context)
    is_empty = value_end <= value_start
    attribute = Attribute(
        name,
        value,
        key,
        name_place=(first, max(last, first + 1)),
        value_place=(first, equals + 1) if is_empty else (value_start, value_end),
    )
    return attribute, comma


def _end_of_quoted(key: ScalarNode, begin: int, end: int) -> tuple[int, int]:
    """Return where the quoted value at `begin` is closed, and the index of the comma behind it."""
    text = key.text
    close = find_outside(text, text[begin], begin + 1, end)
    if close < 0:
        raise failure(
            "bad-key",
            f"the quote {text[begin]} of this attribute is not closed",
            key.span(begin, begin + 1),
            hint=f"put {text[begin]} after the value",
        )
    comma = close + 1
    while comma < end and text[comma].isspace():
        comma += 1
    if comma < end and text[comma] != ",":
        raise failure(
            "bad-key",
            "text follows the closing quote of this attribute",
            key.span(comma, end),
            hint="separate attributes with commas: name/a='1', b='2'",
        )
    return close, comma


def _refuse_bare(key: ScalarNode, start: int, end: int) -> None:
    first, last = trim(key.text, start, end)
    word = key.text[first:last]
    if not word:
        raise failure(
            "bad-key",
            "an attribute is missing here",
            key.span(max(start - 1, 0), max(start, 1)),
            hint="write name/attribute=value, with commas only between attributes",
        )
    raise failure(
        "bad-key",
        f"'{word}' is not an attribute: it has no '='",
        key.span(first, last),
        hint="a value that contains commas needs quotes: attribute='1, 2'"
        if name_fault(word, "attribute")
        else f"write {word}=value; a value that contains commas needs quotes: attribute='1, 2'",
    )


# --- plain keys -------------------------------------------------------------------------------

PlainKey = tuple[str, dict[str, object]]
"""Name and attributes of an element's key in which nothing is evaluated."""


def parse_plain_key(text: str) -> PlainKey | None:
    """Return what a key `name/attribute=value, …` says if it holds no `$` and no quoted value.

    Reads what most keys are, in a fraction of the time of `parse_name` and `parse_attributes`, and
    says the same. None if the key is anything else, or faulty.
    """
    name, slash, rest = text.partition("/")
    name = name.rstrip()
    if not slash or "$" in text or name in STATEMENTS or bad_name_character(name) is not None:
        return None
    attributes: dict[str, object] = {}
    for piece in rest.split(","):
        attribute, equals, value = piece.partition("=")
        attribute = attribute.strip()
        value = value.strip()
        if attribute.endswith(":"):
            attribute = attribute[:-1].rstrip()
        if not equals or attribute in attributes or value.startswith(("'", '"')):
            return None
        if bad_name_character(attribute) is not None:
            return None
        attributes[attribute] = value
    return name, attributes


class PlainKeyPlaces:
    """Where the values of attributes are in a key that `parse_plain_key` has read.

    Finding them takes a while, and is seldom asked.
    """

    __slots__ = ("_key", "_places")

    def __init__(self, key: ScalarNode) -> None:
        """Hold the key, which has attributes."""
        self._key = key
        self._places: dict[str, Span] | None = None

    def get(self, attribute: str, /) -> Span | None:
        """Return where the value of an attribute stands, or None if the key has none such."""
        if self._places is None:
            text = self._key.text
            context = ParseContext(Reporter())
            attributes = parse_attributes(
                self._key, text.index("/") + 1, len(text), context=context
            )
            self._places = {own.name: own.span for own in attributes if isinstance(own.name, str)}
        return self._places.get(attribute)


def trim(text: str, start: int, end: int) -> tuple[int, int]:
    """Return a stretch of a text without the space at its ends."""
    while start < end and text[start].isspace():
        start += 1
    while end > start and text[end - 1].isspace():
        end -= 1
    return start, end
