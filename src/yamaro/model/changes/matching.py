"""Which link and which joint of one robot is which of the other: by name, or renamed."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping

    from ..joint import Joint
    from ..link import Collision, Link, Visual
    from ..pose import Pose
    from ..robot import Robot
    from ..shapes import Shape


class Matching:
    """The names that links and joints have in both robots.

    Attributes:
        links, joints: by the name in the first robot, that in the second.
    """

    __slots__ = ("_first", "_second", "joints", "links")

    def __init__(self, first: Robot, second: Robot) -> None:
        """Match what has the same name, and then what was renamed."""
        self._first = first
        self._second = second
        self.links = {name: name for name in first.links if name in second.links}
        self.joints = {name: name for name in first.joints if name in second.joints}
        self._match_affixed()
        if len(self.links) < len(first.links) and len(self.links) < len(second.links):
            self._match_renamed_links()
        if len(self.joints) < len(first.joints) and len(self.joints) < len(second.joints):
            self._match_renamed_joints()

    def _match_affixed(self) -> None:
        """Match what differs in a word before or after all names, as `panda_link1` and `link1`."""
        rows = (
            (self.links, self._first.links, self._second.links),
            (self.joints, self._first.joints, self._second.joints),
        )
        times: dict[tuple[bool, bool, str], int] = {}
        for known, first, second in rows:
            taken = set(known.values())
            mine = {name for name in first if name not in known}
            others = {name for name in second if name not in taken}
            for is_first, some, rest in ((True, mine, others), (False, others, mine)):
                for name in (each for each in (first if is_first else second) if each in some):
                    for is_before, affix, stem in affixes_of(name):
                        if stem in rest:
                            key = (is_first, is_before, affix)
                            times[key] = times.get(key, 0) + 1
        if not times:
            return
        best = max(times, key=lambda key: times[key])
        if times[best] < FEWEST_AFFIXED:
            return
        is_first, is_before, affix = best
        for known, first, second in rows:
            taken = set(known.values())
            for name in first if is_first else second:
                for before, found, stem in affixes_of(name):
                    one, other = (name, stem) if is_first else (stem, name)
                    if (before, found) != (is_before, affix) or one not in first:
                        continue
                    if other in second and one not in known and other not in taken:
                        known[one] = other
                        taken.add(other)

    def _match_renamed_links(self) -> None:
        """Match links of other names: those below the same joints, the roots, and the others."""
        taken = set(self.links.values())
        for name, new in self.joints.items():
            link, other = self._first.joints[name].child, self._second.joints[new].child
            if link in self._first.links and other in self._second.links:
                if link not in self.links and other not in taken:
                    self.links[link] = other
                    taken.add(other)
        self._match_root()
        waiting = [name for name in self._first.links if name in self.links]
        while waiting:
            parent = waiting.pop()
            below = self._second.joints_below(self.links[parent])
            taken = set(self.links.values())
            mine = [
                joint for joint in self._first.joints_below(parent) if joint.child not in self.links
            ]
            others = [joint for joint in below if joint.child not in taken]
            for joint, twin in self._pairs_of(mine, others):
                self.links[joint.child] = twin.child
                waiting.append(joint.child)

    def _match_root(self) -> None:
        """Match the only root of each robot, if both have the same content or joints below."""
        roots, others = self._first.roots, self._second.roots
        if len(roots) != 1 or len(others) != 1:
            return
        (root,), (other,) = roots, others
        if root.name in self.links or other.name in self.links.values():
            return
        below = {joint.name for joint in self._first.joints_below(root.name)}
        shared = below & {joint.name for joint in self._second.joints_below(other.name)}
        if shared or link_signature(root) == link_signature(other):
            self.links[root.name] = other.name

    def _pairs_of(self, mine: list[Joint], others: list[Joint]) -> list[tuple[Joint, Joint]]:
        """Return which joints hold the same link: the surest matches first."""
        pairs: list[tuple[Joint, Joint]] = []
        for key in (self._by_content, self._by_link):
            alike: dict[object, tuple[list[Joint], list[Joint]]] = {}
            for index, row in enumerate((mine, others)):
                for joint in row:
                    alike.setdefault(key(joint, index == 0), ([], []))[index].append(joint)
            for some, theirs in alike.values():
                if key != self._by_link or len(some) == len(theirs) == 1:
                    pairs += zip(some, theirs)  # noqa: B905 - those without a partner stay
            taken = {id(joint) for pair in pairs for joint in pair}
            mine = [joint for joint in mine if id(joint) not in taken]
            others = [joint for joint in others if id(joint) not in taken]
        return pairs

    def _by_content(self, joint: Joint, is_first: bool) -> object:
        robot = self._first if is_first else self._second
        return (joint_signature(joint), link_signature(robot.links[joint.child]))

    def _by_link(self, joint: Joint, is_first: bool) -> object:
        """Return the content of the link alone; what is empty is like nothing else."""
        link = (self._first if is_first else self._second).links[joint.child]
        return id(link) if link.is_empty else link_signature(link)

    def _match_renamed_joints(self) -> None:
        """Match joints of other names that hold the same link, even one that is not there."""
        mine = _by_child(self._first.joints, self.joints)
        others = _by_child(self._second.joints, self.joints.values())
        for child, name in mine.items():
            other = others.get(self.links.get(child, child))
            if other is not None:
                self.joints[name] = other

    def renamed(self) -> dict[str, str]:
        """Return the names in the second robot that differ, with those in the first."""
        pairs = (*self.links.items(), *self.joints.items())
        return {new: old for old, new in pairs if new != old}


FEWEST_AFFIXED = 3
"""Names that have to differ in the same word before or after them to be taken for the same."""
SEPARATORS = "_-/.:"


def affixes_of(name: str) -> Iterator[tuple[bool, str, str]]:
    """Yield the words before and after a name: whether before, the words, the rest of the name."""
    for index, char in enumerate(name):
        if char in SEPARATORS and 0 < index < len(name) - 1:
            yield True, name[: index + 1], name[index + 1 :]
            yield False, name[index:], name[:index]


def _by_child(joints: Mapping[str, Joint], known: Collection[str]) -> dict[str, str]:
    """Return the name of the first joint that holds each link, of those that are not known."""
    found: dict[str, str] = {}
    known = set(known)
    for name, joint in joints.items():
        if name not in known:
            found.setdefault(joint.child, name)
    return found


# --- content without names: it only proposes what was renamed ---------------------------------


DIGITS = 9


def link_signature(link: Link) -> object:
    """Return the masses and shapes of a link."""
    inertial = link.inertial
    mass: object = None
    if inertial is not None:
        mass = (_row([inertial.mass, *inertial.inertia]), pose_signature(inertial.pose))
    return (
        mass,
        tuple(map(shape_signature, link.visuals)),
        tuple(map(shape_signature, link.collisions)),
    )


def shape_signature(body: Visual | Collision) -> object:
    """Return the shape and pose of a visual or collision."""
    return (shape_key(body.shape), pose_signature(body.pose))


def shape_key(shape: Shape | None) -> object:
    """Return the word and the sizes of a shape, and the file of a mesh."""
    if shape is None:
        return None
    return (shape.kind, _row(shape.size), getattr(shape, "filename", ""))


def joint_signature(joint: Joint) -> object:
    """Return the type, pose, axis and limits of a joint."""
    limit = joint.limit
    limits = None if limit is None else _row([limit.lower, limit.upper])
    axis = None if joint.is_fixed else _row(joint.axis)
    return (joint.type, pose_signature(joint.origin), axis, limits)


def pose_signature(pose: Pose) -> object:
    """Return a position and a rotation."""
    return (_row(pose.position), tuple(map(_row, pose.rotation)))


def _row(numbers: Iterable[float]) -> tuple[float, ...]:
    return tuple(round(number, DIGITS) + 0.0 for number in numbers)
