"""What the page has to know of a built robot, as data that goes into JSON."""

from __future__ import annotations

from ...diagnostics import ERROR, WARNING, Diagnostic, YamaroError, render
from ...xml.tree import Element
from ...xml.values import format_value
from .origins import Owners, Places

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ...result import Build
    from .mesh_files import MeshFiles
    from .origins import Json

MOST_DIAGNOSTICS = 500
"""Errors or warnings that the page lists; the terminal counts them all."""


class Description:
    """A robot as the page shows it.

    Attributes:
        data: the URDF; where its links and joints were written; their meshes.
        places: what the numbers in it stand for.
        awaited: the files it refers to that are not there, by the paths where they would be.
    """

    def __init__(self, build: Build, files: MeshFiles) -> None:
        """Describe a robot; `files` takes note of what it refers to."""
        self.places = Places()
        self.awaited: list[str] = []
        self._finder = build.finder
        self._files = files
        self._refused: dict[str, Diagnostic] = {}  # by message
        root = build.root
        owners = Owners(root)
        self.data: Json = {
            "urdf": build.xml(),
            "root": root.name,
            "links": self._owners(root, "link"),
            "joints": self._owners(root, "joint"),
            "textures": self._textures(root),
        }
        warnings = (*build.warnings, *self._refused.values())
        self.data["diagnostics"] = [self._diagnostic(each, owners) for each in warnings]
        self.data["places"] = self.places.texts

    def _owners(self, root: Element, kind: str) -> Json:
        """Return each link or joint by its name; of two with one name, the first."""
        found: Json = {}
        for element in root.elements():
            name = _attribute(element, "name")
            if element.name == kind and name not in found:
                found[name] = {**self.places.origin(element), **self._shapes(element)}
        return found

    def _shapes(self, link: Element) -> Json:
        return {
            kind: [self._shape(element) for element in link.elements() if element.name == kind]
            for kind in (("visual", "collision") if link.name == "link" else ())
        }

    def _shape(self, element: Element) -> Json:
        shape = self.places.origin(element)
        mesh = _below(element, "geometry", "mesh")
        if mesh is not None:
            shape["mesh"] = self._file(mesh)
        texture = _below(element, "material", "texture")
        if texture is not None:
            shape["texture"] = self._file(texture)
        return shape

    def _textures(self, root: Element) -> Json:
        """Return the textures of the materials that stand under the root, by their names."""
        found: Json = {}
        for material in root.elements():
            if material.name == "material":
                for texture in material.elements():
                    if texture.name == "texture" and (file := self._file(texture)):
                        found[_attribute(material, "name")] = file
        return found

    def _file(self, element: Element) -> Json | None:
        """Return where the page gets a mesh or texture, or None if it is not to be had."""
        filename = _attribute(element, "filename")
        span = element.value_span("filename")
        try:
            path = self._finder.resolve(filename, span)
        except YamaroError:  # it lies where it may not be read
            return None
        if path is not None:
            file = self._files.add(path)
            if file is not None:
                self._warn_of_textures(element, filename, path, file)
            return file
        meant = self._finder.path_meant(filename, span)
        if meant is not None:
            self.awaited.append(meant)
        return None

    def _warn_of_textures(self, element: Element, filename: str, path: str, file: Json) -> None:
        """Warn of a texture that is not an image, or of those that a mesh names."""
        if element.name == "texture" and "fault" in file:
            self._warn(element, f"the texture '{filename}' cannot be shown: {file['fault']}")
        for name in self._files.refused_by(path):
            texture = f"the texture '{name}', which has no format that is read"
            self._warn(element, f"the mesh '{filename}' is shown without {texture}")

    def _warn(self, element: Element, message: str) -> None:
        span = element.value_span("filename")
        warning = Diagnostic("bad-mesh", message, span, severity=WARNING, trace=element.trace)
        self._refused.setdefault(message, warning)

    def _diagnostic(self, diagnostic: Diagnostic, owners: Owners) -> Json:
        told = diagnostic_data(diagnostic)
        told["place"] = self.places.number(diagnostic.span)
        owner = owners.of(diagnostic)
        if owner is not None:
            told[owner[0]] = owner[1]
        return told


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


def _attribute(element: Element, name: str) -> str:
    return format_value(element.attributes.get(name))


def _below(element: Element, *names: str) -> Element | None:
    """Return the first element reached by child elements of these names."""
    for name in names:
        found = next((each for each in element.elements() if each.name == name), None)
        if found is None:
            return None
        element = found
    return element
