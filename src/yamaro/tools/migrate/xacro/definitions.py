"""What defines a name in xacro, as Yamaro has it: arguments, properties, macros."""

from __future__ import annotations

from ....runtime.predefined import CONSTANTS
from ....syntax.names import FACTORS, is_identifier
from ....xml.tree import Element
from ....xml.values import format_value
from ..document import Body, Entry, Quoted, Row, without_expressions
from .arguments import arguments_of, is_argument
from .calls import block_name, place_of_block
from .loops import find_loop
from .macros import Macro
from .names import names_in
from .python import CannotMigrate, is_typed
from .surroundings import body_of_last, move_opening, names_of

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
    from ....xacro.statements import Parameter
    from .writer import FileWriter


def write_argument(writer: FileWriter, node: Element, body: Body) -> None:
    """Leave out an argument, which the main file declares, and the comments above it.

    A default that is made of properties, or is one of several that may come first, is given
    where it stands, if there is no value yet.
    """
    body.remark = ""
    body.latest = Entry("")  # it takes the comments at the end of the line
    name = format_value(node.attributes.get("name"))
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
        _define_block(writer, node, name, body)
        return
    text = given.get("value", given.get("default", ""))
    if is_argument(text, name) and name not in writer.here.hides:
        return
    if not _may_be_evaluated(writer, node, text):
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
    _sort(writer, variables, name, text)


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


def _sort(writer: FileWriter, variables: Body, name: str, text: str) -> None:
    """Put the last of variables before the first that reads it: xacro's are evaluated late."""
    entries = variables.entries
    writer.made_of[id(entries[-1])] = names_in(text)
    for index, entry in enumerate(entries):
        if entry is not entries[-1] and name in writer.made_of.get(id(entry), ()):
            entries.insert(index, entries.pop())
            return


def _may_be_evaluated(writer: FileWriter, node: Element, text: str) -> bool:
    """Return whether all that a value is made of is there: xacro evaluates only what is read."""
    known = writer.program.files.can_be_evaluated(node)
    if known is not None:
        return known
    return names_in(text) <= (
        writer.here.visible | PREDEFINED | writer.program.assigned_from_inside
    )


def _define_block(writer: FileWriter, node: Element, name: str, body: Body) -> None:
    with writer.within(place_of_block(writer, None, name), holder=(None, name)):
        function = Body([Entry("body", writer.body(node.children))])
    scope = writer.scope_of(name)
    writer.functions.note(body.remark)
    body.remark = ""
    writer.functions.add(block_name(writer, name) + scope, function)
    body.latest = writer.functions.latest


def write_macro(writer: FileWriter, node: Element, body: Body) -> None:
    """Write a macro as a function."""
    name = format_value(node.attributes.get("name")).removeprefix("xacro:")
    macro = writer.program.definitions.get((writer.path, node.span.start))
    if macro is None:
        raise CannotMigrate("the macro has no name")
    if writer.here.is_top and writer.program.is_defined_again(macro):
        why = f"this definition of '{name}' is left out: there is another one below"
        writer.lose(node.span, why)
        body.note(why)
        return
    function = Body()
    inputs = _inputs(writer, macro)
    if inputs:
        function.add("input", Row(inputs))
    place = writer.write_for_parts if writer.contents.may_be_in_part(macro) else None
    with writer.at(writer.here.in_macro(macro, writer.program, place)):
        content = _loop(writer, macro) or writer.statements(node.children)
    shared = [
        own
        for own in macro.values()
        if _is_handed_down(writer, own, macro) and not writer.callees.is_set_for_all(own, macro)
    ]
    if shared:
        _declare_first(content, [Entry(f"{own}/child", f"$({own})") for own in shared])
    move_opening(content, function)
    function.add("body", content or None)
    key = macro.function + writer.scope_of(f"xacro:{name}")
    target = writer.functions if writer.here.is_top else body_of_last(body, "functions")
    target.note(body.remark)
    body.remark = ""
    target.add(key, function)
    body.latest = target.latest


def _loop(writer: FileWriter, macro: Macro) -> Body | None:
    """Return the content of a macro that calls itself as a loop, if it can be one."""
    loop = find_loop(macro, writer.program, writer.translator)
    if loop is None:
        return None
    writer.here.visible = writer.here.visible | {loop.iterator}
    return loop.body(writer.statements, writer.translator.value)


def _inputs(writer: FileWriter, macro: Macro) -> list[str]:
    required: list[str] = []
    optional: list[str] = []
    blocks: list[str] = []
    for own in macro.parameters:
        if own.is_block:
            blocks.append("**" + block_name(writer, own.name.lstrip("*")))
        elif (own.is_forwarded and own.default is None) or macro.is_default_of_caller(own):
            required.append(own.name)
        elif own.default is not None:
            optional.append(f"{own.name}={_default(writer, own)}")
        elif macro.element.attributes["params"] and _has_empty_default(macro, own):
            optional.append(f"{own.name}=''")
        else:
            required.append(own.name)
    return required + optional + blocks


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


def _declare_first(content: Body, variables: list[Entry]) -> None:
    """Declare variables in front of all that is in a body."""
    first = content.entries[0] if content.entries else None
    if first is not None and first.key == "variables" and not first.comment:
        assert isinstance(first.value, Body)
        own = names_of(first.value)
        first.value.entries[:0] = [each for each in variables if not names_of([each]) & own]
        return
    content.entries.insert(0, Entry("variables", Body(variables)))


def _has_empty_default(macro: Macro, own: Parameter) -> bool:
    text = format_value(macro.element.attributes["params"])[own.start : own.end + 2]
    return ":=" in text or "=" in text
