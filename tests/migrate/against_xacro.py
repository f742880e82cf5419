"""Migrates a robot in xacro, and compares what its sources make with what xacro makes."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.migrate.same_robot import is_same_robot
from tests.migrate.test_xacro_migration import migrated
from yamaro import build


def migrated_for(folder: Path, text: str, *values: str) -> str:
    """Return the source of a robot, which makes what xacro makes for each value of `n`."""
    xacro = pytest.importorskip("xacro")
    made = migrated(folder, text)["r.yaml"]
    (folder / "r.yaml").write_text(made)
    warnings: list[str] = []
    for value in values or ("",):
        mappings = {"n": value} if value else {}
        given = [f"{name}:={text}" for name, text in mappings.items()]
        expected = xacro.process_file(str(folder / "r.urdf.xacro"), mappings=mappings).toxml()
        built = build(folder / "r.yaml", command_line=given, on_message=warnings.append)
        assert is_same_robot(expected.encode(), built.xml().encode()), (value, made)
    assert warnings == []
    return made


def model_of(made: str) -> list[str]:
    """Return the lines of a source that make the robot."""
    return made.partition("model:\n")[2].splitlines()
