"""Studies: sweeps as a file or the command line asks for them, and their plans."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from ...declared_arguments import ARGUMENTS, Declared, Listing, listing_of
from ...diagnostics import (
    Diagnostic,
    InputFault,
    Reporter,
    YamaroError,
    did_you_mean,
    failure,
    failure_of_all,
)
from ...files.loader import FileLoader, LoadError, decode
from ...options import Options, UsageError
from ...policy import Limits, Policy
from ...request import finder_for, reach_of, read_command_line, read_main, refusal_of_main
from ...runtime.files import Library
from ...runtime.predefined import plain_data
from ...source import Source, Span, holds_xml
from ...syntax.argument_section import PATH
from ...syntax.context import ParseContext, Rules
from ...syntax.values import parse_value
from ...targets.table import TARGETS
from ...terminal import shortened
from ...yaml.nodes import PLAIN, MappingNode, ScalarNode, SequenceNode, YamlNode, is_null
from ...yaml.reader import read
from .axes import (
    Axis,
    Choices,
    axis_of_data,
    axis_of_text,
    has_axis,
    passed_value,
    takes_text,
    words_in,
)
from .builder import file_hash
from .plan import (
    GRID,
    LARGEST_SEED,
    LATIN,
    METHODS,
    MOST_SAMPLES,
    SECONDS,
    Condition,
    Plan,
    Space,
    versions_for,
)
from .running import cores

T = TypeVar("T")

SWEEP = "sweep"
"""The root key of a study."""
KEYS = (
    "robot", "samples", "method", "seed", "vary", "fixed", "keep", "to", "metrics", "evaluate",
    "models",
)  # fmt: skip


class Written:
    """A value, and where it is written.

    Attributes:
        data: the value.
        texts: the same, with what is written in place of numbers and truth values.
        span: its place, or None if that is not in a file.
    """

    __slots__ = ("data", "span", "texts")

    def __init__(self, data: object, span: Span | None = None, texts: object = None) -> None:
        self.data = data
        self.span = span
        self.texts = data if texts is None else texts


class Study:
    """A sweep as it is asked for.

    Attributes:
        robot: the path of the robot's file.
        name: the study's file, or the robot's, for messages.
        vary: the axes by the names of their arguments, as they are written.
        fixed: what is passed to all variants.
        samples: how many variants, or None.
        method: how they are chosen, or None.
        seed: decides about what is random.
        keep: conditions that variants have to meet.
        formats: the output formats.
        metrics: the names of metrics, each with its place.
        evaluate: a function that evaluates variants, as `file.py:function`, or None.
        folder: where the path of that file begins.
        models: whether the models are kept.
        places: where each key is written.
    """

    __slots__ = (
        "evaluate", "fixed", "folder", "formats", "keep", "method", "metrics", "models", "name",
        "places", "robot", "samples", "seed", "vary",
    )  # fmt: skip

    def __init__(self, robot: str) -> None:
        """Sweep a robot, without saying how."""
        self.robot = robot
        self.name = robot
        self.vary: dict[str, Written] = {}
        self.fixed: dict[str, Written] = {}
        self.samples: int | None = None
        self.method: str | None = None
        self.seed = 0
        self.keep: list[Condition] = []
        self.formats: list[str] = []
        self.metrics: list[Written] = []
        self.evaluate: str | None = None
        self.folder = os.getcwd()
        self.models = False
        self.places: dict[str, Span] = {}


def read_study(path: str, limits: Limits) -> Study:
    """Return the study in a file; of a robot's file, one that only names the robot.

    Raises:
        YamaroError: the file cannot be read, or has errors.
    """
    try:
        data = FileLoader(limits).read(os.path.abspath(path))
    except LoadError as error:
        raise refusal_of_main(path, error) from None
    if holds_xml(path, data):
        return Study(path)
    source = decode(data, name=path, path=os.path.abspath(path))
    root = read(source, reporter=Reporter(), limits=limits)
    if isinstance(root, MappingNode):
        for key, node in root.pairs:
            if isinstance(key, ScalarNode) and key.text == SWEEP:
                return _Parser(source).study(root, node)
    return Study(path)


class _Parser:
    """Takes the file of a study apart, and collects what is wrong with it."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._errors: list[Diagnostic] = []

    def study(self, root: MappingNode, node: YamlNode) -> Study:
        """Return the study; raise YamaroError for all that is wrong with it."""
        for key, _ in root.pairs:
            if key.text != SWEEP:
                message = f"a study has one key, `{SWEEP}`, and no '{key.text}'"
                self._error(message, key.span(), f"move it under `{SWEEP}`")
        found = self._entries(node)
        study = Study("")
        study.name = self._source.name
        study.folder = os.path.dirname(self._source.path)
        study.places = {key: value.span() for key, value in found.items()}
        if "robot" in found:
            robot = self._text(found["robot"], "robot")
            base = os.path.dirname(self._source.name)
            study.robot = os.path.normpath(os.path.join(base, os.path.expanduser(robot)))
        else:
            self._error("a study needs the key `robot`", node.span(), "robot: leg.yaml")
        if "samples" in found:
            study.samples = self._integer(found["samples"], "samples", 1)
        if "seed" in found:
            study.seed = self._integer(found["seed"], "seed", 0)
        if "method" in found:
            study.method = self._text(found["method"], "method")
            if study.method not in METHODS:
                near = did_you_mean(study.method, METHODS)
                listed = near or f"the methods are {', '.join(METHODS)}"
                self._error(f"no method '{study.method}'", found["method"].span(), listed)
        study.vary = self._values(found.get("vary"), "vary", "{thigh: [0.2, 0.4]}")
        study.fixed = self._values(found.get("fixed"), "fixed", "{gripper: none}")
        for node in self._items(found.get("keep")):
            if not isinstance(node, ScalarNode) or not node.text.strip():
                hint = "quote one that holds a colon and a space"
                self._error("`keep` takes Python expressions", node.span(), hint)
                continue
            start = self._source.text.find(node.text, node.start)
            study.keep.append(
                Condition(node.text, name=self._source.name, file=self._source.text, start=start)
            )
        study.formats = self._texts(found.get("to"), "to")
        study.metrics = [
            Written(word, node.span())
            for node in self._items(found.get("metrics"))
            for word in words_in(self._text(node, "metrics"))
        ]
        if "evaluate" in found:
            study.evaluate = self._text(found["evaluate"], "evaluate")
        if "models" in found:
            models = self._data(found["models"])
            if not isinstance(models, bool):
                self._error("`models` takes true or false", found["models"].span())
            study.models = models is True
        if self._errors:
            raise YamaroError(sorted(self._errors, key=lambda each: each.span.start))
        return study

    def _values(self, node: YamlNode | None, key: str, example: str) -> dict[str, Written]:
        if node is None:
            return {}
        if not isinstance(node, MappingNode):
            if isinstance(node, ScalarNode) and not node.text:
                return {}
            self._error(f"`{key}` takes names with values: {example}", node.span())
            return {}
        found: dict[str, Written] = {}
        for name, value in node.pairs:
            if name.text in found:
                self._error(f"'{name.text}' is given twice", name.span())
            found[name.text] = Written(self._data(value), value.span(), _texts(value))
        return found

    def _entries(self, node: YamlNode) -> dict[str, YamlNode]:
        if not isinstance(node, MappingNode):
            self._error(f"`{SWEEP}` has keys such as `robot`, `samples`, `vary`", node.span())
            return {}
        found: dict[str, YamlNode] = {}
        for key, value in node.pairs:
            if key.text not in KEYS:
                hint = did_you_mean(key.text, KEYS) or f"the keys are {', '.join(KEYS)}"
                message = f"a study has no key '{key.text}'"
                self._errors += failure("unknown-key", message, key.span(), hint=hint).diagnostics
            elif key.text in found:
                self._error(f"`{key.text}` is given twice", key.span())
            else:
                found[key.text] = value
        return found

    def _items(self, node: YamlNode | None) -> list[YamlNode]:
        if node is None:
            return []
        return node.items if isinstance(node, SequenceNode) else [node]

    def _texts(self, node: YamlNode | None, key: str) -> list[str]:
        return [word for each in self._items(node) for word in words_in(self._text(each, key))]

    def _text(self, node: YamlNode, key: str) -> str:
        if isinstance(node, ScalarNode) and node.text.strip():
            return node.text.strip()
        self._error(f"`{key}` takes a text", node.span())
        return ""

    def _integer(self, node: YamlNode, key: str, least: int) -> int:
        data = self._data(node)
        if isinstance(data, int) and not isinstance(data, bool) and data >= least:
            return data
        self._error(f"`{key}` takes an integer of at least {least}", node.span())
        return least

    def _data(self, node: YamlNode) -> object:
        try:
            value = parse_value(node, ParseContext(Reporter(), Rules()), is_literal=True)
        except YamaroError as error:
            self._errors += error.diagnostics
            return None
        return plain_data(value)

    def _error(self, message: str, span: Span, hint: str | None = None) -> None:
        self._errors += failure("bad-sweep", message, span, hint=hint).diagnostics


def _texts(node: YamlNode) -> object:
    """Return what is written, without reading it as numbers and truth values."""
    if isinstance(node, ScalarNode):
        return None if is_null(node.text) and node.style == PLAIN else node.text
    if isinstance(node, SequenceNode):
        return [_texts(item) for item in node.items]
    assert isinstance(node, MappingNode)
    return {key.text: _texts(value) for key, value in node.pairs}


# --- the plan of a study: what the robot's file declares of what is asked ---------------------


_FOR_ALL = ("undefined-name", "unsafe-code")
"""The codes of what is wrong with a condition for all variants alike."""


def listing_for(path: str, policy: Policy, packages: Mapping[str, str]) -> Listing:
    """Return what may be passed to the file of a robot.

    Raises:
        YamaroError: it has errors.
        UsageError: it cannot be read.
    """
    reach = reach_of(path, policy, packages)
    loader = FileLoader(policy.limits, reach)
    source = read_main(path, None, Library(loader))
    finder = finder_for(path, reach, packages)
    return listing_of(source, loader=loader, packages=finder, limits=policy.limits)


def planned(
    study: Study,
    options: Options,
    *,
    axes: Mapping[str, str],
) -> Plan:
    """Return the plan of a study.

    Args:
        study: what is asked for.
        options: those of the builds; its `command_line` is passed to all variants.
        axes: axes as on the command line, by the names of their arguments.

    Raises:
        YamaroError: the study or the robot has errors.
        UsageError: the command line has, or the robot cannot be read.
    """
    policy, assignments = options.policy, options.command_line
    listing = listing_for(study.robot, policy, options.packages)
    known = {declared.name: declared for declared in listing.declared}
    reader = _Reader(study, listing, known)
    packages = {name: os.path.abspath(path) for name, path in options.packages.items()}
    options = options.changed(command_line=(), packages=packages)
    plan = Plan(os.path.abspath(study.robot), reader.axes(axes, assignments), options)
    plan.limit_time(policy.timeout or SECONDS)
    plan.fixed = reader.fixed(assignments)
    reader.check_all_given(plan)
    plan.conditions = study.keep
    _settle_method(plan, study)
    space = Space(plan)
    try:
        space.is_kept(next(space.variants(0, 1)))
    except YamaroError as error:
        if error.diagnostics[0].code in _FOR_ALL:
            raise
    plan.formats = list(dict.fromkeys(study.formats))
    for format in plan.formats:
        if format not in TARGETS:
            hint = did_you_mean(format, list(TARGETS)) or f"the formats are {', '.join(TARGETS)}"
            raise _wrong(study, "to", f"'{format}' is not a known output format", hint)
    plan.models = study.models
    plan.memory = policy.limits.memory
    try:  # a worker's share of what there is
        there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
        plan.memory = min(plan.memory, there // cores())
    except (AttributeError, ValueError, OSError):
        pass
    _settle_evaluation(plan, study)
    plan.versions = versions_for(plan)
    plan.files[plan.robot] = file_hash(plan.robot)
    return plan


class _Reader:
    """Reads axes and values of a study for the arguments of a robot."""

    def __init__(self, study: Study, listing: Listing, known: Mapping[str, Declared]) -> None:
        self._study = study
        self._listing = listing
        self._known = known

    def axes(self, words: Mapping[str, str], assignments: Sequence[str]) -> list[Axis]:
        """Return the axes: those asked for, or else all that the file declares."""
        study = self._study
        fixed = {*study.fixed, *(text.partition(":=")[0] for text in assignments)}
        written = {name: value for name, value in study.vary.items() if name not in words}
        if not written and not words and "vary" not in study.places:
            found = [
                axis_of_data(declared, None)
                for declared in self._known.values()
                if has_axis(declared) and declared.name not in fixed
            ]
            if not found:
                raise self._failure(
                    "nothing varies: no argument of the file has a range or choices",
                    self._study.places.get("robot"),
                    "say what to vary, such as thigh=0.2..0.4",
                )
            return found
        found = []
        for name, value in written.items():
            if name not in fixed:
                declared = self._declared(name, value.span)
                axis = self._read(axis_of_data, declared, value)
                found.append(_with_paths(axis, declared, study.folder))
        for name, text in words.items():
            declared = self._declared(name, None)
            try:
                axis = axis_of_text(declared, text)
            except InputFault as fault:
                raise _usage(fault, f"{name}={text}") from None
            found.append(_with_paths(axis, declared, os.getcwd()))
        for name in words:
            if name in fixed:
                raise UsageError(f"'{name}' is given a value, and an axis as well")
        if not found:
            hint = "name an argument under `vary`, such as thigh: [0.2, 0.4]"
            raise self._failure("nothing varies", self._study.places.get("vary"), hint)
        return found

    def fixed(self, assignments: Sequence[str]) -> dict[str, object]:
        """Return what is passed to all variants."""
        found = {}
        for name, written in self._study.fixed.items():
            declared = self._declared(name, written.span)
            passed = self._read(passed_value, declared, written)
            found[name] = _absolute(declared, passed, self._study.folder)
        values, _ = read_command_line(assignments)
        for text in assignments:
            name, _, spelling = text.partition(":=")
            declared = self._declared(name, None)
            value = values[declared.key]
            is_text = isinstance(value, (str, list, dict))
            try:
                value = passed_value(declared, value, spelling=None if is_text else spelling)
            except InputFault as fault:
                raise _usage(fault, text) from None
            found[name] = _absolute(declared, value, os.getcwd())
        return found

    def check_all_given(self, plan: Plan) -> None:
        """Raise UsageError or YamaroError if an argument without a default has no value."""
        if self._listing.kind != ARGUMENTS:
            return
        given = {*plan.fixed, *(axis.name for axis in plan.axes)}
        for declared in self._known.values():
            if declared.is_required and declared.name not in given:
                raise failure(
                    "missing-argument",
                    f"'{self._study.robot}' needs the argument '{declared.name}'",
                    declared.span,
                    hint=f"vary it, or pass it to all variants: {declared.name}:=VALUE",
                )

    def _read(self, read: Callable[[Declared, object], T], declared: Declared, value: Written) -> T:
        """Return what is written of an argument; the fault of a wrong value is at its place."""
        try:
            return read(declared, value.texts if takes_text(declared) else value.data)
        except InputFault as fault:
            raise self._failure(fault.message, value.span, fault.hint, code=fault.code) from None

    def _declared(self, name: str, span: Span | None) -> Declared:
        """Return what the file declares of a name; a file without arguments takes any."""
        declared = self._known.get(name)
        if declared is not None:
            return declared
        if self._listing.kind == ARGUMENTS or not name.isidentifier():
            listed = ", ".join(self._known) or "none"
            hint = did_you_mean(name, self._known) or f"its arguments are {listed}"
            message = f"'{self._study.robot}' has no argument '{name}'"
            if span is None:
                raise UsageError(f"{message}; {hint}")
            raise failure("unknown-argument", message, span, hint=hint)
        from ...source import Source, Span

        return Declared(name, Span(Source(name, name=self._study.name), 0, len(name)))

    def _failure(
        self, message: str, span: Span | None, hint: str | None = None, code: str = "bad-sweep"
    ) -> YamaroError:
        if span is not None:
            return failure(code, message, span, hint=hint)
        return failure_of_all(code, message, self._study.name, hint)


def _absolute(declared: Declared, value: object, folder: str) -> object:
    """Return a value with a path in it as one that is the same wherever it is passed."""
    is_path = declared.entry is not None and declared.entry.kind == PATH
    if is_path and isinstance(value, str) and value and "://" not in value:
        return os.path.normpath(os.path.join(folder, os.path.expanduser(value)))
    return value


def _with_paths(axis: Axis, declared: Declared, folder: str) -> Axis:
    """Return an axis whose paths are the same wherever they are passed."""
    has_own = declared.entry is not None and declared.entry.choices is not None
    if isinstance(axis, Choices) and not has_own:
        axis.choices = [_absolute(declared, choice, folder) for choice in axis.choices]
    return axis


def _usage(fault: InputFault, word: str) -> UsageError:
    return UsageError(f"'{word}': {fault.message}" + (f"; {fault.hint}" if fault.hint else ""))


# --- how many, and which ---


def _settle_method(plan: Plan, study: Study) -> None:
    """Set method, seed and number of samples."""
    plan.seed = study.seed
    if not 0 <= plan.seed <= LARGEST_SEED:
        raise _wrong(study, "seed", f"a seed is an integer from 0 to {LARGEST_SEED}")
    plan.method = study.method or (GRID if study.samples is None else LATIN)
    if plan.method not in METHODS:
        hint = did_you_mean(plan.method, METHODS) or f"the methods are {', '.join(METHODS)}"
        raise _wrong(study, "method", f"no method '{plan.method}'", hint)
    if plan.method == GRID:
        plan.samples = _grid_size(plan, study)
    elif study.samples is None:
        message = f"the method '{plan.method}' needs to know how many variants to build"
        in_study = "method" in study.places
        hint = "add samples: 1000" if in_study else "add --samples 1000"
        raise _wrong(study, "method", message, hint)
    else:
        plan.samples = study.samples
    most = MOST_SAMPLES[plan.method]
    if not 1 <= plan.samples <= most:
        allowed = f"the method '{plan.method}' builds from 1 to {most:,} variants"
        raise _wrong(study, "samples", f"{allowed}, and not {plan.samples:,}")


def _grid_size(plan: Plan, study: Study) -> int:
    size = 1
    for axis in plan.axes:
        if axis.count is None:
            message = f"a grid needs to know how many values '{axis.name}' takes"
            hint = "give it `step` or `points`, or choose --samples and another method"
            span = study.vary[axis.name].span if axis.name in study.vary else None
            if span is not None:
                raise failure("bad-sweep", message, span, hint=hint)
            raise UsageError(f"{message}: {axis.name}=0.2..0.4/5 has 5; or add --samples N")
        size *= axis.count
    if study.samples is not None and study.samples != size:
        message = f"the grid has {size:,} points, and `samples` says {study.samples:,}"
        name = "`samples`" if "samples" in study.places else "--samples"
        raise _wrong(study, "samples", message, f"leave {name} out")
    return size


def _wrong(study: Study, key: str, message: str, hint: str | None = None) -> Exception:
    """Return the error about an entry: at its place, or about the command line if it has none."""
    span = study.places.get(key)
    if span is not None:
        return failure("bad-sweep", message, span, hint=hint)
    return UsageError(message if hint is None else f"{message}; {hint}")


def _settle_evaluation(plan: Plan, study: Study) -> None:
    """Set how variants are evaluated; raise YamaroError if that makes no sense."""
    if not study.metrics and not study.evaluate:
        return
    span = study.places.get("evaluate")
    if study.evaluate and span is not None and not plan.options.policy.is_trusted:
        raise failure(
            "unsafe-code",
            f"the study evaluates with '{shortened(study.evaluate)}', which no mode confines",
            span,
            hint=f"if you trust it, name it yourself: --evaluate {shortened(study.evaluate)}",
        )
    from .evaluation import Evaluation

    words = [metric.data for metric in study.metrics]
    spans = [metric.span for metric in study.metrics]
    plan.evaluation = Evaluation.parse(
        [str(word) for word in words],
        study.evaluate,
        study.folder,
        spans=[span for span in spans if span is not None] if all(spans) else None,
        hook_span=span,
    )
    if study.evaluate:
        path = os.path.abspath(os.path.join(study.folder, study.evaluate.rpartition(":")[0]))
        plan.files[path] = file_hash(path)
