"""Builds and evaluates variants, one after another, in the process of a worker."""

from __future__ import annotations

import io
import json
import os
import tarfile
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from typing import Any

from ...diagnostics import WARNING, Diagnostic, YamaroError, failure
from ...files.regular import open_regular
from ...model.kinematics import base_of
from ...model.robot import Robot
from ...options import Options
from ...output import write_file
from ...program import Program
from ...result import Build
from .plan import MJCF, USD, Plan, Space
from .table import ENDED, FAULT, OK, OUT_OF_MEMORY, REJECTED, TOPOLOGY, Row, first_error, parts_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .batch import Comparison


class Variant:
    """A variant that was built.

    Attributes:
        index: its number in the sweep, from 0.
        arguments: the values passed to the file, as the table has them: numbers in the unit of
            their argument.
        build: the result; its `outputs` has a build for each output format of the sweep, and
            `Evaluation.needs` is among them.
        folder: where relative paths of meshes in the outputs start.
    """

    __slots__ = ("arguments", "build", "folder", "index")

    def __init__(
        self, index: int, arguments: Mapping[str, object], build: Build, folder: str
    ) -> None:
        self.index = index
        self.arguments = arguments
        self.build: Build = build
        self.folder = folder


MODELS = "models"
ASSETS = "assets/"


def model_name(index: int) -> str:
    """Return what the files of a variant are called, without the ends of their names."""
    return f"{index:09d}"


class Builder:
    """Builds the variants of a plan.

    Attributes:
        files: the SHA-256 of the files that they were built from, by path.
    """

    def __init__(self, plan: Plan, folder: str = "") -> None:
        """Prepare.

        Args:
            plan: what variants there are.
            folder: that of the sweep, beside which meshes are if models are kept.

        Raises:
            YamaroError: the robot has errors that are found without running it.
            UsageError: it cannot be read.
        """
        self._plan = plan
        self._space = Space(plan)
        self._home = os.path.dirname(plan.robot)
        self._models = os.path.join(folder or self._home, MODELS) if plan.models else ""
        options = plan.options.changed(
            target=plan.targets() or None,
            on_message=lambda message: None,
            has_root=plan.evaluation is not None or plan.has_topologies,
        )
        self._program = Program(plan.robot, options)
        self._program.parse()
        self._known_assets: set[str] = set()
        self._comparison: Comparison | None = None
        self._first: Row | None = None
        self.files: dict[str, str] = {}
        if plan.is_batch:
            from .batch import Comparison
            from .replaying import Replays

            self._comparison = Comparison()
            self._replays = Replays(plan, self._text)
            if plan.first is not None:
                (arguments,) = self._space.variants(plan.first, plan.first + 1)
                self._first = self.row(plan.first, arguments)

    def rows(self, start: int, stop: int) -> Iterator[Row]:
        """Build variants from `start` up to `stop`; yield a row for each."""
        self._known_assets.clear()
        variants = dict(enumerate(self._space.variants(start, stop), start))
        if self._comparison is not None:
            self._replays.begin(variants)
        for index, arguments in variants.items():
            known = self._first if self._first and self._first.index == index else None
            yield known or self.row(index, arguments)

    def row(self, index: int, arguments: Mapping[str, object]) -> Row:
        """Build and evaluate one variant, and return what is known of it."""
        row = Row(index, arguments)
        try:
            if not self._space.is_kept(arguments):
                row.status = REJECTED
                return row
            if self._comparison is not None and self._replay(row):
                return row
            # What is not noted of a build is freed in the thread that made it, which is faster.
            self._program.compile(
                self._options(index, arguments), lambda build: self._fill(row, build)
            )
        except YamaroError as error:
            found = first_error(error.diagnostics)
            return row.fail(found.code, self._shown(found.message), self._place(found))
        except MemoryError:
            return row.fail(OUT_OF_MEMORY, "there is not enough memory for this variant")
        except SystemExit as error:
            return row.fail(ENDED, f"Python code ended the program: {error!r}")
        except Exception as error:  # a fault of ours costs one variant
            return row.fail(FAULT, self._shown(f"{type(error).__name__}: {error}"))
        return row

    def build(
        self, index: int, arguments: Mapping[str, object], *, has_root: bool = False
    ) -> Build:
        """Return the build of a variant.

        Args:
            index: its number.
            arguments: the values of the axes.
            has_root: whether the tree is needed.

        Raises:
            YamaroError: it has errors.
        """
        options = self._options(index, arguments).changed(has_root=has_root)
        return self._program.compile(options, lambda build: build)

    def _options(self, index: int, arguments: Mapping[str, object]) -> Options:
        plan = self._plan
        variables = {**plan.fixed, **arguments}
        if not plan.models:
            return self._program.options.changed(variables=variables)
        output = os.path.join(self._models, f"{model_name(index)}.xml")
        return self._program.options.changed(variables=variables, output=output, meshes="copy")

    def _fill(self, row: Row, build: Build) -> None:
        """Note what there is to know of a build; raise what the evaluation raises."""
        plan = self._plan
        outputs = build.outputs or {"urdf": build}
        if self._comparison is not None:
            self._compare(row, outputs[MJCF])
            return
        for format in plan.hashed():
            text = outputs[format].xml().encode()
            row.hashes[format] = sha256(text).hexdigest()
            if plan.models and (format in plan.formats or not plan.formats):
                row.documents[ends_of([format])[0]] = text
                for path, data in outputs[format].assets.items():
                    if not path.startswith(ASSETS):  # such as a scene around this very variant
                        own = f"{model_name(row.index)}."  # of `000000007.loops.yaml`
                        end = path.removeprefix(own) if path.startswith(own) else f"{format}.{path}"
                        row.documents[end] = data
                    elif path not in self._known_assets:
                        self._known_assets.add(path)
                        row.assets[path] = data
        for path in build.files:
            if path not in self.files:
                self.files[path] = file_hash(path)
        if plan.has_topologies:
            row.topology = topology_of(build.robot, plan.options.base)
        if plan.evaluation is not None:
            arguments = {**plan.fixed, **row.arguments}
            variant = Variant(row.index, arguments, build, self._models or self._home)
            row.metrics = plan.evaluation(variant)

    # --- batches ---

    def take(self) -> dict[str, Any]:
        """Return the fields of the variants of a batch since the last time."""
        return {} if self._comparison is None else self._comparison.take()

    def _text(self, arguments: dict[str, Any]) -> str:
        """Return the MJCF of a variant."""
        options = self._options(0, arguments)
        return self._program.compile(options, lambda build: (build.outputs or {})[MJCF].xml())

    def _replay(self, row: Row) -> bool:
        """Note what there is to know of a variant without building it; return whether that is."""
        assert self._comparison is not None
        document = self._replays.find(row.index)
        if document is None or self._comparison.first is None:
            return False
        try:
            model = self._comparison.note(row, document)
        except ValueError:  # the build says where
            return False
        if document.is_to_check:
            is_same = self._text(row.arguments) == document.text
            row.is_unequal = not (is_same and self._comparison.is_model(model, document))
        row.warnings = document.warnings
        return True

    def _compare(self, row: Row, build: Build) -> None:
        """Compare a variant that was built with the first one, and record how it was built.

        Raises:
            YamaroError: MuJoCo refuses it.
        """
        from .replaying import Document

        assert self._comparison is not None
        row.warnings = [
            (each.code, self._place(each), self._shown(each.message))
            for each in build.warnings
            if each.severity == WARNING
        ]
        document = Document(build.xml(), dict(build.assets), row.warnings)
        try:
            self._comparison.note(row, document)
        except ValueError as error:
            message = f"MuJoCo refuses the robot: {' '.join(str(error).split())}"
            raise failure("mujoco-refused", message, build.robot.span) from None
        if not row.unlike:
            self._replays.learn(row.arguments, document)

    def _place(self, diagnostic: Diagnostic) -> str:
        """Return where something was found, as `file:line:column`, or ""."""
        source = diagnostic.span.source
        if not (source.path or source.text):
            return ""
        line, column = diagnostic.span.location()
        return f"{self._shown(source.path or source.name)}:{line}:{column}"

    def _shown(self, text: str) -> str:
        """Return a text in which paths begin in the folder of the robot, wherever that is."""
        return text.replace(self._home + os.sep, "")


def ends_of(formats: list[str]) -> list[str]:
    """Return the ends of the names of documents, by their formats."""
    from ...targets.table import TARGETS

    endings = [TARGETS[format].ending for format in formats]
    return [
        f"{format}{ending}" if endings.count(ending) > 1 else ending[1:]
        for format, ending in zip(formats, endings, strict=True)
    ]


def file_hash(path: str) -> str:
    """Return the SHA-256 of a file, or "" if it cannot be read."""
    try:
        with open_regular(path) as file:
            return sha256(file.read()).hexdigest()
    except OSError:
        return ""


# --- models that are kept: a tar file for each chunk, and the meshes that all of them share ----


def shard_name(number: int) -> str:
    """Return what the tar file of a chunk is called."""
    return f"shard-{number:06d}.tar"


def packed(rows: Sequence[Row]) -> tuple[bytes, dict[tuple[int, str], tuple[int, int]]]:
    """Return the documents of rows as a tar file, and where in it each one is and how long.

    The places are by the number of the variant and the end of the file's name.
    """
    file = io.BytesIO()
    places = {}
    with tarfile.open(fileobj=file, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for row in rows:
            for end, data in row.documents.items():
                member = tarfile.TarInfo(f"{model_name(row.index)}.{end}")
                member.size = len(data)
                tar.addfile(member, io.BytesIO(data))
                padded = -(-len(data) // tarfile.BLOCKSIZE) * tarfile.BLOCKSIZE
                places[row.index, end] = (file.tell() - padded, len(data))
    return file.getvalue(), places


def missing_assets(folder: str, assets: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the meshes that are not in a folder yet; their names say their content."""
    paths = {os.path.join(folder, *path.split("/")): data for path, data in assets.items()}
    return {path: data for path, data in paths.items() if not os.path.exists(path)}


# --- which variants have the same topology, for simulators that load many of one kind at once --


INDEX = "index.json"
_NAMES = ("id", "status", TOPOLOGY)


def topology_of(robot: Robot, base: str | None) -> str:
    """Return a text that is the same for robots with the same bodies and joints in one order.

    Args:
        robot: the robot.
        base: whether the root is asked to be fixed or free.
    """
    links = [[name, link.mass > 0] for name, link in robot.links.items()]
    joints = [
        [joint.name, joint.type, joint.parent, joint.child, bool(joint.mimic)]
        for joint in robot.joints.values()
    ]
    loops = [[name, loop.type, *loop.between] for name, loop in robot.loops.items()]
    parts = [base_of(robot, base)[0], links, joints, loops]
    return sha256(json.dumps(parts, ensure_ascii=False).encode()).hexdigest()[:16]


def write_index(plan: Plan, folder: str) -> None:
    """Write which of the USD files that are kept have the same topology.

    Raises:
        OSError: it cannot be written.
    """
    groups: dict[str, list[int]] = {}
    for part in parts_of(folder, _NAMES):
        for index, status, topology in zip(*(part[name] for name in _NAMES), strict=True):
            if status == OK:
                groups.setdefault(topology, []).append(index)
    end = ends_of(plan.formats)[plan.formats.index(USD)]
    found: list[dict[str, Any]] = [
        {
            "topology": topology,
            "variants": indices,
            "files": [f"{model_name(index)}.{end}" for index in indices],
        }
        for topology, indices in sorted(groups.items(), key=lambda pair: (-len(pair[1]), pair[1]))
    ]
    text = json.dumps({"format": USD, "topologies": found}, indent=1) + "\n"
    write_file(os.path.join(folder, MODELS, INDEX), [text.encode()])
