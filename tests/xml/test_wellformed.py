"""Documents that come from a jail: those that Yamaro writes are accepted, all others refused."""

from __future__ import annotations

import pytest

from yamaro.policy import Limits
from yamaro.xml.wellformed import NotWellFormed, check_document

BEGINNING = '<?xml version="1.0"?>\n'


@pytest.mark.parametrize(
    "text",
    ["<é🤖>p</é🤖>", "<a 🤖='1' ĳ='2'/>", "<一🤖>丁</一🤖>", "<a>🤖</a>"],
)
def test_names_may_have_letters_of_the_fifth_edition(text):
    check_document(BEGINNING + text, Limits())


@pytest.mark.parametrize(
    "text",
    ["<é🤖>p</🤖é>", "<a 🤖='1' 🤖='2'/>", "<🤖", "<a>🤖</b>", "<\u0300a/>", "<丁>一</一>"],
)
def test_what_is_not_well_formed_is_refused_whatever_its_letters(text):
    with pytest.raises(NotWellFormed):
        check_document(BEGINNING + text, Limits())
