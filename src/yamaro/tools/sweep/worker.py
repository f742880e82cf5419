"""Workers: the processes in which variants are built, and the chunks of work they are given.

A worker of any engine has a process of its own build the variants of a chunk, and starts another
one when it crashes, hangs or takes too much memory. The process sends each row as soon as it is
there, so what is lost is one variant. It ends with the one that drives it, in whatever way that
ends.
"""

from __future__ import annotations

import os
import pickle
import select
import struct
import subprocess
import sys
import threading
from collections.abc import Iterator, Mapping
from time import monotonic
from typing import Any, BinaryIO

from ...diagnostics import Diagnostic, YamaroError, failure_of_all
from .builder import Builder, packed
from .plan import Plan, Space, versions_for
from .table import CRASH, FAILED, OUT_OF_MEMORY, STATUSES, TIMEOUT, Columns, Row, encoded, row_types

# --- the process in which variants are built --------------------------------------------------


READY, ROW, DONE, BROKEN = "ready", "row", "done", "broken"
"""What messages are about."""
IDLE_SECONDS = 300.0
"""Seconds after which a process ends for which nobody has work, as when a cluster goes on."""
_LENGTH = struct.Struct("<Q")


def send(stream: BinaryIO, message: Any) -> None:
    """Write a message; raise OSError if nobody reads it any more."""
    data = pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL)
    stream.write(_LENGTH.pack(len(data)) + data)
    stream.flush()


def receive(stream: BinaryIO) -> Any:
    """Return the next message; raise EOFError if there is none."""
    head = stream.read(_LENGTH.size)
    if len(head) < _LENGTH.size:
        raise EOFError
    (length,) = _LENGTH.unpack(head)
    data = stream.read(length)
    if len(data) < length:
        raise EOFError
    return pickle.loads(data)


def main() -> None:
    """Serve the process that started this one, until it closes the pipe."""
    requests = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    null = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):  # nothing that a robot or a library prints gets into the messages
        os.dup2(null, descriptor)
    try:
        plan, folder = receive(requests)
        _end_with_driver()
        try:
            builder = _builder(plan, folder)
        except YamaroError as error:
            for diagnostic in error.diagnostics:
                diagnostic.trace = None  # which cannot be sent
            send(answers, (BROKEN, error.diagnostics))
            return
        except Exception as error:
            send(answers, (BROKEN, f"{type(error).__name__}: {error}"))
            return
        send(answers, (READY, None))
        while os.name != "posix" or select.select([requests], [], [], IDLE_SECONDS)[0]:
            start, stop = receive(requests)
            for row in builder.rows(start, stop):
                send(answers, (ROW, row))
            send(answers, (DONE, (builder.files, builder.take())))
    except (EOFError, OSError):
        return


def _builder(plan: Any, folder: str) -> Any:
    import gc
    import platform
    import warnings

    from ...sandbox.process import bound_memory

    warnings.simplefilter("ignore")
    found = versions_for(plan)
    if found != plan.versions:
        differences = [
            f"{name} {found.get(name) or 'none'} instead of {plan.versions.get(name) or 'none'}"
            for name in {**plan.versions, **found}
            if plan.versions.get(name) != found.get(name)
        ]
        message = f"the worker on {platform.node()} has {', '.join(differences)}"
        hint = "all workers need the versions with which the sweep began"
        raise failure_of_all("sweep-engine", message, "sweep", hint)
    if plan.memory:
        bound_memory(plan.memory)
    builder = Builder(plan, folder)
    gc.collect()
    gc.freeze()  # so that it does not look again and again through what stays
    return builder


def _end_with_driver() -> None:
    """Let this process end as soon as the one that drives it has ended.

    The kernel signals the end of the pipe from which requests come, also amid a long call of
    a function written in C. Where it cannot, the end is noticed with the next row.
    """
    try:
        import fcntl
        import signal

        life = int(os.environ.pop("YAMARO_SWEEP_LIFE", "-1"))
        if life < 0 or not hasattr(fcntl, "F_SETOWN"):
            return
        signal.signal(signal.SIGIO, signal.SIG_DFL)  # which ends the process
        fcntl.fcntl(life, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(life, fcntl.F_SETFL, fcntl.fcntl(life, fcntl.F_GETFL) | os.O_ASYNC)
        if select.select([life], [], [], 0)[0]:  # it ended before
            sys.exit(0)
    except (ImportError, AttributeError, OSError, ValueError):
        return


# --- what drives it ---------------------------------------------------------------------------


START_UP = 300.0
"""Seconds that a process has until it is ready."""
LOOKING_INTERVAL = 0.1
"""Seconds between two looks at whether the time of a variant is over."""
_CODE = """
import sys
sys.path[:] = {path!r}
from yamaro.tools.sweep.worker import main
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
        fields: of a batch, those of the last variants.
    """

    def __init__(self, plan: Plan, folder: str) -> None:
        """Start the process."""
        self.run = plan.run
        self.files: dict[str, str] = {}
        self.fields: dict[str, Any] = {}
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
            kind, content = self._answer()
            if kind == BROKEN and isinstance(content, list):
                raise YamaroError(content)
            if kind == BROKEN:
                message = f"a worker cannot begin: {content}"
                raise failure_of_all("sweep-engine", message, "sweep", None)
            assert kind == READY
            self._is_ready = True
        self._until = monotonic() + self._seconds
        self._tell((start, stop))
        while True:
            kind, content = self._answer()
            if kind == DONE:
                self._until = float("inf")
                files, self.fields = content
                self.files.update(files)
                return
            self._until = monotonic() + self._seconds
            yield content

    def _tell(self, message: Any) -> None:
        try:
            send(self._requests, message)
        except OSError:
            return  # it has ended, which the next answer shows

    def _answer(self) -> Any:
        try:
            return receive(self._answers)
        except (EOFError, OSError, ValueError):  # it ended, or another thread closed the pipe
            self.close()
            status = self._process.wait()
            raise ChildEnded(status, is_late=self._is_late, is_ready=self._is_ready) from None

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


# --- chunks -----------------------------------------------------------------------------------


ATTEMPTS, ATTEMPTS_IF_KILLED = 2, 4
"""How often a variant is built that ends its process; what killed it may be something else."""
_KILL = -9


class Chunk:
    """The result of a chunk.

    Attributes:
        number: its number.
        table: the file of the table with its rows.
        shard: the tar file of the models, or None.
        assets: the meshes of the models, by path.
        counts: how many variants have which status.
        files: the hashes of the files that were read.
        errors: why no variant can be built, in which case there is nothing else.
    """

    __slots__ = ("assets", "counts", "errors", "files", "number", "shard", "table")

    def __init__(self, number: int) -> None:
        self.number = number
        self.table = b""
        self.shard: bytes | None = None
        self.assets: dict[str, bytes] = {}
        self.counts: dict[str, int] = {}
        self.files: dict[str, str] = {}
        self.errors: list[Diagnostic] = []

    def add_files(self, files: Mapping[str, str]) -> None:
        """Note files that were read; raise YamaroError if one is another one than before."""
        for path, digest in files.items():
            if self.files.setdefault(path, digest) != digest:
                raise changed(path)


def changed(path: str) -> YamaroError:
    """Return the error for a file that changes while variants are built from it."""
    message = "the file has changed since the sweep began"
    return failure_of_all("sweep-differs", message, path, "begin again, in another folder")


class Stopped(Exception):
    """The sweep was stopped while this process worked for it."""


class _Children:
    """The processes of this worker that wait for more work."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._idle: list[Child] = []
        self._busy: set[Child] = set()
        self._stopped: set[str] = set()

    def take(self, plan: Plan, folder: str) -> Child:
        """Return a process for a plan; those that wait for another one are ended."""
        with self._lock:
            if plan.run in self._stopped:
                raise Stopped
            others = [child for child in self._idle if child.run != plan.run]
            self._idle = [child for child in self._idle if child.run == plan.run]
            found = self._idle.pop() if self._idle else None
        for other in others:
            other.close()
        if found is None or not found.is_alive():
            if found is not None:
                found.close()
            found = Child(plan, folder)
        with self._lock:
            self._busy.add(found)
        return found

    def give_back(self, child: Child, *, is_used_up: bool) -> None:
        """Take a process back, or end it."""
        with self._lock:
            self._busy.discard(child)
            if not is_used_up and child.run not in self._stopped:
                self._idle.append(child)
                return
        child.close()

    def stop(self, run: str) -> None:
        """End all processes of a run of a plan, also those that work."""
        with self._lock:
            self._stopped.add(run)
            found = [child for child in (*self._idle, *self._busy) if child.run == run]
            self._idle = [child for child in self._idle if child.run != run]
        for child in found:
            child.close()


_children = _Children()
stop = _children.stop


def run_chunk(plan: Plan, number: int, folder: str, ending: str) -> Chunk:
    """Build a chunk of variants, and return its part of the table.

    Args:
        plan: what variants there are.
        number: of the chunk.
        folder: that of the sweep, where it is run.
        ending: of the file of the table.
    """
    chunk = Chunk(number)
    places: dict[tuple[int, str], tuple[int, int]] = {}
    ends: list[str] = []
    try:
        rows = _rows(plan, *plan.bounds(number), folder, chunk)
        if plan.models:
            ends = sorted({end for row in rows for end in row.documents})
            chunk.shard, places = packed(rows)
            for row in rows:
                chunk.assets.update(row.assets)
        columns = Columns(row_types(plan), plan.hashed(), ends, has_topologies=plan.has_topologies)
        chunk.table = encoded(columns.of(rows, places), ending)
    except YamaroError as error:  # which no process can send as it is
        chunk.errors = error.diagnostics
        return chunk
    chunk.counts = {status: sum(row.status == status for row in rows) for status in STATUSES}
    return chunk


def _rows(plan: Plan, start: int, stop: int, folder: str, chunk: Chunk) -> list[Row]:
    """Return the rows of variants from `start` up to `stop`."""
    rows: list[Row] = []
    attempt = 1
    while start + len(rows) < stop:
        at = start + len(rows)
        child = _children.take(plan, folder)
        is_used_up = True
        try:
            for row in child.rows(at, stop):
                rows.append(row)
                attempt = 1
                if row.code == OUT_OF_MEMORY and row.status == FAILED:
                    break  # what is left of the memory may be in pieces
            else:
                is_used_up = False
        except ChildEnded as ended:
            at = start + len(rows)
            attempt = _after_end(ended, attempt, plan, at, rows)
        finally:
            chunk.add_files(child.files)
            _children.give_back(child, is_used_up=is_used_up)
    return rows


def _after_end(ended: ChildEnded, attempt: int, plan: Plan, at: int, rows: list[Row]) -> int:
    """Decide what the end of a process means; return the number of the next attempt.

    Raises:
        YamaroError: it cannot even begin.
    """
    most = ATTEMPTS_IF_KILLED if ended.status == _KILL else ATTEMPTS
    if not ended.is_late and attempt < most:
        return attempt + 1
    if not ended.is_ready:
        message = f"a worker ended before it had begun ({_words(ended.status)})"
        raise failure_of_all("sweep-engine", message, "sweep", None)
    row = Row(at, next(Space(plan).variants(at, at + 1)))
    if ended.is_late:
        rows.append(row.fail(TIMEOUT, f"took longer than {plan.seconds:g} s"))
    else:
        rows.append(row.fail(CRASH, f"ended the process of its worker ({_words(ended.status)})"))
    return 1


def _words(status: int) -> str:
    """Return an exit status in words."""
    if status >= 0:
        return f"exit status {status}"
    import signal

    try:
        return signal.Signals(-status).name
    except ValueError:
        return f"signal {-status}"
