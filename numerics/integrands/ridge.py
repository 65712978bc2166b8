"""Ridge f(x) = B_b({k.x}), k an integer vector: |fhat(j k)|^2 = (b!/(2 pi j)^b)^2, else 0."""

from dataclasses import dataclass
from fractions import Fraction
from math import factorial

import numpy as np

from ...theory.errors import InputError
from ..balls import Ball, certified, flint
from .bernoulli import require_degree
from .literals import literal
from .protocol import Floats, Ints, Part
from .spline import bernoulli_values, cosine_sum


@dataclass(frozen=True)
class Ridge:
    """A Bernoulli polynomial along one direction: all its power lies on the multiples of k.

    Parameters
    ----------
    k : tuple of int
        One entry per coordinate, not all 0.
    b : int
        Degree, 1 <= b <= 12.
    """

    k: tuple[int, ...]
    b: int

    def __post_init__(self) -> None:
        require_degree("ridge", self.b, "b")
        if not any(self.k):
            raise InputError(f"ridge: k must satisfy k != 0: got {self._vector}")

    @property
    def _vector(self) -> str:
        return literal(tuple(map(Fraction, self.k)))

    @property
    def name(self) -> str:
        """``ridge:k=(...)``, with the degree unless it is 2."""
        return f"ridge:k={self._vector}" + (f",b={self.b}" if self.b != 2 else "")

    @property
    def dim(self) -> int:
        """Number of coordinates."""
        return len(self.k)

    @property
    def parts(self) -> tuple[Part, ...]:
        """None: a ridge is no sum of products."""
        return ()

    @property
    def support(self) -> tuple[int, ...]:
        """The coordinates i with k_i != 0."""
        return tuple(i for i, k in enumerate(self.k, 1) if k)

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        return bernoulli_values(self.b, (points @ np.array(self.k, np.float64)) % 1.0)

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        direction = np.array(self.k, np.int64)
        first = self.support[0] - 1
        j = m[..., first] // direction[first]
        along = np.all(m == j[..., None] * direction, axis=-1) & (j != 0)
        decay = (2 * np.pi * np.where(along, j, 1)) ** self.b / factorial(self.b)
        return np.where(along, decay**-2, 0.0)

    def mean(self, digits: int) -> Ball:
        """Zero."""
        del digits
        return flint.arb(0)

    def total(self, digits: int) -> Ball:
        """``sum over m != 0 of |fhat(m)|^2 = b!^2 K_b(0)``, certified to the digits."""
        exact = factorial(self.b) ** 2 * cosine_sum(self.b, flint.fmpq(0))
        return certified(lambda: flint.arb(exact), digits)
