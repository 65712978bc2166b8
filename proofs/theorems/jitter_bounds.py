"""Jitter from below: its spectrum lies between Y/(1 + Y) and min(1, Y), Y = (π²/3)|x|².

The Padé bound of the cosine, for w >= 0,

    0 <= 5w² − 12 + (12 + w²) cos w,

comes from 1 − w²/2 + w⁴/24 − w⁶/720 <= cos w up to w = 4, and from −1 <= cos w beyond. At w = 2πx
it says sinc²(x) <= 1/(1 + y), y = (π²/3) x². With factors 0 <= a(i) <= 1/(1 + y(i)), by induction,

    (1 + Σ y(i)) ∏ a(i) <= 1,

so that for jitter in any dimension, x_i = m_i/n_i > 0,

    Y/(1 + Y) <= 1 − ∏ sinc²(x_i) <= min(1, Y),      min(1, Y)/2 <= Y/(1 + Y):

Eq. 18 of the paper with γ = 1, α = √3/π, b = 2 holds for jitter on both sides within a factor 2.
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .products import coordinate, jitter_envelope_in_d, not_negative, sinc_square
from .sines import remainder, x, z
from .tactics import ONE, ZERO, combine, positive, real, whole

i, n = real("i n")
a, y = sympy.Function("a"), sympy.Function("y")
pi, cos = sympy.pi, sympy.cos
INDEX = (*whole(i), Claim(ONE, "<=", i))
SHARES = (
    Claim(ZERO, "<=", a(i), INDEX, over=(i,)),
    Claim(ZERO, "<=", y(i), INDEX, over=(i,)),
    Claim((1 + y(i)) * a(i), "<=", ONE, INDEX, over=(i,)),
)
SIZE = (*whole(n), Claim(ZERO, "<=", n))
APART = Claim(ZERO, "<", coordinate(i), INDEX, over=(i,))
_FROM_0 = (Claim(ZERO, "<=", z),)


def said(hypotheses: tuple[Claim, ...], h: Claim) -> Step:
    """A hypothesis, at the values of its quantified symbols."""
    return Step(Claim(h.left, h.relation, h.right, hypotheses), by.Given())


def _rising(f: Expr, below: Step) -> Step:
    """0 <= f(z) from f(0) = 0 and 0 <= f'(z)."""
    slope = combine(Claim(ZERO, "<=", f.diff(z), positive(z)), (1, below))
    return Step(Claim(ZERO, "<=", f, _FROM_0), by.Monotone(z, ZERO), (slope,))


@cache
def cosine_from_below() -> Step:
    """1 − z²/2 + z⁴/24 − z⁶/720 <= cos z."""
    sine = _rising(z - z**3 / 6 + z**5 / 120 - sympy.sin(z), remainder(4))
    return _rising(cos(z) - 1 + z**2 / 2 - z**4 / 24 + z**6 / 720, sine)


@cache
def cosine_pade() -> Step:
    """0 <= 5z² − 12 + (12 + z²) cos z for z >= 0."""
    value, four = 5 * z**2 - 12 + (12 + z**2) * cos(z), sympy.Integer(4)
    near, far = (*_FROM_0, Claim(z, "<", four)), (*_FROM_0, Claim(four, "<", z))
    room = combine(Claim(ZERO, "<=", 18 - z**2, near), (4 + z, said(near, near[1])), remainder=2)
    low = combine(
        Claim(ZERO, "<=", value, near), (12 + z**2, cosine_from_below()), (z**6 / 720, room)
    )
    wave = combine(
        Claim(-ONE, "<=", cos(z)), remainder=(1 + cos(z)) ** 2 / 2 + sympy.sin(z) ** 2 / 2
    )
    wide = combine(Claim(ZERO, "<=", z**2 - 16, far), (4 + z, said(far, far[1])))
    high = combine(Claim(ZERO, "<=", value, far), (12 + z**2, wave), (4, wide), remainder=40)
    claim = Claim(ZERO, "<=", value, _FROM_0)
    there = claim.at((z, four))
    return Step(claim, by.Split(z, four), (low, Step(there, by.Interval()), high))


def size(u: Expr) -> Expr:
    """y = (π²/3) u²."""
    return pi**2 / 3 * u**2


@cache
def sinc_square_from_above() -> Step:
    """(1 + y) sinc²(x) <= 1 for x > 0."""
    bound = cosine_pade().claim.right.xreplace({z: 2 * pi * x})
    moved = Step(
        Claim(ZERO, "<=", bound, positive(x)), by.Instance(((z, 2 * pi * x),)), (cosine_pade(),)
    )
    claim = Claim((1 + size(x)) * sinc_square(x), "<=", ONE, positive(x))
    return combine(claim, (1 / (24 * pi**2 * x**2), moved))


def product(last: Expr, factor: Expr | None = None) -> Expr:
    """∏ a(i), i = 1, ..., last."""
    return sympy.Product(a(i) if factor is None else factor, (i, 1, last))


def total(last: Expr, term: Expr | None = None) -> Expr:
    """Σ y(i), i = 1, ..., last."""
    return sympy.Sum(y(i) if term is None else term, (i, 1, last))


def peeled(e: Expr, assumed: tuple[Claim, ...]) -> tuple[Step, Step]:
    """A sum or product over i to n + 1 taken apart at n, and its last term."""
    head, last = (e.func(e.function, (i, *ends)) for ends in ((1, n), (n + 1, n + 1)))
    both = head * last if isinstance(e, sympy.Product) else head + last
    cut = Step(Claim(e, "=", both, assumed), by.Range(n))
    return cut, Step(Claim(last, "=", e.function.xreplace({i: n + 1}), assumed), by.Range())


def last_terms(hypotheses: tuple[Claim, ...], assumed: tuple[Claim, ...]) -> list[Step]:
    """Hypotheses for all i, said at n + 1."""
    at = by.Instance(((i, n + 1),))
    here = [said((*hypotheses, *INDEX), h) for h in hypotheses]
    there = [Claim(h.left, h.relation, h.right).at((i, n + 1)) for h in hypotheses]
    return [
        Step(Claim(c.left, c.relation, c.right, assumed), at, (s,))
        for c, s in zip(there, here, strict=True)
    ]


@cache
def sum_not_negative() -> Step:
    """0 <= Σ y(i)."""
    assumed = (SHARES[1], *SIZE)
    zeros = total(n, ZERO)
    here = said((SHARES[1], *INDEX), SHARES[1])
    rows = Step(Claim(zeros, "<=", total(n), assumed), by.Bind(), (here,))
    none = Step(Claim(zeros, "=", ZERO, assumed), by.Linear(()))
    return combine(Claim(ZERO, "<=", total(n), assumed), (1, rows), (-1, none))


@cache
def product_not_negative() -> Step:
    """0 <= ∏ a(i), as a(i) <= 1."""
    inside = (*SHARES, *INDEX)
    low, other, share = (said(inside, h) for h in SHARES)
    unit = combine(
        Claim(a(i), "<=", ONE, inside), (1, share), (0, low), (0, other), remainder=y(i) * a(i)
    )
    claim = Claim(ZERO, "<=", product(n), (*SHARES, *SIZE))
    return Step(claim, by.Instance(()), (not_negative(), unit))


@cache
def product_share() -> Step:
    """(1 + Σ y(i)) ∏ a(i) <= 1: the gap grows by (1 + Σ) ∏ (1 − (1 + y) a) + Σ y a ∏ at n + 1."""
    head, whole_ = total(n), product(n)
    claim = Claim((1 + head) * whole_, "<=", ONE, (*SHARES, *SIZE))
    empty = [
        Step(Claim(product(ZERO), "=", ONE, SHARES), by.Range()),
        Step(Claim(total(ZERO), "=", ZERO, SHARES), by.Range()),
    ]
    base = combine(
        Claim((1 + total(ZERO)) * product(ZERO), "<=", ONE, SHARES),
        (1 + total(ZERO), empty[0]), (1, empty[1]),
    )  # fmt: skip
    assumed = (*SHARES, *SIZE, Claim(claim.left, "<=", ONE))
    low, other, share = last_terms(SHARES, assumed)
    cuts = [*peeled(product(n + 1), assumed), *peeled(total(n + 1), assumed)]
    next_sum, next_a = total(n + 1), a(n + 1)
    step = combine(
        Claim((1 + next_sum) * product(n + 1), "<=", ONE, assumed),
        (1 + next_sum, cuts[0]), ((1 + next_sum) * whole_, cuts[1]),
        (whole_ * next_a, cuts[2]), (whole_ * next_a, cuts[3]),
        (1, said(assumed, assumed[-1])), ((1 + head) * whole_, share),
        (0, low), (0, other), (0, sum_not_negative()), (0, product_not_negative()),
        remainder=head * y(n + 1) * next_a * whole_,
    )  # fmt: skip
    return Step(claim, by.Induction(n, ZERO), (base, step))


SHARE = sinc_square(coordinate(i))
NORM = total(n, coordinate(i) ** 2)
POWER = 1 - product(n, SHARE)
"""N P_S of jitter."""
LEVEL = pi**2 / 3 * NORM
"""Y."""
JITTER = (APART, *SIZE)


@cache
def axis_shares() -> tuple[Step, ...]:
    """The hypotheses on a and y for a(i) = sinc²(x_i), y(i) = (π²/3) x_i²."""
    inside = (APART, *INDEX)
    there = said(inside, APART)
    low = combine(Claim(ZERO, "<=", SHARE, inside), (0, there), remainder=SHARE)
    square = size(coordinate(i))
    positive_size = combine(Claim(ZERO, "<=", square, inside), remainder=square)
    share = Step(
        Claim((1 + square) * SHARE, "<=", ONE, inside),
        by.Instance(((x, coordinate(i)),)), (sinc_square_from_above(), there),
    )  # fmt: skip
    return low, positive_size, share


@cache
def level() -> Step:
    """Σ (π²/3) x_i² = Y."""
    squares = total(n, size(coordinate(i)))
    reason = by.Linear(((pi**2 / 3, coordinate(i) ** 2),))
    return Step(Claim(squares, "=", LEVEL, JITTER), reason)


@cache
def level_not_negative() -> Step:
    """0 <= Y."""
    values = ((y, sympy.Lambda(i, size(coordinate(i)))),)
    squares = total(n, size(coordinate(i)))
    rows = Step(
        Claim(ZERO, "<=", squares, JITTER), by.Instance(values),
        (sum_not_negative(), axis_shares()[1]),
    )  # fmt: skip
    return combine(Claim(ZERO, "<=", LEVEL, JITTER), (1, rows), (1, level()))


@cache
def jitter_from_below() -> Step:
    """Y/(1 + Y) <= 1 − ∏ sinc²(x_i)."""
    values = ((a, sympy.Lambda(i, SHARE)), (y, sympy.Lambda(i, size(coordinate(i)))))
    shares, squares = product(n, SHARE), total(n, size(coordinate(i)))
    bound = Step(
        Claim((1 + squares) * shares, "<=", ONE, JITTER), by.Instance(values),
        (product_share(), *axis_shares()),
    )  # fmt: skip
    claim = Claim(LEVEL / (1 + LEVEL), "<=", POWER, JITTER)
    return combine(
        claim, (1 / (1 + LEVEL), bound), (-shares / (1 + LEVEL), level()),
        (0, level_not_negative()),
    )  # fmt: skip


@cache
def jitter_at_most_one() -> Step:
    """1 − ∏ sinc²(x_i) <= 1, the plateau."""
    values = ((a, sympy.Lambda(i, SHARE)), (y, sympy.Lambda(i, size(coordinate(i)))))
    shares = product(n, SHARE)
    below = Step(
        Claim(ZERO, "<=", shares, JITTER), by.Instance(values),
        (product_not_negative(), *axis_shares()),
    )  # fmt: skip
    return combine(Claim(POWER, "<=", ONE, JITTER), (1, below))


@cache
def jitter_from_above() -> Step:
    """1 − ∏ sinc²(x_i) <= Y."""
    return jitter_envelope_in_d()
