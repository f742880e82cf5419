"""A migration as the command asks for it: run in a jail, unless the file is trusted."""

from __future__ import annotations

import os

from ...confined import has_jail, no_jail, run_in_jail, time_is_over
from ...diagnostics import ERROR, YamaroError
from ...options import UsageError
from ...policy import JAIL, SAFE, Policy
from ...request import finder_for, reach_of
from ...runtime.xml_files import is_named_xacro, read_included, xacro_in_safe_mode
from ...sandbox.deadline import TimeOver, run_within
from ...sandbox.deep_stack import run_on_deep_stack
from ...sandbox.jail.protocol import JailAnswerBroken, JailUnavailable, pack, unpack
from ...sandbox.transfer import Outcome, from_bytes, to_bytes
from ...sources.table import source_of
from . import urdf as command
from .robots import Builder, migrate_robot
from .xacro import command as xacro_command

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...diagnostics import Diagnostic
    from ...source import Source

ENDINGS = (".yaml", ".yml", ".json", ".xacro")
"""Endings of the files that a migration writes: sources, the data that they load, and what calls
macros of other packages."""


class Result:
    """What a migration gives.

    Attributes:
        files: the texts by their paths, relative to a folder; of a URDF under "".
        main: the path of the main file.
        diagnostics: what could not be carried over, and the errors of the sources.
        report: what is said of the comparison.
        remark: what else is said of it, or "".
        is_same: whether the sources make the robot that they were made of.
    """

    __slots__ = ("diagnostics", "files", "is_same", "main", "remark", "report")

    def __init__(
        self,
        files: Mapping[str, str],
        main: str,
        *,
        diagnostics: Sequence[Diagnostic] = (),
        report: str,
        remark: str = "",
        is_same: bool,
    ) -> None:
        self.files = dict(files)
        self.main = main
        self.diagnostics = list(diagnostics)
        self.report = report
        self.remark = remark
        self.is_same = is_same

    @property
    def has_errors(self) -> bool:
        """Return whether the sources have errors, so that nothing could be compared."""
        return any(each.severity == ERROR for each in self.diagnostics)


class Job:
    """What is to be migrated, and how.

    Attributes:
        source: the XML file.
        folder: where the sources are to be, absolute.
        arguments: those of xacro, as `name:=value`.
        packages: folders of ROS packages by name.
        policy: how far the file is trusted.
        exact: whether an origin that is missing has to stay missing.
        wanted: packages whose files are migrated as well.
        model: the name of the model of a file with several; None for the first.
    """

    __slots__ = (
        "_finder",
        "_reach",
        "arguments",
        "exact",
        "folder",
        "model",
        "packages",
        "policy",
        "source",
        "wanted",
    )

    def __init__(
        self,
        source: Source,
        folder: str,
        *,
        arguments: Sequence[str] = (),
        packages: Mapping[str, str] | None = None,
        policy: Policy | None = None,
        exact: bool = False,
        wanted: Sequence[str] = (),
        model: str | None = None,
    ) -> None:
        """Say what is wanted; by default the file is trusted."""
        self.source = source
        self.folder = folder
        self.arguments = list(arguments)
        self.packages = dict(packages or {})
        self.policy = policy or Policy()
        self.exact = exact
        self.wanted = list(wanted)
        self.model = model
        path = source.path or "-"
        self._reach = reach_of(path, self.policy, self.packages)
        self._finder = finder_for(path, self._reach, self.packages)

    def run(self) -> Result:
        """Return the sources.

        Raises:
            YamaroError: the file has errors, or may not be run.
            UsageError: an argument makes no sense.
        """
        if self._reach is None or not has_jail(self.policy, self.source.name):
            return self._in_time()
        try:
            return run_in_jail(
                self._packed,
                _unpacked,
                policy=self.policy,
                reach=self._reach,
                name=self.source.name,
            )
        except JailUnavailable as error:
            if self.policy.mode == JAIL:
                raise no_jail(str(error), self.source.name) from None
            return self._in_time()

    def _in_time(self) -> Result:
        try:
            return run_on_deep_stack(lambda: run_within(self.policy.timeout, self._migrate))
        except TimeOver:
            raise time_is_over(self.source.name, self.policy) from None

    def _migrate(self) -> Result:
        limits = self.policy.limits
        is_guarded = not self.policy.is_trusted and not self.policy.is_confined
        if is_named_xacro(self.source) and not is_guarded:
            return self._migrate_xacro()
        root, is_xacro = read_included(self.source, limits)
        if is_xacro:
            if is_guarded:
                raise xacro_in_safe_mode(root.span)
            if not self.source.path:
                raise UsageError("a robot in xacro is migrated from a file, not from a pipe")
            return self._migrate_xacro()
        format = source_of(root)
        if self.arguments:
            title = "a URDF" if format is None else f"an {format.title}"
            raise UsageError(f"{title} has no argument to set: '{self.arguments[0]}'")
        policy = Policy(SAFE) if is_guarded else Policy()
        if format is not None:
            return self._migrate_robot(format.name, policy)
        migration = command.migrate_source(self.source, limits, policy=policy, exact=self.exact)
        return Result(
            {"": migration.text},
            "",
            report=command.report(migration),
            is_same=not migration.differences,
        )

    def _migrate_robot(self, format: str, building: Policy) -> Result:
        """Return the source of a robot in MJCF or SDF; `building` is how far that is trusted."""
        builder = Builder(format, self.folder, packages=self.packages, reach=self._reach)
        migration = migrate_robot(
            self.source,
            builder,
            policy=self.policy,
            building=building,
            exact=self.exact,
            model=self.model,
        )
        return Result(
            {"": migration.text},
            "",
            diagnostics=migration.diagnostics,
            report=command.report(migration, migration.counts),
            remark=migration.remark(),
            is_same=not migration.differences,
        )

    def _migrate_xacro(self) -> Result:
        migration = xacro_command.migrate_robot(
            self.source,
            self.folder,
            arguments=self.arguments,
            packages=self.packages,
            limits=self.policy.limits,
            exact=self.exact,
            wanted=self.wanted,
            finder=self._finder,
            reach=self._reach,
        )
        return Result(
            migration.files,
            migration.main,
            diagnostics=[*xacro_command.warnings_of(migration), *migration.faults],
            report=command.report(migration),
            remark="\n".join(xacro_command.remarks_on(migration)),
            is_same=not migration.differences,
        )

    # --- out of a jail ----------------------------------------------------------------------

    def _packed(self) -> bytes:
        """Return the result as bytes, or what was raised."""
        try:
            result = self._in_time()
        except YamaroError as error:
            return pack([to_bytes(Outcome(diagnostics=error.diagnostics))])
        except UsageError as error:
            return pack([to_bytes(Outcome()), str(error).encode("utf-8", "surrogatepass")])
        said = Outcome(
            messages=[result.main, result.report, result.remark, *["same"] * result.is_same],
            diagnostics=result.diagnostics,
        )
        files = [each.encode("utf-8") for pair in result.files.items() for each in pair]
        return pack([to_bytes(said), b"", *files])


def _unpacked(data: bytes) -> Result:
    """Return the result that some bytes describe, which may come from an attacker.

    Raises:
        JailAnswerBroken: they do not describe one.
        YamaroError: the file has errors.
        UsageError: an argument makes no sense.
    """
    try:
        packed, *rest = unpack(data)
        outcome = from_bytes(packed)
        if not rest:
            if not outcome.has_errors:
                raise ValueError("there is no error")
            raise YamaroError(outcome.diagnostics)
        usage, *texts = rest
        if usage:
            raise UsageError(usage.decode())
        main, report, remark, *is_same = outcome.messages
        files = {
            _checked_name(name.decode()): _checked_text(text.decode())
            for name, text in zip(texts[::2], texts[1::2], strict=True)
        }
    except (ValueError, IndexError) as error:
        raise JailAnswerBroken(f"its answer is malformed: {error}") from None
    if main not in files:
        raise JailAnswerBroken("its answer holds no main file")
    return Result(
        files,
        main,
        diagnostics=outcome.diagnostics,
        report=report,
        remark=remark,
        is_same=bool(is_same),
    )


def _checked_name(name: str) -> str:
    """Return the name of a file to write, which must lie in the folder and not be hidden."""
    parts = name.split("/")
    if name and (
        os.path.isabs(name)
        or not name.isprintable()
        or not name.endswith(ENDINGS)
        or any(not part or part.startswith(".") for part in parts)
    ):
        raise ValueError("a file cannot have such a name")
    return name


def _checked_text(text: str) -> str:
    """Return a text to write, which must not control a terminal that it is shown on."""
    for line in text.split("\n"):
        if not line.isprintable() and any(ord(char) < 32 and char not in "\t\r" for char in line):
            raise ValueError("a file holds control characters")
    return text
