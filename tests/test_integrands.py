"""Integrands: the grammar, coefficients against the function, values, means and totals."""

import pickle
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from mpmath import mp
from specrate.numerics.integrands import CATALOGUE, parse_integrand
from specrate.numerics.integrands.literals import literal, parse_value
from specrate.numerics.integrands.protocol import to_mpf
from specrate.numerics.integrands.spline import bernoulli_values
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
    ("chord", 2, "chord:radius=0.3"),
    ("chord:radius=1/4", 1, "chord:radius=0.25"),
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
    ("half-space", 3, "half-space:side=0.3"),
    ("half-space:side=2/3", 1, "half-space:side=2/3"),
    ("bernoulli", 1, "bernoulli:k=2"),
    ("bernoulli:k=1", 2, "bernoulli:k=1"),
    ("bernoulli:k=3,axes=(1,2)", 2, "bernoulli:k=3,axes=(1,2)"),
    ("bernoulli:axes=2,k=2", 3, "bernoulli:k=2,axes=(2)"),
    ("product", 2, "product:k=2"),
    ("product:k=4,c=-1.5", 2, "product:k=4,c=-1.5"),
    ("product:c=1/3", 3, "product:k=2,c=1/3"),
    ("additive", 1, "additive:k=2"),
    ("additive:k=1", 3, "additive:k=1"),
    ("polylog", 2, "polylog:p=2.5"),
    ("polylog:p=4/3", 1, "polylog:p=4/3"),
    ("ridge", 2, "ridge:k=(1,1)"),
    ("ridge:k=(1,-2,0)", 3, "ridge:k=(1,-2,0)"),
    ("ridge:k=3,b=1", 2, "ridge:k=(3,3),b=1"),
    ("ridge:b=2,k=(1,1)", 2, "ridge:k=(1,1)"),
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
    ("chord:radius=1/2", 2, "0 < radius < 1/2"),
    ("gaussian:sigma=0", 2, "0 < sigma"),
    ("gaussian:sigma=1e7", 2, "0 < sigma <= 1000000"),
    (f"disk:radius=0.1{'0' * 39}1", 2, "decimal or a fraction"),
    (f"disk:radius={'1' * 20}.{'1' * 21}e-20", 2, "at most 40 digits"),
    (f"disk:radius=0.{'0' * 30}1e-980", 2, "within 1e-999 and 1e999"),
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
    ("half-space:side=1", 2, "0 < side < 1"),
    ("half-space:side=(0.1,0.2)", 2, "one number"),
    ("additive:k=0", 2, "1 <= k <= 12"),
    ("additive:c=1", 2, "key of k"),
    ("polylog:p=1", 2, "1 < p <= 100"),
    ("polylog:p=1e9", 2, "1 < p <= 100"),
    ("ridge:k=(0,0)", 2, "k != 0"),
    ("ridge:k=(1,1/2)", 2, "integer"),
    ("ridge:k=(1,1,1)", 2, "one value per coordinate"),
    ("ridge:b=13", 2, "1 <= b <= 12"),
    ("disk:radius=0." + "1" * 30_000, 2, "one of"),
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


@pytest.mark.parametrize("text", [
    "0.3", "1/3", "(0.1,2/7)", "-1.5", "12", "0", "1e-30", "1e-45", "1e999", "-3e-999", "1e45",
    f"0.{'7' * 40}", f"{'7' * 40}e-999", f"1/{'9' * 40}", f"0.{'0' * 39}7",
])  # fmt: skip
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


@pytest.mark.parametrize(
    "text", ["ball", "box:side=2/7", "bernoulli:k=1", "bernoulli:k=5", "half-space:side=1/5"]
)
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


@pytest.mark.parametrize("p", ["2.2", "5/2", "3", "6", "6.0000000001", "10", "23/3"])
def test_polylogarithms_have_the_power_of_their_name(p):
    """Against the quadrature of f cos(2πmx), x = t^8 so that the cusp at 0 is smooth in t."""
    f = parse_integrand(f"polylog:p={p}", 1)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    top = 0.5 ** (1 / 8)
    t, w = top * (nodes + 1) / 2, top * weights / 2
    x = t**8
    for m in range(5):
        wave = np.sum(w * 8 * t**7 * f(x[:, None]) * np.cos(2 * np.pi * m * x))
        power = f.coefficient_power(np.array([m]))
        assert power == pytest.approx((2 * wave) ** 2, rel=1e-8, abs=1e-20)


@pytest.mark.parametrize("p", ["1.2", "1.999999999999", "2", "2.000000000001", "5/2", "6.000001"])
def test_polylogarithms_against_mpmath(p):
    x = np.array([1e-9, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.999])
    found = parse_integrand(f"polylog:p={p}", 1)(x[:, None])
    with mp.workdps(50):
        s = mp.mpf(p.partition("/")[0]) / (2 * int(p.partition("/")[2] or 1))
        expected = [float(2 * mp.re(mp.polylog(s, mp.expjpi(2 * mp.mpf(t))))) for t in x]
    np.testing.assert_allclose(found, expected, rtol=1e-13)


def test_polylogarithms_at_their_pole():
    """Finite at x = 0: the sum 2 zeta(p/2) for p > 2, else the value at a distance of 2^-54."""
    at_zero = parse_integrand("polylog:p=6", 1)(np.zeros((1, 1)))
    assert at_zero == pytest.approx(2 * float(mpmath.zeta(3)), rel=1e-15)
    pole = parse_integrand("polylog:p=3/2", 1)
    assert pole(np.zeros((1, 1))) == pole(np.full((1, 1), 2.0**-54))
    assert np.isfinite(pole(np.zeros((1, 1)))).all()


SUITED = [
    ("polylog:p=5" if e.name == "polylog" else e.name, d)  # its cusp at p = 5/2 is not for grids
    for e in CATALOGUE
    for d in (1, 2, 3)
    if e.name != "disk" or d == 2
]


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
            (parse_integrand("half-space:side=1/3", 3), mp.mpf(1) / 3),
            (parse_integrand("product:k=2,c=7", 2), mp.mpf(1)),
        ]
        for f, expected in checks:
            assert mp.almosteq(to_mpf(f.mean(50)), expected, rel_eps=mp.mpf(10) ** -47)
            assert f.mean(50).rel_accuracy_bits() > 166
    for text in ("bernoulli:k=3", "additive", "polylog", "ridge"):
        assert parse_integrand(text, 2).mean(50).is_zero()


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
    ((first, second),) = ([factor for _, factor in part] for part in f.parts)
    powers = first.power(m[:, 0]) * second.power(m[:, 1])
    np.testing.assert_allclose(f.coefficient_power(m), powers, rtol=1e-14)
    a, s, b, t = (first.mean() ** 2, first.power_sum(), second.mean() ** 2, second.power_sum())
    assert float(f.total(15)) == pytest.approx(float((a + s) * (b + t) - a * b), rel=1e-12)


def test_only_balls_chords_and_ridges_are_no_sums_of_products():
    for entry in CATALOGUE:
        f = parse_integrand(entry.name, 2)
        assert (f.parts == ()) == (entry.name in ("disk", "ball", "chord", "ridge"))
    assert len(parse_integrand("ball", 1).parts) == 1
    assert len(parse_integrand("additive", 3).parts) == 3


@pytest.mark.parametrize(
    ("text", "support"),
    [
        ("bernoulli:k=2,axes=(1,3)", (1, 3)),
        ("half-space", (1,)),
        ("polylog", (1,)),
        ("ridge:k=(0,2,-1)", (2, 3)),
        ("box:side=(1,0.5,1)", (2,)),
        ("box", None),
        ("product", None),
        ("additive", None),
        ("ball", None),
    ],
)
def test_support_carries_all_power(text, support):
    f = parse_integrand(text, 3)
    assert f.support == support
    m = stream(4).integers(-2, 3, size=(400, 3))
    m = m[(m != 0).any(axis=1)]
    supports = {tuple(int(i) + 1 for i in np.flatnonzero(k)) for k in m[f.coefficient_power(m) > 0]}
    assert (supports == {support}) if support else len(supports) > 1


def test_ridges_have_power_on_the_multiples_of_k_alone():
    """|fhat(j k)|² = (b!/(2πj)^b)²; by FFT on a grid that resolves all of |m_i| < 32."""
    f = parse_integrand("ridge:k=(2,-1),b=4", 2)
    axis = np.arange(64) / 64
    points = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1)
    measured = np.abs(np.fft.fft2(f(points)) / 64**2) ** 2
    m = np.stack(np.meshgrid(*[np.arange(-6, 7)] * 2, indexing="ij"), axis=-1)
    expected = f.coefficient_power(m)
    assert np.count_nonzero(expected) == 6  # j = ±1, ±2, ±3
    # The waves j + 32 i of the grid are added to the wave j: 24/(2π 29)^4 of amplitude at most.
    np.testing.assert_allclose(
        np.sqrt(expected), np.sqrt(measured[m[..., 0], m[..., 1]]), atol=1e-7
    )
