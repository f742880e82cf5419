"""The README, the home of the site and the picture show one robot, and the README stays short."""

from __future__ import annotations

from tests.fenced import REPOSITORY, read_blocks

PAGES = ("README.md", "docs/index.md")
ROBOT = REPOSITORY / "docs" / "pictures" / "spider.yaml"
TWO_SCREENS = 120
"""Lines."""


def test_the_robot_of_the_readme_and_of_the_home_is_that_of_the_picture() -> None:
    blocks = [read_blocks((REPOSITORY / page).read_text(encoding="utf-8")) for page in PAGES]
    robots = [next(each.text for each in page if each.language == "yaml") for page in blocks]
    assert robots == [ROBOT.read_text(encoding="utf-8")] * len(PAGES)
    outputs = [next(each.text for each in page if each.language == "xml") for page in blocks]
    assert outputs[0] == outputs[1]


def test_the_readme_and_the_home_say_the_same_sets_it_apart() -> None:
    said = []
    for page in PAGES:
        text = (REPOSITORY / page).read_text(encoding="utf-8")
        text = text.replace("](docs/", "](").replace("](../", "](")
        said.append(text.partition("## What sets it apart\n")[2].partition("\n## ")[0].strip())
    assert said[0]
    assert said[0] == said[1]


def test_the_readme_is_two_screens_long_and_names_the_two_commands() -> None:
    text = (REPOSITORY / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= TWO_SCREENS
    assert "`scripts/demo`" in text
    assert "`scripts/test`" in text
