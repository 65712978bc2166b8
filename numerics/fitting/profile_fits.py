"""A profile fitted to estimated spectra: degree b, effective exponent e, plateau γ, cut-off α.

The model of Eq. 18, N·P_S = γ min(1, (ρ/(α N^e))^b), with the orders next to it, `spectrum_curves`,
is fitted to averaged periodograms at all frequencies and N together by their gamma likelihood,
`gamma_likelihood`, with normal priors on the next orders. The interval of a parameter is where the
least cost, with it held, exceeds the least of all by 4.5 for b and by 6.5 for e: the 96.6 % and
98.9 % quantiles of χ² with one degree of freedom, for 95 %. χ² is exact for a linear model; here
the places of the next orders move with e, so that wrong e fit noise more often than χ² has it,
and the two numbers were set on simulated spectra. γ and α have normal intervals of their
logarithms.

Steps. 1. A grid over (b, e, α) of plain saturating powers gives starts; fits of the plain curve
from the two best give the gauge. 2. All parameters are fitted, then again with R lowered to
1/(1/R + τ²) for the misfit τ of any smooth curve. 3. The same is done with b = 0. If its cost is
within 6.5 (96 % of χ² with two degrees, b and e) of the least, b = 0 is in the interval and e and
α are not identified. 4. Profile bounds of b and e.

The intervals are estimates, not bounds: what they rest on, the priors, is an assumption on
spectra. `fit_coverage` measures how often they hold the truth.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp, sqrt

import numpy as np

from ..integrands.protocol import Floats
from ..measuring.moments import Interval
from .curve_fits import Fit, fit_curve, start_with, without_degree
from .estimated_spectra import EstimatedSpectrum, Sample, cone, sample_of
from .gamma_likelihood import Optimum, profile_bound
from .spectrum_curves import DEGREE, EFFECTIVE, GAMMA, HIGHEST_DEGREE, KAPPA, position
from .spectrum_misfits import departure, without_power

__all__ = ["EstimatedSpectrum", "ProfileFit", "fit_profile"]

_RISE = {DEGREE: 4.5, EFFECTIVE: 6.5}
_RISE_OF_ZERO = 6.5
_HALF_WIDTH = 2.12  # of the intervals of log γ and log α, in standard deviations
_UNKNOWN = {"γ": 0.35, "α": 1.0}  # standard deviations of their logarithms: not identified
_FLAT = 0.5  # largest degree of a spectrum that may be taken for a level
_WIDEST = 8.0  # interval of b beyond which its prior says as much as the data
_WIDE = {DEGREE: 0.15, EFFECTIVE: 0.05}  # standard deviations from which valleys may be two
_BELOW, _FEWEST_BELOW = -0.8, 2  # values with λ so low that a degree needs to be seen


@dataclass(frozen=True)
class ProfileFit:
    """The profile of a region, with 95 % intervals; None where the data do not identify it.

    Parameters
    ----------
    degree : Interval or None
        b >= 0.
    effective : Interval or None
        e in N_k = N^e; None also where b = 0 is not excluded.
    gamma : Interval or None
        Level of N·P_S above the crossover, as N → ∞.
    alpha : Interval or None
        α = (γ/C)^(1/b), where N·P_S → C (ρ/N^e)^b; on several coordinates C is that along the
        diagonals, all |m_i| equal.
    outside_model : str or None
        Why the region has no such profile; then there are no intervals. Said of a spectrum that
        has one with probability at most 1e-6, to the accuracy of `spectrum_misfits`.
    reason : str or None
        Why intervals are missing.
    used : int
        Number of (N, frequency) pairs fitted.
    """

    degree: Interval | None
    effective: Interval | None
    gamma: Interval | None
    alpha: Interval | None
    outside_model: str | None
    reason: str | None
    used: int


def fit_profile(spectra: Sequence[EstimatedSpectrum]) -> ProfileFit:
    """Fit b, e, γ and α of one region to its estimated spectra.

    Parameters
    ----------
    spectra : sequence of EstimatedSpectrum
        At several N; with one N only, e and α are not identified. Frequencies from |m| = 1 to a few
        times the highest N^e, evenly in log |m|, serve best.

    Returns
    -------
    ProfileFit
        Deterministic; 0.01 to 0.1 s.

    Raises
    ------
    InputError
        If there is no frequency, or frequencies differ in their number of (nonzero) coordinates.

    Notes
    -----
    The law of Y is taken as μ Gamma(R)/R, independent between frequencies. Values that scatter more
    make the intervals too narrow unless the spectra come with their dispersion, and somewhat even
    then: docs/profile-fits.md.
    """
    everything = sample_of(spectra)
    if (found := without_power(everything)) is not None:
        return ProfileFit(None, None, None, None, found, found, len(everything.power))
    sample = cone(everything)
    fitted = fit_curve(sample)
    level = without_degree(fitted)
    found = departure(everything, sample, fitted.frame, fitted.data, fitted.best, level)
    if found is not None:
        return ProfileFit(None, None, None, None, found, found, len(sample.power))
    return _intervals(fitted, level, sample)


def _log_level(fitted: Fit) -> tuple[float, float]:
    """log γ and its standard deviation where b = 0: the level far above the lowest frequency."""
    places = fitted.frame.log_radius - fitted.best.parameters[EFFECTIVE] * fitted.frame.shift
    own = replace(fitted, frame=replace(fitted.frame, gauge=float(places.min())))
    best = without_degree(own)
    free = slice(GAMMA, None)
    covariance = np.linalg.inv(best.information[free, free])
    return float(best.parameters[GAMMA]), sqrt(float(covariance[0, 0]))


def _intervals(fitted: Fit, level: Optimum, sample: Sample) -> ProfileFit:
    flat = level.cost - fitted.best.cost <= _RISE_OF_ZERO
    degree, reasons = None, list[str]()
    if np.unique(sample.log_radius).size < 2:
        reasons.append("one |m|: the degree is not identified")
    elif (degree := _degree(fitted, flat)) is None:
        reasons.append("the data do not bound a degree >= 0")
    gamma = _plateau(fitted, degree)
    if gamma is None:
        reasons.append("the data do not show the plateau")
    effective = alpha = None
    if np.unique(sample.log_n).size < 2:
        reasons.append("one N: the effective exponent is not identified")
    elif degree is None:
        reasons.append("no effective exponent and no cut-off without a degree")
    elif degree.low <= 0:
        reasons.append("degree 0 is not excluded: no effective exponent, no cut-off")
    else:
        effective = _effective(fitted)
        if effective is None:
            reasons.append("the data do not bound the effective exponent")
        elif gamma is not None:
            alpha = _log_interval("α", *_log_alpha(fitted))
            if alpha is None:
                reasons.append("the data do not bound the cut-off")
    reason = "; ".join(reasons) or None
    return ProfileFit(degree, effective, gamma, alpha, None, reason, len(sample.power))


def _plateau(fitted: Fit, degree: Interval | None) -> Interval | None:
    """The interval of γ: of the curve, or of a level if hardly any power of ρ is left."""
    if degree is not None and degree.low > 0:
        return _log_interval("γ", *_log_gamma(fitted.best))
    level = _log_interval("γ", *_log_level(fitted))
    if degree is not None:
        return level if degree.high <= _FLAT else None
    curve = _log_interval("γ", *_log_gamma(fitted.best))
    if level is None or curve is None:
        return None
    return Interval(curve.estimate, min(level.low, curve.low), max(level.high, curve.high))


def _degree(fitted: Fit, flat: bool) -> Interval | None:
    """The interval of b, with 0 where the spectrum may be flat; b >= 0."""
    low, high = _end(fitted, DEGREE, -1), _end(fitted, DEGREE, 1)
    below = position(fitted.frame, fitted.best.parameters) < _BELOW
    if high is None or not 0 < high < HIGHEST_DEGREE or not (flat or below.sum() >= _FEWEST_BELOW):
        return None
    low = 0.0 if flat or low is None else max(low, 0.0)
    if high - low > _WIDEST:
        return None
    return Interval(min(max(float(fitted.best.parameters[DEGREE]), low), high), low, high)


def _effective(fitted: Fit) -> Interval | None:
    low, high = _end(fitted, EFFECTIVE, -1), _end(fitted, EFFECTIVE, 1)
    if low is None or high is None:
        return None
    return Interval(float(fitted.best.parameters[EFFECTIVE]), low, high)


def _end(fitted: Fit, index: int, side: int) -> float | None:
    """An end of the interval of b or e."""
    best = fitted.best

    def elsewhere(value: float) -> Floats:
        return start_with(fitted, index, value)

    wide = best.covariance()[index, index] > _WIDE[index] ** 2
    return profile_bound(
        fitted.model,
        fitted.data,
        best,
        index,
        side,
        _RISE[index],
        fitted.frame.limits(),
        elsewhere if wide else None,
    )


def _log_gamma(best: Optimum) -> tuple[float, float]:
    """log γ and its standard deviation."""
    return float(best.parameters[GAMMA]), sqrt(float(best.covariance()[GAMMA, GAMMA]))


def _log_alpha(fitted: Fit) -> tuple[float, float]:
    """log α = s − κ/b − e · mean log N, and its standard deviation."""
    frame, best = fitted.frame, fitted.best
    kappa, e, b = best.parameters[[KAPPA, EFFECTIVE, DEGREE]].tolist()
    slope = np.zeros(best.parameters.size)
    slope[[KAPPA, EFFECTIVE, DEGREE]] = -1 / b, -frame.mean_log_n, kappa / b**2
    return frame.gauge - kappa / b - e * frame.mean_log_n, sqrt(slope @ best.covariance() @ slope)


def _log_interval(of: str, centre: float, deviation: float) -> Interval | None:
    if deviation > _UNKNOWN[of]:
        return None
    half = _HALF_WIDTH * deviation
    return Interval(exp(centre), exp(centre - half), exp(centre + half))
