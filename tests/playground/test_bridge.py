"""What the playground's worker asks of Yamaro, on CPython."""

from __future__ import annotations

import json
import os
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import yamaro

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "web" / "playground"))
import bridge  # noqa: E402
import pack  # noqa: E402

from tests.test_links import anchors  # noqa: E402

ROBOT = "robot: r\nmodel:\n- link/name=base:\n"


@pytest.fixture
def playground(tmp_path: Path) -> Iterator[bridge.Playground]:
    before = Path.cwd()
    yield bridge.Playground(str(tmp_path / "robot"))
    os.chdir(before)


def build(playground: bridge.Playground, text: str, *, is_trusted: bool = True) -> Any:
    playground.open({"r.yaml": text}, "r.yaml", is_trusted=is_trusted)
    return json.loads(playground.build())


def test_a_robot_is_what_the_viewer_of_yamaro_view_shows(playground: bridge.Playground) -> None:
    told = build(playground, ROBOT)
    assert told["diagnostics"] == []
    assert '<link name="base"/>' in told["state"]["robot"]["urdf"]
    assert told["state"]["robot"]["places"] == ["r.yaml:3:3"]


def test_places_are_counted_as_javascript_counts(playground: bridge.Playground) -> None:
    text = "# 😀 é\nrobot: r\nmodel:\n- link/name=😀$(lenght):\n"
    (told,) = build(playground, text)["diagnostics"]
    units = text.encode("utf-16-le")
    assert units[2 * told["from"] : 2 * told["to"]].decode("utf-16-le") == "lenght"
    assert (told["file"], told["severity"], told["code"]) == ("r.yaml", "error", "undefined-name")


def test_a_code_leads_to_the_heading_of_the_site_beside_the_playground(
    playground: bridge.Playground,
) -> None:
    shape = "    visual:\n      geometry:\n        capsule/radius=0.1, length=1:\n"
    (told,) = build(playground, f"{ROBOT}{shape}")["diagnostics"]
    assert told["code"] == "capsule-needs-urdf-1.1"
    assert told["page"] == "../diagnostics.html#capsule-needs-urdf-11"
    assert "capsule-needs-urdf-11" in anchors(ROOT / "docs" / "diagnostics.md")


def test_a_fix_says_what_to_write_where(playground: bridge.Playground) -> None:
    text = "robot: r\nvariables: {width: 1}\nmodel:\n- link/name=$(widht):\n"
    (told,) = build(playground, text)["diagnostics"]
    (edit,) = told["fix"]["edits"]
    assert text[: edit["from"]] + edit["insert"] + text[edit["to"] :] == text.replace(
        "widht", "width"
    )


def test_what_came_with_a_link_runs_in_safe_mode_until_it_is_trusted(
    playground: bridge.Playground,
) -> None:
    text = f"import: [subprocess]\n{ROBOT}"
    refused = build(playground, text, is_trusted=False)
    assert refused["isUnsafe"]
    assert refused["diagnostics"][0]["code"] == "unsafe-code"
    assert not build(playground, text)["isUnsafe"]


@pytest.mark.parametrize("name", ["arm", "hexapod", "quadruped"])
def test_an_example_that_is_not_trusted_is_shown(name: str, playground: bridge.Playground) -> None:
    """On this Python it is built in a jail, where there is one."""
    files = {
        path.name: path.read_text(encoding="utf-8")
        for path in (ROOT / "examples" / name).glob("*.yaml")
    }
    playground.open(files, f"{name}.yaml", is_trusted=False)
    told = json.loads(playground.build())
    assert (told["fault"], told["isUnsafe"]) == ("", False)
    assert "<joint" in told["state"]["robot"]["urdf"]


def test_what_is_printed_is_shown(playground: bridge.Playground) -> None:
    assert build(playground, f"{ROBOT}process: print('hello')\n")["printed"] == "hello"


def test_a_document_may_have_any_root_and_a_robot_any_format(
    playground: bridge.Playground,
) -> None:
    told = build(playground, "sdf/version=1.9:\n  world/name=w:\n")
    assert "the page shows robots" in told["fault"]
    assert '<sdf version="1.9">' in json.loads(playground.write("xml"))["text"]
    assert json.loads(playground.write("mjcf"))["diagnostics"][0]["code"] == "not-urdf"
    build(playground, ROBOT)
    written = json.loads(playground.write("mjcf"))
    assert "<mujoco" in written["text"]
    assert written["name"] == "r.xml"


def test_the_viewer_sets_variables_and_opens_places(playground: bridge.Playground) -> None:
    text = "robot: r\nvariables: {width: 1}\nmodel:\n- link/name=a$(width):\n"
    state = build(playground, text)["state"]
    assert playground.act("variables", '{"width": 2}') == "{}"
    assert '"a2"' in json.loads(playground.build())["state"]["robot"]["urdf"]
    assert "fault" in json.loads(playground.act("variables", '{"width": "x"}'))
    place = json.dumps({"place": 0, "version": state["robotVersion"] + 1})
    found = json.loads(playground.act("open", place))
    assert found == {"file": "r.yaml", "line": 4, "column": 3}
    found = json.loads(playground.act("open", '{"variable": "width"}'))
    assert (found["file"], found["line"]) == ("r.yaml", 2)


def test_a_download_is_fetched_by_its_key(playground: bridge.Playground) -> None:
    build(playground, ROBOT)
    told = json.loads(playground.act("download", '{"format": "urdf"}'))
    content = playground.fetch(told["key"])
    assert content is not None
    assert b'<robot name="r">' in content
    assert playground.fetch("another") is None


def test_files_stay_in_their_folder(playground: bridge.Playground, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="lies in its folder"):
        playground.open({"../out.yaml": ROBOT}, "../out.yaml", is_trusted=True)
    assert not (tmp_path / "out.yaml").exists()


def test_all_examples_are_packed_with_all_their_files(tmp_path: Path) -> None:
    pack.main(tmp_path)
    examples = json.loads((tmp_path / "examples.json").read_text(encoding="utf-8"))
    folders = {path.name for path in (ROOT / "examples").iterdir() if path.is_dir()}
    assert {one["name"] for one in examples} == {*folders, "ur5e"}
    for one in examples:
        for name, text in one["files"].items():
            folder = ROOT / "examples" if "/" in name else pack.folder_of(one["name"])
            assert (folder / name).read_text(encoding="utf-8") == text
        assert next(iter(one["files"])) == one["main"]
    assert '"hexapod"' in examples[0]["state"]["robot"]["urdf"]
    names = zipfile.ZipFile(tmp_path / "yamaro.zip").namelist()
    assert {"bridge.py", "yamaro/__init__.py", "yaml/__init__.py"} <= set(names)
    assert not [name for name in names if name.endswith((".so", ".pyc"))]


@pytest.mark.parametrize("is_trusted", [True, False])
@pytest.mark.parametrize("name", ["dual_arm_cell", "mobile_manipulator"])
def test_examples_with_files_of_another_one_are_built(
    playground: bridge.Playground, name: str, is_trusted: bool
) -> None:
    example = pack.read_example(name, "", f"{name}.yaml")
    files: dict[str, str] = example["files"]  # type: ignore[assignment]
    assert {path.split("/")[0] for path in files} == {name, "arm"}
    playground.open(files, str(example["main"]), is_trusted=is_trusted)
    expected = yamaro.convert(ROOT / "examples" / name / f"{name}.yaml")
    assert json.loads(playground.write("xml"))["text"] == expected
