"""The plateau γ is the limit of the supremum of N·P_S, and no typed-in number."""

import numpy as np
import pytest
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.theory.decays import parse_decay
from specrate.theory.plateaus import plateau
from specrate.theory.rates import region_rates, saturated
from specrate.theory.regions import regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol

SYMBOLIC = ["random", "jitter", "latin-hypercube", "multi-jitter", "uncorrelated-jitter:1+2+(d-3)"]


@pytest.mark.parametrize("name", SYMBOLIC)
def test_plateau_in_symbolic_dimensions_is_one(name: str) -> None:
    sampler = parse_sampler(name, symbol("d"))
    assert {plateau(sampler, r) for r in regions(sampler.layout)} == {1}


@pytest.mark.parametrize(
    "name",
    ["jitter", "latin-hypercube", "multi-jitter", "multi-jitter:2x1", "uncorrelated-jitter:1+1"],
)
def test_plateau_is_the_limit_of_the_supremum(name: str) -> None:
    """The largest N·P_S on a grid up to 2N approaches γ = 1 from above like 1/n, or is 1."""
    sampler = parse_sampler(name, 2)
    assert sampler.counts_at is not None
    excess = []
    for n in (16, 64, 256):
        counts = sampler.counts_at(n)
        side = np.unique(np.concatenate([np.arange(40), np.arange(0, 2 * n, max(1, n // 16))]))
        m = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)[1:]
        top = counts["N"] * power_array(sampler, counts, m).max()
        excess.append(top - 1)
        assert top >= 1 - 1e-9
    assert excess[0] >= excess[1] - 1e-9 >= excess[2] - 2e-9
    assert excess[2] < 0.2


def test_multi_jitter_of_9_points_exceeds_random_by_a_quarter() -> None:
    """sup N·P_S = 1.234 at n = 3: the plateau is a limit, not the supremum at every N."""
    sampler = parse_sampler("multi-jitter", 2)
    assert sampler.counts_at is not None
    m = np.stack(np.meshgrid(np.arange(40), np.arange(40)), axis=-1).reshape(-1, 2)[1:]
    assert 9 * power_array(sampler, sampler.counts_at(9), m).max() == pytest.approx(1.234, abs=5e-3)


@pytest.mark.parametrize("name", ["box-dpp", "cloaked:1/2", "cloaked:2"])
def test_plateau_of_other_shapes_is_the_supremum(name: str) -> None:
    sampler = parse_sampler(name, symbol("d"))
    assert {plateau(sampler, r) for r in regions(sampler.layout)} == {1}
    m = np.stack(np.meshgrid(np.arange(80), np.arange(80)), axis=-1).reshape(-1, 2)[1:]
    flat = parse_sampler(name, 2)
    assert flat.counts_at is not None
    top = 256 * power_array(flat, flat.counts_at(256), m).max()
    assert 0.999 < top <= 1 + 1e-12


def test_plateau_of_difference_jitter_is_a_limit() -> None:
    """N·P_S reaches 1.1661 next to N/2, less than 7/6, and tends to 1 beyond N."""
    sampler = parse_sampler("difference-jitter", 1)
    assert {plateau(sampler, r) for r in regions(sampler.layout)} == {1}
    m = np.arange(1, 400_000)[:, None]
    scaled = 1000 * power_array(sampler, {"N": 1000}, m)
    assert scaled.max() == pytest.approx(1.1661457, abs=1e-5)
    assert m[scaled.argmax(), 0] == pytest.approx(512.5, abs=1)
    assert scaled[-1000:] == pytest.approx(1, abs=1e-6)


def test_comb_alone_has_no_plateau_of_its_own() -> None:
    sampler = parse_sampler("regular", 2)
    assert {plateau(sampler, r) for r in regions(sampler.layout)} == {0}


def test_saturated_fills_the_plateau_in() -> None:
    sampler = parse_sampler("correlated-multi-jitter", 2)
    for rate in region_rates(sampler, parse_decay("worst")):
        assert all(m.plateau == 1 for m in saturated(sampler, rate))
