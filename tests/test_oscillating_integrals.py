"""The frequency integral of J² against jitter: polynomials for odd d, 3F2, logarithms, any b."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.balls import certified, exact_ball, flint
from specrate.numerics.equation17.oscillating_integrals import ball_axis_integral

F = Fraction
ratios = st.fractions(F(1, 50), F(5), max_denominator=60)


@pytest.fixture(autouse=True)
def precise():
    """What the tests compare with has 250 bits; the integrals choose their own precision."""
    flint.ctx.prec, before = 250, flint.ctx.prec
    yield
    flint.ctx.prec = before


def triangle_moment(power):
    """E τ^p for the density 2(1 − τ) on 0 < τ < 1."""
    return F(2, (power + 1) * (power + 2))


def integral(dim, kappa, ratio, digits=12):
    return certified(lambda: ball_axis_integral(dim, kappa, ratio), digits)


@settings(max_examples=8)  # 10 to 60 ms each
@given(ratios)
def test_interval(b):
    """d = 1: E min(bτ, 1) = b/3, and 1 − c + c²/3 with c = 1/b where b >= 1."""
    exact = b / 3 if b <= 1 else 1 - 1 / b + 1 / (3 * b**2)
    assert integral(1, 0, b).overlaps(exact_ball(exact))


@settings(max_examples=8)
@given(ratios)
def test_ball_in_three_dimensions(b):
    """d = 3: E G(bτ), G = z − 2z³/3 below z = 1 and 1/3 beyond."""
    if b <= 1:
        exact = b * triangle_moment(1) - F(2, 3) * b**3 * triangle_moment(3)
    else:
        c = 1 / b
        pieces = [c**2 - F(2, 3) * c**3, 2 * (c**4 / 4 - c**5 / 5)]  # ∫_0^c 2(1 − τ) τ^p dτ
        exact = b * pieces[0] - F(2, 3) * b**3 * pieces[1] + (1 - c) ** 2 / 3
    assert integral(3, 0, b).overlaps(exact_ball(exact))


@settings(max_examples=8)
@given(st.fractions(F(1, 10**9), F(1), max_denominator=10**9).filter(bool))
def test_line_through_the_ball(b):
    """d = 3, κ = 2: the covariogram of π(R² − x²) is a quintic, I = b²/9 − b³/15 + 2b⁵/315."""
    exact = b**2 / 9 - b**3 / 15 + 2 * b**5 / 315
    assert integral(3, 2, b).overlaps(exact_ball(exact))


@pytest.mark.parametrize("dim", [2, 4, 7, 10])
@pytest.mark.parametrize("b", [F(1, 10**30), F(1, 7), F(9, 10)])
def test_the_closed_form(dim, b):
    """(b/3) 3F2(1/2 − d/2, 1/2 + d/2, 1/2; 2, 5/2; b²), to 25 digits."""
    found, half = integral(dim, 0, b, 25), flint.fmpq(1, 2)
    ball = exact_ball(b)
    upper = [half - flint.fmpq(dim, 2), half + flint.fmpq(dim, 2), half]
    assert found.overlaps(ball / 3 * (ball * ball).hypgeom(upper, [2, flint.fmpq(5, 2)]))
    assert found.rel_accuracy_bits() > 82


@pytest.mark.parametrize("strata", [10, 10**4, 10**15, 10**30])
def test_lines_through_the_disk_have_their_logarithm(strata):
    """d = 2, κ = 1: twice R²(2πR) I = (R/(3n²)) (ln(8Rn) + 1/12) (1 + O(n^-2))."""
    radius = F(1, 4)
    found = integral(2, 1, 1 / (2 * radius * strata), 30)
    scaled = found * 4 * flint.arb.pi() * strata**2 * 3 * flint.fmpq(1, 16)
    expected = flint.arb(2 * strata).log() + flint.fmpq(1, 12)
    assert abs(scaled - expected) < max(1e-25, 1 / strata**2) * abs(expected)


def test_the_torus_sums_the_same_line():
    """Σ_{m≠0} (1 − sinc²(m/n)) (R J_1(2πRm)/m)² is twice the integral: nothing wraps round."""
    from scipy.special import jv

    radius, n, last = 0.3, 5, 400_000
    m = np.arange(1, last + 1)
    power = (radius * jv(1, 2 * np.pi * radius * m) / m) ** 2
    total = 2 * float(np.sum((1 - np.sinc(m / n) ** 2) * power))
    tail = radius / (np.pi**2 * last**2)  # J_1² <= 2/(πt) · (1 + 1e-10) here
    found = 2 * 0.3**2 * 2 * np.pi * 0.3 * float(integral(2, 1, 1 / (2 * F(3, 10) * n)))
    assert total <= found <= total + 1.01 * tail + 1e-14


@pytest.mark.parametrize("bits", [60, 90, 140])
def test_its_radius_is_that_of_the_precision_in_force(bits):
    flint.ctx.prec = bits
    for dim, kappa in ((1, 0), (2, 0), (2, 1), (5, 3)):
        assert ball_axis_integral(dim, kappa, F(2, 7)).rel_accuracy_bits() > bits - 25
        assert flint.ctx.prec == bits


def test_cut_and_expansion_move_together():
    """Another precision has another cut T and number of terms K: the balls still meet."""
    values = [integral(2, 0, F(3, 8), digits) for digits in (10, 13, 20, 28)]
    assert all(values[-1].overlaps(v) for v in values)
    assert all(b.rad() < a.rad() / 100 for a, b in pairwise(values))
