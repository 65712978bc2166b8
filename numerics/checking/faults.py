"""Faults of a sampler that can be seen on its raw points, whatever it claims.

Judged on R independent realisations of N points: coincidences (`coincidences.py`), which have no
tolerance and which continuous points in double precision show with a probability below
`COINCIDENCE_LEVEL` a call, and biases (`biases.py`), tested at the level that is asked for.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from ..point_sources.fault_kinds import Fault
from .biases import biases, frozen
from .coincidences import coincidences

BIAS_LEVEL = 1e-6
"""False-alarm probability of all bias tests of one call of `find_faults`, unless told."""

COINCIDENCE_LEVEL = 1e-8
"""False-alarm probability of all other kinds in one call, from two realisations on."""


@dataclass(frozen=True)
class Findings:
    """What was found on raw points.

    Parameters
    ----------
    faults : tuple of Fault
    distinct : int
        How many of the realisations are different sets of points.
    """

    faults: tuple[Fault, ...]
    distinct: int


def find_faults(
    points: NDArray[np.float64],
    cells: tuple[int, ...] = (),
    level: float = BIAS_LEVEL,
    amplitudes: Mapping[tuple[int, ...], NDArray[np.complex128]] | None = None,
) -> Findings:
    """Faults of raw points, at most one for each kind (and lattice, of quantised coordinates).

    Parameters
    ----------
    points : ndarray of float64, shape (R, N, d)
        Independent realisations, finite and in [0, 1). With R = 1 neither duplicates nor bias can
        be seen.
    cells : tuple of int
        Numbers of strata along an axis, at which fixed places are looked for besides N and
        N^(1/d).
    level : float
        False-alarm probability of all bias tests of this call together.
    amplitudes : mapping of frequency to complex array of shape (R,), optional
        F_S(m) of the same realisations, with which the fault ``not homogenised`` is looked for.

    Returns
    -------
    Findings
        Without faults for a sampler whose points are continuous and whose amplitudes have the
        mean 0.

    Raises
    ------
    InputError
        If the array is not of rank 3 or holds nothing.

    Notes
    -----
    Stratum centres (coefficient ±1 in every realisation) count as bias from R = 29 on, for d = 2
    and no `cells` and amplitudes. No valid test of this level can do with fewer than 24, because a
    coefficient that is ±1 by a fair coin is no bias; the empirical Bernstein bound needs 85. A
    smaller steady coefficient z takes about 20 / |z| realisations, a noisy one more.
    A single realisation whose whole axis hangs on one uniform shift is taken for quantised with
    probability 3e-9; every further realisation multiplies by as much.
    """
    if points.ndim != 3 or points.size == 0:
        raise InputError(f"points must fill an array (R, N, d): got shape {points.shape}")
    n, dim = points.shape[1:]
    places = sorted({n, round(n ** (1 / dim)), *cells})
    found, distinct = coincidences(points, places)
    if distinct == 1 < len(points):
        return Findings((*found, frozen(len(points))), distinct)
    return Findings((*found, *biases(points, places, level, amplitudes or {})), distinct)
