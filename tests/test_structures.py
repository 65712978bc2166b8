"""Blocks and oblique strata are found without a claim, and none where there are none.

All points come from fixed streams. What is said of false alarms and power holds over seeds.
"""

import json
from math import pi

import numpy as np
import pytest
from scipy.stats import qmc
from specrate.numerics.checking.structures import (
    as_rows,
    disagreements,
    find_structures,
    scans_of,
    structures_in,
)
from specrate.numerics.generators import generate
from specrate.numerics.measuring.measurements import Measurement, grow
from specrate.numerics.measuring.probes import frequencies
from specrate.numerics.measuring.white_noise import scan
from specrate.numerics.point_sources.catalogue_source import open_source
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler


def drawn(name, dim, n, realisations, seed=0):
    sampler = parse_sampler(name, dim)
    return generate(sampler, sampler.counts_at(n), realisations, stream(90, seed, n))


def sheared(points, source, target):
    moved = points.copy()
    moved[:, :, target] += moved[:, :, source]
    return moved % 1.0


def triple(realisations, n, dim, axes, seed=0):
    """{x_a + x_b + x_c} in n strata, all pairs and the other coordinates independent."""
    rng = stream(91, seed)
    points = rng.random((realisations, n, dim))
    a, b, c = axes
    sums = (np.arange(n) + rng.random((realisations, n))) / n
    points[:, :, c] = (sums - points[:, :, a] - points[:, :, b]) % 1.0
    return points


def turned(realisations, width, seed=0):
    """A lattice of 65 square cells along (8, 1) and (−1, 8), a point in the middle of each."""
    rng, n = stream(92, seed), 65
    centres = np.stack([np.arange(n), np.arange(n) * pow(8, -1, n) % n], axis=1) / n
    moves = width * (rng.random((realisations, n, 2)) - 0.5) @ (np.array([[8, 1], [-1, 8]]) / n)
    return (centres + moves + rng.random((realisations, 1, 2))) % 1.0


@pytest.mark.parametrize(
    ("n", "realisations"), [(64, 128), (729, 64), (4096, 32)], ids=["64", "729", "4096"]
)
def test_blocks_of_uncorrelated_jitter_under_a_permutation(n, realisations):
    """Within blocks N P_S(1, 1) <= 0.34, less than the threshold by 3 standard errors or more."""
    order = stream(93).permutation(10)
    place = {int(old): new + 1 for new, old in enumerate(order)}
    points = drawn("uncorrelated-jitter:2+2+3+3", 10, n, realisations)[:, :, order]
    found = find_structures([points])
    blocks = [(0, 1), (2, 3), (4, 5, 6), (7, 8, 9)]
    assert found.blocks == tuple(sorted(tuple(sorted(place[i] for i in b)) for b in blocks))
    assert found.oblique == ()
    assert "would be seen" in found.why


def test_blocks_from_several_numbers_of_points():
    points = [drawn("uncorrelated-jitter:1+2", 3, n, 64) for n in (25, 64)]
    found = find_structures(points)
    assert found.blocks == ((1,), (2, 3))
    assert {d.n for d in found.less} == {25, 64}
    assert found.scanned == 2 * (21**3 // 2)


@pytest.mark.parametrize(
    ("dim", "n", "axes"), [(3, 64, (0, 1, 2)), (10, 64, (0, 1, 2)), (10, 729, (1, 4, 8))]
)
def test_a_planted_triple(dim, n, axes):
    """All pairs are white noise; at (1, 1, 1) the power is (π/N)²/3, the threshold some 0.4."""
    found = find_structures([triple(64, n, dim, axes)])
    assert found.blocks is not None
    assert tuple(i + 1 for i in axes) in found.blocks
    assert len(found.blocks) == dim - 2
    first = found.oblique[0]
    assert first.frequency == tuple(int(i in axes) for i in range(dim))
    assert first.power.estimate == pytest.approx((pi / n) ** 2 / 3, rel=0.8)
    assert "more at the mirror image" in first.what
    assert all(len({k for k in d.frequency if k}) == 1 for d in found.less)


def test_a_triple_with_signs():
    points = triple(64, 64, 5, (0, 1, 2))
    points[:, :, 1] = (1 - points[:, :, 1]) % 1.0
    assert [d.frequency for d in find_structures([points]).oblique] == [(1, -1, 1, 0, 0)]


@pytest.mark.parametrize(("dim", "n"), [(2, 64), (4, 256)])
def test_a_shear_is_oblique_and_jitter_is_not(dim, n):
    """{x_2 + x_1}: at (1, −1) the power is that of an axis, at (1, 1) that of (2, 1)."""
    points = drawn("jitter", dim, n, 256)
    straight, found = find_structures([points]), find_structures([sheared(points, 0, 1)])
    assert straight.blocks == found.blocks == (tuple(range(1, dim + 1)),)
    assert straight.oblique == ()
    first = found.oblique[0]
    assert first.frequency == (1, -1) + (0,) * (dim - 2)
    assert first.power.low <= 1 - np.sinc(n ** (-1 / dim)) ** 2 <= first.power.high
    assert first.what.startswith("less power than white noise, and more at the mirror image (1, 1")


def test_a_turned_lattice_is_oblique():
    """Cells half filled have their peaks, N P_S = 27, at (8, 1) and (1, −8) alone."""
    found = find_structures([turned(64, 0.5)])
    peaks = {d.frequency for d in found.oblique if d.what.startswith("more")}
    assert {(8, 1), (1, -8)} <= peaks
    assert not {(8, -1), (1, 8)} & peaks


def test_strata_along_a_diagonal_alone():
    """{x_1 − x_2} stratified, both axes white noise."""
    rng, n = stream(94), 64
    points = rng.random((64, n, 2))
    points[:, :, 1] = (points[:, :, 0] + (np.arange(n) + rng.random((64, n))) / n) % 1.0
    found = find_structures([points])
    assert found.blocks == ((1, 2),)
    assert found.oblique[0].frequency == (1, -1)
    assert {d.frequency for d in found.less} == {(k, -k) for k in range(1, 17)}


@pytest.mark.parametrize(("dim", "n"), [(2, 64), (3, 64), (10, 64), (10, 729)])
def test_latin_hypercubes_are_blocks_of_one_coordinate(dim, n):
    """Two axes have N P_S = 1 + 1/(N − 1) at most: no less than white noise."""
    found = find_structures([drawn("latin-hypercube", dim, n, 64)])
    assert found.blocks == tuple((i,) for i in range(1, dim + 1))
    assert found.oblique == ()
    assert all(sum(k != 0 for k in d.frequency) == 1 for d in found.less)


@pytest.mark.parametrize("name", ["jitter", "multi-jitter", "regular"])
@pytest.mark.parametrize(("dim", "n"), [(2, 64), (3, 64)])
def test_one_block_along_the_axes(name, dim, n):
    found = find_structures([drawn(name, dim, n, 64)])
    assert found.blocks == (tuple(range(1, dim + 1)),)
    assert found.oblique == ()


@pytest.mark.parametrize(("dim", "n"), [(1, 16), (2, 16), (3, 64), (10, 64), (10, 729)])
@pytest.mark.parametrize("realisations", [2, 64])
def test_white_noise_has_no_structure(dim, n, realisations):
    """False alarm at most 1e-9."""
    found = find_structures([stream(95, dim, n).random((realisations, n, dim))], level=1e-9)
    assert found.blocks is None
    assert "no frequency" in found.why
    assert found.less == found.more == found.oblique == ()


def test_coarse_strata_are_not_taken_for_independent():
    """2^5 strata: N P_S is 0.59 on the axes, which is seen, and 0.84 on pairs, which is not."""
    found = find_structures([drawn("jitter", 5, 32, 256)])
    assert {sum(map(abs, d.frequency)) for d in found.less} == {1}
    assert found.blocks is None
    assert "could not be seen" in found.why
    assert find_structures([drawn("jitter", 5, 32, 4096)]).blocks == ((1, 2, 3, 4, 5),)


def test_too_few_realisations_give_no_blocks():
    found = find_structures([drawn("latin-hypercube", 4, 16, 8)])
    assert found.less
    assert found.blocks is None
    assert "too few points" in found.why


def test_clumps_join_nothing():
    """Axis 2 holds one value in a realisation: N P_S(m_1, m_2) = N P_S(m_1), by no joint strata."""
    points = drawn("latin-hypercube", 2, 64, 64)
    points[:, :, 1] = stream(96).random((64, 1))
    found = find_structures([points])
    assert any(sum(k != 0 for k in d.frequency) == 2 for d in found.less)
    assert found.blocks == ((1,), (2,))
    assert found.oblique == ()


@pytest.mark.parametrize(("dim", "n"), [(2, 64), (10, 256)])
def test_scrambled_nets_are_one_block(dim, n):
    points = np.stack([qmc.Sobol(dim, rng=seed).random(n) for seed in range(64)])
    found = find_structures([points])
    assert found.blocks == (tuple(range(1, dim + 1)),)
    assert found.oblique == ()
    assert found.more


def wrong_at_7_and_11(realisations, n):
    """White noise in d = 2 but for {7 x_1 − 11 x_2}, which is stratified."""
    rng = stream(97)
    x = rng.random((realisations, n))
    strata = (np.arange(n) + rng.random((realisations, n))) / n
    y = (7 * x - strata + rng.integers(0, 11, (realisations, n))) / 11
    return np.stack([x, y % 1.0], axis=2)


def test_a_spectrum_wrong_at_one_high_frequency_disagrees():
    """N P_S(7, −11) = 0.01 where 1 is claimed, at a frequency that no probe has."""
    points = wrong_at_7_and_11(128, 64)
    assert {(7, -11), (-7, 11)}.isdisjoint(frequencies(64, 2))
    (found,) = disagreements(scan(points, 1e-6), parse_sampler("random", 2))
    assert (found.at, found.n, found.outcome) == ((7, -11), 64, "fails")
    assert found.predicted == pytest.approx(1 / 64)
    assert found.measured.estimate == pytest.approx((pi / 64) ** 2 / 3 / 64, rel=0.5)
    assert [d.frequency for d in find_structures([points]).oblique] == [(7, -11)]


@pytest.mark.parametrize(
    ("name", "dim", "n"),
    [
        ("random", 2, 64),
        ("jitter", 3, 64),
        ("regular", 2, 64),
        ("multi-jitter", 2, 64),
        ("correlated-multi-jitter", 2, 64),
        ("latin-hypercube", 10, 64),
        ("uncorrelated-jitter:1+2", 3, 64),
    ],
)
def test_true_claims_agree(name, dim, n):
    """About 1e-6 each; a claim of another sampler disagrees."""
    found = scan(drawn(name, dim, n, 128), 1e-6)
    assert disagreements(found, parse_sampler(name, dim)) == ()
    other = "jitter:8x8" if name == "random" else "random"
    assert disagreements(found, parse_sampler(other, dim))


def test_few_realisations_and_other_counts_disagree_with_nothing():
    points = drawn("jitter", 2, 64, 127)
    assert disagreements(scan(points, 1e-6), parse_sampler("random", 2)) == ()
    assert disagreements(scan(drawn("random", 2, 60, 128), 1e-6), parse_sampler("jitter", 2)) == ()


def test_what_a_check_has_kept_is_scanned():
    """All but single realisations and N with one; as many of them as make 2^17 points."""
    source = open_source(["uncorrelated-jitter:1+2"], 3)
    kept = [Measurement(n, (), ()) for n in (25, 64, 4096)]
    for measurement, count in zip(kept, (128, 1, 48), strict=True):
        grow(measurement, source, 1, count)
    first, last = found = scans_of(kept)
    assert (first.n, first.realisations) == (25, 128)
    assert (last.n, last.realisations) == (4096, 32)
    assert structures_in(found).blocks == ((1,), (2, 3))
    assert scans_of(kept[1:2]) == ()


def test_the_same_points_give_the_same_rows():
    points = triple(64, 64, 10, (1, 4, 8))
    first, again = (json.dumps(as_rows(find_structures([points]))) for _ in range(2))
    assert first == again
    (row,) = json.loads(first)
    assert row["frequency"] == [0, 1, 0, 0, 1, 0, 0, 0, 1, 0]
    assert set(row["scaled_power"]) == {"estimate", "low", "high"}
    assert row["n"] == 64


@pytest.mark.parametrize("shapes", [[], [(4, 8, 2), (4, 8, 3)], [(1, 8, 2)], [(8, 2)]])
def test_nothing_to_scan(shapes):
    with pytest.raises(InputError):
        find_structures([np.zeros(s) for s in shapes])
