"""Convergence tables as printed: Eqs. 24-26 and Table 1 in every format."""

import csv
import io
import json
import math
from pathlib import Path

import pytest
from latex import check_structure, compile_where_possible
from specrate.report.cli import FORMATS
from specrate.report.table_formats import render
from specrate.theory.tables import table

BOTH = ("worst", "best")

LATEX = [
    ((), ("d",), BOTH, "point"),
    ((), ("1", "2", "3"), BOTH, "point"),
    ((), ("d",), BOTH, "line"),
    ((), ("3",), ("ball",), "segment"),
    ((), ("5",), ("ball",), "2-flat"),
    ((), ("2",), ("anisotropic-gaussian",), "point"),
    (("uncorrelated-jitter:2+(d-2)", "jitter"), ("d",), ("additive",), "point"),
    (("jitter:N^1/2xN^1/4xN^1/4",), ("3",), ("ball", "worst"), "point"),
    (("regular", "multi-jitter"), ("8",), ("worst",), "point"),
]


def shown(text: str, sampler: str, integrand: str) -> list[tuple[str, str, str]]:
    """(region, variance, decides) of one sampler and class in a terminal table."""
    head, rule, *lines = text.split("\n\n")[1].splitlines()
    starts = [i for i, c in enumerate(rule) if c == "-" and (i == 0 or rule[i - 1] == " ")]
    ends = [*starts[1:], len(head) + 50]
    found: list[tuple[str, str, str]] = []
    group = ("", "")
    for line in lines:
        cells = [line[a:b].strip() for a, b in zip(starts, ends, strict=True)]
        cells += [""] * (6 - len(cells))
        group = (cells[0], cells[2]) if cells[0] else group
        if group == (sampler, integrand):
            found.append((cells[3], cells[4], cells[5]))
    return found


def test_eq_24_latin_hypercube() -> None:
    text = render((), ("d",), BOTH, "point", "terminal")
    for integrand, axis in (("worst", "N^-2"), ("best", "N^-3")):
        assert shown(text, "latin-hypercube", integrand) == [
            ("axis", axis, ""),
            ("1<w<=d", "N^-1", "yes"),
            ("overall", "N^-1", ""),
        ]


def test_eq_25_multi_jitter() -> None:
    text = render((), ("d",), BOTH, "point", "terminal")
    for integrand, axis, rest in (
        ("worst", "N^-2", "N^(-1 - 1/d)"),
        ("best", "N^-3", "N^(-1 - 2/d)"),
    ):
        assert shown(text, "multi-jitter", integrand) == [
            ("axis", axis, ""),
            ("1<w<=d", rest, "yes"),
            ("overall", rest, ""),
        ]


def test_eq_26_uncorrelated_jitter() -> None:
    text = render((), ("d",), BOTH, "point", "terminal")
    assert shown(text, "uncorrelated-jitter:1+2+(d - 3)", "worst") == [
        ("within {1}", "N^-2", ""),
        ("within {2,3}", "N^(-3/2)", ""),
        ("within {4..d}", "N^(-1 - 1/(d - 3))", ""),
        ("across", "N^-1", "yes"),
        ("overall", "N^-1", ""),
    ]


def test_table_1_jitter() -> None:
    text = render(("jitter",), ("d", "1", "2", "3"), BOTH, "point", "terminal")
    rates = [v for _, v, _ in shown(text, "jitter", "worst")]
    assert rates == ["N^(-1 - 1/d)", "N^-2", "N^(-3/2)", "N^(-4/3)"]
    rates = [v for _, v, _ in shown(text, "jitter", "best")]
    assert rates == ["N^(-1 - 2/d)", "N^-3", "N^-2", "N^(-5/3)"]


def test_sizes_are_those_of_the_sampled_dimensions() -> None:
    text = render(("multi-jitter",), ("5",), ("worst",), "line", "terminal")
    assert "parallel lines" in text
    assert [r for r, _, _ in shown(text, "multi-jitter", "worst")] == ["axis", "2<=w<=4", "overall"]


def test_cases_of_a_symbol_are_spelled_out() -> None:
    text = render(("uncorrelated-jitter:2+(d-2)",), ("d",), ("additive",), "point", "terminal")
    assert shown(text, "uncorrelated-jitter:2+(d-2)", "additive")[-2:] == [
        ("overall", "N^(-3/2)  for d <= 4", ""),
        ("overall", "N^(-1 - 1/(d - 2))  for d >= 4", ""),
    ]


def test_words_of_a_table_are_explained() -> None:
    text = render((), ("d",), BOTH, "point", "terminal")
    for word in ("region:", "axis: w = 1", "within one block", "variance 0:", "isotropic:b:"):
        assert word in text
    plain = render(("jitter",), ("2",), ("disk",), "point", "terminal")
    assert "isotropic" not in plain
    assert "within" not in plain


def test_left_out_regions_are_told() -> None:
    text = render(("jitter", "random"), ("3",), ("bernoulli",), "point", "terminal")
    assert "left out: bernoulli on w=2, generic (every sampler): " in text


def test_csv_holds_the_rows_of_the_json_document() -> None:
    arguments = (("jitter", "regular"), ("2", "d"), BOTH, "point")
    rows = json.loads(render(*arguments, "json"))["rows"]
    read = list(csv.DictReader(io.StringIO(render(*arguments, "csv"))))
    spelled = [
        {k: "" if v is None else str(v).lower() if isinstance(v, bool) else v for k, v in r.items()}
        for r in rows
    ]
    assert read == spelled


def test_markdown_has_one_row_per_merged_region() -> None:
    text = render(("multi-jitter",), ("d",), ("worst",), "point", "markdown")
    assert r"| multi-jitter | d | worst | 1<w<=d | $N^{-1-\frac{1}{d}}$ | yes |" in text


def test_crossovers_are_told_in_every_format_for_readers() -> None:
    for form in ("terminal", "markdown", "latex"):
        assert "42.293" in render(("n-rooks",), ("2",), ("anisotropic-gaussian",), "point", form)


def test_latex_reads_as_the_paper_does() -> None:
    text = render((), ("d",), BOTH, "point", "latex")
    assert r"\overbrace{\mathcal{O}(N^{-2})}^{\text{axis}}" in text
    assert r"\overbrace{\mathcal{O}(N^{-1-\frac{2}{d}})}^{\text{$1<w\le d$}}" in text
    assert r"\overbrace{\mathcal{O}(N^{-1-\frac{1}{d-3}})}^{\text{within $\{4,\ldots,d\}$}}" in text
    assert r"\mathcal{O}(N^{-1-\frac{\min(1,b)}{d}}(\log N)^{[b=1]})" in text


@pytest.mark.parametrize("arguments", LATEX, ids=str)
def test_latex_is_well_formed(arguments: tuple[tuple[str, ...], ...]) -> None:
    check_structure(render(*arguments, "latex"))


def test_latex_compiles(tmp_path: Path) -> None:
    compile_where_possible([render(*a, "latex") for a in LATEX], tmp_path)


@pytest.mark.parametrize("form", FORMATS)
def test_every_format_takes_cases_and_primitives(form: str) -> None:
    text = render(("uncorrelated-jitter:2+(d-3)",), ("d",), ("additive",), "line", form)
    assert "uncorrelated-jitter" in text


def test_every_deciding_row_has_the_overall_order() -> None:
    rows = table(dims=("d", "3"), integrands=BOTH).rows
    ends = {(r.sampler, r.dim, r.integrand): r.order for r in rows if r.is_overall}
    for row in rows:
        if not row.is_overall and not row.dominated:
            assert row.order == ends[row.sampler, row.dim, row.integrand]


def test_constants_are_exact_and_decimal() -> None:
    """N^(-3/2) with 2R · 0.5214 for the disk, the axes' N^-2 log N with R/3."""
    whole = json.loads(render(("jitter",), ("2",), ("disk:radius=0.3",), "point", "json"))
    found = {r["region"]: (r["constant"], r["constant_value"]) for r in whole["rows"]}
    edge = ("sqrt(2)/25 + 2/25 + log(1 + sqrt(2))/5", "0.312843259898832")
    assert found == {"axis": ("1/10", "0.100000000000000"), "generic": edge, "overall": edge}


def test_constants_with_symbols_have_no_decimal() -> None:
    for integrand in ("disk", "worst"):
        whole = json.loads(render(("jitter",), ("2",), (integrand,), "point", "json"))
        axis = whole["rows"][0]
        assert axis["constant"]
        assert axis["constant_value"] is None


def test_constants_without_closed_form_are_decimals_too() -> None:
    """The mean distance in the 4-cube is an integral, a Gaussian's power a sum."""
    for dim, integrand, word in (
        ("4", "ball:radius=0.3", "Integral"),
        ("2", "gaussian:sigma=0.1", "Sum"),
    ):
        text = render(("jitter",), (dim,), (integrand,), "point", "csv")
        rows = list(csv.DictReader(io.StringIO(text)))
        assert word in rows[-1]["constant"]
        assert 0 < float(rows[-1]["constant_value"]) < 1
        assert len(rows[-1]["constant_value"].lstrip("0.")) == 15


def test_a_named_integrand_shows_its_constant() -> None:
    """Jitter on a smooth f has the leading term (π²/3)(2π)^-2 ∫|∇f|² N^-2 in 2D; here π/12."""
    text = render(("jitter",), ("2",), ("gaussian:sigma=0.1",), "point", "terminal")
    assert shown(text, "jitter", "gaussian:sigma=0.1") == [
        ("overall, every region", "0.261799 N^-2", "")
    ]
    assert round(math.pi / 12, 6) == 0.261799
    assert "leading term" in text
    assert "leading order" in render(("jitter",), ("d",), BOTH, "point", "terminal")
