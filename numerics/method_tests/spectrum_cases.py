"""Stiff cases of N·P_S: 1 × 10^9 strata, frequencies at and next to multiples of the strata."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...theory.samplers import Sampler, parse_sampler
from ..balls import certified
from ..expected_spectra.spectra import power_array, scaled_power
from ..expected_spectra.spectrum_balls import scaled_power_ball
from ..integrands.protocol import mp
from .stress import DIGITS, Family, Method, Outcome, Reference, number_text

_WORKED = 30  # digits asked of mpmath


@dataclass(frozen=True)
class SpectrumProblem:
    """N·P_S of a sampler with the admissible N nearest to n, at the frequency m."""

    sampler: Sampler
    counts: Mapping[str, int]
    m: tuple[int, ...]


def _spectrum(sampler: str, n: int, m: tuple[int, ...]) -> tuple[str, SpectrumProblem]:
    found = parse_sampler(sampler, len(m))
    assert found.counts_at is not None
    shown = ", ".join(map(str, m)) if len(m) < 4 else f"{m[0]}, ..., {m[-1]}"
    return f"{sampler}, N = {number_text(n)}, m = ({shown})", SpectrumProblem(
        found, found.counts_at(n), m
    )


_LONG = 10**9  # strata along one axis
_SIDE = 10**6
_FREQUENCIES = ((1, 1), (_SIDE, _SIDE), (_SIDE + 1, _SIDE), (2 * _SIDE - 1, 1), (_SIDE, 0))

SPECTRUM_PROBLEMS: tuple[tuple[str, SpectrumProblem], ...] = (
    *(
        _spectrum(f"{family}:1x{_LONG}", _LONG, m)
        for family in ("jitter", "regular")
        for m in ((0, 1), (0, _LONG - 1), (0, _LONG), (0, _LONG + 1), (3, _LONG), (1, 1))
    ),
    *(
        _spectrum(sampler, _SIDE**2, m)
        for sampler in ("jitter", "multi-jitter", "correlated-multi-jitter")
        for m in (*_FREQUENCIES, (_SIDE**2, 1), (_SIDE**2 + 1, _SIDE**2 - 1))
    ),
    *(
        _spectrum("latin-hypercube", _LONG, m)
        for m in ((1, 1), (1, 0), (_LONG, 1), (_LONG + 1, _LONG - 1))
    ),
    *(
        _spectrum("uncorrelated-jitter:1+2", 10**12, m)
        for m in ((1, 0, 0), (10**12 - 1, 0, 0), (0, 1, 1), (10**12 - 1, _SIDE, _SIDE + 1))
    ),
    _spectrum("latin-hypercube", 10**100, (1,) * 1000),
    _spectrum("latin-hypercube", 10**300, (1, 10**18)),
)


def _by_power_array(problem: SpectrumProblem) -> Outcome:
    m = np.array([problem.m], dtype=np.int64)
    n = problem.counts["N"]
    value = float(power_array(problem.sampler, problem.counts, m)[0])
    with mp.workdps(_WORKED):
        return Outcome(mp.mpf(value) * n, mp.mpf("1e-13") * value * n, "estimate")


def _by_scaled_power(problem: SpectrumProblem) -> Outcome:
    with mp.workdps(_WORKED):
        value = scaled_power(problem.sampler, problem.counts, problem.m)
        return Outcome(value, abs(value) * mp.mpf(10) ** (1 - _WORKED), "estimate")


SPECTRA: Family[SpectrumProblem] = Family(
    "N P_S",
    SPECTRUM_PROBLEMS,
    (Method("doubles", _by_power_array), Method("mpmath", _by_scaled_power)),
    (
        Reference(
            "balls",
            lambda p: certified(lambda: scaled_power_ball(p.sampler, p.counts, p.m), DIGITS),
        ),
    ),
)
