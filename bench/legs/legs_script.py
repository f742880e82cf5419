"""The robot of legs.yaml, printed by hand: what a plain Python script with f-strings takes."""

import sys
from math import cos, pi, sin

BODY_RADIUS = 0.3


def cylinder_inertia(m, r, length):
    ixx = m * (3 * r * r + length * length) / 12
    return f'<inertia ixx="{ixx}" ixy="0" ixz="0" iyy="{ixx}" iyz="0" izz="{m * r * r / 2}"/>'


def body(m, r, length, xyz, rpy):
    return f"""    <inertial>
      <origin xyz="{xyz}" rpy="{rpy}"/>
      <mass value="{m}"/>
      {cylinder_inertia(m, r, length)}
    </inertial>
    <collision>
      <origin xyz="{xyz}" rpy="{rpy}"/>
      <geometry>
        <cylinder radius="{r}" length="{length}"/>
      </geometry>
    </collision>
    <visual>
      <origin xyz="{xyz}" rpy="{rpy}"/>
      <geometry>
        <cylinder radius="{r}" length="{length}"/>
      </geometry>
    </visual>
  </link>
"""


def segment(name, parent, length, radius, mass, x, y, yaw, axis):
    return f"""  <joint name="{name}_joint" type="revolute">
    <parent link="{parent}_link"/>
    <child link="{name}_link"/>
    <origin xyz="{x} {y} 0" rpy="0 0 {yaw}"/>
    <axis xyz="{axis}"/>
    <limit lower="-1.5" upper="1.5" effort="10" velocity="5"/>
  </joint>
  <link name="{name}_link">
{body(mass, radius, length, f"{length / 2} 0 0", "0 1.5707963267949 0")}"""


def leg(i, angle):
    x, y = BODY_RADIUS * cos(angle), BODY_RADIUS * sin(angle)
    return (
        segment(f"coxa_{i}", "base", 0.1, 0.02, 0.1, x, y, angle, "0 0 1")
        + segment(f"femur_{i}", f"coxa_{i}", 0.2, 0.02, 0.2, 0.1, 0, 0, "0 1 0")
        + segment(f"tibia_{i}", f"femur_{i}", 0.3, 0.015, 0.15, 0.2, 0, 0, "0 1 0")
    )


def main():
    n = int(sys.argv[1])
    out = ['<?xml version="1.0"?>\n<robot name="legs">\n  <link name="base_link">\n']
    out.append(body(10, BODY_RADIUS, 0.1, "0 0 0", "0 0 0"))
    out += [leg(i, 2 * pi * i / n) for i in range(n)]
    out.append("</robot>\n")
    sys.stdout.write("".join(out))


main()
