"""The table of sources: the formats that are read besides URDF and xacro, by their root element.

A source is a package of its name, whose module `reader` has the function `read`.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..xml.tree import Element
    from .host import Host

    Read = Callable[[Element, Host], Element]


class SourceFormat:
    """A format that robots are read from.

    Attributes:
        name: its package, and the output format that its own blocks are for.
        title: what messages call it.
        root: the outermost element of its documents.
        endings: those of the names of its files.
    """

    __slots__ = ("endings", "name", "root", "title")

    def __init__(self, name: str, title: str, root: str, endings: tuple[str, ...]) -> None:
        self.name = name
        self.title = title
        self.root = root
        self.endings = endings


SOURCES = {
    each.root: each
    for each in (
        SourceFormat("mjcf", "MJCF", "mujoco", (".xml", ".mjcf")),
        SourceFormat("sdf", "SDF", "sdf", (".sdf", ".world")),
    )
}
"""The formats by the name of the outermost element."""
SOURCES["gazebo"] = SOURCES["sdf"]  # up to SDFormat 1.2; in URDF it has no version


def source_of(root: Element) -> SourceFormat | None:
    """Return the format of a document besides URDF and xacro, None if it has none of them."""
    if root.name == "gazebo" and "version" not in root.attributes:
        return None
    return SOURCES.get(root.name)


def read_source(root: Element, host: Host) -> Element | None:
    """Return the `<robot>` that a document of another format describes; None for other documents.

    Among its children are notes, and blocks for the format that it comes from.

    Raises:
        YamaroError: the document has errors.
    """
    source = source_of(root)
    if source is None:
        return None
    from importlib import import_module

    read: Read = import_module(f"{__package__}.{source.name}.reader").read
    return read(root, host)
