"""Chord of a ball: f(x) = 2 sqrt(R^2 - |x - c|^2), what a line along one more axis integrates.

It is the ball of d + 1 dimensions integrated along its last axis, so that |fhat(m)|^2 is the ball's
at m_{d+1} = 0: (R/rho)^{d+1} J_{(d+1)/2}(2 pi R rho)^2 with rho = |m| (slice theorem).
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ...theory.errors import InputError
from ..balls import Ball as Number
from ..balls import certified, exact_ball, flint
from .ball import Ball
from .literals import literal
from .protocol import Floats, Ints, Part


@dataclass(frozen=True)
class Chord:
    """Length of the chord that a line along an extra axis cuts from the ball centred in the cube.

    Parameters
    ----------
    dim : int
        Number of coordinates, at least 1: one less than the ball has.
    radius : Fraction
        R, with 0 < R < 1/2.
    """

    dim: int
    radius: Fraction

    def __post_init__(self) -> None:
        if self.dim < 1:
            raise InputError(f"chord: the dimension must satisfy 1 <= dim: got {self.dim}")
        if not 0 < self.radius < Fraction(1, 2):
            rule = "chord: radius must satisfy 0 < radius < 1/2"
            raise InputError(f"{rule}: got {literal(self.radius)}")

    @property
    def name(self) -> str:
        """``chord:radius=...``."""
        return f"chord:radius={literal(self.radius)}"

    @property
    def parts(self) -> tuple[Part, ...]:
        """None."""
        return ()

    @property
    def support(self) -> tuple[int, ...] | None:
        """The axis in one dimension; else power lies on every support."""
        return (1,) if self.dim == 1 else None

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        offset = points - 0.5
        squares = np.einsum("...i,...i->...", offset, offset)
        return 2.0 * np.sqrt(np.maximum(float(self.radius) ** 2 - squares, 0.0))

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        level = np.zeros((*m.shape[:-1], 1), dtype=m.dtype)
        return Ball(self.dim + 1, self.radius).coefficient_power(
            np.concatenate([m, level], axis=-1)
        )

    def mean(self, digits: int) -> Number:
        """Volume of the ball, certified to the given number of digits."""
        return Ball(self.dim + 1, self.radius).mean(digits)

    def total(self, digits: int) -> Number:
        """``sum over m != 0 of |fhat(m)|^2``, certified likewise (Parseval).

        The integral of f^2 is ``4 pi^(d/2) R^(d+2) / Gamma(d/2 + 2)``, ``16 R^3/3`` for d = 1.
        """
        return certified(self._square_less_squared_mean, digits)

    def _square_less_squared_mean(self) -> Number:
        radius, pi = exact_ball(self.radius), flint.arb.pi()
        half = exact_ball(Fraction(self.dim, 2))
        square = 4 * pi**half * radius ** (self.dim + 2) / (half + 2).gamma()
        volume = pi ** (half + flint.arb(1) / 2)
        volume *= radius ** (self.dim + 1) / (half + flint.arb(3) / 2).gamma()
        return square - volume**2
