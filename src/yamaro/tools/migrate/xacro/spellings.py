"""Which files a computed name of a file could mean at most, as far as nothing rules them out.

A name becomes patterns of the shell: what is known of it stays, and the rest is `*`.
"""

from __future__ import annotations

import ast
import os

from ....xacro.templates import Expression, Substitution
from .choices import MARK, MOST_SPELLINGS, Choices, escaped, name_alone, parsed, tree_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ....source import Span

_ENDINGS = (".xacro", ".urdf", ".xml")
_ANYTHING = ["*"]


class Spellings:
    """Finds the patterns for one name."""

    def __init__(self, choices: Choices, span: Span) -> None:
        """Take what is known of the files, and where the name is written."""
        self._choices = choices
        self._span = span

    def files(self, text: str) -> list[str]:
        """Return all files that match."""
        found: dict[str, None] = {}
        folders = (os.path.dirname(self._span.source.path), self._choices.folder_of_main)
        for pattern in self._of_text(text, frozenset()):
            for folder in dict.fromkeys(folders):
                paths = self._choices.host.glob(os.path.join(folder, pattern))
                found |= dict.fromkeys(os.path.normpath(path) for path in sorted(paths))
        return [path for path in found if path.endswith(_ENDINGS)]

    def items(self, text: str, base: str) -> dict[str, str]:
        """Return the files that a name out of a dict or list in the sources may mean, by the name.

        Args:
            text: the name.
            base: the folder that it is relative to.
        """
        found = {}
        for pattern in self._of_text(text, frozenset()) if "[" in text or ".get(" in text else ():
            name = pattern.replace("[*]", "*").replace("[?]", "?").replace("[[]", "[")
            path = os.path.normpath(os.path.join(base, name))
            is_file = "*" not in pattern and path.endswith(_ENDINGS) and os.path.isfile(path)
            if is_file and path != self._span.source.path:
                found[name] = path
        return found

    def is_constant(self, text: str) -> bool:
        """Return whether a text is the same whatever the arguments are."""
        patterns = {pattern.replace("[*]", "") for pattern in self._of_text(text, frozenset())}
        return len(patterns) == 1 and "*" not in patterns.pop()

    def _of_text(self, text: str, known: frozenset[str]) -> list[str]:
        """Return patterns for a text; `known` are the names that it was reached through."""
        template = parsed(text)
        if template is None:
            return _ANYTHING
        return _joined(
            [escaped(part)]
            if isinstance(part, str)
            else self._of_part(part, name_alone(text[part.start : part.end]), known)
            for part in template.parts
        )

    def _of_part(
        self, part: Expression | Substitution, name: str, known: frozenset[str]
    ) -> list[str]:
        if name:
            return self._of_name(name, known)
        folder = self._choices.folder(part, self._span)
        if folder is not None:
            return [escaped(folder)]
        if isinstance(part, Substitution):
            command, _, rest = part.text.partition(" ")
            if command == "find":
                return self._of_package(rest.strip(), known)
            return self._of_environment(part.text)
        if self._choices.is_lookup(part.text):
            return [escaped(own) for own in self._choices.data]
        tree = tree_of(part.text)
        return _ANYTHING if tree is None else self._of_python(tree, known)

    def _of_package(self, text: str, known: frozenset[str]) -> list[str]:
        """Return the folders of the packages that a text may name; any other is an error."""
        names = self._of_text(text, known)
        folders = [self._choices.package(name, self._span) for name in names if "*" not in name]
        found = [escaped(folder) for folder in dict.fromkeys(folders) if folder is not None]
        return found if found and "*" not in names else [*found, *_ANYTHING]

    def _of_environment(self, command: str) -> list[str]:
        words = command.split()
        value = None
        if len(words) > 1 and words[0] in ("env", "optenv"):
            value = self._choices.host.environment(words[1])
        return [*_ANYTHING, *([escaped(value)] if value else [])]

    def _of_name(self, name: str, known: frozenset[str]) -> list[str]:
        if name in known:
            return []
        if name.startswith(MARK) or name not in self._choices.texts:
            return _ANYTHING
        given = self._choices.texts[name]
        return [own for text in given for own in self._of_text(text, known | {name})]

    def _of_python(self, node: ast.expr, known: frozenset[str]) -> list[str]:
        match node:
            case ast.Constant(value):
                return [escaped(str(value))]
            case ast.Name(name):
                return self._of_name(name, known)
            case ast.IfExp(_, one, other):
                return self._of_python(one, known) + self._of_python(other, known)
            case ast.BoolOp(_, values):
                return [own for each in values for own in self._of_python(each, known)]
            case ast.BinOp(one, ast.Add(), other):
                return _joined(self._of_python(each, known) for each in (one, other))
            case ast.Call(ast.Name("str"), [inner]):
                return self._of_python(inner, known)
            case ast.Subscript(inner, _) | ast.Call(ast.Attribute(inner, "get"), _):
                return self._of_items(inner, known)
        return _ANYTHING

    def _of_items(self, node: ast.expr, known: frozenset[str]) -> list[str]:
        """Return patterns for what a dict or a list holds."""
        items = self._items(node, known)
        if items is None:
            return _ANYTHING
        return [own for each in items for own in self._of_python(each, known)]

    def _items(self, node: ast.expr, known: frozenset[str]) -> list[ast.expr] | None:
        """Return what a dict or a list holds, or None if that is not known."""
        match node:
            case ast.Dict(_, items) | ast.List(items) | ast.Tuple(items):
                return items
            case ast.Call(ast.Name("dict"), [], keywords):
                return [each.value for each in keywords]
            case ast.Subscript(inner, _) | ast.Call(ast.Attribute(inner, "get"), _):
                several = [self._items(each, known) for each in self._items(inner, known) or ()]
            case ast.Name(name) if name in self._choices.texts and name not in known:
                own = known | {name}
                trees = [_whole(text) for text in self._choices.texts[name]]
                several = [None if tree is None else self._items(tree, own) for tree in trees]
            case _:
                return None
        found = [items for items in several if items is not None]
        return [each for items in found for each in items] if len(found) == len(several) else None


def _whole(text: str) -> ast.expr | None:
    """Return the expression that a text is, or None."""
    return tree_of(text.strip()[2:-1]) if text.startswith("${") else None


def _joined(several: Iterable[list[str]]) -> list[str]:
    """Return patterns for what is made of parts, from those for each."""
    results = [""]
    for own in several:
        results = list(dict.fromkeys(before + after for before in results for after in own))
        if len(results) > MOST_SPELLINGS:
            return _ANYTHING
    return results
