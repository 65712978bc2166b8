"""Growth: limits of Σ c exp(r N) N^k (log N)^j as N → ∞, by comparing r, then k, then j."""

from typing import TypeAlias

from ...theory.symbolic import Expr, Symbol, sympy
from .facts import Facts, above
from .grammar import require
from .normal_forms import zero

Term: TypeAlias = tuple[Expr, Expr, Expr, int]
"""c, r, k, j, of which none has N in it."""

_ONE: Term = (sympy.S.One, sympy.S.Zero, sympy.S.Zero, 0)


def term_at(t: Term, n: Symbol) -> Expr:
    """c exp(r n) n^k (log n)^j."""
    return t[0] * sympy.exp(t[1] * n) * n ** t[2] * sympy.log(n) ** t[3]


def smaller(s: Term, t: Term, facts: Facts) -> bool:
    """Whether exp(r N) N^k (log N)^j of s over that of t is seen to tend to 0."""
    if above(t[1] - s[1], facts, True):
        return True
    if not zero(t[1] - s[1], facts):
        return False
    return above(t[2] - s[2], facts, True) or (zero(t[2] - s[2], facts) and s[3] < t[3])


def limit_of(terms: tuple[Term, ...], infinite: bool, facts: Facts) -> Expr:
    """The limit of the sum; for an infinite one the first term leads.

    Raises
    ------
    Refused
        If the terms cannot be compared.
    """
    if infinite:
        lead, *others = terms
        require(above(lead[0], facts, True) and smaller(_ONE, lead, facts), "does not grow", lead)
        led = (smaller(t, lead, facts) or above(t[0], facts) for t in others)
        require(all(led), "the first term does not lead")
        return sympy.oo
    kept = [t for t in terms if not smaller(t, _ONE, facts)]
    steady = (t[3] == 0 and zero(t[1], facts) and zero(t[2], facts) for t in kept)
    require(all(steady), "may grow")
    return sum((t[0] for t in kept), sympy.S.Zero)
