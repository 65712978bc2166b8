"""Straight lines through log N·P_S, for comparison: least squares on log |m| and log N.

    log Y = log C + b log |m| − b e log N

at the frequencies below half the crossover, |m| <= N^e/2, with Student's intervals for b and, by
the delta method, for e. It is granted the true e to place the cut, and still fails: the next order
of the spectrum bends the line, and more data make the wrong slope more certain.
"""

from collections.abc import Sequence
from math import sqrt

import numpy as np

from ..measuring.moments import Interval, special
from .estimated_spectra import EstimatedSpectrum

_BELOW = 0.5  # of the crossover N^e
_LEVEL = 0.05


def fit_line(
    spectra: Sequence[EstimatedSpectrum], effective: float
) -> tuple[Interval | None, Interval | None]:
    """95 % intervals of b and e; None where the frequencies do not determine them.

    Parameters
    ----------
    spectra : sequence of EstimatedSpectrum
        With positive powers.
    effective : float
        The e by which frequencies are chosen.
    """
    rows, values = list[list[float]](), list[float]()
    for s in spectra:
        radius = np.sqrt((s.frequencies.astype(float) ** 2).sum(axis=1))
        for r, y in zip(radius.tolist(), s.power.tolist(), strict=True):
            if r <= _BELOW * s.n**effective:
                rows.append([1.0, np.log(r), np.log(s.n)])
                values.append(np.log(y))
    x, y = np.array(rows).reshape(-1, 3), np.array(values)
    free = len(y) - 3
    if free < 1 or np.linalg.matrix_rank(x) < 3:
        return None, None
    inverse = np.linalg.inv(x.T @ x)
    _, b, slope = (inverse @ x.T @ y).tolist()
    left = y - x @ (inverse @ x.T @ y)
    covariance = inverse * float(left @ left) / free
    t = float(special().stdtrit(free, 1 - _LEVEL / 2))
    half = t * sqrt(covariance[1, 1])
    e = -slope / b
    tangent = np.array([0.0, -e / b, -1 / b])
    half_e = t * sqrt(max(float(tangent @ covariance @ tangent), 0.0))
    return Interval(b, b - half, b + half), Interval(e, e - half_e, e + half_e)
