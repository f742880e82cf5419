"""A file of xacro as a source: its header and sections, the order in them, elements and parts."""

from __future__ import annotations

import os
import re
from collections import Counter
from contextlib import contextmanager

from ....model.compare import is_used, prefixes_in
from ....syntax.names import STATEMENTS, is_identifier
from ....xacro.symbol_table import defined_in, macros_inside, names_in, used_in
from ....xml.tree import Comment, Element, Text
from ....xml.values import format_value
from ..document import Body, Entry, Quoted, Value, joined, literal
from ..elements import (
    ElementWriter,
    add_loose,
    comments_above,
    comments_at_ends,
    has_text,
    is_short,
    name_of,
    needs_brackets,
    note_comments,
    tidy_text,
    tidy_value,
)
from ..parts import Frames
from .contents import IN_PART
from .includes import write_include
from .parts import Step, XacroPartWriter, in_steps, is_statement, stands_as_key
from .python import CannotMigrate, Translator
from .statements import (
    PREDEFINED,
    Surroundings,
    is_late,
    names_of,
    write_argument,
    write_block,
    write_call,
    write_call_by_name,
    write_condition,
    write_macro,
    write_property,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterator
    from contextlib import AbstractContextManager

    from ....source import Span
    from ....xml.tree import Element, Node
    from ..elements import Endings
    from .contents import Content, Contents, Placing
    from .layout import Layout
    from .names import Callees
    from .parts import Solids, Write
    from .program import XacroProgram


class FileWriter(ElementWriter):
    """Writes what is in one file.

    Attributes:
        program: the robot that the file belongs to.
        contents: knows what statements make.
        solids: knows which macros compute the inertia of a solid.
        callees: knows what of a macro is read elsewhere.
        placing: knows which macros and blocks give things to parts only.
        path: of the file.
        layout: which files become sources, and where these are.
        translator: translates its expressions.
        here: what stands around what is being written.
        functions: those that the file defines.
        made_of: the names that variables are made of, by the identity of their entries.
        choices: the identities of the variables that two opposite conditions define.
        lost: what could not be carried over: where, why, and what is said below that.
    """

    def __init__(
        self,
        program: XacroProgram,
        contents: Contents,
        solids: Solids,
        callees: Callees,
        placing: Placing,
        path: str,
        layout: Layout,
    ) -> None:
        """Stand at the top of a file."""
        super().__init__(lambda file: file)
        self.program = program
        self.contents = contents
        self.solids = solids
        self.callees = callees
        self.placing = placing
        self.path = path
        self.layout = layout
        self.here = Surroundings(program)
        self.functions = Body()
        self.made_of: dict[int, set[str]] = {}
        self.choices: set[int] = set()
        self.lost: list[tuple[Span, str, str]] = []
        self.translator = Translator(
            program,
            rename=self.variable,
            argument=self.argument_name,
            is_namespace=self.is_namespace,
            data_folder=self._data_folder(),
        )

    def output_of(self, path: str) -> str:
        """Return the path of the source that a file becomes."""
        return self.layout.outputs[path]

    def _data_folder(self) -> str:
        """Return what stands before names of data here, if these are relative to another folder.

        To xacro they are relative to the file that calls the macro in which they stand.
        """
        bases = self.program.runs.bases.get(self.path, set())
        if len(bases) != 1 or os.path.dirname(self.path) in bases:
            return ""
        (base,) = bases
        output = self.layout.folder_of(base)
        own = os.path.dirname(self.output_of(self.path))
        return "" if output is None else f"{os.path.relpath(output, own or '.')}/"

    def is_namespace(self, name: str) -> bool:
        """Return whether a name is that of a namespace."""
        return name in self.program.namespaces.names(self.path)

    def scope_of(self, name: str) -> str:
        """Return the scope of something at the top of the file: that of what others use."""
        if not self.program.is_used_elsewhere(name, self.path):
            return ""
        return "/parent" if self.path in self.program.namespaces.inside else "/global"

    def variable(self, name: str) -> str:
        """Return the name of the variable that a property or argument becomes."""
        own = name if is_identifier(name) else name.replace("-", "_")
        return self.here.renamed.get(own, own)

    def argument_name(self, name: str) -> str:
        """Return the variable of an argument, which something else of its name may hide here."""
        if name not in self.here.hides:
            return self.variable(name)
        own = f"arg_{name.replace('-', '_')}"
        return self.here.renamed.get(own, own)

    def lose(self, span: Span, why: str, hint: str = "the sources have a comment there") -> None:
        """Note that something could not be carried over."""
        self.lost.append((span, why, hint))

    # --- bodies ---------------------------------------------------------------------------------

    def body(self, nodes: list[Node]) -> Body | None:
        """Return what is in an element."""
        with self.at(self.here.below_top()):
            body = self.statements(nodes)
        if not any(isinstance(node, Element) and node.name.startswith("xacro:") for node in nodes):
            body.in_braces = is_short(body)
        return body or None

    def statements(self, nodes: list[Node]) -> Body:
        """Return statements for what is in a file, a macro or an element."""
        body = Body()
        endings = comments_at_ends(nodes)
        nodes = in_order(nodes, endings, self.program)
        frames = Frames()
        has_parts = not self.here.is_in_element and self.here.place is None
        for step in in_steps(nodes, endings, self.contents) if has_parts else map(Step, nodes):
            node = step.node
            if isinstance(node, Comment):
                add_loose(node, body, endings)
            elif isinstance(node, Text):
                written = format_value(node.value)
                text = tidy_text(written)
                message = self._message(text)
                if message is not None:
                    body.add("print", message)
                elif text:
                    text = self._text(text, node.span)
                    before, after = " " * written[0].isspace(), " " * written[-1].isspace()
                    body.add("<#text>", f"{before}{text}{after}")
            elif isinstance(node, Element):
                body.latest = None
                try:
                    if not self._is_frame(step, frames, body):
                        self._statement(node, step, body)
                        last = body.entries[-1] if body.entries else None
                        if node.name == "link" and last is not None:  # frames below it go into it
                            name = name_of(node)
                            frames.begin(last, self.translate(name))
                        else:
                            frames.begin(None)
                except CannotMigrate as error:
                    self.lose(node.span, str(error))
                    body.note(f"not migrated: <{node.name}>: {error}")
        return body

    def _is_frame(self, step: Step, frames: Frames, body: Body) -> bool:
        """Return whether a link with its joint became a frame of the part above."""
        link, joint = step.node, step.joint
        if not isinstance(link, Element) or joint is None or self.here.place is not None:
            return False
        if any(map(is_statement, (*link.elements(), *joint.iter()))):
            return False
        writer = XacroPartWriter(self)
        return frames.take(writer.spelled(link), writer.spelled(joint), writer, body)

    def _statement(self, node: Element, step: Step, body: Body) -> None:
        if is_statement(node):
            handler = _HANDLERS.get(node.name, write_call)
            handler(self, node, body)
        elif self.here.place is not None:
            self.here.place(node, body)
        elif node.name != "link" or self.here.is_in_element:
            body.append(self.entry(node))
        else:
            known = len(self.lost)
            part = XacroPartWriter(self).entry(node, step.joint, joint_first=step.is_joint_first)
            if part is not None:
                body.append(part)
                return
            del self.lost[known:]
            both = [node] if step.joint is None else [step.joint, node]
            for each in both if step.is_joint_first else both[::-1]:
                body.append(self.entry(each))

    def write_statement(self, node: Element, body: Body, place: Write, *, has_keys: bool) -> None:
        """Write a statement, and the elements in it by `place`.

        Args:
            node: the statement.
            body: takes what it becomes.
            place: writes the elements that are right in it.
            has_keys: whether what the macros and blocks in it make may be keys of a part.
        """
        with self.within(place, holder=IN_PART if has_keys else None):
            self._statement(node, Step(node), body)

    @contextmanager
    def at(self, here: Surroundings) -> Iterator[None]:
        """Write with something else around."""
        around, self.here = self.here, here
        try:
            yield
        finally:
            self.here = around

    def within(
        self, place: Write | None, *, is_in_element: bool = False, holder: Content | None = None
    ) -> AbstractContextManager[None]:
        """Write the elements of a body by `place`, or else as the elements they are."""
        return self.at(self.here.within(place, is_in_element=is_in_element, holder=holder))

    def write_for_parts(self, node: Element, body: Body) -> None:
        """Write an element that may end up in a part, where it is to mean the same."""
        writer = XacroPartWriter(self)
        if self.here.holder in self.placing.in_parts and writer.write_piece(node, body):
            return
        own = writer.spelled(node)
        body.append(self.entry(node, bracketed=not stands_as_key(own)))

    def entry(self, element: Element, *, bracketed: bool = False) -> Entry:
        """Return an element, with its values translated."""
        attributes = self.values(element)
        children = element.children
        if any(isinstance(c, Element) and c.name == "xacro:attribute" for c in children):
            children = self.take_attributes(element, attributes)
        bracketed = bracketed or needs_brackets(element.name, attributes)
        key = self.key(element.name, attributes, bracketed=bracketed)
        entry = Entry(key, self.content(element, children))
        if isinstance(entry.value, str):
            note_comments(element, entry)
        return entry

    def values(self, element: Element) -> dict[str, str]:
        """Return the attributes of an element, except xacro's own."""
        return {
            name: tidy_value(name, self.translate(format_value(value)))
            for name, value in element.attributes.items()
            if not name.startswith(("xacro:", "xmlns:xacro"))
        }

    def content(self, element: Element, children: list[Node]) -> Value:
        """Return what is in an element: its text, or a body of these children."""
        if (
            has_text(element)
            and self._message(element.text().strip()) is None
            and all(isinstance(child, (Text, Comment)) for child in children)
        ):
            return self._text(tidy_text(element.text()), element.span)
        with self.within(None, is_in_element=True):
            return self.body(children)

    def translate(self, text: str) -> str:
        """Return a text of xacro in the language's spelling."""
        return self.translator.text(" ".join(text.split()) if "\n" in text else text)

    def _message(self, text: str) -> str | None:
        """Return what a text says to the user, if it does nothing else."""
        try:
            return self.translator.message(text) if "xacro." in text else None
        except CannotMigrate:
            return None

    def _text(self, text: str, span: Span) -> str:
        try:
            return self.translator.text(text)
        except CannotMigrate as error:
            self.lose(span, str(error))
            return literal(text)

    def take_attributes(self, element: Element, attributes: dict[str, str]) -> list[Node]:
        """Add what `<xacro:attribute>` gives to an element, and return its other children."""
        rest: list[Node] = []
        for child in element.children:
            if isinstance(child, Element) and child.name == "xacro:attribute":
                name = self.translator.text(name_of(child))
                attributes[name] = self.translator.text(format_value(child.attributes.get("value")))
            else:
                rest.append(child)
        return rest


def _write_element(writer: FileWriter, node: Element, body: Body) -> None:
    """Write an element whose name is computed."""
    name = writer.translator.text(format_value(node.attributes.get("xacro:name")))
    attributes = writer.values(node)
    children = writer.take_attributes(node, attributes)
    bracketed = "$(" in name or needs_brackets(name, attributes)
    key = writer.key(name, attributes, bracketed=bracketed)
    body.append(Entry(key, writer.content(node, children)))


_HANDLERS: dict[str, Callable[[FileWriter, Element, Body], None]] = {
    "xacro:arg": write_argument,
    "xacro:property": write_property,
    "xacro:macro": write_macro,
    "xacro:insert_block": write_block,
    "xacro:if": write_condition,
    "xacro:unless": write_condition,
    "xacro:include": write_include,
    "xacro:element": _write_element,
    "xacro:call": write_call_by_name,
}


# --- order ------------------------------------------------------------------------------------
# xacro evaluates a property when it is read first, so that one may be made of names that are
# defined further down. A variable is evaluated where it is declared: it has to follow those names.


def in_order(nodes: list[Node], endings: Endings, program: XacroProgram) -> list[Node]:
    """Return what is in one place, properties behind what their values are made of.

    They take along the comments above them, and those at the ends of their lines (`endings`).
    """
    elements = [node for node in nodes if isinstance(node, Element)]
    if not any(element.name == "xacro:property" for element in elements):
        return nodes
    defined = {id(element): _defined_by(element, program) for element in elements}
    moved: dict[int, list[Node]] = {}
    """Properties by what they have to follow."""
    for index, element in enumerate(elements):
        if _is_lazy(element):
            rest = elements[index + 1 :]
            last = _last_needed(element, elements[:index], rest, defined, program)
            if last is not None:
                moved.setdefault(id(last), []).append(element)
    if not moved:
        return nodes
    away = {id(element) for row in moved.values() for element in row}
    result: list[Node] = []

    # each element with what is around it, by identity, and what comes last under 0
    groups: dict[int, list[Node]] = {}
    above: list[Node] = []
    latest: list[Node] = []
    for each in nodes:
        if isinstance(each, Element):
            latest = groups[id(each)] = [*above, each]
            above = []
        elif latest and endings.get(id(each)) == "following":
            latest += [*above, each]
            above = []
        else:
            above.append(each)
    groups[0] = above

    def put(node: Node) -> None:
        result.extend(groups[id(node)])
        for element in moved.get(id(node), ()):
            put(element)

    for element in elements:
        if id(element) not in away:
            put(element)
    return result + groups[0]


def _is_lazy(element: Element) -> bool:
    given = element.attributes
    return (
        element.name == "xacro:property"
        and "$" in format_value(given.get("value"))
        and "scope" not in given
        and format_value(given.get("lazy_eval", "true")).lower() in ("true", "1")
    )


def _defined_by(element: Element, program: XacroProgram) -> set[str]:
    """Return the names that an element defines where it stands, or what it includes or calls."""
    if element.name == "xacro:macro":
        return set()
    includes = [own for own in element.iter() if own.name == "xacro:include"]
    names = defined_in(element) | program.handed_to(element)
    for path in program.namespaces.reached_by(includes):
        names |= defined_in(program.roots[path])
    return names


def _last_needed(
    element: Element,
    before: list[Element],
    after: list[Element],
    defined: dict[int, set[str]],
    program: XacroProgram,
) -> Element | None:
    """Return the last of the elements below that a property needs, if it needs one."""
    own = name_of(element)
    known = set().union(*(defined[id(each)] for each in before))
    needed = names_in(format_value(element.attributes["value"])) - known - {own}
    last = None
    for index, each in enumerate(after):
        new = defined[id(each)] & needed
        if new:
            last = index
            needed -= new
    if last is None:
        return None
    between = after[: last + 1]
    is_read = any(own in _read_by(each, program) for each in between)
    is_defined_again = any(own in defined[id(each)] for each in between)
    return None if is_read or is_defined_again else after[last]


def _read_by(element: Element, program: XacroProgram) -> set[str]:
    """Return the names that are read where an element stands, also by what it calls or includes."""
    names: set[str] = set()
    seen: set[int] = set()
    pending = [element]
    while pending:
        root = pending.pop()
        if root.name == "xacro:property" or id(root) in seen:
            continue
        seen.add(id(root))
        inside = macros_inside(root)
        if root is not element or root.name != "xacro:macro":
            names |= used_in(root, without=inside)
            pending += [
                program.roots[own] if isinstance(own, str) else own.element
                for own in program.reached_from(root, inside)
            ]
    return names


# --- header and sections ----------------------------------------------------------------------


def sections_of(writer: FileWriter, *, is_main: bool) -> Body:
    """Return the sections of the file."""
    root = writer.program.roots[writer.path]
    sections = Body()
    declared = _arguments(writer) if is_main else Body()
    writer.here.hides = writer.program.hidden.everywhere
    model = writer.statements(root.children)
    _take_variables(writer, model, declared)
    _take_later_variables(writer, model, declared)
    if writer.translator.imports:
        sections.add("import", f"[{', '.join(sorted(writer.translator.imports))}]")
    if declared:
        sections.add("variables", declared)
    if writer.functions:
        sections.add("functions", writer.functions)
    if is_main:
        _add_root(writer, root, sections, model)
    elif model or not sections:
        sections.add("model", model or None)
    for comment in writer.program.files.documents[writer.path].after:
        sections.note(tidy_text(comment.text))
    return sections


def header_of(writer: FileWriter, *, is_main: bool) -> str:
    """Return the comment above the file."""
    header = comments_above(writer.program.files.documents[writer.path])
    root = writer.program.roots[writer.path]
    if is_main or all(element.name != "xacro:arg" for element in root.iter()):
        return header
    folder = os.path.dirname(writer.output_of(writer.path))
    main = os.path.relpath(writer.output_of(writer.program.main), folder)
    return joined(header, f"the arguments are declared in {main}")


def _arguments(writer: FileWriter) -> Body:
    """Return the arguments of all files, which the main file declares."""
    body = Body()
    for name, argument in writer.program.arguments.items():
        if is_late(writer, name):
            body.note(argument.remark)
            body.add(f"{writer.variable(name)}/global")
            body.note_end(argument.ending)
            continue
        try:
            default = argument.default
            is_python = writer.program.is_python(name)
            translated = writer.translator.value
            value = f"$({default.strip()})" if is_python else translated(default, name)
            if name in writer.program.spelled:
                value = Quoted(default)
        except CannotMigrate as error:
            writer.lose(argument.span, str(error))
            continue
        body.note(argument.remark)
        scope = writer.scope_of(name) if writer.program.is_shared_argument(name) else ""
        if name in writer.program.hidden.replaced:
            scope = "/global"  # so that it does not hide the property of its name
        body.add(writer.variable(name) + scope, value or "")
        body.note_end(argument.ending)
    for name in writer.program.arguments:
        if name in writer.program.hidden.used:
            own = writer.variable(name)
            body.add(f"arg_{own}{writer.scope_of(name)}", f"$({own})")
    return body


def _take_variables(writer: FileWriter, model: Body, declared: Body) -> None:
    """Take the first variables of a model to those declared for the file, if that is the same.

    They may follow includes if these define none of them, and nothing that they read, and
    behind elements without statements, such as materials.
    """
    for index, entry in enumerate(model.entries):
        if entry.key == "variables":
            assert isinstance(entry.value, Body)
            if index and writer.path in writer.program.included_by_macros:
                return  # a macro may have given them values before
            if names_of(entry.value) & writer.program.names_of_includers(writer.path):
                return  # what a macro passes comes before what is declared for the file
            if index and not _is_independent(writer, entry.value, declared):
                return
            if names_of(entry.value) & names_of(declared):
                return
            declared.note(entry.comment)
            declared.extend(entry.value)
            del model.entries[index]
            return
        if entry.key != "include" and not _is_constant(entry):
            return


def _take_later_variables(writer: FileWriter, model: Body, declared: Body) -> None:
    """Take variables further down to those declared for the file, if they do not depend on it.

    They are defined once, and made of nothing but variables above that are.
    """
    found = [(entry, entry.value) for entry in model if entry.key == "variables"]
    blocks = [(entry, value) for entry, value in found if isinstance(value, Body)]
    below = Counter(name for _, variables in blocks for name in names_of(variables))
    for entry, variables in blocks:
        if variables.remark or variables.opening or entry.ending:
            continue
        first = variables.entries[0] if variables.entries else None
        for own in list(variables):
            if _depends_on_nothing(writer, own, declared, below):
                below -= Counter(names_of([own]))
                comment = entry.comment if own is first else ""
                if own is first:
                    entry.comment = ""
                variables.entries.remove(own)
                own.comment = joined(comment, own.comment)
                declared.append(own)
        if not variables.entries:
            model.entries.remove(entry)


def _depends_on_nothing(
    writer: FileWriter, variable: Entry, declared: Body, below: Container[str]
) -> bool:
    """Return whether a variable may as well be declared above the model, with those `below` in it.

    What it is made of may have the name of an argument, and be declared in the model.
    """
    program = writer.program
    (name,) = names_of([variable])
    known = names_of(declared)
    if name in known or name in program.arguments or not isinstance(variable.value, str):
        return False
    if name in program.names_of_includers(writer.path):
        return False
    words = set(re.findall(r"[^\W\d]\w*", variable.value)) if "$(" in variable.value else set()
    made_of = {word for word in words if word in program.properties or word in program.arguments}
    late = {own for own in made_of if is_late(writer, own)}
    fixed = {own for own in (name, *made_of) if own not in program.assigned_from_inside}
    return (
        made_of <= known
        and not any(own in below for own in made_of)
        and not late
        and len(fixed) == 1 + len(made_of)
        and program.times_defined.get(name, 1) == (2 if id(variable) in writer.choices else 1)
        and all(program.times_defined.get(own, 1) == 1 for own in made_of)
        and not words & program.namespaces.names(writer.path)
        and not any(word.startswith("arg_") for word in words)
    )


def _is_constant(entry: Entry) -> bool:
    """Return whether an entry is an element in which nothing is a statement."""
    name = entry.key.lstrip("<").partition("/")[0].rstrip(">")
    if name in STATEMENTS or not name[:1].islower():
        return False
    return not isinstance(entry.value, Body) or all(map(_is_constant, entry.value))


def _is_independent(writer: FileWriter, variables: Body, declared: Body) -> bool:
    """Return whether no other file defines variables, nor what they are made of."""
    names = names_of(variables)
    known = names | names_of(declared) | PREDEFINED
    made_of = set().union(*(writer.made_of.get(id(entry), set()) for entry in variables))
    return made_of <= known and all(
        len(writer.program.properties.get(name, ())) <= 1 for name in names
    )


def _add_root(writer: FileWriter, root: Element, sections: Body, model: Body) -> None:
    """Add the robot's name and the model, or the root element with what is in it."""
    attributes = {
        name: writer.translator.text(format_value(value))
        for name, value in root.attributes.items()
        if not name.startswith(("xmlns:xacro", "xacro:"))
    }
    used = None if writer.program.exact else prefixes_in(writer.program.result)
    for name, value in writer.program.result.attributes.items():
        if name.startswith("xmlns:"):  # other files may declare prefixes
            attributes.setdefault(name, literal(format_value(value)))
    attributes = {name: value for name, value in attributes.items() if is_used(name, used)}
    namespace = root.attributes.get("xacro:targetNamespace")
    if namespace:
        attributes["xmlns"] = writer.translator.text(format_value(namespace))
    if root.name == "robot" and list(attributes) == ["name"]:
        robot = Entry("robot", attributes["name"])
        robot.ending, model.opening = model.opening, ""
        sections.entries.insert(0, robot)
        sections.add("model", model or None)
        return
    key = writer.key(root.name, attributes, bracketed="name" not in attributes)
    sections.add(key, model or None)
