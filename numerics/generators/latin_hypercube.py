"""Latin hypercube: on every axis one point in each of N strata, in random order.

(McKay, Beckman, Conover 1979.)
"""

import numpy as np
from numpy.typing import NDArray

from .jitter import below_one


def latin_hypercube(
    n: int, dim: int, replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Points of shape (replicates, n, dim) in [0, 1)."""
    points = rng.random((replicates, n, dim))
    points += permutations(n, (replicates, dim), rng).swapaxes(1, 2)
    points /= n
    return below_one(points)


def permutations(n: int, shape: tuple[int, ...], rng: np.random.Generator) -> NDArray[np.float64]:
    """Independent uniform permutations of 0..n−1 along the last axis, shape (*shape, n)."""
    ordered = np.broadcast_to(np.arange(n, dtype=np.float64), (*shape, n))
    return rng.permuted(ordered, axis=-1)
