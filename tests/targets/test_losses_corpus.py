"""What is missing in an output is reported, for real robots: the rest is in bench/losses.py."""

from __future__ import annotations

from pathlib import Path

import pytest
from bench.features import urdf
from bench.losses import built, compare, text_of
from bench.verdicts import robots

from tests.consumers import oracles

CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
pytestmark = pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")
SOME = list(robots(CORPUS))[::16] if CORPUS.exists() else []


def _require(format: str) -> None:
    if format == "usd":
        oracles.require_module("pxr")


@pytest.mark.parametrize("format", ["sdf", "mjcf", "usd"])
@pytest.mark.parametrize("path", SOME, ids=lambda path: path.name)
def test_each_loss_is_reported_and_nothing_else(path: Path, format: str) -> None:
    _require(format)
    build, features = built(path, format)
    if isinstance(build, str) or urdf.is_xacro(text_of(path)):
        pytest.skip("is not written")
    verdict = compare(features, build, format)
    assert [str(feature) for feature in verdict.silent] == []
    assert verdict.invented == []
    assert verdict.added == []
    assert verdict.kept


@pytest.mark.parametrize("format", ["sdf", "mjcf", "usd"])
def test_what_is_missing_and_not_reported_is_found(format: str) -> None:
    _require(format)
    path = next(path for path in robots(CORPUS) if path.name == "hsrb4s.urdf")
    build, features = built(path, format)
    assert not isinstance(build, str)
    told = compare(features, build, format).told
    assert told
    build.losses = []
    assert len(compare(features, build, format).silent) == told
