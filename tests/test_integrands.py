"""Integrands: coefficients against the function, power sums against brute sums, the grammar."""

import pickle
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from mpmath import mp
from specrate.numerics.integrands import CATALOGUE, parse_integrand
from specrate.numerics.integrands.gaussian import GaussianFactor
from specrate.numerics.integrands.literals import literal, parse_value
from specrate.numerics.integrands.spline import bernoulli_values, cosine_sum
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError

VALID = [
    ("disk", 2, "disk:radius=0.3"),
    ("disk:radius=0.3", 2, "disk:radius=0.3"),
    ("disk:radius=3/10", 2, "disk:radius=0.3"),
    (" disk: radius = 1/3 ", 2, "disk:radius=1/3"),
    ("ball", 1, "ball:radius=0.3"),
    ("ball", 2, "disk:radius=0.3"),
    ("ball:radius=.25", 3, "ball:radius=0.25"),
    ("ball:radius=4e-1", 7, "ball:radius=0.4"),
    ("gaussian", 2, "gaussian:sigma=0.1"),
    ("gaussian:sigma=0.1", 3, "gaussian:sigma=0.1"),
    ("gaussian:sigma=2", 1, "gaussian:sigma=2"),
    ("anisotropic-gaussian", 2, "anisotropic-gaussian:sigma=(0.1,0.4)"),
    ("anisotropic-gaussian:sigma=(0.1,0.4)", 2, "anisotropic-gaussian:sigma=(0.1,0.4)"),
    ("anisotropic-gaussian:sigma=( 1/7 , 0.4 )", 2, "anisotropic-gaussian:sigma=(1/7,0.4)"),
    ("anisotropic-gaussian:sigma=(0.2,0.2)", 2, "gaussian:sigma=0.2"),
    ("box", 2, "box:side=0.3"),
    ("box:side=0.5", 1, "box:side=0.5"),
    ("box:side=(1/3,0.5)", 2, "box:side=(1/3,0.5)"),
    ("box:side=(0.3,1)", 2, "box:side=(0.3,1)"),
    ("bernoulli", 1, "bernoulli:k=2"),
    ("bernoulli:k=1", 2, "bernoulli:k=1"),
    ("bernoulli:k=3,axes=(1,2)", 2, "bernoulli:k=3,axes=(1,2)"),
    ("bernoulli:axes=2,k=2", 3, "bernoulli:k=2,axes=(2)"),
    ("product", 2, "product:k=2"),
    ("product:k=4,c=-1.5", 2, "product:k=4,c=-1.5"),
    ("product:c=1/3", 3, "product:k=2,c=1/3"),
]

INVALID = [
    ("", 2, "one of disk, ball"),
    ("sphere", 2, "one of disk, ball"),
    ("Disk", 2, "one of"),
    ("__import__('os')", 2, "one of"),
    ("disk", 3, "dimension must be 2"),
    ("ball", 0, "1 <= dim"),
    ("disk:", 2, "key=value"),
    ("disk:0.3", 2, "key=value"),
    ("disk:r=0.3", 2, "key of radius"),
    ("disk:radius", 2, "key=value"),
    ("disk:radius=0.3,radius=0.2", 2, "once each"),
    ("disk:radius=", 2, "decimal or a fraction"),
    ("disk:radius=1/0", 2, "decimal or a fraction"),
    ("disk:radius=1/00", 2, "decimal or a fraction"),
    ("disk:radius=nan", 2, "decimal or a fraction"),
    ("disk:radius=2**3", 2, "decimal or a fraction"),
    ("disk:radius=1e9999999", 2, "decimal or a fraction"),
    ("disk:radius=\N{ARABIC-INDIC DIGIT ONE}", 2, "decimal or a fraction"),
    ("disk:radius=0.5", 2, "0 < radius < 1/2"),
    ("disk:radius=-0.1", 2, "0 < radius < 1/2"),
    ("disk:radius=(0.1,0.2)", 2, "one number"),
    ("gaussian:sigma=0", 2, "0 < sigma"),
    ("gaussian:sigma=(0.1,0.2)", 2, "one number"),
    ("anisotropic-gaussian:sigma=(0.1)", 2, "one value per coordinate"),
    ("anisotropic-gaussian:sigma=(0.1,0.2", 2, "decimal or a fraction"),
    ("anisotropic-gaussian:sigma=()", 2, "decimal or a fraction"),
    ("box:side=1.1", 2, "0 < side <= 1"),
    ("box:side=1", 2, "some side"),
    ("bernoulli:k=0", 2, "1 <= k <= 12"),
    ("bernoulli:k=1.5", 2, "integer"),
    ("bernoulli:axes=(2,1)", 2, "increasing"),
    ("bernoulli:axes=3", 2, "increasing"),
    ("product:c=0", 2, "c != 0"),
    ("product:k=13", 2, "1 <= k <= 12"),
    ("disk:radius=0." + "1" * 3000, 2, "one of"),
]


@pytest.mark.parametrize(("text", "dim", "name"), VALID)
def test_name_round_trips(text, dim, name):
    f = parse_integrand(text, dim)
    assert f.name == name
    assert f.dim == dim
    again = parse_integrand(f.name, dim)
    assert again == f
    assert hash(again) == hash(f)
    assert pickle.loads(pickle.dumps(f)) == f


@pytest.mark.parametrize(("text", "dim", "rule"), INVALID)
def test_unusable_text_is_refused_with_the_rule(text, dim, rule):
    with pytest.raises(InputError, match="got") as caught:
        parse_integrand(text, dim)
    assert rule in str(caught.value)
    assert "\n" not in str(caught.value)


def test_catalogue_is_consistent():
    names = [entry.name for entry in CATALOGUE]
    assert len(set(names)) == len(names)
    assert {text.strip().partition(":")[0] for text, _, _ in VALID} == set(names)


@pytest.mark.parametrize("text", ["0.3", "1/3", "(0.1,2/7)", "-1.5", "12", "0", "1e-30"])
def test_literals_read_back(text):
    assert parse_value(literal(parse_value(text))) == parse_value(text)


def test_parameters_are_exact():
    assert parse_integrand("disk:radius=0.3", 2).radius == Fraction(3, 10)


SMOOTH = [
    ("gaussian", 1),
    ("gaussian:sigma=0.05", 2),
    ("gaussian:sigma=0.3", 2),
    ("gaussian:sigma=1", 1),
    ("anisotropic-gaussian", 2),
]


@pytest.mark.parametrize(("text", "dim"), SMOOTH)
def test_coefficients_of_analytic_functions_against_fft(text, dim):
    f = parse_integrand(text, dim)
    axis = np.arange(64) / 64
    points = np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1)
    measured = np.abs(np.fft.fftn(f(points)) / 64**dim)
    m = np.stack(np.meshgrid(*[np.arange(20)] * dim, indexing="ij"), axis=-1)
    low = measured[(slice(20),) * dim]
    np.testing.assert_allclose(np.sqrt(f.coefficient_power(m)), low, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("text", ["ball", "box:side=2/7", "bernoulli:k=1", "bernoulli:k=5"])
def test_coefficients_on_an_axis_by_quadrature(text):
    """Midpoints between jumps: panels of 40 Gauss nodes that end at every jump."""
    f = parse_integrand(text, 1)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    ends = np.array([0, 0.2, 2 / 7, 0.5, 0.8, 1])
    half = np.diff(ends)[:, None] / 2
    x = (ends[:-1, None] + half + half * nodes).ravel()
    w = (half * weights).ravel()
    for m in range(8):
        coefficient = np.sum(w * f(x[:, None]) * np.exp(-2j * np.pi * m * x))
        power = f.coefficient_power(np.array([m]))
        assert power == pytest.approx(abs(coefficient) ** 2, rel=1e-10, abs=1e-28)


@pytest.mark.parametrize(("dim", "m"), [(2, (0, 0)), (2, (1, 2)), (3, (2, 1, 0)), (3, (0, 0, 5))])
def test_ball_coefficients_by_slices(dim, m):
    """Slices across m: ``int cos(2 pi rho t) vol_(d-1)(sqrt(R^2 - t^2)) dt``, t = R sin u."""
    radius, rho = 0.3, float(np.linalg.norm(m))
    nodes, weights = np.polynomial.legendre.leggauss(60)
    u, w = nodes * np.pi / 2, weights * np.pi / 2
    unit = 2 if dim == 2 else np.pi
    slices = unit * (radius * np.cos(u)) ** (dim - 1) * radius * np.cos(u)
    coefficient = np.sum(w * slices * np.cos(2 * np.pi * rho * radius * np.sin(u)))
    f = parse_integrand("ball", dim)
    assert f.coefficient_power(np.array(m)) == pytest.approx(coefficient**2, rel=1e-12)


def test_values():
    centre = np.array([[0.5, 0.5], [0.5, 0.79], [0.5, 0.81]])
    assert parse_integrand("disk", 2)(centre).tolist() == [1, 1, 0]
    assert parse_integrand("box", 2)(np.array([[0.1, 0.29], [0.1, 0.3]])).tolist() == [1, 0]
    assert parse_integrand("gaussian", 2)(centre)[0] == pytest.approx(1, rel=1e-10)
    x = np.array([[0.0, 0.3], [0.7, 0.3]])
    b2 = x**2 - x + 1 / 6
    np.testing.assert_allclose(parse_integrand("bernoulli", 2)(x), b2[:, 0])
    np.testing.assert_allclose(parse_integrand("product", 2)(x), np.prod(1 + b2, axis=1))
    assert parse_integrand("box", 3)(np.zeros((4, 5, 3))).shape == (4, 5)


def test_narrow_and_wide_gaussians_agree_where_the_method_changes():
    x = np.linspace(0, 1, 9)[:-1, None]
    below = parse_integrand("gaussian:sigma=0.2499999999999", 1)(x)
    above = parse_integrand("gaussian:sigma=0.25", 1)(x)
    np.testing.assert_allclose(below, above, rtol=1e-11)


@pytest.mark.parametrize("k", range(1, 13))
def test_bernoulli_polynomials(k):
    x = np.linspace(0, 1, 30, endpoint=False)
    exact = [float(mpmath.bernpoly(k, t)) for t in x]
    np.testing.assert_allclose(bernoulli_values(k, x), exact, rtol=1e-12, atol=1e-14)


def test_cosine_sum_is_the_zeta_value_and_the_series():
    with mp.workdps(30):
        for k in (1, 2, 5):
            value = cosine_sum(k, Fraction(0))
            zeta = 2 * mp.zeta(2 * k) / (2 * mp.pi) ** (2 * k)
            assert mp.almosteq(zeta * value.denominator, value.numerator, rel_eps=1e-25)
    j = np.arange(1, 3000)
    series = np.sum(2 * np.cos(2 * np.pi * j * 0.3) / (2 * np.pi * j) ** 6)
    assert float(cosine_sum(3, Fraction(-7, 10))) == pytest.approx(series, rel=1e-12)


ONE_D = [
    "ball",
    "box:side=0.3",
    "box:side=1/3",
    "bernoulli:k=1",
    "bernoulli:k=2",
    "bernoulli:k=4",
    "product:k=2,c=-3",
    "gaussian",
    "gaussian:sigma=0.01",
    "gaussian:sigma=1/20",
    "gaussian:sigma=2",
]


@pytest.mark.parametrize("text", ONE_D)
def test_power_sums_against_brute_sums(text):
    """Over |m| < M = 2e5: the rest is at most ``c/M`` (total, combs) or ``c n^2/M^3`` (sinc^2)."""
    (factor,) = parse_integrand(text, 1).factors
    size = 200_000
    m = np.arange(1, size)
    power = 2 * factor.power(m)
    jump2 = float(np.max(m**2.0 * power)) if "gaussian" not in text else 0.0
    rounding = 1e-12 * float(np.sum(power))
    tail = 2 * jump2 / size + rounding
    smooth_tail = 2 * jump2 * 100**2 / size**3 + rounding
    assert abs(float(factor.total()) - np.sum(power)) < tail
    for n in (1, 2, 7, mp.mpf(7.5), mp.mpf("0.4"), 100):
        brute = np.sum(power * np.sinc(m / float(n)) ** 2)
        assert abs(float(factor.sinc2_sum(n)) - brute) < smooth_tail
    for n in (1, 3, 10):
        assert abs(float(factor.comb_sum(n)) - np.sum(power[n - 1 :: n])) < tail
        for n2 in (1, 2, 30, 31, 100, mp.mpf(7.5)):
            brute = np.sum((power * np.sinc(m / float(n2)) ** 2)[n - 1 :: n])
            assert abs(float(factor.comb_sinc2_sum(n, n2)) - brute) < smooth_tail


@pytest.mark.parametrize("text", ONE_D)
def test_power_sums_keep_the_working_precision(text):
    """Every sum at 20 digits agrees with the same sum at 70, to 18 digits of itself."""
    (factor,) = parse_integrand(text, 1).factors

    def sums(digits):
        with mp.workdps(digits):
            return [
                factor.total(),
                *(factor.sinc2_sum(n) for n in (2, 1000, 10**20, 10**60, mp.mpf(3) / 2)),
                *(factor.comb_sum(n) for n in (2, 1000, 10**20)),
                *(factor.comb_sinc2_sum(n, n2) for n, n2 in ((4, 10), (3, 10**20), (50, 7))),
            ]

    for short, long in zip(sums(20), sums(70), strict=True):
        with mp.workdps(20):
            assert abs(short - long) <= mp.mpf(10) ** -18 * abs(long)


@pytest.mark.parametrize(
    ("text", "roughness"),
    [
        ("bernoulli:k=2", lambda: 8 * mp.zeta(2) / (2 * mp.pi) ** 4),
        ("bernoulli:k=3", lambda: 72 * mp.zeta(4) / (2 * mp.pi) ** 6),
        ("gaussian", lambda: _gaussian_roughness(mp.mpf(1) / 10)),
        ("gaussian:sigma=0.02", lambda: _gaussian_roughness(mp.mpf(1) / 50)),
    ],
)
def test_huge_n_against_the_asymptotic_deficit(text, roughness):
    """``total - sinc2_sum(n) ~ pi^2/(3 n^2) sum m^2 |fhat|^2``, the rest smaller by n^-1."""
    (factor,) = parse_integrand(text, 1).factors
    n = 10**20
    with mp.workdps(80):
        deficit = (factor.total() - factor.sinc2_sum(n)) * n**2 * 3 / mp.pi**2
        assert mp.almosteq(deficit, roughness(), rel_eps=mp.mpf(10) ** -17)


def _gaussian_roughness(s):
    """``sum m^2 |fhat|^2`` by its own terms."""
    terms = (m**2 * mp.exp(-((2 * mp.pi * s * m) ** 2)) for m in range(1, 400))
    return 4 * mp.pi * s**2 * mp.fsum(terms)


def test_huge_n_of_a_jump():
    """Two unit jumps: ``total - sinc2_sum(n) = E |Delta| = 1/(3 n)`` for 1/n below the side."""
    (factor,) = parse_integrand("box", 1).factors
    with mp.workdps(80):
        deficit = (factor.total() - factor.sinc2_sum(10**20)) * 3 * 10**20
        assert mp.almosteq(deficit, 1, rel_eps=mp.mpf(10) ** -50)


def test_jittered_variance_of_bernoulli_polynomials_in_closed_form():
    """Randomly shifted 1D jitter: N V = sigma^2 - tau, k = 2: 1/36N^2 - 1/30N^3 + 1/90N^4."""
    (first,) = parse_integrand("bernoulli:k=1", 1).factors
    (second,) = parse_integrand("bernoulli:k=2", 1).factors
    for n in (1, 3, 10**6):
        with mp.workdps(60):
            assert mp.almosteq(first.total() - first.sinc2_sum(n), _poly(n, {1: 6, 2: -12}))
            expected = _poly(n, {2: 36, 3: -30, 4: 90})
            assert mp.almosteq(second.total() - second.sinc2_sum(n), expected)


def _poly(n, terms):
    return mp.fsum(mp.mpf(1) / (c * mp.mpf(n) ** p) for p, c in terms.items())


def test_extreme_counts_stay_finite():
    gaussian, box = GaussianFactor(Fraction(1, 10)), parse_integrand("box", 1).factors[0]
    assert 0 <= gaussian.comb_sum(10**300) < mp.mpf(10) ** -1000
    assert mp.almosteq(gaussian.sinc2_sum(10**300), gaussian.total())
    assert mp.almosteq(box.sinc2_sum(10**300), box.total())
    assert mp.almosteq(box.sinc2_sum(mp.mpf("1e300")), box.total())


@pytest.mark.parametrize("n", [0, -3, mp.mpf(0), mp.inf, mp.nan])
def test_counts_must_be_positive(n):
    for text in ("box", "gaussian"):
        with pytest.raises(InputError, match="0 < n"):
            parse_integrand(text, 1).factors[0].sinc2_sum(n)


SUITED = [(e.name, d) for e in CATALOGUE for d in (1, 2, 3) if e.name != "disk" or d == 2]


@pytest.mark.parametrize(("text", "dim"), SUITED)
def test_mean_and_total_against_midpoints(text, dim):
    """A shifted grid of 60^d points integrates f and f^2 up to the boundary cells, c d/60."""
    f = parse_integrand(text, dim)
    axis = (np.arange(60) + 0.37) / 60
    values = f(np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1))
    assert float(f.mean(15)) == pytest.approx(np.mean(values), abs=4e-3 * dim)
    assert float(f.total(15)) == pytest.approx(np.var(values), abs=4e-3 * dim)


def test_means_to_fifty_digits():
    with mp.workdps(50):
        width = mp.mpf(1) / 10
        line = mp.quad(lambda t: mp.exp(-(t**2) / (2 * width**2)), [-4, -1, 0, 1, 4])
        slices = mp.quad(
            lambda u: 2 * mp.pi * (mp.mpf(3) / 10 * mp.cos(u)) ** 2 * mp.mpf(3) / 10 * mp.cos(u),
            [0, mp.pi / 2],
        )
        checks = [
            (parse_integrand("gaussian", 2), line**2),
            (parse_integrand("ball", 3), slices),
            (parse_integrand("ball", 1), mp.mpf(6) / 10),
            (parse_integrand("box:side=(1/3,0.5)", 2), mp.mpf(1) / 6),
            (parse_integrand("bernoulli:k=3", 2), mp.mpf(0)),
            (parse_integrand("product:k=2,c=7", 2), mp.mpf(1)),
        ]
        for f, expected in checks:
            assert mp.almosteq(f.mean(50), expected, rel_eps=mp.mpf(10) ** -47)


def test_parseval_of_the_ball():
    """``V (1 - V)`` against the sum over |m_i| <= 400; the rest is ``R/(pi K)`` within 5 %."""
    f = parse_integrand("disk", 2)
    m = np.arange(-400, 401)
    grid = np.stack(np.meshgrid(m, m, indexing="ij"), axis=-1)
    rest = float(f.total(15)) - (np.sum(f.coefficient_power(grid)) - float(f.mean(15)) ** 2)
    square = 2 * np.sqrt(2) / np.pi  # 1/K averaged over the directions out of a square
    assert rest == pytest.approx(0.3 / (np.pi * 400) * square, rel=0.05)


@pytest.mark.parametrize("text", ["box:side=(0.3,0.7)", "product:k=1", "anisotropic-gaussian"])
def test_factors_multiply_to_the_whole(text):
    f = parse_integrand(text, 2)
    m = stream(1, 2).integers(-9, 10, size=(50, 2))
    parts = [factor.power(m[:, i]) for i, factor in enumerate(f.factors)]
    np.testing.assert_allclose(f.coefficient_power(m), parts[0] * parts[1], rtol=1e-14)
    (a, s), (b, t) = [(factor.mean() ** 2, factor.total()) for factor in f.factors]
    assert mp.almosteq(f.total(15), (a + s) * (b + t) - a * b, rel_eps=1e-12)


def test_only_balls_of_several_dimensions_are_no_products():
    for entry in CATALOGUE:
        f = parse_integrand(entry.name, 2)
        assert (f.factors is None) == (entry.name in ("disk", "ball"))
    assert len(parse_integrand("ball", 1).factors) == 1


def test_bernoulli_lives_on_one_support():
    f = parse_integrand("bernoulli:k=2,axes=(1,3)", 3)
    m = np.array([[1, 0, 1], [1, 1, 1], [1, 0, 0], [0, 0, 0]])
    assert (f.coefficient_power(m) > 0).tolist() == [True, False, False, False]
