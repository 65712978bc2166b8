"""Tactics: what finds the steps of proofs; none is trusted, the kernel checks what comes out."""

from collections.abc import Sequence
from dataclasses import replace

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim, Relation
from ..trusted.kernel import Step

ZERO, ONE = sympy.S.Zero, sympy.S.One
Terms = Sequence[tuple[Expr, Expr]]
"""Powers c x^k, as pairs (c, k)."""


def real(names: str) -> tuple[Symbol, ...]:
    """Real symbols, the only ones in the grammar."""
    return sympy.symbols(names, real=True, seq=True)


def positive(*terms: Expr) -> tuple[Claim, ...]:
    """Hypotheses 0 < term."""
    return tuple(Claim(ZERO, "<", t) for t in terms)


def whole(*terms: Expr) -> tuple[Claim, ...]:
    """Hypotheses that terms are whole numbers."""
    return tuple(Claim(t, "whole") for t in terms)


def combine(claim: Claim, *uses: tuple[Expr | int, Step], remainder: Expr | int = 0) -> Step:
    """A step by addition: pairs of a coefficient and a step used."""
    coefficients = tuple(sympy.S(k) for k, _ in uses)
    reason = by.Combine(coefficients, sympy.S(remainder))
    return Step(claim, reason, tuple(u for _, u in uses))


def limit_of_powers(
    left: Expr, terms: Terms, n: Symbol, given: tuple[Claim, ...], right: Expr
) -> Step:
    """left = Σ c n^k -> right."""
    reason = by.Limit(tuple((c, ZERO, k, 0) for c, k in terms))
    return Step(Claim(left, "->", right, given, n), reason)


def value(terms: Terms, x: Expr) -> Expr:
    """Σ c x^k."""
    return sympy.Add(*(c * x**k for c, k in terms))


def power_integral(
    integral: Expr, terms: Terms, given: tuple[Claim, ...], uses: tuple[Step, ...] = ()
) -> Step:
    """An integral of Σ c x^k, no k = −1, over [a, b], (0, b] or [a, ∞)."""
    f, (x, a, b) = integral.function, integral.limits[0]
    primitive = [(c / (k + 1), k + 1) for c, k in terms]
    big = value(primitive, x)
    n = sympy.Symbol("n", real=True)
    if a != 0 and b != sympy.oo:
        claim = Claim(integral, "=", big.xreplace({x: b}) - big.xreplace({x: a}), given)
        return Step(claim, by.Antiderivative(big), uses)
    if b == sympy.oo:
        ends, fixed, moving = (a, n), -value(primitive, a), primitive
    else:
        ends, fixed = (ONE / n, b), value(primitive, b)
        moving = [(-c, -k) for c, k in primitive]
    inside = (*given, Claim(ends[0], "<=", ends[1]), *positive(n))
    proper = sympy.Integral(f, (x, *ends))
    ends_value = big.xreplace({x: ends[1]}) - big.xreplace({x: ends[0]})
    found = Step(Claim(proper, "=", ends_value, inside), by.Antiderivative(big))
    limit = limit_of_powers(ends_value, [(fixed, ZERO), *moving], n, inside, fixed)
    reached = Step(Claim(proper, "->", fixed, inside, n), by.Squeeze(), (found, limit))
    return Step(Claim(integral, "=", fixed, given), by.Improper(), (reached,))


def transferred(equation: Step, limit: Step, factor: Expr = ONE) -> Step:
    """From f = g and factor · g -> L to factor · f -> L."""
    f, g = equation.claim.left, equation.claim.right
    given = tuple(dict.fromkeys((*limit.claim.given, *equation.claim.given)))
    scaled = combine(Claim(factor * f, "=", factor * g, given), (factor, equation))
    claim = replace(limit.claim, left=factor * f, given=given)
    return Step(claim, by.Squeeze(), (scaled, limit))


def chain(claim: Claim, *uses: Step) -> Step:
    """A step by adding steps as they are."""
    return combine(claim, *((1, u) for u in uses))


def relation(left: Expr, rel: Relation, right: Expr, given: tuple[Claim, ...] = ()) -> Claim:
    """A claim."""
    return Claim(sympy.S(left), rel, sympy.S(right), given)
