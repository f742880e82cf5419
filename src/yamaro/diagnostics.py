"""Diagnostics: what is wrong, where, how it came there, and what to write instead.

There is one type for everything Yamaro has to say about an input, and one renderer, `rendering.py`.
"""

from __future__ import annotations

from .source import OverlaidSpan, Public, Source, Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from .fixes import Fix

ERROR = "error"
WARNING = "warning"
ACCEPTED = "accepted"
"""The severity of what a comment in the file accepts: it is not shown, and prevents nothing."""

FRAME_KINDS = ("called", "included", "loaded", "read")
"""What a step can be: a call of a function, an `include`, `load_yaml`, a file that xacro reads."""

MAX_SUGGESTED_LETTERS = 255
"""The longest word that a suggestion is looked for: file names are no longer."""


class Frame(Public):
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


class Meant(str):
    """The hint "did you mean 'x'?"; a diagnostic that has it has the fix that writes it.

    Attributes:
        word: what is written.
        near: what is probably meant.
    """

    __slots__ = ("near", "word")

    near: str
    word: str

    @classmethod
    def of(cls, word: str, near: str) -> Meant:
        """Return the hint that `near` is probably meant by `word`."""
        hint = cls(f"did you mean '{near}'?")
        hint.word, hint.near = word, near
        return hint


class Diagnostic(Public):
    """One thing to report about an input."""

    __slots__ = ("code", "fix", "hint", "message", "notes", "severity", "span", "trace")
    _internal = frozenset(("copy",))

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
            code: stable, kebab-case, described in a `rules.md`; see `codes.py`.
            message: one line in lower case that names the thing in quotes.
            span: the place to underline.
            hint: what to write instead.
            notes: further facts, such as the place of a first definition; one line each.
            severity: ERROR, WARNING or ACCEPTED.
            trace: the calls and includes that led to the place.
            fix: the change of the text that the hint describes, if that is known. A hint that
                `did_you_mean` returns brings its own, unless the word is not written at the place.
        """
        self.code = code
        self.message = message
        self.span = span
        self.hint = hint
        self.notes = tuple(notes)
        if type(span) is OverlaidSpan and span.note not in self.notes:
            self.notes += (span.note,)
        self.severity = severity
        self.trace = trace
        if fix is None and type(hint) is Meant and span.source.path:
            from .fixes import respelling

            fix = respelling(span, hint.word, hint.near)
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
    """The input has errors.

    Attributes:
        diagnostics: the errors, with any warnings found before them.
        accepted: what was found before and is accepted by comments.
    """

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        super().__init__()
        self.diagnostics = list(diagnostics)
        self.accepted: Sequence[Diagnostic] = ()

    def __repr__(self) -> str:
        first = next((each for each in self.diagnostics if each.severity == ERROR), None)
        others = len(self.diagnostics) - 1
        more = f" and {others} more" if others > 0 else ""
        return f"<YamaroError: {first or self.diagnostics}{more}>"

    def __str__(self) -> str:
        from .rendering import render_all

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


def given_twice(
    message: str,
    span: Span,
    first: Span,
    *,
    hint: str = "remove one of the two",
    trace: Frame | None = None,
    fix: Fix | None = None,
) -> YamaroError:
    """Return the error for something that is given at a place, and at another one before."""
    notes = (f"first given at {first.place()}",)
    return failure("given-twice", message, span, hint=hint, notes=notes, trace=trace, fix=fix)


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
            if diagnostic.severity == WARNING and (
                diagnostic.code in self.denied
                or (self.is_strict and diagnostic.code not in self.allowed)
            ):
                diagnostic.severity = ERROR
            has_errors = has_errors or diagnostic.severity == ERROR
        return has_errors


class Reporter:
    """Collects the findings of one run; the same one at the same place counts once."""

    __slots__ = ("_seen", "diagnostics")

    def __init__(self) -> None:
        """Start with nothing collected."""
        self.diagnostics: list[Diagnostic] = []
        self._seen: set[object] = set()

    def report(
        self,
        code: str,
        message: str,
        span: Span,
        *,
        hint: str | None = None,
        notes: Sequence[str] = (),
        trace: Frame | None = None,
        fix: Fix | None = None,
        severity: str | None = None,
    ) -> None:
        """Collect a diagnostic, by default with the severity of its code; see `Diagnostic`."""
        from .severities import SEVERITIES

        severity = severity or SEVERITIES[code]
        self.add(
            Diagnostic(
                code,
                message,
                span,
                hint=hint,
                notes=notes,
                severity=ERROR if severity == ERROR else WARNING,
                trace=trace,
                fix=fix,
            )
        )

    def add(self, diagnostic: Diagnostic) -> None:
        """Collect `diagnostic` unless the same was collected before."""
        key: tuple[object, ...] = (diagnostic.code, diagnostic.message, diagnostic.span.key())
        if diagnostic.severity == ACCEPTED:
            key = (*key, id(diagnostic))  # it may be accepted at each of several calls
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


def did_you_mean(word: str, candidates: Iterable[str]) -> Meant | None:
    """Return the hint "did you mean 'x'?", or None when nothing is near."""
    near = suggest(word, candidates)
    return Meant.of(word, near) if near else None


def meant(
    word: str, candidates: Iterable[str], span: Span, *, is_safe: bool = False
) -> tuple[str | None, Fix | None]:
    """Return the hint "did you mean 'x'?" and the fix that writes it; None when nothing is near.

    Args:
        word: what is written somewhere in the span.
        candidates: what it could mean.
        span: the place of the diagnostic.
        is_safe: whether the candidates are all words of the language, not names of the user's.
    """
    near = suggest(word, candidates)
    if near is None:
        return None, None
    from .fixes import respelling

    return f"did you mean '{near}'?", respelling(span, word, near, is_safe=is_safe)


def meant_word(word: str, words: Iterable[str], span: Span) -> tuple[str | None, Fix | None]:
    """Return hint and fix as `meant` does, for a word of the language: the fix is safe."""
    return meant(word, words, span, is_safe=True)


def unknown_word(
    code: str,
    message: str,
    span: Span,
    word: str,
    words: Iterable[str],
    *,
    hint: str,
    trace: Frame | None = None,
    near: str | None = None,
) -> YamaroError:
    """Return the error for a word that the language does not have at this place.

    Of the words that it has there, `near` is suggested, or else the nearest; `hint` says what to
    write if there is none. The rest is as for `failure`.
    """
    if near is None:
        said, fix = meant_word(word, words, span)
    else:
        from .fixes import respelling

        said, fix = f"did you mean '{near}'?", respelling(span, word, near, is_safe=True)
    return failure(code, message, span, hint=said or hint, trace=trace, fix=fix)
