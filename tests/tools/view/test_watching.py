"""Files are seen to change, whatever way they are written; `yamaro watch` builds on each change."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.tools.view.conftest import ROOT
from tests.waiting import PATIENCE, wait_for
from yamaro.options import Options, UsageError
from yamaro.policy import Policy
from yamaro.rebuilding import FileWatch, Rebuilder, count_told, surroundings
from yamaro.tools.view.session import Session

ROBOT = "robot: one\nmodel:\n  include: more.yaml\n  link/name=base:\n"
MORE = (
    "model:\n  link/name=more:\n"
    "  joint/name=j, type=fixed:\n    parent/link=base:\n    child/link=more:\n"
)


def following(*paths: Path) -> FileWatch:
    watch = FileWatch()
    watch.follow(map(str, paths), since=time.time_ns() + 1_000_000_000)
    return watch


def test_a_file_that_stays_as_it_is_has_not_changed(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("a")
    watch = following(path)
    assert watch.changed() == [] and watch.changed() == []


def test_each_way_to_write_a_file_is_seen_once(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("a")
    watch = following(path)

    def rewrite() -> None:
        path.write_text("other")

    def replace() -> None:  # as editors do that write a new file first
        new = tmp_path / "a.yaml.new"
        new.write_text("wrote")
        os.replace(new, path)

    def keep_time() -> None:  # as `cp -p` and `git checkout` may
        before = path.stat()
        path.write_text("longer than before")
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))

    def remove() -> None:
        path.unlink()

    def appear() -> None:
        path.write_text("again")

    for change in (rewrite, replace, keep_time, remove, appear):
        change()
        assert watch.changed() == [str(path)], change.__name__
        assert watch.changed() == [], change.__name__


def test_a_file_that_is_changed_while_it_is_built_counts_as_changed(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("a")
    watch = FileWatch()
    watch.follow([str(path)], since=path.stat().st_mtime_ns - 1)
    assert watch.changed() == [str(path)]


def test_the_surroundings_are_the_sources_and_folders_that_are_not_hidden(tmp_path: Path) -> None:
    for name in ("robot.yaml", "parts/leg.yaml", "parts/arm.stl", ".git/config.yaml", "helper.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    found = {os.path.relpath(path, tmp_path) for path in surroundings(str(tmp_path / "robot.yaml"))}
    assert found == {".", "robot.yaml", "helper.py", "parts", os.path.join("parts", "leg.yaml")}


def rebuilder_of(path: Path) -> Rebuilder:
    return Rebuilder(str(path), Options(policy=Policy(), on_message=print))


def test_what_mjcf_and_sdf_are_made_of_is_followed_and_bodies_lead_to_their_lines(
    tmp_path: Path,
) -> None:
    points = ((0, 0, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1))
    sides = ((0, 1, 2), (0, 2, 3), (0, 3, 1), (2, 1, 3))
    corners = [
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*points[each]) for each in side)
        + "endloop\nendfacet\n"
        for side in sides
    ]
    (tmp_path / "tip.stl").write_text(f"solid tip\n{''.join(corners)}endsolid tip\n")
    (tmp_path / "assets.xml").write_text(
        '<mujoco><asset><mesh name="tip" file="tip.stl"/></asset></mujoco>'
    )
    (tmp_path / "arm.xml").write_text(
        '<mujoco model="arm">\n<include file="assets.xml"/>\n<worldbody>\n<body name="base">'
        '<geom type="mesh" mesh="tip"/></body>\n</worldbody>\n</mujoco>'
    )
    (tmp_path / "hand").mkdir()
    (tmp_path / "hand/model.config").write_text('<model><sdf version="1.9">hand.sdf</sdf></model>')
    (tmp_path / "hand/hand.sdf").write_text(
        '<sdf version="1.9"><model name="hand">\n<link name="base"><visual name="v">'
        "<geometry><mesh><uri>../tip.stl</uri></mesh></geometry></visual></link></model></sdf>"
    )
    (tmp_path / "cell.sdf").write_text(
        '<sdf version="1.9"><include><uri>model://hand</uri></include></sdf>'
    )
    for main, files, place in (
        ("arm.xml", ("arm.xml", "assets.xml", "tip.stl"), ("arm.xml", 4)),
        ("cell.sdf", ("cell.sdf", "hand/hand.sdf", "tip.stl"), ("hand/hand.sdf", 2)),
    ):
        session = Session(rebuilder_of(tmp_path / main), editor="none")
        assert session.build().build is not None
        state = json.loads(session.state())
        number = state["robot"]["links"]["base"]["place"]
        found = session.place(number, version=state["robotVersion"], is_fault=False)
        assert found is not None and found[:2] == (str(tmp_path / place[0]), place[1])
        rebuilder = rebuilder_of(tmp_path / main)
        rebuilder.build()
        for name in files:
            path = tmp_path / name
            path.write_text(path.read_text() + "\n")
            assert rebuilder.has_changed(), name
            rebuilder.build()
            assert not rebuilder.has_changed()


def test_a_build_follows_its_files_and_a_failed_one_its_surroundings(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    rebuilder = rebuilder_of(path)
    first = rebuilder.build()
    assert first.build is None and count_told(first.diagnostics) == "1 error"
    assert not rebuilder.has_changed()
    (tmp_path / "more.yaml").write_text(MORE)
    assert rebuilder.has_changed()
    assert rebuilder.build().build is not None
    (tmp_path / "notes.yaml").write_text("nobody reads this")
    assert not rebuilder.has_changed()
    (tmp_path / "more.yaml").write_text(MORE.replace("more", "most"))
    assert rebuilder.has_changed()
    assert 'name="most"' in rebuilder.build().build.xml()  # type: ignore[union-attr]


def test_a_main_file_that_is_gone_is_a_fault_later_on_and_wrong_usage_at_first(
    tmp_path: Path,
) -> None:
    path = tmp_path / "robot.yaml"
    with pytest.raises(UsageError, match="the file does not exist"):
        rebuilder_of(path).build()
    path.write_text("robot: one\nmodel:\n  link/name=base:\n")
    rebuilder = rebuilder_of(path)
    assert rebuilder.build().build is not None
    path.unlink()
    assert rebuilder.has_changed()
    gone = rebuilder.build()
    assert gone.build is None and "the file does not exist" in gone.fault
    path.write_text("robot: two\nmodel:\n  link/name=base:\n")
    assert rebuilder.has_changed()
    assert 'name="two"' in rebuilder.build().build.xml()  # type: ignore[union-attr]


def test_python_that_ends_the_program_does_not_end_the_watch(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text("robot: one\nimport: sys\nprocess: sys.exit(3)\nmodel:\n  link/name=base:\n")
    turn = rebuilder_of(path).build()
    assert [each.code for each in turn.diagnostics] == ["python-error"]


# --- the command --------------------------------------------------------------------------------


def test_watch_writes_on_each_save_and_tells_in_a_line(tmp_path: Path) -> None:
    path, output, log = tmp_path / "robot.yaml", tmp_path / "out.urdf", tmp_path / "log"
    path.write_text("robot: one\nmodel:\n  link/name=base:\n")
    with open(log, "w") as errors:
        process = subprocess.Popen(
            [sys.executable, "-m", "yamaro", "watch", "robot.yaml", "-o", "out.urdf"],
            cwd=tmp_path,
            stderr=errors,
            stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": str(ROOT / "src")},
        )
        wait_for(lambda: output.exists() and 'name="one"' in output.read_text())
        path.write_text("robot: two\nmodle:\n  link/name=base:\n")
        wait_for(lambda: "did you mean `model`?" in log.read_text())
        assert 'name="one"' in output.read_text()
        path.write_text("robot: two\nmodel:\n  link/name=base:\n")
        wait_for(lambda: 'name="two"' in output.read_text())
        wait_for(lambda: len(log.read_text().split("out.urdf written")) == 3)
        process.send_signal(signal.SIGINT)
        printed, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0 and printed == b""
    lines = [line[10:] for line in log.read_text().splitlines() if line[2:3] == line[5:6] == ":"]
    assert [line.partition(",")[0] for line in lines] == [
        "out.urdf written",
        "1 error; out.urdf is unchanged",
        "out.urdf written",
    ]


def test_watch_writes_for_gazebo_as_well(tmp_path: Path) -> None:
    path, output = tmp_path / "robot.yaml", tmp_path / "out.urdf"
    path.write_text("robot: one\nmodel:\n- part: {name: a, link: {sensor/name=b: {type: imu}}}\n")
    process = subprocess.Popen(
        [sys.executable, "-m", "yamaro", "watch", "robot.yaml", "-o", "out.urdf", "--gazebo"],
        cwd=tmp_path,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": str(ROOT / "src")},
    )
    wait_for(lambda: output.exists() and "<gazebo" in output.read_text())
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=PATIENCE) == 0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["robot.yaml"], "needs a file to write, as in '-o robot.urdf'"),
        (["robot.yaml", "-o", "-"], "needs a file to write, as in '-o robot.urdf'"),
        (["-", "-o", "out.urdf"], "needs a FILE with a name, to see it change"),
        (["robot.yaml", "-o", "robot.yaml"], "is one of the input files"),
        (["nothing.yaml", "-o", "out.urdf"], "the file does not exist"),
    ],
)
def test_watch_tells_wrong_usage_at_once(tmp_path: Path, arguments: list[str], said: str) -> None:
    (tmp_path / "robot.yaml").write_text("robot: one\nmodel:\n  link/name=base:\n")
    run = subprocess.run(
        [sys.executable, "-m", "yamaro", "watch", *arguments],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT / "src")},
    )
    assert run.returncode == 2 and said in run.stderr
