"""Which region decides: the least e_k min(b_k, q), and not the least b_k.

Two regions of degrees b₁, b₂ and effective counts N^e₁, N^e₂, e₁b₁ < e₂b₂, have together

    worst case, q = 1, 0 < b_k < 1:   V = Θ(N^−(1 + e₁b₁)),
    best case, b_k > 0:               V = Θ(N^−(1 + e₁b₁)),

so that the smaller b_k does not decide: e = 1, b = 1/2 gives N^−3/2, and e = 1/2, b = 3/4 beside
it N^−11/8. With a region of constant profile γ/N the whole is of order 1/N. (The paper, Appendix B,
Eqs. 43-54.)
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import radial, regional_sums
from .radial import N, rho
from .regional_sums import LARGE, Region, flat, parameters
from .tactics import (
    ONE,
    ZERO,
    combine,
    limit_of_powers,
    positive,
    power_integral,
    real,
    transferred,
)

b1, b2, e1, e2 = real("b_1 b_2 e_1 e_2")
Values = tuple[tuple[Symbol, Expr], ...]


@cache
def worst(place: int, degree: Expr, e: Expr) -> Region:
    """A jump, q = 1, sampled with degree 0 < b < 1 and N_k = N^e."""
    p, found = parameters(place), radial.closed_form("b<q")
    values = (
        (radial.b, degree), (radial.q, ONE), (radial.e, e), (radial.gamma, p.gamma),
        (radial.alpha, p.alpha), (radial.s, p.s), (radial.rho0, p.rho0), (radial.c, p.c),
        (radial.c2, p.c2),
    )  # fmt: skip
    signs = (
        *positive(p.gamma, p.alpha, p.s, p.rho0, p.c, p.c2, degree, e),
        Claim(degree, "<", ONE),
    )
    given = (*signs, *LARGE, Claim(p.rho0, "<=", p.alpha * N**e))
    closed = Step(replace(found.claim.at(*values), given=given), by.Instance(values), (found,))
    there = dict(values)
    terms = tuple(
        (u.xreplace(there), sympy.expand(v.xreplace(there))) for u, v, _ in radial.expansion("b<q")
    )
    gap = p.alpha * N**e - p.rho0
    grows = limit_of_powers(
        gap, [(p.alpha, e), (-p.rho0, ZERO)], N, (*positive(p.alpha, p.rho0, e), *LARGE), sympy.oo
    )
    return Region(closed, terms, grows)


@cache
def best(place: int, degree: Expr, e: Expr) -> Region:
    """No power beyond ρ0, sampled with degree b > 0 and N_k = N^e."""
    p = parameters(place)
    given = (*positive(p.gamma, p.alpha, p.s, p.rho0, p.c, degree, e), *LARGE)
    start = p.alpha * N**e
    profile = rho ** (p.s - 1) * p.gamma / N * (rho / start) ** degree * p.c
    integral = sympy.Integral(profile, (rho, 0, p.rho0))
    closed = power_integral(
        integral, [(p.c * p.gamma / N * start**-degree, p.s - 1 + degree)], given
    )
    constant = p.gamma * p.c * p.rho0 ** (p.s + degree) / ((p.s + degree) * p.alpha**degree)
    return Region(closed, ((constant, sympy.expand(-1 - e * degree)),))


PAIRS = {
    "worst": (worst(1, b1, e1), worst(2, b2, e2)),
    "best": (best(1, b1, e1), best(2, b2, e2)),
}
_FIRST = Claim(e1 * b1, "<", e2 * b2)


def _signs() -> tuple[Step, ...]:
    """e₁b₁ < e₁ and e₁b₁ < e₂, where b₁, b₂ < 1."""
    given = (*positive(e1, e2), Claim(b1, "<", ONE), Claim(b2, "<", ONE), _FIRST)
    less = [Step(Claim(h.left, "<", h.right, given), by.Given()) for h in given[2:]]
    return (
        combine(Claim(e1 * b1, "<", e1, given), (e1, less[0])),
        combine(Claim(e1 * b1, "<", e2, given), (1, less[2]), (e2, less[1])),
    )


@cache
def order_of_two(case: str) -> Step:
    """Two regions with e₁b₁ < e₂b₂: the first decides."""
    regions, power = PAIRS[case], 1 + e1 * b1
    pair = regional_sums.closed_sum(regions)
    given = (*pair.claim.given, _FIRST)
    factor = N**power
    terms = tuple((u, ZERO, sympy.expand(power + v), 0) for x in regions for u, v in x.terms)
    right = regions[0].terms[0][0]
    signs = _signs() if case == "worst" else ()
    limit = Step(Claim(factor * pair.claim.right, "->", right, given, N), by.Limit(terms), signs)
    reached = transferred(pair, limit, factor)
    for region in regions:
        reached = _without_start(reached, region)
    claim = Claim(pair.claim.left, "Theta", N**-power, reached.claim.given, N)
    return Step(claim, by.Order(), (reached,))


def _without_start(step: Step, region: Region) -> Step:
    if region.grows is None:
        return step
    gap = region.grows.claim.left
    given = tuple(h for h in step.claim.given if h.gap != gap or h.relation == "<")
    return Step(replace(step.claim, given=given), by.Eventually(), (step, region.grows))


def least_degree(case: str) -> Claim:
    """Eqs. 50 and 54 as printed: the region of the smaller b_k, which is b₁, gives the order."""
    regions = PAIRS[case]
    given = dict.fromkeys(h for x in regions for h in x.closed.claim.given)
    kept = tuple(h for h in given if not (h.relation == "<=" and N in h.free))
    claim = Claim(regional_sums.variance(regions), "O", N ** (-1 - e1 * b1))
    return replace(claim, given=(*kept, Claim(b1, "<=", b2)), along=N)


def _at(region: Region, values: Values) -> Region:
    """A region with numbers for its parameters."""

    def moved(step: Step) -> Step:
        own = tuple((s, v) for s, v in values if s in step.claim.free)
        there = step.claim.at(*own)
        kept = tuple(dict.fromkeys(h for h in there.given if h.free))
        return Step(replace(there, given=kept), by.Instance(own), (step,))

    there = dict(values)
    terms = tuple((u.xreplace(there), v.xreplace(there)) for u, v in region.terms)
    return Region(moved(region.closed), terms, moved(region.grows) if region.grows else None)


@cache
def least_degree_denied(case: str, degrees: tuple[Expr, Expr], counts: tuple[Expr, Expr]) -> Step:
    """With b₁ < b₂ and e₂b₂ < e₁b₁ the second region decides."""
    claim = least_degree(case)
    named = dict(zip((b1, b2, e1, e2), (*degrees, *counts), strict=True))
    symbols = sorted(claim.free - {N}, key=str)
    values = tuple((x, sympy.S(named.get(x, 1))) for x in symbols)
    regions = tuple(_at(x, values) for x in PAIRS[case])
    pair, power = regional_sums.closed_sum(regions), 1 + counts[0] * degrees[0]
    given, factor = pair.claim.given, N**power
    terms = [(u, ZERO, power + v, 0) for x in regions for u, v in x.terms]
    terms.sort(key=lambda t: t[2], reverse=True)
    limit = Step(Claim(factor * pair.claim.right, "->", sympy.oo, given, N), by.Limit(tuple(terms)))
    reached = transferred(pair, limit, factor)
    for region in regions:
        reached = _without_start(reached, region)
    return Step(replace(claim, false=True), by.Counterexample(values), (reached,))


@cache
def with_constant_profile(case: str) -> Step:
    """A region and one of constant profile: Θ(1/N)."""
    has_tail = case == "worst"
    region = PAIRS[case][0]
    return regional_sums.order((flat(2, has_tail), region), ONE)
