"""Decisions: whether a measured interval agrees with an exact finite-N prediction.

A prediction fails if the measured interval, at a level so small that all tests of a check and all
looks at growing data together stay below 1e-5, does not meet it. It holds if its interval of level
1e-3 lies within an equivalence margin of it. Else nothing is decided. Nothing is ever decided by a
slope read off a few points: exact variances and spectra are compared at each N.

Predictions of whole samplers are first tested at every frequency; a sampler with the right
spectrum has the right variances, so that these are a second, independent witness.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from ..exact_variances.variances import ExactVariance, exact_variance
from ..expected_spectra.spectra import power_array
from ..integrands.protocol import Integrand
from ..measuring.measurements import Measurement, power_interval
from ..measuring.moments import Interval, variance_interval
from ..measuring.probes import Frequency
from ..measuring.tails import is_seen

FALSE_ALARM = 1e-5
"""Probability that a check contradicts a correct claim, over everything it tests."""

EQUIVALENCE_LEVEL = 1e-3
"""Level of the interval that must lie within the margin for a prediction to hold."""

LOOKS = 12
"""Looks at growing data for which the level is divided."""

MARGIN = 0.25
"""Equivalence margin of ratios: within [1/(1 + margin), 1 + margin] of the prediction."""

EXPONENT_MARGIN = 0.25
"""Largest equivalence margin of exponents, absolute."""


def exponent_margin(dim: int) -> float:
    """Half the gap 1/d between 1 + 1/d and 1 + 2/d, which a margin must tell apart."""
    return min(EXPONENT_MARGIN, 0.5 / dim)


LEAST = 128
"""Replicates below which nothing is contradicted: the intervals are approximate."""

ENOUGH = 1024
"""Replicates after which the intervals of normal errors lie within the margin."""

_ROUNDING = 1e-20  # |F|² and squared errors below this are rounding errors of zero
_SPECTRUM_ERROR = 1e-13  # relative, of `power_array`
_BOX = 250_000

Outcome = Literal["fails", "holds", "open"]


@dataclass(frozen=True)
class Comparison:
    """One measured number against its exact prediction.

    Parameters
    ----------
    what : str
        ``spectrum`` or ``variance``.
    at : str
        The frequency or the integrand.
    n : int
    measured : Interval
    predicted : float
    error_bound : float
        Of the prediction.
    outcome : {"fails", "holds", "open"}
    """

    what: str
    at: Frequency | str
    n: int
    measured: Interval
    predicted: float
    error_bound: float
    outcome: Outcome


def compare(
    measured: Interval,
    predicted: float,
    error_bound: float,
    replicates: int,
    seen: bool = True,
    narrow: Interval | None = None,
) -> Outcome:
    """Whether the interval excludes the prediction, lies within the margin, or neither.

    Parameters
    ----------
    measured : Interval
        At the level of contradictions.
    narrow : Interval, optional
        At ``EQUIVALENCE_LEVEL``, for the margin; ``measured`` unless given.
    seen : bool
        Whether the data would have shown rare large values; if not, an interval below the
        prediction says nothing, and none holds.
    """
    low, high = predicted - error_bound, predicted + error_bound
    if predicted <= _ROUNDING:
        if measured.low > _ROUNDING:
            return "fails" if replicates >= LEAST else "open"
        return "holds" if measured.high <= 1e3 * _ROUNDING else "open"
    if replicates >= LEAST and (measured.low > high or (measured.high < low and seen)):
        return "fails"
    if not seen:
        return "open"
    near = narrow or measured
    inside = near.low >= low / (1 + MARGIN) and near.high <= high * (1 + MARGIN)
    return "holds" if inside else "open"


def spectrum_predictions(
    sampler: Sampler, n: int, wanted: Sequence[Frequency]
) -> dict[Frequency, float] | None:
    """P_S of a catalogue sampler at N = n; None if it has no realisations of n points."""
    counts = sampler.counts_at(n) if sampler.counts_at else None
    if counts is None or counts["N"] != n:
        return None
    values = power_array(sampler, counts, np.array(wanted, dtype=np.int64))
    return {m: float(v) for m, v in zip(wanted, values, strict=True)}


def variance_predictions(
    sampler: Sampler, n: int, integrands: Sequence[Integrand]
) -> dict[str, ExactVariance]:
    """Exact variances at N = n of those integrands that have one here."""
    counts = sampler.counts_at(n) if sampler.counts_at else None
    found: dict[str, ExactVariance] = {}
    if counts is None or counts["N"] != n:
        return found
    for f in integrands:
        try:
            found[f.name] = exact_variance(sampler, counts, f, box=_BOX)
        except InputError:
            continue  # no product, and combs or too many dimensions: the document says null
    return found


def comparisons(
    measurement: Measurement,
    spectrum: Mapping[Frequency, float],
    variances: Mapping[str, ExactVariance],
    level: float,
) -> list[Comparison]:
    """All comparisons at one N."""
    n, count = measurement.n, measurement.replicates
    found: list[Comparison] = []
    for m, predicted in spectrum.items():
        measured = power_interval(measurement, m, level)
        narrow = power_interval(measurement, m, EQUIVALENCE_LEVEL)
        bound = _SPECTRUM_ERROR * predicted
        outcome = compare(measured, predicted, bound, count, narrow=narrow)
        found.append(Comparison("spectrum", m, n, measured, predicted, bound, outcome))
    for f in measurement.integrands:
        if f.name not in variances:
            continue
        measured = variance_interval(measurement.shifted[f.name], level)
        exact = variances[f.name]
        value, bound = float(exact.value), float(exact.error_bound)
        narrow = variance_interval(measurement.shifted[f.name], EQUIVALENCE_LEVEL)
        outcome = compare(measured, value, bound, count, is_seen(f, n, count), narrow)
        found.append(Comparison("variance", f.name, n, measured, value, bound, outcome))
    return found


def overall_outcome(found: Sequence[Comparison]) -> Outcome:
    """Fails if one fails, holds if all hold, else open."""
    if any(c.outcome == "fails" for c in found):
        return "fails"
    return "holds" if found and all(c.outcome == "holds" for c in found) else "open"


def budget_needed(
    found: Sequence[Comparison], seconds: float, replicates: Mapping[int, int]
) -> float:
    """A rough number of seconds after which what is open would lie within the margin.

    Parameters
    ----------
    replicates : mapping of int to int
        How many realisations there are at each N. Errors that are about normal are decided with
        ``ENOUGH`` of them; the widths of many realisations say how many more heavy tails need.
    """
    factor = 1.0
    for c in found:
        if c.outcome != "open" or c.predicted <= _ROUNDING or c.measured.estimate <= 0:
            continue
        count = max(replicates[c.n], 1)
        factor = max(factor, ENOUGH / count)
        if count >= ENOUGH / 4:
            width = (c.measured.high - c.measured.low) / (2 * c.measured.estimate)
            factor = max(factor, min(width / MARGIN, 10.0) ** 2)  # rare values: width is huge
    return 1.5 * seconds * factor
