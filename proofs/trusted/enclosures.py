"""Enclosures: terms in ball arithmetic, and inequalities over whole boxes of their symbols."""

from functools import reduce

from ...numerics.balls import Ball, flint
from ...theory.symbolic import Expr, Symbol, sympy
from .grammar import BINDERS, ENTIRE, opened, require

Box = dict[Symbol, tuple[Expr, Expr]]
"""Rational ends for each symbol."""


def ball(e: Expr, values: dict[Symbol, Ball]) -> Ball:
    """An enclosure of e, its symbols replaced by balls; not finite where e may be undefined."""
    if e.is_Rational:
        return flint.arb(flint.fmpq(int(e.p), int(e.q)))
    if e.is_Symbol or e in (sympy.pi, sympy.E):
        return values[e] if e.is_Symbol else flint.arb(1).exp() if e == sympy.E else flint.arb.pi()
    if isinstance(e, sympy.Sum):
        f, k, a, b = opened(e)
        require(bool(a.is_Integer and b.is_Integer), "ends must be numbers", e)
        terms = (ball(f, {**values, k: flint.arb(j)}) for j in range(int(a), int(b) + 1))
        return sum(terms, flint.arb(0))
    require(not isinstance(e, BINDERS), "no enclosure", e)
    parts = [ball(a, values) for a in e.args]
    if e.is_Add or e.is_Mul:
        return reduce(lambda u, v: u + v if e.is_Add else u * v, parts)
    if e.is_Pow and e.exp.is_Integer and e.exp >= 0:
        base = abs(parts[0]) if e.exp % 2 == 0 else parts[0]
        return reduce(lambda u, v: u * v, [base] * int(e.exp))
    if e.is_Pow:
        return parts[0] ** (int(e.exp) if e.exp.is_Integer else parts[1])
    if isinstance(e, (sympy.Min, sympy.Max)):
        return reduce(lambda u, v: u.min(v) if isinstance(e, sympy.Min) else u.max(v), parts)
    if isinstance(e, sympy.besselj):
        return parts[1].bessel_j(parts[0])
    names = {sympy.Abs: "__abs__", **{f: f.__name__ for f in (*ENTIRE, sympy.log, sympy.gamma)}}
    require(e.func in names, "no enclosure", e)
    return getattr(parts[0], names[e.func])()


def above_on_box(e: Expr, box: Box, relation: str, depth: int) -> None:
    """Require e > 0 on a box, e >= 0 for "<=", e ≠ 0 for "!=", halving it up to ``depth`` times."""
    cells = [(box, depth)]
    while cells:
        cell, left = cells.pop()
        value = ball(e, {s: ball(a, {}).union(ball(b, {})) for s, (a, b) in cell.items()})
        if value > 0 or (relation == "<=" and value >= 0) or (relation == "!=" and value < 0):
            continue
        require(left > 0 and bool(cell), "not decided on", cell)
        s = max(cell, key=lambda s: (cell[s][1] - cell[s][0]) / (box[s][1] - box[s][0]))
        a, b = cell[s]
        cells += [({**cell, s: half}, left - 1) for half in ((a, (a + b) / 2), ((a + b) / 2, b))]
