"""The main file of a build: its text, and where it and the files around it are found."""

from __future__ import annotations

import os

from .arguments import UsageError
from .diagnostics import YamaroError, failure_of_all
from .files.loader import LoadError
from .files.packages import PackageFinder
from .source import STANDARD_INPUT, STANDARD_INPUT_NAME, Source, holds_xml

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from .files.readable import Reach
    from .policy import Policy
    from .runtime.library import Library


def read_main(path: str, text: str | None, library: Library) -> Source:
    """Return the main file; `text`, if given, is what to take for its content.

    Raises:
        UsageError: it cannot be read.
        YamaroError: it may not be read, or is not text.
    """
    if text is not None:
        is_file = path != STANDARD_INPUT
        name = path if is_file else STANDARD_INPUT_NAME
        text = text.removeprefix("\ufeff")
        source = Source(text, name=name, path=os.path.abspath(path) if is_file else "")
        source.is_xml = holds_xml(path, text)
        return source
    if not path:
        raise UsageError("the file name is empty")
    try:
        return library.source(os.path.abspath(path), path)
    except LoadError as error:
        if error.hint is not None:
            raise refusal_of_main(path, error) from None
        raise UsageError(f"cannot read '{path}': {error}") from error


def refusal_of_main(name: str, error: LoadError) -> YamaroError:
    """Return the error for a main file that is there, and is not to be read."""
    return failure_of_all(error.code, f"the file cannot be read: {error}", name, error.hint)


def folder_of(path: str) -> str:
    """Return the folder in which relative paths of a file start."""
    return os.getcwd() if path == STANDARD_INPUT else os.path.dirname(os.path.abspath(path))


def stem_of(path: str) -> str:
    """Return the name of a robot whose file does not name it."""
    if path == STANDARD_INPUT:
        return "robot"
    name = os.path.basename(path)
    stem = name.partition(".")[0]
    return stem or "robot"


def reach_of(path: str, policy: Policy, packages: Mapping[str, str]) -> Reach | None:
    """Return what a main file may read, or None for anything."""
    if policy.is_trusted:
        return None
    from .files.readable import Reach, roots_of

    allowed = [*policy.allowed_paths, *packages.values()]
    return Reach(roots_of(os.path.abspath(path), allowed, PackageFinder()))


def finder_for(path: str, reach: Reach | None, given: Mapping[str, str]) -> PackageFinder:
    """Return what finds packages for a main file, also in a jail that only they can be read in."""
    finder = PackageFinder(given=given, reach=reach)
    if reach is not None:
        finder.around(os.path.dirname(os.path.abspath(path)))
    return finder
