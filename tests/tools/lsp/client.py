"""A client for tests: speaks to `yamaro lsp` as an editor does."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tests.waiting import PATIENCE

UTF_32 = {"general": {"positionEncodings": ["utf-8", "utf-16", "utf-32"]}}


class Client:
    """A server in a process of its own, and what it has said."""

    def __init__(
        self,
        folder: Path | None = None,
        *,
        options: dict[str, Any] | None = None,
        capabilities: dict[str, Any] | None = None,
        env: Mapping[str, str | None] | None = None,
        command: tuple[str, ...] = (sys.executable, "-m", "yamaro", "lsp"),
    ) -> None:
        """Start a server; a variable of the environment that is None in `env` is taken away."""
        changed = {**os.environ, **(env or {})}
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env={name: value for name, value in changed.items() if value is not None},
        )
        self._messages: queue.Queue[Any] = queue.Queue()
        self._number = 0
        self._results: dict[int, Any] = {}
        self.diagnostics: dict[str, list[Any]] = {}
        self.published: list[Any] = []
        self.logs: list[str] = []
        self.versions: dict[str, int] = {}
        threading.Thread(target=self._read, daemon=True).start()
        uri = folder.as_uri() if folder is not None else None
        self.server = self.request(
            "initialize",
            {
                "processId": os.getpid(),
                "rootUri": uri,
                "capabilities": capabilities or {},
                # On a busy machine a build takes longer than the default.
                "initializationOptions": {"timeout": PATIENCE * 1000, **(options or {})},
                "workspaceFolders": [{"uri": uri, "name": "work"}] if uri else None,
            },
        )
        self.notify("initialized", {})

    # --- messages -----------------------------------------------------------------------

    def _read(self) -> None:
        stream = self.process.stdout
        assert stream is not None
        while True:
            length = -1
            while line := stream.readline().strip():
                name, _, value = line.partition(b":")
                assert name == b"Content-Length", f"not the protocol: {line!r}"
                length = int(value)
            if length < 0:
                self._messages.put(None)
                return
            self._messages.put(json.loads(stream.read(length)))

    def send(self, message: dict[str, Any]) -> None:
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.send_bytes(b"Content-Length: %d\r\n\r\n%b" % (len(data), data))

    def send_bytes(self, data: bytes) -> None:
        stream = self.process.stdin
        assert stream is not None
        stream.write(data)
        stream.flush()

    def notify(self, method: str, parameters: Any) -> None:
        self.send({"method": method, "params": parameters})

    def request(self, method: str, parameters: Any) -> Any:
        """Return the result of a request; fail if it is an error."""
        message = self.ask(method, parameters)
        assert "error" not in message, (message, self.logs)
        return message["result"]

    def ask(self, method: str, parameters: Any) -> Any:
        """Return the answer to a request, which may be an error."""
        self._number += 1
        number = self._number
        self.send({"id": number, "method": method, "params": parameters})
        while number not in self._results:
            self.take()
        return self._results.pop(number)

    def take(self) -> None:
        """Take one message of the server."""
        message = self._messages.get(timeout=PATIENCE)
        assert message is not None, self.end_text()
        if "id" in message and "method" not in message:
            self._results[message["id"]] = message
        elif message["method"] == "textDocument/publishDiagnostics":
            parameters = message["params"]
            self.published.append(parameters)
            self.diagnostics[parameters["uri"]] = parameters["diagnostics"]
            if "version" in parameters:
                self.versions[parameters["uri"]] = parameters["version"]
        elif message["method"] == "window/logMessage":
            self.logs.append(message["params"]["message"])

    def end_text(self) -> str:
        stream = self.process.stderr
        assert stream is not None
        return stream.read().decode()

    def wait_for(self, condition: Any) -> None:
        """Take messages until a condition holds."""
        while not condition():
            self.take()

    # --- documents ----------------------------------------------------------------------

    def open(self, path: Path, text: str | None = None, *, version: int = 1) -> str:
        """Open a file, whose text is that on the disk unless another is given; return its URI."""
        uri = path.as_uri()
        if text is None:
            text = path.read_bytes().decode()
        document = {"uri": uri, "languageId": "yamaro", "version": version, "text": text}
        self.notify("textDocument/didOpen", {"textDocument": document})
        return uri

    def change(self, uri: str, version: int, changes: list[Any]) -> None:
        self.notify(
            "textDocument/didChange",
            {"textDocument": {"uri": uri, "version": version}, "contentChanges": changes},
        )

    def codes(self, uri: str) -> list[str]:
        return [each["code"] for each in self.diagnostics.get(uri, [])]

    def wait_for_codes(self, uri: str, codes: list[str]) -> None:
        self.wait_for(lambda: uri in self.diagnostics and self.codes(uri) == codes)

    def at(self, uri: str, text: str, mark: str, *, after: int = 0) -> Any:
        """Return the parameters for the place of a mark in a text, plus some columns."""
        offset = text.index(mark) + after
        line = text.count("\n", 0, offset)
        column = offset - (text.rfind("\n", 0, offset) + 1)
        return {
            "textDocument": {"uri": uri},
            "position": {"line": line, "character": column},
        }

    # --- the end ------------------------------------------------------------------------

    def close(self) -> int:
        """Shut the server down and return its exit status."""
        self.request("shutdown", None)
        self.notify("exit", None)
        return self.wait()

    def wait(self) -> int:
        status = self.process.wait(timeout=PATIENCE)
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            assert stream is not None
            stream.close()
        return status

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        if self.process.poll() is None:
            self.process.kill()
            self.wait()
