"""Runs a plan: gives its chunks to an engine, and stores what comes back.

An engine is where chunks are done: an executor of `concurrent.futures`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    CancelledError,
    Executor,
    Future,
    ThreadPoolExecutor,
    wait,
)
from time import monotonic
from typing import Any

from ...diagnostics import YamaroError, failure_of_all
from ...options import UsageError
from .folder import SweepFolder
from .plan import Plan, import_extra
from .worker import Child, ChildEnded, Chunk, changed, run_chunk, stop

Progress = Callable[["Status"], None]


LOCAL, DASK = "local", "dask"
CONNECTING_SECONDS = 20.0
"""How long a cluster has to answer."""
RETRIES = 10
"""How often a chunk is done again whose worker was lost."""


class Engine:
    """An executor, and how many chunks it does at a time.

    Attributes:
        executor: what takes chunks.
        workers: how many it does at a time.
        name: what it is called in messages.
    """

    def __init__(self, executor: Executor, workers: int, name: str) -> None:
        self.executor = executor
        self.workers = workers
        self.name = name
        self._closing: list[Callable[[], object]] = []

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Have a function called by a worker."""
        return self.executor.submit(function, *arguments)

    def close(self, run: str) -> None:
        """End what was started for a run of a plan; what it works at is lost."""
        stop(run)
        if isinstance(self.executor, ThreadPoolExecutor):
            self.executor.shutdown(cancel_futures=True)
        else:
            self.executor.shutdown(wait=False)
        for close in self._closing:
            close()


def engine_of(word: str | None) -> Callable[[], Engine]:
    """Return what opens the engine that a word names.

    Args:
        word: `local`, `local:8`, `dask` (a cluster on this machine), `dask:8` or
            `dask://HOST:PORT`.

    What is returned raises YamaroError if a package is missing or the cluster cannot be reached.

    Raises:
        UsageError: it names none.
    """
    kind, colon, rest = (word or LOCAL).partition(":")
    if kind not in (LOCAL, DASK):
        raise UsageError(f"there is no engine '{kind}'; write local:8, dask:8 or dask://HOST:PORT")
    address = rest.removeprefix("//") if rest.startswith("//") else ""
    workers = None
    if colon and not address:
        if not rest.isdigit() or not 1 <= int(rest) <= 10_000:
            needed = "a number of workers up to 10,000"
            raise UsageError(f"'{kind}:{rest}' needs {needed}, as in {kind}:8")
        workers = int(rest)
    if kind == LOCAL and address:
        raise UsageError("the engine 'local' takes no address; write local:8")
    return lambda: _open_dask(address, workers) if kind == DASK else _open_local(workers)


def cores() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _open_local(workers: int | None) -> Engine:
    count = workers or cores()
    executor = ThreadPoolExecutor(count, thread_name_prefix="sweep")
    return Engine(executor, count, f"local, {count} workers")


def _open_dask(address: str, workers: int | None) -> Engine:
    distributed = import_extra("distributed", DASK)
    import logging

    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    cluster = None
    try:
        if address:
            client = distributed.Client(f"tcp://{address}", timeout=CONNECTING_SECONDS)
        else:
            cluster = distributed.LocalCluster(
                n_workers=workers or cores(), threads_per_worker=1, processes=True,
                protocol="tcp", host="127.0.0.1", dashboard_address=None,
                silence_logs=logging.CRITICAL,
            )  # fmt: skip
            client = distributed.Client(cluster)
    except (OSError, TimeoutError) as error:
        raise _unreachable(DASK, address, error) from None
    threads = sum(client.nthreads().values())
    executor = client.get_executor(pure=False, retries=RETRIES)
    engine = Engine(executor, max(threads, 1), f"dask, {threads} threads")
    engine._closing.append(client.close)
    if cluster is not None:
        engine._closing.append(cluster.close)
    return engine


def _unreachable(kind: str, address: str, error: Exception) -> YamaroError:
    """Return the error for a cluster that does not answer; without an address it is our own."""
    why = str(error) or type(error).__name__
    if not address:
        return failure_of_all("sweep-engine", f"{kind} cannot be started: {why}", "sweep", None)
    message = f"the cluster '{kind}://{address}' cannot be reached: {why}"
    return failure_of_all("sweep-engine", message, "sweep", "check that its scheduler is running")


# --- a run of a plan --------------------------------------------------------------------------


CHUNK_SECONDS = 2.0
"""How long a chunk is to take."""
MOST_VARIANTS, MOST_CHUNKS = 10_000, 100_000
"""Variants of a chunk, and files of a table unless it has more than 10^9 rows."""
USUAL_VARIANTS = 100
"""Variants of a chunk if it is not known how long they take."""
IN_FLIGHT = 2
"""Chunks that each worker has to do, so that it never waits for the next one."""
ATTEMPTS = 10
"""How often a chunk is given to the engine if that loses it."""
TRIED, TRIED_SECONDS = 20, 3.0
"""Variants that are built, or seconds, to find how long one takes."""
LOOKING_INTERVAL = 0.2
"""Seconds of each wait for a chunk: on Windows, Ctrl-C is only noticed between two waits."""


class Status:
    """The progress of a sweep.

    Attributes:
        samples: how many variants it has.
        done: how many are in the table.
        built: how many of them in this run.
        failed: how many of these failed.
        seconds: since this run began.
    """

    __slots__ = ("_began", "built", "done", "failed", "samples")

    def __init__(self, samples: int, done: int) -> None:
        self.samples = samples
        self.done = done
        self.built = 0
        self.failed = 0
        self._began = monotonic()

    @property
    def seconds(self) -> float:
        """Return how long this run has taken."""
        return monotonic() - self._began

    @property
    def rate(self) -> float:
        """Return how many variants are done in a second."""
        return self.built / max(self.seconds, 1e-9)

    def add(self, chunk: Chunk) -> None:
        """Count a chunk."""
        count = sum(chunk.counts.values())
        self.done += count
        self.built += count
        self.failed += chunk.counts["failed"]


def run_plan(plan: Plan, folder: SweepFolder, engine: Engine, on_progress: Progress) -> Status:
    """Do all chunks of a plan that are not done yet; return how it went.

    Raises:
        YamaroError: no variant can be built, a file has changed meanwhile, or the engine fails.
        OSError: something cannot be written.
    """
    done = {number for number in folder.done() if number < plan.chunks()}
    missing = [number for number in range(plan.chunks()) if number not in done]
    status = Status(plan.samples, sum(stop - start for start, stop in map(plan.bounds, done)))
    on_progress(status)
    for chunk in _results(plan, missing, folder, engine):
        before = len(plan.files)
        for path, digest in chunk.files.items():
            if plan.files.setdefault(path, digest) != digest:
                raise changed(path)
        if len(plan.files) > before:
            folder.save(plan)
        folder.store(chunk)
        status.add(chunk)
        on_progress(status)
    return status


def _results(
    plan: Plan, missing: list[int], folder: SweepFolder, engine: Engine
) -> Iterator[Chunk]:
    """Yield the results of chunks as they come."""
    waiting = iter(missing)
    attempts: dict[int, int] = {}
    pending: dict[Future[Chunk], int] = {}

    def submit(number: int) -> None:
        attempts[number] = attempts.get(number, 0) + 1
        pending[engine.submit(run_chunk, plan, number, folder.path, folder.ending)] = number

    while True:
        while len(pending) < IN_FLIGHT * engine.workers:
            number = next(waiting, None)
            if number is None:
                break
            submit(number)
        if not pending:
            return
        finished, _ = wait(pending, LOOKING_INTERVAL, return_when=FIRST_COMPLETED)
        for future in finished:
            number = pending.pop(future)
            try:
                chunk = future.result()
            except (Exception, CancelledError) as error:  # the engine lost it
                if attempts[number] >= ATTEMPTS:
                    why = f"{type(error).__name__}: {error}"
                    raise failure_of_all(
                        "sweep-engine",
                        f"the engine ({engine.name}) loses its workers: {why}",
                        "sweep",
                        "the chunks that are done are kept: the same command with --resume goes "
                        "on from them",
                    ) from None
                submit(number)
                continue
            del attempts[number]
            if chunk.errors:
                raise YamaroError(chunk.errors)
            yield chunk


def chunk_size(plan: Plan, workers: int) -> int:
    """Return how many variants take about two seconds, by building a few from all over the plan.

    Raises:
        YamaroError: no variant can be built.
    """
    count = min(TRIED, plan.samples)
    found: list[float] = []
    child = Child(plan, "")
    try:
        for number in range(count):
            index = number * plan.samples // count
            began = monotonic()
            list(child.rows(index, index + 1))
            found.append(monotonic() - began)
            if sum(found[1:]) > TRIED_SECONDS:
                break
    except ChildEnded:  # the chunk in which it is will show that
        pass
    finally:
        child.close()
    later = found[1:]  # the first one takes longer
    each = sum(later) / len(later) if later else None
    size = USUAL_VARIANTS if each is None else round(CHUNK_SECONDS / max(each, 1e-6))
    fair = -(-plan.samples // (4 * workers))
    least = -(-plan.samples // MOST_CHUNKS)
    return max(min(size, fair, MOST_VARIANTS), least, 1)
