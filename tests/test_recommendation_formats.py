"""Recommendations as printed: every format tells the layout, the others and why."""

import csv
import io
import json
from importlib.resources import files
from pathlib import Path

import jsonschema
import pytest
from latex import check_structure, compile_where_possible
from specrate.report.recommendation_formats import render
from specrate.theory.errors import InputError
from specrate.theory.recommendations import recommend

WANTED = ["axis/best ~ 3", "generic/worst ~ 3/2"]
SCENES = [(WANTED, 2), (["1,3/worst ~ 3/2", "2/best ~ 3"], 3), (["generic/worst ~ 9"], 1)]


def schema():
    folder = files("specrate.report") / "schemas"
    return json.loads((folder / "recommend.json").read_text("utf-8"))


@pytest.mark.parametrize(("wanted", "dim"), SCENES)
def test_json_matches_its_schema(wanted, dim):
    jsonschema.Draft202012Validator.check_schema(schema())
    document = json.loads(render(wanted, dim, "json"))
    jsonschema.Draft202012Validator(schema()).validate(document)
    assert len(document["alternatives"]) == len(recommend(wanted, dim).alternatives)


def test_a_document_without_a_field_does_not_match():
    document = json.loads(render(WANTED, 2, "json"))
    for key in list(document):
        rest = {k: v for k, v in document.items() if k != key}
        assert not jsonschema.Draft202012Validator(schema()).is_valid(rest)
    document["alternatives"][0]["regions"][0]["reached"] = "yes"
    assert not jsonschema.Draft202012Validator(schema()).is_valid(document)


def test_terminal_tells_the_layout_first_and_each_shortfall():
    lines = render(["1,3/worst ~ 3/2", "2/best ~ 3"], 3, "terminal").splitlines()
    assert lines[0].endswith("uncorrelated-jitter:2+1 on axes 1,3,2, N = t^2, t >= 2.")
    assert lines[2].split() == [
        "layout", "points", "wanted", "variance", "short", "by", "decides", "because"
    ]  # fmt: skip
    (random,) = (x for x in lines if x.startswith("random"))
    assert "N^(1/2)" in random
    assert any(x.startswith("2/best ~ 3: N P_S ~ (m/N)^b, b = 2") for x in lines)
    assert any(x.startswith("left out: isotropic") for x in lines)


@pytest.mark.parametrize("form", ["terminal", "markdown", "latex"])
def test_a_grid_is_warned_of(form):
    lines = render(WANTED, 2, form).splitlines()
    assert sum("regular: aliasing: a regular grid's errors oscillate" in x for x in lines) == 1


def test_terminal_says_when_nothing_reaches():
    assert "no layout reaches all of it" in render(["generic/worst ~ 9"], 1, "terminal")


@pytest.mark.parametrize(("wanted", "dim"), SCENES)
def test_csv_has_a_row_for_each_layout_and_rate(wanted, dim):
    rows = list(csv.DictReader(io.StringIO(render(wanted, dim, "csv"))))
    found = recommend(wanted, dim)
    assert len(rows) == len(found.alternatives) * len(wanted)
    assert {r["reached"] for r in rows} <= {"true", "false"}
    assert all((r["shortfall"] == "") == (r["reached"] == "true") for r in rows)


def test_markdown_is_a_table():
    table = [x for x in render(WANTED, 2, "markdown").splitlines() if x.startswith("|")]
    assert len({x.count("|") for x in table}) == 1
    assert any("| jitter |" in x and "| N |" in x for x in table)


def test_latex_compiles(tmp_path: Path):
    texts = [render(wanted, dim, "latex") for wanted, dim in SCENES]
    for text in texts:
        check_structure(text)
    assert r"N^{-\frac{3}{2}}" in texts[0]
    compile_where_possible(texts, tmp_path)


def test_what_cannot_be_wanted_is_refused():
    with pytest.raises(InputError):
        render(["jitter"], 2, "json")
