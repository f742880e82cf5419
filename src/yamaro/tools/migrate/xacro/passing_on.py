"""Arguments that the main file passes to the files that read them, if it includes these itself."""

from __future__ import annotations

from ....syntax.names import SECTIONS
from ..document import Body, Entry
from .callees import KEYS_OF_INCLUDES
from .tidying import entries_in, file_meant, path_of_include, stem_of, words_read

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

_RESERVED = frozenset((*KEYS_OF_INCLUDES, *SECTIONS, "arguments", "parent", "global", "bridge"))


def pass_on(name: str, files: Mapping[str, Body], main: str) -> bool:
    """Pass an argument to all other files that read it, and return whether that could be.

    Each of them has to be included once, by the main file outside of its functions, and nothing
    else may have the name: what is passed goes before a variable of a file.

    Args:
        name: of the argument.
        files: the sections of all files, by path.
        main: the path of the main file.
    """
    if name in _RESERVED:
        return False
    readers = {
        path for path, sections in files.items() if path != main and name in words_read(sections)
    }
    included: dict[str, list[Entry]] = {path: [] for path in files}
    for path, sections in files.items():
        for entry in entries_in(sections):
            if entry.key == "variables" and isinstance(entry.value, Body):
                if name in map(stem_of, entry.value):
                    return False
            if entry.key == "include":
                if "$" in path_of_include(entry):
                    return False
                included.setdefault(file_meant(entry, path), []).append(entry)
    own = {id(entry) for entry in _outside_of_functions(files[main])}
    if not all(len(included[path]) == 1 and id(included[path][0]) in own for path in readers):
        return False
    for path in readers:
        include = included[path][0]
        if not isinstance(include.value, Body):
            include.value = Body([Entry("path", include.value)], in_braces=True)
        include.value.add(name, f"$({name})")
    return True


def _outside_of_functions(sections: Body) -> list[Entry]:
    """Return the entries of a file that are in no function."""
    inside = {
        id(own)
        for entry in entries_in(sections)
        if entry.key == "functions" and isinstance(entry.value, Body)
        for own in entries_in(entry.value)
    }
    return [entry for entry in entries_in(sections) if id(entry) not in inside]
