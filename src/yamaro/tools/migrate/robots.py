"""Robots in MJCF or SDF as a Yamaro source: what the reader of the format makes of them, in words.

The source is built for the format, and what is built is compared with what was read: elements,
notes and blocks. What would come out different is written plainer.
"""

from __future__ import annotations

import os
from math import isclose

from ...codes import ADJUSTABLE
from ...diagnostics import ERROR, YamaroError
from ...files.loader import FileLoader
from ...model.compare import compare, is_used, prefixes_in
from ...model.schema import ELEMENTS
from ...model.shapes import SIMPLE_SHAPES, SIZES
from ...model.values import values_of
from ...options import Options
from ...pipeline import Run
from ...request import Request, read_main
from ...runtime.files import Library, rules_of
from ...xml.reader import read_xml
from ...xml.tree import Element
from .comparing import compare_notes, without_made_names
from .document import RECORD_WIDTH, Body, Entry, element_key
from .elements import (
    ElementWriter,
    child_of,
    comments_above,
    name_of,
    tidy_text,
)
from .formulas import Degrees
from .limbs import share_limbs
from .notes import Notes
from .parts import LinkPlan, NoPart, PartWriter, ShortNames, is_word
from .shared import share_entries
from .spelling import NO_LIMIT, TOLERANCE, copied, in_language, move_files, place_comments
from .urdf import Migration, ModelWriter, Variables, different_parts, ignore
from .writing import write_document

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence, Set

    from ...diagnostics import Diagnostic
    from ...files.readable import Reach
    from ...policy import Policy
    from ...source import Source
    from ...xml.reader import XmlDocument

WATER = 1000.0
"""The density in kg/m³ of geoms that MJCF says nothing else of."""


DECIMALS = 3
"""Those that angles in degrees may have."""
WAYS = ((True, True), (True, False), (False, False))
"""The ways to write a robot, the shortest first: with functions, with sensors that make frames."""


class Lowered:
    """A robot as it is before it is written in a format.

    Attributes:
        root: the `<robot>`.
        notes: what it has besides elements of URDF, blocks for one format among it.
        diagnostics: what was found.
        allowed: the codes of errors that were allowed.
    """

    __slots__ = ("allowed", "diagnostics", "notes", "root")

    def __init__(self, run: Run, format: str) -> None:
        """Take the result of a run.

        Raises:
            YamaroError: it has errors that cannot be allowed.
        """
        from ...targets.table import found_for

        self.root = run.root
        self.notes = list(run.notes)
        self.diagnostics = found_for(format, run.diagnostics)
        errors = [each for each in self.diagnostics if each.severity == ERROR]
        self.allowed = sorted({each.code for each in errors})
        if run.is_faulty or not ADJUSTABLE.issuperset(self.allowed):
            raise YamaroError(run.diagnostics)


class Builder:
    """Builds robots for a format, without writing it.

    Attributes:
        format: that of the source.
        folder: where the Yamaro source is to be, absolute.
    """

    __slots__ = ("_packages", "_reach", "folder", "format")

    def __init__(
        self,
        format: str,
        folder: str,
        *,
        packages: Mapping[str, str] | None = None,
        reach: Reach | None = None,
    ) -> None:
        """Say for which format, where, and what may be read besides; None for anything."""
        self.format = format
        self.folder = folder
        self._packages = dict(packages or {})
        self._reach = reach

    def read(self, source: Source, policy: Policy, model: str | None) -> Lowered:
        """Return the robot that a file in another format describes.

        Raises:
            YamaroError: the file has errors.
        """
        return self._run(source.path or source.name, source.text, policy, model)

    def build(self, stem: str, text: str, policy: Policy) -> Lowered:
        """Return the robot that a Yamaro source describes.

        Raises:
            YamaroError: it has errors.
        """
        return self._run(os.path.join(self.folder, f"{stem}.yaml"), text, policy, None)

    def _run(self, path: str, text: str, policy: Policy, model: str | None) -> Lowered:
        options = Options(policy=policy, packages=self._packages, text=text, model=model)
        library = Library(FileLoader(policy.limits, self._reach), rules_of(policy))
        source = read_main(path, text, library)
        request = Request(path, source, options, reach=self._reach, run=lambda work: work())
        request.is_part = True  # a keyframe is to be that of its robot wherever it is attached
        return Lowered(Run(request, library, policy, ignore, target=self.format), self.format)


# --- robots -----------------------------------------------------------------------------------


class RobotMigration(Migration):
    """A Yamaro source of a robot in another format, and in what its robot differs.

    Attributes:
        counts: how many notes of some kinds there are.
        diagnostics: what the reader found.
        lost_comments: comments on what has no place in the source.
    """

    __slots__ = ("counts", "diagnostics", "lost_comments")

    counts: dict[str, int]
    diagnostics: Sequence[Diagnostic]
    lost_comments: int

    def remark(self) -> str:
        """Return what else is said of it, or ""."""
        count = self.lost_comments
        if not count:
            return ""
        comments = "1 comment is" if count == 1 else f"{count} comments are"
        return f"{comments} about what the YAML says in other places, and left out"


def migrate_robot(
    source: Source,
    builder: Builder,
    *,
    policy: Policy,
    building: Policy,
    exact: bool = False,
    model: str | None = None,
) -> RobotMigration:
    """Return a Yamaro source of a robot in MJCF or SDF.

    Args:
        source: the file.
        builder: builds robots for its format.
        policy: how far the file is trusted.
        building: how far the source that is made of it is.
        exact: whether an origin that is missing has to stay missing.
        model: the name of the model that is wanted of a file with several.

    Raises:
        YamaroError: the file has errors, or what came out cannot be built, a fault of ours.
    """
    robot = builder.read(source, policy, model)
    document = read_xml(source, policy.limits)
    home = os.path.dirname(source.path) if source.path else os.getcwd()
    stem = os.path.splitext(os.path.basename(source.path))[0] or "robot"
    return migrate_lowered(
        robot, document, builder, home=home, stem=stem, policy=building, exact=exact
    )


def migrate_lowered(
    robot: Lowered,
    document: XmlDocument,
    builder: Builder,
    *,
    home: str,
    stem: str,
    policy: Policy,
    exact: bool = False,
) -> RobotMigration:
    """Return a Yamaro source of a robot that was read.

    Args:
        robot: the robot.
        document: the file that it was read from, for its comments and its classes.
        builder: builds robots for the format of the file.
        home: the folder of the file.
        stem: the name of the source, without its ending.
        policy: how far the source is trusted.
        exact: whether an origin that is missing has to stay missing.

    Raises:
        YamaroError: what came out cannot be built, a fault of ours.
    """
    whole = move_files(robot.root, home, builder.folder)
    root = without_made_names(whole)
    notes = [move_files(note, home, builder.folder) for note in robot.notes]
    own = in_language(whole)
    own_notes = [in_language(note) for note in notes]
    left = place_comments(document, own, own_notes)
    plain: set[int] = set()
    ways = iter(WAYS)
    shares, absorbs = next(ways)
    while True:
        comments = comments_on_classes(document.root, left)
        on_classes = sum(map(len, comments.values()))
        text, counts = _write(
            document, own, own_notes, plain, comments, exact=exact, shares=shares, absorbs=absorbs
        )
        try:
            built = builder.build(stem, text, policy)
        except YamaroError:
            everything = {id(each) for each in own.elements() if each.name in ("joint", "link")}
            way = next(ways, None)
            if way is not None:
                shares, absorbs = way
                continue
            if everything <= plain:
                raise
            plain |= everything
            continue
        made = without_made_names(built.root)
        differences = compare(root, made, exact=exact)
        differences += compare_notes((root, notes), (made, built.notes))
        if differences and (way := next(ways, None)) is not None:
            shares, absorbs = way
            continue
        different = different_parts(root, own, made, exact=exact) - plain
        if differences and different:
            plain |= different
            continue
        migration = RobotMigration(text, root, differences)
        migration.allowed = built.allowed
        kept = on_classes - sum(map(len, comments.values()))
        migration.counts, migration.lost_comments = counts, sum(map(len, left.values())) - kept
        migration.diagnostics = [
            each for each in robot.diagnostics if each.code not in built_codes(built)
        ]
        return migration


def built_codes(built: Lowered) -> set[str]:
    """Return the codes of what is found in a robot however it is written."""
    return {each.code for each in built.diagnostics}


def _write(
    document: XmlDocument,
    root: Element,
    notes: Sequence[Element],
    plain: set[int],
    comments: dict[str, list[str]],
    *,
    exact: bool,
    shares: bool,
    absorbs: bool,
) -> tuple[str, dict[str, int]]:
    """Return a source, and how many notes of some kinds are in it.

    The comments on classes that become functions are taken out.
    """
    while True:
        known = len(plain)
        colors = colors_in(root)
        variables = Variables(root, without=colors)
        elements = ElementWriter(variables.file_name)
        shown = copied(root)
        naming = _naming_of(root)
        writer = ModelWriter(shown, elements, variables, plain, exact=exact, naming=naming)
        words = Notes(
            shown,
            notes,
            elements=elements,
            names=writer.names,
            degrees=Degrees({}, DECIMALS),
            absorbs=absorbs,
        )
        writer.parts = RobotParts(
            words, colors, elements, writer.names, variables.material, exact=exact
        )
        model = writer.body(without=words.absorbed)
        words.put_in_order(model)
        words.put_shapes_last(model)
        functions = Body()
        if shares and len(plain) == known:
            names = {NO_LIMIT, *(own.key for own in variables.declared)}
            functions = share_limbs(model, names)
            bodies = [model]
            for entry in functions:
                assert isinstance(entry.value, Body)
                bodies += [own.value for own in entry.value if isinstance(own.value, Body)]
            readable = {NO_LIMIT, *(own.key for own in variables.declared)}
            classes = classes_of(document.root)
            functions.entries[:0] = share_entries(bodies, readable, names, classes, comments)
        for entry in words.statements():
            model.append(entry)
        sections = Body()
        attributes = values_of(root)
        used = prefixes_in(root)
        attributes = {name: value for name, value in attributes.items() if is_used(name, used)}
        name = attributes.get("name", "").strip()
        robot = Entry("robot", name)
        if [*attributes] != ["name"] or not name or "\n" in name:
            robot = Entry(element_key("robot", attributes, bracketed="name" not in attributes))
        sections.append(robot)
        if naming != NAMINGS[0]:
            patterns = [Entry(*each) for each in zip(("joint", "link"), naming, strict=True)]
            own = [
                pair for pair in zip(patterns, NAMINGS[0], strict=True) if pair[0].value != pair[1]
            ]
            sections.add("naming", Body([entry for entry, _ in own], in_braces=True))
        for entry in words.sections_above():
            sections.append(entry)
        if any(f"$({NO_LIMIT})" in values_of(each).values() for each in root.iter()):
            variables.declared.add(NO_LIMIT, "1e16")
        if variables.declared:
            sections.add("variables", variables.declared)
        if functions:
            sections.add("functions", functions)
        if robot.value is None:
            robot.value = model
            sections.entries.remove(robot)
            sections.append(robot)
        else:
            sections.add("model", model or None)
        for entry in words.sections_below():
            sections.append(entry)
        for comment in document.after:
            sections.note(tidy_text(comment.text))
        if len(plain) == known:
            return write_document(sections, comments_above(document)), words.counts()


def _naming_of(root: Element) -> tuple[str, str]:
    """Return the patterns by which most joints and links have their names of one name."""
    links = {name_of(each): each for each in root.elements() if each.name == "link"}
    joints = [each for each in root.elements() if each.name == "joint"]

    def count(naming: tuple[str, str]) -> int:
        names = ShortNames([], naming)
        ends = [(links.get(child_of(joint) or ""), joint) for joint in joints]
        pairs = [(link, joint) for link, joint in ends if link is not None]
        return sum(
            names.stem(link, joint) is not None and not is_frame_name(link, joint)
            for link, joint in pairs
        )

    def is_frame_name(link: Element, joint: Element) -> bool:
        return not link.elements() and name_of(joint) == f"{name_of(link)}_joint"

    counts = {naming: count(naming) for naming in NAMINGS}
    best = max(NAMINGS, key=lambda naming: counts[naming])
    return best if counts[best] >= FEWEST_NAMED + counts[NAMINGS[0]] else NAMINGS[0]


NAMINGS = (("*_joint", "*_link"), ("*_joint", "*"), ("*", "*"), ("*", "*_link"))
"""How files name joints and links; the first is the language's default."""
FEWEST_NAMED = 3
"""Parts that have to gain one name by another way of naming."""


def colors_in(root: Element) -> set[int]:
    """Return the identities of the materials that are called as `color` in a visual calls them.

    That is after the first link that has the colour.
    """
    found: set[int] = set()
    names: dict[tuple[str, ...], str] = {}
    for link in root.elements():
        for visual in link.elements() if link.name == "link" else ():
            for material in visual.elements():
                inner = material.elements()
                if material.name != "material" or [each.name for each in inner] != ["color"]:
                    continue
                rgba = tuple(values_of(inner[0]).get("rgba", "").split())
                stem = wanted = f"{name_of(link)}_color"
                number = 1
                while wanted in names.values():
                    number += 1
                    wanted = f"{stem}_{number}"
                if name_of(material) == names.get(rgba, wanted):
                    names[rgba] = name_of(material)
                    found.add(id(material))
    return found


class RobotParts(PartWriter):
    """Writes the parts of a robot that has notes and blocks."""

    def __init__(
        self, words: Notes, colors: Set[int], *arguments: object, **keywords: object
    ) -> None:
        """Take notes as words, the materials that are colours, and what a writer of parts takes."""
        super().__init__(*arguments, **keywords)  # type: ignore[arg-type]
        self._words = words
        self._colors = colors
        self._degrees = Degrees({}, DECIMALS)

    def _check_names(self, link: Element, joint: Element | None) -> bool:
        names = [name_of(each) for each in (link, joint) if each is not None]
        if not all(names):
            raise NoPart
        return not all(map(is_word, names))

    def _plan(self, link: Element) -> LinkPlan:
        return LinkPlan(
            link,
            self._elements.file_name,
            self._has_form,
            self._is_solid,
            exact=self._exact,
            sizes=SIZES,
        )

    def _inertial(self, inertial: Element, plan: LinkPlan) -> Entry:
        """Return the mass as that of water, which MuJoCo assumes, where it is that."""
        entry = super()._inertial(inertial, plan)
        if entry.key == "mass" and plan.geometry is not None and isinstance(entry.value, str):
            shape = SIMPLE_SHAPES[plan.geometry.kind](*map(float, plan.geometry.sizes()))
            if isclose(float(entry.value), WATER * shape.volume(), rel_tol=TOLERANCE):
                return Entry("density", f"{WATER:g}", entry.comment)
        return entry

    def _section(self, section: Element, plan: LinkPlan) -> Entry:
        entry = super()._section(section, plan)
        if isinstance(entry.value, Body) and entry.value.in_braces:
            entry.value.width = RECORD_WIDTH
        return entry

    def _section_child(self, child: Element) -> Entry:
        if id(child) in self._colors:
            (color,) = child.elements()
            return Entry("color", " ".join(values_of(color)["rgba"].split()))
        return super()._section_child(child)

    def _words_of_link(self, link: Element) -> list[Entry]:
        return self._words.in_link(link)

    def _words_of_joint(self, joint: Element) -> list[Entry]:
        return self._words.in_joint(joint)

    def _known_of(self, name: str) -> Set[str]:
        return ELEMENTS[name].fields.keys()

    def _words_of_section(self, section: Element) -> list[Entry]:
        return self._words.in_section(section)

    def frame_entry(self, link: Element, entries: list[Entry]) -> Entry:
        """Return a frame for a link, or the sensor that makes it, with some entries."""
        sensor = self._words.sensor_in_place_of(link, entries)
        return super().frame_entry(link, entries) if sensor is None else sensor

    def words_of_frame(self, link: Element) -> list[Entry] | None:
        """Return the words in a frame; None if its link has some that a frame cannot have."""
        return self._words.in_frame(link)


def comments_on_classes(root: Element, left: Mapping[int, list[str]]) -> dict[str, list[str]]:
    """Return the comments on each class in MJCF, and on what it says of joints and geoms."""
    found: dict[str, list[str]] = {}
    pending = [each for each in root.elements() if each.name == "default"]
    while pending:
        defaults = pending.pop(0)
        inner = [each for each in defaults.elements() if each.name != "default"]
        pending += [each for each in defaults.elements() if each.name == "default"]
        comments = [text for each in (defaults, *inner) for text in left.get(each.span.start, ())]
        name = values_of(defaults).get("class", "")
        if name and comments:
            found[name] = comments
    return found


def classes_of(root: Element) -> dict[int, list[str]]:
    """Return the classes of joints and geoms in MJCF by where each is, the outermost first."""
    paths: dict[str, list[str]] = {}

    def note(defaults: Element, path: list[str]) -> None:
        name = values_of(defaults).get("class", "")
        path = [*path, name] if name and name != "main" else path
        if name:
            paths[name] = path
        for child in defaults.elements():
            if child.name == "default":
                note(child, path)

    found: dict[int, list[str]] = {}

    def walk(owner: Element, around: str) -> None:
        around = values_of(owner).get("childclass", around)
        for child in owner.elements():
            if child.name in ("joint", "geom"):
                found[child.span.start] = paths.get(values_of(child).get("class", around), [])
            elif child.name in ("body", "frame", "replicate", "worldbody"):
                walk(child, around)

    for child in root.elements():
        if child.name == "default":
            note(child, [])
    walk(root, "")
    return found
