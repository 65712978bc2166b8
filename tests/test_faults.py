"""Faults: each is seen on a sampler that has it, and none on samplers that are correct.

Every draw is keyed by a fixed seed. With another seed, a correct sampler is reported with a
probability of at most 1e-6 a call (bias), and 1e-9 for all other kinds together, except where a
docstring says more.
"""

import itertools
import json
import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.faults import BIAS_LEVEL, Fault, _log_capital, find_faults
from specrate.numerics.sources import EngineSource
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError

Sampler = Callable[[int, int, int, np.random.Generator], np.ndarray]


def independent(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return rng.random((R, N, d))


def grid(N: int, d: int) -> np.ndarray:
    """Lower corners of the cells of a grid, shape (N, d)."""
    side = round(N ** (1 / d))
    assert side**d == N
    return np.stack(np.unravel_index(np.arange(N), (side,) * d), axis=1) / side


def jitter(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return grid(N, d) + rng.random((R, N, d)) / round(N ** (1 / d))


def shifted_grid(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return (grid(N, d) + rng.random((R, 1, d))) % 1.0


def ranks(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return rng.permuted(np.broadcast_to(np.arange(N)[None, :, None], (R, N, d)), axis=1)


def latin_hypercube(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return (ranks(R, N, d, rng) + rng.random((R, N, d))) / N


def centred_latin_hypercube(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return (ranks(R, N, d, rng) + 0.5) / N


def shifted_lattice(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    generator = np.array([pow(5, i, N) for i in range(d)])
    return (np.arange(N)[:, None] * generator / N + rng.random((R, 1, d))) % 1.0


def engine(name: str) -> Sampler:
    def draw(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
        qmc = pytest.importorskip("scipy.stats.qmc")
        return EngineSource(name, getattr(qmc, name), d).realise(N, 3, range(R))

    return draw


CORRECT: dict[str, Sampler] = {
    "independent": independent,
    "jitter": jitter,
    "shifted grid": shifted_grid,
    "Latin hypercube": latin_hypercube,
    "shifted lattice": shifted_lattice,
    "Sobol": engine("Sobol"),
    "Halton": engine("Halton"),
    "LatinHypercube": engine("LatinHypercube"),
}


def of_kind(faults: list[Fault], kind: str) -> list[Fault]:
    json.dumps([fault.evidence for fault in faults], allow_nan=False)
    assert all("\n" not in fault.detail for fault in faults)
    return [fault for fault in faults if fault.kind == kind]


@pytest.mark.parametrize("shape", [(1, 16, 2), (2, 16, 2), (4, 4, 1), (60, 64, 3), (300, 64, 2)])
@pytest.mark.parametrize("name", CORRECT)
def test_correct_samplers_have_no_fault(name: str, shape: tuple[int, int, int]) -> None:
    """False alarm below 1e-6 a case; 6e-9 more where one shift makes the one realisation."""
    R, N, d = shape
    points = CORRECT[name](R, N, d, stream(11, *shape))
    assert find_faults(points, cells=(round(N ** (1 / d)), 8)) == []


@pytest.mark.parametrize("shape", [(1, 1, 1), (2, 1, 1), (200, 1, 3), (3, 50000, 1), (20, 2, 200)])
def test_extreme_shapes(shape: tuple[int, int, int]) -> None:
    """False alarm below 1e-6 a case."""
    assert find_faults(independent(*shape, stream(12, *shape))) == []


@pytest.mark.parametrize("shape", [(4, 2), (0, 4, 2), (4, 0, 2)])
def test_empty_and_flat_arrays_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match=r"array \(R, N, d\): got shape"):
        find_faults(np.zeros(shape))


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
    (fault,) = find_faults(points)
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
    assert fault.evidence == {
        "realisation": 0,
        "location": [0.0, 0.0],
        "count": 11,
        "realisations_piled": 6,
    }


@pytest.mark.parametrize("d", [1, 2, 6])
def test_one_pair_of_equal_points_is_piled(d: int) -> None:
    points = independent(4, 20, d, stream(18))
    points[2, 11] = points[2, 3]
    (fault,) = find_faults(points)
    assert (fault.kind, fault.evidence["count"]) == ("piled points", 2)
    assert fault.evidence["location"] == points[2, 3].tolist()


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
    found = of_kind(faults, "quantised coordinates")
    assert [fault.evidence["axis"] for fault in found] == list(range(1, shape[2] + 1))
    assert all(f"values of spacing {name}" in fault.detail for fault in found)


def test_only_the_coarse_axis_is_quantised() -> None:
    points = independent(3, 32, 3, stream(21))
    points[:, :, 1] = points[:, :, 1].astype(np.float32)
    (fault,) = find_faults(points)
    assert (fault.kind, fault.evidence["axis"]) == ("quantised coordinates", 2)
    assert fault.evidence["spacing"] == 2**-24


def test_a_few_double_values_do_not_hide_among_coarse_ones() -> None:
    points = independent(2, 32, 1, stream(22)).astype(np.float32).astype(np.float64)
    points[0, 0, 0] += 2.0**-40
    assert find_faults(points) == []


def test_a_centred_grid_is_quantised_in_a_single_realisation() -> None:
    """Each axis of the 16 points takes four values only."""
    (one, two) = find_faults(grid(16, 2)[None] + 1 / 8)
    assert (one.evidence["axis"], two.evidence["axis"]) == (1, 2)
    assert "values of spacing 2^-3" in one.detail


def test_stratum_centres_are_quantised() -> None:
    """From two realisations on, although 49 is no decimal and no power of two."""
    for R in (2, 30):
        found = of_kind(
            find_faults(centred_latin_hypercube(R, 49, 2, stream(24, R))), "quantised coordinates"
        )
        assert [fault.evidence["axis"] for fault in found] == [1, 2]
        assert found[0].evidence["distinct"] == 49
        assert found[0].evidence["draws"] == 49 * R
        assert found[0].evidence["spacing"] == pytest.approx(1 / 49)


def test_n_rooks_without_jitter_is_biased() -> None:
    """The defect in the wild: variance 0 for f = x, bias 1/(2N)."""
    found = of_kind(find_faults(centred_latin_hypercube(40, 64, 2, stream(25))), "bias")
    assert len(found) == 2
    assert found[0].detail.startswith(
        "axis 1: E exp(-2 pi i 64 x) = -1.000 (must be 0 for uniform marginals); "
        "points sit at fixed places of 64 cells; jitter inside the strata, or shift"
    )
    (coefficient,) = found[0].evidence["coefficients"]
    assert coefficient["frequency"] == 64
    assert coefficient["real"] == pytest.approx(-1)


def test_power_at_stratum_centres_is_29_realisations() -> None:
    """As the docstring of `find_faults` states; the coefficient is -1 every time."""
    points = centred_latin_hypercube(29, 64, 2, stream(26))
    assert len(of_kind(find_faults(points), "bias")) == 2
    assert not of_kind(find_faults(points[:28]), "bias")


def test_cells_reveal_half_jitter() -> None:
    """Jitter over half of each cell: E exp(-2 pi i 9 x) = -2i/pi, seen at the cells given."""
    R, N = 150, 81
    points = grid(N, 2) + stream(27).random((R, N, 2)) / 18
    found = of_kind(find_faults(points, cells=(9,)), "bias")
    assert [fault.evidence["axis"] for fault in found] == [1, 2]
    assert all("points prefer fixed places of 9 cells" in fault.detail for fault in found)
    assert all(f["frequency"] == 9 for fault in found for f in fault.evidence["coefficients"])
    coefficients = [fault.evidence["coefficients"][0]["imaginary"] for fault in found]
    assert coefficients == pytest.approx([-2 / np.pi] * 2, abs=0.02)


def test_a_sloping_density_is_biased_on_its_axis_only() -> None:
    points = independent(400, 64, 2, stream(28))
    points[:, :, 1] **= 1.5
    (fault,) = find_faults(points)
    assert fault.evidence["axis"] == 2
    assert "E exp(-2 pi i 1 x)" in fault.detail
    assert "the density along the axis is not uniform" in fault.detail


def test_a_deterministic_sampler_is_duplicate_and_biased() -> None:
    points = np.broadcast_to(grid(64, 2) + 0.5 / 8, (40, 64, 2))
    faults = find_faults(points, cells=(8,))
    assert faults[0].kind == "duplicate realisations"
    assert of_kind(faults, "bias")
    random = np.broadcast_to(stream(29).random((64, 2)), (3, 64, 2))
    assert [fault.kind for fault in find_faults(random)] == ["duplicate realisations"]


@pytest.mark.parametrize("R", [1, 2, 5, 10])
def test_capital_of_a_fair_coin_has_expectation_one(R: int) -> None:
    """Exact, over all sequences: so the level of the test holds by Markov's inequality."""
    sequences = np.array(list(itertools.product([-1.0, 1.0], repeat=R))).T
    assert np.exp(_log_capital(sequences)).mean() == pytest.approx(1, rel=1e-12)


@settings(deadline=None)
@given(
    low=st.floats(-1, -1e-9),
    high=st.floats(1e-9, 1),
    R=st.integers(1, 6),
)
def test_capital_of_any_two_values_of_mean_zero(low: float, high: float, R: int) -> None:
    """Exact, over all sequences of a variable in [-1, 1] with two values and mean 0."""
    chance = np.array([high, -low]) / (high - low)
    sequences = np.array(list(itertools.product([0, 1], repeat=R))).T
    capital = np.exp(_log_capital(np.array([low, high])[sequences]))
    assert np.sum(capital * chance[sequences].prod(axis=0)) == pytest.approx(1, rel=1e-9)


def test_no_valid_test_needs_fewer_than_24() -> None:
    """A fair coin shows ±1 in every one of R realisations with probability 2^(1 - R)."""
    tests = 2 * 4 * 2  # cosine and sine, k = 1, 2, 3, N, two axes
    assert BIAS_LEVEL / tests < 2.0 ** (1 - 23)
    needed = math.log(14 * tests / BIAS_LEVEL) / math.log(1.98)
    assert math.ceil(needed) == 29
