"""Engines: where chunks are done. Each one is an executor of `concurrent.futures`."""

from __future__ import annotations

import os
from concurrent.futures import Executor, Future, ThreadPoolExecutor

from ...diagnostics import failure_of_all
from ...options import UsageError
from .chunk import stop
from .methods import import_extra

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ...diagnostics import YamaroError

LOCAL, DASK, RAY = "local", "dask", "ray"
ENGINES = (LOCAL, DASK, RAY)
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
        word: `local`, `local:8`, `dask` (a cluster on this machine), `dask:8`,
            `dask://HOST:PORT`, `ray`, `ray:8` or `ray://HOST:PORT`.

    What is returned raises YamaroError if a package is missing or the cluster cannot be reached.

    Raises:
        UsageError: it names none.
    """
    kind, colon, rest = (word or LOCAL).partition(":")
    if kind not in ENGINES:
        raise UsageError(
            f"there is no engine '{kind}'; write local:8, dask:8, dask://HOST:PORT, ray:8 or "
            "ray://HOST:PORT"
        )
    address = rest.removeprefix("//") if rest.startswith("//") else ""
    workers = _workers(rest, kind) if colon and not address else None
    if kind == LOCAL and address:
        raise UsageError("the engine 'local' takes no address; write local:8")
    opener = {LOCAL: _open_local, DASK: _open_dask, RAY: _open_ray}[kind]
    return lambda: opener(address, workers)


def cores() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _workers(text: str, kind: str) -> int:
    if not text.isdigit() or not 1 <= int(text) <= 10_000:
        raise UsageError(f"'{kind}:{text}' needs a number of workers up to 10,000, as in {kind}:8")
    return int(text)


def _open_local(address: str, workers: int | None) -> Engine:
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


class _RayExecutor(Executor):
    """Gives functions to a cluster of Ray."""

    def __init__(self, ray: Any) -> None:
        self._remote = ray.remote(max_retries=RETRIES)(_called)

    def submit(  # type: ignore[override]
        self, function: Callable[..., Any], /, *arguments: Any, **named: Any
    ) -> Future[Any]:
        """Have a function called by a worker."""
        future: Future[Any] = self._remote.remote(function, arguments, named).future()
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Take nothing more."""


def _called(function: Callable[..., Any], arguments: Any, named: Any) -> Any:
    """Call a function, in a worker."""
    return function(*arguments, **named)


def _open_ray(address: str, workers: int | None) -> Engine:
    ray = import_extra("ray", RAY)
    try:
        if address:
            ray.init(f"ray://{address}", logging_level="error", log_to_driver=False)
        else:
            ray.init(
                num_cpus=workers or cores(), include_dashboard=False, logging_level="error",
                log_to_driver=False,
            )  # fmt: skip
    except (OSError, ConnectionError, TimeoutError) as error:
        raise _unreachable(RAY, address, error) from None
    count = int(ray.cluster_resources().get("CPU", 1))
    engine = Engine(_RayExecutor(ray), max(count, 1), f"ray, {count} processors")
    engine._closing.append(ray.shutdown)
    return engine


def _unreachable(kind: str, address: str, error: Exception) -> YamaroError:
    """Return the error for a cluster that does not answer; without an address it is our own."""
    why = str(error) or type(error).__name__
    if not address:
        return failure_of_all("sweep-engine", f"{kind} cannot be started: {why}", "sweep", None)
    message = f"the cluster '{kind}://{address}' cannot be reached: {why}"
    return failure_of_all("sweep-engine", message, "sweep", "check that its scheduler is running")
