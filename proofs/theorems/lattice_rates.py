"""A wave under jitter itself, in any dimension: the best case of Table 1, with bounds for all N.

Under jitter with s strata on each of n axes, N = s^n, the wave cos 2πm·x, m_i > 0, has

    Var = (1/(2N)) (1 − ∏ sinc²(m_i/s)),    Z/(2 (1 + Z)) <= s^(n+2) Var <= Z/2,    Z = (π²/3) |m|²,

so that it is of order s^(−n−2) = N^(−1−2/n). A coordinate m_i = 0 has sinc² = 1 and drops out.
"""

from functools import cache

from ...theory.symbolic import sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .jitter_bounds import INDEX, coordinate, i, jitter_from_above, jitter_from_below, n, said
from .products import sinc_square
from .tactics import ONE, ZERO, combine, positive, real, whole

(s,) = real("s")
mode = sympy.Function("m")
pi = sympy.pi
MODES = Claim(ZERO, "<", mode(i), INDEX, over=(i,))
STRATA = (MODES, *whole(n), Claim(ONE, "<=", n), *positive(s), Claim(ONE, "<=", s))
SQUARES = sympy.Sum(mode(i) ** 2, (i, 1, n))
"""|m|²."""
WAVE = (1 - sympy.Product(sinc_square(mode(i) / s), (i, 1, n))) / (2 * s**n)
"""Var of cos 2πm·x under jitter with s^n points."""


def _at_modes(lemma: Step, given: tuple[Claim, ...], *signs: Step) -> Step:
    """A bound of the spectrum of jitter at x_i = m_i/s."""
    values = ((coordinate, sympy.Lambda(i, mode(i) / s)),)
    inside = (MODES, *INDEX, *positive(s))
    mode_ = Step(Claim(ZERO, "<", mode(i), (MODES, *INDEX)), by.Given())
    there = combine(Claim(ZERO, "<", mode(i) / s, inside), (1 / s, mode_))
    moved = lemma.claim
    left, right = (side.replace(coordinate, values[0][1]) for side in (moved.left, moved.right))
    return Step(Claim(left, "<=", right, given), by.Instance(values), (lemma, there, *signs))


def _squares_positive(given: tuple[Claim, ...]) -> Step:
    """0 < |m|²: the first square is above 0, the others not below."""
    inside = (MODES, *INDEX)
    first, rest = (sympy.Sum(mode(i) ** 2, (i, *ends)) for ends in ((1, 1), (2, n)))
    cut = Step(Claim(SQUARES, "=", first + rest, given), by.Range(ONE))
    alone = Step(Claim(first, "=", mode(1) ** 2, given), by.Range())
    here = Step(Claim(ZERO, "<", mode(i), inside), by.Given())
    there = Step(Claim(ZERO, "<", mode(1), given), by.Instance(((i, ONE),)), (here,))
    square = combine(Claim(ZERO, "<=", mode(i) ** 2, inside), remainder=mode(i) ** 2)
    zeros = sympy.Sum(ZERO, (i, 2, n))
    rows = Step(Claim(zeros, "<=", rest, given), by.Bind(), (square,))
    none = Step(Claim(zeros, "=", ZERO, given), by.Linear(()))
    return combine(
        Claim(ZERO, "<", SQUARES, given),
        (-1, cut), (-1, alone), (mode(1), there), (1, rows), (-1, none),
    )  # fmt: skip


@cache
def wave() -> Step:
    """Θ(s^(−n−2)): with Z = (π²/3)|m|², between Z/(2 (1 + Z)) and Z/2 times s^(−n−2)."""
    given, factor = STRATA, pi**2 / 3
    norm = sympy.Sum((mode(i) / s) ** 2, (i, 1, n))
    full, level = factor * SQUARES, factor * norm
    scale = Step(Claim(norm, "=", s**-2 * SQUARES, given), by.Linear(((s**-2, mode(i) ** 2),)))
    sign = _squares_positive(given)
    above_ = _at_modes(jitter_from_above(), given)
    half = s**-n / 2
    upper = combine(
        Claim(WAVE, "<=", full / 2 * s ** (-n - 2), given), (half, above_), (half * factor, scale)
    )
    wide = combine(Claim(ONE, "<=", s**2, given), (s + 1, said(given, given[-1])))
    norm_sign = combine(Claim(ZERO, "<=", norm, given), (0, sign), (-1, scale),
                        remainder=s**-2 * SQUARES)  # fmt: skip
    small = combine(
        Claim(level, "<=", full, given),
        (factor, scale),
        (factor * SQUARES * s**-2, wide),
        (0, sign),
    )
    under = _at_modes(jitter_from_below(), given, norm_sign)
    drop = combine(
        Claim(level / (1 + full), "<=", level / (1 + level), given),
        (level / ((1 + full) * (1 + level)), small), (0, sign), (0, norm_sign),
    )  # fmt: skip
    low = full / (2 * (1 + full))
    lower = combine(
        Claim(low * s ** (-n - 2), "<=", WAVE, given),
        (half, under), (half, drop), (-half * factor / (1 + full), scale), (0, sign),
    )  # fmt: skip
    claim = Claim(WAVE, "Theta", s ** (-n - 2), given, s)
    return Step(claim, by.Order((low, full / 2)), (lower, upper, sign))
