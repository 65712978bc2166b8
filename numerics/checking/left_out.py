"""What a check leaves out, and why."""

from collections.abc import Iterator, Sequence

from ...theory.claims import RateClaim
from ..integrands.protocol import Integrand
from ..measuring.measurements import Measurement
from ..measuring.probes import integrand_supports
from .judgements import Judgement, State


def left_out(state: State, found: Sequence[Judgement]) -> list[dict[str, str]]:
    """Entries of the document: what, and why."""
    return [
        {"what": what, "why": why}
        for part in (_spectra(state), _counts(state), _variances(state), _exponents(found))
        for what, why in part
    ]


def _spectra(state: State) -> Iterator[tuple[str, str]]:
    d = state.design.dim
    yield "fitted profile", "degree and effective count per region are not yet fitted to the data"
    if state.design.claims and not state.design.claimed_samplers:
        yield "spectrum and catalogue matches", "only exponents are claimed"
    elif d > 3:
        yield "supports of 3 coordinates and more", "axes, pairs and the full support are probed"
        kept = ", ".join(_braced(s) for s in integrand_supports(d))
        yield "variances on other supports", f"integrands probe {kept}; spectra probe the rest"


def _braced(support: tuple[int, ...]) -> str:
    if len(support) > 3:
        return f"{{{support[0]}..{support[-1]}}}"
    return "{" + ",".join(map(str, support)) + "}"


def _counts(state: State) -> Iterator[tuple[str, str]]:
    measured = {m.n for m in state.measurements}
    for n in state.asked:
        if n not in measured:
            near = min(measured, key=lambda m: abs(m - n), default=None)
            yield f"N = {n}", f"the source honours {near} there"
    for m in state.measurements:
        for text, by_n in state.spectra.items():
            if m.n not in by_n:
                yield f"{text} at N = {m.n}", "the claimed sampler has no such number of points"
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
