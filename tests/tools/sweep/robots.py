"""Robots and variants for the tests of metrics."""

from __future__ import annotations

from math import pi
from pathlib import Path

import yamaro
from yamaro.tools.sweep.builder import Variant

EXAMPLES = Path(__file__).parents[3] / "examples"
TURN = (-pi, pi)


def joint(
    name: str, child: str, *, xyz="0 0 0", axis="0 0 1", limits=TURN, rest="", kind="revolute"
):
    parent = name.split("_")[0]
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}"/><axis xyz="{axis}"/>{rest}'
        f'<limit lower="{limits[0]}" upper="{limits[1]}" effort="1" velocity="1"/></joint>'
        f'<link name="{child}"/>'
    )


def robot_of(*joints: str) -> yamaro.Robot:
    return yamaro.Robot.from_xml(f'<robot name="r"><link name="base"/>{"".join(joints)}</robot>')


def elbow_arm(upper=0.5, lower=0.3, *, yaw=TURN, shoulder=TURN, elbow=TURN) -> yamaro.Robot:
    """Return an arm that turns about z, and bends in a vertical plane at shoulder and elbow."""
    return robot_of(
        joint("base_yaw", "yaw", limits=yaw),
        joint("yaw_shoulder", "upper", axis="0 1 0", limits=shoulder),
        joint("upper_elbow", "lower", xyz=f"{upper} 0 0", axis="0 1 0", limits=elbow),
        joint("lower_end", "tip", xyz=f"{lower} 0 0", kind="fixed"),
    )


def variant_of(path: str | Path, arguments=None, *, targets=("mjcf",), index=0) -> Variant:
    path = EXAMPLES / path
    build = yamaro.build(path, variables=arguments, target=list(targets), on_message=lambda _: None)
    return Variant(index, arguments or {}, build, str(path.parent))
