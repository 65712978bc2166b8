"""Jitter on a disk as an estimate: one integral over the distance of two points in one cell.

Two independent uniform points in the unit square have the distance density

    g(l) = 2l (π − 4l + l²),                                   0 < l <= 1,
    g(l) = 2l (4 asin(1/l) − π − 2 − l² + 4 sqrt(l² − 1)),     1 < l <= √2,

(line picking in a square), and the disk of radius R has the covariogram C with

    C(0) − C(2Rz) = 2R² (asin z + z sqrt(1 − z²)),   z <= 1,   and C(0) = πR² beyond.

With n × n cells whose differences do not reach round the torus, 2R + 1/n <= 1,

    N·Var = ∫ g(l) (C(0) − C(l/n)) dl,        N = n².

All is positive and nothing cancels. ``by_scipy`` and ``by_mpmath`` put it into their quadratures,
with breaks at l = 1 and where C ends; their errors are estimates.
"""

import math
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from typing import Any

from ...theory.errors import InputError
from ..equation17.radial_estimates import FINEST, Estimate
from ..integrands.protocol import Mpf, mp

_ROUNDING = 16 * 2.0**-52
_GUARD = 10  # decimal digits with which mpmath.quad works beyond those asked for


def by_scipy(cells: int, radius: Fraction, tolerance: float = FINEST) -> Estimate:
    """Variance of jitter with cells × cells strata on a disk, by ``scipy.integrate.quad``.

    Parameters
    ----------
    cells : int
        n >= 2 along each axis, N = n².
    radius : Fraction
        R with 2R + 1/n <= 1.
    tolerance : float
        Relative error asked of each piece, 2e-14 or more: scipy takes no less.

    Raises
    ------
    InputError
        If a parameter is out of range.
    """
    from scipy import integrate as _integrate  # pyright: ignore[reportMissingTypeStubs]

    integrate: Any = _integrate
    _check(cells, radius)
    if not FINEST <= tolerance < 1:
        raise InputError(f"a tolerance must satisfy {FINEST} <= tolerance < 1: got {tolerance}")
    reach = float(2 * radius * cells)
    density, breaks = _integrand(math, reach), _breaks(reach, math.sqrt(2))
    value = error = 0.0
    for low, high in pairwise(breaks):
        # With full_output it reports what it could not reach in its error, not as a warning.
        part, part_error = integrate.quad(
            density, low, high, full_output=True, epsabs=0, epsrel=tolerance, limit=200
        )[:2]
        value, error = value + part, error + part_error
    return _scaled(mp.mpf(value), mp.mpf(error + _ROUNDING * value), cells, radius)


def by_mpmath(cells: int, radius: Fraction, digits: int = 15) -> Estimate:
    """The same by ``mpmath.quad``.

    Parameters
    ----------
    digits : int
        1 or more; ten more are carried.

    Raises
    ------
    InputError
        If a parameter is out of range.
    """
    _check(cells, radius)
    with mp.workdps(digits + _GUARD):
        reach = 2 * mp.mpf(radius.numerator) / radius.denominator * cells
        density, breaks = _integrand(mp, reach), _breaks(reach, mp.sqrt(2))
        unit = density(min(reach, mp.mpf(1)) / 2)  # mpmath.quad stops at an absolute error
        value, error = mp.quad(lambda x: density(x) / unit, breaks, error=True)  # pyright: ignore[reportUnknownLambdaType]
        return _scaled(unit * value, unit * (error + 100 * mp.eps * value), cells, radius)


def _check(cells: int, radius: Fraction) -> None:
    if not 0 < 2 * radius <= 1 - Fraction(1, cells):
        raise InputError(f"radius and cells must satisfy 2R + 1/n <= 1: got {radius} and {cells}")


def _breaks(reach: Any, end: Any) -> list[Any]:
    return [0, *sorted(x for x in {reach, 1} if x < end), end]


def _integrand(functions: Any, reach: Any) -> Callable[[Any], Any]:
    """g(l) (asin z + z sqrt(1 − z²)) with z = l/reach, reach = 2Rn."""
    asin, sqrt, pi = functions.asin, functions.sqrt, functions.pi

    def density(x: Any) -> Any:
        z = x / reach
        deficit = asin(z) + z * sqrt((1 - z) * (1 + z)) if z < 1 else pi / 2
        if x <= 1:
            return 2 * x * (pi - 4 * x + x**2) * deficit
        return 2 * x * (4 * asin(1 / x) - pi - 2 - x**2 + 4 * sqrt((x - 1) * (x + 1))) * deficit

    return density


def _scaled(integral: Mpf, error: Mpf, cells: int, radius: Fraction) -> Estimate:
    """Var = 2R²/n² times the integral."""
    factor = mp.mpf(2 * radius.numerator**2) / (radius.denominator**2 * cells**2)
    return Estimate(factor * integral, factor * error + 4 * mp.eps * factor * integral)
