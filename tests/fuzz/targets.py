"""The targets, by name."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import yamaro

from . import keys, pipeline, reader, template
from .corpus import read_corpus, seeds_of
from .mutations import Mutator

PACKAGE = Path(yamaro.__file__).parent
WHOLE = (
    "source.py",
    "diagnostics.py",
    "xml/tree.py",
    "xml/values.py",
    "xml/writer.py",
    "pipeline.py",
    "syntax",
    "runtime",
    "robot",
)


class Target:
    """A function that takes any text, and raises AssertionError for what must not be.

    Attributes:
        check: the function; returns a word for what came of the text.
        modules: those that it is about, in src/yamaro; or folders of them.
        longest: the longest input in bytes.
    """

    def __init__(
        self, name: str, check: Callable[[str], str], modules: Sequence[str], longest: int
    ) -> None:
        self.name = name
        self.check = check
        self.modules = modules
        self.longest = longest

    def seeds(self) -> list[str]:
        """Return texts to begin with: what the project has, and what was found before."""
        found = [*seeds_of(self.name), *read_corpus(self.name)]
        return [text for text in found if len(text) <= self.longest]

    def mutator(self) -> Mutator:
        return Mutator(self.seeds())

    def inputs(self, count: int, seed: int) -> Iterator[str]:
        """Give random inputs."""
        rng = random.Random(seed)
        mutator = self.mutator()
        return (mutator.make(rng)[: self.longest] for _ in range(count))

    def paths(self) -> list[Path]:
        """Return the files of the modules that it is about."""
        found = [PACKAGE / module for module in self.modules]
        return [own for path in found for own in ([path] if path.is_file() else path.rglob("*.py"))]


TARGETS = {
    target.name: target
    for target in (
        Target("reader", reader.check, reader.MODULES, 2_000),
        Target("keys", keys.check, keys.MODULES, 200),
        Target("template", template.check, template.MODULES, 200),
        Target("pipeline", pipeline.check, WHOLE, 4_000),
    )
}
