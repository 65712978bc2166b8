"""Crossovers: N* in closed form, by independent quadrature, and against exact variances."""

from itertools import pairwise
from math import log

import pytest
from mpmath import mp
from specrate.numerics.exact_variances.crossovers import crossovers, region_constants
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.theory.orders import Order
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, Rational

SIGMAS = ((0.1, 0.4), (0.08, 0.3, 0.2))


def integrand(sigmas: tuple[float, ...]) -> str:
    """The anisotropic Gaussian of given widths, in the grammar."""
    return f"anisotropic-gaussian:sigma=({','.join(map(str, sigmas))})"


class Periodised:
    """exp(-(x - 1/2)²/2σ²) summed over translates: its integrals by quadrature, not by series."""

    def __init__(self, sigma: float) -> None:
        self.sigma = mp.mpf(str(sigma))
        shifts = range(-6, 7)

        def value(x: object) -> object:
            return mp.fsum(mp.exp(-((x - 0.5 + k) ** 2) / (2 * self.sigma**2)) for k in shifts)

        def slope(x: object) -> object:
            return mp.fsum(
                -(x - 0.5 + k) / self.sigma**2 * mp.exp(-((x - 0.5 + k) ** 2) / (2 * self.sigma**2))
                for k in shifts
            )

        breaks = mp.linspace(0, 1, 9)
        self.mean = mp.quad(value, breaks)
        self.energy = mp.quad(lambda x: value(x) ** 2, breaks)
        self.slope_energy = mp.quad(lambda x: slope(x) ** 2, breaks)


def expected(sigmas: tuple[float, ...]) -> tuple[object, object]:
    """Σ ‖f_i'‖²/12 over the axes, and the variance that interactions of two axes or more carry."""
    factors = [Periodised(s) for s in sigmas]
    means2 = mp.fprod(f.mean**2 for f in factors)
    axes = mp.fsum(f.slope_energy * means2 / f.mean**2 for f in factors) / 12
    one = mp.fsum((f.energy - f.mean**2) * means2 / f.mean**2 for f in factors)
    return axes, mp.fprod(f.energy for f in factors) - means2 - one


@pytest.mark.parametrize("sigmas", SIGMAS)
def test_latin_hypercube_in_closed_form(sigmas: tuple[float, ...]) -> None:
    """N* = sqrt(Σ‖f_i'‖²/(12 σ²_{w>=2})); in 3D the regions w = 2 and w = 3 share N^-1."""
    dim = len(sigmas)
    sampler = parse_sampler("latin-hypercube", dim)
    found = region_constants(sampler, parse_integrand(integrand(sigmas), dim))
    axes, interactions = expected(sigmas)
    axis, *rest = found
    assert axis.order == Order(Integer(3))
    assert {c.order for c in rest} == {Order(Integer(1))}
    assert axis.constant == pytest.approx(axes, rel=1e-12)
    assert mp.fsum(c.constant for c in rest) == pytest.approx(interactions, rel=1e-12)
    (meeting,) = crossovers(sampler, parse_integrand(integrand(sigmas), dim))
    assert meeting.count == pytest.approx(mp.sqrt(axes / interactions), rel=1e-12)
    assert meeting.slow.region == ("generic" if dim == 2 else "w=2; generic")


def local_slope(name: str, text: str, dim: int, n: int) -> float:
    """d log V / d log N of the exact variance between N = n and its next power-of-two like."""
    sampler, f = parse_sampler(name, dim), parse_integrand(text, dim)
    assert sampler.counts_at is not None
    first, second = sampler.counts_at(n), sampler.counts_at(4 * n)
    values = [exact_variance(sampler, c, f, digits=25).value for c in (first, second)]
    return float(mp.log(values[1] / values[0])) / log(second["N"] / first["N"])


# Nearly additive integrands: widths so large that interactions are small, N* is large.
WIDE = "anisotropic-gaussian:sigma=(0.6,0.7)"


@pytest.mark.parametrize(("name", "slow"), [("latin-hypercube", -1.0), ("multi-jitter", -2.0)])
def test_slopes_change_at_the_crossover(name: str, slow: float) -> None:
    sampler, f = parse_sampler(name, 2), parse_integrand(WIDE, 2)
    (meeting,) = crossovers(sampler, f)
    star = float(meeting.count)
    assert star > 1000
    assert local_slope(name, WIDE, 2, int(star / 100)) == pytest.approx(-3, abs=0.05)
    assert local_slope(name, WIDE, 2, int(star * 100)) == pytest.approx(slow, abs=0.05)
    at = local_slope(name, WIDE, 2, int(star / 2))
    assert -3 < at < slow


@pytest.mark.parametrize("name", ["latin-hypercube", "multi-jitter"])
def test_both_terms_are_half_of_the_exact_variance_at_the_crossover(name: str) -> None:
    sampler, f = parse_sampler(name, 2), parse_integrand(WIDE, 2)
    (meeting,) = crossovers(sampler, f)
    assert sampler.counts_at is not None
    counts = sampler.counts_at(int(meeting.count))
    n = counts["N"]
    terms = [
        x.constant * mp.mpf(n) ** -float(x.order.exponent) for x in (meeting.fast, meeting.slow)
    ]
    exact = exact_variance(sampler, counts, f, digits=25).value
    assert float(exact / mp.fsum(terms)) == pytest.approx(1, rel=0.01)
    assert float(terms[0] / terms[1]) == pytest.approx(1, rel=0.15)


def test_blocks_in_three_dimensions() -> None:
    name = "uncorrelated-jitter:1+2"
    sampler = parse_sampler(name, 3)
    f = parse_integrand("anisotropic-gaussian:sigma=(0.5,0.6,0.7)", 3)
    constants = {c.region: c for c in region_constants(sampler, f)}
    assert constants["within {1}"].order == Order(Integer(3))
    assert constants["within {2,3}"].order == Order(Integer(2))
    assert {c.order for r, c in constants.items() if r.startswith("across")} == {Order(Integer(1))}
    met = crossovers(sampler, f)
    assert all(a.count < b.count for a, b in pairwise(met))
    assert [str(x.slow.order) for x in met][-1] == "N^-1"
    assert sampler.counts_at is not None
    counts = sampler.counts_at(10**6)
    exact = exact_variance(sampler, counts, f, digits=25).value
    n = mp.mpf(counts["N"])
    terms = [c.constant * n ** -float(c.order.exponent) for c in constants.values()]
    assert float(exact / mp.fsum(terms)) == pytest.approx(1, rel=0.01)


def test_constants_of_jitter_are_exact_limits() -> None:
    sampler, f = parse_sampler("jitter", 2), parse_integrand(integrand((0.1, 0.4)), 2)
    constants = region_constants(sampler, f)
    assert {c.order for c in constants} == {Order(Integer(2))}
    counts = {"N": 10**8, "n": 10**4}
    exact = exact_variance(sampler, counts, f, digits=25).value * mp.mpf(10) ** 16
    assert float(exact / mp.fsum(c.constant for c in constants)) == pytest.approx(1, rel=1e-6)
    assert crossovers(sampler, f) == ()


def test_isotropic_gaussians_cross_too() -> None:
    (meeting,) = crossovers(parse_sampler("n-rooks", 2), parse_integrand("gaussian:sigma=0.2", 2))
    assert meeting.fast.region == "axis"
    assert meeting.slow.region == "generic"


@pytest.mark.parametrize(
    ("name", "dim", "text"),
    [("n-rooks", 2, "disk"), ("isotropic:2", 2, "gaussian"), ("regular", 2, "gaussian")],
)
def test_no_crossover_without_moments_or_monomials(name: str, dim: int, text: str) -> None:
    assert crossovers(parse_sampler(name, dim), parse_integrand(text, dim)) == ()


def test_symbolic_exponents_of_three_regions() -> None:
    """In 3D multi-jitter falls as N^-3 and then as N^(-5/3)."""
    sampler = parse_sampler("multi-jitter", 3)
    met = crossovers(sampler, parse_integrand("gaussian:sigma=0.5", 3))
    assert met[0].fast.order == Order(Integer(3))
    assert met[-1].slow.order == Order(Rational(5, 3))
