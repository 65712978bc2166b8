r"""Gaussian exp(-sum_i (x_i - 1/2)^2/(2 sigma_i^2)), summed over all integer translates.

``|fhat(m)|^2 = prod_i 2 pi sigma_i^2 exp(-4 pi^2 sigma_i^2 m_i^2)``: one factor per coordinate,
whose power sums are theta functions. A wide factor is summed over frequencies. A narrow one is
summed over translates (Poisson summation): its periodic autocovariance is
``sum_j sigma sqrt(pi) exp(-(t + j)^2/(4 sigma^2)) - 2 pi sigma^2``, and the factor sinc^2(m/r)
takes the second difference at distance phi = 1/r modulo 1 of its second antiderivative

    pi sigma^2 phi (1 - phi) + sigma sqrt(pi) sum_j g(|j + phi|) + constant,
    g(t) = 2 sigma^2 exp(-t^2/(4 sigma^2)) - sigma sqrt(pi) t erfc(t/(2 sigma)).

A comb n | m of the factor of width sigma is the factor of width n sigma, divided by n^2.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor

import numpy as np

from ...theory.errors import InputError
from .literals import exact, literal
from .protocol import (
    Count,
    Factor,
    Floats,
    Ints,
    Mpf,
    mp,
    product_mean,
    product_power,
    product_total,
    to_mpf,
)

_NARROW = Fraction(1, 20)  # at or below: translates; neither side needs more than about 25 terms
_DOUBLE_WIDTHS = 9.0  # exp(-9^2/2) is below the rounding of a double


@dataclass(frozen=True)
class GaussianFactor:
    """Periodised ``exp(-(x - 1/2)^2/(2 sigma^2))``."""

    sigma: Fraction

    def power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2 = 2 pi sigma^2 exp(-4 pi^2 sigma^2 m^2)`` in double precision."""
        variance = float(self.sigma) ** 2
        return 2 * np.pi * variance * np.exp(-4 * np.pi**2 * variance * np.asarray(m, float) ** 2)

    def mean(self) -> Mpf:
        """``sigma sqrt(2 pi)``."""
        return to_mpf(self.sigma) * mp.sqrt(2 * mp.pi)

    def total(self) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2``."""
        return _total(self.sigma)

    def sinc2_sum(self, n: Count) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2 sinc^2(m/n)``."""
        return _smoothed(self.sigma, 1 / exact(n))

    def comb_sum(self, n: int) -> Mpf:
        """``sum over m != 0, n | m, of |fhat(m)|^2``."""
        return _total(self.sigma * exact(n)) / n**2

    def comb_sinc2_sum(self, n: int, n2: Count) -> Mpf:
        """``sum over m != 0, n | m, of |fhat(m)|^2 sinc^2(m/n2)``."""
        return _smoothed(self.sigma * exact(n), n / exact(n2)) / n**2


def _guard(sigma: Fraction) -> int:
    """Extra bits: exp(-x) loses those of x, at most ``16 pi^2 sigma^2`` and a few."""
    return 25 + 2 * ceil(sigma).bit_length()


def _terms(s: Mpf) -> int:
    """Number M of frequencies that reach the working precision.

    ``c (M^2 - 1) >= (digits + 5) ln 10`` with ``c = 4 pi^2 s^2``: the terms m > M sum to less than
    ``exp(-c M^2)/(1 - exp(-c))``, at most 11 x 10^-(digits + 5) of the term m = 1.
    """
    return int(mp.ceil(mp.sqrt(1 + (mp.dps + 5) * mp.ln10 / (2 * mp.pi * s) ** 2)))


def _total(sigma: Fraction) -> Mpf:
    """``sum over m != 0 of 2 pi sigma^2 exp(-4 pi^2 sigma^2 m^2)``."""
    with mp.extraprec(_guard(sigma)):
        s = to_mpf(sigma)
        if sigma > _NARROW:
            waves = mp.fsum(mp.exp(-((2 * mp.pi * s * m) ** 2)) for m in range(1, _terms(s) + 1))
            result = 4 * mp.pi * s**2 * waves
        else:
            reach = int(2 * s * mp.sqrt(mp.dps * mp.ln10)) + 1
            images = mp.fsum(mp.exp(-(j**2) / (4 * s**2)) for j in range(1, reach + 1))
            result = s * mp.sqrt(mp.pi) * (1 + 2 * images) - 2 * mp.pi * s**2
    return +result


def _smoothed(sigma: Fraction, step: Fraction) -> Mpf:
    """``sum over m != 0 of 2 pi sigma^2 exp(-4 pi^2 sigma^2 m^2) sinc^2(m step)``."""
    phi = step % 1
    if phi == 0:
        return mp.mpf(0)
    if sigma > _NARROW:
        return _smoothed_waves(sigma, step)
    # The two parts of the second difference, of size sigma^2, leave one of size phi^2: the
    # digits that they share are added beforehand.
    ratio = sigma / min(phi, 1 - phi)
    shared = max(0, 2 * (ratio.numerator.bit_length() - ratio.denominator.bit_length() + 1))
    with mp.extraprec(20 + shared):
        s, x = to_mpf(sigma), to_mpf(phi)
        rise = _images(s, x) - _images(s, mp.mpf(0))
        result = 2 * mp.pi * s**2 * x * (1 - x) + 2 * s * mp.sqrt(mp.pi) * rise
        result /= to_mpf(step) ** 2
    return +result


def _smoothed_waves(sigma: Fraction, step: Fraction) -> Mpf:
    with mp.extraprec(_guard(sigma)):
        s, result = to_mpf(sigma), mp.mpf(0)
        for m in range(1, _terms(s) + 1):
            sinc = mp.sinpi(to_mpf(m * step % 1)) / (mp.pi * to_mpf(m * step))
            result += mp.exp(-((2 * mp.pi * s * m) ** 2)) * sinc**2
        result *= 4 * mp.pi * s**2
    return +result


def _images(s: Mpf, x: Mpf) -> Mpf:
    """``sum over integers j of g(|j + x|)``, ``0 <= x < 1``; terms decay like exp(-t^2/(4 s^2))."""
    reach = int(2 * s * mp.sqrt(mp.dps * mp.ln10)) + 2
    result = mp.mpf(0)
    for j in range(-reach, reach + 1):
        t = abs(j + x)
        result += 2 * s**2 * mp.exp(-(t**2) / (4 * s**2))
        result -= s * mp.sqrt(mp.pi) * t * mp.erfc(t / (2 * s))
    return result


@dataclass(frozen=True)
class Gaussian:
    """Periodised Gaussian centred in the cube, one width per coordinate.

    Parameters
    ----------
    sigmas : tuple of Fraction
        Widths, each 0 < sigma.
    """

    sigmas: tuple[Fraction, ...]

    def __post_init__(self) -> None:
        for sigma in self.sigmas:
            if not sigma > 0:
                raise InputError(f"gaussian: sigma must satisfy 0 < sigma: got {literal(sigma)}")

    @property
    def name(self) -> str:
        """``gaussian:sigma=s`` where all widths agree, else ``anisotropic-gaussian``."""
        if len(set(self.sigmas)) == 1:
            return f"gaussian:sigma={literal(self.sigmas[0])}"
        return f"anisotropic-gaussian:sigma={literal(self.sigmas)}"

    @property
    def dim(self) -> int:
        """Number of coordinates."""
        return len(self.sigmas)

    @property
    def factors(self) -> tuple[Factor, ...]:
        """One factor per coordinate."""
        return tuple(map(GaussianFactor, self.sigmas))

    def __call__(self, points: Floats) -> Floats:
        """Values at points of shape (..., dim), shape (...)."""
        result = np.ones(points.shape[:-1])
        for i, sigma in enumerate(self.sigmas):
            result *= _profile(points[..., i] - 0.5, float(sigma))
        return result

    def coefficient_power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` at integer frequencies of shape (..., dim), shape (...)."""
        return product_power(self.factors, m)

    def mean(self, digits: int) -> Mpf:
        """``prod_i sigma_i sqrt(2 pi)``."""
        return product_mean(self.factors, digits)

    def total(self, digits: int) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2``."""
        return product_total(self.factors, digits)


def _profile(x: Floats, sigma: float) -> Floats:
    """Periodised ``exp(-x^2/(2 sigma^2))`` for x in [-1/2, 1/2): translates, or waves if wide."""
    if sigma < 0.25:
        reach = floor(0.5 + _DOUBLE_WIDTHS * sigma)
        return sum(
            (np.exp(-0.5 * ((x + j) / sigma) ** 2) for j in range(-reach, reach + 1)),
            np.zeros_like(x),
        )
    reach = floor(_DOUBLE_WIDTHS / (2 * np.pi * sigma)) + 1
    result = np.ones_like(x)
    for m in range(1, reach + 1):
        result += 2 * np.exp(-2 * (np.pi * sigma * m) ** 2) * np.cos(2 * np.pi * m * x)
    return np.sqrt(2 * np.pi) * sigma * result
