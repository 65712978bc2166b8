"""Jitter in 1D against power laws on the lattice of frequencies: all three cases of b = 2 and q.

An integrand with |f^(m)|² = |m|^−p has under jitter with N strata, |m| >= 1 whole,

    Var = (2/N) Σ_{m>=1} (1 − sinc²(m/N)) m^−p.

From y/(1 + y) <= 1 − sinc²(m/N) <= min(1, y), y = (π²/3) m²/N², with κ = (π²/3)/(1 + π²/3),

    p = 2, a jump, q = 1 < b:     2κ N^−2 <= Var <= 2 (π²/3 + 1) N^−2,
    p = 3, q = 2 = b:             2κ N^−3 log N <= Var <= 2 N^−3 [(π²/3)(1 + log N) + 1],
    p = 4, a kink, q = 3 > b:     2κ N^−3 <= Var <= (4π²/3) N^−3.

So Table 1 holds of jitter itself at d = 1, and between its columns stands a logarithm.
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .jitter_bounds import said, sinc_square_from_above, size
from .lattice_sums import (
    N,
    counted,
    harmonic_from_above,
    harmonic_from_below,
    m,
    squares,
    tail,
    total,
)
from .products import sinc_square
from .sines import jitter_envelope, x
from .tactics import ONE, ZERO, combine, positive, whole

_POINTS = (*whole(N), Claim(ONE, "<=", N), *positive(N))
_INSIDE = (*_POINTS, *whole(m), Claim(ONE, "<=", m), *positive(m))
LEVEL = size(ONE)
"""π²/3."""
KAPPA = LEVEL / (1 + LEVEL)
SPECTRUM = 1 - sinc_square(m / N)


def variance(p: int) -> Expr:
    """Var."""
    return 2 / N * total(SPECTRUM * m**-p, 1, sympy.oo)


@cache
def _spectrum() -> tuple[Step, Step, Step, Step]:
    """0 <= 1 − sinc², 1 − sinc² <= 1, 1 − sinc² <= y, and κ m²/N² <= 1 − sinc² for m <= N."""
    u = m / N
    share, y = sinc_square(u), size(u)
    over = Step(
        Claim((1 + y) * share, "<=", ONE, _INSIDE), by.Instance(((x, u),)),
        (sinc_square_from_above(),),
    )  # fmt: skip
    low = combine(Claim(ZERO, "<=", SPECTRUM, _INSIDE), (1, over), remainder=y * share)
    one = combine(Claim(SPECTRUM, "<=", ONE, _INSIDE), remainder=share)
    high = Step(Claim(SPECTRUM, "<=", y, _INSIDE), by.Instance(((x, u),)), (jitter_envelope(),))
    within = (*_INSIDE, Claim(m, "<=", N))
    square = combine(Claim(m**2, "<=", N**2, within), (m + N, said(within, within[-1])))
    slope = LEVEL * y / ((1 + y) * (1 + LEVEL) * N**2)
    large = combine(
        Claim(KAPPA * m**2 / N**2, "<=", SPECTRUM, within), (1 / (1 + y), over), (slope, square)
    )
    return low, one, high, large


def _scaled(bound: Step, factor: Expr) -> Step:
    """A bound times factor >= 0."""
    c = bound.claim
    return combine(Claim(factor * c.left, "<=", factor * c.right, c.given), (factor, bound))


def _head_from_above(p: int) -> Step:
    """Σ_{m<=N} <= (π²/3) N^−2 Σ_{m<=N} m^(2−p)."""
    f, g = SPECTRUM * m**-p, m ** (2 - p)
    rows = Step(
        Claim(total(f, 1, N), "<=", total(LEVEL / N**2 * g, 1, N), _POINTS), by.Bind(),
        (_scaled(_spectrum()[2], m**-p),),
    )  # fmt: skip
    scale = LEVEL / N**2
    reason = by.Linear(((scale, g),))
    same = Step(Claim(rows.claim.right, "=", scale * total(g, 1, N), _POINTS), reason)
    claim = Claim(rows.claim.left, "<=", scale * total(g, 1, N), _POINTS)
    return combine(claim, (1, rows), (1, same))


def _head_from_below(p: int) -> Step:
    """κ N^−2 Σ_{m<=N} m^(2−p) <= Σ_{m<=N}."""
    f, g, scale = SPECTRUM * m**-p, m ** (2 - p), KAPPA / N**2
    large = _scaled(_spectrum()[3], m**-p)
    rows = Step(Claim(total(scale * g, 1, N), "<=", total(f, 1, N), _POINTS), by.Bind(), (large,))
    same = Step(
        Claim(rows.claim.left, "=", scale * total(g, 1, N), _POINTS), by.Linear(((scale, g),))
    )
    return combine(
        Claim(scale * total(g, 1, N), "<=", total(f, 1, N), _POINTS), (1, rows), (-1, same)
    )


def _tail_from_above(p: int) -> Step:
    """Σ_{m>N} <= N^(1−p) for p = 2, 3: m^−p <= N^(2−p)/(m(m − 1)) there."""
    beyond = (*_INSIDE, Claim(N + 1, "<=", m), *positive(m - 1))
    low, one, _, _ = _spectrum()
    scale = ONE * N ** (2 - p)
    f = SPECTRUM * m**-p
    claim = Claim(f, "<=", scale / (m * (m - 1)), beyond)
    if p == 2:
        point = combine(claim, (m**-2, one), remainder=1 / (m**2 * (m - 1)))
    else:
        far = combine(Claim(N, "<=", m, beyond), (1, said(beyond, beyond[-2])), remainder=1)
        point = combine(
            claim, (m**-3, one), (1 / (N * m**3), far), remainder=1 / (N * m**2 * (m - 1))
        )
    return tail(f, (point, _scaled(low, m**-p)), _POINTS, N, scale)


def _taken_apart(p: int, rest: Step) -> Step:
    """The sum cut at N, where ``rest`` bounds its tail."""
    f = SPECTRUM * m**-p
    parts = total(f, 1, N), total(f, N + 1, sympy.oo)
    claim = Claim(total(f, 1, sympy.oo), "=", sum(parts), _POINTS)
    return Step(claim, by.Range(N), (rest,))


def _tail_not_negative(p: int, rest: Step) -> Step:
    """0 <= Σ_{m>N}, a tail that ``rest`` bounds."""
    f, ends = SPECTRUM * m**-p, (N + 1, sympy.oo)
    zeros = total(ZERO, *ends)
    low = _scaled(_spectrum()[0], m**-p)
    rows = Step(Claim(zeros, "<=", total(f, *ends), _POINTS), by.Bind(), (low, rest))
    none = Step(Claim(zeros, "=", ZERO, _POINTS), by.Linear(()))
    return combine(Claim(ZERO, "<=", total(f, *ends), _POINTS), (1, rows), (-1, none))


@cache
def _kink_from_above() -> Step:
    """Σ_{m>=1} at p = 4 is at most (π²/3) N^−2 Σ m^−2 <= (2π²/3) N^−2."""
    f, g, scale = SPECTRUM * m**-4, m**-2, LEVEL / N**2
    sums = (total(e, 1, sympy.oo) for e in (f, scale * g, g))
    whole_, bound, plain = sums
    same = Step(Claim(bound, "=", scale * plain, _POINTS), by.Linear(((scale, g),)), (squares(),))
    high, low = (_scaled(_spectrum()[k], m**-4) for k in (2, 0))
    rows = Step(Claim(whole_, "<=", bound, _POINTS), by.Bind(), (high, low, same))
    claim = Claim(whole_, "<=", 2 * scale, _POINTS)
    return combine(claim, (1, rows), (1, same), (scale, squares()))


@cache
def _bounds(p: int) -> tuple[Step, Step]:
    """κ N^−2 h <= Σ_{m>=1} <= ..., h = Σ_{m<=N} m^(2−p), with what stands in the heading."""
    h = total(m ** (2 - p), 1, N)
    if p == 4:
        above, whole_ = _kink_from_above(), _kink_from_above().claim.left
        cut = Step(
            Claim(whole_, "=", total(SPECTRUM * m**-4, 1, N)
                  + total(SPECTRUM * m**-4, N + 1, sympy.oo), _POINTS), by.Range(N), (above,),
        )  # fmt: skip
        rest = cut
    else:
        rest = _tail_from_above(p)
        cut = _taken_apart(p, rest)
        high = LEVEL / N**2 * h + N ** (1 - p)
        above = combine(
            Claim(cut.claim.left, "<=", high, _POINTS),
            (1, cut), (1, _head_from_above(p)), (1, rest),
        )  # fmt: skip
    below = combine(
        Claim(KAPPA / N**2 * h, "<=", cut.claim.left, _POINTS),
        (-1, cut), (1, _head_from_below(p)), (1, _tail_not_negative(p, rest)),
    )  # fmt: skip
    return below, above


@cache
def jump() -> tuple[Step, Step]:
    """p = 2: 2κ N^−2 <= Var <= 2 (π²/3 + 1) N^−2."""
    below, above = _bounds(2)
    many = Step(Claim(total(ONE, 1, N), "=", N, _POINTS), by.Instance(()), (counted(),))
    scale, low, high = 2 / N, 2 * KAPPA, 2 * (LEVEL + 1)
    lower = combine(
        Claim(low * N**-2, "<=", variance(2), _POINTS),
        (scale, below),
        (-scale * KAPPA / N**2, many),
    )
    upper = combine(
        Claim(variance(2), "<=", high * N**-2, _POINTS),
        (scale, above),
        (scale * LEVEL / N**2, many),
    )
    return lower, upper


@cache
def tie() -> tuple[Step, Step]:
    """p = 3: 2κ N^−3 log N <= Var <= 2 N^−3 [(π²/3)(1 + log N) + 1]."""
    below, above = _bounds(3)
    scale, log = 2 / N, sympy.log(N)
    lower = combine(
        Claim(2 * KAPPA * N**-3 * log, "<=", variance(3), _POINTS),
        (scale, below), (scale * KAPPA / N**2, harmonic_from_below()),
    )  # fmt: skip
    upper = combine(
        Claim(variance(3), "<=", 2 * (LEVEL * (1 + log) + 1) * N**-3, _POINTS),
        (scale, above), (scale * LEVEL / N**2, harmonic_from_above()),
    )  # fmt: skip
    return lower, upper


@cache
def kink() -> tuple[Step, Step]:
    """p = 4: 2κ N^−3 <= Var <= (4π²/3) N^−3, from below by the first term alone."""
    below, above = _bounds(4)
    h, f = total(m**-2, 1, N), m**-2
    first, rest = total(f, 1, 1), total(f, 2, N)
    cut = Step(Claim(h, "=", first + rest, _POINTS), by.Range(ONE))
    alone = Step(Claim(first, "=", ONE, _POINTS), by.Range())
    zeros = total(ZERO, 2, N)
    square = combine(Claim(ZERO, "<=", f, (*whole(m), *positive(m))), remainder=f)
    rows = Step(Claim(zeros, "<=", rest, _POINTS), by.Bind(), (square,))
    none = Step(Claim(zeros, "=", ZERO, _POINTS), by.Linear(()))
    scale, low, high = 2 / N, 2 * KAPPA, 4 * LEVEL
    share = scale * KAPPA / N**2
    lower = combine(
        Claim(low * N**-3, "<=", variance(4), _POINTS),
        (scale, below), (-share, cut), (-share, alone), (share, rows), (-share, none),
    )  # fmt: skip
    upper = combine(Claim(variance(4), "<=", high * N**-3, _POINTS), (scale, above))
    return lower, upper
