"""Variances on a ladder of N, shared by the tests of slopes and of drift."""

import numpy as np
from specrate.numerics.measuring.slopes import RatePoint

SIZES = np.array([16.0, 64, 256, 1024, 4096])
MULTI_JITTER_DISK = (-1.443, -1.454, -1.469, -1.480)  # exact local slopes; the limit is -3/2


def points(variances, error, sizes=SIZES):
    return [RatePoint(n, v, error) for n, v in zip(sizes, variances, strict=True)]


def multi_jitter_disk():
    steps = np.array(MULTI_JITTER_DISK) * np.log(4)
    return np.exp(np.concatenate([[0.0], np.cumsum(steps)]))
