"""Lowers `attach`: another robot, joined to a link of this one, with a prefix before its names."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..xml.robot_names import RobotNames
from ..xml.tree import OF_ATTACHED, Element, IncludedRobot, RawBlock, RobotNote, Text
from .fields import POSE_KEYS, POSE_ROWS
from .joint import lower_joint
from .lowering import names_of
from .mirror import copy_of
from .notes import check_keys, place_of, text_of
from .rigid import RigidLinks, child_links, name_of, pose_of, set_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node, RobotWord
    from .lowering import Lowering

KEYS = ("path", "body", "to", "at", *POSE_ROWS, "prefix", "joint", "arguments")
OF_STAND = {
    "sdf": frozenset(("pose", "static")),
    "mjcf": frozenset(("pos", "quat", "freejoint")),
}
"""What blocks say, by their formats, of where a robot stands, which an attached one does not."""
_OWN_JOINT_KEYS = POSE_KEYS | {"parent", "child", "name"}


def lower_attach(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append the joint that an attached robot is mounted with, and the robot itself."""
    keys = {key.name: key for key in word.elements()}
    try:
        check_keys(word, KEYS, hint="what is passed to a file needs a `path`")
        if "to" not in keys:
            raise failure(
                "missing-key",
                "`attach` needs an entry `to`",
                word.span,
                hint="write to: tool0, the link, part or frame that carries the robot",
                trace=word.trace,
            )
    except YamaroError as error:
        lowering.absorb(error)
        return
    errors = len(lowering.errors)
    from .part import finish_words, lower_nodes, resolve_names

    body = keys["body"]
    outside = lowering.begin_robot()  # parts of both may have the same names: each means its own
    robot = Element("robot", body.span, children=lower_nodes(lowering, body.children))
    resolve_names(lowering, robot)
    finish_words(lowering, robot)
    links, joints = lowering.end_robot(outside)
    if len(lowering.errors) > errors:
        return
    prefix = text_of(keys.get("prefix"))
    try:
        root = _only_root(word, robot)
        mount = _mount(lowering, word, keys, prefix, root)
        _place_at(mount, keys.get("at"), robot, links, root)
    except YamaroError as error:
        lowering.absorb(error)
        return
    for name, link in links.items():
        lowering.part_links.setdefault(prefix + name, prefix + link)
    for name, joint in joints.items():
        lowering.part_joints.setdefault(prefix + name, prefix + joint)
    out.append(mount)
    out += _with_prefix(lowering, robot, prefix)


# --- the attached robot -----------------------------------------------------------------------


def _only_root(word: RobotWord, robot: Element) -> str:
    """Return the link of a robot that has no parent.

    Raises:
        YamaroError: there is none, or there are several.
    """
    elements = robot.elements()
    children = child_links(elements)
    roots = [name_of(link) for link in elements if link.name == "link"]
    roots = [name for name in roots if name not in children]
    if len(roots) == 1:
        return roots[0]
    listed = ", ".join(f"'{name}'" for name in roots[:4])
    raise failure(
        "attach-roots",
        f"the attached robot has {len(roots)} roots: {listed}"
        if roots
        else "the attached robot has no root link",
        word.span,
        hint="an attached robot has one link without a parent; join the others to it"
        if roots
        else "give it at least one link that is not the child of a joint",
        trace=word.trace,
    )


def _with_prefix(lowering: Lowering, robot: Element, prefix: str) -> list[Node]:
    """Return the attached robot with a prefix before the names that it defines."""
    own = IncludedRobot(prefix)
    names = RobotNames(robot.elements())
    nodes: list[Node] = []
    for node in robot.children:
        if not isinstance(node, Element):
            nodes.append(node)
            continue
        standing = _without_stand(node) if isinstance(node, RawBlock) else node
        if standing is None:
            continue
        copy = copy_of(lowering.outermost(standing))
        if isinstance(copy, RawBlock):
            for each in copy.elements():
                each.body = each.body or OF_ATTACHED
        if copy.name == "link" and any(isinstance(each, RawBlock) for each in copy.children):
            kept = (_without_stand(e) if isinstance(e, RawBlock) else e for e in copy.children)
            copy.children = [each for each in kept if each is not None]
        has_own = isinstance(copy.body, IncludedRobot) and copy.body.prefix
        copy.body = copy.body.within(prefix) if has_own else own  # type: ignore[attr-defined]
        nodes.append(copy)
    if prefix:
        copies = [node for node in nodes if isinstance(node, Element)]
        names.rename(copies, lambda name: prefix + name)
        for copy in copies:
            if isinstance(copy, RobotNote) and copy.name == "ros2_control":
                copy.attributes.setdefault("name", f"{prefix}system")
    return nodes


def _without_stand(block: RawBlock) -> RawBlock | None:
    """Return a block without what it says of where the robot stands; None if nothing is left."""
    names = OF_STAND.get(block.name, ())
    rest = [
        node for node in block.children if not isinstance(node, Element) or node.name not in names
    ]
    return block.with_children(rest) if rest else None  # type: ignore[return-value]


# --- the mount --------------------------------------------------------------------------------


def _mount(
    lowering: Lowering, word: RobotWord, keys: dict[str, Element], prefix: str, root: str
) -> Element:
    """Return the joint between the two robots."""
    given = keys.get("joint")
    key = Element("joint", word.span if given is None else given.span, trace=word.trace)
    key.children = [] if given is None else list(given.children)
    for child in key.elements():
        if child.name in _OWN_JOINT_KEYS:
            raise failure(
                "misplaced-key",
                f"'{child.name}' of the mount does not belong in 'joint'",
                child.span,
                hint="write xyz, rpy and pivot directly in `attach`; `to` is the parent, and the "
                "joint is named after the attached root",
                trace=word.trace,
            )
    if not any(child.name == "type" for child in key.elements()):
        key.children.insert(0, Element("type", word.span, children=[Text("fixed", word.span)]))
    parent = Element("parent", keys["to"].span, children=keys["to"].children, trace=word.trace)
    key.children.append(parent)
    key.children += [keys[name] for name in POSE_ROWS if name in keys]
    name = f"{prefix}{root}_mount"
    mount = lower_joint(lowering, key, name, child=prefix + root)
    mount.body = IncludedRobot(prefix)
    return mount


def _place_at(
    mount: Element, at: Element | None, robot: Element, parts: dict[str, str], root: str
) -> None:
    """Put the link that `at` names, in place of the root, where the mount leads.

    T_to_root = T_to_at · T_root_at⁻¹.
    """
    if at is None:
        return
    name = text_of(at)
    links = names_of(robot, "link")
    link = name if name in links else parts.get(name)
    if link is None:
        from ..diagnostics import meant

        hint, fix = meant(name, (*links, *parts), place_of(at))
        raise failure(
            "unknown-link",
            f"'at' names '{name}', and the attached robot has no such link, part or frame",
            place_of(at),
            hint=hint or f"its root is '{root}', the default",
            trace=at.trace,
            fix=fix,
        )
    if link == root:
        return
    top, T_root_at = RigidLinks(robot.elements()).top_of(link)
    moves = mount.attributes.get("type") != "fixed"
    if top != root or moves:
        raise failure(
            "attach-moving",
            f"'at' names '{name}', which moves against the root '{root}'"
            if top != root
            else f"the mount moves, and 'at' names '{name}' in place of the root '{root}'",
            place_of(at),
            hint="name a link or frame that is rigidly joined to the root"
            if top != root
            else "leave 'at' out, or make the mount a fixed joint",
            trace=at.trace,
        )
    set_pose(mount, pose_of(mount) @ T_root_at.inverse())
