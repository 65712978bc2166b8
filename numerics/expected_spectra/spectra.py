"""Exact expected power spectra as numbers: the kernels of the theory room, evaluated.

``scaled_power`` gives N·P_S(m) at one frequency to the working precision of mpmath, with counts
that may be real numbers, so that growth laws can be followed to any N. ``power_array`` gives
P_S on arrays of frequencies in double precision, by forms that do not cancel.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ...theory.kernels import Factor
from ...theory.layouts import Layout
from ...theory.samplers import Sampler
from ...theory.symbolic import sympy
from ..integrands.protocol import Ints, Mpf, mp
from .coefficients import element_value
from .shape_values import shape_value
from .spectrum_arrays import scaled_power_array

Counts = Mapping[str, int | Mpf]
"""Numbers for the counts of a kernel, as ``sampler.counts_at(N)`` gives them."""

_LARGEST_FREQUENCY = 1 << 62
_LARGEST_N = 10**307  # 1/N is a normal double


def counts_by_growth(layout: Layout, n: Mpf) -> dict[str, Mpf]:
    """Real counts κ N^a of a layout at any N, at the working precision of mpmath."""
    return {
        name: _number(law.constant) * mp.power(n, _number(law.exponent))
        for name, law in layout.growth.items()
    }


def _number(value: object) -> Mpf:
    return mp.mpmathify(sympy.N(value, mp.dps + 5))


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
        for shape, count in atom.shapes:
            value *= shape_value(shape, m / element_value(count, counts))
        total, size = total + value, size + abs(value)
    return total, size


def power_array(
    sampler: Sampler, counts: Mapping[str, int], m: NDArray[np.int64]
) -> NDArray[np.float64]:
    """P_S on an array of integer frequencies, in double precision.

    Parameters
    ----------
    sampler : Sampler
        With a kernel.
    counts : mapping of str to int
        Every count of the kernel; N up to 10^307.
    m : array of shape (..., d)
        |m_i| up to 2^62; m = 0 gives 1.

    Returns
    -------
    array of shape (...)
        For the samplers of the catalogue with a relative error below 1e-13 (an estimate, from
        comparison with ball arithmetic) where P_S is a normal double, else with an absolute
        one below 1e-307; exactly zero where the spectrum is.

    Raises
    ------
    InputError
        If a frequency or N is too large.
    """
    if m.size and not -_LARGEST_FREQUENCY <= m.min() <= m.max() <= _LARGEST_FREQUENCY:
        raise InputError(
            f"frequencies must be at most 2^62 in size: got {max(-int(m.min()), int(m.max()))}"
        )
    if counts["N"] > _LARGEST_N:
        raise InputError(f"N must be at most 10^307: got {counts['N']}")
    assert sampler.kernel is not None
    flat = m.reshape(-1, m.shape[-1])
    result = np.ones(len(flat))
    for support, rows in _by_support(flat):
        taken = support_counts(sampler.layout, [i + 1 for i in support])
        columns = [flat[rows, i] for i in support]
        result[rows] = scaled_power_array(sampler.kernel, taken, counts, columns) / counts["N"]
    return result.reshape(m.shape[:-1])


def _by_support(m: Ints) -> Iterator[tuple[list[int], NDArray[np.intp]]]:
    """Each nonempty support, as 0-based coordinates, and the rows that have it."""
    if len(m) == 0:
        return
    codes = _support_codes(m)
    order = np.argsort(codes, kind="stable")
    ends = np.flatnonzero(np.diff(codes[order])) + 1
    for rows in np.split(order, ends):
        support = np.flatnonzero(m[rows[0]])
        if support.size:
            yield support.tolist(), rows


def _support_codes(m: Ints) -> NDArray[np.integer[Any]]:
    """The same number for rows of the same support."""
    d = m.shape[1]
    if d > 64:
        packed = np.packbits(m != 0, axis=1)
        return np.unique(packed, axis=0, return_inverse=True)[1].reshape(-1)
    kind = next(k for k in (np.uint8, np.uint16, np.uint32, np.uint64) if d <= 8 * k().itemsize)
    codes = np.zeros(len(m), kind)
    for i in range(d):
        codes |= (m[:, i] != 0).astype(kind) << kind(i)  # few bits are sorted by counting
    return codes
