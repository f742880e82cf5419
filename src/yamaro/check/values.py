"""Checks values in the extensions of URDF: numbers, truth values, words, names, in texts too."""

from __future__ import annotations

from math import inf, isnan

from ..model.sdf_schema import COLOR, INTEGER, POSE, TRUTH, WORD, Value
from ..model.values import attribute_text, content, content_span
from .context import shown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from ..source import Span
    from ..xml.tree import Element
    from .context import CheckContext

TRUTHS = ("true", "false", "1", "0")
LENIENT_TRUTHS = (*TRUTHS, "yes", "no")
POSE_COUNTS = {"euler_rpy": 6, "quat_xyzw": 7}


def children(element: Element, name: str) -> Iterator[Element]:
    """Yield the elements of a name in an element."""
    return (child for child in element.elements() if child.name == name)


def is_near(word: str, known: str) -> bool:
    """Return whether a word is a slip away from a word that is known, and not that word."""
    from .outermost import is_one_slip_away

    return word != known and (
        is_one_slip_away(word, known)
        or word.replace("_", "").lower() == known.replace("_", "").lower()
    )


def named(element: Element) -> str:
    """Return the name of an element without the space around, "" if it has none."""
    return (attribute_text(element, "name") or "").strip()


def check_value(
    element: Element,
    rule: Value,
    where: str,
    context: CheckContext,
    *,
    attribute: str | None = None,
    truths: Iterable[str] = TRUTHS,
) -> tuple[float, ...]:
    """Check an attribute, or what an element says; return its numbers if they are as they may be.

    Args:
        element: the element.
        rule: which values it takes.
        where: what to call the value in messages.
        context: takes what is found.
        attribute: the attribute, if it is not the element's text.
        truths: the texts of truth values, in lower case.
    """
    if attribute is None:
        text, span = content(element) or "", content_span(element)
    else:
        text, span = attribute_text(element, attribute) or "", element.value_span(attribute)
    if "$" in text:
        return ()  # reported as an expression that was left over
    if rule.kind == WORD:
        if rule.words and text not in rule.words:
            report_word(text, rule.words, where, element, span, context)
        return ()
    if rule.kind == TRUTH:
        if text.lower() not in truths:
            context.report(
                "bad-value",
                f"{where} is {_quoted(text)}, which is neither true nor false",
                element,
                span=span,
                hint="write true or false",
            )
        return ()
    return _check_numbers(text, rule, where, element, span, context)


def report_word(
    text: str,
    words: Iterable[str],
    where: str,
    element: Element,
    span: Span,
    context: CheckContext,
    *,
    result: str = "which no reader knows",
) -> None:
    """Report a word that is not among those known."""
    known = sorted(words)
    hint, fix = context.near(text, known, span)
    context.report(
        "unknown-type",
        f"{where} is {_quoted(text)}, {result}",
        element,
        span=span,
        hint=hint or f"write {', '.join(known[:6])}{' …' if len(known) > 6 else ''}",
        fix=fix,
    )


def check_spelling(
    child: Element, known: Iterable[str], where: str, reader: str, context: CheckContext
) -> bool:
    """Report an element that is misspelt, which its reader ignores; return whether it is."""
    near = next((each for each in known if is_near(child.name, each)), None)
    if child.name in known or near is None:
        return False
    from .outermost import report_misspelt

    message = f"'{child.name}' {where} has no meaning; {reader} ignores it"
    report_misspelt(child, near, message, context)
    return True


def _check_numbers(
    text: str, rule: Value, where: str, element: Element, span: Span, context: CheckContext
) -> tuple[float, ...]:
    row = numbers(text)
    if row is None or (rule.kind == INTEGER and not all(n.is_integer() for n in row)):
        what = "a whole number" if rule.kind == INTEGER else "a number"
        context.report(
            "not-a-number",
            f"{where} is '{text}', which is not {what}" if text else f"{where} is empty",
            element,
            span=span,
            hint=f"write {what}" if rule.count == 1 else f"write {rule.count} numbers",
        )
        return ()
    count = _count(rule, element)
    if len(row) != count and not (rule.kind == COLOR and len(row) == 3):
        context.report(
            "wrong-count",
            f"{where} has {len(row)} number{'s' if len(row) != 1 else ''} instead of {count}",
            element,
            span=span,
            hint=f"write {count} number{'s' if count > 1 else ''}",
        )
        return ()
    for number in row:
        if not rule.least <= number <= rule.most or number <= rule.above:
            if number < 0 and (rule.above == 0 or rule.least >= 0):
                code, what = "negative-value", f"{where} is {shown(number)}, but cannot be negative"
            else:
                code, what = "out-of-range", f"{where} is {shown(number)}, which is out of range"
            if rule.above > -inf:
                hint = f"write a number greater than {shown(rule.above)}"
            elif rule.most < inf:
                hint = f"write a number from {shown(rule.least)} to {shown(rule.most)}"
            else:
                hint = f"write a number of at least {shown(rule.least)}"
            context.report(code, what, element, span=span, hint=hint)
            return ()
    return row


def _count(rule: Value, element: Element) -> int:
    if rule.kind != POSE:
        return rule.count
    return POSE_COUNTS.get(attribute_text(element, "rotation_format") or "", 6)


def numbers(text: str) -> tuple[float, ...] | None:
    """Return the numbers of a text, which may be infinite; None if it is not a row of numbers."""
    try:
        row = tuple(map(float, text.split()))
    except ValueError:
        return None
    is_row = row and text.isascii() and "_" not in text and not any(map(isnan, row))
    return row if is_row else None


def check_order(
    lower: tuple[Element, str, float], upper: float, name: str, context: CheckContext
) -> None:
    """Report a least value above the greatest.

    Args:
        lower: the element with the least value, what to call it, and its number.
        upper: the greatest value.
        name: what to call that.
        context: takes what is found.
    """
    element, where, number = lower
    if number > upper:
        context.report(
            "limit-order",
            f"{where} ({shown(number)}) is greater than '{name}' ({shown(upper)})",
            element,
            span=content_span(element),
            hint="swap the two",
        )


def check_required(
    element: Element, attributes: Iterable[str], where: str, result: str, context: CheckContext
) -> bool:
    """Report attributes that are left out or empty; return whether all of them are there.

    Args:
        element: the element.
        attributes: those it must have.
        where: what to call the element.
        result: what its reader does without them.
        context: takes what is found.
    """
    is_whole = True
    for attribute in attributes:
        text = attribute_text(element, attribute)
        if text is not None and text.strip():
            continue
        is_whole = False
        state = "has no" if text is None else "has an empty"
        context.report(
            "missing-attribute",
            f"{where} {state} '{attribute}'; {result}",
            element,
            attribute=None if text is None else attribute,
            missing=attribute,
            hint=f"add `{attribute}=…`" if text is None else f"write its {attribute}",
        )
    return is_whole


class UniqueNames:
    """The names of elements of one kind, each of which can be used once."""

    __slots__ = ("_first", "_kinds", "_result")

    def __init__(self, kinds: str, result: str) -> None:
        """Begin with none.

        Args:
            kinds: what to call several of them, such as `transmissions`.
            result: what their reader does with the second of a name.
        """
        self._kinds = kinds
        self._result = result
        self._first: dict[str, Element] = {}

    def add(self, element: Element, context: CheckContext, *, attribute: str = "name") -> None:
        """Report the name of an element if there was one of that name before."""
        name = (attribute_text(element, attribute) or "").strip()
        if not name:
            return
        first = self._first.get(name)
        if first is None:
            self._first[name] = element
            return
        place, own = first.value_span(attribute), element.value_span(attribute)
        note = (
            "first used here in an earlier iteration of a loop"
            if place.key() == own.key()
            else f"first used at {place.place()}"
        )
        context.report(
            "repeated-name",
            f"there are two {self._kinds} named '{name}'; {self._result}",
            element,
            attribute=attribute,
            hint="give each its own name, or remove one",
            notes=(note,),
        )


def _quoted(text: str) -> str:
    return f"'{text}'" if text else "empty"
