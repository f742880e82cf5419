"""Finds packages and the files that `package://` and other URIs name; needs no ROS.

The order is that of a sourced ROS set-up: the ament index (ROS 2), ROS_PACKAGE_PATH (ROS 1), and
then, so that a checkout works without any set-up, the folders around the file itself. What Python
packages bring comes last.
"""

from __future__ import annotations

import os

from .regular import read_start

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ..source import Span
    from .installed import InstalledPackage, InstalledPackages
    from .readable import Reach

MAX_DEPTH = 8
MAX_FOLDERS = 10_000
MAX_MANIFEST_BYTES = 1 << 20
MOST_PLACES = 8
"""Places that a message names in which a package was looked for."""
IGNORE_MARKERS = frozenset(("AMENT_IGNORE", "CATKIN_IGNORE", "COLCON_IGNORE", "rospack_nosubdirs"))
SKIPPED_FOLDERS = frozenset(("build", "devel", "install", "log", "node_modules", "__pycache__"))
AMENT_INDEX = os.path.join("share", "ament_index", "resource_index", "packages")
MODEL_MANIFEST = "model.config"
"""The file that says that a folder is a model of Gazebo."""
MODEL_PATHS = ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH")


class PackageFinder:
    """Finds packages and remembers what it read; make one for each build.

    Threads may share one: at worst two of them read the same folder.
    """

    __slots__ = (
        "_around",
        "_environ",
        "_found",
        "_given",
        "_has_installed",
        "_home",
        "_installed",
        "_named",
        "_reach",
        "_scans",
    )

    def __init__(
        self,
        environ: Mapping[str, str] | None = None,
        *,
        given: Mapping[str, str] | None = None,
        reach: Reach | None = None,
    ) -> None:
        """Begin without having read anything.

        Args:
            environ: the search paths, instead of those of the process; what Python packages bring
                is not found then.
            given: folders of packages by name, which are not searched for.
            reach: what may be read, to which the folder of each Python package named is added;
                None for everything.
        """
        self._given = {name: os.path.abspath(path) for name, path in (given or {}).items()}
        self._environ = os.environ if environ is None else environ
        self._has_installed = environ is None
        self._installed: InstalledPackages | None = None
        self._reach = reach
        self._named: dict[str, tuple[str, Span | None]] = {}
        self._home = os.path.expanduser("~")  # a jail hides where it is
        self._found: dict[tuple[str, str], str | None] = {}
        self._around: dict[str, tuple[str, str] | None] = {}
        self._scans: dict[tuple[str, int], dict[str, str]] = {}

    def find(self, name: str, start: str, span: Span | None = None) -> str | None:
        """Return the absolute folder of package `name`, or None if it is nowhere.

        Looked at, in this order: the folders given by name, each prefix of AMENT_PREFIX_PATH (its
        share folder counts), each folder of ROS_PACKAGE_PATH, and then the surroundings of `start`:
        the folders it lies in, what is beside the package it belongs to, its repository and
        its workspace. Last come Python packages and the cache of robot_descriptions.

        Args:
            name: the package's name, as in its package.xml.
            start: the folder of the file that asks.
            span: where the name is written, if that is known.
        """
        if name in self._given:
            return self._given[name]
        key = (name, start)
        if key not in self._found:
            self._found[key] = self._find(name, start, span) if is_package_name(name) else None
        return self._found[key]

    def _find(self, name: str, start: str, span: Span | None) -> str | None:
        folder = self._find_sourced(name)
        if folder is None:
            for own in _ancestors(start):
                if manifest_name(own) == name:
                    return own
            for root, depth in surroundings(start):
                if folder := self._packages_below(root, depth).get(name):
                    break
        if folder is None:
            if self._reach is not None:
                return self._reach.package(name)
            installed = self.installed()
            return installed.folder(name) if installed is not None else None
        self._named.setdefault(name, (folder, span))
        return folder

    def _find_sourced(self, name: str) -> str | None:
        """Return the folder of a package that the environment's search paths lead to."""
        for prefix in self._paths("AMENT_PREFIX_PATH"):
            share = os.path.join(prefix, "share", name)
            if os.path.isfile(os.path.join(prefix, AMENT_INDEX, name)) and os.path.isdir(share):
                return share
        for path in self._paths("ROS_PACKAGE_PATH"):
            if folder := self._packages_below(path).get(name):
                return folder
        return None

    def installed(self) -> InstalledPackages | None:
        """Return what finds the packages that Python packages bring, if it is to be asked."""
        if self._installed is None and self._has_installed:
            from .installed import InstalledPackages

            self._installed = InstalledPackages()
        return self._installed

    def clashes(self) -> list[tuple[InstalledPackage, str, Span | None]]:
        """Return the Python packages that were not taken as ROS has a package of their name.

        Each comes with the folder that was taken, and the place where its name is written. A
        Python package with the same name and version as the ROS package is that package.
        """
        installed = self.installed() if self._named else None
        if installed is None:
            return []
        found = []
        for name, (folder, span) in self._named.items():
            other = installed.all().get(name)
            if other is not None and other.folder is not None and not _is_same(other, folder):
                found.append((other, folder, span))
        return found

    def looked_at(self, name: str, start: str) -> list[str]:
        """Return the places `find` looks at for `name`, each as a phrase to show to a person."""
        if not is_package_name(name):
            return []
        places: list[str] = []
        for variable in ("AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH"):
            paths = self._paths(variable)
            places.extend(f"{path} ({variable})" for path in paths)
            if not paths:
                places.append(f"{variable} (not set)")
        places.append(f"{os.path.abspath(start)} and the folders that contain it")
        places.extend(f"{root} and the folders below it" for root, _ in surroundings(start))
        if (installed := self.installed()) is not None:
            places.extend(installed.looked_at())
        return places

    def hint_for(self, name: str, start: str) -> str:
        """Return how to get a package that is not found: what was meant, or where it may be."""
        installed = self.installed()
        if installed is not None and is_package_name(name):
            found = installed.all().get(name)
            if found is not None and found.folder is None:
                return (
                    f"the Python package '{found.distribution}' says that it is the folder of the "
                    f"module '{found.value}', which is not found; if it is installed with "
                    "'pip install -e', install it without -e"
                )
            if installed.has_distribution(name):
                brought = installed.brought_by(name)
                if brought:
                    shown = "', '".join(brought)
                    return f"the Python package '{name}' brings '{shown}'"
                return (
                    f"the Python package '{name}' is installed, but does not say where its robots "
                    "are: it needs an entry point in the group 'yamaro.packages'"
                )
        from ..diagnostics import suggest

        near = suggest(name, self.names(start))
        return f"did you mean '{near}'?" if near else package_hint(name)

    def names(self, start: str) -> list[str]:
        """Return the names of all packages that `find` could find from `start`, sorted."""
        names: set[str] = set(self._given)
        for prefix in self._paths("AMENT_PREFIX_PATH"):
            try:
                names.update(os.listdir(os.path.join(prefix, AMENT_INDEX)))
            except OSError:
                continue
        for path in self._paths("ROS_PACKAGE_PATH"):
            names.update(self._packages_below(path))
        names.update(filter(None, map(manifest_name, _ancestors(start))))
        for root, depth in surroundings(start):
            names.update(self._packages_below(root, depth))
        if (installed := self.installed()) is not None:
            names.update(installed.names())
        return sorted(names)

    def search_paths(self) -> list[str]:
        """Return the folders in which the environment says that packages are."""
        shares = [os.path.join(prefix, "share") for prefix in self._paths("AMENT_PREFIX_PATH")]
        models = [path for variable in MODEL_PATHS for path in self._paths(variable)]
        return [*shares, *self._paths("ROS_PACKAGE_PATH"), *models]

    def around(self, start: str) -> list[str]:
        """Return the folders of the packages that `start` lies in, and of those beside them.

        They are found from then on even if the folder that holds them can no longer be listed.
        """
        folders = [folder for folder in _ancestors(start) if manifest_name(folder)]
        for root, depth in surroundings(start):
            if depth == 1:
                folders += self._packages_below(root, depth).values()
        return folders

    def package_around(self, path: str) -> tuple[str, str] | None:
        """Return name and folder of the package that a file is in, or None if it is in none."""
        folder = os.path.dirname(path)
        if folder not in self._around:
            names = ((manifest_name(each), each) for each in _ancestors(folder))
            found = ((name, each) for name, each in names if name and is_package_name(name))
            self._around[folder] = next(found, None)
        return self._around[folder]

    def resolve_uri(self, uri: str, base_dir: str, span: Span | None = None) -> str | None:
        """Return the absolute path that a mesh, texture or file name means.

        Args:
            uri: `package://name/path`, `model://name/path`, `file:///path`, or a plain path,
                which may start with `~` and is relative to `base_dir`.
            base_dir: the folder of the file in which the name is written.
            span: where it is written, if that is known.

        Returns:
            The path, which may be missing; None for a package or model that is nowhere, and for
            other schemes such as `https://`.
        """
        scheme, separator, rest = uri.partition("://")
        if not separator:
            is_home = uri == "~" or uri.startswith("~/")
            path = self._home + uri[1:] if is_home else os.path.expanduser(uri)
            return _absolute(path, base_dir)
        scheme = scheme.lower()
        if scheme == "file":
            if rest.startswith("localhost/"):  # the authority can only be this machine
                rest = rest[len("localhost") :]
            if os.name == "nt" and rest[:1] == "/" and rest[2:3] == ":":
                rest = rest[1:]
            return _absolute(_unquoted(rest, base_dir), base_dir)
        if scheme not in ("package", "model"):
            return None
        name, _, inner = rest.partition("/")
        folder = self._find_model(name, base_dir) if scheme == "model" else None
        folder = folder or self.find(name, base_dir, span)
        return _absolute(_unquoted(inner, folder), folder) if folder else None

    def _find_model(self, name: str, base_dir: str) -> str | None:
        """Return the folder of a Gazebo model: on a search path, or around or beside a file."""
        if not is_package_name(name):
            return None
        for variable in MODEL_PATHS:
            for path in self._paths(variable):
                folder = os.path.join(path, name)
                if os.path.isdir(folder):
                    return folder
        for around in _ancestors(base_dir):
            if os.path.basename(around) == name:
                return around
            folder = os.path.join(around, name)
            if os.path.isfile(os.path.join(folder, MODEL_MANIFEST)):
                return folder
        return None

    def _paths(self, variable: str) -> list[str]:
        """Return the folders a search path names, absolute and each once."""
        parts = self._environ.get(variable, "").split(os.pathsep)
        return list(dict.fromkeys(os.path.abspath(part) for part in parts if part))

    def _packages_below(self, root: str, depth: int = MAX_DEPTH) -> dict[str, str]:
        packages = self._scans.get((root, depth))
        if packages is None:
            packages = self._scans[root, depth] = packages_below(root, depth)
        return packages


def packages_below(root: str, depth: int = MAX_DEPTH) -> dict[str, str]:
    """Return name and folder of each package in `root` or below; the first of a name wins."""
    packages: dict[str, str] = {}
    for folder in package_folders(root, depth):
        name = manifest_name(folder)
        if name:
            packages.setdefault(name, folder)
    return packages


def is_package_name(name: str) -> bool:
    """Return whether a package may have the name (REP 149, and what older packages use)."""
    return name.isascii() and name.replace("_", "a").replace("-", "a").isalnum()


def package_hint(package: str) -> str:
    """Return how to say where a package is that is not found."""
    return (
        "source its ROS workspace, install its Python package with pip, or set its folder: "
        f"--package {package}:=FOLDER"
    )


def _is_same(installed: InstalledPackage, folder: str) -> bool:
    """Return whether a Python package is the ROS package in a folder."""
    from .installed import is_same_name

    inner = os.path.realpath(installed.folder or "")
    if inner.startswith(os.path.realpath(folder).rstrip(os.sep) + os.sep):
        return True  # a checkout that pip has installed as editable
    return is_same_name(installed.distribution, manifest_name(folder) or "") and (
        installed.version == manifest_text(folder, "version")
    )


def manifest_name(folder: str) -> str | None:
    """Return the name that the folder's package.xml gives, or None if there is none to read."""
    return manifest_text(folder, "name")


def manifest_text(folder: str, tag: str) -> str | None:
    """Return the text of the first element of a name in the folder's package.xml, or None."""
    try:
        data = read_start(os.path.join(folder, "package.xml"), MAX_MANIFEST_BYTES)
    except OSError:
        return None
    text = _without_comments(data.decode("utf-8", "replace"))
    tag = f"<{tag}"
    start, length = text.find(tag), len(tag)
    while start >= 0 and text[start + length : start + length + 1] not in tuple("> \t\r\n"):
        start = text.find(tag, start + length)
    if start < 0:
        return None
    content, end, _ = text[start:].partition(">")[2].partition("<")
    return content.strip() or None if end else None


def _without_comments(text: str) -> str:
    pieces = []
    end = 0
    while (start := text.find("<!--", end)) >= 0:
        pieces.append(text[end:start])
        end = text.find("-->", start + 4) + 3
        if end < 3:  # it has no end
            return "".join(pieces)
    return "".join([*pieces, text[end:]])


def _ancestors(start: str) -> Iterator[str]:
    """Yield `start` and the folders that contain it, innermost first."""
    folder = os.path.abspath(start)
    while True:
        yield folder
        outer = os.path.dirname(folder)
        if outer == folder:
            return
        folder = outer


def surroundings(start: str) -> list[tuple[str, int]]:
    """Return the folders to search for packages near `start`, and how deep to look, nearest first.

    These are the folder that holds the package of `start`, for what stands directly in it, the
    root of its repository, and the `src` folder of its workspace. A bare folder with none of these
    has no surroundings, so a file in a home folder sets off no search of all that lies there.
    """
    depths: dict[str, int] = {}
    has_package = has_repository = has_workspace = False
    for folder in _ancestors(start):
        if not has_package and os.path.isfile(os.path.join(folder, "package.xml")):
            has_package = True
            depths.setdefault(os.path.dirname(folder), 1)
        if not has_repository and os.path.exists(os.path.join(folder, ".git")):
            has_repository = True
            depths[folder] = MAX_DEPTH
        if not has_workspace and os.path.basename(folder) == "src":
            has_workspace = True
            depths[folder] = MAX_DEPTH
    return sorted(depths.items(), key=lambda item: len(item[0]), reverse=True)


def package_folders(root: str, max_depth: int = MAX_DEPTH) -> Iterator[str]:
    """Yield the folders in `root` or below that hold a package.xml, in the order of their names.

    Like ROS's own tools this does not look inside packages or at folders marked to be ignored;
    depth and number of folders are bounded.
    """
    stack = [(root, 0)]
    links: set[str] = set()
    count = 0
    while stack and count < MAX_FOLDERS:
        folder, depth = stack.pop()
        count += 1
        try:
            with os.scandir(folder) as entries:
                found = {entry.name: entry for entry in entries}
        except OSError:
            continue
        if not IGNORE_MARKERS.isdisjoint(found):
            continue
        if "package.xml" in found:
            yield folder
            continue
        if depth < max_depth:
            # In order from the start: of two links to one folder the first is looked at.
            below = [e for _, e in sorted(found.items()) if _is_searched(e, links)]
            stack.extend((entry.path, depth + 1) for entry in reversed(below))


def _is_searched(entry: os.DirEntry[str], links: set[str]) -> bool:
    """Return whether to look below an entry; a linked folder is looked at once."""
    if entry.name.startswith(".") or entry.name in SKIPPED_FOLDERS:
        return False
    try:
        if not entry.is_dir():
            return False
        if entry.is_symlink():
            target = os.path.realpath(entry.path)
            if target in links:
                return False
            links.add(target)
    except OSError:
        return False
    return True


def _absolute(path: str, base_dir: str) -> str:
    return os.path.abspath(os.path.join(base_dir, path))


def _unquoted(path: str, base_dir: str) -> str:
    """Return the path with escapes such as `%20` decoded, unless it exists as it is written."""
    if "%" not in path or os.path.exists(os.path.join(base_dir, path)):
        return path
    from urllib.parse import unquote

    return unquote(path)
