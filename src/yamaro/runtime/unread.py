"""Warns of variables that are passed to a file which has no use for them."""

from __future__ import annotations

import builtins

from ..diagnostics import Frame, Reporter
from .predefined import CONSTANTS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ..source import Span
    from ..syntax.nodes import Document, IncludeNode
    from .files import Files

COMPUTED = ""
"""Replaces, in the declarations of a file, a name that is known only at run time."""
_ALWAYS_KNOWN = frozenset((*dir(builtins), *CONSTANTS, "load_yaml", "file_dir"))
_READS_ANY = frozenset(("globals", "locals", "vars", "eval", "exec", "dir", "__import__"))
"""Functions of Python through which variables are read, or made, by names that are computed."""
PREFIX_HINT = (
    "'prefix' renames the elements of a URDF; in a YAML file, use it explicitly: name: $(prefix)arm"
)


class Passed:
    """What one `include` has passed to a file."""

    __slots__ = ("document", "frame", "node")

    def __init__(self, node: IncludeNode, document: Document, frame: Frame | None) -> None:
        self.node = node
        self.document = document
        self.frame = frame


def warn_of_unread(places: Mapping[str, Span], files: Files, reporter: Reporter) -> None:
    """Warn of variables passed to the program that nothing in it declares or reads.

    Args:
        places: where each of them is set.
        files: the files of the program.
        reporter: takes the warnings.
    """
    if not places:
        return
    read = files.names_read()
    documents = files.documents
    known = _declared_in(documents)
    is_open = COMPUTED in known or not _READS_ANY.isdisjoint(read)
    known |= {
        name for each in documents for name, scope, _ in each.declarations if scope != "import"
    }
    for name, span in () if is_open else places.items():
        if name not in known and name not in read:
            from ..suggestions import meant

            hint, fix = meant(name, _variables(known), span)
            reporter.warn(
                "unknown-variable",
                f"nothing in the program declares or reads the variable '{name}'",
                span,
                hint=hint,
                fix=fix,
            )


def warn_of_unread_includes(includes: Iterable[Passed], files: Files, reporter: Reporter) -> None:
    """Warn of variables passed to included files that nothing in those declares or reads."""
    from ..syntax.leaves import is_computed

    for passed in includes:
        document, path = passed.document, passed.node.path
        if not isinstance(path, str) and is_computed(path):
            continue  # what one of the files has no use for may be meant for another one
        known = _declared_in([document])
        read = document.names_read | files.late.names_read
        if COMPUTED in known or not _READS_ANY.isdisjoint(read):
            continue
        for argument in passed.node.arguments:
            name = argument.name or ""
            if name in known or name in read:
                continue
            from ..suggestions import meant

            hint, fix = meant(name, _variables(known | read - _ALWAYS_KNOWN), argument.span)
            if hint is None and name == "prefix":
                hint = PREFIX_HINT
            reporter.warn(
                "unknown-variable",
                f"nothing in '{document.source.name}' declares or reads the variable '{name}'",
                argument.span,
                hint=hint,
                trace=passed.frame,
                fix=fix,
            )


def _declared_in(documents: Iterable[Document]) -> set[str]:
    """Return the names that files declare; what they pass on to others is not theirs."""
    return {
        name
        for document in documents
        for name, scope, _ in document.declarations
        if scope not in ("import", "passed")
    }


def _variables(names: Iterable[str]) -> list[str]:
    """Return the names of variables, without those of functions and blocks."""
    return [name for name in names if name and not name[0].isupper()]
