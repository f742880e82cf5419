"""Where an expression ends is decided as Python's own tokenizer does."""

from __future__ import annotations

import io
import tokenize

from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.effort import examples
from yamaro.yaml.brackets import find_close

CLOSING = {")": "(", "]": "[", "}": "{"}


def close_by_the_tokenizer(text: str) -> int | None:
    """Return where Python sees the parenthesis before `text` closed; -1 if never or wrongly.

    None: the tokenizer gives up before, so that Python has no opinion.
    """
    written = f"({text}"
    starts = [0]
    for line in written.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    stack: list[str] = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(written).readline):
            if token.type == tokenize.ERRORTOKEN and token.string.strip():
                return None
            if token.type != tokenize.OP or token.string not in "([{)]}":
                continue
            if token.string in "([{":
                stack.append(token.string)
                continue
            if stack.pop() != CLOSING[token.string]:
                return -1
            if not stack:
                return starts[token.start[0] - 1] + token.start[1] - 1
    except (tokenize.TokenError, SyntaxError):
        return None
    return -1


pieces = st.sampled_from(
    ["(", ")", ")", "[", "]", "{", "}", "x", " ", ", ", "1", "'a'", '"b"', "')'", '"("', "''", '""',
     "'''", '"""', "'it\\'s)'", "r'\\)'", "b'('", "# )\n", "#", "\n", "\\\n", "'", '"', "\\", "$(",
     "lambda: 0", "é", "'''\n)'''", '"""\\""")"""', "f'{x}('"]
)  # fmt: skip


@settings(max_examples=examples(1500))
@given(st.lists(pieces, max_size=10).map("".join))
@example("x)")
@example("')')")
@example('"\\")")')
@example("'''a'b''')")
@example("# )\n)")
@example("[)")
@example("x")
def test_an_expression_ends_where_python_says(text: str) -> None:
    expected = close_by_the_tokenizer(text)
    if expected is not None:
        assert find_close(text, 0) == expected


@given(st.lists(pieces, max_size=10).map("".join))
def test_what_is_found_is_a_closing_parenthesis(text: str) -> None:
    at = find_close(text, 0)
    assert at == -1 or text[at] == ")"


def test_the_tokenizer_has_an_opinion_on_most_texts() -> None:
    assert close_by_the_tokenizer("max(1, ')')) b") == 11
    assert close_by_the_tokenizer("(]") == -1
    assert close_by_the_tokenizer("'") is None
