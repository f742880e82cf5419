"""The files of an editor: settings, texts that are open, files on the disk, includes."""

from __future__ import annotations

import math
import os
import re
import time
from glob import escape, iglob
from itertools import islice, takewhile

from ...diagnostics import Reporter, YamaroError
from ...files.loader import FileLoader, LoadError
from ...files.packages import PackageFinder, manifest_name, package_folders
from ...policy import SAFE, Limits, Policy
from ...sandbox.deep_stack import run_on_deep_stack
from ...source import Source, Span, holds_xml
from .protocol import UTF_16, is_file, offset_at, path_of, position_at, range_of, uri_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from ...diagnostics import Diagnostic
    from ...syntax.nodes import Parsed
    from ...syntax.symbol_table import SymbolTable
    from ...xml.recovery import Tags
    from ...xml.tree import Element
    from ...yaml.nodes import YamlNode
    from .builds import Result
    from .parts import Parts
    from .protocol import Json
    from .robot_xml import RobotNames


# --- texts ------------------------------------------------------------------------------------


YAML_ENDINGS = (".yaml", ".yml")
XML_ENDINGS = (".xacro", ".urdf", ".xml", ".sdf", ".mjcf", ".world")
_BEGINS_ROBOT = re.compile(
    r"\s*(?:<\?.*?\?>\s*|<!--.*?-->\s*|<!(?!--)[^>]*>\s*)*"
    r"<(?:robot|mujoco|mujocoinclude|sdf|gazebo)[\s>]",
    re.DOTALL,
)


class Text:
    """The text of a file at one moment.

    Attributes:
        path: where the file is, absolute.
        source: the text; `is_xml` says whether it is URDF or xacro.
    """

    __slots__ = ("_parsed", "_parts", "_robot_names", "_root", "_tags", "_xml", "path", "source")

    def __init__(self, path: str, text: str) -> None:
        """Take a text for the content of a file."""
        self.path = path
        self.source = Source(text.removeprefix("\ufeff"), name=path, path=path)
        self.source.is_xml = holds_xml(path, text)
        self._parsed: Parsed | None = None
        self._root: YamlNode | None = None
        self._parts: Parts | None = None
        self._xml: tuple[Element | None, list[Diagnostic]] | None = None
        self._tags: Tags | None = None
        self._robot_names: RobotNames | None = None

    @property
    def text(self) -> str:
        """Return the text itself, without a byte order mark."""
        return self.source.text

    @property
    def folder(self) -> str:
        """Return the folder in which relative paths start."""
        return os.path.dirname(self.path)

    @property
    def is_yaml(self) -> bool:
        """Return whether it is a file of the language, and no XML."""
        return not self.source.is_xml

    @property
    def is_foreign(self) -> bool:
        """Return whether it is XML that is not about robots, such as a package.xml."""
        return self.path.lower().endswith(".xml") and not (
            _BEGINS_ROBOT.match(self.text) or "<xacro:" in self.text
        )

    @property
    def parsed(self) -> Parsed:
        """Return the syntax tree; for files that are not XML."""
        if self._parsed is None:
            run_on_deep_stack(self._parse)
        assert self._parsed is not None
        return self._parsed

    @property
    def root(self) -> YamlNode | None:
        """Return the YAML nodes that could be read; for files that are not XML."""
        if self._parsed is None:
            run_on_deep_stack(self._parse)
        return self._root

    def _parse(self) -> None:
        from ...syntax.parser import parse_reading
        from ...yaml.reader import read_on

        reporter = Reporter()
        reading = read_on(self.source, reporter=reporter)
        self._root = reading.root
        self._parsed = parse_reading(self.source, reading, reporter=reporter)

    @property
    def names(self) -> SymbolTable:
        """Return the names that the file declares and uses."""
        return self.parsed.document.symbols

    @property
    def parts(self) -> Parts:
        """Return the parts that the file names, and the places that refer to them."""
        if self._parts is None:
            from .parts import Parts

            root = self.root
            self._parts = run_on_deep_stack(lambda: Parts(root))
        return self._parts

    def comment_on(self, span: Span) -> str:
        """Return the comment on a declaration, as text, or "".

        It is in the lines right above, else at the end of the line, else in the lines right
        below, as in the body of a function.
        """
        comments = {each.location()[0]: each for each in self.parsed.comments}
        line, _ = span.location()
        above = line
        while above - 1 in comments and comments[above - 1].has_line:
            above -= 1
        if above < line:
            found = range(above, line)
        elif line in comments:
            found = range(line, line + 1)
        else:
            below = line + 1
            while below in comments and comments[below].has_line:
                below += 1
            found = range(line + 1, below)
        return "\n".join(comments[each].text.lstrip("# ") for each in found)

    @property
    def xml(self) -> Element | None:
        """Return the root element of a file that holds XML, as far as it can be read, or None."""
        return self._read_xml()[0]

    @property
    def tags(self) -> Tags:
        """Return the tags of a file that holds XML, well-formed or not."""
        if self._tags is None:
            from ...xml.recovery import Tags

            self._tags = Tags(self.text)
        return self._tags

    @property
    def robot_names(self) -> RobotNames:
        """Return the names in a URDF or xacro file."""
        if self._robot_names is None:
            from .robot_xml import RobotNames

            root = None if self.is_foreign else self.xml
            self._robot_names = run_on_deep_stack(lambda: RobotNames(root))
        return self._robot_names

    @property
    def findings(self) -> list[Diagnostic]:
        """Return what is to be said of the file unrun."""
        if self.is_yaml:
            return self.parsed.diagnostics
        return [] if self.is_foreign else self._read_xml()[1]

    def _read_xml(self) -> tuple[Element | None, list[Diagnostic]]:
        if self._xml is None:
            self._xml = run_on_deep_stack(self._parse_xml)
        return self._xml

    def _parse_xml(self) -> tuple[Element | None, list[Diagnostic]]:
        from ...xml.reader import read_xml

        try:
            return read_xml(self.source, Limits()).root, []
        except YamaroError as error:
            from ...xml.recovery import read_broken

            return read_broken(self.source, self.tags), error.diagnostics


def may_be_of_robots(path: str) -> bool:
    """Return whether a file has an ending that the server reads."""
    return path.lower().endswith((*YAML_ENDINGS, *XML_ENDINGS))


# --- settings ---------------------------------------------------------------------------------


PAUSE = 0.15
"""Seconds without an edit after which a file is built."""
SECONDS = 2.0
"""The time that a build may take."""
LONGEST = 3600.0


class Settings:
    """What a user has set.

    Attributes:
        may_jail: whether code that safe mode refuses is run in a jail.
        pause: seconds to wait for another edit before a build.
        timeout: seconds that a build may take.
        has_hints: whether to show inlay hints.
        packages: folders of ROS packages by their names.
        found: those of packages in the open folders, except for names that several have.
        arguments: for names of files, what is passed to them: `name:=value`.
    """

    __slots__ = ("arguments", "found", "has_hints", "may_jail", "packages", "pause", "timeout")

    def __init__(self, options: Json = None) -> None:
        """Read the `initializationOptions`; what makes no sense keeps its default."""
        options = options if isinstance(options, dict) else {}
        self.may_jail = options.get("trust") == "jail"
        self.pause = _seconds(options.get("pause"), PAUSE)
        self.timeout = max(_seconds(options.get("timeout"), SECONDS), 0.01)
        self.has_hints = options.get("inlayHints") is True
        packages = options.get("packages")
        self.packages = {
            str(name): os.path.expanduser(folder)
            for name, folder in (packages.items() if isinstance(packages, dict) else ())
            if isinstance(folder, str)
        }
        self.found: dict[str, str] = {}
        arguments = options.get("arguments")
        self.arguments = {
            str(name): [text for text in texts if isinstance(text, str)]
            for name, texts in (arguments.items() if isinstance(arguments, dict) else ())
            if isinstance(texts, list)
        }

    def policy(self, is_abandoned: Callable[[], bool]) -> Policy:
        """Return the policy for a build that is given up as soon as `is_abandoned` says so."""
        if not self.may_jail:
            policy = Policy(SAFE, timeout=self.timeout)
        else:
            policy = Policy.looking(timeout=self.timeout)
            assert policy.fallback is not None
            policy.fallback.is_abandoned = is_abandoned
        policy.is_abandoned = is_abandoned
        return policy

    @property
    def all_packages(self) -> dict[str, str]:
        """Return the folders of packages by name: those that are set come first."""
        return {**self.found, **self.packages}

    def arguments_of(self, path: str) -> list[str]:
        """Return what is passed to a main file."""
        for name, texts in self.arguments.items():
            if path == name or path.endswith(os.sep + name.replace("/", os.sep)):
                return texts
        return []


def _seconds(value: Json, default: float) -> float:
    """Return a number of milliseconds in seconds, or the default, which is in seconds."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return default
    return min(value / 1000, LONGEST) if math.isfinite(value) and value >= 0 else default


# --- workspace --------------------------------------------------------------------------------


MOST_FILES = 2_000
"""Files of a workspace that are looked through for includes."""
MOST_BYTES = 1 << 20
"""The largest file that is looked through."""
MOST_MAINS = 5
"""Main files of one XML file that are built."""
MOST_MATCHES = 50
"""Files that a path may mean of which parts are computed."""
MANIFEST = "package.xml"
"""The file that makes a folder a ROS package."""
FINDER_SECONDS = 2.0
"""How long it holds where a package is."""
_COMPUTED = re.compile(r"\$\([^)]*\)|\$\{[^}]*\}")
_MAGIC = re.compile(r"[*?\[]")
_SKIPPED = ("node_modules", "build", "install", "log", "dist", "__pycache__")


class OpenFile:
    """A file that is open in the editor."""

    __slots__ = ("text", "uri", "version")

    def __init__(self, uri: str, version: int | None, text: Text) -> None:
        self.uri = uri
        self.version = version
        self.text = text


class Workspace:
    """All that the features ask.

    Attributes:
        encoding: in which columns are counted.
        settings: those of the user.
        folders: the folders that are open.
        open: the files that are open, by path.
        results: the last result of each main file that was built.
        good: the last of each that has a tree.
        client: what the editor says that it can do.
    """

    def __init__(self) -> None:
        """Begin with nothing open."""
        self.encoding = UTF_16
        self.settings = Settings()
        self.folders: list[str] = []
        self.open: dict[str, OpenFile] = {}
        self.results: dict[str, Result] = {}
        self.good: dict[str, Result] = {}
        self.client: Json = {}
        self._closed: dict[str, tuple[tuple[int, int], Text]] = {}
        self._includes: dict[str, frozenset[str]] = {}  # as far as they can be read unrun
        self._finder: PackageFinder | None = None
        self._finder_until = 0.0

    # --- texts ------------------------------------------------------------------------------

    def change(self, uri: str, version: int | None, changes: Sequence[Json]) -> OpenFile:
        """Apply edits of the editor; an edit without a range replaces the whole text.

        Raises:
            KeyError, TypeError: the file is not open, or an edit has not the form of one.
        """
        opened = self.open[path_of(uri)]
        for change in changes:
            text = opened.text
            place = change.get("range")
            if place is None:
                new = change["text"]
            else:
                start = offset_at(text.source, place["start"], self.encoding)
                end = max(start, offset_at(text.source, place["end"], self.encoding))
                new = text.text[:start] + change["text"] + text.text[end:]
            opened.text = Text(text.path, new)
        opened.version = version
        return opened

    def add(self, uri: str, version: int | None, text: str) -> OpenFile:
        """Open a file."""
        path = path_of(uri)
        opened = self.open[path] = OpenFile(uri, version, Text(path, text))
        return opened

    def text_of(self, path: str) -> Text | None:
        """Return the text of a file, open or on the disk, or None if it cannot be read."""
        opened = self.open.get(path)
        if opened is not None:
            return opened.text
        try:
            state = os.stat(path)
            stamp = (state.st_mtime_ns, state.st_size)
            known = self._closed.get(path)
            if known is not None and known[0] == stamp:
                return known[1]
            data = FileLoader().read(path)
        except (OSError, ValueError, LoadError):
            return None
        text = Text(path, data.decode("utf-8", "replace"))
        self._closed[path] = (stamp, text)
        return text

    def text_at(self, parameters: Json) -> Text:
        """Return the text that a request is about; raise KeyError if there is none."""
        path = path_of(parameters["textDocument"]["uri"])
        text = self.text_of(path)
        if text is None:
            raise KeyError(path)
        return text

    def offset_in(self, text: Text, parameters: Json) -> int:
        """Return the offset that a request is about."""
        return offset_at(text.source, parameters["position"], self.encoding)

    # --- places -----------------------------------------------------------------------------

    def uri(self, path: str) -> str:
        """Return the URI of a file, in the spelling of the editor if it is open."""
        opened = self.open.get(path)
        return opened.uri if opened is not None else uri_of(path)

    def range(self, span: Span) -> Json:
        """Return the range of a span."""
        return range_of(span.source, span.start, span.end, self.encoding)

    def position(self, text: Text, offset: int) -> Json:
        """Return the position of an offset."""
        return position_at(text.source, offset, self.encoding)

    def location(self, span: Span) -> Json:
        """Return the file and the range of a span."""
        return {"uri": self.uri(span.source.path), "range": self.range(span)}

    # --- programs ---------------------------------------------------------------------------

    @property
    def finder(self) -> PackageFinder:
        """Return what finds packages; what it has found holds for a moment."""
        now = time.monotonic()
        if self._finder is None or now > self._finder_until:
            self._finder = finder_of(self.settings)
            self._finder_until = now + FINDER_SECONDS
        return self._finder

    def forget_packages(self) -> None:
        """Forget where packages were found, as there are others now."""
        self._finder = None

    def package(self, name: str, folder: str) -> str | None:
        """Return the folder of a package that a file in some folder names, or None."""
        return self.finder.find(name, folder)

    def resolve_all(self, text: Text, path: str) -> list[str]:
        """Return the absolute paths that a path in a file may mean, if parts of it are computed."""
        resolved = self.resolve(text, path)
        if resolved is not None and not _MAGIC.search(path):
            return [resolved]
        if text.is_yaml:
            return []
        found = re.match(r"\$\(find\s+([^()\s]+)\s*\)", path)
        folder = text.folder if found is None else self.package(found[1], text.folder)
        rest = path if found is None else path[found.end() :].lstrip("/")
        pattern = _COMPUTED.sub("*", rest)
        if folder is None or not pattern.strip("*/.") or os.path.isabs(pattern):
            return []
        paths = islice(iglob(os.path.join(escape(folder), pattern)), MOST_MATCHES)
        return [os.path.normpath(each) for each in paths]

    def resolve(self, text: Text, path: str) -> str | None:
        """Return the absolute path that a path written in a file means; None if nobody knows."""
        if "$" in path or not path:
            # `$(find package)/path` is the one computed path that can be read unrun.
            for form in ("$(find ", "$(find-pkg-share "):
                if path.startswith(form) and ")" in path:
                    name, _, rest = path[len(form) :].partition(")")
                    folder = self.package(name.strip(), text.folder)
                    if folder is not None and "$" not in rest:
                        return os.path.normpath(folder + rest)
            return None
        resolved = self.finder.resolve_uri(path, text.folder)
        if resolved is None:
            return None
        if text.path.lower().endswith((".sdf", ".world")) and os.path.isdir(resolved):
            resolved = os.path.join(resolved, "model.sdf")  # as Gazebo names a model by its folder
        return os.path.normpath(resolved)

    def includes_of(self, text: Text) -> frozenset[str]:
        """Return the files that a file includes, as far as that can be read unrun."""
        if not text.is_yaml:
            from .xml_names import includes_in

            written: Iterable[str] = includes_in(text)
        elif "include" not in text.text and "attach" not in text.text:
            return frozenset()
        else:
            written = [each.path for each in text.names.includes if each.path is not None]
        return frozenset(found for path in written for found in self.resolve_all(text, path))

    def note_includes(self, path: str, includes: frozenset[str]) -> bool:
        """Note which files a file includes; return whether that is news."""
        if self._includes.get(path, frozenset()) == includes:
            return False
        self._includes[path] = includes
        return True

    def mains_of(self, path: str) -> list[str]:
        """Return the main files of the programs that a file is in: itself if none includes it."""
        above: dict[str, None] = {path: None}
        pending = [path]
        mains = []
        while pending:
            own = pending.pop()
            includers = [each for each, files in self._includes.items() if own in files]
            includers += [
                main for main, result in self.results.items() if own in result.files and main != own
            ]
            includers = [each for each in includers if each != own]
            if not includers:
                mains.append(own)
            for each in includers:
                if each not in above:
                    above[each] = None
                    pending.append(each)
        if len(mains) > 1 or mains != [path]:
            mains = self._wanted_mains(path, mains)
        return mains or [path]

    def _wanted_mains(self, path: str, mains: list[str]) -> list[str]:
        """Return some main files without those that do not read an XML file after all."""
        if not path.lower().endswith(XML_ENDINGS):
            return mains
        kept = []
        for main in mains:
            result = self.results.get(main)
            if result is None or result.root is None or path in (main, *result.files):
                kept.append(main)
        if len(kept) > MOST_MAINS:  # a file that all robots of a package share
            own = os.path.dirname(path)
            kept.sort(
                key=lambda each: (
                    each not in self.open,
                    each not in self.results,
                    _distance(own, os.path.dirname(each)),
                    each,
                )
            )
        return kept[:MOST_MAINS]

    def program_of(self, path: str) -> list[Text]:
        """Return all files of the programs that a file is in, the file itself first."""
        paths: dict[str, None] = {path: None}
        pending = [path, *self.mains_of(path)]
        seen: set[str] = set()
        while pending:
            own = pending.pop()
            if own in seen:
                continue
            seen.add(own)
            paths.setdefault(own)
            text = self.text_of(own)
            if text is not None:
                self.note_includes(own, self.includes_of(text))
                pending.extend(self._includes.get(own, ()))
            if own in self.results:
                pending.extend(each for each in self.results[own].files if may_be_of_robots(each))
        return [text for each in paths if (text := self.text_of(each)) is not None]

    def results_of(self, path: str) -> list[Result]:
        """Return the last good results of the programs that a file is in."""
        return [self.good[main] for main in self.mains_of(path) if main in self.good]

    def texts(self) -> dict[str, str]:
        """Return the texts of all open files by their paths."""
        return {path: opened.text.text for path, opened in self.open.items()}


def _distance(one: str, other: str) -> int:
    """Return how many folders are between two folders."""
    steps, others = one.split(os.sep), other.split(os.sep)
    pairs = zip(steps, others, strict=False)
    common = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    return len(steps) + len(others) - 2 * common


def scan(folders: Sequence[str], settings: Settings) -> dict[str, frozenset[str]]:
    """Return which files the files in some folders include, without running any of them.

    The packages in the folders are found first, and noted in the settings.
    """
    settings.found = packages_in(folders)
    reader = Workspace()
    reader.settings = settings
    found = {}
    for path in _files_in(folders):
        try:
            data = FileLoader().read(path)
        except LoadError:
            continue
        is_xml = path.lower().endswith(XML_ENDINGS[1:])
        if is_xml and not any(sign in data for sign in (b"<mujoco", b"<sdf", b"<xacro:include")):
            continue
        if b"include" in data or b"attach" in data or b"<model" in data:
            includes = reader.includes_of(Text(path, data.decode("utf-8", "replace")))
            if includes:
                found[path] = includes
    return found


def packages_in(folders: Sequence[str]) -> dict[str, str]:
    """Return the packages in some folders, except for names that several have."""
    found: dict[str, str] = {}
    several = set()
    for folder in folders:
        for own in package_folders(folder):
            name = manifest_name(own)
            if name is not None and found.setdefault(name, own) != own:
                several.add(name)
    return {name: own for name, own in found.items() if name not in several}


def _files_in(folders: Sequence[str]) -> Iterator[str]:
    count = 0
    for folder in folders:
        for where, inner, names in os.walk(folder):
            inner[:] = sorted(
                each for each in inner if not each.startswith(".") and each not in _SKIPPED
            )
            for name in sorted(names):
                path = os.path.join(where, name)
                if name.lower().endswith((*YAML_ENDINGS, *XML_ENDINGS)):
                    try:
                        if os.path.getsize(path) > MOST_BYTES:
                            continue
                    except OSError:
                        continue
                    count += 1
                    if count > MOST_FILES:
                        return
                    yield path


def folders_of(parameters: Json) -> list[str]:
    """Return the folders that an `initialize` request names."""
    folders = parameters.get("workspaceFolders")
    uris = [each["uri"] for each in folders] if folders else [parameters.get("rootUri")]
    return [path_of(uri) for uri in uris if isinstance(uri, str) and is_file(uri)]


def finder_of(settings: Settings) -> PackageFinder:
    """Return what finds packages."""
    return PackageFinder(given=settings.all_packages)
