"""The robot that is made of the bodies of a model: links, joints, what they hold, notes, blocks."""

from __future__ import annotations

import os

from ...model import making
from ...model.joint import CONTINUOUS, FIXED, FLOATING, PRISMATIC, REVOLUTE, Dynamics, Limit
from ...model.making import Place
from ...model.pose import IDENTITY, UNTURNED, ZERO, Pose, rotate
from ...xml.tree import Element
from .blocks import block, in_radians, kept, quaternion, row, setting
from .compiler import chosen, fault, given_by, number, numbers, unit_axis, vector
from .inertia import Mass, mass_of, scaled
from .shapes import Geom
from .tree import Thing

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...model.link import Collision, Inertial, Visual
    from ...source import Span
    from ...xml.tree import Node
    from ..host import Host
    from .tree import Body, Context, Placed

WORLD = "world"
Z_AXIS = (0.0, 0.0, 1.0)
JOINT_TYPES = ("free", "ball", "slide", "hinge")
OF_DOCUMENT = ("compiler", "default", "worldbody", "asset")
"""The sections that are read here; others are kept as they are, or read by `words`."""
PLAIN = (0.5, 0.5, 0.5, 1.0)
"""The colour of a geom that says nothing of it."""
UNBOUNDED = 1e16
"""The effort and velocity of a joint that bounds neither: URDF wants a number, and takes it so."""


class Builder:
    """Makes the robot of a model.

    Attributes:
        host: what the reader may ask for.
        context: the main document.
        world: the world, with all bodies in it.
        geoms: the geoms of each body, by its name.
    """

    def __init__(self, host: Host, context: Context, world: Body) -> None:
        self.host = host
        self.context = context
        self.world = world
        self.span = context.document.root.span
        self.links: list[Element] = []
        self.joints: list[Element] = []
        self.materials: list[Element] = []
        self.rest: list[Node] = []
        self._names: dict[str, set[str]] = {"body": {WORLD}, "joint": set()}
        self._colors: dict[tuple[float, ...], str] = {}
        self.geoms: dict[str, list[Geom]] = {}
        self._chains: dict[str, list[str]] = {}

    def robot(self) -> Element:
        """Return the robot."""
        self._name_all()
        masses: dict[str, Mass] = {}
        for body in self.world.iter():
            if body is not self.world:
                found = mass_of(body, self.geoms[body.name])
                if found is not None:
                    masses[body.name] = found
        total = number(self.context.compiler.given, "settotalmass", -1.0)
        if total > 0:
            masses = scaled(masses, total)
        if self._has_world():
            self._add_link(self.world, None)
            self.rest.append(making.note("base", Place(self.span), {"type": "fixed"}))
        for body in self.world.iter():
            if body is not self.world:
                self._add_body(body, masses.get(body.name))
        self._add_sections()
        name = self.context.document.name or self._stem()
        children = [*self.materials, *self.links, *self.joints, *self.rest]
        return Element(
            "robot",
            self.span,
            {"name": name},
            children,
            value_spans={"name": self.context.document.root.value_span("model")},
        )

    def _stem(self) -> str:
        return os.path.basename(self.host.source.path or "robot").partition(".")[0] or "robot"

    # --- names ---

    def _name_all(self) -> None:
        """Give each body a name of its own, and each geom one in its body."""
        for body in self.world.iter():
            if body is not self.world:
                if body.thing.name and body.name in self._names["body"]:
                    raise fault(
                        f"there are two bodies named '{body.name}'",
                        body.thing.name_span,
                        "give each its own name; 'world' is the name of the world"
                        if body.name == WORLD
                        else "give each its own name",
                    )
                body.name = self.fresh("body", body.name)
            number, found = 0, []
            for thing in body.geoms:
                name = thing.name
                if not name:
                    number += 1
                    name = f"{body.name}_geom{number}"
                found.append(Geom(thing, name))
            self.geoms[body.name] = found

    def fresh(self, kind: str, wanted: str) -> str:
        """Take a name of a kind that is free: the one that is wanted, or that with a number."""
        taken = self._names[kind]
        name, count = wanted, 2
        while name in taken:
            name, count = f"{wanted}_{count}", count + 1
        taken.add(name)
        return name

    # --- the root ---

    def _has_world(self) -> bool:
        """Return whether the world is a link of its own."""
        tops = self.world.bodies
        if len(tops) != 1 or any(geom.shape() for geom in self.geoms[WORLD]):
            return True
        return any(self._type_of(joint) != "free" for joint in tops[0].joints)

    @staticmethod
    def _type_of(joint: Placed) -> str:
        if joint.kind == "freejoint":
            return "free"
        return chosen(joint.given, "type", JOINT_TYPES, "hinge")

    # --- bodies ---

    def _add_body(self, body: Body, mass: Mass | None) -> None:
        """Add the link of a body, and the joints that lead to it."""
        above = next(each for each in self._parents() if each[1] is body)[0]
        inner: list[Node] = []
        if above is self.world and not self._has_world():
            self._add_root(body, inner)
        else:
            self._add_joints(body, above.name, inner)
        inertial = self._inertial(body, mass) if mass is not None else None
        self._add_link(body, inertial, inner)

    def _parents(self) -> Iterable[tuple[Body, Body]]:
        for body in self.world.iter():
            for child in body.bodies:
                yield body, child

    def _add_root(self, body: Body, inner: list[Node]) -> None:
        """Note how the root is placed in the world."""
        free = bool(body.joints)
        place = Place(body.joints[0].span if free else body.thing.span)
        self.rest.append(making.note("base", place, {"type": "free" if free else "fixed"}))
        span = body.thing.span
        if any(body.pose.position):
            inner.append(setting("pos", row(body.pose.position), span))
        turn = quaternion(body.pose)
        if turn is not None:
            inner.append(setting("quat", turn, span))
        if free and (body.joints[0].name or body.joints[0].given):
            thing = body.joints[0]
            inner.append(kept(thing, without=("type",) if thing.kind == "joint" else ()))

    def _inertial(self, body: Body, mass: Mass) -> Inertial:
        thing = body.inertial or body.thing
        place = Place(thing.span)
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = mass.inertia
        return making.inertial(
            place,
            mass=mass.mass,
            inertia=(xx, xy, xz, yy, yz, zz),
            pose=self.origin(thing, mass.pose),
        )

    def origin(self, thing: Thing, pose: Pose) -> Pose:
        """Return a pose at the place where a thing has it."""
        if pose is IDENTITY or (pose.rotation == UNTURNED and pose.position == ZERO):
            return IDENTITY
        places: dict[str, Span] = {}
        for name, (_, span) in thing.given.items():
            if name in ("pos", "fromto"):
                places["xyz"] = span
            elif name in ("quat", "euler", "axisangle", "xyaxes", "zaxis"):
                places["rpy"] = span
        rpy = pose.rpy if pose.rotation != UNTURNED else ZERO
        made = making.pose(Place(thing.span, places), pose.position, rpy)
        return Pose(pose.rotation, pose.position, made.element)

    def _add_link(self, body: Body, inertial: Inertial | None, inner: Iterable[Node] = ()) -> None:
        thing = body.thing
        visuals: list[Visual] = []
        collisions: list[Collision] = []
        kept_here: list[Node] = [*inner]
        for geom in self.geoms[body.name]:
            self._add_geom(body, geom, visuals, collisions, kept_here)
        kept_here += [
            kept(each, pose=each.context.compiler.pose(each.given)) for each in body.others
        ]
        for name, (value, span) in thing.given.items():
            if name in ("gravcomp", "mocap", "user", "sleep", "fuse", "simple"):
                kept_here.append(setting(name, value, span))
        made = making.link(
            Place(thing.span, {"name": thing.name_span}),
            name=body.name,
            inertial=inertial,
            visuals=visuals,
            collisions=collisions,
        )
        element = made.element
        if kept_here:
            element.children.append(block(thing.span, kept_here))
        self.links.append(element)
        for site in body.sites:
            self._add_frame(body, site)

    def _add_geom(
        self,
        body: Body,
        geom: Geom,
        visuals: list[Visual],
        collisions: list[Collision],
        kept_here: list[Node],
    ) -> None:
        thing, given = geom.thing, geom.thing.given
        shape = geom.shape()
        place = Place(thing.span, {"name": thing.name_span})
        if shape is None:
            kept_here.append(kept(thing, pose=geom.pose))
            return
        size_place = Place(thing.span, dict.fromkeys(
            shape.attributes, thing.element.value_span("size")
        ))  # fmt: skip
        made = making.simple_shape(size_place, shape.kind, *shape.size)
        pose = self.origin(thing, geom.pose)
        is_solid = geom.is_solid()
        if geom.is_seen() or not is_solid:
            color = numbers(given, "rgba", 4)
            material = None
            if color is not None and tuple(color) != PLAIN:
                rgba = (color[0], color[1], color[2], color[3])
                name = self._colors.setdefault(rgba, "")
                if not name:
                    name = self._colors[rgba] = f"{body.name}_color"
                material = making.material(Place(given["rgba"][1]), name=name, color=rgba)
            visuals.append(
                making.visual(place, shape=made, pose=pose, material=material, name=geom.name)
            )
        if is_solid:
            collisions.append(making.collision(place, shape=made, pose=pose, name=geom.name))

    def _add_frame(self, body: Body, site: Placed) -> None:
        """Add a site: an empty link on a fixed joint."""
        pose = site.context.compiler.pose(site.given)
        pose = pose if site.pose is IDENTITY else site.pose @ pose
        name = self.fresh("body", site.name or f"{body.name}_site")
        place = Place(site.span, {"name": site.name_span})
        self.links.append(making.link(place, name=name).element)
        self._add_fixed(site, f"{name}_joint", body.name, name, pose)

    def _add_fixed(self, thing: Thing, name: str, parent: str, child: str, pose: Pose) -> None:
        self.joints.append(
            making.joint(
                Place(thing.span),
                name=self.fresh("joint", name),
                type=FIXED,
                parent=parent,
                child=child,
                origin=self.origin(thing, pose),
            ).element
        )

    # --- joints ---

    def _add_joints(self, body: Body, parent: str, inner: list[Node]) -> None:
        """Add the joints between a body and the one that it is in, with links in between."""
        origin, at = body.pose, ZERO
        moving = [each for each in body.joints if self._type_of(each) in ("slide", "hinge")]
        for joint in body.joints:
            kind = self._type_of(joint)
            if kind == "free":
                name = self.fresh("joint", joint.name or f"{body.name}_free")
                made = making.joint(
                    Place(joint.span, {"name": joint.name_span}),
                    name=name,
                    type=FLOATING,
                    parent=parent,
                    child=body.name,
                    origin=self.origin(body.thing, origin),
                )
                self.joints.append(made.element)
                return
            if kind == "ball":
                inner.append(kept(joint, changed=in_radians(joint, "range", "springref")))
                continue
            where = vector(joint.given, "pos")
            if kind == "slide":
                where = at
            dx, dy, dz = (p - q for p, q in zip(where, at, strict=True))
            if dx or dy or dz:
                origin = origin @ Pose(UNTURNED, (dx, dy, dz))
            at = where
            is_last = joint is moving[-1] and at == ZERO
            name = self.fresh("joint", joint.name or f"{body.name}_joint")
            child = body.name if is_last else self.fresh("body", f"{name}_link")
            self._add_joint(joint, kind, name, parent, child, origin)
            if not is_last:
                place = Place(joint.span, {"name": joint.name_span})
                self.links.append(making.link(place, name=child).element)
            parent, origin = child, IDENTITY
        if parent != body.name and not (moving and at == ZERO):
            x, y, z = at
            pose = origin @ Pose(UNTURNED, (-x, -y, -z)) if moving else origin
            self._add_fixed(body.thing, f"{body.name}_fixed", parent, body.name, pose)

    def _add_joint(
        self, thing: Placed, kind: str, name: str, parent: str, child: str, origin: Pose
    ) -> None:
        given = thing.given
        compiler = thing.context.compiler
        angle = compiler.angle if kind == "hinge" else float
        axis = unit_axis(given, Z_AXIS)
        if thing.pose is not IDENTITY:
            axis = rotate(thing.pose.rotation, axis)
        ends = numbers(given, "range", 2)
        limited = chosen(given, "limited", ("true", "false", "auto"), "auto")
        is_limited = limited == "true" or (
            limited == "auto" and compiler.autolimits and ends is not None and any(ends)
        )
        effort = numbers(given, "actuatorfrcrange", 2)
        limit = None
        values: dict[str, float] = {}
        places = {"lower": thing.element.value_span("range")}
        places["upper"] = places["lower"]
        if is_limited and ends is not None:
            values = {"lower": angle(ends[0]), "upper": angle(ends[1])}
        if effort is not None:
            values["effort"] = max(effort)
            places["effort"] = thing.element.value_span("actuatorfrcrange")
        if is_limited or effort is not None:
            values = {"effort": UNBOUNDED, "velocity": UNBOUNDED, **values}
            limit = making.part(Limit, Place(thing.span, places), **values)
        friction = {"damping": "damping", "friction": "frictionloss"}
        dynamic = {k: numbers(given, v, 1, 3) for k, v in friction.items()}
        found = {k: v[0] for k, v in dynamic.items() if v is not None and v[0]}
        dynamics = None
        if found:
            spots = {k: thing.element.value_span(v) for k, v in friction.items()}
            dynamics = making.part(Dynamics, Place(thing.span, spots), **found)
        type = PRISMATIC if kind == "slide" else REVOLUTE if is_limited else CONTINUOUS
        made = making.joint(
            Place(thing.span, {"name": thing.name_span}),
            name=name,
            type=type,
            parent=parent,
            child=child,
            origin=self.origin(thing, origin),
            axis=axis,
            limit=limit,
            dynamics=dynamics,
        )
        extras = [
            setting(key, value, span)
            for key, (value, span) in given.items()
            if key not in ("type", "pos", "axis", "range", "limited", "damping", "frictionloss",
                           "actuatorfrcrange")
        ]  # fmt: skip
        if extras:
            made.element.children.append(block(thing.span, extras))
        self.joints.append(made.element)

    # --- sections ---

    def _add_sections(self) -> None:
        """Add what the document has besides bodies, as blocks."""
        document = self.context.document
        for section in document.others(OF_DOCUMENT):
            given = given_by(section)
            given.pop("class", None)
            element = kept(Thing(section, self.context, given))
            element.children = [
                kept(Thing(each, self.context, self.context.given(each, section=section.name)))
                for each in section.elements()
            ]
            self.rest.append(block(section.span, [element]))
