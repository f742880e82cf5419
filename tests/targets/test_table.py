"""The table of targets: whatever lists the output formats lists those in it."""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path

import pytest

from yamaro.codes import LOSSES
from yamaro.syntax.names import RAW_BLOCKS
from yamaro.targets.holding import FORMATS
from yamaro.targets.table import TARGETS

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("name", TARGETS)
def test_each_target_is_a_package_with_a_writer(name: str) -> None:
    if name == "usd":
        pytest.importorskip("pxr")
    assert callable(import_module(f"yamaro.targets.{name}.writer").write)


def test_each_folder_of_targets_is_in_the_table() -> None:
    folders = {path.parent.name for path in (ROOT / "src/yamaro/targets").glob("*/writer.py")}
    assert folders == set(TARGETS)


@pytest.mark.parametrize(
    ("page", "row"),
    [
        ("docs/cli.md", r"^\| `--to FORMATS` \|.*?outputs\.md\): (.*?), separated"),
        ("docs/api.md", r'^\| `target="mjcf"` \|.*?outputs\.md\): (.*?), or a list'),
        ("docs/cmake.md", r"^\| `TO` \|.*?outputs\.md\): (.*?) \|$"),
        ("docs/cheat-sheet.md", r"^\| `yamaro r\.yaml --to mjcf -o r\.xml` \| (.*?) \|$"),
    ],
)
def test_the_docs_list_the_targets(page: str, row: str) -> None:
    found = re.search(row, (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE)
    assert found is not None
    assert re.findall(r"`\"?(\w+)\"?`", found[1]) == list(TARGETS)


def test_the_page_of_output_formats_says_what_their_files_are_called() -> None:
    page = (ROOT / "docs/outputs.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \|.*\| `NAME(\S+)`", page, re.MULTILINE)
    assert dict(rows) == {each.name: each.ending for each in TARGETS.values()}


def test_blocks_and_losses_are_of_targets() -> None:
    assert set(RAW_BLOCKS) <= set(TARGETS)
    assert {code.partition("-in-")[2] for code in LOSSES} <= set(TARGETS)
    assert {f"lost-in-{format}" for format in FORMATS} <= LOSSES


def test_a_target_belongs_to_another_or_to_itself() -> None:
    assert {each.run for each in TARGETS.values()} <= set(TARGETS)
    assert all(TARGETS[each.run].run == each.run for each in TARGETS.values())


def test_files_beside_a_document_are_those_of_its_format() -> None:
    assert TARGETS["mjcf"].may_hold("scene.xml")
    assert TARGETS["mjcf"].may_hold("assets/arm-12.stl")
    assert not TARGETS["sdf"].may_hold("scene.xml")
    assert not TARGETS["mjcf"].may_hold("../scene.xml")
