"""Random xacro documents come out as they do from xacro, or both refuse them."""

from __future__ import annotations

import contextlib
import io
from typing import Any
from xml.dom import minidom

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.xacro.xacro_host import MemoryHost
from yamaro.diagnostics import Reporter, YamaroError
from yamaro.sandbox.deep_stack import run_on_deep_stack
from yamaro.source import Source
from yamaro.xacro.expansion import expand
from yamaro.xml.writer import write

xacro: Any = pytest.importorskip("xacro")

HEAD = '<r xmlns:xacro="http://www.ros.org/wiki/xacro">'

NAMES = st.sampled_from(["a", "b", "c"])
MACROS = st.sampled_from(["m", "n"])
EXPRESSIONS = st.sampled_from(
    ["a", "b", "c", "a+1", "a*b", "str(a)+'x'", "[a, 2]", "c[0]", "1/3", "True", "a == 1", "",
     " b ", "pi", "math.sin(a)", "radians(90)", "dict(k=a)", "dict(k=a).k", "len(c)", "1e-7",
     "xacro.arg('x')", "a if a else b", "__import__", "d", "python.sorted([2, a])", "None",
     "xacro.dotify(dict(k=a)).k", "[i*2 for i in c]", "'1'", "'true'", "2**0.5", "1e22", "-0.0"]
)  # fmt: skip
PIECES = st.one_of(
    EXPRESSIONS.map(lambda text: f"${{{text}}}"),
    st.sampled_from(
        ["1", "2.0", "0", "-3", "true", "False", "x", " ", "'1'", "'${a}'", "$", "$$", "$${a}",
         "$$(x)", "$(arg x)", "$(arg y)", "$(arg ${b})", "$(eval 1 + 2)", "$(eval x)", "$()",
         "$(optenv NONE_SUCH z)", "$(env NONE_SUCH)", "$(nothing a)", "1_0", "inf", "${", "}",
         "1e3", " 4 ", "&amp;", "&lt;", "0x10", "$(cwd", "xacro"]
    ),
)  # fmt: skip
VALUES = st.lists(PIECES, min_size=0, max_size=3).map("".join)
USUALLY_ONE = st.one_of(PIECES, PIECES, VALUES)
SPACES = st.sampled_from(["", "\n", "\n  ", "\n\n", " "])
DEFAULTS = st.sampled_from(
    ["", "", ":=1", "=2", ":=${a}", ":='x y'", ":=^", ":=^|3", ":=^|'q'", ":=", "=a'b c'd", ":= 1"]
)


def attribute(name: str, value: str) -> str:
    return f' {name}="{value}"'


@st.composite
def parameters(draw: st.DrawFn) -> str:
    listed = draw(st.lists(st.tuples(NAMES, DEFAULTS), max_size=2, unique_by=lambda pair: pair[0]))
    blocks = draw(st.sampled_from(["", "", "", " *p", " **p", " *p **q"]))
    return " ".join(name + default for name, default in listed) + blocks


@st.composite
def optional(draw: st.DrawFn, name: str, values: st.SearchStrategy[str]) -> str:
    value = draw(st.one_of(st.none(), st.none(), values))
    return "" if value is None else attribute(name, value)


@st.composite
def property_tag(draw: st.DrawFn, content: st.SearchStrategy[str]) -> str:
    name = draw(st.one_of(NAMES, NAMES, NAMES, st.sampled_from(["p", "pi", "${b}", "1", "in"])))
    head = "<xacro:property" + attribute("name", name)
    head += draw(optional("scope", st.sampled_from(["parent", "global", "local"])))
    head += draw(optional("lazy_eval", st.sampled_from(["false", "true", "0", "${a}"])))
    kind = draw(st.sampled_from(["value", "value", "value", "value", "default", "remove", "block"]))
    if kind == "remove":
        return head + attribute("remove", draw(st.sampled_from(["true", "false", "1"]))) + "/>"
    if kind == "block":
        return f"{head}>{draw(content)}</xacro:property>"
    return head + attribute(kind, draw(USUALLY_ONE)) + "/>"


@st.composite
def call_tag(draw: st.DrawFn, content: st.SearchStrategy[str]) -> str:
    given_ = draw(st.dictionaries(NAMES, USUALLY_ONE, max_size=2))
    attributes = "".join(attribute(name, value) for name, value in given_.items())
    name = draw(MACROS)
    if draw(st.integers(0, 5)) == 0:
        return f'<xacro:call macro="{name}"{attributes}>{draw(content)}</xacro:call>'
    inner = draw(st.one_of(st.just(""), content))
    return f"<xacro:{name}{attributes}>{inner}</xacro:{name}>"


@st.composite
def other_tag(draw: st.DrawFn, content: st.SearchStrategy[str]) -> str:
    kind = draw(
        st.sampled_from(["e", "f", "if", "unless", "insert", "element", "attribute", "arg"])
    )
    if kind in ("if", "unless"):
        return (
            f"<xacro:{kind}{attribute('value', draw(USUALLY_ONE))}>{draw(content)}</xacro:{kind}>"
        )
    if kind == "insert":
        return f"<xacro:insert_block{attribute('name', draw(st.sampled_from('pqa')))}/>"
    if kind == "element":
        name = draw(st.sampled_from(["g", "${b}", "xacro:m", "xacro:if", ""]))
        given_ = draw(optional("value", USUALLY_ONE))
        return (
            f"<xacro:element{attribute('xacro:name', name)}{given_}>{draw(content)}</xacro:element>"
        )
    if kind == "attribute":
        name = draw(st.sampled_from(["k", "k${a}", "h"]))
        value = attribute("value", "v" + draw(USUALLY_ONE))
        return f"<xacro:attribute{attribute('name', name)}{value}/>"
    if kind == "arg":
        name = draw(st.sampled_from("xy"))
        return f"<xacro:arg{attribute('name', name)}{attribute('default', draw(USUALLY_ONE))}/>"
    return f"<{kind}{draw(optional('k', USUALLY_ONE))}>{draw(content)}</{kind}>"


@st.composite
def macro_tag(draw: st.DrawFn, content: st.SearchStrategy[str]) -> str:
    head = f"<xacro:macro{attribute('name', draw(MACROS))}"
    return f"{head}{attribute('params', draw(parameters()))}>{draw(content)}</xacro:macro>"


COMMENTS = st.sampled_from(
    ["<!--c-->", "<!-- ${a} -->", "<!-- xacro:eval-comments -->", "<!--xacro:eval-comments:off-->"]
)


def contents(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    node = st.one_of(
        other_tag(inner),
        other_tag(inner),
        property_tag(inner),
        call_tag(inner),
        macro_tag(inner),
        COMMENTS,
        USUALLY_ONE,
        st.sampled_from(["<![CDATA[${a}]]>", "<s/>"]),
    )
    return st.lists(st.tuples(SPACES, node, SPACES).map("".join), max_size=4).map("".join)


CONTENT = st.recursive(st.just("<l k='${a}'/>"), contents, max_leaves=8)
SOME_NAMES = """
<xacro:property name="a" value="1"/><xacro:property name="b" value="t"/>
<xacro:property name="c" value="${[1, a]}"/>"""
LAZY_NAMES = """
<xacro:property name="a" value="${b*2}"/><xacro:property name="b" value="2"/>
<xacro:macro name="m" params="a:=^|5 *p"><e a="${a}"><xacro:insert_block name="p"/></e>
</xacro:macro>"""
START = st.sampled_from(["", SOME_NAMES, LAZY_NAMES])
DOCUMENTS = st.tuples(START, contents(CONTENT)).map(lambda parts: f"{HEAD}{''.join(parts)}</r>")


def shape(node: Any) -> Any:
    if node.nodeType == node.ELEMENT_NODE:
        children: list[Any] = [""]
        for child in node.childNodes:
            inner = shape(child)
            if isinstance(inner, str) and isinstance(children[-1], str):
                children[-1] += inner  # CDATA beside text
            else:
                children.append(inner)
        words = [" ".join(c.split()) if isinstance(c, str) else c for c in children]
        return node.tagName, sorted(node.attributes.items()), [word for word in words if word]
    return ("comment", node.data) if node.nodeType == node.COMMENT_NODE else node.data


def by_xacro(text: str) -> Any:
    """Return the shape of what xacro makes of a document, or None if it refuses it."""
    with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
        try:
            document = xacro.parse(text)
            xacro.init_stacks(None)
            xacro.process_doc(document, mappings={"x": "7"})
            written = document.toprettyxml(indent="  ")
            return shape(minidom.parseString(written.encode()).documentElement)
        except Exception:
            return None


def by_us(text: str) -> Any:
    source = Source(text, name="test")
    try:
        root = run_on_deep_stack(lambda: expand(source, MemoryHost({}), {"x": "7"}, Reporter()))
        return shape(minidom.parseString(write(root).encode()).documentElement)
    except YamaroError:
        return None


@settings(max_examples=examples(300))
@given(DOCUMENTS)
@example(f"{HEAD}<e><!--c-->\n<xacro:property name='a' value='1'/>\n<!--d--></e></r>")
def test_a_document_comes_out_as_from_xacro(text: str) -> None:
    assert by_us(text) == by_xacro(text)
