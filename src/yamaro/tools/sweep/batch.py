"""Batches: one model of MuJoCo, and arrays of what differs between variants of one topology.

The arrays are called as the fields of MuJoCo's model, with a first axis for the variants: what MJX,
MuJoCo Warp and Newton's solver take for many worlds. MuJoCo compiles each variant, so the numbers
are its own. Fields that are not floating-point numbers, such as types, parents and names, have to
be the same for all.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterator
from queue import Empty, Queue
from typing import Any

from ...diagnostics import YamaroError, failure, failure_of_all
from ...options import UsageError
from ...output import write_files
from ...result import Build
from .builder import Builder
from .plan import MJCF, Plan, import_extra
from .running import LOCAL, Engine, Status, engine_of
from .table import FAILED, OK, REJECTED, Row
from .worker import Child, ChildEnded

ENDING = ".npz"
PARTS = ("opt", "stat")
"""Parts of a model that have numbers of their own: `stat.meaninertia`."""
CHUNK = 32
"""Variants that a worker is given at a time."""


class Comparison:
    """Compares the models of variants with that of the first one.

    Attributes:
        first: the fields of the first one, by name; None before it is there.
    """

    def __init__(self) -> None:
        """Wait for the first variant."""
        self.first: dict[str, Any] | None = None

    def note(self, row: Row, build: Build) -> None:
        """Give a row what a variant has: all that the first one has, or what differs from it.

        Raises:
            YamaroError: MuJoCo refuses it.
        """
        mujoco = import_extra("mujoco", "sim")
        files = dict(build.assets)
        try:
            model = mujoco.MjModel.from_xml_string(build.xml(), files)
        except ValueError as error:
            message = f"MuJoCo refuses the robot: {' '.join(str(error).split())}"
            raise failure("mujoco-refused", message, build.robot.span) from None
        found = _fields(model)
        if self.first is None:
            self.first = row.fields = found
            row.documents["xml"] = build.xml().encode()
            row.assets = {path: data for path, data in files.items() if "/" in path}
            return
        for name, value in found.items():
            known = self.first[name]
            if value.shape != known.shape or (value != known).any():
                if value.shape != known.shape or value.dtype.kind != "f":
                    row.unlike = name
                    return
                row.fields[name] = value


def _fields(model: Any) -> dict[str, Any]:
    """Return the arrays of a model by name, and its names."""
    numpy = import_extra("numpy")
    found = {"names": numpy.frombuffer(model.names, dtype=numpy.uint8).copy()}
    for prefix, part in (("", model), *((f"{name}.", getattr(model, name)) for name in PARTS)):
        for name in _names(type(part)):
            value = getattr(part, name)
            if isinstance(value, (float, int, numpy.ndarray)):
                found[prefix + name] = numpy.array(value)
    return found


_KNOWN: dict[type, list[str]] = {}


def _names(kind: type) -> list[str]:
    """Return the attributes of a kind of object that may be values."""
    if kind not in _KNOWN:
        known = ((name, getattr(kind, name)) for name in dir(kind) if name[0] != "_")
        _KNOWN[kind] = [name for name, value in known if isinstance(value, property)]
    return _KNOWN[kind]


class Batch:
    """What was written.

    Attributes:
        samples: how many variants there were.
        kept: how many are in the batch.
        rejected: how many did not meet the conditions.
        failed: those that could not be built.
        fields: the shapes of the arrays by name, without the first axis.
        seconds: how long it took.
    """

    __slots__ = ("failed", "fields", "kept", "rejected", "samples", "seconds")

    def __init__(self, samples: int) -> None:
        self.samples = samples
        self.kept = self.rejected = 0
        self.failed: list[Row] = []
        self.fields: dict[str, tuple[int, ...]] = {}
        self.seconds = 0.0

    def lines(self) -> list[str]:
        """Return what there is to say."""
        counts = {"rejected": self.rejected, "failed": len(self.failed)}
        others = "".join(f", {count:,} {name}" for name, count in counts.items() if count)
        found = [f"{self.kept:,} of {self.samples:,} variants{others}; {len(self.fields)} fields"]
        first = self.failed[:1]
        return found + [f"variant {row.index}: {row.message} [{row.code}]" for row in first]


def write_batch(
    plan: Plan, path: str, engine: str | None, on_progress: Callable[[Status], None]
) -> Batch:
    """Build the variants of a plan, and write their arrays, with the model of the first beside.

    Args:
        plan: what variants there are.
        path: the file of the arrays; the model has the same name with `.xml`.
        engine: `local`, or `local:8` for that many processes.
        on_progress: is called with how far it is.

    Raises:
        YamaroError: no variant can be built, or an argument changes the topology.
        UsageError: the engine is not on this machine.
        OSError: it cannot be written.
    """
    numpy = import_extra("numpy")
    if (engine or LOCAL).partition(":")[0] != LOCAL:
        raise UsageError("a batch is built on this machine: write --engine local:8")
    opened = engine_of(engine)()
    plan.formats, plan.is_batch = [MJCF], True
    status = Status(plan.samples, 0)
    rows: dict[int, Row] = {}
    try:
        for row in _rows(plan, opened):
            rows[row.index] = row
            status.done += 1
            status.built += 1
            status.failed += row.status == FAILED
            on_progress(status)
    finally:
        opened.close(plan.run)
    batch = Batch(plan.samples)
    batch.rejected = sum(row.status == REJECTED for row in rows.values())
    ordered = [rows[index] for index in sorted(rows)]
    batch.failed = [row for row in ordered if row.status not in (OK, REJECTED)]
    good = [row for row in ordered if row.status == OK]
    if not good:
        why = batch.failed[0].message if batch.failed else "all were rejected"
        raise failure_of_all("sweep-batch", f"there is no variant to write: {why}", "sweep", None)
    for row in good[1:]:
        if row.unlike:
            raise _unlike(plan, good[0], row)
    first = good[0].fields
    arrays: dict[str, Any] = {"id": numpy.array([row.index for row in good])}
    for axis in plan.axes:
        values = [row.arguments[axis.name] for row in good]
        plain = all(isinstance(each, (int, float, str)) for each in values)
        arrays[f"arguments/{axis.name}"] = numpy.array(values if plain else list(map(str, values)))
    differing = {name for row in good[1:] for name in row.fields}
    for name in (each for each in first if each in differing):
        stacked = numpy.stack([row.fields.get(name, first[name]) for row in good])
        arrays[name] = stacked
        batch.fields[name] = first[name].shape
    content = io.BytesIO()
    numpy.savez(content, **arrays)
    stem = path.removesuffix(ENDING)
    folder = os.path.dirname(path)
    files = {os.path.join(folder, *name.split("/")): data for name, data in good[0].assets.items()}
    write_files({path: content.getvalue(), f"{stem}.xml": good[0].documents["xml"], **files})
    batch.kept, batch.seconds = len(good), status.seconds
    return batch


def _rows(plan: Plan, engine: Engine) -> Iterator[Row]:
    """Yield the rows of all variants in any order; the first of them that is built is compared."""
    child = Child(plan, "")
    children = [child]
    try:
        start = 0
        for start in range(plan.samples):
            (row,) = child.rows(start, start + 1)
            yield row
            if row.status == OK:
                break
        start += 1
        plan.first = start - 1
        bounds = [
            (low, min(low + CHUNK, plan.samples)) for low in range(start, plan.samples, CHUNK)
        ]
        waiting: Queue[tuple[int, int]] = Queue()
        for chunk in bounds:
            waiting.put(chunk)
        found: Queue[Row | BaseException | None] = Queue()

        def work(own: Child) -> None:
            try:
                while True:
                    for row in own.rows(*waiting.get_nowait()):
                        found.put(row)
            except Empty:
                found.put(None)
            except BaseException as error:
                found.put(error)

        count = min(engine.workers, len(bounds))
        children += [Child(plan, "") for _ in range(count - 1)]
        for each in children[:count]:
            engine.submit(work, each)
        while count:
            got = found.get()
            if isinstance(got, BaseException):
                raise got
            if got is None:
                count -= 1
            else:
                yield got
    except ChildEnded as error:
        why = "took too long" if error.is_late else f"ended with {error.status}"
        message = f"the process of a variant {why}"
        raise failure_of_all("sweep-batch", message, "sweep", None) from None
    finally:
        for each in children:
            each.close()


def _unlike(plan: Plan, first: Row, other: Row) -> YamaroError:
    """Return the error that a variant is another model, at the argument that makes it one."""
    from .study import listing_for

    builder = Builder(plan)
    builder.row(first.index, first.arguments)
    for name, value in other.arguments.items():
        row = builder.row(other.index, {**first.arguments, name: value})
        if row.unlike:
            break
    else:
        name = ""
    listing = listing_for(plan.robot, plan.options.policy, plan.options.packages)
    declared = next((each for each in listing.declared if each.name == name), None)
    what = f"variant {other.index} differs from variant {first.index} in '{other.unlike}'"
    hint = "pass a value for it with :=, and make a batch for each of its values"
    if declared is None:
        return failure_of_all("sweep-batch", f"{what}, which is one for a batch", "sweep", None)
    was, now = first.arguments[name], other.arguments[name]
    message = f"the argument '{name}' changes the model itself: {what} ({was} and {now})"
    return failure("sweep-batch", message, declared.span, hint=hint)
