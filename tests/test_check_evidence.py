"""Rows of evidence: orders that theory gives integrands, and what one realisation leaves open."""

from types import SimpleNamespace

import pytest
from specrate.numerics.checking.check_evidence import points, predicted_order, rates, regions
from specrate.numerics.checking.designs import design
from specrate.numerics.checking.judgements import State, judgements
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.measuring.measurements import Measurement, grow, homogenise
from specrate.numerics.measuring.probes import probe
from specrate.numerics.point_sources.catalogue_source import CatalogueSource
from specrate.numerics.point_sources.child_processes import Limits
from specrate.theory.samplers import parse_sampler


def state_of(claims, replicates):
    """Random points at N = 16, probed at two frequencies by one integrand."""
    state = State(design(["random"], 2, claims, [], 0), 1e-6, [], (), 10.0, Limits())
    state.measurements.append(Measurement(16, ((1, 0), (1, 1)), (probe(2, 1, (1,)),)))
    grow(state.measurements[0], CatalogueSource(parse_sampler("random", 2)), 0, replicates)
    return state


@pytest.mark.parametrize(
    ("name", "text", "exponent"),
    [
        ("jitter", "disk", "3/2"),
        ("latin-hypercube", "gaussian", "1"),
        ("latin-hypercube", "bernoulli:k=6", "3"),
        ("multi-jitter", "bernoulli:k=1,axes=(1,2)", "3/2"),
        ("random", "box:side=0.3", "1"),
        ("latin-hypercube", "half-space:side=0.3", "2"),
        ("jitter", "ridge:k=(1,1)", "2"),
        ("latin-hypercube", "ridge:k=(1,1)", "1"),
    ],
)
def test_predicted_orders(name, text, exponent):
    order = predicted_order(parse_sampler(name, 2), parse_integrand(text, 2))
    assert str(order.exponent) == exponent


def test_integrands_of_no_class_have_no_predicted_order():
    unknown = SimpleNamespace(name="teapot", support=())
    assert predicted_order(parse_sampler("jitter", 2), unknown) is None


def test_rows_of_a_region_are_those_of_its_support():
    state = state_of(["random"], 128)
    state.spectra["random"] = {16: {(1, 0): 1 / 16, (1, 1): 1 / 16}}
    state.variances["random"] = {16: {}}
    found = {g["region"]: g["spectrum"] for g in regions(state, judgements(state))}
    assert [row["frequency"] for row in found["1"]] == [[1, 0]]
    assert [row["frequency"] for row in found["1,2"]] == [[1, 1]]
    assert found["2"] == []
    row = found["1"][0]
    assert (row["n"], row["predicted"], row["agrees"]) == (16, "1", True)
    assert row["scaled_power"]["low"] < 1 < row["scaled_power"]["high"]  # miss: 5 % but for seed


def test_without_a_claim_nothing_is_predicted():
    state = state_of([], 128)
    (row,) = regions(state, [])[0]["spectrum"]
    assert row["predicted"] is row["agrees"] is None
    assert rates(state, [])[0]["predicted"] == {"exponent": None, "log_power": None}


def test_one_realisation_has_no_interval():
    state = state_of(["random"], 1)
    (m,) = state.measurements
    assert points(state) == []
    homogenise(m, 0, 256)
    m.distinct = 1
    (point,) = points(state)
    assert (point["replicates"], point["realisations"]) == (256, 1)
    assert point["raw_variance"] is point["raw_mse"] is point["bias"] is None
    assert point["variance"]["low"] > 0
    (row,) = regions(state, judgements(state))[0]["spectrum"]
    assert row["scaled_power"] == {
        "estimate": pytest.approx(16 * m.power[1, 0].mse),
        "low": 0.0,
        "high": None,
    }
    assert row["agrees"] is None
