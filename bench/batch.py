"""Writes variants of the quadruped as a batch, compares it with each compiled alone, and loads it.

    [WARP=PYTHON] [MJX=PYTHON] [NEWTON=PYTHON] python bench/batch.py [--samples 4096]

The time is that of `yamaro sweep --batch` with two processes, from its start to its end. Of some
variants, MuJoCo compiles the MJCF alone, and the greatest difference of any field is shown. WARP,
MJX and NEWTON are Pythons with `mujoco_warp`, `mujoco-mjx` and `newton[sim]`: the loaders of
docs/sweeps.md are run there on the processor with a few of the variants, and positions after some
steps from `home` are compared with those of MuJoCo, which computes in doubles where they have
floats.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

import yamaro

ROOT = Path(__file__).parents[1]
ROBOT = ROOT / "examples" / "quadruped" / "quadruped.yaml"
AXES = {"thigh_length": "0.15..0.3", "calf_length": "0.15..0.3"}
STEPS = 20
ENDS = {
    "MuJoCo Warp": """
data.qpos.assign(batch["key_qpos"][:, 0])
data.ctrl.assign(batch["key_ctrl"][:, 0])
for _ in range({steps}):
    mjw.step(model, data)
np.save("found.npy", data.qpos.numpy())
""",
    "Newton": """
import mujoco_warp as mjw
model, data = solver.mjw_model, solver.mjw_data
data.qpos.assign(batch["key_qpos"][:, 0])
data.ctrl.assign(batch["key_ctrl"][:, 0])
for _ in range({steps}):
    mjw.step(model, data)
np.save("found.npy", data.qpos.numpy())
""",
    "MJX": """
home, ctrl = (jax.numpy.array(batch[name][:, 0]) for name in ("key_qpos", "key_ctrl"))
data = data.replace(qpos=home, ctrl=ctrl)
for _ in range({steps}):
    data = step(models, data)
np.save("found.npy", np.asarray(data.qpos))
""",
}
"""What follows the loaders of the docs, by their headings."""
PYTHONS = {"MuJoCo Warp": "WARP", "MJX": "MJX", "Newton": "NEWTON"}
LOADED = 64
"""Variants that are loaded: Newton makes a model of each in Python."""


def model_of(path: Path, batch: Any, row: int) -> Any:
    """Return the model of a variant in a batch."""
    model = mujoco.MjModel.from_xml_path(str(path.with_suffix(".xml")))
    for name in batch.files:
        first, _, rest = name.partition(".")
        if rest:
            part = getattr(model, first)
            value = batch[name][row]
            setattr(part, rest, float(value) if value.ndim == 0 else value)
        elif hasattr(model, name):
            getattr(model, name)[:] = batch[name][row]
    return model


def difference(path: Path, batch: Any, row: int) -> float:
    """Return by how much any field differs from that of the variant compiled alone."""
    model = model_of(path, batch, row)
    values = {name: float(batch[f"arguments/{name}"][row]) for name in AXES}
    build = yamaro.build(ROBOT, target="mjcf", variables=values, on_message=lambda line: None)
    alone = mujoco.MjModel.from_xml_string(build.xml(), dict(build.assets))
    worst = 0.0
    for one, other in ((model, alone), (model.stat, alone.stat), (model.opt, alone.opt)):
        for name in dir(other):
            expected = getattr(other, name)
            if name[0] != "_" and isinstance(expected, (float, np.ndarray)):
                found = np.subtract(getattr(one, name), expected, dtype=float)
                worst = max(worst, float(np.abs(found).max(initial=0.0)))
    return worst


def loaded(name: str, python: str, path: Path, batch: Any) -> float:
    """Return by how much positions differ from MuJoCo's after steps with a loader of the docs."""
    page = (ROOT / "docs" / "sweeps.md").read_text(encoding="utf-8")
    code = re.search(
        rf"^### {name}\n.*?```python not-run\n(.*?)```", page, re.DOTALL | re.MULTILINE
    )
    assert code is not None, f"the page has no loader for {name}"
    text = code[1].replace("legs", path.stem) + ENDS[name].format(steps=STEPS)
    if name == "MJX":  # which does not collide boxes with cylinders
        text = text.replace(
            "one = mjx", "host.geom_contype[:] = host.geom_conaffinity[:] = 0\none = mjx"
        )
    subprocess.run([python, "-c", text], cwd=path.parent, check=True, capture_output=True)
    found = np.load(path.parent / "found.npy")
    worst = 0.0
    for row in (0, len(found) // 2, len(found) - 1):
        model = model_of(path, batch, row)
        if name == "MJX":
            model.geom_contype[:] = model.geom_conaffinity[:] = 0
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, 0)
        mujoco.mj_step(model, data, STEPS)
        worst = max(worst, float(np.abs(data.qpos - found[row]).max()))
    return worst


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=4096)
    parser.add_argument("--checked", type=int, default=64)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "batch.npz"
        words = [f"{name}={axis}" for name, axis in AXES.items()]
        options = ["--samples", str(given.samples), "--engine", "local:2", "--batch", str(path)]
        began = time.monotonic()
        subprocess.run(
            [sys.executable, "-m", "yamaro", "sweep", "-q", str(ROBOT), *words, *options],
            check=True,
        )
        print(f"{given.samples} variants: {time.monotonic() - began:.1f} s")
        batch = np.load(path)
        rows = range(0, given.samples, max(1, given.samples // given.checked))
        worst = max(difference(path, batch, row) for row in rows)
        print(f"{len(rows)} of them compiled alone: {worst:.1e}")
        few = {name: batch[name][:: max(1, given.samples // LOADED)] for name in batch.files}
        np.savez(path, **few)
        batch = np.load(path)
        for name, variable in PYTHONS.items():
            if variable in os.environ:
                found = loaded(name, os.environ[variable], path, batch)
                print(f"{name}, {STEPS} steps: {found:.1e}")


if __name__ == "__main__":
    main()
