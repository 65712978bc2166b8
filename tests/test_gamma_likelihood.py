"""Gamma likelihood: deviance, penalised fits, profile bounds, and the bound of the deviance."""

from math import log, sqrt

import numpy as np
import pytest
from scipy import optimize, special, stats
from specrate.numerics.fitting.gamma_likelihood import (
    Averages,
    Curve,
    averages,
    deviance,
    fit,
    largest_deviance,
    profile_bound,
    promised,
)


def line(x, precision=0.0, centre=0.0):
    """log μ = p_0 + p_1 x, with a normal prior of p_1."""

    def model(at):
        jacobian = np.stack([np.ones_like(x), x], axis=1)
        miss = at[1] - centre
        return Curve(
            at[0] + at[1] * x,
            jacobian,
            precision * miss**2,
            np.array([0.0, -precision * miss]),
            np.diag([0.0, precision]),
        )

    return model


def drawn(x, shape, level, slope, seed=0):
    rng = np.random.default_rng(seed)
    shapes = np.full(x.size, float(shape))
    return averages(np.exp(level + slope * x) * rng.gamma(shape, 1 / shape, x.size), shapes, 0.0)


FREE = (np.full(2, -np.inf), np.full(2, np.inf))
X = np.linspace(-1, 2, 30)


def test_the_deviance_is_twice_the_gap_of_the_log_likelihood():
    data = drawn(X, 3, 0.5, 1.0)
    mean = np.exp(0.3 - 0.4 * X)

    def log_likelihood(mu):
        return stats.gamma.logpdf(data.power, data.shape, scale=mu / data.shape)

    expected = 2 * (log_likelihood(data.power) - log_likelihood(mean))
    assert deviance(data, np.log(mean)) == pytest.approx(expected, rel=1e-10)
    assert deviance(data, data.log_power) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("ratio", [1e-300, 1e-30, 1e30, 1e250])
def test_a_deviance_is_finite_however_far_off(ratio):
    data = averages(np.array([ratio]), np.array([2.0]), 1e-320)
    assert 0 < deviance(data, np.zeros(1))[0] < np.inf


def test_a_constant_fits_the_weighted_mean():
    data = Averages(np.array([1.0, 2.0, 6.0]), np.array([1.0, 5.0, 2.0]), np.log([1.0, 2.0, 6.0]))

    def model(at):
        return Curve(np.full(3, at[0]), np.ones((3, 1)), 0.0, np.zeros(1), np.zeros((1, 1)))

    limits = (np.array([-np.inf]), np.array([np.inf]))
    best = fit(model, data, np.array([-3.0]), limits, tolerance=1e-12)
    assert best.parameters[0] == pytest.approx(log(23 / 8), abs=1e-6)
    assert best.information[0, 0] == 8


@pytest.mark.parametrize("precision", [0.0, 3.0])
@pytest.mark.parametrize("shape", [0.5, 1, 20])
def test_a_fit_ends_where_a_general_minimiser_does(shape, precision):
    data, model = drawn(X, shape, 0.5, 1.0), line(X, precision, 0.2)

    def cost(at):
        curve = model(at)
        return float(deviance(data, curve.log_mean).sum()) + curve.penalty

    best = fit(model, data, np.array([4.0, -3.0]), FREE, tolerance=1e-10)
    found = optimize.minimize(cost, [0.0, 0.0], method="Nelder-Mead", options={"fatol": 1e-10})
    assert best.cost == pytest.approx(cost(best.parameters), rel=1e-12)
    assert best.cost == pytest.approx(found.fun, abs=1e-6)
    assert best.parameters == pytest.approx(found.x, abs=1e-3)


def test_fixed_parameters_stay_and_limits_hold():
    data, model = drawn(X, 20, 0.5, 1.0), line(X)
    held = fit(model, data, np.array([0.0, -2.0]), FREE, fixed=(1,))
    assert held.parameters[1] == -2
    limits = (np.array([-np.inf, -np.inf]), np.array([np.inf, 0.25]))
    assert fit(model, data, np.zeros(2), limits).parameters[1] == 0.25


@pytest.mark.parametrize("side", [-1, 1])
def test_a_profile_bound_is_where_the_least_cost_has_risen(side):
    data, model, rise = drawn(X, 4, 0.5, 1.0), line(X), 4.0
    best = fit(model, data, np.zeros(2), FREE, tolerance=1e-10)
    found = profile_bound(model, data, best, 1, side, rise, FREE)
    assert found is not None
    assert (found - best.parameters[1]) * side > 0
    held = fit(model, data, np.array([0.0, found]), FREE, fixed=(1,), tolerance=1e-10)
    assert sqrt(held.cost - best.cost) == pytest.approx(sqrt(rise), rel=0.05)


def test_there_is_no_bound_beyond_a_limit():
    data, model = drawn(X, 4, 0.5, 1.0), line(X)
    best = fit(model, data, np.zeros(2), FREE)
    limits = (np.array([-np.inf, best.parameters[1] - 0.01]), np.full(2, np.inf))
    assert profile_bound(model, data, best, 1, -1, 4.0, limits) is None


def test_a_second_valley_is_found_from_elsewhere():
    """A parameter that enters as its square: |p| near 1 on both sides of 0."""
    data = averages(np.full(10, np.e), np.full(10, 50.0), 0.0)

    def model(at):
        jacobian = np.full((10, 1), 2 * at[0])
        return Curve(np.full(10, at[0] ** 2), jacobian, 0.0, np.zeros(1), np.eye(1) * 1e-9)

    limits = (np.array([-5.0]), np.array([5.0]))
    for start in (-0.5, 0.5):
        best = fit(model, data, np.array([start]), limits)
        assert best.parameters[0] == pytest.approx(np.sign(start), abs=1e-3)


def test_what_a_step_promises_is_what_it_brings():
    data, model = drawn(X, 400, 0.5, 1.0), line(X)
    best = fit(model, data, np.zeros(2), FREE, tolerance=1e-12)
    near = best.parameters + np.array([0.01, 0.02])
    rise = float(deviance(data, model(near).log_mean).sum()) - best.cost
    assert promised(model, data, near) == pytest.approx(rise, rel=0.05)


@pytest.mark.parametrize("shape", [1.0, 3.0, 200.0])
def test_the_deviance_seldom_exceeds_its_bound(shape):
    """At level 1e-3, of 4000 samples of 50 values: 4 expected at most.

    False alarms: 30 or more of at most 4 expected have probability 2e-16. Power: a threshold at
    the χ² quantile, which is too low for R = 1, is exceeded by far more.
    """
    rng = np.random.default_rng(7)
    values = rng.gamma(shape, 1 / shape, (4000, 50))
    total = (2 * shape * (values - 1 - np.log(values))).sum(axis=1)
    assert (total > largest_deviance(np.full(50, shape), 1e-3)).sum() < 30
    assert special.bdtrc(29, 4000, 1e-3) < 1e-8
    if shape == 1:
        assert (total > stats.chi2.isf(1e-3, 50)).sum() >= 30


@pytest.mark.parametrize("shape", [1.0, 3.0, 200.0])
def test_the_bound_of_the_deviance_is_not_far_above_its_quantile(shape):
    rng = np.random.default_rng(8)
    values = rng.gamma(shape, 1 / shape, (4000, 50))
    total = (2 * shape * (values - 1 - np.log(values))).sum(axis=1)
    assert largest_deviance(np.full(50, shape), 1e-2) < 1.2 * np.quantile(total, 0.99)


def test_the_bound_adds_over_mixed_shapes():
    mixed = np.array([1.0] * 10 + [8.0] * 20)
    least = largest_deviance(np.full(30, 8.0), 1e-6)
    assert least < largest_deviance(mixed, 1e-6) < largest_deviance(np.ones(30), 1e-6)
