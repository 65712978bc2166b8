"""Admissible numbers of points of a layout: which N it has, counted and as a law."""

from collections.abc import Sequence
from functools import lru_cache
from math import lcm

from .samplers import Sampler
from .symbolic import sympy

_SAMPLED = 1024


@lru_cache(maxsize=256)
def admissible_counts(sampler: Sampler) -> tuple[int, ...]:
    """Numbers of points in 2..1024 that the layout has."""
    assert sampler.counts_at is not None
    found = {sampler.counts_at(n)["N"] for n in range(2, _SAMPLED + 1)}
    return tuple(sorted(n for n in found if 2 <= n <= _SAMPLED))


def law_text(sampler: Sampler, counts: Sequence[int]) -> str:
    """Which N there are: all, perfect powers N = t^K, or the first few by number."""
    assert sampler.counts_at is not None
    power = lcm(*(int(law.exponent.q) for law in sampler.layout.growth.values()))
    roots = [t for t in range(2, _SAMPLED + 1) if t**power <= _SAMPLED]
    first = counts[0] if counts else 2**power
    expected = tuple(t**power for t in roots if t**power >= first)
    powers = [t**power for t in range(5, 9)]
    if tuple(counts) == expected and all(sampler.counts_at(n)["N"] == n for n in powers):
        least = int(sympy.integer_nthroot(first, power)[0])
        return f"any N >= {least}" if power == 1 else f"N = t^{power}, t >= {least}"
    if not counts:
        return f"no N up to {_SAMPLED}"
    return "N = " + ", ".join(map(str, counts[:4])) + ", ..."
