"""The whole of Eq. 4 and Eq. 17 on R^d: (1/N) ∫ S(ν) |Ff(ν)|² dν, by five routes.

S is the density of a sampler's kernel (``densities``), so that this is the integral as the paper
prints it, over all real frequencies; for jitter it is also the variance of the stationary process,
jitter on the infinite lattice of cells, and what the torus gives where nothing wraps round. A
product of sinc² is the mean of cos 2πν·Δ over the difference Δ of two points of a cell, so that

    N·V = S(0) C(0) − Σ_k c_k E[C(0) − C(Δ_k)],        C(h) = ∫ f(x) f(x + h) dx.

- ``closed``: the Gaussian, whose E C is a product of 1 − m(y), y = 1/(4σ²n²), with
  m = 1 − √(π/y) erf √y + (1 − e^−y)/y;
- ``cartesian``: Eq. 4, the Gaussian's integrals over each coordinate of ν in ball arithmetic, and
  that of the ball in one dimension;
- ``covariogram``: E C in ball arithmetic, for the Gaussian and, to three dimensions, the ball;
- ``directions``: Eq. 17, radial integrals added up over the sphere;
- ``shells``: Eq. 6 with its factor |S^(d−1)|, spherical means integrated over the radius.

The first three are proven bounds, the last two estimates.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, log2

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from ..balls import Ball, certified, exact_ball, flint, rational, spelled
from ..exact_variances.cell_means import mean_over_cell
from ..exact_variances.covariogram_series import mean_deficit
from ..exact_variances.covariograms import Covariogram, at_zero, scale
from .axis_integrals import gaussian_deficit
from .densities import Density, density_of, expanded
from .oscillating_integrals import ball_axis_integral
from .space_integrands import SpaceBall, SpaceGaussian, SpaceIntegrand
from .sphere_integrals import ball_directions, ball_shells, gaussian_directions, gaussian_shells
from .sphere_rules import Estimated

CERTIFIED = ("closed", "cartesian", "covariogram")
ESTIMATED = ("directions", "shells")
LARGEST_DIM = 3
"""Of the sphere, and of the ball's covariogram."""


@dataclass(frozen=True)
class WholeIntegral:
    """A value of Eq. 4 on R^d and its error.

    Parameters
    ----------
    value, error : str
        Decimals.
    is_bound : bool
        Whether the error is proven; else it is an estimate.
    route : str
    seconds : float
    """

    value: str
    error: str
    is_bound: bool
    route: str
    seconds: float


def whole_integral(
    sampler: Sampler,
    counts: Mapping[str, int],
    integrand: SpaceIntegrand,
    route: str = "covariogram",
    digits: int = 15,
) -> WholeIntegral:
    """(1/N) ∫ S |Ff|² dν over R^d by one route.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in the dimension of the integrand.
    counts : mapping of str to int
        Every count of the kernel, N among them.
    integrand : SpaceBall or SpaceGaussian
    route : {"closed", "cartesian", "covariogram", "directions", "shells"}
    digits : int
        Of the certified routes; the others are in double precision.

    Raises
    ------
    InputError
        If the dimensions differ, or the route does not have this case.
    """
    density = density_of(sampler, counts)
    if density.dim != integrand.dim:
        raise InputError(f"sampler and integrand must have one dim: got {sampler.dim}, {integrand}")
    began = time.perf_counter()
    if route in CERTIFIED:
        evaluate = _certified_evaluation(density, integrand, route)
        found = spelled(certified(lambda: evaluate() / density.count, digits), digits)
        value, error = found.value, found.error_bound
    elif route in ESTIMATED:
        if density.dim > LARGEST_DIM:
            raise InputError(f"route {route} must satisfy dim <= {LARGEST_DIM}: got {density.dim}")
        estimate = _estimate(density, integrand, route)
        value, error = (repr(x / density.count) for x in (estimate.value, estimate.error))
    else:
        names = ", ".join(CERTIFIED + ESTIMATED)
        raise InputError(f"a route is one of {names}: got {route!r}")
    return WholeIntegral(value, error, route in CERTIFIED, route, time.perf_counter() - began)


def _estimate(density: Density, integrand: SpaceIntegrand, route: str) -> Estimated:
    if isinstance(integrand, SpaceBall):
        return (ball_directions if route == "directions" else ball_shells)(density, integrand)
    directions = route == "directions"
    return (gaussian_directions if directions else gaussian_shells)(density, integrand)


def _certified_evaluation(
    density: Density, integrand: SpaceIntegrand, route: str
) -> Callable[[], Ball]:
    """N·V as a ball at the precision in force."""
    if isinstance(integrand, SpaceGaussian):
        return lambda: _gaussian(density, integrand, route)
    if route == "cartesian" and density.dim == 1:
        return lambda: _interval(density, integrand)
    if route != "covariogram" or density.dim > LARGEST_DIM:
        got = f"route {route}, dim {density.dim}"
        raise InputError(f"a certified ball needs covariogram and dim <= {LARGEST_DIM}: got {got}")
    return lambda: _ball(density, integrand)


def _gaussian(density: Density, gaussian: SpaceGaussian, route: str) -> Ball:
    """Σ_k c_k ∏_i Σ_j w_kij √π σ_i (1 − m(y_kij)); the sum cancels, and is made more precise."""
    known: dict[tuple[Fraction, int], Ball] = {}

    def kept(sigma: Fraction, strata: int | None) -> Ball:
        if strata is None:
            return flint.arb(1)
        if (sigma, strata) not in known:
            y = 1 / (2 * sigma * strata) ** 2
            deficit = erf_deficit(y) if route == "closed" else gaussian_deficit(1, y, route)
            known[sigma, strata] = 1 - deficit
        return known[sigma, strata]

    total = flint.arb(0)
    for coefficient, factors in density.terms:
        term = exact_ball(coefficient)
        for sigma, factor in zip(gaussian.sigmas, factors, strict=True):
            term *= sum((exact_ball(w) * kept(sigma, n) for w, n in factor), flint.arb(0))
        total += term
    energy = flint.arb(1)
    for sigma in gaussian.sigmas:
        energy *= flint.arb.pi().sqrt() * exact_ball(sigma)
    return total * energy


def erf_deficit(y: Fraction) -> Ball:
    """m(y) = 1 − √(π/y) erf √y + (1 − e^−y)/y, the mean of 1 − e^(−yτ²) over a triangle.

    Parameters
    ----------
    y : Fraction
        y > 0; below 1 two orders cancel, which a higher precision makes good.
    """
    bits = flint.ctx.prec
    try:
        flint.ctx.prec = bits + 2 * max(0, ceil(-log2(y))) + 10
        ball = exact_ball(y)
        root = ball.sqrt()
        return 1 - flint.arb.pi().sqrt() * root.erf() / root - (-ball).expm1() / ball
    finally:
        flint.ctx.prec = bits


def _interval(density: Density, ball: SpaceBall) -> Ball:
    """The frequency integral in one dimension: twice that along the axis."""
    whole, diameter = expanded(density), 2 * ball.radius
    total = exact_ball(whole.total)
    for coefficient, (n,) in whole.products:
        if n is not None:
            total -= exact_ball(coefficient) * ball_axis_integral(1, 0, 1 / (diameter * n))
    return total * exact_ball(diameter)


def _ball(density: Density, ball: SpaceBall) -> Ball:
    """S(0) C(0) − Σ_k c_k E[C(0) − C(Δ_k)], lengths in units of 2R."""
    whole, plain = expanded(density), Covariogram(density.dim, 0)
    total = exact_ball(whole.total) * at_zero(plain)
    for coefficient, strata in whole.products:
        widths = [rational(1 / (2 * ball.radius * n)) for n in strata if n is not None]
        total -= exact_ball(coefficient) * _ball_deficit(plain, widths)
    return total * scale(plain, rational(ball.radius))


def _ball_deficit(plain: Covariogram, widths: list[Ball]) -> Ball:
    """E[C(0) − C(Δ)] in the covariogram's unit; by its series where all of Δ is well within 2R."""
    if sum(w * w for w in widths) < flint.fmpq(9, 10):
        return mean_deficit(plain, widths)
    if len(widths) < plain.dim:
        raise InputError(f"cells wider than the ball must have all {plain.dim} sides: got {widths}")
    return at_zero(plain) - mean_over_cell(plain, [(flint.fmpq(0), w) for w in widths])
