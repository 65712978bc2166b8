"""Exponents of derived profiles against the exact spectra, measured in 50-digit arithmetic.

At frequencies |m| = N^x below saturation a profile of monomials (b_j, e_j) says
N·P_S = C N^E(x) (1 + o(1)), E(x) = max_j b_j (x − e_j). Between N and N² the constant C cancels in

    (log P(N²) − log P(N)) / log N = E(x) + (terms left over) / log N.

What is left over is rounding of m to whole numbers, relative N^-x, and the next terms of the
series, relative N^-2(edge − x) or so. With log N > 500 and x at most three quarters of the edge
the quotient is E(x) to well within the tolerance.
"""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from specrate.numerics.expected_spectra.envelopes import envelope
from specrate.numerics.expected_spectra.spectra import counts_by_growth, scaled_power
from specrate.numerics.integrands.protocol import mp
from specrate.theory.combs import Comb
from specrate.theory.expansions import Powers, Series, SeriesTerm
from specrate.theory.orders import Order
from specrate.theory.profiles import SaturatingMonomial, newton_polygon, saturated_order, tie
from specrate.theory.rates import profile_of
from specrate.theory.regions import region_of_support, regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import Range, symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import every_sampler, supports

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


@given(every_sampler(), st.data())
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


def local_slope(sampler, direction, x, log10_n):
    """d log(N·P) / d log|m| between a frequency and its double."""
    with mp.workdps(3 * log10_n + DIGITS):
        n = mp.mpf(10) ** log10_n
        counts = counts_by_growth(sampler.layout, n)
        scale = mp.power(n, mp.mpf(x.p) / x.q)
        m = [int(mp.nint(c * scale)) for c in direction]
    with mp.workdps(DIGITS):
        once, twice = (scaled_power(sampler, counts, [k * c for c in m]) for k in (1, 2))
        return mp.log(twice / once) / mp.log(2)


@given(every_sampler(), st.data())
def test_degree_is_the_local_slope_in_frequency(sampler, data):
    """At fixed N the spectrum rises as |m|^b, b the degree of the monomial on top at |m| = N^x."""
    support = data.draw(supports(sampler), label="support")
    profile = profile_of(sampler, region_of_support(sampler.layout, support))
    edge = edge_of(profile)
    assume(edge > 0 and any(m.degree is not sympy.oo for m in profile))
    x = edge * Rational(1, 2)
    lines = sorted(
        (m.degree * (x - m.effective), m.degree) for m in profile if m.degree is not sympy.oo
    )
    assume(len(lines) == 1 or lines[-1][0] - lines[-2][0] > Rational(1, 20))
    direction = [int(i + 1 in support) for i in range(int(sampler.dim))]
    log10_n = max(480, int(24 / edge))  # the other lines are 10^-24 of the top one
    assert local_slope(sampler, direction, x, log10_n) == pytest.approx(
        float(lines[-1][1]), abs=TOLERANCE
    )


def line(degree, decay):
    powers = Powers((((1,) if degree == 2 else (1, 1) if degree == 4 else ()),))
    return SeriesTerm(powers, Integer(degree), sympy.sympify(decay), Integer(1))


def vertices(*terms, combs=()):
    found = newton_polygon(Series((Integer(2),), terms), combs, ())
    return [(m.degree, m.effective) for m in found]


def test_polygon_keeps_what_reaches_the_upper_envelope():
    """|m|²/N² and m⁴/N² cross at |m| = 1; the second saturates first, at N^(1/2)."""
    assert vertices(line(2, 2), line(4, 2)) == [(2, 1), (4, Rational(1, 2))]


def test_polygon_drops_what_is_hidden():
    assert vertices(line(2, 1), line(4, 2)) == [(2, Rational(1, 2))]
    assert vertices(line(2, 1), line(2, 2)) == [(2, Rational(1, 2))]
    assert vertices(line(0, 0), line(2, 1)) == [(0, 0)]


def test_polygon_joins_terms_of_one_line():
    two = SeriesTerm(Powers(((2,),)), Integer(4), Integer(2), Integer(3))
    (found,) = newton_polygon(Series((Integer(2),), (line(4, 2), two)), (), ())
    assert len(found.form) == 2
    # means over the circle: m_1² m_2² = 1/8, m_1⁴ + m_2⁴ = 3/4
    assert found.coefficient == Rational(1, 8) + 3 * Rational(3, 4)


def test_a_comb_is_a_step_unless_a_saturated_monomial_covers_it():
    step = Comb(Rational(1, 2), Integer(0), Integer(1))
    assert vertices(combs=(step,)) == [(sympy.oo, Rational(1, 2))]
    assert vertices(line(2, 1), combs=(step,)) == [(2, Rational(1, 2))]
    high = Comb(Rational(1, 2), Rational(1, 2), Integer(1))
    assert vertices(line(2, 1), combs=(high,))[1] == (sympy.oo, Rational(1, 2))
    early = Comb(Rational(1, 3), Integer(0), Integer(1))
    assert vertices(line(2, 1), combs=(early, early)) == [
        (2, Rational(1, 2)),
        (sympy.oo, Rational(1, 3)),
    ]


@pytest.mark.parametrize(
    ("name", "dim", "support", "expected"),
    [
        ("random", 3, (1, 2), {(0, 0)}),
        ("jitter", 3, (1,), {(2, Rational(1, 3))}),
        ("jitter", 3, (1, 2, 3), {(2, Rational(1, 3))}),
        ("jitter:N^1/3xN^2/3", 2, (1,), {(2, Rational(1, 3))}),
        ("jitter:N^1/3xN^2/3", 2, (2,), {(2, Rational(2, 3))}),
        ("jitter:N^1/3xN^2/3", 2, (1, 2), {(2, Rational(1, 3))}),
        ("latin-hypercube", 4, (3,), {(2, 1)}),
        ("latin-hypercube", 4, (1, 3), {(0, 0)}),
        ("multi-jitter", 2, (1,), {(2, 1)}),
        ("multi-jitter", 2, (1, 2), {(2, Rational(1, 2))}),
        ("multi-jitter", 3, (1, 2), {(2, Rational(1, 3))}),
        ("correlated-multi-jitter", 2, (1,), {(2, 1)}),
        ("correlated-multi-jitter", 2, (1, 2), {(2, 1), (4, Rational(1, 2))}),
        (
            "correlated-multi-jitter:N^1/3xN^2/3",
            2,
            (1, 2),
            {(2, 1), (4, Rational(1, 2)), (sympy.oo, Rational(1, 3))},
        ),
        ("uncorrelated-jitter:1+2+3", 6, (2, 3), {(2, Rational(1, 2))}),
        ("uncorrelated-jitter:1+2+3", 6, (4,), {(2, Rational(1, 3))}),
        ("uncorrelated-jitter:1+2+3", 6, (1, 2), {(0, 0)}),
        ("box-dpp", 1, (1,), {(1, 1)}),
        ("box-dpp", 3, (1, 2), {(1, Rational(1, 3))}),
        ("cloaked:1/2", 2, (1, 2), {(Rational(1, 2), Rational(1, 2))}),
        ("cloaked:3/2", 3, (2,), {(Rational(3, 2), Rational(1, 3))}),
        ("cloaked:2", 1, (1,), {(2, 1)}),
        ("difference-jitter", 1, (1,), {(4, 1)}),
        ("regular", 2, (1,), {(sympy.oo, Rational(1, 2))}),
        ("regular", 2, (1, 2), {(sympy.oo, Rational(1, 2))}),
    ],
)
def test_known_profiles(name, dim, support, expected):
    sampler = parse_sampler(name, dim)
    profile = profile_of(sampler, region_of_support(sampler.layout, support))
    assert {(m.degree, m.effective) for m in profile} == expected


def test_coefficients_of_jitter_and_correlated_multi_jitter():
    """N·P = (π²/3)|m|²/n²; and (π²/3)|m|²/N² + (π⁴/9) m_1² m_2²/N², in the mean π⁴/72."""
    jitter = parse_sampler("jitter", 2)
    for region in regions(jitter.layout):
        (monomial,) = profile_of(jitter, region)
        assert monomial.coefficient == sympy.pi**2 / 3
        assert sympy.simplify(monomial.alpha - sympy.sqrt(3) / sympy.pi) == 0
    correlated = parse_sampler("correlated-multi-jitter", 2)
    found = profile_of(correlated, region_of_support(correlated.layout, (1, 2)))
    assert {m.degree: m.coefficient for m in found} == {
        2: sympy.pi**2 / 3,
        4: sympy.pi**4 / 72,
    }


@pytest.mark.parametrize(
    ("name", "dim", "support"),
    [
        ("box-dpp", 2, (1, 2)),
        ("cloaked:1/2", 2, (1, 2)),
        ("cloaked:3/2", 2, (1,)),
        ("difference-jitter", 1, (1,)),
    ],
)
def test_profiles_of_other_shapes_bound_the_spectrum_on_both_sides(name, dim, support):
    """Ratios over the shells are the same at any N; with a wrong b or e they drift as a power."""
    ratios = [envelope(parse_sampler(name, dim), support, n) for n in (64, 1024, 4096)]
    assert all(0.5 < r.low <= r.high < 2.5 for r in ratios)
    assert ratios[2].low == pytest.approx(ratios[1].low, rel=0.02)
    assert ratios[2].high == pytest.approx(ratios[1].high, rel=0.02)


@pytest.mark.parametrize(
    ("name", "dim", "expected"),
    [
        ("box-dpp", 1, 1),
        ("box-dpp", 2, 4 / sympy.pi),  # mean of |cos| + |sin|
        ("box-dpp", 3, Rational(3, 2)),
        ("cloaked:1/2", 1, 1),
        ("cloaked:2", 2, 1 + sympy.pi**2 / 3),
        ("difference-jitter", 1, 23 * sympy.pi**4 / 15),
    ],
)
def test_coefficients_of_other_shapes(name, dim, expected):
    sampler = parse_sampler(name, dim)
    whole = region_of_support(sampler.layout, tuple(range(1, dim + 1)))
    (monomial,) = profile_of(sampler, whole)
    assert sympy.simplify(monomial.coefficient - expected) == 0


def test_steps_know_their_first_alias_and_plateau():
    """Strata 4 × N: teeth on axis 1 at multiples of 4, of mean height N/4; on axis 2 of N/4."""
    sampler = parse_sampler("regular:4xN", 2)
    (first,), (second,) = (
        profile_of(sampler, region_of_support(sampler.layout, (i,))) for i in (1, 2)
    )
    assert (first.effective, first.scale) == (0, 4)
    assert (first.plateau_exponent, first.plateau) == (1, Rational(1, 4))
    assert (second.effective, second.scale) == (1, Rational(1, 4))
    assert (second.plateau_exponent, second.plateau) == (0, 4)


@pytest.mark.parametrize(
    ("b", "e", "q", "expected"),
    [
        (2, Rational(1, 2), 1, Order(Rational(3, 2))),
        (2, Rational(1, 2), 2, Order(Integer(2), Integer(1))),
        (2, Rational(1, 2), sympy.oo, Order(Integer(2))),
        (0, 0, 3, Order(Integer(1))),
        (2, 0, 2, Order(Integer(1))),
        (sympy.oo, Rational(1, 2), 3, Order(Rational(5, 2))),
        (sympy.oo, Rational(1, 2), sympy.oo, Order(sympy.oo)),
        (1, Rational(1, 3), 1, Order(Rational(4, 3), Integer(1))),
    ],
)
def test_order_of_a_monomial(b, e, q, expected):
    monomial = SaturatingMonomial(sympy.sympify(b), sympy.sympify(e))
    assert saturated_order(monomial, sympy.sympify(q), ()) == expected
    assert monomial.order_at(sympy.sympify(q)) == expected


def test_ties():
    d, w = symbol("d"), symbol("w")
    known = (Range(d, Integer(2)),)
    assert tie(Integer(2), Integer(2), known) == 1
    assert tie(Integer(2), Integer(1), known) == 0
    assert tie(Integer(2), d + 1, known) == 0
    assert tie(Integer(2), d, known) == sympy.KroneckerDelta(2, d)
    between = (Range(w, Integer(2)), Range(d, w + 1))
    assert tie(Integer(2), d + 1 - w, between).xreplace({w: Integer(4), d: Integer(5)}) == 1
    assert tie(Integer(2), d + 1 - w, between).xreplace({w: Integer(3), d: Integer(5)}) == 0
