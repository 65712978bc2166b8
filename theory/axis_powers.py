r"""Power of named product integrands along their axes: mean, total, and what a sinc² takes away.

All that a variance needs of one factor f(x_i), at any N, are sums of F(m) = |f^(m)|² over m ≠ 0
against 1, sinc²(m/n) and combs [n | m]; as n → ∞

    Σ F(m) = t,     Σ F(m) (1 − sinc²(m/n)) ~ δ n^-κ (ln n)^λ,     Σ_{n | m} F(m) ~ t n^-p.

    F = c |m|^-p, q = p − 1 < 2     κ = q,  δ = c ∫ |x|^-p (1 − sinc² x) dx
                                              = 2c (2π)^q π / (Γ(q + 3) sin(πq/2));
    q = 2                           κ = 2,  λ = 1,  δ = (2π²/3) c;
    q > 2                           κ = 2,  δ = (π²/3) Σ m² F(m) = ‖f'‖²/12;
    interval of length a            κ = 1,  δ = 1/3: two jumps, each half of the mean distance of
                                    two points of a cell; on a comb it oscillates with n;
    Gaussian                        κ = 2,  δ as for q > 2; a comb meets no power of N at all.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from .decays import Decay
from .errors import InputError
from .expressions import parse_expression
from .symbolic import Expr, Integer, Rational, sympy

_COMMA = re.compile(r",(?![^()]*\))")  # commas outside parentheses


@dataclass(frozen=True)
class AxisPower:
    """One factor of a product integrand.

    Parameters
    ----------
    mean_square : sympy.Expr
        |f^(0)|².
    total : sympy.Expr
        t, the sum of |f^(m)|² over m ≠ 0; 0 for a coordinate that f ignores.
    deficit : sympy.Expr
        δ.
    """

    mean_square: Expr
    total: Expr
    deficit: Expr


@dataclass(frozen=True)
class ProductPower:
    """A product integrand, whose factors all fall alike.

    Parameters
    ----------
    axes : tuple of AxisPower
        One per coordinate.
    fall, log : sympy.Expr
        κ and λ.
    comb : sympy.Expr
        p; ``oo`` where combs meet no power at all.
    oscillates : bool
        Whether the sum over a comb is of order n^-p only, with a factor that has no limit.
    """

    axes: tuple[AxisPower, ...]
    fall: Expr
    log: Expr
    comb: Expr
    oscillates: bool = False


IGNORED = AxisPower(Integer(1), Integer(0), Integer(0))
"""A coordinate on which f does not depend."""


def power_law(p: Expr, c: Expr, mean_square: Expr) -> AxisPower:
    """The factor with |f^(m)|² = c |m|^-p, p > 1."""
    q = p - 1
    if q > 2:
        deficit = 2 * sympy.pi**2 / 3 * sympy.zeta(p - 2)
    elif q == 2:
        deficit = 2 * sympy.pi**2 / 3
    else:
        deficit = 2 * (2 * sympy.pi) ** q * sympy.pi / sympy.gamma(q + 3)
        deficit /= sympy.sin(sympy.pi * q / 2)
    return AxisPower(mean_square, 2 * c * sympy.zeta(p), c * deficit)


def power_laws(p: Expr, axes: tuple[AxisPower, ...]) -> ProductPower:
    """The product of factors with |f^(m)|² ∝ |m|^-p."""
    return ProductPower(axes, sympy.Min(p - 1, 2), Integer(int(p == 3)), p)


def interval(side: Expr) -> AxisPower:
    """The indicator of 0 <= x < a."""
    return IGNORED if side == 1 else AxisPower(side**2, side * (1 - side), Rational(1, 3))


def gaussian(sigma: Expr) -> AxisPower:
    """Periodised exp(−(x − 1/2)²/2σ²): |f^(m)|² = 2πσ² exp(−4π²σ²m²)."""
    height = 2 * sympy.pi * sigma**2
    m = sympy.Symbol("m", integer=True, positive=True)
    wave = sympy.exp(-((2 * sympy.pi * sigma * m) ** 2))
    total, second = (sympy.Sum(m**k * wave, (m, 1, sympy.oo)) for k in (0, 2))
    return AxisPower(height, 2 * height * total, 2 * sympy.pi**2 / 3 * height * second)


@lru_cache(maxsize=256)
def product_power(decay: Decay, dim: int) -> ProductPower | None:
    """The power of a named product integrand; None for a class or an integrand of another kind.

    A parameter that is not given stays a symbol: the side ``a``, the width ``sigma`` (of an
    anisotropic Gaussian ``sigma_1``, ``sigma_2``, ...).

    Raises
    ------
    InputError
        If a parameter is no exact number, or not one per coordinate.
    """
    given = parameters(decay.name)
    match decay.family:
        case "product" | "bernoulli" | "additive" if decay.number is not None:
            return _bernoulli(decay, decay.number, given, dim)
        case "polylog" if decay.number is not None:
            axes = (power_law(decay.number, Integer(1), Integer(0)), *(IGNORED,) * (dim - 1))
            return power_laws(decay.number, axes)
        case "box" | "half-space":
            sides = per_axis(given, "side", "a", 1 if decay.family == "half-space" else dim)
            axes = (*map(interval, sides), *(IGNORED,) * (dim - len(sides)))
            return ProductPower(axes, Integer(1), Integer(0), Integer(2), oscillates=True)
        case "gaussian":
            sigmas = per_axis(given, "sigma", "sigma", dim)
        case "anisotropic-gaussian":
            names = tuple(_positive(f"sigma_{i + 1}") for i in range(dim))
            sigmas = per_axis(given, "sigma", "sigma", dim) if "sigma" in given else names
        case _:
            return None
    return ProductPower(tuple(map(gaussian, sigmas)), Integer(2), Integer(0), sympy.oo)


def _bernoulli(
    decay: Decay, k: Expr, given: Mapping[str, tuple[Expr, ...]], dim: int
) -> ProductPower:
    """∏ (1 + c B_k(x_i)), ∏ B_k(x_i) over some axes, Σ B_k(x_i): |f^|² = (k!/(2πm)^k)² per axis.

    The sum has power on the axes alone, and there that of the product of 1 + B_k(x_i).
    """
    p, height = 2 * k, (sympy.factorial(k) / (2 * sympy.pi) ** k) ** 2
    if decay.family == "bernoulli":
        wave = power_law(p, height, Integer(0))
        return power_laws(p, tuple(wave if i + 1 in decay.axes else IGNORED for i in range(dim)))
    weight = given["c"][0] if "c" in given else Integer(1)
    return power_laws(p, (power_law(p, weight**2 * height, Integer(1)),) * dim)


def parameters(name: str) -> dict[str, tuple[Expr, ...]]:
    """The exact numbers in ``NAME:key=value,key=(value,value)``, by key.

    Raises
    ------
    InputError
        If a value is no exact number.
    """
    found: dict[str, tuple[Expr, ...]] = {}
    for part in _COMMA.split(name.partition(":")[2]):
        key, equals, value = part.partition("=")
        if equals:
            inner = value.strip().removeprefix("(").removesuffix(")")
            found[key.strip()] = tuple(parse_expression(v) for v in inner.split(",") if v.strip())
    return found


def per_axis(
    given: Mapping[str, tuple[Expr, ...]], key: str, symbol: str, dim: int
) -> tuple[Expr, ...]:
    """A parameter for each coordinate: as given, one for all, or the symbol for all."""
    values = given.get(key, (_positive(symbol),))
    if len(values) not in (1, dim):
        raise InputError(f"{key} must have one value per coordinate ({dim}): got {len(values)}")
    return values * dim if len(values) == 1 else values


def _positive(name: str) -> Expr:
    return sympy.Symbol(name, positive=True)
