"""Evaluates expectations, and shows the values in those that are not met."""

from __future__ import annotations

import ast
import os
import re

from ...diagnostics import Diagnostic, YamaroError, failure, suggest
from ...runtime.expressions import SafeEvaluator
from ...runtime.python_errors import Explainer
from ...runtime.scope import Home, Scope, SharedNames
from ...safe.limits import SafeLimits
from ...syntax.python import compile_expression
from ...terminal import shortened
from .files import without_trust
from .guards import READABLE, Approximate, ModelRuntime

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...model.robot import Robot
    from ...policy import Limits
    from ...source import Source
    from ...syntax.context import Rules
    from ...syntax.python import PythonCode

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
            return self._with_hints(without_trust(error.diagnostics))
        if is_met:
            return []
        notes = list(self._values(python))
        return failure(
            "expectation-failed", "this expectation is not met", python.span(), notes=notes
        ).diagnostics

    def _with_hints(self, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
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
        return _object_text(value)
    return shortened(repr(value))


def _object_text(value: object) -> str:
    from ...model.pose import Pose

    if isinstance(value, Pose):
        return f"a pose at {value_text(value.position)} with rpy {value_text(value.rpy)}"
    if isinstance(value, (dict, type({}.values()), type({}.keys()))):
        keys = ", ".join(map(str, value)) if not isinstance(value, type({}.values())) else ""
        count = f"{len(value)} items" if len(value) != 1 else "1 item"
        return f"{count}: {shortened(keys)}" if keys and len(value) <= MOST_ITEMS else count
    name = getattr(value, "name", "")
    return f"the {type(value).__name__.lower()} '{name}'" if name else repr(value)
