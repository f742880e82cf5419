"""The table of a sweep: a file for each chunk, in Parquet, or in CSV without pyarrow.

The same rows give the same bytes: nothing in a file depends on time, machine or order of work.
"""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from io import TextIOWrapper
from typing import Any

from ...diagnostics import Diagnostic
from ...files.regular import open_regular
from ...source import Public
from ...syntax.argument_section import ANY, BOOLEAN, INTEGER, NUMBER, TEXT
from .plan import Plan, import_extra

OK, REJECTED, FAILED = "ok", "rejected", "failed"
STATUSES = (OK, REJECTED, FAILED)
CRASH, TIMEOUT, ENDED = "variant-crash", "variant-timeout", "variant-exit"
"""The codes of variants that ended the process in which they were built."""
OUT_OF_MEMORY = "limit-memory"
FAULT = "internal-error"


class Row:
    """The result of a variant.

    Attributes:
        index: its number.
        arguments: the values of the axes.
        status: one of `STATUSES`.
        code: why it failed: the code of a diagnostic, or "".
        place: where, as `file:line:column`, or "".
        message: the message, or "".
        metrics: what the evaluation found.
        topology: what is the same for variants with the same bodies and joints, or None.
        hashes: the SHA-256 of the documents, by output format.
        documents: the documents and what belongs to each, by the ends of file names; if the models
            are kept.
        assets: the meshes that they share, by path.
        fields: of the first variant of a batch, the arrays of MuJoCo's model.
        unlike: of a batch, the name of a field that differs but cannot, or "".
        is_unequal: of a batch, whether what was recorded gives another document than a build.
        warnings: of a batch, what was found: code, place and message.
    """

    __slots__ = (
        "arguments", "assets", "code", "documents", "fields", "hashes", "index",
        "is_unequal", "message", "metrics", "place", "status", "topology", "unlike", "warnings",
    )  # fmt: skip

    def __init__(self, index: int, arguments: Mapping[str, object], status: str = OK) -> None:
        self.index = index
        self.arguments = dict(arguments)
        self.status = status
        self.code = ""
        self.place = ""
        self.message = ""
        self.metrics: dict[str, float | int | bool | None] = {}
        self.topology: str | None = None
        self.hashes: dict[str, str] = {}
        self.documents: dict[str, bytes] = {}
        self.assets: dict[str, bytes] = {}
        self.fields: dict[str, Any] = {}
        self.unlike = ""
        self.is_unequal = False
        self.warnings: Sequence[tuple[str, str, str]] = ()

    def fail(self, code: str, message: str, place: str = "") -> Row:
        """Note why the variant failed, and return the row."""
        self.status, self.code, self.message, self.place = FAILED, code, message, place
        return self


def row_types(plan: Plan) -> dict[str, str]:
    """Return the type of each argument's column, by the name of the argument."""
    return {axis.name: axis.kind for axis in plan.axes}


def first_error(diagnostics: Sequence[Diagnostic]) -> Diagnostic:
    """Return the first error, or what is there if nothing is one."""
    return next((each for each in diagnostics if each.severity == "error"), diagnostics[0])


# --- columns ----------------------------------------------------------------------------------


PARQUET, CSV = "parquet", "csv"
ENDINGS = (PARQUET, CSV)
FOLDER = "table"
OWN = ("id", "status", "code", "place", "message")
"""The columns that every table has."""
TOPOLOGY = "topology"


class Columns:
    """The columns of a table with their types.

    Attributes:
        names: the column of each argument, by its name.
        types: the type of each column.
    """

    __slots__ = ("_has_topologies", "_hashed", "_shards", "names", "types")

    def __init__(
        self,
        arguments: Mapping[str, str],
        hashed: Sequence[str],
        shards: Sequence[str] = (),
        *,
        has_topologies: bool = False,
    ) -> None:
        """Begin.

        Args:
            arguments: the types of the arguments that vary.
            hashed: the output formats whose hashes are kept.
            shards: the ends of the names of files whose places in a shard are kept.
            has_topologies: whether the topologies are kept.
        """
        self._has_topologies = has_topologies
        self._hashed = tuple(hashed)
        self._shards = tuple(shards)
        taken = {*OWN, TOPOLOGY, *(f"sha256_{format}" for format in hashed)}
        self.names = {name: f"{name}_argument" if name in taken else name for name in arguments}
        self.types = {"id": INTEGER}
        self.types.update({self.names[name]: kind for name, kind in arguments.items()})
        self.types.update(dict.fromkeys(OWN[1:], TEXT))

    def of(
        self, rows: Sequence[Row], places: Mapping[tuple[int, str], tuple[int, int]]
    ) -> dict[str, tuple[str, list[Any]]]:
        """Return type and values of each column, by its name.

        Args:
            rows: the rows.
            places: where in the shard a file is and how long, by index and the end of its name.
        """
        found: dict[str, tuple[str, list[Any]]] = {"id": (INTEGER, [row.index for row in rows])}
        for name, column in self.names.items():
            found[column] = (self.types[column], [row.arguments.get(name) for row in rows])
        for name in OWN[1:]:
            found[name] = (TEXT, [getattr(row, name) for row in rows])
        for name in sorted({name for row in rows for name in row.metrics}):
            values: list[Any] = [row.metrics.get(name) for row in rows]
            column = f"{name}_metric" if name in found else name
            kinds: set[type] = {type(value) for value in values if value is not None}
            kind = BOOLEAN if kinds == {bool} else NUMBER
            found[column] = (TEXT if str in kinds else kind, values)
        if self._has_topologies:
            found[TOPOLOGY] = (TEXT, [row.topology for row in rows])
        for format in self._hashed:
            found[f"sha256_{format}"] = (TEXT, [row.hashes.get(format) for row in rows])
        for end in self._shards:
            where = [places.get((row.index, end)) for row in rows]
            found[f"offset_{end}"] = (INTEGER, [each and each[0] for each in where])
            found[f"size_{end}"] = (INTEGER, [each and each[1] for each in where])
        return {name: (kind, _as(kind, values)) for name, (kind, values) in found.items()}


def _as(kind: str, values: list[Any]) -> list[Any]:
    """Return values as they are in a column of a type; None stays None."""
    if kind == NUMBER:
        return [None if value is None else float(value) for value in values]
    if kind == ANY:
        return [json.dumps(value, ensure_ascii=False, sort_keys=True) for value in values]
    if kind == TEXT:
        return [None if value is None else str(value) for value in values]
    return values


def results_in(names: Sequence[str]) -> list[str]:
    """Return the names of columns that hold results: they come after the message."""
    own = (TOPOLOGY, *(name for name in names if name.startswith(("sha256_", "offset_", "size_"))))
    start = names.index(OWN[-1]) + 1 if OWN[-1] in names else len(names)
    return [name for name in names[start:] if name not in own]


# --- files ---


def has_parquet() -> bool:
    """Return whether tables can be written in Parquet."""
    from importlib.util import find_spec

    return find_spec("pyarrow") is not None


def encoded(columns: Mapping[str, tuple[str, list[Any]]], ending: str) -> bytes:
    """Return the bytes of a file with these columns.

    Raises:
        YamaroError: a package is missing.
    """
    if ending == CSV:
        text = io.StringIO(newline="")
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(
            [
                ""
                if value is None
                else str(value).lower()
                if isinstance(value, bool)
                else str(value)
                for value in row
            ]
            for row in zip(*(values for _, values in columns.values()), strict=True)
        )
        return text.getvalue().encode()
    arrow = import_extra("pyarrow")
    parquet = import_extra("pyarrow.parquet")
    types = {
        INTEGER: arrow.int64(), NUMBER: arrow.float64(), BOOLEAN: arrow.bool_(),
        TEXT: arrow.string(), ANY: arrow.string(),
    }  # fmt: skip
    arrays = [arrow.array(values, types[kind]) for kind, values in columns.values()]
    file = io.BytesIO()
    parquet.write_table(
        arrow.Table.from_arrays(arrays, names=list(columns)), file, compression="zstd"
    )
    return file.getvalue()


def part_name(number: int, ending: str) -> str:
    """Return what the file of a chunk is called."""
    return f"part-{number:06d}.{ending}"


def part_paths(folder: str) -> dict[int, str]:
    """Return the paths of the chunks' files in the folder of a sweep, by number."""
    found = {}
    try:
        names = os.listdir(os.path.join(folder, FOLDER))
    except OSError:
        return {}
    for name in sorted(names):
        stem, _, ending = name.partition(".")
        number = stem.removeprefix("part-")
        if ending in ENDINGS and stem.startswith("part-") and number.isdigit():
            found[int(number)] = os.path.join(folder, FOLDER, name)
    return dict(sorted(found.items()))


def read_columns(folder: str, names: Sequence[str] = ()) -> dict[str, list[Any]]:
    """Return the columns of the table in the folder of a sweep; all, or those named.

    Rows are in the order of their numbers. What a chunk does not have is None.
    """
    columns: dict[str, list[Any]] = {}
    length = 0
    for part in parts_of(folder, names):
        count = len(next(iter(part.values()), []))
        for name in part:
            if name not in columns:
                columns[name] = [None] * length
        for name, values in columns.items():
            values += part.get(name) or [None] * count
        length += count
    return columns


def parts_of(folder: str, names: Sequence[str] = ()) -> Iterator[dict[str, list[Any]]]:
    """Yield the columns of each chunk, in order; all, or those named."""
    for path in part_paths(folder).values():
        if path.endswith(PARQUET):
            parquet = import_extra("pyarrow.parquet")
            with parquet.ParquetFile(path) as file:
                known = [name for name in names if name in file.schema_arrow.names]
                yield file.read(columns=known if names else None).to_pydict()
        else:
            with (
                open_regular(path) as data,
                TextIOWrapper(data, encoding="utf-8", newline="") as text_file,
            ):
                reader = csv.reader(text_file)
                columns: dict[str, list[Any]] = {name: [] for name in next(reader)}
                for row in reader:
                    for (name, values), text in zip(columns.items(), row, strict=True):
                        values.append(_of_csv(name, text))
            yield {name: values for name, values in columns.items() if not names or name in names}


def _of_csv(name: str, text: str) -> Any:
    """Return a value as Parquet would have it, as far as CSV says."""
    if name in (*OWN[1:], TOPOLOGY) or name.startswith("sha256_"):
        return text
    if text in ("", "true", "false"):
        return {"": None, "true": True, "false": False}[text]
    for read in (int, float):
        try:
            return read(text)
        except ValueError:
            continue
    return text


# --- what a sweep came to, in words -----------------------------------------------------------


MOST_GROUPS = 10
"""Groups of failures that are shown."""


class Group(Public):
    """Variants that failed with the same code at the same place.

    Attributes:
        code: the code.
        place: the place, or "".
        count: how many there are.
        first: the number of the first one.
        message: what was said of that.
    """

    __slots__ = ("code", "count", "first", "message", "place")

    def __init__(self, code: str, place: str, first: int, message: str) -> None:
        self.code = code
        self.place = place
        self.count = 0
        self.first = first
        self.message = message


class Summary(Public):
    """The result of a sweep.

    Attributes:
        counts: how many variants have which status.
        groups: those that failed, the largest group first.
        lacking: how many variants that are ok have no value in a column of results, by its name;
            of those that have all values nothing.
    """

    __slots__ = ("counts", "groups", "lacking")

    def __init__(self, folder: str) -> None:
        """Read the table in the folder of a sweep."""
        self.counts = {OK: 0, REJECTED: 0, FAILED: 0}
        groups: dict[tuple[str, str], Group] = {}
        values: dict[str, int] = {}
        for part in parts_of(folder):
            at = [index for index, status in enumerate(part["status"]) if status == OK]
            for name in results_in(list(part)):
                column = part[name]
                count = sum(column[index] is not None for index in at)
                values[name] = values.get(name, 0) + count
            for status in self.counts:
                self.counts[status] += part["status"].count(status)
            for index, status in enumerate(part["status"]):
                if status != FAILED:
                    continue
                code, place = part["code"][index], part["place"][index]
                group = groups.get((code, place))
                if group is None:
                    message = part["message"][index]
                    group = Group(code, place, part["id"][index], message)
                    groups[code, place] = group
                group.count += 1
        self.lacking = {
            name: self.counts[OK] - count
            for name, count in values.items()
            if count < self.counts[OK]
        }
        self.groups = sorted(groups.values(), key=lambda group: (-group.count, group.first))

    def lines(self) -> list[str]:
        """Return it as lines of text."""
        total = sum(self.counts.values())
        counts = [f"{self.counts[OK]:,} ok"]
        counts += [
            f"{self.counts[name]:,} {name}" for name in (REJECTED, FAILED) if self.counts[name]
        ]
        found = [f"{total:,} variant{'' if total == 1 else 's'}: {', '.join(counts)}"]
        for group in self.groups[:MOST_GROUPS]:
            where = f" at {group.place}" if group.place else ""
            found.append(f"  {group.count:,} × {group.code}{where}")
            found.append(f"      such as {group.first}: {group.message}")
        if len(self.groups) > MOST_GROUPS:
            rest = sum(group.count for group in self.groups[MOST_GROUPS:])
            found.append(f"  {rest:,} × others, see the columns code and place of the table")
        for name, count in list(self.lacking.items())[:MOST_GROUPS]:
            found.append(f"  {count:,} ok without a value of '{name}'")
        return found
