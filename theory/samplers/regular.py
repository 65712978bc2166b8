"""Regular grid n_1 × ... × n_d: P_S(m) = ∏_i [n_i divides m_i] (paper, Appendix A)."""

from ..kernels import Alphabet
from ..layouts import Layout
from ..signs import Assumptions
from ..symbolic import Expr
from .definition import Sampler
from .stratified import grid_of, strata_of


def regular(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``regular``, ``regular:25x40``."""
    groups, counts, growth, counts_at = grid_of(strata_of(argument, dim), dim)
    alphabet = Alphabet(("N", *counts))
    kernel = alphabet.constant(alphabet.count("N"))
    for group, count in enumerate(counts):
        kernel = kernel * alphabet.over(group, alphabet.comb(alphabet.count(count)))
    layout = Layout(groups, growth, assumptions)
    name = f"regular:{argument}" if argument else "regular"
    return Sampler(name, "regular", layout, kernel, counts_at, "paper, Appendix A")
