"""What the checks of a robot share: reporting at the very value, and reading numbers once."""

from __future__ import annotations

from math import isfinite

from ..diagnostics import WARNING, Diagnostic, suggest
from ..xmltree import Element, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from ..diagnostics import Reporter
    from ..source import Span
    from .urdf import AttributeRule

SUGGESTION_BUDGET = 200_000
"""Names compared in one run to find the one meant; keeps a robot full of faults linear."""

NAMED_OWNERS = ("link", "joint", "material")


WORD, NOT_FINITE, SPACING = "word", "not finite", "spacing"


class NumberFault:
    """Why a text is not a row of numbers: the item at fault, and what is wrong with it."""

    __slots__ = ("item", "kind")

    def __init__(self, item: str, kind: str) -> None:
        """Name the item as spelled; `kind` is WORD, NOT_FINITE or SPACING."""
        self.item = item
        self.kind = kind


class Finding:
    """A diagnostic, and how often the same came up."""

    __slots__ = ("count", "diagnostic")

    def __init__(self) -> None:
        """Start with nothing found."""
        self.count = 0
        self.diagnostic: Diagnostic | None = None


KEY_CODES = ("unknown-key", "misplaced-key")
STRAY_CODES = ("unknown-element", "unknown-attribute")
"""What a stray key of a part comes out as; where the key was told of, this is not told again."""


class CheckContext:
    """One run of the checks: where findings go, and what has been worked out so far."""

    __slots__ = ("_found", "_numbers", "_suggestion_budget", "reporter", "sound", "version")

    def __init__(self, reporter: Reporter, *, version: str = "1.0") -> None:
        """Report to `reporter`; `version` is the URDF version of the robot.

        `sound` holds the texts that have been found right for a kind of attribute.
        """
        self.reporter = reporter
        self.version = version
        self.sound: set[tuple[str, AttributeRule]] = set()
        self._numbers: dict[str, tuple[float, ...] | NumberFault] = {}
        self._suggestion_budget = SUGGESTION_BUDGET
        self._found: dict[object, Finding] = {}

    def warn(
        self,
        code: str,
        message: str,
        element: Element,
        *,
        attribute: str | None = None,
        is_of_name: bool = False,
        missing: str | None = None,
        hint: str | None = None,
        notes: Sequence[str] = (),
    ) -> None:
        """Note a finding at an attribute's value, or at the element when none is named.

        With `is_of_name` it is at the attribute's name.

        A line in a loop or a function makes many elements; what is wrong with them for the same
        reason is told once. `missing` names what is not there, where that is the fault.
        """
        if attribute is not None and is_of_name:
            span = element.name_span(attribute)
        else:
            span = place_of(element, attribute)
        found = self._found.setdefault((code, span.key(), attribute, missing), Finding())
        found.count += 1
        if found.diagnostic is None:
            found.diagnostic = Diagnostic(
                code,
                message,
                span,
                hint=hint,
                notes=notes,
                severity=WARNING,
                trace=element.trace,
            )

    def flush(self) -> None:
        """Report what was found, in the order it was found."""
        told = {d.span.key() for d in self.reporter.diagnostics if d.code in KEY_CODES}
        for found in self._found.values():
            diagnostic = found.diagnostic
            if diagnostic is None:
                continue
            if diagnostic.code in STRAY_CODES and diagnostic.span.key() in told:
                continue
            if found.count > 1:
                diagnostic.notes += (f"{found.count} elements made here have this fault",)
            self.reporter.add(diagnostic)
        self._found.clear()

    def near(self, word: str, candidates: Collection[str]) -> str | None:
        """Return the hint "did you mean 'x'?", or None when nothing is near."""
        near = self.near_word(word, candidates)
        return f"did you mean '{near}'?" if near is not None else None

    def near_word(self, word: str, candidates: Collection[str]) -> str | None:
        """Return the candidate that `word` is a misspelling of, or None."""
        if self._suggestion_budget < len(candidates):
            return None
        self._suggestion_budget -= len(candidates)
        return suggest(word, candidates)

    def read(self, text: str) -> tuple[float, ...] | NumberFault:
        """Return the numbers in a text; equal texts are read once."""
        found = self._numbers.get(text)
        if found is None:
            found = self._numbers[text] = read_numbers(text)
        return found

    def numbers(self, element: Element | None, attribute: str, count: int) -> tuple[float, ...]:
        """Return an attribute's numbers, or () if it is absent or faulty (reported elsewhere)."""
        text = attribute_text(element, attribute)
        if text is None:
            return ()
        found = self.read(text)
        if isinstance(found, NumberFault) or len(found) != count:
            return ()
        return found

    def number(self, element: Element | None, attribute: str) -> float | None:
        """Return the number in an attribute, or None if it is absent or faulty."""
        found = self.numbers(element, attribute, 1)
        return found[0] if found else None


def read_numbers(text: str) -> tuple[float, ...] | NumberFault:
    """Return the numbers of a text, spelled as C++ and Python both read them, or the fault.

    Spacing is judged as urdfdom does: it splits at spaces alone, and a lone number must be the end
    of its text.
    """
    numbers = []
    for item in text.split():
        try:
            number = float(item)
        except ValueError:
            return NumberFault(item, WORD)
        if "_" in item or not item.isascii():
            return NumberFault(item, WORD)
        if not isfinite(number):
            return NumberFault(item, NOT_FINITE)
        numbers.append(number)
    if (numbers and not text.isprintable()) or (len(numbers) == 1 and text[-1] == " "):
        return NumberFault(text, SPACING)
    return tuple(numbers)


def attribute_text(element: Element | None, attribute: str) -> str | None:
    """Return an attribute as it will be written, or None if it will not be."""
    if element is None:
        return None
    value = element.attributes.get(attribute)
    if value is None or type(value) is str:
        return value
    return format_value(value)


def place_of(element: Element, attribute: str | None = None) -> Span:
    """Return where an attribute's value is written, or the element."""
    return element.span if attribute is None else element.value_span(attribute)


def child_named(element: Element, name: str) -> Element | None:
    """Return the first child element of that name; parsers of URDF read no other."""
    for child in element.children:
        if isinstance(child, Element) and child.name == name:
            return child
    return None


def label(owner: Element) -> str:
    """Return how to speak of a link, joint or material: link 'arm'."""
    if owner.name not in NAMED_OWNERS:
        return "the robot" if owner.name == "robot" else f"'{owner.name}'"
    name = attribute_text(owner, "name")
    return f"{owner.name} '{name}'" if name else f"a {owner.name} without a name"


def listed(names: Sequence[str], *, limit: int = 5) -> str:
    """Return names quoted and joined for a sentence, long lists cut."""
    quoted = [f"'{name}'" for name in names[:limit]]
    if len(names) > limit:
        return ", ".join(quoted) + f" and {len(names) - limit} more"
    return " and ".join([", ".join(quoted[:-1]), quoted[-1]] if len(quoted) > 1 else quoted)


def shown(number: float) -> str:
    """Return a number short enough to read in a sentence."""
    return f"{number:.6g}"
