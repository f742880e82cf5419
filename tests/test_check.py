"""The structural check: bad robots get exactly their one finding, good robots get none."""

from __future__ import annotations

import re
from pathlib import Path
from xml.parsers import expat

import pytest

from yamaro.diagnostics import WARNING, Diagnostic, Reporter, render
from yamaro.robot.check import check
from yamaro.source import Source, Span
from yamaro.xmltree import Comment, Element, Text


class UrdfReader:
    """Reads URDF into elements whose spans are real: the source is the URDF text itself."""

    def __init__(self, text: str, *, name: str = "robot.urdf") -> None:
        self.source = Source(text, name=name)
        self.stack: list[Element] = []
        self.root: Element | None = None
        self.parser = expat.ParserCreate()
        self.parser.ordered_attributes = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.text
        self.parser.CommentHandler = self.comment
        self.encoded = text.encode()
        self.parser.Parse(self.encoded, True)

    def offset(self) -> int:
        return len(self.encoded[: self.parser.CurrentByteIndex].decode())

    def start(self, name: str, attributes: list[str]) -> None:
        start = self.offset()
        position = start + 1 + len(name)
        span = Span(self.source, start, position)
        values: dict[str, object] = {}
        spans = {}
        for key, value in zip(attributes[::2], attributes[1::2], strict=True):
            values[key] = value
            equals = self.source.text.index("=", self.source.text.index(key, position))
            while self.source.text[equals] not in "\"'":
                equals += 1
            close = self.source.text.index(self.source.text[equals], equals + 1)
            spans[key] = Span(self.source, equals + 1, close)
            position = close
        element = Element(name, span, attributes=values, value_spans=spans)
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element
        self.stack.append(element)

    def end(self, name: str) -> None:
        self.stack.pop()

    def text(self, data: str) -> None:
        if data.strip():
            span = Span(self.source, self.offset(), self.offset() + len(data))
            self.stack[-1].children.append(Text(data, span))

    def comment(self, data: str) -> None:
        if self.stack:
            self.stack[-1].children.append(Comment(data, self.stack[-1].span))


def read(text: str) -> Element:
    root = UrdfReader(text).root
    assert root is not None
    return root


# --- bad robots -------------------------------------------------------------------------------

BAD_ROBOTS = Path(__file__).parent / "bad_robots"
SHORTHANDS = {
    "{links}": '<link name="a"/><link name="b"/>',
    "{ends}": '<parent link="a"/><child link="b"/>',
    "{limit}": '<limit lower="-1" upper="1" effort="1" velocity="1"/>',
    "{inertia}": '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>',
    "{box}": '<geometry><box size="1 1 1"/></geometry>',
    "{moving}": '<link name="a"/><joint name="j" type="fixed"><parent link="a"/>'
    '<child link="b"/></joint><link name="b">',
}


class BadRobot:
    """A robot with one fault: the marks « and » stand around the places to be underlined."""

    def __init__(self, name: str, codes: list[str], marked: str) -> None:
        self.name = name
        self.codes = codes
        for short, full in SHORTHANDS.items():
            marked = marked.replace(short, full)
        if not marked.lstrip("«").startswith("<robot"):
            marked = f'<robot name="r">\n{marked}\n</robot>'
        self.places = []
        text = ""
        for piece in re.split("([«»])", marked):
            if piece == "«":
                start = len(text)
            elif piece == "»":
                self.places.append((start, len(text)))
            else:
                text += piece
        self.text = text


def bad_robots(group: str) -> list[BadRobot]:
    robots = []
    for entry in (BAD_ROBOTS / f"{group}.txt").read_text(encoding="utf-8").split("### ")[1:]:
        head, _, body = entry.partition("\n")
        name, _, codes = head.partition(" | ")
        robots.append(BadRobot(name, codes.split(", "), body.strip()))
    return robots


FAULTY = [robot for group in ("tree", "joints", "links") for robot in bad_robots(group)]


def found(text: str, *, advice: bool = False) -> list[Diagnostic]:
    """Return the findings, or the advice, in order of place."""
    faults, hints = Reporter(), Reporter()
    check(read(text), reporter=faults, advice=hints if advice else None)
    return sorted((hints if advice else faults).diagnostics, key=lambda d: d.span.start)


@pytest.mark.parametrize("robot", FAULTY, ids=lambda robot: robot.name)
def test_a_bad_robot_gets_its_finding_at_the_very_place(robot: BadRobot) -> None:
    findings = found(robot.text)
    assert sorted(d.code for d in findings) == sorted(robot.codes)
    assert [(d.span.start, d.span.end) for d in findings] == robot.places


@pytest.mark.parametrize("robot", FAULTY, ids=lambda robot: robot.name)
def test_a_finding_says_what_to_do(robot: BadRobot) -> None:
    for diagnostic in found(robot.text):
        assert diagnostic.hint
        assert diagnostic.severity == WARNING
        assert diagnostic.message[0].islower() or diagnostic.message.startswith(("'", "URDF"))
        assert "\n" not in render(diagnostic).split("\n")[0]


@pytest.mark.parametrize("robot", bad_robots("advice"), ids=lambda robot: robot.name)
def test_an_odd_robot_gets_advice_and_no_warning(robot: BadRobot) -> None:
    assert found(robot.text) == []
    findings = [d for d in found(robot.text, advice=True) if d.code in robot.codes]
    assert [d.code for d in findings] == robot.codes
    assert [(d.span.start, d.span.end) for d in findings] == robot.places


def test_there_are_at_least_as_many_bad_robots_as_promised() -> None:
    assert len(FAULTY) >= 60
    assert len({robot.name for robot in FAULTY}) == len(FAULTY)


def test_every_code_is_explained() -> None:
    page = (Path(__file__).parent.parent / "docs" / "checks.md").read_text(encoding="utf-8")
    explained = set(re.findall(r"^### `([a-z0-9.-]+)`", page, re.MULTILINE))
    used = {code for robot in FAULTY + bad_robots("advice") for code in robot.codes}
    used |= {"missing-mesh-file", "unknown-package", "large-mesh", "long-chain"}
    assert used == explained
