"""The HTML that a notebook shows of a `Build` or `Robot`.

A robot is a page of its own in a frame. All that comes from the robot is in it as base64, and the
page makes text of it, never markup. The frame has no origin and may load nothing, so even a fault
of the page would not let a robot act on the notebook, which can run code.
"""

from __future__ import annotations

import base64
import gzip
import html
import json
import os

from ...confined import Reader
from ...diagnostics import YamaroError
from ...files.mesh_files import MeshFinder
from ...files.regular import MADE, open_regular
from ...model.joint import FIXED
from ...model.link import Collision, Visual
from ...model.robot import Robot
from ...model.shapes import Mesh
from ...model.values import attribute_text
from ...policy import SAFE, Policy
from ...request import finder_for, reach_of
from ...result import Build
from ...xml.tree import Element, unshared
from ...xml.writer import write
from .. import view
from .description import finite_positions
from .mesh_files import Library, MeshFiles

Json = dict[str, object]

MOST_CHARACTERS = 8_000_000
"""Of a page, which the file of the notebook holds as long as it has that output."""
MOST_TEXT = 100_000
"""Characters of a document that is shown as text."""
HEIGHT = 420
"""Pixels of the frame; it is as wide as the notebook."""


def html_of(result: Build | Robot) -> str:
    """Return what a notebook shows of a `Build` or `Robot`; nothing is raised."""
    try:
        if isinstance(result, Build):
            try:
                robot = result.robot
            except (YamaroError, ValueError):  # another document, or its tree stayed in a jail
                text = result.xml()
                shown = html.escape(text[:MOST_TEXT])
                style = f"max-height: {HEIGHT}px; overflow: auto; white-space: pre; margin: 0"
                more = len(text) - MOST_TEXT
                note = _note(f"{more:,} more characters are not shown.") if more > 0 else ""
                return f'<pre style="{style}">{shown}</pre>{note}'
        else:
            robot = result
        page = _page(robot)
        if page is None:
            return _note(
                f"The robot '{robot.name}' is too large for a notebook: {summary(robot)}. "
                "The command `yamaro view` shows it."
            )
        title = html.escape(f"Robot {robot.name}".strip())
        style = f"display: block; width: 100%; height: {HEIGHT}px; border: 0"
        frame = f'<iframe title="{title}" sandbox="allow-scripts" style="{style}" srcdoc="'
        return f'{frame}{html.escape(page)}"></iframe>'
    except Exception as error:  # a notebook would show a traceback in place of the result
        return _note(f"This cannot be shown: {type(error).__name__}: {error}")


def _page(robot: Robot) -> str | None:
    """Return the page of a robot, or None if that would be too large."""
    page = _static("notebook.html").replace("/*STYLE*/", _static("notebook.css").strip())
    page = page.replace(">CODE<", f">{packed(_static('view.js').encode())}<")
    urdf = write(unshared(robot.element))
    room = MOST_CHARACTERS - len(page) - len(packed(urdf.encode()))
    if room < 0:
        return None
    files = PageFiles(robot, room)
    data = json.dumps({**describe(robot, files), "urdf": urdf})
    page = page.replace(">FILES<", f">{json.dumps(files.packed)}<")
    return page.replace(">ROBOT<", f">{packed(data.encode())}<")


def _static(name: str) -> str:
    """Return a file of the page."""
    path = os.path.join(os.path.dirname(view.__file__), "static", name)
    with open(path, encoding="utf-8") as file:
        return file.read()


def _note(text: str) -> str:
    return f"<p>{html.escape(text)}</p>"


# --- the meshes and textures of a robot, as a page holds them that can fetch nothing ----------


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
        if robot.finder is not None:
            self._finder = robot.finder
        else:  # it was not built: it may read what safe mode allows where it lies
            start = robot.element.span.source.path or os.path.join(os.getcwd(), "robot.urdf")
            reach = reach_of(start, Policy(SAFE), {})
            folder = os.path.dirname(start)
            self._finder = MeshFinder(finder_for(start, reach, {}), reach, start=folder)
        self._keys: dict[str, str] = {}  # in the page, by those of `_files`
        sections: list[Visual | Collision] = [each for _, each in robot.visuals()]
        sections += [each for link in robot.links.values() for each in link.collisions]
        found = [each for section in sections for each in (mesh_of(section), texture_of(section))]
        found += [material.inner("texture") for material in robot.materials.values()]
        elements = [each for each in found if each is not None]
        paths = [path for each in elements if (path := self._path(each)[0]) is not None]
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
        path = self._files.paths[key]
        reach = None if path.startswith(MADE) else self._finder.reach
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


# --- what the page in a notebook has to know about a robot besides its URDF -------------------


def describe(robot: Robot, files: PageFiles) -> Json:
    """Return the files of its shapes, its named states, and a line about it.

    Where things are written is left out: a notebook is passed on to people who do not have the
    files, and paths say much about the machine.
    """
    links: Json = {
        name: {
            "visual": [_shape(visual, files) for visual in link.visuals],
            "collision": [_shape(collision, files) for collision in link.collisions],
        }
        for name, link in robot.links.items()
    }
    textures: Json = {}
    for name, material in robot.materials.items():
        texture = material.inner("texture")
        if texture is not None and (file := _texture(texture, files)):
            textures[name] = file
    return {
        "links": links,
        "textures": textures,
        "states": {name: finite_positions(state.positions) for name, state in robot.states.items()},
        "summary": summary(robot),
    }


def _shape(section: Visual | Collision, files: PageFiles) -> Json:
    mesh, texture = mesh_of(section), texture_of(section)
    found: Json = {}
    if mesh is not None:
        found["mesh"] = files.of(mesh)
    if texture is not None:
        found["texture"] = _texture(texture, files)
    return found


def _texture(element: Element, files: PageFiles) -> Json | None:
    file = files.of(element)
    return None if "fault" in file else file


def summary(robot: Robot) -> str:
    """Return a line about a robot."""
    moving = sum(joint.type != FIXED for joint in robot.joints.values())
    words = [_counted(len(robot.links), "link"), _counted(moving, "moving joint")]
    if robot.mass > 0:
        words.append(f"{robot.mass:.4g} kg")
    return ", ".join(words)


def _counted(count: int, noun: str) -> str:
    return f"{count:,} {noun}{'' if count == 1 else 's'}"
