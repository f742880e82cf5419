"""Makes a plan of a study: looks up what the robot's file declares, and checks what is asked."""

from __future__ import annotations

import os

from ...diagnostics import InputFault, YamaroError, did_you_mean, failure, failure_of_all
from ...files.loader import FileLoader
from ...options import UsageError
from ...request import finder_for, reach_of, read_command_line, read_main
from ...runtime.library import Library
from ...syntax.argument_types import PATH
from ...targets.writers import ENDINGS
from ...terminal import shortened
from ..declared_arguments import ARGUMENTS, Declared, listing_of
from .axes import Axis, Choices
from .axis_reading import axis_of_data, axis_of_text, has_axis, passed_value, takes_text
from .builder import file_hash
from .engines import cores
from .methods import GRID, LARGEST_SEED, LATIN, METHODS, MOST_SAMPLES
from .plan import SECONDS, Plan, Space, versions_for

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import TypeVar

    from ...options import Options
    from ...policy import Policy
    from ...source import Span
    from ..declared_arguments import Listing
    from .study import Study, Written

    T = TypeVar("T")

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
    _check_conditions(plan)
    plan.formats = list(dict.fromkeys(study.formats))
    _check_formats(study)
    plan.models = study.models
    plan.memory = _memory(policy)
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
        found = [self._axis(name, value) for name, value in written.items() if name not in fixed]
        found += [self._axis_of_word(name, text) for name, text in words.items()]
        for name in words:
            if name in fixed:
                raise UsageError(f"'{name}' is given a value, and an axis as well")
        if not found:
            hint = "name an argument under `vary`, such as thigh: [0.2, 0.4]"
            raise self._failure("nothing varies", self._study.places.get("vary"), hint)
        return found

    def fixed(self, assignments: Sequence[str]) -> dict[str, object]:
        """Return what is passed to all variants."""
        found = {name: self._passed(name, value) for name, value in self._study.fixed.items()}
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

    def _axis(self, name: str, value: Written) -> Axis:
        declared = self._declared(name, value.span)
        axis = self._read(axis_of_data, declared, value)
        return _with_paths(axis, declared, self._study.folder)

    def _axis_of_word(self, name: str, text: str) -> Axis:
        declared = self._declared(name, None)
        try:
            axis = axis_of_text(declared, text)
        except InputFault as fault:
            raise _usage(fault, f"{name}={text}") from None
        return _with_paths(axis, declared, os.getcwd())

    def _passed(self, name: str, value: Written) -> object:
        declared = self._declared(name, value.span)
        passed = self._read(passed_value, declared, value)
        return _absolute(declared, passed, self._study.folder)

    def _read(self, read: Callable[[Declared, object], T], declared: Declared, value: Written) -> T:
        """Return what is written of an argument; the fault of a wrong value is at its place."""
        try:
            return read(declared, _data(declared, value))
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


def _data(declared: Declared, value: Written) -> object:
    return value.texts if takes_text(declared) else value.data


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


def _check_conditions(plan: Plan) -> None:
    """Raise YamaroError if conditions cannot be evaluated whatever the variant is."""
    space = Space(plan)
    try:
        space.is_kept(next(space.variants(0, 1)))
    except YamaroError as error:
        if error.diagnostics[0].code in _FOR_ALL:
            raise


def _check_formats(study: Study) -> None:
    for format in study.formats:
        if format not in ENDINGS:
            hint = did_you_mean(format, list(ENDINGS)) or f"the formats are {', '.join(ENDINGS)}"
            raise _wrong(study, "to", f"'{format}' is not a known output format", hint)


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


def _memory(policy: Policy) -> int:
    """Return how much memory the process of a worker may have: its share of what there is."""
    most = policy.limits.memory
    try:
        there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return most
    return min(most, there // cores())
