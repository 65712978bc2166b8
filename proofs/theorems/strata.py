"""Two points in strata: waves summed over n strata, blurred by a uniform place in each, for all n.

    sin²(θ/2) Σ_k Σ_j cos θ(j − k) = sin²(nθ/2),     j, k = 1, ..., n,

by two telescoping sums, and a place u uniform in [0, 1/n] has |E exp(2πi ν u)|² = sinc²(ν/n), so
that r strata of width 1/(nr), side by side, are blurred to one of width 1/n:

    (1/r²) Σ_k Σ_j cos(2πν (j − k)/(nr)) · sinc²(ν/(nr)) = sinc²(ν/n)      for all real ν,

which with n = 1 says that a stratified axis, left to itself, is uniform: sinc² ν is 1 at ν = 0 and
0 at all other whole ν. Two different ones of r strata have the characteristic function

    (r sinc²(ν/n) − sinc²(ν/(nr)))/(r − 1).
"""

from functools import cache

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .tactics import ONE, ZERO, combine, positive, real, whole

j, k, u, M, theta, c = real("j k u M theta c")
nu, n, r = real("nu n r")
pi, sin, cos, sinc = sympy.pi, sympy.sin, sympy.cos, sympy.sinc
half, TWO = sympy.Rational(1, 2), sympy.Integer(2)


def sinc2(x: Expr) -> Expr:
    """sinc² x = (sin(πx)/(πx))²."""
    return sinc(pi * x) ** 2


def _last(term: Expr, index: Symbol, given: tuple[Claim, ...]) -> tuple[Step, Step]:
    """Σ to M + 1 cut at M, and its last term."""
    head, tail = sympy.Sum(term, (index, 1, M)), sympy.Sum(term, (index, M + 1, M + 1))
    cut = Step(Claim(sympy.Sum(term, (index, 1, M + 1)), "=", head + tail, given), by.Range(M))
    return cut, Step(Claim(tail, "=", term.xreplace({index: M + 1}), given), by.Range())


def telescoped(factor: Expr, term: Expr, index: Symbol, closed: Expr) -> Step:
    """factor · Σ_{index=1}^{M} term = closed, by induction on M."""
    total = sympy.Sum(term, (index, 1, M))
    size = (*whole(M), Claim(ZERO, "<=", M))
    claim = Claim(factor * total, "=", closed, size)
    empty = total.xreplace({M: ZERO})
    none = Step(Claim(empty, "=", ZERO), by.Range())
    base = combine(Claim(factor * empty, "=", closed.xreplace({M: ZERO})), (factor, none))
    before = Claim(factor * total, "=", closed)
    given = (*size, before)
    cut, last = _last(term, index, given)
    step = combine(
        Claim(factor * total.xreplace({M: M + 1}), "=", closed.xreplace({M: M + 1}), given),
        (factor, cut), (factor, last),
        (1, Step(Claim(before.left, "=", closed, given), by.Given())),
    )  # fmt: skip
    return Step(claim, by.Induction(M, ZERO), (base, step))


@cache
def count() -> Step:
    """Σ 1 = M."""
    return telescoped(ONE, ONE, j, M)


@cache
def row() -> Step:
    """2 sin(θ/2) Σ_j cos θ(j − k)."""
    closed = sin(theta * (M + half - k)) - sin(theta * (half - k))
    return telescoped(2 * sin(theta / 2), cos(theta * (j - k)), j, closed)


@cache
def column() -> Step:
    """2 sin(θ/2) Σ_k [sin θ(c − k) − sin θ(1/2 − k)]."""
    term = sin(theta * (c - k)) - sin(theta * (half - k))
    ends = cos(theta * (c - half - M)) - cos(theta * (c - half))
    return telescoped(2 * sin(theta / 2), term, k, ends - cos(theta * M) + 1)


def waves(angle: Expr, size: Expr) -> Expr:
    """Σ_k Σ_j cos angle (j − k), both from 1 to size."""
    return sympy.Sum(cos(angle * (j - k)), (j, 1, size), (k, 1, size))


def sizes(*counts: Expr) -> tuple[Claim, ...]:
    """Whole numbers that are at least 1."""
    return (*whole(*counts), *(Claim(ONE, "<=", x) for x in counts))


@cache
def all_pairs() -> Step:
    """sin²(θ/2) ΣΣ cos θ(j − k) = sin²(rθ/2) over r strata."""
    given = sizes(r)
    inside = (*given, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", r))
    total, scale = waves(theta, r), 2 * sin(theta / 2)
    one = sympy.Sum(cos(theta * (j - k)), (j, 1, r))
    ends = row().claim.right.xreplace({M: r})
    line = Step(Claim(scale * one, "=", ends, inside), by.Instance(((M, r),)), (row(),))
    both = sympy.Sum(scale * one, (k, 1, r))
    lines = Step(Claim(both, "=", sympy.Sum(ends, (k, 1, r)), given), by.Bind(), (line,))
    outside = Step(Claim(both, "=", scale * total, given), by.Linear(((scale, one),)))
    at = ((c, r + half), (M, r))
    moved = column().claim.at(*at)
    sums = Step(Claim(moved.left, "=", moved.right, given), by.Instance(at), (column(),))
    claim = Claim(sin(theta / 2) ** 2 * total, "=", sin(r * theta / 2) ** 2, given)
    slope = sin(theta / 2) / 2
    return combine(claim, (-slope, outside), (slope, lines), (sympy.Rational(1, 4), sums))


def blur(frequency: Expr, strata: Expr) -> Expr:
    """|E exp(2πi frequency u/strata)|² for u uniform in [0, 1]."""
    angle = 2 * pi * frequency * u / strata
    parts = (sympy.Integral(g(angle), (u, 0, 1)) for g in (cos, sin))
    return sympy.Add(*(p**2 for p in parts))


@cache
def uniform_place() -> Step:
    """|E exp(2πi ν u/n)|² = sinc²(ν/n) for all real ν."""
    given = positive(n)
    claim = Claim(blur(nu, n), "=", sinc2(nu / n), given)
    apart = (*given, Claim(nu, "!=", ZERO))
    angle = 2 * pi * nu * u / n
    real_, imaginary = (sympy.Integral(g(angle), (u, 0, 1)) for g in (cos, sin))
    scale, full = n / (2 * pi * nu), 2 * pi * nu / n
    wave = Step(Claim(real_, "=", scale * sin(full), apart), by.Antiderivative(scale * sin(angle)))
    other = Step(
        Claim(imaginary, "=", scale * (1 - cos(full)), apart),
        by.Antiderivative(-scale * cos(angle)),
    )
    squares = ((side + s.claim.right, s) for side, s in ((real_, wave), (imaginary, other)))
    away = combine(Claim(claim.left, "=", claim.right, apart), *squares)
    one, none = (sympy.Integral(x, (u, 0, 1)) for x in (ONE, ZERO))
    whole_ = Step(Claim(one, "=", ONE), by.Antiderivative(u))
    nothing = Step(Claim(none, "=", ZERO), by.Linear(()))
    there = Claim(one**2 + none**2, "=", ONE, given)
    at = combine(there, (one + 1, whole_), (none, nothing))
    return Step(claim, by.Split(nu, ZERO), (away, at, away))


def blurred_pairs(frequency: Expr, angle_strata: Expr, size: Expr) -> Expr:
    """Σ over pairs of ``size`` strata, each 1/angle_strata wide, of E cos."""
    return waves(2 * pi * frequency / angle_strata, size) * blur(frequency, angle_strata)


@cache
def ones() -> Step:
    """Σ_k Σ_j 1 = r²."""
    given = sizes(r)
    inside = (*given, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", r))
    inner = sympy.Sum(ONE, (j, 1, r))
    line = Step(Claim(inner, "=", r, inside), by.Instance(((M, r),)), (count(),))
    total = sympy.Sum(inner, (k, 1, r))
    lines = Step(Claim(total, "=", sympy.Sum(r, (k, 1, r)), given), by.Bind(), (line,))
    single = sympy.Sum(ONE, (k, 1, r))
    scale = Step(Claim(sympy.Sum(r, (k, 1, r)), "=", r * single, given), by.Linear(((r, ONE),)))
    counted = telescoped(ONE, ONE, k, M)
    size = Step(Claim(single, "=", r, given), by.Instance(((M, r),)), (counted,))
    return combine(Claim(total, "=", r**2, given), (1, lines), (1, scale), (r, size))


@cache
def substrata() -> Step:
    """r strata side by side, each 1/(nr) wide, are one stratum 1/n wide: r² sinc²(ν/n)."""
    given = (*positive(n), *sizes(r))
    fine, angle = n * r, 2 * pi * nu / (n * r)
    claim = Claim(blurred_pairs(nu, fine, r), "=", r**2 * sinc2(nu / n), given)
    place = Step(
        Claim(blur(nu, fine), "=", sinc2(nu / fine), given),
        by.Instance(((n, fine),)), (uniform_place(),),
    )  # fmt: skip
    apart = (*given, Claim(nu, "!=", ZERO))
    at = all_pairs().claim.at((theta, angle))
    pairs = Step(
        Claim(at.left, "=", at.right, given), by.Instance(((theta, angle),)), (all_pairs(),)
    )
    away = combine(
        Claim(claim.left, "=", claim.right, apart),
        (waves(angle, r), place), (1 / (pi * nu / fine) ** 2, pairs),
    )  # fmt: skip
    zero = claim.at((nu, ZERO))
    still = Step(Claim(blur(ZERO, fine), "=", ONE, given), by.Instance(((nu, ZERO),)), (place,))
    there = combine(
        Claim(zero.left, "=", zero.right, given),
        (waves(ZERO, r), still), (1, ones()),
    )  # fmt: skip
    return Step(claim, by.Split(nu, ZERO), (away, there, away))
