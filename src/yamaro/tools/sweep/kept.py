"""The models that a sweep has kept, one after another: as texts, with the files they refer to."""

from __future__ import annotations

import os
import tarfile

from ...files.regular import open_regular
from ...options import UsageError
from ...source import Public
from .builder import ASSETS, MODELS, ends_of
from .folder import read_plan_data
from .models import shard_name
from .table import part_paths

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

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
    assets = _read_assets(models)
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
        files = _files(robot, assets)
        if has_scene:
            files[f"{name}.{end}"] = robot.encode()
        yield KeptModel(int(name), text, files)


def _read_assets(models: str) -> dict[str, bytes]:
    """Return all meshes and textures of a sweep, by their paths from the folder of its models."""
    found = {}
    for folder, _, names in os.walk(os.path.join(models, ASSETS)):
        for name in sorted(names):
            path = os.path.join(folder, name)
            with open_regular(path) as file:
                found[os.path.relpath(path, models).replace(os.sep, "/")] = file.read()
    return found


def _files(text: str, assets: dict[str, bytes]) -> dict[str, bytes]:
    """Return the meshes and textures that a document refers to, whose names hold their hash."""
    return {path: data for path, data in assets.items() if path.removeprefix(ASSETS) in text}
