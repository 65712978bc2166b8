"""Text is parsed to exact expressions and never evaluated."""

from contextlib import suppress
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.errors import InputError
from specrate.theory.expressions import parse_expression, parse_size
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy

d, w = symbol("d"), symbol("w")
SYMBOLS = {"d": d, "w": w}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("3", Integer(3)),
        (" 3/2 ", Rational(3, 2)),
        ("0.3", Rational(3, 10)),
        ("1e-3", Rational(1, 1000)),
        ("-1/2", Rational(-1, 2)),
        ("+7", Integer(7)),
        ("2^10", Integer(1024)),
        ("2**-2", Rational(1, 4)),
        ("oo", sympy.oo),
        ("1 + 1/d", 1 + 1 / d),
        ("1 + 2/(d-3)", 1 + 2 / (d - 3)),
        ("min(w, d - 1)", sympy.Min(w, d - 1)),
        ("Min(1, 2)", Integer(1)),
        ("(w+1)/d", (w + 1) / d),
        ("d*w - d", d * w - d),
    ],
)
def test_expressions_are_exact(text, expected):
    assert (parse_expression(text, SYMBOLS) - expected).simplify() in (0, sympy.nan)
    assert parse_expression(text, SYMBOLS).is_number == expected.is_number


@pytest.mark.parametrize(
    "text",
    [
        "",
        "x",
        "d +",
        "1/0",
        "1/(2-2)",
        "oo - oo",
        "oo*0",
        "__import__('os').system('true')",
        "d.free_symbols",
        "[1]",
        "1 if 1 else 2",
        "True",
        "'3'",
        "3 < 4",
        "max(1, 2)",
        "min()",
        "min(1, key=2)",
        "2**d",
        "2**65",
        "9**64**64",
        "d**(1/2)",
        "lambda: 1",
        "1;2",
        "1\n2",
        "1j",
        "1_000 +",
        "(" * 100 + "1" + ")" * 100,
        "1+" * 150 + "1",
        "²",
        "1//2",
        "5 % 3",
        "\x00",
    ],
)
def test_anything_else_is_one_line_of_complaint(text):
    with pytest.raises(InputError) as caught:
        parse_expression(text, SYMBOLS)
    assert "\n" not in str(caught.value)


@given(st.text(max_size=30))
def test_no_text_breaks_the_parser(text):
    with suppress(InputError):
        assert parse_expression(text, SYMBOLS).free_symbols <= {d, w}


trees = st.recursive(
    st.one_of(st.integers(0, 9).map(str), st.sampled_from(["d", "w", "0.5"])),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda t: f"({t[0]} {t[1]} {t[2]})"),
        inner.map(lambda t: f"(-{t})"),
        st.tuples(inner, inner).map(lambda t: f"min({t[0]}, {t[1]})"),
    ),
    max_leaves=8,
)


@given(trees, st.integers(1, 9), st.integers(1, 9))
def test_values_are_those_of_exact_arithmetic(text, at_d, at_w):
    """Against Python's own reading of the same text with fractions in place of numbers."""
    try:
        expected = eval(
            text.replace("0.5", "F(1, 2)").replace("/", "/F(1)/"),
            {"F": Fraction, "d": Fraction(at_d), "w": Fraction(at_w), "min": min},
        )
    except ZeroDivisionError:
        return
    try:
        found = parse_expression(text, SYMBOLS)
    except InputError:
        return  # a division by zero that the values above do not meet, as in 0*(1/(d - d))
    found = found.xreplace({d: Integer(at_d), w: Integer(at_w)})
    expected = Fraction(expected)
    assert found == Rational(expected.numerator, expected.denominator)


@pytest.mark.parametrize("text", ["1", "12", "d", "d - 3"])
def test_sizes(text):
    assert parse_size(text, SYMBOLS) == parse_expression(text, SYMBOLS)


@pytest.mark.parametrize("text", ["0", "-1", "3/2", "oo", "x", "0.5"])
def test_sizes_are_whole_numbers_of_at_least_one(text):
    with pytest.raises(InputError) as caught:
        parse_size(text, SYMBOLS)
    assert "\n" not in str(caught.value)
