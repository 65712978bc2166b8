"""Latin hypercube, n-rooks in 2D: 1D jitter on every axis, joined by random permutations.

The pairs of points have on every axis the characteristic function (N [m_i = 0] − A'_i)/(N − 1),
A'_i = sinc²(m_i/N), so that

    N·P_S(m) = 1 + (N − 1) ∏_i (N [m_i = 0] − A'_i)/(N − 1).

(McKay, Beckman, Conover 1979; Shirley 1991; paper, Sec. 6.2.)
"""

from collections.abc import Mapping

from ..errors import InputError
from ..kernels import Alphabet
from ..layouts import Growth, Layout, grouped
from ..signs import Assumptions
from ..symbolic import Expr, Integer
from .definition import Sampler


def latin_hypercube(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``latin-hypercube``, alias ``n-rooks``."""
    if argument:
        raise InputError(f"latin-hypercube takes no parameter: got {argument!r}")
    alphabet = Alphabet(("N",))
    n = alphabet.count("N")
    pair = (alphabet.zero().scaled(n) - alphabet.sinc2(n)).scaled(1 / (n - 1))
    kernel = alphabet.constant() + alphabet.over(0, pair).scaled(n - 1)
    layout = Layout(grouped((dim,)), {"N": Growth(Integer(1))}, assumptions)
    reference = "McKay, Beckman, Conover 1979; Shirley 1991"
    return Sampler("latin-hypercube", "latin-hypercube", layout, kernel, _counts, reference)


def _counts(n: int) -> Mapping[str, int]:
    return {"N": max(2, n)}
