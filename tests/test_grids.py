"""Plain tables of text."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from latex import check_structure
from specrate.report.grids import (
    aligned,
    booktabs,
    comma_separated,
    escaped,
    markdown,
    without_repeats,
)

cells = st.text(st.characters(blacklist_categories=["Cs", "Cc"]), max_size=12)
rows = st.lists(st.tuples(cells, cells, cells), min_size=1, max_size=6)


def test_columns_are_aligned_under_a_rule() -> None:
    text = aligned(("a", "long head", "c"), [("1", "2", "3"), ("wide cell", "4", "5")])
    assert text.splitlines() == [
        "a          long head  c",
        "---------  ---------  -",
        "1          2          3",
        "wide cell  4          5",
    ]


def test_a_last_column_without_words_is_dropped() -> None:
    assert aligned(("a", "b"), [("1", ""), ("2", "")]) == "a\n-\n1\n2"
    assert aligned(("a", "b"), [("1", ""), ("2", "x")]).splitlines()[0] == "a  b"


def test_leading_columns_are_shown_once_per_group() -> None:
    rows = [("a", "1"), ("a", "2"), ("b", "3"), ("a", "4")]
    assert without_repeats(rows, 1) == [["a", "1"], ["", "2"], ["b", "3"], ["a", "4"]]


def test_markdown_escapes_bars() -> None:
    assert markdown(("a", "b"), [("n | m", "1")]).splitlines() == [
        "| a | b |",
        "| --- | --- |",
        r"| n \| m | 1 |",
    ]


@given(rows)
def test_csv_reads_back(table: list[tuple[str, str, str]]) -> None:
    head = ("first", "second", "third")
    text = comma_separated(head, table) + "\n"
    assert [tuple(r) for r in csv.reader(io.StringIO(text, newline=""))] == [head, *table]


def test_booktabs_rules_and_rows() -> None:
    lines = booktabs("lr", ["a", "b"], [["1", "2"], None, ["3", "4"]]).splitlines()
    assert lines == [
        r"\begin{tabular}{lr}",
        r"\toprule",
        r"a & b \\",
        r"\midrule",
        r"1 & 2 \\",
        r"\midrule",
        r"3 & 4 \\",
        r"\bottomrule",
        r"\end{tabular}",
    ]


@given(rows)
def test_escaped_cells_keep_the_structure(table: list[tuple[str, str, str]]) -> None:
    check_structure(
        booktabs("lll", ["a", "b", "c"], [[escaped(c) + "x" for c in r] for r in table])
    )


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("a_b & 5 %", r"a\_b \& 5 \%"),
        ("N^2 ~ {x}", r"N\textasciicircum{}2 \textasciitilde{} \{x\}"),
        ("p < q > r", r"p \textless{} q \textgreater{} r"),
        ("\\", r"\textbackslash{}"),
    ],
)
def test_escaped(text: str, latex: str) -> None:
    assert escaped(text) == latex


@pytest.mark.parametrize(
    "broken",
    [
        r"\begin{tabular}{ll} a \\ \end{tabular}",
        r"\begin{tabular}{l} a & b \\ \end{tabular}",
        r"{a",
        r"a}",
        r"\begin{enumerate}",
        r"\begin{a}\end{b}",
        r"$a",
        r"\left(a)",
    ],
)
def test_broken_latex_is_seen(broken: str) -> None:
    with pytest.raises(AssertionError):
        check_structure(broken)
