"""Product f = prod_i (1 + c B_k(x_i)): power on every support, |fhat_i|^2 = (c k!/(2 pi m)^k)^2."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ...theory.errors import InputError
from .bernoulli import bernoulli_factor, require_degree
from .literals import literal
from .protocol import Factor, Floats, Ints, Mpf, product_mean, product_power, product_total
from .spline import bernoulli_values


@dataclass(frozen=True)
class Product:
    """``prod_i (1 + c B_k(x_i))``, of mean 1.

    Parameters
    ----------
    dim : int
        Number of coordinates.
    k : int
        Degree, 1 <= k <= 12.
    c : Fraction
        Weight, not 0.
    """

    dim: int
    k: int
    c: Fraction

    def __post_init__(self) -> None:
        require_degree("product", self.k)
        if self.c == 0:
            raise InputError("product: c must satisfy c != 0: got 0")

    @property
    def name(self) -> str:
        """``product:k=...``, with c unless it is 1."""
        weight = "" if self.c == 1 else f",c={literal(self.c)}"
        return f"product:k={self.k}{weight}"

    @property
    def factors(self) -> tuple[Factor, ...]:
        """One factor per coordinate."""
        return (bernoulli_factor(Fraction(1), self.k, self.c),) * self.dim

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        result = np.ones(points.shape[:-1])
        for i in range(self.dim):
            result *= 1.0 + float(self.c) * bernoulli_values(self.k, points[..., i])
        return result

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        return product_power(self.factors, m)

    def mean(self, digits: int) -> Mpf:
        """One."""
        return product_mean(self.factors, digits)

    def total(self, digits: int) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2``."""
        return product_total(self.factors, digits)
