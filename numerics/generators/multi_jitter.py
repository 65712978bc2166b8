"""Multi-jitter: a jittered grid in which every stratum of every axis is a Latin arrangement.

Each axis has strata, each stratum as many substrata as it holds points, and these take the
substrata in random order, independently for every stratum and axis (Chiu, Shirley, Wang 1994; in
d dimensions the orthogonal array is the full grid).
"""

from collections.abc import Sequence
from math import prod

import numpy as np
from numpy.typing import NDArray

from .jitter import below_one, cells
from .latin_hypercube import permutations


def multi_jitter(
    strata: Sequence[int], replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Points of shape (replicates, N, d), N = ∏ strata, in [0, 1)."""
    n, grid = prod(strata), cells(strata)
    points = rng.random((replicates, n, len(strata)))
    for axis, count in enumerate(strata):
        substrata = permutations(n // count, (replicates, count), rng).reshape(replicates, n)
        by_stratum = np.argsort(grid[:, axis], kind="stable")
        points[:, by_stratum, axis] += substrata
        points[:, :, axis] += grid[:, axis] * (n // count)
    points /= n
    return below_one(points)
