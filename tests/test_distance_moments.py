"""Moments of distances: known means, exact even moments, homogeneity, and Gauss's rule."""

from fractions import Fraction
from itertools import islice

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import exact_ball, flint
from specrate.numerics.exact_variances.distance_moments import log_moment, moments

widths_of = {
    e: st.lists(st.fractions(Fraction(1, 50), 2, max_denominator=60), min_size=e, max_size=e)
    for e in (1, 2, 3)
}
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def moment(widths, p):
    """E |h|^p by `moments`."""
    first = 2 - p % 2
    return next(islice(moments([exact_ball(w) for w in widths], first), (p - first) // 2, None))


def by_gauss(widths, g):
    """E g(|h|) for one or two widths, by Gauss's rule in t, h = (a t, b t s) and (a t s, b t).

    A power of |h| is a power of t times a smooth function of s.
    """
    t, weight = (NODES + 1) / 2, WEIGHTS / 2
    if len(widths) == 1:
        return float((2 * weight * (1 - t) * g(float(widths[0]) * t)).sum())
    a, b = map(float, widths)
    scale, slant = np.meshgrid(t, t, indexing="ij")
    total = 0.0
    for x, y in ((scale, scale * slant), (scale * slant, scale)):
        density = 4 * (1 - x) * (1 - y) * scale * np.multiply.outer(weight, weight)
        total += float((density * g(np.hypot(a * x, b * y))).sum())
    return total


def test_mean_distances_of_unit_cubes():
    """1/3; (2 + √2 + 5 asinh 1)/15; Robbins's constant (American Mathematical Monthly 85, 1978)."""
    one, root = flint.arb(1), flint.arb(2).sqrt()
    assert moment([1], 1).overlaps(one / 3)
    assert moment([1, 1], 1).overlaps((2 + root + 5 * one.asinh()) / 15)
    three = flint.arb(3).sqrt()
    robbins = (4 + 17 * root - 6 * three + 21 * one.asinh() + 42 * (2 + three).log()) / 105
    assert moment([1, 1, 1], 1).overlaps(robbins - flint.arb.pi() / 15)


@given(widths=st.one_of(widths_of[1], widths_of[2]))
def test_even_moments(widths):
    """E t² = w²/6 and E t⁴ = w⁴/15 of one coordinate, the coordinates independent."""
    second = sum((w**2 for w in widths), Fraction(0)) / 6
    cross = (second**2 - sum((w**4 for w in widths), Fraction(0)) / 36) if len(widths) == 2 else 0
    assert moment(widths, 2).overlaps(exact_ball(second))
    fourth = sum((w**4 for w in widths), Fraction(0)) / 15 + cross
    assert moment(widths, 4).overlaps(exact_ball(fourth))


@given(widths=st.one_of(widths_of[1], widths_of[2]), p=st.integers(1, 9))
def test_moments_by_quadrature(widths, p):
    ratio = max(widths) / min(widths)
    if ratio > 4:
        widths = [widths[0], widths[0] * 2][: len(widths)]  # smooth enough for 40 nodes
    assert float(moment(widths, p)) == pytest.approx(by_gauss(widths, lambda r: r**p), rel=1e-11)


@given(widths=st.one_of(widths_of[1], widths_of[2]), p=st.sampled_from([2, 4]))
def test_moments_with_a_logarithm(widths, p):
    widths = [widths[0], widths[0] * Fraction(7, 4)][: len(widths)]
    value = float(log_moment([exact_ball(w) for w in widths], p))
    wanted = by_gauss(widths, lambda r: r**p * np.log(r))
    assert value == pytest.approx(wanted, abs=1e-9 * float(moment(widths, p)))


@given(
    widths=st.one_of(*widths_of.values()), factor=st.fractions(Fraction(1, 9), 9), data=st.data()
)
def test_homogeneity(widths, factor, data):
    p = data.draw(st.sampled_from([1, 3, 5]))
    scaled = moment([factor * w for w in widths], p)
    assert scaled.overlaps(exact_ball(factor) ** p * moment(widths, p))


@given(widths=widths_of[3], p=st.sampled_from([1, 3]))
def test_three_coordinates_shrink_to_two(widths, p):
    """|h| grows by at most |h_3| <= 1e-9, at a precision that outlasts the cancellation."""
    thin = [*widths[:2], Fraction(1, 10**9)]
    with flint.ctx.workprec(300):
        two, three = moment(widths[:2], p), moment(thin, p)
        assert three > two
        assert three < two * (1 + flint.arb(10) ** -6)


@given(widths=widths_of[3])
def test_third_moment_by_monte_carlo(widths):
    """20 000 points, 6.5 standard errors: false alarm 1e-10. Power: 10 % off is 13 errors away."""
    rng = np.random.default_rng(5)
    t = rng.random((20_000, 3)) - rng.random((20_000, 3))
    distances = np.linalg.norm(t * [float(w) for w in widths], axis=1)
    for p in (1, 3):
        values = distances**p
        error = 6.5 * values.std() / np.sqrt(len(values))
        assert abs(values.mean() - float(moment(widths, p))) < error
        assert error < 0.1 * values.mean()
