"""`--to`: which documents are written where, what is beside them, and what is refused."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.targets.stub import write_with_stub
from yamaro.commands.main import main
from yamaro.targets.output import MARK

ROBOT = "robot: arm\nbase: fixed\nmodel:\n- link/name=base: {}\n"


@pytest.fixture(autouse=True)
def _formats(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    write_with_stub(monkeypatch)
    monkeypatch.chdir(tmp_path)
    Path("robot.yaml").write_text(ROBOT, encoding="utf-8")


def files_in(folder: str) -> list[str]:
    return sorted(
        os.path.relpath(os.path.join(around, name), folder)
        for around, _, names in os.walk(folder)
        for name in names
    )


# --- one format -------------------------------------------------------------------------------


def test_one_format_is_written_to_a_file_with_what_belongs_beside_it() -> None:
    assert main(["robot.yaml", "--to", "mjcf", "-o", "new/robot.xml"]) == 0
    assert files_in("new") == ["assets/arm-12.stl", "robot.xml", "scene.xml"]
    assert Path("new/robot.xml").read_text().startswith('<?xml version="1.0"?>\n<mjcf name="arm"')
    assert "file='robot.xml'" in Path("new/scene.xml").read_text()


def test_one_format_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["robot.yaml", "--to=SDF", "--meshes", "none", "--sdf-version", "1.9"]) == 0
    assert '<sdf name="arm" fixed="true" version="1.9" meshes="false"' in capsys.readouterr().out
    assert main(["robot.yaml", "--to", "sdf", "--meshes=none", "--base=free"]) == 0
    assert 'fixed="false"' in capsys.readouterr().out
    assert files_in(".") == ["robot.yaml"]


def test_a_urdf_can_be_the_input(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.urdf").write_text('<robot name="a"><link name="x"/></robot>')
    assert main(["robot.urdf", "--to", "sdf", "--meshes=none"]) == 0
    assert '<body name="x"/>' in capsys.readouterr().out


@pytest.mark.parametrize("name", ["robot.usdc", "robot.usdz", "ROBOT.USDC"])
def test_usd_is_not_written_under_the_name_of_a_binary_file(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["robot.yaml", "--to", "usd", "-o", name]) == 2
    said = capsys.readouterr().err
    assert "USD is written as text" in said
    assert f"name it {name[:5]}.usda or {name[:5]}.usd" in said
    assert files_in(".") == ["robot.yaml"]


@pytest.mark.parametrize("name", ["robot.usda", "robot.usd", "robot.text"])
def test_usd_is_written_under_any_other_name(name: str) -> None:
    assert main(["robot.yaml", "--to", "usd", "-o", name]) == 0
    assert name in files_in(".")


def test_a_document_that_needs_files_does_not_go_to_standard_output(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["robot.yaml", "--to", "mjcf"]) == 2
    assert "name it with -o FILE, or write --meshes none" in capsys.readouterr().err


# --- a folder ---------------------------------------------------------------------------------


@pytest.mark.parametrize("output", ["out", "out/"])
def test_several_formats_are_written_to_a_folder(output: str) -> None:
    assert main(["robot.yaml", "--to", "urdf,sdf,mjcf", "--to", "srdf,usd", "-o", output]) == 0
    assert files_in("out") == [
        "arm.sdf",
        "arm.srdf",
        "arm.urdf",
        "arm.usda",
        "arm.xml",
        "assets/arm-12.stl",
        "scene.xml",
    ]
    assert main(["robot.yaml", "--to", "urdf,sdf,mjcf", "-o", output]) == 0


def test_one_format_can_be_written_to_a_folder() -> None:
    assert main(["robot.yaml", "--to", "usd", "-o", "out/"]) == 0
    Path("there").mkdir()
    assert main(["robot.yaml", "--to", "usd", "-o", "there"]) == 0
    assert "arm.usda" in files_in("out")
    assert "arm.usda" in files_in("there")


def test_meshes_are_copied_to_a_folder(tmp_path: Path) -> None:
    Path("part.stl").write_text("solid x")
    text = ROBOT + "    - visual: {geometry: {mesh/filename=part.stl: }}\n"
    Path("robot.yaml").write_text(text.replace(": {}\n", ":\n"))
    assert main(["-q", "robot.yaml", "--to", "urdf,sdf", "-o", "out"]) == 0
    (copy,) = (name for name in files_in("out") if name.startswith("assets/part-"))
    assert copy in Path("out/arm.urdf").read_text()
    assert main(["-q", "robot.yaml", "--to", "urdf,sdf", "-o", "kept", "--meshes=keep"]) == 0
    assert 'filename="part.stl"' in Path("kept/arm.urdf").read_text()


# --- what is there stays -----------------------------------------------------------------------


def test_nothing_is_written_if_a_format_fails(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text(ROBOT.replace("=base", "=refused"))
    assert main(["robot.yaml", "--to", "urdf,mjcf", "-o", "out"]) == 1
    assert "error[massless-moving]" in capsys.readouterr().err
    assert not Path("out").exists()


def test_a_file_that_was_not_generated_is_kept() -> None:
    Path("out").mkdir()
    Path("out/scene.xml").write_text("mine")
    assert main(["robot.yaml", "--to", "mjcf", "-o", "out"]) == 0
    assert Path("out/scene.xml").read_text() == "mine"
    Path("out/scene.xml").write_text(f"<!-- {MARK} -->")
    assert main(["robot.yaml", "--to", "mjcf", "-o", "out"]) == 0
    assert "include" in Path("out/scene.xml").read_text()


@pytest.mark.parametrize(
    ("name", "file"),
    [("package", "package.xml"), ("model", "model.sdf"), ("arm", "arm.urdf"), ("a", "a.usda")],
)
def test_the_name_of_a_robot_does_not_choose_a_file_to_replace(
    name: str, file: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("robot.yaml").write_text(ROBOT.replace("arm", name))
    Path(file).write_text("mine")
    command = ["robot.yaml", "--to", "urdf,mjcf,sdf,usd", "-o", "./"]
    assert main(command) == 2
    assert f"'{file}' exists and does not say that Yamaro has generated it" in (
        capsys.readouterr().err
    )
    assert (files_in("."), Path(file).read_text()) == (sorted([file, "robot.yaml"]), "mine")
    Path(file).unlink()
    for _ in range(2):
        assert main(command) == 0
        assert MARK in Path(file).read_text().split("\n")[1]


def test_a_link_out_of_the_output_folder_is_not_followed(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("away").mkdir()
    Path("out").mkdir()
    old = f"<!-- {MARK} -->"
    for link, target in (("arm.sdf", "old"), ("scene.xml", "scene"), ("assets", "")):
        Path("away", target or "x").write_text(old)
        Path("out", link).symlink_to(Path("..", "away", target))
        assert main(["robot.yaml", "--to", "mjcf,sdf", "-o", "out"]) == 2
        assert "links lead out of the output folder" in capsys.readouterr().err
        Path("out", link).unlink()
    assert files_in("out") == []
    assert {Path("away", each).read_text() for each in files_in("away")} == {old}
    Path("out/arm.sdf").symlink_to("../nowhere")
    assert main(["robot.yaml", "--to", "sdf", "-o", "out/"]) == 2
    assert not Path("nowhere").exists()


@pytest.mark.parametrize("name", ["scene", "Scene"])
def test_a_robot_named_scene_has_its_scene(name: str) -> None:
    Path("robot.yaml").write_text(ROBOT.replace("arm", name))
    assert main(["robot.yaml", "--to", "mjcf", "-o", "out/"]) == 0
    assert files_in("out") == sorted(["assets/arm-12.stl", f"{name}_robot.xml", "scene.xml"])
    assert f"file='{name}_robot.xml'" in Path("out/scene.xml").read_text()


def test_a_robot_that_is_written_to_scene_xml_has_no_scene(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["robot.yaml", "--to", "mjcf", "-o", "scene.xml"]) == 0
    assert "note: no scene is written: 'scene.xml' is the robot" in capsys.readouterr().err
    assert "<mjcf" in Path("scene.xml").read_text()


@pytest.mark.parametrize(
    "name", ["con", "NUL", "com1.left", "lpt²", "-rf", ".bashrc", "a/b", "a\\b", "a:b", "ä" * 101]
)
def test_a_name_that_no_file_can_have_everywhere_is_not_that_of_the_output(name: str) -> None:
    Path("robot.yaml").write_text(ROBOT.replace("robot: arm", f"robot: '{name}'"))
    assert main(["-q", "robot.yaml", "--to", "sdf", "-o", "out/"]) == 0
    assert [each for each in files_in("out") if each.endswith(".sdf")] == ["robot.sdf"]


def test_another_file_in_the_place_of_a_mesh_is_an_error(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("out/assets").mkdir(parents=True)
    Path("out/assets/arm-12.stl").write_text("mine")
    assert main(["robot.yaml", "--to", "urdf,mjcf", "-o", "out"]) == 1
    assert "another file has that name" in capsys.readouterr().err
    assert files_in("out") == ["assets/arm-12.stl"]


def test_no_document_is_replaced_if_one_of_them_cannot_be_written(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("out/arm.xml").mkdir(parents=True)
    Path("out/arm.sdf").write_text(f"<!-- {MARK} --> old")
    assert main(["robot.yaml", "--to", "sdf,mjcf", "-o", "out", "--meshes=none"]) == 1
    assert "cannot write" in capsys.readouterr().err
    assert Path("out/arm.sdf").read_text().endswith("old")
    assert files_in("out") == ["arm.sdf"]


def test_an_input_is_not_replaced(capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.urdf").write_text('<robot name="arm"><link name="x"/></robot>')
    assert main(["arm.urdf", "--to", "urdf,sdf", "-o", "."]) == 2
    assert "is one of the input files" in capsys.readouterr().err
    assert files_in(".") == ["arm.urdf", "robot.yaml"]


# --- wrong usage ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--to", "mjfc"], "unknown output format 'mjfc'; did you mean 'mjcf'?"),
        (["--to", "dae"], "unknown output format 'dae'; choose from urdf, sdf, mjcf, srdf, usd"),
        (["--to", ","], "'--to' needs output formats: urdf, sdf, mjcf, srdf, usd"),
        (["--to", "sdf,mjcf"], "several output formats need a folder: -o out/"),
        (["--to", "sdf,mjcf", "-o", "a.txt"], "'a.txt' is a file, and several output formats"),
        (["--to", "urdf,mjcf", "-o", "b.xml"], "'b.xml' has the name of a file, and several"),
        (["--to", "mjcf", "--sdf-version", "1.9"], "'--sdf-version' needs --to sdf"),
        (
            ["--to", "sdf", "--sdf-version", "1.7"],
            "'--sdf-version' takes 1.11, 1.9 or 1.12, not '1.7'",
        ),
        (["--to", "sdf", "--mujoco-version", "3.3"], "'--mujoco-version' needs --to mjcf"),
        (["--to", "mjcf", "--mujoco-version", "3"], "'3' is not a version of MuJoCo"),
        (["--base", "free"], "'--base' needs an output format, such as --to sdf"),
        (["--repair-inertia"], "'--repair-inertia' needs an output format, such as --to sdf"),
        (["--to", "sdf", "--base", "loose"], "'--base' takes fixed or free, not 'loose'"),
    ],
)
def test_what_makes_no_sense_is_refused(
    options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("a.txt").write_text("")
    assert main(["robot.yaml", *options]) == 2
    assert message in capsys.readouterr().err
    assert Path("robot.yaml").read_text() == ROBOT


def test_a_name_that_promises_another_format_gets_a_hint(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["robot.yaml", "-o", "robot.sdf"]) == 0
    says = "yamaro: note: robot.sdf holds URDF; --to sdf writes SDF\n"
    assert capsys.readouterr().err == says
    assert main(["robot.yaml", "-q", "-o", "robot.sdf"]) == 0
    assert main(["robot.yaml", "--base=fixed", "--to=mjcf", "-o", "other.urdf"]) == 0
    says = "yamaro: note: other.urdf holds MJCF; --to urdf writes URDF\n"
    assert capsys.readouterr().err.endswith(says)
    Path("folder.sdf").mkdir()
    assert main(["robot.yaml", "--base=fixed", "--to=urdf,sdf", "-o", "folder.sdf"]) == 0
    assert "holds" not in capsys.readouterr().err
    Path("world.yaml").write_text("sdf: {world: }\n")
    assert main(["world.yaml", "-o", "world.sdf"]) == 0
    assert main(["robot.yaml", "-o", "robot.xml"]) == 0
    assert capsys.readouterr().err == ""


# --- other commands ---------------------------------------------------------------------------

JOINT = """\
- link/name=tip: {}
- joint/name=mount, type=fixed: {parent/link=base: , child/link=tip: }
"""


def test_check_reports_what_formats_cannot_hold(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text(ROBOT + JOINT)
    assert main(["check", "robot.yaml"]) == 0
    assert main(["check", "robot.yaml", "--to", "sdf,mjcf"]) == 1
    said = capsys.readouterr().err
    assert "warning[lost-in-sdf]: joints are lost in SDF: joint 'mount'" in said
    assert "warning[lost-in-mjcf]" in said
    allowed = ["--allow", "lost-in-sdf", "--allow", "lost-in-mjcf"]
    assert main(["check", "robot.yaml", "--to", "sdf,mjcf", *allowed]) == 0
    assert files_in(".") == ["robot.yaml"]


def test_losses_are_errors_with_strict_unless_they_are_allowed() -> None:
    Path("robot.yaml").write_text(ROBOT + JOINT)
    to_sdf = ["robot.yaml", "-q", "--to", "sdf", "-o", "robot.sdf"]
    assert main(to_sdf) == 0
    Path("robot.sdf").unlink()
    assert main([*to_sdf, "--strict"]) == 1
    assert not Path("robot.sdf").exists()
    assert main([*to_sdf, "--strict", "--allow", "lost-in-sdf"]) == 0


def test_deps_lists_what_all_formats_are_made_of(capsys: pytest.CaptureFixture[str]) -> None:
    Path("part.yaml").write_text("model:\n- link/name=part: {}\n")
    text = ROBOT + "- if target == 'sdf':\n  - include: part.yaml\n"
    Path("robot.yaml").write_text(text)
    assert main(["-q", "--allow=several-roots", "robot.yaml", "--to", "urdf,sdf", "--deps"]) == 0
    assert capsys.readouterr().out.split() == [
        os.path.abspath("robot.yaml"),
        os.path.abspath("part.yaml"),
    ]
