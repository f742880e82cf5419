"""The head of a model: what its numbers mean, and its default classes."""

from __future__ import annotations

from .writing import Writing, made

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Element

FOLDER = "assets"
SITE_SIZE = "0.005"
STIFF = {"solref": "0.004 1", "solimp": "0.99 0.999 0.001"}
"""How fast and how exactly equalities hold: as stiff as the time step of MuJoCo allows."""
VISUAL_GROUP, COLLISION_GROUP, SITE_GROUP = "2", "3", "4"


def head(writing: Writing) -> list[Element]:
    """Return what comes before the sections: `compiler`, `option` and `default`."""
    folder = FOLDER if writing.files else None
    compiler = {
        "angle": "radian",
        "meshdir": folder,
        "texturedir": folder,
        "autolimits": "true",
    }
    return [
        _made(writing, "compiler", compiler),
        _made(writing, "option", {"integrator": "implicitfast"}),
        _defaults(writing),
    ]


def _defaults(writing: Writing) -> Element:
    """Return the default classes; a shape has no mass of its own, since its link says what it has.

    A mesh is taken for a shell, as it may be too flat to enclose a volume.
    """
    classes = writing.classes
    model = _made(writing, "default", {"class": classes.model})
    massless = {"density": "0"}
    no_contact = {"contype": "0", "conaffinity": "0", "group": VISUAL_GROUP}
    inner = {
        classes.visual: _made(writing, "geom", {**no_contact, **massless}),
        classes.collision: _made(writing, "geom", {"group": COLLISION_GROUP, **massless}),
        classes.frame: _made(writing, "site", {"group": SITE_GROUP, "size": SITE_SIZE}),
    }
    if any(each.name == "mesh" for each in writing.sections["asset"].elements()):
        model.children.append(_made(writing, "mesh", {"inertia": "shell"}))
    if writing.sections["equality"].children:
        model.children.append(_made(writing, "equality", {**STIFF}))
    for name, content in inner.items():
        default = _made(writing, "default", {"class": name})
        default.children.append(content)
        model.children.append(default)
    outermost = _made(writing, "default", {})
    outermost.children.append(model)
    return outermost


def _made(writing: Writing, name: str, attributes: dict[str, str | None]) -> Element:
    return made(name, writing.robot, attributes, None)
