"""Mean distances in boxes: closed forms against literature, against certified integrals, limits."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.balls import certified, exact_ball
from specrate.numerics.exact_variances.constant_balls import constant_ball, mean_distance_ball
from specrate.theory.mean_distances import mean_distance, sides_of
from specrate.theory.symbolic import Integer, Rational, sympy

log, sqrt, pi = sympy.log, sympy.sqrt, sympy.pi

lengths = st.fractions("1/20", 20, max_denominator=20)
boxes = st.lists(lengths, min_size=1, max_size=3)


def exact(sides):
    return tuple(Rational(a.numerator, a.denominator) for a in sides)


def number(sides, digits=30):
    return certified(lambda: constant_ball(mean_distance(exact(sides))), digits)


@pytest.mark.parametrize(
    ("dim", "expected"),
    [
        (1, Rational(1, 3)),
        (2, (2 + sqrt(2) + 5 * log(1 + sqrt(2))) / 15),
        (
            3,
            (4 + 17 * sqrt(2) - 6 * sqrt(3) - 7 * pi) / 105
            + log(1 + sqrt(2)) / 5
            + 2 * log(2 + sqrt(3)) / 5,
        ),
    ],
)
def test_unit_cubes(dim, expected):
    """Ghosh 1951 in the square, Robbins 1978 in the cube."""
    found = mean_distance((Integer(1),) * dim)
    gap = certified(lambda: constant_ball(found) - constant_ball(expected) + 1, 40)
    assert abs(gap - 1) < 1e-40


@given(boxes)
def test_closed_forms_are_the_integral_over_the_characteristic_function(sides):
    integral = certified(lambda: mean_distance_ball([exact_ball(a) for a in sides]), 25)
    assert number(sides, 25).overlaps(integral)


@given(boxes, st.fractions("1/9", 9, max_denominator=9))
def test_distances_scale(sides, factor):
    scaled = number([factor * a for a in sides])
    assert (number(sides) * exact_ball(factor)).overlaps(scaled)


def test_a_thin_box_is_an_interval():
    thin = number([Rational(3), Rational(1, 10**9), Rational(1, 10**10)])
    assert 1 <= float(thin) < 1 + 1e-15


def test_a_point_has_no_extent():
    assert mean_distance(()) == 0


@pytest.mark.parametrize(
    "sides", [(1, 1, 1, 1), (1, 2, 3, 4), (Rational(1, 3), sqrt(2), sqrt(2), 7, 1)]
)
def test_more_sides_are_an_integral_that_knows_them(sides):
    wanted = tuple(map(sympy.sympify, sides))
    (integral,) = mean_distance(wanted).atoms(sympy.Integral)
    assert sorted(sides_of(integral), key=str) == sorted(wanted, key=str)


def test_more_dimensions_are_farther_but_below_the_root_mean_square():
    """E|Δ|² = d/6; Jensen. The rise from d to d + 1 is less than sqrt((d+1)/6) - sqrt(d/6)."""
    values = [float(number([Rational(1)] * d, 20)) for d in range(1, 9)]
    squares = [(d / 6) ** 0.5 for d in range(1, 9)]
    assert all(a < b for a, b in pairwise(values))
    assert all(v < s for v, s in zip(values, squares, strict=True))
    assert squares[-1] - values[-1] < 0.05 * squares[-1]
