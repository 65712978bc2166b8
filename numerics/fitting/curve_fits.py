"""The curve of a spectrum fitted: its starts and its gauge, and the same without a power.

A grid over (b, e, α) of plain saturating powers gives starts; fits of the plain curve from the two
best give the gauge, at which all parameters are fitted, and then once more with R lowered to
1/(1/R + τ²) for the misfit τ of any smooth curve.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log

import numpy as np

from ..integrands.protocol import Floats
from .estimated_spectra import Sample, rounding
from .gamma_likelihood import Averages, Model, Optimum, averages, fit
from .spectrum_curves import (
    DEGREE,
    EFFECTIVE,
    FEATURES,
    GAMMA,
    KAPPA,
    USUAL_LOG_ALPHA,
    Frame,
    curve_model,
    frame_of,
    misfit_allowed,
    with_misfit,
)

_SATURATED = 4.0  # κ of the curve without a power
_DEGREES = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0)
_ALPHAS = tuple(map(log, (0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.5)))
_STARTS, _APART_B, _APART_GAUGE = 2, 0.6, 0.9
_REGAUGED = 1.5  # largest shift of the gauge at a time
_COARSE, _FINE = 1e-2, 1e-4  # costs


@dataclass(frozen=True)
class Fit:
    """A fitted curve: its frame with the gauge, the values with R lowered, and the optimum."""

    frame: Frame
    data: Averages
    best: Optimum

    @property
    def model(self) -> Model:
        """The curve as a function of its parameters."""
        return curve_model(self.frame)


def fit_curve(sample: Sample) -> Fit:
    """The curve with all its orders that fits best, in the gauge of the plain saturating power."""
    data = averages(sample.power, sample.shape, rounding(sample))
    frame, start = _gauged(frame_of(sample), data)
    model, limits = curve_model(frame), frame.limits()
    best = fit(model, data, start, limits, tolerance=_COARSE)
    data = with_misfit(data, misfit_allowed(frame, best.parameters))
    return Fit(frame, data, fit(model, data, best.parameters, limits, tolerance=_FINE))


def _gauged(frame: Frame, data: Averages) -> tuple[Frame, Floats]:
    """The gauge, and the parameters of the plain saturating power in it."""
    found: list[tuple[float, Frame, Floats]] = []
    features = range(FEATURES, frame.size)
    for gauge, start in _starts(frame, data):
        own, at, cost = replace(frame, gauge=gauge), start, 0.0
        for _ in range(2):
            best = fit(curve_model(own), data, at, own.limits(), features, 60, _COARSE)
            at, cost = best.parameters.copy(), best.cost
            shift = float(np.clip(-at[KAPPA] / max(at[DEGREE], 0.3), -_REGAUGED, _REGAUGED))
            own = replace(own, gauge=own.gauge + shift)
            at[KAPPA] += at[DEGREE] * shift
        found.append((cost, own, at))
    _, own, at = min(found, key=lambda f: f[0])
    return own, at


def _starts(frame: Frame, data: Averages) -> list[tuple[float, Floats]]:
    """Gauges and parameters of plain saturating powers, the likeliest of a grid first."""
    cost, gauge, start = _plain(frame, data, _DEGREES, _effectives(frame))
    kept: list[tuple[float, Floats]] = []
    for i in np.argsort(cost, kind="stable"):
        b, s = start[i, DEGREE], float(gauge[i])
        if all(abs(b - o[DEGREE]) > _APART_B or abs(s - g) > _APART_GAUGE for g, o in kept):
            kept.append((s, start[i]))
        if len(kept) == _STARTS:
            break
    return kept


def _effectives(frame: Frame) -> list[float]:
    return np.unique(np.linspace(1 / frame.dim, 1, 3)).tolist()


def _plain(
    frame: Frame, data: Averages, degrees: Sequence[float], effectives: Sequence[float]
) -> tuple[Floats, Floats, Floats]:
    """Costs of plain saturating powers with the best γ, their gauges, and their parameters."""
    grid = np.meshgrid(degrees, effectives, _ALPHAS, indexing="ij")
    b, e, alpha = (g.reshape(-1, 1) for g in grid)
    gauge = alpha + e * frame.mean_log_n
    power = b * (frame.log_radius - e * frame.shift - gauge)
    a = np.exp(np.minimum(np.maximum(power, -200.0), 5.0))
    reached = -np.expm1(-a)
    level = np.log((data.power / reached) @ data.shape / data.shape.sum())
    start = np.zeros((len(b), frame.size))
    start[:, EFFECTIVE], start[:, DEGREE], start[:, GAMMA] = e[:, 0], b[:, 0], level
    cost = 2 * (level * data.shape.sum() + np.log(reached) @ data.shape)
    cost += (alpha[:, 0] - USUAL_LOG_ALPHA) ** 2 + level**2 / 2
    return cost, gauge[:, 0], start


def without_degree(fitted: Fit) -> Optimum:
    """The best fit with b = 0: a level and its corrections."""
    frame, data = fitted.frame, fitted.data
    start = np.zeros(frame.size)
    start[[KAPPA, EFFECTIVE]] = _SATURATED, fitted.best.parameters[EFFECTIVE]
    start[GAMMA] = np.log(data.shape @ data.power / data.shape.sum())
    held = (KAPPA, EFFECTIVE, DEGREE)
    return fit(curve_model(frame, power=False), data, start, frame.limits(), held, 30, _COARSE)


def start_with(fitted: Fit, index: int, value: float) -> Floats:
    """The likeliest plain saturating power with b or e held, in the gauge of a fit.

    Parameters
    ----------
    index : {DEGREE, EFFECTIVE}
    value : float
    """
    frame = fitted.frame
    degrees = [value] if index == DEGREE else _DEGREES
    effectives = [value] if index == EFFECTIVE else _effectives(frame)
    cost, gauge, starts = _plain(frame, fitted.data, degrees, effectives)
    i = int(np.argmin(cost))
    start = starts[i]
    start[KAPPA] = start[DEGREE] * (frame.gauge - gauge[i])
    return start
