"""Shapes of spectra on arrays of frequencies: g(m/n) and its deficit 1 − g(m/n), side by side.

At a whole frequency m with t = πm/n and r the residue of m of least size modulo n, sin t is up to
its sign sin(πr/n), so that sines keep their digits at any frequency:

    sinc²(m/n) = (sin t/t)²,
    3 sinc³ sinc(3 ·) − 2 sinc² sinc(4 ·) = sin²t (2 sin t sin 3t/t − sin 4t)/(2t³)

at m/n. The deficit is the difference where it does not cancel. Where t is small it is the series of
``theory/shapes.py`` at 0 in powers of t²; that of exp(−|x|^β) is −expm1(−|x|^β), and that of the
tent |m|/n itself. Both numbers then have a relative error of a few units in the last place (the
third shape, which has zeros, an absolute one).
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from math import pi

import numpy as np
from numpy.typing import NDArray

from ...theory.shapes import Shape, series
from ..integrands.protocol import Floats, Ints

_LARGEST_INT64 = (1 << 63) - 1

# Terms of a series in t², t < 1: those left out are below 3e-19 of the sum.
_TERMS = {"sinc2": 11, "difference": 21}


def shape_arrays(shape: Shape, m: Ints, n: int) -> tuple[Floats, Floats]:
    """g(m/n) and 1 − g(m/n).

    Parameters
    ----------
    m : array of shape (k,)
        Whole frequencies from 1 to 2^62.
    n : int
        The count, from 1 to 10^307.

    Returns
    -------
    two arrays of shape (k,)
    """
    match shape.kind:
        case "sinc2":
            return _sinc2(shape, m, n)
        case "tent":
            return _tent(m, n)
        case "stretched":
            assert shape.beta is not None
            return _stretched(shape.beta, m, n)
        case "difference":
            return _difference(shape, m, n)


def _sinc2(shape: Shape, m: Ints, n: int) -> tuple[Floats, Floats]:
    step = pi / n
    t = m.astype(np.float64) * step
    sinc2 = (np.sin(_residue(m, n) * step) / t) ** 2
    deficit = 1 - sinc2
    _put_low_deficit(deficit, shape, t)
    return sinc2, deficit


def _tent(m: Ints, n: int) -> tuple[Floats, Floats]:
    if n > _LARGEST_INT64:
        deficit = m / float(n)
        return 1 - deficit, deficit
    inside = np.minimum(m, n)
    return (n - inside) / float(n), inside / float(n)


def _stretched(beta: Fraction, m: Ints, n: int) -> tuple[Floats, Floats]:
    x, power = m / float(n), float(beta)
    # x^β with the β that is meant and not its double: |ln x| may be several hundred.
    size = x**power * (1 + float(beta - Fraction(power)) * np.log(x))
    return np.exp(-size), -np.expm1(-size)


def _difference(shape: Shape, m: Ints, n: int) -> tuple[Floats, Floats]:
    step = pi / n
    # The signs of the residue and of odd periods cancel: sin u sin 3u, sin²u sin 4u have period π.
    t, u = np.maximum(m.astype(np.float64) * step, 1), _residue(m, n) * step
    sine = np.sin(u)
    value = sine * sine * (2 * sine * np.sin(3 * u) / t - np.sin(4 * u)) / (2 * t**3)
    deficit = 1 - value
    low = _put_low_deficit(deficit, shape, m.astype(np.float64) * step)
    value[low] = 1 - deficit[low]
    return value, deficit


def _residue(m: Ints, n: int) -> Ints:
    """The residue of least size modulo n.

    m + n//2 stays below 2^63: where n is not below 2 · largest <= 2^63, m is its own residue.
    """
    return m - (m + n // 2) // n * n if n < 2 * int(m.max(initial=1)) else m


def _put_low_deficit(deficit: Floats, shape: Shape, t: Floats) -> NDArray[np.intp]:
    """Where t < 1, the deficit by its series in t²; the places."""
    low = np.flatnonzero(t < 1)
    first, coefficients = _deficit_series(shape)
    square = t[low] * t[low]
    value = np.full(len(low), coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        value *= square
        value += coefficient
    for _ in range(first):
        value *= square
    deficit[low] = value
    return low


@cache
def _deficit_series(shape: Shape) -> tuple[int, Sequence[float]]:
    """The first power of t² in 1 − g, and the coefficients from there on."""
    terms = {t.half_pi: -float(t.rational) for t in series(shape, Fraction(2 * _TERMS[shape.kind]))}
    first = min(k for k in terms if k)
    return first, [terms.get(k, 0.0) for k in range(first, _TERMS[shape.kind] + 1)]
