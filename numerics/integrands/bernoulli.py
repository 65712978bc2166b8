"""Bernoulli polynomial f = prod over the axes of B_k(x_i): |fhat(m)|^2 = (k!/(2 pi m)^k)^2 each."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ...theory.errors import InputError
from .literals import literal
from .protocol import Factor, Floats, Ints, Mpf, product_mean, product_power, product_total
from .spline import SplineFactor, bernoulli_values

_HIGHEST = 12  # B_k(x) keeps its digits in double precision up to here


@dataclass(frozen=True)
class Bernoulli:
    """``B_k(x_i)`` multiplied over the given axes: all its power lies on that one support.

    Parameters
    ----------
    dim : int
        Number of coordinates.
    k : int
        Degree, 1 <= k <= 12; the power on an axis decays as m^(-2k).
    axes : tuple of int
        Coordinates that f depends on, counted from 1, strictly increasing.
    """

    dim: int
    k: int
    axes: tuple[int, ...]

    def __post_init__(self) -> None:
        require_degree("bernoulli", self.k)
        axes = self.axes
        if not axes or axes != tuple(sorted(set(axes))) or axes[0] < 1 or axes[-1] > self.dim:
            got = literal(tuple(map(Fraction, axes)))
            rule = f"bernoulli: axes must be increasing numbers from 1 to {self.dim}"
            raise InputError(f"{rule}: got {got}")

    @property
    def name(self) -> str:
        """``bernoulli:k=...``, with the axes unless they are the first alone."""
        axes = "" if self.axes == (1,) else f",axes={literal(tuple(map(Fraction, self.axes)))}"
        return f"bernoulli:k={self.k}{axes}"

    @property
    def factors(self) -> tuple[Factor, ...]:
        """One factor per coordinate, the constant 1 outside the axes."""
        one = SplineFactor(Fraction(1), self.k, ())
        wave = bernoulli_factor(Fraction(0), self.k, Fraction(1))
        return tuple(wave if i + 1 in self.axes else one for i in range(self.dim))

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        result = np.ones(points.shape[:-1])
        for axis in self.axes:
            result *= bernoulli_values(self.k, points[..., axis - 1])
        return result

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        return product_power(self.factors, m)

    def mean(self, digits: int) -> Mpf:
        """Zero."""
        return product_mean(self.factors, digits)

    def total(self, digits: int) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2``."""
        return product_total(self.factors, digits)


def bernoulli_factor(constant: Fraction, k: int, weight: Fraction) -> SplineFactor:
    """``constant + weight B_k(x)``."""
    return SplineFactor(constant, k, ((weight, Fraction(0)),))


def require_degree(name: str, k: int) -> None:
    """Raise InputError unless the degree of a Bernoulli polynomial is in range."""
    if not 1 <= k <= _HIGHEST:
        raise InputError(f"{name}: k must satisfy 1 <= k <= {_HIGHEST}: got {k}")
