"""What a page says in words: verdicts, claims, faults and remedies, neighbours, the plan."""

import copy
import json
import re
import shlex
from html import unescape

import pytest
from check_examples import SAMPLERS, example
from specrate.report import check_sections as sections
from specrate.report.cli import main


def words(markup) -> str:
    """The text of markup on one line."""
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", markup.text)).split())


@pytest.mark.parametrize(
    ("name", "tone", "parts"),
    [
        (
            "consistent",
            "good",
            [
                "Asked whether jitter in 1D meets the claim jitter : ✓ consistent at N = 16 to 64",
                "since all measured values lie within 25% of the claimed",
                "a correct claim is contradicted with a probability set to 10⁻⁵.",
            ],
        ),
        (
            "contradicted",
            "bad",
            [
                "random in 2D meets the claims jitter and overall/disk:radius=0.3 ~ 3 :",
                "✗ contradicted at N = 16 to 256, since jitter fails in",
            ],
        ),
        ("invalid", "bad", ["✗ invalid at N = 16", "since a fault voids the question (quantised"]),
        ("raising", "bad", ["✗ invalid before any N was measured", "(exception)"]),
        (
            "inconclusive",
            "",
            ["? inconclusive at N = 256", "does not decide; a budget of", "s may decide;"],
        ),
        ("unclaimed", "", ["Asked which catalogue sampler has the spectrum of random in 3D: ?"]),
    ],
)
def test_the_verdict_is_one_sentence(name, tone, parts):
    found = sections.verdict(example(name))
    text = words(found)
    for part in parts:
        assert part in text.replace("\xa0", " "), text
    assert text.count(". ") == 0
    assert text.endswith(".")
    assert f'class="{("verdict " + tone).strip()}"' in found.text


def test_other_ways_to_a_verdict():
    exponent = {"claim": "axis/worst ~ 3", "holds": True, "witness": None, "exponents": [2.9, 3.1]}
    held = {**example("consistent"), "claims": [exponent]}
    assert "the exponent lies within 0.25 of the claimed" in words(sections.verdict(held))
    matched = {**example("consistent"), "claims": [], "matches": ["jitter", "n-rooks"]}
    assert ", with jitter and n-rooks ; the catalogue sampler" in words(sections.verdict(matched))
    stopped = {**example("consistent"), "interrupted": True}
    assert "16 to 64, interrupted," in words(sections.verdict(stopped))
    many = [f"p{i}.txt" for i in range(9)]
    assert words(sections.listed(many)) == "p0.txt , p1.txt , p2.txt , p3.txt and 5 more"


def test_a_failed_sampler_shows_region_frequency_and_both_numbers():
    text = words(sections.claims(example("contradicted")))
    witness = example("contradicted")["claims"][0]["witness"]
    assert "jitter ✗ fails" in text
    assert "Region 1 Frequency m = (1, 0) N 16 Measured N · P S" in text
    assert f"Claimed N · P S {witness['predicted']:.3f}" in text
    failing = example("contradicted")["claims"][0]["failing"]
    assert f"{failing['tests']} of {failing['of']} comparisons fail." in text


def test_a_failed_exponent_shows_its_statistic_and_what_is_left():
    drift = {"what": "exponent", "chi2": 621.3, "threshold": 45.5, "exponents": [0.4, None]}
    claim = {"claim": "axis/worst ~ 3", "holds": False, "witness": drift, "exponents": [0.4, None]}
    text = words(sections.claims({**example("contradicted"), "claims": [claim]}))
    assert "χ² of the claimed exponent 621, with the drift that suits it" in text
    assert "Excluded above 45.5 Exponents not excluded 0.400 to ∞" in text
    open_one = {**claim, "holds": None, "witness": None}
    text = words(sections.claims({**example("contradicted"), "claims": [open_one]}))
    assert text == "axis/worst ~ 3 ? undecided Exponents not excluded 0.400 to ∞"


def test_a_variance_may_be_the_witness():
    measured = {"estimate": 2e-3, "low": 1e-3, "high": None}
    witness = {
        "what": "variance", "region": None, "at": "bernoulli:k=1", "n": 64, "measured": measured,
        "predicted": 1e-4, "ratio": 20.0, "decades": 1.3,
    }  # fmt: skip
    claim = {"claim": "jitter", "holds": False, "witness": witness}
    text = words(sections.claims({**example("contradicted"), "claims": [claim]}))
    assert "Integrand bernoulli:k=1 N 64 Measured variance 0.00200 [0.00100, ∞]" in text
    assert "Measured over claimed 20.0" in text


def test_faults_of_one_kind_stand_together_with_one_remedy():
    found = example("invalid")["faults"]
    kinds = {f["kind"] for f in found}
    other = {**found[0], "detail": "at another N", "remedy": "mend that as well"}
    found = [*found, other]
    text = words(sections.faults({**example("invalid"), "faults": found}))
    assert text.count("Remedy: ") == len(kinds) > 1
    assert f"{found[0]['remedy']}; or mend that as well." in text
    for remedy in {f["remedy"] for f in found}:
        assert f" {remedy}" in text
    assert all(f["detail"] in text for f in found)
    assert "Evidence " in text
    assert words(sections.claims(example("invalid"))).startswith("A fault below voids the question")


def test_evidence_of_all_types_is_shown():
    evidence = {"place": [0.5, 1], "value": 1.5e-9, "nothing": None, "output": "a\nb"}
    evidence |= {"n": 3, "message": "<"}
    fault = {"kind": "novel", "detail": "a rule", "evidence": evidence, "remedy": "mend & check"}
    markup = sections.faults({**example("raising"), "faults": [fault]})
    for part in ("[0.5, 1]", "1.50×10⁻⁹", "<pre>a\nb</pre>", "<dd>3</dd>", "<dd>&lt;</dd>"):
        assert part in markup.text
    assert "nothing" not in markup.text
    assert "Remedy: mend & check." in words(markup)


def test_neighbours_have_their_orders():
    document = {**example("contradicted"), "matches": ["jitter", "multi-jitter", "regular"]}
    text = words(sections.neighbours(document))
    assert "jitter yes N −3/2 N −2 multi-jitter N −3/2 N −2 regular N −1 no variance" in text
    assert words(sections.neighbours({**document, "matches": []})) == "None is established."
    assert words(sections.neighbours(example("exponent"))) == "Not looked for."


def test_what_is_left_out_by_check_and_page():
    text = words(sections.left_out(example("exponent"), [("a plane", "N = 4 is too few")]))
    assert "spectrum and catalogue matches : only exponents are claimed" in text
    assert text.endswith("a plane : N = 4 is too few")
    assert words(sections.left_out({"left_out": []}, [])) == "Nothing."


def test_the_plan_can_be_typed_again(capsys, tmp_path, monkeypatch):
    """The printed command is understood, and asks for what was asked."""
    document = copy.deepcopy(example("contradicted"))
    markup = sections.plan(document)
    told = [unescape(t) for t in re.findall(r"<pre>(.*?)</pre>", markup.text, re.S)]
    assert told[0] == "specrate check --plan check.json"
    _, *command = shlex.split(told[1])
    main([*command, "--budget", "0.05", "--format", "json"])
    again = json.loads(capsys.readouterr().out)
    keys = ("sources", "asked", "dim", "claims", "integrands", "seed")
    assert {k: again["plan"][k] for k in keys} == {k: document["plan"][k] for k in keys}
    assert "16 128 128 128 64 128 128 128" in words(markup)


def test_a_source_may_need_quotes():
    document = copy.deepcopy(example("raising"))
    document["plan"]["sources"] = ["my points.txt", f"{SAMPLERS}:raising"]
    assert "'my points.txt'" in unescape(sections.plan(document).text)
