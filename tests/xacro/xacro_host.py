"""A host for expansions in tests: the files of the disk, packages by name, chosen variables."""

from __future__ import annotations

import glob
import os
from collections.abc import Callable, Mapping

from yamaro.diagnostics import Reporter, failure
from yamaro.policy import Limits
from yamaro.sandbox.deep_stack import run_on_deep_stack
from yamaro.source import Source, Span
from yamaro.xacro.expansion import expand
from yamaro.xml.reader import decode_xml
from yamaro.xml.tree import Element


class FileHost:
    def __init__(
        self,
        find: Callable[[str], str | None] = lambda _name: None,
        environment: Mapping[str, str] | None = None,
        limits: Limits | None = None,
    ) -> None:
        self.limits = limits or Limits()
        self.said: list[str] = []
        self._find = find
        self._environment = os.environ if environment is None else environment

    def read(self, path: str, span: Span) -> Source:
        try:
            with open(path, "rb") as file:
                return decode_xml(file.read(), name=os.path.basename(path), path=path)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise failure("missing-file", f"'{path}' cannot be read: {reason}", span) from None

    def glob(self, pattern: str) -> list[str]:
        return glob.glob(pattern)

    def find_package(self, name: str, span: Span) -> str:
        folder = self._find(name)
        if folder is None:
            raise failure("unknown-package", f"package '{name}' is not found", span)
        return folder

    def environment(self, name: str) -> str | None:
        return self._environment.get(name)

    def folder(self) -> str:
        return os.getcwd()

    def say(self, text: str, span: Span) -> None:
        self.said.append(text)


class MemoryHost(FileHost):
    """The same with files from a dict, by path."""

    def __init__(self, files: Mapping[str, str], **others: object) -> None:
        super().__init__(**others)  # type: ignore[arg-type]
        self._files = files

    def read(self, path: str, span: Span) -> Source:
        if path not in self._files:
            raise failure("missing-file", f"there is no file '{path}'", span)
        return Source(self._files[path], name=os.path.basename(path), path=path)

    def glob(self, pattern: str) -> list[str]:
        from fnmatch import fnmatch

        return [path for path in self._files if fnmatch(path, pattern)]


def expand_file(path: str, host: FileHost, arguments: Mapping[str, str]) -> Element:
    """Return the root of what a file expands to; warnings are left alone."""
    source = host.read(path, Span(Source("", name="test"), 0, 0))
    return run_on_deep_stack(lambda: expand(source, host, arguments, Reporter()))
