"""The syntax tree of a file: what it says, before anything is evaluated.

Every node has the span of the key that made it. Texts are plain strings where nothing has to be
evaluated, and templates where something has.
"""

from __future__ import annotations

from ..diagnostics import YamaroError
from ..source import Source, Span
from ..xml.tree import Comment, Element, Text
from ..yaml.nodes import ScalarNode, YamlNode
from .python import PythonCode, Template

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from typing import Any

    from ..diagnostics import Diagnostic
    from ..yaml.comments import Comment as YamlComment
    from ..yaml.nodes import MappingNode
    from .argument_section import ArgumentEntry
    from .forms import EvaluatedForm
    from .symbol_table import SymbolTable


# --- values -----------------------------------------------------------------------------------


class Constant:
    """A value known from the text: a typed scalar."""

    __slots__ = ("node", "value")

    def __init__(self, value: object, node: ScalarNode) -> None:
        self.value = value
        self.node = node


class ListValue:
    """A YAML list as a value."""

    __slots__ = ("items", "span")

    def __init__(self, items: list[Value], span: Span) -> None:
        self.items = items
        self.span = span


class DictValue:
    """A YAML mapping as a value; a repeated key means the list of its values."""

    __slots__ = ("pairs", "span")

    def __init__(self, pairs: list[tuple[Value, Value]], span: Span) -> None:
        self.pairs = pairs
        self.span = span


Value = Constant | Template | ListValue | DictValue


# --- statements -------------------------------------------------------------------------------


class Body:
    """A sequence of statements; its identity shows which keys were written in one mapping.

    Attributes:
        is_static: whether all statements are elements, texts and comments as they will be written.
    """

    __slots__ = ("is_static", "statements")

    def __init__(self) -> None:
        """Start without statements."""
        self.statements: list[Statement] = []
        self.is_static = True

    def add(self, statement: Statement) -> None:
        """Add a statement at the end."""
        self.statements.append(statement)
        if not isinstance(statement, (Element, Text, Comment)):
            self.is_static = False


class TextContent:
    """A scalar as an element's content: its spelling, or a template."""

    __slots__ = ("span", "value")

    def __init__(self, value: str | Template, span: Span) -> None:
        self.value = value
        self.span = span


class ListContent:
    """A list of plain values as an element's content: numbers, where a `part` wants them."""

    __slots__ = ("span", "value")

    def __init__(self, value: ListValue, span: Span) -> None:
        self.value = value
        self.span = span


Content = Body | TextContent | ListContent | None


class Attribute:
    """An attribute in a key."""

    __slots__ = ("_key", "_name_place", "_value_place", "name", "value")

    def __init__(
        self,
        name: str | Template,
        value: str | Template,
        key: ScalarNode,
        *,
        name_place: tuple[int, int],
        value_place: tuple[int, int],
    ) -> None:
        """Hold an attribute; the places are stretches of the key's text."""
        self.name = name
        self.value = value
        self._key = key
        self._name_place = name_place
        self._value_place = value_place

    @property
    def span(self) -> Span:
        """Return the place of the value; of the name and `=` if it is empty."""
        return self._key.span(*self._value_place)

    @property
    def name_span(self) -> Span:
        """Return the place of the name."""
        return self._key.span(*self._name_place)


class ElementNode:
    """`name/attribute=value, …: content`: an XML element.

    Attributes:
        form: its shape, if that is fixed and the element is in a body; else None.
    """

    __slots__ = ("attributes", "content", "form", "name", "span", "verbatim")

    def __init__(
        self,
        name: str | Template,
        attributes: list[Attribute],
        content: Content,
        *,
        span: Span,
        verbatim: bool,
    ) -> None:
        self.name = name
        self.attributes = attributes
        self.content = content
        self.span = span
        self.verbatim = verbatim
        self.form: EvaluatedForm | None = None


class RobotWordItem:
    """What stands once under `attach`, `mirror` or `loop`, or under a section such as `states`.

    Attributes:
        content: its own keys as elements, or its text.
        body: the statements under `body`, if there are any.
        include: the file that is attached, with what is passed to it.
        span: the place of what stands there.
    """

    __slots__ = ("body", "content", "include", "span")

    def __init__(self, span: Span) -> None:
        self.span = span
        self.content: Content = None
        self.body: Body | None = None
        self.include: IncludeNode | None = None


class RobotWordNode:
    """`attach`, `mirror` or `loop`, a section of a robot such as `states`, or a raw block.

    Attributes:
        key: the word.
        node: what stands under it, to be read as an element's content where no part may stand.
        is_section: whether it is a section of the file.
        items: one, or those of a list.
        faults: what is wrong with it, reported if it is run as the word.
    """

    __slots__ = ("faults", "is_section", "items", "key", "node", "span")

    def __init__(self, key: ScalarNode, node: YamlNode, *, is_section: bool) -> None:
        self.key = key
        self.node = node
        self.span = key.span()
        self.is_section = is_section
        self.items: list[RobotWordItem] = []
        self.faults: Sequence[Diagnostic] = ()


class TextNode:
    """`<#text>:`: text between child elements."""

    __slots__ = ("span", "value")

    def __init__(self, value: str | Template, span: Span) -> None:
        self.value = value
        self.span = span


class CommentNode:
    """`<#comment>:`: an XML comment."""

    __slots__ = ("span", "value")

    def __init__(self, value: str | Template, span: Span) -> None:
        self.value = value
        self.span = span


class PartNode:
    """`part:`: a joint and a link, lowered after evaluation; `form` as in an ElementNode."""

    __slots__ = ("body", "form", "span")

    def __init__(self, body: Body, span: Span) -> None:
        self.body = body
        self.span = span
        self.form: EvaluatedForm | None = None


class Argument:
    """One argument of a call or an include; of a call with a block, the block's body.

    Whether a capitalised key means a block or a value is known only when the function is, so such
    an argument keeps its YAML node, and is read as the other kind when that turns out to be meant.
    """

    __slots__ = ("block", "name", "node", "span", "value")

    def __init__(self, name: str | None, node: YamlNode | None, span: Span) -> None:
        self.name = name
        self.node = node
        self.span = span
        self.value: Value | None = None
        self.block: Body | None = None


class CallNode:
    """`Name:` or `ns.Name:`: a function call."""

    __slots__ = ("arguments", "name", "span")

    def __init__(self, name: str, arguments: list[Argument], span: Span) -> None:
        """Hold a call; positional arguments, which have no name, come first."""
        self.name = name
        self.arguments = arguments
        self.span = span


class InsertNode:
    """`Name:` inside a function that has a block of that name: the block, or else `default`."""

    __slots__ = ("default", "name", "span")

    def __init__(self, name: str, default: Body | None, span: Span) -> None:
        self.name = name
        self.default = default
        self.span = span


class DynamicNode:
    """A bare key with `$(…)` in it: an element or a call, whatever its value turns out to be."""

    __slots__ = ("content", "faults", "key", "node", "span")

    def __init__(
        self,
        key: Template,
        node: YamlNode,
        content: Content,
        faults: Sequence[Diagnostic],
        span: Span,
    ) -> None:
        """Hold both readings.

        Args:
            key: the key.
            node: what stands under it, to be read as arguments if it is a call.
            content: what stands under it, read as an element's content.
            faults: what is wrong with that reading, reported if it is an element.
            span: the place of the key.
        """
        self.key = key
        self.node = node
        self.content = content
        self.faults = faults
        self.span = span


class IfNode:
    """`if` with its `elif`s and `else`; the last branch has no condition if there is an `else`."""

    __slots__ = ("branches", "span")

    def __init__(self, branches: list[tuple[PythonCode | Constant | None, Body]], span: Span):
        self.branches = branches
        self.span = span


class ForNode:
    """`for`: over a range (a list of expressions), a value, or an expression."""

    __slots__ = ("body", "is_range", "iterable", "name_spans", "names", "span")

    def __init__(
        self,
        names: list[str],
        iterable: PythonCode | Value | list[PythonCode | Constant],
        body: Body,
        *,
        name_spans: list[Span],
        is_range: bool,
        span: Span,
    ) -> None:
        self.names = names
        self.name_spans = name_spans
        self.iterable = iterable
        self.body = body
        self.is_range = is_range
        self.span = span


class IncludeNode:
    """`include:`: another file's content, and the names it hands back.

    Attributes:
        namespace_span: where the namespace is written, if there is one.
        own_prefix: where the `prefix` of an `attach` is written, which is not passed; else None.
        overlays: the overlays that change what the file makes: each a path, or what is written.
        overlay_span: where these are written, if there are any.
    """

    __slots__ = (
        "arguments", "namespace", "namespace_span", "overlay_span", "overlays", "own_prefix",
        "path", "path_span", "span",
    )  # fmt: skip

    def __init__(
        self,
        path: str | Template,
        namespace: str | Template | None,
        arguments: list[Argument],
        *,
        namespace_span: Span | None = None,
        path_span: Span,
        span: Span,
    ) -> None:
        self.path = path
        self.path_span = path_span
        self.namespace = namespace
        self.namespace_span = namespace_span
        self.arguments = arguments
        self.span = span
        self.own_prefix: Span | None = None
        self.overlays: list[TextContent | MappingNode] = []
        self.overlay_span: Span | None = None


LOCAL, GLOBAL, PARENT, CHILD, BRIDGE = "local", "global", "parent", "child", "bridge"
SCOPES = (LOCAL, GLOBAL, PARENT, CHILD, BRIDGE)


class VariableEntry:
    """One name of a `variables:` mapping, with all the values written for it."""

    __slots__ = ("name", "scope", "span", "values")

    def __init__(self, name: str | Template, scope: str, values: list[Value], span: Span) -> None:
        self.name = name
        self.scope = scope
        self.values = values
        self.span = span


class VariablesNode:
    """`variables:`; at the root of a file an entry is a default for what is passed in."""

    __slots__ = ("entries", "is_root", "span")

    def __init__(self, entries: list[VariableEntry], *, is_root: bool, span: Span) -> None:
        self.entries = entries
        self.is_root = is_root
        self.span = span


class Parameter:
    """One parameter of a function; a block if `is_block`."""

    __slots__ = ("default", "is_block", "name", "span", "text")

    def __init__(
        self, name: str, default: Value | None, *, is_block: bool, span: Span, text: str
    ) -> None:
        self.name = name
        self.default = default
        self.is_block = is_block
        self.span = span
        self.text = text


class FunctionNode:
    """One function of a `functions:` mapping.

    Attributes:
        span: its key.
        end: the offset at which its body ends.
    """

    __slots__ = ("body", "end", "name", "parameters", "scope", "span")

    def __init__(
        self,
        name: str,
        scope: str,
        parameters: list[Parameter],
        body: Body,
        *,
        span: Span,
        end: int,
    ) -> None:
        self.name = name
        self.scope = scope
        self.parameters = parameters
        self.body = body
        self.span = span
        self.end = end

    def signature(self) -> str:
        """Return name and parameters as they are written."""
        if not self.parameters:
            return f"{self.name}, without parameters,"
        return f"{self.name}: {', '.join(parameter.text for parameter in self.parameters)}"


class FunctionsNode:
    """`functions:`."""

    __slots__ = ("functions", "span")

    def __init__(self, functions: list[FunctionNode], span: Span) -> None:
        self.functions = functions
        self.span = span


class PrintNode:
    """`print:`."""

    __slots__ = ("span", "value")

    def __init__(self, value: str | Template | Value, span: Span) -> None:
        self.value = value
        self.span = span


class ProcessNode:
    """`process:`."""

    __slots__ = ("code", "span")

    def __init__(self, code: PythonCode, span: Span) -> None:
        self.code = code
        self.span = span


Statement = (
    ElementNode
    | TextNode
    | CommentNode
    | PartNode
    | RobotWordNode
    | CallNode
    | InsertNode
    | DynamicNode
    | IfNode
    | ForNode
    | IncludeNode
    | VariablesNode
    | FunctionsNode
    | PrintNode
    | ProcessNode
    | Element
    | Text
    | Comment
)
"""What a body holds; elements, texts and comments in which nothing is evaluated are in it as they
will be written."""


# --- files ------------------------------------------------------------------------------------


class ImportNode:
    """One module to import, or names of one."""

    __slots__ = ("alias", "hint", "module", "names", "span")

    def __init__(
        self, module: str, alias: str | None, names: list[tuple[str, str]] | None, span: Span
    ) -> None:
        """Describe an import.

        Args:
            module: its dotted name.
            alias: the name in `import module as alias`.
            names: for `from module import …`, each name and what it is called here.
            span: the place.
        """
        self.module = module
        self.alias = alias
        self.names = names
        self.span = span
        self.hint: str | None = None  # what was probably meant, if there is no such module


class Document:
    """A parsed file."""

    __slots__ = (
        "_symbols",
        "argument_spans",
        "arguments",
        "bare_keys",
        "codes",
        "functions",
        "imports",
        "is_lone_section",
        "model",
        "model_span",
        "names_read",
        "robot_name",
        "root",
        "sections",
        "source",
    )

    def __init__(self, source: Source) -> None:
        """Start an empty document.

        Attributes:
            arguments: what may be passed to the file, or None if it does not say.
            argument_spans: where each of them is declared.
            bare_keys: the names of elements that are written without attributes.
            functions: those that are defined in it, also inside others.
            imports: the modules, in order.
            sections: the other sections but the model, in order.
            model: the bodies of the `model:` sections, in order.
            model_span: where `model:` stands first, or None without one.
            root: the root element written in place of `model`, if there is one.
            is_lone_section: whether the root element is a section of a robot in an included file.
            robot_name: what follows `robot:`.
            codes: Python code by its file name, to find the place of an error in a function.
            names_read: every name that some expression reads.
        """
        self.source = source
        self.arguments: list[ArgumentEntry] | None = None
        self.argument_spans: dict[str, Span] = {}
        self.imports: list[ImportNode] = []
        self.sections: list[Statement] = []
        self.model: list[Body] = []
        self.model_span: Span | None = None
        self.root: ElementNode | None = None
        self.is_lone_section = False
        self.robot_name: TextContent | None = None
        self.codes: dict[str, PythonCode] = {}
        self._symbols: SymbolTable | None = None
        self.functions: list[FunctionNode] = []
        self.bare_keys: set[str] = set()
        self.names_read: set[str] = set()

    @property
    def symbols(self) -> SymbolTable:
        """Return the names that the file declares and uses, which are gathered when asked for."""
        if self._symbols is None:
            from .symbol_table import SymbolTable

            self._symbols = SymbolTable(self)
        return self._symbols


class Parsed:
    """A file as far as it could be parsed, and all that is to be said of it unrun.

    Attributes:
        document: the syntax tree, without what is faulty.
        errors: what is not YAML comes first, since it hides other things; then in order of place.
        warnings: in order of place.
        hidden: the stretches that were not read because of errors; what is missing may be there.
    """

    __slots__ = ("_comments", "_text", "document", "errors", "hidden", "warnings")

    def __init__(
        self,
        document: Document,
        *,
        errors: Sequence[Diagnostic],
        warnings: Sequence[Diagnostic],
        hidden: Sequence[Span],
        text: str,
    ) -> None:
        """Hold the results; `text` is the file's, with blanks in place of what is hidden."""
        self.document = document
        self.errors = errors
        self.warnings = warnings
        self.hidden = hidden
        self._text = text
        self._comments: list[YamlComment] | None = None

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """Return errors and warnings in order of place."""
        return sorted([*self.errors, *self.warnings], key=lambda found: found.span.start)

    @property
    def comments(self) -> list[YamlComment]:
        """Return the comments in order; they are gathered when they are first asked for."""
        if self._comments is None:
            from ..yaml.comments import find_comments

            self._comments = find_comments(self.document.source, self._text)
        return self._comments

    def require(self) -> Document:
        """Return the document.

        Raises:
            YamaroError: the file has errors.
        """
        if self.errors:
            raise YamaroError(self.errors)
        return self.document


# --- the walk through a syntax tree -----------------------------------------------------------


CHILDREN: dict[type, Callable[[Any], Iterable[object]]] = {
    Document: lambda node: (
        *node.imports,
        *(each.default for each in node.arguments or ()),
        node.robot_name,
        *node.sections,
        *node.model,
        node.root,
    ),
    Template: lambda node: node.parts,
    list: lambda node: node,
    ListValue: lambda node: node.items,
    DictValue: lambda node: [each for pair in node.pairs for each in pair],
    Body: lambda node: node.statements,
    TextContent: lambda node: (node.value,),
    ListContent: lambda node: (node.value,),
    ElementNode: lambda node: (node.name, *node.attributes, node.content),
    Attribute: lambda node: (node.name, node.value),
    TextNode: lambda node: (node.value,),
    CommentNode: lambda node: (node.value,),
    PrintNode: lambda node: (node.value,),
    PartNode: lambda node: (node.body,),
    RobotWordNode: lambda node: node.items,
    RobotWordItem: lambda node: (node.content, node.body, node.include),
    CallNode: lambda node: (
        *(each.value for each in node.arguments),
        *(each.block for each in node.arguments),
    ),
    InsertNode: lambda node: (node.default,),
    DynamicNode: lambda node: (node.key, node.content),
    IfNode: lambda node: [each for branch in node.branches for each in branch],
    ForNode: lambda node: (node.iterable, node.body),
    IncludeNode: lambda node: (
        node.path,
        node.namespace,
        *(each.value for each in node.arguments),
    ),
    VariablesNode: lambda node: node.entries,
    VariableEntry: lambda node: (node.name, *node.values),
    FunctionsNode: lambda node: node.functions,
    FunctionNode: lambda node: (*(each.default for each in node.parameters), node.body),
    ProcessNode: lambda node: (node.code,),
}
"""What is directly in a node of each type, in order; None for what it does not have."""


def children(node: object) -> Iterable[object]:
    """Return what is directly in a node of the syntax tree, in order."""
    found = CHILDREN.get(type(node))
    return () if found is None else found(node)


def walk(node: object) -> Iterator[object]:
    """Yield a node and all that is in it, in order; of what is static, the elements at its top."""
    pending = [node]
    while pending:
        each = pending.pop()
        yield each
        pending += reversed([*children(each)])
