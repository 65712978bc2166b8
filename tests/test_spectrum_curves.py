"""The curve of a spectrum: limits, derivatives, priors, and what it cannot follow."""

from dataclasses import replace

import numpy as np
import pytest
from specrate.numerics.fitting.estimated_spectra import EstimatedSpectrum, sample_of
from specrate.numerics.fitting.gamma_likelihood import averages
from specrate.numerics.fitting.spectrum_curves import (
    DEGREE,
    EFFECTIVE,
    FEATURES,
    GAMMA,
    KAPPA,
    curve_model,
    frame_of,
    misfit_allowed,
    position,
    with_misfit,
)


def frame(dim=1, sizes=(16, 64, 256)):
    k = np.array([1, 2, 3, 5, 9, 30])
    m = k[:, None] if dim == 1 else np.stack(np.meshgrid(k, k), axis=-1).reshape(-1, 2)
    spectra = [EstimatedSpectrum(n, 4, m, np.ones(len(m))) for n in sizes]
    return replace(frame_of(sample_of(spectra)), gauge=1.5)


def parameters(of, seed=0, features=0.2):
    at = features * np.random.default_rng(seed).standard_normal(of.size)
    at[[KAPPA, EFFECTIVE, DEGREE, GAMMA]] = 0.1, 0.9, 1.7, -0.2
    return at


@pytest.mark.parametrize("dim", [1, 2])
def test_without_features_the_curve_is_a_saturating_power(dim):
    of = frame(dim)
    at = parameters(of, features=0.0)
    x = np.exp(position(of, at))
    expected = np.exp(-0.2) * -np.expm1(-np.exp(0.1) * x**1.7)
    assert np.exp(curve_model(of)(at).log_mean) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("dim", [1, 2])
def test_far_below_the_crossover_features_fade(dim):
    """log μ = const + b log ρ − b e log N as ρ/N^e → 0, but for direction and corrections in N."""
    of = frame(dim)
    low = replace(of, gauge=60.0)
    at = parameters(of)
    at[FEATURES : FEATURES + of.inner.shape[1]] = 0.0
    at[FEATURES + of.inner.shape[1] : FEATURES + of.inner.shape[1] + 2] = 0.0
    at[-3] = 0.0
    flat = curve_model(low)(at).log_mean - 1.7 * position(low, at)
    assert np.ptp(flat) < 1e-9


@pytest.mark.parametrize("dim", [1, 2])
def test_the_jacobian_is_that_of_the_curve(dim):
    """In e only for the terms without direction and N, whose slopes are left out."""
    of = frame(dim)
    at = parameters(of)
    exact = curve_model(of)(at).jacobian
    step = 1e-6
    for k in range(of.size):
        if k == EFFECTIVE:
            continue
        up, down = at.copy(), at.copy()
        up[k] += step
        down[k] -= step
        slope = curve_model(of)(up).log_mean - curve_model(of)(down).log_mean
        assert exact[:, k] == pytest.approx(slope / (2 * step), abs=1e-7)
    plain = at.copy()
    q, inner = of.directions.shape[1], of.inner.shape[1]
    plain[FEATURES + inner :][-3 - 2 * q :] = 0.0
    up, down = plain.copy(), plain.copy()
    up[EFFECTIVE] += step
    down[EFFECTIVE] -= step
    slope = (curve_model(of)(up).log_mean - curve_model(of)(down).log_mean) / (2 * step)
    assert curve_model(of)(plain).jacobian[:, EFFECTIVE] == pytest.approx(slope, abs=1e-7)


@pytest.mark.parametrize("power", [True, False])
@pytest.mark.parametrize(("degree", "effective"), [(1.7, 0.9), (0.05, 0.1), (-0.5, 2.0)])
def test_the_pull_is_half_the_slope_of_the_penalty(power, degree, effective):
    of = frame()
    at = parameters(of)
    at[DEGREE], at[EFFECTIVE] = degree, effective
    model = curve_model(of, power)
    step = 1e-6
    for k in range(of.size):
        up, down = at.copy(), at.copy()
        up[k] += step
        down[k] -= step
        slope = (model(up).penalty - model(down).penalty) / (2 * step)
        assert model(at).pull[k] == pytest.approx(-slope / 2, abs=1e-6)
    stiffness = model(at).stiffness
    assert stiffness == pytest.approx(stiffness.T)
    assert np.linalg.eigvalsh(stiffness).min() > -1e-12


@pytest.mark.parametrize("at", [(-300.0, 0.0, 14.0, 0.0), (300.0, 3.0, -1.0, 0.0)])
def test_the_curve_is_finite_at_its_limits(at):
    of = frame(sizes=(2, 10**6, 10**9))
    start = np.zeros(of.size)
    start[:FEATURES] = at
    curve = curve_model(of)(start)
    assert np.isfinite(curve.log_mean).all()
    assert np.isfinite(curve.jacobian).all()
    assert np.isfinite(curve.penalty)


def test_there_is_one_parameter_per_prior():
    of = frame(2)
    assert of.size == FEATURES + of.deviations.size == curve_model(of)(np.ones(of.size)).pull.size
    assert (of.deviations > 0).all()


def test_the_misfit_allowed_bounds_the_number_of_realisations():
    of = frame(sizes=(64, 10**4))
    misfit = misfit_allowed(of, parameters(of))
    assert (misfit >= 0.003).all()
    assert (misfit < 0.08).all()
    data = averages(np.ones(misfit.size), np.full(misfit.size, 1e12), 0.0)
    assert with_misfit(data, misfit).shape == pytest.approx(misfit**-2, rel=1e-6)
