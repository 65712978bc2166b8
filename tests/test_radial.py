"""Eq. 17 in closed form against quadrature with breaks at ρ0 and ν, and its leading term."""

from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError, UndecidedSign
from specrate.theory.orders import Order
from specrate.theory.radial import (
    C_F,
    RHO_0,
    Leading,
    N,
    PowerLog,
    Radial,
    closed_form,
    leading,
    power_log_terms,
)
from specrate.theory.signs import Range
from specrate.theory.symbolic import Integer, Rational, sympy

DIGITS = 40


def rational(low, high, most=6):
    return st.fractions(low, high, max_denominator=most).map(
        lambda f: Rational(f.numerator, f.denominator)
    )


@st.composite
def problems(draw):
    """Random exact problems; a quarter of them a tie b = q, a quarter the best case or a step."""
    s = draw(st.integers(1, 5))
    q = draw(rational(Fraction(1, 4), 4))
    kind = draw(st.sampled_from(["plain", "plain", "tie", "best", "step", "flat", "step-best"]))
    degree = {"tie": q, "flat": Integer(0), "step": sympy.oo, "step-best": sympy.oo}.get(kind)
    return Radial(
        degree=draw(rational(Fraction(1, 4), 6)) if degree is None else degree,
        dimension=Integer(s),
        decay=sympy.oo if "best" in kind else s + q,
        effective=draw(rational(Fraction(1, 6), 1)) if kind != "flat" else Integer(0),
        gamma=draw(rational(Fraction(1, 3), 3)),
        alpha=draw(rational(Fraction(1, 3), 3)),
        c=draw(rational(Fraction(1, 3), 3)),
        c2=draw(rational(Fraction(1, 3), 3)),
        rho0=draw(rational(Fraction(1, 3), 5)),
    )


def quadrature(p: Radial, n: int):
    """∫ ρ^(s−1) P_S P_f dρ in x = log ρ, piece by piece between −∞, log ρ0, log ν and ∞.

    On a piece it is known which branch of each spectrum holds, so that no integrand jumps inside.
    """
    rho0, nu = _mpf(p.rho0), _mpf(p.alpha) * mp.mpf(n) ** _mpf(p.effective)
    breaks = [-mp.inf, *sorted((mp.log(rho0), mp.log(nu))), mp.inf]
    total = mp.mpf(0)
    for lower, upper in pairwise(breaks):
        rises, falls = upper <= mp.log(nu), lower >= mp.log(rho0)
        if lower == upper or (rises and p.degree is sympy.oo) or (falls and p.decay is sympy.oo):
            continue

        def piece(x, rises=rises, falls=falls):
            power = mp.exp((x - mp.log(nu)) * _mpf(p.degree)) if rises else mp.mpf(1)
            energy = _mpf(p.c2) * mp.exp(-x * _mpf(p.decay)) if falls else _mpf(p.c)
            return mp.exp(x * _mpf(p.dimension)) * power * energy

        total += mp.quad(piece, [lower, upper])
    return _mpf(p.gamma) / n * total


def _mpf(value):
    return mp.mpf(int(value.p)) / int(value.q)


def number(expression, n):
    return mp.mpmathify(sympy.N(expression.xreplace({N: Integer(n)}), DIGITS + 15))


@given(problems(), st.sampled_from([1, 2, 7, 100, 10**6]))
def test_closed_form_is_the_integral(problem, n):
    with mp.workdps(DIGITS + 10):
        nu = _mpf(problem.alpha) * mp.mpf(n) ** _mpf(problem.effective)
        crossed = bool(_mpf(problem.rho0) <= nu)
        expected = quadrature(problem, n)
        found = number(closed_form(problem, crossed), n)
        assert abs(found - expected) <= mp.mpf(10) ** -(DIGITS - 8) * abs(expected)


@given(problems())
def test_leading_term_is_the_limit(problem):
    """At N = 10^40 and 10^400 V differs from its leading term by no more than the other terms."""
    lead = leading(problem)
    if lead is None:
        assert closed_form(problem) == 0
        return
    left: list[float] = []
    for exponent in (40, 400):
        with mp.workdps(60):
            value = number(closed_form(problem), 10**exponent)
            log = mp.log(10) * exponent
            order = mp.exp(-_mpf(lead.order.exponent) * log) * log ** int(lead.order.log_power)
            limit = number(lead.constant, 1) * order
            left.append(left_over(problem, lead, exponent, limit))
            assert abs(value / limit - 1) <= left[-1] + mp.mpf(10) ** -45
    assert left[1] < left[0] or left == [0, 0]


def left_over(problem, lead, exponent, limit):
    """Σ |terms but the leading one| / leading; for log(ν/ρ0) in place of e log N, log(α/ρ0)."""
    if problem.effective == 0:
        return mp.mpf(0)
    log_nu = mp.log(_mpf(problem.alpha)) + _mpf(problem.effective) * exponent * mp.log(10)
    total = mp.mpf(0)
    for t in power_log_terms(problem, True):
        size = abs(number(problem.gamma * t.coefficient, 1)) * mp.exp(_mpf(t.power) * log_nu)
        is_lead = Order(1 - problem.effective * t.power, Integer(t.log)) == lead.order
        if not is_lead:
            total += size * abs(log_nu - mp.log(_mpf(problem.rho0))) ** t.log
        elif t.log:
            total += size * abs(mp.log(_mpf(problem.alpha / problem.rho0)))
    return total * mp.mpf(10) ** -exponent / abs(limit)


@given(problems())
def test_leading_order_is_one_plus_e_min_b_q(problem):
    lead = leading(problem)
    if lead is None:
        assert problem.degree is sympy.oo
        assert problem.decay is sympy.oo
        return
    if problem.effective == 0:
        assert lead.order == Order(Integer(1))
        return
    smaller = sympy.Min(problem.degree, problem.q)
    tied = Integer(problem.degree == problem.q)
    assert lead.order == Order(1 + problem.effective * smaller, tied)


@pytest.mark.parametrize(("b", "q"), [(2, 1), (1, 2), (Rational(3, 2), Rational(5, 2))])
def test_symbolic_degree_is_the_number_put_in(b, q):
    """The closed form for a symbol b ≠ q, then b put in, is the closed form for the number."""
    symbol = sympy.Symbol("b", positive=True)
    for crossed in (True, False):
        general = closed_form(
            Radial(symbol, Integer(2), 2 + q, Rational(1, 2)), crossed, tied=False
        )
        special = closed_form(Radial(sympy.sympify(b), Integer(2), 2 + q, Rational(1, 2)), crossed)
        assert sympy.simplify(general.subs(symbol, b) - special) == 0


def test_symbolic_tie_is_a_logarithm():
    symbol = sympy.Symbol("b", positive=True)
    problem = Radial(symbol, Integer(2), 2 + symbol, Rational(1, 2))
    assert sum(t.log for t in power_log_terms(problem, True, tied=True)) == 1
    assumptions = (Range(symbol, Integer(0), integer=False),)
    lead = leading(problem, assumptions, tied=True)
    assert lead == Leading(Order(1 + symbol / 2, Integer(1)), C_F / 2)


def test_symbolic_degree_needs_to_be_told_of_the_tie():
    symbol = sympy.Symbol("b", positive=True)
    with pytest.raises(UndecidedSign, match="whether b = q must be known"):
        closed_form(Radial(symbol, Integer(1), Integer(2), Integer(1)))


@pytest.mark.parametrize("decay", [Integer(2), Integer(1), Rational(3, 2)])
def test_p_must_exceed_s(decay):
    with pytest.raises(InputError, match="the decay p must exceed the dimension s") as caught:
        power_log_terms(Radial(Integer(2), Integer(2), decay, Integer(1)), True)
    assert "\n" not in str(caught.value)


def test_eq_19_to_21_worst_case_along_an_axis():
    """b = 2, s = 1, p = 2: 2 c_f γ/(α N²), the paper's Eq. 19 with its missing piece below ρ0."""
    gamma, alpha = sympy.symbols("gamma alpha", positive=True)
    problem = Radial(Integer(2), Integer(1), Integer(2), Integer(1), gamma, alpha)
    assert leading(problem) == Leading(Order(Integer(2)), 2 * C_F * gamma / alpha)


def test_eq_22_and_23_best_case_along_an_axis():
    gamma, alpha = sympy.symbols("gamma alpha", positive=True)
    problem = Radial(Integer(2), Integer(1), sympy.oo, Integer(1), gamma, alpha)
    assert leading(problem) == Leading(Order(Integer(3)), C_F * gamma * RHO_0**3 / (3 * alpha**2))
    assert power_log_terms(problem, True) == (PowerLog(C_F * RHO_0**3 / 3, Integer(-2)),)


def test_a_step_against_the_best_case_vanishes():
    problem = Radial(sympy.oo, Integer(2), sympy.oo, Rational(1, 2))
    assert closed_form(problem) == 0
    assert leading(problem) is None
    assert closed_form(problem, crossed=False) != 0
