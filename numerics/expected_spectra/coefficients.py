"""Coefficients of kernels, elements of Q(π², counts), as exact rational numbers at given counts."""

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from ...theory.errors import InputError
from ...theory.symbolic import FracElement
from ..balls import flint

Rational: TypeAlias = Any
"""A ``flint.fmpq``."""


def element_rational(element: FracElement, counts: Mapping[str, int]) -> Rational:
    """A coefficient without π² at integer counts.

    Raises
    ------
    InputError
        If π² occurs in it: the spectra of points have none.
    """
    values = [flint.fmpq(counts[s.name]) for s in element.field.symbols[1:]]
    over, under = (_polynomial_rational(p, values) for p in (element.numer, element.denom))
    return over / under


def _polynomial_rational(polynomial: FracElement, values: Sequence[Rational]) -> Rational:
    total = flint.fmpq(0)
    for powers, number in polynomial.terms():
        if powers[0]:
            raise InputError(f"a coefficient of a spectrum must be rational: got {polynomial}")
        term = flint.fmpq(int(number.numerator), int(number.denominator))
        for value, k in zip(values, powers[1:], strict=True):
            if k:
                term *= value**k
        total += term
    return total
