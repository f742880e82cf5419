"""What of a robot is kept in another format: the columns of the scoreboard.

Each column is a share: how many of the things that the source has are in the result as they were.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from .facts import Array, Body, Facts, matched

POSITIONS = 5
POSE = 1e-4
"""Metres, and entries of rotations: USD has single precision."""
MASS = 1e-3
INERTIA = 1e-2
VALUE = 1e-3
SHAPE = 1e-3
"""Metres, besides one percent of the size of the body."""
NOT_A_LIMIT = 1e6
"""What files say where they mean none."""


class Share(NamedTuple):
    """How many of how many are kept, and the first that is not."""

    kept: int
    of: int
    lost: str = ""


def compared(source: Facts, result: Facts) -> dict[str, Share]:
    """Return the columns, except for what the source has none of."""
    shares = {"names": names(source, result)}
    result = matched(result, source)
    shares |= {name: judge(source, result) for name, judge in COLUMNS.items()}
    return {name: share for name, share in shares.items() if share.of}


def _share(verdicts: Iterable[tuple[str, bool]]) -> Share:
    found = list(verdicts)
    lost = [name for name, is_kept in found if not is_kept]
    return Share(len(found) - len(lost), len(found), lost[0] if lost else "")


def names(source: Facts, result: Facts) -> Share:
    """Judge whether the joints that move have their names."""
    return _share((name, name in result.joints) for name in source.joints)


def masses(source: Facts, result: Facts) -> Share:
    """Judge the masses of the bodies that have one."""
    return _share(
        (name or "base", name in result.bodies and _near(body.mass, result.bodies[name].mass, MASS))
        for name, body in source.bodies.items()
        if body.mass
    )


def inertias(source: Facts, result: Facts) -> Share:
    """Judge centers of mass and inertias, in the fixed frame at a random position."""
    positions = _positions(source, np.random.default_rng(2))
    placed, others = _placed(source, source, positions), _placed(result, source, positions)

    def is_kept(name: str, body: Body) -> bool:
        other = result.bodies.get(name)
        if other is None or name not in others or not other.mass:
            return False
        one, two = placed[name], others[name]
        center = one[:3, :3] @ body.center + one[:3, 3]
        moved = two[:3, :3] @ other.center + two[:3, 3]
        wanted = one[:3, :3] @ body.inertia @ one[:3, :3].T
        given = two[:3, :3] @ other.inertia @ two[:3, :3].T
        size = max(float(np.abs(wanted).max()), 1e-9)
        is_centered = float(np.abs(center - moved).max()) <= 10 * POSE
        return is_centered and float(np.abs(wanted - given).max()) <= INERTIA * size

    return _share(
        (name or "base", is_kept(name, body)) for name, body in source.bodies.items() if body.mass
    )


def frames(source: Facts, result: Facts) -> Share:
    """Judge the poses of links, relative to the first link, at random positions of the joints."""
    random = np.random.default_rng(1)
    off = dict.fromkeys(source.frames, 0.0)
    for name in {"world", *source.scene}:  # a format has a world of its own
        off.pop(name, None)
    for _ in range(POSITIONS):
        positions = _positions(source, random)
        wanted, given = (_relative(each, source, positions) for each in (source, result))
        for name in off:
            if name in given:
                size = max(1.0, float(np.abs(wanted[name][:3, 3]).max()))
                off[name] = max(off[name], float(np.abs(wanted[name] - given[name]).max()) / size)
            else:
                off[name] = math.inf
    return _share((name, gap <= POSE) for name, gap in off.items())


def limits(source: Facts, result: Facts) -> Share:
    """Judge the limits of positions, efforts and velocities: each that the source has."""
    found = []
    for name, joint in source.joints.items():
        other = result.joints.get(name)
        if math.isfinite(joint.lower) and abs(joint.lower) < NOT_A_LIMIT:
            is_kept = other is not None and all(
                _near(*pair, VALUE)
                for pair in ((joint.lower, other.lower), (joint.upper, other.upper))
            )
            found.append((f"{name}: position", is_kept))
        for what in ("effort",) if result.format == "mjcf" else ("effort", "velocity"):
            value = getattr(joint, what)
            if value is not None and 0 < value < NOT_A_LIMIT:
                given = getattr(other, what, None)
                found.append((f"{name}: {what}", given is not None and _near(value, given, VALUE)))
    return _share(found)


def dynamics(source: Facts, result: Facts) -> Share:
    """Judge the damping, friction and armature of joints: each that is not zero."""
    found = []
    for name, joint in source.joints.items():
        for what in ("damping", "friction", "armature"):
            value = getattr(joint, what)
            if value:
                given = getattr(result.joints.get(name), what, 0.0)
                found.append((f"{name}: {what}", _near(value, given, VALUE)))
    return _share(found)


def actuators(source: Facts, result: Facts) -> Share:
    """Judge which joints are driven; where both formats have gains on positions, these too."""

    def is_kept(name: str, gain: float | None) -> bool:
        if name not in result.drives:
            return False
        given = result.drives[name]
        return gain is None or result.format not in WITH_GAINS or _near(gain, given or 0.0, VALUE)

    return _share((name, is_kept(name, gain)) for name, gain in source.drives.items())


def sensors(source: Facts, result: Facts) -> Share:
    """Judge the sensors: as many of a kind on the same body."""
    wanted, given = Counter(source.sensors), Counter(result.sensors)
    return _share(
        (f"{kind} on {name or 'base'}", number < given[kind, name])
        for (kind, name), count in wanted.items()
        for number in range(count)
    )


def mimics(source: Facts, result: Facts) -> Share:
    """Judge the joints that follow others: leader, multiplier and offset."""

    def is_kept(name: str) -> bool:
        leader, multiplier, offset = source.mimics[name]
        given = result.mimics.get(name)
        if given is None or given[0] != leader:  # the other may follow: the same equation
            back = result.mimics.get(leader)
            if back is None or back[0] != name or not back[1]:
                return False
            given = leader, 1 / back[1], -back[2] / back[1]
        return _near(multiplier, given[1], VALUE) and _near(offset, given[2], VALUE)

    return _share((name, is_kept(name)) for name in source.mimics)


def shapes(source: Facts, result: Facts) -> Share:
    """Judge the extents of what touches, of each body that does, in the fixed frame."""
    positions = _positions(source, np.random.default_rng(3))
    placed, others = _placed(source, source, positions), _placed(result, source, positions)

    def is_kept(name: str, body: Body) -> bool:
        other = result.bodies.get(name)
        if other is None or name not in others or not len(other.points):
            return False
        wanted, given = _extent(body, placed[name]), _extent(other, others[name])
        size = float(np.ptp(wanted, axis=0).max())
        return float(np.abs(wanted - given).max()) <= SHAPE + 0.01 * size

    return _share(
        (name or "base", is_kept(name, body))
        for name, body in source.bodies.items()
        if len(body.points)
    )


WITH_GAINS = ("mjcf", "usd")
COLUMNS: dict[str, Callable[[Facts, Facts], Share]] = {
    "mass": masses,
    "inertia": inertias,
    "frames": frames,
    "limits": limits,
    "dynamics": dynamics,
    "actuators": actuators,
    "sensors": sensors,
    "mimics": mimics,
    "shapes": shapes,
}


def _near(one: float, two: float, tolerance: float) -> bool:
    return abs(one - two) <= tolerance * max(abs(one), 1e-3)


def _positions(source: Facts, random: np.random.Generator) -> dict[str, float]:
    return {
        name: float(random.uniform(-0.5, 0.5)) * (1 if joint.kind == "revolute" else 0.1)
        for name, joint in sorted(source.joints.items())
    }


def _relative(facts: Facts, source: Facts, positions: dict[str, float]) -> dict[str, Array]:
    poses = facts.poses(positions)
    into = np.linalg.inv(poses.get(source.root, np.eye(4)))
    return {name: into @ each for name, each in poses.items()}


def _placed(facts: Facts, source: Facts, positions: dict[str, float]) -> dict[str, Array]:
    """Return the poses of the bodies, relative to the first link of the source."""
    into = np.linalg.inv(facts.poses(positions).get(source.root, np.eye(4)))
    return {name: into @ each for name, each in facts.place(positions).items()}


def _extent(body: Body, at: Array) -> Array:
    points = body.points @ at[:3, :3].T + at[:3, 3]
    return np.array((points.min(axis=0), points.max(axis=0)))
