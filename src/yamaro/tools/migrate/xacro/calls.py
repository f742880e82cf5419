"""Calls of macros as calls of functions, and the blocks that they pass and insert."""

from __future__ import annotations

from ....syntax.names import is_identifier
from ....xml.tree import Comment, Element
from ....xml.values import format_value
from ..document import Body, Entry
from ..elements import add_loose, comments_at_ends
from .arguments import arguments_in
from .names import camel, defined_in, used_in
from .parts import is_statement
from .python import CannotMigrate
from .surroundings import body_of_last, names_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ....xml.tree import Node
    from .macros import Macro
    from .parts import Write
    from .writer import FileWriter


def write_block(writer: FileWriter, node: Element, body: Body) -> None:
    """Write where a block is inserted."""
    name = format_value(node.attributes.get("name"))
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
        _call_unknown(writer, node, name)
        body.add(camel(name), arguments or None)
        return
    _add_forwarded(writer, node, macro, arguments)
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


def _call_unknown(writer: FileWriter, node: Element, name: str) -> None:
    """Note that the sources call a function that is nowhere; such calls are made on purpose."""
    if node.elements() or "." in name or not is_identifier(camel(name)):
        raise CannotMigrate(f"there is no macro '{name}'")
    hint = "the sources call it too, which is an error where it is reached, as in xacro"
    writer.lose(node.span, f"there is no macro '{name}'", hint)


def _add_forwarded(writer: FileWriter, node: Element, macro: Macro, arguments: Body) -> None:
    """Add the arguments that a call does not give, and takes from what is around it."""
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


def _add_blocks(writer: FileWriter, node: Element, macro: Macro, arguments: Body) -> None:
    given = [child for child in node.children if isinstance(child, Element)]
    blocks = macro.blocks()
    remarks = _remarks_on(node)
    arguments.opening = remarks.opening
    if len(blocks) != len(given) or _has_choice(blocks, given):
        _add_chosen(writer, macro, node, arguments)
        return
    for block, child, remark in zip(blocks, given, remarks, strict=True):
        name = block_name(writer, block.lstrip("*"))
        is_content = block.startswith("**")
        if is_content and is_statement(child):
            raise CannotMigrate(f"the block '{block}' of '{macro.name}' is computed")
        own = block.lstrip("*")
        place = place_of_block(writer, macro, own)
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


def _has_choice(blocks: list[str], given: list[Element]) -> bool:
    """Return whether the content of a block, without the element itself, is in a condition."""
    return any(
        block.startswith("**") and child.name in _CONDITIONS
        for block, child in zip(blocks, given, strict=False)
    )


def _add_chosen(writer: FileWriter, macro: Macro, node: Element, arguments: Body) -> None:
    """Add blocks that conditions choose: each element, or row of conditions, is one of them."""
    blocks = macro.blocks()
    rows = _rows(node.children)
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
            place_of_block(writer, macro, own),
            is_in_element=writer.here.is_in_element,
            holder=(macro.name, own),
        ):
            arguments.add(block_name(writer, own), writer.body(content))


_CONDITIONS = ("xacro:if", "xacro:unless")


def _rows(nodes: list[Node]) -> list[list[Node]]:
    """Return elements one by one, but conditions that follow each other together."""
    rows: list[list[Node]] = []
    was_condition = False
    for node in nodes:
        if not isinstance(node, Element):
            continue
        is_condition = node.name in _CONDITIONS
        if is_condition and was_condition:
            rows[-1].append(node)
        else:
            rows.append([node])
        was_condition = is_condition
    return rows


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


def _remarks_on(node: Element) -> Body:
    """Return an entry for each child of an element that has no more than the comments on it."""
    remarks = Body()
    endings = comments_at_ends(node.children)
    for child in node.children:
        if isinstance(child, Element):
            remarks.add("")
        elif isinstance(child, Comment):
            add_loose(child, remarks, endings)
    return remarks


def write_call_by_name(writer: FileWriter, node: Element, body: Body) -> None:
    """Write a call whose macro is given by an attribute."""
    given = format_value(node.attributes.get("macro"))
    if "$" in given:
        _call_computed(writer, node, given, body)
        return
    attributes = {k: v for k, v in node.attributes.items() if k != "macro"}
    named = Element(f"xacro:{given}", node.span, attributes, node.children)
    write_call(writer, named, body)


def _call_computed(writer: FileWriter, node: Element, given: str, body: Body) -> None:
    """Call the macro whose name an expression gives, if none of them takes a block."""
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


def block_name(writer: FileWriter, name: str) -> str:
    """Return what a block is called, which no function is."""
    stem = camel(name)
    taken = {macro.function for macro in writer.program.definitions.values()}
    return f"{stem}Block" if stem in taken else stem


def place_of_block(writer: FileWriter, macro: Macro | None, name: str) -> Write | None:
    """Return what writes the elements of a block."""
    is_in_part = writer.contents.may_block_be_in_part(macro, name)
    return writer.write_for_parts if is_in_part else None
