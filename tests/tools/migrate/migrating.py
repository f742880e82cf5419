"""Migrates XML in tests, and holds that what comes out makes the same document."""

from __future__ import annotations

from textwrap import dedent, indent

from tests.same_robot import is_same_robot
from yamaro.api import build
from yamaro.codes import ADJUSTABLE
from yamaro.layout import formatted
from yamaro.source import Source
from yamaro.tools.migrate.urdf import Migration, migrate_urdf
from yamaro.xml.reader import read_xml
from yamaro.xml.tree import Element


def migration_of(xml: str, *, exact: bool = False) -> Migration:
    def build_tree(text: str) -> Element:
        root = build(
            "robot.yaml", text=text, on_message=lambda message: None, allow=ADJUSTABLE
        ).root
        assert root is not None
        return root

    return migrate_urdf(read_xml(Source(xml, name="robot.urdf", path="")), build_tree, exact=exact)


def migrated(xml: str, *, exact: bool = False) -> str:
    """Return the YAML that a document becomes, which makes the same document."""
    migration = migration_of(xml, exact=exact)
    assert migration.differences == []
    made = build(
        "robot.yaml", text=migration.text, on_message=lambda message: None, allow=ADJUSTABLE
    ).xml()
    assert is_same_robot(xml.encode(), made.encode(), exact=exact)
    assert_in_style("robot.yaml", migration.text)
    return migration.text


def assert_in_style(name: str, text: str) -> None:
    """Assert that `yamaro fmt` leaves a source as it is."""
    assert formatted(Source(text, name=name)) == text


def model_of(body: str, *, exact: bool = False) -> str:
    """Return the model that a robot becomes whose elements are these, at the margin."""
    text = migrated(
        f'<robot name="arm">\n{indent(dedent(body).strip(), "  ")}\n</robot>\n', exact=exact
    )
    head, model = text.split("model:\n")
    return head.removeprefix("robot: arm\n") + dedent(model)
