"""Energy of a function, what m = 0 gives kept apart from what all other frequencies give.

The energies of functions of different coordinates multiply,

    (z, r) (z', r') = (z z', z r' + r z' + r r'),

and the mean never enters the second number by a subtraction: nothing cancels.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from ..balls import Ball, flint
from .protocol import Factor, Part


@dataclass(frozen=True)
class Energy:
    """``sum of w(m) |fhat(m)|^2`` with weights w, split into m = 0 and the rest.

    Parameters
    ----------
    at_zero, beyond : Ball
    """

    at_zero: Ball
    beyond: Ball

    def __add__(self, other: "Energy") -> "Energy":
        return Energy(self.at_zero + other.at_zero, self.beyond + other.beyond)

    def __mul__(self, other: "Energy") -> "Energy":
        mixed = self.at_zero * other.beyond + self.beyond * other.at_zero
        return Energy(self.at_zero * other.at_zero, mixed + self.beyond * other.beyond)

    def scaled(self, weight: Ball) -> "Energy":
        """All weights times one number."""
        return Energy(weight * self.at_zero, weight * self.beyond)

    def to_power(self, count: int) -> "Energy":
        """The product of ``count`` >= 0 equal energies, by repeated squaring."""
        result, square = unit_energy(), self
        while count:
            if count & 1:
                result = result * square
            square, count = square * square, count >> 1
        return result


def unit_energy() -> Energy:
    """That of the constant 1."""
    return Energy(flint.arb(1), flint.arb(0))


def factor_energy(factor: Factor) -> Energy:
    """Without weights: the squared mean and the variance of a function of one coordinate."""
    mean = factor.mean()
    return Energy(mean * mean, factor.power_sum())


def total_energy(parts: Iterable[Part]) -> Ball:
    """``sum over m != 0 of |fhat(m)|^2`` of a sum of products without common frequencies."""
    total = flint.arb(0)
    for part in parts:
        energy = unit_energy()
        for _, factor in part:
            energy = energy * factor_energy(factor)
        total += energy.beyond
    return total
