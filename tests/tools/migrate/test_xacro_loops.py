"""Macros that call themselves to repeat something become loops, and the robot stays the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.test_xacro_migration import hold_for, migrated

ARGUMENT = '<xacro:arg name="n" default="3"/>\n'
UP = '<xacro:loop i="0" n="$(arg n)"/>'
DOWN = '<xacro:loop i="$(arg n)"/>'
LISTED = """
<xacro:property name="all" value="${['a', 'b', 'c', 'd', 'e'][0:$(arg n)]}"/>
<xacro:loop items="${all}"/><rest of="${all}"/>"""

ONE = '<a i="${i}"/>'
NEXT = '<xacro:loop i="${i + 1}" n="${n}"/>'
LOWER = '<xacro:loop i="${i - 1}"/>'
ITEM = '<xacro:property name="item" value="${items[0]}"/>'
POPPED = '<xacro:property name="item" value="${items.pop(0)}"/>'
EACH = '<a i="${item}"/>'
REST = '<xacro:loop items="${items[1:]}"/>'
SAME = '<xacro:loop items="${items}"/>'


def macro(parameters: str, body: str, *calls: str) -> str:
    """Return a robot with a macro `loop` and calls of it."""
    definition = f'<xacro:macro name="loop" params="{parameters}">\n{body}\n</xacro:macro>\n'
    return ARGUMENT + definition + "\n".join(calls)


def guarded(condition: str, content: str) -> str:
    """Return content under a condition, such as `if ${n}`."""
    tag, _, value = condition.partition(" ")
    return f'<xacro:{tag} value="{value.replace("<", "&lt;")}">{content}</xacro:{tag}>'


def function_of(folder: Path, text: str) -> list[str]:
    """Return the lines of the function that the macro becomes.

    The robot it makes is the one that xacro makes, for several arguments.
    """
    made = migrated(folder, text)["r.yaml"]
    hold_for(folder, *([f"n:={n}"] for n in (0, 1, 2, 5)))
    lines = made.split("functions:\n")[1].split("model:\n")[0].splitlines()
    start = next(at for at, line in enumerate(lines) if line.startswith("  Loop("))
    return [line[2:] for line in lines[start:]]


@pytest.mark.parametrize(
    ("condition", "content", "call", "over"),
    [
        ("if ${i < n}", ONE + NEXT, UP, "range(i, n)"),
        ("if ${n > i}", ONE + '<xacro:loop i="${1 + i}" n="${n}"/>', UP, "range(i, n)"),
        ("unless ${i >= n}", ONE + NEXT, UP, "range(i, n)"),
        ("unless ${i == n}", ONE + NEXT, UP, "range(i, n)"),
        ("if ${not i >= n}", ONE + NEXT, UP, "range(i, n)"),
        ("if ${i <= n}", ONE + NEXT, UP, "range(i, n + 1)"),
        ("if ${i <= n - 1}", ONE + NEXT, UP, "range(i, n)"),
        ("if ${i < n}", ONE + '<xacro:loop i="${i + 2}" n="${n}"/>', UP, "range(i, n, 2)"),
        ("if ${i < n}", NEXT + ONE, UP, "range(n - 1, i - 1, -1)"),
        ("if ${i}", ONE + LOWER, DOWN, "range(i, 0, -1)"),
        ("if ${i > 0}", ONE + LOWER, DOWN, "range(i, 0, -1)"),
        ("if ${i >= 0}", ONE + LOWER, DOWN, "range(i, -1, -1)"),
        ("if ${0 < i}", ONE + '<xacro:loop i="${i - 2}"/>', DOWN, "range(i, 0, -2)"),
        ("if ${i > 0}", LOWER + ONE, DOWN, "range(1, i + 1)"),
        ("if ${i > 0}", '<xacro:loop i="${i - 2}"/>' + ONE, DOWN, "reversed(range(i, 0, -2))"),
        ("if ${items}", ITEM + EACH + REST, LISTED, "items"),
        ("if ${len(items) > 0}", ITEM + EACH + REST, LISTED, "items"),
        ("unless ${items == []}", '<a i="${items[0]} ${items[0] + 1}"/>' + REST, "", "items"),
        ("if ${items}", '<a i="${items[-1]}"/><xacro:loop items="${items[:-1]}"/>', LISTED,
         "items[::-1]"),
        ("if ${items}", REST + ITEM + EACH, LISTED, "items[::-1]"),
        ("if ${items}", POPPED + EACH + SAME, "<xacro:loop items='${[1, 2, 3]}'/>", "items"),
        ("if ${items}", POPPED.replace("0", "") + EACH + SAME,
         "<xacro:loop items='${list(python.range($(arg n)))}'/>", "items[::-1]"),
        ("if ${items}", ITEM + '<a i="${item * 2}"/>' + REST,
         """<xacro:loop items="${'1 2 3'.split()}"/>""", "map(int, items)"),
    ],
)  # fmt: skip
def test_it_becomes_a_loop(
    tmp_path: Path, condition: str, content: str, call: str, over: str
) -> None:
    parameters = {UP: "i n", DOWN: "i"}.get(call, "items")
    body = guarded(condition, content)
    call = call or "<xacro:loop items='${[4, 5]}'/>"
    lines = function_of(tmp_path, macro(parameters, body, call))
    assert any(line.startswith("  for ") and line.endswith(f" in {over}:") for line in lines)
    assert not any("Loop:" in line for line in lines)


@pytest.mark.parametrize(
    "text",
    [
        macro("i n:=^", guarded("if ${i < n}", ONE + '<xacro:loop i="${i + 1}"/>'), UP),
        macro(
            "i",
            guarded("unless ${i == $(arg n)}", ONE + '<xacro:loop i="${i+1}"/>'),
            '<xacro:loop i="0"/>',
        ),
    ],
)
def test_the_bound_may_be_the_callers_or_an_argument(tmp_path: Path, text: str) -> None:
    assert "  for i in range(i, n):" in function_of(tmp_path, text)


def test_what_the_call_changes_is_assigned_at_the_end(tmp_path: Path) -> None:
    text = macro(
        "i n parent:=base x:=0.5 *limit",
        """\
        <!-- a chain of links -->
        <xacro:if value="${i &lt; n}">
          <!-- one link -->
          <xacro:property name="own" value="link_${i}"/>
          <link name="${own}" at="${x}" on="${parent}"><xacro:insert_block name="limit"/></link>
          <xacro:loop i="${i + 1}" n="${n}" parent="${own}" x="${x * 2}">
            <xacro:insert_block name="limit"/>
          </xacro:loop>
        </xacro:if>
        <xacro:unless value="${i &lt; n}"><tool on="${parent}"/></xacro:unless>""",
        '<xacro:loop i="0" n="$(arg n)"><limit lower="1"/></xacro:loop>',
        '<xacro:loop i="2" n="3" parent="other"><limit lower="2"/></xacro:loop>',
    )
    assert function_of(tmp_path, text) == [
        "Loop(i, n, parent=base, x=0.5, **Limit):",
        "  # a chain of links",
        "  for i in range(i, n):",
        "  # one link",
        "  - variables:",
        "      own: link_$(i)",
        "  - link/name=$(own), at=$(x), on=$(parent):",
        "      Limit:",
        "  - variables:",
        "      parent: $(own)",
        "      x: $(x * 2)",
        "  tool/on=$(parent):",
    ]


def test_changes_do_not_read_what_others_have_changed(tmp_path: Path) -> None:
    text = macro(
        "i a b",
        """\
        <xacro:if value="${i}"><a a="${a}" b="${b}"/>
        <xacro:loop i="${i - 1}" a="${a + i}" b="${a}"/></xacro:if>""",
        '<xacro:loop i="$(arg n)" a="1" b="2"/>',
    )
    lines = function_of(tmp_path, text)
    assert lines[-3:] == ["    variables:", "      b: $(a)", "      a: $(a + i)"]


def test_loops_may_stand_in_loops(tmp_path: Path) -> None:
    rows = """\
        <xacro:macro name="rows" params="j m">
          <xacro:if value="${j &lt; m}">
            <xacro:loop i="0" n="${j}"/>
            <xacro:rows j="${j + 1}" m="${m}"/>
          </xacro:if>
        </xacro:macro>"""
    body = """\
        <xacro:if value="${i &lt; n}">
          <xacro:if value="${i > 0}"><a i="${i}" last="${last}"/></xacro:if>
          <xacro:property name="last" value="${i * 10}"/>
          <xacro:loop i="${i + 1}" n="${n}"/>
        </xacro:if>"""
    text = macro("i n", body, rows, '<xacro:rows j="0" m="$(arg n)"/>')
    lines = function_of(tmp_path, text)
    loops = [line.strip() for line in lines if "range" in line]
    assert loops == ["for i in range(i, n):", "for j in range(j, m):"]


def test_comments_of_the_item_stay_and_that_of_the_call_goes(tmp_path: Path) -> None:
    text = macro(
        "items:=^",
        """\
        <xacro:if value="${items}">
          <!-- the next one -->
          <xacro:property name="each" value="${items.pop(0)}"/>
          <a i="${each}"/>
          <!-- and all the others -->
          <xacro:loop/>
        </xacro:if>""",
        '<xacro:loop items="${[1, 2]}"/>',
    )
    assert function_of(tmp_path, text) == [
        "Loop(items):",
        "  # the next one",
        "  for each in items:",
        "    a/i=$(each):",
    ]


HANDED = '<xacro:property name="v" value="${i}" scope="parent"/>'
GIVEN = '<xacro:property name="v" value="1"/>'
END = guarded("unless ${i}", '<end i="${i}"/>')
SHOW = f"""<xacro:macro name="show" params="shown:=0">{
    guarded("if ${shown}", '<a i="${i}"/>')
}</xacro:macro>"""
SHOWN = '<xacro:show shown="1"/>'
FEWER = '<xacro:property name="n" value="${n - 1}" lazy_eval="false"/>'


@pytest.mark.parametrize(
    "text",
    [
        # the work is done once more than the condition holds
        macro("i n", ONE + guarded("if ${i < n}", NEXT), UP),
        # work on both sides of the call, and a call within an element
        macro("i", guarded("if ${i}", ONE + LOWER + "<b/>"), DOWN),
        macro("i", guarded("if ${i}", f"<b>{ONE}{LOWER}</b>"), DOWN),
        # two calls
        macro("i", guarded("if ${i > 0}", ONE + LOWER + '<xacro:loop i="${i - 2}"/>'), DOWN),
        # the bound moves
        macro("i n", guarded("if ${i < n}", ONE + NEXT.replace("{n}", "{n - 1}")), UP),
        macro("i n", guarded("if ${i < n}", FEWER + ONE + NEXT), UP),
        # the bound, the step or the first are no whole numbers
        macro("i n", guarded("if ${i < n}", ONE + NEXT), '<xacro:loop i="0" n="2.5"/>'),
        macro("i n", guarded("if ${i < n}", ONE + NEXT), UP.replace("$(arg n)", "${$(arg n) / 2}")),
        macro("i n", guarded("if ${i < n}", ONE + NEXT), UP.replace('"0"', '"0.5"')),
        macro("i n", guarded("if ${i < n}", ONE + NEXT.replace("1", "0.5")), UP),
        # it is not counted in steps
        macro("i n", guarded("if ${i < n}", ONE + NEXT.replace("+ 1", "* 2 + 1")), UP),
        # a second reason to stop
        macro("i n", guarded("if ${i < n and i != 3}", ONE + NEXT), UP),
        # something is handed to the caller
        macro("i", guarded("if ${i}", HANDED + ONE + LOWER), GIVEN, DOWN),
        # what stands at the end reads the counter, which a loop leaves one behind
        macro("i", guarded("if ${i}", ONE + LOWER) + END, DOWN),
        # a macro that is called reads the counter, which is not passed to it
        macro("i", guarded("if ${i}", SHOWN + LOWER), SHOW, "<xacro:show/>", DOWN),
        # the list is read as a whole, or seen by others while it shrinks
        macro("items", guarded("if ${items}", '<a n="${len(items)}"/>' + ITEM + REST), LISTED),
        macro("items", guarded("if ${items}", POPPED + EACH + SAME), LISTED),
        # parameters that swap
        macro(
            "i a b",
            guarded("if ${i}", '<a a="${a}"/><xacro:loop i="${i - 1}" a="${b}" b="${a}"/>'),
            '<xacro:loop i="$(arg n)" a="1" b="2"/>',
        ),
        # a property before the call is seen in it
        macro("i", guarded("if ${i}", ITEM.replace("items[0]", "i") + LOWER + EACH), DOWN),
    ],
)  # fmt: skip
def test_what_may_differ_stays_a_call(tmp_path: Path, text: str) -> None:
    lines = function_of(tmp_path, text)
    assert not any("for " in line for line in lines)
    assert any("Loop:" in line for line in lines)


def test_the_counter_is_passed_to_a_macro_that_reads_it(tmp_path: Path) -> None:
    text = macro("i", guarded("if ${i}", SHOWN + LOWER), SHOW, DOWN)
    assert any("for " in line for line in function_of(tmp_path, text))


def test_a_macro_that_is_defined_in_two_ways_stays_a_call(tmp_path: Path) -> None:
    text = macro("i", guarded("if ${i}", ONE + LOWER))
    definition = text.removeprefix(ARGUMENT)
    other = definition.replace("<a ", "<b ")
    condition = "${$(arg n) > 1}"
    both = guarded(f"if {condition}", definition) + guarded(f"unless {condition}", other)
    made = migrated(tmp_path, ARGUMENT + both + DOWN)["r.yaml"]
    assert "for " not in made
    hold_for(tmp_path, ["n:=0"], ["n:=1"], ["n:=2"])
