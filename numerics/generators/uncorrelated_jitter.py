"""Uncorrelated jitter: jitter in each block of dimensions, the blocks joined in random order.

(Cook 1986; paper, Sec. 6.2.)
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .jitter import jitter


def uncorrelated_jitter(
    blocks: Sequence[Sequence[int]], replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Points of shape (replicates, N, d) for blocks of N cells each, in [0, 1)."""
    parts = [_shuffled(jitter(strata, replicates, rng), rng) for strata in blocks]
    return np.concatenate(parts, axis=2)


def _shuffled(points: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    """Points of each replicate in random order; all coordinates of a point stay together."""
    order = np.argsort(rng.random(points.shape[:2]), axis=1)
    return np.take_along_axis(points, order[:, :, None], axis=1)
