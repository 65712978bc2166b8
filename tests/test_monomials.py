"""Sums of monomials: powers and products against plain numbers, and what vanishes for N = s²."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.kernels import coefficient_field
from specrate.theory.layouts import Growth
from specrate.theory.monomials import collected, power_of, product_of, vanishes
from specrate.theory.symbolic import Integer, Rational

FIELD = coefficient_field(("N", "s"))
PI2, N, S = FIELD.gens
SQUARE = {"N": Growth(Integer(1)), "s": Growth(Rational(1, 2))}
LETTERS = "ab"

monomials = st.dictionaries(st.sampled_from(LETTERS), st.integers(1, 3)).map(
    lambda powers: frozenset(powers.items())
)
sums = st.lists(st.tuples(monomials, st.integers(-5, 5).map(FIELD)), min_size=1, max_size=4).map(
    collected
)
places = st.tuples(*[st.fractions(-3, 3, max_denominator=4)] * len(LETTERS))


def value(total, at):
    """The sum with numbers put in for its letters."""
    letters = dict(zip(LETTERS, at, strict=True))
    found = Fraction(0)
    for monomial, coefficient in total.items():
        term = Fraction(int(coefficient.numer.LC), int(coefficient.denom.LC))
        for letter, power in monomial:
            term *= letters[letter] ** power
        found += term
    return found


@given(sums, st.integers(1, 5), places)
def test_powers_are_repeated_products(base, count, at):
    assert value(power_of(base, count), at) == value(base, at) ** count


@given(sums, sums, places)
def test_products_multiply(first, second, at):
    assert value(product_of(first, second), at) == value(first, at) * value(second, at)


def test_terms_that_cancel_are_gone():
    a = frozenset({("a", 1)})
    assert collected([(a, N), (frozenset(), S), (a, -N)]) == {frozenset(): S}
    assert power_of({}, 3) == {}


def test_what_vanishes_under_the_growth_laws():
    assert vanishes((N - S**2) / (N + 1), SQUARE)
    assert vanishes(FIELD(0), SQUARE)
    assert not vanishes(N - S, SQUARE)
    assert not vanishes(PI2 * N - S**2, SQUARE)


def test_constants_of_the_laws_count():
    """25 × 40 strata: n_1 = sqrt(5/8) N^1/2, so that 8 n_1² = 5 N."""
    laws = {"N": Growth(Integer(1)), "s": Growth(Rational(1, 2), Rational(5, 8) ** Rational(1, 2))}
    assert vanishes(8 * S**2 - 5 * N, laws)
    assert not vanishes(S**2 - N, laws)
