"""Pairs of links that need no check for collisions, each with the reason.

- Adjacent: a joint joins them, or joints with links without shapes in between.
- Default: they touch in the default state, so that contact cannot be avoided.
- Always: they touch at nearly all positions.
- Never: they touch at no random position, and at none that a search from the nearest ones finds.

Source: MoveIt calls them so. The search is ours, since sampling alone misses rare contacts.
"""

from __future__ import annotations

from itertools import combinations, starmap

from ...model.kinematics import adjacent_links
from ...model.schema import DEFAULT_SAMPLES, DEFAULT_SEED
from ..table import TARGETS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...model.robot import Robot
    from ..output import Wanted

ADJACENT, DEFAULT, ALWAYS, NEVER = "Adjacent", "Default", "Always", "Never"


class Pair:
    """Two links, the first before the second in the alphabet, and why they need no check."""

    __slots__ = ("first", "reason", "second")

    def __init__(self, first: str, second: str, reason: str) -> None:
        self.first = first
        self.second = second
        self.reason = reason


def disabled_pairs(
    robot: Robot, wanted: Wanted, *, links: Iterable[str] | None = None
) -> list[Pair]:
    """Return the pairs that need no check, in the order of the alphabet.

    Args:
        robot: the robot.
        wanted: finds meshes, and takes how far the work is.
        links: those of the pairs, by default all with shapes that collide.

    Raises:
        YamaroError: what samples is not installed, or a mesh cannot be read.
    """
    if links is None:
        links = (name for name, link in robot.links.items() if link.collisions)
    solid = [*links]
    settings = robot.collision_settings
    kept = {_sorted(*pair) for pair in settings.keep} if settings is not None else set()
    found = dict.fromkeys(adjacent_links(robot, solid), ADJACENT)
    rest = [pair for pair in starmap(_sorted, combinations(solid, 2)) if pair not in found]
    rest = [pair for pair in rest if pair not in kept]
    if rest:
        try:
            from .contacts import reasons_for
        except ImportError:
            raise TARGETS["srdf"].missing(robot.span) from None

        samples = DEFAULT_SAMPLES if settings is None else settings.samples
        seed = DEFAULT_SEED if settings is None else settings.seed
        found |= reasons_for(robot, rest, wanted, samples=samples, seed=seed)
    return [Pair(*pair, found[pair]) for pair in sorted(found) if pair not in kept]


def _sorted(first: str, second: str) -> tuple[str, str]:
    return (first, second) if first <= second else (second, first)
