"""xacro's expressions and texts in the language's own spelling."""

from __future__ import annotations

import ast
import re

from ....runtime.predefined import CONSTANTS
from ....xacro.faults import Fault
from ....xacro.templates import (
    Expression,
    Part,
    Substitution,
    Template,
    guess_value,
    parse_template,
)
from ....xml.values import is_number
from ....yaml.nodes import type_plain
from ..document import Quoted, literal

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .program import XacroProgram

METHODS = frozenset(
    name
    for kind in (str, list, dict, tuple, set, float, int)
    for name in dir(kind)
    if name[0] != "_"
)
MESSAGES = ("message", "warning", "error")
"""Functions of xacro that say something to the user, and give an empty text."""
_PIECE = re.compile(r"""\$\((?P<command>[^()]*)\)|\$\{(?P<inner>[^{}]*)\}|(?P<quote>['"])""")


class CannotMigrate(Exception):
    """Something of xacro has no counterpart; the text says what."""


class Translator:
    """Translates the expressions of one file.

    Attributes:
        argument: gives the name of the variable for an argument.
        imports: the modules that the expressions need.
        used: the names they read.
    """

    def __init__(
        self,
        program: XacroProgram,
        *,
        rename: Callable[[str], str],
        argument: Callable[[str], str],
        is_namespace: Callable[[str], bool],
        data_folder: str,
    ) -> None:
        """Take the robot, and the names of a file.

        Args:
            program: the robot: it knows what its expressions and arguments give.
            rename: gives the name of the variable for a property.
            argument: gives that for an argument.
            is_namespace: decides which names are namespaces.
            data_folder: what stands before relative names of data.
        """
        self._program = program
        self._rename = rename
        self.argument = argument
        self._is_namespace = is_namespace
        self._data_folder = data_folder
        self.imports: set[str] = set()
        self.used: set[str] = set()

    # --- texts and values -----------------------------------------------------------------------

    def text(self, text: str) -> str:
        """Return a text that is written: an attribute, the content of an element, a name."""
        pieces = []
        long_floats = self._program.runs.python.long_floats
        parts = _parsed(text).parts
        for index, part in enumerate(parts):
            if isinstance(part, str):
                pieces.append(literal(part))
            elif isinstance(part, Substitution):
                words = part.text.split()
                is_package = len(words) == 2 and words[0] == "find" and "$" not in part.text
                python = " ".join(words) if is_package else self._command(part.text)
                if part.text.startswith("eval ") and self._program.is_shown_as_truth(
                    re.sub(r"\$\{([^{}]*)\}", r"(\1)", part.text[5:])
                ):
                    python = f"str({python})"
                pieces.append(f"$({python})")
            else:
                python = self.expression(part.text)
                is_ended = not _is_in_word(["", part, *parts[index + 1 :]], 1)
                if ends_in_minus(pieces) and is_ended and self._program.is_number(part.text):
                    pieces[-1] = pieces[-1][:-1]
                    python = minus(python)
                elif self._program.is_shown_as_truth(part.text) or (
                    part.text.strip() in long_floats and _is_in_word(parts, index)
                ):
                    python = f"str({python})"
                elif ends_in_minus(pieces) and self._program.is_number(part.text):
                    pieces[-1] = pieces[-1][:-1]
                    python = minus(python)
                pieces.append(f"$({python})")
        return "".join(pieces)

    def value(self, text: str, name: str = "") -> str:
        """Return the value of a variable or argument, which is a number if its text is one.

        Args:
            text: the value in xacro.
            name: of the variable or argument.
        """
        if len(text) > 1 and text[0] == text[-1] == "'" and "$" in text:
            # it is in quotes, so that it is not taken for a number
            parts = _parsed(text[1:-1]).parts
            first = parts[0].text if isinstance(parts[0], Substitution) else ""
            own = first.removeprefix("arg").strip()
            if len(parts) > 1 or not self._program.is_typed_argument(own):
                return self.text(text[1:-1])
            return f"$({self._as_text(self.argument(own))})"
        template = _parsed(text)
        if len(template.parts) == 1 and isinstance(template.parts[0], Expression):
            own = template.parts[0].text
            kind = self._program.numbers.get(own.strip())
            python = without_parentheses(self.expression(own))
            if own.strip() in self._program.copied:
                kind = "list"
            if kind:
                return f"$({kind}({python}))"
            return python if is_plain_number(python) else f"$({python})"
        plain = template.plain()
        if plain is not None:
            return typed(plain)
        if len(template.parts) == 1 and isinstance(template.parts[0], Substitution):
            own = template.parts[0].text
            kind = self._program.spelled.get(own.removeprefix("arg").strip())
            if kind:
                return f"$({kind}({self._command(own)}))"
            return self._environment(own, always=name in self._program.computed) or self.text(text)
        return self.text(text)

    def _environment(self, content: str, *, always: bool) -> str | None:
        """Return a variable of the environment as xacro reads its text.

        Args:
            content: what is in the parentheses.
            always: whether a number may be meant though the default is a text.
        """
        command, *words = content.split()
        if command not in ("env", "optenv") or not words or "$" in content:
            return None
        python = _environment(words)
        return f"$({python})" if always or " if " not in python else None

    def condition(self, text: str) -> str:
        """Return a condition as Python."""
        template = _parsed(text.strip())
        plain = template.plain()
        if plain is not None:
            return plain.lower() if plain in ("True", "False") else plain
        if len(template.parts) > 1:
            raise CannotMigrate(f"the condition '{text}' is put together of several pieces")
        (part,) = template.parts
        assert not isinstance(part, str)
        if isinstance(part, Substitution):
            is_variable = part.text.startswith(("env ", "optenv "))
            if is_variable and "$" not in part.text:
                return _environment(part.text.split()[1:])
            return self._command(part.text)
        python = without_parentheses(self.expression(part.text))
        if part.text.strip() in self._program.truth_texts:
            return f"str({python}).lower() in ('true', '1')"
        return python

    # --- Python ---------------------------------------------------------------------------------

    def expression(self, text: str) -> str:
        """Return an expression of xacro as one of Yamaro."""
        python = f"({self._without_templates(text).strip()}\n)"
        try:
            tree = ast.parse(python, mode="eval")
        except (SyntaxError, ValueError):
            raise CannotMigrate(f"the expression '{text}' is not valid Python") from None
        edits = Edits(python)
        self._look_at(tree.body, edits)
        return _SPACES.sub(lambda found: found[1] or " ", edits.text()[1:-2]).strip()

    def _look_at(self, node: ast.AST, edits: Edits, bound: frozenset[str] = frozenset()) -> None:
        """Note what has to be written in another way in a piece of syntax."""
        if isinstance(node, ast.Name):
            if node.id not in bound:
                self.used.add(node.id)
                edits.replace(node, self._rename(node.id))
            return
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            replaced = self._call_of_namespace(node, edits, bound)
            if replaced:
                return
            if node.func.attr in METHODS and not (
                isinstance(node.func.value, ast.Name)
                and node.func.value.id in ("math", "python", "xacro")
            ):
                self._look_at(node.func.value, edits, bound)
                for argument in (*node.args, *node.keywords):
                    self._look_at(argument, edits, bound)
                return
        if isinstance(node, ast.Attribute):
            self._attribute(node, edits, bound)
            return
        if isinstance(node, (ast.ListComp, ast.SetComp, ast.GeneratorExp, ast.DictComp)):
            names = [
                n.id for g in node.generators for n in ast.walk(g.target) if isinstance(n, ast.Name)
            ]
            bound = bound | frozenset(names)
        if isinstance(node, ast.Lambda):
            bound = bound | frozenset(argument.arg for argument in node.args.args)
        for child in ast.iter_child_nodes(node):
            self._look_at(child, edits, bound)

    def _call_of_namespace(self, node: ast.Call, edits: Edits, bound: frozenset[str]) -> bool:
        """Write a call such as `xacro.load_yaml`; False if it is not one."""
        func = node.func
        assert isinstance(func, ast.Attribute)
        if not isinstance(func.value, ast.Name) or func.value.id != "xacro":
            return False
        if func.attr == "arg" and len(node.args) == 1 and isinstance(node.args[0], ast.Constant):
            edits.replace(node, self.argument(str(node.args[0].value)))
            return True
        names = {"load_yaml": "load_yaml", "dotify": "", **dict.fromkeys(MESSAGES, "(print")}
        if func.attr not in names or (node.keywords and func.attr in MESSAGES):
            raise CannotMigrate(f"there is no counterpart of xacro.{func.attr}")
        edits.replace(func, names[func.attr])
        if func.attr in MESSAGES:
            edits.insert_after(node, " or '')")
        if func.attr == "load_yaml" and self._data_folder and node.args:
            is_loose = isinstance(node.args[0], (ast.IfExp, ast.BoolOp, ast.Compare))
            edits.insert_before(node.args[0], f"{self._data_folder!r} + " + "(" * is_loose)
            edits.insert_after(node.args[0], ")" * is_loose)
        for argument in (*node.args, *node.keywords):
            self._look_at(argument, edits, bound)
        return True

    def message(self, text: str) -> str | None:
        """Return what a text says to the user that is a call of `xacro.message` and no more."""
        parts = _parsed(text).parts
        if len(parts) != 1 or not isinstance(parts[0], Expression):
            return None
        try:
            call = ast.parse(self._without_templates(parts[0].text).strip(), mode="eval").body
        except (SyntaxError, ValueError):
            return None
        if not isinstance(call, ast.Call) or call.keywords:
            return None
        if ast.unparse(call.func) not in {f"xacro.{name}" for name in MESSAGES}:
            return None
        words = [
            literal(str(argument.value))
            if isinstance(argument, ast.Constant)
            else f"$({self.expression(ast.unparse(argument))})"
            for argument in call.args
        ]
        return " ".join(words)

    def _attribute(self, node: ast.Attribute, edits: Edits, bound: frozenset[str]) -> None:
        if isinstance(node.value, ast.Name):
            owner = node.value.id
            if owner in ("math", "python"):
                if owner == "math" and node.attr not in CONSTANTS:
                    self.imports.add("math")
                else:
                    edits.replace(node, node.attr)
                return
            if owner == "xacro":
                raise CannotMigrate(f"there is no counterpart of xacro.{node.attr}")
            if self._is_namespace(owner):
                return
        self._look_at(node.value, edits, bound)
        edits.replace_after(node.value, node, f"[{node.attr!r}]")

    def _without_templates(self, text: str) -> str:
        """Return an expression with the `$(…)` and `${…}` in it as Python."""
        if "$" not in text:
            return text
        out: list[str] = []
        quote = ""
        position = 0
        for found in _PIECE.finditer(text):
            out.append(text[position : found.start()])
            position = found.end()
            if found["quote"]:
                if not quote:
                    quote = found["quote"]
                elif quote == found["quote"]:
                    quote = ""
                out.append(found["quote"])
                continue
            if found["inner"] is not None:
                python = f"({self.expression(found['inner'])})"
                own = found["inner"].strip()
                kind = self._program.numbers.get(own)
                # xacro puts its text into the other, where it is read as Python
                if not quote and kind:
                    python = f"{kind}{python}"
                elif not quote and own in self._program.truth_texts:
                    python = f"(str{python}.lower() == 'true')"
            else:
                python = self._command(found["command"])
            if quote:
                out.append(f"{quote} + {self._as_text(python)} + {quote}")
            elif python.startswith("env(") and "$" not in found["command"]:
                words = found["command"].split()[1:]
                variable = _environment(words)
                out.append(f"({variable})" if " if " in variable else variable)
            else:
                out.append(python)
        out.append(text[position:])
        text = "".join(out)
        # leave out the empty texts that are added to others
        for empty in ("''", '""'):
            text = text.replace(f"{empty} + ", "").replace(f" + {empty}", "")
        return text

    def _as_text(self, python: str) -> str:
        if python.startswith("find("):
            return python
        return (
            f"str({python}).lower()"
            if python.removeprefix("arg_") in self._program.truth_arguments
            else f"str({python})"
        )

    def _command(self, content: str) -> str:
        """Return what is in a `$(…)` as Python, or in the words that ROS has for it."""
        command, *words = content.split()
        if "$" in content and command in ("find", "env") and len(words) == 1:
            return f"{command}({self.joined(words[0])})"
        if command == "arg" and "$" in content:
            raise CannotMigrate(f"the name of the argument in $({content}) is computed")
        if command == "arg" and len(words) == 1:
            self.used.add(words[0])
            return self.argument(words[0])
        if command == "find" and len(words) == 1:
            return f"find('{words[0]}')"
        if command == "env" and len(words) == 1:
            return f"env('{words[0]}')"
        if command == "optenv" and words:
            return f"env('{words[0]}', {self.joined(' '.join(words[1:])) or repr('')})"
        if command == "cwd":
            return "cwd"
        if command == "eval":
            text = content.partition("eval")[2]
            text = re.sub(r"""\barg\((['"])(\w+)\1\)""", r"\2", text)
            return self.expression(text)
        raise CannotMigrate(f"there is no counterpart of $({content})")

    def joined(self, text: str) -> str:
        """Return a text with expressions in it as one expression."""
        pieces = []
        for part in _parsed(text).parts:
            if isinstance(part, str):
                pieces.append(repr(part))
            elif isinstance(part, Substitution):
                python = self._command(part.text)
                is_text = python.startswith(("env(", "find("))
                pieces.append(python if is_text else f"str({python})")
            else:
                python = self.expression(part.text)
                pieces.append(python if self._program.is_text(part.text) else f"str({python})")
        return " + ".join(pieces)


def typed(text: str) -> str:
    """Return a text spelled so that YAML takes it for the number or truth value xacro sees."""
    from ....yaml.nodes import type_plain

    meant = guess_value(text)
    if isinstance(meant, str):
        return Quoted(literal(meant))
    read = type_plain(text)
    if type(read) is type(meant) and read == meant:
        return text
    if isinstance(meant, bool):
        return str(meant).lower()
    if isinstance(meant, float) and meant - meant != 0:
        return f"$(float({text!r}))"
    return repr(meant)


def is_typed(text: str) -> bool:
    """Return whether YAML takes a text for something else than a text where it is not quoted."""
    from ....yaml.nodes import type_plain

    return not isinstance(type_plain(text), str)


def _is_in_word(parts: Sequence[Part], index: int) -> bool:
    """Return whether a part of a text is not a whole word."""
    before = parts[index - 1] if index else ""
    after = parts[index + 1] if index + 1 < len(parts) else ""
    ends = (before[-1:] if isinstance(before, str) else "$") + (
        after[:1] if isinstance(after, str) else "$"
    )
    return bool(ends.strip())


def _parsed(text: str) -> Template:
    try:
        return parse_template(text)
    except Fault as fault:
        raise CannotMigrate(str(fault)) from None


_SPACES = re.compile(r"""('[^'\n]*'|"[^"\n]*")|\s{2,}|\n""")
"""Texts in Python, and the space between other things that takes more than one character."""


def _environment(words: Sequence[str]) -> str:
    """Return a variable of the environment, which is a number or truth value if its text is one.

    Args:
        words: its name, and the default.
    """
    name, default = words[0], " ".join(words[1:])
    meant = guess_value(default)
    if not isinstance(meant, str):
        return f"env({name!r}, {str(meant).lower() if isinstance(meant, bool) else repr(meant)})"
    is_there, other = f"env({name!r}, '')", f"env({name!r}, {default!r})"
    if not default:
        other = "''"
    return f"env({name!r}, 0) if {is_there} else {other}"


# --- Python changed where it stands: edits, negations, parentheses ----------------------------


_OPPOSITES = {"==": "!=", "!=": "==", "in": "not in", "not in": "in"}


def ends_in_minus(pieces: list[str]) -> bool:
    """Return whether the pieces of a text end in a sign for the number that follows."""
    return "".join(pieces).split(" ")[-1:] == ["-"]


def minus(python: str) -> str:
    """Return an expression with the other sign."""
    tree = ast.parse(python, mode="eval").body
    is_whole = isinstance(tree, (ast.Name, ast.Call, ast.Attribute, ast.Subscript, ast.Constant))
    return f"-{python}" if is_whole else f"-({python})"


def negated(condition: str) -> str:
    """Return the condition that is true where this one is false."""
    try:
        tree = ast.parse(condition, mode="eval").body
    except (SyntaxError, ValueError):
        return f"not ({condition})"
    if isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.Not):
        operand = without_parentheses(condition.removeprefix("not").strip())
        return operand if _is_truth_value(tree.operand) else f"bool({operand})"
    if isinstance(tree, ast.Compare) and len(tree.ops) == 1:
        left = ast.get_source_segment(condition, tree.left) or ""
        right = ast.get_source_segment(condition, tree.comparators[0]) or ""
        between = condition.removeprefix(left).removesuffix(right)
        opposite = _OPPOSITES.get(" ".join(between.split()))
        if left + between + right == condition and opposite is not None:
            return f"{left} {opposite} {right}"
    if isinstance(tree, (ast.Name, ast.Call, ast.Attribute, ast.Subscript, ast.Constant)):
        return f"not {condition}"
    return f"not ({condition})"


def _is_truth_value(node: ast.expr) -> bool:
    """Return whether an expression gives True or False, and no text, which is not a condition."""
    if isinstance(node, ast.BoolOp):
        return all(map(_is_truth_value, node.values))
    is_not = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
    return is_not or isinstance(node, ast.Compare)


def without_parentheses(python: str) -> str:
    """Return an expression without parentheses around the whole."""
    while python.startswith("(") and python.endswith(")"):
        inner = python[1:-1].strip()
        try:
            same = ast.dump(ast.parse(inner, mode="eval")) == ast.dump(
                ast.parse(python, mode="eval")
            )
        except (SyntaxError, ValueError):
            return python
        if not same:
            return python
        python = inner
    return python


class Edits:
    """Changes of a text at the places of its syntax."""

    def __init__(self, text: str) -> None:
        self._data = text.encode()
        self._starts = [0]
        for line in text.split("\n"):
            self._starts.append(self._starts[-1] + len(line.encode()) + 1)
        self._edits: list[tuple[int, int, str]] = []

    def replace(self, node: ast.expr, new: str) -> None:
        """Put a text in the place of a node."""
        self._edits.append((self._start(node), self._end(node), new))

    def replace_after(self, inner: ast.expr, node: ast.expr, new: str) -> None:
        """Put a text in the place of what follows `inner` in a node."""
        self._edits.append((self._end(inner), self._end(node), new))

    def insert_before(self, node: ast.expr, new: str) -> None:
        """Put a text in front of a node."""
        self._edits.append((self._start(node), self._start(node), new))

    def insert_after(self, node: ast.expr, new: str) -> None:
        """Put a text behind a node."""
        self._edits.append((self._end(node), self._end(node), new))

    def text(self) -> str:
        """Return the text with all changes."""
        data = self._data
        for start, end, new in sorted(self._edits, reverse=True):
            if data[start:end] != new.encode():
                data = data[:start] + new.encode() + data[end:]
        return data.decode()

    def _start(self, node: ast.expr) -> int:
        return self._starts[node.lineno - 1] + node.col_offset

    def _end(self, node: ast.expr) -> int:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return self._starts[node.end_lineno - 1] + node.end_col_offset


def is_plain_number(python: str) -> bool:
    """Return whether Python is a number that YAML reads as the same one."""
    value = type_plain(python)
    return is_number(value) and repr(value) == python
