"""Pictures of the spectrum that a check measured: planes of two coordinates, radii along regions.

They are drawn from the realisations that were kept, and take none of the check's realisations or
random numbers. A plane is shown at the largest N that was not dropped and has two realisations or
more, on |m_i| <= 3 N^(1/2), where stratified points on a pair have reached their plateau.
"""

from math import ceil, sqrt

import numpy as np

from ...theory.samplers import Sampler
from ..expected_spectra.spectra import power_array
from ..fitting.profile_fits import EstimatedSpectrum
from ..integrands.protocol import Floats, Ints
from ..measuring.measurements import Measurement, kept_points
from ..measuring.moments import special
from ..measuring.periodograms import Box, average_periodogram
from ..measuring.spectrum_pictures import (
    FittedMonomial,
    PlaneSpectrum,
    RegionProfile,
    RegionSpectrum,
    SpectrumPictures,
)
from .fitted_profiles import FittedRegion
from .judgements import State

_LEVEL = 0.05
_LEAST_HALF_WIDTH, _LARGEST_HALF_WIDTH = 8, 96
_POINTS = 1 << 20  # of all realisations on a plane
_PLANES = 3  # pairs of coordinates shown in more than two dimensions


def pictures_of(state: State) -> SpectrumPictures:
    """What is shown of the spectrum beside the document; nothing of a frozen or faulty sampler."""
    claimed = state.design.claimed_samplers[0] if state.design.claimed_samplers else None
    shown = [
        m
        for m in state.measurements
        if m.replicates > 1 and not m.is_frozen and m.kept and m.dropped is None
    ]
    pairs, left_out = _pairs(state)
    planes = [_plane(shown[-1], pair, claimed) for pair in pairs] if shown else []
    profiles = [_profile(region, claimed) for region in state.fitted]
    return SpectrumPictures(tuple(planes), tuple(profiles), left_out)


def _pairs(state: State) -> tuple[list[tuple[int, int]], tuple[tuple[str, str], ...]]:
    """The pairs of coordinates whose planes are shown; in four dimensions and more the outer."""
    d = state.design.dim
    every = [(i, j) for i in range(1, d + 1) for j in range(i + 1, d + 1)]
    if len(every) <= _PLANES:
        return every, ()
    chosen = [every[0], (1, d), every[-1]]
    names = ", ".join(f"{i},{j}" for i, j in chosen)
    why = f"{len(every) - _PLANES} more pairs of coordinates have one; shown are those of {names}"
    return chosen, (("other planes of frequencies", why),)


def _plane(m: Measurement, pair: tuple[int, int], claimed: Sampler | None) -> PlaneSpectrum:
    """P_S on the plane of a pair, measured and claimed."""
    axes = [i - 1 for i in pair]
    half = min(max(ceil(3 * sqrt(m.n)), _LEAST_HALF_WIDTH), _LARGEST_HALF_WIDTH)
    points = kept_points(m)[: max(2, _POINTS // m.n), :, axes]
    measured = average_periodogram([points], Box((half, half)), _LEVEL)
    flat = measured.frequencies().reshape(-1, 2)
    placed = np.zeros((len(flat), int(kept_points(m).shape[2])), dtype=np.int64)
    placed[:, axes] = flat
    exact = None if claimed is None else _exact(claimed, m.n, placed)
    return PlaneSpectrum(
        pair, measured, None if exact is None else exact.reshape(measured.mean.shape)
    )


def _exact(claimed: Sampler, n: int, m: Ints) -> Floats | None:
    """P_S of the claimed sampler at frequencies (k, d), 1 at m = 0; None if it has no such N."""
    counts = claimed.counts_at(n) if claimed.counts_at else None
    if counts is None or counts["N"] != n:
        return None
    found = np.ones(len(m))
    waves = m.any(axis=1)
    found[waves] = power_array(claimed, counts, m[waves])
    return found


def _profile(region: FittedRegion, claimed: Sampler | None) -> RegionProfile:
    """The spectrum along a region at every N that was fitted, and the fit."""
    fit = region.fit
    monomial = FittedMonomial(fit.degree, fit.effective, fit.gamma, fit.alpha)
    is_fitted = fit.outside_model is None
    return RegionProfile(
        ",".join(map(str, region.support)),
        tuple(_spectrum(s, claimed) for s in region.spectra),
        (monomial,) if is_fitted else (),
        fit.outside_model,
        fit.reason if is_fitted else None,
    )


def _spectrum(found: EstimatedSpectrum, claimed: Sampler | None) -> RegionSpectrum:
    """N·P_S by increasing |m|, with intervals of the gamma law as of `averaged` periodograms."""
    radius: Floats = np.sqrt((found.frequencies.astype(float) ** 2).sum(axis=1))
    order = np.argsort(radius, kind="stable")
    dispersion = np.ones_like(radius) if found.dispersion is None else found.dispersion
    shape = found.realisations / (1 + 2 * np.maximum(dispersion - 1, 0))
    low = found.power * shape / special().gammainccinv(shape, _LEVEL / 2)
    high = found.power * shape / special().gammaincinv(shape, _LEVEL / 2)
    exact = None if claimed is None else _exact(claimed, found.n, found.frequencies)
    return RegionSpectrum(
        found.n,
        found.realisations,
        radius[order],
        found.power[order],
        low[order],
        high[order],
        _LEVEL,
        None if exact is None else found.n * exact[order],
    )
