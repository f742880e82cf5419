"""Plans: all that decides what variant i of a sweep is. A plan goes to every worker."""

from __future__ import annotations

import os
import platform
from copy import copy

from .axes import Axis, Choices, Normal, Steps, Uniform
from .conditions import Condition, Conditions
from .methods import GRID, SOBOL, Method

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from typing import Any

    from ...options import Options
    from .evaluation import Evaluation

FORMS = {kind.__name__.lower(): kind for kind in (Choices, Steps, Uniform, Normal)}
SECONDS = 60.0
"""How long a variant may take by default."""
USD = "usd"
UNKNOWN = ""
"""The version of a package that is not installed."""


class Plan:
    """All that decides what variant i of a sweep is, and how it is built and evaluated.

    Attributes:
        robot: the absolute path of the robot's file.
        axes: the axes.
        fixed: what is passed to all variants besides.
        method: one of `METHODS`.
        seed: decides about what is random.
        samples: how many variants there are.
        conditions: what variants have to meet.
        formats: the output formats whose documents the sweep is about.
        evaluation: evaluates variants, or None.
        models: whether the models are kept.
        options: those of the builds, except for what is passed, the formats and the output.
        seconds: how long a variant may take.
        memory: bytes of data that the process of a worker may have.
        chunk: how many variants are built and stored together.
        files: the SHA-256 of files that variants were built from, by path; grows.
        versions: of what has an influence on the result.
        run: is another one for each run of the command.
    """

    def __init__(self, robot: str, axes: list[Axis], options: Options) -> None:
        """Plan one sample of a robot."""
        self.robot = robot
        self.axes = axes
        self.options = options
        self.fixed: dict[str, object] = {}
        self.method = GRID
        self.seed = 0
        self.samples = 1
        self.conditions: list[Condition] = []
        self.formats: list[str] = []
        self.evaluation: Evaluation | None = None
        self.models = False
        self.seconds = SECONDS
        self.memory = 0
        self.chunk = 0
        self.files: dict[str, str] = {}
        self.versions: dict[str, str] = {}
        self.run = os.urandom(8).hex()

    def limit_time(self, seconds: float) -> None:
        """Set how long a variant may take; the process around it sees to that, and no other."""
        self.seconds = seconds
        policy = copy(self.options.policy)
        policy.timeout = None if policy.is_trusted else 2 * seconds + SECONDS
        self.options = self.options.changed(policy=policy)

    @property
    def has_topologies(self) -> bool:
        """Return whether the table says which variants have the same topology."""
        return self.models and USD in self.formats

    def targets(self) -> list[str]:
        """Return the output formats to build: those asked for, and those the evaluation needs."""
        needs = self.evaluation.needs if self.evaluation is not None else ()
        return list(dict.fromkeys((*self.formats, *needs)))

    def hashed(self) -> list[str]:
        """Return the formats whose documents' hashes are in the table."""
        return self.targets() or ["urdf"]

    def chunks(self) -> int:
        """Return how many chunks there are."""
        return -(-self.samples // self.chunk)

    def bounds(self, number: int) -> tuple[int, int]:
        """Return the first variant of a chunk, and the one after its last."""
        start = number * self.chunk
        return start, min(start + self.chunk, self.samples)


class Space:
    """The variants of a plan."""

    __slots__ = ("_axes", "_conditions", "_is_grid", "_method")

    def __init__(self, plan: Plan) -> None:
        """Prepare; raise YamaroError if a condition is not an expression."""
        self._axes = plan.axes
        self._conditions = Conditions(plan.conditions)
        self._is_grid = plan.method == GRID
        counts = [axis.count or 0 for axis in plan.axes]
        self._method = Method(plan.method, plan.seed, plan.samples, counts)

    def variants(self, start: int, stop: int) -> Iterator[dict[str, Any]]:
        """Yield the arguments of variants from `start` up to `stop`."""
        for point in self._method.points(start, stop):
            if self._is_grid:
                yield {
                    axis.name: axis.at(int(index))
                    for axis, index in zip(self._axes, point, strict=True)
                }
            else:
                yield {
                    axis.name: axis.value(part)
                    for axis, part in zip(self._axes, point, strict=True)
                }

    def is_kept(self, arguments: Mapping[str, object]) -> bool:
        """Return whether a variant meets the conditions; raise YamaroError if that fails."""
        return self._conditions.hold(arguments)


# --- what is compared before a sweep goes on ---


def versions_for(plan: Plan) -> dict[str, str]:
    """Return the versions of what has an influence on the result, by name."""
    from importlib.metadata import PackageNotFoundError, version

    from ... import __version__

    names = [] if plan.method == GRID else ["numpy"]
    names += ["scipy"] if plan.method == SOBOL else []
    names += plan.evaluation.packages if plan.evaluation is not None else ()
    found = {"yamaro": __version__, "python": ".".join(platform.python_version_tuple()[:2])}
    for name in names:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = UNKNOWN
    return found


def data_of(plan: Plan, folder: str) -> dict[str, Any]:
    """Return a plan as it is written in the folder of the sweep; paths start there."""
    options, limits = plan.options, plan.options.policy.limits
    return {
        "robot": os.path.relpath(plan.robot, folder),
        "method": plan.method,
        "seed": plan.seed,
        "samples": plan.samples,
        "axes": {axis.name: axis.described() for axis in plan.axes},
        "fixed": plan.fixed,
        "keep": [condition.text for condition in plan.conditions],
        "formats": plan.formats,
        "hashed": plan.hashed(),
        "evaluation": plan.evaluation.described(folder) if plan.evaluation is not None else None,
        "models": plan.models,
        "trust": options.policy.mode,
        "limits": {name: getattr(limits, name) for name in limits.__slots__},
        "packages": {
            name: os.path.relpath(path, folder) for name, path in sorted(options.packages.items())
        },
        "allow": sorted(options.allow),
        "deny": sorted(options.deny),
        "strict": options.strict,
        "base": options.base,
        "repair-inertia": options.repair_inertia,
        "sdf-version": options.sdf_version,
        "timeout": plan.seconds,
        "versions": plan.versions,
    }


def units_of(plan: Plan) -> dict[str, str]:
    """Return the units of columns that have one, as far as they are known, by name."""
    found = {axis.name: axis.unit for axis in plan.axes}
    if plan.evaluation is not None:
        found.update(plan.evaluation.units)
    return {name: unit for name, unit in found.items() if unit}


def axis_of(name: str, data: Mapping[str, Any]) -> Axis:
    """Return the axis that `Axis.described` describes."""
    own = {key: value for key, value in data.items() if key not in ("form", "kind", "name")}
    if data["form"] == "normal":
        return Normal(name, own.pop("mean"), own.pop("deviation"), **own)
    return FORMS[data["form"]](name, **own)
