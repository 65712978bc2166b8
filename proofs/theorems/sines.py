"""Sines and sinc: bounds for all arguments, each from the derivative of the one before.

    cos z <= 1,   sin z <= z,   1 − z²/2 <= cos z,   z − z³/6 <= sin z,   cos z <= 1 − z²/2 + z⁴/24

for z >= 0, and from the last, at z = 2πx, the envelope of jitter on an axis (paper, Eq. 18 with
γ = 1, α = √3/π and b = 2):

    1 − sinc²(x) <= (π²/3) x²,      sinc x = sin(πx)/(πx).
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .tactics import ONE, ZERO, combine, positive, real

z, x = real("z x")
pi, sin, cos = sympy.pi, sympy.sin, sympy.cos
_FROM_0 = (Claim(ZERO, "<=", z),)


@cache
def cosine_at_most_one() -> Step:
    """cos z <= 1, as 2(1 − cos z) = (1 − cos z)² + sin² z."""
    half = sympy.Rational(1, 2)
    return combine(
        Claim(cos(z), "<=", ONE), remainder=half * (1 - cos(z)) ** 2 + half * sin(z) ** 2
    )


def _integrated(f: Expr, below: Step) -> Step:
    """f(0) <= f(z), since 0 <= f'(z) is what ``below`` says."""
    slope = combine(Claim(ZERO, "<=", f.diff(z), positive(z)), (1, below))
    return Step(Claim(f.xreplace({z: ZERO}), "<=", f, _FROM_0), by.Monotone(z, ZERO), (slope,))


@cache
def remainder(order: int) -> Step:
    """0 <= the gap of the bound of this order, 1 to 4, for z >= 0."""
    gaps = (
        z - sin(z),
        z**2 / 2 - 1 + cos(z),
        sin(z) - z + z**3 / 6,
        z**4 / 24 - z**2 / 2 + 1 - cos(z),
    )
    step = cosine_at_most_one()
    for gap in gaps[:order]:
        step = _integrated(gap, step)
    return step


@cache
def jitter_envelope() -> Step:
    """1 − sinc²(x) <= (π²/3) x² for x > 0."""
    there = 2 * pi * x
    bound = remainder(4).claim.right.xreplace({z: there})
    moved = Step(Claim(ZERO, "<=", bound, positive(x)), by.Instance(((z, there),)), (remainder(4),))
    sinc = sin(pi * x) / (pi * x)
    claim = Claim(1 - sinc**2, "<=", pi**2 / 3 * x**2, positive(x))
    return combine(claim, (1 / (2 * pi**2 * x**2), moved))
