"""The work-precision document as printed."""

import csv
import io
import json
from pathlib import Path
from typing import Any

import pytest
from latex import check_structure, compile_where_possible
from specrate.numerics.method_tests.work_precision import work_precision
from specrate.numerics.method_tests.work_precision_ladders import ladders
from specrate.report.work_precision_formats import render

Document = dict[str, Any]


@pytest.fixture(scope="module")
def document() -> Document:
    """A real document with made-up points on every method's ladder."""
    found = work_precision(1e-9)
    found["points"] = [
        {
            "problem": x.problem,
            "method": x.method,
            "parameter": x.parameter,
            "step": str(step),
            "relative_error": 10.0 ** (-3 - 12 * i),
            "low": 10.0 ** (-4 - 12 * i) if x.method == "Monte Carlo" else None,
            "high": 10.0 ** (-2 - 12 * i) if x.method == "Monte Carlo" else None,
            "reported_error": None if x.method == "Monte Carlo" else 10.0 ** (-1 - 12 * i),
            "seconds": 1e-5 * 4.0**i,
        }
        for x in ladders(0)
        for i, step in enumerate(x.steps)
    ]
    found["left_out"] = found["left_out"][:2]
    return found


def test_the_first_line_tells_the_ratios(document: Document) -> None:
    (ratio,) = document["ratios"]
    first, *_ = render(document, "terminal").splitlines()
    assert first == (
        "Eq. 17 to 50 digits at N = 1e30: the closed form is at least "
        f"{ratio['closed_ratio']:.0f} times as fast as mpmath.quad, ball quadrature "
        f"{ratio['quadrature_ratio']:.0f} times"
    )


def test_what_is_left_out_is_told(document: Document) -> None:
    lines = [x for x in render(document, "terminal").splitlines() if x.startswith("left out: ")]
    assert len(lines) == 2
    assert lines[0].endswith(": the budget was spent")


def test_json_and_csv_hold_every_point(document: Document) -> None:
    assert json.loads(render(document, "json")) == json.loads(json.dumps(document))
    head, *rows = csv.reader(io.StringIO(render(document, "csv")))
    assert head == list(document["points"][0])
    assert len(rows) == len(document["points"])
    assert rows[0][head.index("low")] == ""


def test_markdown_has_both_tables(document: Document) -> None:
    rows = [x for x in render(document, "markdown").splitlines() if x.startswith("|")]
    assert len(rows) == len(document["points"]) + len(document["ratios"]) + 4
    assert any("[1.0e-04, 1.0e-02]" in r for r in rows)


def test_latex_compiles(document: Document, tmp_path: Path) -> None:
    text = render(document, "latex")
    check_structure(text)
    compile_where_possible([text], tmp_path)
