"""The functions that the package offers: `yamaro.sweep` and `yamaro.sweep_batch`."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ...options import Options, UsageError
from ...policy import Policy
from ...source import Public
from .builder import write_index
from .folder import KeptModel, Shown, SweepFolder, kept_models, show
from .plan import Plan
from .running import Engine, Status, chunk_size, engine_of, run_plan
from .study import Study, Written, planned, read_study
from .table import CSV, PARQUET, Summary, has_parquet, read_columns

if TYPE_CHECKING:
    from .batch import Batch


class Sweep(Public):
    """A sweep that was run, or the one in a folder.

    Attributes:
        folder: the absolute path of its folder.
    """

    __slots__ = ("folder",)

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """Look at the sweep in a folder."""
        self.folder = os.path.abspath(folder)

    def columns(self, *names: str) -> dict[str, list[Any]]:
        """Return the columns of the table, all or those named, in the order of the variants."""
        return read_columns(self.folder, ("id", *names) if names else ())

    def summary(self) -> Summary:
        """Return how many variants are there, and why others failed."""
        return Summary(self.folder)

    def models(self, format: str | None = None, *, has_scene: bool = False) -> Iterator[KeptModel]:
        """Yield the models that were kept, in the order of the variants.

        Args:
            format: the output format; by default the first one of the sweep.
            has_scene: of MJCF, whether the robot is on a floor.

        Raises:
            UsageError: the sweep has not kept such models.
        """
        return kept_models(self.folder, format, has_scene=has_scene)

    def variant(self, index: int, *, policy: Policy | None = None) -> Shown:
        """Build a variant again.

        Raises:
            YamaroError: it has errors.
            UsageError: there is no such variant.
        """
        return show(self.folder, index, policy or Policy())


def sweep(
    path: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    vary: Mapping[str, object] | None = None,
    fixed: Mapping[str, object] | None = None,
    samples: int | None = None,
    method: str | None = None,
    seed: int | None = None,
    keep: str | Sequence[str] = (),
    to: str | Sequence[str] = (),
    metrics: str | Sequence[str] = (),
    evaluate: str | None = None,
    models: bool = False,
    engine: str = "local",
    resume: bool = False,
    chunk: int | None = None,
    timeout: float | None = None,
    policy: Policy | None = None,
    packages: Mapping[str, str] | None = None,
    allow: Sequence[str] = (),
    deny: Sequence[str] = (),
    strict: bool = False,
    on_progress: Callable[[float], None] | None = None,
) -> Sweep:
    """Build many variants of a robot, and write a table of them.

    Args:
        path: a robot's file, or a study; what is given here goes before what the study says.
        output: the folder of the sweep.
        vary: the axes by the names of arguments: `[0.2, 0.4]`, `"log:10..500"`,
            `{"choices": [4, 6]}`, or None for an argument's own range. By default all arguments
            that declare a range or choices.
        fixed: what is passed to all variants.
        samples: how many variants; a grid knows.
        method: "grid", "random", "latin" or "sobol".
        seed: decides about what is random; 0 by default.
        keep: conditions that variants have to meet, as Python expressions.
        to: the output formats.
        metrics: the names of metrics.
        evaluate: a function that evaluates variants, as "file.py:function".
        models: whether the documents are kept.
        engine: "local", "local:8", "dask://HOST:PORT" or "dask".
        resume: whether the sweep in the folder goes on.
        chunk: how many variants are stored together; by default as many as take two seconds.
        timeout: seconds that a variant may take, 60 by default.
        policy: how far the robot's files are trusted; in full by default.
        packages: folders of ROS packages by name.
        allow: codes of diagnostics that are warnings.
        deny: codes of diagnostics that are errors.
        strict: whether warnings are errors.
        on_progress: is called with how far the work is, from 0 to 1.

    Raises:
        YamaroError: the study or the robot has errors, or no variant can be built.
        UsageError: an argument makes no sense, or the folder holds something else.
    """
    options = Options(policy=policy, packages=packages, allow=allow, deny=deny, strict=strict)
    plan = _plan(
        path, options, vary, fixed, timeout, samples=samples, method=method, seed=seed,
        keep=_listed(keep), to=_listed(to), metrics=_listed(metrics), evaluate=evaluate,
        models=models or None,
    )  # fmt: skip
    plan.chunk = chunk or 0
    run_sweep(plan, output, engine_of(engine), resumes=resume, on_progress=_teller(on_progress))
    return Sweep(output)


def sweep_batch(
    path: str | os.PathLike[str],
    *,
    vary: Mapping[str, object] | None = None,
    fixed: Mapping[str, object] | None = None,
    samples: int | None = None,
    method: str | None = None,
    seed: int | None = None,
    keep: str | Sequence[str] = (),
    engine: str = "local",
    timeout: float | None = None,
    policy: Policy | None = None,
    packages: Mapping[str, str] | None = None,
    allow: Sequence[str] = (),
    deny: Sequence[str] = (),
    strict: bool = False,
    on_progress: Callable[[float], None] | None = None,
) -> Batch:
    """Build many variants of one topology as a model and arrays, for simulators of many worlds.

    The arguments are those of `sweep`. The engine is of this machine: "local", or "local:8".

    Raises:
        YamaroError: the study or the robot has errors, no variant can be built, or an argument
            changes more than numbers.
        UsageError: an argument makes no sense.
    """
    from .batch import build_batch

    options = Options(policy=policy, packages=packages, allow=allow, deny=deny, strict=strict)
    plan = _plan(
        path, options, vary, fixed, timeout, samples=samples, method=method, seed=seed,
        keep=_listed(keep),
    )  # fmt: skip
    return build_batch(plan, engine, _teller(on_progress))


def _plan(
    path: str | os.PathLike[str],
    options: Options,
    vary: Mapping[str, object] | None,
    fixed: Mapping[str, object] | None,
    timeout: float | None,
    **others: Any,
) -> Plan:
    """Return the plan of a robot or a study; `others` is what `override` takes."""
    study = read_study(os.fspath(path), options.policy.limits)
    if vary is not None:
        study.vary = {name: Written(value) for name, value in vary.items()}
        study.places.pop("vary", None)
    if fixed is not None:
        study.fixed = {name: Written(value) for name, value in fixed.items()}
    override(study, **others)
    plan = planned(study, options, axes={})
    if timeout is not None:
        plan.limit_time(timeout)
    return plan


def _teller(on_progress: Callable[[float], None] | None) -> Callable[[Status], None]:
    def tell(status: Status) -> None:
        if on_progress is not None:
            on_progress(status.done / status.samples)

    return tell


def override(
    study: Study,
    *,
    samples: int | None = None,
    method: str | None = None,
    seed: int | None = None,
    keep: Sequence[str] = (),
    to: Sequence[str] = (),
    metrics: Sequence[str] = (),
    evaluate: str | None = None,
    models: bool | None = None,
) -> None:
    """Change a study where something else is asked for; conditions are added."""
    from .plan import Condition

    for name, value in (("samples", samples), ("method", method), ("seed", seed)):
        if value is not None:
            setattr(study, name, value)
            study.places.pop(name, None)
    study.keep = [*study.keep, *map(Condition, keep)]
    if to:
        study.formats = list(to)
        study.places.pop("to", None)
    if metrics:
        study.metrics = [Written(word) for word in metrics]
    if evaluate is not None:
        study.evaluate, study.folder = evaluate, os.getcwd()
        study.places.pop("evaluate", None)
    if models is not None:
        study.models = models


def run_sweep(
    plan: Plan,
    output: str | os.PathLike[str],
    open_engine: Callable[[], Engine],
    *,
    resumes: bool,
    on_progress: Callable[[Status], None],
) -> Status:
    """Run a plan, or what is left of it, in a folder; return how it went.

    Raises:
        YamaroError: no variant can be built, the plan is not that of the folder, or the engine
            fails.
        UsageError: the folder holds something else.
        OSError: something cannot be written.
    """
    folder = SweepFolder(os.fspath(output), PARQUET if has_parquet() else CSV)
    given = plan.chunk
    if given < 0:
        raise UsageError(f"a chunk has at least 1 variant, not {given}")
    goes_on = folder.begin(plan, resumes=resumes)
    try:
        engine = open_engine()
        try:
            if not goes_on:
                plan.chunk = given or chunk_size(plan, engine.workers)
                folder.save(plan)
            status = run_plan(plan, folder, engine, on_progress)
        finally:
            engine.close(plan.run)
        if plan.has_topologies:
            write_index(plan, folder.path)
        return status
    finally:
        folder.release()


def _listed(value: str | Sequence[str]) -> list[str]:
    return [value] if isinstance(value, str) else list(value)
