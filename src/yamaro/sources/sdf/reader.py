"""SDFormat → `<robot>`: the model of a document, with what it includes, as links and joints."""

from __future__ import annotations

import re

from ...model import making
from ...model.extras import CAMERAS
from ...model.joint import FIXED, FLOATING
from ...model.kinematics import WORLD
from ...model.pose import IDENTITY, Pose
from ...model.reading import read_robot
from ...model.recognition import OPTICAL
from ...model.values import attribute_text, child_named, content
from ...xml.tree import Element, RobotNote, Text
from ...xml.values import format_value
from .document import Document
from .inertia import mass_of
from .joints import JointReader
from .kept import block_of, check_words, kept_of, leaf, placed, pose_element
from .scopes import FRAME, JOINT, LINK, Anchor, Frames
from .sensors import Sensors
from .shapes import Shapes, origin
from .tree import Edge, Tree
from .values import Reading, compose, text_span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Node
    from ..host import Host
    from .document import Choice
    from .kept import Held
    from .scopes import Scope

NAMING = re.compile("link|joint|frame|body|parent|child|relative_to|attached", re.IGNORECASE)
"""Elements and attributes that name links, joints and frames."""
OF_ONE_MODEL = frozenset(("static", "self_collide", "allow_auto_disable", "enable_wind"))
OF_JOINT: Held = {"@name": True, "@type": True, "parent": True, "child": True, "pose": True}
OF_LINK = frozenset(("inertial", "visual", "collision", "sensor", "pose"))
OF_MODEL = frozenset(("link", "joint", "frame", "model", "include", "pose"))
LOOPS = {"fixed": "fixed", "ball": "ball", "revolute": "revolute", "continuous": "revolute"}
"""The joints that can close a loop, and what the model calls them."""


def read(root: Element, host: Host) -> Element:
    """Return the `<robot>` of an `<sdf>`, with notes and blocks for SDF among its children.

    Raises:
        YamaroError: the document has errors.
    """
    reading = Reading(host)
    choice = Document(reading).choice(root)
    reading.settle()
    robot = _Robot(reading, choice).robot()
    reading.settle()
    return robot


class _Robot:
    """Makes the robot of one model."""

    def __init__(self, reading: Reading, choice: Choice) -> None:
        self._reading = reading
        self._choice = choice
        self._scope = choice.scope
        self._frames = Frames(reading)
        self._scopes = choice.scope.all_scopes()
        self._names: dict[object, str] = {}
        self._taken: set[str] = set()
        self._colors: dict[object, str] = {}
        self._links: list[Anchor] = []
        self._joints: list[Anchor] = []
        self._explicit: list[Anchor] = []
        self._name_all()
        self._joint_reader = JointReader(reading, self._frames, self._names)
        self._world = self._world_pose()
        self._is_static = self._static()

    # --- names ---

    def _name_all(self) -> None:
        """Name links, frames and joints; those of nested models begin with the model's name."""
        anchors = [each for scope in self._scopes for each in scope.anchors]
        anchors += self._choice.joints
        self._taken |= {each.name for each in self._scope.anchors}
        for anchor in anchors:
            {LINK: self._links, JOINT: self._joints, FRAME: self._explicit}[anchor.kind].append(
                anchor
            )
            if anchor.scope is self._scope and "::" not in anchor.name:
                self._names[anchor] = anchor.name
        renamed: dict[tuple[str, ...], list[Anchor]] = {}
        for anchor in anchors:
            if anchor not in self._names:
                path = anchor.scope.path()
                wanted = "_".join([*path, anchor.name]).replace("::", "_")
                self._names[anchor] = self._new(wanted)
                if self._names[anchor] != anchor.name:
                    renamed.setdefault(tuple(path), []).append(anchor)
        for names, group in renamed.items():
            first = group[0]
            home = first.scope.include or first.scope.element
            full = "::".join([*names, first.name])
            more = f" and {len(group) - 1} more" if len(group) > 1 else ""
            self._reading.warn(
                "sdf-renamed",
                f"'{full}'{more} of a nested model: '{self._names[first]}' in the robot",
                home.span,
                hint="URDF has one space of names for all links and joints",
            )

    def _new(self, wanted: str) -> str:
        """Return a name that nothing has yet, and take it."""
        found, count = wanted, 2
        while found in self._taken:
            found, count = f"{wanted}_{count}", count + 1
        self._taken.add(found)
        return found

    # --- the model as a whole ---

    def _world_pose(self) -> Pose:
        """Return T_world_model."""
        scope, reading = self._scope, self._reading
        element = scope.pose_element()
        pose = reading.pose(element)
        if element is not None:
            named = next(
                (name for key in ("relative_to", "frame")
                 if (name := attribute_text(element, key)) and name != WORLD), None
            )  # fmt: skip
            if named:
                found = self._pose_in_world(named)
                if found is None:
                    reading.fail(
                        "sdf-frame",
                        f"there is no frame '{named}' in the world",
                        element.value_span("relative_to"),
                    )
                else:
                    pose = compose(found, pose)
        name, span = scope.placed_by()
        if name:
            anchor = self._frames.find(name, scope, span)
            if anchor is not None:
                pose = compose(pose, self._frames.pose(anchor).inverse())
        return pose

    def _pose_in_world(self, named: str) -> Pose | None:
        """Return T_world_x of a frame or model beside the model, by its own pose."""
        world, pose = self._choice.world, IDENTITY
        for _ in range(20):
            found = next(
                (each for each in (world.elements() if world is not None else ())
                 if each.name in ("frame", "model") and attribute_text(each, "name") == named),
                None,
            )  # fmt: skip
            if found is None:
                return None
            own = child_named(found, "pose")
            pose = compose(self._reading.pose(own), pose)
            above = attribute_text(own, "relative_to") or attribute_text(found, "attached_to")
            if not above or above == WORLD:
                return pose
            named = above
        return None

    def _static(self) -> bool:
        include = self._scope.include
        if include is not None and child_named(include, "static") is not None:
            return self._reading.truth(include, "static")
        return self._reading.truth(self._scope.element, "static")

    def _stands(self, link: Anchor) -> bool:
        """Return whether a link is in a nested model that is static."""
        scope: Scope | None = link.scope
        while scope is not None and scope is not self._scope:
            for says in (scope.include, scope.element):
                if says is not None and child_named(says, "static") is not None:
                    return self._reading.truth(says, "static")
            scope = scope.outer
        return False

    # --- joints ---

    def _edges(self) -> list[Edge]:
        """Return the joints with the links that they join; those that are not whole are errors."""
        edges = []
        for joint in self._joints:
            ends: list[Anchor | None] = []
            for name in ("parent", "child"):
                found = self._end(joint, name)
                if found is False:
                    break
                assert not isinstance(found, bool)
                ends.append(found)
            if len(ends) < 2:
                continue
            parent, child = ends
            if child is None:  # held in the world, whichever way it is written
                parent, child = None, parent
            if child is None:
                continue
            if parent is child:
                self._reading.fail(
                    "bad-sdf",
                    f"the joint '{joint.name}' joins the link '{child.name}' to itself",
                    joint.element.value_span("name"),
                )
                continue
            edges.append(Edge(joint, self._names[joint], parent, child))
        return edges

    def _end(self, joint: Anchor, name: str) -> Anchor | bool | None:
        """Return the link at an end of a joint; None for the world, False with an error."""
        reading, element = self._reading, child_named(joint.element, name)
        if element is not None and child_named(element, "link_name") is not None:
            element = child_named(element, "link_name")
        named = (content(element) or "").strip()
        if element is None or not named:
            reading.fail(
                "bad-sdf",
                f"the joint '{joint.name}' has no <{name}>",
                joint.element.value_span("name"),
                hint=f"write <{name}>LINK</{name}>",
            )
            return False
        if named == WORLD:
            return None
        found = self._frames.find(named, joint.scope, text_span(element))
        if found is None:
            return False
        body = self._frames.body(found)
        if body is None:
            if not reading.errors:
                reading.fail(
                    "sdf-frame", f"'{named}' is not attached to a link", text_span(element)
                )
            return False
        return body

    # --- the robot ---

    def robot(self) -> Element:
        """Return the robot."""
        reading, scope = self._reading, self._scope
        reading.settle()
        edges = self._edges()
        for anchor in (*self._links, *self._explicit, *self._joints):
            self._frames.pose(anchor)
        reading.settle()
        tree = Tree(self._links, edges, self._frames.canonical(scope))
        roots = tree.roots
        start = compose(self._world, self._frames.pose(roots[0])) if roots else IDENTITY
        in_world = any(each.top is None for each in tree.edges.values())
        has_world = in_world or len(roots) > 1 or (self._is_static and start != IDENTITY)
        has_world = has_world or (not self._is_static and any(map(self._stands, roots)))
        place = reading.place(scope.element.span, {"name": scope.element.value_span("name")})
        parts = _Parts()
        if has_world:
            parts.links.append(making.element("link", place, {"name": WORLD}))
        by_joint = {edge.joint: edge for edge in tree.edges.values()}
        for joint in self._joints:
            if joint in by_joint:
                self._join(by_joint[joint], parts)
        for link in self._links:
            if link in parts.above:
                parts.links.append(parts.above[link])
            if has_world and link in roots:
                self._hold(link, parts)
            self._read_link(link, parts)
        for frame in self._explicit:
            body = self._frames.body(frame)
            if body is None:
                reading.warn(
                    "sdf-lost", f"the frame '{frame.name}' is in no link", frame.element.span
                )
            else:
                pose = self._frames.between(body, frame)
                self._add_frame(self._names[frame], self._names[body], pose, frame.element, parts)
        for edge in tree.loops:
            self._close(edge, parts)
        self._keep_of_models(parts)
        if not has_world:
            kind = "fixed" if self._is_static else "free"
            parts.notes.append(
                making.note("base", reading.place(scope.element.span), {"type": kind})
            )
            if start != IDENTITY:
                parts.kept.insert(0, pose_element(start, scope.pose_element() or scope.element))
        name = self._choice.name or "robot"
        self._read_sensors(making.element("robot", place, {"name": name}, parts.elements()), parts)
        elements = parts.elements()
        made = making.element("robot", place, {"name": name}, elements)
        for element in elements:
            kept = parts.kept_in.get((element.name, str(element.attributes["name"])), [])
            element.children += block_of(reading, element.span, kept)
        made.children += [*parts.notes, *self._joint_reader.notes]
        made.children += block_of(reading, scope.element.span, parts.kept)
        return made

    # --- joints and links ---

    def _join(self, edge: Edge, parts: _Parts) -> None:
        """Add a joint, with a link without mass where its child is not at the joint."""
        reader, name = self._joint_reader, edge.name
        kind = reader.kind_of(edge)
        put = reader.place(edge, kind, self._world)
        top = WORLD if edge.top is None else self._names[edge.top]
        bottom = self._names[edge.bottom]
        if put.rest is not IDENTITY:
            between, bottom = bottom, self._new(f"{name}_frame")
        made, kept = reader.made(edge, kind, put, top=top, bottom=bottom)
        parts.joints.append(made)
        if put.rest is not IDENTITY:
            place = self._reading.place(edge.joint.element.span)
            parts.above[edge.bottom] = making.element("link", place, {"name": bottom})
            fixed = self._new(f"{name}_offset")
            parts.joints.append(self._fixed(fixed, bottom, between, put.rest, edge.joint.element))
        home = (
            IDENTITY if put.rest is not IDENTITY else self._frames.between(edge.bottom, edge.joint)
        )
        for each in edge.joint.element.elements():
            if each.name == "sensor":
                pose = self._frames.pose_in(edge.joint, child_named(each, "pose"), edge.joint.scope)
                parts.sensors.append((each, compose(home, pose), JOINT, name))
        if kept:
            self._rename_in(kept, edge.joint.scope)
            parts.kept_in.setdefault((JOINT, name), []).extend(kept)

    def _hold(self, link: Anchor, parts: _Parts) -> None:
        """Join the root of a tree to the world: it is free, or does not move in a static model."""
        name, pose = self._names[link], compose(self._world, self._frames.pose(link))
        kind = FIXED if self._is_static or self._stands(link) else FLOATING
        made = self._fixed(self._new(f"{name}_{kind}"), WORLD, name, pose, link.element, kind)
        parts.joints.append(made)

    def _fixed(
        self, name: str, parent: str, child: str, pose: Pose, owner: Element, kind: str = FIXED
    ) -> Element:
        """Return a joint that only says where a link is."""
        place = self._reading.place(owner.span)
        return making.element(
            "joint",
            place,
            {"name": name, "type": kind},
            [
                *origin(self._reading, pose, owner),
                making.element("parent", place, {"link": parent}),
                making.element("child", place, {"link": child}),
            ],
        )

    def _add_frame(self, name: str, link: str, pose: Pose, owner: Element, parts: _Parts) -> None:
        """Add a frame: a link without mass."""
        place = self._reading.place(owner.span, {"name": owner.value_span("name")})
        home = parts.homes[name] = parts.homes.get(link, link)
        joint = self._fixed(self._new(f"{name}_joint"), link, name, pose, owner)
        made = making.element("link", place, {"name": name})
        parts.frames.setdefault(home, []).append((joint, made))

    def _read_link(self, link: Anchor, parts: _Parts) -> None:
        """Add a link with its mass and its shapes."""
        reading, name, element = self._reading, self._names[link], link.element
        check_words(reading, element)
        for attribute in element.attributes:
            if attribute != "name":
                reading.warn(
                    "sdf-lost",
                    f"the attribute '{attribute}' of the link '{link.name}' is lost",
                    element.name_span(attribute),
                )
        shapes = Shapes(reading, name, self._colors)
        kept: list[Element] = []
        collisions: list[tuple[Element, Pose]] = []
        for child in element.elements():
            if child.name in ("visual", "collision"):
                pose = self._frames.pose_in(link, child_named(child, "pose"), link.scope)
                shapes.add(child, pose)
                if child.name == "collision":
                    collisions.append((child, pose))
            elif child.name == "sensor":
                pose = self._frames.pose_in(link, child_named(child, "pose"), link.scope)
                parts.sensors.append((child, pose, LINK, name))
            elif child.name not in OF_LINK:
                own = child_named(child, "pose")
                if own is not None and child.name != "plugin":
                    child = placed(child, self._frames.pose_in(link, own, link.scope))
                kept.append(child)
        mass = mass_of(reading, element, collisions, is_static=self._is_static)
        kept += [*([] if mass.kept is None else [mass.kept]), *shapes.kept]
        place = reading.place(element.span, {"name": element.value_span("name")})
        inner = [*([] if mass.element is None else [mass.element]), *shapes.elements]
        parts.links.append(making.element("link", place, {"name": name}, inner))
        parts.notes += shapes.notes
        if kept:
            self._rename_in(kept, link.scope)
            parts.kept_in.setdefault((LINK, name), []).extend(kept)

    def _close(self, edge: Edge, parts: _Parts) -> None:
        """Note a joint that closes a loop; one that only SDF has is kept for it."""
        reading, frames, joint = self._reading, self._frames, edge.joint
        written = (attribute_text(joint.element, "type") or "").strip()
        kind, span = LOOPS.get(written), joint.element.span
        if kind is None or edge.parent is None:
            self._keep_joint(edge, parts)
            return
        axis = self._joint_reader.axis(edge) if kind == "revolute" else None
        ends = []
        for link, ending in ((edge.parent, "_parent"), (edge.child, "_frame")):
            pose, name = frames.between(link, joint), self._names[link]
            if pose != IDENTITY:
                frame = self._new(f"{edge.name}{ending}")
                self._add_frame(frame, name, pose, joint.element, parts)
                name = frame
            ends.append(name)
        values: dict[str, making.Value] = {
            "name": edge.name, "type": kind, "frame_1": ends[0], "frame_2": ends[1], "axis": axis,
        }  # fmt: skip
        place = reading.place(span, {"name": joint.element.value_span("name")})
        parts.notes.append(making.note("robot-loop", place, values))
        held: Held = {**OF_JOINT, "axis": {"xyz": True, "use_parent_model_frame": True}}
        rest = kept_of(joint.element, held, name=edge.name)
        if rest is not None and rest.children:
            parts.kept.append(rest)

    def _keep_joint(self, edge: Edge, parts: _Parts) -> None:
        """Keep a joint that closes a loop and that only SDF has."""
        joint, span = edge.joint, edge.joint.element.span
        child = self._names[edge.child]
        pose = pose_element(self._frames.between(edge.child, joint), joint.element, child)
        parent = WORLD if edge.parent is None else self._names[edge.parent]
        rest = kept_of(joint.element, {**OF_JOINT, "axis": True, "axis2": True})
        children: list[Node] = [pose, leaf("parent", parent, span), leaf("child", child, span)]
        children += [*self._joint_reader.axes(edge), *(rest.elements() if rest is not None else ())]
        attributes: dict[str, object] = {
            "name": edge.name, "type": attribute_text(joint.element, "type"),
        }  # fmt: skip
        parts.kept.append(Element("joint", span, attributes, children))

    # --- sensors, and what is kept of models ---

    def _read_sensors(self, robot: Element, parts: _Parts) -> None:
        """Note the sensors, and keep what the model does not hold of them.

        A sensor that is not at its link has a frame of its name, and a camera an optical one, as
        those have that are written in YAML.
        """
        if not parts.sensors:
            return
        reader, names = Sensors(self._reading, read_robot(robot)), set(self._taken)
        for sensor, pose, kind, home in parts.sensors:
            wanted = (attribute_text(sensor, "name") or "").strip() or f"{home}_sensor"
            name, count = wanted, 1
            while name in names:
                name = f"{home}_{wanted}" if count == 1 else f"{home}_{wanted}_{count}"
                count += 1
            note, kept = reader.add(sensor, pose, home, name)
            if kept is not None:
                parts.kept_in.setdefault((kind, home), []).append(kept)
            if note is None:
                continue
            names.add(name)
            self._taken.add(name)
            parts.notes.append(note)
            if kind == LINK:
                self._frame_of_sensor(note, pose, home, sensor, parts)

    def _frame_of_sensor(
        self, note: RobotNote, pose: Pose, home: str, sensor: Element, parts: _Parts
    ) -> None:
        """Give a sensor a frame of its name if it is not at its link."""
        given, name = note.attributes, str(note.attributes["name"])
        if "xyz" in given:
            inner = child_named(sensor, "camera")
            own = self._reading.pose(child_named(inner, "pose")) if inner is not None else IDENTITY
            del given["xyz"], given["rpy"]
            given["frame"] = name
            self._add_frame(name, home, compose(pose, own), sensor, parts)
        if given["type"] in CAMERAS:
            optical = self._new(f"{name}_optical")
            turned = Pose(OPTICAL)
            self._add_frame(optical, str(given["frame"]), turned, sensor, parts)
            if optical == f"{name}_optical":
                del given["optical_frame"]
            else:
                given["optical_frame"] = optical

    def _keep_of_models(self, parts: _Parts) -> None:
        """Keep what models say besides links, joints and frames."""
        for scope in self._scopes:
            check_words(self._reading, scope.element)
            kept = [each for each in scope.element.elements() if each.name not in OF_MODEL]
            if scope.include is not None:
                check_words(self._reading, scope.include)
                kept += [each for each in scope.include.elements() if each.name == "plugin"]
                for each in scope.include.elements():
                    if ":" in each.name:
                        self._reading.warn(
                            "sdf-lost",
                            f"what <{each.name}> changes in the included model is lost",
                            each.span,
                        )
                own = child_named(scope.include, "static")
                if own is not None:
                    kept = [own, *(each for each in kept if each.name != "static")]
            if scope is not self._scope:
                for each in kept:
                    if each.name in OF_ONE_MODEL - {"static"} and self._says_more(each):
                        self._reading.warn(
                            "sdf-lost",
                            f"<{each.name}> of the nested model '{'::'.join(scope.path())}' is "
                            "lost: its links are those of the whole robot",
                            each.span,
                        )
                kept = [each for each in kept if each.name not in OF_ONE_MODEL]
            self._rename_in(kept, scope)
            parts.kept += kept

    def _says_more(self, element: Element) -> bool:
        """Return whether an element says something else than the default."""
        text = (content(element) or "").lower()
        return text not in (
            ("true", "1") if element.name == "allow_auto_disable" else ("false", "0")
        )

    def _rename_in(self, kept: list[Element], scope: Scope) -> None:
        """Write the names of the robot where what is kept names a link, joint or frame."""
        for element in kept:
            for each in element.iter():
                for attribute, value in each.attributes.items():
                    if NAMING.search(attribute) and isinstance(value, str):
                        each.attributes[attribute] = self._renamed(value, scope)
                if NAMING.search(each.name):
                    for text in each.children:
                        if isinstance(text, Text):
                            text.value = self._renamed(format_value(text.value), scope)

    def _renamed(self, text: str, scope: Scope) -> str:
        anchor = self._frames.seek(text.strip(), scope)
        name = self._names.get(anchor) if anchor is not None else None
        return text if name is None else text.replace(text.strip(), name)


class _Parts:
    """What a robot is made of.

    Attributes:
        links, joints: in the order of the document.
        above: the links without mass that joints move, by the links that are fixed to them.
        frames: the links without mass that are frames, each with its joint, by the links that they
            are in.
        homes: the links that frames are in.
        notes: surfaces, sensors, loops and the base.
        sensors: the sensors, each with its pose, LINK or JOINT and the name of that.
        kept: what the model does not hold of the robot as a whole.
        kept_in: the same of links and joints, by kind and name.
    """

    def __init__(self) -> None:
        self.links: list[Element] = []
        self.joints: list[Element] = []
        self.above: dict[Anchor, Element] = {}
        self.frames: dict[str, list[tuple[Element, Element]]] = {}
        self.homes: dict[str, str] = {}
        self.notes: list[RobotNote] = []
        self.sensors: list[tuple[Element, Pose, str, str]] = []
        self.kept: list[Element] = []
        self.kept_in: dict[tuple[str, str], list[Element]] = {}

    def elements(self) -> list[Element]:
        """Return links, each before the frames in it, and then the joints in the same way."""
        links, joints = [], []
        moved = {str(_end_of(joint, "child")): joint for joint in self.joints}
        for link in self.links:
            frames = self.frames.get(str(link.attributes["name"]), [])
            links += [link, *(frame for _, frame in frames)]
            if link.attributes["name"] not in moved:
                joints += [joint for joint, _ in frames]
        for name, joint in moved.items():
            joints += [joint, *(inner for inner, _ in self.frames.get(name, []))]
        return [*links, *joints]


def _end_of(joint: Element, end: str) -> object:
    """Return the link at an end of a joint."""
    return next(each.attributes["link"] for each in joint.elements() if each.name == end)
