"""The section `arguments` of a main file, in place of the variables that its arguments became.

Nothing else can be passed to a file that has the section, and each value has to be of the
argument's type. So it is written only if it takes all that the files of the robot show.
"""

from __future__ import annotations

import re

from ....runtime.predefined import CONSTANTS
from ....xacro.templates import guess_value
from ....yaml.nodes import type_plain
from ..document import RECORD_WIDTH, Body, Entry, Quoted, Row, pieces_of
from .passing_on import pass_on
from .tidying import bodies_in, entries_in, stem_of
from .uses import Uses

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from .program import XacroProgram

TEXT, NUMBER, BOOLEAN = "text", "number", "boolean"
_KINDS = {bool: BOOLEAN, int: NUMBER, float: NUMBER, str: TEXT}
_WORD = re.compile(r"[^\W\d]\w*")
_KNOWN = frozenset(CONSTANTS) | {"find", "env", "arg", "str", "int", "float", "lower", "in", "cwd"}
LONGEST_HELP = 90
"""Characters of a comment that becomes the help of an argument."""


def declare_arguments(files: Mapping[str, Body], main: str, program: XacroProgram) -> bool:
    """Write the arguments of a robot as a section, and return whether that could be.

    Args:
        files: the sections of all files, by path.
        main: the path of the main file.
        program: the robot that they were made of.
    """
    sections = files[main]
    names = {_variable(name): name for name in program.arguments}
    variables = _root_variables(sections)
    if variables is None or not names or len(names) < len(program.arguments):
        return False
    entries = [entry for entry in variables if stem_of(entry) in names]
    if [stem_of(entry) for entry in entries] != list(dict.fromkeys(map(stem_of, entries))):
        return False
    if {stem_of(entry) for entry in entries} != set(names) or program.given - set(names.values()):
        return False
    if any(entry.key.partition("/")[2] not in ("", "global") for entry in entries):
        return False
    uses = Uses(files.values())
    found: dict[str, Entry] = {}
    for entry in entries:
        name = stem_of(entry)
        value = _value_of(entry, program, names[name], uses)
        if value is None or not _is_known(entry, found):
            return False
        found[name] = Entry(name, value)
    _add_help(entries, found, variables)
    for name in found:
        _drop_alias(name, files, main)
    shared = _replace(sections, variables, entries, found)
    passed = {entry.key for entry in shared if pass_on(entry.key, files, main)}
    _hand_on(sections, [entry for entry in shared if entry.key not in passed])
    return True


def truths_declared(files: Mapping[str, Body], main: str) -> set[str]:
    """Return the arguments of the section that are true or false wherever their names are read."""
    sections = {entry.key: entry.value for entry in files[main]}
    section = sections.get("arguments")
    truths = set()
    for entry in section if isinstance(section, Body) else ():
        given = {own.key: own.value for own in entry.value} if isinstance(entry.value, Body) else {}
        default = given.get("default", entry.value)
        is_text = not isinstance(default, str) or isinstance(default, Quoted)
        if given.get("type") == BOOLEAN or (not is_text and default in ("true", "false")):
            truths.add(entry.key)
    for sections_of_file in files.values():
        for entry in entries_in(sections_of_file):
            if isinstance(entry.value, Row):
                truths -= {piece.partition("=")[0].lstrip("*") for piece in entry.value.pieces}
            elif entry.key == "variables" and isinstance(entry.value, Body):
                truths -= {stem_of(own) for own in entry.value if own.value != f"$({stem_of(own)})"}
    return truths


def _variable(name: str) -> str:
    return name.replace("-", "_")


def _root_variables(sections: Body) -> Body | None:
    """Return the variables of a file."""
    for entry in sections:
        if entry.key == "variables" and isinstance(entry.value, Body):
            return entry.value
    return None


def _is_known(entry: Entry, above: Iterable[str]) -> bool:
    """Return whether all names in a default are those of arguments above it."""
    if not isinstance(entry.value, str):
        return False
    words: set[str] = set()
    for piece, is_expression in pieces_of(entry.value):
        if is_expression and not piece.startswith("$(find "):
            words.update(_WORD.findall(re.sub(r"'[^']*'|\"[^\"]*\"", "", piece)))
    return words <= {*above, *_KNOWN}


# --- types ----------------------------------------------------------------------------------------


def _value_of(entry: Entry, program: XacroProgram, name: str, uses: Uses) -> Body | str | None:
    """Return what declares an argument, or None if no type takes all that it may be."""
    default = entry.value
    if not isinstance(default, str):
        return None
    own = stem_of(entry)
    argument = program.arguments[name]
    kinds = {_kind_of(guess_value(value)) for value in program.values_tried(name)}
    if not argument.defaults and name in program.given:
        return _required(own, kinds, uses)
    if _is_computed(default):
        return default  # of any type
    is_text = isinstance(default, Quoted) or not default
    kind = _kind_of(str(default) if is_text else type_plain(default))
    if kind == TEXT:
        is_file = default.startswith("$(find ")
        return default if is_file or uses.is_text(own) else None
    if kinds - {kind}:
        return None
    if kind == NUMBER and uses.is_counted(own) and isinstance(type_plain(default), int):
        return _record(default=default, type="integer")
    return default


def _required(name: str, kinds: set[str], uses: Uses) -> Body:
    """Return what declares an argument without a default, which was given."""
    if uses.is_text(name):
        return _record(type=TEXT)
    if len(kinds) == 1 and TEXT not in kinds:
        return _record(type=kinds.pop())
    return _record(help="to be given: it has no default")


def _kind_of(value: object) -> str:
    return _KINDS.get(type(value), "")


def _is_computed(default: str) -> bool:
    """Return whether a default is one expression, which may give anything."""
    pieces = [piece for piece in pieces_of(default) if piece[0]]
    return len(pieces) == 1 and pieces[0][1] and not default.startswith("$(find ")


def _record(**entries: str) -> Body:
    return Body(
        [Entry(name, value) for name, value in entries.items()], in_braces=True, width=RECORD_WIDTH
    )


# --- writing --------------------------------------------------------------------------------------


def _add_help(entries: list[Entry], found: Mapping[str, Entry], variables: Body) -> None:
    """Give arguments the comments that go with them: as help, or above them."""
    following = {
        id(one): other for one, other in zip(variables, variables.entries[1:], strict=False)
    }
    for index, entry in enumerate(entries):
        made = found[stem_of(entry)]
        after = following.get(id(entry))
        is_alone = after not in entries or bool(after is not None and after.comment)
        is_first_of_several = not index and len(entries) > 1 and not is_alone
        text = entry.ending or ("" if is_first_of_several or not is_alone else entry.comment)
        if not text or not _is_help(text):
            made.comment, made.ending = entry.comment, entry.ending
            continue
        if entry.ending:
            made.comment = entry.comment
        if not isinstance(made.value, Body):
            assert isinstance(made.value, str)
            made.value = _record(default=made.value)
        made.value.entries = [own for own in made.value if own.key != "help"]
        made.value.add("help", Quoted(text.rstrip(":").strip()))


def _is_help(comment: str) -> bool:
    """Return whether a comment is a line that describes something."""
    return (
        "\n" not in comment
        and len(comment) <= LONGEST_HELP
        and any(char.isalpha() for char in comment)
        and not any(mark in comment for mark in ("<", ">", "==", "--", "__", "**"))
    )


def _replace(
    sections: Body, variables: Body, entries: list[Entry], found: Mapping[str, Entry]
) -> list[Entry]:
    """Put arguments in the place of variables; return those that other files read."""
    taken = {id(entry) for entry in entries}
    section = Body(found.values())
    section.opening, variables.opening = variables.opening, ""
    variables.entries = [entry for entry in variables if id(entry) not in taken]
    index = next(at for at, entry in enumerate(sections.entries) if entry.value is variables)
    old = sections.entries[index]
    new = Entry("arguments", section, old.comment)
    if variables:
        old.comment = ""
        sections.entries.insert(index, new)
    else:
        new.ending = old.ending
        sections.entries[index] = new
    return [Entry(stem_of(entry)) for entry in entries if entry.key != stem_of(entry)]


def _drop_alias(name: str, files: Mapping[str, Body], main: str) -> None:
    """Read an argument by its own name where the main file alone read it by another.

    Something else of its name is elsewhere, and nothing in the main file but its declaration.
    """
    sections = files[main]
    variables = _root_variables(sections)
    alias = re.compile(rf"\barg_{name}\b")
    mine = list(entries_in(sections))
    named = [own for own in mine if own.key == f"arg_{name}" and own.value == f"$({name})"]
    if variables is None or len(named) != 1 or named[0] not in variables.entries:
        return
    others = [own for path in files if path != main for own in entries_in(files[path])]
    declared = [own for body in bodies_in(sections) for own in _variables_in(body)]
    if (
        any(isinstance(own.value, Row) for own in mine)  # parameters of functions
        or [stem_of(own) for own in declared].count(name) > 1
        or any(own.key.startswith(f"{name}/") for own in others)  # they may set it here
        or any(alias.search(own.key) or alias.search(str(own.value)) for own in others)
    ):
        return
    variables.entries.remove(named[0])
    for own in mine:
        own.key = alias.sub(name, own.key)
        if isinstance(own.value, str):
            own.value = type(own.value)(alias.sub(name, own.value))


def _variables_in(body: Body) -> list[Entry]:
    """Return the variables that a body declares."""
    sections = [own.value for own in body if own.key == "variables"]
    return [own for section in sections if isinstance(section, Body) for own in section]


def _hand_on(sections: Body, shared: list[Entry]) -> None:
    """Declare variables for all files, before anything else in the model."""
    variables = [Entry(f"{entry.key}/global", f"$({entry.key})") for entry in shared]
    if not variables:
        return
    last = sections.entries[-1]
    model = last.value if isinstance(last.value, Body) else Body()
    if model.entries and model.entries[0].key == "variables":
        first = model.entries[0].value
        if isinstance(first, Body) and not model.entries[0].comment:
            first.entries[:0] = variables
            return
    model.entries.insert(0, Entry("variables", Body(variables)))
    last.value = model
