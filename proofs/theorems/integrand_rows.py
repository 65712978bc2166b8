"""Spectra of integrands, Eq. 16: where its rows meet, its energy, an interval and a square.

With the second row as c (ρ/ρ0)^(−d−1) the rows meet at ρ0 and the energy is finite,

    ∫_0^ρ0 ρ^(d−1) c dρ + ∫_ρ0^∞ ρ^(d−1) c (ρ/ρ0)^(−d−1) dρ = c ρ0^d (d + 1)/d;

as printed, c ρ^(−d−1), they meet at ρ0 = 1 alone. An interval of length a has

    |f^(m)|² = (∫_0^a cos 2πmx dx)² + (∫_0^a sin 2πmx dx)² = sin²(πam)/(πm)² <= 1/(πm)²,

the worst case of d = 1, and the square with sides 1/2 has along an axis, at odd m = 2k + 1, the
power 1/(4π²m²): the decay d + 1 = 3 is one of means over directions, not of each direction.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .tactics import (
    ONE,
    ZERO,
    combine,
    limit_of_powers,
    positive,
    power_integral,
    real,
    transferred,
    whole,
)

rho, rho0, c, d = real("rho rho_0 c d")
a, m, k, x = real("a m k x")
pi, sin, cos = sympy.pi, sympy.sin, sympy.cos
TWO = sympy.Integer(2)
_SIGNS = positive(c, rho0, d)


@cache
def energy() -> Step:
    """c ρ0^d (d + 1)/d."""
    low = sympy.Integral(rho ** (d - 1) * c, (rho, 0, rho0))
    high = sympy.Integral(rho ** (d - 1) * c * (rho / rho0) ** (-d - 1), (rho, rho0, sympy.oo))
    parts = (
        power_integral(low, [(c, d - 1)], _SIGNS),
        power_integral(high, [(c * rho0 ** (d + 1), -TWO)], _SIGNS),
    )
    claim = Claim(low + high, "=", c * rho0**d * (d + 1) / d, _SIGNS)
    return combine(claim, *((1, p) for p in parts))


ROWS = Claim(c * rho0 ** (-d - 1), "=", c, _SIGNS)
"""The rows of Eq. 16 meet at ρ0."""


@cache
def rows_do_not_meet() -> Step:
    """At ρ0 = 2, d = 1 the second row is c/4."""
    values = ((c, ONE), (rho0, TWO), (d, ONE))
    there = ROWS.at(*values)
    less = combine(Claim(there.left, "<", there.right), remainder=sympy.Rational(3, 4))
    return Step(replace(ROWS, false=True), by.Counterexample(values), (less,))


def waves(length: Expr, frequency: Expr) -> tuple[Expr, Expr]:
    """∫_0^length cos 2πmx dx and the same of the sine."""
    angle = 2 * pi * frequency * x
    return tuple(sympy.Integral(f(angle), (x, 0, length)) for f in (cos, sin))  # pyright: ignore


def interval_power(length: Expr, frequency: Expr) -> Expr:
    """|f^(m)|² of an interval."""
    real_part, imaginary = waves(length, frequency)
    return real_part**2 + imaginary**2


@cache
def wave_integrals() -> tuple[Step, Step]:
    """The integrals in closed form."""
    given = (Claim(ZERO, "<=", a), Claim(m, "!=", ZERO))
    turn, (even, odd) = 2 * pi * m, waves(a, m)
    return (
        Step(
            Claim(even, "=", sin(turn * a) / turn, given), by.Antiderivative(sin(turn * x) / turn)
        ),
        Step(
            Claim(odd, "=", (1 - cos(turn * a)) / turn, given),
            by.Antiderivative(-cos(turn * x) / turn),
        ),
    )


@cache
def interval_spectrum() -> Step:
    """|f^(m)|² = sin²(πam)/(πm)²."""
    even, odd = wave_integrals()
    claim = Claim(interval_power(a, m), "=", sin(pi * a * m) ** 2 / (pi * m) ** 2, even.claim.given)
    return combine(
        claim,
        (even.claim.left + even.claim.right, even), (odd.claim.left + odd.claim.right, odd),
    )  # fmt: skip


@cache
def interval_decay() -> Step:
    """|f^(m)|² <= 1/(πm)², c ρ^(−d−1) at d = 1."""
    found = interval_spectrum()
    rest = cos(pi * a * m) ** 2 / (pi * m) ** 2
    claim = Claim(interval_power(a, m), "<=", 1 / (pi * m) ** 2, found.claim.given)
    return combine(claim, (1, found), remainder=rest)


_ODD = 2 * k + 1
_SQUARE = interval_power(sympy.Rational(1, 2), _ODD) / 4
SQUARE_ALONG_AN_AXIS = Claim(
    _SQUARE, "O", _ODD**-3, (*whole(k), Claim(ONE, "<", k)), k
)  # fmt: skip
"""The square [0, 1/2]² decays as ρ^−3 along an axis."""


@cache
def square_along_an_axis() -> Step:
    """|f^(m, 0)|² = 1/(4π²m²) at m = 2k + 1."""
    values = ((a, sympy.Rational(1, 2)), (m, _ODD))
    found, given = interval_spectrum(), SQUARE_ALONG_AN_AXIS.given
    apart = combine(Claim(ZERO, "<", _ODD, given), (2, Step(Claim(ONE, "<", k, given), by.Given())),
                    remainder=3)  # fmt: skip
    odd = combine(Claim(_ODD, "!=", ZERO, given), (0, apart), remainder=-_ODD)
    moved = Step(replace(found.claim.at(*values), given=given), by.Instance(values), (found, odd))
    claim = Claim(_SQUARE, "=", 1 / (4 * pi**2 * _ODD**2), given)
    return combine(claim, (sympy.Rational(1, 4), moved), (0, apart))


@cache
def square_decays_slower() -> Step:
    """m³ |f^(m, 0)|² = m/(4π²) → ∞."""
    found, given = square_along_an_axis(), SQUARE_ALONG_AN_AXIS.given
    factor, share = _ODD**3, 1 / (4 * pi**2)
    terms = [(2 * share, ONE), (share, ZERO)]
    limit = limit_of_powers(factor * found.claim.right, terms, k, given, sympy.oo)
    reached = transferred(found, limit, factor)
    return Step(replace(SQUARE_ALONG_AN_AXIS, false=True), by.Counterexample(()), (reached,))
