"""The spelling of names: Python's, XML's and functions', and what is said of others."""

from __future__ import annotations

import pytest

from yamaro.syntax.names import is_dunder, is_function_name, is_identifier, name_hint
from yamaro.xml.values import bad_name_character

RULE = "names are letters, digits and _, and do not begin with a digit"


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("__name__", True),
        ("__x__", True),
        ("_x_", False),
        ("__x", False),
        ("x__", False),
        ("_x__", False),
        ("name", False),
        ("__", True),
    ],
)
def test_python_keeps_names_in_double_underscores(name: str, expected: bool) -> None:
    assert is_dunder(name) is expected
    assert is_identifier(name) is not expected


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("arm-length", f"write arm_length: {RULE}"),
        ("a_b c", f"write a_b_c: {RULE}"),
        ("2x", f"write _2x: {RULE}"),
        ("X-", f"write X_: {RULE}"),
        ("class", "write class_"),
        ("__name__", "write name"),
        ("__X__", "write X"),
        ("__X-y__", "write X_y"),
        ("-", RULE),
        ("", RULE),
    ],
)
def test_another_spelling_is_offered(name: str, hint: str) -> None:
    assert name_hint(name) == hint


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("link", None),
        ("gz:plugin", None),
        ("a-1.b_2", None),
        ("_", None),
        ("é", None),
        ("a\u00b7", None),  # a middle dot is a part, and no beginning
        ("a\u0301", None),
        ("a:\u00e9", None),
        ("", ""),
        ("a b", " "),
        ("1a", "1"),
        ("-a", "-"),
        ("\u00b7a", "\u00b7"),
        ("g:1", "1"),  # behind the prefix a name begins anew
        ("g:-x", "-"),
        ("gz:\u00b7", "\u00b7"),
        ("a:", ":"),
        (":a", ":"),
        ("a:b:c", ":"),
        ("a\u2028b", "\u2028"),
    ],
)
def test_xml_names_are_told_by_their_first_bad_character(name: str, expected: str | None) -> None:
    assert bad_name_character(name) == expected


@pytest.mark.parametrize("name", ["Arm", "legs.Arm", "a.b.Arm", "É"])
def test_a_capital_letter_makes_a_call(name: str) -> None:
    assert is_function_name(name)


@pytest.mark.parametrize(
    "name", ["arm", "", "1.Arm", "legs.arm", "a b.Arm", "Arm/x=1", "True", "None", ".Arm"]
)
def test_all_else_makes_none(name: str) -> None:
    assert not is_function_name(name)
