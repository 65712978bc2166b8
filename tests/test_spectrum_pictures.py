"""Fitted profiles as curves and bands, and spectra that do not fit together."""

from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.measuring.moments import Interval
from specrate.numerics.measuring.periodograms import Box, average_periodogram
from specrate.numerics.measuring.spectrum_pictures import (
    FittedMonomial,
    PlaneSpectrum,
    RegionSpectrum,
    profile_at,
    profile_band,
)
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError

RADIUS = np.geomspace(0.5, 1000, 60)
EDGES = st.floats(0.05, 3)


def exactly(value):
    return Interval(value, value, value)


def monomial(b, e, gamma, alpha):
    return FittedMonomial(exactly(b), exactly(e), exactly(gamma), exactly(alpha))


def test_a_saturating_monomial_by_hand():
    """b = 2, N_k = sqrt(64) = 8, α = 1/2: the cut-off is 4."""
    curve = profile_at([monomial(2, 0.5, 3, 0.5)], 64, np.array([1.0, 2.0, 4.0, 100.0]))
    assert curve == pytest.approx([3 / 16, 3 / 4, 3, 3], rel=1e-14)


def test_of_several_monomials_the_largest():
    both = [monomial(2, 0.5, 1, 1), monomial(0.5, 0.5, 0.1, 1)]
    each = [profile_at([m], 100, RADIUS) for m in both]
    assert np.array_equal(profile_at(both, 100, RADIUS), np.maximum(*each))
    assert np.any(each[0] > each[1])
    assert np.any(each[0] < each[1])


def test_what_is_not_determined_has_no_curve():
    unknown = FittedMonomial(exactly(2), exactly(0.5), None, None)
    assert profile_at([unknown], 64, RADIUS) is None
    assert profile_band([unknown], 64, RADIUS) is None
    assert profile_at([], 64, RADIUS) is None
    known = monomial(2, 0.5, 1, 1)
    assert np.array_equal(profile_at([unknown, known], 64, RADIUS), profile_at([known], 64, RADIUS))


def test_without_uncertainty_the_band_is_the_curve():
    fit = [monomial(1.5, 0.5, 0.8, 0.3)]
    for end in profile_band(fit, 256, RADIUS):
        assert end == pytest.approx(profile_at(fit, 256, RADIUS), rel=1e-12)


@given(EDGES, EDGES, EDGES, EDGES, st.floats(0.2, 1), st.integers(2, 10**6))
def test_the_band_holds_the_curve(b, width, gamma, alpha, e, n):
    degree = Interval(b, max(b - width, 0.0), b + 2 * width)
    plateau = Interval(gamma, gamma / (1 + width), gamma * (1 + width))
    fit = [FittedMonomial(degree, exactly(e), plateau, exactly(alpha))]
    curve = profile_at(fit, n, RADIUS)
    least, largest = profile_band(fit, n, RADIUS)
    assert np.all(least <= curve * (1 + 1e-9))
    assert np.all(curve <= largest * (1 + 1e-9))


def test_the_band_is_that_of_the_degree_about_the_middle_of_the_rise():
    """α N^e = 16, so that the middle is 4; there the band is as narrow as the curve."""
    fit = [FittedMonomial(Interval(2, 1, 3), exactly(0.5), exactly(1), exactly(1))]
    least, largest = profile_band(fit, 256, np.array([2.0, 4.0, 8.0]))
    assert least == pytest.approx([2.0**-7, 2.0**-4, 2.0**-3], rel=1e-12)
    assert largest == pytest.approx([2.0**-5, 2.0**-4, 2.0**-1], rel=1e-12)


def test_an_unbounded_degree_leaves_the_band_finite():
    fit = [FittedMonomial(Interval(2, 1, inf), exactly(0.5), exactly(1), exactly(1))]
    least, largest = profile_band(fit, 256, np.array([2.0, 8.0]))
    assert least[0] == 0
    assert largest[1] == 1


def test_arrays_must_fit_together():
    one, two = np.ones(1), np.ones(2)
    with pytest.raises(InputError, match=r"must be of one length: got \(2,\), \(2,\), \(1,\)"):
        RegionSpectrum(16, 10, two, two, one, two)
    with pytest.raises(InputError, match="must be of one length"):
        RegionSpectrum(16, 10, two, two, two, two, 0.05, one)
    points = stream(5).random((4, 9, 3))
    flat = average_periodogram([points[:, :, :2]], Box((2, 3)))
    assert PlaneSpectrum((1, 2), flat, flat.mean).exact is flat.mean
    with pytest.raises(InputError, match=r"must have shape \(5, 7\): got \(7, 5\)"):
        PlaneSpectrum((1, 2), flat, flat.mean.T)
    with pytest.raises(InputError, match="must be a box in 2D"):
        PlaneSpectrum((1, 2), average_periodogram([points], Box((1, 1, 1))))
    with pytest.raises(InputError, match="must be a box in 2D"):
        PlaneSpectrum((1, 2), average_periodogram([points], ((1, 0, 0), (0, 1, 0))))
