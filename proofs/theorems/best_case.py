"""The best case of Eq. 16 against a saturating monomial: its closed form, limit and order.

Where the integrand has power c below ρ0 <= ν = α N^e and none above,

    V = ∫_0^ρ0 ρ^(s−1) (γ/N) (ρ/ν)^b c dρ = γ c ρ0^(s+b)/((s + b) N ν^b),

of order N^−(1+eb) from both sides. (The paper, Eqs. 22, 27, 51-54.)
"""

from functools import cache

from ...theory.symbolic import sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import radial
from .flats import d
from .radial import N, alpha, b, c, e, gamma, rho, rho0, s
from .tactics import ZERO, combine, limit_of_powers, positive, power_integral, transferred

BEST = sympy.Integral(rho ** (s - 1) * gamma / N * (rho / radial.nu) ** b * c, (rho, 0, rho0))
"""Eqs. 22, 51: V where the integrand has power c below ρ0 <= ν and none above."""


@cache
def best_closed_form() -> Step:
    """V of the best case is γ c ρ0^(s+b)/((s + b) N ν^b)."""
    given = (*positive(b, s, alpha, gamma, rho0, c), radial.EVENTUALLY[0])
    found = power_integral(BEST, [(c * gamma / N * radial.nu**-b, s - 1 + b)], given)
    right = gamma * c * rho0 ** (s + b) / ((s + b) * N * radial.nu**b)
    return combine(Claim(BEST, "=", right, given), (1, found))


@cache
def best_rate() -> Step:
    """N^(1+eb) V → γ c ρ0^(s+b)/((s + b) α^b)."""
    found, power = best_closed_form(), 1 + e * b
    constant = gamma * c * rho0 ** (s + b) / ((s + b) * alpha**b)
    given = found.claim.given
    limit = limit_of_powers(N**power * found.claim.right, [(constant, ZERO)], N, given, constant)
    return transferred(found, limit, N**power)


@cache
def best_order() -> Step:
    """V = Theta(N^−(1+eb)) in the best case."""
    found = best_rate()
    claim = Claim(BEST, "Theta", N ** (-1 - e * b), found.claim.given, N)
    return Step(claim, by.Order(), (found,))


@cache
def best_order_of_lines() -> Step:
    """Eq. 27, second row, as a rate: Theta(N^(−(b+d−1)/(d−1)))."""
    values = ((s, d - 1), (e, 1 / (d - 1)))
    moved = best_order().claim.at(*values)
    given = (*positive(b, alpha, gamma, rho0, c), Claim(sympy.Integer(2), "<=", d),
             radial.EVENTUALLY[0])  # fmt: skip
    claim = Claim(moved.left, "Theta", N ** (-(b + d - 1) / (d - 1)), given, N)
    return Step(claim, by.Instance(values), (best_order(),))
