"""Averaged periodograms: P_S(m) = E |F_S(m)|² estimated on realisations, with intervals.

F_S(m) = (1/N) Σ_j exp(−2πi m·s_j). On a box |m_i| <= K_i in 1 to 3 dimensions it is a non-uniform
Fourier transform, and two realisations A and B ride in one: with strengths 1 on the points of A
and i on those of B the transform is T = A + iB, and since A(−m) is the conjugate of A(m),

    A(m) = (T(m) + T(−m)*) / 2,        iB(m) = (T(m) − T(−m)*) / 2.

|F_S(m)|² = |F_S(−m)|², so that half of the box is kept. At listed frequencies, in any dimension,
the sums are direct. Shifts are left out: they do not change |F_S(m)|.

Where F_S(m) is a sum of many weakly dependent terms, |F_S(m)|² is close to exponential, and the
mean of R of them follows a Gamma law of shape R. Heavier tails show in its variance, and the shape
is lowered; see `averaged`. |F_S(0)|² = 1 is no estimate.

References
----------
A. H. Barnett, J. Magland, L. af Klinteberg, A parallel nonuniform fast Fourier transform library
based on an "exponential of semicircle" kernel, SIAM J. Sci. Comput. 41 (2019).
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import pi, prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from .moments import special
from .probes import Frequency, amplitudes

ACCURACY = 1e-9
"""Estimated absolute error of F_S(m) on a box; F_S(0) = 1. Seen up to 5e-10 at its corners."""

_TOLERANCE = ACCURACY / 2
_ROUNDING = 1e-15  # of a direct sum, for each radian of its largest angle
_MOST_MODES = 1 << 22  # keeps the memory below 1 GiB, with a million points
_LARGEST_HALF_WIDTH = 1 << 19  # beyond, angles in double precision are worse than 1e-9
_BLOCK = 1 << 13  # frequencies whose powers are formed at once, within the cache
_WAVES = 48  # waves of a block of listed frequencies, 4 MiB each
_STEP = 0.01  # of the logarithm of a shape

Reals = NDArray[np.float64]


@dataclass(frozen=True)
class Box:
    """The frequencies |m_i| <= half_widths[i].

    Parameters
    ----------
    half_widths : tuple of int
        In 1 to 3 dimensions, in 1..2^19 each, of at most 2^22 frequencies.
    """

    half_widths: tuple[int, ...]

    def __post_init__(self) -> None:
        if not 1 <= len(self.half_widths) <= 3:
            raise InputError(
                "a box of frequencies must have 1 to 3 dimensions (beyond, list frequencies): "
                f"got {len(self.half_widths)}"
            )
        if not all(1 <= k <= _LARGEST_HALF_WIDTH for k in self.half_widths):
            raise InputError(
                f"half-widths must be in 1..{_LARGEST_HALF_WIDTH}: got {self.half_widths}"
            )
        if self.size > _MOST_MODES:
            raise InputError(f"a box must hold at most {_MOST_MODES} frequencies: got {self.size}")

    @property
    def shape(self) -> tuple[int, ...]:
        """Numbers of frequencies along the axes."""
        return tuple(2 * k + 1 for k in self.half_widths)

    @property
    def size(self) -> int:
        """Number of frequencies."""
        return prod(self.shape)


@dataclass(frozen=True, eq=False)
class Periodogram:
    """An averaged periodogram with intervals.

    Parameters
    ----------
    n : int
        Points of a realisation.
    realisations : int
    where : Box or tuple of frequencies
    mean, low, high : array
        P_S(m) and the ends of its interval. On a box of shape (2K_1 + 1, ...), m increasing along
        every axis and 0 in the middle; else of shape (number of frequencies,).
    level : float
        Probability, both tails together, that the interval of one frequency should miss.
    """

    n: int
    realisations: int
    where: Box | tuple[Frequency, ...]
    mean: Reals
    low: Reals
    high: Reals
    level: float

    def frequencies(self) -> NDArray[np.int64]:
        """The frequencies, of the shape of the mean with one more axis of length d."""
        if not isinstance(self.where, Box):
            return np.array(self.where, np.int64)
        axes = [np.arange(-k, k + 1) for k in self.where.half_widths]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)


@dataclass(eq=False)
class PeriodogramSums:
    """Sums over realisations, grown by `absorb`.

    Parameters
    ----------
    where : Box or tuple of frequencies
    threads : int
        Threads of the transform, 0 for as many as there are cores. With one, the sums do not
        depend on the machine.
    count : int
        Realisations summed.
    total, squares : array
        Sums of |F|² and of |F|⁴: on a box for its first half in the order of its frequencies, of
        which the other half is the mirror image.
    waiting : array of shape (n, d), optional
        A realisation that waits for another to share its transform.
    """

    where: Box | tuple[Frequency, ...]
    threads: int = 1
    n: int = 0
    count: int = 0
    total: Reals | None = None
    squares: Reals | None = None
    waiting: Reals | None = None
    plan: Any = None
    strengths: Any = None

    def __post_init__(self) -> None:
        if not isinstance(self.where, Box) and len({len(m) for m in self.where}) != 1:
            raise InputError(f"frequencies must share one dimension: got {self.where}")

    @property
    def dim(self) -> int:
        """The dimension of the frequencies."""
        return len(self.where.half_widths if isinstance(self.where, Box) else self.where[0])


def average_periodogram(
    realisations: Iterable[Reals],
    where: Box | tuple[Frequency, ...],
    level: float = 1e-3,
    threads: int = 1,
    progress: Callable[[int], None] | None = None,
) -> Periodogram:
    """Averaged periodogram of realisations that come in arrays.

    Parameters
    ----------
    realisations : iterable of arrays of shape (R, n, d)
        Independent realisations with coordinates in [0, 1).
    where : Box or tuple of frequencies
    level : float
        In (0, 1).
    threads : int
        Threads of the transform, 0 for as many as there are cores.
    progress : callable, optional
        Told the number of realisations after each array.

    Raises
    ------
    InputError
        If there is no realisation, or they do not fit together.
    """
    sums = PeriodogramSums(where, threads)
    for points in realisations:
        absorb(sums, points)
        if progress is not None:
            progress(sums.count + (sums.waiting is not None))
    return averaged(sums, level)


def absorb(sums: PeriodogramSums, points: Reals) -> None:
    """Add realisations, an array of shape (R, n, d); how they are divided into arrays is the same.

    Raises
    ------
    InputError
        If their shape does not fit.
    """
    if points.ndim != 3 or points.shape[2] != sums.dim or points.shape[1] == 0:
        raise InputError(f"points must fill an array (R, N, {sums.dim}): got shape {points.shape}")
    if sums.total is None or sums.squares is None:
        sums.n = points.shape[1]
        size = sums.where.size // 2 if isinstance(sums.where, Box) else len(sums.where)
        sums.total, sums.squares = np.zeros(size), np.zeros(size)
    if points.shape[1] != sums.n:
        raise InputError(f"realisations must have {sums.n} points, as before: got {len(points[0])}")
    if not isinstance(sums.where, Box):
        _add_listed(sums.total, sums.squares, points, sums.where)
        sums.count += len(points)
        return
    for realisation in points:
        if sums.waiting is None:
            sums.waiting = realisation.copy()
            continue
        _add_powers(sums.total, sums.squares, _transform(sums, [sums.waiting, realisation]))
        sums.waiting = None
        sums.count += 2


def averaged(sums: PeriodogramSums, level: float = 1e-3) -> Periodogram:
    """The means, with an interval for each.

    Parameters
    ----------
    level : float
        In (0, 1).

    Raises
    ------
    InputError
        If there is no realisation, or the level is out of range.

    Notes
    -----
    With v the ratio of the variance of |F|² to the square of its mean, 1 for the exponential law,
    the shape is R / (1 + 2 max(v − 1, 0)). The exponential law has the level at least. Simulated
    at levels 1e-2 to 1e-4: if F is real, so that |F|² follows χ² of one degree (v = 2), misses
    are 0.2 to 1.5 times as frequent as the level says from R = 64 on, but 12 times at R = 16 and
    level 1e-4; a Gamma law of shape 1/4 (v = 4), 0.1 to 0.6 times from R = 64 on; a lognormal law
    (v = 1.7) up to 4 times from R = 16 on. What is rare is not seen until it has been drawn. The
    ends are moved outwards by the error of F, which is estimated, not bounded.
    """
    if not 0 < level < 1:
        raise InputError(f"a level must satisfy 0 < level < 1: got {level}")
    if sums.total is None or sums.squares is None:
        raise InputError("a periodogram needs 1 <= realisations: got 0")
    count, total, squares = sums.count, sums.total, sums.squares
    if sums.waiting is not None:
        total, squares = total.copy(), squares.copy()
        _add_powers(total, squares, _transform(sums, [sums.waiting]))
        count += 1
    mean: Reals = total / count
    low, high = _interval(mean, squares / count, count, level)
    error = _error(sums.where)
    low = np.maximum(np.sqrt(low) - error, 0) ** 2
    high = (np.sqrt(high) + error) ** 2
    if isinstance(sums.where, Box):
        mean, low, high = (_mirrored(half, sums.where) for half in (mean, low, high))
    else:
        for values in (mean, low, high):
            values[[not any(m) for m in sums.where]] = 1.0
    return Periodogram(sums.n, count, sums.where, mean, low, high, level)


def _transform(sums: PeriodogramSums, sets: list[Reals]) -> NDArray[np.complex128]:
    """(A + iB)/2 of one or two realisations on the box, flat; reversed it is that of −m."""
    assert isinstance(sums.where, Box)
    if sums.plan is None:
        sums.plan = _plan(sums.where, sums.n, sums.threads)
        sums.strengths = np.repeat(np.array([0.5 / sums.n, 0.5j / sums.n]), sums.n)
    angles = np.empty((sums.dim, len(sets) * sums.n))
    for index, points in enumerate(sets):
        np.multiply(points.T, 2 * pi, out=angles[:, index * sums.n : (index + 1) * sums.n])
    sums.plan.setpts(*angles)
    return sums.plan.execute(sums.strengths[: angles.shape[1]]).reshape(-1)


def _plan(box: Box, n: int, threads: int) -> Any:
    """What the transforms of all pairs share."""
    import finufft  # pyright: ignore[reportMissingTypeStubs]

    # A coarse grid makes the FFT cheap and the spreading dear: worth it for few points. In 3D the
    # coarsest loses digits at the corners; the finest of a large box would not fit the memory.
    is_dense = 4 * n >= box.size and box.size <= 1 << 21
    factor = 2.0 if is_dense else 1.35 if len(box.shape) == 3 else 1.25
    options: dict[str, Any] = {"nthreads": threads, "upsampfac": factor}
    return finufft.Plan(1, box.shape, 1, _TOLERANCE, -1, **options)


def _add_powers(total: Reals, squares: Reals, transform: NDArray[np.complex128]) -> None:
    """Part the two realisations of a transform and add their powers, on half of the box."""
    half = len(total)
    mirrored = transform[::-1]
    for start in range(0, half, _BLOCK):
        part = slice(start, min(start + _BLOCK, half))
        one, other = transform[part], np.conj(mirrored[part])
        for amplitude in (one + other, one - other):
            parts = amplitude.view(np.float64).reshape(-1, 2)
            power = np.einsum("ij,ij->i", parts, parts)
            total[part] += power
            power *= power
            squares[part] += power


def _add_listed(total: Reals, squares: Reals, points: Reals, wanted: tuple[Frequency, ...]) -> None:
    """Add the powers at listed frequencies, a few at a time: each holds one wave an axis."""
    step = max(1, _WAVES // points.shape[2])
    for start in range(0, len(wanted), step):
        part = slice(start, start + step)
        power = np.abs(amplitudes(points, wanted[part])) ** 2
        total[part] += power.sum(axis=1)
        squares[part] += (power * power).sum(axis=1)


def _interval(mean: Reals, square: Reals, count: int, level: float) -> tuple[Reals, Reals]:
    """Ends of the Gamma intervals of means of ``count`` powers, given the means of their squares.

    Shapes are rounded down, which widens the interval, to ``count`` times powers of e^-0.01.
    """
    quotient: Reals = square / np.where(mean > 0, mean, 1.0) ** 2
    scale = count / (count - 1) if count > 1 else 0.0
    excess: Reals = np.maximum((quotient - 1) * scale - 1, 0)
    lowered = np.ceil(np.log1p(2 * excess) / _STEP).astype(np.int64)
    shapes = count * np.exp(-_STEP * np.arange(int(lowered.max(initial=0)) + 1))
    below = shapes / special().gammainccinv(shapes, level / 2)
    above = shapes / special().gammaincinv(shapes, level / 2)
    return mean * below[lowered], mean * above[lowered]


def _error(where: Box | tuple[Frequency, ...]) -> float | Reals:
    """Estimated absolute error of F."""
    if isinstance(where, Box):
        return ACCURACY
    return _ROUNDING * (1 + 2 * pi * np.abs(np.array(where, np.int64)).sum(axis=1))


def _mirrored(half: Reals, box: Box) -> Reals:
    """The whole box from its first half."""
    return np.concatenate([half, [1.0], half[::-1]]).reshape(box.shape)
