"""A spectrum as a saturating power of ρ/N^e, with all that may depart from it at low orders.

With λ = log ρ − e (log N − mean log N) − s, t = e^λ, and D = N^{−1/w} on w nonzero coordinates,

    log μ = log γ + g D + log(1 − e^{−A}) + Σ_k c_k φ_k(t),   log A = κ + b λ + a D + Σ_j β_j h_j,

so that μ ~ γ A ~ ρ^b N^{−be} as t → 0 and μ → γ as t → ∞. The *gauge* s puts t = 1 at the
crossover; it is chosen once and held, for then log μ is all but linear in what is to be known.
A spectrum has further orders, and a power fitted without them is biased more surely the more data
there are. The φ_k stand for them, each with a normal prior of its coefficient:

- next orders t^δ e^{−t²/2}, δ = 1/2, 1, 3/2, 2, 3, 4: standard deviation 1. All half-integer powers
  occur: a perturbed lattice of stable exponent 3/2 has μ ~ x^{3/2} (1 + c x^{1/2} + ...);
- the shape of the crossover: bumps of width 0.35 in λ at t = 0.5 ... 12: 0.3, falling as t^{−3/2};
- next orders that depend on direction, t h_j and t² h_j, and the amplitude's h_j: 1/2;
- corrections to scaling in N: a and those with D t, D t², D²: 1; g: 1/2.

Weak priors hold what no data may show: log γ ± 3/2, the crossover α within e^{±2} of 0.4 N^e,
b = 2 ± 4, e = 3/4 ± 2, and e within 1/(2d) ... 3/2 give or take 1/4, on d coordinates.
"""

from dataclasses import dataclass
from math import log

import numpy as np

from ..integrands.protocol import Floats
from .estimated_spectra import Sample
from .gamma_likelihood import Averages, Curve, Model

KAPPA, EFFECTIVE, DEGREE, GAMMA = 0, 1, 2, 3
"""Places of κ, e, b and log γ among the parameters."""

LOWEST_DEGREE, HIGHEST_DEGREE = -1.0, 14.0
LOWEST_EFFECTIVE, HIGHEST_EFFECTIVE = -0.5, 3.0

_ORDERS = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 4.0])
_CENTRES = np.array([0.5, 0.75, 1.1, 1.6, 2.4, 3.6, 5.4, 8.0, 12.0])
_WIDTH = 0.35
_BUMP, _BUMPS_FALL_FROM = 0.3, 1.6
_DIRECTION, _DRIFT, _PLATEAU_DRIFT, _LEVEL = 0.5, 1.0, 0.5, 1.5
_ALPHA = (log(0.4), 1.5)
_DEGREES, _EFFECTIVES, _EDGE, _LEAST = (2.0, 4.0), (0.75, 2.0), 0.2, 0.75
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

    @property
    def features(self) -> int:
        """Place of the first parameter that departs from the plain saturating power."""
        return GAMMA + 1

    @property
    def size(self) -> int:
        """Number of parameters."""
        return self.features + self.deviations().size

    def deviations(self) -> Floats:
        """Standard deviations of the priors of all parameters from ``features`` on."""
        q = self.directions.shape[1]
        bumps = _BUMP * np.minimum(1, (_BUMPS_FALL_FROM / _CENTRES) ** 1.5)
        extra = self.inner.shape[1] - 1 - q
        return np.concatenate(
            [
                [_DRIFT],
                np.full(q, _DIRECTION),
                np.full(extra, 2.0),
                [_PLATEAU_DRIFT],
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
    precision = frame.deviations() ** -2.0

    def model(at: Floats) -> Curve:
        log_mean, jacobian = _log_mean(frame, at)
        pull, stiffness = np.zeros(at.size), np.zeros((at.size, at.size))
        rest = at[frame.features :]
        pull[frame.features :] = -precision * rest
        stiffness[np.diag_indices(at.size)] = np.concatenate([np.zeros(frame.features), precision])
        penalty = float(precision @ rest**2)
        for row, miss in _weak_priors(frame, at, power):
            penalty += miss**2
            pull[: frame.features] -= miss * row
            stiffness[: frame.features, : frame.features] += np.outer(row, row)
        return Curve(log_mean, jacobian, penalty, pull, stiffness)

    return model


def _weak_priors(frame: Frame, at: Floats, power: bool) -> list[tuple[Floats, float]]:
    """Rows of derivatives and misses, in standard deviations, of the weak priors."""
    kappa, e, b, level = at[: frame.features].tolist()
    found = [
        (_row(GAMMA, 1 / _LEVEL), level / _LEVEL),
        (_row(DEGREE, 1 / _DEGREES[1]), (b - _DEGREES[0]) / _DEGREES[1]),
        (_row(EFFECTIVE, 1 / _EFFECTIVES[1]), (e - _EFFECTIVES[0]) / _EFFECTIVES[1]),
    ]
    beyond = min(e - _LEAST / frame.dim, 0.0) + max(e - 1.5, 0.0)
    if beyond:
        found.append((_row(EFFECTIVE, 1 / _EDGE), beyond / _EDGE))
    if power:
        steep = max(b, 0.1)  # α = exp(s − κ/b) is lost as b → 0
        miss = frame.gauge - kappa / steep - e * frame.mean_log_n - _ALPHA[0]
        slope = kappa / steep**2 if b > 0.1 else 0.0
        row = np.array([-1 / steep, -frame.mean_log_n, slope, 0.0])
        found.append((row / _ALPHA[1], miss / _ALPHA[1]))
    return found


def _row(place: int, value: float) -> Floats:
    row = np.zeros(GAMMA + 1)
    row[place] = value
    return row


def _log_mean(frame: Frame, at: Floats) -> tuple[Floats, Floats]:
    kappa, _, b, level = at[: frame.features].tolist()
    inner = frame.inner.shape[1]
    lam = position(frame, at)
    beta, rest = at[frame.features : frame.features + inner], at[frame.features + inner :]
    log_a: Floats = np.clip(kappa + b * lam + frame.inner @ beta, -200.0, 5.0)
    a = np.exp(log_a)
    saturation: Floats = np.where(a < 1e-8, log_a, np.log(-np.expm1(-a)))
    steepness: Floats = np.where(a < 1e-8, 1.0, a / np.expm1(a))
    columns, slopes = _features(frame, lam)
    slope = steepness * b + slopes @ rest[1 : 1 + slopes.shape[1]]
    head = np.stack([steepness, -slope * frame.shift, steepness * lam, np.ones(lam.size)], axis=1)
    jacobian = np.concatenate([head, steepness[:, None] * frame.inner, columns], axis=1)
    return level + saturation + columns @ rest, jacobian


def position(frame: Frame, at: Floats) -> Floats:
    """λ = log ρ − e (log N − mean log N) − s."""
    return frame.log_radius - at[EFFECTIVE] * frame.shift - frame.gauge


def _features(frame: Frame, lam: Floats) -> tuple[Floats, Floats]:
    """Columns D and φ_k, and the slopes in λ of those from the second on that matter to e.

    The slopes of the columns with directions and with D are left out of the Jacobian: they are
    small, and scoring converges without them.
    """
    t = np.exp(np.clip(lam, -60.0, 4.0))[:, None]
    taper = np.exp(-t * t / 2)
    orders = t**_ORDERS * taper
    off = (lam[:, None] - np.log(_CENTRES)) / _WIDTH
    bumps = np.exp(-off * off / 2)
    low, drift = t * taper, frame.drift[:, None]
    columns = [drift, orders, bumps, low * frame.directions, t * low * frame.directions]
    columns += [drift * drift * taper, drift * low, drift * t * low]
    slopes = [orders * (_ORDERS - t * t), -bumps * off / _WIDTH]
    return np.concatenate(columns, axis=1), np.concatenate(slopes, axis=1)


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
