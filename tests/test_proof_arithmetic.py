"""What the rules stand on, against mpmath: equal terms, signs, definedness, balls and growth."""

import random

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp
from specrate.numerics.balls import exact_ball, flint
from specrate.proofs.attacking.trials import Point, Undefined, value
from specrate.proofs.theorems.tactics import real
from specrate.proofs.trusted.enclosures import ball
from specrate.proofs.trusted.facts import Facts, above, defined, different
from specrate.proofs.trusted.grammar import Refused, well_formed
from specrate.proofs.trusted.growth import limit_of
from specrate.proofs.trusted.normal_forms import zero

x, y, b, q, n, m = real("x y b q n m")
FACTS = Facts(positive=frozenset({x, y, b - q}), nonzero=frozenset({q}), whole=frozenset({n, m}))
SMALL = st.integers(-3, 3).map(sympy.Integer)
ATOMS = st.sampled_from((x, y, b, q, n, m, sympy.pi, sympy.Rational(1, 2))) | SMALL


def _grown(parts: st.SearchStrategy) -> st.SearchStrategy:
    pairs = st.tuples(parts, parts)
    waves = parts.map(sympy.sin) | parts.map(sympy.cos) | parts.map(lambda e: sympy.exp(e / 4))
    bases = st.sampled_from((x, y, x * y, x + y, sympy.Integer(2)))
    powers = st.tuples(bases, parts).map(lambda p: p[0] ** p[1])
    logs = st.tuples(bases, SMALL).map(lambda p: sympy.log(p[0]) + p[1])
    sums = pairs.map(lambda p: p[0] + p[1]) | pairs.map(lambda p: p[0] * p[1])
    quotients = st.tuples(parts, st.sampled_from((x, b - q, q, x * y))).map(lambda p: p[0] / p[1])
    return sums | waves | powers | logs | quotients


TERMS = st.recursive(ATOMS, _grown, max_leaves=7)


def _point(seed: int) -> Point:
    rng = random.Random(seed)
    values = {s: mp.mpf(rng.uniform(0.1, 2)) for s in (x, y)}
    values[q] = mp.mpf(rng.choice((-1, 1)) * rng.uniform(0.1, 2))
    values[b] = values[q] + mp.mpf(rng.uniform(0.01, 2))
    values |= {s: mp.mpf(rng.randint(-4, 4)) for s in (n, m)}
    return Point(values, lambda: mp.mpf(rng.random()))


def _rewritten(e: sympy.Expr) -> sympy.Expr:
    """An equal term, by identities that the normal form should know."""
    return sympy.expand_trig(sympy.expand(e, force=True))


@given(TERMS, TERMS, st.integers(0, 10**6))
def test_terms_found_equal_are_equal(e: sympy.Expr, other: sympy.Expr, seed: int) -> None:
    for difference in (e - other, e - _rewritten(e), e - e.xreplace({b: b + 2, n: n + 1})):
        if not (well_formed(difference) and defined(difference, FACTS) and zero(difference, FACTS)):
            continue
        with mp.workdps(40):
            try:
                size = 1 + abs(value(e, _point(seed)))
                assert abs(value(difference, _point(seed))) <= size * mp.mpf(10) ** -25
            except (Undefined, OverflowError):
                continue


@pytest.mark.parametrize(
    "difference",
    [
        x ** (b - q) * x**q - x**b,
        sympy.sin(x) ** 2 + sympy.cos(x) ** 2 - 1,
        sympy.sin(x + 2 * sympy.pi * n) - sympy.sin(x),
        sympy.cos(sympy.pi * n) - (-1) ** n,
        1 / (b - q) - b / q / (b - q) + 1 / q,
        sympy.log(x**b * y / 6) - b * sympy.log(x) - sympy.log(y) + sympy.log(2) + sympy.log(3),
        2 ** (b + 1) - 2 * sympy.exp(b * sympy.log(2)),
        (x + y) ** (b + 1) - (x + y) ** b * (x + y),
        x ** (q / (b - q)) * x - x ** (b / (b - q)),
    ],
)
def test_identities_that_are_found(difference: sympy.Expr) -> None:
    assert zero(difference, FACTS)


@given(TERMS, st.integers(0, 10**6), st.booleans())
def test_signs_that_are_seen_are_right(e: sympy.Expr, seed: int, strict: bool) -> None:
    if not (well_formed(e) and defined(e, FACTS)):
        return
    with mp.workdps(40):
        try:
            number = value(e, _point(seed))
        except OverflowError:
            return
        slack = mp.mpf(10) ** -25
        if above(e, FACTS, strict):
            assert number > 0 if strict else number >= -slack
        if different(e, FACTS):
            assert number != 0


@given(TERMS, st.integers(0, 10**6))
def test_defined_terms_have_values(e: sympy.Expr, seed: int) -> None:
    if well_formed(e) and defined(e, FACTS):
        with mp.workdps(30):
            try:
                assert mp.isfinite(value(e, _point(seed)))
            except OverflowError:
                return


@settings(max_examples=40)
@given(TERMS, st.integers(0, 10**6), st.fractions(0, 1, max_denominator=64))
def test_balls_hold_the_values_over_their_box(e: sympy.Expr, seed: int, width: object) -> None:
    point = _point(seed)
    radius = exact_ball(width) / 8
    balls = {
        s: flint.arb(str(v)) + (flint.arb(0, radius) if s in (x, y, b, q) else 0)
        for s, v in point.values.items()
    }
    if not well_formed(e):
        return
    try:
        enclosure = ball(e, balls)
        number = flint.arb(mp.nstr(value(e, point), 17))
    except (Undefined, OverflowError, ValueError):
        return
    if enclosure.is_finite():
        assert (enclosure + flint.arb(0, abs(number) * 1e-12 + 1e-12)).overlaps(number)


def test_growth_is_compared_by_rate_then_power_then_logarithm() -> None:
    one, zero_ = sympy.S.One, sympy.S.Zero
    falling = (y, -one, sympy.Integer(9), 3)
    assert limit_of(((x, zero_, zero_, 0), falling, (y, zero_, q - b, 7)), False, FACTS) == x
    assert limit_of(((x, zero_, b - q, 0), (-y, zero_, zero_, 9)), True, FACTS) == sympy.oo
    for terms in (((x, zero_, b, 0),), ((x, zero_, zero_, 1),), ((x, q, zero_, 0),)):
        with pytest.raises(Refused):
            limit_of(terms, False, FACTS)
    for terms in (((q, zero_, one, 0),), ((x, zero_, one, 0), (-x, zero_, one, 0))):
        with pytest.raises(Refused):
            limit_of(terms, True, FACTS)
