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


def regular(
    strata: Sequence[int], replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """The grid moved as a whole by one uniform vector; shape (replicates, ∏ strata, d).

    A grid that stays in place is no unbiased sampler; its homogenised form is what the theory
    speaks of.
    """
    counts = np.asarray(strata, dtype=np.float64)
    points = (cells(strata) + rng.random((replicates, 1, len(strata)))) / counts
    return below_one(points)


def below_one(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points whose last cell was rounded up to 1 moved to the largest number below 1."""
    return np.minimum(points, np.nextafter(1.0, 0.0), out=points)
