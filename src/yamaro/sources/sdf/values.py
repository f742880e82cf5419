"""The values of SDF: numbers, truths, vectors and poses in texts, and what is wrong with them."""

from __future__ import annotations

import re
from math import hypot, inf, isfinite, isnan, nan, radians

from ...diagnostics import ERROR, WARNING, Diagnostic, Frame, YamaroError, did_you_mean
from ...model.making import Place
from ...model.making import element as made_element
from ...model.pose import IDENTITY, UNTURNED, Pose, rotation_from_quaternion, rotation_from_rpy
from ...model.values import attribute_text, child_named, content, content_span
from ...source import Span
from ...xml.values import Numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ...model.pose import Vector
    from ...source import Source
    from ...xml.tree import Element
    from ..host import Host

UNLIMITED = 1e16
"""From this number on SDFormat takes a limit for none. Source: joint.sdf."""
ROUNDED = 1e-3
"""How far the length of a quaternion may be off 1 that was rounded."""
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
TRUTHS = {"true": True, "1": True, "false": False, "0": False}


class Reading:
    """Reads the values of one document, and gathers what is wrong with it.

    Attributes:
        host: gives files, and takes warnings.
        errors: what was found.
        versions: the version of SDFormat that each file says, by the identity of its source.
    """

    __slots__ = ("_traces", "errors", "host", "versions")

    def __init__(self, host: Host) -> None:
        self.host = host
        self.errors: list[Diagnostic] = []
        self.versions: dict[int, str] = {}
        self._traces: dict[int, Frame] = {}

    # --- reports ---

    def enter(self, source: Source, include: Element) -> None:
        """Note that a file is read because of an `<include>`."""
        self._traces[id(source)] = Frame(
            "included", source.name, include.span, parent=self.trace(include.span)
        )

    def trace(self, span: Span) -> Frame | None:
        """Return the includes that led to a place."""
        return self._traces.get(id(span.source))

    def place(self, span: Span, values: dict[str, Span] | None = None) -> Place:
        """Return a place, with the includes that led there."""
        return Place(span, values, self.trace(span))

    def fail(
        self,
        code: str,
        message: str,
        span: Span,
        *,
        hint: str | None = None,
        notes: Sequence[str] = (),
        severity: str = ERROR,
    ) -> None:
        """Note an error, and read on; a warning is reported."""
        made = Diagnostic(
            code, message, span,
            hint=hint, notes=notes, severity=severity, trace=self.trace(span),
        )  # fmt: skip
        if severity == ERROR:
            self.errors.append(made)
        else:
            self.host.reporter.add(made)

    def warn(self, code: str, message: str, span: Span, *, hint: str | None = None) -> None:
        """Report what does not prevent a robot."""
        self.fail(code, message, span, hint=hint, severity=WARNING)

    def settle(self) -> None:
        """Raise YamaroError if there were errors."""
        if self.errors:
            raise YamaroError(self.errors)

    # --- values ---

    def row(self, element: Element, counts: Iterable[int]) -> tuple[float, ...] | None:
        """Return the numbers in an element, as many as one of the counts; None if they are not."""
        words, found = (content(element) or "").split(), []
        for index, word in enumerate(words):
            number = _number(word)
            if number is None and len(words) == 1 and (prefix := _NUMBER.match(word)):
                rest = word[prefix.end() :]
                if not any(map(str.isalnum, rest)):
                    number = float(prefix[0])
                    self.warn(
                        "sdf-assumed",
                        f"'{rest}' after the number in <{element.name}> is passed over",
                        text_span(element),
                        hint=f"write {prefix[0]}",
                    )
            if number is None:
                self.fail(
                    "bad-sdf",
                    f"'{word}' in <{element.name}> is not a number",
                    _word_span(element, index),
                    hint="write a number such as 0.5 or 1e-3: SDF has no expressions and no units",
                )
                return None
            found.append(number)
        if len(found) not in counts:
            wanted = " or ".join(map(str, counts))
            self.fail(
                "bad-sdf",
                f"<{element.name}> takes {wanted} numbers, and this has {len(found)}"
                if wanted != "1"
                else f"<{element.name}> takes one number, and this has {len(found)}",
                text_span(element),
            )
            return None
        return tuple(found)

    def finite(self, element: Element, count: int) -> tuple[float, ...] | None:
        """Return numbers in an element that are all finite, or None."""
        found = self.row(element, (count,))
        if found is not None and not all(map(isfinite, found)):
            self.fail(
                "bad-sdf", f"the number in <{element.name}> is not finite", text_span(element)
            )
            return None
        return found

    def spelled(self, element: Element, count: int) -> Numbers | None:
        """Return finite numbers in an element as they are written, or None."""
        row = self.finite(element, count)
        return None if row is None else Numbers(tuple((content(element) or "").split()), row, row)

    def number(self, parent: Element | None, name: str, default: float) -> float:
        """Return the finite number in a child, or a default."""
        child = child_named(parent, name) if parent is not None else None
        found = self.finite(child, 1) if child is not None and content(child) else None
        return default if found is None else found[0]

    def limit(self, parent: Element | None, name: str, default: float) -> float:
        """Return the number in a child, ±inf from 1e16 on."""
        child = child_named(parent, name) if parent is not None else None
        found = self.row(child, (1,)) if child is not None and content(child) else None
        if found is None:
            return default
        return found[0] if abs(found[0]) < UNLIMITED else (inf if found[0] > 0 else -inf)

    def vector(self, parent: Element | None, name: str, default: Vector) -> Vector:
        """Return the three finite numbers in a child, or a default."""
        child = child_named(parent, name) if parent is not None else None
        found = self.finite(child, 3) if child is not None and content(child) else None
        return default if found is None else (found[0], found[1], found[2])

    def truth(self, parent: Element, name: str, default: bool = False) -> bool:
        """Return whether a child says `true` or `1`."""
        child = child_named(parent, name)
        text = (content(child) or "").strip().lower() if child is not None else ""
        if not text:
            return default
        if text not in TRUTHS:
            assert child is not None
            self.fail(
                "bad-sdf",
                f"<{name}> is true or false, and this is '{text}'",
                text_span(child),
                hint=did_you_mean(text, ("true", "false")),
            )
            return default
        return TRUTHS[text]

    def pose(self, element: Element | None) -> Pose:
        """Return what a `<pose>` says, without what it is relative to; nothing moves without one.

        The pose has an `<origin>` as its element if it is written in roll, pitch and yaw.
        """
        if element is None or not (content(element) or "").split():
            return IDENTITY
        form = attribute_text(element, "rotation_format") or "euler_rpy"
        if form not in ("euler_rpy", "quat_xyzw"):
            self.fail(
                "bad-sdf",
                f"'{form}' is not a format of rotations",
                element.value_span("rotation_format"),
                hint=did_you_mean(form, ("euler_rpy", "quat_xyzw"))
                or "the formats are euler_rpy and quat_xyzw",
            )
            return IDENTITY
        is_quaternion = form == "quat_xyzw"
        row = self.finite(element, 7 if is_quaternion else 6)
        if row is None or not any(row):
            return IDENTITY
        position = (row[0], row[1], row[2])
        if is_quaternion:
            if not any(row[3:]):
                return Pose(position=position)
            length = hypot(*row[3:])
            if abs(length - 1) > ROUNDED:
                self.warn(
                    "sdf-assumed",
                    f"this quaternion has a length of {length:.3g}; it is made one of length 1",
                    text_span(element),
                    hint="write x y z w of length 1: libsdformat takes them as they are",
                )
            return Pose(rotation_from_quaternion(*row[3:]), position)
        roll, pitch, yaw = row[3:]
        if (attribute_text(element, "degrees") or "").lower() in ("true", "1"):
            return Pose(rotation_from_rpy(radians(roll), radians(pitch), radians(yaw)), position)
        words = tuple((content(element) or "").split())
        given = {
            name: Numbers(words[start : start + 3], row[start : start + 3], row[start : start + 3])
            for name, start in (("xyz", 0), ("rpy", 3))
            if any(row[start : start + 3])
        }
        rotation = rotation_from_rpy(roll, pitch, yaw) if "rpy" in given else UNTURNED
        return Pose(
            rotation, position, made_element("origin", self.place(text_span(element)), given)
        )

    def name(self, element: Element) -> str:
        """Return the name of an element, "" with an error if it has none."""
        found = (attribute_text(element, "name") or "").strip()
        if not found:
            self.fail(
                "bad-sdf",
                f"a <{element.name}> has no name",
                element.span,
                hint=f'write <{element.name} name="…">',
            )
        return found


def _number(word: str) -> float | None:
    """Return the number that a word is, or None."""
    try:
        number = float(word) if "_" not in word and word.isascii() else nan
    except ValueError:
        return None
    return None if isnan(number) else number


def _word_span(element: Element, index: int) -> Span:
    """Return where a word in the text of an element is written."""
    span = text_span(element)
    found = list(re.finditer(r"\S+", span.source.text[span.start : span.end]))
    if index >= len(found):
        return span
    return Span(span.source, span.start + found[index].start(), span.start + found[index].end())


def text_span(element: Element) -> Span:
    """Return where the text of an element is written, without the space around it."""
    span = content_span(element)
    text = span.source.text[span.start : span.end]
    if not text.strip():
        return span
    start = span.start + len(text) - len(text.lstrip())
    return Span(span.source, start, start + len(text.strip()))


def compose(first: Pose, second: Pose) -> Pose:
    """Return T_a_c of T_a_b and T_b_c; what moves nothing leaves the other as it is written."""
    if first is IDENTITY:
        return second
    return first if second is IDENTITY else first @ second
