"""Sums over frequencies that lattice rates need: telescoping tails, counts, and harmonic numbers.

    Σ_{m=K+1}^∞ 1/(m(m − 1)) = 1/K,    Σ_{m>K} m^−2 <= 1/K,    Σ_{m>=1} m^−2 <= 2,
    Σ_{m=1}^N 1 = N,    log N <= Σ_{m=1}^N 1/m <= 1 + log N.

The tail is 1/K − 1/M up to M by induction; the harmonic numbers come from 1 − 1/x <= log x <= x − 1
at x = (n + 1)/n and (n + 2)/(n + 1).
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .jitter_bounds import said
from .tactics import ONE, ZERO, chain, combine, limit_of_powers, positive, real, whole

m, K, M, N, z = real("m K M N z")
log = sympy.log
FROM_K = (*whole(K), Claim(ONE, "<=", K), *positive(K))
INDEX = (*whole(m), Claim(ONE, "<=", m), *positive(m))
_STEP = 1 / (m * (m - 1))


def total(f: Expr, low: Expr | int, high: Expr) -> Expr:
    """Σ f, m = low, ..., high."""
    return sympy.Sum(f, (m, low, high))


def taken_apart(f: Expr, low: Expr | int, at: Expr, given: tuple[Claim, ...]) -> tuple[Step, Step]:
    """A sum to at + 1 as the sum to ``at`` and its last term."""
    ends = total(f, low, at), total(f, at + 1, at + 1)
    cut = Step(Claim(total(f, low, at + 1), "=", sum(ends), given), by.Range(at))
    return cut, Step(Claim(ends[1], "=", f.xreplace({m: at + 1}), given), by.Range())


@cache
def telescoped() -> Step:
    """Σ_{m=K+1}^M 1/(m(m − 1)) = 1/K − 1/M."""
    size = (*FROM_K, *whole(M), Claim(K, "<=", M))
    claim = Claim(total(_STEP, K + 1, M), "=", 1 / K - 1 / M, size)
    base = Step(Claim(total(_STEP, K + 1, K), "=", ZERO, FROM_K), by.Range())
    empty = chain(Claim(base.claim.left, "=", 1 / K - 1 / K, FROM_K), base)
    assumed = (*size, Claim(claim.left, "=", claim.right))
    large = combine(Claim(ZERO, "<", M, assumed), (1, said(assumed, size[-1])), remainder=K)
    step = combine(
        Claim(total(_STEP, K + 1, M + 1), "=", 1 / K - 1 / (M + 1), assumed),
        *((1, s) for s in taken_apart(_STEP, K + 1, M, assumed)),
        (1, said(assumed, assumed[-1])), (0, large),
    )  # fmt: skip
    return Step(claim, by.Induction(M, K), (empty, step))


@cache
def telescoped_tail() -> Step:
    """Σ_{m=K+1}^∞ 1/(m(m − 1)) = 1/K."""
    inside = (*FROM_K, Claim(K + 1, "<=", M), *positive(M), *whole(M))
    found = telescoped()
    value = 1 / K - 1 / M
    limit = limit_of_powers(value, [(1 / K, ZERO), (-ONE, -ONE)], M, inside, 1 / K)
    claim = Claim(found.claim.left, "->", 1 / K, inside, M)
    proper = Step(Claim(found.claim.left, "=", value, inside), by.Instance(()), (found,))
    reached = Step(claim, by.Squeeze(), (proper, limit))
    whole_ = Claim(total(_STEP, K + 1, sympy.oo), "=", 1 / K, FROM_K)
    return Step(whole_, by.Improper(), (reached,))


def tail(
    f: Expr, points: tuple[Step, ...], given: tuple[Claim, ...], start: Expr, scale: Expr
) -> Step:
    """Σ_{m>K} f <= scale/K at K = ``start``; ``points`` say f <= scale/(m(m − 1)), and 0 <= f."""
    bound = scale * _STEP
    sums = total(f, start + 1, sympy.oo), total(bound, start + 1, sympy.oo)
    moved = Step(
        Claim(total(_STEP, start + 1, sympy.oo), "=", 1 / start, given),
        by.Instance(((K, start),)), (telescoped_tail(),),
    )  # fmt: skip
    reason = by.Linear(((scale, _STEP),))
    scaled = Step(Claim(sums[1], "=", scale * moved.claim.left, given), reason, (moved,))
    rows = Step(Claim(*sums[:1], "<=", sums[1], given), by.Bind(), (*points, scaled))
    return combine(
        Claim(sums[0], "<=", scale / start, given), (1, rows), (1, scaled), (scale, moved)
    )


@cache
def counted() -> Step:
    """Σ_{m=1}^N 1 = N."""
    size = (*whole(N), Claim(ZERO, "<=", N))
    base = Step(Claim(total(ONE, 1, ZERO), "=", ZERO), by.Range())
    assumed = (*size, Claim(total(ONE, 1, N), "=", N))
    step = combine(
        Claim(total(ONE, 1, N + 1), "=", N + 1, assumed),
        *((1, s) for s in taken_apart(ONE, 1, N, assumed)), (1, said(assumed, assumed[-1])),
    )  # fmt: skip
    return Step(Claim(total(ONE, 1, N), "=", N, size), by.Induction(N, ZERO), (base, step))


@cache
def logarithm_from_below() -> Step:
    """1 − 1/z <= log z for z >= 1."""
    given = (Claim(ONE, "<=", z),)
    far = (Claim(ONE, "<", z),)
    slope = combine(Claim(ZERO, "<=", 1 / z - 1 / z**2, far), (z**-2, said(far, far[0])))
    f = log(z) - 1 + 1 / z
    return Step(Claim(ZERO, "<=", f, given), by.Monotone(z, ONE), (slope,))


@cache
def logarithm_from_above() -> Step:
    """log z <= z − 1 for z >= 1."""
    given = (Claim(ONE, "<=", z),)
    far = (Claim(ONE, "<", z),)
    slope = combine(Claim(ZERO, "<=", 1 - 1 / z, far), (1 / z, said(far, far[0])))
    return Step(Claim(ZERO, "<=", z - 1 - log(z), given), by.Monotone(z, ONE), (slope,))


_COUNT = (*whole(N), Claim(ONE, "<=", N), *positive(N))
HARMONIC = total(1 / m, 1, N)


def _at_ratio(lemma: Step, top: Expr, bottom: Expr, given: tuple[Claim, ...]) -> Step:
    """The lemma at z = top/bottom >= 1, its logarithm taken apart."""
    right = lemma.claim.right.xreplace({z: top / bottom})
    right = right.xreplace({log(top / bottom): log(top) - log(bottom)})
    return Step(Claim(ZERO, "<=", right, given), by.Instance(((z, top / bottom),)), (lemma,
                _ratio(top, bottom, given)))  # fmt: skip


def _ratio(top: Expr, bottom: Expr, given: tuple[Claim, ...]) -> Step:
    return combine(Claim(ONE, "<=", top / bottom, given), remainder=1 / bottom)


def _harmonic(claim: Claim, lemma: Step, ratio: tuple[Expr, Expr], base: Step) -> Step:
    """Induction on N with the logarithm's bound at the ratio."""
    assumed = (*_COUNT, Claim(claim.left, "<=", claim.right))
    grown = claim.at((N, N + 1))
    sign = 1 if claim.left == HARMONIC else -1
    step = combine(
        Claim(grown.left, "<=", grown.right, assumed),
        *((sign, s) for s in taken_apart(1 / m, 1, N, assumed)),
        (1, said(assumed, assumed[-1])), (1, _at_ratio(lemma, *ratio, assumed)),
    )  # fmt: skip
    return Step(claim, by.Induction(N, ONE), (base, step))


def _first() -> Step:
    return Step(Claim(total(1 / m, 1, ONE), "=", ONE), by.Range())


@cache
def harmonic_from_above() -> Step:
    """Σ 1/m <= 1 + log N."""
    claim = Claim(HARMONIC, "<=", 1 + log(N), _COUNT)
    base = combine(Claim(total(1 / m, 1, ONE), "<=", 1 + log(ONE)), (1, _first()))
    return _harmonic(claim, logarithm_from_below(), (N + 1, N), base)


@cache
def harmonic_from_below() -> Step:
    """log N <= Σ 1/m, from log (N + 1) <= Σ 1/m."""
    claim = Claim(log(N + 1), "<=", HARMONIC, _COUNT)
    two = Step(
        Claim(ZERO, "<=", 1 - log(sympy.Integer(2))), by.Instance(((z, sympy.Integer(2)),)),
        (logarithm_from_above(),),
    )  # fmt: skip
    base = combine(Claim(log(ONE + 1), "<=", total(1 / m, 1, ONE)), (-1, _first()), (1, two))
    more = _harmonic(claim, logarithm_from_above(), (N + 2, N + 1), base)
    rises = _at_ratio(logarithm_from_below(), N + 1, N, _COUNT)
    return combine(Claim(log(N), "<=", HARMONIC, _COUNT), (1, more), (1, rises),
                   remainder=1 / (N + 1))  # fmt: skip


@cache
def squares() -> Step:
    """Σ_{m>=1} m^−2 <= 2."""
    given = (*INDEX, Claim(sympy.Integer(2), "<=", m), *positive(m - 1))
    f = m**-2
    point = combine(Claim(f, "<=", _STEP, given), remainder=1 / (m**2 * (m - 1)))
    rest = tail(f, (point,), (), ONE, ONE)
    ends = total(f, 1, 1), total(f, 2, sympy.oo)
    cut = Step(Claim(total(f, 1, sympy.oo), "=", sum(ends), ()), by.Range(ONE), (rest,))
    first = Step(Claim(ends[0], "=", ONE, ()), by.Range())
    return combine(
        Claim(total(f, 1, sympy.oo), "<=", sympy.Integer(2)), (1, cut), (1, first), (1, rest)
    )
