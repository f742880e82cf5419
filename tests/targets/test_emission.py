"""Builds in output formats: runs of the file, losses, what is beside the document; by a stub."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.targets.stub import write_with_stub
from yamaro import Policy, UsageError, YamaroError, build, load
from yamaro.sandbox.jail import check_available

if TYPE_CHECKING:
    from yamaro.targets.losses import Loss

ROBOT = """\
base: fixed
model:
- part: {name: base, link: {geometry: box, scale: 1 1 1, mass: 2}}
- part:
    name: arm
    link: {geometry: box, scale: 1 1 1, mass: 1}
    joint: {parent: base, type: revolute, axis: z, limit: {upper: 1, effort: 1, velocity: 1}}
"""


@pytest.fixture(autouse=True)
def _formats(monkeypatch: pytest.MonkeyPatch) -> None:
    write_with_stub(monkeypatch)


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT, encoding="utf-8")
    return path


def put(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


# --- one format -------------------------------------------------------------------------------


def test_a_build_for_a_format_has_its_document_losses_and_assets(robot: Path) -> None:
    built = build(robot, target="mjcf")
    assert built.format == "mjcf"
    assert built.xml() == (
        '<?xml version="1.0"?>\n'
        '<mjcf name="robot" fixed="true" version="" meshes="true" repairs="false">\n'
        '  <body name="base_link"/>\n  <body name="arm_link"/>\n</mjcf>\n'
    )
    assert built.root_name == "mjcf"
    assert built.root.elements()[1].span.location()[0] == 6
    assert list(built.robot.joints) == ["arm_joint"]
    assert built.assets == {"assets/arm-12.stl": b"\0\1"}
    assert built.file_name == ""
    assert [(loss.kind, loss.what, loss.owner) for loss in built.losses] == [
        ("lost", "joints", "joint 'arm_joint'")
    ]
    assert list(built.outputs) == ["mjcf"]


def test_losses_of_a_kind_are_one_warning_with_the_other_places_as_notes(tmp_path: Path) -> None:
    text = ROBOT + (
        "- part: {name: leg, joint: {parent: base, type: fixed}}\n"
        "- part: {name: foot, joint: {parent: leg, type: fixed}}\n"
    )
    built = build(put(tmp_path / "robot.yaml", text), target="sdf")
    (warning,) = built.warnings
    assert warning.code == "lost-in-sdf"
    assert warning.message == "joints are lost in SDF: joint 'arm_joint' and 2 others"
    assert warning.hint == "use links"
    assert [note.partition(", at ")[0] for note in warning.notes] == [
        "also joint 'leg_joint'",
        "also joint 'foot_joint'",
    ]
    assert warning.span.location()[0] == 7


ALL_LOSSES = {
    "sdf": ["approximated-in-sdf", "renamed-in-sdf"],
    "mjcf": ["approximated-in-mjcf", "renamed-in-mjcf"],
    "usd": ["approximated-in-usd", "renamed-in-usd"],
}


@pytest.mark.parametrize("format", ["sdf", "mjcf", "usd"])
def test_what_is_approximated_and_renamed_is_said_too(tmp_path: Path, format: str) -> None:
    text = "base: fixed\nmodel:\n- link/name=square: {}\n"
    built = build(put(tmp_path / "robot.yaml", text), target=format)
    assert [each.code for each in built.warnings] == ALL_LOSSES[format]
    assert [each.message for each in built.warnings] == [
        f"squares are approximated in {format.upper()} by circles: link 'square'",
        f"shapes are renamed in {format.upper()}: link 'square' to 'circle'",
    ]


def test_losses_are_errors_if_strict_or_denied_unless_they_are_allowed(robot: Path) -> None:
    with pytest.raises(YamaroError, match=r"error\[lost-in-mjcf\]"):
        build(robot, target="mjcf", strict=True)
    with pytest.raises(YamaroError, match=r"error\[lost-in-mjcf\]"):
        build(robot, target="mjcf", deny=["lost-in-mjcf"])
    assert build(robot, target="mjcf", strict=True, allow=["lost-in-mjcf"]).xml()
    with pytest.raises(YamaroError):
        build(robot, target="sdf", strict=True, allow=["lost-in-mjcf"])


def test_a_writer_refuses_with_an_error(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", "model:\n- link/name=refused: {}\n")
    with pytest.raises(YamaroError, match="massless-moving"):
        build(path, target="mjcf")
    assert build(path).xml()


def test_what_is_not_a_robot_cannot_be_written_in_a_format(tmp_path: Path) -> None:
    path = put(tmp_path / "world.yaml", "world: {}\n")
    with pytest.raises(YamaroError, match="not-urdf"):
        build(path, target="sdf")


def test_the_other_arguments_reach_the_writer(robot: Path) -> None:
    program = load(robot)
    root = program.build(
        target="sdf", base="fixed", repair_inertia=True, sdf_version="1.9", meshes="none"
    ).root
    assert root.attributes == {
        "name": "robot",
        "fixed": "true",
        "version": "1.9",
        "meshes": "false",
        "repairs": "true",
    }


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"target": "mjfc"}, "'mjfc' is not a known output format; did you mean 'mjcf'?"),
        ({"target": []}, "no output format is named"),
        ({"target": "sdf", "base": "loose"}, "'loose' is not a known base"),
        ({"target": "sdf", "sdf_version": "1.7"}, "'1.7' is not a known version of SDF"),
    ],
)
def test_what_is_unknown_is_wrong_usage(robot: Path, options: dict[str, str], message: str) -> None:
    with pytest.raises(UsageError) as error:
        build(robot, **options)  # type: ignore[arg-type]
    assert message in str(error.value)


# --- the base ---------------------------------------------------------------------------------

MASSIVE = "model:\n- part: {name: base, link: {geometry: sphere, radius: 1, mass: 1}}\n"
WHEEL = "- part: {name: wheel, joint: {type: continuous, parent: base, axis: y}}\n"


@pytest.mark.parametrize(
    ("text", "is_fixed"),
    [
        (MASSIVE, "true"),
        (MASSIVE + WHEEL, "false"),
        ("model:\n- link/name=base: {}\n", "true"),
        ("model:\n- part: {name: 'a b', link: {geometry: sphere, radius: 1, mass: 1}}\n", "true"),
        (
            "model:\n- part: {name: 'a world', link: {geometry: sphere, radius: 1, mass: 1}}\n",
            "true",
        ),
        (
            "base: fixed\n" + MASSIVE,
            "true",
        ),
        ("base: free\nmodel:\n- part: {name: base}\n", "false"),
    ],
)
def test_the_base_is_fixed_as_the_robot_says(tmp_path: Path, text: str, is_fixed: str) -> None:
    path = put(tmp_path / "robot.yaml", text)
    assert build(path, target="mjcf").root.attributes["fixed"] == is_fixed
    assert build(path, target="mjcf", base="free").root.attributes["fixed"] == "false"
    assert build(path, target="mjcf", base="fixed").root.attributes["fixed"] == "true"


# --- names of files ---------------------------------------------------------------------------


BARE = "robot: r\nmodel:\n- link/name=a:\n"


@pytest.mark.parametrize("ending", ["urdf", "yaml"])
def test_hints_are_in_the_language_of_the_file(tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"r.{ending}"
    file.write_text('<robot name="r"><link name="a"/></robot>' if ending == "urdf" else BARE)
    built = build(file, target="mjcf")
    (assumed,) = [each for each in built.warnings if each.code == "base-assumed"]
    assert assumed.hint is not None
    assert ("'base: fixed'" in assumed.hint) == (ending == "yaml")
    assert "--base" in assumed.hint


def test_files_beside_a_document_know_its_name(robot: Path, tmp_path: Path) -> None:
    built = build(robot, target="mjcf", output=tmp_path / "arm.xml")
    assert built.file_name == "arm.xml"
    assert b"file='arm.xml'" in built.assets["scene.xml"]
    many = build(robot, target=["urdf", "mjcf", "usd"], output=f"{tmp_path}/out/")
    assert [each.file_name for each in many.outputs.values()] == [
        "robot.urdf",
        "robot.xml",
        "robot.usda",
    ]


@pytest.mark.parametrize(
    ("name", "file_name"),
    [("a b", "a b.sdf"), ("../x", "main.sdf"), (".x", "main.sdf"), ("x" * 300, "main.sdf")],
)
def test_a_file_is_called_like_the_robot_if_it_can_be(
    tmp_path: Path, name: str, file_name: str
) -> None:
    path = put(tmp_path / "main.yaml", f"robot: {name!r}\nmodel:\n- link/name=a: {{}}\n")
    assert build(path, target="sdf", output=f"{tmp_path}/").file_name == file_name


# --- several formats --------------------------------------------------------------------------

COUNTING = """\
variables: {}
process: |-
  import itertools, random
  number = random.random()
  print(f"made {number > 1}")
model:
- link/name=base: {<x number="$(number)"/>: }
"""


def test_several_formats_have_a_build_each(robot: Path) -> None:
    built = build(robot, target=["urdf", "mjcf", "sdf"])
    assert list(built.outputs) == ["urdf", "mjcf", "sdf"]
    assert built.outputs["urdf"] is built
    assert built.xml() == build(robot).xml()
    assert built.outputs["mjcf"].xml() == build(robot, target="mjcf").xml()
    assert [warning.code for warning in built.warnings] == ["lost-in-mjcf", "lost-in-sdf"]
    also = build(robot, target=["usd", "srdf"])
    assert [warning.code for warning in also.warnings] == ["lost-in-usd", "lost-in-srdf"]


def test_the_file_runs_once_if_nothing_depends_on_the_format(tmp_path: Path) -> None:
    text = "model:\n- process: print('run')\n- link/name=base: {}\n"
    said: list[str] = []
    path = put(tmp_path / "robot.yaml", text)
    build(path, target=["urdf", "sdf", "mjcf", "srdf"], on_message=said.append)
    assert said == ["run"]


@pytest.mark.parametrize(
    "reads",
    ["print: $('' and target)", "mjcf: {<x>: }", "process: eval('target')"],
    ids=["name", "block", "eval"],
)
def test_the_file_runs_for_each_format_if_something_does(tmp_path: Path, reads: str) -> None:
    counter = tmp_path / "runs"
    text = (
        f"model:\n- process: |-\n    with open({str(counter)!r}, 'a') as file: file.write('x')\n"
        f"- {reads}\n"
        "- process: print('run')\n- link/name=base: {}\n"
    )
    said: list[str] = []
    path = put(tmp_path / "robot.yaml", text)
    build(path, target=["urdf", "sdf", "mjcf", "srdf"], on_message=said.append)
    assert counter.read_text() == "xxx"  # SRDF goes with the URDF
    assert [line for line in said if line] == ["run"]


def test_target_is_the_word_of_the_format(tmp_path: Path) -> None:
    text = "model:\n- link/name=$(target): {}\n"
    built = build(put(tmp_path / "robot.yaml", text), target=["sdf", "mjcf", "srdf", "urdf"])
    names = {name: list(each.robot.links) for name, each in built.outputs.items()}
    assert names == {"sdf": ["sdf"], "mjcf": ["mjcf"], "srdf": ["urdf"], "urdf": ["urdf"]}


def test_the_errors_of_all_formats_are_reported_once(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", "base: fixed\nmodel:\n- link/name=refused: {}\n")
    with pytest.raises(YamaroError) as error:
        build(path, target=["urdf", "sdf", "mjcf"])
    assert [each.code for each in error.value.diagnostics] == ["massless-moving"]


LOOP = """\
model:
- part: {name: base, link: {geometry: sphere, radius: 1, mass: 1}}
- part:
    name: arm
    link: {geometry: sphere, radius: 1, mass: 1}
    joint: {parent: base, type: continuous, xyz: 0 0 1}
- loop: {name: bar, type: ball, between: [base, arm]}
"""


def test_a_loop_is_an_error_only_where_urdf_is_written_alone(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", LOOP)
    assert list(build(path, target="mjcf").robot.loops) == ["bar"]
    for target in (None, "urdf", ["urdf", "mjcf"]):
        assert "loops.yaml" in " ".join(build(path, target=target).assets)
        with pytest.raises(YamaroError, match=r"error\[lost-in-urdf\]"):
            build(path, target=target, alone=True)


# --- URDF by name -----------------------------------------------------------------------------

RICH = """\
states: {home: {arm: 0}}
groups: {arm: {links: [arm]}}
model:
- part: {name: base, link: {geometry: sphere, radius: 1, mass: 1, sensor/name=imu: {type: imu}}}
- part:
    name: arm
    link: {geometry: sphere, radius: 1, mass: 1, collision: {surface: {friction: 1}}}
    joint: {parent: base, type: continuous, actuator: {command: effort}}
"""


def test_urdf_by_name_says_what_it_cannot_hold(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", RICH)
    assert not build(path).warnings
    built = build(path, target="urdf")
    assert built.xml() == build(path).xml()
    assert [(loss.kind, loss.what) for loss in built.losses] == [
        ("approximated", "sensors"),
        ("lost", "surfaces"),
        ("lost", "actuators"),
        ("lost", "states"),
        ("lost", "groups"),
    ]
    assert [each.code for each in built.warnings].count("approximated-in-urdf") == 1
    assert [loss.what for loss in build(path, target="urdf", gazebo=True).losses] == [
        "actuators",
        "states",
        "groups",
    ]


# --- in a jail --------------------------------------------------------------------------------


@pytest.mark.parametrize("mode", ["jail", "safe"])
def test_a_jailed_build_is_the_same(robot: Path, mode: str) -> None:
    if mode == "jail" and check_available() is not None:
        pytest.skip("no jail here")
    for target in ("sdf", ["urdf", "mjcf", "usd"]):
        free = build(robot, target=target)
        jailed = build(robot, target=target, policy=Policy(mode))
        assert list(jailed.outputs) == list(free.outputs)
        for format, one in free.outputs.items():
            other = jailed.outputs[format]
            assert other.xml() == one.xml()
            assert other.format == format
            assert other.assets == one.assets
            assert [_loss(loss) for loss in other.losses] == [_loss(loss) for loss in one.losses]
            assert other.root_name == one.root_name
            assert list(other.robot.links) == list(one.robot.links)
        assert list(map(str, jailed.warnings)) == list(map(str, free.warnings))


def _loss(loss: Loss) -> tuple[object, ...]:
    return (loss.kind, loss.what, loss.owner, loss.how, loss.hint, loss.span.place())
