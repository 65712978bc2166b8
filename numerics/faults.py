"""Faults of a sampler that can be seen on its raw points, whatever it claims.

Four kinds, each judged on R independent realisations of N points:

- ``duplicate realisations``: two realisations are the same set of points.
- ``piled points``: within one realisation, points coincide.
- ``quantised coordinates``: an axis takes the values of a lattice, or the realisations share
  their values.
- ``bias``: the marginal of an axis is not uniform, E exp(-2 pi i k x) ≠ 0 for a whole k ≠ 0.

The first three have no tolerance: they look for coincidences that continuous points in double
precision show with a probability below 1e-9 a call. The fourth is a test of level 1e-6 a call.

References
----------
I. Waudby-Smith, A. Ramdas, Estimating means of bounded random variables by betting, JRSS B 86
(2024): the capital of a bettor is the test. It needs no more than |Z| <= 1.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..theory.errors import InputError

BIAS_LEVEL = 1e-6
"""False-alarm probability of all bias tests of one call of `find_faults`, unless told."""

# Stakes 0.98, 0.49, ..., 0.0153 on either sign: below 1, so that no single loss ruins a bettor.
_BETS = tuple(sign * 0.98 / 2**halvings for halvings in range(7) for sign in (1, -1))
_PILE_LEVEL = 1e-9
_CHUNK_VALUES = 1 << 17
_POOLED_DRAWS = 1 << 21
# Spacings that betray float32 and its kin, or printed decimals; the coarsest that fits is named.
_SCALES = tuple(sorted([2**b for b in range(1, 25)] + [10**k for k in range(1, 8)]))

Reals = NDArray[np.float64]


@dataclass(frozen=True)
class Fault:
    """One fault: its kind, one line for the reader, and JSON-able evidence.

    Evidence counts realisations from 0 and axes from 1.
    """

    kind: str
    detail: str
    evidence: dict[str, Any]


def find_faults(
    points: Reals, cells: tuple[int, ...] | None = None, level: float = BIAS_LEVEL
) -> list[Fault]:
    """Faults of raw points, at most one for each kind (and axis, where the kind speaks of axes).

    Parameters
    ----------
    points : ndarray of float64, shape (R, N, d)
        Independent realisations, finite and in [0, 1). With R = 1 neither duplicates nor bias can
        be seen.
    cells : tuple of int, optional
        Numbers of strata along an axis, at which fixed places are looked for besides N.
    level : float
        False-alarm probability of all bias tests of this call together.

    Returns
    -------
    list of Fault
        Empty for a sampler whose points are continuous and whose marginals are uniform.

    Raises
    ------
    InputError
        If the array is not of rank 3 or holds nothing.

    Notes
    -----
    Stratum centres (coefficient ±1 in every realisation) count as bias from R = 29 on, for d = 2
    and no `cells`. No valid test of this level can do with fewer than 24, because a coefficient
    that is ±1 by a fair coin is no bias; the empirical Bernstein bound needs 85. A smaller steady
    coefficient z takes about 20 / |z| realisations, a noisy one more.
    A single realisation whose whole axis hangs on one uniform shift is taken for quantised with
    probability 3e-9; every further realisation multiplies by as much.
    """
    if points.ndim != 3 or points.size == 0:
        raise InputError(f"points must fill an array (R, N, d): got shape {points.shape}")
    keys, coincidences = _fingerprints(points)
    twins = _twins(points, keys)
    # Twins share all their values: they would count as quantised for the wrong reason.
    singles = np.delete(points, list(twins), axis=0) if twins else points
    faults = [_duplicates(twins, len(points)), _piles(points, coincidences)]
    faults += [_quantised(singles[:, :, axis], axis + 1) for axis in range(points.shape[2])]
    return [fault for fault in faults if fault is not None] + _biases(points, cells or (), level)


def _chunks(points: Reals) -> Iterator[slice]:
    """Slices of realisations that keep temporary arrays small."""
    step = max(1, _CHUNK_VALUES // (points.shape[1] * points.shape[2]))
    return (slice(start, start + step) for start in range(0, len(points), step))


def _mixed(words: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """One-to-one scrambling of 64-bit words (the finaliser of SplitMix64)."""
    words = (words ^ (words >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    words = (words ^ (words >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return words ^ (words >> np.uint64(31))


def _fingerprints(points: Reals) -> tuple[NDArray[np.uint64], NDArray[np.int64]]:
    """For each realisation a key that ignores the order of its points, and its coincidences.

    Equal sets have equal keys; what the keys suggest is verified on the points themselves.
    """
    keys = np.empty(len(points), np.uint64)
    coincidences = np.empty(len(points), np.int64)
    for part in _chunks(points):
        words = (points[part] + 0.0).view(np.uint64)  # + 0.0: the two zeros are one place
        rows = np.full(words.shape[:2], 0x9E3779B97F4A7C15, np.uint64)
        for axis in range(points.shape[2]):
            rows = _mixed(rows + words[:, :, axis]) ^ np.uint64(0xD1B54A32D192ED03)
        keys[part] = _mixed(rows).sum(axis=1)
        rows.sort(axis=1)
        coincidences[part] = np.count_nonzero(rows[:, 1:] == rows[:, :-1], axis=1)
    return keys, coincidences


def _twins(points: Reals, keys: NDArray[np.uint64]) -> dict[int, int]:
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


def _piles(points: Reals, coincidences: NDArray[np.int64]) -> Fault | None:
    """The largest pile of the realisation with most coincidences."""
    count, n, dim = points.shape
    # In one dimension a few of very many points coincide by the grain 2^-53 of [0, 1).
    expected = count * n * (n - 1) / 2 * 2.0 ** (-53 * min(dim, 2))
    total = int(coincidences.sum())
    log_chance = total * math.log(expected or 1.0) - math.lgamma(total + 1)
    if total == 0 or (log_chance > math.log(_PILE_LEVEL)):
        return None
    worst = int(np.argmax(coincidences))
    places, sizes = np.unique(points[worst] + 0.0, axis=0, return_counts=True)
    size, place = int(sizes.max()), [float(x) for x in places[np.argmax(sizes)]]
    shown = ", ".join(f"{x:.6g}" for x in place[:4]) + (", ..." if dim > 4 else "")
    piled = int(np.count_nonzero(coincidences))
    return Fault(
        "piled points",
        f"points must not coincide: got {size} of {n} points of realisation {worst} at ({shown}), "
        f"and piles in {piled} of {count} realisations",
        {"realisation": worst, "location": place, "count": size, "realisations_piled": piled},
    )


def _quantised(values: Reals, axis: int) -> Fault | None:
    """Values of one axis, shape (R, N), that realisations share or that lie on a lattice.

    Within a realisation values may repeat (a shifted grid does it); between realisations not.
    About two million draws are enough to tell.
    """
    within = np.sort(values[: max(4, _POOLED_DRAWS // values.shape[1])], axis=1)
    own = within.size - int(np.count_nonzero(within[:, 1:] == within[:, :-1]))
    pooled = np.unique(within)
    if own >= 8 and 2 * pooled.size <= own:
        spacing = float(np.diff(pooled).min()) if pooled.size > 1 else None
        text = "" if spacing is None else f", at least {spacing:.6g} apart"
        detail = f"got {pooled.size} values in {own} draws{text}"
    elif values.size >= 8 and (spacing := _lattice(pooled)) is not None:
        exponent = math.log2(spacing)
        name = f"2^{exponent:.0f}" if exponent.is_integer() else f"{spacing:.0e}"
        cause = " (float32)" if exponent == -24 else ""
        detail = f"got values of spacing {name}{cause}"
    else:
        return None
    evidence = {"axis": axis, "distinct": pooled.size, "draws": own, "spacing": spacing}
    return Fault(
        "quantised coordinates", f"axis {axis} must take continuous values: {detail}", evidence
    )


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


def _biases(points: Reals, cells: Iterable[int], level: float) -> list[Fault]:
    """One fault for each axis with a Fourier coefficient that uniform marginals exclude."""
    count, n, dim = points.shape
    if count < 2:
        return []
    places = {n, *cells}
    frequencies = sorted(k for k in {1, 2, 3, *places} if k > 0)
    means = _coefficients(points, frequencies)
    log_capital = np.maximum(_log_capital(means.real), _log_capital(means.imag))
    biased = log_capital > math.log(2 * len(frequencies) * dim / level)
    faults: list[Fault] = []
    for axis in np.flatnonzero(biased.any(axis=0)).tolist():
        coefficients = means[:, :, axis].mean(axis=0)
        worst = int(np.argmax(log_capital[:, axis]))
        found = [
            {"frequency": k, "real": float(z.real), "imaginary": float(z.imag)}
            for k, z, bad in zip(frequencies, coefficients, biased[:, axis], strict=True)
            if bad
        ]
        fixed = frequencies[worst] in places
        detail = _bias_detail(axis + 1, frequencies[worst], complex(coefficients[worst]), fixed)
        evidence = {"axis": axis + 1, "realisations": count, "level": level}
        faults.append(Fault("bias", detail, evidence | {"coefficients": found}))
    return faults


def _bias_detail(axis: int, k: int, z: complex, fixed: bool) -> str:
    value = f"{z.real:.3f}" + (f"{z.imag:+.3f}i" if abs(z.imag) >= 5e-4 else "")
    what = "the density along the axis is not uniform"
    if fixed:
        what = f"points {'sit at' if abs(z) > 0.9 else 'prefer'} fixed places of {k} cells"
    return (
        f"axis {axis}: E exp(-2 pi i {k} x) = {value} (must be 0 for uniform marginals); {what}; "
        "jitter inside the strata, or shift each realisation by one uniform random vector"
    )


def _coefficients(points: Reals, frequencies: list[int]) -> NDArray[np.complex128]:
    """Means of exp(-2 pi i k x) over the N points, shape (R, number of frequencies, d)."""
    count, _, dim = points.shape
    means = np.empty((count, len(frequencies), dim), np.complex128)
    for part in _chunks(points):
        x = np.ascontiguousarray(points[part].transpose(0, 2, 1))
        for index, k in enumerate(frequencies):
            turns = k * x
            turns -= np.rint(turns)  # keeps the angle small and its sine exact
            turns *= 2 * np.pi
            means.real[part, index] = np.cos(turns).mean(axis=2)
            means.imag[part, index] = -np.sin(turns).mean(axis=2)
    return means


def _log_capital(z: Reals) -> Reals:
    """Log of the mean capital of the bettors on E Z ≠ 0, along the first axis.

    A bettor of stake s ends with the product of 1 + s Z_r >= 0. If the Z_r in [-1, 1] are
    independent and of mean 0, its expectation is 1; so is that of the mean over stakes, and by
    Markov it exceeds 1/a with probability at most a.
    """
    bounded = np.clip(z, -1.0, 1.0)  # rounding may leave |z| = 1 + 1e-16
    logs = np.stack([np.log1p(bet * bounded).sum(axis=0) for bet in _BETS])
    return np.logaddexp.reduce(logs, axis=0) - math.log(len(_BETS))
