"""Derivations as printed."""

import json
import re
from pathlib import Path

import pytest
from latex import check_structure, compile_where_possible
from specrate.report.derivation_formats import render
from specrate.theory.derivations import derive

CASES = [
    ("jitter", "d", "best", "overall", "point"),
    ("latin-hypercube", "3", "best", "overall", "point"),
    ("multi-jitter", "d", "worst", "overall", "point"),
    ("multi-jitter:8x16", "2", "worst", "generic", "point"),
    ("uncorrelated-jitter:1+2+(d-3)", "d", "worst", "within", "point"),
    ("correlated-multi-jitter", "2", "p=5/2", "overall", "point"),
    ("regular", "d", "worst", "overall", "point"),
    ("regular", "2", "best", "overall", "point"),
    ("isotropic:b", "d", "worst", "overall", "line"),
    ("jitter:N^1/2xN^1/4xN^1/4", "3", "ball", "overall", "point"),
    ("random", "2", "disk", "overall", "segment"),
]


@pytest.mark.parametrize("arguments", CASES, ids=str)
def test_the_terminal_shows_every_step_and_reason(arguments: tuple[str, ...]) -> None:
    text, found = render(*arguments, "terminal"), derive(*arguments)
    numbers = [int(n) for n in re.findall(r"(?m)^ +(\d+)\. ", text)]
    assert numbers == list(range(1, len(found.steps) + 1))
    for step in found.steps:
        assert step.expression in text
        assert f"{step.equation}: {step.reason}" in text
    assert "**" not in text
    assert "Min(" not in text


def test_symbols_are_explained_first() -> None:
    head = render("jitter", "d", "worst", "overall", "point", "terminal").split("\n\n")[0]
    assert head.startswith("jitter × worst in d dimensions, sampled by points")
    for word in ("P_S", "P_f", "rho", "s:", "N_k", "nu", "b, gamma", "p:", "V:"):
        assert word in head


@pytest.mark.parametrize("arguments", CASES, ids=str)
def test_latex_is_well_formed(arguments: tuple[str, ...]) -> None:
    text = render(*arguments, "latex")
    check_structure(text)
    assert "**" not in text
    assert text.count(r"\[") == len(derive(*arguments).steps)


def test_latex_compiles(tmp_path: Path) -> None:
    compile_where_possible([render(*a, "latex") for a in CASES], tmp_path)


def test_latex_sums_as_the_paper_does() -> None:
    text = render("multi-jitter", "d", "worst", "overall", "point", "latex")
    assert r"\overbrace{\mathcal{O}(N^{-2})}^{\text{axis}}" in text
    assert r"= \mathcal{O}(N^{-1-\frac{1}{d}})" in text


def test_latex_tells_the_cases() -> None:
    text = render("uncorrelated-jitter:1+2+(d-3)", "d", "worst", "within", "point", "latex")
    assert (
        r"\begin{cases}\mathcal{O}(N^{-\frac{3}{2}}) & d \le 5 \\ "
        r"\mathcal{O}(N^{-1-\frac{1}{d-3}}) & d \ge 5\end{cases}"
    ) in text


def test_long_formulas_are_broken_before_signs() -> None:
    text = render("correlated-multi-jitter", "2", "worst", "generic", "point", "latex")
    assert r"\begin{aligned} N P_S ={}& 1 \\ &{}+ \frac" in text


def test_markdown_numbers_the_steps() -> None:
    text = render("jitter", "2", "best", "overall", "point", "markdown")
    steps = derive("jitter", "2", "best").steps
    assert text.startswith("## jitter × best in 2D")
    for number, step in enumerate(steps, 1):
        assert f"{number}. ({step.equation}) $${step.latex}$$ {step.reason}" in text


def test_json_is_the_document() -> None:
    document = json.loads(render("jitter", "2", "worst", "overall", "point", "json"))
    assert document["result"] == {"exponent": "3/2", "log_power": "0"}
