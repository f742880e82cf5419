"""Shows diagnostics as text: place, excerpt, hint, and the calls and includes that led there."""

from __future__ import annotations

from .diagnostics import ERROR, WARNING, Diagnostic, Frame
from .source import Span
from .terminal import BLUE, BOLD, RED, YELLOW, painted, printable, shortened, width

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

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
_STYLES = {ERROR: RED, WARNING: YELLOW}


def render(diagnostic: Diagnostic, *, color: bool = False) -> str:
    """Return the diagnostic as text: head, place, excerpt, hint and trace; no final line break."""
    paint = painted if color else _plain
    style = _STYLES[diagnostic.severity]
    head = f"{diagnostic.severity}[{printable(diagnostic.code)}]"
    lines = [f"{paint(head, style)}{paint(': ' + shortened(diagnostic.message), BOLD)}"]
    remarks = []
    if diagnostic.hint:
        remarks.append(("hint: ", diagnostic.hint))
    remarks.extend(("note: ", note) for note in diagnostic.notes[:MAX_NOTES])
    remarks.extend(("", line) for line in trace_lines(diagnostic.trace))
    return "\n".join(lines + excerpt_lines(diagnostic.span, remarks, style, paint))


def render_in_line(diagnostic: Diagnostic, *, color: bool = False) -> str:
    """Return the diagnostic in one line: what and where."""
    paint = painted if color else _plain
    head = paint(f"{diagnostic.severity}[{diagnostic.code}]", _STYLES[diagnostic.severity])
    return f"{head}: {shortened(diagnostic.message)}, at {shortened(diagnostic.span.place())}"


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
        hint = (diagnostic.hint or "").split("'")[::2]
        kind = (diagnostic.severity, diagnostic.code, "'".join(hint))
        groups.setdefault(kind, []).append(diagnostic)
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
    folded: list[str] = []  # those that repeat the line before are counted
    times: list[int] = []
    for one in steps:
        line = f"in {one.name}, {one.kind} at {one.span.place()}"
        if folded and folded[-1] == line:
            times[-1] += 1
        else:
            folded.append(line)
            times.append(1)
    lines = [
        line if number == 1 else f"{line} ({number} times)"
        for line, number in zip(folded, times, strict=True)
    ]
    if len(lines) > MAX_TRACE_LINES:
        keep = MAX_TRACE_LINES // 2
        hidden = len(lines) - 2 * keep
        lines[keep:-keep] = [f"… {hidden} more steps …"]
    return lines


def _excerpt(span: Span) -> tuple[int, str, str]:
    """Return line number, source line and underline, both made printable and equally wide."""
    line_number, column = span.location()
    text = span.source.line_text(line_number)
    start = min(column - 1, len(text))
    end = min(max(start + (span.end - span.start), start + 1), max(len(text), start + 1))
    left, right = 0, len(text)
    if right > MAX_EXCERPT_COLUMNS:  # the span, with some text around it
        room = MAX_EXCERPT_COLUMNS - min(end - start, MAX_EXCERPT_COLUMNS // 2)
        left = max(0, start - room // 2)
        right = min(right, left + MAX_EXCERPT_COLUMNS)
    before = "…" if left > 0 else ""
    after = "…" if right < len(text) else ""
    excerpt = before + printable(text[left:right]) + after
    pad = "".join(
        "\t" if c == "\t" else " " * width(printable(c)) for c in before + text[left:start]
    )
    marked = text[start : min(end, right)]
    underline = "^" * max(width(printable(marked)), 1)
    return line_number, excerpt, pad + underline
