"""Polar coordinates of the frequency plane (paper, Eqs. 6-9 at d = 2), proved on waves and powers.

Eq. 8 at P_S P_f = xy exp(−α(x² + y²) − δy²) on the quarter x, y > 0 of a disc of radius R,

    ∫_0^{π/2} ∫_0^R ρ³ cos φ sin φ exp(−ρ² (α + δ sin² φ)) dρ dφ = ∫_0^R ∫_0^√(R² − x²) dy dx,

for all α, δ, R > 0, and a measure is known by its Laplace transform (here in x² and y²), so that
ρ dρ dφ is dx dy for every integrand. The order of the integrals (Eqs. 7 and 8) is free for all
ρ^(p−1) exp(qφ), hence for their sums and the limits of these.

Eq. 6 at P_S = ρ^b (1 + s cos 2πφ)/N, P_f = ρ^p (1 + t cos 2πφ), φ the turned share of a circle:

    ∫∫ ρ P_S P_f 2π dφ dρ = 2π (1 + st/2) ∫ ρ (mean P_S) (mean P_f) dρ,

so that the circle's length is missing in it and one of the two must be isotropic, whichever.

Eq. 9, m directions: (2π/m) Σ_k (A + B cos 2πqk/m) is the integral over the circle once m > q.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .shifts import M, full_turns, q
from .shifts import t as index
from .strata import telescoped
from .tactics import ONE, ZERO, chain, combine, positive, real

rho, phi, alpha, delta, kappa, x, y, R = real("rho phi alpha delta kappa x y R")
b, p, s, t, N, r_1, r_2, A, B = real("b p s t N r_1 r_2 A B")
pi, sin, cos, exp = sympy.pi, sympy.sin, sympy.cos, sympy.exp
TWO, half = sympy.Integer(2), sympy.Rational(1, 2)
RATES = positive(alpha, delta, R)
SLOPE = alpha + delta * sin(phi) ** 2


_WAVE = x * y * exp(-alpha * x**2 - (alpha + delta) * y**2)
_ALONG = rho**3 * exp(-kappa * rho**2)
_RAY = cos(phi) * sin(phi)
CARTESIAN = sympy.Integral(_WAVE, (y, 0, sympy.sqrt(R**2 - x**2)), (x, 0, R))
RADIAL = sympy.Integral(_RAY * _ALONG.xreplace({kappa: SLOPE}), (rho, 0, R), (phi, 0, pi / 2))
VALUE = (
    (1 - exp(-alpha * R**2)) / (4 * alpha * (alpha + delta))
    - (exp(-alpha * R**2) - exp(-(alpha + delta) * R**2)) / (4 * (alpha + delta) * delta)
)  # fmt: skip


@cache
def cartesian() -> Step:
    """∫∫ xy exp(−αx² − (α + δ) y²) dy dx over the quarter of a disc."""
    inside = (*RATES, Claim(ZERO, "<", x), Claim(x, "<", R))
    ends = [Step(Claim(h.left, "<", h.right, inside), by.Given()) for h in inside[-2:]]
    height = R**2 - x**2
    above = combine(Claim(ZERO, "<", height, inside), (R + x, ends[1]), (0, ends[0]))
    beta = alpha + delta
    rise = x * exp(-alpha * x**2) / (2 * beta)
    column = rise * (1 - exp(-beta * height))
    inner = Step(
        Claim(sympy.Integral(_WAVE, CARTESIAN.limits[0]), "=", column, inside),
        by.Antiderivative(-rise * exp(-beta * y**2)), (above, ends[0]),
    )  # fmt: skip
    primitive = (
        -exp(-alpha * x**2) / (4 * alpha * beta)
        - exp(-beta * R**2 + delta * x**2) / (4 * beta * delta)
    )  # fmt: skip
    outer = sympy.Integral(column, (x, 0, R))
    total = Step(Claim(outer, "=", VALUE, RATES), by.Antiderivative(primitive))
    bound = Step(Claim(CARTESIAN, "=", outer, RATES), by.Bind(), (inner, total))
    return chain(Claim(CARTESIAN, "=", VALUE, RATES), bound, total)


@cache
def polar() -> Step:
    """The same by rays: ρ³ cos φ sin φ exp(−ρ² (α + δ sin² φ))."""
    inside = (*RATES, Claim(ZERO, "<", phi), Claim(phi, "<", pi / 2))
    fall = -(rho**2 / (2 * SLOPE) + 1 / (2 * SLOPE**2)) * exp(-SLOPE * rho**2)
    ray = _RAY * (fall.xreplace({rho: R}) + 1 / (2 * SLOPE**2))
    inner = Step(
        Claim(sympy.Integral(RADIAL.function, (rho, 0, R)), "=", ray, inside),
        by.Antiderivative(_RAY * fall),
    )
    outer = sympy.Integral(ray, (phi, 0, pi / 2))
    primitive = (exp(-SLOPE * R**2) - 1) / (4 * delta * SLOPE)
    total = Step(Claim(outer, "=", VALUE, RATES), by.Antiderivative(primitive))
    bound = Step(Claim(RADIAL, "=", outer, RATES), by.Bind(), (inner, total))
    return chain(Claim(RADIAL, "=", VALUE, RATES), bound, total)


@cache
def cartesian_is_polar() -> Step:
    """∫∫ dx dy by rays."""
    return combine(Claim(CARTESIAN, "=", RADIAL, RATES), (1, cartesian()), (-1, polar()))


SHELL = (*positive(r_1), Claim(r_1, "<", r_2))


def shell(by_circle: Expr) -> Expr:
    """∫ ρ^(1 + b + p)/N by_circle dρ over a shell."""
    return sympy.Integral(rho ** (1 + b + p) / N * by_circle, (rho, r_1, r_2))


@cache
def radial_averages() -> Step:
    """Eq. 6 over a shell, with what is missing in it."""
    given = (*SHELL, *positive(N))
    inside = (*given, Claim(r_1, "<", rho), Claim(rho, "<", r_2))
    turn = 2 * pi * phi
    power = rho ** (1 + b + p) / N
    product = (1 + s * cos(turn)) * (1 + t * cos(turn))
    size = 2 * pi * (1 + s * t / 2)
    primitive = (
        2
        * pi
        * power
        * (phi + (s + t) * sin(turn) / (2 * pi) + s * t * (phi / 2 + sin(2 * turn) / (8 * pi)))
    )
    far = combine(Claim(ZERO, "<", rho, inside),
                  (1, Step(Claim(r_1, "<", rho, inside), by.Given())), remainder=r_1)  # fmt: skip
    around = sympy.Integral(2 * pi * power * product, (phi, 0, 1))
    circle = Step(Claim(around, "=", power * size, inside), by.Antiderivative(primitive), (far,))
    left, right = sympy.Integral(around, (rho, r_1, r_2)), shell(size)
    shells = Step(Claim(left, "=", right, given), by.Bind(), (circle,))
    value = size * shell(ONE)
    scale = Step(Claim(right, "=", value, given), by.Linear(((size, power),)))
    return chain(Claim(left, "=", value, given), shells, scale)


EQ_6 = Claim(radial_averages().claim.left, "=", shell(ONE), radial_averages().claim.given)


@cache
def no_circle() -> Step:
    """Eq. 6 as printed at isotropic spectra 1 on 1 < ρ < 2, N = 1: 3/2 for 3π."""
    numbers = {b: ZERO, p: ZERO, s: ZERO, t: ZERO, N: ONE, r_1: ONE, r_2: TWO}
    values = tuple(numbers.items())
    there, exact = EQ_6.at(*values), radial_averages().claim.at(*values)
    known = Step(Claim(exact.left, "=", exact.right), by.Instance(values), (radial_averages(),))
    size = Step(Claim(there.right, "=", 3 * half), by.Antiderivative(rho**2 / 2))
    claim = Claim(there.right, "<", there.left)
    less = combine(claim, (-1, known), (2 * pi - 1, _at_least(size)), remainder=2 * pi - 1)
    return Step(replace(EQ_6, false=True), by.Counterexample(values), (less,))


def _at_least(equation: Step) -> Step:
    """1 <= f from f = 3/2."""
    return combine(Claim(ONE, "<=", equation.claim.left), (-1, equation), remainder=half)


BOX = (*SHELL, Claim(p, "!=", ZERO), Claim(q, "!=", ZERO))


@cache
def order_of_integrals() -> Step:
    """∫∫ ρ^(p−1) exp(qφ) dφ dρ = ∫∫ ρ^(p−1) exp(qφ) dρ dφ on a shell, φ from 0 to 1."""
    given, turn = BOX, (exp(q) - 1) / q
    term = rho ** (p - 1) * exp(q * phi)
    rows, columns = (r_1, r_2), (ZERO, ONE)
    radial = (r_2**p - r_1**p) / p
    inside = (*given, Claim(r_1, "<", rho), Claim(rho, "<", r_2))
    far = combine(Claim(ZERO, "<", rho, inside),
                  (1, Step(Claim(r_1, "<", rho, inside), by.Given())), remainder=r_1)  # fmt: skip
    around = Step(
        Claim(sympy.Integral(term, (phi, *columns)), "=", rho ** (p - 1) * turn, inside),
        by.Antiderivative(rho ** (p - 1) * exp(q * phi) / q), (far,),
    )  # fmt: skip
    turned = sympy.Integral(around.claim.right, (rho, *rows))
    value = radial * turn
    first = _twice(around, turned, rho**p / p * turn, value, (rho, *rows), given)
    across = (*given, Claim(ZERO, "<", phi), Claim(phi, "<", ONE))
    along = Step(
        Claim(sympy.Integral(term, (rho, *rows)), "=", exp(q * phi) * radial, across),
        by.Antiderivative(rho**p / p * exp(q * phi)),
    )
    swept = sympy.Integral(along.claim.right, (phi, *columns))
    second = _twice(along, swept, radial * exp(q * phi) / q, value, (phi, *columns), given)
    return combine(Claim(first.claim.left, "=", second.claim.left, given), (1, first), (-1, second))


def _twice(
    inner: Step,
    outer: Expr,
    primitive: Expr,
    value: Expr,
    range_: tuple[Expr, ...],
    given: tuple[Claim, ...],
) -> Step:
    """∫ of an inner integral, of which ``inner`` is the value and ``outer`` the integral."""
    whole_ = sympy.Integral(inner.claim.left, range_)
    total = Step(Claim(outer, "=", value, given), by.Antiderivative(primitive))
    bound = Step(Claim(whole_, "=", outer, given), by.Bind(), (inner, total))
    return chain(Claim(whole_, "=", value, given), bound, total)


@cache
def directions() -> Step:
    """(2π/M) Σ_t (A + B cos 2πqt/M) = ∫_0^1 2π (A + B cos 2πqφ) dφ for M > q directions."""
    turns = full_turns(cos)
    given = turns.claim.given
    wave = turns.claim.left.function
    parts = ((2 * pi * A / M, ONE), (2 * pi * B / M, wave))
    term = sympy.Add(*(c * f for c, f in parts))
    ones = sympy.Sum(ONE, (index, 1, M))
    split = Step(
        Claim(sympy.Sum(term, (index, 1, M)), "=",
              sympy.Add(*(c * sympy.Sum(f, (index, 1, M)) for c, f in parts)), given),
        by.Linear(parts), (_large(given),),
    )  # fmt: skip
    size = Step(Claim(ones, "=", M, given), by.Instance(()), (telescoped(ONE, ONE, index, M),))
    angle = 2 * pi * q * phi
    circle = sympy.Integral(2 * pi * (A + B * cos(angle)), (phi, 0, 1))
    whole_ = Step(
        Claim(circle, "=", 2 * pi * A, given),
        by.Antiderivative(2 * pi * A * phi + B * sin(angle) / q),
    )
    return combine(
        Claim(split.claim.left, "=", circle, given),
        (1, split), (2 * pi * A / M, size), (2 * pi * B / M, turns), (-1, whole_),
        (0, _large(given)),
    )  # fmt: skip


def _large(given: tuple[Claim, ...]) -> Step:
    """0 < M."""
    return combine(Claim(ZERO, "<", M, given),
                   (1, Step(Claim(ONE, "<=", M, given), by.Given())), remainder=1)  # fmt: skip
