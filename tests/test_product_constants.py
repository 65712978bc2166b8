"""Constants of products: known limits, the order they come with, exact variances at large N."""

from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from specrate.numerics.balls import certified, exact_ball
from specrate.numerics.exact_variances.constant_balls import constant_ball
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.theory.axis_powers import (
    IGNORED,
    AxisPower,
    ProductPower,
    power_law,
    power_laws,
    product_power,
)
from specrate.theory.decays import parse_decay
from specrate.theory.orders import Order
from specrate.theory.product_constants import MOST_AXES, product_constant
from specrate.theory.radial import Leading
from specrate.theory.rates import region_rates
from specrate.theory.regions import region_of_support, regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import samplers

pi = sympy.pi
INTEGRANDS = ("product:k=1", "product:k=2", "product:k=3,c=1/2", "gaussian:sigma=0.2")


def axis_limit(name, dim, power):
    """Leading term on axis 1 alone."""
    sampler = parse_sampler(name, dim)
    return product_constant(sampler, region_of_support(sampler.layout, (1,)), power)


@pytest.mark.parametrize(
    ("p", "order", "constant"),
    [
        (2, Order(Integer(2)), 2 * pi**2 / 3),
        (3, Order(Integer(3), Integer(1)), 2 * pi**2 / 3),
        (4, Order(Integer(3)), pi**4 / 9),
    ],
)
def test_power_laws_under_jitter_in_one_dimension(p, order, constant):
    power = power_laws(Integer(p), (power_law(Integer(p), Integer(1), Integer(0)),))
    assert axis_limit("jitter", 1, power) == Leading(order, constant)


def test_the_logarithm_is_that_of_the_count():
    """In d dimensions ln n = (1/d) ln N."""
    power = power_laws(Integer(3), (power_law(Integer(3), Integer(1), Integer(0)), IGNORED))
    found = axis_limit("jitter", 2, power)
    assert found == Leading(Order(Integer(2), Integer(1)), pi**2 / 3)


def symbolic_power(dim):
    """A smooth product with mean squares, totals and deficits left open."""
    axes = [sympy.symbols(f"c{i} t{i} g{i}", positive=True) for i in range(1, dim + 1)]
    return ProductPower(tuple(AxisPower(*a) for a in axes), Integer(2), Integer(0), sympy.oo), axes


def total(name, dim, power):
    """Leading terms of all regions together."""
    sampler = parse_sampler(name, dim)
    found = [product_constant(sampler, r, power) for r in regions(sampler.layout)]
    assert all(f is not None for f in found)
    slowest = min(f.order.exponent for f in found)
    kept = [f for f in found if f.order.exponent == slowest]
    return Leading(kept[0].order, sympy.expand(sum(f.constant for f in kept)))


def test_jitter_leaves_the_gradient():
    """(1/12N n²) ‖∇f‖², and Σ |m|² |f^|² of a product is a sum over the axis that has the m²."""
    power, ((c1, t1, g1), (c2, t2, g2)) = symbolic_power(2)
    found = total("jitter", 2, power)
    assert found.order == Order(Integer(2))
    assert sympy.expand(found.constant - g1 * (c2 + t2) - g2 * (c1 + t1)) == 0


def test_multi_jitter_leaves_the_mixed_part_of_the_gradient():
    power, ((_, t1, g1), (_, t2, g2)) = symbolic_power(2)
    found = total("multi-jitter", 2, power)
    assert found.order == Order(Integer(2))
    assert sympy.expand(found.constant - g1 * t2 - g2 * t1) == 0


def test_latin_hypercube_leaves_the_interactions_and_then_the_axes():
    power, ((c1, t1, g1), (c2, t2, g2)) = symbolic_power(2)
    sampler = parse_sampler("latin-hypercube", 2)
    axis, generic = (product_constant(sampler, r, power) for r in regions(sampler.layout))
    assert generic == Leading(Order(Integer(1)), t1 * t2)
    assert axis.order == Order(Integer(3))
    assert sympy.expand(axis.constant - g1 * c2 - g2 * c1) == 0


def test_correlated_multi_jitter_has_two_parts():
    """N^-3 [‖∇f‖²/12 + (π⁴/9) Σ m_1² m_2² |f^|²], δ being (π²/3) Σ m² |f^|²."""
    power, ((c1, t1, g1), (c2, t2, g2)) = symbolic_power(2)
    found = total("correlated-multi-jitter", 2, power)
    assert found.order == Order(Integer(3))
    expected = g1 * (c2 + t2) + g2 * (c1 + t1) + g1 * g2
    assert sympy.expand(found.constant - expected) == 0


def test_a_box_under_jitter_leaves_a_third_of_half_its_edge():
    """d = 2: (a_1 + a_2)/3, half of ∫ E|n·Δ| dS with E|Δ_i| = 1/3 of a cell."""
    power = product_power(parse_decay("box:side=(1/3,5/7)"), 2)
    assert power is not None
    found = total("jitter", 2, power)
    assert found == Leading(Order(Rational(3, 2)), (Rational(1, 3) + Rational(5, 7)) / 3)


def test_unequal_strata_weigh_the_axes():
    """25 × 40: n_1 = sqrt(5N/8), n_2 = sqrt(8N/5)."""
    power, ((c1, t1, g1), (c2, t2, g2)) = symbolic_power(2)
    found = total("jitter:25x40", 2, power)
    expected = Rational(8, 5) * g1 * (c2 + t2) + Rational(5, 8) * g2 * (c1 + t1)
    assert sympy.expand(found.constant - expected) == 0


@given(samplers().filter(lambda s: s.dim <= 4), st.sampled_from(INTEGRANDS))
def test_constants_come_with_the_order_of_the_rate(sampler, name):
    """And there is one wherever the region has power, but for counts that stay fixed."""
    decay = parse_decay(name)
    power = product_power(decay, int(sampler.dim))
    for rate in region_rates(sampler, decay):
        found = product_constant(sampler, rate.region, power)
        if found is not None:
            assert found.order == rate.order
        elif rate.order.exponent is not sympy.oo:
            assert any(g.exponent == 0 for g in sampler.layout.growth.values())


@given(samplers().filter(lambda s: s.dim <= 4 and s.counts_at is not None), st.data())
def test_constants_are_limits_of_exact_variances(sampler, data):
    """Exponents are multiples of 1/16 at worst: at N = 10^400 other terms are below 10^-24."""
    name = data.draw(st.sampled_from((*INTEGRANDS, "box:side=0.3")))
    assume(all(g.exponent > 0 for g in sampler.layout.growth.values()))
    dim = int(sampler.dim)
    power, decay = product_power(parse_decay(name), dim), parse_decay(name)
    rates = [r for r in region_rates(sampler, decay) if r.order.exponent is not sympy.oo]
    assume(rates)
    exponent = min(r.order.exponent for r in rates)
    found = [
        product_constant(sampler, r.region, power) for r in rates if r.order.exponent == exponent
    ]
    assume(all(f is not None for f in found))
    counts = sampler.counts_at(10**400)
    exact = exact_variance(sampler, counts, parse_integrand(name, dim), 20).value
    constant = certified(lambda: constant_ball(sum(f.constant for f in found)), 20)
    scale = exact_ball(counts["N"]) ** constant_ball(exponent)
    assert float(scale * exact_ball(_fraction(exact)) / constant) == pytest.approx(1, rel=1e-14)


def _fraction(value):
    """An mpf as the fraction that it is."""
    return Fraction(int(value.man)) * Fraction(2) ** int(value.exp)


@pytest.mark.parametrize(
    ("name", "dim", "integrand", "axes"),
    [
        ("regular", 2, "box", (1,)),  # the comb's teeth on the interval oscillate with n
        ("correlated-multi-jitter", 2, "box", (1, 2)),
        ("jitter:4xN", 2, "product:k=2", (1,)),  # n_1 = 4 is not large
        ("regular", 2, "gaussian", (1, 2)),  # faster than any power
        ("latin-hypercube", 2, "bernoulli:k=2", (1, 2)),  # no power there
        ("isotropic:2", 2, "product:k=2", (1,)),  # no spectrum
        ("jitter", MOST_AXES + 1, "product:k=2", (1,)),
    ],
)
def test_where_there_is_no_constant(name, dim, integrand, axes):
    sampler = parse_sampler(name, dim)
    power = product_power(parse_decay(integrand), dim)
    assert product_constant(sampler, region_of_support(sampler.layout, axes), power) is None


def test_teeth_below_the_leading_order_do_no_harm():
    """Correlated multi-jitter on an axis is 1D jitter, with or without combs."""
    power = product_power(parse_decay("box:side=1/3"), 2)
    sampler = parse_sampler("correlated-multi-jitter", 2)
    found = product_constant(sampler, region_of_support(sampler.layout, (1,)), power)
    assert found == Leading(Order(Integer(2)), Rational(1, 27))
