"""Finitely many classes of directions: the worst of them gives the rate, with uniform constants.

If 0 <= v(k) <= C(k) g for each of n classes, and κ g <= v(r) for one of them, then

    κ g <= Σ v(k) <= (Σ C(k)) g,

where κ, the C(k) and n are free of N, and v and g are not. (The paper, Sec. 6.1 and Appendix B:
what holds of the claim that one direction gives the rate.)
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .jitter_bounds import said
from .tactics import ONE, ZERO, combine, positive, real, whole

k, n, r, g, kappa = real("k n r g kappa")
v, C = sympy.Function("v"), sympy.Function("C")
_INDEX = (*whole(k), Claim(ONE, "<=", k))
NOT_NEGATIVE = Claim(ZERO, "<=", v(k), _INDEX, over=(k,))
BOUNDED = Claim(v(k), "<=", C(k) * g, _INDEX, over=(k,))
SIZE = (*whole(n), Claim(ZERO, "<=", n))
ONE_OF_THEM = (*whole(n, r), Claim(ONE, "<=", r), Claim(r, "<=", n))


def total(f: Expr, low: Expr | int, high: Expr) -> Expr:
    """Σ f, k = low, ..., high."""
    return sympy.Sum(f, (k, low, high))


@cache
def from_above() -> Step:
    """Σ v(k) <= (Σ C(k)) g."""
    given = (BOUNDED, *SIZE)
    here = said((BOUNDED, *_INDEX), BOUNDED)
    rows = Step(Claim(total(v(k), 1, n), "<=", total(C(k) * g, 1, n), given), by.Bind(), (here,))
    scale = Step(
        Claim(total(C(k) * g, 1, n), "=", g * total(C(k), 1, n), given), by.Linear(((g, C(k)),))
    )
    claim = Claim(total(v(k), 1, n), "<=", total(C(k), 1, n) * g, given)
    return combine(claim, (1, rows), (1, scale))


def _not_negative(low: Expr | int, high: Expr, given: tuple[Claim, ...]) -> Step:
    """0 <= Σ v(k) over a part of the classes, low >= 1."""
    inside = (NOT_NEGATIVE, *_INDEX)
    here = said(inside, NOT_NEGATIVE)
    zeros = total(ZERO, low, high)
    rows = Step(Claim(zeros, "<=", total(v(k), low, high), given), by.Bind(), (here,))
    none = Step(Claim(zeros, "=", ZERO, given), by.Linear(()))
    return combine(Claim(ZERO, "<=", total(v(k), low, high), given), (1, rows), (-1, none))


@cache
def from_below() -> Step:
    """κ g <= Σ v(k)."""
    large = Claim(kappa * g, "<=", v(r))
    given = (NOT_NEGATIVE, *ONE_OF_THEM, large)
    cut = Step(
        Claim(total(v(k), 1, n), "=", total(v(k), 1, r - 1) + total(v(k), r, n), given),
        by.Range(r - 1),
    )
    again = Step(
        Claim(total(v(k), r, n), "=", total(v(k), r, r) + total(v(k), r + 1, n), given),
        by.Range(r),
    )
    alone = Step(Claim(total(v(k), r, r), "=", v(r), given), by.Range())
    claim = Claim(kappa * g, "<=", total(v(k), 1, n), given)
    return combine(
        claim, (-1, cut), (-1, again), (-1, alone), (1, said(given, large)),
        (1, _not_negative(1, r - 1, given)), (1, _not_negative(r + 1, n, given)),
    )  # fmt: skip


@cache
def two_slopes(before: bool) -> Step:
    """A/N³ + B/N is at most twice its larger part: A/N³ while B N² <= A, B/N after."""
    A, B, N = real("A B N")
    fast, slow = A / N**3, B / N
    order = Claim(B * N**2, "<=", A) if before else Claim(A, "<=", B * N**2)
    given = (*positive(A, B, N), order)
    claim = Claim(fast + slow, "<=", 2 * (fast if before else slow), given)
    return combine(claim, (N**-3, said(given, order)))
