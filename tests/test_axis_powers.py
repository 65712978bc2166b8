"""Axis powers: totals and deficits against certified power sums at large n, and what is named."""

from fractions import Fraction

import pytest
from specrate.numerics.balls import certified
from specrate.numerics.exact_variances.constant_balls import constant_ball
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.theory.axis_powers import (
    IGNORED,
    ProductPower,
    interval,
    parameters,
    power_law,
    power_laws,
    product_power,
)
from specrate.theory.decays import Decay, parse_decay
from specrate.theory.errors import InputError
from specrate.theory.symbolic import Integer, Rational, sympy

NAMED = [
    "product:k=1",
    "product:k=2",
    "product:k=3,c=2/3",
    "bernoulli:k=1",
    "bernoulli:k=2",
    "bernoulli:k=4",
    "box:side=0.3",
    "half-space:side=5/7",
    "gaussian:sigma=0.1",
    "gaussian:sigma=2",
    "anisotropic-gaussian:sigma=(0.04)",
]


def polylog(p):
    return Decay(f"polylog:p={p}", "polylog", Rational(p), (1,))


def power_of(name):
    """Power in one dimension."""
    decay = polylog(name.partition("=")[2]) if name.startswith("polylog") else parse_decay(name)
    power = product_power(decay, 1)
    assert power is not None
    return power


def sums(name):
    """mean, total and (n -> total less its sinc² sum) of the integrand itself, certified."""
    ((_, factor),) = parse_integrand(name, 1).parts[0]

    def deficit(n):
        return certified(lambda: factor.power_sum() - factor.power_sum(count=n), 30)

    return factor, deficit


def number(constant):
    return certified(lambda: constant_ball(constant), 30)


POLYLOGS = [f"polylog:p={p}" for p in ("6/5", "3/2", "2", "5/2", "7/2", "4", "9/2", "6")]


@pytest.mark.parametrize("name", [*NAMED, *POLYLOGS])
def test_means_and_totals_are_those_of_the_integrand(name):
    (axis,) = power_of(name).axes
    factor, _ = sums(name)
    assert number(axis.mean_square).overlaps(certified(lambda: factor.mean() ** 2, 30))
    assert number(axis.total).overlaps(certified(factor.power_sum, 30))


@pytest.mark.parametrize("name", [*NAMED, *POLYLOGS])
def test_deficits_are_limits(name):
    """n^κ D(n) → δ: the gap falls as n^-|q − 2|, here n^(-1/2) or faster."""
    power = power_of(name)
    (axis,) = power.axes
    assert power.log == 0
    fall, (_, deficit) = Fraction(int(power.fall.p), int(power.fall.q)), sums(name)
    gaps = []
    for digits in (10, 40):  # so that 10^(κ digits) is whole
        scaled = deficit(10**digits) * 10 ** int(fall * digits)
        gaps.append(abs(float(scaled / number(axis.deficit) - 1)))
    assert gaps[0] < 1e-4
    assert gaps[1] < 1e-15


def test_the_tie_has_a_logarithm():
    """p = 3: n² D(n) rises by δ for every factor e of n."""
    power = power_of("polylog:p=3")
    assert power.log == 1
    _, deficit = sums("polylog:p=3")
    first, second = (deficit(10**k) * 10 ** (2 * k) for k in (20, 40))
    slope = float(second - first) / (20 * 2.302585092994046)
    assert slope == pytest.approx(float(number(power.axes[0].deficit)), rel=1e-13)


@pytest.mark.parametrize("name", ["product:k=2", "bernoulli:k=1", "polylog:p=5/2"])
def test_combs_of_power_laws_scale(name):
    power = power_of(name)
    factor, _ = sums(name)
    scaled = certified(lambda: factor.power_sum(comb=64), 30) * 64 ** float(power.comb)
    assert not power.oscillates
    assert float(scaled / number(power.axes[0].total)) == pytest.approx(1, rel=1e-14)


def test_combs_of_intervals_oscillate_within_their_order():
    power = power_of("box:side=0.3")
    factor, _ = sums("box:side=0.3")
    seen = {round(float(factor.power_sum(comb=n)) * n**2, 9) for n in (1000, 1001, 1002)}
    assert power.oscillates
    assert power.comb == 2
    assert len(seen) == 3


def test_a_whole_side_is_a_coordinate_left_out():
    assert interval(Integer(1)) == IGNORED
    power = product_power(parse_decay("box:side=(1/3,1)"), 2)
    assert power is not None
    assert power.axes[1] == IGNORED


def test_what_is_not_given_stays_a_symbol():
    for name, symbols in [
        ("box", {"a"}),
        ("half-space", {"a"}),
        ("gaussian", {"sigma"}),
        ("anisotropic-gaussian", {"sigma_1", "sigma_2"}),
        ("product:k=2", set()),
    ]:
        power = product_power(parse_decay(name), 2)
        assert power is not None
        free = set().union(*(a.mean_square.free_symbols for a in power.axes))
        assert {str(s) for s in free} == symbols


@pytest.mark.parametrize("name", ["worst", "best", "p=5/2", "ball", "disk:radius=0.3", "additive"])
def test_classes_and_other_integrands_are_none(name):
    assert product_power(parse_decay(name), 2) is None


def test_a_sum_over_the_axes_has_the_power_of_the_product_there():
    additive = Decay("additive:k=2", "additive", Integer(2))
    assert product_power(additive, 3) == product_power(parse_decay("product:k=2"), 3)


def test_parameters_are_exact():
    assert parameters("box:side=(1/3, 0.5)") == {"side": (Rational(1, 3), Rational(1, 2))}
    assert parameters("product:k=2,c=0.1")["c"] == (Rational(1, 10),)
    assert parameters("disk") == {}
    with pytest.raises(InputError):
        parameters("disk:radius=R")
    with pytest.raises(InputError, match="one value per coordinate"):
        product_power(parse_decay("box:side=(1/3,1/2)"), 3)


def test_power_laws_take_the_smaller_of_decay_and_degree():
    for p, fall, log in [("3/2", "1/2", 0), ("3", "2", 1), ("5", "2", 0)]:
        axis = power_law(Rational(p), Integer(1), Integer(0))
        assert power_laws(Rational(p), (axis,)) == ProductPower(
            (axis,), Rational(fall), Integer(log), Rational(p)
        )
        assert sympy.simplify(axis.total - 2 * sympy.zeta(Rational(p))) == 0
