"""The variance of the randomly shifted estimator as a sum over frequencies (paper, Eq. 4).

For f = I + Σ_k a_k cos(2πm_k·x + α_k), k = 1, ..., K, points s_j and phases p_kj = 2πm_k·s_j + α_k,

    I_N − I = (1/N) Σ_j Σ_k a_k cos(p_kj + 2πkt/M)             at the shift t/M,
            = Σ_k a_k (C_k cos 2πkt/M − S_k sin 2πkt/M)        in the frequency domain (Eq. 3),
    C_k = (1/N) Σ_j cos p_kj,   S_k = (1/N) Σ_j sin p_kj,   C_k² + S_k² = |F_S(m_k)|² = P_S(m_k),

has mean 0 over the shifts, and with realisations ω of probability w_ω the variance

    Σ_ω w_ω (1/M) Σ_t (I_N − I)² = Σ_k (a_k²/2) Σ_ω w_ω P_S(m_k, ω) = Σ_{m ≠ 0} E P_S(m) |f^(m)|².
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .shifts import (
    ENOUGH,
    A,
    B,
    K,
    M,
    N,
    W,
    a,
    cos,
    exchanged,
    full_turns,
    instance,
    j,
    k,
    parseval,
    phase,
    pi,
    q,
    sin,
    t,
    w,
    weight,
)
from .strata import sizes
from .tactics import ONE, ZERO, chain, combine, whole

POINTS = (*ENOUGH, *sizes(N))
_MODE = (*whole(k), Claim(ONE, "<=", k), Claim(k, "<=", K))
_SHIFT = (*whole(t), Claim(ONE, "<=", t), Claim(t, "<=", M))
_TURN = 2 * pi * k * t / M


def over(index: Expr, last: Expr, term: Expr) -> Expr:
    """Σ term, index = 1, ..., last."""
    return sympy.Sum(term, (index, 1, last))


def error(here: Expr) -> Expr:
    """I_N − I at the shift t/M; ``here`` is the phase p_kj."""
    return over(j, N, over(k, K, a(k) * cos(here + _TURN))) / N


def even(here: Expr) -> Expr:
    """C_k."""
    return over(j, N, cos(here)) / N


def odd(here: Expr) -> Expr:
    """S_k."""
    return over(j, N, sin(here)) / N


def power(here: Expr) -> Expr:
    """P_S(m_k) of one realisation."""
    return (over(j, N, cos(here)) ** 2 + over(j, N, sin(here)) ** 2) / N**2


HERE = phase(k, j)
_VALUES = (
    (A, sympy.Lambda(k, a(k) * even(HERE))),
    (B, sympy.Lambda(k, a(k) * odd(HERE))),
)


def _size(given: tuple[Claim, ...]) -> Step:
    """0 < N."""
    least = Step(Claim(ONE, "<=", N, given), by.Given())
    return combine(Claim(ZERO, "<", N, given), (1, least), remainder=1)


@cache
def frequency_domain() -> Step:
    """I_N − I = Σ_k a_k (C_k cos 2πkt/M − S_k sin 2πkt/M)."""
    given = (*POINTS, *whole(t))
    inside = (*given, *_MODE)
    term = a(k) * cos(HERE + _TURN)
    swapped = exchanged(term, j, N, k, given)
    parts = ((a(k) * cos(_TURN), cos(HERE)), (-a(k) * sin(_TURN), sin(HERE)))
    total = sympy.Add(*(c * over(j, N, f) for c, f in parts))
    mode = Step(Claim(over(j, N, term), "=", total, inside), by.Linear(parts))
    waves = a(k) * even(HERE) * cos(_TURN) - a(k) * odd(HERE) * sin(_TURN)
    scaled = combine(Claim(over(j, N, term), "=", N * waves, inside), (1, mode), (0, _size(inside)))
    modes = Step(
        Claim(swapped.claim.right, "=", over(k, K, N * waves), given), by.Bind(), (scaled,)
    )
    out = Step(
        Claim(over(k, K, N * waves), "=", N * over(k, K, waves), given), by.Linear(((N, waves),)),
        (_size(given),),
    )  # fmt: skip
    claim = Claim(error(HERE), "=", over(k, K, waves), given)
    return combine(claim, (1 / N, swapped), (1 / N, modes), (1 / N, out), (0, _size(given)))


def _moved(step: Step, given: tuple[Claim, ...]) -> Step:
    return instance(step, given, *_VALUES, uses=(_size(given),))


@cache
def over_shifts() -> Step:
    """(1/M) Σ_t (I_N − I)² = Σ_k (a_k²/2) P_S(m_k) for one realisation of the points."""
    inside, domain = (*POINTS, *_SHIFT), frequency_domain()
    left, right = domain.claim.left, domain.claim.right
    square = combine(
        Claim(left**2, "=", right**2, inside), (left + right, domain), (0, _size(inside))
    )
    total, waves = over(t, M, left**2), over(t, M, right**2)
    squares = Step(Claim(total, "=", waves, POINTS), by.Bind(), (square,))
    identity = _moved(parseval(), POINTS)
    mode = (*POINTS, *_MODE)
    sides = (a(k) * even(HERE)) ** 2 + (a(k) * odd(HERE)) ** 2, a(k) ** 2 * power(HERE)
    same = combine(Claim(*_equal(*sides), mode), (0, _size(mode)))
    powers = Step(
        Claim(over(k, K, sides[0]), "=", over(k, K, sides[1]), POINTS), by.Bind(), (same,)
    )
    share = a(k) ** 2 / 2 * power(HERE)
    halves = Step(
        Claim(over(k, K, share), "=", over(k, K, sides[1]) / 2, POINTS),
        by.Linear(((sympy.Rational(1, 2), sides[1]),)), (_size(POINTS),),
    )  # fmt: skip
    claim = Claim(total / M, "=", over(k, K, share), POINTS)
    half = sympy.Rational(1, 2)
    return combine(claim, (1 / M, squares), (1 / M, identity), (half, powers), (-1, halves))


def _equal(left: Expr, right: Expr):
    return left, "=", right


@cache
def unbiased() -> Step:
    """(1/M) Σ_t (I_N − I) = 0 for one realisation of the points."""
    inside, domain = (*POINTS, *_SHIFT), frequency_domain()
    left = over(t, M, domain.claim.left)
    errors = Step(
        Claim(left, "=", over(t, M, domain.claim.right), POINTS), by.Bind(),
        (instance(domain, inside),),
    )  # fmt: skip
    value = domain.claim.right.function
    swapped = exchanged(value, t, M, k, POINTS)
    mode = (*POINTS, *_MODE)
    bounds = _orders(mode)
    turns = [
        Step(Claim(over(t, M, f(_TURN)), "=", ZERO, mode), by.Instance(((q, k),)),
             (full_turns(f), *bounds))
        for f in (cos, sin)
    ]  # fmt: skip
    parts = ((a(k) * even(HERE), cos(_TURN)), (-a(k) * odd(HERE), sin(_TURN)))
    total = sympy.Add(*(c * over(t, M, f) for c, f in parts))
    split = Step(
        Claim(over(t, M, value), "=", total, mode), by.Linear(parts), (_size(mode), bounds[2])
    )
    none = combine(
        Claim(over(t, M, value), "=", ZERO, mode),
        (1, split), *((c, s) for (c, _), s in zip(parts, turns, strict=True)), (0, _size(mode)),
    )  # fmt: skip
    modes = Step(Claim(swapped.claim.right, "=", over(k, K, ZERO), POINTS), by.Bind(), (none,))
    empty = Step(Claim(over(k, K, ZERO), "=", ZERO, POINTS), by.Linear(()))
    uses = ((1 / M, s) for s in (errors, swapped, modes, empty))
    return combine(Claim(left / M, "=", ZERO, POINTS), *uses)


def _orders(given: tuple[Claim, ...]) -> tuple[Step, Step, Step]:
    """0 < k, k < M and 0 < M for a mode."""
    least, most, enough, shift = (
        Step(Claim(*c, given), by.Given())  # pyright: ignore
        for c in ((ONE, "<=", k), (k, "<=", K), (2 * K, "<", M), (ONE, "<=", M))
    )  # fmt: skip
    above = combine(Claim(ZERO, "<", k, given), (1, least), remainder=1)
    below = combine(Claim(k, "<", M, given), (1, enough), (2, most), (1, least), remainder=1)
    return above, below, combine(Claim(ZERO, "<", M, given), (1, shift), remainder=1)


@cache
def variance() -> Step:
    """Eq. 4 on the torus: over realisations ω = 1, ..., W of probability w_ω, and over shifts."""
    given = (*POINTS, *sizes(W))
    each = phase(w, k, j)
    inside = (*given, *whole(w), Claim(ONE, "<=", w), Claim(w, "<=", W))
    value = (phase, sympy.Lambda((k, j), each))
    one = instance(over_shifts(), inside, value, uses=(_size(inside),))
    scaled = combine(
        Claim(weight(w) * one.claim.left, "=", weight(w) * one.claim.right, inside),
        (weight(w), one), (0, _size(inside)),
    )  # fmt: skip
    share = a(k) ** 2 / 2 * power(each)
    inner = Step(
        Claim(over(k, K, weight(w) * share), "=", weight(w) * over(k, K, share), inside),
        by.Linear(((weight(w), share),)), (_size(inside),),
    )  # fmt: skip
    row = combine(
        Claim(scaled.claim.left, "=", inner.claim.left, inside), (1, scaled), (-1, inner),
        (0, _size(inside)),
    )  # fmt: skip
    rows = Step(
        Claim(over(w, W, row.claim.left), "=", over(w, W, row.claim.right), given), by.Bind(),
        (row,),
    )  # fmt: skip
    swapped = exchanged(weight(w) * share, w, W, k, given)
    mode = (*given, *_MODE)
    expected = weight(w) * power(each)
    out = Step(
        Claim(over(w, W, weight(w) * share), "=", a(k) ** 2 / 2 * over(w, W, expected), mode),
        by.Linear(((a(k) ** 2 / 2, expected),)), (_size(mode),),
    )  # fmt: skip
    modes = Step(
        Claim(swapped.claim.right, "=", over(k, K, out.claim.right), given), by.Bind(), (out,)
    )
    return chain(Claim(rows.claim.left, "=", modes.claim.right, given), rows, swapped, modes)
