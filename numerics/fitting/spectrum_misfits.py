"""Whether a region's spectrum is outside the model of one saturating power of ρ/N^e.

Each test compares values with the fitted curve, and takes its threshold so that a spectrum that
has such a profile is reported with probability at most `FALSE_ALARM`, over all tests:

- *misfit*: with R lowered for a misfit of 10 % everywhere, R' = 1/(1/R + 1/100), the deviance is
  compared with the Chernoff bound for R', plus 12 for priors. A mean that is off by 10 % raises
  the bounded cumulant by at most 0.0012 per value where λ <= 0.4 (computed, R = 1 to 1e8), so that
  the bound all but holds where the spectrum is within 10 % of a curve whose priors cost below 12;
- *peaks*: a value above three times the plateau, by the gamma law.
- *product*: outside the cone a degree in ∏ |m_i| makes N·P_S fall as a power towards the axes,
  where a degree in |m| keeps its amplitude up to a constant. The values there, as far as their
  ∏ |m_i| is below the crossover, are held against
  the curve at the edge of the cone, less its uncertainty and a factor 2: each is then at least
  gamma distributed, and Fisher's sum of their logarithmic levels at most χ².
- *logarithms*: a power of log N is fitted too; an improvement of the cost is χ² with one degree
  of freedom to leading order;
- *rise*: the best degree is negative, and a level without a degree costs more than twice the
  quantile of χ² with three degrees (κ, b, e); twice, because these enter far from linearly.
"""

from dataclasses import replace
from math import log, sqrt

import numpy as np

from ..integrands.protocol import Floats, Ints
from ..measuring.moments import special
from .estimated_spectra import CONE, Sample, excess, rounding
from .gamma_likelihood import Averages, Optimum, averages, deviance, fit, largest_deviance, promised
from .spectrum_curves import (
    DEGREE,
    EFFECTIVE,
    FEATURES,
    GAMMA,
    Frame,
    curve_model,
    frame_of,
    with_misfit,
)

FALSE_ALARM = 1e-6
"""Probability to report a spectrum that has a profile."""

_SHARE = FALSE_ALARM / 5  # of each test
_TOLERANCE = 0.1
_PRIORS = 12.0
_ABOVE = 3.0  # times the plateau
_BELOW = 2.0
_FEW_PEAKS = 0.1  # of the values
_LEAST_LOG_POWER = 0.3
_KNOWN = 0.25  # standard deviation of log γ up to which peaks are held against it


def without_power(sample: Sample) -> str | None:
    """Whether most values are zero to rounding, as those of a lattice off its dual are."""
    zero = int((sample.power <= rounding(sample)).sum())
    if 2 * zero <= len(sample.power):
        return None
    return f"no power at {zero} of {len(sample.power)} frequencies: a lattice"


def departure(
    everything: Sample,
    sample: Sample,
    frame: Frame,
    data: Averages,
    best: Optimum,
    level: Optimum,
) -> str | None:
    """What in the values cannot come from a profile; None if nothing.

    Parameters
    ----------
    everything : Sample
        All values, of which ``sample`` is the part that was fitted.
    frame, data, best
        The fit.
    level
        The fit without a degree.
    """
    return (
        _peaks(everything, best)
        or _product(everything, frame, best)
        or _misfit(sample, frame, best)
        or _logarithms(frame, data, best)
        or _rise(best, level)
    )


def _rise(best: Optimum, level: Optimum) -> str | None:
    """More power at low frequencies than at high ones."""
    rise = level.cost - best.cost
    if best.parameters[DEGREE] >= 0 or rise <= 2 * special().chdtri(3, _SHARE):
        return None
    return "power rises towards low frequencies"


def _peaks(everything: Sample, best: Optimum) -> str | None:
    """Values far above the plateau."""
    spread = sqrt(float(best.covariance()[GAMMA, GAMMA]))
    if spread > _KNOWN:
        return None
    z = -float(special().ndtri(_SHARE / 2))
    plateau = np.exp(best.parameters[GAMMA] + z * spread)
    shape = everything.shape
    quantile = special().gammainccinv(shape, _SHARE / 2 / len(shape)) / shape
    high = np.flatnonzero(everything.power > _ABOVE * plateau * quantile)
    if not high.size:
        return None
    return f"peaks: {_place(everything, int(high[np.argmax(everything.power[high])]))}"


def _place(sample: Sample, row: int) -> str:
    m = ", ".join(map(str, sample.frequencies[row].tolist()))
    n = round(float(np.exp(sample.log_n[row])))
    return f"N P_S = {sample.power[row]:.3g} at m = ({m}), N = {n}"


def _product(everything: Sample, frame: Frame, best: Optimum) -> str | None:
    """Power that is lost towards the axes."""
    beyond = excess(everything)
    inside = np.flatnonzero(beyond == 0)
    if everything.weight == 1 or best.parameters[DEGREE] <= 0 or not inside.size:
        return None
    place = _centred(everything)[1] + log(everything.weight) / 2
    place -= best.parameters[EFFECTIVE] * (everything.log_n - frame.mean_log_n)
    rows = np.flatnonzero((beyond > 0) & (place < frame.gauge))
    if not rows.size:
        return None
    outer = everything.taken(rows)
    edge = replace(outer, directions=everything.directions[_at_the_edge(everything, inside, rows)])
    curve = curve_model(replace(frame_of(edge, frame.mean_log_n), gauge=frame.gauge))(
        best.parameters
    )
    spread = np.sqrt(np.einsum("ki,ij,kj->k", curve.jacobian, best.covariance(), curve.jacobian))
    z = -float(special().ndtri(_SHARE / 2))
    lowest = curve.log_mean - z * spread - log(_BELOW)
    ratio = np.exp(np.clip(np.log(np.maximum(outer.power, 1e-300)) - lowest, -600.0, 600.0))
    values = special().gammainc(outer.shape, outer.shape * ratio)
    shortfall = -2 * float(np.log(np.maximum(values, 1e-300)).sum())  # Fisher
    if special().chdtrc(2 * rows.size, shortfall) >= _SHARE / 2:
        return None
    return "a degree in the product of the frequencies: power is lost towards the axes"


def _centred(sample: Sample) -> tuple[Floats, Floats]:
    """log |m_i| less its mean over the nonzero coordinates, and that mean."""
    size = np.abs(sample.frequencies).astype(float)
    logs = np.log(np.where(size > 0, size, 1.0))
    mean = logs.sum(axis=1) / sample.weight
    return np.where(size > 0, logs - mean[:, None], 0.0), mean


def _at_the_edge(everything: Sample, inside: Ints, rows: Ints) -> Ints:
    """For each row the value in the cone whose direction is nearest to it at the cone's edge."""
    centred, _ = _centred(everything)
    width = np.maximum(np.ptp(centred, axis=1), 1e-9)
    shape = centred * np.minimum(1.0, log(CONE) / width)[:, None]
    key = np.concatenate([shape, 10.0 * np.sign(everything.frequencies)], axis=1)
    gaps = ((key[rows][:, None, :] - key[inside][None]) ** 2).sum(axis=2)
    return inside[np.argmin(gaps, axis=1)]


def _misfit(sample: Sample, frame: Frame, best: Optimum) -> str | None:
    """A deviance that no curve explains."""
    loose, model = (
        with_misfit(averages(sample.power, sample.shape, rounding(sample)), _TOLERANCE),
        curve_model(frame),
    )
    threshold = largest_deviance(loose.shape, _SHARE) + _PRIORS
    if deviance(loose, model(best.parameters).log_mean).sum() <= threshold:
        return None
    found = fit(model, loose, best.parameters, frame.limits())
    log_mean = model(found.parameters).log_mean
    parts = deviance(loose, log_mean)
    if parts.sum() <= threshold:
        return None
    order = np.argsort(parts)[::-1]
    few = order[: max(1, int(_FEW_PEAKS * parts.size))]
    if parts.sum() - parts[few].sum() <= threshold:
        over = few[sample.power[few] > 3 * np.exp(log_mean[few])]
        if over.size:
            return f"peaks: {_place(sample, int(over[0]))}"
    excess_of = sqrt(max(float(parts.sum() - parts.size), 0.0) / float(loose.shape.sum()))
    return f"not one power of |m|/N^e that saturates: misfit {100 * excess_of:.0f} %"


def _logarithms(frame: Frame, data: Averages, best: Optimum) -> str | None:
    """A power of log N beside that of N."""
    log_n = frame.shift + frame.mean_log_n
    if np.unique(log_n).size < 3 or best.parameters[DEGREE] <= 0:
        return None
    column = np.log(log_n) - np.log(log_n).mean()
    wider = replace(frame, inner=np.concatenate([frame.inner, column[:, None]], axis=1))
    place = FEATURES + frame.inner.shape[1]
    start = np.insert(best.parameters, place, 0.0)
    model, least = curve_model(wider), float(special().chdtri(1, _SHARE))
    if promised(model, data, start) < least / 2:
        return None
    found = fit(model, data, start, wider.limits())
    power = float(found.parameters[place])
    gain = best.cost - found.cost
    if gain <= least or abs(power) < _LEAST_LOG_POWER:
        return None
    return f"logarithms: N P_S has (log N)^{power:.2g} beside its power of N"
