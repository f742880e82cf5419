"""The pairs of docs/coming-from-xacro.md: xacro and Yamaro make the same XML of them.

| block | what happens |
|---|---|
| `xml xacro` | xacro runs it; the next `yaml` block must give the same XML |
| `xml xacro n:=3` | with that argument |
| `xml xacro file=leg.xacro included` | only saved, for others to include |
| `xml gives=xacro` | exactly what xacro gives for the block before it; for what differs |
| `text gives=xacro` | what xacro says on standard error when it fails on the block before it |

Statements are put in a `<robot name="example">`. Same XML: elements in the same order, attributes
in any order, numbers equal to nine digits, and white space does not count.
"""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path

import pytest
from lxml import etree

from tests.consumers.oracles import require_module
from tests.fenced import (
    REPOSITORY,
    Block,
    Compile,
    Document,
    WrongExampleError,
    read_blocks,
)
from tests.test_docs import compile_in_folder  # noqa: F401 - a fixture
from tests.waiting import PATIENCE

XACRO_NAMESPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
RUN_XACRO = "import xacro; xacro.main()"


def wrap(fragment: str) -> str:
    if fragment.lstrip().startswith(("<robot", "<?xml")):
        return fragment
    return f'<robot name="example" {XACRO_NAMESPACE}>\n{fragment}</robot>\n'


def same_value(first: str | None, second: str | None) -> bool:
    """Tell whether two texts or attribute values are the same, number by number."""
    words, others = (first or "").split(), (second or "").split()
    if len(words) != len(others):
        return False
    for word, other in zip(words, others, strict=True):
        try:
            if not math.isclose(float(word), float(other), rel_tol=1e-9, abs_tol=1e-12):
                return False
        except ValueError:
            if word != other:
                return False
    return True


def difference(first: etree._Element, second: etree._Element) -> str | None:
    """Return the first difference of two elements, or None."""
    if first.tag != second.tag:
        return f"<{first.tag}> of xacro is <{second.tag}> of Yamaro"
    for name in sorted({*first.keys(), *second.keys()}):
        if not same_value(first.get(name), second.get(name)):
            return f"{name} of <{first.tag}>: {first.get(name)!r} and {second.get(name)!r}"
    if not same_value(first.text, second.text):
        return f"text of <{first.tag}>: {first.text!r} and {second.text!r}"
    if len(first) != len(second):
        names = [[child.tag for child in element] for element in (first, second)]
        return f"children of <{first.tag}>: {names[0]} and {names[1]}"
    found = (difference(a, b) for a, b in zip(first, second, strict=True))
    return next(filter(None, found), None)


def parse(xml: str) -> etree._Element:
    return etree.fromstring(xml.encode(), etree.XMLParser(remove_comments=True))


class Comparison(Document):
    """Runs the page with the blocks for xacro, which `Document` leaves to this class."""

    def __init__(self, path: Path, folder: Path, compile_: Compile) -> None:
        super().__init__(path, folder, compile_)
        self.blocks = [
            block
            for block in read_blocks(path.read_text(encoding="utf-8"))
            if block.is_run() or self.is_for_xacro(block)
        ]
        self.xacro_xml: str | None = None
        self.compared = 0

    @staticmethod
    def is_for_xacro(block: Block) -> bool:
        return "xacro" in block.words or block.settings.get("gives") == "xacro"

    @staticmethod
    def is_expected_of(block: Block, following: Block) -> bool:
        if "xacro" in block.words:
            return following.settings.get("gives") == "xacro"
        return not Comparison.is_for_xacro(following) and Document.is_expected_of(block, following)

    def run_block(self, block: Block, expected: dict[str, Block]) -> None:
        if "xacro" in block.words:
            self.run_xacro(block, expected)
            return
        super().run_block(block, expected)
        if block.language == "yaml" and self.xacro_xml and "included" not in block.words:
            self.compare_with_xacro(block)

    def run_xacro(self, block: Block, expected: dict[str, Block]) -> None:
        if self.xacro_xml is not None:
            raise WrongExampleError("no yaml block follows the xacro block before this one")
        name = block.settings.get("file", "robot.xacro")
        self.save(name, wrap(block.text))
        if "included" in block.words:
            return
        run = subprocess.run(
            [sys.executable, "-c", RUN_XACRO, name, *block.arguments],
            cwd=self.folder,
            # xacro writes to a file as the locale says, and some locales cannot.
            env={**os.environ, "PYTHONIOENCODING": "utf-8"},
            capture_output=True,
            encoding="utf-8",
            timeout=PATIENCE,
            check=False,
        )
        if "text" in expected:
            self.compare(expected["text"].text, run.stderr, "standard error of xacro")
            return
        if run.returncode != 0:
            raise WrongExampleError(f"xacro fails:\n{run.stderr}")
        if "xml" in expected:
            elements = [etree.tostring(child, encoding="unicode") for child in parse(run.stdout)]
            actual = "".join(f"{element.strip()}\n" for element in elements)
            self.compare(expected["xml"].text, actual, "XML of xacro")
            return
        self.xacro_xml = run.stdout

    def compare_with_xacro(self, block: Block) -> None:
        name = block.settings.get("file", "robot.yaml")
        status, xml, messages = self.compile([name, *block.arguments])
        if status != 0:
            raise WrongExampleError(messages)
        of_xacro, of_yamaro = parse(self.xacro_xml or ""), parse(xml)
        self.xacro_xml = None
        self.compared += 1
        if "fragment" in block.words:
            of_yamaro.tag = of_xacro.tag
            of_xacro.attrib.clear()
            of_yamaro.attrib.clear()
        found = difference(of_xacro, of_yamaro)
        if found:
            raise WrongExampleError(f"xacro and Yamaro differ: {found}")


@pytest.fixture
def comparison(tmp_path: Path, compile_in_folder: Compile):  # noqa: F811
    require_module("xacro")

    def comparison(path: Path) -> Comparison:
        document = Comparison(path, tmp_path, compile_in_folder)
        document.run()
        return document

    return comparison


def test_xacro_and_yamaro_make_the_same_of_each_pair(comparison) -> None:
    document = comparison(REPOSITORY / "docs" / "coming-from-xacro.md")
    assert not document.failures, "\n\n".join(document.failures)
    assert document.compared >= 19


# --- the comparison itself ----------------------------------------------------------------------

XACRO = '```xml xacro\n<xacro:property name="n" value="2"/>\n<a b="${n}">${n / 4}</a>\n```\n'
YAML = "```yaml fragment\nvariables: {n: 2}\na/b=$(n): $(n / 4)\n```\n"
GIVES = '```xml gives=xacro\n<a b="2">0.5</a>\n```\n'

RIGHT = {
    "a pair": XACRO + YAML,
    "what xacro gives": XACRO + GIVES,
    "an argument": "```xml xacro n:=3\n<a>$(arg n)</a>\n```\n```yaml fragment n:=3\na: $(n)\n```\n",
    "an error of xacro": "```xml xacro\n<a>${oops}</a>\n```\n"
    "```text gives=xacro\nerror: name 'oops' is not defined\n…\n```\n",
    "an included file": "```xml xacro file=a.xacro included\n<a/>\n```\n"
    '```xml xacro\n<xacro:include filename="a.xacro"/>\n```\n```yaml fragment\na:\n```\n',
}

WRONG = {
    "another attribute": XACRO + YAML.replace("b=$(n)", "b=3"),
    "another text": XACRO + YAML.replace("/ 4", "/ 5"),
    "another element": XACRO + YAML.replace("a/b", "c/b"),
    "one more element": XACRO + YAML.replace("\n```\n", "\nc:\n```\n"),
    "other output of xacro": XACRO + GIVES.replace("0.5", "0.50"),
    "no partner": XACRO + XACRO + YAML,
}


@pytest.mark.parametrize("markdown", RIGHT.values(), ids=RIGHT)
def test_a_right_pair_passes(markdown: str, comparison, tmp_path: Path) -> None:
    path = tmp_path / "page.md"
    path.write_text(markdown)
    assert comparison(path).failures == []


@pytest.mark.parametrize("markdown", WRONG.values(), ids=WRONG)
def test_a_wrong_pair_is_found(markdown: str, comparison, tmp_path: Path) -> None:
    path = tmp_path / "page.md"
    path.write_text(markdown)
    assert len(comparison(path).failures) == 1
