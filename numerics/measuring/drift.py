"""A claimed exponent tested on variances at several N, with allowance for a drift towards it.

A bare exponent r is tested in

    V = C N^-r (log N)^q (1 + a N^-delta),   1/4 <= delta <= 4,

by chi^2 on ``y = log(V N^r / (log N)^q)``, with C profiled out. Write A for the drift a N_1^-delta
at the smallest N. The allowance for a contradiction is *wide*: A >= -1/2 and no upper bound, as a
crossover from a faster decay may come at any N. A true law has further terms of drift, which small
errors would resolve, so that the claim is held against every course of y that falls anywhere and
rises between N_i and N_j by no more than some wide drift does: a convex set that contains them all.
The allowance for the exponents that the variances admit is *narrow*: |A| <= 1/2, one term, and an
error of 1 % on every point for the further ones.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite, log
from typing import Literal, TypeAlias

import numpy as np

from ...theory.errors import InputError
from ..integrands.protocol import Floats
from .moments import special
from .slopes import Exponent, Ladder, RatePoint, checked_level, ladder_of

Verdict: TypeAlias = Literal["contradicted", "consistent", "inconclusive"]

DELTAS = (0.25, 4.0)
"""Range of the drift's exponent delta."""

_FLAT = 1e6  # a wide drift ends where its last term a N_J^-delta is so large: a steeper pure power
_COARSE, _FINE, _ROUNDS = 49, 9, 7  # drift amplitudes per search, then per zoom, and zooms
_DELTA_GRID = (25, 9, 9)  # delta: over its range, then twice around the best
_BISECTIONS = 25
_SECOND_ORDER = 0.01  # multi-jitter x disk departs from a single drift term by less than this
_SWEEPS, _CONVERGED = 1000, 1e-7  # of the dual ascent; stopped early, it still bounds chi^2 below


@dataclass(frozen=True)
class DriftTest:
    """Outcome of `drift_test`.

    Parameters
    ----------
    verdict : {"contradicted", "consistent", "inconclusive"}
    low, high : float or None
        Exponents r that narrow drift allows, or None if it allows none.
    chi2, threshold : float
        Least chi^2 of the claim over the wide allowance, and the quantile that contradicts it.
    a, delta, fit_chi2 : float
        Single wide drift term ``1 + a N^-delta`` that fits best, and its chi^2.
    """

    verdict: Verdict
    low: float | None
    high: float | None
    chi2: float
    threshold: float
    a: float
    delta: float
    fit_chi2: float


def drift_test(
    points: Sequence[RatePoint],
    exponent: Exponent,
    log_power: Exponent = 0,
    level: float = 1e-6,
    *,
    rising_drift: float = 0.5,
    margin: float = 0.25,
) -> DriftTest:
    """Test the claim V ~ N^-exponent (log N)^log_power, allowing for a drift towards it.

    Parameters
    ----------
    points : sequence of RatePoint
        J points; fewer than 3 are always inconclusive. Errors of log V are taken as normal and
        independent, which at small levels calls for those of `moments.relative_error`.
    exponent, log_power : float or Fraction
        The claim.
    level : float
        Bound on the probability to contradict a true claim. The least chi^2 is compared with the
        quantile of J degrees of freedom, none being subtracted for C, a and delta.
    rising_drift : float
        Largest fraction by which V at the smallest N may lie below its asymptote, and for the
        interval also above it; 0 <= rising_drift < 1.
    margin : float
        Consistent means that the interval of exponents lies within the claim plus or minus this.
        On a ladder from 16 to 4096 narrow drift alone extends it by 0.07 to either side, and errors
        of 5 % at the default level by 0.17.

    Returns
    -------
    DriftTest

    Notes
    -----
    A law whose drift exceeds these bounds may be contradicted although true: the claim under test
    is the exponent together with the bounds. A decay that is steeper than claimed is never
    contradicted, only not consistent. With a logarithm the drift is often c/log N, slower than any
    power: its rises stay within the allowance while -c/log N > -1/2 at the smallest N and the
    ladder ends below about 1e6.
    """
    if not 0 <= rising_drift < 1:
        raise InputError(f"rising_drift must satisfy 0 <= rising_drift < 1: got {rising_drift}")
    ladder, x0 = ladder_of(points, log_power, 1)
    threshold = float(special().chdtri(len(points), checked_level(level)))
    bounds = (log(1 - rising_drift), log(1 + rising_drift))
    chi2 = _least_chi2(ladder, float(exponent), rising_drift)
    fit_chi2, v, delta = _best_drift(ladder, float(exponent), bounds[0])
    low, high = _exponents(ladder, threshold, bounds)
    inside = low <= exponent <= high and max(exponent - low, high - exponent) <= margin
    verdict: Verdict = "inconclusive"
    if len(points) >= 3 and chi2 > threshold:
        verdict = "contradicted"
    elif len(points) >= 3 and inside:  # and so not beside the claim, however near
        verdict = "consistent"
    found = isfinite(low)
    return DriftTest(
        verdict,
        low if found else None,
        high if found else None,
        chi2,
        threshold,
        float(np.expm1(v) * np.exp(delta * x0)),
        delta,
        fit_chi2,
    )


def _drift(ladder: Ladder, delta: Floats, v: Floats) -> Floats:
    """``log(1 + A exp(-delta x))`` with ``A = expm1(v)``, centred; a last axis for points."""
    decay = np.exp(-delta[..., None] * ladder.x)
    return ladder.centred(np.log1p(np.expm1(v)[..., None] * decay))


def _least_chi2(ladder: Ladder, exponent: float, rising_drift: float) -> float:
    """Least chi^2 over courses z with ``z_j - z_i <= rise_ij`` for i < j, from below.

    Ascent on the multipliers, one constraint at a time (Hildreth). Every set of multipliers bounds
    the least chi^2 from below, so that an early stop cannot contradict a true claim.
    """
    y = ladder.y + exponent * ladder.x
    first, last = np.triu_indices(y.size, 1)
    excess = y[last] - y[first] - _largest_rise(ladder.x, rising_drift)[first, last]
    inverse = [float(1 / w) for w in ladder.w]
    # In plain numbers: this inner loop is ten times slower on array elements.
    pairs = list(
        zip(range(len(excess)), first.tolist(), last.tolist(), excess.tolist(), strict=True)
    )
    multipliers, moved = [0.0] * len(pairs), [0.0] * y.size
    for _ in range(_SWEEPS):
        change = 0.0
        for k, i, j, gap in pairs:
            step = (gap + moved[j] - moved[i]) / (inverse[i] + inverse[j])
            step = max(step, -multipliers[k])
            multipliers[k] += step
            moved[j] -= step * inverse[j]
            moved[i] += step * inverse[i]
            change = max(change, abs(step))
        if change <= _CONVERGED * max(multipliers, default=0.0):
            break
    return max(0.0, float(2 * np.dot(multipliers, excess) - ladder.w @ np.square(moved)))


def _largest_rise(x: Floats, rising_drift: float) -> Floats:
    """Largest rise of ``log(1 - rising_drift exp(-delta x))`` from x_i to x_j over delta."""
    delta = np.geomspace(*DELTAS, 400)
    courses = np.log1p(-rising_drift * np.exp(-delta[:, None] * x))
    return np.max(courses[:, None, :] - courses[:, :, None], axis=0)


def _best_drift(ladder: Ladder, exponent: float, lowest: float) -> tuple[float, float, float]:
    """Least chi^2 over single wide drift terms, with its v = log(1 + A) and delta."""
    target = ladder.centred(ladder.y + exponent * ladder.x)

    def profile(delta: Floats) -> tuple[Floats, Floats]:
        def chi2(v: Floats) -> Floats:
            return (target - _drift(ladder, delta[:, None], v)) ** 2 @ ladder.w

        ends = np.full_like(delta, lowest), delta * ladder.x[-1] + log(_FLAT)
        return _zoom(chi2, *ends)

    return _over_delta(profile)


def _exponents(
    ladder: Ladder, threshold: float, bounds: tuple[float, float]
) -> tuple[float, float]:
    """Ends of the exponents that narrow drift allows; nan if there are none.

    For a given drift chi^2 is a parabola in r, so that the exponents allowed are those within
    ``sqrt((threshold - least)/information)`` of its vertex: only the drift is searched.
    """
    if ladder.x.size < 2:
        return (np.nan, np.nan)
    ladder = Ladder(ladder.x, ladder.y, 1 / (1 / ladder.w + _SECOND_ORDER**2))
    dx, dy = ladder.centred(ladder.x), ladder.centred(ladder.y)
    information = float(ladder.w @ dx**2)

    def vertex(delta: Floats, v: Floats) -> tuple[Floats, Floats]:
        rest = dy - _drift(ladder, delta, v)
        slope = rest @ (ladder.w * dx) / information
        return -slope, (rest - slope[..., None] * dx) ** 2 @ ladder.w

    def end(sign: float) -> float:
        def profile(delta: Floats) -> tuple[Floats, Floats]:
            grid = delta[:, None]
            ends = _feasible(lambda v: vertex(grid, v)[1], delta, threshold, bounds)

            def cost(v: Floats) -> Floats:
                r, least = vertex(grid, v)
                room = threshold - least
                reach = np.sqrt(np.maximum(room, 0) / information)
                slack = 1e-9 * threshold  # the bisected ends may miss by a rounding
                return np.where(room >= -slack, -(sign * r + reach), np.inf)

            return _zoom(cost, *ends)

        return -sign * _over_delta(profile)[0]

    low, high = end(-1.0), end(1.0)
    return (low, high) if isfinite(low) and isfinite(high) else (np.nan, np.nan)


def _feasible(
    chi2: Callable[[Floats], Floats], delta: Floats, threshold: float, bounds: tuple[float, float]
) -> tuple[Floats, Floats]:
    """For each delta the amplitudes around the best whose chi^2 is below the threshold."""
    edges = [np.full_like(delta, bound) for bound in bounds]
    best = _zoom(chi2, *edges)[1]
    ends: list[Floats] = []
    for edge in edges:
        inside, outside = best, edge
        good = chi2(edge[:, None])[:, 0] <= threshold
        for _ in range(_BISECTIONS):
            middle = (inside + outside) / 2
            below = chi2(middle[:, None])[:, 0] <= threshold
            inside, outside = np.where(below, middle, inside), np.where(below, outside, middle)
        ends.append(np.where(good, edge, inside))
    return ends[0], ends[1]


def _zoom(
    objective: Callable[[Floats], Floats], low: Floats, high: Floats
) -> tuple[Floats, Floats]:
    """Least value and its place, for each row: a grid, then finer ones around its best node.

    ``objective`` maps an array (rows, nodes) to the values there.
    """
    rows = np.arange(low.size)
    value, place = np.full(low.size, np.inf), low
    left, right = low, high
    for nodes in (_COARSE, *(_FINE,) * _ROUNDS):
        grid = left[:, None] + (right - left)[:, None] * np.linspace(0.0, 1.0, nodes)
        values = objective(grid)
        at = np.argmin(values, axis=1)
        better = values[rows, at] < value
        value = np.where(better, values[rows, at], value)
        place = np.where(better, grid[rows, at], place)
        step = (right - left) / (nodes - 1)
        left, right = np.maximum(place - step, low), np.minimum(place + step, high)
    return value, place


def _over_delta(
    profile: Callable[[Floats], tuple[Floats, Floats]],
) -> tuple[float, float, float]:
    """Least value of the profile over delta, with its place and its delta."""
    left, right = log(DELTAS[0]), log(DELTAS[1])
    best = (float("inf"), 0.0, DELTAS[0])
    for nodes in _DELTA_GRID:
        grid = np.linspace(left, right, nodes)
        values, places = profile(np.exp(grid))
        at = int(np.argmin(values))
        best = min(best, (float(values[at]), float(places[at]), float(np.exp(grid[at]))))
        centre, step = log(best[2]), (right - left) / (nodes - 1)
        left, right = max(centre - step, log(DELTAS[0])), min(centre + step, log(DELTAS[1]))
    return best
