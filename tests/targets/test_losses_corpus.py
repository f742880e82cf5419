"""What is missing in an output is reported, for real robots: the rest is in bench/losses.py."""

from __future__ import annotations

from pathlib import Path

import pytest
from bench.features import urdf
from bench.losses import MESHES, built, compare, robots

CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
pytestmark = pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")
SOME = list(robots(CORPUS))[::16] if CORPUS.exists() else []


@pytest.mark.parametrize("format", ["sdf", "mjcf"])
@pytest.mark.parametrize("path", SOME, ids=lambda path: path.name)
def test_each_loss_is_reported_and_nothing_else(path: Path, format: str) -> None:
    text = path.read_bytes().decode().removeprefix("\ufeff")
    build = built(path, format)
    if isinstance(build, str) or urdf.is_xacro(text):
        pytest.skip("is not written")
    verdict = compare(text, build, format, has_meshes=MESHES[format] != "none")
    assert [str(feature) for feature in verdict.silent] == []
    assert verdict.invented == []
    assert verdict.kept
