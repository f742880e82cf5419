"""Evaluation of variants: metrics, and the results of a function of the user's."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from inspect import Parameter, signature
from math import isfinite
from types import ModuleType
from typing import Any

from ...diagnostics import Frame, YamaroError, did_you_mean, failure
from ...files.regular import open_regular
from ...runtime.modules import LocalModules
from ...source import Source, Span
from ...targets.table import TARGETS
from ...terminal import shortened
from .builder import Variant
from .metrics import FORMAT, Metric, compiled, metrics_of, span_of_word

Number = float | int | bool


TEXTS = tuple(each.name for each in TARGETS.values() if not each.is_folder)
"""Parameters that take the document of an output format, as text."""
PARAMETERS = ("arguments", "model", "scene", "robot", "index", *TEXTS)
"""What a function may ask for, by the names of its parameters."""
UNITS = "UNITS"
"""The dict in the module that holds the units of its results."""

_OWN_FOLDER = __file__.rpartition("tools")[0]


class Hook:
    """A function that evaluates variants.

    It is loaded where it is used, so that it can be sent to other processes.

    Attributes:
        parameters: what it asks for.
        needs: the output formats that it asks for.
        packages: the Python packages that what it asks for is made with.
        units: the units of its results, as far as the module says them.
        place: the line that it begins in.
    """

    def __init__(self, word: str, folder: str, span: Span | None = None) -> None:
        """Find and load a function.

        Args:
            word: `FILE.py:FUNCTION`.
            folder: where the path starts.
            span: where that is written.

        Raises:
            YamaroError: there is no such file or function, it cannot be loaded, or has a parameter
                that is unknown and has no default.
        """
        span = span or Span(Source(word, name="<evaluate>"), 0, len(word))
        path, colon, self._name = word.rpartition(":")
        if not colon or not path.endswith(".py") or not self._name.isidentifier():
            message = f"'{shortened(word)}' is not a function of a Python file"
            raise failure("bad-evaluate", message, span, hint="write it as in walk.py:score")
        self._path = os.path.join(folder, path)
        self._shown = path
        if not os.path.isfile(self._path):
            hint = f"it was searched for in {folder}"
            raise failure("bad-evaluate", f"there is no file '{path}'", span, hint=hint)
        self._loaded: Callable[..., Any] | None = None
        self._files: list[str] = []
        function, module = self._load(span)
        self.parameters = self._parameters(function)
        formats = [name for name in self.parameters if name in TEXTS]
        has_model = not {"model", "scene"}.isdisjoint(self.parameters)
        self.needs = tuple(dict.fromkeys([*([FORMAT] if has_model else []), *formats]))
        self.packages = ("mujoco",) if has_model else ()
        self.units: dict[str, str] = getattr(module, UNITS, {})
        if not isinstance(self.units, dict) or not all(
            isinstance(text, str) for pair in self.units.items() for text in pair
        ):
            message = f"{UNITS} in '{self._shown}' is not a dict of texts"
            hint = f'write it as in {UNITS} = {{"speed": "m/s"}}'
            raise failure("bad-evaluate", message, self._line(self._path, 1), hint=hint)
        self.place = self._place_of(function)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_loaded": None}

    def described(self, folder: str) -> dict[str, Any]:
        """Return what decides about its results, as data: its code too; paths start at `folder`."""
        from hashlib import sha256

        codes = {}
        for path in self._files:
            with open_regular(path) as file:
                codes[os.path.relpath(path, folder)] = sha256(file.read()).hexdigest()
        path = os.path.relpath(self._path, folder)
        return {"function": f"{path}:{self._name}", "files": dict(sorted(codes.items()))}

    def values(self, variant: Variant) -> dict[str, Number | None]:
        """Return what the function returns for a variant.

        Raises:
            YamaroError: it raises an exception, or does not return a dict of numbers.
        """
        given = {name: _argument(name, variant) for name in self.parameters}
        function = self._loaded or self._load(None)[0]
        try:
            found = function(**given)
        except YamaroError:
            raise
        except (Exception, SystemExit) as error:
            raise self._failed(error) from None
        if not isinstance(found, dict):
            shown = shortened(repr(found))
            message = f"'{self._name}' returned {shown}, which is not a dict"
            hint = 'return names and numbers, as in {"speed": 0.4}'
            raise failure("evaluate-result", message, self.place, hint=hint)
        numbers: dict[str, Number | None] = {}
        for name, value in found.items():
            if not isinstance(name, str) or not name:
                message = f"'{self._name}' returned a result named {shortened(repr(name))}"
                hint = "the names of results are texts"
                raise failure("evaluate-result", message, self.place, hint=hint)
            numbers[name] = self._number(name, value)
        return numbers

    def _load(self, span: Span | None) -> tuple[Callable[..., Any], ModuleType]:
        """Return the function and its module, loaded with the modules beside it.

        Args:
            span: where the function is asked for; None if it was found there before.
        """
        folder, file = os.path.split(self._path)
        stem = file.removesuffix(".py")
        files: list[str] = []
        local = LocalModules(folder, {}, files.append)
        try:
            module = local.load(stem)
        except (Exception, SystemExit) as error:
            raise self._failed(error) from None
        function = getattr(module, self._name, None)
        if not callable(function):
            names = [name for name, each in vars(module).items() if callable(each)]
            names = [name for name in names if name[0] != "_"]
            hint = did_you_mean(self._name, names) or f"write `def {self._name}(model, arguments):`"
            message = f"'{self._shown}' has no function '{self._name}'"
            raise failure("bad-evaluate", message, span or self._line(self._path, 1), hint=hint)
        self._loaded = function
        self._files = files
        return function, module

    def _parameters(self, function: Callable[..., Any]) -> list[str]:
        """Return the names of the parameters; unknown ones keep their default.

        Raises:
            YamaroError: an unknown one has no default.
        """
        wanted = []
        for parameter in signature(function).parameters.values():
            if parameter.kind in (Parameter.VAR_POSITIONAL, Parameter.VAR_KEYWORD):
                continue
            if parameter.name in PARAMETERS and parameter.kind != Parameter.POSITIONAL_ONLY:
                wanted.append(parameter.name)
            elif parameter.default is Parameter.empty:
                message = f"the function '{self._name}' asks for '{parameter.name}'"
                known = f"its parameters can be {', '.join(PARAMETERS)}"
                hint = did_you_mean(parameter.name, PARAMETERS) or known
                raise failure("bad-evaluate", message, self._place_of(function), hint=hint)
        return wanted

    def _number(self, name: str, value: object) -> Number | None:
        item = getattr(value, "item", None)
        number = value
        if callable(item) and getattr(value, "shape", None) == ():  # of numpy, torch or jax
            number = item()
        if number is None or isinstance(number, bool):
            return number
        if isinstance(number, int):
            return int(number)
        if isinstance(number, float) and isfinite(number):
            return float(number)
        message = f"'{self._name}' returned {shortened(repr(value))} as '{name}'"
        hint = "results are finite numbers, True or False, or None if there is no value"
        raise failure("evaluate-result", message, self.place, hint=hint)

    def _failed(self, error: BaseException) -> YamaroError:
        """Return the error at the innermost line of the user's that an exception came through."""
        name = type(error).__name__
        if isinstance(error, SyntaxError) and error.filename and error.lineno:
            span = self._line(error.filename, error.lineno)
            return failure("evaluate-failed", f"{name}: {error.msg}", span)
        folder = os.path.dirname(self._path)
        span, trace, outside = self._line(self._path, 1), None, ""
        called = None
        traceback = error.__traceback__
        while traceback is not None:
            path = traceback.tb_frame.f_code.co_filename
            if os.path.dirname(path) == folder:
                if called is not None:
                    trace = Frame("called", traceback.tb_frame.f_code.co_name, called, parent=trace)
                span = called = self._line(path, traceback.tb_lineno)
                outside = ""
            elif os.path.isfile(path) and not path.startswith(_OWN_FOLDER):
                outside = f"{os.path.basename(path)}:{traceback.tb_lineno}"
            traceback = traceback.tb_next
        text = shortened(" ".join(str(error).split()))
        notes = [f"raised at {outside}"] if outside and called is not None else []
        message = f"{name}: {text}" if text else name
        return failure("evaluate-failed", message, span, notes=notes, trace=trace)

    def _place_of(self, function: Callable[..., Any]) -> Span:
        """Return the line that a function begins in."""
        code = getattr(function, "__code__", None)
        if code is None:
            return self._line(self._path, 1)
        return self._line(code.co_filename, code.co_firstlineno)

    def _line(self, path: str, line: int) -> Span:
        """Return a line of a file of the user's, without the space around it."""
        try:
            with open_regular(path) as file:
                text = file.read().decode("utf-8", "replace")
        except OSError:
            text = ""
        folder = os.path.dirname(self._path)
        shown = os.path.join(os.path.dirname(self._shown), os.path.relpath(path, folder))
        source = Source(text, name=shown, path=path)
        if line > len(source.line_starts()):
            return Span(source, 0, 0)
        written = source.line_text(line)
        start = source.line_starts()[line - 1]
        indent = len(written) - len(written.lstrip())
        return Span(source, start + indent, start + max(len(written.rstrip()), indent))


def _argument(name: str, variant: Variant) -> object:
    """Return what a function gets for a parameter."""
    build = variant.build
    if name == "arguments":
        return dict(variant.arguments)
    if name == "robot":
        return build.robot
    if name == "index":
        return variant.index
    if name in TEXTS:
        return build.outputs[name].xml()
    return compiled(build.outputs[FORMAT], has_floor=name == "scene")


class Evaluation:
    """The evaluation of each variant.

    Results depend on the variant alone. It can be sent to other processes.

    Attributes:
        needs: the output formats that it is worked out from.
        packages: the Python packages that have an influence on the results.
        units: the units of the columns that are known before, by their names; "" for none.
    """

    __slots__ = ("_hook", "_metrics", "needs", "packages", "units")

    def __init__(self, metrics: Sequence[Metric], hook: Hook | None) -> None:
        """Take metrics and a function as they were read; see `parse`."""
        self._metrics = tuple(metrics)
        self._hook = hook
        needs = [metric.needs for metric in metrics if metric.needs]
        self.needs = tuple(dict.fromkeys([*needs, *(hook.needs if hook else ())]))
        packages = [package for metric in metrics for package in metric.packages]
        packages += hook.packages if hook else ()
        self.packages = tuple(dict.fromkeys(packages))
        self.units: dict[str, str] = {}
        for metric in metrics:
            self.units.update(metric.units)
        if hook is not None:
            self.units.update(hook.units)

    @classmethod
    def parse(
        cls,
        metrics: Sequence[str],
        hook: str | None,
        folder: str,
        *,
        spans: Sequence[Span] | None = None,
        hook_span: Span | None = None,
    ) -> Evaluation:
        """Read what is to be worked out.

        Args:
            metrics: words such as `mass` and `stable(5)`.
            hook: `FILE.py:FUNCTION`, or None.
            folder: where the path of that file starts.
            spans: where the metrics are written, one for each.
            hook_span: where the function is.

        Raises:
            YamaroError: there is no such metric, file or function, or the file cannot be loaded.
        """
        found = metrics_of(metrics, spans or [span_of_word(word) for word in metrics])
        return cls(found, Hook(hook, folder, hook_span) if hook is not None else None)

    def described(self, folder: str) -> dict[str, Any]:
        """Return what decides about the results, as data; paths start at `folder`."""
        return {
            "metrics": [metric.word for metric in self._metrics],
            "evaluate": self._hook.described(folder) if self._hook is not None else None,
        }

    def __call__(self, variant: Variant) -> dict[str, Number | None]:
        """Return the results for a variant by the names of their columns; None for no value.

        Raises:
            YamaroError: a metric has no value for it, or the function fails.
        """
        found: dict[str, Number | None] = {}
        for metric in self._metrics:
            found.update(metric.values(variant))
        if self._hook is not None:
            results = self._hook.values(variant)
            twice = sorted(found.keys() & results.keys())
            if twice:
                message = f"the function returned '{twice[0]}', which is the name of a metric"
                raise failure("evaluate-result", message, self._hook.place, hint="rename one")
            found.update(results)
        return found
