"""Sums of waves over strata, and the exact spectra that come of them, for every N and dimension.

With θ such that sin(θ/2) ≠ 0, by induction on M,

    Σ_{j=0}^{M} cos θ(j − k) = [sin θ(M + 1/2 − k) + sin θ(1/2 + k)] / (2 sin(θ/2)),

which at θ = 2πm/N and M = N − 1 is 0 unless N divides m. Summed over k it says that the strata of
an axis, left to themselves, show no power at m. Two points of different strata of one axis,
uniform in their strata, have the characteristic function

    q(m) = [Σ_j Σ_k cos(2πm (j − k)/N) − N] sinc²(m/N) / (N (N − 1)) = −sinc²(m/N)/(N − 1),

and a Latin hypercube, whose axes are independent of each other, has (paper, Sec. 6.2)

    P_S(m) = 1/N + (1 − 1/N) ∏ q(m_i) = (1/N) [1 + (N − 1) ∏ (−sinc²(m_i/N)/(N − 1))].
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .tactics import ONE, ZERO, chain, combine, real, whole

j, k, i, M, N, m, d, theta = real("j k i M N m d theta")
pi, sin, cos = sympy.pi, sympy.sin, sympy.cos
half = sympy.Rational(1, 2)
mode = sympy.Function("m")


def wave_sum(last: Expr, angle: Expr = theta) -> Expr:
    """Σ_{j=0}^{last} cos angle (j − k)."""
    return sympy.Sum(cos(angle * (j - k)), (j, 0, last))


def _closed(last: Expr) -> Expr:
    ends = sin(theta * (last + half - k)) + sin(theta * (half + k))
    return ends / (2 * sin(theta / 2))


@cache
def dirichlet() -> Step:
    """The sum of waves over j."""
    apart = Claim(sin(theta / 2), "!=", ZERO)
    size = (*whole(M), Claim(ZERO, "<=", M))
    claim = Claim(wave_sum(M), "=", _closed(M), (apart, *size))
    base = chain(
        Claim(wave_sum(ZERO), "=", _closed(ZERO), (apart,)),
        Step(Claim(wave_sum(ZERO), "=", cos(theta * k), (apart,)), by.Range()),
    )
    given = (apart, *size, Claim(wave_sum(M), "=", _closed(M)))
    last = sympy.Sum(cos(theta * (j - k)), (j, M + 1, M + 1))
    step = chain(
        Claim(wave_sum(M + 1), "=", _closed(M + 1), given),
        Step(Claim(wave_sum(M + 1), "=", wave_sum(M) + last, given), by.Range(M)),
        Step(Claim(last, "=", cos(theta * (M + 1 - k)), given), by.Range()),
        Step(Claim(wave_sum(M), "=", _closed(M), given), by.Given()),
    )
    return Step(claim, by.Induction(M, ZERO), (base, step))


def strata() -> tuple[Claim, ...]:
    """N strata and a whole frequency that N does not divide."""
    numbers = (*whole(N, m), Claim(sympy.Integer(2), "<=", N))
    return (*numbers, Claim(sin(pi * m / N), "!=", ZERO))


def all_pairs(frequency: Expr) -> Expr:
    """Σ_k Σ_j cos(2π frequency (j − k)/N) over all strata."""
    return sympy.Sum(wave_sum(N - 1, 2 * pi * frequency / N), (k, 0, N - 1))


@cache
def no_power_in_strata() -> Step:
    """The sum over all pairs of strata is 0."""
    given, angle = strata(), 2 * pi * m / N
    inside = (*given, *whole(k), Claim(ZERO, "<=", k), Claim(k, "<=", N - 1))
    closed = _closed(N - 1).xreplace({theta: angle})
    row = Step(
        Claim(wave_sum(N - 1, angle), "=", closed, inside),
        by.Instance(((theta, angle), (M, N - 1))), (dirichlet(),),
    )  # fmt: skip
    vanishes = chain(Claim(wave_sum(N - 1, angle), "=", ZERO, inside), row)
    nothing = sympy.Sum(ZERO, (k, 0, N - 1))
    rows = Step(Claim(all_pairs(m), "=", nothing, given), by.Bind(), (vanishes,))
    empty = Step(Claim(nothing, "=", ZERO, given), by.Linear(()))
    return chain(Claim(all_pairs(m), "=", ZERO, given), rows, empty)


def sinc_square(frequency: Expr) -> Expr:
    """sinc²(frequency/N)."""
    return sin(pi * frequency / N) ** 2 / (pi * frequency / N) ** 2


def pair(frequency: Expr) -> Expr:
    """q(m) of two points of different strata, as the mean over pairs of strata."""
    return (all_pairs(frequency) - N) * sinc_square(frequency) / (N * (N - 1))


@cache
def jitter_on_an_axis() -> Step:
    """Jitter in 1D: P_S = [N + Σ_{j ≠ k} cos(2πm (j − k)/N) sinc²(m/N)]/N² = (1 − sinc²(m/N))/N."""
    given = (*strata(), Claim(m, "!=", ZERO))
    printed = 1 / N + (all_pairs(m) - N) * sinc_square(m) / N**2
    claim = Claim(printed, "=", (1 - sinc_square(m)) / N, given)
    return combine(claim, (sinc_square(m) / N**2, no_power_in_strata()))


@cache
def latin_hypercube() -> Step:
    """The spectrum where N divides no coordinate of m, in any dimension."""
    index = (*whole(i), Claim(ONE, "<=", i), Claim(i, "<=", d))
    about = (
        Claim(mode(i), "whole", ZERO, index, over=(i,)),
        Claim(mode(i), "!=", ZERO, index, over=(i,)),
        Claim(sin(pi * mode(i) / N), "!=", ZERO, index, over=(i,)),
    )
    given = (*about, *whole(N, d), Claim(sympy.Integer(2), "<=", N), Claim(ONE, "<=", d))
    inside = (*given, *index)
    facts = [Step(Claim(h.left, h.relation, h.right, inside), by.Given()) for h in about]
    rows = Step(
        Claim(all_pairs(mode(i)), "=", ZERO, inside),
        by.Instance(((m, mode(i)),)), (no_power_in_strata(), *facts),
    )  # fmt: skip
    alone, scale = -sinc_square(mode(i)) / (N - 1), sinc_square(mode(i)) / (N * (N - 1))
    factor = combine(
        Claim(pair(mode(i)), "=", alone, inside), (scale, rows), *((0, f) for f in facts[1:2])
    )
    pairs, shares = (sympy.Product(f, (i, 1, d)) for f in (pair(mode(i)), alone))
    axes = Step(Claim(pairs, "=", shares, given), by.Bind(), (factor,))
    claim = Claim(1 / N + (1 - 1 / N) * pairs, "=", (1 + (N - 1) * shares) / N, given)
    return combine(claim, (1 - 1 / N, axes))
