"""What each thing in a URDF becomes: the elements of a robot, and exactly the model they become."""

from __future__ import annotations

from textwrap import dedent

import pytest

from tests.tools.migrate.migrating import migrated, migration_of, model_of

CASES = {
    "a joint and its link are a part of their common name": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <origin xyz="0 0 1" rpy="0 0 0"/>
          <parent link="base"/>
          <child link="tip_link"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part: {name: tip, joint: {type: fixed, parent: base, xyz: 0 0 1}}
        """,
    ),
    "an attribute that URDF does not have stays in an element": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="continuous">
          <origin xyz="0 0 1" rpy="0 0 0"/>
          <parent link="base"/>
          <child link="tip_link"/>
          <dynamics damping="1" dampng="2"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part:
          name: tip
          joint:
            type: continuous
            parent: base
            xyz: 0 0 1
            <dynamics/damping=1, dampng=2>:
        """,
    ),
    "a part has both names where they have none in common": (
        """\
        <link name="base"/>
        <joint name="base_to_tip" type="fixed">
          <parent link="base"/>
          <child link="tip"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="tip"/>
        """,
        """\
        link/name=base:
        part: {name: base_to_tip tip, joint: {type: fixed, parent: base, xyz: 0 0 1}}
        """,
    ),
    "a joint far from its link moves to it": (
        """\
        <link name="base"/>
        <link name="a_link"/>
        <link name="b_link"/>
        <joint name="a_joint" type="fixed">
          <parent link="base"/>
          <child link="a_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <joint name="b_joint" type="fixed">
          <parent link="base"/>
          <child link="b_link"/>
          <origin xyz="0 0 2" rpy="0 0 0"/>
        </joint>
        """,
        """\
        - link/name=base:
        - part: {name: a, joint: {type: fixed, parent: base, xyz: 0 0 1}}
        - part: {name: b, joint: {type: fixed, parent: base, xyz: 0 0 2}}
        """,
    ),
    "a joint that stands behind its link comes behind it in the part": (
        """\
        <link name="base"/>
        <link name="tip_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </visual>
        </link>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        """,
        """\
        link/name=base:
        part:
          name: tip
          link:
            visual: {geometry: sphere, scale: 0.1}
          joint: {type: fixed, parent: base, xyz: 0 0 1}
        """,
    ),
    "links and joints keep their order if they are not in the same": (
        """\
        <link name="base"/>
        <link name="a_link"/>
        <link name="b_link"/>
        <joint name="b_joint" type="fixed">
          <parent link="base"/>
          <child link="b_link"/>
          <origin xyz="0 0 2" rpy="0 0 0"/>
        </joint>
        <joint name="a_joint" type="fixed">
          <parent link="base"/>
          <child link="a_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        """,
        """\
        link/name=base:
        joint/name=b_joint, type=fixed:
          parent/link=base:
          child/link=b_link:
          origin/xyz=0 0 2, rpy=0 0 0:
        part: {name: a, joint: {type: fixed, parent: base, xyz: 0 0 1}}
        link/name=b_link:
        """,
    ),
    "a link without a joint is a part if there is something in it": (
        """\
        <link name="base_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </visual>
        </link>
        <link name="world">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.2"/>
            </geometry>
          </visual>
        </link>
        <link name="empty_link"/>
        """,
        """\
        - part:
            name: base
            link:
              visual: {geometry: sphere, scale: 0.1}
        - part:
            link/name=world:
              visual: {geometry: sphere, scale: 0.2}
        - link/name=empty_link:
        """,
    ),
    "sections share their geometry and pose in the link": (
        """\
        <link name="base_link">
          <visual>
            <origin xyz="0 0 0.5" rpy="0 1.57 0"/>
            <geometry>
              <cylinder radius="0.1" length="1"/>
            </geometry>
          </visual>
          <collision>
            <origin xyz="0 0 0.5" rpy="0 1.57 0"/>
            <geometry>
              <cylinder length="1" radius="0.1"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            geometry: cylinder
            scale: 0.1 1
            xyz: 0 0 0.5
            rpy: 0 1.57 0
            visual:
            collision:
        """,
    ),
    "sections that share a geometry keep poses of their own": (
        """\
        <link name="base_link">
          <visual name="left">
            <origin xyz="0 1 0" rpy="0 0 0"/>
            <geometry>
              <box size="1 2 3"/>
            </geometry>
          </visual>
          <visual name="right">
            <origin xyz="0 -1 0" rpy="0 0 0"/>
            <geometry>
              <box size="1 2 3"/>
            </geometry>
          </visual>
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <box size="1 4 3"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            geometry: box
            scale: 1 2 3
            visual/name=left: {xyz: 0 1 0}
            visual/name=right: {xyz: 0 -1 0}
            collision: {geometry: box, scale: 1 4 3}
        """,
    ),
    "the inertia of the shape is left to be computed": (
        """\
        <link name="base_link">
          <inertial>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <mass value="3"/>
            <inertia ixx="3.25" ixy="0" ixz="0" iyy="2.5" iyz="0" izz="1.25"/>
          </inertial>
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <box size="1 2 3"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            geometry: box
            scale: 1 2 3
            mass: 3
            collision:
        """,
    ),
    "any other inertia is kept": (
        """\
        <link name="base_link">
          <inertial>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <mass value="3"/>
            <inertia ixx="3.26" ixy="0" ixz="0" iyy="2.5" iyz="0" izz="1.25"/>
          </inertial>
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <box size="1 2 3"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            inertial: {mass: 3, inertia: 3.26 0 0 2.5 0 1.25}
            collision: {geometry: box, scale: 1 2 3}
        """,
    ),
    "an inertial without a shape is kept": (
        """\
        <link name="base_link">
          <inertial>
            <mass value="0.5"/>
            <inertia ixx="0.1" ixy="1e-3" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
          </inertial>
        </link>
        """,
        """\
        part:
          name: base
          link:
            inertial: {mass: 0.5, inertia: 0.1 1e-3 0 0.1 0 0.1}
        """,
    ),
    "a missing origin is not written": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/>
          <child link="tip_link"/>
        </joint>
        <link name="tip_link">
          <visual>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </visual>
        </link>
        """,
        """\
        link/name=base:
        part:
          name: tip
          joint: {type: fixed, parent: base}
          link:
            visual: {geometry: sphere, scale: 0.1}
        """,
    ),
    "sections without origins need none": (
        """\
        <link name="base_link">
          <visual>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </visual>
          <collision>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            geometry: sphere
            scale: 0.1
            visual:
            collision:
        """,
    ),
    "an origin with one attribute is a pose": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part: {name: tip, joint: {type: fixed, parent: base, xyz: 0 0 1}}
        """,
    ),
    "sections that lack different halves of a pose share it": (
        """\
        <link name="base_link">
          <visual>
            <origin xyz="0 0 0.5"/>
            <geometry>
              <box size="1 1 1"/>
            </geometry>
          </visual>
          <collision>
            <origin rpy="0 0 0" xyz="0 0 0.5"/>
            <geometry>
              <box size="1 1 1"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            geometry: box
            scale: 1 1 1
            xyz: 0 0 0.5
            visual:
            collision:
        """,
    ),
    "an origin that says nothing is not written": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part: {name: tip, joint: {type: fixed, parent: base}}
        """,
    ),
    "an origin with an attribute that URDF does not have is an element": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" frame="base"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part:
          name: tip
          joint:
            type: fixed
            parent: base
            <origin/xyz=0 0 1, frame=base>:
        """,
    ),
    "the short forms of a joint": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="revolute">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 0" rpy="0 0 1.57"/>
          <axis xyz="0 1 0"/>
          <limit lower="-1" upper="1.5" effort="10" velocity="2"/>
          <dynamics damping="0.1" friction="0.2"/>
          <safety_controller k_velocity="10"/>
          <calibration rising="0"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part:
          name: tip
          joint:
            type: revolute
            parent: base
            rpy: 0 0 1.57
            axis: 0 1 0
            limit: {lower: -1, upper: 1.5, effort: 10, velocity: 2}
            dynamics: {damping: 0.1, friction: 0.2}
            safety_controller: {k_velocity: 10}
            calibration: {rising: 0}
        """,
    ),
    "a limit to which something would be added is an element": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="revolute">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 0" rpy="0 0 0"/>
          <limit lower="-1" upper="1"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part:
          name: tip
          joint:
            type: revolute
            parent: base
            <limit/lower=-1, upper=1>:
        """,
    ),
    "a mimic and a parent are called by their part": (
        """\
        <link name="base_link"/>
        <joint name="left_joint" type="continuous">
          <parent link="base_link"/>
          <child link="left_link"/>
          <origin xyz="0 1 0" rpy="0 0 0"/>
        </joint>
        <link name="left_link"/>
        <joint name="right_joint" type="continuous">
          <parent link="left_link"/>
          <child link="right_link"/>
          <origin xyz="0 -1 0" rpy="0 0 0"/>
          <mimic joint="left_joint"/>
        </joint>
        <link name="right_link"/>
        <joint name="u_joint" type="continuous">
          <parent link="right_link"/>
          <child link="u_link"/>
          <origin xyz="0 0 0" rpy="0 0 0"/>
          <mimic joint="left_joint" offset="2"/>
        </joint>
        <link name="u_link"/>
        """,
        """\
        - link/name=base_link:
        - part: {name: left, joint: {type: continuous, parent: base_link, xyz: 0 1 0}}
        - part: {name: right, joint: {type: continuous, parent: left, xyz: 0 -1 0, mimic: left}}
        - part: {name: u, joint: {type: continuous, parent: right, mimic: {joint: left, offset: 2}}}
        """,
    ),
    "a link of the part's name is meant where it is named": (
        """\
        <link name="arm"/>
        <joint name="arm_joint" type="fixed">
          <parent link="arm"/>
          <child link="arm_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="arm_link"/>
        <joint name="tip_joint" type="fixed">
          <parent link="arm_link"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        - link/name=arm:
        - part: {name: arm, joint: {type: fixed, parent: arm, xyz: 0 0 1}}
        - part: {name: tip, joint: {type: fixed, parent: arm_link, xyz: 0 0 1}}
        """,
    ),
    "a parent that no link has is an element": (
        """\
        <joint name="tip_joint" type="fixed">
          <parent link="nowhere"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        part:
          name: tip
          joint:
            type: fixed
            <parent/link=nowhere>:
            xyz: 0 0 1
        """,
    ),
    "a material that comes twice is a variable": (
        """\
        <link name="a_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="red"><color rgba="0.8  0.1 0.1 1"/></material>
          </visual>
        </link>
        <link name="b_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="red"><color rgba="0.8  0.1 0.1 1"/></material>
          </visual>
        </link>
        """,
        """\
        variables:
          red: {name: red, color: 0.8 0.1 0.1 1}
        - part:
            name: a
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(red)}
        - part:
            name: b
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(red)}
        """,
    ),
    "a material that comes once is written where it is": (
        """\
        <link name="a_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="red"><color rgba="0.8  0.1 0.1 1"/></material>
          </visual>
        </link>
        <link name="b_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="red"></material>
          </visual>
        </link>
        """,
        """\
        - part:
            name: a
            link:
              visual: {geometry: sphere, scale: 0.1, material: {name: red, color: 0.8 0.1 0.1 1}}
        - part:
            name: b
            link:
              visual: {geometry: sphere, scale: 0.1, material: red}
        """,
    ),
    "a texture and an empty name are a variable's too": (
        """\
        <link name="a_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name=""><color rgba="0.8  0.1 0.1 1"/><texture filename="red.png"/></material>
          </visual>
        </link>
        <link name="b_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name=""><color rgba="0.8  0.1 0.1 1"/><texture filename="red.png"/></material>
          </visual>
        </link>
        """,
        """\
        variables:
          material: {name: '', color: 0.8 0.1 0.1 1, texture: red.png}
        - part:
            name: a
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(material)}
        - part:
            name: b
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(material)}
        """,
    ),
    "a name with spaces makes a material an element": (
        """\
        <link name="a_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="bright red"><color rgba="0.8  0.1 0.1 1"/></material>
          </visual>
        </link>
        """,
        """\
        part:
          name: a
          link:
            visual:
              geometry: sphere
              scale: 0.1
              <material/name=bright red>: {color/rgba=0.8 0.1 0.1 1: }
        """,
    ),
    "variables of two materials of one name have names of their own": (
        """\
        <link name="a_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="pi"><color rgba="0.8  0.1 0.1 1"/></material>
          </visual>
        </link>
        <link name="b_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="pi"><color rgba="0.8  0.1 0.1 1"/></material>
          </visual>
        </link>
        <link name="c_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="pi"><color rgba="0 0 1 1"/></material>
          </visual>
        </link>
        <link name="d_link">
          <visual>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
            <material name="pi"><color rgba="0 0 1 1"/></material>
          </visual>
        </link>
        """,
        """\
        variables:
          pi_: {name: pi, color: 0.8 0.1 0.1 1}
          pi__2: {name: pi, color: 0 0 1 1}
        - part:
            name: a
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(pi_)}
        - part:
            name: b
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(pi_)}
        - part:
            name: c
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(pi__2)}
        - part:
            name: d
            link:
              visual: {geometry: sphere, scale: 0.1, material: $(pi__2)}
        """,
    ),
    "the folder of three meshes is a variable": (
        """\
        <link name="a_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/visual/a.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="b_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/visual/b.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="c_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/c.dae"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        variables:
          meshes: package://arm/meshes
        - part:
            name: a
            link:
              collision: {geometry: $(meshes)/visual/a.stl}
        - part:
            name: b
            link:
              collision: {geometry: $(meshes)/visual/b.stl}
        - part:
            name: c
            link:
              collision: {geometry: $(meshes)/c.dae}
        """,
    ),
    "the folders of two packages are two variables": (
        """\
        <link name="arm_a_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/a.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="arm_b_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/b.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="arm_c_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/c.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="hand_a_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://hand/meshes/a.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="hand_b_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://hand/meshes/b.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="hand_c_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://hand/meshes/c.stl"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        variables:
          arm_meshes: package://arm/meshes
          hand_meshes: package://hand/meshes
        - part:
            name: arm_a
            link:
              collision: {geometry: $(arm_meshes)/a.stl}
        - part:
            name: arm_b
            link:
              collision: {geometry: $(arm_meshes)/b.stl}
        - part:
            name: arm_c
            link:
              collision: {geometry: $(arm_meshes)/c.stl}
        - part:
            name: hand_a
            link:
              collision: {geometry: $(hand_meshes)/a.stl}
        - part:
            name: hand_b
            link:
              collision: {geometry: $(hand_meshes)/b.stl}
        - part:
            name: hand_c
            link:
              collision: {geometry: $(hand_meshes)/c.stl}
        """,
    ),
    "two meshes are too few for a variable": (
        """\
        <link name="a_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/a.stl"/>
            </geometry>
          </collision>
        </link>
        <link name="b_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="package://arm/meshes/b.stl"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        - part:
            name: a
            link:
              collision: {geometry: package://arm/meshes/a.stl}
        - part:
            name: b
            link:
              collision: {geometry: package://arm/meshes/b.stl}
        """,
    ),
    "the scale of a mesh is a scale": (
        """\
        <link name="base_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="a.stl" scale="0.001 0.001 0.001"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            collision: {geometry: a.stl, scale: 1mm}
        """,
    ),
    "a mesh with an odd ending, and a shape with more, are elements": (
        """\
        <link name="base_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <mesh filename="a.blend"/>
            </geometry>
          </collision>
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="1" segments="8"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
          - collision: {<geometry>: {mesh/filename=a.blend: }}
          - collision:
              <geometry>:
                sphere/radius=1, segments=8:
        """,
    ),
    "comments stay above what they stand above": (
        """\
        <!-- the foot -->
        <link name="base">
          <!-- nothing in it -->
        </link>
        <!-- this moves -->
        <joint name="tip_joint" type="continuous">
          <!-- upwards -->
          <axis xyz="0 0 1"/>
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <!-- that is
             moved -->
        <link name="tip_link"/>
        <!-- the end -->
        """,
        """\
        # the foot
        link/name=base:
          # nothing in it
        # this moves
        # that is
        # moved
        part:
          name: tip
          joint:
            type: continuous
            parent: base
            xyz: 0 0 1
            # upwards
            axis: 0 0 1
        # the end
        """,
    ),
    "texts between elements stay": (
        """\
        <gazebo>
          one
          <static>true</static>
          two
        </gazebo>
        <plugin>  a
           b
        </plugin>
        """,
        """\
        gazebo:
        - <#text>: one
        - static: true
        - <#text>: two
        plugin: |-
          a
          b
        """,
    ),
    "tags of others are elements, those that mean something here in brackets": (
        """\
        <gazebo reference="base">
          <mu1>0.8</mu1>
          <include>a.sdf</include>
          <Kp>1</Kp>
        </gazebo>
        <ros2_control name="arm" type="system">
          <hardware>
            <plugin>mock_components/GenericSystem</plugin>
            <param name="a">true</param>
            <param name="b">$(arg b)</param>
          </hardware>
        </ros2_control>
        <print/>
        """,
        """\
        gazebo/reference=base: {mu1: 0.8, <include>: a.sdf, <Kp>: 1}
        ros2_control/name=arm, type=system:
          hardware:
            plugin: mock_components/GenericSystem
            param/name=a: true
            param/name=b: $$(arg b)
        <print>:
        """,
    ),
    "tags of others in links and joints are elements": (
        """\
        <link name="base_link">
          <self_collision_checking>
            <origin xyz="0 0 0" rpy="0 0 0"/>
          </self_collision_checking>
          <mass value="1"/>
        </link>
        <joint name="tip_joint" type="fixed">
          <parent link="base_link"/>
          <child link="tip_link"/>
          <origin xyz="0 0 0" rpy="0 0 0"/>
          <hardware>motor</hardware>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        - part:
            name: base
            link:
              self_collision_checking:
                origin/xyz=0 0 0, rpy=0 0 0:
              <mass/value=1>:
        - part: {name: tip, joint: {type: fixed, parent: base, hardware: motor}}
        """,
    ),
    "names with spaces or commas stay elements": (
        """\
        <link name="base"/>
        <joint name="to tip" type="fixed">
          <parent link="base"/>
          <child link="the tip"/>
        </joint>
        <link name="the tip"/>
        <joint name="a,b" type="fixed">
          <parent link="the tip"/>
          <child link="end"/>
        </joint>
        <link name="end"/>
        """,
        """\
        link/name=base:
        joint/name=to tip, type=fixed:
          parent/link=base:
          child/link=the tip:
        link/name=the tip:
        joint/name='a,b', type=fixed:
          parent/link=the tip:
          child/link=end:
        link/name=end:
        """,
    ),
    "further attributes of links, joints and sections are attributes": (
        """\
        <link name="base" type="foot"/>
        <joint name="tip_joint" type="fixed" id="3">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="tip_link" type="end">
          <visual name="ball">
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </visual>
        </link>
        """,
        """\
        link/name=base, type=foot:
        part:
          name: tip
          joint/id=3: {type: fixed, parent: base, xyz: 0 0 1}
          link/type=end:
            visual/name=ball: {geometry: sphere, scale: 0.1}
        """,
    ),
    "a joint without a type or child is an element": (
        """\
        <link name="base_link"/>
        <joint name="a_joint">
          <parent link="base_link"/>
          <child link="tip_link"/>
        </joint>
        <link name="tip_link"/>
        <joint name="b_joint" type="fixed">
          <parent link="base_link"/>
        </joint>
        """,
        """\
        link/name=base_link:
        joint/name=a_joint:
          parent/link=base_link:
          child/link=tip_link:
        link/name=tip_link:
        joint/name=b_joint, type=fixed: {parent/link=base_link: }
        """,
    ),
    "numbers that are none stay as they are": (
        """\
        <link name="base_link">
          <visual>
            <origin xyz="0 0" rpy="0 0 0"/>
            <geometry>
              <box size="a b c"/>
            </geometry>
          </visual>
          <inertial>
            <mass value="nan"/>
            <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
          </inertial>
        </link>
        """,
        """\
        link/name=base_link:
          visual:
            origin/xyz=0 0, rpy=0 0 0:
            geometry: {box/size=a b c: }
          inertial:
            mass/value=nan:
            inertia/ixx=1, ixy=0, ixz=0, iyy=1, iyz=0, izz=1:
        """,
    ),
    "a second inertial and sections that say nothing are elements": (
        """\
        <link name="base_link">
          <inertial>
            <mass value="1"/>
            <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
          </inertial>
          <inertial>
            <mass value="1"/>
            <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
          </inertial>
          <visual/>
        </link>
        """,
        """\
        part:
          name: base
          link:
            inertial: {mass: 1, inertia: 1 0 0 1 0 1}
            <inertial>:
              mass/value=1:
              inertia/ixx=1, ixy=0, ixz=0, iyy=1, iyz=0, izz=1:
            <visual>:
        """,
    ),
    "a link that turns out to be no part is called by its own name above": (
        """\
        <link name="tip_link"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base_link"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="base_link">
          a text
          <visual/>
        </link>
        <link name="other_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        - part: {name: tip, joint: {type: fixed, parent: base_link, xyz: 0 0 1}}
        - link/name=base_link:
            <#text>: a text
            visual:
        - part:
            name: other
            link:
              collision: {geometry: sphere, scale: 0.1}
        """,
    ),
    "an empty link without a joint is called by its own name": (
        """\
        <link name="base_link"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base_link"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base_link:
        part: {name: tip, joint: {type: fixed, parent: base_link, xyz: 0 0 1}}
        """,
    ),
    "of two joints of one child the first is in its part": (
        """\
        <link name="base"/>
        <joint name="a_joint" type="fixed">
          <parent link="base"/>
          <child link="a_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="a_link"/>
        <joint name="b_joint" type="fixed">
          <parent link="base"/>
          <child link="a_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        """,
        """\
        link/name=base:
        part: {name: a, joint: {type: fixed, parent: base, xyz: 0 0 1}}
        joint/name=b_joint, type=fixed:
          parent/link=base:
          child/link=a_link:
          origin/xyz=0 0 1, rpy=0 0 0:
        """,
    ),
}


@pytest.mark.parametrize(("urdf", "yaml"), CASES.values(), ids=CASES)
def test_elements_become(urdf: str, yaml: str) -> None:
    assert model_of(urdf) == dedent(yaml)


EXACT = {
    "where an origin is missing it stays missing": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/>
          <child link="tip_link"/>
        </joint>
        <link name="tip_link">
          <visual>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </visual>
        </link>
        """,
        """\
        link/name=base:
        part:
          name: tip
          joint: {type: fixed, parent: base, origin: none}
          link:
            visual: {geometry: sphere, scale: 0.1, origin: none}
        """,
    ),
    "sections without origins share that": (
        """\
        <link name="base_link">
          <visual>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </visual>
          <collision>
            <geometry>
              <sphere radius="0.1"/>
            </geometry>
          </collision>
        </link>
        """,
        """\
        part:
          name: base
          link:
            geometry: sphere
            scale: 0.1
            origin: none
            visual:
            collision:
        """,
    ),
    "an origin with one attribute is an element": (
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/>
          <child link="tip_link"/>
          <origin xyz="0 0 1"/>
        </joint>
        <link name="tip_link"/>
        """,
        """\
        link/name=base:
        part:
          name: tip
          joint:
            type: fixed
            parent: base
            <origin/xyz=0 0 1>:
        """,
    ),
}


@pytest.mark.parametrize(("urdf", "yaml"), EXACT.values(), ids=EXACT)
def test_where_every_letter_counts_elements_become(urdf: str, yaml: str) -> None:
    assert model_of(urdf, exact=True) == dedent(yaml)


# --- the root, and what stands around it ----------------------------------------------------------


@pytest.mark.parametrize(
    ("xml", "yaml"),
    [
        ('<robot name="my arm"/>', "robot: my arm\nmodel:\n"),
        ('<robot name=""/>', "robot/name=:\n"),
        (
            '<robot name="arm" version="1.1"><link name="base"/></robot>',
            "robot/name=arm, version=1.1:\n  link/name=base:\n",
        ),
        ('<robot name="1.0"/>', "robot: 1.0\nmodel:\n"),
        ('<robot name="$(arg x)"/>', "robot: $$(arg x)\nmodel:\n"),
        (
            '<sdf version="1.7"><model name="a"><link name="b"/></model></sdf>',
            "<sdf/version=1.7>: {model/name=a: {link/name=b: }}\n",
        ),
        (
            '<launch><node pkg="a"><param name="p" value="$(arg p)"/></node></launch>',
            "<launch>:\n  node/pkg=a:\n    param/name=p, value=$$(arg p):\n",
        ),
        ("<launch>a text</launch>", "<launch>: a text\n"),
    ],
)
def test_a_root_becomes(xml: str, yaml: str) -> None:
    assert migrated(xml) == yaml


def test_a_robot_without_a_name_stays_without_one() -> None:
    migration = migration_of('<robot><link name="base_link"/></robot>')
    assert migration.text == "<robot>:\n  link/name=base_link:\n"
    assert migration.differences == []


def test_comments_around_the_root_stay_but_for_those_of_xacro() -> None:
    xml = (
        "<!-- ==== -->\n"
        "<!-- |    This document was autogenerated by xacro from arm.xacro    | -->\n"
        "<!-- |    EDITING THIS FILE BY HAND IS NOT RECOMMENDED    | -->\n"
        "<!-- ==== -->\n"
        "<!-- Copyright: us -->\n"
        '<robot name="arm"/>\n'
        "<!-- the end -->\n"
    )
    assert migrated(xml) == "# Copyright: us\nrobot: arm\nmodel:\n# the end\n"


def test_a_comment_in_a_geometry_does_not_keep_it_from_its_short_form() -> None:
    urdf = (
        '<robot name="r"><link name="base_link"><visual><origin xyz="0 0 1" rpy="0 0 0"/>'
        '<geometry><!-- smooth --><box size="1 1 1"/></geometry></visual></link></robot>'
    )
    assert migrated(urdf) == (
        "robot: r\nmodel:\n  part:\n    name: base\n    link:\n"
        "      # smooth\n      visual: {geometry: box, scale: 1 1 1, xyz: 0 0 1}\n"
    )


def test_comments_in_joints_and_sections_stand_above_what_they_stood_above() -> None:
    assert model_of("""
        <link name="base"/>
        <joint name="arm_joint" type="fixed">
          <!-- what it hangs on -->
          <parent link="base"/>
          <child link="arm_link"/>
          <!-- where -->
          <origin xyz="0 0 1" rpy="0 0 0"/>
        </joint>
        <link name="arm_link">
          <inertial>
            <!-- weighed -->
            <mass value="2"/>
            <!-- from the drawing -->
            <origin xyz="0 0 0.1" rpy="0 0 0"/>
            <!-- guessed -->
            <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
            <!-- the end -->
          </inertial>
          <visual>
            <!-- as seen -->
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <!-- a ball -->
            <geometry><sphere radius="1"/></geometry>
          </visual>
        </link>
    """) == dedent("""\
        link/name=base:
        part:
          name: arm
          joint:
            type: fixed
            # what it hangs on
            parent: base
            # where
            xyz: 0 0 1
          link:
            inertial:
              # weighed
              mass: 2
              # from the drawing
              xyz: 0 0 0.1
              # guessed
              inertia: 1 0 0 1 0 1
              # the end
            # as seen
            # a ball
            visual: {geometry: sphere, scale: 1}
    """)


def test_a_tiny_inertia_that_is_not_the_solids_is_kept() -> None:
    body = """\
    <link name="tip">
      <inertial>
        <origin xyz="0 0 0" rpy="0 0 0"/>
        <mass value="1e-12"/>
        <inertia ixx="1e-12" ixy="0" ixz="0" iyy="1e-12" iyz="0" izz="1e-12"/>
      </inertial>
      <collision>
        <origin xyz="0 0 0" rpy="0 0 0"/>
        <geometry><sphere radius="0.013"/></geometry>
      </collision>
    </link>
    """
    assert "inertia: 1e-12 0 0 1e-12 0 1e-12" in model_of(body)


def test_elements_named_like_newer_words_are_in_brackets() -> None:
    text = model_of("""
        <link name="base_link">
          <collision>
            <geometry><box size="1 1 1"/></geometry>
            <surface><friction><ode><mu>0.8</mu></ode></friction></surface>
          </collision>
          <sensor name="eye"/>
          <frame name="tool"/>
        </link>
        <joint name="arm_joint" type="fixed">
          <parent link="base_link"/>
          <child link="arm_link"/>
          <actuator name="motor"/>
          <rising>1</rising>
        </joint>
        <link name="arm_link"/>
        <loop><joint name="arm_joint"/></loop>
        <mjcf><option timestep="0.001"/></mjcf>
    """)
    for name in ("surface", "sensor/name=eye", "frame/name=tool", "actuator/name=motor", "loop"):
        assert f"<{name}>:" in text
    assert "<mjcf>:" in text
    assert "<rising>:" in text
