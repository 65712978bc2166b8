"""Lattice sums: their bounds hold against closed forms, and so do the assumptions they rest on."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import exact_ball, flint
from specrate.numerics.exact_variances.lattice_variances import (
    BESSEL_ROUNDING,
    POWER_ROUNDING,
    ROUNDING,
    envelope,
    lattice_variance,
)
from specrate.numerics.exact_variances.product_variances import product_variance
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.expected_spectra.spectrum_balls import scaled_power_ball
from specrate.numerics.integrands.ball import Ball
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler
from strategies import catalogue_samplers

TEXTS = ("box:side=0.3", "gaussian:sigma=0.1", "product:k=2", "bernoulli:k=1", "product:k=3,c=2")


@given(data=st.data(), dim=st.integers(1, 2), text=st.sampled_from(TEXTS))
def test_products_lie_within_the_bound(data, dim, text):
    sampler = data.draw(catalogue_samplers(dim))
    assert sampler.counts_at is not None
    counts = sampler.counts_at(data.draw(st.integers(1, 60)))
    f = parse_integrand(text, dim)
    found = lattice_variance(sampler, counts, f, 10_000)
    assert found.overlaps(product_variance(sampler, counts, f.parts, 20))


@pytest.mark.parametrize(
    ("name", "text", "bound"),
    [
        ("jitter", "product:k=2", 1e-10),
        ("jitter", "box:side=0.3", 1e-6),
        ("latin-hypercube", "gaussian:sigma=0.1", 1e-10),
        ("multi-jitter", "bernoulli:k=1", 1e-5),
        ("regular", "product:k=2", 1e-4),
        ("correlated-multi-jitter", "product:k=2", 1e-7),
    ],
)
def test_bounds_are_narrow(name, text, bound):
    sampler, f = parse_sampler(name, 2), parse_integrand(text, 2)
    assert sampler.counts_at is not None
    found = lattice_variance(sampler, sampler.counts_at(16), f, 250_000)
    assert found.rad() < bound * found.mid()


def test_bounds_shrink_with_the_box():
    """Jitter on a disk: energy beyond H falls as 1/H, the range of N·P_S there as 1/H²."""
    sampler, f = parse_sampler("jitter", 2), Ball(2, Fraction(1, 4))
    small, large = (
        lattice_variance(sampler, {"N": 16, "n": 4}, f, box) for box in (101**2, 801**2)
    )
    assert float(small.rad() / large.rad()) == pytest.approx(8.0**3, rel=0.2)
    assert small.overlaps(large)


def exact_power(f: Ball, m) -> tuple[object, object]:
    """|f^(m)|² of the ball in ball arithmetic, and x = 2πR|m|."""
    radius, rho = exact_ball(f.radius), flint.arb(sum(int(k) ** 2 for k in m)).sqrt()
    x = 2 * flint.arb.pi() * radius * rho
    return (radius / rho) ** f.dim * x.bessel_j(flint.arb(f.dim) / 2) ** 2, x


powers_of_ten = st.integers(0, 6).flatmap(lambda e: st.integers(10**e, 10 ** (e + 1)))


@given(
    dim=st.integers(1, 3),
    radius=st.one_of(
        st.fractions(Fraction(1, 1000), Fraction(499, 1000), max_denominator=1000),
        st.sampled_from([Fraction(1, 10**9), Fraction(1, 2) - Fraction(1, 10**12)]),
    ),
    sizes=st.lists(powers_of_ten, min_size=3, max_size=3),
)
def test_ball_spectra_in_double_precision(dim, radius, sizes):
    """The envelope, and the rounding below 10 + x units of it, that lattice sums assume."""
    f, m = Ball(dim, radius), np.array(sizes[:dim])
    with flint.ctx.workprec(200):
        power, x = exact_power(f, m)
        bound = float(envelope(dim, float(radius), np.array([np.linalg.norm(m)]))[0])
        assert power < bound * (1 + flint.arb(10) ** -12)
        error = abs(power - flint.arb(float(f.coefficient_power(m[None])[0])))
        assert error < BESSEL_ROUNDING * (10 + float(x)) * bound


@given(data=st.data(), dim=st.integers(1, 2))
def test_spectra_in_double_precision(data, dim):
    """A hundredth of ROUNDING is what the sum itself may take: it adds up to 2^21 numbers."""
    sampler = data.draw(catalogue_samplers(dim))
    assert sampler.counts_at is not None
    counts = sampler.counts_at(data.draw(st.integers(1, 10**6)))
    m = data.draw(st.lists(st.integers(-2000, 2000), min_size=dim, max_size=dim).filter(any))
    with flint.ctx.workprec(300):
        exact = scaled_power_ball(sampler, counts, m) / counts["N"]
        found = flint.arb(float(power_array(sampler, counts, np.array([m]))[0]))
        assert abs(found - exact) <= 0.5 * ROUNDING * exact


@pytest.mark.parametrize("text", TEXTS)
def test_totals_in_double_precision(text):
    """d = 1, where the energy beyond 10^6 is below 1e-6 of the total and bounded by 1/m²."""
    f, half = parse_integrand(text, 1), 10**6
    m = np.arange(1, half + 1)[:, None]
    energy = 2 * float(f.coefficient_power(m).sum())
    total = float(f.total(20))
    tail = 2 * float((f.coefficient_power(m[half // 2 :]) * m[half // 2 :, 0] ** 2).max()) / half
    assert total - tail - POWER_ROUNDING * total <= energy <= total * (1 + POWER_ROUNDING)


def test_what_is_refused():
    with pytest.raises(InputError, match="at most 3: got 4"):
        lattice_variance(parse_sampler("random", 4), {"N": 4}, Ball(4, Fraction(1, 4)))
