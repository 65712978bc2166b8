"""Spectra of known degree, effective exponent, plateau and cut-off, to test fitted intervals on.

Beside samplers of the catalogue, with x = m/n, n = N^(1/d) and sinc x = sin(πx)/(πx):

- projection determinantal process on a box of n^d frequencies (in 1D the eigenvalues of a random
  unitary matrix): N·P_S = 1 − ∏ (1 − |x_i|)^+, degree 1;
- cloaked lattice, jitter with a stable displacement of exponent β and scale c/n added:
  N·P_S = 1 − sinc²(x) exp(−2 (2πc|x|)^β), degree min(β, 2) (Klatt, Kim & Torquato 2020);
- difference jitter s_j = (j + u_j − u_{j−1})/N, u uniform of width 1: with φ = sinc,
  N·P_S = 1 − φ⁴ + 2 cos(2πx) φ³ cos(πx) − 2 cos(2πx) φ⁴, degree 4. Of its power series in πx the
  terms below x⁴ cancel exactly, so that the series stands in where doubles would lose them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import factorial, pi, sqrt

import numpy as np

from ...theory.samplers import parse_sampler
from ..expected_spectra.spectra import power_array
from ..generators import generate
from ..integrands.protocol import Floats, Ints
from ..point_sources.catalogue_source import counts_of

_TERMS = 40  # of the power series of difference jitter, enough up to πx = 1
_BEYOND = 4  # frequencies reach this many times N^e


@dataclass(frozen=True)
class Truth:
    """A spectrum on one region, and its profile.

    Parameters
    ----------
    name : str
    spectrum : callable
        N·P_S for N and frequencies (k, d).
    frequencies : callable
        A list (k, d) that serves at N, for a number of frequencies per coordinate.
    degree : float
    effective : float or None
        None where the degree is 0.
    gamma : float
    alpha : float or None
        None where the degree is 0; on several coordinates that along the diagonals.
    points : callable or None
        Realisations (R, N, d) for N, R and a generator.
    """

    name: str
    spectrum: Callable[[int, Ints], Floats]
    frequencies: Callable[[int, int], Ints]
    degree: float
    effective: float | None
    gamma: float = 1.0
    alpha: float | None = None
    points: Callable[[int, int, np.random.Generator], Floats] | None = None


def along(n: int, count: int) -> Ints:
    """Frequencies from 1 to 4N, even in log m."""
    return _even(n, count)[:, None]


def along_first(n: int, count: int) -> Ints:
    """The same on the first of two axes."""
    return np.pad(along(n, count), ((0, 0), (0, 1)))


def along_grid(n: int, count: int) -> Ints:
    """Frequencies on the first of two axes, up to 4 N^(1/2)."""
    return along_first(round(sqrt(n)), count)


def generic(n: int, count: int) -> Ints:
    """Frequencies with both coordinates nonzero, up to 4 N^(1/2), even in log |m_i|."""
    k = _even(round(sqrt(n)), count)
    a, b = np.meshgrid(k, np.concatenate([k, -k]), indexing="ij")
    return np.stack([a.ravel(), b.ravel()], axis=1)


def _even(n: int, count: int) -> Ints:
    return np.unique(np.round(np.geomspace(1, _BEYOND * n, count)).astype(np.int64))


def catalogue(
    name: str,
    dim: int,
    frequencies: Callable[[int, int], Ints],
    degree: float,
    effective: float | None,
    alpha: float | None = None,
) -> Truth:
    """A sampler of the catalogue on the region of the frequencies."""
    sampler = parse_sampler(name, dim)

    def spectrum(n: int, m: Ints) -> Floats:
        return n * power_array(sampler, counts_of(sampler, n), m)

    def points(n: int, replicates: int, rng: np.random.Generator) -> Floats:
        return generate(sampler, counts_of(sampler, n), replicates, rng)

    region = "" if frequencies is along else ", generic" if frequencies is generic else ", axis"
    title = f"{name} {dim}D{region}"
    return Truth(title, spectrum, frequencies, degree, effective, 1.0, alpha, points)


def box_process(n: int, m: Ints) -> Floats:
    """N·P_S of the projection determinantal process on a box."""
    rest: Floats = np.maximum(1 - np.abs(m) / float(n ** (1 / m.shape[1])), 1e-300)
    return -np.expm1(np.log(rest).sum(axis=1))


def cloaked_lattice(beta: float, scale: float) -> Truth:
    """Cloaked lattice of stable exponent β <= 3/2 and scale c."""

    def spectrum(n: int, m: Ints) -> Floats:
        x = np.abs(m[:, 0]) / n
        squared = np.maximum(1 - _deficit(x), 1e-300)
        return -np.expm1(np.log(squared) - 2 * (2 * pi * scale * x) ** beta)

    def points(n: int, replicates: int, rng: np.random.Generator) -> Floats:
        cells = np.arange(n) + rng.random((replicates, n))
        moved = (cells + scale * _stable(beta, (replicates, n), rng)) / n % 1.0
        return moved[:, :, None]

    amplitude = 2 * (2 * pi * scale) ** beta
    name = f"cloaked lattice, β = {beta:g}, c = {scale:g}"
    return Truth(name, spectrum, along, beta, 1.0, 1.0, amplitude ** (-1 / beta), points)


def _deficit(x: Floats) -> Floats:
    """1 − sinc² x, to full relative precision."""
    y = pi * x
    small = y**2 / 6 - y**4 / 120 + y**6 / factorial(7) - y**8 / factorial(9)
    s = np.where(x < 0.02, small, 1 - np.sinc(x))
    return s * (2 - s)


def _stable(beta: float, shape: tuple[int, int], rng: np.random.Generator) -> Floats:
    """Symmetric stable numbers, E exp(itX) = exp(−|t|^β) (Chambers, Mallows & Stuck 1976)."""
    u, w = pi * (rng.random(shape) - 0.5), rng.exponential(size=shape)
    tilted = (np.cos(u * (1 - beta)) / w) ** ((1 - beta) / beta)
    return np.sin(beta * u) / np.cos(u) ** (1 / beta) * tilted


def difference_jitter(n: int, m: Ints) -> Floats:
    """N·P_S of difference jitter."""
    x = np.abs(m[:, 0]) / n
    y, s = pi * x, np.sinc(x)
    plain = 1 - s**4 + 2 * np.cos(2 * y) * (s**3 * np.cos(y) - s**4)
    series = np.polynomial.polynomial.polyval(np.minimum(y, 1.0), _series())
    return np.where(y < 1, series, plain)


def difference_jitter_points(n: int, replicates: int, rng: np.random.Generator) -> Floats:
    """Realisations of difference jitter."""
    u = rng.random((replicates, n))
    return ((np.arange(n) + u - np.roll(u, 1, axis=1)) / n % 1.0)[:, :, None]


@lru_cache(maxsize=1)
def _series() -> tuple[float, ...]:
    """Coefficients of difference jitter's N·P_S in powers of πx, from exact rationals."""

    def even(term: Callable[[int], Fraction]) -> list[Fraction]:
        return [term(k) if k % 2 == 0 else Fraction(0) for k in range(_TERMS)]

    def times(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
        return [sum((a[i] * b[k - i] for i in range(k + 1)), Fraction(0)) for k in range(_TERMS)]

    sign = [(-1) ** (k // 2) for k in range(_TERMS)]
    s = even(lambda k: Fraction(sign[k], factorial(k + 1)))
    c = even(lambda k: Fraction(sign[k], factorial(k)))
    c2 = even(lambda k: Fraction(sign[k] * 2**k, factorial(k)))
    s3 = times(s, times(s, s))
    s4 = times(s3, s)
    gap = times(c2, [a - b for a, b in zip(times(s3, c), s4, strict=True)])
    total = [2 * g - f for g, f in zip(gap, s4, strict=True)]
    total[0] += 1
    return tuple(float(t) for t in total)


_JITTER_ALPHA = sqrt(3) / pi
_DIFFERENCE_ALPHA = (23 * pi**4 / 15) ** -0.25  # 16π⁴(1/12 + 1/80) = 23π⁴/15

TRUTHS = (
    catalogue("jitter", 1, along, 2, 1.0, _JITTER_ALPHA),
    catalogue("jitter", 2, along_grid, 2, 0.5, _JITTER_ALPHA),
    catalogue("jitter", 2, generic, 2, 0.5, _JITTER_ALPHA),
    Truth("box process 1D", box_process, along, 1, 1.0, 1.0, 1.0),
    Truth("box process 2D, generic", box_process, generic, 1, 0.5, 1.0, sqrt(0.5)),
    cloaked_lattice(0.5, 0.25),
    cloaked_lattice(1.5, 0.2),
    Truth(
        "difference jitter 1D",
        difference_jitter,
        along,
        4,
        1.0,
        1.0,
        _DIFFERENCE_ALPHA,
        difference_jitter_points,
    ),
    catalogue("random", 1, along, 0, None),
    catalogue("latin-hypercube", 2, along_first, 2, 1.0, _JITTER_ALPHA),
    catalogue("latin-hypercube", 2, generic, 0, None),
)
"""What `fit_coverage` fits."""
