"""Eq. 17 along one region as an estimate, by three cheap routes that certify nothing.

In t = log ρ the integrand ρ^s P_S P_f is e^(E(t)) with E linear between the breaks −∞, log ρ0,
log ν, ∞. Each piece is e^top ∫_0^λ e^(−kx) dx, x the distance from its larger end, top the value
of E there, k >= 0 its slope and λ its length: all pieces are positive and nothing cancels.

- ``by_doubles``: ∫ = λ φ(−kλ), φ(y) = (e^y − 1)/y, and a log-sum-exp, in double precision.
- ``by_scipy``: ``scipy.integrate.quad`` of each piece, cut where the rest is below its error.
- ``by_mpmath``: ``mpmath.quad`` of the two spectra themselves, E taken from them point by point.

The logarithm of N is the input, so that N = 1e5000 is no special case; nor is b next to q, where
φ is 1. Every error is an estimate, made to be honest: what the quadrature says of itself, the size
of what was cut off, and a running analysis of the rounding.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import ceil, exp, expm1, inf, log, log10
from typing import Any

from ...theory.errors import InputError
from ..integrands.protocol import Mpf, mp
from .radial_integrals import RadialProblem

_UNIT = 2.0**-52  # elementary functions of doubles err by up to one unit in the last place
FINEST = 2e-14
"""Smallest relative error that may be asked of scipy.integrate.quad."""
_CUT = 40.0  # e^-40 is below the rounding of a double
_GUARD = 10  # decimal digits with which mpmath.quad works beyond those asked for


@dataclass(frozen=True)
class Estimate:
    """A value and an estimate, not a bound, of its absolute error."""

    value: Mpf
    error: Mpf


@dataclass(frozen=True)
class _Log:
    """A logarithm in double precision, and the size of the numbers that were rounded in it."""

    value: float
    size: float


@dataclass(frozen=True)
class _Scales:
    """log ρ0, log(ν/ρ0), log(γ/N), and the rounding of the second."""

    rho0: _Log
    gap: float
    gap_error: float
    factor: _Log


@dataclass(frozen=True)
class _Piece:
    """top and its rounding error, slope k >= 0, length λ <= ∞."""

    top: float
    top_error: float
    slope: float
    length: float


@dataclass(frozen=True)
class _Integral:
    """∫_0^λ e^(−kx) dx of a piece, and an estimate of its error."""

    piece: _Piece
    value: float
    error: float


def by_doubles(problem: RadialProblem) -> Estimate:
    """Eq. 17 in double precision, stable for every problem; some 20 microseconds.

    Returns
    -------
    Estimate
        With an error of a few units in the last place of the largest logarithm that occurs.

    Raises
    ------
    InputError
        If a parameter is beyond the range of a double.
    """
    scales = _scales(problem)
    values = [(p, _exponential_integral(p)) for p in _pieces(problem, scales)]
    return _together(scales, [_Integral(p, v, 8 * _UNIT * v) for p, v in values])


def _exponential_integral(piece: _Piece) -> float:
    steep = piece.slope * piece.length
    if steep > _CUT:
        return 1 / piece.slope
    return piece.length * (-expm1(-steep) / steep if steep > 0 else 1.0)


def by_scipy(problem: RadialProblem, tolerance: float = FINEST) -> Estimate:
    """Eq. 17 by ``scipy.integrate.quad`` in log ρ, with breaks at ρ0 and ν.

    Parameters
    ----------
    tolerance : float
        Relative error asked of each piece, 2e-14 or more: scipy takes no less.

    Raises
    ------
    InputError
        If a parameter is beyond the range of a double, or the tolerance out of range.
    """
    from scipy import integrate as _integrate  # pyright: ignore[reportMissingTypeStubs]

    integrate: Any = _integrate

    if not FINEST <= tolerance < 1:
        raise InputError(f"a tolerance must satisfy {FINEST} <= tolerance < 1: got {tolerance}")
    scales = _scales(problem)
    integrals: list[_Integral] = []
    for p in _pieces(problem, scales):
        length = min(p.length, _CUT / p.slope) if p.slope > 0 else p.length
        steep = p.slope * length
        # With full_output it reports what it could not reach in its error, not as a warning.
        head, error = integrate.quad(_decay, 0, 1, (steep,), True, epsabs=0, epsrel=tolerance)[:2]
        rest = exp(-steep) / p.slope if length < p.length else 0.0
        rounding = 8 * _UNIT * length * head
        integrals.append(_Integral(p, length * head, length * error + rest + rounding))
    return _together(scales, integrals)


def _decay(x: float, steep: float) -> float:
    return exp(-steep * x)


def _scales(problem: RadialProblem) -> _Scales:
    n, rho0, alpha, gamma = (
        _log_count(problem),
        *map(_log, (problem.rho0, problem.alpha, problem.gamma)),
    )
    e = _double(problem.effective)
    gap = alpha.value + e * n.value - rho0.value
    error = 4 * _UNIT * (alpha.size + e * n.size + rho0.size)
    return _Scales(rho0, gap, error, _Log(gamma.value - n.value, gamma.size + n.size))


def _log_count(problem: RadialProblem) -> _Log:
    if problem.count is not None:
        return _log(problem.count)
    assert problem.log10_n is not None
    value = _double(problem.log10_n) * log(10)
    return _Log(value, abs(value))


def _log(number: Fraction) -> _Log:
    over, under = log(number.numerator), log(number.denominator)
    return _Log(over - under, over + under)


def _double(number: Fraction) -> float:
    try:
        return float(number)
    except OverflowError:
        raise InputError(
            "a parameter must be below 1.8e308 for double precision: got more"
        ) from None


def _pieces(problem: RadialProblem, scales: _Scales) -> list[_Piece]:
    """The pieces below, between and above the breaks, with c = 1."""
    s, gap = Fraction(problem.dimension), scales.gap
    b, p = problem.degree, problem.decay
    if p is None:
        if gap >= 0:
            return [_piece(scales, s, -b, s + b, inf)]
        return [_piece(scales, s, s, s + b, inf), _piece(scales, s, s * 0, s, -gap)]
    q, beyond = p - s, s if problem.continuous else s - p  # c2 = ρ0^p or 1
    if gap >= 0:
        return [
            _piece(scales, s, -b, s + b, inf),
            _piece(scales, beyond, -min(b, q), b - q, gap),
            _piece(scales, beyond, -q, q, inf),
        ]
    return [
        _piece(scales, s, s, s + b, inf),
        _piece(scales, s, s * 0, s, -gap),
        _piece(scales, beyond, s * 0, q, inf),
    ]


def _piece(
    scales: _Scales, of_rho0: Fraction, of_gap: Fraction, slope: Fraction, length: float
) -> _Piece:
    """The piece whose top is of_rho0 log ρ0 + of_gap log(ν/ρ0)."""
    first, second = _double(of_rho0) * scales.rho0.value, _double(of_gap) * scales.gap
    size = abs(_double(of_rho0)) * scales.rho0.size + abs(second)
    error = abs(_double(of_gap)) * scales.gap_error + 4 * _UNIT * size
    return _Piece(first + second, error, abs(_double(slope)), length)


def _together(scales: _Scales, integrals: list[_Integral]) -> Estimate:
    """γ/N Σ e^top ∫ as a log-sum-exp."""
    largest = max(i.piece.top for i in integrals)
    total = spread = 0.0
    for i in integrals:
        weight = exp(i.piece.top - largest)
        rounding = i.value * (i.piece.top_error + 4 * _UNIT * (1 + abs(i.piece.top - largest)))
        moved_end = scales.gap_error if i.piece.length < inf else 0.0  # λ is rounded, e^(−kx) <= 1
        total += weight * i.value
        spread += weight * (i.error + rounding + moved_end)
    size = abs(largest) + abs(log(total)) + scales.factor.size
    relative = spread / total + 8 * _UNIT * (1 + size)
    with mp.workdps(30):
        value = mp.exp(mp.mpf(largest) + mp.mpf(log(total)) + mp.mpf(scales.factor.value))
        return Estimate(value, value * mp.expm1(mp.mpf(relative)))


def by_mpmath(problem: RadialProblem, digits: int = 15) -> Estimate:
    """Eq. 17 by ``mpmath.quad`` of its two spectra in log ρ, with breaks at ρ0 and ν.

    Parameters
    ----------
    digits : int
        1 or more; ten more are carried.
    """
    condition = _condition(problem, digits)
    guard = _GUARD + ceil(log10(condition))
    with mp.workdps(digits + guard):
        spectra = _spectra(problem)
        value = error = mp.mpf(0)
        for low, high in pairwise([None, *sorted({spectra.log_rho0, spectra.log_nu}), None]):
            part, part_error = _quadrature(spectra, low, high)
            value, error = value + part, error + part_error
        error += value * condition * mp.eps
        scale = mp.exp(_log_mpf(problem.gamma) - spectra.log_n)
        return Estimate(+(scale * value), +(scale * error))


@dataclass(frozen=True)
class _Spectra:
    """N·P_S/γ and P_f with c = 1: the powers b, s, p (None: no power beyond ρ0), and the scales."""

    degree: Mpf
    dimension: int
    decay: Mpf | None
    log_n: Mpf
    log_nu: Mpf
    log_rho0: Mpf
    log_c2: Mpf

    def exponent(self, t: Mpf) -> Mpf:
        """log(ρ^s P_S P_f) at t = log ρ; −∞ where there is no power."""
        value = self.dimension * t
        if t < self.log_nu:
            value += self.degree * (t - self.log_nu)
        if t < self.log_rho0:
            return value
        return mp.ninf if self.decay is None else value + self.log_c2 - self.decay * t


def _spectra(problem: RadialProblem) -> _Spectra:
    """The spectra of a problem at the working precision of mpmath."""
    if problem.count is not None:
        log_n = _log_mpf(problem.count)
    else:
        assert problem.log10_n is not None
        log_n = _mpf(problem.log10_n) * mp.log(10)
    log_nu = _log_mpf(problem.alpha) + _mpf(problem.effective) * log_n
    log_rho0 = _log_mpf(problem.rho0)
    p = None if problem.decay is None else _mpf(problem.decay)
    log_c2 = p * log_rho0 if problem.continuous and p is not None else mp.mpf(0)
    b, s = _mpf(problem.degree), problem.dimension
    return _Spectra(b, s, p, log_n, log_nu, log_rho0, log_c2)


def _quadrature(spectra: _Spectra, low: Mpf | None, high: Mpf | None) -> tuple[Mpf, Mpf]:
    """∫ e^E dt between two breaks and its error; cut where the rest is below the working digits."""
    anchor = high if low is None else low
    assert anchor is not None
    width = mp.mpf(1) if low is None or high is None else high - low
    inside = [anchor + (-width if low is None else width) * mp.mpf(x) / 4 for x in (1, 3)]
    first, second = (spectra.exponent(t) for t in inside)
    if first == mp.ninf:
        return mp.mpf(0), mp.mpf(0)
    slope = (second - first) / (inside[1] - inside[0])  # E is linear between breaks
    top = (high if slope > 0 else low) if low is not None and high is not None else anchor
    assert top is not None
    reach = mp.dps * mp.log(10) / abs(slope) if slope else mp.inf
    is_cut = low is None or high is None or reach < width
    length = reach if is_cut else width
    step = -length if slope > 0 else length
    # mpmath.quad stops at an absolute error: make the largest value 1.
    largest = first + slope * (top - inside[0])

    def density(x: Mpf) -> Mpf:
        return mp.exp(spectra.exponent(top + step * x) - largest)

    total, error = mp.quad(density, [0, 1], error=True)
    rest = mp.exp(-abs(slope) * length) / abs(slope) if is_cut else mp.mpf(0)
    unit = mp.exp(largest)
    return unit * length * total, unit * (length * error + rest)


def _condition(problem: RadialProblem, digits: int) -> float:
    """How many units of rounding E may lose: the sum of the sizes of its terms."""
    n, rho0, alpha = _log_count(problem), _log(problem.rho0), _log(problem.alpha)
    decay = problem.decay or Fraction(0)
    slowest = min(Fraction(1), decay - problem.dimension) if decay else Fraction(1)
    farthest = 3 * (digits + 50) / _double(slowest)  # of t from the breaks, in the tails
    logs = 1 + alpha.size + _double(problem.effective) * n.size + rho0.size + farthest
    powers = 1 + problem.dimension + problem.degree + decay
    return 4 * (_double(powers) * logs + n.size + _log(problem.gamma).size)


def _mpf(value: Fraction) -> Mpf:
    return mp.mpf(value.numerator) / value.denominator


def _log_mpf(value: Fraction) -> Mpf:
    return mp.log(value.numerator) - mp.log(value.denominator)
