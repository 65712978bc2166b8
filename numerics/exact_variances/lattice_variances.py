r"""Variance as a sum over a box of frequencies, with a bound of what lies outside.

    Var = Σ_{m≠0} P_S(m) |f^(m)|²,     inside: |m_i| <= H for all i.

Outside, the energy E of f is known in total from Parseval and N·P_S lies in a range that the
kernel shows (``spectrum_ranges``): E/N times the middle of the range is added, and half its width
is the bound. Frequencies on the teeth of a comb, where N·P_S may be as large as N, have ranges of
their own; for a ball the energy there is bounded by the envelope of its spectrum,

    |f^(m)|² <= (R/ρ)^d (2/π)/√(x² - d²/4),  x = 2πRρ > d/2,  ρ = |m| >= max |m_i|,

because √(x² - ν²) (J_ν² + Y_ν²) increases to 2/π for ν > 1/2 (Watson 1944, Sec. 13.74; for ν = 1/2
the bound is plain), summed over the shells max |m_i| = k > H. No formula for the variance of any
sampler enters: this is the slow witness of those that do.

The sum inside is in double precision. Its error is bounded on three assumptions, which tests check
against ball arithmetic: ROUNDING, BESSEL_ROUNDING and POWER_ROUNDING below.
"""

from collections.abc import Mapping
from functools import lru_cache
from math import inf, pi, prod, sqrt

import numpy as np

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from ..balls import Ball, flint
from ..expected_spectra.spectra import power_array
from ..expected_spectra.spectrum_ranges import OutsideRange, outside_ranges
from ..integrands.ball import Ball as BallIntegrand
from ..integrands.chord import Chord
from ..integrands.protocol import Floats, Integrand, Ints

BOX = 2_000_000
"""Frequencies in the box."""

LARGEST_DIM = 3
"""Of the integrand, or of the ball whose chord it is."""

ROUNDING = 1e-12
"""Relative error of P_S in double precision and of a sum in it."""

BESSEL_ROUNDING = 1e-14
"""Error of |f^(m)|² of a ball, in units of (10 + x) times the envelope."""

POWER_ROUNDING = 1e-13
"""Error of Σ |f^(m)|² of other integrands, in units of the sum over all m ≠ 0."""

_SLAB = 1 << 18  # frequencies handled at once
_SHELLS = 2_000_000  # beyond the box, summed one by one


def lattice_variance(
    sampler: Sampler, counts: Mapping[str, int], integrand: Integrand, box: int = BOX
) -> Ball:
    """Variance of the randomly shifted estimator, with as many digits as the box gives.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in the dimension of the integrand.
    counts : mapping of str to int
        Every count of the kernel, N among them.
    integrand : Integrand
    box : int
        Number of frequencies, about: 2H + 1 is its root.

    Returns
    -------
    Ball
        Its radius is the bound.

    Raises
    ------
    InputError
        Beyond LARGEST_DIM.
    """
    dim, largest = int(sampler.dim), LARGEST_DIM - isinstance(integrand, Chord)
    if dim > largest:
        raise InputError(f"a lattice sum must have --dim of at most {largest}: got {dim}")
    half = max(1, (round(box ** (1 / dim)) - 1) // 2)
    inside = energy = largest = 0.0
    for m, powers in _box(integrand, dim, half):
        spectrum = power_array(sampler, counts, m)
        energy += float(powers.sum())
        inside += float((powers * spectrum).sum())
        largest = max(largest, float(spectrum.max()))
    total = float(integrand.total(20))
    error = _energy_error(integrand, half, total)
    slack = error + ROUNDING * total
    left = max(total - energy - slack, 0.0), max(total - energy, 0.0) + slack
    ranges = outside_ranges(sampler, counts, half)
    lower, upper = _outside(integrand, ranges, half, left)
    low, high = inside + lower / counts["N"], inside + upper / counts["N"]
    rounding = ROUNDING * high + error * largest
    return flint.arb(low - rounding).union(flint.arb(high + rounding))


@lru_cache(maxsize=2)
def _box(integrand: Integrand, dim: int, half: int) -> tuple[tuple[Ints, Floats], ...]:
    """Slabs of frequencies m ≠ 0, |m_i| <= half, one of those that share |f^(m)|², and its sum.

    Powers are those of -m; of balls and of sums of products also those of (±m_1, ±m_2, ...), and
    the spectra of all kernels are even in every coordinate.
    """
    even = bool(integrand.parts) or isinstance(integrand, BallIntegrand | Chord)
    first, others = np.arange(half + 1), np.arange(0 if even else -half, half + 1)
    slabs: list[tuple[Ints, Floats]] = []
    thick = max(1, _SLAB // len(others) ** (dim - 1))
    for start in range(0, half + 1, thick):
        grid = np.meshgrid(first[start : start + thick], *[others] * (dim - 1), indexing="ij")
        m = np.stack(grid, axis=-1).reshape(-1, dim)
        m = m[(m != 0).any(axis=1)]
        # Where a coordinate is cut to m_i >= 0 its two signs count together.
        weight = np.where(m != 0, 2.0, 1.0)[:, : dim if even else 1].prod(axis=1)
        slabs.append((m, weight * integrand.coefficient_power(m)))
    return tuple(slabs)


def _outside(
    integrand: Integrand,
    ranges: tuple[OutsideRange, ...],
    half: int,
    left: tuple[float, float],
) -> tuple[float, float]:
    """Least and largest Σ N·P_S |f^(m)|² outside, of an energy between the two of ``left``."""
    off = [r for r in ranges if not r.teeth]
    on = [r for r in ranges if r.teeth and r.upper > 0]
    if on and not isinstance(integrand, BallIntegrand | Chord):
        off, on = [*off, *on], []  # no envelope: any energy may lie on the teeth
    lower, upper = min(r.lower for r in off), max(r.upper for r in off)
    energies = [min(left[1], (1 + ROUNDING) * _teeth_energy(integrand, r, half)) for r in on]
    most = upper * left[1] + sum(r.upper * e for r, e in zip(on, energies, strict=True))
    return lower * max(0.0, left[0] - sum(energies)), most


def _teeth_energy(integrand: Integrand, place: OutsideRange, half: int) -> float:
    """Bound of Σ |f^(m)|² over the support, with coordinates on teeth and some |m_i| > half.

    With A(k) such frequencies of max |m_i| <= k the shells give Σ (A(k) - A(k - 1)) e(k), e the
    envelope. Beyond the last shell K, A(k) <= a k^s and e(k) <= c k^-(d+1), and summation by parts
    leaves at most a c (d + 1) K^(s-d-1)/(d + 1 - s).
    """
    dim, radius = _ball_of(integrand)
    free = len(place.support) - len(place.teeth)
    k = np.arange(half, half + _SHELLS + 1, dtype=np.float64)
    inner = (2 * k) ** free
    for spacing in place.teeth.values():
        inner = inner * (2 * np.floor(k / spacing))
    shells = float((np.diff(inner) * envelope(dim, radius, k[1:])).sum())
    last, size = float(k[-1]), len(place.support)
    x2 = (2 * pi * radius * last) ** 2 - dim**2 / 4
    if x2 <= 0:
        return inf  # so small a ball that its spectrum has not begun to fall
    a = 2.0**size / prod(place.teeth.values())
    c = radius**dim * 2 / pi * last / sqrt(x2)
    return shells + a * c * (dim + 1) / ((dim + 1 - size) * last ** (dim + 1 - size))


def _ball_of(integrand: Integrand) -> tuple[int, float]:
    """Dimension and radius of the ball whose spectrum, or a slice of it, the integrand has."""
    assert isinstance(integrand, BallIntegrand | Chord)
    return integrand.dim + isinstance(integrand, Chord), float(integrand.radius)


def envelope(dim: int, radius: float, rho: Floats) -> Floats:
    """Bound of the ball's |f^(m)|² at |m| >= rho > 0, at most the square of its volume.

    Parameters
    ----------
    dim : int
        1, 2 or 3.
    radius : float
    rho : array
    """
    volume = {1: 2.0, 2: pi, 3: 4 * pi / 3}[dim] * radius**dim
    x2 = (2 * pi * radius * rho) ** 2 - dim**2 / 4
    decay = (radius / rho) ** dim * 2 / (pi * np.sqrt(np.maximum(x2, 1e-300)))
    return np.where(x2 > 0, np.minimum(volume**2, decay), volume**2)


def _energy_error(integrand: Integrand, half: int, total: float) -> float:
    """Bound of the rounding of Σ |f^(m)|² inside, on the assumptions above."""
    if not isinstance(integrand, BallIntegrand | Chord):
        return POWER_ROUNDING * total
    dim, radius = _ball_of(integrand)
    k = np.arange(1, half + 1, dtype=np.float64)
    numbers = (2 * k + 1) ** integrand.dim - (2 * k - 1) ** integrand.dim
    x = 2 * pi * radius * k * sqrt(integrand.dim)  # |m| is at most √d times max |m_i|
    errors = BESSEL_ROUNDING * (10 + x) * envelope(dim, radius, k)
    return float((numbers * errors).sum())
