"""Has NVIDIA's SimReady validate robots that Yamaro writes in USD.

    python bench/simready.py [ROBOT ...] [--profile VERSION ...]

The validator gets an environment of its own, build/simready, with a Python from 3.10 to 3.12: it
needs OpenUSD from usd-exchange, which cannot be beside usd-core. Without names of files, the
examples are written. Beside each robot are a picture, and a JSON with what a description of a robot
does not say; up to 2.2.0, the profile wants that in the USD itself.

Each version of the profile Robot-Body has features that are required and features that are not.
The first must pass; of the others, `REASONS` says why a requirement is not met.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "build" / "simready"
PYTHON = FOLDER / "venv" / ("Scripts" if os.name == "nt" else "bin") / "python"
INTERPRETERS = ("python3.12", "python3.11", "python3.10")
VALIDATOR = ("simready-validate==2026.8.0", "simready-foundation-tier-core==2026.8.0")
NEEDS = (
    "usd-exchange==3.0.1", "usd-validation-nvidia==1.22.0", "usd-profiles-nvidia==1.22.0",
    "physx-usd-schemas", "materialx", "numpy", "pillow",
)  # fmt: skip
"""What the validator needs, in place of what it names, which has usd-core."""
EXAMPLES = (
    "arm/arm", "diff_drive/diff_drive", "drone/drone", "dual_arm_cell/dual_arm_cell", "hand/hand",
    "hexapod/hexapod", "humanoid/humanoid", "leg_robot/robot",
    "mobile_manipulator/mobile_manipulator", "pan_tilt/pan_tilt", "quadruped/quadruped",
)  # fmt: skip
PROFILES = ("2.0.0", "2.1.0", "2.2.0", "2.3.0", "3.0.0")
INSIDE = ("2.1.0", "2.2.0")
"""Versions that want all metadata in the USD: SR.003."""
METADATA = {
    "author": "Yamaro",
    "asset_license": "CC0-1.0",
    "source_file": "robot.yaml",
    "usd_date_generated": "2026-11-26",
}
"""What a description of a robot does not say."""
REASONS = {
    "NP.005": "files lie in the folders of an asset library",
    "NP.006": "files lie in the folders of an asset library",
    "RC.001": "files lie in the folders of an asset library",
    "RC.003": "the file lies in a folder of its maker and one of the robot",
    "RC.004": "files lie in the folders of an asset library",
    "RC.005": "physics is a layer of its own; Yamaro writes one file",
    "RC.006": "physics is a layer of its own; Yamaro writes one file",
    "ISA.001": "physics is a layer of its own; Yamaro writes one file",
    "RV.001": "what only PhysX reads is a payload; Yamaro writes one file for all",
    "RV.004": "what only Newton reads is a payload; Yamaro writes one file for all",
    "RV.005": "what only Newton reads is a payload; Yamaro writes one file for all",
    "RV.007": "what only MuJoCo reads is a payload; --to mjcf writes MuJoCo's own format",
    "RV.010": "what only Newton reads is a payload; Yamaro writes one file for all",
    "RV.011": "what only Newton reads is a payload; Yamaro writes one file for all",
    "NEWTON.DJ.001": "a joint that nothing drives, such as that of a caster, has no drive",
    "RB.MB.001": "the robot has one body",
    "RC.008": "a description does not say what kind of robot it is",
    "RC.009": "follows from the kind of robot",
    "SR.001": "the metadata of 2025, before SimReady_Metadata had it",
    "ROS.001": "graphs of the ROS bridge belong to a scene",
    "VM.MDL.003": "materials are UsdPreviewSurface, which all renderers show",
    "VM.PBR.001": "materials are UsdPreviewSurface, which all renderers show",
    "MUJOCO.COL.001": "--to mjcf writes MuJoCo's own format",
    "MUJOCO.DJ.001": "--to mjcf writes MuJoCo's own format",
}
"""Why a requirement of a feature that is not required is not met."""
MERGE = """
import json, sys
from pxr import Gf, Sdf
layer = Sdf.Layer.FindOrOpen(sys.argv[1])
data = layer.customLayerData
layer.customLayerData = {
    **data, "SimReady_Metadata": {**data["SimReady_Metadata"], **json.loads(sys.argv[2])}
}
layer.Save()
"""


def make_environment() -> None:
    """Make the environment of the validator, unless it is there."""
    if PYTHON.exists():
        return
    own = [sys.executable] if (3, 10) <= sys.version_info < (3, 13) else []
    found = [*(each for each in map(shutil.which, INTERPRETERS) if each), *own]
    for interpreter in found:
        command = [interpreter, "-m", "venv", str(FOLDER / "venv")]
        made = subprocess.run(command, check=False, capture_output=True)
        if made.returncode == 0:
            break
    else:
        sys.exit("simready-validate needs a Python from 3.10 to 3.12")
    pip = [str(PYTHON), "-m", "pip", "install", "--quiet"]
    subprocess.run([*pip, *NEEDS], check=True)
    subprocess.run([*pip, "--no-deps", *VALIDATOR], check=True)


def write(path: Path, folder: Path, *, is_inside: bool) -> Path:
    """Write a robot in USD with what SimReady wants beside it, and return the file."""
    name = path.stem
    home = folder / name
    usd = home / f"{name}.usda"
    picture = home / ".thumbs" / "256x256" / f"{name}.usda.png"
    drawn = FOLDER / "pictures" / f"{name}.png"  # once for all versions
    for each in (picture, drawn):
        each.parent.mkdir(parents=True, exist_ok=True)
    yamaro = [sys.executable, "-m", "yamaro"]
    subprocess.run([*yamaro, "-q", str(path), "--to", "usd", "-o", str(usd)], check=True)
    if not drawn.exists():
        command = [*yamaro, "picture", "-q", str(path), "-o", str(drawn), "--size", "256x256"]
        subprocess.run(command, check=True)
    shutil.copyfile(drawn, picture)
    metadata = json.dumps({**METADATA, "source_file": path.name})
    if is_inside:
        subprocess.run([str(PYTHON), "-c", MERGE, str(usd), metadata], check=True)
    else:
        usd.with_suffix(".json").write_text(metadata)
    return usd


def validate(files: list[Path], version: str) -> dict[str, dict[str, dict[str, object]]]:
    """Return what the validator says of each feature of each file."""
    folder = files[0].parents[1]
    listed, answer = folder / "files.txt", folder / f"{version}.json"
    listed.write_text("".join(f"{each}\n" for each in files))
    answer.unlink(missing_ok=True)
    asked = ["--asset_list", str(listed), "--profile", "Robot-Body", "--version", version]
    code = "import sys; from simready.validate._cli import main; sys.exit(main())"
    subprocess.run(
        [str(PYTHON), "-c", code, *asked, "--output", str(answer)],
        check=False,
        capture_output=True,
    )
    found = json.loads(answer.read_text())
    return {path: found[path]["features_summary"] for path in map(str, files)}


def unmet(feature: dict[str, object]) -> Iterator[str]:
    """Yield the requirements that a feature does not meet, without the names before them."""
    for key in ("failing requirements", "optional requirements"):
        for name in ast.literal_eval(str(feature.get(key, "[]"))):
            yield name.removeprefix("com.nvidia.simready.").removeprefix("com.nvidia.usd.")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="*", type=Path)
    parser.add_argument("--profile", action="append", choices=PROFILES, default=[])
    wanted = parser.parse_args()
    make_environment()
    robots = wanted.robots or [ROOT / "examples" / f"{each}.yaml" for each in EXAMPLES]
    optional: dict[str, set[str]] = defaultdict(set)
    is_failing = False
    for version in wanted.profile or PROFILES:
        folder = FOLDER / ("inside" if version in INSIDE else "beside")
        files = [write(path, folder, is_inside=version in INSIDE) for path in robots]
        for path, features in validate(files, version).items():
            required = {name: each for name, each in features.items() if each["blocking_failure"]}
            failing = [f"{name}: {', '.join(unmet(each))}" for name, each in required.items()]
            is_failing |= bool(failing)
            told = "; ".join(failing) or "required features pass"
            print(f"Robot-Body {version}  {Path(path).stem:20} {told}")
            for name, each in features.items():
                if not each["blocking_failure"]:
                    for requirement in unmet(each):
                        optional[requirement].add(name)
    print("\nNot met, of features that are not required:")
    for requirement, names in sorted(optional.items()):
        reason = REASONS.get(requirement, "?")
        print(f"  {requirement:15} {reason} ({', '.join(sorted(names))})")
    unexplained = [each for each in optional if each not in REASONS]
    return 1 if is_failing or unexplained else 0


if __name__ == "__main__":
    sys.exit(main())
