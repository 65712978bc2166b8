r"""Box projection DPP: N points with the kernel Σ_k exp(2πi k·(x − y)) over a box of N frequencies.

In one dimension the points are the eigenvalues of a random unitary matrix. In more they come one
by one (Hough, Krishnapur, Peres, Virág 2006): with v(x) = (exp(2πi k·x))_k and P the projection of
C^N off the v's of the points that are there, the next point has the density |P v(x)|²/tr P. It is
drawn uniform and kept with the probability |P v(x)|²/N. Each point then costs as many trials, on
average, as N over the number of points left, and each trial N operations per point that is there.
"""

from collections.abc import Sequence
from math import prod

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from .jitter import below_one, cells
from .unitary_phases import unitary_phases

MOST_ON_A_LINE = 4096
"""Largest N in one dimension: about ten seconds per realisation."""

MOST = 256
"""Largest N in several dimensions: about a fifth of a second per realisation."""

_TOGETHER = 1 << 19  # numbers in the bases of the realisations drawn together
_MOST_TRIALS = 64  # of one point of one realisation, made at once

Complexes = NDArray[np.complex128]


def box_dpp(
    counts: Sequence[int], replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Points of shape (replicates, ∏ counts, d) in [0, 1).

    Parameters
    ----------
    counts : sequence of int
        Frequencies along each axis.

    Raises
    ------
    InputError
        If there are more than ``MOST_ON_A_LINE`` points, or ``MOST`` in several dimensions.
    """
    n, most = prod(counts), MOST_ON_A_LINE if len(counts) == 1 else MOST
    if n > most:
        rule = f"points of box-dpp are drawn up to N = {most} with --dim {len(counts)}"
        raise InputError(f"{rule}: got {n}")
    if len(counts) == 1:
        return below_one(unitary_phases(n, replicates, rng)[:, :, None])
    together = max(1, _TOGETHER // n**2)
    parts = [min(together, replicates - k) for k in range(0, max(1, replicates), together)]
    return np.concatenate([_drawn(counts, part, rng) for part in parts])


def _drawn(counts: Sequence[int], replicates: int, rng: np.random.Generator) -> NDArray[np.float64]:
    waves = cells(counts)
    n = len(waves)
    points = np.empty((replicates, n, len(counts)))
    conjugates = np.empty((replicates, n, n), dtype=np.complex128)  # of orthonormal rows
    for index in range(n):
        there = conjugates[:, :index]
        points[:, index], vectors = _next_points(waves, there, rng)
        for _ in range(2):  # so that what is left is orthogonal even where it is small
            overlap = there @ vectors[:, :, None]
            vectors -= (overlap.conj().swapaxes(1, 2) @ there)[:, 0].conj()
        conjugates[:, index] = vectors.conj() / np.linalg.norm(vectors, axis=1, keepdims=True)
    return points


def _next_points(
    waves: NDArray[np.float64], there: Complexes, rng: np.random.Generator
) -> tuple[NDArray[np.float64], Complexes]:
    """One more point x of each realisation, and its v(x)."""
    replicates, index, n = there.shape
    points = np.empty((replicates, waves.shape[1]))
    vectors = np.empty((replicates, n), dtype=np.complex128)
    trials = min(_MOST_TRIALS, 1 + n // (n - index))
    waiting = np.arange(replicates, dtype=np.intp)
    while len(waiting):
        tried = rng.random((len(waiting), trials, waves.shape[1]))
        tried_vectors = np.exp(2j * np.pi * (tried @ waves.T))
        bases = there if len(waiting) == replicates else there[waiting]
        overlap = tried_vectors @ bases.swapaxes(1, 2)
        left: NDArray[np.float64] = n - np.sum(overlap.real**2 + overlap.imag**2, axis=2)
        kept = rng.random(left.shape) * n < left
        found, first = np.any(kept, axis=1), np.argmax(kept, axis=1)
        rows = np.flatnonzero(found)
        points[waiting[rows]] = tried[rows, first[rows]]
        vectors[waiting[rows]] = tried_vectors[rows, first[rows]]
        waiting = waiting[np.flatnonzero(~found)]
    return points, vectors
