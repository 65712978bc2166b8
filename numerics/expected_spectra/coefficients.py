"""Coefficients of kernels, elements of Q(π², counts), as numbers of any kind at given counts."""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, TypeVar

from ...theory.errors import InputError
from ...theory.symbolic import FracElement
from ..integrands.protocol import Mpf, mp

Number = TypeVar("Number")


def evaluated(
    element: FracElement, values: Sequence[Any], quotient: Callable[[int, int], Number]
) -> Number:
    """A coefficient at values of its generators.

    Parameters
    ----------
    element : element of Q(π², counts)
    values : sequence of Number
        π², or None where it must not occur, and the counts in the order of the field.
    quotient : callable
        A rational number p/q as a Number.

    Raises
    ------
    InputError
        If π² occurs in it and its value is None: the spectra of points have none.
    """
    over, under = (_polynomial(p, values, quotient) for p in (element.numer, element.denom))
    return over / under


def _polynomial(
    polynomial: FracElement, values: Sequence[Any], quotient: Callable[[int, int], Any]
) -> Any:
    total = quotient(0, 1)
    for powers, number in polynomial.terms():
        if powers[0] and values[0] is None:
            raise InputError(f"a coefficient of a spectrum must be rational: got {polynomial}")
        term = quotient(int(number.numerator), int(number.denominator))
        for value, k in zip(values, powers, strict=True):
            if k:
                term *= value**k
        total += term
    return total


def counts_in_order(element: FracElement, counts: Mapping[str, Any]) -> list[Any]:
    """The counts as the field of a coefficient lists them after π²."""
    return [counts[str(s)] for s in element.field.symbols[1:]]


def element_value(element: FracElement, counts: Mapping[str, Any]) -> Mpf:
    """A coefficient as a number of mpmath."""
    values = [mp.pi**2, *map(mp.mpf, counts_in_order(element, counts))]
    return evaluated(element, values, lambda p, q: mp.mpf(p) / q)


def element_fraction(element: FracElement, counts: Mapping[str, int]) -> Fraction:
    """A coefficient without π² as an exact number."""
    values = [None, *(Fraction(int(n)) for n in counts_in_order(element, counts))]
    return evaluated(element, values, Fraction)
