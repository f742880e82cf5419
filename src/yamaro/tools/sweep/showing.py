"""Builds a variant of a sweep again: `yamaro sweep show runs/ 4711`."""

from __future__ import annotations

import os

from ...diagnostics import YamaroError, failure_of_all
from ...options import Options, UsageError
from ...source import Public
from .builder import Builder, file_hash
from .conditions import Condition
from .folder import read_plan_data
from .plan import Plan, Space, axis_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...policy import Policy
    from ...result import Build


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
            repair_inertia=data["repair-inertia"],
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


def show(folder: str, index: int, policy: Policy, *, has_root: bool = False) -> Shown:
    """Build a variant of the sweep in a folder again.

    Args:
        folder: that of the sweep.
        index: the number of the variant.
        policy: how far the robot's files are trusted now.
        has_root: whether the tree is needed.

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
        build = Builder(plan, os.path.abspath(folder)).build(index, arguments, has_root=has_root)
    except YamaroError as error:
        error.diagnostics[0].notes = (*error.diagnostics[0].notes, _passed(arguments))
        raise
    return Shown({**plan.fixed, **arguments}, build, changed)


def _passed(arguments: dict[str, object]) -> str:
    return "its arguments are " + " ".join(f"{key}:={value}" for key, value in arguments.items())
