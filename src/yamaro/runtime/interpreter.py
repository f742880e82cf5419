"""Runs a syntax tree: statements in, output elements out.

Knows names, files and values, and nothing of robots: a `part` becomes an element that is lowered
later. Every element made carries the span of its key and the calls and includes that led to it.
"""

from __future__ import annotations

from ..diagnostics import INHERITED, Frame, InputFault, Reporter, YamaroError, failure
from ..files.packages import PackageFinder
from ..policy import JAIL, Policy
from ..safe.namespace import MISSING, Namespace
from ..source import Source, Span
from ..syntax.document import Document
from ..syntax.keys import NAME_RULE, attribute_twice, name_fault
from ..syntax.names import (
    STATEMENTS,
    is_function_name,
)
from ..syntax.nodes import (
    BRIDGE,
    GLOBAL,
    LOCAL,
    Argument,
    Attribute,
    Body,
    CallNode,
    CommentNode,
    Content,
    DynamicNode,
    ElementNode,
    ForNode,
    FunctionsNode,
    IfNode,
    IncludeNode,
    InsertNode,
    ListContent,
    PartNode,
    PrintNode,
    ProcessNode,
    RobotWordNode,
    TextContent,
    TextNode,
    VariablesNode,
)
from ..syntax.statements import refuse_second_function
from ..syntax.template import Template
from ..syntax.variables import variable_name
from ..xml.tree import Comment, Element, PartElement, Text, unshared, with_trace
from ..xml.values import LiteralList, format_value, is_comment_text
from .calls import (
    Block,
    Function,
    Match,
    bind,
    evaluate_arguments,
    find_function,
    match_arguments,
)
from .conditions import holds
from .elements import Builder, evaluate_holes
from .expressions import Evaluator, SafeEvaluator
from .files import Files
from .includes import namespace_of, passed_by, path_of
from .loops import iterate, too_many_turns, unpack
from .messages import Messages
from .python_errors import Explainer, add_trace
from .scope import BlockScope, Scope, Shared, function_key
from .unread import Passed
from .values import Values

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

    from ..safe.runtime import SafeRuntime
    from ..xml.tree import Node
    from .library import Library


LONGEST_CYCLE = 20
"""Calls and includes, one in the other, that are named where they come again."""


class Interpreter:
    """One conversion: runs the main file and everything it includes."""

    def __init__(
        self,
        *,
        library: Library,
        reporter: Reporter,
        on_message: Callable[[str], None],
        policy: Policy | None = None,
        packages: PackageFinder | None = None,
        shares: bool = True,
    ) -> None:
        """Begin a conversion.

        Args:
            library: gives the files.
            reporter: takes the warnings.
            on_message: takes what `print` and `process` print, without a final line break.
            policy: how far the files are trusted; in full if left out.
            packages: finds ROS packages.
            shares: let one element stand wherever it would be built again just as it is, its
                trace INHERITED; without, every element is built for its place, with a trace.
        """
        policy = policy or Policy()
        self.policy = policy
        self.limits = policy.limits
        self.reporter = reporter
        self.messages = Messages(on_message, policy.limits)
        self.shared = Shared()
        self.safety: SafeRuntime | None = None
        if policy.is_safe:
            from ..safe.limits import SafeLimits
            from ..safe.runtime import SafeRuntime

            self.safety = SafeRuntime(SafeLimits.of(policy.limits), say=self.messages.say)
        self.files = Files(
            library,
            reporter=reporter,
            print_function=self.messages.print,
            safety=self.safety,
            packages=packages or PackageFinder(),
        )
        explainer = Explainer(
            self.files.codes,
            self.files.where_declared,
            policy.limits,
            is_jailed=policy.mode == JAIL,
        )
        self.evaluator = (
            Evaluator(explainer) if self.safety is None else SafeEvaluator(explainer, self.safety)
        )
        self.values = Values(self.evaluator)
        self.shares = shares
        self.builder = Builder()
        self.frame: Frame | None = None
        self.root_content: Content | None = None  # what is in the root of the main file
        self.is_inside = False  # whether what is made is in a child of the root, or in a part
        self.holder: Frame | None = None  # the frame in which that child or part was made
        self.is_yaml = False  # whether the main file is
        self.places: Mapping[str, Span] = {}  # where the variables of the main file are set
        self.passed: dict[tuple[int, int], Passed] = {}  # by the include and the file
        self.has_parts = False
        self.depth = 0
        self.statements_left = policy.limits.statements
        self.part_depth = 0
        self.element_depth = 0  # of XML elements below the <robot>
        self.is_robot = False
        self._frames: dict[tuple[str, int, Frame | None, Frame | None], Frame] = {}
        self._matches: dict[int, Match] = {}  # by the identity of a call's arguments

    # --- files ---

    def run_main(
        self,
        source: Source,
        *,
        stem: str,
        variables: dict[str, object],
        places: Mapping[str, Span] | None = None,
    ) -> Element:
        """Run the main file and return the root element.

        Args:
            source: the file.
            stem: the robot's name if the file gives none.
            variables: what is passed in.
            places: where each of them is set.

        Raises:
            YamaroError: the input has errors.
        """
        self.places = places = places or {}
        self.is_yaml = True
        try:
            document = self.files.parse(source)
            scope = self._begin_file(document, caller=None)
            for name, value in variables.items():
                scope.declare(name, self._admitted(name, value, source), place=places.get(name))
            scope.passed = frozenset(variables)
            return self._run_root(document, scope, stem)
        finally:
            self.messages.close()
            self.files.close()

    def _admitted(self, name: str, value: object, source: Source) -> object:
        """Return the value of a variable that is passed in, if it may come in."""
        if self.safety is None:
            return value
        try:
            return self.safety.admit(value)
        except InputFault as fault:
            message = f"the value of the variable '{name}': {fault.message}"
            raise failure(fault.code, message, Span(source, 0, 0), hint=fault.hint) from None

    def _run_root(self, document: Document, scope: Scope, stem: str) -> Element:
        self.is_robot = document.root is None or document.root.name == "robot"
        words = self._run_sections(document, scope)
        if document.root is not None:
            out: list[Node] = []
            self.root_content = document.root.content
            self.element_depth -= 1
            self.run_element(document.root, scope, out, None)
            self.element_depth += 1
            root = out[0] if out else None
            assert isinstance(root, Element), "a root element has a fixed name"
            is_named = "name" in root.attributes or root.verbatim
            if root.name == "robot" and not is_named:
                root.attributes = {"name": stem, **root.attributes}
            root.children += words
            return root
        start = document.model_span or Span(document.source, 0, 0)
        root = Element("robot", start, attributes={"name": stem})
        for body in document.model:
            self.run_body(body, scope, root.children)
        if document.robot_name is not None:
            content = document.robot_name
            root.span = content.span
            name = self.values.written(content.value, scope)
            root.attributes["name"] = stem if name is None else name
        root.children += words
        return root

    def _begin_file(self, document: Document, *, caller: Scope | None) -> Scope:
        """Return the context for a run of a file."""
        home = self.files.begin(document, self.frame)
        return Scope(home, self.shared, closure=None, caller=caller)

    def _run_sections(
        self, document: Document, scope: Scope, include: IncludeNode | None = None
    ) -> list[Node]:
        """Run what is before the model: imports first, then arguments, the others as written.

        Args:
            document: the file.
            scope: its context.
            include: what includes it; None for the main file.

        Returns:
            The sections of a robot, which follow its model.
        """
        self.files.import_modules(document, scope.home, self.evaluator)
        if document.arguments is not None:
            from .argument_values import settle_arguments

            settle_arguments(document.arguments, scope, self.values, include)
        words: list[Node] = []
        for statement in document.sections:
            if document.is_lone_section and include is None and type(statement) is RobotWordNode:
                continue
            _RUN[type(statement)](self, statement, scope, words, None)
        return words

    # --- bodies ---

    def run_body(self, body: Body, scope: Scope, out: list[Node]) -> None:
        """Run the statements of a body, appending what they make to `out`."""
        statements = body.statements
        self.statements_left -= len(statements)
        if self.statements_left < 0:
            raise self._too_many_statements(statements[0].span)
        for statement in statements:
            _RUN[type(statement)](self, statement, scope, out, body)

    def run_element(
        self, node: ElementNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        """Run an element, and append it to `out`; nothing if its name is empty."""
        form = node.form
        if form is not None and self.shares:
            values = evaluate_holes(form, scope, self.values)
            trace = self.trace()
            inner = trace if self.is_inside else INHERITED
            out.append(self.builder.element(form, values, self.part_depth > 0, trace, inner))
            return
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
            trace=self.trace(),
            value_spans=value_spans,
            verbatim=node.verbatim,
            body=body,
        )
        if node.content is not None:
            self._fill(element, node.content, scope)
        out.append(element)

    def _run_static(
        self, element: Element, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        """Put out an element that the parser has made."""
        if not self.shares:
            element = unshared(element, self.frame)
        elif self.frame is self.holder:
            self.builder.emit(element)
        else:
            inner = self.frame if self.is_inside else INHERITED
            element = self.builder.traced(element, self.frame, inner)
        out.append(element)

    def _run_ready(
        self, node: Text | Comment, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        """Put out a text or comment that the parser has made."""
        out.append(node)

    def trace(self) -> Frame | None:
        """Return the trace of an element that is made here."""
        return INHERITED if self.frame is self.holder and self.shares else self.frame

    def _fill(self, element: Element, content: Content, scope: Scope) -> None:
        """Give an element its content."""
        if isinstance(content, Body):
            self.element_depth += 1
            if self.is_inside or content is self.root_content:
                self.run_body(content, scope, element.children)
            else:
                self._run_inside(content, scope, element.children)
            self.element_depth -= 1
        elif isinstance(content, TextContent):
            value = self.values.written(content.value, scope)
            if value is not None or self.part_depth:  # in a part, None leaves the key out
                element.children.append(Text(value, content.span))
        elif isinstance(content, ListContent):
            if not self.part_depth:
                raise failure(
                    "list-as-text",
                    f"a list of plain values cannot be the content of <{element.name}>",
                    content.span,
                    hint="write the values as a text: 0 0 1; or elements as `- name: value`",
                )
            items = self.values.spelled_list(content.value, scope)
            element.children.append(Text(LiteralList(items), content.span))

    def _run_inside(self, body: Body, scope: Scope, out: list[Node]) -> None:
        """Run the body of a child of the root, or of a part, whose elements may inherit from it."""
        before = self.is_inside, self.holder
        self.is_inside, self.holder = True, self.frame
        self.run_body(body, scope, out)
        self.is_inside, self.holder = before

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
            result = self.values.written(value, scope)
            if result is None:
                return
        else:
            result = value
        if name in attributes:
            raise attribute_twice(name, attribute.name_span)
        attributes[name] = result
        value_spans[name] = attribute.span

    def _name(self, template: Template, scope: Scope, span: Span, what: str) -> str:
        """Return an evaluated name; an empty one drops what it would have named."""
        name = self.values.joined(template, scope)
        fault = name_fault(name, what) if name else None
        if fault is not None:
            raise failure(
                "bad-name",
                fault,
                span,
                hint=NAME_RULE,
            )
        return name

    def _run_text(self, node: TextNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        value = self.values.written(node.value, scope)
        if value is not None:
            out.append(Text(value, node.span))

    def _run_comment(
        self, node: CommentNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        text = format_value(self.values.written(node.value, scope))
        if not is_comment_text(text):
            raise failure(
                "bad-comment",
                "an XML comment cannot hold '--' or end with '-'",
                node.span,
                hint="use a single dash, or another sign",
            )
        out.append(Comment(text, node.span))

    def _run_part(self, node: PartNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        self.has_parts = True
        if node.form is not None and self.shares:
            values = evaluate_holes(node.form, scope, self.values)
            out.append(self.builder.part(node.form, values, self.trace()))
            return
        part = PartElement("part", node.span, trace=self.trace(), body=body)
        self.part_depth += 1
        self._run_inside(node.body, scope, part.children)
        self.part_depth -= 1
        out.append(part)

    def _run_robot_word(
        self, node: RobotWordNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        from .robot_words import run_robot_word

        run_robot_word(self, node, scope, out, body)

    def _run_dynamic(
        self, node: DynamicNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        """Run a bare key that holds `$(…)`: what its text names decides what it is."""
        text = self.values.joined(node.key, scope)
        if not text:
            return
        if is_function_name(text):
            arguments = self.files.late.call(node, text)
            self._call(text, arguments, node.span, scope, out)
            return
        if text in STATEMENTS:
            raise failure(
                "computed-statement",
                f"this key gives '{text}', and a statement cannot be computed",
                node.span,
                hint="write the statement as it is, inside an `if`; "
                f"for an XML element of that name write <{text}>:",
            )
        if node.faults:
            raise YamaroError(fault.copy() for fault in node.faults)
        fault = name_fault(text, "element")
        if fault is not None:
            raise failure(
                "bad-name",
                fault,
                node.span,
                hint="attributes are written behind the $(…): $(name)/attribute=value"
                if "/" in text
                else NAME_RULE,
            )
        element = Element(text, node.span, trace=self.trace(), body=body)
        self._fill(element, node.content, scope)
        out.append(element)

    # --- control flow ---

    def _run_if(self, node: IfNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        for condition, branch in node.branches:
            if condition is None or holds(condition, scope, self.evaluator):
                self.run_body(branch, scope, out)
                return

    def _run_for(self, node: ForNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        context = scope.context
        names = node.names
        single = names[0] if len(names) == 1 else None
        most = self.limits.turns
        for index, item in enumerate(iterate(node, scope, self.values)):
            if index >= most:
                raise too_many_turns(node.span, self.limits)
            self.statements_left -= 1  # an empty body would count as none
            if self.statements_left < 0:
                raise self._too_many_statements(node.span)
            if single is not None:
                context.declare(single, item, place=node.span)
            else:
                values = unpack(item, index, node, self.evaluator)
                for name, value in zip(names, values, strict=True):
                    context.declare(name, value, place=node.span)
            self.run_body(node.body, scope, out)

    # --- declarations ---

    def _run_variables(
        self, node: VariablesNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        for entry in node.entries:
            name = entry.name
            if not isinstance(name, str):
                name = self.values.joined(name, scope)
                if not name:
                    continue
                name = variable_name(name, entry.span)
            place: Span | None = entry.span
            if node.is_root and scope.is_passed_in(name):
                if entry.scope == LOCAL and name in self.shared.bridges:
                    continue
                value, place = scope.find(name), scope.place_of(name)
            elif len(entry.values) == 1:
                value = self.values.value(entry.values[0], scope)
            else:
                value = [self.values.value(item, scope) for item in entry.values]
            scope.declare(name, value, entry.scope, place)

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
                refuse_second_function(earlier.node, function)
            defined = Function(function, scope)
            if function.scope in (GLOBAL, BRIDGE):
                self._warn_of_replacement(self.shared.find(key), defined, key, function.span)
            scope.declare(key, defined, function.scope)

    def _run_print(self, node: PrintNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        text = self.values.message(node.value, scope, node.span)
        self.evaluator.guard(self.messages.say, text.removesuffix("\n") + "\n", node.span)

    def _run_process(
        self, node: ProcessNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        self.evaluator.execute(node.code, scope)

    # --- calls ---

    def _run_call(self, node: CallNode, scope: Scope, out: list[Node], body: Body | None) -> None:
        self._call(node.name, node.arguments, node.span, scope, out)

    def _run_insert(
        self, node: InsertNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        block = scope.find(function_key(node.name))
        if isinstance(block, Block):
            self.run_body(block.body, BlockScope(scope, block.written), out)
        elif node.default is not None:
            self.run_body(node.default, scope, out)

    def _call(
        self, name: str, arguments: list[Argument], span: Span, scope: Scope, out: list[Node]
    ) -> None:
        function = find_function(name, span, scope, self.files.where_declared)
        if isinstance(function, Block):
            self.run_body(function.body, BlockScope(scope, function.written), out)
            return
        if function is None:  # an optional block that was not given
            return
        match = self._matches.get(id(arguments))
        if match is None or match.node is not function.node:
            match = match_arguments(function.node, arguments, span, self.files.late)
            self._matches[id(arguments)] = match
        closure = function.closure
        callee = Scope(closure.home, self.shared, closure=closure, caller=scope.context)
        given = evaluate_arguments(match, scope, self.values)
        home, frame = closure.home.frame, match.frame
        if (
            frame is None
            or frame.parent is not self.frame
            or frame.home is not home
            or frame.name != name
        ):
            frame = match.frame = self._step("called", name, span, home)
            frame.places = match.places
        self._enter(frame, span)
        try:
            bind(match, given, callee, self.values)
            self.run_body(function.node.body, callee, out)
            if callee.kinds:
                for key, value in callee.exported():
                    self.receive(scope, key, value, span, callee.place_of(key))
        except YamaroError as error:
            add_trace(error, frame)
            raise
        except RecursionError:
            raise self._too_deep(span) from None
        finally:
            self._leave(frame)

    def _step(self, kind: str, name: str, span: Span, home: Frame | None) -> Frame:
        """Return the frame of a call or include from here; the same each time it is reached."""
        key = (name, id(span), self.frame, home)
        frame = self._frames.get(key)
        if frame is None:
            frame = self._frames[key] = Frame(kind, name, span, parent=self.frame, home=home)
        return frame

    def _enter(self, frame: Frame, span: Span) -> None:
        if self.depth >= self.limits.nesting:
            raise self._too_deep(span)
        self.depth += 1
        self.frame = self.evaluator.frame = frame

    def _leave(self, frame: Frame) -> None:
        if self.frame is frame:
            self.depth -= 1
            self.frame = self.evaluator.frame = frame.parent

    def _cycle(self) -> str | None:
        """Return a note on the calls and includes that come again in the steps that led here."""
        names: list[str] = []
        frame = self.frame
        first = frame
        while frame is not None and len(names) < LONGEST_CYCLE:
            names.append(frame.name)
            frame = frame.parent
            if frame and first and (frame.kind, frame.name) == (first.kind, first.name):
                return f"the cycle is {' → '.join([*reversed(names), names[-1]])}"
        return None

    def _too_deep(self, span: Span) -> YamaroError:
        cycle = self._cycle()
        return failure(
            "too-deep",
            f"calls and includes are nested {self.depth:,} deep here, which is taken as endless",
            span,
            hint="a function or file that uses itself needs a condition under which it stops; "
            + self.limits.hint("nesting"),
            notes=[cycle] if cycle else [],
        )

    def _too_many_statements(self, span: Span) -> YamaroError:
        return failure(
            "limit-statements",
            f"more than {self.limits.statements:,} statements are run, which is the limit",
            span,
            hint=self.limits.hint("statements"),
            trace=self.frame,
        )

    def receive(self, scope: Scope, key: str, value: Any, span: Span, place: Span | None) -> None:
        """Take a `parent` name to where the call or include stands."""
        self._warn_of_replacement(scope.get(key), value, key, span)
        scope.declare(key, value, place=place)

    def _warn_of_replacement(self, earlier: Any, value: Any, key: str, span: Span) -> None:
        if (
            isinstance(earlier, Function)
            and isinstance(value, Function)
            and earlier.node.span.key() != value.node.span.key()
        ):
            self.reporter.warn(
                "function-replaced",
                f"the function '{key[:-2]}' replaces another one of that name",
                span,
                hint="rename one of them, or include the file with a namespace",
                notes=[
                    f"the earlier one is defined at {earlier.node.span.place()}",
                    f"the new one is defined at {value.node.span.place()}",
                ],
                trace=self.frame,
            )

    # --- includes ---

    def run_include(
        self, node: IncludeNode, scope: Scope, out: list[Node], body: Body | None
    ) -> None:
        """Run a file in a context of its own, and take the names that it hands back."""
        path = path_of(node, scope, self.values)
        namespace = namespace_of(node, scope, self.values)
        passed = passed_by(node, scope, self.values)
        try:
            source = self.files.load(path, node.path_span, scope.home)
        except YamaroError as error:
            self._trace_into(error, node)
            raise
        if source.is_xml:
            self._include_xml(node, source, passed, scope, out)
            return
        context = scope.context
        frame = self._step("included", source.name, node.span, None)
        self._enter(frame, node.path_span)
        try:
            document = self.files.parse(source)
            if node.arguments:
                frame.places = {each.name: each.span for each in node.arguments if each.name}
                passed_to = Passed(node, document, frame.parent)
                self.passed.setdefault((id(node), id(document)), passed_to)
            before = len(self.shared.declared)
            inner = self._begin_file(document, caller=context)
            for argument in node.arguments:
                name = argument.name or ""
                inner.declare(name, passed[name], place=argument.span)
            inner.passed = frozenset(passed)
            words = self._run_sections(document, inner, node)
            self._run_included_model(document, inner, out)
            out += words
        except YamaroError as error:
            add_trace(error, frame)
            raise
        except RecursionError:
            raise self._too_deep(node.path_span) from None
        finally:
            self._leave(frame)
        self._hand_back(inner, scope, namespace, before, node.span)

    def _include_xml(
        self,
        node: IncludeNode,
        source: Source,
        passed: dict[str, Any],
        scope: Scope,
        out: list[Node],
    ) -> None:
        """Put out what an XML file holds: URDF as it is, or what a xacro file expands to."""
        from .xml_includes import (
            check_xml_include,
            declare_prefixes,
            mark_included,
            read_included,
            xacro_in_safe_mode,
            xml_content,
        )

        frame = self._step("included", source.name, node.span, None)
        try:
            root, is_xacro = read_included(source, self.limits)
        except YamaroError as error:
            add_trace(error, frame)
            raise
        check_xml_include(node, is_xacro=is_xacro)
        if is_xacro and self.safety is not None and not self.policy.is_confined:
            raise xacro_in_safe_mode(node.path_span)
        self._enter(frame, node.path_span)
        try:
            if is_xacro:
                root = self._expanded(root, passed, node, scope, frame)
                mark_included(root, "")
                content = root.children
            else:
                content = xml_content(root, passed.get("prefix"), frame, is_inside=self.is_inside)
            declare_prefixes(root, content)
            out += content
        except YamaroError as error:
            add_trace(error, frame)
            raise
        finally:
            self._leave(frame)

    def _expanded(
        self,
        root: Element,
        passed: dict[str, Any],
        node: IncludeNode,
        scope: Scope,
        frame: Frame,
    ) -> Element:
        """Return the root of what a xacro file expands to, given its own."""
        from ..xacro.expansion import expand
        from .xacro_host import XacroHost

        source = root.span.source
        host = XacroHost(
            self.files, self.messages, self.limits, main=source, has_environment=self.safety is None
        )
        arguments = {
            argument.name: self.evaluator.text(format_value, passed[argument.name], argument.span)
            for argument in node.arguments
            if argument.name is not None
        }
        if node.namespace is not None:
            arguments["namespace"] = str(namespace_of(node, scope, self.values))
        places = {each.name: each.span for each in node.arguments if each.name is not None}
        return expand(source, host, arguments, self.reporter, root=root, frame=frame, places=places)

    def _trace_into(self, error: YamaroError, node: IncludeNode) -> None:
        """Note the include that led to an error in a file that cannot even be read as text."""
        name = error.diagnostics[0].span.source.name
        if name != node.span.source.name:
            add_trace(error, Frame("included", name, node.span, parent=self.frame))

    def _run_included_model(self, document: Document, inner: Scope, out: list[Node]) -> None:
        for model in document.model:
            self.run_body(model, inner, out)
        if document.root is not None and not document.is_lone_section:
            made: list[Node] = []
            self.element_depth -= 1
            self.run_element(document.root, inner, made, None)
            self.element_depth += 1
            for element in made:
                if isinstance(element, Element):
                    out.extend(map(self._traced, element.children))

    def _traced(self, node: Node) -> Node:
        """Return what stands in a root element that is left out, with the trace of its own."""
        if not isinstance(node, Element) or node.trace is not INHERITED:
            return node
        if isinstance(node, PartElement):  # each is made for its place
            node.trace = self.frame
            return node
        for child in node.children:
            if isinstance(child, Element):
                self.builder.emit(child)
        return with_trace(node, self.frame)

    def _hand_back(
        self,
        inner: Scope,
        scope: Scope,
        namespace: str | None,
        before: int,
        span: Span,
    ) -> None:
        """Bring the names of an included file to the one that included it."""
        if namespace is None:
            for key, value in inner.exported():
                self.receive(scope, key, value, span, inner.place_of(key))
            return
        context = scope.context
        space = context.find(namespace) if namespace in context else None
        if not isinstance(space, Namespace):
            space = Namespace(namespace, self.shared.find)
        scope.declare(namespace, space)
        for key, value in inner.exported():
            self._warn_of_replacement(space._get(key), value, key, span)
            space._add(key, value)
        for key in dict.fromkeys(self.shared.declared[before:]):
            space._add(key, MISSING)


# Not in the interpreter itself, which would then refer to itself and live until the collector runs.
_RUN: dict[type, Callable[[Interpreter, Any, Scope, list[Node], Body | None], None]] = {
    ElementNode: Interpreter.run_element,
    Element: Interpreter._run_static,
    Text: Interpreter._run_ready,
    Comment: Interpreter._run_ready,
    TextNode: Interpreter._run_text,
    CommentNode: Interpreter._run_comment,
    PartNode: Interpreter._run_part,
    RobotWordNode: Interpreter._run_robot_word,
    CallNode: Interpreter._run_call,
    InsertNode: Interpreter._run_insert,
    DynamicNode: Interpreter._run_dynamic,
    IfNode: Interpreter._run_if,
    ForNode: Interpreter._run_for,
    IncludeNode: Interpreter.run_include,
    VariablesNode: Interpreter._run_variables,
    FunctionsNode: Interpreter._run_functions,
    PrintNode: Interpreter._run_print,
    ProcessNode: Interpreter._run_process,
}
