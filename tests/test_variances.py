"""Exact variances: against direct sums over the lattice, closed forms and Monte Carlo."""

from fractions import Fraction
from math import pi, sqrt

import numpy as np
import pytest
from specrate.numerics.generators import generate
from specrate.numerics.integrands.ball import Ball
from specrate.numerics.integrands.bernoulli import Bernoulli
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.moments import Moments, estimates, shifted, update
from specrate.numerics.spectra import power_array
from specrate.numerics.streams import stream
from specrate.numerics.variances import exact_variance
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

SAMPLERS = (
    ("random", 2, 16),
    ("regular", 2, 16),
    ("regular:2x8", 2, 16),
    ("jitter", 1, 7),
    ("jitter", 2, 16),
    ("jitter:2x8", 2, 16),
    ("latin-hypercube", 2, 16),
    ("multi-jitter", 1, 7),
    ("multi-jitter", 2, 16),
    ("multi-jitter:3x5", 2, 15),
    ("correlated-multi-jitter", 2, 16),
    ("correlated-multi-jitter:3x5", 2, 15),
    ("jitter", 3, 8),
    ("multi-jitter", 3, 8),
    ("uncorrelated-jitter:1+2", 3, 9),
)
INTEGRANDS = (
    "product:k=1",
    "product:k=3,c=2",
    "bernoulli:k=1",
    "bernoulli:k=2",
    "gaussian:sigma=0.1",
    "gaussian:sigma=0.04",
    "anisotropic-gaussian",
    "box:side=0.3",
    "box:side=1/4",
)
COMBS = ("regular", "correlated-multi-jitter")


def lattice_box(dim):
    half = {1: 5_000, 2: 60, 3: 12}[dim]
    axis = np.arange(-half, half + 1)
    m = np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    return m[(m != 0).any(axis=1)]


@pytest.mark.parametrize("text", INTEGRANDS)
@pytest.mark.parametrize(("name", "dim", "n"), SAMPLERS)
def test_product_variance_lies_between_the_bounds_of_a_lattice_sum(name, dim, n, text):
    """inside <= V <= inside + tail sup P, the tail by Parseval; sup P is 1 with combs, else 2/N.

    N·P_S of the samplers without combs lies below 1 + 2/(n - 1), n >= 2 rows: multi-jitter.
    """
    if dim == 1 and text.startswith("anisotropic"):
        return
    sampler, f = parse_sampler(name, dim), parse_integrand(text, dim)
    counts = sampler.counts_at(n)
    assert counts["N"] == n
    exact = exact_variance(sampler, counts, f)
    m = lattice_box(dim)
    energy = f.coefficient_power(m)
    inside = float(np.sum(energy * np.maximum(power_array(sampler, counts, m), 0)))
    tail = max(0.0, float(f.total(17)) - float(energy.sum()))
    largest = 1.0 if name.startswith(COMBS) else 2 / n
    value = float(exact.value)
    assert exact.method == "product"
    rounding = 1e-11 * float(f.total(17))
    assert inside - rounding <= value <= inside + tail * largest + rounding
    if text.startswith("gaussian") and dim < 3:
        assert tail * largest < 1e-9 * float(f.total(17))  # the bounds all but meet


@pytest.mark.parametrize("n", [1, 2, 3, 10, 1000])
def test_jitter_on_a_sawtooth(n):
    """1D jitter x B_1: N V = 1/(6N) - 1/(12N^2), the stratum with the jump giving 1/6 - 1/(6N)."""
    sampler, f = parse_sampler("jitter", 1), Bernoulli(1, 1, (1,))
    value = exact_variance(sampler, sampler.counts_at(n), f).value
    assert float(n * value) == pytest.approx(1 / (6 * n) - 1 / (12 * n**2), rel=1e-14)


@pytest.mark.parametrize("n", [1, 4, 9])
def test_random_points_have_the_variance_over_n(n):
    sampler = parse_sampler("random", 2)
    for text in ("box:side=0.3", "gaussian", "product:k=2"):
        f = parse_integrand(text, 2)
        value = exact_variance(sampler, sampler.counts_at(n), f).value
        assert float(value) == pytest.approx(float(f.total(17)) / n, rel=1e-14)


@pytest.mark.parametrize("k", [1, 2, 5])
def test_a_shifted_grid_sees_only_multiples_of_its_side(k):
    """1D: V of B_k is its total times n^(-2k)."""
    sampler, f = parse_sampler("regular", 1), Bernoulli(1, k, (1,))
    value = exact_variance(sampler, {"N": 6, "n": 6}, f).value
    assert float(value) == pytest.approx(float(f.total(17)) / 6 ** (2 * k), rel=1e-13)


def test_a_smooth_integrand_under_jitter_has_its_gradient_as_constant():
    """N V -> E |grad f|^2/(12 n^2): the smooth limit, to the next order 1/n^2."""
    sampler, f = parse_sampler("jitter", 2), Bernoulli(2, 6, (1,))
    gradient = 36 * float(Bernoulli(2, 5, (1,)).total(17))
    counts = sampler.counts_at(200**2)
    value = counts["N"] * exact_variance(sampler, counts, f).value
    assert float(value) == pytest.approx(gradient / (12 * 200**2), rel=5 * (2 * pi / 200) ** 2)


@pytest.mark.parametrize(
    ("name", "dim", "n", "text"),
    [
        ("jitter", 2, 16, "disk:radius=0.25"),
        ("latin-hypercube", 2, 16, "disk"),
        ("multi-jitter", 2, 25, "disk"),
        ("jitter", 3, 27, "ball"),
        ("correlated-multi-jitter", 2, 16, "box:side=0.3"),
        ("multi-jitter:3x5", 2, 15, "anisotropic-gaussian"),
        ("regular:2x8", 2, 16, "product:k=1"),
        ("uncorrelated-jitter:1+2", 3, 25, "product:k=2"),
    ],
)
def test_monte_carlo(name, dim, n, text):
    """Within 5.5 standard errors and the bound: false alarm 4e-8 for 20 000 normal errors.

    Power: twice the variance, or half of it, is more than 20 standard errors away.
    """
    sampler, f = parse_sampler(name, dim), parse_integrand(text, dim)
    counts, moments = sampler.counts_at(n), Moments()
    exact = exact_variance(sampler, counts, f, box=250_000)
    for part in range(10):
        rng = stream(81, part)
        points = shifted(generate(sampler, counts, 2000, rng), rng.random((2000, dim)))
        moments = update(moments, estimates(f, points) - float(f.mean(17)))
    error = 5.5 * moments.mse_error + float(exact.error_bound)
    assert abs(moments.mse - float(exact.value)) < error
    assert error < 0.3 * float(exact.value)


def test_disk_under_jitter():
    """The value was computed from the covariogram of the disk, not from its spectrum."""
    sampler, f = parse_sampler("jitter", 2), Ball(2, Fraction(1, 4))
    exact = exact_variance(sampler, sampler.counts_at(16), f)
    assert exact.method == "lattice"
    assert abs(float(exact.value) - 0.0039930421893162175) <= float(exact.error_bound)
    # Beyond a square of half-width K the disk has the energy R/(pi K) (2 sqrt(2)/pi), in the mean.
    half, tail = 707, 2 * sqrt(2) / pi * 0.25 / (pi * 707)
    assert (2 * half + 1) ** 2 < 2_010_000
    assert float(exact.error_bound) == pytest.approx(tail / 16, rel=0.02)


@pytest.mark.parametrize("k", [1, 2])
def test_very_many_points(k):
    """N = 1e24 in 2D. On one axis n = 1e12 strata: for k = 1 N V = 1/(6n) - 1/(12n^2)."""
    n = 10**12
    sampler = parse_sampler("jitter", 2)
    counts = sampler.counts_at(n * n)
    assert counts == {"N": n * n, "n": n}
    exact = exact_variance(sampler, counts, Bernoulli(2, k, (1,)))
    # k = 2: B_2' = 2 B_1 has E (B_2')^2 = 1/3, hence N V -> 1/(36 n^2)
    wanted = {1: 1 / (6 * n), 2: 1 / (36 * n**2)}[k]
    assert float(exact.value) * n**2 == pytest.approx(wanted, rel=1e-11)
    assert 0 < exact.error_bound < 1e-14 * exact.value


def test_digits_agree():
    sampler, f = parse_sampler("multi-jitter", 2), parse_integrand("gaussian", 2)
    coarse, fine = (exact_variance(sampler, sampler.counts_at(64), f, d) for d in (15, 60))
    assert abs(coarse.value - fine.value) <= coarse.error_bound + fine.error_bound
    assert fine.error_bound < 1e-55 * fine.value


def test_what_has_no_exact_variance_is_refused():
    disk = parse_integrand("disk", 2)
    with pytest.raises(InputError, match="without combs: got regular"):
        exact_variance(parse_sampler("regular", 2), {"N": 4, "n": 2}, disk)
    with pytest.raises(InputError, match="with --dim 4"):
        exact_variance(parse_sampler("random", 4), {"N": 4}, parse_integrand("ball", 4))
    with pytest.raises(InputError, match="with a spectrum: got isotropic"):
        exact_variance(parse_sampler("isotropic:2", 2), {"N": 4}, disk)
