"""Keyframes as states, and sensors as the words of the model have them.

MJCF has them whole in blocks beside that, so the notes say which format they come from.
"""

from __future__ import annotations

from ...model import making
from ...model.making import Place
from ...xml.tree import SAID, Element
from .blocks import NAME
from .compiler import number, numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from .building import Builder
    from .tree import Thing

QPOS = {"free": 7, "ball": 4, "hinge": 1, "slide": 1}
"""How many numbers a joint has in `qpos`."""
ROUNDING = 1e-9
"""How far a keyframe may be outside of a limit, in radians or metres."""
IMU = {"accelerometer": "linear_acceleration", "gyro": "angular_velocity"}
WRENCH = ("force", "torque")
ALONE = {"touch": "contact", "magnetometer": "magnetometer"}
"""The sensors that alone are one of the model."""


def add_state(builder: Builder, key: Thing, element: Element) -> None:
    """Note the positions of joints in a keyframe, as far as limits allow them.

    Args:
        builder: the robot.
        key: the keyframe.
        element: what is kept of it.
    """
    from .building import type_of

    row = numbers(key.given, "qpos", 0, 1 << 20)
    if row is None or not key.name:
        return
    place = Place(key.span, {"name": key.name_span})
    spot = key.given["qpos"][1]
    children: list[Element] = []
    address = 0
    limits = builder.limits
    for body in builder.world.iter():
        for joint in body.joints:
            kind = type_of(joint)
            if kind in ("hinge", "slide") and address < len(row):
                name, value = builder.joint_names[id(joint)], row[address]
                lower, upper = limits.get(name, (value, value))
                if lower - ROUNDING <= value <= upper + ROUNDING and name not in builder.mimics:
                    at = Place(key.span, {"value": spot, "joint": key.name_span})
                    children.append(
                        making.note("joint", at, {"joint": name, "value": f"{value!r}"})
                    )
            address += QPOS[kind]
    if address != len(row) or not children:
        return
    builder.rest.append(making.note("state", place, {"name": key.name}, children))
    if len(children) == address and not key.given.keys() - {"qpos"}:
        element.body = SAID


def add_sensors(builder: Builder, things: Mapping[int, tuple[Thing, Element]]) -> None:
    """Note the sensors that the model has.

    Args:
        builder: the robot.
        things: the sensors, each with what is kept of it.
    """
    at_sites: dict[str, dict[str, tuple[Thing, Element]]] = {}
    for thing, element in things.values():
        site = thing.text("site")
        if site in builder.sites and thing.kind in (*IMU, *WRENCH, *ALONE):
            at_sites.setdefault(site, {}).setdefault(thing.kind, (thing, element))
    for site, found in at_sites.items():
        link, frame = builder.sites[site]
        if IMU.keys() <= found.keys():
            parts = [found[kind] for kind in IMU]
            noise = {IMU[t.kind]: number(t.given, "noise", 0.0) for t, _ in parts}
            values: dict[str, str | float] = {"type": "imu", "link": link, "frame": frame}
            same = noise["angular_velocity"]
            if same == noise["linear_acceleration"]:
                values |= {"noise": same} if same else {}
            else:
                values["noises"] = " ".join(f"{name} {value!r}" for name, value in noise.items())
            _add(builder, site, parts, values)
        joint = builder.above.get(link)
        if all(kind in found for kind in WRENCH) and joint is not None:
            parts = [found[kind] for kind in WRENCH]
            _add(builder, site, parts, {"type": "force_torque", "joint": joint})
        for kind, word in ALONE.items():
            if kind in found:
                values = {"type": word, "link": link, "frame": frame}
                _add(builder, found[kind][0].name or site, [found[kind]], values)


def _add(
    builder: Builder,
    wanted: str,
    parts: list[tuple[Thing, Element]],
    values: Mapping[str, str | float],
) -> None:
    thing = parts[0][0]
    name = builder.fresh("sensor", wanted)
    place = Place(thing.span, {"name": thing.name_span})
    whole: dict[str, str | float] = {"name": name, **values, "of": NAME}
    builder.rest.append(making.note("sensor", place, whole))
    for _, element in parts:
        element.body = SAID
