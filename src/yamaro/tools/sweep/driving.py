"""Drives the process in which variants are built: starts it, takes its rows, ends it."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from time import monotonic

from ...diagnostics import YamaroError, failure_of_all
from .child import BROKEN, DONE, READY, receive, send

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any, BinaryIO

    from .plan import Plan
    from .rows import Row

START_UP = 300.0
"""Seconds that a process has until it is ready."""
LOOKING_INTERVAL = 0.1
"""Seconds between two looks at whether the time of a variant is over."""
_CODE = """
import sys
sys.path[:] = {path!r}
from yamaro.tools.sweep.child import main
main()
"""


class ChildEnded(Exception):
    """The process ended amid its work.

    Attributes:
        status: its exit status; negative for the number of a signal.
        is_late: whether it was ended because the time of a variant was over.
        is_ready: whether it had begun with variants.
    """

    def __init__(self, status: int, *, is_late: bool, is_ready: bool) -> None:
        super().__init__()
        self.status = status
        self.is_late = is_late
        self.is_ready = is_ready


class Child:
    """A process in which variants of a plan are built.

    Attributes:
        run: which run of a plan it serves.
        files: the hashes of the files that it has read.
    """

    def __init__(self, plan: Plan, folder: str) -> None:
        """Start the process."""
        self.run = plan.run
        self.files: dict[str, str] = {}
        self._seconds = plan.seconds
        self._until = monotonic() + START_UP
        self._is_late = self._is_ready = self._is_closed = False
        self._life = -1
        self._process = self._started()
        threading.Thread(target=self._watch, daemon=True).start()
        assert self._process.stdin is not None and self._process.stdout is not None
        self._requests: BinaryIO = self._process.stdin  # type: ignore[assignment]
        self._answers: BinaryIO = self._process.stdout  # type: ignore[assignment]
        self._tell((plan, folder))

    def _started(self) -> subprocess.Popen[bytes]:
        """Return the process, which ends when the other end of a pipe is closed."""
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        more: dict[str, Any] = {}
        life = -1
        if os.name == "posix":
            life, self._life = os.pipe()
            environment["YAMARO_SWEEP_LIFE"] = str(life)
            more = {"pass_fds": (life,), "start_new_session": True}
        try:
            return subprocess.Popen(
                [sys.executable, "-c", _CODE.format(path=sys.path)],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                env=environment, **more,
            )  # fmt: skip
        finally:
            if life >= 0:
                os.close(life)

    def is_alive(self) -> bool:
        """Return whether the process is there, and can be given more work."""
        return not self._is_closed and self._process.poll() is None

    def rows(self, start: int, stop: int) -> Iterator[Row]:
        """Have variants built, and yield their rows as they come.

        Raises:
            ChildEnded: the process ended before all were there.
            YamaroError: it cannot build any.
        """
        if not self._is_ready:
            self._wait()
        self._until = monotonic() + self._seconds
        self._tell((start, stop))
        while True:
            kind, content = self._answer()
            if kind == DONE:
                self._until = float("inf")
                self.files.update(content)
                return
            self._until = monotonic() + self._seconds
            yield content

    def _wait(self) -> None:
        kind, content = self._answer()
        if kind == BROKEN:
            if isinstance(content, list):
                raise YamaroError(content)
            raise failure_of_all("sweep-engine", f"a worker cannot begin: {content}", "sweep", None)
        assert kind == READY
        self._is_ready = True

    def _tell(self, message: Any) -> None:
        try:
            send(self._requests, message)
        except OSError:
            return  # it has ended, which the next answer shows

    def _answer(self) -> Any:
        try:
            return receive(self._answers)
        except (EOFError, OSError, ValueError):  # it ended, or another thread closed the pipe
            raise self._ended() from None

    def _ended(self) -> ChildEnded:
        self.close()
        status = self._process.wait()
        return ChildEnded(status, is_late=self._is_late, is_ready=self._is_ready)

    def _watch(self) -> None:
        """End the process when the time of a variant is over; in a thread."""
        while not self._is_closed:
            if monotonic() > self._until:
                self._is_late = True
                break
            try:
                self._process.wait(LOOKING_INTERVAL)
                break  # what it has started may keep the pipe open
            except subprocess.TimeoutExpired:
                continue
        self._kill()

    def _kill(self) -> None:
        """End the process, and what it has started."""
        try:
            if os.name == "posix":
                os.killpg(self._process.pid, 9)
            else:
                self._process.kill()
        except OSError:
            return

    def close(self) -> None:
        """End the process."""
        if self._is_closed:
            return
        self._is_closed = True
        self._kill()
        for stream in (self._requests, self._answers):
            try:
                stream.close()
            except OSError:
                continue
        self._process.wait()
        if self._life >= 0:
            os.close(self._life)
            self._life = -1
