r"""Ranges of N·P_S outside a box of frequencies, read off the kernel: support by support.

Of a frequency m with support u and some |m_i| > H only this is used: |m_i| >= M, where M is H + 1
on one axis of u and 1 on the others; with x = M/n, for the shapes g(m_i/n),

    sinc²                                in 0 .. min(1, (π x)^-2),
    (1 - |x|)^+ and exp(-|x|^β)          in 0 .. their value at x,
    3 sinc³(x) sinc(3x) - 2 sinc²(x) sinc(4x)    within min(1, (π x)^-4 + (π x)^-3/2) of 0;

and a comb's atom is 1 on its teeth, the nonzero multiples of c, and 0 off them. The terms of the
kernel are added up in ball arithmetic: the range is proven, and narrow where the shapes are small.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, combinations

from ...theory.errors import InputError
from ...theory.kernels import Factor, Term
from ...theory.samplers import Sampler
from ...theory.shapes import Shape
from ..balls import Ball, exact_ball, flint
from .spectra import support_counts
from .spectrum_balls import element_rational


@dataclass(frozen=True)
class OutsideRange:
    """N·P_S(m) for all m with a support, some |m_i| > H, and given axes on teeth of their combs.

    Parameters
    ----------
    support : tuple of int
        Coordinates, from 1, that are not 0.
    teeth : dict of int to int
        Spacing c > 1 of the teeth on which these coordinates lie; all other coordinates of the
        support lie off the teeth that their axis has.
    lower, upper : float
        0 <= lower <= upper <= N.
    """

    support: tuple[int, ...]
    teeth: Mapping[int, int]
    lower: float
    upper: float


def outside_ranges(
    sampler: Sampler, counts: Mapping[str, int], half: int
) -> tuple[OutsideRange, ...]:
    """One range for every support and every set of its axes on teeth.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in a dimension that is a number.
    counts : mapping of str to int
        Every count of the kernel, N among them.
    half : int
        H, at least 0.

    Raises
    ------
    InputError
        If an axis has combs of different spacings.
    """
    assert sampler.kernel is not None
    found: list[OutsideRange] = []
    for support in _subsets(tuple(range(1, int(sampler.dim) + 1))):
        if not support:
            continue
        terms = sampler.kernel.restrict(support_counts(sampler.layout, support))
        factors = [_factors(sampler, term, support) for term in terms]
        spacings = _spacings(factors, counts)
        for on in _subsets(tuple(spacings)):
            teeth = {axis: spacings[axis] for axis in on}
            values = [_value(terms, factors, counts, teeth, {far: half + 1}) for far in support]
            lower = max(0.0, min(float(v.lower()) for v in values))
            upper = min(float(counts["N"]), max(float(v.upper()) for v in values))
            found.append(OutsideRange(support, teeth, lower, upper))
    return tuple(found)


def _subsets(items: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    return chain.from_iterable(combinations(items, k) for k in range(len(items) + 1))


def _factors(sampler: Sampler, term: Term, support: tuple[int, ...]) -> dict[int, Factor]:
    """The term's factor on each coordinate of the support that has one."""
    found: dict[int, Factor] = {}
    for index, factor in term.factors:
        group = sampler.layout.groups[index]
        first = int(group.first)
        found |= {i: factor for i in support if first <= i < first + int(group.size)}
    return found


def _spacings(factors: list[dict[int, Factor]], counts: Mapping[str, int]) -> dict[int, int]:
    """The spacing c > 1 of the comb of each axis that has one."""
    found: dict[int, set[int]] = {}
    for axis, factor in (pair for term in factors for pair in term.items()):
        for _, atom in factor.terms:
            found.setdefault(axis, set()).update(
                int(element_rational(c, counts).p) for c in atom.combs
            )
    kept = {axis: sorted(c - {1}) for axis, c in found.items() if c - {1}}
    for axis, combs in kept.items():
        if len(combs) > 1:
            raise InputError(f"axis {axis} must have combs of one spacing: got {combs}")
    return {axis: combs[0] for axis, combs in kept.items()}


def _value(
    terms: tuple[Term, ...],
    factors: list[dict[int, Factor]],
    counts: Mapping[str, int],
    teeth: Mapping[int, int],
    least: Mapping[int, int],
) -> Ball:
    """The sum of the terms where |m_i| >= least_i (or 1) and the coordinates lie on the teeth."""
    total = flint.arb(0)
    for term, by_axis in zip(terms, factors, strict=True):
        value = flint.arb(element_rational(term.coefficient, counts))
        for axis, factor in by_axis.items():
            value *= _factor_range(factor, counts, teeth.get(axis), least.get(axis, 1))
        total += value
    return total


def _factor_range(factor: Factor, counts: Mapping[str, int], tooth: int | None, least: int) -> Ball:
    """Of one coordinate at |m| >= least and, where told, on the multiples of a comb's spacing."""
    total = flint.arb(0)
    for coefficient, atom in factor.terms:
        spacings = {int(element_rational(c, counts).p) for c in atom.combs} - {1}
        if spacings and tooth is None:
            continue
        value = flint.arb(element_rational(coefficient, counts))
        for shape, count in atom.shapes:
            n = int(element_rational(count, counts).p)
            if tooth is not None and tooth % n == 0 and shape.vanishes_on_integers:
                value = flint.arb(0)
            value *= _shape_range(shape, flint.arb(max(least, tooth or 1)) / n)
        total += value
    return total


def _shape_range(shape: Shape, x: Ball) -> Ball:
    """Of g at arguments from x > 0 on."""
    slow = 1 / (flint.arb.pi() * x)
    match shape.kind:
        case "sinc2":
            largest = slow**2
        case "tent":
            largest = flint.arb.max(1 - x, flint.arb(0))
        case "stretched":
            assert shape.beta is not None
            largest = (-(x ** exact_ball(shape.beta))).exp()
        case "difference":
            largest = flint.arb.min(slow**4 + slow**3 / 2, flint.arb(1))
            return (-largest).union(largest)
    return flint.arb(0).union(flint.arb.min(largest, flint.arb(1)))
