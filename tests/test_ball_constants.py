"""Constants of the ball: known limits, Parseval over the regions, exact variances at large N."""

import pytest
from specrate.numerics.balls import certified
from specrate.numerics.exact_variances.asymptotics import measured_constant
from specrate.numerics.exact_variances.constant_balls import constant_ball
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.integrands.protocol import mp
from specrate.theory.ball_constants import ball_constant, scaling_limit, volume
from specrate.theory.decays import parse_decay
from specrate.theory.mean_distances import mean_distance
from specrate.theory.orders import Order
from specrate.theory.primitives import parse_primitive
from specrate.theory.radial import Leading
from specrate.theory.rates import region_rates
from specrate.theory.regions import region_of_support
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, Rational, sympy

R = sympy.Symbol("R", positive=True)
pi, sqrt = sympy.pi, sympy.sqrt


def constants(name, dim, primitive="point"):
    """Leading term of each region, by its label; ``dim`` is that of the samples."""
    sampler, kind = parse_sampler(name, dim), parse_primitive(primitive)
    rates = region_rates(sampler, parse_decay("ball"), kind)
    return {r.region.label: ball_constant(sampler, r, R, kind.flat) for r in rates}


def same(found, exponent, log, constant):
    assert found is not None
    assert found.order == Order(sympy.sympify(exponent), Integer(log))
    assert sympy.simplify(found.constant - constant) == 0


@pytest.mark.parametrize("dim", [1, 2, 3, 4])
def test_jitter_cuts_the_edge(dim):
    """κ_{d−1} R^{d−1} times the mean distance in the cell: 1/3, 2R · 0.5214, πR² · 0.6617."""
    found = constants("jitter", dim)["axis" if dim == 1 else "generic"]
    mean = mean_distance((Integer(1),) * dim)
    same(found, 1 + Rational(1, dim), 0, volume(dim - 1) * R ** (dim - 1) * mean)


def test_multi_jitter_cuts_it_alike():
    for dim in (2, 3):
        assert constants("multi-jitter", dim)["generic"] == constants("jitter", dim)["generic"]


def test_disk_along_an_axis():
    """R/3 N^-3 log N per axis where the axis has N strata; ln n = (ln N)/2 where it has sqrt(N)."""
    same(constants("latin-hypercube", 2)["axis"], 3, 1, 2 * R / 3)
    same(constants("jitter", 2)["axis"], 2, 1, R / 3)


def test_latin_hypercube_leaves_the_interactions_of_the_disk():
    same(constants("latin-hypercube", 2)["generic"], 1, 0, pi * R**2 - 32 * R**3 / 3 + pi**2 * R**4)


def test_ball_along_an_axis_is_smooth_in_three_dimensions():
    """(1/12N³) ‖f_i'‖², f_i = π(R² − x²): 2π²R³/9 per axis."""
    same(constants("latin-hypercube", 3)["axis"], 3, 0, 3 * 2 * pi**2 * R**3 / 9)


def test_lines_through_disk_and_ball():
    """Chords: (R/3N³) ln N, and (πR²/3N²) ln sqrt(N)."""
    same(constants("jitter", 1, "line")["axis"], 3, 1, R / 3)
    same(constants("jitter", 2, "line")["generic"], 2, 1, pi * R**2 / 6)


@pytest.mark.parametrize("dim", [1, 2, 3, 5])
@pytest.mark.parametrize("flat", [0, 1, 2])
def test_random_points_see_the_whole_variance(dim, flat):
    """Parseval: the energies of all regions are the variance of the ball's marginal."""
    full = dim + flat
    marginal = constants("random", dim, f"{flat}-flat" if flat else "point")
    found = sum(x.constant for x in marginal.values())
    x = sympy.Symbol("x", positive=True)
    radial = volume(flat) ** 2 * (R**2 - x**2) ** flat * dim * volume(dim) * x ** (dim - 1)
    second = sympy.integrate(sympy.expand(radial), (x, 0, R))
    assert sympy.simplify(found - second + (volume(full) * R**full) ** 2) == 0


def test_a_gradient_by_quadrature():
    """Σ over m_1 ≠ 0 of m_1² |f^|² = ‖f_1'‖²/4π² for the 4-ball, f_1 = (4π/3)(R² − x²)^(3/2)."""
    x = sympy.Symbol("x", real=True)
    slope = sympy.diff(4 * pi / 3 * (R**2 - x**2) ** Rational(3, 2), x)
    energy = sympy.integrate(sympy.expand(slope**2), (x, -R, R))
    same(constants("latin-hypercube", 4)["axis"], 3, 0, 4 * energy / 12)


@pytest.mark.parametrize(
    ("name", "dim", "region"),
    [
        ("regular", 2, "axis"),
        ("regular", 3, "generic"),
        ("correlated-multi-jitter", 2, "1,2"),
        ("jitter:4xN", 2, "1"),
        ("isotropic:2", 2, "generic"),
    ],
)
def test_where_there_is_no_constant(name, dim, region):
    assert constants(name, dim)[region] is None


def test_combs_that_cancel_do_no_harm():
    same(constants("correlated-multi-jitter", 2)["1"], 3, 1, R / 3)


def test_scaling_limit_of_jitter():
    """1 − sinc²(x_1/κ_1) sinc²(x_2/κ_2) with κ = sqrt(5/8), sqrt(8/5); a faster axis is at 1."""
    sampler = parse_sampler("jitter:25x40", 2)
    generic = region_of_support(sampler.layout, (1, 2))
    sides = tuple(sorted((sqrt(Rational(8, 5)), sqrt(Rational(5, 8))), key=str))
    assert scaling_limit(sampler, generic, Rational(1, 2)) == {(): 1, sides: -1}
    unequal = parse_sampler("jitter:N^1/3xN^2/3", 2)
    assert scaling_limit(unequal, generic, Rational(1, 3)) == {(): 1, (Integer(1),): -1}
    assert scaling_limit(unequal, generic, Rational(2, 3)) == {(): 1}


@pytest.mark.parametrize("name", ["jitter", "multi-jitter"])
@pytest.mark.parametrize("dim", [2, 3])
def test_scaling_limits_vanish_at_zero(name, dim):
    sampler = parse_sampler(name, dim)
    generic = region_of_support(sampler.layout, tuple(range(1, dim + 1)))
    limit = scaling_limit(sampler, generic, Rational(1, dim))
    assert sum(limit.values()) == 0


MEASURED = [
    ("jitter", 1),
    ("jitter", 2),
    ("jitter", 3),
    ("jitter:25x40", 2),
    ("jitter:2x3x5", 3),
    ("jitter:N^1/3xN^2/3", 2),
    ("multi-jitter", 2),
    ("multi-jitter:8x16", 2),
    ("multi-jitter", 3),
    ("latin-hypercube", 2),
    ("latin-hypercube", 3),
    ("uncorrelated-jitter:1+2", 3),
]


def assert_measured(sampler, found, integrand):
    """The constant is what exact variances come to, to the error stated and to 12 digits."""
    exact = certified(lambda: constant_ball(found.constant.xreplace({R: Rational(3, 10)})), 30)
    measured = measured_constant(sampler, integrand, found.order, rungs=9, digits=40)
    with mp.workdps(40):
        gap = abs(measured.value - mp.mpf(exact.mid().str(35, radius=False)))
        assert gap <= measured.error + mp.mpf(10) ** -30
        assert gap <= 1e-12 * measured.value


@pytest.mark.parametrize(("name", "dim"), MEASURED)
def test_slowest_regions_are_the_limit_of_exact_variances(name, dim):
    terms = constants(name, dim).values()
    order = Order(min(x.order.exponent for x in terms))
    constant = sympy.Add(*[x.constant for x in terms if x.order == order])
    ball = parse_integrand("ball:radius=0.3", dim)
    assert_measured(parse_sampler(name, dim), Leading(order, constant), ball)


@pytest.mark.parametrize(
    ("name", "dim", "region"),
    [
        ("jitter", 1, "axis"),
        ("jitter", 2, "generic"),
        ("jitter:25x40", 2, "1,2"),
        ("multi-jitter", 2, "generic"),
        ("latin-hypercube", 2, "generic"),
    ],
)
def test_chords_are_the_limit_of_exact_variances(name, dim, region):
    """All but the last with a logarithm, as d(N^r V)/d ln N."""
    found = constants(name, dim, "line")[region]
    chord = parse_integrand("chord:radius=0.3", dim)
    assert_measured(parse_sampler(name, dim), found, chord)
