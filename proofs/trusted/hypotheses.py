"""Hypotheses: what they say, when they hold, and when one claim says what another says."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ...theory.symbolic import Expr, sympy
from .claims import ASYMPTOTIC, Claim
from .facts import Facts, above, defined, different, whole_number
from .grammar import BINDERS, bound, opened, require, substituted
from .normal_forms import zero


def said(claims: Sequence[Claim]) -> Facts:
    """Facts in claims of one point; those under hypotheses of their own say nothing yet."""
    plain = [c for c in claims if not (c.over or c.given or c.false or c.relation in ASYMPTOTIC)]
    gaps = {r: {c.gap for c in plain if c.relation == r} for r in ("<", "<=", "=", "!=")}
    equal = gaps["="] | {-g for g in gaps["="]}
    whole = frozenset(c.left for c in plain if c.relation == "whole")
    sides = [s for c in plain for s in (c.left, c.right)]
    sums = {b for s in sides for b in s.atoms(*BINDERS) if not b.free_symbols & bound(s)}
    return Facts(
        frozenset(gaps["<"]), frozenset(gaps["<="] | equal), frozenset(gaps["!="]), whole,
        frozenset(sums),
    )  # fmt: skip


def facts_under(given: tuple[Claim, ...], used: Sequence[Claim] = ()) -> Facts:
    """Facts under hypotheses, with those of used theorems, whose own hypotheses must hold."""
    done: list[Claim] = []
    for c in used:
        for h in c.given:
            require(holds(h, given, done), "not given", h)
        done.append(replace(c, given=()))
    return said((*given, *done))


def applicable(given: tuple[Claim, ...], used: Sequence[Claim]) -> list[Claim]:
    """The used theorems whose hypotheses hold, without them."""
    kept = (u for u in used if all(holds(h, given, ()) for h in u.given))
    return [replace(u, given=()) for u in kept]


def holds(h: Claim, given: tuple[Claim, ...], used: Sequence[Claim]) -> bool:
    """Whether a hypothesis is given, stated by a used theorem, or seen from the facts."""
    if h in given:
        return True
    if h.over or h.relation in ASYMPTOTIC:
        fresh = not {s for g in given for s in g.free} & {*h.over, h.along}
        inside = (*given, *h.given)
        stated = (c for c in used if states(c, h, said(inside)))
        return fresh and any(all(holds(g, inside, ()) for g in c.given) for c in stated)
    facts = said((*given, *used))
    if not (defined(h.left, facts) and defined(h.right, facts)):
        return False
    match h.relation:
        case "=":
            return zero(h.gap, facts)
        case "!=":
            return different(h.gap, facts)
        case "whole":
            return whole_number(h.left, facts)
        case _:
            return above(h.gap, facts, h.relation == "<")


def applies(
    values: tuple[tuple[Any, Expr], ...], claim: Claim, given: tuple[Claim, ...],
    used: Sequence[Claim] = (),
) -> bool:  # fmt: skip
    """Whether values of symbols are defined, and of functions wherever the claim applies them."""
    name = "value"
    while name in f"{claim}{given}{values}":
        name += "'"
    mark = sympy.Function(name)
    symbols = [v for k, v in values if getattr(k, "is_Symbol", False)]
    marked = tuple((k, v if v in symbols else sympy.Lambda(v.signature, mark(v.expr)))
                   for k, v in values)  # fmt: skip
    here = said((*given, *applicable(given, used)))
    stated = (*(replace(h, over=()) for h in given if h.over), *used)
    kept = all(_has_value(h, values, given, stated) for h in claim.given)
    known = kept and all(defined(v, here) for v in symbols)
    return known and _applied(claim.at(*marked), mark, given, stated)


def _has_value(h: Claim, values: Any, given: tuple[Claim, ...], used: Sequence[Claim]) -> bool:
    """Whether a hypothesis at other values is all there, or all that SymPy dropped is defined."""
    pairs = tuple((k, v) for k, v in values if k not in h.over)
    outside = tuple(g for g in given if not g.free & set(h.over))
    inside = (*outside, *h.at(*pairs).given)
    facts = said((*inside, *applicable(inside, used)))
    sides = (_is_kept(e, pairs) or defined_at(e, pairs, facts) for e in (h.left, h.right))
    return all(sides) and all(_has_value(g, pairs, outside, used) for g in h.given)


def _is_kept(e: Expr, values: Any) -> bool:
    """Whether SymPy changes nothing of the term's form at the values."""
    there = substituted(e, values)
    alike = there.func is e.func and len(there.args) == len(e.args)
    return e.is_Atom or (alike and all(_is_kept(a, values) for a in e.args))


def defined_at(e: Expr, values: Any, facts: Facts) -> bool:
    """Whether e has a value at the values, with all that SymPy may drop from it, as 0 times it."""
    if e in (sympy.oo, -sympy.oo):
        return True
    there = substituted(e, values)
    if not defined(there, facts):
        return False
    if not isinstance(e, BINDERS):
        return all(defined_at(u, values, facts) for u in e.args)
    f, *ends = opened(e)
    within = facts.inside(there, closed=False) if there.func is e.func else facts
    return all(defined_at(u, values, facts) for u in ends[1:]) and defined_at(f, values, within)


def _applied(c: Claim, mark: Any, given: tuple[Claim, ...], used: Sequence[Claim]) -> bool:
    """Whether all marked terms in a claim are defined, in its hypotheses too."""
    outside = tuple(g for g in given if not g.free & set(c.over))
    inside = (*outside, *c.given) if c.over else outside
    sides = all(_marked_defined(e, mark, inside, used) for e in (c.left, c.right))
    return sides and all(_applied(h, mark, outside, used) for h in c.given)


def _marked_defined(e: Expr, mark: Any, given: tuple[Claim, ...], used: Sequence[Claim]) -> bool:
    if not e.has(mark):
        return True
    facts = said((*given, *applicable(given, used)))
    if e.func == mark:
        return defined(e.args[0], facts)
    if not isinstance(e, BINDERS):
        return all(_marked_defined(a, mark, given, used) for a in e.args)
    f, x, a, b = opened(e)
    ends = [h for h in (Claim(a, "<=", x), Claim(x, "<=", b)) if not h.gap.has(sympy.oo)]
    whole = [Claim(x, "whole")] * (not isinstance(e, sympy.Integral) and whole_number(a, facts))
    inside = (*(g for g in given if x not in g.free), *ends, *whole)
    outer = all(_marked_defined(u, mark, given, used) for u in (a, b))
    return outer and _marked_defined(f, mark, inside, used)


def same(a: Expr, b: Expr, facts: Facts) -> bool:
    """Whether two terms, or limits, are seen to be equal."""
    return a == b or (sympy.oo not in (a, b) and zero(a - b, facts))


def states(used: Claim, claim: Claim, facts: Facts) -> bool:
    """Whether a used claim says what the claim says, whatever is given."""
    weaker = claim.relation == "<=" and used.relation in ("<", "=")
    related = weaker or used.relation == claim.relation
    alike = related and (used.along, used.false) == (claim.along, claim.false)
    sides = ((used.left, claim.left), (used.right, claim.right))
    return alike and all(a == b or (same(a, b, facts) and defined(b, facts)) for a, b in sides)
