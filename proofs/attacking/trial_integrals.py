"""Integrals and sums to infinity as numbers: powers in closed form, panels, polylogarithms.

    ∫ x^k = (b^(k+1) − a^(k+1))/(k+1),        Σ_(m>=1) m^-p cos(θ m) = Re Li_p(exp(iθ)),

and any other integral between numbers by Gauss-Legendre panels, halved until two rounds agree to
10^-20 of the integral of the size: an estimate of what is left, no bound.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from mpmath.calculus import quadrature as _quadrature

from ...numerics.integrands.protocol import Mpf, mp
from ...theory.symbolic import Expr, Symbol, sympy
from .trial_numbers import Kind, Number
from .undecided import Undecided, Undefined

SETTLED = mp.mpf("1e-20")
_MOST_PANELS = 64
_RULE: Any = _quadrature.GaussLegendre(mp)


def powers(f: Expr, x: Symbol) -> tuple[tuple[Expr, Expr], ...] | None:
    """Pairs c, k of a sum of c x^k; None if f is none."""
    if x not in f.free_symbols:
        return ((f, sympy.S.Zero),)
    if f == x:
        return ((sympy.S.One, sympy.S.One),)
    if f.is_Add:
        parts = [powers(a, x) for a in f.args]
        return None if None in parts else tuple(pair for p in parts for pair in p or ())
    if f.is_Mul:
        product: tuple[tuple[Expr, Expr], ...] = ((sympy.S.One, sympy.S.Zero),)
        for a in f.args:
            found = powers(a, x)
            if found is None:
                return None
            product = tuple((c * d, j + k) for c, j in product for d, k in found)
        return product
    if f.is_Pow and x not in f.exp.free_symbols:
        found = powers(f.base, x)
        if found is not None and len(found) > 1 and f.exp.is_Integer and 0 < f.exp <= 4:
            return powers(sympy.Mul(*[f.base] * int(f.exp), evaluate=False), x)
        if found is not None and len(found) == 1:
            ((c, k),) = found
            return ((c**f.exp, k * f.exp),)
    return None


def power_integral(k: Mpf, low: Number, high: Number | None, kind: Kind) -> Number:
    """∫ x^k from low to high, to infinity if that is None."""
    start, is_log = kind.sign(low), abs(k + 1) < SETTLED
    end = 1 if high is None else kind.sign(high)
    if start == 0 == end:
        return kind.make(mp.mpf(0))
    is_whole = abs(k - mp.nint(k)) < SETTLED
    if min(start, end) < 0 and (not is_whole or high is None):
        raise Undefined("a power of a negative number, or an integral that diverges")
    if start * end < 0 and k < 0:
        raise Undefined("an integral that diverges at 0")
    if (0 in (start, end) and (is_log or k < -1)) or (high is None and (is_log or k > -1)):
        raise Undefined("an integral that diverges")
    minus, raised = kind.make(mp.mpf(-1)), kind.make(k + 1)
    if is_log:
        ends = [kind.functions["log"](u if start > 0 else minus * u) for u in (high, low)]
        return ends[0] + minus * ends[1]
    sides = [
        kind.make(mp.mpf(0)) if u is None or not s else kind.power(u, raised)
        for u, s in ((high, end), (low, start))
    ]
    return (sides[0] + minus * sides[1]) * kind.make(1 / (k + 1))


def quadrature(f: Callable[[Number], Number], a: Mpf, b: Mpf, kind: Kind) -> Number:
    """∫ f from a to b, by panels that are halved until they agree.

    Raises
    ------
    Undecided
        If they do not.
    """
    if a == b:
        return kind.make(mp.mpf(0))
    panels = 1
    found, size = _panels(f, a, b, panels, kind)
    while panels < _MOST_PANELS:
        panels *= 2
        finer, size = _panels(f, a, b, panels, kind)
        if kind.agree(found, finer, SETTLED * size):
            return finer
        if not kind.is_plain:  # a series that does not hold uniformly: no panels will do
            break
        found = finer
    raise Undecided("an integral that does not settle")


def _panels(
    f: Callable[[Number], Number], a: Mpf, b: Mpf, panels: int, kind: Kind
) -> tuple[Number, Mpf]:
    """The integral and, of mpf, the integral of the size, by panels of 24 nodes."""
    total, size, half = kind.make(mp.mpf(0)), mp.mpf(0), (b - a) / (2 * panels)
    for panel in range(panels):
        middle = a + half * (2 * panel + 1)
        for node, weight in _nodes(mp.prec):
            there = f(kind.make(middle + half * node)) * kind.make(half * weight)
            total = total + there
            size += abs(there) if kind.is_plain else 0
    return total, size


@lru_cache(maxsize=8)
def _nodes(precision: int) -> list[tuple[Mpf, Mpf]]:
    return _RULE.calc_nodes(4, precision)


def power_and_wave(e: Expr, m: Symbol) -> tuple[Expr, Expr]:
    """k and θ of m^k cos(θ m)."""
    power, theta = sympy.S.Zero, sympy.S.Zero
    for factor in sympy.Mul.make_args(e):
        base, exponent = factor.as_base_exp()
        slope = sympy.expand(factor.args[0] / m) if isinstance(factor, sympy.cos) else None
        if base == m and m not in exponent.free_symbols:
            power += exponent
        elif slope is not None and m not in slope.free_symbols and theta == 0:
            theta = slope
        elif factor != 1:
            raise Undecided("no closed form of a sum to infinity")
    return power, theta


def polylogarithm(p: Mpf, theta: Mpf, first: int) -> Mpf:
    """Σ over m >= first of m^-p cos(θ m)."""
    turns = theta / (2 * mp.pi)
    is_steady = abs(turns - mp.nint(turns)) < SETTLED
    if p <= 1:
        raise Undefined("a sum that diverges") if is_steady else Undecided("a slow sum")
    if first < 1:
        raise Undefined("a sum that begins at 0 or before")
    whole = mp.zeta(p) if is_steady else mp.re(mp.polylog(p, mp.expj(theta)))
    return whole - mp.fsum(mp.cos(theta * m) / mp.mpf(m) ** p for m in range(1, first))
