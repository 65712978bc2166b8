"""Estimated spectra of one region: averaged periodograms at several N, made ready for a fit.

F_N(m) and F_N(−m) are conjugate, so that one of each pair is kept. Where frequencies have several
nonzero coordinates, the amplitude depends on the direction, and near the axes it may do so in ways
that no smooth function follows (|m_1| + |m_2|): the fit takes the *cone* of frequencies whose
coordinates are within a factor of four of each other, whatever their power, and allows in it for
an amplitude that is smooth in log |m_i|.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...theory.errors import InputError
from ..integrands.protocol import Floats, Ints

CONE = 4.0
"""Largest ratio of two nonzero coordinates in the cone."""

_LARGEST = 1e100  # power; far beyond N, and far from overflow
_FEWEST = 3  # frequencies in the cone; with fewer all are taken
_MOST = 400  # frequencies per N
_SHELLS = 40  # in which a longer list of frequencies is thinned out evenly
_UNIT = 0.7  # of log |m_i|: half the width of the cone
_TAILS = 5.0  # times the excess of the dispersion
_SUPPORTS = 12  # more of them share their amplitudes


@dataclass(frozen=True, eq=False)
class EstimatedSpectrum:
    """N·P_S estimated at one N.

    Parameters
    ----------
    n : int
        N, at least 2.
    realisations : int
        R, of independent realisations that the periodograms are averaged over.
    frequencies : array (k, d) of int
        All with the same number of nonzero coordinates, which is not 0.
    power : array (k,)
        Mean of N|F_N(m)|² over the realisations.
    dispersion : array (k,), optional
        Variance of |F_N(m)|² between realisations over the square of its mean: 1 by the gamma law,
        more where few points decide (heavy tails), and then R counts for less. NaN where unknown.
    """

    n: int
    realisations: int
    frequencies: Ints
    power: Floats
    dispersion: Floats | None = None

    def __post_init__(self) -> None:
        if self.n < 2:
            raise InputError(f"an estimated spectrum must satisfy 2 <= N: got {self.n}")
        if self.realisations < 1:
            raise InputError(f"a spectrum needs 1 <= realisations: got {self.realisations}")
        m, power = self.frequencies, self.power
        if m.ndim != 2 or power.shape != m.shape[:1] or m.dtype.kind != "i":
            raise InputError(
                "a spectrum needs integer frequencies (k, d) and powers (k,): "
                f"got {m.dtype} {m.shape} and {power.shape}"
            )
        d = self.dispersion
        if d is not None and (d.shape != power.shape or ((d < 0) | np.isinf(d)).any()):
            raise InputError("dispersions must satisfy 0 <= dispersion (k,): got some that do not")
        wrong = power[~((power >= 0) & (power <= _LARGEST))]
        if wrong.size:
            raise InputError(f"powers must satisfy 0 <= N|F|² <= {_LARGEST:g}: got {wrong[0]}")
        if not m.any(axis=1).all():
            raise InputError("frequencies must satisfy m != 0: got m = 0")


@dataclass(frozen=True)
class Sample:
    """Values of one region at several N, side by side; k values in all.

    Parameters
    ----------
    frequencies : array (k, d)
    power : array (k,)
        Y, the averaged N|F_N(m)|².
    shape : array (k,)
        R, or fewer where the values scatter more than by the gamma law.
    log_radius, log_n : array (k,)
        log |m| and log N.
    weight : int
        Number w of nonzero coordinates.
    directions : array (k, q)
        Smooth functions of the direction, zero on the diagonal or in the mean.
    """

    frequencies: Ints
    power: Floats
    shape: Floats
    log_radius: Floats
    log_n: Floats
    weight: int
    directions: Floats

    def taken(self, rows: Ints) -> "Sample":
        """The values in these rows."""
        return Sample(
            self.frequencies[rows],
            self.power[rows],
            self.shape[rows],
            self.log_radius[rows],
            self.log_n[rows],
            self.weight,
            self.directions[rows],
        )


def sample_of(spectra: Sequence[EstimatedSpectrum]) -> Sample:
    """All values, one of each pair ±m and at most 400 per N.

    Raises
    ------
    InputError
        If there are none, or frequencies differ in their number of (nonzero) coordinates.
    """
    if not sum(len(s.power) for s in spectra):
        raise InputError("a fit needs at least one frequency: got none")
    dims = {s.frequencies.shape[1] for s in spectra}
    if len(dims) != 1:
        raise InputError(f"spectra must have one dimension: got {sorted(dims)}")
    kept = [(s, _thinned(s.frequencies, _halved(s.frequencies))) for s in spectra]
    m = np.concatenate([s.frequencies[rows] for s, rows in kept])
    weights = np.unique(np.count_nonzero(m, axis=1))
    if weights.size != 1:
        raise InputError(f"a region has one number of nonzero coordinates: got {weights.tolist()}")
    sizes = [len(rows) for _, rows in kept]
    return Sample(
        m,
        np.concatenate([s.power[rows] for s, rows in kept]),
        np.concatenate([_degrees(s)[rows] for s, rows in kept]),
        np.log((m.astype(float) ** 2).sum(axis=1)) / 2,
        np.repeat(np.log([float(s.n) for s in spectra]), sizes),
        int(weights[0]),
        _directions(m, int(weights[0])),
    )


def cone(sample: Sample) -> Sample:
    """The values in the cone, or all if it holds hardly any."""
    rows = np.flatnonzero(excess(sample) == 0)
    return sample.taken(rows) if rows.size >= _FEWEST else sample


def rounding(sample: Sample) -> Floats:
    """N|F_N(m)|² that may be a rounding error of zero: N (ε (1 + 2π|m|))².

    Points are rounded to ε, phases thus to 2π|m|ε, and the errors of N waves may add up.
    """
    phases = 2 * np.pi * np.exp(sample.log_radius)
    return np.exp(sample.log_n) * (np.finfo(float).eps * (1 + phases)) ** 2


def excess(sample: Sample) -> Floats:
    """Logarithm of the ratio of the largest to the smallest coordinate, beyond that of the cone."""
    size = np.abs(sample.frequencies).astype(float)
    least = np.where(size > 0, size, np.inf).min(axis=1)
    return np.log(np.maximum(size.max(axis=1) / least / CONE, 1.0))


def _degrees(spectrum: EstimatedSpectrum) -> Floats:
    """R/(1 + 5 (D − 1)^+), D the dispersion averaged over neighbours in |m|.

    Five times, because samples of few realisations understate the excess of heavy tails; a value's
    own dispersion alone would give high values less weight than low ones.
    """
    r = float(spectrum.realisations)
    if spectrum.dispersion is None:
        return np.full(len(spectrum.power), r)
    order = np.argsort((spectrum.frequencies.astype(float) ** 2).sum(axis=1), kind="stable")
    padded = np.pad(spectrum.dispersion[order], 1, mode="edge")
    mean = np.empty(len(order))
    mean[order] = (padded[:-2] + 2 * padded[1:-1] + padded[2:]) / 4
    return r / (1 + _TAILS * np.maximum(np.nan_to_num(mean, nan=1.0) - 1, 0.0))


def _halved(m: Ints) -> Ints:
    """Rows of the first of each ±m."""
    leading = np.take_along_axis(m, (m != 0).argmax(axis=1)[:, None], axis=1)
    return np.sort(np.unique(m * np.sign(leading), axis=0, return_index=True)[1])


def _thinned(m: Ints, rows: Ints) -> Ints:
    """At most 400 of the rows, evenly spread over shells of |m|."""
    if len(rows) <= _MOST:
        return rows
    radius = np.log((m[rows].astype(float) ** 2).sum(axis=1))
    span = max(float(np.ptp(radius)), 1e-9)
    shell = np.minimum((_SHELLS * (radius - radius.min()) / span).astype(np.int64), _SHELLS - 1)
    most, kept = _MOST // _SHELLS, list[Ints]()
    for k in range(_SHELLS):
        inside = rows[shell == k]
        even = np.linspace(0, len(inside) - 1, min(most, len(inside)))
        kept.append(inside[np.round(even).astype(np.int64)])
    return np.concatenate(kept)


def _directions(m: Ints, weight: int) -> Floats:
    """Functions of direction: slopes and curvatures in log |m_i|, quadrants, supports."""
    nonzero = m != 0
    columns = list[Floats]()
    if weight > 1:
        size = np.log(np.where(nonzero, np.abs(m), 1).astype(float))
        v = np.where(nonzero, size - size.sum(axis=1, keepdims=True) / weight, 0.0) / _UNIT
        used = np.flatnonzero(nonzero.any(axis=0))
        columns += [v[:, i] for i in used[:-1]]
        columns += [(v**2).sum(axis=1) / weight, (v**4).sum(axis=1) / weight / 2]
        signs = np.sign(m[:, used]).astype(float)
        if len(used) <= 4:
            columns += [signs[:, i] * signs[:, j] for i in range(len(used)) for j in range(i)]
    supports, which = np.unique(nonzero, axis=0, return_inverse=True)
    if 1 < len(supports) <= _SUPPORTS:
        columns += [(which.reshape(-1) == i).astype(float) for i in range(1, len(supports))]
    return np.stack(columns, axis=1) if columns else np.zeros((len(m), 0))
