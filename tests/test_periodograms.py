"""Periodograms: the transform parts two realisations, and the intervals hold what they say."""

import numpy as np
import pytest
from scipy import stats
from scipy.special import gammainccinv, gammaincinv
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.measuring.periodograms import (
    ACCURACY,
    Box,
    PeriodogramSums,
    absorb,
    average_periodogram,
    averaged,
)
from specrate.numerics.measuring.probes import amplitudes
from specrate.numerics.point_sources.catalogue_source import CatalogueSource
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler


def drawn(name, dim, n, replicates, seed=0):
    return CatalogueSource(parse_sampler(name, dim)).realise(n, seed, range(replicates))


def halves(sums):
    """Frequencies that the sums of a box keep, and its shape."""
    k = sums.where.half_widths
    grid = np.stack(np.meshgrid(*[np.arange(-i, i + 1) for i in k], indexing="ij"), axis=-1)
    return [tuple(m) for m in grid.reshape(-1, len(k))[: sums.where.size // 2].tolist()]


@pytest.mark.parametrize(
    ("half_widths", "n", "replicates"),
    [((40,), 7, 4), ((3, 5), 50, 3), ((1, 2, 3), 9, 5), ((2, 2), 1, 1), ((4, 4), 3000, 2)],
)
def test_a_box_is_what_direct_sums_give(half_widths, n, replicates):
    """Means and mean squares: the second tells a wrong parting of the two in a transform."""
    points = stream(1, n).random((replicates, n, len(half_widths)))
    points[0] = points[0, 0]  # all at one place: |F| = 1 beside a random realisation
    box = PeriodogramSums(Box(half_widths))
    absorb(box, points)
    wanted = halves(box)
    power = np.abs(amplitudes(points, wanted)) ** 2
    if replicates % 2 == 0:
        np.testing.assert_allclose(box.total, power.sum(axis=1), rtol=0, atol=3 * ACCURACY)
        np.testing.assert_allclose(box.squares, (power**2).sum(axis=1), rtol=0, atol=6 * ACCURACY)
    whole, listed = averaged(box), average_periodogram([points], tuple(wanted))
    assert whole.mean.shape == Box(half_widths).shape
    assert whole.realisations == listed.realisations == replicates
    size = len(wanted)
    for name in ("mean", "low", "high"):
        flat = getattr(whole, name).reshape(-1)
        np.testing.assert_array_equal(flat[:size], flat[:size:-1])
        # The widths of shapes are steps of 1 %, across which an error of 1e-9 may fall.
        tolerance = 1e-5 if name == "mean" else 0.02
        np.testing.assert_allclose(
            flat[:size], getattr(listed, name), rtol=tolerance, atol=3 * ACCURACY
        )
    np.testing.assert_array_equal(whole.frequencies().reshape(-1, len(half_widths))[:size], wanted)


@pytest.mark.parametrize("half_widths", [(16383,), (127, 127), (51, 51, 51), (57, 57, 57)])
def test_the_accuracy_holds_at_corners(half_widths):
    """Boxes that leave a coarse grid little room; a tolerance of 1e-6 would show."""
    dim = len(half_widths)
    points = stream(2, dim).random((2, 200, dim))
    box = PeriodogramSums(Box(half_widths))
    absorb(box, points)
    found = averaged(box).mean
    offsets = np.stack(np.meshgrid(*[np.arange(4)] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    corners = [tuple(m) for m in (np.array(half_widths) - offsets).tolist()]
    corners += [(-m[0], *m[1:]) for m in corners if dim > 1]
    exact = np.sqrt((np.abs(amplitudes(points, corners)) ** 2).mean(axis=1))
    got = [found[tuple(np.add(m, half_widths))] ** 0.5 for m in corners]
    assert np.abs(got - exact).max() < ACCURACY


def test_rounds_do_not_change_the_numbers():
    points = stream(3).random((5, 20, 2))
    once = average_periodogram([points], Box((6, 4)))
    told = []
    rounds = average_periodogram(
        [points[:1], points[1:2], points[2:]], Box((6, 4)), progress=told.append
    )
    assert told == [1, 2, 5]
    np.testing.assert_array_equal(once.mean, rounds.mean)
    np.testing.assert_array_equal(once.high, rounds.high)


def test_to_look_does_not_change_the_numbers():
    points = stream(4).random((3, 20, 1))
    looked, left = PeriodogramSums(Box((9,))), PeriodogramSums(Box((9,)))
    for realisation in points:
        absorb(looked, realisation[None])
        absorb(left, realisation[None])
        averaged(looked)
    np.testing.assert_array_equal(averaged(looked).mean, averaged(left).mean)


def test_white_noise_is_flat():
    """False alarms 1e-8 each; 2/N, of transforms that are not parted, is 100 times farther."""
    n, replicates = 1024, 64
    box = Box((16, 16))
    found = average_periodogram([drawn("random", 2, n, replicates)], box, 1e-8 / (box.size // 2))
    away = found.mean < 1  # all but m = 0
    assert away.sum() == box.size - 1
    assert (found.low[away] <= 1 / n).all()
    assert (found.high[away] >= 1 / n).all()
    # Powers at m and m' ≠ ±m are uncorrelated: one Gamma law for the mean of all of them.
    shape = replicates * (box.size // 2)
    low, high = (gammaincinv(shape, p) / shape / n for p in (5e-9, 1 - 5e-9))
    assert low < found.mean[away].mean() < high
    assert high / low < 1.07


@pytest.mark.parametrize(("name", "dim", "n", "k"), [("jitter", 2, 64, 12), ("jitter", 1, 32, 40)])
def test_jitter_has_its_spectrum(name, dim, n, k):
    """False alarms 1e-8; the flat spectrum 1/N is excluded next to 0."""
    box = Box((k,) * dim)
    found = average_periodogram(
        (drawn(name, dim, n, 64, seed) for seed in range(8)), box, 1e-8 / box.size
    )
    sampler = parse_sampler(name, dim)
    exact = power_array(sampler, sampler.counts_at(n), found.frequencies())
    assert (found.low <= exact).all()
    assert (exact <= found.high).all()
    beside = (k + 1, *[k] * (dim - 1))
    assert found.high[beside] < 1 / n


def test_at_zero_nothing_is_estimated():
    points = stream(5).random((2, 30, 2))
    box = average_periodogram([points], Box((1, 2)))
    listed = average_periodogram([points], ((0, 0), (1, 0)))
    for found, zero in ((box, (1, 2)), (listed, (0,))):
        assert found.mean[zero] == found.low[zero] == found.high[zero] == 1


def test_a_grid_has_its_peaks_and_nothing_else():
    found = average_periodogram([drawn("regular", 2, 16, 6)], Box((9, 9)))
    peaks = (found.frequencies() % 4 == 0).all(axis=-1)
    assert np.abs(found.mean[peaks] - 1).max() < 3 * ACCURACY
    assert found.mean[~peaks].max() < ACCURACY**2
    assert (found.low[~peaks] == 0).all()
    assert 0 < found.high[~peaks].min() <= found.high[~peaks].max() < 10 * ACCURACY**2


@pytest.mark.parametrize("replicates", [1, 5])
@pytest.mark.parametrize("level", [1e-2, 1e-9])
def test_a_steady_power_has_the_interval_of_the_exponential_law(replicates, level):
    points = np.repeat(stream(6).random((1, 30, 1)), replicates, axis=0)
    found = average_periodogram([points], ((1,), (7,)), level)
    for end, tail in (("low", gammainccinv), ("high", gammaincinv)):
        wanted = found.mean * replicates / tail(replicates, level / 2)
        np.testing.assert_allclose(getattr(found, end), wanted, rtol=1e-9)


def test_real_amplitudes_have_wider_intervals():
    """Points in pairs x, 1 - x: F is real, |F|² follows χ² of one degree, P_S = 1/N.

    2000 frequencies, of which 1 % may miss: false alarm 1e-8. The exponential law misses 7 %.
    """
    half, replicates, frequencies = 512, 64, 2000
    x = stream(7).random((replicates, half, 1))
    points = np.concatenate([x, 1 - x], axis=1)
    found = average_periodogram([points], Box((frequencies,)), 1e-2)
    truth = 1 / (2 * half)
    misses = ((found.low > truth) | (found.high < truth))[:frequencies].sum()
    most = stats.binom.isf(1e-8, frequencies, 1e-2)
    assert misses <= most
    narrow = found.mean[:frequencies] * replicates
    outside = (narrow / gammainccinv(replicates, 5e-3) > truth) | (
        narrow / gammaincinv(replicates, 5e-3) < truth
    )
    assert outside.sum() > most


@pytest.mark.parametrize(
    ("half_widths", "message"),
    [
        ((), "1 to 3 dimensions .* got 0"),
        ((1, 1, 1, 1), "1 to 3 dimensions .* got 4"),
        ((3, 0), "half-widths must be in 1"),
        ((1 << 20,), "half-widths must be in 1"),
        ((1100, 1100), "at most 4194304 frequencies: got 4844401"),
    ],
)
def test_unusable_boxes(half_widths, message):
    with pytest.raises(InputError, match=message):
        Box(half_widths)


def test_unusable_input():
    box = Box((2, 2))
    with pytest.raises(InputError, match="1 <= realisations: got 0"):
        average_periodogram([], box)
    for shape in ((3, 4), (1, 4, 3), (1, 0, 2)):
        with pytest.raises(InputError, match="must fill an array"):
            average_periodogram([np.zeros(shape)], box)
    with pytest.raises(InputError, match="must have 4 points, as before: got 5"):
        average_periodogram([np.zeros((1, 4, 2)), np.zeros((1, 5, 2))], box)
    with pytest.raises(InputError, match="0 < level < 1: got 1"):
        average_periodogram([np.zeros((1, 4, 2))], box, 1)
    for frequencies in ((), ((1,), (1, 2))):
        with pytest.raises(InputError, match="share one dimension"):
            PeriodogramSums(frequencies)
