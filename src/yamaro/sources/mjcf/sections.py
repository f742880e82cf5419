"""The sections beside the bodies: equalities, keyframes, sensors, and those that are kept."""

from __future__ import annotations

from ...model import making
from ...model.joint import Mimic
from ...model.making import Place
from ...xml.tree import SAID, Element
from .blocks import block, kept
from .classes import unknown
from .compiler import given_by, numbers, truth
from .loops import KINDS, add_loop
from .tree import Thing
from .words import add_sensors, add_state

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from .building import Builder
    from .tree import Context

READ = frozenset(("compiler", "default", "worldbody", "asset", "actuator", "equality"))
"""The sections that are read; others are kept as they are."""
RESOLVED = frozenset(
    """angle eulerseq autolimits coordinate meshdir texturedir assetdir strippath inertiafromgeom
    inertiagrouprange balanceinertia boundmass boundinertia settotalmass fitaabb""".split()
)
"""What `<compiler>` says of the document itself, which holds for all that is made of it."""


def add_sections(builder: Builder) -> None:
    """Add what the documents have besides bodies: notes, and blocks for MJCF."""
    sections: dict[str, Element] = {}
    sensors: dict[int, tuple[Thing, Element]] = {}

    def keep(name: str, element: Element) -> None:
        if name not in sections:
            sections[name] = Element(name, element.span)
        sections[name].children.append(builder.assets.use(element))

    _keep_compiler(builder)
    if not builder.has_world:
        _keep_world(builder)
    for number, context in enumerate(builder.contexts):
        for section in context.document.others(READ):
            given = given_by(section)
            given.pop("class", None)
            if number and section.name in _OF_MAIN:
                continue
            whole = kept(Thing(section, context, given))
            whole.children = []
            known = sections.setdefault(section.name, whole)
            if known is not whole:
                known.attributes.update(whole.attributes)
            for each in section.elements():
                if not context.has(each, section.name):
                    continue
                if number and section.name == "keyframe":
                    continue
                thing = Thing(each, context, context.given(each, section=section.name))
                element = kept(thing)
                if section.name == "sensor":
                    sensors[id(element)] = thing, element
                elif section.name == "keyframe":
                    add_state(builder, thing, element)
                keep(section.name, element)
    add_sensors(builder, sensors)
    for thing, element in builder.equalities:
        if thing.kind in KINDS:
            add_loop(builder, thing, element)
        keep("equality", element)
    for element in builder.drives.order():
        keep("actuator", element)
    sections.setdefault("contact", Element("contact", builder.span))
    assets = builder.assets.left()
    if assets:
        sections = {"asset": Element("asset", assets[0].span, children=[*assets]), **sections}
    for element in sections.values():
        builder.rest.append(block(element.span, [element]))


_OF_MAIN = frozenset(("option", "size", "visual", "statistic"))
"""The sections of attached documents that the main one decides."""


def _keep_compiler(builder: Builder) -> None:
    """Keep what `<compiler>` asks of MuJoCo beside how the document is read."""
    for section in builder.context.document.sections("compiler"):
        given = {k: v for k, v in given_by(section).items() if k not in RESOLVED}
        if given or section.elements():
            builder.rest.append(block(section.span, [kept(Thing(section, builder.context, given))]))


def _keep_world(builder: Builder) -> None:
    """Keep what is in a world that is not a link: floors, lights, cameras, sites."""
    from ...model.pose import IDENTITY
    from .building import WORLD, placed

    world = builder.world
    found = [
        kept(geom.thing, pose=geom.pose, changed={"name": geom.thing.name or None})
        for geom in builder.geoms[WORLD]
    ]
    for site in world.sites:
        pose = site.context.compiler.pose(site.given)
        pose = pose if site.pose is IDENTITY else site.pose @ pose
        found.append(kept(site, pose=pose))
    found += [placed(other) for other in world.others]
    if found:
        for element in found:
            builder.assets.use(element)
        element = Element("worldbody", found[0].span, children=[*found])
        builder.rest.append(block(element.span, [element]))


# --- equalities -------------------------------------------------------------------------------


def read_mimics(
    contexts: Sequence[Context],
    joints: Mapping[str, str],
    refs: Mapping[str, float],
    driven: set[str],
) -> tuple[dict[str, Mimic], list[tuple[Thing, Element]]]:
    """Return the joints that follow others by name, and what is kept of all equalities.

    An equality of two joints is q₁ − r₁ = a + b·(q₂ − r₂) with the references r.

    Args:
        contexts: the documents.
        joints: the type of each joint, by name.
        refs: the reference of each joint in radians or metres, by name.
        driven: the joints with an actuator of the model, which cannot follow others.
    """
    mimics: dict[str, Mimic] = {}
    elements: list[tuple[Thing, Element]] = []
    for context in contexts:
        for thing in context.things("equality"):
            element = kept(thing)
            elements.append((thing, element))
            if thing.kind == "joint":
                follower, leader = thing.given.get("joint1"), thing.given.get("joint2")
                for named in (follower, leader):
                    if named is not None and named[0] not in joints:
                        raise unknown("joint", named[0], joints, named[1])
                if follower is None or leader is None or not truth(thing.given, "active", True):
                    continue
                name, other = follower[0], leader[0]
                row = [0.0, 1.0, 0.0, 0.0, 0.0]
                given = numbers(thing.given, "polycoef", 1, 5) or []
                row[: len(given)] = given
                is_single = {joints[name], joints[other]} <= {"hinge", "slide"}
                if any(row[2:]) or not row[1] or name in mimics or name in driven or not is_single:
                    continue
                if _leads_to(mimics, other, name):
                    continue
                offset = row[0] + refs.get(name, 0.0) - row[1] * refs.get(other, 0.0)
                span = thing.where("polycoef")
                places = {"joint": leader[1], "multiplier": span, "offset": span}
                if thing.given.keys() <= {"joint1", "joint2", "polycoef"}:
                    element.body = SAID
                mimics[name] = making.part(
                    Mimic,
                    Place(thing.span, places),
                    joint=other,
                    multiplier=row[1] if row[1] != 1 else None,
                    offset=offset or None,
                )
    return mimics, elements


def _leads_to(mimics: Mapping[str, Mimic], name: str, end: str) -> bool:
    """Return whether a joint follows another one, over any number of others."""
    while name != end:
        if name not in mimics:
            return False
        name = mimics[name].joint
    return True
