"""`--meshes copy` copies what a robot refers to beside the output; `none` leaves meshes out."""

import re
from pathlib import Path

import pytest

from yamaro import UsageError, build
from yamaro.commands.main import main
from yamaro.policy import Policy

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
COLLADA = (
    '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
    '<library_images><image id="i"><init_from>../textures/a%20b.png</init_from></image>'
    "</library_images></COLLADA>"
)
GLTF = '{"asset": {"version": "2.0"}, "buffers": [{"uri": "box.bin", "byteLength": 4}]}'


def names_in(xml: str) -> list[str]:
    return re.findall(r'filename="(.*?)"', xml)


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """Meshes of equal names in two folders, and some that refer to other files."""
    files = {
        "a/part.obj": TRIANGLE,
        "b/part.obj": TRIANGLE + "# another\n",
        "c/part.obj": TRIANGLE,
        "m/é x.obj": "mtllib x.mtl\n" + TRIANGLE,
        "m/x.mtl": "newmtl x\nmap_Kd tex/x.png\nmap_Ka gone.png\nmap_Kd /etc/hostname\n",
        "m/tex/x.png": "x",
        "d/meshes/d.dae": COLLADA,
        "d/textures/a b.png": "d",
        "g/box.gltf": GLTF,
        "g/box.bin": "1234",
        "skin.png": "skin",
    }
    for name, text in files.items():
        path = tmp_path / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    shapes = ["a/part.obj", "b/part.obj", "c/part.obj", "m/é x.obj", "d/meshes/d.dae", "g/box.gltf"]
    visuals = "".join(
        f"    - visual: {{geometry: {{mesh/filename={name}: }}}}\n"
        for name in [*shapes, "gone.stl"]
    )
    (tmp_path / "src/robot.yaml").write_text(
        "model:\n- material/name=m: {texture/filename=skin.png: }\n- link/name=a:\n" + visuals
        + "    - visual: {geometry: {box/size=1 1 1: }, material/name=m: }\n"
        + "    - collision: {geometry: {mesh/filename=a/part.obj: }}\n"
    )  # fmt: skip
    return tmp_path / "src/robot.yaml"


def test_what_a_robot_refers_to_is_copied_beside_the_output(robot: Path, tmp_path: Path) -> None:
    output = tmp_path / "out" / "robot.urdf"
    assert main(["-q", str(robot), "-o", str(output), "--meshes", "copy"]) == 0
    names = names_in(output.read_text())
    contents = [(output.parent / name).read_bytes() for name in names if name != "gone.stl"]
    source = robot.parent
    meant = ["skin.png", "a/part.obj", "b/part.obj", "c/part.obj", "m/é x.obj", "d/meshes/d.dae"]
    meant += ["g/box.gltf", "a/part.obj"]
    assert contents == [(source / name).read_bytes() for name in meant]
    assert names[1] == names[3] != names[2]  # by content
    object_folder = (output.parent / names[4]).parent
    assert (object_folder / "x.mtl").is_file()
    assert (object_folder / "tex/x.png").read_text() == "x"
    assert ((output.parent / names[5]).parent / "../textures/a b.png").read_text() == "d"
    assert ((output.parent / names[6]).parent / "box.bin").read_text() == "1234"
    written = [path for path in (tmp_path / "out").rglob("*") if path.is_file()]
    assert len(written) == 1 + 3 + 3 + 2 + 2


@pytest.mark.parametrize("mode", ["safe", "jail"])
@pytest.mark.parametrize("has_root", [True, False])
def test_copies_are_the_same_for_files_that_are_not_trusted(
    robot: Path, tmp_path: Path, mode: str, has_root: bool
) -> None:
    output = tmp_path / "o.urdf"
    expected = build(robot, output=output, meshes="copy")
    found = build(robot, output=output, meshes="copy", policy=Policy(mode), has_root=has_root)
    assert found.xml() == expected.xml()
    assert found.assets == expected.assets
    assert not list(tmp_path.glob("assets"))


def test_a_file_out_of_reach_that_a_mesh_names_is_not_copied(tmp_path: Path) -> None:
    (tmp_path / "secret.mtl").write_text("newmtl s\n")
    (tmp_path / "src").mkdir()
    (tmp_path / "src/a.obj").write_text("mtllib ../secret.mtl\n" + TRIANGLE)
    path = tmp_path / "src/r.yaml"
    path.write_text("model: {link/name=a: {visual: {geometry: {mesh/filename=a.obj: }}}}\n")
    for mode, count in (("trusted", 2), ("safe", 1), ("jail", 1)):
        built = build(path, output=tmp_path / "o.urdf", meshes="copy", policy=Policy(mode))
        assert len(built.assets) == count


def test_copies_are_not_copied_under_other_names(robot: Path, tmp_path: Path) -> None:
    first, second = tmp_path / "1" / "r.urdf", tmp_path / "2" / "r.urdf"
    assert main(["-q", str(robot), "-o", str(first), "--meshes", "copy"]) == 0
    assert main(["-q", str(first), "-o", str(second), "--meshes", "copy"]) == 0
    flat = [name for name in names_in(second.read_text()) if name.count("/") == 1]
    assert flat == [name for name in names_in(first.read_text()) if name.count("/") == 1]
    assert main(["-q", str(robot), "-o", str(first), "--meshes", "copy"]) == 0


def test_a_file_that_differs_is_not_overwritten(
    robot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "out" / "robot.urdf"
    assert main(["-q", str(robot), "-o", str(output), "--meshes", "copy"]) == 0
    copy = output.parent / names_in(output.read_text())[0]
    copy.write_text("mine")
    output.write_text("old")
    capsys.readouterr()
    assert main(["-q", str(robot), "-o", str(output), "--meshes", "copy"]) == 1
    assert "another file has that name" in capsys.readouterr().err
    assert (copy.read_text(), output.read_text()) == ("mine", "old")


def test_nothing_is_copied_where_the_robot_has_errors(robot: Path, tmp_path: Path) -> None:
    robot.write_text(robot.read_text() + "- link/name=a:\n")
    output = tmp_path / "out" / "robot.urdf"
    assert main(["-q", str(robot), "-o", str(output), "--meshes", "copy"]) == 1
    assert not output.parent.exists()


def test_copies_need_an_output_file(robot: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for options in ([], ["-o", "-"], ["-o", "/dev/null"]):
        assert main(["-q", str(robot), "--meshes", "copy", *options]) == 2
        assert "needs" in capsys.readouterr().err
    with pytest.raises(UsageError, match="'copy' needs an output file"):
        build(robot, meshes="copy")


def test_meshes_can_be_left_out(robot: Path) -> None:
    for mode in ("trusted", "jail"):
        xml = build(robot, meshes="none", policy=Policy(mode)).xml()
        assert names_in(xml) == ["skin.png"]
        assert xml.count("<visual>") == 1
        assert "<collision>" not in xml
