"""Is this sampler what it claims to be? Faults first, then spectra, variances and exponents.

The check draws realisations at a ladder of N, in rounds that double, and after each round compares
what it has with every claim; it stops when all are decided, or the budget is spent. What was
executed is written down as a plan, which replays to the same document.
"""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from ..theory.claims import RateClaim, SamplerClaim
from ..theory.errors import InputError
from ..theory.samplers import Sampler
from .catalogue_source import chunk_size
from .designs import (
    Design,
    all_frequencies,
    all_integrands,
    candidates,
    design,
    fault_of_count,
    ladder,
    rate_probes,
)
from .drift import DriftTest, drift_test
from .faults import BIAS_LEVEL, Fault, find_faults
from .integrands.protocol import Integrand
from .measurements import Measurement, grow, kept_points
from .moments import Interval, log_error, variance_interval
from .probes import Frequency
from .slopes import RatePoint
from .sources import SamplerFault
from .tails import is_resolved, is_seen
from .variances import ExactVariance
from .verdicts import (
    FALSE_ALARM,
    LOOKS,
    Comparison,
    Outcome,
    budget_needed,
    comparisons,
    exponent_margin,
    overall_outcome,
    spectrum_predictions,
    variance_predictions,
)

_FIRST, _MOST = 128, 1 << 14  # replicates in the first round, and at most
_CELLS = (4, 5, 6, 7, 8)  # waves of the density along an axis that the search for faults adds
_NOISE = 1e-27  # relative mean squared error that is but rounding
_FAULT_SHARE = 0.5  # of the false alarms, allowed to the search for faults

Spectrum = dict[Frequency, float]
Variances = dict[str, ExactVariance]
Step = tuple[int, int, int]


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
    spectra : dict
        Predicted spectra by claim and N.
    variances : dict
        Predicted variances by claim and N.
    """

    design: Design
    level: float
    measurements: list[Measurement]
    spectra: dict[str, dict[int, Spectrum]] = field(default_factory=dict[str, dict[int, Spectrum]])
    variances: dict[str, dict[int, Variances]] = field(
        default_factory=dict[str, dict[int, Variances]]
    )
    faults: list[Fault] = field(default_factory=list[Fault])
    judged: set[int] = field(default_factory=set[int])
    asked: tuple[int, ...] = ()
    seconds: float = 0.0
    interrupted: bool = False


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


def run_check(
    words: Sequence[str],
    dim: int,
    claims: Sequence[str] = (),
    integrands: Sequence[str] = (),
    counts: Sequence[int] = (),
    budget: float = 10.0,
    seed: int = 0,
    steps: Sequence[Step] | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> State:
    """Measure until every claim is decided, the budget is spent or the steps are executed.

    Parameters
    ----------
    words : sequence of str
        The source.
    dim : int
    claims, integrands : sequence of str
        In their grammars.
    counts : sequence of int
        N to measure at; empty: chosen.
    budget : float
        Seconds, a cap.
    seed : int
    steps : sequence of (n, replicates, attempted), optional
        Exactly these are executed, whatever the budget: the replay of a plan.
    progress : callable
        Told in a line what is being done.

    Raises
    ------
    InputError
        If anything asked for is unusable.
    """
    if not 0 < budget < float("inf"):
        raise InputError(f"--budget must be a positive number of seconds: got {budget}")
    began = time.perf_counter()
    asked = design(words, dim, claims, integrands, seed)
    state = State(asked, FALSE_ALARM, [], asked=tuple(counts))
    try:
        _prepare(state, [n for n, *_ in steps] if steps else counts)
        if steps:
            _replay(state, {n: reached for n, *reached in steps})
        else:
            _measure(state, began + budget, progress)
    except SamplerFault as fault:
        told = fault_of_count(asked.source, fault)
        state.faults.insert(0, Fault(told.kind, told.detail, told.evidence))
    except KeyboardInterrupt:
        state.interrupted = True
        for m in state.measurements:
            m.attempted = m.replicates
    for m in state.measurements:
        _look_for_faults(state, m)
    state.seconds = time.perf_counter() - began
    return state


def _prepare(state: State, counts: Sequence[int]) -> None:
    """Choose the N, and predict for every claimed sampler."""
    asked = state.design
    integrands = all_integrands(asked)
    for n in ladder(asked, counts):
        state.measurements.append(Measurement(n, all_frequencies(asked, n), integrands))
    tests = 0
    for claim in asked.claims:
        if isinstance(claim, SamplerClaim):
            state.spectra[claim.text], state.variances[claim.text] = {}, {}
            for m in state.measurements:
                spectrum = spectrum_predictions(claim.sampler, m.n, m.frequencies)
                if spectrum is not None:
                    state.spectra[claim.text][m.n] = spectrum
                    exact = variance_predictions(claim.sampler, m.n, m.integrands)
                    state.variances[claim.text][m.n] = exact
                    tests += len(spectrum) + len(exact)
        else:
            tests += 1
    if not asked.claims:  # the true sampler must stay among the matches
        tests = sum(len(m.frequencies) for m in state.measurements)
    state.level = (1 - _FAULT_SHARE) * FALSE_ALARM / (max(tests, 1) * LOOKS)


def _bias_level(state: State) -> float:
    """Of one search for faults: there is one at each N."""
    return min(BIAS_LEVEL, _FAULT_SHARE * FALSE_ALARM / len(state.measurements))


def _replay(state: State, steps: Mapping[int, Sequence[int]]) -> None:
    """Execute a plan's steps: what was measured, then what failed, so that a fault comes last."""
    for stage in (0, 1):
        for m in state.measurements:
            if m.n not in steps:
                raise InputError(f"a plan must list N that the source honours: got {sorted(steps)}")
            grow(m, state.design.source, state.design.seed, steps[m.n][stage])


def _measure(state: State, deadline: float, progress: Callable[[str], None]) -> None:
    """Rounds of doubling size, until all is decided, exhausted or late."""
    target = _FIRST
    while target <= _MOST:
        for m in state.measurements:
            while m.replicates < _reachable(state, m, target):
                wanted = m.replicates + chunk_size(m.n)
                grow(m, state.design.source, state.design.seed, wanted, deadline)
                if time.perf_counter() > deadline:
                    return
            _look_for_faults(state, m)
        if state.faults:
            return
        outcomes: list[Outcome] = [j.outcome for j in judgements(state)]
        progress(f"{target} realisations at N = {', '.join(str(m.n) for m in state.measurements)}")
        exhausted = all(_reachable(state, m, _MOST) == m.replicates for m in state.measurements)
        if exhausted or _is_decided(state, outcomes):
            return
        target *= 2


def _reachable(state: State, m: Measurement, target: int) -> int:
    held = state.design.source.realisations
    return target if held is None else min(target, held[m.n])


def _is_decided(state: State, outcomes: Sequence[Outcome]) -> bool:
    """All claims decided, or one contradicted; without claims, every candidate decided."""
    if not state.design.claims:
        return all(outcome != "open" for _, outcome in matching(state))
    return "fails" in outcomes or all(o != "open" for o in outcomes)


def _look_for_faults(state: State, m: Measurement) -> None:
    """Judge the raw points kept, once for each N."""
    if not m.kept or m.n in state.judged:
        return
    state.judged.add(m.n)
    known = {(f.kind, f.detail) for f in state.faults}
    found = find_faults(kept_points(m), _CELLS, _bias_level(state))
    state.faults += [f for f in found if (f.kind, f.detail) not in known]


def judgements(state: State) -> list[Judgement]:
    """What the measurements say on each claim."""
    return [
        _sampler_judgement(state, c) if isinstance(c, SamplerClaim) else _rate_judgement(state, c)
        for c in state.design.claims
    ]


def _sampler_judgement(state: State, claim: SamplerClaim) -> Judgement:
    found: list[Comparison] = []
    for m in state.measurements:
        if m.replicates >= 2 and m.n in state.spectra.get(claim.text, {}):
            spectrum = state.spectra[claim.text][m.n]
            found += comparisons(m, spectrum, state.variances[claim.text][m.n], state.level)
    return Judgement(claim, overall_outcome(found), tuple(found))


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
        Leave out what says nothing on N → ∞: too few points to meet or to resolve a narrow
        integrand, and variances that are rounding errors.
    """
    found: list[RatePoint] = []
    for m in state.measurements:
        if m.replicates < _FIRST or (asymptotic and not _is_telling(m, integrands)):
            continue
        parts = [variance_interval(m.shifted[f.name], level) for f in integrands]
        total = Interval(*(sum(p[i] for p in parts) for i in range(3)))
        if total.low > 0 and total.high < float("inf"):
            found.append(RatePoint(m.n, total.estimate, log_error(total, level)))
    return found


def _is_telling(m: Measurement, integrands: Sequence[Integrand]) -> bool:
    return all(
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
            spectrum = spectrum_predictions(sampler, m.n, m.frequencies) if m.frequencies else None
            if spectrum is not None and m.replicates >= 2:
                seen += comparisons(m, spectrum, {}, state.level)
        if seen:
            found.append((sampler, overall_outcome(seen)))
    return found


def seconds_needed(state: State, found: Sequence[Judgement]) -> float | None:
    """Budget that would decide what is open; None if nothing is, or if no budget would."""
    held = state.design.source.realisations
    exhausted = held is not None and all(m.replicates == held[m.n] for m in state.measurements)
    if all(j.outcome != "open" for j in found) or exhausted or state.interrupted or state.faults:
        return None
    open_ones = [c for j in found if j.outcome == "open" for c in j.found]
    seconds = max(state.seconds, 1.0)
    if not open_ones:
        return 4 * seconds
    return budget_needed(open_ones, seconds, {m.n: m.replicates for m in state.measurements})
