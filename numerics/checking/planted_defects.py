"""Samplers with one planted defect each, such as samplers in use have had: callables (n, dim, rng).

Every one of them is right but for its defect, and draws all its randomness from ``rng``.
"""

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]


def _cells(n: int, dim: int) -> tuple[NDArray[np.int64], int]:
    """Lower corners of a grid of n cells, in units of its strata, and its strata along an axis."""
    side = round(n ** (1 / dim))
    if side**dim != n:
        raise ValueError(f"n must be a whole power {dim}: got {n}")
    return np.indices((side,) * dim).reshape(dim, -1).T, side


def _jitter(n: int, dim: int, rng: np.random.Generator) -> Points:
    cells, side = _cells(n, dim)
    return (cells + rng.random((n, dim))) / side


def half_jitter(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Jitter whose second coordinate forgets to be stratified."""
    points = _jitter(n, dim, rng)
    points[:, 1] = rng.random(n)
    return points


def halved_jitter(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Jitter whose second coordinate uses one half of each stratum only."""
    cells, side = _cells(n, dim)
    inside = rng.random((n, dim))
    inside[:, 1] /= 2
    return (cells + inside) / side


def halved_jitter_shifted(n: int, dim: int, rng: np.random.Generator) -> Points:
    """The same, moved by a random shift: no marginal betrays it."""
    return (halved_jitter(n, dim, rng) + rng.random(dim)) % 1.0


def wide_jitter(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Points that stray into the neighbouring cells; the marginals stay uniform."""
    cells, side = _cells(n, dim)
    return (cells + 2.0 * rng.random((n, dim)) - 0.5) / side % 1.0


def sheared_jitter(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Jitter under y → x + y: the density stays uniform, the strata lie aslant."""
    points = _jitter(n, dim, rng)
    points[:, 1] = (points[:, 0] + points[:, 1]) % 1.0
    return points


def shared_permutation(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Jitter in the pairs (1, 2), (3, 4), ..., all of them in the same random order."""
    cells, side = _cells(n, 2)
    order = rng.permutation(n)
    return (np.tile(cells[order], dim // 2) + rng.random((n, dim))) / side


def diagonal_rooks(n: int, dim: int, rng: np.random.Generator) -> Points:
    """A Latin hypercube with one and the same permutation on all axes."""
    return (rng.permutation(n)[:, np.newaxis] + rng.random((n, dim))) / n


def centred_rooks(n: int, dim: int, rng: np.random.Generator) -> Points:
    """A Latin hypercube with its points at the stratum centres."""
    return np.stack([rng.permutation(n) + 0.5 for _ in range(dim)], axis=1) / n


def rooks_between_ends(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Strata n − 1 in number, as between n ends: the n-th point wraps round into the first."""
    cells = np.stack([rng.permutation(n) for _ in range(dim)], axis=1)
    return (cells + rng.random((n, dim))) / (n - 1) % 1.0


def rooks_short_of_one(n: int, dim: int, rng: np.random.Generator) -> Points:
    """A Latin hypercube of n − 1 points, and one point anywhere."""
    cells = np.stack([rng.permutation(n - 1) for _ in range(dim)], axis=1)
    rooks = (cells + rng.random((n - 1, dim))) / (n - 1)
    return np.concatenate([rooks, rng.random((1, dim))])


def unshuffled_multi_jitter(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Multi-jitter in its canonical order: the shuffles of rows and columns are left out."""
    cells, side = _cells(n, dim)
    return (cells + (cells[:, ::-1] + rng.random((n, dim))) / side) / side


def stratified_sum(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Any two coordinates are independent; the sum of the first three is stratified modulo 1."""
    points = rng.random((n, dim))
    total = (rng.permutation(n) + rng.random(n)) / n
    points[:, 2] = (total - points[:, 0] - points[:, 1]) % 1.0
    return points


def lattice_without_seed(n: int, dim: int, rng: np.random.Generator) -> Points:
    """A Korobov lattice that is never shifted: the generator is ignored."""
    return np.arange(n)[:, np.newaxis] * 3 ** np.arange(dim) % n / n


def few_seeds(n: int, dim: int, rng: np.random.Generator) -> Points:
    """A Latin hypercube from one of 256 seeds."""
    own = np.random.Generator(np.random.PCG64(int(rng.integers(256))))
    cells = np.stack([own.permutation(n) for _ in range(dim)], axis=1)
    return (cells + own.random((n, dim))) / n


def single_precision(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Coordinates that have passed through float32."""
    return rng.random((n, dim), dtype=np.float32).astype(np.float64)


def rows_at_the_origin(n: int, dim: int, rng: np.random.Generator) -> Points:
    """Jitter for whole squares; of other n, the rows beyond a square stay at the origin."""
    side = int(n ** (1 / dim))
    points = np.zeros((n, dim))
    points[: side**dim] = _jitter(side**dim, dim, rng)
    return points
