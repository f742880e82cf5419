"""Writes the paths of meshes and textures so that they lead to the same files from the output.

In a source a relative path starts at the folder of the file it is written in. Whoever reads the
output starts at the folder of that, or at the folder of a package.
"""

from __future__ import annotations

import os

from ..xmltree import Element, format_value
from .meshes import FILE_ELEMENTS, MeshFinder

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..source import Span
    from ..xmltree import Node, Shared

    Rename = Callable[[str, Span], str]

RELATIVE, KEEP, ABSOLUTE = "relative", "keep", "absolute"
PACKAGE = "package://"
MODES = (RELATIVE, KEEP, ABSOLUTE, PACKAGE + "NAME")


class MeshPaths:
    """How the files of meshes and textures are named in the output.

    What is not there, or may not be read, is named as it is written.

    Attributes:
        finder: tells where files and packages are.
    """

    __slots__ = ("_folder", "_mode", "_package", "finder")

    def __init__(self, mode: str, folder: str, finder: MeshFinder) -> None:
        """Name files for an output in a folder.

        Args:
            mode: one of `MODES`: paths relative to the folder, as written, absolute, or in a
                package.
            folder: where the output is, absolute.
            finder: tells where files and packages are.

        Raises:
            ValueError: the package is not found, or there is no such mode.
        """
        self.finder = finder
        self._folder = folder
        self._mode = mode
        self._package = ""
        name = mode.removeprefix(PACKAGE)
        if name != mode:
            self._package = finder.package_folder(name, folder) or ""
            if not self._package:
                raise ValueError(f"the package '{name}' is not found")
        elif mode not in MODES:
            raise ValueError(f"'{mode}' is none of {', '.join(MODES)}")

    def applied_to(self, root: Element, shared: Shared) -> tuple[Element, Shared]:
        """Return a robot with these paths, and the elements shared in it; `root` stays as it is."""
        if self._mode == KEEP:
            return root, shared
        renaming = _Renaming(self.named, shared)
        children = [
            renaming.element(child)
            if isinstance(child, Element) and child.name in ("link", "material")
            else child
            for child in root.children
        ]
        return root.with_children(children), {**shared, **renaming.shared}

    def named(self, filename: str, span: Span) -> str:
        """Return the name of a file that is referred to at a span."""
        is_relative = "://" not in filename and not os.path.isabs(filename)
        if self._mode == RELATIVE and not is_relative:
            return filename
        path = self.finder.reachable(filename, span)
        if path is None:
            return filename
        if self._mode == ABSOLUTE:
            return path
        if self._package:
            inner = _below(path, self._package)
            if inner is not None:
                return f"{self._mode}/{inner}"
        return self._from_folder(filename, path) if is_relative else filename

    def _from_folder(self, filename: str, path: str) -> str:
        """Return the path of a file from the folder of the output."""
        as_written = os.path.join(self._folder, filename)
        if os.path.realpath(as_written) == os.path.realpath(path):
            return filename
        folder, name = os.path.split(path)
        try:  # `..` leads up from where a link leads to
            found = os.path.relpath(os.path.realpath(folder), os.path.realpath(self._folder))
        except ValueError:  # on another drive of Windows
            return path
        return os.path.normpath(os.path.join(found, name)).replace(os.sep, "/")


def _below(path: str, folder: str) -> str | None:
    """Return the way from a folder to a file in it, or None if it is not in it."""
    for one, other in ((path, folder), (os.path.realpath(path), os.path.realpath(folder))):
        prefix = other.rstrip(os.sep) + os.sep
        if one.startswith(prefix):
            return one[len(prefix) :].replace(os.sep, "/")
    return None


class _Renaming:
    """Copies what holds a file whose name changes; all else stands in both trees."""

    __slots__ = ("_done", "_lists", "_rename", "_shared", "shared")

    def __init__(self, rename: Rename, shared: Shared) -> None:
        self._rename = rename
        self._shared = shared
        self._done: dict[int, Element] = {}
        self._lists: dict[int, list[Node]] = {}
        self.shared: Shared = {}  # the copies that stand in several places

    def element(self, element: Element) -> Element:
        """Return an element with the names changed in it: itself if there are none."""
        if id(element) in self._done:
            return self._done[id(element)]
        children = self._children(element.children)
        changed = element
        if children is not element.children:
            changed = element.with_children(children)
        filename = element.attributes.get("filename")
        if filename is not None and element.name in FILE_ELEMENTS:
            changed = self._named(changed, format_value(filename))
        if id(element) in self._shared:
            self._done[id(element)] = changed
            if changed is not element:
                self.shared[id(changed)] = {}
        return changed

    def _named(self, element: Element, filename: str) -> Element:
        name = self._rename(filename, element.value_span("filename"))
        if name == filename:
            return element
        changed = element.with_children(element.children)
        changed.attributes = {**element.attributes, "filename": name}
        return changed

    def _children(self, children: list[Node]) -> list[Node]:
        if id(children) in self._lists:
            return self._lists[id(children)]
        made = [self.element(child) if isinstance(child, Element) else child for child in children]
        if all(one is other for one, other in zip(made, children, strict=True)):
            made = children
        if id(children) in self._shared:
            self._lists[id(children)] = made
            if made is not children:
                self.shared[id(made)] = {}
        return made
