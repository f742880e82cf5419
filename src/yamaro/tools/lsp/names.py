"""The names that a file declares and uses, with the contexts they are in, without running it.

A context is what the language calls one: a run of the file, or of a function. The content of a
block is one too, since what it declares is local to the call that inserts it.
"""

from __future__ import annotations

from ...source import Span
from ...syntax.nodes import (
    LOCAL,
    Body,
    CallNode,
    CommentNode,
    DictValue,
    DynamicNode,
    ElementNode,
    ForNode,
    FunctionNode,
    FunctionsNode,
    IfNode,
    IncludeNode,
    InsertNode,
    ListContent,
    ListValue,
    PartNode,
    PrintNode,
    ProcessNode,
    RobotWordNode,
    TextContent,
    TextNode,
    VariablesNode,
)
from ...syntax.python import PythonCode, Template
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode, pairs_below
from .python_names import names_in_code

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any

    from ...syntax.nodes import Argument, Document
    from ...yaml.nodes import YamlNode

FILE, FUNCTION, BLOCK = "file", "function", "block"
"""The kinds of contexts."""
VARIABLE, PARAMETER, ITERATOR, ARGUMENT = "variable", "parameter", "iterator", "argument"
IMPORTED, ASSIGNED, NAMESPACE = "import", "assigned", "namespace"
FUNCTION_NAME, BLOCK_NAME = "function", "block"
"""The kinds of declarations; functions and blocks have names of their own."""
CALLED = (FUNCTION_NAME, BLOCK_NAME)


class Context:
    """A file, a function or the content of a block.

    Attributes:
        kind: FILE, FUNCTION or BLOCK.
        parent: the context it is written in.
        start: where it begins in the text.
        end: where it ends.
        callee: for a block, the name of the function that it is passed to.
        declared: what is declared in it, by name.
    """

    def __init__(self, kind: str, parent: Context | None, start: int, end: int) -> None:
        self.kind = kind
        self.parent = parent
        self.start = start
        self.end = end
        self.callee = ""
        self.declared: dict[str, list[Declaration]] = {}

    def find(self, name: str, *, is_called: bool) -> list[Declaration]:
        """Return the declarations of a name in this context."""
        return [each for each in self.declared.get(name, ()) if (each.kind in CALLED) == is_called]


class Declaration:
    """A name where it is declared.

    Attributes:
        name: as Python knows it.
        kind: one of the kinds above.
        scope: the word after the slash, `local` by default.
        span: the name itself.
        context: where it is declared.
        node: what declares it, of the syntax tree.
    """

    __slots__ = ("context", "kind", "name", "node", "scope", "span")

    def __init__(
        self, name: str, kind: str, span: Span, context: Context, *, scope: str, node: object
    ) -> None:
        self.name = name
        self.kind = kind
        self.span = span
        self.context = context
        self.scope = scope
        self.node = node


class Use:
    """A name where it is used.

    Attributes:
        name: what is used.
        is_called: whether it is a function or a block.
        span: the name itself.
        context: where it is used.
        owner: what it belongs to: the function whose argument it names, the include or attached
            file whose variable it names, the namespace that it is an attribute of; or None.
        is_assigned: whether `process` sets it here.
    """

    __slots__ = ("context", "is_assigned", "is_called", "name", "owner", "span")

    def __init__(
        self,
        name: str,
        span: Span,
        context: Context,
        *,
        is_called: bool = False,
        owner: CallNode | IncludeNode | str | None = None,
        is_assigned: bool = False,
    ) -> None:
        self.name = name
        self.span = span
        self.context = context
        self.is_called = is_called
        self.owner = owner
        self.is_assigned = is_assigned


class Include:
    """An include or an attached file; `path` is as it is written, None if it is computed."""

    __slots__ = ("context", "node", "path")

    def __init__(self, node: IncludeNode, path: str | None, context: Context) -> None:
        self.node = node
        self.path = path
        self.context = context


class Names:
    """What a file declares and uses.

    Attributes:
        contexts: the file first, then its functions and blocks, outer ones before inner ones.
        declarations: in the order they were found.
        includes: the files it includes or attaches.
        has_computed: whether names of variables are computed.
    """

    def __init__(self, document: Document, root: YamlNode | None) -> None:
        """Walk through a file."""
        self.document = document
        self.file = Context(FILE, None, 0, len(document.source.text) + 1)
        self.contexts = [self.file]
        self.declarations: list[Declaration] = []
        self.includes: list[Include] = []
        self.has_computed = False
        self._codes: list[tuple[PythonCode, Context]] = []
        self._uses: list[Use] = []
        self._is_sorted = False
        self._values = _values_by_key(root)
        self._iterators = [each for each in document.declarations if each[1] == LOCAL]
        self._walk()

    @property
    def uses(self) -> list[Use]:
        """Return the names that are used, in order; expressions are read when this is asked."""
        for code, context in self._codes:
            self._read_code(code, context)
        if self._codes or not self._is_sorted:
            self._codes = []
            self._uses.sort(key=lambda use: use.span.start)
            self._is_sorted = True
        return self._uses

    def context_at(self, offset: int) -> Context:
        """Return the innermost context around an offset."""
        found = self.file
        for context in self.contexts:
            if context.start <= offset < context.end and context.start >= found.start:
                found = context
        return found

    # --- the walk ---------------------------------------------------------------------------

    def _walk(self) -> None:
        document, file = self.document, self.file
        for module in document.imports:
            names = module.names or [(module.module, module.alias or module.module.split(".")[0])]
            for _, alias in names:
                self._declare(alias, IMPORTED, _name_in(module.span, alias), file, node=module)
        for entry in document.arguments or ():
            self._declare(entry.name, ARGUMENT, _name_in(entry.span, entry.name), file, node=entry)
            self._value(entry.default, file)
        self._content(document.robot_name, file)
        for section in document.sections:
            self._statement(section, file)
        for body in document.model:
            self._body(body, file)
        if document.root is not None:
            self._statement(document.root, file)

    def _declare(
        self,
        name: str,
        kind: str,
        span: Span,
        context: Context,
        *,
        node: object,
        scope: str = LOCAL,
    ) -> None:
        found = Declaration(name, kind, span, context, scope=scope, node=node)
        self.declarations.append(found)
        context.declared.setdefault(name, []).append(found)

    def _body(self, body: Body | None, context: Context) -> None:
        for statement in body.statements if body is not None else ():
            self._statement(statement, context)

    def _statement(self, node: object, context: Context) -> None:
        visit = _VISITS.get(type(node))
        if visit is not None:
            visit(self, node, context)

    def _element(self, node: ElementNode, context: Context) -> None:
        self._value(node.name, context)
        for attribute in node.attributes:
            self._value(attribute.name, context)
            self._value(attribute.value, context)
        self._content(node.content, context)

    def _content(self, content: object, context: Context) -> None:
        if isinstance(content, Body):
            self._body(content, context)
        elif isinstance(content, (TextContent, ListContent)):
            self._value(content.value, context)

    def _value(self, value: object, context: Context) -> None:
        if isinstance(value, Template):
            for part in value.parts:
                self._value(part, context)
        elif isinstance(value, PythonCode):
            self._codes.append((value, context))
        elif isinstance(value, (ListValue, list)):
            for item in value.items if isinstance(value, ListValue) else value:
                self._value(item, context)
        elif isinstance(value, DictValue):
            for key, item in value.pairs:
                self._value(key, context)
                self._value(item, context)

    def _text(self, node: TextNode | CommentNode | PrintNode, context: Context) -> None:
        self._value(node.value, context)

    def _part(self, node: PartNode, context: Context) -> None:
        self._body(node.body, context)

    def _robot_word(self, node: RobotWordNode, context: Context) -> None:
        for item in node.items:
            self._content(item.content, context)
            self._body(item.body, context)
            if item.include is not None:
                self._include(item.include, context)

    def _call(self, node: CallNode, context: Context) -> None:
        space, _, name = node.name.rpartition(".")
        at = node.span.start + (node.span.written().find(node.name) if node.name else 0)
        if space:
            self._use(space, Span(node.span.source, at, at + len(space)), context)
            at += len(space) + 1
        span = Span(node.span.source, at, at + len(name))
        self._uses.append(Use(name, span, context, is_called=True, owner=space or None))
        for argument in node.arguments:
            self._argument(argument, node, context)

    def _argument(self, argument: Argument, call: CallNode, context: Context) -> None:
        if argument.name is not None:
            span = _name_in(argument.span, argument.name)
            is_block = argument.name[:1].isupper()
            self._uses.append(Use(argument.name, span, context, is_called=is_block, owner=call))
        self._value(argument.value, context)
        if argument.block is not None:
            start, end = self._extent(argument.span)
            block = Context(BLOCK, context, start, end)
            block.callee = call.name
            self.contexts.append(block)
            self._body(argument.block, block)

    def _insert(self, node: InsertNode, context: Context) -> None:
        span = _name_in(node.span, node.name)
        self._uses.append(Use(node.name, span, context, is_called=True))
        self._body(node.default, context)

    def _dynamic(self, node: DynamicNode, context: Context) -> None:
        self._value(node.key, context)
        self._content(node.content, context)

    def _if(self, node: IfNode, context: Context) -> None:
        for condition, body in node.branches:
            self._value(condition, context)
            self._body(body, context)

    def _for(self, node: ForNode, context: Context) -> None:
        for name in node.names:
            span = self._iterator(name, node.span)
            self._declare(name, ITERATOR, span, context, node=node)
        self._value(node.iterable, context)
        self._body(node.body, context)

    def _iterator(self, name: str, key: Span) -> Span:
        """Return where an iterator is written: the first time at or below the key."""
        start, end = self._extent(key)
        for declared, _, span in self._iterators:
            if declared == name and start <= span.start <= end:
                return span
        return key

    def _include(self, node: IncludeNode, context: Context) -> None:
        path = node.path if isinstance(node.path, str) else node.path_span.written().strip("'\" ")
        is_known = isinstance(node.path, str) or path.startswith(("$(find ", "$(find-pkg-share "))
        self.includes.append(Include(node, path if is_known else None, context))
        self._value(node.path, context)
        if isinstance(node.namespace, str):
            span = self._namespace(node)
            self._declare(node.namespace, NAMESPACE, span, context, node=node)
        else:
            self._value(node.namespace, context)
        for argument in node.arguments:
            if argument.name is not None:
                span = _name_in(argument.span, argument.name)
                self._uses.append(Use(argument.name, span, context, owner=node))
            self._value(argument.value, context)

    def _namespace(self, node: IncludeNode) -> Span:
        value = self._values.get(node.span.start)
        for item in value.items if isinstance(value, SequenceNode) else [value]:
            for key, inner in item.pairs if isinstance(item, MappingNode) else ():
                if key.text == "namespace" and isinstance(inner, ScalarNode):
                    return inner.span()
        return node.span

    def _variables(self, node: VariablesNode, context: Context) -> None:
        for entry in node.entries:
            if isinstance(entry.name, str):
                span = _name_in(entry.span, entry.name)
                self._declare(entry.name, VARIABLE, span, context, node=entry, scope=entry.scope)
            else:
                self.has_computed = True
                self._value(entry.name, context)
            for value in entry.values:
                self._value(value, context)

    def _functions(self, node: FunctionsNode, context: Context) -> None:
        for function in node.functions:
            span = _name_in(function.span, function.name)
            self._declare(
                function.name, FUNCTION_NAME, span, context, node=function, scope=function.scope
            )
            start, end = self._extent(function.span)
            inner = Context(FUNCTION, context, start, end)
            self.contexts.append(inner)
            self._parameters(function, inner)
            self._body(function.body, inner)

    def _parameters(self, function: FunctionNode, inner: Context) -> None:
        for parameter in function.parameters:
            kind = BLOCK_NAME if parameter.is_block else PARAMETER
            span = _name_in(parameter.span, parameter.name)
            self._declare(parameter.name, kind, span, inner, node=parameter)
            self._value(parameter.default, inner)

    def _process(self, node: ProcessNode, context: Context) -> None:
        code = node.code
        for found in names_in_code(code):
            if found.is_assigned and not context.find(found.name, is_called=False):
                span = code.span(found.start, found.start + len(found.name))
                self._declare(found.name, ASSIGNED, span, context, node=node)
        self._codes.append((code, context))

    def _read_code(self, code: PythonCode, context: Context) -> None:
        for found in names_in_code(code):
            span = code.span(found.start, found.start + len(found.name))
            self._uses.append(
                Use(found.name, span, context, owner=found.owner, is_assigned=found.is_assigned)
            )

    def _use(self, name: str, span: Span, context: Context) -> None:
        self._uses.append(Use(name, span, context))

    def _extent(self, key: Span) -> tuple[int, int]:
        """Return where a key begins and what is under it ends."""
        value = self._values.get(key.start)
        end = key.end if value is None else max(key.end, value.end)
        return key.start, end


_VISITS: dict[type, Callable[[Names, Any, Context], None]] = {
    ElementNode: Names._element,
    TextNode: Names._text,
    CommentNode: Names._text,
    PrintNode: Names._text,
    PartNode: Names._part,
    RobotWordNode: Names._robot_word,
    CallNode: Names._call,
    InsertNode: Names._insert,
    DynamicNode: Names._dynamic,
    IfNode: Names._if,
    ForNode: Names._for,
    IncludeNode: Names._include,
    VariablesNode: Names._variables,
    FunctionsNode: Names._functions,
    ProcessNode: Names._process,
}


def _name_in(span: Span, name: str) -> Span:
    """Return the place of a name in what is written with it: `name/global`, `**Block`, `'name'`."""
    at = span.written().find(name)
    if at < 0:  # another spelling of the name, as Python normalizes it
        return span
    return Span(span.source, span.start + at, span.start + at + len(name))


def _values_by_key(root: YamlNode | None) -> dict[int, YamlNode]:
    """Return the value of each key by the offset at which the key begins."""
    return {key.start: value for key, value in pairs_below(root)}


def pairs_of_mappings(node: YamlNode | None) -> Sequence[tuple[ScalarNode, YamlNode]]:
    """Return the pairs of a mapping, or of all mappings in a list."""
    if isinstance(node, MappingNode):
        return node.pairs
    items = node.items if isinstance(node, SequenceNode) else ()
    return [pair for item in items if isinstance(item, MappingNode) for pair in item.pairs]
