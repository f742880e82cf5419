"""Serves a folder to a browser on this machine."""

from __future__ import annotations

import functools
import http.server
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.waiting import PATIENCE


class _Handler(http.server.SimpleHTTPRequestHandler):
    def __init__(self, *arguments: Any, held: Mapping[str, threading.Event], **others: Any) -> None:
        self._held = held
        super().__init__(*arguments, **others)

    def do_GET(self) -> None:
        if self.path in self._held:
            self._held[self.path].wait(PATIENCE)
        super().do_GET()

    def log_message(self, format: str, *arguments: Any) -> None:
        """Say nothing."""


@contextmanager
def served(folder: Path, held: Mapping[str, threading.Event] | None = None) -> Iterator[str]:
    """Serve a folder within a `with` block, which is given the address.

    Args:
        folder: what is served.
        held: paths that are answered only once their event is set.
    """
    handler = functools.partial(_Handler, directory=str(folder), held=held or {})
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/"
        finally:
            server.shutdown()
