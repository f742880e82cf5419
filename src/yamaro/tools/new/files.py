"""The files of a new package, made of the template beside this module."""

from __future__ import annotations

import os

from ... import __version__

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

PICTURE = "picture.png"

_TEMPLATE = os.path.join(os.path.dirname(__file__), "template")
_PICTURE_IN_README = f"![The robot]({PICTURE})\n\n"


def files_of(name: str, *, has_picture: bool) -> dict[str, str]:
    """Return the texts of a package's files, by their paths in its folder, which have `/`.

    Args:
        name: that of the package, and of its robot.
        has_picture: whether `picture.png` is there, for the README to show.
    """
    values = {
        "NAME": name,
        "DISTRIBUTION": name.replace("_", "-"),
        "YAMARO": __version__,
        "PICTURE": _PICTURE_IN_README if has_picture else "",
    }
    files = {}
    for path in _paths():
        with open(os.path.join(_TEMPLATE, *path.split("/")), encoding="utf-8") as file:
            text = file.read()
        for word, value in values.items():
            text = text.replace(f"@{word}@", value)
        path = path.replace("NAME", name).replace("dot-", ".")
        files[path.removesuffix(".in")] = text  # with it, tools would take the template for a file
    return files


def main_file(name: str) -> str:
    """Return the path of a package's robot."""
    return f"urdf/{name}.yaml"


def _paths() -> Iterator[str]:
    for folder, inner, names in os.walk(_TEMPLATE):
        inner.sort()
        for name in sorted(names):
            yield os.path.relpath(os.path.join(folder, name), _TEMPLATE).replace(os.sep, "/")
