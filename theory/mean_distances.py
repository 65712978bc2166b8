r"""Mean distance E|Δ| of two uniform points of a box: closed forms, and an integral above 3D.

Jitter misses an indicator by the points whose cell the boundary crosses, and what it misses is
half of ∫ E|n·Δ| dS over the boundary, Δ the difference of two uniform points of a cell. With the
density 2(a_i − x_i)/a_i² of |Δ_i| on a box of sides a_i,

    E|Δ| = ∏ (2/a_i²) ∫ ∏ (a_i − x_i) |x| dx,       0 < x_i < a_i.

Multiplied out, an axis with the weight −x_i is integrated at sight, x r^p = ∂(r^(p+2)/(p+2)), and
what is left are integrals of (A + |y|²)^(p/2), p odd, over boxes of one to three dimensions:

    3D, A = 0   Euler's theorem: 1/(p + 3) of the sum over faces of distance times integral;
    2D          div(y G) = (A + |y|²)^(p/2), G = ((A + |y|²)^(p/2+1) − A^(p/2+1))/((p + 2)|y|²),
                leaves the sides that do not meet the origin;
    1D          by parts, down to asinh and arctan.

Above three dimensions E|Δ| = (1/√π) ∫_0^∞ (1 − ∏ g(a_i u)) du/u², where g(u) = E exp(−u²δ²) and
δ is the difference of two uniform points of the unit interval.
"""

from functools import lru_cache
from itertools import combinations

from .symbolic import Expr, Integer, sympy

_CLOSED = 3  # dimensions


@lru_cache(maxsize=256)
def mean_distance(sides: tuple[Expr, ...]) -> Expr:
    """E|Δ| for two independent uniform points of a box.

    Parameters
    ----------
    sides : tuple of sympy.Expr
        Positive; no sides at all make a point, whose mean distance is 0.
    """
    if not sides:
        return Integer(0)
    if len(sides) > _CLOSED:
        return _as_integral(sides)
    total = Integer(0)
    for size in range(len(sides) + 1):
        for weighted in combinations(range(len(sides)), size):
            total += (-1) ** size * _weighted(sides, weighted)
    return sympy.expand(total * sympy.prod([2 / a**2 for a in sides]))


def _weighted(sides: tuple[Expr, ...], weighted: tuple[int, ...]) -> Expr:
    """∫ ∏_{i not weighted} a_i ∏_{i weighted} x_i |x| dx over the box."""
    rest = tuple(a for i, a in enumerate(sides) if i not in weighted)
    power = 2 * len(weighted) + 1
    total = Integer(0)
    for size in range(len(weighted) + 1):
        for ends in combinations(weighted, size):
            offset = sum((sides[i] ** 2 for i in ends), Integer(0))
            total += (-1) ** (len(weighted) - size) * _plain(offset, power, rest)
    return sympy.prod(rest) * total / sympy.factorial2(power)


def _plain(offset: Expr, power: int, sides: tuple[Expr, ...]) -> Expr:
    """∫ (A + |y|²)^(p/2) dy over a box of at most three dimensions; A = 0 in three."""
    match sides:
        case ():
            return offset ** (Integer(power) / 2)
        case (c,):
            return _line(offset, power, c)
        case (b, c):
            return _side(offset, power, b, c) + _side(offset, power, c, b)
        case (a, b, c):
            faces = ((a, b, c), (b, c, a), (c, a, b))
            return sum(
                (x * _plain(x**2, power, (y, z)) for x, y, z in faces), Integer(0)
            ) / Integer(power + 3)
        case _:
            raise ValueError(f"a box has at most three sides here: got {len(sides)}")


def _line(offset: Expr, power: int, c: Expr) -> Expr:
    """∫_0^c (A + z²)^(p/2) dz."""
    if offset == 0:
        return c ** (power + 1) / (power + 1)
    if power == -1:
        return sympy.asinh(c / sympy.sqrt(offset))
    end = c * (offset + c**2) ** (Integer(power) / 2)
    return (end + power * offset * _line(offset, power - 2, c)) / (power + 1)


def _side(offset: Expr, power: int, b: Expr, c: Expr) -> Expr:
    """b ∫_0^c G dz along the side at distance b from the origin."""
    flux = b * _quotient(offset, power + 2, b, c)
    if offset != 0:
        flux -= offset ** (Integer(power) / 2 + 1) * sympy.atan(c / b)
    return flux / (power + 2)


def _quotient(offset: Expr, power: int, b: Expr, c: Expr) -> Expr:
    """∫_0^c (A + b² + z²)^(p/2)/(b² + z²) dz."""
    if power == -1:
        root = sympy.sqrt(offset)
        return sympy.atan(c * root / (b * sympy.sqrt(offset + b**2 + c**2))) / (b * root)
    first = _line(offset + b**2, power - 2, c)
    return first if offset == 0 else first + offset * _quotient(offset, power - 2, b, c)


def _as_integral(sides: tuple[Expr, ...]) -> Expr:
    u = sympy.Symbol("u", positive=True)
    inside = 1 - sympy.prod([_characteristic(a * u) for a in sides])
    return sympy.Integral(inside / u**2, (u, 0, sympy.oo)) / sympy.sqrt(sympy.pi)


def sides_of(integral: Expr) -> tuple[Expr, ...]:
    """The sides of the box whose mean distance an integral of ``mean_distance`` stands for."""
    u = integral.limits[0][0]
    found: list[Expr] = []
    for factor in sympy.Mul.make_args(1 - integral.function * u**2):
        base, power = factor.as_base_exp()
        (wave,) = base.atoms(sympy.erf)
        found += [wave.args[0] / u] * int(power)
    return tuple(found)


def _characteristic(x: Expr) -> Expr:
    """g(x) = E exp(−x²δ²) = 2∫_0^1 (1 − t) exp(−x²t²) dt."""
    return sympy.sqrt(sympy.pi) * sympy.erf(x) / x - (1 - sympy.exp(-(x**2))) / x**2
