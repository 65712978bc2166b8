"""Half-space x_1 < a, on the torus a strip: |fhat(m)|^2 = a^2 sinc^2(a m_1), else 0."""

from fractions import Fraction

from ...theory.errors import InputError
from .box import interval
from .literals import literal
from .separable import Separable


def half_space(dim: int, side: Fraction) -> Separable:
    """Indicator of ``x_1 < a``: ``half-space:side=...``; all its power lies on the first axis.

    Parameters
    ----------
    dim : int
        Number of coordinates.
    side : Fraction
        a, with 0 < a < 1.

    Raises
    ------
    InputError
        If the side is out of range.
    """
    if not 0 < side < 1:
        raise InputError(f"half-space: side must satisfy 0 < side < 1: got {literal(side)}")
    return Separable(f"half-space:side={literal(side)}", dim, (((1, interval(side)),),))
