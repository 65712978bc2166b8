"""Correlated multi-jitter: multi-jitter with one order of substrata for all strata of an axis.

(Kensler 2013; here with true permutations in place of hashes.)
"""

import numpy as np
from numpy.typing import NDArray

from .jitter import below_one, cells
from .latin_hypercube import permutations


def correlated_multi_jitter(
    columns: int, rows: int, replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Points of shape (replicates, columns · rows, 2) in [0, 1)."""
    n, grid = columns * rows, cells((columns, rows))
    column, row = grid.astype(np.int64).T
    points = rng.random((replicates, n, 2))
    points[:, :, 0] += grid[:, 0] * rows + permutations(rows, (replicates,), rng)[:, row]
    points[:, :, 1] += grid[:, 1] * columns + permutations(columns, (replicates,), rng)[:, column]
    points /= n
    return below_one(points)
