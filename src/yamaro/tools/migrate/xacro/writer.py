"""The statements of a file in xacro: elements, parts, conditions, and what other modules write."""

from __future__ import annotations

import os
from contextlib import contextmanager

from ....syntax.names import is_identifier
from ....xml.tree import Comment, Element, Text
from ....xml.values import format_value
from ..document import Body, Entry, Value, joined, literal
from ..elements import (
    ElementWriter,
    add_loose,
    comments_at_ends,
    is_short,
    needs_brackets,
    note_comments,
    tidy_text,
    tidy_value,
)
from ..frames import Frames
from ..pairing import has_text
from .calls import write_block, write_call, write_call_by_name
from .conditions import write_condition
from .definitions import write_argument, write_macro, write_property
from .includes import write_include
from .order import in_order
from .parts import Step, XacroPartWriter, in_steps, is_statement, stands_as_key
from .placing import IN_PART
from .python import CannotMigrate, Translator
from .surroundings import Surroundings

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from contextlib import AbstractContextManager

    from ....source import Span
    from ....xml.tree import Node
    from ..elements import Endings
    from .callees import Callees
    from .contents import Contents
    from .inertia import Solids
    from .layout import Layout
    from .parts import Write
    from .placing import Content, Placing
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
            self.variable,
            self.is_namespace,
            program.is_shown_as_truth,
            program.truth_arguments,
            program.numbers,
            program.truth_texts,
        )
        self.translator.argument = self.argument_name
        self.translator.is_number = program.is_number
        self.translator.is_text = program.is_text
        self.translator.data_folder = self._data_folder()
        self.translator.long_floats = program.runs.python.long_floats
        self.translator.computed = program.computed
        self.translator.copied = program.copied
        self.translator.spelled = program.spelled
        self.translator.is_typed_argument = program.is_typed_argument

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
        for step in self._steps(nodes, endings):
            node = step.node
            if isinstance(node, Comment):
                add_loose(node, body, endings)
            elif isinstance(node, Text):
                self._write_text(node, body)
            elif isinstance(node, Element):
                body.latest = None
                try:
                    if not self._is_frame(step, frames, body):
                        self._statement(node, step, body)
                        self._note_part(step, frames, body)
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
        writer = self.part_writer()
        frame = frames.take(writer.spelled(link), writer.spelled(joint), writer)
        if frame is None:
            return False
        frame.comment, body.remark = joined(body.remark, frame.comment), ""
        body.latest = frame
        return True

    def _note_part(self, step: Step, frames: Frames, body: Body) -> None:
        """Note the part that was written, into which frames below it go."""
        node = step.node
        last = body.entries[-1] if body.entries else None
        if isinstance(node, Element) and node.name == "link" and last is not None:
            frames.begin(last, self._translate(format_value(node.attributes.get("name"))))
        else:
            frames.begin(None)

    def _write_text(self, node: Text, body: Body) -> None:
        """Write a text between elements; the space around it keeps it from others."""
        written = format_value(node.value)
        text = tidy_text(written)
        message = self._message(text)
        if message is not None:
            body.add("print", message)
        elif text:
            text = self._text(text, node.span)
            before, after = " " * written[0].isspace(), " " * written[-1].isspace()
            body.add("<#text>", f"{before}{text}{after}")

    def _steps(self, nodes: list[Node], endings: Endings) -> Iterable[Step]:
        """Return what is written one after the other: links with their joints, where they stand."""
        if self.here.is_in_element or self.here.place is not None:
            return map(Step, nodes)
        return in_steps(nodes, endings, self.contents)

    def _statement(self, node: Element, step: Step, body: Body) -> None:
        if is_statement(node):
            handler = _HANDLERS.get(node.name, write_call)
            handler(self, node, body)
        elif self.here.place is not None:
            self.here.place(node, body)
        elif node.name != "link" or self.here.is_in_element:
            body.append(self.entry(node))
        else:
            for entry in self._part(node, step):
                body.append(entry)

    def _part(self, link: Element, step: Step) -> list[Entry]:
        """Return a link and its joint as a part, or as the elements that they are."""
        known = len(self.lost)
        part = self.part_writer().entry(link, step.joint, joint_first=step.is_joint_first)
        if part is not None:
            return [part]
        del self.lost[known:]
        both = [link] if step.joint is None else [step.joint, link]
        return [self.entry(each) for each in (both if step.is_joint_first else both[::-1])]

    def part_writer(self) -> XacroPartWriter:
        """Return what writes parts, or what comes to be in them, at this place."""
        return XacroPartWriter(
            self,
            self._translate,
            self.contents,
            self.solids,
            self.here.macro,
            exact=self.program.exact,
            constants=self.program.known_numbers,
        )

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
        writer = self.part_writer()
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
            name: tidy_value(name, self._translate(format_value(value)))
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

    def _translate(self, text: str) -> str:
        return self.translator.text(_tidied(text))

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
                name = self.translator.text(format_value(child.attributes.get("name")))
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


def _tidied(text: str) -> str:
    """Return a text without line breaks between its words."""
    return " ".join(text.split()) if "\n" in text else text


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
