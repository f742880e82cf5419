"""A robot that was read, in the spelling of its source: numbers, names of files, comments."""

from __future__ import annotations

import os
from math import isclose, radians

from ...model.compare import NEGLIGIBLE, POSE
from ...model.joint import UNLIMITED
from ...model.pose import rotation_from_quaternion, rpy_from_rotation
from ...model.values import numbers_of, values_of
from ...xml.tree import Comment, Element, Text
from ...xml.values import Numbers, format_value
from .document import literal
from .elements import FILES, comments_at_ends, tidy_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ...source import Span
    from ...xml.reader import XmlDocument
    from ...xml.tree import Node

TOLERANCE = 1e-12
"""How far a number of the source may be from that of the robot to lend it its spelling."""
QUATERNION = "quat"
"""The key of a rotation that the source has as a quaternion."""
ANGLES = frozenset(("lower", "upper"))
"""Values that a source may have in degrees."""
NO_LIMIT = "unlimited"
"""The variable for limits that the source does not have, where URDF wants a number."""


def in_language(element: Element) -> Element:
    """Return a copy of an element as the language spells it, with the source's own numbers."""
    children: list[Node] = []
    for child in element.children:
        if isinstance(child, Element):
            children.append(in_language(child))
        elif isinstance(child, Text):
            text = format_value(child.value)
            if isinstance(child.value, Numbers):
                text = _spelling(text, _source_words(child.span), is_angle=False)
            children.append(Text(literal(text), child.span))
        else:
            children.append(child)
    copy = element.with_children(children)
    copy.attributes = {}
    for name, text in values_of(element).items():
        if isinstance(element.attributes[name], Numbers):
            words = _source_words(element.value_span(name))
            text = _spelling(text, words, is_angle=name in ANGLES)
            if name in POSE:
                text = " ".join(["0" if _is_rounding(word) else word for word in text.split()])
            if element.name == "limit" and _is_unlimited(text):
                copy.attributes[name] = f"{'-' * text.startswith('-')}$({NO_LIMIT})"
                continue
        copy.attributes[name] = literal(text)
    if element.name == "origin" and (quat := _quaternion(element)):
        copy.attributes[QUATERNION] = quat
    return copy


def _quaternion(origin: Element) -> str:
    """Return the quaternion w x y z that the source has where an origin says `rpy`; "" for none."""
    words = _source_words(origin.value_span("rpy")) if "rpy" in origin.attributes else []
    try:
        numbers = [*map(float, words)]
    except ValueError:
        return ""
    if len(numbers) != 4 or not any(numbers):
        return ""
    w, x, y, z = numbers
    angles = rpy_from_rotation(rotation_from_quaternion(x, y, z, w))
    pairs = zip(angles, numbers_of(origin, "rpy"), strict=True)
    same = all(isclose(a, b, rel_tol=TOLERANCE, abs_tol=TOLERANCE) for a, b in pairs)
    return " ".join(word.removeprefix("+") for word in words) if same else ""


def _is_rounding(number: str) -> bool:
    return "e-" in number and abs(float(number)) < NEGLIGIBLE


def _is_unlimited(text: str) -> bool:
    try:
        return abs(float(text)) >= UNLIMITED
    except ValueError:
        return False


def _source_words(span: Span) -> list[str]:
    text = span.source.text[span.start : span.end]
    return text.replace(",", " ").split() if len(text) < 1000 else []


def _spelling(text: str, words: Sequence[str], *, is_angle: bool) -> str:
    """Return numbers in the spelling of those among some words that have the same value.

    Args:
        text: the numbers.
        words: what the source has at the place of the numbers.
        is_angle: whether the source may have them in degrees.
    """
    return " ".join([_number(word, words, is_angle=is_angle) for word in text.split()])


def _number(number: str, words: Sequence[str], *, is_angle: bool) -> str:
    value = float(number)
    for word in words:
        try:
            given = float(word)
        except ValueError:
            continue
        if isclose(given, value, rel_tol=TOLERANCE) or given == value:
            return word.removeprefix("+")
        if is_angle and isclose(radians(given), value, rel_tol=TOLERANCE):
            return f"{word.removeprefix('+')}deg"
    return number.removesuffix(".0")


def copied(root: Element) -> Element:
    """Return a robot whose links can be changed."""
    return root.with_children(
        [
            child.with_children(list(child.children)) if isinstance(child, Element) else child
            for child in root.children
        ]
    )


def move_files(element: Element, home: str, folder: str) -> Element:
    """Return an element in which the names of files lead from another folder.

    Args:
        element: the element, whose names lead from the folder of the file that each is written in.
        home: the folder of a text without a file.
        folder: from where they are to lead.
    """
    folder = os.path.abspath(folder)

    def move(name: str, source: str) -> str:
        if not name or "://" in name or name.startswith("$("):
            return name
        whole = os.path.abspath(os.path.join(os.path.dirname(source) if source else home, name))
        try:
            return os.path.relpath(whole, folder).replace(os.sep, "/")
        except ValueError:  # on another drive
            return whole

    def moved(element: Element) -> Element:
        copy = element.with_children(
            [moved(child) if isinstance(child, Element) else child for child in element.children]
        )
        copy.attributes = {
            name: move(format_value(value), element.value_span(name).source.path)
            if name in FILES
            else value
            for name, value in element.attributes.items()
        }
        return copy

    return moved(element)


# --- comments ---------------------------------------------------------------------------------


def place_comments(
    document: XmlDocument, root: Element, notes: Iterable[Element]
) -> dict[int, list[str]]:
    """Put the comments of a file beside what is made of the elements that they are about.

    Returns:
        the comments about other elements, by where each element is.
    """
    above: dict[int, list[Comment]] = {}
    beside: dict[int, list[Comment]] = {}
    pending = [document.root]
    while pending:
        owner = pending.pop()
        endings = comments_at_ends(owner.children)
        waiting: list[Comment] = []
        latest: Element | None = owner
        for child in owner.children:
            if isinstance(child, Comment) and tidy_text(child.text).strip("=- "):
                if id(child) in endings and latest is not None:
                    beside.setdefault(latest.span.start, []).append(child)
                else:
                    waiting.append(child)
            elif isinstance(child, Element):
                latest = child
                if waiting:
                    above.setdefault(child.span.start, []).extend(waiting)
                    waiting = []
                pending.append(child)
        if waiting:
            above.setdefault(owner.span.start, []).extend(waiting)
    if not above and not beside:
        return {}
    source = document.root.span.source.text
    owners = [root, *notes]
    while owners:
        owner = owners.pop(0)
        children: list[Node] = []
        for child in owner.children:
            if not isinstance(child, Element) or child.span.source.text != source:
                children.append(child)
                continue
            start = child.span.start
            first, last = above.pop(start, []), beside.pop(start, [])
            for comment in first:
                children += [Text("\n", child.span), comment, Text("\n", child.span)]
            children.append(child)
            children += [*last, Text("\n", child.span)] if last else []
            owners.append(child)
        owner.children = children
    left: dict[int, list[str]] = {}
    for place, comments in (*above.items(), *beside.items()):
        left.setdefault(place, []).extend(tidy_text(each.text) for each in comments)
    return left
