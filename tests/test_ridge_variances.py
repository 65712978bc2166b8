"""Variances of ridges: against sums along the ridge, closed forms and functions of one axis."""

from fractions import Fraction
from math import factorial, gcd, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics import variance
from specrate.numerics.balls import flint, rational
from specrate.numerics.exact_variances.product_variances import product_variance
from specrate.numerics.exact_variances.ridge_variances import ridge_variance
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.integrands.ridge import Ridge
from specrate.numerics.integrands.spline import cosine_sum
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler
from strategies import catalogue_names


def found(name, ridge, n, digits=25):
    """The variance as a ball, and the counts that it holds for."""
    sampler = parse_sampler(name, ridge.dim)
    counts = sampler.counts_at(n)
    return ridge_variance(sampler, counts, ridge, digits), counts


@given(st.data())
def test_against_the_sum_along_the_ridge(data):
    """inside <= V <= inside + tail over |j| > 2000, where P_S <= 1; the tail is below 1e-18."""
    dim = data.draw(st.integers(1, 4))
    k = data.draw(st.lists(st.integers(-3, 3), min_size=dim, max_size=dim).filter(any))
    ridge, reach = Ridge(tuple(k), data.draw(st.integers(3, 5))), 2000
    name = data.draw(st.sampled_from(catalogue_names(dim)))
    sampler = parse_sampler(name, dim)
    counts = sampler.counts_at(data.draw(st.integers(2, 100)))
    j = np.arange(1, reach + 1)
    m = j[:, None] * np.array(k)
    energy = 2 * ridge.coefficient_power(m)
    inside = float(np.sum(energy * np.maximum(power_array(sampler, counts, m), 0)))
    b = ridge.b
    tail = 2 * (factorial(b) / (2 * pi) ** b) ** 2 / ((2 * b - 1) * reach ** (2 * b - 1))
    value = float(ridge_variance(sampler, counts, ridge, 17))
    rounding = 1e-12 * inside + 1e-14 * float(np.sum(energy)) / counts["N"]
    assert tail < 1e-15 * float(np.sum(energy))
    assert inside - rounding <= value <= inside + tail + rounding


@pytest.mark.parametrize("name", catalogue_names(2))
@pytest.mark.parametrize("n", [2, 36, 10**30])
def test_a_ridge_along_an_axis_is_a_function_of_that_axis(name, n):
    ridge, f = Ridge((0, 1), 2), parse_integrand("bernoulli:k=2,axes=2", 2)
    ball, counts = found(name, ridge, n)
    sampler = parse_sampler(name, 2)
    assert ball.overlaps(product_variance(sampler, counts, f.parts, 25))
    assert ball.rel_accuracy_bits() > 80


@given(st.integers(1, 3), st.integers(1, 3), st.integers(1, 4), st.integers(1, 10**40))
def test_jitter_along_a_diagonal_in_closed_form(p, q, b, n):
    """sinc²(jp/n) sinc²(jq/n) as a fourfold difference of K_(b+2), written out by hand."""
    ball, counts = found("jitter", Ridge((p, -q), b), n**2)
    n = counts["n"]
    x, y = flint.fmpq(p, n), flint.fmpq(q, n)
    lobes = (
        sum(
            weight * cosine_sum(b + 2, h)
            for weight, h in (
                (4, 0 * x),
                (-4, x),
                (-4, y),
                (2, x + y),
                (2, x - y),
            )
        )
        / (x * y) ** 2
    )
    exact = factorial(b) ** 2 * (cosine_sum(b, 0 * x) - lobes) / n**2
    before, flint.ctx.prec = flint.ctx.prec, 3000
    try:
        assert (ball - exact).contains(0)
    finally:
        flint.ctx.prec = before
    assert ball.rel_accuracy_bits() > 80


@pytest.mark.parametrize(("k", "n"), [((1, 1), 64), ((2, 3), 36), ((4, -6), 10**20), ((5, 0), 100)])
def test_a_grid_sees_the_multiples_that_lie_on_it(k, n):
    """[n | j k_i] for both i: j is a multiple of n/gcd(n, k_1, k_2), and V its share of Σ."""
    ridge = Ridge(k, 2)
    ball, counts = found("regular", ridge, n)
    step = counts["n"] // gcd(counts["n"], *k)
    exact = 4 * cosine_sum(2, flint.fmpq(0)) / flint.fmpq(step) ** 4
    assert (ball - exact).contains(0)
    assert ball.rel_accuracy_bits() > 80


def test_eight_coordinates_under_a_latin_hypercube():
    """The interaction of all eight survives: N·V -> the whole energy, at N = 1e30."""
    ridge = Ridge(tuple(range(1, 9)), 2)
    ball, counts = found("latin-hypercube", ridge, 10**30)
    assert float(ball * counts["N"]) == pytest.approx(float(rational(Fraction(1, 180))), rel=1e-15)


def test_too_many_waves_are_refused():
    with pytest.raises(InputError, match="at most 100000 waves"):
        found("latin-hypercube", Ridge(tuple(7**i for i in range(11)), 2), 10**6)


@pytest.mark.parametrize(
    ("name", "b"), [("box-dpp", 1), ("difference-jitter", 2), ("cloaked:3/2", 1)]
)
def test_other_shapes_go_by_the_lattice(name, b):
    """Along k = 3 in 1D against its first J = 20 000 waves; what is left is below J^(1 − 2b)."""
    found = variance(name, f"ridge:k=3,b={b}", 1, 16)
    sampler = parse_sampler(name, 1)
    j = np.arange(1, 20_001)
    power = power_array(sampler, sampler.counts_at(16), 3 * j[:, None])
    direct = 2 * float(np.sum(power * (factorial(b) / (2 * np.pi * j) ** b) ** 2))
    assert found.method == "lattice"
    assert abs(float(found.value.value) - direct) < 0.3 / 20_000 ** (2 * b - 1)
    assert float(found.value.error_bound) < 1e-6 * direct


def test_other_shapes_beyond_the_lattice_are_refused():
    with pytest.raises(InputError, match="must have --dim of at most 3"):
        variance("box-dpp", "ridge:k=(1,0,0,0)", 4, 16)
