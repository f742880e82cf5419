"""The pieces of xacro's language are read as xacro reads them: parameters, literals, texts."""

from __future__ import annotations

import contextlib
import io
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.xacro.xacro_host import MemoryHost
from yamaro.diagnostics import Reporter, YamaroError
from yamaro.source import Source
from yamaro.xacro.expansion import expand
from yamaro.xacro.statements import parse_parameters
from yamaro.xacro.templates import guess_value, is_property_name
from yamaro.xml.tree import Element

xacro: Any = pytest.importorskip("xacro")
substitution: Any = pytest.importorskip("xacro.substitution_args")


def parameters_of_xacro(text: str) -> list[tuple[str, bool, str | None]]:
    found = []
    while text:
        name, default, text = xacro.parse_macro_arg(text)
        forward, value = default or (None, None)
        found.append((name, forward is not None, value))
    return found


@settings(max_examples=examples(3000))
@given(st.text("ab :=^|'\"${}()", max_size=14).filter(lambda text: text.strip() or not text))
def test_parameters_are_read_alike(text: str) -> None:
    read = [(p.name, p.is_forwarded, p.default) for p in parse_parameters(text)]
    assert read == parameters_of_xacro(text)


@given(st.text("a:='", max_size=60))
def test_the_place_of_a_parameter_is_that_of_its_text(text: str) -> None:
    for parameter in parse_parameters(text):
        assert text[parameter.start :].startswith(parameter.name)
        if parameter.default:
            assert text[: parameter.end].endswith(parameter.default)


def test_a_long_row_of_quotes_is_read_in_no_time() -> None:
    assert len(parse_parameters("a:=" + "x" * 5000 + "'")) == 1
    assert len(parse_parameters("a:=" + "x'" * 201)) == 1


@settings(max_examples=examples(1000))
@given(st.one_of(st.text("0123456789.eE+-_ '\"truefalsTFinfa", max_size=8), st.text(max_size=4)))
def test_literals_are_guessed_alike(text: str) -> None:
    assert repr(guess_value(text)) == repr(xacro.Table._eval_literal(text))


@settings(max_examples=examples(500))
@given(st.one_of(st.text("ab_1 é.ª", max_size=4), st.sampled_from(["if", "None", "match", "a#"])))
def test_names_of_properties_are_alike(text: str) -> None:
    assert is_property_name(text) == xacro.is_valid_name(text)


def value_of_xacro(text: str) -> Any:
    xacro.substitution_args_context["arg"] = {
        "a": "1",
        "b": "$(arg a)",
        "f": "$(find p)",
        "t": "True",
    }
    symbols = xacro.Table(xacro._global_symbols)
    with contextlib.redirect_stderr(io.StringIO()):
        try:
            return str(xacro.eval_text(text, symbols))
        except Exception:
            return None


def value_of_ours(text: str) -> Any:
    quoted = text.replace("&", "&amp;").replace("<", "&lt;")
    arguments = {"a": "1", "b": "$(arg a)", "f": "$(find p)", "t": "True"}
    host = MemoryHost({}, find=lambda name: f"/share/{name}")
    try:
        root = expand(Source(f"<a><b>{quoted}</b></a>", name="t"), host, arguments, Reporter())
    except YamaroError:
        return None
    inner = root.children[0]
    assert isinstance(inner, Element)
    return inner.text()


@settings(max_examples=examples(2000))
@given(
    st.lists(
        st.sampled_from(
            ["$", "$(", "${", ")", "}", "arg ", "find ", "eval ", "optenv ", "a", "b", "f", "t",
             " ", "1", "'", "+", "(", "{", "pi", "env ", "dirname", "*2", "[0]", ".", "true"]
        ),
        max_size=9,
    ).map("".join)
)  # fmt: skip
def test_texts_are_evaluated_alike(text: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(substitution, "_eval_find", lambda name: f"/share/{name}")
        patch.setitem(substitution._eval_dict, "find", lambda name: f"/share/{name}")
        expected = value_of_xacro(text)
    if expected is None or not expected.startswith(("<built-in", "<function", "<class")):
        assert value_of_ours(text) == expected
