"""Runs a plan: gives chunks to an engine, and stores what comes back."""

from __future__ import annotations

from concurrent.futures import FIRST_COMPLETED, CancelledError, wait
from time import monotonic

from ...diagnostics import YamaroError, failure_of_all
from .chunk import changed, run_chunk
from .driving import Child, ChildEnded

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Future

    from .chunk import Chunk
    from .engines import Engine
    from .folder import SweepFolder
    from .plan import Plan

    Progress = Callable[["Status"], None]

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
    """How far a sweep is.

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
        if _note_files(plan, chunk):
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
                    raise _lost(engine, error) from None
                submit(number)
                continue
            del attempts[number]
            if chunk.errors:
                raise YamaroError(chunk.errors)
            yield chunk


def _lost(engine: Engine, error: BaseException) -> YamaroError:
    message = f"the engine ({engine.name}) loses its workers: {type(error).__name__}: {error}"
    hint = "the chunks that are done are kept: the same command with --resume goes on from them"
    return failure_of_all("sweep-engine", message, "sweep", hint)


def _note_files(plan: Plan, chunk: Chunk) -> bool:
    """Note which files a chunk was built from; return whether there is a new one.

    Raises:
        YamaroError: another chunk was built from another version of one.
    """
    before = len(plan.files)
    for path, digest in chunk.files.items():
        if plan.files.setdefault(path, digest) != digest:
            raise changed(path)
    return len(plan.files) > before


def chunk_size(plan: Plan, workers: int) -> int:
    """Return how many variants take about two seconds, by building a few from all over the plan.

    Raises:
        YamaroError: no variant can be built.
    """
    each = _seconds_of_one(plan)
    size = USUAL_VARIANTS if each is None else round(CHUNK_SECONDS / max(each, 1e-6))
    fair = -(-plan.samples // (4 * workers))
    least = -(-plan.samples // MOST_CHUNKS)
    return max(min(size, fair, MOST_VARIANTS), least, 1)


def _seconds_of_one(plan: Plan) -> float | None:
    """Return how long a variant takes, rejected ones included; None if those tried crash."""
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
    return sum(later) / len(later) if later else None
