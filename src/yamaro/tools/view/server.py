"""Serves the page to browsers on this machine only.

Other programs and other pages can send requests to a port of this machine. So the server listens
on the loopback interface, answers only where the Host header names it, refuses what a page of
another origin sends, and has a random token in the path of everything. It gives no file by a name
that the client chooses.
"""

from __future__ import annotations

import hmac
import json
import os
import secrets
import socket
import sys
import threading
import time
from collections.abc import Callable, Iterable, Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from socketserver import TCPServer
from typing import Any
from urllib.parse import quote

from .session import FORMATS, Session
from .variables import WrongValue

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .viewing import Editor

HOST = "127.0.0.1"
MOST_CONNECTIONS = 64
"""Connections at once of clients that know the token."""
MOST_STRANGERS = 32
"""Connections at once of clients that have not shown it yet; a further one ends the oldest."""
MOST_BODY = 64 << 10
SECONDS_TO_READ = 10.0
"""Seconds that a client has to show the token, and then for each piece of request or answer."""
SECONDS_BETWEEN_SIGNS = 5.0
"""Seconds after which an event stream with nothing to report shows that it lives; so it is noticed
when nobody listens any more."""
CHUNK = 1 << 16

STATIC = {
    "": ("index.html", "text/html; charset=utf-8"),
    "view.js": ("view.js", "text/javascript; charset=utf-8"),
    "view.css": ("view.css", "text/css; charset=utf-8"),
    "icon.svg": ("icon.svg", "image/svg+xml"),
}
_CONTENT_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' blob: data:",
        "connect-src 'self' blob: data:",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    )
)
_EDITORS = (
    "vscode-webview: vscode-file: https://*.vscode-cdn.net http://127.0.0.1:* http://localhost:*"
)
"""What may have the page in a frame if an editor asks for it, which has to know the token."""
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": _CONTENT_POLICY,
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}
EMBEDDED_HEADERS = {
    **{name: value for name, value in HEADERS.items() if name != "X-Frame-Options"},
    "Content-Security-Policy": _CONTENT_POLICY.replace(
        "frame-ancestors 'none'", f"frame-ancestors {_EDITORS}"
    ),
    "Cross-Origin-Resource-Policy": "cross-origin",
    "Cache-Control": "no-store, no-transform",  # what hands a port on must not hold events back
}
"""The headers for a page in a frame of an editor."""


_WRONG_ADDRESS = (
    "There is nothing at this address. Open the one that yamaro view has printed, "
    "which is another at each start."
)


class Refused(Exception):
    """A request is not answered; the status says why."""

    def __init__(self, status: HTTPStatus, reason: str = "") -> None:
        """Hold the status, and what to say in place of its usual phrase."""
        super().__init__(reason or status.phrase)
        self.status = status


class Server(ThreadingHTTPServer):
    """A server of one session on the loopback interface.

    Attributes:
        session: what is shown.
        editor: opens files, or None.
        token: the secret in the path.
        static: the files of the page, by the name in the path.
        hosts: what the Host header may be.
        is_embedded: whether the page is for a frame of an editor.
    """

    daemon_threads = True
    block_on_close = False
    allow_reuse_address = os.name != "nt"  # there it would let others take the port over
    request_queue_size = 32

    def __init__(
        self, session: Session, *, port: int, editor: Editor | None, is_embedded: bool = False
    ) -> None:
        """Listen; raise OSError if the port is not available."""
        super().__init__((HOST, port), Handler)
        self.is_embedded = is_embedded
        self.session = session
        self.editor = editor
        self.token = secrets.token_urlsafe(18)
        self.static = read_static()
        self.hosts = frozenset(f"{name}:{self.server_port}" for name in (HOST, "localhost"))
        self._lock = threading.Lock()
        self._strangers: dict[socket.socket, float] = {}  # since when, the oldest first
        self._known: set[socket.socket] = set()

    @property
    def url(self) -> str:
        """Return the address of the page."""
        return f"http://{HOST}:{self.server_port}/{self.token}/"

    def is_host(self, host: str) -> bool:
        """Return whether a Host header names this server.

        An editor that runs elsewhere hands its own port on to ours, of which it alone knows.
        """
        name, _, port = host.partition(":")
        is_handed_on = self.is_embedded and name in (HOST, "localhost") and port.isdigit()
        return host in self.hosts or is_handed_on

    def server_bind(self) -> None:
        """Bind, without looking up the name of this machine, which may take seconds."""
        TCPServer.server_bind(self)
        self.server_name, self.server_port = HOST, self.server_address[1]

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer in a thread of its own; clients that dawdle make room for this one."""
        with self._lock:
            self._strangers[request] = time.monotonic()
            surplus = list(self._strangers)[:-MOST_STRANGERS]
        self._end(surplus)
        try:
            super().process_request(request, client_address)
        except RuntimeError:  # no thread can be started
            self._forget(request)
            self.shutdown_request(request)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """Answer, and make room for another."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._forget(request)

    def service_actions(self) -> None:
        """End the connections of clients that take too long to show the token."""
        since = time.monotonic() - SECONDS_TO_READ
        with self._lock:
            late = [each for each, begun in self._strangers.items() if begun < since]
        self._end(late)

    def let_in(self, request: Any) -> bool:
        """Count a client among those that know the token, if there are not too many."""
        with self._lock:
            if request not in self._known:
                if len(self._known) >= MOST_CONNECTIONS:
                    return False
                self._known.add(request)
                self._strangers.pop(request, None)
        return True

    def _forget(self, request: Any) -> None:
        with self._lock:
            self._strangers.pop(request, None)
            self._known.discard(request)

    def _end(self, requests: Iterable[socket.socket]) -> None:
        """End connections: the threads that read from them notice, and close them."""
        for request in requests:
            with self._lock:
                self._strangers.pop(request, None)
            try:
                request.shutdown(socket.SHUT_RDWR)
            except OSError:
                continue

    def handle_error(self, request: object, client_address: object) -> None:
        """Ignore clients that go away or send garbage; show other errors to developers."""
        if isinstance(sys.exc_info()[1], (OSError, ValueError)):
            return
        if os.environ.get("YAMARO_TRACEBACK"):
            super().handle_error(request, client_address)  # type: ignore[arg-type]


class Handler(BaseHTTPRequestHandler):
    """Answers the requests of one connection."""

    server: Server
    protocol_version = "HTTP/1.1"
    server_version = "yamaro"
    sys_version = ""
    timeout = SECONDS_TO_READ
    disable_nagle_algorithm = True

    def do_GET(self) -> None:
        """Answer a request for a file, the state or the stream of events."""
        self._answer(self._get)

    def do_POST(self) -> None:
        """Carry out what the page asks for."""
        self._answer(self._post)

    def _answer(self, act: Callable[[str], None]) -> None:
        try:
            self._check_sender()
            path = self.path.partition("?")[0]
            token, slash, rest = path[1:].partition("/")
            is_known = hmac.compare_digest(token.encode(), self.server.token.encode())
            if not is_known or not slash:
                raise Refused(HTTPStatus.NOT_FOUND, _WRONG_ADDRESS)
            if not self.server.let_in(self.connection):
                raise Refused(HTTPStatus.SERVICE_UNAVAILABLE)
            act(rest)
        except Refused as refusal:
            self.close_connection = True
            self._send(str(refusal).encode(), "text/plain; charset=utf-8", refusal.status)

    def _check_sender(self) -> None:
        """Refuse requests under another name, or from a page of another origin."""
        hosts = self.headers.get_all("Host", [])
        if len(hosts) != 1 or not self.server.is_host(hosts[0].lower()):
            raise Refused(HTTPStatus.MISDIRECTED_REQUEST)
        origin = self.headers.get("Origin")
        if origin is not None and origin.lower() != f"http://{hosts[0].lower()}":
            raise Refused(HTTPStatus.FORBIDDEN)
        is_own = self.headers.get("Sec-Fetch-Site", "none") in ("none", "same-origin")
        if is_own:
            return
        # A person may have followed a link, as from a terminal in the browser.
        wanted = ("document", "iframe") if self.server.is_embedded else ("document",)
        is_page = self.headers.get("Sec-Fetch-Dest") in wanted
        if self.command != "GET" or not is_page or not self.path.endswith("/"):
            raise Refused(HTTPStatus.FORBIDDEN)

    # --- GET ------------------------------------------------------------------------------------

    def _get(self, path: str) -> None:
        kind, _, rest = path.partition("/")
        if path in self.server.static:
            data, content_type = self.server.static[path]
            self._send(data, content_type)
        elif path == "state":
            self._send(self.server.session.state(), "application/json")
        elif path == "events":
            self._send_events()
        elif kind == "file":
            self._send_file(rest)
        elif kind == "download":
            found = self.server.session.downloads.fetch(rest)
            if found is None:
                raise Refused(HTTPStatus.NOT_FOUND)
            name, content = found
            self._send(content, "application/octet-stream", name=name)
        else:
            raise Refused(HTTPStatus.NOT_FOUND)

    def _send_events(self) -> None:
        """Send the number of each new version until the client goes away; it asks for the rest."""
        self.close_connection = True
        self.send_response(HTTPStatus.OK)
        self._send_headers({"Content-Type": "text/event-stream", "Connection": "close"})
        told = -1
        while True:
            version = self.server.session.wait(told, SECONDS_BETWEEN_SIGNS)
            if version < 0:
                return
            self.wfile.write(b": still here\n\n" if version == told else b"data: %d\n\n" % version)
            told = version

    def _send_file(self, key: str) -> None:
        found = self.server.session.open_file(key)
        if found is None:
            raise Refused(HTTPStatus.NOT_FOUND)
        file, content = found
        with file:
            missing = file.seek(0, os.SEEK_END)
            file.seek(0)
            self.send_response(HTTPStatus.OK)
            self._send_headers({"Content-Type": content, "Content-Length": str(missing)})
            while missing and (chunk := file.read(min(CHUNK, missing))):
                self.wfile.write(chunk)
                missing -= len(chunk)
            if missing:  # it was cut short meanwhile; the client must not wait for the rest
                self.close_connection = True

    # --- POST -----------------------------------------------------------------------------------

    def _post(self, path: str) -> None:
        actions: dict[str, Callable[[Mapping[str, object]], bytes | None]] = {
            "variables": self._set_variables,
            "open": self._open,
            "download": self._download,
            "included": lambda _: self.server.session.included(),
            "rebuild": lambda _: self.server.session.rebuild(),
        }
        if path not in actions:
            raise Refused(HTTPStatus.NOT_FOUND)
        answer = actions[path](self._read_object())
        self._send(answer or b"{}", "application/json")

    def _read_object(self) -> Mapping[str, object]:
        """Return the JSON object that was sent."""
        if self.headers.get_content_type() != "application/json":
            raise Refused(HTTPStatus.UNSUPPORTED_MEDIA_TYPE)
        length = self.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdigit()):
            raise Refused(HTTPStatus.LENGTH_REQUIRED)
        if len(length) > 9 or int(length) > MOST_BODY:
            raise Refused(HTTPStatus.REQUEST_ENTITY_TOO_LARGE)
        try:
            content = json.loads(self.rfile.read(int(length)))
        except (ValueError, RecursionError):
            raise Refused(HTTPStatus.BAD_REQUEST, "this is not JSON") from None
        if not isinstance(content, dict):
            raise Refused(HTTPStatus.BAD_REQUEST, "this is not a JSON object")
        return content

    def _set_variables(self, values: Mapping[str, object]) -> None:
        try:
            self.server.session.set_variables(values)
        except WrongValue as error:
            raise Refused(HTTPStatus.BAD_REQUEST, str(error)) from None

    def _download(self, request: Mapping[str, object]) -> bytes:
        """Write the robot in a format; the answer says what was lost, and how to get the file."""
        format = request.get("format")
        if not isinstance(format, str) or format not in FORMATS:
            raise Refused(HTTPStatus.BAD_REQUEST, "there is no such output format")
        return self.server.session.download(format)

    def _open(self, request: Mapping[str, object]) -> None:
        """Open a place in the editor; the page knows places by number, and variables by name."""
        editor = self.server.editor
        if editor is None:
            raise Refused(HTTPStatus.CONFLICT, "there is no editor to open it in")
        session = self.server.session
        name, number = request.get("variable"), request.get("place")
        version = request.get("version")
        if isinstance(name, str):
            place = session.place_of_variable(name)
        elif type(number) is not int or type(version) is not int:
            raise Refused(HTTPStatus.BAD_REQUEST)
        else:
            is_fault = request.get("isFault") is True
            place = session.place(number, version=version, is_fault=is_fault)
        if place is None or not os.path.isfile(place[0]):
            raise Refused(HTTPStatus.CONFLICT, "that place is not there any more")
        try:
            editor.open(*place)
        except OSError as error:
            reason = error.strerror or str(error)
            raise Refused(
                HTTPStatus.CONFLICT, f"'{editor.name}' cannot be started: {reason}"
            ) from None

    # --- answers --------------------------------------------------------------------------------

    def _send(
        self, data: bytes, content: str, status: HTTPStatus = HTTPStatus.OK, *, name: str = ""
    ) -> None:
        """Send an answer, which the browser saves under the name if there is one."""
        headers = {"Content-Type": content, "Content-Length": str(len(data))}
        if name:
            escaped = quote(name, "", errors="replace")
            headers["Content-Disposition"] = f"attachment; filename*=UTF-8''{escaped}"
        self.send_response(status)
        self._send_headers(headers)
        self.wfile.write(data)

    def _send_headers(self, own: Mapping[str, str]) -> None:
        if self.close_connection and "Connection" not in own:
            own = {**own, "Connection": "close"}
        headers = EMBEDDED_HEADERS if self.server.is_embedded else HEADERS
        for name, value in {**headers, **own}.items():
            self.send_header(name, value)
        self.end_headers()

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Answer a request that is not HTTP, in plain words."""
        self.close_connection = True
        status = HTTPStatus(code)
        self._send(status.phrase.encode(), "text/plain; charset=utf-8", status)

    def log_message(self, format: str, *args: object) -> None:
        """Log nothing: the terminal shows builds."""


def read_static() -> dict[str, tuple[bytes, str]]:
    """Return the files of the page with their types, by the name in the path."""
    folder = os.path.join(os.path.dirname(__file__), "static")
    found = {}
    for name, (file_name, content) in STATIC.items():
        with open(os.path.join(folder, file_name), "rb") as file:
            found[name] = (file.read(), content)
    return found


def start(server: Server) -> threading.Thread:
    """Answer requests in another thread from now on."""
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.1})
    thread.daemon = True
    thread.start()
    return thread


def stop(server: Server) -> None:
    """End the server and its connections."""
    server.session.close()
    server.shutdown()
    server.server_close()
