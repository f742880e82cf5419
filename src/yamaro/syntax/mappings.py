"""Mappings of the language: as repeated keys or as a list, and statements' own entries."""

from __future__ import annotations

from ..diagnostics import failure
from ..source import Span
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .context import ParseContext
from .keys import find_outside
from .names import is_function_name, is_identifier
from .values import is_empty, warn_of_hidden_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..diagnostics import YamaroError
    from ..fixes import Fix
    from ..yaml.nodes import YamlNode

Pairs = list[tuple[ScalarNode, "YamlNode"]]


def pairs_of(node: YamlNode, what: str, context: ParseContext) -> Pairs:
    """Return the pairs of a mapping, a list of mappings, or nothing at all.

    A list with an item that is something else gives the pairs of the others; the error is kept.

    Raises:
        YamaroError: it is something else.
    """
    if isinstance(node, MappingNode):
        return node.pairs
    if isinstance(node, ScalarNode):
        if is_empty(node):
            warn_of_hidden_value(node, context)
            return []
        raise failure(
            "not-a-body",
            f"{what} needs entries such as `name: value`, not a text",
            node.span(),
            hint=body_hint(node.text),
            fix=_fix_of_text(node),
        )
    pairs: Pairs = []
    fault: YamaroError | None = None
    for item in node.items:
        if isinstance(item, MappingNode):
            pairs.extend(item.pairs)
        elif fault is None:
            fault = failure(
                "not-a-body",
                f"in {what}, each item of the list must be an entry such as `name: value`",
                item.span(),
                hint=item_hint(item),
                fix=_fix_of_text(item) if isinstance(item, ScalarNode) else None,
            )
    if fault is not None:
        if not pairs:
            raise fault
        context.keep(fault)  # the others are looked at, and an editor knows what they declare
    return pairs


def is_mapping(node: YamlNode) -> bool:
    """Return whether a node is a mapping, or a list of mappings, which means the same."""
    if isinstance(node, SequenceNode):
        return bool(node.items) and all(isinstance(item, MappingNode) for item in node.items)
    return isinstance(node, MappingNode)


# Statements that are never empty, with the entries they take.
_OWN_ENTRIES = {
    "part": ("name", "joint", "link"),
    "for": ("iterator", "range", "in", "body"),
    "if": ("condition", "body"),
    "elif": ("condition", "body"),
    "include": ("path", "namespace"),
}


def refuse_not_indented(node: YamlNode, *, functions: bool = False) -> None:
    """Refuse a list item such as `- part:` whose entries are beside it instead of below it.

    With `functions`, the items are definitions of functions, not statements.

    Raises:
        YamaroError: an item is like that.
    """
    for item in () if isinstance(node, (ScalarNode, MappingNode)) else node.items:
        if not isinstance(item, MappingNode) or len(item.pairs) < 2:
            continue
        (key, value), (beside, _) = item.pairs[:2]
        own = ("input", "body") if functions else _OWN_ENTRIES.get(key.text, ())
        if isinstance(value, ScalarNode) and is_empty(value) and beside.text in own:
            raise failure(
                "not-indented",
                f"'{beside.text}' is beside '{key.text}', not below it",
                beside.span(),
                hint=f"indent `{beside.text}` and the lines below it by two more columns",
            )


def item_hint(item: YamlNode) -> str:
    """Return what a list item in place of an entry was probably meant to be."""
    if not isinstance(item, ScalarNode):
        return "write the entries of an inner list as items of this one: - name: value"
    if is_empty(item):
        return "delete this dash, or write an entry after it: - name: value"
    return body_hint(item.text)


def body_hint(text: str) -> str:
    """Return how to write the entry that a text means."""
    name, colon, value = text.partition(":")
    if is_function_name(text):
        return f"write `{text}:` with a colon to call a function"
    if text.startswith("<"):
        return 'this looks like XML; in YAML <link name="base"/> is written link/name=base:'
    variable, equals, value_of_variable = text.partition("=")
    if equals and is_identifier(variable.strip()) and value_of_variable[:1] != "=":
        return f"write {variable.strip()}: {value_of_variable.strip()}"
    if colon and is_identifier(name) and value:
        return f"put a space after the colon: {name}: {value}"
    if find_outside(text, " ", 0, len(text)) < 0 or "/" in text:
        return f"write `{text}:` with a colon for an entry without a value"
    return "write each entry as `name: value`, on a separate line"


def _fix_of_text(node: ScalarNode) -> Fix | None:
    """Return the fix that makes an entry of a text, as `body_hint` says."""
    from ..fixes import replacement

    text, span = node.text, node.span()
    if node.style or span.written() != text:
        return None
    if is_function_name(text):
        return replacement(span, f"{text}:", is_safe=True)
    variable, equals, value = text.partition("=")
    if equals and is_identifier(variable.strip()) and value[:1] != "=":
        return replacement(span, f"{variable.strip()}: {value.strip()}", is_safe=True)
    name, colon, value = text.partition(":")
    if colon and is_identifier(name) and value:
        return replacement(span, f"{name}: {value}", is_safe=value[:1] != "/")
    return None


def _entries_hint(text: str, known: Sequence[str]) -> str:
    """Return what a statement takes, and where its statements go."""
    if "condition" in known and find_outside(text, " ", 0, len(text)) >= 0:
        return f"write condition: {text}, and the statements under `body:`"
    names = [f"`{name}`" for name in known if name != "body"]
    return f"it takes {', '.join(names)}; statements and elements go under `body:`"


def _unknown_entry(what: str, key: ScalarNode, known: Sequence[str]) -> YamaroError:
    from ..suggestions import meant_word

    hint, fix = meant_word(key.text, known, key.span())
    return failure(
        "unknown-key",
        f"`{what}` has no entry '{key.text}'",
        key.span(),
        hint=hint or _entries_hint(key.text, known),
        fix=fix,
    )


class Entries:
    """The entries of a statement, each meant once, taken out one by one."""

    __slots__ = ("_known", "_pairs", "span", "what")

    def __init__(self, what: str, pairs: Pairs, known: Sequence[str], span: Span) -> None:
        """Check the entries of the statement `what`, written at `span`.

        Raises:
            YamaroError: a key is unknown, or given twice.
        """
        self.what = what
        self.span = span
        self._known = known
        self._pairs: dict[str, tuple[ScalarNode, YamlNode]] = {}
        for key, node in pairs:
            if key.text not in known:
                raise _unknown_entry(what, key, known)
            refuse_twice(self._pairs.get(key.text), key, what)
            self._pairs[key.text] = (key, node)

    def get(self, name: str) -> YamlNode | None:
        """Return the value of an entry, or None if it is not there."""
        pair = self._pairs.get(name)
        return pair[1] if pair else None

    def key(self, name: str) -> ScalarNode:
        """Return the key of an entry that is there."""
        return self._pairs[name][0]

    def need(self, name: str, example: str) -> YamlNode:
        """Return the value of an entry, or raise YamaroError if it is not there."""
        node = self.get(name)
        if node is None:
            raise failure(
                "missing-key",
                f"`{self.what}` needs an entry `{name}`",
                self.span,
                hint=f"write {name}: {example}",
            )
        return node


def refuse_twice(first: tuple[ScalarNode, YamlNode] | None, key: ScalarNode, what: str) -> None:
    """Raise YamaroError if an entry that is meant once was there before."""
    if first is not None:
        raise failure(
            "given-twice",
            f"'{key.text}' is given twice in this `{what}`",
            key.span(),
            hint="keep one of the two",
            notes=[f"first given at {first[0].span().place()}"],
        )
