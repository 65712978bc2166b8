"""Jitter: one uniform point in each cell of a grid n_1 × ... × n_d.

N·P_S(m) = 1 − ∏_i sinc²(m_i/n_i) (paper, Eq. 5, with its missing scale n_i = N^(1/d) restored;
Cook 1986).
"""

from ..kernels import Alphabet, Kernel
from ..layouts import Layout
from ..signs import Assumptions
from ..symbolic import Expr
from .definition import Sampler
from .stratified import grid_of, strata_of


def jitter(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``jitter``, ``jitter:25x40``, ``jitter:4xN``."""
    groups, counts, growth, counts_at = grid_of(strata_of(argument, dim), dim)
    alphabet = Alphabet(("N", *counts))
    kernel = alphabet.constant() - cell_product(alphabet, counts)
    layout = Layout(groups, growth, assumptions)
    name = f"jitter:{argument}" if argument else "jitter"
    return Sampler(name, "jitter", layout, kernel, counts_at, "paper, Eq. 5; Cook 1986")


def cell_product(alphabet: Alphabet, counts: tuple[str, ...], first_group: int = 0) -> Kernel:
    """∏_i sinc²(m_i/n_i), one group per count: |E exp(−2πi m·u)|² for u uniform in a cell."""
    product = alphabet.over(first_group, alphabet.sinc2(alphabet.count(counts[0])))
    for group, count in enumerate(counts[1:], first_group + 1):
        product = product * alphabet.over(group, alphabet.sinc2(alphabet.count(count)))
    return product
