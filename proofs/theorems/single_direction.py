"""One direction does not give the rate: a spectrum of degree 2 in every direction that misses it.

With directions θ in (0, 1] and the integrand's power 1 on 1 <= ρ <= 2,

    P_S = (1/N) ρ²/(ρ² + θ²N²),    V_θ = ∫_1^2 P_S dρ,    V = ∫_0^1 V_θ dθ,

has in every direction degree b = 2, N_k = N and a plateau 1/N, and V_θ <= 7/(3 θ² N³): every
direction falls as N^−3. But α_k = θ has no lower bound over the directions, and from θ >= 1/N alone
V >= 7 (N − 1)/(15 N³): the whole is not O(N^−3). (Against Sec. 6.1 and Appendix B of the paper.)
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .tactics import ONE, ZERO, chain, combine, limit_of_powers, positive, power_integral, real

N, theta, rho = real("N theta rho")
TWO = sympy.Integer(2)
POWER = rho**2 / (N * (rho**2 + theta**2 * N**2))
LARGE = (Claim(ONE, "<", N),)


def whole(integrand: Expr, low: Expr, high: Expr) -> Expr:
    """∫_low^high ∫_1^2 integrand dρ dθ."""
    return sympy.Integral(integrand, (rho, 1, 2), (theta, low, high))


def direction(integrand: Expr = POWER) -> Expr:
    """∫_1^2 integrand dρ."""
    return sympy.Integral(integrand, (rho, 1, 2))


VARIANCE = whole(POWER, ZERO, ONE)


@cache
def each_direction() -> Step:
    """V_θ = O(N^−3) for every θ > 0."""
    given = (*positive(theta), *LARGE)
    inside = (*given, Claim(ONE, "<", rho), Claim(rho, "<", TWO))
    above = rho**2 / (theta**2 * N**3)
    point = combine(Claim(POWER, "<=", above, inside), remainder=POWER * rho**2 / (theta * N) ** 2)
    bound = Step(Claim(direction(), "<=", direction(above), given), by.Bind(), (point,))
    size = power_integral(direction(above), [(1 / (theta**2 * N**3), TWO)], given)
    upper = sympy.Rational(7, 3) / theta**2 * N**-3
    at_most = chain(Claim(direction(), "<=", upper, given), bound, size)
    return Step(
        Claim(direction(), "O", N**-3, given, N),
        by.Order((sympy.Rational(7, 3) / theta**2,)),
        (at_most, _not_negative(direction(), given)),
    )


def _not_negative(integral: Expr, given: tuple[Claim, ...]) -> Step:
    """0 <= an integral of POWER over ρ."""
    inside = (*given, Claim(ONE, "<", rho), Claim(rho, "<", TWO))
    point = combine(Claim(ZERO, "<=", POWER, inside), remainder=POWER)
    nothing = direction(ZERO)
    bound = Step(Claim(nothing, "<=", integral, given), by.Bind(), (point,))
    none = Step(Claim(nothing, "=", ZERO, given), by.Linear(()))
    return combine(Claim(ZERO, "<=", integral, given), (1, bound), (-1, none))


@cache
def lower_bound() -> Step:
    """7 (N − 1)/(15 N³) <= V."""
    start = 1 / N
    parts = whole(POWER, ZERO, start), whole(POWER, start, ONE)
    inner = combine(Claim(start, "<=", ONE, LARGE), (start, _said(LARGE, LARGE[0])))
    cut = Step(Claim(VARIANCE, "=", parts[0] + parts[1], LARGE), by.Range(start), (inner,))
    near = (*LARGE, Claim(ZERO, "<", theta), Claim(theta, "<", start))
    zeros = sympy.Integral(ZERO, (theta, 0, start))
    first = Step(
        Claim(zeros, "<=", parts[0], LARGE), by.Bind(), (_not_negative(direction(), near),)
    )
    none = Step(Claim(zeros, "=", ZERO, LARGE), by.Linear(()))
    far = (*LARGE, Claim(start, "<", theta), Claim(theta, "<", ONE))
    row = _row_from_below(far)
    rows = sympy.Integral(row.claim.left, (theta, start, ONE))
    second = Step(Claim(rows, "<=", parts[1], LARGE), by.Bind(), (row, inner))
    size = power_integral(rows, [(sympy.Rational(7, 15) / N**3, -TWO)], LARGE, (inner,))
    claim = Claim(sympy.Rational(7, 15) * (N - 1) / N**3, "<=", VARIANCE, LARGE)
    return combine(claim, (-1, cut), (1, first), (-1, none), (1, second), (-1, size))


def _row_from_below(given: tuple[Claim, ...]) -> Step:
    """7/(15 θ² N³) <= V_θ where 1/N < θ: there ρ² <= 4 < 4 θ²N²."""
    inside = (*given, Claim(ONE, "<", rho), Claim(rho, "<", TWO))
    under = rho**2 / (5 * theta**2 * N**3)
    wide = combine(Claim(ONE, "<", theta * N, given), (N, _said(given, given[1])))
    square = combine(Claim(ONE, "<", (theta * N) ** 2, given), (theta * N + 1, wide))
    narrow = combine(
        Claim(rho**2, "<", sympy.Integer(4), inside), (rho + 2, _said(inside, inside[-1]))
    )
    slope = under / (rho**2 + theta**2 * N**2)
    point = combine(Claim(under, "<=", POWER, inside), (4 * slope, square), (slope, narrow))
    bound = Step(Claim(direction(under), "<=", direction(), given), by.Bind(), (point,))
    size = power_integral(direction(under), [(1 / (5 * theta**2 * N**3), TWO)], given)
    left = sympy.Rational(7, 15) / (theta**2 * N**3)
    return combine(Claim(left, "<=", direction(), given), (1, bound), (-1, size))


def _said(given: tuple[Claim, ...], hypothesis: Claim) -> Step:
    return Step(Claim(hypothesis.left, hypothesis.relation, hypothesis.right, given), by.Given())


PRINTED = Claim(VARIANCE, "O", N**-3, LARGE, N)


@cache
def refutation() -> Step:
    """V is not O(N^−3): N³ V is at least 7 (N − 1)/15."""
    below = combine(
        Claim(sympy.Rational(7, 15) * (N - 1), "<=", N**3 * VARIANCE, LARGE),
        (N**3, lower_bound()),
    )
    share = sympy.Rational(7, 15)
    grows = limit_of_powers(share * (N - 1), [(share, ONE), (-share, ZERO)], N, LARGE, sympy.oo)
    limit = Step(Claim(N**3 * VARIANCE, "->", sympy.oo, LARGE, N), by.Squeeze(), (below, grows))
    denial = Claim(VARIANCE, "O", N**-3, LARGE, N, false=True)
    return Step(denial, by.Counterexample(()), (limit,))
