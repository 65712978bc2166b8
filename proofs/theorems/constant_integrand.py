"""A constant integrand: no estimator errs on it, and Eq. 4 as an integral says that it does.

For f = 1 on the unit cube and independent points I_N − I = Σ 1/N − ∫_0^1 dx = 0, and P_S = 1/N,
P_f = sinc² ν make ∫ P_S P_f dν = (2/N) ∫_0^∞ sinc² ν dν > 0, as 1 − (π²/3) ν² <= sinc² ν below 1/2.
On the unit torus a sum over whole ν ≠ 0 stands in place of the integral, and sinc² is 0 there.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .sines import jitter_envelope
from .sines import x as argument
from .strata import half, pi, sinc2, sizes
from .tactics import ONE, ZERO, chain, combine, positive, power_integral, real

N, nu, j, x = real("N nu j x")
_ERROR = sympy.Sum(1 / N, (j, 1, N)) - sympy.Integral(ONE, (x, 0, 1))


def power(low: Expr, high: Expr) -> Expr:
    """∫ sinc² ν dν."""
    return sympy.Integral(sinc2(nu), (nu, low, high))


PRINTED = Claim(_ERROR**2, "=", 2 / N * power(ZERO, sympy.oo), sizes(N))
"""The variance at f = 1, with P_S = 1/N."""


@cache
def tail() -> Step:
    """∫_{1/2}^∞ sinc² <= 2/π²: it converges."""
    inside = (Claim(half, "<", nu),)
    above = 1 / (pi * nu) ** 2
    far = combine(Claim(ZERO, "<", nu, inside),
                  (1, Step(Claim(half, "<", nu, inside), by.Given())), remainder=half)  # fmt: skip
    point = combine(
        Claim(sinc2(nu), "<=", above, inside), (0, far),
        remainder=sympy.cos(pi * nu) ** 2 / (pi * nu) ** 2,
    )  # fmt: skip
    wide = sympy.Integral(above, (nu, half, sympy.oo))
    size = power_integral(wide, [(1 / pi**2, -sympy.Integer(2))], ())
    bound = Step(Claim(power(half, sympy.oo), "<=", wide), by.Bind(), (point, size, far))
    return chain(Claim(power(half, sympy.oo), "<=", 2 / pi**2), bound, size)


@cache
def head() -> Step:
    """1/2 − π²/72 <= ∫_0^{1/2} sinc²."""
    inside = (Claim(ZERO, "<", nu), Claim(nu, "<", half))
    below = 1 - pi**2 / 3 * nu**2
    moved = jitter_envelope().claim.at((argument, nu))
    envelope = Step(
        Claim(moved.left, "<=", moved.right, positive(nu)), by.Instance(((argument, nu),)),
        (jitter_envelope(),),
    )  # fmt: skip
    point = combine(Claim(below, "<=", sinc2(nu), inside), (1, envelope))
    under = sympy.Integral(below, (nu, 0, half))
    bound = Step(Claim(under, "<=", power(ZERO, half)), by.Bind(), (point,))
    value = half - pi**2 / 72
    size = Step(Claim(under, "=", value), by.Antiderivative(nu - pi**2 / 9 * nu**3))
    return combine(Claim(value, "<=", power(ZERO, half)), (1, bound), (-1, size))


@cache
def power_above_zero() -> Step:
    """0 < ∫_0^∞ sinc²."""
    inside = (Claim(half, "<", nu),)
    nothing = sympy.Integral(ZERO, (nu, half, sympy.oo))
    point = combine(Claim(ZERO, "<=", sinc2(nu), inside), remainder=sinc2(nu))
    rest = Step(Claim(nothing, "<=", power(half, sympy.oo)), by.Bind(), (point, tail()))
    none = Step(Claim(nothing, "=", ZERO), by.Linear(()))
    whole_ = power(ZERO, sympy.oo)
    cut = Step(
        Claim(whole_, "=", power(ZERO, half) + power(half, sympy.oo)), by.Range(half), (tail(),)
    )
    return combine(
        Claim(ZERO, "<", whole_), (-1, cut), (1, head()), (1, rest), (-1, none),
        remainder=half - pi**2 / 72,
    )  # fmt: skip


@cache
def refutation() -> Step:
    """One point at f = 1 has no error, and the integral is above 0."""
    values = ((N, ONE),)
    there = PRINTED.at(*values)
    one, cube = sympy.Sum(ONE, (j, 1, 1)), sympy.Integral(ONE, (x, 0, 1))
    single = Step(Claim(one, "=", ONE), by.Range())
    size = Step(Claim(cube, "=", ONE), by.Antiderivative(x))
    gap = one - cube
    less = combine(
        Claim(there.left, "<", there.right), (gap, single), (-gap, size), (2, power_above_zero())
    )
    return Step(replace(PRINTED, false=True), by.Counterexample(values), (less,))
