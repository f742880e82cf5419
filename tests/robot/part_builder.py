"""Builds evaluated trees from short YAML, without Yamaro's own reader, parser and interpreter.

It knows keys with attributes (`joint/type=fixed`), keys in angle brackets, and scalars that are
one `$(…)`, which it evaluates as Python. Every key and scalar has its real span.
"""

from __future__ import annotations

import math

import numpy
import yaml

from yamaro.diagnostics import Diagnostic, Reporter, YamaroError
from yamaro.rendering import render
from yamaro.robot.part import lower
from yamaro.source import Source, Span
from yamaro.xml.tree import Comment, Element, PartElement, Text
from yamaro.xml.values import LiteralList
from yamaro.xml.writer import write

NAMES = {"math": math, "numpy": numpy, "pi": math.pi}


class Builder:
    def __init__(self, text, *, names=None, name="robot.yaml"):
        self.source = Source(text, name=name)
        self.names = {**NAMES, **(names or {})}

    def span(self, node):
        start, end = node.start_mark.index, node.end_mark.index
        while end > start and self.source.text[end - 1].isspace():
            end -= 1
        return Span(self.source, start, end)

    def children(self, node):
        if isinstance(node, yaml.MappingNode):
            return [self.element(key, value, body=node) for key, value in node.value]
        if isinstance(node, yaml.SequenceNode):
            if node.value and all(isinstance(n, yaml.MappingNode) for n in node.value):
                return [
                    self.element(key, value, body=node)
                    for item in node.value
                    for key, value in item.value
                ]
            return [Text(self.literal_list(node), self.span(node))]
        if node.value == "" and node.style is None:
            return []
        return [Text(self.value(node), self.span(node))]

    def value(self, node):
        if node.value.startswith("$(") and node.value.endswith(")"):
            return eval(node.value[2:-1], dict(self.names))
        return node.value

    def literal_list(self, node):
        return LiteralList(
            self.literal_list(item) if isinstance(item, yaml.SequenceNode) else self.value(item)
            for item in node.value
        )

    def element(self, key, value, *, body):
        text, span = key.value, self.span(key)
        if text == "#comment":
            return Comment(value.value, span)
        if text == "#text":
            return Text(value.value, self.span(value))
        verbatim = text.startswith("<")
        name, _, rest = text.strip("<>").partition("/")
        attributes, spans = {}, {}
        at = key.start_mark.index
        for pair in filter(None, rest.split(", ")):
            attribute, _, written = pair.partition("=")
            attributes[attribute] = written
            start = self.source.text.index(pair, at) + len(attribute) + 1
            spans[attribute] = Span(self.source, start, start + len(written))
        kind = PartElement if name == "part" and not verbatim else Element
        return kind(
            name,
            span,
            attributes=attributes,
            children=self.children(value),
            value_spans=spans,
            verbatim=verbatim,
            body=body,
        )


def build(text, *, root="robot", names=None, **attributes):
    """Return the tree of a YAML body under a root element."""
    builder = Builder(text, names=names)
    node = yaml.compose(text, Loader=yaml.BaseLoader)
    span = Span(builder.source, 0, 0)
    attributes = attributes if attributes or root != "robot" else {"name": "r"}
    return Element(root, span, attributes=attributes, children=builder.children(node))


def resolve_nothing(filename, span):
    return None


class Lowered:
    """The result of lowering: the tree, its XML, and what was found."""

    def __init__(self, tree, warnings):
        self.tree = tree
        self.warnings = warnings
        self.xml = write(tree) if tree is not None else ""

    def find(self, path):
        """Return the first element at a path such as `link/collision/origin`."""
        found = self.find_all(path)
        assert found, f"no {path} in\n{self.xml}"
        return found[0]

    def find_all(self, path):
        elements = [self.tree]
        for name in path.split("/"):
            elements = [c for e in elements for c in e.elements() if c.name == name]
        return elements

    def codes(self):
        return [diagnostic.code for diagnostic in self.warnings]


def lower_tree(tree, *, resolve_mesh=resolve_nothing):
    reporter = Reporter()
    lowered, _ = lower(tree, reporter=reporter, resolve_mesh=resolve_mesh)
    return Lowered(lowered, reporter.diagnostics)


def lower_text(text, *, resolve_mesh=resolve_nothing, **options):
    """Build and lower; raise YamaroError as `lower` does."""
    return lower_tree(build(text, **options), resolve_mesh=resolve_mesh)


def errors_of(text, *, resolve_mesh=resolve_nothing, **options) -> list[Diagnostic]:
    """Return the errors that lowering the text gives; it must give some."""
    try:
        lowered = lower_text(text, resolve_mesh=resolve_mesh, **options)
    except YamaroError as error:
        for diagnostic in error.diagnostics:
            assert render(diagnostic)
        return error.diagnostics
    raise AssertionError(f"no error in\n{lowered.xml}")


def error_of(text, **options) -> Diagnostic:
    """Return the only error that lowering the text gives."""
    errors = errors_of(text, **options)
    assert len(errors) == 1, "\n".join(render(error) for error in errors)
    return errors[0]
