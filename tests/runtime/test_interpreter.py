"""Statements that meet the user's own Python: values, exceptions, and code parsed late."""

from __future__ import annotations

from typing import Any

import pytest

from yamaro import YamaroError, build
from yamaro.files.loader import MemoryLoader


def compiled(text: str, **files: str) -> str:
    inner = {f"/{name}.yaml": content for name, content in files.items()}
    return build("/t.yaml", loader=MemoryLoader({"/t.yaml": text, **inner})).xml()


def body(xml: str) -> str:
    return "".join(line.strip() for line in xml.split("<out>")[1].split("</out>")[0].splitlines())


def fault(text: str, **files: str) -> Any:
    with pytest.raises(YamaroError) as caught:
        compiled(text, **files)
    return caught.value.diagnostics[-1]


HOSTILE = """
process: |
  class Hostile:
      def __str__(self): raise ValueError('no text')
      def __bool__(self): raise ValueError('no truth')
      def __iter__(self): raise ValueError('no items')
      def __hash__(self): raise ValueError('no hash')
      def __getattr__(self, name): raise ValueError('no attribute')
  class Late:
      def __iter__(self):
          yield 1
          raise ValueError('no second')
out:
"""


@pytest.mark.parametrize(
    ("statement", "place", "message"),
    [
        ("a: $(Hostile())", "Hostile()", "no text (ValueError)"),
        ("a: x$(Hostile())", "Hostile()", "no text (ValueError)"),
        ("a/b=$(Hostile()):", "Hostile()", "no text (ValueError)"),
        ("$(Hostile()):", "Hostile()", "no text (ValueError)"),
        ("print: $(Hostile())", "Hostile()", "no text (ValueError)"),
        ("if: {condition: Hostile()}", "Hostile()", "no truth (ValueError)"),
        ("for: {iterator: i, in: Hostile()}", "Hostile()", "no items (ValueError)"),
        ("for: {iterator: i, in: Late()}", "Late()", "no second (ValueError)"),
        ("variables: {a: {$(Hostile()): 1}}", "$(Hostile())", "no hash (ValueError)"),
    ],
)
def test_what_a_users_value_raises_is_shown_where_it_is_used(
    statement: str, place: str, message: str
) -> None:
    diagnostic = fault(f"{HOSTILE}  {statement}\n")
    assert diagnostic.code == "python-error"
    assert (diagnostic.span.written(), diagnostic.message) == (place, message)


@pytest.mark.parametrize("raised", ["SystemExit(2)", "GeneratorExit()", "BaseException('x')"])
def test_no_exception_of_the_input_ends_the_program(raised: str) -> None:
    diagnostic = fault(f"process: raise {raised}\nout:\n")
    assert diagnostic.code == "python-error"


def test_an_exception_without_a_text_is_told_by_its_name() -> None:
    text = "process: |\n  class Mute(Exception):\n    def __str__(self): return 1\nout: $(f())\n"
    assert fault(text.replace("f()", "[].pop()")).message == "pop from empty list (IndexError)"
    mute = text.replace("$(f())", "\n  process: raise Mute")
    assert fault(mute).message == "Mute"


def test_functions_of_process_read_names_when_they_are_called() -> None:
    text = "process: 'def f(): return x'\nvariables: {x: 1}\nout: {process: x = 2, a: $(f())}\n"
    assert body(compiled(text)) == "<a>2</a>"


def test_an_error_inside_a_function_of_process_is_shown_there() -> None:
    diagnostic = fault("process: |\n  def f(a):\n    return a / 0\nout: $(f(1))\n")
    assert diagnostic.span.location()[0] == 3
    assert diagnostic.trace is not None
    assert (diagnostic.trace.kind, diagnostic.trace.name) == ("called", "f")


MAKE = """
functions:
  Make: {input: 'a, Block=1', body: {v: '$(a) $(Block)'}}
  Wrap: {input: '**Block', body: {w: {Block: {default: }}}}
out:
"""


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("Make: {a: 1, Block: 2}", "<v>1 2</v>"),
        ("Make: {a: 1, Block: $(1 + 2)}", "<v>1 3</v>"),
        ("Make: 1, Block=$([i for i in range(2)][1])", "<v>1 1</v>"),
        ("$('Make'): {a: $(2)}", "<v>2 1</v>"),
        ("$('Make'): 4", "<v>4 1</v>"),
        ("$('Wrap'): {Block: {x: }}", "<w><x/></w>"),
        ("Wrap:", "<w><default/></w>"),
        ("Wrap: {Block: }", "<w/>"),
        ("$(''): {x: }", ""),
        ("$('a'): {b: 1}", "<a><b>1</b></a>"),
    ],
)
def test_calls_find_out_late_what_is_meant(statement: str, expected: str) -> None:
    assert body(compiled(f"{MAKE}  z: 0\n  {statement}\n")) == f"<z>0</z>{expected}"


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("$('Make'): {a: 1, b: 2}", "unknown-argument"),
        ("$('Nothing'): 1", "undefined-function"),
        ("$('if'): 1", "computed-statement"),
        ("$('a b'): 1", "bad-name"),
        ("$('a'): [{b: 1}, 2]", "mixed-list"),
        ("$('Make'): {'1x': 2}", "bad-argument"),
        ("ns.Make: 1", "undefined-function"),
        ("include: $(None)", "missing-file"),
        ("include: {path: t.yaml, namespace: $('a b')}", "bad-namespace"),
        ("<#comment>: $('--')", "bad-comment"),
        ("a: [1, 2]", "list-as-text"),
        ("variables: {$('1x'): 2}", "bad-variable-name"),
        ("for: {iterator: 'i, j', in: [[1]]}", "bad-iterator"),
        ("for: {iterator: i, in: 3}", "not-iterable"),
        ("for: {iterator: i, range: 1.5}", "bad-range"),
        ("for: {iterator: i, range: '0, 9, 0'}", "bad-range"),
        ("for: {iterator: [], range: 1}", "bad-iterator"),
        ("for: {iterator: [[i]], range: 1}", "bad-iterator"),
        ("for: {iterator: i, range: []}", "bad-range"),
        ("for: {iterator: i, range: {}}", "bad-range"),
        ("for: {iterator: i, in: }", "missing-key"),
    ],
)
def test_faults_found_late_have_their_codes(statement: str, code: str) -> None:
    assert fault(f"{MAKE}  {statement}\n").code == code


def test_namespaces_may_hold_namespaces() -> None:
    xml = compiled(
        "out: {include: {path: a.yaml, namespace: a}, a.b.Make: , x: $(a.b.n)}\n",
        a="variables: {y/parent: 1}\nmodel: {include: {path: b.yaml, namespace: c},\n"
        "  process: b = c, variables: {b/parent: $(c)}}\n",
        b="variables: {n/parent: 3}\nfunctions: {Make/parent: {body: {made: $(n)}}}\n",
    )
    assert body(xml) == "<made>3</made><x>3</x>"


def test_an_included_file_that_fails_shows_how_it_was_reached() -> None:
    diagnostic = fault("out: {include: {path: a.yaml, x: 2}}\n", a="model: {a: $(x / 0)}\n")
    assert diagnostic.span.place() == "/a.yaml:1:14"
    assert (diagnostic.trace.kind, diagnostic.trace.name) == ("included", "/a.yaml")


def test_an_attribute_without_a_value_is_left_out() -> None:
    assert body(compiled("out: {'a/b=$(None), c=$(0), $(None)=1': }\n")) == '<a c="0"/>'
