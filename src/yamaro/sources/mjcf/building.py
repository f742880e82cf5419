"""The robot that is made of the bodies of a model: its links, with masses, shapes and frames."""

from __future__ import annotations

import os
from math import pi

from ...model import making
from ...model.joint import FIXED
from ...model.making import Place, element
from ...model.pose import IDENTITY, UNTURNED, ZERO, Pose
from ...model.values import shape_name
from ...xml.mjcf_references import measured_bodies
from ...xml.tree import Element
from .actuators import Drives
from .assets import Assets
from .blocks import block, kept, quaternion, row, setting
from .compiler import fault, number, numbers
from .inertia import Mass, mass_of, scaled
from .keyframes import SECTION as KEYFRAMES
from .meshes import UnknownMassError
from .sections import add_sections, read_mimics
from .shapes import OF_MESHES, Geom
from .tree import OF_BODY, Thing, joint_kinds, type_of
from .words import add_camera

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Sequence

    from ...model.link import Color
    from ...model.making import Value
    from ...model.pose import Vector
    from ...source import Span
    from ...xml.tree import Node
    from ...xml.values import Numbers
    from ..host import Host
    from .tree import Body, Context, Placed, Reader

WORLD = "world"
PLAIN = (0.5, 0.5, 0.5, 1.0)
"""The colour of a geom that says nothing of it."""
HELD_BY_GEOMS = frozenset(
    """type size mesh fitscale mass density shellinertia pos quat euler axisangle xyaxes zaxis
    fromto""".split()
)
"""What is in the shape of a geom, its pose, and the mass of its link."""
VISIBLE, SOLID = 2, 3
"""The groups that the writer of MJCF gives to visuals and collisions."""
SMOOTH, ROLLING = 0.005, 0.0001
"""MuJoCo's coefficients of friction against turning and rolling, in m."""
OF_CONTACTS = frozenset("friction condim margin gap solref solimp solmix priority".split())
"""What means nothing of a geom that touches none."""
MAKES_BODIES = frozenset(("composite", "flexcomp"))
"""What MuJoCo makes bodies of, which have numbers and no names."""
DETAILS_OF_MESHES = frozenset(("maxhullvert", "smoothnormal", "content_type"))
"""What a mesh says that its file does not hold."""


class Builder:
    """Makes the robot of a model.

    Attributes:
        host: what the reader may ask for.
        reader: what read the bodies, with all documents.
        context: the main document.
        contexts: all documents: the main one, and those that are attached.
        world: the world, with all bodies in it.
        assets: the meshes, materials and so on.
        geoms: the geoms of each body, by its name.
        links, joints: the elements of the robot.
        inner: what the block of each link holds, by the link's name.
        rest: notes and blocks of the robot as a whole.
        has_world: whether the world is a link.
        drives: the actuators.
        mimics: the joints that follow others, by name.
        equalities: what is kept of all equalities.
        limits: the positions that joints can have, by name.
        joint_names: of the elements of joints, by identity.
        sites: the link and the frame of each site, by name.
        has_capsule: whether a shape is one, which URDF has since 1.1.
        has_pairs: whether geoms touch that no other geom touches.
        has_turns: whether a sensor measures quaternions, whose sign then matters.
        above: the joint that leads to each body, by the body's name.
    """

    def __init__(self, host: Host, reader: Reader, context: Context, world: Body) -> None:
        self.host = host
        self.reader = reader
        self.context = context
        self.contexts = contexts = [context, *reader.attached]
        self.world = world
        self.span = self.context.document.root.span
        self.assets = Assets(contexts, host)
        self.links: list[Element] = []
        self.joints: list[Element] = []
        self.inner: dict[str, list[Node]] = {}
        self.rest: list[Node] = []
        self.geoms: dict[str, list[Geom]] = {}
        self._names: dict[str, set[str]] = {
            "body": {WORLD},
            "joint": set(),
            "sensor": set(),
            "loop": set(),
        }
        self._counts: dict[tuple[str, str], int] = {}
        self._colors: dict[Color, str] = {}
        self.has_capsule = False
        documents = [context.document for context in contexts]
        self.has_turns = any(
            each.name == "framequat" for one in documents for each in one.inside("sensor")
        )
        self.has_pairs = any(
            each.name == "pair" for one in documents for each in one.inside("contact")
        )
        self._initial_poses: dict[str, Pose] | None = None
        self._weighed_later: set[str] = set()  # links whose mass only MuJoCo knows
        self._name_all()
        self.has_world = self._needs_world()
        kinds, refs = joint_kinds(world)
        self.drives = Drives(contexts, kinds)
        if host.is_part and any(each.inside(KEYFRAMES) for each in documents):
            self.drives.name_all()  # by which the keyframes say their controls
        driven = {name for name in kinds if self.drives.noted(name) is not None}
        self.mimics, self.equalities = read_mimics(contexts, kinds, refs, driven)
        self.limits: dict[str, tuple[float, float]] = {}
        self.joint_names: dict[int, str] = {}
        self.sites: dict[str, tuple[str, str]] = {}
        self.above: dict[str, str] = {}

    def robot(self) -> Element:
        """Return the robot."""
        from .joints import add_joints

        masses = self._masses()
        if self.has_world:
            self._add_link(self.world, None)
            self.rest.append(making.note("base", Place(self.span), {"type": "fixed"}))
        pending = [(self.world, body) for body in reversed(self.world.bodies)]
        while pending:
            above, body = pending.pop()
            if above is self.world and not self.has_world:
                self._add_root(body)
            else:
                add_joints(self, body, above.name)
                usual = quaternion(body.pose) if self.has_turns else None
                turn = _as_written(body.thing, usual)
                if turn is not None and turn is not usual:
                    self.keep(body.name, setting("quat", turn, body.thing.where("quat")))
            mass = masses.get(body.name)
            if mass is not None and body.inertial is not None and mass.is_nothing():
                nothing = placed(body.inertial)
                nothing.attributes.setdefault("pos", "0 0 0")
                self.keep(body.name, nothing)
                mass = None
            self._add_link(body, self._inertial(body, mass) if mass is not None else None)
            pending += [(body, child) for child in reversed(body.bodies)]
        self.drives.notes(self)
        add_sections(self)
        for link in self.links:
            inner = self.inner.get(str(link.attributes["name"]))
            if inner:
                link.children.append(block(link.span, inner))
        name = self.context.document.name or self._stem()
        materials = self.assets.materials()
        return Element(
            "robot",
            self.span,
            {"name": name, "version": "1.1"} if self.has_capsule else {"name": name},
            [*materials, *self.links, *self.joints, *self.rest],
            value_spans={"name": self.context.document.root.value_span("model")},
        )

    def _stem(self) -> str:
        return os.path.basename(self.host.source.path or "robot").partition(".")[0] or "robot"

    def lose(self, what: str, span: Span, hint: str = "") -> None:
        """Report what a robot has no place for."""
        self.host.reporter.report("mjcf-lost", f"{what} is left out", span, hint=hint or None)

    def keep(self, link: str, element: Element) -> None:
        """Put an element into the block of a link."""
        self.inner.setdefault(link, []).append(self.assets.use(element))

    def _masses(self) -> dict[str, Mass]:
        """Return the mass of each body that has one, by its name."""
        masses: dict[str, Mass] = {}
        for body in self.world.iter():
            if body is self.world:
                continue
            try:
                found = mass_of(body, self.geoms[body.name])
            except UnknownMassError as error:
                self._weighed_later.add(body.name)
                self.host.reporter.report(
                    "unknown-mass",
                    f"the mass of '{body.name}' is not known, since {error.reason}",
                    error.span,
                    hint="give the body an <inertial>; only --to mjcf has the mass now",
                )
                continue
            if found is not None:
                masses[body.name] = found
        self._align_measured(masses)
        total = number(self.context.compiler.given, "settotalmass", -1.0)
        return scaled(masses, total) if total > 0 else masses

    def _align_measured(self, masses: dict[str, Mass]) -> None:
        """Turn masses to the axes that MuJoCo gives them, where sensors measure along these.

        Those of an inertia that is not diagonal are left to MuJoCo, which the writer lets find them
        again.
        """
        for context in self.contexts:
            for sensor in context.things("sensor"):
                for name in measured_bodies(sensor.kind, sensor.text):
                    mass = masses.get(name)
                    if mass is not None and not mass.is_along_principal_axes:
                        masses[name] = mass.in_order()

    # --- names ---

    def _name_all(self) -> None:
        """Give each body a name of its own, and each geom one in its body."""
        for body in self.world.iter():
            if body is not self.world and body.thing.name:
                if body.name in self._names["body"]:
                    raise fault(
                        f"there are two bodies named '{body.name}'",
                        body.thing.name_span,
                        "give each its own name; the world has the name 'world'",
                    )
                self._names["body"].add(body.name)
            for joint in body.joints:
                if joint.name:
                    self._names["joint"].add(joint.name)
        counts: dict[str, int] = {}
        named = {id(self.world): WORLD}  # the nearest body with a name of its own
        for body in self.world.iter():
            if body.thing.name:
                named[id(body)] = body.name
            stem = named[id(body)]
            named.update((id(child), stem) for child in body.bodies)
            if body is not self.world and not body.thing.name:
                counts[stem] = counts.get(stem, 0) + 1
                body.name = self.fresh("body", f"{stem}_{counts[stem]}")
            self.geoms[body.name] = [Geom(thing, self.assets) for thing in body.geoms]

    def fresh(self, kind: str, wanted: str) -> str:
        """Take a name of a kind that is free: the one that is wanted, or that with a number."""
        taken = self._names[kind]
        name, count = wanted, self._counts.get((kind, wanted), 2)
        while name in taken:
            name, count = f"{wanted}_{count}", count + 1
        if name != wanted:
            self._counts[kind, wanted] = count
        taken.add(name)
        return name

    def initial_poses(self) -> dict[str, Pose]:
        """Return T_world_body of bodies with all joints at their references, without mocap bodies.

        The world is one of them where it is a link.
        """
        if self._initial_poses is None:
            found = {WORLD: IDENTITY} if self.has_world else {}
            whole = {id(self.world): IDENTITY}
            for body in self.world.iter():
                for child in body.bodies:
                    whole[id(child)] = whole[id(body)] @ child.pose
                    if child.thing.text("mocap") != "true":
                        found[child.name] = whole[id(child)]
            self._initial_poses = found
        return self._initial_poses

    # --- the root ---

    def _needs_world(self) -> bool:
        """Return whether the world is a link: it has shapes, or joints that lead to what moves."""
        tops = self.world.bodies
        if len(tops) != 1 or any(map(is_shape, self.geoms[WORLD])):
            return True
        return any(type_of(joint) != "free" for joint in tops[0].joints)

    def _add_root(self, body: Body) -> None:
        """Note how the root is placed in the world."""
        free = body.joints[0] if body.joints else None
        place = Place((free or body.thing).span)
        self.rest.append(making.note("base", place, {"type": "free" if free else "fixed"}))
        span = body.thing.span
        if any(body.pose.position):
            self.keep(body.name, setting("pos", row(body.pose.position), span))
        turn = _as_written(body.thing, quaternion(body.pose))
        if turn is not None:
            self.keep(body.name, setting("quat", turn, span))
        if free is not None:
            self.keep_free(body, free)

    def keep_free(self, body: Body, joint: Placed) -> None:
        """Keep what a free joint has besides being one."""
        element = kept(joint, without=("type", "pos", "axis", "range", "ref", "springref"))
        element.name = "freejoint"
        if element.attributes:
            is_plain = element.attributes.keys() <= {"name", "align", "group"}
            if not is_plain:
                element.name = "joint"
                element.attributes["type"] = "free"
            self.keep(body.name, element)

    # --- links ---

    def _inertial(self, body: Body, mass: Mass) -> Element:
        thing = body.inertial or body.thing
        place = Place(thing.span)
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = mass.inertia
        moments = {"ixx": xx, "ixy": xy, "ixz": xz, "iyy": yy, "iyz": yz, "izz": zz}
        parts = [element("mass", place, {"value": mass.mass}), element("inertia", place, moments)]
        return element("inertial", place, {}, [*self.origin(thing, mass.pose), *parts])

    @staticmethod
    def origin(thing: Thing, pose: Pose) -> list[Element]:
        """Return an origin at the place where a thing has its pose; none where that is nothing."""
        if pose is IDENTITY or (pose.rotation == UNTURNED and pose.position == ZERO):
            return []
        places: dict[str, Span] = {}
        for name, (_, span) in thing.given.items():
            if name in ("pos", "fromto"):
                places["xyz"] = span
            elif name in ("quat", "euler", "axisangle", "xyaxes", "zaxis"):
                places["rpy"] = span
        rpy = _plain_angles(pose.rpy) if pose.rotation != UNTURNED else ZERO
        return [making.origin(Place(thing.span, places), pose.position, rpy)]

    def _add_link(self, body: Body, inertial: Element | None) -> None:
        """Add a link, with what is in the body."""
        thing = body.thing
        visuals: list[Element] = []
        collisions: list[Element] = []
        for name, (value, span) in thing.given.items():
            if name in OF_BODY:
                self.keep(body.name, setting(name, value, span))
        geoms = self.geoms[body.name]
        names = {geom.name for geom in geoms}
        details = [self._add_geom(body, geom, visuals, collisions, names) for geom in geoms]
        self._keep_geoms(body, visuals, collisions, details)
        for other in body.others:
            kept_other = placed(other)
            if other.kind == "camera":
                add_camera(self, body.name, other, kept_other)
            if body is self.world and self._comes_last(other):
                last = Element("worldbody", other.span, children=[self.assets.use(kept_other)])
                self.rest.append(block(other.span, [last]))
            else:
                self.keep(body.name, kept_other)
        is_empty = body is not self.world and not (inertial or visuals or collisions)
        is_empty = is_empty and body.inertial is None  # a mass of 0 is in the block
        if is_empty and not {"gravcomp", "mocap", "sleep"} & thing.given.keys():
            # A link with nothing in it is a frame; a body stays one.
            self.keep(body.name, setting("gravcomp", "0", thing.span))
        place = Place(thing.span, {"name": thing.name_span})
        inner = [*([] if inertial is None else [inertial]), *visuals, *collisions]
        self.links.append(making.link(place, body.name, inner))
        for site in body.sites:
            self._add_frame(body, site)

    def _comes_last(self, other: Thing) -> bool:
        """Return whether something makes bodies that are numbered after those of the world."""
        if other.kind not in MAKES_BODIES or not self.world.bodies:
            return False
        last = self.world.bodies[-1].thing.span
        return last.source is other.span.source and last.start < other.span.start

    def _keep_geoms(
        self,
        body: Body,
        visuals: Sequence[Element],
        collisions: Sequence[Element],
        details: Sequence[Element],
    ) -> None:
        """Keep what the model does not have of geoms, and their order where it is not the usual.

        A geom without a name has one only where something is kept of it.
        """
        geoms = self.geoms[body.name]
        names = [geom.name for geom in geoms if geom.name]
        shown, solid = map(_names, (visuals, collisions))
        usual = list(dict.fromkeys([*shown, *solid]))
        last = max((at for at, geom in enumerate(geoms) if geom.name in usual), default=-1)
        in_order = [name for name in names if name in usual] == usual
        in_order = in_order and all(geom.name in usual for geom in geoms[: last + 1])
        named = {geom.thing.name for geom in geoms}
        both = {*shown} & {*solid}
        for geom, detail in zip(geoms, details, strict=True):
            if detail.attributes.keys() - {"name"} or detail.children:
                self.keep(body.name, detail)
                named.add(geom.name)
            elif not in_order or geom.name in both:
                self.keep(body.name, Element("geom", geom.thing.span, {"name": geom.name}))
                named.add(geom.name)
        for each in (*visuals, *collisions):
            if each.attributes["name"] not in named:
                del each.attributes["name"]

    def _add_frame(self, body: Body, site: Placed) -> None:
        """Add a site: an empty link on a fixed joint."""
        pose = site.context.compiler.pose(site.given)
        half = None
        ends = numbers(site.given, "fromto", 6)
        if ends is not None:
            from .shapes import between

            pose, half = between(ends, site)
        pose = pose if site.pose is IDENTITY else site.pose @ pose
        wanted = site.name or f"{body.name}_site"
        name = self.fresh("body", wanted)
        place = Place(site.span, {"name": site.name_span})
        self.links.append(making.link(place, name))
        if site.name:
            self.sites[site.name] = body.name, name
        self.add_fixed(site, f"{name}_joint", body.name, name, pose)
        details: dict[str, object] = {}
        if half is not None:
            sizes = numbers(site.given, "size", 1, 3) or [0.005]
            is_round = site.text("type") in ("capsule", "cylinder")
            details["size"] = row([sizes[0], half] if is_round else [sizes[0], sizes[0], half])
        element = kept(site, pose=IDENTITY, changed=details, without=("fromto",))
        if name != wanted:
            self.keep(name, setting("name", site.name, site.span))
        if any(attribute != "name" for attribute in element.attributes):
            element.attributes["name"] = site.name or name
            self.keep(body.name, element)

    def add_fixed(
        self, thing: Thing, name: str, parent: str, child: str, pose: Pose, *, ball: str = ""
    ) -> None:
        """Add a fixed joint between two links; `ball` is the name of the ball that it is."""
        name = ball or self.fresh("joint", name)
        self.above[child] = name
        place = Place(thing.span)
        origin = self.origin(thing, pose)
        self.joints.append(making.joint(place, name, FIXED, parent, child, origin))

    # --- geoms ---

    def _add_geom(
        self,
        body: Body,
        geom: Geom,
        visuals: list[Element],
        collisions: list[Element],
        names: Container[str],
    ) -> Element:
        """Append a geom to visuals and collisions; return what the model does not have of it."""
        thing = geom.thing
        found = self._shape_of(geom)
        if found is None:
            changed: dict[str, object] = {}
            left = {"fromto", "mass", "density", "shellinertia"}
            if geom.type in OF_MESHES or geom.type in ("plane", "hfield"):
                pose = geom.pose
                self._weigh(body, geom, changed, left)
                return self.assets.use(kept(thing, pose=pose, changed=changed, without=left))
            self._weigh(body, geom, changed, left)
            sizes = row(geom.sizes)
            whole = {**changed, "type": geom.type, "size": sizes, "mesh": None, "fitscale": None}
            return kept(thing, pose=geom.pose, changed=whole, without=left)
        shape, pose = found
        place = Place(thing.span, {"name": thing.name_span})
        is_solid, is_seen = geom.is_solid(), geom.is_seen()
        has_look = is_seen or not is_solid
        if not geom.name:
            alike = collisions if is_solid else visuals
            kind = "visual" if not is_solid else "geom" if has_look else "collision"
            geom.name = shape_name(body.name, kind, len(alike), names)
        inner = [*self.origin(thing, pose), element("geometry", place, {}, [shape])]
        if has_look:
            look = self._look(body, geom)
            visuals.append(element("visual", place, {"name": geom.name}, [*inner, *look]))
        if is_solid:
            index = len(collisions)
            collisions.append(element("collision", place, {"name": geom.name}, inner))
            self._add_surface(body, geom, index)
        return self._details(body, geom, has_look=has_look, is_solid=is_solid)

    def _weigh(self, body: Body, geom: Geom, changed: dict[str, object], left: set[str]) -> None:
        """Keep the mass of a geom where only MuJoCo knows that of the body."""
        if body.name in self._weighed_later:
            left -= {"mass", "density", "shellinertia"}
            if not geom.thing.given.keys() & {"mass", "density"}:
                changed["density"] = "1000"

    def _shape_of(self, geom: Geom) -> tuple[Element, Pose] | None:
        """Return the shape of a geom as the model has it, and its pose in the body, or None."""
        thing = geom.thing
        mesh = geom.mesh
        if mesh is None:
            shape = geom.shape()
            if shape is None:
                return None
            kind, values = shape
            place = Place(thing.span, dict.fromkeys(values, thing.where("size")))
            self.has_capsule |= kind == "capsule"
            return element(kind, place, values), geom.pose
        turn = mesh.in_geom()
        details = DETAILS_OF_MESHES & mesh.thing.given.keys()
        if geom.type != "mesh" or turn is None or not mesh.path or details or thing.children:
            return None
        if mesh.path.lower().endswith(".msh"):
            return None
        span = mesh.thing.where("file")
        places = {"filename": span, "scale": mesh.thing.where("scale")}
        scale = mesh.scale if mesh.scale != (1.0, 1.0, 1.0) else None
        file: dict[str, Value] = {"filename": mesh.filename(), "scale": scale}
        made = element("mesh", Place(thing.span, places), file)
        self.assets.held.add(mesh.name)
        return made, geom.pose if turn is IDENTITY else geom.pose @ turn

    def _look(self, body: Body, geom: Geom) -> list[Element]:
        """Return the material of a visual: one of the model, or a colour of its own."""
        given = geom.thing.given
        color = numbers(given, "rgba", 4)
        if color is not None and tuple(color) != PLAIN:
            rgba = (color[0], color[1], color[2], color[3])
            if rgba not in self._colors:
                known = self.assets.others.get("material", {}).keys()
                taken = {*known, *self._colors.values()}
                name, count = f"{body.name}_color", 2
                while name in taken:
                    name, count = f"{body.name}_color_{count}", count + 1
                self._colors[rgba] = name
            span = given["rgba"][1]
            return [making.material(Place(span), self._colors[rgba], rgba)]
        named = given.get("material")
        if named is None and geom.mesh is not None:
            named = geom.mesh.thing.given.get("material")
        if named is None:
            return []
        self.assets.find("material", *named)
        return [making.material(Place(named[1], {"name": named[1]}), named[0])]

    def _add_surface(self, body: Body, geom: Geom, index: int) -> None:
        """Note the friction of a collision."""
        row = numbers(geom.thing.given, "friction", 1, 3)
        if row is not None:
            span = geom.thing.given["friction"][1]
            place = Place(span, {"friction": span})
            values: dict[str, str | float] = {"link": body.name, "index": str(index)}
            self.rest.append(making.note("surface", place, {**values, "friction": row[0]}))

    def _details(self, body: Body, geom: Geom, *, has_look: bool, is_solid: bool) -> Element:
        """Return what the model does not have of a geom that it has."""
        thing, given = geom.thing, geom.thing.given
        left = set(HELD_BY_GEOMS)
        if has_look:
            if "rgba" in given and "material" not in given:
                left.add("rgba")
            if "material" in given and "rgba" not in given:
                left.add("material")
        changed: dict[str, object] = {"name": geom.name}
        self._weigh(body, geom, changed, left)
        if not is_solid and not self.has_pairs:
            left |= OF_CONTACTS
        friction = numbers(given, "friction", 1, 3)
        if friction is not None and is_solid:
            usual = [friction[0], SMOOTH, ROLLING]
            if [*friction, *usual[len(friction) :]] == usual:
                left.add("friction")
        if has_look and is_solid:
            left.add("group")
            if geom.group:
                changed["group"] = str(geom.group)
            for name in ("contype", "conaffinity"):
                if int(number(given, name, 1.0)) == 1:
                    left.add(name)
        else:
            left.add("group")
            if geom.group != (SOLID if is_solid else VISIBLE):
                changed["group"] = str(geom.group)
            for name in ("contype", "conaffinity"):
                if int(number(given, name, 1.0)) == int(is_solid):
                    left.add(name)
        if given.keys() <= left and changed.keys() == {"name"} and not thing.element.children:
            return Element("geom", thing.span, changed)
        return self.assets.use(kept(thing, changed=changed, without=left))


def _as_written(thing: Thing, turn: Numbers | None) -> Numbers | None:
    """Return a quaternion with the sign that a thing gives it: of two that turn alike."""
    given = numbers(thing.given, "quat", 4)
    if turn is None or given is None:
        return turn
    product = sum(one * other for one, other in zip(given, turn.values, strict=True))
    return row(-each for each in turn.values) if product < 0 else turn


def _plain_angles(rpy: Vector) -> Vector:
    """Return roll, pitch and yaw as one turn about y where the other two are half turns."""
    roll, pitch, yaw = rpy
    if abs(abs(roll) - pi) > HALF_TURN or abs(abs(yaw) - pi) > HALF_TURN:
        return rpy
    return (0.0, (pi if pitch >= 0 else -pi) - pitch, 0.0)


HALF_TURN = 1e-14
"""In rad: how far an angle may be off a half turn that rounding has moved."""


def _names(shapes: Iterable[Element]) -> list[str]:
    return [str(each.attributes["name"]) for each in shapes]


def is_shape(geom: Geom) -> bool:
    """Return whether the model has the shape of a geom."""
    return geom.shape() is not None or geom.mesh is not None


def placed(thing: Placed) -> Element:
    """Return what is in a body besides joints, geoms and sites, for the block of its link."""
    if thing.kind == "plugin":
        return kept(thing)
    pose = thing.context.compiler.pose(thing.given)
    if thing.pose is not IDENTITY:
        pose = thing.pose @ pose
    if thing.kind == "light":
        from ...model.pose import rotate

        changed: dict[str, object] = {}
        direction = numbers(thing.given, "dir", 3)
        if thing.pose is not IDENTITY:
            x, y, z = direction or (0.0, 0.0, -1.0)
            changed["dir"] = row(rotate(thing.pose.rotation, (x, y, z)))
        return kept(thing, pose=Pose(UNTURNED, pose.position), changed=changed)
    return kept(thing, pose=pose)
