"""The files of an editor: what is open, what is on the disk, which file includes which."""

from __future__ import annotations

import os

from ...files.loader import FileLoader, LoadError
from ...source import Span
from .builds import Result, finder_of
from .positions import UTF_16, offset_at, position_at, range_of
from .settings import Settings
from .texts import YAML_ENDINGS, Text, may_be_of_robots
from .uris import is_file, path_of, uri_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from .wire import Json

MOST_FILES = 2_000
"""Files of a workspace that are looked through for includes."""
MOST_BYTES = 1 << 20
"""The largest file that is looked through."""
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

    def resolve(self, text: Text, path: str) -> str | None:
        """Return the absolute path that a path written in a file means; None if nobody knows."""
        if "$" in path or not path:
            return self._find(text, path)
        resolved = finder_of(self.settings).resolve_uri(path, text.folder)
        return None if resolved is None else os.path.normpath(resolved)

    def _find(self, text: Text, path: str) -> str | None:
        """Resolve `$(find package)/path`, the one computed path that can be read unrun."""
        for form in ("$(find ", "$(find-pkg-share "):
            if path.startswith(form) and ")" in path:
                name, _, rest = path[len(form) :].partition(")")
                folder = finder_of(self.settings).find(name.strip(), text.folder)
                if folder is not None and "$" not in rest:
                    return os.path.normpath(folder + rest)
        return None

    def includes_of(self, text: Text) -> frozenset[str]:
        """Return the files that a file includes, as far as that can be read unrun."""
        if not text.is_yaml:
            from .xml_names import includes_in

            written: Iterable[str] = includes_in(text)
        elif "include" not in text.text and "attach" not in text.text:
            return frozenset()
        else:
            written = [each.path for each in text.names.includes if each.path is not None]
        paths = (self.resolve(text, path) for path in written)
        return frozenset(path for path in paths if path is not None)

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
        return mains or [path]

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


def scan(folders: Sequence[str], settings: Settings) -> dict[str, frozenset[str]]:
    """Return which files the files in some folders include, without running any of them."""
    reader = Workspace()
    reader.settings = settings
    found = {}
    for path in _files_in(folders):
        try:
            data = FileLoader().read(path)
        except LoadError:
            continue
        if b"include" in data or b"attach" in data:
            includes = reader.includes_of(Text(path, data.decode("utf-8", "replace")))
            if includes:
                found[path] = includes
    return found


def _files_in(folders: Sequence[str]) -> Iterator[str]:
    count = 0
    for folder in folders:
        for where, inner, names in os.walk(folder):
            inner[:] = sorted(
                each for each in inner if not each.startswith(".") and each not in _SKIPPED
            )
            for name in sorted(names):
                path = os.path.join(where, name)
                if name.lower().endswith((*YAML_ENDINGS, ".xacro")) and _is_small(path):
                    count += 1
                    if count > MOST_FILES:
                        return
                    yield path


def _is_small(path: str) -> bool:
    try:
        return os.path.getsize(path) <= MOST_BYTES
    except OSError:
        return False


def folders_of(parameters: Json) -> list[str]:
    """Return the folders that an `initialize` request names."""
    folders = parameters.get("workspaceFolders")
    uris = [each["uri"] for each in folders] if folders else [parameters.get("rootUri")]
    return [path_of(uri) for uri in uris if isinstance(uri, str) and is_file(uri)]
