"""Spectra of known profile: each tends to its degree and plateau, and is that of its points."""

from math import sqrt

import mpmath
import numpy as np
import pytest
from scipy import special
from specrate.numerics.fitting.coverage_truths import (
    TRUTHS,
    along,
    along_grid,
    difference_jitter,
    generic,
)
from specrate.numerics.measuring.probes import amplitudes
from specrate.numerics.streams import stream

NAMED = [pytest.param(t, id=t.name) for t in TRUTHS]
WITH_DEGREE = [pytest.param(t, id=t.name) for t in TRUTHS if t.degree]
WITH_POINTS = [pytest.param(t, id=t.name) for t in TRUTHS if t.points is not None]


def test_the_names_differ():
    assert len({t.name for t in TRUTHS}) == len(TRUTHS)


@pytest.mark.parametrize("truth", WITH_DEGREE)
def test_low_frequencies_follow_the_degree_and_the_cut_off(truth):
    """γ (ρ/(α N^e))^b, on two coordinates along the diagonal."""
    n = 2**40
    m = np.zeros_like(truth.frequencies(n, 4)[:1])
    m[0, truth.frequencies(n, 4)[0] != 0] = 32
    x = sqrt(float((m**2).sum())) / n**truth.effective
    expected = truth.gamma * (x / truth.alpha) ** truth.degree
    assert truth.spectrum(n, m)[0] == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize("truth", NAMED)
def test_high_frequencies_are_on_the_plateau(truth):
    n = 2**20
    reached = n if truth.effective is None else round(n**truth.effective)
    m = np.where(truth.frequencies(n, 4)[:1] != 0, 60 * reached + reached // 3, 0)
    assert truth.spectrum(n, m)[0] == pytest.approx(truth.gamma, rel=1e-2)


@pytest.mark.parametrize("truth", WITH_POINTS)
def test_points_have_the_spectrum(truth):
    """Mean of N|F|² over R = 400 realisations against R times the mean of the gamma law.

    False alarms: 6 of the standard errors measured are exceeded with probability below 1e-8 per
    frequency. Power: half the spectrum at low frequencies is 10 standard errors off.
    """
    n, r = 16, 400
    m = truth.frequencies(n, 4)
    points = truth.points(n, r, stream(3))
    values = n * np.abs(amplitudes(points, [tuple(f) for f in m.tolist()])) ** 2
    mean = truth.spectrum(n, m)
    law = special.gammaincinv(r, [5e-10, 1 - 5e-10]) / r
    slack = np.maximum(values.var(axis=1) / values.mean(axis=1) ** 2, 1.0)  # heavier tails
    ratio = values.mean(axis=1) / mean
    assert (ratio > 1 - (1 - law[0]) * np.sqrt(slack)).all()
    assert (ratio < 1 + (law[1] - 1) * np.sqrt(slack)).all()
    assert not ((ratio / 2 > 1 - (1 - law[0]) * np.sqrt(slack)).all())


@pytest.mark.parametrize("x", [1e-4, 1e-2, 0.1, 0.3, 0.3184, 0.4, 1.0, 1.7])
def test_difference_jitter_keeps_all_digits(x):
    n = 10**6
    m = np.array([[round(x * n)]])
    with mpmath.workdps(60):
        t = mpmath.mpf(int(m[0, 0])) / n
        phi = mpmath.sincpi(t)
        exact = 1 - phi**4 + 2 * mpmath.cospi(2 * t) * (phi**3 * mpmath.cospi(t) - phi**4)
        assert difference_jitter(n, m)[0] == pytest.approx(float(exact), rel=1e-10)


def test_frequencies_reach_from_one_to_beyond_the_crossover():
    assert along(100, 6)[[0, -1], 0].tolist() == [1, 400]
    assert along_grid(100, 6)[[0, -1]].tolist() == [[1, 0], [40, 0]]
    found = generic(100, 4)
    assert (found != 0).all()
    assert np.abs(found).max() == 40
    assert len(np.unique(found, axis=0)) == len(found) == 2 * 4 * 4
