"""Includes whose names are computed, and where sources are put that other folders hold."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.against_xacro import holds, is_same, moved
from yamaro import YamaroError

H, T = '<link name="h"/>', '<link name="t"/>'
TWO_PARTS = {"h.xacro": H, "t.xacro": T}
ARGUMENT = '<xacro:arg name="kind" default="h"/>'


def test_an_include_named_by_an_argument_alone_is_not_frozen(tmp_path: Path) -> None:
    files = TWO_PARTS | {"r.xacro": f'{ARGUMENT}<xacro:include filename="$(arg kind).xacro"/>'}
    migration = holds(tmp_path, files, "kind:=t")
    assert "include: $(kind).yaml" in migration.files["r.yaml"]


def test_files_that_a_name_may_mean_are_in_the_order_of_their_names(tmp_path: Path) -> None:
    files = {f"{each}.xacro": f'<link name="{each}"/>' for each in "cbadefgh"}
    include = '<xacro:include filename="$(arg kind).xacro"/>'
    migration = holds(tmp_path, files | {"r.xacro": ARGUMENT + include})
    assert [*migration.files] == ["r.yaml", "h.yaml", *(f"{each}.yaml" for each in "abcdefg")]


def test_an_include_named_by_a_parameter_alone_is_not_frozen(tmp_path: Path) -> None:
    include = '<xacro:include filename="${layout}"/>'
    macro = f'<xacro:macro name="m" params="layout">{include}</xacro:macro>'
    chosen = "".join(
        f"""<xacro:if value="${{'$(arg kind)' == '{kind}'}}"><xacro:m layout="{kind}.xacro"/>"""
        "</xacro:if>"
        for kind in "ht"
    )
    files = TWO_PARTS | {"r.xacro": ARGUMENT + macro + chosen}
    holds(tmp_path, files, "kind:=t")


def test_a_macro_that_includes_two_files_by_their_names_includes_both(tmp_path: Path) -> None:
    include = '<xacro:include filename="${layout}"/>'
    macro = f'<xacro:macro name="m" params="layout:=h.xacro">{include}</xacro:macro>'
    files = TWO_PARTS | {"r.xacro": f'{macro}<xacro:m/><xacro:m layout="t.xacro"/>'}
    holds(tmp_path, files)


@pytest.mark.parametrize(
    "name",
    [
        "parts/$(arg kind).xacro",
        "./parts/$(arg kind).xacro",
        "${folder}/$(arg kind).xacro",
        "parts/${kind}.xacro",
        "${file}",
        "${'parts/' + kind + '.xacro'}",
        "$(find bot)/parts/$(arg kind).xacro",
        "${file if kind else ''}",
    ],
)
def test_names_computed_in_other_ways_are_not_frozen(tmp_path: Path, name: str) -> None:
    files = {f"parts/{own}": text for own, text in TWO_PARTS.items()} | {
        "package.xml": "<package><name>bot</name></package>",
        "r.xacro": ARGUMENT
        + '<xacro:property name="kind" value="$(arg kind)"/>'
        + '<xacro:property name="folder" value="parts"/>'
        + '<xacro:property name="file" value="${folder}/${kind}.xacro"/>'
        + f'<xacro:include filename="{name}"/>',
    }
    root = tmp_path / "in" / "bot"
    root.mkdir(parents=True)
    migration = moved(tmp_path, {f"bot/{own}": text for own, text in files.items()}, "bot/r.xacro")
    assert migration.faults == []
    assert [str(each) for each in migration.differences] == []
    assert is_same(tmp_path, migration, "kind:=h")
    assert is_same(tmp_path, migration, "kind:=t")


def test_a_file_that_is_nowhere_is_an_error_and_not_another_file(tmp_path: Path) -> None:
    files = TWO_PARTS | {"r.xacro": f'{ARGUMENT}<xacro:include filename="$(arg kind).xacro"/>'}
    migration = holds(tmp_path, files)
    with pytest.raises(YamaroError) as caught:
        is_same_with_any(tmp_path, migration.main, "kind:=x")
    assert caught.value.diagnostics[0].code == "missing-file"


def is_same_with_any(folder: Path, main: str, *arguments: str) -> None:
    from yamaro import build

    build(folder / "out" / main, command_line=arguments, on_message=lambda line: None)


def test_a_computed_include_in_a_branch_not_taken_is_kept(tmp_path: Path) -> None:
    both = "".join(
        f'<xacro:{tag} value="$(arg sim)"><xacro:include filename="$(arg kind)_{own}.xacro"/>'
        f"</xacro:{tag}>"
        for tag, own in (("if", "sim"), ("unless", "real"))
    )
    files = {
        "h_sim.xacro": H,
        "h_real.xacro": T,
        "r.xacro": ARGUMENT + '<xacro:arg name="sim" default="false"/>' + both,
    }
    migration = holds(tmp_path, files, "sim:=true")
    assert migration.lost == []


def test_an_include_that_no_arguments_reach_is_kept_and_told(tmp_path: Path) -> None:
    never = '<xacro:if value="${1 == 2}"><xacro:include filename="x_${n}.xacro"/></xacro:if>'
    migration = holds(tmp_path, {"r.xacro": f'{H}<xacro:property name="n" value="1"/>{never}'})
    assert "include: x_$(n).yaml" in migration.files["r.yaml"]


DICT = """<xacro:property name="files" value="${dict(h='h.xacro', b='t.xacro')}"/>"""
KIND = '<xacro:property name="kind" value="$(arg kind)"/>'
LOADED = """<xacro:property name="d" value="${xacro.load_yaml(NAME)}"/><link name="l${d['x']}"/>"""
NUMBERS = {"c/h.yaml": "x: 1\n", "c/t.yaml": "x: 2\n"}
INCLUDER = '<xacro:macro name="m" params="k"><xacro:include filename="${k}.xacro"/></xacro:macro>'


@pytest.mark.parametrize(
    ("files", "other"),
    [
        (
            {
                **TWO_PARTS,
                "r.xacro": ARGUMENT + KIND + DICT + '<xacro:include filename="${files[kind]}"/>',
            },
            "kind:=b",
        ),
        (
            {**NUMBERS, "r.xacro": ARGUMENT + LOADED.replace("NAME", "'c/$(arg kind).yaml'")},
            "kind:=t",
        ),
        (
            {
                **NUMBERS,
                "r.xacro": ARGUMENT + KIND + LOADED.replace("NAME", "'c/' + kind + '.yaml'"),
            },
            "kind:=t",
        ),
        (
            {
                "parts/h.xacro": H,
                "parts/t.xacro": T,
                "lib/m.xacro": INCLUDER,
                "r.xacro": ARGUMENT
                + '<xacro:include filename="lib/m.xacro"/><xacro:m k="parts/$(arg kind)"/>',
            },
            "kind:=t",
        ),
        (
            {
                "h.xacro": '<xacro:property name="p" value="1"/>',
                "t.xacro": '<xacro:property name="p" value="2"/>',
                "r.xacro": ARGUMENT
                + '<xacro:include filename="$(arg kind).xacro" ns="n"/><link name="l${n.p}"/>',
            },
            "kind:=t",
        ),
        (
            {
                "h.xacro": '<xacro:arg name="n" default="1"/>',
                "t.xacro": '<xacro:arg name="n" default="2"/>',
                "r.xacro": ARGUMENT
                + '<xacro:include filename="$(arg kind).xacro"/><link name="l$(arg n)"/>',
            },
            "kind:=t",
        ),
    ],
    ids=["dict", "data", "data in a sum", "macro of a library", "namespace", "defaults"],
)
def test_files_for_other_arguments_come_along(
    tmp_path: Path, files: dict[str, str], other: str
) -> None:
    holds(tmp_path, files, other)


def test_an_optional_file_that_is_not_there_is_left_out_and_told(tmp_path: Path) -> None:
    include = '<xacro:include filename="$(arg kind)_x.xacro" optional="true"/>'
    migration = holds(tmp_path, {"r.xacro": ARGUMENT + H + include})
    assert [why for _, why, _ in migration.lost] == [
        "the file '$(arg kind)_x.xacro' is optional, and is not there"
    ]


def test_a_difference_with_other_arguments_is_told(tmp_path: Path) -> None:
    chosen = (
        """<xacro:if value="${'$(arg v)' == '02'}"><link name="two"/></xacro:if>"""
        """<xacro:if value="${'$(arg v)' == '1'}"><link name="one"/></xacro:if>"""
    )
    migration = moved(tmp_path, {"r.xacro": f'<xacro:arg name="v" default="1"/>{chosen}'})
    assert [str(each) for each in migration.differences] == [
        "with v:=02, robot 'r', link 'two': is missing"
    ]
    assert is_same(tmp_path, migration)


@pytest.mark.parametrize("include", ["../lib/m.xacro", "../main/../lib/m.xacro"])
def test_nothing_is_written_outside_of_the_output_folder(tmp_path: Path, include: str) -> None:
    files = {"main/r.xacro": f'<xacro:include filename="{include}"/>', "lib/m.xacro": H}
    migration = moved(tmp_path, files, "main/r.xacro")
    assert migration.differences == []
    assert sorted(migration.files) == ["lib/m.yaml", "main/r.yaml"]


def test_a_file_that_is_named_in_two_ways_becomes_one_source(tmp_path: Path) -> None:
    twice = (
        '<xacro:include filename="../lib/m.xacro"/><xacro:include filename="a/../../lib/m.xacro"/>'
    )
    files = {"main/r.xacro": twice, "lib/m.xacro": "<x/>", "main/a/b.xacro": ""}
    assert sorted(moved(tmp_path, files, "main/r.xacro").files) == ["lib/m.yaml", "main/r.yaml"]


def test_data_above_the_main_file_is_copied_into_the_output_folder(tmp_path: Path) -> None:
    files = {
        "urdf/r.xacro": """<link name="l${xacro.load_yaml('../config/d.yaml')['x']}"/>""",
        "config/d.yaml": "x: 3\n",
    }
    migration = moved(tmp_path, files, "urdf/r.xacro")
    assert migration.faults == []
    assert sorted(migration.files) == ["config/d.yaml", "urdf/r.yaml"]


def test_files_that_are_tried_in_vain_are_not_copied(tmp_path: Path) -> None:
    wrong = '<xacro:include filename="$(arg nowhere).xacro"/>'
    files = TWO_PARTS | {
        "wrong.xacro": wrong,
        "r.xacro": f'{ARGUMENT}<xacro:include filename="$(arg kind).xacro"/>',
    }
    assert sorted(holds(tmp_path, files).files) == ["h.yaml", "r.yaml", "t.yaml"]


def test_files_named_by_python_were_left_behind(tmp_path: Path) -> None:
    argument = '<xacro:arg name="n" default="1"/>'
    include = '<xacro:include filename="part_${$(arg n) % 2}.xacro"/>'
    files = {"r.xacro": f"{argument}{include}", "part_0.xacro": H, "part_1.xacro": T}
    migration = holds(tmp_path, files, "n:=2")
    assert sorted(migration.files) == ["part_0.yaml", "part_1.yaml", "r.yaml"]


def test_of_files_named_by_python_alone_not_all_of_the_folder_are_taken(tmp_path: Path) -> None:
    include = """<xacro:include filename="${'h' + ''}.xacro"/>"""
    migration = moved(tmp_path, TWO_PARTS | {"r.xacro": include, "other.xacro": "<x/>"})
    assert "other.yaml" not in migration.files


def test_files_named_by_python_or_an_argument_through_properties_were_left_behind(
    tmp_path: Path,
) -> None:
    files = {
        "r.xacro": f"""{ARGUMENT}<xacro:arg name="n" default="1"/>
        <xacro:property name="kinds" value="${{['h', 't']}}"/>
        <xacro:property name="folder" value="parts/$(arg kind)"/>
        <xacro:macro name="m" params="f n">
          <xacro:property name="kind" value="${{kinds[n - 1]}}"/>
          <xacro:include filename="${{f}}/real.xacro"/>
          <xacro:include filename="part_${{kind}}.xacro"/>
        </xacro:macro>
        <xacro:m f="${{folder}}" n="$(arg n)"/>""",
        "part_h.xacro": "<h/>",
        "part_t.xacro": "<t/>",
        "parts/h/real.xacro": H,
        "parts/t/real.xacro": T,
    }
    holds(tmp_path, files, "kind:=t", "n:=2")


DATA = """<xacro:property name="all" value="${xacro.load_yaml('c.yaml')}"/>"""
TWO_KINDS = """<xacro:property name="d" value="${all['$(arg kind)']}"/>"""
UNRELATED = {"u.xacro": "<u/>"}


@pytest.mark.parametrize(
    ("files", "other"),
    [
        (
            {
                **TWO_PARTS,
                **UNRELATED,
                "c.yaml": "h: {file: h.xacro}\nt: {file: t.xacro}\n",
                "r.xacro": ARGUMENT
                + DATA
                + TWO_KINDS
                + """<xacro:include filename="${d['file']}"/>""",
            },
            "kind:=t",
        ),
        (
            {
                **TWO_PARTS,
                **UNRELATED,
                "c.yaml": "[h, t]\n",
                "r.xacro": '<xacro:arg name="n" default="0"/>'
                + DATA
                + '<xacro:include filename="${all[$(arg n)]}.xacro"/>',
            },
            "n:=1",
        ),
        (
            {
                "sub/ah.xacro": H,
                "sub/at.xacro": T,
                "sub/bh.xacro": "<b/>",
                "c.yaml": "- {f: a}\n- {f: b}\n",
                "r.xacro": '<xacro:arg name="n" default="0"/><xacro:arg name="m" default="h"/>'
                + DATA
                + '<xacro:property name="spec" value="${all[$(arg n)]}"/>'
                + """<xacro:include filename="sub/${spec['f']}$(arg m).xacro"/>""",
            },
            "m:=t",
        ),
    ],
    ids=["file", "stem", "stem and argument"],
)
def test_files_named_by_data_were_left_behind(
    tmp_path: Path, files: dict[str, str], other: str
) -> None:
    migration = holds(tmp_path, files, other)
    assert migration.lost == []
    assert "u.yaml" not in migration.files
    assert is_same(tmp_path, migration, "n:=1" if "m" in other else other)


@pytest.mark.parametrize("name", ["parts/${a}/${b}.xacro", "$(arg a)/$(arg b).xacro"])
def test_a_file_that_two_arguments_name_only_together_was_left_behind(
    tmp_path: Path, name: str
) -> None:
    folder = "parts/" if name.startswith("parts") else ""
    files = {
        f"{folder}h/sim.xacro": H,
        f"{folder}t/real.xacro": T,
        "r.xacro": '<xacro:arg name="a" default="h"/><xacro:arg name="b" default="sim"/>'
        '<xacro:property name="a" value="$(arg a)"/><xacro:property name="b" value="$(arg b)"/>'
        f'<xacro:include filename="{name}"/>',
    }
    migration = holds(tmp_path, files)
    assert migration.lost == []
    assert is_same(tmp_path, migration, "a:=t", "b:=real")


@pytest.mark.parametrize(
    ("include", "left"),
    [
        ("${'$(arg kind)'.lower()}.xacro", "t.xacro"),
        ("${kind[0]}.xacro", "t.xacro"),
        ("$(optenv KIND_OF_ARM h).xacro", "t.xacro"),
    ],
)
def test_files_that_were_left_behind_were_not_reported(
    tmp_path: Path, include: str, left: str
) -> None:
    files = TWO_PARTS | {"r.xacro": f'{ARGUMENT}{KIND}<xacro:include filename="{include}"/>'}
    migration = holds(tmp_path, files)
    assert [(why, hint) for _, why, hint in migration.lost] == [
        (
            f"'{include}' may name files that are not migrated: '{left}'",
            "migrated: 'h.xacro'; any other file is an error when the sources are built",
        )
    ]
    if "kind" in include:
        with pytest.raises(YamaroError) as caught:
            is_same_with_any(tmp_path, migration.main, "kind:=t")
        assert caught.value.diagnostics[0].code == "missing-file"


def test_a_file_that_needs_one_more_argument_is_reported(tmp_path: Path) -> None:
    files = TWO_PARTS | {
        "u.xacro": '<link name="$(arg more)"/>',
        "r.xacro": f'{ARGUMENT}<xacro:include filename="$(arg kind).xacro"/>',
    }
    migration = holds(tmp_path, files, "kind:=t")
    assert [why for _, why, _ in migration.lost] == [
        "'$(arg kind).xacro' may name files that are not migrated: 'u.xacro'"
    ]


@pytest.mark.parametrize(
    "include",
    [
        "$(arg kind).xacro",
        "${files[kind]}",
        "${'h.xacro' if kind == 'h' else 't.xacro'}",
        "${'parts/' + kind + '.xacro'}",
        "${folder}/*.xacro",
    ],
)
def test_files_that_a_computed_name_cannot_mean_are_not_reported(
    tmp_path: Path, include: str
) -> None:
    other = f'{ARGUMENT}<xacro:include filename="$(arg kind).xacro"/>'  # of no end, as kind:=o
    files = TWO_PARTS | {f"parts/{name}": text for name, text in TWO_PARTS.items()}
    folder = '<xacro:property name="folder" value="parts"/>'
    files |= {
        "o.xacro": other if "arg" in include else "<o/>",
        "r.xacro": f'{ARGUMENT}{KIND}{DICT}{folder}<xacro:include filename="{include}"/>',
    }
    assert holds(tmp_path, files).lost == []


def test_a_pattern_of_the_shell_that_depends_on_an_argument_is_reported(tmp_path: Path) -> None:
    files = {
        "parts/h_1.xacro": H,
        "parts/t_1.xacro": T,
        "r.xacro": f'{ARGUMENT}<xacro:include filename="parts/$(arg kind)_*.xacro"/>',
    }
    assert [why for _, why, _ in moved(tmp_path, files).lost] == [
        "which files 'parts/$(arg kind)_*.xacro' matches depends on arguments"
    ]


def test_a_file_named_by_the_current_folder_was_frozen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "in").mkdir()
    monkeypatch.chdir(tmp_path / "in")
    named = '<xacro:property name="f" value="$(cwd)/$(arg kind).xacro"/>'
    files = TWO_PARTS | {"r.xacro": f'{ARGUMENT}{named}<xacro:include filename="${{f}}"/>'}
    migration = holds(tmp_path, files, "kind:=t")
    assert migration.lost == []
    assert str(tmp_path) not in migration.files["r.yaml"]
    with pytest.raises(YamaroError) as caught:
        is_same_with_any(tmp_path, migration.main, "kind:=x")
    assert caught.value.diagnostics[0].code == "missing-file"


def test_a_file_named_by_the_environment_was_frozen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PARTS_OF_ARM", str(tmp_path / "in"))
    named = '<xacro:property name="f" value="$(env PARTS_OF_ARM)/$(arg kind).xacro"/>'
    files = TWO_PARTS | {"r.xacro": f'{ARGUMENT}{named}<xacro:include filename="${{f}}"/>'}
    migration = holds(tmp_path, files)
    assert [why for _, why, _ in migration.lost] == [
        "'${f}' may name files that are not migrated: 't.xacro'",
        "which file '${f}' means is computed",
    ]
    with pytest.raises(YamaroError) as caught:
        is_same_with_any(tmp_path, migration.main, "kind:=t")
    assert caught.value.diagnostics[0].code == "missing-file"


@pytest.mark.parametrize("size", ["6", "7", "7b"])
def test_a_computed_name_of_a_file_added_a_text_and_a_number(tmp_path: Path, size: str) -> None:
    files = {
        f"sizes/{each}/{name}.xacro": text
        for each in ("6", "7", "7b")
        for name, text in (
            ("arm", f'{_sized("${n}/tool")}<xacro:t n="${{n}}"/>'),
            (
                "tool",
                f'<xacro:macro name="t" params="n"><link name="{each}_${{n}}"/></xacro:macro>',
            ),
        )
    }
    files["r.xacro"] = f'''<xacro:arg name="n" default="{size}"/>
        <xacro:macro name="m" params="n">{_sized("${n}/arm")}</xacro:macro>
        <xacro:m n="$(arg n)"/>'''
    files["package.xml"] = "<package><name>in</name></package>"
    made = holds(tmp_path, files, "n:=6", "n:=7", "n:=7b")
    assert "include: ../$(n)/tool.yaml\n" in made.files["sizes/7/arm.yaml"]


def _sized(name: str) -> str:
    return f'<xacro:include filename="$(find in)/sizes/{name}.xacro"/>'


@pytest.mark.parametrize("default", ["..", "../lib", "no"])
def test_a_computed_include_in_a_macro_is_relative_to_the_file_that_calls_it(
    tmp_path: Path, default: str
) -> None:
    files = {
        "robots/small/r.xacro": """<xacro:property name="base" value="../.."/>
            <xacro:include filename="${base}/lib/m.xacro"/><xacro:m base="${base}"/>""",
        "lib/m.xacro": f"""<xacro:macro name="m" params="base:='{default}'">
            <xacro:include filename="${{base}}/lib/l.xacro"/><xacro:l/></xacro:macro>""",
        "lib/l.xacro": '<xacro:macro name="l" params=""><link name="a"/></xacro:macro>',
        "package.xml": "<package><name>in</name></package>",
    }
    made = holds(tmp_path, files, main="robots/small/r.xacro")
    assert "include: ../robots/small/$(base)/lib/l.yaml\n" in made.files["lib/m.yaml"]


@pytest.mark.parametrize("extra", ["", "more.xacro"])
def test_a_variable_of_the_environment_whose_default_is_computed_names_a_file(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, extra: str
) -> None:
    files = {
        "r.xacro": """<xacro:property name="nothing" value="none.xacro"/>
            <xacro:include filename="$(optenv TEST_MORE ${nothing})"/><link name="a"/>""",
        "none.xacro": "",
        "more.xacro": '<link name="b"/>',
    }
    if extra:
        monkeypatch.setenv("TEST_MORE", extra)
    holds(tmp_path, files)


@pytest.mark.parametrize(
    ("files", "name"),
    [
        ("dict(arm='arm.xacro', leg='leg.xacro')", "${files[k]}"),
        ("dict(arm='arm', leg='leg')", "${files.get(k)}.xacro"),
        ("dict(a=dict(arm='arm.xacro', leg='leg.xacro'))", "${files['a'][k]}"),
        ("dict(arm=['arm.xacro'], leg=['leg.xacro'])", "${files[k][0]}"),
    ],
)
def test_files_that_only_a_dictionary_names_are_migrated_though_nothing_includes_them_yet(
    tmp_path: Path, files: str, name: str
) -> None:
    made = holds(
        tmp_path,
        {
            "r.xacro": f"""<xacro:property name="files" value="${{{files}}}"/>
            <xacro:macro name="add" params="k"><xacro:include filename="{name}"/></xacro:macro>
            <xacro:arg name="k" default=""/>
            <xacro:if value="${{len('$(arg k)') > 1}}"><xacro:add k="$(arg k)"/></xacro:if>
            <link name="base"/>""",
            "arm.xacro": '<link name="arm"/>',
            "leg.xacro": '<link name="leg"/>',
        },
        "k:=arm",
        "k:=leg",
    )
    assert {"arm.yaml", "leg.yaml"} < made.files.keys()
    assert made.lost == []
