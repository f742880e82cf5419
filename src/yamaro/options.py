"""The options of a build: one object for all who build, be it a command, Python or a study."""

from __future__ import annotations

import os

from .diagnostics import Adjustment, did_you_mean
from .files.mesh_files import COPY, RELATIVE
from .policy import Policy

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from typing import Any, NoReturn, TypedDict, TypeVar

    from typing_extensions import Unpack

    from .files.loader import Loader
    from .robot.refitting import Refitting

    Overlay = str | os.PathLike[str] | Mapping[str, Any]
    Overlays = Overlay | Sequence[Overlay] | None
    Function = TypeVar("Function", bound=Callable[..., Any])

    class FileOptions(TypedDict, total=False):
        """The options that say what the files are, and so hold for all builds of a `Program`."""

        text: str | None
        loader: Loader | None
        policy: Policy | None
        packages: Mapping[str, str] | None

    class BuildOptions(TypedDict, total=False):
        """The options that each build of a `Program` may have of its own."""

        command_line: Sequence[str]
        variables: Mapping[str, object] | None
        strict: bool
        advice: bool
        on_message: Callable[[str], None] | None
        has_root: bool
        output: str | os.PathLike[str] | None
        meshes: str
        gazebo: bool
        allow: Iterable[str]
        deny: Iterable[str]
        records: bool
        target: str | Sequence[str] | None
        base: str | None
        repair_inertia: bool
        sdf_version: str | None
        mujoco_version: str | None
        model: str | None
        overlay: Overlays
        on_progress: Callable[[float], None] | None
        partial: bool
        refitting: Refitting | None
        alone: bool

    class AllOptions(FileOptions, BuildOptions, total=False):
        """The keywords of `yamaro.build`, which says what they mean."""


class UsageError(Exception):
    """The command was used wrongly: the main file is missing, or an argument is malformed."""


DEFAULTS: dict[str, object] = {
    "command_line": (),
    "variables": None,
    "text": None,
    "strict": False,
    "advice": False,
    "on_message": None,
    "loader": None,
    "policy": None,
    "packages": None,
    "has_root": True,
    "output": None,
    "meshes": RELATIVE,
    "gazebo": False,
    "allow": (),
    "deny": (),
    "records": False,
    "target": None,
    "base": None,
    "repair_inertia": False,
    "sdf_version": None,
    "mujoco_version": None,
    "model": None,
    "overlay": None,
    "on_progress": None,
    "partial": False,
    "refitting": None,
    "alone": False,
}
"""The keywords of `yamaro.build`, with what they are by default."""
"""The endings of files of USD that are not text, by which OpenUSD knows how to read them."""
OF_FILES = ("text", "loader", "policy", "packages")
"""Those that hold for all builds of a program, since its files are read once."""


def explains_variables(how: str) -> Callable[[Function], Function]:
    """Let a function that takes options, but is called with variables, say how to pass them.

    Args:
        how: what to write, where `{name}` is a variable and `{value}` its value.
    """

    def decorate(function: Function) -> Function:  # functools would make the start slower
        count: int = function.__code__.co_argcount

        def checked(*positional: Any, **named: Any) -> Any:
            for name, value in named.items():
                if name not in DEFAULTS and name not in function.__code__.co_varnames[:count]:
                    hint = did_you_mean(name, DEFAULTS)
                    remedy = how.format(name=name, value=repr(value))
                    raise TypeError(
                        f"{function.__name__}() has no argument '{name}'; "
                        + (f"{hint} " if hint else "")
                        + f"a variable of the file is passed by {remedy}"
                    )
            for value in positional[count:]:
                name, separator, text = str(value).partition(":=")
                remedy = how.format(name=name if separator else "name", value=text or "…")
                raise TypeError(
                    f"{function.__name__}() takes no argument {value!r} here; "
                    f"a variable of the file is passed by {remedy}"
                )
            return function(*positional, **named)

        for name in ("__module__", "__name__", "__qualname__", "__doc__", "__annotations__"):
            setattr(checked, name, getattr(function, name))
        checked.__wrapped__ = function  # type: ignore[attr-defined]
        return checked  # type: ignore[return-value]

    return decorate


def merged_variables(variables: object, named: Mapping[str, object]) -> dict[str, object]:
    """Return the variables of `variables=` and those that are arguments by name, which win."""
    try:
        given: Mapping[str, object] = dict(variables or {})  # type: ignore[call-overload]
    except (TypeError, ValueError):
        raise TypeError(
            "variables= takes a dict of variables; pass a variable that is called 'variables' in "
            "it: variables={'variables': …}"
        ) from None
    return {**given, **named}


class Options:
    """Options of a build, complete and checked; they never change.

    The attributes are the keywords of `yamaro.build`, which says what they mean.

    Attributes:
        target: the names of output formats, or None for URDF or other XML without a word about
            what it cannot hold.
    """

    __slots__ = tuple(DEFAULTS)

    command_line: Sequence[str]
    variables: Mapping[str, object]
    text: str | None
    strict: bool
    advice: bool
    on_message: Callable[[str], None] | None
    loader: Loader | None
    policy: Policy
    packages: Mapping[str, str]
    has_root: bool
    output: str | None
    meshes: str
    gazebo: bool
    allow: frozenset[str]
    deny: frozenset[str]
    records: bool
    target: tuple[str, ...] | None
    base: str | None
    repair_inertia: bool
    sdf_version: str | None
    mujoco_version: str | None
    model: str | None
    overlay: tuple[str | Mapping[str, Any], ...]
    on_progress: Callable[[float], None] | None
    partial: bool
    refitting: Refitting | None
    alone: bool

    def __init__(self, **keywords: Unpack[AllOptions]) -> None:
        """Check and complete the keywords of `yamaro.build`.

        Raises:
            TypeError: there is no such keyword.
            UsageError: a value makes no sense, whatever the file.
        """
        values = {**DEFAULTS, **keywords}
        if len(values) > len(DEFAULTS):
            name = next(name for name in keywords if name not in DEFAULTS)
            raise TypeError(f"a build has no option '{name}'")
        for name, value in values.items():
            object.__setattr__(self, name, value)
        complete = {
            "variables": self.variables or {},
            "policy": self.policy or Policy(),
            "packages": dict(self.packages or {}),
            "output": None if self.output is None else os.fspath(self.output),
            "allow": _codes(self.allow),
            "deny": _codes(self.deny),
            "target": _formats(self.target),
            "overlay": _overlays(self.overlay),
        }
        for name, value in complete.items():
            object.__setattr__(self, name, value)
        if self.allow or self.deny:
            from .codes import fault_of_codes

            fault = fault_of_codes(self.allow, self.deny)
            if fault is not None:
                raise UsageError(fault)
        if self.base is not None:
            from .targets.table import BASES

            _check_choice("base", self.base, BASES)
        if self.sdf_version is not None:
            from .targets.table import TARGETS

            _check_choice("version of SDF", self.sdf_version, TARGETS["sdf"].versions)
        if self.mujoco_version is not None:
            _check_release(self.mujoco_version)
        ending = os.path.splitext(self.output or "")[1].lower()
        if self.target and ending:
            from .targets.table import TARGETS

            stem = os.path.splitext(os.path.basename(self.output or ""))[0]
            for target in (TARGETS[name] for name in self.target):
                if ending in target.refused:
                    names = [stem + each for each in target.endings if each not in target.refused]
                    raise UsageError(
                        f"{target.title} is written as text, which '{ending}' files are not: name "
                        f"it {' or '.join(names)}; {target.conversion.format(stem)}"
                    )
        if self.meshes == COPY and self.output is None:
            raise UsageError(
                "'copy' needs an output file (-o FILE); the meshes are copied beside it"
            )

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"options do not change: '{name}' cannot be set")

    def __reduce__(self) -> tuple[object, ...]:
        return _made_again, ({name: getattr(self, name) for name in DEFAULTS},)

    def changed(self, **keywords: Unpack[AllOptions]) -> Options:
        """Return these options with others in the place of some; for errors see `__init__`."""
        if not keywords:
            return self
        values = {name: getattr(self, name) for name in DEFAULTS}
        values.update(keywords)
        return _made_again(values)

    @property
    def adjustment(self) -> Adjustment:
        """Return which messages are errors."""
        return Adjustment(self.allow, self.deny, is_strict=self.strict)

    def wanted_advice(self) -> Callable[[str], bool] | None:
        """Return what decides which codes of advice to report, or None if no advice is wanted."""
        if self.advice:
            return lambda code: True
        return self.deny.__contains__ if self.deny else None


def _made_again(values: dict[str, Any]) -> Options:
    return Options(**values)


def _codes(codes: Iterable[str]) -> frozenset[str]:
    """Return codes to allow or deny; a lone text is one code."""
    found = frozenset([codes] if isinstance(codes, str) else codes)
    for code in found:
        if not isinstance(code, str):
            raise UsageError(f"a code to allow or deny must be a text, not {code!r}")
    return found


def _overlays(overlay: Overlays) -> tuple[str | Mapping[str, Any], ...]:
    """Return overlays as a tuple; a lone path or mapping is one."""
    if overlay is None:
        return ()
    found: list[str | Mapping[str, Any]] = []
    is_one = isinstance(overlay, (str, os.PathLike)) or hasattr(overlay, "keys")
    given: Iterable[Any] = [overlay] if is_one else overlay  # type: ignore[assignment]
    for each in given:
        if isinstance(each, (str, os.PathLike)):
            found.append(os.fspath(each))
        elif hasattr(each, "keys"):
            found.append(each)
        else:
            raise UsageError(f"an overlay is a path or a mapping, not {each!r}")
    return tuple(found)


def _formats(target: str | Sequence[str] | None) -> tuple[str, ...] | None:
    if target is None:
        return None
    from .targets.table import TARGETS

    formats = [target] if isinstance(target, str) else list(dict.fromkeys(target))
    if not formats:
        raise UsageError("no output format is named")
    for format in formats:
        _check_choice("output format", format, list(TARGETS))
    return tuple(formats)


def _check_release(version: str) -> None:
    from .targets.table import OLDEST_MUJOCO, release

    oldest = ".".join(map(str, OLDEST_MUJOCO))
    try:
        is_known = release(version) >= OLDEST_MUJOCO
    except ValueError:
        from .terminal import shortened

        raise UsageError(
            f"'{shortened(str(version))}' is not a version of MuJoCo; write it as {oldest}"
        ) from None
    if not is_known:
        raise UsageError(f"MuJoCo {version} is too old; {oldest} or newer can be asked for")


def _check_choice(what: str, value: str, known: Sequence[str]) -> None:
    if value not in known:
        from .terminal import shortened

        listed = did_you_mean(value, known) or "choose one of " + ", ".join(known)
        raise UsageError(f"'{shortened(value)}' is not a known {what}; {listed}")
