"""Strategies for property tests of designs: catalogue layouts, their N, and integrands by name."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ...theory.errors import InputError
from ...theory.samplers import FAMILIES, FURTHER_FAMILIES, Sampler, parse_sampler
from ..integrands.grammar import CATALOGUE
from ..point_sources.catalogue_source import counts_of
from .searches import hypothesis

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

_MOST_SPLIT = 8  # dimensions up to which layouts are cut into blocks


@dataclass(frozen=True)
class NamedSampler:
    """A catalogue sampler by its name, and the dimension it is meant for."""

    name: str
    dim: int

    @property
    def sampler(self) -> Sampler:
        """The sampler itself."""
        return parse_sampler(self.name, self.dim)


def layouts(dim: int | None = None) -> "SearchStrategy[NamedSampler]":
    """Strategy: catalogue samplers with points, every family, with strata and blocks.

    Parameters
    ----------
    dim : int, optional
        1 to 4 unless given.
    """
    hypothesis()
    from hypothesis import strategies as st

    return (st.integers(1, 4) if dim is None else st.just(dim)).flatmap(_layouts_in)


def _layouts_in(dim: int) -> "SearchStrategy[NamedSampler]":
    from hypothesis import strategies as st

    names = [n for f in (*FAMILIES, *FURTHER_FAMILIES) for n in (f.name, f"{f.name}:{f.example}")]
    plain = st.sampled_from([n for n in names if _has_points(n, dim)])
    size = st.integers(2, 6)
    strata = st.lists(size, min_size=dim, max_size=dim).map(lambda k: "x".join(map(str, k)))
    family = st.sampled_from(["jitter", "regular"])
    gridded = st.tuples(family, strata).map(lambda g: f"{g[0]}:{g[1]}")
    if dim > _MOST_SPLIT:
        return st.one_of(plain, gridded).map(lambda name: NamedSampler(name, dim))
    cuts = st.sets(st.integers(1, max(dim - 1, 1)), max_size=dim - 1)
    blocks = cuts.map(lambda c: _blocks_between(sorted(c), dim))
    return st.one_of(plain, gridded, blocks).map(lambda name: NamedSampler(name, dim))


def _blocks_between(cuts: Sequence[int], dim: int) -> str:
    """Blocks of axes between the cuts."""
    ends = [0, *cuts, dim]
    sizes = [b - a for a, b in pairwise(ends)]
    return "uncorrelated-jitter:" + "+".join(map(str, sizes))


@lru_cache(maxsize=1024)
def _has_points(name: str, dim: int) -> bool:
    try:
        return parse_sampler(name, dim).counts_at is not None
    except InputError:
        return False


def counts(
    sampler: Sampler | NamedSampler, least: int = 2, most: int = 4096
) -> "SearchStrategy[int]":
    """Strategy: numbers of points that a catalogue sampler has.

    Raises
    ------
    InputError
        If it has none between least and most.
    """
    hypothesis()
    from hypothesis import strategies as st

    parsed = sampler.sampler if isinstance(sampler, NamedSampler) else sampler
    held = {
        n for n in (counts_of(parsed, t)["N"] for t in _spread(least, most)) if least <= n <= most
    }
    if not held:
        raise InputError(f"{parsed.name} must have an N in {least}..{most}: got none")
    return st.sampled_from(sorted(held))


def _spread(least: int, most: int) -> list[int]:
    """All numbers up to 256, then about 200 in a geometric row."""
    row = np.geomspace(max(least, 256), max(most, 256), 200)
    return sorted({*range(least, min(most, 256) + 1), *(round(float(x)) for x in row)})


def integrands(dim: int) -> "SearchStrategy[str]":
    """Strategy: integrands of the grammar by name, with parameters in their range."""
    hypothesis()
    from hypothesis import strategies as st

    return st.sampled_from([e.name for e in CATALOGUE if e.name != "disk" or dim == 2]).flatmap(
        lambda name: _parameters(name, dim).map(lambda text: f"{name}:{text}" if text else name)
    )


def _parameters(name: str, dim: int) -> "SearchStrategy[str]":
    """Parameters of an integrand; empty for its defaults."""
    from hypothesis import strategies as st

    def listed(numbers: Sequence[int]) -> str:
        return ",".join(map(str, numbers))

    part = st.integers(1, 49).map(lambda k: f"{k}/100")
    degree = st.integers(1, 6)
    each = st.lists(part, min_size=dim, max_size=dim).map(lambda k: f"({','.join(k)})")
    vector = st.lists(st.integers(-4, 4), min_size=dim, max_size=dim).filter(any)
    axes = st.sets(st.integers(1, dim), min_size=1).map(sorted)
    given: dict[str, SearchStrategy[str]] = {
        "disk": part.map(lambda r: f"radius={r}"),
        "ball": part.map(lambda r: f"radius={r}"),
        "chord": part.map(lambda r: f"radius={r}"),
        "gaussian": part.map(lambda s: f"sigma={s}"),
        "anisotropic-gaussian": each.map(lambda s: f"sigma={s}"),
        "box": each.map(lambda s: f"side={s}"),
        "half-space": part.map(lambda s: f"side={s}"),
        "bernoulli": st.tuples(degree, axes).map(lambda g: f"k={g[0]},axes=({listed(g[1])})"),
        "product": st.tuples(degree, part).map(lambda g: f"k={g[0]},c={g[1]}"),
        "additive": degree.map(lambda k: f"k={k}"),
        "polylog": st.integers(3, 9).map(lambda p: f"p={p}/2"),
        "ridge": st.tuples(vector, degree).map(lambda g: f"k=({listed(g[0])}),b={g[1]}"),
    }  # fmt: skip
    default = st.just("")
    return st.one_of(default, given[name]) if name in given else default
