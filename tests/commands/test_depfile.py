"""Tests of `--depfile`: what it lists, and that make and Ninja read it as it is meant."""

from __future__ import annotations

import io
import os
import subprocess
from pathlib import Path

import pytest

from tests.consumers.oracles import require_program
from tests.meshes.triangle import STL
from yamaro.commands.dependencies import rule
from yamaro.commands.main import main

ROBOT = """\
robot: arm
import: sizes
model:
- include: parts/leg.yaml
- part: {name: base, link: {geometry: box, size: $(sizes.width()) 1 1, mass: 1}}
"""
LEG = """\
model:
- part: {name: leg, joint: {type: fixed, parent: base}, link: {geometry: foot.stl, visual: }}
"""
NAMES = ["plain", "a b", "a#b", "a$b", "a:b", "a%b", "a[1]", "a b\tc", "übung", "a~b", "a\\\\b"]
"""Names of files; those that Ninja has no spelling for are not among them."""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a folder with a robot of several files."""
    monkeypatch.chdir(tmp_path)
    Path("parts").mkdir()
    Path("robot.yaml").write_text(ROBOT)
    Path("parts/leg.yaml").write_text(LEG)
    Path("sizes.py").write_text("def width():\n    import lengths\n    return lengths.WIDTH\n")
    Path("lengths.py").write_text("WIDTH = 2\n")
    return tmp_path


def dependencies(path: str = "out/robot.d") -> tuple[str, list[str]]:
    """Return the target of a depfile whose names need no escapes, and what it depends on."""
    first = Path(path).read_text().partition("\n\n")[0].replace("\\\n", " ")
    target, *names = first.split()
    return target, names


def test_it_lists_includes_modules_and_where_a_missing_mesh_would_be(folder: Path) -> None:
    assert main(["-q", "robot.yaml", "-o", "out/robot.urdf", "--depfile", "out/robot.d"]) == 0
    target, names = dependencies()
    assert target == "out/robot.urdf:"
    files = ["robot.yaml", "parts/leg.yaml", "sizes.py", "lengths.py"]
    assert names[0] == str(folder / "robot.yaml")
    assert set(names) == {str(folder / name) for name in [*files, "parts", ""]}


def test_standard_input_is_not_a_file(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("robot: arm\nmodel: {include: parts/base.yaml}\n"))
    Path("parts/base.yaml").write_text("model: {link/name=base: }\n")
    assert main(["-", "-o", "robot.urdf", "--depfile", "robot.d"]) == 0
    assert Path("robot.d").read_text() == f"robot.urdf: {folder}/parts/base.yaml\n"


def test_a_mesh_that_is_there_is_listed(folder: Path) -> None:
    Path("parts/foot.stl").write_text(STL)
    assert main(["-q", "robot.yaml", "-o", "out/robot.urdf", "--depfile", "out/robot.d"]) == 0
    names = dependencies()[1]
    assert str(folder / "parts/foot.stl") in names
    assert str(folder / "parts") not in names


def test_the_folder_of_the_output_is_never_listed(folder: Path) -> None:
    assert main(["-q", "robot.yaml", "-o", "parts/robot.urdf", "--depfile", "robot.d"]) == 0
    assert set(dependencies("robot.d")[1]).isdisjoint({str(folder), str(folder / "parts")})


def test_all_documents_are_targets() -> None:
    Path("robot.yaml").write_text(ROBOT.replace("- include: parts/leg.yaml\n", ""))
    words = ["-q", "robot.yaml", "--to", "urdf,sdf,mjcf", "-o", "out/", "--depfile", "robot.d"]
    assert main(words) == 0
    line = Path("robot.d").read_text().partition("\n")[0]
    assert line.startswith("out/arm.urdf out/arm.sdf out/arm.xml: ")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--depfile", "d"], "'--depfile' needs '-o' with a file"),
        (["-o", "r", "--depfile", "./r"], "'--depfile' and '-o' name the same file"),
        (["-o", "r", "--depfile", "sizes.py"], "the depfile 'sizes.py' is one of the input files"),
        (
            ["-o", "out/", "--to", "urdf", "--depfile", "out/arm.urdf"],
            "the depfile 'out/arm.urdf' is one of the output files",
        ),
    ],
)
def test_a_place_that_cannot_be_is_wrong_usage(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = Path("sizes.py").read_text()
    assert main(["-q", "robot.yaml", *words]) == 2
    assert told in capsys.readouterr().err
    assert Path("sizes.py").read_text() == before
    assert not Path("r").exists()
    assert not Path("out").exists()


def test_a_faulty_robot_leaves_depfile_and_output_as_they_were() -> None:
    Path("robot.yaml").write_text("robot: a\nmodel: {link/name=$(missing): }\n")
    Path("r.urdf").write_text("old")
    Path("r.d").write_text("old")
    assert main(["-q", "robot.yaml", "-o", "r.urdf", "--depfile", "r.d"]) == 1
    assert (Path("r.urdf").read_text(), Path("r.d").read_text()) == ("old", "old")


def test_a_name_with_a_line_break_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    Path("a\nb.yaml").write_text("robot: a\nmodel: {link/name=a: }\n")
    assert main(["a\nb.yaml", "-o", "r.urdf", "--depfile", "r.d"]) == 1
    assert "error[name-with-line-break]: --depfile lists one name a line" in capsys.readouterr().err
    assert not Path("r.urdf").exists()


def test_a_depfile_that_cannot_be_written_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["-q", "robot.yaml", "-o", "r.urdf", "--depfile", "sizes.py/d"]) == 1
    assert "cannot write 'sizes.py/d'" in capsys.readouterr().err
    assert not Path("r.urdf").exists()


MAKEFILE = "out:\n\t@echo x >> log; touch out\ninclude out.d\n"
NINJA = """\
rule r
  command = echo x >> log; cp kept.d out.d; touch out
  depfile = out.d
build out: r
"""


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("tool", ["make", "ninja"])
def test_build_tools_read_the_names(tool: str, name: str, folder: Path) -> None:
    """One build, none when nothing changed, another for a change and for a deleted file."""
    program = require_program(tool)
    if tool == "ninja" and "\t" in name:
        pytest.skip("Ninja reads no tabs in names")
    file = folder / name
    file.write_text("1")
    Path("main").write_text("1")
    for depfile in ("out.d", "kept.d"):  # Ninja deletes a depfile before it builds
        Path(depfile).write_bytes(rule(["out"], [str(folder / "main"), str(file)]))
    Path("Makefile").write_text(MAKEFILE)
    Path("build.ninja").write_text(NINJA)

    def builds() -> int:
        subprocess.run([program], check=True, capture_output=True)
        return len(Path("log").read_text().split())

    assert [builds(), builds()] == [1, 1]
    newer = Path("out").stat().st_mtime + 10
    os.utime(file, (newer, newer))
    assert builds() == 2
    os.utime("out", (newer + 10, newer + 10))
    file.unlink()
    if tool == "ninja" or not {"%", "\t"} & set(name):
        assert builds() == 3
