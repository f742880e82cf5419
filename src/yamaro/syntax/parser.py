"""Parses a file: its sections, its root element, and every error that can be found unrun."""

from __future__ import annotations

from ..diagnostics import Reporter, failure, given_twice, suggest
from ..source import Source, Span
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from ..yaml.reader import read_on
from .context import ParseContext, Rules
from .names import (
    ARGUMENTS,
    RAW_BLOCKS,
    ROBOT_SECTIONS,
    ROBOT_STATEMENTS,
    SECTIONS,
    STATEMENTS,
    head_of,
    is_function_name,
    is_identifier,
)
from .nodes import Document, ElementNode, ImportNode, Parsed, TextContent, VariablesNode
from .python import PythonCode, parse_template
from .statements import parse_body, parse_element, parse_pairs, parse_statement
from .values import Pairs, is_empty, pairs_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import CodeType

    from ..diagnostics import Diagnostic
    from ..yaml.nodes import YamlNode
    from ..yaml.reader import Reading


def parse(source: Source, *, rules: Rules | None = None) -> Parsed:
    """Return the syntax tree of a file, and all errors that can be found without running it.

    Nothing in the file makes it raise; whether errors raise is up to the caller.

    Args:
        source: the file.
        rules: what holds for it; by default that of a trusted file.
    """
    rules = rules or Rules()
    reporter = Reporter()
    reading = read_on(source, reporter=reporter, limits=rules.limits)
    return parse_reading(source, reading, reporter=reporter, rules=rules)


def parse_reading(
    source: Source, reading: Reading, *, reporter: Reporter, rules: Rules | None = None
) -> Parsed:
    """Return the syntax tree of a file that has been read, for those who need its nodes too.

    Args:
        source: the file.
        reading: what `read_on` gave of it.
        reporter: that of `read_on`; it takes the warnings of parsing, too.
        rules: what holds for it; by default that of a trusted file.
    """
    context = ParseContext(reporter, rules)
    document = Document(source)
    if reading.root is not None:
        try:
            context.attempt(_parse_root, reading.root, document, context)
        except RecursionError:  # only where the caller's stack is a shallow one
            fault = failure(
                "too-deep",
                "lists and mappings are nested too deep for the stack of this thread",
                reading.root.span(),
                hint="split the file with functions or `include`",
            )
            context.keep(fault)
    document.functions = context.functions
    document.bare_keys = context.bare_keys
    for python in context.codes:
        register(python, codes=document.codes, names_read=document.names_read)
    errors, warnings = context.errors, reporter.diagnostics
    if reading.hidden:
        from ..yaml.recovery import without_follow_ons

        errors = without_follow_ons(errors, source, reading.hidden)
        warnings = without_follow_ons(warnings, source, reading.hidden)
    return Parsed(
        document,
        errors=[*reading.errors, *sorted(errors, key=_start)],
        warnings=sorted(warnings, key=_start),
        hidden=reading.hidden,
        text=reading.text,
    )


def _start(diagnostic: Diagnostic) -> int:
    return diagnostic.span.start


def register(python: PythonCode, *, codes: dict[str, PythonCode], names_read: set[str]) -> None:
    """Note the names that some Python reads, and by its file name code that defines functions."""
    if python.name is not None:
        names_read.add(python.name)
        return
    pending: list[CodeType] = [python.code]
    while pending:
        code = pending.pop()
        names_read.update(code.co_names)
        for constant in code.co_consts:
            if isinstance(constant, type(code)):
                codes[code.co_filename] = python
                pending.append(constant)


def _parse_root(root: YamlNode, document: Document, context: ParseContext) -> None:
    statements: Pairs = []
    context.at_root = True
    for key, node in pairs_of(root, "a file", context):
        word = key.text
        if word == "robot" and isinstance(node, ScalarNode):
            context.attempt(_parse_robot_name, key, node, document, context)
        elif word == "import":
            context.attempt(_parse_imports, node, document, context)
        elif word == "model":
            context.attempt(_parse_model, key, node, document, context)
        elif word == ARGUMENTS:
            from .argument_section import parse_arguments

            context.attempt(parse_arguments, node, document, context)
        elif is_function_name(word) and word.lower() in (*SECTIONS, ARGUMENTS):
            context.attempt(_refuse_misspelt, key, word.lower())
        elif (
            word in STATEMENTS or word in ROBOT_SECTIONS or is_function_name(word) or head_of(word)
        ):
            statements.append((key, node))
        else:
            context.attempt(_parse_root_element, key, node, document, context)
    # a robot's section alone may be the root element too: that depends on who includes the file
    words = [pair for pair in statements if pair[0].text in ROBOT_SECTIONS]
    has_robot = document.robot_name is not None or document.model_span or document.root is not None
    if len(words) == 1 and not has_robot and document.arguments is None:
        context.attempt(_parse_root_element, *words[0], document, context)
        document.is_lone_section = document.root is not None
    document.sections = parse_pairs(statements, context).statements
    for section in document.sections:
        if isinstance(section, VariablesNode):
            section.is_root = True
    if document.arguments is not None:
        from .argument_section import refuse_variables_of_same_name

        refuse_variables_of_same_name(document, context)


def _parse_robot_name(
    key: ScalarNode, node: ScalarNode, document: Document, context: ParseContext
) -> None:
    if document.robot_name is not None:
        raise given_twice(
            "the robot's name is given twice",
            key.span(),
            document.robot_name.span,
            hint="keep one `robot:`",
        )
    if document.root is not None:
        _refuse_two_roots(key, document, context)
    if not is_empty(node):
        document.robot_name = TextContent(parse_template(node, context=context), node.span())


def _parse_model(
    key: ScalarNode, node: YamlNode, document: Document, context: ParseContext
) -> None:
    document.model_span = document.model_span or key.span()
    if document.root is not None:
        _refuse_beside_model(document.root.span, document.model_span, context)
    context.at_root = False
    body = context.attempt(parse_body, node, "`model`", context)
    context.at_root = True
    if body is not None:
        document.model.append(body)


def _parse_root_element(
    key: ScalarNode, node: YamlNode, document: Document, context: ParseContext
) -> None:
    word = key.text
    bare = word.partition("/")[0]
    is_name = bare.startswith("<") or bare in SECTIONS or bare in ROBOT_SECTIONS
    near = None if is_name else suggest(bare, SECTIONS)
    if near is not None and "/" not in word:
        _refuse_misspelt(key, near)
    if bare.startswith("xacro:"):
        raise failure(
            "unknown-section",
            f"'{bare}' is a xacro element, not a section of a file",
            key.span(),
            hint="write properties under `variables:`, macros under `functions:`, includes "
            "and calls under `model:`; see docs/coming-from-xacro.md",
        )
    items = node.items if isinstance(node, SequenceNode) else []
    if word == "robot" and items and not any(isinstance(item, MappingNode) for item in items):
        raise failure(
            "not-a-text",
            "`robot` takes a name or a body, and this is a list of values",
            node.span(),
            hint="write robot: NAME",
        )
    context.at_root = False
    try:
        is_word = word in (*ROBOT_STATEMENTS, *ROBOT_SECTIONS, *RAW_BLOCKS)
        parse_it = parse_element if is_word else parse_statement
        element = parse_it(key, node, context)
    finally:
        context.at_root = True
    if not isinstance(element, ElementNode) or not isinstance(element.name, str):
        raise failure(
            "bad-root",
            f"'{word}' cannot be the root element",
            key.span(),
            hint="the root element has a fixed name, such as `sdf/version='1.11':`",
        )
    if document.root is not None or document.model_span or document.robot_name is not None:
        _refuse_two_roots(key, document, context)
    document.root = element


def _refuse_misspelt(key: ScalarNode, near: str) -> None:
    from ..fixes import respelling

    raise failure(
        "unknown-section",
        f"'{key.text}' is not a section of a file",
        key.span(),
        hint=f"did you mean `{near}`? for a root element of that name, write <{key.text}>:",
        fix=respelling(key.span(), key.text, near, is_safe=True),
    )


def _refuse_two_roots(key: ScalarNode, document: Document, context: ParseContext) -> None:
    """Raise YamaroError for a second root element; once a file, since many may follow."""
    if any(error.code == "two-roots" for error in context.errors):
        return
    if document.root is not None:
        raise failure(
            "two-roots",
            f"'{key.text}' is a second root element",
            key.span(),
            hint="put it inside the root element; put elements of a robot under `model:`",
            notes=[f"the root element is at {document.root.span.place()}"],
        )
    if document.robot_name is not None and key.text.partition("/")[0] == "robot":
        raise failure(
            "two-roots",
            f"'{key.text}' is a second root element, after `robot:`",
            key.span(),
            hint="write robot/name=NAME: above the body, or `model:` instead of this `robot:`",
            notes=[f"the robot is named at {document.robot_name.span.place()}"],
        )
    if document.model_span is not None:
        _refuse_beside_model(key.span(), document.model_span, context)
    raise failure(
        "two-roots",
        f"'{key.text}' is a second root element, beside `robot:`",
        key.span(),
        hint=f"remove `robot:` if '{key.text}' is the root element",
    )


def _refuse_beside_model(span: Span, model: Span, context: ParseContext) -> None:
    """Raise YamaroError for a root element, or a key taken for one, beside `model:`."""
    if any(error.code == "two-roots" for error in context.errors):
        return
    from ..diagnostics import meant

    hint, fix = meant(span.written(), [ARGUMENTS], span)
    raise failure(
        "two-roots",
        f"'{span.written()}' is not a section, and a root element is not allowed beside `model:`",
        span,
        hint=hint
        or "put elements of a robot under `model:`; a file has a `model` or a root element",
        fix=fix,
        notes=[f"`model:` is at {model.place()}"],
    )


# --- imports ----------------------------------------------------------------------------------


def _parse_imports(node: YamlNode, document: Document, context: ParseContext) -> None:
    scalars = node.items if isinstance(node, SequenceNode) else [node]
    for scalar in scalars:
        if not isinstance(scalar, ScalarNode):
            raise failure(
                "bad-import",
                "`import` lists Python modules",
                scalar.span(),
                hint="write import: [math, numpy as np], or one per line after a dash",
            )
        if not is_empty(scalar):
            context.attempt(_parse_import, scalar, document)
    if isinstance(node, SequenceNode) and node.is_flow:
        # `[from math import pi, sin]` is two items; hint at that, should there be no module `sin`
        items = [s for s in node.items if isinstance(s, ScalarNode)]
        start: int | None = None
        for index, item in enumerate(items):
            if item.text.startswith("from "):
                start = index
            elif start is not None:
                whole = ", ".join(each.text for each in items[start : index + 1])
                for entry in document.imports:
                    if entry.span.start == item.start:
                        entry.hint = f"the commas of [ ] split a list of names: write '{whole}'"


def _parse_import(node: ScalarNode, document: Document) -> None:
    words = node.text.split()
    if words and words[0] == "from":
        if len(words) < 4 or words[2] != "import" or not _is_module(words[1]):
            raise failure(
                "bad-import",
                f"'{node.text}' is not an import",
                node.span(),
                hint="write from math import pi, sin",
            )
        names: list[tuple[str, str]] = []
        for piece in " ".join(words[3:]).strip("()").split(","):
            parts = piece.split()
            is_plain = len(parts) == 1 and is_identifier(parts[0])
            is_alias = len(parts) == 3 and parts[1] == "as" and is_identifier(parts[2])
            if not (is_plain or is_alias) or not is_identifier(parts[0]):
                raise failure(
                    "bad-import",
                    f"'{piece.strip()}' is not a name to import",
                    node.span(),
                    hint="list the names: from math import pi, sin",
                )
            names.append((parts[0], parts[-1]))
        document.imports.append(ImportNode(words[1], None, names, node.span()))
    else:
        for piece in node.text.split(","):
            document.imports.append(_parse_module(node, piece))


def _parse_module(node: ScalarNode, text: str) -> ImportNode:
    words = text.split()
    if len(words) == 3 and words[1] == "as" and _is_module(words[0]) and is_identifier(words[2]):
        return ImportNode(words[0], words[2], None, node.span())
    if len(words) == 1 and _is_module(words[0]):
        entry = ImportNode(words[0], None, None, node.span())
        if words[0].endswith(".py"):
            entry.hint = f"write the module without its extension: {words[0][:-3]}"
        return entry
    hint = "write math, or numpy as np, or from math import pi, sin"
    if words[:1] == ["import"]:
        hint = f"write '{' '.join(words[1:])}' without the word import"
    elif _is_module(text.strip().lstrip("./")):
        hint = f"write a module beside the file without a dot: {text.strip().lstrip('./')}"
    raise failure("bad-import", f"'{text.strip()}' cannot be imported", node.span(), hint=hint)


def _is_module(text: str) -> bool:
    return all(is_identifier(part) for part in text.split("."))
