"""Multi-jitter off its axes is jitter on both sides; correlated multi-jitter is not (Eq. 25).

With N = n², A = sinc²(a/n), p = sinc²(a/N), and B, q the same of the second coordinate, a, b ≠ 0,

    multi-jitter:             N P_S = 1 − [(n + 1) AB − pB − qA]/(n − 1),
    correlated multi-jitter:  N P_S = (1 − κ)(1 − λ) + κ (1 − q) + λ (1 − p),
                              κ = (nA − p)/(n − 1),   λ = (nB − q)/(n − 1).

Let u = (π²/3) a²/n², v = (π²/3) b²/n², Y = u + v. From (1 + u) A <= 1, 1 − A <= u, 1 − p <= u/n²
and the same of B and q follow, for n >= 2,

    multi-jitter:             Y/(8 (1 + Y)) <= N P_S <= 2Y,   N P_S <= n/(n − 1),
    correlated multi-jitter:  |N P_S| <= 4uv + 2 (u + v)/n²,

the bound from below in two cases, Y up to n + 1/2 and beyond. At a = b = 1 a wave cos 2πx cos 2πy,
Var = P_S/4, is of order N^−2 with multi-jitter, and O(N^−3) with correlated multi-jitter; but at
(n, 1), on a ridge, that has N P_S = 1 + A (n²A/(n − 1) − p) >= n (1 − 2u), with a = 1 in A, p, u.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .jitter_bounds import said, sinc_square_from_above, size
from .products import sinc_square
from .sines import jitter_envelope, x
from .tactics import ONE, ZERO, combine, limit_of_powers, positive, real

A, B, p, q, u, v, n = real("A B p q u v n")
a, b = real("a b")
TWO = sympy.Integer(2)
Y = u + v
POWER = 1 - ((n + 1) * A * B - p * B - q * A) / (n - 1)
"""N P_S of multi-jitter."""
GRID = (Claim(TWO, "<=", n), *positive(n - 1, n))
_LEVELS = (Claim(ZERO, "<=", u), Claim(ZERO, "<=", v))


def _between(*shares: Expr) -> tuple[Claim, ...]:
    return tuple(h for s in shares for h in (Claim(ZERO, "<=", s), Claim(s, "<=", ONE)))


SHARES = (
    *_between(A, B, p, q), *_LEVELS,
    Claim((1 + u) * A, "<=", ONE), Claim((1 + v) * B, "<=", ONE),
    Claim(1 - A, "<=", u), Claim(1 - B, "<=", v),
    Claim(1 - p, "<=", u / n**2), Claim(1 - q, "<=", v / n**2),
)  # fmt: skip
"""What is used of the shares."""
GIVEN = (*SHARES, *GRID)
_FROM_BELOW = Claim(Y / (8 * (1 + Y)), "<=", POWER, GIVEN)


def _use(given: tuple[Claim, ...], left: Expr, right: Expr) -> Step:
    """The hypothesis left <= right."""
    return said(given, Claim(left, "<=", right))


@cache
def _near() -> Step:
    """The bound from below where Y <= n + 1/2."""
    near = Claim(Y, "<=", n + sympy.Rational(1, 2))
    given, scale = (*GIVEN, near), 1 / ((n - 1) * (1 + Y))
    rest = 7 * n**2 / 8 + 7 * n / 8 + sympy.Rational(3, 2) / 2
    uses = (
        (B * (1 + Y), _use(given, 1 - p, u / n**2)),
        (A * (1 + Y), _use(given, 1 - q, v / n**2)),
        (n - 1, _use(given, (1 + u) * A, ONE)),
        ((n - 1) * (1 + u) * A, _use(given, (1 + v) * B, ONE)),
        (A * (1 + Y) + (1 + Y) * u / n**2, _use(given, B, ONE)),
        (B * (1 + Y) + (1 + Y) * v / n**2, _use(given, A, ONE)),
        (Y / n**2, said(given, near)),
        (Y / n**2 * rest, _use(given, TWO, n)),
    )
    claim = replace(_FROM_BELOW, given=given)
    return combine(
        claim, *((scale * k, s) for k, s in uses), remainder=scale * (n - 1) * u * v * A * B
    )


@cache
def _far() -> Step:
    """The same where n + 1/2 <= Y."""
    far = Claim(n + sympy.Rational(1, 2), "<=", Y)
    given, scale = (*GIVEN, far), 1 / ((n - 1) * (1 + Y))
    rest = 7 * n / 8 + sympy.Rational(21, 16)
    uses = (
        (n + 1, _use(given, (1 + u) * A, ONE)),
        ((n + 1) * (1 + u) * A, _use(given, (1 + v) * B, ONE)),
        (rest, _use(given, TWO, n)),
    )
    beyond = sympy.Rational(7, 8) / (1 + Y), said(given, far)
    spare = (n + 1) * u * v * A * B + (1 + Y) * (p * B + q * A) + sympy.Rational(3, 16)
    claim = replace(_FROM_BELOW, given=given)
    return combine(claim, *((scale * k, s) for k, s in uses), beyond, remainder=scale * spare)


@cache
def from_below() -> Step:
    """Y/(8 (1 + Y)) <= N P_S."""
    at = n + sympy.Rational(1, 2) - v
    low, high = (*GIVEN, Claim(u, "<", at)), (*GIVEN, Claim(at, "<", u))
    cases = [
        Step(replace(_FROM_BELOW, given=given), by.Instance(()), (case,))
        for given, case in ((low, _near()), (high, _far()))
    ]
    there = _FROM_BELOW.at((u, at))
    middle = Step(there, by.Instance(((u, at),)), (_near(),))
    return Step(_FROM_BELOW, by.Split(u, at), (cases[0], middle, cases[1]))


@cache
def from_above() -> Step:
    """N P_S <= 2Y, as (n − 1) N P_S <= n (1 − A + 1 − B) and n/(n − 1) <= 2."""
    scale = 1 / (n - 1)
    uses = (
        (n, _use(GIVEN, 1 - A, u)), (n, _use(GIVEN, 1 - B, v)), (Y, _use(GIVEN, TWO, n)),
        (0, _use(GIVEN, A, ONE)),
    )  # fmt: skip
    spare = (n + 1) * (1 - A) * (1 - B) + (1 - p) * B + (1 - q) * A
    claim = Claim(POWER, "<=", 2 * Y, GIVEN)
    return combine(claim, *((scale * k, s) for k, s in uses), remainder=scale * spare)


@cache
def plateau() -> Step:
    """N P_S <= n/(n − 1)."""
    scale = 1 / (n - 1)
    uses = (
        (scale * B, _use(GIVEN, p, ONE)),
        (scale * A, _use(GIVEN, q, ONE)),
    )
    spare = scale * ((1 - A) * (1 - B) + n * A * B)
    return combine(Claim(POWER, "<=", n / (n - 1), GIVEN), *uses, remainder=spare)


KAPPA, LAMBDA = (n * A - p) / (n - 1), (n * B - q) / (n - 1)
CORRELATED = (1 - KAPPA) * (1 - LAMBDA) + KAPPA * (1 - q) + LAMBDA * (1 - p)
"""N P_S of correlated multi-jitter, where n divides neither a nor b."""


def _small(share: Expr, end: Expr, level: Expr) -> tuple[Step, Step]:
    """−2u <= 1 − κ <= 2u, as (n − 1)(1 − κ) = n (1 − A) − (1 − p)."""
    scale, wave, size_ = 1 / (n - 1), (n * share - end) / (n - 1), _use(GIVEN, TWO, n)
    whole = _use(GIVEN, share, ONE)
    above = combine(
        Claim(1 - wave, "<=", 2 * level, GIVEN),
        (n * scale, _use(GIVEN, 1 - share, level)), (scale * level, size_),
        (scale, _use(GIVEN, end, ONE)),
    )  # fmt: skip
    below = combine(
        Claim(-2 * level, "<=", 1 - wave, GIVEN),
        (n * scale, whole), (scale, _use(GIVEN, 1 - end, level / n**2)),
        (2 * scale * level, size_),
        remainder=scale * level * (1 + (n - 1) * (n + 1) / n**2),
    )  # fmt: skip
    return below, above


def _end(share: Expr, end: Expr, other: Expr, level: Expr) -> tuple[Step, Step]:
    """−2v/n² <= κ (1 − q) <= 2v/n², as −1 <= κ <= 2 and 0 <= 1 − q <= v/n²."""
    scale, rest = 1 / (n - 1), 1 - other
    term, bound = (n * share - end) / (n - 1) * rest, 2 * level / n**2
    uses = (
        (2, _use(GIVEN, rest, level / n**2)), (0, _use(GIVEN, other, ONE)),
    )  # fmt: skip
    above = combine(
        Claim(term, "<=", bound, GIVEN), *uses,
        (scale * n * rest, _use(GIVEN, share, ONE)), (scale * rest, _use(GIVEN, TWO, n)),
        remainder=scale * end * rest,
    )  # fmt: skip
    below = combine(
        Claim(-bound, "<=", term, GIVEN), *uses,
        (scale * rest, _use(GIVEN, end, ONE)), (2 * scale * rest, _use(GIVEN, TWO, n)),
        remainder=scale * rest * (n * share + 1),
    )  # fmt: skip
    return below, above


@cache
def _product(is_above: bool) -> Step:
    """|xz| <= st where |x| <= s and |z| <= t: 2st ∓ 2xz = (s ∓ x)(t + z) + (s ± x)(t − z)."""
    X, Z, s, t = real("x z s t")
    given = (
        *(Claim(-e, "<=", k) for e, k in ((s, X), (t, Z))),
        Claim(X, "<=", s),
        Claim(Z, "<=", t),
    )
    low_x, low_z, high_x, high_z = (said(given, h) for h in given)
    if is_above:
        claim = Claim(2 * X * Z, "<=", 2 * s * t, given)
        return combine(claim, (t + Z, high_x), (s + X, high_z), (0, low_x), (0, low_z))
    claim = Claim(-2 * s * t, "<=", 2 * X * Z, given)
    return combine(claim, (t - Z, high_x), (s + X, low_z), (0, low_x), (0, high_z))


CEILING = 4 * u * v + 2 * (u + v) / n**2


@cache
def correlated(is_above: bool) -> Step:
    """−(4uv + 2 (u + v)/n²) <= N P_S, or N P_S <= 4uv + 2 (u + v)/n²."""
    X, Z, s, t = real("x z s t")
    values = ((X, 1 - KAPPA), (Z, 1 - LAMBDA), (s, 2 * u), (t, 2 * v))
    bounds = (*_small(A, p, u), *_small(B, q, v))
    found = _product(is_above)
    moved = Step(
        replace(found.claim.at(*values), given=GIVEN), by.Instance(values), (found, *bounds)
    )
    ends = [_end(*sides)[int(is_above)] for sides in ((A, p, q, v), (B, q, p, u))]
    sides = (CORRELATED, CEILING) if is_above else (-CEILING, CORRELATED)
    half = sympy.Rational(1, 2)
    return combine(Claim(sides[0], "<=", sides[1], GIVEN), (half, moved), *((1, e) for e in ends))


_WAVES = (*positive(a, b), *GRID)


def _values(first: Expr, second: Expr) -> tuple[tuple[Expr, Expr], ...]:
    """The shares at frequencies (first, second)."""
    return (
        (A, sinc_square(first / n)), (B, sinc_square(second / n)),
        (p, sinc_square(first / n**2)), (q, sinc_square(second / n**2)),
        (u, size(first / n)), (v, size(second / n)),
    )  # fmt: skip


def _discharged(first: Expr, second: Expr, given: tuple[Claim, ...]) -> tuple[Step, ...]:
    """The hypotheses on the shares, for frequencies above 0."""
    found: list[Step] = []
    for at in (first / n, second / n, first / n**2, second / n**2):
        share, level = sinc_square(at), size(at)
        over = Step(
            Claim((1 + level) * share, "<=", ONE, given), by.Instance(((x, at),)),
            (sinc_square_from_above(),),
        )  # fmt: skip
        under = Step(
            Claim(1 - share, "<=", level, given), by.Instance(((x, at),)), (jitter_envelope(),)
        )
        low = combine(Claim(ZERO, "<=", share, given), remainder=share)
        high = combine(Claim(share, "<=", ONE, given), (1, over), remainder=level * share)
        found += [low, high, over, under]
    return tuple(found)


def at_frequency(lemma: Step, first: Expr, second: Expr, given: tuple[Claim, ...] = _WAVES) -> Step:
    """A bound of this file for the spectrum itself."""
    values = _values(first, second)
    moved = replace(lemma.claim.at(*values), given=given)
    return Step(moved, by.Instance(values), (lemma, *_discharged(first, second, given)))


@cache
def multi_jitter_from_below() -> Step:
    """Y/(8 (1 + Y)) <= N P_S."""
    return at_frequency(from_below(), a, b)


@cache
def multi_jitter_from_above() -> Step:
    """N P_S <= 2Y."""
    return at_frequency(from_above(), a, b)


@cache
def multi_jitter_plateau() -> Step:
    """N P_S <= n/(n − 1)."""
    return at_frequency(plateau(), a, b)


WAVE = POWER.xreplace(dict(_values(ONE, ONE))) / (4 * n**2)
"""Var of cos 2πx cos 2πy under multi-jitter, N = n²."""
WAVE_CORRELATED = CORRELATED.xreplace(dict(_values(ONE, ONE))) / (4 * n**2)
"""The same under correlated multi-jitter."""


@cache
def wave_order() -> Step:
    """Θ(n^−4) = Θ(N^−2): Y = 2π²/(3n²) is at most 2π²/3."""
    level, full = 2 * size(1 / n), 2 * size(ONE)
    scale = 1 / (4 * n**2)
    under = at_frequency(from_below(), ONE, ONE, GRID)
    over = at_frequency(from_above(), ONE, ONE, GRID)
    low, high = full / (32 * (1 + full)), full / 2
    square = combine(Claim(ONE, "<=", n**2, GRID), (n + 2, _use(GRID, TWO, n)), remainder=3)
    share = full / (8 * (1 + full) * (1 + level) * n**4)
    drop = combine(
        Claim(level / (8 * (1 + full)), "<=", level / (8 * (1 + level)), GRID),
        (full * share, square),
    )
    below = combine(Claim(low * n**-4, "<=", WAVE, GRID), (scale, drop), (scale, under))
    above = combine(Claim(WAVE, "<=", high * n**-4, GRID), (scale, over))
    return Step(Claim(WAVE, "Theta", n**-4, GRID, n), by.Order((low, high)), (below, above))


CORRELATED_AS_A_RATE = Claim(WAVE_CORRELATED, "Theta", n**-4, GRID[:1], n)
"""Eq. 25, best case in 2D, read as a rate of correlated multi-jitter: Θ(N^−2)."""


@cache
def _correlated_bounds() -> tuple[Step, Step]:
    """−κ n^−6 <= Var <= κ n^−6, κ = (4 y² + 4 y)/4 with y = π²/3."""
    y = size(ONE)
    bound = (y**2 + y) * n**-6
    high, low = (at_frequency(correlated(side), ONE, ONE, GRID) for side in (True, False))
    scale = 1 / (4 * n**2)
    return (
        combine(Claim(-bound, "<=", WAVE_CORRELATED, GRID), (scale, low)),
        combine(Claim(WAVE_CORRELATED, "<=", bound, GRID), (scale, high)),
    )


@cache
def correlated_wave() -> Step:
    """Var <= (y² + y) N^−3, y = π²/3."""
    return _correlated_bounds()[1]


@cache
def not_the_rate_of_the_correlated() -> Step:
    """N² Var → 0."""
    y, factor = size(ONE), n**4
    steps: list[Step] = []
    for sign, bound in zip((-1, 1), _correlated_bounds(), strict=True):
        share = sign * (y**2 + y) * n**-2
        ends = (share, factor * WAVE_CORRELATED)
        left, right = ends if sign < 0 else ends[::-1]
        steps.append(combine(Claim(left, "<=", right, GRID), (factor, bound)))
        steps.append(limit_of_powers(share, [(sign * (y**2 + y), -TWO)], n, GRID, ZERO))
    claim = Claim(factor * WAVE_CORRELATED, "->", ZERO, GRID[:1], n)
    reached = Step(claim, by.Squeeze(), tuple(steps))
    return Step(replace(CORRELATED_AS_A_RATE, false=True), by.Counterexample(()), (reached,))


_RIDGE = 1 + A * (n**2 * A / (n - 1) - p)
RIDGE = _RIDGE.xreplace(dict(_values(ONE, ONE)))
"""N P_S of correlated multi-jitter at (n, 1), N = n², on a ridge."""
BOUNDED_RIDGE = Claim(RIDGE, "O", ONE, GRID[:1], n)
"""Eq. 18 off the axes: γ/N with γ free of N."""


@cache
def on_a_ridge() -> Step:
    """n − 2π²/(3n) <= N P_S, as A² >= 1 − 2u, u = π²/(3n²)."""
    uses = (
        (2 * n, _use(GIVEN, 1 - A, u)), (1, _use(GIVEN, A, ONE)), (A, _use(GIVEN, p, ONE)),
    )  # fmt: skip
    rest = A**2 * (1 + 1 / (n - 1)) + n * (1 - A) ** 2
    lemma = combine(Claim(n - 2 * n * u, "<=", _RIDGE, GIVEN), *uses, remainder=rest)
    return at_frequency(lemma, ONE, ONE, GRID)


@cache
def ridge_is_not_bounded() -> Step:
    """N P_S → ∞."""
    below = on_a_ridge()
    terms = [(ONE, ONE), (-2 * size(ONE), -ONE)]
    grows = limit_of_powers(below.claim.left, terms, n, GRID, sympy.oo)
    reached = Step(Claim(RIDGE, "->", sympy.oo, GRID[:1], n), by.Squeeze(), (below, grows))
    return Step(replace(BOUNDED_RIDGE, false=True), by.Counterexample(()), (reached,))
