"""The document of the stiff cases as printed."""

import csv
import io
import json
from pathlib import Path
from typing import Any

import pytest
from latex import check_structure, compile_where_possible
from specrate.numerics.integrands.protocol import mp
from specrate.numerics.method_tests.radial_cases import RADIAL
from specrate.numerics.method_tests.spectrum_cases import SPECTRA
from specrate.numerics.method_tests.stress import Family, Method, Outcome, stress
from specrate.report.stress_formats import render
from specrate.theory.errors import InputError

Document = dict[str, Any]


def refuse(_: Any) -> Outcome:
    raise InputError("N must be at most 10: got 11")


@pytest.fixture(scope="module")
def document() -> Document:
    """One kind honest, refusals among it; the other with a planted answer."""
    wrong = Method[Any]("wrong_100%", lambda _: Outcome(mp.mpf(3), mp.mpf("1e-3"), "bound"))
    radial = Family(
        RADIAL.name, RADIAL.problems[:2], (wrong, *RADIAL.methods[:3]), RADIAL.references
    )
    methods = (Method[Any]("none", refuse), *SPECTRA.methods)
    spectra = Family(SPECTRA.name, SPECTRA.problems[:2], methods, SPECTRA.references)
    return stress([radial, spectra])


@pytest.fixture(scope="module")
def honest() -> Document:
    """Nothing to accuse."""
    return stress([Family(RADIAL.name, RADIAL.problems[:2], RADIAL.methods[:3], RADIAL.references)])


def test_the_first_lines_accuse(document: Document) -> None:
    first, *lines = render(document, "terminal").splitlines()
    assert first.startswith("DISHONEST: 2 of 14 answers to 4 problems, ")
    assert [x.strip() for x in lines[:2]] == [
        f"Eq. 17: {name}, wrong_100%: its bound of the error is below the error"
        for name, _ in RADIAL.problems[:2]
    ]


def test_the_first_line_acquits(honest: Document) -> None:
    first, *_ = render(honest, "terminal").splitlines()
    assert first.startswith("HONEST: all 6 answers to 2 problems, 0 refused, ")


def test_an_interrupted_run_says_so(honest: Document) -> None:
    assert ", interrupted" in render(honest | {"interrupted": True}, "terminal").splitlines()[0]


def test_every_case_has_a_row(document: Document) -> None:
    text = render(document, "terminal")
    for c in document["cases"]:
        assert c["name"].partition(": ")[2] in text
    table = text.split("\n\n")[1].splitlines()
    assert table[0] == "Eq. 17"
    assert table[1].split() == ["case", "method", "error", "reported", "kind", "ms", "honest"]
    assert table[3].split()[-1] == "NO"
    assert all(row.split()[-1] == "yes" for row in table[4:7])
    refused = text.split("\n\n")[2].splitlines()[3]
    assert refused.split()[-6:-2] == ["none", "-", "-", "refused"]


def test_csv_holds_every_field(document: Document) -> None:
    head, *rows = csv.reader(io.StringIO(render(document, "csv")))
    assert head == list(document["cases"][0])
    assert len(rows) == len(document["cases"])
    assert [r[head.index("honest")] for r in rows[:2]] == ["false", "true"]


def test_json_is_the_document(document: Document) -> None:
    assert json.loads(render(document, "json")) == document


def test_markdown_has_a_table_per_kind(document: Document) -> None:
    text = render(document, "markdown")
    assert text.startswith("**DISHONEST: ")
    rows = [line for line in text.splitlines() if line.startswith("|")]
    assert len(rows) == len(document["cases"]) + 2 * 2
    assert len({r.count("|") for r in rows}) == 1


def test_latex_compiles(document: Document, tmp_path: Path) -> None:
    text = render(document, "latex")
    check_structure(text)
    assert r"wrong\_100\%" in text
    assert r"\times10^{" in text
    compile_where_possible([text], tmp_path)
