"""Dominance orders the monoid of orders; sums keep what is undominated."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.dominance import Case, cases, dominates, slowest, undominated
from specrate.theory.errors import UndecidedSign
from specrate.theory.orders import Order
from specrate.theory.signs import Range, symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import numeric_orders

d, k = symbol("d"), symbol("k")
D4 = (Range(d, Integer(4)),)
SYMBOLIC = [
    Order(Rational(3, 2)),
    Order(1 + 1 / (d - 3)),
    Order(Integer(2)),
    Order(1 + 2 / (d - 3)),
    Order(Integer(1)),
    Order(1 + 1 / d),
    Order(1 + 1 / d, Integer(1)),
    Order(1 + 2 / d),
    Order(1 + 2 / d, sympy.KroneckerDelta(d, 4)),
]


@given(numeric_orders, numeric_orders)
def test_dominance_is_total_and_antisymmetric(a, b):
    assert dominates(a, b) or dominates(b, a)
    assert (dominates(a, b) and dominates(b, a)) == (a == b)


@given(numeric_orders, numeric_orders, numeric_orders)
def test_dominance_is_transitive(a, b, c):
    if dominates(a, b) and dominates(b, c):
        assert dominates(a, c)


@given(numeric_orders, numeric_orders, numeric_orders)
def test_dominance_is_compatible_with_the_product(a, b, c):
    if dominates(a, b):
        assert dominates(a * c, b * c)


@given(numeric_orders, numeric_orders)
def test_dominance_is_that_of_the_numbers(a, b):
    """N^-a (log N)^q at log N = 10^6 orders as a and then q, whatever these small q are."""
    at = Integer(10) ** 6

    def logarithm(o):
        return float(-o.exponent * at + o.log_power * sympy.log(at))

    if a != b:
        assert dominates(a, b) == (logarithm(a) > logarithm(b))


@given(st.lists(numeric_orders, min_size=1, max_size=6), st.randoms())
def test_undominated_sum_is_one_commutative_and_idempotent(terms, rng):
    kept = undominated(terms)
    assert len(kept) == 1
    assert kept[0] in terms
    assert all(dominates(kept[0], t) for t in terms)
    shuffled = list(terms)
    rng.shuffle(shuffled)
    assert undominated(shuffled) == kept
    assert undominated([*terms, *kept]) == kept
    assert slowest(terms) == kept[0]
    assert cases(terms) == (Case(kept[0]),)


@given(st.lists(st.sampled_from(SYMBOLIC), min_size=1, max_size=6), st.randoms())
def test_undominated_symbolic_sum_does_not_depend_on_the_order_of_terms(terms, rng):
    shuffled = list(terms)
    rng.shuffle(shuffled)
    kept = undominated(terms, D4)
    assert set(undominated(shuffled, D4)) == set(kept)
    assert set(undominated([*terms, *kept], D4)) == set(kept)


@given(st.lists(st.sampled_from(SYMBOLIC), min_size=1, max_size=4), st.integers(4, 40))
def test_cases_are_right_at_every_value(terms, value):
    """What symbolic cases say at d is what numbers say at d."""
    numeric = [at(t, value) for t in terms]
    found = cases(terms, D4)
    valid = [c for c in found if c.condition is None or bool(c.condition.xreplace({d: value}))]
    assert valid
    for case in valid:
        assert at(case.order, value) == slowest(numeric)


def at(order, value):
    substitution = {d: Integer(value)}
    return Order(
        order.exponent.xreplace(substitution), order.log_power.xreplace(substitution).doit()
    )


def test_eq_26_blocks_flip_at_five_dimensions():
    """3/2 of the 2D block against 1 + 1/(d − 3) of the last: equal at d = 5."""
    plane, rest = Order(Rational(3, 2)), Order(1 + 1 / (d - 3))
    assert dominates(plane, rest, D4) is None
    assert dominates(rest, plane, D4) is None
    assert set(undominated([plane, rest], D4)) == {plane, rest}
    low, high = cases([plane, rest], D4)
    assert low == Case(plane, sympy.And(d <= 5))
    assert high == Case(rest, sympy.And(d >= 5))


def test_eq_26_across_blocks_dominates_both():
    across = Order(Integer(1))
    terms = [Order(Rational(3, 2)), Order(1 + 1 / (d - 3)), Order(Integer(2)), across]
    assert undominated(terms, D4) == (across,)
    assert cases(terms, D4) == (Case(across),)


def test_two_symbols_leave_the_sign_undecided_and_name_it():
    both = (Range(d, Integer(2)), Range(k, Integer(2)))
    with pytest.raises(UndecidedSign, match=r"the sign of .*1/d.* varies for d >= 2, k >= 2"):
        cases([Order(1 + 1 / d), Order(1 + 1 / k)], both)
    with pytest.raises(UndecidedSign) as caught:
        slowest([Order(1 + 1 / d), Order(1 + 1 / k)], both)
    assert "\n" not in str(caught.value)
    assert "1/k" in str(caught.value)


def test_a_symbol_without_a_range_is_undecided():
    with pytest.raises(UndecidedSign, match="no assumptions"):
        slowest([Order(1 + 1 / d), Order(Rational(3, 2))])


def test_logarithms_decide_ties():
    plain, log = Order(Integer(2)), Order(Integer(2), Integer(1))
    assert dominates(log, plain)
    assert not dominates(plain, log)
    assert slowest([plain, log]) == log


def test_a_logarithm_at_one_dimension_lies_between_none_and_one():
    some = Order(1 + 2 / d, sympy.KroneckerDelta(d, 4))
    assert dominates(some, Order(1 + 2 / d), D4)
    assert not dominates(Order(1 + 2 / d), some, D4)
    assert dominates(Order(1 + 2 / d, Integer(1)), some, D4)
