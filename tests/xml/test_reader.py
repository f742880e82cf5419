"""XML is read with the place of every element, value, text and comment."""

from __future__ import annotations

from xml.dom import minidom
from xml.parsers.expat import ExpatError

import pytest
from hypothesis import given
from hypothesis import strategies as st

from yamaro.diagnostics import YamaroError
from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.xml.reader import CData, XmlDocument, decode_xml, read_xml
from yamaro.xml.tree import Comment, Element, Node, Text


def read(text: str, *, exact: bool = False, limits: Limits | None = None) -> XmlDocument:
    return read_xml(Source(text, name="robot.urdf"), limits, exact=exact)


def fault(text: str, *, exact: bool = False, limits: Limits | None = None) -> tuple[str, str, str]:
    with pytest.raises(YamaroError) as caught:
        read(text, exact=exact, limits=limits)
    (diagnostic,) = caught.value.diagnostics
    return diagnostic.code, diagnostic.span.place(), diagnostic.message


# --- what is there ------------------------------------------------------------------------------


def test_elements_keep_attributes_texts_and_comments_in_order() -> None:
    root = read('<a b="1" a="2">x<!--c--><d/>y</a>').root
    assert (root.name, root.attributes) == ("a", {"b": "1", "a": "2"})
    kinds = [type(child) for child in root.children]
    assert kinds == [Text, Comment, Element, Text]


def test_comments_around_the_root_are_kept() -> None:
    document = read("<!--1--><!--2--><a/><!--3-->")
    assert [comment.text for comment in document.before] == ["1", "2"]
    assert [comment.text for comment in document.after] == ["3"]


def test_an_encoding_or_version_that_is_declared_changes_nothing() -> None:
    assert read('<?xml version="0.0" encoding="latin-1"?><é/>').root.name == "é"


def test_entities_of_the_file_itself_are_replaced() -> None:
    assert read('<!DOCTYPE a [<!ENTITY x "1">]><a b="&x;">&x;</a>').root.attributes == {"b": "1"}


def test_cdata_is_told_from_text_where_that_is_asked_for() -> None:
    text = "<a>x<![CDATA[ <]]>y</a>"
    assert [type(child) for child in read(text, exact=True).root.children] == [Text, CData, Text]
    assert read(text).root.text() == "x <y"


# --- places -------------------------------------------------------------------------------------


def test_an_element_stands_at_its_name() -> None:
    (child,) = read("<a>\n  <bc/></a>").root.elements()
    assert (child.span.place(), child.span.written()) == ("robot.urdf:2:4", "bc")


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ('<a b="xy"/>', "xy"),
        ("<a b = 'xy'/>", "xy"),
        ('<a\n  b\n=\n"x&amp;y"></a>', "x&amp;y"),
        ('<a bb="1" b=">"/>', ">"),
        ("<a c='b=\"1\"' b=''/>", "b"),
        ('<é b="ü"/>', "ü"),
    ],
)
def test_a_value_stands_between_its_quotes(text: str, written: str) -> None:
    assert read(text).root.value_span("b").written() == written


def test_a_value_that_is_not_there_stands_at_the_element() -> None:
    assert read('<a b="1">c="2"</a>').root.value_span("c").written() == "a"


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("<a>x</a>", ["x"]),
        ("<a b='>'>x &lt; y\n<c/>z</a>", ["x &lt; y\n", "z"]),
        ("<a>é&#10;ü<c></c>&amp;</a>", ["é&#10;ü", "&amp;"]),
        ("<a>1\r\n2<!-- > -->3\r\n</a>", ["1\r\n2", "3\r\n"]),
        ("<a><![CDATA[x]]>&gt;<c/> </a>", ["x", "&gt;", " "]),
        ("<a><![CDATA[x\r\ny]]></a>", ["x\r\ny"]),
    ],
)
def test_a_text_stands_where_it_is_written(text: str, written: list[str]) -> None:
    children = read(text, exact=True).root.children
    assert [c.span.written() for c in children if isinstance(c, Text)] == written


def test_a_comment_stands_where_it_is_written() -> None:
    (comment,) = read("<é>\n<!-- c -->\n</é>").root.children[1:2]
    assert comment.span.place() == "robot.urdf:2:1"
    assert comment.span.written() == "<!-- c -->"


# --- faults -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("<a><b></a>", "robot.urdf:1:9", "mismatched tag: <b> is open"),
        ("<a>", "robot.urdf:1:4", "no element found: <a> is open"),
        ("<a>\n1 < 2</a>", "robot.urdf:2:4", "not well-formed (invalid token)"),
        ('<a b="1" b="2"/>', "robot.urdf:1:10", "duplicate attribute"),
        ("<a/><b/>", "robot.urdf:1:5", "junk after document element"),
        ("<é>&x;</é>", "robot.urdf:1:4", "undefined entity"),
    ],
)
def test_what_is_no_xml_is_told_at_its_place(text: str, place: str, message: str) -> None:
    assert fault(text) == ("xml-syntax", place, f"this is not well-formed XML: {message}")


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("<a>\n<x:b/></a>", "robot.urdf:2:2"),
        ('<a><b xmlns:x="u"/><x:b/></a>', "robot.urdf:1:21"),
        ('<a x:b="1"/>', "robot.urdf:1:4"),
    ],
)
def test_a_prefix_has_to_be_declared_where_that_is_asked_for(text: str, place: str) -> None:
    read(text)
    assert fault(text, exact=True) == (
        "xml-syntax",
        place,
        "this is not well-formed XML: unbound prefix 'x'",
    )


def test_a_prefix_holds_for_what_is_inside() -> None:
    read('<a xmlns:x="u"><x:b><c x:d="1" xml:space="default"/></x:b><x:e/></a>', exact=True)
    read('<x:a xmlns:x="u"/>', exact=True)


@pytest.mark.parametrize(
    "declaration",
    ['SYSTEM "/etc/passwd"', '"&#38;y;&#38;y;"', '"&#37;y;"'],
)
def test_an_entity_that_is_read_from_elsewhere_or_made_of_others_is_refused(
    declaration: str,
) -> None:
    code, place, message = fault(f"<!DOCTYPE a [\n<!ENTITY x {declaration}>]><a>&x;</a>")
    assert (code, place.partition(":")[0]) == ("xml-entity", "robot.urdf")
    assert message == "the entity 'x' is external, or contains other entities"


def test_depth_has_a_limit() -> None:
    read("<a><a/></a>", limits=Limits(xml_depth=2))
    code, place, _ = fault("<a><a><a/></a></a>", limits=Limits(xml_depth=2))
    assert (code, place) == ("limit-xml-depth", "robot.urdf:1:8")


# --- bytes --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-32", "latin-1", "ascii", "cp1252"]
)
def test_a_file_is_decoded_as_it_says(encoding: str) -> None:
    name = encoding.removesuffix("-sig")
    text = f'<?xml version="1.0" encoding="{name}"?><a>{"" if encoding == "ascii" else "é"}</a>'
    source = decode_xml(text.encode(encoding), name="a", path="/a")
    assert (source.text, source.name, source.path) == (text, "a", "/a")


@pytest.mark.parametrize(
    ("data", "place", "message"),
    [
        (b"<a>\n\xff</a>", "a:2:1", "the byte 0xFF is not UTF-8"),
        (
            b'<?xml version="1.0" encoding="none-such"?><a/>',
            "a:1:31",
            "unknown encoding 'none-such'",
        ),
        (b'<?xml version="1.0" encoding="utf-16"?><a/>', "a:1:31", "the file is not in utf-16"),
        (b'\n<?xml version="1.0" encoding="UTF_32"?><a/>', "a:2:31", "the file is not in UTF_32"),
    ],
)
def test_bytes_of_no_encoding_are_an_error(data: bytes, place: str, message: str) -> None:
    with pytest.raises(YamaroError) as caught:
        decode_xml(data, name="a", path="/a")
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.code == "xml-encoding"
    assert (diagnostic.span.place(), diagnostic.message) == (place, message)


def codecs_of_python() -> list[str]:
    """Return the names of all codecs that Python comes with, and their aliases."""
    import encodings.aliases
    import pkgutil

    modules = [module.name for module in pkgutil.iter_modules(encodings.__path__)]
    others = ["unicode_internal", "string-escape", "rot13", "zlib", "bz2", "mbcs", "oem", "UTF-7"]
    return [*modules, *encodings.aliases.aliases, *others]


def test_no_codec_of_python_but_text_encodings_is_used() -> None:
    """Whatever a file declares, it is read as text in which ASCII is ASCII, or refused."""
    for name in codecs_of_python():
        data = f'<?xml version="1.0" encoding="{name}"?><robot name="r-x"/>'.encode()
        try:
            text = decode_xml(data, name="a", path="/a").text
        except YamaroError:
            continue
        assert text == data.decode(), name


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_wide_text_without_a_mark_is_read(encoding: str) -> None:
    text = '<?xml version="1.0" encoding="UTF-16"?><a>é</a>'
    assert decode_xml(text.encode(encoding), name="a", path="/a").text == text


@pytest.mark.parametrize("text", ["", "links: []"])
def test_what_is_no_xml_at_all_is_told_as_such(text: str) -> None:
    assert fault(text) == ("xml-syntax", "robot.urdf:1:1", "this is not XML")


# --- the same as another reader -----------------------------------------------------------------

PIECES = st.sampled_from(
    ["<a>", "</a>", "<b c='1'/>", "x", " ", "\n", "&lt;", "&#233;", "é", "<!--c-->", "&", "<",
     "<![CDATA[<d>]]>", "\r\n", "<x:b/>", "<e xmlns:x='u' x:y='2'>", "</e>", "]]>", "--"]
)  # fmt: skip


def shape(node: Node) -> object:
    if isinstance(node, Element):
        return node.name, node.attributes, [shape(child) for child in node.children]
    if isinstance(node, Comment):
        return "#comment", node.text
    return "#cdata" if isinstance(node, CData) else "#text", node.value


def shape_of_dom(node: minidom.Node) -> object:
    if isinstance(node, minidom.Element):
        children = [shape_of_dom(child) for child in node.childNodes]
        return node.tagName, dict(node.attributes.items()), children
    if isinstance(node, minidom.Comment):
        return "#comment", node.data
    assert isinstance(node, minidom.Text)
    return "#cdata" if isinstance(node, minidom.CDATASection) else "#text", node.data


@given(st.lists(PIECES, max_size=12).map(lambda pieces: f"<r>{''.join(pieces)}</r>"))
def test_any_text_is_read_as_minidom_reads_it(text: str) -> None:
    try:
        root = minidom.parseString(text.encode()).documentElement
    except ExpatError:
        assert fault(text, exact=True)[0] == "xml-syntax"
        return
    assert root is not None
    assert shape(read(text, exact=True).root) == shape_of_dom(root)


@given(st.lists(PIECES, max_size=12).map(lambda pieces: f"<r>{''.join(pieces)}</r>"))
def test_texts_that_are_not_only_space_stand_where_they_are_written(text: str) -> None:
    try:
        pending: list[Node] = [read(text).root]
    except YamaroError:
        return
    while pending:
        node = pending.pop()
        if isinstance(node, Element):
            pending += node.children
        elif isinstance(node, Text) and "&" not in node.span.written():
            written = node.span.written().replace("\r\n", "\n")
            for mark in ("<![CDATA[", "]]>"):
                written = written.replace(mark, "")
            assert str(node.value) in written
