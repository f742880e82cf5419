"""Draws robots for the tests, and reads what was drawn."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.consumers.oracles import missing, require_module
from yamaro.commands.command_table import command_named
from yamaro.commands.main import main

SIZE = "120x90"
Image = np.ndarray[Any, Any]


def require_drawing() -> None:
    """Skip a test where nothing can be drawn; fail it in CI."""
    if command_named("picture") is None:
        pytest.skip("without picture")
    for module in ("vtkmodules", "PIL", "trimesh"):
        require_module(module)
    from yamaro.picture.stage import NoOpenGLError, make_window

    try:
        make_window()
    except NoOpenGLError as error:
        missing(str(error))


needs_drawing = pytest.mark.usefixtures("drawing")


def picture(folder: Path, content: str, *options: str, name: str = "out.png") -> Path:
    """Draw a robot whose links and joints are these, and return the file."""
    source = folder / "robot.urdf"
    source.write_text(f'<robot name="r">{content}</robot>', encoding="utf-8")
    return draw(source, folder / name, *options)


def draw(source: Path, output: Path, *options: str) -> Path:
    size = () if "--size" in options else ("--size", SIZE)
    assert main(["picture", str(source), "-o", str(output), *size, *options]) == 0
    return output


def pixels(path: Path) -> Image:
    """Return a picture as height×width×4, from 0 to 255."""
    import PIL.Image

    with PIL.Image.open(BytesIO(path.read_bytes())) as image:
        return np.asarray(image.convert("RGBA")).astype(int)


def frames(path: Path) -> list[Image]:
    """Return the pictures of a GIF, and make sure that it runs for ever."""
    import PIL.Image

    with PIL.Image.open(path) as image:
        assert image.info["loop"] == 0
        found = []
        for number in range(getattr(image, "n_frames", 1)):
            image.seek(number)
            found.append(np.asarray(image.convert("RGBA")).astype(int))
    return found


def box_of(mask: Image) -> tuple[int, int, int, int]:
    """Return left, top, right and bottom of what is true in a mask."""
    rows, columns = np.nonzero(mask)
    assert len(rows), "nothing is there"
    return columns.min(), rows.min(), columns.max() + 1, rows.max() + 1


def like(image: Image, red: int, green: int, blue: int, *, tolerance: float = 0.12) -> Image:
    """Return where a picture has a hue, in light or shade: the share of each colour in its sum."""
    color = image[..., :3] + 1.0
    share = color / color.sum(axis=2, keepdims=True)
    wanted = np.array([red, green, blue]) + 1.0
    difference = abs(share - wanted / wanted.sum()).max(axis=2)
    saturation = np.ptp(image[..., :3], axis=2)
    mask: Image = (difference < tolerance) & (image[..., 3] > 128) & (saturation > 30)
    return mask
