"""A random shift of the points and the variance it leaves: Parseval's identity on a grid of shifts.

Shifts by t/M, t = 1, ..., M, are exact for waves of order below M: with

    Σ_t cos 2πqt/M = Σ_t sin 2πqt/M = 0     (0 < q < M),

the waves x_k(t) = A_k cos 2πkt/M − B_k sin 2πkt/M of order k <= K are orthogonal if 2K < M, and

    (1/M) Σ_t (Σ_k x_k(t))² = Σ_k (A_k² + B_k²)/2.

An integrand f = mean + Σ_k a_k cos(2πm_k·x + α_k) at points s_1, ..., s_N, shifted along a line on
which m_k·(shift) = kt/M, has A_k = (a_k/N) Σ_j cos p_jk, B_k = (a_k/N) Σ_j sin p_jk with the phases
p_jk = 2πm_k·s_j + α_k, so that A_k² + B_k² = a_k² P_S(m_k). Every finite set of frequencies
m_k, one of each pair ±m, lies so on a line (m ↦ m·z is one to one on it for some whole z; the k
that no m_k has are given a_k = 0), and a_k²/2 is the power of f at m_k and −m_k together. Hence

    Var I_N = Σ_{m ≠ 0} E P_S(m) |f^(m)|²,

for every N, M > 2K, every law of the points, and every trigonometric polynomial f; the error of
what is left of a square-integrable f is at most its norm, as I_N is a mean of N uniform points.
"""

from functools import cache

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .sines import remainder, z
from .strata import sizes, telescoped
from .tactics import ONE, ZERO, chain, combine, positive, real, whole

t, k, ell, j, w, M, K, J, q, x, theta, N, W = real("t k l j omega M K J q x theta N W")
pi, sin, cos = sympy.pi, sympy.sin, sympy.cos
half, TWO = sympy.Rational(1, 2), sympy.Integer(2)
A, B, X, G, a, phase, weight = (sympy.Function(s) for s in ("A", "B", "X", "G", "a", "p", "w"))
ENOUGH = (*sizes(M), *whole(K), Claim(ONE, "<=", K), Claim(2 * K, "<", M))
"""M shifts for waves of orders 1, ..., K."""


@cache
def sine_above_zero() -> Step:
    """0 < sin πx for 0 < x < 1, by z − z³/6 <= sin z below π/2."""
    given = (*positive(x), Claim(x, "<", ONE))
    claim = Claim(ZERO, "<", sin(pi * x), given)
    lower = (*given, Claim(x, "<", half))
    moved = Step(
        Claim(ZERO, "<=", remainder(3).claim.right.xreplace({z: pi * x}), lower),
        by.Instance(((z, pi * x),)), (remainder(3),),
    )  # fmt: skip
    rest = pi * x * (1 - pi**2 / 24) + pi * x * pi**2 / 6 * (half - x) * (half + x)
    below = combine(Claim(ZERO, "<", sin(pi * x), lower), (1, moved), remainder=rest)
    at = combine(Claim(ZERO, "<", ONE), remainder=1)
    upper = (*given, Claim(half, "<", x))
    above = Step(Claim(ZERO, "<", sin(pi * (1 - x)), upper), by.Instance(((x, 1 - x),)), (below,))
    turned = combine(Claim(ZERO, "<", sin(pi * x), upper), (1, above))
    return Step(claim, by.Split(x, half), (below, at, turned))


@cache
def full_turns(wave: Expr) -> Step:
    """Σ_t of a wave of order q is 0, for 0 < q < M."""
    given = (*sizes(M), *whole(q), *positive(q), Claim(q, "<", M))
    angle = 2 * pi * q / M
    is_sine = wave == sin
    ends = (
        cos(theta / 2) - cos(theta * (M + half)) if is_sine
        else sin(theta * (M + half)) - sin(theta / 2)
    )  # fmt: skip
    known = telescoped(2 * sin(theta / 2), wave(theta * t), t, ends)
    moved = known.claim.at((theta, angle))
    turns = Step(
        Claim(moved.left, "=", moved.right, given), by.Instance(((theta, angle),)), (known,)
    )
    large = combine(Claim(ZERO, "<", M, given), (1, Step(Claim(q, "<", M, given), by.Given())),
                    remainder=q)  # fmt: skip
    small = combine(Claim(q / M, "<", ONE, given),
                    (1 / M, Step(Claim(q, "<", M, given), by.Given())), (0, large))  # fmt: skip
    share = combine(Claim(ZERO, "<", q / M, given), (0, large), remainder=q / M)
    sine = Step(Claim(ZERO, "<", sin(pi * q / M), given), by.Instance(((x, q / M),)),
                (sine_above_zero(), share, small))  # fmt: skip
    total = sympy.Sum(wave(angle * t), (t, 1, M))
    return combine(Claim(total, "=", ZERO, given), (1 / (2 * sin(pi * q / M)), turns), (0, sine))


def _induction(claim: Claim, n: Symbol, base: Step, *uses: tuple[Expr | int, Step]) -> Step:
    """A claim for whole n >= 0: at 0, and from n to n + 1 by adding steps."""
    size = (*whole(n), Claim(ZERO, "<=", n))
    before = Claim(claim.left, "=", claim.right)
    given = (*claim.given, *size, before)
    after = before.at((n, n + 1))
    known = Step(Claim(before.left, "=", before.right, given), by.Given())
    step = combine(Claim(after.left, "=", after.right, given), (1, known), *uses)
    whole_ = Claim(claim.left, "=", claim.right, (*claim.given, *size))
    return Step(whole_, by.Induction(n, ZERO), (base, step))


def _cut(term: Expr, index: Symbol, n: Symbol, given: tuple[Claim, ...]) -> tuple[Step, Step]:
    head, last = sympy.Sum(term, (index, 1, n)), sympy.Sum(term, (index, n + 1, n + 1))
    cut = Step(Claim(sympy.Sum(term, (index, 1, n + 1)), "=", head + last, given), by.Range(n))
    at = term.subs(index, n + 1)
    return cut, Step(Claim(last, "=", at, given), by.Range())


@cache
def exchange(j: Symbol, k: Symbol) -> Step:
    """Σ_j Σ_k G(j, k) = Σ_k Σ_j G(j, k), j = 1, ..., J, k = 1, ..., K."""
    cell, modes = G(j, k), (*whole(K), Claim(ONE, "<=", K))
    line = sympy.Sum(cell, (k, 1, K))
    sides = sympy.Sum(line, (j, 1, J)), sympy.Sum(cell, (j, 1, J), (k, 1, K))
    nothing = sympy.Sum(ZERO, (k, 1, K))
    inside = (*modes, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", K))
    none = Step(Claim(sympy.Sum(cell, (j, 1, 0)), "=", ZERO, inside), by.Range())
    columns = Step(Claim(sides[1].xreplace({J: ZERO}), "=", nothing, modes), by.Bind(), (none,))
    empty = Step(Claim(nothing, "=", ZERO, modes), by.Linear(()))
    left = sides[0].xreplace({J: ZERO})
    base = combine(
        Claim(left, "=", sides[1].xreplace({J: ZERO}), modes),
        (1, Step(Claim(left, "=", ZERO, modes), by.Range())), (-1, columns), (-1, empty),
    )  # fmt: skip
    size = (*whole(J), Claim(ZERO, "<=", J))
    given = (*modes, *size, Claim(sides[0], "=", sides[1]))
    cut, last = _cut(line, j, J, given)
    inner = (*inside, *size)
    ends = _cut(cell, j, J, inner)
    column = chain(
        Claim(sympy.Sum(cell, (j, 1, J + 1)), "=", sympy.Sum(cell, (j, 1, J)) + G(J + 1, k), inner),
        *ends,
    )
    grown, apart = sympy.Sum(column.claim.left, (k, 1, K)), sympy.Sum(column.claim.right, (k, 1, K))
    bound = Step(Claim(grown, "=", apart, given), by.Bind(), (column,))
    parts = ((ONE, sympy.Sum(cell, (j, 1, J))), (ONE, G(J + 1, k)))
    split = sides[1] + sympy.Sum(G(J + 1, k), (k, 1, K))
    linear = Step(Claim(apart, "=", split, given), by.Linear(parts))
    claim = Claim(sides[0], "=", sides[1], modes)
    return _induction(claim, J, base, (1, cut), (1, last), (-1, bound), (-1, linear))


@cache
def renamed(k: Symbol, ell: Symbol) -> Step:
    """Σ_k X(k) = Σ_l X(l)."""
    ends = [sympy.Sum(X(s), (s, 1, K)) for s in (k, ell)]
    none = [Step(Claim(e.xreplace({K: ZERO}), "=", ZERO), by.Range()) for e in ends]
    base = combine(
        Claim(ends[0].xreplace({K: ZERO}), "=", ends[1].xreplace({K: ZERO})),
        (1, none[0]), (-1, none[1]),
    )  # fmt: skip
    given = (*whole(K), Claim(ZERO, "<=", K), Claim(ends[0], "=", ends[1]))
    cuts = [_cut(X(s), s, K, given) for s in (k, ell)]
    uses = [*((1, u) for u in cuts[0]), *((-1, u) for u in cuts[1])]
    return _induction(Claim(ends[0], "=", ends[1]), K, base, *uses)


@cache
def squared() -> Step:
    """(Σ_k X(k))² = Σ_k Σ_l X(k) X(l)."""
    given = (*whole(K), Claim(ONE, "<=", K))
    one, other = (sympy.Sum(X(s), (s, 1, K)) for s in (k, ell))
    inside = (*given, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", K))
    line = sympy.Sum(X(k) * X(ell), (ell, 1, K))
    row = Step(Claim(line, "=", X(k) * other, inside), by.Linear(((X(k), X(ell)),)))
    rows = Step(
        Claim(sympy.Sum(line, (k, 1, K)), "=", sympy.Sum(X(k) * other, (k, 1, K)), given),
        by.Bind(), (row,),
    )  # fmt: skip
    outer = Step(Claim(rows.claim.right, "=", other * one, given), by.Linear(((other, X(k)),)))
    alike = Step(Claim(one, "=", other, given), by.Instance(()), (renamed(k, ell),))
    return combine(
        Claim(one**2, "=", rows.claim.left, given), (-1, rows), (-1, outer), (one, alike)
    )


def wave(order: Expr) -> Expr:
    """x_k(t) = A_k cos 2πkt/M − B_k sin 2πkt/M."""
    angle = 2 * pi * order * t / M
    return A(order) * cos(angle) - B(order) * sin(angle)


def _products(given: tuple[Claim, ...], difference: Expr | None, uses: tuple[Step, ...]) -> Step:
    """Σ_t x_k x_l, of orders that differ by ±difference, or l = k if there is none."""
    q_minus, q_plus = difference or ZERO, k + (ell if difference is not None else k)
    other, sign = (ell, (k - ell) / q_minus) if difference is not None else (k, ONE)
    minus, plus = (2 * pi * order * t / M for order in (q_minus, q_plus))
    even, odd = A(k) * A(other), B(k) * B(other)
    parts = [
        ((even + odd) / 2, cos(minus)), ((even - odd) / 2, cos(plus)),
        (-(A(k) * B(other) + B(k) * A(other)) / 2, sin(plus)),
    ]  # fmt: skip
    if difference is not None:
        mixed = (A(k) * B(other) - B(k) * A(other)) / 2
        parts.append((sympy.cancel(sign) * mixed, sin(minus)))
    term = wave(k) * wave(other)
    total = sympy.Add(*(c * sympy.Sum(g, (t, 1, M)) for c, g in parts))
    return Step(Claim(sympy.Sum(term, (t, 1, M)), "=", total, given), by.Linear(tuple(parts)), uses)


def _turns(order: Expr, given: tuple[Claim, ...], bounds: tuple[Step, ...]) -> tuple[Step, ...]:
    """Both waves of an order between 0 and M vanish."""
    return tuple(
        Step(
            Claim(full_turns(f).claim.left.xreplace({q: order}), "=", ZERO, given),
            by.Instance(((q, order),)), (full_turns(f), *bounds),
        )
        for f in (cos, sin)
    )  # fmt: skip


def _bounds(given: tuple[Claim, ...]) -> tuple[Step, Step, Step]:
    """1 <= k <= K, 2K < M."""
    said = Claim(ONE, "<=", k, given), Claim(k, "<=", K, given), Claim(2 * K, "<", M, given)
    least, most, enough = (Step(c, by.Given()) for c in said)
    return least, most, enough


def _large(given: tuple[Claim, ...]) -> Step:
    """0 < M."""
    least = Step(Claim(ONE, "<=", M, given), by.Given())
    return combine(Claim(ZERO, "<", M, given), (1, least), remainder=1)


@cache
def different_orders(is_below: bool) -> Step:
    """Σ_t x_k x_l = 0 for l < k, or for k < l."""
    ends = (
        (Claim(ONE, "<=", ell), Claim(ell, "<=", k - 1)) if is_below
        else (Claim(k + 1, "<=", ell), Claim(ell, "<=", K))
    )  # fmt: skip
    given = (*ENOUGH, *whole(k, ell), Claim(ONE, "<=", k), Claim(k, "<=", K), *ends)
    order = k - ell if is_below else ell - k
    least, most, enough = _bounds(given)
    near = [Step(Claim(h.left, "<=", h.right, given), by.Given()) for h in ends]
    gap = near[1] if is_below else near[0]
    small = combine(Claim(ZERO, "<", order, given), (1, gap), remainder=1)
    if is_below:
        below = combine(Claim(order, "<", M, given), (1, enough), (2, most), (1, near[0]),
                        (0, least), remainder=k + 1)  # fmt: skip
        both = combine(Claim(k + ell, "<", M, given), (1, enough), (2, most), (1, gap), remainder=1)
        above = combine(Claim(ZERO, "<", k + ell, given), (1, least), (1, near[0]), remainder=2)
    else:
        below = combine(Claim(order, "<", M, given), (1, enough), (1, near[1]), (1, most),
                        (2, least), remainder=2)  # fmt: skip
        both = combine(Claim(k + ell, "<", M, given), (1, enough), (1, near[1]), (1, most))
        above = combine(Claim(ZERO, "<", k + ell, given), (2, least), (1, gap), remainder=3)
    large = _large(given)
    split = _products(given, order, (large, small))
    nothing = (*_turns(order, given, (small, below)), *_turns(k + ell, given, (above, both)))
    uses = tuple((c, s) for s in nothing for c in [split.claim.right.coeff(s.claim.left)] if c != 0)
    return combine(Claim(split.claim.left, "=", ZERO, given), (1, split), *uses, (0, large))


@cache
def same_order() -> Step:
    """Σ_t x_k² = M (A_k² + B_k²)/2."""
    given = (*ENOUGH, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", K))
    least, most, enough = _bounds(given)
    above = combine(Claim(ZERO, "<", 2 * k, given), (2, least), remainder=2)
    below = combine(Claim(2 * k, "<", M, given), (1, enough), (2, most))
    large = _large(given)
    split, nothing = _products(given, None, (large,)), _turns(2 * k, given, (above, below))
    ones = sympy.Sum(ONE, (t, 1, M))
    size = Step(Claim(ones, "=", M, given), by.Instance(()), (telescoped(ONE, ONE, t, M),))
    power = A(k) ** 2 + B(k) ** 2
    uses = ((split.claim.right.coeff(s.claim.left), s) for s in nothing)
    return combine(
        Claim(split.claim.left, "=", M * power / 2, given),
        (1, split), (power / 2, size), *uses, (0, large),
    )  # fmt: skip


def _row() -> Step:
    """Σ_l Σ_t x_k x_l = M (A_k² + B_k²)/2."""
    given = same_order().claim.given
    cell = sympy.Sum(wave(k) * wave(ell), (t, 1, M))
    ends = ((1, K), (1, k - 1), (k, K), (k, k), (k + 1, K))
    line, low, rest, one, high = (sympy.Sum(cell, (ell, *e)) for e in ends)
    zeros = [sympy.Sum(ZERO, (ell, *e)) for e in (ends[1], ends[4])]
    cut = Step(Claim(line, "=", low + rest, given), by.Range(k - 1))
    again = Step(Claim(rest, "=", one + high, given), by.Range(k))
    single = Step(Claim(one, "=", same_order().claim.left, given), by.Range())
    uses: list[Step] = [cut, again, single, same_order()]
    for total, none, is_below in ((low, zeros[0], True), (high, zeros[1], False)):
        uses += [
            Step(Claim(total, "=", none, given), by.Bind(), (different_orders(is_below),)),
            Step(Claim(none, "=", ZERO, given), by.Linear(())),
        ]
    return chain(Claim(line, "=", same_order().claim.right, given), *uses)


def instance(
    step: Step, given: tuple[Claim, ...], *values: tuple[Expr, Expr], uses: tuple[Step, ...] = ()
) -> Step:
    """An equation at other values."""
    moved = step.claim.at(*values)
    return Step(Claim(moved.left, "=", moved.right, given), by.Instance(values), (step, *uses))


@cache
def parseval() -> Step:
    """Σ_t (Σ_k x_k(t))² = (M/2) Σ_k (A_k² + B_k²)."""
    at_t = (*ENOUGH, *whole(t), Claim(ONE, "<=", t), Claim(t, "<=", M))
    at_k = same_order().claim.given
    square = instance(squared(), at_t, (X, sympy.Lambda(k, wave(k))))
    shifts = (t, 1, M)
    squares, doubles = (
        sympy.Sum(side, shifts) for side in (square.claim.left, square.claim.right)
    )  # fmt: skip
    expanded = Step(Claim(squares, "=", doubles, ENOUGH), by.Bind(), (square,))
    line = sympy.Sum(wave(k) * wave(ell), (ell, 1, K))
    outer = exchanged(line, t, M, k, ENOUGH)
    inner = exchanged(wave(k) * wave(ell), t, M, ell, at_k)
    row = _row()
    row_ = chain(Claim(inner.claim.left, "=", row.claim.right, at_k), inner, row)
    power = A(k) ** 2 + B(k) ** 2
    rows = sympy.Sum(row.claim.right, (k, 1, K))
    diagonal = Step(Claim(outer.claim.right, "=", rows, ENOUGH), by.Bind(), (row_,))
    total = M / 2 * sympy.Sum(power, (k, 1, K))
    scale = Step(Claim(rows, "=", total, ENOUGH), by.Linear(((M / 2, power),)))
    return chain(Claim(squares, "=", total, ENOUGH), expanded, outer, diagonal, scale)


def exchanged(
    term: Expr, outer: Symbol, size: Expr, mode: Symbol, given: tuple[Claim, ...]
) -> Step:
    """Σ_outer Σ_mode term = Σ_mode Σ_outer term, outer = 1, ..., size."""
    places = real("y v")
    cell = sympy.Lambda(places, term.xreplace({outer: places[0], mode: places[1]}))
    return instance(exchange(outer, mode), given, (J, size), (G, cell))
