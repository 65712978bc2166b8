"""Facts: what is known of terms, and what is seen from it: signs, whole numbers, definedness."""

from dataclasses import dataclass, replace
from functools import lru_cache

from ...theory.symbolic import Expr, sympy
from .enclosures import ball
from .grammar import BINDERS, UNDEFINED_FUNCTION, known, opened, well_formed


@dataclass(frozen=True)
class Facts:
    """What is known: expressions > 0, >= 0, ≠ 0, whole, and improper sums that converge."""

    positive: frozenset[Expr] = frozenset()
    nonnegative: frozenset[Expr] = frozenset()
    nonzero: frozenset[Expr] = frozenset()
    whole: frozenset[Expr] = frozenset()
    convergent: frozenset[Expr] = frozenset()

    def inside(self, binder: Expr, closed: bool = True) -> "Facts":
        """With the bound symbol inside its range, at its ends too if closed."""
        _, x, a, b = opened(binder)
        gaps = frozenset(g for g in (x - a, b - x) if not g.has(sympy.oo))
        sets = (self.positive, self.nonnegative, self.nonzero, self.whole, self.convergent)
        free = Facts(*(frozenset(e for e in s if x not in e.free_symbols) for s in sets))
        if not isinstance(binder, sympy.Integral):
            whole = free.whole | {x} if whole_number(a, free) else free.whole
            return replace(free, nonnegative=free.nonnegative | gaps, whole=whole)
        if closed:
            return replace(free, nonnegative=free.nonnegative | gaps)
        return replace(free, positive=free.positive | gaps)


@lru_cache(maxsize=100_000)
def above(e: Expr, facts: Facts, strict: bool = False, depth: int = 2) -> bool:
    """Whether e >= 0, or e > 0 if strict, is seen from the facts."""
    if e == 0 or e in facts.positive or e in facts.nonnegative:
        return not strict or e in facts.positive
    if not e.free_symbols and not e.has(UNDEFINED_FUNCTION, *BINDERS):
        return bool(ball(e, {}) > 0)
    if e.is_Mul:
        negative = [f for f in e.args if _is_negative(f, facts, depth)]
        signs = (above(-f if f in negative else f, facts, strict, depth) for f in e.args)
        return len(negative) % 2 == 0 and all(signs)
    if e.is_Pow and above(e.base, facts, True, depth):
        return True
    if e.is_Pow and e.exp.is_Integer and (e.exp % 2 == 0 or above(e.base, facts, False, depth)):
        return not strict or different(e.base, facts, depth)
    if isinstance(e, sympy.Abs):
        return not strict or different(e.args[0], facts, depth)
    if isinstance(e, sympy.exp):
        return True
    if isinstance(e, sympy.log):
        return above(e.args[0] - 1, facts, strict, depth)
    if e.is_Add and all(above(a, facts, False, depth) for a in e.args):
        return not strict or any(above(a, facts, True, depth) for a in e.args)
    return (
        depth > 0
        and (e.is_Add or e.is_Symbol)
        and any(
            above(sympy.expand(e - h), facts, strict and h not in facts.positive, depth - 1)
            for h in facts.positive | facts.nonnegative
            if h.free_symbols & e.free_symbols
        )
    )


def _is_negative(f: Expr, facts: Facts, depth: int) -> bool:
    """Whether a factor is seen to be below or at 0, and not above it."""
    known = -f in facts.positive or -f in facts.nonnegative
    return known or (
        (f.is_number or f.is_Add)
        and not above(f, facts, False, depth)
        and above(-f, facts, False, depth)
    )


def different(e: Expr, facts: Facts, depth: int = 2) -> bool:
    """Whether e ≠ 0 is seen from the facts."""
    if e.is_Mul or e.is_Pow:
        return all(different(f, facts, depth) for f in (e.args if e.is_Mul else (e.base,)))
    seen = e in facts.nonzero or -e in facts.nonzero
    return seen or above(e, facts, True, depth) or above(-e, facts, True, depth)


def whole_number(e: Expr, facts: Facts) -> bool:
    """Whether e is a whole number."""
    if e.is_Add or e.is_Mul:
        return all(whole_number(a, facts) for a in e.args)
    if e.is_Pow:
        return all(whole_number(a, facts) for a in e.args) and above(e.exp, facts)
    return bool(e.is_Integer) or e in facts.whole


def defined(e: Expr, facts: Facts) -> bool:
    """Whether e has a value wherever the facts hold: no 1/0, no log 0, no divergent sum."""
    if e.is_Atom:
        return well_formed(e)
    if isinstance(e, BINDERS):
        return _binder_defined(e, facts)
    if not known(e) or not all(defined(a, facts) for a in e.args):
        return False
    if e.is_Pow:
        if whole_number(e.exp, facts):
            return above(e.exp, facts) or different(e.base, facts)
        return above(e.base, facts, True)
    if isinstance(e, sympy.besselj):
        return above(e.args[0], facts) and above(e.args[1], facts, True)
    return not isinstance(e, (sympy.log, sympy.gamma)) or above(e.args[0], facts, True)


def _binder_defined(e: Expr, facts: Facts) -> bool:
    f, _, a, b = opened(e)
    if e in facts.convergent:
        return True
    unknown = isinstance(e, sympy.Integral) and e.has(UNDEFINED_FUNCTION)
    proper = not (unknown or a.has(sympy.oo) or b.has(sympy.oo))
    return proper and range_defined(e, facts) and defined(f, facts.inside(e))


def range_defined(binder: Expr, facts: Facts) -> bool:
    """Whether the finite ends have values: whole ones of a sum, those of an integral in order."""
    _, _, *both = opened(binder)
    ends = [u for u in both if not u.has(sympy.oo)]
    if not all(defined(u, facts) for u in ends):
        return False
    if isinstance(binder, sympy.Integral):
        return len(ends) < 2 or above(ends[1] - ends[0], facts)
    return all(whole_number(u, facts) for u in ends)
