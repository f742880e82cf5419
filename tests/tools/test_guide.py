"""`yamaro guide`: the page is up to date and short; its examples are run by tests/test_docs.py."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from yamaro.commands.main import main

REPOSITORY = Path(__file__).parents[2]


def test_the_page_follows_from_the_cheat_sheet(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(REPOSITORY / "scripts"))
    written = runpy.run_path(str(REPOSITORY / "scripts" / "guide.py"))["written"]()
    assert main(["guide"]) == 0
    assert capsys.readouterr().out == written, "run python scripts/guide.py"


def test_the_page_is_short(capsys: pytest.CaptureFixture[str]) -> None:
    """bench/guide_tokens.py counts 2.9 characters a token: these are fewer than 6,000 tokens."""
    main(["guide"])
    assert len(capsys.readouterr().out) < 17_000


def test_a_word_after_it_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["guide", "robot.yaml"]) == 2
    assert "unexpected argument 'robot.yaml' after 'guide'" in capsys.readouterr().err
