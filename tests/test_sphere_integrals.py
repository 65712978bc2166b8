"""Sphere times radius: per direction and per shell, within its error of the certified value."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.equation17.densities import density_of
from specrate.numerics.equation17.space_integrands import SpaceBall, SpaceGaussian
from specrate.numerics.equation17.sphere_integrals import (
    ball_directions,
    ball_shells,
    gaussian_directions,
    gaussian_shells,
)
from specrate.numerics.equation17.whole_integrals import whole_integral
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

F = Fraction
SAMPLERS = (
    ("random", 2, 9),
    ("jitter", 1, 8),
    ("jitter:2x8", 2, 16),
    ("jitter", 3, 64),
    ("latin-hypercube", 2, 16),
    ("multi-jitter", 2, 16),
    ("correlated-multi-jitter", 2, 16),
)


def case(name, dim, n, integrand):
    """N, the density and N times the certified value."""
    sampler = parse_sampler(name, dim)
    counts = sampler.counts_at(n)
    exact = whole_integral(sampler, counts, integrand, "covariogram", 20)
    return density_of(sampler, counts), float(F(exact.value) * counts["N"])


@settings(max_examples=12)  # up to 0.2 s each
@given(st.sampled_from(SAMPLERS), st.data())
def test_gaussian_directions(sampler, data):
    width = st.fractions(F(1, 15), F(1), max_denominator=15)
    sigmas = data.draw(st.lists(width, min_size=sampler[1], max_size=sampler[1]))
    gaussian = SpaceGaussian(tuple(sigmas))
    density, exact = case(*sampler, gaussian)
    found = gaussian_directions(density, gaussian)
    assert abs(found.value - exact) <= found.error
    assert found.error < 1e-6 * abs(exact)


@settings(max_examples=12)
@given(st.sampled_from(SAMPLERS), st.fractions(F(1, 15), F(1), max_denominator=15))
def test_gaussian_shells(sampler, sigma):
    """Eq. 6 with the factor |S^(d−1)|: one radial spectrum, the integrand's, is enough."""
    gaussian = SpaceGaussian((sigma,) * sampler[1])
    density, exact = case(*sampler, gaussian)
    found = gaussian_shells(density, gaussian)
    assert abs(found.value - exact) <= found.error
    assert found.error < 1e-6 * abs(exact)


@pytest.mark.parametrize("sampler", [s for s in SAMPLERS if s[1] < 3])
def test_ball_directions(sampler):
    ball = SpaceBall(sampler[1], F(2, 7) + F(1, 5) * (sampler[0] == "jitter:2x8"))
    density, exact = case(*sampler, ball)
    found = ball_directions(density, ball)
    assert abs(found.value - exact) <= found.error
    assert found.error < 1e-11 * exact


def test_ball_directions_in_three_dimensions():
    ball = SpaceBall(3, F(1, 3))
    density, exact = case("jitter", 3, 64, ball)
    found = ball_directions(density, ball, 1e-5)
    assert abs(found.value - exact) <= found.error
    assert found.error < 1e-4 * exact


@pytest.mark.parametrize(
    ("name", "dim", "n"),
    [("random", 2, 4), ("jitter", 1, 3), ("jitter", 2, 16), ("latin-hypercube", 2, 4)],
)
def test_ball_shells(name, dim, n):
    """By a cut with a bounded tail: seven digits."""
    ball = SpaceBall(dim, F(1, 4))
    density, exact = case(name, dim, n, ball)
    found = ball_shells(density, ball)
    assert abs(found.value - exact) <= found.error
    assert found.error < 2e-7 * exact


def test_ball_shells_in_three_dimensions():
    ball = SpaceBall(3, F(2, 5))
    density, exact = case("jitter", 3, 8, ball)
    found = ball_shells(density, ball)
    assert abs(found.value - exact) <= found.error
    assert found.error < 1e-6 * exact


@pytest.mark.parametrize("n", [10**6, 10**30])
def test_directions_at_any_n(n):
    """Disk of radius 1/4: N^(3/2) V → 0.26070..., twelve digits at any N."""
    disk, narrow = SpaceBall(2, F(1, 4)), SpaceGaussian((F(1, 10), F(1, 30)))
    for integrand, sums in ((disk, ball_directions), (narrow, gaussian_directions)):
        density, exact = case("jitter", 2, n, integrand)
        found = sums(density, integrand)
        assert abs(found.value - exact) <= found.error < 1e-11 * exact


def test_what_has_no_route_is_refused():
    jitter = density_of(parse_sampler("jitter", 2), {"N": 4, "n": 2})
    with pytest.raises(InputError, match="radial integrand"):
        gaussian_shells(jitter, SpaceGaussian((F(1), F(2))))
    with pytest.raises(InputError, match="diagonal of a cell"):
        ball_directions(jitter, SpaceBall(2, F(1, 3)))
    large = density_of(parse_sampler("jitter", 2), {"N": 10**12, "n": 10**6})
    with pytest.raises(InputError, match="at most 1500000 nodes"):
        ball_shells(large, SpaceBall(2, F(1, 3)))
