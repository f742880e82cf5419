"""The tests of xacro itself pass with Yamaro's engine in its place."""

from __future__ import annotations

import sys

import pytest

from tests.xacro import xacro_suite
from tests.xacro.xacro_host import FileHost
from yamaro.diagnostics import Reporter, YamaroError
from yamaro.rendering import render
from yamaro.sandbox.deep_stack import run_on_deep_stack
from yamaro.source import Source
from yamaro.xacro.expansion import expand
from yamaro.xml.writer import write


def expand_to_text(document: xacro_suite.Document) -> str:
    host = FileHost(document.packages.get)
    source = Source(document.text, name="test", path=document.path)
    reporter = Reporter()
    try:
        root = run_on_deep_stack(lambda: expand(source, host, document.arguments, reporter))
        return write(root)
    except YamaroError as error:
        is_syntax = error.diagnostics[0].code == "xml-syntax"
        raise xacro_suite.Refused(str(error), is_syntax=is_syntax) from None
    finally:
        for said in host.said:
            print(said, file=sys.stderr)
        for diagnostic in reporter.diagnostics:
            print(render(diagnostic), file=sys.stderr)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    names = xacro_suite.case_names() if xacro_suite.is_available() else []
    metafunc.parametrize("name", names)


def test_a_case_of_xacro_passes(name: str) -> None:
    xacro_suite.run_case(name, expand_to_text)
