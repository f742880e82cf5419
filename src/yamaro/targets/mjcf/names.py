"""Names in MJCF: each is there once for every type of thing."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

WORLD = "world"
"""The body that is there in every model."""
BODY, JOINT, GEOM, SITE, CAMERA = "body", "joint", "geom", "site", "camera"
MESH, MATERIAL, TEXTURE = "mesh", "material", "texture"
ACTUATOR, SENSOR, EQUALITY = "actuator", "sensor", "equality"


class Names:
    """The names that are taken, by type."""

    __slots__ = ("_taken",)

    def __init__(self) -> None:
        self._taken: dict[str, set[str]] = {BODY: {WORLD}}

    def reserve(self, kind: str, names: Iterable[str]) -> None:
        """Take names, so that none that is made up is one of them."""
        self._taken.setdefault(kind, set()).update(names)

    def fresh(self, kind: str, wanted: str) -> str:
        """Take a name that is still free: the one that is wanted, or that with a number."""
        taken = self._taken.setdefault(kind, set())
        name, number = wanted, 1
        while name in taken:
            number += 1
            name = f"{wanted}_{number}"
        taken.add(name)
        return name


def stem_of(link: str) -> str:
    """Return the name of a link without the usual ending: 'base' for 'base_link'."""
    return link.removesuffix("_link") or link
