"""What the expansion of a xacro file asks of its surroundings."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Protocol

    from ..policy import Limits
    from ..source import Source, Span

    class Host(Protocol):
        """Gives files, packages and variables of the environment.

        Attributes:
            limits: how much one expansion may use.
        """

        limits: Limits

        def read(self, path: str, span: Span) -> Source:
            """Return the text of a file; `path` may be relative to the current folder.

            Raises:
                YamaroError: it cannot be read; the code is `missing-file` where xacro, too, would
                    take it for missing, as `optional="true"` allows.
            """

        def glob(self, pattern: str) -> list[str]:
            """Return the paths that a pattern of the shell matches, in any order."""

        def find_package(self, name: str, span: Span) -> str:
            """Return the folder of a package, for `$(find name)`, or raise YamaroError."""

        def environment(self, name: str) -> str | None:
            """Return the value of a variable of the environment, or None if it is not set."""

        def folder(self) -> str:
            """Return the current folder, for `$(cwd)`."""

        def say(self, text: str, span: Span) -> None:
            """Show the message of `xacro.message`."""
