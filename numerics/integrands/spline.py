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
from math import comb, factorial, lcm

import numpy as np

from .literals import exact
from .protocol import Count, Floats, Ints, Mpf, to_mpf

_INT64_SAFE = 2**31  # numerators and denominators below this multiply within int64


@lru_cache(maxsize=64)
def bernoulli_polynomial(k: int) -> tuple[Fraction, ...]:
    """Coefficients of ``B_k``, constant first, from ``B_k' = k B_(k-1)`` and zero mean."""
    if k == 0:
        return (Fraction(1),)
    rest = [k * c / (i + 1) for i, c in enumerate(bernoulli_polynomial(k - 1))]
    return (-sum((c / (i + 2) for i, c in enumerate(rest)), Fraction(0)), *rest)


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
    powers = bernoulli_polynomial(k)
    half = Fraction(1, 2)
    return tuple(
        float(sum(powers[j] * comb(j, i) * half ** (j - i) for j in range(i, k + 1)))
        for i in range(k + 1)
    )


def cosine_sum(k: int, h: Fraction) -> Fraction:
    """``K_k(h) = sum over j != 0 of cos(2 pi j h)/(2 pi j)^(2k)``, exactly."""
    p, q = (h % 1).as_integer_ratio()
    coefficients = bernoulli_polynomial(2 * k)
    scale = lcm(*(c.denominator for c in coefficients))
    value, power = 0, 1
    for c in reversed(coefficients):  # in integers: a Fraction would cancel at every step
        value = value * p + int(c * scale) * power
        power *= q
    return (-1) ** (k - 1) * Fraction(value * q, power * scale * factorial(2 * k))


@dataclass(frozen=True)
class SplineFactor:
    """``f(x) = constant + sum of c B_order({x - s}) over the pairs (c, s) in knots``."""

    constant: Fraction
    order: int
    knots: tuple[tuple[Fraction, Fraction], ...]

    def power(self, m: Ints) -> Floats:
        """``|fhat(m)|^2`` in double precision, m = 0 included."""
        zero = m == 0
        wave = np.zeros(m.shape, dtype=np.complex128)
        for c, s in self.knots:
            wave += float(c) * np.exp(-2j * np.pi * _phase(m, s))
        decay = (2 * np.pi * np.where(zero, 1, np.abs(m))) ** self.order / factorial(self.order)
        return np.where(zero, float(self.constant**2), (np.abs(wave) / decay) ** 2)

    def mean(self) -> Mpf:
        """``fhat(0)``."""
        return to_mpf(self.constant)

    def total(self) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2``."""
        return to_mpf(self._sum(1, None))

    def sinc2_sum(self, n: Count) -> Mpf:
        """``sum over m != 0 of |fhat(m)|^2 sinc^2(m/n)``."""
        return to_mpf(self._sum(1, exact(n)))

    def comb_sum(self, n: int) -> Mpf:
        """``sum over m != 0, n | m, of |fhat(m)|^2``."""
        return to_mpf(self._sum(n, None))

    def comb_sinc2_sum(self, n: int, n2: Count) -> Mpf:
        """``sum over m != 0, n | m, of |fhat(m)|^2 sinc^2(m/n2)``."""
        return to_mpf(self._sum(n, exact(n2) / n))

    def _sum(self, n: int, r: Fraction | None) -> Fraction:
        """Sum over j != 0 of ``|fhat(n j)|^2 sinc^2(j/r)``, without sinc^2 where r is None."""
        exact(n)
        k = self.order
        result = Fraction(0)
        for c, s in self.knots:
            for d, t in self.knots:
                h = n * (s - t)
                if r is None:
                    result += c * d * cosine_sum(k, h)
                else:
                    pair = cosine_sum(k + 1, h + 1 / r) + cosine_sum(k + 1, h - 1 / r)
                    result += c * d * r**2 * (2 * cosine_sum(k + 1, h) - pair)
        return result * factorial(k) ** 2 / Fraction(n) ** (2 * k)


def _phase(m: Ints, s: Fraction) -> Floats:
    """``m s`` modulo 1, exact before the last rounding where the parts of s are small."""
    if abs(s.numerator) < _INT64_SAFE and s.denominator < _INT64_SAFE:
        return (m % s.denominator * s.numerator % s.denominator) / s.denominator
    return np.asarray(m, np.float64) * float(s) % 1.0
