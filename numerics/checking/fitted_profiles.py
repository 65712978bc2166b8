"""Profiles fitted to what a check has measured, a fit for each region at all N together.

A region here is a support, the coordinates in which a frequency is not zero. Without a claim
nothing is known of its N_k = N^e; frequencies therefore run, evenly in log |m_i|, from 1 to beyond
the largest N_k that a support of w coordinates can fill, N^(1/w): four times that. On an axis they
are listed; on a pair they form a grid with both signs; on more coordinates, where a grid would be
too large, |m_i| = k 2^(u_i) with u_i even over [−1, 1], within the cone that is fitted.

The periodograms are those of the realisations kept, the first ones at each N, so that the same
plan gives the same fit whatever was measured beyond. A fit is an estimate, on which no claim is
judged.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..fitting.profile_fits import EstimatedSpectrum, ProfileFit, fit_profile
from ..integrands.protocol import Floats, Ints
from ..measuring.measurements import Measurement, kept_points
from ..measuring.probes import Support, amplitudes, integrand_supports
from ..streams import stream

_BEYOND = 4  # frequencies reach this many times N^(1/w)
_ALONG = 16  # frequencies on an axis
_ACROSS = 7  # on each of two coordinates
_GENERIC = 96  # on more
_LONGEST = 2.0**40  # beyond, the phase 2π m x of a double is worse than 1e-3
_WAVES = 2.0e7  # products of waves and points at one N, about a quarter of a second
_WAVE_SECONDS = 15e-9
_FIT_SECONDS = 0.12  # for each region, on a slow machine


@dataclass(frozen=True, eq=False)
class FittedRegion:
    """What was measured on one support, and the profile fitted to it.

    Parameters
    ----------
    support : tuple of int
        1-based coordinates.
    spectra : tuple of EstimatedSpectrum
        By increasing N.
    fit : ProfileFit
    """

    support: Support
    spectra: tuple[EstimatedSpectrum, ...]
    fit: ProfileFit


def fitted_supports(dim: int) -> tuple[Support, ...]:
    """Regions that are fitted: those on which variances are measured."""
    return integrand_supports(dim)


def fit_frequencies(n: int, dim: int, support: Support) -> Ints:
    """Frequencies (k, d) on a support from which its profile can be told at N = n."""
    size = len(support)
    longest = min(_BEYOND * n ** (1 / size), _LONGEST)
    if size == 1:
        found = _even(longest, _ALONG)[:, None]
    elif size == 2:
        k = _even(longest, _ACROSS)
        both = np.meshgrid(k, np.concatenate([k, -k]), indexing="ij")
        found = np.stack([b.ravel() for b in both], axis=1)
    else:
        found = _spread(longest, size)
    placed = np.zeros((len(found), dim), dtype=np.int64)
    placed[:, [i - 1 for i in support]] = found
    return placed


def _even(longest: float, count: int) -> Ints:
    return np.unique(np.round(np.geomspace(1, max(longest, 1), count)).astype(np.int64))


def _spread(longest: float, size: int) -> Ints:
    """Frequencies of any signs within the cone, the diagonal among them at every length."""
    rng = stream(0, size)  # no random number of the check: a list that is the same for all
    lengths = np.geomspace(1, max(longest, 1), _GENERIC)
    ratios = 2 ** rng.uniform(-1, 1, (_GENERIC, size))
    ratios[::4] = 1
    signs = rng.choice([-1, 1], (_GENERIC, size))
    found = np.maximum(np.round(lengths[:, None] * ratios), 1).astype(np.int64) * signs
    return np.unique(np.where(found[:, :1] < 0, -found, found), axis=0)


def fit_seconds(dim: int, counts: Sequence[int]) -> float:
    """About how long the fit of one region takes at these N, from what is asked alone."""
    points = sum(min(_WAVES, 128 * n * _waves(dim)) for n in counts)
    return _FIT_SECONDS + _WAVE_SECONDS * points / len(fitted_supports(dim))


def _waves(dim: int) -> int:
    """About the number of products of waves for each point."""
    sizes = [len(s) for s in fitted_supports(dim)]
    return sum({1: _ALONG, 2: 2 * _ACROSS**2}.get(s, s * _GENERIC) for s in sizes)


def used_realisations(m: Measurement, dim: int) -> int:
    """How many of the realisations kept at one N are used: fewer of many points."""
    if m.is_frozen or not m.kept:
        return 0
    held = sum(len(k) for k in m.kept)
    return min(held, int(_WAVES / (m.n * _waves(dim))))


def fitted_regions(measurements: Sequence[Measurement], dim: int) -> Iterator[FittedRegion]:
    """Fit the profile of one region after the other, to all N with two realisations or more.

    Yields
    ------
    FittedRegion
        In the order of `fitted_supports`; none if there is no such N. The same measurements give
        the same.
    """
    used = [(m.n, kept_points(m)[:r]) for m in measurements if (r := used_realisations(m, dim)) > 1]
    for support in fitted_supports(dim) if used else ():
        spectra = tuple(
            estimated(points, fit_frequencies(n, dim, support), support) for n, points in used
        )
        yield FittedRegion(support, spectra, fit_profile(spectra))


def estimated(points: Floats, m: Ints, support: Support) -> EstimatedSpectrum:
    """N·P_S of realisations (R, N, d) at frequencies (k, d) on a support, and its dispersion."""
    axes = [i - 1 for i in support]
    n, wanted = points.shape[1], [tuple(k) for k in m[:, axes].tolist()]
    values = n * np.abs(amplitudes(points[:, :, axes], wanted)) ** 2
    power: Floats = values.mean(axis=1)
    spread: Floats = values.var(axis=1, ddof=1)
    known = power > 0
    dispersion = np.where(known, spread / np.where(known, power, 1.0) ** 2, 1.0)
    return EstimatedSpectrum(n, len(points), m, power, dispersion)
