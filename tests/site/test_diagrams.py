"""The diagrams of docs/language.md are drawn from what Yamaro does now."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest

import yamaro

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "web" / "site"))
import diagrams  # noqa: E402


@pytest.mark.parametrize("name", [name for name, _ in diagrams.diagrams()])
def test_a_diagram_is_what_is_drawn_now(name: str) -> None:
    kept = (ROOT / "docs" / "pictures" / name).read_text(encoding="utf-8")
    assert dict(diagrams.diagrams())[name] == kept, "python web/site/diagrams.py docs/pictures"


def test_the_robot_of_the_frames_is_the_example_below_it() -> None:
    assert f"```yaml\n{diagrams.FRAMES}```\n" in (ROOT / "docs" / "language.md").read_text("utf-8")


@pytest.mark.parametrize(("what", "keys"), diagrams.PIVOTS)
def test_the_pivot_of_each_box_is_at_the_origin(what: str, keys: list[str]) -> None:
    words = keys[0].split()[1:]
    x, z, pitch = diagrams.pose_of(diagrams.origin_of(keys))
    c, s = math.cos(pitch), math.sin(pitch)
    rotation = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])  # about y, as in URDF
    point = np.array([x, 0, z]) + rotation @ [float(word) for word in words]
    np.testing.assert_allclose(point, 0, atol=1e-12)


def files(folder: Path, scope: str, where: str, before: str = "") -> Path:
    """Write the files of the diagram; the one called `where` prints the variable at its end."""
    for file, others in diagrams.INCLUDES.items():
        lines = [f"variables: {{side/{scope}: left}}"] * (file == diagrams.DECLARED_IN)
        lines += ["launch:" if file == "cell.yaml" else "model:", "- a:"]
        lines += ["- variables: {side: right}"] * (file == before)
        lines += [f"- include: {other}" for other in others]
        lines += ["- b: $(side)"] * (file == where)
        (folder / file).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder / "cell.yaml"


@pytest.mark.parametrize("scope", diagrams.VISIBLE)
@pytest.mark.parametrize("where", diagrams.INCLUDES)
def test_a_variable_is_seen_where_the_diagram_shows_it(
    scope: str, where: str, tmp_path: Path
) -> None:
    cell = files(tmp_path, scope, where)
    if where in diagrams.VISIBLE[scope]:
        assert "<b>left</b>" in yamaro.convert(cell)
    else:
        with pytest.raises(yamaro.YamaroError, match="undefined-name"):
            yamaro.convert(cell)


@pytest.mark.parametrize(("scope", "value"), [("global", "right"), ("bridge", "left")])
def test_a_local_of_a_caller_hides_a_global_and_is_replaced_by_a_bridge(
    scope: str, value: str, tmp_path: Path
) -> None:
    cell = files(tmp_path, scope, "robot.yaml", before="robot.yaml")
    assert f"<b>{value}</b>" in yamaro.convert(cell)
