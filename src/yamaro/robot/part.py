"""Lowering: the evaluated tree with its parts becomes a tree of plain URDF.

Every part becomes a joint and a link, and what else it holds follows beside them. Names of parts
that joints refer to are resolved at the end, over the whole tree.
"""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, settle
from ..xml.tree import Element, PartElement, RobotNote, RobotWord, unshared
from ..xml.values import format_value
from .fields import (
    PART,
    Fields,
    check_plain,
    read_value,
    refuse_part,
    sort_fields,
    word_of,
)
from .formed import lower_formed, take_over
from .joint import lower_joint
from .link import lower_link
from .lowering import Lowering, names_of, refer
from .notes import (
    JOINT_WORDS,
    LINK_WORDS,
    lower_joint_words,
    lower_link_words,
    surfaces_in,
    take_armatures,
    take_notes,
    take_words,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..diagnostics import Frame, Reporter
    from ..source import Span
    from ..xml.tree import Node
    from .lowering import Fitter, PackageFault

CAPSULE_VERSION = (1, 1)
ROOT_LINK = "root_link"
UNNAMED = "?"
"""Replaces a name that is missing, which is an error, so that it is never written."""


def lower(
    root: Element,
    *,
    reporter: Reporter,
    resolve_mesh: Callable[[str, Span], str | None],
    may_read: Callable[[str], bool] | None = None,
    package_fault: PackageFault | None = None,
    fitter: Fitter | None = None,
    overlays: Sequence[Element] = (),
    wants_advice: Callable[[str], bool] | None = None,
    has_parts: bool = True,
) -> tuple[Element, Sequence[Element]]:
    """Return the tree with every part replaced by its joint, its link and what is beside them.

    With it come the notes: what the robot has that is not an element of URDF; see `notes.py`.

    Elements without a part inside are shared with the input, which is not changed.

    Args:
        root: the evaluated tree.
        reporter: takes the warnings.
        resolve_mesh: gives the absolute path of a mesh file named at a span, or None if there is
            none; asked only when inertia is computed from the mesh.
        may_read: decides whether a file may be read that a mesh names; None allows all.
        package_fault: gives, for a package that is not found, how to get it and where it was
            looked for.
        fitter: takes the meshes that are made, and keeps what is worked out from meshes.
        overlays: what changes values of the robot, in this order.
        wants_advice: decides which advice to report; None for none.
        has_parts: whether there may be parts.

    Raises:
        YamaroError: holds every error found.
    """
    places = _places_of_parts(root) if has_parts else {}
    has_notes = any(isinstance(child, RobotNote) for child in root.children)
    if not places and not has_notes and not overlays:
        return root, ()
    if root.name != "robot":
        if overlays:
            raise failure(
                "overlay-without-robot",
                f"an overlay changes a robot, but the root element is <{root.name}>",
                overlays[0].span,
                hint="leave the overlay out, or give it to the file of the robot",
            )
        if not places:
            return take_notes(root)
        first = next(iter(places.values()))
        raise failure(
            "part-outside-robot",
            f"'part' creates links and joints of a robot, but the root element is <{root.name}>",
            first.span,
            hint="write robot: as the root, or <part>: for an XML element of that name",
            trace=_trace_of_part(root, first, places),
        )
    lowering = lowering_of(
        root,
        reporter,
        resolve_mesh,
        may_read=may_read,
        fitter=fitter,
        package_fault=package_fault,
    )
    robot = _rebuilt(lowering, root, places, is_root=True)
    if lowering.fits and lowering.fitter.on_work is not None:
        lowering.fitter.on_work(1.0)
    settle(reporter.diagnostics, None)
    settle(lowering.errors, None)
    if lowering.errors:
        raise YamaroError(lowering.errors)
    resolve_names(lowering, robot)
    if not lowering.has_words and not has_notes and not overlays:
        return take_armatures(robot, ()) if lowering.has_armatures else (robot, ())
    from .finish import finish_notes

    finish_words(lowering, robot, overlays)
    robot, notes = finish_notes(lowering, robot)
    for advice in lowering.advice:
        if wants_advice is not None and wants_advice(advice.code):
            reporter.add(advice)
    settle(reporter.diagnostics, None)
    settle(lowering.errors, None)
    if lowering.errors:
        raise YamaroError(lowering.errors)
    return take_armatures(robot, notes) if lowering.has_armatures else (robot, notes)


def finish_words(lowering: Lowering, robot: Element, overlays: Sequence[Element] = ()) -> None:
    """Work out what needs the whole robot, with the names in it resolved.

    Overlays come after the images of mirrors, which are robots of their own, and before what
    depends on values: those of included files, then those of the whole.
    """
    if lowering.pending:
        from .mirror import make_images

        make_images(lowering, robot)
    if lowering.overlays or overlays:
        from .overlay import Overlaid, overlay_part

        for word in lowering.overlays:
            overlay_part(lowering, robot, word)
        for overlay in overlays:
            Overlaid(lowering, robot).change(overlay)
    if lowering.controls:
        from .control import choose_members

        choose_members(lowering, robot.elements(), lowering.controls)


def _places_of_parts(root: Element) -> dict[int, Element]:
    """Return the elements that hold a part, however deep, by identity, with the first part.

    A part's own body is not searched. Every element is looked at once, however often it is shared,
    and what is empty not at all.
    """
    holders: dict[int, Element] = {}
    seen: set[int] = set()
    stack: list[tuple[Element, bool]] = [(root, False)]
    while stack:
        element, is_done = stack.pop()
        if is_done:
            for child in element.children:
                part = child if isinstance(child, PartElement) else holders.get(id(child))
                if part is not None:
                    holders[id(element)] = part
                    break
            continue
        if id(element) in seen:
            continue
        seen.add(id(element))
        children = element.children
        stack.append((element, True))
        stack += [(c, False) for c in reversed(children) if type(c) is Element and c.children]
    return holders


def _trace_of_part(root: Element, part: Element, holders: dict[int, Element]) -> Frame | None:
    """Return what led to the part that `holders` gives for the root."""
    if not part.inherits_trace():
        return part.trace
    for child in root.elements():
        if child is part or holders.get(id(child)) is part:
            return child.trace_within(None)
    raise AssertionError("the part is in none of the children")


def lowering_of(
    root: Element,
    reporter: Reporter,
    resolve_mesh: Callable[[str, Span], str | None],
    *,
    may_read: Callable[[str], bool] | None,
    fitter: Fitter | None,
    package_fault: PackageFault | None,
) -> Lowering:
    """Return a run for a robot; for the arguments see `lower`."""
    return Lowering(
        reporter,
        resolve_mesh,
        may_read=may_read,
        has_capsule=_has_capsule(root),
        fitter=fitter,
        root=root,
        package_fault=package_fault,
    )


def _has_capsule(root: Element) -> bool:
    """Return whether the root says that it is URDF 1.1 or newer."""
    major, _, minor = format_value(root.attributes.get("version")).strip().partition(".")
    if not (major.isdecimal() and minor.isdecimal()):
        return False
    return (int(major), int(minor)) >= CAPSULE_VERSION


def _rebuilt(
    lowering: Lowering, element: Element, holders: dict[int, Element], *, is_root: bool = False
) -> Element:
    """Return a copy of an element that holds parts, with the parts lowered."""
    for child in element.children:
        if type(child) is RobotWord and child.name == "naming":
            from .naming import note_naming

            note_naming(lowering, child)
    children: list[Node] = []
    for child in element.children:
        if isinstance(child, PartElement):
            if element.name != "robot":
                lowering.report(
                    "misplaced-part",
                    f"this part is inside <{element.name}>, where URDF parsers do not look for "
                    "links and joints",
                    child.span,
                    hint="move it directly under 'model'",
                    trace=child.trace,
                )
            part = child
            if not is_root:  # its joint and link will inherit from what it is in
                copy = unshared(child, lowering.trace)
                assert isinstance(copy, PartElement)
                part = copy
            _lower_part(lowering, part, children)
        elif isinstance(child, Element) and id(child) in holders:
            entered = lowering.enter(child) if is_root else None
            if child.name in ("joint", "link"):
                refuse_part(lowering, holders[id(child)], child.name)
            else:
                children.append(_rebuilt(lowering, child, holders))
            if entered is not None:
                lowering.leave(entered)
        else:
            children.append(child)
    return element.with_children(children)


def lower_nodes(lowering: Lowering, nodes: list[Node]) -> list[Node]:
    """Return nodes that stand where parts may, with the parts lowered."""
    holder = Element("robot", nodes[0].span, children=nodes) if nodes else None
    if holder is None:
        return []
    made = _rebuilt(lowering, holder, _places_of_parts(holder), is_root=True).children
    return [lowering.outermost(node) if isinstance(node, Element) else node for node in made]


# --- one part ---------------------------------------------------------------------------------


class PartNames:
    """The names of a part's joint and link, and the part's own, when it has one."""

    __slots__ = ("joint", "link", "part")

    def __init__(self, part: str | None, joint: str, link: str) -> None:
        self.part = part
        self.joint = joint
        self.link = link


def _lower_part(lowering: Lowering, part: PartElement, out: list[Node]) -> None:
    """Append the joint and link of a part, in the order written, and then what is beside."""
    if part.form is not None and take_over(lowering, part, out):
        return
    entered = lowering.enter(part)
    if type(part) is RobotWord:
        lowering.has_words = True

        lower_word(lowering, part, out)
    elif part.form is not None:
        lower_formed(lowering, part, out, _lower_each)
    else:
        _lower_each(lowering, part, out)
    lowering.leave(entered)


def lower_word(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append what a word makes beside parts; record what is wrong, and go on."""
    match word.name:
        case "mirror":
            from .mirror import lower_mirror as lower
        case "attach":
            from .attach import lower_attach as lower
        case "control":
            from .control import lower_control as lower
        case "controllers":
            from .controllers import lower_controllers as lower
        case "naming":
            from .naming import lower_naming as lower
        case "overlay":
            lowering.overlays.append(word)
            return
        case _:
            from .sections import lower_section as lower
    lower(lowering, word, out)


def _lower_each(lowering: Lowering, part: Element, out: list[Node]) -> None:
    fields = sort_fields(lowering, part, PART)
    names = _read_names(lowering, part, fields)
    if names.part is not None:
        lowering.part_links.setdefault(names.part, names.link)
        if "joint" in fields.keys:
            lowering.part_joints.setdefault(names.part, names.joint)
    beside: list[Node] = []
    pending: list[Node] = []
    for node in fields.rest:
        if not isinstance(node, Element):
            pending.append(node)
            continue
        is_own = type(node) is Element and node.name in ("joint", "link") and not node.verbatim
        if pending:
            (out if is_own else beside).extend(pending)
            pending.clear()
        if not is_own:
            _lower_beside(lowering, node, beside)
        elif node.name == "joint":
            joint, words = take_words(node, JOINT_WORDS)
            lowered = lower_joint(lowering, joint, names.joint, child=names.link, words=words)
            out.append(lowered)
            if words:
                lowering.has_words = True
                lower_joint_words(lowering, words, lowered, beside)
        else:
            link, words = take_words(node, LINK_WORDS)
            lowered = lower_link(lowering, link, names.link)
            out.append(lowered)
            if words:
                lowering.has_words = True
                lower_link_words(lowering, words, lowered, beside)
            if lowering.fits:
                from .fits import note_fits

                note_fits(lowering, link, names.link, beside)
            surfaces = surfaces_in(link, lowering.fits)
            if surfaces:
                lowering.has_words = True
                from .extras import lower_surfaces

                lower_surfaces(lowering, surfaces, names.link, beside)
    if "link" not in fields.keys:
        span = fields.keys.get("name", part).span
        out.append(Element("link", span, attributes={"name": names.link}, trace=lowering.trace))
    out += beside
    out += pending


def _lower_beside(lowering: Lowering, node: Element, out: list[Node]) -> None:
    """Append what is beside a part's joint and link: an element, a material, or a part."""
    if isinstance(node, PartElement):
        _lower_part(lowering, node, out)
        return
    if node.name == "material" and not node.verbatim:
        from .material import lower_material

        try:
            out.append(lowering.outermost(lowering.once(node, lower_material)))
        except YamaroError as error:
            lowering.absorb(error)
        return
    check_plain(lowering, node, None)
    holders = _places_of_parts(node)
    if not holders:
        out.append(lowering.outermost(node))
    elif node.name in ("joint", "link"):
        refuse_part(lowering, holders[id(node)], node.name)
    else:
        out.append(lowering.outermost(_rebuilt(lowering, node, holders)))


def _read_names(lowering: Lowering, part: Element, fields: Fields) -> PartNames:
    """Return the names of a part; where they are faulty, record it and go on with stand-ins."""
    key = fields.keys.get("name")
    joint, link = fields.keys.get("joint"), fields.keys.get("link")
    try:
        own_joint, own_link = _own_name(joint), _own_name(link)
        names = _derived_names(lowering, part, _read_words(key)) if key is not None else None
    except YamaroError as error:
        lowering.absorb(error)
        return PartNames(None, UNNAMED, UNNAMED)
    if names is None and (own_link is None or (joint is not None and own_joint is None)):
        lowering.absorb(
            failure(
                "missing-name",
                "this part has no name",
                part.span,
                hint="write name: wheel, which creates 'wheel_joint' and 'wheel_link'",
                trace=part.trace,
            )
        )
    if names is None:
        names = PartNames(None, UNNAMED, UNNAMED)
    names.joint = own_joint or names.joint
    names.link = own_link or names.link
    return names


def _own_name(key: Element | None) -> str | None:
    """Return the name that a joint or link gives itself: `link/name=…`."""
    if key is None or key.attributes.get("name") is None:
        return None
    return word_of("name", key.attributes["name"], key.value_span("name"), owner=key)


def _read_words(key: Element) -> list[str]:
    """Return the one or two words of a part's name."""
    value, span = read_value(key)
    items = value if isinstance(value, list) else (value,)
    text = value if type(value) is str else " ".join(map(format_value, items))
    words = text.replace(",", " ").split()
    if not words:
        raise failure(
            "missing-name",
            "the name of this part is empty",
            key.span,
            hint="write name: wheel",
            trace=key.trace,
        )
    if len(words) > 2:
        raise failure(
            "wrong-count",
            f"'name' takes one or two words, but {len(words)} are given",
            span,
            hint=f"write {'_'.join(words)} for one name; two words name the joint and the link",
            trace=key.trace,
        )
    return words


def _derived_names(lowering: Lowering, part: Element, words: list[str]) -> PartNames:
    if len(words) == 2:
        return PartNames(None, words[0], words[1])
    naming = lowering.namings.get(part.span.source)
    if naming is not None:
        return PartNames(words[0], naming.joint(words[0]), naming.link(words[0]))
    return PartNames(words[0], f"{words[0]}_joint", f"{words[0]}_link")


# --- names resolved at the end ----------------------------------------------------------------


def resolve_names(lowering: Lowering, robot: Element) -> None:
    """Replace names of parts by those of their links and joints, and add `root_link`."""
    links = names_of(robot, "link")
    part_links = lowering.part_links
    root_link: Element | None = None
    trace: Frame | None = None
    for joint in lowering.parents:
        parent = joint.children[0]
        assert isinstance(parent, Element)
        name = parent.attributes["link"]
        assert isinstance(name, str)
        link_name = part_links.get(name)
        if name in links:
            if link_name is not None and link_name != name:
                _warn_if_ambiguous(lowering, robot, joint, parent, name, link_name)
        elif link_name is not None:
            refer(joint, parent, "link", link_name)
        elif name == ROOT_LINK and root_link is None:
            root_link, trace = parent, joint.trace
    joints = names_of(robot, "joint") if lowering.mimics else set()
    for joint in lowering.mimics:
        mimic = _mimic_of(joint)
        name = str(mimic.attributes["joint"])
        if name not in joints and name in lowering.part_joints:
            refer(joint, mimic, "joint", lowering.part_joints[name])
    for note, attribute in lowering.references:
        name = str(note.attributes[attribute])
        is_joint = attribute == "joint"
        there = names_of(robot, "joint") if is_joint else links
        parts = lowering.part_joints if is_joint else part_links
        if name not in there and name in parts:
            note.attributes[attribute] = parts[name]
    lowering.references.clear()
    if root_link is not None:
        link = Element(
            "link",
            root_link.value_span("link"),
            attributes={"name": ROOT_LINK},
            trace=trace,
        )
        robot.children.insert(0, link)


def _warn_if_ambiguous(
    lowering: Lowering, robot: Element, joint: Element, parent: Element, name: str, link_name: str
) -> None:
    """Warn of a parent that is a link, and the name of another part of the same file as well."""
    source = parent.span.source
    child = joint.children[1]
    if isinstance(child, Element) and child.attributes.get("link") == link_name:
        return
    for link in robot.elements():
        if link.name == "link" and link.attributes.get("name") == link_name:
            if link.span.source is source:
                lowering.report(
                    "ambiguous-parent",
                    f"'{name}' is a link, which is the parent, and also a part, whose link is "
                    f"'{link_name}'",
                    parent.value_span("link"),
                    hint=f"write {link_name} if the part is meant, or rename one of the two",
                    trace=joint.trace,
                )
            return


def _mimic_of(joint: Element) -> Element:
    """Return the `<mimic>` that was made for a joint."""
    for child in joint.children:
        if isinstance(child, Element) and child.name == "mimic" and not child.verbatim:
            return child
    raise AssertionError("the joint has none")
