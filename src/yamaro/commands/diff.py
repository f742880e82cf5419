"""`yamaro diff A B`: what changed from one robot to another."""

from __future__ import annotations

import os

from .arguments import make_policy, read_packages
from .conversion import ProgramEnded, read_pipe
from .reports import DONE, WrongUsage, deliver, has_color, quote, show

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.changes.change import Changes
    from ..policy import Policy
    from ..source import Span
    from ..streams import Streams
    from ..tools.diff.sides import Origin, Origins, Side
    from .arguments import Arguments

SAME, DIFFERENT, TROUBLE = 0, 1, 2
"""The exit statuses, which are those of `diff`."""
_NO_ROBOT = ("no-link", "not-urdf")


def run(arguments: Arguments, streams: Streams) -> int:
    """Write what changed to standard output; return the exit status."""
    from ..tools.diff.git import GitError
    from ..tools.diff.sides import Origins

    policy = make_policy(arguments)
    if not policy.is_trusted:
        streams.silence_libraries()
    tolerance = _tolerance(arguments)
    with Origins(os.getcwd()) as origins:
        if arguments.has("git"):
            return _run_for_git(arguments, streams, policy, origins, tolerance)
        try:
            pair = [_origin(word, origins) for word in arguments.words]
        except GitError as error:
            raise WrongUsage(str(error)) from None
        sides = _build(pair, arguments, streams, policy)
        if sides is None:
            return TROUBLE
        changes = _compared(sides, tolerance)
        return _deliver(changes, sides, arguments, streams)


def _tolerance(arguments: Arguments) -> float:
    text = arguments.options.get("tolerance", "1e-9")
    try:
        tolerance = float(text)
    except ValueError:
        tolerance = -1.0
    if not 0 <= tolerance < 1:
        raise WrongUsage(f"'--tolerance' takes a number from 0 to 1, not {quote(text)}")
    return tolerance


def _origin(word: str, origins: Origins) -> Origin:
    """Return what a word of the command line means: a file, or `REV:path`."""
    from ..tools.diff.git import split_revision
    from ..tools.diff.sides import Origin

    parts = split_revision(word)
    return Origin(word, word) if parts is None else origins.at_revision(*parts)


# --- building ---


def _build(
    pair: list[Origin], arguments: Arguments, streams: Streams, policy: Policy
) -> tuple[Side, Side] | None:
    """Return both robots, or None if one of them has errors, which are shown then."""
    from ..diagnostics import YamaroError

    sides: list[Side] = []
    has_errors = False
    for index, origin in enumerate(pair):
        try:
            sides.append(_side(index, origin, arguments, policy))
        except YamaroError as error:
            origin.relabel(error.diagnostics)
            show(error.diagnostics, arguments, streams)
            has_errors = True
    return None if has_errors else (sides[0], sides[1])


def _side(index: int, origin: Origin, arguments: Arguments, policy: Policy) -> Side:
    """Build one side; raise YamaroError for what is wrong with it."""
    from .. import api
    from ..options import UsageError
    from ..tools.diff.sides import Side

    own = arguments.lists.get("ab"[index], [])
    for text in own:
        if ":=" not in text:
            raise WrongUsage(f"'--{'ab'[index]}' takes name:=value, not {quote(text)}")
    try:
        build = api.build(
            origin.path,
            text=read_pipe(origin.path, policy),
            policy=policy,
            packages=origin.packages(read_packages(arguments)),
            command_line=[*arguments.assignments, *own],
            deny=_NO_ROBOT if arguments.has("git") else (),
            on_message=lambda message: None,
        )
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    except SystemExit as error:
        raise ProgramEnded(f"Python code of the file ended the program: {error!r}") from None
    return Side(origin, build, robot=build.robot)


def _compared(sides: tuple[Side, Side], tolerance: float) -> Changes:
    from ..sandbox.deep_stack import run_on_deep_stack
    from ..tools.diff.sides import same_file

    first, second = sides
    return run_on_deep_stack(  # other XML may be nested deeply
        lambda: first.robot.changes(
            second.robot,
            tolerance=tolerance,
            same_file=lambda *names: same_file(sides, *names),
            has_extras=first.has_extras and second.has_extras,
        )
    )


# --- writing ---


def _deliver(
    changes: Changes, sides: tuple[Side, Side], arguments: Arguments, streams: Streams
) -> int:
    labels = (sides[0].origin.label, sides[1].origin.label)
    text = _written(changes, sides, labels, arguments, streams)
    if changes.skipped and not streams.quiet and not arguments.has("json"):
        names = [side.origin.label for side in sides if not side.has_extras]
        skipped = ", ".join(dict.fromkeys(changes.skipped))
        streams.say(f"not compared, since {names[0]} cannot hold them: {skipped}")
    if text and deliver([text], arguments, streams) != DONE:
        return TROUBLE
    return DIFFERENT if changes and not arguments.has("exit-zero") else SAME


def _written(
    changes: Changes,
    sides: tuple[Side, Side],
    labels: tuple[str, str],
    arguments: Arguments,
    streams: Streams,
) -> str:
    from ..tools.diff.text import DiffText, summary_text

    if arguments.has("json"):
        import json

        from ..tools.diff.data import changes_data

        def name(span: Span) -> str:
            names = (side.origin.name_of(span) for side in sides)
            return next((each for each in names if each != span.source.name), span.source.name)

        return json.dumps(changes_data(changes, labels, name=name), indent=2) + "\n"
    if arguments.has("stat"):
        return summary_text(changes)
    # git's pager shows colours, though it is not a terminal
    in_pager = arguments.has("git") and os.environ.get("GIT_PAGER_IN_USE") == "true"
    color = has_color(arguments, is_terminal=in_pager or streams.is_terminal(result=True))

    def plain_name(span: Span) -> str:
        names = (side.origin.plain_name_of(span) for side in sides)
        return next((each for each in names if each is not None), span.source.name)

    robots = (sides[0].robot, sides[1].robot)
    mains = (sides[0].origin.main, sides[1].origin.main)
    return DiffText(changes, robots, name=plain_name, mains=mains).render(labels, color=color)


# --- for git ---


def _run_for_git(
    arguments: Arguments, streams: Streams, policy: Policy, origins: Origins, tolerance: float
) -> int:
    """Write what changed in a file that git names; for other files, how their texts differ.

    The exit status is 0 in any case: git takes another one for a failure, and ends.
    """
    from ..diagnostics import YamaroError
    from ..tools.diff.driver import Called
    from ..tools.diff.git import GitError

    called = Called(arguments.words)
    text, reason = "", ""
    if called.is_of_both:
        try:
            pair = [called.origin(index, origins) for index in (0, 1)]
            first, second = (
                _side(index, origin, arguments, policy) for index, origin in enumerate(pair)
            )
            sides = (first, second)
            changes = _compared(sides, tolerance)
            text = _written(changes, sides, called.labels, arguments, streams)
            text = text or "no difference in meaning\n"
            text = f"diff --git a/{called.path} b/{called.new_path}\n{text}"
        except YamaroError as error:
            found = error.diagnostics[-1]
            if found.code not in _NO_ROBOT:  # such as a file that robots include
                reason = f"{found.message} [{found.code}]"
        except (GitError, WrongUsage) as error:
            reason = str(error)
    if not text:
        text = called.plain()
        if reason and not streams.quiet:
            streams.say(f"yamaro diff: {called.path} is compared as text: {reason}")
    deliver([text], arguments, streams)
    return SAME
