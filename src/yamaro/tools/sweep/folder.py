"""The folder of a sweep: its plan, the chunks that are done, and the models it keeps.

A chunk is done when the file of its part of the table is there, which is written whole and then
renamed. So a sweep that was killed goes on from there.
"""

from __future__ import annotations

import json
import os
import tarfile
from collections.abc import Iterator
from typing import Any

from ...diagnostics import YamaroError, failure_of_all
from ...files.regular import open_regular
from ...options import Options, UsageError
from ...output import write_file
from ...policy import Policy
from ...result import Build
from ...source import Public
from .builder import ASSETS, MODELS, Builder, ends_of, file_hash, missing_assets, shard_name
from .plan import Condition, Plan, Space, axis_of, data_of, units_of
from .table import FOLDER, part_name, part_paths
from .worker import Chunk

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
        for inner in (self.path, os.path.join(self.path, FOLDER), os.path.join(self.path, MODELS)):
            for name in os.listdir(inner) if os.path.isdir(inner) else ():
                if _is_cut_off(name):
                    os.unlink(os.path.join(inner, name))
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


# --- the models that a sweep has kept ---------------------------------------------------------


SCENE = "mjcf.scene.xml"
"""What the name of a scene ends in."""


class KeptModel(Public):
    """A model that a sweep has kept.

    Attributes:
        index: the number of the variant.
        text: the document.
        files: the files that it refers to, by the paths it has for them. Of a scene, the robot is
            among them.
    """

    __slots__ = ("files", "index", "text")

    def __init__(self, index: int, text: str, files: dict[str, bytes]) -> None:
        self.index = index
        self.text = text
        self.files = files


def kept_models(
    folder: str, format: str | None = None, *, has_scene: bool = False
) -> Iterator[KeptModel]:
    """Yield the models in the shards of a sweep, in the order of the variants.

    Args:
        folder: that of the sweep.
        format: the output format; by default the first one that is kept.
        has_scene: of MJCF, whether the robot is on a floor.

    Raises:
        UsageError: there is no sweep, or it has not kept such models.
    """
    plan = read_plan_data(folder, folder)
    formats = plan["formats"] or ["urdf"]
    format = format or formats[0]
    if not plan["models"]:
        raise UsageError(f"the sweep in '{folder}' has kept no models: run it with --models")
    if format not in formats or (has_scene and format != "mjcf"):
        kept = ", ".join(formats)
        raise UsageError(f"the sweep in '{folder}' has kept {kept}, and not what is asked for")
    end = ends_of(formats)[formats.index(format)]
    models = os.path.join(folder, MODELS)
    assets = {}
    for inner, _, names in os.walk(os.path.join(models, ASSETS)):
        for name in sorted(names):
            path = os.path.join(inner, name)
            with open_regular(path) as file:
                assets[os.path.relpath(path, models).replace(os.sep, "/")] = file.read()
    for number in part_paths(folder):
        path = os.path.join(models, shard_name(number))
        with open_regular(path) as file, tarfile.open(fileobj=file, mode="r:") as shard:
            yield from _models_in(shard, end, assets, has_scene=has_scene)


def _models_in(
    shard: tarfile.TarFile, end: str, assets: dict[str, bytes], *, has_scene: bool
) -> Iterator[KeptModel]:
    """Yield the models of one shard; `assets` are the meshes and textures of all."""
    robot = ""
    for member in shard:
        name, _, ending = member.name.partition(".")
        if ending not in (end, SCENE):
            continue
        file = shard.extractfile(member)
        if file is None:
            continue
        text = file.read().decode()
        if ending == end:
            robot = text
        if ending != (SCENE if has_scene else end):
            continue
        files = {  # their names hold their hash
            path: data for path, data in assets.items() if path.removeprefix(ASSETS) in robot
        }
        if has_scene:
            files[f"{name}.{end}"] = robot.encode()
        yield KeptModel(int(name), text, files)


# --- a variant that is built again: `yamaro sweep show runs/ 4711` ----------------------------


_KINDS = {"axes": dict, "fixed": dict, "keep": list, "method": str, "samples": int, "seed": int}
"""What is in a plan that is read from an untrusted folder."""


class Shown(Public):
    """A variant that was built again.

    Attributes:
        arguments: what was passed to the file, with what all variants have in common.
        build: the result.
        changed: the files that are not as they were when the sweep ran.
    """

    __slots__ = ("arguments", "build", "changed")

    def __init__(self, arguments: dict[str, object], build: Build, changed: list[str]) -> None:
        self.arguments = arguments
        self.build = build
        self.changed = changed


def plan_in(folder: str, policy: Policy) -> Plan:
    """Return the plan of the sweep in a folder, without its evaluation.

    Args:
        folder: the folder.
        policy: how far the robot's files are trusted now.

    Raises:
        UsageError: there is no sweep.
        YamaroError: it cannot be read.
    """
    data = read_plan_data(folder, folder)

    def path_of(relative: str) -> str:
        return os.path.normpath(os.path.join(os.path.abspath(folder), relative))

    try:
        for name, kind in _KINDS.items():
            if type(data[name]) is not kind:
                raise TypeError(f"'{name}' is not of type {kind.__name__}")
        axes = [axis_of(name, each) for name, each in data["axes"].items()]
        options = Options(
            policy=policy,
            packages={name: path_of(path) for name, path in data["packages"].items()},
            allow=data["allow"],
            deny=data["deny"],
            strict=data["strict"],
            base=data["base"],
            sdf_version=data["sdf-version"],
            mujoco_version=data["mujoco-version"],
            repair_inertia=data["repair-inertia"],
            overlay=[
                path_of(each) if isinstance(each, str) else each for each in data.get("overlay", ())
            ],
        )
        plan = Plan(path_of(data["robot"]), axes, options)
        plan.method, plan.seed, plan.samples = data["method"], data["seed"], data["samples"]
        plan.fixed = data["fixed"]
        plan.conditions = [Condition(str(text)) for text in data["keep"]]
        plan.formats = data["hashed"] if data["formats"] or data["hashed"] != ["urdf"] else []
        plan.models = data["models"]
        plan.chunk, plan.versions = data["chunk"], data["versions"]
        plan.files = {path_of(path): digest for path, digest in data["files"].items()}
    except (KeyError, TypeError, AttributeError) as error:
        message = f"'study.json' is malformed: {error}"
        raise failure_of_all("sweep-differs", message, folder, None) from None
    return plan


def show(folder: str, index: int, policy: Policy) -> Shown:
    """Build a variant of the sweep in a folder again.

    Args:
        folder: that of the sweep.
        index: the number of the variant.
        policy: how far the robot's files are trusted now.

    Raises:
        UsageError: there is no sweep, or it has no such variant.
        YamaroError: the variant has errors.
    """
    plan = plan_in(folder, policy)
    if not 0 <= index < plan.samples:
        last = plan.samples - 1
        raise UsageError(f"the sweep has no variant {index}; they are numbered from 0 to {last}")
    arguments = next(Space(plan).variants(index, index + 1))
    changed = [path for path, digest in plan.files.items() if file_hash(path) != digest]
    try:
        build = Builder(plan, os.path.abspath(folder)).build(index, arguments)
    except YamaroError as error:
        passed = " ".join(f"{key}:={value}" for key, value in arguments.items())
        notes = error.diagnostics[0].notes
        error.diagnostics[0].notes = (*notes, f"its arguments are {passed}")
        raise
    return Shown({**plan.fixed, **arguments}, build, changed)
