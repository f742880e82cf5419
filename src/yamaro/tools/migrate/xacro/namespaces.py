"""The namespaces of a robot in xacro: files that are included with `ns`, and what is in them."""

from __future__ import annotations

from ....xml.tree import Element
from ....xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping


class Namespaces:
    """Which files are in a namespace.

    Attributes:
        inside: the paths of the files whose names are seen in namespaces only.
        mixed: the paths of those that are included without one as well.
    """

    def __init__(
        self, main: str, roots: Mapping[str, Element], included: Mapping[tuple[str, int], list[str]]
    ) -> None:
        """Look at the includes of all files.

        Args:
            main: the path of the main file.
            roots: the root elements of all files, by path.
            included: the paths that an include means, by the place of its `filename`.
        """
        self._roots = roots
        self._included = included
        self._files: dict[tuple[str, str], list[str]] = {}
        """The files of a namespace, by the file that includes them and its name."""
        named: list[str] = []
        for path, root in roots.items():
            for element in _includes_of(root):
                if "ns" in element.attributes:
                    name = format_value(element.attributes["ns"])
                    self._files.setdefault((path, name), []).extend(self._meant_by(element))
                    named += self._meant_by(element)
        inside = self._reached_from(named)
        outside = self._reached_from([main])
        self.inside = inside - outside
        self.mixed = inside & outside

    def names(self, path: str) -> set[str]:
        """Return the names of the namespaces that a file makes."""
        return {name for includer, name in self._files if includer == path}

    def files(self, path: str, names: list[str]) -> list[str]:
        """Return the files of a namespace, as names of namespaces lead to it from a file."""
        paths = [path]
        for name in names:
            around = self._reached_from(paths)
            paths = [own for each in around for own in self._files.get((each, name), ())]
        return sorted(self._reached_from(paths))

    def reached_by(self, includes: list[Element]) -> set[str]:
        """Return the files that includes bring in, in namespaces or not."""
        reached: set[str] = set()
        pending = [path for element in includes for path in self._meant_by(element)]
        while pending:
            path = pending.pop()
            if path not in reached:
                reached.add(path)
                inner = _includes_of(self._roots[path])
                pending += [own for element in inner for own in self._meant_by(element)]
        return reached

    def _meant_by(self, include: Element) -> list[str]:
        span = include.value_span("filename")
        paths = self._included.get((span.source.path, span.start), [])
        return [path for path in paths if path in self._roots]

    def _reached_from(self, paths: list[str]) -> set[str]:
        """Return files, with those that they include without a namespace."""
        reached: set[str] = set()
        pending = list(paths)
        while pending:
            path = pending.pop()
            if path not in reached:
                reached.add(path)
                for element in _includes_of(self._roots[path]):
                    if "ns" not in element.attributes:
                        pending += self._meant_by(element)
        return reached


def _includes_of(root: Element) -> list[Element]:
    return [element for element in root.iter() if element.name == "xacro:include"]
