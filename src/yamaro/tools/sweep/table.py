"""The table of a sweep: a file for each chunk, in Parquet, or in CSV without pyarrow.

The same rows give the same bytes: nothing in a file depends on time, machine or order of work.
"""

from __future__ import annotations

import csv
import io
import json
import os
from io import TextIOWrapper

from ...files.regular import open_regular
from .axes import ANY, BOOLEAN, INTEGER, NUMBER, TEXT
from .methods import import_extra

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from typing import Any

    from .rows import Row

PARQUET, CSV = "parquet", "csv"
ENDINGS = (PARQUET, CSV)
FOLDER = "table"
_DIGITS = 6
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
            values = [row.metrics.get(name) for row in rows]
            column = f"{name}_metric" if name in found else name
            found[column] = (_kind_of_metric(values), values)
        if self._has_topologies:
            found[TOPOLOGY] = (TEXT, [row.topology for row in rows])
        for format in self._hashed:
            found[f"sha256_{format}"] = (TEXT, [row.hashes.get(format) for row in rows])
        for end in self._shards:
            where = [places.get((row.index, end)) for row in rows]
            found[f"offset_{end}"] = (INTEGER, [each and each[0] for each in where])
            found[f"size_{end}"] = (INTEGER, [each and each[1] for each in where])
        return {name: (kind, _as(kind, values)) for name, (kind, values) in found.items()}


def _kind_of_metric(values: Sequence[object]) -> str:
    kinds = {type(value) for value in values} - {type(None)}
    if str in kinds:
        return TEXT
    return BOOLEAN if kinds == {bool} else NUMBER


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
    return _as_parquet(columns) if ending == PARQUET else _as_csv(columns)


def _as_parquet(columns: Mapping[str, tuple[str, list[Any]]]) -> bytes:
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


def _as_csv(columns: Mapping[str, tuple[str, list[Any]]]) -> bytes:
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(
        [_in_csv(value) for value in row]
        for row in zip(*(values for _, values in columns.values()), strict=True)
    )
    return file.getvalue().encode()


def _in_csv(value: object) -> str:
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)


def part_name(number: int, ending: str) -> str:
    """Return what the file of a chunk is called."""
    return f"part-{number:0{_DIGITS}d}.{ending}"


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
            yield _read_csv(path, names)


def _read_csv(path: str, names: Sequence[str]) -> dict[str, list[Any]]:
    with open_regular(path) as data, TextIOWrapper(data, encoding="utf-8", newline="") as file:
        reader = csv.reader(file)
        header = next(reader)
        columns: dict[str, list[Any]] = {name: [] for name in header}
        for row in reader:
            for name, text in zip(header, row, strict=True):
                columns[name].append(_of_csv(name, text))
    return {name: values for name, values in columns.items() if not names or name in names}


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
