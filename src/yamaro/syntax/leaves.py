"""Parses the statements that hold no others: texts, comments, `print`, `process`, `include`."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, suggest
from ..source import is_xml_file
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .context import ParseContext
from .names import is_identifier, name_hint
from .nodes import (
    Argument,
    CommentNode,
    IncludeNode,
    PrintNode,
    ProcessNode,
    TextContent,
    TextNode,
)
from .python import Template, compile_statements, parse_template
from .signatures import parse_argument_name
from .values import (
    Pairs,
    is_empty,
    is_mapping,
    pairs_of,
    parse_value,
    refuse_twice,
    warn_of_hidden_value,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..yaml.nodes import YamlNode
    from .nodes import Statement


def parse_leaf(key: ScalarNode, node: YamlNode, context: ParseContext) -> Statement:
    """Return the statement that one pair of a body describes.

    Raises:
        YamaroError: the statement is faulty.
    """
    word = key.text
    if word == "include":
        return parse_include(key, node, context)
    if word == "print":
        if isinstance(node, ScalarNode):
            warn_of_hidden_value(node, context)
            text = "" if is_empty(node) else parse_template(node, context=context)
            return PrintNode(text, node.span())
        return PrintNode(parse_value(node, context), node.span())
    if word == "process":
        if not isinstance(node, ScalarNode):
            raise failure(
                "not-a-text",
                "`process` takes Python statements as a text",
                node.span(),
                hint="write process: | and the statements, indented, on the lines below",
            )
        if node.anchor is not None:
            context.report(
                "anchored-expression",
                f"'&{node.anchor}' is a YAML anchor here, not a part of the statement",
                node.anchor_span(),
                hint="quote the statement, or delete the anchor",
            )
        code = compile_statements(node, context.rules)
        context.codes.append(code)
        return ProcessNode(code, key.span())
    word = word.strip("<>")  # `<#text>` or `<#comment>`
    if not isinstance(node, ScalarNode):
        raise failure(
            "not-a-text",
            f"<{word}> takes a text",
            node.span(),
            hint="use one such entry for each text",
        )
    text = "" if is_empty(node) else parse_template(node, context=context)
    return (TextNode if word == "#text" else CommentNode)(text, node.span())


# --- `include`: a path, a namespace, and what is passed to the file ---------------------------


OTHER_WORDS = ("file", "filename", "src", "from", "uri", "url")
"""What other formats call the path of an include."""

_FOLDERS = frozenset(("find", "file_dir", "dirname", "cwd", "env"))
"""What paths may be put together of that mean the same in each run."""


def parse_include(key: ScalarNode, node: YamlNode, context: ParseContext) -> IncludeNode:
    """Return an `include`, short or with arguments.

    Raises:
        YamaroError: it has no path, or an argument has no proper name.
    """
    if isinstance(node, ScalarNode):
        path = _parse_path(node, key, context)
        return IncludeNode(path, None, [], path_span=node.span(), span=key.span())
    return parse_include_of(key, pairs_of(node, "an include", context), context)


def parse_include_of(key: ScalarNode, pairs: Pairs, context: ParseContext) -> IncludeNode:
    """Return the include that the entries of an `include` or `attach` describe.

    Raises:
        YamaroError: it has no path, or an argument has no proper name.
    """
    word = key.text
    path_pair: tuple[ScalarNode, YamlNode] | None = None
    namespace_pair: tuple[ScalarNode, YamlNode] | None = None
    overlay_pair: tuple[ScalarNode, YamlNode] | None = None
    rest: Pairs = []
    given: Pairs = []  # under `arguments`, where they may have any name
    for own, value in pairs:
        if own.text == "path":
            refuse_twice(path_pair, own, word)
            path_pair = (own, value)
        elif own.text == "namespace":
            refuse_twice(namespace_pair, own, word)
            namespace_pair = (own, value)
        elif own.text == "overlay":
            refuse_twice(overlay_pair, own, word)
            overlay_pair = (own, value)
        elif own.text == "arguments" and is_mapping(value):
            given += pairs_of(value, "`arguments`", context)
        else:
            rest.append((own, value))
    if path_pair is None:
        raise _without_path(key, [own for own, _ in rest])
    path = _parse_path(path_pair[1], path_pair[0], context)
    if namespace_pair and isinstance(path_pair[1], ScalarNode) and is_xml_file(path_pair[1].text):
        rest.append(namespace_pair)  # XML has no names to put into one, but xacro files arguments
        namespace_pair = None
    namespace = _parse_namespace(namespace_pair[1], context) if namespace_pair else None
    arguments: list[Argument] = []
    seen: dict[str, tuple[ScalarNode, YamlNode]] = {}
    for own, value in rest + given:
        refuse_twice(seen.get(own.text), own, "include")
        seen[own.text] = (own, value)
        name = own.text.strip()
        if "$" not in name and not is_identifier(name):
            raise failure(
                "bad-argument",
                f"'{name}' cannot be the name of a variable that is passed to the file",
                own.span(),
                hint=name_hint(name),
            )
        argument = Argument(parse_argument_name(own, context), None, own.span())
        argument.value = parse_value(value, context)
        arguments.append(argument)
    path_span = path_pair[1].span()
    node = IncludeNode(
        path,
        namespace,
        arguments,
        namespace_span=namespace_pair[1].span() if namespace_pair else None,
        path_span=path_span,
        span=key.span(),
    )
    if overlay_pair is not None:
        node.overlay_span = overlay_pair[0].span()
        node.overlays = _parse_overlays(overlay_pair[1], context)
    return node


def _parse_overlays(node: YamlNode, context: ParseContext) -> list[TextContent | MappingNode]:
    """Return the overlays beside a path: a path or a mapping, or a list of these."""
    overlays: list[TextContent | MappingNode] = []
    for item in node.items if isinstance(node, SequenceNode) else [node]:
        if isinstance(item, MappingNode):
            overlays.append(item)
        elif isinstance(item, ScalarNode):
            if not is_empty(item):
                value = parse_template(item, context=context)
                overlays.append(TextContent(value, item.span()))
        else:
            raise failure(
                "not-an-overlay",
                "an overlay is the path of a file, or {joints: …, links: …}",
                item.span(),
                hint="write overlay: unit-17.yaml, or overlay: [cell.yaml, unit-17.yaml]",
            )
    return overlays


def _without_path(key: ScalarNode, keys: list[ScalarNode]) -> YamaroError:
    from ..fixes import respelling

    word, names = key.text, [each.text for each in keys]
    near = suggest("path", names) or next((n for n in names if n in OTHER_WORDS), None)
    return failure(
        "missing-key",
        f"`{word}` needs an entry `path`",
        key.span(),
        hint=f"did you mean `path` instead of '{near}'?"
        if near
        else f"write path: other.yaml{', or a body' if word == 'attach' else ''}",
        fix=respelling(keys[names.index(near)].span(), near, "path", is_safe=True)
        if near
        else None,
    )


def _parse_path(node: YamlNode, key: ScalarNode, context: ParseContext) -> str | Template:
    if not isinstance(node, ScalarNode) or is_empty(node):
        raise failure(
            "missing-key",
            "`include` needs the path of a file",
            key.span(),
            hint="write include: other.yaml, or include: {path: other.yaml, length: 2}",
        )
    return parse_template(node, context=context)


def is_computed(path: Template) -> bool:
    """Return whether it depends on variables which file a path means."""
    for part in path.parts:
        if isinstance(part, str):
            continue
        names = [part.name]
        if part.name is None:  # without the guards of safe mode
            names = [name for name in part.code.co_names if name in part.text]
        if not _FOLDERS.issuperset(names):
            return True
    return False


def _parse_namespace(node: YamlNode, context: ParseContext) -> str | Template:
    if isinstance(node, ScalarNode) and not is_empty(node):
        name = parse_template(node, context=context)
        if not isinstance(name, str) or is_identifier(name):
            return name
    raise failure(
        "bad-namespace",
        "a namespace is a single name",
        node.span(),
        hint="write namespace: Legs, and then Legs.BuildLeg: and $(Legs.index)",
    )
