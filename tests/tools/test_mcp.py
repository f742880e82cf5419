"""`yamaro mcp`, driven by the client of the protocol's own library."""

from __future__ import annotations

import base64
import os
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from tests.later import Later
from yamaro.commands.main import main
from yamaro.tools.mcp.folder import Folder, Refused

if TYPE_CHECKING:
    import anyio
    import mcp

    from yamaro.tools.mcp.server import Commands, make_server
else:
    anyio, mcp = Later("anyio"), Later("mcp")
    Commands = Later("yamaro.tools.mcp.server", "Commands")
    make_server = Later("yamaro.tools.mcp.server", "make_server")

pytestmark = pytest.mark.skipif(not find_spec("mcp"), reason="needs mcp")

ARM = """\
robot: swing
arguments:
  reach: {default: 40cm, range: [10cm, 1m]}
model:
- part: {name: base}
- part:
    name: arm
    joint: {type: revolute, parent: base, axis: y, limit: {lower: -90deg, upper: 90deg}}
    link: {geometry: cylinder, radius: 2cm, length: $(reach), mass: 0.5, visual: }
"""
LONG = """\
robot: many
model:
- part: {name: base}
- for i in range(600):
  - part: {name: leg_$(i), joint: {type: fixed, parent: base}}
"""
INCLUDE = "robot: a\nmodel:\n- include: %s\n"
WORD = "xyzzy"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inside = tmp_path / "robots"
    inside.mkdir()
    (inside / "arm.yaml").write_text(ARM)
    (tmp_path / "secret.yaml").write_text(f"variables: {{word: {WORD}}}\n")
    return inside


def results(server: object, calls: list[tuple[str, dict[str, Any]]]) -> list[Any]:
    """Return what a client of a server gets for calls of tools."""

    async def run() -> list[Any]:
        async with mcp.Client(server) as client:
            return [await client.call_tool(tool, values) for tool, values in calls]

    return anyio.run(run)


def answers(server: object, calls: list[tuple[str, dict[str, Any]]]) -> list[tuple[bool, str]]:
    """Return for each call whether it was answered, and with what text."""
    return [
        (not result.is_error, "".join(e.text for e in result.content if e.type == "text"))
        for result in results(server, calls)
    ]


def in_process(folder: Path) -> object:
    return make_server(Commands(str(folder), ["--safe", "--within", str(folder)]))


def test_ten_tasks_over_standard_streams(folder: Path) -> None:
    robot = {"file": "arm.yaml"}
    tasks: list[tuple[str, dict[str, Any], bool, str]] = [
        ("guide", {}, True, "## Part: a joint and a link"),
        ("build", {"text": ARM.replace("t: base", "t: bass")}, False, "did you mean 'base_link'?"),
        ("build", robot, True, '<joint name="arm_joint" type="revolute">'),
        (
            "build",
            {**robot, "arguments": {"reach": 0.8}, "output": "arm.urdf"},
            True,
            "arm.urdf is written",
        ),
        ("build", {**robot, "format": "mjcf"}, True, "<mujoco"),
        ("diff", {"first": "arm.yaml", "second": "arm.urdf"}, True, "0.4 → 0.8"),
        ("why", {**robot, "address": "arm_joint/limit@upper"}, True, "arm.yaml:8:"),
        ("args", robot, True, "reach:="),
        ("tree", robot, True, "arm_link"),
        ("migrate", {"file": "arm.urdf"}, True, "part"),
    ]
    parameters = mcp.StdioServerParameters(
        command=sys.executable, args=["-m", "yamaro", "mcp", str(folder)]
    )
    calls = [(tool, values) for tool, values, *_ in tasks]
    for task, (ok, text) in zip(tasks, answers(mcp.stdio_client(parameters), calls), strict=True):
        assert (ok, task[3] in text) == (task[2], True), (task, text)
    assert 'length="0.8"' in (folder / "arm.urdf").read_text()


def test_the_fix_that_check_offers_is_applied(folder: Path) -> None:
    bad = folder / "bad.yaml"
    bad.write_text(ARM.replace("geometry:", "geometri:"))
    (_, found), _, (ok, refused), (_, after) = answers(
        in_process(folder),
        [
            ("check", {"file": "bad.yaml"}),
            ("check", {"file": "bad.yaml", "fix": True}),
            ("check", {"text": ARM, "fix": True}),
            ("check", {"file": "bad.yaml"}),
        ],
    )
    assert "did you mean 'geometry'?" in found
    assert bad.read_text() == ARM
    assert "unknown-key" not in after
    assert not ok and "'fix' changes files" in refused


def test_a_picture_is_a_png(folder: Path) -> None:
    pytest.importorskip("vtk")
    values = {"file": "arm.yaml", "view": ["front"], "size": "80x60", "joints": {"arm": "30deg"}}
    [result] = results(in_process(folder), [("picture", values)])
    image = result.content[0]
    assert image.mime_type == "image/png"
    assert base64.b64decode(image.data).startswith(b"\x89PNG")


def test_the_source_of_a_robot_is_not_replaced(folder: Path) -> None:
    (folder / "mine.yaml").write_text("robot: mine\n")
    asked = [
        {"output": "arm.yaml"},
        {"output": "mine.yaml"},
        {"output": "mine.yaml", "format": "mjcf"},
        {"output": "a.urdf"},
        {"output": "a.urdf"},
        {"output": "c_controllers.yaml", "format": "controllers"},
        {"output": "c_controllers.yaml", "format": "controllers"},
    ]
    given = [("build", {"file": "arm.yaml", **each}) for each in asked]
    found = answers(in_process(folder), given)
    assert [is_answered for is_answered, _ in found] == [False] * 3 + [True] * 4
    assert "'mine.yaml' exists" in found[1][1]
    assert (folder / "mine.yaml").read_text() == "robot: mine\n"


def test_nothing_outside_is_read_or_written(folder: Path) -> None:
    secret = folder.parent / "secret.yaml"
    (folder / "link.yaml").symlink_to(secret)
    (folder / "out").symlink_to(folder.parent)
    (folder.parent / ".git").mkdir()  # a repository around the folder is not part of it
    (folder / "yamaro.py").write_text("open('owned', 'w')")
    reads: list[dict[str, Any]] = [
        {"file": "../secret.yaml"},
        {"file": str(secret)},
        {"file": "link.yaml"},
        {"file": "out/secret.yaml"},
        {"file": "missing.yaml"},
        {"file": ""},
        {"file": "-"},
        {"file": "a\0b"},
        {"text": INCLUDE % "../secret.yaml"},
        {"text": INCLUDE % secret},
        {"text": INCLUDE % "link.yaml"},
        {"text": INCLUDE % "package://numpy/version.yaml"},
        {"text": "robot: a\nmodel: [print: $(load_yaml('../secret.yaml'))]\n"},
        {"text": "robot: a\nimport: [os]\nmodel: [print: $(os.listdir('/'))]\n"},
        {"file": "arm.yaml", "text": ARM},
        {"file": "arm.yaml", "arguments": {"--output=x": 1}},
        {"file": 3},
        {"fil": "arm.yaml"},
        {},
    ]
    outputs = ["../x.urdf", "/x.urdf", "out/x.urdf", ".git/config", "a/.b/x", "link.yaml", "."]
    calls: list[tuple[str, dict[str, Any]]] = [
        *[("build", values) for values in reads],
        *[("build", {"file": "arm.yaml", "output": name}) for name in outputs],
        ("why", {"file": "arm.yaml", "address": "--output=x"}),
        ("diff", {"first": "HEAD:arm.yaml", "second": "arm.yaml"}),
        ("remove", {"file": "arm.yaml"}),
    ]
    before = sorted(os.listdir(folder.parent)), sorted(os.listdir(folder))
    for call, (ok, text) in zip(calls, answers(in_process(folder), calls), strict=True):
        assert not ok, call
        assert text, call
        assert WORD not in text and "Traceback" not in text, (call, text)
    assert (sorted(os.listdir(folder.parent)), sorted(os.listdir(folder))) == before


def test_assets_that_lead_out_of_the_folder_are_refused(folder: Path) -> None:
    (folder / "assets").symlink_to(folder.parent)
    with pytest.raises(Refused, match="'assets' leads out"):
        Folder(str(folder)).new_file("arm.xml")
    (folder / "moveit").mkdir()
    (folder / "moveit" / "config").symlink_to(folder.parent)
    with pytest.raises(Refused, match="leads out"):
        Folder(str(folder)).new_file("moveit/")


@pytest.mark.parametrize("name", ["guide", "-x.yaml", "HEAD:x.yaml"])
def test_a_file_is_never_taken_for_something_else(name: str, folder: Path) -> None:
    (folder / name).write_text(ARM)
    assert Folder(str(folder)).file(name) == os.path.join(".", name)
    [(ok, text)] = answers(in_process(folder), [("build", {"file": name})])
    assert ok, text
    assert '<robot name="swing">' in text


def test_a_long_answer_is_cut_and_says_so(folder: Path) -> None:
    [(ok, text)] = answers(in_process(folder), [("build", {"text": LONG})])
    assert ok
    assert "more characters are left out here" in text
    assert len(text) < 41_000


def test_the_command_line_says_what_is_wrong(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for words, message in (
        (["mcp", str(folder / "nowhere")], "is not a folder"),
        (["mcp", "a", "b"], "unexpected argument 'b'"),
        (["mcp", str(folder), "--limit", "turns=x"], "turns"),
    ):
        assert main(words) == 2
        assert message in capsys.readouterr().err
