"""Probes: every support that theory tells apart is probed, where its strata would show."""

import numpy as np
import pytest
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
    ("dim", "axes", "pairs", "full"),
    [
        (1, 1, 0, 0),
        (2, 2, 1, 0),
        (3, 3, 3, 1),
        (10, 10, 45, 1),
        (11, 11, 10, 1),
        (40, 40, 39, 1),
    ],
)
def test_supports(dim, axes, pairs, full):
    supports = probed_supports(dim)
    sizes = [len(s) for s in supports]
    assert len(set(supports)) == len(supports)
    assert sizes.count(1) == axes
    assert sizes.count(2) == pairs
    assert sizes.count(dim) - (dim == 1) * axes - (dim == 2) * pairs == full
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


def test_white_noise_is_flat():
    """N P_S = 1 within 6 standard errors of 4000 exponential variables: false alarm 4e-9 each."""
    points = stream(62).random((4000, 16, 2))
    wanted = frequencies(16, 2)
    power = 16 * np.mean(np.abs(amplitudes(points, wanted)) ** 2, axis=1)
    assert np.max(np.abs(power - 1)) < 6 / np.sqrt(4000)
