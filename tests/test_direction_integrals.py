"""Eq. 17 for one direction: box splines of the radial deficit, against direct means."""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import certified, exact_ball, flint
from specrate.numerics.equation17.axis_integrals import AxisProblem, solve_axis
from specrate.numerics.equation17.direction_integrals import direction_deficit
from specrate.numerics.equation17.space_integrands import SpaceBall

F = Fraction


def deficit(dim, widths, digits=15):
    return certified(lambda: direction_deficit(dim, [exact_ball(w) for w in widths]), digits)


def radial(dim, z):
    """G(z): z in one dimension, z − 2z³/3 in three; (4E − 2K)-like in two, by its series."""
    if dim == 1:
        return z
    if dim == 3:
        return z - 2 * z**3 / 3
    from scipy.special import hyp2f1

    x, w = np.polynomial.legendre.leggauss(30)
    u = z[..., None] * (x + 1) / 2
    return z * (hyp2f1(-0.5, 1.5, 1, u * u) @ w) / 2


def tensor_mean(dim, widths, order=24):
    """E G(|Σ w_i τ_i|) in the cones where the sum has one sign and the densities are affine."""
    x, w = np.polynomial.legendre.leggauss(order)
    x, w = (x + 1) / 2, w / 2
    if len(widths) == 1:
        return float(np.sum(2 * w * (1 - x) * radial(dim, float(widths[0]) * x)))
    a, b = (float(v) for v in widths)
    total = 0.0
    for sign in (1, -1):
        # τ_1 in (0, 1) to both sides of where a τ_1 + sign b τ_2 changes sign.
        for t, weight in zip(x, w, strict=True):
            zero = min(1.0, b * t / a) if sign < 0 else 0.0
            for low, high in ((0.0, zero), (zero, 1.0)):
                s = low + (high - low) * x
                value = radial(dim, np.abs(a * s + sign * b * t))
                total += weight * (1 - t) * float(np.sum(w * (high - low) * (1 - s) * value)) * 2
    return total


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("widths", [("1/3",), ("1/2", "1/5"), ("2/5", "2/5"), ("1/2", "1/100")])
def test_the_mean_by_quadrature(dim, widths):
    """To 1e-9: the outer integrand has a kink of third order where b t = a."""
    found = float(deficit(dim, [F(w) for w in widths]))
    assert found == pytest.approx(tensor_mean(dim, [F(w) for w in widths]), rel=1e-9)


@given(st.integers(1, 9), st.fractions(F(1, 100), F(9, 10), max_denominator=100))
def test_on_an_axis_it_is_the_axis_integral(dim, b):
    ball = SpaceBall(dim, F(1, 3))
    axis = solve_axis(AxisProblem(ball, 1 / (F(2, 3) * b), F(1), dim), 15).value
    value = deficit(dim, [b], 20) * flint.fmpq(1, 3) ** dim
    assert abs(F(float(value)) - F(axis.value)) <= F(axis.error_bound) + F(axis.value) / 10**15


@pytest.mark.parametrize("dim", [2, 3, 6])
def test_two_axes_or_three_with_a_small_one(dim):
    """w_2 → 0 leaves the axis: what it adds is of the order of its square, (w_2²/(3w_1)) E.."""
    plain = deficit(dim, [F(1, 3)], 40)
    for extra in ([F(1, 10**8)], [F(1, 10**8), F(1, 10**9)]):
        gap = deficit(dim, [F(1, 3), *extra], 40) - plain
        assert 0 < gap < 1e-15


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_order_of_the_axes_does_not_matter(dim):
    widths = [F(1, 3), F(1, 5), F(1, 7)]
    first = deficit(dim, widths, 25)
    assert all(first.overlaps(deficit(dim, [widths[i] for i in p], 25)) for p in orders())


def orders():
    return [p for p in product(range(3), repeat=3) if len(set(p)) == 3]


def test_without_stratified_axes_there_is_no_deficit():
    assert direction_deficit(2, []) == 0


def test_equal_widths_meet_at_zero():
    """w_1 − w_2 is a ball around 0: its power must not be lost."""
    w = flint.arb(1) / 3
    value = direction_deficit(3, [w, w, w / 2])
    assert value.is_finite()
    assert value > 0
