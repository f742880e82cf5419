"""Lists the variables that a file lets one set, for the completion of shells.

Only the YAML is read for that: no expression is evaluated and nothing is imported.
"""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..yaml.nodes import YamlNode

MAX_BYTES = 8 << 20
MAX_DEFAULT = 40


def variable_lines(path: str) -> str:
    """Return a line `name:=<tab>default` for each variable in the root of a file.

    A file that cannot be read has none: someone who is still typing wants no errors.
    """
    from ..diagnostics import Reporter, YamaroError
    from ..files.regular import read_start
    from ..source import Source
    from ..terminal import printable
    from ..yaml.reader import read

    if path.startswith("~"):
        path = os.path.expanduser(path)
    try:
        data = read_start(path, MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            return ""
        root = read(Source(data.decode("utf-8-sig"), name=path), reporter=Reporter())
    except (OSError, ValueError, YamaroError):
        return ""
    lines: dict[str, str] = {}
    for section, body in _pairs(root):
        if section == "variables":
            for key, value in _pairs(body):
                name = key.partition("/")[0].strip()
                if name.isidentifier():
                    lines.setdefault(name, printable(_shortened(value)).replace("\t", " "))
    return "".join(f"{name}:=\t{default}\n" for name, default in lines.items())


def _pairs(node: YamlNode) -> Iterator[tuple[str, YamlNode]]:
    """Yield key text and value of a mapping, or of each mapping in a list of them."""
    from ..yaml.nodes import MappingNode, SequenceNode

    if isinstance(node, SequenceNode):
        for item in node.items:
            if isinstance(item, MappingNode):
                yield from _pairs(item)
    elif isinstance(node, MappingNode):
        for key, value in node:
            yield key.text, value


def _shortened(value: YamlNode) -> str:
    """Return the spelling of a value on one short line."""
    text = " ".join(value.source.text[value.start : value.end].split())
    return text if len(text) <= MAX_DEFAULT else text[: MAX_DEFAULT - 1] + "…"
