"""What is suggested for a misspelt word is what Python's difflib finds."""

from __future__ import annotations

from difflib import get_close_matches

from hypothesis import given
from hypothesis import strategies as st

from yamaro.diagnostics import suggest

WORDS = st.text(alphabet="abcde", min_size=1, max_size=14)


@given(WORDS.filter(lambda word: len(word) > 1), st.lists(WORDS, max_size=8))
def test_the_nearest_word_is_the_one_that_difflib_finds(word: str, others: list[str]) -> None:
    names = sorted(set(others) - {word})
    near = get_close_matches(word, names, n=1, cutoff=0.7 if len(word) > 3 else 0.6)
    assert suggest(word, others) == (near[0] if near else None)
