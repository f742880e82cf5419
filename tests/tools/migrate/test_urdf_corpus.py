"""URDFs of other people come back the same, and take far fewer lines."""

from __future__ import annotations

import csv
import statistics
from pathlib import Path

import pytest

from tests.effort import tried
from tests.same_robot import is_same_robot
from yamaro.api import build
from yamaro.policy import Limits
from yamaro.tools.migrate.urdf import migrate_file

CORPUS = Path(__file__).parents[4] / "shared" / "corpus"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus"),
]


def paths() -> list[str]:
    if not CORPUS.exists():
        return []
    with open(CORPUS / "urdf.tsv", encoding="utf-8") as file:
        rows = csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
        return [row["path"] for row in rows]


@pytest.fixture(scope="module")
def sources() -> dict[str, str]:
    """Keep the source of each file that was migrated."""
    return {}


@pytest.mark.parametrize("path", tried(paths(), str, quick=20, usual=5))
def test_a_robot_comes_back_the_same(path: str, sources: dict[str, str]) -> None:
    file = CORPUS / "src" / path
    migration = migrate_file(str(file), Limits())
    sources[path] = migration.text
    assert [str(difference) for difference in migration.differences] == []
    made = build(
        "robot.yaml", text=migration.text, on_message=lambda message: None, allow=migration.allowed
    ).xml()
    assert is_same_robot(file.read_bytes(), made.encode())


def test_half_of_them_take_at_most_six_tenths_of_the_lines(sources: dict[str, str]) -> None:
    if len(sources) < 20:  # as with two processes
        pytest.skip("too few of them were migrated")
    shares = [
        source.count("\n") / len((CORPUS / "src" / path).read_bytes().splitlines())
        for path, source in sources.items()
    ]
    assert statistics.median(shares) <= 0.6
