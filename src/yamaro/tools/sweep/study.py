"""Studies: what is to be swept, as a file or the command line says it."""

from __future__ import annotations

import os

from ...diagnostics import Diagnostic, Reporter, YamaroError, did_you_mean, failure
from ...files.loader import FileLoader, LoadError, decode
from ...request import refusal_of_main
from ...runtime.predefined import plain_data
from ...source import holds_xml
from ...syntax.context import ParseContext, Rules
from ...syntax.values import parse_value
from ...yaml.nodes import PLAIN, MappingNode, ScalarNode, SequenceNode, is_null
from ...yaml.reader import read
from .axis_reading import words_in
from .conditions import Condition
from .methods import METHODS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...policy import Limits
    from ...source import Source, Span
    from ...yaml.nodes import YamlNode

SWEEP = "sweep"
"""The root key of a study."""
KEYS = (
    "robot", "samples", "method", "seed", "vary", "fixed", "keep", "to", "metrics", "evaluate",
    "models",
)  # fmt: skip


class Written:
    """A value, and where it is written.

    Attributes:
        data: the value.
        texts: the same, with what is written in place of numbers and truth values.
        span: its place, or None if that is not in a file.
    """

    __slots__ = ("data", "span", "texts")

    def __init__(self, data: object, span: Span | None = None, texts: object = None) -> None:
        self.data = data
        self.span = span
        self.texts = data if texts is None else texts


class Study:
    """What is to be swept.

    Attributes:
        robot: the path of the robot's file.
        name: the study's file, or the robot's, for messages.
        vary: the axes by the names of their arguments, as they are written.
        fixed: what is passed to all variants.
        samples: how many variants, or None.
        method: how they are chosen, or None.
        seed: decides about what is random.
        keep: conditions that variants have to meet.
        formats: the output formats.
        metrics: the names of metrics, each with its place.
        evaluate: a function that evaluates variants, as `file.py:function`, or None.
        folder: where the path of that file begins.
        models: whether the models are kept.
        places: where each key is written.
    """

    __slots__ = (
        "evaluate", "fixed", "folder", "formats", "keep", "method", "metrics", "models", "name",
        "places", "robot", "samples", "seed", "vary",
    )  # fmt: skip

    def __init__(self, robot: str) -> None:
        """Sweep a robot, without saying how."""
        self.robot = robot
        self.name = robot
        self.vary: dict[str, Written] = {}
        self.fixed: dict[str, Written] = {}
        self.samples: int | None = None
        self.method: str | None = None
        self.seed = 0
        self.keep: list[Condition] = []
        self.formats: list[str] = []
        self.metrics: list[Written] = []
        self.evaluate: str | None = None
        self.folder = os.getcwd()
        self.models = False
        self.places: dict[str, Span] = {}


def read_study(path: str, limits: Limits) -> Study:
    """Return the study in a file; of a robot's file, one that only names the robot.

    Raises:
        YamaroError: the file cannot be read, or has errors.
    """
    try:
        data = FileLoader(limits).read(os.path.abspath(path))
    except LoadError as error:
        raise refusal_of_main(path, error) from None
    if holds_xml(path, data):
        return Study(path)
    source = decode(data, name=path, path=os.path.abspath(path))
    root = read(source, reporter=Reporter(), limits=limits)
    if isinstance(root, MappingNode):
        for key, node in root.pairs:
            if isinstance(key, ScalarNode) and key.text == SWEEP:
                return _Parser(source).study(root, node)
    return Study(path)


class _Parser:
    """Takes the file of a study apart, and collects what is wrong with it."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._errors: list[Diagnostic] = []

    def study(self, root: MappingNode, node: YamlNode) -> Study:
        """Return the study; raise YamaroError for all that is wrong with it."""
        for key, _ in root.pairs:
            if key.text != SWEEP:
                message = f"a study has one key, `{SWEEP}`, and no '{key.text}'"
                self._error(message, key.span(), f"move it under `{SWEEP}`")
        found = self._entries(node)
        study = Study("")
        study.name = self._source.name
        study.folder = os.path.dirname(self._source.path)
        study.places = {key: value.span() for key, value in found.items()}
        if "robot" in found:
            robot = self._text(found["robot"], "robot")
            base = os.path.dirname(self._source.name)
            study.robot = os.path.normpath(os.path.join(base, os.path.expanduser(robot)))
        else:
            self._error("a study needs the key `robot`", node.span(), "robot: leg.yaml")
        self._fill(study, found)
        if self._errors:
            raise YamaroError(sorted(self._errors, key=lambda each: each.span.start))
        return study

    def _fill(self, study: Study, found: dict[str, YamlNode]) -> None:
        if "samples" in found:
            study.samples = self._integer(found["samples"], "samples", 1)
        if "seed" in found:
            study.seed = self._integer(found["seed"], "seed", 0)
        if "method" in found:
            study.method = self._text(found["method"], "method")
            if study.method not in METHODS:
                hint = did_you_mean(study.method, METHODS)
                listed = hint or f"the methods are {', '.join(METHODS)}"
                self._error(f"no method '{study.method}'", found["method"].span(), listed)
        study.vary = self._values(found.get("vary"), "vary", "{thigh: [0.2, 0.4]}")
        study.fixed = self._values(found.get("fixed"), "fixed", "{gripper: none}")
        study.keep = self._conditions(found.get("keep"))
        study.formats = self._texts(found.get("to"), "to")
        study.metrics = [
            Written(word, node.span())
            for node in self._items(found.get("metrics"))
            for word in words_in(self._text(node, "metrics"))
        ]
        if "evaluate" in found:
            study.evaluate = self._text(found["evaluate"], "evaluate")
        if "models" in found:
            models = self._data(found["models"])
            if not isinstance(models, bool):
                self._error("`models` takes true or false", found["models"].span())
            study.models = models is True

    def _conditions(self, node: YamlNode | None) -> list[Condition]:
        found = []
        for each in self._items(node):
            if not isinstance(each, ScalarNode) or not each.text.strip():
                hint = "quote one that holds a colon and a space"
                self._error("`keep` takes Python expressions", each.span(), hint)
                continue
            found.append(
                Condition(
                    each.text, name=self._source.name, file=self._source.text,
                    start=self._source.text.find(each.text, each.start),
                )
            )  # fmt: skip
        return found

    def _values(self, node: YamlNode | None, key: str, example: str) -> dict[str, Written]:
        if node is None:
            return {}
        if not isinstance(node, MappingNode):
            if isinstance(node, ScalarNode) and not node.text:
                return {}
            self._error(f"`{key}` takes names with values: {example}", node.span())
            return {}
        found: dict[str, Written] = {}
        for name, value in node.pairs:
            if name.text in found:
                self._error(f"'{name.text}' is given twice", name.span())
            found[name.text] = Written(self._data(value), value.span(), _texts(value))
        return found

    def _entries(self, node: YamlNode) -> dict[str, YamlNode]:
        if not isinstance(node, MappingNode):
            self._error(f"`{SWEEP}` has keys such as `robot`, `samples`, `vary`", node.span())
            return {}
        found: dict[str, YamlNode] = {}
        for key, value in node.pairs:
            if key.text not in KEYS:
                hint = did_you_mean(key.text, KEYS) or f"the keys are {', '.join(KEYS)}"
                message = f"a study has no key '{key.text}'"
                self._errors += failure("unknown-key", message, key.span(), hint=hint).diagnostics
            elif key.text in found:
                self._error(f"`{key.text}` is given twice", key.span())
            else:
                found[key.text] = value
        return found

    def _items(self, node: YamlNode | None) -> list[YamlNode]:
        if node is None:
            return []
        return node.items if isinstance(node, SequenceNode) else [node]

    def _texts(self, node: YamlNode | None, key: str) -> list[str]:
        return [word for each in self._items(node) for word in words_in(self._text(each, key))]

    def _text(self, node: YamlNode, key: str) -> str:
        if isinstance(node, ScalarNode) and node.text.strip():
            return node.text.strip()
        self._error(f"`{key}` takes a text", node.span())
        return ""

    def _integer(self, node: YamlNode, key: str, least: int) -> int:
        data = self._data(node)
        if isinstance(data, int) and not isinstance(data, bool) and data >= least:
            return data
        self._error(f"`{key}` takes an integer of at least {least}", node.span())
        return least

    def _data(self, node: YamlNode) -> object:
        try:
            value = parse_value(node, ParseContext(Reporter(), Rules()), is_literal=True)
        except YamaroError as error:
            self._errors += error.diagnostics
            return None
        return plain_data(value)

    def _error(self, message: str, span: Span, hint: str | None = None) -> None:
        self._errors += failure("bad-sweep", message, span, hint=hint).diagnostics


def _texts(node: YamlNode) -> object:
    """Return what is written, without reading it as numbers and truth values."""
    if isinstance(node, ScalarNode):
        return None if is_null(node.text) and node.style == PLAIN else node.text
    if isinstance(node, SequenceNode):
        return [_texts(item) for item in node.items]
    assert isinstance(node, MappingNode)
    return {key.text: _texts(value) for key, value in node.pairs}
