"""Text with `${…}` and `$(…)` in it: where each of them is, and what is in it.

A template is a row of parts: plain text, `Expression` and `Substitution`. Neither knows brackets or
quotes: the first `}` ends an expression, the first `)` a substitution. Both can contain
templates again, which are replaced before the rest is read. `$${` and `$$(` mean `${` and `$(`.
"""

from __future__ import annotations

import math
import re

from .faults import Fault

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import Any, Protocol

    class Answers(Protocol):
        """Answers the commands; each raises Fault or YamaroError where it cannot."""

        def find(self, name: str) -> str:
            """Return the folder of a package."""

        def env(self, name: str) -> str:
            """Return a variable of the environment."""

        def optenv(self, name: str, default: str = "") -> str:
            """Return a variable of the environment, or the default."""

        def arg(self, name: str) -> str:
            """Return an argument of the file."""

        def cwd(self) -> str:
            """Return the current folder."""


_PART = re.compile(
    r"(?P<plain>[^$]+|\$(?:[^{($]+|\Z))"
    r"|\$(?P<escaped>\$+[{(])"
    r"|\$\{(?P<expression>[^}]*)\}"
    r"|\$\((?P<substitution>[^)]*)\)"
)


class _Computed:
    """A part of a text that is computed.

    Attributes:
        text: the text between the brackets.
        inner: the same as a template, if there is a `$` in it.
        start, end: where in the template's text it is, with its brackets.
    """

    __slots__ = ("end", "inner", "start", "text")

    def __init__(self, text: str, start: int, end: int) -> None:
        self.text = text
        self.start = start
        self.end = end
        self.inner = parse_template(text, start + 2) if "$" in text else None


class Expression(_Computed):
    """`${…}`: Python."""

    __slots__ = ()


class Substitution(_Computed):
    """`$(…)`: a command, such as find or arg, and what it is given."""

    __slots__ = ()


Part = str | Expression | Substitution


class Template:
    """A text, in parts.

    Attributes:
        text: as it is written.
        parts: never two plain texts in a row.
    """

    __slots__ = ("parts", "text")

    def __init__(self, text: str, parts: Sequence[Part]) -> None:
        self.text = text
        self.parts = tuple(parts)

    def plain(self) -> str | None:
        """Return the value of a template that depends on no names, or None."""
        if not self.parts:
            return ""
        first = self.parts[0]
        return first if len(self.parts) == 1 and isinstance(first, str) else None


def parse_template(text: str, offset: int = 0) -> Template:
    """Return a text in parts, whose positions are counted from `offset`.

    Raises:
        Fault: a `${` or `$(` does not end, or a `$` begins neither.
    """
    parts: list[Part] = []
    position, length = 0, len(text)
    while position < length:
        found = _PART.match(text, position)
        if found is None:
            raise _unreadable(text, position, offset)
        end = found.end()
        kind = found.lastgroup
        content = found[kind] if kind else ""
        if kind == "expression":
            parts.append(Expression(content, offset + position, offset + end))
        elif kind == "substitution":
            parts.append(Substitution(content, offset + position, offset + end))
        elif parts and isinstance(parts[-1], str):
            parts[-1] += content
        else:
            parts.append(content)
        position = end
    return Template(text, parts)


def _unreadable(text: str, position: int, offset: int) -> Fault:
    opener = text[position : position + 2]
    closer = {"${": "}", "$(": ")"}.get(opener)
    start = offset + position
    if closer is None:
        return Fault(
            "xacro-expression",
            "'$$' is allowed only before '{' and '('",
            "write $${ for the text ${, and a single $ for itself",
            start=start,
            end=start + 2,
        )
    return Fault(
        "xacro-expression",
        f"'{opener}' has no '{closer}'",
        f"write ${opener} if the text {opener} is meant",
        start=start,
        end=start + 2,
    )


# --- `$(…)`: find, env, optenv, arg, eval, cwd and dirname ------------------------------------


COMMANDS = ("find", "env", "optenv", "dirname", "arg")
_EVAL = "$(eval "


def substitute(
    content: str,
    answers: Answers,
    arguments: Mapping[str, str],
    evaluate: Callable[[str, EvalNames], Any],
) -> str:
    """Return the value of `$(content)`.

    Args:
        content: without templates in it.
        answers: what is answered.
        arguments: the arguments of the file, which are names in `$(eval …)`.
        evaluate: evaluates Python in a mapping.

    Raises:
        Fault: a command is unknown, or cannot do with what it is given.
    """
    text = f"$({content})"
    if content == "cwd":
        return answers.cwd()
    if text.startswith(_EVAL):
        return str(evaluate(content[len("eval ") :], EvalNames(arguments, answers)))
    return _replaced(_replaced(text, answers, COMMANDS), answers, ("find",))


def _replaced(text: str, answers: Answers, commands: tuple[str, ...]) -> str:
    """Return a text with some of the commands in it replaced by their answers."""
    result = text
    for content in _contents(text):
        command, *words = [word for word in content.split(" ") if word] or [""]
        if command not in COMMANDS:
            raise Fault(
                "xacro-substitution",
                f"unknown command '{command}' for $(…)",
                f"the commands are {', '.join(COMMANDS)} and eval; ${{…}} is for expressions",
            )
        if command in commands:
            result = result.replace(f"$({content})", _answer(command, words, answers))
    return result


def _answer(command: str, words: list[str], answers: Answers) -> str:
    if command == "optenv":
        if not words:
            raise _wrong_count(command, "the name of a variable", words)
        return answers.optenv(words[0], " ".join(words[1:]))
    if command == "dirname":
        raise Fault(
            "xacro-substitution",
            "$(dirname) is known to launch files only; xacro does not know it",
            "write $(find package), or a path relative to this file",
        )
    if len(words) != 1:
        what = {"find": "package", "env": "variable", "arg": "argument"}[command]
        raise _wrong_count(command, f"the name of one {what}", words)
    if command == "find":
        return answers.find(words[0])
    return answers.env(words[0]) if command == "env" else answers.arg(words[0])


def _wrong_count(command: str, needed: str, words: list[str]) -> Fault:
    given = f"'{' '.join(words)}'" if words else "nothing"
    return Fault("xacro-substitution", f"$({command} …) takes {needed}, and is given {given}")


def _contents(text: str) -> list[str]:
    """Return the content of each `$(…)` of a text."""
    found = []
    position = text.find("$")
    while position >= 0:
        while text.startswith("$", position):
            position += 1
        if text.startswith("(", position) and not text.startswith(")", position + 1):
            start = position + 1
            end = start
            while end < len(text) and text[end] != ")":
                if text[end] in "$(":
                    raise Fault("xacro-substitution", f"a '{text[end]}' cannot be in $(…)")
                end += 1
            if end < len(text):
                found.append(text[start:end])
            position = end
        position = text.find("$", position)
    return found


class EvalNames:
    """The names that `$(eval …)` sees: functions, mathematics, and the arguments of the file."""

    __slots__ = ("_arguments", "_functions")

    def __init__(self, arguments: Mapping[str, str], answers: Answers) -> None:
        self._arguments = arguments
        self._functions: dict[str, Any] = {
            "true": True,
            "false": False,
            "list": list,
            "dict": dict,
            "map": map,
            "str": str,
            "float": float,
            "int": int,
            "env": answers.env,
            "optenv": answers.optenv,
            "find": answers.find,
            "arg": lambda name: guess_argument(answers.arg(name)),
        }

    def __getitem__(self, name: str) -> Any:
        if name in self._functions:
            return self._functions[name]
        if not name.startswith("_") and hasattr(math, name):
            return getattr(math, name)
        return guess_argument(self._arguments[name])


def guess_argument(text: str) -> Any:
    """Return what an argument is in `$(eval …)`: a number, a truth value or a text."""
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        pass
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    return text


# --- what a text means: a number, a truth value, or a text in quotes --------------------------


_TRUTHS = {"true": True, "True": True, "false": False, "False": False}


def guess_value(value: Any) -> Any:
    """Return what a property or parameter is when its value is this text; else, it stays as it is.

    Quotes around all of the text are taken off, and keep it a text. Python takes `1_000` for a
    number; here, it is a text.
    """
    if not isinstance(value, str):
        return value
    if len(value) > 1 and value[0] == value[-1] == "'":
        return value[1:-1]
    if "_" in value or not value:
        return value
    if value in _TRUTHS:
        return _TRUTHS[value]
    try:
        return int(value)
    except ValueError:
        pass
    try:
        return float(value)
    except ValueError:
        return value


def truth(value: Any) -> bool:
    """Return whether a condition holds.

    Raises:
        ValueError: it is a text that is neither a truth value nor a whole number.
    """
    if not isinstance(value, str):
        return bool(value)
    known = _TRUTHS.get(value)
    return bool(int(value)) if known is None else known


def is_property_name(name: str) -> bool:
    """Return whether an expression can use a name."""
    from keyword import iskeyword
    from unicodedata import normalize

    if not name.isidentifier() or iskeyword(name):
        return False
    return name.isascii() or normalize("NFKC", name) == name
