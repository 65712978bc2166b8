"""Expected spectra of tiny samplers by enumeration, with no use of the kernels.

A sampler shuffles blocks of coordinates independently. A block is a list of equally likely
arrangements, each the lower corners of the cells of all N points; inside its cell, of the given
widths, a point is uniform. Different points are then independent given the arrangement, so that

    N·P_S(m) = (1/N) Σ_{j,k} ∏_blocks E[exp(−2πi m·(c_j − c_k))] ∏_i sinc²(m_i w_i)   (j ≠ k),

with 1 in place of the product for j = k; sinc² is |E exp(−2πi m_i w_i U)|².
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np


@dataclass(frozen=True)
class Block:
    """Arrangements of shape (any, N, axes) and the widths of the cells, one per axis."""

    arrangements: np.ndarray
    widths: tuple[float, ...]

    @property
    def axes(self) -> int:
        return len(self.widths)


def pair_means(block: Block, m: np.ndarray) -> np.ndarray:
    """E exp(−2πi m·(s_j − s_k)) for the points of one block, 1 on the diagonal."""
    phases = np.exp(-2j * np.pi * (block.arrangements @ m))
    means = np.einsum("aj,ak->jk", phases, phases.conj()) / len(phases)
    means = means * np.prod(np.sinc(m * np.array(block.widths)) ** 2)
    np.fill_diagonal(means, 1.0)
    return means


def scaled_power(blocks: Sequence[Block], m: Sequence[int]) -> float:
    """N·P_S(m)."""
    first, total = 0, 1.0
    for block in blocks:
        total = total * pair_means(block, np.array(m[first : first + block.axes], float))
        first += block.axes
    return float(total.sum().real) / len(total)


def grid(counts: Sequence[int]) -> np.ndarray:
    """Lower corners of the cells of a grid, shape (N, axes)."""
    return np.array([[i / n for i, n in zip(c, counts, strict=True)] for c in _cells(counts)])


def _cells(counts: Sequence[int]) -> Iterator[tuple[int, ...]]:
    return product(*map(range, counts))


def fixed(counts: Sequence[int], width: float = 1.0) -> Block:
    """A grid whose points are uniform in their cells (width 1) or in their corners (width 0)."""
    return Block(grid(counts)[None], tuple(width / n for n in counts))


def shuffled(counts: Sequence[int]) -> Block:
    """A jittered grid in random order."""
    corners = grid(counts)
    orders = permutations(range(len(corners)))
    return Block(np.array([corners[list(p)] for p in orders]), tuple(1 / n for n in counts))


def multi_jittered(counts: Sequence[int]) -> list[Block]:
    """Cells of a grid, their substrata on each axis shuffled in every stratum on its own."""
    size = int(np.prod(counts))
    return [_substrata(list(_cells(counts)), i, counts[i], size, False) for i in range(len(counts))]


def correlated_multi_jittered(counts: tuple[int, int]) -> list[Block]:
    """As above in 2D, with one shuffle for all strata of an axis (Kensler 2013)."""
    size = counts[0] * counts[1]
    return [_substrata(list(_cells(counts)), i, counts[i], size, True) for i in range(2)]


def _substrata(
    cells: list[tuple[int, ...]], axis: int, strata: int, size: int, shared: bool
) -> Block:
    """One axis: point j of cell c lies in substratum shuffle[c_axis][place of c in its stratum]."""
    substrata = size // strata
    members = [[j for j, c in enumerate(cells) if c[axis] == level] for level in range(strata)]
    shuffles = list(permutations(range(substrata)))
    picks = ([p] * strata for p in shuffles) if shared else product(shuffles, repeat=strata)
    found: list[np.ndarray] = []
    for pick in picks:
        x = np.empty(len(cells))
        for level, (own, shuffle) in enumerate(zip(members, pick, strict=True)):
            for place, j in enumerate(own):
                x[j] = level / strata + shuffle[place] / size
        found.append(x)
    return Block(np.array(found)[..., None], (1 / size,))
