"""`yamaro fmt`: one style, in which every file means what it meant before."""

from __future__ import annotations

import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.fenced import read_blocks
from tests.golden import areas, case_id, find_cases, read_options
from tests.waiting import PATIENCE
from yamaro.api import build
from yamaro.diagnostics import Reporter, YamaroError
from yamaro.files.loader import decode
from yamaro.layout import Layout, LayoutFault, formatted
from yamaro.policy import Policy
from yamaro.source import Source
from yamaro.yaml.comments import find_comments
from yamaro.yaml.nodes import MappingNode, ScalarNode, SequenceNode
from yamaro.yaml.reader import Reading, read_on

REPOSITORY = Path(__file__).parents[1]
EXAMPLES = sorted((REPOSITORY / "examples").rglob("*.yaml"))
DOCUMENTS = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").glob("*.md"))]
DOCUMENTS.remove(REPOSITORY / "docs" / "format.md")  # it shows what is not in this style


def laid_out(text: str) -> str:
    """Return a text formatted, after it was made sure that all in it is as before."""
    source = Source(text, name="robot.yaml")
    new = formatted(source)
    result = Source(new, name="robot.yaml")
    assert formatted(result) == new, "a second time changes nothing"
    before, after = reading(source), reading(result)
    assert not after.errors
    assert shape(after.root) == shape(before.root)
    assert comments(result, after) == comments(source, before)
    for line in new.splitlines():
        assert line == line.rstrip() or is_in_a_scalar(line, after.root), repr(line)
    return new


def reading(source: Source) -> Reading:
    return read_on(source, reporter=Reporter())


def shape(node: Any) -> Any:
    """Return all that is written in a node: keys in order, text and style of scalars."""
    if isinstance(node, ScalarNode):
        return node.text, node.style, node.anchor
    if isinstance(node, SequenceNode):
        return node.is_flow, [shape(item) for item in node.items]
    assert isinstance(node, MappingNode)
    return node.is_flow, [(shape(key), shape(value)) for key, value in node.pairs]


def comments(source: Source, read: Reading) -> list[str]:
    return [comment.text.rstrip() for comment in find_comments(source, read.text)]


def is_in_a_scalar(line: str, node: Any) -> bool:
    """Return whether a line that ends in white space is of a text that has it, or of a comment."""
    if isinstance(node, ScalarNode):
        return line.strip() in node.text or line.rstrip().endswith("\\")
    children = (
        node.items if isinstance(node, SequenceNode) else [c for pair in node.pairs for c in pair]
    )
    return any(is_in_a_scalar(line, child) for child in children)


def source_of(path: Path) -> Source | None:
    """Return a file that is YAML, or None."""
    try:
        source = decode(path.read_bytes(), name=path.name, path=str(path))
        formatted(source)
    except YamaroError:
        return None
    return source


# --- files that there are -------------------------------------------------------------------------


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_the_examples_are_in_this_style(path: Path) -> None:
    assert laid_out(path.read_text(encoding="utf-8")) == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_what_the_documents_show_is_in_this_style(path: Path) -> None:
    for block in read_blocks(path.read_text(encoding="utf-8")):
        if block.language != "yaml" or "error" in block.words or "not-run" in block.words:
            continue
        if "color: #" in block.text:  # shown because it is a mistake
            continue
        try:
            new = laid_out(block.text)
        except YamaroError:
            continue
        assert new.rstrip("\n") == block.text.rstrip("\n"), f"{path.name}:{block.line}"


def build_of(case: Path, text: str) -> tuple[str, list[str]]:
    """Return the XML of a case with another text, and the codes that are reported."""
    options = read_options(case)
    words = shlex.split(options.get("args", ""))
    try:
        made = build(
            str(case),
            text=text,
            policy=Policy("safe") if "--safe" in words else None,
            command_line=[word for word in words if ":=" in word],
            on_message=lambda line: None,
        )
        return made.xml(), [warning.code for warning in made.warnings]
    except YamaroError as error:
        return "", [diagnostic.code for diagnostic in error.diagnostics]


@pytest.mark.parametrize("cases", areas(find_cases()).values(), ids=areas(find_cases()))
def test_cases_mean_the_same_afterwards(cases: list[Path], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(cases[0].parent)
    for case in cases:
        source = source_of(case)
        if source is None:
            continue
        new = laid_out(source.text)
        words = read_options(case).get("args", "")
        if new != source.text and "limit" not in words:
            assert build_of(case, new) == build_of(case, source.text), case_id(case)


# --- the style ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:   1\nb :\n    c: 2\n", "a: 1\nb:\n  c: 2\n"),
        ("a:\n    - 1\n    -   2\n", "a:\n- 1\n- 2\n"),
        ("a:\n- b:\n      - 1\n", "a:\n- b:\n  - 1\n"),
        ("- a: 1\n  b: 2\n-   c: 3\n    d: 4\n", "- a: 1\n  b: 2\n- c: 3\n  d: 4\n"),
        ("a:\n  -\n    b: 1\n    c: 2\n", "a:\n- b: 1\n  c: 2\n"),
        ("a:\n-   - 1\n    - 2\n", "a:\n- - 1\n  - 2\n"),
        ("a:\n  -\n  - 1\n", "a:\n-\n- 1\n"),
        ("a: [ 1,2 , {b: 3,c  : 4} ]\n", "a: [1, 2, {b: 3, c: 4}]\n"),
        ("a: { }\nb: [ ]\n", "a: {}\nb: []\n"),
        ("a: {b: , c: }\n", "a: {b: , c: }\n"),
        ("a: {'b':1, c}\n", "a: {'b': 1, c}\n"),
        ("a:\n  1\nb:\n      [1,2]\n", "a:\n  1\nb:\n  [1, 2]\n"),
        ("part:\n  name: a\npart:\n  name: b\n", "part:\n  name: a\npart:\n  name: b\n"),
        ("a: 0.10\nb: 1e-3\nc: 0x1F\nd: '1'\n", "a: 0.10\nb: 1e-3\nc: 0x1F\nd: '1'\n"),
        ("if a  > 1:\n    b: $( 1+2 )\n", "if a  > 1:\n  b: $( 1+2 )\n"),
        ("a: &x\n    b: 1\nc: *x\n", "a: &x\n  b: 1\nc: *x\n"),
        ("? a\n:   b\n", "? a\n: b\n"),
        ("*x :  1\n", None),
        ("a: 1", "a: 1\n"),
        ("\n\n\na: 1\n\n\n\nb: 2\n\n\n", "a: 1\n\nb: 2\n"),
        ("a:\n\n  b: 1\n", "a:\n  b: 1\n"),
        ("a:\n\n- b\n", "a:\n- b\n"),
        ("a:\n\nb: 1\n", "a:\n\nb: 1\n"),
        ("- a:\n\n- b\n", "- a:\n\n- b\n"),
        ("---\na:   1\n", "---\na: 1\n"),
        ("a: {b: 1,\n  c: 2}\n", "a: {b: 1,\n    c: 2}\n"),
        ("a: [\n1,\n     2\n]\n", "a: [\n    1,\n    2\n  ]\n"),
        ("- [\n1,\n     2]\n", "- [\n    1,\n    2]\n"),
    ],
)
def test_white_space_is_in_one_style(text: str, expected: str | None) -> None:
    if expected is None:
        with pytest.raises(YamaroError):
            formatted(Source(text, name="robot.yaml"))
    else:
        assert laid_out(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a: 1 # x\n", "a: 1  # x\n"),
        ("a: 1     # x\n", "a: 1     # x\n"),
        ("a: 1\t# x\n", "a: 1  # x\n"),
        ("a: # x\n  b: 1\n", "a:  # x\n  b: 1\n"),
        ("-  # x\n  a: 1\n", "-  # x\n  a: 1\n"),
        ("a:\n# x\n    b: 1\n", "a:\n  # x\n  b: 1\n"),
        ("a:\n  # x\n- b\n", "a:\n# x\n- b\n"),
        ("a:\n    b: 1\n    # in a\nc: 2\n", "a:\n  b: 1\n  # in a\nc: 2\n"),
        ("a:\n    b: 1\n# of c\nc: 2\n", "a:\n  b: 1\n# of c\nc: 2\n"),
        ("a:\n  # todo\nb: 1\n", "a:\n  # todo\nb: 1\n"),
        ("a:\n    b: 1\n    # end\n", "a:\n  b: 1\n  # end\n"),
        ("# x   \n\n\n#y\na: 1\n", "# x\n\n#y\na: 1\n"),
        ("a:\n\n  # x\n\n  b: 1\n", "a:\n  # x\n\n  b: 1\n"),
        ("a: [1, # x\n# y\n2]\n", "a: [1,  # x\n    # y\n    2]\n"),
        ("a: |   # x\n    b\n", "a: |  # x\n  b\n"),
        ("a: |\n    b\n   # x\nc: 1\n", "a: |\n  b\n# x\nc: 1\n"),
        ("#!shebang\n# yaml-language-server: x\na: 1\n", None),
    ],
)
def test_comments_go_with_what_they_are_about(text: str, expected: str | None) -> None:
    assert laid_out(text) == (text if expected is None else expected)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a: |\n      b\n        c\n\n      d\n", "a: |\n  b\n    c\n\n  d\n"),
        ("a: |2\n      b\n    c\n", "a: |2\n      b\n    c\n"),
        ("a:\n    b: |1\n       c\n", "a:\n  b: |1\n     c\n"),
        ("a: |\n  b\n\n\n\nc: 1\n", "a: |\n  b\n\nc: 1\n"),
        ("a: |+\n    b\n\n\nc: 1\n", "a: |+\n  b\n\n\nc: 1\n"),
        ("a: |\n  b", "a: |\n  b"),  # a line break at the end would be one of the text
        ("a: |-\n  b", "a: |-\n  b\n"),
        ("a: >-\n     b\n     c\n", "a: >-\n  b\n  c\n"),
        ("- |\n      b\n", "- |\n  b\n"),
        ("a: |\n    b  \n", "a: |\n  b  \n"),
        ("a: b\n c\n", "a: b\n  c\n"),
        ("a:\n    b: c  \n      d\n       e\n", "a:\n  b: c\n    d\n     e\n"),
        ('a: "b\\\n   c"\n', 'a: "b\\\n   c"\n'),
        ('a: "b\n\n  c"\n', 'a: "b\n\n  c"\n'),
    ],
)
def test_texts_of_several_lines_move_as_a_whole(text: str, expected: str) -> None:
    assert laid_out(text) == expected


def test_the_line_ends_of_a_file_stay() -> None:
    new = formatted(Source("a:   1\r\nb: |\r\n    c\r\n", name="robot.yaml"))
    assert new == "a: 1\r\nb: |\r\n  c\r\n"


@pytest.mark.parametrize(
    "text", ["a: [1\n", "a: b: c\n", "a: *x\n", "", "# a\n", "a\n", "a\0: 1\n"]
)
def test_what_is_not_yaml_is_refused(text: str) -> None:
    with pytest.raises(YamaroError):
        formatted(Source(text, name="robot.yaml"))


@pytest.mark.parametrize(("text", "wrong"), [("a: 1\n", "a: 12\n"), ("a: b c\n", "a: b  c\n")])
def test_a_fault_of_the_formatter_is_found(
    text: str, wrong: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Layout, "run", lambda self: wrong)
    with pytest.raises(LayoutFault):
        formatted(Source(text, name="robot.yaml"))


# --- any file -------------------------------------------------------------------------------------

SEEDS = [
    *[path.read_text(encoding="utf-8") for path in EXAMPLES],
    "a:\n  - - 1\n    - b: |+\n        x\n\n  # c\n  - 'd\n    e'\n# f\ng: {h: [1, {i}]}\n",
    "a: &x\n- 1\nb: *x\nc: >-\n  d\n\n  e\nf: $(1 +\n  2)\n? g\n: h\n",
]
PIECES = [
    " ", "  ", "\n", "\n\n", " # c\n", "\n  # own\n", "\t", "- ", "a: ", "[", "]", "{", "}", ", ",
    "|\n", ">-\n", '"', "'", ": ", "\n- ", "\n  ", "\r\n", "&x ", "*x", "? ", "|+\n   ", "|1\n",
    "\x85", "\u2028", "$(", "\\",
]  # fmt: skip


@st.composite
def changed_texts(draw: st.DrawFn) -> str:
    """Return some lines of a seed with a few changes."""
    lines = draw(st.sampled_from(SEEDS)).splitlines(keepends=True)
    start = draw(st.integers(0, len(lines) - 1))
    text = "".join(lines[start : start + draw(st.integers(1, 30))])
    for _ in range(draw(st.integers(0, 4))):
        at = draw(st.integers(0, len(text)))
        cut = draw(st.integers(0, 3))
        text = text[:at] + draw(st.sampled_from(["", *PIECES])) + text[at + cut :]
    return text


@settings(max_examples=examples(1500))
@given(changed_texts())
def test_any_file_is_laid_out_or_refused(text: str) -> None:
    try:
        laid_out(text)
    except YamaroError:
        return


@st.composite
def written_files(draw: st.DrawFn) -> str:
    """Return a file of repeated keys, lists, comments and blank lines in some layout."""
    names = st.sampled_from(["part", "joint/name=a, type=b", "if a > 1", "Leg(side)", "'b c'"])
    texts = ["1", "0.10", "'x'", '"y"', "$(a + 1)", "{a: 1,b: [c,d]}", "[ ]"]
    leaves = st.sampled_from([*texts, "|\n{0}    z\n\n{0}   # y"])
    remarks = st.sampled_from(["", "", "", " # r", "   # s"])
    between = st.sampled_from(["", "", "\n", "{0}# own\n", "\n\n# other\n"])

    def body(indent: str, depth: int) -> str:
        text = ""
        is_list = draw(st.booleans())
        for _ in range(draw(st.integers(1, 3))):
            text += draw(between).replace("{0}", indent)
            head = indent + ("- " if is_list else "")
            inner = indent + " " * (draw(st.integers(1, 4)) + (2 if is_list else 0))
            if depth and draw(st.booleans()):
                text += f"{head}{draw(names)}:{draw(remarks)}\n" + body(inner, depth - 1)
            else:
                leaf = draw(leaves).replace("{0}", inner)
                remark = "" if "|" in leaf else draw(remarks)
                text += f"{head}{draw(names)}:  {leaf}{remark}\n"
        return text

    return body("", 3)


@settings(max_examples=examples(300))
@given(written_files())
def test_files_in_any_layout_come_out_in_one(text: str) -> None:
    try:
        new = laid_out(text)
    except YamaroError:  # such as a list beside the keys of a mapping
        return
    assert "\n\n\n" not in new or "|" in new
    for line in new.splitlines():
        assert (len(line) - len(line.lstrip())) % 2 == 0 or "|" in new, line


def test_the_parser_in_python_lays_out_alike() -> None:
    code = (
        "import sys; sys.modules['yaml._yaml'] = None; import yaml\n"
        "from yamaro.source import Source\n"
        "from yamaro.layout import formatted\n"
        "for path in sys.argv[1:]:\n"
        "    text = open(path, encoding='utf-8').read()\n"
        "    assert formatted(Source(text, name=path)) == text, path\n"
    )
    result = subprocess.run(
        [sys.executable, "-c", code, *map(str, EXAMPLES)],
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    assert result.returncode == 0, result.stderr.decode()
