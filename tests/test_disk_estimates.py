"""Jitter on a disk through the distance of two points in a cell: the density, and honest errors."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.exact_variances.covariogram_variances import ball_variance
from specrate.numerics.integrands.ball import Ball
from specrate.numerics.integrands.protocol import mp
from specrate.numerics.method_tests.disk_estimates import by_mpmath, by_scipy
from specrate.numerics.method_tests.stress import Outcome, is_honest, relative_errors
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

F = Fraction
JITTER = parse_sampler("jitter", 2)


@st.composite
def cells_and_radii(draw) -> tuple[int, Fraction]:
    """n from 2 to 1e150 cells along an axis, R up to where differences reach round the torus."""
    n = draw(st.one_of(st.integers(2, 40), st.integers(2, 150).map(lambda k: 10**k)))
    most = (1 - F(1, n)) / 2
    share = draw(st.one_of(st.fractions(F(1, 100), 1, max_denominator=100), st.just(F(1, 10**9))))
    return n, most * share


def judged(estimate, n, radius) -> tuple[bool, float]:
    truth = ball_variance(JITTER, {"N": n * n, "n": n}, Ball(2, radius), 60)
    outcome = Outcome(estimate.value, estimate.error, "estimate")
    error = relative_errors(outcome, truth)[0]
    assert error is not None
    return is_honest(outcome, truth), error


@given(cells_and_radii().filter(lambda x: x[1] < F(1, 2)))
def test_scipy_is_honest_and_right(place):
    honest, error = judged(by_scipy(*place), *place)
    assert honest
    assert error < 1e-13


@settings(max_examples=8)
@given(cells_and_radii().filter(lambda x: x[1] < F(1, 2)), st.sampled_from([10, 30]))
def test_mpmath_is_honest_and_right(place, digits):
    honest, error = judged(by_mpmath(*place, digits), *place)
    assert honest
    assert error < 10.0**-digits


@pytest.mark.parametrize("tolerance", [1e-2, 1e-5, 1e-9])
def test_coarse_tolerances_are_honest(tolerance):
    assert judged(by_scipy(7, F(1, 5), tolerance), 7, F(1, 5))[0]


def test_the_limit_is_the_mean_distance_in_a_square():
    """N^(3/2) Var -> 2R E|Δ|, E|Δ| = (2 + √2 + 5 asinh 1)/15, corrections of order N^-1."""
    with mp.workdps(40):
        mean = (2 + mp.sqrt(2) + 5 * mp.asinh(1)) / 15
        found = by_mpmath(10**20, F(1, 4), 30).value * mp.mpf(10) ** 60
        assert abs(found / (mean / 2) - 1) < mp.mpf(10) ** -30


@pytest.mark.parametrize(
    ("n", "radius"), [(1, F(1, 4)), (2, F(1, 3)), (100, F(499, 1000)), (4, F(0))]
)
def test_where_differences_reach_round_the_torus_it_is_refused(n, radius):
    for method in (by_scipy, by_mpmath):
        with pytest.raises(InputError, match="2R"):
            method(n, radius)


@pytest.mark.parametrize("tolerance", [0.0, 1e-16, 2.0])
def test_tolerances_have_a_range(tolerance):
    with pytest.raises(InputError, match="tolerance"):
        by_scipy(4, F(1, 4), tolerance)
