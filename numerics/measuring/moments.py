"""Streaming Monte Carlo: central moments of the error I_N - I up to order 4, and what follows.

Replicates are drawn in blocks, and each block is folded into five numbers: the memory does not
depend on the count. Blocks from several processes merge into what one pass gives.
Errors are taken about the known integral I, so that their second moment is the mean squared error.
"""

from dataclasses import dataclass, replace
from math import inf, log, sqrt
from typing import Any, NamedTuple

import numpy as np

from ...theory.errors import InputError
from ..integrands.protocol import Floats, Integrand

_BLOCK = 2**19  # points evaluated at once, so that temporary arrays stay in the cache's reach


class Interval(NamedTuple):
    """An estimate and the ends of its confidence interval."""

    estimate: float
    low: float
    high: float


@dataclass(frozen=True)
class Moments:
    """Count, mean and sums of powers 2, 3, 4 of the deviations from that mean."""

    count: int = 0
    mean: float = 0.0
    m2: float = 0.0
    m3: float = 0.0
    m4: float = 0.0

    @property
    def bias(self) -> float:
        """Mean of the errors."""
        return self.mean

    @property
    def bias_error(self) -> float:
        """Standard error of the bias."""
        return sqrt(self.variance / self.count)

    @property
    def variance(self) -> float:
        """Unbiased variance of the errors about their own mean."""
        return self.m2 / (self.count - 1)

    @property
    def mse(self) -> float:
        """Mean squared error, the variance about the known integral."""
        return self.mean**2 + self.m2 / self.count

    @property
    def mse_error(self) -> float:
        """Standard error of the mean squared error."""
        d = self.mean
        fourth = d**4 + (6 * d**2 * self.m2 + 4 * d * self.m3 + self.m4) / self.count
        return sqrt(max(fourth - self.mse**2, 0.0) / (self.count - 1))


def merge(a: Moments, b: Moments) -> Moments:
    """Moments of both sets of errors together.

    References
    ----------
    P. Pébay, Formulas for robust, one-pass parallel computation of covariances and arbitrary-order
    statistical moments, SAND2008-6212, 2008, equation 2.1.
    """
    if not (a.count and b.count):
        return a if a.count else b
    n = a.count + b.count
    p, q, d = a.count / n, b.count / n, b.mean - a.mean
    pq = p * q * n
    m2 = a.m2 + b.m2 + pq * d**2
    m3 = a.m3 + b.m3 + pq * (p - q) * d**3 + 3 * d * (p * b.m2 - q * a.m2)
    m4 = a.m4 + b.m4 + pq * (p * p - p * q + q * q) * d**4
    m4 += 6 * d**2 * (p * p * b.m2 + q * q * a.m2) + 4 * d * (p * b.m3 - q * a.m3)
    return Moments(n, a.mean + q * d, m2, m3, m4)


def update(moments: Moments, values: Floats) -> Moments:
    """Fold in a block of errors, estimates minus the true integral."""
    flat = np.ravel(values)
    if flat.size == 0:
        return moments
    mean = float(np.mean(flat))
    deviation = flat - mean
    square = deviation * deviation
    m3, m4 = float(np.dot(square, deviation)), float(np.dot(square, square))
    return merge(moments, Moments(flat.size, mean, float(np.sum(square)), m3, m4))


def estimates(integrand: Integrand, points: Floats) -> Floats:
    """Mean of f over each point set: (R, N, d) gives (R,)."""
    replicates, count = points.shape[:2]
    step = max(1, _BLOCK // max(count, 1))
    result = np.empty(replicates)
    for start in range(0, replicates, step):
        result[start : start + step] = np.mean(integrand(points[start : start + step]), axis=-1)
    return result


def shifted(points: Floats, shifts: Floats) -> Floats:
    """Every point set moved by its shift on the unit torus.

    Parameters
    ----------
    points : array (R, N, d) or (N, d)
        Point sets; a single one is used for all shifts.
    shifts : array (R, d)

    Returns
    -------
    array (R, N, d)
        Coordinates in [0, 1).
    """
    moved = (points + shifts[:, None, :]) % 1.0
    moved[moved >= 1.0] = 0.0  # a tiny negative sum rounds up to 1
    return moved


def variance_interval(moments: Moments, level: float) -> Interval:
    """Approximate confidence interval for V = E (I_N - I)^2, the integral I being known.

    The estimate is taken to follow V chi^2_nu / nu. With R replicates and mean squared error q,
    the moments say ``nu = 2 q^2 / Var(q)``, which is R for normal errors. Then

    1. nu is at most R: errors with light tails get the interval of normal ones;
    2. the excess ``1/nu - 1/R`` of heavy tails is doubled, because samples understate it;
    3. nu is divided by ``1 + (z/2) sqrt(2/f)``, where ``f = nu R/(nu + 6 R)`` are the degrees of
       freedom of Var(q) itself if e^2 follows a gamma law, and z is the level's normal quantile.

    Parameters
    ----------
    moments : Moments
        Of the errors; at least 2 of them.
    level : float
        Probability, both tails together, that the interval should miss V; 0 < level < 1.

    Returns
    -------
    Interval
        ``(estimate, low, high)``; ``high`` may be infinite. All are 0 if all errors are 0.

    Notes
    -----
    Simulated at levels 1e-2, 1e-3 and 1e-4, it misses V less often than the level says for normal,
    uniform, Student t (9) and mildly skewed errors (lognormal, skewness up to 1) from 32 replicates
    on, and for lognormal errors of skewness 1.75 from 1024 replicates on. It costs normal errors
    7 % of width at 1024 replicates and level 1e-2. A sample of strongly skewed errors seldom shows
    their tail, and then no interval of this kind is honest: with 128 replicates, skewness 1.75
    misses 3 times as often as the level says, skewness 6 misses 15 times as often at level 1e-3
    and 80 times at 1e-4; with 1024 replicates, skewness 6 misses 1.3 times as often at 1e-4.
    Errors that take one rare value are not seen at all until that value has been drawn.
    """
    if moments.count < 2:
        raise InputError(f"an interval needs 2 <= replicates: got {moments.count}")
    if not 0 < level < 1:
        raise InputError(f"a level must satisfy 0 < level < 1: got {level}")
    q = moments.mse
    if q == 0:
        return Interval(0.0, 0.0, 0.0)
    half = _freedom(moments, float(-special().ndtri(level / 2))) / 2
    lower = float(special().gammaincinv(half, level / 2))
    upper = float(special().gammainccinv(half, level / 2))
    return Interval(q, q * half / upper, q * half / lower if lower > 0 else inf)


def spread_interval(moments: Moments, level: float) -> Interval:
    """As `variance_interval`, for the variance about the estimates' own mean."""
    return variance_interval(replace(moments, mean=0.0), level)


def bias_interval(moments: Moments) -> Interval:
    """The bias of the estimates, ±1.96 standard errors (95 %)."""
    half = 1.959963984540054 * moments.bias_error
    return Interval(moments.bias, moments.bias - half, moments.bias + half)


def relative_error(moments: Moments, level: float) -> float:
    """Standard error of log V whose normal interval at the level covers `variance_interval`.

    At small levels it exceeds ``sqrt(2/nu)``, because log chi^2 has a long lower tail: a fit that
    treats log V as normal needs this width to keep its level.
    """
    return log_error(variance_interval(moments, level), level)


def log_error(interval: Interval, level: float) -> float:
    """Standard error of the logarithm whose normal interval at the level covers the interval.

    Raises
    ------
    InputError
        If the interval reaches 0.
    """
    if interval.low <= 0:
        raise InputError(f"a relative error needs 0 < variance: got {interval.low}")
    widest = max(log(interval.high / interval.estimate), log(interval.estimate / interval.low))
    return max(widest / -float(special().ndtri(level / 2)), 1e-9)


def _freedom(moments: Moments, z: float) -> float:
    """Cautious degrees of freedom nu of the mean squared error."""
    count = moments.count
    spread = (moments.mse_error / moments.mse) ** 2 / 2  # 1/nu
    nu = 1 / (1 / count + 2 * max(spread - 1 / count, 0.0))
    f = nu * count / (nu + 6 * count)
    return nu / (1 + z / 2 * sqrt(2 / f))


def special() -> Any:
    """The special functions of scipy, imported where they are used."""
    from scipy import special as functions  # pyright: ignore[reportMissingTypeStubs]

    return functions


def interval_of_share(hits: int, runs: int, level: float = 0.05) -> tuple[float, float]:
    """Clopper-Pearson interval of a probability."""
    inverse = special().betaincinv
    low = float(inverse(hits, runs - hits + 1, level / 2)) if hits else 0.0
    high = float(inverse(hits + 1, runs - hits, 1 - level / 2)) if hits < runs else 1.0
    return low, high
