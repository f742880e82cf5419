"""What a xacro file expands to, where its elements come from, and what is said when it fails."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

import pytest

from tests.xacro.xacro_host import MemoryHost
from yamaro.diagnostics import Diagnostic, Reporter, YamaroError
from yamaro.policy import Limits
from yamaro.rendering import trace_lines
from yamaro.sandbox.deep_stack import run_on_deep_stack
from yamaro.source import Source
from yamaro.xacro.evaluator import Python
from yamaro.xacro.expansion import expand
from yamaro.xml.tree import Element
from yamaro.xml.writer import write


def prop(name: str, value: str, **others: str) -> str:
    attributes = "".join(f' {key}="{text}"' for key, text in others.items())
    return f'<xacro:property name="{name}" value="{value}"{attributes}/>'


HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'


class Expanded:
    def __init__(
        self,
        body: str,
        files: Mapping[str, str] | None = None,
        arguments: Mapping[str, str] | None = None,
        limits: Limits | None = None,
    ) -> None:
        included = {f"/r/{name}": text for name, text in (files or {}).items()}
        environment = {"HOME": "/home/ann"}
        self.host = MemoryHost(
            included,
            find={"arm": "/share/arm"}.get,
            environment=environment,
            limits=limits,
        )
        self.reporter = Reporter()
        source = Source(f"{HEAD}{body}\n</robot>", name="robot.xacro", path="/r/robot.xacro")
        self.root: Element = run_on_deep_stack(
            lambda: expand(source, self.host, arguments or {}, self.reporter)
        )


def expanded(
    body: str, files: Mapping[str, str] | None = None, arguments: Mapping[str, str] | None = None
) -> str:
    """Return what stands in the root, on lines without margins."""
    lines = write(Expanded(body, files, arguments).root).splitlines()
    return "\n".join(line.strip() for line in lines[2:-1])


def attribute(expression: str, before: str = "") -> str:
    """Return the text that an expression gives."""
    root = Expanded(f'{before}<a v="{expression}"/>').root
    return str(root.elements()[-1].attributes["v"])


def fault(
    body: str, files: Mapping[str, str] | None = None, limits: Limits | None = None
) -> tuple[str, ...]:
    """Return the code of an error, its line and what is underlined, and the trace."""
    with pytest.raises(YamaroError) as caught:
        Expanded(body, files, limits=limits)
    return told(caught.value.diagnostics[0])


def warning(body: str, files: Mapping[str, str] | None = None) -> tuple[str, ...]:
    (diagnostic,) = Expanded(body, files).reporter.diagnostics
    return told(diagnostic)


def told(diagnostic: Diagnostic) -> tuple[str, ...]:
    span = diagnostic.span
    line = f"{span.source.name}:{span.location()[0]}".replace("robot.xacro:", "line ")
    return diagnostic.code, line, span.written(), *trace_lines(diagnostic.trace)


def hint(body: str) -> str | None:
    with pytest.raises(YamaroError) as caught:
        Expanded(body)
    return caught.value.diagnostics[0].hint


# --- values -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("${1 + 1}", "2"),
        ("${1/3}", "0.3333333333333333"),
        ("${1e22}", "1e+22"),
        ("${True}", "True"),
        ("${'a' + 'b'}", "ab"),
        ("${[1, 2.5]}", "[1, 2.5]"),
        ("a${1}b${2}", "a1b2"),
        ("$${x}", "${x}"),
        ("$$(x)", "$(x)"),
        ("5$", "5$"),
        ("$()", "$()"),
        ("${radians(180)}", "3.141592653589793"),
        ("${math.pi == pi}", "True"),
        ("${python.sorted([2, 1])}", "[1, 2]"),
        ("${xacro.tokenize('a;b c')}", "['a', 'b', 'c']"),
        ("${[i * i for i in range(3)]}", "[0, 1, 4]"),
        ("$(find arm)/meshes", "/share/arm/meshes"),
        ("$(find ${'a' + 'rm'})", "/share/arm"),
        ("$(env HOME)", "/home/ann"),
        ("$(optenv NONE a  b)", "a b"),
        ("$(eval 1 + 1)", "2"),
        ("${$(eval 2) * 3}", "6"),
    ],
)
def test_a_text_has_a_value(text: str, value: str) -> None:
    assert attribute(text) == value


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("1", "int"),
        (" 1 ", "int"),
        ("1.0", "float"),
        ("1e3", "float"),
        ("inf", "float"),
        ("true", "bool"),
        ("True", "bool"),
        ("yes", "str"),
        ("1_000", "str"),
        ("'1", "str"),
        ("", "str"),
        ("${[1]}", "list"),
        ("0x10", "str"),
    ],
)
def test_a_property_is_what_its_text_looks_like(text: str, kind: str) -> None:
    named = f'<xacro:property name="p" value="{text}"/>'
    assert attribute("${python.type(p)}", named) == f"<class '{kind}'>"


def test_a_property_is_evaluated_when_it_is_needed() -> None:
    assert (
        expanded(
            '<xacro:property name="a" value="${b * 2}"/><xacro:property name="b" value="3"/>'
            '<l v="${a}"/><xacro:property name="b" value="4"/><l v="${a}"/>'
        )
        == '<l v="6"/>\n<l v="6"/>'
    )


def test_a_property_can_be_evaluated_at_once() -> None:
    assert (
        expanded(
            '<xacro:property name="a" value="1"/>'
            '<xacro:property name="a" value="${a + 1}" lazy_eval="false"/><l v="${a}"/>'
        )
        == '<l v="2"/>'
    )


def test_a_default_counts_only_where_there_is_no_value() -> None:
    assert (
        expanded(
            '<xacro:property name="a" value="1"/><xacro:property name="a" default="2"/>'
            '<xacro:property name="b" default="3"/><l v="${a} ${b}"/>'
        )
        == '<l v="1 3"/>'
    )


def test_a_property_can_be_removed() -> None:
    assert (
        expanded(
            '<xacro:property name="a" value="1"/><xacro:property name="a" remove="true"/>'
            '<xacro:property name="a" default="2"/><l v="${a}"/>'
        )
        == '<l v="2"/>'
    )


def test_a_macro_gives_properties_to_its_caller_or_to_all() -> None:
    assert (
        expanded(
            '<xacro:macro name="m"><xacro:property name="a" value="1" scope="parent"/>'
            '<xacro:property name="b" value="2" scope="global"/>'
            '<xacro:property name="c" value="3"/></xacro:macro>'
            '<xacro:property name="c" value="0"/><xacro:m/><l v="${a} ${b} ${c}"/>'
        )
        == '<l v="1 2 0"/>'
    )


def test_arguments_have_defaults() -> None:
    body = '<xacro:arg name="x" default="${1 + 1}"/><l v="$(arg x)" w="${xacro.arg(\'x\') * 2}"/>'
    assert expanded(body) == '<l v="2" w="22"/>'
    assert expanded(body, arguments={"x": "a"}) == '<l v="a" w="aa"/>'


# --- macros -------------------------------------------------------------------------------------


def test_a_macro_has_parameters_and_defaults() -> None:
    assert (
        expanded(
            """<xacro:macro name="m" params="a b:=${a_} c:='x y' d=^ f:=^|5">
        <l v="${a} ${b} ${c} ${d} ${f}"/></xacro:macro>
        <xacro:property name="a_" value="7"/><xacro:property name="d" value="8"/>
        <xacro:m a="1"/><xacro:m a="1" b="2" c="3" d="4" f="6"/>"""
        )
        == '<l v="1 7 x y 8 5"/>\n<l v="1 2 3 4 6"/>'
    )


def test_a_macro_takes_blocks() -> None:
    assert (
        expanded(
            '<xacro:macro name="m" params="*one **more"><xacro:insert_block name="more"/>'
            '<xacro:insert_block name="one"/></xacro:macro>'
            "<xacro:m><o/><p><q/><r/></p></xacro:m>"
        )
        == "<q/>\n<r/>\n<o/>"
    )


def test_a_property_can_hold_a_block() -> None:
    assert (
        expanded(
            '<xacro:property name="origin"><o v="${x}"/></xacro:property>'
            '<xacro:property name="x" value="1"/><l><xacro:insert_block name="origin"/></l>'
        )
        == '<l>\n<o v="1"/>\n</l>'
    )


def test_a_block_is_evaluated_for_the_caller_and_again_where_it_is_put() -> None:
    assert (
        expanded(
            '<xacro:macro name="m" params="x *b"><xacro:insert_block name="b"/></xacro:macro>'
            '<xacro:property name="x" value="1"/><xacro:m x="2"><l v="${x} $${x}"/></xacro:m>'
        )
        == '<l v="1 2"/>'
    )


def test_a_macro_can_be_called_by_name() -> None:
    assert (
        expanded(
            '<xacro:macro name="left" params="n"><l v="${n}"/></xacro:macro>'
            "<xacro:call macro=\"${'le' + 'ft'}\" n=\"1\"/>"
        )
        == '<l v="1"/>'
    )


def test_a_macro_may_recurse() -> None:
    text = expanded(
        '<xacro:macro name="m" params="n"><l v="${n}"/>'
        '<xacro:if value="${n > 1}"><xacro:m n="${n - 1}"/></xacro:if></xacro:macro>'
        '<xacro:m n="300"/>'
    )
    assert text.count("<l ") == 300


# --- conditions, elements, attributes, comments ---------------------------------------------------


@pytest.mark.parametrize(
    ("value", "holds"),
    [
        ("true", True),
        ("False", False),
        ("1", True),
        ("0", False),
        ("${1.5}", True),
        ("${[]}", False),
    ],
)
def test_a_condition_holds_or_not(value: str, holds: bool) -> None:
    body = '<xacro:if value="{0}"><y/></xacro:if><xacro:unless value="{0}"><n/></xacro:unless>'
    assert expanded(body.format(value)) == ("<y/>" if holds else "<n/>")


def test_elements_and_attributes_can_have_computed_names() -> None:
    assert (
        expanded(
            "<xacro:element xacro:name=\"${'a' + 'b'}\" k=\"1\">"
            '<xacro:attribute name="${\'x\'}" value="${2}"/></xacro:element>'
        )
        == '<ab k="1" x="2"/>'
    )


def test_comments_above_what_is_expanded_go_with_it() -> None:
    assert (
        expanded(
            "<!-- kept -->\n\n<!-- gone -->\n<!-- gone -->\n"
            '<xacro:property name="a" value="1"/>\n<!-- ${a} -->\n<l/>'
        )
        == "<!-- kept -->\n<!-- ${a} -->\n<l/>"
    )


def test_comments_can_be_evaluated() -> None:
    assert (
        expanded("<!-- xacro:eval-comments --><!-- ${1 + 1} --><l/><!-- ${1 + 1} -->")
        == "<!-- 2 -->\n<l/>\n<!-- ${1 + 1} -->"
    )


def test_what_has_no_prefix_does_nothing() -> None:
    assert expanded('<if value="0"><l/></if>') == '<if value="0">\n<l/>\n</if>'


def test_cdata_is_not_evaluated() -> None:
    assert expanded("<l><![CDATA[${a} < b]]></l>") == "<l>${a} &lt; b</l>"


def test_attributes_of_xacro_and_its_prefix_are_taken_off() -> None:
    assert expanded('<l xacro:note="${x}" xmlns:xacro="http://x"/>') == "<l/>"


def test_texts_that_meet_have_space_between_them() -> None:
    assert (
        expanded('<l>a<xacro:if value="1">b</xacro:if></l><l> c </l>') == "<l>a\nb</l>\n<l> c </l>"
    )


# --- files --------------------------------------------------------------------------------------

LEGS = """<robot xmlns:xacro="http://x" xmlns:gz="http://gz">
<xacro:property name="length" value="2"/>
<xacro:macro name="leg" params="side"><link name="${side}_leg" v="${length}"/></xacro:macro>
</robot>"""


def test_a_file_brings_macros_properties_and_prefixes() -> None:
    root = Expanded(
        '<xacro:include filename="legs.xacro"/><xacro:leg side="l"/>', {"legs.xacro": LEGS}
    ).root
    assert root.attributes == {"xmlns:gz": "http://gz"}
    assert root.elements()[0].attributes == {"name": "l_leg", "v": "2"}


def test_a_file_can_have_a_namespace() -> None:
    assert (
        expanded(
            '<xacro:include filename="legs.xacro" ns="four"/><xacro:four.leg side="l"/>'
            '<l v="${four.length}"/>',
            {"legs.xacro": LEGS},
        )
        == '<link name="l_leg" v="2"/>\n<l v="2"/>'
    )


def test_a_pattern_includes_files_in_order() -> None:
    files = {name: f"<r><{name[0]}/></r>" for name in ("b.xacro", "a.xacro", "c.xml")}
    assert expanded('<xacro:include filename="*.xacro"/>', files) == "<a/>\n<b/>"


def test_an_include_can_be_optional() -> None:
    assert expanded('<xacro:include filename="none.xacro" optional="true"/><l/>') == "<l/>"


def test_paths_are_relative_to_the_file_being_read() -> None:
    files = {
        "sub/one.xacro": '<r xmlns:xacro="x"><xacro:include filename="two.xacro"/></r>',
        "sub/two.xacro": "<r><l v=\"${xacro.abs_filename('a')}\"/></r>",
    }
    assert expanded('<xacro:include filename="sub/one.xacro"/>', files) == '<l v="/r/sub/a"/>'


YAML = "arm: {length: 2, sizes: [1, {a: yes}], tilt: !degrees 180, gap: !millimeters 5 * 2}"


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("y.arm.length", "2"),
        ("y['arm']['sizes'][1].a", "True"),
        ("y.arm.tilt == pi", "True"),
        ("y.arm.gap", "0.01"),
        ("[s for s in y.arm.sizes][1].a", "True"),
        ("'arm' in y", "True"),
    ],
)
def test_yaml_can_be_read(expression: str, value: str) -> None:
    body = '<xacro:property name="y" value="${xacro.load_yaml(\'d.yaml\')}"/>'
    assert expanded(f'{body}<l v="${{{expression}}}"/>', {"d.yaml": YAML}) == f'<l v="{value}"/>'


# --- where it comes from ------------------------------------------------------------------------


def test_an_element_knows_its_place_and_the_way_to_it() -> None:
    body = '<xacro:include filename="legs.xacro"/>\n<xacro:leg side="l"/>'
    (link,) = Expanded(body, {"legs.xacro": LEGS}).root.elements()
    assert link.span.place() == "legs.xacro:3:40"
    assert link.value_span("name").written() == "${side}_leg"
    assert trace_lines(link.trace) == [
        "in xacro:leg, called at robot.xacro:3:2",
        "in legs.xacro, included at robot.xacro:2:26",
    ]


def test_an_attribute_that_is_added_knows_its_place() -> None:
    body = '<l a="1"><xacro:attribute name="b" value="${2}"/></l>'
    (link,) = Expanded(body).root.elements()
    assert link.value_span("b").written() == "${2}"
    assert link.value_span("a").written() == "1"


def test_a_text_knows_its_place() -> None:
    (link,) = Expanded("<l>a &amp; ${1}</l>").root.elements()
    (text,) = link.children
    assert text.span.written() == "a &amp; ${1}"


# --- errors -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<a b="x ${lenght * 2}"/>', ("xacro-undefined", "line 2", "lenght")),
        ('<a b="&lt;${lenght}"/>', ("xacro-undefined", "line 2", "lenght")),
        ('<a b="$(arg x)"/>', ("xacro-undefined", "line 2", "$(arg x)")),
        ('<a b="$(eval xx * 2)"/>', ("xacro-undefined", "line 2", "xx")),
        ('<a b="${1 / 0}"/>', ("xacro-python", "line 2", "${1 / 0}")),
        ('<a b="${1 1}"/>', ("xacro-python", "line 2", "1")),
        ('<a b="${}"/>', ("xacro-python", "line 2", "${}")),
        ("<a>\n\n${1 / 0}</a>", ("xacro-python", "line 4", "${1 / 0}")),
        ('<a b="x ${1"/>', ("xacro-expression", "line 2", "${")),
        ('<a b="$$"/>', ("xacro-expression", "line 2", "$$")),
        ('<a b="$(fnd x)"/>', ("xacro-substitution", "line 2", "$(fnd x)")),
        ('<a b="$(find)"/>', ("xacro-substitution", "line 2", "$(find)")),
        ('<a b="$(find a b)"/>', ("xacro-substitution", "line 2", "$(find a b)")),
        ('<a b="$(dirname)"/>', ("xacro-substitution", "line 2", "$(dirname)")),
        ('<a b="$(env NONE)"/>', ("unset-environment", "line 2", "$(env NONE)")),
        ('<a b="$(find none)"/>', ("unknown-package", "line 2", "$(find none)")),
        ('<a b="${().__class__}"/>', ("xacro-unsafe", "line 2", "__class__")),
        ('<a b="${[x.__class__ for x in \'a\']}"/>', ("xacro-unsafe", "line 2", "__class__")),
        ('<a b="${2 ** 10 ** 10}"/>', ("limit-integer", "line 2", "${2 ** 10 ** 10}")),
        ('<a b="${xacro.fatal(1)}"/>', ("xacro-fatal", "line 2", "${xacro.fatal(1)}")),
        ('<xacro:if value="maybe"/>', ("xacro-condition", "line 2", "maybe")),
        ("<xacro:if/>", ("xacro-missing-attribute", "line 2", "xacro:if")),
        ("<xacro:leg/>", ("xacro-unknown-macro", "line 2", "xacro:leg")),
        ("<xacro:a.leg/>", ("xacro-unknown-macro", "line 2", "xacro:a.leg")),
        ('<xacro:call macro="leg"/>', ("xacro-unknown-macro", "line 2", "xacro:call")),
        ('<xacro:insert_block name="x"/>', ("xacro-unknown-block", "line 2", "x")),
        ('<xacro:property name="a.b" value="1"/>', ("xacro-name", "line 2", "a.b")),
        ('<xacro:property name="__a" value="1"/>', ("xacro-name", "line 2", "__a")),
        ('<xacro:macro name="call"/>', ("xacro-name", "line 2", "call")),
        ('<xacro:macro name="a.b"/>', ("xacro-name", "line 2", "a.b")),
        ('<xacro:element xacro:name=""/>', ("xacro-name", "line 2", "xacro:name")),
        (prop("a", "1", default="2"), ("xacro-property", "line 2", "xacro:property")),
        (prop("a", "1", scope="parent"), ("xacro-scope", "line 2", "parent")),
        ('<xacro:include filename="none"/>', ("missing-file", "line 2", "none")),
        ("<!--xacro:eval-comments--><!--${2 * '-'}-->", ("bad-comment", "line 2", "${2 * '-'}")),
        ("<a><b></a>", ("xml-syntax", "line 2", "a")),
        ("<gz:a/>", ("xml-syntax", "line 2", "gz:a")),
    ],
)  # fmt: skip
def test_a_fault_is_told_at_its_place(body: str, expected: tuple[str, ...]) -> None:
    assert fault(body) == expected


MACRO = """<xacro:macro name="m" params="side *origin n:=${1 + count}">
<l v="${side + 1}"/></xacro:macro>
"""


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ('<xacro:m sid="l"><o/></xacro:m>', ("xacro-unknown-parameter", "line 4", "sid")),
        ('<xacro:m n="1"><o/></xacro:m>', ("xacro-missing-parameter", "line 4", "xacro:m")),
        ('<xacro:m side="l"/>', ("xacro-missing-block", "line 4", "xacro:m")),
        ('<xacro:m side="l"><o/><p/></xacro:m>', ("xacro-unused-block", "line 4", "p")),
        (
            '<xacro:m side="l"><o/></xacro:m>',
            ("xacro-undefined", "line 2", "count", "in xacro:m, called at robot.xacro:4:2"),
        ),
        (
            '<xacro:property name="count" value="1"/><xacro:m side="l"><o/></xacro:m>',
            (
                "xacro-python",
                "line 3",
                "${side + 1}",
                "in xacro:m, called at robot.xacro:4:42",
            ),
        ),
    ],
)
def test_a_wrong_call_is_told_at_its_place(call: str, expected: tuple[str, ...]) -> None:
    assert fault(MACRO + call) == expected


def test_a_fault_in_a_property_is_told_where_it_is_written_and_used() -> None:
    body = "\n".join([prop("a", "${1 / 0}"), prop("b", "${a}"), '<l v="${b}"/>'])
    with pytest.raises(YamaroError) as caught:
        Expanded(body)
    (diagnostic,) = caught.value.diagnostics
    assert told(diagnostic) == ("xacro-python", "line 2", "${1 / 0}")
    assert diagnostic.notes == (
        "'a' is used at robot.xacro:3:33",
        "'b' is used at robot.xacro:4:7",
    )


def test_a_property_that_needs_itself_is_an_error() -> None:
    body = prop("a", "${b}") + prop("b", "${a}") + '<l v="${a}"/>'
    assert fault(body)[0] == "xacro-cycle"


def test_a_fault_in_an_included_file_tells_the_way() -> None:
    broken = {"a.xacro": '<r xmlns:xacro="x">\n<l v="${none}"/></r>', "b.xacro": "<r><a></r>"}
    way = "in a.xacro, included at robot.xacro:2:26"
    assert fault('<xacro:include filename="a.xacro"/>', broken) == (
        "xacro-undefined",
        "a.xacro:2",
        "none",
        way,
    )
    assert fault('<xacro:include filename="b.xacro"/>', broken)[0::3] == (
        "xml-syntax",
        "in b.xacro, included at robot.xacro:2:26",
    )


def test_a_fault_in_yaml_is_told_in_the_yaml() -> None:
    body = "<l v=\"${xacro.load_yaml('d.yaml')}\"/>"
    assert fault(body, {"d.yaml": "a: [1\nb: 2"})[:2] == ("xacro-yaml", "d.yaml:2")
    assert fault(body, {"d.yaml": "a: !degrees 1 +"})[0] == "xacro-yaml"


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ('<xacro:property name="length" value="1"/><a b="${lenght}"/>', "did you mean 'length'?"),
        ('<a b="${radiens(1)}"/>', "did you mean 'radians'?"),
        ('<xacro:macro name="leg"/><xacro:lag/>', "did you mean 'xacro:leg'?"),
        (prop("o", "1") + '<xacro:insert_block name="o"/>', "'o' is a value; write ${o}"),
    ],
)  # fmt: skip
def test_a_hint_says_what_may_be_meant(body: str, said: str) -> None:
    assert hint(body) == said


@pytest.mark.parametrize(
    "body",
    [
        '<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>',
        '<xacro:include filename="self.xacro"/>',
        '<xacro:macro name="m" params="b"><xacro:m b="1"/></xacro:macro><xacro:m b="1"/>',
    ],
)
def test_what_never_ends_is_an_error(body: str) -> None:
    itself = {"self.xacro": '<r xmlns:xacro="x"><xacro:include filename="self.xacro"/></r>'}
    assert fault(body, itself)[0] == "too-deep"


def test_what_multiplies_itself_is_an_error() -> None:
    levels = "".join(
        f'<xacro:macro name="m{n}"><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>'
        for n in range(30)
    )
    limits = Limits(statements=10_000)
    body = f'{levels}<xacro:macro name="m30"><l/></xacro:macro><xacro:m0/>'
    assert fault(body, limits=limits)[0] == "limit-statements"


@pytest.mark.skipif(sys.gettrace() is not None, reason="tracers need deeper stacks")
def test_long_chains_of_properties_are_evaluated() -> None:
    chain = "".join(f'<xacro:property name="p{n + 1}" value="${{p{n}}}"/>' for n in range(300))
    assert attribute("${p300}", f'<xacro:property name="p0" value="1"/>{chain}') == "1"


# --- warnings -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<xacro:property name="pi" value="3"/>', ("xacro-redefined", "line 2", "3")),
        ('<xacro:property name="a" vlaue="3"/>', ("xacro-unknown-attribute", "line 2", "vlaue")),
        ('<xacro:macro name="xacro:m"/>', ("xacro-name", "line 2", "xacro:m")),
        ('<xacro:include filename="*.none"/>', ("xacro-no-files", "line 2", "*.none")),
        ('<l v="${sorted([1])}"/>', ("xacro-deprecated", "line 2", "${sorted([1])}")),
        (
            '<xacro:property name="a" default="1" scope="global"/>',
            ("xacro-scope", "line 2", "global"),
        ),
        (
            '<l><xacro:if value="1"><xacro:attribute name="a" value="1"/></xacro:if></l>',
            ("xacro-lost", "line 2", "xacro:attribute"),
        ),
    ],
)  # fmt: skip
def test_what_is_odd_is_a_warning(body: str, expected: tuple[str, ...]) -> None:
    assert warning(body) == expected


def test_children_of_an_include_are_ignored_with_a_warning() -> None:
    body = '<xacro:include filename="legs.xacro"><l/></xacro:include>'
    assert warning(body, {"legs.xacro": LEGS}) == ("xacro-ignored", "line 2", "l")


def test_a_prefix_with_two_meanings_is_a_warning() -> None:
    body = '<xacro:include filename="legs.xacro"/><xacro:include filename="b.xacro"/>'
    other = LEGS.replace("http://gz", "http://other")
    assert warning(body, {"legs.xacro": LEGS, "b.xacro": other})[:3] == (
        "xacro-prefix",
        "b.xacro:1",
        "http://other",
    )


def test_messages_reach_the_person() -> None:
    done = Expanded("<l v=\"${xacro.message('two', 2)}${xacro.warning('odd')}\"/>")
    assert done.host.said[0] == "two 2"
    assert [d.code for d in done.reporter.diagnostics] == ["xacro-message"]


def test_expansions_in_threads_do_not_meet() -> None:
    from concurrent.futures import ThreadPoolExecutor

    def count(number: int) -> str:
        body = (
            '<xacro:macro name="m" params="n"><l v="${n} $(arg x)"/><xacro:if value="${n > 1}">'
            '<xacro:m n="${n - 1}"/></xacro:if></xacro:macro>'
        )
        return expanded(f'{body}<xacro:m n="{number}"/>', arguments={"x": str(number)})

    with ThreadPoolExecutor(4) as pool:
        texts = list(pool.map(count, range(10, 40)))
    assert texts == [
        "\n".join(f'<l v="{n} {number}"/>' for n in range(number, 0, -1))
        for number in range(10, 40)
    ]


def test_python_can_be_evaluated_by_another() -> None:
    class Careful(Python):
        def evaluate(self, text: str, names: dict[str, Any]) -> Any:
            asked.append(text)
            return super().evaluate(text, names)

    asked: list[str] = []
    source = Source(f'{HEAD}<a b="${{1 + 1}}"/></robot>', name="robot.xacro")
    root = expand(source, MemoryHost({}), {}, Reporter(), python=Careful(Limits()))
    assert root.elements()[0].attributes == {"b": "2"}
    assert asked == ["1 + 1"]
