"""The metrics of a variant, by the words that ask for them: `mass`, `reach`, `stable(5)`.

Those of a simulation are worked out from the MJCF of the variant, compiled by MuJoCo.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ...diagnostics import YamaroError, did_you_mean, failure, failure_of_all
from ...result import Build
from ...source import Source, Span
from .builder import Variant
from .geometry import bounding_box, metric_failure, named_link, reach, tips_of, workspace

TYPE_CHECKING = False
if TYPE_CHECKING:
    from numpy.typing import NDArray

    Number = float | int | bool
    Compute = Callable[[Variant, Sequence[str]], Sequence[Number]]
    Floats = NDArray[np.floating[Any]]


# --- whether a robot holds its home position in MuJoCo ----------------------------------------


STEPS = 5
"""Steps of the simulation between two looks."""
FREE, HINGE = 0, 3
"""Types of joints, as `mjtJoint` numbers them."""
SPHERE, CAPSULE, ELLIPSOID, CYLINDER, MESH = 2, 3, 4, 5, 7
"""Types of geoms, as `mjtGeom` numbers them."""
JOINT = 0
"""What an actuator acts on, as `mjtTrn` numbers it."""
DC_MOTOR, STIFFNESS = 3, 4
"""A `dcmotor`, as `mjtGain` numbers it, and where its stiffness is in `actuator_gainprm`."""
TILT = np.radians(45)
"""How far a free base may tilt."""
LEAST_HEIGHT = 0.5
"""The part of its height above the floor that the centre of mass must keep."""
MOST_SAG = 0.1
"""The part of its range that a joint with a position actuator may leave its place by."""


class Hold:
    """How a robot held its home position.

    Attributes:
        is_stable: whether it was stable to the end.
        time: how long it was stable, in s.
        tilt: how far its base tilted until then, in rad; 0 if it is fixed.
        sag: how far a joint with a position actuator left its place, as part of its range.
    """

    __slots__ = ("is_stable", "sag", "tilt", "time")

    def __init__(self) -> None:
        self.is_stable = False
        self.time = 0.0
        self.tilt = 0.0
        self.sag = 0.0


def hold(build: Build, seconds: float) -> Hold:
    """Simulate a robot with its actuators at home, on a floor if its base is free.

    Args:
        build: its MJCF.
        seconds: for how long.

    Raises:
        YamaroError: MuJoCo is not installed, or refuses the robot.
    """
    mujoco = import_mujoco()
    has_floor = "<freejoint" in build.xml()
    model = compiled(build, has_floor=has_floor, has_sensors=False)
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    mujoco.mj_forward(model, data)
    if has_floor:
        floor = model.geom("floor").id
        lowest = [
            lowest_point(model, data, geom)
            for geom in range(model.ngeom)
            if geom != floor and (model.geom_contype[geom] or model.geom_conaffinity[geom])
        ]
        model.geom_pos[floor, 2] = min(lowest, default=0.0)
    watch = _Watch(model, data, floor if has_floor else None)
    steps = max(round(seconds / model.opt.timestep), 1)
    done, result = 0, Hold()
    while done < steps:
        count = min(STEPS, steps - done)
        mujoco.mj_step(model, data, count)
        done += count
        if not watch.is_well(data, result):
            return result
        result.time = done * model.opt.timestep
    result.is_stable = True
    return result


class _Watch:
    """The state that is compared with the start, from time to time."""

    def __init__(self, model: Any, data: Any, floor: int | None) -> None:
        """Note how a simulation starts.

        Args:
            model: the model.
            data: its state at the start, after `mj_forward`.
            floor: the geom that the robot stands on; None for a robot that is fixed.
        """
        self._floor = 0.0 if floor is None else float(model.geom_pos[floor, 2])
        self._base: int | None = None
        if floor is not None:
            self._base = int(model.jnt_bodyid[(model.jnt_type == FREE).argmax()])
            self._height = data.subtree_com[self._base, 2] - self._floor
            self._up: Floats = data.xmat[self._base].reshape(3, 3)[2].copy()
        # A position actuator holds a joint: its force falls with the position.
        is_motor = model.actuator_gaintype == DC_MOTOR
        holds = np.where(
            is_motor, model.actuator_gainprm[:, STIFFNESS], -model.actuator_biasprm[:, 1]
        )
        is_servo = (model.actuator_trntype == JOINT) & (holds > 0)
        driven = np.unique(model.actuator_trnid[is_servo, 0])
        self._places: Floats = model.jnt_qposadr[driven]
        self._home: Floats = data.qpos[self._places].copy()
        limited = model.jnt_limited[driven].astype(bool)
        whole = np.where(model.jnt_type[driven] == HINGE, 2 * np.pi, 1.0)
        self._ranges = np.where(limited, np.ptp(model.jnt_range[driven], axis=1), whole)

    def is_well(self, data: Any, result: Hold) -> bool:
        """Return whether the robot is as it was; note what there is to note."""
        if data.warning.number.any() or not np.isfinite(data.qpos).all():
            return False
        if len(self._places):
            ways = abs(data.qpos[self._places] - self._home) / self._ranges
            result.sag = max(result.sag, float(ways.max()))
        if self._base is not None:
            upright = data.xmat[self._base].reshape(3, 3)[2] @ self._up
            result.tilt = max(result.tilt, float(np.arccos(np.clip(upright, -1, 1))))
            height = data.subtree_com[self._base, 2] - self._floor
            if result.tilt > TILT or height < LEAST_HEIGHT * self._height:
                return False
        return result.sag <= MOST_SAG


def lowest_point(model: Any, data: Any, geom: int) -> float:
    """Return the height of the lowest point of a geom, in metres.

    It is that of the support function of its shape: see `extent`; of an ellipsoid with the half
    axes sᵢ and the vertical r in its frame √Σ(rᵢ·sᵢ)².
    """
    up: Floats = data.geom_xmat[geom].reshape(3, 3)[2]
    height = float(data.geom_xpos[geom, 2])
    size: Floats = model.geom_size[geom]
    kind = int(model.geom_type[geom])
    if kind == SPHERE:
        return height - float(size[0])
    if kind == CAPSULE:
        return height - float(size[0] + abs(up[2]) * size[1])
    if kind == CYLINDER:
        return height - float(size[0] * np.hypot(up[0], up[1]) + abs(up[2]) * size[1])
    if kind == ELLIPSOID:
        return height - float(np.linalg.norm(up * size))
    if kind == MESH:
        mesh = model.geom_dataid[geom]
        start = model.mesh_vertadr[mesh]
        corners = model.mesh_vert[start : start + model.mesh_vertnum[mesh]]
        return height + float((corners @ up).min())
    return height - float(abs(up) @ size)


# --- the MJCF of a variant, compiled by MuJoCo ------------------------------------------------


FORMAT = "mjcf"
SCENE = "scene.xml"
HINT = "pip install mujoco"


def compiled(build: Build, *, has_floor: bool = False, has_sensors: bool = True) -> Any:
    """Return the `mujoco.MjModel` of a robot.

    Args:
        build: its MJCF.
        has_floor: compile `scene.xml`, in which the robot is on a floor.
        has_sensors: keep the sensors; each of the hundreds of rays of a lidar is one.

    Raises:
        YamaroError: MuJoCo is not installed, or refuses the robot.
    """
    from xml.etree import ElementTree

    mujoco = import_mujoco()
    files = dict(build.assets)
    text = build.xml() if has_sensors else without_sensors(build.xml())
    if has_floor:
        scene = files.pop(SCENE).decode()
        include = ElementTree.fromstring(scene).find("include")
        assert include is not None, "scenes are written with one"
        files[include.attrib["file"]] = text.encode()
        text = scene
    try:
        return mujoco.MjModel.from_xml_string(text, files)
    except ValueError as error:
        message = f"MuJoCo refuses the robot: {' '.join(str(error).split())}"
        raise failure("mujoco-refused", message, build.robot.span) from None


def without_sensors(mjcf: str) -> str:
    """Return an MJCF without its sensors, and without the sites that only sensors name."""
    from xml.etree import ElementTree

    root = ElementTree.fromstring(mjcf)
    freed: set[str | None] = set()
    for section in root.findall("sensor"):
        for each in section:
            freed.update(value for key, value in each.attrib.items() if key != "name")
        root.remove(section)
    for each in root.iter():
        if each.tag != "site":
            freed.difference_update(each.attrib.values())
    for around in list(root.iter()):
        for site in around.findall("site"):
            if site.get("name") in freed:
                around.remove(site)
    return ElementTree.tostring(root, encoding="unicode")


def import_mujoco() -> Any:
    """Return the module; raise YamaroError if it is not installed."""
    try:
        import mujoco
    except ImportError:
        message = "the evaluation needs the Python package 'mujoco', which is missing"
        raise failure_of_all("missing-extra", message, "<sweep>", HINT) from None
    return mujoco


# --- metrics by their words -------------------------------------------------------------------


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
        name, bracket, rest = word.strip().partition("(")
        if bracket and not rest.endswith(")"):
            hint = f"write it as in {KINDS['stable'].example}"
            raise failure("bad-metric", f"'{word}' has no closing parenthesis", span, hint=hint)
        name, inner = name.strip(), rest[:-1].strip()
        arguments = [each.strip() for each in inner.split(",")] if inner else []
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


def _is_duration(arguments: Sequence[str]) -> bool:
    if len(arguments) != 1:
        return False
    try:
        return 0 < float(arguments[0].removesuffix("s")) <= LONGEST
    except ValueError:
        return False


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
    "mass": _Kind(lambda variant, _: (variant.build.robot.mass,), {"": "kg"}, example="mass"),
    "reach": _Kind(
        _reach,
        {"": "m"},
        example="reach or reach(tool0)",
        takes=lambda names: len(names) <= 1,
        is_marked=True,
        packages=("numpy",),
    ),
    "bounding_box": _Kind(
        lambda variant, _: bounding_box(variant.build.robot, variant.build.finder),
        dict.fromkeys("xyz", "m"),
        example="bounding_box",
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
