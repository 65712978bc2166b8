"""Latin hypercubes along an axis, Eqs. 19-23: jitter with N_k = N, and what the paper leaves out.

With b = 2, N_k = N and q = 1 (the paper's Jacobian ρ^(s−1) against ρ^(−s−1)),

    V = γ/(α² N³) [c ρ0^(s+2)/(s + 2) + c₂ (αN − ρ0)] + γ c₂/(α N²),      ρ0 <= αN.

Eq. 19 lets the second integral begin at 0, where it diverges; Eq. 20 leaves out what lies below ρ0,
and with c₂ = c its right side, 2γc/(αN²), is then no bound; where the rows of Eq. 16 meet,
c₂ = c ρ0^(s+1), it is one. On a true axis there is no Jacobian, s = 1, and a ball, whose power
falls as ρ^(−d−1), has q = d: there the order is N^−3 log N for a disk, and N^−3 for d >= 3.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import radial, readings
from .radial import N, b, c, c2, e, rho, rho0, s
from .regional_sums import TWO, Region, best, worst
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

alpha, gamma = radial.alpha, radial.gamma
t, d = real("t d")
POINT: readings.Values = tuple(
    (k, sympy.Integer(v)) for k, v in ((N, 4), (s, 1), (alpha, 1), (gamma, 1), (rho0, 3), (c, 1))
)
"""Where Eq. 20 fails."""


def axis_worst() -> Region:
    """Eq. 19."""
    return worst(0, ONE)


def axis_best() -> Region:
    """Eq. 22."""
    return best(0, ONE)


FROM_0 = Claim(
    sympy.Integral(gamma * c / N * rho**-2, (rho, 1 / t, sympy.oo)),
    "O", ONE, (*positive(gamma, c, N), Claim(ONE, "<", t)), t,
)  # fmt: skip
"""The second integral of Eq. 19, from 0, is finite."""


@cache
def diverges_from_0() -> Step:
    """∫_{1/t}^∞ (γc/N) ρ^−2 dρ = γct/N → ∞."""
    given = FROM_0.given
    found = power_integral(FROM_0.left, [(gamma * c / N, -TWO)], given)
    numbers = tuple((x, ONE) for x in (gamma, c, N))
    at = replace(found.claim.at(*numbers), given=given[-1:])
    moved = Step(at, by.Instance(numbers), (found,))
    limit = limit_of_powers(at.right, [(ONE, ONE)], t, at.given, sympy.oo)
    return Step(
        replace(FROM_0, false=True), by.Counterexample(numbers), (transferred(moved, limit),)
    )


def _right_20() -> tuple[Expr, Expr]:
    """The integrals of Eq. 20, with c₂ for c_f."""
    low = sympy.Integral(c2 * gamma / (alpha**2 * N**3), (rho, 0, alpha * N))
    return low, sympy.Integral(c2 * gamma / N * rho**-2, (rho, alpha * N, sympy.oo))


def _value_20() -> tuple[Step, Step]:
    given = positive(gamma, alpha, c2, N)
    low, high = _right_20()
    first = Step(
        Claim(low, "=", c2 * gamma / (alpha * N**2), given),
        by.Antiderivative(c2 * gamma / (alpha**2 * N**3) * rho),
    )
    return first, power_integral(high, [(c2 * gamma / N, -TWO)], given)


_MEETING = ((c2, c * rho0 ** (s + 1)),)


@cache
def bound_where_rows_meet() -> Step:
    """Eq. 20 with c₂ = c ρ0^(s+1)."""
    closed = axis_worst().closed
    given = tuple(h for h in closed.claim.given if h != Claim(ZERO, "<", c2))
    moved = Step(replace(closed.claim.at(*_MEETING), given=given), by.Instance(_MEETING), (closed,))
    right = sympy.Add(*_right_20()).xreplace(dict(_MEETING))
    values = [
        Step(replace(v.claim.at(*_MEETING), given=given), by.Instance(_MEETING), (v,))
        for v in _value_20()
    ]
    spare = gamma / (alpha**2 * N**3) * c * rho0 ** (s + 2) * (s + 1) / (s + 2)
    claim = Claim(moved.claim.left, "<=", right, given)
    return combine(claim, (1, moved), *((-1, v) for v in values), remainder=spare)


def _printed_20() -> Claim:
    closed = axis_worst().closed.claim
    there = ((c2, c),)
    given = tuple(h for h in closed.given if h != Claim(ZERO, "<", c2))
    right = sympy.Add(*_right_20()).xreplace(dict(there))
    return Claim(closed.left.xreplace(dict(there)), "<=", right, given)


EQ_20 = _printed_20()


@cache
def exceeds_20() -> Step:
    """At ρ0 = 3, N = 4 and ones, V = 14/64 and the right side of Eq. 20 is 8/64."""
    values = (*POINT, (c2, ONE))
    closed = axis_worst().closed
    parts = [closed, *_value_20()]
    at = [
        (replace(p.claim.at(*used), given=()), by.Instance(used), (p,))
        for p in parts
        for used in (tuple((k, v) for k, v in values if k in p.claim.free),)
    ]
    left, low, high = (Step(*a) for a in at)
    there = EQ_20.at(*POINT)
    more = combine(
        Claim(there.right, "<", there.left), (-1, left), (1, low), (1, high),
        remainder=sympy.Rational(6, 64),
    )  # fmt: skip
    return Step(replace(EQ_20, false=True), by.Counterexample(POINT), (more,))


EQ_21_DISK = readings.order_claim(
    "b=q", "Theta", -TWO, 0,
    Claim(s, "=", ONE), Claim(b, "=", TWO), Claim(e, "=", ONE),
)  # fmt: skip
"""Eq. 21 as a rate on a true axis, s = 1, for a disk, q = 2."""


@cache
def disk_on_an_axis() -> Step:
    """V = Θ(N^−3 log N) at b = q = 2, e = 1, s = 1."""
    values = ((b, TWO), (e, ONE), (s, ONE))
    found = radial.order("b=q")
    moved = found.claim.at(*values)
    given = tuple(h for h in moved.given if h.free)
    return Step(replace(moved, given=given), by.Instance(values), (found,))


@cache
def not_the_rate_of_a_disk() -> Step:
    """N² V → 0 there."""
    return readings.denial(EQ_21_DISK, "b=q", -TWO, 0, readings.numbers(b=2))


@cache
def ball_on_an_axis() -> Step:
    """V = Θ(N^−3) at b = 2 < q = d, e = 1, s = 1: a ball in d >= 3 dimensions."""
    values = ((b, TWO), (radial.q, d), (e, ONE), (s, ONE))
    found = radial.order("b<q")
    moved = found.claim.at(*values)
    signs = (*positive(alpha, gamma, rho0, c, c2), radial.EVENTUALLY[0])
    given = (*signs, Claim(sympy.Integer(3), "<=", d))
    return Step(replace(moved, given=given), by.Instance(values), (found,))


EQ_21_BALL = readings.order_claim(
    "b<q", "Theta", -TWO, 0,
    Claim(s, "=", ONE), Claim(b, "=", TWO), Claim(e, "=", ONE),
)  # fmt: skip
"""Eq. 21 as a rate on a true axis, s = 1, for a ball, q = d > 2."""


@cache
def not_the_rate_of_a_ball() -> Step:
    """N² V → 0 there, at d = 3."""
    return readings.denial(EQ_21_BALL, "b<q", -TWO, 0, readings.numbers(b=2, q=3))


@cache
def before_rho0() -> Step:
    """Where ν <= ρ0: V = (γ/N) {c [ρ0^s/s − b ν^s/(s(s + b))] + c₂ ρ0^−q/q}."""
    nu, q = sympy.Symbol("nu", real=True), radial.q
    given = (*positive(b, q, s, gamma, rho0, c, c2, N, nu), Claim(nu, "<=", rho0))
    shell, level = rho ** (s - 1), gamma / N
    low = sympy.Integral(shell * level * (rho / nu) ** b * c, (rho, 0, nu))
    middle = sympy.Integral(shell * level * c, (rho, nu, rho0))
    high = sympy.Integral(shell * level * c2 * rho ** (-s - q), (rho, rho0, sympy.oo))
    parts = (
        power_integral(low, [(c * level * nu**-b, s - 1 + b)], given),
        power_integral(middle, [(c * level, s - 1)], given),
        power_integral(high, [(c2 * level, -q - 1)], given),
    )
    inside = c * (rho0**s / s - b * nu**s / (s * (s + b))) + c2 * rho0**-q / q
    claim = Claim(low + middle + high, "=", level * inside, given)
    return combine(claim, *((1, p) for p in parts))
