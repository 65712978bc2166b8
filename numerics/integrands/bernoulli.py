"""Bernoulli polynomial f = prod over the axes of B_k(x_i): |fhat(m)|^2 = (k!/(2 pi m)^k)^2 each."""

from fractions import Fraction

from ...theory.errors import InputError
from .literals import literal
from .separable import Separable
from .spline import SplineFactor

_HIGHEST = 12  # B_k(x) keeps its digits in double precision up to here


def bernoulli(dim: int, k: int, axes: tuple[int, ...]) -> Separable:
    """``B_k(x_i)`` multiplied over the given axes, all its power on that one support.

    Parameters
    ----------
    dim : int
        Number of coordinates.
    k : int
        Degree, 1 <= k <= 12; the power on an axis decays as m^(-2k).
    axes : tuple of int
        Coordinates that f depends on, counted from 1, strictly increasing.

    Raises
    ------
    InputError
        If the degree or the axes are out of range.
    """
    require_degree("bernoulli", k)
    listed = literal(tuple(map(Fraction, axes)))
    if not axes or axes != tuple(sorted(set(axes))) or axes[0] < 1 or axes[-1] > dim:
        rule = f"bernoulli: axes must be increasing numbers from 1 to {dim}"
        raise InputError(f"{rule}: got {listed}")
    suffix = "" if axes == (1,) else f",axes={listed}"
    wave = bernoulli_factor(Fraction(0), k, Fraction(1))
    return Separable(f"bernoulli:k={k}{suffix}", dim, (tuple((i, wave) for i in axes),))


def bernoulli_factor(constant: Fraction, k: int, weight: Fraction) -> SplineFactor:
    """``constant + weight B_k(x)``."""
    return SplineFactor(constant, k, ((weight, Fraction(0)),))


def require_degree(name: str, k: int, key: str = "k") -> None:
    """Raise InputError unless the degree of a Bernoulli polynomial is in range."""
    if not 1 <= k <= _HIGHEST:
        raise InputError(f"{name}: {key} must satisfy 1 <= {key} <= {_HIGHEST}: got {k}")
