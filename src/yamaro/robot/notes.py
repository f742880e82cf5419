"""Notes: what a robot holds besides URDF, from the part that says it to what reads it in the end.

Sensors, actuators, states and so on are not elements of URDF. Each becomes a note, which
stands among the robot's links and joints while these are lowered, so that `attach` and `mirror`
change the names in it with all others. At the end the notes are taken out.
"""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, given_twice, unknown_word
from ..xml.tree import Comment, Element, RawBlock, RobotNote, Text
from ..xml.values import LiteralList, Numbers, format_value
from .fields import other_word, read_value, with_attributes, word_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from ..diagnostics import Diagnostic, Frame
    from ..source import Span
    from ..xml.tree import Node
    from .lowering import Lowering

LINK_WORDS = frozenset(("frame", "sensor"))
"""Keys of a link that are worked out beside it."""
JOINT_WORDS = frozenset(("actuator", "sensor"))
"""Keys of a joint that are worked out beside it."""
SURFACE = "surface"
"""A key of a collision that is worked out beside its link."""
GROUP = "robot-group"
NAMED = {
    "sensor": "sensor",
    GROUP: "group",
    "robot-loop": "loop",
    "ros2_control": "control",
    "robot-controller": "controller",
}
"""The notes that are named once in a robot, and what messages call them."""


def check_keys(word: Element, known: Collection[str], *, hint: str = "") -> None:
    """Raise YamaroError if a word has an entry that means nothing there.

    Args:
        word: the word.
        known: the names of its entries.
        hint: what to say of an entry that is like none of them; by default which there are.
    """
    found = []
    for key in word.elements():
        if key.name not in known or key.verbatim:
            found += unknown_word(
                "unknown-key",
                f"'{key.name}' is not an entry of `{word.name}`",
                key.span,
                key.name,
                known,
                hint=hint or f"its entries are {', '.join(sorted(known))}",
                trace=word.trace,
                near=other_word(key.name, known),
            ).diagnostics
    if found:
        raise YamaroError(found)


def refuse_attributes(word: Element) -> None:
    """Raise YamaroError if a word that has only entries has an attribute."""
    for attribute in word.attributes:
        raise failure(
            "unknown-key",
            f"`{word.name}` has no attribute '{attribute}'",
            word.name_span(attribute),
            hint=f"write {word.name}: {{{attribute}: …}}, or <{word.name}/…>: for an XML element",
            trace=word.trace,
        )


def names_in(key: Element) -> list[tuple[str, Span]]:
    """Return the names in a list or a text, each with a place."""
    found: list[tuple[str, Span]] = []
    for child in key.children:
        if isinstance(child, Text):
            items = child.value if isinstance(child.value, (list, tuple)) else [child.value]
            if not isinstance(child.value, LiteralList) and len(items) == 1:
                items = format_value(items[0]).replace(",", " ").split()
            found += [(format_value(item).strip(), child.span) for item in items]
    return found


def take_words(key: Element, words: frozenset[str]) -> tuple[Element, list[Element]]:
    """Return a `joint` or `link` key without the words in it, and the words."""
    found = [
        child
        for child in key.children
        if type(child) is Element and child.name in words and not child.verbatim
    ]
    if not found:
        return key, found
    rest = [child for child in key.children if not any(child is word for word in found)]
    return key.with_children(rest), found


def is_surface(node: Node) -> bool:
    """Return whether a node of a collision is its `surface`."""
    return type(node) is Element and node.name == SURFACE and not node.verbatim


def surfaces_in(
    link: Element, fits: dict[int, tuple[Element, RobotNote]]
) -> list[tuple[Element, int]]:
    """Return the surfaces in the collisions of a `link` key, each with the collision's number.

    One in a collision that is made of several pieces counts for each of them.
    """
    found: list[tuple[Element, int]] = []
    number = 0
    for child in link.children:
        if type(child) is Element and child.name == "collision":
            count = int(str(fits[id(child)][1].attributes["count"])) if id(child) in fits else 1
            if not child.verbatim:
                surfaces = [node for node in child.elements() if is_surface(node)]
                found += [(node, number + each) for node in surfaces for each in range(count)]
            number += count
    return found


def take_notes(robot: Element) -> tuple[Element, list[RobotNote]]:
    """Return a lowered robot without its notes, and these."""
    notes = [node for node in robot.children if isinstance(node, RobotNote)]
    if not notes:
        return robot, notes
    return robot.with_children([n for n in robot.children if not isinstance(n, RobotNote)]), notes


def lower_link_words(
    lowering: Lowering, words: list[Element], link: Element, out: list[Node]
) -> None:
    """Append what the words in a link make, in the order in which they are written."""
    from .extras import lower_frame, lower_link_sensor

    name = format_value(link.attributes.get("name"))
    for word in words:
        if word.name == "frame":
            lower_frame(lowering, word, name, out)
        else:
            lower_link_sensor(lowering, word, name, out, is_empty=not link.elements())


def lower_joint_words(
    lowering: Lowering, words: list[Element], joint: Element, out: list[Node]
) -> None:
    """Append what the words in a joint make, in the order in which they are written.

    Of several actuators that statements give, the last one counts.
    """
    actuators = [word for word in words if word.name == "actuator"]
    for second in actuators[1:]:
        if second.body is not actuators[0].body:
            continue
        lowering.absorb(
            given_twice(
                "a joint has one actuator, and this is another one",
                second.span,
                actuators[0].span,
                hint="remove one of the two; hardware with several commands has a list of them: "
                "command: [position, velocity]",
                trace=second.trace,
            )
        )
    for word in words:
        if word.name == "actuator":
            if word is actuators[-1]:
                from .actuator import lower_actuator

                lower_actuator(lowering, word, joint, out)
        else:
            from .extras import lower_joint_sensor

            name = format_value(joint.attributes.get("name"))
            lower_joint_sensor(lowering, word, name, out)


# --- entries ----------------------------------------------------------------------------------


TRUTHS = ("true", "false")
LIST_ITEM = "-"
"""The name of an item in a list that holds mappings or lists."""


def given_once(word: Element, known: Collection[str] | None = None) -> dict[str, Element]:
    """Return the entries of a word by name; one reached again, as by `if`, counts.

    Args:
        word: the word.
        known: the names of its entries; None if the caller looks whether they are known.

    Raises:
        YamaroError: one is unknown, or given twice in the same mapping.
    """
    word = with_entries(word)
    if known is not None:
        check_keys(word, known)
    keys: dict[str, Element] = {}
    for key in word.elements():
        if key.name in keys and keys[key.name].body is key.body:
            raise given_twice(
                f"'{key.name}' is given twice in this `{word.name}`",
                key.span,
                keys[key.name].span,
                trace=word.trace,
            )
        keys[key.name] = key
    return keys


def with_entries(word: Element) -> Element:
    """Return a word with the entries of a dict that an expression gave as if they were written.

    Raises:
        YamaroError: there is a text or a list in it.
    """
    if not any(isinstance(child, Text) for child in word.children):
        return word
    kept: list[Node] = [child for child in word.children if not isinstance(child, Comment)]
    example = EXAMPLES.get(word.name, "name: value")
    entries = entries_of(word.with_children(kept), f"{word.name}: {{{example}}}")
    return word.with_children([*entries])


EXAMPLES = {
    "actuator": "command: position, kp: 50",
    "surface": "friction: 0.8",
    "sensor": "type: imu",
}
"""Entries of words, for hints."""


def entries_of(owner: Element, example: str) -> list[Element]:
    """Return the entries of a mapping, a list of mappings, or of a dict that an expression gave.

    Raises:
        YamaroError: it is a text or a list of texts.
    """
    return _entries_in(owner, owner, example)


def _entries_in(body: Element, owner: Element, example: str) -> list[Element]:
    found: list[Element] = []
    for child in body.children:
        if isinstance(child, Text) and isinstance(child.value, dict):
            found += [_entry(name, value, child) for name, value in child.value.items()]
        elif isinstance(child, Text) and isinstance(child.value, list) and not child.value:
            continue
        elif not isinstance(child, Element):
            raise failure(
                "not-a-body",
                f"'{owner.name}' holds entries such as `name: value`",
                child.span,
                hint=f"write {example}",
                trace=owner.trace,
            )
        elif child.name == LIST_ITEM:
            found += _entries_in(child, owner, example)
        else:
            found.append(child)
    return found


def _entry(name: object, value: object, dictionary: Text) -> Element:
    """Return an entry of a dict as if it was written."""
    children: list[Node] = [] if value is None else [Text(value, dictionary.span)]
    return Element(format_value(name), dictionary.span, {}, children)


def text_of(key: Element | None) -> str:
    """Return the text of an entry, "" without one."""
    return "" if key is None else key.text().strip()


def place_of(key: Element) -> Span:
    """Return where the text of an entry is, or the entry if there is none."""
    return next((child.span for child in key.children if isinstance(child, Text)), key.span)


def one_of(key: Element, choices: Sequence[str]) -> str:
    """Return the one of some words that an entry says.

    Raises:
        YamaroError: it says something else.
    """
    value, span = read_value(key)
    return chosen(word_of(key.name, value, span, owner=key), span, key, choices)


def chosen(word: str, span: Span, key: Element, choices: Sequence[str]) -> str:
    """Return a word that an entry says.

    Raises:
        YamaroError: it is not one of the choices.
    """
    if word in choices:
        return word
    raise unknown_word(
        "bad-choice",
        f"'{key.name}' is one of {', '.join(choices)}, and '{word}' is none of them",
        span,
        word,
        choices,
        hint=f"write {key.name}: {choices[0]}",
        trace=key.trace,
        near=other_word(word, choices),
    )


# --- values that URDF does not have -------------------------------------------------------------


ARMATURE = "armature"
"""The value of `dynamics` that URDF has no attribute for."""


def take_armatures(robot: Element, notes: Sequence[Element]) -> tuple[Element, Sequence[Element]]:
    """Return a robot without the armatures in `dynamics`, and its notes with them.

    That of a joint with an actuator becomes the actuator's; for any other joint there is a note,
    which is the whole `dynamics` with its `joint`. An attribute of XML, a text, is left alone.

    Raises:
        YamaroError: armatures are negative, or given twice.
    """
    drives = {each.attributes["joint"]: each for each in notes if each.name == "actuator"}
    found: list[Element] = []
    faults: list[Diagnostic] = []
    children: list[Node] = []
    for joint in robot.children:
        if isinstance(joint, Element) and joint.name == "joint":
            for index, whole in enumerate(joint.children):
                value = whole.attributes.get(ARMATURE) if isinstance(whole, Element) else None
                if not isinstance(whole, Element) or not isinstance(value, Numbers):
                    continue
                name = format_value(joint.attributes.get("name"))
                trace = whole.trace_within(joint.trace_within(None))
                left = {own: each for own, each in whole.attributes.items() if own != ARMATURE}
                inner = [*joint.children]
                inner[index : index + 1] = [with_attributes(whole, left)] if left else []
                joint = joint.with_children(inner)
                drive = drives.get(name)
                faults += _faults_of(whole, value, drive, trace)
                if not value.values[0]:
                    continue
                if drive is None:
                    spans = {own: whole.value_span(own) for own in whole.attributes}
                    values = {"joint": name, **whole.attributes}
                    found.append(RobotNote(whole.name, whole.span, values, [], trace, spans))
                else:
                    spans = {own: drive.value_span(own) for own in drive.attributes}
                    drives[name] = with_attributes(drive, {**drive.attributes, ARMATURE: value})
                    drives[name].value_spans = {**spans, ARMATURE: whole.value_span(ARMATURE)}
        children.append(joint)
    if faults:
        raise YamaroError(faults)
    rest = (drives[e.attributes["joint"]] if e.name == "actuator" else e for e in notes)
    return robot.with_children(children), [*rest, *found]


def armature_of(joint: Element) -> Numbers | None:
    """Return the armature in the `dynamics` of a joint, or None."""
    values = [each.attributes.get(ARMATURE) for each in joint.elements()]
    return next((each for each in values if isinstance(each, Numbers)), None)


def _faults_of(
    dynamics: Element, armature: Numbers, drive: Element | None, trace: Frame | None
) -> list[Diagnostic]:
    """Return what is wrong with an armature in the `dynamics` of a joint."""
    span = dynamics.value_span(ARMATURE)
    if armature.values[0] < 0:
        return failure(
            "bad-number",
            f"'{ARMATURE}' takes a number from 0, and this is {format_value(armature)}",
            span,
            hint=f"write {ARMATURE}: 0.01",
            trace=trace,
        ).diagnostics
    if drive is not None and armature.values[0] and ARMATURE in drive.attributes:
        return given_twice(
            "the armature is given twice: by the actuator of the joint, and by its 'dynamics'",
            span,
            drive.value_span(ARMATURE),
            trace=trace,
        ).diagnostics
    return []


# --- the XML for one output format ------------------------------------------------------------


RAW = "raw-block"


def take_raw_blocks(robot: Element) -> tuple[Element, list[Element]]:
    """Return a robot without the blocks for one format, and a note for each of them.

    A note has the `format`, and the `link` or `joint` that the block is in; what it holds is XML of
    the format. A block in a visual or collision is one of its link, with the element of that name,
    which is made up if there is none.
    """
    notes: list[Element] = []
    children: list[Node] = []
    for child in robot.children:
        if isinstance(child, RawBlock):
            notes.append(_note(child, {}, None))
        elif isinstance(child, Element) and child.name in ("link", "joint"):
            children.append(_without_blocks(child, notes))
        else:
            children.append(child)
    return robot.with_children(children), notes


def _without_blocks(owner: Element, notes: list[Element]) -> Element:
    """Return a link or joint without its blocks, of which notes are made."""
    home = {owner.name: format_value(owner.attributes.get("name"))}
    trace = owner.trace_within(None)
    children: list[Node] = []
    indices = {"visual": -1, "collision": -1}
    for child in owner.children:
        if isinstance(child, RawBlock):
            notes.append(_note(child, home, trace))
            continue
        if isinstance(child, Element) and child.name in indices:
            indices[child.name] += 1
            blocks = [each for each in child.children if isinstance(each, RawBlock)]
            if blocks:
                if not format_value(child.attributes.get("name")).strip():
                    child = _named(child, owner, indices[child.name])
                for name in dict.fromkeys(block.name for block in blocks):
                    own = [block for block in blocks if block.name == name]
                    inner = [each for block in own for each in block.children]
                    whole = own[0].with_children(inner)
                    notes.append(_note(_of_section(child, whole), home, trace))
                rest = [each for each in child.children if not isinstance(each, RawBlock)]
                child = child.with_children(rest)
        children.append(child)
    return owner if children == owner.children else owner.with_children(children)


def _named(section: Element, link: Element, index: int) -> Element:
    """Return a visual or collision of a link with a name, by which a block can be about it."""
    from ..model.values import shape_name

    taken = {format_value(each.attributes.get("name")).strip() for each in link.elements()}
    name = shape_name(format_value(link.attributes.get("name")), section.name, index, taken)
    copy = section.with_children(section.children)
    copy.attributes = {"name": name, **{k: v for k, v in section.attributes.items() if k != "name"}}
    return copy


def _of_section(section: Element, block: Element) -> RawBlock:
    """Return a block in a visual or collision as one of the link, which names the section.

    MJCF, whose elements hold no text, has an entry with a text as an attribute of the geom.
    """
    name = format_value(section.attributes.get("name")).strip()
    attributes: dict[str, object] = {"name": name}
    spans = {"name": section.value_span("name")}
    children: list[Node] = []
    for child in block.children:
        is_text = isinstance(child, Element) and not child.elements() and not child.attributes
        if block.name == "mjcf" and isinstance(child, Element) and is_text and child.children:
            attributes[child.name] = child.text().strip()
            spans[child.name] = place_of(child)
        else:
            children.append(child)
    tag = "geom" if block.name == "mjcf" else section.name
    inner = Element(tag, block.span, attributes, children, block.trace, spans)
    return RawBlock(block.name, block.span, children=[inner], trace=block.trace)


def _note(block: RawBlock, home: dict[str, str], trace: Frame | None) -> RobotNote:
    own = block.trace_within(trace)
    return RobotNote(
        RAW, block.span, {"format": block.name, **home}, children=block.children, trace=own
    )
