"""Batches: one model of MuJoCo, and arrays of what differs between variants of one topology.

The arrays are called as the fields of MuJoCo's model, with a first axis for the variants: what MJX,
MuJoCo Warp and Newton's solver take for many worlds. MuJoCo compiles each variant, so the numbers
are its own. Fields that are not floating-point numbers, such as types, parents and names, have to
be the same for all.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterator, Sequence
from queue import Empty, Queue
from time import monotonic
from typing import Any

from ...diagnostics import YamaroError, failure, failure_of_all
from ...options import UsageError
from ...output import write_files
from .builder import Builder
from .plan import MJCF, Plan, import_extra
from .replaying import LEAST, Document, to_check
from .running import LOCAL, Engine, Status, engine_of
from .table import FAILED, OK, REJECTED, Row
from .worker import Child, ChildEnded

ENDING = ".npz"
PARTS = ("opt", "stat")
"""Parts of a model that have numbers of their own: `stat.meaninertia`."""
CHUNK = 64
"""Variants that a worker is given at a time."""
MOST_WARNINGS = 10
"""Kinds of warnings that are shown."""
Found = tuple[Any, Any]
"""The numbers of variants, and the values that a field has in them."""


class Comparison:
    """Compares the models of variants with that of the first one.

    Attributes:
        first: the fields of the first one, by name; None before it is there.
    """

    def __init__(self) -> None:
        """Wait for the first variant."""
        self.first: dict[str, Any] | None = None
        self._words: Any = None  # the saved first model
        self._known: Any = None  # which words of saved models are in fields that differ
        self._names: list[str] = []  # these fields
        self._found: dict[str, tuple[list[int], list[Any]]] = {}

    def note(self, row: Row, document: Document) -> Any:
        """Give the first row what its model has, and keep what differs in others.

        Returns:
            The whole model as a row of numbers.

        Raises:
            ValueError: MuJoCo refuses the document.
        """
        model = document.model()
        words = _saved(model)
        if self.first is None:
            self.first = row.fields = _fields(model)
            row.documents["xml"] = document.text.encode()
            row.assets = {path: data for path, data in document.files.items() if "/" in path}
            self._words = words
            self._known = words != words
            return words
        if words.shape != self._words.shape:
            row.unlike = self._compare(model)
            return words
        # To read all fields takes as long as to compile the model. Each word is in one field, so
        # no field differs that is not known if no word does.
        differs = words != self._words
        if (differs & ~self._known).any():
            row.unlike = self._compare(model)
            if row.unlike:
                return words
            self._known |= differs
        for name in self._names:
            indices, values = self._found.setdefault(name, ([], []))
            indices.append(row.index)
            values.append(_value(model, name))
        return words

    def is_model(self, words: Any, document: Document) -> bool:
        """Return whether a model is the one that MuJoCo reads from the document."""
        read = _saved(Document.model(document))
        return read.shape == words.shape and bool((read == words).all())

    def _compare(self, model: Any) -> str:
        """Note which fields differ; return one that cannot."""
        assert self.first is not None
        for name, value in _fields(model).items():
            known = self.first[name]
            if value.shape != known.shape or (value != known).any():
                if value.shape != known.shape or value.dtype.kind != "f":
                    return name
                if name not in self._names:
                    self._names.append(name)
        return ""

    def take(self) -> dict[str, Found]:
        """Return the values of the fields that differ, of the variants since the last time."""
        numpy = import_extra("numpy")
        found, self._found = self._found, {}
        return {
            name: (numpy.array(indices), numpy.stack(values))
            for name, (indices, values) in found.items()
        }


def _saved(model: Any) -> Any:
    """Return all of a model as a row of numbers."""
    mujoco, numpy = import_extra("mujoco", "sim"), import_extra("numpy")
    size = mujoco.mj_sizeModel(model)
    row = numpy.zeros(-(-size // 8) * 8, numpy.uint8)
    mujoco.mj_saveModel(model, None, row[:size])
    return row.view(numpy.uint64)


def _value(model: Any, name: str) -> Any:
    """Return a copy of a field."""
    numpy = import_extra("numpy")
    part, _, inner = name.rpartition(".")
    return numpy.array(getattr(getattr(model, part) if part else model, inner))


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
        unequal: the number of a variant of which another document was recorded than was built,
            after which all were built one by one; or None.
        warnings: of some variants, but not of all: how many, the first one, code and message.
        seconds: how long it took.
    """

    __slots__ = (
        "failed", "fields", "kept", "rejected", "samples", "seconds", "unequal", "warnings",
    )  # fmt: skip

    def __init__(self, samples: int) -> None:
        self.samples = samples
        self.kept = self.rejected = 0
        self.failed: list[Row] = []
        self.fields: dict[str, tuple[int, ...]] = {}
        self.unequal: int | None = None
        self.warnings: list[tuple[int, Row, str, str]] = []
        self.seconds = 0.0

    def note_warnings(self, rows: Sequence[Row]) -> None:
        """Note what was found of some of the variants; what all have is not about them."""
        groups: dict[tuple[str, str], list[tuple[Row, str]]] = {}
        for row in rows:
            seen: dict[tuple[str, str], tuple[Row, str]] = {}
            for code, place, message in row.warnings:
                seen.setdefault((code, place), (row, message))
            for key, value in seen.items():
                groups.setdefault(key, []).append(value)
        for (code, place), found in groups.items():
            if len(found) < len(rows):
                row, message = found[0]
                at = f" at {place}" if place else ""
                self.warnings.append((len(found), row, f"{code}{at}", message))

    def lines(self) -> list[str]:
        """Return what there is to say."""
        counts = {"rejected": self.rejected, "failed": len(self.failed)}
        others = "".join(f", {count:,} {name}" for name, count in counts.items() if count)
        found = [f"{self.kept:,} of {self.samples:,} variants{others}; {len(self.fields)} fields"]
        for row in self.failed[:1]:
            where = f" at {row.place}" if row.place else ""
            found.append(
                f"  variant {row.index} ({_passed(row)}): {row.message} [{row.code}{where}]"
            )
        for count, row, what, message in self.warnings[:MOST_WARNINGS]:
            found.append(f"  {count:,} × {what}")
            found.append(f"      such as {row.index} ({_passed(row)}): {message}")
        if self.unequal is not None:
            found.append(
                f"all variants were built one by one, since the recorded variant {self.unequal} "
                "differed from its build"
            )
        return found


def _passed(row: Row) -> str:
    """Return the arguments of a variant, as they are passed."""
    return " ".join(f"{name}:={value}" for name, value in row.arguments.items())


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
    if (engine or LOCAL).partition(":")[0] != LOCAL:
        raise UsageError("a batch is built on this machine: write --engine local:8")
    began = monotonic()
    plan.formats, plan.is_batch = [MJCF], True
    plan.is_recorded = plan.samples >= LEAST
    batch = Batch(plan.samples)
    try:
        first, arrays = _arrays(plan, engine, batch, on_progress)
    except _Unequal as error:
        plan.is_recorded = False
        plan.run = os.urandom(8).hex()
        batch = Batch(plan.samples)
        batch.unequal = error.index
        first, arrays = _arrays(plan, engine, batch, on_progress)
    numpy = import_extra("numpy")
    content = io.BytesIO()
    numpy.savez(content, **arrays)
    stem = path.removesuffix(ENDING)
    folder = os.path.dirname(path)
    files = {os.path.join(folder, *name.split("/")): data for name, data in first.assets.items()}
    write_files({path: content.getvalue(), f"{stem}.xml": first.documents["xml"], **files})
    batch.seconds = monotonic() - began
    return batch


class _Unequal(Exception):
    """What was recorded gives another document than a build.

    Attributes:
        index: the number of the variant.
    """

    def __init__(self, index: int) -> None:
        super().__init__()
        self.index = index


def _arrays(
    plan: Plan, engine: str | None, batch: Batch, on_progress: Callable[[Status], None]
) -> tuple[Row, dict[str, Any]]:
    """Return the first variant that can be built, and the arrays of all by name.

    Raises:
        YamaroError: no variant can be built, or an argument changes the topology.
    """
    opened = engine_of(engine)()
    status = Status(plan.samples, 0)
    rows: dict[int, Row] = {}
    found: dict[str, list[Found]] = {}
    try:
        for chunk, fields in _chunks(plan, opened):
            for row in chunk:
                if row.is_unequal:
                    raise _Unequal(row.index)
                rows[row.index] = row
                status.done += 1
                status.built += 1
                status.failed += row.status == FAILED
            for name, values in fields.items():
                found.setdefault(name, []).append(values)
            on_progress(status)
    finally:
        opened.close(plan.run)
    numpy = import_extra("numpy")
    ordered = [rows[index] for index in sorted(rows)]
    batch.rejected = sum(row.status == REJECTED for row in ordered)
    batch.failed = [row for row in ordered if row.status not in (OK, REJECTED)]
    good = [row for row in ordered if row.status == OK]
    if not good:
        why = batch.failed[0].message if batch.failed else "all were rejected"
        raise failure_of_all("sweep-batch", f"there is no variant to write: {why}", "sweep", None)
    for row in good[1:]:
        if row.unlike:
            raise _unlike(plan, good[0], row)
    indices = numpy.array([row.index for row in good])
    arrays: dict[str, Any] = {"id": indices}
    for axis in plan.axes:
        passed = [row.arguments[axis.name] for row in good]
        plain = all(isinstance(each, (int, float, str)) for each in passed)
        arrays[f"arguments/{axis.name}"] = numpy.array(passed if plain else list(map(str, passed)))
    for name, value in good[0].fields.items():
        if name in found:
            whole = numpy.repeat(value[None], len(good), axis=0)
            for numbers, part in found[name]:
                whole[numpy.searchsorted(indices, numbers)] = part
            if (whole != value).any():
                arrays[name], batch.fields[name] = whole, value.shape
    batch.kept = len(good)
    batch.note_warnings(good)
    return good[0], arrays


def _chunks(plan: Plan, engine: Engine) -> Iterator[tuple[list[Row], dict[str, Found]]]:
    """Yield the rows of all variants in any order, each chunk with the fields that differ."""
    bounds = [(low, min(low + CHUNK, plan.samples)) for low in range(0, plan.samples, CHUNK)]
    count = min(engine.workers, len(bounds))
    plan.first = 0  # which nearly always can be built, so that all processes can begin with it
    if plan.is_recorded:
        plan.checked = to_check(plan)
    children = [Child(plan, "") for _ in range(count)]
    try:
        start = 0
        for start in range(plan.samples):
            (row,) = children[0].rows(start, start + 1)
            yield [row], {}
            if row.status == OK:
                break
        if start:
            for each in children[1:]:
                each.close()
            plan.first = start
            children[1:] = [Child(plan, "") for _ in range(count - 1)]
        waiting: Queue[tuple[int, int]] = Queue()
        for low, high in bounds:
            if high > start + 1:
                waiting.put((max(low, start + 1), high))
        found: Queue[tuple[list[Row], dict[str, Found]] | BaseException | None] = Queue()

        def work(own: Child) -> None:
            try:
                while True:
                    rows = [*own.rows(*waiting.get_nowait())]
                    found.put((rows, own.fields))
            except Empty:
                found.put(None)
            except BaseException as error:
                found.put(error)

        for each in children:
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

    plan.first, plan.is_recorded = None, False
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
