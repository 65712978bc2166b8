"""What the measurements say on each claim, and on each sampler of the catalogue."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from ...theory.claims import RateClaim, SamplerClaim
from ...theory.samplers import Sampler
from ..exact_variances.variances import ExactVariance
from ..integrands.protocol import Integrand
from ..measuring.drift import DriftTest, drift_test
from ..measuring.measurements import Measurement
from ..measuring.moments import Interval, log_error, variance_interval
from ..measuring.probes import Frequency
from ..measuring.slopes import RatePoint
from ..measuring.tails import is_resolved, is_seen
from ..measuring.white_noise import Scan
from ..point_sources.child_processes import Limits
from ..point_sources.fault_kinds import Fault
from .designs import Design, candidates, rate_probes
from .fitted_profiles import FittedRegion
from .structures import disagreements
from .verdicts import (
    Comparison,
    Outcome,
    budget_needed,
    comparisons,
    exponent_margin,
    overall_outcome,
    spectrum_predictions,
)

FIRST = 128
"""Replicates in the first round, with fewer of which no exponent is judged."""

_NOISE = 1e-27  # relative mean squared error that is but rounding

Spectrum = dict[Frequency, float]
Variances = dict[str, ExactVariance]


@dataclass
class State:
    """A check under way: what is asked, predicted and measured so far.

    Parameters
    ----------
    design : Design
    level : float
        Of each single test.
    measurements : list of Measurement
        One per N.
    asked : tuple of int
        The N asked for, before the source moved them.
    budget : float
        Seconds.
    limits : Limits
        What a command or a callable may use.
    spectra : dict
        Predicted spectra by claim and N.
    variances : dict
        Predicted variances by claim and N.
    candidates : dict
        Predicted spectra by sampler of the catalogue and N; None where it has none.
    faults : list of Fault
    judged : set of int
        The N at which faults have been looked for.
    ended : str
        ``decided``: all is, or there is no more to measure; ``fault``; ``budget``: it is spent;
        ``interrupted``.
    unanswered : dict, optional
        ``n`` that the sampler was asked for when the budget was spent, None while it was being
        loaded, and for how many ``seconds``.
    scans : tuple of Scan
        Of low frequencies in many directions, one for each N, made once at the end.
    fitted : tuple of FittedRegion
        Profiles of the first regions, as many as there was time for.
    """

    design: Design
    level: float
    measurements: list[Measurement]
    asked: tuple[int, ...]
    budget: float
    limits: Limits
    spectra: dict[str, dict[int, Spectrum]] = field(default_factory=dict[str, dict[int, Spectrum]])
    variances: dict[str, dict[int, Variances]] = field(
        default_factory=dict[str, dict[int, Variances]]
    )
    candidates: dict[tuple[str, int], Spectrum | None] = field(
        default_factory=dict[tuple[str, int], Spectrum | None]
    )
    faults: list[Fault] = field(default_factory=list[Fault])
    judged: set[int] = field(default_factory=set[int])
    ended: str = "decided"
    unanswered: dict[str, Any] | None = None
    scans: tuple[Scan, ...] = ()
    fitted: tuple[FittedRegion, ...] = ()
    seconds: float = 0.0


@dataclass(frozen=True)
class Judgement:
    """What was found on one claim.

    Parameters
    ----------
    claim : SamplerClaim or RateClaim
    outcome : {"fails", "holds", "open"}
    found : tuple of Comparison
        For a claimed sampler.
    drift : DriftTest or None
        For a bare exponent.
    """

    claim: SamplerClaim | RateClaim
    outcome: Outcome
    found: tuple[Comparison, ...] = ()
    drift: DriftTest | None = None


def judgements(state: State) -> list[Judgement]:
    """What the measurements say on each claim."""
    return [
        _sampler_judgement(state, c) if isinstance(c, SamplerClaim) else _rate_judgement(state, c)
        for c in state.design.claims
    ]


def _sampler_judgement(state: State, claim: SamplerClaim) -> Judgement:
    found: list[Comparison] = []
    for m in state.measurements:
        if _is_telling_of_spectra(m) and m.n in state.spectra.get(claim.text, {}):
            spectrum = state.spectra[claim.text][m.n]
            found += comparisons(m, spectrum, state.variances[claim.text][m.n], state.level)
    for scan in state.scans:
        found += disagreements(scan, claim.sampler)
    return Judgement(claim, overall_outcome(found), tuple(found))


def _is_telling_of_spectra(m: Measurement) -> bool:
    return m.replicates >= 2 and not m.is_frozen and m.dropped is None


def _rate_judgement(state: State, claim: RateClaim) -> Judgement:
    """The exponent, tested on the whole ladder with its drift allowance."""
    points = rate_points(state, rate_probes(claim, state.design.dim), state.level, asymptotic=True)
    if len(points) < 3:
        return Judgement(claim, "open")
    drift = drift_test(
        points,
        float(claim.exponent),
        float(claim.log_power),
        state.level,
        margin=exponent_margin(state.design.dim),
    )
    outcomes: dict[str, Outcome] = {"contradicted": "fails", "consistent": "holds"}
    return Judgement(claim, outcomes.get(drift.verdict, "open"), drift=drift)


def rate_points(
    state: State, integrands: Sequence[Integrand], level: float, asymptotic: bool = False
) -> list[RatePoint]:
    """Summed variances of integrands on different supports, per N, with cautious errors.

    A random shift makes the errors on different supports uncorrelated, so that their variances
    add; their intervals are added end by end.

    Parameters
    ----------
    asymptotic : bool
        Leave out what says nothing on N → ∞: frozen point sets, too few points to meet or to
        resolve a narrow integrand, and variances that are rounding errors.
    """
    found: list[RatePoint] = []
    for m in state.measurements:
        if m.shifts < FIRST or (asymptotic and not _is_telling(m, integrands)):
            continue
        parts = [variance_interval(m.shifted[f.name], level) for f in integrands]
        total = Interval(*(sum(p[i] for p in parts) for i in range(3)))
        if total.low > 0 and total.high < float("inf"):
            found.append(RatePoint(m.n, total.estimate, log_error(total, level)))
    return found


def _is_telling(m: Measurement, integrands: Sequence[Integrand]) -> bool:
    return not m.is_frozen and all(
        is_resolved(f, m.n)
        and is_seen(f, m.n, m.replicates)
        and m.shifted[f.name].mse > _NOISE * (float(f.total(17)) + float(f.mean(17)) ** 2)
        for f in integrands
    )


def matching(state: State) -> list[tuple[Sampler, Outcome]]:
    """How each catalogue sampler's exact spectrum compares with the measured one."""
    found: list[tuple[Sampler, Outcome]] = []
    for sampler in candidates(state.design.dim):
        seen: list[Comparison] = []
        for m in state.measurements:
            if not (m.frequencies and _is_telling_of_spectra(m)):
                continue
            at = sampler.name, m.n
            if at not in state.candidates:
                state.candidates[at] = spectrum_predictions(sampler, m.n, m.frequencies)
            spectrum = state.candidates[at]
            if spectrum is not None:
                seen += comparisons(m, spectrum, {}, state.level)
        if seen:
            found.append((sampler, overall_outcome(seen)))
    return found


def seconds_needed(state: State, found: Sequence[Judgement]) -> float | None:
    """Budget that would decide what is open; None if nothing is, or if no budget would."""
    held = state.design.source.realisations
    exhausted = held is not None and all(m.replicates == held[m.n] for m in state.measurements)
    over = exhausted or state.ended == "interrupted" or state.faults
    if over or all(j.outcome != "open" for j in found):
        return None
    open_ones = [c for j in found if j.outcome == "open" for c in j.found]
    seconds = max(state.seconds, 1.0)
    if not open_ones:
        return 4 * seconds
    return budget_needed(open_ones, seconds, {m.n: m.replicates for m in state.measurements})
