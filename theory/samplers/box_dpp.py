"""Box projection DPP: the determinantal process of a box of frequencies n_1 × ... × n_d, N = ∏ n_i.

Its kernel Σ_{k in Λ} exp(2πi k·(x − y)) projects onto the waves of the box Λ. The process has N
points, is invariant under shifts, and

    N·P_S(m) = 1 − |Λ ∩ (Λ + m)|/N = 1 − ∏_i (1 − |m_i|/n_i)^+

(Hough, Krishnapur, Peres, Virág 2006; in one dimension the eigenvalues of a random unitary matrix,
Dyson 1962). At low frequencies N·P_S ~ Σ |m_i|/n_i: degree 1, as for the determinantal processes
of Bardenet and Hardy 2020.
"""

from ..kernels import Alphabet
from ..layouts import Layout
from ..shapes import TENT
from ..signs import Assumptions
from ..symbolic import Expr
from .definition import Sampler
from .stratified import grid_of, strata_of


def box_dpp(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``box-dpp``, ``box-dpp:25x40`` with so many frequencies along the axes."""
    groups, counts, growth, counts_at = grid_of(strata_of(argument, dim), dim)
    alphabet = Alphabet(("N", *counts))
    shared = alphabet.constant()
    for group, count in enumerate(counts):
        tent = alphabet.shape(TENT, alphabet.count(count))
        shared = shared * alphabet.over(group, tent)
    layout = Layout(groups, growth, assumptions)
    name = f"box-dpp:{argument}" if argument else "box-dpp"
    reference = "Hough, Krishnapur, Peres, Virag 2006; Dyson 1962"
    return Sampler(name, "box-dpp", layout, alphabet.constant() - shared, counts_at, reference)
