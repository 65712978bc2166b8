"""Strata of one block: counts along its axes, their growth, and their grammar."""

from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.errors import InputError
from specrate.theory.layouts import Growth
from specrate.theory.strata import Strata, equal_strata, nearest_root, parse_strata
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import dims, strata, strata_texts


@given(dims, st.data(), st.integers(1, 10**6))
def test_counts_multiply_to_n_and_follow_their_laws(axes, data, n):
    s = data.draw(strata(axes))
    counts = s.counts_near(n)
    size = prod(counts)
    for count, law in zip(counts, s.growth, strict=True):
        assert float(law.constant) * size ** float(law.exponent) == pytest.approx(count, rel=1e-9)


@given(st.integers(1, 10**12), st.integers(1, 50), st.integers(1, 8))
def test_nearest_root_is_nearest(n, factor, power):
    t = nearest_root(n, factor, power)
    assert t >= 1
    for other in (t - 1, t + 1):
        if other >= 1:
            assert abs(factor * t**power - n) <= abs(factor * other**power - n)


@given(dims, st.integers(1, 10**5))
def test_equal_strata_are_equal(axes, n):
    s = equal_strata(axes)
    assert s.equal
    assert len(set(s.counts_near(n))) == 1
    assert s.growth == (Growth(Rational(1, axes)),) * axes


@given(dims, st.data())
def test_texts_are_read_with_powers_that_sum_to_one(axes, data):
    s = parse_strata(data.draw(strata_texts(axes)), axes)
    assert len(s.factors) == len(s.powers) == axes
    assert sum(law.exponent for law in s.growth) == 1


@pytest.mark.parametrize(
    ("text", "axes", "expected"),
    [
        ("25x40", 2, Strata((25, 40), (1, 1))),
        ("7", 1, Strata((7,), (1,))),
        ("4xN", 2, Strata((4, 1), (0, 1))),
        ("NxN", 2, Strata((1, 1), (1, 1))),
        ("N^1/3xN^2/3", 2, Strata((1, 1), (1, 2))),
        ("N^(1/3)xN^(2/3)", 2, Strata((1, 1), (1, 2))),
        ("4xNxN^1/3", 3, Strata((4, 1, 1), (0, 2, 1))),
        ("N", 1, Strata((1,), (1,))),
        ("N^1", 1, Strata((1,), (1,))),
    ],
)
def test_grammar(text, axes, expected):
    assert parse_strata(text, axes) == expected


def test_proportions_have_constants():
    columns, rows = Strata((25, 40), (1, 1)).growth
    assert columns.exponent == rows.exponent == Rational(1, 2)
    assert sympy.simplify(columns.constant / rows.constant) == Rational(5, 8)
    assert sympy.simplify(columns.constant * rows.constant) == 1


def test_a_fixed_count_does_not_grow():
    assert Strata((4, 1), (0, 1)).growth == (
        Growth(Integer(0), Integer(4)),
        Growth(Integer(1), Rational(1, 4)),
    )


@pytest.mark.parametrize(
    ("text", "axes"),
    [
        ("", 2),
        ("4", 2),
        ("4x4x4", 2),
        ("0x4", 2),
        ("-4x4", 2),
        ("4x", 2),
        ("4x4.5", 2),
        ("N^1/3xN^1/3", 2),
        ("N^2xN^-1", 2),
        ("N^dxN", 2),
        ("N^0xN", 2),
        ("N^1xN", 2),
        ("4xM", 2),
        ("4x10000000000000000000000", 2),
        ("²x4", 2),
        ("٣x4", 2),
        ("²xN", 2),
        ("4xN^²", 2),
        ("4×4", 2),
        ("4x4", -1),
    ],
)
def test_what_is_not_strata_is_one_line_of_complaint(text, axes):
    with pytest.raises(InputError) as caught:
        parse_strata(text, axes)
    assert "\n" not in str(caught.value)
