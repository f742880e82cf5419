"""Measures how long Yamaro takes to start, and how its time grows with the size of a robot.

Each number is the fastest of several runs of the command in a fresh process: that is what people
and launch files wait for. Where xacro is installed, it gets the same robot.
"""

from __future__ import annotations

import argparse
import importlib.util
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SMALL = """\
model:
  part: {name: base, link: {geometry: box, scale: 1 1 1, mass: 1, collision: , visual: }}
"""

# Each call makes a link with a mass, and a joint to the link before it.
YAMARO = """\
functions:
  Segment:
    input: index, length=0.1
    body:
      part:
        name: s$(index)
        joint:
          type: revolute
          parent: $('base' if index == 0 else 's' + str(index - 1))
          xyz: 0 0 $(length / 2)
          axis: 0 1 0
          limit: {{lower: -1, upper: 1, effort: 10, velocity: 2}}
        link:
          geometry: box
          scale: 0.1 0.1 $(length)
          mass: $(0.5 + length)
          collision:
          visual:
model:
  link/name=base:
  for:
    iterator: i
    range: {count}
    body:
      Segment: $(i), length=$(0.1 + i / 1000)
"""

# What xacro users write: the inertia by hand, and one call a line, for xacro has no loops.
XACRO = """\
<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="segment" params="index length">
    <joint name="s${{index}}_joint" type="revolute">
      <parent link="${{'base' if index == 0 else 's' + str(index - 1) + '_link'}}"/>
      <child link="s${{index}}_link"/>
      <origin xyz="0 0 ${{length / 2}}" rpy="0 0 0"/>
      <axis xyz="0 1 0"/>
      <limit lower="-1" upper="1" effort="10" velocity="2"/>
    </joint>
    <xacro:property name="m" value="${{0.5 + length}}"/>
    <link name="s${{index}}_link">
      <collision><geometry><box size="0.1 0.1 ${{length}}"/></geometry></collision>
      <visual><geometry><box size="0.1 0.1 ${{length}}"/></geometry></visual>
      <inertial><mass value="${{m}}"/>
        <inertia ixx="${{m / 12 * (0.01 + length * length)}}" ixy="0" ixz="0"
          iyy="${{m / 12 * (0.01 + length * length)}}" iyz="0" izz="${{m / 12 * 0.02}}"/>
      </inertial>
    </link>
  </xacro:macro>
  <link name="base"/>
{calls}
</robot>
"""


def fastest(command: list[str], runs: int) -> float:
    """Return the shortest time of a command in seconds."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        done = subprocess.run(command, capture_output=True, check=False)
        times.append(time.perf_counter() - start)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} failed:\n{done.stderr.decode()}")
    return min(times)


def main() -> None:
    """Measure, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=10, help="runs of each (default: 10)")
    parser.add_argument("--sizes", type=int, nargs="+", default=[100, 1000, 5000])
    options = parser.parse_args()

    yamaro = [os.path.join(os.path.dirname(sys.executable), "yamaro")]
    has_xacro = importlib.util.find_spec("xacro") is not None
    xacro = [sys.executable, "-c", "import xacro; xacro.main()"]
    with tempfile.TemporaryDirectory() as folder:
        small = Path(folder, "small.yaml")
        small.write_text(SMALL)
        print("start                          ms")
        for name, command in (
            ("python -c pass", [sys.executable, "-c", "pass"]),
            ("yamaro --version", [*yamaro, "--version"]),
            ("yamaro, one part", [*yamaro, str(small)]),
        ):
            print(f"{name:26} {fastest(command, options.runs) * 1000:6.1f}")
        print("\nsegments  lines of URDF    yamaro ms" + "  xacro ms" * has_xacro)
        for count in options.sizes:
            runs = max(1, options.runs * 100 // (100 + count))
            source, urdf = Path(folder, "robot.yaml"), Path(folder, "robot.urdf")
            source.write_text(YAMARO.format(count=count))
            taken = fastest([*yamaro, str(source), "-o", str(urdf)], runs)
            lines = urdf.read_text().count("\n")
            row = f"{count:8}  {lines:13}  {taken * 1000:11.1f}"
            if has_xacro:
                calls = "\n".join(
                    f'  <xacro:segment index="{i}" length="{0.1 + i / 1000}"/>'
                    for i in range(count)
                )
                other = Path(folder, "robot.xacro")
                other.write_text(XACRO.format(calls=calls))
                row += f"  {fastest([*xacro, str(other)], runs) * 1000:8.1f}"
            print(row, flush=True)


if __name__ == "__main__":
    main()
