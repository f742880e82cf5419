"""Notes and blocks of a robot as words of the language: `sensor`, `actuator`, `states`, `mjcf`.

Those of a joint, a link, a collision or a frame are entries of it; the others are sections of the
file and statements of the model. What a block says of a geom is written at the shape of its name,
unless the order of the geoms would be another one then.
"""

from __future__ import annotations

from ...model.compare import ZEROS, same_words
from ...model.extras import CAMERAS
from ...model.schema import ACTUATOR, OF_MOTOR, SENSOR, SENSORS, SURFACE
from ...model.values import shape_name, values_of
from ...robot.extras import OPTICAL
from ...xml.tree import Element
from ...xml.values import format_value
from .document import RECORD_WIDTH, Body, Entry, Flow
from .elements import child_of, has_text, is_short, name_of
from .formulas import TURNING
from .parts import is_frame
from .writing import scalar_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from ...xml.tree import Node
    from .elements import ElementWriter
    from .formulas import Degrees
    from .parts import ShortNames

    Home = tuple[str, str]

ROBOT = ("", "")
"""The home of blocks of the robot as a whole."""
MJCF, SDF = "mjcf", "sdf"
COUNTED = {"actuator": "actuator", "sensor": "sensor", "state": "state", "robot-loop": "loop"}
"""The notes that a report counts, and what it calls them."""
COMPUTED = {"rotor_inertia": ("armature",), "frequency": ("kp", "kd")}
"""Values of an actuator that follow from others."""
SHAPES = ("visual", "collision")
MILLISECONDS = 0.1
"""Times below this many seconds are written in milliseconds."""


def frames_of_sites(root: Element, notes: Iterable[Element]) -> dict[tuple[str, str], str]:
    """Return the frame that each site is, by the link that it is on and its name in MJCF."""
    names = {
        values_of(note)["link"]: each.text().strip()
        for note in notes
        if note.name == "raw-block" and home_of(note)[0] == "link"
        for each in note.elements()
        if each.name == "name" and is_setting(each)
    }
    bodies = {name_of(each) for each in root.elements() if each.name == "link" and each.elements()}
    found = {}
    for joint in root.elements():
        parent = child_of_frame(joint) if joint.name == "joint" else None
        frame = child_of(joint)
        if parent is not None and frame is not None and frame not in bodies:
            found[parent, names.get(frame, frame)] = frame
    return found


def actuators_in_order(notes: Iterable[Element]) -> list[str]:
    """Return the joints with actuators, in the order of a block that says it, or of the notes."""
    notes = list(notes)
    joints = [values_of(each)["joint"] for each in notes if each.name == "actuator"]
    said = [
        values_of(each).get("joint", "")
        for note in notes
        if note.name == "raw-block" and home_of(note) == ROBOT
        for section in note.elements()
        if section.name == "actuator"
        for each in section.elements()
    ]
    first = [joint for joint in dict.fromkeys(said) if joint in joints]
    return [*first, *(joint for joint in joints if joint not in first)]


def home_of(note: Element) -> Home:
    """Return whether a note belongs to a link or a joint, and its name; ROBOT if to neither."""
    values = values_of(note)
    for kind in ("joint", "link"):
        if kind in values:
            return kind, values[kind]
    return ROBOT


def made_names(link: Element) -> list[Element]:
    """Return the shapes of a link that have a name that no file gave them."""
    found = []
    counts = {"visual": -1, "collision": -1}
    names = {name_of(each) for each in link.elements()}
    for each in link.elements():
        if each.name in counts:
            counts[each.name] += 1
            name = name_of(each)
            made = shape_name(name_of(link), each.name, counts[each.name], names - {name})
            if name == made and not _is_given(each):
                found.append(each)
    return found


def _is_given(element: Element) -> bool:
    """Return whether the name of an element is written in a file."""
    span = element.value_span("name")
    return span.source.text[span.start : span.end] == name_of(element)


def without_name(element: Element) -> Element:
    """Return an element without its name."""
    copy = element.with_children(element.children)
    copy.attributes = {key: own for key, own in element.attributes.items() if key != "name"}
    return copy


class Notes:
    """The notes of a robot.

    Attributes:
        absorbed: the identities of joints and links that words make.
    """

    def __init__(
        self,
        root: Element,
        notes: Iterable[Element],
        *,
        elements: ElementWriter,
        names: ShortNames,
        degrees: Degrees,
        absorbs: bool,
    ) -> None:
        """Sort notes by what they belong to.

        Args:
            root: the robot, in the language's spelling.
            notes: its notes, likewise.
            elements: writes elements.
            names: the names of parts.
            degrees: writes angles.
            absorbs: whether sensors may make the frames of their names.
        """
        self._elements = elements
        self._names = names
        self._degrees = degrees
        self._types: dict[str, str] = {}
        self._links: dict[str, Element] = {}
        self._joints: dict[str, Element] = {}
        self._sections: dict[int, tuple[str, int]] = {}
        self._read(root)
        self._notes: dict[tuple[str, Home], list[Element]] = {}
        self._surfaces: dict[tuple[str, int], Element] = {}
        self._blocks: dict[Home, dict[str, list[Element]]] = {}
        self._of_sections: dict[int, dict[str, Body]] = {}
        self.absorbed: set[int] = set()
        self._made: dict[str, Element] = {}
        for note in notes:
            values = values_of(note)
            if note.name == "surface":
                self._surfaces[values["link"], int(values["index"])] = note
            elif note.name == "dynamics":
                self._put_back(note)
            elif note.name == "raw-block":
                blocks = self._blocks.setdefault(home_of(note), {})
                blocks.setdefault(values["format"], []).extend(note.elements())
            else:
                home = home_of(note) if note.name in ("actuator", "sensor") else ROBOT
                self._notes.setdefault((note.name, home), []).append(note)
        self._settle_frames(frames_of_sites(root, notes))
        for name, link in self._links.items():
            self._settle_geoms(name, link)
            self._settle_shapes(name, link)
        self._keep_order(list(notes))
        self._sensors = [name_of(note) for note in notes if note.name == "sensor"]
        self._order = {name: index for index, name in enumerate(self._links)}
        for note in notes:
            if note.name == "sensor" and absorbs:
                self._absorb(note)

    def _keep_order(self, notes: list[Element]) -> None:
        """Have the block of the robot say the order of actuators, if it is not that of joints."""
        wanted = actuators_in_order(notes)
        own = [name for name in self._types if ("actuator", ("joint", name)) in self._notes]
        block = self._blocks.setdefault(ROBOT, {}).setdefault(MJCF, [])
        sections = [each for each in block if each.name == "actuator"]
        said = [each for section in sections for each in section.elements()]
        if wanted == own or any("joint" in each.attributes for each in said):
            return
        words = {"position": "position", "velocity": "velocity", "effort": "motor"}
        span = notes[0].span
        rows: list[Node] = []
        for name in wanted:
            (note,) = self._notes["actuator", ("joint", name)][:1]
            word = words[values_of(note).get("command", "position")]
            for element in self._blocks.get(("joint", name), {}).get(MJCF, ()):
                word = word if is_setting(element) else element.name
            rows.append(Element(word, span, {"joint": name}))
        block.insert(0, Element("actuator", span, {}, rows))

    def _read(self, root: Element) -> None:
        for child in root.elements():
            if child.name == "joint":
                self._types[name_of(child)] = values_of(child).get("type", "")
                self._joints[child_of(child) or ""] = child
            elif child.name == "link":
                self._links[name_of(child)] = child
                index = 0
                for section in child.elements():
                    if section.name == "collision":
                        self._sections[id(section)] = name_of(child), index
                        index += 1

    def _put_back(self, note: Element) -> None:
        """Put the whole `dynamics` of a joint back in its place."""
        values = {name: value for name, value in note.attributes.items() if name != "joint"}
        owner = values_of(note)["joint"]
        joint = next(each for each in self._joints.values() if name_of(each) == owner)
        known = next((each for each in joint.elements() if each.name == note.name), None)
        if known is None:
            known = Element(note.name, note.span)
            joint.children.append(known)
        known.attributes = {name: format_value(value) for name, value in values.items()}

    def _settle_frames(self, frames: Mapping[tuple[str, str], str]) -> None:
        """Let a block of a link that is about a site be one of the frame that the site is."""
        for (kind, link), blocks in list(self._blocks.items()):
            for element in list(blocks.get(MJCF, ())):
                frame = frames.get((link, name_of(element)))
                if element.name == "site" and kind == "link" and frame is not None:
                    own = self._blocks.setdefault(("link", frame), {}).setdefault(MJCF, [])
                    own += settings_of(element)
                    blocks[MJCF] = [each for each in blocks[MJCF] if each is not element]

    def _settle_geoms(self, name: str, link: Element) -> None:
        """Move what the block of a link says of geoms to the sections of their names.

        What only names a geom says its place among the others, which means nothing.
        """
        block = self._blocks.get(("link", name), {}).get(MJCF, [])
        rows: dict[str, list[Element]] = {"visual": [], "collision": []}
        named: dict[str, Element] = {}
        for child in link.elements():
            if child.name in rows:
                rows[child.name].append(child)
                named[name_of(child)] = child  # the collision, of a geom that is both
        known = [each for each in block if each.name == "geom" and name_of(each) in named]
        moved = {id(each): named[name_of(each)] for each in known if not each.children}
        for geom in known:
            if id(geom) in moved and [*geom.attributes] != ["name"]:
                section = moved[id(geom)]
                body = self._of_sections.setdefault(id(section), {}).setdefault(MJCF, _braced())
                for key, value in values_of(geom).items():
                    if key != "name":
                        body.add(key, value)
        block[:] = [each for each in block if id(each) not in moved]
        self._order_sections(link, rows)
        self._leave_out_names(link, {name_of(each) for each in block if each.name == "geom"})

    def _order_sections(self, link: Element, rows: Mapping[str, Sequence[Element]]) -> None:
        """Put the visual of each geom that is both beside its collision."""
        visuals, collisions = ([name_of(each) for each in row] for row in rows.values())
        both = [each for each in visuals if each and each in collisions]
        if not both or both != [each for each in collisions if each in both]:
            return
        queues = {kind: iter(row) for kind, row in rows.items()}
        order: list[Element] = []
        for name in both:
            for queue in queues.values():
                for each in queue:
                    order.append(each)
                    if name_of(each) == name:
                        break
        for queue in queues.values():
            order += queue
        places = iter(order)
        link.children = [
            next(places) if isinstance(child, Element) and child.name in rows else child
            for child in link.children
        ]

    def _leave_out_names(self, link: Element, used: Collection[str]) -> None:
        """Leave out the names of sections that MJCF did not give them, unless they are used."""
        made = {id(each) for each in made_names(link)}
        for place, child in enumerate(link.children):
            if isinstance(child, Element) and id(child) in made and name_of(child) not in used:
                link.children[place] = copy = without_name(child)
                if id(child) in self._sections:
                    self._sections[id(copy)] = self._sections[id(child)]
                if id(child) in self._of_sections:
                    self._of_sections[id(copy)] = self._of_sections[id(child)]

    def _settle_shapes(self, name: str, link: Element) -> None:
        """Move what the block of a link for SDF says of its shapes to these."""
        block = self._blocks.get(("link", name), {}).get(SDF, [])
        for kind in ("visual", "collision"):
            rows = [each for each in link.elements() if each.name == kind]
            known = {name_of(each): index for index, each in enumerate(rows)}
            about = [each for each in block if each.name == kind]
            places = [known.get(name_of(each), -1) for each in about]
            is_plain = all([*values_of(each)] == ["name"] and each.elements() for each in about)
            if not is_plain or -1 in places or places != sorted(set(places)):
                continue
            for element, index in zip(about, places, strict=True):
                own = self._of_sections.setdefault(id(rows[index]), {})
                body = self._elements.body(element.children)
                own[SDF] = body if body is not None else Body()
            block[:] = [each for each in block if each.name != kind]

    def _absorb(self, note: Element) -> None:
        """Let a sensor make the frame of its name, where it would make the one that is there."""
        sensor = values_of(note)
        name, link, home = sensor["name"], sensor.get("link"), sensor.get("frame")
        if link is None or home is None:
            return
        has_own = home == name and bool(self._links[link].elements())
        frames = [(name, link)] if has_own else []
        if sensor["type"] in CAMERAS and "xyz" not in sensor:
            frames.append((f"{name}{OPTICAL}", home))
        for frame, parent in frames:
            own, joint = self._links.get(frame), self._joints.get(frame)
            if own is None or joint is None or ("link", frame) in self._blocks:
                return
            if not is_frame(own, joint, parent):
                return
        if has_own:
            between = list(self._links)[self._order[link] + 1 : self._order[name]]
            if any(child_of_frame(self._joints.get(each)) != link for each in between):
                return
            self._made[name] = note
        for frame, _ in frames[has_own:]:
            self.absorbed |= {id(self._links[frame]), id(self._joints[frame])}

    def sensor_in_place_of(self, link: Element, pose: list[Entry]) -> Entry | None:
        """Return the sensor that makes the frame that a link is, at a pose; None if none does."""
        note = self._made.get(name_of(link))
        return None if note is None else self._sensor(note, pose)

    def put_in_order(self, model: Body) -> None:
        """Put the sensors of each link in their order, of which some are frames in theirs."""
        names = [name_of(note) for (kind, _), row in self._notes.items() for note in row
                 if kind == "sensor"]  # fmt: skip
        places = {self._elements.key("sensor", {"name": name}): name for name in names}
        order = {key: self._sensors.index(name) for key, name in places.items()}
        for body in model.bodies():
            found = [entry for entry in body if entry.key in order]
            if found == sorted(found, key=lambda entry: order[entry.key]):
                continue
            movable = [entry for entry in found if places[entry.key] not in self._made]
            body.entries = [entry for entry in body if not any(entry is own for own in movable)]
            for entry in sorted(movable, key=lambda own: order[own.key]):
                before = [
                    index
                    for index, own in enumerate(body.entries)
                    if order.get(own.key, len(order)) < order[entry.key]
                ]
                after = [index for index, own in enumerate(body.entries) if own.key in order]
                at = before[-1] + 1 if before else after[0] if after else len(body.entries)
                body.entries.insert(at, entry)

    @staticmethod
    def put_shapes_last(model: Body) -> None:
        """Put the second visual and collision of each link, and all after it, below the rest."""
        for body in model.bodies():
            for entry in body:
                if entry.key.partition("/")[0] != "link" or not isinstance(entry.value, Body):
                    continue
                seen: set[str] = set()
                first: list[Entry] = []
                more: list[Entry] = []
                for own in entry.value:
                    kind = own.key.partition("/")[0]
                    is_second = own.key in seen or any(
                        kind == e.key.partition("/")[0] for e in more
                    )
                    (more if kind in SHAPES and is_second else first).append(own)
                    seen.add(own.key)
                entry.value.entries = first + more

    # --- in joints, links, sections and frames ------------------------------------------------

    def in_joint(self, joint: Element) -> list[Entry]:
        """Return the entries of a joint that are words."""
        name = name_of(joint)
        kind = self._types.get(name, "")
        home = ("joint", name)
        found = [self._actuator(note, kind) for note in self._notes.get(("actuator", home), ())]
        found += [self._sensor(note) for note in self._notes.get(("sensor", home), ())]
        return found + self._written_blocks(home)

    def in_link(self, link: Element) -> list[Entry]:
        """Return the entries of a link that are words."""
        home = ("link", name_of(link))
        sensors = self._notes.get(("sensor", home), ())
        found = [self._sensor(note) for note in sensors if name_of(note) not in self._made]
        return found + self._written_blocks(home)

    def in_section(self, section: Element) -> list[Entry]:
        """Return the entries of a visual or collision that are words."""
        found: list[Entry] = []
        surface = self._surfaces.get(self._sections.get(id(section), ("", 0)))
        if surface is not None:
            values = values_of(surface)
            body = _braced(Entry(each, values[each]) for each in SURFACE.fields if each in values)
            found.append(Entry("surface", body))
        for format, body in self._of_sections.get(id(section), {}).items():
            found.append(Entry(format, body))
        return found

    def in_frame(self, link: Element) -> list[Entry] | None:
        """Return the entries of a frame that are words; None if it has others than a frame has."""
        home = ("link", name_of(link))
        if ("sensor", home) in self._notes:
            return None
        blocks = self._blocks.get(home, {})
        if any(not is_setting(each) for block in blocks.values() for each in block):
            return None
        return self._written_blocks(home)

    def _written_blocks(self, home: Home) -> list[Entry]:
        found: list[Entry] = []
        for format, elements in self._blocks.get(home, {}).items():
            if not elements:
                continue
            body = Body()
            for each in elements:
                body.append(self._elements.entry(each))
            body.in_braces = is_short(body) or all(map(is_setting, elements))
            found.append(Entry(format, body))
        return found

    def _actuator(self, note: Element, kind: str) -> Entry:
        values = values_of(note)
        left_out = {each for name, own in COMPUTED.items() if name in values for each in own}
        if "motor" in values:
            left_out |= {*OF_MOTOR}
        commands = values.pop("commands", values.pop("command", "position"))
        body = _braced()
        if commands != "position":
            several = commands.split()
            body.add("command", f"[{', '.join(several)}]" if len(several) > 1 else commands)
            if len(several) > 1:
                body.entries[-1].value = ", ".join(several)
        for name in ACTUATOR.fields:
            value = values.get(name)
            if value is None or name == "command" or name in left_out:
                continue
            if name == "no_load_speed" and kind in TURNING:
                value = self._degrees.number(value, "deg/s")
            body.add(name, milliseconds(value) if name == "delay" else value)
        return Entry("actuator", body or None)

    def _sensor(self, note: Element, pose: Sequence[Entry] | None = None) -> Entry:
        values = values_of(note)
        name, type = values["name"], values["type"]
        body = _braced([Entry("type", type)])
        frame = values.get("frame")
        if pose is not None:
            body.entries += pose
        elif (frame is not None and frame != values.get("link")) or (
            frame is not None and (self._links[frame].elements() or "xyz" in values)
        ):
            body.add("frame", frame)
            body.entries += self._own_pose(values)
        for field in (*SENSOR.fields.values(), *SENSORS[type].fields.values()):
            value = values.get(field.name)
            if value is None or field.name == "type":
                continue
            if field.kind == "angle":
                value = self._degrees.row(value)
            elif field.name == "rate":
                value = f"{value} Hz"
            body.add(field.name, value)
        words = values.get("noises", "").split()
        if words:
            rows = zip(words[::2], words[1::2], strict=True)
            body.add("noise", _braced(Entry(*row) for row in rows))
        return Entry(self._elements.key("sensor", {"name": name}), body)

    def _own_pose(self, values: Mapping[str, str]) -> list[Entry]:
        """Return the pose that a sensor has in a frame that is there; zeros for none."""
        if "xyz" not in values:
            return []
        rows = [Entry("xyz", values["xyz"]), Entry("rpy", self._degrees.row(values["rpy"]))]
        return [row for row in rows if not same_words(str(row.value), ZEROS)] or rows[:1]

    # --- sections and statements --------------------------------------------------------------

    def sections_above(self) -> list[Entry]:
        """Return the sections before the model."""
        bases = self._notes.get(("base", ROBOT), ())
        return [Entry("base", values_of(note)["type"]) for note in bases[-1:]]

    def sections_below(self) -> list[Entry]:
        """Return the sections after the model."""
        found = []
        states = Body([self._state(note) for note in self._notes.get(("state", ROBOT), ())])
        if states:
            found.append(Entry("states", states))
        groups = Body([_group(note) for note in self._notes.get(("robot-group", ROBOT), ())])
        if groups:
            found.append(Entry("groups", groups))
        for note in self._notes.get(("collisions", ROBOT), ())[-1:]:
            body = Body([Entry(name, value) for name, value in values_of(note).items()])
            if note.elements():
                pairs = [values_of(each) for each in note.elements()]
                keep = Body(
                    [Entry("keep", f"{pair['link_1']}, {pair['link_2']}") for pair in pairs]
                )
                body.entries += keep.entries
            found.append(Entry("collisions", body))
        return found

    def _state(self, note: Element) -> Entry:
        body = _braced()
        for each in note.elements():
            values = values_of(each)
            joint, value = values["joint"], values["value"]
            value = value.removesuffix(".0")
            if self._types.get(joint) in TURNING:
                value = self._degrees.number(value)
            body.add(self._names.of_joints.get(joint, joint), value)
        body.wraps = True
        return Entry(name_of(note), body)

    def statements(self) -> list[Entry]:
        """Return what is said in the model, after the parts."""
        found = []
        for note in self._notes.get(("robot-loop", ROBOT), ()):
            values = values_of(note)
            between = _listed([values["frame_1"], values["frame_2"]])
            body = _braced([Entry("name", values["name"]), Entry("type", values["type"])])
            body.add("between", between)
            if "axis" in values:
                body.add("axis", values["axis"])
            found.append(Entry("loop", body))
        return found + self._written_blocks(ROBOT)

    def counts(self) -> dict[str, int]:
        """Return how many there are of the kinds of notes that are counted."""
        found: dict[str, int] = {}
        for (kind, _), notes in self._notes.items():
            if kind in COUNTED:
                name = COUNTED[kind]
                found[name] = found.get(name, 0) + len(notes)
        return found


def _listed(names: Sequence[str]) -> Flow:
    return Flow(f"[{', '.join([scalar_of(name, in_flow=True) for name in names])}]")


def _group(note: Element) -> Entry:
    values = values_of(note)
    body = _braced()
    rows: dict[str, list[str]] = {}
    for each in note.elements():
        own = values_of(each)
        if each.name == "chain":
            body.add("chain", _listed([own["base_link"], own["tip_link"]]))
        else:
            word = {"link": "links", "joint": "joints", "robot-group": "groups"}[each.name]
            rows.setdefault(word, []).append(own.get(each.name, own.get("name", "")))
    for word, members in rows.items():
        body.add(word, _listed(members))
    if "parent_link" in values:
        body.add("parent", values["parent_link"])
    if "end_effector" in values:
        body.add("end_effector", values["end_effector"])
    return Entry(name_of(note), body)


def _braced(entries: Iterable[Entry] = ()) -> Body:
    return Body(entries, in_braces=True, width=RECORD_WIDTH)


def child_of_frame(joint: Element | None) -> str | None:
    """Return the link that a fixed joint is on; None for another joint."""
    if joint is None or values_of(joint).get("type") != "fixed":
        return None
    return next((values_of(e).get("link") for e in joint.elements() if e.name == "parent"), None)


def is_setting(element: Element) -> bool:
    """Return whether an element of a block only sets a value: `<armature>0.1</armature>`."""
    return has_text(element) and not element.elements() and not element.attributes


def settings_of(element: Element) -> list[Element]:
    """Return the attributes of an element, except for its name, as elements that set them."""
    from ...xml.tree import Text

    return [
        Element(name, element.span, {}, [Text(value, element.value_span(name))])
        for name, value in values_of(element).items()
        if name != "name"
    ]


def milliseconds(text: str) -> str:
    """Return a short time in seconds as one in milliseconds, if its digits stay the same."""
    try:
        seconds = float(text)
    except ValueError:
        return text
    whole = round(seconds * 1000, 6)
    if 0 < seconds < MILLISECONDS and whole / 1000 == seconds:
        return f"{whole:g} ms"
    return text
