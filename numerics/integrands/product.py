"""Product f = prod_i (1 + c B_k(x_i)): power on every support, |fhat_i|^2 = (c k!/(2 pi m)^k)^2."""

from fractions import Fraction

from ...theory.errors import InputError
from .bernoulli import bernoulli_factor, require_degree
from .literals import literal
from .separable import Separable


def product(dim: int, k: int, c: Fraction) -> Separable:
    """``prod_i (1 + c B_k(x_i))``, of mean 1: ``product:k=...``, with c unless it is 1.

    Parameters
    ----------
    dim : int
        Number of coordinates.
    k : int
        Degree, 1 <= k <= 12.
    c : Fraction
        Weight, not 0.

    Raises
    ------
    InputError
        If the degree is out of range, or the weight is 0.
    """
    require_degree("product", k)
    if c == 0:
        raise InputError("product: c must satisfy c != 0: got 0")
    weight = "" if c == 1 else f",c={literal(c)}"
    factor = bernoulli_factor(Fraction(1), k, c)
    part = tuple((i, factor) for i in range(1, dim + 1))
    return Separable(f"product:k={k}{weight}", dim, (part,))
