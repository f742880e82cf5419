"""`mirror`: its body, and its image once the names in the robot are resolved."""

from __future__ import annotations

from itertools import islice

from ..diagnostics import YamaroError, did_you_mean, failure
from ..model.extras import CAMERAS
from ..model.joint import TURNING
from ..model.pose import Pose
from ..model.schema import ELEMENTS, KEPT, NEGATED, RECORDS
from ..source import joined
from ..xml.robot_names import RobotNames
from ..xml.tree import Element, RawBlock, RobotNote, Text
from ..xml.values import format_value
from .extras import OPTICAL
from .lowering import names_of
from .naming import WordRenaming
from .notes import NAMED, check_keys, one_of, place_of
from .numbers import negated
from .rigid import RigidLinks, child_links, link_of, name_of, pose_of, set_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from ..xml.tree import Node, RobotWord
    from .lowering import Lowering

KEYS = ("plane", "of", "rename", "axes", "meshes", "body")
TILTED = 1e-9
"""How far an axis may be from its image and still count as the same."""


class Mirror(Element):
    """What a `mirror` leaves in the tree until its image is made.

    Attributes:
        normal: the number of the axis that the plane is normal to.
        of: the key that names the link whose plane it is, or None.
        renaming: how names change.
        keeps_axes: whether an axis whose image is its opposite is kept.
        meshes: "scale", "same", or the file that replaces each.
        made: what the body made.
    """

    __slots__ = ("keeps_axes", "made", "meshes", "normal", "of", "renaming")

    def __init__(self, word: RobotWord) -> None:
        """Read nothing yet; these are the defaults."""
        super().__init__("mirror", word.span, trace=word.trace)
        self.normal = PLANES["xz"]
        self.of: Element | None = None
        self.renaming = WordRenaming({})
        self.keeps_axes = True
        self.meshes: str | dict[str, str] = "scale"
        self.made: list[Node] = []


def lower_mirror(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append what the body of a `mirror` makes, and what holds the place of its image."""
    mirror = Mirror(word)
    try:
        _read_keys(mirror, word)
    except YamaroError as error:
        lowering.absorb(error)
        return
    mirror.trace = lowering.trace
    counts = len(lowering.part_links), len(lowering.part_joints)
    from .part import lower_nodes

    nodes = next((key.children for key in word.elements() if key.name == "body"), [])
    mirror.made = lower_nodes(lowering, nodes)
    rename = mirror.renaming.apply
    for names, count in zip((lowering.part_links, lowering.part_joints), counts, strict=True):
        for name in reversed(list(islice(reversed(names), len(names) - count))):  # the new ones
            names.setdefault(rename(name), rename(names[name]))
    lowering.pending.append(mirror)
    out += mirror.made
    out.append(mirror)


# --- its keys ---------------------------------------------------------------------------------


def _read_keys(mirror: Mirror, word: RobotWord) -> None:
    check_keys(word, KEYS)
    has_names = False
    for key in word.elements():
        if key.name == "plane":
            mirror.normal = PLANES[one_of(key, tuple(PLANES))]
        elif key.name == "of":
            mirror.of = key
        elif key.name == "axes":
            mirror.keeps_axes = one_of(key, ("keep", "mirror")) == "keep"
        elif key.name == "meshes":
            words = _words(key)
            mirror.meshes = words or one_of(key, ("scale", "same"))
        elif key.name == "rename":
            has_names = True
            mirror.renaming = WordRenaming(_words(key))
    if not has_names:
        raise failure(
            "missing-key",
            "`mirror` needs an entry `rename`",
            word.span,
            hint="write rename: {left: right}, which names the mirrored links and joints",
            trace=word.trace,
        )


def _words(key: Element) -> dict[str, str]:
    """Return the pairs of a mapping under a key; none if it is a text."""
    words: dict[str, str] = {}
    for child in key.elements():
        words[child.name] = child.text().strip()
        if not words[child.name]:
            raise failure(
                "missing-value",
                f"nothing replaces '{child.name}'",
                child.span,
                hint=f"write {key.name}: {{{child.name}: …}}",
                trace=key.trace,
            )
    return words


# --- the image --------------------------------------------------------------------------------


def make_images(lowering: Lowering, robot: Element) -> None:
    """Put the image of each mirror where it belongs, inner ones first."""
    images: dict[int, list[Node]] = {}
    links = names_of(robot, "link")  # and those of images
    for mirror in lowering.pending:
        links |= {mirror.renaming.apply(name) for name in _own_links(lowering, mirror)}
    present = _Present(robot.children)
    for mirror in lowering.pending:
        entered = lowering.enter(mirror)
        made = _with_images(mirror.made, images)
        # The controls in a body choose among its joints: their images have the mirrored ones.
        inside = {id(node) for node in made}
        own = [control for control in lowering.controls if id(control.note) in inside]
        if own:
            from .control import choose_members

            choose_members(lowering, [each for each in made if isinstance(each, Element)], own)
            lowering.controls = [control for control in lowering.controls if control not in own]
        image = images[id(mirror)] = _Image(lowering, mirror, made, present, links).nodes()
        present.add(image)
        lowering.leave(entered)
    robot.children = _with_images(robot.children, images)


def _with_images(nodes: list[Node], images: dict[int, list[Node]]) -> list[Node]:
    found: list[Node] = []
    for node in nodes:
        if isinstance(node, Mirror):
            found += images.get(id(node), ())
        else:
            found.append(node)
    return found


def _own_links(lowering: Lowering, mirror: Mirror) -> set[str]:
    names: set[str] = set()
    for node in mirror.made:
        if isinstance(node, Mirror):
            names |= {node.renaming.apply(name) for name in _own_links(lowering, node)}
        elif isinstance(node, Element) and node.name == "link":
            names.add(name_of(node))
    return names


class _Present:
    """The links that are there already, those of the images made so far among them.

    Attributes:
        links: their names.
        rigid: which of them are rigidly joined.
    """

    __slots__ = ("links", "rigid")

    def __init__(self, nodes: Iterable[Node]) -> None:
        self.links: set[str] = set()
        self.rigid = RigidLinks()
        self.add(nodes)

    def add(self, nodes: Iterable[Node]) -> None:
        """Take some more of the robot."""
        elements = [node for node in nodes if isinstance(node, Element)]
        self.links.update(name_of(each) for each in elements if each.name == "link")
        self.rigid.add(elements)


class _Image:
    """Makes one image."""

    __slots__ = (
        "links", "lowering", "made", "mirror", "optical", "present", "signs", "there",
    )  # fmt: skip

    def __init__(
        self,
        lowering: Lowering,
        mirror: Mirror,
        made: list[Node],
        present: _Present,
        there: set[str],
    ) -> None:
        self.lowering = lowering
        self.mirror = mirror
        self.present = present
        self.there = there
        self.made = [node for node in made if isinstance(node, Element)]
        self.links = {name_of(each) for each in self.made if each.name == "link"}
        self.signs: dict[str, int] = {}
        self.optical = {
            f"{name_of(each)}{OPTICAL}"
            for each in self.made
            if isinstance(each, RobotNote) and each.attributes.get("type") in CAMERAS
        }

    def nodes(self) -> list[Node]:
        """Return the mirrored elements, with their new names."""
        self._check_roots()
        kept = [element for element in self.made if element.name != "material"]
        copies = [copy_of(element) for element in kept]
        for copy in copies:
            copy.span = joined(copy.span, self.mirror.span)
            if copy.name == "joint":
                self._mirror_joint(copy)
        for copy in copies:
            if copy.name == "joint":
                for mimic in copy.elements():
                    if mimic.name == "mimic":
                        leader = self.signs.get(format_value(mimic.attributes.get("joint")), 1)
                        reverse_mimic(copy, follower=self.signs[name_of(copy)], leader=leader)
            elif copy.name == "link":
                normal = self.mirror.normal
                mirror_link(copy, normal)
                for section in copy.elements():
                    name = section.attributes.get("name")
                    if name is not None:
                        section.attributes["name"] = self.mirror.renaming.apply(format_value(name))
                    if section.name not in ("inertial", "visual", "collision"):
                        self._warn_of_poses(section)
                for mesh in meshes_of(copy):
                    if self.mirror.meshes == "scale":
                        turn_mesh(mesh, normal)
                    elif isinstance(self.mirror.meshes, dict):
                        self._replace_mesh(mesh, self.mirror.meshes)
            elif isinstance(copy, RobotNote):
                mirror_pose_in(copy, self.mirror.normal)
                for joint in copy.elements():
                    if self.signs.get(format_value(joint.attributes.get("joint"))) == -1:
                        change_text(joint, "value", negated)
            elif copy.name == "ros2_control":
                for joint in copy.elements():
                    if joint.name == "joint" and self.signs.get(name_of(joint)) == -1:
                        reverse_interfaces(joint)
            else:
                self._warn_of_poses(copy)
        RobotNames(kept).rename(copies, self.mirror.renaming.apply)
        found: list[Node] = []
        for original, copy in zip(kept, copies, strict=True):
            is_image = self._check_name(original, copy)
            if not isinstance(
                original, RobotNote
            ):  # what names nothing of the body is not repeated
                has_own_name = original.name in ("link", "joint")
                is_image = has_own_name or what_it_says(original) != what_it_says(copy)
            if is_image:
                found.append(copy)
        return found

    # --- links ---

    def _replace_mesh(self, mesh: Element, files: dict[str, str]) -> None:
        """Replace a mesh file by the one that is given for it, by its path or its last name."""
        path = format_value(mesh.attributes.get("filename"))
        folder, slash, name = path.rpartition("/")
        other = files.get(path)
        if other is None and name in files:
            other = files[name] if "/" in files[name] else folder + slash + files[name]
        if other is not None:
            mesh.attributes["filename"] = other
            return
        self.lowering.absorb(
            failure(
                "mirror-mesh",
                f"'meshes' does not specify a replacement for '{name}'",
                mesh.value_span("filename"),
                hint=f"add {name}: to 'meshes', with the file of its mirror image or its own name",
                trace=mesh.trace,
            )
        )

    def _warn_of_poses(self, element: Element) -> None:
        if holds_pose(element):
            self.lowering.report(
                "mirror-raw",
                f"<{element.name}> contains a pose, which is copied unchanged",
                element.span,
                hint="`mirror` changes poses of links, joints and shapes; write the mirrored "
                "element beside it",
                trace=element.trace,
            )

    # --- joints ---

    def _mirror_joint(self, joint: Element) -> None:
        name = name_of(joint)
        self.signs[name] = 1
        parent = next((each for each in joint.elements() if each.name == "parent"), None)
        if any(each.name == "child" and link_of(each) in self.optical for each in joint.elements()):
            return  # an image of the camera has its x axis to the right as well
        if parent is not None and link_of(parent) not in self.links:
            self._mirror_root(joint, parent)
        else:
            mirror_origin(joint, self.mirror.normal)
        axes = mirrored_axis(joint, self.mirror.normal)
        if axes is None or _same(*axes):
            return
        axis, image = axes
        if not self.mirror.keeps_axes:
            set_axis(joint, image)
        elif _same(axis, image, sign=-1):
            self.signs[name] = -1
            reverse(joint)
        else:
            set_axis(joint, image)
            self.lowering.report(
                "mirror-axis",
                f"the axis of '{name}' is tilted to the plane, so that of its image is {image}",
                joint.span,
                hint="write axes: mirror to mirror all axes, to confirm that this is intended",
                trace=joint.trace,
            )

    def _mirror_root(self, joint: Element, parent: Element) -> None:
        """Mirror a joint whose parent is outside of the body, in the plane of that or of `of`."""
        old = new = link_of(parent)
        if self.mirror.renaming.apply(old) in self.there:
            new = parent.attributes["link"] = self.mirror.renaming.apply(old)
        if self.mirror.of is None:
            mirror_origin(joint, self.mirror.normal)
            return
        try:
            T_plane_parent = self._pose_in_plane(self.mirror.of, old)
            T_plane_new = T_plane_parent
            if new in self.present.links:
                T_plane_new = self._pose_in_plane(self.mirror.of, new)
            elif new != old:  # it is an image that is not made yet
                T_plane_new = mirrored_pose(T_plane_parent, self.mirror.normal)
        except YamaroError as error:
            self.lowering.absorb(error)
            return
        image = mirrored_pose(T_plane_parent @ pose_of(joint), self.mirror.normal)
        set_pose(joint, T_plane_new.inverse() @ image)

    def _pose_in_plane(self, key: Element, parent: str) -> Pose:
        """Return the pose of a joint's parent in the frame of the link that `of` names."""
        name = key.text().strip()
        link = name if name in self.there else self.lowering.part_links.get(name)
        if link is None:
            known = (*self.there, *self.lowering.part_links)
            raise failure(
                "unknown-link",
                f"'of' names '{name}', and there is no such link or part",
                place_of(key),
                hint=did_you_mean(name, known) or "name the link whose plane it is",
                trace=key.trace,
            )
        top, pose = self.present.rigid.top_of(link)
        top_of_parent, pose_of_parent = self.present.rigid.top_of(parent)
        if top != top_of_parent:
            raise failure(
                "mirror-parent",
                f"'of' names '{name}', which moves against '{parent}', the parent of the body",
                place_of(key),
                hint=f"name a link that is rigidly joined to '{parent}', or leave 'of' out",
                trace=key.trace,
            )
        return pose.inverse() @ pose_of_parent

    # --- what cannot be mirrored ---

    def _check_name(self, original: Element, copy: Element) -> bool:
        """Return whether an image can have its name beside the original; else record it."""
        kind = original.name if original.name in ("link", "joint") else None
        if isinstance(original, RobotNote):
            kind = NAMED.get(original.name)
        if kind is None or name_of(original) != name_of(copy):
            return True
        name = name_of(original)
        self.lowering.absorb(
            failure(
                "mirror-name",
                f"the {kind} '{name}' has no word that 'rename' replaces, "
                "so its image would have the same name"
                if name
                else f"this `{kind}` has no name, so its image would have the same one",
                original.value_span("name"),
                hint="name it with one of the words, such as left_…, or add a word to 'rename'",
                trace=original.trace,
            )
        )
        return False

    def _check_roots(self) -> None:
        children = child_links(self.made)
        for link in self.made:
            if link.name == "link" and name_of(link) not in children:
                self.lowering.absorb(
                    failure(
                        "mirror-parent",
                        f"the link '{name_of(link)}' has no parent, so there is no plane to mirror "
                        "it in",
                        link.value_span("name"),
                        hint="join it to a link outside of `mirror`, or move it out of the body",
                        trace=link.trace,
                    )
                )


def _same(one: str, other: str, *, sign: int = 1) -> bool:
    try:
        pairs = zip(map(float, one.split()), map(float, other.split()), strict=True)
        return all(abs(a - sign * b) <= TILTED for a, b in pairs)
    except ValueError:
        return False


# --- mirrored values --------------------------------------------------------------------------
# S is the reflection in the plane, a diagonal matrix with −1 for the plane's normal. A pose (R, x)
# becomes (S·R·S, S·x), an inertia I becomes S·I·S. An axis is mirrored as what it moves: a
# prismatic joint's a becomes S·a, a revolute one's, which turns the other way in a mirror, −S·a.
#
# Source: E. W. Weisstein, "Pseudovector", MathWorld; R. Featherstone, Rigid Body Dynamics
# Algorithms, section 2.8, for the transformation of inertia.


PLANES = {"yz": 0, "xz": 1, "xy": 2}
"""The planes, each with the number of its normal."""

_MOMENTS = {"ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}
_SLIDING = ("prismatic", "planar")


def mirrored_row(text: str, normal: int, *, turns: bool = False) -> str:
    """Return three numbers mirrored: a position S·x, or angles, of which two change their sign."""
    words = text.split()
    return " ".join(
        negated(word) if (index == normal) != turns else word for index, word in enumerate(words)
    )


def mirrored_pose(pose: Pose, normal: int) -> Pose:
    """Return the pose (S·R·S, S·x)."""
    (a, b, c), (d, e, f), (g, h, i) = [
        tuple(-x if (row == normal) != (column == normal) else x for column, x in enumerate(values))
        for row, values in enumerate(pose.rotation)
    ]
    x, y, z = [-each if row == normal else each for row, each in enumerate(pose.position)]
    return Pose(((a, b, c), (d, e, f), (g, h, i)), (x, y, z))


def copy_of(element: Element) -> Element:
    """Return a copy of an element and of all that is in it."""
    children: list[Node] = []
    for child in element.children:
        if isinstance(child, Element):
            children.append(copy_of(child))
        elif isinstance(child, Text):
            children.append(Text(child.value, child.span))
        else:
            children.append(child)
    copy = element.with_children(children)
    copy.attributes = dict(element.attributes)
    return copy


def mirror_origin(element: Element, normal: int) -> None:
    """Mirror the `<origin>` in an element."""
    for origin in element.elements():
        if origin.name == "origin":
            mirror_pose_in(origin, normal)


def mirror_pose_in(element: Element, normal: int) -> None:
    """Mirror the pose that the attributes of an element are, if it has one."""
    change_text(element, "xyz", lambda text: mirrored_row(text, normal))
    change_text(element, "rpy", lambda text: mirrored_row(text, normal, turns=True))


def mirror_link(link: Element, normal: int) -> None:
    """Mirror a link's inertia and shapes; what its meshes need is another matter."""
    for section in link.elements():
        if section.name in ("inertial", "visual", "collision"):
            mirror_origin(section, normal)
        if section.name != "inertial":
            continue
        for inertia in section.elements():
            if inertia.name == "inertia":
                for name, axes in _MOMENTS.items():
                    if normal in axes:
                        change_text(inertia, name, negated)


def meshes_of(link: Element) -> list[Element]:
    """Return the `<mesh>` elements of a link."""
    return [
        mesh
        for section in link.elements()
        if section.name in ("visual", "collision")
        for geometry in section.elements()
        if geometry.name == "geometry"
        for mesh in geometry.elements()
        if mesh.name == "mesh"
    ]


def turn_mesh(mesh: Element, normal: int) -> None:
    """Scale a mesh by −1 along the plane's normal."""
    if mesh.attributes.get("scale") is None:
        mesh.attributes["scale"] = "1 1 1"
    change_text(mesh, "scale", lambda text: mirrored_row(text, normal))


def mirrored_axis(joint: Element, normal: int) -> tuple[str, str] | None:
    """Return a joint's axis and its image, or None if it has none that counts."""
    kind = format_value(joint.attributes.get("type"))
    if kind not in TURNING + _SLIDING:
        return None
    axis = "1 0 0"
    for child in joint.elements():
        if child.name == "axis" and child.attributes.get("xyz") is not None:
            axis = format_value(child.attributes["xyz"])
    return axis, mirrored_row(axis, normal, turns=kind in TURNING)


def set_axis(joint: Element, axis: str) -> None:
    """Give a joint another axis."""
    for child in joint.elements():
        if child.name == "axis":
            child.attributes["xyz"] = axis
            return
    joint.children.append(Element("axis", joint.span, {"xyz": axis}, trace=joint.trace))


def reverse(joint: Element) -> None:
    """Let the positions of a joint count the other way: its limits change sides and signs."""
    for part in joint.elements():
        for field in ELEMENTS[part.name].fields.values() if part.name in RECORDS else ():
            if field.reversal == NEGATED:
                change_text(part, field.name, negated)
            elif field.reversal != KEPT and field.name < field.reversal:  # each pair once
                _swap(part, field.name, field.reversal)


def _swap(element: Element, lower: str, upper: str) -> None:
    """Give each of two limits the negated value of the other, in the order they were written.

    Its place goes with it.
    """
    old, places = element.attributes, element.value_spans
    if lower not in old and upper not in old:
        return
    other = {lower: upper, upper: lower}
    new: dict[str, object] = {}
    for name, value in old.items():
        if name not in other:
            new[name] = value
        elif other[name] in old:
            new[name] = negated(format_value(old[other[name]]).strip())
        else:
            new[other[name]] = negated(format_value(value).strip())
    element.attributes = new
    if places is not None:
        moved = {name: places.get(other.get(name, name)) for name in new}
        element.value_spans = {name: place for name, place in moved.items() if place is not None}


def reverse_interfaces(joint: Element) -> None:
    """Let the interfaces of a joint in `<ros2_control>` count the other way, as `reverse` does."""
    for interface in joint.elements():
        params = {format_value(each.attributes.get("name")): each for each in interface.elements()}
        for name in ("min", "max", "initial_value"):
            if name in params:
                for text in params[name].children:
                    if isinstance(text, Text):
                        try:
                            text.value = negated(format_value(text.value).strip())
                        except ValueError:  # it is not a number
                            continue
        if "min" in params and "max" in params:
            low, high = params["min"], params["max"]
            low.children, high.children = high.children, low.children
        elif "min" in params:
            params["min"].attributes["name"] = "max"
        elif "max" in params:
            params["max"].attributes["name"] = "min"


def reverse_mimic(joint: Element, *, follower: int, leader: int) -> None:
    """Let a joint follow its leader as before, where the positions of either count the other way.

    From q = multiplier · q_leader + offset, with q' = follower · q and so for the leader.
    """
    for mimic in joint.elements():
        if mimic.name != "mimic":
            continue
        if follower * leader < 0:
            mimic.attributes.setdefault("multiplier", "1")
            change_text(mimic, "multiplier", negated)
        if follower < 0:
            change_text(mimic, "offset", negated)


def change_text(element: Element, attribute: str, change: Callable[[str], str]) -> None:
    """Change an attribute that holds numbers; other text stays, and is reported elsewhere."""
    value = element.attributes.get(attribute)
    if value is None:
        return
    try:
        element.attributes[attribute] = change(format_value(value).strip())
    except ValueError:
        return


def holds_pose(element: Element) -> bool:
    """Return whether some XML may hold a pose, which is not mirrored."""
    words: tuple[str, ...] = ("pose", "origin", "xyz", "rpy")
    if isinstance(element, RawBlock):
        words += ("pos", "quat", "euler", "axisangle", "zaxis", "fromto", "axis", "gravity")
    return any(
        inner.name in words or any(name in words for name in inner.attributes)
        for inner in element.iter()
    )


def what_it_says(node: Node) -> object:
    """Return what a node says, without its places: two are equal if it is the same."""
    if isinstance(node, Element):
        attributes = {name: format_value(value) for name, value in node.attributes.items()}
        return node.name, attributes, [what_it_says(child) for child in node.children]
    return format_value(node.value) if isinstance(node, Text) else None
