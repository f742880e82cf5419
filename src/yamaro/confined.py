"""Work in a jail, within its limits, and the errors of work that was ended."""

from __future__ import annotations

import io
import sys
from time import monotonic

from .diagnostics import YamaroError, failure_of_all
from .files.packages import MODEL_PATHS
from .policy import JAIL, NO_JAIL, USUAL_SECONDS, Policy
from .runtime.interpreter import Messages
from .sandbox.deadline import TimeOver, run_within
from .sandbox.deep_stack import run_on_deep_stack

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import TypeVar

    from .files.readable import Reach
    from .sandbox.jail import JailError
    from .sandbox.transfer import Outcome

    T = TypeVar("T")

GRACE = 2.0
"""Seconds that a conversion in a jail has to report that its time is over, before it is ended."""

MOST_WANTED = 100
"""Packages that a conversion in a jail may want at once."""

MOST_READ = 1 << 30
"""Bytes that reading files may give."""


class FaultInJail(Exception):
    """Yamaro itself failed in a jail, with an exception that is not about the input.

    Attributes:
        kind: the name of the exception's class.
        place: where it was raised, as `file.py:line`.
    """

    def __init__(self, kind: str, text: str, place: str) -> None:
        """Hold what the jailed process says of the exception, which may be a lie."""
        super().__init__(text)
        self.kind = kind
        self.place = place


def has_jail(policy: Policy, name: str) -> bool:
    """Return whether a file is run in a jail: that is asked for, or available for a safe file.

    Raises:
        YamaroError: it is asked for and not available; `name` is that of the file.
    """
    if policy.is_trusted:
        return False
    from .sandbox.jail import check_available

    reason = check_available()
    if reason is not None and policy.mode == JAIL:
        raise no_jail(reason, name)
    return reason is None


def run_confined(
    work: Callable[[Callable[[str], None]], Outcome],
    *,
    policy: Policy,
    reach: Reach | None,
    name: str,
    has_root: bool,
    has_document: bool = True,
) -> Outcome:
    """Return the result of a conversion in a jail.

    Args:
        work: does it; it is given a function that takes what is printed.
        policy: the limits.
        reach: what it may read; None for nothing.
        name: what its file is called in messages.
        has_root: whether a tree has to come out.
        has_document: whether a document has to come out.

    Raises:
        YamaroError: there is no result.
        FaultInJail: Yamaro itself failed.
    """
    from .sandbox.jail import JailAnswerBroken, JailUnavailable
    from .sandbox.transfer import from_bytes, to_bytes

    def work_in_jail() -> bytes:
        printed: list[str] = []
        sys.stdout = sys.stderr = _Printed(Messages(printed.append, policy.limits))
        outcome = work(printed.append)
        sys.stdout.close()
        outcome.messages = printed
        return to_bytes(outcome)

    def read(data: bytes) -> Outcome:
        from .targets.table import TARGETS

        texts = [each.name for each in TARGETS.values() if not each.is_xml]
        outcome = from_bytes(data, policy.limits, texts=texts)
        if has_root and outcome.root is None and not outcome.has_errors:
            raise JailAnswerBroken("the answer holds no tree")
        has_some = outcome.pieces or outcome.documents
        if has_document and not has_some and not outcome.has_errors:
            raise JailAnswerBroken("the answer holds no document")
        return outcome

    try:
        return run_in_jail(work_in_jail, read, policy=policy, reach=reach, name=name)
    except JailUnavailable as error:
        if policy.mode == JAIL:
            raise no_jail(str(error), name) from None
        printed: list[str] = []
        outcome = work(printed.append)
        outcome.messages = printed
        return outcome


def run_in_jail(
    work: Callable[[], bytes],
    read: Callable[[bytes], T],
    *,
    policy: Policy,
    reach: Reach | None,
    name: str,
) -> T:
    """Return what `read` makes of the bytes that `work` returns in a jail.

    A file may read the folder of a Python package that it names, but what it names is known only
    when it is run. So if it wants such packages that are there, it is run once more.

    Args:
        work: is run in the jail.
        read: checks what came out, which may be a lie; raises JailAnswerBroken.
        policy: the limits.
        reach: what may be read; None for nothing.
        name: what the file is called in messages.

    Raises:
        YamaroError: there is no result.
        FaultInJail: Yamaro itself failed.
        JailUnavailable: there is no jail; nothing was run.
        JailAbandoned: the policy says that nobody wants the result.
    """
    from .sandbox.jail import JailError, JailUnavailable, JailWorkFailed

    try:
        data = _data_of_jail(work, policy, reach)
        return run_on_deep_stack(lambda: run_within(_seconds(policy), lambda: read(data)))
    except TimeOver:
        raise time_is_over(name, policy) from None
    except JailUnavailable:
        raise
    except JailWorkFailed as error:
        if error.is_fault:
            raise FaultInJail(error.kind, error.text, error.place) from None
        raise failure_of_jail(error, policy, name) from None
    except JailError as error:
        raise failure_of_jail(error, policy, name) from None


def _data_of_jail(work: Callable[[], bytes], policy: Policy, reach: Reach | None) -> bytes:
    """Return what `work` returns in a jail, where it can read the packages that it wants."""
    from .sandbox.jail import KEPT_VARIABLES, JailAnswerBroken, JailLimits, pack, run_jailed, unpack

    def work_in_jail() -> bytes:
        policy.is_confined = True  # in this process, which is a copy
        if reach is None:
            return pack([b"", work()])
        reach.is_confined = True
        data = work()
        return pack([pack([each.encode() for each in reach.wanted[:MOST_WANTED]]), data])

    seconds = _seconds(policy)
    limits = JailLimits(
        seconds=seconds + GRACE,  # the conversion itself can report where it spends its time
        cpu_seconds=int(seconds + GRACE) + 1,
        memory=policy.limits.memory,
        answer=4 * policy.limits.output + (64 << 20),
        is_abandoned=policy.is_abandoned,
    )
    while True:
        answer = run_jailed(
            work_in_jail,
            readable=() if reach is None else reach.roots,
            limits=limits,
            environment=[*KEPT_VARIABLES, *MODEL_PATHS],
        )
        try:
            packed, data = unpack(answer)
            wanted = [each.decode("ascii") for each in unpack(packed)]
        except ValueError as error:
            raise JailAnswerBroken(f"its answer is malformed: {error}") from None
        if reach is None or not reach.has_new(wanted[:MOST_WANTED]):
            return data


class Reader:
    """Reads files that others wrote, such as meshes: in a jail where there is one, and in time.

    Those of a trusted file are read without a jail.
    """

    __slots__ = ("_name", "_policy", "_readable", "_until")

    def __init__(
        self, policy: Policy, *, readable: Sequence[str], name: str, until: float | None = None
    ) -> None:
        """Set the limits.

        Args:
            policy: that of the main file.
            readable: files and folders that may be read in a jail.
            name: what the main file is called in messages.
            until: when the time is over, by the monotonic clock, or None.
        """
        self._policy = policy
        self._readable = readable
        self._name = name
        self._until = until

    def check_time(self) -> None:
        """Raise YamaroError if the time is over."""
        if self._until is not None and monotonic() >= self._until:
            raise time_is_over(self._name, self._policy)

    def run(self, work: Callable[[], bytes]) -> bytes:
        """Return what `work` returns, which may be a lie.

        Raises:
            YamaroError: the time is over.
            JailError: it was ended for another reason.
        """
        from .sandbox.jail import (
            JailCpuTimeOver,
            JailLimits,
            JailTimeOver,
            JailUnavailable,
            run_jailed,
        )

        self.check_time()
        if self._policy.is_trusted:
            return work()
        seconds = USUAL_SECONDS if self._until is None else self._until - monotonic()
        limits = JailLimits(
            seconds=seconds,
            cpu_seconds=int(seconds) + 1,
            memory=self._policy.limits.memory,
            answer=MOST_READ,
        )
        try:
            return run_jailed(work, readable=self._readable, limits=limits)
        except JailUnavailable:
            return work()
        except (JailTimeOver, JailCpuTimeOver):
            raise time_is_over(self._name, self._policy) from None


def run_in_time(function: Callable[[], T], policy: Policy, name: str) -> T:
    """Return what `function` returns.

    Raises:
        YamaroError: it took longer than the policy allows; `name` is that of the file.
    """
    try:
        return run_within(policy.timeout, function)
    except TimeOver:
        raise time_is_over(name, policy) from None


def time_is_over(name: str, policy: Policy) -> YamaroError:
    """Return the error for a conversion that was ended by force, of a file of that name."""
    from .runtime.python_errors import TIME_HINT

    message = f"timed out: this takes more than {_seconds(policy):g} s"
    return failure_of_all("limit-time", message, name, TIME_HINT)


class _Printed(io.TextIOBase):
    """Replaces the standard streams, which in a jail are discarded."""

    def __init__(self, messages: Messages) -> None:
        self._messages = messages

    def write(self, text: str) -> int:
        self._messages.say(text)
        return len(text)

    def writable(self) -> bool:
        return True

    def close(self) -> None:
        self._messages.close()
        super().close()


def no_jail(reason: str, name: str) -> YamaroError:
    """Return the error for a file that has to be run in a jail where there is none."""
    hint = "--safe works everywhere; the file was not run"
    return failure_of_all(NO_JAIL, f"the jail is not available: {reason}", name, hint)


def _seconds(policy: Policy) -> float:
    return policy.timeout or USUAL_SECONDS


def failure_of_jail(error: JailError, policy: Policy, name: str) -> YamaroError:
    """Return the error for a conversion that was ended in its jail, or has ended there."""
    if error.limit in ("seconds", "cpu_seconds"):
        return time_is_over(name, policy)
    hints = {
        "memory": ("limit-memory", policy.limits.hint("memory")),
        "answer": ("limit-output", policy.limits.hint("output")),
    }
    code, hint = hints.get(error.limit, ("jail-broken", None))
    return failure_of_all(code, f"the file was stopped in its jail: {error}", name, hint)
