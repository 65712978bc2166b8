"""Exponents from variances at several N: the points, and straight lines through them.

A straight line on log-log axes is a description, not a test: the local slopes of an N^-3/2 law can
be -1.44 at N = 16. Claims are tested in `drift`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite, sqrt
from typing import TypeAlias

import numpy as np

from ...theory.errors import InputError
from ..integrands.protocol import Floats
from .moments import Interval, special

Exponent: TypeAlias = float | Fraction

_LARGEST = 1e30  # the powers of N that a drift takes stay within double precision


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
class Ladder:
    """Points in logarithms: x = log(N/N_1), y = log V - q log log N, weights 1/error^2."""

    x: Floats
    y: Floats
    w: Floats

    def centred(self, values: Floats) -> Floats:
        """Values minus their weighted mean over the last axis, which profiles out log C."""
        return values - (values @ self.w / self.w.sum())[..., None]


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
    ladder, x0 = ladder_of(points, log_power, 2)
    z = -float(special().ndtri(checked_level(level) / 2))
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


def ladder_of(points: Sequence[RatePoint], log_power: Exponent, least: int) -> tuple[Ladder, float]:
    """The points sorted by N, in logarithms, and log N_1."""
    ordered = sorted(points, key=lambda p: p.n)
    sizes = [p.n for p in ordered]
    if len(set(sizes)) < len(sizes) or len(sizes) < least:
        raise InputError(f"a fit needs {least} or more points, all at different N: got {sizes}")
    x = np.log([float(n) for n in sizes])
    y = np.log([p.variance for p in ordered]) - float(log_power) * np.log(x)
    w = np.array([p.relative_error for p in ordered]) ** -2.0
    return Ladder(x - x[0], y, w), float(x[0])


def checked_level(level: float) -> float:
    """The level, if it lies between 0 and 1."""
    if not 0 < level < 1:
        raise InputError(f"a level must satisfy 0 < level < 1: got {level}")
    return level


def _interval(estimate: float, half: float) -> Interval:
    return Interval(estimate, estimate - half, estimate + half)
