"""Lines in several directions: weights, equal shares, and directions drawn at random.

Independent estimators of variances V₁, V₂ with weights w, 1 − w:  V = w² V₁ + (1 − w)² V₂.

    fixed 0 < w < 1, V₁ = p N^−a, V₂ = r N^−h, a < h:   N^a V → w² p, the worse of the two rates;
    any w:    V₁V₂/(V₁ + V₂) <= V,   with equality at w = V₂/(V₁ + V₂), the better of the two;
    half of N to each of two with V = p N^−a:   2^(a−1) p N^−a, not less than V for a >= 1.

If N lines have jittered offsets and each lies, independently, with probability p along the wave of
frequency m (and sees it) and across it (and does not), the marks w_j = 0, 1 give

    (1/N²) [Σ_j E w_j + Σ_{j≠k} E w_j E w_k cos 2πm(j − k)/N sinc²(m/N)]
        = p² (1 − sinc²(m/N))/N + p (1 − p)/N,

which is of order 1/N for 0 < p < 1, however well the offsets are stratified. Offsets of lines in
the plane are points of one dimension, where a Latin hypercube is jitter. (The paper, Sec. 6.3,
7.2, footnotes 4 and 5.)
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import exponential_sums as waves
from .exponential_sums import N, all_pairs, m, no_power_in_strata, sinc_square, strata
from .jitter_bounds import sinc_square_from_above
from .products import sine_square_at_most
from .sines import jitter_envelope, x, z
from .tactics import ONE, ZERO, combine, limit_of_powers, positive, real, whole

a, h, p, r, w, first, second = real("a h p r w V_1 V_2")
pi, TWO, HALF = sympy.pi, sympy.Integer(2), sympy.Rational(1, 2)
LARGE = (Claim(ONE, "<", N),)
STRATA = (Claim(TWO, "<=", N),)
weight = sympy.Function("w")


def weighted(share: Expr, one: Expr, other: Expr) -> Expr:
    """w² V₁ + (1 − w)² V₂."""
    return share**2 * one + (1 - share) ** 2 * other


@cache
def fixed_weights() -> Step:
    """The worse of the two rates."""
    given = (*positive(p, r, w), Claim(w, "<", ONE), Claim(a, "<", h), *LARGE)
    total = weighted(w, p * N**-a, r * N**-h)
    terms = [(w**2 * p, ZERO), ((1 - w) ** 2 * r, a - h)]
    limit = limit_of_powers(N**a * total, terms, N, given, w**2 * p)
    return Step(Claim(total, "Theta", N**-a, given, N), by.Order(), (limit,))


_FROM_1 = (*whole(x), Claim(ONE, "<=", x))
WORSE_OF_TWO = Claim(
    weighted(weight(N), 1 / N, N**-3), "Theta", 1 / N,
    (Claim(ZERO, "<", weight(x), _FROM_1, over=(x,)),
     Claim(weight(x), "<=", ONE, _FROM_1, over=(x,)), *positive(N)), N,
)  # fmt: skip
"""Footnote 4 for weights that may depend on N: the worse of N^−1 and N^−3."""


@cache
def better_of_two() -> Step:
    """With w = V₂/(V₁ + V₂) = 1/(N² + 1) it is 1/(N³ + N), the better of the two."""
    chosen = 1 / (N**2 + 1)
    total = weighted(chosen, 1 / N, N**-3)
    value = combine(Claim(N * total, "=", chosen, positive(N)))
    above = combine(Claim(chosen, "<=", N**-2, positive(N)), remainder=N**-2 * chosen)
    below = combine(Claim(ZERO, "<=", chosen, positive(N)), remainder=chosen)
    ends = (
        limit_of_powers(N**-2, [(ONE, -TWO)], N, positive(N), ZERO),
        limit_of_powers(ZERO, [(ZERO, ZERO)], N, positive(N), ZERO),
    )
    falls = Step(
        Claim(chosen, "->", ZERO, positive(N), N), by.Squeeze(), (below, ends[1], above, ends[0])
    )
    limit = Step(Claim(N * total, "->", ZERO, positive(N), N), by.Squeeze(), (value, falls))
    shares = (
        combine(Claim(ZERO, "<", 1 / (x**2 + 1)), remainder=1 / (x**2 + 1)),
        combine(Claim(1 / (x**2 + 1), "<=", ONE), remainder=x**2 / (x**2 + 1)),
    )
    values = ((weight, sympy.Lambda(x, 1 / (x**2 + 1))),)
    return Step(
        replace(WORSE_OF_TWO, false=True), by.Counterexample(values), (limit, *shares)
    )  # fmt: skip


@cache
def inverse_variance() -> Step:
    """V₁V₂/(V₁ + V₂) <= w² V₁ + (1 − w)² V₂: the gap is (w (V₁ + V₂) − V₂)²/(V₁ + V₂)."""
    given = positive(first, second)
    gap = (w * (first + second) - second) ** 2 / (first + second)
    best = first * second / (first + second)
    return combine(Claim(best, "<=", weighted(w, first, second), given), remainder=gap)


@cache
def equal_shares() -> Step:
    """Two directions of one rate a >= 1 with half of N each: not less than one with all of N."""
    given = (*positive(p, N), Claim(ONE, "<=", a))
    rising = (Claim(ONE, "<=", a),)
    slope = TWO ** (a - 1) * sympy.log(TWO)
    up = combine(Claim(ZERO, "<=", slope, (Claim(ONE, "<", a),)), remainder=slope)
    grown = Step(Claim(ONE, "<=", TWO ** (a - 1), rising), by.Monotone(a, ONE), (up,))
    shared = weighted(HALF, p * (N / 2) ** -a, p * (N / 2) ** -a)
    return combine(Claim(p * N**-a, "<=", shared, given), (p * N**-a, grown))


def random_directions(frequency: Expr) -> Expr:
    """p² (1 − sinc²)/N + p (1 − p)/N."""
    return p**2 * (1 - sinc_square(frequency)) / N + p * (1 - p) / N


@cache
def marks() -> Step:
    """The spectrum of jittered lines each of which sees the wave with probability p."""
    given = (*strata(), Claim(m, "!=", ZERO))
    pairs = (all_pairs(m) - N) * sinc_square(m) / N**2
    claim = Claim(p / N + p**2 * pairs, "=", random_directions(m), given)
    return combine(claim, (p**2 * sinc_square(m) / N**2, no_power_in_strata()))


@cache
def _sinc_square_at_1() -> tuple[Step, Step, Step]:
    """0 <= sinc²(1/N) <= 1, and (1 + π²/(3N²)) sinc²(1/N) <= 1."""
    share, u = sinc_square(ONE), pi / N
    low = combine(Claim(ZERO, "<=", share, LARGE), remainder=share)
    small = Step(
        Claim(sympy.sin(u) ** 2, "<=", u**2, LARGE), by.Instance(((z, u),)),
        (sine_square_at_most(),),
    )  # fmt: skip
    high = combine(Claim(share, "<=", ONE, LARGE), (u**-2, small))
    found = sinc_square_from_above()
    there = replace(found.claim.at((x, 1 / N)), given=LARGE)
    return low, high, Step(there, by.Instance(((x, 1 / N),)), (found,))


@cache
def random_directions_order() -> Step:
    """Footnote 5: at m = 1 the spectrum is Theta(1/N) for 0 < p < 1."""
    given = (*positive(p), Claim(p, "<", ONE), *LARGE)
    low, high, _ = _sinc_square_at_1()
    spectrum, least = random_directions(ONE), p * (1 - p)
    under = combine(Claim(least / N, "<=", spectrum, given), (p**2 / N, high))
    over = combine(Claim(spectrum, "<=", p / N, given), (p**2 / N, low))
    claim = Claim(spectrum, "Theta", 1 / N, given, N)
    return Step(claim, by.Order((least, p)), (under, over))


FOOTNOTE_5 = Claim(
    random_directions(ONE), "O", N**-3, (*positive(p), Claim(p, "<=", ONE), *LARGE), N
)
"""The order of parallel lines (p = 1), for lines of random direction."""


@cache
def footnote_5_denied() -> Step:
    """At p = 1/2 it is at least 1/(4N)."""
    _, high, _ = _sinc_square_at_1()
    spectrum = N**3 * random_directions(ONE).xreplace({p: HALF})
    under = combine(Claim(N**2 / 4, "<=", spectrum, LARGE), (N**2 / 4, high))
    grows = limit_of_powers(N**2 / 4, [(sympy.Rational(1, 4), TWO)], N, LARGE, sympy.oo)
    limit = Step(Claim(spectrum, "->", sympy.oo, LARGE, N), by.Squeeze(), (under, grows))
    return Step(replace(FOOTNOTE_5, false=True), by.Counterexample(((p, HALF),)), (limit,))


PARALLEL = (1 - sinc_square(ONE)) / N
"""The variance of √2 cos 2πx under N jittered lines x = const of the plane."""


@cache
def parallel_order() -> Step:
    """It is Theta(N^−3): 1 − sinc²(1/N) lies between π²/((3 + π²) N²) and π²/(3N²)."""
    _, _, share = _sinc_square_at_1()
    given, size = LARGE, pi**2 / (3 * N**2)
    found = jitter_envelope()
    there = replace(found.claim.at((x, 1 / N)), given=given)
    envelope = Step(there, by.Instance(((x, 1 / N),)), (found,))
    over = combine(Claim(PARALLEL, "<=", pi**2 / 3 * N**-3, given), (1 / N, envelope))
    least = pi**2 / (3 + pi**2)
    large = Step(Claim(ONE, "<", N, given), by.Given())
    square = combine(Claim(ONE, "<=", N**2, given), (N + 1, large))
    room = pi**4 / (N**3 * (3 * N**2 + pi**2) * (3 + pi**2))
    under = combine(
        Claim(least * N**-3, "<=", PARALLEL, given), (1 / (N * (1 + size)), share), (room, square)
    )
    return Step(
        Claim(PARALLEL, "Theta", N**-3, given, N), by.Order((least, pi**2 / 3)), (under, over)
    )


ROOKS = Claim(PARALLEL, "Theta", 1 / N, LARGE, N)
"""Sec. 7.2: n-rooks offsets of lines give 1/N, read in the plane."""


@cache
def rooks_denied() -> Step:
    """In the plane N PARALLEL is at most π²/(3N²)."""
    _, high, _ = _sinc_square_at_1()
    found = jitter_envelope()
    there = replace(found.claim.at((x, 1 / N)), given=LARGE)
    envelope = Step(there, by.Instance(((x, 1 / N),)), (found,))
    size, zero_limit = pi**2 / 3 * N**-2, limit_of_powers(ZERO, [(ZERO, ZERO)], N, LARGE, ZERO)
    over = combine(Claim(N * PARALLEL, "<=", size, LARGE), (1, envelope))
    under = combine(Claim(ZERO, "<=", N * PARALLEL, LARGE), (1, high))
    falls = limit_of_powers(size, [(pi**2 / 3, -TWO)], N, LARGE, ZERO)
    limit = Step(
        Claim(N * PARALLEL, "->", ZERO, LARGE, N), by.Squeeze(), (under, zero_limit, over, falls)
    )
    return Step(replace(ROOKS, false=True), by.Counterexample(()), (limit,))


@cache
def rooks_are_jitter() -> Step:
    """A Latin hypercube of one dimension has the spectrum of jitter."""
    found, given = waves.latin_hypercube(), (*strata(), Claim(m, "!=", ZERO))
    values = ((waves.d, ONE), (waves.mode, sympy.Lambda(waves.i, m)))
    moved = found.claim.at(*values)
    about = [c for c in found.claim.given if c.over]
    told = [
        Step(replace(c.at((waves.mode, values[1][1])), given=(), over=()), by.Given())
        for c in about
    ]
    told = [Step(replace(s.claim, given=given), by.Given()) for s in told]
    there = Step(replace(moved, given=given), by.Instance(values), (found, *told))
    (product,) = moved.right.atoms(sympy.Product)
    one = Step(Claim(product, "=", product.function, given), by.Range())
    claim = Claim(moved.left, "=", (1 - sinc_square(m)) / N, given)
    return combine(claim, (1, there), ((N - 1) / N, one))
