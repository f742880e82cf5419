"""Loads the models that a sweep has kept with MuJoCo: a thousand quadrupeds out of tar files."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import mujoco
from measuring import Figure, Setting, main

import yamaro

QUADRUPED = Path(__file__).parent.parent / "examples" / "quadruped" / "quadruped.yaml"
AXES = {"thigh_length": [0.15, 0.3], "calf_length": [0.15, 0.3]}


def measure(setting: Setting) -> Iterator[Figure]:
    count = setting.sized(1000, 4)
    with tempfile.TemporaryDirectory() as folder:
        runs = os.path.join(folder, "runs")
        sweep = yamaro.sweep(QUADRUPED, runs, vary=AXES, samples=count, to="mjcf", models=True)
        lengths = sweep.columns("thigh_length")["thigh_length"]
        began = time.perf_counter()
        loaded = 0
        for kept in sweep.models():
            model = mujoco.MjModel.from_xml_string(kept.text, kept.files)
            calf = model.body("front_left_calf_link").pos[2]
            assert abs(calf + lengths[kept.index]) < 1e-12, kept.index
            loaded += 1
        seconds = time.perf_counter() - began
        assert loaded == count
        shards = Path(runs, "models").glob("*.tar")
        size = sum(shard.stat().st_size for shard in shards)
    yield Figure(f"loading {count:,} quadrupeds from tar files with MuJoCo", seconds, " s")
    yield Figure("a model in a tar file", size / count / 1e3, " kB")


if __name__ == "__main__":
    main(measure, __doc__)
