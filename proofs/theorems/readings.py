"""What a rate is when read as an order: refutations of orders of V that are too small or too large.

V is the variance of ``radial.py``. An order g of the paper is denied at numbers for the parameters:
as a bound where V/g → ∞, and as a rate (two-sided) where V/g → ∞ or V/g → 0.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim, Relation
from ..trusted.kernel import Step
from . import radial
from .radial import Case, N, alpha, b, c, c2, e, gamma, q, rho0, s

Values = tuple[tuple[Symbol, Expr], ...]
PLAIN: Mapping[Symbol, int] = dict.fromkeys((s, e, alpha, gamma, rho0, c, c2), 1)


def numbers(**degrees: int | Expr) -> Values:
    """b and q as given, all other parameters 1."""
    named = {x.name: x for x in (b, q)}
    chosen = {named[name]: value for name, value in degrees.items()}
    return among_plain(chosen)


def among_plain(chosen: Mapping[Symbol, Expr | int]) -> Values:
    """Parameters of V as chosen, all others 1."""
    return tuple((k, sympy.S(v)) for k, v in {**PLAIN, **chosen}.items())


def order_claim(case: Case, relation: Relation, power: Expr, log: int, *extra: Claim) -> Claim:
    """V = O or Theta of N^power (log N)^log under the hypotheses of the case and others."""
    given = (*radial.hypotheses(case), radial.EVENTUALLY[0], *extra)
    order = N**power * sympy.log(N) ** log
    return Claim(radial.pieces(case).total, relation, order, given, N)


@cache
def departure(case: Case, power: Expr, log: int, values: Values) -> Step:
    """V/(N^power (log N)^log) → 0 or ∞ at these values of its parameters."""
    _, lead_power, lead_log = radial.expansion(case)[0]
    there = dict(values)
    excess = sympy.expand((lead_power - power).xreplace(there)), lead_log - log
    limit = sympy.oo if excess > (0, 0) else sympy.S.Zero
    found = radial.closed_form(case)
    at = tuple((k, v) for k, v in values if k in found.claim.free)
    moved = Step(_evaluated(found.claim.at(*at)), by.Instance(at), (found,))
    terms = tuple(
        (k.xreplace(there), sympy.S.Zero, sympy.expand((p - power).xreplace(there)), j - log)
        for k, p, j in radial.expansion(case)
    )
    factor = (N**-power * sympy.log(N) ** -log).xreplace(there)
    given = moved.claim.given
    value = factor * moved.claim.right
    reached = Step(Claim(value, "->", limit, given, N), by.Limit(terms))
    scaled = radial.transferred(moved, reached, factor)
    grows = radial.grows()
    later = tuple((k, v) for k, v in values if k in grows.claim.free)
    gap = Step(_evaluated(grows.claim.at(*later)), by.Instance(later), (grows,))
    lasting = replace(scaled.claim, given=(radial.EVENTUALLY[0],))
    return Step(lasting, by.Eventually(), (scaled, gap))


@cache
def denial(claim: Claim, case: Case, power: Expr, log: int, values: Values) -> Step:
    """The order ``claim`` denied: V/order → 0 or ∞ at these values."""
    reached = departure(case, power, log, values)
    return Step(replace(claim, false=True), by.Counterexample(values), (reached,))


def _evaluated(claim: Claim) -> Claim:
    """Hypotheses that numbers satisfy left out, the others on N once."""
    kept = (h for h in claim.given if h.free)
    return replace(claim, given=tuple(dict.fromkeys(kept)))
