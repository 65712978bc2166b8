"""Uniform laws and delta functions: what Eqs. 1, 2, 10 and 12 of the paper take for granted.

A law that is uniform has a density of integral 1: no constant has it over all of R, the constant 1
has it over the unit cube. A delta is a limit of densities on balls of radius 1/h, and polar
coordinates bring the area σ of the unit sphere and ρ^(s−1) in s dimensions:

    σ ∫_0^(1/h) ρ^(s−1) h dρ = (σ/s) h^(1−s) → 0  for s > 1,
    σ ∫_0^(1/h) ρ^(s−1) (s h^s/σ) dρ = 1.

So δ(‖x‖) is no delta in the plane, and the delta of a distance to a line needs s = d − 1. The
square of a delta has no integral: h² over a width 1/h has h.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .strata import sizes
from .stratified_spectra import along_axes, d, product, product_of_ones
from .tactics import (
    ONE,
    ZERO,
    chain,
    combine,
    limit_of_powers,
    positive,
    power_integral,
    real,
    transferred,
)

L, x, c, n, rho, s, sigma, nu = real("L x c h rho s sigma nu")
TWO = sympy.Integer(2)

UNIFORM_ON_THE_LINE = Claim(
    sympy.Integral(c, (x, -L, L)), "->", ONE, (*positive(c), *positive(L)), L
)
"""A constant density on R."""


@cache
def no_uniform_law() -> Step:
    """∫_{−L}^{L} c dx does not tend to 1 for c = 1: it is 2L."""
    integral, given = sympy.Integral(ONE, (x, -L, L)), positive(L)
    size = Step(Claim(integral, "=", 2 * L, given), by.Antiderivative(x))
    grows = limit_of_powers(2 * L, [(TWO, ONE)], L, given, sympy.oo)
    limit = transferred(size, grows)
    denial = replace(UNIFORM_ON_THE_LINE, false=True)
    return Step(denial, by.Counterexample(((c, ONE),)), (limit,))


@cache
def unit_cube() -> Step:
    """∏ ∫_0^1 dx = 1 over the d axes."""
    given = sizes(d)
    one = Step(Claim(sympy.Integral(ONE, (x, 0, 1)), "=", ONE), by.Antiderivative(x))
    axes = along_axes(one, given)
    return chain(Claim(product(one.claim.left), "=", ONE, given), axes, product_of_ones())


def mass(height: Expr, dimension: Expr) -> Expr:
    """σ ∫_0^(1/h) ρ^(dimension−1) height dρ."""
    return sigma * sympy.Integral(rho ** (dimension - 1) * height, (rho, 0, 1 / n))


def of_a_norm(dimension: Expr) -> Claim:
    """The delta of a distance in so many dimensions, as if it were one-dimensional."""
    given = (*positive(sigma, n), Claim(TWO, "<=", dimension))
    return Claim(mass(n, dimension), "->", ONE, given, n)


@cache
def norm_is_lost(printed: Claim, values: tuple[tuple[Expr, Expr], ...]) -> Step:
    """The mass of h on a disc of radius 1/h is π/h."""
    there = replace(printed, right=ZERO).at(*values)
    given = positive(n)
    integral = sympy.Integral(rho * n, (rho, 0, 1 / n))
    value = Step(Claim(integral, "=", 1 / (2 * n), given), by.Antiderivative(n * rho**2 / 2))
    scale = there.left / integral
    fall = limit_of_powers(scale / (2 * n), [(scale / 2, -ONE)], n, given, ZERO)
    limit = transferred(value, fall, scale)
    return Step(replace(printed, false=True), by.Counterexample(values), (limit,))


@cache
def of_a_point() -> Step:
    """σ ∫_0^(1/h) ρ^(s−1) (s h^s/σ) dρ = 1."""
    given = positive(s, sigma, n)
    height = s * n**s / sigma
    integral = sympy.Integral(rho ** (s - 1) * height, (rho, 0, 1 / n))
    known = power_integral(integral, [(height, s - 1)], given)
    return combine(Claim(sigma * integral, "=", ONE, given), (sigma, known))


@cache
def of_a_line() -> Step:
    """The same with s = d − 1, the perpendicular component of x − l in d dimensions."""
    given = (*positive(sigma, n), Claim(ONE, "<", d))
    moved = of_a_point().claim.at((s, d - 1))
    claim = Claim(moved.left, "=", ONE, given)
    return Step(claim, by.Instance(((s, d - 1),)), (of_a_point(),))


SQUARED = Claim(sympy.Integral(n**2, (nu, -1 / (2 * n), 1 / (2 * n))), "O", ONE, positive(n), n)
"""The square of a delta has an integral."""


@cache
def square_has_no_integral() -> Step:
    """∫ h² over |ν| < 1/(2h) is h."""
    given = SQUARED.given
    value = Step(Claim(SQUARED.left, "=", n, given), by.Antiderivative(n**2 * nu))
    limit = transferred(value, limit_of_powers(n, [(ONE, ONE)], n, given, sympy.oo))
    return Step(replace(SQUARED, false=True), by.Counterexample(()), (limit,))
