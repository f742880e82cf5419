"""`yamaro diff`: files and revisions of git, its output and exit status, and as a driver of git."""

from __future__ import annotations

import json
import os
import random
import shutil
import subprocess
import sys
from math import isfinite
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from tests.model.test_changes import ARM, changed
from yamaro.commands.main import main
from yamaro.tools.diff.sides import Checkout, GitError, Repository, split_revision

EXAMPLES = Path(__file__).parents[2] / "examples"

needs_git = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty working directory."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty repository, which is the working directory; no settings of the user count."""
    for name in [name for name in os.environ if name.startswith("GIT_")]:
        monkeypatch.delenv(name)
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setenv("GIT_CONFIG_NOSYSTEM", "1")
    git("init", "-q")
    git("config", "user.name", "Somebody")
    git("config", "user.email", "somebody@example.org")
    return folder


def git(*words: str) -> str:
    done = subprocess.run(["git", *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def commit(message: str = "a change") -> None:
    git("add", "-A")
    git("commit", "-q", "-m", message)


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(["diff", *words])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def write(**files: str) -> None:
    for name, text in files.items():
        Path(name.replace("_", ".")).write_text(text, encoding="utf-8")


# --- files ---


def test_robots_that_mean_the_same_give_no_output(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(a_urdf=ARM, b_urdf=changed(('damping="0.1"', 'damping="1e-1"')))
    assert outcome(capsys, "a.urdf", "b.urdf") == (0, "", "")


def test_each_change_is_a_line_with_its_places_and_what_follows(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new = changed(
        ('upper="1.2"', 'upper="1.57"'),
        ('xyz="0 0 0.4"', 'xyz="0 0 0.41"'),
        ('<mass value="5"/>', '<mass value="5.2"/>'),
        ('"tool"', '"tip"'),
    )
    write(a_urdf=ARM, b_urdf=new)
    status, out, err = outcome(capsys, "a.urdf", "b.urdf")
    assert (status, err) == (1, "")
    assert (
        out
        == """\
--- a.urdf
+++ b.urdf
links
  ~ base  mass 5 → 5.2 kg (+4 %)  (line 5)
  > tool  → tip  (line 27)
joints
  ~ shoulder  limit.upper 1.2 → 1.57 rad  (line 31)
  ~ elbow  origin xyz 0 0 0.4 → 0 0 0.41 (moved 10 mm)  (line 35)
        moves 3 links, the furthest by 10 mm: lower, hand, tool
total mass: 7.5 → 7.7 kg
centre of mass: moved 1.56 mm
moves the same: no, 'lower' is 10 mm away with all joints at zero
"""
    )


def test_the_centre_of_mass_moved_as_far_as_computed_by_hand() -> None:
    """The links at zero: 5 kg at 0; 1.5 kg at 0.05 + 0.2; 1 kg at 0.05 + 0.4, or 0.41."""
    before = (1.5 * 0.25 + 1 * 0.45) / 7.5
    after = (1.5 * 0.25 + 1 * 0.46) / 7.7
    assert f"{abs(before - after) * 1000:.3g}" == "1.56"


def test_the_same_change_of_several_things_is_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(a_urdf=ARM, b_urdf=changed(('velocity="2"', 'velocity="3"')))
    out = outcome(capsys, "a.urdf", "b.urdf")[1]
    assert "  ~ shoulder, elbow  limit.velocity 2 → 3 rad/s\n" in out
    assert "moves the same: yes\n" in out


def test_what_is_added_is_listed_with_what_is_below_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cut = ARM.index('  <link name="hand">'), ARM.index('  <joint name="shoulder"')
    joints = ARM.index('  <joint name="wrist"'), ARM.index("  <transmission")
    write(a_urdf=ARM[: cut[0]] + ARM[cut[1] : joints[0]] + ARM[joints[1] :], b_urdf=ARM)
    out = outcome(capsys, "a.urdf", "b.urdf")[1]
    assert "  + hand  on lower by wrist (continuous)  (line 26)\n" in out
    assert "        and the link below it: tool\n" in out
    assert "joints" not in out
    back = outcome(capsys, "b.urdf", "a.urdf")[1]
    assert "  - hand  on lower by wrist (continuous)  (line 26)\n" in back


def test_a_summary_counts(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(a_urdf=ARM, b_urdf=changed(('velocity="2"', 'velocity="3"'), ('"tool"', '"tip"')))
    status, out, _ = outcome(capsys, "a.urdf", "b.urdf", "--stat")
    assert (status, out) == (1, "links: 1 renamed; joints: 2 changed; moves the same: yes\n")


def test_the_json_holds_what_the_text_says(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(a_urdf=ARM, b_urdf=changed(('xyz="0 0 0.4"', 'xyz="0 0 0.41"')))
    status, out, _ = outcome(capsys, "a.urdf", "b.urdf", "--json")
    data: dict[str, Any] = json.loads(out)
    (change,) = data["changes"]
    assert status == 1 and data["same"] is False and data["version"] == 1
    assert change["of"] == "joint" and change["name"] == "elbow" and change["what"] == "origin"
    assert change["after"] == {"xyz": [0, 0, 0.41]}
    assert change["first"] == {"file": "a.urdf", "line": 35, "column": 6}
    assert change["moved"]["links"] == ["lower", "hand", "tool"]
    assert change["moved"]["distance"] == pytest.approx(0.01)
    assert data["motion"]["same"] is False
    same = json.loads(outcome(capsys, "a.urdf", "a.urdf", "--json")[1])
    assert same["same"] is True and same["changes"] == []


def test_variables_are_set_for_both_or_for_one(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(
        robot_yaml="robot: r\nvariables: {m: 1, n: 1}\nmodel:\n- link/name=a:\n"
        "  - inertial:\n    - mass/value=$(m * n):\n"
        "    - inertia/ixx=1, ixy=0, ixz=0, iyy=1, iyz=0, izz=1:\n"
    )
    words = ("robot.yaml", "robot.yaml")
    assert outcome(capsys, *words, "m:=2")[0] == 0
    out = outcome(capsys, *words, "m:=2", "--a", "n:=3", "--b", "n:=5")[1]
    assert "~ a  mass 6 → 10 kg (+66.7 %)" in out


def test_the_urdf_of_a_robot_means_the_same_as_its_yaml(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("diff_drive", "hexapod", "arm", "quadruped"):
        shutil.copytree(EXAMPLES / name, folder / name)
        main([f"{name}/{name}.yaml", "-q", "-o", f"{name}.urdf"])
        capsys.readouterr()
        status, out, _ = outcome(capsys, f"{name}/{name}.yaml", f"{name}.urdf")
        assert (status, out) == (0, "")


def test_what_a_urdf_cannot_hold_is_named_and_not_compared(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(EXAMPLES / "diff_drive", folder / "d")
    main(["d/diff_drive.yaml", "-q", "-o", "d.urdf"])
    capsys.readouterr()
    _, _, err = outcome(capsys, "d/diff_drive.yaml", "d.urdf")
    assert err == "not compared, since d.urdf cannot hold them: 2 actuators\n"


def test_a_mesh_is_compared_by_its_content(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, data in (("one", b"solid a"), ("two", b"solid b")):
        (folder / name).mkdir()
        (folder / name / "upper.stl").write_bytes(data)
        (folder / name / "a.urdf").write_text(ARM)
    out = outcome(capsys, "one/a.urdf", "two/a.urdf")[1]
    assert "~ upper  visual.mesh upper.stl (the content of the file differs)" in out
    pointer = (
        "version https://git-lfs.github.com/spec/v1\n"
        "oid sha256:8f21be3c20d8b2ad3a1f1c6e9d7e3a0f00000000000000000000000000000000\nsize 7\n"
    )
    (folder / "two" / "upper.stl").write_text(pointer)
    assert outcome(capsys, "one/a.urdf", "two/a.urdf")[0] == 1
    done = subprocess.run(
        [sys.executable, "-c", "import hashlib; print(hashlib.sha256(b'solid a').hexdigest())"],
        capture_output=True,
        text=True,
        check=True,
    )
    real = pointer.replace(pointer.split("sha256:")[1].split("\n")[0], done.stdout.strip())
    (folder / "two" / "upper.stl").write_text(real)
    assert outcome(capsys, "one/a.urdf", "two/a.urdf")[0] == 0


def test_xml_that_is_nested_deeply_is_compared(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deep = "<a>" * 1400 + "{}" + "</a>" * 1400 + "</robot>"
    for name, text in (("a.urdf", "x"), ("b.urdf", "y")):
        Path(name).write_text(ARM.replace("</robot>", deep.format(text)))
    status, out, _ = outcome(capsys, "a.urdf", "b.urdf")
    assert status == 1 and "x → y" in out


# --- trouble ---


def test_a_robot_with_errors_is_reported_and_the_status_is_2(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(a_urdf=ARM, b_yaml="robot: r\nmodel:\n- link/name=a:\n- joint/nam=b:\n")
    status, out, err = outcome(capsys, "a.urdf", "b.yaml")
    assert (status, out) == (2, "")
    assert "b.yaml:4" in err


def test_xml_that_is_no_robot_is_an_error(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(a_urdf=ARM, b_xml="<world/>")
    status, _, err = outcome(capsys, "a.urdf", "b.xml")
    assert status == 2 and "not-urdf" in err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "'yamaro diff' needs a FILE"),
        (("a.urdf",), "'yamaro diff' needs two files: HEAD:robot.yaml robot.yaml"),
        (("a.urdf", "b.urdf", "c.urdf"), "unexpected argument 'c.urdf'"),
        (("a.urdf", "none.urdf"), "cannot read 'none.urdf'"),
        (("a.urdf", "a.urdf", "--tolerance", "x"), "'--tolerance' takes a number"),
        (("a.urdf", "a.urdf", "--a", "x=1"), "'--a' takes name:=value"),
        (("--git", "a.urdf"), "'--git' is for git"),
        (("a.urdf", "a.urdf", "--stat", "--json"), "cannot be combined"),
    ],
)
def test_wrong_usage_is_status_2(
    folder: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...], message: str
) -> None:
    write(a_urdf=ARM, b_urdf=ARM, c_urdf=ARM)
    status, out, err = outcome(capsys, *words)
    assert (status, out) == (2, "")
    assert message in err


def test_files_are_not_trusted_by_default(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(
        a_urdf=ARM,
        b_yaml="robot: r\nprocess: |\n  open('made', 'w').close()\nmodel:\n- link/name=a:\n",
    )
    assert outcome(capsys, "a.urdf", "b.yaml")[0] == 2
    assert not Path("made").exists()
    assert outcome(capsys, "a.urdf", "b.yaml", "--trust")[0] == 1
    assert Path("made").exists()


def test_differences_can_be_status_0(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(a_urdf=ARM, b_urdf=changed(('velocity="2"', 'velocity="3"')))
    assert outcome(capsys, "a.urdf", "b.urdf", "--exit-zero")[0] == 0


# --- git ---


def leg(length: float) -> str:
    return (
        f"variables: {{length: {length}}}\n"
        "functions:\n  Leg()/parent:\n  - part:\n      name: leg\n"
        "      joint: {type: fixed, parent: base_link, xyz: 0 0 $(length)}\n      link:\n"
    )


MAIN = "robot: r\nmodel:\n- link/name=base_link:\n- include: leg.yaml\n- Leg:\n"
EXTRA = (
    "- link/name=extra:\n- joint/name=j, type=fixed:\n  - parent/link=leg_link:\n"
    "  - child/link=extra:\n"
)


@needs_git
def test_a_revision_is_read_with_the_files_that_it_includes(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(robot_yaml=MAIN, leg_yaml=leg(0.1))
    commit()
    write(leg_yaml=leg(0.25))
    status, out, err = outcome(capsys, "HEAD:robot.yaml", "robot.yaml")
    assert (status, err) == (1, "")
    assert "origin xyz 0 0 0.1 → 0 0 0.25 (moved 150 mm)  (leg.yaml:6)" in out
    commit()
    assert outcome(capsys, "HEAD:robot.yaml", "robot.yaml")[0] == 0
    assert outcome(capsys, "HEAD~1:robot.yaml", "HEAD:robot.yaml")[0] == 1
    assert git("status", "--porcelain") == ""


@needs_git
def test_paths_are_read_as_git_reads_them(
    repository: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (repository / "robots").mkdir()
    (repository / "robots" / "arm.urdf").write_text(ARM)
    commit()
    monkeypatch.chdir(repository / "robots")
    assert outcome(capsys, "HEAD:robots/arm.urdf", "HEAD:./arm.urdf")[0] == 0
    assert outcome(capsys, ":./arm.urdf", "arm.urdf")[0] == 0
    status, _, err = outcome(capsys, "HEAD:arm.urdf", "arm.urdf")
    assert status == 2
    assert "there is no file 'arm.urdf' in 'HEAD'" in err
    assert "for a path from this folder write 'HEAD:./arm.urdf'" in err
    assert "git knows no revision 'nowhere'" in outcome(capsys, "nowhere:a", "arm.urdf")[2]


@needs_git
def test_the_index_is_a_revision(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(arm_urdf=ARM)
    commit()
    write(arm_urdf=changed(('velocity="2"', 'velocity="3"')))
    git("add", "-A")
    write(arm_urdf=changed(('velocity="2"', 'velocity="4"')))
    assert "2 → 3 rad/s" in outcome(capsys, "HEAD:arm.urdf", ":arm.urdf")[1]
    assert "3 → 4 rad/s" in outcome(capsys, ":arm.urdf", "arm.urdf")[1]


@needs_git
def test_meshes_and_packages_are_those_of_the_revision(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (repository / "d" / "meshes").mkdir(parents=True)
    (repository / "d" / "package.xml").write_text("<package><name>d</name></package>")
    (repository / "d" / "meshes" / "upper.stl").write_bytes(b"solid a")
    (repository / "d" / "arm.urdf").write_text(
        changed(("upper.stl", "package://d/meshes/upper.stl"))
    )
    commit()
    assert outcome(capsys, "HEAD:d/arm.urdf", "d/arm.urdf")[0] == 0
    (repository / "d" / "meshes" / "upper.stl").write_bytes(b"solid b")
    out = outcome(capsys, "HEAD:d/arm.urdf", "d/arm.urdf")[1]
    assert "the content of the file differs" in out


@needs_git
def test_errors_at_a_revision_name_it_and_not_a_temporary_folder(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(robot_yaml=MAIN, leg_yaml=leg(0.1).replace("$(length)", "$(lenght)"))
    commit()
    write(leg_yaml=leg(0.1))
    status, _, err = outcome(capsys, "HEAD:robot.yaml", "robot.yaml")
    assert status == 2
    assert "--> HEAD:leg.yaml:6" in err
    assert "yamaro-" not in err and str(repository) not in err


@needs_git
def test_nothing_is_left_behind(
    repository: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    temporary = repository / "temporary"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    write(arm_urdf=ARM)
    git("add", "arm.urdf")
    git("commit", "-qm", "one")
    outcome(capsys, "HEAD:arm.urdf", "arm.urdf")
    outcome(capsys, "HEAD:none.urdf", "arm.urdf")
    assert list(temporary.iterdir()) == []


@needs_git
def test_hooks_and_filters_are_not_run(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(arm_urdf=ARM)
    commit()
    (repository / ".gitattributes").write_text("*.urdf filter=evil export-ignore\n")
    commit()
    git("config", "filter.evil.smudge", "touch ran; cat")
    assert outcome(capsys, "HEAD:arm.urdf", "arm.urdf")[0] == 0
    assert not (repository / "ran").exists()


@needs_git
def test_links_that_lead_out_of_the_repository_are_not_made(repository: Path) -> None:
    os.symlink("/etc/passwd", "outside")
    os.symlink("../../../etc", "above")
    write(arm_urdf=ARM)
    os.symlink("arm.urdf", "inside")
    commit()
    checkout = Checkout(Repository(str(repository)), "HEAD")
    assert sorted(os.listdir(checkout.folder)) == [".git", "arm.urdf", "inside"]
    with pytest.raises(GitError):
        checkout.path_of("../x")
    checkout.close()


@needs_git
def test_what_is_no_repository_is_said(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(folder.parent))
    write(arm_urdf=ARM)
    status, _, err = outcome(capsys, "HEAD:arm.urdf", "arm.urdf")
    assert status == 2 and "not a git repository" in err


def test_a_file_whose_name_has_a_colon_is_a_file(folder: Path) -> None:
    (folder / "a:b").write_text("")
    assert split_revision("a:b") is None
    assert split_revision("HEAD:b") == ("HEAD", "b")
    assert split_revision(":b") == ("", "b")
    assert split_revision("b") is None


# --- as a driver of git ---


@needs_git
def test_git_diff_shows_what_changed_through_the_driver(repository: Path) -> None:
    command = f"{sys.executable} -m yamaro diff --git"
    git("config", "diff.yamaro.command", command)
    (repository / ".gitattributes").write_text("*.yaml diff=yamaro\n*.urdf diff=yamaro\n")
    write(robot_yaml=MAIN, leg_yaml=leg(0.1), arm_urdf=ARM, other_yaml="a: 1\n")
    commit("one")
    write(
        robot_yaml=MAIN + EXTRA,
        leg_yaml=leg(0.25),
        arm_urdf=changed(('velocity="2"', 'velocity="3"')),
        new_urdf=ARM,
    )
    git("add", "-N", "new.urdf")
    out = git("diff")
    assert "diff --git a/arm.urdf b/arm.urdf\n--- a/arm.urdf\n+++ b/arm.urdf\njoints\n" in out
    assert "  ~ shoulder, elbow  limit.velocity 2 → 3 rad/s\n" in out
    assert "  + extra  on leg_link by j (fixed)  (line 6)\n" in out
    assert "moved 150 mm)  (leg.yaml:6)" in out  # of a file that the robot includes
    assert "-variables: {length: 0.1}\n+variables" in out  # not a robot by itself
    assert "--- /dev/null\n+++ b/new.urdf\n@@ -0,0 +1," in out
    commit("two")
    assert "~ shoulder, elbow  limit.velocity 2 → 3 rad/s\n" in git("diff", "HEAD~1", "HEAD")
    assert "~ shoulder, elbow  limit.velocity 2 → 3 rad/s\n" in git("show", "--ext-diff", "HEAD")
    git("mv", "arm.urdf", "hand.urdf")
    write(hand_urdf=changed(('velocity="2"', 'velocity="4"')))
    assert "3 → 4 rad/s" in git("diff", "-M", "HEAD")


@needs_git
def test_git_diff_goes_on_where_a_robot_has_errors(repository: Path) -> None:
    git("config", "diff.yamaro.command", f"{sys.executable} -m yamaro diff --git")
    (repository / ".gitattributes").write_text("*.urdf diff=yamaro\n")
    write(a_urdf=ARM, b_urdf=ARM)
    commit()
    write(a_urdf=ARM.replace("</robot>", ""), b_urdf=changed(('velocity="2"', 'velocity="3"')))
    done = subprocess.run(["git", "diff"], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "-</robot>\n" in done.stdout
    assert "2 → 3 rad/s" in done.stdout
    assert "yamaro diff: a.urdf is compared as text: " in done.stderr


@needs_git
@pytest.mark.skipif(os.name == "nt", reason="the programs are scripts of a shell")
def test_a_repository_starts_no_programs(
    repository: Path, capsys: pytest.CaptureFixture[str], tmp_path_factory: pytest.TempPathFactory
) -> None:
    for text in (ARM, changed(('mass value="', 'mass value="1'))):
        Path("arm.urdf").write_text(text)
        Path(".gitattributes").write_text("*.urdf diff=evil filter=evil\n")
        commit()
    ran = tmp_path_factory.mktemp("ran")
    evil = ran / "evil.sh"
    evil.write_text(f"#!/bin/sh\necho $0 $@ >> {ran}/RAN\nexit 1\n")
    evil.chmod(0o755)
    for hook in ("post-index-change", "pre-auto-gc", "reference-transaction", "fsmonitor-watchman"):
        shutil.copy(evil, repository / ".git" / "hooks" / hook)
    for name in (
        *("core.fsmonitor", "core.sshCommand", "core.gitProxy", "core.askPass", "core.pager"),
        *("core.editor", "diff.external", "diff.evil.command", "diff.evil.textconv", "gpg.program"),
        *("filter.evil.smudge", "filter.evil.clean", "filter.evil.process", "alias.ls-tree"),
        *("alias.cat-file", "credential.helper", "pager.rev-list", "remote.origin.uploadpack"),
        *("core.alternateRefsCommand", "uploadpack.packObjectsHook", "sequence.editor"),
    ):
        git("config", name, f"{evil}")
    for name, value in (
        ("core.fsmonitorHookVersion", "2"),
        ("remote.origin.url", str(repository)),
        ("remote.origin.promisor", "true"),
        ("remote.origin.partialclonefilter", "blob:none"),
        ("extensions.partialClone", "origin"),
        ("core.repositoryformatversion", "1"),
    ):
        git("config", name, value)
    (ran / "RAN").unlink(missing_ok=True)
    status, _, err = outcome(capsys, "HEAD~:arm.urdf", "arm.urdf")
    assert status == 1, err
    assert outcome(capsys, ":arm.urdf", "HEAD~:arm.urdf")[0] == 1
    blob = git("rev-parse", "HEAD~:arm.urdf").strip()
    (repository / ".git" / "objects" / blob[:2] / blob[2:]).unlink()
    (ran / "RAN").unlink(missing_ok=True)
    assert outcome(capsys, "HEAD~:arm.urdf", "arm.urdf")[0] == 2  # and it is not fetched
    assert not (ran / "RAN").exists()


# --- between formats ------------------------------------------------------------------------------

ARM_IN_MJCF = """<mujoco model="arm">
  <compiler angle="radian"/>
  <worldbody>
    <body name="base">
      <geom name="foot" type="box" size="0.1 0.1 0.1" mass="2" friction="0.7"/>
      <body name="upper" pos="0 0 0.1">
        <joint name="shoulder" axis="0 1 0" range="-1 1" damping="0.1"/>
        <geom name="bone" type="box" size="0.02 0.02 0.2" pos="0 0 0.2" mass="1"/>
      </body>
    </body>
  </worldbody>
  <actuator><position joint="shoulder" kp="50" kv="2"/></actuator>
</mujoco>
"""


def test_mjcf_is_compared_with_what_is_made_of_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("arm.xml").write_text(ARM_IN_MJCF)
    assert main(["migrate", "-q", "arm.xml", "-o", "arm.yaml"]) == 0
    assert main(["-q", "arm.xml", "-o", "arm.urdf"]) == 0
    capsys.readouterr()
    assert outcome(capsys, "arm.xml", "arm.yaml") == (0, "", "")
    status, out, err = outcome(capsys, "arm.urdf", "arm.xml")
    assert (status, out) == (0, "")
    assert err == ("not compared, since arm.urdf cannot hold them: 1 actuator, 1 surface\n")


def test_actuators_of_mjcf_are_compared(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.xml").write_text(ARM_IN_MJCF)
    Path("other.xml").write_text(ARM_IN_MJCF.replace('kp="50"', 'kp="60"'))
    status, out, err = outcome(capsys, "arm.xml", "other.xml")
    assert (status, err) == (1, "")
    assert "kp 50 → 60" in out


# --- overlays ---


def values_in(urdf: str) -> dict[str, object]:
    """Return every value of joints and masses, by the name and the place."""
    found: dict[str, object] = {}
    for owner in ElementTree.fromstring(urdf):
        for element in owner.iter() if owner.tag in ("joint", "link") else ():
            for name, text in element.attrib.items():
                numbers = text.split()
                try:
                    found[f"{owner.get('name')} {element.tag} {name}"] = [*map(float, numbers)]
                except ValueError:
                    found[f"{owner.get('name')} {element.tag} {name}"] = text
    return found


def test_an_overlay_leads_from_one_robot_to_the_other(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of each number of a joint or inertial, one that an overlay has is written in full."""
    (folder / "a.urdf").write_text(ARM, encoding="utf-8")
    root = ElementTree.fromstring(ARM)
    draws = random.Random(3)
    changed_values = 0
    for owner in root:
        for element in owner.findall("./inertial//*") if owner.tag == "link" else owner.iter():
            for name, text in element.attrib.items():
                numbers = text.split()
                if owner.tag in ("joint", "link") and numbers and is_row(numbers):
                    row = [float(each) * 0.9 + draws.uniform(0.001, 0.1) for each in numbers]
                    element.set(name, " ".join(map(repr, row)))
                    changed_values += 1
    assert changed_values > 20
    other = ElementTree.tostring(root, encoding="unicode")
    (folder / "b.urdf").write_text(other, encoding="utf-8")
    status, overlay, rest = outcome(capsys, "--overlay", "a.urdf", "b.urdf")
    assert (status, rest) == (0, "")
    (folder / "unit.yaml").write_text(overlay, encoding="utf-8")
    assert main(["a.urdf", "--overlay", "unit.yaml", "-q"]) == 0
    assert values_in(capsys.readouterr().out) == values_in(other)
    assert outcome(capsys, "--overlay", "b.urdf", "b.urdf") == (0, "overlay: {}\n", "")


def is_row(words: list[str]) -> bool:
    try:
        return all(map(isfinite, map(float, words)))
    except ValueError:
        return False


def test_what_an_overlay_cannot_say_is_said_beside_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "a.urdf").write_text(ARM, encoding="utf-8")
    other = changed(
        ('size="0.4 0.4 0.1"', 'size="0.4 0.4 0.2"'), ('<mass value="5"/>', '<mass value="6"/>')
    )
    (folder / "b.urdf").write_text(other, encoding="utf-8")
    status, overlay, rest = outcome(capsys, "--overlay", "a.urdf", "b.urdf")
    assert status == 1
    assert overlay == "overlay:\n  links:\n    base:\n      mass: 6\n"
    assert rest.startswith("an overlay cannot say all of it; what is left:\n")
    assert "0.4 0.4 0.1" in rest and "mass" not in rest
