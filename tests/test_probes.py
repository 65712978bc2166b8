"""Probes: every support that theory tells apart is probed, where its strata would show."""

from itertools import product
from math import gcd

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.measuring.probes import (
    amplitudes,
    frequencies,
    integrand_supports,
    probe,
    probed_supports,
    strata_of_claim,
    support_of_frequency,
)
from specrate.numerics.streams import stream
from specrate.theory.samplers import parse_sampler


@pytest.mark.parametrize(
    ("dim", "pairs", "triples", "full"),
    [
        (1, 0, 0, 0),
        (2, 1, 0, 0),
        (3, 3, 1, 0),
        (4, 6, 4, 1),
        (10, 45, 120, 1),
        (11, 55, 9, 1),
        (40, 780, 38, 1),
        (41, 40, 39, 1),
    ],
)
def test_supports(dim, pairs, triples, full):
    supports = probed_supports(dim)
    sizes = [len(s) for s in supports]
    assert len(set(supports)) == len(supports)
    assert sizes.count(1) == dim
    assert sizes.count(2) == pairs
    assert sizes.count(3) == triples
    assert len(supports) - dim - pairs - triples == full
    assert supports[-1] == tuple(range(1, dim + 1))
    assert set(integrand_supports(dim)) <= set(supports)
    assert len(integrand_supports(dim)) <= 7


@pytest.mark.parametrize("dim", [1, 2, 3, 5, 10])
@pytest.mark.parametrize("n", [2, 16, 243, 4096])
def test_frequencies_lie_on_the_probed_supports(dim, n):
    wanted = frequencies(n, dim)
    assert len(set(wanted)) == len(wanted)
    assert {support_of_frequency(m) for m in wanted} == set(probed_supports(dim))
    assert all(len(m) == dim for m in wanted)


def test_strata_and_their_neighbours_are_probed():
    wanted = set(frequencies(16, 2, strata=(2, 8)))
    for count in (2, 4, 8, 16):
        for k in (1, count // 2, count, count + 1):
            assert {(k, 0), (0, k)} <= wanted
    assert {(1, 1), (1, -1), (4, 4), (8, 8), (4, 1)} <= wanted


@pytest.mark.parametrize(("dim", "size", "most"), [(2, 2, 3), (3, 2, 3), (3, 3, 2), (5, 3, 1)])
def test_oblique_low_frequencies_are_probed_with_all_signs(dim, size, most):
    half = set(frequencies(64, dim))
    wanted = half | {tuple(-k for k in m) for m in half}
    for support in (s for s in probed_supports(dim) if len(s) == size):
        values = product([k for k in range(-most, most + 1) if k], repeat=size)
        for v in (v for v in values if gcd(*v) == 1):
            entries = dict(zip(support, v, strict=True))
            assert tuple(entries.get(i, 0) for i in range(1, dim + 1)) in wanted


def test_a_sampler_wrong_on_a_triple_alone_is_seen():
    """White noise on the axes and the pairs, and N P_S(1, -1, 1) = 0 in d = 4.

    A mean of 64 exponential variables is below 1/4 with probability 1e-17, and that of the triple
    is 0 in every realisation: power 1.
    """
    n, rng = 16, stream(63)
    points = rng.random((64, n, 4))
    points[:, :, 2] = (np.arange(n) / n - points[:, :, 0] + points[:, :, 1]) % 1.0
    wanted = frequencies(n, 4)
    power = n * np.mean(np.abs(amplitudes(points, wanted)) ** 2, axis=1)
    low = {m for m, p in zip(wanted, power, strict=True) if p < 0.25}
    assert low == {(1, -1, 1, 0)}


def test_strata_of_claims():
    def strata(name, dim, n):
        return strata_of_claim(parse_sampler(name, dim), n)

    assert strata("random", 2, 16) == (16,)
    assert strata("jitter", 2, 16) == (4, 16)
    assert strata("jitter:2x8", 2, 16) == (2, 8, 16)
    assert strata("uncorrelated-jitter:1+2", 3, 25) == (5, 25)


def test_a_probe_has_its_power_on_its_support():
    f = probe(3, 2, (1, 3))
    m = np.array(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij")).reshape(3, -1).T
    power = f.coefficient_power(m)
    np.testing.assert_array_equal(power > 0, (m[:, 0] != 0) & (m[:, 1] == 0) & (m[:, 2] != 0))


@pytest.mark.parametrize("shape", [(3, 5, 2), (1, 1, 1), (70, 4099, 2), (2, 300_001, 1)])
def test_amplitudes_are_the_sums_they_stand_for(shape):
    """Also where the realisations are taken in parts: 70 x 4099 points are more than one."""
    points = stream(61).random(shape)
    wanted = [(1,) * shape[2], (-3,) + (0,) * (shape[2] - 1), (0,) * shape[2]]
    direct = [np.exp(-2j * np.pi * (points @ np.array(m))).mean(axis=1) for m in wanted]
    np.testing.assert_allclose(amplitudes(points, wanted), direct, rtol=0, atol=1e-13)


@given(
    dim=st.integers(1, 4),
    entries=st.lists(st.lists(st.integers(-9, 9), min_size=4, max_size=4), min_size=1, max_size=12),
)
def test_amplitudes_do_not_depend_on_their_company(dim, entries):
    """Frequencies share waves and products; alone each is the sum that defines it."""
    points = stream(64, dim).random((3, 7, dim))
    wanted = [tuple(m[:dim]) for m in entries]
    direct = [np.exp(-2j * np.pi * (points @ np.array(m))).mean(axis=1) for m in wanted]
    np.testing.assert_allclose(amplitudes(points, wanted), direct, rtol=0, atol=1e-13)


@pytest.mark.parametrize("k", [1, 255, 4096, 1_000_003])
def test_waves_of_high_frequencies_lose_no_more_than_their_angle(k):
    """The angle of x in double precision is uncertain by 2 pi k 2^-54; points are whole 2^-53."""
    grid = stream(65).integers(0, 1 << 53, 500)
    turns = np.array([int(x) * k % (1 << 53) for x in grid]) / 2.0**53
    found = amplitudes((grid / 2.0**53).reshape(-1, 1, 1), [(k,)])[0]
    assert np.max(np.abs(found - np.exp(-2j * np.pi * turns))) < 8 * k * 2.0**-53 + 1e-15


def test_white_noise_is_flat():
    """N P_S = 1 within 6 standard errors of 4000 exponential variables: false alarm 4e-9 each."""
    points = stream(62).random((4000, 16, 2))
    wanted = frequencies(16, 2)
    power = 16 * np.mean(np.abs(amplitudes(points, wanted)) ** 2, axis=1)
    assert np.max(np.abs(power - 1)) < 6 / np.sqrt(4000)
