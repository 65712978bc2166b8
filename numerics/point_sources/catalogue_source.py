"""A catalogue sampler as a source of realisations, and the source that words name."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ...theory.samplers import Sampler, family_of, parse_sampler
from ..generators import generate
from ..streams import stream
from .child_processes import Limits
from .child_source import open_child_source
from .command_source import open_command_source
from .sources import Source, is_file_word, load_source

CHUNK = 64
"""Realisations drawn from one stream, unless N is very large."""

_CHUNK_POINTS = 1 << 20


def chunk_size(n: int) -> int:
    """Realisations of N points that are drawn and measured together: a power of two up to 64."""
    return min(CHUNK, 1 << max(0, (_CHUNK_POINTS // n).bit_length() - 1))


def counts_of(sampler: Sampler, n: int) -> Mapping[str, int]:
    """Counts of a sampler that has points, at the admissible N nearest to n.

    Raises
    ------
    InputError
        If it has none.
    """
    if sampler.counts_at is None:
        raise InputError(f"a catalogue source must have points to draw: got {sampler.name!r}")
    return sampler.counts_at(n)


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
        return counts_of(self.sampler, n)["N"]

    def realise(self, n: int, seed: int, replicates: range) -> NDArray[np.float64]:
        """Realisations of shape (len(replicates), n, d); the range starts a chunk."""
        size = chunk_size(n)
        if replicates.start % size or len(replicates) > size:
            raise InputError(f"replicates must come in chunks of {size}: got {replicates}")
        counts = counts_of(self.sampler, n)
        rng = stream(seed, n, replicates.start)
        return generate(self.sampler, counts, len(replicates), rng)


def open_source(
    words: list[str], dim: int, limits: Limits | None = None
) -> Source | CatalogueSource:
    """The source that words of the command line name; catalogue names win.

    Parameters
    ----------
    words : list of str
        A catalogue sampler; ``cmd:`` and a command; ``module:callable`` or ``path.py:callable``,
        drawn in a child process; or point files.
    dim : int
        At least 1.
    limits : Limits, optional
        What a command or a callable may use.

    Raises
    ------
    InputError
        If the words name nothing usable, or a catalogue entry without points.
    """
    if dim < 1:
        raise InputError(f"the dimension must be at least 1: got {dim}")
    if len(words) != 1 or is_file_word(words[0]):
        return load_source(words, dim)
    if family_of(words[0]) is not None:
        sampler = parse_sampler(words[0], dim)
        if sampler.counts_at is None:
            raise InputError(f"a catalogue source must have points to draw: got {words[0]!r}")
        return CatalogueSource(sampler)
    if words[0].startswith("cmd:"):
        return open_command_source(words[0], dim, limits)
    return open_child_source(words[0], dim, limits)
