"""Builds and evaluates variants, one after another: what the process of a worker does."""

from __future__ import annotations

import hashlib
import os

from ...diagnostics import YamaroError
from ...files.regular import open_regular
from ...program import Program
from .plan import Space
from .rows import ENDED, FAULT, OUT_OF_MEMORY, REJECTED, Row, first_error
from .topology import topology_of
from .variant import Variant

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ...diagnostics import Diagnostic
    from ...options import Options
    from ...result import Build
    from .plan import Plan

MODELS = "models"
ASSETS = "assets/"
_INDEX_DIGITS = 9


def model_name(index: int) -> str:
    """Return what the files of a variant are called, without the ends of their names."""
    return f"{index:0{_INDEX_DIGITS}d}"


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
            on_message=_ignore,
            has_root=plan.evaluation is not None or plan.has_topologies,
        )
        self._program = Program(plan.robot, options)
        self._program.parse()
        self._known_assets: set[str] = set()
        self.files: dict[str, str] = {}

    def rows(self, start: int, stop: int) -> Iterator[Row]:
        """Build variants from `start` up to `stop`; yield a row for each."""
        self._known_assets.clear()
        for index, arguments in enumerate(self._space.variants(start, stop), start):
            yield self.row(index, arguments)

    def row(self, index: int, arguments: Mapping[str, object]) -> Row:
        """Build and evaluate one variant, and return what is known of it."""
        row = Row(index, arguments)
        try:
            if not self._space.is_kept(arguments):
                row.status = REJECTED
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
        for format in plan.hashed():
            text = outputs[format].xml().encode()
            row.hashes[format] = hashlib.sha256(text).hexdigest()
            if plan.models and (format in plan.formats or not plan.formats):
                self._keep(row, format, text, outputs[format])
        for path in build.files:
            if path not in self.files:
                self.files[path] = file_hash(path)
        if plan.has_topologies:
            row.topology = topology_of(build.robot, plan.options.base)
        if plan.evaluation is not None:
            arguments = {**plan.fixed, **row.arguments}
            variant = Variant(row.index, arguments, build, self._models or self._home)
            row.metrics = plan.evaluation(variant)

    def _keep(self, row: Row, format: str, text: bytes, build: Build) -> None:
        """Keep a document, and what belongs beside it."""
        row.documents[ends_of([format])[0]] = text
        for path, data in build.assets.items():
            if not path.startswith(ASSETS):  # such as a scene around this very variant
                row.documents[f"{format}.{path}"] = data
            elif path not in self._known_assets:
                self._known_assets.add(path)
                row.assets[path] = data

    def _place(self, found: Diagnostic) -> str:
        source = found.span.source
        if not source.path and not source.text:
            return ""
        line, column = found.span.location()
        return f"{self._shown(source.path or source.name)}:{line}:{column}"

    def _shown(self, text: str) -> str:
        """Return a text in which paths begin in the folder of the robot, wherever that is."""
        return text.replace(self._home + os.sep, "")


def ends_of(formats: list[str]) -> list[str]:
    """Return the ends of the names of documents, by their formats."""
    from ...targets.writers import ENDINGS

    endings = [ENDINGS[format] for format in formats]
    return [
        f"{format}{ending}" if endings.count(ending) > 1 else ending[1:]
        for format, ending in zip(formats, endings, strict=True)
    ]


def file_hash(path: str) -> str:
    """Return the SHA-256 of a file, or "" if it cannot be read."""
    try:
        with open_regular(path) as file:
            return hashlib.sha256(file.read()).hexdigest()
    except OSError:
        return ""


def _ignore(message: str) -> None:
    """Take a line that a file prints."""
