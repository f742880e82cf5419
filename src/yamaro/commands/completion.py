"""`yamaro completion SHELL`: prints a completion script, and answers what such scripts ask."""

from __future__ import annotations

from .delivery import deliver
from .usage import WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the script of a shell, or variables or values of a file; return the exit status."""
    from .shells import SHELLS, script

    words = arguments.words
    if len(words) == 2 and words[0] == "variables":
        from .variables import variable_lines

        text = variable_lines(words[1])
    elif len(words) == 3 and words[0] == "values":
        from .variables import value_lines

        text = value_lines(words[1], words[2])
    elif len(words) == 1 and words[0] in SHELLS:
        text = script(words[0])
    else:
        raise WrongUsage(f"'yamaro completion' needs a shell: {', '.join(SHELLS)}")
    return deliver([text], arguments, streams)
