"""Spectral densities: what an integral over all real frequencies sees of a kernel.

Between the integers a kernel's atoms [m = 0] and [n divides m] stand on null sets, so that the
integral of Eq. 4 (and the sum over directions of Eq. 17) does not see them. What is left,

    S(ν) = Σ_k c_k ∏_i Σ_j w_kij φ_kij(ν_i),        φ = 1 or sinc²(ν_i/n),

is N·P_S almost everywhere. For jitter it is 1 − ∏ sinc²(ν_i/n_i), the structure factor of jitter
on the infinite lattice of cells. For a Latin hypercube it is 1 − (−1)^(d+1) ∏ sinc²(ν_i/N)/
(N − 1)^(d−1), as if it were random: its gains, the 1D strata, are all on the null sets.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ...theory.kernels import Factor as KernelFactor
from ...theory.samplers import Sampler
from ...theory.symbolic import FracElement
from ..expected_spectra.spectrum_balls import element_rational

AxisFactor = tuple[tuple[Fraction, int | None], ...]
"""Σ_j w_j φ_j on one axis: pairs (w, n), φ = sinc²(ν/n), or φ = 1 where n is None."""


@dataclass(frozen=True)
class Density:
    """N·P_S almost everywhere on R^d.

    Parameters
    ----------
    count : int
        N.
    terms : tuple of (Fraction, tuple of AxisFactor)
        c_k, and one factor per axis.
    dim : int
        d.
    """

    count: int
    terms: tuple[tuple[Fraction, tuple[AxisFactor, ...]], ...]
    dim: int


Product = tuple[Fraction, tuple[int | None, ...]]
"""c ∏_i sinc²(ν_i/n_i): c, and n_i per axis, None for the factor 1."""


def density_of(sampler: Sampler, counts: Mapping[str, int]) -> Density:
    """The density of a catalogue sampler.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in a dimension that is a number.
    counts : mapping of str to int
        Every count of the kernel.

    Raises
    ------
    InputError
        If the sampler has no kernel.
    """
    if sampler.kernel is None:
        raise InputError(f"a density needs a sampler with a spectrum: got {sampler.name}")
    groups = sampler.layout.groups
    sizes = [int(g.size) for g in groups]
    terms: list[tuple[Fraction, tuple[AxisFactor, ...]]] = []
    for term in sampler.kernel.restrict(tuple(g.size for g in groups)):
        held = dict(term.factors)
        one: AxisFactor = ((Fraction(1), None),)
        axes = [_axis_factor(held[g], counts) if g in held else one for g in range(len(groups))]
        factors = tuple(f for f, size in zip(axes, sizes, strict=True) for _ in range(size))
        if all(factors):
            terms.append((_fraction(term.coefficient, counts), factors))
    return Density(counts["N"], tuple(terms), sum(sizes))


def _axis_factor(factor: KernelFactor, counts: Mapping[str, int]) -> AxisFactor:
    """The factor without its combs, like atoms added; [m = 0] is gone by the restriction."""
    weights: dict[int | None, Fraction] = {}
    for coefficient, atom in factor.terms:
        if atom.combs:
            continue
        if len(atom.sincs) > 1:
            raise InputError(f"a factor must have at most one sinc² an atom: got {atom.sincs}")
        n = int(_fraction(atom.sincs[0], counts)) if atom.sincs else None
        weights[n] = weights.get(n, Fraction(0)) + _fraction(coefficient, counts)
    return tuple((w, n) for n, w in weights.items() if w)


def _fraction(element: FracElement, counts: Mapping[str, int]) -> Fraction:
    value = element_rational(element, counts)
    return Fraction(int(value.p), int(value.q))


@dataclass(frozen=True)
class Expanded:
    """A density multiplied out around ν = 0: S = total + Σ_k c_k (∏_i sinc²(ν_i/n_ki) − 1).

    Parameters
    ----------
    dim : int
        d.
    total : Fraction
        S at ν → 0; 0 for jitter.
    products : tuple of Product
        c_k with the counts n_ki, None for a factor 1; none is constant.
    """

    dim: int
    total: Fraction
    products: tuple[Product, ...]

    @property
    def constant(self) -> Fraction:
        """S at ν → ∞, where every product has gone."""
        return self.total - sum((c for c, _ in self.products), Fraction(0))

    @property
    def size(self) -> "Expanded":
        """The same with every term positive: how large the numbers are that S is the sum of."""
        return Expanded(self.dim, abs(self.total), tuple((-abs(c), n) for c, n in self.products))


def expanded(density: Density) -> Expanded:
    """The density multiplied out.

    Notes
    -----
    Multi-jitter in d dimensions has 2^d products: this is for few dimensions.
    """
    sums: dict[tuple[int | None, ...], Fraction] = {}
    for coefficient, factors in density.terms:
        for choice in product(*factors):
            strata = tuple(n for _, n in choice)
            weight = coefficient * prod((w for w, _ in choice), start=Fraction(1))
            sums[strata] = sums.get(strata, Fraction(0)) + weight
    total = sum(sums.values(), Fraction(0))
    sums.pop((None,) * density.dim, None)
    return Expanded(density.dim, total, tuple((c, n) for n, c in sums.items() if c))


def density_array(density: Expanded, nu: NDArray[np.float64]) -> NDArray[np.float64]:
    """S on an array of real frequencies, in double precision.

    Parameters
    ----------
    nu : array of shape (..., d)

    Returns
    -------
    array of shape (...)
        By 1 − sinc², so that low frequencies keep their digits where the terms of ``total`` and
        of the sum over k do not cancel among themselves; for jitter there is only one.
    """
    value = np.full(nu.shape[:-1], float(density.total))
    for coefficient, strata in density.products:
        logarithm = np.zeros(nu.shape[:-1])
        for axis, n in enumerate(strata):
            if n is not None:
                with np.errstate(divide="ignore"):  # sinc² = 0 is log −∞, and expm1 gives −1
                    logarithm += np.log1p(-sinc2_deficit(nu[..., axis] / n))
        value += float(coefficient) * np.expm1(logarithm)
    return value


def sinc2_deficit(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """1 − sinc²(x), sinc(x) = sin(πx)/(πx), with relative accuracy at x → 0 too."""
    square = (np.pi * x) ** 2
    # 1 − sinc = z/6 − z²/120 + ..., z = (πx)²; for z < 1 the terms left out are below 1e-18 z.
    series = np.zeros_like(square)
    for k in range(9, 0, -1):
        series = square / ((2 * k) * (2 * k + 1)) * (1 - series)
    deficit = np.where(square < 1, series, 1 - np.sinc(x))
    return deficit * (2 - deficit)
