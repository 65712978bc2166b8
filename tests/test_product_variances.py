"""Variances of products: closed forms in rationals, relations between samplers, huge N and d."""

from fractions import Fraction
from math import factorial, prod

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import flint, rational
from specrate.numerics.exact_variances.product_variances import product_variance
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Rational, sympy
from strategies import catalogue_names

DIGITS = 25


def found(name, dim, n, text, digits=DIGITS):
    """The variance as a ball, and the N that it holds for."""
    sampler, f = parse_sampler(name, dim), parse_integrand(text, dim)
    counts = sampler.counts_at(n)
    return product_variance(sampler, counts, f.parts, digits), counts


def holds(ball, exact, digits=DIGITS):
    """Whether the ball holds the number and is as narrow as was asked for."""
    before, flint.ctx.prec = flint.ctx.prec, 4000
    try:
        inside = (ball - (exact if isinstance(exact, flint.arb) else rational(exact))).contains(0)
    finally:
        flint.ctx.prec = before
    return inside and ball.rel_accuracy_bits() >= 3.3 * digits


def energy(k):
    """Σ_{m≠0} |f^|² of B_k, from the Bernoulli number: (−1)^(k−1) k!² B_2k/(2k)!."""
    return Fraction(
        (-1) ** (k - 1) * factorial(k) ** 2 * Fraction(str(sympy.bernoulli(2 * k)))
    ) / factorial(2 * k)


def smoothed(k, n):
    """Σ_{m≠0} |f^|² sinc²(m/n) of B_k: the triangle's mean of B_2k({h}), integrated twice."""
    x, j = Rational(1, n), 2 * k + 2
    rise = Fraction(str(sympy.bernoulli(j, x) - sympy.bernoulli(j)))
    scale = Fraction((-1) ** (k - 1) * factorial(k) ** 2 * 2 * n**2, factorial(2 * k) * (j - 1) * j)
    return scale * rise


@given(st.integers(1, 4), st.integers(1, 5), st.integers(2, 9), st.fractions(-3, 3).filter(bool))
def test_closed_forms_of_products(k, dim, n, c):
    """f = ∏(1 + c B_k): random, jitter, Latin hypercube and two blocks, in rationals."""
    s, whole = c**2 * energy(k), n**dim
    strata = c**2 * smoothed(k, n)
    text = f"product:k={k},c={c}"
    total = (1 + s) ** dim - 1
    ball, counts = found("random", dim, n, text)
    assert holds(ball, total / counts["N"])
    ball, counts = found("jitter", dim, whole, text)
    assert counts["N"] == whole
    assert holds(ball, ((1 + s) ** dim - (1 + strata) ** dim) / whole)
    ball, _ = found("latin-hypercube", dim, n, text)
    cross = (n - 1) * ((1 - strata / (n - 1)) ** dim - 1)
    assert holds(ball, (total + cross) / n)


@pytest.mark.parametrize(("k", "t"), [(1, 2), (2, 3), (3, 5)])
def test_closed_form_of_blocks(k, t):
    """Jitter in {1} with N = t² strata and in {2,3} with t × t, shuffled against each other."""
    n, s = t * t, energy(k)
    one = smoothed(k, n)
    two = (1 + smoothed(k, t)) ** 2 - 1
    cross = (n - 1) * ((1 - one / (n - 1)) * (1 - two / (n - 1)) - 1)
    ball, counts = found("uncorrelated-jitter:1+2", 3, n, f"product:k={k}")
    assert counts["N"] == n
    assert holds(ball, ((1 + s) ** 3 - 1 + cross) / n)


@pytest.mark.parametrize("n", [2, 10, 10**30])
def test_a_thousand_dimensions(n):
    """The closed forms at d = 1000, in balls of 4000 bits."""
    before, flint.ctx.prec = flint.ctx.prec, 4000
    try:
        s = 1 + flint.arb(rational(energy(2)))
        t = rational(smoothed(2, n))
        hypercube = s**1000 - 1 + (n - 1) * ((1 - flint.arb(t) / (n - 1)) ** 1000 - 1)
        hypercube /= n
    finally:
        flint.ctx.prec = before
    ball, _ = found("latin-hypercube", 1000, n, "product:k=2")
    assert holds(ball, hypercube)
    additive, _ = found("latin-hypercube", 1000, n, "additive:k=2")
    assert holds(additive, 1000 * (energy(2) - smoothed(2, n)) / n)


ONE_AXIS = ("latin-hypercube", "multi-jitter", "multi-jitter:3x5", "correlated-multi-jitter")


@pytest.mark.parametrize("name", ONE_AXIS)
@pytest.mark.parametrize("text", ["bernoulli:k=2,axes=2", "bernoulli:k=1", "polylog:p=7/3"])
def test_projections_on_an_axis_are_jitter_with_n_strata(name, text):
    ball, counts = found(name, 2, 225, text)
    line, _ = found("jitter", 1, counts["N"], text.partition(",")[0])
    assert ball.overlaps(line)
    assert ball.rel_accuracy_bits() > 80


@pytest.mark.parametrize("name", ["jitter", "latin-hypercube", "multi-jitter", "random"])
def test_additive_functions_have_the_sum_of_the_variances_of_their_terms(name):
    ball, _ = found(name, 3, 27, "additive:k=3")
    axis, _ = found(name, 3, 27, "bernoulli:k=3")
    assert ball.overlaps(3 * axis)
    assert ball.rel_accuracy_bits() > 80


@given(st.data())
def test_against_sums_over_the_lattice(data):
    """inside <= V <= inside + tail, the tail by Parseval: P_S <= 1.

    Power: a Gaussian's tail is below 1e-13 of its energy, so that both bounds all but meet.
    """
    dim = data.draw(st.integers(1, 3))
    name = data.draw(st.sampled_from(catalogue_names(dim)))
    widths = data.draw(
        st.lists(st.sampled_from(["0.12", "1/5", "1/3"]), min_size=dim, max_size=dim)
    )
    sampler = parse_sampler(name, dim)
    f = parse_integrand(f"anisotropic-gaussian:sigma=({','.join(widths)})", dim)
    counts = sampler.counts_at(data.draw(st.integers(2, 60)))
    axis = np.arange(-9, 10)
    m = np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    m = m[(m != 0).any(axis=1)]
    powers = f.coefficient_power(m)
    total = float(f.total(17))
    inside = float(np.sum(powers * np.maximum(power_array(sampler, counts, m), 0)))
    rest = max(0.0, total - float(powers.sum()))
    assert rest < 1e-13 * total
    value = float(product_variance(sampler, counts, f.parts, 17))
    assert inside - 1e-13 * total <= value <= inside + rest + 1e-13 * total


@pytest.mark.parametrize(
    ("name", "text", "n"),
    [
        ("regular", "box:side=(1/4,1/2)", 16),
        ("regular:4x2", "box:side=(1/4,1/2)", 8),
        ("regular", "half-space:side=0.5", 10**30),
    ],
)
def test_a_grid_that_cuts_boxes_into_whole_cells_has_variance_zero(name, text, n):
    ball, _ = found(name, 2, n, text)
    assert ball.is_zero()


@pytest.mark.parametrize("n", [1, 2, 16, 10**12])
def test_a_grid_sees_the_multiples_of_its_sides(n):
    """∏(1 + a_i) − 1 with the energies a_i = s n^(−2k) of the combs."""
    ball, counts = found("regular", 2, n, "product:k=2")
    comb = energy(2) / Fraction(counts["n"]) ** 4
    assert holds(ball, (1 + comb) ** 2 - 1)


def test_variances_far_below_the_rounding_of_the_mean():
    """A grid of 1e150 × 1e150 on a Gaussian: 2 · mean² · 2 exp(−(2πσn)²), 1e-301 digits down."""
    ball, counts = found("regular", 2, 10**300, "gaussian:sigma=0.1")
    before, flint.ctx.prec = flint.ctx.prec, 2100
    try:
        root = 2 * flint.arb.pi() * counts["n"] / 10
        leading = 4 * (2 * flint.arb.pi() / 100) ** 2 * (-(root**2)).exp()
        assert leading.overlaps(ball)
    finally:
        flint.ctx.prec = before
    assert ball.rel_accuracy_bits() > 80


@pytest.mark.parametrize("name", catalogue_names(2))
@pytest.mark.parametrize("power", [2, 30, 300])
def test_digits_are_those_of_many_more(name, power):
    """At N = 10^power, on every family of the plane."""
    n = 10**power
    for text in ("box", "gaussian:sigma=0.01", "anisotropic-gaussian", "polylog", "product:k=3"):
        short, _ = found(name, 2, n, text, 15)
        long, _ = found(name, 2, n, text, 60)
        assert short.overlaps(long)
        assert long.is_exact() or long.rel_accuracy_bits() > 198


def test_blocks_of_one_axis_are_the_latin_hypercube():
    """A product of many blocks is not multiplied out, and no deep recursion follows it."""
    dim = 120
    blocks, _ = found("uncorrelated-jitter:" + "+".join("1" * dim), dim, 50, "product:k=1,c=1/9")
    whole, _ = found("latin-hypercube", dim, 50, "product:k=1,c=1/9")
    assert blocks.overlaps(whole)
    assert blocks.rel_accuracy_bits() > 80


def test_unequal_strata():
    """3 × 7 cells: ((1+s)² − (1+τ(3))(1+τ(7)))/21."""
    ball, _ = found("jitter:3x7", 2, 21, "product:k=1")
    parts = prod(1 + smoothed(1, n) for n in (3, 7))
    assert holds(ball, ((1 + energy(1)) ** 2 - parts) / 21)
