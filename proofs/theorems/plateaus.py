"""Flat parts of spectra: Latin hypercubes and uncorrelated jitter across axes and blocks.

With shares 0 <= a(i) <= 1, sinc²(m_i/N) of the axes or ∏ sinc² of the blocks in which m is not 0,

    N P_S = 1 + (N − 1) ∏_{i=1}^w (−a(i)/(N − 1)),      (N P_S − 1)² <= (N − 1)^(2 − 2w),

by induction on w. For w >= 2 this is flat up to 1/(N − 1), and for w = 2 not below random sampling:
N P_S = 1 + a(1) a(2)/(N − 1). A wave cos 2πx cos 2πy has then

    1/4 <= N Var <= 1/2,

while a wave cos 2πmx along an axis has Var = (1/(2N)) (1 − sinc²(m/N)), of order N^−3.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .jitter_bounds import (
    INDEX,
    SIZE,
    a,
    i,
    last_terms,
    n,
    peeled,
    said,
    sinc_square_from_above,
    size,
)
from .products import UNIT, sinc_square
from .sines import jitter_envelope, x
from .tactics import ONE, ZERO, combine, positive, real, whole

N, m, m2, s1, s2 = real("N m m_2 s_1 s_2")
TWO = sympy.Integer(2)
MANY = (Claim(TWO, "<=", N), *positive(N - 1, N))
"""2 <= N, and the signs of N − 1 and N by themselves, so that they are seen at once."""


def crossing(last: Expr, share: Expr | None = None) -> Expr:
    """∏ (−a(i)/(N − 1)), i = 1, ..., last."""
    return sympy.Product(-(a(i) if share is None else share) / (N - 1), (i, 1, last))


@cache
def crossing_square() -> Step:
    """(∏ (−a(i)/(N − 1)))² <= (N − 1)^(−2w)."""
    claim = Claim(crossing(n) ** 2, "<=", (N - 1) ** (-2 * n), (*UNIT, *SIZE, *MANY))
    empty = Step(Claim(crossing(ZERO), "=", ONE, (*UNIT, *MANY)), by.Range())
    base = combine(
        Claim(crossing(ZERO) ** 2, "<=", (N - 1) ** ZERO, (*UNIT, *MANY)),
        (crossing(ZERO) + 1, empty),
    )
    assumed = (*UNIT, *SIZE, *MANY, Claim(claim.left, "<=", claim.right))
    low, high = last_terms(UNIT, assumed)
    head, longer, next_a = crossing(n), crossing(n + 1), a(n + 1)
    cut, last = peeled(longer, assumed)
    both, tail = longer + head * last.claim.left, last.claim.left - next_a / (N - 1)
    step = combine(
        Claim(longer**2, "<=", (N - 1) ** (-2 * (n + 1)), assumed),
        (both, cut), (head**2 * tail, last),
        ((N - 1) ** -2, said(assumed, assumed[-1])),
        (head**2 * (1 + next_a) / (N - 1) ** 2, high), (0, low),
    )  # fmt: skip
    return Step(claim, by.Induction(n, ZERO), (base, step))


@cache
def flat_across() -> Step:
    """(N P_S − 1)² <= (N − 1)^(2 − 2w) for shares in [0, 1]."""
    power = 1 + (N - 1) * crossing(n)
    claim = Claim((power - 1) ** 2, "<=", (N - 1) ** (2 - 2 * n), (*UNIT, *SIZE, *MANY))
    return combine(claim, ((N - 1) ** 2, crossing_square()))


_SHARES = tuple(h for s in (s1, s2) for h in (Claim(ZERO, "<=", s), Claim(s, "<=", ONE)))
PAIR = 1 + (N - 1) * (-s1 / (N - 1)) * (-s2 / (N - 1))
"""N P_S where two axes or blocks are crossed."""


@cache
def not_below_random() -> Step:
    """1 <= N P_S at w = 2."""
    claim = Claim(ONE, "<=", PAIR, (*_SHARES, *MANY))
    return combine(claim, remainder=s1 * s2 / (N - 1))


def wave_share() -> Expr:
    """sinc²(1/N)."""
    return sinc_square(1 / N)


def _share_bounds(u: Expr, given: tuple[Claim, ...]) -> tuple[Step, Step]:
    """0 <= sinc²(u) <= 1, for u > 0."""
    share = sinc_square(u)
    moved = Step(
        Claim((1 + size(u)) * share, "<=", ONE, given), by.Instance(((x, u),)),
        (sinc_square_from_above(),),
    )  # fmt: skip
    low = combine(Claim(ZERO, "<=", share, given), remainder=share)
    return low, combine(Claim(share, "<=", ONE, given), (1, moved), remainder=size(u) * share)


ACROSS = PAIR.xreplace({s1: wave_share(), s2: wave_share()}) / (4 * N)
"""Var of cos 2πx cos 2πy under a Latin hypercube: four frequencies of power 1/16."""


@cache
def wave_across() -> Step:
    """Θ(1/N), between 1/(4N) and 1/(2N)."""
    low, high = _share_bounds(1 / N, MANY)
    share = wave_share()
    below = combine(Claim(1 / (4 * N), "<=", ACROSS, MANY), remainder=share**2 / (4 * N * (N - 1)))
    square = combine(Claim(share**2, "<=", ONE, MANY), (1 + share, high), (0, low))
    above = combine(
        Claim(ACROSS, "<=", 1 / (2 * N), MANY),
        (1 / (4 * N * (N - 1)), square), (1 / (4 * N * (N - 1)), said(MANY, MANY[0])),
    )  # fmt: skip
    quarter, half = sympy.Rational(1, 4), sympy.Rational(1, 2)
    claim = Claim(ACROSS, "Theta", 1 / N, MANY, N)
    return Step(claim, by.Order((quarter, half)), (below, above))


ALONG = (1 - sinc_square(m / N)) / (2 * N)
"""Var of cos 2πmx where its axis is jittered with N strata."""
_WAVE = (*positive(m, N), Claim(ONE, "<", N))


@cache
def wave_along() -> Step:
    """Θ(N^−3): between y/(2N(1 + y)) and y/(2N), y = π²m²/(3N²)."""
    u, y = m / N, size(m / N)
    over = Step(
        Claim((1 + y) * sinc_square(u), "<=", ONE, _WAVE), by.Instance(((x, u),)),
        (sinc_square_from_above(),),
    )  # fmt: skip
    under = Step(
        Claim(1 - sinc_square(u), "<=", y, _WAVE), by.Instance(((x, u),)), (jitter_envelope(),)
    )
    full = size(m)
    low, high = full / (2 * (1 + full)), full / 2
    wide = combine(Claim(ONE, "<=", N**2, _WAVE), (N + 1, said(_WAVE, _WAVE[-1])))
    drop = combine(
        Claim(y / (1 + full), "<=", y / (1 + y), _WAVE),
        (full * y / ((1 + full) * (1 + y) * N**2), wide),
    )
    below = combine(
        Claim(low * N**-3, "<=", ALONG, _WAVE), (1 / (2 * N), drop), (1 / (2 * N * (1 + y)), over)
    )
    above = combine(Claim(ALONG, "<=", high * N**-3, _WAVE), (1 / (2 * N), under))
    return Step(Claim(ALONG, "Theta", N**-3, _WAVE, N), by.Order((low, high)), (below, above))


FLAT = Claim(
    PAIR.xreplace({s1: sinc_square(m / N), s2: sinc_square(m2 / N)}), "=", ONE,
    (*positive(m, m2), *whole(m, m2, N), *MANY),
)  # fmt: skip
"""Off the axes a Latin hypercube in 2D has the power of random samples, N P_S = 1."""


@cache
def not_flat() -> Step:
    """At N = 2 and m = (1, 1), N P_S = 1 + 16/π⁴."""
    values = ((N, TWO), (m, ONE), (m2, ONE))
    there = FLAT.at(*values)
    more = combine(Claim(there.right, "<", there.left), remainder=16 / sympy.pi**4)
    return Step(replace(FLAT, false=True), by.Counterexample(values), (more,))


@cache
def lhs_flat_across() -> Step:
    """(N P_S − 1)² <= (N − 1)^(2 − 2w) for a Latin hypercube, frequencies m_i > 0."""
    mode = sympy.Function("m")
    apart = Claim(ZERO, "<", mode(i), INDEX, over=(i,))
    inside, given = (apart, *INDEX, *MANY), (apart, *SIZE, *MANY)
    there = said((apart, *INDEX), apart)
    share = sinc_square(mode(i) / N)
    moved = Step(
        Claim((1 + size(mode(i) / N)) * share, "<=", ONE, inside),
        by.Instance(((x, mode(i) / N),)), (sinc_square_from_above(), there),
    )  # fmt: skip
    low = combine(Claim(ZERO, "<=", share, inside), (0, there), remainder=share)
    high = combine(
        Claim(share, "<=", ONE, inside), (1, moved), (0, there),
        remainder=size(mode(i) / N) * share,
    )  # fmt: skip
    power = 1 + (N - 1) * crossing(n, share)
    claim = Claim((power - 1) ** 2, "<=", (N - 1) ** (2 - 2 * n), given)
    values = ((a, sympy.Lambda(i, share)),)
    return Step(claim, by.Instance(values), (flat_across(), low, high))
