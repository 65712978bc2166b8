r"""Leading constants as certified numbers: exact expressions walked in ball arithmetic.

What is not elementary in them is a Gaussian's power along an axis and the mean distance in a box
of more than three dimensions:

    Σ_{m≥1} exp(−a m²) = (θ_3(0|ia/π) − 1)/2,     Σ_{m≥1} m² exp(−a m²) = −θ_3''(0|ia/π)/8π²,
    √π E|Δ| = ∫_0^∞ (1 − ∏ g(a_i u)) du/u²,       g(x) = √π erf(x)/x − (1 − exp(−x²))/x².

The integrand has a removable singularity at 0. Up to a point, 1 − ∏ g is therefore written as
Σ_i (1 − g_i) ∏_{j<i} g_j with the entire functions g(x) = ₂F₂(1/2, 1; 3/2, 2; −x²) and
(1 − g(x))/x² = ₂F₂(3/2, 1; 5/2, 3; −x²)/6. From X on g is replaced by √π/x − 1/x², which leaves
powers of u. It is smaller than g by exp(−x²)/x² − √π erfc(x)/x, between 0 and exp(−x²)/x², and
both are in [0, 1] for x ≥ 1, so that the products differ by at most Σ_i exp(−x_i²)/x_i².
"""

from collections.abc import Sequence
from functools import partial, reduce
from math import ceil, log, sqrt
from operator import add, mul
from typing import Any

from ...theory.errors import InputError
from ...theory.mean_distances import sides_of
from ...theory.symbolic import Expr, sympy
from ..balls import Ball, exact_ball, flint, integrated

_FUNCTIONS: dict[Any, str] = {
    sympy.log: "log",
    sympy.asinh: "asinh",
    sympy.atan: "atan",
    sympy.exp: "exp",
    sympy.sin: "sin",
    sympy.gamma: "gamma",
    sympy.zeta: "zeta",
}
"""The methods of balls for functions of one variable."""


def constant_ball(constant: Expr) -> Ball:
    """The ball of a leading constant at the precision in force.

    Parameters
    ----------
    constant : sympy.Expr
        Without free symbols, built of rationals, π, + × ^, log, asinh, atan, exp, sin, gamma, zeta,
        the sums of ``theory.axis_powers.gaussian`` and the integrals of
        ``theory.mean_distances.mean_distance``.

    Raises
    ------
    InputError
        If anything else is in it.
    """
    if constant.is_Rational:
        return flint.arb(flint.fmpq(int(constant.p), int(constant.q)))
    if constant is sympy.pi:
        return flint.arb.pi()
    if constant is sympy.E:
        return flint.arb(1).exp()
    if isinstance(constant, sympy.Sum):
        return _gaussian_sum(constant)
    if isinstance(constant, sympy.Integral):
        sides = [constant_ball(a) for a in sides_of(constant)]
        return mean_distance_ball(sides) * flint.arb.pi().sqrt()
    if constant.is_Pow:
        return _power(constant_ball(constant.base), constant.exp)
    parts = [constant_ball(a) for a in constant.args]
    if constant.is_Add or constant.is_Mul:
        return reduce(add if constant.is_Add else mul, parts)
    if constant.func not in _FUNCTIONS:
        raise InputError(f"a constant must have no symbol and known functions: got {constant}")
    return getattr(parts[0], _FUNCTIONS[constant.func])()


def _power(base: Ball, exponent: Expr) -> Ball:
    if exponent.is_Integer:
        return base ** int(exponent)
    if exponent.is_Rational and exponent.q == 2:
        return base.sqrt() ** int(exponent.p)
    return base ** constant_ball(exponent)


def _gaussian_sum(found: Expr) -> Ball:
    """Σ_{m≥1} m^k exp(−a m²) for k = 0 and 2."""
    ((m, *_),) = found.limits
    power, wave = found.function.as_independent(sympy.exp, as_Add=False)
    a = -wave.args[0] / m**2
    if power not in (1, m**2) or a.free_symbols:
        raise InputError(f"a sum must be of exp(-a m^2) or m^2 exp(-a m^2): got {found}")
    nome = flint.acb(0, constant_ball(a) / flint.arb.pi())
    if power == 1:
        return (flint.acb(0).modular_theta(nome)[2].real - 1) / 2
    return -flint.acb(0).modular_theta(nome, 2)[2].real / (8 * flint.arb.pi() ** 2)


def mean_distance_ball(sides: Sequence[Ball]) -> Ball:
    """E|Δ| for two independent uniform points of a box, in any dimension.

    Parameters
    ----------
    sides : sequence of balls
        Positive, at least one.
    """
    waves = [flint.acb(a) for a in sides]
    near = 1 / flint.arb(max(float(a) for a in sides))
    digits = flint.ctx.prec * log(2)
    far = flint.arb(ceil(sqrt(digits) / min(float(a) for a in sides)) + 1)
    total = integrated(partial(_near, waves), 0, near)
    total += integrated(partial(_middle, waves), near, far)
    total += 1 / far - _tail(sides, far)
    error = sum((_missing(a * far) for a in sides), flint.arb(0)) / far
    return (total + flint.arb(0, error.upper())) / flint.arb.pi().sqrt()


def _near(sides: Sequence[Any], u: Any, _: bool) -> Any:
    """(1 − ∏ g)/u² around u = 0, where it is analytic."""
    half, three, five = (exact_ball(k) / 2 for k in (1, 3, 5))
    total, product = flint.acb(0), flint.acb(1)
    for a in sides:
        square = -((a * u) ** 2)
        total += a**2 * square.hypgeom([three, 1], [five, 3]) / 6 * product
        product *= square.hypgeom([half, 1], [three, 2])
    return total


def _middle(sides: Sequence[Any], u: Any, _: bool) -> Any:
    """(1 − ∏ g)/u² away from u = 0; around it the ball is infinite."""
    root, product = flint.arb.pi().sqrt(), flint.acb(1)
    for a in sides:
        x = a * u
        product *= root * x.erf() / x - (1 - (-(x**2)).exp()) / x**2
    return (1 - product) / u**2


def _tail(sides: Sequence[Ball], far: Ball) -> Ball:
    """∫_X^∞ ∏ (√π/(a_i u) − 1/(a_i u)²) du/u²."""
    root, powers = flint.arb.pi().sqrt(), [flint.arb(1)]  # coefficients of 1, 1/u, 1/u², ...
    for a in sides:
        shifted = [flint.arb(0), *powers, flint.arb(0)], [flint.arb(0), flint.arb(0), *powers]
        powers = [x * root / a - y / a**2 for x, y in zip(*shifted, strict=True)]
    return sum(
        (c / ((k + 1) * far ** (k + 1)) for k, c in enumerate(powers)),
        flint.arb(0),
    )


def _missing(x: Ball) -> Ball:
    """What g may exceed √π/x − 1/x² by, x at least 1."""
    return (-(x**2)).exp() / x**2
