"""White noise: how far the mean periodogram of independent points strays from 1, bounded at any N.

For independent uniform points and m ≠ 0 the phases 2π m·s_j are independent and uniform, so that
Y = N |F_S(m)|² has the same law at all m, E Y = 1. The mean of Y over R independent realisations
has tails that Chernoff's inequality bounds at any N and R:

- E Y^k <= k!, because E |Σ_j z_j|^2k = Σ_|a|=k (k!/∏ a_j!)² and each (k!/∏ a_j!)² is at most
  k! · k!/∏ a_j!, the sum of which is k! N^k. So E e^(tY) <= 1/(1 − t) as for the exponential law,
  and P(mean >= x) <= (x e^(1−x))^R for x > 1.
- For g complex normal, E e^(−tY) = E_g ∏_j E e^(i 2√(t/N) Re(ḡ z_j)) = ∫ e^−s J_0(2√(ts/N))^N ds.
  Up to its first zero j, 0 <= J_0(y) <= e^(−y²/4) (its product over zeros, Σ 1/j_k² = 1/4), and
  beyond |J_0| <= c = |J_0(j_11)|. So E e^(−tY) <= 1/(1 + t) + c^N e^(−N j²/(4t)), and
  with t = 1/x − 1, P(mean <= x) <= (e^(1−x) (x + c^N e^(−N j² x/(4 (1−x)))))^R for x < 1.

References
----------
G. N. Watson, A Treatise on the Theory of Bessel Functions, 2nd ed., 1944: 15.41, 15.51.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import exp, inf, log
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from .moments import Interval
from .periodograms import Box, Periodogram, PeriodogramSums, average_periodogram, averaged
from .probes import Frequency, amplitudes, supports_of_size

Reals = NDArray[np.float64]
Side = Literal["less", "more"]


_LARGEST_J0 = 0.40276  # of |J_0| beyond its first zero, rounded up
_QUARTER_ZERO = 1.4457  # j_01² / 4, rounded down
_HALVINGS = 100
_HALF_WIDTHS = {1: 16, 2: 16, 3: 10}  # of the box, by dimension
_MOST_PAIRS, _MOST_TRIPLES = 780, 1000  # beyond, neighbouring coordinates only


@dataclass(frozen=True, eq=False)
class Scan:
    """N·P_S at the scanned frequencies, one of m and −m, at one N.

    Parameters
    ----------
    n, realisations : int
    powers : mapping of frequency to Interval
        The simplest first.
    low, high : float
        Range of white noise.
    """

    n: int
    realisations: int
    powers: dict[Frequency, Interval]
    low: float
    high: float

    def departing(self, side: Side) -> Iterator[Frequency]:
        """Frequencies whose mean power is less, or more, than white noise may have."""
        for m, power in self.powers.items():
            if power.estimate < self.low if side == "less" else power.estimate > self.high:
                yield m

    def at(self, m: Sequence[int]) -> Interval | None:
        """N·P_S at m or −m, if it was scanned."""
        return self.powers.get(_canonical(tuple(m)))


def log_probability_below(x: float, n: int, realisations: int) -> float:
    """Bound of the logarithm of P(mean of N |F_S(m)|² <= x) for independent uniform points.

    Parameters
    ----------
    x : float
        At least 0.
    n : int
        Points of a realisation.
    realisations : int
        Independent ones.
    """
    if x >= 1:
        return 0.0
    rest = n * (log(_LARGEST_J0) - _QUARTER_ZERO * x / (1 - x))
    inside = x + exp(rest)
    return min(0.0, realisations * (1 - x + log(inside))) if inside > 0 else -inf


def log_probability_above(x: float, realisations: int) -> float:
    """Bound of the logarithm of P(mean of N |F_S(m)|² >= x), at any N.

    Parameters
    ----------
    x : float
        At least 0.
    realisations : int
        Independent ones.
    """
    return realisations * (1 - x + log(x)) if x > 1 else 0.0


def white_noise_range(n: int, realisations: int, level: float) -> tuple[float, float]:
    """Range that the mean of N |F_S(m)|² leaves on each side with at most a probability.

    Parameters
    ----------
    n : int
        Points of a realisation, at least 1.
    realisations : int
        At least 1.
    level : float
        In (0, 1), of each side.

    Returns
    -------
    tuple of float
        (low, high): means below ``low`` are less, means above ``high`` are more than white noise.
        ``low`` is 0 where even a mean of 0 could be chance.

    Raises
    ------
    InputError
        If a number is out of range.
    """
    if n < 1 or realisations < 1 or not 0 < level < 1:
        rule = "white noise needs N >= 1, realisations >= 1 and 0 < level < 1"
        raise InputError(f"{rule}: got {n}, {realisations} and {level}")
    wanted = log(level)

    def is_less(x: float) -> bool:
        return log_probability_below(x, n, realisations) <= wanted

    def is_more(x: float) -> bool:
        return log_probability_above(x, realisations) <= wanted

    low = _edge(is_less, 0.0, 1.0) if is_less(0.0) else 0.0
    high = 2.0
    while not is_more(high):
        high *= 2
    return low, _edge(is_more, high, 1.0)


def _edge(holds: Callable[[float], bool], inside: float, outside: float) -> float:
    """Where a statement that holds inside and not outside ceases to hold, on the side inside."""
    for _ in range(_HALVINGS):
        middle = (inside + outside) / 2
        if holds(middle):
            inside = middle
        else:
            outside = middle
    return inside


def scanned_frequencies(dim: int) -> Box | tuple[Frequency, ...]:
    """A box up to three dimensions; beyond, axes, pairs and triples at low frequencies.

    All pairs up to 40 dimensions and all triples up to 19, beyond those of neighbours.
    """
    if dim in _HALF_WIDTHS:
        return Box((_HALF_WIDTHS[dim],) * dim)
    patterns = {1: [(1,), (2,)], 2: [(1, 1), (1, 2), (2, 1)], 3: [(1, 1, 1)]}
    found: list[Frequency] = []
    for size, most in ((1, dim), (2, _MOST_PAIRS), (3, _MOST_TRIPLES)):
        for support in supports_of_size(dim, size, most):
            for values in patterns[size]:
                for signs in product((1, -1), repeat=size - 1):
                    m = [0] * dim
                    for axis, k, sign in zip(support, values, (1, *signs), strict=True):
                        m[axis - 1] = sign * k
                    found.append(tuple(m))
    return tuple(found)


def scan(points: Reals, level: float) -> Scan:
    """Scan realisations of one N.

    Parameters
    ----------
    points : array of shape (R, N, d)
        R >= 2.
    level : float
        Over all frequencies.

    Raises
    ------
    InputError
        If the array has another rank, or fewer than 2 realisations.
    """
    if points.ndim != 3 or len(points) < 2 or points.shape[1] == 0:
        rule = "a scan needs an array (R, N, d) of at least 2 realisations"
        raise InputError(f"{rule}: got shape {points.shape}")
    count, n, dim = points.shape
    where = scanned_frequencies(dim)
    size = where.size // 2 if isinstance(where, Box) else len(where)
    each = level / (2 * size)
    if isinstance(where, Box):
        found = average_periodogram([points], where, each)
    else:
        found = _listed(points, where, each)
    return Scan(n, count, _powers(found), *white_noise_range(n, count, each))


def _listed(points: Reals, where: tuple[Frequency, ...], level: float) -> Periodogram:
    """The periodogram at listed frequencies, all of which share their waves."""
    power = np.abs(amplitudes(points, where)) ** 2
    squares = (power * power).sum(axis=1)
    sums = PeriodogramSums(where, 1, points.shape[1], len(points), power.sum(axis=1), squares)
    return averaged(sums, level)


def _powers(found: Periodogram) -> dict[Frequency, Interval]:
    """N·P_S by frequency, the simplest first; of m and −m the one that starts positive."""
    frequencies = found.frequencies().reshape(-1, found.frequencies().shape[-1])
    values = np.stack([found.mean, found.low, found.high], axis=-1).reshape(-1, 3) * found.n
    if isinstance(found.where, Box):
        middle = len(frequencies) // 2 + 1
        frequencies, values = frequencies[middle:], values[middle:]
    sizes = np.abs(frequencies)
    keys = (*frequencies.T[::-1], sizes.max(axis=1), sizes.sum(axis=1), (sizes > 0).sum(axis=1))
    order = np.lexsort(keys)
    rows = zip(frequencies[order].tolist(), values[order].tolist(), strict=True)
    return {tuple(m): Interval(*value) for m, value in rows}


def _canonical(m: Frequency) -> Frequency:
    first = next((k for k in m if k), 1)
    return m if first > 0 else tuple(-k for k in m)
