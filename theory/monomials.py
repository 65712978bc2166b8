"""Sums of monomials over the field of a kernel's counts: powers, like terms, what vanishes.

A monomial is a set of letters with their powers. Coefficients stay exact, so that what cancels is
gone before the counts are replaced by their growth laws.
"""

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping
from math import comb
from typing import TypeAlias, TypeVar

from .layouts import Growth
from .symbolic import Expr, FracElement, Integer, Rational

Letter = TypeVar("Letter", bound=Hashable)

Monomial: TypeAlias = frozenset[tuple[Letter, int]]
"""Letters with their powers, which are positive."""

Sum: TypeAlias = dict[Monomial[Letter], FracElement]


def collected(pairs: Iterable[tuple[Monomial[Letter], FracElement]]) -> Sum[Letter]:
    """Like monomials added, those that cancel dropped."""
    total: Sum[Letter] = {}
    for monomial, coefficient in pairs:
        total[monomial] = total[monomial] + coefficient if monomial in total else coefficient
    return {m: c for m, c in total.items() if c != 0}


def product_of(first: Sum[Letter], second: Sum[Letter]) -> Sum[Letter]:
    """The product of two sums."""
    return collected((_merged(a, b), x * y) for a, x in first.items() for b, y in second.items())


def power_of(base: Sum[Letter], count: int) -> Sum[Letter]:
    """base^count by the multinomial theorem, count at least 1."""
    return collected(_expanded(list(base.items()), count))


def _expanded(
    pieces: list[tuple[Monomial[Letter], FracElement]], count: int
) -> Iterator[tuple[Monomial[Letter], FracElement]]:
    if not pieces:
        return
    (monomial, coefficient), *rest = pieces
    for k in range(count) if rest else ():
        own, factor = _raised(monomial, k), comb(count, k) * coefficient**k
        for other, value in _expanded(rest, count - k):
            yield _merged(own, other), factor * value
    yield _raised(monomial, count), coefficient**count


def _raised(monomial: Monomial[Letter], k: int) -> Monomial[Letter]:
    return frozenset((letter, k * power) for letter, power in monomial) if k else frozenset()


def _merged(first: Monomial[Letter], second: Monomial[Letter]) -> Monomial[Letter]:
    return frozenset((Counter(dict(first)) + Counter(dict(second))).items())


def vanishes(coefficient: FracElement, growth: Mapping[str, Growth]) -> bool:
    """Whether a coefficient is zero for counts that obey their laws, as N − s² is for N = s²."""
    laws = [growth[str(s)] for s in coefficient.field.symbols[1:]]
    sums: dict[tuple[int, Expr], Expr] = {}
    for (half_pi, *powers), number in coefficient.numer.terms():
        exponent, constant = Integer(0), Rational(number.numerator, number.denominator)
        for law, k in zip(laws, powers, strict=True):
            exponent, constant = exponent + k * law.exponent, constant * law.constant**k
        sums[half_pi, exponent] = sums.get((half_pi, exponent), Integer(0)) + constant
    return all(c.expand() == 0 for c in sums.values())
