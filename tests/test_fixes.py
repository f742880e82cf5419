"""Fixes: the edits of a diagnostic change what its hint names, and remove its cause."""

from __future__ import annotations

import shlex
from collections.abc import Iterable
from pathlib import Path

import pytest

from tests.golden import areas, case_id, find_cases, read_options
from yamaro.api import build
from yamaro.diagnostics import Diagnostic, YamaroError, did_you_mean
from yamaro.fixes import Edit, Fix, renumbering, replacement, respelling
from yamaro.options import UsageError
from yamaro.policy import Policy
from yamaro.source import Source, Span


def findings(case: Path, text: str | None = None) -> list[Diagnostic]:
    """Return what is reported about a case, or about another text in its place."""
    options = read_options(case)
    words = shlex.split(options.get("args", ""))
    try:
        made = build(
            str(case),
            text=text,
            policy=Policy("safe") if "--safe" in words else None,
            command_line=[word for word in words if ":=" in word],
            advice=options.get("command") == "check",
            on_message=lambda line: None,
        )
    except YamaroError as error:
        return error.diagnostics
    except (UsageError, SystemExit):
        return []
    return made.warnings


def applied(text: str, edits: Iterable[Edit]) -> str:
    for edit in sorted(edits, key=lambda edit: edit.span.start, reverse=True):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text


def kinds(found: Iterable[Diagnostic]) -> list[tuple[str, str]]:
    return [(one.code, one.message) for one in found]


def reported() -> list[Path]:
    """Return the cases about which anything is reported, also where `-q` keeps it quiet.

    Without those that set limits, which `findings` does not.
    """
    return [
        case
        for case in find_cases()
        for words in [read_options(case).get("args", "")]
        if (case.with_suffix(".err").exists() or "-q" in words) and "limit" not in words
    ]


@pytest.mark.parametrize("cases", areas(reported()).values(), ids=areas(reported()))
def test_a_fix_removes_what_it_is_a_fix_of(
    cases: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(cases[0].parent)
    for case in cases:
        check_fixes(case)


def check_fixes(case: Path) -> None:
    before = findings(case)
    for diagnostic in before:
        fix = diagnostic.fix
        if fix is None or any(edit.span.source.path != str(case) for edit in fix.edits):
            continue
        assert diagnostic.hint, "a fix goes with a hint"
        after = findings(case, applied(diagnostic.span.source.text, fix.edits))
        was = kinds(before).count((diagnostic.code, diagnostic.message))
        left = kinds(after).count((diagnostic.code, diagnostic.message))
        assert left < was, (case_id(case), diagnostic, fix)
        if fix.is_safe:  # what was not reached before may be reported now, but YAML is read
            assert "not-yaml" not in {one.code for one in after}, case_id(case)


def span_of(text: str, piece: str) -> Span:
    start = text.index(piece)
    return Span(Source(text, name="t.yaml"), start, start + len(piece))


def test_a_fix_says_what_it_changes() -> None:
    fix = replacement(span_of("a: raduis", "raduis"), "radius")
    assert fix.title == "change 'raduis' to 'radius'"
    assert not fix.is_safe
    assert [edit.text for edit in fix.edits] == ["radius"]


@pytest.mark.parametrize(
    ("written", "word", "near", "result"),
    [
        ("raduis", "raduis", "radius", "radius"),
        ("'raduis'", "raduis", "radius", "'radius'"),
        ("<sensro/name=x>", "sensro", "sensor", "<sensor/name=x>"),
        ("joitn/name=joitn", "joitn", "joint", "joint/name=joitn"),
        ("$(lenght * 2)", "lenght", "length", "$(length * 2)"),
    ],
)
def test_a_word_is_respelled_in_its_place(written: str, word: str, near: str, result: str) -> None:
    span = span_of(f"x: {written} y", written)
    fix = respelling(span, word, near)
    assert fix is not None
    assert applied(span.source.text, fix.edits) == f"x: {result} y"


@pytest.mark.parametrize(
    ("written", "word", "near"),
    [
        ("$(name)", "raduis", "radius"),  # it was computed
        ("raduis_2", "raduis", "radius"),  # another word
        ("my-raduis", "raduis", "radius"),
        ("$(a + a)", "a", "b"),  # which of the two
        ("raduis", "raduis", "a: b"),  # is no word of YAML
        ("raduis", "raduis", ""),
        ("raduis", "", "radius"),
    ],
)
def test_what_is_not_written_is_not_respelled(written: str, word: str, near: str) -> None:
    assert respelling(span_of(f"x: {written}", written), word, near) is None


def test_a_hint_at_a_near_word_brings_its_fix() -> None:
    span = span_of("a: raduis", "raduis")
    hint = did_you_mean("raduis", ["radius", "length"])
    assert Diagnostic("x", "", span, hint=hint).fix is None  # the text is that of no file
    span.source.path = "/t.yaml"
    fix = Diagnostic("x", "", span, hint=hint).fix
    assert fix is not None and not fix.is_safe
    assert applied(span.source.text, fix.edits) == "a: radius"
    assert did_you_mean("raduis", ["mass"]) is None


@pytest.mark.parametrize(
    ("written", "result"),
    [("3 4 0", "0.6 0.8 0"), ("'3 4 0'", "'0.6 0.8 0'"), ("3 $(y) 0", None), ("''", None)],
)
def test_numbers_that_are_written_are_replaced(written: str, result: str | None) -> None:
    fix = renumbering(span_of(f"x: {written} y", written), "0.6 0.8 0")
    if result is None:
        assert fix is None
    else:
        assert fix is not None
        assert applied(f"x: {written} y", fix.edits) == f"x: {result} y"


def test_a_fix_shows_itself() -> None:
    fix: Fix | None = respelling(span_of("a: raduis", "raduis"), "raduis", "radius", is_safe=True)
    assert repr(fix) == "<safe fix: change 'raduis' to 'radius'>"
    assert fix is not None and repr(fix.edits[0]) == "Edit(t.yaml:1:4, 'raduis' -> 'radius')"
