"""FlexiDict is a list of pairs that can be asked by key."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from yamaro import FlexiDict

PAIRS = st.lists(st.tuples(st.sampled_from("abc"), st.integers()))


@given(PAIRS)
def test_iterating_gives_the_pairs(pairs: list[tuple[str, int]]) -> None:
    flexi = FlexiDict(pairs)
    assert list(flexi) == pairs
    assert len(flexi) == len(pairs)
    assert [flexi[i] for i in range(len(flexi))] == pairs


@given(PAIRS)
def test_a_key_gives_all_its_values_in_order(pairs: list[tuple[str, int]]) -> None:
    flexi = FlexiDict(pairs)
    for key in "abc":
        values = [value for own, value in pairs if own == key]
        assert (key in flexi) == bool(values)
        if values:
            assert flexi[key] == values
        else:
            with pytest.raises(KeyError):
                flexi[key]


@given(PAIRS)
def test_keys_come_once_in_the_order_of_their_first_pair(pairs: list[tuple[str, int]]) -> None:
    keys = FlexiDict(pairs).keys()
    assert len(keys) == len(set(keys))
    assert set(keys) == {key for key, _ in pairs}
    firsts = [next(i for i, pair in enumerate(pairs) if pair[0] == key) for key in keys]
    assert firsts == sorted(firsts)


@given(PAIRS, PAIRS)
def test_adding_pairs_one_by_one_is_making_it_of_all(
    first: list[tuple[str, int]], second: list[tuple[str, int]]
) -> None:
    flexi = FlexiDict(first)
    for key, value in second:
        flexi.add(key, value)
    assert flexi == FlexiDict(first + second)
    assert repr(flexi) == f"FlexiDict({first + second!r})"


@given(PAIRS, PAIRS)
def test_two_are_equal_when_their_pairs_are(
    first: list[tuple[str, int]], second: list[tuple[str, int]]
) -> None:
    assert (FlexiDict(first) == FlexiDict(second)) == (first == second)
    assert FlexiDict(first) != first


def test_an_index_beyond_the_end_is_an_index_error() -> None:
    with pytest.raises(IndexError):
        FlexiDict([("a", 1)])[1]


def test_it_changes_and_so_cannot_be_hashed() -> None:
    with pytest.raises(TypeError):
        hash(FlexiDict())
