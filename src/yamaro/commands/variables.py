"""Lists the arguments or variables that a file lets one set, for the completion of shells.

The file is only read for that: no expression is evaluated and nothing is imported.
"""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Source
    from ..tools.declared_arguments import Declared

MAX_BYTES = 8 << 20
MAX_DEFAULT = 40


def variable_lines(path: str) -> str:
    """Return a line `name:=<tab>default` for each argument or variable of a file.

    A file that cannot be read has none: someone who is still typing wants no errors.
    """
    from ..diagnostics import YamaroError
    from ..files.loader import FileLoader
    from ..files.packages import PackageFinder
    from ..files.regular import read_start
    from ..policy import Limits
    from ..source import holds_xml
    from ..tools.declared_arguments import listing_of

    if path.startswith("~"):
        path = os.path.expanduser(path)
    limits = Limits()
    try:
        data = read_start(path, MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            return ""
        source = _source(data, path, is_xml=holds_xml(path, data))
        loader = FileLoader(limits)
        listing = listing_of(source, loader=loader, packages=PackageFinder(), limits=limits)
    except (OSError, ValueError, YamaroError):
        return ""
    return "".join(map(_line, listing.declared))


def _source(data: bytes, path: str, *, is_xml: bool) -> Source:
    from ..source import Source
    from ..xml.reader import decode_xml

    if is_xml:
        source = decode_xml(data, name=path, path=os.path.abspath(path))
        source.is_xml = True
        return source
    return Source(data.decode("utf-8-sig"), name=path, path=os.path.abspath(path))


def _line(declared: Declared) -> str:
    """Return the name with its default, and what else is known, on one line."""
    from ..terminal import printable
    from ..tools.declared_arguments import about

    default = "" if declared.default_text is None else _shortened(declared.default_text)
    notes = ", ".join(text for text in (default, about(declared)) if text)
    return f"{declared.name}:=\t{printable(notes).replace(chr(9), ' ')}\n"


def _shortened(text: str) -> str:
    """Return the spelling of a value on one short line."""
    text = " ".join(text.split())
    return text if len(text) <= MAX_DEFAULT else text[: MAX_DEFAULT - 1] + "…"
