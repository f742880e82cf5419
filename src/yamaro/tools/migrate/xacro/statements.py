"""Definitions, conditions and calls of xacro as variables, functions and statements."""

from __future__ import annotations

import ast
from copy import copy

from ....runtime.predefined import CONSTANTS
from ....syntax.names import FACTORS, is_identifier
from ....syntax.python import skip_expression
from ....xacro.symbol_table import (
    arguments_in,
    arguments_of,
    defined_in,
    is_argument,
    names_in,
    used_in,
)
from ....xml.tree import Comment, Element
from ....xml.values import format_value
from ....yaml.nodes import type_plain
from ..document import Body, Entry, Quoted, Row, without_expressions
from ..elements import add_loose, comments_at_ends, name_of
from .loops import find_loop
from .names import camel
from .parts import is_statement
from .program import Macro
from .python import CannotMigrate, is_typed, negated

PREDEFINED = frozenset(CONSTANTS.keys() - FACTORS) | {
    "load_yaml",
    "find",
    "math",
    "xacro",
    "python",
    "arg",
}
SCOPES = {"global": "/global", "parent": "/parent"}

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ....xacro.statements import Parameter
    from ....xml.tree import Node
    from .contents import Content
    from .parts import Write
    from .program import Macro, XacroProgram
    from .writer import FileWriter


# --- surroundings: the macro, part and element that a statement is in -------------------------


class Surroundings:
    """What stands around a piece of a file.

    Attributes:
        macro: the innermost macro, if there is one.
        is_top: whether the piece stands right in the file.
        is_in_element: whether it is in an element, where nothing is a part.
        place: what writes the elements that end up in a part.
        holder: the part, macro or block whose elements these are, where it is known.
        renamed: the variables that are read by another name here.
        hides: the arguments whose names mean something else here.
        visible: the names that are visible.
        read: the names that are read here.
        parameters, locals, blocks: the names that the macro has.
    """

    def __init__(self, program: XacroProgram) -> None:
        """Stand at the top of a file."""
        self.macro: Macro | None = None
        self.is_top = True
        self.is_in_element = program.result.name != "robot"
        self.place: Write | None = None
        self.holder: Content | None = None
        self.renamed: dict[str, str] = {}
        self.hides: set[str] = set()
        self.visible = program.at_top
        self.read = program.read
        self.parameters: set[str] = set()
        self.locals: set[str] = set()
        self.blocks: set[str] = set()

    def within(
        self, place: Write | None, *, is_in_element: bool, holder: Content | None = None
    ) -> Surroundings:
        """Return those in an element or part."""
        inner = copy(self)
        inner.place, inner.is_in_element = place, is_in_element
        inner.holder = holder if place is not None else None
        return inner

    def renaming(self, names: dict[str, str]) -> Surroundings:
        """Return the same where variables are read by other names."""
        inner = copy(self)
        inner.renamed = self.renamed | names
        return inner

    def below_top(self) -> Surroundings:
        """Return the same for what does not stand right in the file."""
        inner = copy(self)
        inner.is_top = False
        return inner

    def in_macro(self, macro: Macro, program: XacroProgram, place: Write | None) -> Surroundings:
        """Return those in a macro, whose elements are written by `place`."""
        inner = self.within(place, is_in_element=False, holder=macro.name)
        inner.macro = macro
        inner.is_top = False
        inner.hides = self.hides | program.hidden.in_macro(macro)
        inner.visible = program.visible_in(macro)
        inner.read = used_in(macro.element) | program.inherited
        inner.parameters = set(macro.values())
        inner.locals = defined_in(macro.element, nested=True)
        inner.blocks = {own.lstrip("*") for own in macro.blocks()}
        return inner


def names_of(variables: Iterable[Entry]) -> set[str]:
    """Return the names of the variables that entries declare."""
    return {entry.key.partition("/")[0] for entry in variables}


def body_of_last(body: Body, key: str) -> Body:
    """Return the body of the last entry if it has this key, else of one that is added."""
    last = body.entries[-1] if body.entries else None
    if last is None or last.key != key:
        last = Entry(key, Body())
        body.append(last)
    assert isinstance(last.value, Body)
    return last.value


def move_opening(inner: Body | None, outer: Body) -> None:
    """Move a comment at the end of an opening tag to the key that replaces the tag."""
    if inner is not None:
        outer.opening, inner.opening = inner.opening, ""


# --- arguments, properties, macros ------------------------------------------------------------


def write_argument(writer: FileWriter, node: Element, body: Body) -> None:
    """Leave out an argument, which the main file declares, and the comments above it.

    A default that is made of properties, or is one of several that may come first, is given
    where it stands, if there is no value yet.
    """
    body.remark = ""
    body.latest = Entry("")  # it takes the comments at the end of the line
    name = name_of(node)
    if not is_late(writer, name) or "default" not in node.attributes:
        return
    hidden = writer.program.hidden
    own = writer.variable(name)
    default = writer.translator.value(format_value(node.attributes["default"]), name)
    value = Body(in_braces=True)
    if name not in hidden.everywhere:
        value.add(f"{own}/global", default)
    if name in hidden.used:
        own = f"arg_{own}"
        value.add(f"{own}/global", default)
    given = Body([Entry("variables", value)], in_braces=True)
    body.add("if", Body([Entry("condition", f"{own} is None"), Entry("body", given)]))


def is_late(writer: FileWriter, name: str) -> bool:
    """Return whether the default of an argument is known only where it is declared."""
    argument = writer.program.arguments.get(name)
    if argument is None:
        return False
    known = PREDEFINED | writer.program.arguments.keys()
    if len(argument.defaults) > 1 or not argument.made_of <= known:
        return True
    if any(is_late(writer, other) for other in arguments_of(argument.default) - {name}):
        return True
    return not writer.program.files.has_what_it_needs(argument.default)


def write_property(writer: FileWriter, node: Element, body: Body) -> None:
    """Write a property as a variable, or as a function if it is a block."""
    given = {name: format_value(value) for name, value in node.attributes.items()}
    name = given.get("name", "")
    if "remove" in given:
        raise CannotMigrate(f"the property '{name}' is removed")
    if not is_identifier(name):
        raise CannotMigrate(f"the name of the property '{name}' is computed, or no name")
    if "value" not in given and "default" not in given:
        with writer.within(writer_of_block(writer, None, name), holder=(None, name)):
            function = Body([Entry("body", writer.body(node.children))])
        reach = writer.scope_of(name)
        writer.functions.note(body.remark)
        body.remark = ""
        writer.functions.add(block_name(writer, name) + reach, function)
        body.latest = writer.functions.latest
        return
    text = given.get("value", given.get("default", ""))
    if is_argument(text, name) and name not in writer.here.hides:
        return
    is_known = writer.program.files.can_be_evaluated(node)
    if is_known is None:  # no run has shown it: is there all that it is made of?
        there = writer.here.visible | PREDEFINED | writer.program.assigned_from_inside
        is_known = names_in(text) <= there
    if not is_known:  # xacro evaluates only what is read
        body.note(f"not evaluated: {name}: {text}")
        if name in writer.here.read:
            writer.lose(node.span, f"nothing defines what the property '{name}' is made of")
        return
    if "default" in given:
        includers = writer.program.macros_including(writer.path)
        if name in writer.here.parameters or (
            writer.here.macro is None
            and includers
            and all(name in macro.values() for macro in includers)
        ):
            return
        if (not writer.here.is_top and name in writer.program.at_top) or (
            writer.here.is_top and len(writer.program.properties.get(name, ())) > 1
        ):
            raise CannotMigrate(f"the property '{name}' may have a value already")
    scope = _scope(writer, name, given.get("scope", ""))
    value = writer.translator.value(text, name)
    remark, body.remark = body.remark, ""
    variables = body_of_last(body, "variables")
    if name in names_of(variables):
        variables = Body()
        body.add("variables", variables)
    if variables:
        variables.note(remark)
    else:
        body.entries[-1].comment = remark
    variables.add(name + scope, value)
    body.latest = variables.latest
    # put the last of variables before the first that reads it: xacro's are evaluated late
    entries = variables.entries
    writer.made_of[id(entries[-1])] = names_in(text)
    for index, entry in enumerate(entries):
        if entry is not entries[-1] and name in writer.made_of.get(id(entry), ()):
            entries.insert(index, entries.pop())
            return


def _scope(writer: FileWriter, name: str, given: str) -> str:
    """Return the scope of a property; in a file, it is the same inside of conditions."""
    scope = SCOPES.get(given, "")
    if writer.here.macro is not None:
        if scope == "/parent" and name in writer.program.inherited:
            return "/bridge"
        if _is_handed_down(writer, name, writer.here.macro):
            return {"": "/child", "/parent": "/bridge"}.get(scope, scope)
        return scope
    if scope == "/parent" and writer.path in writer.program.namespaces.inside:
        raise CannotMigrate(f"the property '{name}' is handed out of a namespace")
    if name in writer.program.names_of_includers(writer.path):
        return "/parent"
    if scope and writer.path not in writer.program.included_by_macros:
        return scope
    if name in writer.callees.hidden:
        return writer.scope_of(name) or "/global"  # callers' names go before it, as in xacro
    return writer.scope_of(name)


def _is_handed_down(writer: FileWriter, name: str, macro: Macro | None) -> bool:
    """Return whether a name of a macro is read by what it calls or includes."""
    if name in writer.program.inherited and writer.program.has_computed_calls:
        return True
    return macro is not None and name in writer.callees.read_below(macro)


def write_macro(writer: FileWriter, node: Element, body: Body) -> None:
    """Write a macro as a function."""
    name = name_of(node).removeprefix("xacro:")
    macro = writer.program.definitions.get((writer.path, node.span.start))
    if macro is None:
        raise CannotMigrate("the macro has no name")
    if writer.here.is_top and writer.program.is_defined_again(macro):
        why = f"this definition of '{name}' is left out: there is another one below"
        writer.lose(node.span, why)
        body.note(why)
        return
    function = Body()
    required: list[str] = []
    optional: list[str] = []
    blocks: list[str] = []
    listed = format_value(macro.element.attributes.get("params"))
    for own in macro.parameters:
        if own.is_block:
            blocks.append("**" + block_name(writer, own.name.lstrip("*")))
        elif (own.is_forwarded and own.default is None) or macro.is_default_of_caller(own):
            required.append(own.name)
        elif own.default is not None:
            optional.append(f"{own.name}={_default(writer, own)}")
        elif "=" in listed[own.start : own.end + 2]:
            optional.append(f"{own.name}=''")
        else:
            required.append(own.name)
    inputs = required + optional + blocks
    if inputs:
        function.add("input", Row(inputs))
    place = writer.write_for_parts if writer.contents.may_be_in_part(macro) else None
    with writer.at(writer.here.in_macro(macro, writer.program, place)):
        content = Body()
        loop = find_loop(macro, writer.program, writer.translator)
        if loop is not None:
            writer.here.visible = writer.here.visible | {loop.iterator}
            content = loop.body(writer.statements, writer.translator.value)
        content = content or writer.statements(node.children)
    shared = [
        own
        for own in macro.values()
        if _is_handed_down(writer, own, macro) and not writer.callees.is_set_for_all(own, macro)
    ]
    if shared:  # they are declared in front of all that is in the macro
        variables = [Entry(f"{own}/child", f"$({own})") for own in shared]
        first = content.entries[0] if content.entries else None
        if first is not None and first.key == "variables" and not first.comment:
            assert isinstance(first.value, Body)
            own_names = names_of(first.value)
            variables = [each for each in variables if not names_of([each]) & own_names]
            first.value.entries[:0] = variables
        else:
            content.entries.insert(0, Entry("variables", Body(variables)))
    move_opening(content, function)
    function.add("body", content or None)
    key = macro.function + writer.scope_of(f"xacro:{name}")
    target = writer.functions if writer.here.is_top else body_of_last(body, "functions")
    target.note(body.remark)
    body.remark = ""
    target.add(key, function)
    body.latest = target.latest


def _default(writer: FileWriter, own: Parameter) -> str:
    value = writer.translator.value(own.default or "", own.name)
    if value == "":
        return "''"
    outside = without_expressions(value)
    if (
        (isinstance(value, Quoted) and is_typed(value))
        or any(char in outside for char in ",[]{}#'\"&*!|>%@`")
        or ": " in outside
        or " " in outside
    ):
        return "'" + value.replace("'", "''") + "'"
    return value


# --- conditions: opposite ones are joined, variables of both get conditional values -----------


LONGEST_CHOICE = 80
"""Characters that a conditional value may have."""


def write_condition(writer: FileWriter, node: Element, body: Body) -> None:
    """Write a condition, or what is done else below its opposite."""
    text = format_value(node.attributes.get("value"))
    condition = writer.translator.condition(text)
    if node.name == "xacro:unless":
        condition = negated(condition)
    content = writer.body(node.children)
    if content is not None:
        content.in_braces = False
    last = body.entries[-1] if body.entries else None
    if last is not None and last.key == "if" and not body.remark:
        assert isinstance(last.value, Body)
        before = str(last.value.entries[0].value)
        are_opposite = before == negated(condition) or negated(before) == condition
        changed: set[str] = set()
        for entry in last.value.entries_below():
            if entry.key == "variables" and isinstance(entry.value, Body):
                changed |= names_of(entry.value)
            is_call = entry.key.startswith("$(") or entry.key.rpartition(".")[2][:1].isupper()
            if entry.key == "include" or is_call:
                changed |= writer.program.assigned_from_inside
        if are_opposite and not names_in(text) & changed:
            if not _join_variables(writer, last, content, body):
                body.add("else", content)
            return
    statement = Body([Entry("condition", condition), Entry("body", content)])
    move_opening(content, statement)
    body.add("if", statement)


def _join_variables(writer: FileWriter, first: Entry, content: Body | None, body: Body) -> bool:
    """Write variables with conditional values, and return whether that is all there is to do."""
    assert isinstance(first.value, Body)
    condition, inner = first.value.entries
    assert isinstance(condition.value, str)
    if first.ending or first.value.opening or not isinstance(inner.value, Body):
        return False
    one_side, other_side = _only_variables(inner.value), _only_variables(content)
    if one_side is None or other_side is None or len(one_side.entries) != len(other_side.entries):
        return False
    joined: list[Entry] = []
    for one, other in zip(one_side, other_side, strict=True):
        values = _python_of(one.value), _python_of(other.value)
        value = f"$({values[0]} if {condition.value} else {values[1]})"
        if one.key != other.key or None in values or len(value) > LONGEST_CHOICE:
            return False
        joined.append(Entry(one.key, value))
    if not joined:
        return False
    body.entries.pop()
    variables = body_of_last(body, "variables")
    if names_of(variables) & names_of(joined):
        variables = Body()
        body.add("variables", variables)
    if variables:
        variables.note(first.comment)
    else:
        body.entries[-1].comment = first.comment
    for entry in joined:
        variables.append(entry)
        writer.choices.add(id(entry))
    body.latest = variables.latest
    return True


def _only_variables(body: Body | None) -> Body | None:
    """Return the variables that a body declares, if it does nothing else."""
    if body is None or len(body.entries) != 1 or body.remark or body.opening:
        return None
    entry = body.entries[0]
    if entry.key != "variables" or entry.comment or not isinstance(entry.value, Body):
        return None
    variables = entry.value
    has_comments = any(own.comment or own.ending for own in variables) or variables.remark
    return None if has_comments or variables.opening else variables


def _python_of(value: object) -> str | None:
    """Return the value of a variable as Python, or None."""
    if not isinstance(value, str) or not value.isprintable():
        return None
    if value.startswith("$(") and skip_expression(value, 0) == len(value):
        python = value[2:-1].strip()
        try:
            tree = ast.parse(python, mode="eval").body
        except (SyntaxError, ValueError):
            return None
        return f"({python})" if isinstance(tree, (ast.IfExp, ast.Lambda)) else python
    if "$" in value:
        return None
    meant = str(value) if isinstance(value, Quoted) else type_plain(value)
    return str(meant).lower() if isinstance(meant, bool) else repr(meant)


# --- calls, and the blocks that they pass and insert ------------------------------------------


def write_block(writer: FileWriter, node: Element, body: Body) -> None:
    """Write where a block is inserted."""
    name = name_of(node)
    if name in writer.here.blocks or name in writer.program.blocks:
        owner = writer.here.macro if name in writer.here.blocks else None
        writer.placing.note((owner.name if owner else None, name), writer.here.holder)
        body.add(block_name(writer, name))
    else:
        raise CannotMigrate(f"there is no block '{name}'")


def write_call(writer: FileWriter, node: Element, body: Body) -> None:
    """Write a call."""
    name = node.name.removeprefix("xacro:")
    macro = writer.program.macro_called(node)
    if macro is not None and macro.name in writer.layout.borrowed:
        writer.layout.borrowed[macro.name].write_call(writer, node, body)
        return
    arguments = Body(in_braces=True)
    for key, value in node.attributes.items():
        arguments.add(key, writer.translator.value(format_value(value), key))
    if macro is not None:
        writer.placing.note(macro.name, writer.here.holder)
    if macro is None:
        # the sources call a function that is nowhere; such calls are made on purpose
        if node.elements() or "." in name or not is_identifier(camel(name)):
            raise CannotMigrate(f"there is no macro '{name}'")
        hint = "the sources call it too, which is an error where it is reached, as in xacro"
        writer.lose(node.span, f"there is no macro '{name}'", hint)
        body.add(camel(name), arguments or None)
        return
    # add the arguments that a call does not give, and takes from what is around it
    visible = writer.here.parameters | writer.here.locals | writer.program.at_top
    for own in macro.parameters:
        if own.name in node.attributes:
            continue
        is_seen = own.name in visible or (
            own.default is None and own.name in writer.program.inherited
        )
        if own.is_forwarded and is_seen:
            arguments.add(own.name, f"$({own.name})")
        elif own.default is not None and macro.is_default_of_caller(own):
            arguments.add(own.name, writer.translator.value(own.default, own.name))
    if macro.blocks():
        renamed = _keep_own(writer, node, macro, body)
        with writer.at(writer.here.renaming(renamed)):
            _add_blocks(writer, node, macro, arguments)
        contents = [entry.value for entry in arguments if isinstance(entry.value, Body)]
        arguments.in_braces = all(content.in_braces for content in contents)
    namespace = name.rpartition(".")[0]
    if namespace and not writer.is_namespace(namespace):
        raise CannotMigrate(f"the namespace '{namespace}' is made in another file")
    function = f"{namespace}.{macro.function}" if namespace else macro.function
    body.add(function, arguments or None)


def _keep_own(writer: FileWriter, node: Element, macro: Macro, body: Body) -> dict[str, str]:
    """Return other names for variables in the blocks of a call, and declare these above it.

    To xacro, a block has the values of who calls. To the language, the variables of the macro that
    inserts it come first. So a variable whose name that macro uses for something else is renamed.
    """
    blocks = [child for child in node.children if isinstance(child, Element)]
    read = {
        writer.variable(name): f"${{{name}}}"
        for block in blocks
        for name in used_in(block) - defined_in(block)
        if not writer.is_namespace(name)
    } | {
        writer.argument_name(name): f"$(arg {name})"
        for block in blocks
        for name in arguments_in(block)
    }
    given = {key: format_value(value).strip() for key, value in node.attributes.items()}
    forwarded = {own.name for own in macro.parameters if own.is_forwarded} - given.keys()
    renamed = {
        name: f"outer_{name}"
        for name in sorted(read.keys() & writer.callees.names_around_blocks(macro))
        if given.get(name) != read[name] and name not in forwarded
    }
    if not renamed:
        return {}
    remark, body.remark = body.remark, ""
    variables = body_of_last(body, "variables")
    if names_of(variables) & {*renamed, *renamed.values()}:
        variables = Body()
        body.add("variables", variables)
    for name, other in renamed.items():
        variables.add(other, f"$({name})")
    body.remark = remark
    return renamed


def _add_blocks(writer: FileWriter, node: Element, macro: Macro, arguments: Body) -> None:
    given = [child for child in node.children if isinstance(child, Element)]
    blocks = macro.blocks()
    # an entry for each child of an element that has no more than the comments on it
    remarks = Body()
    endings = comments_at_ends(node.children)
    for child in node.children:
        if isinstance(child, Element):
            remarks.add("")
        elif isinstance(child, Comment):
            add_loose(child, remarks, endings)
    arguments.opening = remarks.opening
    if len(blocks) != len(given) or any(
        block.startswith("**") and child.name in _CONDITIONS
        for block, child in zip(blocks, given, strict=False)
    ):
        _add_chosen(writer, macro, node, arguments)
        return
    for block, child, remark in zip(blocks, given, remarks, strict=True):
        name = block_name(writer, block.lstrip("*"))
        is_content = block.startswith("**")
        if is_content and is_statement(child):
            raise CannotMigrate(f"the block '{block}' of '{macro.name}' is computed")
        own = block.lstrip("*")
        place = writer_of_block(writer, macro, own)
        with writer.within(
            place, is_in_element=writer.here.is_in_element, holder=(macro.name, own)
        ):
            content = writer.body(child.children if is_content else [child])
        if content is not None and not is_content:
            content.in_braces = all(isinstance(entry.value, str) for entry in content)
        if content is not None or remark.comment or remark.ending:
            arguments.append(Entry(name, content, remark.comment))
            arguments.note_end(remark.ending)
    arguments.note(remarks.remark)


def _add_chosen(writer: FileWriter, macro: Macro, node: Element, arguments: Body) -> None:
    """Add blocks that conditions choose: each element, or row of conditions, is one of them."""
    blocks = macro.blocks()
    # elements one by one, but conditions that follow each other together
    rows: list[list[Node]] = []
    was_condition = False
    for each in node.children:
        if not isinstance(each, Element):
            continue
        is_condition = each.name in _CONDITIONS
        if is_condition and was_condition:
            rows[-1].append(each)
        else:
            rows.append([each])
        was_condition = is_condition
    if len(blocks) == 1 and not blocks[0].startswith("**"):
        rows = [node.children]
    if len(rows) != len(blocks):
        raise CannotMigrate(f"the blocks of '{macro.name}' are computed")
    for block, row in zip(blocks, rows, strict=True):
        own = block.lstrip("*")
        content = row
        if block.startswith("**"):
            content = [inner for each in row for inner in _inside(each, block, macro)]
        with writer.within(
            writer_of_block(writer, macro, own),
            is_in_element=writer.here.is_in_element,
            holder=(macro.name, own),
        ):
            arguments.add(block_name(writer, own), writer.body(content))


_CONDITIONS = ("xacro:if", "xacro:unless")


def _inside(node: Node, block: str, macro: Macro) -> list[Node]:
    """Return what is in an element, or in those that a condition chooses from."""
    if not isinstance(node, Element):
        return []
    if node.name in _CONDITIONS:
        inner = [each for child in node.children for each in _inside(child, block, macro)]
        return [node.with_children(inner)]
    if is_statement(node):
        raise CannotMigrate(f"the block '{block}' of '{macro.name}' is computed")
    return node.children


def write_call_by_name(writer: FileWriter, node: Element, body: Body) -> None:
    """Write a call whose macro is given by an attribute."""
    given = format_value(node.attributes.get("macro"))
    if "$" in given:
        # call the macro whose name an expression gives, if none of them takes a block
        macros = writer.program.macros.values()
        if node.elements():
            raise CannotMigrate("the macro that is called is computed, and takes blocks")
        names = {macro.name: macro.function for macro in macros if not macro.blocks()}
        for name in names:
            writer.placing.note(name, None)
        arguments = Body(in_braces=True)
        for key, value in node.attributes.items():
            if key != "macro":
                arguments.add(key, writer.translator.value(format_value(value), key))
        body.add(f"$({names!r}[{writer.translator.joined(given)}])", arguments or None)
        return
    attributes = {k: v for k, v in node.attributes.items() if k != "macro"}
    named = Element(f"xacro:{given}", node.span, attributes, node.children)
    write_call(writer, named, body)


def block_name(writer: FileWriter, name: str) -> str:
    """Return what a block is called, which no function is."""
    stem = camel(name)
    taken = {macro.function for macro in writer.program.definitions.values()}
    return f"{stem}Block" if stem in taken else stem


def writer_of_block(writer: FileWriter, macro: Macro | None, name: str) -> Write | None:
    """Return what writes the elements of a block."""
    is_in_part = writer.contents.may_block_be_in_part(macro, name)
    return writer.write_for_parts if is_in_part else None
