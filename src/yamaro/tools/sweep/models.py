"""Models that are kept: a tar file for each chunk, and the meshes that all of them share.

The files of variant 4711 are `000004711.xml` and so on. The table says where in the tar file
each one begins, so that one can be read without the others.
"""

from __future__ import annotations

import io
import os
import tarfile

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from .rows import Row

_DIGITS = 6


def shard_name(number: int) -> str:
    """Return what the tar file of a chunk is called."""
    return f"shard-{number:0{_DIGITS}d}.tar"


def packed(rows: Sequence[Row]) -> tuple[bytes, dict[tuple[int, str], tuple[int, int]]]:
    """Return the documents of rows as a tar file, and where in it each one is and how long.

    The places are by the number of the variant and the end of the file's name.
    """
    from .builder import model_name

    file = io.BytesIO()
    places = {}
    with tarfile.open(fileobj=file, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for row in rows:
            for end, data in row.documents.items():
                member = tarfile.TarInfo(f"{model_name(row.index)}.{end}")
                member.size = len(data)
                tar.addfile(member, io.BytesIO(data))
                places[row.index, end] = (file.tell() - _padded(len(data)), len(data))
    return file.getvalue(), places


def _padded(length: int) -> int:
    return -(-length // tarfile.BLOCKSIZE) * tarfile.BLOCKSIZE


def assets_of(rows: Sequence[Row]) -> dict[str, bytes]:
    """Return the meshes of rows, by path."""
    found: dict[str, bytes] = {}
    for row in rows:
        found.update(row.assets)
    return found


def missing_assets(folder: str, assets: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the meshes that are not in a folder yet; their names say their content."""
    paths = {os.path.join(folder, *path.split("/")): data for path, data in assets.items()}
    return {path: data for path, data in paths.items() if not os.path.exists(path)}
