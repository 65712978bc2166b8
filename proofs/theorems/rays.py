"""The rays of frequencies of the torus do not give the rate: jitter of n³ points in 3D.

Let |f^(m)|² = |m|^−4, the mean decay of a ball. For any frequency (a, b, c), a, b, c >= 1, the
frequencies j (a, b, c) on its ray give, by 1 − ∏ sinc²(x_i) <= (π²/3)|x|² and Σ 1/j² <= 2,

    Σ_j P_S |f^|² <= Σ_j (π²/3) (j²|m|²/n²) (1/n³) (j|m|)^−4 <= 2π²/(3|m|² n^5),   every J terms:

O(N^−5/3) along every ray. But the frequencies n < a, b, c <= 2n alone, where sinc²(a/n) <= 1/2,

    Σ_{a,b,c = 1}^{2n} P_S |f^|² >= n³ (1/(2n³)) (12n²)^−2 = 1/(288 n⁴) = N^−4/3/288,

and the variance is not O(N^−5/3): rays are infinitely many, and the worst of them says nothing of
their sum. (Against Sec. 6.1 and Appendix B of the paper.)
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .products import sine_square_at_most
from .sines import jitter_envelope, x, z
from .tactics import ONE, ZERO, chain, combine, limit_of_powers, real, whole

n, a, b, c, j, J, level = real("n a b c j J L")
pi, TWO = sympy.pi, sympy.Integer(2)
F = sympy.Function("F")
SIZE = (*whole(n), Claim(ONE, "<=", n))


def given(hypotheses: tuple[Claim, ...], h: Claim) -> Step:
    """A hypothesis, at the values of its quantified symbols."""
    return Step(Claim(h.left, h.relation, h.right, hypotheses), by.Given())


def sinc_square(frequency: Expr) -> Expr:
    """sinc²(frequency/n)."""
    return sympy.sin(pi * frequency / n) ** 2 / (pi * frequency / n) ** 2


def power(one: Expr, two: Expr, three: Expr) -> Expr:
    """P_S |f^|² at a frequency."""
    shares = sinc_square(one) * sinc_square(two) * sinc_square(three)
    return (1 - shares) / n**3 / (one**2 + two**2 + three**2) ** 2


def _index(*symbols: Symbol) -> tuple[Claim, ...]:
    return tuple(h for s in symbols for h in (*whole(s), Claim(ONE, "<=", s)))


def _far(*symbols: Symbol) -> tuple[Claim, ...]:
    pairs = ((Claim(n + 1, "<=", s), Claim(s, "<=", 2 * n)) for s in symbols)
    return tuple(h for s, ends in zip(symbols, pairs, strict=True) for h in (*whole(s), *ends))


@cache
def _positive(frequency: Expr, hypotheses: tuple[Claim, ...]) -> Step:
    """0 < a frequency that is seen to be at least 1."""
    return combine(Claim(ZERO, "<", frequency, hypotheses), remainder=frequency)


@cache
def _share(frequency: Expr, hypotheses: tuple[Claim, ...]) -> tuple[Step, Step]:
    """0 <= sinc²(frequency/n) <= 1."""
    u, share = pi * frequency / n, sinc_square(frequency)
    above_0 = tuple(_positive(k, hypotheses) for k in (frequency, n))
    low = combine(Claim(ZERO, "<=", share, hypotheses), *((0, k) for k in above_0), remainder=share)
    small = Step(
        Claim(sympy.sin(u) ** 2, "<=", u**2, hypotheses), by.Instance(((z, u),)),
        (sine_square_at_most(), *above_0),
    )  # fmt: skip
    return low, combine(
        Claim(share, "<=", ONE, hypotheses), (u**-2, small), *((0, k) for k in above_0)
    )


@cache
def not_negative(hypotheses: tuple[Claim, ...]) -> Step:
    """0 <= P_S |f^|², as 1 − stu = (1 − s) + s (1 − t) + st (1 − u)."""
    (s_low, s), (t_low, t), (_, u) = (_share(k, hypotheses) for k in (a, b, c))
    first, second = sinc_square(a), sinc_square(b)
    scale = 1 / n**3 / (a**2 + b**2 + c**2) ** 2
    return combine(
        Claim(ZERO, "<=", power(a, b, c), hypotheses),
        (scale, s), (scale * first, t), (scale * first * second, u), (0, s_low), (0, t_low),
        *((0, _positive(k, hypotheses)) for k in (a, b, c, n)),
    )  # fmt: skip


@cache
def far_frequencies() -> Step:
    """1/(288 n^7) <= P_S |f^|² for n < a, b, c <= 2n."""
    here = (*SIZE, *_far(a, b, c))
    (low, _), (t_low, t), (_, u) = (_share(k, here) for k in (a, b, c))
    first, second = sinc_square(a), sinc_square(b)
    above_0 = [(0, _positive(k, here)) for k in (a, b, c, n)]
    beyond = given(here, Claim(n + 1, "<=", a))
    angle = pi * a / n
    one = combine(Claim(sympy.sin(angle) ** 2, "<=", ONE, here), remainder=sympy.cos(angle) ** 2)
    half = combine(
        Claim(first, "<=", ONE / 2, here),
        (angle**-2, one), ((a + n) / a**2 / 2, beyond),
        *above_0, remainder=(a + n) / (2 * a**2) + n**2 / a**2 * (ONE / 2 - pi**-2),
    )  # fmt: skip
    square = a**2 + b**2 + c**2
    ends = [given(here, Claim(k, "<=", 2 * n)) for k in (a, b, c)]
    room = combine(
        Claim(square, "<=", 12 * n**2, here),
        *((k + 2 * n, end) for k, end in zip((a, b, c), ends, strict=True)),
        *above_0,
    )
    wide = 12 * n**2
    least = combine(
        Claim(ONE / 2, "<=", 1 - first * sinc_square(b) * sinc_square(c), here),
        (1, half), (first, t), (first * second, u), (0, low), (0, t_low), *above_0,
    )  # fmt: skip
    return combine(
        Claim(1 / (288 * n**7), "<=", power(a, b, c), here),
        (1 / n**3 / square**2, least),
        ((wide + square) / (2 * n**3 * square**2 * wide**2), room), *above_0,
    )  # fmt: skip


@cache
def count(index: Symbol) -> Step:
    """Σ_{1}^n 1 = n."""
    size = (*whole(n), Claim(ZERO, "<=", n))
    ones, more = (sympy.Sum(ONE, (index, 1, last)) for last in (n, n + 1))
    base = Step(Claim(sympy.Sum(ONE, (index, 1, ZERO)), "=", ZERO), by.Range())
    assumed = (*size, Claim(ones, "=", n))
    last = sympy.Sum(ONE, (index, n + 1, n + 1))
    step = chain(
        Claim(more, "=", n + 1, assumed),
        Step(Claim(more, "=", ones + last, assumed), by.Range(n)),
        Step(Claim(last, "=", ONE, assumed), by.Range()),
        given(assumed, assumed[-1]),
    )
    return Step(Claim(ones, "=", n, size), by.Induction(n, ZERO), (base, step))


def _rows(index: Symbol) -> tuple[Claim, Claim]:
    """0 <= F for all, and L <= F beyond n."""
    near, far = _index(index), _far(index)
    return (
        Claim(ZERO, "<=", F(index), near, over=(index,)),
        Claim(level, "<=", F(index), far, over=(index,)),
    )


@cache
def at_least(index: Symbol) -> Step:
    """n L <= Σ_{1}^{2n} F."""
    rows = _rows(index)
    here, terms = (*rows, *SIZE), F(index)
    whole_ = sympy.Sum(terms, (index, 1, 2 * n))
    parts = sympy.Sum(terms, (index, 1, n)), sympy.Sum(terms, (index, n + 1, 2 * n))
    cut = Step(Claim(whole_, "=", parts[0] + parts[1], here), by.Range(n))
    bounds: list[Step] = []
    for part, low in zip(parts, (ZERO, level), strict=True):
        _, first, last = part.limits[0]
        inside = (*here, *whole(index), Claim(first, "<=", index), Claim(index, "<=", last))
        point = Step(Claim(low, "<=", terms, inside), by.Given())
        under = sympy.Sum(low, (index, first, last))
        bounds.append(Step(Claim(under, "<=", part, here), by.Bind(), (point,)))
    none = Step(Claim(bounds[0].claim.left, "=", ZERO, here), by.Linear(()))
    levels, ones = bounds[1].claim.left, sympy.Sum(ONE, (index, n + 1, 2 * n))
    scale = Step(Claim(levels, "=", level * ones, here), by.Linear(((level, ONE),)))
    both, few = (sympy.Sum(ONE, (index, 1, last)) for last in (2 * n, n))
    tail = Step(Claim(both, "=", few + ones, here), by.Range(n))
    counted = [
        Step(Claim(total, "=", size, here), by.Instance(((n, size),)), (count(index),))
        for total, size in ((both, 2 * n), (few, n))
    ]
    return combine(
        Claim(n * level, "<=", whole_, here),
        (-1, cut), (1, bounds[0]), (-1, none), (1, bounds[1]), (-1, scale),
        (level, tail), (-level, counted[0]), (level, counted[1]),
    )  # fmt: skip


def cube(*symbols: Symbol) -> Expr:
    """P_S |f^|² summed over these frequencies from 1 to 2n, the last outermost."""
    term = power(a, b, c)
    return sympy.Sum(term, *((s, 1, 2 * n) for s in symbols)) if symbols else term


@cache
def _sum_not_negative(*symbols: Symbol) -> Step:
    """0 <= the sum over these frequencies."""
    others = tuple(s for s in (a, b, c) if s not in symbols)
    here = (*SIZE, *_index(*others))
    if not symbols:
        return not_negative(here)
    *rest, last = symbols
    inside = (*here, *whole(last), Claim(ONE, "<=", last), Claim(last, "<=", 2 * n))
    found = _sum_not_negative(*rest)
    nothing = sympy.Sum(ZERO, (last, 1, 2 * n))
    point = Step(replace(found.claim, given=inside), by.Instance(()), (found,))
    rows = Step(Claim(nothing, "<=", cube(*symbols), here), by.Bind(), (point,))
    none = Step(Claim(nothing, "=", ZERO, here), by.Linear(()))
    return combine(Claim(ZERO, "<=", cube(*symbols), here), (1, rows), (-1, none))


@cache
def _level(*symbols: Symbol) -> Step:
    """n^k/(288 n^7) <= the sum over k of the frequencies, the others beyond n."""
    if not symbols:
        return far_frequencies()
    *rest, last = symbols
    here = (*SIZE, *_far(*(s for s in (a, b, c) if s not in symbols)))
    low, high = _sum_not_negative(*rest), _level(*rest)
    values = ((F, sympy.Lambda(last, cube(*rest))), (level, high.claim.left))
    inside = tuple(s for s in (a, b, c) if s not in symbols)
    told = Step(
        replace(low.claim, given=(*here, *_index(last))), by.Instance(()),
        (low, *(_at_least_1(s, here) for s in inside)),
    )  # fmt: skip
    claim = Claim(n * high.claim.left, "<=", cube(*symbols), here)
    return Step(claim, by.Instance(values), (at_least(last), told, high))


def _at_least_1(frequency: Symbol, hypotheses: tuple[Claim, ...]) -> Step:
    return combine(Claim(ONE, "<=", frequency, hypotheses), remainder=frequency - 1)


@cache
def lower_bound() -> Step:
    """1/(288 n⁴) <= Σ_{a,b,c = 1}^{2n} P_S |f^|²."""
    found = _level(c, b, a)
    claim = Claim(n**-4 / 288, "<=", cube(c, b, a), SIZE)
    return combine(claim, (1, found))


WHOLE = Claim(cube(c, b, a), "O", n**-5, SIZE, n)
"""Sec. 6.1: the order of every ray is the order of the whole."""


@cache
def refutation() -> Step:
    """n^5 times the whole is at least n/288."""
    total = n**5 * cube(c, b, a)
    under = combine(Claim(n / 288, "<=", total, SIZE), (n**5, lower_bound()))
    grows = limit_of_powers(n / 288, [(ONE / 288, ONE)], n, SIZE, sympy.oo)
    limit = Step(Claim(total, "->", sympy.oo, SIZE, n), by.Squeeze(), (under, grows))
    return Step(replace(WHOLE, false=True), by.Counterexample(()), (limit,))


@cache
def inverse_squares() -> Step:
    """Σ_{j=1}^J 1/j² <= 2 − 1/J."""
    size = (*whole(J), Claim(ONE, "<=", J))
    sums = [sympy.Sum(j**-2, (j, 1, last)) for last in (ONE, J, J + 1)]
    base = chain(Claim(sums[0], "<=", ONE), Step(Claim(sums[0], "=", ONE), by.Range()))
    assumed = (*size, Claim(sums[1], "<=", 2 - 1 / J))
    last = sympy.Sum(j**-2, (j, J + 1, J + 1))
    step = combine(
        Claim(sums[2], "<=", 2 - 1 / (J + 1), assumed),
        (1, Step(Claim(sums[2], "=", sums[1] + last, assumed), by.Range(J))),
        (1, Step(Claim(last, "=", (J + 1) ** -2, assumed), by.Range())),
        (1, given(assumed, assumed[-1])),
        remainder=1 / (J * (J + 1) ** 2),
    )  # fmt: skip
    claim = Claim(sums[1], "<=", 2 - 1 / J, size)
    return Step(claim, by.Induction(J, ONE), (base, step))


def _on_ray() -> tuple[Claim, ...]:
    return (*SIZE, *_index(a, b, c))


@cache
def ray_term() -> Step:
    """P_S |f^|² at j (a, b, c) is at most (π²/3)/((a² + b² + c²) n^5 j²).

    3 − s − t − u − (1 − stu) = (1 − s) (1 − t) + (1 − u) (1 − st).
    """
    here = (*_on_ray(), *_index(j))
    above_0 = [_positive(k, here) for k in (j, a, b, c, n)]
    modes, square = (j * a, j * b, j * c), a**2 + b**2 + c**2
    s, t, u = (sinc_square(k) for k in modes)
    (s_low, s_high), (t_low, t_high), (_, u_high) = (_share(k, here) for k in modes)
    both = combine(
        Claim(s * t, "<=", ONE, here), (1, t_high), (t, s_high), (0, s_low), (0, t_low),
        *((0, k) for k in above_0),
    )  # fmt: skip
    found = jitter_envelope()
    envelopes = [
        Step(replace(found.claim.at((x, k / n)), given=here), by.Instance(((x, k / n),)),
             (found, *above_0))
        for k in modes
    ]  # fmt: skip
    scale = 1 / (n**3 * j**4 * square**2)
    return combine(
        Claim(power(*modes), "<=", pi**2 / 3 / (square * n**5 * j**2), here),
        *((scale, k) for k in envelopes),
        (scale * (1 - s), t_high), (scale * (1 - u), both),
        (0, s_high), (0, u_high), *((0, k) for k in above_0),
    )  # fmt: skip


def ray(last: Expr) -> Expr:
    """Σ P_S |f^|² over the first frequencies of the ray of (a, b, c)."""
    return sympy.Sum(power(j * a, j * b, j * c), (j, 1, last))


@cache
def each_ray() -> Step:
    """Σ_{j=1}^J P_S |f^|² <= 2π²/(3 (a² + b² + c²) n^5)."""
    size = (*whole(J), Claim(ONE, "<=", J))
    here = (*_on_ray(), *size)
    inside = (*here, *whole(j), Claim(ONE, "<=", j), Claim(j, "<=", J))
    point = Step(replace(ray_term().claim, given=inside), by.Instance(()), (ray_term(),))
    bounds = sympy.Sum(point.claim.right, (j, 1, J))
    rows = Step(Claim(ray(J), "<=", bounds, here), by.Bind(), (point,))
    scale, squares = pi**2 / 3 / ((a**2 + b**2 + c**2) * n**5), sympy.Sum(j**-2, (j, 1, J))
    above_0 = [_positive(k, here) for k in (a, b, c, n, J)]
    parts = Step(
        Claim(bounds, "=", scale * squares, here), by.Linear(((scale, j**-2),)), tuple(above_0)
    )
    return combine(
        Claim(ray(J), "<=", 2 * scale, here),
        (1, rows), (1, parts), (scale, inverse_squares()), *((0, k) for k in above_0),
        remainder=scale / J,
    )  # fmt: skip
