"""Batches: one model of MuJoCo, and arrays of what differs between variants of one topology.

The arrays are called as the fields of MuJoCo's model, with a first axis for the variants: what MJX,
MuJoCo Warp and Newton's solver take for many worlds. MuJoCo compiles each variant, so the numbers
are its own. Fields that are not floating-point numbers, such as types, parents and names, have to
be the same for all.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from operator import attrgetter
from queue import Queue
from threading import Lock
from time import monotonic
from typing import Any

from ...diagnostics import YamaroError, failure, failure_of_all
from ...options import UsageError
from ...output import write_files
from ...source import Public
from .builder import Builder
from .molds import properties, saved
from .plan import MJCF, Plan, import_extra
from .replaying import LEAST, Document, Finding, to_check
from .running import LOCAL, Engine, Status, engine_of
from .table import FAILED, OK, REJECTED, Row
from .worker import Child, ChildEnded

ENDING = ".npz"
PARTS = ("opt", "stat")
"""Parts of a model that have numbers of their own: `stat.meaninertia`."""
LEAST_CHUNK, MOST_CHUNK = 16, 512
"""Variants that a worker is given at a time."""
CHUNK_SECONDS = 0.25
"""How long they are to take."""
STARTING = 2.0
"""Seconds of work that are worth another worker: it needs half of that until it begins."""
MOST_RUNS = 4
"""Runs of a batch that finds that another variant has to be the first, or nothing be recorded."""
MOST_FINDINGS = 10
"""Kinds of errors and warnings that are shown."""
SHORTCUTS = ("body_sameframe", "geom_sameframe", "site_sameframe", "body_simple", "dof_simplenum")
"""Fields that say where MuJoCo may leave out calculations, as at an offset of 0."""
COVERS = ((0, 1), (0, 2), (0, 3), (0, 4), (3, 1), (4, 2))
"""Pairs of values of `sameframe` of which the first is right where the second one is."""
TREES, BOXES = "bvh_", "bvh_aabb"
"""Beginning of the fields of trees of bounding volumes, which MuJoCo makes by where shapes are."""
EXCLUDED = "exclude_signature"
"""Pairs of links without contact. They have names, so where they differ, the names do as well."""
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
        self._trees: list[tuple[int, int]] = []  # where each tree begins, and its nodes
        self._words: Any = None  # the saved first model
        self._known: Any = None  # which words of saved models are in fields that differ
        self._names: list[str] = []  # these fields
        self._found: dict[str, tuple[list[int], list[Any]]] = {}

    def note(self, row: Row, document: Document) -> Any:
        """Give the first row what its model has, and keep what differs in others.

        Returns:
            The model; it is valid until the next one.

        Raises:
            ValueError: MuJoCo refuses the document.
        """
        model = document.model()
        words, array = saved(model), import_extra("numpy").array
        if self.first is None:
            self.first = row.fields = _fields(model)
            row.documents["xml"] = document.text.encode()
            row.assets = {path: data for path, data in document.files.items() if "/" in path}
            self._words = words
            self._known = words != words
            self._trees = [
                (int(at), int(count))
                for part in ("body", "mesh", "flex")
                for at, count in zip(
                    getattr(model, f"{part}_bvhadr"), getattr(model, f"{part}_bvhnum"), strict=True
                )
                if count
            ]
            return model
        if words.shape != self._words.shape:
            row.unlike = self._compare(model)
            return model
        # To read all fields takes as long as to compile the model. Each word is in one field, so
        # no field differs that is not known if no word does.
        differs = words != self._words
        if (differs & ~self._known).any():
            row.unlike = self._compare(model)
            if row.unlike:
                return model
            self._known |= differs
        for name in self._names:
            indices, values = self._found.setdefault(name, ([], []))
            indices.append(row.index)
            is_box = name == BOXES
            values.append(self._boxes(model) if is_box else array(attrgetter(name)(model)))
        return model

    def is_model(self, model: Any, document: Document) -> bool:
        """Return whether a model is the one that MuJoCo reads from the document."""
        numpy = import_extra("numpy")
        read = document.read()
        if numpy.array_equal(saved(model), saved(read)):
            return True
        found, boxes = _fields(model), (self._boxes(model), self._boxes(read))
        return numpy.allclose(*boxes, rtol=0, atol=1e-12) and all(
            numpy.array_equal(found[name], value)
            for name, value in _fields(read).items()
            if not name.startswith(TREES)
        )

    def _boxes(self, model: Any) -> Any:
        """Return the boxes of a model's shapes in the trees of the first one."""
        numpy = import_extra("numpy")
        assert self.first is not None
        boxes, leaves, nodes = model.bvh_aabb.copy(), model.bvh_nodeid, self.first["bvh_nodeid"]
        children = self.first["bvh_child"]
        if numpy.array_equal(leaves, nodes) and numpy.array_equal(model.bvh_child, children):
            return boxes
        for start, count in self._trees:
            own = {int(leaves[at]): model.bvh_aabb[at] for at in range(start, start + count)}
            for at in reversed(range(start, start + count)):
                if nodes[at] >= 0:
                    boxes[at] = own[int(nodes[at])]
                    continue
                inner = boxes[start + children[at]]
                low = (inner[:, :3] - inner[:, 3:]).min(0)
                high = (inner[:, :3] + inner[:, 3:]).max(0)
                boxes[at] = (*(high + low) / 2, *(high - low) / 2)
        return boxes

    def _compare(self, model: Any) -> str:
        """Note which fields differ; return one that cannot."""
        assert self.first is not None
        for name, value in _fields(model).items():
            known = self.first[name]
            is_same = value.shape == known.shape
            if is_same and ((value == known).all() or _covers(name, known, value)):
                continue
            if is_same and name.startswith(TREES):
                name = BOXES
            elif not is_same or value.dtype.kind != "f":
                pairs = model.exclude_signature.tolist(), self.first[EXCLUDED].tolist()
                is_pair = model.nbody == self.first["nbody"] and pairs[0] != pairs[1]
                return EXCLUDED if name == "names" and is_pair else name
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


def _covers(name: str, known: Any, value: Any) -> bool:
    """Return whether a field with shortcuts is right for another model."""
    if name not in SHORTCUTS:
        return False
    if name == "dof_simplenum":
        return bool((known <= value).all())
    pairs = set(zip(known.tolist(), value.tolist(), strict=True))
    return all(one == other or (one, other) in COVERS for one, other in pairs)


def _fields(model: Any) -> dict[str, Any]:
    """Return the arrays of a model by name, and its names."""
    numpy = import_extra("numpy")
    found = {"names": numpy.frombuffer(model.names, dtype=numpy.uint8).copy()}
    for prefix, part in (("", model), *((f"{name}.", getattr(model, name)) for name in PARTS)):
        for name in properties(type(part)):
            value = getattr(part, name)
            if isinstance(value, (float, int, numpy.ndarray)):
                found[prefix + name] = numpy.array(value)
    return found


class Batch(Public):
    """Variants of one topology: the model of the first one, and arrays of what differs.

    Attributes:
        arrays: by the names of the fields of MuJoCo's model, with the variants as the first axis;
            and `id`, the numbers of the variants, and `arguments/NAME`.
        document: the MJCF of the first variant.
        files: the meshes that it refers to, by path.
        samples: how many variants there were.
        rejected: how many did not meet the conditions.
        failed: how many could not be built.
    """

    __slots__ = (
        "_findings", "arrays", "document", "failed", "files", "rejected", "samples", "unequal",
    )  # fmt: skip
    _internal = frozenset(("lines", "unequal"))

    def __init__(self, rows: Sequence[Row], arrays: dict[str, Any]) -> None:
        """Hold arrays, and what there is to say of variants, of which the first good one is whole.

        `unequal` is set to the number of a variant of which another document was recorded than was
        built, after which all were built one by one.
        """
        good = [row for row in rows if row.status == OK]
        failed = [row for row in rows if row.status not in (OK, REJECTED)]
        whole = next(row for row in good if row.fields)
        self.arrays = arrays
        self.document = whole.documents["xml"].decode()
        self.files = whole.assets
        self.samples = len(rows)
        self.rejected = len(rows) - len(good) - len(failed)
        self.failed = len(failed)
        self.unequal: int | None = None
        # What all variants have is not about them.
        warnings = [(row, each) for row in good for each in dict.fromkeys(row.warnings)]
        self._findings = [
            *_grouped([(row, (row.code, row.place, row.message)) for row in failed]),
            *(found for found in _grouped(warnings) if found[0] < len(good)),
        ]

    def __repr__(self) -> str:
        return f"<Batch of {len(self.arrays['id']):,} variants>"

    def model(self, row: int = 0) -> Any:
        """Return the `mujoco.MjModel` of a variant, by its row in the arrays."""
        mujoco = import_extra("mujoco", "sim")
        model = mujoco.MjModel.from_xml_string(self.document, self.files)
        for name, values in self.arrays.items():
            part, _, inner = name.rpartition(".")
            owner = getattr(model, part) if part else model
            if name != "id" and hasattr(owner, inner):
                value = values[row]
                if value.ndim:
                    getattr(owner, inner)[:] = value
                else:
                    setattr(owner, inner, float(value))
        return model

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the arrays to a file, and the model beside it, with its meshes in `assets/`.

        Args:
            path: such as `legs.npz`; the model is `legs.xml` then.

        Raises:
            OSError: it cannot be written.
        """
        numpy = import_extra("numpy")
        path = os.fspath(path)
        content = io.BytesIO()
        numpy.savez(content, **self.arrays)
        stem, folder = path.removesuffix(ENDING), os.path.dirname(path)
        files = {os.path.join(folder, *name.split("/")): data for name, data in self.files.items()}
        text = self.document.encode()
        write_files({path: content.getvalue(), f"{stem}.xml": text, **files})

    def lines(self) -> list[str]:
        """Return what there is to say."""
        counts = {"rejected": self.rejected, "failed": self.failed}
        others = "".join(f", {count:,} {name}" for name, count in counts.items() if count)
        kept = len(self.arrays["id"])
        fields = sum(name != "id" and "/" not in name for name in self.arrays)
        found = [f"{kept:,} of {self.samples:,} variants{others}; {fields} fields"]
        for count, row, what, message in self._findings[:MOST_FINDINGS]:
            passed = " ".join(f"{name}:={value}" for name, value in row.arguments.items())
            found.append(f"  {count:,} × {what}")
            found.append(f"      such as {row.index} ({passed}): {message}")
        if self.unequal is not None:
            found.append(
                f"all variants were built one by one, since the recorded variant {self.unequal} "
                "differed from its build"
            )
        return found


def _grouped(findings: Iterable[tuple[Row, Finding]]) -> list[tuple[int, Row, str, str]]:
    """Return how many variants have which finding where, the first of them, and its message."""
    groups: dict[str, dict[int, tuple[Row, str]]] = {}
    for row, (code, place, message) in findings:
        what = f"{code} at {place}" if place else code
        groups.setdefault(what, {}).setdefault(row.index, (row, message))
    found = []
    for what, rows in groups.items():
        first, message = next(iter(rows.values()))
        found.append((len(rows), first, what, message))
    return found


# --- building -------------------------------------------------------------------------------------


def build_batch(plan: Plan, engine: str | None, on_progress: Callable[[Status], None]) -> Batch:
    """Return the variants of a plan as a batch.

    Args:
        plan: what variants there are.
        engine: `local`, or `local:8` for that many processes.
        on_progress: is called with how far it is.

    Raises:
        YamaroError: no variant can be built, or an argument changes the topology.
        UsageError: the engine is not on this machine.
    """
    if (engine or LOCAL).partition(":")[0] != LOCAL:
        raise UsageError("a batch is built on this machine: write --engine local:8")
    plan.formats, plan.is_batch = [MJCF], True
    plan.is_recorded = plan.samples >= LEAST
    unequal = None
    for left in reversed(range(MOST_RUNS)):
        try:
            batch = _batch(plan, engine, on_progress, is_special_fine=left < MOST_RUNS // 2)
            batch.unequal = unequal
            return batch
        except _Unequal as error:
            unequal = error.index
            plan.is_recorded = False
        except _Special as error:
            plan.first = error.index
        plan.run = os.urandom(8).hex()
    raise AssertionError


class _Unequal(Exception):
    """What was recorded gives another document than a build.

    Attributes:
        index: the number of the variant.
    """

    def __init__(self, index: int) -> None:
        super().__init__()
        self.index = index


class _Special(Exception):
    """The first variant has shortcuts that another one has not.

    Attributes:
        index: the number of the other one.
    """

    def __init__(self, index: int) -> None:
        super().__init__()
        self.index = index


def _batch(
    plan: Plan,
    engine: str | None,
    on_progress: Callable[[Status], None],
    *,
    is_special_fine: bool,
) -> Batch:
    """Build a batch.

    Raises:
        _Special: another variant should be the first one.
        _Unequal: a variant is another one when it is built.
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
    good = [row for row in ordered if row.status == OK]
    if not good:
        failed = (row.message for row in ordered if row.status != REJECTED)
        why = next(failed, "all were rejected")
        raise failure_of_all("sweep-batch", f"there is no variant to write: {why}", "sweep", None)
    first = next(row for row in good if row.fields)
    for row in good:
        if row.unlike in SHORTCUTS and not is_special_fine:
            raise _Special(row.index)
        if row.unlike:
            raise _unlike(plan, first, row)
    indices = numpy.array([row.index for row in good])
    arrays: dict[str, Any] = {"id": indices}
    for axis in plan.axes:
        passed = [row.arguments[axis.name] for row in good]
        plain = all(isinstance(each, (int, float, str)) for each in passed)
        arrays[f"arguments/{axis.name}"] = numpy.array(passed if plain else list(map(str, passed)))
    for name, value in first.fields.items():
        if name in found:
            whole = numpy.repeat(value[None], len(good), axis=0)
            for numbers, part in found[name]:
                whole[numpy.searchsorted(indices, numbers)] = part
            if (whole != value).any():
                arrays[name] = whole
    return Batch(ordered, arrays)


def _chunks(plan: Plan, engine: Engine) -> Iterator[tuple[list[Row], dict[str, Found]]]:
    """Yield the rows of all variants in any order, each chunk with the fields that differ."""
    if plan.is_recorded:
        plan.checked = to_check(plan)
    children = [Child(plan, "")]
    try:
        start = 0
        for start in range(plan.samples):
            (row,) = children[0].rows(start, start + 1)
            yield [row], children[0].fields
            if row.status == OK:
                break
        plan.first = start if plan.first is None else plan.first
        rest = _Rest(start + 1, plan.samples)
        found: Queue[tuple[list[Row], dict[str, Found], float] | BaseException | None] = Queue()

        def work(own: Child) -> None:
            size = LEAST_CHUNK
            try:
                while bounds := rest.take(size, len(children)):
                    began = monotonic()
                    rows = [*own.rows(*bounds)]
                    each = (monotonic() - began) / len(rows)
                    found.put((rows, own.fields, each))
                    size = min(max(int(CHUNK_SECONDS / each), LEAST_CHUNK), MOST_CHUNK)
                found.put(None)
            except BaseException as error:
                found.put(error)

        engine.submit(work, children[0])
        chunks, working = 0, 1
        while working:
            got = found.get()
            if isinstance(got, BaseException):
                raise got
            if got is None:
                working -= 1
                continue
            rows, fields, each = got
            yield rows, fields
            chunks += 1  # the first one learns how to go on
            if chunks > 1 and len(children) < engine.workers and rest.left * each > STARTING:
                children.append(Child(plan, ""))
                working += 1
                engine.submit(work, children[-1])
    except ChildEnded as error:
        why = "took too long" if error.is_late else f"ended with {error.status}"
        message = f"the process of a variant {why}"
        raise failure_of_all("sweep-batch", message, "sweep", None) from None
    finally:
        for each_child in children:
            each_child.close()


class _Rest:
    """The variants that no worker was given yet."""

    def __init__(self, start: int, stop: int) -> None:
        self._start, self._stop = start, stop
        self._lock = Lock()

    @property
    def left(self) -> int:
        """Return how many there are."""
        return self._stop - self._start

    def take(self, most: int, workers: int) -> tuple[int, int] | None:
        """Return the first of some variants, and the one after their last; None if none is left."""
        with self._lock:
            start = self._start
            fair = max(self.left // (2 * workers), LEAST_CHUNK)
            self._start = min(start + min(most, fair), self._stop)
            return (start, self._start) if start < self._start else None


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
    if other.unlike == EXCLUDED:
        what += ": other links overlap at home, and those have no contact"
    hint = "pass a value for it with :=, and make a batch for each of its values"
    if declared is None:
        return failure_of_all("sweep-batch", f"{what}, which is one for a batch", "sweep", None)
    was, now = first.arguments[name], other.arguments[name]
    message = f"the argument '{name}' changes the model itself: {what} ({was} and {now})"
    return failure("sweep-batch", message, declared.span, hint=hint)
