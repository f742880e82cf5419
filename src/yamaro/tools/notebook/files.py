"""The meshes and textures of a robot, as a page holds them that can fetch nothing.

They are the files that `yamaro view` would serve: see `tools/view/mesh_files.py`.
"""

from __future__ import annotations

import base64
import gzip
import os

from ...confined import Reader
from ...diagnostics import YamaroError
from ...files.mesh_files import MeshFinder
from ...files.regular import open_regular
from ...model.link import Visual
from ...model.shapes import Mesh
from ...model.values import attribute_text
from ...policy import SAFE, Policy
from ...request import finder_for, reach_of
from ..view.mesh_files import Library, MeshFiles

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...model.link import Collision
    from ...model.robot import Robot
    from ...xml.tree import Element

    Json = dict[str, object]

LARGEST = 64 << 20
"""Bytes of a mesh with its textures that are worth compressing."""


class PageFiles:
    """The files that a page holds.

    Attributes:
        packed: type and compressed bytes of each file, by the key that the page has for it.
    """

    def __init__(self, robot: Robot, room: int) -> None:
        """Take the files of a robot while there is room, in characters.

        Those of visuals come first, as collisions are hidden until the user shows them.
        """
        self.packed: dict[str, dict[str, str]] = {}
        self._room = room
        self._finder = robot.finder or _finder_of(robot)
        self._keys: dict[str, str] = {}  # in the page, by those of `_files`
        paths = [path for each in _elements(robot) if (path := self._path(each)[0]) is not None]
        reach = self._finder.reach
        reader = None
        if reach is not None:
            reader = Reader(Policy(SAFE), readable=reach.roots, name=robot.name)
        library = Library(reader, reach)
        library.look_up(paths)
        self._files = MeshFiles(reach, library)
        self._told = {path: self._add(path) for path in dict.fromkeys(paths)}

    def of(self, element: Element) -> Json:
        """Return what the page has to know about a mesh or texture; a fault if it is not there."""
        path, fault = self._path(element)
        return self._told[path] if path is not None else {"fault": fault}

    def _path(self, element: Element) -> tuple[str | None, str]:
        """Return where a file is, or None and why it is not shown."""
        filename = attribute_text(element, "filename") or ""
        try:
            path = self._finder.resolve(filename, element.value_span("filename"))
        except YamaroError:
            return None, "it is outside of the folders that this robot may read"
        return path, "it was not found"

    def _add(self, path: str) -> Json:
        """Take a file and those that it refers to; return what the page has to know about it."""
        told = self._files.add(path)
        if told is None:
            return {"fault": "it is not a file that can be shown"}
        if "fault" in told:
            return told
        companions = told["companions"]
        assert isinstance(companions, dict)
        keys = dict.fromkeys([str(told["key"]), *companions.values()])
        new = [key for key in keys if key not in self._keys]
        found: list[tuple[str, str]] = []
        left = LARGEST
        for key in new:
            data = self._read(key, left)
            if data is None:
                return {"fault": "it cannot be read, or is too large for a notebook"}
            left -= len(data)
            found.append((key, packed(data)))
        size = sum(len(text) for _, text in found)
        if size > self._room:
            return {"fault": f"it is too large for a notebook: {size / 1e6:.1f} MB"}
        self._room -= size
        for key, text in found:
            own = self._keys[key] = str(len(self._keys))
            self.packed[own] = {"type": self._files.types[key], "data": text}
        names = {name: self._keys[key] for name, key in companions.items()}
        return {**told, "key": self._keys[str(told["key"])], "companions": names}

    def _read(self, key: str, most: int) -> bytes | None:
        """Return the bytes of a file, if they are not too many.

        Where it lies is looked at again: it may have become a link since.
        """
        path, reach = self._files.paths[key], self._finder.reach
        try:
            with open_regular(path) as file:
                if reach is not None and not reach.is_of(path, file.fileno()):
                    return None
                data = file.read(most + 1)
        except OSError:
            return None
        return data if len(data) <= most else None


def packed(data: bytes) -> str:
    """Return bytes as the page reads them: compressed, in base64; the same for the same bytes."""
    return base64.b64encode(gzip.compress(data, 6, mtime=0)).decode()


def mesh_of(section: Visual | Collision) -> Element | None:
    """Return the element that names the mesh of a shape."""
    return section.shape.element if isinstance(section.shape, Mesh) else None


def texture_of(section: Visual | Collision) -> Element | None:
    """Return the element that names the texture of a shape."""
    material = section.material if isinstance(section, Visual) else None
    return material.inner("texture") if material is not None else None


def _elements(robot: Robot) -> Iterator[Element]:
    """Yield all meshes and textures, those of visuals first."""
    sections: list[Visual | Collision] = [each for _, each in robot.visuals()]
    sections += [each for link in robot.links.values() for each in link.collisions]
    found = [each for section in sections for each in (mesh_of(section), texture_of(section))]
    found += [material.inner("texture") for material in robot.materials.values()]
    yield from (each for each in found if each is not None)


def _finder_of(robot: Robot) -> MeshFinder:
    """Return what finds the files of a robot that was not built, as far as safe mode may read.

    A robot that is in no file may read what one in the working directory may.
    """
    path = robot.element.span.source.path or os.path.join(os.getcwd(), "robot.urdf")
    reach = reach_of(path, Policy(SAFE), {})
    return MeshFinder(finder_for(path, reach, {}), reach, start=os.path.dirname(path))
