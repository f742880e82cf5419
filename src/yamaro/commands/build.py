"""`yamaro FILE`: compiles a file."""

from __future__ import annotations

import os

from .conversion import convert_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..compiler import Build
    from ..output import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the XML, or with `--deps` the files it is made of; return the exit status."""
    take = _dependencies if arguments.has("deps") else _document
    return convert_file(arguments, streams, take)


def _document(build: Build) -> Iterable[bytes]:
    return build.encoded()


def _dependencies(build: Build) -> list[bytes]:
    names = dict.fromkeys(filter(os.path.isabs, build.files + build.meshes))
    return [os.fsencode(name) + b"\n" for name in names]
