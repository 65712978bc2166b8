"""Profiles fitted to what a check measures: frequencies per region, their fits, one N, none."""

import numpy as np
import pytest
from specrate.numerics.checking.fitted_profiles import (
    estimated,
    fit_frequencies,
    fit_seconds,
    fitted_regions,
    fitted_supports,
    used_realisations,
)
from specrate.numerics.fitting.estimated_spectra import CONE
from specrate.numerics.measuring.measurements import Measurement, grow
from specrate.numerics.point_sources.catalogue_source import CatalogueSource
from specrate.numerics.streams import stream
from specrate.theory.samplers import parse_sampler


def measured(word, dim, counts, replicates=128, seed=0):
    source = CatalogueSource(parse_sampler(word, dim))
    found = [Measurement(n, (), ()) for n in counts]
    for m in found:
        grow(m, source, seed, replicates)
    return found


def by_support(word, dim, counts, **options):
    return {r.support: r.fit for r in fitted_regions(measured(word, dim, counts, **options), dim)}


@pytest.mark.parametrize("dim", [1, 2, 3, 5, 10, 40])
@pytest.mark.parametrize("n", [2, 16, 729, 1 << 22])
def test_frequencies_have_the_support_and_reach_beyond_the_strata(dim, n):
    for support in fitted_supports(dim):
        m = fit_frequencies(n, dim, support)
        expected = [i + 1 in support for i in range(dim)]
        assert (m.astype(bool) == expected).all()
        assert len(np.unique(m, axis=0)) == len(m) <= 98
        size = np.abs(m[:, expected])
        assert size.min() == 1
        assert 2 * n ** (1 / len(support)) <= size.max() <= 8 * n ** (1 / len(support)) + 1


@pytest.mark.parametrize("dim", [3, 10])
def test_frequencies_on_many_coordinates_lie_in_the_cone(dim):
    m = np.abs(fit_frequencies(4096, dim, tuple(range(1, dim + 1))))
    inside = m.max(axis=1) <= CONE * m.min(axis=1)
    assert inside.mean() > 0.7
    assert (np.ptp(m, axis=1) == 0).any()


def test_power_and_dispersion_are_those_of_direct_sums():
    points = stream(11).random((5, 7, 3))
    m = np.array([[1, 0, -2], [3, 0, 1]])
    found = estimated(points, m, (1, 3))
    power = 7 * abs(np.exp(-2j * np.pi * points @ m.T).mean(axis=1)) ** 2
    np.testing.assert_allclose(found.power, power.mean(axis=0), rtol=1e-12)
    spread = power.var(axis=0, ddof=1) / power.mean(axis=0) ** 2
    np.testing.assert_allclose(found.dispersion, spread, rtol=1e-12)
    assert (found.n, found.realisations) == (7, 5)


def test_points_all_alike_have_no_power_and_are_outside_the_model():
    """A grid moved as a whole, off its dual: N|F|² is 0."""
    grid = (np.indices((8, 8)).reshape(2, -1).T / 8)[None] + stream(2).random((16, 1, 2))
    m = np.array([[1, 0], [2, 0], [3, 0]])
    found = estimated(grid % 1.0, m, (1,))
    assert found.power.max() < 1e-25
    regular = by_support("regular", 2, [16, 64, 256])
    assert all("lattice" in fit.outside_model for fit in regular.values())


def test_jitter_and_latin_hypercubes_have_their_profiles():
    """b and e within four half widths of their 95 % intervals: 7.8 standard deviations (1e-14)."""
    jitter = by_support("jitter", 2, [16, 100, 256])
    assert set(jitter) == {(1,), (2,), (1, 2)}
    rooks = by_support("latin-hypercube", 2, [16, 64, 256])
    cases = [(f, 2, 0.5) for f in jitter.values()] + [(rooks[i,], 2, 1.0) for i in (1, 2)]
    for fit, b, e in cases:
        assert fit.outside_model is None
        for interval, true in ((fit.degree, b), (fit.effective, e)):
            half = 4 * (interval.high - interval.low) / 2
            assert abs(interval.estimate - true) < half
    assert rooks[1, 2].effective is None
    assert abs(rooks[1,].effective.estimate - 0.5) > 0.2  # what would make it jitter


def test_the_same_measurements_give_the_same():
    one, other = (by_support("jitter", 2, [16, 64], replicates=32) for _ in range(2))
    assert one == other


def test_a_single_n_has_no_effective_exponent_and_says_so():
    fit = by_support("jitter", 1, [64])[1,]
    assert fit.effective is fit.alpha is None
    assert fit.degree.low <= 2 <= fit.degree.high
    assert "one N" in fit.reason


def test_nothing_is_fitted_to_single_or_frozen_realisations():
    assert list(fitted_regions(measured("random", 2, [16, 64], 1), 2)) == []
    assert list(fitted_regions([Measurement(16, (), ())], 2)) == []
    frozen = measured("random", 2, [16], 64)
    frozen[0].distinct = 1
    assert list(fitted_regions(frozen, 2)) == []


def test_of_many_points_fewer_realisations_are_used():
    held = {n: Measurement(n, (), ()) for n in (256, 1 << 16, 1 << 20)}
    for n, m in held.items():
        m.kept = [np.broadcast_to(0.0, (128, n, 2))]
    used = [used_realisations(m, 2) for m in held.values()]
    assert used[0] == 128
    assert 1 < used[1] < 10
    assert used[2] == 0


def test_what_a_fit_takes_is_foretold_and_bounded():
    assert fit_seconds(2, []) < fit_seconds(2, [256]) < fit_seconds(2, [256, 1024])
    assert fit_seconds(2, [1 << 22]) < 1
    assert len(fitted_supports(10)) == len(fitted_supports(100)) == 5
