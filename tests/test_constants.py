"""Constants of named integrands in tables: symbols for parameters, sums over regions, refusals."""

import pytest
from specrate.numerics import variance
from specrate.numerics.balls import certified
from specrate.numerics.exact_variances.asymptotics import measured_constant
from specrate.numerics.exact_variances.constant_balls import constant_ball
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.integrands.protocol import mp
from specrate.theory.constants import region_constant, summed_constant
from specrate.theory.decays import parse_decay
from specrate.theory.errors import InputError
from specrate.theory.orders import Order
from specrate.theory.primitives import parse_primitive
from specrate.theory.radial import C_F, RHO_0, Leading
from specrate.theory.rates import region_rates
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, Rational, sympy
from specrate.theory.tables import table

R, a, sigma = sympy.symbols("R a sigma", positive=True)


def rows(sampler, dim, integrand, primitive="point"):
    """Constants by region."""
    found = table((sampler,), (dim,), (integrand,), primitive).rows
    return {r.region: r.constant for r in found}


def test_parameters_that_are_not_given_stay_symbols():
    assert rows("jitter", 2, "disk")["axis"] == R / 3
    assert rows("jitter", 2, "disk:radius=0.3")["axis"] == Rational(1, 10)
    assert rows("jitter", 1, "half-space")["overall"] == Rational(1, 3)
    assert rows("random", 1, "box")["overall"].equals(a - a**2)


@pytest.mark.parametrize(
    ("sampler", "dim", "bare", "given", "at"),
    [
        ("jitter", 2, "disk", "disk:radius=2/7", {R: Rational(2, 7)}),
        ("latin-hypercube", 3, "ball", "ball:radius=2/7", {R: Rational(2, 7)}),
        ("multi-jitter", 2, "box", "box:side=2/7", {a: Rational(2, 7)}),
        ("jitter", 2, "gaussian", "gaussian:sigma=2/7", {sigma: Rational(2, 7)}),
    ],
)
def test_numbers_are_the_symbols_put_in(sampler, dim, bare, given, at):
    symbolic, numbers = rows(sampler, dim, bare), rows(sampler, dim, given)
    assert symbolic.keys() == numbers.keys()
    for region, constant in symbolic.items():
        gap = constant.subs(at) - numbers[region]
        assert certified(lambda gap=gap: constant_ball(gap) + 1, 30).overlaps(
            certified(lambda: constant_ball(Integer(1)), 30)
        )


def test_overall_is_the_sum_of_the_regions_that_decide():
    found = rows("jitter", 3, "product:k=2")
    assert found["overall"] == found["axis"] + found["w=2"] + found["generic"]
    found = rows("latin-hypercube", 3, "product:k=2")
    assert found["overall"] == found["w=2"] + found["generic"]
    found = rows("uncorrelated-jitter:1+2", 3, "gaussian")
    assert found["overall"] == found["across"]


def test_joined_regions_are_summed():
    """Two across-regions share a row, their three supports its constant."""
    t = Rational(1, 180)
    across = rows("uncorrelated-jitter:1+2", 3, "product:k=2")["across"]
    assert across == 2 * t**2 + t**3


def test_a_missing_part_leaves_the_whole_without_constant():
    """Jitter with 4 strata on one axis: N·P_S there has no simple limit."""
    found = rows("jitter:4xN", 2, "product:k=2")
    assert found["1"] is None
    assert found["2"] == Rational(4, 9) / 1
    assert found["overall"] is None


def test_classes_keep_the_constants_of_the_model():
    found = rows("jitter", 1, "best")
    assert found == {"axis": sympy.pi**2 * C_F * RHO_0**3 / 9, "overall": None}


def test_lines_average_a_product_along_the_last_axis():
    """∏ (1 + B_2) keeps its mean 1; a box along the line is scaled by its last side, squared."""
    assert rows("jitter", 2, "product:k=2", "line")["overall"] == Rational(1, 36)
    found = rows("jitter", 2, "box:side=(1/3,1/5)", "line")
    assert found["overall"] == Rational(1, 3) / 25


def test_lines_sample_the_chords_of_a_ball():
    assert rows("jitter", 2, "disk", "line")["overall"] == R / 3


@pytest.mark.parametrize(
    ("sampler", "dim", "integrand", "primitive"),
    [
        ("jitter", "d", "ball", "point"),
        ("jitter", 2, "disk", "segment"),
        ("jitter", 2, "p=5/2", "point"),
        ("regular", 2, "disk", "point"),
        ("correlated-multi-jitter", 2, "box", "point"),
        ("isotropic:2", 2, "disk", "point"),
        ("random", 2, "additive", "point"),
    ],
)
def test_where_there_is_no_constant(sampler, dim, integrand, primitive):
    assert rows(sampler, dim, integrand, primitive)["overall"] is None


def test_parameters_must_be_exact():
    sampler, decay = parse_sampler("jitter", 2), parse_decay("disk:radius=R")
    rate = region_rates(sampler, decay)[0]
    with pytest.raises(InputError, match="an exact expression"):
        region_constant(sampler, rate, decay, parse_primitive("point"))


def test_sums_need_every_term_of_one_order():
    order = Order(Integer(2))
    one, other = Leading(order, Integer(3)), Leading(Order(Integer(3)), Integer(1))
    assert summed_constant([one, one], order) == 6
    assert summed_constant([one, None], order) is None
    assert summed_constant([one, other], order) is None


FAMILIES = [
    ("jitter", 1),
    ("jitter", 2),
    ("jitter", 3),
    ("jitter:25x40", 2),
    ("latin-hypercube", 2),
    ("latin-hypercube", 4),
    ("multi-jitter", 2),
    ("multi-jitter", 3),
    ("correlated-multi-jitter", 2),
    ("uncorrelated-jitter:1+2", 3),
    ("uncorrelated-jitter:1+2+3", 6),
    ("regular", 2),
]
KNOWN = ("bernoulli:k=1", "bernoulli:k=2", "product:k=1", "product:k=3", "box:side=0.3")


@pytest.mark.parametrize("integrand", [*KNOWN, "gaussian:sigma=0.2", "ball:radius=0.3"])
def test_random_points_see_the_whole_variance(integrand):
    """N Var = Σ_{m≠0} |f^(m)|², known without any spectrum."""
    constant = rows("random", 2, integrand)["overall"]
    whole = parse_integrand(integrand, 2).total(30)
    assert certified(lambda: constant_ball(constant), 30).overlaps(whole)


@pytest.mark.parametrize("integrand", [*KNOWN, "gaussian:sigma=0.2"])
@pytest.mark.parametrize(("name", "dim"), FAMILIES)
def test_overall_constants_are_what_exact_variances_come_to(name, dim, integrand):
    """Every family against every product integrand, to the error stated and to 12 digits."""
    (row,) = [r for r in table((name,), (dim,), (integrand,)).rows if r.is_overall]
    oscillating = integrand.startswith("box") and name in ("regular", "correlated-multi-jitter")
    if oscillating or row.order.exponent is sympy.oo:
        assert row.constant is None
        return
    exact = certified(lambda: constant_ball(row.constant), 30)
    sampler, f = parse_sampler(name, dim), parse_integrand(integrand, dim)
    measured = measured_constant(sampler, f, row.order, rungs=9, digits=40)
    with mp.workdps(40):
        gap = abs(measured.value - mp.mpf(exact.mid().str(35, radius=False)))
        assert gap <= measured.error + abs(measured.value) * mp.mpf(10) ** -30
        assert gap <= 1e-12 * measured.value


@pytest.mark.parametrize(
    ("sampler", "side", "order"),
    [
        ("latin-hypercube", "(1/3,1)", 2),
        ("latin-hypercube", "(1,1/2,1)", 2),
        ("latin-hypercube", "(1/3,1/2,1)", 1),
        ("multi-jitter", "(1/3,1)", 2),
        ("jitter", "(1,1/3)", Rational(3, 2)),
        ("uncorrelated-jitter:2+1", "(1/3,1/2,1)", Rational(3, 2)),
    ],
)
def test_a_side_of_one_leaves_its_coordinate_out(sampler, side, order):
    """The table's leading term against the exact variance at N = 1e24."""
    dim, text = side.count(",") + 1, f"box:side={side}"
    (overall,) = [r for r in table([sampler], [dim], [text], constants=True).rows if r.is_overall]
    assert overall.order.exponent == order
    exact = sympy.Float(variance(sampler, text, dim, "1e24").value.value)
    assert abs(exact * sympy.Integer(10) ** (24 * order) / overall.constant - 1) < 1e-6
