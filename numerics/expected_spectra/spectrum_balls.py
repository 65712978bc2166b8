"""Exact expected power spectra in ball arithmetic: coefficients and N·P_S(m) with proven bounds.

The same kernels as ``spectra`` evaluates, term by term as they are written: cancellation widens
the ball and is cured by precision (``balls.certified``), never by another formula.
"""

from collections.abc import Mapping, Sequence

from ...theory.kernels import Factor
from ...theory.samplers import Sampler
from ...theory.symbolic import FracElement
from ..balls import Ball, Rational, flint
from .coefficients import counts_in_order, element_fraction, evaluated
from .shape_values import shape_ball
from .spectra import support_counts


def element_ball(element: FracElement, counts: Mapping[str, int]) -> Ball:
    """A coefficient of a kernel, an element of Q(π², counts), at the precision in force."""
    values = [flint.arb.pi() ** 2, *map(flint.arb, counts_in_order(element, counts))]
    return evaluated(element, values, lambda p, q: flint.arb(flint.fmpq(p, q)))


def element_rational(element: FracElement, counts: Mapping[str, int]) -> Rational:
    """A coefficient without π² as an exact rational number.

    Raises
    ------
    InputError
        If π² occurs in it.
    """
    values = [None, *map(flint.fmpq, counts_in_order(element, counts))]
    return evaluated(element, values, flint.fmpq)


def scaled_power_ball(sampler: Sampler, counts: Mapping[str, int], m: Sequence[int]) -> Ball:
    """N·P_S(m) at one integer frequency m ≠ 0.

    Parameters
    ----------
    sampler : Sampler
        With a kernel.
    counts : mapping of str to int
        Every count of the kernel.
    m : sequence of int, length d
    """
    layout = sampler.layout
    support = [i + 1 for i, k in enumerate(m) if k]
    total = flint.arb(0)
    assert sampler.kernel is not None
    for term in sampler.kernel.restrict(support_counts(layout, support)):
        value = element_ball(term.coefficient, counts)
        for group, factor in term.factors:
            first = int(layout.groups[group].first)
            for i in support:
                if first <= i < first + int(layout.groups[group].size):
                    value *= _factor_ball(factor, counts, m[i - 1])
        total += value
    return total


def _factor_ball(factor: Factor, counts: Mapping[str, int], m: int) -> Ball:
    total = flint.arb(0)
    for coefficient, atom in factor.terms:
        value = element_ball(coefficient, counts)
        for comb in atom.combs:
            if m % int(element_fraction(comb, counts)):
                value = flint.arb(0)
        for shape, count in atom.shapes:  # at any precision the count is exact
            value *= shape_ball(shape, m, int(element_fraction(count, counts)))
        total += value
    return total
