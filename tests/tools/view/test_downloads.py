"""The files that the page offers: what is in them, and what is shown of them."""

from __future__ import annotations

import io
import json
import os
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.tools.view.conftest import Page, Viewer
from tests.tools.view.test_page import LAMP, Start
from tests.tools.view.test_server import MESH, Served
from tests.waiting import wait_for
from yamaro.commands.main import main
from yamaro.policy import SAFE, TRUSTED
from yamaro.tools.view import server as serving

TOLD = LAMP.replace(
    "      mass: 2\n", "      mass: 2\n      sensor/name=eye: {type: gps, rate: 5 Hz}\n"
)
"""A lamp with a sensor that MuJoCo does not have."""
LINE_OF_SENSOR = TOLD[: TOLD.index("sensor/")].count("\n") + 1


def prepared(served: Served, format: str) -> Any:
    """Return the answer of the server to the wish for a format."""
    status, content, _ = served.ask("download", "POST", {"format": format})
    assert status == 200
    return json.loads(content)


def files_in(archive: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(archive)) as file:
        assert file.testzip() is None
        return {name: file.read(name) for name in file.namelist()}


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    """Serve a robot with a mesh."""
    (tmp_path / "body.obj").write_text(MESH)
    running = Served(tmp_path)
    yield running
    serving.stop(running.server)


@pytest.fixture(params=[SAFE, TRUSTED])
def told(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Served]:
    """Serve the robot with a sensor, in a jail and without."""
    running = Served(tmp_path, request.param)
    running.path.write_text(TOLD)
    running.rebuilder.forget()
    yield running
    serving.stop(running.server)


@pytest.mark.parametrize("format", ["urdf", "mjcf"])
def test_a_download_is_what_the_command_writes_into_a_folder(
    told: Served, format: str, tmp_path: Path
) -> None:
    answer = prepared(told, format)
    assert "key" in answer, answer
    status, content, headers = told.ask(f"download/{answer['key']}")
    assert status == 200
    assert len(content) == answer["bytes"]
    assert headers["Content-Disposition"] == f"attachment; filename*=UTF-8''{answer['name']}"
    folder = tmp_path / "written"
    assert main([str(told.path), "--to", format, "-q", "-o", f"{folder}{os.sep}"]) == 0
    written = {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }
    if len(written) == 1:
        assert {answer["name"]: content} == written
    else:
        assert answer["name"] == f"lamp-{format}.zip"
        assert files_in(content) == {f"lamp/{name}": data for name, data in written.items()}


def test_meshes_come_with_it_in_an_archive(served: Served) -> None:
    answer = prepared(served, "urdf")
    assert answer["name"] == "one-urdf.zip"
    found = files_in(served.ask(f"download/{answer['key']}")[1])
    document, mesh = found
    assert document == "one/one.urdf"
    assert mesh.startswith("one/assets/body-")
    assert found[mesh] == MESH.encode()
    assert mesh.removeprefix("one/") in found[document].decode()
    again = prepared(served, "urdf")
    assert files_in(served.ask(f"download/{again['key']}")[1]) == found
    assert served.ask(f"download/{answer['key']}")[0] == 404  # only the last is kept


def test_losses_are_told_with_their_places(told: Served) -> None:
    losses = prepared(told, "mjcf")["diagnostics"]
    texts = {(each["code"], each["message"].partition(" are ")[0]): each["text"] for each in losses}
    assert texts.keys() == {
        ("lost-in-mjcf", "velocity limits"),
        ("approximated-in-mjcf", "gps sensors"),
        ("lost-in-mjcf", "rates of sensors"),
    }
    place = f"robot.yaml:{LINE_OF_SENSOR}:7"
    assert place in texts["approximated-in-mjcf", "gps sensors"]
    (lost,) = prepared(told, "sdf")["diagnostics"]
    assert lost["message"] == "names of materials are lost in SDF: material 'red'"


def test_losses_that_comments_accept_are_not_told(told: Served) -> None:
    text = told.path.read_text()
    told.path.write_text(f"# yamaro: allow lost-in-mjcf\n{text}")
    told.rebuilder.forget()
    losses = prepared(told, "mjcf")["diagnostics"]
    assert {each["code"] for each in losses} == {"approximated-in-mjcf"}


def test_variables_of_the_page_count(served: Served) -> None:
    served.ask("variables", "POST", {"side": 0.5})
    answer = prepared(served, "urdf")
    found = files_in(served.ask(f"download/{answer['key']}")[1])
    assert b'<box size="0.5 0.2 0.3"' not in found["one/one.urdf"]  # it has a mass and no box
    assert b'ixx="0.0108' in found["one/one.urdf"]
    assert b"0.0283" in found["one/one.urdf"]  # (0.5² + 0.3²) / 12


def test_what_cannot_be_written_says_why(served: Served) -> None:
    (served.path.parent / "body.obj").unlink()
    answer = prepared(served, "mjcf")
    assert "key" not in answer
    assert [each["code"] for each in answer["diagnostics"]] == ["missing-mesh"]
    served.path.write_text("robot: [")
    served.rebuilder.forget()
    assert "robot.yaml:1" in prepared(served, "mjcf")["diagnostics"][0]["text"]
    served.path.unlink()
    served.rebuilder.forget()
    assert "robot.yaml" in prepared(served, "mjcf")["fault"]


def test_an_extra_that_is_missing_is_named(told: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [each for each in sys.modules if each.startswith("yamaro.targets.usd")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "pxr", None)
    (error,) = prepared(told, "usd")["diagnostics"]
    assert error["code"] == "missing-extra"
    assert "yamaro[usd]" in error["text"]


def test_other_formats_and_keys_are_refused(served: Served) -> None:
    for wrong in ("obj", "", None, 3, ["urdf"], "../urdf"):
        assert served.ask("download", "POST", {"format": wrong})[0] == 400
    for wrong in ("", "x", "../robot.yaml"):
        assert served.ask(f"download/{wrong}")[0] == 404
    answer = prepared(served, "urdf")
    assert served.ask_raw(f"/download/{answer['key']}")[0] == 404  # without the token


# --- in the browser -----------------------------------------------------------------------------


@pytest.fixture
def saved(page: Page, tmp_path: Path) -> Path:
    """Return the folder that the browser saves files in."""
    folder = tmp_path / "saved"
    folder.mkdir()
    page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
    return folder


def download(page: Page, format: str) -> str:
    """Choose a format in the menu; return what the page says of it."""
    if not page.text("#formats"):
        page.press("#download")
    page.press(f"#formats [data-format={format}]")
    page.wait_for("!document.querySelector('#download-result').matches('.busy, [hidden]')")
    return page.text("#download-result")


def shown(page: Page, view: Start, path: Path, text: str, *options: str) -> Viewer:
    path.write_text(text, encoding="utf-8")
    viewer = view(path, *options)
    page.show(viewer)
    return viewer


def test_a_file_is_saved_and_what_it_lost_is_shown(
    page: Page, view: Start, tmp_path: Path, saved: Path
) -> None:
    coloured = TOLD.replace('$("red" if is_red else "blue")', "0.9 0.05 0.05 1")
    shown(page, view, tmp_path / "lamp.yaml", coloured)
    said = download(page, "sdf")
    assert said.startswith("lamp.sdf")
    assert "cannot hold" not in said
    document = saved / "lamp.sdf"
    wait_for(document.exists)
    assert "<model name=" in document.read_text()
    said = download(page, "mjcf")
    assert said.startswith("lamp-mjcf.zip")
    assert "What MJCF cannot hold:" in said
    assert "approximated-in-mjcf" in said
    wait_for((saved / "lamp-mjcf.zip").exists)
    assert list(files_in((saved / "lamp-mjcf.zip").read_bytes())) == [
        "lamp/lamp.xml",
        "lamp/scene.xml",
    ]


def test_a_refusal_is_shown_and_an_option_helps(
    page: Page, view: Start, tmp_path: Path, saved: Path
) -> None:
    inertial = "inertial: {mass: 2, inertia: 1 0 0 1 0 3}"
    text = LAMP.replace("mass: 2", inertial)
    shown(page, view, tmp_path / "lamp.yaml", text)
    said = download(page, "mjcf")
    assert said.startswith("MJCF cannot be written")
    assert "inertia-triangle" in said
    assert list(saved.iterdir()) == []
    shown(page, view, tmp_path / "again.yaml", text, "--repair-inertia")
    assert download(page, "mjcf").startswith("lamp-mjcf.zip")


def test_the_menu_closes(page: Page, view: Start, tmp_path: Path) -> None:
    shown(page, view, tmp_path / "lamp.yaml", LAMP)
    page.press("#download")
    assert "MuJoCo" in page.text("#formats")
    page.press("#canvas")
    assert page.text("#formats") == ""
    page.press("#download")
    page.press("#download")
    assert page.text("#formats") == ""
