"""Is this sampler what it claims to be? Faults first, then spectra, variances and exponents.

The check draws realisations at a ladder of N, in rounds that double, and after each round compares
what it has with every claim; it stops when all are decided, or the budget is spent. A few
realisations at each N come first: N of which a first round would not end in time are dropped, the
largest first. At the end profiles are fitted, for which time is set aside. What was executed is
written down as a plan, which replays to the same document.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, repeat
from time import perf_counter
from typing import Any, NamedTuple

from ...theory.claims import SamplerClaim
from ...theory.errors import InputError
from ..measuring.measurements import (
    Measurement,
    grow,
    homogenise,
    kept_amplitudes,
    kept_points,
    whole_chunks,
)
from ..measuring.moments import special
from ..point_sources.child_processes import Limits, OutOfTime, unanswered
from ..point_sources.child_source import ChildSource, global_state_fault
from ..point_sources.command_source import CommandSource, seed_fault
from ..point_sources.fault_kinds import Fault, fault_of
from ..point_sources.realisations import SamplerFault
from .biases import measured_bias
from .designs import all_frequencies, all_integrands, design, fault_of_count, ladder
from .faults import BIAS_LEVEL, COINCIDENCE_LEVEL, find_faults
from .fitted_profiles import FittedRegion, fit_seconds, fitted_regions, fitted_supports
from .judgements import FIRST, State, judgements, matching
from .structures import scans_of
from .trials import MOST, grow_to, reachable, tried
from .verdicts import FALSE_ALARM, LOOKS, Outcome, spectrum_predictions, variance_predictions

_CELLS = (4, 5, 6, 7, 8)  # waves of the density along an axis that the search for faults adds
_FAULT_SHARE = 0.5  # of the false alarms, allowed to the search for faults
_SCAN_SHARE = 0.1  # and to frequencies that are scanned once, at the end
_CALL = 60.0  # seconds for one realisation, or the whole budget if that is less
_SILENT = 1 / 3  # of the budget: a sampler that is silent for less is not blamed
_SHORTEST = 0.5  # seconds of silence
_SET_ASIDE = 0.2  # of the budget, at most, for the fits


class Step(NamedTuple):
    """What was executed at one N: realisations measured and asked for, and random shifts.

    ``chunks`` of them were drawn together; where nothing is said, the largest ones. ``dropped``
    says why no more is measured at this N.
    """

    n: int
    replicates: int
    attempted: int
    shifts: int
    chunks: tuple[int, ...] = ()
    dropped: str | None = None


@dataclass(frozen=True)
class Execution:
    """What a plan says was executed, to be executed again whatever the budget.

    Parameters
    ----------
    steps : tuple of Step
    ended : str
        As in `State`.
    call_seconds : float
        Limit of time of one realisation.
    unanswered : dict, optional
        As in `State`.
    fitted : int
        Regions whose profiles are fitted.
    """

    steps: tuple[Step, ...]
    ended: str = "decided"
    call_seconds: float = _CALL
    unanswered: dict[str, Any] | None = None
    fitted: int = 0


def run_check(
    words: Sequence[str],
    dim: int,
    claims: Sequence[str] = (),
    integrands: Sequence[str] = (),
    counts: Sequence[int] = (),
    budget: float = 10.0,
    seed: int = 0,
    again: Execution | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> State:
    """Measure until every claim is decided, the budget is spent or a plan is executed.

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
        Seconds, a cap on what is begun: nothing is of which it is known that it cannot end in time.
    seed : int
    again : Execution, optional
        Exactly this is executed, whatever the budget: the replay of a plan.
    progress : callable
        Told in a line what is being done.

    Raises
    ------
    InputError
        If anything asked for is unusable.
    """
    if not 0 < budget < float("inf"):
        raise InputError(f"--budget must be a positive number of seconds: got {budget}")
    began = perf_counter()
    limits = Limits(min(_CALL, budget), deadline=began + budget)
    if again is not None:
        limits = Limits(again.call_seconds)
    asked = design(words, dim, claims, integrands, seed, limits)
    state = State(asked, FALSE_ALARM, [], tuple(counts), budget, limits)
    special()  # an import that would be taken for the time of a first judgement
    try:
        _execute(state, again, progress)
    finally:
        if isinstance(asked.source, ChildSource):
            asked.source.process.close()
    for m in state.measurements:
        _look_for_faults(state, m)
    _look_for_small_bias(state)
    if state.faults and state.ended != "interrupted":
        state.ended = "fault"
    if state.ended not in ("fault", "interrupted"):
        state.scans = scans_of(state.measurements, _scan_level(state))
    state.fitted = tuple(_fits(state, again, began + budget))
    state.seconds = perf_counter() - began
    return state


def _execute(state: State, again: Execution | None, progress: Callable[[str], None]) -> None:
    """Measure, or replay, until the end or what comes before it."""
    try:
        if again is not None:
            _replay(state, again)
        else:
            _prepare(state, state.asked)
            _look_for_other_randomness(state)
            _measure(state, progress)
    except SamplerFault as fault:
        state.faults.insert(0, fault_of(fault_of_count(state.design.source, fault)))
    except OutOfTime as late:
        _stop(state, "budget")
        _blame(state, late)
    except KeyboardInterrupt:
        _stop(state, "interrupted")


def _stop(state: State, why: str) -> None:
    """End with what was measured."""
    state.ended = why
    for m in state.measurements:
        m.attempted = m.replicates


def _blame(state: State, late: OutOfTime) -> None:
    """A sampler that has never answered hangs, if the whole budget is the time of one call.

    While it is loaded nothing is blamed on it: to import a library may take long.
    """
    n, waited, budget = late.evidence.get("n"), late.evidence["seconds"], state.budget
    is_silent = not late.evidence["drawn"] and waited >= max(_SILENT * budget, _SHORTEST)
    if n is None or budget > _CALL or not is_silent:
        state.unanswered = {"n": n, "seconds": waited}
        return
    fault = unanswered(late, state.design.source.name, state.limits)
    state.faults.insert(0, fault_of(fault))


def _prepare(state: State, counts: Sequence[int]) -> None:
    """Choose the N, and predict for every claimed sampler."""
    asked = state.design
    integrands = all_integrands(asked)
    for n in ladder(asked, counts):
        state.measurements.append(Measurement(n, all_frequencies(asked, n), integrands))
    tests = len(asked.rate_claims)
    for claim in asked.claims:
        if not isinstance(claim, SamplerClaim):
            continue
        spectra = state.spectra[claim.text] = {}
        variances = state.variances[claim.text] = {}
        for m in state.measurements:
            spectrum = spectrum_predictions(claim.sampler, m.n, m.frequencies)
            if spectrum is not None:
                spectra[m.n] = spectrum
                variances[m.n] = variance_predictions(claim.sampler, m.n, m.integrands)
                tests += len(spectrum) + len(variances[m.n])
    if not asked.claims:  # the true sampler must stay among the matches
        tests = sum(len(m.frequencies) for m in state.measurements)
    share = 1 - _FAULT_SHARE - _SCAN_SHARE
    state.level = share * FALSE_ALARM / (max(tests, 1) * LOOKS)


def _look_for_other_randomness(state: State) -> None:
    """Whether the same realisation comes twice from a callable or a command."""
    source, n, seed = state.design.source, state.measurements[0].n, state.design.seed
    found = None
    if isinstance(source, ChildSource):
        found = global_state_fault(source, n, seed)
    elif isinstance(source, CommandSource):
        found = seed_fault(source, n, seed)
    state.faults += [] if found is None else [found]


def _scan_level(state: State) -> float:
    """Of the scans against one claimed sampler."""
    return _SCAN_SHARE * FALSE_ALARM / max(1, len(state.design.claimed_samplers))


def _bias_level(state: State) -> float:
    """Of one search for faults: there is one at each N, and coincidences have their part."""
    share = _FAULT_SHARE * FALSE_ALARM / len(state.measurements)
    return min(BIAS_LEVEL, share - COINCIDENCE_LEVEL)


def _fits(state: State, again: Execution | None, end: float) -> Iterator[FittedRegion]:
    """Fitted profiles, as many as end in time or a plan says; none of what says nothing."""
    if state.ended in ("fault", "interrupted"):
        return
    longest = fit_seconds(state.design.dim, [m.n for m in state.measurements if m.replicates > 1])
    regions, done = fitted_regions(state.measurements, state.design.dim), 0
    began = perf_counter()
    while done < again.fitted if again is not None else began + longest <= end:
        found = next(regions, None)
        if found is None:
            return
        yield found
        done, now = done + 1, perf_counter()
        longest, began = max(longest, now - began), now


def _end_of_measuring(state: State) -> float:
    """The deadline, less the time for the fits if they are a small part of the budget."""
    each = fit_seconds(state.design.dim, [m.n for m in state.measurements])
    aside = each * len(fitted_supports(state.design.dim))
    return state.limits.deadline - (aside if aside <= _SET_ASIDE * state.budget else 0.0)


def _replay(state: State, again: Execution) -> None:
    """Execute a plan's steps: what was measured, then what failed, so that a fault comes last."""
    has_failed = again.ended == "fault"
    if again.steps or has_failed:
        _prepare(state, [step.n for step in again.steps] or state.asked)
    if has_failed or any(step.attempted for step in again.steps):
        _look_for_other_randomness(state)
    steps = {step.n: step for step in again.steps}
    if steps and not steps.keys() >= {m.n for m in state.measurements}:
        raise InputError(f"a plan must list N that the source honours: got {sorted(steps)}")
    source, seed = state.design.source, state.design.seed
    executed = [(m, steps[m.n]) for m in state.measurements if steps]
    for m, step in executed:
        lengths = chain(step.chunks, repeat(whole_chunks(m)))
        grow(m, source, seed, step.replicates, length=lambda _, rest=lengths: next(rest))
        homogenise(m, seed, step.shifts)
        m.dropped = step.dropped
    for m, step in executed:
        grow(m, source, seed, step.attempted)
    state.ended, state.unanswered = again.ended, again.unanswered


def _measure(state: State, progress: Callable[[str], None]) -> None:
    """Rounds of doubling size, until all is decided, exhausted or late."""
    end = _end_of_measuring(state)
    running = tried(state, end)
    target = FIRST
    while target <= MOST:
        for m in running:
            if not grow_to(state, m, target, end):
                state.ended = "budget"
                return
            _look_for_faults(state, m)
        if state.faults:
            return
        began = perf_counter()
        outcomes: list[Outcome] = [j.outcome for j in judgements(state)]
        progress(f"{target} realisations at N = {', '.join(str(m.n) for m in running)}")
        exhausted = all(reachable(state, m, MOST) == m.replicates for m in running)
        if exhausted or _is_decided(state, outcomes):
            return
        end -= perf_counter() - began  # the last judgement comes when the measuring is over
        target *= 2


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
    found = find_faults(kept_points(m), _CELLS, _bias_level(state), kept_amplitudes(m))
    m.distinct = found.distinct
    known = {_what(f) for f in state.faults}  # one witness is enough, at the smallest N
    news = (Fault(f.kind, f.detail, {"n": m.n, **f.evidence}) for f in found.faults)
    state.faults += [f for f in news if _what(f) not in known]


def _look_for_small_bias(state: State) -> None:
    """Judge the means of all realisations, at the end, by the probes alone, which are bounded."""
    if any(f.kind in ("bias", "not homogenised") for f in state.faults):
        return
    for m in state.measurements:
        probes = {f.name: m.raw[f.name] for f in m.integrands if f.name.startswith("bernoulli")}
        found = measured_bias(m.n, probes)
        if found is not None:
            state.faults.append(found)
            return


def _what(fault: Fault) -> tuple[str, tuple[int, ...]]:
    """The kind of a fault, and the axes on which it shows."""
    return fault.kind, tuple(fault.evidence.get("axes", ()))
