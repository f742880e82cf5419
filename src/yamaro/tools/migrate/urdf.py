"""URDF, or any other XML, as a Yamaro source: parts, variables for what repeats, elements.

The source is built and compared with the file; what comes out different is written as an element.
"""

from __future__ import annotations

import os
from itertools import takewhile

from ...codes import ADJUSTABLE
from ...diagnostics import ERROR, YamaroError
from ...files.loader import FileLoader, LoadError, check_size
from ...model.compare import compare, count_defaults, is_used, prefixes_in
from ...model.values import values_of
from ...options import UsageError
from ...program import Program
from ...request import refusal_of_main
from ...source import STANDARD_INPUT, STANDARD_INPUT_NAME
from ...xml.reader import decode_xml, read_xml
from ...xml.tree import Element
from .controls import use_control
from .document import RECORD_WIDTH, Body, Entry, Quoted, Value, element_key, literal
from .elements import (
    ElementWriter,
    Item,
    add_loose,
    comments_above,
    comments_at_ends,
    is_bare,
    name_of,
    pair,
    spelled,
    tidy_text,
)
from .parts import Frames, NoPart, PartWriter, ShortNames, is_short_material, material_entry
from .writing import write_document

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Mapping, Sequence
    from typing import TypeVar

    from ...model.compare import Difference
    from ...policy import Limits, Policy
    from ...source import Source
    from ...xml.reader import XmlDocument
    from ...xml.tree import Element
    from .xacro.command import XacroMigration

    T = TypeVar("T")


# --- robots that parsers refuse: their faults are migrated too, and allowed when they are built


def build_allowing(build: Callable[[Sequence[str]], T]) -> tuple[T, list[str]]:
    """Return what is built, and the codes that had to be allowed.

    Args:
        build: builds with these codes allowed.

    Raises:
        YamaroError: there are errors that cannot be allowed.
    """
    try:
        return build(()), []
    except YamaroError as error:
        errors = [each for each in error.diagnostics if each.severity == ERROR]
        codes = sorted({each.code for each in errors})
        if not ADJUSTABLE.issuperset(codes):
            raise
    return build(codes), codes


def options_to_allow(codes: Sequence[str]) -> str:
    """Return the options with which the sources are built."""
    return " ".join(f"--allow {code}" for code in codes)


# --- sources ----------------------------------------------------------------------------------


FEWEST_MESHES = 3
"""Meshes of one folder for which the folder becomes a variable."""
FEWEST_MATERIALS = 2


class Migration:
    """A Yamaro source, and in what the robot it makes differs from the one it was made of.

    Attributes:
        text: the source.
        root: the robot it was made of.
        differences: what differs.
        defaults: how many origins, or values of origins, only the source gives.
        allowed: the codes to allow when it is built, since parsers refuse the robot.
    """

    __slots__ = ("allowed", "defaults", "differences", "root", "text")

    def __init__(
        self, text: str, root: Element, differences: list[Difference], defaults: int = 0
    ) -> None:
        """Hold the source, the robot it was made of, and how they compare."""
        self.text = text
        self.root = root
        self.differences = differences
        self.defaults = defaults
        self.allowed: Sequence[str] = ()


def migrate_urdf(
    document: XmlDocument, build: Callable[[str], Element], *, exact: bool = False
) -> Migration:
    """Return a source that makes the same document.

    What comes out is built and compared. A joint or link that would not come out the same as a part
    is written as the element it is.

    Args:
        document: the XML.
        build: returns the tree that a source makes.
        exact: whether an origin that is missing has to stay missing.

    Raises:
        YamaroError: what came out cannot be built, which is a fault of ours.
    """
    root = document.root
    source = spelled(root, literal)
    plain: set[int] = set()
    with_control = True
    while True:
        text, has_control = _write(document, source, plain, exact=exact, with_control=with_control)
        try:
            built = build(text)
        except YamaroError:
            everything = {id(e) for e in source.elements() if e.name in ("joint", "link")}
            if has_control:
                with_control = False
            elif everything <= plain:
                raise
            else:
                plain |= everything
            continue
        differences = compare(root, built, exact=exact)
        migration = Migration(text, root, differences, count_defaults(root, built))
        if not differences or root.name != "robot":
            return migration
        if has_control:
            with_control = False
            continue
        different = different_parts(root, source, built, exact=exact) - plain
        if not different:
            return migration
        plain |= different


def different_parts(
    expected: Element, source: Element, actual: Element, *, exact: bool
) -> set[int]:
    """Return the joints and links of `source` that differ from what is expected, by identity."""
    different = set()
    made = {(e.name, name_of(e)): e for e in actual.elements() if e.name in ("joint", "link")}
    for element, own in zip(expected.elements(), source.elements(), strict=True):
        if element.name in ("joint", "link"):
            other = made.get((element.name, name_of(element)))
            if other is None or compare(element, other, exact=exact, around=("robot",)):
                different.add(id(own))
    return different


def _write(
    document: XmlDocument, root: Element, plain: set[int], *, exact: bool, with_control: bool
) -> tuple[str, bool]:
    """Return a source in which some joints and links are plain elements.

    Those that turn out not to be parts are added to them. What names these is written again.

    Args:
        document: the XML.
        root: its root, in the language's spelling.
        plain: the identities of the plain elements.
        exact: whether an origin that is missing has to stay missing.
        with_control: whether blocks for ros2_control are written in words, where that is possible.

    Returns:
        the source, and whether there is such a block in words in it.
    """
    while True:
        known = len(plain)
        variables = Variables(root)
        elements = ElementWriter(variables.file_name)
        model = None
        if root.name == "robot":
            model = ModelWriter(root, elements, variables, plain, exact=exact).body()
        sections = Body()
        used = None if exact else prefixes_in(root)
        attributes = {name: value for name, value in values_of(root).items() if is_used(name, used)}
        if variables.declared:
            sections.add("variables", variables.declared)
        name = attributes.get("name", "").strip()
        is_plain = bool(name) and attributes == {"name": name} and "\n" not in name
        if model is None or not is_plain:
            key = element_key(root.name, attributes, bracketed="name" not in attributes)
            sections.add(key, elements.value(root) if model is None else model or None)
        else:
            robot = Entry("robot", name)
            robot.ending, model.opening = model.opening, ""
            sections.entries.insert(0, robot)
            sections.add("model", model or None)
        for comment in document.after:
            sections.note(tidy_text(comment.text))
        if len(plain) == known:
            has_control = with_control and use_control(sections)
            return write_document(sections, comments_above(document)), has_control


class ModelWriter:
    """Writes the body of a robot.

    Attributes:
        names: the names of its parts.
        parts: writes them.
    """

    def __init__(
        self,
        root: Element,
        elements: ElementWriter,
        variables: Variables,
        plain: set[int],
        *,
        exact: bool,
        naming: tuple[str, str] = ("*_joint", "*_link"),
    ) -> None:
        self._root = root
        self._elements = elements
        self._plain = plain
        self.names = ShortNames(root.elements(), naming)
        self.parts: PartWriter = PartWriter(elements, self.names, variables.material, exact=exact)
        self._frames = Frames()

    def body(self, *, without: Container[int] = ()) -> Body:
        """Return it; elements whose identities are among those `without` are left out."""
        nodes = [node for node in self._root.children if id(node) not in without]
        endings = comments_at_ends(nodes)
        items, loose = pair(nodes, endings)
        for item in items:  # parents and mimics may be named before their parts are written
            if item.element.name == "link" and not (self._is_plain(item) or is_bare(item)):
                self.names.add(item.element, item.joint)
        body = Body()
        for item in items:
            for node in item.above:
                add_loose(node, body, endings)
            link = item.element
            may_be_frame = link.name == "link" and not self._is_plain(item)
            if not may_be_frame or not self._frames.take(link, item.joint, self.parts, body):
                for entry in self._entries(item):
                    body.append(entry)
            for node in item.beside:
                add_loose(node, body, endings)
        for node in loose:
            add_loose(node, body, endings)
        return body

    def _entries(self, item: Item) -> list[Entry]:
        link, joint = item.element, item.joint
        if link.name in ("link", "joint"):
            self._frames.begin(None)
        if link.name == "link" and not self._is_plain(item):
            try:
                part = self.parts.part(link, joint, joint_first=item.is_joint_first)
                self._frames.begin(part, name_of(link))
                return [part]
            except NoPart:
                self._plain.update(id(element) for element in (link, joint) if element is not None)
                self.names.remove(link, joint)
        entries = [self._elements.entry(link)]
        if joint is not None:
            entries.insert(0 if item.is_joint_first else 1, self._elements.entry(joint))
        return entries

    def _is_plain(self, item: Item) -> bool:
        return id(item.element) in self._plain or id(item.joint) in self._plain


class Variables:
    """What repeats in a robot, and the variables it becomes.

    Attributes:
        declared: their entries.
    """

    def __init__(self, root: Element, *, without: Container[int] = ()) -> None:
        """Look for what repeats; `without` the materials of some identities."""
        self.declared = Body()
        self._taken: set[str] = set()
        self._folders: list[tuple[str, str]] = []
        self._materials: dict[tuple[tuple[str, str], ...], str] = {}
        folders: dict[str, list[str]] = {}
        for mesh in _all_named(root, "mesh"):
            file = values_of(mesh).get("filename", "")
            folder, slash, _ = file.rpartition("/")
            if slash and folder.strip("/.:"):
                scheme, separator, rest = file.rpartition("://")
                package = f"{scheme}{separator}{rest.partition('/')[0]}"
                folders.setdefault(package, []).append(folder)
        for package, found in folders.items():
            if len(found) < FEWEST_MESHES:
                continue
            steps = zip(*(folder.split("/") for folder in found), strict=False)
            common = "/".join(own[0] for own in takewhile(lambda own: len(set(own)) == 1, steps))
            if not common.startswith(package) or len(common) < len("$(meshes)"):
                continue
            stem = "meshes" if len(folders) == 1 else f"{package.rpartition('/')[2]}_meshes"
            variable = self._declare(stem, Quoted(common))
            self._folders.append((common, variable))
        self._folders.sort(key=lambda pair: -len(pair[0]))
        counts: dict[tuple[tuple[str, str], ...], int] = {}
        for owner in _all_named(root, "visual") + _all_named(root, "collision"):
            for material in owner.elements():
                if material.name != "material" or id(material) in without:
                    continue
                if not is_short_material(material):
                    continue
                attributes = _material_of(material)
                if len(attributes) > 1:
                    key = tuple(attributes.items())
                    counts[key] = counts.get(key, 0) + 1
        for key, count in counts.items():
            if count >= FEWEST_MATERIALS:
                entries = [Entry(name, Quoted(value)) for name, value in key]
                name = dict(key)["name"]
                self._materials[key] = self._declare(
                    name, Body(entries, in_braces=True, width=RECORD_WIDTH)
                )

    def file_name(self, file: str) -> str:
        """Return the name of a file in the language's spelling."""
        for folder, variable in self._folders:
            if file.startswith(folder + "/"):
                return f"$({variable}){file[len(folder) :]}"
        return file

    def material(self, material: Element) -> Entry | None:
        """Return a material in short, or None for one without a short form."""
        if is_short_material(material):
            variable = self._materials.get(tuple(_material_of(material).items()))
            if variable is not None:
                return Entry("material", f"$({variable})")
        return material_entry(material, self.file_name)

    def _declare(self, stem: str, value: Value) -> str:
        from ...syntax.names import is_identifier

        name = "".join(char if char.isalnum() or char == "_" else "_" for char in stem).lower()
        name = name.strip("_") or "material"
        if not is_identifier(name) or name in _PREDEFINED:
            name = f"{name}_" if is_identifier(f"{name}_") else f"material_{name}"
        unique, number = name, 2
        while unique in self._taken:
            unique, number = f"{name}_{number}", number + 1
        self._taken.add(unique)
        self.declared.add(unique, value)
        return unique


_PREDEFINED = frozenset("true false null pi tau e find env arg dirname cwd".split())


def _material_of(material: Element) -> dict[str, str]:
    """Return name, colour and texture of a material, as they are written."""
    attributes = {"name": values_of(material)["name"]}
    for child in material.elements():
        attributes[child.name] = " ".join(values_of(child).popitem()[1].split())
    return attributes


def _all_named(root: Element, name: str) -> list[Element]:
    return [element for element in root.iter() if element.name == name]


# --- files ------------------------------------------------------------------------------------


def read_file(path: str, limits: Limits, data: bytes | None = None) -> Source:
    """Return an XML file.

    Args:
        path: the file, or `-`.
        limits: how large it may be.
        data: its content, read from `path` if it is None.

    Raises:
        YamaroError: it is not in the encoding that it says.
        UsageError: it cannot be read.
    """
    if not path:
        raise UsageError("the file name is empty")
    absolute = "" if path == STANDARD_INPUT else os.path.abspath(path)
    try:
        if data is None:
            data = FileLoader(limits).read(absolute)
        check_size(len(data), limits)
    except LoadError as error:
        if error.hint is not None:
            raise refusal_of_main(path, error) from None
        raise UsageError(f"cannot read '{path}': {error}") from None
    name = STANDARD_INPUT_NAME if path == STANDARD_INPUT else path
    return decode_xml(data, name=name, path=absolute)


def migrate_file(
    path: str, limits: Limits, data: bytes | None = None, *, exact: bool = False
) -> Migration:
    """Return the Yamaro source of a URDF, or of any other XML; raises what `read_file` does.

    Raises:
        YamaroError: it is not XML.
    """
    return migrate_source(read_file(path, limits, data), limits, exact=exact)


def migrate_source(
    source: Source, limits: Limits, *, policy: Policy | None = None, exact: bool = False
) -> Migration:
    """Return the Yamaro source of an XML file that was read; raise YamaroError if it is not XML.

    With `exact`, poses that the file leaves out are left out of what the source makes.
    """
    stem = os.path.splitext(source.path)[0] or "robot"

    allowed: list[str] = []

    def build(text: str) -> Element:
        built, allowed[:] = build_allowing(
            lambda codes: Program(f"{stem}.yaml", text=text, policy=policy, allow=codes).build(
                on_message=ignore, meshes="keep"
            )
        )
        return built.root

    migration = migrate_urdf(read_xml(source, limits), build, exact=exact)
    migration.allowed = allowed
    return migration


def report(migration: Migration | XacroMigration, others: Mapping[str, int] | None = None) -> str:
    """Return what is said of a migration: how large the robot is, or in what it differs.

    With `others`, the numbers of other things than links and joints, by name.
    """
    if migration.differences:
        return "\n".join([f"different: {difference}" for difference in migration.differences])
    if migration.root.name != "robot":
        return "identical"
    children = migration.root.elements()
    links = sum(child.name == "link" for child in children)
    joints = sum(child.name == "joint" for child in children)
    counts = f"{_counted(links, 'link')}, {_counted(joints, 'joint')}"
    for what, number in (others or {}).items():
        counts += f", {_counted(number, what)}"
    if migration.defaults:
        counts += f"; {_counted(migration.defaults, 'default')} written out"
    if migration.allowed:
        counts += f"; parsers refuse it: build it with {options_to_allow(migration.allowed)}"
    return f"identical: {counts}"


def _counted(count: int, what: str) -> str:
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def ignore(message: str) -> None:
    """Take a message of a build."""
