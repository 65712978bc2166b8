"""The whole of Eq. 4 on R^d: routes agree; for jitter it is the torus sum where nothing wraps."""

from fractions import Fraction
from math import factorial, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.balls import flint
from specrate.numerics.equation17.axis_integrals import AxisProblem, solve_axis
from specrate.numerics.equation17.space_integrands import SpaceBall, SpaceGaussian, on_space
from specrate.numerics.equation17.whole_integrals import CERTIFIED, erf_deficit, whole_integral
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

F = Fraction
SAMPLERS = (
    ("random", 3, 9),
    ("jitter", 1, 8),
    ("jitter:2x8", 2, 16),
    ("jitter", 5, 10**25),
    ("latin-hypercube", 2, 16),
    ("latin-hypercube", 7, 10**6),
    ("multi-jitter", 2, 10**12),
    ("multi-jitter", 3, 27),
    ("correlated-multi-jitter", 2, 10**8),
    ("uncorrelated-jitter:1+2", 3, 16),
)


def whole(name, dim, n, integrand, route, digits=15):
    sampler = parse_sampler(name, dim)
    return whole_integral(sampler, sampler.counts_at(n), integrand, route, digits)


def agree(first, second) -> bool:
    gap = abs(F(first.value) - F(second.value))
    return gap <= F(first.error) + F(second.error)


@settings(max_examples=15)  # up to 50 ms each
@given(st.sampled_from(SAMPLERS), st.data())
def test_three_certified_routes_of_the_gaussian(sampler, data):
    width = st.fractions(F(1, 60), F(2), max_denominator=60)
    sigmas = data.draw(st.lists(width, min_size=sampler[1], max_size=sampler[1]))
    found = [whole(*sampler, SpaceGaussian(tuple(sigmas)), r) for r in CERTIFIED]
    assert all(f.is_bound for f in found)
    assert agree(found[0], found[1])
    assert agree(found[0], found[2])


@pytest.mark.parametrize("dim", [1, 2, 3, 10])
def test_fifty_digits_at_1e30(dim):
    gaussian = SpaceGaussian((F(1, 10),) * dim)
    found = [whole("jitter", dim, 10**30, gaussian, r, 50) for r in CERTIFIED]
    for result in found:
        assert agree(found[0], result)
        assert F(result.error) <= F(result.value) * F(10) ** -49


@given(st.integers(2, 40), st.fractions(F(1, 20), F(9, 20), max_denominator=40))
def test_disk_under_jitter_is_the_torus_sum_where_nothing_wraps(n, radius):
    """2R + 1/n <= 1: the images of the covariogram do not meet a cell (Poisson's formula)."""
    sampler, disk = parse_sampler("jitter", 2), SpaceBall(2, radius)
    counts = {"N": n * n, "n": n}
    plane = whole_integral(sampler, counts, disk)
    torus = exact_variance(sampler, counts, parse_integrand(f"disk:radius={radius}", 2))
    with mp.workdps(30):
        gap = abs(mp.mpf(plane.value) - torus.value)
        allowed = mp.mpf(plane.error) + torus.error_bound
        if 2 * radius + F(1, n) <= 1:
            assert gap <= allowed
        else:
            assert gap > allowed


@pytest.mark.parametrize("name", ["jitter", "jitter:25x40"])
@pytest.mark.parametrize("text", ["gaussian:sigma=1/30", "anisotropic-gaussian:sigma=(1/30,1/20)"])
def test_narrow_gaussian_under_jitter_is_the_torus_sum(name, text):
    """Up to what wraps round, exp(−1/(4σ²)) <= exp(−100) of it."""
    sampler, f = parse_sampler(name, 2), parse_integrand(text, 2)
    counts = sampler.counts_at(1000)
    plane = whole_integral(sampler, counts, on_space(f), "closed", 25)
    torus = exact_variance(sampler, counts, f, 25)
    with mp.workdps(30):
        assert abs(mp.mpf(plane.value) / torus.value - 1) < 1e-24


@pytest.mark.parametrize("name", ["latin-hypercube", "multi-jitter", "correlated-multi-jitter"])
def test_others_differ_by_what_the_kernel_has_on_null_sets(name):
    """Torus = integral − S(0)|Ff(0)|² + Σ (N P_S − S)|Ff|², the sum over axes and teeth by hand."""
    from specrate.numerics.equation17.densities import density_array, density_of, expanded
    from specrate.numerics.expected_spectra.spectra import power_array

    sampler, f = parse_sampler(name, 2), parse_integrand("gaussian:sigma=1/15", 2)
    counts = sampler.counts_at(16)
    m = np.stack(np.meshgrid(*[np.arange(-30, 31)] * 2, indexing="ij"), -1).reshape(-1, 2)
    m = m[(m != 0).any(axis=1)]
    density = expanded(density_of(sampler, counts))
    gap = counts["N"] * power_array(sampler, counts, m) - density_array(density, m.astype(float))
    assert np.all(abs(gap[(m % 4 != 0).all(axis=1)]) < 1e-12)  # off axes and teeth none
    null_sets = float(gap @ f.coefficient_power(m))
    plane = counts["N"] * float(whole_integral(sampler, counts, on_space(f)).value)
    torus = counts["N"] * float(exact_variance(sampler, counts, f).value)
    at_zero = float(density.total) * (2 * pi / 225) ** 2
    assert torus == pytest.approx(plane - at_zero + null_sets, rel=1e-10)
    assert abs(torus / plane - 1) > 0.02


def test_what_the_torus_has_may_be_far_from_the_integral():
    """n-rooks: N V of the integral is worse than random, that of the torus falls to the ANOVA."""
    gaussian = SpaceGaussian((F(1, 10),) * 2)
    random = F(whole("random", 2, 16, gaussian, "closed").value)
    rooks = F(whole("latin-hypercube", 2, 16, gaussian, "closed").value)
    assert random < rooks < random * F(16, 15)
    assert float(random) == pytest.approx(pi / 100 / 16, rel=1e-14)


@pytest.mark.parametrize("n", [1, 3, 50])
def test_one_dimension_is_twice_the_axis(n):
    """S^0 has two points. The interval's frequency integral, with cells wider than it too."""
    ball = SpaceBall(1, F(1, 4))
    real, frequencies = (whole("jitter", 1, n, ball, r) for r in ("covariogram", "cartesian"))
    assert agree(real, frequencies)
    axis = solve_axis(AxisProblem(ball, F(n), F(n), 1), 15, "quadrature").value
    assert abs(2 * F(axis.value) - F(real.value)) <= 2 * F(axis.error_bound) + F(real.error)


@given(st.integers(1, 3), st.fractions(F(1, 9), F(2), max_denominator=50), st.integers(1, 40))
def test_cells_of_any_size_against_the_ball(dim, radius, n):
    """Certified, and between 0 and ∫f²: 1 − ∏ sinc² is."""
    found = whole_integral(
        parse_sampler("jitter", dim), {"N": n**dim, "n": n}, SpaceBall(dim, radius), digits=6
    )
    volume = pi ** (dim / 2) / float(mp.gamma(dim / 2 + 1)) * float(radius) ** dim
    assert 0 < float(found.value) < volume / n**dim


def test_the_covariogram_of_the_disk():
    """N = 16, R = 1/4: known to sixteen digits, and N^(3/2) V at N = 1e30."""
    disk = SpaceBall(2, F(1, 4))
    found = whole("jitter", 2, 16, disk, "covariogram", 17)
    assert abs(F(found.value) - F("0.0039930421893162175")) < F(1, 10**19)
    limit = F(whole("jitter", 2, 10**30, disk, "covariogram", 17).value) * 10**45
    assert abs(limit - F("0.2607027165823603")) < F(3, 10**16)


def test_a_regular_grid_is_zero_on_every_route():
    for route in CERTIFIED:
        found = whole("regular", 2, 16, SpaceGaussian((F(1, 10),) * 2), route)
        assert F(found.value) == F(found.error) == 0


@pytest.mark.parametrize("y", [F(1, 10**60), F(1, 7), F(1), F(10**5)])
def test_the_deficit_by_erf(y):
    """Σ_k (−1)^(k+1) y^k/k! 2/((2k + 1)(2k + 2)) for small y, 1 − √(π/y) + 1/y for large y."""
    flint.ctx.prec, before = 100, flint.ctx.prec
    try:
        found = erf_deficit(y)
        assert found.rel_accuracy_bits() > 85
    finally:
        flint.ctx.prec = before
    if y <= 1:
        moments = (F(2, (2 * k + 1) * (2 * k + 2) * factorial(k)) for k in range(1, 20))
        expected = float(-sum(m * (-y) ** k for k, m in enumerate(moments, 1)))
    else:
        expected = 1 - (pi / float(y)) ** 0.5 + 1 / float(y)
    assert float(found) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("route", ["directions", "shells"])
def test_estimates_say_that_they_are(route):
    gaussian = SpaceGaussian((F(1, 10),) * 2)
    found = whole("jitter", 2, 16, gaussian, route)
    assert not found.is_bound
    assert found.route == route
    assert agree(found, whole("jitter", 2, 16, gaussian, "closed"))


@pytest.mark.parametrize(
    ("name", "dim", "integrand", "route", "rule"),
    [
        ("jitter", 2, SpaceBall(3, F(1, 4)), "covariogram", "one dim: got 2"),
        ("jitter", 2, SpaceBall(2, F(1, 4)), "closed", "needs covariogram"),
        ("jitter", 2, SpaceBall(2, F(1, 4)), "cartesian", "needs covariogram"),
        ("jitter", 4, SpaceBall(4, F(1, 4)), "covariogram", "dim <= 3: got"),
        ("jitter", 4, SpaceBall(4, F(1, 4)), "directions", "dim <= 3: got 4"),
        ("jitter", 2, SpaceBall(2, F(1, 4)), "polar", "a route is one of closed"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(name, dim, integrand, route, rule):
    with pytest.raises(InputError) as caught:
        whole(name, dim, 16, integrand, route)
    assert rule in str(caught.value)
    assert "\n" not in str(caught.value)


def test_shells_of_a_tiny_ball_are_refused():
    with pytest.raises(InputError, match="beyond the ball's first zero"):
        whole("random", 1, 16, SpaceBall(1, F(1, 10**9)), "shells")
