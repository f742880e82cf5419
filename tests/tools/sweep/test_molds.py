"""Models from replaced numbers, against those that MuJoCo reads."""

from __future__ import annotations

import numpy as np
import pytest

from tests.consumers.oracles import require_module
from yamaro.tools.sweep.molds import Mold, Unfit, saved

HEAD = '<mujoco><compiler angle="degree" autolimits="true"/><worldbody><body>'
TAIL = "</body></worldbody>"
PIECES = (
    HEAD + '<inertial pos="0 0 ', "0.1", '" mass="', "2", '" fullinertia="1 1 1 ', "0.1",
    ' 0 0"/><joint name="j" axis="0 1 0" range="-', "30", ' 60" damping="', "0.5",
    '"/><geom type="capsule" fromto="0 0 0 0 0 ', "0.3", '" size="', "0.02", '" rgba="', "0.3",
    ' 0 0 1" friction="', "0.7", '"/><site euler="', "20", ' 0 0"/>' + TAIL + "<actuator>"
    '<position joint="j" kp="', "50", '" kv="', "3", '"/></actuator><keyframe><key qpos="', "0",
    '" ctrl="', "0.25", '"/></keyframe></mujoco>',
)  # fmt: skip


def test_a_model_has_the_numbers_that_are_put_in() -> None:
    mujoco = require_module("mujoco")
    mold = Mold(PIECES, {})
    chance = np.random.default_rng(3)
    for _ in range(10):
        pieces = list(PIECES)
        pieces[1::2] = [repr(float(text) * chance.uniform(0.8, 1.2)) for text in PIECES[1::2]]
        read = mujoco.MjModel.from_xml_string("".join(pieces))
        np.testing.assert_array_equal(saved(mold.model([*map(float, pieces[1::2])])), saved(read))


@pytest.mark.parametrize(
    "inner",
    [
        ('<geom size="', "0.5", '"/><joint type="hinge" group="', "1", '"/>'),  # a whole number
        ('<geom size="', "0.5", '"/><!-- ', "0.7", " -->"),  # which is nowhere in the model
    ],
)
def test_numbers_that_are_not_in_the_model_as_they_are_are_refused(inner: tuple[str, ...]) -> None:
    require_module("mujoco")
    with pytest.raises((Unfit, ValueError)):
        Mold((HEAD + inner[0], *inner[1:-1], inner[-1] + TAIL + "</mujoco>"), {})
