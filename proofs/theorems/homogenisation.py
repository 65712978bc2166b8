"""Homogenisation of an integrand that is not periodic: f = x on [0, 1] under 1D jitter.

Unshifted, N cells have the variance of a uniform place in each,

    V_0 = (1/N²) Σ_j ∫_0^1 ((u − 1/2)/N)² du = 1/(12N³).

A random shift turns the points of the circle, and the one whose cell lies over the end of [0, 1]
loses 1 with it. With u its place in its cell and v its turned place, independent of u,

    V_1 = (1/N²) [Σ_{j<N} ∫ ((u − 1/2)/N)² du + ∫∫ ((1/N − 1)(u − 1/2) + v − 1/2)² dv du]
        = (2N − 1)/(12N³),

so that V_0 falls as N^−3 and V_1 as N^−2: Eq. 4 is for f that is periodic, or 0 near the ends.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .strata import M, count, half, j, sizes
from .tactics import ONE, ZERO, combine, limit_of_powers, real, transferred

N, u, v = real("N u v")
CELL = sympy.Integral(((u - half) / N) ** 2, (u, 0, 1))
TURNED = sympy.Integral(((1 / N - 1) * (u - half) + v - half) ** 2, (v, 0, 1), (u, 0, 1))


def _positive(given: tuple[Claim, ...]) -> Step:
    least = Step(Claim(ONE, "<=", N, given), by.Given())
    return combine(Claim(ZERO, "<", N, given), (1, least), remainder=1)


def _cells(last: Expr) -> Step:
    """Σ_{j=1}^{last} of the variance of a place in a cell."""
    given = sizes(N)
    large = _positive(given)
    cell = Step(
        Claim(CELL, "=", 1 / (12 * N**2), given), by.Antiderivative((u - half) ** 3 / (3 * N**2)),
        (large,),
    )  # fmt: skip
    total, ones = sympy.Sum(CELL, (j, 1, last)), sympy.Sum(ONE, (j, 1, last))
    least = Step(Claim(ONE, "<=", N, given), by.Given())
    size = Step(Claim(ones, "=", last, given), by.Instance(((M, last),)), (count(), least))
    each = 1 / (12 * N**2)
    rows = Step(Claim(total, "=", sympy.Sum(each, (j, 1, last)), given), by.Bind(), (cell, large))
    scale = Step(
        Claim(rows.claim.right, "=", each * ones, given), by.Linear(((each, ONE),)), (large,)
    )
    return combine(
        Claim(total, "=", last * each, given), (1, rows), (1, scale), (each, size), (0, large)
    )


@cache
def unshifted() -> Step:
    """V_0 = 1/(12N³)."""
    known, large = _cells(N), _positive(sizes(N))
    claim = Claim(known.claim.left / N**2, "=", 1 / (12 * N**3), sizes(N))
    return combine(claim, (1 / N**2, known), (0, large))


@cache
def shifted() -> Step:
    """V_1 = (2N − 1)/(12N³)."""
    given = sizes(N)
    large, cells = _positive(given), _cells(N - 1)
    slope, place = 1 / N - 1, u - half
    line = sympy.Integral(TURNED.function, (v, 0, 1))
    square = slope**2 * place**2 + sympy.Rational(1, 12)
    inner = Step(
        Claim(line, "=", square, given), by.Antiderivative((slope * place + v - half) ** 3 / 3),
        (large,),
    )  # fmt: skip
    outer = sympy.Integral(square, (u, 0, 1))
    value = slope**2 / 12 + sympy.Rational(1, 12)
    total = Step(
        Claim(outer, "=", value, given), by.Antiderivative(slope**2 * place**3 / 3 + u / 12),
        (large,),
    )  # fmt: skip
    bound = Step(Claim(TURNED, "=", outer, given), by.Bind(), (inner, total, large))
    left = (cells.claim.left + TURNED) / N**2
    uses = ((1 / N**2, s) for s in (cells, bound, total))
    return combine(Claim(left, "=", (2 * N - 1) / (12 * N**3), given), *uses, (0, large))


PRINTED = Claim(shifted().claim.left, "O", N**-3, sizes(N), N)
"""A shift leaves the rate of the variance as it is."""


@cache
def refutation() -> Step:
    """N³ V_1 = (2N − 1)/12 grows."""
    known, given = shifted(), sizes(N)
    twelfth = sympy.Rational(1, 12)
    grows = limit_of_powers(
        N**3 * known.claim.right, [(2 * twelfth, ONE), (-twelfth, ZERO)], N, given, sympy.oo
    )
    limit = transferred(known, grows, N**3)
    return Step(replace(PRINTED, false=True), by.Counterexample(()), (limit,))
