"""`yamaro sweep`: builds many variants of a robot, and writes a table of them."""

from __future__ import annotations

import os

from ...commands.arguments import make_policy, read_packages
from ...commands.command_table import ENDINGS, FILE_WORDS, Command
from ...commands.option_table import BUILDING, WRITING, Option
from ...commands.reports import (
    DONE,
    INPUT_ERROR,
    WrongUsage,
    deliver,
    goes_to_standard_output,
    near,
    quote,
    show,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...policy import Policy
    from ...streams import Streams
    from .plan import Plan
    from .running import Status

AXIS_HELP = (
    "thigh=0.2..0.4, thigh=0.2..0.4:0.05 in steps, legs=4,6, kp=log:10..500, gain=normal:1,0.05; "
    "by default all arguments with a range or choices"
)
COMMAND = Command(
    "sweep",
    (
        "STUDY -o FOLDER",
        "FILE [name=AXIS ...] [name:=value ...] --samples N -o FOLDER",
        "show FOLDER NUMBER",
    ),
    "build many variants of a robot, and a table of them",
    "Build a robot with many values of its arguments, and write a table of them: the "
    "values, whether each variant could be built, and what was measured of it. See "
    "docs/sweeps.md.",
    words=(
        ("STUDY", "a YAML file with the key `sweep`"),
        FILE_WORDS[0],
        ("name=AXIS", AXIS_HELP),
        ("name:=value", "pass a value to all variants"),
        ("show", "build variant NUMBER of the sweep in FOLDER again"),
    ),
    endings=ENDINGS,
    examples=(
        "yamaro sweep leg.yaml thigh=0.2..0.4 legs=4,6 --samples 1000 -o runs/",
        "yamaro sweep study.yaml -o runs/ --engine dask://host:8786 --resume",
        "yamaro sweep show runs/ 4711 > variant.urdf",
    ),
    takes_several=True,
    place=12,
    options=(
        "output",
        "to",
        *WRITING,
        Option("samples", "how many variants; a grid knows", value="N", wants="a whole number"),
        Option(
            "method",
            "how variants are chosen: latin (with --samples), grid (the default without), random "
            "or sobol",
            value="METHOD",
            wants="grid, random, latin or sobol",
            choices=("grid", "random", "latin", "sobol"),
        ),
        Option("seed", "seed of what is random; 0 by default", value="N", wants="a number"),
        Option(
            "keep",
            "reject variants that do not meet this condition, such as 'thigh + shank < 0.7'",
            value="CONDITION",
            wants="a Python expression",
            is_repeatable=True,
        ),
        Option(
            "metrics",
            "measure this of each variant, such as mass,reach or 'stable(5)'",
            value="NAMES",
            wants="names of metrics",
            is_repeatable=True,
        ),
        Option(
            "evaluate",
            "evaluate each variant with a Python function of yours",
            value="FILE.py:FUNCTION",
            wants="FILE.py:FUNCTION",
        ),
        Option(
            "batch",
            "write one MJCF and arrays of the fields of MuJoCo's model that differ, for MJX, "
            "MuJoCo Warp and Newton, in place of a table",
            value="FILE.npz",
            wants="a file, such as batch.npz",
            completes="files",
        ),
        Option("models", "keep the documents too, in tar files"),
        Option(
            "engine",
            "where variants are built: local:8 (processes; the default, with all processors), "
            "dask://HOST:PORT, or dask:8 (a cluster on this machine)",
            value="ENGINE",
            wants="local:N, dask://HOST:PORT or dask:N",
            completes="local: dask:// dask:",
        ),
        Option("resume", "go on with the sweep in the folder, which was stopped"),
        *BUILDING,
    ),
    help_of={
        "output": ("the folder of the sweep: runs/; with 'show', a file"),
        "to": "build these output formats: {formats}, separated by commas",
        "quiet": ("show errors only: no summary"),
        "timeout": ("end a variant that takes longer; 60 by default"),
    },
)

SHOW = "show"


def run(arguments: Arguments, streams: Streams) -> int:
    """Run a sweep, or show one of its variants; return the exit status."""
    from ...diagnostics import YamaroError
    from ...options import UsageError

    arguments.resolve_output()
    policy = make_policy(arguments, looks=arguments.words[0] == SHOW)
    if not policy.is_trusted:
        streams.silence_libraries()
    try:
        if arguments.words[0] == SHOW:
            return _show(arguments, streams, policy)
        return _sweep(arguments, streams)
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    except OSError as error:
        name = quote(os.fspath(error.filename or arguments.options.get("output", "")))
        streams.say(f"yamaro: error: {name}: {error.strerror or error}")
        return INPUT_ERROR


# --- running ---


def _sweep(arguments: Arguments, streams: Streams) -> int:
    from .api import run_sweep
    from .running import engine_of
    from .table import Summary

    if arguments.has("batch"):
        return _batch(arguments, streams)
    if goes_to_standard_output(arguments):
        raise WrongUsage("'yamaro sweep' needs a folder for its table: -o runs/")
    open_engine = engine_of(arguments.options.get("engine"))
    plan = _plan(arguments)
    folder = arguments.options["output"]
    began = _Shown(streams)
    try:
        status = run_sweep(
            plan,
            folder,
            open_engine,
            resumes=arguments.has("resume"),
            on_progress=began.show,
        )
    except KeyboardInterrupt:
        began.clear()
        if began.status is not None and not streams.quiet:
            streams.say(
                f"stopped after {began.status.done:,} of {plan.samples:,} variants; "
                "the same command with --resume goes on"
            )
        raise
    finally:
        began.clear()
    summary = Summary(arguments.output_path)
    if not streams.quiet:
        took = "all variants were built before"
        if status.built:
            took = f"{status.built:,} in {_duration(status.seconds)}, {status.rate:,.1f}/s"
        streams.say("\n".join([f"{quote(folder)}: {took}", *summary.lines()]))
    return DONE if summary.counts["ok"] else INPUT_ERROR


def _batch(arguments: Arguments, streams: Streams) -> int:
    from time import monotonic

    from .batch import ENDING, build_batch

    path = arguments.options["batch"]
    if not path.endswith(ENDING):
        raise WrongUsage(f"'--batch' writes arrays of NumPy: name the file as in batch{ENDING}")
    for name in ("output", "to", "metrics", "evaluate", "models", "resume"):
        if arguments.has(name):
            raise WrongUsage(f"'--batch' and '--{name}' do not go together")
    plan = _plan(arguments)
    shown, began = _Shown(streams), monotonic()
    try:
        batch = build_batch(plan, arguments.options.get("engine"), shown.show)
    finally:
        shown.clear()
    batch.save(path)
    if not streams.quiet:
        took = _duration(monotonic() - began)
        streams.say("\n".join([f"{quote(path)}: {took}", *batch.lines()]))
    return DONE


class _Shown:
    """Shows how far a sweep is.

    Attributes:
        status: what was shown last.
    """

    def __init__(self, streams: Streams) -> None:
        from ...commands.progress import bar_on

        self._bar = bar_on(streams)
        self.status: Status | None = None

    def show(self, status: Status) -> None:
        """Show how far it is."""
        self.status = status
        if self._bar is None:
            return
        failed = f", {status.failed:,} failed" if status.failed else ""
        rate = status.rate
        left = (status.samples - status.done) / rate if rate else 0.0
        text = f"{status.done:,} of {status.samples:,}, {rate:,.1f}/s{failed}"
        self._bar.show_text(status.done / status.samples, f"{text}, {_duration(left)} left")

    def clear(self) -> None:
        """Take the bar off the terminal."""
        if self._bar is not None:
            self._bar.show(1.0)


def _duration(seconds: float) -> str:
    """Return a time in words: `42 s`, `3 min 20 s`, `2 h 5 min`."""
    whole = round(seconds)
    if whole < 60:
        return f"{seconds:.1f} s" if whole < 10 else f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


# --- the command line ---


def _plan(arguments: Arguments) -> Plan:
    """Return what is asked for; raise YamaroError or UsageError if that makes no sense."""
    from ...commands.formats import formats_in
    from ...options import Options
    from .api import override
    from .axes import words_in
    from .study import planned, read_study

    policy = make_policy(arguments)
    study = read_study(arguments.words[0], policy.limits)
    lists, options = arguments.lists, arguments.options
    override(
        study,
        samples=_number(arguments, "samples", 1),
        method=options.get("method"),
        seed=_number(arguments, "seed", 0),
        keep=lists.get("keep", ()),
        to=formats_in(arguments),
        metrics=[word for text in lists.get("metrics", ()) for word in words_in(text)],
        evaluate=options.get("evaluate"),
        models=arguments.has("models") or None,
    )
    wanted = Options(
        policy=policy,
        packages=read_packages(arguments),
        command_line=arguments.assignments,
        allow=lists.get("allow", ()),
        deny=lists.get("deny", ()),
        strict=arguments.has("strict"),
        base=options.get("base"),
        repair_inertia=arguments.has("repair-inertia"),
        sdf_version=options.get("sdf-version"),
        mujoco_version=options.get("mujoco-version"),
        model=options.get("model"),
        overlay=[os.path.abspath(each) for each in lists.get("overlay", ())],
    )
    axes: dict[str, str] = {}
    for word in arguments.words[1:]:
        name, has_value, text = word.partition("=")
        if not has_value:
            hint = near(word, list(study.vary))
            raise WrongUsage(f"{quote(word)} is not an axis: write it as {word}=0.2..0.4{hint}")
        if name in axes:
            raise WrongUsage(f"the axis {quote(name)} is given twice")
        axes[name] = text
    plan = planned(study, wanted, axes=axes)
    for name in WRITING:
        if arguments.has(name) and not plan.targets():
            raise WrongUsage(f"'--{name}' needs an output format, such as --to sdf")
    return plan


def _number(arguments: Arguments, option: str, least: int) -> int | None:
    text = arguments.options.get(option)
    if text is None:
        return None
    try:
        number = int(text)
    except ValueError:
        number = least - 1
    if number < least:
        wanted = f"a whole number of at least {least}"
        raise WrongUsage(f"'--{option}' takes {wanted}, not {quote(text)}")
    return number


# --- one variant ---


def _show(arguments: Arguments, streams: Streams, policy: Policy) -> int:
    """Write the document of a variant; return the exit status."""
    from ...commands.formats import formats_in
    from .folder import show as build_again

    words = arguments.words[1:]
    if len(words) != 2 or not words[1].isdigit():
        raise WrongUsage("'yamaro sweep show' needs the folder and a number: runs/ 4711")
    if arguments.assignments:
        raise WrongUsage("a variant has its own arguments, and takes no 'name:=value'")
    folder, index = words[0], int(words[1])
    shown = build_again(folder, index, policy)
    outputs = shown.build.outputs or {shown.build.format: shown.build}
    formats = formats_in(arguments) or list(outputs)[:1]
    if len(formats) > 1 or formats[0] not in outputs:
        raise WrongUsage(f"'--to' takes a format of the sweep here: {', '.join(outputs)}")
    if not streams.quiet:
        passed = " ".join(f"{name}:={_written(value)}" for name, value in shown.arguments.items())
        streams.say(f"variant {index}: {passed}")
        for path in shown.changed:
            streams.say(f"warning: {quote(path)} has changed since the sweep")
    return deliver(outputs[formats[0]].encoded(), arguments, streams)


def _written(value: object) -> str:
    """Return a value as it is written on the command line."""
    from ...xml.values import format_value

    if isinstance(value, float):
        return repr(value)
    if isinstance(value, (list, dict)):
        import json

        return json.dumps(value, ensure_ascii=False)
    return format_value(value)
