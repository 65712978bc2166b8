"""What segments keep of waves in the mean over the sphere of directions, in every dimension.

A wave of frequency ρ at the latitude θ over the plane across a segment of length l keeps
sinc²(lρ sin θ) of its power, and on the sphere in d dimensions θ has a density in proportion to
cos^(d−2) θ. With sin θ > θ/2 below π/2, cos^(d−2) θ <= 1, sinc² <= 1 up to θ = 2/(πlρ) and
sinc²(lρ sin θ) <= 4/(πlρθ)² beyond,

    ∫_0^{π/2} cos^(d−2) θ sinc²(lρ sin θ) dθ <= 4/(πlρ)      for d >= 2 and lρ >= 1:

one power of ρ, whatever d is. In the plane (d = 2) θ is uniform; for d = 3, t = sin θ is, and
``segments.py`` has 2/(πlρ). (The paper, Sec. 8.)
"""

from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .products import sine_square_at_most
from .segments import length, rho
from .shifts import sine_above_zero
from .shifts import x as turn
from .sines import cosine_at_most_one, remainder, z
from .tactics import ONE, ZERO, combine, positive, power_integral, real, whole

theta, d, k, c = real("theta d k c")
pi, sin, cos = sympy.pi, sympy.sin, sympy.cos
TWO = sympy.Integer(2)
SIZE = pi * length * rho
GIVEN = (*whole(d), Claim(TWO, "<=", d), *positive(length, rho), Claim(ONE, "<=", length * rho))
CUT = 2 / SIZE
WEIGHT = cos(theta) ** (d - 2)
SHARE = sympy.sinc(SIZE * sin(theta)) ** 2


def latitudes(term: Expr, low: Expr, high: Expr) -> Expr:
    """∫ term dθ."""
    return sympy.Integral(term, (theta, low, high))


@cache
def powers_at_most_one() -> Step:
    """c^k <= 1 for 0 < c <= 1 and whole k >= 0."""
    unit = (*positive(c), Claim(c, "<=", ONE))
    claim = Claim(c**k, "<=", ONE, (*unit, *whole(k), Claim(ZERO, "<=", k)))
    base = combine(Claim(c**ZERO, "<=", ONE, unit))
    assumed = (*claim.given, Claim(c**k, "<=", ONE))
    before, most = (Step(Claim(h.left, "<=", ONE, assumed), by.Given())
                    for h in (assumed[-1], unit[1]))  # fmt: skip
    step = combine(Claim(c ** (k + 1), "<=", ONE, assumed), (c, before), (1, most))
    return Step(claim, by.Induction(k, ZERO), (base, step))


def _quarter(low: Expr, high: Expr) -> tuple[Claim, ...]:
    """Latitudes between these."""
    return (*GIVEN, Claim(low, "<", theta), Claim(theta, "<", high))


def _said(h: Claim, given: tuple[Claim, ...]) -> Step:
    return Step(Claim(h.left, h.relation, h.right, given), by.Given())


@cache
def more_than_half() -> Step:
    """θ/2 < sin θ for 0 < θ < π/2, as θ − θ³/6 <= sin θ and θ² < π²/4 < 3."""
    given = (*positive(theta), Claim(theta, "<", pi / 2))
    moved = Step(
        Claim(ZERO, "<=", remainder(3).claim.right.xreplace({z: theta}), given),
        by.Instance(((z, theta),)), (remainder(3),),
    )  # fmt: skip
    slope = theta / 6 * (pi / 2 + theta)
    rest = theta / 6 * (3 - pi**2 / 4)
    claim = Claim(theta / 2, "<", sin(theta), given)
    return combine(claim, (1, moved), (slope, _said(given[1], given)), remainder=rest)


@cache
def cosine_above_zero() -> Step:
    """0 < cos θ for 0 < θ < π/2: cos θ = sin(π/2 − θ)."""
    given = (*positive(theta), Claim(theta, "<", pi / 2))
    there = ONE / 2 - theta / pi
    ends = [_said(h, given) for h in given]
    inside = (
        combine(Claim(ZERO, "<", there, given), (1 / pi, ends[1])),
        combine(Claim(there, "<", ONE, given), (1 / pi, ends[0]), remainder=ONE / 2),
    )
    moved = Step(
        Claim(ZERO, "<", sin(pi * there), given), by.Instance(((turn, there),)),
        (sine_above_zero(), *inside),
    )  # fmt: skip
    return combine(Claim(ZERO, "<", cos(theta), given), (1, moved))


def _at(lemma: Step, given: tuple[Claim, ...], *uses: Step) -> Step:
    """A bound for all 0 < θ < π/2, where these are seen from ``uses``."""
    c_ = lemma.claim
    return Step(Claim(c_.left, c_.relation, c_.right, given), by.Instance(()), (lemma, *uses))


def _known(given: tuple[Claim, ...], *inside: Step) -> tuple[Step, Step, Step]:
    """0 < sin θ, θ/2 < sin θ, and cos^(d−2) θ <= 1."""
    half, above = (_at(s, given, *inside) for s in (more_than_half(), cosine_above_zero()))
    sine = combine(
        Claim(ZERO, "<", sin(theta), given), (1, half), *((0, s) for s in inside),
        remainder=theta / 2,
    )  # fmt: skip
    most = Step(Claim(cos(theta), "<=", ONE, given), by.Instance(((z, theta),)),
                (cosine_at_most_one(),))  # fmt: skip
    values = ((c, cos(theta)), (k, d - 2))
    weight = Step(
        Claim(WEIGHT, "<=", ONE, given), by.Instance(values), (powers_at_most_one(), above, most)
    )
    return sine, half, weight


@cache
def near() -> Step:
    """cos^(d−2) θ sinc² <= 1 below θ = 2/(πlρ)."""
    given = _quarter(ZERO, CUT)
    least = _said(GIVEN[-1], given)
    wide = combine(
        Claim(theta, "<", pi / 2, given),
        (1, _said(given[-1], given)), (2 / SIZE, least), remainder=pi / 2 - 2 / pi,
    )  # fmt: skip
    sine, _, weight = _known(given, wide)
    x = SIZE * sin(theta)
    small = Step(
        Claim(sin(x) ** 2, "<=", x**2, given), by.Instance(((z, x),)),
        (sine_square_at_most(), sine),
    )  # fmt: skip
    claim = Claim(WEIGHT * SHARE, "<=", ONE, given)
    return combine(claim, (x**-2, small), (SHARE, weight), (0, sine))


@cache
def far() -> Step:
    """cos^(d−2) θ sinc² <= 4/(πlρθ)² beyond it."""
    given = _quarter(CUT, pi / 2)
    later = combine(
        Claim(ZERO, "<", theta, given), (1, _said(given[-2], given)), remainder=CUT
    )  # fmt: skip
    sine, half, weight = _known(given, later)
    x, tail = SIZE * sin(theta), 4 / (SIZE * theta) ** 2
    slope = 2 * (2 * sin(theta) + theta) / (theta * sin(theta) * SIZE) ** 2
    claim = Claim(WEIGHT * SHARE, "<=", tail, given)
    return combine(
        claim, (slope, half), (SHARE, weight), (0, sine), (0, later),
        remainder=cos(x) ** 2 / x**2,
    )  # fmt: skip


@cache
def in_every_dimension() -> Step:
    """∫_0^{π/2} cos^(d−2) θ sinc²(lρ sin θ) dθ <= 4/(πlρ)."""
    least = _said(GIVEN[-1], GIVEN)
    early = combine(Claim(CUT, "<", pi / 2, GIVEN), (2 / SIZE, least), remainder=pi / 2 - 2 / pi)
    f, tail = WEIGHT * SHARE, 4 / (SIZE * theta) ** 2
    parts, whole_ = (latitudes(f, ZERO, CUT), latitudes(f, CUT, pi / 2)), latitudes(f, ZERO, pi / 2)
    split = Step(Claim(whole_, "=", parts[0] + parts[1], GIVEN), by.Range(CUT), (early,))
    bounds = latitudes(ONE, ZERO, CUT), latitudes(tail, CUT, pi / 2)
    low = Step(Claim(parts[0], "<=", bounds[0], GIVEN), by.Bind(), (near(),))
    high = Step(Claim(parts[1], "<=", bounds[1], GIVEN), by.Bind(), (far(), early))
    ends = (
        power_integral(bounds[0], [(ONE, ZERO)], GIVEN),
        power_integral(bounds[1], [(4 / SIZE**2, -TWO)], GIVEN, (early,)),
    )
    uses = ((1, s) for s in (split, low, high, *ends))
    claim = Claim(whole_, "<=", 4 / SIZE, GIVEN)
    return combine(claim, *uses, remainder=8 / (pi * SIZE**2))
