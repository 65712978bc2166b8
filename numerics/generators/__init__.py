"""Generators of the catalogue samplers, one file each, found by the sampler's family."""

from collections.abc import Mapping
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from .box_dpp import box_dpp
from .cloaked import cloaked
from .correlated_multi_jitter import correlated_multi_jitter
from .difference_jitter import difference_jitter
from .jitter import jitter, regular
from .latin_hypercube import latin_hypercube
from .multi_jitter import multi_jitter
from .random import random
from .uncorrelated_jitter import uncorrelated_jitter

__all__ = ["generate"]


def generate(
    sampler: Sampler, counts: Mapping[str, int], replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Realisations of a catalogue sampler.

    Parameters
    ----------
    sampler : Sampler
        In a dimension given as a number.
    counts : mapping of str to int
        As ``sampler.counts_at(N)`` gives them.
    replicates : int
    rng : numpy.random.Generator

    Returns
    -------
    array of shape (replicates, N, d)
        Points in [0, 1); not shifted.

    Raises
    ------
    InputError
        If the sampler is a free profile, which has no points, or N is out of its generator's reach.
    """
    dim = int(sampler.dim)
    match sampler.family:
        case "random":
            return random(counts["N"], dim, replicates, rng)
        case "latin-hypercube":
            return latin_hypercube(counts["N"], dim, replicates, rng)
        case "regular":
            return regular(strata_of(sampler, counts), replicates, rng)
        case "jitter":
            return jitter(strata_of(sampler, counts), replicates, rng)
        case "multi-jitter" if dim == 1:
            return jitter((counts["N"],), replicates, rng)
        case "multi-jitter":
            strata = (counts["m"], counts["n"]) if "m" in counts else (counts["s"],) * dim
            return multi_jitter(strata, replicates, rng)
        case "correlated-multi-jitter":
            return correlated_multi_jitter(counts["m"], counts["n"], replicates, rng)
        case "uncorrelated-jitter":
            return uncorrelated_jitter(blocks_of(sampler, counts), replicates, rng)
        case "box-dpp":
            return box_dpp(strata_of(sampler, counts), replicates, rng)
        case "cloaked":
            beta = Fraction(sampler.name.partition(":")[2])
            return cloaked(strata_of(sampler, counts), beta, replicates, rng)
        case "difference-jitter":
            return difference_jitter(counts["N"], replicates, rng)
        case _:
            raise InputError(f"a sampler must have a generator: got {sampler.name}")


def strata_of(sampler: Sampler, counts: Mapping[str, int]) -> tuple[int, ...]:
    """Number of strata along each axis of a sampler with one grid."""
    dim = int(sampler.dim)
    return (counts["n"],) * dim if "n" in counts else tuple(counts[f"n{i + 1}"] for i in range(dim))


def blocks_of(sampler: Sampler, counts: Mapping[str, int]) -> tuple[tuple[int, ...], ...]:
    """Number of strata along each axis of each block."""
    layout = sampler.layout
    found: list[tuple[int, ...]] = []
    for index, members in enumerate(layout.blocks):
        strata: list[int] = []
        for place, group in enumerate(members):
            strata += [counts[f"n{index + 1}_{place + 1}"]] * int(layout.groups[group].size)
        found.append(tuple(strata))
    return tuple(found)
