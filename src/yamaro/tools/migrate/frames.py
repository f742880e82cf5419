"""Empty links on fixed joints as frames of the part above them: `frame/name=tool0: {xyz: …}`."""

from __future__ import annotations

from ...model.values import values_of
from ...xml.tree import Element
from .document import Body, Entry
from .elements import note_comments
from .pairing import has_text, name_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .parts import PartWriter


class Frames:
    """Puts frames into the parts whose links they are in.

    A frame makes a joint and a link directly after those of its part. So it is one only if these
    are there: nothing that makes another joint or link is between.
    """

    __slots__ = ("_link", "_part")

    def __init__(self) -> None:
        """Start where there is no part."""
        self._part: Body | None = None
        self._link = ""

    def begin(self, part: Entry | None, link: str = "") -> None:
        """Note the part that was written last, and the name of its link; None for anything else."""
        self._part = None
        self._link = link
        if part is not None and part.key == "part" and isinstance(part.value, Body):
            self._part = part.value

    def take(self, link: Element, joint: Element | None, writer: PartWriter) -> Entry | None:
        """Return the frame that a link and its joint became, which is in the part; None if not."""
        if self._part is None or joint is None or not _is_frame(link, joint, self._link):
            return None
        origin = next((child for child in joint.elements() if child.name == "origin"), None)
        pose = writer.pose_entries(joint, origin)
        if pose is None:
            return None
        frame = Entry(writer.key_of("frame", {"name": name_of(link)}), Body(pose, in_braces=True))
        frame.value = frame.value or None
        note_comments(joint, frame)
        note_comments(link, frame)
        for child in joint.elements():
            note_comments(child, frame)
        holder = _link_of(self._part)
        holder.append(frame)
        return frame


def _is_frame(link: Element, joint: Element, parent: str) -> bool:
    """Return whether a link and its joint are what a frame in the link `parent` makes."""
    name = name_of(link)
    if link.elements() or has_text(link) or has_text(joint) or list(values_of(link)) != ["name"]:
        return False
    if values_of(joint) != {"name": f"{name}_joint", "type": "fixed"} or "," in name:
        return False
    names = sorted(child.name for child in joint.elements())
    if names not in (["child", "parent"], ["child", "origin", "parent"]):
        return False
    ends = {child.name: values_of(child) for child in joint.elements() if child.name != "origin"}
    return (
        name.split() == [name]
        and not any(child.elements() for child in joint.elements())
        and ends == {"parent": {"link": parent}, "child": {"link": name}}
    )


def _link_of(part: Body) -> Body:
    """Return the body of the link of a part, which is added if it has none."""
    part.in_braces = False
    for entry in part:
        if entry.key == "link" or entry.key.startswith("link/"):
            if entry.value is None:
                entry.value = Body()
            assert isinstance(entry.value, Body)
            entry.value.in_braces = False
            return entry.value
    part.entries.append(Entry("link", link := Body()))
    return link
