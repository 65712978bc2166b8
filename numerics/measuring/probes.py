"""What a design is probed with: frequencies and integrands on each support.

A sampler is probed where its strata would show: on every axis, on pairs and triples of axes and on
the full support, at low frequencies of both signs, at the numbers of strata that a claim names, and
next to them. In two and three dimensions the low frequencies are all primitive ones of a small box,
so that strata in oblique directions show; in more, triples at (1, ±1, ±1). The
variances are probed with Bernoulli polynomials, each with all its power on one support: degree 1
jumps (worst class, q = 1), degree 2 has a kink (q = 3), degree 6 is all but one harmonic (best).
"""

from collections.abc import Sequence
from functools import cache
from itertools import combinations, product
from math import comb, gcd

import numpy as np
from numpy.typing import NDArray

from ...theory.samplers import Sampler
from ..integrands.bernoulli import bernoulli
from ..integrands.separable import Separable

JUMP, KINK, SMOOTH = 1, 2, 6
"""Degrees of the Bernoulli polynomials that probe the worst class, one between, the best class."""

_MOST_PAIRS = 780  # supports: all pairs up to 40 dimensions
_MOST_TRIPLES = 120  # all triples up to 10 dimensions
_WELL_PROBED = 10  # dimensions up to which all pairs are probed at their strata
_LARGEST_ENTRIES = {(2, 2): 3, (3, 2): 3, (3, 3): 2}  # by dimension and size of the support; else 1
_WAVE_VALUES = 1 << 19  # of all waves held at once: 8 MiB
_PART_POINTS = 1 << 13  # taken together: a wave is 128 KiB
_FEW = 3  # dimensions up to which integrands probe every support that frequencies do

Support = tuple[int, ...]
Frequency = tuple[int, ...]
Factors = tuple[tuple[int, int], ...]


def probed_supports(dim: int) -> tuple[Support, ...]:
    """Axes, pairs of axes, triples and the full support.

    Beyond 10 dimensions triples are neighbours only, beyond 40 pairs too.
    """
    axes = tuple((i,) for i in range(1, dim + 1))
    full = (tuple(range(1, dim + 1)),) if dim > 3 else ()
    return (
        *axes,
        *supports_of_size(dim, 2, _MOST_PAIRS),
        *supports_of_size(dim, 3, _MOST_TRIPLES),
        *full,
    )


def supports_of_size(dim: int, size: int, most: int) -> tuple[Support, ...]:
    """Supports of some coordinates: all, or neighbours only where there are too many."""
    if comb(dim, size) <= most:
        return tuple(combinations(range(1, dim + 1), size))
    return tuple(tuple(range(i, i + size)) for i in range(1, dim + 2 - size))


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
            values = [(k,) for k in along]
        elif len(support) == 2:
            is_close = dim <= _WELL_PROBED or support[1] == support[0] + 1
            values = [*_pair_values(across if is_close else ()), *_primitive(dim, 2)]
        else:
            values = list(_primitive(dim, 3)) if len(support) == 3 else [(1,) * dim]
            values += [(k,) * dim for k in across[-1:] if len(support) == dim]
        found |= dict.fromkeys(_placed(dim, support, v) for v in values)
    return tuple(found)


def _pair_values(counts: Sequence[int]) -> list[tuple[int, ...]]:
    """Values on a pair of axes at which its strata show."""
    return [p for c in counts for p in ((c, 1), (c, -1), (1, -c), (c, c), (c, -c))]


@cache
def _primitive(dim: int, size: int) -> list[tuple[int, ...]]:
    """Values without a common divisor up to the largest entry, of all signs, one of m and −m."""
    most = _LARGEST_ENTRIES.get((dim, size), 1)
    return [
        (first, *(sign * k for sign, k in zip(signs, rest, strict=True)))
        for first, *rest in product(range(1, most + 1), repeat=size)
        if gcd(first, *rest) == 1
        for signs in product((1, -1), repeat=size - 1)
    ]


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
    found = [_factored(m) for m in wanted]
    order = sorted(range(len(wanted)), key=lambda row: found[row])
    held = {(axis, j) for factors in found for axis, k in factors for j in _powers(abs(k))}
    most = max(1, min(_PART_POINTS, _WAVE_VALUES // max(1, len(held))))
    step, size = max(1, most // n), min(n, most)
    result = np.zeros((len(wanted), realisations), dtype=np.complex128)
    for start in range(0, realisations, step):
        for first in range(0, n, size):
            part = points[start : start + step, first : first + size]
            _add_sums(result[:, start : start + step], part, found, order)
    result /= n
    mirrored = [row for row, m in enumerate(wanted) if next((k for k in m if k), 1) < 0]
    result[mirrored] = np.conj(result[mirrored])
    return result


def _factored(m: Frequency) -> Factors:
    """Axes of a frequency and its entries there; of m and −m the one that starts positive."""
    found = [(axis, int(k)) for axis, k in enumerate(m) if k]
    sign = -1 if found and found[0][1] < 0 else 1
    return tuple((axis, sign * k) for axis, k in found)


def _add_sums(
    sums: NDArray[np.complex128],
    points: NDArray[np.float64],
    found: Sequence[Factors],
    order: Sequence[int],
) -> None:
    """Add Σ_j exp(−2πi m·s_j); in sorted order neighbours share the product of their first waves.

    The last wave enters by a scalar product, which with a conjugate wave is the other sign.
    """
    waves: dict[tuple[int, int], NDArray[np.complex128]] = {}
    products: list[tuple[tuple[int, int], NDArray[np.complex128]]] = []
    for row in order:
        factors = found[row]
        if not factors:
            sums[row] += points.shape[1]
            continue
        *leading, (axis, k) = factors
        last = _wave(waves, points, axis, abs(k))
        if not leading:
            sums[row] += last.sum(axis=1)
            continue
        shared = 0
        while shared < min(len(leading), len(products)) and products[shared][0] == leading[shared]:
            shared += 1
        del products[shared:]
        for at, j in leading[shared:]:
            factor = _wave(waves, points, at, abs(j))
            factor = np.conj(factor) if j < 0 else factor
            products.append(((at, j), products[-1][1] * factor if products else factor))
        product = products[-1][1]
        if k < 0:
            sums[row] += np.vecdot(last, product)
        else:
            sums[row] += np.matmul(product[:, None, :], last[:, :, None])[:, 0, 0]


@cache
def _powers(k: int) -> tuple[int, ...]:
    """The k whose waves are held to make that of k > 0: itself, and halves down to 1."""
    if k == 1:
        return (k,)
    return (k, *sorted({j for half in (k // 2, k - k // 2) for j in _powers(half)}, reverse=True))


def _wave(
    waves: dict[tuple[int, int], NDArray[np.complex128]],
    points: NDArray[np.float64],
    axis: int,
    k: int,
) -> NDArray[np.complex128]:
    """exp(−2πi k x) along an axis, k > 0: a product of two, or drawn from sine and cosine."""
    if (axis, k) not in waves:
        if k == 1:
            waves[axis, k] = np.exp((-2j * np.pi * k) * points[:, :, axis])
        else:
            halves = (_wave(waves, points, axis, j) for j in (k // 2, k - k // 2))
            waves[axis, k] = np.multiply(*halves)
    return waves[axis, k]
