"""Short heads: `if length > 1:`, `for side in sides:` and `Leg(side, length=0.3):` in one key."""

from __future__ import annotations

from ..diagnostics import failure
from ..yaml.brackets import find_close
from ..yaml.nodes import ScalarNode, ScalarPiece
from .keys import trim
from .signatures import split_scope
from .statements import parse_iterator
from .values import is_empty, pairs_of, parse_bare_expression, parse_condition, split_inline

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

    from ..source import Span
    from ..yaml.nodes import YamlNode
    from .context import ParseContext
    from .nodes import Constant
    from .python import PythonCode
    from .values import Pairs

_IN_HEAD = {
    "if": ("condition",),
    "elif": ("condition",),
    "for": ("iterator", "range", "in"),
}
"""Entries of the long forms that a short head already gives."""


def parse_head_condition(
    key: ScalarNode, word: str, context: ParseContext
) -> PythonCode | Constant:
    """Return the condition of `if …:` or `elif …:`.

    Raises:
        YamaroError: it is not an expression.
    """
    return parse_condition(_piece(key, len(word), len(key.text)), context)


def parse_head_iteration(
    key: ScalarNode, context: ParseContext
) -> tuple[list[str], list[Span], PythonCode]:
    """Return the names of `for … in …:` with their places, and what it runs over.

    Raises:
        YamaroError: `in` is missing, a name is not valid, or what follows is not an expression.
    """
    text = key.text
    split = _find_in(text)
    if split is None:
        raise failure(
            "bad-iterator",
            "this `for` does not say what it runs over",
            key.span(),
            hint="write for i in range(6):, or for side, y in sides:",
        )
    names = _piece(key, len("for"), split)
    if names.text.startswith("(") and names.text.endswith(")"):
        at = text.index("(")
        names = _piece(key, at + 1, text.rindex(")", 0, split))
    items = _piece(key, split + len("in"), len(text))
    if not items.text:
        raise failure(
            "bad-iterator",
            "nothing follows `in`",
            key.span(split, split + len("in")),
            hint="write for i in range(6):, or the name of a list",
        )
    return *parse_iterator(names), parse_bare_expression(items, context)


def body_pairs(word: str, node: YamlNode, context: ParseContext) -> Pairs:
    """Return the pairs of the body below a short head; `body` alone is the wrapper.

    Raises:
        YamaroError: it is a text, or an entry is in the head already.
    """
    if isinstance(node, ScalarNode) and not is_empty(node):
        raise failure(
            "not-a-body",
            f"statements follow `{word}`, and this is a text",
            node.span(),
            hint="write each statement as `name: value`, on a separate line",
        )
    pairs = pairs_of(node, f"`{word}`", context)
    if len(pairs) == 1 and pairs[0][0].text == "body":
        return pairs_of(pairs[0][1], f"the body of `{word}`", context)
    _refuse_twice(pairs, _IN_HEAD[word])
    return pairs


def _refuse_twice(pairs: Pairs, in_head: tuple[str, ...]) -> None:
    """Raise YamaroError for an entry of the long form below a short head."""
    for own, _ in pairs:
        if own.text in in_head:
            raise failure(
                "given-twice",
                f"'{own.text}' is already in the head",
                own.span(),
                hint="write the statements directly below the head",
            )
        if own.text == "body":
            raise failure(
                "given-twice",
                "`body` cannot be used beside other statements below a short head",
                own.span(),
                hint="write the statements directly below the head, without `body`",
            )


def refuse_other_heads(key: ScalarNode) -> None:
    """Raise YamaroError for a key that looks like a head of Python's or another language's."""
    text = key.text
    word = next((text[:at] for at, char in enumerate(text) if not char.isalpha()), text)
    lower, rest = word.lower(), text[len(word) :].strip()
    if lower == "else" and rest[:3].lower() == "if ":
        word, lower, rest = text[: text.lower().index("if") + 2], "elif", rest[3:].strip()
    elif lower in ("elseif", "elsif") and rest:
        lower = "elif"
    if lower in _IN_HEAD and text[len(word)] in " \t\n(":
        case = "" if word.islower() else "statements are lower case: "
        _refuse(key, word, f"{case}write {lower} {rest}:", lower)
    if lower == "while" and text[len(word)] in " (":
        _refuse(key, word, "write for i in range(6): with an `if` in it; `process` has `while`")
    name, bracket, rest = text.partition("(")
    if bracket and text.endswith(")") and name.isidentifier() and name[0].isupper():
        arguments = rest[:-1].strip()
        from ..fixes import replacement

        example = f"{name}: {arguments}" if arguments else f"{name}:"
        fix = None if arguments else replacement(key.span(0, len(text)), name, is_safe=True)
        raise failure(
            "bad-call",
            f"'{text}' is a call as Python writes it",
            key.span(),
            hint=f"write {example}",
            fix=fix,
        )


def _refuse(key: ScalarNode, word: str, hint: str, meant: str | None = None) -> NoReturn:
    from ..fixes import replacement

    span = key.span(0, len(word))
    fix = None if meant is None else replacement(span, meant, is_safe=True)
    raise failure("unknown-statement", f"unknown statement `{word}`", span, hint=hint, fix=fix)


def _find_in(text: str) -> int | None:
    """Return where the first word `in` begins."""
    at = text.find("in", len("for"))
    while at >= 0:
        before, after = text[at - 1], text[at + 2 : at + 3]
        if not (before.isalnum() or before == "_") and not (after.isalnum() or after == "_"):
            return at
        at = text.find("in", at + 1)
    return None


def _piece(key: ScalarNode, start: int, end: int) -> ScalarPiece:
    """Return part of a key, without the space around it."""
    return ScalarPiece(key, *trim(key.text, start, end))


# --- functions --------------------------------------------------------------------------------


def signature_of(key: ScalarNode) -> ScalarPiece | None:
    """Return the parameters in `Leg(side, length=0.3)/parent`, or None for a name alone.

    Raises:
        YamaroError: the bracket is not closed, or a parameter is of a kind that Python alone has.
    """
    text = key.text
    open_at = text.find("(")
    if open_at <= 0 or not text[:open_at].strip().isidentifier():
        return None
    close = find_close(text, open_at + 1)
    if close < 0:
        raise failure(
            "bad-parameter",
            "the parameters of this function have no closing bracket",
            key.span(open_at, open_at + 1),
            hint="write Name(side, length=0.3): and quote the whole key if YAML cuts it",
        )
    parameters = _piece(key, open_at + 1, close)
    for start, end in split_inline(parameters):
        word = parameters.text[start:end].strip()
        is_block = word.startswith("**") and word[2:3].isupper()
        if word == "/" or (word.startswith("*") and not is_block):
            first = parameters.text.index(word, start)
            raise failure(
                "bad-parameter",
                f"'{word}' is not allowed among the parameters of a function",
                parameters.span(first, first + len(word)),
                hint="parameters are names, name=default, and blocks such as **Foot, whose names "
                "begin with a capital letter",
            )
    return parameters


def scope_behind(key: ScalarNode) -> str:
    """Return the scope that follows the parameters of a function.

    Raises:
        YamaroError: something else follows.
    """
    text = key.text
    after = find_close(text, text.index("(") + 1) + 1
    rest = _piece(key, after, len(text))
    if not rest.text:
        return "local"
    end, scope = split_scope(rest, "function")
    if rest.text[:end].strip():
        raise failure(
            "bad-function-name",
            f"'{rest.text[:end].strip()}' cannot follow the parameters of a function",
            rest.span(0, end),
            hint=f"a scope may follow: {text[:after]}/parent",
        )
    return scope


def wrapped_body(node: YamlNode, context: ParseContext) -> YamlNode:
    """Return the body below a function with parameters in its head; `body` alone is the wrapper.

    Raises:
        YamaroError: an entry is in the head already.
    """
    if isinstance(node, ScalarNode):
        return node
    pairs = pairs_of(node, "a function", context)
    if len(pairs) == 1 and pairs[0][0].text == "body":
        return pairs[0][1]
    _refuse_twice(pairs, ("input",))
    return node
