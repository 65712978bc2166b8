r"""Periodic splines: f(x) = mean + sum_s c_s B_k({x - s}), with exact power sums.

For m != 0, ``fhat(m) = -k!/(2 pi i m)^k sum_s c_s exp(-2 pi i m s)``, so that
``|fhat(m)|^2 = k!^2/(2 pi m)^(2k) sum_(s,t) c_s c_t cos(2 pi m (s - t))``, and every sum reduces to

    K_k(h) = sum over j != 0 of cos(2 pi j h)/(2 pi j)^(2k) = (-1)^(k-1) B_2k({h})/(2k)!.

A comb n | m puts m = n j: it scales h by n and the sum by n^(-2k). The factor
``sinc^2(j/r) = 2 r^2 (1 - cos(2 pi j/r))/(2 pi j)^2`` turns K_k(h) into the second difference
``r^2 (2 K_(k+1)(h) - K_(k+1)(h + 1/r) - K_(k+1)(h - 1/r))``. The differences cancel to order r^-2
and worse, so they are taken in rationals: only the result is rounded, at any n.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import comb as binomial
from math import factorial

import numpy as np

from ..balls import Ball, exact_ball, flint, rational
from .literals import positive
from .protocol import Count, Floats, Ints

_INT64_SAFE = 2**31  # numerators and denominators below this multiply within int64


@lru_cache(maxsize=64)
def _bernoulli_polynomial(k: int) -> Ball:
    return flint.fmpq_poly.bernoulli_poly(k)


def bernoulli_values(k: int, x: Floats) -> Floats:
    """``B_k(x)`` in double precision for x in [0, 1), by Horner's rule around x = 1/2.

    ``B_k(y + 1/2)`` is even or odd in y and has smaller coefficients than ``B_k(x)``.
    """
    y = x - 0.5
    result = np.zeros_like(y)
    for coefficient in reversed(_centred_coefficients(k)):
        result = result * y + coefficient
    return result


@lru_cache(maxsize=64)
def _centred_coefficients(k: int) -> tuple[float, ...]:
    powers = [Fraction(int(c.p), int(c.q)) for c in _bernoulli_polynomial(k).coeffs()]
    half = Fraction(1, 2)
    return tuple(
        float(sum(powers[j] * binomial(j, i) * half ** (j - i) for j in range(i, k + 1)))
        for i in range(k + 1)
    )


def cosine_sum(k: int, h: Ball) -> Ball:
    """``K_k(h) = sum over j != 0 of cos(2 pi j h)/(2 pi j)^(2k)``, an exact ``flint.fmpq``.

    Parameters
    ----------
    k : int
        At least 1.
    h : flint.fmpq
    """
    value = _bernoulli_polynomial(2 * k)(h - h.floor()) / factorial(2 * k)
    return value if k % 2 else -value


@dataclass(frozen=True)
class SplineFactor:
    """``f(x) = constant + sum of c B_order({x - s}) over the pairs (c, s) in knots``."""

    constant: Fraction
    order: int
    knots: tuple[tuple[Fraction, Fraction], ...]

    def values(self, x: Floats) -> Floats:
        """f(x) for x in [0, 1); a step function takes its exact values."""
        if self.order == 1:  # B_1({x - s}) = x - s - 1/2 + [x < s], 0 <= s < 1
            result = float(sum(c for c, _ in self.knots)) * x
            result += float(self.constant - sum(c * (s + Fraction(1, 2)) for c, s in self.knots))
            for c, s in self.knots:
                result += float(c) * (x < float(s))
            return result
        result = np.full(x.shape, float(self.constant))
        for c, s in self.knots:
            result += float(c) * bernoulli_values(self.order, (x - float(s)) % 1.0)
        return result

    def power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` in double precision, m = 0 included."""
        zero = m == 0
        wave = np.zeros(m.shape, dtype=np.complex128)
        for c, s in self.knots:
            wave += float(c) * np.exp(-2j * np.pi * _phase(m, s))
        decay = (2 * np.pi * np.where(zero, 1, np.abs(m))) ** self.order / factorial(self.order)
        return np.where(zero, float(self.constant**2), (np.abs(wave) / decay) ** 2)

    def mean(self) -> Ball:
        """``fhat(0)``."""
        return exact_ball(self.constant)

    def power_sum(self, comb: int = 1, count: Count | None = None) -> Ball:
        """``sum over m != 0, comb | m, of |fhat(m)|^2 sinc^2(m/count)``, or without sinc^2.

        The rational sum rounded to a ball, so that a sum that vanishes is exactly zero.
        """
        return flint.arb(_exact_sum(self, comb, count))


@lru_cache(maxsize=512)
def _exact_sum(f: SplineFactor, comb: int, count: Count | None) -> Ball:
    """The power sum as ``flint.fmpq``, independent of the precision in force."""
    k = f.order
    step = None if count is None else rational(Fraction(positive(comb)) / positive(count))
    result = flint.fmpq(0)
    for c, s in f.knots:
        for d, t in f.knots:
            h = rational(positive(comb) * (s - t))
            if step is None:
                result += rational(c * d) * cosine_sum(k, h)
            else:
                pair = cosine_sum(k + 1, h + step) + cosine_sum(k + 1, h - step)
                result += rational(c * d) * (2 * cosine_sum(k + 1, h) - pair) / step**2
    return result * factorial(k) ** 2 / flint.fmpq(comb) ** (2 * k)


def _phase(m: Ints, s: Fraction) -> Floats:
    """``m s`` modulo 1, exact before the last rounding where the parts of s are small."""
    if abs(s.numerator) < _INT64_SAFE and s.denominator < _INT64_SAFE:
        return (m % s.denominator * s.numerator % s.denominator) / s.denominator
    return np.asarray(m, np.float64) * float(s) % 1.0
