"""Eq. 17 along an axis for true spectra: three routes agree inside their bounds, at any N."""

from fractions import Fraction
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.balls import flint
from specrate.numerics.equation17.axis_integrals import (
    ROUTES,
    AxisProblem,
    axis_integral,
    gaussian_deficit,
    solve_axis,
)
from specrate.numerics.equation17.space_integrands import SpaceBall, SpaceGaussian
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError

F = Fraction
strata = st.one_of(
    st.fractions(F(1), F(50), max_denominator=7), st.integers(1, 30).map(lambda k: F(10) ** k)
)


@st.composite
def ball_problems(draw):
    """b = 1/(2Rn) below 19/20, in 1 to 8 dimensions."""
    n = draw(strata)
    ratio = draw(st.fractions(F(1, 500), F(19, 20), max_denominator=500))
    count = draw(st.fractions(F(1), F(10) ** 40, max_denominator=1))
    d = draw(st.integers(1, 8))
    return AxisProblem(SpaceBall(d, 1 / (2 * ratio * n)), n, count, d)


@st.composite
def gaussian_problems(draw):
    """1/(2σn) from 1e-31 to 20, all regions of 1 to 6 dimensions."""
    d = draw(st.integers(1, 6))
    widths = st.fractions(F(1, 40), F(3), max_denominator=60)
    sigmas = tuple(draw(st.lists(widths, min_size=d, max_size=d)))
    return AxisProblem(SpaceGaussian(sigmas), draw(strata), F(7), draw(st.integers(1, d)))


def agree(first, second) -> bool:
    gap = abs(F(first.value.value) - F(second.value.value))
    return gap <= F(first.value.error_bound) + F(second.value.error_bound)


@given(ball_problems())
def test_ball_closed_form_and_covariogram_agree_inside_their_bounds(problem):
    assert agree(solve_axis(problem, 25), solve_axis(problem, 25, "covariogram"))


@settings(max_examples=10)  # 10 to 200 ms each
@given(ball_problems())
def test_ball_frequencies_to_infinity_agree(problem):
    assert agree(solve_axis(problem, 15), solve_axis(problem, 12, "quadrature"))


@given(gaussian_problems())
def test_gaussian_routes_agree_inside_their_bounds(problem):
    closed, covariogram, quadrature = (solve_axis(problem, 20, r) for r in ROUTES)
    assert agree(closed, covariogram)
    assert agree(closed, quadrature)


@pytest.mark.parametrize("integrand", ["ball:radius=0.3", "gaussian:sigma=0.1"])
@pytest.mark.parametrize("d", [1, 2, 3, 10])
def test_fifty_digits_at_1e30(integrand, d):
    found = [axis_integral(integrand, d, "1e30", route=r, digits=50) for r in ROUTES]
    for result in found:
        assert F(result.value.error_bound) <= F(result.value.value) * F(10) ** -49
        assert agree(found[0], result)


@pytest.mark.parametrize(("dim", "n"), [(1, 3), (2, 49), (3, 64), (10, 1024)])
def test_mpmath_agrees(dim, n):
    """mpmath.quad of the frequency integral of the Gaussian: 12 digits of the 15 asked for."""
    strata, sigma = mp.mpf(round(n ** (1 / dim))), mp.mpf(1) / 7

    def density(rho):
        spectrum = 1 - mp.sincpi(rho / strata) ** 2
        power = (2 * mp.pi * sigma**2) ** dim * mp.exp(-4 * mp.pi**2 * sigma**2 * rho**2)
        return rho ** (dim - 1) * spectrum * power / n

    with mp.workdps(20):
        estimate = mp.quad(density, [0, 1, 2, 4, 8, 16])
    exact = mp.mpf(axis_integral("gaussian:sigma=1/7", dim, str(n)).value.value)
    assert abs(estimate / exact - 1) < 1e-12


def test_scipy_agrees_on_the_disk():
    """Up to ρ = 2000 by steps, beyond it the mean 1/(2π²Rρ²) R² of the power: to 1e-7."""
    from scipy.integrate import quad
    from scipy.special import jv

    radius, strata, cut = 0.3, 4, 2000
    edges = np.linspace(0, cut, 5 * cut + 1)
    x, w = np.polynomial.legendre.leggauss(12)
    rho = (edges[:-1, None] + (x + 1) / 2 * (edges[1] - edges[0])).reshape(-1)
    weights = np.tile(w / 2 * (edges[1] - edges[0]), len(edges) - 1)
    power = radius**2 * jv(1, 2 * pi * radius * rho) ** 2 / rho
    head = float(weights @ (power * (1 - np.sinc(rho / strata) ** 2)))
    tail = radius / (2 * pi**2 * cut)
    assert quad(lambda t: radius / (2 * pi**2 * t**2), cut, np.inf)[0] == pytest.approx(tail)
    exact = float(axis_integral("disk:radius=0.3", 2, "16").value.value) * 16
    assert head + tail == pytest.approx(exact, abs=2e-8)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_many_strata_see_the_slope_of_the_ball(d):
    """b → 0: N·V = R^d b/3, the rate 1/n of Eq. 17 along one direction with its Jacobian."""
    value = F(axis_integral("ball:radius=1/4", d, f"1e{12 * d}", digits=30).value.value)
    assert abs(value * F(10) ** (12 * d) / (F(1, 4) ** d * F(2, 10**12) / 3) - 1) < F(1, 10**20)


@pytest.mark.parametrize("sigma", ["1/10", "3"])
def test_a_smooth_integrand_sees_the_second_moment(sigma):
    """n → ∞: 1 − sinc² = (πρ/n)²/3, so N·V n² → (π²/3) ∫ρ^(d+1) |Ff|² dρ; d = 2 gives 1/24."""
    value = F(axis_integral(f"gaussian:sigma={sigma}", 2, "1e40", digits=25).value.value)
    # A² (π²/3)/(2(4π²σ²)²) = (2πσ²)² (π²/3)/(32π⁴σ⁴) = 1/24
    assert abs(value * F(10) ** 80 * 24 - 1) < F(1, 10**20)


def test_the_first_width_is_that_of_the_axis():
    """y is that of σ_1; the other widths come in by the amplitude ∏ 2πσ_i² alone."""
    problem = AxisProblem(SpaceGaussian((F(1, 5), F(1, 2), F(2))), F(4), F(1), 3)
    plain = AxisProblem(SpaceGaussian((F(1, 5),) * 3), F(4), F(1), 3)
    ratio = F(solve_axis(problem, 20).value.value) / F(solve_axis(plain, 20).value.value)
    assert abs(ratio / (F(1, 4) * 4 * 25**2) - 1) < F(1, 10**18)


def test_region_one_of_one_dimension_is_the_whole_of_it():
    """s = d = 1: E(Δ)/2 = 1/(6n) for an interval, however long."""
    for route in ROUTES:
        result = solve_axis(AxisProblem(SpaceBall(1, F(2, 7)), F(9), F(1), 1), 20, route)
        assert abs(F(result.value.value) - F(1, 54)) <= F(result.value.error_bound)


@pytest.mark.parametrize("region", [1, 2])
def test_the_ball_in_lower_regions_has_the_frequency_integral_only(region):
    problem = AxisProblem(SpaceBall(3, F(1, 4)), F(8), F(1), region)
    value = float(solve_axis(problem, 12, "quadrature").value.value)
    b = 1 / 4
    if region == 1:  # R³ (2πR)² (b²/9 − b³/15 + 2b⁵/315)
        expected = (pi / 2) ** 2 / 64 * (b**2 / 9 - b**3 / 15 + 2 * b**5 / 315)
        assert value == pytest.approx(expected, rel=1e-11)
    for route in ("closed", "covariogram"):
        with pytest.raises(InputError, match="region = dim"):
            solve_axis(problem, 12, route)


def test_deficits_of_one_coordinate():
    """s = 1: the mean of 1 − e^(−yτ²), in every route the same ball."""
    flint.ctx.prec, before = 90, flint.ctx.prec
    try:
        for y in (F(1, 10**40), F(1, 3), F(5)):
            found = [gaussian_deficit(1, y, r) for r in ROUTES]
            assert found[0].overlaps(found[1])
            assert found[0].overlaps(found[2])
            assert all(v.rel_accuracy_bits() > 60 for v in found)
    finally:
        flint.ctx.prec = before


@pytest.mark.parametrize(
    ("arguments", "rule"),
    [
        (("ball:radius=0.3", 2, "10"), "exact root of order 2: got 10"),
        (("ball:radius=0.3", 2, "0"), "exact root"),
        (("ball:radius=0.3", 2, "-4"), "exact root"),
        (("ball:radius=0.3", 2, "x"), "n must be a number"),
        (("bernoulli:k=2", 2, "16"), "must be a ball or a gaussian: got bernoulli"),
        (("ball:radius=0.3", 2, "16", 3), "1 <= region <= dim: got 3"),
        (("ball:radius=0.3", 2, "16", 0), "1 <= region <= dim: got 0"),
        (("ball:radius=0.1", 2, "16"), "1/(2 R n) < 1"),
        (("ball:radius=0.3", 2, "16", 2, "fast"), "a route is one of closed"),
        (("gaussian:sigma=1/1000", 2, "1"), "<= 10000: got 250000"),
        (("disk:radius=0.0001", 2, "1", 2, "quadrature"), "<= 20: got 5000"),
        (("disk:radius=0.125005", 2, "16"), "<= 999/1000"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(arguments, rule):
    with pytest.raises(InputError) as caught:
        axis_integral(*arguments)
    assert rule in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("digits", [0, 10_001])
def test_digits_have_a_range(digits):
    with pytest.raises(InputError, match="digits"):
        axis_integral("disk", 2, "16", digits=digits)
