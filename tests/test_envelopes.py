"""The derived profile bounds the exact spectrum from both sides, with constants free of N.

Measured over all cases below the ratios lie in [0.28, 3.2]. The lower end is geometry: a comb in
three dimensions has one tooth (1, 1, 1) in the octant's shell [1, 2) of volume 7π/6. The upper
end is the lowest shell of correlated multi-jitter, where |m|² and m_1² m_2² add and only the
larger counts. The bounds stated are these with a margin of a quarter.
"""

from functools import cache
from itertools import combinations

import numpy as np
import pytest
from specrate.numerics.expected_spectra.envelopes import envelope, profile_values
from specrate.theory.errors import InputError
from specrate.theory.profiles import SaturatingMonomial
from specrate.theory.rates import profile_of
from specrate.theory.regions import region_of_support, regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.symbolic import Integer, Rational, sympy
from strategies import catalogue_names

LOW, HIGH = 0.22, 4.0
COUNTS = (16, 64, 256, 1024, 4096)

STRATA = {
    2: (
        "jitter:1x4",
        "jitter:N^1/3xN^2/3",
        "jitter:4xN",
        "regular:1x4",
        "multi-jitter:1x4",
        "multi-jitter:N^1/3xN^2/3",
        "correlated-multi-jitter:1x4",
        "correlated-multi-jitter:4xN",
        "correlated-multi-jitter:N^1/3xN^2/3",
        "uncorrelated-jitter:1+1",
        "uncorrelated-jitter:2",
    ),
    3: (
        "jitter:1x2x3",
        "uncorrelated-jitter:1+2",
        "uncorrelated-jitter:1+1+1",
        "uncorrelated-jitter:1+N^1/3xN^2/3",
    ),
}


def cases():
    """One support of every region of every kernel in two and three dimensions."""
    for dim in (2, 3):
        for name in (*catalogue_names(dim), *STRATA[dim]):
            layout = parse_sampler(name, dim).layout
            seen = set()
            for w in range(1, dim + 1):
                for support in combinations(range(1, dim + 1), w):
                    region = region_of_support(layout, support)
                    if region.counts not in seen:
                        seen.add(region.counts)
                        yield pytest.param(name, dim, support, id=f"{name}-{dim}D-{region.label}")


CASES = list(cases())


@cache
def measured(name, dim, support, n):
    return envelope(parse_sampler(name, dim), support, n)


@pytest.mark.parametrize(("name", "dim", "support"), CASES)
def test_profile_bounds_the_kernel_from_both_sides(name, dim, support):
    found = [measured(name, dim, support, n) for n in COUNTS]
    assert min(e.low for e in found) > LOW
    assert max(e.high for e in found) < HIGH
    assert found[-1].count > 64 * found[0].count


@pytest.mark.parametrize(("name", "dim", "support"), CASES)
def test_constants_do_not_drift_with_n(name, dim, support):
    """From 16 to 4096 a profile wrong by N^0.15 in the order would move a constant twofold."""
    first, last = (measured(name, dim, support, n) for n in (COUNTS[1], COUNTS[-1]))
    assert 0.6 < last.low / first.low < 1.7
    assert 0.6 < last.high / first.high < 1.7


def test_cases_reach_every_region():
    """The list is not stale: as many cases as the layouts have regions."""
    expected = sum(
        len(regions(parse_sampler(name, dim).layout))
        for dim in (2, 3)
        for name in (*catalogue_names(dim), *STRATA[dim])
    )
    assert len(CASES) == expected


def test_a_profile_without_its_second_monomial_is_caught():
    """Correlated multi-jitter by its first series term alone (b = 2, e = 1) grows as N."""
    sampler = parse_sampler("correlated-multi-jitter", 2)
    whole = profile_of(sampler, region_of_support(sampler.layout, (1, 2)))
    first = [m for m in whole if (m.degree, m.effective) == (2, 1)]
    assert len(first) == 1
    assert len(whole) == 2
    found = [envelope(sampler, (1, 2), n, first) for n in (16, 64, 256)]
    assert found[0].high > HIGH
    assert found[2].high / found[1].high == pytest.approx(4, rel=0.3)
    assert found[1].high / found[0].high == pytest.approx(4, rel=0.3)


@pytest.mark.parametrize(
    ("degree", "effective", "n"),
    [
        (2, Integer(1), 256),
        (4, Rational(1, 2), 4096),
        (1, Rational(1, 2), 4096),
        (2, Rational(1, 3), 4096),
        (0, Integer(0), 4096),
    ],
)
def test_wrong_profiles_of_jitter_are_caught(degree, effective, n):
    """Each is wrong in the degree or in N_k, where b = 2, e = 1/2 would be right."""
    sampler = parse_sampler("jitter", 2)
    wrong = [SaturatingMonomial(Integer(degree), effective)]
    found = envelope(sampler, (1, 2), n, wrong)
    assert found.low < LOW or found.high > HIGH


def test_a_step_where_there_is_power_is_caught():
    step = [SaturatingMonomial(sympy.oo, Rational(1, 2))]
    with pytest.raises(InputError, match="must vanish where the profile does"):
        envelope(parse_sampler("jitter", 2), (1, 2), 256, step)


def test_shells_are_dyadic_and_reach_beyond_saturation():
    found = envelope(parse_sampler("random", 1), (1,), 64)
    assert np.allclose(np.diff(np.log2(found.radii)), 1)
    jitter = envelope(parse_sampler("jitter", 1), (1,), 64)
    assert jitter.radii[0] <= 1
    assert jitter.radii[-1] > 64 * 3**0.5 / 3.15
    assert jitter.low == min(jitter.ratios)
    assert jitter.high == max(jitter.ratios)


def test_profile_values_are_the_largest_monomial():
    monomials = [
        SaturatingMonomial(Integer(2), Integer(1), Integer(1)),
        SaturatingMonomial(Integer(4), Rational(1, 2), Integer(1)),
    ]
    radius = np.array([1.0, 4.0, 10.0, 1000.0])
    found = profile_values(monomials, {"N": 100}, radius)
    assert found == pytest.approx([1e-4, 4**4 / 1e4, 1, 1], rel=1e-6)


def test_lowest_shells_have_the_derived_coefficient():
    """γ/α^b is exact as N → ∞: at N = 4096 jitter's first ratios are 1 to a per mille or so."""
    found = envelope(parse_sampler("jitter", 1), (1,), 4096)
    assert found.ratios[:3] == pytest.approx((1, 1, 1), rel=1e-3)


@pytest.mark.parametrize(
    ("name", "dim", "support", "n", "rule"),
    [
        ("isotropic:2", 2, (1,), 64, "a sampler with a spectrum"),
        ("uncorrelated-jitter:1+2x3", 3, (1,), 64, "."),
        ("regular:N^1/4xN^1/4xN^1/2", 3, (1, 2, 3), 10**7, "at most 4000000"),
    ],
)
def test_what_has_no_envelope_says_so(name, dim, support, n, rule):
    with pytest.raises(InputError, match=rule) as caught:
        envelope(parse_sampler(name, dim), support, n)
    assert "\n" not in str(caught.value)
