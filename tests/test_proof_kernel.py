"""The kernel refuses what does not follow: a wrong step for each rule, and each way to cheat."""

from dataclasses import replace

import pytest
import sympy
from refusals import refused
from specrate.proofs.theorems import radial
from specrate.proofs.theorems.tactics import (
    ONE,
    ZERO,
    combine,
    positive,
    power_integral,
    real,
    whole,
)
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.claims import Axiom, Claim
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, Theorem, check

x, y, n, k, N, b = real("x y n k N b")
oo = sympy.oo
E = sympy.Function("E")


def accepted(claim: Claim, reason: by.Reason, *uses: Step) -> Step:
    step = Step(claim, reason, uses)
    assert check(step).claim == claim
    return step


def test_theorems_are_made_by_check_alone() -> None:
    with pytest.raises(Refused):
        Theorem(Claim(ONE, "=", ZERO), frozenset(), frozenset(), object())
    true = check(combine(Claim(ZERO, "<=", ONE), remainder=1))
    with pytest.raises(ValueError, match="seal"):
        replace(true, claim=Claim(ONE, "<=", ZERO))


def test_algebra_needs_its_denominators() -> None:
    claim = Claim((x**2 - 1) / (x - 1), "=", x + 1)
    refused(claim, by.Combine())
    accepted(replace(claim, given=(Claim(x - 1, "!=", ZERO),)), by.Combine())
    refused(Claim(x + 1, "=", x + 2), by.Combine())


def test_logarithms_and_powers_need_positive_arguments() -> None:
    claim = Claim(sympy.log(x * y), "=", sympy.log(x) + sympy.log(y))
    refused(claim, by.Combine())
    accepted(replace(claim, given=positive(x, y)), by.Combine())
    power = Claim((x * y) ** b, "=", x**b * y**b)
    refused(power, by.Combine())
    accepted(replace(power, given=positive(x, y)), by.Combine())


def test_symbols_carry_no_hidden_assumptions() -> None:
    hidden = sympy.Symbol("h", positive=True)
    refused(Claim(ZERO, "<", hidden), by.Combine((), hidden))


def test_an_inequality_is_not_multiplied_by_a_negative_number() -> None:
    small = accepted(Claim(x, "<=", y, (Claim(x, "<=", y),)), by.Given())
    given = small.claim.given
    refused(Claim(-x, "<=", -y, given), by.Combine((sympy.Integer(-1),)), small)
    refused(Claim(x, "<", y, given), by.Combine((ONE,)), small)


def test_a_dropped_hypothesis_of_a_used_step() -> None:
    small = Step(Claim(x, "<=", y, (Claim(x, "<=", y),)), by.Given())
    refused(Claim(x, "<=", y), by.Combine((ONE,)), small)


def test_a_conditional_hypothesis_is_no_fact() -> None:
    conditional = Claim(ZERO, "<", x, (Claim(ZERO, "<", y),))
    refused(Claim(ZERO, "<", x, (conditional,)), by.Combine((), x))
    refused(Claim(ZERO, "<", x, (conditional,)), by.Given())


def test_a_hypothesis_for_all_is_used_within_its_range() -> None:
    about = Claim(ZERO, "<=", E(k), (*whole(k), Claim(ONE, "<=", k)), over=(k,))
    inside = (about, *whole(k), Claim(ONE, "<=", k))
    here = accepted(Claim(ZERO, "<=", E(k), inside), by.Given())
    refused(Claim(ZERO, "<=", E(k), (about,)), by.Given())
    refused(Claim(ZERO, "<=", E(ZERO), (about,)), by.Instance(((k, ZERO),)), here)
    accepted(Claim(ZERO, "<=", E(ONE), (about,)), by.Instance(((k, ONE),)), here)


def test_balls_decide_on_the_whole_box() -> None:
    box = (Claim(ZERO, "<=", x), Claim(x, "<=", ONE))
    tight = Claim(x * (1 - x), "<", sympy.Rational(26, 100), box)
    accepted(tight, by.Interval(12))
    refused(replace(tight, right=sympy.Rational(24, 100)), by.Interval(12))
    refused(replace(tight, given=box[:1]), by.Interval(12))
    refused(Claim(1 / x, "<=", sympy.Integer(10**9), box), by.Interval(12))


def test_monotone_needs_the_derivative_and_the_start() -> None:
    slope = combine(Claim(ZERO, "<=", 2 * x, positive(x)), remainder=2 * x)
    given = (Claim(ZERO, "<=", x),)
    accepted(Claim(ZERO, "<=", x**2, given), by.Monotone(x, ZERO), slope)
    refused(Claim(ONE, "<=", x**2, given), by.Monotone(x, ZERO), slope)
    refused(Claim(ZERO, "<=", x**3, given), by.Monotone(x, ZERO), slope)
    refused(Claim(ZERO, "<=", x**2), by.Monotone(x, ZERO), slope)
    refused(Claim(ZERO, "<=", sympy.Abs(x), given), by.Monotone(x, ZERO), slope)


def test_a_monotone_step_does_not_use_what_holds_at_the_end_alone() -> None:
    given = (Claim(ZERO, "<=", x), Claim(ONE, "<=", x))
    slope = combine(
        Claim(ZERO, "<=", x - 1, given), (1, Step(Claim(ONE, "<=", x, given), by.Given()))
    )
    refused(Claim(ZERO, "<=", x**2 / 2 - x, given), by.Monotone(x, ZERO), slope)


def test_an_antiderivative_across_a_pole() -> None:
    across = sympy.Integral(1 / x**2, (x, -1, 1))
    refused(Claim(across, "=", sympy.Integer(-2)), by.Antiderivative(-1 / x))
    wrong = sympy.Integral(x, (x, 0, 1))
    refused(Claim(wrong, "=", ONE), by.Antiderivative(x**2))
    accepted(Claim(wrong, "=", sympy.Rational(1, 2)), by.Antiderivative(x**2 / 2))


@pytest.mark.parametrize(("power", "end"), [(-1, oo), (0, oo), (-1, 0), (-2, 0)])
def test_divergent_integrals(power: int, end: object) -> None:
    limits = (x, 1, oo) if end == oo else (x, 0, 1)
    integral = sympy.Integral(x**power, limits)
    terms = [(ONE, sympy.Integer(power))] if power != -1 else [(ONE, sympy.Rational(-3, 2))]
    with pytest.raises(Refused):
        check(power_integral(integral, terms, ()))
    refused(Claim(integral, "=", integral), by.Combine())


def test_a_sum_to_infinity_is_not_compared_without_convergence() -> None:
    given = (*whole(k), Claim(ONE, "<=", k))
    smaller = combine(Claim(ONE, "<=", k, given), (1, Step(Claim(ONE, "<=", k, given), by.Given())))
    sums = sympy.Sum(ONE, (k, 1, oo)), sympy.Sum(k, (k, 1, oo))
    refused(Claim(sums[0], "<=", sums[1]), by.Bind(), smaller)


def test_terms_are_compared_inside_their_range_only() -> None:
    less = Step(Claim(k, "<=", n, (Claim(k, "<=", n),)), by.Given())
    sums = sympy.Sum(k, (k, 1, n)), sympy.Sum(n, (k, 1, n))
    size = (*whole(n), Claim(ONE, "<=", n))
    accepted(Claim(*sums[:1], "<=", sums[1], size), by.Bind(), less)
    longer = sympy.Sum(k, (k, 1, n + 1)), sympy.Sum(n, (k, 1, n + 1))
    refused(Claim(longer[0], "<=", longer[1], size), by.Bind(), less)


def test_bound_symbols_are_not_free() -> None:
    total = sympy.Sum(k, (k, 1, n))
    refused(Claim(total + k, "=", total + k, whole(n, k)), by.Combine())
    with pytest.raises(Refused):
        Claim(total, "=", total).at((n, k))


def test_ranges_are_cut_between_their_ends() -> None:
    total, size = sympy.Sum(k, (k, 1, n)), (*whole(n), Claim(ONE, "<=", n))
    last = sympy.Sum(k, (k, 1, n - 1)) + sympy.Sum(k, (k, n, n))
    accepted(Claim(total, "=", last, size), by.Range(n - 1))
    refused(Claim(total, "=", last, whole(n)), by.Range(n - 1))
    refused(Claim(total, "=", n, size), by.Range())


def test_induction_needs_its_base_and_its_step() -> None:
    size = (*whole(n), Claim(ZERO, "<=", n))
    claim = Claim(n, "<=", n**2, size)
    base = combine(Claim(ZERO, "<=", ZERO**2))
    given = (*size, Claim(n, "<=", n**2))
    step = combine(
        Claim(n + 1, "<=", (n + 1) ** 2, given), (1, Step(Claim(n, "<=", n**2, given), by.Given())),
        remainder=2 * n,
    )  # fmt: skip
    accepted(claim, by.Induction(n, ZERO), base, step)
    refused(claim, by.Induction(n, ONE), base, step)
    refused(replace(claim, given=(Claim(ZERO, "<=", n),)), by.Induction(n, ZERO), base, step)
    refused(replace(claim, right=n**2 - 1), by.Induction(n, ZERO), base, step)


def test_an_instance_must_satisfy_the_hypotheses() -> None:
    inverse = combine(Claim(ZERO, "<", 1 / x, positive(x)), remainder=1 / x)
    accepted(Claim(ZERO, "<", 1 / y, positive(y)), by.Instance(((x, y),)), inverse)
    refused(Claim(ZERO, "<", 1 / y), by.Instance(((x, y),)), inverse)
    refused(Claim(ZERO, "<", -ONE), by.Instance(((x, -ONE),)), inverse)


def test_limits_whose_exponents_are_not_compared() -> None:
    given = (Claim(ONE, "<", N),)
    claim = Claim(N**b, "->", ZERO, given, N)
    reason = by.Limit(((ONE, ZERO, b, 0),))
    refused(claim, reason)
    accepted(replace(claim, given=(*given, Claim(b, "<", ZERO))), reason)
    refused(Claim(N**b, "->", oo, given, N), reason)
    refused(Claim(sympy.log(N), "->", ONE, given, N), by.Limit(((ONE, ZERO, ZERO, 1),)))
    refused(Claim(N * x, "->", oo, given, N), by.Limit(((x, ZERO, ONE, 0),)))


def test_constants_of_an_order_do_not_grow() -> None:
    given = (Claim(ONE, "<", N),)
    equal = combine(Claim(N, "<=", N, given))
    positive_ = combine(Claim(ZERO, "<=", N, given), remainder=N)
    refused(Claim(N, "O", ONE, given, N), by.Order((N,)), equal, positive_)
    falls = Step(Claim(1 / N, "->", ZERO, given, N), by.Limit(((ONE, ZERO, -ONE, 0),)))
    accepted(Claim(1 / N, "O", ONE, given, N), by.Order(), falls)
    refused(Claim(1 / N, "Theta", ONE, given, N), by.Order(), falls)


def test_a_hypothesis_on_large_n_is_dropped_only_if_it_lasts() -> None:
    given = (Claim(ONE, "<", N), Claim(N, "<", x))
    limit = Step(Claim(1 / N, "->", ZERO, given, N), by.Limit(((ONE, ZERO, -ONE, 0),)))
    without = replace(limit.claim, given=given[:1])
    grows = Step(Claim(N, "->", oo, given[:1], N), by.Limit(((ONE, ZERO, ONE, 0),)))
    refused(without, by.Eventually(), limit, grows, because="not given")
    vanishes = replace(limit, claim=without)
    refused(without, by.Eventually(), limit, vanishes, because="does not stay above 0")


def test_a_counterexample_must_satisfy_the_hypotheses_and_contradict() -> None:
    claim = Claim(x**2, "<=", x, positive(x), false=True)
    two = combine(Claim(sympy.Integer(2), "<", sympy.Integer(4)), remainder=2)
    accepted(claim, by.Counterexample(((x, sympy.Integer(2)),)), two)
    refused(claim, by.Counterexample(((x, ONE),)), two)
    minus = combine(Claim(-ONE, "<", ONE), remainder=2)
    refused(claim, by.Counterexample(((x, -ONE),)), minus)
    refused(claim, by.Combine())
    bounded = Claim(N, "O", ONE, (Claim(ONE, "<", N), Claim(N, "<", x)), N, false=True)
    grows = Step(Claim(N, "->", oo, (Claim(ONE, "<", N),), N), by.Limit(((ONE, ZERO, ONE, 0),)))
    refused(bounded, by.Counterexample(((x, sympy.Integer(9)),)), grows)


def test_what_is_cited_or_admitted_is_shown() -> None:
    axiom = Axiom("positive", Claim(ZERO, "<", x), "nowhere")
    cited = Step(axiom.claim, by.Cite(axiom))
    admitted = Step(Claim(ZERO, "<", y), by.Admit("because"))
    both = check(combine(Claim(ZERO, "<", x + y), (1, cited), (1, admitted)))
    assert both.axioms == {axiom}
    assert both.admitted == {"because"}
    refused(Claim(ZERO, "<", y), by.Cite(axiom))


def test_the_tie_is_not_reached_by_the_formula_for_different_degrees() -> None:
    integral = radial.pieces("b>q").middle
    given = tuple(
        h for h in radial.closed_form("b>q").claim.given if h != Claim(radial.q, "<", radial.b)
    )
    terms = [(radial.c2 * radial.gamma / N * radial.nu**-radial.b, radial.b - radial.q - 1)]
    with pytest.raises(Refused):
        check(power_integral(integral, terms, given))


def test_an_undefined_function_is_not_the_known_one_of_its_name():
    """gamma(k) for any function gamma, and then for 0, would make Γ(k) = 0."""
    k = sympy.Symbol("k", real=True)
    claim = Claim(sympy.Function("gamma")(k), "=", sympy.gamma(k), (Claim(sympy.S.Zero, "<", k),))
    with pytest.raises(Refused):
        check(Step(claim, by.Combine()))


@pytest.mark.parametrize("name", ["exp(x)", "(-1)^n", "any f", ""])
def test_names_that_generators_have_are_no_symbols(name):
    x = sympy.Symbol(name, real=True)
    with pytest.raises(Refused):
        check(Step(Claim(x, "=", x), by.Combine()))
