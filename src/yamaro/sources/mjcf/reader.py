"""Reads MJCF: the document, its tree of bodies, and the robot that is made of them."""

from __future__ import annotations

from .building import Builder
from .classes import unknown
from .document import load
from .tree import Context, Reader

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Element
    from ..host import Host


def read(root: Element, host: Host) -> Element:
    """Return the `<robot>` of a document, with notes and blocks among its children.

    Raises:
        YamaroError: the document has errors, or MuJoCo would refuse it.
    """
    document = load(root, host, host.folder)
    if host.model is not None and host.model != document.name:
        span = root.value_span("model")
        raise unknown("model", host.model, [document.name] if document.name else [], span)
    context = Context(document, host)
    reader = Reader(host)
    world = reader.world(context)
    return Builder(host, reader, context, world).robot()
