"""Puts all of the playground's Python into one archive. Runs in Pyodide itself, in the build.

A browser starts Python anew each time. To compile a module takes longer than to run it, so what
is imported at the start is there as byte code.
"""

from __future__ import annotations

import gzip
import io
import py_compile
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

STANDARD_LIBRARY = "/lib/python314.zip"
"""Where Pyodide puts the archive, and searches it for modules."""
DATE = (1980, 1, 1, 0, 0, 0)
LEFT_OUT = (
    "_pydatetime.py",
    "_pyio.py",
    "_pyrepl/",
    "asyncio/proactor_events.py",
    "asyncio/windows_",
    "bdb.py",
    "doctest.py",
    "encodings/cp",
    "encodings/iso",
    "encodings/koi",
    "encodings/mac_",
    "ftplib.py",
    "http/cookiejar.py",
    "http/server.py",
    "imaplib.py",
    "mailbox.py",
    "modulefinder.py",
    "multiprocessing/",
    "pdb.py",
    "pickletools.py",
    "poplib.py",
    "profile.py",
    "pstats.py",
    "pydoc.py",
    "smtplib.py",
    "socketserver.py",
    "trace.py",
    "unittest/",
    "wsgiref/",
    "xmlrpc/",
)
"""Modules of the standard library that need a terminal, processes or the network, tools for those
who write Python, encodings from before Unicode, and Python versions of what is there in C."""


def combined(standard: str, own: str) -> bytes:
    """Return the archive, compressed as a whole, which makes it smaller than file by file.

    Args:
        standard: the archive of the standard library.
        own: the archive of the modules that run in the playground.
    """
    specs = (getattr(module, "__spec__", None) for module in list(sys.modules.values()))
    imported = {getattr(spec, "origin", None) for spec in specs}
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as file:
        for path, name, content in (*_modules(own, own), *_modules(standard, STANDARD_LIBRARY)):
            if path in imported:
                file.writestr(zipfile.ZipInfo(f"{name}c", DATE), _compiled(name, content))
            elif not name.startswith(LEFT_OUT):
                file.writestr(zipfile.ZipInfo(name, DATE), content)
    return gzip.compress(target.getvalue(), mtime=0)


def _modules(archive: str, place: str) -> Iterator[tuple[str, str, bytes]]:
    """Yield where Python finds each module of an archive, its name there, and its content."""
    with zipfile.ZipFile(archive) as file:
        for name in file.namelist():
            yield f"{place}/{name}", name, file.read(name)


def _compiled(name: str, content: bytes) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        source, code = Path(folder, "module.py"), Path(folder, "module.pyc")
        source.write_bytes(content)
        py_compile.compile(
            str(source),
            str(code),
            f"{STANDARD_LIBRARY}/{name}",
            doraise=True,
            optimize=2,  # without docstrings
            invalidation_mode=py_compile.PycInvalidationMode.UNCHECKED_HASH,
        )
        return code.read_bytes()
