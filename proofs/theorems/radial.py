"""The rate of Eq. 17 on one region, proved: saturating monomial against a power law.

    V = ∫_0^ρ0 ρ^(s−1) P_S c dρ + ∫_ρ0^ν ρ^(s−1) P_S c₂ ρ^(−s−q) dρ
        + ∫_ν^∞ ρ^(s−1) (γ/N) c₂ ρ^(−s−q) dρ,
    P_S = (γ/N) (ρ/ν)^b,   ν = α N^e >= ρ0,        b, q, s, e, α, γ, ρ0, c, c₂ > 0:

    b > q:   N^(1+eq) V       →  γ α^−q c₂ b/(q (b − q))
    b = q:   N^(1+eb) V/log N →  γ α^−b c₂ e
    b < q:   N^(1+eb) V       →  γ α^−b [c ρ0^(s+b)/(s+b) + c₂ ρ0^(b−q)/(q − b)]

The integrals are powers, and at b = q one is a logarithm. (The paper, Eqs. 16-18, 25, 27, 45-50,
with s for d and a Jacobian ρ^(s−1).)
"""

from dataclasses import dataclass, replace
from functools import cache
from typing import Literal

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .tactics import ONE, ZERO, chain, limit_of_powers, positive, power_integral, real, transferred

b, q, s, e, alpha, gamma = real("b q s e alpha gamma")
rho, rho0, c, c2, N = real("rho rho_0 c c_2 N")
nu = alpha * N**e
Case = Literal["b>q", "b=q", "b<q"]
PARAMETERS = positive(b, s, e, alpha, gamma, rho0, c, c2)
EVENTUALLY = (Claim(ONE, "<", N), Claim(rho0, "<=", nu))


def decay(case: Case) -> Expr:
    """q, or b where they are equal."""
    return b if case == "b=q" else q


def hypotheses(case: Case) -> tuple[Claim, ...]:
    """Signs of the parameters, and how b and q lie."""
    between = {"b>q": (Claim(q, "<", b),), "b<q": (Claim(b, "<", q),), "b=q": ()}[case]
    return (*PARAMETERS, *(() if case == "b=q" else positive(q)), *between)


@dataclass(frozen=True)
class Pieces:
    """The three integrals of V, in the order of ρ."""

    low: Expr
    middle: Expr
    high: Expr

    @property
    def total(self) -> Expr:
        """V."""
        return self.low + self.middle + self.high


def pieces(case: Case) -> Pieces:
    """The integrals between 0, ρ0, ν and ∞."""
    shell, rise = rho ** (s - 1), gamma / N * (rho / nu) ** b
    fall = c2 * rho ** (-s - decay(case))
    return Pieces(
        sympy.Integral(shell * rise * c, (rho, 0, rho0)),
        sympy.Integral(shell * rise * fall, (rho, rho0, nu)),
        sympy.Integral(shell * gamma / N * fall, (rho, nu, sympy.oo)),
    )


@cache
def closed_form(case: Case) -> Step:
    """V without integrals."""
    given = (*hypotheses(case), *EVENTUALLY)
    parts, scale, k = pieces(case), gamma / N * nu**-b, decay(case)
    low = power_integral(parts.low, [(c * scale, s - 1 + b)], given)
    if case == "b=q":
        ends = c2 * scale * (sympy.log(nu) - sympy.log(rho0))
        reason = by.Antiderivative(c2 * scale * sympy.log(rho))
        middle = Step(Claim(parts.middle, "=", ends, given), reason)
    else:
        middle = power_integral(parts.middle, [(c2 * scale, b - k - 1)], given)
    high = power_integral(parts.high, [(c2 * gamma / N, -k - 1)], given)
    right = low.claim.right + middle.claim.right + high.claim.right
    return chain(Claim(parts.total, "=", right, given), low, middle, high)


def expansion(case: Case) -> tuple[tuple[Expr, Expr, int], ...]:
    """V as Σ coefficient N^power (log N)^j, the leading term first."""
    low, scale = c * rho0 ** (s + b) / (s + b), gamma * alpha**-b
    if case == "b=q":
        rest = low + c2 * (sympy.log(alpha) - sympy.log(rho0)) + c2 / b
        return (scale * c2 * e, -1 - e * b, 1), (scale * rest, -1 - e * b, 0)
    slow = (gamma * alpha**-q * c2 * b / (q * (b - q)), -1 - e * q, 0)
    fast = (scale * (low + c2 * rho0 ** (b - q) / (q - b)), -1 - e * b, 0)
    return (slow, fast) if case == "b>q" else (fast, slow)


@cache
def grows() -> Step:
    """α N^e − ρ0 → ∞."""
    given = (*positive(alpha, e, rho0), Claim(ONE, "<", N))
    return limit_of_powers(nu - rho0, [(alpha, e), (-rho0, ZERO)], N, given, sympy.oo)


@cache
def scaled_limit(case: Case, power: Expr, log: int, right: Expr) -> Step:
    """N^power (log N)^log V → right."""
    found, factor = closed_form(case), N**power * sympy.log(N) ** log
    terms = tuple((k, ZERO, sympy.factor(power + p), log + j) for k, p, j in expansion(case))
    value = factor * found.claim.right
    limit = Step(Claim(value, "->", right, found.claim.given, N), by.Limit(terms))
    reached = transferred(found, limit, factor)
    claim = replace(reached.claim, given=(*hypotheses(case), EVENTUALLY[0]))
    return Step(claim, by.Eventually(), (reached, grows()))


@cache
def rate(case: Case) -> Step:
    """The leading term of V."""
    constant, power, log = expansion(case)[0]
    return scaled_limit(case, -power, -log, constant)


@cache
def order(case: Case) -> Step:
    """V = Theta of its leading power and logarithm."""
    _, power, log = expansion(case)[0]
    found = rate(case)
    claim = Claim(pieces(case).total, "Theta", N**power * sympy.log(N) ** log, found.claim.given, N)
    return Step(claim, by.Order(), (found,))
