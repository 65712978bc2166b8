"""Structure seen in scans of low frequencies: blocks of coordinates, oblique strata, wrong spectra.

The mean of N |F_S(m)|² is scanned at low frequencies and compared with white noise, whose range at
any N and number of realisations is proven (`white_noise.py`). In one and two dimensions all
|m_i| <= 16 are scanned, in three all |m_i| <= 10; in more, axes at 1 and 2, pairs at (1, ±1),
(1, ±2), (2, ±1) and triples at (1, ±1, ±1), so that strata along other directions are not seen.

*Blocks.* Let q = (N·P_S − 1)/(N − 1), the characteristic function of the pairs of points. Of parts
of the coordinates that are joined by random permutations it is the product of theirs, so that a
frequency that lies across them has

    N·P_S(m) = 1 + (N − 1) ∏_parts q(m_part),

at least 1 − 1/(N − 1)² for two or three stratified parts. Less power joins the coordinates of m.

*Oblique strata.* Boxes along the axes give N·P_S(m) the symmetry m_i → −m_i, and at m not less than
at all projections of m on fewer coordinates. A frequency that departs from white noise and from one
of these two is oblique. Full square cells, turned, are all but isotropic: N·P_S differs by
0.05 at most between mirror images, which takes some 10^5 realisations to see; what shows is shear,
narrow cells, and lattices, whose peaks lie at oblique frequencies.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from math import isfinite, prod, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from ..measuring.measurements import Measurement, kept_points, scaled
from ..measuring.moments import Interval
from ..measuring.probes import Frequency, Support, support_of_frequency
from ..measuring.white_noise import Scan, Side, scan
from .verdicts import Comparison, compare, spectrum_predictions

LEVEL = 1e-6
"""Probability that any frequency of independent uniform points is found to depart from white."""

_SURE = 3.0  # standard errors by which strata must lie below the threshold to be surely seen
_SHOWN = 16
_MOST_POINTS, _FEWEST = 1 << 17, 16
_SPECTRUM_ERROR = 1e-13  # relative, of exact spectra in double precision

Reals = NDArray[np.float64]
Blocks = tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class Departure:
    """A frequency at which the power is not that of white noise.

    Parameters
    ----------
    n : int
        Points of a realisation.
    frequency : tuple of int
    power : Interval
        Of N·P_S; missed with the level divided by the number of frequencies, about.
    what : str
    """

    n: int
    frequency: Frequency
    power: Interval
    what: str


@dataclass(frozen=True)
class Structures:
    """What the scans of one sampler show.

    Parameters
    ----------
    blocks : tuple of tuples of int, or None
        Coordinates, 1-based, parted into those that are jointly stratified; None if that cannot be
        told.
    why : str
        How far the blocks hold, or why there are none.
    oblique : tuple of Departure
        Strata that do not lie along the axes, at the simplest frequencies first.
    less, more : tuple of Departure
        All frequencies with less and with more power than white noise, the simplest first.
    scanned : int
        Frequencies compared with white noise, over all N.
    """

    blocks: Blocks | None
    why: str
    oblique: tuple[Departure, ...]
    less: tuple[Departure, ...]
    more: tuple[Departure, ...]
    scanned: int


def find_structures(realisations: Sequence[Reals], level: float = LEVEL) -> Structures:
    """Blocks and oblique strata of a sampler.

    Parameters
    ----------
    realisations : sequence of arrays of shape (R, N, d)
        Independent raw realisations in [0, 1), one array for each N; R >= 2 each.
    level : float
        In (0, 1). For independent uniform points the probability of any departure, whatever N and
        R: it is proven. What departs is compared with other frequencies by intervals that each
        miss with about the level divided by their number.

    Raises
    ------
    InputError
        If there is nothing to scan, or the dimensions differ.

    Notes
    -----
    A block is missed where its strata are so coarse that pairs of its coordinates keep nearly the
    power of white noise; ``why`` says up to which size blocks with equal strata would be seen.
    """
    if not realisations or len({p.shape[-1] for p in realisations}) != 1:
        raise InputError("structures are found at one N at least, in one dimension: got others")
    return structures_in([scan(points, level / len(realisations)) for points in realisations])


def structures_in(scans: Sequence[Scan]) -> Structures:
    """Blocks and oblique strata in the scans of one sampler at one N each, at least one."""
    blocks, why = _blocks(scans)
    less = tuple(_departures(scans, "less"))
    more = tuple(_departures(scans, "more"))
    return Structures(blocks, why, _oblique(scans), less, more, sum(len(s.powers) for s in scans))


def scans_of(measurements: Sequence[Measurement], level: float = LEVEL) -> tuple[Scan, ...]:
    """Scans of what a check has kept, at each N that has two different realisations.

    Parameters
    ----------
    measurements : sequence of Measurement
        At most 2^17 points are taken of each N, or 16 realisations.
    level : float
        Over all N.
    """
    telling = [m for m in measurements if m.replicates >= 2 and not m.is_frozen]
    return tuple(
        scan(kept_points(m)[: max(_FEWEST, _MOST_POINTS // m.n)], level / len(telling))
        for m in telling
    )


def disagreements(s: Scan, sampler: Sampler) -> tuple[Comparison, ...]:
    """Scanned frequencies at which the interval excludes the exact spectrum of a claimed sampler.

    Each interval misses with half the level of the scan divided by the number of frequencies,
    about. With 128 realisations N·P_S is seen to be wrong by a factor of 2 or more. Fewer, or an N
    that the sampler has not, exclude nothing.
    """
    exact = spectrum_predictions(sampler, s.n, tuple(s.powers)) or {}
    found: list[Comparison] = []
    for m, predicted in exact.items():
        measured, bound = scaled(s.powers[m], 1 / s.n), _SPECTRUM_ERROR * predicted
        outcome = compare(measured, predicted, bound, s.realisations)
        if outcome == "fails":
            found.append(Comparison("spectrum", m, s.n, measured, predicted, bound, outcome))
    return tuple(found)


def as_rows(found: Structures) -> list[dict[str, Any]]:
    """The oblique strata as JSON-able rows, at most 16, the simplest first."""
    return [
        {
            "n": d.n,
            "frequency": list(d.frequency),
            "scaled_power": {
                name: value if isfinite(value) else None
                for name, value in zip(("estimate", "low", "high"), d.power, strict=True)
            },
            "what": d.what,
        }
        for d in found.oblique[:_SHOWN]
    ]


def _departures(scans: Sequence[Scan], side: Side) -> Iterator[Departure]:
    for s in scans:
        for m in s.departing(side):
            yield Departure(s.n, m, s.powers[m], f"{side} power than white noise")


def _projection(m: Frequency, support: Sequence[int]) -> Frequency:
    return tuple(k if i in support else 0 for i, k in enumerate(m, 1))


def _blocks(scans: Sequence[Scan]) -> tuple[Blocks | None, str]:
    """The partition, and how far it holds; or None, and why."""
    dim = len(next(iter(scans[0].powers)))
    if not any(True for s in scans for _ in s.departing("less")):
        return None, "no frequency that was scanned has less power than white noise"
    seen = max(_largest_block(s, dim) for s in scans)
    root = list(range(dim + 1))
    for s in scans:
        for m in s.departing("less"):
            support = support_of_frequency(m)
            if len({root[i] for i in support}) > 1 and _joins(s, m, support):
                joined = {root[i] for i in support}
                root = [min(joined) if r in joined else r for r in root]
    hidden = [p for p in combinations(range(1, dim + 1), 2) if _is_hidden(scans, root, p)]
    if hidden:
        pairs = f"coordinates {hidden[0][0]} and {hidden[0][1]}"
        return None, f"joint strata of {pairs}, as coarse as their own, could not be seen"
    members = {r: tuple(i for i in range(1, dim + 1) if root[i] == r) for r in root[1:]}
    blocks = tuple(sorted(members.values()))
    if seen < 2 <= len(blocks):
        return None, "too few points were drawn: joint strata of two coordinates might be missed"
    if len(blocks) == 1:
        return blocks, "low power joins all coordinates" if dim > 1 else "there is one coordinate"
    return blocks, f"blocks of up to {seen} coordinates with equal strata would be seen"


def _joins(s: Scan, m: Frequency, support: Support) -> bool:
    """Whether the power at m is below that of every way to part its coordinates in permuted parts.

    Where a part has more power than white noise its q > 0 lowers N·P_S across it; powers of parts
    are taken three standard errors of the exponential law up and down.
    """
    expected, error = 1.0, 1 + _SURE / sqrt(s.realisations)
    for parts in _partitions(support) if s.n > 1 else ():
        powers = [p for part in parts if (p := s.at(_projection(m, part))) is not None]
        if len(powers) < len(parts):
            continue
        ends = [(p.estimate / error, min(p.estimate * error, s.n)) for p in powers]
        lowest = min(prod((p - 1) / (s.n - 1) for p in corner) for corner in product(*ends))
        expected = min(expected, 1 + (s.n - 1) * lowest)
    return s.powers[m].estimate < s.low * expected


def _partitions(support: Support) -> Iterator[tuple[Support, ...]]:
    """All partitions of two or three coordinates into two parts or more."""
    yield tuple((i,) for i in support)
    if len(support) == 3:
        for i in support:
            yield (i,), tuple(j for j in support if j != i)


def _largest_block(s: Scan, dim: int) -> int:
    """Size up to which N equal strata lower the power at (1, 1) so far that it is surely seen."""
    sizes = [
        k for k in range(2, dim + 1) if _is_surely_seen(s, 1 - float(np.sinc(s.n ** (-1 / k))) ** 4)
    ]
    return max(sizes, default=1)


def _is_surely_seen(s: Scan, power: float) -> bool:
    return power * (1 + _SURE / sqrt(s.realisations)) < s.low


def _is_hidden(scans: Sequence[Scan], root: Sequence[int], pair: tuple[int, int]) -> bool:
    """Whether boxes over two coordinates, not joined, might have been overlooked.

    A coordinate may be stratified if its power is three standard errors below white noise. With
    the powers p_1 and p_2 on the axes such boxes have 1 − (1 − p_1)(1 − p_2) at (1, 1).
    """
    if root[pair[0]] == root[pair[1]]:
        return False
    dim, is_low, is_seen = len(root) - 1, False, False
    for s in scans:
        axes = [s.powers[tuple(int(j == i) for j in range(1, dim + 1))] for i in pair]
        if all(p.estimate < 1 - _SURE / sqrt(s.realisations) for p in axes):
            is_low = True
            is_seen |= _is_surely_seen(s, 1 - prod(1 - p.estimate for p in axes))
    return is_low and not is_seen


def _oblique(scans: Sequence[Scan]) -> tuple[Departure, ...]:
    """Frequencies that depart from white noise, and from what boxes along the axes have."""
    found: dict[Frequency, Departure] = {}
    for s in scans:
        for side in ("less", "more"):
            for m in s.departing(side):
                what = _obliqueness(s, m, side) if m not in found else None
                if what is not None:
                    found[m] = Departure(s.n, m, s.powers[m], what)
    return tuple(sorted(found.values(), key=lambda d: _simplicity(d.frequency)))


def _simplicity(m: Frequency) -> tuple[int, int, int]:
    sizes = [abs(k) for k in m]
    return len(support_of_frequency(m)), sum(sizes), max(sizes)


def _obliqueness(s: Scan, m: Frequency, side: Side) -> str | None:
    """What is oblique about a frequency that departs from white noise, if anything."""
    support = support_of_frequency(m)
    if len(support) < 2:
        return None
    own = s.powers[m]
    for signs in product((1, -1), repeat=len(support) - 1):
        flips = dict(zip(support, (1, *signs), strict=True))
        mirrored = tuple(k * flips.get(i, 1) for i, k in enumerate(m, 1))
        other = s.at(mirrored)
        if other is not None and (other.low > own.high if side == "less" else other.high < own.low):
            than = "more" if side == "less" else "less"
            return (
                f"{side} power than white noise, and {than} at the mirror image {_text(mirrored)}"
            )
    projections = [
        s.at(_projection(m, part))
        for size in range(1, len(support))
        for part in combinations(support, size)
    ]
    if side == "less" and all(p is not None and p.low > own.high for p in projections):
        return "less power than at every projection on fewer coordinates"
    return None


def _text(m: Frequency) -> str:
    """The frequency; in many dimensions its nonzero entries alone."""
    if len(m) <= 4:
        return "(" + ", ".join(map(str, m)) + ")"
    return "(" + ", ".join(f"m_{i} = {k}" for i, k in enumerate(m, 1) if k) + ")"
