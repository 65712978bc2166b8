"""What a design is probed with: frequencies and integrands on each support.

A sampler is probed where its strata would show: on every axis, on pairs of axes and on the full
support, at low frequencies, at the numbers of strata that a claim names, and next to them. The
variances are probed with Bernoulli polynomials, each with all its power on one support: degree 1
jumps (worst class, q = 1), degree 2 has a kink (q = 3), degree 6 is all but one harmonic (best).
"""

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ...theory.samplers import Sampler
from ..integrands.bernoulli import bernoulli
from ..integrands.separable import Separable

JUMP, KINK, SMOOTH = 1, 2, 6
"""Degrees of the Bernoulli polynomials that probe the worst class, one between, the best class."""

_MOST_PAIRS = 45
_WAVE_VALUES = 1 << 20  # of all waves held at once: 16 MiB
_FEW = 3  # dimensions up to which integrands probe every support that frequencies do

Support = tuple[int, ...]
Frequency = tuple[int, ...]


def probed_supports(dim: int) -> tuple[Support, ...]:
    """Axes, pairs of axes (beyond 10 dimensions neighbours only) and the full support."""
    axes = tuple((i,) for i in range(1, dim + 1))
    pairs = tuple(combinations(range(1, dim + 1), 2))
    if len(pairs) > _MOST_PAIRS:
        pairs = tuple((i, i + 1) for i in range(1, dim))
    full = (tuple(range(1, dim + 1)),) if dim > 2 else ()
    return (*axes, *pairs, *full)


def integrand_supports(dim: int) -> tuple[Support, ...]:
    """Supports on which variances are measured: all probed ones, or the outermost of each kind."""
    supports = probed_supports(dim)
    if dim <= _FEW:
        return supports
    axes = [s for s in supports if len(s) == 1]
    pairs = [s for s in supports if len(s) == 2]
    return (axes[0], axes[-1], pairs[0], pairs[-1], supports[-1])


def frequencies(n: int, dim: int, strata: Sequence[int] = ()) -> tuple[Frequency, ...]:
    """Frequencies that probe a sampler of n points.

    Parameters
    ----------
    strata : sequence of int
        Numbers of strata of interest besides n^(1/d) and n, as a claim names them.
    """
    coarse = round(n ** (1 / dim))
    counts = sorted({c for c in (coarse, n, *strata) if 1 < c <= n})
    along = sorted({1, 2, *counts, *(c + 1 for c in counts), *(c // 2 for c in counts)} - {0})
    across = sorted({1, 2, *[c for c in counts if c < n], coarse} - {0})
    found: dict[Frequency, None] = {}
    for support in probed_supports(dim):
        if len(support) == 1:
            found |= dict.fromkeys(_placed(dim, support, (k,)) for k in along)
        elif len(support) == 2:
            pairs = [p for c in (1, *across) for p in ((c, 1), (c, -1), (1, -c), (c, c), (c, -c))]
            found |= dict.fromkeys(_placed(dim, support, p) for p in pairs)
        else:
            found |= dict.fromkeys(_placed(dim, support, (k,) * dim) for k in (1, *across[-1:]))
    return tuple(found)


def _placed(dim: int, support: Support, values: Sequence[int]) -> Frequency:
    m = [0] * dim
    for axis, value in zip(support, values, strict=True):
        m[axis - 1] = value
    return tuple(m)


def support_of_frequency(m: Frequency) -> Support:
    """Coordinates, 1-based, in which a frequency is not zero."""
    return tuple(i + 1 for i, k in enumerate(m) if k)


def strata_of_claim(sampler: Sampler, n: int) -> tuple[int, ...]:
    """Numbers of strata along single axes that a sampler has at N = n."""
    if sampler.counts_at is None:
        return ()
    return tuple(sorted({c for c in sampler.counts_at(n).values() if c > 1}))


def probe(dim: int, degree: int, support: Support) -> Separable:
    """The Bernoulli integrand of a degree with all its power on one support."""
    return bernoulli(dim, degree, support)


def amplitudes(points: NDArray[np.float64], wanted: Sequence[Frequency]) -> NDArray[np.complex128]:
    """F_S(m) = (1/N) Σ_j exp(−2πi m·s_j) of every realisation.

    Parameters
    ----------
    points : array of shape (R, N, d)
    wanted : sequence of frequencies

    Returns
    -------
    array of shape (len(wanted), R)
    """
    realisations, n = points.shape[:2]
    waves = {(axis, k) for m in wanted for axis, k in enumerate(m) if k}
    most = max(1, _WAVE_VALUES // max(1, len(waves)))
    step, size = max(1, most // n), min(n, most)
    result = np.zeros((len(wanted), realisations), dtype=np.complex128)
    for start in range(0, realisations, step):
        for first in range(0, n, size):
            part = points[start : start + step, first : first + size]
            share = part.shape[1] / n
            result[:, start : start + step] += share * _amplitudes(part, wanted)
    return result


def _amplitudes(points: NDArray[np.float64], wanted: Sequence[Frequency]) -> NDArray[np.complex128]:
    waves: dict[tuple[int, int], NDArray[np.complex128]] = {}
    result = np.empty((len(wanted), len(points)), dtype=np.complex128)
    for row, m in enumerate(wanted):
        product: NDArray[np.complex128] | None = None
        for axis in np.flatnonzero(m):
            key = (int(axis), m[axis])
            if key not in waves:
                waves[key] = np.exp((-2j * np.pi * m[axis]) * points[:, :, axis])
            product = waves[key] if product is None else product * waves[key]
        result[row] = 1.0 if product is None else product.mean(axis=1)
    return result
