"""Builds one file at each save, for the commands that go on until Ctrl-C."""

from __future__ import annotations

import sys

from ..source import STANDARD_INPUT
from .reports import sayer
from .settings import make_policy, output_of, read_packages, targets_of
from .usage import DONE, WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..policy import Policy
    from ..streams import Streams
    from ..tools.rebuilding import Rebuilder
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

    from ..arguments import UsageError

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
            run(_rebuilder(arguments, streams, policy, looks=looks))
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    except KeyboardInterrupt:
        return DONE
    return DONE


def _rebuilder(arguments: Arguments, streams: Streams, policy: Policy, *, looks: bool) -> Rebuilder:
    from ..tools.rebuilding import Rebuilder

    return Rebuilder(
        arguments.words[0],
        policy=policy,
        packages=read_packages(arguments),
        command_line=arguments.assignments,
        on_message=sayer(streams),
        strict=arguments.has("strict"),
        allow=arguments.lists.get("allow", ()),
        deny=arguments.lists.get("deny", ()),
        advice=looks,
        output=output_of(arguments),
        targets=targets_of(arguments),
    )
