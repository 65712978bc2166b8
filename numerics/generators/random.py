"""Independent uniform points (paper, Eq. 5, first row)."""

import numpy as np
from numpy.typing import NDArray


def random(n: int, dim: int, replicates: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Points of shape (replicates, n, dim) in [0, 1)."""
    return rng.random((replicates, n, dim))
