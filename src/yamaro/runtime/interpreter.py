"""One conversion while it runs: its state, its messages, the calls and includes it is in.

Knows names, files and values, and nothing of robots: a `part` becomes an element that is lowered
later. Every element made carries the span of its key and the calls and includes that led to it.
"""

from __future__ import annotations

from ..diagnostics import INHERITED, Frame, InputFault, Reporter, YamaroError, failure
from ..files.packages import PackageFinder
from ..policy import JAIL, Limits, Policy
from ..source import Source, Span
from ..syntax.nodes import (
    Body,
    Content,
    Document,
    IncludeNode,
    RobotWordNode,
)
from ..xml.forms import Builder
from .calls import (
    Function,
    Match,
)
from .expressions import Evaluator, SafeEvaluator, Values
from .files import Files
from .predefined import TARGET
from .scope import Scope, SharedNames

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

    from ..safe.runtime import SafeRuntime
    from ..xml.tree import Element, Node
    from .files import Library
    from .python_errors import Explainer
    from .recording import Noted
    from .yaml_main import Passed

    ReadSource = Callable[[Element, Callable[[str, Span], Source]], Element | None]
    Handlers = Mapping[type, Callable[["Interpreter", Any, Scope, list[Node], Body | None], None]]


# --- what `print` and `process` print, passed on as lines -------------------------------------


class Messages:
    """Collects printed text into whole lines for the receiver of messages."""

    __slots__ = ("_left", "_limits", "_on_message", "_unfinished")

    def __init__(self, on_message: Callable[[str], None], limits: Limits) -> None:
        """Pass each line, or lines printed at once, to `on_message`, without a final break."""
        self._on_message = on_message
        self._limits = limits
        self._left = limits.printed
        self._unfinished: list[str] = []  # what was printed with another `end` than a line break

    def say(self, text: str) -> None:
        """Take printed text, and pass it on as soon as its line is complete.

        Raises:
            InputFault: it is more than may be printed.
        """
        self._left -= len(text)
        if self._left < 0:
            raise InputFault(
                "limit-printed",
                f"more than {self._limits.printed:,} characters are printed, which is the limit",
                self._limits.hint("printed"),
            )
        lines, has_end, rest = text.rpartition("\n")
        if has_end:
            self._on_message("".join([*self._unfinished, lines]))
            self._unfinished.clear()
        if rest:
            self._unfinished.append(rest)

    def close(self) -> None:
        """Pass on a last line that was never ended."""
        if self._unfinished:
            self._on_message("".join(self._unfinished))
            self._unfinished.clear()

    def print(
        self,
        *values: object,
        sep: str | None = " ",
        end: str | None = "\n",
        file: Any = None,
        flush: bool = False,
    ) -> None:
        """Replace Python's `print` in expressions and process blocks."""
        if file is not None:
            print(*values, sep=sep, end=end, file=file, flush=flush)
            return
        text = (" " if sep is None else sep).join(str(value) for value in values)
        self.say(text + ("\n" if end is None else end))


# --- the conversion ---------------------------------------------------------------------------


LONGEST_CYCLE = 20
"""Calls and includes, one in the other, that are named where they come again."""


class Interpreter:
    """One conversion: runs the main file and everything it includes.

    Attributes:
        noted: notes the values of names where they are declared, or None.
    """

    noted: Noted | None = None

    def __init__(
        self,
        handlers: Handlers,
        *,
        library: Library,
        reporter: Reporter,
        on_message: Callable[[str], None],
        policy: Policy | None = None,
        packages: PackageFinder | None = None,
        shares: bool = True,
        target: str = TARGET,
        read_source: ReadSource | None = None,
    ) -> None:
        """Begin a conversion.

        Args:
            handlers: what runs each kind of statement.
            library: gives the files.
            reporter: takes the warnings.
            on_message: takes what `print` and `process` print, without a final line break.
            policy: how far the files are trusted; in full if left out.
            packages: finds ROS packages.
            shares: let one element stand wherever it would be built again just as it is, its
                trace inherited; without, every element is built for its place, with a trace.
            target: the output format that is written.
            read_source: gives the `<robot>` that a document in another format than URDF describes,
                None for other documents.
        """
        self._handlers = handlers
        self.policy = policy = policy or Policy()
        self.limits = policy.limits
        self.reporter = reporter
        self.messages = Messages(on_message, policy.limits)
        self.shared_names = SharedNames()
        self.safety: SafeRuntime | None = None
        if policy.is_safe:
            from ..safe.limits import SafeLimits
            from ..safe.runtime import SafeRuntime

            self.safety = SafeRuntime(SafeLimits.of(policy.limits), say=self.messages.say)
        self.target = target
        self.files = Files(
            library,
            reporter=reporter,
            print_function=self.messages.print,
            safety=self.safety,
            packages=packages or PackageFinder(),
            target=target,
        )
        self.evaluator = _evaluator_of(policy, self.files, self.safety)
        self.values = Values(self.evaluator)
        self.shares = shares
        self.read_source = read_source
        self.builder = Builder()
        self.frame: Frame | None = None
        self.root_content: Content | None = None  # what is in the root of the main file
        self.is_inside = False  # whether what is made is in a child of the root, or in a part
        self.holder: Frame | None = None  # the frame in which that child or part was made
        self.is_yaml = False  # whether the main file is
        self.places: Mapping[str, Span] = {}  # where the variables of the main file are set
        self.passed: dict[tuple[int, int], Passed] = {}  # by the include and the file
        self.has_raw_blocks = self.has_blocks = False  # one is reached; one is not for URDF
        self.depends_on_format = False  # shapes are not the same for each output format
        self.has_parts = self.has_notes = self.is_robot = False
        self.foreign: list[Source] = []  # files that were read of formats besides URDF and xacro
        self.statements_left = policy.limits.statements
        self.depth = self.part_depth = 0
        self.element_depth = 0  # of XML elements below the <robot>
        self.filled: Element | None = None  # the innermost element whose content is run
        self._frames: dict[tuple[str, int, Frame | None, Frame | None], Frame] = {}
        self.matches: dict[int, Match] = {}  # by the identity of a call's arguments

    def begin_file(self, document: Document, *, caller: Scope | None) -> Scope:
        """Return the context for a run of a file."""
        home = self.files.begin(document, self.frame)
        return Scope(home, self.shared_names, closure=None, caller=caller)

    def run_sections(
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
            from .argument_values import settle_arguments, warn_of_own_prefix

            settle_arguments(document.arguments, scope, self.values, include)
            if include is not None and include.own_prefix is not None:
                names = [entry.name for entry in document.arguments]
                warn_of_own_prefix(
                    include, include.own_prefix, names, document.source, self.reporter
                )
            if self.noted is not None:
                for entry in document.arguments:
                    self.noted.take(scope, [entry.name], entry.span)
        words: list[Node] = []
        for statement in document.sections:
            if document.is_lone_section and include is None and type(statement) is RobotWordNode:
                continue
            self._handlers[type(statement)](self, statement, scope, words, None)
        return words

    def run_body(self, body: Body, scope: Scope, out: list[Node]) -> None:
        """Run the statements of a body, appending what they make to `out`."""
        statements = body.statements
        self.statements_left -= len(statements)
        if self.statements_left < 0:
            raise self.too_many_statements(statements[0].span)
        handlers = self._handlers
        for statement in statements:
            handlers[type(statement)](self, statement, scope, out, body)

    def trace(self) -> Frame | None:
        """Return the trace of an element that is made here."""
        return INHERITED if self.frame is self.holder and self.shares else self.frame

    def inner_trace(self, trace: Frame | None) -> Frame | None:
        """Return the trace of what is in an element that is made here with one."""
        return trace if self.is_inside else INHERITED

    def run_inside(self, body: Body, scope: Scope, out: list[Node]) -> None:
        """Run the body of a child of the root, or of a part, whose elements may inherit from it."""
        before = self.is_inside, self.holder
        self.is_inside, self.holder = True, self.frame
        self.run_body(body, scope, out)
        self.is_inside, self.holder = before

    def step(self, kind: str, name: str, span: Span, home: Frame | None) -> Frame:
        """Return the frame of a call or include from here; the same each time it is reached."""
        key = (name, id(span), self.frame, home)
        frame = self._frames.get(key)
        if frame is None:
            frame = self._frames[key] = Frame(kind, name, span, parent=self.frame, home=home)
        return frame

    def enter(self, frame: Frame, span: Span) -> None:
        """Begin a step; raise YamaroError if it is one too many."""
        if self.depth >= self.limits.nesting:
            raise self.too_deep(span)
        self.depth += 1
        self.frame = self.evaluator.frame = frame

    def leave(self, frame: Frame) -> None:
        """End a step, if it was begun."""
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

    def too_deep(self, span: Span) -> YamaroError:
        """Return the error for a step that is one too many."""
        cycle = self._cycle()
        return failure(
            "too-deep",
            f"calls and includes are nested {self.depth:,} levels "
            "deep here, which is probably endless",
            span,
            hint="a function or file that uses itself needs a condition that ends the recursion; "
            + self.limits.hint("nesting"),
            notes=[cycle] if cycle else [],
        )

    def too_many_statements(self, span: Span) -> YamaroError:
        """Return the error for a statement that is one too many."""
        return failure(
            "limit-statements",
            f"more than {self.limits.statements:,} statements are run, which is the limit",
            span,
            hint=self.limits.hint("statements"),
            trace=self.frame,
        )

    def receive(self, scope: Scope, key: str, value: Any, span: Span, place: Span | None) -> None:
        """Take a `parent` name to where the call or include stands."""
        self.warn_of_replacement(scope.get(key), value, key, span)
        scope.declare(key, value, place=place)

    def warn_of_replacement(self, earlier: Any, value: Any, key: str, span: Span) -> None:
        """Warn if a function takes the place of another one."""
        if (
            isinstance(earlier, Function)
            and isinstance(value, Function)
            and earlier.node.span.key() != value.node.span.key()
        ):
            self.reporter.report(
                "function-replaced",
                f"the function '{key[:-2]}' replaces another function of that name",
                span,
                hint="rename one of them, or include the file with a namespace",
                notes=[
                    f"the earlier one is defined at {earlier.node.span.place()}",
                    f"the new one is defined at {value.node.span.place()}",
                ],
                trace=self.frame,
            )


def _evaluator_of(policy: Policy, files: Files, safety: SafeRuntime | None) -> Evaluator:
    is_jailed = policy.mode == JAIL

    def make_explainer() -> Explainer:
        from .python_errors import Explainer

        return Explainer(files.codes, files.where_declared, policy.limits, is_jailed=is_jailed)

    if safety is None:
        return Evaluator(make_explainer, policy.limits)
    return SafeEvaluator(make_explainer, policy.limits, safety)
