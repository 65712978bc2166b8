"""For your own test suite: an assertion on a sampler design, and Hypothesis strategies of designs.

`assert_design` runs a check and fails with the faults and witnesses found. A sampler may be given
as a Python function: one that another interpreter can import by name is checked as
``module:name``, in a process of its own. Any other, a lambda or a local function, is drawn in this
process, as many realisations as half of the budget allows, and checked like point files: nothing
then guards against a call that never returns.
"""

import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..theory.claims import RateClaim, SamplerClaim, parse_claim
from ..theory.errors import InputError
from .checking.check_documents import Document, check
from .checking.designs import checked_claims, whole_dim
from .falsification.design_strategies import NamedSampler, counts, integrands, layouts
from .falsification.falsifiers import SamplerFunction
from .point_sources.catalogue_source import counts_of
from .point_sources.imports import refuse_unless_source, word_of
from .point_sources.realisations import SamplerFault
from .point_sources.sources import CallableSource

__all__ = ["NamedSampler", "assert_design", "counts", "integrands", "layouts", "word_of"]

_HERE, _POINTS = 2048, 1 << 21  # realisations and points at each N drawn in this process
_LEAST = 128  # with fewer nothing is contradicted
_SPECTRA, _RATES = (16, 64, 256), (16, 64, 256, 1024, 4096)  # N drawn in this process


def assert_design(
    sampler: str | Sequence[str] | SamplerFunction,
    dim: int,
    claims: Sequence[str] = (),
    budget: float = 10.0,
    seed: int = 0,
    *,
    strict: bool = False,
) -> Document:
    """Fail if a sampler has a fault or is not what it is claimed to be.

    Parameters
    ----------
    sampler : str, sequence of str or callable
        A source as `check` takes it, or a function (n, dim, rng).
    dim : int
    claims : sequence of str
        Catalogue samplers, or ``REGION/CLASS ~ EXPONENT [log Q]``; without any, only faults fail.
    budget : float
        Seconds, a cap. Whatever has not been decided then does not fail, unless nothing at all
        was measured.
    seed : int
        Of all random numbers.
    strict : bool
        Whether what stays undecided fails too.

    Returns
    -------
    dict
        The document of the check.

    Raises
    ------
    AssertionError
        If the verdict is invalid or contradicted, or with strict not consistent. Its lines are the
        verdict, the faults, and each claim with its witness. A correct sampler that has no fault
        fails with a probability of at most 1e-5, unless strict. In one line, with the reason and
        the budget, if nothing was measured.
    InputError
        If anything asked for is unusable.
    """
    refuse_unless_source(sampler)
    dim, claims = whole_dim(dim), checked_claims(claims)
    words = word_of(sampler) if callable(sampler) else sampler
    if callable(sampler) and words is None:
        found = _checked_here(sampler, dim, claims, budget, seed)
    else:
        assert words is not None
        found = check(words, dim, claims, budget=budget, seed=seed)
    verdict, name = found["verdict"], getattr(sampler, "__qualname__", None)
    name = name or " ".join(found["plan"]["sources"])
    if found["n_range"] is None and not found["faults"]:
        raise AssertionError(_nothing_measured(found, name, budget))
    if verdict in ("invalid", "contradicted") or (strict and verdict != "consistent"):
        raise AssertionError("\n".join(verdict_lines(found, name)))
    return found


def _nothing_measured(found: Document, name: str, budget: float) -> str:
    """Why a check says nothing, in one line."""
    late = found["plan"]["unanswered"] is not None
    why = next((x["why"] for x in found["left_out"] if x["what"].startswith("all ")), None)
    reasons = "; ".join(f"{x['what']}: {x['why']}" for x in found["left_out"])
    told = why if late and why is not None else reasons
    rule = f"{name} in {found['plan']['dim']}D must be measured within a budget of {budget:g} s"
    return f"{rule}: got nothing, {told or 'without a reason'}"


def _checked_here(
    function: SamplerFunction, dim: int, claims: Sequence[str], budget: float, seed: int
) -> Document:
    """The check of realisations drawn in this process."""
    if not 0 < budget < float("inf"):
        raise InputError(f"the budget must be a positive number of seconds: got {budget}")
    name = getattr(function, "__qualname__", repr(function))
    parsed = [parse_claim(c, dim) for c in claims]
    source = CallableSource(name, function, dim)
    try:
        numbers = _numbers(source, parsed)
        first, again = (source.realise(numbers[0], seed, range(1)) for _ in range(2))
        if not np.array_equal(first, again):
            rule = "equal generators must give equal points"
            raise AssertionError(f"{name} in {dim}D is invalid\nfault global random state: {rule}")
        with tempfile.TemporaryDirectory() as folder:
            files = _stored(source, numbers, seed, budget / 2, Path(folder))
            return check(files, dim, claims, budget=budget / 2, seed=seed)
    except SamplerFault as fault:
        raise AssertionError(f"{name} in {dim}D is invalid\nfault {fault}") from fault


def _numbers(source: CallableSource, claims: Sequence[SamplerClaim | RateClaim]) -> list[int]:
    """N that the function honours, near those of the claims; a ladder where a rate is claimed."""
    wanted = {t for c in claims if isinstance(c, RateClaim) for t in _RATES}
    samplers = [c.sampler for c in claims if isinstance(c, SamplerClaim)]
    wanted |= {counts_of(s, t)["N"] for s in samplers for t in (*_SPECTRA, 2**source.dim)}
    return sorted({source.admissible(n) for n in wanted or set(_SPECTRA) if n >= 2})[:8]


def _stored(
    source: CallableSource, numbers: Sequence[int], seed: int, seconds: float, folder: Path
) -> list[str]:
    """Files of realisations, as many at each N as the time and the memory allow."""
    parts: dict[int, list[np.ndarray[Any, Any]]] = {n: [] for n in numbers}
    began, drawn = time.perf_counter(), 0
    while drawn < _HERE and (drawn < _LEAST or time.perf_counter() < began + seconds):
        for n in (n for n in numbers if drawn < max(_LEAST, _POINTS // n)):
            parts[n].append(source.realise(n, seed, range(drawn, drawn + 64)))
        drawn += 64
    files: list[str] = []
    for n, points in parts.items():
        file = folder / f"{n}.npy"
        np.save(file, np.concatenate(points))
        files.append(str(file))
    return files


def verdict_lines(found: Document, name: str) -> list[str]:
    """The verdict of a check in words: the faults, then each claim with its witness."""
    lines = [f"{name} in {found['plan']['dim']}D is {found['verdict']}"]
    lines += [f"fault {f['kind']}: {f['detail']}" for f in found["faults"]]
    for c in found["claims"]:
        word = {True: "holds", False: "FAILS", None: "is undecided"}[c["holds"]]
        lines.append(f"claim {c['claim']} {word}{_witness_text(c['witness'])}")
    if found["budget_needed"] is not None:
        lines.append(f"a budget of about {found['budget_needed']['seconds']:.0f} s would decide")
    return lines


def _witness_text(w: Document | None) -> str:
    if w is None:
        return ""
    if w["what"] == "exponent":
        return f": chi^2 of the exponent {w['chi2']:.3g}, excluded above {w['threshold']:.3g}"
    low, high = w["measured"]["low"], w["measured"]["high"]
    shown = f"[{low:.4g}, {'oo' if high is None else format(high, '.4g')}]"
    at = w["at"] if isinstance(w["at"], str) else f"m = ({', '.join(map(str, w['at']))})"
    return f": {w['what']} at {at}, N = {w['n']}: measured {shown}, claimed {w['predicted']:.4g}"
