"""Fitted profiles in the document of a check: rows of regions and rates, and what is left out."""

import json

import pytest
from specrate.numerics.checking.check_documents import check, document
from specrate.numerics.checking.checks import Execution, Step, run_check
from specrate.numerics.checking.fit_evidence import with_profiles
from specrate.numerics.checking.fitted_profiles import FittedRegion
from specrate.numerics.fitting.profile_fits import ProfileFit
from specrate.numerics.measuring.moments import Interval
from specrate.theory.decays import parse_decay
from specrate.theory.rates import order_on
from specrate.theory.samplers import parse_sampler

PARAMETERS = {"degree", "effective", "gamma", "alpha"}


def executed(word, dim, claims, counts, fitted, replicates=128, ended="decided"):
    """The document of a check that executes so many realisations and fits."""
    steps = tuple(Step(n, replicates, replicates, replicates) for n in counts)
    return document(
        run_check([word], dim, claims, again=Execution(steps, ended, fitted=fitted))
    )  # fmt: skip


def told(found):
    return {x["what"]: x["why"] for x in found["left_out"]}


@pytest.fixture(scope="module")
def jitter():
    return executed("jitter", 2, ["jitter"], [16, 100, 256], 3)


def test_every_region_has_its_profile(jitter):
    assert [r["region"] for r in jitter["regions"]] == ["1", "2", "1,2"]
    for region in jitter["regions"]:
        (monomial,) = region["profile"]
        assert set(monomial) == PARAMETERS
        assert monomial["degree"]["low"] <= monomial["degree"]["estimate"]
        assert region["outside_model"] is None
    assert not any(what.startswith("fitted profile") for what in told(jitter))
    assert jitter["plan"]["fitted"] == 3


def test_rates_stand_beside_measured_slopes_and_say_what_they_rest_on(jitter):
    rates = {(r["integrand"], r["region"]): r for r in jitter["rates"]}
    measured = rates["bernoulli:k=1", "1"]
    assert measured["measured"]["slope"] is not None
    assert measured["fitted"]["rests_on"] == "profiles fitted on 1 at N = 16, 100, 256"
    for family, exponent in (("worst", "3/2"), ("best", "2")):
        for region in ("1", "2", "1,2", "overall"):
            row = rates[family, region]
            assert row["predicted"] == {"exponent": exponent, "log_power": "0"}
            assert row["measured"] == {"slope": None, "local_slopes": []}
            assert row["agrees"] is None
            assert row["fitted"]["exponent"]["low"] >= 1
    assert rates["worst", "overall"]["fitted"]["rests_on"].startswith(
        "profiles fitted on 1; 2; 1,2"
    )


def test_without_a_claimed_sampler_rates_are_predicted_all_the_same():
    """The worst class falls as N^-3/2; four half widths of 95 % are 7.8 standard deviations."""
    found = executed("jitter", 2, ["overall/disk ~ 3/2"], [16, 64, 256], 3)
    assert [(r["region"], r["spectrum"]) for r in found["regions"]] == [
        (name, []) for name in ("1", "2", "1,2")
    ]
    rates = {(r["integrand"], r["region"]): r for r in found["rates"]}
    disk = rates["disk:radius=0.3", "overall"]["fitted"]["exponent"]
    assert abs(disk["estimate"] - 1.5) < 2 * (disk["high"] - disk["low"])
    assert rates["worst", "overall"]["predicted"]["exponent"] is None


def test_a_fit_contradicts_nothing():
    """The spectrum of a Latin hypercube fits itself; the verdict is that of the exact tests."""
    with_fits, without = (executed("jitter", 1, ["jitter"], [16, 64], k) for k in (1, 0))
    for key in ("verdict", "claims", "matches", "points", "level"):
        assert (
            json.dumps(with_fits[key]).split('"seconds"')[0]
            == json.dumps(without[key]).split('"seconds"')[0]
        )


def test_fewer_regions_are_fitted_and_the_rest_is_said():
    found = executed("jitter", 2, ["jitter"], [16, 64, 256], 1)
    assert [bool(r["profile"]) for r in found["regions"]] == [True, False, False]
    assert told(found)["fitted profiles of {2}, {1,2}"] == "the budget was spent"
    rates = {(r["integrand"], r["region"]): r["fitted"] for r in found["rates"]}
    assert rates["best", "1"]["exponent"] is not None
    assert rates["best", "overall"]["exponent"] is None
    assert rates["best", "overall"]["rests_on"] == "no profile is fitted on the region 2"


@pytest.mark.parametrize(
    ("ended", "replicates", "why"),
    [
        ("interrupted", 128, "the check was interrupted"),
        ("decided", 1, "no N has two realisations"),
    ],
)
def test_where_nothing_is_fitted_the_reason_is_said(ended, replicates, why):
    found = executed("random", 2, ["random"], [16], 3, replicates, ended)
    assert all(r["profile"] == [] and r["reason"] is None for r in found["regions"])
    assert told(found)["fitted profiles of {1}, {2}, {1,2}"].startswith(why)
    assert {r["fitted"]["exponent"] for r in found["rates"]} <= {None}


def test_in_many_dimensions_the_outer_regions_are_fitted():
    found = executed("latin-hypercube", 5, [], [32, 64], 5)
    fitted = [r["region"] for r in found["regions"] if r["profile"] or r["outside_model"]]
    assert fitted == ["1", "5", "1,2", "4,5", "1,2,3,4,5"]
    assert told(found)["fitted profiles on other regions"].startswith("fitted are {1}, {5}")


def test_a_region_outside_the_model_has_no_profile():
    fit = ProfileFit(None, None, None, None, "no power: a lattice", "no power: a lattice", 4)
    rows = with_profiles([{"region": "1", "spectrum": [3]}], [FittedRegion((1,), (), fit)])
    assert rows == [
        {
            "region": "1",
            "spectrum": [3],
            "profile": [],
            "outside_model": "no power: a lattice",
            "reason": None,
        }
    ]


def test_what_is_not_determined_is_null_with_its_reason():
    fit = ProfileFit(Interval(2.0, 1.0, 3.0), None, None, None, None, "one N", 4)
    (row,) = with_profiles([], [FittedRegion((1, 2), (), fit)])
    (monomial,) = row["profile"]
    assert (row["region"], row["reason"], row["spectrum"]) == ("1,2", "one N", [])
    assert monomial["degree"] == {"estimate": 2.0, "low": 1.0, "high": 3.0}
    assert monomial["effective"] is monomial["gamma"] is monomial["alpha"] is None


def test_orders_of_classes():
    sampler, best = parse_sampler("multi-jitter", 2), parse_decay("best")
    order = order_on(sampler, best)
    assert str(order.exponent) == "2"
    assert str(order_on(sampler, best, (1,)).exponent) == "3"


def test_fits_are_part_of_the_plan_and_replay(tmp_path):
    found = check("jitter", 2, ["jitter"], counts=[16, 64], budget=20, seed=3)
    assert found["plan"]["fitted"] == 3
    (tmp_path / "plan.json").write_text(json.dumps(found["plan"]))
    again = check([], 2, plan=tmp_path / "plan.json")
    assert again["regions"] == found["regions"]
    assert again["rates"] == found["rates"]
