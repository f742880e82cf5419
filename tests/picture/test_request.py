"""What the options of `yamaro picture` mean, and what is said of wrong ones."""

from math import pi, radians
from pathlib import Path

import pytest

from tests.model.robots import JOINTS
from tests.tools_there import needs
from yamaro import Robot, build
from yamaro.commands.command_table import all_commands
from yamaro.commands.main import main
from yamaro.commands.option_table import options_of
from yamaro.options import UsageError
from yamaro.picture.request import NAMED_VIEWS, SHOWN, Request, moments, read_positions, swung


def request(output: str = "a.png", lists: dict[str, list[str]] | None = None, **options: str):
    named = {name.replace("_", "-"): value for name, value in options.items()}
    return Request(output, named, lists or {})


def test_a_still_and_a_film_have_their_usual_sizes() -> None:
    assert (request().width, request().height) == (800, 600)
    film = request("a.gif", turn="")
    assert (film.width, film.height) == (480, 360)


def test_views_are_names_and_angles() -> None:
    found = request(lists={"view": ["front,top", "30,-20.5"]}).views
    assert [(view.azimuth, view.elevation, view.is_flat) for view in found] == [
        (0.0, 0.0, True),
        (180.0, 90.0, True),
        (30.0, -20.5, False),
    ]


@pytest.mark.parametrize(
    ("output", "options", "said"),
    [
        ("a.bmp", {}, "names no kind of picture: .png, .jpg, .gif"),
        ("a", {}, "names no kind of picture"),
        ("a.gif", {}, "a .gif is a film: add '--turn' or '--sweep all'"),
        ("a.png", {"turn": ""}, "'--turn' makes a film: name it .gif"),
        ("a.png", {"seconds": "2"}, "'--seconds' makes a film"),
        ("a.jpg", {"transparent": ""}, "a .jpg cannot be transparent: name it .png or .gif"),
        ("a.png", {"size": "800"}, "'--size' takes WIDTHxHEIGHT, as in 800x600, not '800'"),
        ("a.png", {"size": "8x600"}, "'--size' takes 16 to 4096 pixels along a side"),
        ("a.gif", {"turn": "", "seconds": "0"}, "'--seconds' takes a number above 0, not '0'"),
        ("a.gif", {"turn": "", "seconds": "nan"}, "takes a number above 0, not 'nan'"),
        ("a.gif", {"turn": "", "frames-per-second": "x"}, "takes a number above 0, not 'x'"),
    ],
)
def test_options_that_make_no_sense_are_refused(
    output: str, options: dict[str, str], said: str
) -> None:
    with pytest.raises(UsageError) as caught:
        Request(output, options, {})
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("lists", "said"),
    [
        ({"view": ["fornt"]}, "there is no view 'fornt'; did you mean 'front'?"),
        ({"view": ["1,2,3"]}, "azimuth and elevation in degrees, as in 30,20"),
        ({"view": ["0,91"]}, "the elevation is from -90 to 90"),
        ({"show": ["visuals"]}, "'--show' knows no 'visuals'; did you mean 'visual'?"),
        ({"joints": ["turn"]}, "'--joints' takes NAME=POSITION, not 'turn'"),
        ({"joints": ["=1"]}, "'--joints' takes NAME=POSITION, not '=1'"),
    ],
)
def test_lists_that_make_no_sense_are_refused(lists: dict[str, list[str]], said: str) -> None:
    with pytest.raises(UsageError) as caught:
        Request("a.png", {}, lists)
    assert said in str(caught.value)


def test_joint_positions_are_read() -> None:
    asked = request(lists={"joints": ["turn=0.5, spin=-1e1", "slide=.25"]})
    found = read_positions(asked, Robot.from_xml(JOINTS))
    assert found == {"turn": 0.5, "spin": -10.0, "slide": 0.25}


def test_joint_positions_may_have_units() -> None:
    asked = request(lists={"joints": ["turn=-45deg,slide=25 mm", "spin=0.5rev"]})
    found = read_positions(asked, Robot.from_xml(JOINTS))
    assert found == {"turn": -radians(45), "slide": 0.025, "spin": pi}


STATES = """
robot: arm
model:
- part: {name: base}
- part:
    name: j2
    joint:
      {type: revolute, parent: base, limit: {lower: -90deg, upper: 90deg, effort: 1, velocity: 1}}
- part:
    name: j3
    joint:
      {type: prismatic, parent: j2, limit: {lower: 1cm, upper: 3cm, effort: 1, velocity: 1}}
states:
  home: {j2: -30deg}
  up: {j2: 60deg, j3: 3cm}
"""


@pytest.mark.parametrize(
    ("options", "joints", "expected"),
    [
        ({}, [], {"j2_joint": -radians(30), "j3_joint": 0.02}),
        ({"state": "home"}, ["j2=-45deg"], {"j2_joint": -radians(45), "j3_joint": 0.02}),
        ({"state": "up"}, [], {"j2_joint": radians(60), "j3_joint": 0.03}),
        ({"state": "up"}, ["j3_joint=0.5in"], {"j2_joint": radians(60), "j3_joint": 0.0127}),
        ({"state": "zero"}, [], {"j2_joint": 0, "j3_joint": 0.02}),
    ],
)
def test_a_robot_is_shown_in_a_state_with_joints_on_top(
    options: dict[str, str], joints: list[str], expected: dict[str, float]
) -> None:
    robot = build("arm.yaml", text=STATES).robot
    asked = request(**options, lists={"joints": joints})
    assert read_positions(asked, robot) == pytest.approx(expected, abs=1e-12)


def test_a_state_that_there_is_not_is_refused_with_a_suggestion() -> None:
    robot = build("arm.yaml", text=STATES).robot
    with pytest.raises(UsageError, match="has no state 'hoem'; did you mean 'home'"):
        read_positions(request(state="hoem"), robot)
    with pytest.raises(UsageError, match="'--state home' shows a named state"):
        request(lists={"joints": ["home"]})


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("trun=1", "the robot has no joint 'trun'; did you mean 'turn'?"),
        ("xyz=1", "the robot has no joint 'xyz'; those that move are turn, spin, slide"),
        ("turn=far", "give its position as one number, in radians or as 90deg, not 'far'"),
        ("slide=inf", "give its position as one number, in metres or as 30mm, not 'inf'"),
        ("slide=90deg", "not '90deg'; that is an angle, and not a length"),
        ("turn=3mm", "not '3mm'; that is a length, and not an angle"),
        ("turn=1e300", "the joint 'turn' cannot be drawn at '1e300'"),
        ("follow=1", "the joint 'follow' mimics 'turn': move that one"),
        ("hold=1", "the joint 'hold' is fixed: it has no position to set"),
        ("drift=1", "the joint 'drift' is planar: it has no position to set"),
    ],
)
def test_joints_that_cannot_be_moved_are_refused(text: str, said: str) -> None:
    asked = request(lists={"joints": [text]})
    with pytest.raises(UsageError) as caught:
        read_positions(asked, Robot.from_xml(JOINTS))
    assert said in str(caught.value)


def test_a_sweep_begins_and_ends_at_rest_and_touches_both_limits() -> None:
    turn = Robot.from_xml(JOINTS).joints["turn"]
    assert swung(turn, 0, 0.0) == pytest.approx(0)
    assert swung(turn, 0.25, 0.0) == pytest.approx(2)
    assert swung(turn, 0.5, 0.0) == pytest.approx(0)
    assert swung(turn, 0.75, 0.0) == pytest.approx(-1)
    assert swung(turn, 0.75, 0.5) == pytest.approx(-1)


def test_a_continuous_joint_is_swept_by_one_turn() -> None:
    spin = Robot.from_xml(JOINTS).joints["spin"]
    assert swung(spin, 0.5, 1.0) == pytest.approx(1 + 3.141592653589793)


def test_each_joint_is_swept_in_its_turn() -> None:
    robot = Robot.from_xml(JOINTS)
    found = moments(request("a.gif", sweep="each"), robot, {})
    assert len(found) == 3 * 2 * 20, "three joints, two seconds each, twenty frames a second"
    moved = [[name for name, p in each.positions.items() if abs(p) > 1e-9] for each in found]
    assert [moved[number] for number in (10, 50, 90)] == [["turn"], ["spin"], ["slide"]]


def test_all_joints_are_swept_at_once() -> None:
    robot = Robot.from_xml(JOINTS)
    quarter = moments(request("a.gif", sweep="all", seconds="4"), robot, {})[20]
    assert quarter.positions == pytest.approx({"turn": 2, "spin": 1.5707963, "slide": 0.4})


def test_a_film_has_an_end() -> None:
    robot = Robot.from_xml(JOINTS)
    with pytest.raises(UsageError, match="3,000 are the most"):
        moments(request("a.gif", turn="", seconds="151"), robot, {})


def test_a_robot_that_cannot_move_cannot_be_swept() -> None:
    robot = Robot.from_xml('<robot name="r"><link name="a"/></robot>')
    with pytest.raises(UsageError, match="no joint that moves"):
        moments(request("a.gif", sweep="all"), robot, {})


@pytest.fixture
def robot(tmp_path: Path) -> str:
    path = tmp_path / "robot.urdf"
    path.write_text('<robot name="r"><link name="a"/></robot>')
    return str(path)


@needs("picture")
def test_a_picture_needs_a_file_to_write(robot: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["picture", robot]) == 2
    assert "'yamaro picture' needs an output file: -o robot.png" in capsys.readouterr().err


@needs("picture")
def test_what_is_wrong_with_a_picture_is_told_before_the_robot_is_read(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["picture", "none.yaml", "-o", "a.png", "--size", "0x0"]) == 2
    assert "'--size'" in capsys.readouterr().err


@needs("picture")
def test_picture_options_mean_nothing_to_other_commands(
    robot: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", robot, "--turn"]) == 2
    assert "'--turn' cannot be used with 'yamaro check'" in capsys.readouterr().err


@needs("picture")
@pytest.mark.parametrize("module", ["vtkmodules", "PIL", "trimesh"])
def test_a_missing_package_tells_what_to_install(
    module: str,
    robot: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    import importlib.util

    find = importlib.util.find_spec
    monkeypatch.setattr(
        "importlib.util.find_spec", lambda name: None if name == module else find(name)
    )
    assert main(["picture", robot, "-o", str(tmp_path / "a.png")]) == 1
    error = capsys.readouterr().err
    assert "error[missing-extra]: a picture needs yamaro[picture]" in error
    assert "pip install 'yamaro[picture]'" in error


@needs("picture")
def test_a_vtk_that_would_end_the_process_is_refused(
    robot: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: object())
    monkeypatch.setattr("importlib.metadata.version", lambda name: "9.5.2")
    assert main(["picture", robot, "-o", "a.png"]) == 1
    assert "needs vtk 9.6 or newer, and this is 9.5" in capsys.readouterr().err


@needs("picture")
def test_help_of_pictures_tells_of_its_options(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["picture", "--help"]) == 0
    text = capsys.readouterr().out
    for option in ("--size", "--view", "--joints", "--show", "--turn", "--sweep"):
        assert option in text


@needs("picture")
def test_a_shell_offers_the_views_and_what_can_be_shown() -> None:
    offered = {option.name: option.completes for option in options_of(all_commands()["picture"])}
    assert set(offered["view"].split()) == set(NAMED_VIEWS)
    assert set(offered["show"].split()) == set(SHOWN)
