"""Exact expected spectra of the coordinate-stratified samplers, for all counts and dimensions.

The power at ν is the mean over ordered pairs of points, P_S = (1/N²) Σ_a Σ_b E cos 2πν·(s_a − s_b).
Coordinates that are stratified independently of each other multiply; ``strata.py`` gives the mean
over strata of an axis. With A_i = sinc²(ν_i/n_i), at any real frequency,

    random                N P_S = 1 + (N − 1) ∏ sinc² ν_i
    jitter                N P_S = N ∏ sinc² ν_i + 1 − ∏ A_i
    Latin hypercube       N P_S = 1 + (N − 1) ∏ (N sinc² ν_i − sinc²(ν_i/N))/(N − 1)
    uncorrelated jitter   N P_S = 1 + (N − 1) ∏_B (N ∏_B sinc² ν_i − ∏_B A_i)/(N − 1)

and at whole frequencies sinc² ν is [ν = 0].
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Literal

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import strata
from .strata import (
    blur,
    blurred_pairs,
    cos,
    nu,
    pi,
    sin,
    sinc2,
    sizes,
    substrata,
    uniform_place,
    waves,
)
from .tactics import ONE, ZERO, combine, real, whole

i, d, p, N, B, R, m = real("i d p N B R m")
at_axis, counts = sympy.Function("nu"), sympy.Function("n")
first, extent = sympy.Function("first"), sympy.Function("size")
TWO = sympy.Integer(2)
INDEX = (*whole(i), Claim(ONE, "<=", i))
STRATA = (
    Claim(counts(i), "whole", ZERO, INDEX, over=(i,)),
    Claim(ONE, "<=", counts(i), INDEX, over=(i,)),
)
"""Every n(i) is whole and at least 1."""
_WHOLE = Claim(at_axis(i), "whole", ZERO, INDEX, over=(i,))


def product(term: Expr, last: Expr = d) -> Expr:
    """∏ over the axes."""
    return sympy.Product(term, (i, 1, last))


def said(hypotheses: tuple[Claim, ...], given: tuple[Claim, ...]) -> tuple[Step, ...]:
    """Hypotheses on all i, at i."""
    return tuple(Step(Claim(h.left, h.relation, h.right, given), by.Given()) for h in hypotheses)


def pairs_of(
    frequency: Expr, wide: Expr, size: Expr, given: tuple[Claim, ...], uses: tuple[Step, ...] = ()
) -> Step:
    """Σ over pairs of ``size`` strata inside one that is 1/wide wide."""
    at = ((nu, frequency), (strata.n, wide), (strata.r, size))
    moved = substrata().claim.at(*at)
    return Step(Claim(moved.left, "=", moved.right, given), by.Instance(at), (substrata(), *uses))


def place(
    frequency: Expr, wide: Expr, given: tuple[Claim, ...], uses: tuple[Step, ...] = ()
) -> Step:
    """A uniform place in a stratum 1/wide wide."""
    at = ((nu, frequency), (strata.n, wide))
    claim = Claim(blur(frequency, wide), "=", sinc2(frequency / wide), given)
    return Step(claim, by.Instance(at), (uniform_place(), *uses))


def along_axes(term: Step, given: tuple[Claim, ...], last: Expr = d) -> Step:
    """∏ f = ∏ g over the axes from f = g."""
    sides = product(term.claim.left, last), product(term.claim.right, last)
    return Step(Claim(sides[0], "=", sides[1], given), by.Bind(), (term,))


@cache
def count_is_positive() -> Step:
    """0 < n(i)."""
    given = (*STRATA, *INDEX)
    least = said(STRATA[1:], given)[0]
    return combine(Claim(ZERO, "<", counts(i), given), (1, least), remainder=1)


@cache
def cells() -> tuple[Step, Step]:
    """Of an axis with n(i) strata: the mean over all pairs of strata, and the place in one."""
    inside = (*STRATA, *INDEX)
    n, here = counts(i), said(STRATA, inside)
    here = (*here, count_is_positive())
    total = pairs_of(at_axis(i), ONE, n, inside, here)
    mean = combine(
        Claim(blurred_pairs(at_axis(i), n, n) / n**2, "=", sinc2(at_axis(i)), inside),
        (1 / n**2, total), *((0, h) for h in here),
    )  # fmt: skip
    return mean, place(at_axis(i), n, inside, here[1:])


@cache
def random() -> Step:
    """Independent points, each uniform in the unit cube, at any real frequency."""
    given = (*sizes(N, d),)
    inside = (*given, *INDEX)
    axes = along_axes(place(at_axis(i), ONE, inside), given)
    left, right = (1 + (N - 1) * side for side in (axes.claim.left, axes.claim.right))
    return combine(Claim(left, "=", right, given), (N - 1, axes))


@cache
def jitter() -> Step:
    """One point in each cell of a grid, at any real frequency."""
    given = (*STRATA, *sizes(N, d))
    mean, inner = (along_axes(step, given) for step in cells())
    left, right = (
        N * whole_ + 1 - cell
        for whole_, cell in zip(_sides(mean), _sides(inner), strict=True)
    )  # fmt: skip
    return combine(Claim(left, "=", right, given), (N, mean), (-1, inner))


def _sides(step: Step) -> tuple[Expr, Expr]:
    return step.claim.left, step.claim.right


@cache
def latin_hypercube() -> Step:
    """On every axis one point in each of N strata, in independent random orders."""
    given = (*whole(N), Claim(TWO, "<=", N), *sizes(d))
    inside = (*given, *INDEX)
    total, one = pairs_of(at_axis(i), ONE, N, inside), place(at_axis(i), N, inside)
    different = (blurred_pairs(at_axis(i), N, N) - N * blur(at_axis(i), N)) / (N * (N - 1))
    share = (N * sinc2(at_axis(i)) - sinc2(at_axis(i) / N)) / (N - 1)
    scale = 1 / (N * (N - 1))
    pair = combine(Claim(different, "=", share, inside), (scale, total), (-scale * N, one))
    axes = along_axes(pair, given)
    left, right = (1 + (N - 1) * side for side in _sides(axes))
    return combine(Claim(left, "=", right, given), (N - 1, axes))


def block(term: Expr) -> Expr:
    """∏ over the coordinates of block B."""
    return sympy.Product(term, (i, first(B) + 1, first(B) + extent(B)))


_BLOCK = (*whole(B), Claim(ONE, "<=", B))
BLOCKS = tuple(
    claim
    for f in (first, extent)
    for claim in (
        Claim(f(B), "whole", ZERO, _BLOCK, over=(B,)), Claim(ZERO, "<=", f(B), _BLOCK, over=(B,)),
    )
)  # fmt: skip
"""Blocks of coordinates, B = 1, ..., R: i = first(B) + 1, ..., first(B) + size(B)."""


@cache
def uncorrelated_jitter() -> Step:
    """Jitter in each block of coordinates, the blocks joined in independent random orders."""
    given = (*STRATA, *BLOCKS, *whole(N, R), Claim(TWO, "<=", N), Claim(ONE, "<=", R))
    inside = (*given, *_BLOCK)
    here = said(BLOCKS, inside)
    bound = _in_block(cells()[0], inside, here), _in_block(cells()[1], inside, here)
    scale = 1 / (N * (N - 1))
    different = scale * (N**2 * bound[0].claim.left - N * bound[1].claim.left)
    share = (N * bound[0].claim.right - bound[1].claim.right) / (N - 1)
    pair = combine(
        Claim(different, "=", share, inside), (scale * N**2, bound[0]), (-scale * N, bound[1])
    )
    sides = (sympy.Product(side, (B, 1, R)) for side in _sides(pair))
    blocks = Step(Claim(next(sides), "=", next(sides), given), by.Bind(), (pair,))
    left, right = (1 + (N - 1) * side for side in _sides(blocks))
    return combine(Claim(left, "=", right, given), (N - 1, blocks))


@cache
def blocks_of_one_axis() -> Step:
    """Uncorrelated jitter with blocks of one axis, N strata each: a Latin hypercube."""
    given = (*whole(N), Claim(TWO, "<=", N), *sizes(d))
    inside = (*given, *_BLOCK)
    values = (
        (counts, sympy.Lambda(i, N)), (first, sympy.Lambda(B, B - 1)),
        (extent, sympy.Lambda(B, ONE)), (R, d),
    )  # fmt: skip
    found = uncorrelated_jitter()
    moved = found.claim.at(*values)
    left = Step(replace(moved, given=given), by.Instance(values), (found, *_single(given)))
    axis = at_axis(B)
    parts = [Step(Claim(_alone(term), "=", term.xreplace({i: B}), inside), by.Range())
             for term in (sinc2(at_axis(i)), sinc2(at_axis(i) / N))]  # fmt: skip
    share = (N * parts[0].claim.left - parts[1].claim.left) / (N - 1)
    alone = (N * sinc2(axis) - sinc2(axis / N)) / (N - 1)
    scale = 1 / (N - 1)
    one = combine(Claim(share, "=", alone, inside), (scale * N, parts[0]), (-scale, parts[1]))
    sides = [sympy.Product(side, (B, 1, d)) for side in (share, alone)]
    axes = Step(Claim(sides[0], "=", sides[1], given), by.Bind(), (one,))
    claim = Claim(moved.left, "=", 1 + (N - 1) * sides[1], given)
    return combine(claim, (1, left), (N - 1, axes))


def _single(given: tuple[Claim, ...]) -> tuple[Step, ...]:
    """What ``uncorrelated_jitter`` asks of counts and blocks: of N, of B − 1 and of 1."""
    x, index, inside = strata.theta, (*given, *INDEX), (*given, *_BLOCK)
    itself = Step(Claim(x, "whole", ZERO, whole(x)), by.Given())
    numbers = ((N, ONE, index), (B - 1, ZERO, inside), (ONE, ZERO, inside))
    steps: list[Step] = []
    for value, least, here in numbers:
        steps.append(Step(Claim(value, "whole", ZERO, here), by.Instance(((x, value),)), (itself,)))
        steps.append(combine(Claim(least, "<=", value, here), remainder=value - least))
    return tuple(steps)


def _alone(term: Expr) -> Expr:
    """∏ over the one axis of block B."""
    return sympy.Product(term, (i, B, B))


def _in_block(axis: Step, given: tuple[Claim, ...], here: tuple[Step, ...]) -> Step:
    sides = [block(side) for side in _sides(axis)]
    low, high = first(B) + 1, first(B) + extent(B)
    inside = (*given, *whole(i), Claim(low, "<=", i), Claim(i, "<=", high))
    start = combine(Claim(ONE, "<=", i, inside), *((k, h) for k, h in _from_one(inside)))
    at_least_one = Step(
        Claim(ZERO, "<", counts(i), inside), by.Instance(()), (count_is_positive(), start)
    )
    claim = Claim(axis.claim.left, "=", axis.claim.right, inside)
    moved = Step(claim, by.Instance(()), (axis, start, at_least_one))
    return Step(Claim(sides[0], "=", sides[1], given), by.Bind(), (moved, *here))


def _from_one(given: tuple[Claim, ...]) -> tuple[tuple[int, Step], ...]:
    lower = Step(Claim(first(B) + 1, "<=", i, given), by.Given())
    return ((1, lower), (1, Step(Claim(ZERO, "<=", first(B), given), by.Given())))


def one_is_zero(factor: Expr, none: Step, *uses: Step) -> Step:
    """∏ of a factor = 0 if it is 0 at i = p, 1 <= p <= d."""
    given, ends = none.claim.given, ((i, 1, p), (i, p + 1, d), (i, 1, p - 1), (i, p, p))
    head, tail, before, last = (sympy.Product(factor, range_) for range_ in ends)
    cut = Step(Claim(product(factor), "=", head * tail, given), by.Range(p), uses)
    again = Step(Claim(head, "=", before * last, given), by.Range(p - 1), (cut, *uses))
    term = Step(Claim(last, "=", none.claim.left, given), by.Range(), (again, *uses))
    rest = before * tail
    parts = ((1, cut), (tail, again), (rest, term), (rest, none), *((0, u) for u in uses))
    return combine(Claim(product(factor), "=", ZERO, given), *parts)


@cache
def whole_frequency() -> tuple[tuple[Claim, ...], Step]:
    """Hypotheses of a whole frequency that is not 0, and ∏ sinc² m_i = 0 under them."""
    given = (_WHOLE, Claim(at_axis(p), "!=", ZERO), *sizes(p), *whole(d), Claim(p, "<=", d))
    one = combine(Claim(sinc2(m), "=", ZERO, (*whole(m), Claim(m, "!=", ZERO))))
    here = Step(Claim(at_axis(i), "whole", ZERO, (_WHOLE, *INDEX)), by.Given())
    there = Step(Claim(at_axis(p), "whole", ZERO, given), by.Instance(((i, p),)), (here,))
    none = Step(
        Claim(sinc2(at_axis(p)), "=", ZERO, given), by.Instance(((m, at_axis(p)),)), (one, there)
    )
    return given, one_is_zero(sinc2(at_axis(i)), none)


def at_whole_frequencies(spectrum: Callable[[], Step], coefficient: Expr, right: Expr) -> Step:
    """The spectrum where ∏ sinc² m_i, which it has with this coefficient, is 0."""
    found, (about, none) = spectrum(), whole_frequency()
    given = tuple(dict.fromkeys((*found.claim.given, *about)))
    return combine(Claim(found.claim.left, "=", right, given), (1, found), (coefficient, none))


@cache
def random_at_whole_frequencies() -> Step:
    """N P_S = 1 at whole m ≠ 0."""
    return at_whole_frequencies(random, N - 1, ONE)


@cache
def jitter_at_whole_frequencies() -> Step:
    """N P_S = 1 − ∏ sinc²(m_i/n_i) at whole m ≠ 0."""
    inner = product(sinc2(at_axis(i) / counts(i)))
    return at_whole_frequencies(jitter, N, 1 - inner)


def grid_axis() -> Expr:
    """(1/n_i²) ΣΣ cos 2πm_i (j − k)/n_i: the power of a regular grid along one axis."""
    return waves(2 * pi * at_axis(i) / counts(i), counts(i)) / counts(i) ** 2


@cache
def grid_between_teeth() -> Step:
    """P_S = 0 where one n_p does not divide m_p."""
    off = Claim(sin(pi * at_axis(p) / counts(p)), "!=", ZERO)
    given = (*STRATA, _WHOLE, *sizes(p), *whole(d), Claim(p, "<=", d), off)
    number = strata.r
    single = (*sizes(number), *whole(m), Claim(sin(pi * m / number), "!=", ZERO))
    at = ((strata.theta, 2 * pi * m / number),)
    moved = strata.all_pairs().claim.at(*at)
    pairs = Step(Claim(*_equal(moved), single), by.Instance(at), (strata.all_pairs(),))
    total = waves(2 * pi * m / number, number) / number**2
    inverse = 1 / (number * sin(pi * m / number)) ** 2
    none = combine(Claim(total, "=", ZERO, single), (inverse, pairs))
    here = said((*STRATA, _WHOLE), (*STRATA, _WHOLE, *INDEX))
    there = tuple(
        Step(replace(h.claim.at((i, p)), given=given), by.Instance(((i, p),)), (h,)) for h in here
    )
    positive_ = Step(Claim(ZERO, "<", counts(p), given), by.Instance(((i, p),)),
                     (count_is_positive(),))  # fmt: skip
    values = ((m, at_axis(p)), (number, counts(p)))
    zero = none.claim.at(*values)
    off_tooth = Step(Claim(*_equal(zero), given), by.Instance(values), (none, *there, positive_))
    known = along_axes(_grid_is_defined(), given), *there, positive_
    return one_is_zero(grid_axis(), off_tooth, *known)


def _equal(c: Claim) -> tuple[Expr, Literal["="], Expr]:
    return c.left, "=", c.right


def _grid_is_defined() -> Step:
    inside = (*STRATA, *INDEX)
    here = (*said(STRATA, inside), count_is_positive())
    return combine(Claim(grid_axis(), "=", grid_axis(), inside), *((0, h) for h in here))


@cache
def all_in_step() -> Step:
    """Σ_k Σ_j cos 2πm (j − k) = r² over r strata, for whole m."""
    number, j, k = strata.r, strata.j, strata.k
    single = (*sizes(number), *whole(m))
    near = (*single, *whole(j, k))
    wave = combine(Claim(cos(2 * pi * m * (j - k)), "=", ONE, near))
    outer = (*single, *whole(k))
    sums = sympy.Sum(wave.claim.left, (j, 1, number)), sympy.Sum(ONE, (j, 1, number))
    line = Step(Claim(sums[0], "=", sums[1], outer), by.Bind(), (wave,))
    total = waves(2 * pi * m, number)
    lines = Step(Claim(total, "=", strata.ones().claim.left, single), by.Bind(), (line,))
    return combine(Claim(total, "=", number**2, single), (1, lines), (1, strata.ones()))


@cache
def grid_on_teeth() -> Step:
    """P_S = 1 where every n_i divides m_i = n_i k_i."""
    inside = (*STRATA, _WHOLE, *INDEX)
    number, full = strata.r, all_in_step()
    size = combine(
        Claim(full.claim.left / number**2, "=", ONE, full.claim.given), (number**-2, full)
    )
    here = (*said((*STRATA, _WHOLE), inside), count_is_positive())
    values = ((m, at_axis(i)), (number, counts(i)))
    moved = size.claim.at(*values)
    one = Step(Claim(*_equal(moved), inside), by.Instance(values), (size, *here))
    given = (*STRATA, _WHOLE, *sizes(d))
    axes, ones_ = along_axes(one, given), product_of_ones()
    return combine(Claim(axes.claim.left, "=", ONE, given), (1, axes), (1, ones_))


def product_of_ones() -> Step:
    """∏ 1 = 1."""
    total, size = product(ONE), (*whole(d), Claim(ZERO, "<=", d))
    before = Claim(total, "=", ONE)
    given = (*size, before)
    head, last = total, sympy.Product(ONE, (i, d + 1, d + 1))
    cut = Step(Claim(product(ONE, d + 1), "=", head * last, given), by.Range(d))
    term = Step(Claim(last, "=", ONE, given), by.Range())
    known = Step(Claim(total, "=", ONE, given), by.Given())
    step = combine(Claim(product(ONE, d + 1), "=", ONE, given), (1, cut), (head, term), (1, known))
    base = Step(Claim(product(ONE, ZERO), "=", ONE), by.Range())
    return Step(Claim(total, "=", ONE, size), by.Induction(d, ZERO), (base, step))
