"""Runs a syntax tree: statements in, output elements out.

Knows names, files and values, and nothing of robots: a `part` becomes an element that is lowered
later. Every element made carries the span of its key and the calls and includes that led to it.
"""

from __future__ import annotations

import os

from ..diagnostics import Frame, Reporter, YamaroError, did_you_mean, failure
from ..source import Source, Span
from ..syntax.context import ParseContext
from ..syntax.keys import name_fault
from ..syntax.names import STATEMENTS, is_function_name, is_identifier
from ..syntax.nodes import (
    LOCAL,
    Argument,
    Attribute,
    Body,
    CallNode,
    CommentNode,
    Constant,
    Content,
    DictValue,
    Document,
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
    TextContent,
    TextNode,
    Value,
    VariablesNode,
)
from ..syntax.parser import parse, register
from ..syntax.python import PythonCode
from ..syntax.statements import bad_variable_name, late_call, late_value, name_hint
from ..syntax.template import Template
from ..xmltree import Comment, Element, LiteralList, PartElement, Text, format_value, plain_value
from .expressions import Evaluator, add_trace, function_names
from .loader import LoadError, decode
from .modules import LocalModules, import_names
from .packages import PackageFinder
from .predefined import CONSTANTS, Helpers, gather_pairs
from .scope import MISSING, BlockScope, Home, Namespace, Scope, Shared, function_key

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any

    from ..xmltree import Node
    from .loader import Loader

MAX_DEPTH = 1500
"""How deep calls and includes may nest."""


class Function:
    """A function as defined: what it says, and the context it was defined in."""

    __slots__ = ("closure", "node")

    def __init__(self, node: FunctionNode, closure: Scope) -> None:
        self.node = node
        self.closure = closure


class Block:
    """A block as given to a call: its body, and the context it was written in."""

    __slots__ = ("body", "written")

    def __init__(self, body: Body, written: Scope) -> None:
        self.body = body
        self.written = written


class Interpreter:
    """One conversion: runs the main file and everything it includes."""

    def __init__(
        self,
        *,
        loader: Loader,
        reporter: Reporter,
        on_message: Callable[[str], None],
        packages: PackageFinder | None = None,
    ) -> None:
        """Begin a conversion.

        Args:
            loader: gives the text of files.
            reporter: takes the warnings.
            on_message: takes what `print` and `process` print, without a final line break.
            packages: finds ROS packages.
        """
        self.loader = loader
        self.reporter = reporter
        self.on_message = on_message
        self.packages = packages or PackageFinder()
        self.shared = Shared()
        self.evaluator = Evaluator(self._where_declared)
        self.documents: dict[str, Document] = {}
        self.files: dict[str, None] = {}  # every file read, in order
        self.modules: dict[str, LocalModules] = {}
        self.frame: Frame | None = None
        self.depth = 0
        self.part_depth = 0
        self._run: dict[type, Callable[[Any, Scope, list[Node], Body], None]] = {
            ElementNode: self._run_element,
            TextNode: self._run_text,
            CommentNode: self._run_comment,
            PartNode: self._run_part,
            CallNode: self._run_call,
            InsertNode: self._run_insert,
            DynamicNode: self._run_dynamic,
            IfNode: self._run_if,
            ForNode: self._run_for,
            IncludeNode: self._run_include,
            VariablesNode: self._run_variables,
            FunctionsNode: self._run_functions,
            PrintNode: self._run_print,
            ProcessNode: self._run_process,
        }

    # --- files ---

    def run_main(self, source: Source, *, stem: str, variables: dict[str, object]) -> Element:
        """Run the main file and return the root element.

        Args:
            source: the file.
            stem: the robot's name if the file gives none.
            variables: what is passed in.

        Raises:
            YamaroError: the input has errors.
        """
        try:
            self.files[source.path or source.name] = None
            document = self._parse(source)
            scope = self._begin_file(document, caller=None)
            for name, value in variables.items():
                scope.declare(name, value)
            scope.passed = frozenset(variables)
            return self._run_root(document, scope, stem)
        finally:
            for modules in self.modules.values():
                modules.close()

    def _run_root(self, document: Document, scope: Scope, stem: str) -> Element:
        self._run_sections(document, scope)
        start = Span(document.source, 0, 0)
        if document.root is not None:
            out: list[Node] = []
            self._run_element(document.root, scope, out, None)
            root = out[0] if out else None
            assert isinstance(root, Element), "a root element has a fixed name"
            if root.name == "robot" and "name" not in root.attributes:
                root.attributes = {"name": stem, **root.attributes}
            return root
        root = Element("robot", start, attributes={"name": stem})
        for body in document.model:
            self.run_body(body, scope, root.children)
        if document.robot_name is not None:
            content = document.robot_name
            root.span = content.span
            name = self._text_value(content.value, scope)
            root.attributes["name"] = stem if name is None else name
        return root

    def _begin_file(self, document: Document, *, caller: Scope | None) -> Scope:
        """Return the context for a run of a file."""
        source = document.source
        directory = os.path.dirname(source.path) if source.path else os.getcwd()
        helpers = Helpers(directory, self.loader, self.packages, self._note_file)
        names = {**CONSTANTS, **helpers.names(), "print": self._print}
        names["__import__"] = self._local_modules(directory).import_hook
        home = Home(source, directory, names, self.frame)
        return Scope(home, self.shared, closure=None, caller=caller)

    def _run_sections(self, document: Document, scope: Scope) -> None:
        """Run what stands before the model: imports first, the others as written."""
        modules = self._local_modules(scope.home.directory)
        for node in document.imports:

            def load(node: Any = node) -> dict[str, Any]:
                return import_names(node, modules)

            scope.home.names.update(self.evaluator.guard(lambda _: load(), None, node.span))
        for path in modules.files:
            self.files.setdefault(path)
        nothing: list[Node] = []
        for statement in document.sections:
            self._run[type(statement)](statement, scope, nothing, None)  # type: ignore[arg-type]

    def _local_modules(self, directory: str) -> LocalModules:
        if directory not in self.modules:
            self.modules[directory] = LocalModules(directory)
        return self.modules[directory]

    def _note_file(self, path: str) -> None:
        self.files.setdefault(path)

    def _parse(self, source: Source) -> Document:
        document = parse(source, reporter=self.reporter)
        self.documents[source.path or source.name] = document
        self.evaluator.codes.update(document.codes)
        return document

    def _where_declared(self, name: str) -> list[tuple[str, Span]]:
        return [
            (scope, span)
            for document in self.documents.values()
            for declared, scope, span in document.declarations
            if declared == name
        ]

    # --- bodies ---

    def run_body(self, body: Body, scope: Scope, out: list[Node]) -> None:
        """Run the statements of a body, appending what they make to `out`."""
        run = self._run
        for statement in body.statements:
            run[type(statement)](statement, scope, out, body)

    def _run_element(
        self, node: ElementNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        name = node.name
        if not isinstance(name, str):
            name = self._name(name, scope, node.span, "element")
            if not name:
                return
        attributes: dict[str, object] = {}
        value_spans: dict[str, Span] | None = None
        if node.attributes:
            value_spans = {}
            for attribute in node.attributes:
                self._add_attribute(attribute, scope, attributes, value_spans)
        element = Element(
            name,
            node.span,
            attributes=attributes,
            value_spans=value_spans,
            verbatim=node.verbatim,
            body=body,
        )
        if node.content is not None:
            self._fill(element, node.content, scope)
        out.append(element)

    def _fill(self, element: Element, content: Content, scope: Scope) -> None:
        """Give an element its content."""
        if isinstance(content, Body):
            self.run_body(content, scope, element.children)
        elif isinstance(content, TextContent):
            value = self._text_value(content.value, scope)
            if value is not None and value != "" if isinstance(value, str) else value is not None:
                element.children.append(Text(value, content.span))
        elif isinstance(content, ListContent):
            if not self.part_depth:
                raise failure(
                    "list-as-text",
                    f"a list of plain values cannot be the content of <{element.name}>",
                    content.span,
                    hint="write the values as a text: 0 0 1; or elements as `- name: value`",
                )
            items = self._list(content.value, scope)
            element.children.append(Text(LiteralList(items), content.span))

    def _add_attribute(
        self,
        attribute: Attribute,
        scope: Scope,
        attributes: dict[str, object],
        value_spans: dict[str, Span],
    ) -> None:
        name = attribute.name
        if not isinstance(name, str):
            name = self._name(name, scope, attribute.name_span, "attribute")
            if not name:
                return
        value = attribute.value
        if not isinstance(value, str):
            result = self._text_value(value, scope)
            if result is None:
                return
        else:
            result = value
        if name in attributes:
            raise failure(
                "attribute-twice",
                f"the attribute '{name}' is given twice",
                attribute.name_span,
                hint="keep one of the two",
            )
        attributes[name] = result
        value_spans[name] = attribute.span

    def _name(self, template: Template, scope: Scope, span: Span, what: str) -> str:
        """Return an evaluated name; an empty one drops what it would have named."""
        name = self._key_text(template, scope)
        fault = name_fault(name, what) if name else None
        if fault is not None:
            raise failure(
                "bad-name",
                fault,
                span,
                hint="a name begins with a letter or _ and goes on with letters, digits, - _ .",
            )
        return name

    def _run_text(self, node: TextNode, scope: Scope, out: list[Node], body: Body) -> None:
        value = self._text_value(node.value, scope)
        if value is not None:
            out.append(Text(value, node.span))

    def _run_comment(self, node: CommentNode, scope: Scope, out: list[Node], body: Body) -> None:
        text = format_value(self._text_value(node.value, scope))
        if "--" in text or text.endswith("-"):
            raise failure(
                "bad-comment",
                "an XML comment cannot hold '--' or end with '-'",
                node.span,
                hint="use a single dash, or another sign",
            )
        out.append(Comment(text, node.span))

    def _run_part(self, node: PartNode, scope: Scope, out: list[Node], body: Body) -> None:
        part = PartElement("part", node.span, trace=self.frame, body=body)
        self.part_depth += 1
        try:
            self.run_body(node.body, scope, part.children)
        finally:
            self.part_depth -= 1
        out.append(part)

    def _run_dynamic(self, node: DynamicNode, scope: Scope, out: list[Node], body: Body) -> None:
        """Run a bare key that holds `$(…)`: what its text names decides what it is."""
        text = self._key_text(node.key, scope)
        if not text:
            return
        if is_function_name(text):
            context = ParseContext(self.reporter)
            arguments = late_call(node, text, context)
            self._adopt(context)
            self._call(text, arguments, node.span, scope, out)
            return
        if text in STATEMENTS:
            raise failure(
                "computed-statement",
                f"this key gives '{text}', and a statement cannot be computed",
                node.span,
                hint="write the statement as it is, inside an `if`; "
                f"for an XML element of that name write <$(…)/>: or <{text}>:",
            )
        if node.faults:
            raise YamaroError(node.faults)
        fault = name_fault(text, "element")
        if fault is not None:
            raise failure(
                "bad-name",
                fault,
                node.span,
                hint="attributes are written behind the $(…): $(name)/attribute=value"
                if "/" in text
                else "a name begins with a letter or _ and goes on with letters, digits, - _ .",
            )
        element = Element(text, node.span, trace=self.frame, body=body)
        self._fill(element, node.content, scope)
        out.append(element)

    def _adopt(self, context: ParseContext) -> None:
        """Take up Python that was compiled only now."""
        if not context.codes:
            return
        document = next(iter(self.documents.values()))
        for python in context.codes:
            register(document, python)
        self.evaluator.codes.update(document.codes)

    # --- control flow ---

    def _run_if(self, node: IfNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        for condition, branch in node.branches:
            if condition is None or self._is_true(condition, scope):
                self.run_body(branch, scope, out)
                return

    def _is_true(self, condition: PythonCode | Constant, scope: Scope) -> bool:
        if isinstance(condition, Constant):
            return bool(condition.value)
        value = self.evaluator.evaluate(condition, scope)
        if value is True or value is False:
            return bool(value)
        return bool(self.evaluator.guard(bool, value, condition.span()))

    def _run_for(self, node: ForNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        context = scope.context
        names = node.names
        single = names[0] if len(names) == 1 else None
        for item in self._iterate(node, scope):
            if single is not None:
                context.declare(single, item)
            else:
                for name, value in zip(names, self._unpack(item, node), strict=True):
                    context.declare(name, value)
            self.run_body(node.body, scope, out)

    def _iterate(self, node: ForNode, scope: Scope) -> Iterator[Any]:
        if node.is_range:
            yield from self._range(node, scope)
            return
        iterable = node.iterable
        if isinstance(iterable, PythonCode):
            span = iterable.span()
            values = self.evaluator.evaluate(iterable, scope)
        else:
            assert not isinstance(iterable, list)
            span = iterable.node.span() if isinstance(iterable, Constant) else _span(iterable)
            values = self.value(iterable, scope)
        if isinstance(values, dict):
            values = list(values.items() if len(node.names) > 1 else values)
        if not hasattr(type(values), "__iter__") and not hasattr(type(values), "__getitem__"):
            raise failure(
                "not-iterable",
                f"`in` needs a list, and this is {_a_kind_of(values)}",
                span,
                hint="write range: for a number of turns"
                if isinstance(values, (int, float))
                else "write in: [left, right], or the name of a list",
            )
        iterator = self.evaluator.guard(iter, values, span)
        while True:
            item = self.evaluator.guard(_next, iterator, span)
            if item is MISSING:
                return
            yield item

    def _range(self, node: ForNode, scope: Scope) -> range:
        iterable = node.iterable
        spans: list[Span]
        if isinstance(iterable, PythonCode):
            result = self.evaluator.evaluate(iterable, scope)
            values = list(result) if isinstance(result, (tuple, list)) else [result]
            spans = [iterable.span()] * len(values)
        else:
            assert isinstance(iterable, list)
            values, spans = [], []
            for item in iterable:
                is_code = isinstance(item, PythonCode)
                values.append(
                    self.evaluator.evaluate(item, scope) if is_code else item.value  # type: ignore[union-attr, arg-type]
                )
                spans.append(item.span() if is_code else item.node.span())  # type: ignore[union-attr]
        if not 1 <= len(values) <= 3:
            raise failure(
                "bad-range",
                f"`range` takes one to three numbers, and these are {len(values)}",
                spans[0] if spans else node.span,
                hint="write range: 6, or range: 0, 6, or range: 0, 6, 2",
            )
        for value, span in zip(values, spans, strict=True):
            if isinstance(value, bool) or not hasattr(type(value), "__index__"):
                raise failure(
                    "bad-range",
                    f"`range` takes whole numbers, and this is {_a_kind_of(value)}",
                    span,
                    hint=f"write int(…) around it to cut {value} off to a whole number"
                    if isinstance(value, float)
                    else "write range: 0, 6, or in: for the items of a list",
                )
        if len(values) == 3 and values[2] == 0:
            raise failure(
                "bad-range",
                "the step of a `range` cannot be 0",
                spans[2],
                hint="write range: start, stop, step with a step such as 1 or -1",
            )
        return range(*values)

    def _unpack(self, item: Any, node: ForNode) -> list[Any]:
        wanted = len(node.names)
        if isinstance(item, str) or not hasattr(type(item), "__iter__"):
            values: list[Any] | None = None
        else:
            values = list(self.evaluator.guard(list, item, node.span))
        if values is None or len(values) != wanted:
            found = _a_kind_of(item) if values is None else f"{len(values)} values"
            raise failure(
                "bad-iterator",
                f"the iterator names {wanted} variables ({', '.join(node.names)}), "
                f"and an item is {found}",
                node.span,
                hint="give each item as a list: in: [[a, 1.0], [b, 2.0]]",
            )
        return values

    # --- declarations ---

    def _run_variables(
        self, node: VariablesNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        for entry in node.entries:
            name = entry.name
            if not isinstance(name, str):
                name = self._key_text(name, scope)
                if not name:
                    continue
                if not is_identifier(name):
                    raise failure(
                        "bad-variable-name",
                        bad_variable_name(name),
                        entry.span,
                        hint=name_hint(name),
                    )
            if node.is_root and scope.is_passed_in(name):
                if entry.scope == LOCAL and name in self.shared.bridges:
                    continue
                value = scope.find(name)
            elif len(entry.values) == 1:
                value = self.value(entry.values[0], scope)
            else:
                value = [self.value(item, scope) for item in entry.values]
            scope.declare(name, value, entry.scope)

    def _run_functions(
        self, node: FunctionsNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        for function in node.functions:
            key = function_key(function.name)
            earlier = scope.find(key)
            if (
                isinstance(earlier, Function)
                and earlier.closure is scope
                and earlier.node is not function
            ):
                raise failure(
                    "defined-twice",
                    f"the function '{function.name}' is defined twice",
                    function.span,
                    hint="give one of them another name",
                    notes=[f"first defined at {earlier.node.span.place()}"],
                )
            scope.declare(key, Function(function, scope), function.scope)

    def _run_print(self, node: PrintNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        value = node.value
        if isinstance(value, str):
            text = value
        elif isinstance(value, Template):
            text = "".join(
                part
                if isinstance(part, str)
                else self.evaluator.guard(
                    print_text, self.evaluator.evaluate(part, scope), part.span()
                )
                for part in value.parts
            )
        else:
            text = self.evaluator.guard(print_text, self.value(value, scope), node.span)
        self.on_message(text)

    def _run_process(
        self, node: ProcessNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        self.evaluator.execute(node.code, scope)

    def _print(
        self,
        *values: object,
        sep: str | None = " ",
        end: str | None = "\n",
        file: Any = None,
        flush: bool = False,
    ) -> None:
        """Stand in for Python's `print` in expressions and process blocks."""
        if file is not None:
            print(*values, sep=sep, end=end, file=file, flush=flush)
            return
        text = (" " if sep is None else sep).join(str(value) for value in values)
        text += "\n" if end is None else end
        self.on_message(text.removesuffix("\n"))

    # --- calls ---

    def _run_call(self, node: CallNode, scope: Scope, out: list[Node], body: Body) -> None:
        self._call(node.name, node.arguments, node.span, scope, out)

    def _run_insert(self, node: InsertNode, scope: Scope, out: list[Node], body: Body) -> None:
        block = scope.find(function_key(node.name))
        if isinstance(block, Block):
            self.run_body(block.body, BlockScope(scope.context, block.written), out)
        elif node.default is not None:
            self.run_body(node.default, scope, out)

    def _call(
        self, name: str, arguments: list[Argument], span: Span, scope: Scope, out: list[Node]
    ) -> None:
        function = self._find_function(name, span, scope)
        if isinstance(function, Block):
            self.run_body(function.body, BlockScope(scope.context, function.written), out)
            return
        if function is None:  # an optional block that was not given
            return
        closure = function.closure
        context = scope.context
        callee = Scope(closure.home, self.shared, closure=closure, caller=context)
        given = self._match(function.node, arguments, span, scope)
        frame = Frame("called", name, span, parent=self.frame, home=closure.home.frame)
        self._enter(frame, span)
        try:
            self._bind(function.node, given, callee)
            self.run_body(function.node.body, callee, out)
            for key, value in callee.exported():
                self._receive(context, key, value, span)
        except YamaroError as error:
            add_trace(error, frame)
            raise
        except RecursionError:
            raise self._too_deep(span) from None
        finally:
            self._leave(frame)

    def _enter(self, frame: Frame, span: Span) -> None:
        if self.depth >= MAX_DEPTH:
            raise self._too_deep(span)
        self.depth += 1
        self.frame = self.evaluator.frame = frame

    def _leave(self, frame: Frame) -> None:
        if self.frame is frame:
            self.depth -= 1
            self.frame = self.evaluator.frame = frame.parent

    def _too_deep(self, span: Span) -> YamaroError:
        return failure(
            "too-deep",
            f"calls and includes are nested {self.depth:,} deep here, which is taken as endless",
            span,
            hint="a function or file that uses itself needs a condition under which it stops",
        )

    def _find_function(self, name: str, span: Span, scope: Scope) -> Function | Block | None:
        namespace, _, last = name.rpartition(".")
        key = function_key(last)
        if namespace:
            found = self._namespace(namespace, scope)
            value = MISSING if found is None else found._get(key)
        else:
            value = scope.find(key)
        if value is not MISSING:
            assert value is None or isinstance(value, (Function, Block))
            return value
        names = function_names(scope)
        notes = [
            f"a function '{last}' is defined at {place.place()} with scope {kind}"
            for kind, place in self._where_declared(last)[:3]
        ]
        hint = did_you_mean(name, names)
        raise failure(
            "undefined-function",
            f"function '{name}' is not defined",
            span,
            hint=hint or f"for an XML element of that name write <{name}>:",
            notes=notes,
        )

    def _namespace(self, path: str, scope: Scope) -> Namespace | None:
        first, *rest = path.split(".")
        found = scope.find(first)
        for part in rest:
            found = found._get(part) if isinstance(found, Namespace) else None
        return found if isinstance(found, Namespace) else None

    def _match(
        self, node: FunctionNode, arguments: list[Argument], span: Span, scope: Scope
    ) -> dict[str, Any]:
        """Return the arguments' values by parameter, evaluated where the call stands."""
        given: dict[str, Any] = {}
        spans: dict[str, Span] = {}
        parameters = {parameter.name: parameter for parameter in node.parameters}
        positional = [parameter for parameter in node.parameters if not parameter.is_block]
        for index, argument in enumerate(arguments):
            name = argument.name
            if name is None:
                if index >= len(positional):
                    raise self._bad_call(
                        "unknown-argument",
                        f"'{node.name}' takes {_count(len(positional), 'argument')}, "
                        f"and this is number {index + 1}",
                        argument.span,
                        node,
                    )
                name = positional[index].name
            parameter = parameters.get(name)
            if parameter is None:
                raise self._bad_call(
                    "unknown-argument",
                    f"'{node.name}' has no parameter '{name}'",
                    argument.span,
                    node,
                    hint=did_you_mean(name, parameters),
                )
            if name in given:
                raise self._bad_call(
                    "given-twice",
                    f"the argument '{name}' is given twice",
                    argument.span,
                    node,
                    hint=f"it is given first at {spans[name].place()}",
                )
            spans[name] = argument.span
            if parameter.is_block:
                given[name] = self._block(argument, node, scope)
            else:
                context = ParseContext(self.reporter)
                value = argument.value or late_value(argument, context)
                self._adopt(context)
                given[name] = self.value(value, scope)
        for parameter in positional:
            if parameter.name not in given and parameter.default is None:
                raise self._bad_call(
                    "missing-argument",
                    f"'{node.name}' needs the argument '{parameter.name}'",
                    span,
                    node,
                )
        return given

    def _block(self, argument: Argument, node: FunctionNode, scope: Scope) -> Block:
        if argument.block is None:
            raise self._bad_call(
                "not-a-body",
                f"the block '{argument.name}' takes a body, and this is a value",
                argument.span,
                node,
                hint="write the statements of the block below its name, indented",
            )
        return Block(argument.block, scope)

    def _bind(self, node: FunctionNode, given: dict[str, Any], callee: Scope) -> None:
        """Give the parameters their values; defaults may use the parameters before them."""
        for parameter in node.parameters:
            name = parameter.name
            if parameter.is_block:
                callee.declare(function_key(name), given.get(name))
            elif name in given:
                callee.declare(name, given[name])
            elif parameter.default is not None:
                callee.declare(name, self.value(parameter.default, callee))

    def _bad_call(
        self, code: str, message: str, span: Span, node: FunctionNode, *, hint: str | None = None
    ) -> YamaroError:
        note = f"it is defined as {node.signature()} at {node.span.place()}"
        return failure(code, message, span, hint=hint, notes=[note])

    def _receive(self, context: Scope, key: str, value: Any, span: Span) -> None:
        """Take a `parent` name into the context that called or included."""
        self._warn_of_replacement(context.find(key), value, key, span)
        context.declare(key, value)

    def _warn_of_replacement(self, earlier: Any, value: Any, key: str, span: Span) -> None:
        if (
            isinstance(earlier, Function)
            and isinstance(value, Function)
            and earlier.node.span.key() != value.node.span.key()
        ):
            self.reporter.warn(
                "function-replaced",
                f"the function '{key[:-2]}' that arrives here replaces another one",
                span,
                hint="rename one of them, or include the file with a namespace",
                notes=[
                    f"the earlier one is defined at {earlier.node.span.place()}",
                    f"the new one is defined at {value.node.span.place()}",
                ],
                trace=self.frame,
            )

    # --- includes ---

    def _run_include(self, node: IncludeNode, scope: Scope, out: list[Node], body: Body) -> None:
        path = self._include_path(node, scope)
        namespace = self._include_namespace(node, scope)
        passed = {}
        for argument in node.arguments:
            assert argument.name is not None and argument.value is not None
            passed[argument.name] = self.value(argument.value, scope)
        source = self._load(path, node, scope)
        context = scope.context
        frame = Frame("included", source.name, node.span, parent=self.frame)
        self._enter(frame, node.path_span)
        try:
            document = self.documents.get(source.path) or self._parse(source)
            before = (set(self.shared.globals), set(self.shared.bridges))
            inner = self._begin_file(document, caller=context)
            for name, value in passed.items():
                inner.declare(name, value)
            inner.passed = frozenset(passed)
            self._run_sections(document, inner)
            self._run_included_model(document, inner, out)
        except YamaroError as error:
            add_trace(error, frame)
            raise
        except RecursionError:
            raise self._too_deep(node.path_span) from None
        finally:
            self._leave(frame)
        self._hand_back(inner, context, namespace, before, node.span)

    def _run_included_model(self, document: Document, inner: Scope, out: list[Node]) -> None:
        for model in document.model:
            self.run_body(model, inner, out)
        if document.root is not None:
            made: list[Node] = []
            self._run_element(document.root, inner, made, None)
            for element in made:
                if isinstance(element, Element):
                    out.extend(element.children)

    def _include_path(self, node: IncludeNode, scope: Scope) -> str:
        text = format_value(self._text_value(node.path, scope)).strip()
        if not text or "\x00" in text:
            raise failure(
                "missing-file",
                "the path of this include is empty"
                if not text
                else "the path of this include holds a NUL character",
                node.path_span,
                hint="write include: other.yaml",
            )
        return text

    def _include_namespace(self, node: IncludeNode, scope: Scope) -> str | None:
        if node.namespace is None or isinstance(node.namespace, str):
            return node.namespace
        name = self._key_text(node.namespace, scope)
        if name and not is_identifier(name):
            raise failure(
                "bad-namespace",
                f"'{name}' cannot name a namespace",
                node.namespace.span(),
                hint=name_hint(name),
            )
        return name or None

    def _load(self, path: str, node: IncludeNode, scope: Scope) -> Source:
        """Return the source of an included file, read once a conversion."""
        home = scope.home
        resolved = self.packages.resolve_uri(path, home.directory)
        if resolved is None:
            package = path.partition("://")[2].partition("/")[0]
            places = self.packages.looked_at(package, home.directory)
            raise failure(
                "unknown-package",
                f"the package '{package}' is not found",
                node.path_span,
                hint="source its workspace, or set ROS_PACKAGE_PATH",
                notes=[f"looked in {place}" for place in places[:6]],
            )
        absolute = os.path.normpath(resolved)
        known = self.documents.get(absolute)
        if known is not None:
            return known.source
        try:
            data = self.loader.read(absolute)
        except LoadError as error:
            near = did_you_mean(os.path.basename(absolute), self.loader.neighbours(absolute))
            raise failure(
                "missing-file",
                f"the file '{path}' cannot be included: {error}",
                node.path_span,
                hint=near,
                notes=[f"looked for {absolute}"],
            ) from None
        self.files.setdefault(absolute)
        return decode(data, name=_shown_name(path, absolute, home.source), path=absolute)

    def _hand_back(
        self,
        inner: Scope,
        context: Scope,
        namespace: str | None,
        before: tuple[set[str], set[str]],
        span: Span,
    ) -> None:
        """Bring the names of an included file to the one that included it."""
        if namespace is None:
            for key, value in inner.exported():
                self._receive(context, key, value, span)
            return
        space = context.find(namespace) if namespace in context else None
        if not isinstance(space, Namespace):
            space = Namespace(namespace, self.shared)
            context.declare(namespace, space)
        for key, value in inner.exported():
            self._warn_of_replacement(space._get(key), value, key, span)
            space._add(key, value)
        for key in (*self.shared.globals, *self.shared.bridges):
            if key not in before[0] and key not in before[1]:
                space._add(key, MISSING)

    # --- values ---

    def value(self, value: Value, scope: Scope) -> Any:
        """Return the Python object that a value stands for."""
        if isinstance(value, Constant):
            return value.value
        if isinstance(value, Template):
            return self._text_value(value, scope)
        if isinstance(value, ListValue):
            return self._list(value, scope)
        return self._dict(value, scope)

    def _list(self, value: ListValue, scope: Scope) -> list[Any]:
        return [self.value(item, scope) for item in value.items]

    def _dict(self, value: DictValue, scope: Scope) -> dict[Any, Any]:
        pairs = []
        for key_value, item in value.pairs:
            key = self.value(key_value, scope)
            if isinstance(key_value, Template) and (key is None or key == ""):
                continue
            self.evaluator.guard(hash, key, _span(key_value))
            pairs.append((key, self.value(item, scope)))
        return gather_pairs(pairs)

    def _text_value(self, value: str | Template, scope: Scope) -> Any:
        """Return a text as written, the typed value of a single `$(…)`, or the parts joined."""
        if isinstance(value, str):
            return value
        parts = value.parts
        first = parts[0]
        if len(parts) == 1 and isinstance(first, PythonCode):
            return self.evaluator.evaluate(first, scope)
        return self._joined(value, scope)

    def _joined(self, template: Template, scope: Scope) -> str:
        pieces = []
        for part in template.parts:
            if isinstance(part, str):
                pieces.append(part)
            else:
                value = self.evaluator.evaluate(part, scope)
                if type(value) is str:
                    pieces.append(value)
                else:
                    pieces.append(self.evaluator.guard(format_value, value, part.span()))
        return "".join(pieces)

    def _key_text(self, template: Template, scope: Scope) -> str:
        return self._joined(template, scope)


def print_text(value: Any) -> str:
    """Return the text of a value in `print`: floats as in XML, all else as Python shows it."""
    plain = plain_value(value)
    return format_value(plain) if type(plain) is float else str(plain)


def _next(iterator: Iterator[Any]) -> Any:
    return next(iterator, MISSING)


def _span(value: Value) -> Span:
    if isinstance(value, Constant):
        return value.node.span()
    return value.span() if isinstance(value, Template) else value.span


def _a_kind_of(value: Any) -> str:
    """Return what a value is, in words."""
    if value is None:
        return "empty (null)"
    if isinstance(value, bool):
        return f"the boolean {'true' if value else 'false'}"
    if isinstance(value, (int, float)):
        return f"the number {format_value(value)}"
    if isinstance(value, str):
        return f"the text '{value[:40]}'"
    return f"a {type(value).__name__}"


def _count(number: int, noun: str) -> str:
    return f"{'no' if number == 0 else number} {noun}{'' if number == 1 else 's'}"


def _shown_name(path: str, absolute: str, includer: Source) -> str:
    """Return the name to show for an included file: relative as the includer's is."""
    if "://" in path or os.path.isabs(path) or path.startswith("~"):
        return absolute
    return os.path.normpath(os.path.join(os.path.dirname(includer.name), path))


__all__ = ["Block", "Function", "Interpreter"]
