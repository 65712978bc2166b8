"""Spectra of a check as they are shown: on planes of two coordinates, and along regions.

Along a region of frequencies, ρ = |m|, a fitted profile is the largest of its saturating monomials
(paper, Eq. 18, with N_k = N^e),

    N·P_S(ρ) = γ min(1, (ρ / (α N^e))^b).

The estimates of b and α go together: a steeper line through the same values meets the plateau
elsewhere. Taking the ends of their intervals in all combinations would show far more than the data
leave open. What is shown is the interval of b about the middle ρ* of the rise, and that of γ: all

    min(γ', N·P_S(ρ*) (ρ/ρ*)^b'),      ρ* = (α N^e)^(1/2),

the geometric mean of |m| = 1 and the cut-off, with b' and γ' in their intervals.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from .moments import Interval
from .periodograms import Box, Periodogram

Reals = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PlaneSpectrum:
    """P_S on the frequencies that are zero but in two coordinates.

    Parameters
    ----------
    coordinates : tuple of int
        The two, 1-based.
    measured : Periodogram
        On a box of two dimensions.
    exact : array, optional
        P_S of the claimed sampler, of the shape of the box.

    Raises
    ------
    InputError
        If the periodogram is not of two dimensions, or the exact one not of its shape.
    """

    coordinates: tuple[int, int]
    measured: Periodogram
    exact: Reals | None = None

    def __post_init__(self) -> None:
        where, shape = self.measured.where, self.measured.mean.shape
        if not isinstance(where, Box) or len(shape) != 2:
            raise InputError(f"a plane of frequencies must be a box in 2D: got shape {shape}")
        if self.exact is not None and self.exact.shape != shape:
            raise InputError(f"an exact spectrum must have shape {shape}: got {self.exact.shape}")


@dataclass(frozen=True, eq=False)
class RegionSpectrum:
    """N·P_S at frequencies of one region, at one N.

    Parameters
    ----------
    n, realisations : int
    radius : array of shape (K,)
        |m| > 0.
    power, low, high : array of shape (K,)
        N·P_S and its interval; an unbounded end is infinite.
    level : float
        Probability, both tails together, that the interval of one frequency should miss.
    exact : array of shape (K,), optional
        N·P_S of the claimed sampler at the same frequencies.

    Raises
    ------
    InputError
        If the arrays are not of one length.
    """

    n: int
    realisations: int
    radius: Reals
    power: Reals
    low: Reals
    high: Reals
    level: float = 0.05
    exact: Reals | None = None

    def __post_init__(self) -> None:
        arrays = (self.power, self.low, self.high, *(() if self.exact is None else (self.exact,)))
        if self.radius.ndim != 1 or any(a.shape != self.radius.shape for a in arrays):
            got = ", ".join(str(a.shape) for a in (self.radius, *arrays))
            raise InputError(f"a spectrum along a region must be of one length: got {got}")


@dataclass(frozen=True)
class FittedMonomial:
    """Intervals of the parameters of a saturating monomial; None where one is not determined.

    Parameters
    ----------
    degree, effective, gamma, alpha : Interval or None
        b, e in N_k = N^e, γ and α.
    """

    degree: Interval | None
    effective: Interval | None
    gamma: Interval | None
    alpha: Interval | None


@dataclass(frozen=True, eq=False)
class RegionProfile:
    """The spectrum of one region at several N, and what was fitted to all of them.

    Parameters
    ----------
    region : str
        In the grammar of regions, such as ``1``, ``1,2`` or ``axis``.
    spectra : tuple of RegionSpectrum
        By increasing N.
    monomials : tuple of FittedMonomial
        Empty: no profile was fitted.
    outside_model : str, optional
        Why no profile fits.
    reason : str, optional
        Why parameters are not determined.
    """

    region: str
    spectra: tuple[RegionSpectrum, ...]
    monomials: tuple[FittedMonomial, ...] = ()
    outside_model: str | None = None
    reason: str | None = None


@dataclass(frozen=True, eq=False)
class SpectrumPictures:
    """What is shown of the spectrum beside the document of a check.

    Parameters
    ----------
    planes : tuple of PlaneSpectrum
        In two dimensions the one plane; in more, pairs of coordinates that were chosen.
    profiles : tuple of RegionProfile
    left_out : tuple of (what, why)
    """

    planes: tuple[PlaneSpectrum, ...] = ()
    profiles: tuple[RegionProfile, ...] = ()
    left_out: tuple[tuple[str, str], ...] = ()


def profile_at(monomials: Sequence[FittedMonomial], n: int, radius: Reals) -> Reals | None:
    """N·P_S of the fitted profile at its estimates; None if no monomial is determined."""
    curves = [
        g.estimate * np.minimum(1.0, (radius / edge) ** b.estimate)
        for b, g, edge in _determined(monomials, n)
    ]
    return np.maximum.reduce(curves) if curves else None


def profile_band(
    monomials: Sequence[FittedMonomial], n: int, radius: Reals
) -> tuple[Reals, Reals] | None:
    """Least and largest profile with b about the middle of the rise, and γ, in their intervals.

    No confidence band; the profile at the estimates lies in it. None if no monomial is determined.
    """
    least: list[Reals] = []
    largest: list[Reals] = []
    for b, g, edge in _determined(monomials, n):
        middle = edge**0.5 if edge > 1 else edge  # below |m| = 1 there is no rise
        height = g.estimate * (middle / edge) ** b.estimate
        with np.errstate(over="ignore"):  # an interval may be unbounded
            rises = [(radius / middle) ** max(end, 0.0) for end in (b.low, b.high)]
        least.append(np.minimum(g.low, height * np.minimum(*rises)))
        largest.append(np.minimum(g.high, height * np.maximum(*rises)))
    if not least:
        return None
    return np.maximum.reduce(least), np.maximum.reduce(largest)


def _determined(
    monomials: Sequence[FittedMonomial], n: int
) -> Iterator[tuple[Interval, Interval, float]]:
    """b, γ and the cut-off α N^e of those monomials that are known."""
    for m in monomials:
        if m.degree is None or m.effective is None or m.gamma is None or m.alpha is None:
            continue
        yield m.degree, m.gamma, m.alpha.estimate * float(n) ** m.effective.estimate
