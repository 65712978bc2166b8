"""Rules of the kernel where terms have no value, claims are no claims, or values are caught."""

from collections.abc import Callable

import pytest
from refusals import refused
from specrate.proofs.theorems.tactics import ONE, ZERO, combine, real
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.claims import Axiom, Claim
from specrate.proofs.trusted.facts import Facts, defined
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check
from specrate.theory.symbolic import Expr, Symbol, sympy

x, y, z, w, j, k, n, t, N = real("x y z w j k n t N")
f = sympy.Function("f")
LARGE = (Claim(ONE, "<", N),)
LIMIT_OF_N = Step(Claim(N, "->", sympy.oo, LARGE, N), by.Limit(((ONE, ZERO, ONE, 0),)))


def given(hypothesis: Claim, *others: Claim) -> Step:
    stated = Claim(hypothesis.left, hypothesis.relation, hypothesis.right, (hypothesis, *others))
    return Step(stated, by.Given())


def test_a_denial_is_not_what_it_denies() -> None:
    unequal = combine(Claim(ZERO, "!=", ONE), remainder=1)
    denial = Step(Claim(ZERO, "=", ONE, false=True), by.Counterexample(()), (unequal,))
    refused(Claim(ZERO, "=", ONE), by.Combine((ONE,)), denial, because="says nothing")
    not_bounded = Claim(N, "->", ZERO, LARGE, N, false=True)
    denial = Step(not_bounded, by.Counterexample(()), (LIMIT_OF_N,))
    refused(Claim(N, "O", ONE, LARGE, N), by.Order(), denial, because="says nothing")


_NOUGHT = sympy.sin(x) ** 2 + sympy.cos(x) ** 2 - 1
NO_VALUE = _NOUGHT / _NOUGHT.xreplace({x: y})
"""0/0, whose difference to anything has the normal form 0."""


def _of_no_value(v: Expr) -> list[tuple[Claim, by.Reason, tuple[Step, ...]]]:
    same = combine(Claim(v, "=", v))
    undefined, term = (sympy.Sum(e, (k, 1, 1)) for e in (NO_VALUE, v))
    steady = Step(Claim(v, "->", v, (), N), by.Limit(((v, ZERO, ZERO, 0),)))
    return [
        (Claim(NO_VALUE, "=", v), by.Split(w, ZERO), (same, same, same)),
        (Claim(undefined, "=", term), by.Bind(), (same,)),
        (Claim(undefined, "=", term), by.Linear(((ONE, v),)), ()),
        (Claim(NO_VALUE, "->", v, (), N), by.Instance(()), (steady,)),
    ]


@pytest.mark.parametrize("number", range(4), ids=["split", "bind", "linear", "instance"])
def test_what_has_no_value_equals_nothing(number: int) -> None:
    claim, reason, uses = _of_no_value(sympy.S(7))[number]
    refused(claim, reason, *uses, because="another claim|not the terms|these parts|not an instance")


def test_what_has_no_value_has_no_order() -> None:
    bound = combine(Claim(ZERO, "<=", sympy.S(5)), remainder=5)
    claim = Claim(NO_VALUE * sympy.exp(N), "O", ONE, (), N)
    refused(claim, by.Order((sympy.S(5),)), bound, because="no constants")


def test_a_sum_in_the_place_of_a_function_catches_no_other_value() -> None:
    about_all = Claim(f(k), "=", ZERO, over=(k,))
    here = Step(Claim(f(y), "=", ZERO, (about_all,)), by.Instance(((k, y),)), (given(about_all),))
    body = sympy.Sum(x * (j - sympy.Rational(3, 2)), (j, 1, 2))
    values = ((f, sympy.Lambda(x, body)), (y, j))
    caught = Claim(sympy.Sum(j * (j - sympy.Rational(3, 2)), (j, 1, 2)), "=", ZERO)
    refused(caught, by.Instance(values), here, because="would be caught")


DIVERGENT = sympy.Integral(ONE, (x, 1, sympy.oo))


@pytest.mark.parametrize("over", [(), (k,)], ids=["plain", "for all"])
def test_a_hypothesis_keeps_its_sums(over: tuple[Symbol, ...]) -> None:
    """At y = 0 SymPy writes 0 for 0 · ∞, and the hypothesis would hold with nothing said."""
    bounded = Claim(y * DIVERGENT, "<=", 5 + k**2, over=over)
    stated = Step(Claim(bounded.left, "<=", bounded.right, (bounded,)), by.Given())
    exists = combine(Claim(DIVERGENT, "=", DIVERGENT, (bounded,)), (0, stated))
    square = combine(Claim(ZERO, "<=", 5 + k**2), remainder=5 + k**2)
    claim = Claim(DIVERGENT, "=", DIVERGENT)
    refused(claim, by.Instance(((y, ZERO),)), exists, square, because="may be undefined")


def test_a_case_is_looked_at_with_all_its_terms() -> None:
    """x ∫ dw/w from x² is 0 at x = 0 to SymPy, and has no value there."""
    product = x * sympy.Integral(1 / w, (w, x**2, 1 + x**2))
    sides = (Claim(x, "<", ZERO), Claim(ZERO, "<", x))
    below, beyond = (
        combine(Claim(product, "=", product, (side,)), (0, given(side))) for side in sides
    )
    at = combine(Claim(ZERO, "=", ZERO))
    claim = Claim(product, "=", product)
    refused(claim, by.Split(x, ZERO), below, at, beyond, because="undefined at")


def test_a_theorem_hides_no_symbols() -> None:
    ones = sympy.Sum(ONE, (x, 0, 3))
    hidden = Claim(ones, "=", ones, (Claim(sympy.S(5), "<", x),), over=(x,))
    refused(hidden, by.Combine(), because="says nothing|both bound and free")


@pytest.mark.parametrize("grows", [sympy.S(5), sympy.Symbol("N"), sympy.pi])
def test_only_a_symbol_grows(grows: Expr) -> None:
    claim = Claim(sympy.S(12), "->", sympy.S(12), (), grows)
    refused(claim, by.Limit(((sympy.S(12), ZERO, ZERO, 0),)), because="no symbols")


def test_the_power_of_a_logarithm_is_a_number() -> None:
    left = sympy.exp(-N) * sympy.log(N) ** N
    claim = Claim(left, "->", ZERO, (Claim(sympy.S(30), "<", N),), N)
    refused(claim, by.Limit(((ONE, -ONE, ZERO, N),)), because="no whole power")  # type: ignore


def test_a_conditional_cap_is_no_cap() -> None:
    """(x − 1)(x − 4) >= 0 where x <= 1, if x <= 1 is said for x < 4 alone."""
    cap = Claim(x, "<=", ONE, (Claim(x, "<", sympy.S(4)),))
    slope = (x - 1) * (x - 4)
    low, high = (cap, Claim(x, "<", sympy.S(4))), (cap, Claim(sympy.S(4), "<", x))
    capped = Step(Claim(x, "<=", ONE, low), by.Given())
    below = combine(
        Claim(ZERO, "<=", slope, low), (4 - x, capped), (0, Step(given(low[1]).claim, by.Given()))
    )
    beyond = combine(Claim(ZERO, "<=", slope, high), (0, given(high[1])), remainder=slope)
    at = combine(Claim(ZERO, "<=", ZERO))
    rises = Step(Claim(ZERO, "<=", slope, (cap,)), by.Split(x, sympy.S(4)), (below, at, beyond))
    value = x**3 / 3 - sympy.Rational(5, 2) * x**2 + 4 * x
    claim = Claim(ZERO, "<=", value, (cap, Claim(ZERO, "<=", x)))
    refused(claim, by.Monotone(x, ZERO), rises, because="not given")


def test_what_grows_in_a_hypothesis_is_free_of_other_hypotheses() -> None:
    """Under n <= 5 anything is a limit as n grows: no reason for one that is not so bounded."""
    tends = Claim(x, "->", ZERO, (), n)
    then = Claim(x, "=", ZERO, (tends,))
    step = Step(Claim(x, "=", ZERO, (then, tends)), by.Given())
    few = (Claim(n, "<=", sympy.S(5)), Claim(ONE, "<", n))
    at_most, above_1 = (Step(Claim(h.left, h.relation, h.right, few), by.Given()) for h in few)
    low = combine(Claim(ONE, "<=", 5 / n, few), (1 / n, at_most), (0, above_1))
    to_0 = Step(Claim(5 / n, "->", ZERO, few, n), by.Limit(((sympy.S(5), ZERO, -ONE, 0),)))
    zero = Step(Claim(ZERO, "->", ZERO, (), n), by.Limit(((ZERO, ZERO, ZERO, 0),)))
    positive = combine(Claim(ZERO, "<=", ONE), remainder=1)
    vacuous = Step(Claim(ONE, "->", ZERO, few, n), by.Squeeze(), (low, to_0, positive, zero))
    implied = Claim(ONE, "=", ZERO, (Claim(ONE, "->", ZERO, (), n),))
    claim = Claim(ONE, "=", ZERO, (implied, *few))
    refused(claim, by.Instance(((x, ONE),)), step, vacuous, because="not given")


def test_a_hypothesis_that_gives_values_is_not_dropped() -> None:
    total = sympy.Sum(ONE, (k, 1, sympy.oo))
    exists = Claim(total, "<=", total + N)
    steady = Step(Claim(total, "->", total, (exists,), N), by.Limit(((total, ZERO, ZERO, 0),)))
    claim = Claim(total, "->", total, LARGE, N)
    refused(claim, by.Eventually(), steady, LIMIT_OF_N, because="not given")


def test_a_hypothesis_that_no_large_number_meets_is_no_witness() -> None:
    given_ = (Claim(N + ONE / 4, "whole", N), *LARGE)
    grows = Step(Claim(N, "->", sympy.oo, given_, N), by.Limit(((ONE, ZERO, ONE, 0),)))
    denial = Claim(N, "->", ZERO, given_, N, false=True)
    refused(denial, by.Counterexample(()), grows, because="a bound")


def test_ranges_in_reverse_or_without_whole_ends() -> None:
    product = sympy.Product(k, (k, 0, sympy.oo))
    parts = sympy.Product(k, (k, 0, 0)) * sympy.Product(k, (k, 1, sympy.oo))
    nought = Claim(product, "=", ZERO)
    claim = Claim(product, "=", parts, (nought,))
    refused(claim, by.Range(ZERO), given(nought), because="may diverge")
    half = sympy.Sum(ZERO, (k, 0, ONE / 2))
    refused(Claim(half, "=", ZERO), by.Linear(()), because="not these parts")
    back = sympy.Integral(ZERO, (x, 1, 0))
    refused(Claim(back, "=", ZERO), by.Linear(()), because="not these parts")


class _Sly(Claim):
    """A claim whose gap is what a rule wants to see."""

    @property
    def gap(self) -> Expr:
        return ZERO


def _with_a_list() -> Claim:
    return Claim(x, "<=", y, [Claim(x, "<=", y)])  # type: ignore


class _Sums(sympy.Symbol):  # type: ignore[misc]
    """A symbol that adds to nothing."""

    def __add__(self, other: object) -> Expr:
        return ZERO


@pytest.mark.parametrize(
    "claim",
    [
        lambda: _Sly(ZERO, "=", ONE),
        _with_a_list,
        lambda: Claim(_Sums("s", real=True), "=", ZERO),
    ],
    ids=["claim", "list", "term"],
)
def test_classes_are_exact(claim: Callable[[], Claim]) -> None:
    refused(claim(), by.Combine(), because="no claim|no term")


def test_a_step_and_its_lists_do_not_change() -> None:
    class Changing(by.Step):
        pass

    true = Claim(ZERO, "=", ZERO)
    with pytest.raises(Refused, match="no step"):
        check(Changing(true, by.Combine()))
    with pytest.raises(Refused, match="no step"):
        check(Step(true, by.Combine(), []))  # type: ignore[arg-type]
    refused(true, by.Combine([]), because="no tuple")  # type: ignore[arg-type]


def test_functions_are_given_by_terms() -> None:
    step = Step(Claim(f(x), "=", f(x)), by.Combine())
    reason = by.Instance(((f, str),))  # type: ignore[arg-type]
    refused(Claim(ONE, "=", ONE), reason, step, because="no function|no attribute|no term")


class _Equal(Claim):
    """A claim that is equal to every other."""

    def __eq__(self, other: object) -> bool:
        return True


def test_an_axiom_is_a_claim_of_the_grammar() -> None:
    axiom = Axiom("all", _Equal(ZERO, "=", ZERO), "nowhere")
    refused(Claim(ZERO, "=", ONE), by.Cite(axiom), because="no claim|not the cited")


def test_an_integral_from_an_open_end_has_a_range() -> None:
    """From 1/n to 0 is no range for any n > 0: under 1/n <= 0 every limit follows."""
    empty = sympy.Integral(ONE, (x, 1 / n, 0))
    never = (Claim(1 / n, "<=", ZERO), Claim(ZERO, "<", n))
    said = Step(Claim(1 / n, "<=", ZERO, never), by.Given())
    absurd = combine(Claim(ONE, "<=", ZERO, never), (n, said))
    gap, seven = empty - 7, sympy.S(7)
    bounds = [
        combine(claim, (gap**2 + 1, absurd), remainder=(q + ONE / 2) ** 2 + sympy.Rational(3, 4))
        for claim, q in (
            (Claim(seven, "<=", empty, never), gap),
            (Claim(empty, "<=", seven, never), -gap),
        )
    ]
    steady = Step(Claim(seven, "->", seven, never, n), by.Limit(((seven, ZERO, ZERO, 0),)))
    uses = (bounds[0], steady, bounds[1], steady)
    limit = Step(Claim(empty, "->", seven, never, n), by.Squeeze(), uses)
    nothing = Claim(sympy.Integral(ONE, (x, 0, 0)), "=", seven)
    refused(nothing, by.Improper(), limit, because="no sum ends so")


def test_a_fact_of_a_free_symbol_is_none_of_a_bound_one() -> None:
    integral = sympy.Integral(1 / x, (x, 0, 1))
    for facts in (Facts(frozenset({x})), Facts(nonzero=frozenset({x}))):
        assert not defined(integral, facts)
        assert not defined(sympy.Sum(1 / x, (x, 0, 1)), facts)


_HIDDEN_0 = sympy.sin(ONE) ** 2 + sympy.cos(ONE) ** 2 - 1


def test_a_hypothesis_that_loses_its_quotient_is_not_met() -> None:
    """0 · (1/0) = 0 has no value, and SymPy writes 0 = 0."""
    nought = combine(Claim(_HIDDEN_0**2, "<=", ZERO))
    denial = Claim(ZERO, "<", y**2, (Claim(x / y, "=", ZERO),), false=True)
    values = by.Counterexample(((x, ZERO), (y, _HIDDEN_0)))
    refused(denial, values, nought, because="undefined")


def test_a_case_is_looked_at_with_the_terms_of_its_sums() -> None:
    total = sympy.Sum(x / (k + x**2), (k, 0, 1))
    below, beyond = (
        combine(Claim(total, "=", total, (side,)))
        for side in (Claim(x, "<", ZERO), Claim(ZERO, "<", x))
    )
    at = combine(Claim(total.xreplace({x: ZERO}), "=", total.xreplace({x: ZERO})))
    claim = Claim(total, "=", total)
    refused(claim, by.Split(x, ZERO), below, at, beyond, because="undefined at")


def test_an_order_has_a_value() -> None:
    claim = Claim(ZERO, "O", sympy.exp(1 / y), (), N)
    refused(claim, by.Order((ONE,)), because="no order")
