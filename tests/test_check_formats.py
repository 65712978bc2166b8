"""Documents of checks as printed."""

import csv
import io
import json
from pathlib import Path
from typing import Any

import pytest
from latex import check_structure, compile_where_possible
from specrate.numerics import check
from specrate.numerics.point_sources.pointfiles import write_text
from specrate.numerics.streams import stream
from specrate.report.check_formats import frequency_text, render, short

Document = dict[str, Any]


@pytest.fixture(scope="module")
def contradicted() -> Document:
    """Independent points that claim to be jittered, and an exponent."""
    claims = ["jitter", "axis/worst ~ 3"]
    return check("random", 2, claims, counts=[16, 64, 256, 1024], budget=20)


@pytest.fixture(scope="module")
def wide() -> Document:
    """Many dimensions, where regions must be summarised."""
    name = "latin-hypercube"
    return check(name, 10, [name], counts=[16, 64], budget=8)


@pytest.fixture(scope="module")
def unclaimed() -> Document:
    """No claim, in many dimensions."""
    return check("latin-hypercube", 5, counts=[64], budget=0.5)


def lines_between(text: str, start: str, stop: str = "") -> list[str]:
    """Lines of a table, after its head and rule."""
    part = text[text.index(start) :]
    return part.split("\n\n")[0].splitlines()[3:]


def test_the_first_lines_tell_verdict_region_and_witness(contradicted: Document) -> None:
    first, claim, witness, *_ = render(contradicted, "terminal").splitlines()
    assert first.startswith("CONTRADICTED: random in 2D, N = 16 to 1024, ")
    assert claim.startswith("  claim jitter: FAILS in ")
    assert witness.startswith("    witness on region 1: N·P_S at m = (1, 0), N = 16: measured ")
    assert f"(level {contradicted['level']:.0e})" in witness
    assert "claimed 0.189" in witness


def test_every_interval_tells_its_level(contradicted: Document) -> None:
    text = render(contradicted, "terminal")
    for head in ("N·P_S measured [95 %]", "variance [95 %]", "slope [95 %]"):
        assert head in text
    assert "with a probability set to 1e-05" in text


def test_the_most_telling_frequency_is_shown(contradicted: Document) -> None:
    rows = lines_between(render(contradicted, "terminal"), "Power spectrum")
    assert len(rows) == 3 * len(contradicted["plan"]["ladder"])
    for region in contradicted["regions"]:
        for row in region["spectrum"]:
            if row["agrees"] is False:
                break
        else:
            continue
        shown = [r for r in rows if r.startswith(region["region"] + " ")]
        assert shown[0].endswith("NO")


def test_columns_of_a_claim_are_absent_without_one(unclaimed: Document) -> None:
    text = render(unclaimed, "terminal")
    assert "claimed" not in text.split("\n\n")[1]
    assert "slope, N -> oo" not in text
    assert "catalogue samplers whose spectrum the points have" in text.splitlines()[1]


def test_many_regions_that_agree_are_one_line_per_size_and_n(wide: Document) -> None:
    rows = lines_between(render(wide, "terminal"), "Power spectrum")
    labels = [r.split("  ")[0] for r in rows if not r.startswith(" ")]
    assert labels == ["10 axes", "45 pairs", "120 triples", "1..10"]
    assert len(rows) == 4 * 2
    assert len(wide["regions"]) == 176  # the document keeps them all


def test_regions_that_disagree_are_never_summarised() -> None:
    document = check("random", 10, ["latin-hypercube"], counts=[64], budget=10)
    rows = lines_between(render(document, "terminal"), "Power spectrum")
    failing = [
        g["region"] for g in document["regions"] if any(r["agrees"] is False for r in g["spectrum"])
    ]
    assert len(failing) == 10
    assert [r.split(" ")[0] for r in rows if r.endswith("NO")] == failing


def test_extremes_of_alike_regions_without_a_claim(unclaimed: Document) -> None:
    text = render(unclaimed, "terminal")
    for label in ("5 axes, least", "5 axes, largest", "10 pairs, least", "10 pairs, largest"):
        assert label in text


def test_no_line_of_a_table_is_too_wide(wide: Document, contradicted: Document) -> None:
    for document in (wide, contradicted):
        for table in ("Power spectrum", "Profiles fitted", "Exponents r", "Variance on"):
            text = render(document, "terminal")
            if table in text:
                assert max(map(len, lines_between(text, table))) <= 120
    assert "Profiles fitted" in render(contradicted, "terminal")


def test_csv_has_numbers_in_columns(contradicted: Document) -> None:
    rows = list(csv.DictReader(io.StringIO(render(contradicted, "csv"))))
    assert len(rows) == len(contradicted["points"])
    for row, point in zip(rows, contradicted["points"], strict=True):
        assert float(row["variance"]) == point["variance"]["estimate"]
        assert float(row["variance_low"]) == point["variance"]["low"]
        assert float(row["bias_high"]) == point["bias"]["high"]
        assert row["exact"] == (point["exact"] or "")
        assert int(row["realisations"]) == point["realisations"] == point["replicates"]


def test_one_realisation_is_printed_without_an_interval(tmp_path: Path) -> None:
    path = tmp_path / "points.txt"
    write_text(path, stream(96).random((1, 16, 2)))
    found = check(str(path), 2, ["random"], budget=20)
    text = render(found, "terminal")
    assert "[0, oo]" in text
    assert "moved by random shifts, 1024 of them" in text
    row = next(csv.DictReader(io.StringIO(render(found, "csv"))))
    assert (row["replicates"], row["realisations"], row["bias"]) == ("1024", "1", "")
    check_structure(render(found, "latex"))


def test_json_is_the_document(contradicted: Document) -> None:
    assert json.loads(render(contradicted, "json")) == contradicted


def test_markdown_leads_with_the_verdict(contradicted: Document) -> None:
    text = render(contradicted, "markdown")
    assert text.startswith("**CONTRADICTED: random in 2D")
    assert "\n- witness on region 1: " in text
    assert "| region | N | frequency | N·P_S measured [95 %] | N·P_S claimed | agrees |" in text


def test_faults_come_second() -> None:
    points = {"verdict": "invalid", "plan": {"sources": ["x.py:f"], "dim": 2}, "n_range": None}
    rest = {
        "blocks": None,
        "oblique": [],
        "claims": [],
        "matches": [],
        "regions": [],
        "points": [],
        "rates": [],
        "left_out": [],
    }
    numbers = {
        "seconds": 0.1,
        "level": 1e-9,
        "false_alarm": 1e-5,
        "margin": 0.25,
        "exponent_margin": 0.25,
    }
    document = {**points, **rest, **numbers, "interrupted": True, "budget_needed": None}
    fault = {"kind": "piled points", "detail": "why", "evidence": {}, "remedy": "mend it"}
    document["faults"] = [fault]
    first, second, third, *_ = render(document, "terminal").splitlines()
    assert first == "INVALID: x.py:f in 2D, no N measured, 0.1 s, interrupted"
    assert second == "  fault, piled points: why"
    assert third == "    remedy: mend it"


def test_latex_is_well_formed_and_compiles(
    tmp_path: Path, contradicted: Document, wide: Document, unclaimed: Document
) -> None:
    fragments = [render(d, "latex") for d in (contradicted, wide, unclaimed)]
    for fragment in fragments:
        check_structure(fragment)
    compile_where_possible(fragments, tmp_path)


@pytest.mark.parametrize(
    ("frequency", "text"),
    [
        ((1, 0), "m = (1, 0)"),
        ((0, 0, 0, 2, 0, -1), "m_4 = 2, m_6 = -1"),
        ((1, 1, 1, 1, 1), "every m_i = 1"),
        ((1, 1, 1, 1, 2), "m_1 = 1, m_2 = 1, m_3 = 1, m_4 = 1, m_5 = 2"),
    ],
)
def test_frequencies(frequency: tuple[int, ...], text: str) -> None:
    assert frequency_text(frequency) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("1,2,3,4,5,6", "1..6"),
        ("bernoulli:k=1,axes=(1,2,3,4)", "bernoulli:k=1,axes=(1..4)"),
        ("1,2,3", "1,2,3"),
        ("1,2,4,5", "1,2,4,5"),
    ],
)
def test_long_supports_are_shortened(text: str, shown: str) -> None:
    assert short(text) == shown
