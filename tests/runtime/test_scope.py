"""Contexts by themselves: what tests/properties/test_scopes.py does not reach."""

from __future__ import annotations

import pytest

from yamaro.namespace import MISSING, Namespace
from yamaro.runtime.scope import (
    BlockScope,
    Home,
    Scope,
    SharedNames,
    function_key,
)
from yamaro.source import Source


def file_scope(shared_names: SharedNames, caller: Scope | None = None) -> Scope:
    home = Home(Source("", name="t.yaml"), "/", {"print": print, "own": 1}, None)
    return Scope(home, shared_names, closure=None, caller=caller)


def call(closure: Scope, caller: Scope) -> Scope:
    return Scope(closure.home, closure.shared_names, closure=closure, caller=caller)


def test_python_finds_names_by_the_rules() -> None:
    main = file_scope(SharedNames())
    main.declare("x", 1)
    inner = call(main, main)
    assert eval("x + own", inner) == 2
    exec("x = 5\ny = x", inner)
    assert (main["x"], dict.get(inner, "y"), main.find("y")) == (5, 5, MISSING)
    with pytest.raises(KeyError):
        inner["z"]


def test_del_removes_what_is_seen() -> None:
    main = file_scope(SharedNames())
    main.declare("x", 1, "child")
    main.declare("g", 2, "global")
    inner = call(main, main)
    exec("del x, g", inner)
    assert (main.find("x"), main.find("g")) == (MISSING, MISSING)
    with pytest.raises(KeyError):
        del inner["never"]


def test_a_declaration_in_another_scope_replaces_the_first() -> None:
    main = file_scope(SharedNames())
    for kind in ("parent", "child", "global", "bridge", "local"):
        main.declare("x", kind, kind)
        assert main.find("x") == kind
    assert main.exported() == []
    assert main.kinds == {}


def test_only_what_is_given_from_outside_is_passed_in() -> None:
    shared_names = SharedNames()
    main = file_scope(shared_names)
    assert not main.is_passed_in("length")
    main.declare("length", 1, "bridge")
    main.declare("width", 2, "child")
    included = file_scope(shared_names, main)
    assert [included.is_passed_in(name) for name in ("length", "width", "height")] == [
        True,
        True,
        False,
    ]
    included.passed = frozenset(["height"])
    assert included.is_passed_in("height")


def test_an_unknown_scope_is_a_fault_of_ours() -> None:
    with pytest.raises(AssertionError):
        file_scope(SharedNames()).declare("x", 1, "everywhere")


def test_all_that_can_be_seen_is_listed_for_suggestions() -> None:
    shared_names = SharedNames()
    main = file_scope(shared_names)
    main.declare("c", 1, "child")
    main.declare("g", 1, "global")
    inner = file_scope(shared_names, caller=main)
    inner.declare("b", 1, "bridge")
    inner.declare("l", 1)
    block = BlockScope(call(inner, inner), main)
    block.host.declare("h", 1)
    assert {"c", "g", "b", "l", "own"} <= set(inner.visible_names())
    assert {"c", "g", "b", "h", "own"} <= set(block.visible_names())
    assert "l" not in set(block.visible_names())


def test_a_block_declares_in_its_call_and_names_functions_of_its_place() -> None:
    main = file_scope(SharedNames())
    host = call(main, main)
    block = BlockScope(host, main)
    block.declare("x", 1)
    block.declare(function_key("F"), None)
    host.declare(function_key("G"), None)
    assert (host.find("x"), block.find("x"), main.find("x")) == (1, 1, MISSING)
    assert host.find(function_key("F")) is MISSING
    assert block.find(function_key("F")) is None
    assert block.find(function_key("G")) is MISSING
    assert block.context is host


def test_a_namespace_is_read_by_dots() -> None:
    shared_names = SharedNames()
    space = Namespace("Legs", shared_names.find)
    space._add("index", 3)
    space._add(function_key("Build"), None)
    space._add("mass", MISSING)
    shared_names.globals["mass"] = 2.5
    assert (space.index, space.mass) == (3, 2.5)
    shared_names.globals["mass"] = 4.0
    assert space.mass == 4.0
    assert dir(space) == ["index", "mass"]
    assert repr(space) == "<namespace Legs>"
    with pytest.raises(AttributeError, match="the namespace 'Legs' has no 'none'"):
        _ = space.none
