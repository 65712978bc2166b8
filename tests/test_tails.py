"""Kurtosis of integrands: closed forms, and what follows for what may be trusted."""

from math import pi, sqrt

import pytest
from specrate.numerics.integrands.grammar import CATALOGUE, parse_integrand
from specrate.numerics.measuring.tails import is_resolved, is_seen, kurtosis, resolution
from specrate.numerics.streams import stream


def of(text, dim=2):
    return kurtosis(parse_integrand(text, dim))


@pytest.mark.parametrize("text", [e.name for e in CATALOGUE if e.name != "disk"])
@pytest.mark.parametrize("dim", [1, 2, 3])
def test_against_draws(text, dim):
    """To 10 %: more than 6 standard errors of the ratio for 400 000 draws of these integrands."""
    f = parse_integrand(text, dim)
    error = f(stream(63).random((400_000, dim))) - float(f.mean(17))
    drawn = (error**4).mean() / (error**2).mean() ** 2
    assert kurtosis(f) == pytest.approx(drawn, rel=0.1)


def test_closed_forms():
    assert of("bernoulli:k=1") == pytest.approx(9 / 5, rel=1e-8)
    assert of("bernoulli:k=1,axes=(1,2)") == pytest.approx(81 / 25, rel=1e-8)
    assert of("bernoulli:k=2") == pytest.approx(15 / 7, rel=1e-8)
    assert of("box:side=0.01") == pytest.approx(1e4, rel=1e-3)
    assert of("gaussian:sigma=0.001", 1) == pytest.approx(1 / (0.001 * sqrt(2 * pi)), rel=0.02)


def test_an_all_but_constant_integrand_is_no_spike():
    assert 1 <= of("gaussian:sigma=3") < 4


def test_a_spike_is_seen_by_many_points_only():
    f = parse_integrand("box:side=0.01", 2)
    assert not is_seen(f, 16, 16384)
    assert is_seen(f, 256, 2600)
    assert is_seen(parse_integrand("bernoulli:k=1", 2), 16, 128)


def test_the_narrowest_axis_is_to_be_resolved():
    round_one = parse_integrand("gaussian:sigma=0.01", 2)
    narrow = parse_integrand("anisotropic-gaussian:sigma=(0.01,0.4)", 2)
    assert resolution(narrow) == pytest.approx(resolution(round_one), rel=0.2)
    assert kurtosis(narrow) < 0.1 * kurtosis(round_one)
    assert not is_resolved(narrow, 1024)
    assert is_resolved(narrow, 4096)
    assert all(is_resolved(parse_integrand(t, 2), 16) for t in ("disk", "bernoulli", "product"))
