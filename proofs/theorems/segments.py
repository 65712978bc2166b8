"""What lines and segments keep of a wave.

A segment of length l that samples the wave of frequency u along itself, its midpoint at phase w,

    ∫_{−l/2}^{l/2} cos 2π(w + ut) dt = cos(2πw) sin(πlu)/(πu),

so that 1/l times it is point sampling of the wave times sinc(lu); at l = 1 and whole u ≠ 0 it is 0,
as for a line. On the sphere in three dimensions, where u = ρt with t uniform in [0, 1],

    ∫_0^1 sinc²(lρt) dt <= 2/(πlρ):

a factor 1/ρ on the mean, so that the worst case ρ^(−d−1) falls as ρ^(−d−2), q = 2.
(The paper, Eqs. 10-13, 28, 29, Sec. 8.)
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .products import sine_square_at_most
from .sines import z
from .tactics import ONE, ZERO, chain, combine, positive, power_integral, real, whole

length, u, t, w, rho = real("l u t w rho")
pi, sin, cos = sympy.pi, sympy.sin, sympy.cos


def sampled_wave(low: Expr, high: Expr) -> Expr:
    """∫ cos 2π(w + ut) dt: what a segment of a wave of frequency u along itself integrates."""
    return sympy.Integral(cos(2 * pi * (w + u * t)), (t, low, high))


@cache
def segment_of_a_wave() -> Step:
    """With its midpoint at phase w it is cos(2πw) sin(πlu)/(πu), l sinc(lu) times the wave."""
    given = (*positive(length), Claim(u, "!=", ZERO))
    right = cos(2 * pi * w) * sin(pi * length * u) / (pi * u)
    claim = Claim(sampled_wave(-length / 2, length / 2), "=", right, given)
    return Step(claim, by.Antiderivative(sin(2 * pi * (w + u * t)) / (2 * pi * u)))


@cache
def segment_transform() -> Step:
    """∫ cos 2πut dt over the segment is sin(πlu)/(πu)."""
    found = segment_of_a_wave()
    claim = replace(found.claim.at((w, ZERO)), given=found.claim.given)
    return Step(claim, by.Instance(((w, ZERO),)), (found,))


@cache
def line_of_a_wave() -> Step:
    """A closed line of length 1, wherever it begins, integrates a wave along itself to 0."""
    given = (*whole(u), Claim(u, "!=", ZERO))
    claim = Claim(sampled_wave(ZERO, ONE), "=", ZERO, given)
    return Step(claim, by.Antiderivative(sin(2 * pi * (w + u * t)) / (2 * pi * u)))


@cache
def unit_segment() -> Step:
    """At l = 1 a segment keeps nothing of the waves of whole frequency along itself, as a line."""
    found, given = segment_of_a_wave(), (*whole(u), Claim(u, "!=", ZERO))
    values = ((length, ONE),)
    right = found.claim.right.xreplace(dict(values))
    at = Claim(found.claim.left.xreplace(dict(values)), "=", right, given)
    there = Step(at, by.Instance(values), (found,))
    return chain(Claim(at.left, "=", ZERO, given), there)


KEEPS_SOMETHING = Claim(
    ZERO, "<", segment_transform().claim.left ** 2,
    (*positive(length), Claim(length, "<=", ONE), *whole(u), Claim(u, "!=", ZERO)),
)  # fmt: skip
"""Sec. 8, "there is no dimensionality reduction": a segment keeps some power at every frequency."""


@cache
def unit_segment_reduces() -> Step:
    """At l = 1, u = 1 it keeps none."""
    values = ((length, ONE), (u, ONE))
    found = unit_segment()
    there = found.claim.at((u, ONE), (w, ZERO))
    at = Step(replace(there, given=()), by.Instance(((u, ONE), (w, ZERO))), (found,))
    none = combine(Claim(there.left**2, "=", ZERO), (there.left, at))
    return Step(replace(KEEPS_SOMETHING, false=True), by.Counterexample(values), (none,))


def unscaled(found: Claim, factor: Expr) -> Claim:
    """Eqs. 28, 29 as printed: l Sinc(u), without π·length, for sin(πlu)/(πu)."""
    wave = cos(2 * pi * w) if w in found.free else ONE
    return replace(found, right=wave * length * factor)


@cache
def unscaled_is_wrong(found: Step, factor: Expr) -> Step:
    """At l = 1/2, u = 1, w = 0 the segment keeps 1/π, and l Sinc(u) is sin(1)/2 or 0."""
    printed, phase = unscaled(found.claim, factor), ((w, ZERO),)
    values = ((length, ONE / 2), (u, ONE), *(phase if w in found.claim.free else ()))
    at = replace(found.claim.at(*values), given=())
    exact, other = Step(at, by.Instance(values), (found,)), printed.at(*values).right
    is_more = bool(other > at.right)
    ends = (at.right, other) if is_more else (other, at.right)
    apart = Step(Claim(ends[0], "<", ends[1]), by.Interval())
    sides = (at.left, other) if is_more else (other, at.left)
    less = combine(Claim(sides[0], "<", sides[1]), (1 if is_more else -1, exact), (1, apart))
    return Step(replace(printed, false=True), by.Counterexample(values), (less,))


def _share(x: Expr) -> Expr:
    """sinc²(x)."""
    return sympy.sinc(pi * x) ** 2


@cache
def sphere_mean() -> Step:
    """∫_0^1 sinc²(lρt) dt <= 2/(πlρ) for πlρ > 1: at most 1 below t = 1/(πlρ), 1/(πlρt)² above."""
    size = pi * length * rho
    given = (*positive(length, rho), Claim(ONE, "<", size))
    f, cut = _share(length * rho * t), 1 / size
    below, above = (sympy.Integral(f, (t, *ends)) for ends in ((ZERO, cut), (cut, ONE)))
    large = Step(Claim(ONE, "<", size, given), by.Given())
    early = combine(Claim(cut, "<", ONE, given), (1 / size, large))
    whole_ = sympy.Integral(f, (t, 0, 1))
    split = Step(Claim(whole_, "=", below + above, given), by.Range(cut), (early,))
    low = Step(Claim(below, "<=", sympy.Integral(ONE, (t, 0, cut)), given), by.Bind(),
               (_at_most_one((*given, Claim(ZERO, "<", t), Claim(t, "<", cut))),))  # fmt: skip
    tail = 1 / (size * t) ** 2
    inside = (*given, Claim(cut, "<", t), Claim(t, "<", ONE))
    start = Step(Claim(cut, "<", t, inside), by.Given())
    later = combine(Claim(ZERO, "<", t, inside), (1, start), remainder=cut)
    gap = cos(size * t) ** 2 / (size * t) ** 2
    point = combine(Claim(f, "<=", tail, inside), (0, later), remainder=gap)
    high = Step(Claim(above, "<=", sympy.Integral(tail, (t, cut, 1)), given), by.Bind(),
                (point, early))  # fmt: skip
    ends = (
        power_integral(sympy.Integral(ONE, (t, 0, cut)), [(ONE, ZERO)], given),
        power_integral(high.claim.right, [(size**-2, -sympy.Integer(2))], given, (early,)),
    )
    claim = Claim(whole_, "<=", 2 / size, given)
    return combine(claim, *((1, step) for step in (split, low, high, *ends)), remainder=size**-2)


def _at_most_one(given: tuple[Claim, ...]) -> Step:
    """sinc²(lρt) <= 1 for t > 0."""
    x = pi * length * rho * t
    square = sine_square_at_most()
    small = Claim(sin(x) ** 2, "<=", x**2, given)
    there = Step(small, by.Instance(((z, x),)), (square,))
    return combine(Claim(_share(length * rho * t), "<=", ONE, given), (x**-2, there))
