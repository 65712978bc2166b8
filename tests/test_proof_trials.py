"""Trials of claims: what one point tells, values of terms, and series in a growing N."""

import random
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp
from specrate.proofs import ledger
from specrate.proofs.attacking.growth_series import growing
from specrate.proofs.attacking.trial_points import NoPoint, point
from specrate.proofs.attacking.trial_values import Point, series, value
from specrate.proofs.attacking.trials import Trial, Undecided, Undefined, refuted, trial, trials
from specrate.proofs.theorems.tactics import real
from specrate.proofs.trusted.claims import Claim

N, x, y, a, b, n, m = real("N x y a b n m")
F, G = sympy.Function("F"), sympy.Function("G")
ONE, ZERO = sympy.S.One, sympy.S.Zero


@cache
def _theorem(number: str) -> Claim:
    (claim,) = (e.holds for e in ledger.ENTRIES if e.number == number)
    assert claim is not None
    return claim


def _at(claim: Claim, **values: object) -> Trial:
    """A trial at a point that is given."""
    named = {s.name: s for s in claim.free}
    free = {named[k]: Fraction(str(v)) for k, v in values.items()}
    return trial(claim, point(claim, random.Random(0), free))


# --- what one point tells


def test_a_near_tie_is_told_from_a_tie() -> None:
    """q_1 − b_1 = 0.01 and e_1 = 0.38: a second power of N only 0.0038 below the first."""
    claim = _theorem("two classes, b<q, b<q")
    near = {
        "b_1": 1, "q_1": "1.01", "e_1": "0.38", "b_2": 1, "q_2": 2, "e_2": "0.39", "s_1": 1,
        "s_2": 1, "alpha_1": 1, "alpha_2": 1, "gamma_1": 1, "gamma_2": 1, "rho_1": 1, "rho_2": 1,
        "f_1": 1, "f_2": 1, "g_1": 1, "g_2": 1,
    }  # fmt: skip
    assert _at(claim, **near).verdict == "holds"
    assert _at(replace(claim, right=claim.right * N ** sympy.Rational(1, 250)), **near).verdict == (
        "fails"
    )
    for wrong in (sympy.log(N), 1 / sympy.log(N)):
        assert _at(replace(claim, right=claim.right * wrong), **near).verdict == "fails"


def test_functions_are_what_hypotheses_say_wherever_they_are_looked_at() -> None:
    """Beyond the first few places too, where blocks of axes reach."""
    claim = _theorem("kernel, uncorrelated jitter")
    rng = random.Random(3)
    for _ in range(20):
        at = point(claim, rng)
        strata = [value(sympy.Function("n")(sympy.Integer(k)), at) for k in (1, 8, 15, 40)]
        assert all(u >= 1 and u == int(u) for u in strata)


def test_functions_of_two_arguments_have_a_value_for_each_pair() -> None:
    same = Claim(F(ONE, 2 * ONE), "=", F(ONE, 3 * ONE))
    assert refuted(same, 0, trials=3)
    assert not refuted(Claim(F(ONE, 2 * ONE), "=", F(ONE, 2 * ONE)), 0, trials=3)


def test_hypotheses_on_all_values_of_two_symbols() -> None:
    whole = (Claim(a, "whole"), Claim(b, "whole"))
    everywhere = Claim(2 * ONE, "<=", F(a, b), whole, over=(a, b))
    claim = Claim(2 * ONE, "<=", F(3 * ONE, 7 * ONE), (everywhere,))
    found = list(trials(claim, 0, 20))
    assert {t.verdict for t in found} == {"holds"}
    assert refuted(replace(claim, left=3 * ONE), 0, trials=20)


def test_functions_that_vanish_by_hypothesis() -> None:
    nothing = Claim(F(x), "=", ZERO, over=(x,))
    claim = Claim(F(y) + G(y), "=", G(y), (nothing,))
    assert [t.verdict for t in trials(claim, 1, 5)] == ["holds"] * 5


def test_without_a_value_a_claim_fails_and_with_one_not_found_it_is_undecided() -> None:
    assert _at(Claim(x / x**2, "<=", 1 / x), x=0).verdict == "fails"
    assert _at(Claim(sympy.sqrt(x), "=", sympy.sqrt(x)), x=-2).verdict == "fails"
    slow = sympy.Sum(1 / (m * (m + 1)), (m, 1, sympy.oo))
    assert _at(Claim(slow, "=", ONE)).verdict == "undecided"
    assert _at(Claim(sympy.Sum(1 / m, (m, 1, sympy.oo)), "<=", 7 * ONE)).verdict == "fails"
    grows = Claim(sympy.exp(N), "O", N**2, along=N)
    assert _at(grows).verdict == "undecided"
    assert not refuted(grows)


def test_parts_that_diverge_may_cancel() -> None:
    """Σ (1 − cos 2πm)/m = 0, and ∫ (x^−a − x^−b) from 1 on with a = b."""
    sum_ = sympy.Sum((1 - sympy.cos(2 * sympy.pi * m)) / m, (m, 1, sympy.oo))
    integral = sympy.Integral(x**-a - x**-b, (x, 1, sympy.oo))
    assert _at(Claim(sum_, "=", ZERO)).verdict == "undecided"
    assert _at(Claim(integral, "=", ZERO), a=1, b=1).verdict == "undecided"
    assert _at(Claim(integral, "=", ZERO), a=1, b=2).verdict == "fails"


def test_no_point_is_no_pass() -> None:
    never = Claim(x, "<=", x, (Claim(x, "<", y), Claim(y, "<", x)))
    with pytest.raises(NoPoint):
        point(never, random.Random(0))
    assert [t.verdict for t in trials(never, 0, 3)] == ["undecided"] * 3


@pytest.mark.parametrize("gap", [Fraction(1, 10**13), Fraction(1, 10**40)])
def test_small_gaps_are_told_with_more_digits(gap: Fraction) -> None:
    small = sympy.Rational(gap.numerator, gap.denominator)
    assert _at(Claim(x, "<=", x + small), x=1).verdict == "holds"
    assert _at(Claim(x + small, "<=", x), x=1).verdict == "fails"
    is_seen = gap > Fraction(1, 10**18)  # an equation is compared to 18 digits
    assert _at(Claim(x, "=", x + small), x=1).verdict == ("fails" if is_seen else "holds")
    assert _at(Claim(sympy.sin(x) ** 2 + sympy.cos(x) ** 2, "<", ONE), x=1).verdict == "fails"


# --- values


@pytest.mark.parametrize(
    ("term", "exact"),
    [
        (sympy.Integral(x**2, (x, -1, 2)), 3),
        (sympy.Integral(x ** sympy.Rational(-1, 2), (x, 0, 4)), 4),
        (sympy.Integral((1 + 2 * x) ** 2, (x, 0, 1)), sympy.Rational(13, 3)),
        (sympy.Integral(x**-3, (x, 2, sympy.oo)), sympy.Rational(1, 8)),
        (sympy.Integral(sympy.cos(40 * x), (x, -1, 1)), sympy.sin(40) / 20),
        (sympy.Integral(x * sympy.exp(y * x), (x, 0, 1), (y, 0, 1)), sympy.E - 2),
        (sympy.Sum(m**-4, (m, 2, sympy.oo)), sympy.pi**4 / 90 - 1),
        (sympy.Sum(sympy.sin(sympy.pi * m / 3) ** 2 / m**2, (m, 1, sympy.oo)), sympy.pi**2 / 9),
        (sympy.Product(sympy.Sum(1, (y, 1, x)), (x, 1, 5)), 120),
    ],
    ids=str,
)
def test_values_of_sums_and_integrals(term: sympy.Expr, exact: sympy.Expr) -> None:
    with mp.workdps(30):
        found = value(term, Point({}, lambda: mp.mpf(0)))
        assert abs(found - mp.mpf(str(sympy.sympify(exact).evalf(35)))) < mp.mpf(10) ** -20


@pytest.mark.parametrize(
    "term",
    [
        sympy.Integral(1 / x, (x, -1, 2)), sympy.Integral(1 / x, (x, 1, sympy.oo)),
        sympy.Integral(x**-2, (x, 0, 1)), sympy.log(F(ONE)), 1 / F(ONE),
        sympy.Sum(x, (x, 1, sympy.Rational(5, 2))), sympy.Sum(1 / m, (m, 1, sympy.oo)),
    ],
    ids=str,
)  # fmt: skip
def test_terms_without_a_value(term: sympy.Expr) -> None:
    with pytest.raises(Undefined):
        value(term, Point({}, lambda: mp.mpf(0)))


# --- series in N against numbers at a large N


_POWERS = st.fractions(-3, 3, max_denominator=8).map(lambda f: N ** sympy.Rational(f))
_PARTS = st.tuples(st.integers(1, 5), _POWERS).map(lambda p: p[0] * p[1])


def _grown(parts: st.SearchStrategy[sympy.Expr]) -> st.SearchStrategy[sympy.Expr]:
    pairs = st.tuples(parts, parts)
    sums = pairs.map(lambda p: p[0] + p[1])
    powers = st.tuples(parts, st.sampled_from((-2, -1, 2, sympy.Rational(1, 3)))).map(
        lambda p: p[0] ** p[1]
    )
    waves = parts.map(lambda e: sympy.sin(1 / (1 + e))) | parts.map(
        lambda e: sympy.sinc(1 / (2 + e))
    )
    logs = parts.map(lambda e: sympy.log(2 + e))
    return sums | pairs.map(lambda p: p[0] * p[1]) | powers | waves | logs


@given(st.recursive(_PARTS, _grown, max_leaves=5))
def test_a_series_is_the_term_at_large_numbers(e: sympy.Expr) -> None:
    """The term over the first monomial is 1, up to a power or a logarithm of N = exp(10^7)."""
    try:
        with mp.workdps(60):
            lead = series(e, Point({N: growing()}, lambda: mp.mpf(1))).lead
    except (Undecided, Undefined):
        return
    assert lead is not None
    p, j = lead.order
    with mp.workdps(60):
        size = mp.exp(mp.mpf(10) ** 7)
        number = value(e, Point({N: size}, lambda: mp.mpf(1)))
        ratio = number / (lead.c * size**p * mp.log(size) ** j)
    assert abs(ratio - 1) < 1e-2
