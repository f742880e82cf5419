"""The joints, bodies, actuators and sensors that programs find in a document, in their order.

Each order is that of a version which was loaded with the robots of `bench/interface.py`:
pinocchio 4.1, MuJoCo 4.0, Drake 1.51 and Newton 1.8. That of Isaac Sim is the one that Isaac Lab
3.0 documents for PhysX, in `isaaclab.assets.articulation.ordering_resolvers`.
"""

from __future__ import annotations

from ...model.joint import CONTINUOUS, FIXED, FLOATING, PLANAR
from ...xml.tree import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from pxr import Usd

    from ...model.robot import Robot
    from ..output import Output

    Entry = dict[str, object]

WORLD = "world"
ONE, QUATERNION = (1, 1), (7, 6)
"""Positions and velocities of a joint with one degree of freedom, and of one with six."""


class UnknownOrderError(Exception):
    """The program refuses the document, or nothing says which order it has.

    Attributes:
        hint: what to write instead, or "".
    """

    def __init__(self, reason: str, hint: str = "") -> None:
        super().__init__(reason)
        self.hint = hint


class Listing:
    """What one program finds.

    Attributes:
        positions, velocities: how long the vectors are that hold those of all joints.
        joints, bodies, actuators, sensors: what it finds, in its order.
    """

    __slots__ = (
        "_names", "_robot", "actuators", "bodies", "joints", "positions", "sensors", "velocities",
    )  # fmt: skip

    def __init__(self, robot: Robot, names: Mapping[str, Mapping[str, str]]) -> None:
        """Start with the names in the robot: see `Output.names`."""
        self._robot = robot
        self._names = names
        self.positions = self.velocities = 0
        self.joints: list[Entry] = []
        self.bodies: list[Entry] = []
        self.actuators: list[Entry] = []
        self.sensors: list[Entry] = []

    def data(self) -> Entry:
        """Return it as it is written."""
        return {
            "positions": self.positions,
            "velocities": self.velocities,
            "joints": self.joints,
            "bodies": self.bodies,
            "actuators": self.actuators,
            "sensors": self.sensors,
        }

    def own(self, kind: str, name: str) -> str | None:
        """Return what something is called in the robot; None if the robot does not name it."""
        return self._names.get(kind, {}).get(name)

    def add_joint(
        self,
        name: str,
        counts: tuple[int, int],
        *,
        source: str | None = None,
        first: tuple[int, int] | None = None,
    ) -> None:
        """Add a joint.

        Args:
            name: what the program calls it.
            counts: how many positions and velocities it has.
            source: its name in the document, if it has another one there.
            first: the indices of its first position and velocity, by default the next ones.
        """
        entry: Entry = {"name": name, "yamaro": self.own("joint", source or name)}
        part = self.own("part", source or name)
        if part is not None:
            entry["part"] = part
        at = first or (self.positions, self.velocities)
        entry["q"], entry["v"] = [at[0], counts[0]], [at[1], counts[1]]
        self.joints.append(entry)
        self.positions += counts[0]
        self.velocities += counts[1]

    def add_free(self, name: str, link: str, *, first: tuple[int, int] | None = None) -> None:
        """Add the joint of a free link, which is a joint of the robot if that is floating."""
        joint = self._robot.parent_joint(self.own("link", link) or "")
        own = joint.name if joint is not None and joint.type == FLOATING else None
        self.add_joint(name, QUATERNION, first=first)
        self.joints[-1]["yamaro"] = own

    def add_body(self, name: str, *, source: str | None = None) -> None:
        """Add a body."""
        self.bodies.append({"name": name, "yamaro": self.own("link", source or name)})

    def add_actuator(self, name: str, joint: str | None) -> None:
        """Add what drives a joint of the robot, or something else."""
        self.actuators.append({"name": name, "yamaro": joint})


# --- URDF -------------------------------------------------------------------------------------


def in_pinocchio(robot: Robot, *, is_fixed: bool) -> Listing:
    """Return what pinocchio finds in the URDF: depth-first, the joints of a link by name.

    Bodies are its frames of that type: one for each link. With a free base, it is loaded with
    `JointModelFreeFlyer()`.
    """
    names = {"joint": {name: name for name in robot.joints}, "link": {n: n for n in robot.links}}
    listing = Listing(robot, names)
    if not is_fixed:
        listing.add_joint("root_joint", QUATERNION)
    counts = {CONTINUOUS: (2, 1), PLANAR: (4, 3), FLOATING: QUATERNION}
    pending = [link.name for link in robot.roots]
    if len(pending) > 1:
        raise UnknownOrderError("pinocchio takes one root")
    while pending:
        link = pending.pop()
        joint = robot.parent_joint(link)
        if joint is not None and joint.type != FIXED:
            listing.add_joint(joint.name, counts.get(joint.type, ONE))
        listing.add_body(link)
        below = sorted(robot.joints_below(link), key=lambda each: each.name, reverse=True)
        pending += [each.child for each in below]
    return listing


# --- MJCF -------------------------------------------------------------------------------------

MADE_ELSEWHERE = frozenset(("attach", "composite", "flexcomp", "include"))
"""Elements of which MuJoCo makes others, which are not in the document."""
REFERENCES = {
    "joint": "joint", "jointinparent": "joint", "joint1": "joint", "joint2": "joint",
    "site": "site", "refsite": "site", "cranksite": "site", "slidersite": "site",
    "site1": "site", "site2": "site", "body": "body", "body1": "body", "body2": "body",
    "camera": "camera", "geom1": "geom", "geom2": "geom", "actuator": "actuator",
}  # fmt: skip
"""The attributes of actuators and sensors that name something, and what that is."""
VALUES = {
    **dict.fromkeys(
        ("accelerometer", "velocimeter", "gyro", "force", "torque", "magnetometer", "ballangvel",
         "framepos", "framexaxis", "frameyaxis", "framezaxis", "framelinvel", "frameangvel",
         "framelinacc", "frameangacc", "subtreecom", "subtreelinvel", "subtreeangmom", "normal"),
        3,
    ),
    "framequat": 4, "ballquat": 4, "camprojection": 2, "fromto": 6,
}  # fmt: skip
"""How many numbers a sensor of MuJoCo gives, if not one."""
VARIABLE = frozenset(("contact", "plugin", "tactile"))
"""The sensors of which other elements say how many numbers they give."""


class Thing:
    """Something in MJCF that has a name.

    Attributes:
        kind: `body`, `joint`, `site`, …; a `freejoint` is a joint.
        name: its name, which a copy has with an ending.
        element: the element.
        references: what it refers to: kinds and names.
    """

    __slots__ = ("element", "kind", "name", "references")

    def __init__(self, element: Element, kind: str, name: str, references: set[tuple[str, str]]):
        self.element = element
        self.kind = kind
        self.name = name
        self.references = references

    def copied(self, ending: str, names: Collection[tuple[str, str]]) -> Thing:
        """Return a copy; what it refers to among these names is the copy of that."""
        references = {
            (kind, name + ending) if (kind, name) in names else (kind, name)
            for kind, name in self.references
        }
        return Thing(self.element, self.kind, self.name + ending, references)


def in_mujoco(robot: Robot, output: Output) -> Listing:
    """Return what MuJoCo finds in the MJCF: all in the order of the document.

    What refers to something that `<replicate>` copies is copied as well, and the copies are at the
    end of their section.
    """
    assert output.root is not None, "MJCF is XML"
    listing = Listing(robot, output.names)
    reading = _Mjcf(output.root)
    listing.add_body(WORLD)
    for thing in reading.things:
        source = _text(thing.element, "name")
        if thing.kind == "body":
            listing.add_body(thing.name, source=source)
        elif thing.kind == "joint":
            kind = _text(thing.element, "type")
            if thing.element.name == "freejoint":
                kind = "free"
            counts = {"free": QUATERNION, "ball": (4, 3)}.get(kind, ONE)
            listing.add_joint(thing.name, counts, source=source)
    for thing in reading.actuators:
        joint = listing.own("joint", _text(thing.element, "joint"))
        listing.add_actuator(thing.name, joint)
    for thing in reading.sensors:
        kind = thing.element.name
        values: int | None = VALUES.get(kind, 1)
        if kind == "user":
            values = int(_text(thing.element, "dim") or 1)
        elif kind in VARIABLE:
            values = None
        own = listing.own("sensor", _text(thing.element, "name"))
        listing.sensors.append({"name": thing.name, "yamaro": own, "values": values})
    return listing


class _Mjcf:
    """Reads a document.

    Attributes:
        things: what is in the world.
        actuators, sensors: what is in these sections.
    """

    def __init__(self, root: Element) -> None:
        for each in root.iter():
            if each.name in MADE_ELSEWHERE:
                raise UnknownOrderError(f"<{each.name}> of MuJoCo holds what is not written here")
        sections = root.elements()
        self.actuators = self._in_sections(sections, "actuator")
        self.sensors = self._in_sections(sections, "sensor")
        self.things: list[Thing] = []
        for section in sections:
            if section.name == "worldbody":
                self.things += self._in_body(section)

    def _in_sections(self, sections: list[Element], kind: str) -> list[Thing]:
        found = []
        for section in sections:
            for each in section.elements() if section.name == kind else ():
                references = set()
                for attribute, own in REFERENCES.items():
                    references.add((own, _text(each, attribute)))
                for number in ("obj", "ref"):
                    own = _text(each, f"{number}type").removeprefix("x")  # a body, seen otherwise
                    references.add((own, _text(each, f"{number}name")))
                found.append(Thing(each, kind, _text(each, "name"), references))
        return found

    def _in_body(self, around: Element) -> list[Thing]:
        """Return what is in an element, and in what is in that."""
        found: list[Thing] = []
        pending = around.elements()[::-1]
        while pending:
            each = pending.pop()
            if each.name == "replicate":
                found += self._copies(each)
                continue
            kind = "joint" if each.name == "freejoint" else each.name
            found.append(Thing(each, kind, _text(each, "name"), set()))
            pending += each.elements()[::-1]
        return found

    def _copies(self, replicate: Element) -> list[Thing]:
        """Return what MuJoCo makes of a `<replicate>`, and copy what refers to that."""
        inner = self._in_body(replicate)
        count = int(_text(replicate, "count") or 0)
        endings = [
            f"{_text(replicate, 'sep')}{index:0{len(str(count - 1))}}" for index in range(count)
        ]
        names = {(each.kind, each.name) for each in inner if each.name}
        for section in (self.actuators, self.sensors):
            copied = [each for each in section if not names.isdisjoint(each.references)]
            section[:] = [each for each in section if each not in copied]
            section += [each.copied(ending, names) for ending in endings for each in copied]
            names |= {(each.kind, each.name) for each in copied}
        return [each.copied(ending, names) for ending in endings for each in inner]


def _text(element: Element, attribute: str) -> str:
    value = element.attributes.get(attribute)
    return "" if value is None else str(value)


# --- SDF --------------------------------------------------------------------------------------

DRIVEN = ("revolute", "continuous", "prismatic")
"""The types of joints that Drake gives an actuator, unless their effort is 0."""
COUNTS = {FIXED: (0, 0), "ball": (3, 3), "universal": (2, 2)}


def in_drake(robot: Robot, output: Output) -> Listing:
    """Return what Drake finds in the SDF: all in the order of the document.

    Positions and velocities are in another order: depth-first from the world, the joints of a link
    as in the document; then free links, first those that other links are joined to.
    """
    assert output.root is not None, "SDF is XML"
    (model,) = output.root.elements()
    listing = Listing(robot, output.names)
    if any(each.name in ("include", "model") for each in model.elements()):
        raise UnknownOrderError("models in models are not written here")
    links = [_text(each, "name") for each in model.elements() if each.name == "link"]
    joints = [each for each in model.elements() if each.name == "joint"]
    below: dict[str, list[tuple[str, str]]] = {}  # joints and their children, by the parent
    held: set[str] = set()
    kinds = {_text(each, "name"): _text(each, "type") for each in joints}
    for joint in joints:
        parent, child = (_inner(joint, name) for name in ("parent", "child"))
        if child in held or child not in links or parent not in (WORLD, *links):
            raise UnknownOrderError("Drake takes no loops")
        held.add(child)
        below.setdefault(parent, []).append((_text(joint, "name"), child))
    free = [link for link in links if link not in held]
    first: dict[str, tuple[int, int]] = {}
    trees = sorted(free, key=lambda link: link not in below)
    positions = velocities = 0
    for root in (WORLD, *trees):
        pending = [] if root == WORLD else [(root, "")]
        pending += below.get(root, [])[::-1] if root == WORLD else []
        while pending:
            name, child = pending.pop()
            first[name] = positions, velocities
            counts = COUNTS.get(kinds[name], ONE) if child else QUATERNION
            positions, velocities = positions + counts[0], velocities + counts[1]
            pending += below.get(child or name, [])[::-1]
    for name, kind in kinds.items():
        listing.add_joint(name, COUNTS.get(kind, ONE), first=first[name])
    for name in trees:
        listing.add_free(name, name, first=first[name])
    for link in links:
        listing.add_body(link)
    for joint in joints:
        name = _text(joint, "name")
        limits = (each for each in joint.iter() if each.name == "limit")
        effort = next((_inner(each, "effort") for each in limits), "")
        if kinds[name] in DRIVEN and not (effort and float(effort) == 0):
            listing.add_actuator(name, listing.own("joint", name))
    return listing


def _inner(element: Element, name: str) -> str:
    """Return the text of an element in another one, or ""."""
    return next((each.text().strip() for each in element.elements() if each.name == name), "")


# --- USD --------------------------------------------------------------------------------------


class _Usd:
    """Reads a stage.

    Attributes:
        listing: takes what is found.
        bodies: the paths of rigid bodies, as they are written.
        joints: the prims of the joints of the tree by path, as they are written.
        loops: those of the other joints.
        ends: of each joint, by path, the bodies that it joins; "" is the world.
        below: the joints on each body, by its path.
        roots: the bodies that hold others and are held by none.
    """

    def __init__(self, robot: Robot, output: Output) -> None:
        from pxr import Sdf, Usd, UsdGeom, UsdPhysics

        layer = Sdf.Layer.CreateAnonymous(".usda")
        layer.ImportFromString(output.text)
        self.stage = Usd.Stage.Open(layer)
        names = output.names
        links = {**names.get("link", {}), **names.get("frame", {})}
        self._robot = robot
        self.listing = Listing(robot, {**names, "link": links})
        self.bodies: list[str] = []
        self.joints: dict[str, Usd.Prim] = {}
        self.loops: dict[str, Usd.Prim] = {}
        self.ends: dict[str, tuple[str, str]] = {}
        for prim in self.stage.Traverse():
            path = str(prim.GetPath())
            if prim.HasAPI(UsdPhysics.RigidBodyAPI):
                self.bodies.append(path)
            if prim.IsA(UsdGeom.Camera):
                own = self.listing.own("sensor", path)
                self.listing.sensors.append({"name": path, "yamaro": own, "values": None})
            if prim.IsA(UsdPhysics.Joint):
                joint = UsdPhysics.Joint(prim)
                is_loop = joint.GetExcludeFromArticulationAttr().Get()
                (self.loops if is_loop else self.joints)[path] = prim
                targets = (each.GetTargets() for each in (joint.GetBody0Rel(), joint.GetBody1Rel()))
                parent, child = (str(each[0]) if each else "" for each in targets)
                self.ends[path] = parent, child
        self.below: dict[str, list[str]] = {}
        for path in self.joints:
            self.below.setdefault(self.ends[path][0], []).append(path)
        held = {self.ends[path][1] for path in self.joints}
        self.roots = [
            each for each in ("", *self.bodies) if each in self.below and each not in held
        ]
        if len(self.roots) > 1:
            raise UnknownOrderError(
                "a floating joint between moving links makes several trees",
                "build each tree of links as a robot of its own",
            )

    def freedoms(self, prim: Usd.Prim) -> list[bool | None]:
        """Return of each axis of a joint of any type whether it is locked; None without limits."""
        from pxr import UsdPhysics

        found: list[bool | None] = []
        for axis in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ"):
            limit = (
                UsdPhysics.LimitAPI(prim, axis) if prim.HasAPI(UsdPhysics.LimitAPI, axis) else None
            )
            found.append(
                None if limit is None else limit.GetLowAttr().Get() > limit.GetHighAttr().Get()
            )
        return found

    def add_driven(self) -> None:
        """Add the joints that have actuators in the robot, in the order of the joints."""
        for entry in self.listing.joints:
            if entry["yamaro"] in self._robot.actuators:
                self.listing.add_actuator(str(entry["name"]), str(entry["yamaro"]))


KINDS = {
    "PhysicsFixedJoint": (0, 0),
    "PhysicsRevoluteJoint": ONE,
    "PhysicsPrismaticJoint": ONE,
    "PhysicsSphericalJoint": (4, 3),
}
"""Positions and velocities of joints in Newton, by the types of their prims."""


def in_newton(robot: Robot, output: Output) -> Listing:
    """Return what Newton finds in the USD: depth-first, the joints of a body by their paths.

    After them come free bodies, as they are written, and joints that close loops, by their paths.
    If only the world holds links, it has them as they are written, and the joints by type.
    """
    from pxr import Sdf

    usd = _Usd(robot, output)
    listing = usd.listing

    def add(path: str, prim: Usd.Prim) -> None:
        kind = prim.GetTypeName()
        count = usd.freedoms(prim).count(False)  # it counts axes that have limits
        listing.add_joint(path, KINDS.get(kind, (count, count)))

    def add_body(body: str) -> None:
        listing.add_body(body)
        seen.add(body)

    def add_free(body: str) -> None:
        listing.add_free(f"joint_{len(listing.joints) + 1}", body)

    seen: set[str] = set()
    roots = usd.roots
    lone = [path for path in usd.below.get("", ()) if usd.ends[path][1] not in usd.below]
    if lone and len(lone) < len(usd.joints):
        raise UnknownOrderError("a link that is alone is fixed in the world beside a tree of links")
    if lone:
        ranks = {kind: rank for rank, kind in enumerate(KINDS)}
        roots = []
        for path in sorted(lone, key=lambda path: ranks.get(usd.joints[path].GetTypeName(), 9)):
            add(path, usd.joints[path])
        held = {usd.ends[path][1] for path in lone}
        for body in usd.bodies:
            add_body(body)
        for body in usd.bodies:
            if body not in held:
                add_free(body)
    for root in roots:
        if root:
            add_body(root)
            add_free(root)
        pending = sorted(usd.below[root], key=Sdf.Path, reverse=True)
        while pending:
            path = pending.pop()
            child = usd.ends[path][1]
            add(path, usd.joints[path])
            add_body(child)
            pending += sorted(usd.below.get(child, ()), key=Sdf.Path, reverse=True)
    for body in usd.bodies:
        if body not in seen:
            add_body(body)
            add_free(body)
    for path in sorted(usd.loops, key=Sdf.Path):
        add(path, usd.loops[path])
    usd.add_driven()
    return listing


def in_isaac(robot: Robot, output: Output) -> Listing:
    """Return what Isaac Sim finds in the USD: breadth-first, the joints of a body as written.

    It has the joints that move alone, an axis at a time, and the place of a free base apart.
    """
    usd = _Usd(robot, output)
    listing = usd.listing
    root = next(iter(usd.roots), "")
    if not root and usd.below:
        first, *others = usd.below[""]
        if others or usd.joints[first].GetTypeName() != "PhysicsFixedJoint":
            raise UnknownOrderError(
                "PhysX has one link that is fixed in the world",
                "fix the others to that link, not to the world",
            )
        root = usd.ends[first][1]
    elif not root:
        if not usd.bodies:
            raise UnknownOrderError("no link has mass", "add the masses of links")
        root = usd.bodies[0]
    links = [root]
    joints: list[str] = []
    for link in links:
        below = usd.below.get(link, [])
        links += [usd.ends[path][1] for path in below]
        joints += below
    for link in links:
        listing.add_body(link.rpartition("/")[2], source=link)
    for path in joints:
        prim = usd.joints[path]
        kind, name = prim.GetTypeName(), path.rpartition("/")[2]
        if kind in KINDS:
            for _ in range(KINDS[kind][1]):
                listing.add_joint(name, ONE, source=path)
            continue
        free = [each for each in usd.freedoms(prim) if each is not True]
        for index in range(len(free)):
            listing.add_joint(f"{name}:{index}", ONE, source=path)
    usd.add_driven()
    return listing
