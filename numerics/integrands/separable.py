"""Separable integrands: sums of products of functions of one coordinate each.

The products of one sum have no frequency in common, so that their powers add: ``|fhat(m)|^2`` is
the sum over the products of ``prod_i |fhat_i(m_i)|^2``, with m = 0 on all other coordinates.
"""

from dataclasses import dataclass, field

import numpy as np

from ..balls import Ball, certified, flint
from .energies import total_energy
from .protocol import Floats, Ints, Part


@dataclass(frozen=True)
class Separable:
    """A sum of products of functions of one coordinate each.

    Parameters
    ----------
    name : str
        In the grammar of integrands, canonical: it determines the parts.
    dim : int
        Number of coordinates.
    parts : tuple of Part
        No two have power at the same frequency; one at most has a mean other than zero.
    """

    name: str
    dim: int
    parts: tuple[Part, ...] = field(hash=False)

    @property
    def support(self) -> tuple[int, ...] | None:
        """The coordinates of the only product, if it has one alone or all their means are zero."""
        first, *others = self.parts
        axes = tuple(axis for axis, _ in first)
        alone = len(axes) == 1 or all(factor.mean().is_zero() for _, factor in first)
        return axes if alone and not others else None

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        result = np.zeros(points.shape[:-1])
        for part in self.parts:
            value = np.ones(points.shape[:-1])
            for axis, factor in part:
                value *= factor.values(points[..., axis - 1])
            result += value
        return result

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        result = np.zeros(m.shape[:-1])
        for part in self.parts:
            axes = [axis - 1 for axis, _ in part]
            value = np.all(np.delete(m, axes, axis=-1) == 0, axis=-1).astype(np.float64)
            for axis, factor in part:
                value *= factor.power(m[..., axis - 1])
            result += value
        return result

    def mean(self, digits: int) -> Ball:
        """``fhat(0)``, certified to the given number of decimal digits."""
        return certified(lambda: sum(map(_part_mean, self.parts), flint.arb(0)), digits)

    def total(self, digits: int) -> Ball:
        """``sum over m != 0 of |fhat(m)|^2``, certified to the given number of decimal digits."""
        return certified(lambda: total_energy(self.parts), digits)


def _part_mean(part: Part) -> Ball:
    mean = flint.arb(1)
    for _, factor in part:
        mean *= factor.mean()
    return mean
