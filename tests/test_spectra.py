"""Exact spectra as numbers: precision where the plain sum cancels, arrays against single values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.expected_spectra.coefficients import element_value
from specrate.numerics.expected_spectra.spectra import (
    counts_by_growth,
    power_array,
    scaled_power,
    support_counts,
)
from specrate.numerics.integrands.protocol import mp
from specrate.theory.kernels import Alphabet
from specrate.theory.samplers import parse_sampler
from strategies import every_sampler, frequencies


@given(every_sampler().filter(lambda s: s.counts_at is not None and s.dim <= 5), st.data())
def test_arrays_are_single_values(sampler, data):
    counts = sampler.counts_at(data.draw(st.integers(2, 3000)))
    rows = data.draw(st.lists(frequencies(int(sampler.dim)), min_size=1, max_size=4))
    found = power_array(sampler, counts, np.array(rows)) * counts["N"]
    expected = [float(scaled_power(sampler, counts, m)) for m in rows]
    assert found == pytest.approx(expected, rel=1e-13, abs=0)


@given(every_sampler().filter(lambda s: s.counts_at is not None and s.dim <= 5), st.data())
def test_spectra_are_even_and_not_negative(sampler, data):
    counts = sampler.counts_at(data.draw(st.integers(2, 3000)))
    m = data.draw(frequencies(int(sampler.dim)))
    value = scaled_power(sampler, counts, m)
    assert value >= -(mp.mpf(10) ** -12)
    assert value <= counts["N"] * (1 + mp.mpf(10) ** -12)
    assert value == scaled_power(sampler, counts, [-k for k in m])


def test_the_mean_is_one():
    sampler = parse_sampler("jitter", 3)
    m = np.zeros((2, 2, 3), dtype=np.int64)
    assert (power_array(sampler, {"N": 8, "n": 2}, m) == 1).all()
    assert power_array(sampler, {"N": 8, "n": 2}, m).shape == (2, 2)


LOW = {
    "jitter": lambda n: mp.pi**2 / 3 * 2 / n,
    "multi-jitter": lambda n: mp.pi**2 / 3 * 2 / n,
    "correlated-multi-jitter": lambda n: (2 * mp.pi**2 / 3 + mp.pi**4 / 9) / n**2,
}


@pytest.mark.parametrize("name", LOW)
@pytest.mark.parametrize("power", [12, 40, 300])
def test_low_frequencies_keep_their_digits(name, power):
    """At m = (1, 1) and N = 10^power, where the plain sum in doubles has none left."""
    sampler = parse_sampler(name, 2)
    side = 10 ** (power // 2)
    counts = {"N": side**2, "n": side, "m": side, "s": side}
    with mp.workdps(30):
        value = scaled_power(sampler, counts, (1, 1))
        again = +value
        assert abs(value / LOW[name](mp.mpf(side) ** 2) - 1) < mp.mpf(10) ** (-power // 2 + 2)
    with mp.workdps(60):
        assert abs(scaled_power(sampler, counts, (1, 1)) / again - 1) < mp.mpf(10) ** -28


def test_a_zero_of_rounding_is_not_taken_for_a_zero():
    """1 − sinc²(1/N) at N = 10^240 is 0 to 65 and to 110 digits alike, yet π²/(3N²)."""
    with mp.workdps(50):
        value = scaled_power(parse_sampler("latin-hypercube", 1), {"N": 10**240}, (1,))
        assert abs(value / (mp.pi**2 / 3 * mp.mpf(10) ** -480) - 1) < mp.mpf(10) ** -45


def test_a_comb_is_exactly_zero_between_its_teeth():
    sampler = parse_sampler("regular", 2)
    counts = {"N": 49, "n": 7}
    assert scaled_power(sampler, counts, (7, 3)) == 0
    assert scaled_power(sampler, counts, (7, 14)) == 49
    assert scaled_power(sampler, counts, (7, 0)) == 49


def test_real_counts_follow_the_growth_laws():
    layout = parse_sampler("jitter:4xN^1/3xN^2/3", 3).layout
    with mp.workdps(50):
        counts = counts_by_growth(layout, mp.mpf(10) ** 31)
        assert abs(counts["n1"] - 4) < mp.mpf(10) ** -48
        assert abs(counts["n1"] * counts["n2"] * counts["n3"] / counts["N"] - 1) < mp.mpf(10) ** -48


def test_whole_and_real_counts_agree():
    sampler = parse_sampler("multi-jitter", 3)
    with mp.workdps(40):
        real = counts_by_growth(sampler.layout, mp.mpf(1000))
        whole = sampler.counts_at(1000)
        first, second = (scaled_power(sampler, c, (3, -1, 2)) for c in (real, whole))
        assert abs(first / second - 1) < mp.mpf(10) ** -35


def test_elements_are_evaluated():
    alphabet = Alphabet(("N", "n"))
    n_points, n = alphabet.count("N"), alphabet.count("n")
    pi2 = n.field.gens[0]
    element = (pi2 * n_points - n**2) / (3 * n + 1)
    assert float(element_value(element, {"N": 8, "n": 2})) == pytest.approx((8 * np.pi**2 - 4) / 7)


def test_support_counts_by_group():
    layout = parse_sampler("uncorrelated-jitter:1+2+3", 6).layout
    assert support_counts(layout, (1, 3, 5, 6)) == (1, 1, 2)
    assert support_counts(layout, ()) == (0, 0, 0)
