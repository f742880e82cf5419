"""Hovers and inlay hints: values, masses and poses, the row of the manual."""

from __future__ import annotations

from ...source import Span
from ...syntax.argument_section import ArgumentEntry
from ...syntax.nodes import Constant, FunctionNode, Parameter, VariableEntry
from ...yaml.nodes import ScalarNode
from .bindings import Place, Program
from .contexts import PREDEFINED, VALUES, about, cursor_at, place_below, word_of
from .parts import links_of, part_lines
from .protocol import offset_at

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ...syntax.symbol_table import Declaration
    from .builds import Result
    from .protocol import Json
    from .workspace import Text, Workspace

MOST_VALUES = 5
"""Values of one variable that are shown."""


def hover(workspace: Workspace, parameters: Json) -> Json:
    """Return the hover as Markdown, or None if there is nothing to say."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    if text.is_yaml:
        lines, span = _in_yaml(workspace, text, offset)
    else:
        from .xml_names import hover_in_xml

        lines, span = hover_in_xml(workspace, text, offset)
    if not lines:
        return None
    result: Json = {"contents": {"kind": "markdown", "value": "\n\n".join(lines)}}
    if span is not None:
        result["range"] = workspace.range(span)
    return result


def _in_yaml(workspace: Workspace, text: Text, offset: int) -> tuple[list[str], Span | None]:
    program = Program(workspace, text.path)
    place = program.at(text, offset)
    if place is not None:
        lines = _of_name(workspace, program, place)
        if lines:
            return lines, place.span
    part = text.parts.at(offset)
    if part is not None:
        lines = part_lines(workspace, text, part)
        if lines:
            return lines, part.span
    return _of_word(workspace, text, offset)


# --- names ------------------------------------------------------------------------------------


def _of_name(workspace: Workspace, program: Program, place: Place) -> list[str]:
    found = program.declarations(place)
    if not found:
        known = PREDEFINED.get(place.name)
        return [f"**{place.name}**: {known}"] if known is not None else []
    first = found[0]
    declared = first.declaration
    if declared is None:
        return [f"**{place.name}**: passed at {first.span.place()}"]
    node = declared.node
    scope = "" if declared.scope == "local" else f", {declared.scope}"
    lines = [f"**{declared.name}** ({declared.kind}{scope})"]
    if isinstance(node, FunctionNode):
        lines = [f"```yaml\n{node.signature()}\n```"]
    elif isinstance(node, Parameter):
        lines.append(f"`{node.text}`")
    elif isinstance(node, ArgumentEntry):
        from ...declared_arguments import about as about_argument
        from ...declared_arguments import declared_of

        argument = declared_of(node)
        lines += [line for line in [about_argument(argument)] if line]
        if argument.default_text is not None:
            lines.append(f"default: `{argument.default_text}`")
    elif isinstance(node, VariableEntry):
        line, _ = node.span.location()
        written = first.text.source.line_text(line).strip().removeprefix("- ")[:200]
        if written:
            lines.append(f"```yaml\n{written}\n```")
    comment = first.text.comment_on(declared.span)
    if comment:
        lines.append(comment)
    values: dict[str, None] = {}  # in the last builds, where it is read or set
    for result in workspace.results_of(place.text.path):
        if result.root is None:
            continue
        for each in found:
            values.update(values_set(result, each.text, each.declaration))
        if not values and place.use is not None:  # what the scalar around it has read
            scalar = cursor_at(place.text.root, place.span.start).scalar
            if scalar is not None:
                at = result.offset_then(place.text, scalar.start)
                values.update(result.values.read.get((place.text.path, at, place.name), {}))
    if values:
        lines.append(f"value: {_listed(values)}")
    return lines


def values_set(result: Result, text: Text, declared: Declaration | None) -> Mapping[str, None]:
    """Return the values that a name had in a build where it is declared."""
    span = getattr(declared and declared.node, "span", None)
    if declared is None or not isinstance(span, Span):
        return {}
    at = result.offset_then(text, span.start)
    return result.values.set.get((text.path, at, declared.name), {})


def _listed(values: Iterable[str]) -> str:
    shown = list(values)
    text = ", ".join(f"`{value[:200]}`" for value in shown[:MOST_VALUES])
    return f"{text}, …" if len(shown) > MOST_VALUES else text


# --- words ------------------------------------------------------------------------------------


def _of_word(workspace: Workspace, text: Text, offset: int) -> tuple[list[str], Span | None]:
    """Return what the manual says of a key, or what a value came out as."""
    cursor = cursor_at(text.root, offset)
    scalar = cursor.scalar
    if scalar is None:
        return [], None
    if not cursor.is_key:
        return _of_value(workspace, text, scalar, cursor.keys)
    word = word_of(scalar.text)
    lines = []
    known = about(place_below(cursor.keys).name, word)
    if known is not None:
        lines.append(f"**{word}**: {known}")
    if word == "part":
        named = [each for each in text.parts.named if each.key is scalar]
        for each in named:
            lines += part_lines(workspace, text, each)
    elif isinstance(cursor.value, ScalarNode):
        lines += _of_value(workspace, text, cursor.value, cursor.keys)[0]
    return lines, scalar.span()


def _of_value(
    workspace: Workspace, text: Text, scalar: ScalarNode, keys: list[ScalarNode]
) -> tuple[list[str], Span | None]:
    lines = []
    for result in workspace.results_of(text.path):
        at = result.offset_then(text, scalar.start)
        written = result.values.written.get((text.path, at))
        if written and list(written) != [scalar.text]:
            lines.append(f"in the output: {_listed(written)}")
    key = word_of(keys[-1].text) if keys else ""
    place = place_below(keys[:-1]).name
    if not lines and "$" not in scalar.text and scalar.text in VALUES.get((place, key), ()):
        lines.append(f"**{key}**: {about(place, key)}")
    return lines, scalar.span()


# --- inlay hints ------------------------------------------------------------------------------


LONGEST = 40


def inlay_hints(workspace: Workspace, parameters: Json) -> Json:
    """Return the hints in a range."""
    text = workspace.text_at(parameters)
    if not workspace.settings.has_hints or not text.is_yaml:
        return []
    asked = parameters["range"]
    start = offset_at(text.source, asked["start"], workspace.encoding)
    end = offset_at(text.source, asked["end"], workspace.encoding)
    found = []
    for declared in text.names.declarations:
        node = declared.node
        if not isinstance(node, VariableEntry) or isinstance(node.values[0], Constant):
            continue
        values: dict[str, None] = {}
        for result in workspace.results_of(text.path):
            values.update(values_set(result, text, declared))
        if values:
            label = ", ".join(values)
            label = label if len(label) <= LONGEST else f"{label[: LONGEST - 1]}…"
            found.append((_line_end(text, node.span.start), f"= {label}"))
    for part in text.parts.named:
        masses = dict.fromkeys(
            f"{link.mass:.4g} kg" for _, link in links_of(workspace, text, part) if link.mass
        )
        if masses:
            found.append((_line_end(text, part.span.start), ", ".join(list(masses)[:3])))
    return [
        {"position": workspace.position(text, at), "label": label, "paddingLeft": True}
        for at, label in found
        if start <= at <= end
    ]


def _line_end(text: Text, offset: int) -> int:
    line, _ = text.source.location(offset)
    return text.source.line_starts()[line - 1] + len(text.source.line_text(line).rstrip())
