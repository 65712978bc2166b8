"""Projected covariograms: their integrals, hypergeometric form, slopes and values at 0."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import exact_ball, flint
from specrate.numerics.exact_variances.covariograms import (
    Covariogram,
    at_zero,
    scale,
    slope,
    unit_ball,
    value,
)

KINDS = tuple(Covariogram(d, k) for d in (2, 3) for k in range(d))
kinds = st.sampled_from(KINDS)
squares = st.fractions(Fraction(1, 10**6), 1 - Fraction(1, 10**6), max_denominator=10**6)


@given(kind=kinds, y=squares)
def test_value_is_hypergeometric(kind, y):
    """J = (1/2) B(α + 1, β + 1) (1 - y)^(α+β+1) F(1/2, α + 1; α + β + 2; 1 - y), β = k/2."""
    with flint.ctx.workprec(200):
        alpha, beta = flint.arb(kind.dim - 1) / 2, flint.arb(kind.flat) / 2
        rest, half = 1 - exact_ball(y), flint.arb(1) / 2
        series = rest.hypgeom_2f1(half, alpha + 1, alpha + beta + 2)
        beta_function = (alpha + 1).gamma() * (beta + 1).gamma() / (alpha + beta + 2).gamma()
        wanted = half * beta_function * rest ** (alpha + beta + 1) * series
        found = value(kind, exact_ball(y))
        assert found.overlaps(wanted)
        assert found.rad() < 1e-45


@given(kind=kinds, y=squares)
def test_value_is_its_integral(kind, y):
    """∫_z^1 (1 - σ²)^((d-1)/2) (σ² - z²)^(k/2) dσ with σ² = y + (1 - y) sin² φ, by quadrature."""
    d, k, rest = kind.dim, kind.flat, 1 - exact_ball(y)

    def integrand(phi, analytic):
        sine, cosine = phi.sin(), phi.cos()
        sigma = (exact_ball(y) + rest * sine * sine).sqrt(analytic=analytic)
        return cosine**d * sine ** (k + 1) / sigma

    total = flint.acb.integral(integrand, 0, flint.arb.pi() / 2).real
    wanted = rest ** (flint.arb(d + k + 1) / 2) * total
    assert abs(value(kind, exact_ball(y)) - wanted) < 1e-12


@given(kind=kinds, y=squares)
def test_slope(kind, y):
    """By a symmetric difference with an error of h² = 1e-120 times a third derivative."""
    with flint.ctx.workprec(600):
        h, middle = flint.arb(10) ** -60, exact_ball(y)
        difference = (value(kind, middle + h) - value(kind, middle - h)) / (2 * h)
        assert abs(slope(kind, middle) - difference) < 1e-80


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_value_at_zero_is_the_limit(kind):
    """|J(0) - J(z)| <= z: the integrand's two factors are at most 1, and fall by at most z."""
    with flint.ctx.workprec(200):
        z = flint.arb(10) ** -20
        assert abs(at_zero(kind) - value(kind, z**2)) < 3 * z


def test_covariogram_at_zero_is_the_integral_of_the_square():
    """Volume of the ball; 16 R³/3 and 2π R⁴ of chords; ∫ (π (R² - x²))² dx = 16 π² R⁵/15."""
    r, pi = flint.fmpq(3, 10), flint.arb.pi()
    wanted = {(2, 0): pi * r**2, (3, 0): 4 * pi * r**3 / 3}
    wanted |= {(2, 1): 16 * r**3 / 3, (3, 1): 2 * pi * r**4, (3, 2): 16 * pi**2 * r**5 / 15}
    for kind in KINDS:
        square = flint.arb(wanted[kind.dim, kind.flat])
        assert (at_zero(kind) * scale(kind, r)).overlaps(square)


@given(y=squares)
def test_disk_by_its_lens(y):
    """Two unit disks at distance 2z share 2 arccos z - 2 z √(1 - z²) (R = 1)."""
    z = exact_ball(y).sqrt()
    lens = 2 * z.acos() - 2 * z * (1 - z**2).sqrt()
    kind = Covariogram(2, 0)
    assert (value(kind, exact_ball(y)) * scale(kind, flint.fmpq(1))).overlaps(lens)


def test_unit_balls():
    """κ_d = π^(d/2)/Γ(d/2 + 1)."""
    for dim in range(4):
        half = flint.arb(dim) / 2
        assert unit_ball(dim).overlaps(flint.arb.pi() ** half / (half + 1).gamma())
