"""A robot's statements and sections reach lowering as they were written, and are XML elsewhere."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import yamaro
from yamaro.robot import part
from yamaro.xml.tree import Element, Text

if TYPE_CHECKING:
    from yamaro.robot.lowering import Lowering
    from yamaro.xml.tree import Node, RobotWord


def shape(element: Element) -> object:
    """Return an element as nested lists: its name, then its children or its value."""
    inside: list[object] = []
    for child in element.children:
        if isinstance(child, Element):
            inside.append(shape(child))
        else:
            assert isinstance(child, Text)
            inside.append(child.value)
    return [element.name, *inside]


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def words_of(monkeypatch: pytest.MonkeyPatch, **files: str) -> tuple[list[object], str]:
    """Return the words that reach lowering, and the XML without them."""
    found: list[object] = []

    def keep(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
        found.append(shape(word))

    monkeypatch.setattr(part, "lower_word", keep)
    for name, text in files.items():
        Path(f"{name}.yaml").write_text(text, encoding="utf-8")
    return found, yamaro.build("main.yaml", allow=["no-link"]).xml()


def test_a_statement_holds_its_keys_as_written_and_its_body(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found, _ = words_of(
        monkeypatch,
        main="model:\n- mirror:\n    rename: {Left: Right, if: no}\n    body: {part: {name: x}}\n",
    )
    assert found == [
        ["mirror", ["rename", ["Left", "Right"], ["if", "no"]], ["body", ["part", ["name", "x"]]]]
    ]


def test_a_file_is_attached_with_what_is_passed_and_its_sections(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found, _ = words_of(
        monkeypatch,
        main="model:\n- attach: {path: hand.yaml, to: tool, width: $(1 + 1)}\n",
        hand="variables: {width: 1}\nstates: {home: {Finger: $(width)}}\n"
        "model: {part: {name: palm_$(width)}}\n",
    )
    assert found == [
        [
            "attach",
            ["to", "tool"],
            ["body", ["part", ["name", "palm_2"]], ["states", ["home", ["Finger", 2]]]],
        ]
    ]


def test_a_section_may_hold_several(monkeypatch: pytest.MonkeyPatch) -> None:
    found, _ = words_of(
        monkeypatch, main="robot: r\ncontrol: [{name: a}, {name: b, params: [{x: 1}, [2, 3]]}]\n"
    )
    assert found == [
        ["control", ["name", "a"]],
        ["control", ["name", "b"], ["params", ["-", ["x", "1"]], ["-", ["2", "3"]]]],
    ]


MIXED = "{mirror: {body: {b: 2}}, attach: {path: x}, loop: [{a: 1}]}"


@pytest.mark.parametrize(
    "text",
    [
        f"model: {{gazebo: {MIXED}}}\n",
        f"robot/name=r: {{gazebo: {MIXED}}}\n",
        f"robot: r\nfunctions: {{F: {{body: {MIXED}}}}}\nmodel: {{gazebo: {{F: }}}}\n",
    ],
)
def test_below_an_element_all_is_xml(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found, xml = words_of(monkeypatch, main=text)
    assert found == []
    expected = "<gazebo><mirror><body><b>2</b></body></mirror><attach><path>x</path></attach>"
    assert expected + "<loop><a>1</a></loop></gazebo>" in "".join(xml.split("\n")).replace("  ", "")


@pytest.mark.parametrize("root", ["loop", "control", "states", "mirror"])
def test_the_only_root_key_is_the_root_element(root: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found, xml = words_of(monkeypatch, main=f"{root}: {{a: 1}}\n")
    assert found == []
    assert f"<{root}>\n  <a>1</a>\n</{root}>" in xml


def test_the_only_root_key_of_an_included_file_is_a_section(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found, _ = words_of(
        monkeypatch,
        main="model: {include: all.yaml}\n",
        all="variables: {x: 1}\nstates: {home: {a: $(x)}}\n",
    )
    assert found == [["states", ["home", ["a", 1]]]]


def test_a_root_that_is_no_robot_has_elements(monkeypatch: pytest.MonkeyPatch) -> None:
    found, xml = words_of(monkeypatch, main="sdf: {attach: {path: x}}\n")
    assert found == []
    assert "<path>x</path>" in xml


def test_a_body_of_attach_is_a_context_of_its_own() -> None:
    text = """
    model:
    - variables: {x: 1}
    - attach:
        to: base
        body:
        - variables: {x: 2, y/parent: 3}
    - print: $(x) $(y)
    """
    Path("main.yaml").write_text(text, encoding="utf-8")
    said: list[str] = []
    with pytest.raises(yamaro.YamaroError):
        yamaro.build("main.yaml", on_message=said.append)
    assert said == ["1 3"]
