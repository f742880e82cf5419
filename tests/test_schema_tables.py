"""The tables of values in the docs are those of the schema, the units and the table of losses."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

from yamaro.model.schema import ELEMENTS, RECORDS, SENSORS, WORDS

REPOSITORY = Path(__file__).parents[1]
DOCS = REPOSITORY / "docs"


@pytest.fixture(scope="module")
def script() -> ModuleType:
    path = REPOSITORY / "scripts" / "schema_tables.py"
    spec = importlib.util.spec_from_file_location("schema_tables", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_tables_are_up_to_date(script: ModuleType) -> None:
    stale = [str(p) for p, text in script.written().items() if p.read_text("utf-8") != text]
    assert not stale, f"run python scripts/schema_tables.py for {stale}"


def test_each_table_is_in_a_page(script: ModuleType) -> None:
    pages = [path.read_text(encoding="utf-8") for path in DOCS.glob("*.md")]
    marks = {name for page in pages for name in script.BLOCKS.names(page)}
    assert marks == set(script.TABLES)
    assert all(page.count("<!-- schema: ") == page.count("<!-- end of schema") for page in pages)


def test_an_empty_table_is_filled_and_what_is_after_it_stays(script: ModuleType) -> None:
    empty, end = "<!-- schema: units -->\n", "<!-- end of schema -->"
    page = f"{empty}{end}\n\nBetween.\n\n{empty}\n{end}\nAfter.\n"
    filled = f"{empty}\n{script.units()}\n{end}"
    assert script.BLOCKS.fill(page) == f"{filled}\n\nBetween.\n\n{filled}\nAfter.\n"


@pytest.mark.parametrize("page", ["language.md", "cheat-sheet.md"])
def test_each_entry_of_a_word_is_in_a_table(page: str, script: ModuleType) -> None:
    text = (DOCS / page).read_text(encoding="utf-8")
    words = set(re.findall(r"`(\w+)`", "\n".join(re.findall(r"^\|.*", text, re.MULTILINE))))
    left_out = script.OF_ROS_1 if page == "cheat-sheet.md" else ()
    of_joint = [ELEMENTS[name] for name in RECORDS[1:] if name not in left_out]
    things = [*WORDS.values(), *SENSORS.values(), *of_joint]
    assert not {name for thing in things for name in thing.fields} - words


def test_the_api_has_the_values_of_all_sensors() -> None:
    text = (DOCS / "api.md").read_text(encoding="utf-8")
    fields = {name for thing in SENSORS.values() for name in thing.fields}
    assert not {name for name in fields if f"`{name}`" not in text}
