"""XML that is being written: what is read of it, and where."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from yamaro.source import Source
from yamaro.xml.reader import read_xml
from yamaro.xml.recovery import Tags, read_broken
from yamaro.xml.tree import Element

TEXT = """<?xml version="1.0"?>
<!-- ein Fahrgestell für 🤖 -->
<robot name="r">
  <link name="base"><visual><geometry><box size="1 1 &lt;"/></geometry></visual></link>
  <!-- a joint -->
  <joint name="é" type="fixed">
    <parent link="base"/><child link='arm'/><![CDATA[ x < y ]]>
  </joint>
  <link
    name="arm"/>
</robot>
"""
PIECES = ("", "<", ">", '"', "'", "/", "&", "</robot>", "<!--", "-->", "]]>", '<link name="', "\0")


def shape(root: Element | None) -> list[object]:
    assert root is not None
    return [
        (each.name, each.span.start, [each.value_span(name).start for name in each.attributes])
        for each in root.iter()
    ]


def test_a_well_formed_text_is_read_as_it_is() -> None:
    source = Source(TEXT, name="r.urdf")
    tags = Tags(TEXT)
    assert shape(read_broken(source, tags)) == shape(read_xml(source).root)
    for tag in tags.found:
        assert TEXT.startswith((f"</{tag.name}>", f"<{tag.name}"), tag.close if tag.close != tag.end
                               else tag.start)  # fmt: skip


@settings(max_examples=examples(200))
@given(st.integers(0, len(TEXT)), st.integers(0, 30), st.sampled_from(PIECES))
def test_whatever_is_edited_the_rest_is_found_at_its_place(at: int, gone: int, new: str) -> None:
    text = TEXT[:at] + new + TEXT[at + gone :]
    source = Source(text, name="r.urdf")
    root = read_broken(source, Tags(text))
    if root is None:  # its first tag is gone
        assert at < TEXT.index('name="r"')
        return
    for element in root.iter():
        assert text.startswith(element.name, element.span.start)
        for name, value in element.attributes.items():
            if "&" not in (written := element.value_span(name).written()) and value:
                assert len(written) == len(str(value))


def test_open_tags_are_closed_and_stray_ones_are_left_out() -> None:
    text = (
        '<robot><link name="a"><visual></link><joint name="b" <child link="c"></geometry></robot>'
    )
    root = read_broken(Source(text, name="r.urdf"), Tags(text))
    assert root is not None
    assert [each.name for each in root.elements()] == ["link", "joint"]
    assert [each.name for each in root.iter()] == ["robot", "link", "visual", "joint", "child"]
