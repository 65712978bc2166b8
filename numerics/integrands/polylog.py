r"""Polylogarithm f(x_1) = sum over m != 0 of |m|^(-p/2) exp(2 pi i m x_1): |fhat(m)|^2 = |m|^-p.

Any rational p > 1 tunes the decay continuously. Values and power sums are periodic zeta functions
``F_s(x) = sum over m >= 1 of cos(2 pi m x)/m^s = Re Li_s(exp(2 pi i x))``:

    f = 2 F_(p/2),      sum over m != 0 of |m|^-p sinc^2(m h) = (F_(p+2)(0) - F_(p+2)(h))/(pi h)^2,

and a comb n | m scales h by n and the sum by n^-p. F_s is expanded in y = 2 pi |x|, |x| <= 1/2
(Erdelyi et al. 1953, 1.11). With k0 the integer next to (s - 1)/2 and e = s - 1 - 2 k0,

    F_s = sum over k != k0 of (-1)^k zeta(s - 2k) y^(2k)/(2k)! + y^(2 k0) (a + b (y^e - 1)/e),
    b = e pi/(2 Gamma(s) cos(pi s/2)),      a = b/e + (-1)^k0 zeta(1 + e)/(2 k0)!,

the singular power y^(s-1) taken together with the power next to it, since their coefficients grow
as 1/e; for e = 0 (odd s) the last factor is log y, b = -(-1)^k0/(2 k0)! and a = -b H_(2 k0).
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import factorial, pi

import numpy as np

from ...theory.errors import InputError
from ..balls import Ball, certified, exact_ball, flint
from .literals import literal, positive
from .protocol import Count, Floats, Ints
from .separable import Separable

_NEAREST = 2.0**-54  # half the spacing of random doubles: a pole of f is not looked at closer


@dataclass(frozen=True)
class PolylogFactor:
    """``2 F_(p/2)(x)``.

    For p <= 2 it is infinite at x = 0. Closer than 2^-54, where no random double comes but 0, it
    has the value at that distance: drawn points then miss a share of the order 2^(-54 (p - 1)) of
    its variance.
    """

    p: Fraction

    def values(self, x: Floats) -> Floats:
        """f(x) for x in [0, 1)."""
        order = self.p / 2
        distance = np.minimum(x, 1.0 - x)
        if order > 1:
            peak = 2 * float(certified(lambda: exact_ball(order).zeta(), 17))
            safe = np.where(distance > 0, distance, 0.5)
            return np.where(distance > 0, 2 * _periodic_zeta_values(order, safe), peak)
        return 2 * _periodic_zeta_values(order, np.maximum(distance, _NEAREST))

    def power(self, m: Ints) -> Floats:
        """``|m|^-p`` in double precision, 0 at m = 0."""
        size = np.abs(np.asarray(m, np.float64))
        return np.where(size > 0, np.where(size > 0, size, 1.0) ** -float(self.p), 0.0)

    def mean(self) -> Ball:
        """Zero."""
        return flint.arb(0)

    def power_sum(self, comb: int = 1, count: Count | None = None) -> Ball:
        """``sum over m != 0, comb | m, of |m|^-p sinc^2(m/count)``, or without sinc^2."""
        scale = exact_ball(positive(comb)) ** -exact_ball(self.p)
        if count is None:
            return 2 * exact_ball(self.p).zeta() * scale
        step = Fraction(comb) / positive(count)
        phi = step % 1
        if phi == 0:
            return flint.arb(0)
        deficit = _deficit(self.p + 2, min(phi, 1 - phi))
        return scale * deficit / (flint.arb.pi() * exact_ball(step)) ** 2


@dataclass(frozen=True)
class _Expansion:
    """Coefficients of F_s: those of y^(2k), 0 at k0, then a and b of y^(2 k0), and e."""

    regular: tuple[Ball, ...]
    k0: int
    a: Ball
    b: Ball
    e: Fraction


@lru_cache(maxsize=256)
def _expansion(s: Fraction, terms: int, precision: int) -> _Expansion:
    del precision  # part of the key alone
    k0 = round((s - 1) / 2)
    e = s - 1 - 2 * k0
    sign = -1 if k0 % 2 else 1
    if e == 0:
        b = flint.arb(flint.fmpq(-sign, factorial(2 * k0)))
        a = -b * sum((flint.arb(flint.fmpq(1, i)) for i in range(1, 2 * k0 + 1)), flint.arb(0))
    else:
        order = exact_ball(s)
        cosine = flint.arb.cos_pi_fmpq(flint.fmpq(s.numerator, 2 * s.denominator))
        singular = flint.arb.pi() / (2 * order.gamma() * cosine)
        b = singular * exact_ball(e)
        a = singular + sign * exact_ball(1 + e).zeta() / factorial(2 * k0)
    regular = tuple(
        flint.arb(0) if k == k0 else (-1) ** k * exact_ball(s - 2 * k).zeta() / factorial(2 * k)
        for k in range(terms)
    )
    return _Expansion(regular, k0, a, b, e)


def _deficit(s: Fraction, x: Fraction) -> Ball:
    """``F_s(0) - F_s(x)``, s > 3, 0 < x <= 1/2: the expansion without its constant.

    By the functional equation the term k is at most
    ``2 (2 pi)^(s-1) Gamma(2k + 1 - s)/Gamma(2k + 1) zeta(2k + 1 - s) x^(2k)`` once 2k + 1 > s. For
    2k >= s + 1 that zeta is below 2, and the quotient of the Gammas falls with k: the terms from
    k = K on sum to less than the bound of the first over 1 - x^2.
    """
    terms = _count_of_terms(s, float(x))
    found = _expansion(s, terms, flint.ctx.prec)
    y = 2 * flint.arb.pi() * exact_ball(x)
    total = sum((c * y ** (2 * k) for k, c in enumerate(found.regular) if k), flint.arb(0))
    slope = (
        y.log() if found.e == 0 else (y.log() * exact_ball(found.e)).expm1() / exact_ball(found.e)
    )
    total += y ** (2 * found.k0) * (found.a + found.b * slope)
    order, first = exact_ball(s), 2 * terms
    gammas = (first + 1 - order).gamma() / flint.arb(first + 1).gamma()
    bound = 4 * (2 * flint.arb.pi()) ** (order - 1) * gammas * exact_ball(x) ** first
    rest = bound / (1 - exact_ball(x) ** 2)
    return -total + rest.union(-rest)


def _count_of_terms(s: Fraction, x: float) -> int:
    """K with 2K >= s + 1 and x^(2K) below the rounding."""
    bits = flint.ctx.prec + 10
    falling = -2 * np.log2(x) if x > 0 else 2000.0
    return int(max((s + 1) // 2 + 1, bits // falling + 1))


@lru_cache(maxsize=64)
def _float_expansion(s: Fraction) -> tuple[tuple[float, ...], int, float, float]:
    """The expansion for doubles: each coefficient certified before it is rounded."""
    terms = int(s) // 2 + 30  # (1/2)^(2 * 30) is below the rounding

    def at(pick: int) -> Ball:
        found = _expansion(s, terms, flint.ctx.prec)
        return (*found.regular, found.a, found.b)[pick]

    numbers = [float(certified(lambda i=i: at(i), 17)) for i in range(terms + 2)]
    k0 = round((s - 1) / 2)
    return tuple(numbers[:-2]), k0, numbers[-2], numbers[-1]


def _periodic_zeta_values(s: Fraction, x: Floats) -> Floats:
    """``F_s(x)`` in double precision, 0 < x <= 1/2."""
    regular, k0, a, b = _float_expansion(s)
    e, y = float(s - 1 - 2 * k0), 2 * pi * x
    total = np.zeros_like(y)
    for c in reversed(regular):
        total = total * y**2 + c
    log_y = np.log(y)
    return total + y ** (2 * k0) * (a + b * (log_y if e == 0 else np.expm1(e * log_y) / e))


def polylog(dim: int, p: Fraction) -> Separable:
    """``2 F_(p/2)(x_1)``, of mean 0: ``polylog:p=...``.

    Parameters
    ----------
    dim : int
        Number of coordinates.
    p : Fraction
        1 < p <= 100.

    Raises
    ------
    InputError
        If p is out of range.
    """
    if not 1 < p <= 100:
        raise InputError(f"polylog: p must satisfy 1 < p <= 100: got {literal(p)}")
    return Separable(f"polylog:p={literal(p)}", dim, (((1, PolylogFactor(p)),),))
