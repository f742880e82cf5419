"""The pictures of the docs show what is drawn now; scripts/pictures makes them anew."""

from pathlib import Path

import numpy as np
import pytest

from tests import tutorial
from tests.effort import tried
from tests.picture.drawing import needs_drawing, pixels
from yamaro.commands.main import main

REPOSITORY = Path(__file__).parents[2]
FOLDER = REPOSITORY / "docs" / "pictures"

TOLERANCE = 2.0
"""Mean difference of pixels, from 0 to 255: room for other versions of VTK and of its drivers."""


def listed() -> dict[str, list[str]]:
    """Return the arguments of each picture by its name."""
    lines = (FOLDER / "list.txt").read_text(encoding="utf-8").splitlines()
    rows = [line.split() for line in lines if line and not line.startswith("#")]
    return {name: arguments for name, *arguments in rows}


PICTURES = listed()
QUICK = "hexapod.png"


def reduced(image: np.ndarray, by: int = 4) -> np.ndarray:
    """Return a picture in a quarter of its size, so that edges need not agree to the pixel."""
    height, width = (side // by * by for side in image.shape[:2])
    parts = image[:height, :width].reshape(height // by, by, width // by, by, -1)
    return parts.mean(axis=(1, 3))


@needs_drawing
@pytest.mark.parametrize(
    "name",
    [QUICK, *tried([name for name in PICTURES if name != QUICK], str, quick=16, usual=3)],
)
def test_a_picture_of_the_docs_is_what_is_drawn_now(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = pixels(FOLDER / name)
    height, width = kept.shape[:2]
    monkeypatch.chdir(REPOSITORY)
    output = tmp_path / name
    tutorial.main(tmp_path)
    own = [word.replace("build/tutorial", str(tmp_path)) for word in PICTURES[name]]
    size = [] if "--size" in own else ["--size", f"{width}x{height}"]
    assert main(["picture", "-q", *own, *size, "-o", str(output)]) == 0
    drawn = pixels(output)
    difference = abs(reduced(drawn) - reduced(kept)).mean()
    assert difference < TOLERANCE, "scripts/pictures makes the pictures of the docs anew"


@needs_drawing
def test_the_comparison_sees_a_joint_that_moved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(REPOSITORY)
    options = ["--size", "560x420", "--joints", "left_front_femur_joint=0.5", "-o"]
    assert main(["picture", "-q", *PICTURES["hexapod.png"], *options, str(tmp_path / "a.png")]) == 0
    moved = reduced(pixels(tmp_path / "a.png"))
    assert abs(moved - reduced(pixels(FOLDER / "hexapod.png"))).mean() > TOLERANCE


def test_the_pictures_of_the_docs_are_those_in_the_list() -> None:
    others = {path.name for path in FOLDER.glob("editor-*.png")} | {
        "quadruped-legs.png",
        "notebook.png",
    }
    assert {path.name for path in FOLDER.glob("*.png")} - others == set(PICTURES)


def test_each_example_of_a_robot_has_a_picture() -> None:
    drawn = {arguments[0].split("/")[1] for arguments in PICTURES.values()}
    examples = {path.name for path in (REPOSITORY / "examples").glob("*") if path.is_dir()}
    assert examples - drawn == {"world"}, "an SDF world is no robot"
