"""A catalogue sampler as a source of realisations."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..theory.errors import InputError
from ..theory.samplers import Sampler, family_of, parse_sampler
from .generators import generate
from .sources import Source, load_source
from .streams import stream

CHUNK = 64
"""Realisations drawn from one stream: replicates are asked for in whole chunks."""


@dataclass(frozen=True)
class CatalogueSource:
    """Realisations of a catalogue sampler, one stream per N and chunk of replicates."""

    sampler: Sampler
    kind: str = "catalogue"
    counts: None = None
    realisations: None = None

    @property
    def name(self) -> str:
        """The sampler's name."""
        return self.sampler.name

    @property
    def dim(self) -> int:
        """The dimension."""
        return int(self.sampler.dim)

    def admissible(self, n: int) -> int:
        """The admissible N nearest to n."""
        return self.sampler.counts_at(n)["N"]  # type: ignore[misc]

    def realise(self, n: int, seed: int, replicates: range) -> NDArray[np.float64]:
        """Realisations of shape (len(replicates), n, d); the range starts a chunk."""
        if replicates.start % CHUNK or len(replicates) > CHUNK:
            raise InputError(f"replicates must come in chunks of {CHUNK}: got {replicates}")
        counts = self.sampler.counts_at(n)  # type: ignore[misc]
        rng = stream(seed, n, replicates.start)
        return generate(self.sampler, counts, len(replicates), rng)


def open_source(words: list[str], dim: int) -> Source | CatalogueSource:
    """The source that words of the command line name; catalogue names win.

    Raises
    ------
    InputError
        If the words name nothing usable, or a catalogue entry without points.
    """
    if len(words) == 1 and family_of(words[0]) is not None:
        sampler = parse_sampler(words[0], dim)
        if sampler.counts_at is None:
            raise InputError(f"a catalogue source must have points to draw: got {words[0]!r}")
        return CatalogueSource(sampler)
    return load_source(words, dim)
