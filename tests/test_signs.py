"""Signs of rational functions: what is proved is true, what varies is left undecided."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.signs import Range, at_least, nonnegative, sign_changes, sign_of, symbol
from specrate.theory.symbolic import Integer, Rational, sympy

d, w = symbol("d"), symbol("w")
b = sympy.Symbol("b", positive=True)
D2 = (Range(d, Integer(2)),)
D4 = (Range(d, Integer(4)),)
W_BELOW_D = (Range(w, Integer(2)), Range(d, w + 1))

HOLDS = {
    "+": lambda v: v > 0,
    ">=0": lambda v: v >= 0,
    "0": lambda v: v == 0,
    "<=0": lambda v: v <= 0,
    "-": lambda v: v < 0,
    None: lambda v: True,
}

coefficients = st.lists(st.integers(-4, 4), min_size=1, max_size=4)


def polynomial(values, x):
    return sum((Integer(c) * x**i for i, c in enumerate(values)), Integer(0))


@given(coefficients, st.lists(st.integers(0, 3), min_size=1, max_size=3), st.integers(0, 60))
def test_a_proved_sign_is_true_at_every_value(over, under, step):
    expression = polynomial(over, d) / (1 + polynomial(under, d))
    value = expression.xreplace({d: Integer(2 + step)})
    assert HOLDS[sign_of(expression, D2)](value)


@given(coefficients)
def test_one_integer_symbol_is_decided_wherever_the_sign_is_constant(values):
    """Roots of these polynomials are below 5 + 1, so that 2..30 shows whether the sign varies."""
    expression = polynomial(values, d)
    signs = {sympy.sign(expression.xreplace({d: Integer(k)})) for k in range(2, 31)}
    found = sign_of(expression, D2)
    if signs == {1}:
        assert found in ("+", ">=0")
    if signs == {-1}:
        assert found in ("-", "<=0")
    if {1, -1} <= signs:
        assert found is None


@given(st.integers(-3, 3), st.integers(-3, 3), st.integers(-6, 6), st.integers(2, 20), st.data())
def test_two_symbols_one_bounding_the_other(p, q, r, small, data):
    large = data.draw(st.integers(small + 1, 40))
    expression = p * w + q * d + r
    value = expression.xreplace({w: Integer(small), d: Integer(large)}) if (p or q) else Integer(r)
    assert HOLDS[sign_of(sympy.sympify(expression), W_BELOW_D)](value)


@pytest.mark.parametrize(
    ("expression", "assumptions", "expected"),
    [
        (Integer(0), (), "0"),
        (Rational(-1, 7), (), "-"),
        (sympy.oo, (), "+"),
        (-sympy.oo, (), "-"),
        (1 / (d - 3), D4, "+"),
        (Rational(1, 2) - 1 / (d - 3), D4, None),
        (Rational(1, 2) - 1 / (d - 3), (Range(d, Integer(5)),), ">=0"),
        (Rational(1, 2) - 1 / (d - 3), (Range(d, Integer(6)),), "+"),
        (d - w, W_BELOW_D, "+"),
        (w - d, W_BELOW_D, "-"),
        (1 / w - 1 / d, W_BELOW_D, "+"),
        (d - 2, D2, ">=0"),
        (2 - d, D2, "<=0"),
        (d, (), None),
        (d - d, (), "0"),
        (sympy.Min(b, 1), (Range(b, Integer(0), integer=False),), ">=0"),
        (sympy.Min(b, 2) - sympy.Min(b, 1), (Range(b, Integer(0), integer=False),), ">=0"),
        (sympy.Min(b, 1) - sympy.Min(b, 2), (Range(b, Integer(0), integer=False),), "<=0"),
        (b - 1, (Range(b, Integer(0), integer=False),), None),
        (d**2 - 5 * d + 6, D2, ">=0"),
        (d**2 - 7 * d + 11, D2, None),
    ],
)
def test_known_signs(expression, assumptions, expected):
    assert sign_of(expression, assumptions) == expected


def test_nonnegative_has_three_answers():
    assert nonnegative(d - 2, D2) is True
    assert nonnegative(1 - d, D2) is False
    assert nonnegative(d - 3, D2) is None


def test_at_least_solves_for_the_symbol():
    assert at_least(d - 3, 1) == Range(d, Integer(4))
    assert at_least(d, w + 1) == Range(d, w + 1)


def test_sign_changes_are_the_roots_above_the_bound():
    assert sign_changes(Rational(1, 2) - 1 / (d - 3), D4) == (d, [5])
    assert sign_changes((d - 1) * (d - 7), D4) == (d, [7])
    assert sign_changes(d - w, W_BELOW_D) is None
    assert sign_changes(d - 5, ()) is None
    assert sign_changes(d - w, ()) is None


def test_ranges_are_written_as_read():
    assert str(Range(d, Integer(4))) == "d >= 4"
    assert str(Range(b, Integer(0), integer=False)) == "b > 0"
