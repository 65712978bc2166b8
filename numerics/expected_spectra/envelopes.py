"""How closely a profile follows the exact spectrum: their ratio, shell by shell.

A profile says that, in the mean over a shell of frequencies of one support, N·P_S is up to
constants the largest of its saturating monomials (Eq. 18 made two-sided). Here the constants are
measured: the mean of N·P_S over a shell, divided by the mean of the profile over it, from below
saturation to well above it. A profile that is right has ratios inside bounds that do not depend
on N; one that is wrong has a ratio that grows or falls as a power of N.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ...theory.profiles import SaturatingMonomial
from ...theory.rates import profile_of
from ...theory.regions import region_of_support
from ...theory.samplers import Sampler
from ...theory.symbolic import Expr, sympy
from .spectra import power_array

_MOST = 4_000_000  # frequencies in one orthant
_BEYOND = 4.0  # shells reach this many times the frequency at which the profile saturates


@dataclass(frozen=True)
class Envelope:
    """Smallest and largest ratio of the mean of N·P_S to the mean of the profile over a shell.

    Parameters
    ----------
    low, high : float
    count : int
        N, admissible and nearest to the one asked for.
    radii : tuple of float
        Inner radii of the shells, each twice the one before.
    ratios : tuple of float
        One per shell in which the profile is not zero.
    """

    low: float
    high: float
    count: int
    radii: tuple[float, ...]
    ratios: tuple[float, ...]


def envelope(
    sampler: Sampler,
    support: Sequence[int],
    n: int,
    profile: Sequence[SaturatingMonomial] | None = None,
) -> Envelope:
    """Ratios of the exact spectrum to a profile over the dyadic shells of one support.

    Parameters
    ----------
    sampler : Sampler
        With a kernel and known sizes.
    support : sequence of int
        1-based coordinates.
    n : int
        N; the nearest admissible count is taken.
    profile : sequence of SaturatingMonomial, optional
        Another profile than the one derived from the kernel, to be put to the test.

    Returns
    -------
    Envelope
        Shells [r, 2r) with r a power of two times the frequency at which the profile saturates,
        from |m| = 1 to four times that frequency. Shells without a frequency are left out, and
        those in which a comb has no tooth yet: there both the spectrum and the profile are zero.
        The spectrum is even in each coordinate, so that one orthant stands for all.

    Raises
    ------
    InputError
        If the sampler has no counts at N, the orthant would hold more than four million
        frequencies, or the spectrum has power where the profile says it is zero.
    """
    if sampler.kernel is None or sampler.counts_at is None:
        raise InputError(f"an envelope needs a sampler with a spectrum: got {sampler.name}")
    counts = sampler.counts_at(n)
    if profile is None:
        profile = profile_of(sampler, region_of_support(sampler.layout, tuple(support)))
    saturation = min(_saturation(m, counts["N"]) for m in profile)
    m, radius = _orthant(int(sampler.dim), support, _BEYOND * saturation)
    scaled = power_array(sampler, counts, m) * counts["N"]
    expected = profile_values(profile, counts, radius)
    edges = _edges(saturation)
    found: list[tuple[float, float]] = []
    for lower, upper in pairwise(edges):
        inside = (radius >= lower) & (radius < upper)
        if not inside.any():
            continue
        over, under = float(scaled[inside].mean()), float(expected[inside].mean())
        if under > 0:
            found.append((lower, over / under))
        elif over != 0:
            raise InputError(f"the spectrum must vanish where the profile does: got {over:.3g}")
    radii, ratios = zip(*found, strict=True)
    return Envelope(min(ratios), max(ratios), counts["N"], radii, ratios)


def profile_values(
    profile: Sequence[SaturatingMonomial], counts: Mapping[str, int], radius: NDArray[np.float64]
) -> NDArray[np.float64]:
    """max_j γ_j N^g_j min(1, (ρ/(α_j N^e_j))^b_j) at the radii ρ; a coefficient not known is 1."""
    values = np.zeros_like(radius)
    for m in profile:
        plateau = _number(m.plateau) * counts["N"] ** _number(m.plateau_exponent)
        ratio = radius / _saturation(m, counts["N"])
        if m.degree is sympy.oo:
            part = np.where(ratio >= 1, plateau, 0.0)
        else:
            part = plateau * np.minimum(1.0, ratio ** _number(m.degree))
        values = np.maximum(values, part)
    return values


def _saturation(monomial: SaturatingMonomial, n: int) -> float:
    """α N^e, a hair less so that the teeth of a comb at n = κ N^e are not rounded away."""
    alpha = monomial.scale if monomial.alpha is None else monomial.alpha
    return _number(alpha) * n ** _number(monomial.effective) * (1 - 1e-9)


def _number(value: Expr) -> float:
    return float(sympy.N(value, 17))


def _orthant(
    dim: int, support: Sequence[int], largest: float
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Frequencies of a support with positive entries and |m| < largest, and their |m|."""
    side = int(largest) + 1
    if side ** len(support) > _MOST:
        raise InputError(
            f"an orthant may hold at most {_MOST} frequencies: got {side}^{len(support)}"
        )
    axes = np.meshgrid(*[np.arange(1, side + 1)] * len(support), indexing="ij")
    entries = np.stack([a.ravel() for a in axes], axis=-1)
    radius = np.sqrt((entries.astype(float) ** 2).sum(axis=1))
    inside = radius < largest
    m = np.zeros((int(inside.sum()), dim), dtype=np.int64)
    m[:, [i - 1 for i in support]] = entries[inside]
    return m, radius[inside]


def _edges(saturation: float) -> list[float]:
    """Powers of two times the saturation, from at most 1 to ``_BEYOND`` times it."""
    edges = [_BEYOND * saturation]
    while edges[-1] > 1:
        edges.append(edges[-1] / 2)
    return edges[::-1]
