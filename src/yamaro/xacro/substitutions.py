"""`$(…)`: find, env, optenv, arg, eval, cwd and dirname.

A command is read once more after templates in it have been replaced; and what comes out, once more
for `$(find …)`, which an argument can bring along.
"""

from __future__ import annotations

import math

from .faults import Fault

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
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
