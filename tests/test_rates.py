"""Rates: exponent 1 + min_j e_j min(b_j, q), the slowest region, constants and crossovers."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.integrands.protocol import mp
from specrate.theory.decays import parse_decay
from specrate.theory.dominance import Case, dominates
from specrate.theory.errors import UndecidedSign
from specrate.theory.orders import Order
from specrate.theory.primitives import parse_primitive
from specrate.theory.radial import C_F, RHO_0, Leading
from specrate.theory.rates import (
    Crossover,
    crossover,
    is_no_harder,
    leading_constant,
    overall,
    region_rates,
)
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import samplers

d = symbol("d")
CLASSES = ("worst", "best", "ball", "product:k=2", "additive", "half-space", "p=14")


@given(samplers().filter(lambda s: len(s.layout.groups) <= 6), st.sampled_from(CLASSES))
def test_rate_of_a_region_is_the_minimum_over_its_monomials(sampler, name):
    """Teeth against a product's power count by ∏ |m_i| >= N^spread, all else by |m| >= N^e."""
    decay = parse_decay(name)

    def fall(m, q):
        if m.degree is sympy.oo and decay.is_product:
            return q * m.spread
        return m.effective * sympy.Min(m.degree, q) if m.effective else 0

    for rate in region_rates(sampler, decay):
        if rate.order is None:
            assert rate.q is None
            continue
        expected = min(1 - m.plateau_exponent + fall(m, rate.q) for m in rate.profile)
        assert rate.order.exponent == expected
        tie = any(
            m.degree == rate.q is not sympy.oo
            and m.effective != 0
            and 1 - m.plateau_exponent + m.effective * rate.q == expected
            for m in rate.profile
        )
        assert rate.order.log_power == int(tie)


@given(samplers().filter(lambda s: len(s.layout.groups) <= 6), st.sampled_from(CLASSES))
def test_overall_is_the_slowest_region(sampler, name):
    rates = region_rates(sampler, parse_decay(name))
    (case,) = overall(rates, sampler.layout.assumptions)
    orders = [r.order for r in rates if r.order is not None]
    assert case.condition is None
    if not orders:
        assert case.order.exponent is sympy.oo
        return
    assert case.order in orders
    assert all(dominates(case.order, o) for o in orders)


@given(samplers().filter(lambda s: len(s.layout.groups) <= 4))
def test_smoother_integrands_are_never_slower(sampler):
    rates = [region_rates(sampler, parse_decay(c)) for c in ("worst", "product:k=3", "best")]
    for slow, middle, fast in zip(*rates, strict=True):
        assert dominates(slow.order, middle.order)
        assert dominates(middle.order, fast.order)


@pytest.mark.parametrize("value", [2, 3, 4, 7])
@pytest.mark.parametrize("integrand", ["worst", "best", "ball"])
@pytest.mark.parametrize("name", ["jitter", "regular", "latin-hypercube", "multi-jitter", "random"])
def test_symbolic_dimension_is_the_number_put_in(name, integrand, value):
    decay = parse_decay(integrand)
    symbolic, number = parse_sampler(name, d), parse_sampler(name, value)
    (case,) = overall(region_rates(symbolic, decay), symbolic.layout.assumptions)
    (expected,) = overall(region_rates(number, decay), ())
    assert case.order.exponent.xreplace({d: Integer(value)}) == expected.order.exponent
    assert case.order.log_power.xreplace({d: Integer(value)}).doit() == expected.order.log_power


def test_no_power_anywhere_is_the_order_zero():
    assert overall((), ()) == (Case(Order(sympy.oo)),)


def test_a_region_that_exists_for_some_values_only_must_not_decide():
    """Latin hypercube × a class with power where 1 < w < d alone: not a rate for all d."""
    sampler = parse_sampler("latin-hypercube", d)
    middle = [
        r
        for r in region_rates(sampler, parse_decay("worst"))
        if r.region.dimension not in (1, d) or r.region.dimension == 1
    ]
    with pytest.raises(UndecidedSign, match="must not decide the rate"):
        overall(tuple(middle), sampler.layout.assumptions)


def test_is_no_harder_compares_equal_profiles_by_q():
    axis, middle, generic = region_rates(parse_sampler("jitter", 3), parse_decay("ball"))
    assert not is_no_harder(axis, generic)  # coefficients differ
    free = region_rates(parse_sampler("isotropic:b", 3), parse_decay("ball"))
    assert is_no_harder(free[2], free[0])
    assert not is_no_harder(free[0], free[2])
    assert middle.q == 2


def test_leading_constants_of_the_monomial_model():
    def constant(name):
        decay, sampler = parse_decay(name), parse_sampler("jitter", 1)
        (axis,) = region_rates(sampler, decay)
        return leading_constant(sampler, axis, decay)

    assert constant("worst") == Leading(Order(Integer(2)), 2 * sympy.pi * C_F / sympy.sqrt(3))
    assert constant("best") == Leading(Order(Integer(3)), sympy.pi**2 * C_F * RHO_0**3 / 9)
    assert constant("ball") is None


def test_lines_and_segments_of_a_ball():
    decay = parse_decay("ball")
    plane = parse_sampler("jitter", 2)
    for primitive, exponent, log in (
        ("line", 2, 1),
        ("segment", 2, 1),
        ("point", Rational(3, 2), 0),
    ):
        (case,) = overall(region_rates(plane, decay, parse_primitive(primitive)), ())
        assert case.order == Order(sympy.sympify(exponent), Integer(log)), primitive


def test_crossover_is_where_two_terms_are_equal():
    fast, slow = (
        ("axis", Integer(8), Order(Integer(3))),
        ("generic", Rational(1, 2), Order(Integer(1))),
    )
    assert crossover(fast, slow) == Crossover("axis", "generic", Integer(4))
    n = crossover(fast, slow).count
    assert 8 * n**-3 == Rational(1, 2) * n**-1


@pytest.mark.parametrize(
    ("fast", "slow"),
    [
        (Order(Integer(2)), Order(Integer(2))),
        (Order(Integer(3), Integer(1)), Order(Integer(1))),
        (Order(Integer(3)), Order(Integer(1), Integer(1))),
        (Order(sympy.oo), Order(Integer(1))),
    ],
)
def test_no_crossover_beside_logarithms_or_equal_powers(fast, slow):
    assert crossover(("a", Integer(1), fast), ("b", Integer(1), slow)) is None


@pytest.mark.parametrize(
    ("name", "dim", "axes", "k"),
    [
        ("regular", 2, (1, 2), 1),
        ("regular", 2, (1,), 2),
        ("regular", 3, (1, 3), 2),
        ("regular:N^1/3xN^2/3", 2, (1, 2), 1),
        ("correlated-multi-jitter", 2, (1, 2), 1),
        ("correlated-multi-jitter", 2, (1, 2), 2),
        ("jitter:N^1/3xN^2/3", 2, (1, 2), 1),
        ("multi-jitter", 3, (2, 3), 1),
    ],
)
def test_products_under_combs_have_the_slope_of_their_exact_variance(name, dim, axes, k):
    """The teeth of a comb are where a product's power is thinnest: ∏ |m_i|^-2k, not |m|^-p."""
    sampler = parse_sampler(name, dim)
    text = f"bernoulli:k={k},axes=({','.join(map(str, axes))})"
    assert_slope(sampler, text, dim)


@pytest.mark.parametrize("name", ["regular", "correlated-multi-jitter", "multi-jitter", "jitter"])
@pytest.mark.parametrize("text", ["ridge:k=(2,-3)", "ridge:k=(3,3),b=1", "ridge:k=(1,1),b=3"])
def test_ridges_under_combs_have_the_slope_of_their_exact_variance(name, text):
    """On the line j k teeth stand one j in n, in shells one frequency in n²."""
    assert_slope(parse_sampler(name, 2), text, 2)


def test_combs_of_unequal_growth_on_a_line_are_undecided():
    sampler = parse_sampler("regular:N^1/3xN^2/3", 2)
    with pytest.raises(UndecidedSign, match="combs along a line must grow with one power of N"):
        region_rates(sampler, parse_decay("ridge:k=(1,1)"))


def assert_slope(sampler, text, dim):
    """The table's exponent against exact variances at N = 10^12 and 10^15."""
    rates = region_rates(sampler, parse_decay(text))
    (case,) = overall(rates, ())
    variance = []
    for target in (10**12, 10**15):
        counts = sampler.counts_at(target)
        exact = exact_variance(sampler, counts, parse_integrand(text, dim)).value
        variance.append((mp.log(counts["N"]), mp.log(exact)))
    (x0, y0), (x1, y1) = variance
    assert float((y0 - y1) / (x1 - x0)) == pytest.approx(float(case.order.exponent), abs=2e-3)
