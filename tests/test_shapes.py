"""Shapes: their series at 0 against their values, and the formula of difference jitter."""

from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.expected_spectra.shape_values import shape_value
from specrate.numerics.integrands.protocol import mp
from specrate.theory.shapes import DIFFERENCE, SINC2, TENT, series, stretched

betas = st.fractions(Fraction(1, 8), 2, max_denominator=8)
shapes = st.one_of(st.sampled_from([SINC2, TENT, DIFFERENCE]), betas.map(stretched))


def value_of_series(shape, highest, x):
    return mp.fsum(
        mp.mpf(t.rational.numerator)
        / t.rational.denominator
        * mp.pi ** (2 * t.half_pi)
        * mp.power(x, mp.mpf(t.power.numerator) / t.power.denominator)
        for t in series(shape, highest)
    )


@given(shapes, st.integers(1, 6))
def test_series_are_the_values_near_zero(shape, terms):
    """To the first term left out, whose size is between 10^-12 and 10^12 times |x|^power."""
    highest = shape.degree * terms
    with mp.workdps(2000):
        x = mp.mpf(10) ** -60
        error = abs(value_of_series(shape, highest, x) - shape_value(shape, x))
        left_out = [t.power for t in series(shape, 2 * highest + 4) if t.power > highest]
        if not left_out:
            assert shape == TENT
            assert error < mp.mpf(10) ** -1990
        else:
            size = mp.power(x, mp.mpf(left_out[0].numerator) / left_out[0].denominator)
            assert size * mp.mpf(10) ** -12 < error < size * mp.mpf(10) ** 12


@given(shapes, st.fractions(0, 20))
def test_series_start_with_one_and_rise(shape, highest):
    terms = series(shape, highest)
    assert (terms[0].power, terms[0].rational, terms[0].half_pi) == (0, 1, 0)
    assert all(a.power < b.power for a, b in pairwise(terms))
    assert all(t.rational != 0 and t.power <= highest for t in terms)


def test_degrees():
    assert [s.degree for s in (SINC2, TENT, DIFFERENCE)] == [2, 1, 4]
    assert stretched(Fraction(3, 7)).degree == Fraction(3, 7)


@given(shapes, st.integers(1, 9))
def test_where_shapes_vanish(shape, k):
    with mp.workdps(30):
        vanishes = abs(shape_value(shape, mp.mpf(k))) < mp.mpf(10) ** -28
    assert vanishes == (shape.vanishes_on_integers or bool(shape.beta and k**shape.beta > 64))


@pytest.mark.parametrize("x", ["0.01", "0.3", "0.77", "1.25", "3.4"])
def test_difference_is_the_pairs_of_difference_jitter(x):
    """φ⁴ − 2 Re[e^(2πix) φ(2x) φ(−x)²] + 2 cos(2πx) φ⁴ with φ = sinc."""
    with mp.workdps(40):
        x = mp.mpf(x)
        phi = mp.sincpi(x)
        turn = mp.expjpi(2 * x)
        neighbours = (turn * mp.sincpi(2 * x) * mp.sincpi(-x) ** 2).real
        expected = phi**4 - 2 * neighbours + 2 * turn.real * phi**4
        assert abs(shape_value(DIFFERENCE, x) - expected) < mp.mpf(10) ** -38


def test_the_first_coefficient_of_difference_jitter():
    """16π⁴(μ_2 + μ_4) for u uniform of width 1: μ_2 = 1/12, μ_4 = 1/80."""
    first = series(DIFFERENCE, Fraction(4))[1]
    assert first.half_pi == 2
    assert -first.rational == 16 * (Fraction(1, 12) + Fraction(1, 80)) == Fraction(23, 15)
