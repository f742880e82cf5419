"""Lists what a file lets one set, and to which values, for the completion of shells.

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
    """Return a line `name:=<tab>default` for each argument or variable of a file."""
    return "".join(map(_line, _declared(path)))


def value_lines(path: str, name: str) -> str:
    """Return a line for each value of an argument or variable that has a few: choices, or a truth.

    Values that a shell would take apart are left out.
    """
    for declared in _declared(path):
        if declared.name == name:
            return "".join(f"{value}\n" for value in _values(declared) if _is_word(value))
    return ""


def _values(declared: Declared) -> list[str]:
    from ..syntax.argument_section import BOOLEAN

    entry = declared.entry
    if entry is not None and entry.choices is not None:
        return entry.choice_texts()
    is_boolean = entry.kind == BOOLEAN if entry is not None else isinstance(declared.default, bool)
    return ["true", "false"] if is_boolean else []


def _is_word(value: str) -> bool:
    return all(char.isalnum() or char in "_-+./" for char in value)


def _declared(path: str) -> list[Declared]:
    """Return what a file declares.

    A file that cannot be read has nothing: someone who is still typing wants no errors.
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
            return []
        source = _source(data, path, is_xml=holds_xml(path, data))
        loader = FileLoader(limits)
        listing = listing_of(source, loader=loader, packages=PackageFinder(), limits=limits)
    except (OSError, ValueError, YamaroError):
        return []
    return listing.declared


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
