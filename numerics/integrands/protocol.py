"""What an integrand is: exact parameters, values, Fourier powers and, for products, power sums.

The variance of a randomly shifted sampler is ``sum over m != 0 of P_S(m) |fhat(m)|^2`` with
``fhat(m) = int f(x) exp(-2 pi i m.x) dx`` on the unit torus. A sampler's expected spectrum P_S is
a short sum of products over coordinates whose factors are 1, [m = 0], ``sinc^2(m/n)``, [n | m] or
``[n | m] sinc^2(m/n')``. For ``f = prod_i f_i(x_i)`` the variance is then a short sum of products
of the numbers that a `Factor` gives. Such numbers are balls, made from exact parameters at the
precision in force (``flint.ctx.prec``): their error is proven.
"""

from fractions import Fraction
from typing import Any, Protocol, TypeAlias

import numpy as np
from mpmath import mp as _mp  # pyright: ignore[reportMissingTypeStubs]
from numpy.typing import NDArray

from ..balls import Ball

mp: Any = _mp
"""The mpmath context; mpmath carries no types, so that it enters the package as ``Any`` here."""

Mpf: TypeAlias = Any
"""A real number of mpmath, ``mpmath.mpf``."""

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int64]
Count: TypeAlias = int | Fraction
"""A number of strata, positive; an integer but where a sum is tested between the integers."""


class Factor(Protocol):
    """A function of one coordinate; equal parameters make equal, hashable, picklable objects."""

    def values(self, x: Floats) -> Floats:
        """f(x) for x in [0, 1), in double precision."""
        ...

    def power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` in double precision, m = 0 included."""
        ...

    def mean(self) -> Ball:
        """``fhat(0)``."""
        ...

    def power_sum(self, comb: int = 1, count: Count | None = None) -> Ball:
        """``sum over m != 0, comb | m, of |fhat(m)|^2 sinc^2(m/count)``, or without sinc^2.

        Where the sum is zero because ``comb/count`` is an integer, or because f is constant or a
        step function that the comb does not see, the ball is exactly zero.
        """
        ...


Part: TypeAlias = tuple[tuple[int, Factor], ...]
"""``prod_i f_i(x_i)`` over some coordinates i, counted from 1 and increasing, with their f_i."""


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
    def parts(self) -> tuple[Part, ...]:
        """Products whose sum is f and of which no two have power at one m; () for other f."""
        ...

    @property
    def support(self) -> tuple[int, ...] | None:
        """Coordinates, from 1, of the one support that carries all power; None if several do."""
        ...

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim) in [0, 1), shape (...)."""
        ...

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        ...

    def mean(self, digits: int) -> Ball:
        """``fhat(0)``, certified to the given number of decimal digits."""
        ...

    def total(self, digits: int) -> Ball:
        """``sum over m != 0 of |fhat(m)|^2``, certified to the given number of decimal digits."""
        ...


def to_mpf(ball: Ball) -> Mpf:
    """The middle of the ball, exactly, whatever the working precision of mpmath."""
    return mp.convert(ball.mid())
