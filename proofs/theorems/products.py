"""Products of numbers between 0 and 1, and from them the envelope of jitter in d dimensions.

By induction on n, for 0 <= a(i) <= 1,

    0 <= ∏ a(i) <= 1,      1 − ∏ a(i) <= Σ (1 − a(i)),      i = 1, ..., n,

and with a(i) = sinc²(x_i), 1 − sinc²(x) <= (π²/3) x², in any dimension

    1 − ∏ sinc²(x_i) <= (π²/3) |x|²,

which makes Eq. 18 of the paper a bound for jitter: γ = 1, α = √3/π, b = 2.
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .sines import jitter_envelope, remainder, x, z
from .tactics import ONE, ZERO, combine, positive, real, whole

i, n = real("i n")
a, coordinate = sympy.Function("a"), sympy.Function("x")
pi, sin, cos = sympy.pi, sympy.sin, sympy.cos
_INDEX = (*whole(i), Claim(ONE, "<=", i))
NOT_NEGATIVE = Claim(ZERO, "<=", a(i), _INDEX, over=(i,))
AT_MOST_ONE = Claim(a(i), "<=", ONE, _INDEX, over=(i,))
UNIT = (NOT_NEGATIVE, AT_MOST_ONE)
_SIZE = (*whole(n), Claim(ZERO, "<=", n))


def product(last: Expr) -> Expr:
    """∏ a(i), i = 1, ..., last."""
    return sympy.Product(a(i), (i, 1, last))


def defect(last: Expr) -> Expr:
    """Σ (1 − a(i)), i = 1, ..., last."""
    return sympy.Sum(1 - a(i), (i, 1, last))


def _peeled(whole_: Expr, given: tuple[Claim, ...]) -> tuple[Step, Step]:
    """A sum or product to n + 1 taken apart at n, and its last term."""
    head, last = (whole_.func(whole_.function, (i, *ends)) for ends in ((1, n), (n + 1, n + 1)))
    both = head * last if isinstance(whole_, sympy.Product) else head + last
    cut = Step(Claim(whole_, "=", both, given), by.Range(n))
    term = whole_.function.xreplace({i: n + 1})
    return cut, Step(Claim(last, "=", term, given), by.Range())


def _empty(whole_: Expr, value: Expr) -> Step:
    return Step(Claim(whole_, "=", value, UNIT), by.Range())


def _term(given: tuple[Claim, ...]) -> tuple[Step, Step]:
    """0 <= a(n + 1) <= 1."""
    here = tuple(
        Step(Claim(h.left, h.relation, h.right, (*UNIT, *_INDEX)), by.Given()) for h in UNIT
    )
    at = by.Instance(((i, n + 1),))
    low = Step(Claim(ZERO, "<=", a(n + 1), given), at, (here[0],))
    return low, Step(Claim(a(n + 1), "<=", ONE, given), at, (here[1],))


@cache
def not_negative() -> Step:
    """0 <= ∏ a(i)."""
    claim = Claim(ZERO, "<=", product(n), (*UNIT, *_SIZE))
    hypothesis = Claim(ZERO, "<=", product(n))
    base = combine(Claim(ZERO, "<=", product(ZERO), UNIT), (-1, _empty(product(ZERO), ONE)),
                   remainder=1)  # fmt: skip
    given = (*UNIT, *_SIZE, hypothesis)
    cut, last = _peeled(product(n + 1), given)
    low, _ = _term(given)
    step = combine(
        Claim(ZERO, "<=", product(n + 1), given),
        (-1, cut), (-product(n), last), (product(n), low),
    )  # fmt: skip
    return Step(claim, by.Induction(n, ZERO), (base, step))


@cache
def at_most_one() -> Step:
    """∏ a(i) <= 1."""
    claim = Claim(product(n), "<=", ONE, (*UNIT, *_SIZE))
    base = combine(Claim(product(ZERO), "<=", ONE, UNIT), (1, _empty(product(ZERO), ONE)))
    given = (*UNIT, *_SIZE, Claim(product(n), "<=", ONE))
    cut, last = _peeled(product(n + 1), given)
    low, high = _term(given)
    under = Step(Claim(product(n), "<=", ONE, given), by.Given())
    step = combine(
        Claim(product(n + 1), "<=", ONE, given),
        (1, cut), (product(n), last), (0, low), (a(n + 1), under), (1, high),
    )  # fmt: skip
    return Step(claim, by.Induction(n, ZERO), (base, step))


@cache
def defect_bound() -> Step:
    """1 − ∏ a(i) <= Σ (1 − a(i)): the gap grows by (1 − a(n + 1)) (1 − ∏)."""
    claim = Claim(1 - product(n), "<=", defect(n), (*UNIT, *_SIZE))
    base = combine(
        Claim(1 - product(ZERO), "<=", defect(ZERO), UNIT),
        (-1, _empty(product(ZERO), ONE)), (-1, _empty(defect(ZERO), ZERO)),
    )  # fmt: skip
    before = Claim(1 - product(n), "<=", defect(n))
    given = (*UNIT, *_SIZE, before)
    cut, last = _peeled(product(n + 1), given)
    cut_sum, last_sum = _peeled(defect(n + 1), given)
    _, high = _term(given)
    under = Step(at_most_one().claim, by.Instance(()), (at_most_one(),))
    step = combine(
        Claim(1 - product(n + 1), "<=", defect(n + 1), given),
        (-1, cut), (-product(n), last), (-1, cut_sum), (-1, last_sum),
        (1, Step(Claim(before.left, "<=", before.right, given), by.Given())),
        (1 - a(n + 1), under), (0, high),
    )  # fmt: skip
    return Step(claim, by.Induction(n, ZERO), (base, step))


def sine_square_at_most() -> Step:
    """sin² z <= z² for z > 0, as z² − sin² z = (z − sin z)(z + sin z)."""
    given = (Claim(ZERO, "<=", z),)
    minus = combine(Claim(-ONE, "<=", cos(z)), remainder=(1 + cos(z)) ** 2 / 2 + sin(z) ** 2 / 2)
    slope = combine(Claim(ZERO, "<=", 1 + cos(z), positive(z)), (1, minus))
    plus = Step(Claim(ZERO, "<=", z + sin(z), given), by.Monotone(z, ZERO), (slope,))
    return combine(Claim(sin(z) ** 2, "<=", z**2, given), (z + sin(z), remainder(1)), (0, plus))


def sinc_square(u: Expr) -> Expr:
    """sinc²(u) = (sin(πu)/(πu))²."""
    return sin(pi * u) ** 2 / (pi * u) ** 2


def _sinc_square_is_a_share() -> tuple[Step, Step]:
    """0 <= sinc²(x(i)) <= 1 where 0 < x(i)."""
    apart = Claim(ZERO, "<", coordinate(i), _INDEX, over=(i,))
    there = Step(Claim(ZERO, "<", coordinate(i), (apart, *_INDEX)), by.Given())
    share, u = sinc_square(coordinate(i)), pi * coordinate(i)
    given = (apart, *_INDEX)
    low = combine(Claim(ZERO, "<=", share, given), (0, there), remainder=share)
    moved = Step(
        Claim(sin(u) ** 2, "<=", u**2, given),
        by.Instance(((z, u),)),
        (sine_square_at_most(), there),
    )
    return low, combine(Claim(share, "<=", ONE, given), (u**-2, moved), (0, there))


@cache
def jitter_envelope_in_d() -> Step:
    """1 − ∏ sinc²(x_i) <= (π²/3) Σ x_i² for x_i > 0, i = 1, ..., n."""
    apart = Claim(ZERO, "<", coordinate(i), _INDEX, over=(i,))
    given = (apart, *_SIZE)
    share = sinc_square(coordinate(i))
    low, high = _sinc_square_is_a_share()
    shares, defects = sympy.Product(share, (i, 1, n)), sympy.Sum(1 - share, (i, 1, n))
    values = ((a, sympy.Lambda(i, share)),)
    bound = Step(
        Claim(1 - shares, "<=", defects, given), by.Instance(values), (defect_bound(), low, high)
    )
    inside = (apart, *_INDEX)
    there = Step(Claim(ZERO, "<", coordinate(i), inside), by.Given())
    square = pi**2 / 3 * coordinate(i) ** 2
    one_axis = Step(
        Claim(1 - share, "<=", square, inside),
        by.Instance(((x, coordinate(i)),)), (jitter_envelope(), there),
    )  # fmt: skip
    squares = sympy.Sum(square, (i, 1, n))
    axes = Step(Claim(defects, "<=", squares, given), by.Bind(), (one_axis, there))
    norm = sympy.Sum(coordinate(i) ** 2, (i, 1, n))
    scale = Step(
        Claim(squares, "=", pi**2 / 3 * norm, given),
        by.Linear(((pi**2 / 3, coordinate(i) ** 2),)),
    )
    claim = Claim(1 - shares, "<=", pi**2 / 3 * norm, given)
    return combine(claim, (1, bound), (1, axes), (1, scale))
