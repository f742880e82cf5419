"""The folder of a sweep: what it was planned as, and which chunks are done.

A chunk is done when the file of its part of the table is there, which is written whole and then
renamed. So a sweep that was killed goes on from there.
"""

from __future__ import annotations

import json
import os

from ...diagnostics import failure_of_all
from ...files.regular import open_regular
from ...options import UsageError
from ...output import write_file
from .builder import MODELS, file_hash
from .models import missing_assets, shard_name
from .plan import data_of, units_of
from .table import FOLDER, part_name, part_paths

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from .chunk import Chunk
    from .plan import Plan

STUDY = "study.json"
LOCK = ".lock"
FORM = 1
"""The version of the form of `study.json`."""
_UNCOMPARED = ("chunk", "files", "form", "table", "units")
MOST_SHOWN = 10


class SweepFolder:
    """The folder of a sweep.

    Attributes:
        path: its absolute path.
        shown: its path as it was given.
        ending: of the files of the table.
    """

    def __init__(self, path: str, ending: str) -> None:
        self.shown = path
        self.path = os.path.abspath(path)
        self.ending = ending
        self._lock: int | None = None

    def begin(self, plan: Plan, *, resumes: bool) -> bool:
        """Take the folder for a plan; return whether that goes on with a sweep in it.

        The chunk size, and the ending of files, are then those of that sweep.

        Raises:
            UsageError: it holds another thing, or a sweep that is not to go on.
            YamaroError: its sweep has another plan.
        """
        if os.path.exists(self.path) and not os.path.isdir(self.path):
            raise UsageError(f"'{self.shown}' is a file, and a sweep needs a folder")
        names = set(os.listdir(self.path)) if os.path.isdir(self.path) else set()
        if STUDY not in names:
            if any(name != LOCK and not _is_cut_off(name) for name in names):
                raise UsageError(f"the folder '{self.shown}' is not empty, and holds no sweep")
            self._take()
            return False
        if not resumes:
            raise UsageError(
                f"the folder '{self.shown}' holds a sweep; --resume goes on with it, or choose "
                "another folder"
            )
        self._take()
        self._compare(plan)
        self._clean()
        return True

    def save(self, plan: Plan) -> None:
        """Write what the sweep is planned as."""
        data = {
            "form": FORM,
            "table": self.ending,
            "chunk": plan.chunk,
            "units": units_of(plan),
            **data_of(plan, self.path),
            "files": {
                os.path.relpath(path, self.path): digest
                for path, digest in sorted(plan.files.items())
            },
        }
        text = json.dumps(data, indent=2, ensure_ascii=False) + "\n"
        write_file(os.path.join(self.path, STUDY), [text.encode()])

    def done(self) -> set[int]:
        """Return the numbers of the chunks that are done."""
        return set(part_paths(self.path))

    def store(self, chunk: Chunk) -> None:
        """Write what a chunk has given; its part of the table comes last."""
        models = os.path.join(self.path, MODELS)
        for path, data in missing_assets(models, chunk.assets).items():
            write_file(path, [data])
        if chunk.shard is not None:
            write_file(os.path.join(models, shard_name(chunk.number)), [chunk.shard])
        part = part_name(chunk.number, self.ending)
        write_file(os.path.join(self.path, FOLDER, part), [chunk.table])

    def release(self) -> None:
        """Let others take the folder."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def _take(self) -> None:
        """Take the folder for this process; raise UsageError if another one has it."""
        os.makedirs(self.path, exist_ok=True)
        try:
            import fcntl
        except ImportError:  # Windows
            return
        self._lock = os.open(os.path.join(self.path, LOCK), os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self.release()
            message = f"another sweep works in the folder '{self.shown}'"
            raise UsageError(message) from None

    def _clean(self) -> None:
        """Remove what was not written whole when the sweep was killed."""
        for inner in (self.path, os.path.join(self.path, FOLDER), os.path.join(self.path, MODELS)):
            for name in os.listdir(inner) if os.path.isdir(inner) else ():
                if _is_cut_off(name):
                    os.unlink(os.path.join(inner, name))

    def _compare(self, plan: Plan) -> None:
        """Take over what the sweep in the folder has settled.

        Raises:
            YamaroError: it has another plan, or files have changed since.
        """
        stored = read_plan_data(self.path, self.shown)
        now = json.loads(json.dumps(data_of(plan, self.path)))
        before = {name: value for name, value in stored.items() if name not in _UNCOMPARED}
        notes = list(_differences(before, now))
        for relative, digest in stored["files"].items():
            path = os.path.normpath(os.path.join(self.path, relative))
            plan.files[path] = digest
            if file_hash(path) != digest:
                notes.append(f"the file '{path}' has changed")
        if notes:
            error = failure_of_all(
                "sweep-differs",
                "the sweep in this folder was planned otherwise",
                self.shown,
                "choose another folder, or go back to what it was",
            )
            more = [f"and {len(notes) - MOST_SHOWN} more"] if len(notes) > MOST_SHOWN else []
            error.diagnostics[0].notes = (*notes[:MOST_SHOWN], *more)
            raise error
        plan.chunk = stored["chunk"]
        self.ending = stored["table"]


def _is_cut_off(name: str) -> bool:
    """Return whether a name is that of a file that was being written when the sweep was killed."""
    return name.startswith(".yamaro-") and name.endswith(".tmp")


def read_plan_data(path: str, shown: str) -> dict[str, Any]:
    """Return what the sweep in a folder is planned as.

    Raises:
        UsageError: there is none.
        YamaroError: it cannot be read.
    """
    try:
        with open_regular(os.path.join(path, STUDY)) as file:
            data = json.load(file)
        if not isinstance(data, dict) or data.get("form") != FORM:
            raise ValueError("it is of another version of Yamaro")
    except FileNotFoundError:
        raise UsageError(f"the folder '{shown}' holds no sweep") from None
    except (OSError, ValueError) as error:
        name = os.path.join(shown, STUDY)
        raise failure_of_all("sweep-differs", f"cannot be read: {error}", name, None) from None
    return data


def _differences(before: object, now: object, name: str = "") -> list[str]:
    """Return what differs between two plans, a line each."""
    if isinstance(before, dict) and isinstance(now, dict):
        return [
            line
            for key in dict.fromkeys((*before, *now))
            for line in _differences(before.get(key), now.get(key), f"{name}.{key}".lstrip("."))
        ]
    if before == now:
        return []
    return [f"{name} was {_shown(before)}, and is {_shown(now)} now"]


def _shown(value: object) -> str:
    from ...terminal import shortened

    return shortened(json.dumps(value, ensure_ascii=False)) if value is not None else "not there"
