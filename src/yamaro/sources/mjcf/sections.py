"""The sections beside the bodies: equalities, keyframes, sensors, and those that are kept."""

from __future__ import annotations

from ...model import making
from ...model.making import Place
from ...xml.mjcf_references import references
from ...xml.tree import SAID, Element
from .blocks import block, kept
from .classes import unknown
from .compiler import chosen, fault, given_by, numbers, truth
from .keyframes import SECTION as KEYFRAMES
from .keyframes import keyframes
from .loops import KINDS, add_loop
from .tree import Thing
from .words import add_sensors

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from ...model.making import Value
    from .building import Builder
    from .tree import Context

READ = frozenset(("compiler", "default", "worldbody", "asset", "actuator", "equality", "body"))
"""The sections that are read, and bodies outside of the world, which MuJoCo passes over; others are
kept as they are."""
RESOLVED = frozenset(
    """angle eulerseq autolimits coordinate meshdir texturedir assetdir strippath inertiafromgeom
    inertiagrouprange balanceinertia boundmass boundinertia settotalmass fitaabb""".split()
)
"""What `<compiler>` says of the document itself, which holds for all that is made of it."""


def add_sections(builder: Builder) -> None:
    """Add what the documents have besides bodies: notes, and blocks for MJCF."""
    sections: dict[str, Element] = {}
    sensors: dict[int, tuple[Thing, Element]] = {}
    alone: set[tuple[str, str]] = set()

    def keep(name: str, element: Element) -> None:
        if name not in sections:
            sections[name] = Element(name, element.span)
        sections[name].children.append(builder.assets.use(element))

    _keep_compiler(builder)
    if not builder.has_world:
        _keep_world(builder)
    for number, context in enumerate(builder.contexts):
        for section in context.document.others(READ):
            if section.name == KEYFRAMES or (number and section.name in OF_MAIN):
                continue
            given = given_by(section)
            given.pop("class", None)
            whole = kept(Thing(section, context, given))
            whole.children = []
            known = sections.setdefault(section.name, whole)
            if known is not whole:
                known.attributes.update(whole.attributes)
            for each in section.elements():
                if not context.has(each, section.name):
                    continue
                thing = Thing(each, context, context.given(each, section=section.name))
                if context.suffix and not any(map(any, map(references, each.iter()))):
                    # A `<replicate>` copies what names something in it.
                    thing.name = thing.name.removesuffix(context.suffix)
                    if (section.name, thing.name) in alone:
                        continue
                    alone.add((section.name, thing.name))
                element = kept(thing)
                if section.name == "sensor":
                    sensors[id(element)] = thing, element
                keep(section.name, element)
    _add_settings(builder, sections)
    for element in keyframes(builder):
        keep(KEYFRAMES, element)
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


OF_MAIN = frozenset(("option", "size", "visual", "statistic"))
"""The sections of attached documents that the main one decides."""
MERGED = {"option": min, "size": max}
"""Those that `conflict="merge"` takes, and which of two time steps or sizes it takes."""


def _add_settings(builder: Builder, sections: dict[str, Element]) -> None:
    """Add what attached documents say of the simulation, as far as the main one takes it.

    Raises:
        YamaroError: documents differ, and the main one says that this is an error.
    """
    given = builder.context.compiler.given
    policy = chosen(given, "conflict", ("warning", "merge", "error"), "warning")
    seen: set[int] = set()
    for context in builder.contexts[1:]:
        if id(context.document) in seen or context.document is builder.context.document:
            continue
        seen.add(id(context.document))
        lost: dict[str, list[str]] = {}
        for section in context.document.others(READ):
            if section.name not in OF_MAIN:
                continue
            own = sections.get(section.name)
            if policy == "merge" and section.name in MERGED:
                if own is None:
                    own = sections[section.name] = Element(section.name, section.span)
                _merge(own, section)
                continue
            for each in (section, *section.elements()):
                tag = section.name if each is section else f"{section.name}/{each.name}"
                mine = own if each is section else _inside(own, each.name)
                said = mine.attributes if mine is not None else {}
                for name, value in each.attributes.items():
                    if name in said and str(said[name]) == value:
                        continue
                    if name in said and policy == "error" and section.name in MERGED:
                        raise _conflict(each, name)
                    lost.setdefault(f"<{tag}>", []).append(name)
        if lost:
            what = "; ".join(f"{', '.join(names)} of {tag}" for tag, names in lost.items())
            builder.lose(
                f"what an attached document says of the simulation ({what})",
                context.document.root.span,
                "MuJoCo takes these of the main document; write them there",
            )


def _inside(section: Element | None, name: str) -> Element | None:
    """Return the element of a name in a section, or None."""
    if section is None:
        return None
    return next((each for each in section.elements() if each.name == name), None)


def _conflict(element: Element, name: str) -> Exception:
    return fault(
        f"'{name}' of <{element.name}> is not what the document has that attaches this one",
        element.value_span(name),
        'write the same in both, or <compiler conflict="warning"/>',
    )


def _merge(own: Element, given: Element) -> None:
    """Take what a document has of a section besides what the main one says."""
    for name, value in given.attributes.items():
        if name not in own.attributes:
            own.attributes[name] = value
        elif str(own.attributes[name]) != value:
            is_count = name.endswith("iterations") or name == "sdf_initpoints"
            is_step = name.endswith("tolerance") or name == "timestep"
            if given.name == "option" and not (is_count or is_step):
                raise _conflict(given, name)
            taken = max if is_count else MERGED[given.name]  # the finer of two
            own.attributes[name] = taken(str(own.attributes[name]), str(value), key=_size)
    for each in given.elements():
        mine = _inside(own, each.name)
        if mine is None:
            mine = Element(each.name, each.span)
            own.children.append(mine)
        mine.attributes = {**each.attributes, **mine.attributes}


def _size(written: str) -> float:
    """Return a number, or a number of bytes such as 10M."""
    unit = "KMGTPE".find(written[-1:].upper()) + 1 if written[-1:] else 0
    try:
        return float(written[:-1]) * 1024**unit if unit else float(written)
    except ValueError:
        return 0.0


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
) -> tuple[dict[str, Element], list[tuple[Thing, Element]]]:
    """Return the joints that follow others by name, and what is kept of all equalities.

    An equality of two joints is q₁ − r₁ = a + b·(q₂ − r₂) with the references r.

    Args:
        contexts: the documents.
        joints: the type of each joint, by name.
        refs: the reference of each joint in radians or metres, by name.
        driven: the joints with an actuator of the model, which cannot follow others.
    """
    mimics: dict[str, Element] = {}
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
                if any(row[2:]) or not row[1] or not is_single:
                    continue
                if not _can_follow(name, other, mimics, driven):  # solved for the other joint
                    name, other, leader = other, name, follower
                    row = [-row[0] / row[1], 1 / row[1]]
                    if not _can_follow(name, other, mimics, driven):
                        continue
                offset = row[0] + refs.get(name, 0.0) - row[1] * refs.get(other, 0.0)
                span = thing.where("polycoef")
                places = {"joint": leader[1], "multiplier": span, "offset": span}
                if thing.given.keys() <= {"joint1", "joint2", "polycoef"}:
                    element.body = SAID
                values: dict[str, Value] = {
                    "joint": other,
                    "multiplier": row[1] if row[1] != 1 else None,
                    "offset": offset or None,
                }
                mimics[name] = making.element("mimic", Place(thing.span, places), values)
    return mimics, elements


def _can_follow(
    name: str, leader: str, mimics: Mapping[str, Element], driven: Collection[str]
) -> bool:
    """Return whether a joint may follow another: nothing drives it, and it leads to no circle."""
    return name not in mimics and name not in driven and not _leads_to(mimics, leader, name)


def _leads_to(mimics: Mapping[str, Element], name: str, end: str) -> bool:
    """Return whether a joint follows another one, over any number of others."""
    while name != end:
        if name not in mimics:
            return False
        name = str(mimics[name].attributes["joint"])
    return True
