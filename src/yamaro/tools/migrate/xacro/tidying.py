"""Finished sources: what nothing reads is left out, arguments become a section.

A macro that computed the inertia of a solid is not called any more, and then nobody reads the
parameters that were handed to it; a file of which nothing is left needs no include.
"""

from __future__ import annotations

import ast
import os
import re
from collections import Counter

from ....runtime.predefined import CONSTANTS
from ....syntax.names import SECTIONS
from ....xacro.templates import guess_value
from ....yaml.nodes import type_plain
from ..document import RECORD_WIDTH, Body, Entry, Quoted, Row, pieces_of
from .names import KEYS_OF_INCLUDES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Mapping

    from .program import XacroProgram

_WORD = re.compile(r"[^\W\d]\w*")


def tidy(files: dict[str, Body], main: str, program: XacroProgram) -> None:
    """Tidy the sources of a robot.

    Args:
        files: their sections, by path; those that are not needed are taken out.
        main: the path of the main file.
        program: the robot that they were made of.
    """
    _drop_aliases(list(files.values()), {f"arg_{name}" for name in program.arguments})
    _drop_parameters(list(files.values()), program)
    _drop_empty_files(files, main)
    # take the scope from variables that are declared once, and read in that file only
    words = {path: set(words_read(sections)) for path, sections in files.items()}
    others = {word for text in program.files.data.values() for word in _WORD.findall(text)}
    if len(program.roots) > len(files):
        for root in program.roots.values():
            others |= _words_in_macro(root)
    times = Counter(
        stem_of(own)
        for sections in files.values()
        for entry in sections.entries_below()
        if entry.key == "variables" and isinstance(entry.value, Body)
        for own in entry.value
    )
    for path, sections in files.items():
        read = others.union(*(own for other, own in words.items() if other != path))
        for variables in [entry.value for entry in sections if entry.key == "variables"]:
            assert isinstance(variables, Body)
            for entry in variables:
                name, _, scope = entry.key.partition("/")
                if scope == "global" and name not in read and times[name] == 1:
                    entry.key = name


# --- what nothing reads ---------------------------------------------------------------------------


def _drop_aliases(files: list[Body], names: set[str]) -> None:
    """Leave out arguments under names of their own that nothing reads."""
    used = {word for sections in files for word in _words_in(sections, in_keys=False)}
    for sections in files:
        for body in sections.bodies():
            for entry in [entry for entry in body if entry.key == "variables"]:
                variables = entry.value
                if isinstance(variables, Body):
                    gone = names - used
                    variables.entries = [own for own in variables if stem_of(own) not in gone]
                    if not variables:
                        body.entries.remove(entry)


def _drop_parameters(files: list[Body], program: XacroProgram) -> None:
    """Leave out parameters that only macros read that are not called any more."""
    found: dict[str, list[Body]] = {}
    for entry in [own for sections in files for own in sections.entries_below()]:
        if entry.key == "functions" and isinstance(entry.value, Body):
            for each in entry.value:
                if isinstance(each.value, Body):
                    found.setdefault(stem_of(each), []).append(each.value)
    functions = {name: bodies[0] for name, bodies in found.items() if len(bodies) == 1}
    read = {
        macro.function: _words_in_macro(macro.element) for macro in program.definitions.values()
    }
    computed = {
        word
        for sections in files
        for entry in sections.entries_below()
        if entry.key.startswith("$(")
        for word in _WORD.findall(entry.key)
    }
    is_new = True
    while is_new:
        is_new = False
        for name, function in functions.items():
            inputs = function.entries[0] if function.entries else None
            if inputs is None or inputs.key != "input" or not isinstance(inputs.value, Row):
                continue
            if name in computed or name not in read:
                continue
            used = set(_words_in(Body(function.entries[1:]), in_keys=True))
            for piece in inputs.value.pieces:
                used.update(_WORD.findall(piece.partition("=")[2]))
            dropped = {
                own
                for piece in inputs.value.pieces
                if (own := _name_of_input(piece)) not in used and own in read[name]
            }
            if dropped:
                is_new = True
                pieces = [own for own in inputs.value.pieces if _name_of_input(own) not in dropped]
                if pieces:
                    inputs.value = Row(pieces)
                else:
                    del function.entries[0]
                for entry in [own for sections in files for own in sections.entries_below()]:
                    if entry.key.rpartition(".")[2] == name and isinstance(entry.value, Body):
                        given = entry.value
                        given.entries = [own for own in given if own.key not in dropped]
                        entry.value = given or None


def _name_of_input(piece: str) -> str:
    return piece.partition("=")[0].strip()


# --- files ----------------------------------------------------------------------------------------


def _drop_empty_files(files: dict[str, Body], main: str) -> None:
    """Leave out files with nothing in them, and their includes."""
    includes = [
        path_of_include(entry)
        for sections in files.values()
        for entry in sections.entries_below()
        if entry.key == "include"
    ]
    if any("$(" in path for path in includes):
        return  # it may be any file
    while empty := [
        path
        for path, body in files.items()
        if path != main
        and (
            not body.remark
            and all(
                entry.key == "model" and not entry.value and not entry.comment for entry in body
            )
        )
    ]:
        for path in empty:
            del files[path]
        for own, sections in files.items():
            for body in sections.bodies():
                body.entries[:] = [
                    entry
                    for entry in body
                    if entry.key != "include" or file_meant(entry, own) not in empty
                ]


def file_meant(include: Entry, path: str) -> str:
    """Return the path of the source that an include in a source names."""
    return os.path.normpath(os.path.join(os.path.dirname(path), path_of_include(include)))


def path_of_include(entry: Entry) -> str:
    """Return the path in an include, as it is written."""
    if isinstance(entry.value, Body):
        return next((str(own.value) for own in entry.value if own.key == "path"), "")
    return str(entry.value)


# --- comparisons ----------------------------------------------------------------------------------


_LITERAL = r"""('[^'\\]*'|"[^"\\]*")"""
_TEXT_OF = r"str\((\w+)\)(\.lower\(\))?"
_COMPARED = re.compile(rf"\b{_TEXT_OF} (==|!=) {_LITERAL}|{_LITERAL} (==|!=) {_TEXT_OF}")


def simplify_comparisons(files: Iterable[Body], truths: Collection[str]) -> None:
    """Write `x == 'left'` for `str(x) == 'left'`, and `x` for `str(x).lower() == 'true'`.

    Args:
        files: the sections of all files.
        truths: the names that are always true or false.
    """

    def simplified(found: re.Match[str]) -> str:
        name, lower, operator, literal = found.group(1, 2, 3, 4)
        if name is None:
            literal, operator, name, lower = found.group(5, 6, 7, 8)
        text = literal[1:-1]
        if lower and name in truths and text in ("true", "false"):
            return name if (text == "true") == (operator == "==") else f"not {name}"
        is_told_apart = isinstance(guess_value(text), str) and text.lower() not in _SHOWN
        return f"{name} {operator} {literal}" if is_told_apart and not lower else found[0]

    for sections in files:
        for entry in sections.entries_below():
            if entry.key == "condition" and isinstance(entry.value, str):
                entry.value = type(entry.value)(_COMPARED.sub(simplified, entry.value))
            elif "$(" in entry.key:
                entry.key = _in_expressions(entry.key, simplified)
            if isinstance(entry.value, str) and not isinstance(entry.value, Row):
                entry.value = type(entry.value)(_in_expressions(entry.value, simplified))


_SHOWN = ("none", "true", "false", "nan", "inf", "-inf")
"""Texts that Python shows for something that is not a text."""


def _in_expressions(text: str, simplified: Callable[[re.Match[str]], str]) -> str:
    return "".join(
        _COMPARED.sub(simplified, piece) if is_expression else piece
        for piece, is_expression in pieces_of(text)
    )


# --- words --------------------------------------------------------------------------------------


def _words_in(body: Body, *, in_keys: bool) -> Iterator[str]:
    """Return all words in values, and in keys where these are expressions, or in all keys."""
    for entry in body.entries_below():
        if in_keys or "$(" in entry.key:
            yield from _WORD.findall(entry.key)
        if isinstance(entry.value, str):
            yield from _WORD.findall(entry.value)


def words_read(body: Body) -> Iterator[str]:
    """Return the words in values and expressions, without the names of parameters."""
    for entry in body.entries_below():
        if "$(" in entry.key:
            yield from _WORD.findall(entry.key)
        if entry.key == "input" and isinstance(entry.value, Row):
            for piece in entry.value.pieces:
                yield from _WORD.findall(piece.partition("=")[2])
        elif isinstance(entry.value, str):
            yield from _WORD.findall(entry.value)


def _words_in_macro(element: object) -> set[str]:
    from ....xml.tree import Element
    from ....xml.values import format_value

    assert isinstance(element, Element)
    return {
        word
        for inner in element.iter()
        for text in (
            *(format_value(v) for k, v in inner.attributes.items() if k != "params"),
            inner.text(),
        )
        for word in _WORD.findall(text)
    }


def stem_of(entry: Entry) -> str:
    """Return the name in a key without its scope."""
    return entry.key.partition("/")[0]


# --- the section `arguments` in place of the variables that arguments became ------------------
# Nothing else can be passed to a file that has the section, and each value has to be of the
# argument's type. So it is written only if it takes all that the files of the robot show.


TEXT, NUMBER, BOOLEAN = "text", "number", "boolean"
_KINDS = {bool: BOOLEAN, int: NUMBER, float: NUMBER, str: TEXT}
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
    names = {name.replace("-", "_"): name for name in program.arguments}
    variables = _root_variables(sections)
    if variables is None or not names or len(names) < len(program.arguments):
        return False
    entries = [entry for entry in variables if stem_of(entry) in names]
    if [stem_of(entry) for entry in entries] != list(dict.fromkeys(map(stem_of, entries))):
        return False
    if {stem_of(entry) for entry in entries} != names.keys():
        return False
    if program.given.keys() - set(names.values()):
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
    # put arguments in the place of variables; `shared` are those that other files read
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
    shared = [Entry(stem_of(entry)) for entry in entries if entry.key != stem_of(entry)]
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
        for entry in sections_of_file.entries_below():
            if isinstance(entry.value, Row):
                truths -= {piece.partition("=")[0].lstrip("*") for piece in entry.value.pieces}
            elif entry.key == "variables" and isinstance(entry.value, Body):
                truths -= {stem_of(own) for own in entry.value if own.value != f"$({stem_of(own)})"}
    return truths


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
        # what declares an argument without a default, which was given
        if uses.is_text(own):
            return _record(type=TEXT)
        if len(kinds) == 1 and TEXT not in kinds:
            return _record(type=kinds.pop())
        return _record(help="to be given: it has no default")
    pieces = [piece for piece in pieces_of(default) if piece[0]]
    if len(pieces) == 1 and pieces[0][1] and not default.startswith("$(find "):
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


def _kind_of(value: object) -> str:
    return _KINDS.get(type(value), "")


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


def _drop_alias(name: str, files: Mapping[str, Body], main: str) -> None:
    """Read an argument by its own name where the main file alone read it by another.

    Something else of its name is elsewhere, and nothing in the main file but its declaration.
    """
    sections = files[main]
    variables = _root_variables(sections)
    alias = re.compile(rf"\barg_{name}\b")
    mine = list(sections.entries_below())
    named = [own for own in mine if own.key == f"arg_{name}" and own.value == f"$({name})"]
    if variables is None or len(named) != 1 or named[0] not in variables.entries:
        return
    others = [own for path in files if path != main for own in files[path].entries_below()]
    sections_of_variables = [own.value for own in mine if own.key == "variables"]
    declared = [own for body in sections_of_variables if isinstance(body, Body) for own in body]
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


# --- uses of a name: only as a text, or also as a number or truth value -----------------------


VALUE, CONDITION, OTHER = "value", "condition", "other"
_BARE = {"condition": CONDITION, "in": OTHER, "range": OTHER, "process": OTHER}
"""Entries whose texts are Python without `$()`."""
_OF_TEXTS = frozenset(("str", "len", "find", "env", "load_yaml", "print"))
"""Functions that take a text as it is."""


class _Expression:
    """A piece of Python in the sources.

    Attributes:
        tree: of it; None if it cannot be read.
        words: the names in it.
        kind: whether it gives a value, is a condition, or something else.
        target: the variable or parameter that is given its value, or "".
    """

    __slots__ = ("kind", "parents", "target", "tree", "words")

    def __init__(self, text: str, kind: str, target: str) -> None:
        self.kind = kind
        self.target = target
        self.parents: dict[ast.AST, ast.AST] = {}
        self.tree: ast.expr | None = None
        try:
            self.tree = ast.parse(f"({text.strip()}\n)", mode="eval").body
        except (SyntaxError, ValueError):
            self.words = {word for word in text.replace("(", " ").split() if word.isidentifier()}
            return
        self.words = {node.id for node in ast.walk(self.tree) if isinstance(node, ast.Name)}
        for node in ast.walk(self.tree):
            for child in ast.iter_child_nodes(node):
                self.parents[child] = node


class Uses:
    """Knows the expressions in the sources of a robot."""

    def __init__(self, files: Iterable[Body]) -> None:
        """Read all that is evaluated."""
        self._expressions = [own for sections in files for own in _expressions_in(sections)]

    def is_text(self, name: str) -> bool:
        """Return whether a name, and all that is given its value, is used only as a text."""
        names = self._aliases(name)
        for own in self._expressions:
            if not own.words & names:
                continue
            if own.tree is None:
                return False
            for node in ast.walk(own.tree):
                if isinstance(node, ast.Name) and node.id in names:
                    if not _is_as_text(node, own, names):
                        return False
        return True

    def is_counted(self, name: str) -> bool:
        """Return whether a name, or what is given its value, is a bound of a `range`."""
        names = self._aliases(name)
        return any(
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id == "range"
            and any(isinstance(own, ast.Name) and own.id in names for own in node.args)
            for expression in self._expressions
            if expression.tree is not None and expression.words & names
            for node in ast.walk(expression.tree)
        )

    def _aliases(self, name: str) -> set[str]:
        """Return a name, and those that may be given its value as it is."""
        names = {name}
        count = 0
        while len(names) > count:
            count = len(names)
            for own in self._expressions:
                if own.target and own.tree is not None and _results(own.tree) & names:
                    names.add(own.target)
        return names


def _results(node: ast.expr) -> set[str]:
    """Return the names whose values an expression may give."""
    match node:
        case ast.Name(name):
            return {name}
        case ast.IfExp(_, one, other):
            return _results(one) | _results(other)
        case ast.BoolOp(_, values):
            return set().union(*map(_results, values))
    return set()


def _is_as_text(node: ast.expr, expression: _Expression, names: set[str]) -> bool:
    """Return whether a text and the number of that spelling mean the same in a place."""
    parent = expression.parents.get(node)
    match parent:
        case None:
            return expression.kind == VALUE
        case ast.Compare(left, operators, others):
            rest = [side for side in (left, *others) if side is not node]
            return all(
                isinstance(own, (ast.Eq, ast.NotEq, ast.In, ast.NotIn)) for own in operators
            ) and all(_is_of_texts(side, names) for side in rest)
        case ast.IfExp(test, _, _):
            return node is not test and _is_as_text(parent, expression, names)
        case ast.Call(ast.Name(function), arguments):
            return function in _OF_TEXTS and node in arguments
        case ast.Attribute():
            call = expression.parents.get(parent)
            return isinstance(call, ast.Call) and call.func is parent
        case ast.BinOp(left, ast.Add(), right):
            return any(_is_surely_text(side) for side in (left, right))
        case ast.BinOp(left, ast.Mod(), _):
            return _is_surely_text(left)
        case ast.Subscript(_, index):
            return index is node
        case ast.FormattedValue():
            return True
    return False


def _is_of_texts(node: ast.expr, names: set[str]) -> bool:
    """Return whether an expression is a text, or several of them."""
    if isinstance(node, (ast.List, ast.Tuple, ast.Set)):
        return all(_is_of_texts(item, names) for item in node.elts)
    return _is_surely_text(node) or (isinstance(node, ast.Name) and node.id in names)


def _is_surely_text(node: ast.expr) -> bool:
    match node:
        case ast.Constant(value):
            return isinstance(value, str)
        case ast.JoinedStr() | ast.Call(ast.Name("str" | "find" | "env")):
            return True
        case ast.BinOp(left, ast.Add(), right):
            return _is_surely_text(left) or _is_surely_text(right)
        case ast.Call(ast.Attribute(value, "lower" | "upper" | "strip" | "replace")):
            return True
    return False


def _expressions_in(sections: Body) -> Iterator[_Expression]:
    for entry in sections.entries_below():
        if "$(" in entry.key:
            for text in _pieces(entry.key):
                yield _Expression(text, VALUE, "")
        if isinstance(entry.value, Row):
            for piece in entry.value.pieces:
                name, _, default = piece.partition("=")
                yield from _of_value(default, name.strip())
        elif isinstance(entry.value, str):
            if entry.key in _BARE:
                yield _Expression(entry.value, _BARE[entry.key], "")
            else:
                yield from _of_value(entry.value, stem_of(entry))


def _of_value(value: str, target: str) -> Iterator[_Expression]:
    pieces = list(pieces_of(value))
    is_alone = len([piece for piece, _ in pieces if piece]) == 1
    for text in _pieces(value):
        yield _Expression(text, VALUE, target if is_alone else "")


def _pieces(text: str) -> list[str]:
    """Return the Python in a text, without what ROS writes in `$(…)`."""
    found = [piece[2:-1] for piece, is_expression in pieces_of(text) if is_expression]
    return [piece for piece in found if piece.split(" ")[0] not in ("find", "env", "arg")]


# --- arguments that the main file passes to the files that read them --------------------------


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
        for entry in sections.entries_below():
            if entry.key == "variables" and isinstance(entry.value, Body):
                if name in map(stem_of, entry.value):
                    return False
            if entry.key == "include":
                if "$" in path_of_include(entry):
                    return False
                included.setdefault(file_meant(entry, path), []).append(entry)
    own = {id(entry) for entry in files[main].entries_below()}
    for entry in files[main].entries_below():
        if entry.key == "functions" and isinstance(entry.value, Body):
            own -= {id(inner) for inner in entry.value.entries_below()}
    if not all(len(included[path]) == 1 and id(included[path][0]) in own for path in readers):
        return False
    for path in readers:
        include = included[path][0]
        if not isinstance(include.value, Body):
            include.value = Body([Entry("path", include.value)], in_braces=True)
        include.value.add(name, f"$({name})")
    return True
