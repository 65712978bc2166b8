"""What must never become a theorem: steps that once did, and those that come near them."""

import pytest
from refusals import refused
from specrate.proofs.theorems.tactics import ONE, ZERO, combine, real, whole
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.claims import Claim
from specrate.proofs.trusted.facts import Facts, defined
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check
from specrate.theory.symbolic import Expr, Symbol, sympy

x, y, n, j, k, t, N = real("x y n j k t N")
f = sympy.Function("f")
SQUARE = combine(Claim(ZERO, "<=", x**2), remainder=x**2)


@pytest.mark.parametrize("value", [sympy.I, -sympy.oo, sympy.zoo, sympy.nan, sympy.Float(0.5)])
def test_values_are_terms_of_the_grammar(value: Expr) -> None:
    check(SQUARE)
    reason = by.Instance(((x, value),))
    refused(Claim(ZERO, "<=", sympy.S(-1)), reason, SQUARE, because="no term")
    below = combine(Claim(sympy.S(-1), "<", ZERO), remainder=1)
    denied = Claim(ZERO, "<=", x**2, false=True)
    refused(denied, by.Counterexample(((x, value),)), below, because="no term")


@pytest.mark.parametrize(
    ("key", "value"), [(sympy.sin, sympy.Lambda(t, 0)), (sympy.S(2), sympy.S(-2))]
)
def test_only_names_are_replaced(key: object, value: Expr) -> None:
    used = combine(Claim(sympy.sin(x) ** 2 + sympy.cos(x) ** 2, "=", ONE))
    reason = by.Instance(((key, value),))
    refused(Claim(sympy.cos(x) ** 2, "=", ONE), reason, used, because="no name")


def test_what_grows_has_no_value() -> None:
    zero = Step(
        Claim(1 / N, "->", ZERO, (Claim(ZERO, "<", N),), N), by.Limit(((ONE, ZERO, -ONE, 0),))
    )
    check(zero)
    fixed = Claim(ONE / 5, "->", ZERO, (), N)
    refused(fixed, by.Instance(((N, sympy.S(5)),)), zero, because="grows: N")


@pytest.mark.parametrize("big", [sympy.atan(sympy.tan(x)), -sympy.acot(x)])
def test_functions_outside_the_grammar_have_no_value(big: Expr) -> None:
    assert not defined(big, Facts())
    integral = sympy.Integral(sympy.diff(big, x).simplify(), (x, -1, 1))
    claim = Claim(integral, "=", big.subs(x, 1) - big.subs(x, -1))
    with pytest.raises(Refused):
        check(Step(claim, by.Antiderivative(big)))


SIGN = (sympy.S(-1)) ** n
_SIGNED = (Claim(n, "whole"), Claim(ZERO, "<", SIGN * x))


def test_the_period_of_a_sign_is_that_of_the_sign_alone() -> None:
    root = sympy.sqrt(SIGN * x)
    claim = Claim(root**5 + y**2 - 1, "=", root + (y - 1) * (y + 1), _SIGNED)
    refused(claim, by.Combine(), because="not zero")
    check(Step(Claim(SIGN**5 * x, "=", SIGN * x, _SIGNED), by.Combine()))


def test_the_root_of_a_sign_is_not_a_quarter_turn() -> None:
    root = sympy.sqrt(SIGN)
    given = (Claim(n, "whole"), Claim(ZERO, "<", SIGN))
    claim = Claim(2 * sympy.cos(sympy.pi * n / 2), "=", root + 1 / root, given)
    refused(claim, by.Combine(), because="not zero")
    check(Step(Claim(root**2, "=", SIGN, given), by.Combine()))


def test_a_power_of_e_is_no_exponential_of_its_base() -> None:
    claim = Claim(sympy.log(sympy.Pow(sympy.E, x, evaluate=False), evaluate=False), "=", sympy.E)
    refused(claim, by.Combine(), because="not zero")


def test_logarithms_have_one_base() -> None:
    claim = Claim(sympy.log(x, 2, evaluate=False), "=", sympy.log(x), (Claim(ZERO, "<", x),))
    refused(claim, by.Combine(), because="no term")


def test_two_functions_of_one_name_are_not_one() -> None:
    g = sympy.Function("f", real=True)
    refused(Claim(f(x), "=", g(x)), by.Combine(), because="no term")


def test_a_term_that_replaces_a_function_catches_no_symbol() -> None:
    about_all = Claim(ZERO, "<=", f(j), (), over=(j,))
    given = Step(Claim(ZERO, "<=", f(j), (about_all,)), by.Given())
    here = Step(Claim(ZERO, "<=", f(k), (about_all,)), by.Instance(((j, k),)), (given,))
    check(here)
    values = ((f, sympy.Lambda(t, sympy.Sum(-t * k, (k, -1, 1)))),)
    caught = Claim(ZERO, "<=", sympy.Sum(-(k**2), (k, -1, 1)))
    refused(caught, by.Instance(values), here, because="would be caught")


@pytest.mark.parametrize("over", [(), (x,)])
def test_a_conditional_hypothesis_bounds_no_box(over: tuple[Symbol, ...]) -> None:
    absurd = Claim(ZERO, "<=", sympy.S(-1))
    given = (Claim(ZERO, "<=", x, (absurd,), over=over), Claim(x, "<=", ONE))
    refused(Claim(-ONE / 2, "<=", x, given), by.Interval(), because="not bounded")


def _not_zero(product: Expr) -> Step:
    """y ≠ 0 where the product with y is 1."""
    given = (Claim(product * y, "=", ONE),)
    absurd = (Claim(ZERO, "=", ONE),)
    equal = Step(Claim(ZERO, "=", ONE, absurd), by.Given())
    cases = (
        combine(Claim(y, "!=", ZERO, (*given, Claim(y, "<", ZERO))), remainder=-y),
        combine(Claim(ZERO, "!=", ZERO, absurd), (-2, equal), remainder=2),
        combine(Claim(y, "!=", ZERO, (*given, Claim(ZERO, "<", y))), remainder=-y),
    )
    return Step(Claim(y, "!=", ZERO, given), by.Split(y, ZERO), cases)


@pytest.mark.parametrize(
    ("product", "value"), [(x, (x, 1 / y)), (f(y), (f, sympy.Lambda(t, 1 / t)))], ids=["x", "f"]
)
def test_a_value_that_may_be_undefined(product: Expr, value: tuple[object, object]) -> None:
    """At y = 0 the hypothesis is 0 · 1/0 = 1, which SymPy writes as 1 = 1."""
    step = _not_zero(product)
    check(step)
    refused(Claim(y, "!=", ZERO), by.Instance((value,)), step, because="may be undefined")
    there = Claim(y, "!=", ZERO, (Claim(y, "!=", ZERO),))
    check(Step(there, by.Instance((value,)), (step,)))


def test_a_function_must_have_values_wherever_it_is_applied() -> None:
    inside = (*whole(k), Claim(ONE, "<=", k), Claim(k, "<=", sympy.S(3)))
    term = combine(Claim(ZERO, "<=", f(k) ** 2, inside), remainder=f(k) ** 2)
    zeros, squares = (sympy.Sum(e, (k, 1, 3)) for e in (ZERO, f(k) ** 2))
    total = Step(Claim(zeros, "<=", squares), by.Bind(), (term,))
    check(total)
    for pole, is_met in ((2, True), (4, False)):
        values = ((f, sympy.Lambda(t, 1 / (t - pole))),)
        claim = total.claim.at(*values)
        if is_met:
            refused(claim, by.Instance(values), total, because="may be undefined")
        else:
            check(Step(claim, by.Instance(values), (total, _below(pole))))


def _below(pole: int) -> Step:
    """k ≠ pole for k <= 3."""
    inside = (*whole(k), Claim(ONE, "<=", k), Claim(k, "<=", sympy.S(3)))
    least = Step(Claim(k, "<=", sympy.S(3), inside), by.Given())
    return combine(Claim(k - pole, "<", ZERO, inside), (1, least), remainder=pole - 3)


def test_a_range_is_not_cut_where_there_may_be_no_number() -> None:
    e = sympy.Integral(sympy.exp(-x), (x, 0, sympy.oo))
    at = y**-2
    parts = sympy.Integral(e.function, (x, 0, at)) + sympy.Integral(e.function, (x, at, sympy.oo))
    given = (Claim(e, "=", ONE),)
    refused(Claim(e, "=", parts, given), by.Range(at), because="not whole")
    check(Step(Claim(e, "=", parts, (*given, Claim(y, "!=", ZERO))), by.Range(at)))


def test_ends_of_ranges_must_have_values() -> None:
    empty = sympy.Integral(ZERO, (x, 1 / y, 1 / y + 1))
    refused(Claim(empty, "=", ZERO), by.Antiderivative(ZERO), because="no range")
    refused(Claim(empty, "=", ZERO), by.Linear(()), because="not these parts")
    given = (Claim(y, "!=", ZERO),)
    check(Step(Claim(empty, "=", ZERO, given), by.Antiderivative(ZERO)))


def test_a_denial_is_no_hypothesis() -> None:
    denied = Claim(x, "<=", y, false=True)
    refused(Claim(ZERO, "<=", x**2, (denied,)), by.Combine((), x**2), because="no hypothesis")
    deep = Claim(x, "<=", y, (Claim(x, "=", y, (denied,)),))
    refused(Claim(ZERO, "<=", x**2, (deep,)), by.Combine((), x**2), because="no hypothesis")


def test_hypotheses_of_any_depth_are_in_the_grammar() -> None:
    deepest = Claim(sympy.I, "=", ZERO)
    deep = Claim(x, "<=", y, (Claim(x, "=", y, (Claim(y, "=", x, (deepest,)),)),))
    refused(Claim(ZERO, "<=", x**2, (deep,)), by.Combine((), x**2), because="no term")


def test_constants_of_an_order_have_values() -> None:
    claim = Claim(ZERO, "O", ONE, (Claim(ZERO, "<", N),), N)
    refused(claim, by.Order((y**-2,)), because="no constants")
    check(Step(claim, by.Order((y**2,))))
