"""Evaluates expectations: what they may read of a robot, and the values in those that fail."""

from __future__ import annotations

import ast
import os
import re
from math import isclose

from ...diagnostics import Diagnostic, YamaroError, failure, suggest
from ...model.extras import (
    Actuator,
    Base,
    Camera,
    CollisionSettings,
    Control,
    Group,
    Lidar,
    Loop,
    Ranger,
    Sensor,
    State,
    Surface,
)
from ...model.joint import Calibration, Dynamics, Joint, Limit, Mimic, SafetyController
from ...model.link import Collision, Inertial, Link, Material, Visual
from ...model.pose import Pose
from ...model.robot import Frame, Robot
from ...model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from ...model.values import ByName
from ...runtime.expressions import SafeEvaluator
from ...runtime.python_errors import Explainer
from ...runtime.scope import Home, Scope, SharedNames
from ...safe.limits import SafeLimits
from ...safe.runtime import SafeRuntime
from ...safe.values import a_type, function
from ...syntax.python import compile_expression
from ...terminal import shortened
from .files import without_trust

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any

    from ...model.robot import Robot
    from ...policy import Limits
    from ...safe.limits import SafeLimits
    from ...source import Source
    from ...syntax.context import Rules
    from ...syntax.python import PythonCode


# --- what they may read of a robot ------------------------------------------------------------


HIDDEN = frozenset(("element", "findings", "read_rest", "span", "trace"))
"""Attributes that are about the files, and not about the robot."""
CLASSES: tuple[type, ...] = (
    *(Robot, Frame, Link, Inertial, Visual, Collision, Material, Pose),
    *(Joint, Limit, Mimic, Dynamics, SafetyController, Calibration),
    *(Box, Capsule, Cylinder, Mesh, Sphere),
    *(Sensor, Camera, Lidar, Ranger, Actuator, Surface, State, Group, Loop, Control),
    *(Base, CollisionSettings),
)
METHODS: dict[type, frozenset[str]] = {
    Robot: frozenset(
        "center_of_mass free_joints joints_below material_of parent_joint pose poses".split()
    ),
    Pose: frozenset(("apply", "inverse", "matrix")),
    Inertial: frozenset(("matrix",)),
    **dict.fromkeys((Box, Capsule, Cylinder, Sphere), frozenset(("inertia", "volume"))),
}
STEPS = 1000
"""What a call of a method counts at least."""


def _readable(kind: type) -> frozenset[str]:
    """Return the attributes of a class that hold or work out values."""
    names: set[str] = set()
    for base in kind.__mro__:
        names.update(getattr(base, "__slots__", ()))
        names.update(name for name, each in vars(base).items() if isinstance(each, property))
        names.update(name for name in ("kind",) if name in vars(base))
    return frozenset(name for name in names if name[0] != "_") - HIDDEN


READABLE = {kind: _readable(kind) for kind in CLASSES}


class Approximate:
    """A number, or a row of numbers, that others are compared with up to rounding."""

    __slots__ = ("_rel", "_value", "_within")

    def __init__(self, value: Any, *, rel: float, within: float) -> None:
        self._value = value
        self._rel = rel
        self._within = within

    def __eq__(self, other: object) -> bool:
        return self._is_near(other, self._value)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None  # type: ignore[assignment]

    def _is_near(self, one: Any, other: Any) -> bool:
        if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
            return len(one) == len(other) and all(map(self._is_near, one, other))
        if isinstance(one, (int, float)) and isinstance(other, (int, float)):
            return isclose(one, other, rel_tol=self._rel, abs_tol=self._within)
        return bool(one == other)

    def __repr__(self) -> str:
        return f"{self._value!r} within {self._rel:g} of it or {self._within:g}"


class ModelRuntime(SafeRuntime):
    """Safe mode's guards, which let robots in."""

    def __init__(self, limits: SafeLimits) -> None:
        super().__init__(limits)
        self.foreign.update(dict.fromkeys((*CLASSES, Approximate), _one))
        self._names["approx"] = function(self._approx, "<function approx>")

    def expose(self, robot: Robot) -> dict[str, Any]:
        """Return what expectations see of a robot, by the names that they use."""
        return {
            "robot": robot,
            "link": function(robot.need_link, "<function link>"),
            "joint": function(robot.need_joint, "<function joint>"),
        }

    def _approx(self, value: Any, /, *, rel: Any = 1e-6, within: Any = 1e-9) -> Approximate:
        """Return a value that is equal to all that is near it."""
        self.measured(value)
        if not all(type(each) in (int, float) and each >= 0 for each in (rel, within)):
            raise TypeError("`rel` and `within` of approx are numbers")
        return Approximate(value, rel=rel, within=within)

    def attribute(self, owner: Any, name: str) -> Any:
        """Return `owner.name`, for reading."""
        kind = type(owner)
        known = READABLE.get(kind)
        if known is None:
            return super().attribute(owner, name)
        if name in known:
            value = getattr(owner, name)  # safe mode knows what things are by name as a dict
            return dict(value) if isinstance(value, ByName) else value
        methods = METHODS.get(kind, frozenset())
        if name in methods:
            method: Callable[..., Any] = getattr(owner, name)
            cost = STEPS + (len(owner.links) if isinstance(owner, Robot) else 0)

            def run(*args: Any, **named: Any) -> Any:
                self.charge(cost)
                for value in (*args, *named.values()):
                    self.measured(value)
                return method(*args, **named)

            return function(run, f"<method {name} of {a_type(owner)}>")
        from ...diagnostics import did_you_mean

        message = f"{a_type(owner)} has no attribute '{name}'"
        hint = did_you_mean(name, [*known, *methods])
        raise AttributeError(message + (f"; {hint}" if hint else ""))

    def _iterate(self, source: Any) -> Any:
        if type(source) in READABLE:
            raise TypeError(f"{a_type(source)} cannot be iterated over")
        return super()._iterate(source)


def _one(value: object) -> int:
    return 1


# --- expectations -----------------------------------------------------------------------------


MOST_VALUES = 12
"""Values of an expression that are shown."""
MOST_ITEMS = 8
"""Items whose names are shown."""
DIGITS = 9


class Expectations:
    """Evaluates the expectations of a test file about one robot."""

    def __init__(
        self, source: Source, robot: Robot | None, *, rules: Rules, limits: Limits
    ) -> None:
        """Begin.

        Args:
            source: the test file.
            robot: what they are about; None for XML that is not a robot.
            rules: how they are compiled.
            limits: how much they may use.
        """
        self._robot = robot
        self._rules = rules
        self._runtime = ModelRuntime(SafeLimits.of(limits))
        names = self._runtime.names()
        if robot is not None:
            names.update(self._runtime.expose(robot))
        home = Home(source, os.path.dirname(source.path), names, None)
        self._scope = Scope(home, SharedNames(), closure=None, caller=None)
        explainer = Explainer({}, lambda name: [], limits)
        self._evaluator = SafeEvaluator(lambda: explainer, limits, self._runtime)

    def failure(self, python: PythonCode) -> list[Diagnostic]:
        """Return why an expectation is not met; nothing if it is."""
        try:
            value = self._evaluator.evaluate(python, self._scope)
            if type(value) in READABLE or type(value) is Approximate:
                is_met = True
            else:
                is_met = bool(value)
        except YamaroError as error:
            diagnostics = without_trust(error.diagnostics)
            for diagnostic in diagnostics:
                unknown = re.match("there is no key '([^']*)'", diagnostic.message)
                if diagnostic.message.startswith("'Pose' object is not subscriptable"):
                    diagnostic.hint = "write .position[2], or .z"
                elif unknown is not None and self._robot is not None:
                    robot = self._robot
                    names = [*robot.joints, *robot.links, *robot.states, *robot.sensors]
                    near = suggest(unknown[1], names)
                    near = near or next((name for name in names if unknown[1] in name), None)
                    diagnostic.hint = f"did you mean '{near}'?" if near is not None else None
            return diagnostics
        if is_met:
            return []
        notes = list(self._values(python))
        return failure(
            "expectation-failed", "this expectation is not met", python.span(), notes=notes
        ).diagnostics

    def _values(self, python: PythonCode) -> Iterator[str]:
        """Yield the values of what the expression is made of: `robot.mass = 7.2`."""
        shown: dict[str, None] = {}
        tree = ast.parse(f"({python.text}\n)", mode="eval").body
        for node in _parts(tree):
            start = python.byte_position(node.lineno, node.col_offset)
            end = python.byte_position(node.end_lineno or 1, node.end_col_offset or 0)
            text = python.text[start:end]
            key = " ".join(text.split())
            if key in shown or text.strip() == python.text.strip():
                continue
            try:
                part = compile_expression(text, python.node, python.index + start, self._rules)
                value = self._evaluator.evaluate(part, self._scope)
            except YamaroError:
                continue  # such as a name that only exists in a loop
            if type(value) is Approximate:
                continue  # it is what it says
            shown[key] = None
            yield f"{shortened(key)} = {value_text(value)}"
            if len(shown) == MOST_VALUES:
                return


def _parts(node: ast.expr) -> Iterator[ast.expr]:
    """Yield the parts of an expression whose values say why it is what it is, outer ones first."""
    if isinstance(node, (ast.Constant, ast.Lambda, ast.GeneratorExp, ast.ListComp)):
        return
    if not isinstance(node, (ast.BoolOp, ast.List, ast.Tuple, ast.Starred)):
        yield node
    inner: list[ast.expr] = []
    if isinstance(node, ast.Compare):
        inner = [node.left, *node.comparators]
    elif isinstance(node, ast.BoolOp):
        inner = node.values
    elif isinstance(node, ast.BinOp):
        inner = [node.left, node.right]
    elif isinstance(node, ast.UnaryOp):
        inner = [node.operand]
    elif isinstance(node, ast.Call):
        inner = [*node.args, *(keyword.value for keyword in node.keywords)]
    elif isinstance(node, (ast.List, ast.Tuple)):
        inner = node.elts
    for each in inner:
        yield from _parts(each)


def value_text(value: object) -> str:
    """Return a value as it is shown: numbers without the digits of rounding."""
    if isinstance(value, float):
        return f"{value:.{DIGITS}g}"
    if isinstance(value, tuple):
        inner = ", ".join(map(value_text, value))
        return f"({inner},)" if len(value) == 1 else f"({inner})"
    if isinstance(value, list):
        return f"[{', '.join(map(value_text, value))}]"
    if type(value) in READABLE or isinstance(value, (dict, type({}.values()), type({}.keys()))):
        from ...model.pose import Pose

        if isinstance(value, Pose):
            return f"a pose at {value_text(value.position)} with rpy {value_text(value.rpy)}"
        if isinstance(value, (dict, type({}.values()), type({}.keys()))):
            keys = ", ".join(map(str, value)) if not isinstance(value, type({}.values())) else ""
            count = f"{len(value)} items" if len(value) != 1 else "1 item"
            return f"{count}: {shortened(keys)}" if keys and len(value) <= MOST_ITEMS else count
        name = getattr(value, "name", "")
        return f"the {type(value).__name__.lower()} '{name}'" if name else repr(value)
    return shortened(repr(value))
