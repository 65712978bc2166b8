"""A free isotropic profile of degree b, the hypothesis of Eq. 27; theory only.

P_S = (γ/N) min(1, (ρ/(α N^(1/d)))^b) on every support, b ≥ 0 a number or a symbol.
"""

from ..errors import InputError
from ..expressions import parse_expression
from ..layouts import Layout, grouped
from ..profiles import SaturatingMonomial
from ..signs import Assumptions, Range
from ..symbolic import Expr, Integer, sympy
from .definition import Sampler


def isotropic(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``isotropic:b`` or ``isotropic:3/2``."""
    if argument == "b":
        degree: Expr = sympy.Symbol("b", positive=True)
        assumptions = (*assumptions, Range(degree, Integer(0), integer=False))
    else:
        degree = parse_expression(argument) if argument else Integer(-1)
    if degree.is_number and not (degree.is_Rational and degree >= 0):
        raise InputError(
            f"isotropic:b needs b or a rational degree of at least 0: got {argument!r}"
        )
    effective = Integer(0) if degree == 0 else 1 / dim
    profile = (SaturatingMonomial(degree, effective),)
    layout = Layout(grouped((dim,)), assumptions=assumptions)
    return Sampler(
        f"isotropic:{argument}", "isotropic", layout, None, None, "paper, Eq. 27", profile
    )
