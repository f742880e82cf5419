"""Finds robots that Python packages bring: by entry points, and in the cache of robot_descriptions.

A Python package names its robots by entry points of the group `yamaro.packages`: a name, and the
module whose folder has the files. Nothing is imported to find that folder, and `importlib` is not
asked either, since it runs the modules around: what pip has written about the package is read.
"""

from __future__ import annotations

import os
import sys

from .packages import is_package_name, packages_below
from .regular import read_start

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

PACKAGE_FOLDERS = ("site-packages", "dist-packages")
"""What the folders are called in which pip puts Python packages."""
GROUP = "yamaro.packages"
CACHE_VARIABLE = "ROBOT_DESCRIPTIONS_CACHE"
CACHE = os.path.join("~", ".cache", "robot_descriptions")

_MOST_BYTES = 1 << 20
_ENDINGS = (".dist-info", ".egg-info")


class InstalledPackage:
    """A package of robots that a Python package brings.

    Attributes:
        name: what it is called in `package://name`.
        folder: where its files are; None if it is not found.
        distribution: what pip calls the Python package.
        version: that of the Python package.
        value: what the entry point says.
    """

    __slots__ = ("distribution", "folder", "name", "value", "version")

    def __init__(self, name: str, value: str, folder: str | None, info: str) -> None:
        """Take the name and the value of an entry point; `info` is where pip wrote it."""
        self.name = name
        self.value = value
        self.folder = folder
        name, self.version = _name_and_version(info)
        self.distribution = name.replace("_", "-")  # pip shows it so


class InstalledPackages:
    """The packages of robots that Python packages bring, read when they are first asked for."""

    __slots__ = ("_cache", "_cached", "_distributions", "_packages", "_paths")

    def __init__(self, paths: Sequence[str] | None = None, cache: str | None = None) -> None:
        """Say where to look: where Python finds modules, by default, except for the current folder.

        Args:
            paths: the folders of Python packages.
            cache: the folder of robot_descriptions.
        """
        try:
            here = os.path.realpath(os.getcwd())
        except OSError:  # it is gone
            here = ""
        found = sys.path if paths is None else paths
        self._paths = [path for path in found if path and os.path.realpath(path) != here]
        self._cache = os.path.expanduser(cache or os.environ.get(CACHE_VARIABLE) or CACHE)
        self._packages: dict[str, InstalledPackage] | None = None
        self._distributions: set[str] = set()
        self._cached: dict[str, str] | None = None

    def folder(self, name: str) -> str | None:
        """Return the absolute folder of a package, or None if there is none."""
        if not is_package_name(name):
            return None
        found = self.all().get(name)
        if found is not None and found.folder is not None:
            return found.folder
        # In the cache of robot_descriptions a clone is called after its package; one of another
        # commit is in `name-COMMIT/`. Other packages are in clones, and have a package.xml.
        folder = os.path.join(self._cache, name)
        if os.path.isdir(folder):
            return folder
        for other in _subfolders(self._cache):
            folder = os.path.join(self._cache, other, name)
            if other.startswith(f"{name}-") and os.path.isdir(folder):
                return folder
        return self._cached_packages().get(name)

    def all(self) -> dict[str, InstalledPackage]:
        """Return all packages that entry points name, also those whose folder is not found."""
        if self._packages is None:
            self._packages = {}
            for path in dict.fromkeys(self._paths):
                self._read(os.path.abspath(path))
        return self._packages

    def names(self) -> list[str]:
        """Return the names of all packages that can be found, sorted."""
        found = {name for name, each in self.all().items() if each.folder is not None}
        return sorted(found.union(_subfolders(self._cache), self._cached_packages()))

    def has_distribution(self, name: str) -> bool:
        """Return whether a Python package of that name is installed."""
        self.all()
        return _normal(name) in self._distributions

    def brought_by(self, distribution: str) -> list[str]:
        """Return the names of the packages that a Python package brings."""
        packages = self.all().values()
        return [each.name for each in packages if is_same_name(each.distribution, distribution)]

    def looked_at(self) -> list[str]:
        """Return the places that are looked at, each as a phrase to show to a person."""
        folders = [path for path in dict.fromkeys(self._paths) if os.path.isdir(path)]
        shown = [p for p in folders if os.path.basename(p) in PACKAGE_FOLDERS] or folders[:1]
        places = [f"{path} (entry points '{GROUP}')" for path in shown]
        if os.path.isdir(self._cache):
            places.append(f"{self._cache} (robot_descriptions)")
        return places

    def _read(self, path: str) -> None:
        """Take the packages that Python packages in a folder bring; the first of a name wins."""
        assert self._packages is not None
        try:
            names = sorted(os.listdir(path))
        except OSError:
            return
        for info in names:
            if not info.endswith(_ENDINGS):
                continue
            self._distributions.add(_normal(_name_and_version(info)[0]))
            for name, value in _entry_points(os.path.join(path, info, "entry_points.txt")):
                if is_package_name(name) and name not in self._packages:
                    folder = _folder_of(value, path, info)
                    self._packages[name] = InstalledPackage(name, value, folder, info)

    def _cached_packages(self) -> dict[str, str]:
        if self._cached is None:
            self._cached = packages_below(self._cache)
        return self._cached


def _subfolders(folder: str) -> list[str]:
    try:
        with os.scandir(folder) as entries:
            return sorted(entry.name for entry in entries if entry.is_dir())
    except OSError:
        return []


def _name_and_version(info: str) -> tuple[str, str]:
    """Return the name and the version in what pip's folder about a Python package is called."""
    name, _, rest = info.rpartition(".")[0].partition("-")
    return name, rest.partition("-py")[0]  # an egg-info has Python's version, too


def _normal(name: str) -> str:
    """Return a name as pip compares it."""
    return name.lower().replace("-", "_").replace(".", "_")


def is_same_name(name: str, other: str) -> bool:
    """Return whether pip takes two names for the same."""
    return _normal(name) == _normal(other)


def _entry_points(path: str) -> Iterator[tuple[str, str]]:
    """Yield name and value of each entry point of the group in an `entry_points.txt`."""
    text = _text_of(path)
    if GROUP not in text:
        return
    is_inside = False
    for line in map(str.strip, text.splitlines()):
        if line.startswith("["):
            is_inside = line[1:].rstrip("]").strip() == GROUP
        elif is_inside and line and line[0] not in "#;":
            name, _, value = line.partition("=")
            yield name.strip(), value.strip()


def _text_of(path: str) -> str:
    try:
        return read_start(path, _MOST_BYTES).decode("utf-8", "replace")
    except (OSError, ValueError):
        return ""


def _folder_of(module: str, path: str, info: str) -> str | None:
    """Return the folder of a module.

    Args:
        module: its name, dotted.
        path: the folder in which the Python package is installed.
        info: what pip's folder about it is called.
    """
    steps = module.split(".")
    if not all(map(str.isidentifier, steps)):
        return None
    own = os.path.join(path, *steps)
    record = _text_of(os.path.join(path, info, "RECORD"))
    files = [row.partition(",")[0].strip('"') for row in record.splitlines()]
    if not any(file.startswith("/".join(steps) + "/") for file in files):
        # It is developed elsewhere; a folder of its name here may be left from before.
        for folder in _editable_folders(steps, path, os.path.join(path, info), files):
            if os.path.isabs(folder) and os.path.isdir(folder):
                return os.path.normpath(folder)
    return own if os.path.isdir(own) else None


def _editable_folders(steps: list[str], path: str, info: str, files: list[str]) -> Iterator[str]:
    """Yield where a module may be of a Python package that is used where it is developed.

    That depends on what installed it: a `.pth` file names the folder that the module is in, a
    finder of setuptools has a table of modules, and pip notes the folder of the project.
    """
    for file in files:
        if file.endswith(".pth") and "/" not in file:
            for line in map(str.strip, _text_of(os.path.join(path, file)).splitlines()):
                if line and not line.startswith(("#", "import ", "import\t")):
                    yield os.path.join(path, line, *steps)
        elif file.startswith("__editable__") and file.endswith("_finder.py"):
            mapping = _mapping_in(_text_of(os.path.join(path, file)))
            for count in range(len(steps), 0, -1):
                start = mapping.get(".".join(steps[:count]))
                if isinstance(start, str):
                    yield os.path.join(start, *steps[count:])
    project = _project_folder(_text_of(os.path.join(info, "direct_url.json")))
    if project is not None:
        yield os.path.join(project, "src", *steps)
        yield os.path.join(project, *steps)


def _mapping_in(text: str) -> dict[object, object]:
    """Return the table of modules and paths in a finder of setuptools, which is not run."""
    from ast import literal_eval

    for line in text.splitlines():
        if line.startswith("MAPPING"):
            try:
                mapping = literal_eval(line.partition("=")[2].strip())
            except (ValueError, SyntaxError, MemoryError, RecursionError):
                continue
            if isinstance(mapping, dict):
                return mapping
    return {}


def _project_folder(text: str) -> str | None:
    """Return the folder of a project that is installed editable, by its `direct_url.json`."""
    import json
    from urllib.parse import urlsplit
    from urllib.request import url2pathname

    try:
        data = json.loads(text or "{}")
        url = urlsplit(data["url"])
        is_editable = data["dir_info"]["editable"] is True
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
    return url2pathname(url.path) if is_editable and url.scheme == "file" else None
