"""Migrates a robot in xacro, and compares what its sources make with what xacro makes."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.same_robot import is_same_robot
from tests.tools.migrate.migrating import assert_in_style
from tests.tools.migrate.test_xacro_migration import HEAD, hold_for, migrated
from yamaro import build
from yamaro.policy import Limits
from yamaro.tools.migrate.urdf import build_allowing
from yamaro.tools.migrate.xacro.command import (
    DiskHost,
    XacroMigration,
    expanded_by_xacro,
    migrate_robot,
)
from yamaro.xml.reader import decode_xml
from yamaro.xml.writer import write


def migrated_for(folder: Path, text: str, *values: str) -> str:
    """Return the source of a robot, which makes what xacro makes for each value of `n`."""
    made = migrated(folder, text)["r.yaml"]
    given = [[f"n:={value}"] if value else [] for value in values or ("",)]
    assert hold_for(folder, *given) == []
    return made


def model_of(made: str) -> list[str]:
    """Return the lines of a source that make the robot."""
    return made.partition("model:\n")[2].splitlines()


def moved(
    folder: Path, files: dict[str, str], main: str = "r.xacro", *arguments: str, **options: Any
) -> XacroMigration:
    """Migrate a robot whose files lie in `folder/in` to `folder/out`, which is made anew.

    A file without a root element gets one, `<robot name="r">`.
    """
    for name, text in files.items():
        path = folder / "in" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        whole = name.endswith((".yaml", "package.xml"))
        path.write_text(text if whole else f"{HEAD}\n{text}\n</robot>\n")
    path = folder / "in" / main
    shutil.rmtree(folder / "out", ignore_errors=True)
    source = decode_xml(path.read_bytes(), name=path.name, path=str(path))
    out = str(folder / "out")
    migration = migrate_robot(
        source, out, arguments=arguments, packages={}, limits=Limits(), **options
    )
    for name, text in migration.files.items():
        (folder / "out" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "out" / name).write_text(text)
    for name in migration.origins.values():
        assert_in_style(name, migration.files[name])
    return migration


def is_same(folder: Path, migration: XacroMigration, *arguments: str) -> bool:
    """Tell whether the sources make what xacro makes of the robot with these arguments."""
    pytest.importorskip("xacro")
    given = dict(argument.split(":=") for argument in arguments)
    main = folder / "in" / next(own for own in migration.origins if own.endswith("r.xacro"))
    packages = {
        manifest.parent.name: str(manifest.parent)
        for manifest in (folder / "in").rglob("package.xml")
    }
    expected = expanded_by_xacro(str(main), given, DiskHost(Limits(), packages))
    assert expected is not None, "xacro has an error"
    made, _ = build_allowing(
        lambda codes: build(
            folder / "out" / migration.main,
            command_line=arguments,
            packages=packages,
            on_message=lambda line: None,
            allow=codes,
        )
    )
    return is_same_robot(write(expected).encode(), made.xml().encode())


def holds(folder: Path, files: dict[str, str], *several: str, **options: Any) -> XacroMigration:
    """Hold that a robot stays the same, with each of several arguments as well."""
    migration = moved(folder, files, **options)
    assert migration.faults == []
    assert [str(each) for each in migration.differences] == []
    for arguments in ((), *((one,) for one in several)):
        assert is_same(folder, migration, *arguments), arguments
    return migration
