"""Sums over directions: the one direction that is set apart, and what it may contribute.

    Σ_k I_k Δn_k = Σ_{k≠r} I_k Δn_k + I_r Δn_r,      I_k = ∫ ρ^(d−1) P_S |f^|² dρ along n_k;

without its Δn_r the right side is no bound: two cones of the plane have Δn = π. A factor γ_k cannot
be taken out of the sum. And I_r is finite only if ∫ ρ^(d−1) |f^|² dρ is: for the unit cube along an
axis, in three dimensions, |f^|² = sinc² ρ and

    ∫_1^R ρ² sinc²(ρ) dρ = [R/2 − sin(2πR)/(4π) − 1/2]/π²,

which grows with R. (The paper, Appendix B, Eqs. 37-47, 51.)
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim, Relation
from ..trusted.kernel import Step
from .radial import rho
from .tactics import ONE, ZERO, combine, limit_of_powers, real, whole

k, m, r, upper = real("k m r R")
pi, sin = sympy.pi, sympy.sin
radial_term, weight = sympy.Function("I"), sympy.Function("D")


def cones(term: Expr, first: Expr, last: Expr) -> Expr:
    """A sum over directions."""
    return sympy.Sum(term, (k, first, last))


_SHARE = radial_term(k) * weight(k)
_PLACES = (*whole(m, r), Claim(ONE, "<=", r), Claim(r, "<=", m))


@cache
def one_direction_apart() -> Step:
    """Eqs. 37 and 38: Σ I_k Δn_k = Σ_{k≠r} I_k Δn_k + I_r Δn_r."""
    after = cones(_SHARE, r, m)
    cuts = (
        Step(Claim(cones(_SHARE, ONE, m), "=", cones(_SHARE, ONE, r - 1) + after, _PLACES),
             by.Range(r - 1)),
        Step(Claim(after, "=", cones(_SHARE, r, r) + cones(_SHARE, r + 1, m), _PLACES),
             by.Range(r)),
        Step(Claim(cones(_SHARE, r, r), "=", radial_term(r) * weight(r), _PLACES), by.Range()),
    )  # fmt: skip
    rest = cones(_SHARE, ONE, r - 1) + cones(_SHARE, r + 1, m)
    claim = Claim(cones(_SHARE, ONE, m), "=", rest + radial_term(r) * weight(r), _PLACES)
    return combine(claim, *((1, cut) for cut in cuts))


def _without_angle(relation: Relation) -> Claim:
    found = one_direction_apart().claim
    right = found.right - radial_term(r) * weight(r) + radial_term(r)
    sign = tuple(
        Claim(ZERO, "<=", f(k), (*whole(k), Claim(ONE, "<=", k)), over=(k,))
        for f in (radial_term, weight)
    )
    return Claim(found.left, relation, right, (*found.given, *sign))


WITHOUT_ANGLE = _without_angle("<=")
"""Eqs. 37 and 38 as printed: the r-th direction without its Δn_r."""


@cache
def without_angle_denied() -> Step:
    """Two cones of the plane, Δn = π, I = 1: the left side is 2π, the right π + 1."""
    two = sympy.Integer(2)
    values = (
        (radial_term, sympy.Lambda(k, ONE)),
        (weight, sympy.Lambda(k, pi)),
        (m, two),
        (r, two),
    )
    there = WITHOUT_ANGLE.at(*values)
    both, none = cones(pi, ONE, two), cones(pi, two + 1, two)
    first, last = (cones(pi, j, j) for j in (ONE, two))
    steps = (
        Step(Claim(both, "=", first + last), by.Range(ONE)),
        *(Step(Claim(s, "=", v), by.Range()) for s, v in ((last, pi), (none, ZERO))),
    )
    size = combine(Claim(ONE, "<", pi), remainder=pi - 1)
    less = combine(
        Claim(there.right, "<", there.left),
        (-1, steps[0]),
        (-1, steps[1]),
        (1, steps[2]),
        (1, size),
    )
    signs = tuple(
        combine(replace(h, given=(), over=()), remainder=h.right)
        for h in there.given if h.over
    )  # fmt: skip
    return Step(replace(WITHOUT_ANGLE, false=True), by.Counterexample(values), (less, *signs))


_FACTOR = sympy.Function("g")
FACTOR_OUTSIDE = Claim(
    cones(_FACTOR(k) * radial_term(k), ONE, m), "<=", _FACTOR(r) * cones(radial_term(k), ONE, m),
    (*_PLACES, *(Claim(ZERO, "<", f(k), (*whole(k), Claim(ONE, "<=", k)), over=(k,))
                 for f in (_FACTOR, radial_term))),
)  # fmt: skip
"""Eqs. 46 and 51 as printed: γ_k before the sum over k."""


@cache
def factor_outside_denied() -> Step:
    """γ_k = 1 + k², I = 1 and two directions: the left side is 7, the right with γ_1 is 4."""
    two = sympy.Integer(2)
    values = (
        (_FACTOR, sympy.Lambda(k, 1 + k**2)),
        (radial_term, sympy.Lambda(k, ONE)),
        (m, two),
        (r, ONE),
    )
    there = FACTOR_OUTSIDE.at(*values)
    parts: list[tuple[int, Step]] = []
    for f, sign in ((1 + k**2, -1), (ONE, 2)):
        heads = [cones(f, j, j) for j in (ONE, two)]
        cut = Claim(cones(f, ONE, two), "=", heads[0] + heads[1])
        parts.append((sign, Step(cut, by.Range(ONE))))
        parts += [
            (sign, Step(Claim(h, "=", f.xreplace({k: j})), by.Range()))
            for h, j in zip(heads, (ONE, two), strict=True)
        ]
    less = combine(Claim(there.right, "<", there.left), *parts, remainder=3)
    signs = (
        combine(Claim(ZERO, "<", 1 + k**2), remainder=1 + k**2),
        combine(Claim(ZERO, "<", ONE), remainder=1),
    )
    return Step(replace(FACTOR_OUTSIDE, false=True), by.Counterexample(values), (less, *signs))


ALONG_AXIS = sympy.Integral(rho**2 * (sin(pi * rho) / (pi * rho)) ** 2, (rho, 1, upper))
"""∫_1^R ρ^(d−1) |f^|² dρ of the unit cube, d = 3, along an axis."""
BOUNDED = Claim(ALONG_AXIS, "O", ONE, (Claim(ONE, "<", upper),), upper)
"""After Eq. 42: the integral over a direction is finite, irrespective of what f is."""


@cache
def along_axis() -> Step:
    """The integral in closed form."""
    big = (rho / 2 - sin(2 * pi * rho) / (4 * pi)) / pi**2
    right = (upper / 2 - sin(2 * pi * upper) / (4 * pi) - ONE / 2) / pi**2
    given = (Claim(ONE, "<", upper),)
    return Step(Claim(ALONG_AXIS, "=", right, given), by.Antiderivative(big))


@cache
def bounded_denied() -> Step:
    """It grows as R/(2π²)."""
    found, given = along_axis(), (Claim(ONE, "<", upper),)
    wave = 2 * pi * upper
    rest = (1 - sin(wave)) ** 2 / 2 + sympy.cos(wave) ** 2 / 2
    high = combine(Claim(sin(wave), "<=", ONE), remainder=rest)
    terms = [(1 / (2 * pi**2), ONE), (-(1 / (4 * pi) + ONE / 2) / pi**2, ZERO)]
    least = sympy.Add(*(u * upper**v for u, v in terms))
    under = combine(Claim(least, "<=", ALONG_AXIS, given), (-1, found), (1 / (4 * pi**3), high))
    grows = limit_of_powers(least, terms, upper, given, sympy.oo)
    limit = Step(Claim(ALONG_AXIS, "->", sympy.oo, given, upper), by.Squeeze(), (under, grows))
    return Step(replace(BOUNDED, false=True), by.Counterexample(()), (limit,))
