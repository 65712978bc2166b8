"""Low frequencies in order of simplicity, and the ridges on which a catalogue sampler is worst.

A frequency is simpler the smaller |m_1| + ... + |m_d|, then its largest entry, then the fewer
negative entries it has; of m and −m, which have one power, the one whose first entry is positive
is taken. A ridge B_2({k·x}) has its power on the multiples j k, falling as j^-4: at a low k it sees
P_S(k) and little else, so that where N·P_S(k) is largest the sampler integrates ridges worst.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from ..expected_spectra.spectra import power_array
from ..integrands.ridge import Ridge
from ..measuring.probes import Frequency
from ..point_sources.catalogue_source import counts_of

_MOST = 100_000


def simplicity(m: Frequency) -> tuple[int, int, int, tuple[int, ...]]:
    """The key by which frequencies are sorted, the simplest first."""
    size = sum(abs(k) for k in m)
    return size, max(abs(k) for k in m), sum(k < 0 for k in m), tuple(-abs(k) for k in m)


def canonical(m: Frequency) -> Frequency:
    """Of m and −m the one whose first nonzero entry is positive."""
    first = next(k for k in m if k)
    return m if first > 0 else tuple(-k for k in m)


def low_frequencies(dim: int, radius: int = 4) -> tuple[Frequency, ...]:
    """Frequencies with |m_1| + ... + |m_d| <= radius, and the diagonal (1, ..., 1), simplest first.

    Raises
    ------
    InputError
        If there are more than 100 000.
    """
    if dim < 1 or radius < 1:
        raise InputError(f"low frequencies need dim >= 1 and radius >= 1: got {dim} and {radius}")
    found = {(1,) * dim}
    for m in _in_ball(dim, radius):
        found.add(canonical(m))
        if len(found) > _MOST:
            raise InputError(f"at most {_MOST} frequencies can be searched: got radius {radius}")
    return tuple(sorted(found, key=simplicity))


def _in_ball(dim: int, radius: int) -> Iterator[Frequency]:
    """All m ≠ 0 of the ball, support by support."""
    for count in range(1, min(dim, radius) + 1):
        sizes = [s for s in product(range(1, radius + 1), repeat=count) if sum(s) <= radius]
        for axes in combinations(range(dim), count):
            for entries in sizes:
                for signs in product((1, -1), repeat=count - 1):
                    m = [0] * dim
                    for axis, k, sign in zip(axes, entries, (1, *signs), strict=True):
                        m[axis] = sign * k
                    yield tuple(m)


@dataclass(frozen=True)
class WorstRidge:
    """A ridge function and the power that its sampler has at its frequency.

    Parameters
    ----------
    integrand : str
        In the grammar of integrands: ``ridge:k=(1,1)``.
    frequency : tuple of int
    scaled_power : float
        N·P_S at the frequency, 1 for independent points.
    """

    integrand: str
    frequency: Frequency
    scaled_power: float


def worst_ridges(sampler: Sampler, n: int, count: int = 5, radius: int = 4) -> list[WorstRidge]:
    """The ridges at low frequencies that a catalogue sampler integrates worst.

    Parameters
    ----------
    sampler : Sampler
        With a spectrum and points.
    n : int
        The admissible N nearest to it is taken.
    count : int
        How many ridges.
    radius : int
        Largest |k_1| + ... + |k_d|.

    Returns
    -------
    list of WorstRidge
        By decreasing N·P_S(k), which is exact; of equal ones the simplest k first.

    Raises
    ------
    InputError
        If the sampler has no spectrum or no points, or a number is out of range.
    """
    if count < 1:
        raise InputError(f"the number of ridges must be at least 1: got {count}")
    if sampler.kernel is None:
        raise InputError(f"worst ridges need a sampler with a spectrum: got {sampler.name}")
    counts = counts_of(sampler, n)
    frequencies = low_frequencies(int(sampler.dim), radius)
    powers = counts["N"] * power_array(sampler, counts, np.array(frequencies, dtype=np.int64))
    rounded = [float(f"{p:.12g}") for p in powers]  # equal but for rounding: the simplest counts
    order = sorted(range(len(frequencies)), key=lambda i: (-rounded[i], i))[:count]
    return [
        WorstRidge(Ridge(frequencies[i], 2).name, frequencies[i], float(powers[i])) for i in order
    ]
