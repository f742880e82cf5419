"""The metrics by the words that ask for them, as in `stable(5)`."""

from __future__ import annotations

from ....diagnostics import YamaroError, did_you_mean, failure
from ....source import Source, Span
from ..simulation import FORMAT
from .chains import tips_of
from .extent import bounding_box
from .failures import metric_failure, named_link
from .reach import reach
from .stable import hold
from .workspace import workspace

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ..variant import Variant

    Number = float | int | bool
    Compute = Callable[[Variant, Sequence[str]], Sequence[Number]]

LONGEST = 86_400.0
"""Seconds that a robot may be simulated."""


class Metric:
    """A metric as it is asked for.

    Attributes:
        word: the text that asks for it.
        units: the units of its columns by their names; "" for what has none.
        needs: the output format it is worked out from, if it needs one.
        packages: the Python packages that it is worked out with.
    """

    __slots__ = ("_arguments", "_name", "needs", "packages", "units", "word")

    def __init__(self, word: str, span: Span) -> None:
        """Read a word.

        Raises:
            YamaroError: there is no such metric, or it takes other arguments.
        """
        self.word = word
        name, arguments = _taken_apart(word, span)
        kind = KINDS.get(name)
        if kind is None:
            hint = did_you_mean(name, KINDS) or f"there are {', '.join(KINDS)}"
            raise failure("unknown-metric", f"there is no metric '{name}'", span, hint=hint)
        if not kind.takes(arguments):
            message = f"the metric '{name}' does not take '{', '.join(arguments)}'"
            if not arguments:
                message = f"the metric '{name}' needs an argument"
            raise failure("bad-metric", message, span, hint=f"write it as in {kind.example}")
        self._name = name
        self._arguments = arguments
        self.needs = kind.needs
        self.packages = kind.packages
        mark = "".join(f"_{each}" for each in arguments) if kind.is_marked else ""
        self.units = {
            f"{name}{mark}{part and '_'}{part}": unit for part, unit in kind.parts.items()
        }

    def values(self, variant: Variant) -> dict[str, Number]:
        """Return its values for a variant, by the names of the columns.

        Raises:
            YamaroError: the robot has no such value.
        """
        found = KINDS[self._name].compute(variant, self._arguments)
        return dict(zip(self.units, found, strict=True))


class _Kind:
    """A kind of metric.

    Attributes:
        compute: works it out.
        parts: what the names of its columns end in, with their units.
        takes: whether it takes some arguments.
        example: a word for it.
        is_marked: whether the arguments are part of the names of the columns.
        needs: the output format it is worked out from.
        packages: the Python packages that it is worked out with.
    """

    __slots__ = ("compute", "example", "is_marked", "needs", "packages", "parts", "takes")

    def __init__(
        self,
        compute: Compute,
        parts: Mapping[str, str],
        *,
        example: str,
        takes: Callable[[Sequence[str]], bool] = lambda arguments: not arguments,
        is_marked: bool = False,
        needs: str | None = None,
        packages: tuple[str, ...] = (),
    ) -> None:
        self.compute = compute
        self.parts = parts
        self.takes = takes
        self.example = example
        self.is_marked = is_marked
        self.needs = needs
        self.packages = packages


def metrics_of(words: Sequence[str], spans: Sequence[Span]) -> list[Metric]:
    """Return the metrics that words ask for.

    Raises:
        YamaroError: it holds an error for each word that is wrong.
    """
    found: list[Metric] = []
    errors = []
    for word, span in zip(words, spans, strict=True):
        try:
            metric = Metric(word, span)
        except YamaroError as error:
            errors += error.diagnostics
            continue
        twice = next((each for each in found if metric.units.keys() & each.units.keys()), None)
        if twice is not None:
            message = f"the metric '{word}' gives the same columns as '{twice.word}'"
            errors += failure("bad-metric", message, span, hint="leave one out").diagnostics
        found.append(metric)
    if errors:
        raise YamaroError(errors)
    return found


def span_of_word(word: str) -> Span:
    """Return a place for a word that is in no file."""
    return Span(Source(word, name="<metric>"), 0, len(word))


def _taken_apart(word: str, span: Span) -> tuple[str, list[str]]:
    """Return the name and the arguments of `name(argument, argument)`."""
    name, bracket, rest = word.strip().partition("(")
    if bracket and not rest.endswith(")"):
        hint = f"write it as in {KINDS['stable'].example}"
        raise failure("bad-metric", f"'{word}' has no closing parenthesis", span, hint=hint)
    inner = rest[:-1].strip()
    return name.strip(), [each.strip() for each in inner.split(",")] if inner else []


def _is_duration(arguments: Sequence[str]) -> bool:
    if len(arguments) != 1:
        return False
    try:
        return 0 < float(arguments[0].removesuffix("s")) <= LONGEST
    except ValueError:
        return False


def _mass(variant: Variant, arguments: Sequence[str]) -> Sequence[Number]:
    return (variant.build.robot.mass,)


def _bounding_box(variant: Variant, arguments: Sequence[str]) -> Sequence[Number]:
    return bounding_box(variant.build.robot, variant.build.finder)


def _reach(variant: Variant, arguments: Sequence[str]) -> Sequence[Number]:
    robot = variant.build.robot
    return (reach(robot, [named_link(robot, name) for name in arguments]),)


def _workspace(variant: Variant, arguments: Sequence[str]) -> Sequence[Number]:
    robot = variant.build.robot
    tips = arguments or tips_of(robot)
    if len(tips) != 1:
        raise metric_failure(
            f"the robot has {len(tips)} tips, so it is not known whose workspace is meant",
            robot.span,
            hint=f"name one: workspace({tips[0]})" if tips else None,
        )
    return (workspace(robot, named_link(robot, tips[0])),)


def _stable(variant: Variant, arguments: Sequence[str]) -> Sequence[Number]:
    seconds = float(arguments[0].removesuffix("s"))
    held = hold(variant.build.outputs[FORMAT], seconds)
    return (held.is_stable, held.time, held.tilt, held.sag)


KINDS: dict[str, _Kind] = {
    "mass": _Kind(_mass, {"": "kg"}, example="mass"),
    "reach": _Kind(
        _reach,
        {"": "m"},
        example="reach or reach(tool0)",
        takes=lambda names: len(names) <= 1,
        is_marked=True,
        packages=("numpy",),
    ),
    "bounding_box": _Kind(
        _bounding_box, dict.fromkeys("xyz", "m"), example="bounding_box"
    ),
    "workspace": _Kind(
        _workspace,
        {"": "m³"},
        example="workspace(tool0)",
        takes=lambda names: len(names) <= 1,
        is_marked=True,
        packages=("numpy", "scipy"),
    ),
    "stable": _Kind(
        _stable,
        {"": "", "time": "s", "tilt": "rad", "sag": ""},
        example="stable(5), with the seconds",
        takes=_is_duration,
        needs=FORMAT,
        packages=("numpy", "mujoco"),
    ),
}  # fmt: skip
