"""`Option`: an option of a command."""

from __future__ import annotations


class Option:
    """An option.

    Attributes:
        name: the long form, without the dashes.
        short: the letter of its short form, or "".
        value: what is written after it, as the help shows it; "" for an option without a value.
        wants: what the value is, for messages.
        help: what it does; up to the first `;`, `:` or `(` also for shells.
        help_in: what it does in commands where that is something else.
        commands: the names of the commands that take it.
        is_repeatable: whether it may be given several times; `Arguments.lists` holds the values.
        choices: the values it can have; any if empty.
        completes: what a shell offers for the value: "files", "commands", or words with spaces in
            between; "limits", "views", "shown" and "codes" mean the words of those tables.
        excludes: names of the options that may not be given with it.
    """

    __slots__ = (
        "choices", "commands", "completes", "excludes", "help", "help_in", "is_repeatable", "name",
        "short", "value", "wants",
    )  # fmt: skip

    def __init__(
        self,
        name: str,
        help: str,
        commands: tuple[str, ...],
        *,
        short: str = "",
        value: str = "",
        wants: str = "",
        is_repeatable: bool = False,
        choices: tuple[str, ...] = (),
        completes: str = "",
        excludes: tuple[str, ...] = (),
        help_in: dict[str, str] | None = None,
    ) -> None:
        """Describe an option."""
        self.name = name
        self.short = short
        self.value = value
        self.wants = wants
        self.help = help
        self.commands = commands
        self.is_repeatable = is_repeatable
        self.choices = choices
        self.completes = completes or " ".join(choices)
        self.excludes = excludes
        self.help_in = help_in or {}

    @property
    def spellings(self) -> tuple[str, ...]:
        """Return how it is written on the command line, the short form first."""
        return (f"-{self.short}", f"--{self.name}") if self.short else (f"--{self.name}",)
