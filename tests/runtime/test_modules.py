"""Python modules beside the YAML file: found first, loaded anew, gone afterwards."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from yamaro import YamaroError, build
from yamaro.runtime.modules import LocalModules


def compile_in(folder: Path, text: str, **files: str) -> str:
    """Compile a text beside Python files; `pkg__mod` names pkg/mod.py."""
    for name, content in files.items():
        path = folder / f"{name.replace('____init__', '/__init__').replace('pkg__', 'pkg/')}.py"
        path.parent.mkdir(exist_ok=True)
        path.write_text(content, encoding="utf-8")
    (folder / "t.yaml").write_text(text, encoding="utf-8")
    return build(str(folder / "t.yaml")).xml()


def value(expression: str) -> str:
    return f"out: $({expression})\n"


def failed(folder: Path, text: str, **files: str) -> Any:
    with pytest.raises(YamaroError) as caught:
        compile_in(folder, text, **files)
    return caught.value.diagnostics[-1]


def result(xml: str) -> str:
    return xml.split("<out>")[1].split("</out>")[0]


def test_a_module_beside_the_file_goes_before_an_installed_one(tmp_path: Path) -> None:
    import random

    xml = compile_in(tmp_path, "import: random\n" + value("random.mine"), random="mine = 4")
    assert result(xml) == "4"
    assert sys.modules["random"] is random


def test_modules_import_each_other_and_packages_their_parts(tmp_path: Path) -> None:
    xml = compile_in(
        tmp_path,
        "import: [pkg.part, 'from pkg import other as o', 'from pkg.part import deep']\n"
        + value("[pkg.part.number, o.number, deep(), pkg.name]"),
        pkg____init__="from . import part\nname = 7",
        pkg__part="from .other import number as n\nimport lone\nnumber = n + 1\n"
        "def deep(): return lone.x",
        pkg__other="import math\nnumber = math.floor(1.5)",
        lone="x = 5",
    )
    assert result(xml) == "2 1 5 7"


def test_a_part_of_a_package_is_found_by_from(tmp_path: Path) -> None:
    files = {"pkg____init__": "", "pkg__part": "x = 3"}
    xml = compile_in(tmp_path, "import: from pkg import part\n" + value("part.x"), **files)
    assert result(xml) == "3"


def test_each_build_loads_modules_anew_and_leaves_none_behind(tmp_path: Path) -> None:
    text = "import: counting\nprocess: counting.count += 1\n" + value("counting.count")
    before = set(sys.modules)
    for _ in range(2):
        assert result(compile_in(tmp_path, text, counting="count = 0")) == "1"
    assert {name for name in set(sys.modules) - before if "counting" in name} == set()


def test_dataclasses_work_in_a_module_beside_the_file(tmp_path: Path) -> None:
    source = (
        "from __future__ import annotations\nfrom dataclasses import dataclass\n"
        "@dataclass\nclass P:\n    x: int = 2\n"
    )
    assert result(compile_in(tmp_path, "import: p\n" + value("p.P().x"), p=source)) == "2"


def test_a_module_that_fails_is_shown_at_the_import_and_not_kept(tmp_path: Path) -> None:
    before = set(sys.modules)
    diagnostic = failed(tmp_path, "import: bad\nout:\n", bad="x = 1\n1 / 0\n")
    assert diagnostic.code == "python-error"
    assert diagnostic.span.place().endswith("t.yaml:1:9")
    assert diagnostic.notes == ("raised in bad.py:2",)
    assert {name for name in set(sys.modules) - before if "bad" in name} == set()


@pytest.mark.parametrize(
    "text", ["import: no_such_module_x\nout:\n", "import: math.no_part\nout:\n"]
)
def test_a_missing_module_is_told(tmp_path: Path, text: str) -> None:
    diagnostic = failed(tmp_path, text)
    assert (diagnostic.code, "no" in diagnostic.message) == ("unknown-module", True)


def test_a_module_missing_inside_a_module_is_that_modules_fault(tmp_path: Path) -> None:
    diagnostic = failed(tmp_path, "import: mine\nout:\n", mine="import no_such_module_x")
    assert diagnostic.code == "python-error"
    assert "no_such_module_x" in diagnostic.message


def test_a_missing_part_of_a_package_is_told(tmp_path: Path) -> None:
    diagnostic = failed(tmp_path, "import: pkg.part\nout:\n", pkg____init__="")
    assert diagnostic.code == "unknown-module"


def test_a_name_a_module_lacks_gets_a_suggestion(tmp_path: Path) -> None:
    diagnostic = failed(tmp_path, "import: from math import sine\nout:\n")
    assert diagnostic.code == "unknown-module"
    assert diagnostic.hint in ("did you mean 'sin'?", "did you mean 'sinh'?")


def test_importing_in_process_sees_the_same_modules(tmp_path: Path) -> None:
    text = "process: |\n  import mine\n  from os import path\n  x = mine.x\n" + value("x")
    assert result(compile_in(tmp_path, text, mine="x = 9")) == "9"


def test_without_a_folder_only_installed_modules_are_found() -> None:
    modules = LocalModules("", {}, print)
    assert modules.find("yamaro") is None
    assert modules.import_hook("math").floor(1.5) == 1
    with pytest.raises(ModuleNotFoundError):
        modules.load("nothing")


def test_files_of_modules_are_among_those_read(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text("")
    (tmp_path / "t.yaml").write_text("import: mine\nout:\n")
    files = build(str(tmp_path / "t.yaml")).files
    assert [Path(file).name for file in files] == ["t.yaml", "mine.py"]


def test_modules_know_their_files(tmp_path: Path) -> None:
    text = "import: [helper, pkg]\n" + value("[helper.__file__, pkg.__file__, pkg.__path__[0]]")
    xml = compile_in(tmp_path, text, helper="", pkg____init__="")
    files = [tmp_path / "helper.py", tmp_path / "pkg" / "__init__.py", tmp_path / "pkg"]
    assert result(xml) == str([str(file) for file in files])


def test_a_module_may_say_in_which_encoding_it_is_written(tmp_path: Path) -> None:
    (tmp_path / "old.py").write_bytes("# -*- coding: latin-1 -*-\nname = 'é'\n".encode("latin-1"))
    assert result(compile_in(tmp_path, "import: old\n" + value("old.name"))) == "é"


def test_packages_import_from_those_around_them(tmp_path: Path) -> None:
    (tmp_path / "pkg" / "inner").mkdir(parents=True)
    (tmp_path / "pkg" / "inner" / "__init__.py").write_text("from . import part")
    (tmp_path / "pkg" / "inner" / "part.py").write_text(
        "from ..other import two\nfrom .. import other"
    )
    xml = compile_in(
        tmp_path,
        "import: pkg.inner.part\n" + value("[pkg.inner.part.two, pkg.inner.part.other.two]"),
        pkg____init__="",
        pkg__other="two = 2",
    )
    assert result(xml) == "2 2"
