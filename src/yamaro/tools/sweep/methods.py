"""Methods: which point of the unit cube, or of the grid, is that of a variant.

A point depends on the method, the seed, the number of samples and the index alone. `random` and
`sobol` give the same first points for any number of samples.
"""

from __future__ import annotations

from ...diagnostics import failure_of_all

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any

GRID, RANDOM, LATIN, SOBOL = "grid", "random", "latin", "sobol"
METHODS = (GRID, RANDOM, LATIN, SOBOL)
LARGEST_SEED = (1 << 63) - 1
MOST_SAMPLES = {GRID: 1 << 40, RANDOM: 1 << 40, LATIN: 1 << 31, SOBOL: 1 << 30}
"""LATIN keeps a permutation of all samples in memory, for each axis; SOBOL has 2^30 points."""
_ORDERS = 1 << 63
"""Added to the number of an axis where it is a key, so that no index is one of these keys."""
_HALF = 2.0**-53


class Method:
    """Gives the points of a sweep.

    Attributes:
        name: one of `METHODS`.
        seed: decides about what is random.
        samples: how many points there are.
        counts: for a grid, how many values each axis has; otherwise any number for each axis.
    """

    __slots__ = ("_orders", "counts", "name", "samples", "seed")

    def __init__(self, name: str, seed: int, samples: int, counts: Sequence[int]) -> None:
        self.name = name
        self.seed = seed
        self.samples = samples
        self.counts = tuple(counts)
        self._orders: list[Any] | None = None

    def points(self, start: int, stop: int) -> Iterator[Sequence[float]]:
        """Yield the points with indices from `start` up to `stop`.

        For a grid these are the indices of the values, and otherwise numbers from 0 to 1.
        """
        if self.name == GRID:
            return (_digits(index, self.counts) for index in range(start, stop))
        if self.name == SOBOL:
            return self._of_sobol(start, stop)
        if self.name == LATIN:
            return self._of_latin(start, stop)
        return (self._random(index) for index in range(start, stop))

    def _random(self, index: int) -> list[float]:
        """Return as many random numbers as there are axes, which no other index has."""
        raw = _philox(self.seed, index).random_raw(len(self.counts))
        return [int(each >> 11) * _HALF for each in raw]

    def _of_latin(self, start: int, stop: int) -> Iterator[list[float]]:
        """Yield points of which each axis has one in each stratum: a permutation for each axis."""
        if self._orders is None:
            numpy = import_extra("numpy")
            self._orders = [
                numpy.random.Generator(_philox(self.seed, _ORDERS + axis)).permutation(
                    numpy.arange(self.samples, dtype=numpy.uint32)
                )
                for axis in range(len(self.counts))
            ]
        for index in range(start, stop):
            strata = [int(order[index]) for order in self._orders]
            yield [
                _within(stratum, part, self.samples)
                for stratum, part in zip(strata, self._random(index), strict=True)
            ]

    def _of_sobol(self, start: int, stop: int) -> Iterator[list[float]]:
        import warnings

        qmc = import_extra("scipy.stats.qmc")
        numpy = import_extra("numpy")
        generator = numpy.random.default_rng(self.seed)
        try:
            sequence = qmc.Sobol(len(self.counts), rng=generator)
        except TypeError:  # scipy before 1.15
            sequence = qmc.Sobol(len(self.counts), seed=generator)
        if start:
            sequence.fast_forward(start)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of numbers of points that are not powers of 2
            points = sequence.random(stop - start)
        return iter(points.tolist())


def _philox(seed: int, key: int) -> Any:
    numpy = import_extra("numpy")
    return numpy.random.Philox(key=numpy.array([seed, key], dtype=numpy.uint64))


def _within(stratum: int, part: float, strata: int) -> float:
    """Return a number in a stratum of the unit interval."""
    value = (stratum + part) / strata
    return value if int(value * strata) == stratum else (stratum + 0.5) / strata


def _digits(index: int, counts: Sequence[int]) -> list[int]:
    """Return the digits of an index in mixed radix; the last one changes fastest."""
    digits = []
    for count in reversed(counts):
        index, digit = divmod(index, count)
        digits.append(digit)
    return digits[::-1]


def import_extra(name: str, extra: str = "sweep") -> Any:
    """Return a module that an extra brings.

    Raises:
        YamaroError: it is not installed.
    """
    from importlib import import_module

    try:
        return import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        raise failure_of_all(
            "missing-extra",
            f"this sweep needs the Python package '{package}': {error}",
            "sweep",
            f"pip install 'yamaro[{extra}]'",
        ) from None
