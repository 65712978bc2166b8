"""What a check leaves out, and why."""

from collections.abc import Iterator, Sequence
from math import comb

from ...theory.claims import RateClaim
from ..integrands.protocol import Integrand
from ..measuring.measurements import Measurement
from ..measuring.probes import integrand_supports, probed_supports
from .fitted_profiles import fitted_supports, used_realisations
from .judgements import Judgement, State
from .structures import Structures


def left_out(
    state: State, found: Sequence[Judgement], shown: Structures | None = None
) -> list[dict[str, str]]:
    """Entries of the document: what, and why."""
    return [
        {"what": what, "why": why}
        for part in (
            _fits(state),
            _spectra(state),
            _blocks(shown),
            _counts(state),
            _variances(state),
            _exponents(found),
        )
        for what, why in part
    ]


def _fits(state: State) -> Iterator[tuple[str, str]]:
    """Regions and N without a fitted profile."""
    supports, dim = fitted_supports(state.design.dim), state.design.dim
    why = None
    if state.ended in ("fault", "interrupted"):
        why = "a fault voids them" if state.ended == "fault" else "the check was interrupted"
    elif not any(used_realisations(m, dim) > 1 for m in state.measurements):
        why = "no N has two realisations, with which an expected spectrum can be estimated"
    elif len(state.fitted) < len(supports):
        why = "the budget was spent"
    if why is not None:
        names = ", ".join(_braced(s) for s in supports[len(state.fitted) :])
        yield f"fitted profiles of {names}", why
        return
    for m in state.measurements:
        if m.replicates > 1 and not m.is_frozen and used_realisations(m, dim) < 2:
            yield f"fitted profiles at N = {m.n}", "waves at so many points take too long for a fit"
    if len(supports) < 2**dim - 1:
        names = ", ".join(_braced(s) for s in supports)
        yield "fitted profiles on other regions", f"fitted are {names}"


def _blocks(shown: Structures | None) -> Iterator[tuple[str, str]]:
    if shown is None:
        yield "blocks", "no N has two different realisations without a fault"
    elif shown.blocks is None:
        yield "blocks", shown.why


def _spectra(state: State) -> Iterator[tuple[str, str]]:
    d = state.design.dim
    if state.design.claims and not state.design.claimed_samplers:
        yield "spectrum and catalogue matches", "only exponents are claimed"
        return
    probed = probed_supports(d)
    if len(probed) < 2**d - 1:
        triples = sum(len(s) == 3 for s in probed)
        which = "triples" if triples == comb(d, 3) else "triples of neighbours"
        pairs = sum(len(s) == 2 for s in probed)
        which = f"{'pairs' if pairs == comb(d, 2) else 'pairs of neighbours'}, {which}"
        yield "spectra on other supports", f"axes, {which} and the full support are probed"
    if d > 3:
        kept = ", ".join(_braced(s) for s in integrand_supports(d))
        yield "variances on other supports", f"integrands probe {kept}; spectra probe more"


def _braced(support: tuple[int, ...]) -> str:
    if len(support) > 3:
        return f"{{{support[0]}..{support[-1]}}}"
    return "{" + ",".join(map(str, support)) + "}"


def _counts(state: State) -> Iterator[tuple[str, str]]:
    for m in state.measurements:
        if m.dropped is not None:
            yield f"N = {m.n}", m.dropped
    measured = {m.n for m in state.measurements}
    for n in state.asked:
        if n not in measured:
            near = min(measured, key=lambda m: abs(m - n), default=None)
            yield f"N = {n}", f"the source honours {near} there"
    for m in state.measurements:
        for text, by_n in state.spectra.items():
            if m.n not in by_n:
                yield f"{text} at N = {m.n}", "the claimed sampler has no such number of points"
    if measured and state.design.claimed_samplers:
        yield f"N above {max(measured)}", "a defect that sets in at more points is not seen"
    yield from _single(state.measurements)
    yield from _late(state)
    held = state.design.source.realisations
    if held is not None and any(m.replicates == held[m.n] for m in state.measurements):
        yield "more realisations", "the files hold no more, and no budget gives more"


def _late(state: State) -> Iterator[tuple[str, str]]:
    """What the sampler was asked for when the budget was spent."""
    if state.unanswered is None:
        return
    n = state.unanswered["n"]
    what = "all measurements" if n is None else f"more realisations of N = {n}"
    asked = "was being loaded" if n is None else "had been asked and had not answered"
    yield what, f"the sampler {asked} when the budget was spent"


def _single(measurements: Sequence[Measurement]) -> Iterator[tuple[str, str]]:
    """What one realisation cannot tell, whether there is no other or all are the same."""
    if single := [m.n for m in measurements if m.replicates == 1 or m.is_frozen]:
        why = "one realisation has one |F|²: no expectation, and no claim is judged on it"
        yield f"spectrum at N = {', '.join(map(str, single))}", why
    if frozen := [m for m in measurements if m.is_frozen]:
        shifts = ", ".join(str(m.shifts) for m in frozen)
        why = f"homogenised: the one point set is moved by random shifts, {shifts} of them"
        yield f"variance over realisations at N = {', '.join(str(m.n) for m in frozen)}", why


def _variances(state: State) -> Iterator[tuple[str, str]]:
    """Integrands that have no exact variance under a claimed sampler."""
    integrands: tuple[Integrand, ...] = (
        state.measurements[0].integrands if state.measurements else ()
    )
    for text, by_n in state.variances.items():
        for f in integrands:
            if by_n and not any(f.name in values for values in by_n.values()):
                why = "no product, in more than three dimensions or under combs of too many teeth"
                yield f"exact variance of {f.name} under {text}", why


def _exponents(found: Sequence[Judgement]) -> Iterator[tuple[str, str]]:
    for j in found:
        if isinstance(j.claim, RateClaim) and j.outcome == "open" and j.drift is not None:
            low = j.drift.low
            if low is not None and low > j.claim.exponent:
                why = (
                    "the variance still falls faster at the N measured; a crossover to the claimed "
                    "order beyond them cannot be excluded by measuring"
                )
                yield f"a decision on {j.claim.text}", why
