"""Files of other packages stay as they are, and are included, unless they are of one piece."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.against_xacro import is_same, moved
from tests.tools.migrate.test_xacro_migration import HEAD
from yamaro import YamaroError
from yamaro.commands.main import main
from yamaro.policy import Limits
from yamaro.tools.migrate.xacro.command import XacroMigration, migrate_robot
from yamaro.tools.migrate.xacro.layout import ALL
from yamaro.xml.reader import decode_xml

CAMERA = (
    '<xacro:arg name="cam_name" default="cam"/><xacro:arg name="sim" default="false"/>'
    '<joint name="$(arg cam_name)" type="fixed"><parent link="base"/>'
    '<child link="$(arg cam_name)_link"/><origin xyz="0 0 1" rpy="0 0 0"/></joint>'
    '<link name="$(arg cam_name)_link"/>'
    '<xacro:if value="$(arg sim)"><gazebo reference="$(arg cam_name)_link"/></xacro:if>'
)
INCLUDE = '<xacro:include filename="$(find cam)/urdf/cam.xacro"/>'
SIM = '<xacro:arg name="sim" default="false"/>'
BASE = '<link name="base"/>'


def workspace(folder: Path, robot: str, *arguments: str, **files: str) -> XacroMigration:
    """Migrate a robot of the package `bot` that includes files of `cam`; compare it."""
    named = {f"cam/urdf/{name}.xacro": text for name, text in files.items()}
    manifests = {
        f"{name}/package.xml": f"<package><name>{name}</name></package>" for name in ("bot", "cam")
    }
    migration = moved(folder, {**manifests, **named, "bot/urdf/r.xacro": robot}, "bot/urdf/r.xacro")
    assert migration.faults == []
    assert [str(each) for each in migration.differences] == []
    for given in ((), *((one,) for one in arguments)):
        assert is_same(folder, migration, *given), given
    return migration


def test_a_file_of_another_package_is_included_as_it_is_with_its_arguments(tmp_path: Path) -> None:
    others = ("sim:=true", "cam_name:=eye")
    made = workspace(tmp_path, SIM + INCLUDE + BASE, *others, cam=CAMERA).files
    assert list(made) == ["r.yaml"]
    assert "path: $(find cam)/urdf/cam.xacro" in made["r.yaml"]


def test_its_arguments_are_passed_on_through_files_that_it_includes(tmp_path: Path) -> None:
    inner = '<xacro:include filename="camera.xacro"/>'
    others = ("sim:=true", "cam_name:=eye")
    robot = SIM + INCLUDE + BASE
    assert list(workspace(tmp_path, robot, *others, cam=inner, camera=CAMERA).files) == ["r.yaml"]


def test_an_argument_in_eval_is_passed_on(tmp_path: Path) -> None:
    cam = '<link name="l"/><xacro:if value="$(eval kind == \'a\')"><a/></xacro:if>'
    robot = f'<xacro:arg name="kind" default="a"/>{INCLUDE}'
    made = workspace(tmp_path, robot, "kind:=b", cam=cam).files
    assert "kind: $(kind)" in made["r.yaml"]


def test_which_file_of_another_package_is_included_may_be_computed(tmp_path: Path) -> None:
    files = {name: f'<link name="{name}"/>' for name in ("front", "rear")}
    robot = (
        '<xacro:arg name="side" default="front"/>'
        '<xacro:include filename="$(find cam)/urdf/$(arg side).xacro"/>'
    )
    made = workspace(tmp_path, robot, "side:=rear", **files).files
    assert list(made) == ["r.yaml"]
    assert "include: $(find cam)/urdf/$(side).xacro" in made["r.yaml"]


def test_a_relative_path_to_another_package_is_that_of_the_package(tmp_path: Path) -> None:
    robot = '<xacro:include filename="../../cam/urdf/cam.xacro"/>'
    made = workspace(tmp_path, robot, cam=BASE).files
    assert "include: $(find cam)/urdf/cam.xacro" in made["r.yaml"]


@pytest.mark.parametrize(
    ("cam", "robot", "why"),
    [
        ('<xacro:macro name="m" params="n"><link name="${n}"/></xacro:macro><link name="l"/>',
         INCLUDE + '<xacro:m n="a"/>', "its macro 'm' is called"),
        ('<xacro:macro name="m" params="n"><link name="${n[0]}"/></xacro:macro>',
         INCLUDE + """<xacro:m n="${['a']}"/>""", "its macro 'm' is called"),
        ('<xacro:macro name="m" params="**b"><xacro:insert_block name="b"/></xacro:macro>',
         INCLUDE + '<xacro:m><b><link name="a"/></b></xacro:m>', "its macro 'm' is called"),
        ('<xacro:m n="a"/>',
         '<xacro:macro name="m" params="n"><link name="${n}"/></xacro:macro>' + INCLUDE,
         "it calls the macro 'm'"),
        ('<xacro:property name="size" value="2"/>',
         INCLUDE + '<link name="l${size}"/>', "its property 'size' is read"),
        ('<link name="l${size}"/>',
         '<xacro:property name="size" value="2"/>' + INCLUDE, "it reads the property 'size'"),
        ('<link name="l${size}"/>',
         f'<xacro:macro name="m" params="size">{INCLUDE}</xacro:macro><xacro:m size="3"/>',
         "it reads the property 'size'"),
        ('<xacro:property name="tip"><tip/></xacro:property>',
         INCLUDE + BASE + '<xacro:insert_block name="tip"/>', "its block 'tip' is inserted"),
        ('<xacro:arg name="n" default="x"/><a/>',
         INCLUDE + '<link name="$(arg n)"/>', "its argument 'n' is read by others"),
        ('<xacro:property name="q" value="2"/>',
         INCLUDE.replace("/>", ' ns="cam"/>') + '<link name="l${cam.q}"/>',
         "it is included in a namespace"),
    ],
)  # fmt: skip
def test_what_is_of_one_piece_comes_along(tmp_path: Path, cam: str, robot: str, why: str) -> None:
    migration = workspace(tmp_path, robot, cam=cam)
    assert list(migration.files) == ["r.yaml", "cam/urdf/cam.yaml"]
    assert list(migration.layout.brought.values()) == [why]


ARM = (
    '<xacro:macro name="arm" params="name tool:=hand reach:=${0.25*2} *origin">'
    '<joint name="${name}" type="fixed"><parent link="base"/><child link="${name}_link"/>'
    '<xacro:insert_block name="origin"/></joint>'
    '<link name="${name}_link"/><xacro:if value="${tool != \'hand\'}"><a b="${reach}"/></xacro:if>'
    "</xacro:macro>"
)


def test_a_macro_of_another_package_is_called_where_it_is(tmp_path: Path) -> None:
    robot = (
        f'<xacro:arg name="side" default="left"/><xacro:property name="y" value="0.5"/>{INCLUDE}'
        '<link name="base"/>'
        '<xacro:arm name="$(arg side)"><origin xyz="0 ${y} 0" rpy="0 0 0"/></xacro:arm>'
        '<xacro:macro name="more"><xacro:arm name="other" tool="gripper">'
        '<origin xyz="0 ${-y} 0" rpy="0 0 0"/></xacro:arm></xacro:macro><xacro:more/>'
    )
    migration = workspace(tmp_path, robot, "side:=top", cam=ARM)
    assert list(migration.files) == ["r.yaml", "call_arm.xacro"]
    assert migration.layout.brought == {}
    assert "name: $(side), origin_xyz: 0 $(y) 0" in migration.files["r.yaml"]
    assert "$(find cam)" not in migration.files["r.yaml"]
    assert (
        '<xacro:include filename="$(find cam)/urdf/cam.xacro"/>'
        in (migration.files["call_arm.xacro"])
    )


def test_a_macro_for_links_may_be_called_where_it_is(tmp_path: Path) -> None:
    red = (
        '<xacro:macro name="red"><material name="red"><color rgba="1 0 0 1"/></material>'
        "</xacro:macro>"
    )
    robot = (
        INCLUDE + '<link name="base"><visual><geometry><sphere radius="1"/></geometry><xacro:red/>'
        "</visual></link>"
    )
    migration = workspace(tmp_path, robot, cam=red)
    assert list(migration.files) == ["r.yaml", "call_red.xacro"]
    assert "include: call_red.xacro" in migration.files["r.yaml"]


def test_materials_of_a_package_are_no_reason_to_copy_it(tmp_path: Path) -> None:
    arm = '<material name="red"><color rgba="1 0 0 1"/></material>' + ARM
    robot = (
        INCLUDE + '<link name="base"/>'
        '<xacro:arm name="a"><origin xyz="0 0 0" rpy="0 0 0"/></xacro:arm>'
    )
    migration = workspace(tmp_path, robot, cam=arm)
    assert list(migration.files) == ["r.yaml", "call_arm.xacro"]
    assert "include: $(find cam)/urdf/cam.xacro" in migration.files["r.yaml"]


def test_a_macro_that_takes_a_value_from_its_caller_comes_along(tmp_path: Path) -> None:
    arm = '<xacro:macro name="m" params="side:=^"><link name="${side}"/></xacro:macro>'
    robot = f'<xacro:property name="side" value="left"/>{INCLUDE}<xacro:m/>'
    migration = workspace(tmp_path, robot, cam=arm)
    assert list(migration.files) == ["r.yaml", "cam/urdf/cam.yaml"]


def test_a_macro_comes_along_if_its_package_is_asked_for(tmp_path: Path) -> None:
    robot = f'{INCLUDE}{BASE}<xacro:arm name="a"><origin xyz="0 0 0" rpy="0 0 0"/></xacro:arm>'
    files = {
        "bot/package.xml": "<package><name>bot</name></package>",
        "cam/package.xml": "<package><name>cam</name></package>",
        "cam/urdf/cam.xacro": ARM,
        "bot/urdf/r.xacro": robot,
    }
    made = moved(tmp_path, files, "bot/urdf/r.xacro", wanted=("cam",)).files
    assert sorted(made) == ["cam/urdf/cam.yaml", "r.yaml"]


def test_the_same_constant_in_two_packages_ties_nothing(tmp_path: Path) -> None:
    constant = '<xacro:property name="PI" value="3.1415"/>'
    robot = constant + INCLUDE + '<link name="l${PI}"/>'
    made = workspace(tmp_path, robot, cam=constant + '<a a="${PI}"/>').files
    assert list(made) == ["r.yaml"]


def test_only_the_files_that_are_tied_come_along(tmp_path: Path) -> None:
    arm = (
        '<xacro:include filename="colors.xacro"/>'
        '<xacro:macro name="m" params="n"><link name="${n}"/></xacro:macro><link name="l"/>'
    )
    colors = '<material name="red"><color rgba="1 0 0 1"/></material>'
    migration = workspace(tmp_path, INCLUDE + '<xacro:m n="a"/>', cam=arm, colors=colors)
    assert list(migration.files) == ["r.yaml", "cam/urdf/cam.yaml"]
    assert "include: $(find cam)/urdf/colors.xacro" in migration.files["cam/urdf/cam.yaml"]


def command(folder: Path, *options: str) -> list[str]:
    workspace(folder, SIM + INCLUDE + BASE, cam=CAMERA)
    robot = str(folder / "in/bot/urdf/r.xacro")
    assert main(["migrate", robot, "-o", str(folder / "made"), *options]) == 0
    made = folder / "made"
    return sorted(str(path.relative_to(made)) for path in made.rglob("*.yaml"))


def test_options_bring_other_packages_along(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command(tmp_path) == ["r.yaml"]
    said = "included as it is: 1 file of the package 'cam'; --with cam migrates it"
    assert said in capsys.readouterr().err
    assert command(tmp_path, "--with", "cam", "--force") == ["cam/urdf/cam.yaml", "r.yaml"]
    assert command(tmp_path, "--all", "--force") == ["cam/urdf/cam.yaml", "r.yaml"]
    assert "cam" not in capsys.readouterr().err.replace("cam/", "")


def test_all_packages_may_be_asked_for(tmp_path: Path) -> None:
    files = {
        "bot/package.xml": "<package><name>bot</name></package>",
        "cam/package.xml": "<package><name>cam</name></package>",
        "cam/urdf/cam.xacro": CAMERA,
        "bot/urdf/r.xacro": SIM + INCLUDE + BASE,
    }
    made = moved(tmp_path, files, "bot/urdf/r.xacro", wanted=(ALL,)).files
    assert sorted(made) == ["cam/urdf/cam.yaml", "r.yaml"]


def test_a_property_may_name_the_package_of_a_file(tmp_path: Path) -> None:
    robot = (
        '<xacro:property name="own" value="bot"/>'
        '<xacro:macro name="other" params="own:=nowhere"><a n="${own}"/></xacro:macro>'
        '<xacro:include filename="$(find ${own})/urdf/base.xacro"/>'
    )
    files = {"bot/package.xml": "<package><name>bot</name></package>", "bot/urdf/r.xacro": robot}
    files["bot/urdf/base.xacro"] = BASE
    migration = moved(tmp_path, files, "bot/urdf/r.xacro")
    assert "include: base.yaml\n" in migration.files["r.yaml"]
    assert is_same(tmp_path, migration)


def test_a_file_that_a_build_would_install_elsewhere_is_found_with_the_folder_that_the_hint_names(
    tmp_path: Path,
) -> None:
    robot = tmp_path / "seven/description/urdf/r.xacro"
    other = tmp_path / "seven/description/control/c.xacro"
    for path, text in (
        (robot, '<xacro:include filename="$(find seven)/control/c.xacro"/><link name="a"/>'),
        (other, "<b/>"),
    ):
        path.parent.mkdir(parents=True)
        path.write_text(f"{HEAD}\n{text}\n</robot>\n")
    (tmp_path / "seven/package.xml").write_text("<package><name>seven</name></package>")
    source = decode_xml(robot.read_bytes(), name=robot.name, path=str(robot))
    with pytest.raises(YamaroError) as error:
        migrate_robot(source, str(tmp_path), arguments=(), packages={}, limits=Limits())
    hint = error.value.diagnostics[0].hint or ""
    assert hint.endswith(f"give --package seven:={tmp_path / 'seven/description'}")
    name, _, folder = hint.partition("--package ")[2].partition(":=")
    made = migrate_robot(
        source, str(tmp_path), arguments=(), packages={name: folder}, limits=Limits()
    )
    assert made.faults == []
