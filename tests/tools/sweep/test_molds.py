"""Models from replaced numbers, against those that MuJoCo reads."""

from __future__ import annotations

import re

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


BOX = '<geom type="box" size=".1 .2 .3"/>'
HEAVY = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
MESH = "<asset><mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1' scale='1.1 1 1'/></asset>"
TURNED = '<body pos="0 0 1" quat="{0.9} 0 {0.43} {0.1}"><freejoint/>'
FREE = f'<body pos="0 0 1"><freejoint/>{HEAVY}'
DOCUMENTS = {
    "the quaternion of a root": f"{TURNED}{BOX}</body>",
    "that of a state": f"{TURNED}{BOX}</body>"
    '#<keyframe><key qpos="0 0 1 {0.91} 0 {0.42} {0.1}"/><key qpos="0 0 {1} 1 0 0 0"/></keyframe>',
    "those of balls": f'{TURNED}{BOX}<body quat="{{0.8}} {{0.1}} 0 0"><joint type="ball"/>'
    f'{BOX}</body></body>#<keyframe><key qpos="0 0 1 1 0 0 0 {{0.92}} 0 {{0.41}} 0"/></keyframe>',
    "ends of a capsule": f'{FREE}<geom type="capsule" size="{{.02}}"'
    ' fromto="0 {0.01} 0 {0.1} {-0.2} {0.3}"/></body>',
    "ends of a box": f'{FREE}<geom type="box" size=".02" fromto="0 0 0 {{0.1}} .2 .3"/></body>',
    "ends along z": f'{FREE}<geom type="cylinder" size=".02" fromto="0 0 0 0 0 {{-0.3}}"/></body>',
    "ends of a site": f'{FREE}<site type="capsule" size=".02" fromto="0 0 0 .1 .2 {{.3}}"/></body>',
    "where a mesh is": f'{FREE}<geom type="mesh" mesh="m" pos=".1 .2 {{.3}}"/></body>#{MESH}',
    "how a mesh is turned": f'{FREE}<geom type="mesh" mesh="m" pos=".1 .2 {{.3}}"'
    f' quat=".9 {{.1}} .2 {{.3}}"/></body>#{MESH}',
    "inertia matrices": '<body><freejoint/><inertial pos="0 0 {.1}" mass="{2}"'
    ' fullinertia="{.3} {.4} {.45} {.01} {-.02} .003"/><geom type="mesh" mesh="m"/><body>'
    '<joint/><inertial pos="0 0 0" mass="1" fullinertia="1 1 1 {.1} .1 .1"/></body></body>'
    f"#{MESH}",
}


@pytest.mark.parametrize("name", DOCUMENTS)
def test_what_the_compiler_derives_is_derived_without_it(name: str) -> None:
    mujoco = require_module("mujoco")
    body, _, rest = DOCUMENTS[name].partition("#")
    text = f"<mujoco><worldbody>{body}</worldbody>{rest}</mujoco>"
    pieces = re.split(r"\{([^{}]+)\}", text)
    given = np.array(pieces[1::2], float)
    mold = Mold(pieces, {})
    assert mold._cast is not None
    random = np.random.default_rng(3)
    for _ in range(8):
        values = (given * random.uniform(0.9, 1.1, len(given))).tolist()
        pieces[1::2] = map(repr, values)
        assert mold._cast.take(values)
        alone = mujoco.MjModel.from_xml_string("".join(pieces))
        np.testing.assert_array_equal(saved(mold._cast.model), saved(alone))
