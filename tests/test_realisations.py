"""What a sampler returned: read as float64, or its first fault; N near one that is refused.

The faults themselves are swept in the tests of sources.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.point_sources.realisations import (
    SamplerFault,
    checked,
    nearby_powers,
    not_honoured,
)


def test_integers_and_lists_are_read_as_doubles() -> None:
    found = checked([[0, 0], [0, 0.5]], 2, 2, 0)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, [[0, 0], [0, 0.5]])


def test_the_first_fault_is_told() -> None:
    """The shape before the values, and of these the first in the order of rows."""
    with pytest.raises(SamplerFault, match=r"shape: .* must have shape \(4, 2\): got \(4, 3\)"):
        checked(np.full((4, 3), np.nan), 4, 2, 7)
    points = np.zeros((4, 2))
    points[1, 1], points[2, 0] = -1.0, 2.0
    with pytest.raises(
        SamplerFault, match=r"got -1\.0 on axis 2, row 1 of realisation 7"
    ) as caught:
        checked(points, 4, 2, 7)
    assert caught.value.evidence["values"] == 2


@given(n=st.integers(1, 10**6), dim=st.integers(1, 6))
def test_nearby_powers_are_near_powers(n: int, dim: int) -> None:
    found = nearby_powers(n, dim)
    assert n not in found
    assert [abs(c - n) for c in found] == sorted(abs(c - n) for c in found)
    for c in found:
        roots = [round(c ** (1 / p)) for p in range(2, dim + 1)]
        is_power = any(r**p == c for r, p in zip(roots, range(2, dim + 1), strict=True))
        assert is_power or c & (c - 1) == 0


@pytest.mark.parametrize(
    ("n", "dim", "near"), [(50, 2, [49, 64, 32]), (16, 2, [25, 32]), (100, 1, [128, 64])]
)
def test_powers_near_some_numbers(n: int, dim: int, near: list[int]) -> None:
    assert nearby_powers(n, dim) == near


def test_not_honoured_tells_why() -> None:
    refusal = SamplerFault(
        "exception", "f must not raise for n = 50: got ValueError: no", {"n": 50}
    )
    fault = not_honoured("f", 50, [49, 64], refusal)
    assert str(fault) == (
        "not honoured: f must honour n = 50 or one near it (49, 64): got ValueError: no"
    )
    assert fault.evidence == {"n": 50, "tried": [49, 64]}
