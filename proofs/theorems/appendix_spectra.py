"""Jittered points and lines in their normalisations, and the monomial that bounds them.

With m whole and not 0, counts n_i and P_S the mean over pairs of points,

    N² P_S = N (1 − ∏ sinc²(m_i/n_i)),      N² at m = 0,

and for equal counts n_i = N^(1/d), m_i > 0,

    1 − ∏ sinc²(m_i/N^(1/d)) <= (π²/3) |m|²/N^(2/d):

γ = 1, α = √3/π, b = 2. No κ makes a monomial κx² of 1 − sinc² x: κ from x = 1/4 fails at x = 1/2.
Lines along an axis of the torus have this spectrum of d − 1 coordinates where the frequency u along
them is 0, and no power elsewhere, since ∫_0^1 cos 2πut dt = 0. (The paper, Appendix A, Eqs. 30-36.)
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import stratified_spectra as stratified
from .exponential_sums import N, jitter_on_an_axis, m, sinc_square
from .jitter_bounds import jitter_from_above, jitter_from_below, level_not_negative
from .products import coordinate, i
from .products import n as axes
from .rays import given
from .segments import line_of_a_wave, sampled_wave, u, w
from .strata import ones, r
from .tactics import ONE, ZERO, combine, positive, real, whole

d, kappa, x = real("d kappa x")
pi, TWO = sympy.pi, sympy.Integer(2)
mode = sympy.Function("m")
_AXIS = jitter_on_an_axis().claim
_UNSCALED = 1 - (sympy.sin(pi * m) / (pi * m)) ** 2


@cache
def jitter(scale: Expr) -> Step:
    """scale · N P_S = scale (1 − ∏ sinc²(m_i/n_i)), in every dimension."""
    found = stratified.jitter_at_whole_frequencies()
    c = found.claim
    extra = positive(N) if scale.has(N) else ()
    claim = Claim(scale * c.left, "=", scale * c.right, (*c.given, *extra))
    return combine(claim, (scale, found))


@cache
def all_points_at_0(scale: Expr) -> Step:
    """scale · ΣΣ 1 over N points."""
    moved = ones().claim.at((r, N))
    there = Step(moved, by.Instance(((r, N),)), (ones(),))
    return combine(
        Claim(scale * moved.left, "=", sympy.expand(scale * N**2), moved.given), (scale, there)
    )


def unscaled(scale: Expr) -> Claim:
    """Eqs. 30-32 as printed, on an axis: Sinc²(πm) for sinc²(m/N)."""
    return Claim(scale * _AXIS.left, "=", scale * _UNSCALED / N, _AXIS.given)


@cache
def unscaled_denied(scale: Expr) -> Step:
    """At N = 2, m = 1 the power is (1 − 4/π²)/2 and not 1/2."""
    printed, values = unscaled(scale), ((N, TWO), (m, ONE))
    there, found = printed.at(*values), jitter_on_an_axis()
    at = replace(found.claim.at(*values), given=())
    exact = Step(at, by.Instance(values), (found,))
    below = Step(Claim(at.right, "<", _UNSCALED.xreplace(dict(values)) / 2), by.Interval())
    factor = scale.xreplace(dict(values))
    less = combine(Claim(there.left, "<", there.right), (factor, exact), (factor, below))
    return Step(replace(printed, false=True), by.Counterexample(values), (less,))


_SIZE = (*whole(d), Claim(TWO, "<=", d), *positive(N))
_INDEX = (*whole(i), Claim(ONE, "<=", i))
_MODES = (Claim(ZERO, "<", mode(i), _INDEX, over=(i,)), *_SIZE)


@cache
def _frequencies(dimension: Expr) -> tuple[tuple[tuple[object, Expr], ...], Step]:
    """x_i = m_i/N^(1/dimension) > 0 in so many dimensions."""
    scaled = mode(i) / N ** (1 / dimension)
    here = (*_MODES, *_INDEX)
    there = given(here, Claim(ZERO, "<", mode(i)))
    apart = combine(Claim(ZERO, "<", scaled, here), (N ** (-1 / dimension), there))
    return ((coordinate, sympy.Lambda(i, scaled)), (axes, dimension)), apart


@cache
def monomial(dimension: Expr, scale: Expr) -> Step:
    """scale (1 − ∏ sinc²(m_i/N^(1/s))) <= scale (π²/3) |m|²/N^(2/s), s the dimension."""
    values, apart = _frequencies(dimension)
    found = jitter_from_above()
    moved = found.claim.at(*values)
    at = Step(replace(moved, given=_MODES), by.Instance(values), (found, apart))
    (level,), share = moved.right.atoms(sympy.Sum), N ** (-2 / dimension)
    norm = sympy.Sum(mode(i) ** 2, (i, 1, dimension))
    parts = Step(Claim(level, "=", share * norm, _MODES), by.Linear(((share, mode(i) ** 2),)))
    right = scale * pi**2 / 3 * norm * share
    claim = Claim(scale * moved.left, "<=", right, _MODES)
    return combine(claim, (scale, at), (scale * pi**2 / 3, parts))


@cache
def from_below(dimension: Expr, scale: Expr) -> Step:
    """With Y = (π²/3) Σ (m_i/N^(1/s))² it is at least scale Y/(1 + Y)."""
    values, apart = _frequencies(dimension)
    at: list[Step] = []
    for found in (level_not_negative(), jitter_from_below()):
        moved = replace(found.claim.at(*values), given=_MODES)
        at.append(Step(moved, by.Instance(values), (found, apart, *at)))
    low = at[1].claim
    claim = replace(low, left=scale * low.left, right=scale * low.right)
    return combine(claim, (0, at[0]), (scale, at[1]))


_QUARTER = ONE / 4


def _share(point: Expr) -> Expr:
    return (sympy.sin(pi * point) / (pi * point)) ** 2


def equality(scale: Expr) -> Claim:
    """Eqs. 33, 34, 36 as printed: a monomial for all x below its end, κ from x = 1/4."""
    fixed = Claim(kappa / 16, "=", 1 - _share(_QUARTER))
    signs = (*positive(x), Claim(x, "<", ONE), *(positive(N) if scale.has(N) else ()))
    return Claim(scale * (1 - _share(x)), "=", scale * kappa * x**2, (fixed, *signs))


@cache
def equality_denied(scale: Expr) -> Step:
    """1 − sinc²(1/2) = 0.594..., and four times 1 − sinc²(1/4) = 0.189... is 0.757..."""
    values = (
        (kappa, 16 * (1 - _share(_QUARTER))),
        (x, ONE / 2),
        *(((N, ONE),) if scale.has(N) else ()),
    )
    there = equality(scale).at(*values)
    below = Step(Claim(there.left, "<", there.right), by.Interval())
    return Step(replace(equality(scale), false=True), by.Counterexample(values), (below,))


LINES = _AXIS.left * sampled_wave(ZERO, ONE).xreplace({w: ZERO}) ** 2
"""The power at (m, u) of N jittered lines of length 1 along the second axis of the plane."""
WITHOUT_DELTA = Claim(LINES, "=", (1 - sinc_square(m)) / N, (*_AXIS.given, *whole(u)))
"""Eq. 35 as printed, its argument scaled: no δ(ν·l^∥)."""


@cache
def no_power_along_lines() -> Step:
    """At u ≠ 0 there is none."""
    here = (*_AXIS.given, *whole(u), Claim(u, "!=", ZERO))
    found = line_of_a_wave()
    moved = found.claim.at((w, ZERO))
    none = Step(replace(moved, given=here), by.Instance(((w, ZERO),)), (found,))
    return combine(Claim(LINES, "=", ZERO, here), (_AXIS.left * moved.left, none))


@cache
def without_delta_denied() -> Step:
    """At N = 2, m = u = 1 the power is 0 and not (1 − 4/π²)/2."""
    values = ((N, TWO), (m, ONE), (u, ONE))
    there, found = WITHOUT_DELTA.at(*values), no_power_along_lines()
    none = Step(replace(found.claim.at(*values), given=()), by.Instance(values), (found,))
    above = Step(Claim(ZERO, "<", there.right), by.Interval())
    less = combine(Claim(there.left, "<", there.right), (1, none), (1, above))
    return Step(replace(WITHOUT_DELTA, false=True), by.Counterexample(values), (less,))


@cache
def lines_in_the_plane() -> Step:
    """The power is that of the offsets, times (∫_0^1 cos 2πut dt)², which is δ(ν·l^∥) here."""
    found, along = jitter_on_an_axis(), sampled_wave(ZERO, ONE).xreplace({w: ZERO}) ** 2
    claim = Claim(LINES, "=", along * found.claim.right, _AXIS.given)
    return combine(claim, (along, found))
