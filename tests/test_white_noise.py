"""White noise: the bounds of its tails hold at every N, and scans find what departs from it."""

from math import exp, log

import numpy as np
import pytest
from specrate.numerics.measuring.periodograms import Box
from specrate.numerics.measuring.white_noise import (
    log_probability_above,
    log_probability_below,
    scan,
    scanned_frequencies,
    white_noise_range,
)
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError


@pytest.mark.parametrize("n", [1, 2, 3, 5, 16])
@pytest.mark.parametrize("realisations", [2, 8])
def test_tails_are_bounded(n, realisations):
    """Frequencies in 100 000 trials stay below the bounds and 6 standard errors (1e-9 each).

    The bound of the exponential law alone, (x e^(1-x))^R, is broken below at N = 2.
    """
    rng, trials = stream(81, n, realisations), 100_000
    phases = np.exp(2j * np.pi * rng.random((trials, realisations, n)))
    mean = np.mean(np.abs(phases.sum(axis=2)) ** 2, axis=1) / n
    for x in (0.02, 0.1, 0.3, 0.6, 0.9, 1.2, 1.5, 2.0, 3.0, 4.0):
        tails = [
            (np.mean(mean <= x), log_probability_below(x, n, realisations)),
            (np.mean(mean >= x), log_probability_above(x, realisations)),
        ]
        for seen, bound in tails:
            chance = exp(bound)
            assert seen <= chance + 6 * np.sqrt(chance / trials) + 20 / trials


def test_few_points_are_small_more_often_than_the_exponential_law_says():
    """N = 2: |F|² = cos²(θ/2); P(2 cos² <= x) ~ (2/π) √(x/2), not x."""
    x = 1e-4
    exact = 2 / np.pi * np.arcsin(np.sqrt(x / 2))
    assert log(exact) <= log_probability_below(x, 2, 1)
    assert log(exact) > log(x) + 1


@pytest.mark.parametrize(("n", "realisations"), [(1, 64), (2, 4), (16, 64), (4096, 2), (729, 1024)])
@pytest.mark.parametrize("level", [1e-3, 1e-10])
def test_the_range_is_where_the_bounds_cross_the_level(n, realisations, level):
    low, high = white_noise_range(n, realisations, level)
    assert 0 <= low < 1 < high
    assert log_probability_above(high, realisations) <= log(level)
    assert log_probability_above(high * (1 - 1e-9), realisations) > log(level)
    assert log_probability_below(low * (1 + 1e-9), n, realisations) > log(level)
    if low > 0:
        assert log_probability_below(low, n, realisations) <= log(level)


def test_a_single_point_is_never_less():
    assert white_noise_range(1, 10_000, 1e-3)[0] == 0.0


@pytest.mark.parametrize("bad", [(0, 2, 0.1), (2, 0, 0.1), (2, 2, 0.0), (2, 2, 1.0)])
def test_range_of_nonsense(bad):
    with pytest.raises(InputError, match="white noise needs"):
        white_noise_range(*bad)


@pytest.mark.parametrize(
    ("dim", "axes", "pairs", "triples"),
    [(4, 4, 6, 4), (10, 10, 45, 120), (19, 19, 171, 969), (20, 20, 190, 18), (41, 41, 40, 39)],
)
def test_scanned_frequencies(dim, axes, pairs, triples):
    found = scanned_frequencies(dim)
    assert isinstance(found, tuple)
    assert len(set(found) | {tuple(-k for k in m) for m in found}) == 2 * len(found)
    sizes = [sum(k != 0 for k in m) for m in found]
    assert [sizes.count(s) for s in (1, 2, 3)] == [2 * axes, 6 * pairs, 4 * triples]


@pytest.mark.parametrize(("dim", "half"), [(1, 16), (2, 16), (3, 10)])
def test_boxes(dim, half):
    assert scanned_frequencies(dim) == Box((half,) * dim)


@pytest.mark.parametrize("dim", [1, 2, 3, 4])
def test_scans_average_the_power_of_raw_points(dim):
    points = stream(82, dim).random((3, 5, dim))
    found = scan(points, 1e-3)
    sizes = [sum(map(abs, m)) for m in found.powers if sum(k != 0 for k in m) == 1]
    assert sizes == sorted(sizes)
    for m in list(found.powers)[:: max(1, len(found.powers) // 50)]:
        waves = np.exp(-2j * np.pi * (points @ np.array(m))).mean(axis=1)
        assert found.powers[m].estimate == pytest.approx(5 * np.mean(np.abs(waves) ** 2), abs=1e-7)
        assert found.at([-k for k in m]) == found.powers[m]
    assert found.at((999,) * dim) is None


@pytest.mark.parametrize("shape", [(64, 16), (1, 16, 2), (4, 0, 2)])
def test_scans_need_realisations(shape):
    with pytest.raises(InputError, match="a scan needs"):
        scan(np.zeros(shape), 1e-3)
