"""Measurements at one N: growth in chunks, the same numbers whatever the rounds, deadlines."""

import numpy as np
import pytest
from specrate.numerics.measuring.measurements import (
    Measurement,
    grow,
    homogenise,
    kept_amplitudes,
    kept_points,
    power_interval,
    scaled,
)
from specrate.numerics.measuring.moments import Interval
from specrate.numerics.measuring.probes import amplitudes, probe
from specrate.numerics.point_sources.catalogue_source import CatalogueSource, open_source
from specrate.numerics.point_sources.child_processes import OutOfTime
from specrate.numerics.point_sources.realisations import SamplerFault
from specrate.numerics.point_sources.sources import CallableSource
from specrate.numerics.streams import stream
from specrate.theory.samplers import parse_sampler

FREQUENCIES = ((1, 0), (1, 1))
INTEGRANDS = (probe(2, 1, (1,)), probe(2, 2, (1, 2)))


def fresh(n=16):
    return Measurement(n, FREQUENCIES, INTEGRANDS)


def of(function):
    return CallableSource("test", function, 2)


def points(n, dim, rng):
    return rng.random((n, dim))


@pytest.mark.parametrize("source", [CatalogueSource(parse_sampler("jitter", 2)), of(points)])
def test_rounds_do_not_change_the_numbers(source):
    once, rounds = fresh(), fresh()
    grow(once, source, 5, 200)
    for target in (64, 100, 128, 200)[:: 1 if source.kind == "callable" else 2]:
        grow(rounds, source, 5, target if source.kind == "callable" else target // 64 * 64 or 64)
    grow(rounds, source, 5, 200)
    assert once.replicates == rounds.replicates == once.attempted == 200
    for name, moments in once.shifted.items():
        assert rounds.shifted[name].count == moments.count == 200
        if source.kind == "catalogue":
            assert rounds.shifted[name] == moments
    assert rounds.power[1, 1].mse == pytest.approx(once.power[1, 1].mse, rel=1e-12)


def test_spectra_are_of_raw_points_and_variances_of_shifted_ones():
    """Points that are all at the origin: |F|^2 = 1; f(0) raw, E f^2 shifted (chance 1e-7)."""
    found = fresh()
    grow(found, of(lambda n, dim, rng: np.zeros((n, dim))), 6, 2000)
    assert found.power[1, 0].mse == pytest.approx(1)
    assert found.raw["bernoulli:k=1"].mean == pytest.approx(-0.5)
    shifted = found.shifted["bernoulli:k=1"]
    assert abs(shifted.mse - 1 / 12) < 5.5 * shifted.mse_error


def test_files_end_where_they_end(tmp_path):
    (tmp_path / "a.txt").write_text("\n#\n".join(["0.1 0.2\n0.3 0.4"] * 3) + "\n")
    found = fresh(2)
    grow(found, open_source([str(tmp_path / "a.txt")], 2), 0, 128)
    assert found.replicates == 3


class Sleeper:
    """Gives a realisation less than it is asked for, as a child does at its deadline."""

    realisations = None

    def __init__(self, given):
        self.given = given

    def realise(self, n, seed, replicates):
        chunk = len(replicates) - 1 if self.given > 64 else self.given
        self.given -= chunk
        return stream(seed, n, replicates.start).random((chunk, n, 2))


def test_a_chunk_cut_short_is_followed_by_the_rest():
    found = fresh()
    grow(found, Sleeper(70), 0, 70)
    assert found.replicates == found.attempted == found.shifts == 70
    assert [len(k) for k in found.kept] == [63, 7]
    assert found.shifted["bernoulli:k=1"].count == 70


def test_no_chunk_is_begun_after_the_deadline():
    found = fresh()
    grow(found, CatalogueSource(parse_sampler("random", 2)), 0, 1000, deadline=0.0)
    assert found.replicates == found.attempted == 64


def test_chunks_may_be_of_any_length_and_are_written_down():
    lengths = iter([2, 5, 64, 64])
    found = fresh()
    grow(found, CatalogueSource(parse_sampler("random", 2)), 3, 100, length=lambda m: next(lengths))
    assert found.chunks == [2, 5, 64, 29]
    assert found.replicates == found.attempted == found.shifts == 100
    points = kept_points(found)
    assert len(np.unique(points[:, 0, 0])) == 100  # no two chunks have one stream
    again = fresh()
    lengths = iter(found.chunks)
    grow(again, CatalogueSource(parse_sampler("random", 2)), 3, 100, length=lambda m: next(lengths))
    assert again.power == found.power
    assert again.shifted == found.shifted


def test_replicates_of_a_callable_follow_on_whatever_the_chunks():
    whole, parts = fresh(), fresh()
    lengths = iter([1, 2, 64])
    grow(whole, of(points), 5, 60)
    grow(parts, of(points), 5, 60, length=lambda m: next(lengths))
    np.testing.assert_array_equal(kept_points(parts), kept_points(whole))


def test_where_no_chunk_is_to_be_begun_none_is():
    found = fresh()
    grow(found, of(points), 0, 10, length=lambda m: 0)
    assert (found.replicates, found.attempted, found.cost) == (0, 0, None)


def test_out_of_time_leaves_what_was_measured():
    class Late(Sleeper):
        def realise(self, n, seed, replicates):
            if replicates.start:
                raise OutOfTime("late", {"seconds": 1.0, "drawn": 64})
            return super().realise(n, seed, replicates)

    found = fresh()
    with pytest.raises(OutOfTime):
        grow(found, Late(64), 0, 1000)
    assert (found.replicates, found.attempted) == (64, 128)


def test_shifts_of_one_point_set_tell_its_own_variance(tmp_path):
    """Σ |F|² |f^|², by direct sums; 4096 shifts are within 6 standard errors (chance 2e-9)."""
    points = stream(8).random((3, 2))
    (tmp_path / "a.txt").write_text("\n".join(f"{x:.17g} {y:.17g}" for x, y in points))
    found = fresh(3)
    grow(found, open_source([str(tmp_path / "a.txt")], 2), 0, 128)
    assert (found.replicates, found.shifts, found.is_frozen) == (1, 1, False)
    homogenise(found, 0, 4096)
    found.distinct = 1
    assert (found.replicates, found.shifts, found.is_frozen) == (1, 4096, True)
    assert found.raw["bernoulli:k=1"].count == found.power[1, 0].count == 1
    k = np.arange(1, 200_001)
    power = abs(np.exp(-2j * np.pi * np.outer(points[:, 0], k)).mean(axis=0)) ** 2
    exact = 2 * np.sum(power / (2 * np.pi * k) ** 2)  # the rest is below 3e-7
    measured = found.shifted["bernoulli:k=1"]
    assert abs(measured.mse - exact) < 6 * measured.mse_error + 3e-7


def test_shifts_are_the_same_whatever_the_rounds(tmp_path):
    (tmp_path / "a.txt").write_text("0.1 0.2\n0.3 0.4\n")
    source = open_source([str(tmp_path / "a.txt")], 2)
    once, late = fresh(2), fresh(2)
    for measurement in (once, late):
        grow(measurement, source, 4, 1)
    homogenise(once, 4, 200)
    for _ in range(4):
        homogenise(late, 4, 200, deadline=0.0)  # one chunk at a time
    assert late.shifts == 200
    assert late.shifted == once.shifted


def test_a_fault_leaves_what_was_measured():
    def failing(n, dim, rng):
        if rng.random() < 0.01:
            raise RuntimeError("no luck")
        return rng.random((n, dim))

    found = fresh()
    with pytest.raises(SamplerFault):
        grow(found, of(failing), 0, 10_000)
    assert found.replicates % 64 == 0
    assert found.attempted == found.replicates + 64
    assert found.shifted["bernoulli:k=1"].count == found.replicates


def test_few_realisations_are_kept():
    found = fresh()
    grow(found, CatalogueSource(parse_sampler("random", 2)), 0, 1024)
    assert kept_points(found).shape == (128, 16, 2)


def test_amplitudes_of_the_same_realisations_are_kept():
    found = fresh()
    grow(found, CatalogueSource(parse_sampler("random", 2)), 0, 256)
    kept, points = kept_amplitudes(found), kept_points(found)
    assert tuple(kept) == FREQUENCIES
    np.testing.assert_allclose(kept[1, 1], amplitudes(points, [(1, 1)])[0], rtol=0, atol=1e-15)
    none = Measurement(16, (), INTEGRANDS)
    grow(none, CatalogueSource(parse_sampler("random", 2)), 0, 64)
    assert kept_amplitudes(none) == {}


def test_intervals():
    found = fresh()
    grow(found, CatalogueSource(parse_sampler("random", 2)), 1, 512)
    interval = power_interval(found, (1, 1), 1e-9)  # false alarm 1e-9
    assert interval.low < 1 / 16 < interval.high
    assert scaled(interval, 16) == Interval(*(16 * v for v in interval))
