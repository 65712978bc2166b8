"""Orders measured on exact variances: exponents, logarithms, constants, and what has none."""

import random
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.exact_variances.asymptotics import (
    START,
    Rung,
    ladder,
    measured_constant,
    measured_order,
    order_on_ladder,
    simplest_between,
)
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError
from specrate.theory.orders import Order
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, Rational, sympy

SETTLED = [
    ("jitter", 1, "bernoulli:k=1", 2),
    ("jitter", 1, "bernoulli:k=2", 3),
    ("jitter", 2, "product:k=1", "3/2"),
    ("jitter", 2, "gaussian:sigma=0.1", 2),
    ("jitter", 2, "disk:radius=0.3", "3/2"),
    ("jitter", 3, "box:side=0.3", "4/3"),
    ("jitter", 3, "gaussian:sigma=0.1", "5/3"),
    ("jitter", 3, "ball:radius=0.3", "4/3"),
    ("jitter:N^1/3xN^2/3", 2, "product:k=2", "5/3"),
    ("jitter:4xN", 2, "product:k=2", 1),
    ("latin-hypercube", 2, "half-space:side=0.3", 2),  # on an axis
    ("latin-hypercube", 2, "bernoulli:k=2", 3),
    ("latin-hypercube", 3, "additive:k=2", 3),
    ("latin-hypercube", 2, "bernoulli:k=2,axes=(1,2)", 1),  # generic
    ("latin-hypercube", 4, "gaussian:sigma=0.1", 1),
    ("multi-jitter", 2, "box:side=0.3", "3/2"),
    ("multi-jitter", 2, "product:k=2", 2),
    ("multi-jitter", 2, "disk:radius=0.3", "3/2"),
    ("multi-jitter", 3, "bernoulli:k=2", 3),
    ("multi-jitter", 3, "product:k=2", "5/3"),
    ("correlated-multi-jitter", 2, "gaussian:sigma=0.1", 3),
    ("correlated-multi-jitter", 2, "product:k=3", 3),
    ("correlated-multi-jitter", 2, "product:k=2", "5/2"),
    ("uncorrelated-jitter:1+2", 3, "bernoulli:k=2,axes=(2,3)", 2),
    ("uncorrelated-jitter:1+2+3", 6, "bernoulli:k=2,axes=(4,5,6)", "5/3"),
    ("uncorrelated-jitter:1+2+3", 6, "product:k=2", 1),
    ("regular", 2, "product:k=2", 2),
    ("jitter", 2, "ridge:k=(1,1)", 2),
    ("jitter", 1, "polylog:p=3/2", "3/2"),
    ("jitter", 1, "polylog:p=29/10", "29/10"),  # N^-2.9 against N^-3
    ("jitter", 1, "polylog:p=31/10", 3),
    ("jitter", 12, "product:k=2", "7/6"),
]


@pytest.mark.parametrize(("name", "dim", "integrand", "exponent"), SETTLED)
def test_exponents_to_six_digits(name, dim, integrand, exponent):
    found = measured_order(parse_sampler(name, dim), parse_integrand(integrand, dim), rungs=13)
    expected = Fraction(exponent)
    assert found.verdict == "settled"
    assert found.rational == expected
    assert found.log_power == 0
    with mp.workdps(70):
        gap = abs(found.exponent.value - mp.mpf(expected.numerator) / expected.denominator)
        assert gap <= found.exponent.error <= 1e-6


@pytest.mark.parametrize(
    ("name", "dim", "integrand", "exponent", "constant"),
    [
        ("jitter", 1, "polylog:p=3", 3, 2 * sympy.pi**2 / 3),
        ("jitter", 2, "polylog:p=3", 2, sympy.pi**2 / 3),
        ("latin-hypercube", 3, "polylog:p=3", 3, 2 * sympy.pi**2 / 3),
        ("uncorrelated-jitter:2+1", 3, "polylog:p=3", 2, sympy.pi**2 / 3),
        ("jitter", 1, "chord:radius=0.3", 3, Rational(1, 10)),
        ("jitter", 2, "chord:radius=0.3", 2, 3 * sympy.pi / 200),
    ],
)
def test_ties_have_a_logarithm(name, dim, integrand, exponent, constant):
    found = measured_order(parse_sampler(name, dim), parse_integrand(integrand, dim))
    assert (found.verdict, found.rational, found.log_power) == ("settled", exponent, 1)
    with mp.workdps(70):
        gap = abs(found.constant.value - mp.mpmathify(sympy.N(constant, 70)))
        assert gap <= found.constant.error <= 1e-20
    raw = [float(s) for s in found.slopes]
    assert max(raw) < exponent - 0.005  # a local slope would not have told


@pytest.mark.parametrize(
    ("name", "dim", "integrand"),
    [
        ("correlated-multi-jitter", 2, "box:side=0.3"),
        ("regular", 2, "box:side=0.3"),
        ("correlated-multi-jitter", 2, "box:side=1/2"),  # still along powers of two
    ],
)
def test_combs_against_jumps_oscillate(name, dim, integrand):
    found = measured_order(parse_sampler(name, dim), parse_integrand(integrand, dim))
    assert found.verdict == "oscillates"


@pytest.mark.parametrize(
    ("name", "integrand"),
    [
        ("jitter", "polylog:p=2999/1000"),  # N^-2.999 against N^-3
        ("regular", "gaussian:sigma=1/1000000000"),  # faster than any power, from N = 1e9 on
    ],
)
def test_what_does_not_settle_is_undecided(name, integrand):
    start = 10**8 if name == "regular" else START
    found = measured_order(parse_sampler(name, 1), parse_integrand(integrand, 1), start)
    assert found.verdict == "undecided"


@pytest.mark.parametrize(
    ("name", "dim", "integrand", "rule"),
    [
        ("regular", 1, "box:side=1/3", "must be positive"),  # none where 3 divides N
        ("isotropic:2", 1, "bernoulli:k=2", "a sampler with points"),
    ],
)
def test_refusals(name, dim, integrand, rule):
    with pytest.raises(InputError, match=rule):
        measured_order(parse_sampler(name, dim), parse_integrand(integrand, dim))


def test_variances_with_few_digits_are_refused():
    """The lattice sum of the disk knows less than 20 digits."""
    with pytest.raises(InputError, match="known to 20 digits"):
        measured_order(
            parse_sampler("correlated-multi-jitter", 2),
            parse_integrand("disk:radius=0.3", 2),
            start=10**8,
            rungs=3,
        )


@pytest.mark.parametrize(
    ("name", "dim", "ratio"),
    [
        ("jitter", 1, 2),
        ("jitter", 3, 8),
        ("jitter:25x40", 2, 4),
        ("uncorrelated-jitter:1+2+3", 6, 64),
    ],
)
def test_ladders_multiply_every_count(name, dim, ratio):
    sampler, f = parse_sampler(name, dim), parse_integrand("product:k=2", dim)
    rungs = ladder(sampler, f, START, 4, 30)
    sizes = [r.n for r in rungs]
    assert [b / a for a, b in pairwise(sizes)] == [ratio] * 3
    assert all(sampler.counts_at(n)["N"] == n for n in sizes)
    assert START / 2 < sizes[0] < 2 * START
    assert all(0 < r.error_bound < r.variance * 1e-29 for r in rungs)


@pytest.mark.parametrize(
    ("integrand", "order", "constant"),
    [
        ("polylog:p=2", Order(Integer(2)), 2 * sympy.pi**2 / 3),
        ("polylog:p=3", Order(Integer(3), Integer(1)), 2 * sympy.pi**2 / 3),
        ("polylog:p=4", Order(Integer(3)), sympy.pi**4 / 9),
        ("polylog:p=2", Order(Integer(1)), Integer(0)),  # N V → 0
    ],
)
def test_constants_of_known_orders(integrand, order, constant):
    found = measured_constant(parse_sampler("jitter", 1), parse_integrand(integrand, 1), order)
    with mp.workdps(70):
        gap = abs(found.value - mp.mpmathify(sympy.N(constant, 70)))
        assert gap <= found.error <= 1e-30


@pytest.mark.parametrize(
    "order", [Order(1 + 1 / sympy.Symbol("d")), Order(Integer(2), Integer(2)), Order(sympy.oo)]
)
def test_constants_need_an_order_in_numbers(order):
    with pytest.raises(InputError, match="an order must be a number"):
        measured_constant(parse_sampler("jitter", 1), parse_integrand("polylog:p=2", 1), order)


@given(st.fractions(-3, 3), st.fractions(0, 1, max_denominator=10**6))
def test_the_simplest_fraction_is_inside_and_none_simpler_is(low, width):
    high = low + width
    found = simplest_between(low, high)
    assert low <= found <= high
    for q in range(1, min(found.denominator, 200)):
        assert -(-low.numerator * q // low.denominator) > high * q  # no whole number between


def synthetic(source):
    """c N^-r (1 or a + ln t) (1 + corrections of whole powers of 1/t), N = t^d, t doubled."""
    d = source.choice([1, 2, 3, 4, 6])
    r, log = 1 + Fraction(source.randint(1, 12), source.choice([d, 2 * d])), source.random() < 0.4
    terms = [
        (source.gauss(0, 1) * 10 ** source.uniform(-1, 2), source.gauss(0, 1), k)
        for k in range(1, source.randint(2, 8))
    ]
    start, shift = int(10 ** source.uniform(1.5, 10)), source.uniform(0, 3)
    rungs: list[Rung] = []
    for j in range(17):
        t = mp.mpf(start) * 2**j
        front = shift + mp.log(t) if log else 1
        value = front + mp.fsum((a + b * mp.log(t)) * t**-k for a, b, k in terms)
        value *= t ** -(mp.mpf(d * r.numerator) / r.denominator)
        error = abs(value) * mp.mpf(10) ** -60
        rungs.append(Rung((start << j) ** d, value + source.uniform(-1, 1) * error, error))
    return r, int(log), mp.mpf(1) / d if log else mp.mpf(1), rungs


def test_orders_of_random_expansions():
    """Of 150 with a fixed seed at most one is farther off than stated, none that settled is wrong.

    Errors a tenth of those stated would let 2 of 100 through, two or more with probability 0.8.
    """
    source = random.Random(20162)
    missed = settled = 0
    with mp.workdps(70):
        for _ in range(150):
            r, log, constant, rungs = synthetic(source)
            if min(x.variance for x in rungs) <= 0:
                continue
            found = order_on_ladder(rungs)
            gap = abs(found.exponent.value - mp.mpf(r.numerator) / r.denominator)
            missed += bool(gap > found.exponent.error)
            if found.verdict == "settled":
                settled += 1
                assert (found.rational, found.log_power) == (r, log)
                assert abs(found.constant.value - constant) <= found.constant.error
    assert missed <= 1
    assert settled >= 140
