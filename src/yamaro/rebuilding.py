"""Builds a robot again and again, as its files change, and reports each result.

Changes are noticed by looking at the files. That works wherever files can be read: in containers,
on network drives, and with editors that put a new file in the place of the old one, all of which
leave gaps in what systems report. A look at some dozen files takes a fraction of
a millisecond.
"""

from __future__ import annotations

import os
import time

from .diagnostics import ERROR, Diagnostic, YamaroError
from .options import UsageError
from .program import Program

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from .options import Options
    from .result import Build
    from .source import Reading

    Stamp = tuple[int, int, int] | None

INTERVAL = 0.03
"""Seconds between two looks."""
SETTLING = 0.01
"""Seconds in which a changed file has to stay as it is before it is taken for written."""
MOST_SETTLING = 20
"""How many times to wait for that: a file that is written without end is read as it is."""
MOST_SURROUNDINGS = 500
"""Files and folders to look at around one that could not be built."""
SOURCE_ENDINGS = (".yaml", ".yml", ".urdf", ".xacro", ".xml", ".py", ".json", ".csv")


class FileWatch:
    """A set of files, and how each was when it was last looked at."""

    __slots__ = ("_stamps",)

    def __init__(self) -> None:
        """Begin without files."""
        self._stamps: dict[str, Stamp] = {}

    @property
    def paths(self) -> list[str]:
        """Return the files that are looked at."""
        return list(self._stamps)

    def follow(self, paths: Iterable[str], *, since: int) -> None:
        """Look at these files and no others from now on.

        Args:
            paths: absolute; those that are not there are waited for.
            since: when the work with the files was begun, in ns since the epoch. A file that is new
                here and was changed after that counts as changed: nobody knows which text was read.
        """
        stamps: dict[str, Stamp] = {}
        for path in paths:
            if path in self._stamps:
                stamps[path] = self._stamps[path]
                continue
            stamp = _stamp(path)
            is_older = stamp is None or stamp[0] < since
            stamps[path] = stamp if is_older else (0, 0, 0)
        self._stamps = stamps

    def changed(self) -> list[str]:
        """Return the files that are not as they were at the last look, once they hold still."""
        found = self._look()
        if found:
            for _ in range(MOST_SETTLING):
                time.sleep(SETTLING)
                more = self._look()
                if not more:
                    break
                found += more
        return list(dict.fromkeys(found))

    def _look(self) -> list[str]:
        found = []
        for path, before in self._stamps.items():
            now = _stamp(path)
            if now != before:
                self._stamps[path] = now
                found.append(path)
        return found


def surroundings(path: str) -> list[str]:
    """Return the folders around a main file, and the sources in them.

    When a build fails, nobody knows which file it wanted: one that is missing may appear in any of
    the folders, and the fault may be in a module that was never listed as read.
    """
    found: list[str] = []
    pending = [os.path.dirname(path)]
    while pending and len(found) < MOST_SURROUNDINGS:
        folder = pending.pop(0)
        found.append(folder)
        try:
            with os.scandir(folder) as entries:
                inner = sorted(entries, key=lambda entry: entry.name)
        except OSError:
            continue
        for entry in inner:
            if entry.name.startswith("."):
                continue
            if entry.name.endswith(SOURCE_ENDINGS):
                found.append(entry.path)
            elif _is_folder(entry):
                pending.append(entry.path)
    return found[:MOST_SURROUNDINGS]


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir(follow_symlinks=False)
    except OSError:
        return False


def _stamp(path: str) -> Stamp:
    """Return what changes when a file does: time, size, and which file it is."""
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino


# --- builds -----------------------------------------------------------------------------------


class Turn:
    """The result of one build.

    Attributes:
        build: the finished robot, or None.
        diagnostics: errors and warnings, in order.
        fault: why there is no build, where that is at no place of a file.
        seconds: how long it took.
    """

    __slots__ = ("build", "diagnostics", "fault", "seconds")

    def __init__(
        self,
        build: Build | None,
        diagnostics: Sequence[Diagnostic],
        *,
        fault: str = "",
        seconds: float = 0.0,
    ) -> None:
        self.build = build
        self.diagnostics = list(diagnostics)
        self.fault = fault
        self.seconds = seconds

    def is_told_as(self, other: Turn | None) -> bool:
        """Return whether two builds have the same report."""
        return (
            other is not None
            and self.fault == other.fault
            and list(map(_told, self.diagnostics)) == list(map(_told, other.diagnostics))
        )

    def fails_as(self, other: Turn | None) -> bool:
        """Return whether two builds failed in the same way."""
        is_failure = self.build is None and other is not None and other.build is None
        return is_failure and self.is_told_as(other)


class Rebuilder:
    """A robot whose files are watched.

    Attributes:
        path: the main file.
        options: those of its builds.
        has_root: whether builds have their tree, also those that leave a jail.
    """

    def __init__(self, path: str, options: Options) -> None:
        """Name the main file."""
        self.path = path
        self.options = options
        self.has_root = False
        self._program: Program | None = None
        self._watch = FileWatch()
        self._last: Turn | None = None

    def build(self, variables: Mapping[str, object] | None = None) -> Turn:
        """Build with these variables, and watch what took part from now on.

        Raises:
            UsageError: it is the first build, and the main file cannot be read, or a `name:=value`
                is malformed. Later on a file that is gone may well come back.
        """
        since = time.time_ns()
        start = time.perf_counter()
        try:
            build = self._current().build(variables=variables or {}, has_root=self.has_root)
            turn = Turn(build, build.warnings)
        except YamaroError as error:
            turn = Turn(None, error.diagnostics)
        except UsageError as error:
            if self._last is None:
                raise
            turn = Turn(None, [], fault=str(error))
        turn.seconds = time.perf_counter() - start
        # What changes calls for another build, also where one of these cannot be read.
        named = [each for each in self.options.overlay if isinstance(each, str)]
        paths = [os.path.abspath(each) for each in (self.path, *named)]
        if turn.build is not None:
            paths += [*turn.build.files, *turn.build.meshes]
        else:
            told = [path for diagnostic in turn.diagnostics for path in _files_of(diagnostic)]
            paths += [*self._watch.paths, *told, *surroundings(paths[0])]
        self._watch.follow(list(dict.fromkeys(paths)), since=since)
        self._last = turn
        return turn

    def build_as(self, format: str | None, variables: Mapping[str, object]) -> Build:
        """Return the robot in an output format, as for a folder beside the main file.

        Without a format it is the document that the file describes, whatever its root.

        What the file prints is left out: it was printed when the robot was built.

        Raises:
            YamaroError: the robot has errors, or the format cannot hold it.
            UsageError: the main file cannot be read.
        """
        return self._current().build(
            variables=variables,
            advice=False,
            on_message=_drop,
            has_root=False,
            output=os.path.join(os.path.dirname(os.path.abspath(self.path)), ""),
            meshes="copy",
            target=None if format is None else [format],
        )

    def noted(self, variables: Mapping[str, object]) -> Sequence[Reading]:
        """Return the values that names have where they are declared, in a build that notes them.

        Raises:
            YamaroError: the robot has errors.
            UsageError: the main file cannot be read.
        """
        build = self._current().build(
            variables=variables,
            strict=False,
            advice=False,
            on_message=_drop,
            has_root=False,
            records=True,
        )
        return build.noted

    def _current(self) -> Program:
        """Return the program of the files as they were read last, or are now."""
        program = self._program or Program(self.path, self.options)
        self._program = program  # another thread may want it forgotten meanwhile
        return program

    def has_changed(self) -> bool:
        """Return whether a file has changed since the last build; the next one reads all again."""
        if not self._watch.changed():
            return False
        self._program = None
        return True

    def also_watch(self, paths: Sequence[str]) -> None:
        """Watch further files, such as meshes that are not there."""
        self._watch.follow(dict.fromkeys([*self._watch.paths, *paths]), since=time.time_ns())

    def forget(self) -> None:
        """Have the next build read all files again."""
        self._program = None

    def wait(self) -> None:
        """Return when a file has changed."""
        while not self.has_changed():
            time.sleep(INTERVAL)


def _drop(message: str) -> None:
    """Take what the file prints."""


def _files_of(diagnostic: Diagnostic) -> list[str]:
    """Return the files that a diagnostic leads through."""
    files = [diagnostic.span.source.path]
    frame = diagnostic.trace
    while frame is not None:
        files.append(frame.span.source.path)
        frame = frame.parent
    return [path for path in files if path]


def _told(diagnostic: Diagnostic) -> tuple[str, str, object]:
    return diagnostic.code, diagnostic.message, diagnostic.span.key()


def count_told(diagnostics: Sequence[Diagnostic]) -> str:
    """Return how many errors and warnings there are, as in "1 error, 2 warnings"."""
    errors = sum(one.severity == ERROR for one in diagnostics)
    counts = [(errors, "error"), (len(diagnostics) - errors, "warning")]
    return ", ".join(f"{count} {word}{'s' if count > 1 else ''}" for count, word in counts if count)
