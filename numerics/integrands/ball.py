"""Ball |x - c| <= R: |fhat(m)|^2 = (R/rho)^d J_{d/2}(2 pi R rho)^2 with rho = |m| (Bochner)."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ...theory.errors import InputError
from .box import interval
from .literals import literal
from .protocol import Factor, Floats, Ints, Mpf, mp, to_mpf


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
    def factors(self) -> tuple[Factor, ...] | None:
        """The factor of an interval in one dimension, else None."""
        if self.dim == 1:
            return (interval(2 * self.radius),)
        return None

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

    def mean(self, digits: int) -> Mpf:
        """Volume ``pi^(d/2) R^d / Gamma(d/2 + 1)``."""
        with mp.workdps(digits + 5):
            half = mp.mpf(self.dim) / 2
            return mp.pi**half * to_mpf(self.radius) ** self.dim / mp.gamma(half + 1)

    def total(self, digits: int) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2 = V (1 - V)`` (Parseval)."""
        with mp.workdps(digits + 5):
            volume = self.mean(digits)
            return volume * (1 - volume)
