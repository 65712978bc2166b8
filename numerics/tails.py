"""How rare the places are where an integrand has its power: the kurtosis κ of f − I.

An indicator of volume v has κ ≈ 1/v, and so has any bump that fills the volume v. Two rules
follow. As long as few of the N·R points drawn have met the bump, a small measured variance says
nothing: it is the variance of the rest (`is_seen`). And while N is small against κ every
stratification looks like random sampling, whatever rate it reaches later (`is_resolved`).
"""

from functools import lru_cache
from math import prod

import numpy as np

from .integrands.ball import Ball
from .integrands.bernoulli import Bernoulli
from .integrands.box import Box
from .integrands.gaussian import Gaussian
from .integrands.product import Product
from .integrands.protocol import Floats, Integrand
from .streams import stream

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
    axes = _axes(integrand) or ()
    return _RESOLVED * max(kurtosis(integrand), *(kurtosis(f) ** len(axes) for f in axes), 1.0)


@lru_cache(maxsize=1024)
def kurtosis(integrand: Integrand) -> float:
    """κ = E(f − I)⁴ / (E(f − I)²)² over the unit cube."""
    if isinstance(integrand, Ball | Box):
        v = float(integrand.mean(17))
        return (1 - 3 * v * (1 - v)) / (v * (1 - v))
    axes = _axes(integrand)
    if axes is None:  # by draws, which may miss a very narrow bump
        return _central(_raw(integrand(stream(0).random((_DRAWS, integrand.dim)))))
    nodes = (np.arange(_NODES)[:, None] + 0.5) / _NODES
    moments = [_raw(f(nodes)) for f in axes]
    return _central([prod(m[k] for m in moments) for k in range(4)])


def _axes(integrand: Integrand) -> tuple[Integrand, ...] | None:
    """Functions of one coordinate whose product it is, constants left out; None if unknown."""
    match integrand:
        case Bernoulli():
            return (Bernoulli(1, integrand.k, (1,)),) * len(integrand.axes)
        case Gaussian():
            return tuple(Gaussian((s,)) for s in integrand.sigmas)
        case Product():
            return (Product(1, integrand.k, integrand.c),) * integrand.dim
        case Box():
            return tuple(Box((side,)) for side in integrand.sides if side < 1)
        case _:
            return None


def _raw(values: Floats) -> list[float]:
    return [float(np.mean(values**k)) for k in (1, 2, 3, 4)]


def _central(raw: list[float]) -> float:
    """κ from raw moments; at least 1, and 1 where f is all but constant (one wave has 3/2)."""
    m1, m2, m3, m4 = raw
    variance = m2 - m1**2
    if variance <= 1e-6 * m2:
        return 1.0
    return max(1.0, (m4 - 4 * m3 * m1 + 6 * m2 * m1**2 - 3 * m1**4) / variance**2)
