"""Constants as balls: against mpmath at more digits, against sums and integrals done otherwise."""

from fractions import Fraction
from functools import reduce

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import certified, exact_ball, flint
from specrate.numerics.exact_variances.constant_balls import constant_ball, mean_distance_ball
from specrate.numerics.integrands.protocol import mp
from specrate.theory.axis_powers import gaussian, power_law
from specrate.theory.errors import InputError
from specrate.theory.symbolic import Integer, Rational, sympy

numbers = st.fractions("1/9", 9, max_denominator=9).map(
    lambda x: Rational(x.numerator, x.denominator)
)


def close(constant, expected, digits=30):
    """Whether the certified ball holds a number of mpmath, up to the rounding of the latter."""
    found = certified(lambda: constant_ball(constant), digits)
    middle = mp.mpf(found.mid().str(digits + 5, radius=False))
    return abs(middle - expected) <= abs(expected) * mp.mpf(10) ** (1 - digits)


@given(numbers, numbers)
def test_elementary_expressions(x, y):
    expression = (
        sympy.sqrt(x) / y**3
        + 2 * sympy.asinh(x / y)
        - sympy.atan(sympy.sqrt(y)) * sympy.log(x + 1)
        + sympy.exp(-x) * x ** Rational(1, 3)
        + sympy.pi ** Rational(5, 2)
    )
    with mp.workdps(40):
        a, b = (mp.mpf(int(n.p)) / int(n.q) for n in (x, y))
        expected = mp.sqrt(a) / b**3 + 2 * mp.asinh(a / b) - mp.atan(mp.sqrt(b)) * mp.log(a + 1)
        expected += mp.exp(-a) * mp.cbrt(a) + mp.pi ** mp.mpf("2.5")
        assert close(expression + 1, expected + 1, 20)


@pytest.mark.parametrize("p", ["3/2", "5/2", "7/2", "9/2", "5"])
def test_zeta_gamma_and_sine(p):
    power = power_law(Rational(p), Integer(1), Integer(0))
    with mp.workdps(40):
        x = mp.mpf(Fraction(p).numerator) / Fraction(p).denominator
        assert close(power.total, 2 * mp.zeta(x))
        q = x - 1
        if q > 2:
            expected = 2 * mp.pi**2 / 3 * mp.zeta(x - 2)
        else:
            expected = 2 * (2 * mp.pi) ** q * mp.pi / mp.gamma(q + 3) / mp.sin(mp.pi * q / 2)
        assert close(power.deficit, expected)


@pytest.mark.parametrize("sigma", ["1/20", "1/3", "3"])
def test_gaussian_sums_term_by_term(sigma):
    """At sigma = 3 the sum is 1e-154, which is no zero."""
    s, power = Fraction(sigma), gaussian(Rational(sigma))
    with mp.workdps(40):
        a = (2 * mp.pi * s.numerator / s.denominator) ** 2
        terms = [mp.exp(-a * m**2) for m in range(1, 80)]
        height = a / mp.pi  # 2 · 2πσ²
        assert close(power.total, height * mp.fsum(terms))
        second = mp.fsum(m**2 * t for m, t in enumerate(terms, 1))
        assert close(power.deficit, mp.pi**2 / 3 * height * second)


def test_a_narrow_gaussian_is_one_on_the_line():
    """Σ_m exp(−a m²) → sqrt(π/a): no sum over the 10^7 terms that count."""
    power = gaussian(Rational(1, 10**6))
    with mp.workdps(40):
        s = mp.mpf(10) ** -6
        assert close(power.total, mp.sqrt(mp.pi) * s - 2 * mp.pi * s**2)


def test_four_dimensions_by_gauss_legendre():
    """∏ 2(1 − x_i) |x| over the unit cube; the cone at 0 leaves an error of about 1e-8."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    x, w = (nodes + 1) / 2, weights * (1 - nodes) / 2  # 2(1 − x) dx
    squares = reduce(np.add.outer, [x**2] * 4)
    expected = float((reduce(np.multiply.outer, [w] * 4) * np.sqrt(squares)).sum())
    found = certified(lambda: mean_distance_ball([exact_ball(1)] * 4), 20)
    assert float(found) == pytest.approx(expected, rel=1e-7)


@given(st.integers(1, 5), st.integers(10, 40))
def test_balls_at_two_precisions_overlap(dim, digits):
    sides = [Fraction(i + 1, dim) for i in range(dim)]
    few, many = (
        certified(lambda: mean_distance_ball([exact_ball(a) for a in sides]), d)
        for d in (digits, digits + 10)
    )
    assert few.overlaps(many)
    assert many.rad() < few.rad() or few.rad() < 1e-45


def test_symbols_and_unknown_functions_are_refused():
    for constant in (sympy.Symbol("R"), sympy.cosh(2), sympy.pi * sympy.Symbol("c_f")):
        with pytest.raises(InputError, match="no symbol and known functions"):
            constant_ball(constant)
    m = sympy.Symbol("m", integer=True, positive=True)
    with pytest.raises(InputError, match="a sum must be of"):
        constant_ball(sympy.Sum(m**4 * sympy.exp(-(m**2)), (m, 1, sympy.oo)))


def test_the_precision_in_force_is_used():
    before = flint.ctx.prec
    try:
        flint.ctx.prec = 300
        assert constant_ball(sympy.pi).rel_accuracy_bits() > 250
    finally:
        flint.ctx.prec = before
