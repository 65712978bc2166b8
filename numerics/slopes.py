"""Exponents from variances at several N: straight-line fits, and a test that allows for drift.

A straight line on log-log axes is a description, not a test: the local slopes of an N^-3/2 law can
be -1.44 at N = 16. A bare exponent r is tested in

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
from fractions import Fraction
from math import isfinite, log, sqrt
from typing import Any, Literal, TypeAlias

import numpy as np

from ..theory.errors import InputError
from .campaign import Interval
from .integrands.protocol import Floats

Verdict: TypeAlias = Literal["contradicted", "consistent", "inconclusive"]
Exponent: TypeAlias = float | Fraction

DELTAS = (0.25, 4.0)
"""Range of the drift's exponent delta."""

_LARGEST = 1e30  # the powers of N that the drift takes stay within double precision

_FLAT = (
    1e6  # a wide drift ends where its last term a N_J^-delta is this large: a steeper pure power
)
_COARSE, _FINE, _ROUNDS = 49, 9, 7  # drift amplitudes per search, then per zoom, and zooms
_DELTA_GRID = (25, 9, 9)  # delta: over its range, then twice around the best
_BISECTIONS = 25
_SECOND_ORDER = 0.01  # multi-jitter x disk departs from a single drift term by less than this
_SWEEPS, _CONVERGED = (
    1000,
    1e-7,
)  # of the dual ascent; stopped early, it still bounds chi^2 from below


@dataclass(frozen=True)
class RatePoint:
    """Variance at one N, with the standard error of its logarithm."""

    n: float
    variance: float
    relative_error: float

    def __post_init__(self) -> None:
        if not 2 <= self.n <= _LARGEST:
            raise InputError(f"a point must satisfy 2 <= N <= {_LARGEST:g}: got {self.n}")
        for name, value in (("variance", self.variance), ("relative error", self.relative_error)):
            if not (value > 0 and isfinite(value)):
                raise InputError(f"a point must satisfy 0 < {name} < oo: got {value}")


@dataclass(frozen=True)
class SlopeFit:
    """Weighted straight line ``log V - q log log N = intercept + slope log N``."""

    slope: Interval
    intercept: float
    chi2: float
    local_slopes: tuple[Interval, ...]


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


@dataclass(frozen=True)
class _Ladder:
    """Points in logarithms: x = log(N/N_1), y = log V - q log log N, weights 1/error^2."""

    x: Floats
    y: Floats
    w: Floats

    def centred(self, values: Floats) -> Floats:
        """Values minus their weighted mean over the last axis, which profiles out log C."""
        return values - (values @ self.w / self.w.sum())[..., None]

    def drift(self, delta: Floats, v: Floats) -> Floats:
        """``log(1 + A exp(-delta x))`` with ``A = expm1(v)``, centred; a last axis for points."""
        decay = np.exp(-delta[..., None] * self.x)
        return self.centred(np.log1p(np.expm1(v)[..., None] * decay))


def fit_slope(
    points: Sequence[RatePoint], log_power: Exponent = 0, level: float = 0.05
) -> SlopeFit:
    """Weighted least squares of log V - q log log N against log N.

    Parameters
    ----------
    points : sequence of RatePoint
        At least 2, at different N.
    log_power : float or Fraction
        q, the power of log N that is divided out.
    level : float
        Probability that each interval should miss; 0 < level < 1.

    Returns
    -------
    SlopeFit
        The slope is that of V against N, negative where V falls. Its interval follows from the
        errors of the points, never from the scatter about the line; chi^2 has J - 2 degrees of
        freedom if the law is a pure power.
    """
    ladder, x0 = _ladder(points, log_power, 2)
    z = -float(_special().ndtri(_checked(level) / 2))
    dx, dy = ladder.centred(ladder.x), ladder.centred(ladder.y)
    information = float(ladder.w @ dx**2)
    slope = float(ladder.w @ (dx * dy)) / information
    residual = dy - slope * dx
    mean = float(ladder.w @ (ladder.y - slope * (ladder.x + x0)) / ladder.w.sum())
    steps = np.diff(ladder.x)
    local = np.diff(ladder.y) / steps
    errors = np.sqrt(1 / ladder.w[1:] + 1 / ladder.w[:-1]) / steps
    return SlopeFit(
        _interval(slope, z / sqrt(information)),
        mean,
        float(ladder.w @ residual**2),
        tuple(_interval(float(s), z * float(e)) for s, e in zip(local, errors, strict=True)),
    )


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
        independent, which at small levels calls for those of `campaign.relative_error`.
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
    ladder, x0 = _ladder(points, log_power, 1)
    threshold = float(_special().chdtri(len(points), _checked(level)))
    bounds = (log(1 - rising_drift), log(1 + rising_drift))
    chi2 = _least_chi2(ladder, float(exponent), rising_drift)
    fit_chi2, v, delta = _best_drift(ladder, float(exponent), bounds[0])
    low, high = _exponents(ladder, threshold, bounds)
    inside = abs(low - float(exponent)) <= margin and abs(high - float(exponent)) <= margin
    verdict: Verdict = "inconclusive"
    if len(points) >= 3 and chi2 > threshold:
        verdict = "contradicted"
    elif len(points) >= 3 and inside:
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


def _least_chi2(ladder: _Ladder, exponent: float, rising_drift: float) -> float:
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


def _best_drift(ladder: _Ladder, exponent: float, lowest: float) -> tuple[float, float, float]:
    """Least chi^2 over single wide drift terms, with its v = log(1 + A) and delta."""
    target = ladder.centred(ladder.y + exponent * ladder.x)

    def profile(delta: Floats) -> tuple[Floats, Floats]:
        def chi2(v: Floats) -> Floats:
            return (target - ladder.drift(delta[:, None], v)) ** 2 @ ladder.w

        ends = np.full_like(delta, lowest), delta * ladder.x[-1] + log(_FLAT)
        return _zoom(chi2, *ends)

    return _over_delta(profile)


def _exponents(
    ladder: _Ladder, threshold: float, bounds: tuple[float, float]
) -> tuple[float, float]:
    """Ends of the exponents that narrow drift allows; nan if there are none.

    For a given drift chi^2 is a parabola in r, so that the exponents allowed are those within
    ``sqrt((threshold - least)/information)`` of its vertex: only the drift is searched.
    """
    if ladder.x.size < 2:
        return (np.nan, np.nan)
    ladder = _Ladder(ladder.x, ladder.y, 1 / (1 / ladder.w + _SECOND_ORDER**2))
    dx, dy = ladder.centred(ladder.x), ladder.centred(ladder.y)
    information = float(ladder.w @ dx**2)

    def vertex(delta: Floats, v: Floats) -> tuple[Floats, Floats]:
        rest = dy - ladder.drift(delta, v)
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


def _ladder(points: Sequence[RatePoint], log_power: Exponent, least: int) -> tuple[_Ladder, float]:
    """The points sorted by N, in logarithms, and log N_1."""
    ordered = sorted(points, key=lambda p: p.n)
    sizes = [p.n for p in ordered]
    if len(set(sizes)) < len(sizes) or len(sizes) < least:
        raise InputError(f"a fit needs {least} or more points, all at different N: got {sizes}")
    x = np.log([float(n) for n in sizes])
    y = np.log([p.variance for p in ordered]) - float(log_power) * np.log(x)
    w = np.array([p.relative_error for p in ordered]) ** -2.0
    return _Ladder(x - x[0], y, w), float(x[0])


def _checked(level: float) -> float:
    if not 0 < level < 1:
        raise InputError(f"a level must satisfy 0 < level < 1: got {level}")
    return level


def _interval(estimate: float, half: float) -> Interval:
    return Interval(estimate, estimate - half, estimate + half)


def _special() -> Any:
    from scipy import special  # pyright: ignore[reportMissingTypeStubs]

    return special
