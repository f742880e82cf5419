"""`yamaro watch`: builds a file on each save, and says in a line the result."""

from __future__ import annotations

import time

from .rebuilding import Rebuilder, Turn, count_told

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..result import Build


def watch(
    rebuilder: Rebuilder,
    *,
    write: Callable[[Build], bool],
    output: str,
    say: Callable[[str], None],
    show: Callable[[Turn], None],
) -> None:
    """Build now and after each change, until Ctrl-C.

    Args:
        rebuilder: builds.
        write: writes a robot, and returns whether that went well.
        output: what the file written is called.
        say: takes a line for the terminal.
        show: shows what is wrong with a build.
    """
    last: Turn | None = None
    while True:
        turn = rebuilder.build()
        if not turn.fails_as(last):
            is_written = turn.build is not None and write(turn.build)
            say(f"{time.strftime('%H:%M:%S')}  {_outcome(turn, output, is_written=is_written)}")
            if not turn.is_told_as(last):
                show(turn)
        last = turn
        rebuilder.wait()


def _outcome(turn: Turn, output: str, *, is_written: bool) -> str:
    """Return the result of a build in a few words."""
    counted = count_told(turn.diagnostics)
    if turn.build is None:
        return f"{turn.fault or counted}; {output} is unchanged"
    milliseconds = f"{1000 * turn.seconds:.0f} ms"
    if not is_written:
        return f"built in {milliseconds}, and not written"
    return f"{output} written, {milliseconds}" + (f", {counted}" if counted else "")
