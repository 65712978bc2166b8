"""Power of a function against shapes: plain sums with their tails, exact sums, variances."""

from fractions import Fraction
from math import log

import numpy as np
import pytest
from specrate.numerics.balls import exact_ball, flint
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.expected_spectra.shape_arrays import shape_arrays
from specrate.numerics.expected_spectra.shape_sums import shape_sum
from specrate.numerics.integrands.bernoulli import bernoulli_factor
from specrate.numerics.integrands.box import interval
from specrate.numerics.integrands.gaussian import GaussianFactor
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.integrands.polylog import PolylogFactor
from specrate.numerics.integrands.spline import SplineFactor
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler
from specrate.theory.shapes import DIFFERENCE, SINC2, TENT, stretched

HALF = Fraction(1, 2)
FACTORS = {
    "B_1": bernoulli_factor(Fraction(0), 1, Fraction(1)),
    "1 + B_2": bernoulli_factor(Fraction(1), 2, Fraction(1)),
    "interval": interval(Fraction(3, 10)),
    "three knots": SplineFactor(
        Fraction(2),
        2,
        ((Fraction(1), Fraction(1, 3)), (Fraction(-2), HALF), (HALF, Fraction(1, 7))),
    ),
    "polylog": PolylogFactor(Fraction(5, 4)),
    "Gaussian": GaussianFactor(Fraction(1, 10)),
    "narrow Gaussian": GaussianFactor(Fraction(1, 500)),
}
SHAPES = {
    "tent": [(TENT, 1)],
    "sinc² tent": [(SINC2, 2), (TENT, 1)],
    "difference": [(DIFFERENCE, 1)],
    "cloaked:1/2": [(SINC2, 1), (stretched(HALF), 1)],
    "cloaked:2": [(SINC2, 1), (stretched(Fraction(2)), 1)],
}


def plain_sum(factor, shapes, last=200_000):
    """2 Σ |f^(m)|² ∏ g(m/n) up to |m| = last in doubles, and a bound on the rest."""
    m = np.arange(1, last + 1)
    terms = factor.power(m)
    for shape, n in shapes:
        terms = terms * shape_arrays(shape, m, n)[0]
    # |f^|² falls as m^−5/4 or faster and the shapes, unless 0, as m^−2 or faster.
    rest = 2 * last * abs(factor.power(m[-1:])[0]) * max(n for _, n in shapes) ** 2 / last**2
    return 2 * float(np.sum(terms[::-1])), rest


@pytest.mark.parametrize("name", FACTORS)
@pytest.mark.parametrize("shapes", SHAPES)
def test_sums_are_plain_sums(name, shapes):
    n = 2 if name in ("1 + B_2", "polylog") else 60
    held = [(shape, n * k) for shape, k in SHAPES[shapes]]
    with flint.ctx.workprec(70):
        ball = shape_sum(FACTORS[name], held)
    expected, rest = plain_sum(FACTORS[name], held)
    assert ball.rad() < 1e-12 * abs(ball)
    assert float(ball) == pytest.approx(expected, rel=1e-12, abs=rest)


@pytest.mark.parametrize("n", [1, 3, 10**6, 10**30])
@pytest.mark.parametrize("name", ["B_1", "1 + B_2", "interval", "three knots"])
def test_sinc_squared_is_the_exact_sum_of_splines(name, n):
    with flint.ctx.workprec(300):
        found = shape_sum(FACTORS[name], [(SINC2, n)])
        assert abs(found - FACTORS[name].power_sum(count=n)) < 1e-80


@pytest.mark.parametrize("name", ["polylog", "Gaussian", "narrow Gaussian"])
def test_sinc_squared_by_rays_is_that_of_the_integrand(name):
    with flint.ctx.workprec(120):
        for n in (3, 10**6):
            found = shape_sum(FACTORS[name], [(SINC2, n)])
            assert abs(found / FACTORS[name].power_sum(count=n) - 1) < 1e-18


def test_differences_against_splines_are_rational():
    """Difference jitter on B_1, one jump with C(0) − C(h) = |h|(1 − |h|)/2: N² Var tends to

    (E|T| + 2E|T + 1| − 2E|T' + 1|)/2 = (7/15 + 2 · 61/60 − 2 · 25/24)/2 = 5/24 up to O(1/N), with
    T = u_1 − u_2 + u_3 − u_4 and T' = u_1 − 2u_2 + u_3.
    """
    with flint.ctx.workprec(400):
        limit = flint.arb(flint.fmpq(5, 24))
        for n in (10**6, 10**30):
            left = FACTORS["B_1"].power_sum() - shape_sum(FACTORS["B_1"], [(DIFFERENCE, n)])
            assert abs(left * n - limit) < flint.arb(1) / n
            assert left.rad() < 1e-100


def test_one_stratum_leaves_nothing():
    for shape in (TENT, SINC2, DIFFERENCE):
        for factor in FACTORS.values():
            assert shape_sum(factor, [(shape, 1)]) == 0


def test_what_cannot_be_summed():
    with pytest.raises(InputError, match="a tent must stand alone"):
        shape_sum(FACTORS["B_1"], [(TENT, 3), (stretched(HALF), 3)])
    with pytest.raises(InputError, match="a tent must stand alone"):
        shape_sum(FACTORS["B_1"], [(TENT, 3), (TENT, 4)])
    with pytest.raises(InputError, match="splines, polylogarithms and Gaussians: got"):
        shape_sum(object(), [(TENT, 3)])


@pytest.mark.parametrize(
    ("sampler", "dim", "integrand"),
    [
        ("box-dpp", 1, "polylog:p=5/2"),
        ("box-dpp", 2, "product:k=2"),
        ("box-dpp:2x5", 2, "gaussian:sigma=0.1"),
        ("cloaked:3/2", 1, "bernoulli:k=2"),
        ("cloaked:1/2", 2, "additive:k=2"),
        ("difference-jitter", 1, "gaussian:sigma=0.2"),
        ("difference-jitter", 1, "bernoulli:k=3"),
    ],
)
def test_variances_are_lattice_sums(sampler, dim, integrand):
    found = parse_sampler(sampler, dim)
    f, counts = parse_integrand(integrand, dim), found.counts_at(40)
    exact = exact_variance(found, counts, f, method="product")
    lattice = exact_variance(found, counts, f, method="lattice", box=100_000)
    assert exact.error_bound < 1e-14 * exact.value
    assert abs(exact.value - lattice.value) <= exact.error_bound + lattice.error_bound
    assert lattice.error_bound < 1e-5 * lattice.value


def test_the_logarithm_of_box_dpp():
    """On B_1, q = b = 1: 2π² N² V = Σ_{m<N} 1/m + N Σ_{m>=N} 1/m² = ln N + γ + 1 + O(N^-2)."""
    found, f = parse_sampler("box-dpp", 1), parse_integrand("bernoulli:k=1", 1)
    for n in (10**6, 10**30):
        value = float(exact_variance(found, found.counts_at(n), f).value) * n**2
        expected = (log(n) + 1 + np.euler_gamma) / (2 * np.pi**2)
        assert value == pytest.approx(expected, rel=1e-11)


def test_a_variance_at_n_of_thirty_digits():
    """Cloaked lattices, β = 1/2, on B_2: N^(3/2) V → Σ |m|^(1/2) |f^(m)|² = 8 ζ(7/2)/(2π)⁴."""
    found = parse_sampler("cloaked:1/2", 1)
    value = exact_variance(found, found.counts_at(10**30), parse_integrand("bernoulli:k=2", 1))
    with flint.ctx.workprec(60):
        limit = 8 * exact_ball(Fraction(7, 2)).zeta() / (2 * flint.arb.pi()) ** 4
        assert float(value.value) * 1e45 == pytest.approx(float(limit), rel=1e-13)
