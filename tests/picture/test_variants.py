"""Variants of a sweep that stand out are drawn beside its plot."""

from __future__ import annotations

from pathlib import Path

import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.picture.drawing import needs_drawing, pixels
from tests.tools_there import needs
from yamaro.commands.main import main
from yamaro.policy import Policy


@needs("sweep")
@needs_drawing
def test_the_variants_that_stand_out_are_drawn_to_scale(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    numpy = require_module("numpy")
    monkeypatch.chdir(tmp_path)
    Path("pole.yaml").write_text(
        "robot: pole\narguments: {length: {default: 1, range: [0.5, 2]}}\nmodel:\n"
        "- part: {name: a, link: {geometry: box, size: 0.1 0.1 $(length), mass: $(length),\n"
        "    visual: , collision: }}\n"
    )
    yamaro.sweep("pole.yaml", "runs", vary={"length": {"choices": [0.5, 1.0, 2.0]}}, method="grid",
                 metrics="mass", engine="local:1")  # fmt: skip
    from yamaro.tools.sweep.plot import pictures

    images = pictures("runs", {"short": 0, "long": 2}, Policy())
    heights = {
        name: numpy.ptp(
            numpy.nonzero((image[..., :3] < 200).any(axis=2) & (image[..., 3] > 250))[0]
        )
        for name, image in images.items()
    }
    assert heights["long"] > 2.5 * heights["short"]
    assert main(["sweep", "plot", "runs", "-o", "plot.png", "--metric", "mass", "-q"]) == 0
    assert pixels(Path("plot.png")).shape[0] > 400
