"""What a check measures at one N: spectra on raw points, variances on shifted ones.

The spectrum |F_S(m)|² does not change under a toroidal shift, so it is measured on the raw points
without the noise of shifts. Variances are those of the randomly shifted estimator, which is what
the theory speaks of; the raw estimator's stand beside. Everything is kept as moments, so that the
memory does not depend on the number of realisations.

A frozen point set, of which there is one realisation, is homogenised by many random shifts. They
tell the variance of its shifted estimator, Σ |F_S(m)|² |f^(m)|², and nothing on other realisations.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from ..integrands.protocol import Integrand
from ..point_sources.catalogue_source import CatalogueSource, chunk_size
from ..point_sources.sources import Source
from ..streams import stream
from .moments import Interval, Moments, estimates, shifted, update, variance_interval
from .probes import Frequency, amplitudes

_SHIFT_KEY = 1 << 20  # keeps the shifts' streams apart from the sampler's
_KEPT = 128  # realisations kept for the search for faults
_KEPT_VALUES = 1 << 20


@dataclass
class Measurement:
    """Moments gathered at one N, grown chunk by chunk.

    Parameters
    ----------
    n : int
    frequencies : tuple of frequencies
    integrands : tuple of Integrand
    replicates : int
        Realisations measured so far.
    attempted : int
        Realisations asked of the source; more only if it failed on the way.
    shifts : int
        Random shifts that variances are taken over; more than realisations only of a frozen set.
    distinct : int
        Different realisations among those that are kept; 0 until they have been compared.
    chunks : list of int
        Realisations that were drawn and measured together, chunk by chunk. On them depend the
        random numbers of catalogue samplers and of the shifts.
    cost : float, optional
        Seconds per realisation of the last chunk.
    dropped : str, optional
        Why no more is measured at this N.
    """

    n: int
    frequencies: tuple[Frequency, ...]
    integrands: tuple[Integrand, ...]
    replicates: int = 0
    attempted: int = 0
    shifts: int = 0
    distinct: int = 0
    seconds: float = 0.0
    cost: float | None = None
    dropped: str | None = None
    chunks: list[int] = field(default_factory=list[int])
    power: dict[Frequency, Moments] = field(default_factory=dict[Frequency, Moments])
    shifted: dict[str, Moments] = field(default_factory=dict[str, Moments])
    raw: dict[str, Moments] = field(default_factory=dict[str, Moments])
    kept: list[NDArray[np.float64]] = field(default_factory=list[NDArray[np.float64]])
    amplitudes: list[NDArray[np.complex128]] = field(default_factory=list[NDArray[np.complex128]])
    means: dict[str, float] = field(default_factory=dict[str, float])

    def __post_init__(self) -> None:
        self.power = {m: Moments() for m in self.frequencies}
        self.shifted = {f.name: Moments() for f in self.integrands}
        self.raw = {f.name: Moments() for f in self.integrands}
        self.means = {f.name: float(f.mean(17)) for f in self.integrands}

    @property
    def is_frozen(self) -> bool:
        """Whether all shifts were of one and the same point set."""
        return self.distinct == 1 and self.shifts > 1


def whole_chunks(measurement: Measurement) -> int:
    """The length of chunks for which there is time."""
    return chunk_size(measurement.n)


def grow(
    measurement: Measurement,
    source: Source | CatalogueSource,
    seed: int,
    replicates: int,
    deadline: float = inf,
    length: Callable[[Measurement], int] = whole_chunks,
) -> None:
    """Measure until there are ``replicates`` realisations, the source has no more, or it is late.

    After the deadline, a time of `time.perf_counter`, no further chunk is begun.

    Parameters
    ----------
    length : callable
        Realisations of the next chunk; 0 if none is to be begun.

    Raises
    ------
    SamplerFault
        If the sampler misbehaves; what was measured before stands.
    OutOfTime
        If the deadline of the source came before a first realisation of a chunk.
    """
    if source.realisations is not None:
        replicates = min(replicates, source.realisations[measurement.n])
    while measurement.replicates < replicates:
        count = min(length(measurement), replicates - measurement.replicates)
        if count < 1:
            return
        began = perf_counter()
        measurement.attempted = measurement.replicates + count
        labels = _labels(measurement, source, count)
        points = source.realise(measurement.n, seed, labels)
        _absorb(measurement, points, seed)
        measurement.replicates += len(points)
        measurement.attempted = measurement.replicates
        measurement.chunks.append(len(points))
        now = perf_counter()
        measurement.seconds += now - began
        measurement.cost = (now - began) / max(len(points), 1)
        if now > deadline:
            return


def _labels(measurement: Measurement, source: Source | CatalogueSource, count: int) -> range:
    """What the next chunk is called; that of a catalogue sampler has a stream of its own."""
    start = measurement.replicates
    if isinstance(source, CatalogueSource):
        start = len(measurement.chunks) * chunk_size(measurement.n)
    return range(start, start + count)


def homogenise(measurement: Measurement, seed: int, shifts: int, deadline: float = inf) -> None:
    """Shift the one realisation that there is until there are so many shifts, or it is late."""
    while measurement.shifts < shifts:
        began, points = perf_counter(), measurement.kept[0][:1]
        count = min(chunk_size(measurement.n), shifts - measurement.shifts)
        _shift(measurement, np.repeat(points, count, axis=0), seed)
        measurement.seconds += perf_counter() - began
        if perf_counter() > deadline:
            return


def _absorb(measurement: Measurement, points: NDArray[np.float64], seed: int) -> None:
    found = amplitudes(points, measurement.frequencies)
    held = sum(len(k) for k in measurement.kept)
    if held < _KEPT and held * points[0].size < _KEPT_VALUES:
        measurement.kept.append(points.copy())
        measurement.amplitudes.append(found)
    for m, amplitude in zip(measurement.frequencies, found, strict=True):
        measurement.power[m] = update(measurement.power[m], np.abs(amplitude))
    _shift(measurement, points, seed)
    for f in measurement.integrands:
        errors = estimates(f, points) - measurement.means[f.name]
        measurement.raw[f.name] = update(measurement.raw[f.name], errors)


def _shift(measurement: Measurement, points: NDArray[np.float64], seed: int) -> None:
    """Absorb the errors on points moved by one random shift for each realisation."""
    rng = stream(seed, _SHIFT_KEY, measurement.n, measurement.shifts)
    moved = shifted(points, rng.random((len(points), points.shape[2])))
    for f in measurement.integrands:
        errors = estimates(f, moved) - measurement.means[f.name]
        measurement.shifted[f.name] = update(measurement.shifted[f.name], errors)
    measurement.shifts += len(points)


def power_interval(measurement: Measurement, m: Frequency, level: float) -> Interval:
    """P_S(m) = E |F_S(m)|², with an interval as for a variance: |F|² is exponential-like."""
    return variance_interval(measurement.power[m], level)


def kept_points(measurement: Measurement) -> NDArray[np.float64]:
    """The first realisations, on which faults are looked for; shape (R, N, d)."""
    return np.concatenate(measurement.kept)


def kept_amplitudes(measurement: Measurement) -> dict[Frequency, NDArray[np.complex128]]:
    """F_S(m) of the realisations that are kept, each of shape (R,)."""
    found = np.concatenate(measurement.amplitudes, axis=1)
    return dict(zip(measurement.frequencies, found, strict=True))


def scaled(interval: Interval, factor: float) -> Interval:
    """The interval times a positive factor."""
    return Interval(*(factor * v for v in interval))
