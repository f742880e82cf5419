"""Plans: all that determines variant i of a sweep. A plan goes to every worker.

Each point of the unit cube, or of the grid, is worked out from its number alone.
"""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from typing import Any

from ...diagnostics import YamaroError, failure_of_all
from ...options import Options
from ...policy import SAFE, Policy
from ...runtime.expressions import SafeEvaluator
from ...runtime.files import rules_of
from ...runtime.python_errors import Explainer
from ...runtime.scope import Home, Scope, SharedNames
from ...safe.limits import SafeLimits
from ...safe.runtime import SafeRuntime
from ...source import COMMAND_LINE, Source
from ...syntax.python import PythonCode, compile_expression
from ...yaml.nodes import PLAIN, ScalarNode
from .axes import Axis, Choices, Normal, Steps, Uniform

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .evaluation import Evaluation


# --- methods: which point of the unit cube, or of the grid, is that of a variant --------------


GRID, RANDOM, LATIN, SOBOL = "grid", "random", "latin", "sobol"
METHODS = (GRID, RANDOM, LATIN, SOBOL)
LARGEST_SEED = (1 << 63) - 1
MOST_SAMPLES = {GRID: 1 << 40, RANDOM: 1 << 40, LATIN: 1 << 31, SOBOL: 1 << 30}
"""LATIN keeps a permutation of all samples in memory, for each axis; SOBOL has 2^30 points."""
_ORDERS = 1 << 63
"""Added to the number of an axis where it is a key, so that no index is one of these keys."""
_HALF = 2.0**-53


class Method:
    """Gives the points of a sweep.

    Attributes:
        name: one of `METHODS`.
        seed: decides about what is random.
        samples: how many points there are.
        counts: for a grid, how many values each axis has; otherwise any number for each axis.
    """

    __slots__ = ("_orders", "counts", "name", "samples", "seed")

    def __init__(self, name: str, seed: int, samples: int, counts: Sequence[int]) -> None:
        self.name = name
        self.seed = seed
        self.samples = samples
        self.counts = tuple(counts)
        self._orders: list[Any] | None = None

    def points(self, start: int, stop: int) -> Iterator[Sequence[float]]:
        """Yield the points with indices from `start` up to `stop`.

        For a grid these are the indices of the values, and otherwise numbers from 0 to 1.
        """
        if self.name == GRID:
            return (self._digits(index) for index in range(start, stop))
        if self.name == SOBOL:
            return self._of_sobol(start, stop)
        if self.name == LATIN:
            return self._of_latin(start, stop)
        return (self._random(index) for index in range(start, stop))

    def _digits(self, index: int) -> list[int]:
        """Return the digits of an index in mixed radix; the last one changes fastest."""
        digits = []
        for count in reversed(self.counts):
            index, digit = divmod(index, count)
            digits.append(digit)
        return digits[::-1]

    def _random(self, index: int) -> list[float]:
        """Return as many random numbers as there are axes, which no other index has."""
        raw = _philox(self.seed, index).random_raw(len(self.counts))
        return [int(each >> 11) * _HALF for each in raw]

    def _of_latin(self, start: int, stop: int) -> Iterator[list[float]]:
        """Yield points of which each axis has one in each stratum: a permutation for each axis."""
        if self._orders is None:
            numpy = import_extra("numpy")
            self._orders = [
                numpy.random.Generator(_philox(self.seed, _ORDERS + axis)).permutation(
                    numpy.arange(self.samples, dtype=numpy.uint32)
                )
                for axis in range(len(self.counts))
            ]
        for index in range(start, stop):
            strata = [int(order[index]) for order in self._orders]
            values = [
                (stratum + part) / self.samples
                for stratum, part in zip(strata, self._random(index), strict=True)
            ]
            yield [  # one that rounding takes out of its stratum is its middle
                value if int(value * self.samples) == stratum else (stratum + 0.5) / self.samples
                for value, stratum in zip(values, strata, strict=True)
            ]

    def _of_sobol(self, start: int, stop: int) -> Iterator[list[float]]:
        import warnings

        qmc = import_extra("scipy.stats.qmc")
        numpy = import_extra("numpy")
        generator = numpy.random.default_rng(self.seed)
        try:
            sequence = qmc.Sobol(len(self.counts), rng=generator)
        except TypeError:  # scipy before 1.15
            sequence = qmc.Sobol(len(self.counts), seed=generator)
        if start:
            sequence.fast_forward(start)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of numbers of points that are not powers of 2
            points = sequence.random(stop - start)
        return iter(points.tolist())


def _philox(seed: int, key: int) -> Any:
    numpy = import_extra("numpy")
    return numpy.random.Philox(key=numpy.array([seed, key], dtype=numpy.uint64))


def import_extra(name: str, extra: str = "sweep") -> Any:
    """Return a module that an extra brings.

    Raises:
        YamaroError: it is not installed.
    """
    found = sys.modules.get(name)
    if found is not None:
        return found
    from importlib import import_module

    try:
        return import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        raise failure_of_all(
            "missing-extra",
            f"this sweep needs the Python package '{package}': {error}",
            "sweep",
            f"pip install 'yamaro[{extra}]'",
        ) from None


# --- conditions that variants have to meet: Python that only computes, about their arguments ---


_POLICY = Policy(SAFE)


class Condition:
    """A condition as it is written.

    Attributes:
        text: the Python expression.
        name: the file it is in, as messages name it, or `<command line>`.
        file: the text of that file.
        start: where in it the expression begins.
    """

    __slots__ = ("file", "name", "start", "text")

    def __init__(self, text: str, *, name: str = COMMAND_LINE, file: str = "", start: int = 0):
        self.text = text
        self.name = name
        self.file = file or text
        self.start = start

    def compiled(self) -> PythonCode:
        """Return the condition as code.

        Raises:
            YamaroError: it is not an expression, or does more than compute.
        """
        source = Source(self.file, name=self.name)
        node = ScalarNode(self.text, PLAIN, source, self.start, self.start + len(self.text))
        try:
            return compile_expression(self.text, node, 0, rules_of(_POLICY))
        except YamaroError as error:
            raise _only_computing(error) from None


class Conditions:
    """Says whether the arguments of a variant meet some conditions."""

    __slots__ = ("_codes", "_source")

    def __init__(self, conditions: list[Condition]) -> None:
        """Compile them; raise YamaroError if one of them is not an expression."""
        self._codes = [condition.compiled() for condition in conditions]
        self._source = Source("", name="sweep")

    def hold(self, arguments: Mapping[str, object]) -> bool:
        """Return whether all conditions hold.

        Raises:
            YamaroError: one cannot be evaluated.
        """
        if not self._codes:
            return True
        limits = _POLICY.limits
        runtime = SafeRuntime(SafeLimits.of(limits))
        home = Home(self._source, "", {**runtime.names(), **arguments}, None)
        scope = Scope(home, SharedNames(), closure=None, caller=None)
        explainer = Explainer({}, lambda name: [], limits)
        evaluator = SafeEvaluator(lambda: explainer, limits, runtime)
        try:
            return all(bool(evaluator.evaluate(code, scope)) for code in self._codes)
        except YamaroError as error:
            raise _only_computing(error) from None


def _only_computing(error: YamaroError) -> YamaroError:
    for diagnostic in error.diagnostics:
        if diagnostic.code == "unsafe-code":
            diagnostic.hint = "a condition can only compute"
    return error


# --- plan -------------------------------------------------------------------------------------


FORMS = {kind.__name__.lower(): kind for kind in (Choices, Steps, Uniform, Normal)}
SECONDS = 60.0
"""How long a variant may take by default."""
USD, MJCF = "usd", "mjcf"
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
        is_batch: whether MuJoCo compiles each variant for a batch.
        is_recorded: whether variants of a batch are replayed that are built alike.
        checked: the numbers of variants of a batch that are built as well.
        first: the variant with which others of a batch are compared; None if it is to be found.
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
        self.is_batch = False
        self.is_recorded = False
        self.checked: frozenset[int] = frozenset()
        self.first: int | None = None
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
        "overlay": [
            os.path.relpath(each, folder) if isinstance(each, str) else dict(each)
            for each in options.overlay
        ],
        "mujoco-version": options.mujoco_version,
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
