"""Details of keys, values and statements: what each spelling means, and what is said of a fault."""

from __future__ import annotations

import sys

import pytest

from yamaro import Build, Policy, YamaroError, build
from yamaro.diagnostics import Diagnostic, Reporter
from yamaro.files.loader import MemoryLoader
from yamaro.source import Source
from yamaro.syntax.context import ParseContext
from yamaro.syntax.keys import parse_attributes
from yamaro.yaml.nodes import (
    DOUBLE,
    PLAIN,
    SINGLE,
    ScalarNode,
    _align_flow,
    is_null,
    quoted,
    type_plain,
)

PYTHON_KNOWS_COLUMNS = sys.version_info >= (3, 11)
"""Whether it is known where in a line of Python a fault is."""


def build_text(text: str, *arguments: str) -> Build:
    return build("/t.yaml", command_line=arguments, loader=MemoryLoader({"/t.yaml": text}))


def out(text: str) -> str:
    """Return what a body of a root element `out` gives, without line breaks and indentation."""
    lines = "".join(f"  {line}\n" for line in text.splitlines())
    xml = build_text(f"out:\n{lines}").xml()
    return "".join(line.strip() for line in xml.splitlines()[1:])


def fault(text: str) -> Diagnostic:
    """Return the first error in a file."""
    with pytest.raises(YamaroError) as caught:
        build_text(text)
    return next(one for one in caught.value.diagnostics if one.severity == "error")


def place(diagnostic: Diagnostic) -> str:
    """Return the place of a fault as line, column and the text underlined."""
    line, column = diagnostic.span.location()
    return f"{line}:{column} {diagnostic.span.written()}"


@pytest.mark.parametrize(
    ("text", "xml"),
    [
        # The slash inside the expression is no end of the name.
        ("$('x/'[:1])/n=1:", '<out><x n="1"/></out>'),
        ('a/b="x":', '<out><a b="x"/></out>'),
        ("a/b='x':", '<out><a b="x"/></out>'),
        ("a: |-\n  $((1,\n  # so, 2)\n  3))", "<out><a>1 3</a></out>"),
    ],
)
def test_a_key_means(text: str, xml: str) -> None:
    assert out(text) == xml


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("out:\n  '': 1", "2:3 ''"),
        ("out:\n  else  if x: 1", "2:3 else  if"),
        ("out:\n  .Arm:", "2:3 .Arm"),
        ("out:\n  a: |-\n    $(\n    1 + nope)", "4:9 nope"),
        ("process: |\n  if 1:\n  y = 1\n  z = 2\nout:", "3:3 y = 1"),
        ("out:\n  include: {path: [a]}", "2:13 path"),
        ("out:\n  include: {path: a, namespace: b, namespace: c}", "2:36 namespace"),
        ("out:\n  for: {iterator: [a b, c], in: [1]}", "2:20 a b"),
        ("out:\n  for: {iterator: 'a, b c, d', in: [1]}", "2:23 b c"),
        ("out:\n  for: {iterator: i, range: }", "2:29 "),
        ("out:\n  <#text>: a$(chr(1))", "2:12 a$(chr(1))"),
        ("sdf/version=1:\nrobot: x", "2:1 robot"),
        ("functions: {A: {input: '=1', body: }}\nout:", "1:25 ="),
        ('out:\n  a: "x$(chr(1))"', '2:6 "x$(chr(1))"'),
        ("out:\n  a/b=x$(chr(1)), c=1:", "2:7 x$(chr(1))"),
        ("out:\n  if: #ab", "2:3 if"),
        ("if:\n  condition: 1\n  body:\n    a/b=1:", "4:5 a/b=1"),
        ("functions: {A: {input: 'a, a, b', body: }}\nout:", "1:28 a"),
        ("out:\n  A: 'b, $(c'", "2:10 $("),
        ("functions: {A: {input: a, body: }}\nout:\n  A: " + "1" * 4301, "3:6 " + "1" * 4301),
        ("variables: {a$('-')/global: 1}\nout:", "1:13 a$('-')"),
        ("variables: {a/: 1}\nout:", "1:13 a/"),
        ('out:\n  A: "[\\x01]"', "2:8 \\x01"),
        ("out:\n  A: '{a: 1, a'", "2:7 {"),
        ("out: !aXb c", "1:6 !aXb"),
        ("out: 'a\n  b' c", "1:6 '"),
        ("out:\n  for: {iterator: 'a,,b', in: [1]}", "2:19 'a,,b'"),
        ("out:\n  include: {path: a, namespace: [b]}", "2:33 [b]"),
        ("import: from math import 1x as y\nout:", "1:9 from math import 1x as y"),
        ("out:\n  - a: 1\n  - part:\n    name: x", "4:5 name"),
        ("functions:\n  - Make:\n    body: 1\nout:", "3:5 body"),
        ("functions:\n  - Make:\n    input: a\nout:", "3:5 input"),
        ("variables: {/local: 1}\nout:", "1:13 /local"),
        ("variables: {a/y: 1}\nout:", "1:15 y"),
        ("a:\r\n\tb: 1\r\nc: 2\r\n", "2:1 \t"),
        ("a: x\u00a0y\nb:\n\u00a0\u00a0c\nd: 1", "3:1 \u00a0"),
        ("out:\n  a: {b: 1 c: 2, d: $(f(1, 2))}", "2:13 :"),
        ("out: {a: 1, b: 2, " + "k" * 1025 + ": 2}", "1:19 " + "k" * 1024),
        ('out:\r\n  a: "b\\\r\n   $(1 + nope)"', "3:10 nope"),
        ('out:\n  a: "b\\\n   $(1 + nope)"', "3:10 nope"),
        ("out:\n  A: ',x'", "2:7 ,"),
        ('out:\n  A: "[a, \\x7f]"', "2:11 \\"),
        ("out:\n  include: {path: a, namespace: null}", "2:33 null"),
        ('out:\n  if: {condition: "1 + \'abc", body: }', "2:24 '"),
        ("out:\n  A: " + "1" * 4301 + ", 2", "2:6 " + "1" * 4301),
        ("out:\n  a: 'it''s $(1 + nope)'", "2:19 nope"),
        ("out:\n  a: | # eXtra\n    $(nope)", "3:7 nope"),
        ("out:\n  A: '{[1]: 2}'", "2:8 [1]"),
        ("out:\n  A: \"'a' b\"", "2:7 'a' b"),
        ("out: ? a", "1:6 ?"),
        ("out:\n  if: {condition: $((1) + ), body: }", "2:21 (1) +"),
        ("out:\n  for: {iterator: i, in: $((1) + 1), body: }", "2:28 (1) + 1"),
        ('out:\n  A: "1, \'x"', "2:10 '"),
        ("variables: {'  ': 1}\nout:", "1:13 '  '"),
    ],
)
def test_a_fault_is_underlined(text: str, told: str) -> None:
    assert place(fault(text)) == told


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("out:\n  else  if x: 1", "write elif x:"),
        (
            "out:\n  xacro:if value: 1",
            "xacro tags are not supported here; see docs/coming-from-xacro.md",
        ),
        ("out:\n  <a/: 1", "close the bracket: <a>:"),
        ("out:\n  - @a: 1", "write - '@a':"),
        ("out:\n  ? {a: b}\n  : c", "an expression is written $(a: b)"),
        ("out:\n  ? [a, b]\n  : c", "quote the key if it is text: '[a, b]'"),
        ("out:\n  <Xa/: 1", "close the bracket: <Xa>:"),
        (
            "out: $(from math import pi)",
            "list modules at the root of the file: import: [math]",
        ),
        ("out: $(import math)", "list modules at the root of the file: import: [math]"),
        ("out:\n  if: {condition: 1, body: 'a:b:c'}", "put a space after the colon: a: b:c"),
        (
            "out:\n  if: {condition: 1, body: 'a/b c'}",
            "write `a/b c:` with a colon for an entry without a value",
        ),
        ("out:\n  include: {paths: 1}", "did you mean `path` instead of 'paths'?"),
        ("out:\n  include: {length: 1}", "write path: other.yaml"),
        ("out:\n  for: {iterator: [[i]], in: [1]}", "iterator: i"),
        ("out:\n  for: {iterator: [], in: [1]}", "iterator: i"),
        (
            "out:\n  for: {iterator: 'a,,b', in: [1]}",
            "write iterator: i, or iterator: name, length",
        ),
        (
            "out:\n  - part:\n    name: a",
            "indent `name` and the lines below it by two more columns",
        ),
        ("out:\n  if:\n    condition: 1\n    body: a=b=c", "write a: b=c"),
        (
            "out:\n  if: {condition: 1, body: 'a == b'}",
            "write each entry as `name: value`, on a separate line",
        ),
        (
            "functions: {A: {input: [[a], b], body: }}\nout:",
            "quote a parameter whose default contains brackets: 'sizes=[1, 2]'",
        ),
        (
            "functions: {A: {input: [a: 1], body: }}\nout:",
            "write a default after an equals sign: length=1.0",
        ),
        (
            "functions: {A: {input: length 2 * 3, body: }}\nout:",
            "write a default after =: length=2 * 3",
        ),
        ("out:\n  a: $(1 || 2)", "Python writes `and`, `or` and `not`"),
        (
            "out:\n  a: $(find-pkg-share 'x')",
            "write the name of a package without quotes: $(find-pkg-share name)",
        ),
        ("import: from math\nout:", "write from math import pi, sin"),
        (
            "import: [from math import pi, sin, cos]\nout:",
            "the commas of [ ] split a list of names: write 'from math import pi, sin'",
        ),
        (
            "functions:\n  - Make:\n    body: 1\nout:",
            "indent `body` and the lines below it by two more columns",
        ),
        ("out:\n  ? a: b\n  : c", "quote the key if it is text: 'a: b'"),
        (
            "out:\n  ? {a: b,\n    c: d}\n  : c",
            "quote the key if it is text, and write it on one line",
        ),
    ],
)
def test_a_hint_says(text: str, hint: str) -> None:
    assert fault(text).hint == hint


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("out:\n  for: {iterator: 'a,,b', in: [1]}", "an iterator is a name"),
        (
            "out:\n  include: {path: a, namespace: b, namespace: c}",
            "'namespace' is given twice in this `include`",
        ),
        ("variables: {/local: 1}\nout:", "'' cannot be the name of a variable"),
        ("variables: {a/y: 1}\nout:", "'y' is not a scope of a variable"),
        ("import: from math import 1x as y\nout:", "'1x as y' is not a name to import"),
        (
            "xacro:property/name=a:",
            "'xacro:property' is a xacro element, not a section of a file",
        ),
        ('out: "\\xZ"', r"the escape '\x' has too few hexadecimal digits"),
        ('out: "\\uZ"', r"the escape '\u' has too few hexadecimal digits"),
        ('out: "\\UZ"', r"the escape '\U' has too few hexadecimal digits"),
        ('out: "\\q"', r"'\q' is not a YAML escape"),
        (
            "functions: {A: [1]}\nout:",
            "in the function A, each item of the list must be an entry such as `name: value`",
        ),
        (
            "out:\n  include: [a]",
            "in an include, each item of the list must be an entry such as `name: value`",
        ),
        ("out:\n  for: {iterator: [[i]], in: [1]}", "an iterator is a name"),
        ("out:\n  for: {iterator: [], in: [1]}", "the iterator has no name"),
        ("out:\n  for: {iterator: i, range: }", "`range` takes one to three numbers"),
        ("out:\n  .Arm:", "'.Arm' is not an XML name: it begins with '.'"),
        (
            "sdf/version=1:\nrobot: x",
            "'robot' is a second root element",
        ),
        ("variables: {' /local': 1}\nout:", "'' cannot be the name of a variable"),
        ("out:\n  a/=1: 2", "the attribute has no name"),
        (
            "robot: a\nrobot/name=b: {c: 1}",
            "'robot/name=b' is a second root element, after `robot:`",
        ),
        ("out:\n  a$(x): b: c", "a value that contains ': ' must be quoted"),
        (
            'out: "a\n  b:\n  c": d',
            "a key is not allowed at this indentation",
        ),
    ],
)
def test_a_message_says(text: str, message: str) -> None:
    assert fault(text).message == message


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("[HERE]", "a file"),
        ("variables: [HERE]\nout:", "`variables`"),
        ("functions: [HERE]\nout:", "`functions`"),
        ("functions: {Make: [HERE]}\nout:", "the function Make"),
        ("functions: {Make: {body: [HERE]}}\nout:", "the function Make"),
        ("functions: {Make: {input: '**Inner', body: {Inner: [HERE]}}}\nout:", "the block Inner"),
        ("model: [HERE]", "`model`"),
        ("out: {if: [HERE]}", "`if`"),
        ("out: {if: {condition: 1, body: [HERE]}}", "the body of `if`"),
        ("out: [if: {condition: 0}, elif: [HERE]]", "`elif`"),
        ("out: [if: {condition: 0}, else: [HERE]]", "`else`"),
        ("out: [if: {condition: 0}, else: {body: [HERE]}]", "`else`"),
        ("out: {for: [HERE]}", "`for`"),
        ("out: {for: {iterator: i, range: 1, body: [HERE]}}", "the body of `for`"),
        ("out: {include: [HERE]}", "an include"),
        ("out: {part: [HERE]}", "a part"),
        ("out: {Make: [{a: 1}, HERE]}", "a call of Make"),
    ],
)
def test_an_item_that_is_no_entry_is_told_with_what_it_stands_in(text: str, what: str) -> None:
    error = fault(text.replace("HERE", "stray"))
    expected = f"in {what}, each item of the list must be an entry such as `name: value`"
    assert (error.message, error.span.written()) == (expected, "stray")


def warned(text: str) -> list[tuple[str, str | None]]:
    """Return code and hint of each warning."""
    return [(one.code, one.hint) for one in build_text(text).warnings]


@pytest.mark.parametrize("inside", "condition body iterator range in path name joint link".split())
def test_a_misspelt_statement_is_known_by_what_is_in_it(inside: str) -> None:
    hint = "write part: for the statement, or <prat>: for the element"
    assert warned(f"out:\n  prat: {{{inside}: 1}}") == [("misspelt-statement", hint)]


@pytest.mark.parametrize("word", ["inlcude", "varables", "fuctions", "proces"])
def test_some_statements_are_known_whatever_is_in_them(word: str) -> None:
    assert [code for code, _ in warned(f"out:\n  {word}: {{x: 1}}")] == ["misspelt-statement"]


def test_an_element_like_a_statement_may_hold_anything_else() -> None:
    assert warned("out:\n  prat: {x: 1}") == []


@pytest.mark.parametrize("word", ["far", "fov", "friction", "pair", "points", "pos", "ros"])
def test_elements_of_simulators_are_not_taken_for_misspelt_statements(word: str) -> None:
    assert warned(f"out:\n  {word}: {{name: 1}}") == []


def test_a_word_of_two_letters_may_be_a_misspelt_statement() -> None:
    hint = "write for: for the statement, or <fo>: for the element"
    assert warned("out:\n  fo: {in: 1}") == [("misspelt-statement", hint)]


def test_an_import_below_the_root_is_warned_of() -> None:
    hint = "move it to the root of the file, or write <import>: for the element"
    assert warned("out:\n  import: math") == [("misspelt-statement", hint)]


@pytest.mark.parametrize(
    ("text", "inner"),
    [
        ("out:\n  a: '} ${x}'", "x"),
        ("out:\n  a: '${x} and {y}'", "x"),
        ("out:\n  a: '${x'", "…"),
        ("out:\n  $('a'):\n    b: ${x}", "x"),
    ],
)
def test_xacros_braces_are_warned_of(text: str, inner: str) -> None:
    hint = f"write $({inner}) for an expression, or $${{ for a literal ${{"
    assert warned(text) == [("xacro-syntax", hint)]


@pytest.mark.parametrize("text", ["|\n  #text: a", "? |\n  #comment: a\n: b"])
def test_a_line_of_the_first_text_is_no_comment(text: str) -> None:
    with pytest.raises(YamaroError) as caught:
        build_text(text)
    assert [one.severity for one in caught.value.diagnostics] == ["error"]


@pytest.mark.parametrize(
    "text",
    ["functions: #ab\nout:", "variables: #ab\nout:", "out:\n  if: {condition: 1}\n  else: #ab"],
)
def test_a_body_that_is_a_comment_to_yaml_is_warned_of(text: str) -> None:
    assert [code for code, _ in warned(text)] == ["hidden-value"]


def test_a_comment_at_the_start_of_a_file_is_warned_of_too() -> None:
    assert warned("#text: a\nout:") == [("comment-entry", "write <#text>: or quote the key")]


def test_a_scope_may_stand_apart_from_its_name() -> None:
    assert "<out>3</out>" in build_text("variables: {maX: 1, aX /local: 2}\nout: $(maX + aX)").xml()


@pytest.mark.parametrize(
    ("raw", "style", "indices"),
    [
        ("ab c", PLAIN, [0, 1, 2, 3]),
        ("a\n b", PLAIN, [0, 1, 3]),  # folded to a space
        ("a\r\n b", PLAIN, [0, 1, 4]),
        ("a\n\n b", PLAIN, [0, 2, 4]),
        ("a\r\n\r\nb", PLAIN, [0, 3, 5]),
        ("'a''b'", SINGLE, [1, 2, 4]),
        ('"a\\\n b"', DOUBLE, [1, 5]),  # a break behind a backslash is nothing
        ('"a\\\r\n b"', DOUBLE, [1, 6]),
        ('"a\\\rb"', DOUBLE, [1, 4]),
        ('"a\\\nb"', DOUBLE, [1, 4]),
        ('"\\x41b\\u00e9\\U0001F600c"', DOUBLE, [1, 5, 6, 12, 22]),
    ],
)
def test_characters_of_a_scalar_know_their_place(raw: str, style: str, indices: list[int]) -> None:
    assert _align_flow(raw, style) == indices


def test_an_escaped_expression_is_text_in_values_too() -> None:
    text = "variables: {a: $$(x), b: [$$(y)]}\nout: $(a + b[0])"
    assert "<out>$(x)$(y)</out>" in build_text(text).xml()


def test_expressions_on_the_command_line_are_text() -> None:
    assert (
        "<out>$(x)$(y)</out>"
        in build_text("out: $(a[0] + a[1]['k'])", "a:=[$(x), {k: $(y)}]").xml()
    )


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1" * 4300, int("1" * 4300)),
        ("0xfF", 255),
        ("0o17", 15),
        ("0xX", "0xX"),
        ("0x", "0x"),
        ("0oX", "0oX"),
        ("0o8", "0o8"),
        ("1e+", "1e+"),
        ("1-", "1-"),
        ("+", "+"),
        ("", None),
        ("~", None),
        ("null", None),
        ("Null", None),
        ("NULL", None),
        ("nULL", "nULL"),
    ],
)
def test_a_plain_scalar_is(text: str, value: object) -> None:
    typed = type_plain(text)
    assert (typed, type(typed)) == (value, type(value))
    assert is_null(text) is (value is None)


def test_an_integer_has_no_more_digits_than_python_reads() -> None:
    with pytest.raises(OverflowError):
        type_plain("1" * 4301)


@pytest.mark.parametrize(
    "text", ["1 << 100000000000", "10 ** 100000000000", "2**9_999_999", "2**9_999_999 + 2**9"]
)
def test_a_number_of_billions_of_digits_is_not_computed(text: str) -> None:
    error = fault(f"out: $({text})")
    underlined = text.partition(" + ")[0] if PYTHON_KNOWS_COLUMNS else text
    assert (error.code, error.span.written()) == ("limit-integer", underlined)


@pytest.mark.parametrize("text", ["().__class__", "open('x')"])
def test_what_safe_mode_refuses_is_underlined_and_nothing_around_it(text: str) -> None:
    loader = MemoryLoader({"/t.yaml": f"out: $(1 + {text})"})
    with pytest.raises(YamaroError) as caught:
        build("/t.yaml", loader=loader, policy=Policy("safe"))
    (error,) = caught.value.diagnostics
    is_exact = PYTHON_KNOWS_COLUMNS or text != "open('x')"  # a call is refused when it runs
    assert place(error) == (f"1:12 {text}" if is_exact else f"1:8 1 + {text}")


def limited(text: str, limits: dict[str, int]) -> list[tuple[str, str]]:
    """Return code and place of each error in a file that has to keep to limits."""
    loader = MemoryLoader({"/t.yaml": text})
    try:
        build("/t.yaml", loader=loader, policy=Policy("trusted", limits=limits))
    except YamaroError as error:
        return [(one.code, place(one)) for one in error.diagnostics]
    return []


@pytest.mark.parametrize(
    "statement",
    [
        "a/b=1: c",
        "a: $(1)",
        "$('a'): 1",
        "if: {condition: 1}",
        "for: {iterator: i, range: 1}",
        "process: x = 1",
        "variables: {a: 1}",
        "functions: {A: {}}",
        "include: a.yaml",
        "part: {name: a}",
        "A:",
    ],
)
def test_the_first_statement_of_too_many_is_underlined(statement: str) -> None:
    found = limited(f"out:\n  {statement}\n  z: 1", {"statements": 1})
    key = statement.partition(":")[0]
    assert found == [("limit-statements", f"2:3 {key}")]


@pytest.mark.parametrize(
    "line",
    [
        "$(x)-$(x)/b=1: 2",
        "a/$(x)-$(x)=1: 2",
        "a/b=$(x)-$(x), c=1: 2",
        "a/b=1, c=$(x)-$(x):",
        "a: $(x)-$(x)",
        "a/b=1: $(x)-$(x)",
        "a: {b: 1, c: $(1), d: {e: $(x)-$(x)}}",
        "a: {$('b')/c=$(x)-$(x): 1}",
        "part: {name: $(x)-$(x)}",
        "<#text>: $(x)-$(x)",
        "variables: {y: $(x)-$(x)}",
        "A: 1, $(x)-$(x)",
        "include: $(x)-$(x)",
    ],
)
def test_pieces_that_make_too_long_a_text_are_underlined(line: str) -> None:
    text = f"variables: {{x: 12345}}\nfunctions: {{A: {{input: 'a, b'}}}}\nout:\n  {line}"
    found = limited(text, {"text": 10})
    assert found == [("limit-text", f"4:{3 + line.index('$(x)-')} $(x)-$(x)")]
    assert "limit-text" not in dict(limited(text, {"text": 11}))


def test_attributes_know_where_their_values_stand() -> None:
    key = ScalarNode("a/b=, c=1, d='x y'", PLAIN, Source("a/b=, c=1, d='x y'", name="t"), 0, 18)
    attributes = parse_attributes(key, 2, 18, context=ParseContext(Reporter()))
    told = [(one.name, one.name_span.written(), one.span.written()) for one in attributes]
    assert told == [("b", "b", "b="), ("c", "c", "1"), ("d", "d", "x y")]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ("'a :=2'", "2 0"),  # a colon before the = is dropped
        ("'a: =2'", "2 0"),
        ("'[[1], 2], 3'", "[[1], 2] 3"),
        ("'[[1, 2], {x: 3}], 4'", "[[1, 2], {'x': 3}] 4"),
        ("\"a='b, c'\"", "b, c 0"),
        ("\"1, 'b, c'\"", "1 b, c"),
        ("\"['b, ]', 1], 2\"", "['b, ]', 1] 2"),
        ("it's, don't", "it's don't"),
        ('"x[0]\'s, 2"', "x[0]'s 2"),
        ('"MAX\'s, 2"', "MAX's 2"),
        ("' 1 ,  2 '", "1 2"),
        ("b=1, a=2", "2 1"),
        ("x == y", "x == y 0"),
    ],
)
def test_short_arguments_are_told_apart(arguments: str, expected: str) -> None:
    text = "functions: {A: {input: 'a, b := 0', body: {x: '$(a) $(b)'}}}\nout:\n  A: "
    assert f"<x>{expected}</x>" in build_text(text + arguments).xml()


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("a b", "'a b'"),
        ("it's", '"it\'s"'),
        ('a"b', "'a\"b'"),
        ('it\'s "b"', "'it''s \"b\"'"),
        ("it's a\\b", "'it''s a\\b'"),
        ("it's\ta", "'it''s\ta'"),
    ],
)
def test_a_text_is_quoted_in_the_quotes_that_read_best(value: str, expected: str) -> None:
    assert quoted(value) == expected


@pytest.mark.parametrize("result", ["x", "2**x"])
def test_annotations_in_a_users_function_are_values(result: str) -> None:
    text = f"process: |\n  def f(x: int): return {result}\nout: $(f.__annotations__['x'] is int)\n"
    assert "<out>true</out>" in build_text(text).xml()


def test_angle_brackets_make_an_element_where_values_are_computed_too() -> None:
    text = "robot: r\nmodel:\n  part:\n    name: a\n    link:\n      <mass>: $(1 + 1)\n"
    xml = build_text(text).xml()
    assert [line.strip() for line in xml.splitlines()[2:5]] == [
        '<link name="a_link">',
        "<mass>2</mass>",
        "</link>",
    ]


def test_an_iterator_that_is_not_seen_is_told_to_be_local() -> None:
    text = (
        "functions: {Make: {body: {for: {iterator: side, in: [1]}}}}\nout:\n  Make:\n  a: $(side)\n"
    )
    (note,) = fault(text).notes
    assert note == (
        "'side' at /t.yaml:1:43 is local to its function or block; "
        "declare it as parent, child or global to see it here"
    )
