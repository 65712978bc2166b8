"""Faults: none on samplers that are correct, whatever their shape; the rest is told by its kind.

Every draw is keyed by a fixed seed. With another seed, a correct sampler is reported with a
probability of at most 1e-6 a call (biases), and 1e-8 for all other kinds together, except where a
docstring says more.
"""

import numpy as np
import pytest
from point_sets import CORRECT, independent
from specrate.numerics.checking.faults import find_faults
from specrate.numerics.measuring.probes import amplitudes, frequencies
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError


@pytest.mark.parametrize("shape", [(1, 16, 2), (2, 16, 2), (4, 4, 1), (60, 64, 3), (300, 64, 2)])
@pytest.mark.parametrize("name", CORRECT)
def test_correct_samplers_have_no_fault(name: str, shape: tuple[int, int, int]) -> None:
    """False alarm below 1e-6 a case; 6e-9 more where one shift makes the one realisation."""
    R, N, d = shape
    points = CORRECT[name](R, N, d, stream(11, *shape))
    wanted = frequencies(N, d)
    found = dict(zip(wanted, amplitudes(points, wanted), strict=True))
    told = find_faults(points, cells=(round(N ** (1 / d)), 8), amplitudes=found)
    assert told.faults == ()
    assert told.distinct == R


@pytest.mark.parametrize("shape", [(1, 1, 1), (2, 1, 1), (200, 1, 3), (3, 50000, 1), (20, 2, 200)])
def test_extreme_shapes(shape: tuple[int, int, int]) -> None:
    """False alarm below 1e-6 a case."""
    assert find_faults(independent(*shape, stream(12, *shape))).faults == ()


@pytest.mark.parametrize("shape", [(4, 2), (0, 4, 2), (4, 0, 2)])
def test_empty_and_flat_arrays_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match=r"array \(R, N, d\): got shape"):
        find_faults(np.zeros(shape))
