"""Where a file names other files: includes, meshes, textures, Python modules beside it."""

from __future__ import annotations

import os
import re

from ...source import Span
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .cursor import word_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...yaml.nodes import YamlNode
    from .texts import Text
    from .workspace import Workspace

_FILENAME = re.compile(r"(?:[/,]\s*)(?:filename|path)\s*:?=\s*['\"]?([^,'\"]*[^,'\"\s])")
_PATH_KEYS = ("include", "path", "texture", "filename")


class PathPlace:
    """A path in a file, and the file that it means."""

    __slots__ = ("path", "span")

    def __init__(self, path: str, span: Span) -> None:
        self.path = path
        self.span = span


def paths_in(workspace: Workspace, text: Text) -> list[PathPlace]:
    """Return the paths in a file whose files are there."""
    if not text.is_yaml:
        from .xml_names import written_paths

        written = written_paths(text)
    else:
        written = list(_written(text.root, [], set()))
    found = []
    for path, span in written:
        resolved = workspace.resolve(text, path)
        if resolved is not None and os.path.isfile(resolved):
            found.append(PathPlace(resolved, span))
    return found


def _written(node: YamlNode | None, path: list[str], seen: set[int]) -> Iterator[tuple[str, Span]]:
    """Yield the paths that are written in a file, with their places."""
    if node is None or isinstance(node, ScalarNode) or id(node) in seen:
        return
    seen.add(id(node))
    if isinstance(node, SequenceNode):
        for item in node.items:
            yield from _written(item, path, seen)
        return
    for key, value in node.pairs:
        word = word_of(key.text)
        if "=" in key.text:
            for found in _FILENAME.finditer(key.text):
                yield found[1], key.span(found.start(1), found.end(1))
        if isinstance(value, ScalarNode):
            is_mesh = word == "geometry" and "." in value.text
            if (word in _PATH_KEYS or is_mesh) and value.text:
                yield value.text.strip(), _inside(value)
            elif word == "import":
                yield from _modules(value)
        elif word == "import" and isinstance(value, SequenceNode):
            for item in value.items:
                if isinstance(item, ScalarNode):
                    yield from _modules(item)
        if isinstance(value, (MappingNode, SequenceNode)):
            yield from _written(value, [*path, word], seen)


def _modules(node: ScalarNode) -> Iterator[tuple[str, Span]]:
    """Yield the file of the module that an import names, if it were beside the file."""
    words = node.text.split()
    name = words[1] if words[:1] == ["from"] and len(words) > 1 else "".join(words[:1])
    if name.replace(".", "").isidentifier():
        at = node.text.find(name)
        yield name.replace(".", "/") + ".py", node.span(at, at + len(name))


def _inside(node: ScalarNode) -> Span:
    """Return the place of a scalar without its quotes."""
    if not node.style or not node.text:
        return node.span()
    return Span(node.source, node.offset(0), node.offset(len(node.text) - 1) + 1)
