"""What the page has to know about a built robot, as data for JSON."""

from __future__ import annotations

from math import isfinite

from ...diagnostics import ERROR, WARNING, Diagnostic, YamaroError
from ...model.link import Visual
from ...model.shapes import Mesh
from ...model.values import attribute_text
from ...rendering import render
from .origins import Owners, Places

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from ...diagnostics import Frame
    from ...model.link import Collision, Link
    from ...model.robot import Robot
    from ...result import Build
    from ...xml.tree import Element
    from .mesh_files import MeshFiles
    from .origins import Json


class Description:
    """A robot as the page shows it.

    Attributes:
        data: the URDF; where its links and joints were written; their meshes.
        places: the places that the numbers in it mean.
        awaited: the files it refers to that are not there, by the paths where they would be.
    """

    def __init__(self, build: Build, files: MeshFiles) -> None:
        """Describe a robot; `files` takes note of what it refers to."""
        self.places = Places()
        self.awaited: list[str] = []
        self._finder = build.finder
        self._files = files
        self._refused: dict[str, Diagnostic] = {}  # by message
        robot = build.robot
        owners = Owners(robot)
        self.data: Json = {
            "urdf": build.xml(),
            "root": build.root_name,
            "links": {name: self._link(link) for name, link in robot.links.items()},
            "joints": {
                name: self.places.origin(joint.span, joint.trace)
                for name, joint in robot.joints.items()
            },
            "textures": self._textures(robot),
            "states": {
                state.name: finite_positions(state.positions) for state in robot.states.values()
            },
        }
        warnings = (*build.warnings, *self._refused.values())
        self.data["diagnostics"] = [self._diagnostic(each, owners) for each in warnings]
        self.data["places"] = self.places.texts

    def _link(self, link: Link) -> Json:
        return {
            **self.places.origin(link.span, link.trace),
            "visual": [self._shape(visual, link) for visual in link.visuals],
            "collision": [self._shape(collision, link) for collision in link.collisions],
        }

    def _shape(self, section: Visual | Collision, link: Link) -> Json:
        trace = section.trace_in(link)
        found = self.places.origin(section.span, trace)
        if isinstance(section.shape, Mesh) and section.shape.element is not None:
            found["mesh"] = self._file(section.shape.element, trace)
        material = section.material if isinstance(section, Visual) else None
        texture = material.inner("texture") if material is not None else None
        if texture is not None:
            found["texture"] = self._file(texture, trace)
        return found

    def _textures(self, robot: Robot) -> Json:
        """Return the textures of the materials that are written outside of visuals, by name."""
        found: Json = {}
        inside = {id(visual.material) for _, visual in robot.visuals()}
        for name, material in robot.materials.items():
            texture = material.inner("texture") if id(material) not in inside else None
            if texture is not None and (file := self._file(texture, texture.trace)):
                found[name] = file
        return found

    def _file(self, element: Element, trace: Frame | None) -> Json | None:
        """Return where the page gets a mesh or texture, or None if it cannot be read."""
        filename = attribute_text(element, "filename") or ""
        span = element.value_span("filename")
        try:
            path = self._finder.resolve(filename, span)
        except YamaroError:  # it lies where it may not be read
            return None
        if path is not None:
            file = self._files.add(path)
            if file is not None:
                self._warn_of_textures(element, path, file, trace)
            return file
        meant = self._finder.path_meant(filename, span)
        if meant is not None:
            self.awaited.append(meant)
        return None

    def _warn_of_textures(
        self, element: Element, path: str, file: Json, trace: Frame | None
    ) -> None:
        """Warn of a texture that is not an image, or of those that a mesh names."""
        filename = attribute_text(element, "filename")
        if element.name == "texture" and "fault" in file:
            self._warn(element, trace, f"the texture '{filename}' cannot be shown: {file['fault']}")
        for name in self._files.refused_by(path):
            texture = f"the texture '{name}', which has no format that is read"
            self._warn(element, trace, f"the mesh '{filename}' is shown without {texture}")

    def _warn(self, element: Element, trace: Frame | None, message: str) -> None:
        span = element.value_span("filename")
        warning = Diagnostic("bad-mesh", message, span, severity=WARNING, trace=trace)
        self._refused.setdefault(message, warning)

    def _diagnostic(self, diagnostic: Diagnostic, owners: Owners) -> Json:
        told = diagnostic_data(diagnostic)
        told["place"] = self.places.number(diagnostic.span)
        owner = owners.of(diagnostic)
        if owner is not None:
            told[owner[0]] = owner[1]
        return told


def finite_positions(positions: Mapping[str, float]) -> Json:
    """Return the positions that are numbers to JSON."""
    return {name: position for name, position in positions.items() if isfinite(position)}


def diagnostic_data(diagnostic: Diagnostic) -> Json:
    """Return a diagnostic as the page shows it: as the terminal would."""
    return {
        "severity": diagnostic.severity,
        "code": diagnostic.code,
        "message": diagnostic.message,
        "text": render(diagnostic),
    }


def fault_data(diagnostics: Sequence[Diagnostic], fault: str, places: Places) -> Json:
    """Return why there is no robot."""
    errors = [each for each in diagnostics if each.severity == ERROR]
    told: Iterable[Json] = (
        {**diagnostic_data(each), "place": places.number(each.span)} for each in errors
    )
    return {"fault": fault, "diagnostics": list(told), "places": places.texts}
