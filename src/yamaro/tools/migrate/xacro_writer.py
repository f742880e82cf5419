"""One file of xacro as a Yamaro source: macros as functions, properties as variables, parts."""

from __future__ import annotations

import os
from contextlib import contextmanager

from ...runtime.predefined import CONSTANTS
from ...syntax.names import is_identifier
from ...xacro.parameters import Parameter
from ...xmltree import Comment, Element, Text, format_value
from .document import Body, Entry, Quoted, Row, Value, joined, literal, without_expressions
from .elements import (
    ElementWriter,
    header_of,
    is_short,
    needs_brackets,
    tidy_text,
    tidy_value,
    walk,
)
from .pairing import has_text
from .xacro_arguments import is_argument
from .xacro_includes import computed_name
from .xacro_loops import find_loop
from .xacro_parts import Step, XacroPartWriter, in_steps, is_statement, stands_as_key
from .xacro_program import Macro, Program, camel, defined_in, names_in, used_in
from .xacro_python import CannotMigrate, Translator, is_typed, negated

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from ...source import Span
    from ...xmltree import Node
    from .xacro_contents import Contents
    from .xacro_inertia import Solids
    from .xacro_parts import Write
    from .xacro_reach import Reach

PREDEFINED = frozenset(CONSTANTS) | {"load_yaml", "find", "math", "xacro", "python", "arg"}
SCOPES = {"global": "/global", "parent": "/parent"}


class FileWriter(ElementWriter):
    """Writes one file.

    Attributes:
        lost: what could not be carried over: where, why, and what is said below that.
    """

    __slots__ = (
        "_around",
        "_blocks",
        "_contents",
        "_functions",
        "_hides",
        "_is_in_element",
        "_is_top",
        "_locals",
        "_made_of",
        "_output_of",
        "_parameters",
        "_path",
        "_place",
        "_program",
        "_reach",
        "_read",
        "_solids",
        "_visible",
        "lost",
        "translator",
    )

    def __init__(
        self,
        program: Program,
        contents: Contents,
        solids: Solids,
        reach: Reach,
        path: str,
        output_of: Callable[[str], str],
    ) -> None:
        """Take the program, the file, and what gives the path of a migrated file."""
        super().__init__(lambda file: file)
        self._program = program
        self._contents = contents
        self._solids = solids
        self._reach = reach
        self._around: Macro | None = None
        self._place: Write | None = None
        self._is_in_element = program.result.name != "robot"
        self._path = path
        self._output_of = output_of
        self._functions = Body()
        self._is_top = True
        self._blocks: dict[str, str] = {}
        self._parameters: set[str] = set()
        self._locals: set[str] = set()
        self._hides: set[str] = set()
        self._read: set[str] = set()
        self._made_of: dict[int, set[str]] = {}
        self._visible = program.at_top
        self.lost: list[tuple[Span, str, str]] = []
        self.translator = Translator(
            self._variable,
            self._is_namespace,
            program.is_shown_as_truth,
            program.truth_arguments,
            program.numbers,
        )
        self.translator.argument = self._argument_name

    def _is_namespace(self, name: str) -> bool:
        return name in self._program.namespaces.names(self._path)

    def _shared(self, name: str) -> str:
        """Return the scope of something at the top of the file: that of what others use."""
        if not self._program.is_used_elsewhere(name, self._path):
            return ""
        return "/parent" if self._path in self._program.namespaces.inside else "/global"

    def _variable(self, name: str) -> str:
        return name if is_identifier(name) else name.replace("-", "_")

    def _argument_name(self, name: str) -> str:
        """Return the variable of an argument, which something else of its name may hide here."""
        own = self._variable(name)
        return f"arg_{own}" if name in self._hides else own

    # --- the file -------------------------------------------------------------------------------

    def sections(self, *, is_main: bool) -> Body:
        """Return the sections of the file."""
        root = self._program.roots[self._path]
        sections = Body()
        declared = self._arguments() if is_main else Body()
        self._hides = self._program.hidden.everywhere
        model = self.statements(root.children)
        self._take_variables(model, declared)
        if self.translator.imports:
            sections.add("import", f"[{', '.join(sorted(self.translator.imports))}]")
        if declared:
            sections.add("variables", declared)
        if self._functions:
            sections.add("functions", self._functions)
        if is_main:
            self._add_root(root, sections, model)
        elif model or not sections:
            sections.add("model", model or None)
        return sections

    def header(self, *, is_main: bool) -> str:
        """Return the comment above the file."""
        header = header_of(self._program.documents[self._path])
        root = self._program.roots[self._path]
        if is_main or all(element.name != "xacro:arg" for element in walk(root)):
            return header
        folder = os.path.dirname(self._output_of(self._path))
        main = os.path.relpath(self._output_of(self._program.main), folder)
        return joined(header, f"the arguments are declared in {main}")

    def _take_variables(self, model: Body, declared: Body) -> None:
        """Take the first variables of a model to those declared for the file, if that is the same.

        They may stand behind includes if these define none of them, and nothing that they read.
        """
        for index, entry in enumerate(model.entries):
            if entry.key == "variables":
                assert isinstance(entry.value, Body)
                if index and not self._is_independent(entry.value, declared):
                    return
                if _names_of(entry.value) & _names_of(declared):
                    return
                declared.note(entry.comment)
                declared.extend(entry.value)
                del model.entries[index]
                return
            if entry.key != "include":
                return

    def _is_independent(self, variables: Body, declared: Body) -> bool:
        """Tell whether no other file defines variables, nor what they are made of."""
        names = _names_of(variables)
        known = names | _names_of(declared) | PREDEFINED
        made_of = set().union(*(self._made_of.get(id(entry), set()) for entry in variables))
        return made_of <= known and all(
            len(self._program.properties.get(name, ())) <= 1 for name in names
        )

    def _add_root(self, root: Element, sections: Body, model: Body) -> None:
        attributes = {
            name: self.translator.text(format_value(value))
            for name, value in root.attributes.items()
            if not name.startswith(("xmlns:xacro", "xacro:"))
        }
        for name, value in self._program.result.attributes.items():
            if name.startswith("xmlns:"):  # other files may declare prefixes
                attributes.setdefault(name, literal(format_value(value)))
        namespace = root.attributes.get("xacro:targetNamespace")
        if namespace:
            attributes["xmlns"] = self.translator.text(format_value(namespace))
        if root.name == "robot" and list(attributes) == ["name"]:
            sections.entries.insert(0, Entry("robot", attributes["name"]))
            sections.add("model", model or None)
            return
        key = self.key(root.name, attributes, bracketed="name" not in attributes)
        sections.add(key, model or None)

    def _arguments(self) -> Body:
        """Return the arguments of all files, which the main file declares."""
        body = Body()
        for name, argument in self._program.arguments.items():
            if self._is_late(name):
                body.note(argument.remark)
                body.add(f"{self._variable(name)}/global")
                continue
            try:
                default = argument.default
                is_python = self._program.is_python(name)
                value = f"$({default.strip()})" if is_python else self.translator.value(default)
            except CannotMigrate as error:
                self._lose(argument.span, str(error))
                continue
            body.note(argument.remark)
            body.add(self._variable(name) + self._shared(name), value or "")
        for name in self._program.arguments:
            if name in self._program.hidden.used:
                own = self._variable(name)
                body.add(f"arg_{own}{self._shared(name)}", f"$({own})")
        return body

    def _lose(self, span: Span, why: str, hint: str = "the sources have a comment there") -> None:
        self.lost.append((span, why, hint))

    # --- bodies ---------------------------------------------------------------------------------

    def body(self, nodes: list[Node]) -> Body | None:
        """Return what stands in an element."""
        was_top, self._is_top = self._is_top, False
        try:
            body = self.statements(nodes)
        finally:
            self._is_top = was_top
        if not any(isinstance(node, Element) and node.name.startswith("xacro:") for node in nodes):
            body.in_braces = is_short(body)
        return body or None

    def statements(self, nodes: list[Node]) -> Body:
        """Return statements for what stands in a file, a macro or an element."""
        body = Body()
        for step in self._steps(nodes):
            node = step.node
            if isinstance(node, Comment):
                body.note(tidy_text(node.text))
            elif isinstance(node, Text):
                text = tidy_text(format_value(node.value))
                message = self._message(text)
                if message is not None:
                    body.add("print", message)
                elif text:
                    body.add("<#text>", self._text(text, node.span))
            elif isinstance(node, Element):
                try:
                    self._statement(node, step, body)
                except CannotMigrate as error:
                    self._lose(node.span, str(error))
                    body.note(f"not migrated: <{node.name}>: {error}")
        return body

    def _steps(self, nodes: list[Node]) -> Iterable[Step]:
        """Return what is written one after the other: links with their joints, where they stand."""
        if self._is_in_element or self._place is not None:
            return map(Step, nodes)
        return in_steps(nodes, self._contents)

    def _statement(self, node: Element, step: Step, body: Body) -> None:
        if is_statement(node):
            handler = _HANDLERS.get(node.name, FileWriter._call)
            handler(self, node, body)
        elif self._place is not None:
            self._place(node, body)
        elif node.name != "link" or self._is_in_element:
            body.append(self.entry(node))
        else:
            for entry in self._part(node, step):
                body.append(entry)

    def _part(self, link: Element, step: Step) -> list[Entry]:
        """Return a link and its joint as a part, or as the elements that they are."""
        known = len(self.lost)
        parts = XacroPartWriter(self, self._translate, self._contents, self._solids, self._around)
        part = parts.entry(link, step.joint, joint_first=step.is_joint_first)
        if part is not None:
            return [part]
        del self.lost[known:]
        both = [link] if step.joint is None else [step.joint, link]
        return [self.entry(each) for each in (both if step.is_joint_first else both[::-1])]

    def write_statement(self, node: Element, body: Body, place: Write) -> None:
        """Write a statement, and the elements in it by `place`."""
        with self._within(place):
            self._statement(node, Step(node), body)

    @contextmanager
    def _within(self, place: Write | None, *, is_in_element: bool = False) -> Iterator[None]:
        """Write the elements of a body by `place`, or else as the elements they are."""
        before = self._place, self._is_in_element
        self._place, self._is_in_element = place, is_in_element
        try:
            yield
        finally:
            self._place, self._is_in_element = before

    def _write_for_parts(self, node: Element, body: Body) -> None:
        """Write an element that may come to stand in a part, where it is to mean the same."""
        own = XacroPartWriter(
            self, self._translate, self._contents, self._solids, self._around
        ).spelled(node)
        body.append(self.entry(node, bracketed=not stands_as_key(own)))

    def entry(self, element: Element, *, bracketed: bool = False) -> Entry:
        """Return an element, with its values translated."""
        attributes = self._values(element)
        children = element.children
        if any(isinstance(c, Element) and c.name == "xacro:attribute" for c in children):
            children = self._take_attributes(element, attributes)
        bracketed = bracketed or needs_brackets(element.name, attributes)
        key = self.key(element.name, attributes, bracketed=bracketed)
        return Entry(key, self._content(element, children))

    def _values(self, element: Element) -> dict[str, str]:
        return {
            name: tidy_value(name, self._translate(format_value(value)))
            for name, value in element.attributes.items()
            if not name.startswith(("xacro:", "xmlns:xacro"))
        }

    def _content(self, element: Element, children: list[Node]) -> Value:
        if (
            has_text(element)
            and self._message(element.text().strip()) is None
            and all(isinstance(child, (Text, Comment)) for child in children)
        ):
            return self._text(tidy_text(element.text()), element.span)
        with self._within(None, is_in_element=True):
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
            self._lose(span, str(error))
            return literal(text)

    def _take_attributes(self, element: Element, attributes: dict[str, str]) -> list[Node]:
        """Add what `<xacro:attribute>` gives to an element, and return its other children."""
        rest: list[Node] = []
        for child in element.children:
            if isinstance(child, Element) and child.name == "xacro:attribute":
                name = self.translator.text(format_value(child.attributes.get("name")))
                attributes[name] = self.translator.text(format_value(child.attributes.get("value")))
            else:
                rest.append(child)
        return rest

    # --- xacro's tags ---------------------------------------------------------------------------

    def _argument(self, node: Element, body: Body) -> None:
        """Leave out an argument, which the main file declares, and the comments above it.

        A default that is made of properties, or is one of several that may come first, is given
        where it stands, if there is no value yet.
        """
        body.remark = ""
        name = format_value(node.attributes.get("name"))
        if not self._is_late(name) or "default" not in node.attributes:
            return
        own = self._variable(name)
        default = self.translator.value(format_value(node.attributes["default"]))
        value = Body([Entry(f"{own}/global", default)], in_braces=True)
        if name in self._program.hidden.used:
            value.add(f"arg_{own}/global", default)
        given = Body([Entry("variables", value)], in_braces=True)
        body.add("if", Body([Entry("condition", f"{own} is None"), Entry("body", given)]))

    def _is_late(self, name: str) -> bool:
        """Tell whether the default of an argument is known only where it is declared."""
        argument = self._program.arguments.get(name)
        if argument is None:
            return False
        known = PREDEFINED | self._program.arguments.keys()
        return len(argument.defaults) > 1 or not argument.made_of <= known

    def _property(self, node: Element, body: Body) -> None:
        given = {name: format_value(value) for name, value in node.attributes.items()}
        name = given.get("name", "")
        if "remove" in given:
            raise CannotMigrate(f"the property '{name}' is removed")
        if not is_identifier(name):
            raise CannotMigrate(f"the name of the property '{name}' is computed, or no name")
        if "value" not in given and "default" not in given:
            self._define_block(node, name, body)
            return
        text = given.get("value", given.get("default", ""))
        if is_argument(text, name) and name not in self._hides:
            return
        if not self._may_be_evaluated(text):
            body.note(f"not evaluated: {name}: {text}")
            read = self._program.read if self._is_top else self._read | self._program.inherited
            if name in read:
                self._lose(node.span, f"nothing defines what the property '{name}' is made of")
            return
        if "default" in given:
            if name in self._parameters:
                return
            if (not self._is_top and name in self._program.at_top) or (
                self._is_top and len(self._program.properties.get(name, ())) > 1
            ):
                raise CannotMigrate(f"the property '{name}' may have a value already")
        scope = SCOPES.get(given.get("scope", ""), "")
        if self._is_top and scope == "/parent" and self._path in self._program.namespaces.inside:
            raise CannotMigrate(f"the property '{name}' is handed out of a namespace")
        if self._is_top and (not scope or self._path in self._program.included_by_macros):
            scope = self._shared(name)
        elif not self._is_top and self._is_handed_down(name, self._around):
            scope = {"": "/child", "/parent": "/bridge"}.get(scope, scope)
        value = self.translator.value(text)
        last = body.entries[-1] if body.entries else None
        key = name + scope
        if (
            last is None
            or last.key != "variables"
            or not isinstance(last.value, Body)
            or name in _names_of(last.value)
        ):
            last = Entry("variables", Body())
            body.append(last)
        elif body.remark:
            assert isinstance(last.value, Body)
            last.value.note(body.remark)
            body.remark = ""
        assert isinstance(last.value, Body)
        last.value.add(key, value)
        self._sort(last.value, name, text)

    def _is_handed_down(self, name: str, macro: Macro | None) -> bool:
        """Tell whether a name of a macro is read by what it calls or includes."""
        if name in self._program.inherited:
            return True
        return macro is not None and name in self._reach.read_below(macro)

    def _sort(self, variables: Body, name: str, text: str) -> None:
        """Put the last of variables before the first that reads it: xacro's are evaluated late."""
        entries = variables.entries
        self._made_of[id(entries[-1])] = names_in(text)
        for index, entry in enumerate(entries):
            if entry is not entries[-1] and name in self._made_of.get(id(entry), ()):
                entries.insert(index, entries.pop())
                return

    def _body_of_last(self, body: Body, key: str) -> Body:
        """Return the body of the last entry if it has this key, else of one that is added."""
        last = body.entries[-1] if body.entries else None
        if last is None or last.key != key:
            last = Entry(key, Body())
            body.append(last)
        assert isinstance(last.value, Body)
        return last.value

    def _may_be_evaluated(self, text: str) -> bool:
        """Tell whether all names of a value are known: xacro evaluates only what is read."""
        return names_in(text) <= self._visible | PREDEFINED

    def _define_block(self, node: Element, name: str, body: Body) -> None:
        with self._within(self._place_of_block(None, name)):
            function = Body([Entry("body", self.body(node.children))])
        scope = self._shared(name)
        self._functions.note(body.remark)
        body.remark = ""
        self._functions.add(self._block_name(name) + scope, function)

    def _macro(self, node: Element, body: Body) -> None:
        name = format_value(node.attributes.get("name")).removeprefix("xacro:")
        macro = self._program.definitions.get((self._path, node.span.start))
        if macro is None:
            raise CannotMigrate("the macro has no name")
        if self._is_top and self._program.is_defined_again(macro):
            why = f"this definition of '{name}' is left out: there is another one below"
            self._lose(node.span, why)
            body.note(why)
            return
        function = Body()
        before = self._blocks, self._parameters, self._is_top, self._locals, self._visible
        around, self._around = self._around, macro
        self._locals = defined_in(node, nested=True)
        self._read = used_in(node)
        self._visible = self._program.visible_in(macro)
        self._is_top = False
        self._blocks = {own.lstrip("*"): own for own in macro.blocks()}
        self._parameters = set(macro.values())
        inputs = self._inputs(macro)
        if inputs:
            function.add("input", Row(inputs))
        hides, self._hides = self._hides, self._hides | self._program.hidden.in_macro(macro)
        is_in_part = self._contents.may_be_in_part(macro)
        with self._within(self._write_for_parts if is_in_part else None):
            content = self._loop(macro) or self.statements(node.children)
        self._around, self._hides = around, hides
        shared = [own for own in macro.values() if self._is_handed_down(own, macro)]
        if shared:
            _declare_first(content, [Entry(f"{own}/child", f"$({own})") for own in shared])
        self._blocks, self._parameters, self._is_top, self._locals, self._visible = before
        function.add("body", content or None)
        key = macro.function + self._shared(f"xacro:{name}")
        target = self._functions
        if not self._is_top:
            target = self._body_of_last(body, "functions")
        target.note(body.remark)
        body.remark = ""
        target.add(key, function)

    def _loop(self, macro: Macro) -> Body | None:
        """Return the content of a macro that calls itself as a loop, if it can be one."""
        loop = find_loop(macro, self._program, self.translator)
        if loop is None:
            return None
        self._visible = self._visible | {loop.iterator}
        return loop.body(self.statements, self.translator.value)

    def _inputs(self, macro: Macro) -> list[str]:
        required: list[str] = []
        optional: list[str] = []
        blocks: list[str] = []
        for own in macro.parameters:
            if own.is_block:
                blocks.append("**" + self._block_name(own.name.lstrip("*")))
            elif (own.is_forwarded and own.default is None) or macro.is_default_of_caller(own):
                required.append(own.name)
            elif own.default is not None:
                optional.append(f"{own.name}={self._default(own)}")
            elif macro.element.attributes["params"] and _has_empty_default(macro, own):
                optional.append(f"{own.name}=''")
            else:
                required.append(own.name)
        return required + optional + blocks

    def _default(self, own: Parameter) -> str:
        value = self.translator.value(own.default or "")
        if value == "":
            return "''"
        outside = without_expressions(value)
        is_quoted = (own.default or "").startswith("'")
        is_misread = isinstance(value, Quoted) and is_typed(value) and not is_quoted
        if (
            is_misread
            or any(char in outside for char in ",[]{}#'\"&*!|>%@`")
            or ": " in outside
            or " " in outside
        ):
            return "'" + value.replace("'", "''") + "'"
        return value

    def _block_name(self, name: str) -> str:
        stem = camel(name)
        taken = {macro.function for macro in self._program.definitions.values()}
        return f"{stem}Block" if stem in taken else stem

    def _insert(self, node: Element, body: Body) -> None:
        name = format_value(node.attributes.get("name"))
        if name in self._blocks or name in self._program.blocks:
            body.add(self._block_name(name))
        else:
            raise CannotMigrate(f"there is no block '{name}'")

    def _call(self, node: Element, body: Body) -> None:
        name = node.name.removeprefix("xacro:")
        macro = self._program.macro_called(node)
        arguments = Body(in_braces=True)
        for key, value in node.attributes.items():
            arguments.add(key, self.translator.value(format_value(value)))
        if macro is None:
            if node.elements() or "." in name or not is_identifier(camel(name)):
                raise CannotMigrate(f"there is no macro '{name}'")
            hint = "the sources call it too, which is an error where it is reached, as in xacro"
            self._lose(node.span, f"there is no macro '{name}'", hint)
            body.add(camel(name), arguments or None)
            return
        visible = self._parameters | self._locals | self._program.at_top
        for own in macro.parameters:
            if own.name in node.attributes:
                continue
            is_seen = own.name in visible or (
                own.default is None and own.name in self._program.inherited
            )
            if own.is_forwarded and is_seen:
                arguments.add(own.name, f"$({own.name})")
            elif own.default is not None and macro.is_default_of_caller(own):
                arguments.add(own.name, self.translator.value(own.default))
        blocks = macro.blocks()
        if blocks:
            arguments.in_braces = False
            self._add_blocks(node, macro, arguments)
        namespace = name.rpartition(".")[0]
        if namespace and not self._is_namespace(namespace):
            raise CannotMigrate(f"the namespace '{namespace}' is made in another file")
        function = f"{namespace}.{macro.function}" if namespace else macro.function
        body.add(function, arguments or None)

    def _add_blocks(self, node: Element, macro: Macro, arguments: Body) -> None:
        given = [child for child in node.children if isinstance(child, Element)]
        blocks = macro.blocks()
        if len(blocks) != len(given):
            if len(blocks) != 1 or blocks[0].startswith("**"):
                raise CannotMigrate(f"the blocks of '{macro.name}' are computed")
            own = blocks[0].lstrip("*")
            with self._within(self._place_of_block(macro, own), is_in_element=self._is_in_element):
                arguments.add(self._block_name(own), self.body(node.children))
            return
        for block, child in zip(blocks, given, strict=True):
            name = self._block_name(block.lstrip("*"))
            is_content = block.startswith("**")
            if is_content and is_statement(child):
                raise CannotMigrate(f"the block '{block}' of '{macro.name}' is computed")
            place = self._place_of_block(macro, block.lstrip("*"))
            with self._within(place, is_in_element=self._is_in_element):
                content = self.body(child.children if is_content else [child])
            if content is not None and not is_content:
                content.in_braces = False
            arguments.add(name, content)

    def _place_of_block(self, macro: Macro | None, name: str) -> Write | None:
        """Return what writes the elements of a block."""
        is_in_part = self._contents.may_block_be_in_part(macro, name)
        return self._write_for_parts if is_in_part else None

    def _condition(self, node: Element, body: Body) -> None:
        text = format_value(node.attributes.get("value"))
        condition = self.translator.condition(text)
        if node.name == "xacro:unless":
            condition = negated(condition)
        content = self.body(node.children)
        if content is not None:
            content.in_braces = False
        last = body.entries[-1] if body.entries else None
        if last is not None and last.key == "if" and not body.remark:
            assert isinstance(last.value, Body)
            if last.value.entries[0].value == negated(condition) and not (
                names_in(text) & (_declared_in(last.value) | self._program.assigned_from_inside)
            ):
                body.add("else", content)
                return
        body.add("if", Body([Entry("condition", condition), Entry("body", content)]))

    def _include(self, node: Element, body: Body) -> None:
        paths = self._program.files_of(node)
        if not paths:
            name = format_value(node.attributes.get("filename"))
            raise CannotMigrate(f"the file '{name}' is not included for these arguments")
        folder = os.path.dirname(self._output_of(self._path))
        names = [literal(os.path.relpath(self._output_of(path), folder)) for path in paths]
        computed = self._computed_name(node, dict(zip(paths, names, strict=True)))
        for path, name in [(paths[0], computed)] if computed else zip(paths, names, strict=True):
            body.add("include", self._in_namespace(node, path, name) or name)

    def _computed_name(self, node: Element, known: dict[str, str]) -> str | None:
        """Return the name of an included source if it depends on arguments, or None."""
        filename = format_value(node.attributes.get("filename"))
        computed = computed_name(filename)
        if computed is None:
            return None
        folder = self._program.folder_meant(computed.start, node)
        name = folder and computed.source(folder, known, self.translator.text)
        if not name and len(known) > 1 and not any(char in filename for char in "*?["):
            raise CannotMigrate(f"which file '{filename}' means is computed")
        return name or None

    def _in_namespace(self, node: Element, path: str, file: str) -> Body | None:
        """Return what an include says that puts a file's names in a namespace, if it does."""
        if "ns" not in node.attributes:
            return None
        name = format_value(node.attributes["ns"])
        if not is_identifier(name):
            raise CannotMigrate(f"the namespace '{name}' is computed, or no name")
        if path in self._program.namespaces.mixed:
            raise CannotMigrate("the file is included without a namespace as well")
        return Body([Entry("path", file), Entry("namespace", name)], in_braces=True)

    def _element(self, node: Element, body: Body) -> None:
        name = self.translator.text(format_value(node.attributes.get("xacro:name")))
        attributes = self._values(node)
        children = self._take_attributes(node, attributes)
        bracketed = "$(" in name or needs_brackets(name, attributes)
        key = self.key(name, attributes, bracketed=bracketed)
        body.append(Entry(key, self._content(node, children)))

    def _call_by_name(self, node: Element, body: Body) -> None:
        given = format_value(node.attributes.get("macro"))
        if "$" in given:
            self._call_computed(node, given, body)
            return
        attributes = {k: v for k, v in node.attributes.items() if k != "macro"}
        named = Element(f"xacro:{given}", node.span, attributes, node.children)
        self._call(named, body)

    def _call_computed(self, node: Element, given: str, body: Body) -> None:
        """Call the macro whose name an expression gives, if none of them takes a block."""
        macros = self._program.macros.values()
        if node.elements():
            raise CannotMigrate("the macro that is called is computed, and takes blocks")
        names = {macro.name: macro.function for macro in macros if not macro.blocks()}
        arguments = Body(in_braces=True)
        for key, value in node.attributes.items():
            if key != "macro":
                arguments.add(key, self.translator.value(format_value(value)))
        body.add(f"$({names!r}[{self.translator.joined(given)}])", arguments or None)


_HANDLERS = {
    "xacro:arg": FileWriter._argument,
    "xacro:property": FileWriter._property,
    "xacro:macro": FileWriter._macro,
    "xacro:insert_block": FileWriter._insert,
    "xacro:if": FileWriter._condition,
    "xacro:unless": FileWriter._condition,
    "xacro:include": FileWriter._include,
    "xacro:element": FileWriter._element,
    "xacro:call": FileWriter._call_by_name,
}


def _declare_first(content: Body, variables: list[Entry]) -> None:
    """Declare variables in front of all that stands in a body."""
    first = content.entries[0] if content.entries else None
    if first is not None and first.key == "variables" and not first.comment:
        assert isinstance(first.value, Body)
        own = _names_of(first.value)
        first.value.entries[:0] = [each for each in variables if not _names_of([each]) & own]
        return
    content.entries.insert(0, Entry("variables", Body(variables)))


def _names_of(variables: Iterable[Entry]) -> set[str]:
    """Return the names of the variables that entries declare."""
    return {entry.key.partition("/")[0] for entry in variables}


def _declared_in(body: Body) -> set[str]:
    """Return the names of the variables declared in a body, however deep."""
    names: set[str] = set()
    for entry in body:
        if isinstance(entry.value, Body):
            if entry.key == "variables":
                names |= _names_of(entry.value)
            names |= _declared_in(entry.value)
    return names


def _has_empty_default(macro: Macro, own: Parameter) -> bool:
    text = format_value(macro.element.attributes["params"])[own.start : own.end + 2]
    return ":=" in text or "=" in text


def _tidied(text: str) -> str:
    """Return a text without line breaks between its words."""
    return " ".join(text.split()) if "\n" in text else text
