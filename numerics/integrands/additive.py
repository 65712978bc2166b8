"""Additive function f = sum_i B_k(x_i): power on the axes alone, |fhat|^2 = (k!/(2 pi m)^k)^2.

The class for which Latin hypercubes are fast (Stein 1987): they leave what is not additive.
"""

from fractions import Fraction

from .bernoulli import bernoulli_factor, require_degree
from .separable import Separable


def additive(dim: int, k: int) -> Separable:
    """``sum_i B_k(x_i)``, of mean 0: ``additive:k=...``.

    Parameters
    ----------
    dim : int
        Number of coordinates.
    k : int
        Degree, 1 <= k <= 12.

    Raises
    ------
    InputError
        If the degree is out of range.
    """
    require_degree("additive", k)
    wave = bernoulli_factor(Fraction(0), k, Fraction(1))
    return Separable(f"additive:k={k}", dim, tuple(((i, wave),) for i in range(1, dim + 1)))
