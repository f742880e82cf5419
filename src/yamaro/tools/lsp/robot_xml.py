"""URDF and xacro: what each name means in all files of a robot, and what is known of it."""

from __future__ import annotations

import os
import re

from ...source import Source, Span
from ...xacro.names import PACKAGE, PARAMETER, TAGS, Name, XacroNames
from ...xacro.symbol_table import ARGUMENT, MACRO, PROPERTY, definition_of
from ...xml.tree import Comment, Element, Text
from ...xml.values import format_value
from .contexts import about
from .parts import about_joint, about_link
from .xml_names import format_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from ...model.robot import Robot
    from .workspace import Text as OpenText
    from .workspace import Workspace

LINK, JOINT, BODY, MATERIAL = "link", "joint", "body", "material"
"""Kinds of names in URDF, besides those of xacro; a body is a link or a joint."""
_OF_ROBOT = {LINK: (LINK,), JOINT: (JOINT,), BODY: (LINK, JOINT), MATERIAL: (MATERIAL,)}
_REFERENCES = {
    **dict.fromkeys(("link", "link1", "link2", "base_link", "tip_link", "parent_link"), LINK),
    "child_link": LINK,
    "joint": JOINT,
    "reference": BODY,
}
"""Attributes that name a link or joint, whatever they are in."""
_MAY_REFER = re.compile("link|joint|parent|child|reference|frame|body", re.IGNORECASE)
"""Parameters of macros, and elements for other programs, that may name a link or joint."""
_LISTS = ("group", "end_effector", "group_state", "transmission", "ros2_control")
"""Elements in which a link or joint is only named."""
_LOADED = re.compile(r"load_yaml\(\s*(['\"])([^'\"]*)\1")
MOST_VALUES = 5
MOST_BODIES = 3
"""Values of one name, and links or joints at one place, that are shown."""


class RobotNames:
    """The names in a file.

    Attributes:
        found: those of xacro, then links, joints and materials.
        computed: where a `${…}` or `$(…)` is written.
        definitions: those of them that define something, by name.
    """

    def __init__(self, root: Element | None) -> None:
        """Look through a file that holds URDF or xacro; there is nothing in any other."""
        self.found: list[Name] = []
        self.computed: list[Span] = []
        self.definitions: dict[str, list[Name]] = {}
        if root is None or format_of(root):
            return
        names = XacroNames(root)
        self.found, self.computed = names.found, names.computed
        pending: list[tuple[Element, str, Element | None]] = [(root, "", None)]
        while pending:
            element, around, macro = pending.pop()
            macro = element if element.name == "xacro:macro" else macro
            self._take(element, around, macro)
            is_list = element.name in _LISTS or around in _LISTS
            inside = around if is_list and around else element.name
            pending += [(child, inside, macro) for child in reversed(element.elements())]
        for each in self.found:
            if each.is_definition:
                self.definitions.setdefault(each.name, []).append(each)

    def _take(self, element: Element, around: str, macro: Element | None) -> None:
        name = element.name
        for attribute, value in element.attributes.items():
            kind, is_definition = kind_of_attribute(name, attribute), False
            if attribute == "name" and kind:
                inner = {each.name for each in element.elements()}
                is_definition = around not in _LISTS
                if name == JOINT and "type" not in element.attributes:
                    is_definition = is_definition and bool(inner & {"parent", "child"})
                elif name == MATERIAL:
                    is_definition = bool(inner)
            if kind and value:
                self.found.append(
                    Name(kind, format_value(value), element.value_span(attribute), element, macro,
                         is_definition=is_definition)
                )  # fmt: skip
        if _MAY_REFER.search(name) and not element.elements():
            for child in element.children:
                written = format_value(child.value).strip() if isinstance(child, Text) else ""
                if written and " " not in written:
                    span = child.span
                    start = span.start + max(span.written().find(written), 0)
                    place = Span(span.source, start, start + len(written))
                    self.found.append(Name(BODY, written, place, element, macro))

    def at(self, offset: int) -> Name | Span | None:
        """Return the name or the computed stretch that an offset is in: the shortest one.

        One that ends at the offset counts if there is no other.
        """
        places: list[tuple[Span, Name | Span]] = [(each.span, each) for each in self.found]
        places += [(each, each) for each in self.computed]
        within = [each for each in places if each[0].start <= offset <= each[0].end]
        return min(within, key=lambda each: _nearness(each[0], offset))[1] if within else None

    def computed_at(self, offset: int) -> Span | None:
        """Return the innermost `${…}` or `$(…)` that an offset is in."""
        within = [each for each in self.computed if each.start <= offset <= each.end]
        return min(within, key=lambda each: _nearness(each, offset), default=None)


def _nearness(span: Span, offset: int) -> tuple[bool, int]:
    return span.end == offset, span.end - span.start


def kind_of_attribute(tag: str, attribute: str) -> str:
    """Return the kind of what an attribute names: LINK, JOINT, BODY or MATERIAL, else ""."""
    if tag.startswith("xacro:"):
        is_call = tag.removeprefix("xacro:") not in TAGS
        return BODY if is_call and _MAY_REFER.search(attribute) else ""
    if attribute == "name":
        return tag if tag in (LINK, JOINT, MATERIAL) else ""
    return _REFERENCES.get(attribute, "")


class RobotFiles:
    """The URDF and xacro files that are read together."""

    def __init__(self, workspace: Workspace, path: str) -> None:
        """Take all files of the programs that a file is in."""
        self._workspace = workspace
        self.texts = [
            text
            for text in workspace.program_of(path)
            if not text.is_yaml and not format_of(text.xml)
        ]

    def defined(self, *kinds: str) -> Iterator[tuple[OpenText, Name]]:
        """Yield the definitions of some kinds in all files."""
        for text in self.texts:
            for each in text.robot_names.found:
                if each.is_definition and each.kind in kinds:
                    yield text, each

    def named(self, name: str, *kinds: str) -> list[tuple[OpenText, Name]]:
        """Return the definitions of a name in all files."""
        return [
            (text, each)
            for text in self.texts
            for each in text.robot_names.definitions.get(name, ())
            if each.kind in kinds
        ]

    # --- what a name means ------------------------------------------------------------------

    def definitions(self, text: OpenText, name: Name) -> list[tuple[OpenText, Name]]:
        """Return where what a name means is defined, as far as that is written."""
        if name.is_definition and name.kind in (MACRO, PARAMETER):
            return [(text, name)]
        if name.kind in _OF_ROBOT:
            return self.named(name.name, *_OF_ROBOT[name.kind])
        if name.kind in (MACRO, ARGUMENT):
            return self.named(name.name, name.kind)
        if name.kind == PARAMETER:
            return [
                (own, each)
                for own, each in self.named(name.name, PARAMETER)
                if _name_of(each.element) == name.owner
            ]
        return self._values(text, name) if name.kind == PROPERTY else []

    def _values(self, text: OpenText, name: Name) -> list[tuple[OpenText, Name]]:
        """Return where a property or parameter is defined: in the macro, outside, or by callers."""
        found = self.named(name.name, PROPERTY, PARAMETER)
        macro = name.macro
        if macro is not None and (macro is not name.element or name.is_definition):
            inner = [each for each in found if each[1].macro is macro]
            if inner:
                return inner
        outside = [each for each in found if each[1].macro is None]
        if name.space:
            paths = list(self.in_namespace(text, name.space))
            return [each for each in outside if each[0].path in paths]
        if outside:
            return sorted(outside, key=lambda each: each[0] is not text)
        for_others = [each for each in found if "scope" in each[1].element.attributes]
        return for_others or found

    def in_namespace(self, text: OpenText, space: str) -> Iterator[str]:
        """Yield the paths of the files that a file includes into a namespace."""
        for element in text.xml.iter() if text.xml is not None else ():
            if element.name == "xacro:include" and element.attributes.get("ns") == space:
                path = path_at(self._workspace, text, element.value_span("filename"))
                if path is not None:
                    yield path

    def places(self, text: OpenText, name: Name) -> list[tuple[Span, bool]]:
        """Return all places that mean the same, and whether each defines it."""
        meant = {_key(each) for _, each in self.definitions(text, name)} or {_key(name)}
        is_of_robot = name.kind in _OF_ROBOT or name.kind == PACKAGE
        found = []
        for own in self.texts:
            same = [
                each
                for each in own.robot_names.found
                if each.name == name.name and _group(each) == _group(name)
            ]
            for each in same:
                definitions = [] if is_of_robot else self.definitions(own, each)
                keys = {_key(other) for _, other in definitions} or {_key(each)}
                if is_of_robot or keys & meant:
                    found.append((each.span, each.is_definition))
        return found

    # --- in the last builds -----------------------------------------------------------------

    def bodies(self, text: OpenText, name: Name) -> list[tuple[Robot, str, str]]:
        """Return the links and joints that a name means in the last builds: robot, kind, name."""
        found = []
        for result in self._workspace.results_of(text.path):
            robot = result.robot
            if robot is None:
                continue
            at = result.offset_then(text, name.span.start)
            plain = {} if "$" in name.name else {name.name: None}
            for value in result.values.written.get((text.path, at), plain):
                known = {LINK: robot.links, JOINT: robot.joints}
                found += [
                    (robot, kind, value)
                    for kind in _OF_ROBOT[name.kind]
                    if value in known.get(kind, ())
                ]
        return found


def _key(name: Name) -> tuple[str, int]:
    return name.span.source.path, name.span.start


def _group(name: Name) -> str:
    return PROPERTY if name.kind == PARAMETER else name.kind


def _name_of(macro: Element) -> str:
    defined = definition_of(macro)
    return defined.name if defined is not None else ""


# --- definitions and references ---------------------------------------------------------------


def definitions_in_robot(workspace: Workspace, text: OpenText, offset: int) -> list[Span]:
    """Return where what is at an offset of a URDF or xacro file is defined."""
    found = text.robot_names.at(offset) or _end_tag(text, offset)
    if not isinstance(found, Name):
        return []
    if found.kind == PACKAGE:
        folder = workspace.package(found.name, text.folder)
        manifest = os.path.join(folder, "package.xml") if folder is not None else ""
        return [Span(Source("", name=manifest, path=manifest), 0, 0)] if manifest else []
    files = RobotFiles(workspace, text.path)
    spans = [each.span for _, each in files.definitions(text, found)]
    if spans or found.kind not in (LINK, JOINT, BODY):
        return spans
    for robot, kind, name in files.bodies(text, found):  # a name that a macro makes
        element = (robot.links if kind == LINK else robot.joints)[name].element
        span = element.value_span("name")
        if span.source.path:
            spans.append(span)
    return spans


def places_in_robot(workspace: Workspace, text: OpenText, offset: int) -> list[tuple[Span, bool]]:
    """Return the places that mean what is at an offset, and whether each defines it."""
    found = text.robot_names.at(offset) or _end_tag(text, offset)
    if not isinstance(found, Name):
        return []
    return RobotFiles(workspace, text.path).places(text, found)


def _end_tag(text: OpenText, offset: int) -> Name | None:
    """Return the name of the macro whose call ends at an offset."""
    start = text.text.rfind("</xacro:", 0, offset + 1)
    if start < 0 or ">" in text.text[start:offset]:
        return None
    tag = next((each for each in text.tags.found if each.close == start), None)
    if tag is None:
        return None
    return next(
        (
            each
            for each in text.robot_names.found
            if each.kind == MACRO and tag.start < each.span.start <= tag.end
        ),
        None,
    )


def path_at(workspace: Workspace, text: OpenText, span: Span) -> str | None:
    """Return the file that a path in an XML file means, with what the last builds computed in it.

    It may be missing.
    """
    path = span.written()
    if "$" not in path:
        return workspace.resolve(text, path)
    known = workspace.resolve(text, path)
    if known is not None:
        return known
    pieces, at = [], span.start
    for computed in sorted(text.robot_names.computed, key=lambda each: each.start):
        if at <= computed.start and computed.end <= span.end:
            values = values_of(workspace, text, computed, computed.written())
            if not values:
                return None
            pieces += [text.text[at : computed.start], next(iter(values))]
            at = computed.end
    return workspace.resolve(text, "".join([*pieces, text.text[at : span.end]]))


def loaded_files(text: OpenText) -> Iterator[Span]:
    """Yield the paths of files that expressions load."""
    for computed in text.robot_names.computed:
        for found in _LOADED.finditer(computed.written()):
            start = computed.start + found.start(2)
            yield Span(text.source, start, start + len(found[2]))


# --- hovers -----------------------------------------------------------------------------------


def values_of(workspace: Workspace, text: OpenText, span: Span, name: str) -> dict[str, None]:
    """Return the values that a name had where it is defined, or a stretch that is computed."""
    values: dict[str, None] = {}
    for result in workspace.results_of(text.path):
        at = result.offset_then(text, span.start)
        values.update(result.values.set.get((text.path, at, name), {}))
    return values


def hover_in_robot(
    workspace: Workspace, text: OpenText, offset: int
) -> tuple[list[str], Span | None]:
    """Return lines of Markdown on what is at an offset of a URDF or xacro file, and its place."""
    if text.is_foreign:
        return [], None
    found = text.robot_names.at(offset) or _end_tag(text, offset)
    if found is None:
        return _of_attribute(text, offset)
    lines: list[str] = []
    span = found.span if isinstance(found, Name) else found
    if isinstance(found, Name):
        lines = _about_name(workspace, text, found)
    computed = text.robot_names.computed_at(offset)
    if computed is not None:
        values = values_of(workspace, text, computed, computed.written())
        written = computed.written()
        if values and not (lines and isinstance(found, Name) and written[2:-1] == found.name):
            lines.append(f"`{_short(written)}` is {listed(values)}")
    if not lines:
        return _of_attribute(text, offset)
    return lines, span


def _about_name(workspace: Workspace, text: OpenText, name: Name) -> list[str]:
    if name.kind == PACKAGE:
        folder = workspace.package(name.name, text.folder)
        return [f"**{name.name}** (package)", f"`{folder}`"] if folder is not None else []
    files = RobotFiles(workspace, text.path)
    definitions = files.definitions(text, name)
    if name.kind in (LINK, JOINT, BODY):
        return _about_bodies(files, text, name)
    if name.kind == MATERIAL:
        return _about_material(workspace, text, name, definitions)
    if not definitions:
        return []
    own, first = definitions[0]
    if first.kind == MACRO:
        return _about_macro(own, first, text)
    title = f"**{first.name}** ({first.kind}{_whereabouts(own, first, text)})"
    lines = [title]
    if first.kind == PARAMETER:
        lines += _default_of(first)
    else:
        lines.append(f"```xml\n{tag_text(first.element)}\n```")
    comment = comment_above(own, first.element)
    if comment and first.kind != PARAMETER:
        lines.append(comment)
    values: dict[str, None] = {}
    for where, each in definitions:
        values.update(values_of(workspace, where, each.span, each.name))
    if values:
        lines.append(f"value: {listed(values)}")
    return lines


def _whereabouts(own: OpenText, name: Name, text: OpenText) -> str:
    """Return the macro that a name is of, and the file if that is another one."""
    of = f" of `{_name_of(name.macro)}`" if name.macro is not None and name.kind != MACRO else ""
    return of if own is text else f"{of}, {os.path.basename(own.path)}"


def _default_of(name: Name) -> list[str]:
    defined = definition_of(name.element)
    for each in defined.parameters() if defined is not None else ():
        if each.name.lstrip("*") == name.name:
            if each.is_block:
                return ["a block: an element in the call"]
            if each.is_forwarded:
                other = f", else `{each.default}`" if each.default is not None else ""
                return [f"default: what the caller has{other}"]
            return [f"default: `{each.default}`"] if each.default is not None else []
    return []


def parameter_texts(macro: Element) -> list[str]:
    """Return the parameters of a macro as they are to be shown: with their defaults."""
    defined = definition_of(macro)
    texts = []
    for each in defined.parameters() if defined is not None else ():
        default = "^" if each.is_forwarded else ""
        default += "|" if each.is_forwarded and each.default is not None else ""
        default += each.default or ""
        texts.append(f"{each.name}:={default}" if default else each.name)
    return texts


def _about_macro(own: OpenText, name: Name, text: OpenText) -> list[str]:
    lines = [f"**{name.name}** (macro{_whereabouts(own, name, text)})"]
    parameters = parameter_texts(name.element)
    lines.append("\n".join(f"- `{each}`" for each in parameters) or "without parameters")
    comment = comment_above(own, name.element)
    return [*lines, comment] if comment else lines


def _about_bodies(files: RobotFiles, text: OpenText, name: Name) -> list[str]:
    bodies = files.bodies(text, name)
    lines = []
    for robot, kind, own in bodies[:MOST_BODIES]:
        joint = robot.joints.get(own) if kind == JOINT else None
        what = f"{joint.type} joint" if joint is not None else kind
        about_it = about_link(robot, robot.links[own]) if joint is None else about_joint(joint)
        rows = about_it.partition("\n")[2]  # its name is in the title
        lines += [f"**{own}** ({what})", *([rows] if rows else [])]
    if len(bodies) > MOST_BODIES:
        names = ", ".join(f"`{own}`" for _, _, own in bodies[MOST_BODIES : MOST_BODIES + 20])
        lines.append(f"also {names}")
    return lines


def _about_material(
    workspace: Workspace, text: OpenText, name: Name, definitions: list[tuple[OpenText, Name]]
) -> list[str]:
    for result in workspace.results_of(text.path):
        at = result.offset_then(text, name.span.start)
        values = result.values.written.get((text.path, at), {name.name: None})
        materials = result.robot.materials if result.robot is not None else {}
        for own in (materials[value] for value in values if value in materials):
            color = f"rgba {' '.join(f'{part:.4g}' for part in own.color)}" if own.color else ""
            texture = f"texture `{own.texture}`" if own.texture else ""
            rows = [row for row in (color, texture) if row]
            return [f"**{own.name}** (material)", "\n".join(f"- {row}" for row in rows)]
    return [f"```xml\n{tag_text(each.element)}\n```" for _, each in definitions[:1]]


def _of_attribute(text: OpenText, offset: int) -> tuple[list[str], Span | None]:
    """Return what the manual says of the attribute that an offset is in."""
    tag = next((each for each in text.tags.found if each.start < offset <= each.end), None)
    if tag is None or text.xml is None:
        return [], None
    for element in text.xml.iter():
        if element.span.start != tag.start + 1:
            continue
        for attribute in element.attributes:
            span = element.name_span(attribute)
            if span.start <= offset <= element.value_span(attribute).end:
                known = about(element.name, attribute)
                return ([f"**{attribute}**: {known}"] if known is not None else []), span
    return [], None


def listed(values: Iterable[str]) -> str:
    """Return some values as Markdown, not all if there are many."""
    shown = list(values)
    text = ", ".join(f"`{_short(value)}`" for value in shown[:MOST_VALUES])
    return f"{text}, …" if len(shown) > MOST_VALUES else text


def _short(text: str) -> str:
    text = " ".join(text.split()).replace("`", "'") or "''"
    return text if len(text) <= 200 else f"{text[:199]}…"


def tag_text(element: Element) -> str:
    """Return a start tag as it is written, on one line."""
    attributes = "".join(f' {name}="{value}"' for name, value in element.attributes.items())
    return f"<{element.name}{attributes}>"[:400]


def comment_above(text: OpenText, element: Element) -> str:
    """Return the comments that are right above an element, as text."""
    for around in text.xml.iter() if text.xml is not None else ():
        if not any(child is element for child in around.children):
            continue
        index = next(i for i, child in enumerate(around.children) if child is element)
        found: list[str] = []
        for child in reversed(around.children[:index]):
            if isinstance(child, Comment):
                found.append(" ".join(child.text.split()))
                continue
            written = "" if isinstance(child, Element) else format_value(child.value)
            if isinstance(child, Element) or written.strip() or written.count("\n") > 1:
                break
        return "\n".join(each for each in reversed(found) if each)[:1000]
    return ""
