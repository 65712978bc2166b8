"""Lines and k-flats as points of fewer dimensions: their rates.

Parallel k-flats in d dimensions are points in s = d − k dimensions: the integrand's spectrum is
restricted to the frequencies orthogonal to the flats, and an axis has N_k = N^(1/s) of N offsets.
In the worst case the restricted spectrum keeps its decay,

    |f^|² = c₂ ρ^(−d−1) = c₂ ρ^(−s−(k+1))   on s dimensions:   q = k + 1,

so that flats of a curved body have the rate 1 + min(b, k + 1)/(d − k), with log N at b = k + 1; a
jump that survives the integration along the flats has q = 1. (The paper, Eqs. 15, 27, Sec. 7.2.)
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim, Relation
from ..trusted.kernel import Step
from . import radial, readings
from .radial import N, alpha, b, c, c2, e, gamma, q, rho0, s
from .tactics import ONE, ZERO, positive, real

d, k = real("d k")
SCALES = positive(b, alpha, gamma, rho0, c, c2)
FLATS = (Claim(ZERO, "<=", k), Claim(k, "<", d))


def hypotheses(case: radial.Case, decay: Expr, dimension: tuple[Claim, ...]) -> tuple[Claim, ...]:
    """Signs, the dimensions, N > 1, and how b lies to q."""
    between = {"b>q": Claim(decay, "<", b), "b<q": Claim(b, "<", decay), "b=q": None}[case]
    given = (*SCALES, *dimension, *((between,) if between else ()), radial.EVENTUALLY[0])
    return tuple(h for h in given if case != "b=q" or h != Claim(ZERO, "<", b))


def placed(case: radial.Case, dimension: Expr, decay: Expr) -> tuple[tuple[Symbol, Expr], ...]:
    """Values of s, e, q (of b where they are equal): points in so many dimensions."""
    return ((s, dimension), (e, 1 / dimension), (b if case == "b=q" else q, decay))


@cache
def order(
    case: radial.Case, dimension: Expr, decay: Expr, given: tuple[Claim, ...], power: Expr
) -> Step:
    """V = Theta(N^−power), with log N at b = q, of points in so many dimensions."""
    values, found = placed(case, dimension, decay), radial.order(case)
    log = sympy.log(N) if case == "b=q" else ONE
    moved = found.claim.at(*values)
    claim = Claim(moved.left, "Theta", N**-power * log, hypotheses(case, decay, given), N)
    return Step(claim, by.Instance(values), (found,))


def worst_case(case: radial.Case, given: tuple[Claim, ...]) -> Claim:
    """Eq. 27 as printed, first row: V = O(N^(−d/(d−1))) for a jump, q = 1, on d − 1 dimensions."""
    values = placed(case, d - 1, ONE)
    left = radial.pieces(case).total.xreplace(dict(values))
    return Claim(left, "O", N ** (-d / (d - 1)), (*given, radial.EVENTUALLY[0]), N)


def curved(relation_: Relation, power: Expr, body: int) -> Claim:
    """The variance of a curved body in ``body`` dimensions by lines, b = 2, with a given order."""
    values = (*placed("b=q", sympy.Integer(body - 1), sympy.Integer(2)),)
    left = radial.pieces("b=q").total.xreplace(dict(values))
    given = (*positive(alpha, gamma, rho0, c, c2), radial.EVENTUALLY[0])
    return Claim(left, relation_, N**power, given, N)


def numbers(
    dimension: int, degree: Expr, decay: Expr, **others: Expr | int
) -> tuple[readings.Values, readings.Values]:
    """Parameters of V for ``dimension``, and those of the claims here, where all else is 1."""
    in_radial = {s: dimension, e: ONE / dimension, b: degree, q: decay}
    named = {x.name: x for x in (d, k)}
    here = {b: degree, **{named[name]: v for name, v in others.items()}}
    return readings.among_plain(in_radial), readings.among_plain(here)


@cache
def denied(claim: Claim, case: radial.Case, power: Expr, values: readings.Values,
           here: readings.Values) -> Step:  # fmt: skip
    """An order of V denied: V/order → 0 or ∞."""
    reached = readings.departure(case, power, 0, values)
    kept = tuple((x, v) for x, v in here if x in claim.free)
    return Step(replace(claim, false=True), by.Counterexample(kept), (reached,))
