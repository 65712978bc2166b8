"""What is printed of point estimators and fails at numbers, and what holds in its place.

A shift of all points turns F_S(m) and keeps |F_S(m)|, 1 for one point; unnormalised sums
Σ_j exp(−2πi m·s_j) need 1/N² in the variance; independent points in the unit cube have N P_S = 1
at whole ν ≠ 0 only; what a variance needs is P_S bounded and f square integrable,

    Σ_k P_S(k) P_f(k) <= (γ/N) Σ_k P_f(k)      for P_S <= γ/N,

while f(x) = x^(−1/2) has ∫ f = 2 and ∫ f² = ∞; and the sum over directions of Eq. 9 gives a ridge,
a spectrum on the axes alone, the weight 0.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import strata
from .rules import N as count
from .rules import alpha, gamma, k, total
from .shifts import K, M, N, a, phase
from .strata import blur, cos, half, nu, pi, sin, sinc2, sizes, uniform_place
from .tactics import ONE, ZERO, combine, limit_of_powers, positive, real, transferred, whole
from .variance import HERE, POINTS, over, over_shifts, power

x, h, r, m, psi, u = real("x h r m psi u")
spectrum, integrand = sympy.Function("P"), sympy.Function("f")
TWO = sympy.Integer(2)


@cache
def shift_keeps_power() -> Step:
    """|F_S|² of points whose phases have all been turned by ψ."""
    given = sizes(count)
    uses: list[tuple[Expr, Step]] = []
    sums = [total(f(alpha(k)), k) for f in (cos, sin)]
    for f, parts in ((cos, (cos(psi), -sin(psi))), (sin, (sin(psi), cos(psi)))):
        turned = total(f(alpha(k) + psi), k)
        value = parts[0] * sums[0] + parts[1] * sums[1]
        reason = by.Linear(((parts[0], cos(alpha(k))), (parts[1], sin(alpha(k)))))
        uses.append((turned + value, Step(Claim(turned, "=", value, given), reason)))
    left = sympy.Add(*(u.claim.left**2 for _, u in uses))
    right = sympy.Add(*(s**2 for s in sums))
    return combine(Claim(left, "=", right, given), *uses)


def _turned(f: Expr) -> Expr:
    return total(f(alpha(k) + 2 * pi * u), k)


IN_THE_DISC = Claim(
    sympy.Integral(sympy.Add(*(_turned(f) ** 2 for f in (cos, sin))) / count**2, (u, 0, 1)), "=",
    half, sizes(count),
)  # fmt: skip
"""The mean of |F_S(m)|² over shifts is that of a uniform place in the unit disc."""


@cache
def on_the_circle() -> Step:
    """One point has |F_S| = 1 at every shift."""
    values = ((count, ONE), (alpha, sympy.Lambda(k, ZERO)))
    there = IN_THE_DISC.at(*values)
    sums = [sympy.Sum(f(2 * pi * u), (k, 1, 1)) for f in (cos, sin)]
    terms = [Step(Claim(s, "=", s.function), by.Range()) for s in sums]
    uses = ((s + s.function, step) for s, step in zip(sums, terms, strict=True))
    square = combine(Claim(there.left.function, "=", ONE), *uses)
    one = sympy.Integral(ONE, (u, 0, 1))
    size = Step(Claim(one, "=", ONE), by.Antiderivative(u))
    mean = Step(Claim(there.left, "=", one), by.Bind(), (square, size))
    more = combine(Claim(half, "<", there.left), (-1, mean), (-1, size), remainder=half)
    return Step(replace(IN_THE_DISC, false=True), by.Counterexample(values), (more,))


def _unnormalised() -> Claim:
    exact = over_shifts().claim
    return Claim(exact.left, "=", over(k, K, a(k) ** 2 / 2 * N * power(HERE)), POINTS)


UNNORMALISED = _unnormalised()
"""The variance with Σ_j exp(−2πi m·s_j) for F_S and 1/N once."""


@cache
def one_over_n_twice() -> Step:
    """Two points at 0 and f = cos 2πx: 1/2 and not 1."""
    constant = sympy.Lambda(k, ONE), sympy.Lambda(tuple(HERE.args), ZERO)
    values = ((K, ONE), (N, TWO), (M, TWO + 1), (a, constant[0]), (phase, constant[1]))
    there, exact = UNNORMALISED.at(*values), over_shifts().claim.at(*values)
    known = Step(Claim(exact.left, "=", exact.right), by.Instance(values), (over_shifts(),))
    gap = Step(Claim(exact.right, "<", there.right), by.Interval())
    less = combine(Claim(there.left, "<", there.right), (1, known), (1, gap))
    return Step(replace(UNNORMALISED, false=True), by.Counterexample(values), (less,))


EVERYWHERE = Claim(1 + (count - 1) * blur(nu, ONE), "=", ONE, (*sizes(count), *positive(nu)))
"""N P_S of independent points in [0, 1] at any real frequency, as printed."""


@cache
def not_between_whole_frequencies() -> Step:
    """At N = 2, ν = 1/2 it is 1 + 4/π²."""
    values = ((count, TWO), (nu, half))
    there = EVERYWHERE.at(*values)
    at = (*values[1:], (strata.n, ONE))
    moved = uniform_place().claim.at(*at)
    known = Step(Claim(moved.left, "=", moved.right), by.Instance(at), (uniform_place(),))
    above = combine(Claim(ONE, "<", there.left), (-1, known), remainder=sinc2(half))
    return Step(replace(EVERYWHERE, false=True), by.Counterexample(values), (above,))


_INDEX = (*whole(k), Claim(ONE, "<=", k))
BOUNDED = (
    Claim(spectrum(k), "<=", gamma / count, _INDEX, over=(k,)),
    Claim(ZERO, "<=", integrand(k), _INDEX, over=(k,)),
)


@cache
def bounded_spectrum() -> Step:
    """Σ P_S P_f <= (γ/N) Σ P_f."""
    given = (*BOUNDED, *sizes(count), *whole(K), Claim(ONE, "<=", K))
    inside = (*given, *_INDEX, Claim(k, "<=", K))
    here = [Step(Claim(c.left, "<=", c.right, inside), by.Given()) for c in BOUNDED]
    large = combine(Claim(ZERO, "<", count, given),
                    (1, Step(Claim(ONE, "<=", count, given), by.Given())), remainder=1)  # fmt: skip
    share = gamma / count
    point = combine(
        Claim(spectrum(k) * integrand(k), "<=", share * integrand(k), inside),
        (integrand(k), here[0]), (0, here[1]), (0, large),
    )  # fmt: skip
    sums = [sympy.Sum(s, (k, 1, K)) for s in (point.claim.left, point.claim.right)]
    bound = Step(Claim(sums[0], "<=", sums[1], given), by.Bind(), (point, large))
    value = share * sympy.Sum(integrand(k), (k, 1, K))
    scale = Step(Claim(sums[1], "=", value, given), by.Linear(((share, integrand(k)),)), (large,))
    return combine(Claim(sums[0], "<=", value, given), (1, bound), (1, scale), (0, large))


SQUARE = Claim(sympy.Integral((x**-half) ** 2, (x, 1 / h, 1)), "O", ONE, (Claim(ONE, "<", h),), h)
"""∫ f² of the integrable f = x^(−1/2) is bounded."""


@cache
def integrable_is_not_enough() -> Step:
    """∫_{1/h}^1 dx/x = log h."""
    given = SQUARE.given
    below = combine(Claim(ZERO, "<=", 1 - 1 / h, given),
                    (1 / h, Step(Claim(ONE, "<", h, given), by.Given())))  # fmt: skip
    size = Step(
        Claim(SQUARE.left, "=", sympy.log(h), given), by.Antiderivative(sympy.log(x)), (below,)
    )
    grows = Step(Claim(sympy.log(h), "->", sympy.oo, given, h), by.Limit(((ONE, ZERO, ZERO, 1),)))
    limit = transferred(size, grows)
    return Step(replace(SQUARE, false=True), by.Counterexample(()), (limit,))


RIDGE = Claim(
    4 * (2 * pi / m) * r, "->", (1 - sinc2(1 / count)) / (2 * count),
    (*whole(count), Claim(TWO, "<=", count), *positive(r, m)), m,
)  # fmt: skip
"""Eq. 9 at cos 2πx under a Latin hypercube of the plane: 4 of m directions with a radial r each."""


@cache
def ridge_has_no_weight() -> Step:
    """The 4 axes among m directions have weights 2π/m: 0 in the limit, and the variance is not."""
    values = ((count, TWO), (r, ONE))
    there = RIDGE.at(*values)
    given = positive(m)
    none = limit_of_powers(there.left, [(8 * pi, -ONE)], m, given, ZERO)
    return Step(replace(RIDGE, false=True), by.Counterexample(values), (none,))
