"""Plans: claims and sources read together, ladders that both honour, integrands of claims."""

import json
from pathlib import Path

import pytest
from specrate.numerics.checking.designs import (
    all_frequencies,
    all_integrands,
    candidates,
    claim_texts,
    design,
    fault_of_count,
    ladder,
    rate_probes,
)
from specrate.numerics.point_sources.realisations import SamplerFault
from specrate.theory.claims import parse_claim
from specrate.theory.errors import InputError

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")


def of(word, dim=2, claims=(), integrands=()):
    words = [word] if isinstance(word, str) else word
    return design(words, dim, claims, integrands, 0)


@pytest.mark.parametrize(
    ("word", "dim", "claims", "asked", "counts"),
    [
        ("random", 2, [], [], (16, 100, 256)),
        ("jitter", 2, ["jitter"], [], (16, 100, 256)),
        ("jitter", 1, ["jitter"], [], (16, 100, 256)),
        ("jitter", 3, ["jitter"], [], (27, 64, 729)),
        ("jitter", 10, ["jitter"], [], (1024,)),
        ("random", 10, ["jitter"], [], (1024,)),
        ("random", 2, ["jitter:2x8"], [], (16, 64, 256)),
        ("random", 2, ["jitter:3x5"], [], (15, 135, 240)),
        (f"{SAMPLERS}:jitter", 2, ["jitter"], [], (16, 100, 256)),
        (f"{SAMPLERS}:jitter", 3, ["jitter"], [], (27, 64, 729)),
        (f"{SAMPLERS}:jitter", 2, ["random"], [50, 100], (49, 100)),
        ("uncorrelated-jitter:1+2", 3, ["uncorrelated-jitter:1+2"], [], (25, 64, 729)),
        ("random", 3, ["jitter", "uncorrelated-jitter:1+2"], [], (25, 27, 64, 729)),
        ("random", 2, ["latin-hypercube", "jitter"], [], (16, 100, 256)),
        ("multi-jitter", 2, ["overall/disk ~ 3/2"], [], (16, 64, 256, 1024, 4096)),
        ("multi-jitter", 2, ["overall/disk ~ 3/2"], [16, 64], (16, 64)),
        ("random", 2, ["random", "axis/best ~ 1"], [], (16, 64, 100, 256, 1024, 4096)),
        ("scipy.stats.qmc:Sobol", 2, [], [50], (64,)),
    ],
)
def test_ladders(word, dim, claims, asked, counts):
    assert ladder(of(word, dim, claims), asked) == counts


def test_narrow_integrands_move_the_ladder_up():
    """Where N does not resolve the bump, every stratification looks like random sampling."""
    counts = ladder(of("random", 2, ["overall/gaussian:sigma=0.03 ~ 1"]), [])
    assert counts[0] > 176 * 1.5
    assert len(counts) == 4
    assert ladder(of("random", 2, ["overall/disk:radius=0.002 ~ 1"]), [])[0] > 65536


@pytest.mark.parametrize("asked", [[1], [0], [-4], [16, 1 << 23]])
def test_n_out_of_range_is_refused(asked):
    with pytest.raises(InputError, match=r"--n must be in 2\.\.4194304: got"):
        ladder(of("random"), asked)


def test_no_common_n_names_those_that_the_claim_has():
    with pytest.raises(InputError, match=r"such as 49.*got N = 50"):
        ladder(of("random", 2, ["jitter"]), [50])
    assert ladder(of("random", 2, ["jitter"]), [49, 50]) == (49, 50)


def test_point_files_bring_their_own_n(tmp_path):
    (tmp_path / "a.txt").write_text("0.1 0.2\n0.3 0.4\n0.5 0.6\n")
    (tmp_path / "b.txt").write_text("0.1 0.2\n0.3 0.4\n")
    found = of([str(tmp_path / "a.txt"), str(tmp_path / "b.txt")])
    assert ladder(found, []) == (2, 3)
    assert ladder(found, [100]) == (3,)


@pytest.mark.parametrize(
    ("text", "dim", "names"),
    [
        ("axis/worst ~ 2", 2, ["bernoulli:k=1", "bernoulli:k=1,axes=2"]),
        ("axis/best ~ 2", 2, ["bernoulli:k=6", "bernoulli:k=6,axes=2"]),
        ("1/best ~ 2", 3, ["bernoulli:k=6"]),
        ("generic/worst ~ 2", 3, ["bernoulli:k=1,axes=(1,2,3)"]),
        ("axis/additive ~ 2", 2, ["additive:k=1"]),
        ("overall/additive:k=2 ~ 3", 3, ["additive:k=2"]),
        ("w=1/additive:k=3 ~ 3", 2, ["additive:k=3"]),
        ("2/additive:k=2 ~ 3", 2, ["bernoulli:k=2,axes=2"]),
        ("w=2/p=5 ~ 1", 2, ["bernoulli:k=2,axes=(1,2)"]),
        ("overall/disk:radius=0.3 ~ 1", 2, ["disk:radius=0.3"]),
        ("2/bernoulli:k=2,axes=2 ~ 1", 2, ["bernoulli:k=2,axes=2"]),
    ],
)
def test_probes_of_a_rate(text, dim, names):
    found = [f.name.replace("(2)", "2") for f in rate_probes(parse_claim(text, dim), dim)]
    expected = [f.name for n in names for f in of("random", dim, integrands=[n]).integrands]
    assert found == [e.replace("(2)", "2") for e in expected]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("axis/best ~ oo", "must be finite"),
        ("axis/disk ~ 3/2", "must be on the region overall"),
        ("axis/p=5/2 ~ 1", r"p - s is 1, 3, 5"),
        ("generic/p=26.5 ~ 1", r"p - s is 1, 3, 5"),
        ("axis/p=100 ~ 1", r"p - s is 1, 3, 5"),
        ("overall/product:k=13 ~ 1", "1 <= k <= 12"),
        ("overall/additive:k=13 ~ 1", "1 <= k <= 12"),
        ("1/additive:k=13 ~ 1", "1 <= k <= 12"),
        ("generic/additive:k=2 ~ 1", "power on the axes alone"),
        ("1,2/additive ~ 1", "power on the axes alone"),
    ],
)
def test_rates_that_cannot_be_probed(text, message):
    with pytest.raises(InputError, match=message):
        of("random", 2, [text])


@pytest.mark.parametrize(("dim", "seed"), [(0, 0), (-1, 0), (True, 0), (2, -1)])
def test_dimension_and_seed(dim, seed):
    with pytest.raises(InputError, match="must be at least"):
        design(["random"], dim, [], [], seed)


def test_claims_from_a_file(tmp_path):
    path = tmp_path / "claims.json"
    path.write_text(json.dumps(["jitter", "axis/best ~ 2"]))
    assert claim_texts(str(path)) == ["jitter", "axis/best ~ 2"]
    found = of("jitter", 2, [str(path), "random"])
    assert [c.text for c in found.claims] == ["jitter", "axis/best ~ 2", "random"]
    assert [s.name for s in found.claimed_samplers] == ["jitter", "random"]
    assert [c.text for c in found.rate_claims] == ["axis/best ~ 2"]


@pytest.mark.parametrize("text", ["{", '{"claims": []}', '["jitter", 3]', '"jitter"', "\udcff"])
def test_what_is_no_claims_file(tmp_path, text):
    path = tmp_path / "claims.json"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(InputError, match="must hold a JSON list of texts: got") as caught:
        claim_texts(str(path))
    assert "\n" not in str(caught.value)


def test_an_entry_that_is_no_claim_is_named(tmp_path):
    path = tmp_path / "claims.json"
    path.write_text('["jitter", 5]')
    with pytest.raises(InputError, match="JSON list of texts: got 5 as entry 2 in"):
        claim_texts(str(path))


def test_a_missing_claims_file():
    with pytest.raises(InputError, match="must be readable: got No such file"):
        claim_texts("absent.json")


def test_integrands_are_named_once():
    found = of("jitter", 2, ["jitter", "axis/worst ~ 3/2"], ["bernoulli:k=1", "disk"])
    names = [f.name for f in all_integrands(found)]
    assert len(set(names)) == len(names) == 7
    assert names[-1] == "disk:radius=0.3"
    only = all_integrands(of("jitter", 2, ["overall/disk ~ 3/2"]))
    assert [f.name for f in only] == ["disk:radius=0.3"]


def test_frequencies_follow_the_claims():
    assert all_frequencies(of("jitter", 2, ["axis/best ~ 2"]), 16) == ()
    assert (8, 0) in all_frequencies(of("random", 2, ["jitter:2x8"]), 16)
    assert all_frequencies(of("random"), 16)


@pytest.mark.parametrize("dim", [1, 2, 3, 4])
def test_candidates_are_distinct_and_have_points(dim):
    found = candidates(dim)
    assert len({s.name for s in found}) == len(found)
    assert all(s.kernel is not None and s.counts_at is not None for s in found)


def test_a_wrong_count_names_the_nearest_that_works():
    source = of(f"{SAMPLERS}:fewer").source
    with pytest.raises(SamplerFault) as caught:
        source.realise(50, 0, range(1))
    told = fault_of_count(source, caught.value)
    assert (told.kind, told.evidence["nearest"], told.evidence["got"]) == ("count", 49, 49)
    assert "got 49; the nearest N found that it honours is 49" in told.detail
    other = SamplerFault("shape", "wrong", {})
    assert fault_of_count(source, other) is other
