"""Sums of regions, Eq. 17 of the paper over finitely many classes of directions: the worst decides.

A region has its own γ, α, s, c, c₂, and ρ0 <= α N^e. With Eqs. 16 and 18 in Eq. 17 it contributes

    worst case, b = 2, q = 1:  γ c₂ 2/(α N^(1+e)) + [c ρ0^(s+2)/(s+2) − c₂ ρ0] γ/(α² N^(1+2e)),
    best case, b = 2:          γ c ρ0^(s+2)/((s + 2) α² N^(1+2e)),
    flat, b = 0, worst case:   (γ/N) (c ρ0^s/s + c₂/ρ0),
    flat, b = 0, best case:    (γ/N) c ρ0^s/s,

and of a sum of regions the term with the highest power of N gives rate and constant.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, reduce

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import radial
from .radial import N, rho
from .tactics import ONE, ZERO, chain, limit_of_powers, positive, power_integral, real, transferred

TWO = sympy.Integer(2)
LARGE = (Claim(ONE, "<", N), *positive(N))
"""1 < N, and 0 < N by itself, so that its sign is seen at once."""


@dataclass(frozen=True)
class Region:
    """One region: its share of the variance, as Σ coefficient N^power.

    Parameters
    ----------
    closed : Step
        Integrals = their values.
    terms : tuple of (Expr, Expr)
        Pairs of a coefficient and a power of N, the leading one first.
    grows : Step, optional
        α N^e − ρ0 → ∞, where ρ0 <= α N^e is a hypothesis of ``closed``.
    """

    closed: Step
    terms: tuple[tuple[Expr, Expr], ...]
    grows: Step | None = None

    @property
    def share(self) -> Expr:
        """The integrals."""
        return self.closed.claim.left


@dataclass(frozen=True)
class Parameters:
    """Of one region: γ, α, the dimension s, ρ0, and c, c₂ of the integrand."""

    gamma: Symbol
    alpha: Symbol
    s: Symbol
    rho0: Symbol
    c: Symbol
    c2: Symbol


def parameters(k: int) -> Parameters:
    """The parameters with index k; those of Eq. 18 itself for k = 0."""
    if k == 0:
        own = (radial.gamma, radial.alpha, radial.s, radial.rho0, radial.c, radial.c2)
        return Parameters(*own)
    gamma, alpha, s, rho0, c, c2 = real(f"gamma_{k} alpha_{k} s_{k} rho_{k} f_{k} g_{k}")
    return Parameters(gamma, alpha, s, rho0, c, c2)


def _signs(p: Parameters, dimension: tuple[Claim, ...], has_tail: bool) -> tuple[Claim, ...]:
    tail = (p.c2,) if has_tail else ()
    return (*positive(p.gamma, p.alpha, p.s, p.rho0, p.c, *tail), *dimension)


def _grows(p: Parameters, e: Expr, dimension: tuple[Claim, ...]) -> Step:
    given = (*positive(p.alpha, p.rho0), *dimension, *LARGE)
    terms = [(p.alpha, e), (-p.rho0, ZERO)]
    return limit_of_powers(p.alpha * N**e - p.rho0, terms, N, given, sympy.oo)


@cache
def worst(k: int, e: Expr, dimension: tuple[Claim, ...] = ()) -> Region:
    """b = 2, q = 1, N_k = N^e; ``dimension`` are hypotheses from which 0 < e is seen."""
    p = parameters(k)
    values = (
        (radial.b, TWO), (radial.q, ONE), (radial.e, e), (radial.gamma, p.gamma),
        (radial.alpha, p.alpha), (radial.s, p.s), (radial.rho0, p.rho0), (radial.c, p.c),
        (radial.c2, p.c2),
    )  # fmt: skip
    found = radial.closed_form("b>q")
    moved = found.claim.at(*values)
    given = (*_signs(p, dimension, True), *LARGE, Claim(p.rho0, "<=", p.alpha * N**e))
    closed = Step(replace(moved, given=given), by.Instance(values), (found,))
    there = dict(values)
    terms = tuple(
        (u.xreplace(there), sympy.expand(v.xreplace(there))) for u, v, _ in radial.expansion("b>q")
    )
    return Region(closed, terms, _grows(p, e, dimension))


@cache
def best(k: int, e: Expr, dimension: tuple[Claim, ...] = ()) -> Region:
    """b = 2 and no power beyond ρ0, where the monomial bounds the profile for every N."""
    p = parameters(k)
    given = (*_signs(p, dimension, False), *LARGE)
    scale = p.gamma / N * (p.alpha * N**e) ** -2
    profile = p.gamma / N * (rho / (p.alpha * N**e)) ** 2
    integral = sympy.Integral(rho ** (p.s - 1) * profile * p.c, (rho, 0, p.rho0))
    closed = power_integral(integral, [(p.c * scale, p.s + 1)], given)
    constant = p.gamma * p.c * p.rho0 ** (p.s + 2) / ((p.s + 2) * p.alpha**2)
    return Region(closed, ((constant, sympy.expand(-1 - 2 * e)),))


@cache
def flat(k: int, has_tail: bool = True) -> Region:
    """b = 0: P_S = γ/N; with the tail c₂ ρ^(−s−1) in the worst case."""
    p = parameters(k)
    given = (*_signs(p, (), has_tail), *LARGE)
    shell, level = rho ** (p.s - 1), p.gamma / N
    low = sympy.Integral(shell * level * p.c, (rho, 0, p.rho0))
    parts = [power_integral(low, [(p.c * level, p.s - 1)], given)]
    constant = p.gamma * p.c * p.rho0**p.s / p.s
    if has_tail:
        fall = p.c2 * rho ** (-p.s - 1)
        high = sympy.Integral(shell * level * fall, (rho, p.rho0, sympy.oo))
        parts.append(power_integral(high, [(p.c2 * level, -TWO)], given))
        constant += p.gamma * p.c2 / p.rho0
    left, right = (sum((getattr(s.claim, side) for s in parts), ZERO) for side in ("left", "right"))
    return Region(chain(Claim(left, "=", right, given), *parts), ((constant, -ONE),))


def variance(regions: Sequence[Region]) -> Expr:
    """The sum of the shares."""
    return sum((r.share for r in regions), ZERO)


@cache
def closed_sum(regions: tuple[Region, ...]) -> Step:
    """The variance without integrals."""
    given = tuple(dict.fromkeys(h for r in regions for h in r.closed.claim.given))
    right = sum((r.closed.claim.right for r in regions), ZERO)
    claim = Claim(variance(regions), "=", right, given)
    return chain(claim, *(r.closed for r in regions))


@cache
def limit(regions: tuple[Region, ...], power: Expr, signs: tuple[Step, ...] = ()) -> Step:
    """N^power V → the sum of the coefficients of N^−power; ``signs`` compare powers."""
    found, factor = closed_sum(regions), N**power
    given = found.claim.given
    terms = tuple((u, ZERO, sympy.expand(power + v), 0) for r in regions for u, v in r.terms)
    right = sum((t[0] for t in terms if t[2] == 0), ZERO)
    claim = Claim(factor * found.claim.right, "->", right, given, N)
    reached = transferred(found, Step(claim, by.Limit(terms), signs), factor)
    return reduce(_without_start, (r for r in regions if r.grows), reached)


def _without_start(step: Step, region: Region) -> Step:
    """The same without ρ0 <= α N^e."""
    assert region.grows is not None
    gap = region.grows.claim.left
    given = tuple(h for h in step.claim.given if h.gap != gap)
    return Step(replace(step.claim, given=given), by.Eventually(), (step, region.grows))


@cache
def order(regions: tuple[Region, ...], power: Expr, signs: tuple[Step, ...] = ()) -> Step:
    """V = Θ(N^−power)."""
    found = limit(regions, power, signs)
    claim = Claim(variance(regions), "Theta", N**-power, found.claim.given, N)
    return Step(claim, by.Order(), (found,))
