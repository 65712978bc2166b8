r"""Gaussian exp(-sum_i (x_i - 1/2)^2/(2 sigma_i^2)), summed over all integer translates.

``|fhat(m)|^2 = prod_i 2 pi sigma_i^2 exp(-4 pi^2 sigma_i^2 m_i^2)``: one factor per coordinate,
whose power sums are theta functions. A wide factor is summed over frequencies. A narrow one is
summed over translates (Poisson summation): its periodic autocovariance is
``sum_j sigma sqrt(pi) exp(-(t + j)^2/(4 sigma^2)) - 2 pi sigma^2``, and the factor sinc^2(m/r)
takes the second difference at distance phi = 1/r modulo 1 of its second antiderivative

    pi sigma^2 phi (1 - phi) + sigma sqrt(pi) sum_j g(|j + phi|) + constant,
    g(t) = 2 sigma^2 exp(-t^2/(4 sigma^2)) - sigma sqrt(pi) t erfc(t/(2 sigma)).

A comb n | m of the factor of width sigma is the factor of width n sigma, divided by n^2. Every sum
is cut where the rest is bounded, and the bound is part of the ball.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import floor, log, sqrt

import numpy as np

from ...theory.errors import InputError
from ..balls import Ball, exact_ball, flint, rational
from .literals import literal, positive
from .protocol import Count, Floats, Ints
from .separable import Separable

_WIDEST = 10**6
_NARROW = Fraction(1, 20)  # at or below: translates; neither side needs more than about 25 terms
_DOUBLE_WIDTHS = 9.0  # exp(-9^2/2) is below the rounding of a double


@dataclass(frozen=True)
class GaussianFactor:
    """Periodised ``exp(-(x - 1/2)^2/(2 sigma^2))``."""

    sigma: Fraction

    def values(self, x: Floats) -> Floats:
        """f(x) for x in [0, 1): over translates, or over waves if wide."""
        return _profile(x - 0.5, float(self.sigma))

    def power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2 = 2 pi sigma^2 exp(-4 pi^2 sigma^2 m^2)`` in double precision."""
        variance = float(self.sigma) ** 2
        return 2 * np.pi * variance * np.exp(-4 * np.pi**2 * variance * np.asarray(m, float) ** 2)

    def mean(self) -> Ball:
        """``sigma sqrt(2 pi)``."""
        return exact_ball(self.sigma) * (2 * flint.arb.pi()).sqrt()

    def power_sum(self, comb: int = 1, count: Count | None = None) -> Ball:
        """``sum over m != 0, comb | m, of |fhat(m)|^2 sinc^2(m/count)``, or without sinc^2."""
        sigma, precision = self.sigma * positive(comb), flint.ctx.prec
        if count is None:
            return _total(sigma, precision) / comb**2
        return _smoothed(sigma, Fraction(comb) / positive(count), precision) / comb**2


def _theta(c: Ball) -> Ball:
    """``sum over m >= 1 of exp(-c m^2)``, c at least 0.09.

    Beyond M the rest is below ``q^((M+1)^2)/(1 - q)``, q = exp(-c), as (M+1+j)^2 >= (M+1)^2 + j.
    """
    q = (-c).exp()
    square = q * q
    term, ratio, total = q, square * q, flint.arb(0)
    for _ in range(_reach(float(c))):
        total += term
        term, ratio = term * ratio, ratio * square
    return total + (term / (1 - q)).union(flint.arb(0))


def _reach(c: float) -> int:
    """M with exp(-c ((M + 1)^2 - 1)) below the rounding; how far matters, not exactly where."""
    return max(1, floor(sqrt(1 + (flint.ctx.prec + 10) * log(2) / c)))


@lru_cache(maxsize=512)
def _total(sigma: Fraction, precision: int) -> Ball:
    """``sum over m != 0 of 2 pi sigma^2 exp(-4 pi^2 sigma^2 m^2)``, at the precision in force."""
    del precision  # part of the key alone
    return _total_images(sigma) if sigma <= _NARROW else _total_waves(sigma)


def _total_waves(sigma: Fraction) -> Ball:
    s, pi = exact_ball(sigma), flint.arb.pi()
    return 4 * pi * s**2 * _theta((2 * pi * s) ** 2)


def _total_images(sigma: Fraction) -> Ball:
    s, pi = exact_ball(sigma), flint.arb.pi()
    return s * pi.sqrt() * (1 + 2 * _theta(1 / (4 * s**2))) - 2 * pi * s**2


@lru_cache(maxsize=512)
def _smoothed(sigma: Fraction, step: Fraction, precision: int) -> Ball:
    """``sum over m != 0 of 2 pi sigma^2 exp(-4 pi^2 sigma^2 m^2) sinc^2(m step)``."""
    del precision
    if step.denominator == 1:
        return flint.arb(0)
    return _smoothed_images(sigma, step) if sigma <= _NARROW else _smoothed_waves(sigma, step)


def _smoothed_waves(sigma: Fraction, step: Fraction) -> Ball:
    """Over frequencies; the rest is that of the theta function, sinc^2 <= 1 or 1/(pi step)^2."""
    s, pi, turn = exact_ball(sigma), flint.arb.pi(), rational(step)
    c, scale = (2 * pi * s) ** 2, (pi * exact_ball(step)) ** 2
    q = (-c).exp()
    square = q * q
    term, ratio, total = q, square * q, flint.arb(0)
    for m in range(1, _reach(float(c)) + 1):
        sine = flint.arb.sin_pi_fmpq(m * turn) / m
        total += term * sine * sine
        term, ratio = term * ratio, ratio * square
    rest = term / (1 - q) * scale.min(flint.arb(1))
    return 4 * pi * s**2 * (total + rest.union(flint.arb(0))) / scale


def _smoothed_images(sigma: Fraction, step: Fraction) -> Ball:
    """Over translates: the second difference of the second antiderivative."""
    s, x, pi = exact_ball(sigma), exact_ball(step % 1), flint.arb.pi()
    rise = _images(s, x) - _images(s, flint.arb(0))
    return (2 * pi * s**2 * x * (1 - x) + 2 * s * pi.sqrt() * rise) / exact_ball(step) ** 2


def _images(s: Ball, x: Ball) -> Ball:
    """``sum over integers j of g(|j + x|)``, ``0 <= x < 1``.

    ``g(t) = int_t^oo (v - t) exp(-v^2/(4 s^2)) dv`` lies between 0 and ``2 s^2 exp(-t^2/(4 s^2))``,
    and the images left out are at least M, M + 1, ... away, on either side.
    """
    c, root = 1 / (4 * s**2), s * flint.arb.pi().sqrt()
    reach = _reach(float(c))
    total = flint.arb(0)
    for t in [t for j in range(reach) for t in (j + x, j + 1 - x)]:
        total += 2 * s**2 * (-c * t**2).exp() - root * t * (t / (2 * s)).erfc()
    rest = 4 * s**2 * (-c * reach**2).exp() / (1 - (-c).exp())
    return total + rest.union(flint.arb(0))


def gaussian(sigmas: tuple[Fraction, ...]) -> Separable:
    """Periodised Gaussian centred in the cube, one width per coordinate.

    Parameters
    ----------
    sigmas : tuple of Fraction
        Widths, each 0 < sigma <= 1e6: ``gaussian:sigma=s`` where all agree, else
        ``anisotropic-gaussian``.

    Raises
    ------
    InputError
        If a width is out of range: beyond it decimals need exponents that nothing else reads.
    """
    for sigma in sigmas:
        if not 0 < sigma <= _WIDEST:
            rule = f"gaussian: sigma must satisfy 0 < sigma <= {_WIDEST}"
            raise InputError(f"{rule}: got {literal(sigma)}")
    same = len(set(sigmas)) == 1
    name = f"gaussian:sigma={literal(sigmas[0])}"
    if not same:
        name = f"anisotropic-gaussian:sigma={literal(sigmas)}"
    part = tuple((i, GaussianFactor(s)) for i, s in enumerate(sigmas, 1))
    return Separable(name, len(sigmas), (part,))


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
