"""What an integrand is: exact parameters, values, Fourier powers and, for a product, 1D power sums.

The variance of a randomly shifted sampler is ``sum over m != 0 of P_S(m) |fhat(m)|^2`` with
``fhat(m) = int f(x) exp(-2 pi i m.x) dx`` on the unit torus. A sampler's expected spectrum P_S is
a short sum of products over coordinates whose factors are 1, [m = 0], ``sinc^2(m/n)``, [n | m] or
``[n | m] sinc^2(m/n')``. For ``f = prod_i f_i(x_i)`` the variance is then a short sum of products
of the five numbers that a `Factor` gives.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from operator import mul
from typing import Any, Protocol, TypeAlias

import numpy as np
from mpmath import mp as _mp  # pyright: ignore[reportMissingTypeStubs]
from numpy.typing import NDArray

mp: Any = _mp
"""The mpmath context; mpmath carries no types, so that it enters the package as ``Any`` here."""

Mpf: TypeAlias = Any
"""A real number of mpmath, ``mpmath.mpf``."""

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int64]
Count: TypeAlias = int | Mpf
"""A number of strata: a positive integer, or a positive ``mpmath.mpf``."""


class Factor(Protocol):
    """A function of one coordinate, by its mean and sums of ``|fhat(m)|^2`` over m != 0.

    The methods without arrays work at the precision of ``mpmath.mp``; their errors are a few
    units in the last place of the sum without its sinc^2 factor.
    """

    def power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` in double precision, m = 0 included."""
        ...

    def mean(self) -> Mpf:
        """``fhat(0)``."""
        ...

    def total(self) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2``, the variance of f."""
        ...

    def sinc2_sum(self, n: Count) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2 sinc^2(m/n)``."""
        ...

    def comb_sum(self, n: int) -> Mpf:
        """``sum over m != 0, n | m, of |fhat(m)|^2``."""
        ...

    def comb_sinc2_sum(self, n: int, n2: Count) -> Mpf:
        """``sum over m != 0, n | m, of |fhat(m)|^2 sinc^2(m/n2)``."""
        ...


class Integrand(Protocol):
    """A function on the unit torus; equal parameters make equal, hashable, picklable objects."""

    @property
    def name(self) -> str:
        """Text that `parse_integrand` turns back into an equal object, given the dimension."""
        ...

    @property
    def dim(self) -> int:
        """Number of coordinates."""
        ...

    @property
    def factors(self) -> tuple[Factor, ...] | None:
        """One factor per coordinate, or None where f is not a product."""
        ...

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim) in [0, 1), shape (...)."""
        ...

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        ...

    def mean(self, digits: int) -> Mpf:
        """``fhat(0)`` to the given number of decimal digits."""
        ...

    def total(self, digits: int) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2`` to the given number of decimal digits."""
        ...


def product_power(factors: Sequence[Factor], m: Ints) -> Floats:
    """``prod_i |fhat_i(m_i)|^2`` at integer frequencies of shape (..., d)."""
    return reduce(mul, (f.power(m[..., i]) for i, f in enumerate(factors)))


def product_mean(factors: Sequence[Factor], digits: int) -> Mpf:
    """``prod_i mean_i``, to the given number of digits."""
    with mp.workdps(digits + 5):
        return mp.fprod(f.mean() for f in factors)


def product_total(factors: Sequence[Factor], digits: int) -> Mpf:
    """``prod_i (mean_i^2 + s_i) - prod_i mean_i^2``, summed without cancellation.

    One coordinate at a time: with M the product of squared means and T the total so far,
    ``T <- T (mean^2 + s) + M s``; every term is positive.
    """
    with mp.workdps(digits + 5):
        total, mean2 = mp.mpf(0), mp.mpf(1)
        for factor in factors:
            s, square = factor.total(), factor.mean() ** 2
            total, mean2 = total * (square + s) + mean2 * s, mean2 * square
        return total


def to_mpf(value: Fraction) -> Mpf:
    """The rational, rounded to the working precision."""
    with mp.extraprec(10):
        result = mp.mpf(value.numerator) / value.denominator
    return +result
