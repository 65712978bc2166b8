"""Rates that fitted profiles predict, against the orders of exact profiles and by hand."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.checking.fitted_profiles import FittedRegion
from specrate.numerics.checking.fitted_rates import CLASSES, fitted_rate, region_exponent
from specrate.numerics.fitting.profile_fits import EstimatedSpectrum, ProfileFit
from specrate.numerics.measuring.moments import Interval
from specrate.theory.decays import parse_decay
from specrate.theory.rates import order_on
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, sympy


def exactly(value):
    return None if value is None else Interval(value, value, value)


def fitted(support, b, e, reason=None, outside=None, counts=(16, 64)):
    b, e = (v if v is None or isinstance(v, Interval) else exactly(v) for v in (b, e))
    m = np.zeros((1, max(support)), dtype=np.int64)
    m[:, [i - 1 for i in support]] = 1
    spectra = tuple(EstimatedSpectrum(n, 4, m, np.ones(1)) for n in counts)
    return FittedRegion(support, spectra, ProfileFit(b, e, None, None, outside, reason, 2))


def jitter(dim=2):
    return [fitted(s, 2.0, 1 / dim) for s in ((1,), (2,), (1, 2))]


def rooks():
    return [fitted((1,), 2.0, 1.0), fitted((2,), 2.0, 1.0), fitted((1, 2), Interval(0, 0, 0), None)]


@pytest.mark.parametrize(("name", "regions"), [("jitter", jitter()), ("latin-hypercube", rooks())])
@pytest.mark.parametrize("family", CLASSES)
@pytest.mark.parametrize("support", [(1,), (2,), (1, 2), None])
def test_true_profiles_give_the_true_exponents(name, regions, family, support):
    found = fitted_rate(regions, 2, family, support).exponent
    true = float(order_on(parse_sampler(name, 2), parse_decay(family), support).exponent)
    assert found.low <= true + 1e-12
    assert found == pytest.approx((true, true, true))


@pytest.mark.parametrize(
    ("name", "support", "exponent"),
    [
        ("disk:radius=0.3", None, 1.5),  # q = 2 on the axes, 1 on the pair
        ("additive:k=2", None, 2.0),  # no power on the pair
        ("bernoulli:k=1,axes=(1,2)", (1, 2), 1.5),
        ("bernoulli:k=6", (1,), 2.0),
        ("p=7/2", (1, 2), 1.75),
    ],
)
def test_named_integrands_on_jitter(name, support, exponent):
    assert fitted_rate(jitter(), 2, name, support).exponent.estimate == pytest.approx(exponent)


def test_additive_integrands_leave_out_what_they_have_no_power_on():
    assert fitted_rate(rooks(), 2, "additive:k=2").exponent.estimate == pytest.approx(3.0)
    assert fitted_rate(rooks(), 2, "disk:radius=0.3").exponent.estimate == pytest.approx(1.0)


def test_intervals_are_those_of_the_degree_and_of_the_effective_exponent():
    region = fitted((1,), Interval(2, 1.5, 2.5), Interval(0.5, 0.4, 0.6))
    assert region_exponent(region, Integer(1)) == pytest.approx((1.5, 1.4, 1.6))
    assert region_exponent(region, Integer(2)) == pytest.approx((2.0, 1.6, 2.2))
    assert region_exponent(region, sympy.oo) == pytest.approx((2.0, 1.6, 2.5))


@given(
    st.fractions(0, 6, max_denominator=64),
    st.fractions(Fraction(1, 64), 1, max_denominator=64),
    st.fractions(Fraction(1, 2), 8, max_denominator=8),
)
def test_the_exponent_is_that_of_the_lower_power(b, e, q):
    region = fitted((1,), float(b), float(e))
    found = region_exponent(region, sympy.Rational(q.numerator, q.denominator))
    assert found.estimate == pytest.approx(float(1 + e * min(b, q)), rel=1e-12)


def test_without_a_degree_the_rate_is_at_least_that_of_random_points():
    """b = 0 is not excluded: e is anything up to 1."""
    region = fitted((1, 2), Interval(0.1, 0.0, 0.4), None)
    assert region_exponent(region, Integer(1)) == pytest.approx((1.05, 1.0, 1.4))
    assert region_exponent(region, sympy.oo) == pytest.approx((1.05, 1.0, 1.4))


@pytest.mark.parametrize(
    ("regions", "name", "support", "why"),
    [
        (
            [fitted((1,), 2.0, None, reason="one N")],
            "worst",
            None,
            "no profile on the region 1: one N",
        ),
        ([fitted((1,), None, None, outside="a lattice")], "best", None, "1: a lattice"),
        ([fitted((1,), 2.0, 1.0)], "worst", (2,), "no profile is fitted on the region 2"),
        (rooks()[:2], "best", None, "no profile is fitted on the region 1,2"),
        (rooks(), "bernoulli:k=1,axes=(1,2)", (1,), "no region that is fitted has power"),
        ([fitted((1,), 2.0, 1.0)], "teapot", None, "of no class of the theory"),
        ([fitted((1, 2), 2.0, 0.5)], "p=3/2", None, "of no class of the theory"),
    ],
)
def test_what_is_not_predicted_says_why(regions, name, support, why):
    found = fitted_rate(regions, 2, name, support)
    assert found.exponent is None
    assert why in found.rests_on


def test_what_a_prediction_rests_on_is_said():
    found = fitted_rate(jitter(), 2, "worst")
    assert found.rests_on == "profiles fitted on 1; 2; 1,2 at N = 16, 64"
    outer = ((1,), (10,), (1, 2), (9, 10), tuple(range(1, 11)))
    many = [fitted(support, 2.0, 1.0) for support in outer]
    assert "of 1023 regions" in fitted_rate(many, 10, "worst").rests_on
    assert "regions" not in fitted_rate(many, 10, "worst", (1,)).rests_on


def test_the_slowest_region_decides_at_each_end():
    regions = [
        fitted((1,), Interval(2, 1, 3), Interval(1.0, 0.9, 1.1)),
        fitted((2,), Interval(1.5, 1.4, 1.6), Interval(1.0, 1.0, 1.0)),
        fitted((1, 2), 4.0, 1.0),
    ]
    assert fitted_rate(regions, 2, "best").exponent == pytest.approx((2.5, 1.9, 2.6))
