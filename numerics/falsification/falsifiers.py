"""Falsifiers: the simplest integrand, in the smallest dimension, that shows a claim to be wrong.

A search looks at many candidates on one set of realisations, so that what it finds there proves
nothing. It has two steps:

1. *Exploration.* At a few N, P_S(k) is estimated for every low frequency k, then for frequencies
   near the numbers of strata that Hypothesis proposes and shrinks. What lies outside an interval
   of level 1e-4 about the estimate is suspect.
2. *Confirmation.* The simplest suspect's ridge B_2({k·x}) is integrated on fresh realisations,
   each randomly shifted, and its variance compared with the exact prediction of the claim. There
   are at most 16 confirmations, each on realisations of its own at a level of 1e-5/16, so that a
   correct claim is contradicted with a probability of at most 1e-5, as far as the intervals keep
   their level (they are approximate, as those of a check).

For a claimed rate the candidates are the integrands with which a check probes the claimed region,
on a ladder of N, and both steps use the test that allows for drift.
"""

import contextlib
import time
from collections.abc import Callable, Generator, Iterable, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...theory.claims import RateClaim, SamplerClaim, parse_claim
from ...theory.errors import InputError
from ...theory.samplers import Sampler, family_of
from ..checking.designs import whole_dim
from ..checking.verdicts import (
    FALSE_ALARM,
    LEAST,
    compare,
    spectrum_predictions,
    variance_predictions,
)
from ..integrands.ridge import Ridge
from ..measuring.moments import Moments, update, variance_interval
from ..measuring.probes import Frequency, amplitudes, strata_of_claim
from ..measuring.tails import is_seen
from ..point_sources.catalogue_source import counts_of, open_source
from ..point_sources.child_processes import Limits, OutOfTime, unanswered
from ..point_sources.imports import refuse_unless_source, word_of
from ..point_sources.realisations import SamplerFault
from ..point_sources.sources import CallableSource
from .exact_falsifiers import falsify_exactly
from .low_frequencies import canonical, low_frequencies, simplicity
from .searches import (
    LEVEL,
    SUSPICION,
    AnySource,
    Search,
    Tally,
    drawn,
    hypothesis,
    search_settings,
    shifted_errors,
)
from .slow_variances import slow_variance
from .witnesses import Witness

SamplerFunction = Callable[[int, int, np.random.Generator], object]
"""A sampler of the user: (n, dim, rng) to points of shape (n, dim) in [0, 1)."""

_EXPLORED, _CONFIRMED = 256, 1024  # realisations
_PROPOSED = 100  # candidates that Hypothesis may propose, before it shrinks
_SILENT = 0.5  # share of the budget that one call may take
_MOST_POINTS, _MOST_STORED = 256, 4096  # of a realisation that is drawn, and from a file


def falsify(
    source: str | Sequence[str] | SamplerFunction,
    claim: str,
    dims: Sequence[int] = (1, 2, 3),
    seed: int = 0,
    budget: float = 10.0,
) -> Witness | None:
    """Search for the simplest witness against a claim on a sampler.

    Parameters
    ----------
    source : str, sequence of str or callable
        As for `check`, or a function (n, dim, rng). One that another interpreter can import by
        name is drawn in a child process with limits, so that a script must guard what it runs by
        ``if __name__ == "__main__"``; any other, a lambda or a local function, in
        this process, where nothing guards against a call that never returns or that ends the
        process. A catalogue sampler is judged by its exact spectrum, and nothing is drawn.
    claim : str
        A catalogue sampler, or REGION/CLASS ~ EXPONENT [log Q].
    dims : sequence of int
        Searched in increasing order; those that the sampler or the claim has not are passed over.
    seed : int
        Of all random numbers.
    budget : float
        Seconds, a cap, for all dimensions together. A search that no cap ends repeats itself.

    Returns
    -------
    Witness or None
        With a low frequency if there is one: in the smallest dimension, there at the lowest
        frequency, there at the smallest N. Else near the numbers of strata. None says that none
        was found, not that the claim is right. A variance that falls faster than claimed is no
        witness.

    Raises
    ------
    InputError
        If no dimension has both the sampler and the claim, the sampler has a fault in all that
        could be searched or does not answer within the budget, or hypothesis is not installed.
    """
    _refuse_unusable(source, claim, dims, seed, budget)
    if isinstance(source, str) and family_of(source) is not None:
        return falsify_exactly(source, claim, dims)
    hypothesis()
    deadline, tally = time.perf_counter() + budget, Tally()
    limits = Limits(min(60.0, budget), deadline=deadline)
    with contextlib.ExitStack() as opened:
        usable: list[_Explored] = []
        refusals: list[InputError | SamplerFault] = []
        every = sorted(set(dims))
        for dim in every:
            try:
                parsed = parse_claim(claim, dim)
                found = opened.enter_context(_opened(source, dim, limits))
                search = Search(found, claim, seed, deadline, tally)
                witness = _first_look(search, parsed, usable)
            except OutOfTime as late:
                if len(refusals) == every.index(dim):  # nothing has been searched before
                    _refuse_silent(late, refusals, budget, limits)
                return None
            except (InputError, SamplerFault) as error:
                refusals.append(error)
                continue
            if witness is not None or search.is_over:
                return witness
        if len(refusals) == len(every):
            _refuse_fault(refusals)
            rule = "the sampler and the claim must be usable in one of the dimensions"
            raise InputError(f"{rule} {', '.join(map(str, every))}: got {refusals[-1]}")
        return _second_look(usable)


def _refuse_unusable(source: Any, claim: Any, dims: Any, seed: int, budget: float) -> None:
    refuse_unless_source(source)
    if not isinstance(claim, str):
        raise InputError(f"a claim must be a text: got {claim!r}")
    rule = "a search needs dims >= 1, seed >= 0 and 0 < budget"
    if isinstance(dims, str) or not isinstance(dims, Iterable):
        raise InputError(f"{rule}, dims being a list of whole numbers: got {dims!r}")
    every = tuple(map(whole_dim, cast("Iterable[object]", dims)))
    if not every or seed < 0 or not 0 < budget < float("inf"):
        raise InputError(f"{rule}: got {every}, {seed} and {budget}")


def _refuse_silent(
    late: OutOfTime, refusals: Sequence[InputError | SamplerFault], budget: float, limits: Limits
) -> None:
    """Refuse a sampler with a fault, without an answer, or whose one call took half the budget."""
    _refuse_fault(refusals)
    if late.evidence["drawn"] and late.evidence["seconds"] < _SILENT * budget:
        return
    if "n" not in late.evidence:
        raise InputError(f"{late.detail} within the budget of {budget:g} s")
    name = late.detail.split(" must answer", 1)[0]
    raise InputError(unanswered(late, name, limits).detail)


def _refuse_fault(refusals: Sequence[InputError | SamplerFault]) -> None:
    """Refuse a sampler that has shown a fault; the first tells it."""
    for found in refusals:
        if isinstance(found, SamplerFault):
            raise InputError(found.detail) from found


@contextlib.contextmanager
def _opened(
    source: str | Sequence[str] | SamplerFunction, dim: int, limits: Limits
) -> Generator[AnySource]:
    """The source in a dimension; its process is ended afterwards."""
    named = word_of(source) if callable(source) else source
    if named is None:
        assert callable(source)
        yield CallableSource(getattr(source, "__qualname__", repr(source)), source, dim)
        return
    words = [named] if isinstance(named, str) else list(named)
    opened = open_source(words, dim, limits)
    try:
        yield opened
    finally:
        process: Any = getattr(opened, "process", None)
        if process is not None and hasattr(process, "close"):
            process.close()


@dataclass(frozen=True)
class _Explored:
    """A dimension whose low frequencies have shown nothing, with the realisations looked at."""

    search: Search
    claimed: Sampler
    points: dict[int, NDArray[np.float64]]


def _first_look(
    search: Search, claim: SamplerClaim | RateClaim, usable: list[_Explored]
) -> Witness | None:
    """Low frequencies, or a claimed rate; what else there is to look at is added to usable."""
    if isinstance(claim, RateClaim):
        return slow_variance(search, claim)
    claimed = claim.sampler
    points = {n: drawn(search, n, 0, _EXPLORED) for n in _numbers(search.source, claimed)}
    points = {n: p for n, p in points.items() if len(p) >= LEAST}
    if search.is_over:
        return None
    if not points:
        rule = f"the source must have {LEAST} realisations at an N of {claimed.name}"
        raise InputError(f"{rule}: got none")
    for k, n in _low_suspects(claimed, points):
        found = None if search.is_over else _confirmed(search, claimed, k, n)
        if found is not None:
            return found
    usable.append(_Explored(search, claimed, points))
    return None


def _second_look(usable: Sequence[_Explored]) -> Witness | None:
    """Frequencies that Hypothesis proposes, one dimension after the other."""
    for explored in usable:
        try:
            found = _proposed(explored.search, explored.claimed, explored.points)
        except (OutOfTime, SamplerFault):
            return None
        if found is not None:
            return found
    return None


def _numbers(source: AnySource, claimed: Sampler) -> list[int]:
    """A few N, small ones first, that both have."""
    dim = source.dim
    powers = {t**dim for t in (2, 3, 4) if t**dim <= _MOST_POINTS}
    wanted = source.counts or {counts_of(claimed, t)["N"] for t in (16, 64, 256, *powers)}
    most = _MOST_POINTS if source.counts is None else _MOST_STORED
    honoured = {source.admissible(n) for n in wanted if 2 <= n <= most}
    return sorted(n for n in honoured if n >= 2 and counts_of(claimed, n)["N"] == n)[:5]


def _low_suspects(
    claimed: Sampler, explored: dict[int, NDArray[np.float64]]
) -> list[tuple[Frequency, int]]:
    """Low frequencies at which the explored spectrum is not the claimed one, simplest first."""
    wanted = low_frequencies(int(claimed.dim), 4 if claimed.dim <= 4 else 2)
    found: list[tuple[Frequency, int]] = []
    for n, points in explored.items():
        predicted = spectrum_predictions(claimed, n, wanted) or {}
        powers = np.abs(amplitudes(points, wanted))
        found += [
            (k, n) for k, row in zip(wanted, powers, strict=True) if _is_suspect(row, predicted[k])
        ]
    return sorted(found, key=lambda f: (simplicity(f[0]), f[1]))


def _is_suspect(amplitude: NDArray[np.float64], predicted: float) -> bool:
    interval = variance_interval(update(Moments(), amplitude), SUSPICION)
    return compare(interval, predicted, 1e-13 * predicted, len(amplitude)) == "fails"


def _proposed(
    search: Search, claimed: Sampler, explored: dict[int, NDArray[np.float64]]
) -> Witness | None:
    """Frequencies near the numbers of strata, as Hypothesis proposes and shrinks them."""
    tried: set[tuple[Frequency, int]] = set()

    def is_suspect(candidate: tuple[int, Frequency]) -> bool:
        n, k = candidate[0], canonical(candidate[1])
        if (k, n) in tried or time.perf_counter() > search.deadline:
            return False
        predicted = spectrum_predictions(claimed, n, [k]) or {}
        return _is_suspect(np.abs(amplitudes(explored[n], [k]))[0], predicted[k])

    found_by, random, settings = hypothesis(), Random(search.seed), search_settings(_PROPOSED)
    while not search.is_over:
        try:
            n, k = found_by.find(
                _candidates(claimed, sorted(explored)), is_suspect, settings=settings,
                random=random,
            )  # fmt: skip
        except found_by.errors.NoSuchExample:
            return None
        found = _confirmed(search, claimed, canonical(k), n)
        if found is not None:
            return found
        tried.add((canonical(k), n))
    return None


def _candidates(claimed: Sampler, numbers: Sequence[int]) -> Any:
    """Pairs of an N and a frequency with entries small, or near the numbers of strata there."""
    st, dim = hypothesis().strategies, int(claimed.dim)

    def of_count(n: int) -> Any:
        strata = {*strata_of_claim(claimed, n), n, round(n ** (1 / dim)), round(n**0.5)}
        near = sorted({c * j + e for c in strata for j in (1, 2) for e in (-1, 0, 1)} - {0})
        entry = st.one_of(st.just(0), st.integers(-8, 8), st.sampled_from(near))
        vector = st.lists(entry, min_size=dim, max_size=dim).filter(any).map(tuple)
        return st.tuples(st.just(n), vector)

    return st.sampled_from(list(numbers)).flatmap(of_count)


def _confirmed(search: Search, claimed: Sampler, k: Frequency, n: int) -> Witness | None:
    """The ridge along k on fresh realisations, against its exact variance."""
    ridge = Ridge(k, 2)
    exact = variance_predictions(claimed, n, [ridge]).get(ridge.name)
    start = _EXPLORED + search.tally.spent * _CONFIRMED
    search.tally.spent += 1
    if exact is None:
        return None
    moments = shifted_errors(search, ridge, drawn(search, n, start, _CONFIRMED))
    if moments.count < LEAST:
        return None
    interval, predicted = variance_interval(moments, LEVEL), float(exact.value)
    seen = is_seen(ridge, n, moments.count)
    if compare(interval, predicted, float(exact.error_bound), moments.count, seen) != "fails":
        return None
    return Witness(
        search.source.name, search.claim, search.dim, n, k, ridge.name, "variance", interval,
        predicted, FALSE_ALARM, moments.count,
    )  # fmt: skip
