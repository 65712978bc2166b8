r"""Mean covariogram over small cells: series at distance 0, Taylor series away from it.

The mean is over h = p + t with independent triangular t_i, |t_i| < w_i (lengths in units of 2R), of
the projected covariogram J (see ``covariograms``), at z = |h|, y = z².

*At p = 0.* With α = (d - 1)/2, J(0) - J(z) = ∫_0^z (1 - σ²)^α dσ for k = 0, a polynomial for k = 2,
and for k = 1 the hypergeometric equation has exponents 0 and 1 at y = 0, hence J = Σ y^j (A_j +
B_j ln y) with A_0 = 1/(2α + 2), B_1 = 1/4, A_1 = -1/4 - (ln 2)/2 + H_α/4 (H_{1/2} = 2 - 2 ln 2,
H_1 = 1) and with P_j = (j - 3/2)(j - 2 - α)

    j (j - 1) B_j = P_j B_{j-1},
    j (j - 1) A_j = P_j A_{j-1} + (2j - 7/2 - α) B_{j-1} - (2j - 1) B_j.

Each term meets a moment of |t| (``distance_moments``): however small the cell is, J(0) is not there
to cancel.

*At p ≠ 0.* y = |p|² + u with u = Σ (2 p_i t_i + t_i²) and E J = Σ_l J_l E u^l, the Taylor
coefficients from the same equation and |u| <= U = Σ (2 |p_i| w_i + w_i²).
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache, reduce
from math import comb
from typing import TypeAlias

from ..balls import Ball, Rational, flint
from .covariograms import Covariogram, slope, value
from .distance_moments import log_moment, moments

Tooth: TypeAlias = tuple[Rational, Rational]
"""Centre p >= 0 and half-width w >= 0 of a triangle on one axis, in units of 2R."""

_CLOSEST = 4  # from this index on the coefficients of the logarithmic series decrease


def mean_deficit(covariogram: Covariogram, widths: Sequence[Rational]) -> Ball:
    """E (J(0) - J(|t|)); what cancels is what unequal widths make cancel in the moments of |t|.

    Parameters
    ----------
    covariogram : Covariogram
    widths : sequence of rationals, at most dim - flat
        Half-widths, with Σ w_i² < 1: every distance is below 2R.
    """
    if not widths:
        return flint.arb(0)
    balls = [flint.arb(w) for w in widths]
    if covariogram.flat == 2:
        powers = {2: flint.fmpq(2, 3), 3: flint.fmpq(-2, 3), 5: flint.fmpq(2, 15)}
        w = balls[0]
        return sum((2 * c * w**p / ((p + 1) * (p + 2)) for p, c in powers.items()), flint.arb(0))
    largest = flint.arb(sum(w**2 for w in widths))
    if covariogram.flat == 0:
        return _power_series(covariogram, balls, largest)
    return _logarithmic_series(covariogram, balls, largest)


def _power_series(covariogram: Covariogram, widths: list[Ball], largest: Ball) -> Ball:
    """Σ_j (-1)^j binom(α, j) E z^(2j+1)/(2j + 1).

    |binom(α, j)| does not increase for 0 <= α <= 1 and E z^(p+2) <= (max y) E z^p, so that what
    follows a term t is at most |t| (max y)/(1 - max y).
    """
    alpha = flint.fmpq(covariogram.dim - 1, 2)
    binomial, total = flint.arb(1), flint.arb(0)
    for j, moment in enumerate(moments(widths, 1)):
        term = binomial * moment / (2 * j + 1)
        total += term
        if alpha == j:
            break  # a polynomial
        tail = abs(term) * largest / (1 - largest)
        if _negligible(tail, total):
            return total + flint.arb(0, tail.upper())
        binomial *= (j - alpha) / (j + 1)
    return total


def _logarithmic_series(covariogram: Covariogram, widths: list[Ball], largest: Ball) -> Ball:
    """-Σ_{j>=1} E y^j (A_j + B_j ln y).

    For j >= 4, |A_j| + |B_j| does not increase. d = 2: with q = P_j/(j (j - 1)), 0 < q < 1, the
    step is at most q |A| + (q + |2j - 4 - (2j - 1) q|/(j (j - 1))) |B|, and the second bracket
    differs from 1 by (3j³ - 39j²/4 + 45j/4 - 15/4)/(j² (j - 1)²) > 0. d = 3: B_j = 0 from j = 3
    on, and 0 < q < 1. As y < max y < 1, E y^(j+1) |ln y| <= (max y) E y^j |ln y|.
    """
    total = flint.arb(0)
    series = zip(_logarithmic_coefficients(covariogram), moments(widths, 2), strict=False)
    for j, ((a, b), moment) in enumerate(series, 1):
        log = 2 * log_moment(widths, 2 * j) if b != 0 else flint.arb(0)
        if j >= _CLOSEST:
            tail = (abs(a) + abs(b)) * (moment + abs(log)) / (1 - largest)
            if _negligible(tail, total):
                return -total + flint.arb(0, tail.upper())
        total += a * moment + b * log
    raise AssertionError


def _logarithmic_coefficients(covariogram: Covariogram) -> Iterator[tuple[Ball, Ball]]:
    """(A_j, B_j) for j = 1, 2, ..."""
    alpha = flint.fmpq(covariogram.dim - 1, 2)
    ln2 = flint.arb(2).log()
    harmonic = 2 - 2 * ln2 if covariogram.dim == 2 else flint.arb(1)
    a, b = (harmonic - 1 - 2 * ln2) / 4, flint.arb(flint.fmpq(1, 4))
    j = 1
    while True:
        yield a, b
        j += 1
        p = flint.fmpq(2 * j - 3, 2) * (j - 2 - alpha)
        before, b = b, p * b / (j * (j - 1))
        a = (p * a + (2 * j - flint.fmpq(7, 2) - alpha) * before - (2 * j - 1) * b) / (j * (j - 1))


def _negligible(tail: Ball, total: Ball) -> bool:
    """Below the last bit of the total or its error (which may be infinite)."""
    return not tail > abs(total.mid()) * flint.arb(2) ** -flint.ctx.prec + total.rad()


def mean_at_distance(covariogram: Covariogram, teeth: Sequence[Tooth]) -> Ball | None:
    """E J(|p + t|) by Taylor's series, or None where the cell is too near to z = 0 or z = 1.

    Parameters
    ----------
    covariogram : Covariogram
    teeth : sequence of Tooth, at most dim - flat
        With half-width 0 for a point; not all centres 0.

    Notes
    -----
    On the disc |y - y_0| <= r with r < min(y_0, 1 - y_0), the straight path v = y + (1 - y) t from
    y to 1 in J(y) = (1/2) ∫_y^1 (1 - v)^α (v - y)^{k/2} v^{-1/2} dv gives |J| <= M = (1 - y_0 +
    r)^{(d + k + 1)/2}/(2 √(y_0 - r)), so that |J_l| <= M/r^l (Cauchy).
    """
    y0 = sum((p**2 for p, _ in teeth), flint.fmpq(0))
    reach = sum(((2 * p + w) * w for p, w in teeth), flint.fmpq(0))
    radius = min(y0, 1 - y0) * flint.fmpq(7, 8)
    if reach * 2 > radius:
        return None
    if reach == 0:
        return value(covariogram, flint.arb(y0))
    ratio = flint.arb(reach / radius)
    power = flint.fmpq(covariogram.dim + covariogram.flat + 1, 2)
    largest = flint.arb(1 - y0 + radius) ** power / (2 * flint.arb(y0 - radius).sqrt())
    terms = 2 + 8 * flint.ctx.prec // (int((radius / reach) ** 8).bit_length() - 1)
    means = reduce(_convolved, (_tooth_powers(p, w, terms, flint.ctx.prec) for p, w in teeth))
    total = flint.arb(0)
    for coefficient, mean in zip(_taylor(covariogram, y0, terms), means, strict=True):
        total += coefficient * mean
    return total + flint.arb(0, (largest * ratio**terms / (1 - ratio)).upper())


def _taylor(covariogram: Covariogram, y0: Rational, terms: int) -> Iterator[Ball]:
    """J_l for l < terms, from the hypergeometric equation."""
    d, k = covariogram.dim, covariogram.flat
    a, b, c = flint.fmpq(-k, 2), flint.fmpq(-d - k, 2), flint.fmpq(1 - k, 2)
    y = flint.arb(y0)
    here, after = value(covariogram, y), slope(covariogram, y)
    curvature, bend, tilt = y * (1 - y), 1 - 2 * y, c - (a + b + 1) * y
    for n in range(terms):
        yield here
        pull = (n + 1) * (n * bend + tilt) * after - (n + a) * (n + b) * here
        here, after = after, -pull / ((n + 1) * (n + 2) * curvature)


@lru_cache(maxsize=4096)
def _tooth_powers(
    centre: Rational, width: Rational, terms: int, precision: int
) -> tuple[Ball, ...]:
    """E u^l, l < terms, of u = 2 p t + t², in balls of the precision in force."""
    del precision  # part of the cache's key only
    twice, square = flint.arb(2 * centre), flint.arb(width**2)
    even = [2 * square**s / ((2 * s + 1) * (2 * s + 2)) for s in range(terms)]  # E t^(2s)
    powers = [twice**q for q in range(terms)]
    return tuple(
        sum(
            (comb(n, q) * powers[n - q] * even[(n + q) // 2] for q in range(n % 2, n + 1, 2)),
            flint.arb(0),
        )
        for n in range(terms)
    )


def _convolved(x: Sequence[Ball], y: Sequence[Ball]) -> tuple[Ball, ...]:
    """E (u + v)^l of independent u and v."""
    return tuple(
        sum((comb(n, q) * x[q] * y[n - q] for q in range(n + 1)), flint.arb(0))
        for n in range(len(x))
    )
