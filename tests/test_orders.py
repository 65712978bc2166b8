"""Orders are a commutative monoid under the product, and are written as in the paper."""

import pytest
from hypothesis import given
from specrate.theory.orders import CONSTANT, Order
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import numeric_orders

d, k = symbol("d"), symbol("k")
ZERO = Order(sympy.oo)


@given(numeric_orders, numeric_orders, numeric_orders)
def test_product_is_a_commutative_monoid(a, b, c):
    assert (a * b) * c == a * (b * c)
    assert a * b == b * a
    assert a * CONSTANT == a
    assert a * ZERO == ZERO


def test_one_exponent_has_one_form():
    assert Order(d / (d - 1) + 1 / (d - 1)) == Order(1 + 2 / (d - 1))


@pytest.mark.parametrize(
    ("order", "text", "latex"),
    [
        (CONSTANT, "1", "1"),
        (ZERO, "0", "0"),
        (Order(Integer(1)), "N^-1", "N^{-1}"),
        (Order(Rational(3, 2)), "N^(-3/2)", r"N^{-\frac{3}{2}}"),
        (Order(1 + 1 / d), "N^(-1 - 1/d)", r"N^{-1-\frac{1}{d}}"),
        (Order(1 + 2 / (d - 3)), "N^(-1 - 2/(d - 3))", r"N^{-1-\frac{2}{d - 3}}"),
        (Order(Integer(3), Integer(1)), "N^-3 log N", r"N^{-3}\log N"),
        (Order(Integer(3), Integer(2)), "N^-3 (log N)^2", r"N^{-3}(\log N)^{2}"),
        (
            Order(1 + 2 / d, sympy.KroneckerDelta(2, d)),
            "N^(-1 - 2/d) (log N if d = 2)",
            r"N^{-1-\frac{2}{d}}(\log N)^{[d=2]}",
        ),
    ],
)
def test_orders_are_written_as_in_the_paper(order, text, latex):
    assert str(order) == text
    assert order.latex() == latex
