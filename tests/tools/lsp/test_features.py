"""Hover, completion, signatures, links, folding, tokens, hints and fixes in an editor."""

from __future__ import annotations

import pytest

from tests.files.wheels import install
from tests.tools.lsp.client import Client
from yamaro.robot.fields import PLACES
from yamaro.robot.notes import JOINT_WORDS, LINK_WORDS, SURFACE
from yamaro.robot.overlay import INERTIAL_KEYS, JOINT_KEYS, LINK_KEYS
from yamaro.tools.lsp.contexts import MANUAL

ARM = """robot: arm
arguments:
  reach: {default: 0.85, unit: m, range: [0.3, 1.3], help: how far it reaches}
variables:
  # The length of the upper arm.
  length: 0.5
  half: $(length / 2)
functions:
  Arm(side, size=$(length), **Payload):
  - part:
      name: $(side)_arm
      joint: {type: fixed, parent: base, xyz: 0 0 $(size + half)}
  - Payload:
model:
- part:
    name: base
    link: {visual: {geometry: box, size: 1 1 1}}
- part:
    name: tip
    joint: {type: fixed, parent: base, xyz: 1 0 $(half)}
    link:
      geometry: box
      size: 1 1 1
      mass: 6
- Arm: middle, size=1
"""


@pytest.fixture
def client(tmp_path):
    snippets = {"completion": {"completionItem": {"snippetSupport": True}}}
    with Client(
        tmp_path, capabilities={"textDocument": snippets}, options={"inlayHints": True}
    ) as client:
        yield client


def _open(client, path, text):
    """Open a file, and wait for its build."""
    uri = client.open(path, text)
    built = {"textDocument": {"uri": uri}, "range": _range(text)}
    client.wait_for(lambda: len(client.published) > 1)
    return uri, built


def _range(text):
    return {
        "start": {"line": 0, "character": 0},
        "end": {"line": text.count("\n") + 1, "character": 0},
    }


def _hover(client, uri, text, mark, after=0):
    result = client.request("textDocument/hover", client.at(uri, text, mark, after=after))
    return result and result["contents"]["value"]


@pytest.mark.parametrize(
    ("mark", "after", "wanted"),
    [
        ("length / 2", 1, "The length of the upper arm"),
        ("half: $", 1, "value: `0.25`"),
        ("$(half)", 3, "value: `0.25`"),
        ("xyz: 1 0 $(half)", 1, "in the output: `1 0 0.25`"),
        ("xyz: 1 0 $(half)", 6, "in the output: `1 0 0.25`"),
        ("reach:", 1, "how far it reaches"),
        ("- Arm: middle", 3, "Arm: side, size=$(length), **Payload"),
        ("name: tip", 6, "mass 6 kg"),
        ("name: tip", 6, "inertia 1 0 0 1 0 1 kg"),
        ("name: tip", 6, "at zero: xyz 1 0 0.25 m"),
        ("parent: base, xyz: 1", 9, "link `base_link`"),
        ("geometry: box\n", 1, "the shape: box"),
        ("type: fixed, parent: base, xyz: 1", 1, "revolute, continuous"),
        ("joint: {type: fixed, parent: base, xyz: 1", 1, "the joint to the parent"),
        ("model:", 1, "the content of the robot"),
    ],
)
def test_hovers(client, tmp_path, mark, after, wanted):
    uri, _ = _open(client, tmp_path / "arm.yaml", ARM)
    assert wanted in (_hover(client, uri, ARM, mark, after) or "nothing")


SET = """robot: arm
variables:
  half: 0.25
  unread: $(half * 2)
  "quoted": [1, $(half)]
functions:
  Arm(side, size=$(half)):
  - variables:
      inner: $(size * 2)
  - part:
      name: $(side)_arm
      joint: {type: fixed, parent: base}
model:
- process: made = half * 10
- part:
    name: base
- for i in range(3):
  - for name, number in [['a', 1], ['b', 2]]:
    - if number > i:
      - print: $(i)
- Arm: middle, size=1
- Arm: left
"""


@pytest.mark.parametrize(
    ("mark", "values"),
    [
        ("half: 0.25", "`0.25`"),
        ("unread:", "`0.5`"),
        ("quoted", "`[1, 0.25]`"),
        ("side, size", "`'middle'`, `'left'`"),
        ("size=$", "`1`, `0.25`"),
        ("inner", "`2`, `0.5`"),
        ("made", "`2.5`"),
        ("i in range", "`0`, `1`, `2`"),
        ("number in", "`1`, `2`"),
        ("number > i", "`1`, `2`"),
    ],
)
def test_values_are_shown_though_no_output_reads_them(client, tmp_path, mark, values):
    uri, _ = _open(client, tmp_path / "arm.yaml", SET)
    assert (_hover(client, uri, SET, mark, 0) or "").endswith(f"value: {values}")


def test_nothing_is_said_of_nothing(client, tmp_path):
    uri, _ = _open(client, tmp_path / "arm.yaml", ARM)
    assert _hover(client, uri, ARM, "1 1 1", 1) is None


def _complete(client, path, text):
    """Return the labels offered at `|` in a text, and what each would write."""
    offset = text.index("|")
    text = text.replace("|", "", 1)
    uri = client.open(path, text)
    line = text.count("\n", 0, offset)
    column = offset - text.rfind("\n", 0, offset) - 1
    parameters = {"textDocument": {"uri": uri}, "position": {"line": line, "character": column}}
    found = client.request("textDocument/completion", parameters)["items"]
    client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    return {each["label"]: each["textEdit"]["newText"] for each in found}


PART = "robot: r\nmodel:\n- part:\n    name: base\n- part:\n    name: tip\n"


@pytest.mark.parametrize(
    ("text", "offered", "not_offered"),
    [
        ("|", ["robot", "model", "variables"], ["part"]),
        ("robot: r\nmo|", ["model"], ["part"]),
        ("model:\n- |", ["part", "if", "for", "include", "attach"], ["lower"]),
        ("model:\n- part:\n    |", ["name", "joint", "link", "if"], ["geometry"]),
        (PART + "    joint:\n      |", ["type", "parent", "axis", "limit"], ["geometry"]),
        (PART + "    joint: {|}", ["type", "parent"], ["geometry"]),
        (PART + "    joint: {type: fixed, |}", ["parent"], ["geometry"]),
        (PART + "    joint: {type: |}", ["revolute", "fixed"], ["parent"]),
        (PART + "    joint: {|\n- include: leg.yaml\n", ["type", "parent"], ["geometry"]),
        (PART + "    joint: {ty|\n- include: leg.yaml\n", ["type", "parent"], ["geometry"]),
        (PART + "    joint: {type: |\n- include: leg.yaml\n", ["revolute"], ["parent"]),
        (PART + "    joint:\n      type: re|\n      xyz: 0 0 0\n", ["revolute"], ["parent"]),
        (PART + "    joint:\n      parent: |", ["base", "base_link", "tip"], ["fixed"]),
        (PART + "    joint:\n      limit: {|}", ["lower", "upper", "effort"], ["type"]),
        ("robot: r\ncontrollers:\n  a: {|}", ["type", "joints", "group"], ["kp", "part"]),
        (
            "robot: r\ncontrollers:\n  a: {type: diff_drive, |}",
            ["wheel_radius", "joints"],
            ["type", "gains"],
        ),
        ("robot: r\ncontrollers:\n  a: {type: |}", ["diff_drive", "gripper"], ["joints"]),
        ("robot: r\ncontrollers:\n  |", ["update_rate", "distro"], ["type", "part"]),
        ("robot: r\ngroups:\n  a: {kinematics: |}", ["kdl", "trac_ik"], ["chain"]),
        (PART + "    joint:\n      actuator: {|}", ["kp", "motor", "frequency"], ["type"]),
        (PART + "    joint:\n      actuator: {motor: |}", ["xm430_w350", "mx_64"], ["gear"]),
        (PART + "    joint:\n      actuator: {motor: {|}}", ["gear", "armature"], ["kp", "motor"]),
        (PART + "    link:\n      geometry: |", ["box", "cylinder", "leg.yaml"], ["fixed"]),
        (PART + "    link:\n      visual:\n        |", ["material", "geometry"], ["mass"]),
        (PART + "    link:\n    - if true:\n      - |", ["geometry", "mass"], []),
        (ARM + "- part:\n    joint: {xyz: 0 0 $(le|)}", ["length", "half", "sin", "mm"], []),
        (ARM + "- if le|:\n", ["length", "half"], []),
        (ARM + "- if:\n    condition: |", ["length", "half"], []),
        (ARM + "- process: |", ["length", "half"], []),
        (ARM.replace("$(size + half)", "$(|)"), ["size", "side", "length"], []),
        (ARM + "- A|", ["Arm"], []),
        (ARM + "- Arm:\n    |", ["side", "size", "Payload"], []),
        (ARM + "- Arm:\n    side: left\n    |", ["size", "Payload"], ["side"]),
        (ARM + "- Arm: |", ["side", "size"], ["Payload"]),
        ("import: |", ["math", "helper"], []),
        ("model:\n- include: |", ["leg.yaml", "meshes"], []),
        ("model:\n- include: meshes/|", ["a.stl"], ["leg.yaml"]),
        ("model:\n- include:\n    path: leg.yaml\n    |", ["length", "namespace"], ["path"]),
        ("overlay:\n  joints:\n    elbow: {|}", ["zero", "limit", "xyz"], ["parent", "part"]),
        ("overlay:\n  joints:\n    elbow: {limit: {|}}", ["upper", "effort"], ["zero"]),
        ("overlay:\n  links:\n    arm: {inertial: {|}}", ["mass", "xyz"], ["geometry"]),
        (
            "model:\n- include: {path: leg.yaml, overlay: {joints: {elbow: {|}}}}",
            ["zero", "dynamics"],
            ["length"],
        ),
        ("variables:\n  a/|", ["local", "global", "bridge"], []),
        ("arguments:\n  a: {|}", ["default", "range", "help"], []),
        ("arguments:\n  a: {type: |}", ["number", "text"], []),
        ("model:\n- gazebo/|", [], []),
        ("model:\n- joint/name=a, type=|:", ["revolute"], []),
        (PART + "states:\n  home:\n    |", ["base", "tip"], []),
        (
            "model:\n- include: {path: leg.yaml, namespace: Legs}\n- print: $(Legs.|)",
            ["index"],
            ["length"],
        ),
    ],
)
def test_completion_knows_where_it_is(client, tmp_path, text, offered, not_offered):
    (tmp_path / "leg.yaml").write_text("variables:\n  length: 1\n  index/parent: 2\n")
    (tmp_path / "helper.py").write_text("x = 1\n")
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "a.stl").write_text("solid\n")
    found = _complete(client, tmp_path / "arm.yaml", text)
    assert set(offered) <= set(found)
    assert not set(not_offered) & set(found)


@pytest.mark.parametrize(
    ("link", "offered", "not_offered"),
    [
        ("\n      geometry: cylinder\n      |", ["radius", "length", "scale"], ["size"]),
        ("\n      |\n      geometry: Capsule\n", ["radius", "length", "scale"], ["size"]),
        ("\n    - geometry: box\n    - |", ["size", "scale"], ["radius", "length"]),
        (" {geometry: sphere, |}", ["radius", "scale"], ["size", "length"]),
        (" {geometry: a.stl, |}", ["scale"], ["size", "radius", "length"]),
        (" {geometry: cylinder, scale: 1 2, |}", ["mass"], ["size", "radius", "length"]),
        (" {geometry: cylinder, radius: 1, |}", ["length"], ["scale", "size"]),
        ("\n      geometry: cylinder\n      visual:\n        |", ["radius", "scale"], ["size"]),
        ("\n      geometry: box\n      visual: {geometry: sphere, |}", ["radius"], ["size"]),
        (" {geometry: $(shape), |}", ["size", "radius", "length", "scale"], []),
        (" {|}", ["size", "radius", "length", "scale"], []),
    ],
)
def test_only_the_sizes_of_the_shape_are_offered(client, tmp_path, link, offered, not_offered):
    text = f"robot: r\nmodel:\n- part:\n    name: a\n    link:{link}"
    found = _complete(client, tmp_path / "arm.yaml", text)
    assert set(offered) <= set(found)
    assert not set(not_offered) & set(found)


@pytest.mark.parametrize(
    "functions",
    [
        "  # One leg.\n  Leg(side):\n  - part: {name: $(side)}\n",
        "  Leg(side):  # One leg.\n  - part: {name: $(side)}\n",
        "  Leg(side):\n  # One leg.\n  - part: {name: $(side)}\n",
        "  Leg:\n    # One leg.\n    input: side\n    body: {part: {name: $(side)}}\n",
        "# One leg.\n- Leg: {input: side, body: {part: {name: $(side)}}}\n",
        "  Other():\n  - print: x  # no leg\n\n  # One leg.\n  Leg(side):\n  - print: $(side)\n",
    ],
)
def test_the_comment_on_a_function_is_shown_where_it_is_called(client, tmp_path, functions):
    text = f"functions:\n{functions}model:\n- Leg: left\n"
    uri = client.open(tmp_path / "a.yaml", text)
    assert (_hover(client, uri, text, "- Leg: left", 3) or "").endswith("\n\nOne leg.")
    parameters = client.at(uri, text, "- Leg: left", after=8)
    (signature,) = client.request("textDocument/signatureHelp", parameters)["signatures"]
    assert signature["documentation"] == "One leg."
    items = client.request("textDocument/completion", client.at(uri, text, "- Leg: left", after=4))
    (leg,) = [each for each in items["items"] if each["label"] == "Leg"]
    assert leg["documentation"]["value"] == "One leg."


SPACED = "model:\n- include: {path: leg.yaml, namespace: Legs}\n"


@pytest.mark.parametrize(
    ("text", "offered", "not_offered"),
    [
        ("model:\n- include: leg.yaml\n- |", ["Leg", "Foot"], ["Own"]),
        ("model:\n- include: leg.yaml\n- L|\n- gazebo:\n", ["Leg"], []),
        ("model:\n- |\n- include: {path: leg.yaml}\n", ["Leg"], []),
        ("model:\n  include: leg.yaml\n  L|", ["Leg"], []),
        ("model:\n- include: leg.yaml\n- part:\n    link:\n    - |", ["Leg"], []),
        ("model:\n- if true:\n  - include: leg.yaml\n  - |", ["Leg"], []),
        ("functions:\n  All():\n  - include: leg.yaml\n  - |\nmodel:\n- All:\n", ["Leg"], []),
        ("model:\n- include: leg.yaml\n- Leg: |", ["side"], []),
        (SPACED + "- |", ["Legs.Leg", "Legs.Foot", "Foot"], ["Leg"]),
        (SPACED + "- Legs.|", ["Leg", "Foot"], ["part", "Own"]),
        (SPACED + "- Legs.L|", ["Leg"], ["part"]),
        (SPACED + "- Legs.Leg:\n    |", ["side"], []),
    ],
)
def test_functions_of_included_files_are_offered_where_they_can_be_called(
    client, tmp_path, text, offered, not_offered
):
    (tmp_path / "leg.yaml").write_text(
        "functions:\n"
        "  Leg/parent: {input: side, body: {print: x}}\n"
        "  Foot/global: {input: size, body: {print: x}}\n"
        "  Own: {body: {print: x}}\n"
    )
    found = _complete(client, tmp_path / "arm.yaml", text)
    assert set(offered) <= set(found)
    assert not set(not_offered) & set(found)


def test_packages_that_pip_has_installed_are_known(tmp_path):
    """They are offered, with their files, and a build takes what they bring."""
    part = "model:\n- link/name=wheel:\n"
    site = tmp_path / "site-packages"
    install(site, "rover", {"rover/part.yaml": part}, entry_points="rover = rover")
    (tmp_path / "home").mkdir()
    path = tmp_path / "home" / "arm.yaml"
    with Client(tmp_path / "home", env={"PYTHONPATH": str(site)}) as client:
        offered = _complete(client, path, "robot: r\nmodel:\n- include: |")
        assert offered["package://rover/"] == "package://rover/"
        offered = _complete(client, path, "robot: r\nmodel:\n- include: package://rover/|")
        assert "part.yaml" in offered
        uri, _ = _open(client, path, "robot: r\nmodel:\n- include: package://rover/part.yaml\n")
        assert client.diagnostics[uri] == []


def test_completion_writes_keys_with_a_colon_and_calls_with_parameters(client, tmp_path):
    found = _complete(client, tmp_path / "arm.yaml", ARM + "- A|")
    assert found["Arm"] == "Arm: ${1:side}, ${2:size}$0"
    assert found["include"] == "include: "
    assert _complete(client, tmp_path / "arm.yaml", ARM + "- a|: x")["attach"] == "attach"


def test_signatures(client, tmp_path):
    text = ARM + "- Arm: left, \n"
    uri = client.open(tmp_path / "arm.yaml", text)
    place = client.at(uri, text, "- Arm: left, ", after=13)
    found = client.request("textDocument/signatureHelp", place)
    assert found["signatures"][0]["label"] == "Arm(side, size=$(length), **Payload)"
    assert found["activeParameter"] == 1
    place = client.at(uri, text, "middle, size=1", after=14)
    assert client.request("textDocument/signatureHelp", place)["activeParameter"] == 1
    assert client.request("textDocument/signatureHelp", client.at(uri, text, "robot")) is None


def test_links_and_folding(client, tmp_path):
    (tmp_path / "leg.yaml").write_text("model:\n")
    text = "# one\n# two\nmodel:\n- include: leg.yaml\n- include: 'gone.yaml'\n"
    uri = client.open(tmp_path / "arm.yaml", text)
    document = {"textDocument": {"uri": uri}}
    links = client.request("textDocument/documentLink", document)
    assert [each["target"] for each in links] == [(tmp_path / "leg.yaml").as_uri()]
    folds = client.request("textDocument/foldingRange", document)
    assert {"startLine": 0, "endLine": 1, "kind": "comment"} in folds
    assert {"startLine": 2, "endLine": 4} in folds


def test_tokens_are_in_order_and_name_what_they_are(client, tmp_path):
    uri = client.open(tmp_path / "arm.yaml", ARM)
    data = client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}})
    legend = client.server["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"]
    lines = ARM.split("\n")
    line = column = 0
    found: dict[str, str] = {}
    for start in range(0, len(data["data"]), 5):
        down, right, length, kind, _ = data["data"][start : start + 5]
        line, column = line + down, right if down else column + right
        assert down >= 0 and right >= 0 and length > 0
        found.setdefault(lines[line][column : column + length], legend[kind])
    assert found["length"] == "variable"
    assert found["side"] == "parameter"
    assert found["Arm"] == "function"
    assert found["base"] == "class"


def test_hints_are_shown_if_they_are_asked_for(client, tmp_path):
    uri, built = _open(client, tmp_path / "arm.yaml", ARM)
    hints = client.request("textDocument/inlayHint", built)
    assert {each["label"] for each in hints} == {"= 0.25", "6 kg"}
    with Client(tmp_path) as other:
        _, built = _open(other, tmp_path / "arm.yaml", ARM)
        assert other.request("textDocument/inlayHint", built) == []
    assert uri


def test_a_fix_writes_what_the_hint_says(client, tmp_path):
    text = ARM.replace("$(length / 2)", "$(lenght / 2)")
    uri, built = _open(client, tmp_path / "arm.yaml", text)
    client.wait_for_codes(uri, ["undefined-name"])
    actions = client.request("textDocument/codeAction", {**built, "context": {"diagnostics": []}})
    assert [each["title"] for each in actions] == ["change 'lenght' to 'length'"]
    edit = actions[0]["edit"]["changes"][uri][0]
    assert edit["newText"] == "length"
    start = client.at(uri, text, "lenght")["position"]
    assert edit["range"]["start"] == start
    other = {**built, "context": {"diagnostics": [], "only": ["refactor"]}}
    assert client.request("textDocument/codeAction", other) == []


XACRO = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">
  <xacro:property name="size" value="0.5"/>
  <xacro:macro name="leg" params="side">
    <link name="${side}_leg"><visual><geometry><box size="${size} 1 1"/></geometry></visual></link>
  </xacro:macro>
  <link name="base"/>
  <xacro:leg side="left"/>
  <joint name="j" type="fixed"><parent link="base"/><child link="left_leg"/></joint>
</robot>
"""


def test_xacro_files_have_diagnostics_definitions_and_hovers(client, tmp_path):
    (tmp_path / "robot.xacro").write_text(XACRO)
    uri = client.open(tmp_path / "robot.xacro", XACRO)

    def definition(mark, after):
        found = client.request("textDocument/definition", client.at(uri, XACRO, mark, after=after))
        return [each["range"]["start"]["line"] for each in found]

    assert definition("${size}", 3) == [1]
    assert definition("<xacro:leg", 8) == [2]
    assert definition('link="base"/>', 7) == [5]
    assert 'value="0.5"' in _hover(client, uri, XACRO, "${size}", 3)
    symbols = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
    assert "leg" in [each["name"] for each in symbols]
    client.change(uri, 2, [{"text": XACRO.replace("</robot>", "")}])
    client.wait_for(lambda: client.codes(uri) != [])
    assert client.codes(uri)[0].startswith("xml") or client.codes(uri)


def test_a_fault_in_an_included_file_is_shown_there(client, tmp_path):
    (tmp_path / "arm.urdf").write_text('<robot name="a"><link name="l"/><joint/></robot>')
    text = "robot: r\nmodel:\n- include: arm.urdf\n"
    client.open(tmp_path / "main.yaml", text)
    uri = (tmp_path / "arm.urdf").as_uri()
    client.wait_for(lambda: client.codes(uri) != [])
    client.notify(
        "textDocument/didClose", {"textDocument": {"uri": (tmp_path / "main.yaml").as_uri()}}
    )
    client.wait_for_codes(uri, [])


def test_code_that_needs_trust_is_one_remark(client, tmp_path):
    text = "robot: r\nimport: os\nvariables:\n  a: $(os.getcwd())\nmodel:\n- link/name=$(a):\n"
    uri = client.open(tmp_path / "arm.yaml", text)
    client.wait_for(lambda: client.codes(uri) != [])
    found = client.diagnostics[uri]
    assert [(each["severity"], "needs trust" in each["message"]) for each in found] == [(3, True)]


def _edited(text, edits):
    """Apply edits of whole lines or parts of them."""
    lines = text.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)

    def offset(position):
        return min(starts[position["line"]] + position["character"], len(text))

    for edit in sorted(edits, key=lambda edit: offset(edit["range"]["start"]), reverse=True):
        start, end = offset(edit["range"]["start"]), offset(edit["range"]["end"])
        text = text[:start] + edit["newText"] + text[end:]
    return text


def test_formatting_gives_what_fmt_gives(client, tmp_path):
    from yamaro.layout import formatted
    from yamaro.source import Source

    for number, text in enumerate(
        (
            "robot:   r\nmodel:\n    - part:\n        name:   a\n\n\n\n# end\n",
            "robot:   r\r\nmodel:\r\n    - part:\r\n        name:   a",
            ARM,
        )
    ):
        uri = client.open(tmp_path / f"{number}.yaml", text)
        options = {"tabSize": 8, "insertSpaces": True}
        parameters = {"textDocument": {"uri": uri}, "options": options}
        edits = client.request("textDocument/formatting", parameters)
        wanted = formatted(Source(text, name="a"))
        assert _edited(text, edits) == wanted
    uri = client.open(tmp_path / "broken.yaml", "a: [\n")
    parameters["textDocument"] = {"uri": uri}
    assert "error" in client.ask("textDocument/formatting", parameters)


def test_a_finding_is_accepted_by_a_quick_fix_and_obeyed(client, tmp_path):
    text = (
        "robot: heavy\nmodel:\n- part:\n    name: base\n"
        "    link: {geometry: box, size: 1 1 1, mass: 1}\n"
    )
    uri, built = _open(client, tmp_path / "arm.yaml", text)
    client.wait_for_codes(uri, ["root-inertia"])
    actions = client.request("textDocument/codeAction", {**built, "context": {"diagnostics": []}})
    assert [each["title"] for each in actions] == ["accept 'root-inertia' here"]
    edit = actions[0]["edit"]["changes"][uri][0]
    assert edit["newText"] == "  # yamaro: allow root-inertia"
    accepted = text.rstrip("\n") + edit["newText"] + "\n"
    client.change(uri, 2, [{"text": accepted}])
    client.wait_for_codes(uri, [])
    unused = accepted.replace("mass: 1", "visual: ")
    client.change(uri, 3, [{"text": unused}])
    client.wait_for_codes(uri, ["unused-allow"])
    actions = client.request("textDocument/codeAction", {**built, "context": {"diagnostics": []}})
    assert actions[0]["title"] == "remove the comment"


def test_the_manual_has_the_keys_of_parts() -> None:
    beside = {"joint": JOINT_WORDS, "link": LINK_WORDS, "collision": {SURFACE}}
    for place in PLACES:
        assert set(MANUAL[place.name]) == place.all_keys | beside.get(place.name, set())
    overlays = {"joint": JOINT_KEYS, "link": LINK_KEYS, "inertial": INERTIAL_KEYS}
    for name, keys in overlays.items():
        assert set(MANUAL[f"{name} of an overlay"]) == set(keys)


def test_an_overlay_is_checked_as_it_is_written(client, tmp_path):
    text = "overlay:\n  joints:\n    elbow: {limt: {upper: 2}}\n"
    uri, _ = _open(client, tmp_path / "unit.yaml", text)
    client.wait_for_codes(uri, ["unknown-key"])
    client.change(uri, 2, [{"text": text.replace("limt", "limit")}])
    client.wait_for_codes(uri, [])
