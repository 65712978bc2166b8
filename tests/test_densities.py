"""Spectral densities: N·P_S at generic frequencies, without what stands on null sets."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.equation17.densities import (
    density_array,
    density_of,
    expanded,
    sinc2_deficit,
)
from specrate.numerics.expected_spectra.spectra import scaled_power
from specrate.numerics.integrands.protocol import mp
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

F = Fraction
SAMPLERS = (
    ("random", 3, 16),
    ("jitter", 1, 7),
    ("jitter:2x8", 2, 16),
    ("jitter", 4, 81),
    ("latin-hypercube", 2, 16),
    ("latin-hypercube", 3, 9),
    ("multi-jitter", 2, 25),
    ("multi-jitter:3x5", 2, 15),
    ("multi-jitter", 3, 27),
    ("correlated-multi-jitter:3x5", 2, 15),
    ("uncorrelated-jitter:1+2", 3, 16),
)


def made(name, dim, n):
    sampler = parse_sampler(name, dim)
    counts = sampler.counts_at(n)
    return sampler, counts, density_of(sampler, counts)


@given(st.sampled_from(SAMPLERS), st.data())
def test_at_frequencies_off_axes_and_teeth_it_is_the_spectrum(case, data):
    """No coordinate 0 and none a multiple of a count: an integer is as good as any real number."""
    sampler, counts, density = made(*case)
    free = st.integers(-200, 200).filter(lambda k: all(k % n for n in counts.values() if n > 1))
    m = data.draw(st.lists(free.filter(bool), min_size=density.dim, max_size=density.dim))
    found = density_array(expanded(density), np.array(m, float))
    assert float(found) == pytest.approx(float(scaled_power(sampler, counts, m)), abs=3e-14)


@pytest.mark.parametrize("n", [4, 10**3, 10**12])
def test_jitter_has_the_structure_factor_of_its_lattice(n):
    """1 − sinc²(ν_1/n) sinc²(ν_2/n), to 1e-14 of its value at low frequencies too."""
    _, _, density = made("jitter", 2, n * n)
    nu = np.array([[0.3, 1.7], [2.5, 0.01], [1e-3, 1e-3]])
    found = density_array(expanded(density), nu)
    with mp.workdps(50):
        for value, (a, b) in zip(found, nu, strict=True):
            exact = 1 - (mp.sincpi(mp.mpf(a) / n) * mp.sincpi(mp.mpf(b) / n)) ** 2
            assert abs(value / exact - 1) < 1e-14


@pytest.mark.parametrize("d", [2, 3, 5])
def test_a_latin_hypercube_is_random_but_for_one_product(d):
    """S = 1 + (−1)^d ∏ sinc²/(N − 1)^(d−1): the strata of the axes are on null sets."""
    whole = expanded(made("latin-hypercube", d, 10)[2])
    assert whole.products == ((F((-1) ** d, 9 ** (d - 1)), (10,) * d),)
    assert whole.constant == 1
    assert whole.total == 1 + F((-1) ** d, 9 ** (d - 1))


def test_a_regular_grid_has_none():
    _, _, density = made("regular", 2, 16)
    assert density.terms == ()
    assert density_array(expanded(density), np.array([[1.0, 2.0]])) == [0]


def test_combs_are_left_out():
    """Correlated multi-jitter at a tooth: the density is the limit from beside it."""
    sampler, counts, density = made("correlated-multi-jitter", 2, 16)
    at, beside = density_array(expanded(density), np.array([[4.0, 4.0], [4 + 1e-9, 4 - 1e-9]]))
    assert at == pytest.approx(beside, abs=1e-7)
    assert abs(float(scaled_power(sampler, counts, [4, 4])) - at) > 1


@pytest.mark.parametrize("case", SAMPLERS)
def test_products_and_factors_are_one_density(case):
    """Multiplied out, and factor by factor in rationals, with sinc² replaced by numbers."""
    _, _, density = made(*case)
    whole = expanded(density)
    values = {None: F(1)}
    for _, strata in whole.products:
        values |= {n: F(1, n + 2) for n in strata if n is not None}
    out = whole.constant
    for coefficient, strata in whole.products:
        for n in strata:
            coefficient *= values[n]
        out += coefficient
    direct = F(0)
    for coefficient, factors in density.terms:
        for factor in factors:
            coefficient *= sum(w * values[n] for w, n in factor)
        direct += coefficient
    assert out == direct


def test_size_is_made_of_positive_terms():
    whole = expanded(made("correlated-multi-jitter", 2, 16)[2])
    nu = np.random.default_rng(1).uniform(0, 30, (50, 2))
    assert np.all(density_array(whole.size, nu) >= np.abs(density_array(whole, nu)) - 1e-15)


@given(st.floats(1e-150, 1e6))
def test_one_minus_sinc_squared_keeps_its_digits(x):
    with mp.workdps(350):
        exact = 1 - mp.sincpi(mp.mpf(x)) ** 2
        assert abs(mp.mpf(float(sinc2_deficit(np.array([x]))[0])) / exact - 1) < 3e-15


def test_a_free_profile_has_no_density():
    with pytest.raises(InputError, match="with a spectrum: got isotropic"):
        density_of(parse_sampler("isotropic:2", 2), {"N": 4})
