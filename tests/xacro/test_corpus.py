"""Robots of other people come out of Yamaro's engine as they come out of xacro."""

from __future__ import annotations

import csv
import os
import re
from pathlib import Path
from typing import Any
from xml.dom import minidom

import pytest

from tests.effort import tried
from tests.xacro.xacro_host import FileHost, expand_file
from yamaro.declared_arguments import listing_of
from yamaro.files.loader import FileLoader
from yamaro.files.packages import PackageFinder
from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.xml.tree import Comment, Element, Node

CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
UNKNOWN = "/opt/ros/unknown/share"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus"),
]


def real(text: str) -> str:
    return text.replace("@CORPUS@/", f"{CORPUS}/").replace("@UNKNOWN@/", f"{UNKNOWN}/")


def rows() -> list[dict[str, str]]:
    if not CORPUS.exists():
        return []
    with open(CORPUS / "xacro.tsv", encoding="utf-8") as file:
        return list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))


def name_of(row: dict[str, str]) -> str:
    return f"{row['path']} {row['args']}".strip()


def shape_expected(node: Any) -> object:
    """Return names, attributes and the words of each text, in order."""
    if isinstance(node, minidom.Element):
        children = [shape_expected(child) for child in node.childNodes]
        return node.tagName, sorted(node.attributes.items()), [c for c in children if c]
    return "" if isinstance(node, minidom.Comment) else " ".join(node.data.split())


def shape_made(node: Node) -> object:
    if isinstance(node, Element):
        children = [shape_made(child) for child in node.children]
        attributes = sorted(node.attributes.items())
        return node.name, attributes, [child for child in children if child]
    return "" if isinstance(node, Comment) else " ".join(str(node.value).split())


@pytest.mark.parametrize("row", tried(rows(), name_of, quick=20, usual=4), ids=name_of)
def test_a_robot_is_expanded_as_xacro_does(
    row: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    packages = dict(item.split("=", 1) for item in row["packages"].split(";") if item)

    def find(name: str) -> str:
        return f"{CORPUS}/src/{packages[name]}" if packages.get(name) else f"{UNKNOWN}/{name}"

    environment = {**os.environ, "ROS_VERSION": "2", "ROS_DISTRO": "humble"}
    path = CORPUS / "src" / row["path"]
    arguments = dict(re.findall(r"(\S+?):=(.*?)(?=\s\S+?:=|$)", real(row["args"])))
    monkeypatch.chdir(path.parent)
    made = expand_file(str(path), FileHost(find, environment), arguments)
    expected = minidom.parseString(real((CORPUS / row["expected"]).read_text("utf-8")))
    assert shape_made(made) == shape_expected(expected.documentElement)


@pytest.mark.parametrize("row", tried(rows(), name_of, quick=20, usual=6), ids=name_of)
def test_the_arguments_of_a_robot_are_those_that_xacro_knows(
    row: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import xacro
    from xacro import substitution_args

    packages = dict(item.split("=", 1) for item in row["packages"].split(";") if item)

    def find(name: str) -> str:
        return f"{CORPUS}/src/{packages[name]}" if packages.get(name) else f"{UNKNOWN}/{name}"

    monkeypatch.setenv("ROS_VERSION", "2")
    monkeypatch.setenv("ROS_DISTRO", "humble")
    monkeypatch.setattr(substitution_args, "_eval_find", find)
    monkeypatch.setitem(substitution_args._eval_dict, "find", find)
    path = CORPUS / "src" / row["path"]
    monkeypatch.chdir(path.parent)
    passed = dict(re.findall(r"(\S+?):=(.*?)(?=\s\S+?:=|$)", real(row["args"])))
    xacro.process_file(str(path), mappings=dict(passed))
    known = {
        name: str(value)
        for name, value in xacro.substitution_args_context["arg"].items()
        if name not in passed
    }
    source = Source(path.read_text("utf-8-sig"), name=row["path"], path=str(path))
    given = {name: f"{CORPUS}/src/{folder}" for name, folder in packages.items() if folder}
    limits = Limits()
    listing = listing_of(
        source, loader=FileLoader(limits), packages=PackageFinder(given=given), limits=limits
    )
    found = {declared.name: declared for declared in listing.declared}
    assert set(known) <= set(found)
    for name, value in known.items():
        assert not found[name].has_value or found[name].default_text == value
