"""A spectrum as a saturating power of ρ/N^e, with all that may depart from it at low orders.

With λ = log ρ − e (log N − mean log N) − s, t = e^λ, and D = N^{−1/w} on w nonzero coordinates,

    log μ = log γ + g D + g' D² + log(1 − e^{−A}) + Σ_k c_k φ_k(t),
    log A = κ + b λ + a D + Σ_j β_j h_j,

so that μ ~ γ A ~ ρ^b N^{−be} as t → 0 and μ → γ as t → ∞. The *gauge* s puts t = 1 at the
crossover; it is chosen once and held, for then log μ is all but linear in what is to be known.
A spectrum has further orders, and a power fitted without them is biased more surely the more data
there are. The φ_k stand for them, each with a normal prior of its coefficient:

- next orders t^δ e^{−t²/2}, δ = 1/2, 1, 3/2, 2, 3, 4: standard deviation 1. All half-integer powers
  occur: a perturbed lattice of stable exponent 3/2 has μ ~ x^{3/2} (1 + c x^{1/2} + ...);
- the shape of the crossover: bumps of width 0.35 in λ at t = 0.5 ... 12: 0.3, falling as t^{−3/2};
- next orders that depend on direction, t h_j and t² h_j, and the amplitude's h_j: 1/2;
- corrections to scaling in N: a, g' and those with D t, D t², D² at low t: 1; g: 1/2.

Weak priors hold what no data may show: log γ = 0 ± 3/2, log α = log 0.4 ± 3/2,
b = 2 ± 4, e = 3/4 ± 2, and e within 3/(4d) ... 3/2 give or take 1/5, on d coordinates.
"""

from dataclasses import dataclass
from functools import cached_property
from math import log

import numpy as np

from ..integrands.protocol import Floats
from .estimated_spectra import Sample
from .gamma_likelihood import Averages, Curve, Model

KAPPA, EFFECTIVE, DEGREE, GAMMA, FEATURES = range(5)
"""Places of κ, e, b and log γ among the parameters, and of the first that departs from them."""

USUAL_LOG_ALPHA = log(0.4)
"""Centre of the prior of log α."""

LOWEST_DEGREE, HIGHEST_DEGREE = -1.0, 14.0
LOWEST_EFFECTIVE, HIGHEST_EFFECTIVE = -0.5, 3.0

_ORDERS = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 4.0])
_FIRST = 1  # place of the order 1
_CENTRES = np.array([0.5, 0.75, 1.1, 1.6, 2.4, 3.6, 5.4, 8.0, 12.0])
_LOG_CENTRES = np.log(_CENTRES)
_WIDTH = 0.35
_BUMP, _BUMPS_FALL_FROM = 0.3, 1.6
_DIRECTION, _EXTRA, _DRIFT, _PLATEAU_DRIFT = 0.5, 2.0, 1.0, 0.5
_WEAK = {GAMMA: (0.0, 1.5), DEGREE: (2.0, 4.0), EFFECTIVE: (0.75, 2.0)}  # means and deviations
_ALPHA = (USUAL_LOG_ALPHA, 1.5)  # of log α
_LEAST, _MOST, _EDGE = 0.75, 1.5, 0.2  # of e: 3/(4d) to 3/2
_MISFIT, _LEAST_MISFIT, _MISFIT_OF_DIRECTIONS = 0.07, 0.003, 0.015


@dataclass(frozen=True)
class Frame:
    """What a curve is evaluated on: the places of its values, and the gauge.

    Parameters
    ----------
    log_radius, shift : array (k,)
        log ρ, and log N less its mean.
    mean_log_n : float
    drift : array (k,)
        D = N^{−1/w}.
    inner : array (k, 1 + q)
        Columns D and h_j, which belong to log A; more may be appended.
    dim : int
    gauge : float
        s.
    """

    log_radius: Floats
    shift: Floats
    mean_log_n: float
    drift: Floats
    inner: Floats
    directions: Floats
    dim: int
    gauge: float = 0.0

    @cached_property
    def size(self) -> int:
        """Number of parameters."""
        return FEATURES + self.deviations.size

    @cached_property
    def deviations(self) -> Floats:
        """Standard deviations of the priors of all parameters from ``FEATURES`` on."""
        q = self.directions.shape[1]
        bumps = _BUMP * np.minimum(1, (_BUMPS_FALL_FROM / _CENTRES) ** 1.5)
        extra = self.inner.shape[1] - 1 - q
        return np.concatenate(
            [
                [_DRIFT],
                np.full(q, _DIRECTION),
                np.full(extra, _EXTRA),
                [_PLATEAU_DRIFT, _DRIFT],
                np.ones(_ORDERS.size),
                bumps,
                np.full(2 * q, _DIRECTION),
                np.full(3, _DRIFT),
            ]
        )

    def limits(self) -> tuple[Floats, Floats]:
        """Smallest and largest value of each parameter."""
        low, high = np.full(self.size, -np.inf), np.full(self.size, np.inf)
        low[DEGREE], high[DEGREE] = LOWEST_DEGREE, HIGHEST_DEGREE
        low[EFFECTIVE], high[EFFECTIVE] = LOWEST_EFFECTIVE, HIGHEST_EFFECTIVE
        return low, high


def frame_of(sample: Sample, centre: float | None = None) -> Frame:
    """The frame of a sample; ``centre`` is the mean log N of another frame to share its e."""
    centre = float(sample.log_n.mean()) if centre is None else centre
    drift = np.exp(-sample.log_n / sample.weight)
    return Frame(
        sample.log_radius,
        sample.log_n - centre,
        centre,
        drift,
        np.concatenate([drift[:, None], sample.directions], axis=1),
        sample.directions,
        sample.frequencies.shape[1],
    )


def curve_model(frame: Frame, power: bool = True) -> Model:
    """The curve with its priors as a function of the parameters.

    Parameters
    ----------
    power : bool
        Whether there is a power at all; without, b = 0 and μ is γ but for the corrections.
    """
    centre, precision = np.zeros(frame.size), np.zeros(frame.size)
    precision[FEATURES:] = frame.deviations**-2.0
    for place, (mean, deviation) in _WEAK.items():
        centre[place], precision[place] = mean, deviation**-2.0
    diagonal = np.diag(precision)

    def model(at: Floats) -> Curve:
        log_mean, jacobian = _log_mean(frame, at)
        pull = precision * (centre - at)
        penalty = float(pull @ (centre - at))
        stiffness = diagonal
        for row, miss in _bent_priors(frame, at, power):
            penalty += miss**2
            pull[:FEATURES] -= miss * row
            stiffness = stiffness.copy()
            stiffness[:FEATURES, :FEATURES] += np.outer(row, row)
        return Curve(log_mean, jacobian, penalty, pull, stiffness)

    return model


def _bent_priors(frame: Frame, at: Floats, power: bool) -> list[tuple[Floats, float]]:
    """Derivatives and misses, in standard deviations, of the priors of e's range and of α."""
    kappa, e, b = at[:GAMMA].tolist()
    found = list[tuple[Floats, float]]()
    beyond = min(e - _LEAST / frame.dim, 0.0) + max(e - _MOST, 0.0)
    if beyond:
        found.append((np.array([0.0, 1 / _EDGE, 0.0, 0.0]), beyond / _EDGE))
    if power:
        steep = max(b, 0.1)  # α = exp(s − κ/b) is lost as b → 0
        miss = frame.gauge - kappa / steep - e * frame.mean_log_n - _ALPHA[0]
        slope = kappa / steep**2 if b > 0.1 else 0.0
        row = np.array([-1 / steep, -frame.mean_log_n, slope, 0.0])
        found.append((row / _ALPHA[1], miss / _ALPHA[1]))
    return found


def _log_mean(frame: Frame, at: Floats) -> tuple[Floats, Floats]:
    """log μ and its Jacobian.

    The slopes in λ, and so in e, of the columns with directions and with D are left out: they are
    small, and scoring converges without them.
    """
    kappa, _, b, level = at[:FEATURES].tolist()
    inner = frame.inner.shape[1]
    lam = position(frame, at)
    rest = at[FEATURES + inner :]
    a = np.exp(
        np.minimum(np.maximum(kappa + b * lam + frame.inner @ at[FEATURES:][:inner], -200.0), 5.0)
    )
    reached = -np.expm1(-a)
    steepness = a * (1 - reached) / reached
    jacobian = np.empty((at.size, lam.size))
    columns = jacobian[FEATURES + inner :]
    slope = steepness * b + _features(frame, lam, rest, columns)
    jacobian[KAPPA], jacobian[EFFECTIVE], jacobian[DEGREE] = (
        steepness,
        -slope * frame.shift,
        steepness * lam,
    )
    jacobian[GAMMA] = 1.0
    np.multiply(frame.inner.T, steepness, out=jacobian[FEATURES : FEATURES + inner])
    return level + np.log(reached) + rest @ columns, jacobian.T


def position(frame: Frame, at: Floats) -> Floats:
    """λ = log ρ − e (log N − mean log N) − s."""
    return frame.log_radius - at[EFFECTIVE] * frame.shift - frame.gauge


def _features(frame: Frame, lam: Floats, rest: Floats, columns: Floats) -> Floats:
    """Fill in the columns D, D² and φ_k; the slope in λ of the orders and bumps at coefficients."""
    lam = np.minimum(np.maximum(lam, -60.0), 4.0)
    t = np.exp(lam)
    fall = t * t / 2
    drift, n, q = frame.drift, 2 + _ORDERS.size, frame.directions.shape[1]
    columns[0], columns[1] = drift, drift * drift
    orders, bumps = columns[2:n], columns[n : n + _CENTRES.size]
    np.exp(_ORDERS[:, None] * lam - fall, out=orders)
    off = (lam - _LOG_CENTRES[:, None]) / _WIDTH
    np.exp(-off * off / 2, out=bumps)
    low, place = orders[_FIRST], n + _CENTRES.size
    if q:
        np.multiply(frame.directions.T, low, out=columns[place : place + q])
        np.multiply(frame.directions.T, t * low, out=columns[place + q : place + 2 * q])
    columns[-3], columns[-2], columns[-1] = (
        drift * drift * np.exp(-fall),
        drift * low,
        drift * t * low,
    )
    c, s = rest[2:n], rest[n:place]
    return (c * _ORDERS) @ orders - 2 * fall * (c @ orders) - (s / _WIDTH) @ (bumps * off)


def misfit_allowed(frame: Frame, at: Floats) -> Floats:
    """Relative misfit τ of the curve to a spectrum, frequency by frequency.

    7 % about the crossover, where kinks and oscillations are, falling as t⁴ below and as 1/t
    above; nowhere less than 0.3 %, and 1.5 % where there are directions.
    """
    t = np.exp(np.clip(position(frame, at), -30.0, 6.0))
    crossover = _MISFIT * t**4 / (1 + t**4) / (1 + t / 8)
    least = _MISFIT_OF_DIRECTIONS if frame.directions.shape[1] else _LEAST_MISFIT
    return np.sqrt(crossover**2 + least**2)


def with_misfit(data: Averages, misfit: Floats | float) -> Averages:
    """The values with their R lowered to 1/(1/R + τ²)."""
    return data.with_shape(1 / (1 / data.shape + np.asarray(misfit) ** 2))
