"""The unit of work: a chunk of variants, as a worker of any engine does it.

The worker has a process of its own build the variants, and starts another one when it crashes,
hangs or takes too much memory. That costs the variant at which it was.
"""

from __future__ import annotations

import threading

from ...diagnostics import YamaroError, failure_of_all
from .driving import Child, ChildEnded
from .models import assets_of, packed
from .plan import Space
from .rows import CRASH, FAILED, OUT_OF_MEMORY, STATUSES, TIMEOUT, Row, row_types
from .table import Columns, encoded

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...diagnostics import Diagnostic
    from .plan import Plan

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
    try:
        _fill(chunk, plan, folder, ending)
    except YamaroError as error:  # which no process can send as it is
        chunk.errors = error.diagnostics
    return chunk


def _fill(chunk: Chunk, plan: Plan, folder: str, ending: str) -> None:
    """Do the work; raise YamaroError if no variant can be built."""
    start, stop = plan.bounds(chunk.number)
    rows = _rows(plan, start, stop, folder, chunk)
    columns = Columns(
        row_types(plan), plan.hashed(), _ends(plan, rows), has_topologies=plan.has_topologies
    )
    places: dict[tuple[int, str], tuple[int, int]] = {}
    if plan.models:
        chunk.shard, places = packed(rows)
        chunk.assets = assets_of(rows)
    chunk.table = encoded(columns.of(rows, places), ending)
    chunk.counts = {status: sum(row.status == status for row in rows) for status in STATUSES}


def _ends(plan: Plan, rows: list[Row]) -> list[str]:
    if not plan.models:
        return []
    return sorted({end for row in rows for end in row.documents})


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
