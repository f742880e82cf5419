"""A built robot as data for the page: URDF, meshes, diagnostics, and the place of each."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from math import isfinite

from ...diagnostics import ERROR, WARNING, Diagnostic, Frame, YamaroError
from ...model.joint import Joint
from ...model.link import Collision, Link, Visual
from ...model.robot import Robot
from ...model.shapes import Mesh
from ...model.values import attribute_text
from ...rendering import render, trace_lines
from ...result import Build
from ...source import Span
from ...xml.tree import Element
from .mesh_files import MeshFiles

Json = dict[str, object]


# --- places -----------------------------------------------------------------------------------


MOST_CALLS = 12
"""Steps of calls and includes that are shown for one place, innermost first."""

_QUOTED_OWNER = re.compile(r"\b(link|joint) '([^']+)'")


class Places:
    """The places a page can ask to open, by number; what it shows of each is their text."""

    __slots__ = ("_numbers", "texts", "where")

    def __init__(self) -> None:
        self._numbers: dict[object, int] = {}
        self.texts: list[str] = []
        self.where: list[tuple[str, int, int]] = []

    def number(self, span: Span) -> int:
        """Return the number of a place."""
        key = (span.source.path, span.source.name, span.start)
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = len(self.texts)
            self.texts.append(span.place())
            self.where.append((span.source.path, *span.location()))
        return number

    def origin(self, span: Span, trace: Frame | None) -> Json:
        """Return where something is written, and the calls and includes that led there."""
        return {"place": self.number(span), "calls": self.calls(trace)}

    def calls(self, trace: Frame | None) -> list[Json]:
        """Return the steps that led to a place, innermost first."""
        steps: list[Json] = []
        frame = trace
        while frame is not None and len(steps) < MOST_CALLS:
            steps.append({"kind": frame.kind, "name": frame.name, "place": self.number(frame.span)})
            frame = frame.parent
        return steps


class Owners:
    """Finds the link or joint that a diagnostic is about."""

    __slots__ = ("_by_place", "_names")

    def __init__(self, robot: Robot) -> None:
        self._by_place: dict[object, list[tuple[list[str], str, str]]] = {}
        self._names: set[tuple[str, str]] = set()
        owners: list[Link | Joint] = [*robot.all_links, *robot.all_joints]
        for owner in owners:
            kind = owner.element.name
            self._names.add((kind, owner.name))
            for element in owner.element.iter():
                trace = element.trace_within(owner.trace)
                values = [element.value_span(attribute) for attribute in element.attributes]
                for span in (element.span, *(each for each in values if each is not element.span)):
                    found = self._by_place.setdefault(span.key(), [])
                    found.append((trace_lines(trace), kind, owner.name))

    def of(self, diagnostic: Diagnostic) -> tuple[str, str] | None:
        """Return "link" or "joint" and its name; None if it is about neither, or about many.

        A message that names one decides. Otherwise the place does, and where a function
        was called more than once, the calls.
        """
        named = _QUOTED_OWNER.search(diagnostic.message)
        if named and (named[1], named[2]) in self._names:
            return named[1], named[2]
        found = self._by_place.get(diagnostic.span.key(), [])
        if len(found) > 1:
            calls = trace_lines(diagnostic.trace)
            found = [each for each in found if each[0] == calls]
        owners = {(kind, name) for _, kind, name in found}
        return owners.pop() if len(owners) == 1 else None


# --- description ------------------------------------------------------------------------------


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
            "fits": [
                {
                    "link": fit.link,
                    "kind": fit.section,
                    "index": fit.index,
                    "count": fit.count,
                    "asked": fit.asked,
                    "quality": fit.quality(),
                }
                for fit in robot.fits
            ],
            "textures": self._textures(robot),
            "states": {
                state.name: finite_positions(state.positions) for state in robot.states.values()
            },
        }
        warnings = (*build.warnings, *self._refused.values())
        shown = []
        for diagnostic in warnings:
            told = diagnostic_data(diagnostic)
            told["place"] = self.places.number(diagnostic.span)
            owner = owners.of(diagnostic)
            if owner is not None:
                told[owner[0]] = owner[1]
            shown.append(told)
        self.data["diagnostics"] = shown
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
                if element.name == "texture" and "fault" in file:
                    about = f"the texture '{filename}' cannot be shown: {file['fault']}"
                    self._warn(element, trace, about)
                for name in self._files.refused_by(path):
                    texture = f"the texture '{name}', which has no format that is read"
                    about = f"the mesh '{filename}' is shown without {texture}"
                    self._warn(element, trace, about)
            return file
        meant = self._finder.path_meant(filename, span)
        if meant is not None:
            self.awaited.append(meant)
        return None

    def _warn(self, element: Element, trace: Frame | None, message: str) -> None:
        span = element.value_span("filename")
        warning = Diagnostic("bad-mesh", message, span, severity=WARNING, trace=trace)
        self._refused.setdefault(message, warning)


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
