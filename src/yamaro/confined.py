"""Runs a conversion in a jail, and reports how it ended if there is no result."""

from __future__ import annotations

import io
import sys
from time import monotonic

from .diagnostics import YamaroError, failure_of_all
from .files.packages import MODEL_PATHS
from .policy import JAIL, NO_JAIL, USUAL_SECONDS, Limits, Policy
from .runtime.interpreter import Messages
from .sandbox.deadline import TimeOver, run_within
from .sandbox.deep_stack import run_on_deep_stack
from .xml.writer import write_pieces

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import TypeVar

    from .files.readable import Reach
    from .request import Request
    from .result import Build
    from .sandbox.jail import JailError, JailLimits
    from .sandbox.transfer import Document, Outcome

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


def outcome_of_build(build: Build, *, has_root: bool) -> Outcome:
    """Return what leaves the jail of a build; with `has_root` the tree does too."""
    from .sandbox.transfer import Document, Outcome
    from .xml.tree import unshared

    return Outcome(
        diagnostics=[*build.warnings, *build.accepted],
        pieces=() if build.outputs else build.pieces,
        files=build.files,
        meshes=build.meshes,
        noted=build.noted,
        root=build.robot_tree() if has_root else None,
        notes=[unshared(note) for note in build.notes] if has_root else (),
        documents=[
            *(_document_of(each, build, has_root=has_root) for each in build.outputs.values()),
            *(Document(format, "", refusal=reason) for format, reason in build.refused.items()),
        ],
    )


def _document_of(build: Build, first: Build, *, has_root: bool) -> Document:
    """Return what leaves the jail of a build in a format; `first` is that of the first format."""
    from .sandbox.transfer import Document
    from .targets.losses import packed
    from .xml.tree import unshared

    has_own = has_root and build.notes is not first.notes
    return Document(
        build.format,
        build.xml(),
        root=build.root if has_root and build.format != "urdf" else None,
        losses=packed(build.losses, build.format),
        assets=None if build.format == "urdf" else build.assets,
        robot=build.robot_tree() if has_own else None,
        file_name=build.file_name,
        notes=[unshared(note) for note in build.notes] if has_own else (),
    )


def build_of_outcome(outcome: Outcome, request: Request, policy: Policy) -> Build:
    """Return the build that left a jail; meshes are named here, as only here the output is known.

    Raises:
        YamaroError: the document is longer than the limits allow, or the formats are not those
            asked for.
    """
    from .result import Build
    from .sandbox.jail import JailError

    formats = request.options.target
    if formats is not None:
        try:
            return _first_output(outcome, formats, request)
        except JailError as error:
            raise _failure_of_jail(error, policy, request.source.name) from None
    root = outcome.root
    if root is not None and root.name == "robot":  # as it was written
        outcome.pieces = run_on_deep_stack(
            lambda: write_pieces(request.paths.applied_to(root), policy.limits)
        )

    return Build(
        lambda: outcome.meshes,
        finder=request.finder,
        copies=request.copies,
        finished=outcome.root,
        pieces=outcome.pieces,
        warnings=outcome.diagnostics,
        files=outcome.files,
        notes=outcome.notes,
        noted=outcome.noted,
    )


def _first_output(outcome: Outcome, formats: Sequence[str], request: Request) -> Build:
    """Return the build of the first format that left a jail, with those of all in its `outputs`."""
    from .sandbox.jail import JailAnswerBroken

    found = {each.format: each for each in outcome.documents}
    if found.keys() != set(formats) or len(found) < len(outcome.documents):
        raise JailAnswerBroken("the answer holds other formats than were asked for")
    builds = {
        format: _build_of_document(found[format], outcome, request)
        for format in formats
        if not found[format].refusal
    }
    if not builds:
        raise JailAnswerBroken("the answer holds no document")
    first = next(iter(builds.values()))
    first.outputs = builds
    first.refused = {each.format: each.refusal for each in outcome.documents if each.refusal}
    return first


def _is_file_name(name: str, format: str) -> bool:
    from .targets.output import is_file_stem
    from .targets.table import TARGETS

    ending = TARGETS[format].ending
    return name.endswith(ending) and is_file_stem(name.removesuffix(ending))


def _build_of_document(document: Document, outcome: Outcome, request: Request) -> Build:
    from .result import Build
    from .sandbox.jail import JailAnswerBroken
    from .targets.losses import unpacked
    from .targets.table import TARGETS

    has_own = document.robot is not None
    try:
        losses = unpacked(document.losses)
    except ValueError as error:
        raise JailAnswerBroken(f"its answer is malformed: {error}") from None
    file_name = request.file_name
    if file_name is None:
        file_name = document.file_name
        if not _is_file_name(file_name, document.format):
            raise JailAnswerBroken("the answer does not name its file")
    if not all(map(TARGETS[document.format].may_hold, document.assets or ())):
        raise JailAnswerBroken("the answer holds a file of another name")
    return Build(
        lambda: outcome.meshes,
        finder=request.finder,
        copies=request.copies,
        finished=document.robot if has_own else outcome.root,
        pieces=[document.text],
        warnings=outcome.diagnostics,
        files=outcome.files,
        notes=document.notes if has_own else outcome.notes,
        noted=outcome.noted,
        format=document.format,
        file_name=file_name,
        document=document.root,
        losses=losses,
        assets=document.assets,
    )


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
        raise _failure_of_jail(error, policy, name) from None
    except JailError as error:
        raise _failure_of_jail(error, policy, name) from None


def _data_of_jail(work: Callable[[], bytes], policy: Policy, reach: Reach | None) -> bytes:
    """Return what `work` returns in a jail, where it can read the packages that it wants."""
    from .sandbox.jail import KEPT_VARIABLES, pack, run_jailed

    def work_in_jail() -> bytes:
        policy.is_confined = True  # in this process, which is a copy
        if reach is None:
            return pack([b"", work()])
        reach.is_confined = True
        data = work()
        return pack([pack([each.encode() for each in reach.wanted[:MOST_WANTED]]), data])

    while True:
        answer = run_jailed(
            work_in_jail,
            readable=() if reach is None else reach.roots,
            limits=_jail_limits(policy),
            environment=[*KEPT_VARIABLES, *MODEL_PATHS],
        )
        wanted, data = _wanted_and_data(answer)
        if reach is None or not reach.has_new(wanted):
            return data


def _wanted_and_data(answer: bytes) -> tuple[list[str], bytes]:
    """Return the packages that a jailed process wants, and what it answers otherwise."""
    from .sandbox.jail import JailAnswerBroken, unpack

    try:
        packed, data = unpack(answer)
        wanted = [each.decode("ascii") for each in unpack(packed)]
    except ValueError as error:
        raise JailAnswerBroken(f"its answer is malformed: {error}") from None
    return wanted[:MOST_WANTED], data


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


def _jail_limits(policy: Policy) -> JailLimits:
    """Return what a jail lets a conversion use."""
    from .sandbox.jail import JailLimits

    limits: Limits = policy.limits
    seconds = _seconds(policy)
    return JailLimits(
        seconds=seconds + GRACE,  # the conversion itself can report where it spends its time
        cpu_seconds=int(seconds + GRACE) + 1,
        memory=limits.memory,
        answer=4 * limits.output + (64 << 20),
        is_abandoned=policy.is_abandoned,
    )


def _failure_of_jail(error: JailError, policy: Policy, name: str) -> YamaroError:
    """Return the error for a conversion that was ended in its jail, or has ended there."""
    if error.limit in ("seconds", "cpu_seconds"):
        return time_is_over(name, policy)
    hints = {
        "memory": ("limit-memory", policy.limits.hint("memory")),
        "answer": ("limit-output", policy.limits.hint("output")),
    }
    code, hint = hints.get(error.limit, ("jail-broken", None))
    return failure_of_all(code, f"the file was stopped in its jail: {error}", name, hint)
