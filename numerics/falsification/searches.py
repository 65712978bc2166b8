"""A search for witnesses in one dimension: its realisations, its levels and what it has spent."""

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ..checking.verdicts import FALSE_ALARM
from ..integrands.protocol import Integrand
from ..measuring.moments import Moments, estimates, shifted, update
from ..point_sources.catalogue_source import CatalogueSource, chunk_size
from ..point_sources.sources import Source
from ..streams import stream

CONFIRMATIONS = 16
"""Suspects that a search may look at again, in all dimensions together."""

LEVEL = FALSE_ALARM / CONFIRMATIONS
"""Of each confirmation."""

SUSPICION = 1e-4
"""Level of an exploration; what it says is looked at again."""

_SHIFT_KEY = 1 << 21  # keeps the shifts' streams apart from a sampler's

AnySource = Source | CatalogueSource


@dataclass
class Tally:
    """How many confirmations a search has spent, in all dimensions together."""

    spent: int = 0


@dataclass(frozen=True)
class Search:
    """A search in one dimension.

    Parameters
    ----------
    source : Source or CatalogueSource
    claim : str
    seed : int
    deadline : float
        A time of `time.perf_counter`.
    tally : Tally
        Shared by the dimensions.
    """

    source: AnySource
    claim: str
    seed: int
    deadline: float
    tally: Tally

    @property
    def dim(self) -> int:
        """The dimension."""
        return self.source.dim

    @property
    def is_over(self) -> bool:
        """Whether its time or its confirmations are spent."""
        return self.tally.spent >= CONFIRMATIONS or time.perf_counter() > self.deadline


def hypothesis() -> Any:
    """Hypothesis, imported where it is used.

    Raises
    ------
    InputError
        If it is not installed.
    """
    try:
        import hypothesis as found
    except ModuleNotFoundError:
        raise InputError(
            "hypothesis must be installed for a search (pip install 'specrate[test]'): got none"
        ) from None
    return found


def search_settings(proposed: int) -> Any:
    """A search of its own, whatever profile the user's tests have."""
    h = hypothesis()
    return h.settings(
        max_examples=proposed,
        database=None,
        deadline=None,
        derandomize=False,
        phases=[h.Phase.generate, h.Phase.shrink],
        suppress_health_check=list(h.HealthCheck),
    )


def drawn(search: Search, n: int, start: int, count: int) -> NDArray[np.float64]:
    """Realisations start .. start + count − 1, as many as the source has and time allows."""
    source, step = search.source, chunk_size(n)
    held = start + count if source.realisations is None else source.realisations[n]
    parts = [np.empty((0, n, search.dim))]
    for first in range(start, min(start + count, held), step):
        last = min(first + step, start + count, held)
        parts.append(source.realise(n, search.seed, range(first, last)))
        if time.perf_counter() > search.deadline:
            break
    return np.concatenate(parts)


def shifted_errors(search: Search, f: Integrand, points: NDArray[np.float64]) -> Moments:
    """Moments of the errors of f, each realisation moved by a random shift."""
    moments = Moments()
    if len(points):
        rng = stream(search.seed, _SHIFT_KEY, points.shape[1], search.tally.spent)
        moved = shifted(points, rng.random((len(points), search.dim)))
        moments = update(moments, estimates(f, moved) - float(f.mean(17)))
    return moments
