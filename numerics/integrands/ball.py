"""Ball |x - c| <= R: |fhat(m)|^2 = (R/rho)^d J_{d/2}(2 pi R rho)^2 with rho = |m| (Bochner)."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ...theory.errors import InputError
from ..balls import Ball as Number
from ..balls import certified, exact_ball, flint
from .box import interval
from .literals import literal
from .protocol import Floats, Ints, Part


@dataclass(frozen=True)
class Ball:
    """Indicator of the ball of radius R centred in the cube; the disk in two dimensions.

    Parameters
    ----------
    dim : int
        Number of coordinates, at least 1; the interval of length 2R in one dimension.
    radius : Fraction
        R, with 0 < R < 1/2: the ball does not meet its translates.
    """

    dim: int
    radius: Fraction

    def __post_init__(self) -> None:
        if self.dim < 1:
            raise InputError(f"ball: the dimension must satisfy 1 <= dim: got {self.dim}")
        if not 0 < self.radius < Fraction(1, 2):
            rule = "ball: radius must satisfy 0 < radius < 1/2"
            raise InputError(f"{rule}: got {literal(self.radius)}")

    @property
    def name(self) -> str:
        """``disk:radius=...`` in two dimensions, else ``ball:radius=...``."""
        return f"{'disk' if self.dim == 2 else 'ball'}:radius={literal(self.radius)}"

    @property
    def parts(self) -> tuple[Part, ...]:
        """In one dimension the interval, shifted to the origin; else none."""
        return (((1, interval(2 * self.radius)),),) if self.dim == 1 else ()

    @property
    def support(self) -> tuple[int, ...] | None:
        """The axis in one dimension; else power lies on every support."""
        return (1,) if self.dim == 1 else None

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        offset = points - 0.5
        squares = np.einsum("...i,...i->...", offset, offset)
        return (squares <= float(self.radius) ** 2).astype(np.float64)

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        from scipy.special import jv  # pyright: ignore[reportMissingTypeStubs]

        radius = float(self.radius)
        rho = np.sqrt(np.sum(np.asarray(m, float) ** 2, axis=-1))
        safe = np.where(rho == 0, 1.0, rho)
        wave = (radius / safe) ** (self.dim / 2) * jv(self.dim / 2, 2 * np.pi * radius * safe)
        return np.where(rho == 0, float(self.mean(17)), wave) ** 2

    def mean(self, digits: int) -> Number:
        """Volume ``pi^(d/2) R^d / Gamma(d/2 + 1)``, certified to the given number of digits."""
        return certified(self._volume, digits)

    def total(self, digits: int) -> Number:
        """``sum over m != 0 of |fhat(m)|^2 = V (1 - V)`` (Parseval), certified likewise."""
        return certified(lambda: self._volume() * (1 - self._volume()), digits)

    def _volume(self) -> Number:
        power = flint.arb.pi() ** exact_ball(Fraction(self.dim, 2))
        gamma = flint.arb.gamma_fmpq(flint.fmpq(self.dim + 2, 2))
        return power * exact_ball(self.radius) ** self.dim / gamma
