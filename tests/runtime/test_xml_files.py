"""Includes of URDF and xacro: what is renamed, which file is xacro's, and what xacro is given."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from yamaro import Build, Policy, YamaroError, build
from yamaro.diagnostics import Diagnostic
from yamaro.files.loader import MemoryLoader
from yamaro.policy import Limits
from yamaro.rendering import render
from yamaro.runtime.xml_files import is_xacro, read_included
from yamaro.sandbox import jail
from yamaro.source import Source
from yamaro.xml.reader import read_xml

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
AT = os.path.abspath("/robots")


def run(files: dict[str, str], include: str = "arm.urdf", policy: Policy | None = None) -> Build:
    """Compile a file that includes another one; all stand in one folder."""
    texts = {"t.yaml": f"out:\n  include: {include}\n", **files}
    loader = MemoryLoader({os.path.join(AT, *name.split("/")): texts[name] for name in texts})
    return build(os.path.join(AT, "t.yaml"), loader=loader, policy=policy)


def out(content: str, include: str = "arm.urdf") -> str:
    """Return what an included robot of the content gives, on one line."""
    lines = run({"arm.urdf": f"<robot>{content}</robot>"}, include).xml().splitlines()
    return "".join(line.strip() for line in lines[2:-1])


def fault(
    files: dict[str, str], include: str = "arm.urdf", policy: Policy | None = None
) -> Diagnostic:
    with pytest.raises(YamaroError) as caught:
        run(files, include, policy)
    (error,) = caught.value.diagnostics
    return error


def shown(diagnostic: Diagnostic) -> list[str]:
    """Return the lines of an error, with paths from the folder of the files."""
    return render(diagnostic).replace(AT + os.sep, "").splitlines()


@pytest.fixture
def without_jail(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jail, "check_available", lambda: "what matters here is the language")


def robot(content: str) -> str:
    return f"<robot {XACRO}>{content}</robot>"


# --- what a prefix renames ----------------------------------------------------------------------

LINKS = '<link name="a"/><joint name="j"/>'
RENAMED = '<link name="l_a"/><joint name="l_j"/>'


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        # where links and joints are named by attributes
        ('<parent link="a"/>', '<parent link="l_a"/>'),
        ('<mimic joint="j"/>', '<mimic joint="l_j"/>'),
        ('<gazebo reference="a"/>', '<gazebo reference="l_a"/>'),
        ('<x baseLink="a"/>', '<x baseLink="l_a"/>'),
        ('<x child_frame="a"/>', '<x child_frame="l_a"/>'),
        # what else is named once in a robot
        ('<transmission name="t"/>', '<transmission name="l_t"/>'),
        (
            '<gazebo><sensor name="s"/><x><sensor_name>s</sensor_name></x></gazebo>',
            '<gazebo><sensor name="l_s"/><x><sensor_name>l_s</sensor_name></x></gazebo>',
        ),
        ('<ros2_control name="c"/>', '<ros2_control name="l_c"/>'),
        ('<plugin name="a"/>', '<plugin name="a"/>'),
        # by a parameter of ros2_control
        ('<h><param name="mimic">j</param></h>', '<h><param name="mimic">l_j</param></h>'),
        ('<h><param name="port">j</param></h>', '<h><param name="port">j</param></h>'),
        # and by tags
        ("<x><bodyName>a</bodyName></x>", "<x><bodyName>l_a</bodyName></x>"),
        ("<x><FRAME>a</FRAME></x>", "<x><FRAME>l_a</FRAME></x>"),
        # several in one text
        ("<joints>a  j other</joints>", "<joints>l_a l_j other</joints>"),
        ("<joints>other  names</joints>", "<joints>other  names</joints>"),
        # deep inside, where a tag of that name is a reference
        ('<t><u><joint name="j"/></u></t>', '<t><u><joint name="l_j"/></u></t>'),
        ('<t><joint name="other"/></t>', '<t><joint name="other"/></t>'),
        ('<t><link name="a"/></t>', '<t><link name="l_a"/></t>'),
        # what has the name of a link, but is none
        ('<material name="a"/>', '<material name="a"/>'),
        ('<x value="a"/>', '<x value="a"/>'),
        ("<topic>a</topic>", "<topic>a</topic>"),
        ('<parent link="other"/>', '<parent link="other"/>'),
        ("<joint>a<!-- a --></joint>", "<joint>l_a<!-- a --></joint>"),
    ],
)
def test_a_prefix_stands_wherever_links_and_joints_are_named(content: str, expected: str) -> None:
    assert out(LINKS + content, "{path: arm.urdf, prefix: l_}") == RENAMED + expected


@pytest.mark.parametrize("prefix", ["", "''", "null"])
def test_no_prefix_leaves_the_file_as_it_is(prefix: str) -> None:
    content = LINKS + "<joints>a  j</joints>"
    assert out(content, f"{{path: arm.urdf, prefix: {prefix}}}") == content


def test_a_prefix_may_be_a_number() -> None:
    assert out('<link name="a"/>', "{path: arm.urdf, prefix: 2}") == '<link name="2a"/>'


# --- white space and places ---------------------------------------------------------------------


def test_white_space_between_elements_is_left_out_and_that_of_a_text_is_kept() -> None:
    assert out("\n  <a>\n    <b> </b>\n    <c> x </c>\n  </a>\n") == "<a><b> </b><c> x </c></a>"


def test_text_beside_elements_is_kept() -> None:
    assert out("<a>x<b/></a>") == out("\n<a>x<b/></a>\n")
    assert "x" in out("<a>x<b/></a>")


def test_a_root_of_white_space_holds_nothing() -> None:
    assert out("  \n ") == ""
    assert "<out/>" in run({"arm.urdf": "<robot> </robot>"}).xml()


def test_an_element_of_the_file_is_traced_to_its_include() -> None:
    content = '<link name="a"><inertial><mass value="-1"/></inertial></link>'
    text = "robot: two\nmodel:\n- include: arm.urdf\n"
    (warning,) = run({"t.yaml": text, "arm.urdf": f"<robot>{content}</robot>"}).warnings[:1]
    assert shown(warning)[-1] == "  = in arm.urdf, included at t.yaml:3:3"


# --- which file is xacro's ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<robot/>", False),
        (robot(""), False),
        (robot("<link name='a'/>"), False),
        (robot("<xacro:arg name='a'/>"), True),
        (robot("<a><b><xacro:arg name='a'/></b></a>"), True),
        (robot("<a><b c='${1}'/></a>"), True),
        (robot("<a><b c='$(arg d)'/></a>"), True),
        (robot("<a><b>${1}</b></a>"), True),
        (robot("<a>$(arg d)</a><b/>"), True),
        (robot("<a>$ {1}</a>"), False),
        ("<robot name='${1}'/>", False),  # which declares none of xacro's tags
        ("<robot><a>$(arg d)</a></robot>", False),
        (f"<robot name='${{1}}' {XACRO}/>", True),
    ],
)
def test_a_document_is_xacros_if_something_in_it_is(text: str, expected: bool) -> None:
    assert is_xacro(read_xml(Source(text, name="a.urdf"), Limits()).root) is expected


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("/a/arm.xacro", True),
        ("/a/arm.urdf.XACRO", True),
        ("/a/arm.urdf", False),
        ("/a.xacro/arm.urdf", False),
        ("C:\\a.xacro\\arm", False),
        ("/a/arm.xacro.urdf", False),
    ],
)
def test_a_file_is_xacros_if_its_name_says_so(path: str, expected: bool) -> None:
    root, found = read_included(Source("<robot/>", name="arm", path=path), Limits())
    assert (root.name, found) == ("robot", expected)


def test_a_urdf_that_holds_xacro_is_expanded() -> None:
    assert "<a>2</a>" in run({"arm.urdf": robot("<a>${1 + 1}</a>")}).xml()


@pytest.mark.parametrize("name", ["arm.urdf", "arm.xacro"])
def test_an_included_file_may_be_as_deep_as_the_limit_says(name: str) -> None:
    files = {name: "<robot><a><b/></a></robot>"}
    assert "<b/>" in run(files, name, Policy("trusted", limits={"xml-depth": 3})).xml()
    error = fault(files, name, Policy("trusted", limits={"xml-depth": 2}))
    assert (error.code, os.path.basename(error.span.source.path)) == ("limit-xml-depth", name)


# --- what an include may pass -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("argument", "hint"),
    [
        ("prefx", "did you mean 'prefix'?"),
        (
            "side",
            "prefix: left_ renames its links and joints; an XML file accepts no other variables",
        ),
    ],
)
def test_a_urdf_takes_nothing_but_a_prefix(argument: str, hint: str) -> None:
    error = fault({"arm.urdf": "<robot/>"}, f"{{path: arm.urdf, {argument}: 1}}")
    assert (error.code, error.message) == (
        "unknown-argument",
        f"an XML file does not accept the variable '{argument}'",
    )
    assert (error.span.written(), error.hint) == (argument, hint)


def test_a_urdf_has_nothing_for_a_namespace() -> None:
    include = "{path: \"$('arm.urdf')\", namespace: Arm}"
    error = fault({"arm.urdf": "<robot/>"}, include)
    assert (error.code, error.message, error.hint) == (
        "bad-namespace",
        "an XML file has no functions or variables for a namespace",
        "remove 'namespace'",
    )
    assert error.span.place() == f"{error.span.source.name}:2:19"


@pytest.mark.parametrize("path", ["arm.xacro", "\"$('arm.xacro')\""])
def test_namespace_is_an_argument_of_xacro_like_others(path: str) -> None:
    xacro = robot("<xacro:arg name='namespace' default=''/><a>$(arg namespace)-$(arg n)</a>")
    built = run({"arm.xacro": xacro}, f"{{path: {path}, namespace: Arm, n: true}}")
    assert "<a>Arm-true</a>" in built.xml()


@pytest.mark.usefixtures("without_jail")
def test_xacro_runs_in_no_safe_process_without_a_jail() -> None:
    error = fault({"arm.xacro": robot("")}, "arm.xacro", Policy("safe"))
    assert (error.code, error.span.written()) == ("unsafe-code", "arm.xacro")
    assert error.message == ("xacro expressions are Python, which safe mode runs only in a jail")
    assert error.hint == (
        "this system has no jail; use --trust if you trust the source of the file"
    )


@pytest.mark.usefixtures("without_jail")
def test_urdf_is_included_in_safe_mode_too() -> None:
    assert "<a/>" in run({"arm.urdf": "<robot><a/></robot>"}, policy=Policy("safe")).xml()


# --- faults -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "text", "at"),
    [("arm.urdf", "<robot><a></robot>", "1:13"), ("arm.xacro", robot("${nope}"), "1:54")],
)
def test_a_fault_in_the_file_is_traced_to_its_include(name: str, text: str, at: str) -> None:
    told = shown(fault({name: text}, name))
    assert (told[1], told[-1]) == (f" --> {name}:{at}", f"  = in {name}, included at t.yaml:2:3")


@pytest.mark.parametrize("name", ["arm.urdf", "arm.xacro", "parts/arm.urdf"])
def test_a_byte_that_its_encoding_has_not_is_told_in_the_file(tmp_path: Path, name: str) -> None:
    file = tmp_path / name
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(b"<robot>\xff</robot>")
    (tmp_path / "t.yaml").write_text(f"out:\n  include: {name}\n")
    with pytest.raises(YamaroError) as caught:
        build(str(tmp_path / "t.yaml"))
    (error,) = caught.value.diagnostics
    assert error.span.source.path == str(file)
    assert os.path.basename(error.span.source.name) == "arm" + os.path.splitext(name)[1]
    assert "included at" in render(error).splitlines()[-1]


# --- what a xacro file is given -----------------------------------------------------------------


def including(name: str, more: str = "") -> str:
    return robot(f'<xacro:include filename="{name}" {more}/>')


def test_xacro_includes_files_from_where_the_yaml_comes_from() -> None:
    files = {"arm.xacro": including("parts/hand.xacro"), "parts/hand.xacro": robot("<a/>")}
    built = run(files, "arm.xacro")
    assert "<a/>" in built.xml()
    assert [os.path.relpath(path, AT) for path in built.files] == [
        "t.yaml",
        "arm.xacro",
        os.path.join("parts", "hand.xacro"),
    ]


def test_a_file_of_xacros_may_say_its_encoding(tmp_path: Path) -> None:
    text = "<?xml version='1.0' encoding='ISO-8859-1'?><robot><a>é</a></robot>"
    (tmp_path / "hand.xacro").write_bytes(text.encode("latin-1"))
    (tmp_path / "arm.xacro").write_text(including("hand.xacro"))
    (tmp_path / "t.yaml").write_text("out:\n  include: arm.xacro\n")
    assert "<a>é</a>" in build(str(tmp_path / "t.yaml")).xml()


def test_a_file_that_is_missing_is_told_with_where_it_was_looked_for() -> None:
    files = {"arm.xacro": including("hnd.xacro"), "hand.xacro": robot("")}
    error = fault(files, "arm.xacro")
    assert (error.code, error.message) == (
        "missing-file",
        "the file 'hnd.xacro' cannot be read: the file does not exist",
    )
    assert (error.span.written(), error.hint) == ("hnd.xacro", "did you mean 'hand.xacro'?")
    assert error.notes == (f"searched for {os.path.join(AT, 'hnd.xacro')}",)


def test_a_file_that_is_missing_may_be_optional() -> None:
    files = {"arm.xacro": including("hand.xacro", 'optional="true"')}
    assert "<out/>" in run(files, "arm.xacro").xml()


def test_what_limits_say_of_a_file_of_xacros_is_told() -> None:
    files = {"arm.xacro": including("hand.xacro"), "hand.xacro": robot("")}
    policy = Policy("trusted", limits={"files": 1})
    error = fault(files, "arm.xacro", policy)
    assert (error.code, error.span.written()) == ("limit-files", "hand.xacro")
    policy = Policy("trusted", limits={"files": 2})
    assert "<out/>" in run(files, "arm.xacro", policy).xml()


def test_a_hint_of_the_loader_goes_before_a_guess(tmp_path: Path) -> None:
    (tmp_path / "hand.xacro").write_text(robot("<!--" + "x" * 1000 + "-->"))
    (tmp_path / "arm.xacro").write_text(including("hand.xacro"))
    (tmp_path / "t.yaml").write_text("out: {include: arm.xacro}\n")
    with pytest.raises(YamaroError) as caught:
        build(str(tmp_path / "t.yaml"), policy=Policy("trusted", limits={"file": 500}))
    (error,) = caught.value.diagnostics
    assert (error.code, error.hint) == ("limit-file", Limits(file=500).hint("file"))


def test_a_pattern_names_files_of_the_disk(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / f"hand_{name}.xacro").write_text(robot(f"<{name}/>"))
    (tmp_path / "arm.xacro").write_text(including("hand_*.xacro"))
    (tmp_path / "t.yaml").write_text("out: {include: arm.xacro}\n")
    xml = build(str(tmp_path / "t.yaml")).xml()
    assert xml.index("<a/>") < xml.index("<b/>")


def test_packages_are_found_from_the_file_that_names_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(name, raising=False)
    for name in ("arms", "hands"):
        (tmp_path / name).mkdir()
        manifest = f"<package><name>{name}</name></package>"
        (tmp_path / name / "package.xml").write_text(manifest)
    (tmp_path / "arms" / "arm.xacro").write_text(robot("<a>$(find hands)</a>"))
    main = tmp_path / "t.yaml"
    main.write_text("out: {include: main.xacro}\n")
    (tmp_path / "main.xacro").write_text(including("arms/arm.xacro"))
    assert f"<a>{tmp_path / 'hands'}</a>" in build(str(main)).xml()
    (tmp_path / "arms" / "arm.xacro").write_text(robot("<a>$(find heads)</a>"))
    with pytest.raises(YamaroError) as caught:
        build(str(main))
    (error,) = caught.value.diagnostics
    assert (error.code, error.message) == ("unknown-package", "the package 'heads' is not found")
    assert error.span.place().endswith("arm.xacro:1:55")
    assert any(str(tmp_path / "arms") in note for note in error.notes)


def test_xacro_sees_the_environment_if_the_file_is_trusted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("YAMARO_SIDE", "left")
    monkeypatch.delenv("YAMARO_NONE", raising=False)
    text = robot("<a>$(env YAMARO_SIDE) $(optenv YAMARO_NONE none)</a>")
    assert "<a>left none</a>" in run({"arm.xacro": text}, "arm.xacro").xml()


@pytest.mark.usefixtures("without_jail")
def test_in_a_jail_the_environment_is_empty(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("YAMARO_SIDE", "left")
    policy = Policy("safe")
    policy.is_confined = True  # as a jail says of the process in it
    text = robot("<a>$(optenv YAMARO_SIDE none)</a>")
    assert "<a>none</a>" in run({"arm.xacro": text}, "arm.xacro", policy).xml()


def test_what_xacro_prints_is_a_message() -> None:
    path = os.path.join(AT, "t.yaml")
    arm = robot("${xacro.message('so')}<a/>")
    loader = MemoryLoader({path: "out: {include: arm.xacro}", os.path.join(AT, "arm.xacro"): arm})
    told: list[str] = []
    build(path, loader=loader, on_message=told.append)
    assert [message.rstrip() for message in told] == ["so"]


def test_the_current_folder_is_that_of_the_process() -> None:
    assert f"<a>{os.getcwd()}</a>" in run({"arm.xacro": robot("<a>$(cwd)</a>")}, "arm.xacro").xml()


@pytest.mark.parametrize(
    ("main", "arm", "hand", "shown"),
    [
        ("r/t.yaml", "arm.xacro", "hand.xacro", "r/hand.xacro"),
        ("r/t.yaml", "arm.xacro", "sub/hand.xacro", "r/sub/hand.xacro"),
        ("r/t.yaml", "sub/arm.xacro", "../hand.xacro", "r/hand.xacro"),
        ("t.yaml", "arm.xacro", "../hand.xacro", "../hand.xacro"),
        ("t.yaml", "arm.xacro", "../../hand.xacro", "../../hand.xacro"),
        ("t.yaml", "arm.xacro", "../../../hand.xacro", None),  # so far away
    ],
)
def test_a_file_of_xacros_is_shown_as_the_one_that_includes_it(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    main: str,
    arm: str,
    hand: str,
    shown: str | None,
) -> None:
    folder = tmp_path / "1" / "2" / "3"
    (folder / "r" / "sub").mkdir(parents=True)
    (folder / "sub").mkdir()
    monkeypatch.chdir(folder)
    at = (folder / main).parent / arm
    at.write_text(including(hand))
    path = Path(os.path.normpath(at.parent / hand))
    path.write_text(robot("${nope}"))
    (folder / main).write_text(f"out: {{include: {arm}}}\n")
    for start, expected in ((main, shown or str(path)), (str(folder / main), str(path))):
        with pytest.raises(YamaroError) as caught:
            build(start)
        assert caught.value.diagnostics[0].span.source.name == expected.replace("/", os.sep)


@pytest.mark.parametrize("name", ["texture.gazebo", "texture", "texture.v2.inc"])
@pytest.mark.parametrize("before", ["", "\ufeff", "\n  ", "<?xml version='1.0'?>\n", "<!-- : -->"])
def test_xml_under_another_ending_was_an_error(name: str, before: str) -> None:
    files = {name: f'{before}<robot {XACRO}><l n="${{1+1}}"/></robot>'}
    assert '<l n="2"/>' in run(files, name).xml()


def test_what_begins_with_a_tag_stays_yaml_by_its_name() -> None:
    assert '<l n="2"/>' in run({"part.yaml": "<out>:\n  l/n=$(1 + 1):\n"}, "part.yaml").xml()


def test_yaml_may_begin_with_a_tag_under_any_name() -> None:
    assert '<l n="2"/>' in run({"part": "<out>:\n  l/n=$(1 + 1):\n"}, "part").xml()
