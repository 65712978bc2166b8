"""Exponents of derived profiles against the exact spectra, measured in 50-digit arithmetic.

At frequencies |m| = N^x below saturation a profile of monomials (b_j, e_j) says
N·P_S = C N^E(x) (1 + o(1)), E(x) = max_j b_j (x − e_j). Between N and N² the constant C cancels in

    (log P(N²) − log P(N)) / log N = E(x) + (terms left over) / log N.

What is left over is rounding of m to whole numbers, relative N^-x, and the next terms of the
series, relative N^-2(edge − x) or so. With log N > 500 and x at most three quarters of the edge
the quotient is E(x) to well within the tolerance.
"""

from itertools import pairwise

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from specrate.numerics.integrands.protocol import mp
from specrate.numerics.spectra import counts_by_growth, scaled_power
from specrate.theory.expansions import Comb, Powers, Series, SeriesTerm
from specrate.theory.orders import Order
from specrate.theory.profiles import SaturatingMonomial, newton_polygon, saturated_order, tie
from specrate.theory.rates import profile_of
from specrate.theory.regions import region_of_support, regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import Range, symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import samplers, supports

DIGITS = 50
TOLERANCE = 2e-3
HALVES = (0, Rational(1, 4), Rational(1, 2), Rational(3, 4))


def edge_of(profile):
    """x at which N·P saturates at |m| = N^x."""
    return min(m.effective for m in profile)


def exponent_at(profile, x):
    """E(x): the largest of b_j (x − e_j) below saturation and the first alias."""
    return max(m.degree * (x - m.effective) for m in profile if m.degree is not sympy.oo)


def is_off_teeth(sampler, direction):
    """Whether no coordinate is a multiple of a count that stays fixed (combs have teeth there)."""
    fixed = [g.constant for g in sampler.layout.growth.values() if g.exponent == 0]
    return not any(c % k == 0 for c in direction if c for k in fixed)


def measured(sampler, direction, x, log10_n):
    """log10 of N·P_S at m = N^x times a direction of whole numbers, and the m used."""
    with mp.workdps(3 * log10_n + DIGITS):
        n = mp.mpf(10) ** log10_n
        counts = counts_by_growth(sampler.layout, n)
        scale = mp.power(n, mp.mpf(x.p) / x.q) if x else mp.mpf(1)
        m = [int(mp.nint(c * scale)) for c in direction]
    with mp.workdps(DIGITS):
        return mp.log10(scaled_power(sampler, counts, m))


def log10_n_for(edge):
    """log10 N large enough that three quarters of the edge lie far below it."""
    return max(240, int(12 / edge)) if edge else 240


@given(samplers(), st.data())
def test_exponents_of_profiles_are_those_of_the_spectrum(sampler, data):
    support = data.draw(supports(sampler), label="support")
    profile = profile_of(sampler, region_of_support(sampler.layout, support))
    sizes = data.draw(st.lists(st.integers(1, 3), min_size=len(support), max_size=len(support)))
    direction = [0] * int(sampler.dim)
    for i, c in zip(support, sizes, strict=True):
        direction[i - 1] = c
    steps = [m for m in profile if m.degree is sympy.oo]
    assume(not steps or is_off_teeth(sampler, direction))
    edge = edge_of(profile)
    log10_n = log10_n_for(edge)
    for x in dict.fromkeys(edge * Rational(h) for h in HALVES):
        if len(steps) == len(profile):
            _is_silent(sampler, direction, x, log10_n)
            continue
        small, large = (measured(sampler, direction, x, k) for k in (log10_n, 2 * log10_n))
        found = (large - small) / log10_n
        assert found == pytest.approx(float(exponent_at(profile, x)), abs=TOLERANCE), (x, profile)


def _is_silent(sampler, direction, x, log10_n):
    """Below the first alias a comb is exactly zero."""
    assert measured(sampler, direction, x, log10_n) == -mp.inf
