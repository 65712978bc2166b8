"""Quadrature over the sphere of directions, for spectra with their ridges on axes and diagonals.

Spectra of stratified points are even in every coordinate, so that one orthant does. It is cut into
the d faces of a box, in two dimensions (a_1, a_2 u) and (a_1 u, a_2) with 0 < u < 1, and each has a
Gauss-Legendre rule. The axes and the diagonals of the box are edges of faces: near them an
integrand need only be smooth from each side. Errors are estimates, from the change between orders
of the rule.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import gamma, pi

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from .densities import Expanded, density_array

Floats = NDArray[np.float64]

_ORDERS = (4, 6, 9, 13, 19, 28, 40)
_ROUNDING = 1e-13
_MOST_NODES = 1_500_000
_AT_ONCE = 1_000_000


@dataclass(frozen=True)
class Estimated:
    """A value and an estimate, not a bound, of its absolute error."""

    value: float
    error: float


def refined(
    evaluate: Callable[[int], float],
    size: float,
    tolerance: float,
    orders: Sequence[int] = _ORDERS,
) -> Estimated:
    """``evaluate(order)`` at growing orders until it stands still.

    The error is the last change, or a hundredth of the change before where two values agree by
    chance.

    Parameters
    ----------
    evaluate : callable
    size : float
        Of the terms that are added up: it times 1e-13 is counted as rounding.
    tolerance : float
        Relative.
    orders : sequence of int
        Three or more.
    """
    before, value = evaluate(orders[0]), evaluate(orders[1])
    change = error = abs(value - before)
    for order in orders[2:]:
        before, value = value, evaluate(order)
        error = max(abs(value - before), change / 100)
        change = abs(value - before)
        if error <= tolerance * abs(value):
            break
    return Estimated(value, error + _ROUNDING * size)


def sphere_area(dim: int) -> float:
    """|S^(d−1)| = 2π^(d/2)/Γ(d/2); 2 in one dimension."""
    return 2 * pi ** (dim / 2) / gamma(dim / 2)


def sphere_rule(sides: Sequence[float], order: int) -> tuple[Floats, Floats]:
    """Directions in the positive orthant and their weights, for functions even in each coordinate.

    Parameters
    ----------
    sides : sequence of float, length d
        a_i > 0 of the box.
    order : int
        Gauss-Legendre nodes along each side of a face.

    Returns
    -------
    e : array of shape (k, d)
    weights : array of shape (k,)
        Their sum is |S^(d−1)|: the other orthants are counted.

    Notes
    -----
    On the face x_i = a_i the cone over a surface element has de = a_i ∏ dx_j/|x|^d. With x_j =
    a_i sinh v the pole of 1/|x|^d near the edge of a long box goes away from the nodes.
    """
    dim = len(sides)
    x, w = np.polynomial.legendre.leggauss(order)
    points: list[Floats] = []
    weights: list[Floats] = []
    for face, height in enumerate(sides):
        lengths = [np.arcsinh(a / height) for j, a in enumerate(sides) if j != face]
        v = _grid([(x + 1) / 2 * length for length in lengths])
        area = _grid([w / 2 * length for length in lengths]).prod(axis=1)
        flat = np.insert(np.sinh(v), face, 1.0, axis=1)
        norm = np.linalg.norm(flat, axis=1)
        points.append(flat / norm[:, None])
        weights.append(2**dim * area * np.cosh(v).prod(axis=1) / norm**dim)
    return np.concatenate(points), np.concatenate(weights)


def _grid(axes: Sequence[Floats]) -> Floats:
    """All combinations of the nodes of several axes, one in each row; one empty row for none."""
    if not axes:
        return np.zeros((1, 0))
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


def shell_mean(density: Expanded, rho: Floats, order: int) -> Floats:
    """S̄(ρ), the mean of S over the sphere of radius ρ.

    Parameters
    ----------
    rho : array of shape (k,)
    order : int
        Of the rule on each side of a face.
    """
    e, weights = sphere_rule((1.0,) * density.dim, order)
    require_nodes(len(rho) * len(e))
    weights = weights / weights.sum()
    rows = max(1, _AT_ONCE // len(e))
    parts = [
        density_array(density, rho[k : k + rows, None, None] * e[None, :, :]) @ weights
        for k in range(0, len(rho), rows)
    ]
    return np.concatenate(parts)


def require_nodes(nodes: int) -> None:
    """Refuse grids of frequencies that are too large to be worth their time."""
    if nodes > _MOST_NODES:
        raise InputError(f"sphere times radius must have at most {_MOST_NODES} nodes: got {nodes}")
