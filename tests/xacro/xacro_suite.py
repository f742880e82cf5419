"""The test suite of xacro itself, run with another engine in the place of xacro.

The source distribution is fetched from PyPI when it is first needed. Its tests are loaded with a
stand-in for the module `xacro`, through which an engine does all the work: a function that takes a
`Document` and returns the XML it expands to, or raises `Refused`.

    for name in case_names():
        run_case(name, engine)      # raises AssertionError, or whatever the test raises
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import subprocess
import sys
import tarfile
import tempfile
import types
import unittest
import xml.dom.minidom as minidom
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any
from xml.parsers.expat import ExpatError

VERSION = "2.1.1"
DIGEST = "3e7adf33cdd90d9fbe8ca0d07d9118acf770a2ad8bf575977019a5c8a60d4d1b"
FOLDER = Path(__file__).parents[2] / "build" / "xacro-suite"

INTERNAL = {
    # They look at the words of xacro's own messages, or into its modules.
    "test_broken_include_error_reporting",
    "test_broken_input_doesnt_create_empty_output_file",
    "test_create_subdirs",
    "test_double_underscore_property_name_raises",
    "test_error_reporting",
    "test_invalid_property_definitions",
    "test_macro_name_with_colon",
    "test_print_location",
    "test_recursive_definition",
    "test_redefine_global_symbol",
    "test_set_root_directory",
    "test_yaml_hasattr_support",
}


class Document:
    """What an engine is given.

    Attributes:
        text: the xacro file.
        path: where it lies; empty if it is only text.
        arguments: for `<xacro:arg>`.
        packages: folders by name, for `$(find …)`.
    """

    def __init__(self, text: str, path: str, arguments: Mapping[str, str]) -> None:
        self.text = text
        self.path = path
        self.arguments = dict(arguments)
        self.packages = {"xacro": str(_root())}


class Refused(Exception):
    """An engine cannot expand a document; `is_syntax` tells that it is no XML."""

    def __init__(self, message: str, *, is_syntax: bool = False) -> None:
        super().__init__(message)
        self.is_syntax = is_syntax


Engine = Callable[[Document], str]


@cache
def is_available() -> bool:
    """Tell whether the source distribution is there, having fetched it if need be."""
    if not _root().exists():
        FOLDER.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=FOLDER) as folder:
            if _fetch(Path(folder)):
                # Other processes that run tests may do the same; the first one is kept.
                with contextlib.suppress(OSError):
                    (Path(folder) / _root().name).rename(_root())
    return _root().exists()


def _fetch(folder: Path) -> bool:
    """Download and unpack the source distribution; tell whether that worked."""
    options = "download --quiet --retries 0 --timeout 15 --no-binary :all: --no-deps --dest"
    command = [sys.executable, "-m", "pip", *options.split(), str(folder), f"xacro=={VERSION}"]
    subprocess.run(command, capture_output=True, check=False)
    archive = folder / f"xacro-{VERSION}.tar.gz"
    if not archive.exists() or hashlib.sha256(archive.read_bytes()).hexdigest() != DIGEST:
        return False
    with tarfile.open(archive) as file:
        safely: Any = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}
        file.extractall(folder, **safely)
    return True


def case_names(*, with_internal: bool = False) -> list[str]:
    """Return the names of the tests that expand documents, `Class.test`."""
    module = _load(_refuse)
    return [
        f"{kind.__name__}.{name}"
        for kind in (module.TestXacroCommentsIgnored, module.TestXacro)
        for name in unittest.TestLoader().getTestCaseNames(kind)
        if (name in vars(kind)) and (with_internal or name not in INTERNAL)
    ]


def run_case(name: str, engine: Engine) -> None:
    """Run a test; raise what it raises."""
    kind, _, method = name.partition(".")
    folder = os.getcwd()
    os.chdir(_root() / "test")
    try:
        getattr(_load(engine), kind)(method).debug()
    finally:
        os.chdir(folder)


def _root() -> Path:
    return FOLDER / f"xacro-{VERSION}"


def _refuse(document: Document) -> str:
    raise Refused("no engine")


def _load(engine: Engine) -> Any:
    """Return xacro's tests as a module that knows the engine as xacro."""
    stand_in = _StandIn(engine)
    path = _root() / "test" / "test_xacro.py"
    module: Any = types.ModuleType("xacro_suite_tests")
    module.__file__ = str(path)
    before = sys.modules.get("xacro")
    sys.modules["xacro"] = stand_in
    try:
        exec(compile(path.read_text("utf-8"), str(path), "exec"), module.__dict__)
    finally:
        if before is None:
            del sys.modules["xacro"]
        else:
            sys.modules["xacro"] = before
    module.TestXacroBase.quick_xacro = stand_in.quick
    module.TestXacroBase.run_xacro = stand_in.run
    return module


class _StandIn(types.ModuleType):
    """Has what the tests ask of the module `xacro`."""

    def __init__(self, engine: Engine) -> None:
        super().__init__("xacro")
        stand_in = self

        class XacroException(Exception):
            pass

        def quick(_case: object, xml: Any, cli: list[str] | None = None, **options: Any) -> Any:
            text = xml
            if not isinstance(xml, str):
                with xml:
                    text = xml.read()
            arguments = dict(item.split(":=", 1) for item in cli or () if ":=" in item)
            arguments.update(options.get("mappings") or {})
            return stand_in.expand(text, "", arguments)

        def run(_case: object, path: str, *options: str) -> None:
            output = options[options.index("-o") + 1]
            text = Path(path).read_text("utf-8")
            document = stand_in.expand(text, os.path.abspath(path), {})
            Path(output).write_text(document.toxml(), "utf-8")

        self._engine = engine
        self.XacroException = XacroException
        self.quick = quick
        self.run = run

    def expand(self, text: str, path: str, arguments: Mapping[str, str]) -> minidom.Document:
        try:
            return minidom.parseString(self._engine(Document(text, path, arguments)).encode())
        except Refused as error:
            if error.is_syntax:
                raise ExpatError(str(error)) from None
            raise self.XacroException(str(error)) from None

    def process_file(self, path: str) -> minidom.Document:
        text = Path(path).read_text("utf-8")
        return self.expand(text, os.path.abspath(path), {})

    def process(self, path: str) -> str:
        return self.process_file(path).toxml()
