"""Hypotheses: what they say, when they hold, and when one claim says what another says."""

from collections.abc import Sequence
from dataclasses import replace

from ..theory.symbolic import Expr, sympy
from .claims import ASYMPTOTIC, Claim
from .facts import Facts, above, defined, different, whole_number
from .grammar import BINDERS, bound, require
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
        fresh = not {s for g in given for s in g.free} & set(h.over)
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


def same(a: Expr, b: Expr, facts: Facts) -> bool:
    """Whether two terms, or limits, are seen to be equal."""
    return a == b or (sympy.oo not in (a, b) and zero(a - b, facts))


def states(used: Claim, claim: Claim, facts: Facts) -> bool:
    """Whether a used claim says what the claim says, whatever is given."""
    weaker = claim.relation == "<=" and used.relation in ("<", "=")
    related = weaker or used.relation == claim.relation
    alike = related and (used.along, used.false) == (claim.along, claim.false)
    sides = ((used.left, claim.left), (used.right, claim.right))
    return alike and all(same(a, b, facts) for a, b in sides)
