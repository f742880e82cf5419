"""How diagnostics look, what is suggested, and that a warning is given once."""

from __future__ import annotations

import unicodedata

import pytest

from yamaro.diagnostics import (
    Diagnostic,
    Frame,
    Reporter,
    YamaroError,
    did_you_mean,
    failure,
    suggest,
)
from yamaro.rendering import render, render_all, trace_lines
from yamaro.source import Source, Span
from yamaro.terminal import printable


def span_of(text: str, piece: str, name: str = "t.yaml") -> Span:
    start = text.index(piece)
    return Span(Source(text, name=name), start, start + len(piece))


def test_a_diagnostic_is_shown_with_its_line_and_all_remarks() -> None:
    text = "a: 1\nlenght: 2\n"
    place = span_of(text, "lenght")
    frame = Frame("called", "Make", span_of(text, "a"), parent=None)
    diagnostic = Diagnostic("code", "say", place, hint="do", notes=["know"], trace=frame)
    assert render(diagnostic) == (
        "error[code]: say\n"
        " --> t.yaml:2:1\n"
        "  |\n"
        "2 | lenght: 2\n"
        "  | ^^^^^^\n"
        "  = hint: do\n"
        "  = note: know\n"
        "  = in Make, called at t.yaml:1:1"
    )
    assert repr(diagnostic) == "<error[code] t.yaml:2:1: say>"
    assert repr(place) == "Span(t.yaml:2:1, 'lenght')"


def test_colour_changes_nothing_but_colour() -> None:
    import re

    diagnostic = Diagnostic("code", "say", span_of("ab: 1", "b"), hint="do")
    coloured = render(diagnostic, color=True)
    assert "\033[1;31m" in coloured
    assert re.sub(r"\033\[[\d;]*m", "", coloured) == render(diagnostic)


def test_an_empty_line_is_not_shown() -> None:
    shown = render(Diagnostic("code", "say", Span(Source("", name="t.yaml"), 0, 0)))
    assert shown == "error[code]: say\n --> t.yaml:1:1"


def width(text: str) -> int:
    return sum(2 if unicodedata.east_asian_width(char) in "WF" else 1 for char in text)


@pytest.mark.parametrize("before", ["日本", "e\u0301", "\t", "\x07", "\u202e", "😀", "\U000e0001"])
def test_the_underline_stands_below_its_place(before: str) -> None:
    text = f"{before}here"
    *_, line, underline = render(Diagnostic("c", "m", span_of(text, "here"))).split("\n")
    head = line.removeprefix("1 | ").partition("here")[0]
    pad = underline.removeprefix("  | ").partition("^")[0]
    combining = sum(unicodedata.combining(char) > 0 for char in head)
    assert len(pad) == width(head) - combining
    assert underline.count("^") == 4


def test_of_a_long_line_the_place_is_shown() -> None:
    text = "x" * 500 + "here" + "y" * 500
    *_, line, underline = render(Diagnostic("c", "m", span_of(text, "here"))).split("\n")
    assert len(line) < 180
    assert line[underline.index("^") :][:4] == "here"
    assert line.count("…") == 2


def test_what_would_steer_a_terminal_is_escaped() -> None:
    assert printable("a\x1b[0m\u202e\U000e0001é\t") == "a\\x1b[0m\\u202e\\U000e0001é\t"


@pytest.mark.parametrize(
    ("word", "candidates", "found"),
    [
        ("lenght", ["length", "width"], "length"),
        ("Length", ["length", "lengths"], "length"),
        ("xyzzy", ["length"], None),
        ("length", ["length"], None),
        ("a", [], None),
    ],
)
def test_suggestions_are_near(word: str, candidates: list[str], found: str | None) -> None:
    assert suggest(word, candidates) == found
    assert did_you_mean(word, candidates) == (f"did you mean '{found}'?" if found else None)


def test_a_long_way_is_folded() -> None:
    text = "".join(f"k{number}: 1\n" for number in range(40))
    frame: Frame | None = None
    for number in range(40):
        frame = Frame("called", f"F{number}", span_of(text, f"k{number}:"), parent=frame)
    lines = trace_lines(frame)
    assert len(lines) <= 13
    assert lines[0].startswith("in F39, called at t.yaml:40:")
    assert lines[-1].startswith("in F0, called at t.yaml:1:")
    assert any("more steps" in line for line in lines)


def test_the_include_that_brought_a_function_is_part_of_its_way() -> None:
    home = Frame("included", "lib.yaml", span_of("i: lib", "i"), parent=None)
    frame = Frame("called", "F", span_of("f: 1", "f", "u.yaml"), parent=None, home=home)
    assert trace_lines(frame) == [
        "in F, called at u.yaml:1:1",
        "in lib.yaml, included at t.yaml:1:1",
    ]


def test_the_same_warning_at_the_same_place_counts_once() -> None:
    reporter = Reporter()
    for piece in ("a", "a", "b"):
        reporter.report("zero-axis", "say", span_of("a: b", piece))
    assert [warning.span.start for warning in reporter.diagnostics] == [0, 3]


def test_an_error_shows_all_its_diagnostics() -> None:
    one = failure("one", "first", span_of("a: b", "a")).diagnostics
    two = failure("two", "second", span_of("a: b", "b")).diagnostics
    error = YamaroError(one + two)
    assert str(error).count("error[") == 2
    assert str(error).index("first") < str(error).index("second")


# --- many of them -------------------------------------------------------------------------------

LINES = Source("".join(f"line {number}\n" for number in range(1, 20_001)), name="r.yaml")


def at_line(line: int, code: str, hint: str | None = None, severity: str = "warning") -> Diagnostic:
    start = LINES.line_starts()[line - 1]
    span = Span(LINES, start, start + 4)
    return Diagnostic(code, f"the link 'l{line}' is odd", span, hint=hint, severity=severity)


def test_of_many_warnings_of_a_kind_three_are_shown_and_where_the_others_are() -> None:
    odd = [at_line(line, "odd", f"leave out 'l{line}'") for line in range(1, 29)]
    texts = render_all(odd)
    assert texts[:3] == [render(one) for one in odd[:3]]
    assert texts[3:] == ["… 25 more warnings like this [odd]: r.yaml:4, 5, 6, 7, 8, 9, 10, 11, …"]


def test_a_few_of_a_kind_are_all_shown_and_so_are_other_kinds() -> None:
    few = [at_line(line, "odd", "leave it out") for line in (1, 2, 3, 4)]
    other = [at_line(line, "odd", "write it again") for line in (5, 6, 7, 8)]
    errors = [at_line(line, "odd", "leave it out", "error") for line in range(9, 19)]
    every = [*few, *other, *errors]
    assert render_all(every) == [render(one) for one in every]
    assert str(YamaroError(every)).count("is odd") == len(every)


def test_the_places_of_what_is_folded_follow_the_last_one_shown() -> None:
    odd = [at_line(line, "odd") for line in (1, 2, 3, 4, 6)]
    between = at_line(5, "other")
    texts = render_all([*odd[:4], between, odd[4]])
    assert texts == [
        *(render(one) for one in odd[:3]),
        "… 2 more warnings like this [odd]: r.yaml:4, 6",
        render(between),
    ]


def test_places_on_one_line_are_named_once_and_files_by_their_names() -> None:
    other = Source("a", name="\x1b[2J.yaml")
    odd = [at_line(1, "odd") for _ in range(9)]
    odd.append(Diagnostic("odd", "m", Span(other, 0, 1), severity="warning"))
    assert render_all(odd)[-1] == (r"… 7 more warnings like this [odd]: r.yaml:1; \x1b[2J.yaml:1")


def test_twenty_errors_of_different_kinds_are_shown_and_the_rest_is_counted() -> None:
    errors = [Diagnostic(f"odd-{n}", "m", Span(LINES, 0, 4)) for n in range(22)]
    warnings = [at_line(1, "odd")]
    assert render_all([*warnings, *errors]) == [
        *(render(one) for one in [*warnings, *errors[:20]]),
        "… and 2 more errors",
    ]
    assert render_all(errors[:21])[-1] == "… and 1 more error"
    assert render_all(errors[:20])[-1] == render(errors[19])


@pytest.mark.parametrize("count", [200, 20_000])
def test_however_many_there_are_what_is_shown_is_bounded(count: int) -> None:
    of_kinds = [at_line(1 + n, f"odd-{n}", f"hint {n}") for n in range(count)]
    texts = render_all(of_kinds)
    assert len(texts) == 101
    assert texts[-1] == f"… and {count - 100:,} more warnings"
    notes = ["note"] * count
    span = Span(LINES, 0, 4)
    assert len(render(Diagnostic("odd", "m", span, notes=notes)).splitlines()) < 40


def test_an_error_keeps_all_its_diagnostics() -> None:
    error = YamaroError([at_line(1 + n, "odd", severity="error") for n in range(500)])
    assert len(error.diagnostics) == 500
    assert len(str(error)) < 5_000
    assert "… 491 more errors like this [odd]: r.yaml:10, 11" in str(error)
