"""Empty links on fixed joints become frames of the part above, where the robot stays the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.migrating import migration_of, model_of
from tests.tools.migrate.test_xacro_migration import hold_for, migrated

BASE = '<link name="base_link"><inertial><mass value="1"/></inertial></link>'
ARM = """
<joint name="arm_joint" type="fixed"><parent link="base_link"/><child link="arm_link"/></joint>
<link name="arm_link"/>
"""


def tool(parent: str = "base_link", name: str = "tool0", *, link: str = "", joint: str = "") -> str:
    """Return an empty link on a fixed joint."""
    return f"""
    <joint name="{name}_joint" type="fixed">
      <parent link="{parent}"/><child link="{name}"/><origin xyz="0 0 1" rpy="0 0 0"/>{joint}
    </joint>
    <link name="{name}">{link}</link>"""


def test_an_empty_link_below_a_part_is_a_frame() -> None:
    assert model_of(BASE + tool() + tool(name="eye")) == (
        "part:\n  name: base\n  link:\n    <inertial>: {mass/value=1: }\n"
        "    frame/name=tool0: {xyz: 0 0 1}\n    frame/name=eye: {xyz: 0 0 1}\n"
    )


def test_a_part_without_a_link_gets_one() -> None:
    made = model_of(BASE + ARM + tool("arm_link"))
    assert "  link:\n      frame/name=tool0: {xyz: 0 0 1}\n" in made


def test_parts_may_be_on_a_frame() -> None:
    above = ARM.replace('"base_link"', '"tool0"')
    assert "parent: tool0" in model_of(BASE + tool() + above)


@pytest.mark.parametrize(
    "body",
    [
        BASE + ARM + tool(),  # the joints and links of another part are between
        BASE + tool(link="<visual><geometry><sphere radius='1'/></geometry></visual>"),
        BASE + tool(joint='<axis xyz="0 0 1"/>'),
        BASE + tool().replace("tool0_joint", "to_tool0"),
        BASE + tool().replace('"fixed"', '"floating"'),
        tool(),  # the link above is not there
        BASE + tool(name="tool 0"),
    ],
)
def test_anything_else_is_none(body: str) -> None:
    migration = migration_of(f'<robot name="r">{body}</robot>')
    assert "frame/" not in migration.text
    assert migration.differences == []


def test_comments_stay_with_their_frame() -> None:
    made = model_of(f"{BASE}\n<!-- where tools are -->{tool()} <!-- at the tip -->\n{ARM}")
    assert "    # where tools are\n" in made
    assert "frame/name=tool0: {xyz: 0 0 1}  # at the tip\n" in made


def test_where_every_letter_counts_a_missing_origin_stays_missing() -> None:
    bare = tool().replace('<origin xyz="0 0 1" rpy="0 0 0"/>', "")
    assert "frame/name=tool0:" in model_of(BASE + bare)
    assert "frame/" not in model_of(BASE + bare, exact=True)


def test_names_may_be_computed(tmp_path: Path) -> None:
    text = '<xacro:arg name="p" default="a_"/>' + BASE + tool(name="$(arg p)tool")
    text += '<xacro:macro name="arm" params="side">' + tool("base_link", "${side}_at")
    text += "</xacro:macro>" + '<xacro:arm side="left"/>'
    made = migrated(tmp_path, text)["r.yaml"]
    assert "      frame/name=$(p)tool: {xyz: 0 0 1}\n" in made
    assert "frame/name=$(side)" not in made  # the part above is not in the macro
    hold_for(tmp_path, [], ["p:=b_"])


def test_what_has_statements_is_none(tmp_path: Path) -> None:
    text = '<xacro:arg name="on" default="true"/>' + BASE
    visual = "<visual><geometry><sphere radius='1'/></geometry></visual>"
    text += tool(link=f'<xacro:if value="$(arg on)">{visual}</xacro:if>')
    assert "frame/" not in migrated(tmp_path, text)["r.yaml"]
    hold_for(tmp_path, [], ["on:=false"])
