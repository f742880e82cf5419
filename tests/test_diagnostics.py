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
    render,
    suggest,
    trace_lines,
)
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
        reporter.warn("code", "say", span_of("a: b", piece))
    assert [warning.span.start for warning in reporter.diagnostics] == [0, 3]


def test_an_error_shows_all_its_diagnostics() -> None:
    one = failure("one", "first", span_of("a: b", "a")).diagnostics
    two = failure("two", "second", span_of("a: b", "b")).diagnostics
    error = YamaroError(one + two)
    assert str(error).count("error[") == 2
    assert str(error).index("first") < str(error).index("second")
