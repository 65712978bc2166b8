"""Trials and rounds of a check: what is measured at each N, and which N are dropped as too costly.

Of every N a few realisations come first, which tell their cost. The largest N are dropped until a
first round of the others ends in time; the smallest is kept whatever it costs.
"""

from dataclasses import dataclass, field
from time import perf_counter

from ...theory.errors import InputError
from ..measuring.measurements import Measurement, grow, homogenise, whole_chunks
from ..measuring.paces import SLICE, TRIED, chunk_length, foretold_cost, within
from ..point_sources.catalogue_source import CatalogueSource
from .judgements import FIRST, State

MOST = 1 << 14
"""Replicates at most."""

_SHIFTS = 1024  # random shifts of a frozen point set
_ROUND_SHARE = 0.8  # of the time left, at most, for the first round
_COSTLY = 0.25  # of the time left: what one realisation must not cost
_DEAR = 0.02  # of the time left: from which on a single realisation is tried
_SUSPECT = 0.2  # of the time left: what a first round may cost without a second look
_TRIAL_SHARE = 0.1  # of the time left, for each further look


@dataclass
class _Costs:
    """Seconds per realisation: at each N among few, which can be compared; of the smallest N,
    what it costs less in a whole chunk than among few, and what it costs there."""

    among_few: list[tuple[int, float]] = field(default_factory=list[tuple[int, float]])
    saved: float = 0.0
    least: float = 0.0


def tried(state: State, end: float) -> list[Measurement]:
    """The measurements of which a first round ends in time, after a few realisations of each.

    As long as there is time for whole chunks, these are the same whatever the clock says.

    Raises
    ------
    InputError
        If an N that was asked for is beyond the reach of its generator.
    """
    costs = _Costs()
    kept = [m for m in state.measurements if _is_kept(state, m, end, costs)]
    if perf_counter() > end:
        return kept
    rounds = [(m.cost or 0.0) * (reachable(state, m, FIRST) - m.replicates) for m in kept]
    count = within(rounds, _ROUND_SHARE * (end - perf_counter()))
    for m in kept[count:]:
        _drop(state, m, m.cost or 0.0)
    return kept[:count]


def _is_kept(state: State, m: Measurement, end: float, costs: _Costs) -> bool:
    """Try one N, unless it is foretold that a realisation takes too long."""
    if not costs.among_few:
        _try_first(state, m, end, costs)
        return True
    left = end - perf_counter()
    if left <= 0:
        return True
    power = 1.0 if isinstance(state.design.source, CatalogueSource) else 0.0
    foretold = foretold_cost(costs.among_few, m.n, power) or 0.0
    if foretold > _COSTLY * left:
        _drop(state, m, foretold)
        return False
    try:
        _try_next(state, m, end, 1 if foretold > _DEAR * left else TRIED, costs)
    except InputError as error:  # beyond the reach of the generator
        if m.n in state.asked:
            raise
        m.attempted, m.dropped = m.replicates, str(error)
        return False
    return True


def _try_first(state: State, m: Measurement, end: float, costs: _Costs) -> None:
    """Half a first round of the smallest N.

    The first few are not counted: with them come imports, and whatever else is done once.
    """
    for count in (TRIED, 2 * TRIED):
        grow_to(state, m, reachable(state, m, count), end, shifts=False)
    few = m.cost or 0.0
    grow_to(state, m, reachable(state, m, FIRST // 2), end, shifts=False)
    costs.least = m.cost or few
    costs.saved = max(few - costs.least, 0.0)
    costs.among_few.append((m.n, few))


def _try_next(state: State, m: Measurement, end: float, count: int, costs: _Costs) -> None:
    """A few realisations of another N.

    Where a first round seems to take long, more are drawn together, since some samplers cost
    hardly more by the chunk.
    """
    grow_to(state, m, reachable(state, m, count), end, shifts=False)
    few = m.cost or 0.0
    costs.among_few.append((m.n, few))
    m.cost = max(few - costs.saved, costs.least)
    for _ in range(2):
        left, cost = end - perf_counter(), m.cost
        share = _TRIAL_SHARE * left
        more = chunk_length(whole_chunks(m), cost, share, share / SLICE)
        if FIRST * cost <= _SUSPECT * left or more < TRIED:
            return
        grow_to(state, m, reachable(state, m, m.replicates + more), end, shifts=False)
        m.cost = min(m.cost, cost)


def _drop(state: State, m: Measurement, cost: float) -> None:
    m.dropped = (
        f"too costly for the budget of {state.budget:.3g} s: about {cost:.2g} s a realisation, "
        f"of which a first round has {reachable(state, m, FIRST)}"
    )


def grow_to(state: State, m: Measurement, target: int, end: float, shifts: bool = True) -> bool:
    """Measure until the target, or as far as there is something; False if it is late."""
    source, seed = state.design.source, state.design.seed

    def length(m: Measurement) -> int:
        left = end - perf_counter()
        return chunk_length(whole_chunks(m), m.cost, left, state.budget)

    grow(m, source, seed, reachable(state, m, target), end, length)
    if m.replicates < reachable(state, m, target):
        return False
    if shifts and reachable(state, m, MOST) == 1:
        homogenise(m, seed, _SHIFTS, end)
    return perf_counter() <= end


def reachable(state: State, m: Measurement, target: int) -> int:
    held = state.design.source.realisations
    return target if held is None else min(target, held[m.n])
