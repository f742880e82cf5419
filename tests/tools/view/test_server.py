"""What the server of `yamaro view` answers, and to whom; without a browser."""

from __future__ import annotations

import http.client
import json
import os
import random
import socket
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.tools.view.conftest import Viewer
from tests.waiting import PATIENCE, wait_for
from yamaro.options import Options
from yamaro.policy import SAFE, TRUSTED, Policy
from yamaro.rebuilding import Rebuilder
from yamaro.tools.view import server as serving
from yamaro.tools.view.server import Server
from yamaro.tools.view.session import Session
from yamaro.tools.view.viewing import Editor

ROBOT = """\
robot: one
variables:
  side: 0.1
model:
- part:
    name: body
    link:
      geometry: box
      scale: $(side) 0.2 0.3
      mass: 1
      visual: {geometry: body.obj, scale: 1 1 1}
"""
MESH = "mtllib body.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class Recorder(Editor):
    """An editor that only notes what it is asked to open."""

    def __init__(self) -> None:
        super().__init__(["recorder"])
        self.opened: list[tuple[str, int, int]] = []

    def open(self, path: str, line: int, column: int) -> None:
        self.opened.append((path, line, column))


class Served:
    """A running server, and how it is asked."""

    def __init__(self, folder: Path, mode: str = SAFE) -> None:
        self.path = folder / "robot.yaml"
        self.path.write_text(ROBOT, encoding="utf-8")
        self.rebuilder = Rebuilder(
            str(self.path),
            Options(
                policy=Policy(mode),
                on_message=print,
                advice=True,
            ),
        )
        self.editor = Recorder()
        self.session = Session(self.rebuilder, editor="recorder")
        self.server = Server(self.session, port=0, editor=self.editor)
        serving.start(self.server)
        self.session.build()
        self.port = self.server.server_port
        self.host = f"127.0.0.1:{self.port}"
        self.base = f"/{self.server.token}/"

    def ask(
        self, path: str, method: str = "GET", body: Any = None, **headers: str
    ) -> tuple[int, bytes, dict[str, str]]:
        """Return status, content and headers of an answer; `path` is below the token."""
        return self.ask_raw(self.base + path, method, body, headers)

    def ask_raw(
        self, path: str, method: str = "GET", body: Any = None, headers: Any = None
    ) -> tuple[int, bytes, dict[str, str]]:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        sent = {name.replace("_", "-"): value for name, value in (headers or {}).items()}
        if isinstance(body, dict):
            body = json.dumps(body)
            sent = {"Content-Type": "application/json", **sent}
        connection.request(method, path, body, sent)
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, content, dict(answer.getheaders())

    def state(self) -> Any:
        return json.loads(self.ask("state")[1])


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    (tmp_path / "body.obj").write_text(MESH)
    running = Served(tmp_path)
    yield running
    serving.stop(running.server)


# --- who is answered ----------------------------------------------------------------------------


def test_the_page_and_its_files_are_there(served: Served) -> None:
    for path, kind in (("", "text/html"), ("view.js", "text/javascript"), ("view.css", "text/css")):
        status, content, headers = served.ask(path)
        assert status == 200 and len(content) > 1000
        assert headers["Content-Type"].startswith(kind)


def test_without_the_token_there_is_nothing(served: Served) -> None:
    token = served.server.token
    for path in ("/", "/state", "/view.js", f"/{token}", f"/{token[:-1]}/state", f"/{token}x/state",
                 "/%00/state", f"/{token.lower()}_/"):  # fmt: skip
        status, content, _ = served.ask_raw(path)
        assert (status, b"that yamaro view has printed" in content) == (404, True), path


def test_only_requests_to_this_machine_by_name_are_answered(served: Served) -> None:
    assert served.ask("state", Host=f"localhost:{served.port}")[0] == 200
    for host in ("evil.example", f"evil.example:{served.port}", "127.0.0.1", "127.0.0.1:1",
                 f"127.0.0.1.evil.example:{served.port}", ""):  # fmt: skip
        assert served.ask("state", Host=host)[0] == 421, host


def test_requests_of_other_pages_are_refused(served: Served) -> None:
    own = f"http://{served.host}"
    assert served.ask("rebuild", "POST", {}, Origin=own)[0] == 200
    for origin in ("http://evil.example", "null", f"https://{served.host}", "http://127.0.0.1:1"):
        assert served.ask("rebuild", "POST", {}, Origin=origin)[0] == 403, origin
        assert served.ask("state", Origin=origin)[0] == 403, origin
    for site in ("cross-site", "same-site"):
        assert served.ask("state", Sec_Fetch_Site=site)[0] == 403
        assert served.ask("", Sec_Fetch_Site=site)[0] == 403
        followed = {"Sec_Fetch_Site": site, "Sec_Fetch_Dest": "document"}
        assert served.ask("", **followed)[0] == 200  # a link in a terminal in the browser
        assert served.ask("state", **followed)[0] == 403
        assert served.ask("rebuild", "POST", {}, **followed)[0] == 403


def test_only_json_of_a_bounded_size_is_read(served: Served) -> None:
    plain = {"Content_Type": "text/plain"}
    assert served.ask("variables", "POST", '{"side": 2}', **plain)[0] == 415
    assert served.ask("variables", "POST", {"side": "x" * 100_000})[0] == 413
    kind = {"Content_Type": "application/json"}
    for text in ("", "[]", "nonsense", "[" * 10_000, '{"side": NaN}'):
        assert served.ask("variables", "POST", text, **kind)[0] == 400, text[:20]
    assert served.state()["variables"][0]["value"] == 0.1


def test_other_methods_and_paths_are_refused(served: Served) -> None:
    for method in ("PUT", "DELETE", "OPTIONS", "HEAD", "TRACE"):
        assert served.ask("state", method)[0] == 501, method
    for path in ("nothing", "../state", "static/view.js", "view.js.map", "THIRD-PARTY.txt"):
        assert served.ask(path)[0] == 404, path
    assert served.ask("nothing", "POST", {})[0] == 404


def test_an_editor_can_have_the_page_in_a_frame_if_it_asks_for_that(served: Served) -> None:
    framed = {"Sec_Fetch_Site": "cross-site", "Sec_Fetch_Dest": "iframe"}
    assert served.ask("", **framed)[0] == 403
    served.server.is_embedded = True
    status, _, headers = served.ask("", **framed)
    assert status == 200
    assert "X-Frame-Options" not in headers
    policy = headers["Content-Security-Policy"]
    assert "frame-ancestors vscode-webview:" in policy and "unsafe" not in policy
    assert served.ask("state", **framed)[0] == 403
    assert served.ask("state", Host="localhost:1")[0] == 200  # a port that an editor hands on
    for host in ("evil.example:1", "127.0.0.1.evil.example:1", "localhost", "localhost:x"):
        assert served.ask("state", Host=host)[0] == 421
    assert served.ask("", Sec_Fetch_Site="cross-site", Sec_Fetch_Dest="empty")[0] == 403
    assert served.ask_raw("/", headers=framed)[0] == 404


def test_every_answer_forbids_to_be_framed_sniffed_or_scripted_by_others(served: Served) -> None:
    for status, _, headers in (served.ask(""), served.ask("state"), served.ask_raw("/")):
        assert status in (200, 404)
        policy = headers["Content-Security-Policy"]
        assert "default-src 'none'" in policy and "script-src 'self'" in policy
        assert "unsafe" not in policy and "frame-ancestors 'none'" in policy
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert headers["Referrer-Policy"] == "no-referrer"


def test_the_page_asks_nothing_of_the_network(served: Served) -> None:
    for name in ("", "view.css"):
        content = served.ask(name)[1].decode()
        assert (
            "http://" not in content
            and "https://" not in content
            and "//" not in content.replace("/*", "").replace("*/", "")
        )


# --- files --------------------------------------------------------------------------------------


def test_a_mesh_is_given_by_its_key_and_nothing_by_a_path(served: Served) -> None:
    mesh = served.state()["robot"]["links"]["body_link"]["visual"][0]["mesh"]
    assert mesh["ending"] == ".obj"
    assert served.ask(f"file/{mesh['key']}")[1] == MESH.encode()
    for path in ("robot.yaml", "../robot.yaml", "body.obj", str(served.path), "%2e%2e/robot.yaml",
                 f"{mesh['key']}/../../robot.yaml", f"{mesh['key']}x", ""):  # fmt: skip
        assert served.ask(f"file/{path}")[0] == 404, path


def test_files_outside_of_what_the_robot_may_read_are_not_given(
    served: Served, tmp_path_factory: pytest.TempPathFactory
) -> None:
    outside = tmp_path_factory.mktemp("outside") / "secret.mtl"
    outside.write_text("newmtl secret")
    mesh = served.path.parent / "body.obj"
    mesh.write_text(MESH.replace("body.mtl", str(outside)))
    served.session.build()
    found = served.state()["robot"]["links"]["body_link"]["visual"][0]["mesh"]
    assert found["companions"] == {}
    inside = served.path.parent / "body.mtl"
    inside.write_text("newmtl plain\nmap_Kd robot.yaml\n")
    mesh.write_text(MESH)
    served.session.build()
    found = served.state()["robot"]["links"]["body_link"]["visual"][0]["mesh"]
    assert list(found["companions"]) == ["body.mtl"]  # and no source: that is no texture
    assert served.ask(f"file/{found['companions']['body.mtl']}")[1] == inside.read_bytes()


def test_a_mesh_that_leads_outside_by_a_link_is_not_given(
    served: Served, tmp_path_factory: pytest.TempPathFactory
) -> None:
    outside = tmp_path_factory.mktemp("outside") / "other.obj"
    outside.write_text(MESH)
    mesh = served.path.parent / "body.obj"
    key = served.state()["robot"]["links"]["body_link"]["visual"][0]["mesh"]["key"]
    mesh.unlink()
    mesh.symlink_to(outside)
    served.session.build()
    assert served.state()["fault"] is not None  # the build itself refuses it
    assert served.ask(f"file/{key}")[1] != MESH.encode()


def test_a_mesh_that_appears_or_changes_is_seen(served: Served) -> None:
    def mesh() -> Any:
        return served.state()["robot"]["links"]["body_link"]["visual"][0]["mesh"]

    path = served.path.parent / "body.obj"
    path.unlink()
    wait_for(served.rebuilder.has_changed)
    served.session.build()
    assert mesh() is None
    assert "missing-mesh-file" in str(served.state()["robot"]["diagnostics"])
    path.write_text(MESH)
    wait_for(served.rebuilder.has_changed)
    served.session.build()
    before = mesh()["key"]
    path.write_text(MESH + "# changed\n")
    wait_for(served.rebuilder.has_changed)
    served.session.build()
    assert mesh()["key"] != before
    (path.parent / "body.mtl").write_text("newmtl plain\n")  # the mesh names it; it was not there
    path.write_text(MESH)
    wait_for(served.rebuilder.has_changed)
    served.session.build()
    (path.parent / "body.mtl").write_text("newmtl other\n")
    wait_for(served.rebuilder.has_changed)


# --- what is asked for --------------------------------------------------------------------------


def test_a_variable_is_set_and_taken_back(served: Served) -> None:
    assert served.ask("variables", "POST", {"side": 0.5})[0] == 200
    assert served.session.wake.is_set()
    served.session.build()
    state = served.state()
    assert state["variables"][0]["value"] == 0.5
    assert 'iyy="0.0283333333333333"' in state["robot"]["urdf"]  # (0.5² + 0.3²) kg·m² / 12
    assert served.ask("variables", "POST", {"side": None})[0] == 200
    served.session.build()
    assert served.state()["variables"][0]["value"] == 0.1


def test_variables_of_another_name_or_kind_are_refused(served: Served) -> None:
    wrong: list[dict[str, object]] = [
        {"sied": 1},
        {"side": "wide"},
        {"side": True},
        {"side": [1]},
        {"side": {}},
    ]
    for values in wrong:
        assert served.ask("variables", "POST", values)[0] == 400, values
    assert served.ask("variables", "POST", {"side": 0.5, "sied": 1})[0] == 400
    served.session.build()
    assert served.state()["variables"][0]["value"] == 0.1


def test_a_place_is_opened_by_its_number_and_version(served: Served) -> None:
    state = served.state()
    link = state["robot"]["links"]["body_link"]
    version = state["robotVersion"]
    assert served.ask("open", "POST", {"place": link["place"], "version": version})[0] == 200
    assert served.editor.opened == [(str(served.path), 7, 5)]
    assert served.ask("open", "POST", {"variable": "side"})[0] == 200
    assert served.editor.opened[1:] == [(str(served.path), 3, 9)]
    for place, version_sent, status in ((999, version, 409), (-1, version, 409), (0, 0, 409),
                                        ("/etc/passwd", version, 400), (True, 1, 400)):  # fmt: skip
        asked = {"place": place, "version": version_sent}
        assert served.ask("open", "POST", asked)[0] == status, asked
    assert served.ask("open", "POST", {"variable": "/etc/passwd"})[0] == 409
    assert len(served.editor.opened) == 2


def test_without_an_editor_nothing_is_opened(served: Served) -> None:
    served.server.editor = None
    assert served.ask("open", "POST", {"variable": "side"})[0] == 409


def test_an_editor_that_cannot_be_started_is_told(served: Served) -> None:
    served.server.editor = Editor(["/nowhere/to-be-found"])
    status, content, _ = served.ask("open", "POST", {"variable": "side"})
    assert status == 409 and b"'to-be-found' cannot be started" in content


# --- clients as they are ------------------------------------------------------------------------


def events(served: Served) -> socket.socket:
    """Return an open stream of events that has told the version."""
    stream = socket.create_connection(("127.0.0.1", served.port), timeout=PATIENCE)
    stream.sendall(f"GET {served.base}events HTTP/1.1\r\nHost: {served.host}\r\n\r\n".encode())
    read_until(stream, b"data: ")
    return stream


def read_until(stream: socket.socket, text: bytes) -> None:
    seen = b""
    while text not in seen:
        chunk = stream.recv(4096)
        assert chunk, seen
        seen += chunk


def test_a_stream_tells_of_each_build(served: Served) -> None:
    with events(served) as stream:
        served.session.build()
        read_until(stream, b"data: 2")


def test_streams_whose_client_vanishes_leave_no_thread(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(serving, "SECONDS_BETWEEN_SIGNS", 0.05)
    before = answering()
    streams = [events(served) for _ in range(20)]
    assert len(answering() - before) >= 20
    for stream in streams:
        stream.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")  # reset
        stream.close()
    wait_for(lambda: answering() <= before)
    assert served.ask("state")[0] == 200


def answering() -> set[threading.Thread]:
    """Return the threads that answer requests."""
    return {one for one in threading.enumerate() if "process_request_thread" in one.name}


def test_more_clients_than_there_are_places_do_not_hang_the_others(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(serving, "SECONDS_BETWEEN_SIGNS", 0.05)
    idle = [socket.create_connection(("127.0.0.1", served.port)) for _ in range(80)]
    for each in idle:
        each.close()
    wait_for(lambda: served_at_all(served))


def served_at_all(served: Served) -> bool:
    try:
        return served.ask("state")[0] == 200
    except (OSError, http.client.HTTPException):
        return False


def test_a_client_that_says_nothing_is_let_go(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(serving.Handler, "timeout", 0.2)
    with socket.create_connection(("127.0.0.1", served.port), timeout=PATIENCE) as client:
        client.sendall(b"GET /")
        assert client.recv(100) == b""


def test_garbage_on_the_socket_does_no_harm(
    served: Served, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(serving.Handler, "timeout", 0.2)
    chance = random.Random(3)
    host = served.host.encode()
    start = f"GET {served.base}state HTTP/1.1\r\n".encode()
    pieces = [
        b"\0" * 1000,
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",  # TLS
        b"GET " + b"a" * 100_000 + b" HTTP/1.1\r\n\r\n",
        b"GET / HTTP/9.9\r\n\r\n",
        b"GET\r\n\r\n",
        b"BREW /pot HTCPCP/1.0\r\n\r\n",
        start + b"X: y\r\n" * 1000 + b"\r\n",
        start + b"Host: " + host + b"\r\nHost: " + host + b"\r\n\r\n",
        start + b": nameless\r\n\r\n",
        b"POST " + served.base.encode() + b"variables HTTP/1.1\r\nHost: " + host
        + b"\r\nContent-Type: application/json\r\nContent-Length: 50\r\n\r\n{",
        b"POST " + served.base.encode() + b"variables HTTP/1.1\r\nHost: " + host
        + b"\r\nContent-Type: application/json\r\nContent-Length: -5\r\n\r\n{}",
        *(chance.randbytes(chance.randrange(1, 2000)) for _ in range(30)),
    ]  # fmt: skip
    for piece in pieces:
        with socket.create_connection(("127.0.0.1", served.port), timeout=PATIENCE) as client:
            try:
                client.sendall(piece)
                client.shutdown(socket.SHUT_WR)
                while client.recv(65536):
                    pass
            except OSError:
                continue
    wait_for(lambda: served_at_all(served))
    assert served.session.wake.is_set() is False
    assert capfd.readouterr().err == ""


@pytest.mark.slow
def test_hundreds_of_builds_do_not_add_up(tmp_path: Path) -> None:
    if not os.path.exists("/proc/self/statm"):
        pytest.skip("the system does not tell how much memory a process has")

    def memory() -> int:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    (tmp_path / "body.obj").write_text(MESH)
    served = Served(tmp_path, TRUSTED)  # all happens in this process, and nothing in a jail
    sizes = []
    for number in range(500):
        served.path.write_text(ROBOT.replace("0.1", f"{0.1 + number / 1000:.3f}"))
        served.rebuilder.forget()
        served.session.build()
        iyy = float(served.state()["robot"]["urdf"].partition('iyy="')[2].partition('"')[0])
        assert iyy == pytest.approx(((0.1 + number / 1000) ** 2 + 0.3**2) / 12)
        if number % 100 == 99:
            sizes.append(memory())
    serving.stop(served.server)
    assert sizes[-1] - sizes[0] < 8 << 20, sizes


# --- the command --------------------------------------------------------------------------------


def test_files_are_not_trusted_unless_that_is_said(
    view: Callable[..., Viewer], tmp_path: Path
) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(
        "robot: sly\nimport: os\nprocess: os.mkdir('made')\nmodel:\n  link/name=base:\n".replace(
            "'made'", repr(str(tmp_path / "made"))
        )
    )
    viewer = view(path)
    wait_for(lambda: "error" in viewer.said)
    assert "PermissionError" in viewer.said or "unsafe-code" in viewer.said
    assert viewer.end() == 0 and not (tmp_path / "made").exists()
    viewer = view(path, "--trust")
    wait_for((tmp_path / "made").exists)
    assert viewer.end() == 0


def test_wrong_usage_is_told_at_once(view: Callable[..., Viewer], tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    for options, said in (
        (["--port", "many"], "'--port' takes a number from 0 to 65535, not 'many'"),
        (["--editor", ""], "'--editor' takes a command"),
        (["--editor", "'"], "'--editor' takes a command"),
        (["side=2"], "unexpected argument '"),
        ([":=2"], "is not of the form name:=value"),
    ):
        viewer = view(path, *options)
        assert viewer.process.wait(PATIENCE) == 2, options
        assert said in viewer.said
    viewer = view(tmp_path / "nothing.yaml")
    assert viewer.process.wait(PATIENCE) == 2
    assert "cannot read" in viewer.said and "the file does not exist" in viewer.said


def test_a_port_that_is_taken_is_told(view: Callable[..., Viewer], tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        viewer = view(path, "--port", port)
        assert viewer.process.wait(PATIENCE) == 2
    assert f"the port {port} is not available: Address already in use" in viewer.said


# --- clients that dawdle ------------------------------------------------------------------------


@pytest.fixture
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no client go because of the time."""
    monkeypatch.setattr(serving, "SECONDS_TO_READ", PATIENCE)
    monkeypatch.setattr(serving.Handler, "timeout", PATIENCE)


def dawdlers(served: Served, count: int) -> list[socket.socket]:
    """Return connections that each have sent the beginning of a request."""
    found = []
    for _ in range(count):
        stranger = socket.create_connection(("127.0.0.1", served.port), timeout=PATIENCE)
        stranger.sendall(b"GET /")
        found.append(stranger)
    return found


def is_ended(connection: socket.socket) -> bool:
    connection.setblocking(False)
    try:
        return connection.recv(1) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True


@pytest.mark.usefixtures("patient")
def test_clients_that_dawdle_do_not_keep_the_page_away(served: Served) -> None:
    strangers = dawdlers(served, serving.MOST_CONNECTIONS + serving.MOST_STRANGERS + 10)
    try:
        for _ in range(3):
            assert served.ask("state")[0] == 200
        surplus = len(strangers) - serving.MOST_STRANGERS
        wait_for(lambda: sum(map(is_ended, strangers)) >= surplus)
        assert not is_ended(strangers[-1])  # it is the oldest that have to go
    finally:
        for stranger in strangers:
            stranger.close()
    wait_for(lambda: not served.server._strangers and not served.server._known)


def test_a_client_that_sends_bit_by_bit_is_ended_after_a_time(served: Served) -> None:
    (stranger,) = dawdlers(served, 1)
    with served.server._lock:
        served.server._strangers = dict.fromkeys(served.server._strangers, -1000000000.0)
    wait_for(lambda: is_ended(stranger))
    stranger.close()


@pytest.mark.usefixtures("patient")
def test_a_client_with_the_token_stays_when_strangers_come(served: Served) -> None:
    own = http.client.HTTPConnection("127.0.0.1", served.port, timeout=PATIENCE)
    own.request("GET", served.base + "state")
    assert own.getresponse().read()
    strangers = dawdlers(served, 2 * serving.MOST_STRANGERS)
    wait_for(lambda: is_ended(strangers[0]))
    own.request("GET", served.base + "state")  # by the same connection
    answer = own.getresponse()
    assert answer.status == 200 and answer.read()
    own.close()
    for stranger in strangers:
        stranger.close()


def test_there_are_not_more_known_clients_than_may_be(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(serving, "MOST_CONNECTIONS", 1)
    own = http.client.HTTPConnection("127.0.0.1", served.port, timeout=PATIENCE)
    own.request("GET", served.base + "state")
    assert own.getresponse().read()
    assert served.ask("state")[0] == 503
    own.close()
    wait_for(lambda: not served.server._known)
    assert served.ask("state")[0] == 200
