"""The state of the page: the last build, values of variables, errors, downloads."""

from __future__ import annotations

import io
import json
import os
import secrets
import threading
import zipfile
from collections.abc import Mapping
from io import BufferedReader

from ...allowances import set_aside
from ...confined import FaultInJail, Reader
from ...diagnostics import ERROR, YamaroError
from ...files.loader import FileLoader, LoadError, decode
from ...files.regular import MADE, open_regular
from ...options import UsageError
from ...rebuilding import Rebuilder, Turn
from ...request import finder_for, reach_of, read_command_line
from ...result import Build
from ...source import Source, holds_xml
from ...targets.losses import diagnostics_of
from ...targets.output import marked
from ...targets.table import TARGETS
from .description import Description, Places, diagnostic_data, fault_data
from .mesh_files import Library, MeshFiles
from .variables import (
    IncludedVariables,
    VariableField,
    WrongValue,
    has_others,
    read_variable_fields,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .variables import Value

    Json = dict[str, object]


# --- downloads --------------------------------------------------------------------------------


FORMATS = tuple(each.name for each in TARGETS.values() if not each.is_folder)
"""The output formats that the page offers."""
_DATE = (1980, 1, 1, 0, 0, 0)
"""Of all files in an archive, so that the same robot gives the same bytes."""
_MODE = 0o644 << 16


class Downloads:
    """Writes a robot in the formats that are asked for, and keeps the last until it is fetched."""

    def __init__(self, rebuilder: Rebuilder) -> None:
        """Download what that builds."""
        self._rebuilder = rebuilder
        self._lock = threading.Lock()
        self._kept: tuple[str, str, bytes] | None = None  # key, name, content

    def prepare(self, format: str, values: Mapping[str, object]) -> Json:
        """Write the robot in a format; return what the page shows of it, as data for JSON.

        Args:
            format: one of `FORMATS`.
            values: the variables that the page sets.
        """
        with self._lock:  # one at a time: the page asks for one, and it may take long
            try:
                build = self._rebuilder.build_as(format, values)
                name, content = packed(build)
            except YamaroError as error:
                errors = [each for each in error.diagnostics if each.severity == ERROR]
                return {"diagnostics": [diagnostic_data(each) for each in errors]}
            except UsageError as error:
                return {"diagnostics": [], "fault": str(error)}
            except OSError as error:
                reason = error.strerror or str(error)
                return {"diagnostics": [], "fault": f"a mesh cannot be read: {reason}"}
            except FaultInJail as error:
                return {"diagnostics": [], "fault": f"internal error: {error}"}
            key = secrets.token_urlsafe(9)
            self._kept = (key, name, content)
        losses = diagnostics_of(build.losses, format)
        set_aside(losses)
        return {
            "key": key,
            "name": name,
            "bytes": len(content),
            "diagnostics": [diagnostic_data(each) for each in losses],
        }

    def fetch(self, key: str) -> tuple[str, bytes] | None:
        """Return name and content of what was prepared last, if that has this key."""
        kept = self._kept
        return None if kept is None or kept[0] != key else kept[1:]


def packed(build: Build) -> tuple[str, bytes]:
    """Return the document of a build with its name; with files beside it they are an archive.

    Raises:
        OSError: a mesh cannot be read any more.
    """
    document = marked(b"".join(build.encoded()), TARGETS[build.format].comment)
    assets = build.assets
    if not assets:
        return build.file_name, document
    stem = build.file_name.removesuffix(TARGETS[build.format].ending)
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in {build.file_name: document, **assets}.items():
            entry = zipfile.ZipInfo(f"{stem}/{name}", _DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = _MODE
            file.writestr(entry, content)
    return f"{stem}-{build.format}.zip", archive.getvalue()


# --- session ----------------------------------------------------------------------------------


class Session:
    """One robot that is shown, which builds change, and which requests read, in other threads.

    Attributes:
        wake: is set when a request wants another build.
        downloads: the robot in output formats.
    """

    def __init__(self, rebuilder: Rebuilder, *, editor: str | None) -> None:
        """Begin without a robot; `editor` is what the editor is called, if there is one."""
        self.wake = threading.Event()
        self._rebuilder = rebuilder
        rebuilder.has_root = True  # the page shows the tree, also of a robot built in a jail
        self._path = rebuilder.path
        self._reach = reach_of(rebuilder.path, rebuilder.options.policy, rebuilder.options.packages)
        self._loader = FileLoader(rebuilder.options.policy.limits, self._reach)
        roots = [] if self._reach is None else self._reach.roots
        reader = Reader(rebuilder.options.policy, readable=roots, name=rebuilder.path)
        self._library = Library(reader, self._reach)
        self._editor = editor
        self.downloads = Downloads(rebuilder)
        self._changed = threading.Condition()
        self._is_closed = False
        self._version = 0
        self._robot_version = 0
        self._robot: Description | None = None
        self._fault: Json | None = None
        self._fault_places = Places()
        self._seconds = 0.0
        self._fields: dict[str, VariableField] = {}
        self._is_xml = False
        self._has_others = False  # whether the main file declares more than these
        self._has_more = False  # whether it or a file that it includes does
        self._values: dict[str, Value] = {}
        self._files = [MeshFiles(None), MeshFiles(None)]  # of this robot, and of the one before it
        self._encoded: tuple[int, bytes] = (-1, b"")

    # --- builds ---------------------------------------------------------------------------------

    def build(self) -> Turn:
        """Build the robot again, and notify all waiting requests."""
        self.wake.clear()
        self._read_fields()
        with self._changed:
            values = dict(self._values)
        turn = self._rebuilder.build(values)
        robot = self._describe(turn)
        with self._changed:
            self._seconds = turn.seconds
            if robot is not None:
                self._robot, self._fault = robot, None
                files = turn.build.files if turn.build is not None else []
                main = os.path.abspath(self._path)
                self._has_more = self._has_others or any(
                    each.endswith((".yaml", ".yml")) and each != main for each in files
                )
                self._robot_version += 1
            else:
                self._fault_places = Places()
                self._fault = fault_data(turn.diagnostics, turn.fault, self._fault_places)
            self._version += 1
            self._changed.notify_all()
        return turn

    def _describe(self, turn: Turn) -> Description | None:
        if turn.build is None:
            return None
        if turn.build.root_name != "robot":
            turn.fault = f"the page shows robots, and this is a <{turn.build.root_name}>"
            turn.build = None
            return None
        if self._reach is not None:  # a build may read what the packages that it names bring
            self._reach.also_allow(turn.build.finder.roots)
        self._library.look_up(filter(os.path.isabs, turn.build.meshes))
        files = MeshFiles(self._reach, self._library)
        robot = Description(turn.build, files)
        self._rebuilder.also_watch([*robot.awaited, *files.paths.values()])
        self._files = [files, self._files[0]]
        return robot

    def _read_fields(self) -> None:
        """Read which variables the main file has; of those changed in it, its values count.

        While it has errors, all stays as it was.
        """
        try:
            data = self._loader.read(os.path.abspath(self._path))
            text = decode(data, name=self._path, path=self._path).text
            fields = read_variable_fields(
                text,
                self._path,
                path=os.path.abspath(self._path),
                loader=self._loader,
                packages=finder_for(self._path, self._reach, self._rebuilder.options.packages),
            )
            self._is_xml = holds_xml(self._path, text)
            self._has_others = not self._is_xml and has_others(
                Source(text, name=self._path), fields
            )
        except (LoadError, YamaroError):
            return
        with self._changed:
            for name in list(self._values):
                before, now = self._fields.get(name), fields.get(name)
                if now is None or before is None or before.default != now.default:
                    del self._values[name]
            self._fields = fields

    # --- what requests ask for ------------------------------------------------------------------

    def state(self) -> bytes:
        """Return all that the page shows, as JSON."""
        with self._changed:
            if self._encoded[0] != self._version:
                state = {
                    "version": self._version,
                    "robotVersion": self._robot_version,
                    "file": self._path,
                    "editor": self._editor,
                    "milliseconds": round(1000 * self._seconds, 1),
                    "robot": self._robot.data if self._robot is not None else None,
                    "fault": self._fault,
                    "variables": self._variables(),
                    "hasMore": self._has_more,
                }
                self._encoded = (self._version, json.dumps(state).encode())
            return self._encoded[1]

    def _variables(self) -> list[Json]:
        given = self._given()
        return [
            {
                "name": field.name,
                "kind": field.kind,
                "default": given.get(name, field.default),
                "isWhole": field.is_whole,
                "value": self._values.get(name, given.get(name, field.default)),
                "line": field.span.location()[0],
                **self._file_of(field),
                **field.about(),
            }
            for name, field in self._fields.items()
            if name in given or field.default is not None
        ]

    def _file_of(self, field: VariableField) -> Json:
        """Return the file that a variable is in, if that is not the main file."""
        path = field.span.source.path
        return {} if path == os.path.abspath(self._path) else {"file": path}

    def _given(self) -> dict[str, Value]:
        """Return what the command line sets, where it fits the field."""
        if self._is_xml:
            texts = dict(
                word.split(":=", 1) for word in self._rebuilder.options.command_line if ":=" in word
            )
            found = {
                name: self._fields[name].from_text(text)
                for name, text in texts.items()
                if name in self._fields
            }
            return {name: value for name, value in found.items() if value is not None}
        try:
            values = read_command_line(self._rebuilder.options.command_line)[0]
        except UsageError:
            return {}
        fitting = {}
        for name, value in values.items():
            try:
                if name in self._fields:
                    fitting[name] = self._fields[name].read(value)
            except WrongValue:
                continue
        return fitting

    def wait(self, version: int, seconds: float) -> int:
        """Return the version, once it is another than that, or after some time; -1 at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._is_closed or self._version != version, seconds)
            return -1 if self._is_closed else self._version

    def open_file(self, key: str) -> tuple[BufferedReader, str] | None:
        """Return a mesh or texture of this robot, or of the one before it, and its MIME type.

        Where it lies is looked at again: it may have become a link since the robot was built.
        """
        files = next((each for each in self._files if key in each.paths), None)
        if files is None:
            return None
        path = files.paths[key]
        try:
            file = open_regular(path)
        except OSError:
            return None
        reach = None if path.startswith(MADE) else self._reach
        if reach is not None and not reach.is_of(path, file.fileno()):
            file.close()
            return None
        return file, files.types[key]

    def place(self, number: int, *, version: int, is_fault: bool) -> tuple[str, int, int] | None:
        """Return path, line and column of a place the page has from a version of the state."""
        with self._changed:
            places = self._fault_places if is_fault else self._robot and self._robot.places
            is_current = version == (self._version if is_fault else self._robot_version)
            if not places or not is_current or not 0 <= number < len(places.where):
                return None
            return places.where[number]

    def place_of_variable(self, name: str) -> tuple[str, int, int] | None:
        """Return where a variable is written."""
        with self._changed:
            found = next((each for each in self._fields.values() if each.name == name), None)
            if found is None:
                return None
            return (found.span.source.path, *found.span.location())

    def set_variables(self, values: Mapping[str, object]) -> None:
        """Set variables of the main file, and have the robot built; None takes the file's value.

        Raises:
            WrongValue: there is no such variable, or it cannot have that value; nothing is set.
        """
        with self._changed:
            names = {field.name: name for name, field in self._fields.items()}
            settled: dict[str, Value | None] = {}
            for shown, value in values.items():
                if shown not in names:
                    raise WrongValue("there is no such variable")
                name = names[shown]
                settled[name] = None if value is None else self._fields[name].read(value)
            for name, new in settled.items():
                if new is None:
                    self._values.pop(name, None)
                else:
                    self._values[name] = new
        self.wake.set()

    def document(self, format: str | None) -> Build:
        """Return the robot in an output format, or as the document that the file describes.

        Raises:
            YamaroError: the robot has errors, or the format cannot hold it.
            UsageError: the main file cannot be read.
        """
        with self._changed:
            values = dict(self._values)
        return self._rebuilder.build_as(format, values)

    def download(self, format: str) -> bytes:
        """Have the robot written in an output format; return what the page shows of it, as JSON."""
        with self._changed:
            values = dict(self._values)
        return json.dumps(self.downloads.prepare(format, values)).encode()

    def included(self) -> bytes:
        """Return the variables that a build does not take, with their values, as JSON.

        The robot is built for that, with notes of the values, which takes longer than without.
        """
        with self._changed:
            values, fields, robot = dict(self._values), dict(self._fields), self._robot
            version = self._robot_version
        try:
            noted = [] if robot is None else self._rebuilder.noted(values)
        except (YamaroError, UsageError):
            noted = []
        found = IncludedVariables(noted, os.path.abspath(self._path), fields)
        with self._changed:
            places = Places() if robot is None else robot.places
            files = found.data(self._loader, places)
        return json.dumps({"version": version, "files": files}).encode()

    def rebuild(self) -> None:
        """Have the robot built, with all files read again."""
        self._rebuilder.forget()
        self.wake.set()

    def close(self) -> None:
        """End all waiting requests."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
