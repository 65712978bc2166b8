"""Shapes of spectra as numbers: at real arguments in mpmath, at whole frequencies as balls.

sinc²(x), (1 − |x|)^+, exp(−|x|^β) and 3 sinc³(x) sinc(3x) − 2 sinc²(x) sinc(4x), sinc(x) =
sin(πx)/(πx), term by term as they are written: what cancels is paid for in precision.
"""

from ...theory.shapes import Shape
from ..balls import Ball, exact_ball, flint
from ..integrands.protocol import Mpf, mp


def shape_value(shape: Shape, x: Mpf) -> Mpf:
    """g(x) at the working precision of mpmath."""
    size = abs(x)
    match shape.kind:
        case "sinc2":
            return mp.sincpi(x) ** 2
        case "tent":
            return max(mp.mpf(0), 1 - size)
        case "stretched":
            assert shape.beta is not None
            return mp.exp(-mp.power(size, mp.mpf(shape.beta.numerator) / shape.beta.denominator))
        case "difference":
            sinc = mp.sincpi(x)
            return 3 * sinc**3 * mp.sincpi(3 * x) - 2 * sinc**2 * mp.sincpi(4 * x)


def shape_ball(shape: Shape, m: int, n: int) -> Ball:
    """g(m/n) at a whole frequency m ≠ 0 and count n, at the precision in force.

    Notes
    -----
    Sines only depend on m modulo 2n: they keep their digits at any frequency.
    """
    match shape.kind:
        case "sinc2":
            sinc = _sinc(m, n)
            return sinc * sinc
        case "tent":
            return flint.arb(flint.fmpq(max(n - abs(m), 0), n))
        case "stretched":
            assert shape.beta is not None
            return (-(flint.arb(flint.fmpq(abs(m), n)) ** exact_ball(shape.beta))).exp()
        case "difference":
            sinc = _sinc(m, n)
            square = sinc * sinc
            return 3 * square * sinc * _sinc(3 * m, n) - 2 * square * _sinc(4 * m, n)


def _sinc(m: int, n: int) -> Ball:
    """sinc(m/n)."""
    sine = flint.arb.sin_pi_fmpq(flint.fmpq(m % (2 * n), n))
    return sine * n / (flint.arb.pi() * m)
