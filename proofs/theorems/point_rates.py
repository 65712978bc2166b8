"""Rates of anisotropic point sampling in the paper's model, Eqs. 24-26, Table 1, and blue noise.

Sums of regions (``regional_sums.py``), each with N_k of its own:

    Latin hypercube      N on the axes, and a flat rest,
    multi-jitter         N on the axes, N^(1/d) elsewhere, d > 1,
    uncorrelated jitter  N, N^(1/2), N^(1/k) in blocks of 1, 2 and k = d − 3 axes, a flat rest,
    jitter               N^(1/d) everywhere (Table 1),
    an elongated sampler N^(1/d) everywhere, with two values of α.

A flat profile, b = 0, has the rate 1 whatever N_k is: (ρ/(α N_k))^0 = 1.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import regional_sums as sums
from .jitter_bounds import said
from .radial import N
from .regional_sums import TWO, Region
from .tactics import ONE, ZERO, combine, positive, real

d, k, e = real("d k e")
_SEVERAL = (Claim(ONE, "<", d),)
_BLOCK = positive(k)
HALF = sympy.Rational(1, 2)


def latin_hypercube(is_worst: bool) -> tuple[Region, ...]:
    """Eq. 24."""
    return (sums.worst(1, ONE) if is_worst else sums.best(1, ONE), sums.flat(2, is_worst))


def multi_jitter(is_worst: bool) -> tuple[Region, ...]:
    """Eq. 25."""
    region = sums.worst if is_worst else sums.best
    return region(1, ONE), region(2, 1 / d, _SEVERAL)


def uncorrelated_jitter(is_worst: bool) -> tuple[Region, ...]:
    """Eq. 26."""
    region = sums.worst if is_worst else sums.best
    blocks = region(1, ONE), region(2, HALF), region(3, 1 / k, _BLOCK)
    return (*blocks, sums.flat(4, is_worst))


def jitter(is_worst: bool) -> tuple[Region, ...]:
    """Table 1."""
    return ((sums.worst if is_worst else sums.best)(0, 1 / d, positive(d)),)


def elongated(is_worst: bool) -> tuple[Region, ...]:
    """The low frequencies of an anisotropic sampler fill an ellipse: α_1 and α_2."""
    region = sums.worst if is_worst else sums.best
    return region(1, 1 / d, positive(d)), region(2, 1 / d, positive(d))


@cache
def several_dimensions(is_worst: bool) -> tuple[Step, ...]:
    """0 < 1 − 1/d, for the powers of Eq. 25, and twice that in the best case."""
    scale = ONE if is_worst else TWO
    given = said(_SEVERAL, _SEVERAL[0])
    return (combine(Claim(ZERO, "<", scale - scale / d, _SEVERAL), (scale / d, given)),)


@cache
def eq_24(is_worst: bool) -> Step:
    """Θ(N^−1)."""
    return sums.order(latin_hypercube(is_worst), ONE)


@cache
def eq_25(is_worst: bool) -> Step:
    """Θ(N^(−1−1/d)), Θ(N^(−1−2/d))."""
    power = 1 + (ONE if is_worst else TWO) / d
    return sums.order(multi_jitter(is_worst), power, several_dimensions(is_worst))


@cache
def eq_26(is_worst: bool) -> Step:
    """Θ(N^−1)."""
    return sums.order(uncorrelated_jitter(is_worst), ONE)


@cache
def table_1(is_worst: bool) -> Step:
    """Θ(N^(−1−1/d)), Θ(N^(−1−2/d))."""
    return sums.order(jitter(is_worst), 1 + (ONE if is_worst else TWO) / d)


@cache
def ellipse(is_worst: bool) -> Step:
    """The constants of the two directions differ, the rate does not."""
    return sums.limit(elongated(is_worst), 1 + (ONE if is_worst else TWO) / d)


@cache
def block(is_worst: bool, dimensions: Expr) -> Step:
    """One block of uncorrelated jitter by itself, of 1, 2 or k axes."""
    region = sums.worst if is_worst else sums.best
    signs = () if dimensions.is_number else positive(dimensions)
    power = 1 + (ONE if is_worst else TWO) / dimensions
    return sums.order((region(0, 1 / dimensions, signs),), power)


@cache
def flat_order() -> Step:
    """b = 0: Θ(N^−1), with no N_k in it."""
    return sums.order((sums.flat(0),), ONE)


def _projective() -> Claim:
    found = sums.flat(0).share
    given = (*sums.flat(0).closed.claim.given, *positive(e))
    return Claim(found, "O", N ** (-1 - e), given, N)


PROJECTIVE = _projective()
"""A denser projection, N_k = N^e, improves the rate of Poisson disks to 1 + e."""


def _flat_lines() -> Claim:
    found = sums.flat(0).share
    given = (*sums.flat(0).closed.claim.given, Claim(TWO, "<=", d))
    return Claim(found, "O", N ** (-d / (d - 1)), given, N)


FLAT_LINES = _flat_lines()
"""Eq. 27, first row, for lines of a flat profile, b = 0."""


@cache
def no_faster() -> Step:
    """N^(1+e) V → ∞ at e = 1 and ones."""
    return _not_as_fast(PROJECTIVE, (e, ONE))


@cache
def flat_lines_are_slower() -> Step:
    """N^(d/(d−1)) V → ∞ at d = 2 and ones."""
    return _not_as_fast(FLAT_LINES, (d, TWO))


def _not_as_fast(printed: Claim, value: tuple[Expr, Expr]) -> Step:
    """Of a flat region, an order below N^−1 denied at this value and ones."""
    region = sums.flat(0)
    p = sums.parameters(0)
    values = tuple((x, ONE) for x in (p.gamma, p.alpha, p.s, p.rho0, p.c, p.c2))
    found = region.closed
    given = sums.LARGE
    moved = Step(replace(found.claim.at(*values), given=given), by.Instance(values), (found,))
    factor, constant = 1 / printed.at(value).right, region.terms[0][0].xreplace(dict(values))
    claim = Claim(factor * moved.claim.right, "->", sympy.oo, given, N)
    limit = Step(claim, by.Limit(((constant, ZERO, ONE, 0),)))
    reached = sums.transferred(moved, limit, factor)
    point = by.Counterexample((*values, value))
    return Step(replace(printed, false=True), point, (reached,))
