r"""Cloaked lattice: points uniform in their cells, moved by independent symmetric stable numbers.

With V uniform on (−π/2, π/2) and W exponential (Chambers, Mallows, Stuck 1976)

    S = sin(βV)/cos(V)^(1/β) · (cos((1 − β)V)/W)^((1 − β)/β),      E exp(itS) = exp(−|t|^β).

Tails as heavy as those of a small β exceed all doubles, so that ln |S| is what is computed. A
displacement X of more than T = 2^32 periods is taken uniform modulo 1: its density f falls beyond
T, so that no E exp(2πimX) changes by more than f(T)/(πm) < 2^-32.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import log, pi

import numpy as np
from numpy.typing import NDArray

from .jitter import below_one, jitter

_FAR = 32 * log(2)  # ln of the periods beyond which a displacement is uniform


def cloaked(
    strata: Sequence[int], beta: Fraction, replicates: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Points of shape (replicates, ∏ strata, d) in [0, 1).

    Parameters
    ----------
    beta : Fraction
        0 < β <= 2; a displacement c S of a cell has E exp(−2πi x c S) = exp(−|x|^β/2).
    """
    points = jitter(strata, replicates, rng)
    size, sign = log_stable(beta, points.shape, rng)
    size -= log(2) / float(beta) + np.log(2 * pi * np.asarray(strata, dtype=np.float64))
    is_far = size > _FAR
    points += np.where(is_far, rng.random(points.shape), sign * np.exp(np.minimum(size, _FAR)))
    points %= 1
    return below_one(points)


def log_stable(
    beta: Fraction, shape: tuple[int, ...], rng: np.random.Generator
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """ln |S| and the sign of S, with E exp(itS) = exp(−|t|^β)."""
    b = float(beta)
    v = pi * (rng.random(shape) - 0.5)
    w = rng.standard_exponential(shape)
    with np.errstate(divide="ignore"):  # S = 0 has ln |S| = −∞
        size = np.log(np.abs(np.sin(b * v))) - np.log(np.cos(v)) / b
    # cos((1 − β)V) > 0: |1 − β| |V| < π/2.
    size += (1 - b) / b * (np.log(np.cos((1 - b) * v)) - np.log(w))
    return size, np.sign(v)
