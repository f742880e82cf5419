"""Overlays as they are written: data in YAML or JSON, as elements with the place of each value.

What they mean is up to `robot/overlay.py`. Nothing in them is run: an expression is an error. The
calibrations of two makers are known by what is in them, and taken as they are.
"""

from __future__ import annotations

import os

from ..diagnostics import (
    Frame,
    Reporter,
    YamaroError,
    add_trace,
    did_you_mean,
    failure,
    failure_of_all,
)
from ..files.loader import LoadError
from ..source import KEYWORD_ARGUMENT, Source, Span
from ..syntax.values import is_empty, refuse_twice
from ..xml.tree import Element, OverlaidInclude, RobotWord, Text
from ..xml.values import LiteralList, format_value
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from ..yaml.reader import read
from .predefined import plain_data

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Any

    from ..policy import Limits
    from ..syntax.nodes import IncludeNode
    from ..xml.tree import Node
    from ..yaml.nodes import YamlNode
    from .interpreter import Interpreter
    from .scope import Scope

OVERLAY = "overlay"
"""The key of an overlay: the only one at the root of its file."""
KINEMATICS, LEROBOT = "kinematics", "lerobot"
"""What is in an overlay that is a calibration of Universal Robots, or of LeRobot."""
_OF_POSE = frozenset(("x", "y", "z", "roll", "pitch", "yaw"))
_OF_MOTOR = frozenset(("homing_offset", "range_min", "range_max"))


def overlay_in(source: Source, limits: Limits, reporter: Reporter) -> Element | None:
    """Return the overlay or calibration that a file is, None for any other file.

    Raises:
        YamaroError: it is not YAML, or holds an expression.
    """
    root = read(source, reporter=Reporter(), limits=limits, units=True)
    if not isinstance(root, MappingNode):
        return None
    is_one = [key.text for key, _ in root.pairs] == [OVERLAY] and isinstance(
        root.pairs[0][1], MappingNode
    )
    if is_one:  # and no element of that name, in XML of some other kind
        keys = {key.text for key, _ in root.pairs[0][1].pairs}
        is_one = not keys.isdisjoint(("joints", "links"))
    if not is_one and _calibration_in(root) is None:
        return None
    return read_overlay(source, limits, reporter)


def read_overlay(source: Source, limits: Limits, reporter: Reporter) -> Element:
    """Return the overlay in a file.

    Raises:
        YamaroError: it is not YAML or JSON, not an overlay, or holds an expression.
    """
    if source.is_xml:
        raise _no_overlay(Span(source, 0, 1), "XML")
    root = read(source, reporter=reporter, limits=limits, units=True)
    if not isinstance(root, MappingNode):
        raise _no_overlay(root.span(), "a list" if isinstance(root, SequenceNode) else "a value")
    if not root.pairs:
        raise _no_overlay(root.span(), "empty")
    calibration = _calibration_in(root)
    if calibration is not None:
        name, node = calibration
        return Element(OVERLAY, root.span(), children=[_element(name, node.span(), node)])
    for key, _ in root.pairs:
        if key.text != OVERLAY:
            is_section = key.text in ("joints", "links")
            raise failure(
                "not-an-overlay",
                f"'{key.text}' is not a section of an overlay file, whose only one is `{OVERLAY}`",
                key.span(),
                hint=f"write `{OVERLAY}:` above it, and indent it" if is_section else _EXAMPLE,
            )
    if len(root.pairs) > 1:
        refuse_twice(root.pairs[0], root.pairs[1][0], "file")
    return overlay_of(*root.pairs[0])


_EXAMPLE = "write overlay: {joints: {NAME: {…}}, links: {NAME: {…}}}"


def overlay_of(key: ScalarNode, node: YamlNode) -> Element:
    """Return the overlay that is written under a key.

    Raises:
        YamaroError: it holds an expression, or is not a mapping.
    """
    if not isinstance(node, MappingNode):
        raise failure(
            "not-an-overlay",
            f"`{OVERLAY}` holds `joints` and `links`, and under these names with values",
            node.span() if not isinstance(node, ScalarNode) or node.text else key.span(),
            hint=_EXAMPLE,
        )
    return _element(OVERLAY, key.span(), node)


def _calibration_in(root: MappingNode) -> tuple[str, MappingNode] | None:
    """Return the calibration of a maker that a file is, and what it is called as an overlay."""
    pairs = root.pairs
    if len(pairs) == 1 and pairs[0][0].text == KINEMATICS:
        inner = pairs[0][1]
        if isinstance(inner, MappingNode) and any(
            key.text != "hash" and not _keys(node).isdisjoint(_OF_POSE) for key, node in inner.pairs
        ):
            return KINEMATICS, inner
    if pairs and all(_keys(node) >= _OF_MOTOR for _, node in pairs):
        return LEROBOT, root
    return None


def _keys(node: YamlNode) -> set[str]:
    return {key.text for key, _ in node.pairs} if isinstance(node, MappingNode) else set()


def _element(name: str, span: Span, node: YamlNode) -> Element:
    """Return a value as an element in which its entries are elements.

    Raises:
        YamaroError: there are expressions in it, or lists of anything but values.
    """
    faults: list[YamaroError] = []
    element = Element(name, span)
    pending = [(element, node)]
    while pending:
        owner, node = pending.pop()
        if isinstance(node, MappingNode):
            for key, inner in node.pairs:
                _refuse_expression(key, faults)
                child = Element(key.text, key.span())
                owner.children.append(child)
                pending.append((child, inner))
        elif isinstance(node, ScalarNode):
            _refuse_expression(node, faults)
            if not is_empty(node):
                owner.children.append(Text(node.text, node.span()))
        else:
            items = LiteralList()
            for item in node.items:
                if isinstance(item, ScalarNode):
                    _refuse_expression(item, faults)
                    items.append(item.text)
                    continue
                fault = failure(
                    "value-expected",
                    f"'{owner.name}' takes a list of values, and this is a mapping or a list",
                    item.span(),
                    hint=f"write {owner.name}: {{…}} without the list",
                )
                faults.append(fault)
            owner.children.append(Text(items, node.span()))
    if faults:
        found = [each for fault in faults for each in fault.diagnostics]
        raise YamaroError(sorted(found, key=lambda each: each.span.start))
    return element


def _refuse_expression(node: ScalarNode, faults: list[YamaroError]) -> None:
    for mark in ("$(", "${"):
        start = node.text.find(mark)
        if start >= 0:
            fault = failure(
                "overlay-expression",
                "an overlay holds values, not expressions",
                node.span(start, len(node.text)),
                hint="write the value; what is computed belongs in the robot's file",
            )
            faults.append(fault)
            return


def _no_overlay(span: Span, what: str) -> YamaroError:
    return failure("not-an-overlay", f"this is {what}, not an overlay", span, hint=_EXAMPLE)


# --- overlays of a build, and beside the path of an include -------------------------------------


def given_overlays(
    interpreter: Interpreter, overlays: Sequence[str | Mapping[str, Any]]
) -> list[Element]:
    """Return the overlays that a build was asked for with: files, or mappings from Python.

    Raises:
        YamaroError: one cannot be read, or is not an overlay.
    """
    found = []
    for overlay in overlays:
        if isinstance(overlay, str):
            path = os.path.abspath(overlay)
            files = interpreter.files
            try:
                source = files.read_given(path, overlay)
            except LoadError as error:
                near = did_you_mean(os.path.basename(path), files.neighbours(path))
                message = f"the overlay cannot be read: {error}"
                raise failure_of_all(error.code, message, overlay, error.hint or near) from None
        else:
            import json

            whole = overlay if OVERLAY in overlay else {OVERLAY: overlay}
            source = Source(json.dumps(whole, default=plain_data), name=KEYWORD_ARGUMENT)
        found.append(read_overlay(source, interpreter.limits, interpreter.reporter))
    return found


def overlays_of_include(
    interpreter: Interpreter, node: IncludeNode, scope: Scope, prefix: str, frame: Frame
) -> list[Node]:
    """Return the words that let overlays change what an include has made.

    Args:
        interpreter: the conversion.
        node: the include.
        scope: where it is.
        prefix: what it has put before the names of links and joints.
        frame: its step.

    Raises:
        YamaroError: an overlay cannot be read, or is not an overlay; or no part may be here.
    """
    words: list[Node] = []
    for overlay in node.overlays:
        if interpreter.element_depth or not interpreter.is_robot:
            raise failure(
                "overlay-without-robot",
                "an overlay changes a robot, and this include is not directly in one",
                node.overlay_span or node.span,
                hint="move the include to the model of a robot",
                trace=interpreter.frame,
            )
        trace = interpreter.frame
        if isinstance(overlay, MappingNode):
            element = _element(OVERLAY, node.overlay_span or node.span, overlay)
        else:
            span = overlay.span
            text = format_value(interpreter.values.written(overlay.value, scope)).strip()
            if not text:
                continue
            source = interpreter.files.load(text, span, scope.home)
            trace = Frame("read", source.name, span, parent=trace)
            try:
                element = read_overlay(source, interpreter.limits, interpreter.reporter)
            except YamaroError as error:
                add_trace(error, trace)
                raise
        word = RobotWord("overlay", node.span, trace=trace, body=OverlaidInclude(frame, prefix))
        word.children = [element]
        words.append(word)
    if words:
        interpreter.has_parts = True
    return words
