"""Builds one file at each save, for the commands that go on until Ctrl-C."""

from __future__ import annotations

import sys

from ..source import STANDARD_INPUT
from .arguments import make_policy, options_of
from .reports import DONE, WrongUsage, sayer

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..rebuilding import Rebuilder
    from ..streams import Streams
    from .arguments import Arguments


def repeat(
    arguments: Arguments,
    streams: Streams,
    run: Callable[[Rebuilder], None],
    *,
    looks: bool,
) -> int:
    """Call `run` with what builds the file; return the exit status.

    Args:
        arguments: the command line.
        streams: where everything goes.
        run: builds until it is interrupted.
        looks: whether advice and the tree are wanted.
    """
    import warnings

    from ..options import UsageError
    from ..rebuilding import Rebuilder

    arguments.resolve_output()
    if arguments.words[0] == STANDARD_INPUT:
        raise WrongUsage(f"'yamaro {arguments.command}' needs a FILE with a name, to see it change")
    policy = make_policy(arguments)
    if not policy.is_trusted:
        streams.silence_libraries()
    if streams.owns_process:
        from ..sandbox import process

        process.bound_memory(policy.limits.memory)
    try:
        with warnings.catch_warnings():
            if not sys.warnoptions:  # user code's warnings, unless asked for with -W
                warnings.simplefilter("ignore")
            options = options_of(arguments, policy=policy, advice=looks, on_message=sayer(streams))
            run(Rebuilder(arguments.words[0], options))
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    except KeyboardInterrupt:
        return DONE
    return DONE
