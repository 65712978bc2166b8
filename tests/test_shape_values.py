"""Shapes as balls hold their values by mpmath, also where sines are of huge arguments."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import flint
from specrate.numerics.expected_spectra.shape_values import shape_ball, shape_value
from specrate.numerics.integrands.protocol import mp
from specrate.theory.shapes import DIFFERENCE, SINC2, TENT, stretched

betas = st.fractions(Fraction(1, 8), 2, max_denominator=8)
shapes = st.one_of(st.sampled_from([SINC2, TENT, DIFFERENCE]), betas.map(stretched))


@given(shapes, st.integers(1, 10**30), st.integers(1, 10**12), st.sampled_from([-1, 1]))
def test_balls_hold_the_values(shape, m, n, sign):
    with mp.workdps(90), flint.ctx.workprec(160):
        ball = shape_ball(shape, sign * m, n)
        value = flint.arb(mp.nstr(shape_value(shape, sign * mp.mpf(m) / n), 45))
        assert abs(ball - value) < flint.arb("1e-43")
        assert ball.rad() < flint.arb("1e-43")


@pytest.mark.parametrize("shape", [SINC2, TENT, DIFFERENCE])
def test_zeros_on_teeth_are_exact(shape):
    for m in (7, -14, 7 * 10**40):
        assert shape_ball(shape, m, 7) == 0


def test_known_values():
    with flint.ctx.workprec(80):
        assert shape_ball(TENT, 3, 4) == flint.arb("0.25")
        assert shape_ball(TENT, 5, 4) == 0
        assert abs(shape_ball(stretched(Fraction(1, 2)), 4, 1) - flint.arb(-2).exp()) < 1e-20
        assert abs(shape_ball(SINC2, 1, 2) - 4 / flint.arb.pi() ** 2) < 1e-20
        # 3 (2/π)³ (−2/3π) at x = 1/2, where sinc(4x) = 0
        assert abs(shape_ball(DIFFERENCE, 1, 2) + 16 / flint.arb.pi() ** 4) < 1e-20
