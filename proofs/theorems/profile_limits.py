"""What profiles cannot be, Eqs. 18 and 34: an equality, and a bound for regular grids.

Jitter lies strictly below its monomial: 1 − sinc²(1/4) < (π²/3)/16. A regular grid of N points has
at m = N the power

    (1/N²) Σ_k Σ_j cos 2π(j − k) = 1,

since every cosine is 1, so that no γ/N with γ free of N bounds it.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .exponential_sums import N, j, jitter_on_an_axis, k, m, sinc_square
from .jitter_bounds import said
from .tactics import ONE, ZERO, chain, combine, limit_of_powers, real, transferred, whole

(M,) = real("M")
pi, cos = sympy.pi, sympy.cos
TWO = sympy.Integer(2)

AS_EQUALITY = Claim(
    jitter_on_an_axis().claim.left, "=", (pi**2 / 3) * (m / N) ** 2 / N,
    (*jitter_on_an_axis().claim.given, Claim(m, "<", sympy.sqrt(3) / pi * N)),
)  # fmt: skip
"""Eq. 18 for jitter on an axis, below α N."""


@cache
def below_its_monomial() -> Step:
    """At N = 4, m = 1: P_S = (1 − sinc²(1/4))/4 = 0.0473..., and the monomial is 0.0514..."""
    values = ((N, sympy.Integer(4)), (m, ONE))
    there = AS_EQUALITY.at(*values)
    value = (1 - sinc_square(m)).xreplace(dict(values)) / 4
    exact = Step(Claim(there.left, "=", value), by.Instance(values), (jitter_on_an_axis(),))
    below = Step(Claim(value, "<", there.right), by.Interval())
    less = chain(Claim(there.left, "<", there.right), exact, below)
    return Step(replace(AS_EQUALITY, false=True), by.Counterexample(values), (less,))


@cache
def count(over: Symbol = j) -> Step:
    """Σ 1 = M + 1 over 0, ..., M."""
    size = (*whole(M), Claim(ZERO, "<=", M))
    ones = sympy.Sum(ONE, (over, 0, M))
    base = Step(Claim(ones.xreplace({M: ZERO}), "=", ONE), by.Range())
    before = (*size, Claim(ones, "=", M + 1))
    longer = sympy.Sum(ONE, (over, 0, M + 1))
    last = sympy.Sum(ONE, (over, M + 1, M + 1))
    step = chain(
        Claim(longer, "=", M + 2, before),
        Step(Claim(longer, "=", ones + last, before), by.Range(M)),
        Step(Claim(last, "=", ONE, before), by.Range()),
        said(before, before[-1]),
    )
    return Step(Claim(ones, "=", M + 1, size), by.Induction(M, ZERO), (base, step))


_ROW = sympy.Sum(cos(2 * pi * (j - k)), (j, 0, N - 1))
GRID = sympy.Sum(_ROW, (k, 0, N - 1)) / N**2
"""The power of a regular grid at m = N."""
_POINTS = (*whole(N), Claim(ONE, "<", N))
COMB = Claim(GRID, "O", 1 / N, _POINTS, N)


@cache
def comb() -> Step:
    """It is 1."""
    given = (*whole(N), Claim(ONE, "<=", N))
    strata = (*given, *whole(k), Claim(ZERO, "<=", k), Claim(k, "<=", N - 1))
    inside = (*strata, *whole(j), Claim(ZERO, "<=", j), Claim(j, "<=", N - 1))
    wave = combine(Claim(cos(2 * pi * (j - k)), "=", ONE, inside))
    ones = sympy.Sum(ONE, (j, 0, N - 1))
    row = Step(Claim(_ROW, "=", ones, strata), by.Bind(), (wave,))
    counted = Step(Claim(ones, "=", N, strata), by.Instance(((M, N - 1),)), (count(),))
    full = chain(Claim(_ROW, "=", N, strata), row, counted)
    same = sympy.Sum(N, (k, 0, N - 1))
    rows = Step(Claim(sympy.Sum(_ROW, (k, 0, N - 1)), "=", same, given), by.Bind(), (full,))
    ones_k = sympy.Sum(ONE, (k, 0, N - 1))
    scaled = Step(Claim(same, "=", N * ones_k, given), by.Linear(((N, ONE),)))
    again = Step(Claim(ones_k, "=", N, given), by.Instance(((M, N - 1),)), (count(k),))
    return combine(Claim(GRID, "=", ONE, given), (N**-2, rows), (N**-2, scaled), (1 / N, again))


@cache
def comb_is_not_bounded() -> Step:
    """N · 1 → ∞."""
    found = comb()
    limit = limit_of_powers(N * found.claim.right, [(ONE, ONE)], N, _POINTS, sympy.oo)
    moved = replace(found.claim, given=_POINTS)
    reached = transferred(Step(moved, by.Instance(()), (found,)), limit, N)
    return Step(replace(COMB, false=True), by.Counterexample(()), (reached,))
