"""Measurements at one N: growth in chunks, the same numbers whatever the rounds, deadlines."""

import time

import numpy as np
import pytest
from specrate.numerics.catalogue_source import CatalogueSource, chunk_size, counts_of, open_source
from specrate.numerics.measurements import Measurement, grow, kept_points, power_interval, scaled
from specrate.numerics.moments import Interval
from specrate.numerics.probes import probe
from specrate.numerics.sources import CallableSource, SamplerFault
from specrate.theory.errors import InputError
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


def test_a_slow_sampler_is_left_at_the_deadline():
    def slow(n, dim, rng):
        time.sleep(0.02)
        return rng.random((n, dim))

    found, began = fresh(), time.perf_counter()
    grow(found, of(slow), 0, 1000, deadline=began + 0.1)
    assert time.perf_counter() - began < 1
    assert 1 <= found.replicates == found.attempted <= 6
    assert len(kept_points(found)) == found.replicates


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


@pytest.mark.parametrize(
    ("n", "size"), [(2, 64), (16384, 64), (16385, 32), (1 << 20, 1), (1 << 22, 1)]
)
def test_chunks_are_powers_of_two_and_fit_the_memory(n, size):
    assert chunk_size(n) == size


def test_chunks_of_a_catalogue_source_are_whole():
    source = CatalogueSource(parse_sampler("jitter", 2))
    assert (source.name, source.dim, source.admissible(50)) == ("jitter", 2, 49)
    with pytest.raises(InputError, match="in chunks of 64"):
        source.realise(16, 0, range(1, 2))
    assert source.realise(16, 0, range(64, 70)).shape == (6, 16, 2)
    with pytest.raises(InputError, match="must have points to draw: got 'isotropic:2'"):
        counts_of(parse_sampler("isotropic:2", 2), 16)
    with pytest.raises(InputError, match="must have points to draw"):
        open_source(["isotropic:2"], 2)


def test_intervals():
    found = fresh()
    grow(found, CatalogueSource(parse_sampler("random", 2)), 1, 512)
    interval = power_interval(found, (1, 1), 1e-9)  # false alarm 1e-9
    assert interval.low < 1 / 16 < interval.high
    assert scaled(interval, 16) == Interval(*(16 * v for v in interval))
