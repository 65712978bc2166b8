"""Box prod_i 1[x_i < a_i]: |fhat(m)|^2 = prod_i a_i^2 sinc^2(a_i m_i)."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ...theory.errors import InputError
from .literals import literal
from .protocol import Factor, Floats, Ints, Mpf, product_mean, product_power, product_total
from .spline import SplineFactor


@dataclass(frozen=True)
class Box:
    """Indicator of the axis-aligned box with a corner at the origin.

    Parameters
    ----------
    sides : tuple of Fraction
        Sides a_i, each 0 < a_i <= 1 and not all 1; a side 1 leaves its coordinate out.
    """

    sides: tuple[Fraction, ...]

    def __post_init__(self) -> None:
        for side in self.sides:
            if not 0 < side <= 1:
                raise InputError(f"box: side must satisfy 0 < side <= 1: got {literal(side)}")
        if all(side == 1 for side in self.sides):
            rule = "box: some side must satisfy side < 1"
            raise InputError(f"{rule}: got {literal(self.sides)}")

    @property
    def name(self) -> str:
        """``box:side=...``, one number where all sides agree."""
        same = len(set(self.sides)) == 1
        return f"box:side={literal(self.sides[0] if same else self.sides)}"

    @property
    def dim(self) -> int:
        """Number of coordinates."""
        return len(self.sides)

    @property
    def factors(self) -> tuple[Factor, ...]:
        """One factor per coordinate."""
        return tuple(map(interval, self.sides))

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        sides = np.array([float(side) for side in self.sides])
        return np.all(points < sides, axis=-1).astype(np.float64)

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        return product_power(self.factors, m)

    def mean(self, digits: int) -> Mpf:
        """``prod_i a_i``."""
        return product_mean(self.factors, digits)

    def total(self, digits: int) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2``."""
        return product_total(self.factors, digits)


def interval(length: Fraction) -> SplineFactor:
    """Indicator of ``0 <= x < a``, ``0 < a <= 1``: ``a + B_1({x - a}) - B_1(x)``."""
    return SplineFactor(length, 1, ((Fraction(1), length), (Fraction(-1), Fraction(0))))
