"""An exact variance as printed."""

import csv
import io
import json
from dataclasses import replace
from pathlib import Path

import pytest
from latex import check_structure, compile_where_possible
from specrate.numerics import variance
from specrate.numerics.balls import Certified
from specrate.numerics.exact_variances.variances import VarianceResult
from specrate.report.variance_formats import render, shortfall

FOUND = VarianceResult(
    "uncorrelated-jitter:1+1",
    "box:side=(1/3,1)",
    2,
    10**30,
    "1e30",
    Certified("1.25e-60", "3.1e-62"),
    "product",
    0.25,
    (("coordinates 2", "the integrand does not depend on them"),),
)


def test_terminal_tells_value_bound_and_what_is_left_out() -> None:
    assert render(FOUND, "terminal").splitlines() == [
        "Var = 1.25e-60",
        "error at most 3.1e-62 (certified, method product)",
        "uncorrelated-jitter:1+1 on box:side=(1/3,1) in 2D, N = 1e30",
        "left out: coordinates 2: the integrand does not depend on them",
    ]


@pytest.mark.parametrize(
    ("n", "shown"), [(7, "7"), (10**12, "1e12"), (123456789012, "123456789012")]
)
def test_n_is_exact(n: int, shown: str) -> None:
    assert f"N = {shown}\n" in render(replace(FOUND, n=n), "terminal")


def test_json_has_the_fields_in_order() -> None:
    document = json.loads(render(FOUND, "json"))
    assert list(document) == [
        *("sampler", "integrand", "dim", "n", "n_asked", "value", "error_bound", "method"),
        *("left_out", "seconds"),
    ]
    assert document["n"] == 10**30
    assert document["left_out"][0]["what"] == "coordinates 2"


def test_csv_is_one_row() -> None:
    head, row = csv.reader(io.StringIO(render(FOUND, "csv")))
    cells = dict(zip(head, row, strict=True))
    assert cells["value"] == "1.25e-60"
    assert cells["left_out"] == "coordinates 2: the integrand does not depend on them"


def test_markdown_is_one_row() -> None:
    table = [x for x in render(FOUND, "markdown").splitlines() if x.startswith("|")]
    assert len(table) == 3
    assert "| 1.25e-60 | 3.1e-62 |" in table[2]


def test_latex_compiles(tmp_path: Path) -> None:
    text = render(FOUND, "latex")
    check_structure(text)
    assert r"$1.25\times10^{-60}$" in text
    assert r"$1\times10^{30}$" in text
    compile_where_possible([text], tmp_path)


@pytest.mark.parametrize(
    ("bound", "digits", "short"),
    [("3.1e-62", 2, False), ("3.1e-62", 3, True), ("1e-61", 3, True), ("0", 50, False)],
)
def test_a_shortfall_is_told(bound: str, digits: int, short: bool) -> None:
    line = shortfall(replace(FOUND, value=Certified("1.25e-60", bound)), digits)
    assert (line is not None) == short
    if line is not None:
        assert line.startswith(f"{digits} digits were asked for, the method product gives 1.25e-60")


@pytest.mark.parametrize("digits", [2, 15, 40])
def test_certified_values_fall_not_short(digits: int) -> None:
    assert shortfall(variance("jitter", "product:k=2", 3, "1e9", digits), digits) is None


def test_zero_is_no_shortfall() -> None:
    """A regular grid integrates a polynomial wave below its first alias without error."""
    assert shortfall(replace(FOUND, value=Certified("0", "0")), 15) is None
    assert shortfall(replace(FOUND, value=Certified("0", "1e-9")), 15) is not None


@pytest.mark.parametrize(
    ("value", "bound", "digits", "short"),
    [
        ("7.68385884307076e-42863147302", "3.23e-42863147317", 15, False),
        ("7.68385884307076e-42863147302", "3.23e-42863147315", 15, True),
        ("-1.5e-9", "1.5e-10", 2, False),
        ("-1.5e-9", "1.6e-10", 2, True),
        ("1.5e-9", "3e10000000000000", 2, True),
        ("1.5", "3e-10000000000000", 4000, False),
        ("0", "0", 15, False),
        ("0", "1e-30", 15, True),
    ],
)
def test_digits_that_lack_are_told_at_any_exponent(value, bound, digits, short):
    found = replace(FOUND, value=Certified(value, bound))
    assert (shortfall(found, digits) is not None) is short
