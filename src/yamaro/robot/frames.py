"""Lowers `frame`: a named pose in a link, as an empty link on a fixed joint."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..xml.tree import Element
from ..xml.values import format_value
from .fields import sort_fields
from .notes import check_keys
from .places import FRAME
from .pose import origin_element, read_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node
    from .lowering import Lowering
    from .pose import Pose


def lower_frame(lowering: Lowering, word: Element, link: str, out: list[Node]) -> None:
    """Append the joint and the empty link that are a frame in URDF; record what is wrong."""
    try:
        name = name_of_word(word, "tool0")
        check_keys(word, FRAME.keys)
        fields = sort_fields(lowering, word, FRAME)
        pose = read_pose(lowering, fields)
    except YamaroError as error:
        lowering.absorb(error)
        return
    out += frame_elements(lowering, word, name, link, pose)


def frame_elements(
    lowering: Lowering, word: Element, name: str, link: str, pose: Pose
) -> list[Node]:
    """Return a fixed joint and the empty link on it: what a frame is in URDF."""
    span = word.value_span("name")
    trace = lowering.trace
    children: list[Node] = [
        Element("parent", word.span, {"link": link}, trace=trace),
        Element("child", span, {"link": name}, trace=trace),
    ]
    origin = origin_element(pose, word)
    if origin is not None:
        children.append(origin)
    spans = {"name": span}
    joint = Element(
        "joint",
        word.span,
        {"name": f"{name}_joint", "type": "fixed"},
        children,
        trace,
        spans,
    )
    return [joint, Element("link", word.span, {"name": name}, [], trace, spans)]


def name_of_word(word: Element, example: str) -> str:
    """Return the name in `frame/name=tool0`, the only attribute that such a key has.

    Raises:
        YamaroError: there is no name, or another attribute.
    """
    for attribute in word.attributes:
        if attribute != "name":
            raise failure(
                "unknown-key",
                f"`{word.name}` takes its name as an attribute, and '{attribute}' as an entry",
                word.name_span(attribute),
                hint=f"write {word.name}/name={example}: {{{attribute}: …}}, or <{word.name}/…>: "
                "for an XML element",
                trace=word.trace,
            )
    name = format_value(word.attributes.get("name")).strip()
    if not name:
        raise failure(
            "missing-name",
            f"this {word.name} has no name",
            word.span,
            hint=f"write {word.name}/name={example}:, or <{word.name}>: for an XML element",
            trace=word.trace,
        )
    return name
