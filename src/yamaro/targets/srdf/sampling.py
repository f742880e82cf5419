"""Tries random positions of a robot, to find the pairs of links that always or never touch.

The same robot, number of samples and seed give the same pairs.
"""

from __future__ import annotations

from ...diagnostics import failure
from .pairs import ALWAYS, DEFAULT, NEVER

try:
    import numpy as np

    from .scene import Scene
except ImportError as error:
    MISSING: ImportError | None = error
else:
    MISSING = None

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.robot import Robot
    from ..output import Wanted
    from .scene import Floats, LinkPair

CHUNK = 250
"""Samples that one stream of random numbers gives."""
NEARLY_ALWAYS = 0.95
"""The part of positions at which a pair touches that touches always. Source: MoveIt."""
STARTS, STEPS, HALVINGS = 6, 50, 8
"""From how many near positions a contact is searched, in how many steps, each halved how often."""
LONGEST_STEP = 0.5
"""Radians or metres that a joint moves in one step."""
OVERSHOOT = 1.05
"""How far a step goes beyond where the distance would be 0 if it fell evenly."""
FLAT = 1e-12
"""The square of a slope, in m²/rad², that leads nowhere."""


def reasons_for(
    robot: Robot, pairs: Sequence[LinkPair], wanted: Wanted, *, samples: int, seed: int
) -> dict[LinkPair, str]:
    """Return the pairs that need no check, with the reason.

    Args:
        robot: the robot.
        pairs: the pairs that are not adjacent.
        wanted: finds meshes, and takes how far the work is.
        samples: how many random positions are tried.
        seed: of the random numbers.

    Raises:
        YamaroError: pinocchio is not installed, or a mesh cannot be read.
    """
    if MISSING is not None:
        raise failure(
            "missing-extra",
            "SRDF needs pinocchio and coal, which find the links that never touch",
            robot.span,
            hint="pip install 'yamaro[srdf]'",
        )
    return _Sampling(robot, pairs, wanted, samples=samples, seed=seed).run()


class _Sampling:
    """The search for pairs of one robot."""

    def __init__(
        self,
        robot: Robot,
        pairs: Sequence[LinkPair],
        wanted: Wanted,
        *,
        samples: int,
        seed: int,
    ) -> None:
        self._scene = Scene(robot, pairs, wanted)
        self._samples = samples
        self._seed = seed
        self._tell = wanted.progress
        states = robot.states
        home = states.get("home") or next(iter(states.values()), None)
        self._home = self._scene.row_of(home.positions if home is not None else {})
        self._near: list[Floats] = []

    def run(self) -> dict[LinkPair, str]:
        """Return the pairs that need no check, with the reason."""
        scene = self._scene
        touch = scene.touching(self._home)
        found = {pair: DEFAULT for pair, is_so in zip(scene.pairs, touch, strict=True) if is_so}
        scene.keep([pair for pair, is_so in zip(scene.pairs, touch, strict=True) if not is_so])
        counts = self._sample()
        never = []
        for pair, count in zip(scene.pairs, counts, strict=True):
            if count >= NEARLY_ALWAYS * self._samples:
                found[pair] = ALWAYS
            elif count == 0:
                never.append(pair)
        scene.keep(never)
        found |= dict.fromkeys(self._without_contact(), NEVER)
        return found

    def _chunk(self, number: int) -> Floats:
        """Return random positions as rows, always the same ones for a seed and a number."""
        random = np.random.Generator(np.random.PCG64([self._seed, number]))
        first = number * CHUNK
        count = max(min(CHUNK, self._samples - first), 0)
        scene = self._scene
        parts = random.random((count, len(scene.joints)))
        return scene.lower + parts * (scene.upper - scene.lower)

    def _sample(self) -> Floats:
        """Return at how many positions each pair touches; those that do at some leave early."""
        scene = self._scene
        every = scene.pairs
        counts = dict.fromkeys(every, 0)
        chunks = -(-self._samples // CHUNK)
        for number in range(chunks):
            rows = self._chunk(number)
            found = np.array([scene.touching(row) for row in rows])
            for pair, count in zip(scene.pairs, found.sum(axis=0), strict=True):
                counts[pair] += int(count)
            tried = number * CHUNK + len(rows)
            most = self._samples - tried
            still = [
                pair
                for pair in scene.pairs
                if counts[pair] == 0 or counts[pair] + most >= NEARLY_ALWAYS * self._samples
            ]
            if len(still) < len(scene.pairs):
                scene.keep(still)
            self._say(0.8 * (number + 1) / chunks)
        scene.keep(every)
        return np.array([counts[pair] for pair in every])

    def _say(self, part: float) -> None:
        if self._tell is not None:
            self._tell(part)

    # --- the search for rare contacts ---

    def _without_contact(self) -> list[LinkPair]:
        """Return the pairs for which no contact is found from the positions nearest to one."""
        scene = self._scene
        if not scene.pairs:
            return []
        scene.measure()
        rows = np.array([self._home, *self._chunk(0), *self._chunk(1)])
        distances = np.array([scene.distances(row) for row in rows])
        found = []
        for number, pair in enumerate(scene.pairs):
            self._say(0.8 + 0.2 * number / len(scene.pairs))
            starts = np.argsort(distances[:, number], kind="stable")[:STARTS]
            if not scene.moves(pair) or not any(
                self._reaches(number, rows[start]) for start in starts
            ):
                found.append(pair)
        self._say(1.0)
        return found

    def _reaches(self, number: int, row: Floats) -> bool:
        """Return whether going down the distance of a pair ends in a contact."""
        scene = self._scene
        best, slope = scene.distance(number, row)
        for _ in range(STEPS):
            if best <= 0:
                return bool(scene.touching(row)[number])
            at_end = ((row <= scene.lower) & (slope > 0)) | ((row >= scene.upper) & (slope < 0))
            way = np.where(at_end, 0.0, slope)
            steepness = float(way @ way)
            if steepness < FLAT:
                return False
            step = min(OVERSHOOT * best / steepness, LONGEST_STEP / float(np.abs(way).max()))
            for _ in range(HALVINGS):
                tried = np.clip(row - step * way, scene.lower, scene.upper)
                distance, new_slope = scene.distance(number, tried)
                if distance < best:
                    break
                step /= 2
            else:
                return False
            row, best, slope = tried, distance, new_slope
        return False
