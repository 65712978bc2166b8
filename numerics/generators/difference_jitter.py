"""Difference jitter: s_j = (j + u_j − u_(j−1))/N on a circle, u uniform of width 1."""

import numpy as np
from numpy.typing import NDArray

from .jitter import below_one


def difference_jitter(n: int, replicates: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Points of shape (replicates, n, 1) in [0, 1), n at least 3."""
    displacements = rng.random((replicates, n))
    points = np.arange(n) + displacements - np.roll(displacements, 1, axis=1)
    points %= n
    points /= n
    return below_one(points[:, :, None])
