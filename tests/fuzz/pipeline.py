"""Target: the whole compiler, on a file and those it includes.

Whatever the text, it ends in XML that another parser reads, or in diagnostics with places. It does
so twice in the same way, and also when no element is shared between places. What safe mode does not
refuse ends just so when it is trusted.

The text may hold several files: a line `#file NAME` begins another one.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

from lxml import etree

from tests.unshared import unsharing
from yamaro import api, pipeline
from yamaro.diagnostics import YamaroError
from yamaro.files.loader import LoadError
from yamaro.options import UsageError
from yamaro.policy import Policy
from yamaro.rendering import render
from yamaro.result import Build
from yamaro.sandbox import jail

from .checks import require_readable, require_sound
from .corpus import FILE_MARK, HERE, to_bytes

FOLDER = str(HERE / "files")
MAIN = os.path.join(FOLDER, "robot.yaml")
MARK = re.compile(rf"^{FILE_MARK}(.*)\n", re.M)
LIMITS = {
    "file": 200_000,
    "files": 100,
    "aliases": 20_000,
    "nesting": 300,
    "turns": 2_000,
    "statements": 20_000,
    "output": 2_000_000,
    "printed": 100_000,
    "text": 20_000,
    "sequence": 20_000,
}
SAFE_LIMITS = {**LIMITS, "steps": 200_000}
"""Low, so that a lawful program that a slip of the hand made long is none for long."""

HARMFUL = re.compile(
    r"\b(open|while|system|exec|eval|breakpoint|remove|input|iter|kill|unlink|rmtree|mkdir|sleep)\b"
    r"|\*\*\s*[\w(]|\d{6}|<<|\bnumpy\b|(\bcycle|count|repeat)\(|\b(def|import)\b|__"
)
"""Python that could do harm, and what makes a lawful program run for hours: recursion, numbers."""
REFUSED = re.compile(
    r"error\[(unsafe-code|limit-[a-z-]+|unknown-module)\]|.*'Function' object is not"
)
"""What safe mode says of what it does not know; `list[int]` is Python, too."""
SUGGESTION = re.compile(r"\n *= hint: did you mean .*")
KIND_OF_VALUE = re.compile(r"(?<=error\[python-error\]: ).*(?=\(TypeError\))")
ADDRESS = re.compile(r" at 0x[0-9a-f]+")
HARMLESS = re.compile(r"\*\*[A-Z]\w*|input:|<<:|load_yaml")

Result = tuple[str | None, tuple[str, ...], tuple[str, ...], str]
"""XML, diagnostics, prints, and the code of the first error."""


def is_harmless(text: str) -> bool:
    """Tell whether the Python in a random text can do no harm, and comes to an end."""
    return HARMFUL.search(HARMLESS.sub("", text)) is None


def is_refused(safe: Result) -> bool:
    """Tell whether it was safe mode that refused a file, and not the language."""
    return safe[0] is None and any(REFUSED.match(own) for own in safe[1])


def is_same(trusted: Result, safe: Result, text: str) -> bool:
    """Tell whether results are the same but for the order of sets, which safe mode settles.

    And but for suggestions, since the two do not know the same names, and for the words of a
    TypeError: what stands for a function in safe mode is of a type of its own.
    """
    trusted, safe = without_suggestions(trusted), without_suggestions(safe)
    if trusted == safe:
        return True
    return ("{" in text or "set(" in text) and sorted(str(trusted)) == sorted(str(safe))


def without_suggestions(result: Result) -> Result:
    xml, diagnostics, printed, code = result
    plain = (KIND_OF_VALUE.sub("", SUGGESTION.sub("", own)) for own in diagnostics)
    return xml, tuple(plain), printed, code


class Files:
    """Files in memory, as bytes."""

    def __init__(self, files: dict[str, bytes]) -> None:
        self.files = files

    def read(self, path: str) -> bytes:
        if path not in self.files:
            raise LoadError("the file does not exist")
        return self.files[path]

    def neighbours(self, path: str) -> list[str]:
        folder = os.path.dirname(path)
        return [os.path.basename(own) for own in self.files if os.path.dirname(own) == folder]


def files_in(text: str) -> dict[str, bytes]:
    pieces = MARK.split(text)
    files = {MAIN: to_bytes(pieces[0])}
    for name, piece in zip(pieces[1::2], pieces[2::2], strict=True):
        files.setdefault(os.path.normpath(os.path.join(FOLDER, name)), to_bytes(piece))
    return files


def check(text: str) -> str:
    """Compile a text; return what came of it."""
    with without_jail():
        safe = result_of(text, mode="safe")
        assert result_of(text, mode="safe") == safe, "it comes out otherwise the second time"
        with without_sharing():
            assert result_of(text, mode="safe") == safe, "it comes out otherwise without sharing"
    xml, _, _, code = safe
    if xml is not None:
        require_xml(xml)
        assert not ADDRESS.search("".join((xml, *safe[1], *safe[2]))), "an address in memory"
    if xml is not None or is_harmless(text):
        trusted = result_of(text, mode="trusted")
        assert is_refused(safe) or is_same(trusted, safe, text), "trusted it gives something else"
    return "xml" if xml is not None else code


@contextmanager
def replaced(module: Any, name: str, value: object) -> Iterator[None]:
    before = getattr(module, name)
    setattr(module, name, value)
    try:
        yield
    finally:
        setattr(module, name, before)


def without_sharing() -> AbstractContextManager[None]:
    """Let the compiler build each element for its place."""
    return replaced(pipeline, "Interpreter", unsharing)


def without_jail() -> AbstractContextManager[None]:
    """Let safe files be compiled in this process, where it can be seen what they reach."""
    return replaced(jail, "check_available", lambda: "it is not wanted")


def result_of(text: str, *, mode: str) -> Result:
    printed: list[str] = []
    try:
        build = api.build(
            MAIN,
            loader=Files(files_in(text)),
            policy=Policy(mode, limits=SAFE_LIMITS if mode == "safe" else LIMITS),
            advice=True,
            on_message=printed.append,
        )
    except YamaroError as error:
        code = require_readable(error)
        return None, tuple(map(render, error.diagnostics)), tuple(printed), code
    except UsageError as error:
        raise AssertionError(f"a usage error: {error}") from error
    require_sound(build.warnings)
    require_root(build)
    return build.xml(), tuple(map(render, build.warnings)), tuple(printed), ""


def require_root(build: Build) -> None:
    """Require that every element tells where it was made."""
    for element in elements_of(build.root):
        span = element.span
        assert 0 <= span.start <= span.end <= len(span.source.text)


def elements_of(root: Any) -> Iterator[Any]:
    pending = [root]
    while pending:
        element = pending.pop()
        yield element
        pending.extend(element.elements())


def require_xml(xml: str) -> None:
    """Require that another parser reads the document."""
    try:
        etree.fromstring(xml.encode(), etree.XMLParser(huge_tree=True))
    except etree.XMLSyntaxError as error:
        # What xmlns:… is given is the writer's own; only the reader knows what an address is.
        if "is not a valid URI" not in str(error):
            raise
