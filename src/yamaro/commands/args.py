"""`yamaro args FILE` and `yamaro FILE --help-args`: what may be passed to a file."""

from __future__ import annotations

from .conversion import end_process, read_pipe
from .delivery import deliver
from .reports import show
from .settings import make_policy, read_packages
from .usage import INPUT_ERROR, WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..policy import Policy
    from ..streams import Streams
    from ..tools.declared_arguments import Listing
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the listing of the file to standard output; return the exit status."""
    from ..diagnostics import YamaroError
    from ..options import UsageError

    if arguments.assignments:
        raise WrongUsage("a list of arguments does not depend on 'name:=value'")
    policy = make_policy(arguments)
    if streams.owns_process:
        from ..sandbox.process import bound_memory

        bound_memory(policy.limits.memory)
        if policy.timeout is not None:
            end_process(arguments, streams, policy, policy.timeout)
    try:
        listing = _listing(arguments, policy)
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    return deliver([_written(listing, arguments)], arguments, streams)


def _listing(arguments: Arguments, policy: Policy) -> Listing:
    from ..files.loader import FileLoader
    from ..request import finder_for, reach_of, read_main
    from ..runtime.files import Library
    from ..tools.declared_arguments import listing_of

    path = arguments.words[0]
    packages = read_packages(arguments)
    reach = reach_of(path, policy, packages)
    loader = FileLoader(policy.limits, reach)
    source = read_main(path, read_pipe(path, policy), Library(loader))
    finder = finder_for(path, reach, packages)
    return listing_of(source, loader=loader, packages=finder, limits=policy.limits)


def _written(listing: Listing, arguments: Arguments) -> str:
    if arguments.has("json"):
        from ..tools.argument_schema import schema_text

        return schema_text(listing)
    from ..tools.declared_arguments import listing_text

    return listing_text(listing)
