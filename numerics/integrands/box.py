"""Box prod_i 1[x_i < a_i]: |fhat(m)|^2 = prod_i a_i^2 sinc^2(a_i m_i)."""

from fractions import Fraction

from ...theory.errors import InputError
from .literals import literal
from .separable import Separable
from .spline import SplineFactor


def box(sides: tuple[Fraction, ...]) -> Separable:
    """Indicator of the axis-aligned box with a corner at the origin: ``box:side=...``.

    Parameters
    ----------
    sides : tuple of Fraction
        Sides a_i, each 0 < a_i <= 1 and not all 1; a side 1 leaves its coordinate out.

    Raises
    ------
    InputError
        If a side is out of range, or all are 1.
    """
    for side in sides:
        if not 0 < side <= 1:
            raise InputError(f"box: side must satisfy 0 < side <= 1: got {literal(side)}")
    if all(side == 1 for side in sides):
        raise InputError(f"box: some side must satisfy side < 1: got {literal(sides)}")
    same = len(set(sides)) == 1
    part = tuple((i, interval(a)) for i, a in enumerate(sides, 1) if a < 1)
    return Separable(f"box:side={literal(sides[0] if same else sides)}", len(sides), (part,))


def interval(length: Fraction) -> SplineFactor:
    """Indicator of ``0 <= x < a``, ``0 < a < 1``: ``a + B_1({x - a}) - B_1(x)``."""
    return SplineFactor(length, 1, ((Fraction(1), length), (Fraction(-1), Fraction(0))))
