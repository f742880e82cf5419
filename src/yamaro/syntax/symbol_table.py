"""The symbol table of a file: who declares, reads and assigns a name, without running it.

A context is what the language calls one: a run of the file, or of a function. The content of a
block is one too, since what it declares is local to the call that inserts it.
"""

from __future__ import annotations

from ..source import Span
from .nodes import (
    CHILDREN,
    LOCAL,
    Body,
    CallNode,
    Document,
    ForNode,
    FunctionNode,
    ImportNode,
    IncludeNode,
    InsertNode,
    ProcessNode,
    VariableEntry,
    children,
)
from .python import PythonCode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

FILE, FUNCTION, BLOCK = "file", "function", "block"
"""The kinds of contexts."""
VARIABLE, PARAMETER, ITERATOR, ARGUMENT = "variable", "parameter", "iterator", "argument"
IMPORTED, ASSIGNED, NAMESPACE, PASSED = "import", "assigned", "namespace", "passed"
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

    @property
    def is_inner(self) -> bool:
        """Return whether it is in a function or a block."""
        return self.context.kind != FILE

    def shares_context_with(self, span: Span) -> bool:
        """Return whether a place is in the file, and in the function or block, that this is in."""
        if self.span.source is not span.source:
            return False
        return not self.is_inner or self.context.start <= span.start < self.context.end


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


class SymbolTable:
    """The names of a file.

    Attributes:
        contexts: the file first, then its functions and blocks, outer ones before inner ones.
        declarations: in the order they were found.
        includes: the files it includes or attaches.
        has_computed: whether names of variables are computed.
    """

    def __init__(self, document: Document) -> None:
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
        self._blocks: dict[int, Context] = {}
        """The contexts of blocks, by the identities of their bodies."""
        pending: list[tuple[object, Context]] = [(document, self.file)]
        while pending:
            node, context = pending.pop()
            context = self._visit(node, context)
            inner = [each for each in children(node) if type(each) in _VISITED]
            pending += [(each, context) for each in reversed(inner)]

    @property
    def uses(self) -> list[Use]:
        """Return the names that are used, in order; expressions are read when this is asked."""
        from .python_names import names_in_code

        for code, context in self._codes:
            for found in names_in_code(code):
                span = code.span(found.start, found.start + len(found.name))
                self._uses.append(
                    Use(found.name, span, context, owner=found.owner, is_assigned=found.is_assigned)
                )
        if self._codes or not self._is_sorted:
            self._codes = []
            self._uses.sort(key=lambda use: use.span.start)
            self._is_sorted = True
        return self._uses

    @property
    def is_open(self) -> bool:
        """Return whether the file may declare any name, as it computes names or includes."""
        paths = [each.node.path for each in self.includes if not isinstance(each.node.path, str)]
        if self.has_computed or not paths:
            return self.has_computed
        from .leaves import is_computed

        return any(map(is_computed, paths))

    def declared_by_statements(self) -> Iterable[Declaration]:
        """Yield the declarations of variables, functions and what is like them, not by Python."""
        return (each for each in self.declarations if each.kind not in _BY_OTHERS)

    def where_declared(self, name: str) -> list[Declaration]:
        """Return where a name is declared, imported, or passed to an included file."""
        passed = [
            Declaration(name, PASSED, argument.span, each.context, scope=PASSED, node=each.node)
            for each in self.includes
            for argument in each.node.arguments
            if argument.name == name
        ]
        declared = [
            each
            for each in self.declarations
            if each.name == name and each.kind not in (ASSIGNED, NAMESPACE)
        ]
        return sorted([*declared, *passed], key=lambda each: each.span.start)

    def context_at(self, offset: int) -> Context:
        """Return the innermost context around an offset."""
        found = self.file
        for context in self.contexts:
            if context.start <= offset < context.end and context.start >= found.start:
                found = context
        return found

    # --- the walk ---------------------------------------------------------------------------

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

    def _visit(self, node: object, context: Context) -> Context:
        """Note what a node declares or uses, and return the context in it."""
        match node:
            case Body():
                return self._blocks.get(id(node), context)
            case PythonCode():
                self._codes.append((node, context))
            case CallNode():
                self._visit_call(node, context)
            case InsertNode():
                span = _name_in(node.span, node.name)
                self._uses.append(Use(node.name, span, context, is_called=True))
            case VariableEntry():
                if isinstance(node.name, str):
                    span = _name_in(node.span, node.name)
                    self._declare(node.name, VARIABLE, span, context, node=node, scope=node.scope)
                self.has_computed |= not isinstance(node.name, str)
            case ForNode():
                for name, span in zip(node.names, node.name_spans, strict=True):
                    self._declare(name, ITERATOR, span, context, node=node)
            case FunctionNode():
                span = _name_in(node.span, node.name)
                self._declare(node.name, FUNCTION_NAME, span, context, node=node, scope=node.scope)
                context = Context(FUNCTION, context, node.span.start, node.end)
                self.contexts.append(context)
                for parameter in node.parameters:
                    kind = BLOCK_NAME if parameter.is_block else PARAMETER
                    span = _name_in(parameter.span, parameter.name)
                    self._declare(parameter.name, kind, span, context, node=parameter)
            case IncludeNode():
                self._visit_include(node, context)
            case ProcessNode():
                from .python_names import names_in_code

                for found in names_in_code(node.code):
                    if found.is_assigned and not context.find(found.name, is_called=False):
                        span = node.code.span(found.start, found.start + len(found.name))
                        self._declare(found.name, ASSIGNED, span, context, node=node)
            case ImportNode():
                names = node.names or [(node.module, node.alias or node.module.split(".")[0])]
                for _, alias in names:
                    self._declare(alias, IMPORTED, _name_in(node.span, alias), context, node=node)
            case Document():
                for entry in node.arguments or ():
                    span = _name_in(entry.span, entry.name)
                    self._declare(entry.name, ARGUMENT, span, context, node=entry)
        return context

    def _visit_call(self, node: CallNode, context: Context) -> None:
        space, _, name = node.name.rpartition(".")
        at = node.span.start + (node.span.written().find(node.name) if node.name else 0)
        if space:
            span = Span(node.span.source, at, at + len(space))
            self._uses.append(Use(space, span, context))
            at += len(space) + 1
        span = Span(node.span.source, at, at + len(name))
        self._uses.append(Use(name, span, context, is_called=True, owner=space or None))
        for argument in node.arguments:
            if argument.name is not None:
                span = _name_in(argument.span, argument.name)
                is_block = argument.name[:1].isupper()
                self._uses.append(Use(argument.name, span, context, is_called=is_block, owner=node))
        for argument in reversed(node.arguments):
            if argument.block is not None:
                own = argument.span
                end = own.end if argument.node is None else max(own.end, argument.node.end)
                block = self._blocks[id(argument.block)] = Context(BLOCK, context, own.start, end)
                block.callee = node.name
                self.contexts.append(block)

    def _visit_include(self, node: IncludeNode, context: Context) -> None:
        path = node.path if isinstance(node.path, str) else node.path_span.written().strip("'\" ")
        is_known = isinstance(node.path, str) or path.startswith(("$(find ", "$(find-pkg-share "))
        self.includes.append(Include(node, path if is_known else None, context))
        if isinstance(node.namespace, str):
            span = node.namespace_span or node.span
            self._declare(node.namespace, NAMESPACE, span, context, node=node)
        for argument in node.arguments:
            if argument.name is not None:
                span = _name_in(argument.span, argument.name)
                self._uses.append(Use(argument.name, span, context, owner=node))


_BY_OTHERS = (IMPORTED, ASSIGNED, NAMESPACE)
_VISITED = CHILDREN.keys() | {PythonCode, ImportNode}


def _name_in(span: Span, name: str) -> Span:
    """Return the place of a name in what is written with it: `name/global`, `**Block`, `'name'`."""
    at = span.written().find(name)
    if at < 0:  # another spelling of the name, as Python normalizes it
        return span
    return Span(span.source, span.start + at, span.start + at + len(name))
