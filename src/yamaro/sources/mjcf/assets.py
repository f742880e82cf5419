"""Assets: the meshes, materials and textures of a model, by name."""

from __future__ import annotations

import os

from ...model import making
from ...model.making import Place
from .blocks import kept
from .classes import unknown
from .compiler import chosen, numbers
from .meshes import MeshAsset

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...model.link import Color
    from ...source import Span
    from ...xml.tree import Element
    from ..host import Host
    from .tree import Context, Thing

WHITE: Color = (1.0, 1.0, 1.0, 1.0)
SECTION = "asset"
_OF_MODEL = frozenset(("rgba", "texture"))
"""What the model has of a material."""
_IMAGES = (".png",)
"""The endings of images that other formats than MJCF have."""
NAMING = {
    "mesh": ("mesh",),
    "hfield": ("hfield",),
    "material": ("material",),
    "texture": ("texture",),
}
"""The attributes that name an asset, by its kind."""


class Assets:
    """The assets of a model.

    Attributes:
        meshes: by name.
        others: those of other kinds, by kind and name.
        held: the names of meshes that the model has.
    """

    __slots__ = ("_host", "_is_used", "held", "meshes", "others")

    def __init__(self, contexts: Iterable[Context], host: Host) -> None:
        """Gather the assets of all documents.

        Raises:
            YamaroError: a value is faulty.
        """
        self._host = host
        self.meshes: dict[str, MeshAsset] = {}
        self.others: dict[str, dict[str, Thing]] = {}
        self.held: set[str] = set()
        self._is_used: dict[tuple[str, str], None] = {}
        for context in contexts:
            for thing in context.things(SECTION):
                if thing.kind == "mesh":
                    mesh = MeshAsset(thing, host)
                    self.meshes[mesh.name] = mesh
                elif thing.kind != "model":
                    self.others.setdefault(thing.kind, {})[_name_of(thing)] = thing

    def mesh(self, name: str, span: Span) -> MeshAsset:
        """Return a mesh; raise YamaroError if there is none of the name."""
        found = self.meshes.get(name)
        if found is None:
            raise unknown("mesh", name, self.meshes, span)
        return found

    def find(self, kind: str, name: str, span: Span) -> Thing:
        """Return an asset; raise YamaroError if there is none of the name."""
        known = self.others.get(kind, {})
        if name not in known:
            raise unknown(kind, name, known, span)
        return known[name]

    # --- materials ---

    def materials(self) -> list[Element]:
        """Return the materials as the model has them."""
        found = []
        for name, thing in self.others.get("material", {}).items():
            given = thing.given
            row = numbers(given, "rgba", 4)
            color = WHITE if row is None else (row[0], row[1], row[2], row[3])
            texture = self._texture(thing)
            places: dict[str, Span] = {"name": thing.name_span}
            for attribute in ("rgba", "texture"):
                if attribute in given:
                    places[attribute] = given[attribute][1]
            image = None
            if texture is not None:
                file = texture.given["file"]
                path = texture.context.path(file[0], texture.context.compiler.texturedir)
                image = self._host.filename(path, file[1])
                places["filename"] = file[1]
            found.append(making.material(Place(thing.span, places), name, color, image))
        return found

    def _texture(self, material: Thing) -> Thing | None:
        """Return the texture of a material if other formats have such ones: an image of a file."""
        name = material.given.get("texture")
        if name is None:
            return None
        texture = self.find("texture", *name)
        kind = chosen(texture.given, "type", ("2d", "cube", "skybox"), "cube")
        file = texture.text("file") or ""
        is_image = file.lower().endswith(_IMAGES) and kind == "2d"
        return texture if is_image else None

    # --- blocks ---

    def use(self, element: Element) -> Element:
        """Note the assets that an element of a block names; return it."""
        for each in element.iter():
            for kind, names in NAMING.items():
                for name in names:
                    value = each.attributes.get(name)
                    if value is not None:
                        self._is_used[kind, str(value)] = None
        return element

    def left(self) -> list[Element]:
        """Return what the model does not have of the assets, and those that blocks name."""
        meshes = [
            self.use(kept(mesh.thing, changed={"name": name}))
            for name, mesh in self.meshes.items()
            if ("mesh", name) in self._is_used or name not in self.held
        ]
        materials: list[Element] = []
        known: set[str] = set()  # textures that the model has
        for thing in self.others.get("material", {}).values():
            details = thing.given.keys() - _OF_MODEL
            texture = self._texture(thing) if "texture" in thing.given else None
            if texture is not None:
                known.add(texture.name)
            elif "texture" in thing.given:
                details.add("texture")
            is_used = ("material", thing.name) in self._is_used
            if is_used or details or thing.children:
                without = () if is_used else _OF_MODEL - details
                materials.append(self.use(kept(thing, without=without)))
        others = [
            kept(thing, changed={"name": name or None})
            for kind, things in self.others.items()
            for name, thing in things.items()
            if kind != "material" and ((kind, name) in self._is_used or name not in known)
        ]
        return [*others, *meshes, *materials]


def _name_of(thing: Thing) -> str:
    """Return the name of an asset: by default that of its file."""
    file = thing.text("file")
    if thing.name or not file:
        return thing.name
    stem = os.path.splitext(os.path.basename(file.replace("\\", "/")))[0]
    return thing.context.named(stem, thing.kind)
