"""Shapes on arrays of frequencies: value and deficit to the last place, from ball arithmetic."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import exact_ball, flint
from specrate.numerics.expected_spectra.shape_arrays import shape_arrays
from specrate.numerics.expected_spectra.shape_values import shape_ball
from specrate.theory.shapes import DIFFERENCE, SINC2, TENT, stretched

betas = st.fractions(Fraction(1, 8), 2, max_denominator=8)
shapes = st.one_of(st.sampled_from([SINC2, TENT, DIFFERENCE]), betas.map(stretched))
BOUND = 3e-15


def errors(shape, m, n):
    """Absolute error of the value, relative error of the deficit."""
    value, deficit = (float(a[0]) for a in shape_arrays(shape, np.array([m]), n))
    with flint.ctx.workprec(2400):
        exact = shape_ball(shape, m, n)
        off = abs(exact_ball(Fraction(value)) - exact)
        lost = abs(exact_ball(Fraction(deficit)) / (1 - exact) - 1)
        return float(off.upper()), float(lost.upper())


@given(shapes, st.integers(0, 61), st.integers(0, 63), st.data())
def test_value_and_deficit(shape, k, j, data):
    m, n = (data.draw(st.integers(1 << i, 2 << i)) for i in (k, j))
    off, lost = errors(shape, m, n)
    assert off < BOUND
    assert lost < BOUND


@pytest.mark.parametrize("shape", [SINC2, DIFFERENCE])
def test_where_the_series_ends(shape):
    """t = πm/n on both sides of 1, and far below it, where the difference has no digit left."""
    for m in (*range(300, 340), 1, 3, 10, 100):
        off, lost = errors(shape, m, 1000)
        assert off < BOUND
        assert lost < BOUND


def test_stretched_exponentials_with_a_beta_that_is_no_double():
    off, lost = errors(stretched(Fraction(1, 3)), 1, 10**300)
    assert off < BOUND
    assert lost < BOUND


def test_tents_beyond_64_bits():
    value, deficit = shape_arrays(TENT, np.array([1 << 62, 1]), 1 << 63)
    assert value.tolist() == [0.5, 1.0]
    assert deficit.tolist() == [0.5, 2.0**-63]
    value, deficit = shape_arrays(TENT, np.array([3, 7, 8]), 7)
    assert value == pytest.approx([4 / 7, 0, 0], abs=0)
    assert deficit == pytest.approx([3 / 7, 1, 1], abs=0)
