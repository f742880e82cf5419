"""Migrates a robot in xacro, and compares what its sources make with what xacro makes."""

from __future__ import annotations

from pathlib import Path

from tests.migrate.test_xacro_migration import hold_for, migrated


def migrated_for(folder: Path, text: str, *values: str) -> str:
    """Return the source of a robot, which makes what xacro makes for each value of `n`."""
    made = migrated(folder, text)["r.yaml"]
    given = [[f"n:={value}"] if value else [] for value in values or ("",)]
    assert hold_for(folder, *given) == []
    return made


def model_of(made: str) -> list[str]:
    """Return the lines of a source that make the robot."""
    return made.partition("model:\n")[2].splitlines()
