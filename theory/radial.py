"""Eq. 17 along one region in closed form: saturating monomial against a power-law integrand.

    V = ∫_0^∞ ρ^(s−1) P_S(ρ) P_f(ρ) dρ,        P_S = (γ/N) min(1, (ρ/ν)^b),   ν = α N^e,
    P_f = c for ρ < ρ0, c2 ρ^-p beyond (c2 = 0 in the best case),             q = p − s > 0.

Both spectra are pieces of powers, so V is a sum of power integrals over the pieces between the
breaks 0, ρ0, ν, ∞ in their order. ∫ρ^k dρ is a logarithm exactly at k = −1, which between ρ0 and
ν is the tie b = q. The paper's second row of Eq. 16 has c2 = c; a continuous spectrum has
c2 = c ρ0^p (erratum to Eq. 16), and its Jacobian on a region is ρ^(s−1) (errata to Eqs. 19-25).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from .errors import InputError, UndecidedSign
from .orders import Order
from .signs import Assumptions, nonnegative, sign_of
from .symbolic import Expr, Integer, sympy

N = sympy.Symbol("N", positive=True)
NU = sympy.Symbol("nu", positive=True)
RHO_0 = sympy.Symbol("rho_0", positive=True)
C_F = sympy.Symbol("c_f", positive=True)

Break = Literal["0", "rho0", "nu", "oo"]


@dataclass(frozen=True)
class Radial:
    """One radial problem of Eq. 17.

    Parameters
    ----------
    degree : sympy.Expr
        b >= 0; ``oo`` for a step.
    dimension : sympy.Expr
        s >= 1, the dimension of the region.
    decay : sympy.Expr
        p > s; ``oo`` for the best case, no power beyond ρ0.
    effective : sympy.Expr
        e >= 0 in N_k = N^e.
    gamma, alpha : sympy.Expr
        Plateau and frequency scale of the monomial.
    c, c2 : sympy.Expr
        The integrand's constants below and above ρ0.
    rho0 : sympy.Expr
        ρ0 > 0.
    """

    degree: Expr
    dimension: Expr
    decay: Expr
    effective: Expr
    gamma: Expr = Integer(1)
    alpha: Expr = Integer(1)
    c: Expr = C_F
    c2: Expr = C_F
    rho0: Expr = RHO_0

    @property
    def q(self) -> Expr:
        """p − s, the power with which the energy of dyadic shells falls."""
        return sympy.oo if self.decay is sympy.oo else self.decay - self.dimension


@dataclass(frozen=True)
class PowerLog:
    """coefficient · ν^power · log(ν/ρ0)^log, a term of N·V/γ."""

    coefficient: Expr
    power: Expr
    log: int = 0


@dataclass(frozen=True)
class Leading:
    """V ~ constant · N^-exponent (log N)^log_power."""

    order: Order
    constant: Expr


def power_log_terms(
    problem: Radial, crossed: bool, tied: bool | None = None
) -> tuple[PowerLog, ...]:
    """N·V/γ as a sum of powers of ν.

    Parameters
    ----------
    crossed : bool
        Whether ρ0 <= ν (else ρ0 > ν: N is still so small that nothing decays).
    tied : bool, optional
        Whether b = q; found from the problem if it can be.

    Raises
    ------
    UndecidedSign
        If b is symbolic and ``tied`` is not told.
    """
    if nonnegative(-problem.q, ()) and problem.decay is not sympy.oo:
        raise InputError(f"the decay p must exceed the dimension s: got p - s = {problem.q}")
    found: list[PowerLog] = []
    for coefficient, nu_power, k, lower, upper in _pieces(problem, crossed):
        found += _power_integral(coefficient, nu_power, k, lower, upper, problem.rho0, tied)
    return tuple(t for t in found if t.coefficient != 0)


def _pieces(problem: Radial, crossed: bool) -> Iterator[tuple[Expr, Expr, Expr, Break, Break]]:
    """(coefficient, power of ν, power of ρ, from, to) of the integrand's pieces, ordered."""
    b, s, p = problem.degree, problem.dimension, problem.decay
    breaks: tuple[Break, ...] = ("0", "rho0", "nu", "oo") if crossed else ("0", "nu", "rho0", "oo")
    for lower, upper in pairwise(breaks):
        rising = upper == "nu" or (crossed and lower == "0")
        falling = lower == "rho0" or (crossed and lower == "nu")
        if (rising and b is sympy.oo) or (falling and (p is sympy.oo or problem.c2 == 0)):
            continue
        k = s - 1 + (b if rising else 0) - (p if falling else 0)
        amplitude = problem.c2 if falling else problem.c
        yield amplitude, (-b if rising else Integer(0)), sympy.expand(k), lower, upper


def _power_integral(
    coefficient: Expr,
    nu_power: Expr,
    k: Expr,
    lower: Break,
    upper: Break,
    rho0: Expr,
    tied: bool | None,
) -> Iterator[PowerLog]:
    """∫ coefficient · ν^nu_power · ρ^k dρ between two breaks, by the power rule."""
    is_middle = (lower, upper) == ("rho0", "nu")
    logarithm = _is_zero(k + 1, tied) if is_middle else False
    if logarithm:
        yield PowerLog(coefficient, nu_power, 1)
        return
    for sign, at in ((1, upper), (-1, lower)):
        if at in ("0", "oo"):
            continue  # k + 1 > 0 where a piece starts at 0, < 0 where it ends at infinity
        scale = sign * coefficient / (k + 1)
        if at == "nu":
            yield PowerLog(scale, sympy.expand(nu_power + k + 1))
        else:
            yield PowerLog(scale * rho0 ** (k + 1), nu_power)


def _is_zero(value: Expr, tied: bool | None) -> bool:
    if value.is_number:
        return bool(value == 0)
    if tied is None:
        raise UndecidedSign(f"whether b = q must be known for a closed form: got b - q = {value}")
    return tied


def closed_form(problem: Radial, crossed: bool = True, tied: bool | None = None) -> Expr:
    """V of Eq. 17 as an exact expression in N (see ``power_log_terms`` for the parameters)."""
    nu = problem.alpha * N**problem.effective
    total = sum(
        (
            t.coefficient * nu**t.power * sympy.log(nu / problem.rho0) ** t.log
            for t in power_log_terms(problem, crossed, tied)
        ),
        Integer(0),
    )
    return problem.gamma / N * total


def leading(
    problem: Radial,
    assumptions: Assumptions = (),
    tied: bool | None = None,
    crossed: bool = True,
) -> Leading | None:
    """Leading term of V as N → ∞; None if V vanishes for large N (step against best case).

    Parameters
    ----------
    crossed : bool
        Whether ρ0 <= ν; asked only where e = 0: else ν outgrows ρ0.

    Raises
    ------
    UndecidedSign
        If powers of ν cannot be compared under the assumptions.
    """
    if problem.effective == 0:
        constant = N * closed_form(problem, crossed, tied)
        return Leading(Order(Integer(1)), constant) if constant != 0 else None
    terms = power_log_terms(problem, True, tied)
    if not terms:
        return None
    best = terms[0]
    for t in terms[1:]:
        best = _larger(best, t, assumptions)
    constant = sum(
        (t.coefficient for t in terms if (t.power, t.log) == (best.power, best.log)), Integer(0)
    )
    log_factor = problem.effective if best.log else Integer(1)
    order = Order(1 - problem.effective * best.power, Integer(best.log))
    return Leading(order, problem.gamma * constant * problem.alpha**best.power * log_factor)


def _larger(first: PowerLog, second: PowerLog, assumptions: Assumptions) -> PowerLog:
    sign = sign_of(sympy.expand(second.power - first.power), assumptions)
    if sign == "0":
        return second if second.log > first.log else first
    if sign in ("+", ">=0"):
        return second
    if sign in ("-", "<=0"):
        return first
    raise UndecidedSign(f"powers of nu must be comparable: got {first.power} and {second.power}")
