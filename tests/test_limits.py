"""Each limit: what just keeps to it is built, and with one less it is refused with its code."""

from __future__ import annotations

from pathlib import Path

import pytest

from yamaro import Policy, YamaroError, build
from yamaro.policy import JAIL, SAFE, TRUSTED, limit_names

# name, the lowest limit that suffices, code, text
EVERYWHERE = [
    ("file", 17, "limit-file", "doc: {a: 12345}\n\n"),
    ("files", 2, "limit-files", "doc:\n  include: one.yaml\n  a: {include: one.yaml}\n"),
    ("yaml-depth", 4, "too-deep", "doc: {variables: {a: [1]}}"),
    ("yaml-depth", 5, "too-deep", "doc: {variables: {a: [[1]]}}"),
    ("aliases", 4, "alias-bomb", "doc: {variables: {a: &a [1, 2, 3], b: *a}}"),
    ("nesting", 2, "too-deep", "doc: {functions: {F: {body: {G: }}, G: {body: {a: 1}}}, F: }"),
    ("turns", 3, "limit-turns", "doc: {for: {iterator: i, range: 3, body: {a: $(i)}}}"),
    (
        "statements",
        3,
        "limit-statements",
        "doc: {if: {condition: true, body: {variables: {x: 1}}}, print: x}"),
    ("statements", 4, "limit-statements", "doc: {for: {iterator: i, range: 3}}"),
    ("xml-depth", 4, "limit-xml-depth", "doc: {a: {b: {c: }}}"),
    ("output", 46, "limit-output", "doc: {a: 1}"),
    ("printed", 5, "limit-printed", "doc: {print: four}"),
    ("text", 6, "limit-text", "doc: {a: $('x' * 6)}"),
    ("text", 6, "limit-text", "doc: {a: {b: $('x' * 6)}}"),
    ("sequence", 3, "limit-sequence", "doc: {a: '$([1, 2, 3])'}"),
    ("integer", 80, "limit-integer", "doc: {a: $(2 ** 79)}"),
    ("integer", 80, "limit-integer", "doc: {a: $(1 << 79)}"),
]  # fmt: skip
SAFE_ONLY = [
    ("characters", 5, "limit-characters", "doc: {a: $(1 + 2)}"),
    ("brackets", 2, "limit-brackets", "doc: {a: $(((1)))}"),
    ("nodes", 5, "limit-nodes", "doc: {a: $(1 + 2)}"),
    ("depth", 3, "limit-depth", "doc: {a: $(1 + 2)}"),
    ("calls", 2, "limit-calls", "doc: {a: '$((lambda: (lambda: 1)())())'}"),
    ("width", 5, "limit-width", "doc: {a: \"$(f'{1:5}')\"}"),
]


def test_every_limit_is_tried() -> None:
    tried = {name for name, *_ in EVERYWHERE + SAFE_ONLY}
    assert tried | {"memory", "steps"} == set(limit_names())


def codes_of(tmp_path: Path, text: str, mode: str, limits: dict[str, int]) -> list[str]:
    path = tmp_path / "robot.yaml"
    path.write_text(text)
    (tmp_path / "one.yaml").write_text("b: 1\n")
    try:
        build(path, policy=Policy(mode, limits=limits))
    except YamaroError as error:
        return [fault.code for fault in error.diagnostics]
    return []


@pytest.mark.parametrize("mode", [TRUSTED, JAIL, SAFE])
@pytest.mark.parametrize(("name", "lowest", "code", "text"), EVERYWHERE)
def test_a_limit_is_exact(
    tmp_path: Path, mode: str, name: str, lowest: int, code: str, text: str
) -> None:
    assert codes_of(tmp_path, text, mode, {name: lowest}) == []
    assert codes_of(tmp_path, text, mode, {name: lowest - 1}) == [code]


@pytest.mark.parametrize(("name", "lowest", "code", "text"), SAFE_ONLY)
def test_a_limit_of_safe_mode_is_exact(
    tmp_path: Path, name: str, lowest: int, code: str, text: str
) -> None:
    assert codes_of(tmp_path, text, SAFE, {name: lowest}) == []
    assert codes_of(tmp_path, text, SAFE, {name: lowest - 1}) == [code]
