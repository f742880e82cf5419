"""Conditions of xacro: opposite ones are joined, and variables of both have conditional values."""

from __future__ import annotations

from ....syntax.python import skip_expression
from ....xml.tree import Element
from ....xml.values import format_value
from ....yaml.nodes import type_plain
from ..document import Body, Entry, Quoted
from .names import names_in
from .python_texts import negated
from .surroundings import body_of_last, move_opening, names_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .writer import FileWriter

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
        changed = _declared_in(last.value)
        if _may_change_others(last.value):
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
    joined = _choices(condition.value, _only_variables(inner.value), _only_variables(content))
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


def _choices(condition: str, first: Body | None, second: Body | None) -> list[Entry]:
    """Return variables that have the values of one body or the other."""
    if first is None or second is None or len(first.entries) != len(second.entries):
        return []
    choices = []
    for one, other in zip(first, second, strict=True):
        values = _python_of(one.value), _python_of(other.value)
        if one.key != other.key or None in values:
            return []
        value = f"$({values[0]} if {condition} else {values[1]})"
        if len(value) > LONGEST_CHOICE:
            return []
        choices.append(Entry(one.key, value))
    return choices


def _python_of(value: object) -> str | None:
    """Return the value of a variable as Python, or None."""
    import ast

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


def _declared_in(body: Body) -> set[str]:
    """Return the names of the variables declared in a body, however deep."""
    names: set[str] = set()
    for entry in body:
        if isinstance(entry.value, Body):
            if entry.key == "variables":
                names |= names_of(entry.value)
            names |= _declared_in(entry.value)
    return names


def _may_change_others(body: Body) -> bool:
    """Return whether a body has calls or includes, which may set variables of others."""
    return any(
        entry.key == "include"
        or entry.key.startswith("$(")
        or entry.key.rpartition(".")[2][:1].isupper()
        or (isinstance(entry.value, Body) and _may_change_others(entry.value))
        for entry in body
    )
