"""Jitter and the regular grid: one point per cell of a grid (Cook 1986; paper, Appendix A)."""

from collections.abc import Sequence
from math import prod

import numpy as np
from numpy.typing import NDArray


def cells(strata: Sequence[int]) -> NDArray[np.float64]:
    """Indices of all cells of a grid, shape (∏ strata, d)."""
    grid = np.indices(tuple(strata)).reshape(len(strata), -1).T
    return grid.astype(np.float64)


def jitter(strata: Sequence[int], replicates: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """A uniform point in each cell; shape (replicates, ∏ strata, d), in [0, 1)."""
    points = rng.random((replicates, prod(strata), len(strata)))
    points += cells(strata)
    points /= np.asarray(strata, dtype=np.float64)
    return below_one(points)


def regular(strata: Sequence[int], replicates: int) -> NDArray[np.float64]:
    """The corner of each cell, the same in every replicate; shape (replicates, ∏ strata, d)."""
    grid = cells(strata) / np.asarray(strata, dtype=np.float64)
    return np.broadcast_to(grid, (replicates, *grid.shape)).copy()


def below_one(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points whose last cell was rounded up to 1 moved to the largest number below 1."""
    return np.minimum(points, np.nextafter(1.0, 0.0), out=points)
