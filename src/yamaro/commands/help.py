"""`yamaro help`, `yamaro COMMAND --help`: what commands do, made from the tables."""

from __future__ import annotations

from .command_table import BUILD, COMMANDS, named_commands
from .delivery import deliver
from .option_table import options_of
from .usage import WrongUsage, near, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..streams import Streams
    from .arguments import Arguments
    from .command_table import Command
    from .option import Option

COLUMNS = 100
MARGIN = 24
"""Columns before what is said of an option."""
STATUS = "exit status: 0 success, 1 errors in the input or the output, 2 wrong usage"


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the help of the command that is named; return the exit status."""
    topics = arguments.words or [BUILD]
    if topics[0] not in COMMANDS:
        hint = (
            near(topics[0], named_commands()) or f"; the commands are {', '.join(named_commands())}"
        )
        raise WrongUsage(f"unknown command {quote(topics[0])}{hint}")
    if len(topics) > 1:
        raise WrongUsage(f"unexpected argument {quote(topics[1])} after {quote(topics[0])}")
    return deliver([help_of(topics[0])], arguments, streams)


def help_of(name: str) -> str:
    """Return the help of a command; that of `yamaro FILE` also lists the others."""
    command = COMMANDS[name]
    blocks = [_usage(command), _wrapped(command.about, 0)]
    if command.words:
        blocks.append([line for word, text in command.words for line in _row(word, text)])
    options = [line for option in options_of(name) for line in _option(option, command)]
    blocks.append(["options, in any order:", *options])
    if name == BUILD:
        others = [(other, COMMANDS[other].summary) for other in named_commands()]
        rows = [line for other, summary in others for line in _row(f"yamaro {other}", summary)]
        blocks.append(["other commands; see 'yamaro COMMAND --help':", *rows])
    if command.examples:
        blocks.append(["examples:", *(f"  {example}" for example in command.examples)])
    if name == BUILD:
        blocks.append([STATUS])
    return "\n\n".join("\n".join(block) for block in blocks) + "\n"


def _usage(command: Command) -> list[str]:
    name = "yamaro" if command.name == BUILD else f"yamaro {command.name}"
    lines = [f"{name} [options] {form}" for form in command.forms]
    if command.name in ("completion", "help", "lsp", "new"):  # their only options are those of all
        lines = [f"{name} {form}" for form in command.forms]
    return [("usage: " if number == 0 else "       ") + line for number, line in enumerate(lines)]


def _option(option: Option, command: Command) -> list[str]:
    text = option.help_in.get(command.name, option.help)
    if option.is_repeatable:
        text += "; may be repeated"
    if option.name == "safe" and command.looks:
        text += "; the default, with the jail for files that safe mode rejects"
    if option.name == "trust" and not command.looks:
        text += "; the default"
    head = f"-{option.short}, " if option.short else "    "
    head += f"--{option.name}" + (f" {option.value}" if option.value else "")
    return _row(head, text)


def _row(head: str, text: str) -> list[str]:
    """Return what is said of a word, to the right of it or, if it is long, below."""
    lines = _wrapped(text, MARGIN)
    if len(head) + 3 > MARGIN:
        return [f"  {head}", *lines]
    return [f"  {head} ".ljust(MARGIN) + lines[0].lstrip(), *lines[1:]]


def _wrapped(text: str, margin: int) -> list[str]:
    """Return text in lines that fit; `textwrap` would import `re`."""
    lines = [""]
    for word in text.split(" "):
        if len(lines[-1]) + 1 + len(word) > COLUMNS - margin:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return [" " * margin + line for line in lines]
