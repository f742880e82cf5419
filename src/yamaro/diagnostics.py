"""Diagnostics: what is wrong, where, how it came there, and what to write instead.

There is one type for everything Yamaro has to say about an input, and one renderer.
"""

from __future__ import annotations

from .source import Source, Span
from .terminal import BLUE, BOLD, RED, YELLOW, painted, printable, shortened, width

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

    from .fixes import Fix

ERROR = "error"
WARNING = "warning"

FRAME_KINDS = ("called", "included", "loaded", "read")
"""What a step can be: a call of a function, an `include`, `load_yaml`, a file that xacro reads."""

MAX_TRACE_LINES = 12
MAX_STEPS = 10_000
"""Calls and includes to follow from a place: more than the limits let there be."""
MAX_EXCERPT_COLUMNS = 160
MAX_NOTES = 20
"""Notes of a diagnostic to show."""
MAX_ALIKE = {ERROR: 10, WARNING: 4}
"""Diagnostics of one kind to show; of more of them, one less."""
MAX_SHOWN = {ERROR: 20, WARNING: 100}
"""Diagnostics to show of all kinds together, by severity."""
MAX_PLACES = 8
"""Places to name of those that are not shown."""
MAX_SUGGESTED_LETTERS = 255
"""The longest word that a suggestion is looked for: file names are no longer."""


class Frame:
    """One step of the way to a place: a function call or an include, and where it was written."""

    __slots__ = ("home", "kind", "name", "parent", "places", "span")

    def __init__(
        self, kind: str, name: str, span: Span, *, parent: Frame | None, home: Frame | None = None
    ) -> None:
        """Describe a step.

        Args:
            kind: one of FRAME_KINDS.
            name: the function's or the file's name.
            span: where the call or include is written.
            parent: the step in which it was reached.
            home: for a call, the include that brought in the file the function is written in.
        """
        self.kind = kind
        self.name = name
        self.span = span
        self.parent = parent
        self.home = home
        self.places: Mapping[str, Span] = {}  # where what is passed is written, by its name


INHERITED = Frame("inherited", "", Span(Source("", name=""), 0, 0), parent=None)
"""The trace of an element that the same calls led to as to the part it is in, or, outside of parts,
to the child of the root that it is in; a child of the root itself was not called at all. So one
element can be in many places. Walks give their findings the trace of the place, see `settle`."""


class Diagnostic:
    """One thing to report about an input."""

    __slots__ = ("code", "fix", "hint", "message", "notes", "severity", "span", "trace")

    def __init__(
        self,
        code: str,
        message: str,
        span: Span,
        *,
        hint: str | None = None,
        notes: Sequence[str] = (),
        severity: str = ERROR,
        trace: Frame | None = None,
        fix: Fix | None = None,
    ) -> None:
        """Describe a fault.

        Args:
            code: stable, kebab-case, listed in docs/diagnostics.md.
            message: one line in lower case that names the thing in quotes.
            span: the place to underline.
            hint: what to write instead.
            notes: further facts, such as the place of a first definition; one line each.
            severity: ERROR or WARNING.
            trace: the calls and includes that led to the place.
            fix: the change of the text that the hint describes, if that is known.
        """
        self.code = code
        self.message = message
        self.span = span
        self.hint = hint
        self.notes = tuple(notes)
        self.severity = severity
        self.trace = trace
        self.fix = fix

    def copy(self) -> Diagnostic:
        """Return the same diagnostic, which may then be made another one."""
        return Diagnostic(
            self.code,
            self.message,
            self.span,
            hint=self.hint,
            notes=self.notes,
            severity=self.severity,
            trace=self.trace,
            fix=self.fix,
        )

    def __repr__(self) -> str:
        return f"<{self.severity}[{self.code}] {self.span.place()}: {self.message}>"


class YamaroError(Exception):
    """The input has errors; `diagnostics` holds them, with any warnings found before them."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        super().__init__()
        self.diagnostics = list(diagnostics)

    def __str__(self) -> str:
        return "\n".join(render_all(self.diagnostics))


class YamaroWarning(UserWarning):
    """The category under which `yamaro.convert` passes on its warnings."""


class InputFault(Exception):
    """A fault in an input whose place only the caller knows, such as a package that is not found.

    Attributes:
        position: line, column, end line and end column in the Python text that was being compiled,
            as `ast` counts them (lines from 1, columns from 0 in UTF-8 bytes), if it is known.
    """

    def __init__(
        self,
        code: str,
        message: str,
        hint: str | None = None,
        *,
        position: tuple[int, int, int, int] | None = None,
    ) -> None:
        """Hold what a diagnostic needs, except for the place."""
        super().__init__(message)
        self.code = code
        self.message = message
        self.hint = hint
        self.position = position


def failure(
    code: str,
    message: str,
    span: Span,
    *,
    hint: str | None = None,
    notes: Sequence[str] = (),
    trace: Frame | None = None,
    fix: Fix | None = None,
) -> YamaroError:
    """Return an exception with one error, ready to be raised; see `Diagnostic`."""
    error = Diagnostic(code, message, span, hint=hint, notes=notes, trace=trace, fix=fix)
    return YamaroError([error])


def add_trace(error: YamaroError, frame: Frame | None) -> None:
    """Note how the run came to an error, unless an inner step has noted it already."""
    for diagnostic in error.diagnostics:
        if diagnostic.trace is None:
            diagnostic.trace = frame


def failure_of_all(code: str, message: str, name: str, hint: str | None) -> YamaroError:
    """Return an error about a conversion as a whole, which is at no place of the file."""
    return failure(code, message, Span(Source("", name=name), 0, 0), hint=hint)


class Adjustment:
    """What was asked for the severity of diagnostics: codes allowed, codes denied, and strictness.

    A diagnostic that is raised as an exception stays an error: there is no document without it.
    """

    __slots__ = ("allowed", "denied", "is_strict")

    def __init__(
        self,
        allowed: Collection[str] = frozenset(),
        denied: Collection[str] = frozenset(),
        *,
        is_strict: bool = False,
    ) -> None:
        """Allow and deny some codes; with `is_strict` deny all that are not allowed."""
        self.allowed = allowed
        self.denied = denied
        self.is_strict = is_strict

    def allow(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Turn errors that are allowed into warnings; for those that do not prevent a document."""
        for diagnostic in diagnostics:
            if diagnostic.code in self.allowed:
                diagnostic.severity = WARNING

    def deny(self, diagnostics: Iterable[Diagnostic]) -> bool:
        """Turn warnings that are denied into errors; return whether there is any error."""
        has_errors = False
        for diagnostic in diagnostics:
            if diagnostic.severity == WARNING and self._denies(diagnostic.code):
                diagnostic.severity = ERROR
            has_errors = has_errors or diagnostic.severity == ERROR
        return has_errors

    def _denies(self, code: str) -> bool:
        return code in self.denied or (self.is_strict and code not in self.allowed)


class Reporter:
    """Collects the warnings of one run; the same warning at the same place counts once."""

    __slots__ = ("_seen", "diagnostics")

    def __init__(self) -> None:
        """Start with nothing collected."""
        self.diagnostics: list[Diagnostic] = []
        self._seen: set[object] = set()

    def warn(
        self,
        code: str,
        message: str,
        span: Span,
        *,
        hint: str | None = None,
        notes: Sequence[str] = (),
        trace: Frame | None = None,
        fix: Fix | None = None,
    ) -> None:
        """Collect a warning; see `Diagnostic`."""
        warning = Diagnostic(code, message, span, hint=hint, notes=notes, trace=trace, fix=fix)
        warning.severity = WARNING
        self.add(warning)

    def add(self, diagnostic: Diagnostic) -> None:
        """Collect `diagnostic` unless the same was collected before."""
        key = (diagnostic.code, diagnostic.message, diagnostic.span.key())
        if key not in self._seen:
            self._seen.add(key)
            self.diagnostics.append(diagnostic)


def settle(diagnostics: Iterable[Diagnostic], trace: Frame | None) -> None:
    """Give a trace to the diagnostics of elements that inherit theirs."""
    for diagnostic in diagnostics:
        if diagnostic.trace is INHERITED:
            diagnostic.trace = trace


def suggest(word: str, candidates: Iterable[str]) -> str | None:
    """Return the candidate that `word` is most likely a misspelling of, if any is near."""
    names = sorted(set(candidates) - {word})
    folded = [name for name in names if name.casefold() == word.casefold()]
    if folded:
        return folded[0]
    if not 2 <= len(word) <= MAX_SUGGESTED_LETTERS:
        return None
    near, likeness = None, 0.7 if len(word) > 3 else 0.6
    for name in names:
        found = _likeness(name, word, likeness)
        if found >= likeness:
            near, likeness = name, found
    return near


def _likeness(one: str, other: str, least: float) -> float:
    """Return how alike two texts are, from 0 to 1, or 0 if that is less than `least`.

    The measure of Ratcliff and Obershelp, as in Python's difflib. That takes longer to import than
    most robots to compile, and a word is compared for most of the element names in a file.
    """
    letters = len(one) + len(other)
    rest, shared = other, 0  # letters in both, in any order: no more can match
    for letter in one:
        if letter in rest:
            rest = rest.replace(letter, "", 1)
            shared += 1
    if 2.0 * shared / letters < least:
        return 0.0
    return 2.0 * _matching(one, other) / letters


def _matching(one: str, other: str) -> int:
    """Count the letters in the longest stretch that two texts share, and so on around it."""
    length = len(one)
    for size in range(min(length, len(other)), 0, -1):
        for start in range(length - size + 1):
            stretch = one[start : start + size]
            if stretch in other:
                before, _, after = other.partition(stretch)
                around = _matching(one[:start], before) + _matching(one[start + size :], after)
                return size + around
    return 0


def did_you_mean(word: str, candidates: Iterable[str]) -> str | None:
    """Return the hint "did you mean 'x'?", or None when nothing is near."""
    near = suggest(word, candidates)
    return f"did you mean '{near}'?" if near else None


# --- rendering --------------------------------------------------------------------------------

_STYLES = {ERROR: RED, WARNING: YELLOW}


def render(diagnostic: Diagnostic, *, color: bool = False) -> str:
    """Return the diagnostic as text: head, place, excerpt, hint and trace; no final line break."""
    paint = painted if color else _plain
    style = _STYLES[diagnostic.severity]
    head = f"{diagnostic.severity}[{printable(diagnostic.code)}]"
    lines = [f"{paint(head, style)}{paint(': ' + shortened(diagnostic.message), BOLD)}"]
    return "\n".join(lines + excerpt_lines(diagnostic.span, _remarks(diagnostic), style, paint))


def excerpt_lines(
    span: Span, remarks: Iterable[tuple[str, str]], style: str, paint: Callable[[str, str], str]
) -> list[str]:
    """Return the lines that show a place: where it is, its text underlined, and remarks.

    Args:
        span: the place.
        remarks: label and text of each line below the excerpt.
        style: that of the underline.
        paint: gives a text a style; see `terminal.painted`.
    """
    lines = [f" {paint('-->', BLUE)} {shortened(span.place())}"]
    line_number, excerpt, underline = _excerpt(span)
    gutter = " " * (len(str(line_number)) + 1)
    if excerpt.strip():
        bar = paint("|", BLUE)
        lines.append(f"{gutter}{bar}")
        lines.append(f"{paint(f'{line_number} |', BLUE)} {excerpt}")
        lines.append(f"{gutter}{bar} {paint(underline, style)}")
    for label, text in remarks:
        lines.append(f"{gutter}{paint('=', BLUE)} {paint(label, BOLD)}{shortened(text)}")
    return lines


def render_all(diagnostics: Sequence[Diagnostic], *, color: bool = False) -> list[str]:
    """Return all diagnostics as texts; of many that are alike, the first and where the others are.

    Those are alike that have the same severity, code and hint, except for what is quoted in it.
    """
    groups: dict[tuple[str, str, str], list[Diagnostic]] = {}
    for diagnostic in diagnostics:
        groups.setdefault(_kind_of(diagnostic), []).append(diagnostic)
    followers: dict[int, list[Diagnostic]] = {}  # behind the last one of a kind that is shown
    hidden: set[int] = set()
    for group in groups.values():
        most = MAX_ALIKE[group[0].severity]
        if len(group) > most:
            rest = group[most - 1 :]
            followers[id(group[most - 2])] = rest
            hidden.update(map(id, rest))
    shown = [diagnostic for diagnostic in diagnostics if id(diagnostic) not in hidden]
    texts = []
    numbers = {WARNING: 0, ERROR: 0}
    for diagnostic in shown:
        numbers[diagnostic.severity] += 1
        if numbers[diagnostic.severity] > MAX_SHOWN[diagnostic.severity]:
            continue
        texts.append(render(diagnostic, color=color))
        if id(diagnostic) in followers:
            texts.append(_places_of(followers[id(diagnostic)]))
    for severity, number in numbers.items():
        more = number - MAX_SHOWN[severity]
        if more > 0:
            texts.append(f"… and {more:,} more {severity}{'s' if more > 1 else ''}")
    return texts


def _kind_of(diagnostic: Diagnostic) -> tuple[str, str, str]:
    hint = (diagnostic.hint or "").split("'")
    return diagnostic.severity, diagnostic.code, "'".join(hint[::2])


def _places_of(alike: Sequence[Diagnostic]) -> str:
    """Return a line that shows where diagnostics of a kind are."""
    first = alike[0]
    places = dict.fromkeys((one.span.source.name, one.span.location()[0]) for one in alike)
    lines: dict[str, list[str]] = {}
    for name, line in list(places)[:MAX_PLACES]:
        lines.setdefault(shortened(name), []).append(str(line))
    listed = "; ".join(f"{name}:{', '.join(numbers)}" for name, numbers in lines.items())
    more = ", …" if len(places) > MAX_PLACES else ""
    count = f"{len(alike):,} more {first.severity}{'s' if len(alike) > 1 else ''}"
    return f"… {count} like this [{printable(first.code)}]: {listed}{more}"


def _plain(text: str, style: str) -> str:
    return text


def _remarks(diagnostic: Diagnostic) -> list[tuple[str, str]]:
    """Return label and text of each line below the excerpt."""
    remarks = []
    if diagnostic.hint:
        remarks.append(("hint: ", diagnostic.hint))
    remarks.extend(("note: ", note) for note in diagnostic.notes[:MAX_NOTES])
    remarks.extend(("", line) for line in trace_lines(diagnostic.trace))
    return remarks


def trace_lines(trace: Frame | None) -> list[str]:
    """Return the calls and includes that led to a place, innermost first, long runs folded."""
    steps: list[Frame] = []
    homes: list[Frame] = []
    seen: set[int] = set()
    frame = trace
    while frame is not None and len(steps) < MAX_STEPS:
        steps.append(frame)
        seen.add(id(frame))
        if frame.home is not None:
            homes.append(frame.home)
        frame = frame.parent
    for home in homes:
        step: Frame | None = home
        while step is not None and id(step) not in seen and len(steps) < MAX_STEPS:
            seen.add(id(step))
            steps.append(step)
            step = step.parent
    lines = _fold(f"in {step.name}, {step.kind} at {step.span.place()}" for step in steps)
    if len(lines) > MAX_TRACE_LINES:
        keep = MAX_TRACE_LINES // 2
        hidden = len(lines) - 2 * keep
        lines[keep:-keep] = [f"… {hidden} more steps …"]
    return lines


def _fold(lines: Iterable[str]) -> list[str]:
    """Return lines with those that repeat the line before counted in place of shown."""
    folded: list[str] = []
    times: list[int] = []
    for line in lines:
        if folded and folded[-1] == line:
            times[-1] += 1
        else:
            folded.append(line)
            times.append(1)
    return [
        line if number == 1 else f"{line} ({number} times)"
        for line, number in zip(folded, times, strict=True)
    ]


def _excerpt(span: Span) -> tuple[int, str, str]:
    """Return line number, source line and underline, both made printable and equally wide."""
    line_number, column = span.location()
    text = span.source.line_text(line_number)
    start = min(column - 1, len(text))
    end = min(max(start + (span.end - span.start), start + 1), max(len(text), start + 1))
    left, right = _window(text, start, end)
    before = "…" if left > 0 else ""
    after = "…" if right < len(text) else ""
    excerpt = before + printable(text[left:right]) + after
    pad = "".join(
        "\t" if c == "\t" else " " * width(printable(c)) for c in before + text[left:start]
    )
    marked = text[start : min(end, right)]
    underline = "^" * max(width(printable(marked)), 1)
    return line_number, excerpt, pad + underline


def _window(text: str, start: int, end: int) -> tuple[int, int]:
    """Return the part of a long line to show: the span, with some text around it."""
    if len(text) <= MAX_EXCERPT_COLUMNS:
        return 0, len(text)
    room = MAX_EXCERPT_COLUMNS - min(end - start, MAX_EXCERPT_COLUMNS // 2)
    left = max(0, start - room // 2)
    return left, min(len(text), left + MAX_EXCERPT_COLUMNS)
