"""A source as a whole: its header and its sections."""

from __future__ import annotations

import os
import re

from ....model.compare import is_used, prefixes_in
from ....syntax.names import STATEMENTS
from ....xml.values import format_value
from ..document import Body, Entry, Quoted, joined, literal
from ..elements import comments_above, tidy_text
from .definitions import PREDEFINED, is_late
from .python import CannotMigrate
from .surroundings import names_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ....xml.tree import Element
    from .writer import FileWriter


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
    for entry in [entry for entry in model if entry.key == "variables"]:
        assert isinstance(entry.value, Body)
        variables = entry.value
        if variables.remark or variables.opening or entry.ending:
            continue
        first = variables.entries[0] if variables.entries else None
        for own in list(variables):
            if _depends_on_nothing(writer, own, declared):
                comment = entry.comment if own is first else ""
                if own is first:
                    entry.comment = ""
                variables.entries.remove(own)
                own.comment = joined(comment, own.comment)
                declared.append(own)
        if not variables.entries:
            model.entries.remove(entry)


def _depends_on_nothing(writer: FileWriter, variable: Entry, declared: Body) -> bool:
    """Return whether a variable may as well be declared above the model."""
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
