"""Exact expected power spectra as numbers: the kernels of the theory room, evaluated.

``scaled_power`` gives N·P_S(m) at one frequency to the working precision of mpmath, with counts
that may be real numbers, so that growth laws can be followed to any N. ``power_array`` gives
P_S on arrays of frequencies in double precision.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..theory.kernels import Factor
from ..theory.layouts import Layout
from ..theory.samplers import Sampler
from ..theory.symbolic import FracElement, sympy
from .integrands.protocol import Mpf, mp

Counts = Mapping[str, int | Mpf]
"""Numbers for the counts of a kernel, as ``sampler.counts_at(N)`` gives them."""


def counts_by_growth(layout: Layout, n: Mpf) -> dict[str, Mpf]:
    """Real counts κ N^a of a layout at any N, at the working precision of mpmath."""
    return {
        name: _number(law.constant) * mp.power(n, _number(law.exponent))
        for name, law in layout.growth.items()
    }


def _number(value: object) -> Mpf:
    return mp.mpmathify(sympy.N(value, mp.dps + 5))


def element_value(element: FracElement, counts: Counts) -> Mpf:
    """A coefficient of a kernel as a number of mpmath."""
    names = [str(s) for s in element.field.symbols]
    values = [mp.pi**2, *(mp.mpf(counts[name]) for name in names[1:])]
    over, under = (_polynomial_value(p, values) for p in (element.numer, element.denom))
    return over / under


def _polynomial_value(polynomial: FracElement, values: Sequence[Mpf]) -> Mpf:
    total = mp.mpf(0)
    for powers, number in polynomial.terms():
        term = mp.mpf(int(number.numerator)) / int(number.denominator)
        for value, k in zip(values, powers, strict=True):
            if k:
                term *= value**k
        total += term
    return total


def support_counts(layout: Layout, support: Sequence[int]) -> tuple[int, ...]:
    """How many of the 1-based coordinates lie in each group."""
    return tuple(
        sum(int(g.first) <= i < int(g.first) + int(g.size) for i in support) for g in layout.groups
    )


def scaled_power(sampler: Sampler, counts: Counts, m: Sequence[int]) -> Mpf:
    """N·P_S(m) at one integer frequency m ≠ 0, to about the working precision of mpmath.

    Parameters
    ----------
    sampler : Sampler
        With a kernel.
    counts : mapping of str to int or mpf
        Every count of the kernel.
    m : sequence of int, length d

    Notes
    -----
    The plain sum cancels at low frequencies. Beside it the sum of the absolute values is kept: it
    times 10^-digits bounds the rounding, and the precision is raised until what is left of the
    sum has the digits asked for. Two precisions that agree would not do: far below N^-1 both may
    give the same wrong zero.
    """
    asked = mp.dps
    working = asked + 15
    while working < 400 * asked:
        with mp.workdps(working):
            value, size = _sum_and_size(sampler, counts, m)
            if size == 0 or abs(value) >= size * mp.mpf(10) ** (asked + 5 - working):
                break
        working *= 2
    else:
        value = mp.mpf(0)  # cancelled to all digits
    return +value


def _sum_and_size(sampler: Sampler, counts: Counts, m: Sequence[int]) -> tuple[Mpf, Mpf]:
    """N·P_S(m), and the same sum with every product taken absolutely."""
    layout = sampler.layout
    support = [i + 1 for i, k in enumerate(m) if k]
    total = size = mp.mpf(0)
    assert sampler.kernel is not None
    for term in sampler.kernel.restrict(support_counts(layout, support)):
        value = element_value(term.coefficient, counts)
        absolute = abs(value)
        for group, factor in term.factors:
            first = int(layout.groups[group].first)
            for i in support:
                if first <= i < first + int(layout.groups[group].size):
                    at_m, size_at_m = _factor_value(factor, counts, m[i - 1])
                    value, absolute = value * at_m, absolute * size_at_m
        total, size = total + value, size + absolute
    return total, size


def _factor_value(factor: Factor, counts: Counts, m: int) -> tuple[Mpf, Mpf]:
    total = size = mp.mpf(0)
    for coefficient, atom in factor.terms:
        if any(mp.mpf(m) % element_value(c, counts) != 0 for c in atom.combs):
            continue
        value = element_value(coefficient, counts)
        for count in atom.sincs:
            value *= mp.sincpi(m / element_value(count, counts)) ** 2
        total, size = total + value, size + abs(value)
    return total, size


def power_array(
    sampler: Sampler, counts: Mapping[str, int], m: NDArray[np.int64]
) -> NDArray[np.float64]:
    """P_S on an array of integer frequencies, in double precision.

    Parameters
    ----------
    m : array of shape (..., d)
        m = 0 gives 1.

    Returns
    -------
    array of shape (...)
        With an absolute error of N·P_S of about 1e-15 times the largest coefficient (the plain
        sum: low frequencies lose relative digits, at n strata about 1e-16 n²).
    """
    flat = m.reshape(-1, m.shape[-1])
    result = np.ones(len(flat))
    packed = np.packbits(flat != 0, axis=1)  # rows of bytes are sorted much faster than of bools
    if packed.shape[1] == 1:
        masks, inverse = np.unique(packed[:, 0], return_inverse=True)
        masks = masks[:, None]
    else:
        masks, inverse = np.unique(packed, axis=0, return_inverse=True)
    masks = np.unpackbits(masks, axis=1, count=flat.shape[1]).astype(bool)
    for index, mask in enumerate(masks):
        rows = np.flatnonzero(inverse.reshape(-1) == index)
        if mask.any():
            result[rows] = _on_support(sampler, counts, flat[rows], np.flatnonzero(mask) + 1)
    return result.reshape(m.shape[:-1])


def _on_support(
    sampler: Sampler, counts: Mapping[str, int], m: NDArray[np.int64], support: NDArray[np.int64]
) -> NDArray[np.float64]:
    layout = sampler.layout
    total = np.zeros(len(m))
    assert sampler.kernel is not None
    for term in sampler.kernel.restrict(support_counts(layout, support.tolist())):
        value = np.full(len(m), float(element_value(term.coefficient, counts)))
        for group, factor in term.factors:
            first = int(layout.groups[group].first)
            for i in support:
                if first <= i < first + int(layout.groups[group].size):
                    value *= _factor_array(factor, counts, m[:, i - 1])
        total += value
    return total / counts["N"]


def _factor_array(
    factor: Factor, counts: Mapping[str, int], m: NDArray[np.int64]
) -> NDArray[np.float64]:
    total = np.zeros(len(m))
    for coefficient, atom in factor.terms:
        value = np.full(len(m), float(element_value(coefficient, counts)))
        for comb in atom.combs:
            value *= m % int(element_value(comb, counts)) == 0
        for count in atom.sincs:
            value *= np.sinc(m / int(element_value(count, counts))) ** 2
        total += value
    return total
