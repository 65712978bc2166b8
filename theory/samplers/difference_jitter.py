"""Difference jitter in 1D: s_j = (j + u_j − u_(j−1))/N on a circle of N >= 3 points, u uniform.

Neighbours share a displacement, so that a run of points is moved, on the whole, by the two u's at
its ends alone (lattices with correlated displacements: Gabrielli 2004). With x = m/N and
φ(x) = E exp(−2πixu), two points that share no u have the characteristic function φ(x)⁴, neighbours
φ(2x) φ(−x)², but for the distance of their cells, and

    N·P_S(m) = 1 − φ⁴ + 2 Re[e^(2πix) φ(2x) φ(−x)²] − 2 cos(2πx) φ⁴ + N φ⁴ [x is whole].

For u uniform of width 1 around 0, φ(x) = sinc(x): no x ≠ 0 is whole with φ ≠ 0, and by
cos(2πx) sinc(2x) = sinc(4x) and sinc(x)(1 + 2 cos 2πx) = 3 sinc(3x)

    N·P_S(m) = 1 − 3 sinc³(x) sinc(3x) + 2 sinc²(x) sinc(4x),

of degree 4: 23π⁴x⁴/15, that is 16π⁴(μ_2 + μ_4)x⁴ with the moments μ_k = E u^k.
"""

from collections.abc import Mapping

from ..errors import InputError
from ..kernels import Alphabet
from ..layouts import Layout, grouped
from ..shapes import DIFFERENCE
from ..signs import Assumptions
from ..symbolic import Expr
from .definition import Sampler


def difference_jitter(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``difference-jitter``."""
    if dim != 1:
        raise InputError(f"difference-jitter is for --dim 1: got {dim}")
    if argument:
        raise InputError(f"difference-jitter takes no parameter: got {argument!r}")
    alphabet = Alphabet(("N",))
    pairs = alphabet.over(0, alphabet.shape(DIFFERENCE, alphabet.count("N")))
    layout = Layout(grouped((dim,)), assumptions=assumptions)
    kernel = alphabet.constant() - pairs
    name = "difference-jitter"
    return Sampler(name, name, layout, kernel, _counts, "correlated displacements, Gabrielli 2004")


def _counts(n: int) -> Mapping[str, int]:
    return {"N": max(3, n)}
