"""Coincidences: each is seen on a sampler that has it, and chance makes none.

Every draw is keyed by a fixed seed; with another one, chance shows a coincidence with a probability
below 1e-8 a call.
"""

import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from point_sets import centred_latin_hypercube, grid, independent, jitter, of_kind
from specrate.numerics.checking.coincidences import coincidences
from specrate.numerics.checking.faults import find_faults
from specrate.numerics.streams import stream


def test_an_ignored_seed_gives_duplicates() -> None:
    """Sets are compared, so the order of the points does not hide it."""
    points = np.repeat(independent(1, 32, 2, stream(13)), 5, axis=0)
    points[3] = points[3, ::-1]
    (fault,) = of_kind(find_faults(points), "duplicate realisations")
    assert fault.detail.startswith("realisations must differ: got 1 distinct of 5")
    assert fault.evidence == {"realisations": 5, "distinct": 1, "pairs": 10, "first_pair": [0, 1]}


def test_some_duplicates_are_counted() -> None:
    points = independent(9, 32, 2, stream(14))
    points[[4, 6]] = points[1]
    points[8] = points[3, stream(15).permutation(32)]
    (fault,) = find_faults(points).faults
    assert fault.evidence == {"realisations": 9, "distinct": 6, "pairs": 4, "first_pair": [1, 4]}


def test_equal_coordinates_in_other_pairs_are_no_duplicate() -> None:
    """The same values along each axis, but other points."""
    points = np.repeat(independent(1, 32, 2, stream(16)), 2, axis=0)
    points[1, :, 1] = points[1, ::-1, 1]
    assert not of_kind(find_faults(points), "duplicate realisations")


@settings(deadline=None)
@given(seed=st.integers(0, 2**32), N=st.integers(1, 20), d=st.integers(1, 4))
def test_one_ulp_makes_another_point_set(seed: int, N: int, d: int) -> None:
    points = np.repeat(independent(1, N, d, stream(seed)), 2, axis=0)
    points[1] = points[1, stream(seed, 1).permutation(N)]
    assert of_kind(find_faults(points), "duplicate realisations")
    points[1, 0, 0] = np.nextafter(points[1, 0, 0], 2.0)
    assert not of_kind(find_faults(points), "duplicate realisations")


def test_points_left_at_the_origin_are_piled() -> None:
    """A grid of 7 x 7 for n = 60: the other 11 points stay at the origin, one of them as -0."""
    points = np.zeros((6, 60, 2))
    points[:, :49] = jitter(6, 49, 2, stream(17))
    points[2, 50] = -0.0
    (fault,) = of_kind(find_faults(points), "piled points")
    assert "got 11 of 60 points of realisation 0 at (0, 0)" in fault.detail
    assert "rows were left at the origin" in fault.remedy
    assert fault.evidence == {
        "realisation": 0,
        "location": [0.0, 0.0],
        "within": 0.0,
        "count": 11,
        "realisations_piled": 6,
    }


@pytest.mark.parametrize("d", [1, 2, 6])
def test_one_pair_of_equal_points_is_piled(d: int) -> None:
    points = independent(4, 20, d, stream(18))
    points[2, 11] = points[2, 3]
    (fault,) = find_faults(points).faults
    assert (fault.kind, fault.evidence["count"]) == ("piled points", 2)
    assert fault.evidence["location"] == points[2, 3].tolist()


@pytest.mark.parametrize(("d", "noise", "digits"), [(1, 1e-12, 32), (2, 1e-9, 24), (6, 1e-3, 0)])
def test_doubled_points_are_piled(d: int, noise: float, digits: int) -> None:
    """Half of the points are copies of the others but for a little noise."""
    points = independent(16, 50, d, stream(31, d))
    points[:, 25:] = 0.9 * (points[:, :25] + noise * stream(32, d).random((16, 25, d)))
    points[:, :25] *= 0.9
    found = of_kind(find_faults(points), "piled points")
    assert len(found) == (digits > 0)
    for fault in found:
        assert noise / 16 < fault.evidence["within"] <= 2.0**-digits
        assert f"within 2^-{-math.log2(fault.evidence['within']):.0f} of (" in fault.detail


@pytest.mark.parametrize("d", [2, 3])
def test_clusters_are_not_piled(d: int) -> None:
    """Pairs at a hundredth of their mean distance are the design of a clustered process."""
    centres = independent(100, 32, d, stream(33, d))
    offsets = 0.01 / 32 ** (1 / d) * stream(34, d).random((100, 32, d))
    points = np.concatenate([centres, (centres + offsets) % 1.0], axis=1)
    assert find_faults(points).faults == ()


@pytest.mark.parametrize("N", [2, 3, 4, 5])
@pytest.mark.parametrize("M", [3, 5, 8])
def test_shared_cells_are_as_rare_as_their_bound_says(M: int, N: int) -> None:
    """Exact, over all ways to put N points into M cells: P(N - occupied >= c) <= λ^c / c!."""
    occupied = np.array([len(set(w)) for w in itertools.product(range(M), repeat=N)])
    expected = N * (N - 1) / 2 / M
    for c in range(1, N):
        assert np.mean(N - occupied >= c) <= expected**c / math.factorial(c) + 1e-12


def test_equal_points_of_different_realisations_are_not_piled() -> None:
    points = independent(4, 20, 2, stream(19))
    points[:, 0] = 0.3
    assert not of_kind(find_faults(points), "piled points")


@pytest.mark.parametrize("shape", [(1, 8, 1), (2, 4, 2), (30, 64, 2)])
@pytest.mark.parametrize(
    ("name", "coarse"),
    [
        ("2^-24", lambda x: x.astype(np.float32).astype(np.float64)),
        ("2^-24", lambda x: np.floor(x * 2**24) / 2**24),
        ("2^-23", lambda x: np.floor(x * 2**23) / 2**23),
        ("2^-16", lambda x: np.floor(x * 2**16) / 2**16),
        ("1e-06", lambda x: np.floor(x * 1e6) / 1e6),
        ("1e-04", lambda x: np.round(x, 4) % 1.0),
        ("1e-06", lambda x: np.vectorize(lambda v: float(f"{v:.6g}"))(x)),
    ],
)
def test_coarse_coordinates_are_quantised(
    name: str, coarse: Callable[[np.ndarray], np.ndarray], shape: tuple[int, int, int]
) -> None:
    """A coarser lattice would be named by chance with a probability below 0.1 for 8 values."""
    faults = find_faults(coarse(0.1 + 0.9 * independent(*shape, stream(23, *shape))))
    (fault,) = of_kind(faults, "quantised coordinates")
    assert fault.evidence["axes"] == list(range(1, shape[2] + 1))
    assert f"values of spacing {name}" in fault.detail
    assert (" (float32)" in fault.detail) == (name in ("2^-24", "2^-23"))
    assert "double precision" in fault.remedy


def test_only_the_coarse_axis_is_quantised() -> None:
    points = independent(3, 32, 3, stream(21))
    points[:, :, 1] = points[:, :, 1].astype(np.float32)
    (fault,) = find_faults(points).faults
    assert (fault.kind, fault.evidence["axes"]) == ("quantised coordinates", [2])
    assert fault.detail.endswith("values of spacing 2^-24 (float32) on axis 2")
    assert fault.evidence["spacing"] == 2**-24


def test_a_few_double_values_do_not_hide_among_coarse_ones() -> None:
    points = independent(2, 32, 1, stream(22)).astype(np.float32).astype(np.float64)
    points[0, 0, 0] += 2.0**-40
    assert find_faults(points).faults == ()


def test_axes_on_different_lattices_are_told_apart() -> None:
    points = independent(3, 32, 3, stream(35))
    points[:, :, 0] = points[:, :, 0].astype(np.float32)
    points[:, :, 1:] = np.floor(points[:, :, 1:] * 2**12) / 2**12
    found = of_kind(find_faults(points), "quantised coordinates")
    assert [fault.evidence["axes"] for fault in found] == [[1], [2, 3]]


@pytest.mark.parametrize(("offset", "what"), [(1 / 8, "centres"), (0, "corners")])
def test_a_centred_grid_is_quantised_in_a_single_realisation(offset: float, what: str) -> None:
    """Each axis of the 16 points takes four values only."""
    (fault,) = find_faults(grid(16, 2)[None] + offset).faults
    assert fault.evidence["axes"] == [1, 2]
    assert f"got the {what} of 4 strata on axes 1, 2" in fault.detail
    assert "jitter inside the strata" in fault.remedy


@pytest.mark.parametrize("R", [1, 2, 30])
def test_stratum_centres_are_quantised(R: int) -> None:
    """Although 49 is no decimal and no power of two."""
    points = centred_latin_hypercube(R, 49, 2, stream(24, R))
    (fault,) = of_kind(find_faults(points), "quantised coordinates")
    assert "got the centres of 49 strata" in fault.detail
    assert fault.evidence == {
        "axes": [1, 2],
        "distinct": 49,
        "draws": 49 * R,
        "spacing": 1 / 49,
        "strata": 49,
    }


def test_shared_values_that_are_no_strata_are_quantised() -> None:
    """Every realisation takes its values from the same 20 numbers."""
    values = stream(36).random(20)
    points = stream(37).choice(values, (10, 16, 1))
    found = of_kind(find_faults(points), "quantised coordinates")
    assert "got 20 values in" in found[0].detail


@pytest.mark.parametrize(
    ("spoil", "value", "axes"),
    [
        (lambda p: np.minimum(p, 0.95), 0.95, [1, 2]),
        (lambda p: np.concatenate([np.zeros_like(p[:, :1]), p[:, 1:]], axis=1), 0.0, [1, 2]),
        (lambda p: np.where([True, False], np.maximum(p, 0.05), p), 0.05, [1]),
    ],
)
def test_values_that_realisations_share(spoil, value, axes):
    points = spoil(stream(41).random((64, 16, 2)))
    faults, _ = coincidences(points, [4, 16])
    (found,) = [f for f in faults if f.kind == "repeated values"]
    assert (found.evidence["value"], found.evidence["axes"]) == (value, axes)
    assert found.evidence["realisations"] >= 8
    assert found.remedy


def test_a_grain_of_thirty_bits_repeats_no_value():
    """Half a million values: about 128 pairs are equal, and any eight with probability 1e-17."""
    points = stream(42).integers(0, 2**30, (128, 4096, 1)) / 2**30
    faults, _ = coincidences(points, [64])
    assert "repeated values" not in [f.kind for f in faults]
