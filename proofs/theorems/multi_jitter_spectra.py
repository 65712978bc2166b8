"""Exact expected spectra of multi-jitter and correlated multi-jitter, for all counts.

Two different ones of the r substrata of one of s strata have K = (r A − A')/(r − 1) with
A = sinc²(ν/s), A' = sinc²(ν/(rs)). In d dimensions an orthogonal array of strength d with s
levels, N = s^d and r = s^(d−1), has independent levels on its axes, and at one point's own place
1 stands for ∏ K:

    N P_S = 1 + N ∏ (sinc² ν_i + (K_i − A_i)/s) − ∏ K_i.

In 2D with m columns and n rows, N = m n, two points share a column, a row, or neither (Chiu,
Shirley, Wang 1994): with h_x = m² sinc² f − m A_x, h_y = n² sinc² g − n A_y,

    N P_S = 1 + (h_x h_y + m K_x h_y + n K_y h_x)/N,

which at (f, 0), f whole and not 0, is 1 − sinc²(f/N), as of a Latin hypercube; and if all columns
have one shuffle and all rows have one (Kensler 2013),

    N P_S = 1 + (D_m D_n K_x K_y + m K_x D_n B' + n K_y D_m A')/N,    D_m = m² [m divides f] − m,

where [m divides f] = (1/m²) ΣΣ cos 2πf (j − k)/m. At f = mj, where it is 1, and g that n does not
divide, this is a ridge,

    N P_S = 1 + sinc²(j/n) [N sinc²(g/n)/(n − 1) − sinc²(g/N)],

for m = n, j = g = 1 at least n − 2π²/(3n).
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .strata import all_pairs, blur, blurred_pairs, pi, sin, sinc2, theta, waves
from .strata import r as size_
from .stratified_spectra import INDEX, all_in_step, along_axes, at_axis, d, i, pairs_of, place
from .stratified_spectra import m as tooth
from .tactics import ONE, ZERO, combine, real, whole

s, r, f, g, m, n, z, j = real("s r f g m n z h")
_PARTS = real("K_x K_y a b")
_WAVES = (sympy.Function("X"), sympy.Function("Y"))
TWO = sympy.Integer(2)
COUNTS = (*whole(m, n), Claim(TWO, "<=", m), Claim(TWO, "<=", n))
N = m * n


def above_one(*counts: Expr, given: tuple[Claim, ...] = COUNTS) -> tuple[tuple[int, Step], ...]:
    """0 < x − 1 and 0 < x for counts x >= 2, to be seen at once."""
    found: list[Step] = []
    for x in counts:
        least = Step(Claim(TWO, "<=", x, given), by.Given())
        found += [combine(Claim(ZERO, "<", x - y, given), (1, least), remainder=2 - y)
                  for y in (0, 1)]  # fmt: skip
    return tuple((0, step) for step in found)


def shared(frequency: Expr, levels: Expr = s, substrata: Expr = r) -> Expr:
    """K = (r A − A')/(r − 1)."""
    wide, fine = sinc2(frequency / levels), sinc2(frequency / (levels * substrata))
    return (substrata * wide - fine) / (substrata - 1)


def agreeing(frequency: Expr, levels: Expr, substrata: Expr) -> Expr:
    """K as the mean over ordered pairs of different substrata of a stratum."""
    wide = levels * substrata
    every = blurred_pairs(frequency, wide, substrata) - substrata * blur(frequency, wide)
    return every / (substrata * (substrata - 1))


def agree(frequency: Expr, levels: Expr, substrata: Expr, given: tuple[Claim, ...]) -> Step:
    """The mean over pairs of substrata is K."""
    fine = pairs_of(frequency, levels, substrata, given)
    one = place(frequency, levels * substrata, given)
    scale = 1 / (substrata * (substrata - 1))
    claim = Claim(
        agreeing(frequency, levels, substrata), "=", shared(frequency, levels, substrata), given
    )
    known = above_one(levels, substrata, given=given)
    return combine(claim, (scale, fine), (-scale * substrata, one), *known)


@cache
def in_d_dimensions() -> Step:
    """An orthogonal array of strength d, s levels, its strata cut into r = s^(d−1) substrata."""
    axes = (*whole(s, r, d), *(Claim(TWO, "<=", x) for x in (s, r)), Claim(ONE, "<=", d))
    given = (*axes, Claim(r, "=", s ** (d - 1)))
    inside, nu = (*axes, *INDEX), at_axis(i)
    coarse, in_coarse = pairs_of(nu, ONE, s, inside), place(nu, s, inside)
    alike = agree(nu, s, r, inside)
    level = (blurred_pairs(nu, s, s) - s * blur(nu, s) + s * alike.claim.left) / s**2
    value = sinc2(nu) + (shared(nu) - sinc2(nu / s)) / s
    levels = combine(
        Claim(level, "=", value, inside),
        (1 / s**2, coarse), (-1 / s, in_coarse), (1 / s, alike), *above_one(s, r, given=inside),
    )  # fmt: skip
    means, same_point = along_axes(levels, axes), along_axes(alike, axes)
    left = 1 + s * r * means.claim.left - same_point.claim.left
    right = 1 + s * r * means.claim.right - same_point.claim.right
    return combine(Claim(left, "=", right, given), (s * r, means), (-1, same_point),
                   *above_one(s, r, given=given))  # fmt: skip


def _different(frequency: Expr, levels: Expr, given: tuple[Claim, ...]) -> Step:
    """h: the sum over ordered pairs of different strata."""
    all_, one = pairs_of(frequency, ONE, levels, given), place(frequency, levels, given)
    left = blurred_pairs(frequency, levels, levels) - levels * blur(frequency, levels)
    right = levels**2 * sinc2(frequency) - levels * sinc2(frequency / levels)
    return combine(Claim(left, "=", right, given), (1, all_), (-levels, one))


@cache
def columns_and_rows() -> Step:
    """Multi-jitter of m columns and n rows, at any real frequency (f, g)."""
    h_x, h_y = _different(f, m, COUNTS), _different(g, n, COUNTS)
    k_x, k_y = agree(f, m, n, COUNTS), agree(g, n, m, COUNTS)
    sides = [
        1 + (x * y + m * kx * y + n * ky * x) / N
        for x, y, kx, ky in zip(*((u.claim.left, u.claim.right) for u in (h_x, h_y, k_x, k_y)),
                                strict=True)
    ]  # fmt: skip
    x, y = h_x.claim.left, h_y.claim.left
    kx, ky = k_x.claim.right, k_y.claim.right
    return combine(
        Claim(sides[0], "=", sides[1], COUNTS),
        ((y + n * ky) / N, h_x), ((h_x.claim.right + m * kx) / N, h_y),
        (m * y / N, k_x), (n * x / N, k_y), *above_one(m, n),
    )  # fmt: skip


@cache
def on_an_axis() -> Step:
    """Multi-jitter of m columns and n rows at (f, 0), f whole and not 0: 1 − sinc²(f/N)."""
    given = (*COUNTS, *whole(f), Claim(f, "!=", ZERO))
    found = columns_and_rows()
    moved = replace(found.claim.at((g, ZERO)), given=given)
    known = tuple(step for _, step in above_one(m, n, given=given))
    there = Step(moved, by.Instance(((g, ZERO),)), (found, *known))
    none = combine(Claim(sinc2(f), "=", ZERO, given))
    claim = Claim(moved.left, "=", 1 - sinc2(f / N), given)
    slope = (n**2 - n + n) * m**2 / N
    return combine(claim, (1, there), (slope, none), *above_one(m, n, given=given))


def apart(frequency: Expr, levels: Expr) -> Expr:
    """D: waves of all ordered pairs of different strata, not blurred."""
    return waves(2 * pi * frequency / levels, levels) - levels


@cache
def correlated() -> Step:
    """Correlated multi-jitter of m columns and n rows, at any real frequency (f, g)."""
    d_x, d_y = apart(f, m), apart(g, n)
    a, b = place(f, N, COUNTS), place(g, N, COUNTS)
    k_x, k_y = agree(f, m, n, COUNTS), agree(g, n, m, COUNTS)
    sides = [
        1 + (d_x * d_y * kx * ky + m * kx * d_y * fine_y + n * ky * d_x * fine_x) / N
        for kx, ky, fine_x, fine_y in zip(
            *((u.claim.left, u.claim.right) for u in (k_x, k_y, a, b)), strict=True
        )
    ]
    kx, ky = k_x.claim, k_y.claim
    return combine(
        Claim(sides[0], "=", sides[1], COUNTS),
        ((d_x * d_y * ky.left + m * d_y * b.claim.left) / N, k_x),
        ((d_x * d_y * kx.right + n * d_x * a.claim.left) / N, k_y),
        (n * d_x * ky.right / N, a), (m * d_y * kx.right / N, b), *above_one(m, n),
    )  # fmt: skip


def off_teeth(frequency: Expr, levels: Expr) -> tuple[Claim, Claim]:
    """The frequency is whole, and the number of strata does not divide it."""
    return Claim(frequency, "whole"), Claim(sin(pi * frequency / levels), "!=", ZERO)


def no_waves(frequency: Expr, levels: Expr, given: tuple[Claim, ...]) -> Step:
    """ΣΣ cos 2πf (j − k)/m = 0 where m does not divide f, between the teeth of the comb."""
    at = ((theta, 2 * pi * frequency / levels), (size_, levels))
    moved = all_pairs().claim.at(*at)
    pairs = Step(Claim(moved.left, "=", moved.right, given), by.Instance(at), (all_pairs(),))
    total = waves(2 * pi * frequency / levels, levels)
    return combine(Claim(total, "=", ZERO, given), (1 / sin(pi * frequency / levels) ** 2, pairs))


def _joined(kx: Expr, ky: Expr, x: Expr, y: Expr, fine_x: Expr, fine_y: Expr) -> Expr:
    """N P_S with sums x, y over all pairs of columns and of rows."""
    d_x, d_y = x - m, y - n
    return 1 + (d_x * d_y * kx * ky + m * kx * d_y * fine_y + n * ky * d_x * fine_x) / N


def _between(kx: Expr, ky: Expr, fine_x: Expr, fine_y: Expr) -> Expr:
    return (1 - kx) * (1 - ky) + kx * (1 - fine_y) + ky * (1 - fine_x)


def _without_waves() -> Step:
    """What is left of N P_S where the sums over pairs of columns and of rows are 0."""
    none = tuple(Claim(w(z), "=", ZERO, over=(z,)) for w in _WAVES)
    given = (*COUNTS, *none)
    here = [Step(Claim(w(z), "=", ZERO, given), by.Given()) for w in _WAVES]
    at = [Step(Claim(w(ZERO), "=", ZERO, given), by.Instance(((z, ZERO),)), (h,))
          for w, h in zip(_WAVES, here, strict=True)]  # fmt: skip
    (x, y), (kx, ky, fine_x, fine_y) = (w(ZERO) for w in _WAVES), _PARTS
    claim = Claim(_joined(kx, ky, x, y, fine_x, fine_y), "=", _between(*_PARTS), given)
    return combine(
        claim,
        (((y - n) * kx * ky + n * ky * fine_x) / N, at[0]),
        ((-m * kx * ky + m * kx * fine_y) / N, at[1]),
    )  # fmt: skip


@cache
def correlated_between_teeth() -> Step:
    """Where m does not divide f and n does not divide g: (1 − K_x)(1 − K_y) + ..."""
    given = (*COUNTS, *off_teeth(f, m), *off_teeth(g, n))
    found, none = correlated(), (no_waves(f, m, given), no_waves(g, n, given))
    parts = (shared(f, m, n), shared(g, n, m), sinc2(f / N), sinc2(g / N))
    sums = [u.claim.left for u in none]
    values = (*zip(_PARTS, parts, strict=True),
              *((w, sympy.Lambda(z, v)) for w, v in zip(_WAVES, sums, strict=True)))  # fmt: skip
    joined = _joined(parts[0], parts[1], sums[0], sums[1], parts[2], parts[3])
    claim = Claim(joined, "=", _between(*parts), given)
    known = tuple(step for _, step in above_one(m, n, given=given))
    left = Step(claim, by.Instance(values), (_without_waves(), *none, *known))
    whole_ = Claim(found.claim.left, "=", claim.right, given)
    return combine(whole_, (1, found), (1, left), *above_one(m, n, given=given))


_PEAK = sympy.Function("Z")
_WIDE = real("B")[0]


def _ridge() -> Step:
    """N P_S where Σ over pairs of columns is m², that of rows 0, and sinc² j is 0."""
    known = zip((*_WAVES, _PEAK), (m**2, ZERO, ZERO), strict=True)
    told = tuple(Claim(w(z), "=", v, over=(z,)) for w, v in known)
    given = (*COUNTS, *told)
    at = [
        Step(Claim(h.left.xreplace({z: ZERO}), "=", h.right, given), by.Instance(((z, ZERO),)),
             (Step(replace(h, given=given, over=()), by.Given()),))
        for h in told
    ]  # fmt: skip
    (x, y, peak), (_, _, fine_x, fine_y) = (h.claim.left for h in at), _PARTS
    kx, ky = (n * peak - fine_x) / (n - 1), (m * _WIDE - fine_y) / (m - 1)
    right = 1 + fine_x * (N * _WIDE / (n - 1) - fine_y)
    in_x = -(kx * ky - ky * fine_x) / m
    in_y = ((x - m) * kx * ky + m * kx * fine_y) / N
    in_peak = -((m - 1) * ky + fine_y) * n / (n - 1)
    claim = Claim(_joined(kx, ky, x, y, fine_x, fine_y), "=", right, given)
    return combine(claim, (in_x, at[0]), (in_y, at[1]), (in_peak, at[2]))


@cache
def correlated_on_a_ridge() -> Step:
    """At f = mj, j whole and not 0, where n does not divide g."""
    given = (*COUNTS, *whole(j), Claim(j, "!=", ZERO), *off_teeth(g, n))
    found, known = correlated(), tuple(step for _, step in above_one(m, n, given=given))
    there = Step(replace(found.claim.at((f, m * j)), given=given), by.Instance(((f, m * j),)),
                 (found, *known))  # fmt: skip
    at = ((tooth, j), (size_, m))
    moved = all_in_step().claim.at(*at)
    every = Step(Claim(moved.left, "=", moved.right, given), by.Instance(at), (all_in_step(),))
    sums = every, no_waves(g, n, given), combine(Claim(sinc2(j), "=", ZERO, given))
    values = (
        *zip(_PARTS[2:], (sinc2(j / n), sinc2(g / N)), strict=True), (_WIDE, sinc2(g / n)),
        *((w, sympy.Lambda(z, u.claim.left)) for w, u in zip((*_WAVES, _PEAK), sums, strict=True)),
    )  # fmt: skip
    own = _ridge().claim.at(*values)
    left = Step(replace(own, given=given), by.Instance(values), (_ridge(), *sums, *known))
    claim = Claim(there.claim.left, "=", own.right, given)
    return combine(claim, (1, there), (1, left), *above_one(m, n, given=given))
