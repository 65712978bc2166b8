"""Exact variance of the randomly shifted estimator, Var = Σ_{m≠0} P_S(m) |f^(m)|².

For a product integrand the sum over m factors like the kernel does: each one-dimensional factor
of the kernel meets the coordinate's power sums, and the variance is a short sum of products,
in closed form and at any N. For the ball it is summed over a box of frequencies; what lies outside
is known in total from Parseval and bounded by sup N·P_S.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import log10

import numpy as np
from numpy.typing import NDArray

from ..theory.errors import InputError
from ..theory.kernels import Factor as KernelFactor
from ..theory.kernels import Kernel
from ..theory.samplers import Sampler
from ..theory.symbolic import FracElement
from .integrands.protocol import Factor, Integrand, Mpf, mp
from .spectra import element_value, power_array

BOX = 2_000_000
"""Frequencies in a lattice sum."""

_SLAB = 1 << 18  # frequencies handled at once


@dataclass(frozen=True)
class ExactVariance:
    """A variance with an error that it cannot exceed.

    Parameters
    ----------
    value : mpf
    error_bound : mpf
        For product integrands the rounding of a sum carried out with spare digits; for lattice
        sums the Parseval tail times sup |N·P_S − 1|, taken as at least 1.
    method : str
        ``product`` or ``lattice``.
    """

    value: Mpf
    error_bound: Mpf
    method: str


def exact_variance(
    sampler: Sampler,
    counts: Mapping[str, int],
    integrand: Integrand,
    digits: int = 15,
    box: int = BOX,
) -> ExactVariance:
    """Exact variance at the N of the given counts.

    Raises
    ------
    InputError
        If the sampler has no kernel, or the integrand is no product and the kernel has combs or
        more than three dimensions (their lattice sums have no useful bound here).
    """
    if sampler.kernel is None:
        raise InputError(f"an exact variance needs a sampler with a spectrum: got {sampler.name}")
    if integrand.factors is not None:
        return _product_variance(sampler, counts, integrand.factors, digits)
    return _lattice_variance(sampler, counts, integrand, box)


def _product_variance(
    sampler: Sampler, counts: Mapping[str, int], factors: tuple[Factor, ...], digits: int
) -> ExactVariance:
    assert sampler.kernel is not None
    spare = int(4 * log10(max(counts.values()))) + 20  # the mean cancels, then low frequencies
    with mp.workdps(digits + spare):
        groups = sampler.layout.groups
        sums = _PowerSums(counts, factors)
        members = [
            [factors[i - 1] for i in range(int(g.first), int(g.first) + int(g.size))]
            for g in groups
        ]
        value, held = _tree_value(sampler.kernel, sums, members)
        value *= sums.padding(set(range(len(groups))) - held, members)
        at_zero = element_value(sampler.kernel.at_zero(), counts)
        for f in factors:
            at_zero *= f.mean() ** 2
        variance = (value - at_zero) / counts["N"]
        error = (abs(value) + abs(at_zero)) * mp.mpf(10) ** (-(digits + spare - 5)) / counts["N"]
    return ExactVariance(variance, error, "product")


class _PowerSums:
    """Power sums of the coordinates against kernel factors, each computed once."""

    def __init__(self, counts: Mapping[str, int], factors: tuple[Factor, ...]) -> None:
        self._counts = counts
        self._known: dict[tuple[Factor, KernelFactor], Mpf] = {}

    def of(self, coordinate: Factor, factor: KernelFactor) -> Mpf:
        """φ(0) |f^(0)|² + Σ_{m≠0} φ(m) |f^(m)|²."""
        key = (coordinate, factor)
        if key not in self._known:
            self._known[key] = self._summed(coordinate, factor)
        return self._known[key]

    def _summed(self, coordinate: Factor, factor: KernelFactor) -> Mpf:
        total = mp.mpf(0)
        for coefficient, atom in factor.terms:
            total += element_value(coefficient, self._counts) * (
                coordinate.mean() ** 2
                + (0 if atom.zero else self._atom_sum(coordinate, atom.combs, atom.sincs))
            )
        return total

    def _atom_sum(
        self, coordinate: Factor, combs: tuple[FracElement, ...], sincs: tuple[FracElement, ...]
    ) -> Mpf:
        teeth = [int(element_value(c, self._counts)) for c in combs]
        counts = [int(element_value(c, self._counts)) for c in sincs]
        match teeth, counts:
            case [], []:
                return coordinate.total()
            case [], [n]:
                return coordinate.sinc2_sum(n)
            case [n], []:
                return coordinate.comb_sum(n)
            case [n], [n2]:
                return coordinate.comb_sinc2_sum(n, n2)
            case _:
                raise InputError(f"a factor must have at most one comb and one sinc²: got {combs}")

    def padding(self, missing: set[int], members: list[list[Factor]]) -> Mpf:
        """∏ Σ_m |f^(m)|² over the axes of the groups that a term does not mention."""
        value = mp.mpf(1)
        for group in missing:
            for f in members[group]:
                value *= f.mean() ** 2 + f.total()
        return value


def _tree_value(
    kernel: Kernel, sums: _PowerSums, members: list[list[Factor]]
) -> tuple[Mpf, set[int]]:
    """Value over the groups that the kernel mentions, and these groups."""
    if kernel.term is not None:
        value = element_value(kernel.term.coefficient, sums._counts)  # pyright: ignore[reportPrivateUsage]
        for group, factor in kernel.term.factors:
            for coordinate in members[group]:
                value *= sums.of(coordinate, factor)
        return value, {group for group, _ in kernel.term.factors}
    parts = [_tree_value(p, sums, members) for p in kernel.parts]
    held = {group for _, groups in parts for group in groups}
    if kernel.kind == "product":
        value = mp.mpf(1)
        for part, _ in parts:
            value *= part
        if sum(len(groups) for _, groups in parts) != len(held):
            raise InputError("factors of a kernel's product must stand on different axes")
        return value, held
    total = mp.mpf(0)
    for part, groups in parts:
        total += part * sums.padding(held - groups, members)
    return total, held


@lru_cache(maxsize=2)
def _lattice(
    integrand: Integrand, dim: int, half: int
) -> tuple[tuple[NDArray[np.int64], NDArray[np.float64]], ...]:
    """Slabs of frequencies m ≠ 0, |m_i| <= half, one of each ±m where m_1 ≠ 0, and their energy."""
    axis, slabs = np.arange(-half, half + 1), list[tuple[NDArray[np.int64], NDArray[np.float64]]]()
    thick = max(1, _SLAB // len(axis) ** (dim - 1))
    for start in range(0, half + 1, thick):
        first = np.arange(start, min(start + thick, half + 1))
        grid = np.meshgrid(first, *[axis] * (dim - 1), indexing="ij")
        m = np.stack(grid, axis=-1).reshape(-1, dim)
        # Of the plane m_1 = 0 both signs are there: they count once each, all others twice.
        m = m[(m != 0).any(axis=1)]
        weight = np.where(m[:, 0] == 0, 1.0, 2.0)
        slabs.append((m, weight * integrand.coefficient_power(m)))
    return tuple(slabs)


def _lattice_variance(
    sampler: Sampler, counts: Mapping[str, int], integrand: Integrand, box: int
) -> ExactVariance:
    d = int(sampler.dim)
    if d > 3 or sampler.family in ("regular", "correlated-multi-jitter"):
        raise InputError(
            "an exact variance of an integrand that is no product needs --dim of at most 3 and a "
            f"sampler without combs: got {sampler.name} with --dim {d}"
        )
    inside = total = 0.0
    for m, energy in _lattice(integrand, d, int(box ** (1 / d)) // 2):
        total += float(energy.sum())
        inside += float((energy * power_array(sampler, counts, m)).sum())
    with mp.workdps(20):
        parseval = integrand.total(20)  # Σ_{m≠0} |f^(m)|²
        tail = max(parseval - total, mp.mpf(0)) / counts["N"]
    return ExactVariance(mp.mpf(inside) + tail, tail + 1e-12 * inside, "lattice")
