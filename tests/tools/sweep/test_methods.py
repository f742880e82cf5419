"""The points of grid, random, Latin hypercube and Sobol, beside numpy, scipy and counting."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.later import Later
from yamaro.tools.sweep.plan import GRID, LATIN, METHODS, RANDOM, SOBOL, Method

if TYPE_CHECKING:
    from scipy import stats
else:
    stats = Later("scipy.stats")

SEEDS = st.integers(0, 2**63 - 1)


def points(name: str, seed: int, samples: int, counts: list[int]) -> list[tuple[float, ...]]:
    return [tuple(point) for point in Method(name, seed, samples, counts).points(0, samples)]


@settings(max_examples=examples(30), deadline=None)
@given(seed=SEEDS, samples=st.integers(1, 200), axes=st.integers(1, 6))
def test_latin_has_one_point_in_each_stratum_of_each_axis(
    seed: int, samples: int, axes: int
) -> None:
    found = np.array(points(LATIN, seed, samples, [0] * axes))
    strata = np.floor(found * samples).astype(int)
    for axis in range(axes):
        assert sorted(strata[:, axis]) == list(range(samples))


@pytest.mark.slow
def test_latin_has_one_point_in_each_stratum_of_many() -> None:
    samples = 100_003
    found = np.array(points(LATIN, 5, samples, [0, 0]))
    for axis in range(2):
        counts = np.bincount(np.floor(found[:, axis] * samples).astype(int), minlength=samples)
        assert counts.min() == counts.max() == 1


def test_latin_goes_through_the_axes_in_other_orders() -> None:
    found = np.array(points(LATIN, 1, 1000, [0, 0, 0]))
    correlations = np.corrcoef(found.T)[np.triu_indices(3, 1)]
    assert np.abs(correlations).max() < 0.15  # of random orders: 0.03, and 0.15 is 4.7 times that


@settings(max_examples=examples(20), deadline=None)
@given(seed=SEEDS, index=st.integers(0, 2**40 - 2))
def test_random_numbers_are_those_of_numpy(seed: int, index: int) -> None:
    key = np.array([seed, index], dtype=np.uint64)
    expected = np.random.Generator(np.random.Philox(key=key)).random(5)
    assert list(next(Method(RANDOM, seed, 2**40, [0] * 5).points(index, index + 1))) == list(
        expected
    )


def test_random_numbers_are_uniform_and_independent() -> None:
    found = np.array(points(RANDOM, 3, 20_000, [0, 0]))
    for axis in range(2):
        assert stats.kstest(found[:, axis], "uniform").pvalue > 1e-3
    assert abs(np.corrcoef(found.T)[0, 1]) < 0.03
    assert abs(np.corrcoef(found[:-1, 0], found[1:, 0])[0, 1]) < 0.03


@pytest.mark.parametrize("seed", [0, 7, 2**40])
def test_the_points_of_sobol_are_those_of_scipy(seed: int) -> None:
    sequence = stats.qmc.Sobol(4, rng=np.random.default_rng(seed))
    assert np.array_equal(points(SOBOL, seed, 256, [0] * 4), sequence.random(256))


@pytest.mark.parametrize("counts", [[3], [2, 3, 4], [5, 1, 2]])
def test_a_grid_has_each_combination_once(counts: list[int]) -> None:
    size = int(np.prod(counts))
    expected = list(itertools.product(*(range(count) for count in counts)))
    assert points(GRID, 0, size, counts) == expected


@settings(max_examples=examples(20), deadline=None)
@given(name=st.sampled_from(METHODS), seed=SEEDS, cuts=st.lists(st.integers(0, 24), max_size=4))
def test_a_point_depends_on_its_index_and_not_on_the_chunk_it_is_in(
    name: str, seed: int, cuts: list[int]
) -> None:
    counts = [2, 3, 4]
    whole = points(name, seed, 24, counts)
    ends = [0, *sorted(cuts), 24]
    parts = [
        tuple(point)
        for start, stop in itertools.pairwise(ends)
        for point in Method(name, seed, 24, counts).points(start, stop)
    ]
    assert parts == whole


@pytest.mark.parametrize("name", [RANDOM, SOBOL])
def test_the_first_points_are_the_same_for_more_samples(name: str) -> None:
    assert points(name, 9, 16, [0, 0]) == points(name, 9, 64, [0, 0])[:16]


@pytest.mark.parametrize("name", [RANDOM, LATIN, SOBOL])
def test_another_seed_gives_other_points(name: str) -> None:
    assert points(name, 0, 8, [0, 0]) != points(name, 1, 8, [0, 0])
