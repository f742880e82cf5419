"""Runs attacks in a process of its own: `python -m tests.hostile.escape_runner`.

Reads one JSON object a line (mode, text, steps), and writes one a line: what came of it, and which
canaries were reached. Python itself reports every file opened, process started or module imported
meanwhile.
"""

from __future__ import annotations

import builtins
import json
import math
import os
import resource
import statistics
import sys
import unicodedata  # noqa: F401 - Python itself needs it for names that are not ASCII
from types import SimpleNamespace
from typing import Any

import numpy as np

import yamaro.fixes
import yamaro.runtime.python_errors
import yamaro.terminal
import yamaro.units  # noqa: F401 - with those above, what the first message would import
from yamaro.diagnostics import Frame, YamaroError
from yamaro.namespace import Namespace
from yamaro.runtime.expressions import Evaluator
from yamaro.runtime.python_errors import Explainer
from yamaro.runtime.scope import Home, Scope, SharedNames
from yamaro.safe.code import compile_safe
from yamaro.safe.limits import SafeLimits, SafetyError
from yamaro.safe.runtime import SafeRuntime
from yamaro.source import Source, Span
from yamaro.syntax.context import Rules
from yamaro.syntax.python import PythonCode
from yamaro.yaml.nodes import FlexiDict, ScalarNode

MEMORY = 3 << 30
SECRET = "canary-in-the-environment"
HARMLESS_EVENTS = {"compile", "exec", "code.__new__", "builtins.id"}

watched: list[str] = []
is_watching = False


class SafePython(PythonCode):
    """An expression or block of statements, compiled for safe mode."""

    __slots__ = ("runtime",)
    runtime: SafeRuntime

    def compile(self, text: str, mode: str) -> None:
        self._code = self.runtime.bind(compile_safe(text, self.filename, mode))

    def span(self, start: int = 0, end: int | None = None) -> Span:
        whole = len(self.text)  # the text is all there is in the source
        return Span(self.node.source, start, whole if end is None else end)


class WatchedExplainer(Explainer):
    """An explainer that ends the watch when the attack is over and its error is looked at."""

    def explained(
        self, error: BaseException, python: PythonCode, scope: Scope, frame: Frame | None
    ) -> YamaroError:
        global is_watching
        is_watching = False
        return super().explained(error, python, scope, frame)


def watch(event: str, args: tuple[Any, ...]) -> None:
    # For the message of a syntax error Python looks for the file.
    is_own = event == "open" and str(args[0]).startswith("<yamaro attack")
    if is_watching and event not in HARMLESS_EVENTS and not is_own:
        watched.append(f"{event} {args!r:.100}")


def world() -> str:
    """Return what no attack may change."""
    kept = [vars(builtins), vars(math), vars(statistics), vars(np), vars(np.linalg)]
    of_numpy = np.get_printoptions(), np.geterr(), np.geterrcall()
    return repr([sorted((str(k), id(v)) for k, v in one.items()) for one in kept]) + repr(
        (os.environ, sorted(sys.modules), sys.getrecursionlimit(), os.getcwd(), of_numpy)
    )


def attack(mode: str, text: str, steps: int | None = None) -> dict[str, Any]:
    """Return what comes of running a text in safe mode, the way a conversion would."""
    global is_watching
    said: list[str] = []
    limits = SafeLimits(steps=steps) if steps else SafeLimits()
    runtime = SafeRuntime(limits, say=said.append)
    shared_names = SharedNames()
    legs = Namespace("Legs", shared_names.find)
    legs._add("count", 4)
    names = runtime.names({"find": lambda package: f"/opt/{package}", "file_dir": lambda: "/robot"})
    names |= {name: runtime.module(name) for name in ("math", "numpy", "statistics")}
    names["np"] = names["numpy"]
    source = Source(text, name="attack")
    scope = Scope(Home(source, "", names, None), shared_names, closure=None, caller=None)
    for name, value in {
        "numbers": [1, 2, 3],
        "words": {"a": 1, "b": [2]},
        "Legs": legs,
        "pairs": FlexiDict([("a", 1), ("a", 2)]),
    }.items():
        scope.declare(name, runtime.admit(value))
    node = ScalarNode(text, "|", source, 0, len(text))
    python = SafePython(text, node, 0, Rules(), opening="(" if mode == "eval" else "")
    python.runtime = runtime
    evaluator = Evaluator(lambda: WatchedExplainer({}, lambda name: [], limits), limits)
    before = world()
    watched.clear()
    is_watching = True
    try:
        result = run(evaluator, runtime, python, scope, mode)
    finally:
        is_watching = False
    result["reached"] = list(watched)
    if world() != before:
        result["reached"].append("the world was changed")
    if SECRET in repr(said) + result.get("value", "") + result.get("message", ""):
        result["reached"].append("the secret was read")
    return result


def run(
    evaluator: Evaluator, runtime: SafeRuntime, python: PythonCode, scope: Scope, mode: str
) -> dict[str, Any]:
    try:
        python.compile(f"({python.text}\n)" if mode == "eval" else python.text, mode)
        if mode == "exec":
            evaluator.execute(python, scope)
            value = None
        else:
            value = evaluator.evaluate(python, scope)
        return {"code": "harmless", "value": runtime.representation(value)}
    except YamaroError as error:
        found = error.diagnostics[0]
        at = python.text[found.span.start : found.span.end]
        code = found.code
        if code == "python-error":
            code = found.message.rpartition("(")[2].rstrip(")")
        return {"code": code, "at": at, "message": found.message, "hint": found.hint}
    except SafetyError as error:  # in the text, or in the value that came out
        at = ""
        if error.position is not None:
            line, column, end_line, end_column = error.position
            start = python.byte_position(line, column)
            at = python.text[start : python.byte_position(end_line, end_column)]
        return {"code": error.code, "at": at, "message": error.message, "hint": error.hint}
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        return {"code": type(error).__name__, "at": "", "message": str(error)}


def main() -> None:
    os.environ["SECRET"] = SECRET
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    attack("eval", "f'{statistics.mean([1, 2])} {1:.2f}'.split()")  # all there is to import
    attack("eval", "no_such_name + len(1)")
    attack("eval", "math.foo")
    attack("eval", "np.array([1.5]) / 0, str(np.zeros((2, 2))), np.median([1, 2]), 1 in np.ones(2)")
    sys.addaudithook(watch)
    for line in sys.stdin:
        asked = SimpleNamespace(**json.loads(line))
        print(json.dumps(attack(asked.mode, asked.text, asked.steps)), flush=True)


if __name__ == "__main__":
    main()
