"""Leading powers of N: how coefficients of kernels grow under the growth laws of their counts.

A coefficient is a sum of field elements times symbolic powers of field elements (one factor over a
symbolic number of axes gives c^w); its leading power of N is the largest among its terms, where
the layout's assumptions tell which that is.
"""

from collections.abc import Iterator, Mapping

from .errors import UndecidedSign
from .layouts import Growth
from .signs import Assumptions, nonnegative
from .symbolic import Expr, FracElement, Integer, Rational, sympy

Base = tuple[FracElement, Expr]
"""A field element and the symbolic power to which it is raised."""

Bases = tuple[Base, ...]
Coefficient = dict[Bases, FracElement]
"""Σ over the entries of element · ∏ base^power."""


def summed(coefficients: Iterator[Coefficient]) -> Coefficient:
    total: Coefficient = {}
    for coefficient in coefficients:
        for bases, value in coefficient.items():
            total[bases] = total[bases] + value if bases in total else value
    return {b: v for b, v in total.items() if v != 0}


def leading(
    coefficient: Coefficient, growth: Mapping[str, Growth], assumptions: Assumptions
) -> tuple[Expr, Expr] | None:
    """Largest power of N in a coefficient and its constant; None for a zero coefficient."""
    found: list[tuple[Expr, Expr]] = []
    for bases, value in coefficient.items():
        exponent, constant = leading_power(value, growth, assumptions)
        for base, power in bases:
            e, c = leading_power(base, growth, assumptions)
            exponent, constant = exponent + power * e, constant * c**power
        found.append((sympy.expand(exponent), constant))
    return _largest(found, assumptions) if found else None


def leading_power(
    element: FracElement, growth: Mapping[str, Growth], assumptions: Assumptions = ()
) -> tuple[Expr, Expr]:
    """(a, C) with element ~ C N^a under the growth laws of its counts."""
    over = _leading_of_polynomial(element.numer, growth, assumptions)
    under = _leading_of_polynomial(element.denom, growth, assumptions)
    return over[0] - under[0], over[1] / under[1]


def _leading_of_polynomial(
    polynomial: FracElement, growth: Mapping[str, Growth], assumptions: Assumptions
) -> tuple[Expr, Expr]:
    laws = [growth[str(s)] for s in polynomial.ring.symbols[1:]]
    found: list[tuple[Expr, Expr]] = []
    for (half_pi, *powers), number in polynomial.terms():
        exponent, constant = (
            Integer(0),
            sympy.pi ** (2 * half_pi) * Rational(number.numerator, number.denominator),
        )
        for law, k in zip(laws, powers, strict=True):
            if k:
                exponent, constant = exponent + k * law.exponent, constant * law.constant**k
        found.append((sympy.expand(exponent), constant))
    return _largest(found, assumptions)


def _largest(terms: list[tuple[Expr, Expr]], assumptions: Assumptions) -> tuple[Expr, Expr]:
    """The largest exponent with the sum of its constants; sums that vanish are passed over."""
    sums: dict[Expr, Expr] = {}
    for exponent, constant in terms:
        sums[exponent] = sums.get(exponent, Integer(0)) + constant
    left = [(e, c) for e, c in sums.items() if c != 0]
    best = left[0]
    for candidate in left[1:]:
        larger = nonnegative(candidate[0] - best[0], assumptions)
        if larger is None and not nonnegative(best[0] - candidate[0], assumptions):
            raise UndecidedSign(
                "powers of N must be comparable: the sign of "
                f"{candidate[0] - best[0]} varies for {', '.join(map(str, assumptions))}"
            )
        best = candidate if larger else best
    return best
