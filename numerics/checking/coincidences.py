"""Coincidences that continuous points do not show: equal sets, piles, repeated values, lattices.

Four kinds of fault:

- ``duplicate realisations``: two realisations are the same set of points.
- ``piled points``: within one realisation, points are equal, or equal to many binary digits.
- ``repeated values``: an axis has one value in many realisations (clamped, or never filled in).
- ``quantised coordinates``: an axis takes the values of a lattice, or the realisations share
  their values.

Points share a cell of side 2^-k if their first k binary digits agree. Of R realisations of N
independent points the expected number of chains of c such pairs is at most λ^c / c!, with
λ = R N (N − 1)/2 · 2^-kd, and so is the probability that the cells hold c points more than there
are occupied cells. A fault takes that bound with 1000 λ, for points that cluster a little.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..point_sources.fault_kinds import Fault

_PILE_LEVEL = 1e-10  # of each of the scales
_CLUSTERING = 1e3
_DIGITS = (16, 24, 32, 40, 48)  # binary, of cells; 53 stand for all
_ALL_DIGITS = 53
_CHUNK_VALUES = 1 << 17
_POOLED_DRAWS = 1 << 21
_SHARED = 8  # realisations with one value
_MOST_STRATA = 1 << 16  # beyond, a single shift might meet their centres by chance
# Spacings that betray float32 and its kin, or printed decimals; the coarsest that fits is named.
_SCALES = tuple(sorted([2**b for b in range(1, 25)] + [10**k for k in range(1, 8)]))

Reals = NDArray[np.float64]
Words = NDArray[np.uint64]


def coincidences(points: Reals, strata: Sequence[int]) -> tuple[list[Fault], int]:
    """Faults of raw points that coincide, and the number of distinct realisations.

    Parameters
    ----------
    points : ndarray of float64, shape (R, N, d)
    strata : sequence of int
        Numbers of strata along an axis, whose centres and corners are looked for.
    """
    twins = _twins(points, _set_keys(points))
    # Twins share all their values: they would count as quantised for the wrong reason.
    singles = np.delete(points, list(twins), axis=0) if twins else points
    found = [_duplicates(twins, len(points)), _piles(points), *_values_of_axes(singles, strata)]
    return [fault for fault in found if fault is not None], len(singles)


def _chunks(points: Reals) -> Iterator[slice]:
    """Slices of realisations that keep temporary arrays small."""
    step = max(1, _CHUNK_VALUES // (points.shape[1] * points.shape[2]))
    return (slice(start, start + step) for start in range(0, len(points), step))


def _mixed(words: Words) -> Words:
    """One-to-one scrambling of 64-bit words (the finaliser of SplitMix64)."""
    words = (words ^ (words >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    words = (words ^ (words >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return words ^ (words >> np.uint64(31))


def _point_keys(words: Words) -> Words:
    """A key of each point, from one word for each coordinate; equal points have equal keys."""
    keys = np.full(words.shape[:2], 0x9E3779B97F4A7C15, np.uint64)
    for axis in range(words.shape[2]):
        keys = _mixed(keys + words[:, :, axis]) ^ np.uint64(0xD1B54A32D192ED03)
    return keys


def _set_keys(points: Reals) -> Words:
    """A key of each realisation that ignores the order of its points."""
    keys = np.empty(len(points), np.uint64)
    for part in _chunks(points):
        words = (points[part] + 0.0).view(np.uint64)  # + 0.0: the two zeros are one place
        keys[part] = _mixed(_point_keys(words)).sum(axis=1)
    return keys


def _twins(points: Reals, keys: Words) -> dict[int, int]:
    """Each realisation that repeats an earlier one, with the first that it repeats."""
    first: dict[int, int] = {}
    twins: dict[int, int] = {}
    for index, key in enumerate(keys.tolist()):
        original = first.setdefault(key, index)
        if original != index and _same_set(points[original], points[index]):
            twins[index] = original
    return twins


def _same_set(one: Reals, other: Reals) -> bool:
    if np.array_equal(one, other):
        return True
    return np.array_equal(one[np.lexsort(one.T)], other[np.lexsort(other.T)])


def _duplicates(twins: dict[int, int], count: int) -> Fault | None:
    if not twins:
        return None
    second, first = next(iter(twins.items()))
    copies = np.bincount(list(twins.values()))
    distinct = count - len(twins)
    return Fault(
        "duplicate realisations",
        f"realisations must differ: got {distinct} distinct of {count}, "
        f"realisations {first} and {second} are the same points",
        {
            "realisations": count,
            "distinct": distinct,
            "pairs": int((copies * (copies + 1) // 2).sum()),
            "first_pair": [first, second],
        },
    )


def _piles(points: Reals) -> Fault | None:
    """Points in the smallest cells that too many share; cells are nested, the largest first."""
    found: tuple[int, NDArray[np.int64]] | None = None
    for digits in (*_DIGITS, _ALL_DIGITS):
        shared = _shared_cells(points, digits)
        if not shared.any():
            break
        if _is_beyond_chance(int(shared.sum()), points.shape, digits):
            found = digits, shared
    return None if found is None else _pile(points, *found)


def _cells(points: Reals, digits: int) -> Words:
    """The cell of side 2^-digits that holds each coordinate; of all digits, the number itself."""
    if digits == _ALL_DIGITS:
        return (points + 0.0).view(np.uint64)
    return (points * 2.0**digits).astype(np.uint64)


def _shared_cells(points: Reals, digits: int) -> NDArray[np.int64]:
    """For each realisation its points less its occupied cells."""
    shared = np.empty(len(points), np.int64)
    for part in _chunks(points):
        keys = np.sort(_point_keys(_cells(points[part], digits)), axis=1)
        shared[part] = np.count_nonzero(keys[:, 1:] == keys[:, :-1], axis=1)
    return shared


def _is_beyond_chance(total: int, shape: tuple[int, ...], digits: int) -> bool:
    count, n, dim = shape
    log_pairs = math.log(_CLUSTERING * count * n * max(n - 1, 1) / 2)
    # All digits: in one dimension a few of very many points coincide by the grain 2^-53 of [0, 1).
    log_expected = log_pairs - digits * dim * math.log(2)
    return total * log_expected - math.lgamma(total + 1) < math.log(_PILE_LEVEL)


def _pile(points: Reals, digits: int, shared: NDArray[np.int64]) -> Fault:
    """The largest pile of the realisation that has most."""
    (count, n, dim), worst = points.shape, int(np.argmax(shared))
    _, first, sizes = np.unique(
        _cells(points[worst : worst + 1], digits)[0], axis=0, return_index=True, return_counts=True
    )
    largest = int(np.argmax(sizes))
    size, place = int(sizes[largest]), (points[worst, first[largest]] + 0.0).tolist()
    shown = ", ".join(f"{x:.6g}" for x in place[:4]) + (", ..." if dim > 4 else "")
    piled = int(np.count_nonzero(shared))
    within = 0.0 if digits == _ALL_DIGITS else 2.0**-digits
    near = f"within 2^-{digits} of" if within else "at"
    return Fault(
        "piled points",
        f"points must not coincide: got {size} of {n} points of realisation {worst} {near} "
        f"({shown}), and piles in {piled} of {count} realisations",
        {
            "realisation": worst,
            "location": place,
            "within": within,
            "count": size,
            "realisations_piled": piled,
        },
    )


@dataclass(frozen=True)
class _Lattice:
    """The few values that an axis takes."""

    detail: str
    distinct: int
    draws: int
    spacing: float | None
    strata: int | None = None


def _values_of_axes(points: Reals, strata: Sequence[int]) -> list[Fault]:
    """Faults of the values that each axis takes; axes that take alike values share one."""
    axes: dict[str, list[int]] = {}
    lattices: dict[str, _Lattice] = {}
    shared: dict[int, tuple[float, int]] = {}
    for axis in range(1, points.shape[2] + 1):
        # About two million draws are enough to tell.
        own = np.sort(points[: max(4, _POOLED_DRAWS // points.shape[1]), :, axis - 1], axis=1)
        is_first = np.ones(own.shape, bool)
        is_first[:, 1:] = own[:, 1:] != own[:, :-1]
        lattice = _lattice_of(own[is_first], strata) if own.size >= 8 else None
        if lattice is not None:
            lattices.setdefault(lattice.detail, lattice)
            axes.setdefault(lattice.detail, []).append(axis)
        elif (repeated := _repeated_value(own[is_first])) is not None:
            shared[axis] = repeated
    quantised = [_of_lattice(axes[detail], found) for detail, found in lattices.items()]
    return [*([_repeated(shared, len(points))] if shared else []), *quantised]


def _repeated_value(values: Reals) -> tuple[float, int] | None:
    """The value that most realisations share, and how many do, if they are eight or more.

    Of values on the coarsest grain that is not taken for a lattice, 2^-30, and R N <= 2^21 of them,
    any eight agree with a probability below 2^(21 · 8 − 30 · 7) / 8! < 1e-17.
    """
    places, counts = np.unique(values, return_counts=True)
    count = int(counts.max(initial=0))
    return (float(places[np.argmax(counts)]), count) if count >= _SHARED else None


def _repeated(shared: dict[int, tuple[float, int]], realisations: int) -> Fault:
    axis, (value, count) = max(shared.items(), key=lambda found: found[1][1])
    return Fault(
        "repeated values",
        f"realisations must not share values: got {value:.9g} on axis {axis} in {count} of "
        f"{realisations} realisations",
        {"axes": sorted(shared), "value": value, "realisations": count},
    )


def _of_lattice(axes: list[int], found: _Lattice) -> Fault:
    which = f"ax{'i' if len(axes) == 1 else 'e'}s {', '.join(map(str, axes))}"
    evidence = {
        "axes": axes,
        "distinct": found.distinct,
        "draws": found.draws,
        "spacing": found.spacing,
        "strata": found.strata,
    }
    detail = f"coordinates must take continuous values: got {found.detail} on {which}"
    return Fault("quantised coordinates", detail, evidence)


def _lattice_of(values: Reals, strata: Sequence[int]) -> _Lattice | None:
    """Values of one axis, once for each realisation, that realisations share or of a lattice.

    Within a realisation values may repeat (a shifted grid does it); between realisations not.
    """
    own, pooled = values.size, np.unique(values)
    if (fixed := _fixed_places(pooled, strata)) is not None:
        cells, offset = fixed
        detail = f"the {'centres' if offset else 'corners'} of {cells} strata"
        return _Lattice(detail, pooled.size, own, 1 / cells, cells)
    if own >= 8 and 2 * pooled.size <= own:
        spacing = float(np.diff(pooled).min()) if pooled.size > 1 else None
        text = "" if spacing is None else f", at least {spacing:.6g} apart"
        return _Lattice(f"{pooled.size} values in {own} draws{text}", pooled.size, own, spacing)
    if (spacing := _lattice(pooled)) is None:
        return None
    exponent = math.log2(spacing)
    name = f"2^{exponent:.0f}" if exponent.is_integer() else f"{spacing:.0e}"
    cause = " (float32)" if exponent in (-24, -23) else ""
    return _Lattice(f"values of spacing {name}{cause}", pooled.size, own, spacing)


def _fixed_places(values: Reals, strata: Sequence[int]) -> tuple[int, float] | None:
    """Number of strata, and offset, if all values are their centres (1/2) or lower corners (0)."""
    for cells in sorted({c for c in strata if 2 < c <= min(_MOST_STRATA, 2 * values.size)}):
        for offset in (0.5, 0.0):
            # A few values already tell most strata off.
            if all(_are_whole(part * cells - offset, cells) for part in (values[:64], values)):
                return cells, offset
    return None


def _are_whole(values: Reals, size: int) -> bool:
    """Whether numbers up to a size are whole but for rounding."""
    return bool(np.all(np.abs(values - np.rint(values)) <= 4 * size * 2.0**-53))


def _lattice(values: Reals) -> float | None:
    """Spacing of the coarsest lattice that holds the values, or None.

    Judged on [1/2, 1) if enough of them are there: floats of one length, and decimals of one
    number of significant digits, are equally spaced on it. A binary lattice must hold float32
    numbers everywhere.
    """
    upper = values[values >= 0.5]
    judged = upper if upper.size >= 4 else values
    is_short = np.array_equal(values, values.astype(np.float32))
    for scale in _SCALES:
        if scale & (scale - 1) == 0 and not is_short:
            continue
        # Most scales fail on a few values already.
        if _on_lattice(judged[:64], scale) and _on_lattice(judged, scale):
            return 1 / scale
    return 2.0**-24 if is_short else None


def _on_lattice(values: Reals, scale: int) -> bool:
    return bool(np.all(np.rint(values * scale) / scale == values))
