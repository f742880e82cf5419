"""Trust in a file, and limits on what it may use: decided once, and passed down.

Three modes: trusted code is run as it is; jailed code is run as it is in a process that the kernel
confines; safe code is a part of Python that has no effects. The limits hold in each of them.
"""

from __future__ import annotations

from .source import Public

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

TRUSTED = "trusted"
JAIL = "jail"
SAFE = "safe"
MODES = (TRUSTED, JAIL, SAFE)

UNSAFE = "unsafe-code"
"""The code of the error for what safe mode refuses."""
NO_JAIL = "no-jail"
"""The code of the error where there can be no jail."""

USUAL_SECONDS = 60.0
"""The time a conversion may take that is not trusted."""

_LIMITS: dict[str, tuple[int, int]] = {
    # name: (in safe mode, in the others)
    "file": (16 << 20, 16 << 20),
    "files": (10_000, 10_000),
    "yaml_depth": (200, 200),
    "aliases": (1_000_000, 1_000_000),
    "nesting": (1_500, 1_500),
    "turns": (1_000_000, 1_000_000),
    "statements": (5_000_000, 5_000_000),
    "xml_depth": (1_500, 1_500),
    "output": (256 << 20, 256 << 20),
    "printed": (16 << 20, 16 << 20),
    "memory": (4 << 30, 4 << 30),
    "text": (1_000_000, 64 << 20),
    "sequence": (1_000_000, 10_000_000),
    "integer": (4_096, 1_000_000),
    "characters": (20_000, 0),
    "brackets": (50, 0),
    "nodes": (20_000, 0),
    "depth": (100, 0),
    "steps": (50_000_000, 0),
    "calls": (200, 0),
    "width": (999, 0),
}


_RANGES = {
    "file": (1, 1 << 30),
    "memory": (64 << 20, 1 << 50),  # with less, no thread can be started in a jail
    "xml_depth": (1, 5_000),  # Python recurses into what is nested
    "yaml_depth": (1, 5_000),
}
_RANGE = (1, 1 << 50)
"""Of all other limits."""


class Limits(Public):
    """Limits of one conversion; a number for each, 0 where there is none.

    Attributes:
        file: bytes of one file.
        files: files read, each as often as it is included.
        yaml_depth: lists and mappings in one another.
        aliases: texts, lists and mappings that the aliases of one file repeat.
        nesting: calls and includes in one another.
        turns: of one `for`.
        statements: run, with the turns of each `for`.
        xml_depth: elements in one another.
        output: characters of the document.
        printed: characters that `print` and `process` print.
        memory: bytes of data of the process, where the system can bound them.
        text: characters of a text.
        sequence: items of a list, dict, set or range, with those of the lists in it where it is
            written or compared.
        integer: bits of a whole number.
        characters: of one expression or process block.
        brackets: open at once in one of them.
        nodes: parts of one of them.
        depth: of its syntax tree, and of lists in lists.
        steps: of all expressions.
        calls: of lambdas, one within the other.
        width: of a number or text in an f-string, and its digits.
    """

    __slots__ = tuple(_LIMITS)

    aliases: int
    brackets: int
    calls: int
    characters: int
    depth: int
    file: int
    files: int
    integer: int
    memory: int
    nesting: int
    nodes: int
    output: int
    printed: int
    sequence: int
    statements: int
    steps: int
    text: int
    turns: int
    width: int
    xml_depth: int
    yaml_depth: int

    def __init__(self, mode: str = TRUSTED, /, **others: int) -> None:
        """Take the usual limits of a mode, and others by name.

        Raises:
            ValueError: there is no such limit, or it cannot have such a value.
        """
        for name, values in _LIMITS.items():
            setattr(self, name, values[mode != SAFE])
        for spelling, value in others.items():
            name = spelling.replace("-", "_")
            if name not in _LIMITS:
                raise ValueError(f"unknown limit '{shown(name)}'")
            if not getattr(self, name):
                raise ValueError(f"the limit '{shown(name)}' applies only in safe mode")
            least, most = limit_range(name)
            if type(value) is not int or not least <= value <= most:
                of_which = f"a whole number from {least:,} to {most:,}"
                raise ValueError(f"the limit '{shown(name)}' is {of_which}")
            setattr(self, name, value)

    def hint(self, name: str) -> str:
        """Return how to set another limit."""
        unit = f", in bytes; it is {self.memory:,}" if name == "memory" else ""
        return f"--limit {shown(name)}=… sets another limit{unit}"


class Policy(Public):
    """Trust in a file: the mode, the limits, the time, and the paths it may read.

    Attributes:
        mode: TRUSTED, JAIL or SAFE.
        limits: how much it may use.
        timeout: seconds it may take, or None.
        allowed_paths: files and folders it may read besides its own, if it is not trusted.
        within: the folder outside of which it may read nothing but these, if it is not trusted;
            None for no such bound.
        fallback: the policy for code that safe mode refuses, where there is a jail, or None.
        is_confined: whether this process is one that the kernel confines; its jail says so.
        is_abandoned: is asked now and then while a jail works, and ends it by returning True; None
            for a conversion whose result is wanted in any case.
    """

    __slots__ = (
        "allowed_paths",
        "fallback",
        "is_abandoned",
        "is_confined",
        "limits",
        "mode",
        "timeout",
        "within",
    )
    _internal = frozenset(
        ("fallback", "is_abandoned", "is_confined", "is_safe", "is_trusted", "looking")
    )

    def __init__(
        self,
        mode: str = TRUSTED,
        *,
        limits: Mapping[str, int] | None = None,
        timeout: float | None = None,
        allowed_paths: Sequence[str] = (),
        within: str | None = None,
    ) -> None:
        """Decide.

        Args:
            mode: "trusted", "jail" or "safe".
            limits: those that are to differ from the usual ones; "xml_depth" or "xml-depth".
            timeout: in seconds; by default none for a trusted file, and 60 for others.
            allowed_paths: what it may read besides the main file's folder and its packages.
            within: a folder outside of which it may read nothing but `allowed_paths`: no packages
                either.

        Raises:
            ValueError: there is no such mode or limit, or it cannot have such a value.
        """
        if mode not in MODES:
            raise ValueError(f"unknown mode '{mode}'; the modes are {', '.join(MODES)}")
        if timeout is not None and not 0 < timeout < float("inf"):
            raise ValueError("a time-out is a number of seconds greater than 0")
        self.mode = mode
        self.limits = Limits(mode, **(limits or {}))
        self.timeout = timeout if timeout is not None or mode == TRUSTED else USUAL_SECONDS
        self.allowed_paths = tuple(allowed_paths)
        self.within = within
        self.fallback: Policy | None = None
        self.is_confined = False
        self.is_abandoned: Callable[[], bool] | None = None

    @classmethod
    def looking(
        cls,
        *,
        limits: Mapping[str, int] | None = None,
        timeout: float | None = None,
        allowed_paths: Sequence[str] = (),
        within: str | None = None,
    ) -> Policy:
        """Return the policy for looking at a file: safe mode, and the jail for what it refuses."""
        policy = cls(
            SAFE, limits=limits, timeout=timeout, allowed_paths=allowed_paths, within=within
        )
        others = {
            name: value
            for name, value in (limits or {}).items()
            if getattr(Limits(JAIL), name.replace("-", "_"))
        }
        policy.fallback = cls(
            JAIL, limits=others, timeout=timeout, allowed_paths=allowed_paths, within=within
        )
        return policy

    @property
    def is_safe(self) -> bool:
        """Return whether expressions are held to the safe part of Python."""
        return self.mode == SAFE

    @property
    def is_trusted(self) -> bool:
        """Return whether a file may do whatever Python can."""
        return self.mode == TRUSTED


def limit_range(name: str) -> tuple[int, int]:
    """Return the least and the largest value of a limit."""
    return _RANGES.get(name.replace("-", "_"), _RANGE)


def limit_names() -> list[str]:
    """Return the names of all limits as they are written on the command line."""
    return [shown(name) for name in _LIMITS]


def shown(name: str) -> str:
    """Return a limit's name as it is written on the command line and in codes."""
    return name.replace("_", "-")
