"""xacro's own tests, with documents that are migrated and built in the place of xacro."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path

import pytest

from tests.xacro import xacro_suite
from yamaro import YamaroError, build
from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.tools.migrate.xacro.command import migrate_robot

FEWEST = 100
"""Of the 112 that can be tried. Others look for comments, which become YAML's, or at messages."""


@pytest.mark.skipif(not xacro_suite.is_available(), reason="xacro's tests cannot be fetched")
def test_most_of_what_xacro_is_tested_with_can_be_migrated(tmp_path: Path) -> None:
    count = 0

    def engine(document: xacro_suite.Document) -> str:
        nonlocal count
        count += 1
        folder = tmp_path / str(count)
        arguments = [f"{name}:={value}" for name, value in document.arguments.items()]
        path = document.path or str(Path.cwd() / "test.xacro")
        try:
            migration = migrate_robot(
                Source(document.text, name="test", path=path),
                str(folder),
                arguments=arguments,
                packages=document.packages,
                limits=Limits(),
                exact=True,
            )
        except YamaroError as error:
            is_syntax = error.diagnostics[0].code == "xml-syntax"
            raise xacro_suite.Refused(str(error), is_syntax=is_syntax) from None
        for name, text in migration.files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)
        main = folder / migration.main
        return build(
            main,
            command_line=arguments,
            packages=document.packages,
            on_message=lambda line: None,
            allow=migration.allowed,
        ).xml()

    passed = []
    for name in xacro_suite.case_names():
        with contextlib.suppress(Exception), contextlib.redirect_stderr(io.StringIO()):
            xacro_suite.run_case(name, engine)
            passed.append(name)
    assert len(passed) >= FEWEST
