r"""Shapes: even functions g(x), g(0) = 1, of which spectra are made, and their series at x = 0.

A shape stands in a spectrum as g(m/n), with a count n. Of two points, apart by Δ/n on an axis, it
is E exp(−2πi m Δ/n):

    sinc²(x)                                   Δ of two uniform points of a cell;
    exp(−|x|^β), 0 < β <= 2                    Δ of two β-stable displacements;
    3 sinc³(x) sinc(3x) − 2 sinc²(x) sinc(4x)  any two points of difference jitter, on average

(``samplers/difference_jitter.py``), and (1 − |x|)^+ is the share of a box of frequencies that it
has in common with the box moved by m (``samplers/box_dpp.py``). The lowest power of |x| in 1 − g,
the degree b of 1 − g(m/n) as a spectrum, is 2, β, 4 and 1.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import takewhile
from math import factorial
from typing import Literal


@dataclass(frozen=True)
class Shape:
    """An even function g(x) with g(0) = 1.

    Parameters
    ----------
    kind : {"sinc2", "tent", "stretched", "difference"}
        sinc²(x), (1 − |x|)^+, exp(−|x|^β), or the mean over the pairs of difference jitter.
    beta : Fraction, optional
        β of ``stretched``, 0 < β <= 2.
    """

    kind: Literal["sinc2", "tent", "stretched", "difference"]
    beta: Fraction | None = None

    @property
    def degree(self) -> Fraction:
        """The lowest power of |x| in 1 − g(x)."""
        return next(t.power for t in _terms(self) if t.power > 0)

    @property
    def vanishes_on_integers(self) -> bool:
        """Whether g(x) = 0 for every whole x ≠ 0."""
        return self.kind != "stretched"


SINC2 = Shape("sinc2")
TENT = Shape("tent")
DIFFERENCE = Shape("difference")


def stretched(beta: Fraction) -> Shape:
    """exp(−|x|^β)."""
    return Shape("stretched", beta)


@dataclass(frozen=True)
class PowerTerm:
    """rational · π^(2 half_pi) · |x|^power, a term of a series at x = 0."""

    power: Fraction
    rational: Fraction
    half_pi: int = 0


@cache
def series(shape: Shape, highest: Fraction) -> tuple[PowerTerm, ...]:
    """The terms of g(x) up to |x|^highest, by rising powers, zero terms left out.

    Notes
    -----
    The series of ``tent`` ends and holds for |x| <= 1; the others converge everywhere.
    """
    return tuple(takewhile(lambda t: t.power <= highest, _terms(shape)))


def _terms(shape: Shape) -> Iterator[PowerTerm]:
    match shape.kind:
        case "sinc2":
            return _sinc2_terms()
        case "tent":
            return iter((PowerTerm(Fraction(0), Fraction(1)), PowerTerm(Fraction(1), Fraction(-1))))
        case "stretched":
            assert shape.beta is not None
            return _stretched_terms(shape.beta)
        case "difference":
            return _difference_terms()


def _sinc2_terms() -> Iterator[PowerTerm]:
    """From sinc²(x) = (1 − cos 2πx)/(2π²x²)."""
    k = 0
    while True:
        rational = Fraction((-1) ** k * 2 ** (2 * k + 1), factorial(2 * k + 2))
        yield PowerTerm(Fraction(2 * k), rational, k)
        k += 1


def _stretched_terms(beta: Fraction) -> Iterator[PowerTerm]:
    k = 0
    while True:
        yield PowerTerm(k * beta, Fraction((-1) ** k, factorial(k)))
        k += 1


def _difference_terms() -> Iterator[PowerTerm]:
    """With φ = 2πx, 16 sin³(φ/2) sin(3φ/2)/φ⁴ − 4 sin²(φ/2) sin(2φ)/φ³ in waves is

    2 (cos 3φ − 3 cos 2φ + 3 cos φ − 1)/φ⁴ + (sin 3φ − 2 sin 2φ + sin φ)/φ³.
    """
    k = 0
    while True:
        cosines = Fraction(2 * (3 ** (2 * k + 4) - 3 * 2 ** (2 * k + 4) + 3), factorial(2 * k + 4))
        sines = Fraction(3 ** (2 * k + 3) - 2 * 2 ** (2 * k + 3) + 1, factorial(2 * k + 3))
        if cosines != sines:
            yield PowerTerm(Fraction(2 * k), (-4) ** k * (cosines - sines), k)
        k += 1
