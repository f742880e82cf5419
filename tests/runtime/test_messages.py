"""What `print` and `process` print is passed on in whole lines, as Python would print it."""

from __future__ import annotations

import io

import pytest

from yamaro.diagnostics import InputFault
from yamaro.policy import Limits
from yamaro.runtime.interpreter import Messages


def messages(**limits: int) -> tuple[Messages, list[str]]:
    told: list[str] = []
    return Messages(told.append, Limits(**limits)), told


def test_lines_are_passed_on_when_they_are_complete() -> None:
    own, told = messages()
    own.say("a")
    assert told == []
    own.say("b\nc\nd")
    assert told == ["ab\nc"]
    own.say("\n")
    assert told == ["ab\nc", "d"]


def test_a_last_line_without_an_end_is_passed_on_once() -> None:
    own, told = messages()
    own.say("a\nb")
    own.close()
    own.close()
    assert told == ["a", "b"]
    own.say("c\n")
    assert told == ["a", "b", "c"]


def test_so_much_may_be_printed_and_no_more() -> None:
    own, told = messages(printed=6)
    own.say("ab\n")
    own.say("cd\n")
    with pytest.raises(InputFault) as caught:
        own.say("e")
    assert told == ["ab", "cd"]
    assert caught.value.code == "limit-printed"
    assert caught.value.message == "more than 6 characters are printed, which is the limit"
    assert caught.value.hint is not None and "--limit printed=" in caught.value.hint


def test_values_are_printed_as_python_prints_them() -> None:
    own, told = messages()
    own.print("a", 1, [None, "b"])
    own.print("a", 1, sep=None, end=None)
    own.print("a", 1, sep="-", end="!\n")
    own.print()
    own.print("a", end="")
    own.print("b")
    assert told == ["a 1 [None, 'b']", "a 1", "a-1!", "", "ab"]


def test_what_is_printed_to_a_file_goes_there() -> None:
    class File(io.StringIO):
        flushed = 0

        def flush(self) -> None:
            self.flushed += 1

    own, told = messages()
    file = File()
    own.print("a", 1, file=file)
    assert (file.getvalue(), file.flushed) == ("a 1\n", 0)
    own.print("b", 2, sep="-", end="!", file=file, flush=True)
    assert (file.getvalue(), file.flushed) == ("a 1\nb-2!", 1)
    assert told == []
