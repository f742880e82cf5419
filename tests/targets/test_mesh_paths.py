"""The paths of meshes lead to the same files from wherever the output lies."""

import os
import re
from pathlib import Path

import pytest

from yamaro import UsageError, YamaroError, build, load
from yamaro.commands.main import main
from yamaro.policy import Policy

TETRAHEDRON = (
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"  # closed, volume 1/6
)


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """A package whose files name meshes from three folders: parts/, urdf/ and its own."""
    package = tmp_path / "arm"
    for name in ("meshes/a.obj", "parts/meshes/b.obj", "parts/c.obj"):
        path = package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(TETRAHEDRON)
    (package / "parts/skin.png").write_bytes(b"png")
    (package / "package.xml").write_text("<package><name>arm</name></package>")
    (package / "robot.yaml").write_text(
        "model:\n"
        "- part: {name: a, link: {geometry: meshes/a.obj, visual: }}\n"
        "- include: parts/b.yaml\n"
        "- include: {path: parts/c.urdf, prefix: c_}\n"
        "- include: parts/d.xacro\n"
        "- part: {name: gone, joint: {type: fixed, parent: a},\n"
        "         link: {geometry: meshes/gone.stl, visual: }}\n"
        "- part: {name: p, joint: {type: fixed, parent: a},\n"
        "         link: {geometry: package://arm/meshes/a.obj, visual: }}\n"
    )
    (package / "parts/b.yaml").write_text(
        "model:\n"
        "- for:\n"
        "    iterator: i\n"
        "    range: 2\n"
        "    body:\n"
        "    - part:\n"
        "        name: b$(i)\n"
        "        joint: {type: fixed, parent: a}\n"
        "        link: {geometry: meshes/b.obj, mass: 1, visual: {material: "
        "{name: skin, texture: skin.png}}}\n"
        "    - joint/name=raw$(i)_joint, type=fixed: {parent/link=a_link: , child/link=raw$(i): }\n"
        "    - link/name=raw$(i):\n"
        "        visual: {geometry: {mesh/filename=meshes/b.obj: }}\n"
    )
    urdf = (
        '<robot name="c"{}><link name="{}"><visual><geometry><mesh filename="c.obj"/></geometry>'
        '</visual></link><joint name="{}_joint" type="fixed"><parent link="a_link"/>'
        '<child link="{}"/></joint></robot>'
    )
    (package / "parts/c.urdf").write_text(urdf.format("", "c", "c", "c"))
    xacro = ' xmlns:xacro="http://www.ros.org/wiki/xacro"'
    (package / "parts/d.xacro").write_text(urdf.format(xacro, "d", "d", "d"))
    return package


def names_in(xml: str) -> list[str]:
    return re.findall(r'filename="(.*?)"', xml)


MEANT = [
    "meshes/a.obj",
    *["parts/meshes/b.obj", "parts/skin.png", "parts/meshes/b.obj"] * 2,
    "parts/c.obj",
    "parts/c.obj",
]
KEPT = ["meshes/gone.stl", "package://arm/meshes/a.obj"]


def test_paths_start_at_the_folder_of_the_main_file(robot: Path) -> None:
    names = names_in(build(robot / "robot.yaml").xml())
    assert names == MEANT + KEPT


@pytest.mark.parametrize("where", ["out.urdf", "build/urdf/out.urdf", "../elsewhere/out.urdf"])
def test_paths_start_at_the_folder_of_the_output(robot: Path, where: str) -> None:
    output = robot / where
    output.parent.mkdir(parents=True, exist_ok=True)
    assert main(["-q", str(robot / "robot.yaml"), "-o", str(output)]) == 0
    names = names_in(output.read_text())
    assert names[-2:] == KEPT
    for name, meant in zip(names, MEANT, strict=False):
        assert os.path.samefile(output.parent / name, robot / meant)


def test_a_folder_behind_a_symbolic_link_is_the_one_that_it_leads_to(
    robot: Path, tmp_path: Path
) -> None:
    (tmp_path / "deep" / "er").mkdir(parents=True)
    (robot / "build").symlink_to(tmp_path / "deep" / "er")
    xml = build(robot / "robot.yaml", output=robot / "build" / "out.urdf").xml()
    for name, meant in zip(names_in(xml), MEANT, strict=False):
        assert os.path.samefile(robot / "build" / name, robot / meant)


def test_a_mesh_that_is_a_symbolic_link_keeps_its_name(robot: Path, tmp_path: Path) -> None:
    (tmp_path / "store.obj").write_text(TETRAHEDRON)
    (robot / "meshes/a.obj").unlink()
    (robot / "meshes/a.obj").symlink_to(tmp_path / "store.obj")
    names = names_in(build(robot / "robot.yaml", output=tmp_path / "out.urdf").xml())
    assert names[0] == "arm/meshes/a.obj"


@pytest.mark.parametrize("mode", ["safe", "jail"])
def test_a_file_that_is_not_trusted_gives_the_same(robot: Path, tmp_path: Path, mode: str) -> None:
    output = tmp_path / "out.urdf"
    expected = build(robot / "robot.yaml", output=output).xml()
    assert build(robot / "robot.yaml", output=output, policy=Policy(mode)).xml() == expected


def test_what_is_out_of_reach_is_refused_whether_it_is_there_or_not(
    robot: Path, tmp_path: Path
) -> None:
    (tmp_path / "secret.stl").write_text(TETRAHEDRON)
    told = []
    for name in ("secret", "absent"):
        path = robot / f"{name}.yaml"
        path.write_text(
            f"robot: r\nmodel: {{link/name=a: {{visual: {{geometry: "
            f"{{mesh/filename=../../{name}.stl: }}}}}}}}\n"
        )
        (robot / "deep").mkdir(exist_ok=True)
        with pytest.raises(YamaroError) as caught:
            build(path, policy=Policy("safe"), output=robot / "deep" / "o.urdf")
        told.append(str(caught.value).replace(name, "…"))
    assert told[0] == told[1]
    assert "path-outside" in told[0]


def test_the_tree_of_a_build_keeps_what_was_written(robot: Path, tmp_path: Path) -> None:
    built = build(robot / "robot.yaml", output=tmp_path / "out.urdf")
    assert names_in(build(robot / "robot.yaml", meshes="keep").xml())[1] == "meshes/b.obj"
    assert str(robot / "parts/meshes/b.obj") in built.meshes
    mesh = next(
        element
        for link in built.root.elements()
        for visual in link.elements()
        for geometry in visual.elements()
        for element in geometry.elements()
        if element.name == "mesh" and element.attributes["filename"] == "meshes/b.obj"
    )
    found = built.finder.resolve("meshes/b.obj", mesh.value_span("filename"))
    assert found == str(robot / "parts/meshes/b.obj")


def test_the_files_used_are_listed_as_before(
    robot: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lists = []
    for options in ([], ["--meshes", "keep"]):
        assert main(["-q", "--deps", *options, str(robot / "robot.yaml")]) == 0
        lists.append(capsys.readouterr().out)
    assert lists[0] == lists[1]
    assert str(robot / "parts/c.obj") in lists[0]


@pytest.mark.parametrize(
    ("how", "named"),
    [
        ("keep", ["meshes/a.obj", "meshes/b.obj", "skin.png", "package://arm/meshes/a.obj"]),
        (
            "package://arm",
            [f"package://arm/{name}" for name in (*MEANT[:3], "meshes/a.obj")],
        ),
        (
            "package://",
            [f"package://arm/{name}" for name in (*MEANT[:3], "meshes/a.obj")],
        ),
    ],
)
def test_an_option_says_how_meshes_are_named(
    robot: Path, capsys: pytest.CaptureFixture[str], how: str, named: list[str]
) -> None:
    assert main(["-q", str(robot / "robot.yaml"), "--meshes", how]) == 0
    names = names_in(capsys.readouterr().out)
    assert [*names[:3], names[-1]] == named
    assert names[-2] == "meshes/gone.stl"


def test_absolute_paths_are_also_those_in_packages(robot: Path) -> None:
    names = names_in(build(robot / "robot.yaml", meshes="absolute").xml())
    assert names[0] == names[-1] == str(robot / "meshes/a.obj")
    assert names[-2] == "meshes/gone.stl"


def test_a_file_outside_of_the_package_is_named_by_its_path(robot: Path, tmp_path: Path) -> None:
    (tmp_path / "o.obj").write_text(TETRAHEDRON)
    (robot / "robot.yaml").write_text(
        "model: {link/name=a: {visual: {geometry: {mesh/filename=../o.obj: }}}}\n"
    )
    xml = build(robot / "robot.yaml", meshes="package://arm", output=robot / "urdf/o.urdf").xml()
    assert names_in(xml) == ["../../o.obj"]


def test_each_mesh_is_named_in_its_own_package_and_others_by_uris(
    robot: Path, tmp_path: Path
) -> None:
    (tmp_path / "tool").mkdir()
    (tmp_path / "tool/package.xml").write_text("<package><name>tool</name></package>")
    (tmp_path / "o o.obj").write_text(TETRAHEDRON)
    (tmp_path / "tool/t.obj").write_text(TETRAHEDRON)
    files = ["../o o.obj", "../tool/t.obj", str(robot / "meshes/a.obj"), "https://x.org/a.stl"]
    (robot / "robot.yaml").write_text(
        "model:\n"
        + "".join(
            f"- part: {{name: a{i}, joint: {{type: fixed, parent: root}},\n"
            f"         link: {{geometry: '{file}', visual: }}}}\n"
            for i, file in enumerate(files)
        )
        + "- link/name=root:\n"
    )
    names = names_in(build(robot / "robot.yaml", meshes="package://").xml())
    assert names == [
        f"file://{tmp_path}/o%20o.obj",
        "package://tool/t.obj",
        "package://arm/meshes/a.obj",
        "https://x.org/a.stl",
    ]
    (robot / "package.xml").unlink()
    names = names_in(build(robot / "robot.yaml", meshes="package://").xml())
    assert names[2] == f"file://{robot}/meshes/a.obj"


@pytest.mark.parametrize(
    ("how", "told"),
    [
        ("package://nowhere", "the package 'nowhere' is not found"),
        (
            "relativ",
            "'relativ' is not one of relative, keep, absolute, copy, package://NAME, package://",
        ),
    ],
)
def test_an_unknown_way_to_name_meshes_is_wrong_usage(
    robot: Path, capsys: pytest.CaptureFixture[str], how: str, told: str
) -> None:
    with pytest.raises(UsageError, match=re.escape(told)):
        build(robot / "robot.yaml", meshes=how)
    assert main([str(robot / "robot.yaml"), "--meshes", how]) == 2
    assert told in capsys.readouterr().err


def test_a_main_file_that_is_xml_is_treated_alike(robot: Path, tmp_path: Path) -> None:
    for name in ("c.urdf", "d.xacro"):
        xml = build(robot / "parts" / name, output=tmp_path / "o.urdf").xml()
        assert names_in(xml) == ["arm/parts/c.obj"]


def test_a_text_without_a_file_starts_at_the_working_directory(
    robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(robot)
    text = "robot: r\nmodel: {link/name=a: {visual: {geometry: {mesh/filename=parts/c.obj: }}}}\n"
    assert names_in(build("-", text=text).xml()) == ["parts/c.obj"]
    assert names_in(build("-", text=text, output="build/o.urdf").xml()) == ["../parts/c.obj"]


def test_other_documents_are_left_alone(robot: Path, tmp_path: Path) -> None:
    (robot / "world.yaml").write_text("sdf: {mesh/filename=parts/c.obj: }\n")
    xml = build(robot / "world.yaml", output=tmp_path / "o.sdf").xml()
    assert names_in(xml) == ["parts/c.obj"]


@pytest.mark.filterwarnings("ignore::yamaro.YamaroWarning")
def test_a_program_names_files_for_each_output_anew(robot: Path, tmp_path: Path) -> None:
    program = load(robot / "robot.yaml")
    first = program.build(output=tmp_path / "a.urdf").xml()
    assert names_in(first)[0] == "arm/meshes/a.obj"
    assert names_in(program.convert())[0] == "meshes/a.obj"
    assert program.build(output=tmp_path / "a.urdf").xml() == first


def test_a_path_that_is_passed_to_another_folder_starts_at_the_main_file(
    robot: Path, tmp_path: Path
) -> None:
    (robot / "lib").mkdir()
    (robot / "lib" / "link.yaml").write_text(
        "functions:\n  Link/parent:\n    input: mesh\n    body:\n"
        "    - part: {name: l, link: {geometry: $(mesh), mass: 1, visual: }}\n"
    )
    (robot / "arm.yaml").write_text(
        "model:\n- include: lib/link.yaml\n- Link: {mesh: meshes/a.obj}\n"
    )
    assert names_in(build(robot / "arm.yaml").xml()) == ["meshes/a.obj"]
    for mode in ("trusted", "safe"):
        built = build(robot / "arm.yaml", output=tmp_path / "o.urdf", policy=Policy(mode))
        assert names_in(built.xml()) == ["arm/meshes/a.obj"]
        assert built.meshes == [str(robot / "meshes/a.obj")]


def test_a_path_through_a_symbolic_link_that_leads_elsewhere_is_written_anew(
    robot: Path, tmp_path: Path
) -> None:
    (tmp_path / "far" / "away").mkdir(parents=True)
    (robot / "urdf").symlink_to(tmp_path / "far" / "away")
    (robot / "parts/up.yaml").write_text(
        "model: {link/name=a: {visual: {geometry: {mesh/filename=../meshes/a.obj: }}}}\n"
    )
    xml = build(robot / "parts/up.yaml", output=robot / "urdf" / "o.urdf").xml()
    assert names_in(xml) == ["../../arm/meshes/a.obj"]
