"""The table of losses: a row for each field of the schema, and the formats do what it says."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from tests.consumers import oracles
from tests.model import full_robot
from tests.model.full_robot import ROWS as VALUES
from tests.model.full_robot import changed
from tests.model.test_schema import folder as folder
from yamaro import Build, build
from yamaro.model.schema import ELEMENTS, SENSORS, WORDS
from yamaro.targets.holding import FORMATS, ROWS, Missing, cell, lost_fields


@cache
def built(folder: Path, row: tuple[str, str] | None, formats: tuple[str, ...]) -> dict[str, Build]:
    """Return the full robot in some formats, with the value of a row changed."""
    path = folder / "full.yaml"
    path.write_text(full_robot.text({} if row is None else {row: changed(row)}))
    return build(path, target=list(formats), allow=["lost-in-urdf"]).outputs


def test_each_field_of_the_schema_has_a_row_and_each_row_a_field() -> None:
    fields = {
        f"{thing.name}.{name}"
        for thing in (*ELEMENTS.values(), *WORDS.values(), *SENSORS.values())
        for name in thing.fields
    }
    assert set(ROWS) == fields


def test_what_is_lost_whatever_it_is_is_found_by_thing() -> None:
    assert list(lost_fields("mjcf", "limit")) == [
        *("velocity", "acceleration", "deceleration", "jerk"),
    ]
    assert lost_fields("sdf", "limit").keys() == {"deceleration", "jerk"}
    assert not lost_fields("urdf", "limit")


@pytest.mark.slow  # of the values in words, test_each_value.py sees any that is lost in silence
@pytest.mark.parametrize("row", VALUES, ids=".".join)
def test_formats_do_with_a_value_what_its_row_says(folder: Path, row: tuple[str, str]) -> None:
    oracles.require_module("pxr")
    cells = {format: cell(format, *row) for format in FORMATS}
    holding = tuple(format for format, own in cells.items() if not isinstance(own, Missing))
    whole = built(folder, None, FORMATS)
    other = built(folder, row, holding) if holding else {}
    for format, own in cells.items():
        if not isinstance(own, Missing):
            documents = [b"".join(each[format].encoded()) for each in (whole, other)]
            is_held = documents[0] != documents[1] or whole[format].assets != other[format].assets
            assert is_held, f"{format} does not hold it"
        elif not own.is_conditional and (row[0], format) != ("loop", "urdf"):
            # A loop is reported before URDF is written.
            told = {(loss.kind, loss.what) for loss in whole[format].losses}
            assert (own.kind, own.what) in told, f"{format} does not report it"
