"""Trials of claims: a claim evaluated at random points by mpmath, without any of the kernel.

A trial that fails refutes the claim; one that passes proves nothing. Symbols and values of
undefined functions are drawn until the hypotheses hold. Limits are looked at on the way to
N = exp(400), where integrals of powers are taken over the logarithm of their variable.
"""

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from ..numerics.integrands.protocol import mp
from ..theory.symbolic import Expr, Symbol, sympy
from .claims import Claim

Number = Any
_FUNCTIONS = ("sin", "cos", "exp", "log", "gamma", "sinc")
_TOLERANCE = 1e-9


class Undefined(ArithmeticError):
    """The term has no value at the point."""


@dataclass
class Point:
    """Values of symbols, and of undefined functions as they are met."""

    values: dict[Symbol, Number]
    draw: Callable[[], Number]
    functions: dict[tuple[str, Number], Number] = field(
        default_factory=dict[tuple[str, Number], Number]
    )

    def within(self, x: Symbol, number: Number) -> "Point":
        """The point with one more symbol."""
        return Point({**self.values, x: number}, self.draw, self.functions)


def value(e: Expr, at: Point) -> Number:
    """The number that e is at a point.

    Raises
    ------
    Undefined
        If it is none.
    """
    if e.is_Rational:
        return mp.mpf(int(e.p)) / int(e.q)
    if e.is_Symbol:
        return at.values[e]
    if e in (sympy.pi, sympy.E):
        return +mp.pi if e == sympy.pi else mp.e
    if e in (sympy.oo, -sympy.oo):
        return mp.inf if e == sympy.oo else -mp.inf
    if isinstance(e, (sympy.Sum, sympy.Product, sympy.Integral)):
        return _bound_value(e, at)
    parts = [value(a, at) for a in e.args]
    if isinstance(e, sympy.core.function.AppliedUndef):
        key = (str(e.func), parts[0])
        return at.functions.setdefault(key, at.draw())
    return _applied(e, parts)


def _applied(e: Expr, parts: list[Number]) -> Number:
    if e.is_Add or e.is_Mul:
        return mp.fsum(parts) if e.is_Add else mp.fprod(parts)
    if e.is_Pow:
        if parts[0] == 0 and parts[1] < 0:
            raise Undefined("1/0")
        result = parts[0] ** parts[1]
    elif isinstance(e, (sympy.Min, sympy.Max)):
        return min(parts) if isinstance(e, sympy.Min) else max(parts)
    elif isinstance(e, sympy.Abs):
        return abs(parts[0])
    elif isinstance(e, sympy.besselj):
        return mp.besselj(*parts)
    else:
        if str(e.func) not in _FUNCTIONS or (isinstance(e, sympy.log) and parts[0] <= 0):
            raise Undefined(str(e.func))
        result = getattr(mp, str(e.func))(parts[0])
    if isinstance(result, mp.mpc):
        raise Undefined("not real")
    return result


def _bound_value(e: Expr, at: Point) -> Number:
    *inner, (x, a, b) = e.limits
    f = e.func(e.function, *inner) if inner else e.function
    low, high = value(a, at), value(b, at)
    if isinstance(e, sympy.Integral):
        return _integral(lambda t: value(f, at.within(x, t)), low, high)
    if high == mp.inf:

        def term(k: Number) -> Number:
            return value(f, at.within(x, mp.mpf(int(k))))

        return mp.nsum(term, [int(low), mp.inf])
    terms = [value(f, at.within(x, mp.mpf(k))) for k in range(int(low), int(high) + 1)]
    return mp.fsum(terms) if isinstance(e, sympy.Sum) else mp.fprod(terms)


def _integral(f: Callable[[Number], Number], low: Number, high: Number) -> Number:
    """Of a power in closed form; else by quadrature, of log x where the range is wide."""
    if low == high:
        return mp.mpf(0)
    top = high if high < mp.inf else 4 * max(low, 1)
    shares = (mp.mpf(2) / 11, mp.mpf(3) / 7, mp.mpf(9) / 13)  # no wave is steady at all three
    inside = [low + (top - low) * share for share in shares]
    values = [f(x) for x in inside]
    if all(v == 0 for v in values):
        return mp.mpf(0)
    if low >= 0 and min(abs(v) for v in values) > 0:
        slopes = [
            mp.log(abs(v / values[0])) / mp.log(x / inside[0])
            for x, v in zip(inside[1:], values[1:], strict=True)
        ]
        if abs(slopes[0] - slopes[1]) < 1e-15:
            return _power_integral(values[0] / inside[0] ** slopes[0], slopes[0], low, high)
    if high < mp.inf and (low <= 0 or high / low < 100):
        return mp.quad(f, [low, high], maxdegree=5)
    first, last = mp.log(low), mp.log(high) if high < mp.inf else mp.log(low) + 120
    ends = mp.linspace(first, last, max(8, int((last - first) / 6)) + 1)

    def in_logarithm(t: Number) -> Number:
        return f(mp.exp(t)) * mp.exp(t)

    return mp.quad(in_logarithm, ends, maxdegree=4)


def _power_integral(scale: Number, k: Number, low: Number, high: Number) -> Number:
    """∫ scale x^k from low to high."""
    if abs(k + 1) < 1e-15:
        if low == 0 or high == mp.inf:
            raise Undefined("diverges")
        return scale * mp.log(high / low)
    if (low == 0 and k < -1) or (high == mp.inf and k > -1):
        raise Undefined("diverges")
    ends = [0 if x in (0, mp.inf) else x ** (k + 1) for x in (high, low)]
    return scale * (ends[0] - ends[1]) / (k + 1)


def refuted(claim: Claim, seed: int = 0, trials: int = 12) -> bool:
    """Whether one of some trials fails; a denial, that it fails somewhere, no trial can refute."""
    if claim.false:
        return False
    with mp.workdps(30):
        return any(not _holds_at(claim, p) for p in _points(claim, random.Random(seed), trials))


def _points(claim: Claim, rng: random.Random, trials: int) -> Iterator[Point]:
    """Points at which the hypotheses hold."""
    symbols = sorted(claim.free - {claim.along}, key=str)
    whole = {h.left for h in claim.given if h.relation == "whole"}
    fixed = {h.left: h.right for h in claim.given if h.relation == "=" and h.left.is_Symbol}
    found = 0
    for _ in range(400 * trials):
        values = {s: _draw(rng, s in whole) for s in symbols}
        values |= {k: mp.mpf(v.p) / v.q for k, v in fixed.items() if v.is_Rational}
        point = Point(values, lambda: _draw(rng, rng.random() < 0.3))
        if claim.along is not None:
            point = point.within(claim.along, mp.exp(400))
        about_all = [h for h in claim.given if h.over]
        chosen = _chosen(about_all, point)
        if chosen and all(_pointwise(h, point) for h in claim.given if not h.over):
            yield point
            found += 1
            if found == trials:
                return


def _draw(rng: random.Random, whole: bool) -> Number:
    if whole:
        return mp.mpf(rng.randint(-2, 6))
    return mp.mpf(rng.choice((1, 1, 1, -1)) * round(2 ** rng.uniform(-3, 2.5), 2))


def _chosen(claims: list[Claim], at: Point) -> bool:
    """Undefined functions drawn so that hypotheses hold at few values of their own symbols."""
    for k in range(-1, 8):
        there = [(h, at.within(h.over[0], mp.mpf(k))) for h in claims]
        there = [(h, p) for h, p in there if all(_pointwise(g, p) for g in h.given)]
        for _ in range(300):
            if all(_pointwise(h, p) for h, p in there):
                break
            for h, p in there:
                for f in (h.left - h.right).atoms(sympy.core.function.AppliedUndef):
                    at.functions[(str(f.func), value(f.args[0], p))] = at.draw()
        else:
            return False
    return True


def _pointwise(c: Claim, at: Point) -> bool:
    try:
        left, right = value(c.left, at), value(c.right, at)
    except (ArithmeticError, ValueError):
        return False
    least = mp.mpf(10) ** (-12 if c.left.has(sympy.Integral) else -25)
    gap, slack = right - left, _TOLERANCE * min(1, abs(left) + abs(right)) + least
    match c.relation:
        case "whole":
            return abs(left - mp.nint(left)) <= _TOLERANCE
        case "=":
            return abs(gap) <= slack
        case "!=":
            return abs(gap) > slack
        case "<":
            return gap > 0
        case _:
            return gap >= -slack


def _holds_at(claim: Claim, at: Point) -> bool:
    if claim.relation not in ("->", "O", "Theta"):
        return _pointwise(claim, at)
    n = claim.along
    assert n is not None
    if any(len(b.limits) > 1 for b in claim.left.atoms(sympy.Integral)):
        return True  # no quadrature here sees both of two scales
    scale = claim.left if claim.relation == "->" else claim.left / claim.right
    waves = scale.has(sympy.sin, sympy.cos)  # 1 − sinc²(1/N) cancels: nearer, and more digits
    try:
        with mp.workdps(120 if waves else 30):
            exponents = (10, 20, 40) if waves else (100, 200, 400)
            there = [value(scale, at.within(n, mp.exp(k))) for k in exponents]
        if claim.relation == "->" and claim.right != sympy.oo:
            limit = value(claim.right, at)
            errors = [abs(v - limit) for v in there]
            return errors[2] <= max(0.75 * errors[1], 1e-6 * abs(limit), mp.mpf(10) ** -25)
    except (ArithmeticError, ValueError):
        return False
    growth = abs(there[2]) / max(abs(there[1]), mp.mpf(10) ** -300)
    if claim.relation == "->":
        return growth > 1.2 and there[2] > 0
    steady = growth < 1.4 and (claim.relation == "O" or growth > 0.7)
    return steady or _tends_to_positive(there)


def _tends_to_positive(there: list[Number]) -> bool:
    """Whether c + κ/log N, at N, N², N⁴, has c > 0: where the constant is slow to show."""
    steps = there[1] - there[0], there[2] - there[1]
    if abs(steps[1]) > 0.75 * abs(steps[0]) or steps[0] == steps[1]:
        return False
    limit = there[2] + steps[1] ** 2 / (steps[0] - steps[1])
    return limit > 1e-6 * abs(there[2])
