"""`yamaro diff A B`: what changed from one robot to another."""

from __future__ import annotations

import os

from ...commands.arguments import check_words, make_policy, read_packages
from ...commands.command_table import ENDINGS, Command
from ...commands.conversion import read_pipe
from ...commands.option_table import WORKING, Option
from ...commands.reports import DONE, WrongUsage, deliver, has_color, quote, show

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...model.changes.change import Changes
    from ...policy import Policy
    from ...source import Span
    from ...streams import Streams
    from .overlay import Said
    from .sides import Origin, Origins, Side

COMMAND = Command(
    "diff",
    ("A B [name:=value ...]",),
    "show what changed from one robot to another, by meaning",
    "Compare two robots by meaning: links, joints, masses, limits, poses and all else. "
    "Exit with 0 if they mean the same, 1 if they differ, 2 for errors.",
    words=(
        ("A, B", "a YAML file, a URDF or a xacro file; or REV:path, the file in git"),
        ("name:=value", "set a variable of both"),
    ),
    looks=True,
    endings=ENDINGS,
    examples=(
        "yamaro diff HEAD:robot.yaml robot.yaml",
        "yamaro diff robot.yaml robot.yaml --a reach:=0.8 --b reach:=1.2",
        "yamaro diff --overlay cad.urdf identified.urdf > unit-17.yaml",
        "git config diff.yamaro.command 'yamaro diff --git'",
    ),
    second="two files: HEAD:robot.yaml robot.yaml",
    counts_words=False,
    place=9,
    options=(
        "json",
        Option(
            "a",
            "set a variable of the first file only",
            value="name:=value",
            wants="name:=value",
            is_repeatable=True,
        ),
        Option(
            "b",
            "set a variable of the second file only",
            value="name:=value",
            wants="name:=value",
            is_repeatable=True,
        ),
        Option(
            "tolerance",
            "how far numbers may differ, as a part of the larger one; 1e-9 by default",
            value="N",
            wants="a number",
        ),
        Option("stat", "only write how much changed", excludes=("json",)),
        Option(
            "overlay",
            "write the overlay that leads from A to B; exit with 1 if it cannot say all",
            excludes=("json", "stat", "git"),
        ),
        Option("exit-zero", "exit with 0 for robots that differ too"),
        Option(
            "git",
            "take the seven words that git gives a diff driver, in place of A and B",
        ),
        *WORKING,
    ),
    help_of={"json": "write the changes as JSON"},
)

SAME, DIFFERENT, TROUBLE = 0, 1, 2
"""The exit statuses, which are those of `diff`."""
_NO_ROBOT = ("no-link", "not-urdf")


def run(arguments: Arguments, streams: Streams) -> int:
    """Write what changed to standard output; return the exit status."""
    from .sides import GitError, Origins

    if not arguments.has("git"):
        check_words(arguments, COMMAND)
    elif len(arguments.words) not in (7, 9):
        raise WrongUsage("'--git' is for git: git config diff.yamaro.command 'yamaro diff --git'")
    policy = make_policy(arguments)
    if not policy.is_trusted:
        streams.silence_libraries()
    text = arguments.options.get("tolerance", "1e-9")
    try:
        tolerance = float(text)
    except ValueError:
        tolerance = -1.0
    if not 0 <= tolerance < 1:
        raise WrongUsage(f"'--tolerance' takes a number from 0 to 1, not {quote(text)}")
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
        labels = (sides[0].origin.label, sides[1].origin.label)
        if arguments.has("overlay"):
            return _write_overlay(sides, labels, arguments, streams, policy)
        changes = _compared(sides, tolerance)
        text = _written(changes, sides, labels, arguments, streams)
        if changes.skipped and not streams.quiet and not arguments.has("json"):
            names = [side.origin.label for side in sides if not side.has_extras]
            streams.say(
                f"not compared, since {names[0]} cannot hold them: {_joined(changes.skipped)}"
            )
        if text and deliver([text], arguments, streams) != DONE:
            return TROUBLE
        return DIFFERENT if changes and not arguments.has("exit-zero") else SAME


def _origin(word: str, origins: Origins) -> Origin:
    """Return what a word of the command line means: a file, or `REV:path`."""
    from .sides import Origin, split_revision

    parts = split_revision(word)
    return Origin(word, word) if parts is None else origins.at_revision(*parts)


# --- building ---


def _build(
    pair: list[Origin], arguments: Arguments, streams: Streams, policy: Policy
) -> tuple[Side, Side] | None:
    """Return both robots, or None if one of them has errors, which are shown then."""
    from ...diagnostics import YamaroError

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


def _side(
    index: int,
    origin: Origin,
    arguments: Arguments,
    policy: Policy,
    overlay: Said | None = None,
) -> Side:
    """Build one side, changed by an overlay; raise YamaroError for what is wrong with it."""
    from ... import api
    from ...commands.conversion import ProgramEnded
    from ...options import UsageError
    from .sides import Side

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
            on_message=_ignore,
            overlay=overlay,
        )
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    except SystemExit as error:
        raise ProgramEnded(f"Python code of the file ended the program: {error!r}") from None
    return Side(origin, build, robot=build.robot)


def _ignore(message: str) -> None:
    """Take a line that a file prints."""


def _compared(sides: tuple[Side, Side], tolerance: float) -> Changes:
    from ...sandbox.deep_stack import run_on_deep_stack
    from .sides import same_file

    first, second = sides
    return run_on_deep_stack(  # other XML may be nested deeply
        lambda: first.robot.changes(
            second.robot,
            tolerance=tolerance,
            same_file=lambda *names: same_file(sides, *names),
            has_extras=first.has_extras and second.has_extras,
        )
    )


# --- an overlay ---


def _write_overlay(
    sides: tuple[Side, Side],
    labels: tuple[str, str],
    arguments: Arguments,
    streams: Streams,
    policy: Policy,
) -> int:
    """Write the overlay that leads from one side to the other; say what it cannot say.

    The first robot is built with it: what differs then from the second one is what is missing.
    """
    from ...diagnostics import YamaroError
    from ...model.changes.change import RENAMED
    from .overlay import overlay_between, overlay_text

    first, second = sides
    renamed = {
        (change.of, change.name): change.new_name
        for change in _compared(sides, 0.0)
        if change.kind == RENAMED and change.new_name is not None
    }
    overlay = overlay_between(first.robot, second.robot, renamed)
    try:
        changed = _side(0, first.origin, arguments, policy, overlay)
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return TROUBLE
    if deliver([overlay_text(overlay)], arguments, streams) != DONE:
        return TROUBLE
    changes = _compared((changed, second), 0.0)
    if not changes:
        return SAME
    rest = _written(changes, (changed, second), labels, arguments, streams)
    streams.say(f"an overlay cannot say all of it; what is left:\n{rest.rstrip()}")
    return SAME if arguments.has("exit-zero") else DIFFERENT


# --- writing ---


def _joined(phrases: list[str]) -> str:
    return ", ".join(dict.fromkeys(phrases))


def _written(
    changes: Changes,
    sides: tuple[Side, Side],
    labels: tuple[str, str],
    arguments: Arguments,
    streams: Streams,
) -> str:
    from ...model.changes.text import DiffText, summary_text

    if arguments.has("json"):
        import json

        from .data import changes_data

        def name(span: Span) -> str:
            names = (side.origin.name_of(span) for side in sides)
            return next((each for each in names if each != span.source.name), span.source.name)

        return json.dumps(changes_data(changes, labels, name=name), indent=2) + "\n"
    if arguments.has("stat"):
        return summary_text(changes)
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
    from ...diagnostics import YamaroError
    from .sides import Called, GitError

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
