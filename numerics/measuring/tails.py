"""How rare the places are where an integrand has its power: the kurtosis κ of f − I.

An indicator of volume v has κ ≈ 1/v, and so has any bump that fills the volume v. Two rules
follow. As long as few of the N·R points drawn have met the bump, a small measured variance says
nothing: it is the variance of the rest (`is_seen`). And while N is small against κ every
stratification looks like random sampling, whatever rate it reaches later (`is_resolved`).
"""

from fractions import Fraction
from functools import lru_cache
from math import prod

import numpy as np

from ..integrands.ball import Ball
from ..integrands.bernoulli import bernoulli_factor
from ..integrands.protocol import Factor, Floats, Integrand, Part
from ..integrands.ridge import Ridge
from ..streams import stream

SEEN = 64
"""Points that must be expected to have met the bump; that none has is then of chance e^-64."""

_RESOLVED = 1.5  # from there on N^r V under jitter rises less than twofold: it is allowed as drift

_NODES = 1 << 16  # of the midpoint rule on one axis: bumps of width 1e-3 take 65 of them
_DRAWS = 1 << 17


def is_seen(integrand: Integrand, n: int, replicates: int) -> bool:
    """Whether R realisations of N points are enough to trust a small variance."""
    return n * replicates >= SEEN * kurtosis(integrand)


def is_resolved(integrand: Integrand, n: int) -> bool:
    """Whether N points resolve the integrand, so that its rate can show."""
    return n >= resolution(integrand)


def resolution(integrand: Integrand) -> float:
    """Least N whose N^(1/d) strata along each axis resolve the narrowest axis of the integrand."""
    axes = [
        _spread((axis,))[1] ** len(part)
        for part in integrand.parts
        if len(part) > 1
        for axis in part
    ]
    return _RESOLVED * max(kurtosis(integrand), *axes, 1.0)


@lru_cache(maxsize=1024)
def kurtosis(integrand: Integrand) -> float:
    """κ = E(f − I)⁴ / (E(f − I)²)² over the unit cube."""
    if isinstance(integrand, Ball):
        return _of_volume(float(integrand.mean(17)))
    if isinstance(integrand, Ridge):  # {k·x} is uniform
        return _spread(((1, bernoulli_factor(Fraction(0), integrand.b, Fraction(1))),))[1]
    if not integrand.parts:  # by draws, which may miss a very narrow bump
        return _central(_raw(integrand(stream(0).random((_DRAWS, integrand.dim)))))
    spreads = [_spread(part) for part in integrand.parts]
    if len(spreads) == 1:
        return spreads[0][1]
    # Parts of one coordinate each are independent: their fourth cumulants add.
    total = sum(variance for variance, _ in spreads)
    return 3 + sum((k - 3) * variance**2 for variance, k in spreads) / total**2


def _of_volume(v: float) -> float:
    """Of the indicator of a volume."""
    return (1 - 3 * v * (1 - v)) / (v * (1 - v))


def _spread(part: Part) -> tuple[float, float]:
    """Variance and κ of a product, from the raw moments of its factors on an axis each."""
    found = [_factor_moments(factor) for _, factor in part]
    raw = [prod(m[k] for m in found) for k in range(4)]
    if all(len(set(m)) == 1 for m in found):  # an indicator, f² = f
        return raw[0] * (1 - raw[0]), _of_volume(raw[0])
    return raw[1] - raw[0] ** 2, _central(raw)


@lru_cache(maxsize=256)
def _factor_moments(factor: Factor) -> tuple[float, ...]:
    """Raw moments by the midpoint rule; an indicator's are its length, however narrow it is."""
    values = factor.values((np.arange(_NODES) + 0.5) / _NODES)
    if np.all((values == 0) | (values == 1)):
        return (float(factor.mean()),) * 4
    return tuple(_raw(values))


def _raw(values: Floats) -> list[float]:
    return [float(np.mean(values**k)) for k in (1, 2, 3, 4)]


def _central(raw: list[float]) -> float:
    """κ from raw moments; at least 1, and 1 where f is all but constant (one wave has 3/2)."""
    m1, m2, m3, m4 = raw
    variance = m2 - m1**2
    if variance <= 1e-6 * m2:
        return 1.0
    return max(1.0, (m4 - 4 * m3 * m1 + 6 * m2 * m1**2 - 3 * m1**4) / variance**2)
