"""Sphere times radius: the whole of Eq. 17 in double precision, per direction and per shell.

    N·V = ∫_{S^(d−1)} [∫_0^∞ ρ^(d−1) S(ρe) |Ff(ρe)|² dρ] de       (directions, Eq. 17)
        = |S^(d−1)| ∫_0^∞ ρ^(d−1) S̄(ρ) |Ff(ρ)|² dρ                (shells, Eq. 6 with its factor)

with S the density of a kernel and S̄ its mean over the sphere. The second needs one of the two
spectra to be radial, not both; here it is the integrand's. All errors are estimates.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from math import ceil, pi, prod, sqrt

import numpy as np

from ...theory.errors import InputError
from ..balls import Ball, certified, exact_ball, flint
from .densities import Density, Expanded, density_array, expanded
from .direction_integrals import direction_deficit
from .space_integrands import SpaceBall, SpaceGaussian
from .sphere_rules import (
    Estimated,
    Floats,
    refined,
    require_nodes,
    shell_mean,
    sphere_area,
    sphere_rule,
)

_EDGE = 6.5  # exp(−6.5²) = 4e-19: there the radial integral of a Gaussian ends
_WIDEST = Fraction(99, 100)  # of (diagonal of a cell/2R)²: 3F2(x²) needs 1/(1 − x²) terms a digit
_REACH = {1: 400, 2: 32, 3: 12}  # the frequency, in strata, at which shells of a ball end
_PANEL = 12  # Gauss-Legendre nodes for one period of J²


def gaussian_directions(
    density: Density, gaussian: SpaceGaussian, tolerance: float = 1e-13
) -> Estimated:
    """N·V of a Gaussian: directions outside, radial integrals inside."""
    sigmas = np.array([float(s) for s in gaussian.sigmas])
    scale = float(np.prod(2 * pi * sigmas**2))
    whole = expanded(density)

    def evaluate(spectrum: Expanded, order: int) -> float:
        e, weights = sphere_rule(list(1 / sigmas), order)
        width = np.linalg.norm(e * sigmas, axis=1)  # of the Gaussian's projection on e
        x, radial = radial_nodes(whole, sigmas, order)
        require_nodes(len(x) * len(e))
        nu = x[None, :, None] / (2 * pi * width[:, None, None]) * e[:, None, :]
        inner = density_array(spectrum, nu) @ (radial * x ** (density.dim - 1) * np.exp(-x * x))
        return scale * float(weights @ (inner / (2 * pi * width) ** density.dim))

    return refined(partial(evaluate, whole), evaluate(whole.size, 6), tolerance)


def gaussian_shells(
    density: Density, gaussian: SpaceGaussian, tolerance: float = 1e-13
) -> Estimated:
    """N·V of an isotropic Gaussian: the mean of S over each sphere first, then one integral.

    Raises
    ------
    InputError
        If the widths differ.
    """
    if not gaussian.is_isotropic:
        raise InputError(f"shells need a radial integrand: got widths {gaussian.sigmas}")
    sigma, dim = float(gaussian.sigmas[0]), density.dim
    scale = sphere_area(dim) * sigma**dim
    whole = expanded(density)

    def evaluate(spectrum: Expanded, order: int) -> float:
        x, radial = radial_nodes(whole, np.full(dim, sigma), order)
        mean = shell_mean(spectrum, x / (2 * pi * sigma), order)
        return scale * float(radial @ (x ** (dim - 1) * np.exp(-x * x) * mean))

    return refined(partial(evaluate, whole), evaluate(whole.size, 6), tolerance)


def radial_nodes(density: Expanded, sigmas: Floats, order: int) -> tuple[Floats, Floats]:
    """Gauss-Legendre for ∫ .. e^(−x²) dx, x = 2πσρ; more nodes where sinc² oscillates.

    Parameters
    ----------
    density : Expanded
    sigmas : array of shape (d,)
    order : int

    Returns
    -------
    x, weights : arrays of shape (k,)
        On 0 < x < 6.5; e^(−x²) is not in the weights.
    """
    phase = _EDGE / (2 * float(sigmas.min()) * min(_strata(density), default=1))
    x, w = np.polynomial.legendre.leggauss(2 * order + ceil(3 * phase))
    return (x + 1) * _EDGE / 2, w * _EDGE / 2


def _strata(density: Expanded) -> list[int]:
    return [n for _, axes in density.products for n in _used(axes)]


def _used(strata: Sequence[int | None]) -> list[int]:
    return [n for n in strata if n is not None]


def ball_directions(density: Density, ball: SpaceBall, tolerance: float = 1e-12) -> Estimated:
    """N·V of a ball: directions outside, radial integrals inside, each in closed form.

    Raises
    ------
    InputError
        If the diagonal of a cell is not below 2R.
    """
    whole = expanded(density)
    for _, strata in whole.products:
        _require_small_cells(strata, 2 * ball.radius)
    volume = sphere_area(ball.dim) * float(ball.radius) ** ball.dim / ball.dim

    def evaluate(spectrum: Expanded, order: int) -> float:
        deficits = [float(c) * _ball_deficit(ball, n, order) for c, n in spectrum.products]
        return float(spectrum.total) * volume - sum(deficits)

    return refined(partial(evaluate, whole), evaluate(whole.size, 6), tolerance)


def _ball_deficit(ball: SpaceBall, strata: Sequence[int | None], order: int) -> float:
    """∫ (1 − ∏ sinc²(ν_i/n_i)) |Ff|² dν; the faces of the rule are those of a cell's dual."""
    e, weights = sphere_rule([float(n or 1) for n in strata], order)
    cells = [(axis, 2 * ball.radius * n) for axis, n in enumerate(strata) if n is not None]

    def radial(direction: Sequence[float]) -> Ball:
        widths = [flint.arb(direction[axis]) / exact_ball(cell) for axis, cell in cells]
        return direction_deficit(ball.dim, widths)

    deficits = [float(certified(partial(radial, row), 15).mid()) for row in e.tolist()]
    return float(ball.radius) ** ball.dim * float(weights @ np.array(deficits))


def _require_small_cells(strata: Sequence[int | None], diameter: Fraction) -> None:
    diagonal = sum((Fraction(1, n * n) for n in _used(strata)), Fraction(0))
    if diagonal >= diameter**2 * _WIDEST:
        got = f"strata {strata}, 2R = {diameter}"
        raise InputError(f"directions need (diagonal of a cell/2R)^2 < {_WIDEST}: got {got}")


def ball_shells(density: Density, ball: SpaceBall, tolerance: float = 1e-9) -> Estimated:
    """N·V of a ball: the mean of S over each sphere first, then one integral over ρ to a cut T.

    S − S(∞) is a sum of products, and S(∞) has a known integral: ∫_0^∞ J_{d/2}² dρ/ρ = 1/d. What
    lies beyond T is bounded, not estimated: J_ν(t)² <= 2/(π√(t² − ν²)) (Watson 1944, 13.74); where
    |ν_i| is the largest coordinate sinc²(ν_i/n_i) <= d n_i²/(πρ)², and ∫ ∏_{j≠i} sinc² over that
    part of the sphere is at most 2√d ∏_{j≠i} n_j/ρ^(d−1), by the projection along axis i.

    Raises
    ------
    InputError
        If a product leaves a coordinate out, or there are too many nodes.
    """
    from scipy.special import jv  # pyright: ignore[reportMissingTypeStubs]

    dim, radius, whole = density.dim, float(ball.radius), expanded(density)
    if any(None in strata for _, strata in whole.products):
        raise InputError("shells of a ball need products over all coordinates: got fewer")
    strata = _strata(whole) or [1]
    cut = _REACH[dim] * max(strata)
    scale = sphere_area(dim) * radius**dim

    def evaluate(spectrum: Expanded, order: int) -> float:
        rho, weights = _panels(cut, min(1 / (2 * radius), min(strata)), order)
        wave = jv(dim / 2, 2 * pi * radius * rho) ** 2 / rho
        decaying = shell_mean(spectrum, rho, order) - float(spectrum.constant)
        return scale * (float(spectrum.constant) / dim + float(weights @ (wave * decaying)))

    first = ceil(4 + 2 * cut / min(strata)) if dim > 1 else _PANEL
    orders = [first, ceil(1.15 * first), ceil(1.3 * first)]
    found = refined(partial(evaluate, whole), scale / dim, tolerance, orders)
    return Estimated(found.value, found.error + _beyond(whole, radius, cut))


def _beyond(whole: Expanded, radius: float, cut: float) -> float:
    """A bound of ∫ (S − S(∞)) |Ff|² dν over |ν| > T."""
    dim, t = whole.dim, 2 * pi * radius * cut
    cells = sum(
        abs(float(c)) * prod(map(float, _used(n))) * sum(_used(n)) for c, n in whole.products
    )
    if t <= dim:
        raise InputError(
            f"shells must reach beyond the ball's first zero: got |nu| <= {cut} for radius {radius}"
        )
    bessel = 2 / (pi * sqrt(t * t - dim * dim / 4))
    return radius**dim * 2 * dim**1.5 / pi**2 * cells * bessel / ((dim + 2) * cut ** (dim + 1))


def _panels(cut: float, length: float, order: int) -> tuple[Floats, Floats]:
    """Composite Gauss-Legendre on (0, T) with panels of about the given length."""
    panels = ceil(cut / length)
    require_nodes(panels * _PANEL)
    x, w = np.polynomial.legendre.leggauss(_PANEL + order % 3)
    step = cut / panels
    nodes = (np.arange(panels)[:, None] + (x + 1) / 2) * step
    return nodes.reshape(-1), np.tile(w * step / 2, panels)
