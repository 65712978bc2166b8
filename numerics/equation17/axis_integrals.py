"""Eq. 17 along an axis with the true spectrum of jitter, as a certified number, by three routes.

For n strata on the axis, N points and an integrand f on R^d,

    V = (1/N) ∫_0^∞ ρ^(s−1) (1 − sinc²(ρ/n)) |Ff(ρe)|² dρ,          sinc(x) = sin(πx)/(πx).

With s = d this is the summand of Eq. 17 for the direction e of the axis. With s = 1 it is half of
the integral along the line of frequencies on the axis, which is what an axis adds on the torus and
what jittered lines see (Eq. 11). 1 − sinc²(ρ/n) is the mean of 1 − cos(2πρh) over the difference
h = τ/n of two points of a cell, τ with density 2(1 − τ) on 0 < τ < 1, so that

- ball, s = d: V = (R^d/N) ∫_0^1 b(1−τ)² P_{(d−1)/2}(1 − 2b²τ²) dτ, P Legendre's function, and in
  closed form V = (R^d/N) (b/3) 3F2(1/2 − d/2, 1/2 + d/2, 1/2; 2, 5/2; b²), b = 1/(2Rn) < 1;
- Gaussian, A = ∏ 2πσ_i², a = 4π²σ², y = 1/(4σ²n²), σ the width on the axis: V = (A/N)
  Γ(s/2)/(2a^(s/2)) ∫_0^1 2(1−τ)(1 − 1F1(s/2; 1/2; −yτ²)) dτ, and in closed form the mean is
  (sy/6) 2F2(s/2 + 1, 1; 5/2, 3; −y).

Routes: ``closed`` is the hypergeometric form, ``covariogram`` ball-arithmetic quadrature of the
finite integral over τ, ``quadrature`` that of the integral over frequencies itself. The integrals
over τ follow from ∫_0^∞ J_ν(t)² sin(2zt) dt = P_{ν−1/2}(1 − 2z²)/2, 0 < z < 1, and from
∫_0^∞ ρ^(s−1) e^(−aρ²) cos(2πρh) dρ = Γ(s/2)/(2a^(s/2)) 1F1(s/2; 1/2; −π²h²/a).
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, log2

from ...theory.errors import InputError
from ..balls import Ball, Certified, certified, exact_ball, exact_number, flint, integrated, spelled
from ..integrands.grammar import parse_integrand
from .oscillating_integrals import ball_axis_integral
from .space_integrands import SpaceBall, SpaceGaussian, SpaceIntegrand, on_space

ROUTES = ("closed", "covariogram", "quadrature")
_NEAR_ONE = Fraction(999, 1000)  # 3F2(b²) in even d needs some 1000 terms a digit at 1 − b = 1e-3
_LARGEST_Y = 10_000  # 2F2(−y) loses y/ln 2 bits, and sinc²(x√y) oscillates √y times
_LARGEST_B = 20


@dataclass(frozen=True)
class AxisProblem:
    """Jitter against an integrand along the first axis.

    Parameters
    ----------
    integrand : SpaceBall or SpaceGaussian
        On R^d.
    strata : Fraction
        n > 0, cells per unit length of the axis.
    count : Fraction
        N > 0.
    region : int
        s in 1..d, of the Jacobian ρ^(s−1).
    """

    integrand: SpaceIntegrand
    strata: Fraction
    count: Fraction
    region: int

    def __post_init__(self) -> None:
        rules: list[tuple[bool, str, object]] = [
            (self.strata > 0, "0 < strata", self.strata),
            (self.count > 0, "0 < n", self.count),
            (1 <= self.region <= self.integrand.dim, "1 <= region <= dim", self.region),
        ]
        for holds, rule, value in rules:
            if not holds:
                raise InputError(f"an axis integral must satisfy {rule}: got {value}")


@dataclass(frozen=True)
class AxisResult:
    """A value with its bound, the route and the seconds it took."""

    value: Certified
    route: str
    seconds: float


def axis_integral(
    integrand: str,
    dim: int,
    n: str,
    region: int | None = None,
    route: str = "closed",
    digits: int = 15,
) -> AxisResult:
    """Eq. 17 along an axis for jitter with N^(1/d) strata on each axis, certified.

    Parameters
    ----------
    integrand : str
        A ball or a Gaussian, as ``ball:radius=0.3`` or ``gaussian:sigma=0.1``.
    dim : int
        d.
    n : str
        N, an exact number with an exact d-th root: ``1e30``.
    region : int, optional
        s in the Jacobian ρ^(s−1); d unless given.
    route : {"closed", "covariogram", "quadrature"}
    digits : int
        1 to 10 000.

    Raises
    ------
    InputError
        If a number is not one or out of its range, or the route does not have this case.
    """
    count = exact_number(n, "n")
    problem = AxisProblem(
        on_space(parse_integrand(integrand, dim)),
        _root(count, dim),
        count,
        dim if region is None else region,
    )
    return solve_axis(problem, digits, route)


def _root(count: Fraction, dim: int) -> Fraction:
    """N^(1/d), if it is rational."""
    if count > 0:
        parts = (flint.fmpz(int(p)).root(dim) for p in (count.numerator, count.denominator))
        root = Fraction(*map(int, parts))
        if root**dim == count:
            return root
    raise InputError(f"n must have an exact root of order {dim}: got {count}")


def solve_axis(problem: AxisProblem, digits: int = 15, route: str = "closed") -> AxisResult:
    """An axis integral to a number of certified digits, by one of ``ROUTES``.

    Raises
    ------
    InputError
        If the digits are out of range or the route does not have this case: for a ball ``closed``
        and ``covariogram`` need s = d and 1/(2Rn) < 1.
    """
    if not 1 <= digits <= 10_000:
        raise InputError(f"digits must be in 1..10000: got {digits}")
    if route not in ROUTES:
        raise InputError(f"a route is one of {', '.join(ROUTES)}: got {route!r}")
    began = time.perf_counter()
    evaluate = _evaluation(problem, route)
    ball = certified(lambda: evaluate() / exact_ball(problem.count), digits)
    seconds = time.perf_counter() - began
    return AxisResult(spelled(ball, digits), route, seconds)


def _evaluation(problem: AxisProblem, route: str) -> Callable[[], Ball]:
    if isinstance(problem.integrand, SpaceBall):
        return _ball(problem.integrand, problem.strata, problem.region, route)
    return _gaussian(problem.integrand, problem.strata, problem.region, route)


def _ball(ball: SpaceBall, strata: Fraction, region: int, route: str) -> Callable[[], Ball]:
    d, ratio = ball.dim, 1 / (2 * ball.radius * strata)
    if route != "quadrature" and (region != d or ratio >= 1):
        got = f"region {region} of dim {d}, 1/(2 R n) = {ratio}"
        raise InputError(f"route {route} for a ball needs region = dim, 1/(2 R n) < 1: got {got}")
    if route == "closed" and d % 2 == 0 and ratio > _NEAR_ONE:
        raise InputError(f"route closed must satisfy 1/(2 R n) <= {_NEAR_ONE}: got {ratio}")
    if ratio > _LARGEST_B:
        raise InputError(f"a ball must satisfy 1/(2 R n) <= {_LARGEST_B}: got {ratio}")
    kappa = d - region

    def evaluate() -> Ball:
        radius = exact_ball(ball.radius)
        scale = radius**d * (2 * flint.arb.pi() * radius) ** kappa
        if route == "quadrature":
            return scale * ball_axis_integral(d, kappa, ratio)
        return scale * (_ball_closed if route == "closed" else _ball_covariogram)(d, ratio)

    return evaluate


def _ball_closed(dim: int, ratio: Fraction) -> Ball:
    """(b/3) 3F2(1/2 − d/2, 1/2 + d/2, 1/2; 2, 5/2; b²)."""
    b, half = exact_ball(ratio), flint.fmpq(1, 2)
    upper = [half - flint.fmpq(dim, 2), half + flint.fmpq(dim, 2), half]
    return b / 3 * flint.acb(b * b).hypgeom(upper, [2, flint.fmpq(5, 2)]).real


def _ball_covariogram(dim: int, ratio: Fraction) -> Ball:
    """∫_0^1 b(1−τ)² P_{(d−1)/2}(1 − 2b²τ²) dτ; P_ν(1 − 2u) = 2F1(−ν, ν + 1; 1; u)."""
    b = exact_ball(ratio)
    lower, upper = flint.fmpq(1 - dim, 2), flint.fmpq(1 + dim, 2)

    def density(tau: Ball, _: bool) -> Ball:
        return (1 - tau) ** 2 * ((b * tau) ** 2).hypgeom_2f1(lower, upper, 1)

    return b * integrated(density, 0, 1)


def _gaussian(
    gaussian: SpaceGaussian, strata: Fraction, region: int, route: str
) -> Callable[[], Ball]:
    y = 1 / (2 * gaussian.sigmas[0] * strata) ** 2

    def evaluate() -> Ball:
        turn = 2 * flint.arb.pi()
        scale = (turn * exact_ball(gaussian.sigmas[0])) ** -region
        for sigma in gaussian.sigmas:
            scale *= turn * exact_ball(sigma) ** 2
        half = exact_ball(Fraction(region, 2)).gamma() / 2
        return scale * half * gaussian_deficit(region, y, route)

    return evaluate


def gaussian_deficit(region: int, y: Fraction, route: str) -> Ball:
    """The mean of 1 − 1F1(s/2; 1/2; −yτ²) over τ, at the precision in force.

    Parameters
    ----------
    region : int
        s >= 1; for s = 1 it is the mean of 1 − e^(−yτ²).
    y : Fraction
        0 < y <= 10 000.
    route : {"closed", "covariogram", "quadrature"}
        ``quadrature`` integrates 2x^(s−1) e^(−x²) (1 − (sin(x√y)/(x√y))²)/Γ(s/2) over x > 0.
    """
    if y > _LARGEST_Y:
        raise InputError(f"a gaussian must satisfy 1/(2 sigma n)^2 <= {_LARGEST_Y}: got {y}")
    if route == "closed":
        return _gaussian_closed(region, y)
    if route == "covariogram":
        return _gaussian_covariogram(region, y)
    return _gaussian_quadrature(region, y) * 2 / exact_ball(Fraction(region, 2)).gamma()


def _gaussian_closed(region: int, y: Fraction) -> Ball:
    """The mean of 1 − 1F1(s/2; 1/2; −yτ²): (sy/6) 2F2(s/2 + 1, 1; 5/2, 3; −y)."""
    argument = flint.acb(-exact_ball(y))
    series = argument.hypgeom([flint.fmpq(region, 2) + 1, 1], [flint.fmpq(5, 2), 3]).real
    return exact_ball(y) * region / 6 * series


def _gaussian_covariogram(region: int, y: Fraction) -> Ball:
    """∫_0^1 2(1−τ)(1 − 1F1(s/2; 1/2; −yτ²)) dτ, by Kummer e^{−yτ²} 1F1((1 − s)/2; 1/2; yτ²)."""
    bits = flint.ctx.prec
    smallness = max(0, ceil(-log2(y)))
    try:
        flint.ctx.prec = bits + smallness  # 1 − 1F1 cancels
        height, order = exact_ball(y), flint.fmpq(1 - region, 2)

        def density(tau: Ball, _: bool) -> Ball:
            z = height * tau * tau
            return 2 * (1 - tau) * (1 - (-z).exp() * z.hypgeom_1f1(order, flint.fmpq(1, 2)))

        tolerance = flint.arb(2) ** (-bits - smallness)
        return integrated(density, 0, 1, rel_tol=0, abs_tol=tolerance)
    finally:
        flint.ctx.prec = bits


def _gaussian_quadrature(region: int, y: Fraction) -> Ball:
    """∫_0^∞ x^(s−1) e^{−x²} (1 − (sin(x√y)/(x√y))²) dx, cut where the rest is bounded."""
    bits = flint.ctx.prec
    smallness = max(0, ceil(-log2(y)))
    try:
        flint.ctx.prec = bits + smallness + 20  # 1 − sinc² cancels
        height, half = exact_ball(y), exact_ball(Fraction(region, 2))
        root = height.sqrt()

        def density(x: Ball, _: bool) -> Ball:
            return x ** (region - 1) * (-x * x).exp() * (1 - (root * x).sinc() ** 2)

        cut = flint.arb(ceil((0.7 * bits + region) ** 0.5) + 2)
        tolerance = flint.arb(2) ** (-bits - smallness)
        head = integrated(density, 0, cut, rel_tol=0, abs_tol=tolerance)
        # 1 − sinc²(z) <= z²/3, and ∫_X^∞ x^(s+1) e^{−x²} dx = Γ(s/2 + 1, X²)/2.
        rest = height / 6 * (cut * cut).gamma_upper(half + 1)
        return head + rest.union(flint.arb(0))
    finally:
        flint.ctx.prec = bits
