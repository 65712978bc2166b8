"""Checks of whole designs: correct ones are never contradicted, each defect is named.

A correct design is contradicted or called faulty with a probability of at most 1e-5 a check. The
wrong ones are off by factors that 128 realisations tell apart with a probability above 1 - 1e-6.
"""

from pathlib import Path

import numpy as np
import pytest
from specrate.numerics.check_documents import check, document
from specrate.numerics.checks import judgements, run_check
from specrate.numerics.designs import design, ladder
from specrate.numerics.pointfiles import write_text
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")


def own(name):
    return f"{SAMPLERS}:{name}"


def kinds(found):
    return [f["kind"] for f in found["faults"]]


NEVER_CONTRADICTED = (
    ("jitter", 2, "jitter"),
    ("random", 2, "random"),
    ("multi-jitter", 2, "overall/disk ~ 3/2"),
    ("n-rooks", 2, "overall/anisotropic-gaussian:sigma=(1/10,2/5) ~ 1"),
    ("n-rooks", 2, "overall/anisotropic-gaussian:sigma=(1/2,1/3) ~ 1"),
    ("correlated-multi-jitter", 2, "correlated-multi-jitter"),
    ("uncorrelated-jitter:1+2", 3, "uncorrelated-jitter:1+2"),
    ("latin-hypercube", 10, "latin-hypercube"),
    ("jitter", 10, "jitter"),
    ("jitter", 1, "jitter"),
    ("jitter", 2, "overall/gaussian:sigma=0.1 ~ 2"),
    ("random", 2, "overall/disk:radius=0.1 ~ 1"),
    ("regular", 2, "overall/gaussian:sigma=0.3 ~ 3"),
    (own("jitter"), 2, "jitter"),
    (own("shuffled_jitter"), 3, "jitter"),
    (own("rooks"), 2, "latin-hypercube"),
    ("scipy.stats.qmc:LatinHypercube", 2, "n-rooks"),
)


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize(("word", "dim", "claim"), NEVER_CONTRADICTED)
def test_correct_designs_are_never_contradicted(word, dim, claim, seed):
    """128 realisations at every N below 2000: as many as a contradiction takes."""
    counts = [n for n in ladder(design([word], dim, [claim], [], seed), []) if n < 2000]
    found = document(
        run_check([word], dim, [claim], seed=seed, steps=[(n, 128, 128) for n in counts])
    )
    assert found["verdict"] in ("consistent", "inconclusive")
    assert found["faults"] == []
    assert [s["replicates"] for s in found["plan"]["ladder"]] == [128] * len(counts)


def test_rare_values_do_not_contradict():
    """A box of volume 1e-4 is missed by all of 128 x 16 points with a probability of 0.8."""
    for seed in range(4):
        found = check("random", 2, ["random"], ["box:side=0.01"], [16], 0.2, seed)
        assert found["verdict"] in ("consistent", "inconclusive")


@pytest.mark.parametrize(
    ("word", "dim", "claim", "region"),
    [
        (own("half_jitter"), 2, "jitter", "2"),
        (own("half_jitter"), 3, "jitter", "2"),
        (own("wide_jitter"), 2, "jitter", "1"),
        (own("coupled"), 3, "random", None),
        ("random", 2, "latin-hypercube", "1"),
        ("jitter", 2, "latin-hypercube", "1"),
        ("scipy.stats.qmc:LatinHypercube", 2, "jitter", "1"),
        ("latin-hypercube", 2, "multi-jitter", "1,2"),
        ("multi-jitter", 2, "correlated-multi-jitter", "1,2"),
        ("uncorrelated-jitter:1+2", 3, "uncorrelated-jitter:2+1", "1"),
        ("random", 10, "latin-hypercube", "1"),
        ("jitter", 1, "random", "1"),
    ],
)
def test_wrong_designs_are_contradicted_and_the_region_named(word, dim, claim, region):
    found = check(word, dim, [claim], budget=20)
    assert found["verdict"] == "contradicted"
    assert found["faults"] == []
    (told,) = found["claims"]
    assert told["holds"] is False
    assert told["witness"]["region"] == region
    if region is None:
        assert told["witness"]["what"] == "variance"
        assert told["witness"]["at"].endswith("axes=(1,2,3)")
    assert found["seconds"] < 10


def test_only_the_region_at_fault_disagrees():
    """x is stratified, y is not: rows of the axis 1 agree, some of the axis 2 do not."""
    found = check(own("half_jitter"), 2, ["jitter"], budget=20)
    agrees = {r["region"]: [s["agrees"] for s in r["spectrum"]] for r in found["regions"]}
    assert all(agrees["1"])
    assert not all(agrees["2"])


@pytest.mark.parametrize(
    ("word", "claim"),
    [
        ("random", "overall/disk ~ 3/2"),
        ("jitter", "axis/best ~ 3"),
        ("jitter", "overall/disk ~ 2"),
        ("latin-hypercube", "generic/best ~ 2"),
        (own("half_jitter"), "2/best ~ 2"),
    ],
)
def test_exponents_that_are_too_large_are_contradicted(word, claim):
    found = check(word, 2, [claim], budget=20)
    assert found["verdict"] == "contradicted"
    assert found["claims"][0]["witness"]["what"] == "exponent"
    assert found["n_range"] == [16, 4096]


@pytest.mark.parametrize(
    ("word", "claim"), [("jitter", "overall/disk ~ 1"), (own("half_jitter"), "1/best ~ 1")]
)
def test_too_small_an_exponent_is_not_confirmed(word, claim):
    assert check(word, 2, [claim], budget=0.5)["verdict"] == "inconclusive"


def test_axis_and_generic_regions_are_told_apart():
    """scipy's Latin hypercube: N P_S is near 0 along the axes, 1 off them; chance below 1e-6."""
    found = check("scipy.stats.qmc:LatinHypercube", 2, ["n-rooks"], (), [64], budget=60)
    for region, limits in (("1", (0, 0.01)), ("2", (0, 0.01)), ("1,2", (0.4, 2.5))):
        (rows,) = [r["spectrum"] for r in found["regions"] if r["region"] == region]
        low = [r for r in rows if max(map(abs, r["frequency"])) == 1]
        assert low
        assert all(limits[0] < r["scaled_power"]["estimate"] < limits[1] for r in low)


def test_scipy_latin_hypercube_is_consistent_with_n_rooks():
    found = check("scipy.stats.qmc:LatinHypercube", 2, ["n-rooks"], (), [16], budget=60)
    assert found["verdict"] == "consistent"
    assert found["matches"] == ["latin-hypercube"]


@pytest.mark.parametrize("word", ["jitter", own("jitter")])
def test_jitter_is_consistent_with_jitter(word):
    found = check(word, 2, ["jitter"], (), [16], budget=60)
    assert (found["verdict"], found["matches"]) == ("consistent", ["jitter"])
    assert found["budget_needed_seconds"] is None


@pytest.mark.parametrize(
    ("name", "claims", "kind", "text"),
    [
        ("centred_rooks", ["n-rooks"], "bias", "fixed places"),
        ("lumpy", ["random"], "bias", "E exp(-2 pi i 5 x)"),
        ("frozen", ["random"], "duplicate realisations", "1 distinct of 128"),
        ("single", [], "quantised coordinates", "float32"),
        ("nan", [], "not finite", "got nan on axis 2, row 3"),
        ("outside", ["random"], "outside", r"got 1.0 on axis 1, row 2"),
        ("transposed", [], "shape", "must have shape (16, 2): got (2, 16)"),
        ("raising", ["random"], "exception", "RuntimeError: no luck at"),
        ("raising_late", ["random"], "exception", "no luck today"),
        ("fewer", ["latin-hypercube"], "count", "nearest N found that it honours is 49"),
    ],
)
def test_faults_are_named(name, claims, kind, text):
    counts = [50] if kind == "count" else ()
    found = check(own(name), 2, claims, (), counts, budget=20)
    assert found["verdict"] == "invalid"
    assert kind in kinds(found)
    assert any(text in f["detail"] for f in found["faults"])
    assert all("\n" not in f["detail"] for f in found["faults"])
    assert found["seconds"] < 10


def test_a_file_of_equal_realisations(tmp_path):
    points = np.repeat(stream(91).random((1, 16, 2)), 10, axis=0)
    write_text(tmp_path / "equal.txt", points)
    found = check(str(tmp_path / "equal.txt"), 2, ["random"], budget=5)
    assert found["verdict"] == "invalid"
    assert "duplicate realisations" in kinds(found)


def test_a_file_of_several_realisations(tmp_path):
    """128 of random points: n-rooks is refuted along the axes, random is not."""
    path = tmp_path / "points.txt"
    write_text(path, stream(92).random((128, 16, 2)))
    assert check(str(path), 2, ["n-rooks"], budget=5)["verdict"] == "contradicted"
    found = check(str(path), 2, ["random"], budget=5)
    assert found["verdict"] == "inconclusive"
    assert {(p["n"], p["replicates"]) for p in found["points"]} == {(16, 128)}
    assert found["seconds"] < 3  # it does not wait for realisations that will not come


@pytest.mark.parametrize("claims", [[], ["random"], ["axis/best ~ 1"]])
def test_a_file_of_one_realisation_decides_nothing(tmp_path, claims):
    path = tmp_path / "one.txt"
    write_text(path, stream(93).random((1, 64, 2)))
    found = check(str(path), 2, claims, budget=5)
    assert found["verdict"] == "inconclusive"
    assert any("one realisation" in row["why"] for row in found["left_out"])


def test_commas_in_utk_text_are_an_unusable_input(tmp_path):
    path = tmp_path / "commas.txt"
    path.write_text("0.1,0.2\n0.3,0.4\n")
    with pytest.raises(InputError, match=r"comma at line 1 of .*commas.txt"):
        check(str(path), 2, ["random"])


def test_n_is_moved_to_what_the_source_honours():
    found = check(own("jitter"), 2, ["jitter"], (), [50, 17], budget=0.2)
    assert [step["n"] for step in found["plan"]["ladder"]] == [16, 49]
    with pytest.raises(InputError, match="must have realisations of the N checked"):
        check("random", 2, ["jitter"], (), [50])


@pytest.mark.parametrize("dim", [1, 3, 10])
def test_other_dimensions(dim):
    found = check("random", dim, ["random"], budget=0.2)
    assert found["verdict"] != "contradicted"
    assert found["plan"]["dim"] == dim
    assert {len(r["region"].split(",")) for r in found["regions"]} == {1, min(2, dim), dim}


def test_integrands_are_measured_besides_the_probes():
    found = check("jitter", 2, ["jitter"], ["disk", "gaussian:sigma=0.2"], [16, 64], 0.3)
    rows = {(p["integrand"], p["n"]): p for p in found["points"]}
    for name in ("disk:radius=0.3", "gaussian:sigma=0.2"):
        for n in (16, 64):
            assert float(rows[name, n]["exact"]) > 0
            assert rows[name, n]["variance"]["low"] > 0
    predicted = {r["integrand"]: r["predicted"]["exponent"] for r in found["rates"]}
    assert predicted["disk:radius=0.3"] == "3/2"


def test_a_slow_sampler_ends_with_the_budget():
    found = check(own("slow"), 2, ["random"], budget=1)
    drawn = sum(max(step["replicates"], step["attempted"]) for step in found["plan"]["ladder"])
    assert 1 <= drawn <= 21  # of 50 ms each, the last one begun within the second
    assert found["verdict"] == "inconclusive"
    assert found["budget_needed_seconds"] > 1


def test_an_interruption_keeps_what_was_measured():
    state = run_check([own("interrupted")], 2, ["random"], budget=20)
    assert state.interrupted
    assert [m.replicates for m in state.measurements] == [128, 0, 0]
    found = document(state)
    assert found["interrupted"]
    assert found["verdict"] == "inconclusive"
    assert len(found["points"]) == len({p["integrand"] for p in found["points"]})


@pytest.mark.parametrize("budget", [0, -1, float("inf"), float("nan")])
def test_the_budget_must_be_positive(budget):
    with pytest.raises(InputError, match="--budget must be a positive number"):
        run_check(["random"], 2, budget=budget)


def test_without_claims_it_says_what_matches():
    found = check("multi-jitter", 2, counts=[16], budget=60)
    assert (found["verdict"], found["matches"]) == ("consistent", ["multi-jitter"])
    assert check("multi-jitter", 2, budget=0.01)["verdict"] == "inconclusive"


def test_several_claims_are_judged_each():
    state = run_check(["jitter"], 2, ["latin-hypercube", "jitter"], counts=[16], budget=5)
    wrong, right = judgements(state)
    assert (wrong.claim.text, wrong.outcome) == ("latin-hypercube", "fails")
    assert (right.claim.text, right.outcome != "fails") == ("jitter", True)
