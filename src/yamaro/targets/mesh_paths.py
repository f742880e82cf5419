"""Writes the paths of meshes and textures so that they lead to the same files from the output.

In a source a relative path starts at the folder of the file that contains it. The reader of the
output starts at the folder of that, or at the folder of a package.
"""

from __future__ import annotations

import os
from operator import is_

from ..files.mesh_files import ABSOLUTE, COPY, FILE_ELEMENTS, KEEP, NONE, RELATIVE, MeshFinder
from ..files.regular import MADE
from ..xml.tree import Element
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..source import Span
    from ..xml.tree import Node
    from .assets import Assets, Run

    Rename = Callable[[str, Span], str]

PACKAGE = "package://"
MODES = (RELATIVE, KEEP, ABSOLUTE, COPY, PACKAGE + "NAME", PACKAGE, NONE)


class MeshPaths:
    """How the files of meshes and textures are named in the output.

    What is not there, or may not be read, is named as it is written.

    Attributes:
        assets: the copies of files, with the mode `COPY`.
        finder: finds files and packages.
        is_cached: whether converted meshes are kept on the disk from one run to the next.
        run: runs what parses files that others wrote, in a jail if they are not trusted.
    """

    __slots__ = ("_folder", "_mode", "_package", "assets", "finder", "is_cached", "run")

    def __init__(
        self,
        mode: str,
        folder: str,
        finder: MeshFinder,
        *,
        run: Run | None = None,
        is_cached: bool = False,
    ) -> None:
        """Name files for an output in a folder.

        Args:
            mode: one of `MODES`: paths relative to the folder, as written, absolute, to copies, in
                a package, in the package that each file is in, or no meshes at all.
            folder: where the output is, absolute.
            finder: finds files and packages.
            run: see the attribute; None calls it.
            is_cached: see the attribute.

        Raises:
            ValueError: the package is not found, or there is no such mode.
        """
        self.finder = finder
        self._folder = folder
        self._mode = mode
        self.run: Run = run or (lambda work: work())
        self.assets: Assets | None = None
        if mode == COPY:
            from .assets import Assets

            self.assets = Assets(finder, self.run)
        self.is_cached = is_cached
        self._package = ""
        name = mode.removeprefix(PACKAGE)
        if name and name != mode:
            self._package = finder.package_folder(name, folder) or ""
            if not self._package:
                raise ValueError(f"the package '{name}' is not found")
        elif mode not in MODES:
            raise ValueError(f"'{mode}' is not one of {', '.join(MODES)}")

    def applied_to(self, root: Element) -> Element:
        """Return a robot with these paths; `root` stays as it is."""
        if self._mode == KEEP:
            return root
        renaming = _Renaming(self.named, has_meshes=self._mode != NONE)
        children = [
            renaming.element(child)
            if isinstance(child, Element) and child.name in ("link", "material")
            else child
            for child in root.children
        ]
        return root.with_children(children)

    def named(self, filename: str, span: Span) -> str:
        """Return the name of a file that is referred to at a span."""
        is_relative = "://" not in filename and not os.path.isabs(filename)
        if self._mode in (RELATIVE, NONE) and not is_relative:
            return filename
        if self._mode == PACKAGE and "://" in filename:
            return filename
        path = self.finder.reachable(filename, span)
        if path is None:
            return filename
        if path.startswith(MADE):
            # The name of a file that is written beside the output, by the path from there.
            path = os.path.join(self._folder, *filename.split("/"))
            if self._mode == ABSOLUTE:
                return path
            found = (self._mode, self._package) if self._package else None
            if self._mode == PACKAGE:
                around = self.finder.package_around(path)
                found = around and (PACKAGE + around[0], around[1])
            inner = _below(path, found[1]) if found else None
            return f"{found[0]}/{inner}" if found and inner is not None else filename
        if self._mode == ABSOLUTE:
            return path
        if self.assets is not None:
            return self.assets.name_of(path) or filename
        if self._mode == PACKAGE:
            found = self.finder.package_around(path)
            if found is not None:
                name, folder = found
                return f"{PACKAGE}{name}/{_below(path, folder)}"
            from pathlib import Path

            return Path(path).as_uri()
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


def _is_mesh_shape(node: Node) -> bool:
    """Return whether a node is a visual or collision that shows a mesh."""
    return (
        isinstance(node, Element)
        and node.name in ("visual", "collision")
        and any(
            shape.name == "mesh"
            for child in node.elements()
            if child.name == "geometry"
            for shape in child.elements()
        )
    )


def _below(path: str, folder: str) -> str | None:
    """Return the way from a folder to a file in it, or None if it is not in it."""
    for one, other in ((path, folder), (os.path.realpath(path), os.path.realpath(folder))):
        prefix = other.rstrip(os.sep) + os.sep
        if one.startswith(prefix):
            return one[len(prefix) :].replace(os.sep, "/")
    return None


class _Renaming:
    """Copies what holds a file whose name changes; all else is in both trees."""

    __slots__ = ("_has_meshes", "_rename")

    def __init__(self, rename: Rename, *, has_meshes: bool) -> None:
        self._rename = rename
        self._has_meshes = has_meshes

    def element(self, element: Element) -> Element:
        """Return an element with the names changed in it: itself if there are none."""
        memo = element.memo
        if memo is None:
            return self._changed(element)
        if memo.renamed is None:
            changed = self._changed(element)
            memo.renamed = element, changed
            if changed is not element:
                changed.share(memo.own)
        before, after = memo.renamed
        if before is element or memo.own is None:
            return after  # type: ignore[no-any-return]
        if before is after:
            return element
        assert memo.own == 0, "a joint refers to no file"
        return after.like(element.attributes, after.children, element.trace)  # type: ignore[no-any-return]

    def _changed(self, element: Element) -> Element:
        changed, children = element, element.children
        if not self._has_meshes:
            children = [child for child in children if not _is_mesh_shape(child)]
        made = [self.element(child) if isinstance(child, Element) else child for child in children]
        if len(made) != len(element.children) or not all(map(is_, made, element.children)):
            changed = element.with_children(made)
        filename = element.attributes.get("filename")
        if filename is not None and element.name in FILE_ELEMENTS:
            written = format_value(filename)
            name = self._rename(written, element.value_span("filename"))
            if name != written:
                changed = changed.with_children(changed.children)
                changed.attributes = {**element.attributes, "filename": name}
        return changed
