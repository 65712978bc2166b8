"""Independent uniform points: N·P_S = 1 for m ≠ 0 (white noise; paper, Eq. 5, first row)."""

from collections.abc import Mapping

from ..errors import InputError
from ..kernels import Alphabet
from ..layouts import Layout, grouped
from ..signs import Assumptions
from ..symbolic import Expr
from .definition import Sampler


def random(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``random``."""
    if argument:
        raise InputError(f"random takes no parameter: got {argument!r}")
    layout = Layout(grouped((dim,)), assumptions=assumptions)
    kernel = Alphabet(("N",)).constant()
    return Sampler("random", "random", layout, kernel, _counts, "paper, Eq. 5")


def _counts(n: int) -> Mapping[str, int]:
    return {"N": max(1, n)}
