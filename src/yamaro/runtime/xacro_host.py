"""What a xacro file that is included may ask of its surroundings: files, packages, environment."""

from __future__ import annotations

import os

from ..diagnostics import did_you_mean, failure
from ..files.loader import LoadError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..policy import Limits
    from ..source import Source, Span
    from .files import Files
    from .messages import Messages


class XacroHost:
    """Gives a xacro file what files of Yamaro get, under the same limits and from the same places.

    Attributes:
        limits: how much the expansion may use.
    """

    def __init__(
        self,
        files: Files,
        messages: Messages,
        limits: Limits,
        *,
        main: Source,
        has_environment: bool,
    ) -> None:
        """Serve the expansion of `main`; safe mode has no environment."""
        self.limits = limits
        self._files = files
        self._messages = messages
        self._main = main
        self._has_environment = has_environment

    def read(self, path: str, span: Span) -> Source:
        """Return the text of a file.

        Raises:
            YamaroError: it cannot be read.
        """
        absolute = os.path.abspath(path)
        try:
            return self._files.read_xml(absolute, self._shown(absolute), span)
        except LoadError as error:
            near = self._files.neighbours(absolute)
            raise failure(
                error.code,
                f"the file '{os.path.basename(path)}' cannot be included: {error}",
                span,
                hint=error.hint or did_you_mean(os.path.basename(absolute), near),
                notes=[f"searched for {absolute}"],
            ) from None

    def glob(self, pattern: str) -> list[str]:
        """Return the paths that a pattern of the shell matches."""
        from glob import glob

        return glob(pattern)

    def find_package(self, name: str, span: Span) -> str:
        """Return the folder of a ROS package.

        Raises:
            YamaroError: there is no such package.
        """
        start = os.path.dirname(span.source.path or self._main.path)
        folder = self._files.packages.find(name, start, span)
        if folder is None:
            raise self._files.unknown_package(name, span, start)
        return folder

    def environment(self, name: str) -> str | None:
        """Return a variable of the environment, or None if it is not set."""
        return os.environ.get(name) if self._has_environment else None

    def folder(self) -> str:
        """Return the current folder."""
        return os.getcwd()

    def say(self, text: str, span: Span) -> None:
        """Show a message."""
        self._messages.say(text)

    def _shown(self, path: str) -> str:
        """Return what a file is called in messages: as the main file is, where it lies near."""
        try:
            relative = os.path.relpath(path, os.path.dirname(self._main.path))
        except ValueError:  # on another drive
            return path
        if os.path.isabs(self._main.name) or relative.startswith(os.path.join("..", "..", "..")):
            return path
        return os.path.normpath(os.path.join(os.path.dirname(self._main.name), relative))
