"""Robots in several files come out as they do from xacro, or both refuse them."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import Any
from xml.dom import minidom

import pytest

from tests.properties.test_xacro_same import shape
from tests.xacro.xacro_host import FileHost, expand_file
from yamaro.diagnostics import YamaroError
from yamaro.xml.writer import write

xacro: Any = pytest.importorskip("xacro")

HEAD = '<r xmlns:xacro="http://www.ros.org/wiki/xacro">'


def document(body: str) -> str:
    return f"{HEAD}{body}</r>"


FILES = {
    "base.xacro": document(
        '<xacro:property name="size" value="2"/><xacro:arg name="side" default="left"/>'
        '<xacro:macro name="box" params="n:=^|1 *o"><b n="${n}" size="${size}">'
        '<xacro:insert_block name="o"/></b></xacro:macro>'
        '<xacro:macro name="twice"><xacro:box n="2"><t/></xacro:box></xacro:macro>'
        '<xacro:macro name="up"><xacro:property name="gained" value="${size}" scope="parent"/>'
        "</xacro:macro>"
    ),
    "outer.xacro": document('<xacro:include filename="base.xacro" ns="inner"/><x/>'),
    "missing.xacro": document('<a/><xacro:include filename="none.xacro"/><b/>'),
    "broken.xacro": "<r><a></r>",
    "prefixed.xacro": '<r xmlns:gz="http://gz" xmlns:o="http://o" a="${1+1}"><gz:a/></r>',
    "other.xacro": '<r xmlns:gz="http://other"/>',
    "needs.xacro": '<r name="$(arg none)"><a/></r>',
    "comments.xacro": document("<!-- a --><a/><!-- b -->\n<!-- c -->"),
    "sub/one.xacro": document(
        '<xacro:include filename="two.xacro"/><p v="${xacro.load_yaml(\'d.yaml\').k}"/>'
        '<xacro:macro name="reader" params="f"><q v="${xacro.load_yaml(f)}"/></xacro:macro>'
    ),
    "sub/two.xacro": document("<two/>"),
    "sub/d.yaml": "k: in sub",
    "d.yaml": "k: at top",
    "data.yaml": """
a: {b: {c: [1, 2.50, yes, off, null, ~, 010, 0x1F, 1e3, 1.e+3, 1_000, 1:30, "5", 'x', 2020-01-02]}}
base: &base {x: 1, y: [1, {z: 2}]}
more: {<<: *base, x: 3}
1: one
deg: [!degrees 90, !radians pi/2, !inches 2 + 1, !meters 1, !millimeters 5, !foot "3"]
""",
    "list.yaml": "- {x: 1}\n- [2, 3]\n- z\n",
    "empty.yaml": "",
    "many.yaml": "a: 1\n---\nb: 2\n",
    "tagged.yaml": "a: !foo 1\n",
    "python.yaml": "a: !!python/object/apply:os.getcwd []\n",
    "unit.yaml": "a: !degrees 1 +\n",
    "unknown.yaml": "a: !degrees nothing\n",
    "g1.xacro": "<r><one/></r>",
    "g2.xacro": "<r><two/></r>",
}

BASE = '<xacro:include filename="base.xacro"/>'
NAMED = '<xacro:include filename="base.xacro" ns="w"/>'
DATA = '<xacro:property name="d" value="${xacro.load_yaml(\'data.yaml\')}"/>'
TWICE = "<xacro:w.twice/></xacro:macro>"
READER = '<xacro:macro name="m" params="d"><l v="${d.x}"/></xacro:macro>'

BODIES = [
    f'{BASE}<xacro:box><o/></xacro:box><xacro:box n="x"><o/></xacro:box><l s="$(arg side)"/>',
    f'{BASE}<xacro:property name="n" value="7"/><xacro:box><o/></xacro:box>',
    f'{BASE}<xacro:property name="size" value="3"/><xacro:twice/>',
    f"{NAMED}<xacro:w.box><o/></xacro:w.box>",
    f'{NAMED}<xacro:property name="size" value="3"/><xacro:w.twice/><l v="${{w.size}}"/>',
    f'{NAMED}<xacro:w.up/><l v="${{gained}}"/>',
    f'{BASE}<xacro:up/><l v="${{gained}}"/>',
    f'{NAMED}<xacro:property name="z" value="5"/><l v="${{w.z}}"/>',
    f'{NAMED}<l v="${{w.none}}"/>',
    f"{NAMED}<xacro:box/>",
    f"{NAMED}{NAMED}<xacro:w.twice/>",
    f'<xacro:property name="w" value="1"/>{NAMED}<xacro:w.twice/>',
    f'{NAMED}<xacro:property name="w" value="1"/><xacro:w.twice/>',
    f'{NAMED}<xacro:macro name="m"><xacro:w.twice/></xacro:macro><xacro:m/>',
    f'{NAMED}<xacro:macro name="m"><xacro:property name="size" value="9"/>{TWICE}<xacro:m/>',
    f'{NAMED}<xacro:call macro="w.twice"/>',
    f"{NAMED}<xacro:call macro=\"${{'w.' + 'twice'}}\"/>",
    '<xacro:include filename="outer.xacro" ns="o"/><xacro:o.inner.twice/><l v="${o.inner.size}"/>',
    '<xacro:include filename="outer.xacro"/><xacro:inner.twice/>',
    '<xacro:include filename="outer.xacro"/><xacro:twice/>',
    '<xacro:include filename="base.xacro" ns="${1}"/><l/>',
    '<xacro:include filename="base.xacro" ns="math"/><l v="${math.size}"/>',
    '<xacro:include filename="missing.xacro"/>',
    '<xacro:include filename="missing.xacro" optional="true"/><l/>',
    '<xacro:include filename="none.xacro" optional="true"/><l/>',
    '<xacro:include filename="none.xacro" optional="${True}"/><l/>',
    '<xacro:include filename="none.xacro" optional="0"/><l/>',
    '<xacro:include filename="broken.xacro" optional="true"/><l/>',
    '<xacro:include filename="needs.xacro"/>',
    '<xacro:include filename="prefixed.xacro"/><l/>',
    '<xacro:include filename="prefixed.xacro"/><xacro:include filename="other.xacro"/><l/>',
    '<l><xacro:if value="1"><xacro:include filename="other.xacro"/></xacro:if></l>',
    '<xacro:include filename="comments.xacro"/>\n<xacro:property name="a" value="1"/><l/>',
    '<!-- 1 -->\n<xacro:include filename="comments.xacro"/>\n<!-- 2 --><l/>',
    '<xacro:include filename="g*.xacro"/>',
    '<xacro:include filename="g[2-9].xacro"/><xacro:include filename="g?.xacro"/>',
    '<xacro:include filename="none*.xacro"/><l/>',
    '<xacro:include filename="none*.xacro" optional="true"/><l/>',
    "<xacro:include filename=\"${'g1'}.xacro\"/>",
    '<xacro:include filename=""/>',
    "<xacro:include/>",
    '<xacro:include filename="sub/one.xacro"/><xacro:reader f="d.yaml"/>',
    '<xacro:include filename="sub/one.xacro"/><xacro:include filename="g1.xacro"/>',
    "<l v=\"${xacro.load_yaml('none.yaml')}\"/>",
    "<l v=\"${xacro.load_yaml('list.yaml')[0].x} ${xacro.load_yaml('list.yaml')[1:]}\"/>",
    "<l v=\"${xacro.load_yaml('empty.yaml')}\"/>",
    "<l v=\"${xacro.load_yaml('many.yaml')}\"/>",
    "<l v=\"${xacro.load_yaml('tagged.yaml')}\"/>",
    "<l v=\"${xacro.load_yaml('python.yaml')}\"/>",
    "<l v=\"${xacro.load_yaml('unit.yaml')}\"/>",
    "<l v=\"${xacro.load_yaml('unknown.yaml')}\"/>",
    "<l v=\"${load_yaml('list.yaml')}\"/>",
    *[
        f'{DATA}<l v="${{{expression}}}"/>'
        for expression in (
            "d",
            "d.a.b.c",
            "d['a']['b'].c[2]",
            "d.more.y[1].z",
            "d[1]",
            "d.deg",
            "d.none",
            "d.get('none')",
            "d.a.get('b').c",
            "[k for k in d.more]",
            "[v for v in d.more.values()]",
            "[i.z for i in d.base.y[1:]]",
            "len(d.a.b.c)",
            "d.keys()",
            "sorted(d.base.keys())",
            "d.a.b.c[0] + d.more.x",
            "dict(d.base)",
            "list(d.base.y)",
            "[x for x in d.base.y][1].z",
            "d.base.y.append(3)",
            "d.base == d.more",
            "'x' in d.base and 1 in d.base.y",
            "python.type(d.base.y[1]) == python.type(d)",
        )
    ],
    f'{DATA}<l v="${{d.base.y.append(3)}} ${{d.base.y}}"/>',
    f'{DATA}<l v="${{d.update(q=1)}} ${{d.q}}"/>',
    f'{DATA}<xacro:property name="e" value="${{d.base}}"/><l v="${{e.y[1].z}}"/>',
    f'{DATA}{READER}<xacro:m d="${{d.more}}"/>',
]


def by_xacro(path: Path) -> Any:
    with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
        try:
            written = xacro.process_file(str(path), mappings={}).toprettyxml(indent="  ")
            return shape(minidom.parseString(written.encode()).documentElement)
        except Exception:
            return None


def by_us(path: Path) -> Any:
    try:
        root = expand_file(str(path), FileHost(), {})
    except YamaroError:
        return None
    return shape(minidom.parseString(write(root).encode()).documentElement)


@pytest.mark.filterwarnings("ignore::ResourceWarning")
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("body", BODIES)
def test_files_come_out_as_from_xacro(body: str, tmp_path: Path) -> None:
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, "utf-8")
    main = tmp_path / "main.xacro"
    main.write_text(document(body), "utf-8")
    assert by_us(main) == by_xacro(main)


def test_a_prefix_that_xacro_would_leave_undeclared_is_declared(tmp_path: Path) -> None:
    (tmp_path / "a.xacro").write_text('<r xmlns:gz="http://gz"><gz:a/></r>')
    main = tmp_path / "main.xacro"
    main.write_text(
        document('<l><xacro:if value="1"><xacro:include filename="a.xacro"/></xacro:if></l>')
    )
    assert by_xacro(main) is None  # what it writes is no XML
    assert by_us(main) == ("r", [("xmlns:gz", "http://gz")], [("l", [], [("gz:a", [], [])])])
