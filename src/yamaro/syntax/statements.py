"""Parses bodies: sequences of statements, from mappings or lists of mappings."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, suggest, unknown_word
from ..source import Span
from ..xml.tree import Element, Text, inheriting
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .context import ParseContext
from .forms import NO_CHILDREN, as_put_out, element_put_out, static_children
from .keys import PlainKeyPlaces, find_outside, parse_attributes, parse_name, parse_plain_key
from .names import (
    RAW_BLOCKS,
    ROBOT_SECTIONS,
    ROBOT_STATEMENTS,
    ROOT_STATEMENTS,
    STATEMENTS,
    bad_variable_name,
    head_of,
    is_function_name,
    is_identifier,
    name_hint,
    python_name,
)
from .nodes import (
    Argument,
    Body,
    CallNode,
    Constant,
    Content,
    DynamicNode,
    ElementNode,
    ForNode,
    FunctionNode,
    FunctionsNode,
    IfNode,
    InsertNode,
    ListContent,
    ListValue,
    PartNode,
    Statement,
    TextContent,
    Value,
    walk,
)
from .python import PythonCode, Template, parse_template
from .signatures import (
    parse_argument_name,
    parse_function_name,
    parse_input,
    parse_short_arguments,
    parse_variables,
    refuse_repeated,
    refuse_second_function,
)
from .values import (
    Entries,
    Pairs,
    is_empty,
    item_hint,
    pairs_of,
    parse_bare_expression,
    parse_condition,
    parse_value,
    refuse_not_indented,
    warn_of_hidden_value,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Sequence
    from typing import NoReturn

    from ..diagnostics import Reporter
    from ..yaml.nodes import YamlNode
    from .keys import PlainKey
    from .nodes import Document

# --- bodies -----------------------------------------------------------------------------------


def parse_body(node: YamlNode, what: str, context: ParseContext) -> Body:
    """Return the statements of a body; what is wrong with one does not hide the others.

    Raises:
        YamaroError: it is neither a mapping nor a list of mappings.
    """
    pairs = pairs_of(node, what, context)
    refuse_not_indented(node)
    return parse_pairs(pairs, context)


def parse_pairs(pairs: Pairs, context: ParseContext) -> Body:
    """Return the statements that a body's pairs describe."""
    body = Body()
    chain: IfNode | None = None  # the `if` that an `elif` or `else` may follow
    plain_keys = {} if context.at_root else context.plain_keys
    for key, node in pairs:
        word = key.text
        plain = plain_keys.get(word)
        if plain is None and "/" in word and not context.at_root and head_of(word) is None:
            plain = parse_plain_key(word)
            if plain is not None:
                plain_keys[word] = plain
        if plain is not None:
            _add_plain(key, plain, node, body, context)
            chain = None
            continue
        if word in ("elif", "else") or head_of(word) == "elif":
            chain = context.attempt(_extend_if, chain, key, node, context)
            continue
        statement = context.attempt(parse_statement, key, node, context)
        chain = statement if isinstance(statement, IfNode) else None
        if statement is None and (word == "if" or head_of(word) == "if"):
            chain = IfNode([], key.span())
        if statement is not None:
            body.add(as_put_out(statement, body))
    return body


def parse_statement(key: ScalarNode, node: YamlNode, context: ParseContext) -> Statement:
    """Return the statement that one pair of a body describes.

    Raises:
        YamaroError: the statement is faulty.
    """
    word = key.text
    if context.at_root:
        refuse_at_root(key)
    parse = _PARSERS.get(word)
    if parse is None and (" " in word or "(" in word):
        parse = _PARSERS.get(head_of(word) or "")
        if parse is None:
            from .heads import refuse_other_heads

            refuse_other_heads(key)
    if parse is not None:
        return parse(key, node, context)
    is_section = context.at_root and word in ROBOT_SECTIONS
    if is_section or (word in ROBOT_STATEMENTS and not isinstance(node, ScalarNode)):
        from .robot_words import parse_robot_word

        return parse_robot_word(key, node, context)
    if word in RAW_BLOCKS and (
        is_empty(node) or not isinstance(node, ScalarNode) or node.text.startswith("$(")
    ):
        from .robot_words import parse_raw_block

        return parse_raw_block(key, node, context)
    if word.startswith("<") and word.endswith(">"):
        if word[1:-1] not in ("#text", "#comment"):
            return _parse_element(key, 1, len(word) - 1, node, context, verbatim=True)
        return _parse_leaf(key, node, context)
    if word in ("#text", "#comment"):
        return _parse_leaf(key, node, context)
    slash = find_outside(word, "/", 0, len(word))
    if slash < 0:
        return _parse_bare(key, node, context)
    if word[:slash] in STATEMENTS:
        raise failure(
            "statement-with-attributes",
            f"`{word[:slash]}` is a statement and has no attributes",
            key.span(),
            hint=f"write <{word}>: for an XML element of that name",
        )
    return _parse_element(key, 0, len(word), node, context, verbatim=False)


def _parse_bare(key: ScalarNode, node: YamlNode, context: ParseContext) -> Statement:
    """Parse a key without attributes: a call, an insertion, an element, or one of `$(…)`."""
    word = key.text
    if is_function_name(word):
        if word in context.blocks:
            default = None if is_empty(node) else parse_body(node, f"the block {word}", context)
            return InsertNode(word, default, key.span())
        return CallNode(word, parse_arguments(word, node, context), key.span())
    if "$" in word:
        template = parse_template(key, context=context)
        if isinstance(template, Template):
            inner = ParseContext(context.reporter, context.rules)
            inner.blocks, inner.codes = context.blocks, context.codes
            inner.functions = context.functions
            content = inner.attempt(parse_content, node, inner)
            return DynamicNode(template, node, content, inner.errors, key.span())
    element = _parse_element(key, 0, len(word), node, context, verbatim=False)
    assert isinstance(element.name, str), "its expression makes it one of `$(…)`"
    if word not in ROBOT_STATEMENTS and word not in RAW_BLOCKS:
        context.plain_keys[word] = (element.name, {})
        context.bare_keys.add(word)
    warn_of_misspelt_statement(key, node, context)
    return element


# --- elements ---------------------------------------------------------------------------------


def parse_element(key: ScalarNode, node: YamlNode, context: ParseContext) -> ElementNode:
    """Return a pair as an element, whatever its key means elsewhere.

    Raises:
        YamaroError: it is not an element.
    """
    return _parse_element(key, 0, len(key.text), node, context, verbatim=False)


def _parse_element(
    key: ScalarNode,
    start: int,
    end: int,
    node: YamlNode,
    context: ParseContext,
    *,
    verbatim: bool,
) -> ElementNode:
    """Parse `name/attributes` in `key.text[start:end]` with its content.

    Faults of the key do not hide those of the content.
    """
    text = key.text
    slash = find_outside(text, "/", start, end)
    name_end = slash if slash >= 0 else end
    while name_end > start and text[name_end - 1].isspace():
        name_end -= 1
    content = context.attempt(parse_content, node, context)
    name = parse_name(key, start, name_end, what="element", context=context)
    attributes = []
    if slash >= 0:
        attributes = parse_attributes(key, slash + 1, end, context=context)
    return ElementNode(name, attributes, content, span=key.span(), verbatim=verbatim)


def _add_plain(
    key: ScalarNode, plain: PlainKey, node: YamlNode, body: Body, context: ParseContext
) -> None:
    """Add an element whose key has been read to a body, as the long way round would.

    Nearly every line of a file without expressions comes through here.
    """
    name, attributes = plain
    try:
        content = parse_content(node, context)
    except YamaroError as error:
        context.keep(error)
        content = None
    children = NO_CHILDREN if content is None else static_children(content)
    if children is None:
        own = []
        if attributes:
            text = key.text
            own = parse_attributes(key, text.index("/") + 1, len(text), context=context)
        element = ElementNode(name, own, content, span=key, verbatim=False)
        body.add(element_put_out(element, body))
        return
    places = PlainKeyPlaces(key) if attributes else None
    body.statements.append(inheriting(name, key, attributes, children, places, False, body))


def parse_content(node: YamlNode, context: ParseContext) -> Content:
    """Return what stands under an element: text, a body, a list of plain values, or nothing.

    Raises:
        YamaroError: a list mixes entries and values.
    """
    if isinstance(node, ScalarNode):
        if is_empty(node):
            warn_of_hidden_value(node, context)
            return None
        return TextContent(parse_template(node, context=context), node.span())
    if isinstance(node, MappingNode):
        return parse_pairs(node.pairs, context)
    if isinstance(node, SequenceNode):
        mappings = sum(isinstance(item, MappingNode) for item in node.items)
        if mappings == 0 and node.items:
            value = parse_value(node, context)
            assert isinstance(value, ListValue)
            return ListContent(value, node.span())
        if mappings < len(node.items):
            plain = next(item for item in node.items if not isinstance(item, MappingNode))
            raise failure(
                "mixed-list",
                "this list mixes entries such as `name: value` with plain values",
                plain.span(),
                hint=item_hint(plain),
            )
    return parse_body(node, "an element", context)


# --- calls -----------------------------------------------------------------------


def parse_arguments(name: str, node: YamlNode, context: ParseContext) -> list[Argument]:
    """Return the arguments of a call, in the short form or as a mapping.

    Raises:
        YamaroError: an argument has no proper name, or is given twice.
    """
    if isinstance(node, ScalarNode):
        if is_empty(node) and node.style == "":
            warn_of_hidden_value(node, context)
            return []
        return parse_short_arguments(node, context)
    if isinstance(node, SequenceNode) and node.items and isinstance(node.items[0], ScalarNode):
        raise failure(
            "bad-argument",
            "the arguments of a call cannot be a list",
            node.span(),
            hint=f"write {name}: left, 2 for values by position, or each as name: value",
        )
    pairs = pairs_of(node, f"a call of {name}", context)
    arguments = [
        argument
        for key, value in pairs
        if (argument := context.attempt(_parse_argument, key, value, context)) is not None
    ]
    refuse_repeated(arguments)
    return arguments


def _parse_argument(key: ScalarNode, node: YamlNode, context: ParseContext) -> Argument:
    name = parse_argument_name(key, context)
    argument = Argument(name, node, key.span())
    items = node.items if isinstance(node, SequenceNode) else [node]
    is_body = is_empty(node) or all(isinstance(item, MappingNode) for item in items)
    if name[0].isupper() and is_body:
        argument.block = parse_body(node, f"the block {name}", context)
    else:
        argument.value = parse_value(node, context)
    return argument


# --- control flow -----------------------------------------------------------------------------


def _parse_if(key: ScalarNode, node: YamlNode, context: ParseContext) -> IfNode:
    return IfNode([_parse_branch(key, node, context)], key.span())


def _parse_branch(
    key: ScalarNode, node: YamlNode, context: ParseContext
) -> tuple[PythonCode | Constant | None, Body]:
    word = key.text
    head = head_of(word)
    if head is not None:
        from .heads import body_pairs, parse_head_condition

        pairs = body_pairs(head, node, context)
        inside = context.attempt(parse_pairs, pairs, context) or Body()
        return parse_head_condition(key, head, context), inside
    if isinstance(node, ScalarNode) and not is_empty(node):
        raise failure(
            "not-a-body",
            f"`{word}` has the entries `condition` and `body`",
            node.span(),
            hint=f"write `{word} {' '.join(node.text.split())}:` with the statements below it",
        )
    pairs = pairs_of(node, f"`{word}`", context)
    entries = Entries(word, pairs, ("condition", "body"), key.span())
    body_node = entries.get("body")
    body = Body()
    if body_node is not None:
        body = context.attempt(parse_body, body_node, f"the body of `{word}`", context) or body
    condition = parse_condition(entries.need("condition", "length > 1.0"), context)
    return condition, body


def _extend_if(
    chain: IfNode | None, key: ScalarNode, node: YamlNode, context: ParseContext
) -> IfNode | None:
    """Add an `elif` or `else` to the `if` right before it, and return what may follow."""
    if chain is None:
        raise failure(
            "lone-else",
            f"this `{key.text}` has no `if` right before it",
            key.span(),
            hint="put an `elif` or `else` directly after its `if`, at the same indentation",
        )
    if key.text != "else":
        branch = context.attempt(_parse_branch, key, node, context)
        if branch is not None:
            chain.branches.append(branch)
        return chain
    pairs = pairs_of(node, "`else`", context)
    if any(own.text == "condition" for own, _ in pairs):
        own = next(own for own, _ in pairs if own.text == "condition")
        raise failure(
            "unknown-key",
            "`else` has no condition",
            own.span(),
            hint="write `elif` for another condition",
        )
    if len(pairs) == 1 and pairs[0][0].text == "body":
        body = parse_body(pairs[0][1], "`else`", context)
    else:
        body = parse_pairs(pairs, context)
    chain.branches.append((None, body))
    return None


def _parse_for(key: ScalarNode, node: YamlNode, context: ParseContext) -> ForNode:
    if key.text != "for":
        from .heads import body_pairs, parse_head_iteration

        pairs = body_pairs("for", node, context)
        body = context.attempt(parse_pairs, pairs, context) or Body()
        names, spans, items = parse_head_iteration(key, context)
        return ForNode(names, items, body, name_spans=spans, is_range=False, span=key.span())
    if isinstance(node, ScalarNode) and not is_empty(node):
        refuse_text_of_for(node)
    pairs = pairs_of(node, "`for`", context)
    entries = Entries("for", pairs, ("iterator", "range", "in", "body"), key.span())
    body_node = entries.get("body")
    body = Body()
    if body_node is not None:
        body = context.attempt(parse_body, body_node, "the body of `for`", context) or body
    names, spans = parse_iterator(entries.need("iterator", "i"))
    iterable, is_range = parse_iterable(entries, len(names), context)
    return ForNode(names, iterable, body, name_spans=spans, is_range=is_range, span=key.span())


# --- declarations -----------------------------------------------------------------------------


def _parse_functions(key: ScalarNode, node: YamlNode, context: ParseContext) -> FunctionsNode:
    functions: list[FunctionNode] = []
    seen: dict[str, FunctionNode] = {}
    refuse_not_indented(node, functions=True)
    for own, value in pairs_of(node, "`functions`", context):
        function = context.attempt(_parse_function, own, value, context)
        if function is None:
            continue
        if function.name in seen:
            context.attempt(refuse_second_function, seen[function.name], function)
            continue
        seen[function.name] = function
        functions.append(function)
    return FunctionsNode(functions, key.span())


def _parse_function(key: ScalarNode, node: YamlNode, context: ParseContext) -> FunctionNode:
    signature = None
    if "(" in key.text:
        from .heads import signature_of

        signature = signature_of(key)
    name, scope = parse_function_name(key, has_signature=signature is not None)
    input_node: YamlNode | None
    body_node: YamlNode | None
    if signature is None:
        pairs = pairs_of(node, f"the function {name}", context)
        entries = Entries(name, pairs, ("input", "body"), key.span())
        input_node, body_node = entries.get("input"), entries.get("body")
    else:
        from .heads import wrapped_body

        input_node, body_node = signature, wrapped_body(node, context)
    parameters = []
    if input_node is not None:
        parameters = context.attempt(parse_input, input_node, context) or []
    outer, at_root = context.blocks, context.at_root
    context.at_root = False
    own = tuple(parameter.name for parameter in parameters if parameter.is_block)
    hidden = {parameter.name for parameter in parameters if not parameter.is_block}
    context.blocks = (*(block for block in outer if block not in hidden), *own)
    try:
        body = Body()
        if body_node is not None:
            body = context.attempt(parse_body, body_node, f"the function {name}", context) or body
    finally:
        context.blocks, context.at_root = outer, at_root
    function = FunctionNode(
        name, scope, parameters, body, span=key.span(), end=max(key.end, node.end)
    )
    context.functions.append(function)
    return function


def _parse_part(key: ScalarNode, node: YamlNode, context: ParseContext) -> PartNode:
    if isinstance(node, ScalarNode) and node.text and not is_empty(node):
        raise failure(
            "not-a-body",
            "a part needs entries such as `name: value`, not a text",
            node.span(),
            hint=f"to name the part, write name: {node.text} below it, indented",
        )
    return PartNode(parse_body(node, "a part", context), key.span())


def _parse_leaf(key: ScalarNode, node: YamlNode, context: ParseContext) -> Statement:
    from .leaves import parse_leaf

    return parse_leaf(key, node, context)


_PARSERS: dict[str, Callable[[ScalarNode, YamlNode, ParseContext], Statement]] = {
    "part": _parse_part,
    "if": _parse_if,
    "for": _parse_for,
    "include": _parse_leaf,
    "variables": parse_variables,
    "functions": _parse_functions,
    "print": _parse_leaf,
    "process": _parse_leaf,
}


# --- what a `for` runs over, and the names it gives to it -------------------------------------


Iterable = PythonCode | Value | list[PythonCode | Constant]
RANGE_FORMS = "write range: 6, or range: 0, 6, or range: 0, 6, 2"


def parse_iterator(node: YamlNode) -> tuple[list[str], list[Span]]:
    """Return the names in `iterator` with their places.

    Raises:
        YamaroError: one cannot name a variable.
    """
    scalars = node.items if isinstance(node, SequenceNode) else [node]
    names: list[str] = []
    spans: list[Span] = []
    for scalar in scalars:
        if not isinstance(scalar, ScalarNode):
            raise failure(
                "bad-iterator", "an iterator is a name", scalar.span(), hint="iterator: i"
            )
        start = 0
        for piece in scalar.text.split(","):
            name = piece.strip()
            first = start + len(piece) - len(piece.lstrip())
            span = scalar.span(first, first + len(name)) if name else scalar.span()
            start += len(piece) + 1
            if name in names:
                raise failure("bad-iterator", f"'{name}' is given twice", span)
            if not is_identifier(name):
                raise failure(
                    "bad-iterator",
                    bad_variable_name(name) if name else "an iterator is a name",
                    span,
                    hint=name_hint(name)
                    if name
                    else "write iterator: i, or iterator: name, length",
                )
            names.append(python_name(name))
            spans.append(span)
    if not names:
        raise failure("bad-iterator", "the iterator has no name", node.span(), hint="iterator: i")
    return names, spans


def parse_range(node: YamlNode, context: ParseContext) -> list[PythonCode | Constant] | PythonCode:
    """Return the numbers of a `range`, as one expression or a list of them.

    Raises:
        YamaroError: they are not expressions, are missing, or are more than three.
    """
    if isinstance(node, SequenceNode):
        check_range_count(len(node.items), node.span())
        return [parse_condition(item, context) for item in node.items]
    if not isinstance(node, ScalarNode) or is_empty(node):
        raise failure(
            "bad-range",
            "`range` takes one to three numbers",
            node.span(),
            hint=RANGE_FORMS,
        )
    return parse_bare_expression(node, context)


def check_range_count(count: int, span: Span) -> None:
    """Raise YamaroError unless a `range` has one to three numbers."""
    if not 1 <= count <= 3:
        raise failure(
            "bad-range",
            f"`range` takes one to three numbers, and these are {count}",
            span,
            hint=RANGE_FORMS,
        )


def parse_in(node: YamlNode, context: ParseContext) -> Value | PythonCode:
    """Return what follows `in`: a YAML list or mapping, or an expression.

    Raises:
        YamaroError: it is not an expression.
    """
    if isinstance(node, ScalarNode):
        return parse_bare_expression(node, context)
    return parse_value(node, context)


def refuse_text_of_for(node: ScalarNode) -> NoReturn:
    """Raise YamaroError for a `for` with a text in place of its entries."""
    iterator, word, items = node.text.partition(" in ")
    raise failure(
        "not-a-body",
        "`for` has the entries `iterator`, `range` or `in`, and `body`",
        node.span(),
        hint=f"write `for {iterator.strip()} in {items.strip()}:` with the statements below it"
        if word
        else "write each entry as `name: value`, on a separate line",
    )


def parse_iterable(entries: Entries, names: int, context: ParseContext) -> tuple[Iterable, bool]:
    """Return what a `for` with this number of names runs over, and whether that is a range.

    Raises:
        YamaroError: there is nothing to run over, or two things, or a range for several names.
    """
    range_node, in_node = entries.get("range"), entries.get("in")
    if range_node is not None and in_node is not None:
        raise failure(
            "given-twice",
            "`for` takes `range` or `in`, not both",
            entries.key("in").span(),
            notes=[f"`range` is given at {entries.key('range').span().place()}"],
        )
    if range_node is not None:
        if names > 1:
            raise failure(
                "bad-iterator",
                "a `range` has single numbers, so the iterator has one name",
                entries.key("iterator").span(),
                hint="use `in` for pairs, as in `in: [[a, 1], [b, 2]]`",
            )
        return parse_range(range_node, context), True
    if in_node is None:
        raise failure(
            "missing-key",
            "`for` needs an entry `range` or `in`",
            entries.span,
            hint="write range: 6, or in: [left, right]",
        )
    if is_empty(in_node):
        raise failure(
            "missing-key",
            "`in` is empty",
            entries.key("in").span(),
            hint="write in: [left, right], or the name of a list",
        )
    return parse_in(in_node, context), False


# --- what stands where it cannot, and what reads like something else than it is ---------------


def refuse_at_root(key: ScalarNode) -> None:
    """Raise YamaroError if a statement may not stand at the root of a file."""
    word = key.text
    if word in ROOT_STATEMENTS or word in ROBOT_SECTIONS or head_of(word):
        return
    if word in STATEMENTS or is_function_name(word):
        what = f"`{word}`" if word in STATEMENTS else f"the call `{word}`"
        raise failure(
            "misplaced-statement",
            f"{what} is not allowed at the root of a file",
            key.span(),
            hint="move it under `model:` or into the body of a function",
        )
    raise unknown_word(
        "misplaced-statement",
        f"'{word}' is not allowed in an `if` or `for` at the root of a file",
        key.span(),
        word,
        ROOT_STATEMENTS,
        hint="put elements under `model:`, and also an `if` that contains them",
    )


# Elements of URDF, SDF, MJCF and others that are near a statement's name.
_LOOK_MISSPELT = frozenset(
    "dart exclude far farm fog force fov friction included pair parent park parts path pin point "
    "points port pos ros sort".split()
)


_NEAR_STATEMENTS = ("friction", "friction2")
"""Keys of parts that are misspelt as easily."""


def warn_of_misspelt_statement(key: ScalarNode, node: YamlNode, context: ParseContext) -> None:
    """Warn of an element that reads like a misspelt statement, such as `inlcude: leg.yaml`."""
    word = key.text
    if word in _LOOK_MISSPELT:
        return
    if word == "import":
        context.report(
            "misspelt-statement",
            "'import' creates an XML element here; modules are imported at the root of the file",
            key.span(),
            hint="move it to the root of the file, or write <import>: for the element",
        )
        return
    near = suggest(word, (*STATEMENTS, *_NEAR_STATEMENTS)) if 2 <= len(word) <= 10 else None
    if near not in STATEMENTS:
        return
    mappings = node.items if isinstance(node, SequenceNode) else [node]
    inside = {key.text for item in mappings if isinstance(item, MappingNode) for key, _ in item}
    telling = {"condition", "body", "iterator", "range", "in", "path", "name", "joint", "link"}
    if near in ("include", "variables", "functions", "process") or inside & telling:
        from ..fixes import respelling

        context.report(
            "misspelt-statement",
            f"'{word}' creates an XML element; did you mean the statement `{near}`?",
            key.span(),
            hint=f"write {near}: for the statement, or <{word}>: for the element",
            fix=respelling(key.span(), word, near),
        )


def warn_of_miscased_calls(
    documents: Sequence[Document], reporter: Reporter, *, is_known: Callable[[str], bool]
) -> None:
    """Warn of elements such as `leg: {side: left}` where there is a function `Leg`.

    Whatever has a capital first letter is a call, and all else an element. Which functions there
    are is known when all files of the program are. `is_known` says which elements robots have.
    """
    functions = {_letters(each.name): each for one in documents for each in one.functions}
    for document in documents if functions else ():
        meant = {
            word: functions[_letters(word)]
            for word in document.bare_keys
            if _letters(word) in functions and not is_known(word)
        }
        for element in _elements_called(meant, document) if meant else ():
            word, span = str(element.name), element.span
            function = meant[word]
            if not _reads_like_call(element, function):
                continue
            if any(each is function for each in document.functions):
                around = document.symbols.context_at(span.start)
                if around.parent is not None and around.start >= function.span.start:
                    continue  # the element that a function of its name makes
            from ..fixes import respelling

            span = span.span() if isinstance(span, ScalarNode) else span
            reporter.report(
                "misspelt-statement",
                f"'{word}' creates an XML element; did you mean the function `{function.name}`?",
                span,
                hint=f"write {function.name}: to call it, or <{word}>: for the element",
                notes=(f"it is defined as {function.signature()} at {function.span.place()}",),
                fix=respelling(span, word, function.name),
            )


def _letters(name: str) -> str:
    return name.replace("_", "").casefold()


def _elements_called(names: Container[str], document: Document) -> list[Element | ElementNode]:
    """Return the elements of a syntax tree that have one of these names alone, in order."""
    found: dict[int, Element | ElementNode] = {}
    for node in walk(document):
        if isinstance(node, (Element, ElementNode)):
            for each in node.iter() if isinstance(node, Element) else (node,):
                if each.name in names and not each.attributes and not each.verbatim:
                    found.setdefault(each.span.start, each)
    return [found[start] for start in sorted(found)]


def _reads_like_call(element: Element | ElementNode, function: FunctionNode) -> bool:
    """Return whether what is in an element may be the arguments of a function."""
    content = element.content if isinstance(element, ElementNode) else element.children
    held = content.statements if isinstance(content, Body) else content
    names = {parameter.name for parameter in function.parameters}
    if isinstance(held, list) and held and not isinstance(held[0], Text):
        return any(isinstance(i, (Element, ElementNode)) and i.name in names for i in held)
    is_called_without = all(
        each.is_block or each.default is not None for each in function.parameters
    )
    return bool(names) if held else is_called_without
