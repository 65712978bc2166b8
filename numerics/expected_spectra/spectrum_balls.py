"""Exact expected power spectra in ball arithmetic: coefficients and N·P_S(m) with proven bounds.

The same kernels as ``spectra`` evaluates, term by term as they are written: cancellation widens
the ball and is cured by precision (``balls.certified``), never by another formula.
"""

from collections.abc import Mapping, Sequence

from ...theory.kernels import Factor
from ...theory.samplers import Sampler
from ...theory.symbolic import FracElement
from ..balls import Ball, flint
from .shape_values import shape_ball
from .spectra import support_counts
from .spectrum_forms import element_fraction


def element_ball(element: FracElement, counts: Mapping[str, int]) -> Ball:
    """A coefficient of a kernel, an element of Q(π², counts), at the precision in force."""
    values = [flint.arb.pi() ** 2, *(flint.arb(counts[str(s)]) for s in element.field.symbols[1:])]
    over, under = (_polynomial_ball(p, values) for p in (element.numer, element.denom))
    return over / under


def _polynomial_ball(polynomial: FracElement, values: Sequence[Ball]) -> Ball:
    total = flint.arb(0)
    for powers, number in polynomial.terms():
        term = flint.arb(flint.fmpq(int(number.numerator), int(number.denominator)))
        for value, k in zip(values, powers, strict=True):
            if k:
                term *= value**k
        total += term
    return total


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
